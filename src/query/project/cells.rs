//! The cells of a surface or curve: its Bezier patches in one form, halved while they bend much, and the pieces of its
//! trims that lie on one patch each.

use super::index::Place;
use crate::bezier::{BezierPatch, apply, extraction};
use crate::curve::Curve;
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::surface::{Patches, Trims};
use glam::DVec2;

/// A cell is halved along a direction in which the second derivative is more than this share of the first:
/// below it Newton's method is safe for points nearer than the cell is large, and few cells are left to halve
/// in a search.
const LARGEST_BEND: f64 = 0.5;
/// Patches of few cells are halved up to this number; more would not make a search faster.
const CELL_BUDGET: usize = 1 << 14;
/// A search halves cells itself, where it needs to: from here on that is cheaper.
const MAX_HALVINGS: u32 = 8;

/// The cells of a surface.
pub(super) fn surface_cells(surface: &dyn Patches) -> Vec<(BezierPatch, Place)> {
    halved(uniform(surface))
}

/// The cells of a curve: patches over its spans and the unit interval of v, along which they are constant.
pub(super) fn curve_cells(curve: &Curve) -> Vec<(BezierPatch, Place)> {
    let (knots, dim) = (curve.knots(), curve.dim());
    let degree = knots.degree();
    let patch = |span: usize| {
        let points = &curve.control_points()[(span - degree) * dim..(span + 1) * dim];
        let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
        BezierPatch {
            domain: Domain { min: DVec2::new(from, 0.0), max: DVec2::new(to, 1.0) },
            degree: [degree, 0],
            dim,
            is_rational: false,
            ordinates: apply(points, [degree, 0], dim, &extraction(knots, span), &[1.0]),
        }
    };
    halved(knots.spans().map(patch).collect_vec())
}

fn halved(patches: Vec<BezierPatch>) -> Vec<(BezierPatch, Place)> {
    let halvings = (CELL_BUDGET / patches.len().max(1)).checked_ilog2().unwrap_or(0).min(MAX_HALVINGS);
    let mut cells = memory::with_capacity(patches.len());
    patches.into_iter().for_each(|patch| add_halves(patch, halvings, &mut cells));
    cells
}

fn add_halves(patch: BezierPatch, halvings: u32, cells: &mut Vec<(BezierPatch, Place)>) {
    let [along_u, along_v] = bends(&patch);
    if halvings == 0 || along_u.max(along_v) <= LARGEST_BEND {
        let place = Place::Rectangle(patch.domain);
        return memory::push(cells, (patch, place));
    }
    let middle = patch.domain.min + patch.domain.size() / 2.0;
    let halves = if along_u >= along_v { patch.split_u(middle.x) } else { patch.split_v(middle.y) };
    halves.into_iter().for_each(|half| add_halves(half, halvings - 1, cells));
}

/// All patches, with the same degrees, and with weights if one has them.
fn uniform(surface: &dyn Patches) -> Vec<BezierPatch> {
    let patches: Vec<BezierPatch> = (0..surface.patch_count()).map(|k| surface.patch(k)).collect_vec();
    let Some(first) = patches.first() else { return patches };
    let alike = |patch: &BezierPatch| patch.degree == first.degree && patch.is_rational == first.is_rational;
    if patches.iter().all(alike) {
        return patches;
    }
    let largest = |axis: usize| patches.iter().map(|patch| patch.degree[axis]).max().unwrap_or(1);
    let (degree, is_rational) = ([largest(0), largest(1)], patches.iter().any(|patch| patch.is_rational));
    let adapt = |patch: &BezierPatch| {
        let patch = patch.elevate(degree);
        if is_rational { patch.to_rational() } else { patch }
    };
    patches.iter().map(adapt).collect_vec()
}

/// Along u and v: the largest second derivative against the largest first one, of the ordinates.
fn bends(patch: &BezierPatch) -> [f64; 2] {
    let [p, q] = patch.degree;
    let width = patch.width();
    let value = |i: usize, j: usize, k: usize| {
        let row = &patch.ordinates[(i * (q + 1) + j) * width..][..width];
        if patch.is_rational { row[k] / row[patch.dim] } else { row[k] }
    };
    let size = |difference: &dyn Fn(usize) -> f64| {
        (0..patch.dim).map(|k| difference(k) * difference(k)).sum::<f64>()
    };
    let (mut first, mut second) = ([0.0_f64; 2], [0.0_f64; 2]);
    for i in 0..=p {
        for j in 0..=q {
            let places = [(i, p, (1, 0)), (j, q, (0, 1))];
            for (axis, &(at, degree, (a, b))) in places.iter().enumerate() {
                if at < degree {
                    let d = |k: usize| value(i + a, j + b, k) - value(i, j, k);
                    first[axis] = first[axis].max(size(&d));
                }
                if at + 1 < degree {
                    let d = |k: usize| {
                        value(i, j, k) - 2.0 * value(i + a, j + b, k) + value(i + 2 * a, j + 2 * b, k)
                    };
                    second[axis] = second[axis].max(size(&d));
                }
            }
        }
    }
    [0, 1].map(|k| {
        let factor = patch.degree[k].saturating_sub(1) as f64;
        if first[k] > 0.0 { factor * (second[k] / first[k]).sqrt() } else { 0.0 }
    })
}

