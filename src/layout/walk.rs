//! Ways over the edges of a layout.

use super::{Layout, Place, Side};
use glam::DVec2;

impl Layout {
    /// The place that parameters beyond a quad stand for: what lies across an edge belongs to the neighbour, to
    /// first order (`q` becomes `-q`). What lies beyond a border, or still outside after two edges, is moved to
    /// the nearest place.
    pub fn cross(&self, quad: u32, uv: DVec2) -> Place {
        let mut place = Place { quad, uv };
        // twice around: past a corner two edges are crossed
        for side in [0, 1, 2, 3, 0, 1, 2, 3] {
            let side = Side { quad: place.quad, side };
            let [t, q] = side.coordinates(place.uv);
            if q < 0.0
                && let Some(other) = self.across(side)
            {
                place = other.place(1.0 - t, -q);
            }
        }
        Place { uv: place.uv.clamp(DVec2::ZERO, DVec2::ONE), ..place }
    }

    /// The parameters of a place as a quad would continue: on itself, or on a neighbour unfolded over their edge by
    /// `B(s, q) = A(s + q g(s), -q)`, g linear between the balances of the ends. Of neighbours over several edges, or of
    /// a quad that meets itself around a handle, it is the way that ends nearest to the parameters `near`. None for all
    /// other quads.
    pub fn unfold(&self, quad: u32, place: Place, near: DVec2) -> Option<DVec2> {
        let over = |side: u8| {
            let side = Side { quad, side };
            let other = self.across(side).filter(|other| other.quad == place.quad)?;
            let [t, q] = other.coordinates(place.uv);
            let [c_0, c_1] = [side, side.next()].map(|corner| self.sector_at(corner).balance());
            let s = 1.0 - t;
            let g = c_0 * (1.0 - s) - c_1 * s;
            Some(side.place(s + q * g, -q).uv)
        };
        let itself = (place.quad == quad).then_some(place.uv);
        let ways = itself.into_iter().chain((0..4).filter_map(over));
        ways.min_by(|a, b| a.distance_squared(near).total_cmp(&b.distance_squared(near)))
    }
}
