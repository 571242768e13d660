//! Trims of any shape: refused with a reason, or the surface inside them is a mesh whose nodes lie in the domain.
#![no_main]

use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use planish::knots::KnotVector;
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::surface::tensor::TensorSurface;
use planish::surface::{Surface, Trims};

/// A wavy sheet of 4 by 4 control points over the unit square.
fn sheet(heights: &[u8; 16]) -> TensorSurface {
    let knots = || KnotVector::clamped(&[0.0, 0.5, 1.0], 2).expect("knots that rise");
    let points = (0..16).flat_map(|k| {
        [(k / 4) as f64 / 3.0, (k % 4) as f64 / 3.0, f64::from(heights[k]) / 256.0]
    });
    TensorSurface::new(3, knots(), knots(), points.collect(), None).expect("as many points as the knots ask for")
}

fuzz_target!(|input: ([u8; 16], Vec<Vec<[u16; 2]>>)| {
    let (heights, loops) = input;
    if loops.iter().map(Vec::len).sum::<usize>() > 60 {
        return;
    }
    let mut surface = sheet(&heights);
    // coarse steps, so that loops touch, cross and repeat themselves
    let place = |&[u, v]: &[u16; 2]| DVec2::new(f64::from(u % 33) / 32.0, f64::from(v % 33) / 32.0);
    let loops = loops.iter().map(|nodes| nodes.iter().map(place).collect()).collect();
    let Ok(trims) = Trims::new(loops, &surface.domain()) else { return };
    surface.region_mut().trims = trims;
    let options = TessellateOptions { chord_tolerance: 0.05, max_points: 20_000, ..TessellateOptions::default() };
    let Ok(made) = tessellate(&surface, &options) else { return };
    let domain = surface.domain();
    for uv in made.mesh.parameters().expect("a tessellation has parameters") {
        assert!(uv.cmpge(domain.min).all() && uv.cmple(domain.max).all(), "{uv}");
    }
});
