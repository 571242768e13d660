use super::basis::Widths;
use super::*;
use crate::knots::KnotVector;
use crate::linalg::SymbolicCholesky;
use crate::samples::Random;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{ConvertError, derivative_rows};
use sprs::{CsMat, TriMat};

fn cell(level: u32, i: u32, j: u32) -> Cell {
    Cell { level, i, j }
}

fn split_mesh(breaks: [&[f64]; 2], cells: &[Cell]) -> TMesh {
    let mut mesh = TMesh::new(breaks[0], breaks[1]).unwrap();
    for &cell in cells {
        let leaf = mesh.find(cell).unwrap();
        mesh.split(leaf);
    }
    mesh
}

fn unit_square(cells: &[Cell]) -> TMesh {
    split_mesh([&[0.0, 1.0], &[0.0, 1.0]], cells)
}

/// Splits random leaves, deep ones more often, over an uneven grid far from the origin.
fn random_mesh(seed: u64, splits: usize) -> TMesh {
    let mut random = Random::new(seed);
    let mut mesh = TMesh::new(&[-1.0, 0.5, 1.0], &[10.0, 11.0, 14.0, 14.5]).unwrap();
    for _ in 0..splits {
        let leaves: Vec<NodeId> = mesh.leaves().collect();
        let pick = leaves[(random.unit() * leaves.len() as f64) as usize];
        if mesh.cell(pick).level < 6 {
            mesh.split(pick);
        }
    }
    mesh
}

fn random_surface(seed: u64, splits: usize, dim: usize, is_rational: bool) -> PhtSurface {
    let mesh = random_mesh(seed, splits);
    let count = Topology::new(&mesh).basis.len();
    let mut random = Random::new(seed + 1);
    let width = dim + usize::from(is_rational);
    let mut jets = Vec::new();
    for _ in 0..count {
        for row in 0..4 {
            // slopes small against the cells' sizes keep the weights positive
            let scale = if row == 0 { 1.0 } else { 1e-2 };
            jets.extend((0..width).map(|k| {
                let base = if row == 0 && is_rational && k == dim { 2.0 } else { 0.0 };
                base + scale * random.signed()
            }));
        }
    }
    PhtSurface::new(dim, is_rational, mesh, &jets).unwrap()
}

fn random_places(surface: &PhtSurface, count: usize) -> Vec<DVec2> {
    let (domain, mut random) = (surface.domain(), Random::new(77));
    (0..count).map(|_| domain.min + DVec2::new(random.unit(), random.unit()) * domain.size()).collect()
}

/// Largest difference of values at random places.
fn difference(a: &PhtSurface, b: &dyn Surface, count: usize) -> f64 {
    let uv = random_places(a, count);
    let (mut x, mut y) = (vec![0.0; count * a.dim()], vec![0.0; count * a.dim()]);
    a.eval_rows(&uv, 0, &mut x);
    b.eval_rows(&uv, 0, &mut y);
    x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn the_worked_example_of_seven_leaves() {
    let mesh = unit_square(&[cell(0, 0, 0), cell(1, 0, 0)]);
    let topology = Topology::new(&mesh);
    assert_eq!((topology.leaves.len(), topology.vertices.len(), topology.basis.len()), (7, 14, 12));
    let at = |i: u32, j: u32| Vertex { i: i << 18, j: j << 18 };
    let host = |i, j| match mesh.role(at(i, j)) {
        Role::Hanging(host) => mesh.cell(host),
        role => panic!("{role:?}"),
    };
    assert_eq!((host(1, 2), host(2, 1)), (cell(1, 0, 1), cell(1, 1, 0)));

    let middle = topology.basis.iter().position(|&v| topology.vertices[v as usize] == at(2, 2)).unwrap();
    let mut jets = vec![0.0; 48];
    jets[4 * middle] = 1.0;
    let surface = PhtSurface::new(1, false, mesh, &jets).unwrap();
    assert_eq!(surface.coefficient_count(), 48);
    // all numbers are small binary fractions: exact
    assert_eq!(surface.jet_at(at(2, 1)), [0.5, 0.0, 3.0, 0.0]);
    assert_eq!(surface.jet_at(at(1, 2)), [0.5, 3.0, 0.0, 0.0]);
    let leaf = surface.topology().leaf_of(surface.mesh.find(cell(2, 1, 1)).unwrap());
    let expected = [0., 0., 0.5, 0.5, 0., 0., 0.75, 0.75, 0.5, 0.75, 1., 1., 0.5, 0.75, 1., 1.];
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 4.0 * f64::EPSILON);
    assert!(near(&surface.patch(leaf).ordinates, &expected), "{:?}", surface.patch(leaf).ordinates);
    let mut values = [0.0; 2];
    surface.eval_rows(&[DVec2::splat(0.375), DVec2::splat(0.25)], 0, &mut values);
    assert!(near(&values, &[19.0 / 32.0, 0.0]), "{values:?}");
    let points = surface.control_points(Basis::Canonical);
    assert_eq!(points[4 * middle..][..4], [1.0; 4]);
}

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

