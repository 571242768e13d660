//! Closest points against exhaustive sampling.
//!
//! The reference is the exact minimum over a 2,000 x 2,000 sampling (its blocks are skipped only where their box
//! is farther than a sample already seen), refined by Newton's method through the public evaluation. It may lie in
//! the wrong basin of two; the answer may not, and it is shown to be a distance to the surface. With trims only
//! samples inside them count.

mod common;

use glam::{DVec2, DVec3};
use planish::Control;
use planish::control::Pool;
use planish::fit::report::Tolerance;
use planish::fit::tensor::{TensorFit, TensorOptions, fit_mesh};
use planish::knots::KnotVector;
use planish::mesh::Mesh;
use planish::query::project::{ProjectOptions, Projection, Projector};
use planish::samples::{self, Random, bumps};
use planish::surface::Surface;
use planish::surface::tensor::TensorSurface;
use std::f64::consts::FRAC_PI_2;

const POINTS: usize = 10_000;
const SAMPLES: usize = 2000;
/// Samples along a side of a block.
const BLOCK: usize = 40;

struct Sampling {
    uv: Vec<DVec2>,
    points: Vec<DVec3>,
    blocks: Vec<(DVec3, DVec3, Vec<u32>)>,
}

impl Sampling {
    /// Of all of the surface, or of what lies inside its trims.
    fn new(surface: &dyn Surface, keep_trims: bool) -> Self {
        let trims = &surface.region().trims;
        let domain = surface.domain();
        let share = |k: usize| k as f64 / (SAMPLES - 1) as f64;
        let place = |i: usize, j: usize| domain.min + DVec2::new(share(i), share(j)) * domain.size();
        let mut uv = Vec::with_capacity(SAMPLES * SAMPLES);
        let mut blocks = Vec::new();
        for block in 0..(SAMPLES / BLOCK) * (SAMPLES / BLOCK) {
            let (bi, bj) = (block / (SAMPLES / BLOCK), block % (SAMPLES / BLOCK));
            let first = uv.len() as u32;
            for k in 0..BLOCK * BLOCK {
                let at = place(bi * BLOCK + k / BLOCK, bj * BLOCK + k % BLOCK);
                if !keep_trims || trims.contains(at) {
                    uv.push(at);
                }
            }
            let samples: Vec<u32> = (first..uv.len() as u32).collect();
            if !samples.is_empty() {
                blocks.push((DVec3::INFINITY, DVec3::NEG_INFINITY, samples));
            }
        }
        let mut rows = vec![0.0; 3 * uv.len()];
        surface.eval_rows(&uv, 0, &mut rows);
        let points: Vec<DVec3> = rows.chunks_exact(3).map(DVec3::from_slice).collect();
        for (min, max, samples) in &mut blocks {
            for &sample in samples.iter() {
                let point = points[sample as usize];
                (*min, *max) = (min.min(point), max.max(point));
            }
        }
        Self { uv, points, blocks }
    }

    fn nearest(&self, point: DVec3) -> DVec2 {
        let gap = |block: &(DVec3, DVec3, Vec<u32>)| (block.0 - point).max(point - block.1).max(DVec3::ZERO);
        let mut order: Vec<(f64, usize)> =
            self.blocks.iter().enumerate().map(|(k, block)| (gap(block).length_squared(), k)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut best, mut at) = (f64::INFINITY, DVec2::NAN);
        for (bound, block) in order {
            if bound > best {
                break;
            }
            for &sample in &self.blocks[block].2 {
                let distance = self.points[sample as usize].distance_squared(point);
                if distance < best {
                    (best, at) = (distance, self.uv[sample as usize]);
                }
            }
        }
        at
    }
}

/// Damped Newton steps within the domain, and the trims if these count, until none lowers the distance.
fn refine(surface: &dyn Surface, keep_trims: bool, point: DVec3, mut uv: DVec2) -> f64 {
    let (domain, trims) = (surface.domain(), &surface.region().trims);
    let at = |uv: DVec2| {
        let mut rows = [0.0; 18];
        surface.eval_rows(&[uv], 2, &mut rows);
        [0, 3, 6, 9, 12, 15].map(|k| DVec3::from_slice(&rows[k..]))
    };
    let mut best = at(uv)[0].distance(point);
    for _ in 0..50 {
        let [s, su, sv, suu, suv, svv] = at(uv);
        let r = s - point;
        let (p, q) = (r.dot(su), r.dot(sv));
        let (a, b, c) = (su.dot(su) + r.dot(suu), su.dot(sv) + r.dot(suv), sv.dot(sv) + r.dot(svv));
        let newton = DVec2::new(b * q - c * p, b * p - a * q) / (a * c - b * b);
        let candidates = [newton, DVec2::new(-p / a, 0.0), DVec2::new(0.0, -q / c)];
        let mut is_lower = false;
        for step in candidates.into_iter().filter(|step| step.is_finite()) {
            let next = domain.clamp(uv + step);
            let distance = at(next)[0].distance(point);
            if distance < best && (!keep_trims || trims.contains(next)) {
                (best, uv, is_lower) = (distance, next, true);
                break;
            }
        }
        if !is_lower {
            break;
        }
    }
    best
}

