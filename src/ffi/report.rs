//! What fits say of themselves, and what they hand back.

use super::arguments::{ArgumentError, ReportOut, out, slice_mut_or_none};
use super::planish_status;
use crate::fit::report::{FitReport, Remarks, StopReason};
use glam::DVec2;
use std::mem::MaybeUninit;

/// Things worth knowing about a map or a fit: the bits of `remarks` in reports, several may hold.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_remark {
    /// The surface misses the tolerance.
    ToleranceNotMet = 1,
    /// The fit ended because refinement no longer lowered the error.
    Stagnated = 2,
    /// Some triangles are turned over or flat in the parameter plane: the surface may fold there.
    FoldedParameters = 4,
    /// The mesh had no parameters and was parameterized first.
    Parameterized = 8,
    /// Given parameters were uneven and have been regularized.
    Regularized = 16,
    /// The tolerance was below what double precision can keep and was raised.
    ToleranceRaised = 32,
    /// Some cells hold no data; the surface is extrapolated there.
    EmptyCells = 64,
    /// Between the nodes the surface departs from the facets by more than the tolerance and what the facets explain:
    /// beside sharp edges, or where it swings.
    RoughBetweenNodes = 128,
    /// The map is so compressed that one chart is the wrong tool: cut the mesh into several.
    SegmentationAdvised = 256,
    /// The data do not determine the beam energy's null space; the plate energy was used instead.
    PlateEnergyUsed = 512,
    /// Triangles of the mesh, or of the triangulated model, cross each other.
    SelfIntersecting = 1024,
    /// Points that lay on the one before them in their row have been merged with it.
    MergedPoints = 1048576,
    /// A row looks reversed or shifted against the one before it: see align in planish_skin_options.
    TwistedRows = 2097152,
    /// Some rows are much nearer to one another than to the next: control curves overshoot.
    ClusteredRows = 4194304,
    /// The end points of rows are too near to those of the next to say how far apart rows are; mean distances do.
    MeanSteps = 8388608,
    /// Holes were closed by fans of triangles while the map was computed.
    HolesFilled = 65536,
    /// Triangles without area in space were left out of the map's weights.
    ZeroAreaTriangles = 131072,
}

/// Why a fit ended.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_stop_reason {
    /// The tolerance is met.
    ToleranceMet = 0,
    /// The caller fixed the grid, so there was nothing to refine.
    FixedGrid = 1,
    /// The limit on grid or coefficients is reached.
    Limit = 2,
    /// There would be more coefficients than data.
    DataExhausted = 3,
    /// Refinement no longer lowered the error.
    Stagnated = 4,
}

impl From<StopReason> for planish_stop_reason {
    fn from(reason: StopReason) -> Self {
        match reason {
            StopReason::ToleranceMet => Self::ToleranceMet,
            StopReason::FixedGrid => Self::FixedGrid,
            StopReason::Limit => Self::Limit,
            StopReason::DataExhausted => Self::DataExhausted,
            StopReason::Stagnated => Self::Stagnated,
        }
    }
}

