//! From tensor surfaces to PHT-splines.
//!
//! Deng et al. 2008, section 5.4; `pht.md` 3. The jets are exact derivatives of the (homogeneous) surface. Over
//! all of its knot lines a surface of degree 3 at most is reproduced; within a tolerance cells are split from
//! one on until samples agree, and the error falls with the fourth power of their size.

use super::jet::ROWS;
use super::mesh::{Cell, MAX_LEVEL, NodeId, TMesh};
use super::topology::Topology;
use super::{PhtError, PhtSurface};
use crate::geometry::Domain;
use crate::knots::KnotVector;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Patches, Surface};
use glam::DVec2;

/// How to convert a tensor surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvertOptions {
    /// Largest distance at equal parameters, in model units; 0 (default) takes all knot lines, which is exact up
    /// to degree 3.
    pub tolerance: f64,
    /// Deepest level of a cell, at most [`MAX_LEVEL`]. Default 12.
    pub max_level: u32,
    /// Most cells. Default 200,000.
    pub max_cells: usize,
}

impl Default for ConvertOptions {
    fn default() -> Self {
        Self { tolerance: 0.0, max_level: 12, max_cells: 200_000 }
    }
}

/// Samples a span and direction that decide whether a cell agrees.
const SAMPLES_PER_SPAN: usize = 4;
/// Levels by which cells that share an edge may differ. A fine cell has the error of its coarse neighbour at their
/// T-vertices: with one level it is split with it, with more it might be split for ever in vain.
const GRADE: u32 = 1;
/// Samples a direction that show first whether a cell is far off.
const FIRST_SAMPLES: usize = 4;

impl PhtSurface {
    /// The PHT-spline of a tensor surface, with its trims. Fails if the surface has a crease, and if the
    /// tolerance cannot be met within the limits.
    pub fn from_tensor(tensor: &TensorSurface, options: &ConvertOptions) -> Result<Self, PhtError> {
        let ConvertOptions { tolerance, max_level, max_cells } = *options;
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(PhtError::Tolerance { value: tolerance, range: "finite and not negative" });
        }
        check_smoothness(tensor)?;
        let source = Source::new(tensor)?;
        let mut surface = if tolerance > 0.0 {
            source.within(tolerance, max_level.min(MAX_LEVEL), max_cells)?
        } else {
            source.exact(max_cells)?
        };
        *surface.region_mut() = tensor.region().clone();
        Ok(surface)
    }
}

/// No knot inside may be so multiple that the surface is only continuous there.
fn check_smoothness(tensor: &TensorSurface) -> Result<(), PhtError> {
    for axis in [Axis::U, Axis::V] {
        let (t, degree) = (tensor.knots(axis).knots(), tensor.knots(axis).degree());
        let (from, to) = tensor.knots(axis).domain();
        let crease =
            t.windows(degree).position(|run| from < run[0] && run[0] == run[degree - 1] && run[0] < to);
        if let Some(index) = crease {
            return Err(PhtError::Crease { axis, index });
        }
    }
    Ok(())
}

/// The surface to convert, and its homogeneous form as a polynomial surface of one more dimension.
struct Source<'a> {
    tensor: &'a TensorSurface,
    homogeneous: TensorSurface,
}

impl<'a> Source<'a> {
    fn new(tensor: &'a TensorSurface) -> Result<Self, PhtError> {
        let Some(weights) = tensor.weights() else {
            return Ok(Self { tensor, homogeneous: tensor.clone() });
        };
        let dim = tensor.dim();
        let rows = tensor.control_points().chunks_exact(dim).zip(weights);
        let points = rows.flat_map(|(point, &w)| point.iter().map(move |x| w * x).chain([w])).collect();
        let [knots_u, knots_v] = [Axis::U, Axis::V].map(|axis| tensor.knots(axis).clone());
        // a product of a finite point and weight may overflow
        let homogeneous = TensorSurface::new(dim + 1, knots_u, knots_v, points, None);
        Ok(Self { tensor, homogeneous: homogeneous.map_err(|_| PhtError::NotFinite { index: 0 })? })
    }

    fn exact(&self, max_cells: usize) -> Result<PhtSurface, PhtError> {
        let knots = [Axis::U, Axis::V].map(|axis| self.tensor.knots(axis));
        if knots.iter().any(|knots| knots.degree() > 3) {
            return Err(PhtError::Tolerance { value: 0.0, range: "positive for degrees above 3" });
        }
        let count = self.tensor.patch_count();
        if count > max_cells {
            return Err(PhtError::TooLarge { what: "cells", count, limit: max_cells });
        }
        let surface = self.over(TMesh::new(&knots[0].breaks(), &knots[1].breaks())?)?;
        surface.check_weights()?;
        Ok(surface)
    }

