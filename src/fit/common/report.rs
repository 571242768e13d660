//! What a fit says of itself, the same for every method.

use super::Plane;
use super::errors::DataErrors;
use super::interior::InteriorErrors;
pub use super::remarks::{RemarkWords, Remarks};
use crate::control::Watch;
use crate::geometry::Bounds;
use crate::mesh::Mesh;
use crate::parameterize::{folds, stretch};
use glam::DVec2;

/// What a tolerance is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ToleranceScale {
    /// The diagonal of the data's bounding box; for a field, of the box of its values.
    #[default]
    Relative,
    /// Model units.
    Absolute,
}

/// The largest error a fit may have at its data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Positive.
    pub value: f64,
    /// What `value` is measured in.
    pub scale: ToleranceScale,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { value: 1e-3, scale: ToleranceScale::Relative }
    }
}

impl Tolerance {
    /// A relative tolerance below this asks for digits that rounding has eaten.
    pub const SMALLEST: f64 = 1e-12;

    /// The tolerance in model units, and whether it had to be raised to [`Tolerance::SMALLEST`] or to what rounding leaves of
    /// the largest number.
    pub fn absolute(&self, bounds: &Bounds) -> (f64, bool) {
        /// A value is a sum of sixteen products.
        const ROUNDING: f64 = 16.0 * f64::EPSILON;
        let diagonal = bounds.diagonal();
        let largest = bounds.min.iter().chain(&bounds.max).fold(0.0, |most: f64, x| most.max(x.abs()));
        let asked = match self.scale {
            ToleranceScale::Relative => self.value * diagonal,
            ToleranceScale::Absolute => self.value,
        };
        let least = (Self::SMALLEST * diagonal).max(ROUNDING * largest);
        (asked.max(least), asked < least)
    }
}

/// What a fit is to reach, in model units.
#[derive(Debug, Clone, Copy)]
pub(in crate::fit) struct Goal {
    pub tolerance: f64,
    /// Whether the tolerance asked for had to be raised.
    pub is_raised: bool,
    /// The diagonal of the data's bounding box.
    pub diagonal: f64,
}

impl Goal {
    pub(crate) fn new(tolerance: &Tolerance, bounds: &Bounds) -> Self {
        let (tolerance, is_raised) = tolerance.absolute(bounds);
        Self { tolerance, is_raised, diagonal: bounds.diagonal() }
    }
}

/// Why a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StopReason {
    /// The tolerance is met.
    #[default]
    ToleranceMet,
    /// The caller fixed the grid, so there was nothing to refine.
    FixedGrid,
    /// The limit on grid, cells or coefficients is reached.
    Limit,
    /// There would be more coefficients than data.
    DataExhausted,
    /// Refinement no longer lowers the error.
    Stagnated,
}

