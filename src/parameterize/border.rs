//! Where the boundary loop goes: circle, or square with bulged sides.
//!
//! Nodes are spaced by chord length on each piece. The sides of a square
//! bulge outwards by a parabola, so that the border is strictly convex and triangles between nodes
//! of one side keep a positive area:
//! ```text
//!      .-- ~~~ --.        side point at t in (0,1): displaced by 4 b t (1 - t)
//!     3           2
//!     |           |       corners 0..3 in loop order, counter-clockwise,
//!     0           1       at (0,0), (1,0), (1,1), (0,1)
//!      '-- ___ --'
//! ```

use super::{Border, ParameterizeError, ParameterizeOptions, patch};
use crate::memory::{self, CollectVec};
use crate::mesh::{Mesh, loop_edges};
use glam::{DVec2, DVec3};

/// Corners are wanted this far apart, as a share of the border, before any place will do: below it lies rounding.
const LEAST_APART: f64 = 1e-12;
/// Half the stretch of the loop over which a turn is measured, in loop lengths.
const TURN_REACH: f64 = 0.05;
/// Least distance of two corners in loop lengths; halved until four corners are found.
const CORNER_DISTANCE: f64 = 0.08;
/// Border edges are taken at least this long, in mean edges: coinciding nodes stay apart.
const LEAST_EDGE: f64 = 1e-6;

/// A boundary loop with the spacing of its nodes.
#[derive(Debug, Clone)]
pub(super) struct BorderLine {
    pub kind: Border,
    pub nodes: Vec<u32>,
    /// Length that the edge after each node claims.
    pub lengths: Vec<f64>,
    /// Places of the corners in `nodes`, in loop order; none for a circle or a kept border.
    corners: Option<[usize; 4]>,
    bulge: f64,
    /// Share of the stretch that lengths follow; 0 for a border at rest.
    pub slide: f64,
}

/// The borders to try, the first preferred among equals.
pub(super) fn candidates(
    mesh: &Mesh,
    options: &ParameterizeOptions,
) -> Result<Vec<BorderLine>, ParameterizeError> {
    let outer = &mesh.loops()[patch::outer_loop(mesh).unwrap_or(0)];
    let mut nodes = outer.clone();
    nodes.rotate_left(patch::landmark(mesh, outer));
    let points: Vec<DVec3> = nodes.iter().map(|&node| mesh.points()[node as usize]).collect_vec();
    let lengths = edge_lengths(&points)?;
    let line = |kind, corners, slide| BorderLine {
        kind,
        nodes: nodes.clone(),
        lengths: lengths.clone(),
        corners,
        bulge: options.bulge,
        slide,
    };
    let slide = options.boundary_slide;
    if !matches!(options.border, Border::Auto | Border::Circle | Border::Free | Border::Kept)
        && nodes.len() < 4
    {
        return Err(ParameterizeError::ShortBorder { count: nodes.len() });
    }
    let turns = || Some(corners_by_turns(&points, &lengths));
    let arcs = || Some(corners_by_arc(&lengths));
    Ok(match options.border {
        Border::Auto | Border::Free => {
            let mut lines = vec![line(Border::Circle, None, 0.0)];
            if nodes.len() >= 4 {
                memory::push(&mut lines, line(Border::SquareByTurns, turns(), 0.0));
                memory::push(&mut lines, line(Border::SquareByArc, arcs(), 0.0));
            }
            if slide > 0.0 {
                memory::push(&mut lines, line(Border::Circle, None, slide));
            }
            lines
        }
        Border::Circle => vec![line(Border::Circle, None, slide)],
        Border::SquareByTurns => vec![line(Border::SquareByTurns, turns(), slide)],
        Border::SquareByArc => vec![line(Border::SquareByArc, arcs(), slide)],
        Border::Corners(given) => {
            vec![line(options.border, Some(given_corners(&nodes, given)?), slide)]
        }
        Border::Kept => vec![line(Border::Kept, None, 0.0)],
    })
}

impl BorderLine {
    /// Writes the loop's (u,v); a kept border is there already.
    pub(super) fn place(&self, uv: &mut [DVec2]) {
        match (self.kind, self.corners) {
            (Border::Kept, _) => {}
            (_, Some(corners)) => self.place_square(corners, uv),
            (_, None) => self.place_circle(uv),
        }
    }

    fn place_circle(&self, uv: &mut [DVec2]) {
        for (&node, t) in self.nodes.iter().zip(fractions(&self.lengths)) {
            let (sin, cos) = (std::f64::consts::TAU * t).sin_cos();
            uv[node as usize] = DVec2::new(0.5 + 0.5 * cos, 0.5 + 0.5 * sin);
        }
    }

