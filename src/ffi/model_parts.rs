//! What a model is made of: faces, loops, edges, vertices and shells, copied out.

use super::arguments::{ReportOut, deref, out, rows_mut, rows_or_none};
use super::curve::planish_curve;
use super::guard::guard;
use super::model::{Content, PLANISH_NONE, coedge_count, number, planish_model, query_model};
use super::planish_status;
use super::report::write_pairs;
use super::surface::planish_surface;
use crate::model::{Carrier, EdgeCurve, ModelError, NodePlace, Role, Use};
use glam::DVec2;

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
        let needed = super::model::coedge_count(face);
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
        let count = super::model::coedge_count(model.face(id));
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
