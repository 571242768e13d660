//! Models of surfaces of any family: a spline over triangles is no tensor surface, so one is fitted to its
//! tessellation.

use super::common::{FitError, Regularize};
use super::report::{Tolerance, ToleranceScale};
use super::tensor::{TensorOptions, fit_mesh};
use crate::Control;
use crate::control::Stage;
use crate::failure::{Classify, ErrorKind};
use crate::model::{FormOptions, Model, ModelError, of_surface};
use crate::options::with_fields;
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate_watched};
use crate::surface::AnySurface;
use crate::surface::d1rc::D1rcSurface;
use crate::surface::tensor::TensorSurface;

/// How a surface becomes a model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ConversionOptions {
    /// What is made of a T-spline or PHT-spline.
    pub form: FormOptions,
    /// A spline over triangles becomes a tensor surface fitted within this, in model units, at the nodes of a fine
    /// tessellation; 0 takes 1e-3 of the diagonal.
    pub tolerance: f64,
}

impl ConversionOptions {
    with_fields! {
        with_form form: FormOptions,
        with_tolerance tolerance: f64,
    }
}

/// A surface has no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConversionError {
    /// Its faces are none.
    #[error(transparent)]
    Model(#[from] ModelError),
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
}

impl Classify for ConversionError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Model(error) => error.kind(),
            Self::Tessellate(error) => error.kind(),
            Self::Fit(error) => error.kind(),
            Self::Tolerance { .. } => ErrorKind::TooLarge,
        }
    }

    /// The offending trim or knot.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Model(error) => error.index(),
            _ => None,
        }
    }
}

/// The part of a surface inside its trims as an open shell: see [`of_surface`].
pub fn to_model(
    surface: &AnySurface,
    options: &ConversionOptions,
    control: &mut Control,
) -> Result<Model, ConversionError> {
    let fitted: Option<AnySurface> = match surface {
        AnySurface::D1rc(d1rc) => Some(fitted(d1rc, options, control)?.into()),
        _ => None,
    };
    Ok(of_surface(fitted.as_ref().unwrap_or(surface), &options.form, control.pool().watch())?)
}

/// A tensor surface near a spline over triangles, with its trims.
fn fitted(
    surface: &D1rcSurface,
    options: &ConversionOptions,
    control: &mut Control,
) -> Result<TensorSurface, ConversionError> {
    control.enter(Stage::Tessellate);
    let whole = TessellateOptions { keep_trims: true, ..TessellateOptions::default() };
    let mesh = tessellate_watched(surface, &whole, control.pool().watch())?.mesh;
    let value = if options.tolerance == 0.0 {
        Tolerance::default().value * mesh.diagonal()
    } else {
        options.tolerance
    };
    // nodes lie on the surface; between them the fit is as free as the chords are off
    let fine = TessellateOptions { chord_tolerance: value / 4.0, ..TessellateOptions::default() };
    let mesh = tessellate_watched(surface, &fine, control.pool().watch())?.mesh;
    let fit = TensorOptions {
        tolerance: Tolerance { value, scale: ToleranceScale::Absolute },
        max_coefficients: options.form.max_coefficients.min(TensorOptions::default().max_coefficients),
        regularize: Regularize::Never,
        ..TensorOptions::default()
    };
    let fit = fit_mesh(&mesh, &fit, control)?;
    let (error, tolerance) = (fit.report.max_error, value);
    if error <= tolerance { Ok(fit.surface) } else { Err(ConversionError::Tolerance { error, tolerance }) }
}