/// What a fit did and how good it is. Errors are in model units and measured on the finished surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FitReport {
    /// Largest |S(u_n,v_n) - P_n| over the data: what the tolerance bounds.
    pub max_error: f64,
    /// Square root of the mean of its square.
    pub rms_error: f64,
    /// Its mean.
    pub mean_error: f64,
    /// The datum with the largest error.
    pub worst_index: usize,
    /// The tolerance in model units.
    pub tolerance: f64,
    /// Diagonal of the data's bounding box: an error divided by it is relative.
    pub diagonal: f64,
    /// Largest distance from a triangle's centroid or an edge's middle to the surface's tangent plane at the
    /// mean of the nodes' parameters (for a field: to its value there); 0 for data without triangles.
    pub max_interior_error: f64,
    /// The part of it that flat facets on a curved shape explain: the rest of it is the largest distance beyond the
    /// height of the shape above its own facet, estimated from the angles between node normals. Facets at an edge across
    /// which normals turn by more than 30 degrees explain nothing: they are the shape.
    pub facet_sagitta: f64,
    /// Largest closest-point distance from a node to the surface; NaN unless asked for.
    pub max_distance: f64,
    /// Largest error of a fixed datum; 0 without any.
    pub max_fixed_error: f64,
    /// Largest error of the other data as a share of the tolerance of its own: at most 1 where all are met.
    pub max_tolerance_share: f64,
    /// Data that were taken for gross errors and left out, ascending.
    pub left_out: Vec<u32>,
    /// Largest distance of the mirror image of a node to the mesh; 0 unless a symmetric surface was asked for.
    pub mirror_distance: f64,
    /// The plane of symmetry, if one was asked for.
    pub mirror: Option<Plane>,
    /// Largest distance of the surface to the curves of sides that were given.
    pub max_side_error: f64,
    /// Largest angle between the tangent planes of the surface and those of its neighbours along such sides, in radians.
    pub max_side_angle: f64,
    /// Knots of the grid along u.
    pub grid_u: usize,
    /// Knots of the grid along v.
    pub grid_v: usize,
    /// Cells of an adaptive mesh; 0 for a grid.
    pub cell_count: usize,
    /// The deepest level of its cells: how often one of the first was halved.
    pub deepest_level: u32,
    /// Cells of it in which an error exceeds the tolerance.
    pub rough_cell_count: usize,
    /// Unknowns of the fit. The surface may store more control points, which these determine.
    pub coefficient_count: usize,
    /// Unknowns before cells were merged again; 0 for fits without cells.
    pub refined_coefficient_count: usize,
    /// Weight of the smoothing energy in the chosen fit.
    pub smoothing: f64,
    /// Cells without data inside the trims.
    pub empty_cell_count: usize,
    /// Rounds of fitting and measuring.
    pub passes: usize,
    /// Why the fit ended.
    pub stop: StopReason,
    /// Triangles that are reversed or flat in the parameter plane.
    pub flipped_count: usize,
    /// L2 stretch of the map: 1 is an isometry; 0 for data without triangles.
    pub stretch: f64,
    /// Seconds spent on the map.
    pub parameterize_seconds: f64,
    /// Seconds in all.
    pub seconds: f64,
    /// Everything worth knowing.
    pub remarks: Remarks,
}

impl FitReport {
    /// What there is to say of every fit; what only some have to say is nothing here.
    pub(in crate::fit) fn new(errors: &DataErrors, goal: &Goal, stop: StopReason, passes: usize) -> Self {
        let mut remarks = Remarks::default();
        remarks.add_if(!(errors.demand <= goal.tolerance), Remarks::TOLERANCE_NOT_MET);
        remarks.add_if(stop == StopReason::Stagnated, Remarks::STAGNATED);
        remarks.add_if(goal.is_raised, Remarks::TOLERANCE_RAISED);
        Self {
            max_error: errors.max,
            rms_error: errors.rms,
            mean_error: errors.mean,
            worst_index: errors.worst_index,
            tolerance: goal.tolerance,
            diagonal: goal.diagonal,
            max_tolerance_share: errors.max / goal.tolerance,
            max_distance: f64::NAN,
            passes,
            stop,
            remarks,
            ..Self::default()
        }
    }

    /// Adds what was measured between the nodes.
    pub(in crate::fit) fn add_interior(&mut self, interior: &InteriorErrors) {
        self.max_interior_error = interior.max;
        self.facet_sagitta = interior.sagitta;
        self.remarks.add_if(interior.max_excess > self.tolerance, Remarks::ROUGH_BETWEEN_NODES);
    }

    /// Adds what the parameters of a mesh are like. A cancelled call throws the report away.
    pub fn measure_map(&mut self, mesh: &Mesh, uv: &[DVec2], watch: &Watch) {
        let (reversed, flat) = folds(mesh.triangles(), uv);
        self.flipped_count = reversed + flat;
        self.remarks.add_if(self.flipped_count > 0, Remarks::FOLDED_PARAMETERS);
        if watch.check().is_ok() {
            self.stretch = stretch(mesh.points(), mesh.triangles(), uv).l2;
        }
    }
}
