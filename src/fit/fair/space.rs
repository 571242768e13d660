//! The control points of a surface cell by cell: what fairing moves.
//!
//! Over each cell a tensor surface or a PHT-spline is one Bezier patch, whose ordinates are weighed sums of the control
//! points that act there (M. Borden et al., "Isogeometric finite element data structures based on Bezier extraction of
//! NURBS", Int. J. Numer. Meth. Eng. 87 (2011), 15-47).

use super::{FairError, KeptBorder};
use crate::bezier;
use crate::surface::pht::{Basis, PhtSurface};
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{AnySurface, Domain};
use glam::DVec2;

/// A rectangle on which the surface is one patch.
pub(super) struct Cell {
    pub domain: Domain,
    /// The control points that act here, ascending.
    pub unknowns: Vec<u32>,
    /// Their weights in each ordinate of the patch: a row an ordinate, v running fastest.
    pub extraction: Vec<f64>,
}

/// The control points of a surface.
pub(super) struct Space {
    pub dim: usize,
    pub degree: [usize; 2],
    pub cells: Vec<Cell>,
    /// Rows of `dim` numbers.
    pub control_points: Vec<f64>,
    /// Control points that stay where they are.
    pub is_kept: Vec<bool>,
    finder: Finder,
}

/// How the cell over a parameter pair is found.
enum Finder {
    /// Lower ends of the cells along u and v.
    Grid([Vec<f64>; 2]),
    Leaves(Box<PhtSurface>),
}

impl Space {
    pub(super) fn of(surface: &AnySurface, border: KeptBorder) -> Result<Self, FairError> {
        let mut space = match surface {
            AnySurface::Tensor(surface) if surface.weights().is_none() => Self::of_tensor(surface),
            AnySurface::Pht(surface) if !surface.is_rational() => Self::of_pht(surface),
            AnySurface::Tensor(_) | AnySurface::Pht(_) => return Err(FairError::Rational),
            AnySurface::TSpline(_) | AnySurface::D1rc(_) => return Err(FairError::Family),
        };
        space.keep_border(border, &surface.as_surface().domain());
        Ok(space)
    }

    fn of_tensor(surface: &TensorSurface) -> Self {
        let [u, v] = [Axis::U, Axis::V].map(|axis| surface.knots(axis));
        let (p, q) = (u.degree(), v.degree());
        let pieces = |knots: &crate::knots::KnotVector| -> Vec<(usize, Vec<f64>)> {
            knots.spans().map(|span| (span, bezier::extraction(knots, span))).collect()
        };
        let (along_u, along_v) = (pieces(u), pieces(v));
        let mut cells = Vec::with_capacity(along_u.len() * along_v.len());
        for (span_u, rows_u) in &along_u {
            for (span_v, rows_v) in &along_v {
                let domain = Domain {
                    min: DVec2::new(u.knots()[*span_u], v.knots()[*span_v]),
                    max: DVec2::new(u.knots()[span_u + 1], v.knots()[span_v + 1]),
                };
                let of = |i: usize, j: usize| ((span_u - p + i) * v.basis_count() + span_v - q + j) as u32;
                let unknowns = (0..=p).flat_map(|i| (0..=q).map(move |j| of(i, j))).collect();
                let mut extraction = Vec::with_capacity(((p + 1) * (q + 1)).pow(2));
                for row_u in rows_u.chunks_exact(p + 1) {
                    for row_v in rows_v.chunks_exact(q + 1) {
                        extraction.extend(row_u.iter().flat_map(|a| row_v.iter().map(move |b| a * b)));
                    }
                }
                cells.push(Cell { domain, unknowns, extraction });
            }
        }
        let begins =
            |knots: &crate::knots::KnotVector| knots.spans().map(|span| knots.knots()[span]).collect();
        Self {
            dim: surface.control_points().len() / (u.basis_count() * v.basis_count()),
            degree: [p, q],
            cells,
            control_points: surface.control_points().to_vec(),
            is_kept: vec![false; u.basis_count() * v.basis_count()],
            finder: Finder::Grid([begins(u), begins(v)]),
        }
    }

    fn of_pht(surface: &PhtSurface) -> Self {
        let basis = surface.basis(Basis::SupportSized);
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let cell = |(leaf, &node): (usize, &crate::tmesh::NodeId)| {
            let local = basis.extraction(leaf);
            Cell {
                domain: mesh.cell_domain(mesh.cell(node)),
                unknowns: local.vertices.iter().flat_map(|&vertex| 4 * vertex..4 * vertex + 4).collect(),
                extraction: local.matrix,
            }
        };
        let control_points = surface.control_points(Basis::SupportSized);
        Self {
            dim: surface.width(),
            degree: [3, 3],
            cells: topology.leaves.iter().enumerate().map(cell).collect(),
            is_kept: vec![false; control_points.len() / surface.width()],
            control_points,
            finder: Finder::Leaves(Box::new(surface.clone())),
        }
    }

