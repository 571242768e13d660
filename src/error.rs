//! What can go wrong anywhere: the union of the errors of all modules, which therefore knows them all.

use crate::control::Cancelled;
use crate::curve::CurveError;
use crate::export::ExportError;
use crate::export::html::ReportError;
use crate::export::native::LoadError;
use crate::export::step::StepError;
use crate::export::vtk::VtkError;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::fit::conversion::ConversionError;
use crate::fit::d1rc::D1rcFitError;
use crate::fit::fair::FairError;
use crate::fit::field::FieldError;
use crate::fit::field::transfer::TransferError;
use crate::fit::model::ModelFitError;
use crate::fit::model::from_patches::FromPatchesError;
use crate::fit::skin::SkinError;
use crate::fit::trim::CurveTrimError;
use crate::knots::KnotError;
use crate::layout::LayoutError;
use crate::layout::of_mesh::MeshLayoutError;
use crate::memory::OutOfMemory;
use crate::mesh::{CutError, DecimateError, FeatureError, MeshError, ReadError};
use crate::model::{FieldGradientError, ModelError, ModelEvalError};
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

/// An error for each module's own.
macro_rules! union {
    ($($(#[doc = $doc:literal])+ $variant:ident($error:ty),)+) => {
        /// Any error of the library.
        #[derive(Debug, Clone, PartialEq, thiserror::Error)]
        pub enum Error {$(
            $(#[doc = $doc])+
            #[error(transparent)]
            $variant(#[from] $error),
        )+}

        impl Error {
            /// The module's own error.
            fn own(&self) -> &dyn Classify {
                match self {$(Self::$variant(error) => error,)+}
            }
        }
    };
}

union! {
    /// A mesh is not one.
    Mesh(MeshError),
    /// A mesh file cannot be read.
    Read(ReadError),
    /// Quads do not make a layout.
    Layout(LayoutError),
    /// A mesh cannot be parameterized.
    Parameterize(ParameterizeError),
    /// Features of a mesh cannot be found as asked.
    Feature(FeatureError),
    /// A mesh gets no layout.
    MeshLayout(MeshLayoutError),
    /// A mesh cannot be mapped on to the sphere.
    Sphere(SphereError),
    /// A fit is not possible.
    Fit(FitError),
    /// A surface cannot be faired.
    Fair(FairError),
    /// A mesh does not become a model.
    ModelFit(ModelFitError),
    /// Patches make no smooth model.
    FromPatches(FromPatchesError),
    /// A field cannot be fitted.
    Field(FieldError),
    /// Values cannot be carried from mesh to mesh.
    Transfer(TransferError),
    /// A D1RC fit is not possible.
    D1rcFit(D1rcFitError),
    /// Rows cannot be skinned.
    Skin(SkinError),
    /// Knots are not a knot vector.
    Knots(KnotError),
    /// A curve is not one.
    Curve(CurveError),
    /// A tensor surface is not one.
    Tensor(TensorError),
    /// A T-mesh is not one, or cannot be changed as asked.
    TMesh(TMeshError),
    /// A PHT-spline is not one, or cannot be changed as asked.
    Pht(PhtError),
    /// A D1RC-spline is not one, or cannot be changed as asked.
    D1rc(D1rcError),
    /// A T-spline is not one, or cannot be changed as asked.
    TSpline(TSplineError),
    /// Points cannot be evaluated.
    Eval(EvalError),
    /// A surface cannot be measured against a mesh.
    Deviation(DeviationError),
    /// Gradients cannot be computed.
    Gradient(GradientError),
    /// Gradients over a model cannot be computed.
    FieldGradient(FieldGradientError),
    /// Points cannot be projected.
    Project(ProjectError),
    /// Rows of points cannot be taken from a mesh.
    SampleRows(SampleRowsError),
    /// A surface cannot be tessellated.
    Tessellate(TessellateError),
    /// A file cannot be written.
    Export(ExportError),
    /// A report cannot be made.
    Report(ReportError),
    /// A surface cannot be written as triangles.
    Vtk(VtkError),
    /// Parts do not make a model.
    Model(ModelError),
    /// Points on faces cannot be evaluated.
    ModelEval(ModelEvalError),
    /// A surface has no model.
    Conversion(ConversionError),
    /// A model cannot be written.
    Step(StepError),
    /// A saved surface cannot be loaded.
    Load(LoadError),
    /// A trim is not one.
    Trim(TrimError),
    /// No trims follow curves.
    CurveTrim(CurveTrimError),
    /// Surfaces cannot be added.
    Combine(CombineError),
    /// A surface cannot be converted.
    Convert(ConvertError),
    /// A mesh cannot be cut as asked.
    Cut(CutError),
    /// A mesh cannot be made coarser as asked.
    Decimate(DecimateError),
    /// The progress callback asked to stop.
    Cancelled(Cancelled),
    /// Memory could not be had.
    Memory(OutOfMemory),
}

impl Classify for Error {
    fn kind(&self) -> ErrorKind {
        self.own().kind()
    }

    fn index(&self) -> Option<usize> {
        self.own().index()
    }
}
