//! Quads for all triangles: edges are split where a pairing leaves something over.
//!
//! A closed surface has a perfect matching. An open one with an odd number of triangles has none: splitting an edge of the
//! border makes it even. With an even number it may still have none, or corners of the border may get fewer quads than
//! they need: of the longest edges there the one is split after which the least is left over.

use super::base::Base;
use super::pairing::{Effort, Pairing, paired};
use crate::Control;
use crate::control::Cancelled;

/// Most edges that are split.
const MOST_SPLITS: usize = 25;
/// Up to so many triangles all those; no matching is cheaper than one round, so of larger ones fewer edges are split.
const FULL_SPLITS: usize = 640;
/// A split mends no more than so many of what is left over, and two in three mend one or nothing.
const GAIN: usize = 2;
/// Edges tried at each step.
const CANDIDATES: usize = 5;
/// For the first pairing, which closed surfaces keep.
const FIRST: Effort = Effort { starts: 8, rounds: 120 };
/// For each edge that is tried.
const TRIAL: Effort = Effort { starts: 1, rounds: 20 };
/// Up to so many triangles all that is made; a matching takes about the square of their number, and the effort shrinks
/// as that grows, so that no search takes longer than that of so many.
const FULL_EFFORT: usize = 160;
/// Quads around a vertex inside.
const INNER_NEED: u32 = 3;

/// Which edges may be split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Splitting {
    /// All.
    Any,
    /// Those inside alone: the border is given, and even.
    Inside,
}

/// Quads over all triangles, and how many edges were split for them; none if there are no such quads.
pub(super) fn quads(
    mut base: Base,
    lengths: &[f64],
    splitting: Splitting,
    control: &mut Control,
) -> Result<Option<(Base, Pairing, usize)>, Cancelled> {
    match splitting {
        Splitting::Any => make_even(&mut base, lengths),
        Splitting::Inside if !is_hopeful(&base, control)? => return Ok(None),
        Splitting::Inside => {}
    }
    let Some(mut pairing) = pairing(&base, FIRST, control)? else { return Ok(None) };
    let vertex_count = base.points.len();
    for splits_left in (1..=most_splits(&base)).rev() {
        let left = left_over(&base, &pairing);
        if left == 0 || left > GAIN * splits_left {
            break;
        }
        let mut best: Option<(usize, Base, Pairing)> = None;
        for edge in candidates(&base, &pairing, splitting) {
            control.report(1.0, f64::NAN)?;
            let mut trial = base.clone();
            trial.split(edge, lengths);
            if splitting == Splitting::Any {
                make_even(&mut trial, lengths);
            }
            let Some(found) = self::pairing(&trial, TRIAL, control)? else { continue };
            let left = left_over(&trial, &found);
            if best.as_ref().is_none_or(|(least, ..)| left < *least) {
                best = Some((left, trial, found));
            }
        }
        let Some((_, next, found)) = best else { break };
        (base, pairing) = (next, found);
    }
    let splits = base.points.len() - vertex_count;
    Ok((left_over(&base, &pairing) == 0).then_some((base, pairing, splits)))
}

/// Whether a quick pairing leaves no more over than there are splits: more are not worth a thorough one.
fn is_hopeful(base: &Base, control: &mut Control) -> Result<bool, Cancelled> {
    let quick = pairing(base, TRIAL, control)?;
    Ok(quick.is_some_and(|pairing| left_over(base, &pairing) <= most_splits(base)))
}

fn most_splits(base: &Base) -> usize {
    let share = (FULL_SPLITS as f64 / base.triangles.len() as f64).powi(2).min(1.0);
    (MOST_SPLITS as f64 * share).ceil() as usize
}

/// The first pairing of all triangles that can be paired.
pub(super) fn first(base: &Base, control: &mut Control) -> Result<Option<Pairing>, Cancelled> {
    pairing(base, FIRST, control)
}

fn pairing(base: &Base, effort: Effort, control: &mut Control) -> Result<Option<Pairing>, Cancelled> {
    let needs: Vec<u32> =
        base.border.iter().map(|border| border.map_or(INNER_NEED, |(_, need)| need)).collect();
    let share = (FULL_EFFORT as f64 / base.triangles.len() as f64).powi(2).min(1.0);
    let starts = (effort.starts as f64 * share.sqrt()).ceil() as u64;
    let rounds = (effort.rounds as f64 * share.sqrt()).ceil() as usize;
    paired(&base.points, &base.triangles, &needs, Effort { starts, rounds }, control)
}

/// Triangles without a quad, and nodes of the border without enough; vertices inside with two quads go as doublets.
fn left_over(base: &Base, pairing: &Pairing) -> usize {
    let is_on_border = |vertex: &&u32| base.border[**vertex as usize].is_some();
    pairing.single_count() + pairing.starved.iter().filter(is_on_border).count()
}

/// Splits the longest edge of the border if the number of triangles is odd.
fn make_even(base: &mut Base, lengths: &[f64]) {
    if base.triangles.len().is_multiple_of(2) {
        return;
    }
    let edges = base.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let longest = edges
        .filter(|&edge| is_border(base, edge))
        .max_by(|p, q| length(base, p).total_cmp(&length(base, q)));
    if let Some(edge) = longest {
        base.split(edge, lengths);
    }
}

fn is_border(base: &Base, [a, b]: [u32; 2]) -> bool {
    let at_edge = base.triangles.iter().filter(|triangle| triangle.contains(&a) && triangle.contains(&b));
    at_edge.count() == 1
}

fn length(base: &Base, &[a, b]: &[u32; 2]) -> f64 {
    base.points[a as usize].distance(base.points[b as usize])
}

/// The longest edges of triangles without a quad, and of those at starved nodes of the border.
fn candidates(base: &Base, pairing: &Pairing, splitting: Splitting) -> Vec<[u32; 2]> {
    let is_bad = |(t, triangle): &(usize, &[u32; 3])| {
        let is_starved =
            |vertex: &u32| base.border[*vertex as usize].is_some() && pairing.starved.contains(vertex);
        pairing.quad_of[*t].is_none() || triangle.iter().any(is_starved)
    };
    let bad = base.triangles.iter().enumerate().filter(is_bad);
    let sides = bad.flat_map(|(_, &[a, b, c])| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    if splitting == Splitting::Inside {
        edges.retain(|&edge| !is_border(base, edge));
    }
    edges.sort_unstable();
    edges.dedup();
    edges.sort_by(|p, q| length(base, q).total_cmp(&length(base, p)));
    edges.truncate(CANDIDATES);
    edges
}