    /// Keeps the control points that the border is made of.
    fn keep_border(&mut self, border: KeptBorder, domain: &Domain) {
        let depth = match border {
            KeptBorder::None => return,
            KeptBorder::Position => 1,
            KeptBorder::Tangent => 2,
        };
        let [p, q] = self.degree;
        for cell in &self.cells {
            let is_at = |ordinate: usize| {
                let (i, j) = (ordinate / (q + 1), ordinate % (q + 1));
                (cell.domain.min.x <= domain.min.x && i < depth)
                    || (cell.domain.max.x >= domain.max.x && p - i < depth)
                    || (cell.domain.min.y <= domain.min.y && j < depth)
                    || (cell.domain.max.y >= domain.max.y && q - j < depth)
            };
            for (ordinate, weights) in cell.extraction.chunks_exact(cell.unknowns.len()).enumerate() {
                if is_at(ordinate) {
                    let acting = cell.unknowns.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
                    acting.for_each(|(&unknown, _)| self.is_kept[unknown as usize] = true);
                }
            }
        }
    }

    /// Number of control points.
    pub(super) fn count(&self) -> usize {
        self.is_kept.len()
    }

    /// The cell over a parameter pair of the domain.
    pub(super) fn cell_at(&self, uv: DVec2) -> usize {
        match &self.finder {
            Finder::Grid([u, v]) => {
                let rank =
                    |begins: &[f64], x: f64| begins.partition_point(|&begin| begin <= x).saturating_sub(1);
                rank(u, uv.x) * v.len() + rank(v, uv.y)
            }
            Finder::Leaves(surface) => surface.topology().leaf_of(surface.mesh().locate(uv)),
        }
    }

    /// The weights of the control points of a cell at a parameter pair in it.
    pub(super) fn weights_at(&self, cell: &Cell, uv: DVec2) -> Vec<f64> {
        let at = (uv - cell.domain.min) / cell.domain.size();
        let (along_u, along_v) = (bernstein(self.degree[0], at.x), bernstein(self.degree[1], at.y));
        let mut weights = vec![0.0; cell.unknowns.len()];
        let shares = along_u.iter().flat_map(|a| along_v.iter().map(move |b| a * b));
        for (share, row) in shares.zip(cell.extraction.chunks_exact(cell.unknowns.len())) {
            weights.iter_mut().zip(row).for_each(|(sum, x)| *sum += share * x);
        }
        weights
    }

    /// The ordinates of a cell of the patch that control points make: rows of `dim` numbers.
    pub(super) fn ordinates(&self, cell: &Cell, control_points: &[f64]) -> Vec<f64> {
        let dim = self.dim;
        let mut ordinates = vec![0.0; cell.extraction.len() / cell.unknowns.len() * dim];
        let rows = cell.extraction.chunks_exact(cell.unknowns.len()).zip(ordinates.chunks_exact_mut(dim));
        for (weights, row) in rows {
            for (&unknown, weight) in cell.unknowns.iter().zip(weights) {
                let point = &control_points[unknown as usize * dim..][..dim];
                row.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        ordinates
    }

    /// The surface with its control points displaced; trims and all else stay.
    pub(super) fn moved(&self, surface: &AnySurface, d: &[f64]) -> Result<AnySurface, FairError> {
        let mut moved = surface.clone();
        // an overflow is the one thing that can be wrong
        let add = |a: &[f64]| -> Vec<f64> { a.iter().zip(d).map(|(a, d)| a + d).collect() };
        match &mut moved {
            AnySurface::Tensor(surface) => {
                surface.set_control_points(&add(&self.control_points)).map_err(|_| FairError::Singular)?;
            }
            AnySurface::Pht(surface) => {
                // by the jets of the displacement: what is kept stays to the bit
                let zero = PhtSurface::zero(self.dim, false, surface.mesh().clone());
                let mut by = zero.map_err(|_| FairError::Singular)?;
                let ranks: Vec<usize> = (0..self.count() / 4).collect();
                by.set_control_points(&ranks, Basis::SupportSized, d).map_err(|_| FairError::Singular)?;
                let pairs = surface.jets().zip(by.jets());
                let jets: Vec<f64> = pairs
                    .flat_map(|((_, a), (_, d))| a.iter().zip(d).map(|(a, d)| a + d).collect::<Vec<_>>())
                    .collect();
                surface.set_jets(&ranks, &jets).map_err(|_| FairError::Singular)?;
            }
            _ => return Err(FairError::Family),
        }
        Ok(moved)
    }
}

/// The Bernstein polynomials of a degree at `x`.
fn bernstein(degree: usize, x: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for p in 1..=degree {
        let mut next = vec![0.0; p + 1];
        for (i, value) in values.iter().enumerate() {
            next[i] += (1.0 - x) * value;
            next[i + 1] += x * value;
        }
        values = next;
    }
    values
}
