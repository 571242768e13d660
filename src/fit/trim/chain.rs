//! Curves that follow one another to a closed loop.

use super::CurveTrimError;
use crate::curve::Curve;
use crate::memory::CollectVec;
use glam::DVec3;

/// A curve of a loop, passed in the direction of the loop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link<'a> {
    pub curve: &'a Curve,
    /// Its number among the curves of all loops.
    pub number: usize,
    /// Its parameters where the loop enters and leaves it; falling if it is passed backwards.
    pub ends: [f64; 2],
}

impl<'a> Link<'a> {
    fn new(curve: &'a Curve, number: usize) -> Self {
        let (from, to) = curve.knots().domain();
        Self { curve, number, ends: [from, to] }
    }

    fn reversed(self) -> Self {
        let [from, to] = self.ends;
        Self { ends: [to, from], ..self }
    }

    pub(super) fn place(&self, t: f64) -> DVec3 {
        DVec3::from_slice(&self.curve.eval(t))
    }

    pub(super) fn places(&self) -> [DVec3; 2] {
        self.ends.map(|t| self.place(t))
    }

    /// Parameters between which the curve is smooth, in the direction of the loop.
    pub(super) fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.curve.knots().breaks();
        if self.ends[0] > self.ends[1] {
            breaks.reverse();
        }
        breaks
    }
}

/// The curves of a loop, each turned so that it begins near the end of the one before; refused if a gap is larger than
/// the tolerance. `first` is the number of the first curve.
pub(super) fn closed<'a>(
    curves: &[&'a Curve],
    first: usize,
    tolerance: f64,
) -> Result<Vec<Link<'a>>, CurveTrimError> {
    let mut links = curves.iter().zip(first..).map(|(&curve, number)| Link::new(curve, number)).collect_vec();
    if let [one, two, ..] = &mut links[..] {
        let others = two.places();
        let miss = |end: DVec3| end.distance(others[0]).min(end.distance(others[1]));
        let [begin, end] = one.places();
        if miss(begin) < miss(end) {
            *one = one.reversed();
        }
    }
    for k in 1..links.len() {
        let [_, at] = links[k - 1].places();
        let [begin, end] = links[k].places();
        if at.distance(end) < at.distance(begin) {
            links[k] = links[k].reversed();
        }
    }
    for (k, link) in links.iter().enumerate() {
        let next = &links[(k + 1) % links.len()];
        let gap = link.places()[1].distance(next.places()[0]);
        if !(gap <= tolerance) {
            return Err(CurveTrimError::Open { curve: link.number, next: next.number, gap, tolerance });
        }
    }
    Ok(links)
}