#[test]
fn bicubics_are_reproduced_with_all_derivatives() {
    let power = |x: f64, degree: i32, order: i32| -> f64 {
        let factor: f64 = (0..order).map(|k| f64::from(degree - k)).product();
        if order > degree { 0.0 } else { factor * x.powi(degree - order) }
    };
    for seed in 0..4 {
        let mesh = random_mesh(seed, 40);
        let topology = Topology::new(&mesh);
        for (p, q) in [(3, 3), (1, 2), (0, 3), (0, 0)] {
            let jets: Vec<f64> = topology
                .basis
                .iter()
                .flat_map(|&vertex| {
                    let uv = mesh.parameters(topology.vertices[vertex as usize]);
                    [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(a, b)| power(uv.x, p, a) * power(uv.y, q, b))
                })
                .collect();
            let surface = PhtSurface::new(1, false, mesh.clone(), &jets).unwrap();
            for uv in random_places(&surface, 200) {
                for orders in [(0, 0), (1, 0), (0, 1), (1, 1), (2, 1), (0, 2), (3, 3)] {
                    let mut value = [0.0];
                    surface.derivative(uv, orders, &mut value);
                    let exact = power(uv.x, p, orders.0 as i32) * power(uv.y, q, orders.1 as i32);
                    // cells of 2^-6 differentiate rounding of values below 15^3 as often as asked
                    let tol = 64.0 * f64::EPSILON * 3400.0 * 128f64.powi((orders.0 + orders.1) as i32);
                    assert!((value[0] - exact).abs() <= tol, "{uv} {orders:?}: {} {exact}", value[0]);
                }
            }
        }
    }
}

/// Largest jump of values and first derivatives across all edges, over the largest value on both sides.
fn largest_jump(surface: &PhtSurface) -> f64 {
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let mut largest = 0.0_f64;
    for &leaf in &topology.leaves {
        for neighbour in mesh.neighbours(leaf) {
            let [a, b] = [leaf, neighbour].map(|node| mesh.cell_domain(mesh.cell(node)));
            let (min, max) = (a.min.max(b.min), a.max.min(b.max));
            for s in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let uv = min.lerp(max, s);
                let [x, y] = [leaf, neighbour].map(|node| {
                    let patch = surface.patch(topology.leaf_of(node));
                    let step = patch.domain.size();
                    // differences of a cubic with a step of the cell are exact derivatives of its ordinates
                    let at = |du: f64, dv: f64| patch.eval(uv + DVec2::new(du, dv) * step)[0];
                    let slope =
                        |f: &dyn Fn(f64) -> f64| (8.0 * (f(0.5) - f(-0.5)) - (f(1.0) - f(-1.0))) / 6.0;
                    [at(0.0, 0.0), slope(&|t| at(t, 0.0)) / step.x, slope(&|t| at(0.0, t)) / step.y]
                });
                for (row, (x, y)) in x.iter().zip(y).enumerate() {
                    let scale = if row == 0 { 1.0 } else { 1.0 / a.size().min(b.size()).min_element() };
                    largest = largest.max((x - y).abs() / scale);
                }
            }
        }
    }
    largest
}

