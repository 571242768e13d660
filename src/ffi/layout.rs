//! Quad layouts.

use super::arguments::{ArgumentError, ReportOut, array_len, choice, copy, deref, options, out, rows_mut};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::model::PLANISH_NONE;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::status::query;
use crate::layout::of_mesh::{LayoutKind, MeshLayout, MeshLayoutOptions, layout_of_mesh};
use crate::layout::{Layout, NodeMap};
use std::ffi::c_void;

/// Quadrilateral patches and how they meet; made for a mesh, also the places of its nodes on them.
///
/// Const calls may run at once on any threads.
pub struct planish_layout {
    pub(super) layout: Layout,
    pub(super) map: Option<NodeMap>,
}

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_layout>();
};

impl planish_layout {
    fn into_raw(layout: Layout, map: Option<NodeMap>) -> *mut Self {
        Box::into_raw(Box::new(Self { layout, map }))
    }
}

/// Which layout a mesh gets.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_layout_kind {
    /// The cube for closed meshes of genus 0, else the base complex.
    Auto = 0,
    /// The six faces of a cube; for closed meshes of genus 0 only.
    Cube = 1,
    /// Pairs of triangles of a coarse mesh that follows the shape.
    Complex = 2,
}

const KINDS: [LayoutKind; 3] = [LayoutKind::Auto, LayoutKind::Cube, LayoutKind::Complex];

record! {
    /// How quads make a layout. Fill with planish_layout_options_init(), then change what you need.
    pub struct planish_layout_options (planish_layout_options_init) {
        /// The number of the edge of each side, where two edges join the same vertices; NULL (default) for edges that
        /// are told by their ends. Numbers need not be without gaps.
        /// Array: [quad_count, 4].
        pub edges: *const u32,
    }
}

record! {
    /// How a mesh gets a layout. Fill with planish_mesh_layout_options_init(), then change what you need.
    pub struct planish_mesh_layout_options (planish_mesh_layout_options_init; core: MeshLayoutOptions) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// A planish_layout_kind. Default PLANISH_LAYOUT_KIND_AUTO.
        pub kind: u32,
        /// About how many patches a base complex has, at least 6. Default 40.
        pub patches: u32 = core.patches as u32,
        /// Most sweeps over all nodes at the end. Default 300.
        pub sweeps: u32 = core.sweeps as u32,
        /// Threads that share the work; 0 (default) for all cores. The result does not depend on it.
        pub thread_count: u32,
    }
}

impl planish_mesh_layout_options {
    fn to_core(self) -> Result<MeshLayoutOptions, ArgumentError> {
        Ok(MeshLayoutOptions {
            kind: choice(self.kind, &KINDS, "kind")?,
            patches: self.patches as usize,
            sweeps: self.sweeps as usize,
        })
    }
}

