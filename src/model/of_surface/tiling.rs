//! The rectangles of the parameter plane under the faces of a shell, and the lines on which their sides meet.
//!
//! ```text
//!   +-----+-----+       Sides of different length may meet: a line has spans, where rectangles lie on both
//!   |     |  b  |       sides of it, and corners of either side, which cut it into pieces with one rectangle
//!   |  a  +--+--+       on each side.
//!   |     |  |  |
//!   +-----+--+--+
//! ```

use crate::geometry::Domain;
use glam::DVec2;

/// Rectangles that fill a domain without overlap.
#[derive(Debug)]
pub(super) struct Tiling {
    domain: Domain,
    rectangles: Vec<Domain>,
    /// Lines of constant u, and of constant v, in increasing order.
    lines: [Vec<Line>; 2],
    buckets: Buckets,
}

/// A line of constant u or v inside the domain.
#[derive(Debug)]
pub(super) struct Line {
    /// The constant.
    pub at: f64,
    /// Corners of rectangles on it, in increasing order.
    pub corners: Vec<f64>,
    /// The sides on it, of the rectangles before it, in increasing order.
    spans: Vec<[f64; 2]>,
}

impl Line {
    /// Whether two rectangles meet on the line at, or within `margin` of, a place along it.
    pub(super) fn holds(&self, along: f64, margin: f64) -> bool {
        let next = self.spans.partition_point(|span| span[0] <= along + margin);
        next > 0 && along <= self.spans[next - 1][1] + margin
    }
}

impl Tiling {
    /// Loops are moved on to lines within this share of the domain's size, so that no face is narrower. It is as
    /// much as curves in space may be off the surface.
    const SNAP: f64 = super::CURVE_TOLERANCE;

    /// `rectangles` fill their common box.
    pub(super) fn new(rectangles: Vec<Domain>) -> Self {
        let domain = Domain::around(rectangles.iter().flat_map(|tile| [tile.min, tile.max]));
        let lines = [0, 1].map(|axis| lines(&rectangles, &domain, axis));
        let buckets = Buckets::new(&rectangles, domain);
        Self { domain, rectangles, lines, buckets }
    }

    /// The box of all rectangles.
    pub(super) fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The lines of constant u (0) or v (1).
    pub(super) fn lines(&self, axis: usize) -> &[Line] {
        &self.lines[axis]
    }

    /// The line of constant u (0) or v (1) on which a point lies.
    pub(super) fn line_through(&self, axis: usize, p: DVec2) -> Option<usize> {
        let index = self.lines[axis].partition_point(|line| line.at < p[axis]);
        let line = self.lines[axis].get(index)?;
        (line.at == p[axis] && line.holds(p[1 - axis], 0.0)).then_some(index)
    }

    /// The rectangle that has `p` in it or on its border, and what lies from `p` towards `inward`.
    pub(super) fn beside(&self, p: DVec2, inward: DVec2) -> Option<usize> {
        let reaches = |&k: &usize| {
            let tile = &self.rectangles[k];
            let enters = |axis| {
                (p[axis] > tile.min[axis] || inward[axis] >= 0.0)
                    && (p[axis] < tile.max[axis] || inward[axis] <= 0.0)
            };
            tile.contains(p) && enters(0) && enters(1)
        };
        self.buckets.near(p).iter().copied().find(reaches)
    }

    /// A closed polyline with its points moved on to the lines that are very near, and with points where it
    /// crosses lines.
    pub(super) fn cut(&self, polyline: &[DVec2]) -> Vec<DVec2> {
        let snapped: Vec<DVec2> = polyline.iter().map(|&p| self.snap(p)).collect();
        let mut points = Vec::with_capacity(2 * snapped.len());
        for (k, &a) in snapped.iter().enumerate() {
            let b = snapped[(k + 1) % snapped.len()];
            points.push(a);
            points.extend(self.crossings(a, b));
        }
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        points
    }

