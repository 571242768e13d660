mod basis;
mod convert;
mod edit;
mod truncated;

use super::*;
use crate::knots::KnotVector;
use crate::samples::Random;
use crate::surface::derivative_rows;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::tmesh::{Cell, MAX_LEVEL, NodeId, Role, TMeshError, VertexKind};

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
    assert_eq!(line(&[0.0, 1.0, 1.0]), TMeshError::KnotNotIncreasing { axis, index: 2 });
    assert_eq!(line(&[0.0, f64::NAN]), TMeshError::KnotNotFinite { axis, index: 1 });
    assert_eq!(line(&[0.0]), TMeshError::KnotCount { axis, count: 1 });
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
    assert_eq!(surface.split(&[leaf, missing]), Err(TMeshError::NotLeaf { index: 1, cell: missing }.into()));
    assert_eq!(surface.split(&[leaf, leaf]), Err(TMeshError::NotLeaf { index: 1, cell: leaf }.into()));
    assert_eq!(surface.merge(&[leaf]), Err(TMeshError::NotMergeable { index: 0, cell: leaf }.into()));
    assert!(matches!(surface.simplify(f64::NAN), Err(PhtError::Tolerance { .. })));
    assert!(matches!(surface.set_jets(&[9999], &[0.0; 4]), Err(PhtError::NoSuchVertex { index: 9999, .. })));
    assert_eq!(surface, original);
    let mut deep: Vec<Cell> = (0..MAX_LEVEL).map(|level| cell(level, 0, 0)).collect();
    deep.push(cell(MAX_LEVEL, 0, 0));
    let mut surface = PhtSurface::new(1, false, unit_square(&[]), &[0.0; 16]).unwrap();
    assert!(matches!(surface.split(&deep), Err(PhtError::Mesh(TMeshError::LevelLimit { index: 20, .. }))));
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