record! {
    /// How good the layout of a mesh is. Set struct_size to sizeof(planish_mesh_layout_report) before the call; the
    /// report is filled as far as that goes, on success only.
    pub struct planish_mesh_layout_report {
        /// Symmetric Dirichlet energy of the node map by area: 4 if all lengths are kept; of a cube that of the map to
        /// the sphere.
        pub energy: f64,
        /// The same before nodes moved over the layout.
        pub first_energy: f64,
        /// Nodes with a triangle whose image is turned over.
        pub folded_node_count: usize,
        /// Nodes whose triangles are spread over patches without a common corner.
        pub spread_node_count: usize,
        /// Vertices of only two patches that were removed, each with one patch.
        pub doublet_count: usize,
        /// Edges of the coarse mesh that were split because its triangles could not be paired.
        pub split_count: usize,
        /// Wall time in seconds.
        pub seconds: f64,
        /// The kind that was made: a planish_layout_kind.
        pub kind: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl From<&MeshLayout> for planish_mesh_layout_report {
    fn from(made: &MeshLayout) -> Self {
        let kind = KINDS.iter().position(|&kind| kind == made.report.kind);
        Self {
            struct_size: size_of::<Self>(),
            energy: made.report.energy,
            first_energy: made.report.first_energy,
            folded_node_count: made.report.folded_nodes,
            spread_node_count: made.report.spread_nodes,
            doublet_count: made.report.doublets,
            split_count: made.report.splits,
            seconds: made.report.seconds,
            kind: kind.unwrap_or(0) as u32,
            reserved: 0,
        }
    }
}

/// Makes a layout of quads whose sides meet.
///
/// corners:    four vertices of each quad, counted from 0, counter-clockwise seen from outside.
/// quad_count: at least 1.
/// options:    NULL for the defaults.
/// out_layout: receives a new layout; destroy with planish_layout_free().
/// Arrays: corners[quad_count, 4].
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (no quads),
/// PLANISH_STATUS_INDEX (numbers of vertices with gaps so large that they cannot be meant), PLANISH_STATUS_TOPOLOGY (a
/// vertex twice in a quad, three sides at an edge, sides that run the same way: the index is the quad; quads that touch
/// in a vertex only, or fewer than three around a vertex inside: the index is the vertex), PLANISH_STATUS_TOO_LARGE,
/// PLANISH_STATUS_VERSION or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_new(
    corners: *const u32,
    quad_count: usize,
    options: *const planish_layout_options,
    out_layout: *mut *mut planish_layout,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let options = self::options(options)?;
        let out_layout = out(out_layout, "out_layout")?;
        let len = array_len::<u32>(quad_count, 4, "corners")?;
        let corners = copy(corners, len, "corners")?;
        let quads = corners.as_chunks().0;
        let layout = if options.edges.is_null() {
            Layout::new(quads)?
        } else {
            Layout::with_edges(quads, copy(options.edges, len, "edges")?.as_chunks().0)?
        };
        out_layout.write(planish_layout::into_raw(layout, None));
        Ok(())
    })
}

/// Makes the layout of the six faces of a cube: -x, x, -y, y, -z, z.
///
/// out_layout: receives a new layout; destroy with planish_layout_free().
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_cube(out_layout: *mut *mut planish_layout) -> planish_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        out(out_layout, "out_layout")?.write(planish_layout::into_raw(Layout::cube(), None));
        Ok(())
    })
}

/// Makes a layout for a mesh of one component and any genus, closed or with a border, with the places of its nodes.
///
/// A cube keeps to the sphere; a base complex follows the shape: its patches are nearly square and of nearly equal
/// size. The same mesh gives the same bits on any number of threads.
///
/// mesh:       not NULL; stays as it is.
/// options:    NULL for the defaults.
/// out_layout: receives a new layout; destroy with planish_layout_free().
/// out_report: receives how good it is; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (some nodes have triangles that are turned over, or spread
/// over too many patches; out_layout is there) or an error: PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_TOPOLOGY (several components; for a cube a boundary, with one
/// of its nodes as the index, or handles; a node where the surface touches itself, which is the index),
/// PLANISH_STATUS_DEGENERATE (no triangle has an area, or coarse triangles make no layout), PLANISH_STATUS_VERSION or
/// PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_of_mesh(
    mesh: *const planish_mesh,
    options: *const planish_mesh_layout_options,
    out_layout: *mut *mut planish_layout,
    out_report: *mut planish_mesh_layout_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let options = self::options(options)?;
        let out_layout = out(out_layout, "out_layout")?;
        let report = ReportOut::new(out_report)?;
        let core = options.to_core()?;
        let made = with_control(options.thread_count, listener!(options), |control| {
            layout_of_mesh(mesh, &core, control)
        })??;
        report.store((&made).into());
        let is_sound = made.report.folded_nodes + made.report.spread_nodes == 0;
        out_layout.write(planish_layout::into_raw(made.layout, Some(made.map)));
        Ok(if is_sound { planish_status::Ok } else { planish_status::FoldedParameters })
    })
}

/// Destroys a layout.
///
/// layout: from a call that makes layouts, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_free(layout: *mut planish_layout) {
    if !layout.is_null() {
        // SAFETY: made by into_raw(), and the caller's promise to free it once.
        drop(unsafe { Box::from_raw(layout) });
    }
}

/// The number of quads; 0 for NULL.
///
/// layout: a layout, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_quad_count(layout: *const planish_layout) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(layout, "layout") }?.layout.quads().len()))
}

