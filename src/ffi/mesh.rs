//! Triangle meshes: how they are made.

use super::arguments::{
    ArgumentError, Record, ReportOut, choice, copy_rows, deref, flag, options, out, slice, slice_mut_or_none,
    stride, strided_len,
};
use super::guard::guard;
use super::planish_status;
use super::status::query;
use crate::mesh::{Components, Faces, Mesh, MeshOptions, MeshRepairs, Repair};
use glam::DVec3;
use std::mem::MaybeUninit;

/// A triangle mesh: manifold and consistently oriented, possibly with several components, holes and nodes
/// without triangles, which are passed over. Made by planish_mesh_new() and others, destroyed by planish_mesh_free().
///
/// Calls that take it const may run at once on any threads; a call that takes it non-const needs it alone.
pub struct planish_mesh(pub(super) Mesh);

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_mesh>();
};

impl planish_mesh {
    pub(super) fn into_raw(mesh: Mesh) -> *mut Self {
        Box::into_raw(Box::new(Self(mesh)))
    }
}

record! {
    /// How arrays or files become a mesh. Fill with planish_mesh_options_init(), then change what you need.
    pub struct planish_mesh_options (planish_mesh_options_init; core: MeshOptions) {
        /// Doubles from one node to the next in `points`; at least 3, or 0 (default) for 3. Ignored for files.
        pub point_stride: usize,
        /// Indices from one triangle to the next in `triangles`; at least 3, or 0 (default) for 3. Ignored for
        /// files.
        pub triangle_stride: usize,
        /// Nodes not further apart than this become one, in model units. Default 0: nothing is welded, except
        /// that nodes of STL files with equal coordinates always are.
        pub weld_distance: f64 = core.weld_distance,
        /// Receives what was repaired, or NULL (default). Set its struct_size before. Filled on success only.
        pub out_repairs: *mut planish_mesh_repairs,
        /// Receives for each node given the node of the mesh that it became, counted from 0: point_count
        /// elements, or NULL (default). Filled on success only. Must be NULL for files;
        /// planish_mesh_copy_node_map() tells the same the other way round.
        /// Array: [nodes].
        pub out_node_map: *mut u32,
        /// 1 turns triangles over until neighbours agree, whatever repair says; 0 (default) leaves that to repair.
        pub orient: u32,
        /// The number that `triangles` uses for the first node, such as 1 from Fortran. Default 0. Ignored for
        /// files. Everything that the library hands back counts from 0.
        pub index_base: u32 = core.index_base,
        /// Corners of each face, at least 3: `triangles` then holds polygons, one behind the other, and
        /// triangle_count is their number. NULL (default) for corner_count each. Borrowed. Ignored for files.
        /// Array: [faces].
        pub face_sizes: *const u32,
        /// Most bytes of a file, unpacked; 0 (default) for three quarters of what the machine or its control group
        /// has.
        pub max_memory: u64 = core.max_memory,
        /// Which faults are mended: bits of planish_mesh_repair. 0 (default) is PLANISH_MESH_REPAIR_SAFE.
        pub repair: u32,
        /// A planish_mesh_components: which parts that hang together by edges become the mesh. The nodes of others
        /// stay, as nodes that no triangle needs. Default PLANISH_MESH_COMPONENTS_ALL.
        pub components: u32,
        /// The part for PLANISH_MESH_COMPONENTS_ONE, counted from 0 in the order of their first triangles. Default 0.
        pub component: u32,
        /// A planish_mesh_format, of files and buffers. Default PLANISH_MESH_FORMAT_AUTO.
        pub format: u32,
        /// Corners of every face if face_sizes is NULL: 0 (default) or 3 for triangles, 4 for quads and so on.
        /// Polygons become triangles. Ignored for files.
        pub corner_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

/// Faults that are mended when arrays or a file become a mesh. All others are refused.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_mesh_repair {
    /// All that change no shape and need no guess: the five that follow NONE.
    Safe = 0,
    /// None.
    None = 1,
    /// Nodes that no triangle needs are kept and passed over, whatever their coordinates are.
    UnusedNodes = 2,
    /// Triangles with a corner twice are left out, and faces of less than three corners.
    RepeatedCorners = 4,
    /// Of triangles with the same three nodes, whatever their orientation, only the first is kept.
    DuplicateTriangles = 8,
    /// Nodes where the surface touches itself become one for each part; the copies come after all other nodes.
    TouchingNodes = 16,
    /// Triangles are turned over until neighbours agree, as few as that takes.
    Orientation = 32,
    /// Edges of three and more triangles are parted: sheets that meet others only there get nodes of their own.
    Sheets = 64,
    /// All of them.
    All = 126,
}

/// Which parts of a mesh that hang together by edges are taken.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_mesh_components {
    /// All.
    All = 0,
    /// The one of most triangles; of equals the first.
    Largest = 1,
    /// One by its number.
    One = 2,
}

