//! Coarser meshes.

use super::arguments::{
    ArgumentError, Record, ReportOut, array_len, deref, flag, options, out, rows_mut, slice,
};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::progress::{planish_progress, with_helper};
use crate::mesh::{DecimateOptions, Decimation};
use libc::c_void;

record! {
    /// How coarse a mesh becomes, and what stays. Fill with planish_decimate_options_init(), then change what you need.
    pub struct planish_decimate_options (planish_decimate_options_init; core: DecimateOptions) {
        /// Nodes that are to be left, at least 3. Default 1000.
        pub target_count: usize = core.target_count,
        /// Edges whose triangles turn by more than this are sharp, in radians, at most pi; 0 (default) looks for none.
        pub sharp_angle: f64 = core.sharp_angle.unwrap_or(0.0),
        /// Where the boundary or a chain of sharp edges turns by more than this, in radians, at most pi, its node
        /// stays. Default pi / 4.
        pub corner_angle: f64 = core.corner_angle,
        /// Further sharp edges: two nodes each, counted from 0; NULL (default) for none.
        /// Array: [sharp_edge_count, 2].
        pub sharp_edges: *const u32,
        /// Edges in sharp_edges. Default 0.
        pub sharp_edge_count: usize,
        /// Receives the sharp edges of the new mesh, two nodes each, counted from 0, the smaller first; or NULL
        /// (default). Written on success only.
        /// Array: [out_sharp_edge_count, 2].
        pub out_sharp_edges: *mut u32,
        /// Edges that out_sharp_edges has room for; there are at most as many as sharp edges before. Default 0.
        pub out_sharp_edge_count: usize,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// 1 (default) lets no triangle turn over in the parameter plane, if the mesh has parameters; 0 does not look.
        pub keep_map: u32 = core.keep_map.into(),
        /// 0.
        pub reserved: u32,
    }
}

impl planish_decimate_options {
    fn to_core(self, sharp_edges: &[[u32; 2]]) -> Result<DecimateOptions<'_>, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        Ok(DecimateOptions {
            target_count: self.target_count,
            sharp_angle: (self.sharp_angle != 0.0).then_some(self.sharp_angle),
            sharp_edges,
            corner_angle: self.corner_angle,
            keep_map: flag(self.keep_map, "keep_map")?,
        })
    }
}

record! {
    /// What was done to make a mesh coarser. Set struct_size to sizeof(planish_decimate_report) before the call; the
    /// report is filled as far as that goes, on success only.
    pub struct planish_decimate_report {
        /// Edges that were collapsed.
        pub collapse_count: usize,
        /// Nodes beyond the target that had to stay, because nothing more can be collapsed.
        pub excess_count: usize,
        /// Sharp edges of the new mesh.
        pub sharp_edge_count: usize,
        /// Wall time in seconds.
        pub seconds: f64,
    }
}

impl From<&Decimation> for planish_decimate_report {
    fn from(coarse: &Decimation) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            collapse_count: coarse.report.collapse_count,
            excess_count: coarse.report.excess_count,
            sharp_edge_count: coarse.sharp_edges.len(),
            seconds: coarse.report.seconds,
        }
    }
}

/// Makes a mesh of fewer nodes by collapsing edges where that changes the shape least.
///
/// The nodes left are nodes of the mesh given, with their places, parameters and fields: to know which node each
/// one was, give the mesh a field of node numbers before. Loops, components and handles stay, sharp edges and the
/// boundary stay edges and their corners nodes. No triangle turns by more than 60 degrees in one collapse.
///
/// mesh:       not NULL; stays as it is.
/// options:    NULL for the defaults.
/// out_mesh:   receives a new mesh; destroy with planish_mesh_free().
/// out_report: receives what was done; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_STAGNATED (more nodes than asked for had to stay; out_mesh is there)
/// or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_INDEX (a
/// sharp edge has a node that does not exist; the index is the edge), PLANISH_STATUS_TOPOLOGY (a sharp edge is no
/// edge; it is the index), PLANISH_STATUS_DEGENERATE (with keep_map a triangle is flat or turned over in the
/// parameter plane; it is the index), PLANISH_STATUS_BUFFER_TOO_SMALL (out_sharp_edges), PLANISH_STATUS_TOO_LARGE,
/// PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_decimate(
    mesh: *const planish_mesh,
    options: *const planish_decimate_options,
    out_mesh: *mut *mut planish_mesh,
    out_report: *mut planish_decimate_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let options = self::options(options)?;
        let out_mesh = out(out_mesh, "out_mesh")?;
        let report = ReportOut::new(out_report)?;
        let sharp_len = array_len::<u32>(options.sharp_edge_count, 2, "sharp_edges")?;
        let core = options.to_core(slice(options.sharp_edges, sharp_len, "sharp_edges")?.as_chunks().0)?;
        // results are the same for any number of threads, and one is enough
        let coarse = with_helper(listener!(options), |control| mesh.decimate(&core, control))??;
        if !options.out_sharp_edges.is_null() {
            let (room, needed) = (options.out_sharp_edge_count, coarse.sharp_edges.len());
            rows_mut(options.out_sharp_edges, room, needed, 2, "out_sharp_edges")?
                .copy_from_slice(coarse.sharp_edges.as_flattened());
        }
        report.store((&coarse).into());
        out_mesh.write(planish_mesh::into_raw(coarse.piece.mesh));
        Ok(if coarse.report.excess_count > 0 { planish_status::Stagnated } else { planish_status::Ok })
    })
}
