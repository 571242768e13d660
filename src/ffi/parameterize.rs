//! Where a mesh gets its (u,v) from.

use super::arguments::{ArgumentError, Record, ReportOut, choice, deref_mut, flag, options, slice_or_none};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::progress::with_control;
use super::report::{gravest, planish_remark};
use super::{planish_progress, planish_status};
use crate::parameterize::{
    Border, Method, ParameterizeOptions, ParameterizeReport, Remarks, parameterize_weighted,
};
use libc::c_void;

/// Which weights an interior node gives its neighbours.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_map_method {
    /// Mean value coordinates: no triangle turns over over a convex border.
    MeanValue = 0,
    /// Cotangents: the conformal map of a flat sheet. Triangles may turn over; the report counts them.
    Harmonic = 1,
}

/// Where the longest boundary loop goes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_border {
    /// The one of circle, square by turns, square by arc and (if `unroll` says so) free with the least L2
    /// stretch.
    Auto = 0,
    /// The circle inscribed in the unit square, spaced by chord length.
    Circle = 1,
    /// The unit square with corners at the four sharpest turns of the loop.
    SquareByTurns = 2,
    /// The unit square with corners at each quarter of the loop's length.
    SquareByArc = 3,
    /// The unit square with the nodes `corners` at (0,0), (1,0), (1,1), (0,1).
    Corners = 4,
    /// All boundary nodes, those of holes too, keep the parameters that the mesh has.
    Kept = 5,
    /// No border at all: unrolled so that lengths are kept best, in the units of the mesh. Refused if that
    /// folds or overlaps itself.
    Free = 6,
}

/// The value of stretch_steps that goes on until the stretch no longer falls.
pub const PLANISH_UNLIMITED: u32 = u32::MAX;

record! {
    /// How a mesh gets its parameters. Fill with planish_parameterize_options_init(), then change what you need.
    pub struct planish_parameterize_options (planish_parameterize_options_init; core: ParameterizeOptions) {
        /// A positive number for each node: large where more parameter area is wanted. NULL (default) for all 1.
        /// Array: [nodes].
        pub node_weights: *const f64,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Outward bulge of a square's sides, in sides, 0 to 0.5: keeps triangles between nodes of one side open.
        /// Default 0.02.
        pub bulge: f64 = core.bulge,
        /// How far border nodes slide with the stretch, 0 to 1. Default 0.
        pub boundary_slide: f64 = core.boundary_slide,
        /// A planish_map_method. Default PLANISH_MAP_METHOD_MEAN_VALUE.
        pub method: u32 = planish_map_method::MeanValue as u32,
        /// A planish_border. Default PLANISH_BORDER_AUTO.
        pub border: u32 = planish_border::Auto as u32,
        /// For PLANISH_BORDER_CORNERS: four nodes of the longest boundary loop in its order, counted from 0.
        pub corners: [u32; 4],
        /// Most steps that lower the stretch after the first map: 0 for none, PLANISH_UNLIMITED (default) until it
        /// no longer falls.
        pub stretch_steps: u32 = PLANISH_UNLIMITED,
        /// Sweeps that smooth the logarithm of the stretch before each step. Default 0.
        pub rings: u32 = core.rings as u32,
        /// 1 (default) closes holes by fans of triangles while the map is computed; 0 lets them become convex.
        pub fill_holes: u32 = core.fill_holes.into(),
        /// With PLANISH_BORDER_AUTO: 1 (default) also unrolls the map with a free border, and takes that if it
        /// neither folds nor overlaps itself and stretches less; 0 does not.
        pub unroll: u32 = core.unroll.into(),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl planish_parameterize_options {
    /// How a fit gives a mesh its parameters: a record in its options, which has no weights of nodes; NULL is for the defaults.
    ///
    /// # Safety
    /// `at` is NULL or points to a record as the header says.
    pub(super) unsafe fn of_fit(at: *const Self) -> Result<ParameterizeOptions, ArgumentError> {
        // SAFETY: the caller's promise.
        let given = unsafe { options(at) }?;
        if !given.node_weights.is_null() {
            return Err(ArgumentError::NotNull { name: "node_weights" });
        }
        given.to_core()
    }

    fn to_core(self) -> Result<ParameterizeOptions, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        let borders = [
            Border::Auto,
            Border::Circle,
            Border::SquareByTurns,
            Border::SquareByArc,
            Border::Corners(self.corners),
            Border::Kept,
            Border::Free,
        ];
        Ok(ParameterizeOptions {
            method: choice(self.method, &[Method::MeanValue, Method::Harmonic], "method")?,
            border: choice(self.border, &borders, "border")?,
            stretch_steps: match self.stretch_steps {
                PLANISH_UNLIMITED => usize::MAX,
                steps => steps as usize,
            },
            rings: self.rings as usize,
            bulge: self.bulge,
            fill_holes: flag(self.fill_holes, "fill_holes")?,
            boundary_slide: self.boundary_slide,
            unroll: flag(self.unroll, "unroll")?,
        })
    }
}

impl From<Border> for planish_border {
    fn from(border: Border) -> Self {
        match border {
            Border::Auto => Self::Auto,
            Border::Circle => Self::Circle,
            Border::SquareByTurns => Self::SquareByTurns,
            Border::SquareByArc => Self::SquareByArc,
            Border::Corners(_) => Self::Corners,
            Border::Kept => Self::Kept,
            Border::Free => Self::Free,
        }
    }
}

record! {
    /// How good a map is and what it took. Set struct_size to sizeof(planish_parameterize_report) before the call;
    /// the report is filled as far as that goes, on success only.
    pub struct planish_parameterize_report {
        /// L2 stretch of all triangles: 1 is an isometry; infinite if a triangle has no parameter area.
        pub stretch: f64,
        /// The largest stretch in any direction anywhere, in the same scale.
        pub max_stretch: f64,
        /// The largest ratio of a triangle's area in space to that in the parameters, by the smallest.
        pub area_ratio: f64,
        /// Wall time in seconds.
        pub seconds: f64,
        /// Triangles turned over against the rest: folds of the map.
        pub flipped_count: usize,
        /// Triangles of exactly zero parameter area.
        pub degenerate_count: usize,
        /// Factorizations of the linear system, all candidates together.
        pub solve_count: usize,
        /// Steps that lowered the stretch of the map returned.
        pub step_count: usize,
        /// Everything worth knowing: bits of planish_remark.
        pub remarks: u64,
        /// The border that was taken: a planish_border.
        pub border: u32,
        /// 1 if the border slid with the stretch.
        pub border_slid: u32,
    }
}

impl From<&ParameterizeReport> for planish_parameterize_report {
    fn from(report: &ParameterizeReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            stretch: report.stretch.l2,
            max_stretch: report.stretch.max,
            area_ratio: report.stretch.area_ratio,
            seconds: report.seconds,
            flipped_count: report.flipped_triangles,
            degenerate_count: report.degenerate_triangles,
            solve_count: report.solves,
            step_count: report.steps,
            remarks: remarks(report.remarks),
            border: planish_border::from(report.border) as u32,
            border_slid: report.border_slid.into(),
        }
    }
}

