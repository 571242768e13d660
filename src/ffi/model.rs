//! Models: faces that share edges and vertices.

use super::arguments::{
    self, ArgumentError, ReportOut, deref, options, out, rows_mut, rows_or_none, slice, slice_mut,
};
use super::curve::planish_curve;
use super::guard::guard;
use super::planish_status;
use super::report::write_pairs;
use super::status::query;
use super::step::planish_step_options;
use super::surface::planish_surface;
use crate::Control;
use crate::control::Watch;
use crate::export::native::{ModelOrField, Save};
use crate::export::{native, step};
use crate::fit::conversion::{ConversionOptions, to_model};
use crate::model::{
    Carrier, EdgeCurve, EdgeId, Face, FaceId, Form, FormOptions, Measure, Model, ModelError, ModelField,
    NodePlace, Role, ShellId, Use,
};
use crate::surface::AnySurface;
use glam::DVec2;
use libc::{c_char, c_void};

/// A model: faces, each a bounded part of a surface, that share edges and vertices. Made by
/// planish_model_from_surface() and others, destroyed by planish_model_free(). A field over the faces of a model, made by
/// planish_field_fitter_fit_model(), is one of another dimension: calls that need places in space refuse it with
/// PLANISH_STATUS_WRONG_KIND.
///
/// Faces, edges, vertices and shells have numbers from 0 on. Calls that take a model const may run at once on any
/// threads.
pub struct planish_model(Content);

#[allow(clippy::large_enum_variant, reason = "one for each handle")]
enum Content {
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

    fn saved(&self) -> &dyn Save {
        match &self.0 {
            Content::Shape(model) => model,
            Content::Field(field) => field,
        }
    }

    fn loaded(saved: ModelOrField) -> *mut Self {
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

    fn face(&self, index: usize) -> Result<FaceId, ArgumentError> {
        number("face", index, self.face_count()).map(FaceId::new)
    }

    fn edge(&self, index: usize) -> Result<EdgeId, ArgumentError> {
        number("edge", index, self.core()?.edges().len()).map(EdgeId::new)
    }

    fn shell(&self, index: usize) -> Result<ShellId, ArgumentError> {
        number("shell", index, self.core()?.shells().len()).map(ShellId::new)
    }
}

/// An index below a count.
fn number(name: &'static str, index: usize, count: usize) -> Result<u32, ArgumentError> {
    match u32::try_from(index) {
        Ok(number) if index < count => Ok(number),
        _ => Err(ArgumentError::NoSuch { name, index, count }),
    }
}

/// Stands for "none" where a number of a face or shell is expected.
pub const PLANISH_NONE: u32 = u32::MAX;

/// What a face lies on.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_carrier {
    /// A spline surface.
    Spline = 0,
    /// A plane.
    Plane = 1,
    /// A cylinder.
    Cylinder = 2,
}

/// What a shell bounds.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_shell_role {
    /// Nothing: it may have edges of one face.
    Open = 0,
    /// A solid, from outside.
    Solid = 1,
    /// A void inside a solid.
    Void = 2,
}

record! {
    /// What an edge is. Set struct_size to sizeof(planish_edge_info) before the call; filled on success only.
    pub struct planish_edge_info {
        /// Largest angle between the normals of both faces along it, in radians; 0 for an edge of one face.
        pub angle: f64,
        /// Largest distance between its images on the surfaces of both faces; 0 for an edge of one face.
        pub gap: f64,
        /// The face whose loop runs along it; PLANISH_NONE if there is none.
        pub face_along: u32 = PLANISH_NONE,
        /// The face whose loop runs against it; PLANISH_NONE if there is none.
        pub face_against: u32 = PLANISH_NONE,
        /// The vertex where it begins.
        pub vertex_start: u32,
        /// The vertex where it ends.
        pub vertex_end: u32,
        /// 1 if its faces meet at an angle on purpose, else 0.
        pub is_sharp: u32,
        /// A planish_edge_shape, what its curve is.
        pub shape: u32,
        /// The middle of a circle or ellipse; zeros for others.
        pub origin: [f64; 3],
        /// The direction about which a circle or ellipse turns counter-clockwise, of length 1; zeros for others.
        pub axis: [f64; 3],
        /// The direction from the middle where the parameter, an angle in radians, is 0, of length 1; zeros for others.
        pub x_axis: [f64; 3],
        /// Half the width of a circle or ellipse along x_axis and across it; zeros for others.
        pub radii: [f64; 2],
    }
}

