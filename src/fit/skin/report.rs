//! What a skin says of itself beside the report of every fit.

/// What a skin did. Lengths are in model units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SkinReport {
    /// Control curves of the surface.
    pub curve_count: usize,
    /// Control points of the shortest control curve.
    pub least_count: usize,
    /// Control points of the longest control curve.
    pub largest_count: usize,
    /// Control points of the same surface as a tensor surface, over the knots of all curves.
    pub tensor_count: usize,
    /// Control points of the same surface in strips, one for each span of v, over the knots of four curves each.
    pub strip_count: usize,
    /// Control points of the skin over common knots; 0 unless asked for.
    pub common_count: usize,
    /// Knots that the removal pass took out.
    pub removed_knot_count: usize,
    /// Points that lay on the one before them.
    pub merged_point_count: usize,
    /// Rows that were turned round or given another first point.
    pub aligned_row_count: usize,
    /// The first row that looks reversed or shifted against the one before it; None if there is none.
    pub twisted_row: Option<usize>,
    /// By how much control curves may be larger than the rows: the norm of the matrix from rows to curves, 1 at
    /// least. Equal steps give 3 at most; rows much nearer to one another than to the next make it large.
    pub overshoot: f64,
    /// A bound of the distance between the surface and the skin through the section curves at any parameter; NaN
    /// unless asked for, or if a section is no cubic.
    pub certified_distance: f64,
    /// The part of the error that fewer knots along v leave; 0 with a knot for each row.
    pub v_error: f64,
}
