//! Rows of points on a mesh: level curves of a harmonic field between two sources.
//!
//! The field is 0 on one source and 1 on the other, a boundary loop or a node each, and in every other node the
//! weighted mean of its neighbours. Weights are the cotangents of U. Pinkall and K. Polthier, "Computing discrete minimal
//! surfaces and their conjugates" (1993), held positive, so that the field has no extrema but its sources (maximum
//! principle). On a mesh of genus 0 whose only loops are sources each level is then one closed curve; anything else is
//! refused, with the level and what was found there.
//!
//! All rows start on one seam that follows the gradient from source to source, and run the same way.

use crate::control::{Cancelled, Control};
use crate::linalg::{NotPositiveDefinite, SymbolicCholesky};
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec3;
use sprs::TriMat;

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

impl SampleRowsError {
    /// The class of the error.
    pub fn kind(&self) -> crate::ErrorKind {
        use crate::ErrorKind;
        match self {
            Self::Option { .. } | Self::SameSource { .. } => ErrorKind::InvalidArgument,
            Self::NoSuch { .. } => ErrorKind::Index,
            Self::Pieces { .. } | Self::Curves { .. } => ErrorKind::Topology,
            Self::Field(_) => ErrorKind::Singular,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending source, node or row.
    pub fn index(&self) -> Option<usize> {
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

/// Cotangents are kept in this range. The lower end keeps the maximum principle; it must not be so small that rounding
/// makes flat places of the field, nor so large that obtuse triangles bend it. The upper end keeps needles finite.
const COTANGENTS: (f64, f64) = (1e-2, 1e3);

/// The field that is 0 on the first source and 1 on the second.
fn harmonic(mesh: &Mesh, sources: &[Vec<u32>; 2]) -> Result<Vec<f64>, SampleRowsError> {
    let mut field = vec![f64::NAN; mesh.points().len()];
    for (value, source) in [0.0, 1.0].into_iter().zip(sources) {
        for &node in source {
            if !field[node as usize].is_nan() && field[node as usize] != value {
                return Err(SampleRowsError::SameSource { node });
            }
            field[node as usize] = value;
        }
    }
    let mut unknown = vec![usize::MAX; field.len()];
    let mut count = 0;
    for node in 0..field.len() {
        if field[node].is_nan() && mesh.is_used(node as u32) {
            unknown[node] = count;
            count += 1;
        }
    }
    let mut lower = TriMat::new((count, count));
    let mut right = vec![0.0; count];
    for (edge, nodes) in half_edges(mesh) {
        let weight = cotangent(mesh, edge);
        for [node, other] in [nodes, [nodes[1], nodes[0]]] {
            let (row, column) = (unknown[node as usize], unknown[other as usize]);
            if row == usize::MAX {
                continue;
            }
            lower.add_triplet(row, row, weight);
            match column {
                usize::MAX => right[row] += weight * field[other as usize],
                _ if row > column => lower.add_triplet(row, column, -weight),
                _ => {}
            }
        }
    }
    let lower: sprs::CsMat<f64> = lower.to_csc();
    let symbolic = SymbolicCholesky::new(&lower.view(), None);
    symbolic.factor(&lower.view())?.solve(&mut right, 1);
    for (value, &unknown) in field.iter_mut().zip(&unknown).filter(|(_, unknown)| **unknown != usize::MAX) {
        *value = right[unknown].clamp(0.0, 1.0);
    }
    Ok(field)
}

/// Of the angle opposite to a half-edge.
fn cotangent(mesh: &Mesh, edge: HalfEdge) -> f64 {
    let at = |edge: HalfEdge| mesh.points()[edge.origin(mesh.triangles()) as usize];
    let apex = at(edge.previous());
    let (a, b) = (at(edge) - apex, at(edge.next()) - apex);
    let cotangent = a.dot(b) / a.cross(b).length();
    if cotangent.is_nan() { COTANGENTS.0 } else { cotangent.clamp(COTANGENTS.0, COTANGENTS.1) }
}

/// Levels between which, and beside the outer ones half as much, the area of the mesh is the same. The area of a
/// triangle counts as spread evenly over the values that it has.
fn levels_of_equal_area(mesh: &Mesh, field: &[f64], count: usize) -> Vec<f64> {
    // where the area per value changes, and by how much
    let mut changes = Vec::with_capacity(2 * mesh.triangles().len());
    for nodes in mesh.triangles() {
        let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
        let values = nodes.map(|node| field[node as usize]);
        let (least, most) =
            (values.iter().copied().fold(1.0, f64::min), values.iter().copied().fold(0.0, f64::max));
        if most > least {
            let density = (b - a).cross(c - a).length() / (most - least);
            changes.extend([(least, density), (most, -density)]);
        }
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    // values, and the area below them
    let (mut density, mut below) = (0.0, vec![(0.0, 0.0)]);
    for (value, change) in changes {
        let (from, area) = below[below.len() - 1];
        below.push((value, area + density * (value - from)));
        density += change;
    }
    let whole = below[below.len() - 1].1;
    let level = |row: usize| {
        let wanted = (row as f64 + 0.5) / count as f64 * whole;
        let k = below.partition_point(|&(_, area)| area < wanted).clamp(1, below.len() - 1);
        let ((from, less), (to, more)) = (below[k - 1], below[k]);
        from + (to - from) * if more > less { (wanted - less) / (more - less) } else { 0.0 }
    };
    (0..count).map(level).collect()
}

/// The curve of a level, with lower values on its left; or how many closed and open curves there are instead.
fn level_curve(mesh: &Mesh, field: &[f64], level: f64) -> Result<Vec<DVec3>, (usize, usize)> {
    let triangles = mesh.triangles();
    let is_low = |node: u32| field[node as usize] < level;
    let mut rising: Vec<HalfEdge> = half_edges(mesh)
        .filter(|&(_, [from, to])| is_low(from) && !is_low(to))
        .map(|(edge, _)| edge)
        .collect();
    // a triangle that the level crosses has one side that rises to it and one that falls
    let falling = |mut edge: HalfEdge| {
        while is_low(edge.origin(triangles)) || !is_low(edge.target(triangles)) {
            edge = edge.next();
        }
        edge
    };
    let mut is_seen = vec![false; triangles.len()];
    // curves that end at the boundary begin there: they are walked first
    rising.sort_by_key(|&edge| mesh.topology().twin(edge).is_some());
    let (mut curve, mut closed, mut open) = (Vec::new(), 0, 0);
    for start in rising {
        if is_seen[start.triangle()] {
            continue;
        }
        let mut edge = start;
        let mut points = Vec::new();
        let is_closed = loop {
            is_seen[edge.triangle()] = true;
            points.push(crossing(mesh, field, level, edge));
            match mesh.topology().twin(falling(edge)) {
                None => break false,
                Some(next) if next == start => break true,
                Some(next) => edge = next,
            }
        };
        (closed, open) = if is_closed { (closed + 1, open) } else { (closed, open + 1) };
        curve = points;
    }
    if (closed, open) == (1, 0) { Ok(curve) } else { Err((closed, open)) }
}

/// Where the level crosses a half-edge.
fn crossing(mesh: &Mesh, field: &[f64], level: f64, edge: HalfEdge) -> DVec3 {
    let [a, b] = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())].map(|node| node as usize);
    let share = (level - field[a]) / (field[b] - field[a]);
    mesh.points()[a].lerp(mesh.points()[b], share.clamp(0.0, 1.0))
}

/// Where a seam has got to.
#[derive(Debug, Clone, Copy)]
enum Place {
    Node(u32),
    /// On a side of the triangle to be crossed next.
    Side(HalfEdge, DVec3),
}

/// A line along the gradient from a node of the first source to the second, with the field on it, which rises.
fn seam(mesh: &Mesh, field: &[f64], start: u32) -> Vec<(f64, DVec3)> {
    let mut line = vec![(field[start as usize], mesh.points()[start as usize])];
    let mut place = Place::Node(start);
    // the field rises with each step, so that the line ends; rounding may let it stand
    while let Some((value, point, next)) = ascend(mesh, field, place) {
        if value <= line[line.len() - 1].0 {
            let Place::Side(edge, _) = place else { break };
            // it stands on a side: on to its higher end
            let ends = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            let higher = if field[ends[0] as usize] > field[ends[1] as usize] { ends[0] } else { ends[1] };
            if field[higher as usize] <= line[line.len() - 1].0 {
                break;
            }
            line.push((field[higher as usize], mesh.points()[higher as usize]));
            place = Place::Node(higher);
            continue;
        }
        line.push((value, point));
        place = next;
    }
    line
}

/// The next place along the gradient, with the field and the point there; None at the second source.
fn ascend(mesh: &Mesh, field: &[f64], place: Place) -> Option<(f64, DVec3, Place)> {
    let value = |node: u32| field[node as usize];
    let at_node = |node: u32| (value(node), mesh.points()[node as usize], Place::Node(node));
    match place {
        Place::Side(edge, point) => {
            let ends = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            let higher = if value(ends[0]) > value(ends[1]) { ends[0] } else { ends[1] };
            let across = [edge.next(), edge.previous()].into_iter();
            Some(across.filter_map(|side| leave(mesh, field, point, side)).next().unwrap_or(at_node(higher)))
        }
        Place::Node(node) => {
            let point = mesh.points()[node as usize];
            let through = mesh.outgoing(node).filter_map(|edge| {
                let slope = gradient(mesh, field, edge.triangle()).length();
                leave(mesh, field, point, edge.next()).map(|step| (slope, step))
            });
            let along = mesh.neighbours(node).filter(|&other| value(other) > value(node)).map(|other| {
                let slope = (value(other) - value(node)) / mesh.points()[other as usize].distance(point);
                (slope, at_node(other))
            });
            let steepest = through.chain(along).max_by(|a, b| a.0.total_cmp(&b.0));
            steepest.map(|(_, step)| step)
        }
    }
}

/// Of the field in a triangle; zero where that has no area.
fn gradient(mesh: &Mesh, field: &[f64], triangle: usize) -> DVec3 {
    let nodes = mesh.triangles()[triangle];
    let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
    let [fa, fb, fc] = nodes.map(|node| field[node as usize]);
    let normal = (b - a).cross(c - a);
    let size = normal.length_squared();
    if size == 0.0 {
        return DVec3::ZERO;
    }
    normal.cross((c - b) * fa + (a - c) * fb + (b - a) * fc) / size
}

/// Where a line along the gradient from `point` on the rim of a triangle leaves it through `side`, if it does.
fn leave(mesh: &Mesh, field: &[f64], point: DVec3, side: HalfEdge) -> Option<(f64, DVec3, Place)> {
    let triangles = mesh.triangles();
    let [from, to] = [side.origin(triangles), side.target(triangles)];
    let [a, b] = [from, to].map(|node| mesh.points()[node as usize]);
    let gradient = gradient(mesh, field, side.triangle());
    let along = b - a;
    // point + s gradient = a + x along, in the triangle's plane
    let normal = gradient.cross(along);
    let size = normal.length_squared();
    let s = (a - point).cross(along).dot(normal) / size;
    let x = (a - point).cross(gradient).dot(normal) / size;
    if !(s > 0.0 && (0.0..=1.0).contains(&x)) {
        return None;
    }
    let value = field[from as usize] + x * (field[to as usize] - field[from as usize]);
    let next = match mesh.topology().twin(side) {
        Some(twin) => Place::Side(twin, a + x * along),
        None => Place::Node(if field[from as usize] > field[to as usize] { from } else { to }),
    };
    Some((value, a + x * along, next))
}

/// Where the seam has a level.
fn seam_point(seam: &[(f64, DVec3)], level: f64) -> DVec3 {
    let k = seam.partition_point(|&(value, _)| value < level).clamp(1, seam.len().max(2) - 1);
    let Some(&(to, b)) = seam.get(k) else { return seam[0].1 };
    let (from, a) = seam[k - 1];
    a.lerp(b, ((level - from) / (to - from)).clamp(0.0, 1.0))
}

/// Fewest points of a row: enough for a round one to be recognized.
const LEAST_POINTS: usize = 8;

/// Points about `spacing` apart along a closed polyline, evenly, the first of them next to `start`.
fn resample(curve: &[DVec3], start: DVec3, spacing: f64) -> Vec<DVec3> {
    let sides = || curve.iter().copied().zip(curve.iter().copied().cycle().skip(1));
    let mut ends = vec![0.0];
    sides().for_each(|(a, b)| ends.push(ends[ends.len() - 1] + a.distance(b)));
    let whole = ends[curve.len()];
    let nearest = sides().enumerate().map(|(k, (a, b))| {
        let along = b - a;
        let x = ((start - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let x = if x.is_nan() { 0.0 } else { x };
        (a.lerp(b, x).distance(start), ends[k] + x * (ends[k + 1] - ends[k]))
    });
    let first = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, at)| at);
    let count = ((whole / spacing).round() as usize).max(LEAST_POINTS);
    let point = |k: usize| {
        let at = (first + whole * k as f64 / count as f64) % whole;
        let side = ends.partition_point(|&end| end <= at).clamp(1, curve.len()) - 1;
        let length = ends[side + 1] - ends[side];
        let x = if length > 0.0 { (at - ends[side]) / length } else { 0.0 };
        curve[side].lerp(curve[(side + 1) % curve.len()], x)
    };
    (0..count).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tube of uneven triangles round the z axis, open at both ends, or closed by a node at the upper one.
    fn tube(is_capped: bool) -> Mesh {
        let (around, along) = (40_u32, 30_u32);
        let mut points = Vec::new();
        for j in 0..=along {
            for k in 0..around {
                let (z, angle) =
                    (f64::from(j) / 10.0, (f64::from(k) + 0.3 * f64::from(j)) / 40.0 * std::f64::consts::TAU);
                let radius = 1.0 + 0.2 * (2.0 * z).sin();
                points.push(DVec3::new(radius * angle.cos(), radius * angle.sin(), z));
            }
        }
        let node = |j: u32, k: u32| j * around + k % around;
        let mut triangles = Vec::new();
        for (j, k) in (0..along).flat_map(|j| (0..around).map(move |k| (j, k))) {
            triangles.push([node(j, k), node(j, k + 1), node(j + 1, k + 1)]);
            triangles.push([node(j, k), node(j + 1, k + 1), node(j + 1, k)]);
        }
        if is_capped {
            points.push(DVec3::new(0.0, 0.0, 3.3));
            triangles
                .extend((0..around).map(|k| [node(along, k), node(along, k + 1), points.len() as u32 - 1]));
        }
        Mesh::new(points, triangles).unwrap()
    }

    fn sample(
        mesh: &Mesh,
        begin: Source,
        end: Source,
        row_count: usize,
    ) -> Result<SampledRows, SampleRowsError> {
        let options = SampleRowsOptions { begin, end, row_count, spacing: 0.0 };
        sample_rows(mesh, &options, &mut Control::new(1))
    }

    fn rows(sampled: &SampledRows) -> Vec<&[DVec3]> {
        let mut rest = &sampled.points[..];
        sampled.counts.iter().map(|&count| rest.split_off(..count).unwrap()).collect()
    }

    #[test]
    fn rows_of_a_tube_go_round_it_in_order() {
        for is_capped in [false, true] {
            let mesh = tube(is_capped);
            // the loop whose nodes come first is the lower one
            let lower = mesh.loops().iter().position(|nodes| nodes.contains(&0)).unwrap();
            let end = if is_capped {
                Source::Node(mesh.points().len() as u32 - 1)
            } else {
                Source::Loop(1 - lower)
            };
            let sampled = sample(&mesh, Source::Loop(lower), end, 12).unwrap();
            let rows = rows(&sampled);
            assert_eq!(rows.len(), 12);
            let mut height = 0.0;
            let mut before: Option<DVec3> = None;
            for row in rows {
                let mean = row.iter().sum::<DVec3>() / row.len() as f64;
                assert!(mean.z > height, "rows rise");
                height = mean.z;
                // round the axis once, the same way: the area seen from above has one sign
                let area: f64 = row.iter().zip(row.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b).z).sum();
                assert!(area.abs() > 1e-3);
                assert!(
                    before.is_none_or(|before| before.x * row[0].x + before.y * row[0].y > 0.0),
                    "one seam"
                );
                before = Some(row[0]);
                let steps: Vec<f64> = row.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
                let longest = steps.iter().copied().fold(0.0, f64::max);
                assert!(longest <= 1.01 * (steps.iter().sum::<f64>() / steps.len() as f64) + 0.02, "even");
            }
        }
    }

    #[test]
    fn what_gives_no_rows_is_refused_by_name() {
        let mesh = tube(false);
        let first = Source::Loop(0);
        let refuse = |begin, end, rows| sample(&mesh, begin, end, rows).unwrap_err();
        assert!(matches!(
            refuse(first, Source::Loop(2), 3),
            SampleRowsError::NoSuch { index: 2, count: 2, .. }
        ));
        assert!(matches!(refuse(first, Source::Node(9999), 3), SampleRowsError::NoSuch { index: 9999, .. }));
        let shared = mesh.loops()[0][5];
        assert_eq!(refuse(first, Source::Node(shared), 3), SampleRowsError::SameSource { node: shared });
        assert!(matches!(
            refuse(first, Source::Loop(1), 0),
            SampleRowsError::Option { option: "row_count", .. }
        ));
        // between two nodes of an open tube levels end at its loops
        let error = refuse(Source::Node(410), Source::Node(430), 4);
        assert!(matches!(error, SampleRowsError::Curves { row: 0.., .. }), "{error}");
        assert_eq!(error.kind(), crate::ErrorKind::Topology);
    }
}
