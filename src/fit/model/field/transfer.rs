//! Values between meshes over the patches of a model: `out = T values`, and forces back by the exact transpose.
//!
//! As for [fields over one chart](crate::fit::field::transfer), with the smooth spaces of the patches in place of the grid:
//! the points of the source are fitted by the same least squares, the targets projected onto that shape, and
//! ```text
//! T = N_targets A^-1 N_source^T W,    T^T = W N_source A^-1 N_targets^T
//! ```
//! with the mean of the values taken off before and added after, so that constants arrive and forces keep their sum.

use super::piece::Readings;
use super::{ModelFieldFitter, check};
use crate::control::Control;
use crate::fit::common::FitError;
use crate::fit::field::FieldError;
use crate::fit::field::transfer::{
    Carry, Shape, TransferError, TransferOptions, TransferReport, check_room, project_in_pieces,
};
use crate::layout::Place;
use crate::mesh::Mesh;
use crate::model::{ModelProjector, Patchwork, of_patches};
use crate::query::project::ProjectOptions;
use crate::summary::sum;
use glam::DVec3;

/// Carries values from the nodes of the mesh of a model to any points near it, and forces back.
#[derive(Debug)]
pub struct ModelTransfer {
    fitter: ModelFieldFitter,
    source_points: Vec<DVec3>,
    target_points: Vec<DVec3>,
    distances: Vec<f64>,
    /// By piece: which targets lie on it, and where.
    targets: Vec<(Vec<u32>, Readings)>,
}

/// By how much the levels of cells in one face of the shape may differ.
const LEVEL_SPREAD: u32 = 1;

impl ModelTransfer {
    /// From the nodes of a mesh, for which `fitter` was made, to any points near it. What `options` say of fields is not
    /// looked at.
    pub fn with_fitter(
        fitter: ModelFieldFitter,
        source: &Mesh,
        targets: &[DVec3],
        options: &TransferOptions,
        control: &mut Control,
    ) -> Result<(Self, TransferReport), TransferError> {
        let shape = Shape::fit(source, targets, options, |positions| {
            let field = fitter.fit(positions, 3)?;
            let report = fitter.measure(&field, positions, 3)?.fit;
            Ok((field, report))
        })?;
        let mut first = 0;
        let patchworks: Vec<Patchwork> = fitter
            .pieces
            .iter()
            .map(|piece| {
                let surfaces = &shape.surface.patches()[first..first + piece.meshes.len()];
                first += surfaces.len();
                Patchwork { layout: &piece.layout, surfaces, planes: None, labels: &[], void_in: None }
            })
            .collect();
        let stitched = of_patches(&patchworks, LEVEL_SPREAD).map_err(FieldError::from)?;
        let patch_of_face = stitched.patch_of_face();
        let projector = ModelProjector::new(&stitched.model)?;
        let (mut faces, mut uv) = (Vec::new(), Vec::new());
        let distances = project_in_pieces(targets, control, |points, pool| {
            let feet = projector.project(points, &ProjectOptions::default(), pool)?;
            faces.extend(feet.faces);
            uv.extend(feet.uv);
            Ok(feet.distances)
        })?;
        let mut places = vec![(Vec::new(), Vec::new()); fitter.pieces.len()];
        for (target, (face, &uv)) in (0_u32..).zip(faces.iter().zip(&uv)) {
            let Some([piece, quad]) = face.and_then(|face| patch_of_face[face.index()]) else { continue };
            let (numbers, of_piece): &mut (Vec<u32>, Vec<Place>) = &mut places[piece as usize];
            numbers.push(target);
            of_piece.push(Place { quad, uv });
        }
        let of_piece = |(piece, (numbers, places)): (&super::PieceFitter, (Vec<u32>, Vec<Place>))| {
            Ok((numbers, piece.readings(places, &fitter.pool)?))
        };
        let at_targets: Result<Vec<_>, FieldError> = fitter.pieces.iter().zip(places).map(of_piece).collect();
        let (_, distances, report) = shape.report(options, distances)?;
        let transfer = Self {
            targets: at_targets?,
            fitter,
            source_points: source.points().to_vec(),
            target_points: targets.to_vec(),
            distances,
        };
        Ok((transfer, report))
    }
}

impl Carry for ModelTransfer {
    fn source_points(&self) -> &[DVec3] {
        &self.source_points
    }

    fn target_points(&self) -> &[DVec3] {
        &self.target_points
    }

    fn distances(&self) -> &[f64] {
        &self.distances
    }

    fn apply(&self, values: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError> {
        let fitter = &self.fitter;
        fitter.check(values, dim)?;
        check_room("the values at the targets", out, self.target_points.len(), dim)?;
        let center = fitter.center(values, dim);
        for (piece, (numbers, at)) in fitter.pieces.iter().zip(&self.targets) {
            let unknowns = piece.unknowns(values, dim, &center, &fitter.pool);
            let rows = piece.read(at, &unknowns, dim, &fitter.pool);
            for (&target, row) in numbers.iter().zip(rows.chunks_exact(dim)) {
                let to = &mut out[target as usize * dim..][..dim];
                to.iter_mut().zip(row).zip(&center).for_each(|((to, x), c)| *to = x + c);
            }
        }
        Ok(())
    }

    fn apply_transpose(&self, forces: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError> {
        let fitter = &self.fitter;
        fitter.pool.check_process().map_err(FieldError::from)?;
        let all: Vec<u32> = (0..self.target_points.len() as u32).collect();
        check(&all, self.target_points.len(), forces, dim).map_err(of_forces)?;
        check_room("the forces at the nodes", out, self.source_points.len(), dim)?;
        out.fill(0.0);
        for (piece, (numbers, at)) in fitter.pieces.iter().zip(&self.targets) {
            let rows: Vec<f64> =
                numbers.iter().flat_map(|&target| &forces[target as usize * dim..][..dim]).copied().collect();
            let unknowns = piece.unknowns_of_forces(at, &rows, dim, &fitter.pool);
            piece.add_to_nodes(&unknowns, dim, out, &fitter.pool);
        }
        // the transpose of taking the mean off before, and adding it after
        let share = 1.0 / fitter.known.len() as f64;
        for k in 0..dim {
            let given = sum(forces.iter().skip(k).step_by(dim).copied());
            let arrived = sum(out.iter().skip(k).step_by(dim).copied());
            fitter.known.iter().for_each(|&node| out[node as usize * dim + k] += share * (given - arrived));
        }
        Ok(())
    }
}

/// The same said of forces.
fn of_forces(error: FitError) -> FitError {
    match error {
        FitError::Count { count, expected, .. } => FitError::Count { what: "the forces", count, expected },
        other => other,
    }
}
