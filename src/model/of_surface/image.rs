//! The image of a polyline in the parameter plane on a surface, as a cubic B-spline.
//!
//! A straight line over one patch is a curve of degree p + q (rational with the surface). Each is replaced by
//! the cubic with the same ends and end derivatives, halved until it is near enough; errors fall with the fourth
//! power of the length. Pieces that meet with the same derivative get a double knot, others (at corners of the
//! polyline, and where the surface has an edge) a triple one, so that the curve bends where its preimage does.

use crate::bezier::BezierPatch;
use crate::curve::Curve;
use crate::knots::KnotVector;
use crate::model::ModelError;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Patches, Surface};
use glam::{DVec2, DVec3};

/// A curve on a surface and its preimage over the same parameters.
#[derive(Debug)]
pub(super) struct Image {
    /// Degree 1 in the parameter plane: the polyline itself.
    pub pcurve: Curve,
    /// Degree 3 in space.
    pub curve: Curve,
}

impl Image {
    /// The first and the last point in space.
    pub(super) fn ends(&self) -> [DVec3; 2] {
        let points = self.curve.control_points();
        [&points[..3], &points[points.len() - 3..]].map(DVec3::from_slice)
    }
}

/// Share of the tolerance that one piece may take. Double knots in place of nearly equal derivatives take a
/// little more; the uncertainty written is at least twice what is measured.
const PIECE_SHARE: f64 = 0.4;
/// Derivatives that differ by less move the curve by less than this share of the tolerance at a double knot.
const SMOOTH_SHARE: f64 = 0.1;
/// Halvings of one piece: errors fall by 16 each time, so more never help.
const MAX_DEPTH: u32 = 12;
/// Crossings of knot lines nearer to each other than this share of a line are one.
const LEAST_CUT: f64 = 1e-9;
/// Samples of a piece while it is fitted; the finished curve is measured at other places.
const FIT_SAMPLES: usize = 8;

/// One cubic over an interval of parameters.
struct Piece {
    from: f64,
    to: f64,
    ordinates: [DVec3; 4],
}

impl Piece {
    fn length(&self) -> f64 {
        self.to - self.from
    }

    /// The derivatives at both ends.
    fn slopes(&self) -> [DVec3; 2] {
        let [a, b, c, d] = self.ordinates;
        [b - a, d - c].map(|side| 3.0 * side / self.length())
    }

    fn eval(&self, s: f64) -> DVec3 {
        let [a, b, c, d] = self.ordinates;
        let r = 1.0 - s;
        r * r * r * a + 3.0 * r * r * s * b + 3.0 * r * s * s * c + s * s * s * d
    }
}

/// The image of an open polyline. Parameters are lengths in space, so that both curves run at an even pace.
pub(super) fn image(
    surface: &TensorSurface,
    polyline: &[DVec2],
    tolerance: f64,
) -> Result<Image, ModelError> {
    let mut pieces = Vec::new();
    let mut parameters = vec![0.0];
    let mut at = 0.0;
    for side in polyline.windows(2) {
        let [a, b] = [side[0], side[1]];
        let cuts = cuts(surface, a, b);
        // a side that shrinks to a point still needs an interval
        let length = length(surface, a, b, &cuts).max(tolerance);
        for cut in cuts.windows(2) {
            let line = Line { surface, a, b, at, length };
            line.fit([cut[0], cut[1]], tolerance, &mut pieces);
        }
        at += length;
        parameters.push(at);
    }
    let curve = join(&pieces, tolerance)?;
    let pcurve = Curve::new(
        2,
        KnotVector::clamped(&parameters, 1)?,
        polyline.iter().flat_map(|uv| uv.to_array()).collect(),
    )?;
    Ok(Image { pcurve, curve })
}

/// The shares of a line at which it begins, crosses knot lines, and ends.
fn cuts(surface: &TensorSurface, a: DVec2, b: DVec2) -> Vec<f64> {
    let mut cuts = vec![0.0];
    for (axis, from, to) in [(Axis::U, a.x, b.x), (Axis::V, a.y, b.y)] {
        if from != to {
            let breaks = surface.knots(axis).breaks();
            cuts.extend(breaks.iter().map(|knot| (knot - from) / (to - from)));
        }
    }
    cuts.retain(|&s| s == 0.0 || (LEAST_CUT..1.0 - LEAST_CUT).contains(&s));
    cuts.sort_unstable_by(f64::total_cmp);
    cuts.dedup_by(|next, kept| *next - *kept < LEAST_CUT);
    cuts.push(1.0);
    cuts
}