record! {
    /// What a fit did and how good it is. Set struct_size to sizeof(planish_fit_report) before the call; the
    /// report is filled as far as that goes, on success only. Errors and lengths are in model units (for a field,
    /// in units of its values) and measured on the finished surface.
    pub struct planish_fit_report {
        /// Largest distance between a datum and the surface at the datum's (u,v): what the tolerance bounds.
        pub max_error: f64,
        /// Square root of the mean of its square.
        pub rms_error: f64,
        /// Its mean.
        pub mean_error: f64,
        /// The tolerance that was kept or missed.
        pub tolerance: f64,
        /// Diagonal of the data's bounding box: an error divided by it is relative.
        pub diagonal: f64,
        /// Largest distance from a triangle's centroid or an edge's middle to the surface's tangent plane at the
        /// mean of the nodes' (u,v) (for a field: to its value there); 0 for data without triangles.
        pub max_interior_error: f64,
        /// The part of max_interior_error that flat facets on a curved shape explain: max_interior_error - facet_sagitta is
        /// the largest distance beyond what its own facet explains, and PLANISH_REMARK_ROUGH_BETWEEN_NODES tells where that
        /// is above the tolerance. Facets at an edge across which normals turn by more than 30 degrees explain nothing: they
        /// are the shape.
        pub facet_sagitta: f64,
        /// Largest closest-point distance from a node to the surface; NaN unless measure_distance asked for it.
        pub max_distance: f64,
        /// Weight of the smoothing energy in the surface returned.
        pub smoothing: f64,
        /// L2 stretch of the map: 1 is an isometry; 0 for data without triangles.
        pub stretch: f64,
        /// Wall time spent on the map, in seconds.
        pub parameterize_seconds: f64,
        /// Wall time in all, in seconds.
        pub seconds: f64,
        /// The datum with the largest error, counted from 0.
        pub worst_index: usize,
        /// Different knots along u.
        pub grid_u: usize,
        /// Different knots along v.
        pub grid_v: usize,
        /// Unknowns of the fit. The surface may have more control points, which these determine.
        pub coefficient_count: usize,
        /// Cells without data inside the trims.
        pub empty_cell_count: usize,
        /// Triangles that are turned over or flat in the parameter plane.
        pub flipped_count: usize,
        /// Everything worth knowing: bits of planish_remark.
        pub remarks: u64,
        /// Rounds of fitting and measuring.
        pub pass_count: u32,
        /// Why the fit ended: a planish_stop_reason.
        pub stop_reason: u32,
        /// Cells of an adaptive mesh; 0 for a grid.
        pub cell_count: usize,
        /// Cells of it in which an error exceeds the tolerance.
        pub rough_cell_count: usize,
        /// The deepest level of its cells: how often one of the first was halved.
        pub deepest_level: u32,
        /// 0.
        pub reserved: u32,
        /// Largest error of a fixed datum; 0 without any.
        pub max_fixed_error: f64,
        /// Largest error of the other data as a share of the tolerance of its own: at most 1 where all are met.
        pub max_tolerance_share: f64,
        /// Data that were taken for gross errors and left out.
        pub left_out_count: usize,
        /// Largest distance of the mirror image of a node to the mesh, if symmetry was asked for; else 0.
        pub mirror_distance: f64,
        /// Largest distance of the surface to the curves of sides that were given; 0 without any.
        pub max_side_error: f64,
        /// Largest angle between the tangent planes of the surface and those of its neighbours along such sides, in
        /// radians.
        pub max_side_angle: f64,
        /// Unknowns before cells were merged again, as coarsening asks; that of coefficient_count where none were, 0 for a
        /// fit without cells.
        pub refined_coefficient_count: usize,
    }
}

impl From<&FitReport> for planish_fit_report {
    fn from(report: &FitReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            max_error: report.max_error,
            rms_error: report.rms_error,
            mean_error: report.mean_error,
            tolerance: report.tolerance,
            diagonal: report.diagonal,
            max_interior_error: report.max_interior_error,
            facet_sagitta: report.facet_sagitta,
            max_distance: report.max_distance,
            smoothing: report.smoothing,
            stretch: report.stretch,
            parameterize_seconds: report.parameterize_seconds,
            seconds: report.seconds,
            worst_index: report.worst_index,
            grid_u: report.grid_u,
            grid_v: report.grid_v,
            coefficient_count: report.coefficient_count,
            empty_cell_count: report.empty_cell_count,
            flipped_count: report.flipped_count,
            remarks: report.remarks.0,
            pass_count: u32::try_from(report.passes).unwrap_or(u32::MAX),
            stop_reason: planish_stop_reason::from(report.stop) as u32,
            cell_count: report.cell_count,
            rough_cell_count: report.rough_cell_count,
            deepest_level: report.deepest_level,
            reserved: 0,
            max_fixed_error: report.max_fixed_error,
            max_tolerance_share: report.max_tolerance_share,
            left_out_count: report.left_out.len(),
            mirror_distance: report.mirror_distance,
            max_side_error: report.max_side_error,
            max_side_angle: report.max_side_angle,
            refined_coefficient_count: report.refined_coefficient_count,
        }
    }
}

/// The bits of a fit's remarks are those of the ABI.
const _: () = {
    assert!(Remarks::TOLERANCE_NOT_MET.0 == planish_remark::ToleranceNotMet as u64);
    assert!(Remarks::STAGNATED.0 == planish_remark::Stagnated as u64);
    assert!(Remarks::FOLDED_PARAMETERS.0 == planish_remark::FoldedParameters as u64);
    assert!(Remarks::PARAMETERIZED.0 == planish_remark::Parameterized as u64);
    assert!(Remarks::REGULARIZED.0 == planish_remark::Regularized as u64);
    assert!(Remarks::TOLERANCE_RAISED.0 == planish_remark::ToleranceRaised as u64);
    assert!(Remarks::EMPTY_CELLS.0 == planish_remark::EmptyCells as u64);
    assert!(Remarks::ROUGH_BETWEEN_NODES.0 == planish_remark::RoughBetweenNodes as u64);
    assert!(Remarks::SEGMENTATION_ADVISED.0 == planish_remark::SegmentationAdvised as u64);
    assert!(Remarks::SELF_INTERSECTING.0 == planish_remark::SelfIntersecting as u64);
    assert!(Remarks::PLATE_ENERGY_USED.0 == planish_remark::PlateEnergyUsed as u64);
    assert!(Remarks::MERGED_POINTS.0 == planish_remark::MergedPoints as u64);
    assert!(Remarks::TWISTED_ROWS.0 == planish_remark::TwistedRows as u64);
    assert!(Remarks::CLUSTERED_ROWS.0 == planish_remark::ClusteredRows as u64);
    assert!(Remarks::MEAN_STEPS.0 == planish_remark::MeanSteps as u64);
};