fn diagonal(sampling: &Sampling) -> f64 {
    let min = sampling.points.iter().fold(DVec3::INFINITY, |min, &p| min.min(p));
    let max = sampling.points.iter().fold(DVec3::NEG_INFINITY, |max, &p| max.max(p));
    min.distance(max)
}

/// Points at distances from 0 to 2 diagonals, as many near as far.
fn scattered(sampling: &Sampling, diagonal: f64, count: usize) -> Vec<DVec3> {
    let mut random = Random::new(7);
    (0..count)
        .map(|k| {
            let near = sampling.points[(random.unit() * sampling.points.len() as f64) as usize];
            let direction = DVec3::new(random.signed(), random.signed(), random.signed());
            let length = if k % 50 == 0 { 0.0 } else { 2.0 * diagonal * 10f64.powf(-5.0 * random.unit()) };
            near + length * direction.normalize_or_zero()
        })
        .collect()
}

fn check(name: &str, surface: &dyn Surface) {
    check_within(name, surface, false);
}

fn check_within(name: &str, surface: &dyn Surface, keep_trims: bool) {
    let sampling = Sampling::new(surface, keep_trims);
    let diagonal = diagonal(&sampling);
    let points = scattered(&sampling, diagonal, POINTS);
    let rows: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect();
    let projector = Projector::new(surface).unwrap();
    let options = ProjectOptions { keep_trims, ..ProjectOptions::default() };
    let projection = projector.project(&rows, &options, &Pool::new(0)).unwrap();
    assert_eq!((projection.missed(), projection.unproven()), (0, 0));
    let Projection { uv, distances, .. } = projection;
    let mut values = vec![0.0; 3 * POINTS];
    surface.eval_rows(&uv, 0, &mut values);
    for (k, point) in points.iter().enumerate() {
        assert!(surface.domain().contains(uv[k]));
        // the distance is that of the place returned; a value is a sum of 16 terms of the surface's size
        let distance = DVec3::from_slice(&values[3 * k..]).distance(*point);
        let tol = 64.0 * f64::EPSILON * (diagonal + point.length());
        assert!((distance - distances[k]).abs() <= tol, "{name} {k}: {distance} is not {}", distances[k]);
        let reference = refine(surface, keep_trims, *point, sampling.nearest(*point));
        assert!(distances[k] <= reference + 1e-9 * diagonal, "{name} {k}: {} > {reference}", distances[k]);
    }
}

fn net(counts: [usize; 2], place: impl Fn(f64, f64) -> DVec3) -> TensorSurface {
    let knots = |count: usize| {
        let breaks: Vec<f64> = (0..count - 2).map(|k| k as f64).collect();
        KnotVector::clamped(&breaks, 3).unwrap()
    };
    let share = |k: usize, count: usize| k as f64 / (count - 1) as f64;
    let points = (0..counts[0] * counts[1])
        .flat_map(|k| place(share(k / counts[1], counts[0]), share(k % counts[1], counts[1])).to_array());
    TensorSurface::new(3, knots(counts[0]), knots(counts[1]), points.collect(), None).unwrap()
}

/// Control points and weights of a circle arc of `quarters` right angles.
fn arc(quarters: usize) -> (KnotVector, Vec<(DVec2, f64)>) {
    let knots = [0, 0, 0].into_iter().chain((1..quarters).flat_map(|k| [k, k])).chain([quarters; 3]);
    let knots = KnotVector::new(knots.map(|k| k as f64).collect(), 2).unwrap();
    let points = (0..=2 * quarters).map(|k| {
        let weight = if k % 2 == 0 { 1.0 } else { 0.5_f64.sqrt() };
        (DVec2::from_angle(k as f64 * FRAC_PI_2 / 2.0) / weight, weight)
    });
    (knots, points.collect())
}

