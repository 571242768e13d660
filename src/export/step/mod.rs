//! STEP files: a surface in space as one trimmed face, or as a shell of faces that share edges: a T-spline in
//! strips, a PHT-spline in patches. A D1RC-spline is written as a tensor surface fitted to its tessellation.
//!
//! ISO 10303-21 (clear text), 10303-42 (geometry and topology), application protocols 214 and 242. The face lies
//! on a `B_SPLINE_SURFACE_WITH_KNOTS` (rational where the surface has weights) and is bounded by the surface's
//! trims, or by the border of its domain, and in a shell by the sides of the parts. Trims are polylines in (u,v) and are written exactly: each edge has a
//! p-curve of degree 1 through their points and a cubic in space over the same parameters, the p-curve's image
//! within the file's uncertainty, with a kink wherever the polyline has one. Smoothing the polylines would make
//! curves that are easier to edit, but no longer the bounds that every other call of the library keeps to.
//!
//! Equal input gives equal bytes.

mod image;
mod layout;
mod loops;
mod net;
mod part21;
mod shell;
mod tiling;
mod write;

use super::error::{ExportError, write_file};
use crate::Control;
use crate::curve::CurveError;
use crate::fit::common::{FitError, Regularize};
use crate::fit::report::{Tolerance, ToleranceScale};
use crate::fit::tensor::{TensorOptions, fit_mesh};
use crate::geometry::{Bounds, Domain};
use crate::knots::KnotError;
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate};
use crate::surface::d1rc::D1rcSurface;
use crate::surface::tensor::{Axis, TensorError, TensorSurface};
use crate::surface::{AnySurface, ConvertError, Surface};
use glam::DVec2;
use net::Net;
use shell::Shell;
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

/// What one model unit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// A millimetre.
    #[default]
    Millimetre,
    /// A metre.
    Metre,
    /// An inch, 25.4 mm.
    Inch,
}

/// What a file holds of a surface that the format does not know.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// The same surface as one tensor surface.
    #[default]
    Tensor,
    /// A T-spline as one face for each span of v, over the knots of four control curves: far fewer control points.
    Strips,
    /// A PHT-spline as one face for each rectangle of cells of nearly equal size.
    Patches,
}

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
    /// What is written of a T-spline or PHT-spline.
    pub form: Form,
    /// By how much the levels of cells in one face of [`Form::Patches`] may differ.
    pub level_spread: u32,
    /// Most control points that [`Form::Tensor`] may take.
    pub max_coefficients: usize,
    /// A D1RC-spline is written as a tensor surface fitted within this, in model units, at the nodes of a fine
    /// tessellation; 0 takes 1e-3 of the diagonal.
    pub tolerance: f64,
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
            form: Form::default(),
            level_spread: 1,
            max_coefficients: 4_000_000,
            tolerance: 0.0,
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

