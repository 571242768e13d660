//! Simplification: crosses are removed while the surface stays near the original.
//!
//! Deng et al. 2008, section 5.1. Levels are processed from fine to coarse, the cells of a level in
//! the order of their deviation. The deviation is that from the original surface: a coarse patch cut at the
//! original leaves has ordinates that differ from the original ones by at least what the patches do.
//!
//! A removal changes more than the cell and its neighbours: a vertex that becomes a T-vertex gets another jet,
//! and with it all T-vertices on edges that end there, and so on. [`PhtSurface::changed_by`] follows them.

use super::{PhtError, PhtSurface, jet};
use crate::bezier::BezierPatch;
use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::surface::Patches;
use crate::surface::tensor::Axis;
use crate::tmesh::{Cell, EDGES, Edge, NodeId, QUADRANTS, Vertex};

/// What a simplification did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Simplification {
    /// Cells whose quarters were merged.
    pub merged: usize,
    /// Bound of the distance to the original surface.
    pub deviation: f64,
}

impl PhtSurface {
    /// Removes as many crosses as it finds while no point moves by more than `tolerance`.
    pub fn simplify(&mut self, tolerance: f64) -> Result<Simplification, PhtError> {
        self.simplify_watched(tolerance, &Watch::default())
    }

    /// The same as a part of a call that may be cancelled: the surface is then somewhere in between.
    pub fn simplify_watched(&mut self, tolerance: f64, watch: &Watch) -> Result<Simplification, PhtError> {
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(PhtError::Tolerance { value: tolerance, range: "finite and not negative" });
        }
        let original = self.clone();
        let mut result = Simplification { merged: 0, deviation: 0.0 };
        let deepest = self.mesh.leaves().map(|leaf| self.mesh.cell(leaf).level).max().unwrap_or(0);
        for level in (0..deepest).rev() {
            let mut candidates: Vec<(f64, Cell)> = Vec::new();
            for cell in self.mergeable_cells(level) {
                watch.check()?;
                if let Some(removed) = self.remove_cross(cell, &original, tolerance) {
                    memory::push(&mut candidates, (removed.deviation, cell));
                    self.restore_cross(cell, removed);
                }
            }
            candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (_, cell) in candidates {
                watch.check()?;
                if let Some(removed) = self.remove_cross(cell, &original, tolerance) {
                    result.merged += 1;
                    result.deviation = result.deviation.max(removed.deviation);
                }
            }
        }
        Ok(result)
    }

    /// The cells of a level whose quarters are leaves.
    fn mergeable_cells(&self, level: u32) -> Vec<Cell> {
        let first_quarter =
            |cell: &Cell| cell.level == level + 1 && cell.i.is_multiple_of(2) && cell.j.is_multiple_of(2);
        let cells = self.mesh.leaves().map(|leaf| self.mesh.cell(leaf)).filter(first_quarter);
        let parents = cells.filter_map(Cell::parent);
        let is_mergeable =
            |cell: &Cell| self.mesh.find(*cell).is_some_and(|node| self.mesh.is_mergeable(node));
        parents.filter(is_mergeable).collect_vec()
    }

    /// Merges the quarters of a cell if the surface stays within the tolerance; otherwise nothing changes.
    fn remove_cross(&mut self, cell: Cell, original: &Self, tolerance: f64) -> Option<Removed> {
        let node = self.mesh.find(cell).filter(|&node| self.mesh.is_mergeable(node))?;
        let vertices = cell.edge_middles().into_iter().chain([cell.middle()]);
        let before: Vec<_> = vertices.filter_map(|v| Some((v, self.jets.get(&v)?.clone()))).collect_vec();
        self.merge_node(node);
        let jets = before.into_iter().filter(|(vertex, _)| !self.jets.contains_key(vertex)).collect_vec();
        let mut removed = Removed { jets, deviation: 0.0 };
        for leaf in self.changed_by(node) {
            removed.deviation = removed.deviation.max(self.leaf_deviation(leaf, original, tolerance));
            if !(removed.deviation <= tolerance) {
                self.restore_cross(cell, removed);
                return None;
            }
        }
        Some(removed)
    }

    fn restore_cross(&mut self, cell: Cell, removed: Removed) {
        if let Some(node) = self.mesh.find(cell) {
            self.mesh.split(node);
        }
        self.jets.extend(removed.jets);
    }

    /// The leaves whose patch depends on whether this leaf is split: itself, and those that a chain of T-vertices
    /// ties to its edges.
    fn changed_by(&self, leaf: NodeId) -> Vec<NodeId> {
        let mut changed = vec![leaf];
        let mut open: Vec<Vertex> = EDGES.iter().flat_map(|edge| self.hanging_in(leaf, edge)).collect_vec();
        let mut seen: Vec<Vertex> = Vec::new();
        while let Some(vertex) = open.pop() {
            if seen.contains(&vertex) {
                continue;
            }
            memory::push(&mut seen, vertex);
            for leaf in QUADRANTS.iter().filter_map(|&quadrant| self.mesh.leaf_beside(vertex, quadrant)) {
                let corners = self.mesh.cell(leaf).corners();
                let Some(corner) = corners.iter().position(|&corner| corner == vertex) else { continue };
                if !changed.contains(&leaf) {
                    memory::push(&mut changed, leaf);
                }
                let edges = EDGES.iter().filter(|edge| edge.ends.contains(&corner));
                memory::extend(&mut open, edges.flat_map(|edge| self.hanging_in(leaf, edge)));
            }
        }
        changed
    }

    /// The T-vertices inside an edge of a leaf.
    fn hanging_in(&self, leaf: NodeId, edge: &Edge) -> Vec<Vertex> {
        let end = self.mesh.cell(leaf).corners()[edge.ends[1]];
        let mut across = self.mesh.across(leaf, *edge);
        // the last one ends at the end of the edge, or beyond it
        across.pop();
        let far = across.into_iter().map(|leaf| self.mesh.cell(leaf).corners()[3].along(edge.along));
        far.map(|at| match edge.along {
            Axis::U => Vertex { i: at, j: end.j },
            Axis::V => Vertex { i: end.i, j: at },
        })
        .collect_vec()
    }

    /// Bound of the distance between the patch of a leaf and the original surface; stops counting beyond
    /// `enough`.
    fn leaf_deviation(&self, leaf: NodeId, original: &Self, enough: f64) -> f64 {
        let (cell, width) = (self.mesh.cell(leaf), self.width());
        let jets = cell.corners().map(|corner| self.jet_at(corner));
        let domain = self.mesh.cell_domain(cell);
        let mut ordinates = memory::filled(0.0, 16 * width);
        let corners = jets.each_ref().map(Vec::as_slice);
        jet::ordinates(corners, domain.size().to_array(), width, &mut ordinates);
        let patch =
            BezierPatch { domain, degree: [3, 3], dim: self.dim, is_rational: self.is_rational, ordinates };
        let mut deviation = 0.0_f64;
        // the original mesh has the same cells and quarters of them
        let mut open: Vec<NodeId> = original.mesh.find(cell).into_iter().collect_vec();
        while let Some(node) = open.pop() {
            if let Some(children) = original.mesh.children(node) {
                memory::extend(&mut open, children);
                continue;
            }
            let exact = original.patch(original.topology().leaf_of(node));
            let distance = if exact.domain == domain {
                distance_bound(&patch, &exact)
            } else {
                distance_bound(&patch.restrict(exact.domain), &exact)
            };
            deviation = deviation.max(distance);
            if !(deviation <= enough) {
                break;
            }
        }
        deviation
    }
}

