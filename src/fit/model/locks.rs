//! What holds samples on creases: nodes of a crease slide along it, nodes at its corners stay.
//!
//! ```text
//!            t = 0   side a    t = 1 = 0   side b        A sharp side runs with its patch on the left. Where the crease
//!     o---------->----------o---------->---------o       goes straight on, what leaves a side goes on on the next one,
//!            interior above                              the first side of the sector at the vertex.
//! ```

use crate::layout::{Layout, Place, Side};
use glam::DVec2;

/// How a sample may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lock {
    /// Over all smooth patches.
    Free,
    /// Along this side of its quad.
    Along(u8),
    /// Not at all: it is a corner of the layout.
    Fixed,
}

/// Weight of a sample at a corner: one node says where a patch ends.
pub(super) const CORNER_WEIGHT: f64 = 30.0;
/// Weight of a node on a crease: it is on the curve, while facets beside it only say where the surface is.
pub(super) const CREASE_WEIGHT: f64 = 3.0;
/// Parameters this near to a side are on it: rounding of maps.
const ON_SIDE: f64 = 1e-9;

impl Lock {
    /// What a sample counts beside one inside a patch.
    pub(super) fn weight(self) -> f64 {
        match self {
            Self::Free => 1.0,
            Self::Along(_) => CREASE_WEIGHT,
            Self::Fixed => CORNER_WEIGHT,
        }
    }
}

/// A place on a sharp side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnCrease {
    side: Side,
    t: f64,
}

impl OnCrease {
    pub(super) fn place(self) -> Place {
        self.side.place(self.t, 0.0)
    }

    pub(super) fn lock(self) -> Lock {
        Lock::Along(self.side.side)
    }

    /// Moved along the crease, over ends of sides where it goes straight on.
    pub(super) fn slide(self, layout: &Layout, step: f64, is_corner: &[bool]) -> Self {
        let Self { side, t } = self;
        let t = t + step;
        let goes_on = |at: Side| {
            let sector = layout.sector_at(at);
            (sector.is_straight() && !is_corner[sector.vertex as usize]).then_some(sector)
        };
        match (goes_on(side), goes_on(side.next())) {
            (Some(sector), _) if t < 0.0 => {
                let before = sector.corners[sector.valence() - 1].previous();
                Self { side: before, t: (1.0 + t).max(0.0) }
            }
            (_, Some(sector)) if t > 1.0 => Self { side: sector.corners[0], t: (t - 1.0).min(1.0) },
            _ => Self { side, t: t.clamp(0.0, 1.0) },
        }
    }
}

/// A sample on a side, for one step.
pub(super) fn on_side(place: Place, side: u8) -> OnCrease {
    let side = Side { quad: place.quad, side };
    OnCrease { side, t: side.coordinates(place.uv)[0] }
}

/// Where a place lies on creases: a vertex is the begin of one side and the end of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Feature {
    /// As a place from which a side leads on.
    pub from: OnCrease,
    /// As a place to which a side leads.
    pub to: OnCrease,
    /// The vertex, if it is one.
    pub vertex: Option<u32>,
}

/// The corner of a quad at parameters.
fn corner_at(place: Place) -> Option<Side> {
    (0..4).map(|side| Side { quad: place.quad, side }).find(|corner| {
        let at = corner.place(0.0, 0.0).uv;
        (at - place.uv).abs().max_element() <= ON_SIDE
    })
}

/// Where a place lies on the creases of a layout; none inside.
pub(super) fn feature_at(layout: &Layout, place: Place) -> Option<Feature> {
    if let Some(corner) = corner_at(place) {
        let sector = layout.sector_at(corner);
        let last = sector.corners[sector.valence() - 1].previous();
        return sector.is_open().then(|| Feature {
            from: OnCrease { side: sector.corners[0], t: 0.0 },
            to: OnCrease { side: last, t: 1.0 },
            vertex: Some(sector.vertex),
        });
    }
    let sides = (0..4).map(|side| Side { quad: place.quad, side });
    let on = |side: Side| {
        let [t, q] = side.coordinates(place.uv);
        (q.abs() <= ON_SIDE && layout.across(side).is_none()).then_some(OnCrease { side, t })
    };
    sides.filter_map(on).next().map(|at| Feature { from: at, to: at, vertex: None })
}

/// The place halfway along a crease from one place to another further on: on one side, or on two that follow each other.
pub(super) fn halfway(layout: &Layout, a: Feature, b: Feature) -> Option<OnCrease> {
    let (from, to) = (a.from, b.to);
    if from.side == to.side {
        return (from.t <= to.t).then_some(OnCrease { t: 0.5 * (from.t + to.t), ..from });
    }
    (layout.sector_at(from.side.next()).corners[0] == to.side).then(|| {
        let half = 0.5 * (1.0 - from.t + to.t);
        if half <= 1.0 - from.t {
            OnCrease { t: from.t + half, ..from }
        } else {
            OnCrease { t: to.t - half, ..to }
        }
    })
}

/// All places that are the same: on either side of a smooth edge, and at every corner of a sector.
pub(super) fn same_places(layout: &Layout, place: Place) -> Vec<Place> {
    if let Some(corner) = corner_at(place) {
        let corners = &layout.sector_at(corner).corners;
        return corners.iter().map(|corner| corner.place(0.0, 0.0)).collect();
    }
    let across = (0..4).filter_map(|side| {
        let side = Side { quad: place.quad, side };
        let [t, q] = side.coordinates(place.uv);
        if q.abs() > ON_SIDE { None } else { Some(layout.across(side)?.place(1.0 - t, 0.0)) }
    });
    std::iter::once(place).chain(across).collect()
}

/// By vertex, whether samples there stay: corners given, and vertices where a crease turns.
pub(super) fn corners(layout: &Layout, given: &[u32]) -> Vec<bool> {
    let turns = |vertex: u32| {
        let mut open = layout.sectors_of(vertex).iter().filter(|sector| sector.is_open());
        given.contains(&vertex) || open.any(|sector| !sector.is_straight())
    };
    (0..layout.vertex_count() as u32).map(turns).collect()
}

/// The lock of a place, and the place itself moved on to its crease to the last bit.
pub(super) fn lock(layout: &Layout, place: Place, is_corner: &[bool]) -> (Lock, Place) {
    match feature_at(layout, place) {
        None => (Lock::Free, place),
        Some(Feature { from, vertex: Some(vertex), .. }) => {
            let lock = if is_corner[vertex as usize] { Lock::Fixed } else { from.lock() };
            (lock, from.place())
        }
        Some(Feature { from, .. }) => (from.lock(), from.place()),
    }
}

/// The derivative along a side of the derivatives along u and v.
pub(super) fn along(side: u8, along_u: glam::DVec3, along_v: glam::DVec3) -> glam::DVec3 {
    let Place { uv, .. } = Side { quad: 0, side }.place(1.0, 0.0);
    let from = Side { quad: 0, side }.place(0.0, 0.0).uv;
    let DVec2 { x, y } = uv - from;
    x * along_u + y * along_v
}