impl planish_mesh_options {
    pub(super) fn to_core(self) -> Result<MeshOptions, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        let components = [Components::All, Components::Largest, Components::One(self.component)];
        let orient = if flag(self.orient, "orient")? { Repair::ORIENTATION } else { Repair::NONE };
        Ok(MeshOptions {
            weld_distance: self.weld_distance,
            repair: repair(self.repair)?.with(orient),
            components: choice(self.components, &components, "components")?,
            index_base: self.index_base,
            max_memory: self.max_memory,
        })
    }

    /// The faces that an array of nodes holds, if they are not all triangles.
    ///
    /// # Safety
    /// The arrays are NULL or as the header says.
    unsafe fn faces(&self, nodes: *const u32, count: usize) -> Result<Option<Faces>, ArgumentError> {
        let width = if self.corner_count == 0 { 3 } else { self.corner_count as usize };
        if self.face_sizes.is_null() && width == 3 {
            return Ok(None);
        }
        if self.face_sizes.is_null() && width < 3 {
            return Err(ArgumentError::FaceSize { face: 0, given: self.corner_count });
        }
        let mut faces = Faces::default();
        let mut add = |corners: &[u32]| {
            corners.iter().for_each(|&node| faces.push(node));
            faces.end_face();
        };
        // SAFETY: the caller's promise.
        unsafe {
            if self.face_sizes.is_null() {
                let stride = stride(self.triangle_stride, width, "triangle_stride")?;
                let nodes =
                    slice(nodes, strided_len::<u32>(count, stride, width, "triangles")?, "triangles")?;
                nodes.chunks(stride).for_each(|row| add(&row[..width]));
            } else {
                if self.triangle_stride != 0 {
                    return Err(ArgumentError::StrideOfFaces { given: self.triangle_stride });
                }
                let sizes = slice(self.face_sizes, count, "face_sizes")?;
                if let Some(face) = sizes.iter().position(|&size| size < 3) {
                    return Err(ArgumentError::FaceSize { face, given: sizes[face] });
                }
                let total = sizes.iter().try_fold(0_usize, |sum, &size| sum.checked_add(size as usize));
                let overflow = ArgumentError::Overflow { name: "triangles", count, width: 0 };
                let mut rest = slice(nodes, total.ok_or(overflow)?, "triangles")?;
                for &size in sizes {
                    let (corners, others) = rest.split_at(size as usize);
                    add(corners);
                    rest = others;
                }
            }
        }
        Ok(Some(faces))
    }
}

/// The repair that a number stands for: 0 the safe ones, 1 none, else its bits.
fn repair(number: u32) -> Result<Repair, ArgumentError> {
    let all = planish_mesh_repair::All as u32;
    match number {
        0 => Ok(Repair::SAFE),
        _ => Repair::from_bits(number >> 1).ok_or(ArgumentError::RepairBits { given: number, largest: all }),
    }
}

record! {
    /// What was done to arrays or a file to make a mesh of them. Set struct_size to sizeof(planish_mesh_repairs)
    /// before the call.
    pub struct planish_mesh_repairs {
        /// Nodes that vanished because they were welded to others.
        pub welded_node_count: usize,
        /// Triangles and faces that were left out because two of their corners are one node, as given or by welding,
        /// or because they have less than three.
        pub dropped_triangle_count: usize,
        /// Triangles that were turned over.
        pub flipped_triangle_count: usize,
        /// 1 if the file has texture coordinates that are no parameters, because a node has several or none, or because
        /// they are not finite or lie on a line.
        pub dropped_parameters: u32,
        /// 1 if the file ends before it says that it does; what it has is whole.
        pub missing_end: u32,
        /// Nodes that no triangle needs.
        pub unused_node_count: usize,
        /// Copies of nodes that were appended.
        pub split_node_count: usize,
        /// Triangles that were left out because an earlier one has the same nodes.
        pub duplicate_triangle_count: usize,
        /// Edges of three and more triangles that were parted.
        pub parted_edge_count: usize,
        /// Triangles of components that were not asked for: a choice, no repair.
        pub excluded_triangle_count: usize,
    }
}

impl From<&MeshRepairs> for planish_mesh_repairs {
    fn from(repairs: &MeshRepairs) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            welded_node_count: repairs.welded_nodes,
            dropped_triangle_count: repairs.dropped_triangles,
            flipped_triangle_count: repairs.flipped_triangles,
            dropped_parameters: repairs.dropped_parameters.into(),
            missing_end: repairs.missing_end.into(),
            unused_node_count: repairs.unused_nodes,
            split_node_count: repairs.split_nodes,
            duplicate_triangle_count: repairs.duplicate_triangles,
            parted_edge_count: repairs.parted_edges,
            excluded_triangle_count: repairs.excluded_triangles,
        }
    }
}