/// A cross that was removed.
struct Removed {
    jets: Vec<(Vertex, Vec<f64>)>,
    deviation: f64,
}

/// Bound of the distance between two patches over one rectangle. With weights
/// ```text
/// N/w - N0/w0 = ((N - N0) - (w - w0) c - (w - w0) (S0 - c)) / w,   c any point near S0 = N0/w0
/// ```
fn distance_bound(patch: &BezierPatch, exact: &BezierPatch) -> f64 {
    let (dim, width) = (exact.dim, exact.width());
    let rows = patch.ordinates.chunks_exact(width).zip(exact.ordinates.chunks_exact(width));
    let norm = |squares: f64| squares.sqrt();
    if !exact.is_rational {
        let square = |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        return norm(rows.map(square).fold(0.0, f64::max));
    }
    let center: Vec<f64> = exact.ordinates[..dim].iter().map(|x| x / exact.ordinates[dim]).collect_vec();
    let (mut miss, mut weight_miss, mut radius, mut least) = (0.0_f64, 0.0_f64, 0.0_f64, f64::INFINITY);
    for (a, b) in rows {
        let dw = a[dim] - b[dim];
        let square = |k: usize| (a[k] - b[k] - dw * center[k]).powi(2);
        miss = miss.max(norm((0..dim).map(square).sum()));
        radius = radius.max(norm((0..dim).map(|k| (b[k] / b[dim] - center[k]).powi(2)).sum()));
        weight_miss = weight_miss.max(dw.abs());
        least = least.min(a[dim]);
    }
    if least > 0.0 { (miss + weight_miss * radius) / least } else { f64::INFINITY }
}