/// One more than the largest number of a vertex; 0 for NULL.
///
/// layout: a layout, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_vertex_count(layout: *const planish_layout) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(layout, "layout") }?.layout.vertex_count()))
}

/// The number of edges; 0 for NULL.
///
/// layout: a layout, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_edge_count(layout: *const planish_layout) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(layout, "layout") }?.layout.edges().len()))
}

/// The number of nodes that have places on the layout; 0 if it was not made for a mesh, and for NULL.
///
/// layout: a layout, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_node_count(layout: *const planish_layout) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(layout, "layout") }?.map.as_ref().map_or(0, |map| map.places().len())))
}

/// Copies the corners of the quads.
///
/// layout:      not NULL.
/// out_corners: receives four vertices of each quad, counted from 0, counter-clockwise: at (0,0), (1,0), (1,1), (0,1).
/// count:       quads that out_corners has room for, at least planish_layout_quad_count().
/// Arrays: out_corners[count, 4].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_copy_corners(
    layout: *const planish_layout,
    out_corners: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let quads = deref(layout, "layout")?.layout.quads();
        let out = rows_mut(out_corners, count, quads.len(), 4, "out_corners")?;
        out.copy_from_slice(quads.as_flattened());
        Ok(())
    })
}

/// Copies the edges.
///
/// layout:    not NULL.
/// out_edges: receives six numbers of each edge, counted from 0: the vertices at its begin and its end, the quad and the
///            side (from corner k to corner k + 1) that run this way, the quad and the side that run the other way, which
///            are PLANISH_NONE at a border.
/// count:     edges that out_edges has room for, at least planish_layout_edge_count().
/// Arrays: out_edges[count, 6].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_copy_edges(
    layout: *const planish_layout,
    out_edges: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let edges = deref(layout, "layout")?.layout.edges();
        let rows = rows_mut(out_edges, count, edges.len(), 6, "out_edges")?;
        for (row, edge) in rows.as_chunks_mut().0.iter_mut().zip(edges) {
            let [begin, end] = edge.ends;
            let other = edge.second.map_or([PLANISH_NONE; 2], |side| [side.quad, side.side.into()]);
            *row = [begin, end, edge.first.quad, edge.first.side.into(), other[0], other[1]];
        }
        Ok(())
    })
}

/// Copies the valences of the vertices.
///
/// layout:       not NULL.
/// out_valences: receives the number of quads around each vertex; 0 for a number that no quad has.
/// count:        vertices that out_valences has room for, at least planish_layout_vertex_count().
/// Arrays: out_valences[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_copy_valences(
    layout: *const planish_layout,
    out_valences: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let layout = &deref(layout, "layout")?.layout;
        let out = rows_mut(out_valences, count, layout.vertex_count(), 1, "out_valences")?;
        (0..).zip(out).for_each(|(vertex, valence)| *valence = layout.valence(vertex) as u32);
        Ok(())
    })
}

/// Copies where the nodes of the mesh lie on the layout.
///
/// layout:    not NULL, made by planish_layout_of_mesh().
/// out_quads: receives the quad of each node, counted from 0; PLANISH_NONE for a node without triangles.
/// out_uv:    receives the parameters of each node on its quad, 0 to 1; NaN for a node without triangles.
/// count:     nodes that both have room for, at least planish_layout_node_count().
/// Arrays: out_quads[count], out_uv[count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the layout was not made for
/// a mesh) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_layout_copy_node_map(
    layout: *const planish_layout,
    out_quads: *mut u32,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let map = deref(layout, "layout")?.map.as_ref().ok_or(ArgumentError::NoNodeMap)?;
        let quads = rows_mut(out_quads, count, map.places().len(), 1, "out_quads")?;
        let uv = rows_mut(out_uv, count, map.places().len(), 2, "out_uv")?;
        for ((quad, uv), place) in quads.iter_mut().zip(uv.as_chunks_mut().0).zip(map.places()) {
            *quad = place.map_or(PLANISH_NONE, |place| place.quad);
            *uv = place.map_or([f64::NAN; 2], |place| place.uv.to_array());
        }
        Ok(())
    })
}
