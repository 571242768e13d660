use super::*;
use crate::linalg::SymbolicCholesky;
use crate::surface::pht::basis::Widths;
use sprs::{CsMat, TriMat};

#[test]
fn the_worked_examples_of_function_jets() {
    let close = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14);
    let b = Widths { u: [1.0 / 6.0; 2], v: [1.0 / 6.0; 2] }.function_jets();
    assert!(close(b[0], [0.25, -1.5, -1.5, 9.0]), "{b:?}");
    let corner = Widths { u: [0.0, 1.0 / 3.0], v: [0.0, 1.0 / 3.0] }.function_jets();
    let expected = [[1., -3., -3., 9.], [0., 3., 0., -9.], [0., 0., 3., -9.], [0., 0., 0., 9.]];
    assert!(corner.iter().zip(expected).all(|(row, exact)| close(*row, exact)), "{corner:?}");
}

#[test]
fn functions_are_positive_sum_to_one_and_are_independent() {
    for seed in 0..6 {
        let surface = random_surface(seed, 25, 1, false);
        let leaf_count = surface.patch_count();
        for basis in [Basis::Canonical, Basis::SupportSized] {
            let functions = surface.basis(basis);
            let count = surface.jets().len();
            let mut sums = vec![[0.0; 16]; leaf_count];
            let mut gram = TriMat::new((4 * count, 4 * count));
            for rank in 0..count {
                for form in functions.functions(rank) {
                    for ordinates in &form.ordinates {
                        for (sum, &x) in sums[form.leaf].iter_mut().zip(ordinates) {
                            // three interpolations of jets of size one, and two of ordinates
                            assert!(x >= -64.0 * f64::EPSILON, "{basis:?} {rank}: {x}");
                            *sum += x;
                        }
                    }
                }
            }
            // a few functions a leaf, each as above
            let off = sums.iter().flatten().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max);
            assert!(off <= 256.0 * f64::EPSILON, "{basis:?}: {off:e}");

            // ordinates of independent functions have a positive definite Gram matrix
            for leaf in 0..leaf_count {
                let LocalExtraction { vertices, matrix } = functions.extraction(leaf);
                let columns = 4 * vertices.len();
                for a in 0..columns {
                    for b in 0..columns {
                        let global = |c: usize| 4 * vertices[c / 4] as usize + c % 4;
                        if global(a) >= global(b) {
                            let sum: f64 =
                                (0..16).map(|r| matrix[r * columns + a] * matrix[r * columns + b]).sum();
                            gram.add_triplet(global(a), global(b), sum);
                        }
                    }
                }
            }
            let gram: CsMat<f64> = gram.to_csc();
            let factor = SymbolicCholesky::new(&gram.view(), None);
            assert!(factor.factor(&gram.view()).is_ok(), "{basis:?} seed {seed}");
        }
    }
}

#[test]
fn extraction_makes_ordinates_of_control_points() {
    let surface = random_surface(3, 30, 2, false);
    for basis in [Basis::Canonical, Basis::SupportSized] {
        let (functions, points) = (surface.basis(basis), surface.control_points(basis));
        for leaf in 0..surface.patch_count() {
            let LocalExtraction { vertices, matrix } = functions.extraction(leaf);
            let exact = surface.patch(leaf).ordinates;
            for (row, exact) in matrix.chunks_exact(4 * vertices.len()).zip(exact.chunks_exact(2)) {
                for k in 0..2 {
                    let point = |c: usize| points[8 * vertices[c / 4] as usize + 2 * (c % 4) + k];
                    let sum: f64 = row.iter().enumerate().map(|(c, share)| share * point(c)).sum();
                    // a convex combination of some thirty points below 2
                    assert!((sum - exact[k]).abs() <= 128.0 * f64::EPSILON, "{basis:?} {leaf}");
                }
            }
        }
    }
}

