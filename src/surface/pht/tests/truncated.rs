use super::super::truncated::TruncatedBasis;
use super::super::*;
use crate::samples::Random;
use crate::surface::{Patches, Surface};
use crate::tmesh::Cell;

/// A mesh over uneven lines, of which random leaves were split.
fn ugly_mesh(splits: usize, seed: u64) -> TMesh {
    let mut mesh = TMesh::new(&[-1.0, 0.5, 1.0, 3.0], &[2.0, 3.0, 3.5]).unwrap();
    let mut random = Random::new(seed);
    for _ in 0..splits {
        let leaves: Vec<_> = mesh.leaves().filter(|&leaf| mesh.cell(leaf).level < 5).collect();
        mesh.split(leaves[(random.unit() * leaves.len() as f64) as usize % leaves.len()]);
    }
    mesh
}

/// The mesh in which all cells near a place are split, level after level: functions of several levels are active.
fn nested_mesh() -> TMesh {
    let mut mesh = TMesh::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 6.0], &[0.0, 1.0, 2.0, 3.0, 4.0]).unwrap();
    for (level, reach) in [(0, 2.1), (1, 1.3), (2, 0.7)] {
        let is_near = |mesh: &TMesh, leaf| {
            let middle = mesh.parameters(mesh.cell(leaf).middle());
            mesh.cell(leaf).level == level && middle.distance(DVec2::new(3.0, 2.0)) < reach
        };
        let near: Vec<_> = mesh.leaves().filter(|&leaf| is_near(&mesh, leaf)).collect();
        near.into_iter().for_each(|leaf| mesh.split(leaf));
    }
    mesh
}

fn meshes() -> Vec<TMesh> {
    vec![ugly_mesh(0, 1), ugly_mesh(30, 2), ugly_mesh(200, 3), nested_mesh()]
}

fn random_spline(mesh: TMesh, dim: usize, seed: u64) -> PhtSurface {
    let mut random = Random::new(seed);
    let points: Vec<f64> = (0..dim * TruncatedBasis::new(&mesh).count()).map(|_| random.signed()).collect();
    PhtSurface::truncated(dim, mesh, &points).unwrap()
}

#[test]
fn functions_are_not_negative_and_sum_to_one() {
    for mesh in meshes() {
        let count = TruncatedBasis::new(&mesh).count();
        let mut sum = vec![0.0; 16 * mesh.leaf_count()];
        for function in 0..count {
            let points: Vec<f64> = (0..count).map(|k| f64::from(u8::from(k == function))).collect();
            let surface = PhtSurface::truncated(1, mesh.clone(), &points).unwrap();
            // an ordinate is a sum of products of weights below 1, a few for each of five levels
            let tolerance = 100.0 * f64::EPSILON;
            for leaf in 0..surface.patch_count() {
                let ordinates = surface.patch(leaf).ordinates;
                assert!(ordinates.iter().all(|&x| x >= -tolerance), "{function} on {leaf}: {ordinates:?}");
                sum[16 * leaf..][..16].iter_mut().zip(ordinates).for_each(|(sum, x)| *sum += x);
            }
        }
        let worst = sum.iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst <= 1000.0 * f64::EPSILON, "{worst:e}");
    }
}

/// All derivatives of orders 0 to 2, each times the size of a cell to its order.
fn scaled_jet(surface: &PhtSurface, leaf: usize, uv: DVec2, size: DVec2) -> Vec<f64> {
    let patch = surface.patch(leaf);
    let orders = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];
    // a bicubic polynomial is its own continuation: differences of exact values over the patch
    let h = size / 8.0;
    let at = |a: f64, b: f64| patch.eval(uv + DVec2::new(a, b) * h)[0];
    let line = |order: usize, f: &dyn Fn(f64) -> f64| match order {
        0 => f(0.0),
        1 => (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / 12.0,
        _ => (16.0 * (f(1.0) + f(-1.0)) - (f(2.0) + f(-2.0)) - 30.0 * f(0.0)) / 12.0,
    };
    let of = |&(p, q): &(usize, usize)| line(p, &|a| line(q, &|b| at(a, b)));
    orders.iter().map(of).collect()
}

#[test]
fn second_derivatives_are_continuous_across_lines_of_every_level() {
    for mesh in meshes() {
        let surface = random_spline(mesh.clone(), 1, 7);
        let cells: Vec<Cell> = mesh.leaves().map(|leaf| mesh.cell(leaf)).collect();
        for (leaf, node) in mesh.leaves().enumerate() {
            for other in mesh.neighbours(node) {
                let [a, b] = [node, other].map(|node| mesh.cell_domain(mesh.cell(node)));
                let (min, max) = (a.min.max(b.min), a.max.min(b.max));
                let size = a.size().min(b.size());
                let other = cells.iter().position(|&cell| cell == mesh.cell(other)).unwrap();
                for share in [0.0, 0.3, 1.0] {
                    let at = min + share * (max - min);
                    let [one, two] = [leaf, other].map(|leaf| scaled_jet(&surface, leaf, at, size));
                    // a patch continued by a quarter of its size has values below 10, formulas sum 100 of them
                    for (x, y) in one.iter().zip(&two) {
                        assert!((x - y).abs() <= 1e-12, "{:?} at {at}: {one:?} and {two:?}", cells[leaf]);
                    }
                }
            }
        }
    }
}