#[test]
fn any_jets_make_a_surface_that_is_smooth_across_every_edge() {
    for seed in 0..8 {
        let surface = random_surface(seed, 60, 1, false);
        let levels: Vec<u32> = surface.mesh().leaves().map(|leaf| surface.mesh().cell(leaf).level).collect();
        assert!(levels.iter().max().unwrap() - levels.iter().min().unwrap() > 2, "{levels:?}");
        // patches continued by a whole cell magnify rounding of ordinates of size 1
        let jump = largest_jump(&surface);
        assert!(jump <= 1e4 * f64::EPSILON, "seed {seed}: {jump:e}");
    }
}

#[test]
fn a_split_keeps_the_surface_and_a_merge_takes_it_back_to_the_bit() {
    for is_rational in [false, true] {
        let original = random_surface(11, 40, 3, is_rational);
        let canonical = original.control_points(Basis::Canonical);
        let old: Vec<Vertex> = original.jets().map(|(vertex, _)| vertex).collect();
        for node in original.mesh().leaves() {
            let cell = original.mesh().cell(node);
            let mut surface = original.clone();
            surface.split(&[cell]).unwrap();
            assert!(difference(&original, &surface, 50) <= 32.0 * f64::EPSILON, "{cell:?}");
            // T-vertices that became crossings have the jets they had
            for (vertex, jet) in surface.jets() {
                if original.mesh().role(vertex) != Role::Absent {
                    assert_eq!(jet, original.jet_at(vertex), "{vertex:?}");
                }
            }
            let points = surface.control_points(Basis::Canonical);
            let width = 4 * surface.width();
            for (rank, (vertex, _)) in surface.jets().enumerate() {
                if let Ok(before) = old.binary_search(&vertex) {
                    assert_eq!(points[rank * width..][..width], canonical[before * width..][..width]);
                }
            }
            surface.merge(&[cell]).unwrap();
            assert_eq!(surface, original);
        }
    }
}

#[test]
fn random_sequences_of_splits_and_merges_keep_all_tables_right() {
    let mut random = Random::new(5);
    let mut surface = random_surface(2, 10, 1, false);
    let start = surface.clone();
    let mut splits = Vec::new();
    for step in 0..300 {
        let leaves: Vec<Cell> = surface.mesh().leaves().map(|leaf| surface.mesh().cell(leaf)).collect();
        let cell = leaves[(random.unit() * leaves.len() as f64) as usize];
        if cell.level < 9 && (step % 3 != 0) {
            surface.split(&[cell]).unwrap();
            splits.push(cell);
        } else if let Some(cell) = splits.pop() {
            surface.merge(&[cell]).unwrap();
        }
        let (mesh, topology) = (surface.mesh(), Topology::new(surface.mesh()));
        assert_eq!(mesh.leaf_count(), topology.leaves.len());
        assert_eq!(surface.jets().len(), topology.basis.len());
        for (number, &vertex) in topology.vertices.iter().enumerate() {
            let is_basis = matches!(topology.kinds[number], VertexKind::Basis(_));
            assert_eq!(mesh.role(vertex) == Role::Basis, is_basis, "{vertex:?}");
            assert_eq!(surface.jets.contains_key(&vertex), is_basis, "{vertex:?}");
        }
    }
    assert!(difference(&start, &surface, 200) <= 1e3 * f64::EPSILON);
    while let Some(cell) = splits.pop() {
        surface.merge(&[cell]).unwrap();
    }
    assert_eq!(surface, start);
}