/// The smallest rectangle with the vertex inside whose sides are covered by mesh edges.
fn bounding_rectangle(mesh: &TMesh, vertex: Vertex) -> [u32; 4] {
    let topology = Topology::new(mesh);
    let corners: Vec<[Vertex; 4]> = topology.leaves.iter().map(|&leaf| mesh.cell(leaf).corners()).collect();
    let last = mesh.last_vertex();
    let mut lines: [Vec<u32>; 2] = [Vec::new(), Vec::new()];
    for vertex in &topology.vertices {
        lines[0].push(vertex.i);
        lines[1].push(vertex.j);
    }
    lines.iter_mut().for_each(|lines| {
        lines.sort_unstable();
        lines.dedup();
    });
    // no leaf reaches across a line segment that consists of edges
    let is_covered = |axis: Axis, at: u32, from: u32, to: u32| {
        corners.iter().all(|[low, _, _, high]| {
            let across = if axis == Axis::U { Axis::V } else { Axis::U };
            let straddles = low.along(axis) < at && at < high.along(axis);
            !(straddles && low.along(across) < to && high.along(across) > from)
        })
    };
    let sides = |lines: &[u32], at: u32, end: u32| -> (Vec<u32>, Vec<u32>) {
        let low = lines.iter().copied().filter(|&x| x < at || (at == 0 && x == 0)).rev().collect();
        let high = lines.iter().copied().filter(|&x| x > at || (at == end && x == end)).collect();
        (low, high)
    };
    let (low_i, high_i) = sides(&lines[0], vertex.i, last.i);
    let (low_j, high_j) = sides(&lines[1], vertex.j, last.j);
    let mut best: Option<[u32; 4]> = None;
    for &a in &low_i {
        for &b in &high_i {
            for &c in &low_j {
                for &d in &high_j {
                    let covered = is_covered(Axis::U, a, c, d)
                        && is_covered(Axis::U, b, c, d)
                        && is_covered(Axis::V, c, a, b)
                        && is_covered(Axis::V, d, a, b);
                    let area = |[a, b, c, d]: [u32; 4]| u64::from(b - a) * u64::from(d - c);
                    if covered && best.is_none_or(|best| area([a, b, c, d]) < area(best)) {
                        best = Some([a, b, c, d]);
                    }
                }
            }
        }
    }
    best.unwrap()
}

#[test]
fn supports_span_the_smallest_rectangles_of_mesh_edges() {
    for seed in 0..4 {
        let surface = random_surface(seed, 12, 1, false);
        let mesh = surface.mesh();
        let functions = surface.basis(Basis::Canonical);
        for (rank, (vertex, _)) in surface.jets().enumerate() {
            let mut support = [u32::MAX, 0, u32::MAX, 0];
            for form in functions.functions(rank) {
                if form.ordinates.iter().flatten().all(|x| x.abs() <= 64.0 * f64::EPSILON) {
                    continue;
                }
                let [low, _, _, high] = mesh.cell(surface.topology().leaves[form.leaf]).corners();
                support = [
                    support[0].min(low.i),
                    support[1].max(high.i),
                    support[2].min(low.j),
                    support[3].max(high.j),
                ];
            }
            assert_eq!(support, bounding_rectangle(mesh, vertex), "seed {seed}, {vertex:?}");
        }
    }
}

#[test]
fn affine_maps_of_control_points_are_those_of_the_surface() {
    let surface = random_surface(8, 30, 2, false);
    let map = |x: &[f64]| [3.0 * x[0] - x[1] + 7.0, 0.5 * x[0] + 2.0 * x[1] - 1.0];
    let ranks: Vec<usize> = (0..surface.jets().len()).collect();
    for basis in [Basis::Canonical, Basis::SupportSized] {
        let points: Vec<f64> = surface.control_points(basis).chunks_exact(2).flat_map(map).collect();
        let mut moved = surface.clone();
        moved.set_control_points(&ranks, basis, &points).unwrap();
        let uv = random_places(&surface, 500);
        let (mut before, mut after) = (vec![0.0; 1000], vec![0.0; 1000]);
        surface.eval_rows(&uv, 0, &mut before);
        moved.eval_rows(&uv, 0, &mut after);
        for (before, after) in before.chunks_exact(2).zip(after.chunks_exact(2)) {
            let exact = map(before);
            // slopes are differences of control points over birth widths, taken back by smaller cells
            assert!((0..2).all(|k| (after[k] - exact[k]).abs() <= 1e-13 * 16.0), "{basis:?}");
        }
    }
}

