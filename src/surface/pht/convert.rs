//! From tensor surfaces to PHT-splines.
//!
//! Deng et al. 2008, section 5.4. The jets are exact derivatives of the (homogeneous) surface. Over
//! all of its knot lines a surface of degree 3 at most is reproduced; within a tolerance cells are split from
//! one on until samples agree, and the error falls with the fourth power of their size.

use super::{PhtError, PhtSurface};
use crate::control::Watch;
use crate::geometry::Domain;
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Patches, Surface};
use crate::tmesh::{Cell, MAX_LEVEL, NodeId, TMesh, TMeshError, Topology, Vertex};
use glam::DVec2;
use std::collections::BTreeMap;

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

impl ConvertOptions {
    with_fields! {
        with_tolerance tolerance: f64,
        with_max_level max_level: u32,
        with_max_cells max_cells: usize,
    }
}

/// Intervals of samples a span and direction that decide whether a cell agrees.
const SAMPLES_PER_SPAN: usize = 4;
/// Levels by which cells that share an edge may differ. A fine cell has the error of its coarse neighbour at their
/// T-vertices: with one level it is split with it, with more it might be split for ever in vain.
const GRADE: u32 = 1;
/// Share of the tolerance that samples may use up: between them the distance is a little larger.
const MARGIN: f64 = 0.95;
/// Intervals of samples a direction that show first whether a cell is far off.
const FIRST_SAMPLES: usize = 4;

impl PhtSurface {
    /// The PHT-spline of a tensor surface, with its trims. Fails if the surface has a crease, and if the
    /// tolerance cannot be met within the limits.
    pub fn from_tensor(tensor: &TensorSurface, options: &ConvertOptions) -> Result<Self, PhtError> {
        Self::from_tensor_watched(tensor, options, &Watch::default())
    }

    /// The same as a part of a call that may be cancelled.
    pub fn from_tensor_watched(
        tensor: &TensorSurface,
        options: &ConvertOptions,
        watch: &Watch,
    ) -> Result<Self, PhtError> {
        let ConvertOptions { tolerance, max_level, max_cells } = *options;
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(PhtError::Tolerance { value: tolerance, range: "finite and not negative" });
        }
        check_smoothness(tensor)?;
        let source = Source::new(tensor)?;
        let mut surface = if tolerance > 0.0 {
            source.within(tolerance, max_level.min(MAX_LEVEL), max_cells, watch)?
        } else {
            source.exact(max_cells, watch)?
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
        let points = rows.flat_map(|(point, &w)| point.iter().map(move |x| w * x).chain([w])).collect_vec();
        let [knots_u, knots_v] = [Axis::U, Axis::V].map(|axis| tensor.knots(axis).clone());
        // a product of a finite point and weight may overflow
        let homogeneous = TensorSurface::new(dim + 1, knots_u, knots_v, points, None);
        Ok(Self { tensor, homogeneous: homogeneous.map_err(|_| PhtError::NotFinite { index: 0 })? })
    }

    fn exact(&self, max_cells: usize, watch: &Watch) -> Result<PhtSurface, PhtError> {
        let knots = [Axis::U, Axis::V].map(|axis| self.tensor.knots(axis));
        if knots.iter().any(|knots| knots.degree() > 3) {
            return Err(PhtError::Tolerance { value: 0.0, range: "positive for degrees above 3" });
        }
        let count = self.tensor.patch_count();
        if count > max_cells {
            return Err(PhtError::TooLarge { what: "cells", count, limit: max_cells });
        }
        let mesh = TMesh::new(&knots[0].breaks(), &knots[1].breaks())?;
        let surface = self.over(mesh, &BTreeMap::new(), watch)?;
        surface.check_weights()?;
        Ok(surface)
    }

    /// The spline with the source's jets at the vertices of a mesh; those in `known` need not be computed. Its
    /// weights are still to be looked at.
    fn over(
        &self,
        mesh: TMesh,
        known: &BTreeMap<Vertex, Vec<f64>>,
        watch: &Watch,
    ) -> Result<PhtSurface, PhtError> {
        let topology = Topology::new(&mesh);
        watch.check()?;
        let vertices: Vec<Vertex> =
            topology.basis.iter().map(|&vertex| topology.vertices[vertex as usize]).collect_vec();
        let new = vertices.iter().filter(|vertex| !known.contains_key(vertex));
        let uv: Vec<DVec2> = new.map(|&vertex| mesh.parameters(vertex)).collect_vec();
        let width = self.homogeneous.dim();
        let mut rows = memory::filled(0.0, uv.len() * 6 * width);
        self.homogeneous.eval_rows(&uv, 2, &mut rows);
        watch.check()?;
        // of S, Su, Sv, Suu, Suv, Svv those of a jet
        let jet = |rows: &[f64]| [0, 1, 2, 4].map(|row| &rows[row * width..][..width]).concat();
        let mut computed = rows.chunks_exact(6 * width).map(jet);
        let jets: Vec<f64> = vertices
            .iter()
            .filter_map(|vertex| known.get(vertex).cloned().or_else(|| computed.next()))
            .flatten()
            .collect_vec();
        PhtSurface::with_any_weights(self.tensor.dim(), self.tensor.weights().is_some(), mesh, &jets)
    }