/// A surface cannot be written as a face.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The file, or the dimension.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The format knows no surface with a gap.
    #[error("knot {index} along {axis:?} occurs more than {degree} times inside the domain")]
    Torn {
        /// The direction.
        axis: Axis,
        /// The first of the equal knots.
        index: usize,
        /// The degree: so many are allowed.
        degree: usize,
    },
    /// Bounds of a face must not meet.
    #[error("trim {index} crosses or touches itself or another near ({u}, {v})")]
    Crossing {
        /// The loop.
        index: usize,
        /// Where.
        u: f64,
        /// Where.
        v: f64,
    },
    /// A loop has fewer than three different points.
    #[error("trim {index} encloses no area")]
    Empty {
        /// The loop.
        index: usize,
    },
    /// A face is in one piece.
    #[error("the trims bound {count} separate pieces, a face has one")]
    Pieces {
        /// Loops that bound a piece from outside.
        count: usize,
    },
    /// A loop is a point in space.
    #[error("bound {index} is a single point in space")]
    Collapsed {
        /// The loop, the outer one first.
        index: usize,
    },
    /// Numbers overflow.
    #[error("the surface is too large or too small for its size to be computed: its diagonal is {diagonal}")]
    Size {
        /// Diagonal of its box.
        diagonal: f64,
    },
    /// The knots of a curve on the surface are none: parameters too close for double precision.
    #[error("a curve on the surface has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The part of the surface over its domain is none: numbers overflow.
    #[error("the surface cannot be cut off at its domain: {0}")]
    Tensor(#[from] TensorError),
    /// The surface has no tessellation to fit to.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// No tensor surface can be fitted to the surface.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The tensor surface fitted to it is farther off than allowed.
    #[error(
        "the nearest tensor surface is {error} off, {tolerance} is allowed: fit one yourself, or tessellate"
    )]
    Tolerance {
        /// Largest distance measured.
        error: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// The surface is no tensor surface of a size that is allowed.
    #[error(transparent)]
    Convert(#[from] ConvertError),
    /// A curve on the surface is none: numbers overflow.
    #[error("a curve on the surface cannot be computed: {0}")]
    Curve(#[from] CurveError),
}

impl StepError {
    /// The class of the error.
    pub fn kind(&self) -> crate::ErrorKind {
        use crate::ErrorKind;
        match self {
            Self::Export(error) => error.kind(),
            Self::Convert(error) => error.kind(),
            Self::Tessellate(error) => error.kind(),
            Self::Fit(error) => error.kind(),
            Self::Tolerance { .. } => ErrorKind::TooLarge,
            Self::Crossing { .. } | Self::Pieces { .. } | Self::Torn { .. } => ErrorKind::Topology,
            _ => ErrorKind::Degenerate,
        }
    }

    /// The offending trim or knot.
    pub fn index(&self) -> Option<usize> {
        match *self {
            Self::Torn { index, .. } | Self::Crossing { index, .. } | Self::Empty { index } => Some(index),
            _ => None,
        }
    }
}

/// How near the curves of edges are to the surface, as a share of the diagonal; the least uncertainty too.
const CURVE_TOLERANCE: f64 = 1e-7;
/// The measured deviation may miss the largest between samples: the uncertainty is this much above it.
const UNCERTAINTY_MARGIN: f64 = 2.0;

/// Writes a surface in space, which appears whole or not at all.
pub fn write(surface: &AnySurface, options: &StepOptions, path: &Path) -> Result<StepReport, StepError> {
    let (text, report) = to_text(surface, options)?;
    write_file(path, text.as_bytes())?;
    Ok(report)
}

/// The content of a file.
pub fn to_text(surface: &AnySurface, options: &StepOptions) -> Result<(String, StepReport), StepError> {
    let parts = match (surface, options.form) {
        (AnySurface::D1rc(d1rc), _) => {
            let fitted = fitted(d1rc, options)?;
            return shell_to_text(&fitted, &[&fitted], options);
        }
        (AnySurface::Tensor(tensor), _) => return shell_to_text(surface.as_surface(), &[tensor], options),
        (AnySurface::TSpline(tspline), Form::Strips) => tspline.to_strips().map_err(ConvertError::from)?,
        (AnySurface::Pht(pht), Form::Patches) => pht.to_tensor_patches(options.level_spread)?,
        _ => vec![surface.to_tensor(options.max_coefficients)?],
    };
    shell_to_text(surface.as_surface(), &parts.iter().collect::<Vec<_>>(), options)
}

/// A tensor surface near a spline over triangles, with its trims.
fn fitted(surface: &D1rcSurface, options: &StepOptions) -> Result<TensorSurface, StepError> {
    let mesh =
        tessellate(surface, &TessellateOptions { keep_trims: true, ..TessellateOptions::default() })?.mesh;
    let value = if options.tolerance == 0.0 { 1e-3 * mesh.diagonal() } else { options.tolerance };
    // nodes lie on the surface; between them the fit is as free as the chords are off
    let fine = TessellateOptions { chord_tolerance: value / 4.0, ..TessellateOptions::default() };
    let mesh = tessellate(surface, &fine)?.mesh;
    let fit = TensorOptions {
        tolerance: Tolerance { value, scale: ToleranceScale::Absolute },
        max_coefficients: options.max_coefficients.min(TensorOptions::default().max_coefficients),
        regularize: Regularize::Never,
        ..TensorOptions::default()
    };
    let fit = fit_mesh(&mesh, &fit, &mut Control::default())?;
    let (error, tolerance) = (fit.report.max_error, value);
    if error <= tolerance { Ok(fit.surface) } else { Err(StepError::Tolerance { error, tolerance }) }
}

/// The faces that `parts`, which meet with equal parameters, have inside the trims of the `whole`.
fn shell_to_text(
    whole: &dyn Surface,
    parts: &[&TensorSurface],
    options: &StepOptions,
) -> Result<(String, StepReport), StepError> {
    if whole.dim() != 3 {
        return Err(ExportError::Dimension { dim: whole.dim() }.into());
    }
    let loops = loops::bounds(whole)?;
    let nets = parts.iter().map(|part| Net::new(part)).collect::<Result<Vec<_>, _>>()?;
    let diagonal = Bounds::of_rows(&samples(whole, &loops), 3).diagonal();
    let tolerance = CURVE_TOLERANCE * diagonal;
    if !(diagonal.is_finite() && tolerance.is_normal()) {
        return Err(StepError::Size { diagonal });
    }
    let shell = Shell::new(parts, &loops, tolerance)?;
    let report = StepReport {
        face_count: shell.faces.len(),
        pole_count: shell.surfaces().map(|surface| nets[surface].points.len()).sum(),
        loop_count: shell.faces.iter().map(|face| face.bounds.len()).sum(),
        edge_count: shell.edges.len(),
        curve_deviation: shell.deviation,
        uncertainty: tolerance.max(UNCERTAINTY_MARGIN * shell.deviation),
        diagonal,
    };
    Ok((write::file(&nets, &shell, &report, options), report))
}

/// Points of the surface inside the trims and on them.
fn samples(surface: &dyn Surface, loops: &[Vec<DVec2>]) -> Vec<f64> {
    const SAMPLES: usize = 33;
    let box_of_loops = Domain::around(loops.iter().flatten().copied());
    let trims = &surface.region().trims;
    let mut places: Vec<DVec2> = loops.concat();
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let share = DVec2::new(i as f64, j as f64) / (SAMPLES - 1) as f64;
            let uv = surface.domain().clamp(box_of_loops.min + share * box_of_loops.size());
            if trims.contains(uv) {
                places.push(uv);
            }
        }
    }
    let mut rows = vec![0.0; 3 * places.len()];
    surface.eval_rows(&places, 0, &mut rows);
    rows
}

#[cfg(test)]
mod tests;