/// The bits of the ABI, which are one set for maps and fits.
fn remarks(core: Remarks) -> u64 {
    let bits = [
        (Remarks::FOLDED, planish_remark::FoldedParameters),
        (Remarks::HOLES_FILLED, planish_remark::HolesFilled),
        (Remarks::ZERO_AREA, planish_remark::ZeroAreaTriangles),
        (Remarks::HIGH_STRETCH, planish_remark::SegmentationAdvised),
    ];
    bits.into_iter().filter(|&(remark, _)| core.contains(remark)).map(|(_, bit)| bit as u64).sum()
}

/// Gives each node of a disk, possibly with holes, its (u,v). Parameters that the mesh has are replaced.
///
/// mesh:       not NULL; changed on success.
/// options:    NULL for the defaults.
/// out_report: receives how good the map is; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (the mesh has its parameters, some triangles are
/// turned over or flat) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a
/// corner, a node weight, or no parameters to keep), PLANISH_STATUS_TOPOLOGY (closed, several components, a
/// handle, a node where the surface touches itself or that no triangle has), PLANISH_STATUS_DEGENERATE (zero
/// areas or lengths, or a free border that would fold or overlap itself), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_parameterize(
    mesh: *mut planish_mesh,
    options: *const planish_parameterize_options,
    out_report: *mut planish_parameterize_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &mut deref_mut(mesh, "mesh")?.0;
        let options = self::options(options)?;
        let report = ReportOut::new(out_report)?;
        let weights = slice_or_none(options.node_weights, mesh.points().len(), "node_weights")?;
        let core = options.to_core()?;
        let map = with_control(options.thread_count, listener!(options), |control| {
            parameterize_weighted(mesh, &core, weights, control)
        })??;
        mesh.set_parameters(map.uv)?;
        let filled = planish_parameterize_report::from(&map.report);
        report.store(filled);
        Ok(gravest(filled.remarks))
    })
}