/// What the curve of an edge is.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_edge_shape {
    /// A spline.
    Spline = 0,
    /// A straight line.
    Line = 1,
    /// A piece of a circle.
    Circle = 2,
    /// A piece of an ellipse, the longer axis first.
    Ellipse = 3,
}

record! {
    /// What a face is. Set struct_size to sizeof(planish_face_info) before the call; filled on success only.
    pub struct planish_face_info {
        /// A point of the plane, or of the cylinder's axis; zeros for a spline.
        pub origin: [f64; 3],
        /// The normal of the plane, or the direction of the cylinder's axis, of length 1; zeros for a spline.
        pub axis: [f64; 3],
        /// The direction of u in the plane, or where the angle u is 0, of length 1; zeros for a spline.
        pub x_axis: [f64; 3],
        /// Radius of the cylinder; 0 for others.
        pub radius: f64,
        /// Loops, the outer one first.
        pub loop_count: usize,
        /// Edges of all loops.
        pub coedge_count: usize,
        /// A planish_carrier, what the face lies on.
        pub carrier: u32,
        /// What the maker of the model calls it, such as the label of the triangles it was made from.
        pub label: u32,
        /// The shell that it is in.
        pub shell: u32,
        /// 1 if its front is the side to which the normal of its surface points, else 0.
        pub is_forward: u32,
        /// The largest distance between a node of the fitted mesh on the face and the model; NaN without such nodes.
        pub max_error: f64,
        /// Square root of the mean of its square; NaN without such nodes.
        pub rms_error: f64,
        /// Nodes of the fitted mesh on the face; 0 for a model that no fit made.
        pub node_count: usize,
    }
}

record! {
    /// What a shell is. Set struct_size to sizeof(planish_shell_info) before the call; filled on success only.
    pub struct planish_shell_info {
        /// Faces.
        pub face_count: usize,
        /// A planish_shell_role.
        pub role: u32,
        /// The shell inside which it is a void; PLANISH_NONE if it is none.
        pub void_in: u32 = PLANISH_NONE,
    }
}

record! {
    /// What a model measures. Set struct_size to sizeof(planish_measure_report) before the call.
    pub struct planish_measure_report {
        /// Least x, y, z, from samples of every span.
        pub box_min: [f64; 3],
        /// Largest x, y, z, from samples of every span.
        pub box_max: [f64; 3],
        /// Area of all faces.
        pub area: f64,
        /// Volume of all solids, voids taken off; 0 for open shells.
        pub volume: f64,
        /// Largest distance between the images of an edge on the surfaces of both its faces.
        pub max_gap: f64,
        /// Largest angle between the normals on both sides of an edge that is not sharp, in radians.
        pub max_normal_jump: f64,
        /// Largest distance between an edge's curve in space and its images on the surfaces, and between its ends and
        /// its vertices.
        pub curve_deviation: f64,
        /// Diagonal of the box around the model, from samples.
        pub diagonal: f64,
        /// Edges of one face.
        pub free_edge_count: usize,
        /// Edges that are sharp on purpose.
        pub sharp_edge_count: usize,
        /// Control points of the spline surfaces under all faces.
        pub pole_count: usize,
        /// Loops of all faces.
        pub loop_count: usize,
        /// Vertices - edges + the sum of 2 - loops over all faces: for each shell 2, less 2 for each handle and 1 for
        /// each hole in it.
        pub euler_characteristic: i64,
    }
}

