//! Closed meshes on the unit sphere.

use super::arguments::{ReportOut, deref, options, rows_mut};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use crate::parameterize::sphere::{SphereOptions, SphereReport, map_to_sphere};
use libc::c_void;

record! {
    /// How a mesh is mapped on to the sphere. Fill with planish_sphere_options_init(), then change what you need.
    pub struct planish_sphere_options (planish_sphere_options_init) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Sweeps over all nodes at the end. Default 10.
        pub sweeps: u32 = SphereOptions::default().sweeps as u32,
        /// Threads that share the work; 0 (default) for all cores. The result does not depend on it.
        pub thread_count: u32,
    }
}

record! {
    /// How good a map to the sphere is. Set struct_size to sizeof(planish_sphere_report) before the call; the report is
    /// filled as far as that goes, on success only.
    pub struct planish_sphere_report {
        /// Symmetric Dirichlet energy by area, both scaled to those of the sphere: 4 if all lengths are kept.
        pub energy: f64,
        /// Triangles whose images are turned over or flat, by the exact sign; 0 but beyond the digits of a double.
        pub folded_triangles: usize,
        /// Triangles so thin that they counted as wider.
        pub clamped_triangles: usize,
        /// Image area by area in space, each as a share of its whole: 5 percent of the area have less than this.
        pub low_area_ratio: f64,
        /// 5 percent of the area have more than this.
        pub high_area_ratio: f64,
        /// Wall time in seconds.
        pub seconds: f64,
    }
}

impl From<&SphereReport> for planish_sphere_report {
    fn from(report: &SphereReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            energy: report.energy,
            folded_triangles: report.folded_triangles,
            clamped_triangles: report.clamped_triangles,
            low_area_ratio: report.low_area_ratio,
            high_area_ratio: report.high_area_ratio,
            seconds: report.seconds,
        }
    }
}

/// Maps a closed mesh of one component and genus 0 on to the unit sphere, one to one: no triangle is turned over.
///
/// Triangles that are counter-clockwise seen from outside stay so. The map keeps lengths as well as it can: it lowers
/// the symmetric Dirichlet energy, coarse to fine. The same mesh gives the same bits on any number of threads.
///
/// mesh:       not NULL; stays as it is.
/// options:    NULL for the defaults.
/// out_points: receives x, y, z of each node: a unit vector, or zeros for a node without triangles.
/// count:      rows that out_points has room for, at least planish_mesh_point_count().
/// out_report: receives how good the map is; NULL for no report.
/// Arrays: out_points[mesh_point_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (rounding left no room somewhere; out_points is filled)
/// or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_TOPOLOGY (a
/// boundary, with one of its nodes as the index; several components; handles; a node where the surface touches
/// itself, which is the index), PLANISH_STATUS_DEGENERATE (no triangle has an area, or a node without room, which is
/// the index), PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_map_to_sphere(
    mesh: *const planish_mesh,
    options: *const planish_sphere_options,
    out_points: *mut f64,
    count: usize,
    out_report: *mut planish_sphere_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let options = self::options(options)?;
        let report = ReportOut::new(out_report)?;
        let rows = rows_mut(out_points, count, mesh.points().len(), 3, "out_points")?;
        let core = SphereOptions { sweeps: options.sweeps as usize };
        let map = with_control(options.thread_count, listener!(options), |control| {
            map_to_sphere(mesh, &core, control)
        })??;
        for (row, point) in rows.chunks_exact_mut(3).zip(&map.points) {
            row.copy_from_slice(&point.to_array());
        }
        report.store((&map.report).into());
        Ok(match map.report.folded_triangles {
            0 => planish_status::Ok,
            _ => planish_status::FoldedParameters,
        })
    })
}