#[test]
fn a_removal_changes_a_cell_that_does_not_touch_it() {
    let cells = [cell(0, 0, 0), cell(1, 0, 0), cell(1, 1, 0), cell(2, 2, 0)];
    let mesh = unit_square(&cells);
    let count = Topology::new(&mesh).basis.len();
    let mut random = Random::new(1);
    let jets: Vec<f64> = (0..4 * count).map(|_| random.signed()).collect();
    let original = PhtSurface::new(1, false, mesh, &jets).unwrap();
    let patch = |surface: &PhtSurface, at| {
        surface.patch(surface.topology().leaf_of(surface.mesh().find(at).unwrap()))
    };
    let far = cell(3, 5, 1);
    let mut surface = original.clone();
    surface.merge(&[cells[1]]).unwrap();
    assert_ne!(patch(&surface, far), patch(&original, far));
    // simplification sees it: what it accepts stays near everywhere
    for tolerance in [1e-3, 1e-1, 1.0, 3.0] {
        let mut surface = original.clone();
        let result = surface.simplify(tolerance).unwrap();
        assert!(result.deviation <= tolerance);
        assert!(difference(&original, &surface, 2000) <= result.deviation + 1e-14);
    }
}

/// A uniform surface with exact jets of a Gaussian bump.
fn bump(level: u32) -> PhtSurface {
    let mut mesh = unit_square(&[]);
    for _ in 0..level {
        let leaves: Vec<NodeId> = mesh.leaves().collect();
        leaves.into_iter().for_each(|leaf| mesh.split(leaf));
    }
    let topology = Topology::new(&mesh);
    let jets: Vec<f64> = topology
        .basis
        .iter()
        .flat_map(|&vertex| {
            let d = mesh.parameters(topology.vertices[vertex as usize]) - DVec2::new(0.4, 0.6);
            let f = 0.5 * (-40.0 * d.length_squared()).exp();
            [f, -80.0 * d.x * f, -80.0 * d.y * f, 6400.0 * d.x * d.y * f]
        })
        .collect();
    PhtSurface::new(1, false, mesh, &jets).unwrap()
}

#[test]
fn simplification_keeps_what_was_promised_and_removes_much() {
    let original = bump(4);
    let mut before = original.coefficient_count();
    for tolerance in [0.0, 1e-4, 1e-3, 1e-2] {
        let mut surface = original.clone();
        let result = surface.simplify(tolerance).unwrap();
        assert!(result.deviation <= tolerance, "{result:?}");
        let measured = difference(&original, &surface, 5000);
        assert!(measured <= tolerance + 1e-15, "asked {tolerance:e}, moved {measured:e}");
        assert!(surface.coefficient_count() <= before, "{tolerance:e}");
        before = surface.coefficient_count();
    }
    assert!(4 * before <= original.coefficient_count(), "{before} are left");
    // a plane needs one cell
    let mut plane = PhtSurface::new(
        1,
        false,
        unit_square(&[]),
        &[0., 1., 2., 0., 2., 1., 2., 0., 1., 1., 2., 0., 3., 1., 2., 0.],
    )
    .unwrap();
    let exact = plane.clone();
    plane.split(&[cell(0, 0, 0), cell(1, 1, 1), cell(2, 2, 2)]).unwrap();
    plane.simplify(1e-12).unwrap();
    assert_eq!(plane, exact);
}

#[test]
fn tensor_surfaces_of_the_parts_and_of_the_whole_are_exact() {
    for is_rational in [false, true] {
        let surface = random_surface(21, 30, 3, is_rational);
        let whole = surface.to_tensor(usize::MAX).unwrap();
        // convex combinations of values of size 1, twice
        assert!(difference(&surface, &whole, 2000) <= 64.0 * f64::EPSILON * 4.0);
        let count = whole.coefficient_count();
        assert!(matches!(surface.to_tensor(count - 1), Err(ConvertError::TooLarge { .. })));
        let mut counts = Vec::new();
        for sigma in 0..7 {
            let patches = surface.to_tensor_patches(sigma).unwrap();
            let area: f64 = patches.iter().map(|patch| patch.domain().size().element_product()).sum();
            let exact = surface.domain().size().element_product();
            assert!((area - exact).abs() <= 64.0 * f64::EPSILON * exact);
            for uv in random_places(&surface, 500) {
                let patch = patches.iter().find(|patch| patch.domain().contains(uv)).unwrap();
                let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
                surface.eval_rows(&[uv], 0, &mut a);
                patch.eval_rows(&[uv], 0, &mut b);
                assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 256.0 * f64::EPSILON), "{sigma} {uv}");
            }
            counts.push(patches.len());
        }
        assert!(counts.windows(2).all(|pair| pair[0] >= pair[1]), "{counts:?}");
        assert_eq!(counts[6], 1);
    }
}

