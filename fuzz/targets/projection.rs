//! Closest points on surfaces of any control points: never farther than the best of a grid of places, and in the domain.
#![no_main]

use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use planish::control::Pool;
use planish::knots::KnotVector;
use planish::query::project::{ProjectOptions, Projector};
use planish::surface::Surface;
use planish::surface::tensor::TensorSurface;

fuzz_target!(|input: ([[i8; 3]; 16], Vec<[i8; 3]>)| {
    let (control, points) = input;
    let number = |x: i8| f64::from(x) / 16.0;
    let knots = || KnotVector::clamped(&[0.0, 1.0], 3).expect("knots that rise");
    let control = control.iter().flatten().map(|&x| number(x)).collect();
    let surface = TensorSurface::new(3, knots(), knots(), control, None).expect("sixteen control points");
    let points: Vec<f64> = points.iter().take(8).flatten().map(|&x| number(x)).collect();
    let Ok(projector) = Projector::new(&surface) else { return };
    let nearest = projector.project(&points, &ProjectOptions::default(), &Pool::new(1)).expect("finite points");
    let grid: Vec<DVec2> = (0..81).map(|k| DVec2::new(f64::from(k % 9), f64::from(k / 9)) / 8.0).collect();
    let mut rows = vec![0.0; 3 * grid.len()];
    surface.eval_rows(&grid, 0, &mut rows);
    for (point, (uv, distance)) in points.chunks_exact(3).zip(nearest.uv.iter().zip(nearest.distances)) {
        assert!(uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all(), "{uv}");
        let away = |row: &[f64]| row.iter().zip(point).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        let best = rows.chunks_exact(3).map(away).fold(f64::INFINITY, f64::min);
        assert!(distance <= best * (1.0 + 1e-9) + 1e-9, "{point:?}: {distance}, but {best} on the grid");
    }
});
