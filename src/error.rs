//! What can go wrong anywhere.
//!
//! Each module has an error of its own, whose sentence names the offender and whose fields carry the
//! numbers a caller needs next. [`Error`] holds any of them; [`Error::kind`] sorts them into the few
//! classes that a program can act upon, [`Error::index`] is the offending node, triangle, row or byte.

use crate::control::Cancelled;
use crate::curve::CurveError;
use crate::export::ExportError;
use crate::export::native::LoadError;
use crate::export::step::StepError;
use crate::fit::common::FitError;
use crate::fit::conversion::ConversionError;
use crate::fit::d1rc::D1rcFitError;
use crate::fit::field::transfer::TransferError;
use crate::fit::model::ModelFitError;
use crate::fit::skin::SkinError;
use crate::knots::KnotError;
use crate::layout::LayoutError;
use crate::layout::of_mesh::MeshLayoutError;
use crate::mesh::{CutError, DecimateError, MeshError, ReadError};
use crate::model::ModelError;
use crate::parameterize::ParameterizeError;
use crate::parameterize::sphere::SphereError;
use crate::query::deviation::DeviationError;
use crate::query::gradient::GradientError;
use crate::query::project::ProjectError;
use crate::query::rows::SampleRowsError;
use crate::query::tessellate::TessellateError;
use crate::surface::d1rc::D1rcError;
use crate::surface::evaluate::EvalError;
use crate::surface::pht::PhtError;
use crate::surface::tensor::{CombineError, TensorError};
use crate::surface::tspline::TSplineError;
use crate::surface::{ConvertError, TrimError};
use crate::tmesh::TMeshError;

/// The class of an error: what a program can act upon without reading the sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// An argument is out of its range, or contradicts another.
    InvalidArgument,
    /// A number is NaN or infinite.
    NotFinite,
    /// An index is out of range.
    Index,
    /// The mesh is not connected as the call needs it.
    Topology,
    /// The geometry is degenerate: zero lengths, areas or ranges.
    Degenerate,
    /// A parameter lies outside the domain.
    Outside,
    /// The data do not determine the result.
    Singular,
    /// The call does not apply to this family of surface.
    WrongKind,
    /// The caller's array is too short.
    BufferTooSmall,
    /// The result would exceed a limit.
    TooLarge,
    /// A file cannot be opened, read or written.
    File,
    /// The content of a file or buffer is not what it claims to be.
    Format,
    /// A record or buffer was made by a newer version.
    Version,
    /// The progress callback asked to stop.
    Cancelled,
    /// Memory could not be had.
    OutOfMemory,
}

