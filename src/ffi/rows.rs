//! Rows of points on meshes.

use super::arguments::{ArgumentError, array_len, choice, deref, options, out, rows_mut, slice_mut};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::progress::{planish_progress, with_helper};
use crate::query::rows::{SampleRowsOptions, Source, sample_rows};
use libc::c_void;

/// What the rows of planish_mesh_sample_rows() lie between.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_row_source {
    /// A boundary loop.
    Loop = 0,
    /// A node.
    Node = 1,
}

record! {
    /// What rows to take from a mesh. Fill with planish_sample_rows_options_init(), then change what you need.
    pub struct planish_sample_rows_options (planish_sample_rows_options_init) {
        /// About how far apart points are along a row, in model units; 0 (default) takes the mean length of edges.
        pub spacing: f64,
        /// The loop or node that the first row is nearest to. Default 0.
        pub begin_index: usize,
        /// The loop or node that the last row is nearest to. Default 1.
        pub end_index: usize = 1,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// A planish_row_source: what begin_index counts. Default PLANISH_ROW_SOURCE_LOOP.
        pub begin: u32 = planish_row_source::Loop as u32,
        /// A planish_row_source: what end_index counts. Default PLANISH_ROW_SOURCE_LOOP.
        pub end: u32 = planish_row_source::Loop as u32,
    }
}

/// The source that a choice and an index name; nodes beyond the range of a mesh are refused later.
fn source(given: u32, index: usize, name: &'static str) -> Result<Source, ArgumentError> {
    let node = u32::try_from(index).unwrap_or(u32::MAX);
    choice(given, &[Source::Loop(index), Source::Node(node)], name)
}

/// Takes closed rows of points from a mesh: level curves of a harmonic field between two loops or nodes, which all
/// start on one seam along the field's gradient and run the same way; ready for planish_tspline_skin() with closed.
/// Call it once without out_points for the counts, then with room for all points.
///
/// mesh:            not NULL, in one piece.
/// options:         NULL for the defaults: rows from the first loop to the second.
/// out_row_counts:  receives the number of points of each row, which does not repeat its first.
/// row_count:       rows to take, 1 to 1000000.
/// out_points:      receives rows of x, y, z, row after row; NULL to learn the counts only.
/// point_count:     points that out_points has room for.
/// out_point_count: receives the number of points of all rows.
/// Arrays: out_row_counts[row_count], out_points[point_count, 3], out_point_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, the number of
/// rows, or both sources share a node, which is the index), PLANISH_STATUS_INDEX (no such loop or node),
/// PLANISH_STATUS_TOPOLOGY (the mesh has several pieces; or a row is not one closed curve, as on a mesh with handles or
/// further loops: the index is the row), PLANISH_STATUS_SINGULAR (the field is lost in rounding),
/// PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_sample_rows(
    mesh: *const planish_mesh,
    options: *const planish_sample_rows_options,
    out_row_counts: *mut usize,
    row_count: usize,
    out_points: *mut f64,
    point_count: usize,
    out_point_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let counts = slice_mut(out_row_counts, row_count, "out_row_counts")?;
        let total = out(out_point_count, "out_point_count")?;
        let options = SampleRowsOptions {
            begin: source(given.begin, given.begin_index, "begin")?,
            end: source(given.end, given.end_index, "end")?,
            row_count,
            spacing: given.spacing,
        };
        // results are the same for any number of threads, and one is enough
        let rows = with_helper(listener!(given), |control| sample_rows(mesh, &options, control))??;
        if !out_points.is_null() {
            array_len::<f64>(point_count, 3, "out_points")?;
            let points = rows_mut(out_points, point_count, rows.points.len(), 3, "out_points")?;
            points.as_chunks_mut().0.iter_mut().zip(&rows.points).for_each(|(out, p)| *out = p.to_array());
        }
        counts.copy_from_slice(&rows.counts);
        total.write(rows.points.len());
        Ok(())
    })
}
