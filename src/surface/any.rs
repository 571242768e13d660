//! A surface of any family.

use super::Surface;
use super::tensor::TensorSurface;

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
