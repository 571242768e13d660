//! A surface of any family.

use super::Surface;
use super::d1rc::D1rcSurface;
use super::pht::PhtSurface;
use super::tensor::{TensorError, TensorSurface};
use super::tspline::{TSplineError, TSplineSurface};
use crate::control::{Cancelled, Watch};
use crate::failure::{Classify, ErrorKind};

/// A surface cannot be converted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The result would have more control points than allowed.
    #[error("the surface would have {needed} control points, {limit} are allowed")]
    TooLarge {
        /// Control points of the result.
        needed: usize,
        /// The limit.
        limit: usize,
    },
    /// The surface is not polynomial on rectangles.
    #[error("a D1RC-spline is no tensor surface: fit one to its tessellation")]
    NotTensor,
    /// A number of the result would overflow.
    #[error("the tensor surface would not be one: {0}")]
    Tensor(#[from] TensorError),
    /// The control curves of a T-spline have no common knots.
    #[error(transparent)]
    TSpline(#[from] TSplineError),
}

impl Classify for ConvertError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Cancelled(_) => ErrorKind::Cancelled,
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::NotTensor => ErrorKind::WrongKind,
            Self::Tensor(error) => error.kind(),
            Self::TSpline(error) => error.kind(),
        }
    }
}

/// A surface of one of the families, for those who keep surfaces of all: handles and files.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "few are alive at once, and handles hold them in boxes")]
pub enum AnySurface {
    /// Tensor product B-spline.
    Tensor(TensorSurface),
    /// T-spline with control curves.
    TSpline(TSplineSurface),
    /// Bicubic spline over a hierarchical T-mesh.
    Pht(PhtSurface),
    /// Spline over a triangular control mesh.
    D1rc(D1rcSurface),
}

impl AnySurface {
    /// What every family can do.
    pub fn as_surface(&self) -> &dyn Surface {
        match self {
            Self::Tensor(surface) => surface,
            Self::Pht(surface) => surface,
            Self::TSpline(surface) => surface,
            Self::D1rc(surface) => surface,
        }
    }

    /// The same surface as a tensor product of at most `max_coefficients` control points.
    pub fn to_tensor(&self, max_coefficients: usize, watch: &Watch) -> Result<TensorSurface, ConvertError> {
        match self {
            Self::Tensor(surface) => match surface.coefficient_count() {
                needed if needed > max_coefficients => {
                    Err(ConvertError::TooLarge { needed, limit: max_coefficients })
                }
                _ => Ok(surface.clone()),
            },
            Self::Pht(surface) => surface.to_tensor_watched(max_coefficients, watch),
            Self::TSpline(surface) => surface.to_tensor(max_coefficients),
            Self::D1rc(_) => Err(ConvertError::NotTensor),
        }
    }

    /// The same, to change what can be changed in every family.
    pub fn as_surface_mut(&mut self) -> &mut dyn Surface {
        match self {
            Self::Tensor(surface) => surface,
            Self::Pht(surface) => surface,
            Self::TSpline(surface) => surface,
            Self::D1rc(surface) => surface,
        }
    }
}

impl From<TensorSurface> for AnySurface {
    fn from(surface: TensorSurface) -> Self {
        Self::Tensor(surface)
    }
}

impl From<PhtSurface> for AnySurface {
    fn from(surface: PhtSurface) -> Self {
        Self::Pht(surface)
    }
}

impl From<TSplineSurface> for AnySurface {
    fn from(surface: TSplineSurface) -> Self {
        Self::TSpline(surface)
    }
}

impl From<D1rcSurface> for AnySurface {
    fn from(surface: D1rcSurface) -> Self {
        Self::D1rc(surface)
    }
}