/// The gravest remark has the say. A fold may spoil any surface, so it comes before a missed tolerance, and
/// that before the reason why it was missed.
pub(super) fn gravest(remarks: u64) -> planish_status {
    let by_gravity = [
        (planish_remark::FoldedParameters, planish_status::FoldedParameters),
        (planish_remark::ToleranceNotMet, planish_status::ToleranceNotMet),
        (planish_remark::Stagnated, planish_status::Stagnated),
        (planish_remark::MergedPoints, planish_status::InputRepaired),
    ];
    let found = by_gravity.into_iter().find(|&(remark, _)| remarks & remark as u64 != 0);
    found.map_or(planish_status::Ok, |(_, status)| status)
}

/// Where the caller wants the results of a fit: of a surface or, as `T`, of a curve.
pub(super) struct FitOutputs<'a, T> {
    handle: &'a mut MaybeUninit<*mut T>,
    report: ReportOut<planish_fit_report>,
    parameters: Option<&'a mut [f64]>,
    errors: Option<&'a mut [f64]>,
    left_out: Option<&'a mut [u8]>,
    plane: Option<&'a mut [f64]>,
}

impl<T> FitOutputs<'_, T> {
    /// # Safety
    /// Each is NULL or as the header says, for `count` data.
    pub(super) unsafe fn new(
        handle: (*mut *mut T, &'static str),
        report: *mut planish_fit_report,
        parameters: *mut f64,
        errors: *mut f64,
        count: usize,
    ) -> Result<Self, ArgumentError> {
        // SAFETY: the caller's promise.
        unsafe {
            Ok(Self {
                handle: out(handle.0, handle.1)?,
                report: ReportOut::new(report)?,
                parameters: slice_mut_or_none(parameters, count.saturating_mul(2), "out_parameters")?,
                errors: slice_mut_or_none(errors, count, "out_errors")?,
                left_out: None,
                plane: None,
            })
        }
    }

    /// The same with a list of the data that are left out.
    ///
    /// # Safety
    /// It is NULL or as the header says, for `count` data.
    pub(super) unsafe fn and_left_out(self, left_out: *mut u8, count: usize) -> Result<Self, ArgumentError> {
        // SAFETY: the caller's promise.
        Ok(Self { left_out: unsafe { slice_mut_or_none(left_out, count, "out_left_out") }?, ..self })
    }

    /// The same with the plane of symmetry.
    ///
    /// # Safety
    /// It is NULL or points to six numbers.
    pub(super) unsafe fn and_plane(self, plane: *mut f64) -> Result<Self, ArgumentError> {
        // SAFETY: the caller's promise.
        Ok(Self { plane: unsafe { slice_mut_or_none(plane, 6, "out_plane") }?, ..self })
    }

    /// Hands everything over.
    pub(super) fn store(
        self,
        handle: *mut T,
        uv: &[DVec2],
        errors: &[f64],
        report: &FitReport,
    ) -> planish_status {
        if let Some(out) = self.parameters {
            write_pairs(uv, out);
        }
        if let Some(out) = self.errors {
            out.copy_from_slice(errors);
        }
        if let Some(out) = self.left_out {
            out.fill(0);
            report.left_out.iter().for_each(|&datum| out[datum as usize] = 1);
        }
        if let (Some(out), Some(plane)) = (self.plane, report.mirror) {
            plane.point.write_to_slice(out);
            plane.normal.write_to_slice(&mut out[3..]);
        }
        self.report.store(report.into());
        self.handle.write(handle);
        gravest(report.remarks.0)
    }
}

/// Pairs as plain numbers.
pub(super) fn write_pairs(pairs: &[DVec2], out: &mut [f64]) {
    pairs.iter().zip(out.chunks_exact_mut(2)).for_each(|(pair, out)| pair.write_to_slice(out));
}