/// The pieces of the trims between the borders of patches, as curves on the surface.
pub(super) fn trim_pieces(surface: &dyn Patches, trims: &Trims) -> Vec<(BezierPatch, Place)> {
    let mut lines = Vec::new();
    for (from, to) in trims.segments() {
        add_pieces(surface, from, to, &mut lines);
    }
    let degree = lines.iter().fold([0, 0], |most: [usize; 2], (piece, _)| [most[0].max(piece.degree[0]), 0]);
    let is_rational = lines.iter().any(|(piece, _)| piece.is_rational);
    let adapt = |(piece, place): (BezierPatch, Place)| {
        let piece = if piece.degree == degree { piece } else { piece.elevate(degree) };
        (if is_rational { piece.to_rational() } else { piece }, place)
    };
    lines.into_iter().map(adapt).collect_vec()
}

/// Pieces of one line: from the border of one patch to the next.
fn add_pieces(surface: &dyn Patches, from: DVec2, to: DVec2, pieces: &mut Vec<(BezierPatch, Place)>) {
    /// A step over a border, against the whole line; what it skips is shorter than rounding of the trims.
    const STEP: f64 = 1e-12;
    let at = |t: f64| if t < 1.0 { from + t * (to - from) } else { to };
    let along = to - from;
    // the share of the line on which a coordinate changes by no more than rounding: all of it along a knot line
    let unseen = |axis: usize| 4.0 * f64::EPSILON * from[axis].abs().max(to[axis].abs()) / along[axis].abs();
    let crosses = |axis: usize| along[axis] != 0.0 && unseen(axis) < 1.0;
    let mut start = 0.0;
    while start < 1.0 {
        let patch = surface.patch(surface.patch_at(at((start + STEP).min(1.0))));
        let leaves = |axis: usize| {
            let border = if along[axis] > 0.0 { patch.domain.max[axis] } else { patch.domain.min[axis] };
            if crosses(axis) { (border - from[axis]) / along[axis] } else { 1.0 }
        };
        let end = leaves(0).min(leaves(1)).clamp(0.0, 1.0);
        // on a border within rounding: on until the line has left it
        let over = [0, 1].into_iter().filter(|&axis| crosses(axis)).map(unseen).fold(2.0 * STEP, f64::max);
        let end = if end <= start + STEP { (start + over).min(1.0) } else { end };
        let end = if end > 1.0 - STEP { 1.0 } else { end };
        pieces.push((patch.line(at(start), at(end)), Place::Line(at(start), at(end))));
        start = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::surface::tensor::TensorSurface;

    #[test]
    fn a_trim_along_a_knot_line_has_few_pieces() {
        let knots = || KnotVector::clamped(&[0.0, 0.25, 0.5, 0.75, 1.0], 1).unwrap();
        let points = (0..25).flat_map(|k| [f64::from(k / 5), f64::from(k % 5), 0.0]).collect();
        let surface = TensorSurface::new(3, knots(), knots(), points, None).unwrap();
        let patches = crate::surface::Surface::patches(&surface).unwrap();
        for drift in [0.0, 5e-17, 1e-16, 3e-16, 1e-14, 1e-10, 1e-6, 0.3] {
            for side in [-1.0, 1.0] {
                let mut pieces = Vec::new();
                let (from, to) = (DVec2::new(0.5, 0.0), DVec2::new(0.5 + side * drift, 1.0));
                add_pieces(patches, from, to, &mut pieces);
                add_pieces(patches, to, from, &mut pieces);
                // each way four spans along v, one more for each line in u, and a step over each of those
                assert!(pieces.len() <= 2 * (4 + 2 + 6), "{drift:e}: {} pieces", pieces.len());
                assert!(pieces.iter().all(|(piece, _)| piece.degree[0] >= 1));
            }
        }
    }
}
