//! Features of meshes: where they are not smooth.

use super::arguments::{
    ArgumentError, Record, ReportOut, array_len, deref, flag, options, out, rows_mut, rows_or_none, slice,
    slice_mut_or_none,
};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use crate::mesh::{FeatureOptions, Features};

record! {
    /// How features of a mesh are found. Fill with planish_feature_options_init(), then change what you need.
    pub struct planish_feature_options (planish_feature_options_init; core: FeatureOptions) {
        /// Edges whose facets turn by more than this are features, in radians, at most pi; 0 looks for none. Default
        /// 0.7, which is 40 degrees.
        pub sharp_angle: f64 = core.sharp_angle.unwrap_or(0.0),
        /// Chains of feature edges that end go on along edges whose facets turn by more than this, in radians, at most
        /// pi, which lets none go on. Chains of such edges that turn three times more than the surface beside them bends
        /// are features too if they divide it, and a chain that fades out goes on to the next feature straight ahead.
        /// Default 0.26, which is 15 degrees; none of this happens if sharp_angle is 0 or this is pi.
        pub weak_angle: f64 = core.weak_angle,
        /// Where a chain turns by more than this, in radians, at most pi, it has a corner. Default 0.6, which is
        /// 34 degrees.
        pub corner_angle: f64 = core.corner_angle,
        /// Bits of chains that end in nothing and are shorter than this part of the diagonal, 0 to 1, are dropped.
        /// Default 0.04.
        pub least_length: f64 = core.least_length,
        /// Edges that are features whatever their angle: two nodes each, counted from 0; NULL (default) for none.
        /// Array: [sharp_edge_count, 2].
        pub sharp_edges: *const u32,
        /// Edges in sharp_edges. Default 0.
        pub sharp_edge_count: usize,
        /// A number for each triangle: edges between triangles of different numbers are features; NULL (default) for
        /// none.
        /// Array: [mesh_triangle_count].
        pub labels: *const u32,
        /// Receives 1 for each node that is a corner: the end of a chain, a junction, a turn; 0 for all others; or NULL
        /// (default). Written on success only.
        /// Array: [mesh_point_count].
        pub out_is_corner: *mut u8,
        /// Receives what was found, or NULL (default). Set its struct_size before. Filled on success only.
        pub out_report: *mut planish_feature_report,
        /// 1 (default) filters the normals of a noisy mesh before angles are measured; 0 takes them as they are.
        pub filter_noise: u32 = core.filter_noise.into(),
        /// 0.
        pub reserved: u32,
    }
}

impl planish_feature_options {
    fn to_core<'a>(
        self,
        sharp_edges: &'a [[u32; 2]],
        labels: &'a [u32],
    ) -> Result<FeatureOptions<'a>, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        Ok(FeatureOptions {
            sharp_angle: (self.sharp_angle != 0.0).then_some(self.sharp_angle),
            weak_angle: self.weak_angle,
            corner_angle: self.corner_angle,
            least_length: self.least_length,
            sharp_edges,
            labels,
            filter_noise: flag(self.filter_noise, "filter_noise")?,
            ..FeatureOptions::default()
        })
    }
}

record! {
    /// What was found of features. Set struct_size to sizeof(planish_feature_report) before the call; the report is
    /// filled as far as that goes, on success only.
    pub struct planish_feature_report {
        /// Feature edges.
        pub edge_count: usize,
        /// Those of them on the border.
        pub border_edge_count: usize,
        /// Chains of feature edges between corners, and closed ones.
        pub chain_count: usize,
        /// Chains without ends.
        pub closed_chain_count: usize,
        /// Nodes that are no part of a smooth chain.
        pub corner_count: usize,
        /// Edges by which chains were made longer.
        pub prolonged_edge_count: usize,
        /// Edges that were dropped in short bits.
        pub dropped_edge_count: usize,
        /// Noise of the nodes along the normal, as standard deviation by the mean edge length: an estimate.
        pub noise: f64,
    }
}

impl From<&Features> for planish_feature_report {
    fn from(features: &Features) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            edge_count: features.edges.len(),
            border_edge_count: features.border_count,
            chain_count: features.chains.len(),
            closed_chain_count: features.chains.iter().filter(|chain| chain.is_closed).count(),
            corner_count: features.corners.len(),
            prolonged_edge_count: features.prolonged_count,
            dropped_edge_count: features.dropped_count,
            noise: features.noise,
        }
    }
}

