//! Fields on the nodes of the mesh that a model of patches was fitted to.
//!
//! The space is that of the shape: the same layout, the same edge functions, k components in place of three. Where
//! `A_p + B_q = g E'` holds for the shape and, with the same g, for the field, the field is C1 along the shape across
//! edges: its gradient in space is continuous. The least squares are linear in the values,
//! ```text
//! Z^T (B^T N^T W N B + smoothing E) Z y = Z^T B^T N^T W x
//! ```
//! with Z from free unknowns to jets, N from jets to samples and B from nodes to samples (nodes, centroids of facets, middles of
//! edges), so that the left side is factored once for all fields; enclosure equations as for the shape.

mod piece;
#[cfg(test)]
mod tests;
pub mod transfer;

use super::split::{LEAST_SAMPLES, SplitLimits, split_cells};
use crate::control::{Control, Pool, Stage};
use crate::fit::common::checks::check_unused;
use crate::fit::common::errors::summarize;
use crate::fit::common::report::{FitReport, Goal, Remarks, StopReason, Tolerance};
use crate::fit::common::{FitError, Missing};
use crate::fit::field::{FieldError, FieldGrid, FieldOptions, FieldReport};
use crate::fit::found_grid::SampleField;
use crate::geometry::{Bounds, Domain};
use crate::layout::{Layout, Place};
use crate::mesh::Mesh;
use crate::model::{Model, ModelField, Origin};
use crate::summary::sum;
use crate::surface::Surface;
use crate::surface::pht::PhtSurface;
use crate::tmesh::TMesh;
use piece::PieceFitter;
use std::time::Instant;

/// Rounds in which cells are split until a sample field keeps the tolerance.
const MOST_ROUNDS: usize = 12;

/// Fits fields over the patches of one model, again and again.
#[derive(Debug)]
pub struct ModelFieldFitter {
    pieces: Vec<PieceFitter>,
    /// Flat numbers of patches, piece after piece.
    patch_of_face: Vec<u32>,
    /// Nodes with values and places, ascending.
    known: Vec<u32>,
    node_count: usize,
    smoothing: f64,
    tolerance: Tolerance,
    passes: usize,
    pool: Pool,
}

/// Where the nodes lie on the patches of a piece.
struct Patches<'a> {
    layout: &'a Layout,
    meshes: Vec<TMesh>,
    places: Vec<Option<Place>>,
}

impl ModelFieldFitter {
    /// For fields on the nodes of the mesh that the model was fitted to, over the cells of the model; with a sample, over
    /// cells that are split until it keeps the tolerance or no cell has enough nodes. What the options say of grid,
    /// buffer, ends, energy and parameters is not looked at, but a fixed grid is refused.
    pub fn new(
        model: &Model,
        mesh: &Mesh,
        options: &FieldOptions,
        sample: Option<SampleField>,
        control: &mut Control,
    ) -> Result<Self, FieldError> {
        let origin = model.origin().ok_or(FieldError::NotFitted)?;
        let patches = patches_of(origin)?;
        let node_count = mesh.points().len();
        if node_count != origin.nodes.len() {
            let (count, expected) = (node_count, origin.nodes.len());
            return Err(FitError::Count { what: "the nodes of the mesh", count, expected }.into());
        }
        options.check(node_count)?;
        check_unused(options.missing == Missing::default(), "missing", "the fitter of fields over a model")?;
        if let FieldGrid::Fixed([count, _]) = options.grid {
            let range = "0: patches have cells of their own";
            return Err(FitError::Option { option: "grid_u", value: count as f64, range }.into());
        }
        let is_known = |node: u32| {
            origin.nodes[node as usize].is_some()
                && options.is_known.is_none_or(|is_known| is_known[node as usize])
        };
        let known: Vec<u32> = (0..node_count as u32).filter(|&node| is_known(node)).collect();
        if known.len() < 3 {
            return Err(FitError::TooFew { count: known.len() }.into());
        }
        if let Some(sample) = &sample {
            check(&known, node_count, sample.values, sample.dim)?;
        }
        control.enter(Stage::Fit);
        let mut fitter = Self {
            pieces: Vec::new(),
            patch_of_face: flat_patches(origin)?,
            known,
            node_count,
            smoothing: options.smoothing,
            tolerance: options.tolerance,
            passes: 1,
            pool: Pool::new(control.thread_count()),
        };
        let goal = sample.map(|sample| {
            let tolerance =
                Goal::new(&options.tolerance, &fitter.bounds(sample.values, sample.dim)).tolerance;
            (sample, tolerance)
        });
        let count = patches.len() as f64;
        for (number, of_piece) in patches.into_iter().enumerate() {
            control.report(number as f64 / count, f64::NAN)?;
            let made = control.watch(|pool, watch| {
                let mut of_piece = of_piece;
                let mut passes = 1;
                loop {
                    let Patches { layout, meshes, places } = &of_piece;
                    let piece = PieceFitter::new((layout, meshes), mesh, places, options, pool, watch)?;
                    watch.check()?;
                    let finer = match &goal {
                        Some((sample, tolerance)) if passes < MOST_ROUNDS => {
                            fitter.finer(&piece, sample, *tolerance, pool)?
                        }
                        _ => None,
                    };
                    let Some(meshes) = finer else { return Ok((piece, passes)) };
                    of_piece.meshes = meshes;
                    passes += 1;
                }
            })?;
            let (piece, passes) = made.map_err(|error: FieldError| error)?;
            fitter.passes = fitter.passes.max(passes);
            fitter.pieces.push(piece);
        }
        control.report(1.0, f64::NAN)?;
        Ok(fitter)
    }