/// The length of the image of a line, from chords.
fn length(surface: &TensorSurface, a: DVec2, b: DVec2, cuts: &[f64]) -> f64 {
    const CHORDS: usize = 4;
    let inner = cuts.windows(2).flat_map(|cut| {
        let (from, to) = (cut[0], cut[1]);
        (0..CHORDS).map(move |k| from + (to - from) * k as f64 / CHORDS as f64)
    });
    let places: Vec<DVec2> = inner.chain([1.0]).map(|s| a.lerp(b, s)).collect();
    points(surface, &places).windows(2).map(|chord| chord[0].distance(chord[1])).sum()
}

/// The points of a surface in space.
pub(super) fn points(surface: &TensorSurface, uv: &[DVec2]) -> Vec<DVec3> {
    let mut rows = vec![0.0; 3 * uv.len()];
    surface.eval_rows(uv, 0, &mut rows);
    rows.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// A side of the polyline from `a` to `b`, with the parameters from `at` to `at + length`.
struct Line<'a> {
    surface: &'a TensorSurface,
    a: DVec2,
    b: DVec2,
    at: f64,
    length: f64,
}

impl Line<'_> {
    fn uv(&self, share: f64) -> DVec2 {
        if share == 1.0 { self.b } else { self.a.lerp(self.b, share) }
    }

    /// Cubics for the part between two shares, which lies over one patch.
    fn fit(&self, [from, to]: [f64; 2], tolerance: f64, pieces: &mut Vec<Piece>) {
        let patch = self.surface.patch(self.surface.patch_at(self.uv(0.5 * (from + to))));
        let mut stack = vec![(from, to, 0)];
        while let Some((from, to, depth)) = stack.pop() {
            let exact = patch.line(self.uv(from), self.uv(to));
            let [start, end] = [from, to].map(|share| self.at + share * self.length);
            let piece = Piece { from: start, to: end, ordinates: hermite(&exact) };
            let is_near = (1..FIT_SAMPLES).all(|k| {
                let s = k as f64 / FIT_SAMPLES as f64;
                let on_surface = DVec3::from_slice(&exact.eval(DVec2::new(s, 0.0)));
                piece.eval(s).distance(on_surface) <= PIECE_SHARE * tolerance
            });
            if is_near || depth == MAX_DEPTH {
                pieces.push(piece);
            } else {
                let middle = 0.5 * (from + to);
                stack.push((middle, to, depth + 1));
                stack.push((from, middle, depth + 1));
            }
        }
    }
}

/// The cubic with the ends and the end derivatives of a line's image.
fn hermite(exact: &BezierPatch) -> [DVec3; 4] {
    let (width, degree) = (exact.width(), exact.degree[0]);
    let weight = |k: usize| if exact.is_rational { exact.ordinates[k * width + 3] } else { 1.0 };
    let point = |k: usize| DVec3::from_slice(&exact.ordinates[k * width..]) / weight(k);
    let slope =
        |end: usize, inner: usize| degree as f64 * weight(inner) / weight(end) * (point(inner) - point(end));
    let [a, d] = [point(0), point(degree)];
    [a, a + slope(0, 1) / 3.0, d + slope(degree, degree - 1) / 3.0, d]
}

/// One B-spline from pieces that follow one another.
fn join(pieces: &[Piece], tolerance: f64) -> Result<Curve, ModelError> {
    let (mut knots, mut control_points): (Vec<f64>, Vec<DVec3>) = (Vec::new(), Vec::new());
    let first = pieces.first().map_or(0.0, |piece| piece.from);
    knots.extend([first; 4]);
    control_points.extend(pieces.first().map(|piece| piece.ordinates[0]));
    for (k, piece) in pieces.iter().enumerate() {
        control_points.extend(&piece.ordinates[1..3]);
        let is_smooth = pieces.get(k + 1).is_some_and(|next| {
            let jump = piece.slopes()[1].distance(next.slopes()[0]);
            // a double knot moves the curve by a third of this at most
            jump * piece.length().min(next.length()) <= 3.0 * SMOOTH_SHARE * tolerance
        });
        if is_smooth {
            knots.extend([piece.to; 2]);
        } else {
            knots.extend([piece.to; 3]);
            control_points.push(piece.ordinates[3]);
        }
    }
    knots.extend(pieces.last().map(|piece| piece.to));
    let numbers = control_points.iter().flat_map(|p| p.to_array()).collect();
    Ok(Curve::new(3, KnotVector::new(knots, 3)?, numbers)?)
}