/// The inner products of all functions, each divided by its norm, row by row.
fn scaled_mass_matrix(surface: &PhtSurface, basis: Basis) -> Vec<f64> {
    // of the cubic Bernstein polynomials over the unit interval
    let choose =
        |n: usize, k: usize| (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64);
    let bernstein = |i: usize, j: usize| choose(3, i) * choose(3, j) / (7.0 * choose(6, i + j));
    let functions = surface.basis(basis);
    let count = 4 * surface.jets().len();
    let mut mass = vec![0.0; count * count];
    for leaf in 0..surface.patch_count() {
        let area = surface.patch(leaf).domain.size().element_product();
        let LocalExtraction { vertices, matrix } = functions.extraction(leaf);
        let columns = 4 * vertices.len();
        let global = |c: usize| 4 * vertices[c / 4] as usize + c % 4;
        for p in 0..16 {
            for q in 0..16 {
                let product = area * bernstein(p / 4, q / 4) * bernstein(p % 4, q % 4);
                for a in 0..columns {
                    for b in 0..columns {
                        mass[global(a) * count + global(b)] +=
                            product * matrix[p * columns + a] * matrix[q * columns + b];
                    }
                }
            }
        }
    }
    let norms: Vec<f64> = (0..count).map(|k| mass[k * count + k].sqrt()).collect();
    (0..count * count).map(|at| mass[at] / (norms[at / count] * norms[at % count])).collect()
}

/// The ratio of the largest and the least eigenvalue of a symmetric matrix, by power iteration with it and with
/// its inverse.
fn condition(matrix: &[f64], size: usize) -> f64 {
    let mut lower = TriMat::new((size, size));
    for (at, &x) in matrix.iter().enumerate() {
        if at / size >= at % size && x != 0.0 {
            lower.add_triplet(at / size, at % size, x);
        }
    }
    let lower: CsMat<f64> = lower.to_csc();
    let factor = SymbolicCholesky::new(&lower.view(), None).factor(&lower.view()).unwrap();
    let times = |x: &[f64]| -> Vec<f64> {
        matrix.chunks_exact(size).map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum()).collect()
    };
    let solve = |x: &[f64]| {
        let mut y = x.to_vec();
        factor.solve(&mut y, 1);
        y
    };
    dominant(size, times) * dominant(size, solve)
}

/// The largest eigenvalue of a positive map.
fn dominant(size: usize, map: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
    // the growth approaches it from below, with the square of the ratio of neighbours in each step
    const STEPS: usize = 300;
    let mut random = Random::new(3);
    let mut x: Vec<f64> = (0..size).map(|_| random.signed()).collect();
    let mut growth = 0.0;
    for _ in 0..STEPS {
        let y = map(&x);
        growth = y.iter().map(|y| y * y).sum::<f64>().sqrt();
        x = y.into_iter().map(|y| y / growth).collect();
    }
    growth
}

/// Decay and its cure: refined again and again around one vertex, the functions of the paper become
/// parallel, those with the widths of their supports do not.
#[test]
fn support_sized_functions_stay_apart_beside_finer_cells() {
    let middle = DVec2::splat(0.5);
    let mut surface = PhtSurface::zero(1, false, unit_square(&[cell(0, 0, 0)])).unwrap();
    let mut conditions = [Vec::new(), Vec::new()];
    for _ in 0..5 {
        let touching: Vec<Cell> = surface.mesh().leaves().map(|leaf| surface.mesh().cell(leaf)).collect();
        let touching = touching.into_iter().filter(|&cell| surface.mesh().cell_domain(cell).contains(middle));
        surface.split(&touching.collect::<Vec<_>>()).unwrap();
        for (basis, conditions) in [Basis::Canonical, Basis::SupportSized].into_iter().zip(&mut conditions) {
            conditions.push(condition(&scaled_mass_matrix(&surface, basis), surface.coefficient_count()));
        }
    }
    let [canonical, support_sized] = conditions;
    assert!(canonical.windows(2).all(|pair| pair[1] > 5.0 * pair[0]), "{canonical:?}");
    assert!(canonical[4] > 1e6, "{canonical:?}");
    assert!(support_sized.iter().all(|&condition| condition < 1e3), "{support_sized:?}");
}