    /// The spline with the source's jets at the vertices of a mesh; its weights are still to be looked at.
    fn over(&self, mesh: TMesh) -> Result<PhtSurface, PhtError> {
        let topology = Topology::new(&mesh);
        let vertices = topology.basis.iter().map(|&vertex| topology.vertices[vertex as usize]);
        let uv: Vec<DVec2> = vertices.map(|vertex| mesh.parameters(vertex)).collect();
        let width = self.homogeneous.dim();
        let mut rows = vec![0.0; uv.len() * 6 * width];
        self.homogeneous.eval_rows(&uv, 2, &mut rows);
        // of S, Su, Sv, Suu, Suv, Svv those of a jet
        let jets: Vec<f64> = rows
            .chunks_exact(6 * width)
            .flat_map(|rows| [0, 1, 2, 4].into_iter().flat_map(move |row| &rows[row * width..][..width]))
            .copied()
            .collect();
        debug_assert_eq!(jets.len(), uv.len() * ROWS * width);
        PhtSurface::with_any_weights(self.tensor.dim(), self.tensor.weights().is_some(), mesh, &jets)
    }

    fn within(&self, tolerance: f64, max_level: u32, max_cells: usize) -> Result<PhtSurface, PhtError> {
        let Domain { min, max } = self.tensor.domain();
        let mut mesh = TMesh::new(&[min.x, max.x], &[min.y, max.y])?;
        loop {
            let surface = self.over(mesh)?;
            let leaves = surface.topology().leaves.iter().map(|&node| surface.mesh.cell(node)).enumerate();
            // a coarse patch may follow the surface so badly that its weights are not positive
            let is_rough = |&(leaf, cell): &(usize, Cell)| {
                !(surface.least_weight(leaf) > 0.0) || self.deviates(&surface, cell, tolerance)
            };
            let rough: Vec<Cell> = leaves.filter(is_rough).map(|(_, cell)| cell).collect();
            if rough.is_empty() {
                return Ok(surface);
            }
            mesh = surface.mesh;
            let mut allow = |mesh: &TMesh, leaf: NodeId| {
                let (level, count) = (mesh.cell(leaf).level, mesh.leaf_count() + 3);
                if level >= max_level {
                    return Err(PhtError::LevelLimit { index: leaf.index(), level, limit: max_level });
                }
                if count > max_cells {
                    return Err(PhtError::TooLarge { what: "cells", count, limit: max_cells });
                }
                Ok(())
            };
            for cell in rough {
                // it may have been split to make another's neighbours fine enough
                if let Some(leaf) = mesh.find(cell).filter(|&node| mesh.is_leaf(node)) {
                    mesh.split_graded(leaf, GRADE, &mut allow)?;
                }
            }
        }
    }

    /// Whether samples on a cell differ by more than the tolerance.
    fn deviates(&self, surface: &PhtSurface, cell: Cell, tolerance: f64) -> bool {
        let domain = surface.mesh.cell_domain(cell);
        let places = |count: usize, from: f64, to: f64| -> Vec<f64> {
            (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).collect()
        };
        let fine = |axis: Axis, from: f64, to: f64| {
            let knots: &KnotVector = self.tensor.knots(axis);
            let spans = knots.rank_at(to) - knots.rank_at(from) + 1;
            places(SAMPLES_PER_SPAN * spans, from, to)
        };
        let Domain { min, max } = domain;
        let first = [places(FIRST_SAMPLES, min.x, max.x), places(FIRST_SAMPLES, min.y, max.y)];
        self.differs(surface, first, tolerance)
            || self.differs(surface, [fine(Axis::U, min.x, max.x), fine(Axis::V, min.y, max.y)], tolerance)
    }

    fn differs(&self, surface: &PhtSurface, [u, v]: [Vec<f64>; 2], tolerance: f64) -> bool {
        let dim = self.tensor.dim();
        let mut rows = [vec![0.0; v.len() * dim], vec![0.0; v.len() * dim]];
        u.iter().any(|&u| {
            self.tensor.eval_grid(&[u], &v, &mut rows[0]);
            surface.eval_grid(&[u], &v, &mut rows[1]);
            let points = rows[0].chunks_exact(dim).zip(rows[1].chunks_exact(dim));
            let square =
                |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            points.map(square).any(|square| !(square.sqrt() <= tolerance))
        })
    }
}