impl planish_measure_report {
    fn new(model: &Model, measure: &Measure) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            box_min: measure.min.to_array(),
            box_max: measure.max.to_array(),
            area: measure.area,
            volume: measure.volume,
            max_gap: measure.max_gap,
            max_normal_jump: measure.max_normal_jump,
            curve_deviation: model.curve_deviation(),
            diagonal: model.diagonal(),
            free_edge_count: measure.free_edge_count,
            sharp_edge_count: measure.sharp_edge_count,
            pole_count: model.pole_count(),
            loop_count: model.loop_count(),
            euler_characteristic: model.euler_characteristic(),
        }
    }
}

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
unsafe fn query_model(
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

fn coedge_count(face: &Face) -> usize {
    face.bounds.iter().map(Vec::len).sum()
}

/// What a face is.
///
/// model:    not NULL.
/// face:     below planish_model_face_count().
/// out_info: receives it; not NULL.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or
/// PLANISH_STATUS_INDEX (the face).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_face_info(
    model: *const planish_model,
    face: usize,
    out_info: *mut planish_face_info,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let id = model.face(face)?;
        deref(out_info, "out_info")?;
        let info = ReportOut::new(out_info)?;
        let model = model.core()?;
        let of_face = model.face(id);
        let shell = model.shells().iter().position(|shell| shell.faces.contains(&id));
        let errors = model.face_errors(id);
        let mut filled = planish_face_info {
            loop_count: of_face.bounds.len(),
            coedge_count: coedge_count(of_face),
            label: of_face.label,
            shell: shell.map_or(PLANISH_NONE, |shell| shell as u32),
            is_forward: u32::from(of_face.is_forward),
            max_error: errors.max,
            rms_error: errors.rms,
            node_count: errors.node_count,
            ..planish_face_info::default()
        };
        let (carrier, frame) = match model.carrier(id) {
            Carrier::Spline(_) => (planish_carrier::Spline, None),
            Carrier::Plane(plane) => (planish_carrier::Plane, Some(plane.0)),
            Carrier::Cylinder(cylinder) => {
                filled.radius = cylinder.radius();
                (planish_carrier::Cylinder, Some(*cylinder.frame()))
            }
        };
        filled.carrier = carrier as u32;
        if let Some(frame) = frame {
            [filled.origin, filled.axis, filled.x_axis] =
                [frame.origin(), frame.z(), frame.x()].map(|axis| axis.to_array());
        }
        info.store(filled);
        Ok(())
    })
}

/// Makes a surface of a face: the spline under it, with the loops of the face as trims, the outer one first. A plane
/// becomes a bilinear surface over the same parameters; a cylinder becomes a rational one, whose parameter u is not the
/// angle. Of a field over a model it is the PHT-spline of the values over the patch that the face is a part of.
///
/// model:       not NULL.
/// face:        below planish_model_face_count().
/// out_surface: receives a new surface, which does not need the model; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the face) or
/// PLANISH_STATUS_DEGENERATE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_face(
    model: *const planish_model,
    face: usize,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let face = model.face(face)?;
        let out_surface = out(out_surface, "out_surface")?;
        out_surface.write(match &model.0 {
            Content::Shape(model) => planish_surface::into_raw(model.face_surface(face)?),
            Content::Field(field) => planish_surface::into_raw(field.of_face(face).clone()),
        });
        Ok(())
    })
}

/// Makes a curve of an edge, and says what the edge is. An arc of a circle or ellipse becomes a spline over the same angles
/// that is off by at most 2e-11 of its radius.
///
/// model:     not NULL.
/// edge:      below planish_model_edge_count().
/// out_curve: receives a new curve in space; destroy with planish_curve_free(). NULL for none.
/// out_info:  receives what the edge is; NULL for nothing.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or
/// PLANISH_STATUS_INDEX (the edge).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_edge(
    model: *const planish_model,
    edge: usize,
    out_curve: *mut *mut planish_curve,
    out_info: *mut planish_edge_info,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let id = model.edge(edge)?;
        let model = model.core()?;
        let out_curve = if out_curve.is_null() { None } else { Some(out(out_curve, "out_curve")?) };
        let info = ReportOut::new(out_info)?;
        let (edge, joint) = (model.edge(id), model.joint(id));
        let face = |is_forward| {
            let at = model.uses(id).find(|&at| model.coedge(at).is_forward == is_forward);
            at.map_or(PLANISH_NONE, |at| at.face.index() as u32)
        };
        let [vertex_start, vertex_end] = edge.vertices.map(|vertex| vertex.index() as u32);
        info.store(planish_edge_info {
            angle: joint.angle,
            gap: joint.gap,
            face_along: face(true),
            face_against: face(false),
            vertex_start,
            vertex_end,
            is_sharp: u32::from(edge.is_sharp),
            ..shape_of(&edge.curve)
        });
        out_curve.into_iter().for_each(|to| {
            to.write(planish_curve::into_raw(edge.curve.to_spline()));
        });
        Ok(())
    })
}

