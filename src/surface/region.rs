//! What a surface knows of its data in the parameter plane: a box and boundary loops.

use super::cut::{HalfPlane, cut};
use super::label::Label;
use crate::failure::{Classify, ErrorKind};
use crate::geometry::{Domain, Orientation, orientation};
use crate::memory::{self, CollectVec};
use glam::DVec2;
use std::sync::OnceLock;

/// A trim is not one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrimError {
    /// A loop of fewer than three points encloses nothing.
    #[error("trim {index} has {count} points, at least 3 are needed")]
    TooShort {
        /// The loop.
        index: usize,
        /// Its points.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {point} of trim {index} is not finite")]
    NotFinite {
        /// The loop.
        index: usize,
        /// The point in it.
        point: usize,
    },
    /// A point lies outside the surface's domain.
    #[error("point {point} of trim {index} lies outside the domain")]
    Outside {
        /// The loop.
        index: usize,
        /// The point in it.
        point: usize,
    },
}

impl Classify for TrimError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::TooShort { .. } => ErrorKind::InvalidArgument,
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Outside { .. } => ErrorKind::Outside,
        }
    }

    /// The offending loop.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::TooShort { index, .. } | Self::NotFinite { index, .. } | Self::Outside { index, .. } => {
                Some(index)
            }
        }
    }
}

/// Closed polylines in the parameter plane that bound the part of a surface that counts. The first point
/// of a loop is not repeated. A point is inside when a ray from it crosses the loops an odd number of
/// times, so the outer loop and the holes may have any direction.
#[derive(Debug, Clone, Default)]
pub struct Trims {
    loops: Vec<Vec<DVec2>>,
    bands: OnceLock<Bands>,
}

impl PartialEq for Trims {
    fn eq(&self, other: &Self) -> bool {
        self.loops == other.loops
    }
}

impl Trims {
    /// Checks and keeps `loops`, the outer one first.
    pub fn new(loops: Vec<Vec<DVec2>>, domain: &Domain) -> Result<Self, TrimError> {
        for (index, polyline) in loops.iter().enumerate() {
            if polyline.len() < 3 {
                return Err(TrimError::TooShort { index, count: polyline.len() });
            }
            if let Some(point) = polyline.iter().position(|p| !p.is_finite()) {
                return Err(TrimError::NotFinite { index, point });
            }
            if let Some(point) = polyline.iter().position(|&p| !domain.contains(p)) {
                return Err(TrimError::Outside { index, point });
            }
        }
        Ok(Self { loops, bands: OnceLock::new() })
    }

    /// The loops, the outer one first; none when the whole domain counts.
    pub fn loops(&self) -> &[Vec<DVec2>] {
        &self.loops
    }

    /// Whether the whole domain counts.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty()
    }

    /// Whether a point counts: it lies inside, or exactly on a loop.
    pub fn contains(&self, uv: DVec2) -> bool {
        self.is_empty() || self.bands.get_or_init(|| Bands::new(&self.loops)).holds(uv)
    }

    /// The sides of all loops.
    pub fn segments(&self) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
        segments(&self.loops)
    }
}

fn segments(loops: &[Vec<DVec2>]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    loops.iter().flat_map(|polyline| polyline.iter().copied().zip(polyline.iter().copied().cycle().skip(1)))
}

/// Trim segments sorted into horizontal bands, so that a point is tested against the few in its own.
///
/// A band for each segment makes bands and entries linear for loops of even pace. Of long segments, as in a comb, each
/// would be in most of the bands: there are fewer then, so that entries stay linear, and a band has no more of them than
/// a line across the loops meets on the average.
#[derive(Debug, Clone)]
struct Bands {
    start: f64,
    bands_per_unit: f64,
    segments: Vec<Vec<(DVec2, DVec2)>>,
}

/// How often a segment may be in a band beyond the first, on the average: loops of even pace meet a line twice, and keep
/// a band for each segment.
const ENTRIES_PER_SEGMENT: f64 = 3.0;