#[test]
fn bicubics_and_all_splines_over_fewer_cells_are_reproduced() {
    for mesh in meshes() {
        let cubic = |uv: DVec2| uv.x.powi(3) * uv.y.powi(2) - 2.0 * uv.y.powi(3) + uv.x;
        let jet = |uv: DVec2| {
            let (x, y) = (uv.x, uv.y);
            [cubic(uv), 3.0 * x * x * y * y + 1.0, 2.0 * x.powi(3) * y - 6.0 * y * y, 6.0 * x * x * y]
        };
        let topology = Topology::new(&mesh);
        let vertices = topology.basis.iter().map(|&vertex| topology.vertices[vertex as usize]);
        let jets: Vec<f64> = vertices.flat_map(|vertex| jet(mesh.parameters(vertex))).collect();
        let mut polynomial = PhtSurface::new(1, false, mesh.clone(), &jets).unwrap();
        polynomial.renew_smooth().unwrap();
        let points = polynomial.smooth_control_points().unwrap().to_vec();
        let again = PhtSurface::truncated(1, mesh, &points).unwrap();
        let mut random = Random::new(4);
        for _ in 0..100 {
            let uv = DVec2::new(4.0 * random.unit() - 1.0, 2.0 + 1.5 * random.unit());
            let uv = again.domain().clamp(uv);
            let mut value = [0.0];
            again.eval_rows(&[uv], 0, &mut value);
            // values below 300, blossoms of places up to three cells away are some hundred times as large
            assert!((value[0] - cubic(uv)).abs() <= 1e5 * f64::EPSILON * 300.0, "{uv}: {value:?}");
        }
    }
}

#[test]
fn splits_keep_the_shape_and_the_second_derivatives() {
    for (mesh, seed) in meshes().into_iter().zip(5..) {
        let coarse = random_spline(mesh.clone(), 2, seed);
        assert_eq!(coarse.continuity(), 2);
        let mut same = coarse.clone();
        same.renew_smooth().unwrap();
        let pairs = same.smooth_control_points().unwrap().iter().zip(coarse.smooth_control_points().unwrap());
        // control points below 1: they are determined, so functions are independent
        pairs.for_each(|(x, y)| assert!((x - y).abs() <= 1e-12, "{x} is not {y}"));
        let mut fine = coarse.clone();
        let cells: Vec<Cell> = mesh.leaves().map(|leaf| mesh.cell(leaf)).collect();
        fine.split(&cells[..cells.len().div_ceil(2)]).unwrap();
        assert_eq!(fine.continuity(), 2);
        let points = fine.smooth_control_points().unwrap();
        assert_eq!(fine.coefficient_count(), points.len() / 2);
        let rebuilt = PhtSurface::truncated(2, fine.mesh().clone(), points).unwrap();
        let mut random = Random::new(9);
        for _ in 0..200 {
            let domain = coarse.domain();
            let uv = domain.min + DVec2::new(random.unit(), random.unit()) * domain.size();
            let mut values = [[0.0; 2]; 3];
            for (surface, value) in [&coarse, &fine, &rebuilt].into_iter().zip(&mut values) {
                surface.eval_rows(&[uv], 0, value);
            }
            for value in &values[1..] {
                assert!(value.iter().zip(values[0]).all(|(x, y)| (x - y).abs() <= 1e-12), "{values:?}");
            }
        }
        let first = fine
            .mesh()
            .splits()
            .find(|&cell| fine.mesh().find(cell).is_some_and(|node| fine.mesh().is_mergeable(node)));
        fine.merge(&[first.unwrap()]).unwrap();
        assert_eq!((fine.continuity(), fine.smooth_control_points()), (1, None));
    }
}

#[test]
fn a_full_refinement_has_the_functions_of_a_tensor_product() {
    let mut mesh = TMesh::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0, 3.0]).unwrap();
    for level in 0..3 {
        assert_eq!(TruncatedBasis::new(&mesh).count(), ((2 << level) + 3) * ((3 << level) + 3));
        let leaves: Vec<_> = mesh.leaves().collect();
        leaves.into_iter().for_each(|leaf| mesh.split(leaf));
    }
    let wrong = PhtSurface::truncated(1, mesh.clone(), &[1.0; 3]).unwrap_err();
    assert!(matches!(wrong, PhtError::Count { count: 3, .. }), "{wrong:?}");
    let count = TruncatedBasis::new(&mesh).count();
    let mut points = vec![0.0; count];
    points[5] = f64::NAN;
    assert_eq!(PhtSurface::truncated(1, mesh, &points).unwrap_err(), PhtError::NotFinite { index: 5 });
}
