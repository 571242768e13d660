//! What a skin may be asked for.

use crate::fit::common::report::Tolerance;
use crate::options::with_fields;

/// Which knots the control curves get.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkinMethod {
    /// Each its own, as few as the tolerance allows.
    #[default]
    ControlCurves,
    /// All the same: the classical skin, a tensor surface in the end; for comparison.
    CommonKnots,
}

/// What happens at the ends of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SectionEnds<'a> {
    /// Periodic for closed rows, parabolic for open ones.
    #[default]
    Auto,
    /// The slope of the parabola through three points; at the seam of closed rows a kink may remain.
    Parabolic,
    /// No curvature.
    Natural,
    /// For each row the slopes at its begin and its end, derivatives with respect to chord length: a unit tangent
    /// keeps the pace.
    Slopes(&'a [f64]),
    /// Closed rows go on over the seam without a break in two derivatives.
    Periodic,
}

/// How far apart rows are along v.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VRule {
    /// As their first and last points are; where that gives a step of next to nothing, as [`VRule::Mean`].
    #[default]
    Endpoints,
    /// As points at equal fractions of their lengths are on average.
    Mean,
}

/// How the surface runs from row to row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VSlopes {
    /// Without a break in two derivatives; bunched rows make it swing between others.
    #[default]
    Smooth,
    /// Without a break in one derivative, and no coordinate leaves the range of the two rows that it is between: it
    /// cannot overshoot.
    Monotone,
}

/// Options of skins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkinOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// Which knots the control curves get.
    pub method: SkinMethod,
    /// Whether rows are closed: their first point is not repeated.
    pub closed: bool,
    /// What happens at the ends of the rows.
    pub ends: SectionEnds<'a>,
    /// Whether the last row is followed by the first one.
    pub closed_v: bool,
    /// A vector for each point of the first row: the derivative across it, with respect to length along v, so that
    /// unit vectors keep the pace. None: no curvature there.
    pub begin_tangents: Option<&'a [f64]>,
    /// The same at the last row.
    pub end_tangents: Option<&'a [f64]>,
    /// How far apart rows are along v.
    pub v_rule: VRule,
    /// How the surface runs from row to row.
    pub v_slopes: VSlopes,
    /// Turns rows round, and moves the first point of closed ones, where that brings them nearer to the row before.
    pub align: bool,
    /// Looks for fewer knots along v than rows.
    pub approximate_v: bool,
    /// Places between two data at which a control curve is checked too; 0 checks at the data only, as the paper does.
    pub extra_checks: usize,
    /// Inserts a knot into every span that needs one in each pass: fewer passes, some more control points.
    pub batch: bool,
    /// Takes knots out again that turn out not to be needed.
    pub removal: bool,
    /// Bounds the distance from the skin through the section curves.
    pub certify: bool,
    /// Counts the control points of [`SkinMethod::CommonKnots`] for the report.
    pub compare: bool,
}

impl Default for SkinOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            method: SkinMethod::default(),
            closed: false,
            ends: SectionEnds::default(),
            closed_v: false,
            begin_tangents: None,
            end_tangents: None,
            v_rule: VRule::default(),
            v_slopes: VSlopes::default(),
            align: false,
            approximate_v: false,
            extra_checks: 3,
            batch: false,
            removal: false,
            certify: false,
            compare: false,
        }
    }
}

impl<'a> SkinOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_method method: SkinMethod,
        with_closed closed: bool,
        with_ends ends: SectionEnds<'a>,
        with_closed_v closed_v: bool,
        with_begin_tangents begin_tangents: Option<&'a [f64]>,
        with_end_tangents end_tangents: Option<&'a [f64]>,
        with_v_rule v_rule: VRule,
        with_v_slopes v_slopes: VSlopes,
        with_align align: bool,
        with_approximate_v approximate_v: bool,
        with_extra_checks extra_checks: usize,
        with_batch batch: bool,
        with_removal removal: bool,
        with_certify certify: bool,
        with_compare compare: bool,
    }
}
