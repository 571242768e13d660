//! Where there are no data, in holes and beyond the border, surfaces stay near the box of their data, and what is too much
//! to ask for does them no harm.

mod common;

use glam::DVec2;
use planish::Control;
use planish::fit::pht::{self, PhtOptions};
use planish::fit::report::{FitReport, Remarks, Tolerance};
use planish::fit::tensor::{self, Knots, TensorOptions};
use planish::geometry::Bounds;
use planish::mesh::Mesh;
use planish::samples;
use planish::surface::Surface;

/// How far a surface leaves a box anywhere on its domain, as a share of the diagonal.
fn excursion(surface: &dyn Surface, bounds: &Bounds) -> f64 {
    const SAMPLES: usize = 400;
    let domain = surface.domain();
    let mut away: f64 = 0.0;
    for i in 0..=SAMPLES {
        let along = |k: usize, from: f64, to: f64| {
            let share = k as f64 / SAMPLES as f64;
            from * (1.0 - share) + to * share
        };
        let u = along(i, domain.min.x, domain.max.x);
        let line: Vec<DVec2> =
            (0..=SAMPLES).map(|j| DVec2::new(u, along(j, domain.min.y, domain.max.y))).collect();
        let mut rows = vec![0.0; 3 * line.len()];
        surface.eval_rows(&line, 0, &mut rows);
        away = rows.chunks_exact(3).map(|row| bounds.distance(row)).fold(away, f64::max);
    }
    away / bounds.diagonal()
}

/// Fits of every family that has a domain with places beyond the data.
fn fits(mesh: &Mesh, tolerance: f64) -> Vec<(&'static str, f64, FitReport)> {
    let tolerance = Tolerance { value: tolerance, ..Tolerance::default() };
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let bounds = Bounds::of_rows(&values, 3);
    let control = &mut Control::new(2);
    let mut all = Vec::new();
    for (name, knots) in [("uniform", Knots::Uniform), ("adaptive", Knots::Adaptive)] {
        let options = TensorOptions { tolerance, knots, ..TensorOptions::default() };
        let fit = tensor::fit_mesh(mesh, &options, control).unwrap();
        all.push((name, excursion(&fit.surface, &bounds), fit.report));
    }
    let options = PhtOptions { tolerance, ..PhtOptions::default() };
    let fit = pht::fit_mesh(mesh, &options, control).unwrap();
    all.push(("PHT", excursion(&fit.surface, &bounds), fit.report));
    all
}

fn check(name: &str, mesh: &Mesh, tolerance: f64) {
    for (family, away, report) in fits(mesh, tolerance) {
        println!(
            "{name:24} {family:8} {tolerance:.0e} away {away:.4} max {:.6e} coefficients {} stop {:?} seconds {:.2}",
            report.max_error / report.diagonal,
            report.coefficient_count,
            report.stop,
            report.seconds,
        );
        let most = match family {
            // more cells are taken only beyond a quarter
            "PHT" | "uniform" => 0.25,
            // a mesh that one chart does not suit is missed by more than that where there are data
            _ if report.remarks.has(Remarks::SEGMENTATION_ADVISED) => 0.2,
            _ => 0.1,
        };
        assert!(away <= most, "{name}, {family}: {away}");
    }
}

#[test]
fn fits_of_the_samples() {
    for (name, mesh) in [
        ("planar", samples::planar(1)),
        ("curved notch", samples::curved_notch(2)),
        ("sphere with holes", samples::sphere_with_holes(3000, 5)),
        ("cylinder", samples::cylinder_patch(2000, 1)),
        ("fuselage panel", samples::fuselage_panel(1)),
        ("half fuselage", samples::half_fuselage()),
        ("wing", samples::wing()),
        ("hat", samples::hat(1)),
        ("roof", samples::roof(1)),
    ] {
        check(name, &mesh.unwrap(), 1e-2);
    }
}

#[test]
fn fits_of_real_meshes() {
    for name in [
        "neon_side_holes_16k.off",
        "airplane_holes_8k.off",
        "mask_control_1290.off",
        "maxface_disk_4k.off",
        "camelhead_disk_11k.off",
        "mannequin_disk_13k.off",
        "blow_shell_displacement.ply",
    ] {
        let Some(mut mesh) = common::mesh(name) else { continue };
        mesh.clear_parameters();
        check(name, &mesh, 1e-2);
    }
}

/// A sheet with a finger on it, whose nodes lie close to each other in a map of the whole; no parameters.
fn finger(height: f64, side: usize, seed: u64) -> Mesh {
    let (places, triangles) = samples::grid([side, side], 0.3, seed, |_| true);
    let mut random = samples::Random::new(seed);
    let points = places.iter().map(|&p| {
        let from_tip = ((p - 0.5).length() - 0.05) / 0.1;
        p.extend(height * (1.0 - from_tip.clamp(0.0, 1.0)) + 1e-3 * random.signed())
    });
    Mesh::new(points.collect(), triangles).unwrap()
}

#[test]
fn what_is_missed_is_missed_by_no_more_than_could_be_had() {
    for (height, side, seed) in [(1.0, 40, 1), (2.0, 40, 1), (8.0, 60, 2), (8.0, 80, 4)] {
        let mesh = finger(height, side, seed);
        for value in [1e-2, 3e-3, 1e-3] {
            let tolerance = Tolerance { value, ..Tolerance::default() };
            let options = TensorOptions { tolerance, knots: Knots::Uniform, ..TensorOptions::default() };
            let report = tensor::fit_mesh(&mesh, &options, &mut Control::new(2)).unwrap().report;
            let away = report.max_error / report.diagonal;
            // there is a surface within 1e-2, whatever is asked; that holds for these sheets, not for all: what counts is the
            // larger of the errors at the nodes and between them, and a finger of 4 on 60 nodes a side ends at 1.03e-2
            assert!(away <= 1e-2, "a finger of {height}, {side} nodes a side, within {value}: {away}");
        }
    }
}