    /// Number of nodes, those without values included.
    pub fn node_count(&self) -> usize {
        self.node_count
    }

    /// Fits rows of `dim` numbers, one a node.
    pub fn fit(&self, values: &[f64], dim: usize) -> Result<ModelField, FieldError> {
        self.check(values, dim)?;
        let center = self.center(values, dim);
        let mut patches = Vec::new();
        for piece in &self.pieces {
            let unknowns = piece.unknowns(values, dim, &center, &self.pool);
            patches.extend(piece.surfaces(&unknowns, dim, &center)?);
        }
        Ok(ModelField::new(patches, self.patch_of_face.clone()).ok_or(FitError::Singular)?)
    }

    /// Measures a field of this fitter against values.
    pub fn measure(&self, field: &ModelField, values: &[f64], dim: usize) -> Result<FieldReport, FieldError> {
        let start = Instant::now();
        self.check(values, dim)?;
        if field.dim() != dim || field.patch_of_face() != self.patch_of_face {
            return Err(FieldError::OtherGrid);
        }
        let mut each = vec![f64::NAN; self.node_count];
        let mut first = 0;
        for piece in &self.pieces {
            let patches = &field.patches()[first..first + piece.meshes.len()];
            first += piece.meshes.len();
            for (&node, error) in piece.nodes.iter().zip(errors_at_nodes(piece, patches, values, dim)) {
                each[node as usize] = error;
            }
        }
        let mut errors = summarize(self.known.iter().map(|&node| each[node as usize]).collect());
        errors.worst_index = self.known[errors.worst_index] as usize;
        errors.each = each;
        let goal = Goal::new(&self.tolerance, &self.bounds(values, dim));
        let cells = || self.pieces.iter().flat_map(|piece| &piece.meshes);
        let level = |mesh: &TMesh| mesh.leaves().map(|leaf| mesh.cell(leaf).level).max().unwrap_or(0);
        let mut fit = FitReport {
            cell_count: cells().map(TMesh::leaf_count).sum(),
            deepest_level: cells().map(level).max().unwrap_or(0),
            coefficient_count: self.pieces.iter().map(PieceFitter::coefficient_count).sum(),
            smoothing: self.smoothing,
            seconds: start.elapsed().as_secs_f64(),
            ..FitReport::new(&errors, &goal, StopReason::FixedGrid, self.passes)
        };
        fit.remarks.add_if(errors.max > goal.tolerance, Remarks::TOLERANCE_NOT_MET);
        Ok(FieldReport { fit, errors: errors.each })
    }

    fn check(&self, values: &[f64], dim: usize) -> Result<(), FieldError> {
        self.pool.check_process()?;
        Ok(check(&self.known, self.node_count, values, dim)?)
    }

    /// The mean of the values of all nodes that have any.
    fn center(&self, values: &[f64], dim: usize) -> Vec<f64> {
        let share = 1.0 / self.known.len() as f64;
        let component = |k: usize| self.known.iter().map(move |&node| values[node as usize * dim + k]);
        (0..dim).map(|k| share * sum(component(k))).collect()
    }