    fn place_square(&self, corners: [usize; 4], uv: &mut [DVec2]) {
        let count = self.nodes.len();
        let ends = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        for side in 0..4 {
            let (start, next) = (corners[side], corners[(side + 1) % 4]);
            let places: Vec<usize> =
                (0..(next + count - start) % count).map(|k| (start + k) % count).collect_vec();
            let lengths: Vec<f64> = places.iter().map(|&place| self.lengths[place]).collect_vec();
            let along = ends[(side + 1) % 4] - ends[side];
            let outward = DVec2::new(along.y, -along.x);
            for (&place, t) in places.iter().zip(fractions(&lengths)) {
                let sag = 4.0 * self.bulge * t * (1.0 - t);
                uv[self.nodes[place] as usize] = ends[side] + along * t + outward * sag;
            }
        }
    }

    /// Lets the spacing follow the stretch `s` of the nodes (section 3, "sliding the border").
    pub(super) fn slid(&self, s: &[f64], eta: f64) -> Self {
        let mut line = self.clone();
        if self.slide > 0.0 {
            for (length, [a, b]) in line.lengths.iter_mut().zip(loop_edges(&self.nodes)) {
                *length *= (s[a as usize] * s[b as usize]).powf(self.slide * eta / 2.0);
            }
        }
        line
    }
}

/// Where each piece begins, as a fraction of the whole.
fn fractions(lengths: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let total: f64 = lengths.iter().sum();
    lengths.iter().scan(0.0, move |sum, length| {
        let t = *sum / total;
        *sum += length;
        Some(t)
    })
}

fn edge_lengths(points: &[DVec3]) -> Result<Vec<f64>, ParameterizeError> {
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    let lengths: Vec<f64> = ends.map(|(a, b)| a.distance(*b)).collect_vec();
    let total: f64 = lengths.iter().sum();
    if !(total > 0.0 && total.is_finite()) {
        return Err(ParameterizeError::ZeroBorder { count: points.len() });
    }
    let least = LEAST_EDGE * total / points.len() as f64;
    Ok(lengths.into_iter().map(|length| length.max(least)).collect_vec())
}

/// The four sharpest turns, largest first and apart from each other.
fn corners_by_turns(points: &[DVec3], lengths: &[f64]) -> [usize; 4] {
    let at: Vec<f64> = fractions(lengths).collect_vec();
    let turns: Vec<f64> = (0..points.len())
        .map(|i| {
            let before = points[i] - point_at(points, &at, at[i] - TURN_REACH);
            let after = point_at(points, &at, at[i] + TURN_REACH) - points[i];
            before.cross(after).length().atan2(before.dot(after))
        })
        .collect_vec();
    let mut sharpest: Vec<usize> = (0..points.len()).collect_vec();
    sharpest.sort_by(|&i, &j| turns[j].total_cmp(&turns[i])); // stable: the earlier of equals
    let mut distance = CORNER_DISTANCE;
    loop {
        let mut corners: Vec<usize> = memory::with_capacity(4);
        for &i in &sharpest {
            let apart = |&j: &usize| {
                let gap = (at[i] - at[j]).abs();
                i != j && gap.min(1.0 - gap) >= distance
            };
            if corners.len() < 4 && corners.iter().all(apart) {
                memory::push(&mut corners, i);
            }
        }
        corners.sort_unstable();
        if let Ok(corners) = corners.try_into() {
            return corners;
        }
        distance = if distance > LEAST_APART { distance / 2.0 } else { 0.0 };
    }
}

/// The point of the closed polyline at a fraction of its length, which may be out of [0, 1).
fn point_at(points: &[DVec3], at: &[f64], t: f64) -> DVec3 {
    let t = t.rem_euclid(1.0);
    let i = at.partition_point(|&start| start <= t).max(1) - 1;
    let end = at.get(i + 1).copied().unwrap_or(1.0);
    points[i].lerp(points[(i + 1) % points.len()], ((t - at[i]) / (end - at[i])).clamp(0.0, 1.0))
}

/// The nodes nearest to each quarter of the length, kept in order.
fn corners_by_arc(lengths: &[f64]) -> [usize; 4] {
    let at: Vec<f64> = fractions(lengths).collect_vec();
    let mut corners = [0; 4];
    for quarter in 1..4 {
        let target = quarter as f64 / 4.0;
        // leave a node to each corner before and after
        let allowed = corners[quarter - 1] + 1..at.len() - (3 - quarter);
        corners[quarter] = allowed
            .min_by(|&i, &j| (at[i] - target).abs().total_cmp(&(at[j] - target).abs()))
            .unwrap_or(corners[quarter - 1] + 1);
    }
    corners
}

fn given_corners(nodes: &[u32], given: [u32; 4]) -> Result<[usize; 4], ParameterizeError> {
    let mut places = [0; 4];
    for (place, node) in places.iter_mut().zip(given) {
        let found = nodes.iter().position(|&other| other == node);
        *place = found.ok_or(ParameterizeError::Corner { node: node as usize })?;
    }
    // counted from the first corner on, places must increase
    let from_first = places.map(|place| (place + nodes.len() - places[0]) % nodes.len());
    match (1..4).find(|&k| from_first[k] <= from_first[k - 1]) {
        Some(k) => Err(ParameterizeError::Corner { node: given[k] as usize }),
        None => Ok(places),
    }
}