/// What the curve of an edge is, and nothing else.
fn shape_of(curve: &EdgeCurve) -> planish_edge_info {
    let mut info = planish_edge_info::default();
    let shape = match curve {
        EdgeCurve::Spline(_) if curve.as_line().is_some() => planish_edge_shape::Line,
        EdgeCurve::Spline(_) => planish_edge_shape::Spline,
        EdgeCurve::Arc(arc) => {
            let frame = arc.frame();
            [info.origin, info.axis, info.x_axis] =
                [frame.origin(), frame.z(), frame.x()].map(|axis| axis.to_array());
            info.radii = arc.radii();
            if arc.is_circle() { planish_edge_shape::Circle } else { planish_edge_shape::Ellipse }
        }
    };
    info.shape = shape as u32;
    info
}

/// Copies the loops of a face: their edges in order, loop after loop, the outer loop first. Each edge begins where the
/// one before it ends; the face lies on the left of a loop as seen from its front.
///
/// model:        not NULL.
/// face:         below planish_model_face_count().
/// out_sizes:    receives the number of edges of each of the planish_model_loop_count() loops; NULL if not wanted.
/// loop_count:   numbers that out_sizes has room for.
/// out_edges:    receives planish_model_coedge_count() edges; NULL if not wanted.
/// out_forward:  for each of them receives 1 if the loop runs along the edge, 0 if it runs against it; NULL if not
///               wanted.
/// coedge_count: numbers that each of out_edges and out_forward has room for.
/// Arrays: out_sizes[model_loop_count], out_edges[model_coedge_count], out_forward[model_coedge_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the face) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_loops(
    model: *const planish_model,
    face: usize,
    out_sizes: *mut usize,
    loop_count: usize,
    out_edges: *mut u32,
    out_forward: *mut u8,
    coedge_count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let face = model.core()?.face(model.face(face)?);
        let sizes = rows_or_none(out_sizes, loop_count, face.bounds.len(), 1, "out_sizes")?;
        let needed = self::coedge_count(face);
        let edges = rows_or_none(out_edges, coedge_count, needed, 1, "out_edges")?;
        let forward = rows_or_none(out_forward, coedge_count, needed, 1, "out_forward")?;
        let coedges = || face.bounds.iter().flatten();
        sizes.into_iter().flatten().zip(&face.bounds).for_each(|(to, bound)| *to = bound.len());
        edges.into_iter().flatten().zip(coedges()).for_each(|(to, coedge)| *to = coedge.edge.index() as u32);
        forward
            .into_iter()
            .flatten()
            .zip(coedges())
            .for_each(|(to, coedge)| *to = u8::from(coedge.is_forward));
        Ok(())
    })
}

/// Makes a curve of where an edge of a face lies in the parameter plane of the face's surface: over the parameters of
/// the edge's curve in space and in its direction, whatever the direction of the loop.
///
/// model:     not NULL.
/// face:      below planish_model_face_count().
/// coedge:    the place of the edge among those of planish_model_copy_loops().
/// out_curve: receives a new curve of dimension 2; destroy with planish_curve_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INDEX (the face, or the place).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_pcurve(
    model: *const planish_model,
    face: usize,
    coedge: usize,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let id = model.face(face)?;
        let model = model.core()?;
        let count = self::coedge_count(model.face(id));
        let (mut bound, mut place) = (0, number("coedge", coedge, count)? as usize);
        let out_curve = out(out_curve, "out_curve")?;
        while place >= model.face(id).bounds[bound].len() {
            place -= model.face(id).bounds[bound].len();
            bound += 1;
        }
        let curve = model.pcurve(Use { face: id, bound, place })?;
        out_curve.write(planish_curve::into_raw(curve));
        Ok(())
    })
}