    fn snap(&self, mut p: DVec2) -> DVec2 {
        for axis in [0, 1] {
            let [near, margin] = [axis, 1 - axis].map(|axis| Self::SNAP * self.domain.size()[axis]);
            let first = self.lines[axis].partition_point(|line| line.at < p[axis] - near);
            let candidates = self.lines[axis][first..].iter().take_while(|line| line.at <= p[axis] + near);
            let nearest = candidates
                .filter(|line| line.holds(p[1 - axis], margin))
                .min_by(|a, b| (a.at - p[axis]).abs().total_cmp(&(b.at - p[axis]).abs()));
            if let Some(line) = nearest {
                p[axis] = line.at;
            }
        }
        p
    }

    /// The points strictly between `a` and `b` at which the line between them crosses lines, in order.
    fn crossings(&self, a: DVec2, b: DVec2) -> Vec<DVec2> {
        let mut crossings = Vec::new();
        for axis in [0, 1] {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            let first = self.lines[axis].partition_point(|line| line.at <= low);
            for line in self.lines[axis][first..].iter().take_while(|line| line.at < high) {
                let share = (line.at - a[axis]) / (b[axis] - a[axis]);
                let mut crossing = a.lerp(b, share);
                crossing[axis] = line.at;
                let crossing = self.domain.clamp(self.snap(crossing));
                if line.holds(crossing[1 - axis], 0.0) && crossing != a && crossing != b {
                    crossings.push((share, crossing));
                }
            }
        }
        crossings.sort_by(|(s, _), (t, _)| s.total_cmp(t));
        crossings.dedup_by_key(|(_, crossing)| *crossing);
        crossings.into_iter().map(|(_, crossing)| crossing).collect()
    }
}

fn lines(rectangles: &[Domain], domain: &Domain, axis: usize) -> Vec<Line> {
    let is_inside = |at: f64| domain.min[axis] < at && at < domain.max[axis];
    let mut sides: Vec<(f64, [f64; 2], bool)> = Vec::new();
    for tile in rectangles {
        let span = [tile.min[1 - axis], tile.max[1 - axis]];
        sides.extend([(tile.max[axis], span, true), (tile.min[axis], span, false)]);
    }
    sides.retain(|&(at, _, _)| is_inside(at));
    sides.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1[0].total_cmp(&b.1[0])));
    let line = |sides: &[(f64, [f64; 2], bool)]| {
        let mut corners: Vec<f64> = sides.iter().flat_map(|&(_, span, _)| span).collect();
        corners.sort_unstable_by(f64::total_cmp);
        corners.dedup();
        let before = sides.iter().filter(|&&(_, _, is_before)| is_before);
        Line { at: sides[0].0, corners, spans: before.map(|&(_, span, _)| span).collect() }
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(line).collect()
}

/// A grid over the domain with about as many buckets as there are rectangles, to find those near a point.
#[derive(Debug)]
struct Buckets {
    domain: Domain,
    count: usize,
    tiles: Vec<Vec<usize>>,
}

impl Buckets {
    fn new(rectangles: &[Domain], domain: Domain) -> Self {
        let count = (rectangles.len() as f64).sqrt().ceil() as usize;
        let mut buckets = Self { domain, count, tiles: vec![Vec::new(); count * count] };
        for (k, tile) in rectangles.iter().enumerate() {
            let [low, high] = [tile.min, tile.max].map(|corner| buckets.place(corner));
            for i in low[0]..=high[0] {
                (low[1]..=high[1]).for_each(|j| buckets.tiles[i * count + j].push(k));
            }
        }
        buckets
    }

    fn place(&self, p: DVec2) -> [usize; 2] {
        let share = (p - self.domain.min) / self.domain.size() * self.count as f64;
        [share.x, share.y].map(|share| (share as usize).min(self.count - 1))
    }

    fn near(&self, p: DVec2) -> &[usize] {
        let [i, j] = self.place(p);
        &self.tiles[i * self.count + j]
    }
}