#[test]
fn bicubic_tensor_surfaces_are_converted_exactly() {
    let mut random = Random::new(4);
    for (degree, is_rational) in [([3, 3], false), ([3, 2], true), ([2, 2], true)] {
        let knots = degree.map(|degree| {
            let breaks = [0.0, 0.3, 1.0, 1.0 + degree as f64];
            KnotVector::clamped(&breaks, degree).unwrap()
        });
        let count = knots[0].basis_count() * knots[1].basis_count();
        let points = (0..3 * count).map(|_| random.signed()).collect();
        let weights = is_rational.then(|| (0..count).map(|_| 0.5 + random.unit()).collect());
        let [knots_u, knots_v] = knots;
        let tensor = TensorSurface::new(3, knots_u, knots_v, points, weights).unwrap();
        let surface = PhtSurface::from_tensor(&tensor, &ConvertOptions::default()).unwrap();
        let off = difference(&surface, &tensor, 2000);
        assert!(off <= 1e-14, "{degree:?}: {off:e}");
        for tolerance in [1e-2, 1e-4] {
            let options = ConvertOptions { tolerance, ..Default::default() };
            let near = PhtSurface::from_tensor(&tensor, &options).unwrap();
            assert!(difference(&near, &tensor, 5000) <= tolerance);
        }
    }
}

#[test]
fn a_sphere_octant_takes_one_cell() {
    // rational biquadratic octant of the unit sphere (The NURBS Book, section 8.3)
    let h = 0.5_f64.sqrt();
    let knots = || KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
    let points = [
        [1., 0., 0.],
        [1., 0., 1.],
        [0., 0., 1.],
        [1., 1., 0.],
        [1., 1., 1.],
        [0., 0., 1.],
        [0., 1., 0.],
        [0., 1., 1.],
        [0., 0., 1.],
    ];
    let weights = vec![1., h, 1., h, 0.5, h, 1., h, 1.];
    let tensor = TensorSurface::new(3, knots(), knots(), points.concat(), Some(weights)).unwrap();
    let surface = PhtSurface::from_tensor(&tensor, &ConvertOptions::default()).unwrap();
    assert_eq!(surface.patch_count(), 1);
    for uv in random_places(&surface, 1000) {
        let mut p = [0.0; 3];
        surface.eval_rows(&[uv], 0, &mut p);
        assert!((glam::DVec3::from_array(p).length() - 1.0).abs() <= 8.0 * f64::EPSILON, "{uv}");
    }
}

#[test]
fn conversion_converges_at_order_four() {
    let errors = [4, 5, 6].map(|level| {
        let surface = bump(level);
        let uv = random_places(&surface, 20_000);
        let mut values = vec![0.0; uv.len()];
        surface.eval_rows(&uv, 0, &mut values);
        let exact = |uv: &DVec2| 0.5 * (-40.0 * uv.distance_squared(DVec2::new(0.4, 0.6))).exp();
        uv.iter().zip(values).map(|(uv, value)| (exact(uv) - value).abs()).fold(0.0, f64::max)
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.2, "order {order}");
    }
}