/// Copies the places of the vertices.
///
/// model:      not NULL.
/// out_points: receives planish_model_vertex_count() rows of x, y, z.
/// count:      rows that out_points has room for.
/// Arrays: out_points[model_vertex_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_vertices(
    model: *const planish_model,
    out_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let vertices = deref(model, "model")?.core()?.vertices();
        let rows = rows_mut(out_points, count, vertices.len(), 3, "out_points")?;
        rows.chunks_exact_mut(3)
            .zip(vertices)
            .for_each(|(row, place)| row.copy_from_slice(&place.to_array()));
        Ok(())
    })
}

/// Number of nodes of the mesh that the model was fitted to; 0 for NULL and for a model that no fit made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_node_count(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(model.core()?.origin().map_or(0, |origin| origin.nodes.len()))) }
}

/// Where each node of the mesh that a model was fitted to lies on the model. Copies and saved models know it too.
///
/// model:     not NULL, made by planish_model_fit().
/// out_faces: receives the face of each node, PLANISH_NONE for a node without triangles; NULL for none.
/// out_uv:    receives rows of u, v on the face's surface, NaN for such nodes; NULL for none.
/// count:     nodes that both have room for, at least planish_model_node_count().
/// Arrays: out_faces[model_node_count], out_uv[model_node_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (no fit made the model) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_locate_nodes(
    model: *const planish_model,
    out_faces: *mut u32,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let origin = deref(model, "model")?.core()?.origin().ok_or(ModelError::NotFitted)?;
        let nodes = &origin.nodes;
        let faces = rows_or_none(out_faces, count, nodes.len(), 1, "out_faces")?;
        let uv = rows_or_none(out_uv, count, nodes.len(), 2, "out_uv")?;
        let number = |node: &Option<NodePlace>| node.map_or(PLANISH_NONE, |node| node.face.index() as u32);
        faces.into_iter().flatten().zip(nodes).for_each(|(to, node)| *to = number(node));
        let places: Vec<DVec2> = nodes.iter().map(|node| node.map_or(DVec2::NAN, |node| node.uv)).collect();
        uv.into_iter().for_each(|to| write_pairs(&places, to));
        Ok(())
    })
}

/// What a shell is, and its faces.
///
/// model:     not NULL.
/// shell:     below planish_model_shell_count().
/// out_info:  receives what it is; NULL for nothing.
/// out_faces: receives its faces; NULL if not wanted.
/// count:     numbers that out_faces has room for.
/// Arrays: out_faces[out_info.face_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size),
/// PLANISH_STATUS_INDEX (the shell) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_copy_shell(
    model: *const planish_model,
    shell: usize,
    out_info: *mut planish_shell_info,
    out_faces: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?;
        let shell = &model.core()?.shells()[model.shell(shell)?.index()];
        let info = ReportOut::new(out_info)?;
        let faces = rows_or_none(out_faces, count, shell.faces.len(), 1, "out_faces")?;
        let (role, void_in) = match shell.role {
            Role::Open => (planish_shell_role::Open, PLANISH_NONE),
            Role::Solid => (planish_shell_role::Solid, PLANISH_NONE),
            Role::VoidIn(solid) => (planish_shell_role::Void, solid.index() as u32),
        };
        info.store(planish_shell_info {
            face_count: shell.faces.len(),
            role: role as u32,
            void_in,
            ..planish_shell_info::default()
        });
        faces.into_iter().flatten().zip(&shell.faces).for_each(|(to, face)| *to = face.index() as u32);
        Ok(())
    })
}