fn torus() -> TensorSurface {
    let ((knots_u, around), (knots_v, tube)) = (arc(3), arc(4));
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for &(a, weight_a) in &around {
        for &(t, weight_t) in &tube {
            let radius = 1.0 + 0.4 * t.x;
            points.extend([radius * a.x, radius * a.y, 0.4 * t.y]);
            weights.push(weight_a * weight_t);
        }
    }
    TensorSurface::new(3, knots_u, knots_v, points, Some(weights)).unwrap()
}

#[test]
fn a_torus_piece_has_no_nearer_sample() {
    check("torus", &torus());
}

#[test]
fn a_wave_has_no_nearer_sample() {
    check("wave", &net([30, 20], |u, v| DVec3::new(u, v, 0.1 * (12.0 * u).sin() * (9.0 * v).cos())));
}

#[test]
fn a_sheet_folded_over_itself_has_no_nearer_sample() {
    let fold = |u: f64, v: f64| {
        let angle = 3.0 * std::f64::consts::PI * u;
        DVec3::new(angle.cos(), 0.8 * v + 0.02 * (5.0 * u).sin(), 0.05 * angle)
    };
    check("fold", &net([40, 12], fold));
}

#[test]
fn a_fit_has_no_nearer_sample() {
    let (mesh, _) = bumps([60, 60], 20, 3).unwrap();
    let fit = fit_mesh(&mesh, &TensorOptions::default(), &mut Control::new(0)).unwrap();
    check("bumps", &fit.surface);
}

#[test]
fn a_fit_of_a_scan_has_no_nearer_sample() {
    for (name, count) in [("bust", 17), ("igea_disk_43k.ply", 65)] {
        let Some(mesh) = common::mesh(name) else { continue };
        let options = TensorOptions { fixed_grid: Some([count; 2]), ..TensorOptions::default() };
        let fit = fit_mesh(&mesh, &options, &mut Control::new(0)).unwrap();
        check(name, &fit.surface);
    }
}

fn fit(mesh: &Mesh, tolerance: f64) -> TensorFit {
    let tolerance = Tolerance { value: tolerance, ..Tolerance::default() };
    let options = TensorOptions { tolerance, max_grid: 65, ..TensorOptions::default() };
    fit_mesh(mesh, &options, &mut Control::new(0)).unwrap()
}

/// No node is farther from a fit than from its own place, which lies inside the trims.
fn check_nodes(name: &str, mesh: &Mesh, fit: &TensorFit) {
    let points: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let projector = Projector::new(&fit.surface).unwrap();
    let projection = projector.project(&points, &ProjectOptions::default(), &Pool::new(0)).unwrap();
    assert_eq!((projection.missed(), projection.unproven()), (0, 0), "{name}");
    for (n, (distance, own)) in projection.distances.iter().zip(&fit.errors).enumerate() {
        let limit = own + 1e-12 * fit.report.diagonal;
        assert!(
            *distance <= limit,
            "{name}, node {n}: {distance} from the surface, {own} from its own place"
        );
    }
}

#[test]
fn nodes_are_no_farther_than_from_their_own_places() {
    let holed =
        [samples::planar(5), samples::curved_notch(3), samples::sphere_with_holes(3000, 2), samples::wing()];
    for (k, mesh) in holed.into_iter().enumerate() {
        let mesh = mesh.unwrap();
        for tolerance in [1e-2, 1e-4] {
            check_nodes(&format!("sample {k}"), &mesh, &fit(&mesh, tolerance));
        }
    }
    for name in
        ["neon_side_holes_16k.off", "airplane_holes_8k.off", "igea_disk_43k.ply", "mask_control_1290.off"]
    {
        let Some(mesh) = common::mesh(name) else { continue };
        check_nodes(name, &mesh, &fit(&mesh, 1e-2));
    }
}

#[test]
fn inside_the_trims_of_a_holed_sphere_no_sample_is_nearer() {
    let mesh = samples::sphere_with_holes(3000, 2).unwrap();
    check_within("sphere with holes", &fit(&mesh, 1e-3).surface, true);
}

#[test]
fn inside_the_trims_of_real_fits_no_sample_is_nearer() {
    for name in ["neon_side_holes_16k.off", "airplane_holes_8k.off"] {
        let Some(mesh) = common::mesh(name) else { continue };
        check_within(name, &fit(&mesh, 1e-2).surface, true);
    }
}