#[test]
fn stitched_edges_have_equal_positions_and_opposite_slopes() {
    use BorderSide::{HighU, HighV, LowU, LowV};
    for (sides, is_reversed) in
        [([HighU, LowU], false), ([HighU, HighU], true), ([LowV, HighV], true), ([HighV, LowU], false)]
    {
        let make = |seed: u64, cells: &[Cell]| {
            let mesh = split_mesh([&[0.0, 2.0], &[-1.0, 0.0]], cells);
            let mut random = Random::new(seed);
            let jets: Vec<f64> =
                (0..12 * Topology::new(&mesh).basis.len()).map(|_| random.signed()).collect();
            PhtSurface::new(3, false, mesh, &jets).unwrap()
        };
        let mut a = make(1, &[cell(0, 0, 0), cell(1, 1, 1), cell(1, 0, 0), cell(2, 0, 0)]);
        let mut b = make(2, &[cell(0, 0, 0), cell(1, 1, 0)]);
        stitch((&mut a, sides[0]), (&mut b, sides[1]), is_reversed).unwrap();
        let place = |side: BorderSide, s: f64| match side {
            LowU => DVec2::new(0.0, s - 1.0),
            HighU => DVec2::new(2.0, s - 1.0),
            LowV => DVec2::new(2.0 * s, -1.0),
            HighV => DVec2::new(2.0 * s, 0.0),
        };
        // derivative away from the edge, over fractions of the domain
        let away = |surface: &PhtSurface, side: BorderSide, s: f64| {
            let mut rows = [0.0; 9];
            surface.eval_rows(&[place(side, s)], 1, &mut rows);
            let row = |k: usize| glam::DVec3::from_slice(&rows[3 * k..]);
            let slope = match side {
                LowU => 2.0 * row(1),
                HighU => -2.0 * row(1),
                LowV => row(2),
                HighV => -row(2),
            };
            (row(0), slope)
        };
        for k in 0..=20 {
            let s = f64::from(k) / 20.0;
            let (p, slope_a) = away(&a, sides[0], s);
            let (q, slope_b) = away(&b, sides[1], if is_reversed { 1.0 - s } else { s });
            assert!((p - q).length() <= 64.0 * f64::EPSILON, "{sides:?} {s}: {p} {q}");
            assert!((slope_a + slope_b).length() <= 1e3 * f64::EPSILON, "{sides:?} {s}: {slope_a} {slope_b}");
        }
    }
}

#[test]
fn local_detail_stays_in_its_support() {
    let original = random_surface(31, 20, 1, false);
    let mut surface = original.clone();
    let region = Domain { min: DVec2::new(-0.6, 11.5), max: DVec2::new(-0.3, 12.0) };
    surface.refine_region(region, 4, 10_000).unwrap();
    assert!(difference(&original, &surface, 500) <= 64.0 * f64::EPSILON);
    let ranks = surface.vertices_in(region);
    assert!(!ranks.is_empty());
    let width: Vec<f64> = ranks.iter().flat_map(|_| [5.0, 0.0, 0.0, 0.0]).collect();
    let before = surface.clone();
    surface.set_jets(&ranks, &width).unwrap();
    let functions = before.basis(Basis::Canonical);
    let mut touched: Vec<usize> =
        ranks.iter().flat_map(|&rank| functions.functions(rank)).map(|form| form.leaf).collect();
    touched.sort_unstable();
    for leaf in (0..surface.patch_count()).filter(|leaf| touched.binary_search(leaf).is_err()) {
        assert_eq!(surface.patch(leaf), before.patch(leaf));
    }
    assert!(surface.refine_region(region, 9, 100).is_err());
}

#[test]
fn fast_evaluation_agrees_with_the_patches() {
    for (splits, dim, is_rational) in [(0, 3, false), (200, 3, false), (60, 2, false), (60, 3, true)] {
        let surface = random_surface(9, splits, dim, is_rational);
        let mut places = random_places(&surface, 500);
        places.extend([surface.domain().min, surface.domain().max]);
        let rows = derivative_rows(2) * dim;
        let (mut values, mut all) = (vec![0.0; places.len() * dim * 3], vec![0.0; places.len() * rows]);
        surface.eval_rows(&places, 1, &mut values);
        surface.eval_rows(&places, 2, &mut all);
        for (k, &uv) in places.iter().enumerate() {
            let index = surface.patch_at(uv);
            assert_eq!(index, surface.topology().leaf_of(surface.mesh().locate(uv)));
            assert!(surface.patch(index).domain.contains(uv));
            let exact = surface.patch(index).eval(uv);
            for c in 0..dim {
                assert!((values[3 * dim * k + c] - exact[c]).abs() <= 1e-14, "{uv}");
            }
            for c in 0..3 * dim {
                // slopes of ordinates of size 1 over cells of 2^-6 / 2
                assert!((values[3 * dim * k + c] - all[rows * k + c]).abs() <= 1e-12, "{uv} {c}");
            }
        }
    }
}