/// Finds the edges where a mesh is not smooth: sharp ones, those between labels, those given, and the border.
///
/// They are what sharp_edges of other calls want. Call it once without out_edges for their number, then with room for
/// all, or ask with room for planish_mesh_edge_count() at once.
///
/// mesh:      not NULL; stays as it is.
/// options:   NULL for the defaults.
/// out_edges: receives the nodes of each edge, counted from 0, the smaller first, in increasing order; NULL to learn the
///            number only.
/// count:     edges that out_edges has room for.
/// out_count: receives the number of edges.
/// Arrays: out_edges[count, 2], out_count[1].
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_INDEX (a sharp edge has a node that does not exist; the index is the edge), PLANISH_STATUS_TOPOLOGY
/// (a sharp edge is no edge; it is the index), PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_find_features(
    mesh: *const planish_mesh,
    options: *const planish_feature_options,
    out_edges: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let options = self::options(options)?;
        let total = out(out_count, "out_count")?;
        let report = ReportOut::new(options.out_report)?;
        let is_corner = slice_mut_or_none(options.out_is_corner, mesh.points().len(), "out_is_corner")?;
        let sharp_len = array_len::<u32>(options.sharp_edge_count, 2, "sharp_edges")?;
        let label_count = if options.labels.is_null() { 0 } else { mesh.triangles().len() };
        let core = options.to_core(
            slice(options.sharp_edges, sharp_len, "sharp_edges")?.as_chunks().0,
            slice(options.labels, label_count, "labels")?,
        )?;
        let features = mesh.find_features(&core)?;
        if !out_edges.is_null() {
            rows_mut(out_edges, count, features.edges.len(), 2, "out_edges")?
                .copy_from_slice(features.edges.as_flattened());
        }
        if let Some(is_corner) = is_corner {
            is_corner.fill(0);
            features.corners.iter().for_each(|&node| is_corner[node as usize] = 1);
        }
        report.store((&features).into());
        total.write(features.edges.len());
        Ok(())
    })
}

/// Tells how each label of a mesh hangs together. A label that stands for a face of a CAD model is one piece without
/// handles; one in several pieces or with handles tells that labels are mixed up, or that planish_model_fit() makes
/// several faces of it.
///
/// Call it once without arrays for the number of labels, then with room for all; there are no more than triangles.
///
/// mesh:                not NULL; stays as it is.
/// labels:              a number for each triangle.
/// label_count:         planish_mesh_triangle_count(); 0 for no labels, of which nothing is told.
/// out_labels:          receives each label once, in increasing order; NULL for none.
/// out_triangle_counts: receives for each its number of triangles; NULL for none.
/// out_piece_counts:    receives for each the number of its pieces, which share no edge; NULL for none.
/// out_handle_counts:   receives for each the handles of all its pieces together; NULL for none.
/// count:               labels that each of these arrays has room for.
/// out_count:           receives the number of different labels.
/// Arrays: labels[label_count], out_labels[count], out_triangle_counts[count], out_piece_counts[count],
///   out_handle_counts[count], out_count[1].
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (label_count),
/// PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_label_parts(
    mesh: *const planish_mesh,
    labels: *const u32,
    label_count: usize,
    out_labels: *mut u32,
    out_triangle_counts: *mut usize,
    out_piece_counts: *mut usize,
    out_handle_counts: *mut usize,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let total = out(out_count, "out_count")?;
        let parts = mesh.label_parts(slice(labels, label_count, "labels")?)?;
        let labels = rows_or_none(out_labels, count, parts.len(), 1, "out_labels")?;
        let sizes = rows_or_none(out_triangle_counts, count, parts.len(), 1, "out_triangle_counts")?;
        let pieces = rows_or_none(out_piece_counts, count, parts.len(), 1, "out_piece_counts")?;
        let handles = rows_or_none(out_handle_counts, count, parts.len(), 1, "out_handle_counts")?;
        labels.into_iter().flatten().zip(&parts).for_each(|(to, of)| *to = of.label);
        sizes.into_iter().flatten().zip(&parts).for_each(|(to, of)| *to = of.triangle_count);
        pieces.into_iter().flatten().zip(&parts).for_each(|(to, of)| *to = of.pieces);
        handles.into_iter().flatten().zip(&parts).for_each(|(to, of)| *to = of.handles);
        total.write(parts.len());
        Ok(())
    })
}
