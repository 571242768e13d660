//! Models: faces that share edges and vertices.

use super::arguments::{ArgumentError, deref, out};
use super::guard::guard;
use super::planish_status;
use super::status::query;
use super::surface::planish_surface;
use crate::Control;
use crate::export::native::{ModelOrField, Save};
use crate::fit::conversion::{ConversionOptions, to_model};
use crate::model::{EdgeId, Face, FaceId, Form, FormOptions, Model, ModelField, ShellId};
use crate::surface::AnySurface;

/// A model: faces, each a bounded part of a surface, that share edges and vertices. Made by
/// planish_model_from_surface() and others, destroyed by planish_model_free(). A field over the faces of a model, made by
/// planish_field_fitter_fit_model(), is one of another dimension: calls that need places in space refuse it with
/// PLANISH_STATUS_WRONG_KIND.
///
/// Faces, edges, vertices and shells have numbers from 0 on. Calls that take a model const may run at once on any
/// threads.
pub struct planish_model(pub(super) Content);

#[allow(clippy::large_enum_variant, reason = "one for each handle")]
pub(super) enum Content {
    /// In space.
    Shape(Model),
    /// Values over the faces of a model.
    Field(ModelField),
}

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_model>();
};

impl planish_model {
    pub(super) fn into_raw(model: Model) -> *mut Self {
        Box::into_raw(Box::new(Self(Content::Shape(model))))
    }

    pub(super) fn field_into_raw(field: ModelField) -> *mut Self {
        Box::into_raw(Box::new(Self(Content::Field(field))))
    }

    /// The model in space.
    pub(super) fn core(&self) -> Result<&Model, ArgumentError> {
        match &self.0 {
            Content::Shape(model) => Ok(model),
            Content::Field(_) => {
                let (found, needed) = ("a field over the faces of a model", "a model in space");
                Err(ArgumentError::OtherKind { name: "model", found, needed })
            }
        }
    }

    /// The values over faces, of a field.
    pub(super) fn field(&self) -> Option<&ModelField> {
        match &self.0 {
            Content::Field(field) => Some(field),
            Content::Shape(_) => None,
        }
    }

    pub(super) fn saved(&self) -> &dyn Save {
        match &self.0 {
            Content::Shape(model) => model,
            Content::Field(field) => field,
        }
    }

    pub(super) fn loaded(saved: ModelOrField) -> *mut Self {
        match saved {
            ModelOrField::Model(model) => Self::into_raw(model),
            ModelOrField::Field(field) => Self::field_into_raw(field),
        }
    }

    fn face_count(&self) -> usize {
        match &self.0 {
            Content::Shape(model) => model.faces().len(),
            Content::Field(field) => field.patch_of_face().len(),
        }
    }

    pub(super) fn face(&self, index: usize) -> Result<FaceId, ArgumentError> {
        number("face", index, self.face_count()).map(FaceId::new)
    }

    pub(super) fn edge(&self, index: usize) -> Result<EdgeId, ArgumentError> {
        number("edge", index, self.core()?.edges().len()).map(EdgeId::new)
    }

    pub(super) fn shell(&self, index: usize) -> Result<ShellId, ArgumentError> {
        number("shell", index, self.core()?.shells().len()).map(ShellId::new)
    }
}

/// An index below a count.
pub(super) fn number(name: &'static str, index: usize, count: usize) -> Result<u32, ArgumentError> {
    match u32::try_from(index) {
        Ok(number) if index < count => Ok(number),
        _ => Err(ArgumentError::NoSuch { name, index, count }),
    }
}

/// Stands for "none" where a number of a face or shell is expected.
pub const PLANISH_NONE: u32 = u32::MAX;

/// Makes a model of a surface in space: the part inside its trims as an open shell. A tensor surface is one face. A
/// T-spline is one face for each span of v, a PHT-spline one for each rectangle of cells whose levels differ by at most
/// one: tensor surfaces that share edges. A D1RC-spline is one face on a tensor surface fitted to it within 1e-3 of the
/// diagonal. Edges have cubic curves in space, within 1e-7 of the diagonal of their p-curves' images, and p-curves of
/// degree 1, the trims themselves.
///
/// surface:   not NULL, of dimension 3.
/// out_model: receives a new model; destroy with planish_model_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension),
/// PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY (trims that cross or touch, the index is one of them; trims around
/// several pieces; a knot inside the domain that occurs more often than the degree), PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_DEGENERATE (a trim without area, the index; a face without size).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_from_surface(
    surface: *const planish_surface,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.family()?;
        let out_model = out(out_model, "out_model")?;
        let form = match surface {
            AnySurface::TSpline(_) => Form::Strips,
            AnySurface::Pht(_) => Form::Patches,
            AnySurface::Tensor(_) | AnySurface::D1rc(_) => Form::Tensor,
        };
        let form = FormOptions { form, ..FormOptions::default() };
        let options = ConversionOptions { form, ..ConversionOptions::default() };
        let model = to_model(surface, &options, &mut Control::default())?;
        out_model.write(planish_model::into_raw(model));
        Ok(())
    })
}

/// Makes a copy of a model.
///
/// model:     not NULL.
/// out_model: receives a new model; destroy with planish_model_free().
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_clone(
    model: *const planish_model,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let out_model = out(out_model, "out_model")?;
        out_model.write(match &model.0 {
            Content::Shape(model) => planish_model::into_raw(model.clone()),
            Content::Field(field) => planish_model::field_into_raw(field.clone()),
        });
        Ok(())
    })
}

/// Destroys a model.
///
/// model: NULL is accepted; otherwise not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_free(model: *mut planish_model) {
    let _ = guard(|| {
        if !model.is_null() {
            // SAFETY: the caller's promise that this came from the library and is freed once.
            drop(unsafe { Box::from_raw(model) });
        }
        Ok(())
    });
}

/// A count of a model; 0 for NULL.
///
/// # Safety
/// `model` is NULL or a model that nobody changes.
pub(super) unsafe fn query_model(
    model: *const planish_model,
    find: impl FnOnce(&planish_model) -> Result<usize, ArgumentError>,
) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(find(unsafe { deref(model, "model") }?)?))
}

/// Numbers of a place: 3 for a model in space, those of a value for a field over the faces of a model; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_dim(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.field().map_or(3, ModelField::dim))) }
}

/// Number of faces; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_face_count(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.face_count())) }
}

/// Number of edges; one between two faces counts once. 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_edge_count(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.core()?.edges().len())) }
}

/// Number of vertices; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_vertex_count(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.core()?.vertices().len())) }
}

/// Number of shells; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_shell_count(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.core()?.shells().len())) }
}

/// Number of loops of a face; 0 for NULL and for a face that does not exist.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_loop_count(model: *const planish_model, face: usize) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.core()?.face(model.face(face)?).bounds.len())) }
}

/// Number of edges of all loops of a face; one that two loops or sides of the face share counts twice. 0 for NULL and
/// for a face that does not exist.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_coedge_count(model: *const planish_model, face: usize) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(coedge_count(model.core()?.face(model.face(face)?)))) }
}

pub(super) fn coedge_count(face: &Face) -> usize {
    face.bounds.iter().map(Vec::len).sum()
}
