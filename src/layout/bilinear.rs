//! Bilinear maps over the square.

use crate::linalg::shares;
use glam::DVec2;

/// Newton steps: in a convex quad that is not nearly flat five are enough for all digits.
const STEPS: usize = 20;

/// The parameters, in `[0,1]^2`, at which the bilinear map with these values at (0,0), (1,0), (1,1), (0,1) has a value, or
/// the nearest that Newton's method comes to: the quad is convex.
pub(super) fn place_in(quad: &[DVec2; 4], point: DVec2) -> DVec2 {
    let mut uv = DVec2::splat(0.5);
    for _ in 0..STEPS {
        let [low, high] = [quad[0].lerp(quad[1], uv.x), quad[3].lerp(quad[2], uv.x)];
        let along = (quad[1] - quad[0]).lerp(quad[2] - quad[3], uv.y);
        let across = high - low;
        let off = point - low.lerp(high, uv.y);
        uv = (uv + shares(off, along, across)).clamp(DVec2::ZERO, DVec2::ONE);
    }
    uv
}