impl Bands {
    fn new(loops: &[Vec<DVec2>]) -> Self {
        let domain = Domain::around(loops.iter().flatten().copied());
        let count: usize = loops.iter().map(Vec::len).sum();
        let start = domain.min.y;
        let height = domain.size().y.max(f64::MIN_POSITIVE);
        let met = segments(loops).map(|(a, b)| (b.y - a.y).abs()).sum::<f64>() / height;
        // each segment is in one band, and in one more for each border between bands that it meets
        let bearable = ENTRIES_PER_SEGMENT * count as f64 / met.max(1.0);
        let band_count = (bearable.ceil() as usize).clamp(1, count.max(1));
        let bands_per_unit = band_count as f64 / height;
        let mut bands = Self { start, bands_per_unit, segments: memory::filled(Vec::new(), band_count + 1) };
        for (a, b) in segments(loops) {
            let (low, high) = (bands.band(a.y.min(b.y)), bands.band(a.y.max(b.y)));
            bands.segments[low..=high].iter_mut().for_each(|band| band.push((a, b)));
        }
        bands
    }

    fn band(&self, v: f64) -> usize {
        (((v - self.start) * self.bands_per_unit) as usize).min(self.segments.len() - 1)
    }

    /// Whether the ray from `p` towards larger u crosses an odd number of segments, or `p` lies on one; exactly, so
    /// that a corner of a loop is on it. A segment owns its lower end.
    fn holds(&self, p: DVec2) -> bool {
        if !(p.y >= self.start && p.x.is_finite()) {
            return false;
        }
        let mut is_inside = false;
        for &(a, b) in &self.segments[self.band(p.y)] {
            let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
            if p.y < low.y || p.y > high.y || p.x > a.x.max(b.x) {
                continue;
            }
            let is_crossed = low.y <= p.y && p.y < high.y;
            if p.x < a.x.min(b.x) {
                is_inside ^= is_crossed;
                continue;
            }
            match orientation(low, high, p) {
                Orientation::Zero => return true,
                Orientation::Positive => is_inside ^= is_crossed,
                Orientation::Negative => {}
            }
        }
        is_inside
    }
}

/// What a surface knows of the data it was made from, and of itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Region {
    /// The box of the data's parameters; beyond it the surface is extrapolated. None: the whole domain.
    pub data_box: Option<Domain>,
    /// The boundary loops of the data.
    pub trims: Trims,
    /// What the surface is called.
    pub label: Label,
}

impl Region {
    /// What is left of it over `part` of a surface's domain.
    pub(super) fn restrict(&self, domain: &Domain, part: &Domain) -> Self {
        let mut loops = self.trims.loops.clone();
        let sides = [
            (DVec2::X, part.min.x, domain.min.x < part.min.x),
            (DVec2::NEG_X, -part.max.x, part.max.x < domain.max.x),
            (DVec2::Y, part.min.y, domain.min.y < part.min.y),
            (DVec2::NEG_Y, -part.max.y, part.max.y < domain.max.y),
        ];
        for (normal, offset, _) in sides.into_iter().filter(|&(_, _, is_inside)| is_inside) {
            loops = cut(&loops, HalfPlane { normal, offset });
        }
        let data_box =
            self.data_box.map(|data| Domain { min: part.clamp(data.min), max: part.clamp(data.max) });
        Self { data_box, trims: Trims { loops, bands: OnceLock::new() }, label: self.label.clone() }
    }

