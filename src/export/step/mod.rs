//! STEP files of models: surfaces as shells of faces that share edges, and solids.
//!
//! ISO 10303-21 (clear text), 10303-42 (geometry and topology), application protocols 214 and 242. Faces lie on a
//! `B_SPLINE_SURFACE_WITH_KNOTS` (rational where the surface has weights), a `PLANE` or a `CYLINDRICAL_SURFACE`. Edges
//! are written once, with their curve in space (a `LINE`, `CIRCLE`, `ELLIPSE` or spline) and the p-curves of both sides. A solid is a `MANIFOLD_SOLID_BREP`, or a
//! `BREP_WITH_VOIDS`; open shells are a `SHELL_BASED_SURFACE_MODEL`.
//!
//! Equal input gives equal bytes.

mod net;
mod part21;
mod write;

use super::error::ExportError;
use crate::control::{Cancelled, Watch};
use crate::failure::{Classify, ErrorKind};
use crate::file;
use crate::model::{CURVE_TOLERANCE, Model};
use crate::surface::tensor::TensorError;
use std::path::Path;

/// The application protocol of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Schema {
    /// Automotive design; read by every CAD system.
    #[default]
    Ap214,
    /// Managed model-based 3D engineering.
    Ap242,
}

pub use crate::surface::Unit;

/// What a file says beside the shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepOptions<'a> {
    /// The application protocol.
    pub schema: Schema,
    /// What one model unit is.
    pub unit: Unit,
    /// Name of the product.
    pub product: &'a str,
    /// Who made it.
    pub author: &'a str,
    /// For whom.
    pub organization: &'a str,
    /// When, as `2026-01-31T12:00:00`; always the same by default, so that equal input gives equal bytes.
    pub timestamp: &'a str,
}

impl Default for StepOptions<'_> {
    fn default() -> Self {
        Self {
            schema: Schema::default(),
            unit: Unit::default(),
            product: "surface",
            author: "",
            organization: "",
            timestamp: "1970-01-01T00:00:00",
        }
    }
}

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Faces.
    pub face_count: usize,
    /// Control points of the surfaces of all faces.
    pub pole_count: usize,
    /// Bounds of all faces, the outer ones included.
    pub loop_count: usize,
    /// Edges; one between two faces counts once.
    pub edge_count: usize,
    /// Largest distance between a curve in space and the image of its p-curve, measured on the curves written.
    pub curve_deviation: f64,
    /// The file's uncertainty, in model units: 1e-7 of the diagonal, or more if the curves need it.
    pub uncertainty: f64,
    /// Diagonal of the box around the part of the surface inside the trims.
    pub diagonal: f64,
}

/// A model cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The file.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The part of a surface over its domain is none: numbers overflow.
    #[error("a surface cannot be cut off at its domain: {0}")]
    Tensor(#[from] TensorError),
}

impl Classify for StepError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Cancelled(_) => ErrorKind::Cancelled,
            Self::Export(error) => error.kind(),
            Self::Tensor(_) => ErrorKind::Degenerate,
        }
    }
}

/// The least uncertainty of a file, as a share of the diagonal: as near as the curves of edges are to the surface.
const LEAST_UNCERTAINTY: f64 = CURVE_TOLERANCE;
/// The measured deviation may miss the largest between samples: the uncertainty is this much above it.
const UNCERTAINTY_MARGIN: f64 = 2.0;

/// Writes a model; the file appears whole or not at all.
pub fn write(
    model: &Model,
    options: &StepOptions,
    path: &Path,
    watch: &Watch,
) -> Result<StepReport, StepError> {
    let (text, report) = to_text(model, options, watch)?;
    watch.check()?;
    file::write(path, text.as_bytes()).map_err(ExportError::from)?;
    Ok(report)
}

/// The content of a file.
pub fn to_text(
    model: &Model,
    options: &StepOptions,
    watch: &Watch,
) -> Result<(String, StepReport), StepError> {
    let report = StepReport {
        face_count: model.faces().len(),
        pole_count: model.pole_count(),
        loop_count: model.loop_count(),
        edge_count: model.edges().len(),
        curve_deviation: model.curve_deviation(),
        uncertainty: (LEAST_UNCERTAINTY * model.diagonal()).max(UNCERTAINTY_MARGIN * model.curve_deviation()),
        diagonal: model.diagonal(),
    };
    Ok((write::file(model, &report, options, watch)?, report))
}

#[cfg(test)]
mod tests;