    fn within(
        &self,
        tolerance: f64,
        max_level: u32,
        max_cells: usize,
        watch: &Watch,
    ) -> Result<PhtSurface, PhtError> {
        let Domain { min, max } = self.tensor.domain();
        let mut mesh = TMesh::new(&[min.x, max.x], &[min.y, max.y])?;
        let mut known = BTreeMap::new();
        // leaves that agreed, with their ordinates
        let mut settled: BTreeMap<Cell, Vec<f64>> = BTreeMap::new();
        loop {
            let surface = self.over(mesh, &known, watch)?;
            let leaves = surface.topology().leaves.iter().map(|&node| surface.mesh.cell(node)).enumerate();
            // a coarse patch may follow the surface so badly that its weights are not positive
            let mut is_rough = |&(leaf, cell): &(usize, Cell)| {
                let ordinates = surface.view().leaf_ordinates(leaf);
                // what a cancelled call decides is thrown away
                if watch.check().is_err() {
                    return false;
                }
                if settled.get(&cell).is_some_and(|before| before == ordinates) {
                    return false;
                }
                let is_rough =
                    !(surface.least_weight(leaf) > 0.0) || self.deviates(&surface, cell, tolerance);
                if !is_rough {
                    settled.insert(cell, memory::copied(ordinates));
                }
                is_rough
            };
            let rough: Vec<Cell> = leaves.filter(&mut is_rough).map(|(_, cell)| cell).collect_vec();
            watch.check()?;
            if rough.is_empty() {
                return Ok(surface);
            }
            (mesh, known) = (surface.mesh, surface.jets);
            let mut allow = |mesh: &TMesh, leaf: NodeId| {
                let (level, count) = (mesh.cell(leaf).level, mesh.leaf_count() + 3);
                if level >= max_level {
                    return Err(
                        TMeshError::LevelLimit { index: leaf.index(), level, limit: max_level }.into()
                    );
                }
                if count > max_cells {
                    return Err(PhtError::TooLarge { what: "cells", count, limit: max_cells });
                }
                Ok(())
            };
            for cell in rough {
                watch.check()?;
                // it may have been split to make another's neighbours fine enough
                if let Some(leaf) = mesh.find(cell).filter(|&node| mesh.is_leaf(node)) {
                    mesh.split_graded(leaf, GRADE, &mut allow)?;
                }
            }
        }
    }

    /// Whether samples on a cell differ by more than the tolerance: first a few, then some in each span.
    fn deviates(&self, surface: &PhtSurface, cell: Cell, tolerance: f64) -> bool {
        let Domain { min, max } = surface.mesh.cell_domain(cell);
        let fine = |axis: Axis, from: f64, to: f64| {
            let knots: &KnotVector = self.tensor.knots(axis);
            SAMPLES_PER_SPAN * (knots.rank_at(to) - knots.rank_at(from) + 1)
        };
        let fine = [fine(Axis::U, min.x, max.x), fine(Axis::V, min.y, max.y)];
        let first = fine.map(|count| count.min(FIRST_SAMPLES));
        [first, fine].into_iter().enumerate().any(|(round, counts)| {
            (round == 0 || counts != first) && self.differs(surface, Domain { min, max }, counts, tolerance)
        })
    }

    /// Whether some place of a grid of so many intervals differs.
    fn differs(&self, surface: &PhtSurface, domain: Domain, counts: [usize; 2], tolerance: f64) -> bool {
        let dim = self.tensor.dim();
        let place = |i: usize, j: usize| {
            domain.min + domain.size() * DVec2::new(i as f64 / counts[0] as f64, j as f64 / counts[1] as f64)
        };
        let mut rows =
            [memory::filled(0.0, (counts[1] + 1) * dim), memory::filled(0.0, (counts[1] + 1) * dim)];
        (0..=counts[0]).any(|i| {
            let uv: Vec<DVec2> = (0..=counts[1]).map(|j| place(i, j)).collect_vec();
            self.tensor.eval_rows(&uv, 0, &mut rows[0]);
            surface.eval_rows(&uv, 0, &mut rows[1]);
            let points = rows[0].chunks_exact(dim).zip(rows[1].chunks_exact(dim));
            let square =
                |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            points.map(square).any(|square| !(square.sqrt() <= MARGIN * tolerance))
        })
    }
}