    /// With other parameters for the same places.
    pub(super) fn map(&self, change: impl Fn(DVec2) -> DVec2) -> Self {
        let data_box = self.data_box.map(|data| Domain::around([change(data.min), change(data.max)]));
        let mapped = |polyline: &Vec<DVec2>| polyline.iter().map(|&uv| change(uv)).collect_vec();
        let loops = self.trims.loops.iter().map(mapped).collect_vec();
        Self { data_box, trims: Trims { loops, bands: OnceLock::new() }, label: self.label.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use std::f64::consts::TAU;

    fn square(center: f64, half: f64) -> Vec<DVec2> {
        [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)]
            .map(|(x, y)| DVec2::splat(center) + half * DVec2::new(x, y))
            .to_vec()
    }

    #[test]
    fn a_comb_takes_memory_in_proportion_to_its_points() {
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        let teeth = 25_000;
        let x = |k: usize| k as f64 / (2 * teeth) as f64;
        // up, across, down, across, and back below
        let tooth = |k: usize| {
            let (left, right) = (x(2 * k), x(2 * k + 1));
            [(left, 0.1), (left, 0.9), (right, 0.9), (right, 0.1)].map(|(u, v)| DVec2::new(u, v))
        };
        let mut comb: Vec<DVec2> = (0..teeth).flat_map(tooth).collect();
        comb.extend([DVec2::new(1.0, 0.1), DVec2::new(1.0, 0.05), DVec2::new(0.0, 0.05)]);
        let count = comb.len();
        let trims = Trims::new(vec![comb], &domain).unwrap();
        for k in (0..teeth).step_by(997) {
            for v in [0.11, 0.5, 0.89] {
                let middle = |k: usize| DVec2::new((x(k) + x(k + 1)) / 2.0, v);
                assert!(trims.contains(middle(2 * k)), "tooth {k} at {v}");
                assert!(!trims.contains(middle(2 * k + 1)), "gap {k} at {v}");
            }
        }
        let entries: usize = trims.bands.get().unwrap().segments.iter().map(Vec::len).sum();
        assert!(entries <= 6 * count, "{entries} entries of {count} segments");
    }

    #[test]
    fn holes_are_outside_whatever_their_direction() {
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        let mut hole = square(0.5, 0.2);
        for _ in 0..2 {
            hole.reverse();
            let trims = Trims::new(vec![square(0.5, 0.4), hole.clone()], &domain).unwrap();
            for k in 0..=100 {
                let t = f64::from(k) / 100.0 + 1e-3; // never on a loop
                let expected = (0.1..0.9).contains(&t) && !(0.3..0.7).contains(&t);
                assert_eq!(trims.contains(DVec2::splat(t)), expected, "t = {t}");
            }
            assert!(!trims.contains(DVec2::splat(f64::NAN)));
        }
    }

    #[test]
    fn a_ray_through_corners_counts_them_once() {
        let diamond = [(0., 1.), (1., 0.), (2., 1.), (1., 2.)].map(|(x, y)| DVec2::new(x, y)).to_vec();
        let domain = Domain { min: DVec2::ZERO, max: DVec2::splat(2.0) };
        let trims = Trims::new(vec![diamond], &domain).unwrap();
        assert!(trims.contains(DVec2::new(0.5, 1.0)));
        assert!(!trims.contains(DVec2::new(-0.5, 1.0)));
        assert!(!trims.contains(DVec2::new(0.5, 2.0)));
    }

    #[test]
    fn what_lies_on_a_loop_is_inside() {
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        let mut random = Random::new(4);
        for _ in 0..20 {
            let mut star = |radius: f64, count: usize| -> Vec<DVec2> {
                let corner = |k: usize, r: f64| 0.5 + r * DVec2::from_angle(TAU * k as f64 / count as f64);
                (0..count).map(|k| corner(k, radius * (0.6 + 0.4 * random.unit()))).collect()
            };
            let mut loops = vec![star(0.45, 37), star(0.2, 11)];
            loops.push(square(0.1, 0.03)); // sides along the axes
            let trims = Trims::new(loops.clone(), &domain).unwrap();
            assert!(loops.iter().flatten().all(|&corner| trims.contains(corner)));
            // exact middles: of the square's sides, and wherever halving rounds nothing
            for (a, b) in trims.segments() {
                let middle = (a + b) / 2.0;
                assert!(orientation(a, b, middle) != Orientation::Zero || trims.contains(middle), "{middle}");
            }
        }
        let trims = Trims::new(vec![square(0.5, 0.25)], &domain).unwrap();
        assert!(trims.contains(DVec2::new(0.75, 0.75)) && trims.contains(DVec2::new(0.25, 0.5)));
        assert!(!trims.contains(DVec2::new(0.75f64.next_up(), 0.5)));
        assert!(!trims.contains(DVec2::new(0.5, 0.25f64.next_down())));
    }

    #[test]
    fn refusals_name_the_loop() {
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        let refuse = |last| Trims::new(vec![square(0.5, 0.4), last], &domain).unwrap_err();
        assert_eq!(refuse(vec![DVec2::ZERO]), TrimError::TooShort { index: 1, count: 1 });
        assert_eq!(refuse(square(0.9, 0.2)), TrimError::Outside { index: 1, point: 1 });
        assert_eq!(refuse(square(f64::NAN, 0.2)), TrimError::NotFinite { index: 1, point: 0 });
    }
}
