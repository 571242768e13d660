//! What a model measures.

use super::arguments::{ReportOut, deref};
use super::guard::guard;
use super::model::planish_model;
use super::planish_status;
use crate::model::{Measure, Model};

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
