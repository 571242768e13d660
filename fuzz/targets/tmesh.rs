//! Splits and merges of a PHT-spline in any order: each is done or refused, the shape stays where nothing is lost, and
//! splits that are undone leave what was there.
#![no_main]

use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use planish::surface::Surface;
use planish::surface::pht::PhtSurface;
use planish::tmesh::{Cell, TMesh};

fn value(surface: &PhtSurface, uv: DVec2) -> f64 {
    let mut row = [0.0];
    surface.eval_rows(&[uv], 0, &mut row);
    row[0]
}

fuzz_target!(|input: ([u8; 4], Vec<(bool, u8, u16, u16)>)| {
    let ([m, n, ..], edits) = input;
    let breaks = |count: u8| (0..=1 + count % 3).map(f64::from).collect::<Vec<_>>();
    let mesh = TMesh::new(&breaks(m), &breaks(n)).expect("breaks that rise");
    let mut surface = PhtSurface::zero(1, false, mesh).expect("one number is a dimension");
    let count = surface.jets().len();
    let ranks: Vec<usize> = (0..count).collect();
    let jets: Vec<f64> = (0..4 * count).map(|k| f64::from((k * 37 % 11) as u32) - 5.0).collect();
    surface.set_jets(&ranks, &jets).expect("a jet for each vertex");
    let domain = surface.domain();
    let places: Vec<DVec2> =
        (0..25).map(|k| domain.min + (domain.max - domain.min) * DVec2::new(f64::from(k % 5), f64::from(k / 5)) / 4.0).collect();
    for (is_merge, level, i, j) in edits.into_iter().take(40) {
        let cell = Cell { level: u32::from(level % 8), i: u32::from(i), j: u32::from(j) };
        let before: Vec<f64> = places.iter().map(|&uv| value(&surface, uv)).collect();
        if is_merge {
            drop(surface.merge(&[cell]));
            continue;
        }
        if surface.split(&[cell]).is_ok() {
            for (&uv, before) in places.iter().zip(before) {
                let after = value(&surface, uv);
                assert!((after - before).abs() <= 1e-10, "{uv}: {before} became {after}");
            }
        }
    }
    assert_eq!(surface.mesh().leaves().count(), surface.mesh().leaf_count());
});
