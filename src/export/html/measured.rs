//! The page of a surface that is measured against a mesh.

use super::{Page, write};
use crate::control::{Cancelled, Control, Stage};
use crate::export::ExportError;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::{Remarks, ToleranceScale};
use crate::mesh::Mesh;
use crate::query::deviation::{DeviationError, DeviationOptions, deviation};
use crate::query::side::signed;
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate};
use crate::surface::{Kind, Surface};
use std::path::Path;

/// What a page says beside what is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportOptions<'a> {
    /// Its headline.
    pub title: &'a str,
    /// What one unit of length is called.
    pub unit: &'a str,
    /// The largest distance allowed; None takes the largest found.
    pub tolerance: Option<f64>,
    /// What `tolerance` is measured in; the diagonal is that of the mesh's bounding box.
    pub tolerance_scale: ToleranceScale,
    /// What the fit had to remark.
    pub remarks: Remarks,
}

impl Default for ReportOptions<'_> {
    fn default() -> Self {
        Self {
            title: "Deviation",
            unit: "mm",
            tolerance: None,
            tolerance_scale: ToleranceScale::default(),
            remarks: Remarks::default(),
        }
    }
}

/// A page cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// The tolerance is none.
    #[error("the tolerance is {0}, it must be positive and finite, or 0 for the largest distance")]
    Tolerance(f64),
    /// The distances cannot be measured.
    #[error(transparent)]
    Deviation(#[from] DeviationError),
    /// The surface cannot be shown.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// The file cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for ReportError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Tolerance(_) => ErrorKind::InvalidArgument,
            Self::Deviation(error) => error.kind(),
            Self::Tessellate(error) => error.kind(),
            Self::Export(error) => error.kind(),
            Self::Cancelled(error) => error.kind(),
        }
    }

    fn index(&self) -> Option<usize> {
        match self {
            Self::Deviation(error) => error.index(),
            _ => None,
        }
    }
}

/// Measures a surface against a mesh and writes the page.
pub fn write_report(
    surface: &dyn Surface,
    mesh: &Mesh,
    options: &ReportOptions,
    path: &Path,
    control: &mut Control,
) -> Result<(), ReportError> {
    if let Some(tolerance) = options.tolerance.filter(|&value| !(value > 0.0 && value.is_finite())) {
        return Err(ReportError::Tolerance(tolerance));
    }
    control.enter(Stage::Project);
    let found = deviation(surface, mesh, &DeviationOptions::default(), control.pool())?;
    let distances = signed(surface, mesh.points(), &found.uv, &found.nodes.each, control.pool());
    control.report(0.6, f64::NAN)?;
    control.enter(Stage::Tessellate);
    let triangles = tessellate(surface, &TessellateOptions::default())?.mesh;
    control.report(0.9, f64::NAN)?;
    control.enter(Stage::Write);
    let scale = match options.tolerance_scale {
        ToleranceScale::Relative => mesh.diagonal(),
        ToleranceScale::Absolute => 1.0,
    };
    let net = surface.control_net();
    let page = Page {
        title: options.title,
        unit: options.unit,
        mesh,
        distances: &distances,
        places: &|node| format!("{:.4}, {:.4}", found.uv[node].x, found.uv[node].y),
        tolerance: options.tolerance.map_or(found.nodes.max, |value| value * scale),
        facts: &facts(surface),
        remarks: &words(options.remarks),
        surface: Some(&triangles),
        net: net.as_ref(),
    };
    Ok(write(&page, path)?)
}

fn facts(surface: &dyn Surface) -> [(String, String); 2] {
    let family = match surface.kind() {
        Kind::Tensor => "tensor",
        Kind::TSpline => "T-spline",
        Kind::Pht => "PHT-spline",
        Kind::D1rc => "D1RC-spline",
    };
    let count = surface.coefficient_count().to_string();
    [("family".to_owned(), family.to_owned()), ("control points".to_owned(), count)]
}

/// What each remark means, and what to do about it.
fn words(remarks: Remarks) -> Vec<(String, String)> {
    const WORDS: [(Remarks, &str, &str); 8] = [
        (
            Remarks::TOLERANCE_NOT_MET,
            "The tolerance is missed.",
            "Allow more control points, take another family, or loosen it if the worst place is noise.",
        ),
        (
            Remarks::STAGNATED,
            "Refining no longer helped.",
            "The data contradict each other at this scale: noise, a sharp edge, or doubled layers.",
        ),
        (
            Remarks::ROUGH_BETWEEN_NODES,
            "Between the nodes the surface departs from the facets.",
            "Loosen the tolerance, smooth more, or take a family that keeps sharp edges.",
        ),
        (
            Remarks::FOLDED_PARAMETERS,
            "The map folds, and the surface may.",
            "Let the library make the parameters, or fit a model of several patches.",
        ),
        (
            Remarks::SEGMENTATION_ADVISED,
            "One chart stretches this shape too much.",
            "Fit a model of several patches.",
        ),
        (Remarks::EMPTY_CELLS, "Some cells inside the border hold no nodes.", "Fill holes of the mesh."),
        (
            Remarks::TOLERANCE_RAISED,
            "The tolerance was below rounding and was raised.",
            "Ask for a looser one.",
        ),
        (Remarks::REGULARIZED, "Uneven parameters were evened out.", "Nothing needs to be done."),
    ];
    let held = WORDS.iter().filter(|(remark, ..)| remarks.has(*remark));
    held.map(|(_, what, advice)| ((*what).to_owned(), (*advice).to_owned())).collect()
}