/// Where the caller wants a new mesh and what is known of it.
pub(super) struct MeshOutputs<'a> {
    mesh: &'a mut MaybeUninit<*mut planish_mesh>,
    repairs: ReportOut<planish_mesh_repairs>,
    node_map: Option<&'a mut [u32]>,
}

impl MeshOutputs<'_> {
    /// # Safety
    /// The outputs are NULL or as the header says, for `point_count` nodes.
    unsafe fn new(
        mesh: *mut *mut planish_mesh,
        options: &planish_mesh_options,
        point_count: usize,
    ) -> Result<Self, ArgumentError> {
        // SAFETY: the caller's promise.
        unsafe {
            Ok(Self {
                mesh: out(mesh, "out_mesh")?,
                repairs: ReportOut::new(options.out_repairs)?,
                node_map: slice_mut_or_none(options.out_node_map, point_count, "out_node_map")?,
            })
        }
    }

    /// # Safety
    /// The outputs are NULL or as the header says.
    pub(super) unsafe fn of_file(
        mesh: *mut *mut planish_mesh,
        options: &planish_mesh_options,
    ) -> Result<Self, ArgumentError> {
        if !options.out_node_map.is_null() {
            return Err(ArgumentError::NotNull { name: "out_node_map" });
        }
        // SAFETY: the caller's promise.
        unsafe { Self::new(mesh, options, 0) }
    }

    pub(super) fn store(self, mesh: Mesh, repairs: &MeshRepairs) -> planish_status {
        if let Some(node_map) = self.node_map {
            match &repairs.node_map {
                Some(map) => node_map.copy_from_slice(map),
                None => node_map.iter_mut().zip(0..).for_each(|(node, same)| *node = same),
            }
        }
        self.repairs.store(repairs.into());
        self.mesh.write(planish_mesh::into_raw(mesh));
        if repairs.is_empty() { planish_status::Ok } else { planish_status::InputRepaired }
    }
}

/// Makes a mesh from arrays, which are copied.
///
/// points:         point_count rows of x, y, z in model units; rows start options->point_stride doubles apart.
/// point_count:    at least 1.
/// triangles:      triangle_count rows of three nodes, counter-clockwise seen from outside, counted from
///                 options->index_base; rows start options->triangle_stride indices apart. Rows of more nodes with
///                 options->corner_count or options->face_sizes: polygons, which become triangles.
/// triangle_count: at least 1.
/// options:        NULL for the defaults.
/// out_mesh:       receives a new mesh; destroy with planish_mesh_free().
/// Arrays: points[point_count, 3], triangles[triangle_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_INPUT_REPAIRED (something was welded or mended, see
/// options->out_repairs) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (empty
/// arrays, an option), PLANISH_STATUS_NOT_FINITE (a coordinate of a node that has triangles; the index is the node),
/// PLANISH_STATUS_INDEX (a triangle refers to a node that does not exist; the index is the triangle; or there is no
/// such component), PLANISH_STATUS_DEGENERATE (no triangle is left), PLANISH_STATUS_TOPOLOGY (an edge of three
/// triangles, unless PLANISH_MESH_REPAIR_SHEETS parts it; a surface of one side), PLANISH_STATUS_TOO_LARGE,
/// PLANISH_STATUS_VERSION or PLANISH_STATUS_OUT_OF_MEMORY. What options->repair does not mend is refused:
/// PLANISH_STATUS_TOPOLOGY, or PLANISH_STATUS_DEGENERATE for corners that come twice.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_new(
    points: *const f64,
    point_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    options: *const planish_mesh_options,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let options = self::options(options)?;
        let outputs = MeshOutputs::new(out_mesh, &options, point_count)?;
        let point_stride = stride(options.point_stride, 3, "point_stride")?;
        let core = options.to_core()?;
        let points = copy_rows(points, point_count, point_stride, "points", DVec3::from_array)?;
        let (mesh, repairs) = match options.faces(triangles, triangle_count)? {
            Some(faces) => Mesh::from_faces(points, faces, &core)?,
            None => {
                let stride = stride(options.triangle_stride, 3, "triangle_stride")?;
                let triangles = copy_rows(triangles, triangle_count, stride, "triangles", |nodes| nodes)?;
                Mesh::with_options(points, triangles, &core)?
            }
        };
        Ok(outputs.store(mesh, &repairs))
    })
}

/// Makes a copy of a mesh with its parameters and fields.
///
/// mesh:     not NULL.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_clone(
    mesh: *const planish_mesh,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = deref(mesh, "mesh")?;
        let out_mesh = out(out_mesh, "out_mesh")?;
        out_mesh.write(planish_mesh::into_raw(mesh.0.clone()));
        Ok(())
    })
}

/// Destroys a mesh.
///
/// mesh: from this library and not destroyed yet; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_free(mesh: *mut planish_mesh) {
    query(|| {
        if !mesh.is_null() {
            // SAFETY: the caller's promise.
            drop(unsafe { Box::from_raw(mesh) });
        }
        Ok(())
    });
}