#[test]
fn refusals_name_the_offender_and_change_nothing() {
    let line = |breaks: &[f64]| TMesh::new(breaks, &[0.0, 1.0]).unwrap_err();
    let axis = Axis::U;
    assert_eq!(line(&[0.0, 1.0, 1.0]), PhtError::KnotNotIncreasing { axis, index: 2 });
    assert_eq!(line(&[0.0, f64::NAN]), PhtError::KnotNotFinite { axis, index: 1 });
    assert_eq!(line(&[0.0]), PhtError::KnotCount { axis, count: 1 });
    let mesh = unit_square(&[cell(0, 0, 0)]);
    let data = vec![0.0; 36];
    let refuse = |dim, jets: &[f64]| PhtSurface::new(dim, false, mesh.clone(), jets).unwrap_err();
    assert_eq!(refuse(0, &data), PhtError::Dimension);
    let what = "the data of the vertices";
    assert_eq!(refuse(2, &data), PhtError::Count { what, count: 36, expected: 72 });
    let mut bad = data.clone();
    bad[9] = f64::INFINITY;
    assert_eq!(refuse(1, &bad), PhtError::NotFinite { index: 2 });

    let original = random_surface(1, 5, 1, false);
    let mut surface = original.clone();
    let leaf = surface.mesh().cell(surface.mesh().leaves().next().unwrap());
    let missing = cell(3, 900, 0);
    assert_eq!(surface.split(&[leaf, missing]), Err(PhtError::NotLeaf { index: 1, cell: missing }));
    assert_eq!(surface.split(&[leaf, leaf]), Err(PhtError::NotLeaf { index: 1, cell: leaf }));
    assert_eq!(surface.merge(&[leaf]), Err(PhtError::NotMergeable { index: 0, cell: leaf }));
    assert!(matches!(surface.simplify(f64::NAN), Err(PhtError::Tolerance { .. })));
    assert!(matches!(surface.set_jets(&[9999], &[0.0; 4]), Err(PhtError::NoSuchVertex { index: 9999, .. })));
    assert_eq!(surface, original);
    let mut deep: Vec<Cell> = (0..MAX_LEVEL).map(|level| cell(level, 0, 0)).collect();
    deep.push(cell(MAX_LEVEL, 0, 0));
    let mut surface = PhtSurface::new(1, false, unit_square(&[]), &[0.0; 16]).unwrap();
    assert!(matches!(surface.split(&deep), Err(PhtError::LevelLimit { index: 20, .. })));
    deep.pop();
    surface.split(&deep).unwrap();
    assert_eq!(surface.patch_count(), 61);

    let weights = [1.0, 1.0, 1.0, -1.0];
    let jets: Vec<f64> = weights.iter().flat_map(|&w| [0.0, w, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
    let refused = PhtSurface::new(1, true, unit_square(&[]), &jets);
    assert_eq!(refused.unwrap_err(), PhtError::Weight { index: 0, weight: -1.0 });
    let knots = KnotVector::new(vec![0., 0., 0., 0., 1., 1., 1., 2., 2., 2., 2.], 3).unwrap();
    let crease = TensorSurface::new(1, knots.clone(), knots, vec![0.0; 49], None).unwrap();
    let refused = PhtSurface::from_tensor(&crease, &ConvertOptions::default());
    assert_eq!(refused.unwrap_err(), PhtError::Crease { axis, index: 4 });
}
