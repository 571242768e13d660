//! A surface of any family.

use super::Surface;
use super::tensor::TensorSurface;

/// A surface cannot be converted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// The result would have more control points than allowed.
    #[error("the surface would have {needed} control points, {limit} are allowed")]
    TooLarge {
        /// Control points of the result.
        needed: usize,
        /// The limit.
        limit: usize,
    },
}

impl ConvertError {
    /// The class of the error.
    pub fn kind(&self) -> crate::ErrorKind {
        match self {
            Self::TooLarge { .. } => crate::ErrorKind::TooLarge,
        }
    }
}

/// A surface of one of the families, for those who keep surfaces of all: handles and files.
#[derive(Debug, Clone, PartialEq)]
pub enum AnySurface {
    /// Tensor product B-spline.
    Tensor(TensorSurface),
}

impl AnySurface {
    /// What every family can do.
    pub fn as_surface(&self) -> &dyn Surface {
        match self {
            Self::Tensor(surface) => surface,
        }
    }

    /// The same surface as a tensor product of at most `max_coefficients` control points.
    pub fn to_tensor(&self, max_coefficients: usize) -> Result<TensorSurface, ConvertError> {
        match self {
            Self::Tensor(surface) => match surface.coefficient_count() {
                needed if needed > max_coefficients => {
                    Err(ConvertError::TooLarge { needed, limit: max_coefficients })
                }
                _ => Ok(surface.clone()),
            },
        }
    }

    /// The same, to change what can be changed in every family.
    pub fn as_surface_mut(&mut self) -> &mut dyn Surface {
        match self {
            Self::Tensor(surface) => surface,
        }
    }
}

impl From<TensorSurface> for AnySurface {
    fn from(surface: TensorSurface) -> Self {
        Self::Tensor(surface)
    }
}