/// Any error of the library.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A mesh is not one.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Quads do not make a layout.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// A mesh cannot be parameterized.
    #[error(transparent)]
    Parameterize(#[from] ParameterizeError),
    /// A mesh gets no layout.
    #[error(transparent)]
    MeshLayout(#[from] MeshLayoutError),
    /// A mesh cannot be mapped on to the sphere.
    #[error(transparent)]
    Sphere(#[from] SphereError),
    /// A fit is not possible.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A mesh does not become a model.
    #[error(transparent)]
    ModelFit(#[from] ModelFitError),
    /// Values cannot be carried from mesh to mesh.
    #[error(transparent)]
    Transfer(#[from] TransferError),
    /// A D1RC fit is not possible.
    #[error(transparent)]
    D1rcFit(#[from] D1rcFitError),
    /// Rows cannot be skinned.
    #[error(transparent)]
    Skin(#[from] SkinError),
    /// Knots are not a knot vector.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A curve is not one.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A tensor surface is not one.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// A T-mesh is not one, or cannot be changed as asked.
    #[error(transparent)]
    TMesh(#[from] TMeshError),
    /// A PHT-spline is not one, or cannot be changed as asked.
    #[error(transparent)]
    Pht(#[from] PhtError),
    /// A D1RC-spline is not one, or cannot be changed as asked.
    #[error(transparent)]
    D1rc(#[from] D1rcError),
    /// A T-spline is not one, or cannot be changed as asked.
    #[error(transparent)]
    TSpline(#[from] TSplineError),
    /// Points cannot be evaluated.
    #[error(transparent)]
    Eval(#[from] EvalError),
    /// A surface cannot be measured against a mesh.
    #[error(transparent)]
    Deviation(#[from] DeviationError),
    /// Gradients cannot be computed.
    #[error(transparent)]
    Gradient(#[from] GradientError),
    /// Points cannot be projected.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// Rows of points cannot be taken from a mesh.
    #[error(transparent)]
    SampleRows(#[from] SampleRowsError),
    /// A surface cannot be tessellated.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// A file cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// Parts do not make a model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A surface has no model.
    #[error(transparent)]
    Conversion(#[from] ConversionError),
    /// A model cannot be written.
    #[error(transparent)]
    Step(#[from] StepError),
    /// A saved surface cannot be loaded.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A trim is not one.
    #[error(transparent)]
    Trim(#[from] TrimError),
    /// Surfaces cannot be added.
    #[error(transparent)]
    Combine(#[from] CombineError),
    /// A surface cannot be converted.
    #[error(transparent)]
    Convert(#[from] ConvertError),
    /// A mesh cannot be cut as asked.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A mesh cannot be made coarser as asked.
    #[error(transparent)]
    Decimate(#[from] DecimateError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Error {
    /// The class of the error.
    pub fn kind(&self) -> ErrorKind {
        self.kind_and_index().0
    }

    /// The offending node, triangle, row, value or byte, counted from 0.
    pub fn index(&self) -> Option<usize> {
        self.kind_and_index().1
    }

    fn kind_and_index(&self) -> (ErrorKind, Option<usize>) {
        match self {
            Self::Mesh(error) => (error.kind(), error.index()),
            Self::Read(error) => (error.kind(), error.index()),
            Self::Layout(error) => (error.kind(), error.index()),
            Self::Parameterize(error) => (error.kind(), error.index()),
            Self::MeshLayout(error) => (error.kind(), error.index()),
            Self::Sphere(error) => (error.kind(), error.index()),
            Self::Fit(error) => (error.kind(), error.index()),
            Self::ModelFit(error) => (error.kind(), error.index()),
            Self::Transfer(error) => (error.kind(), error.index()),
            Self::D1rcFit(error) => (error.kind(), error.index()),
            Self::Skin(error) => (error.kind(), error.index()),
            Self::Knots(error) => (error.kind(), error.index()),
            Self::Curve(error) => (error.kind(), error.index()),
            Self::Tensor(error) => (error.kind(), error.index()),
            Self::TMesh(error) => (error.kind(), error.index()),
            Self::Pht(error) => (error.kind(), error.index()),
            Self::D1rc(error) => (error.kind(), error.index()),
            Self::TSpline(error) => (error.kind(), error.index()),
            Self::Eval(error) => (error.kind(), error.index()),
            Self::Deviation(error) => (error.kind(), error.index()),
            Self::Gradient(error) => (error.kind(), error.index()),
            Self::Project(error) => (error.kind(), error.index()),
            Self::SampleRows(error) => (error.kind(), error.index()),
            Self::Tessellate(error) => (error.kind(), None),
            Self::Export(error) => (error.kind(), None),
            Self::Model(error) => (error.kind(), error.index()),
            Self::Conversion(error) => (error.kind(), error.index()),
            Self::Step(error) => (error.kind(), None),
            Self::Load(error) => (error.kind(), error.index()),
            Self::Trim(error) => (error.kind(), error.index()),
            Self::Combine(error) => (error.kind(), error.index()),
            Self::Convert(error) => (error.kind(), None),
            Self::Cut(error) => (error.kind(), error.index()),
            Self::Decimate(error) => (error.kind(), error.index()),
            Self::Cancelled(_) => (ErrorKind::Cancelled, None),
        }
    }
}
