//! Fields on models: values of any dimension over the faces, smooth where the faces are.

use super::evaluate::by_face;
use super::{FaceId, Model, ModelEvalError, ModelValues};
use crate::control::Pool;
use crate::query::gradient::{GradientError, field_gradient};
use crate::surface::Surface;
use crate::surface::evaluate::{Output, OutsideRule, Points, Quantity, evaluate};
use crate::surface::pht::PhtSurface;
use glam::DVec2;

/// Values over the faces of a model of patches: a PHT-spline for each patch, over the parameters of its faces.
#[derive(Debug, Clone)]
pub struct ModelField {
    patches: Vec<PhtSurface>,
    patch_of_face: Vec<u32>,
}

impl ModelField {
    /// Values of one dimension over patches, and which of them each face is a part of; None if a face is a part of none.
    pub fn new(patches: Vec<PhtSurface>, patch_of_face: Vec<u32>) -> Option<Self> {
        let dim = patches.first()?.dim();
        let is_whole = patches.iter().all(|patch| patch.dim() == dim)
            && patch_of_face.iter().all(|&patch| (patch as usize) < patches.len());
        is_whole.then_some(Self { patches, patch_of_face })
    }

    /// Numbers of a value.
    pub fn dim(&self) -> usize {
        self.patches[0].dim()
    }

    /// The values over each patch.
    pub fn patches(&self) -> &[PhtSurface] {
        &self.patches
    }

    /// The patch that each face is a part of.
    pub fn patch_of_face(&self) -> &[u32] {
        &self.patch_of_face
    }

    /// The values over the patch that a face is a part of.
    pub fn of_face(&self, face: FaceId) -> &PhtSurface {
        &self.patches[self.patch_of_face[face.index()] as usize]
    }

    /// Values and derivatives up to `max_derivative` at parameters `uv` on faces: rows of `dim` numbers.
    pub fn evaluate(
        &self,
        max_derivative: usize,
        faces: &[u32],
        uv: &[DVec2],
        rule: OutsideRule,
        pool: &Pool,
    ) -> Result<ModelValues, ModelEvalError> {
        let quantity = Quantity::Derivatives(max_derivative);
        let width = quantity.width(self.dim());
        let (mut rows, mut flags, mut outside) = (vec![0.0; width * uv.len()], vec![0; uv.len()], 0);
        for group in by_face(faces, self.patch_of_face.len())? {
            let surface = self.of_face(FaceId(faces[group[0]]));
            let places: Vec<f64> = group.iter().flat_map(|&index| uv[index].to_array()).collect();
            let (mut of_group, mut told) = (vec![0.0; width * group.len()], vec![0; group.len()]);
            let output = Output { rows: &mut of_group, stride: width, flags: &mut told };
            outside += evaluate(surface, quantity, Points::new(&places, 2, group.len()), rule, output, pool)
                .map_err(|error| super::evaluate::of_all(error, &group))?;
            for ((&index, row), flag) in group.iter().zip(of_group.chunks_exact(width)).zip(told) {
                rows[width * index..][..width].copy_from_slice(row);
                flags[index] = flag;
            }
        }
        Ok(ModelValues { rows, flags, outside })
    }

    /// The gradients of each component in space, tangential to the shape that the field lies on: for each point `dim`
    /// rows of three numbers. NaN where the shape has no tangent plane.
    pub fn gradient(
        &self,
        shape: &Model,
        faces: &[u32],
        uv: &[DVec2],
        pool: &Pool,
    ) -> Result<Vec<f64>, FieldGradientError> {
        let count = self.patch_of_face.len();
        if shape.faces().len() != count {
            return Err(FieldGradientError::OtherModel { shape: shape.faces().len(), field: count });
        }
        let width = 3 * self.dim();
        let mut rows = vec![0.0; width * uv.len()];
        for group in by_face(faces, count)? {
            let face = FaceId(faces[group[0]]);
            let Some(surface) = shape.carrier(face).spline() else {
                return Err(FieldGradientError::NoSpline { face: face.index() });
            };
            let places: Vec<DVec2> = group.iter().map(|&index| uv[index]).collect();
            let mut of_group = vec![0.0; width * group.len()];
            field_gradient(surface, self.of_face(face), &places, &mut of_group, pool)
                .map_err(|error| FieldGradientError::Gradient(error.at(|index| group[index])))?;
            for (&index, row) in group.iter().zip(of_group.chunks_exact(width)) {
                rows[width * index..][..width].copy_from_slice(row);
            }
        }
        Ok(rows)
    }
}

/// Gradients of a field on a model cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldGradientError {
    /// The field was not fitted on this model.
    #[error(
        "the shape has {shape} faces and the field {field}: a field goes with the model that it was fitted on"
    )]
    OtherModel {
        /// Faces of the shape.
        shape: usize,
        /// Faces of the field.
        field: usize,
    },
    /// Fields go with patches.
    #[error("face {face} of the shape lies on no spline surface")]
    NoSpline {
        /// The face.
        face: usize,
    },
    /// A face does not exist.
    #[error(transparent)]
    Eval(#[from] ModelEvalError),
    /// A point lies nowhere.
    #[error(transparent)]
    Gradient(#[from] GradientError),
}

impl crate::failure::Classify for FieldGradientError {
    fn kind(&self) -> crate::failure::ErrorKind {
        match self {
            Self::OtherModel { .. } => crate::failure::ErrorKind::InvalidArgument,
            Self::NoSpline { .. } => crate::failure::ErrorKind::WrongKind,
            Self::Eval(error) => error.kind(),
            Self::Gradient(error) => error.kind(),
        }
    }

    /// The offending point or face.
    fn index(&self) -> Option<usize> {
        match self {
            Self::OtherModel { .. } => None,
            Self::NoSpline { face } => Some(*face),
            Self::Eval(error) => error.index(),
            Self::Gradient(error) => error.index(),
        }
    }
}