/// Measures a model: its box, area and volume, and how well its faces meet. Area and volume are integrals over the
/// faces inside their loops; that of the volume is exact but for rounding where surfaces are polynomial and at most
/// bicubic and loops are straight in the parameter plane.
///
/// model:      not NULL.
/// out_report: not NULL; struct_size must be set.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_measure(
    model: *const planish_model,
    out_report: *mut planish_measure_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        deref(out_report, "out_report")?;
        let report = ReportOut::new(out_report)?;
        report.store(planish_measure_report::new(model, &model.measure()));
        Ok(())
    })
}

/// Writes a model as a STEP file: solids as solids, with voids, and open shells as a shell-based surface model. Edges
/// are written once, for both faces. The file appears whole or not at all; equal input gives equal bytes.
///
/// model:   not NULL.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// options: NULL for the defaults. What is said there of forms and tolerances is for surfaces, and not used.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
/// not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_step(
    model: *const planish_model,
    path: *const c_char,
    options: *const planish_step_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let core = given.core()?;
        let report = ReportOut::new(given.out_report)?;
        report.store(step::write(model, &core, path, &Watch::default())?.into());
        Ok(())
    })
}

/// Writes the content of the file of planish_model_write_step() into memory.
///
/// model:     not NULL.
/// options:   NULL for the defaults.
/// out_bytes: receives the content, which is text without a NUL; NULL to learn its size.
/// size:      bytes that out_bytes has room for.
/// out_size:  receives the size of the content in bytes; not NULL.
/// Arrays: out_bytes[out_size], out_size[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
/// not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_step_memory(
    model: *const planish_model,
    options: *const planish_step_options,
    out_bytes: *mut c_void,
    size: usize,
    out_size: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let given = self::options(options)?;
        let core = given.core()?;
        let report = ReportOut::new(given.out_report)?;
        let out_size = out(out_size, "out_size")?;
        let (content, written) = step::to_text(model, &core, &Watch::default())?;
        let needed = content.len();
        if !out_bytes.is_null() {
            rows_mut(out_bytes.cast::<u8>(), size, needed, 1, "out_bytes")?
                .copy_from_slice(content.as_bytes());
        }
        out_size.write(needed);
        report.store(written.into());
        Ok(())
    })
}

/// How many bytes planish_model_save() writes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save_size(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(native::save_size(model.saved()))) }
}

/// Writes everything a model is into a buffer, to the bit. The layout is documented in docs/format.md; it is the same
/// on all machines.
///
/// model:  not NULL.
/// buffer: receives planish_model_save_size() bytes.
/// size:   bytes that the buffer has room for.
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save(
    model: *const planish_model,
    buffer: *mut c_void,
    size: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.saved();
        let needed = native::save_size(model);
        if size < needed {
            return Err(ArgumentError::TooSmall { name: "buffer", given: size, needed }.into());
        }
        slice_mut(buffer.cast::<u8>(), needed, "buffer")?.copy_from_slice(&native::save(model));
        Ok(())
    })
}

/// Makes a model from bytes of planish_model_save(). Damaged bytes are refused, sizes are checked before memory is
/// asked for.
///
/// buffer:    size bytes.
/// out_model: receives a new model; destroy with planish_model_free().
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
/// PLANISH_STATUS_VERSION (a later library made it).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_load(
    buffer: *const c_void,
    size: usize,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let bytes = slice(buffer.cast::<u8>(), size, "buffer")?;
        let out_model = out(out_model, "out_model")?;
        out_model.write(planish_model::loaded(native::load_model_or_field(bytes)?));
        Ok(())
    })
}

/// Writes the bytes of planish_model_save() to a file, which appears whole or not at all.
///
/// model: not NULL.
/// path:  ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8) or
/// PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save_file(
    model: *const planish_model,
    path: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.saved();
        Ok(native::save_file(model, arguments::path(path, "path")?)?)
    })
}

/// Makes a model from a file of planish_model_save_file().
///
/// path:      ends with a NUL; on Unix any bytes, elsewhere UTF-8.
/// out_model: receives a new model; destroy with planish_model_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8),
/// PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_load_file(
    path: *const c_char,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let path = arguments::path(path, "path")?;
        let out_model = out(out_model, "out_model")?;
        out_model.write(planish_model::loaded(native::load_model_or_field_file(path)?));
        Ok(())
    })
}
