//! Rows of points on a mesh: level curves of a harmonic field between two sources.
//!
//! The field is 0 on one source and 1 on the other, a boundary loop or a node each, and has no extrema but these. On a mesh of genus 0 whose only loops are sources each level is then one closed curve; anything else is
//! refused, with the level and what was found there.
//!
//! All rows start on one seam that follows the gradient from source to source, and run the same way.

mod curve;
mod field;
mod seam;
#[cfg(test)]
mod tests;

use crate::control::{Cancelled, Control};
use crate::failure::{Classify, ErrorKind};
use crate::linalg::NotPositiveDefinite;
use crate::mesh::{HalfEdge, Mesh};
use crate::options::with_fields;
use curve::{level_curve, resample};
use field::{harmonic, levels_of_equal_area};
use glam::DVec3;
use seam::{seam, seam_point};

/// Where the field is 0, or 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// A boundary loop.
    Loop(usize),
    /// A node.
    Node(u32),
}

/// What rows to take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleRowsOptions {
    /// Where the first row is nearest to.
    pub begin: Source,
    /// Where the last row is nearest to.
    pub end: Source,
    /// How many rows; the area of the mesh between two rows is the same everywhere.
    pub row_count: usize,
    /// About how far apart points are along a row; 0 takes the mean length of the mesh's edges.
    pub spacing: f64,
}

impl SampleRowsOptions {
    with_fields! {
        with_begin begin: Source,
        with_end end: Source,
        with_row_count row_count: usize,
        with_spacing spacing: f64,
    }
}

/// Closed rows; no first point is repeated.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SampledRows {
    /// Row after row.
    pub points: Vec<DVec3>,
    /// Points of each row.
    pub counts: Vec<usize>,
}

/// Rows cannot be taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SampleRowsError {
    /// An option is out of its range.
    #[error("{option} is {value}, it must be {range}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// There is no such loop or node.
    #[error("{source_kind} {index} does not exist, there are {count}")]
    NoSuch {
        /// Loop or node.
        source_kind: &'static str,
        /// The one asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Both sources are one.
    #[error("both sources share node {node}")]
    SameSource {
        /// A node of both.
        node: u32,
    },
    /// A field spreads over one piece only.
    #[error("the mesh has {count} pieces, rows are taken on one")]
    Pieces {
        /// Pieces of the mesh.
        count: usize,
    },
    /// A level is not one closed curve.
    #[error("row {row} would be {closed} closed and {open} open curves, it must be one closed curve")]
    Curves {
        /// The row.
        row: usize,
        /// Closed curves of the level.
        closed: usize,
        /// Curves that end at the boundary.
        open: usize,
    },
    /// Triangles are so thin that the field is lost in rounding.
    #[error("the field cannot be computed: {0}")]
    Field(#[from] NotPositiveDefinite),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for SampleRowsError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Option { .. } | Self::SameSource { .. } => ErrorKind::InvalidArgument,
            Self::NoSuch { .. } => ErrorKind::Index,
            Self::Pieces { .. } | Self::Curves { .. } => ErrorKind::Topology,
            Self::Field(_) => ErrorKind::Singular,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending source, node or row.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NoSuch { index, .. } => Some(index),
            Self::SameSource { node } => Some(node as usize),
            Self::Curves { row, .. } => Some(row),
            _ => None,
        }
    }
}

/// Takes rows.
pub fn sample_rows(
    mesh: &Mesh,
    options: &SampleRowsOptions,
    control: &mut Control,
) -> Result<SampledRows, SampleRowsError> {
    let spacing = check(mesh, options)?;
    let sources = [nodes(mesh, options.begin)?, nodes(mesh, options.end)?];
    control.report(0.0, f64::NAN)?;
    let field = harmonic(mesh, &sources)?;
    let levels = levels_of_equal_area(mesh, &field, options.row_count);
    let seam = seam(mesh, &field, sources[0][0]);
    let mut rows = SampledRows::default();
    for (row, &level) in levels.iter().enumerate() {
        control.report((row + 1) as f64 / (options.row_count + 1) as f64, f64::NAN)?;
        let curve = level_curve(mesh, &field, level).map_err(|(closed, open)| SampleRowsError::Curves {
            row,
            closed,
            open,
        })?;
        let points = resample(&curve, seam_point(&seam, level), spacing);
        rows.counts.push(points.len());
        rows.points.extend(points);
    }
    Ok(rows)
}

/// Most rows that may be asked for.
const MOST_ROWS: usize = 1_000_000;

/// Returns the spacing along the rows.
fn check(mesh: &Mesh, options: &SampleRowsOptions) -> Result<f64, SampleRowsError> {
    let (rows, spacing) = (options.row_count, options.spacing);
    if !(1..=MOST_ROWS).contains(&rows) {
        let range = "between 1 and 1000000";
        return Err(SampleRowsError::Option { option: "row_count", value: rows as f64, range });
    }
    if !(spacing >= 0.0 && spacing.is_finite()) {
        let range = "finite and not negative";
        return Err(SampleRowsError::Option { option: "spacing", value: spacing, range });
    }
    if mesh.component_count() != 1 {
        return Err(SampleRowsError::Pieces { count: mesh.component_count() });
    }
    let lengths = half_edges(mesh)
        .map(|(_, [from, to])| mesh.points()[from as usize].distance(mesh.points()[to as usize]));
    let mean = lengths.sum::<f64>() / (3 * mesh.triangles().len()) as f64;
    Ok(if spacing > 0.0 { spacing } else { mean })
}

fn nodes(mesh: &Mesh, source: Source) -> Result<Vec<u32>, SampleRowsError> {
    match source {
        Source::Loop(index) => mesh.loops().get(index).cloned().ok_or(SampleRowsError::NoSuch {
            source_kind: "loop",
            index,
            count: mesh.loops().len(),
        }),
        Source::Node(node) if (node as usize) < mesh.points().len() && mesh.is_used(node) => Ok(vec![node]),
        Source::Node(node) => Err(SampleRowsError::NoSuch {
            source_kind: "node",
            index: node as usize,
            count: mesh.points().len(),
        }),
    }
}

/// All half-edges with their nodes.
fn half_edges(mesh: &Mesh) -> impl Iterator<Item = (HalfEdge, [u32; 2])> + '_ {
    let triangles = mesh.triangles();
    let corners = (0..triangles.len()).flat_map(|t| (0..3).map(move |corner| HalfEdge::new(t, corner)));
    corners.map(move |edge| (edge, [edge.origin(triangles), edge.target(triangles)]))
}