    fn bounds(&self, values: &[f64], dim: usize) -> Bounds {
        let rows = self.known.iter().flat_map(|&node| &values[node as usize * dim..][..dim]);
        Bounds::of_rows(&rows.copied().collect::<Vec<f64>>(), dim)
    }

    /// The cells with those split in which a node misses the tolerance; None if there are none to split.
    fn finer(
        &self,
        piece: &PieceFitter,
        sample: &SampleField,
        tolerance: f64,
        pool: &Pool,
    ) -> Result<Option<Vec<TMesh>>, FieldError> {
        let SampleField { values, dim } = *sample;
        let center = self.center(values, dim);
        let unknowns = piece.unknowns(values, dim, &center, pool);
        let patches = piece.surfaces(&unknowns, dim, &center)?;
        let errors = errors_at_nodes(piece, &patches, values, dim);
        let is_rough =
            |&sample: &u32| errors.get(sample as usize).is_some_and(|&error| !(error <= tolerance));
        let mut meshes = piece.meshes.clone();
        let is_to_split = |cell: usize, _: &Domain| {
            let samples = piece.by_cell.of(cell);
            samples.len() >= LEAST_SAMPLES && samples.iter().any(is_rough)
        };
        let is_split = split_cells(&piece.layout, &mut meshes, SplitLimits::default(), is_to_split).is_ok();
        Ok(is_split.then_some(meshes))
    }
}

/// Distances between values and a field at the nodes of a piece, through its public evaluation.
fn errors_at_nodes(piece: &PieceFitter, patches: &[PhtSurface], values: &[f64], dim: usize) -> Vec<f64> {
    let mut row = vec![0.0; dim];
    let nodes = piece.nodes.iter().zip(&piece.places);
    let error = |(&node, place): (&u32, &Place)| {
        patches[place.quad as usize].eval_rows(&[place.uv], 0, &mut row);
        let value = &values[node as usize * dim..][..dim];
        row.iter().zip(value).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    nodes.map(error).collect()
}

/// Each piece with the places of all nodes, None for those of other pieces.
fn patches_of(origin: &Origin) -> Result<Vec<Patches<'_>>, FieldError> {
    if origin.pieces.is_empty() {
        return Err(FieldError::NoPatches);
    }
    let mut patches: Vec<Patches> = origin
        .pieces
        .iter()
        .map(|piece| Patches {
            layout: piece.layout(),
            meshes: piece.meshes(),
            places: vec![None; origin.nodes.len()],
        })
        .collect();
    for (number, node) in origin.nodes.iter().enumerate() {
        if let Some(node) = node
            && let Some([piece, quad]) = origin.patch_of_face[node.face.index()]
        {
            patches[piece as usize].places[number] = Some(Place { quad, uv: node.uv });
        }
    }
    Ok(patches)
}

/// The patch of each face by its number among those of all pieces.
fn flat_patches(origin: &Origin) -> Result<Vec<u32>, FieldError> {
    let mut firsts = vec![0];
    for piece in &origin.pieces {
        firsts.push(firsts[firsts.len() - 1] + piece.splits().len() as u32);
    }
    let flat = |(face, patch): (usize, &Option<[u32; 2]>)| match patch {
        Some([piece, quad]) => Ok(firsts[*piece as usize] + quad),
        None => Err(FieldError::NoPatch { face }),
    };
    origin.patch_of_face.iter().enumerate().map(flat).collect()
}

/// Refuses values that are not one finite row for each node that has any.
fn check(known: &[u32], node_count: usize, values: &[f64], dim: usize) -> Result<(), FitError> {
    if dim == 0 {
        return Err(FitError::Option { option: "dim", value: 0.0, range: "at least 1" });
    }
    let expected = node_count.saturating_mul(dim);
    if values.len() != expected {
        return Err(FitError::Count { what: "the values", count: values.len(), expected });
    }
    let is_finite = |node: u32| values[node as usize * dim..][..dim].iter().all(|x| x.is_finite());
    match known.iter().find(|&&node| !is_finite(node)) {
        Some(&node) => Err(FitError::ValuesNotFinite { index: node as usize }),
        None => Ok(()),
    }
}
