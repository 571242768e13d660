//! Two halves of a shell, for the tests of sides that are given.

use crate::surface::{Surface, normal};
use glam::{DVec2, DVec3};

/// Parameters are as large as they are.
pub(in crate::fit) const RANGE: DVec2 = DVec2::new(7.0, 0.2);

/// The shell, over x from 0 to 2.
pub(in crate::fit) fn shell(x: f64, y: f64) -> [f64; 3] {
    [x, y + 0.1 * x * y, 0.3 * (1.7 * x).sin() * (1.0 + y) + 0.2 * (3.0 * y).cos()]
}

/// Its half from `from` on, with places on the sides, in no order.
pub(in crate::fit) fn half(from: f64) -> (Vec<DVec2>, Vec<f64>) {
    let place = |k: u32| DVec2::new(f64::from(k / 40), f64::from(k % 40)) / 39.0;
    let uv: Vec<DVec2> = (0..1600).map(|k| place(k * 7 % 1600)).collect();
    let values = uv.iter().flat_map(|uv| shell(from + uv.x, uv.y)).collect();
    (uv.into_iter().map(|uv| RANGE * uv).collect(), values)
}

/// Places and first derivatives along a line of u, a share of the range.
fn rows(surface: &dyn Surface, u: f64) -> Vec<[DVec3; 3]> {
    let uv: Vec<DVec2> = (0..=100).map(|k| RANGE * DVec2::new(u, f64::from(k) / 100.0)).collect();
    let mut rows = vec![0.0; 9 * uv.len()];
    surface.eval_rows(&uv, 1, &mut rows);
    rows.chunks(9).map(|row| [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]))).collect()
}

/// The end of u of one surface and the begin of the other are one curve, with the same tangent planes, and go the same way.
pub(in crate::fit) fn assert_smooth(first: &dyn Surface, second: &dyn Surface, diagonal: f64) {
    for ([a, au, av], [b, bu, bv]) in rows(first, 1.0).into_iter().zip(rows(second, 0.0)) {
        assert!(a.distance(b) <= 1e-12 * diagonal, "{a} {b}");
        let angle = normal(au, av).cross(normal(bu, bv)).length();
        assert!(angle <= 1e-10, "{angle:e}");
        assert!(au.dot(bu) > 0.0);
    }
}

/// Both surfaces have the same curves at the ends of u.
pub(in crate::fit) fn assert_same_ends(first: &dyn Surface, second: &dyn Surface, diagonal: f64) {
    for u in [0.0, 1.0] {
        for ([a, ..], [b, ..]) in rows(first, u).into_iter().zip(rows(second, u)) {
            assert!(a.distance(b) <= 1e-12 * diagonal, "{a} {b}");
        }
    }
}
