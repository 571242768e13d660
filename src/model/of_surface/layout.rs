//! The edges and faces of a shell in the parameter plane.
//!
//! ```text
//!   +-------------+-------+       Trims cut into pieces at the sides of the rectangles, and the parts of those
//!   |      .------+---.   |       sides inside the trims, are the edges. An edge has a face on its left, and one
//!   |     /   A   | B  \  |       on its right if it is part of a side: the faces share it. Edges with the same
//!   |    |        +-----|-+       rectangle beside them close to the bounds of its faces, always turning left as
//!   +----+---.____|_C__/  |       sharply as there is a way.
//!   +-------------+-------+
//! ```

use super::loops::contains;
use super::tiling::{Line, Tiling};
use crate::surface::Trims;
use glam::DVec2;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// An edge in the parameter plane.
#[derive(Debug)]
pub(super) struct PlaneEdge {
    pub polyline: Vec<DVec2>,
    /// Numbers of the points at its ends.
    pub ends: [usize; 2],
    /// The rectangle on its left.
    pub left: usize,
    /// The rectangle on its right, if the surface goes on there.
    pub right: Option<usize>,
    /// The trim that it is a part of.
    pub trim: Option<usize>,
}

/// An edge as one of the sides of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Side {
    pub edge: usize,
    /// Whether the face lies on the left of the edge.
    pub is_forward: bool,
}

/// A piece of a rectangle.
#[derive(Debug)]
pub(super) struct PlaneFace {
    pub rectangle: usize,
    /// The outer one first.
    pub bounds: Vec<Vec<Side>>,
}

/// All edges and faces.
#[derive(Debug)]
pub(super) struct Layout {
    pub edges: Vec<PlaneEdge>,
    pub faces: Vec<PlaneFace>,
}

/// A closed polyline with points on all lines that it meets, and for each of its sides the rectangle on the left.
#[derive(Debug)]
pub(super) struct Trim {
    pub points: Vec<DVec2>,
    pub left: Vec<usize>,
}

/// Numbers for points, by their bits.
#[derive(Default)]
struct Nodes(BTreeMap<[u64; 2], usize>);

impl Nodes {
    fn number(&mut self, p: DVec2) -> usize {
        let next = self.0.len();
        // adding 0 turns -0 into 0
        *self.0.entry([p.x + 0.0, p.y + 0.0].map(f64::to_bits)).or_insert(next)
    }
}

/// Closed polylines, the surface on their left, as cut by the lines.
pub(super) fn cut(loops: &[Vec<DVec2>], tiling: &Tiling) -> Vec<Trim> {
    let trim = |polyline: &Vec<DVec2>| {
        let points = tiling.cut(polyline);
        let left = (0..points.len()).map(|k| left_of(tiling, points[k], points[(k + 1) % points.len()]));
        Trim { left: left.collect(), points }
    };
    loops.iter().map(trim).collect()
}

/// The rectangle on the left of a side that crosses no line.
fn left_of(tiling: &Tiling, a: DVec2, b: DVec2) -> usize {
    tiling.beside(0.5 * (a + b), (b - a).perp()).expect("rectangles fill the domain, trims lie in it")
}

impl Layout {
    /// Trims as [`cut`] makes them; `starts` are the points of each at which edges have to begin.
    pub(super) fn new(tiling: &Tiling, trims: &[Trim], starts: &[Vec<usize>]) -> Self {
        let mut nodes = Nodes::default();
        let sides = side_edges(tiling, trims, &mut nodes);
        let ends: BTreeSet<usize> = sides.iter().flat_map(|edge| edge.ends).collect();
        let mut edges = Vec::new();
        for (trim, (cut, starts)) in trims.iter().zip(starts).enumerate() {
            edges.extend(trim_edges(trim, cut, starts, &ends, &mut nodes));
        }
        edges.extend(sides);
        let faces = faces(&edges);
        Self { edges, faces }
    }
}

/// The pieces of the lines inside the trims, from each corner or crossing to the next.
fn side_edges(tiling: &Tiling, trims: &[Trim], nodes: &mut Nodes) -> Vec<PlaneEdge> {
    let loops = trims.iter().map(|trim| trim.points.clone()).collect();
    let inside = Trims::new(loops, tiling.domain()).expect("cuts are loops in the domain");
    let along_trims: BTreeSet<[usize; 2]> =
        inside.segments().map(|(a, b)| undirected([nodes.number(a), nodes.number(b)])).collect();
    let mut edges = Vec::new();
    for axis in [0, 1] {
        let mut marks: Vec<Vec<f64>> = tiling.lines(axis).iter().map(|line| line.corners.clone()).collect();
        for &p in trims.iter().flat_map(|trim| &trim.points) {
            if let Some(line) = tiling.line_through(axis, p) {
                marks[line].push(p[1 - axis]);
            }
        }
        for (line, mut marks) in tiling.lines(axis).iter().zip(marks) {
            marks.sort_unstable_by(f64::total_cmp);
            marks.dedup();
            for piece in marks.windows(2) {
                let middle = 0.5 * (piece[0] + piece[1]);
                let polyline = [place(axis, line, piece[0]), place(axis, line, piece[1])];
                let ends = polyline.map(|p| nodes.number(p));
                let counts = line.holds(middle, 0.0)
                    && !along_trims.contains(&undirected(ends))
                    && inside.contains(place(axis, line, middle));
                if counts {
                    let [a, b] = polyline;
                    let (left, right) = (left_of(tiling, a, b), Some(left_of(tiling, b, a)));
                    edges.push(PlaneEdge { polyline: polyline.to_vec(), ends, left, right, trim: None });
                }
            }
        }
    }
    edges
}

fn undirected([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn place(axis: usize, line: &Line, along: f64) -> DVec2 {
    if axis == 0 { DVec2::new(line.at, along) } else { DVec2::new(along, line.at) }
}

/// A trim cut where it has to be, where sides of rectangles end on it, and where the rectangle beside it changes.
fn trim_edges(
    index: usize,
    trim: &Trim,
    starts: &[usize],
    ends: &BTreeSet<usize>,
    nodes: &mut Nodes,
) -> Vec<PlaneEdge> {
    let count = trim.points.len();
    let numbers: Vec<usize> = trim.points.iter().map(|&p| nodes.number(p)).collect();
    let is_cut = |k: &usize| {
        starts.contains(k)
            || ends.contains(&numbers[*k])
            || trim.left[(*k + count - 1) % count] != trim.left[*k]
    };
    let cuts: Vec<usize> = (0..count).filter(is_cut).collect();
    let edge = |(k, &from): (usize, &usize)| {
        let to = cuts[(k + 1) % cuts.len()];
        let length = (to + count - from - 1) % count + 1;
        PlaneEdge {
            polyline: (0..=length).map(|step| trim.points[(from + step) % count]).collect(),
            ends: [numbers[from], numbers[to]],
            left: trim.left[from],
            right: None,
            trim: Some(index),
        }
    };
    cuts.iter().enumerate().map(edge).collect()
}

/// The faces in the order of their rectangles.
fn faces(edges: &[PlaneEdge]) -> Vec<PlaneFace> {
    let mut by_rectangle: BTreeMap<usize, Vec<Side>> = BTreeMap::new();
    for (edge, PlaneEdge { left, right, .. }) in edges.iter().enumerate() {
        by_rectangle.entry(*left).or_default().push(Side { edge, is_forward: true });
        if let Some(right) = right {
            by_rectangle.entry(*right).or_default().push(Side { edge, is_forward: false });
        }
    }
    by_rectangle.into_iter().flat_map(|(rectangle, sides)| faces_of(edges, rectangle, sides)).collect()
}

fn faces_of(edges: &[PlaneEdge], rectangle: usize, sides: Vec<Side>) -> Vec<PlaneFace> {
    let bounds = closed(edges, sides);
    let polylines: Vec<Vec<DVec2>> = bounds.iter().map(|bound| polyline(edges, bound)).collect();
    let is_outer: Vec<bool> = polylines.iter().map(|polyline| area(polyline) > 0.0).collect();
    let mut faces: Vec<(usize, PlaneFace)> = Vec::new();
    for (k, bound) in bounds.iter().enumerate().filter(|&(k, _)| is_outer[k]) {
        faces.push((k, PlaneFace { rectangle, bounds: vec![bound.clone()] }));
    }
    for (k, hole) in bounds.into_iter().enumerate().filter(|&(k, _)| !is_outer[k]) {
        let place = 0.5 * (polylines[k][0] + polylines[k][1]);
        // a hole that rounding puts outside of all faces is in the only one, or in the first of several
        let holds = |(outer, _): &(usize, PlaneFace)| contains(&polylines[*outer], place);
        let around = faces.iter().position(holds).unwrap_or(0);
        faces.get_mut(around).into_iter().for_each(|(_, face)| face.bounds.push(hole.clone()));
    }
    faces.into_iter().map(|(_, face)| face).collect()
}

/// Sides that follow one another, face on the left, joined to closed bounds.
fn closed(edges: &[PlaneEdge], sides: Vec<Side>) -> Vec<Vec<Side>> {
    let mut leaving: BTreeMap<usize, Vec<Side>> = BTreeMap::new();
    for &side in &sides {
        leaving.entry(ends(edges, side)[0]).or_default().push(side);
    }
    let mut bounds = Vec::new();
    let mut is_used = BTreeSet::new();
    for first in sides {
        let mut bound = Vec::new();
        let mut side = first;
        while is_used.insert((side.edge, side.is_forward)) {
            bound.push(side);
            let back = -heading(edges, side)[1];
            let onward = |next: &Side| {
                let turn = (back.to_angle() - heading(edges, *next)[0].to_angle()).rem_euclid(TAU);
                if turn == 0.0 { TAU } else { turn }
            };
            let ways = leaving.get(&ends(edges, side)[1]).into_iter().flatten();
            side = match ways.min_by(|a, b| onward(a).total_cmp(&onward(b))) {
                Some(&next) => next,
                None => break,
            };
        }
        if !bound.is_empty() {
            bounds.push(bound);
        }
    }
    bounds
}

fn ends(edges: &[PlaneEdge], side: Side) -> [usize; 2] {
    let [start, end] = edges[side.edge].ends;
    if side.is_forward { [start, end] } else { [end, start] }
}

/// The directions in which a side begins and ends.
fn heading(edges: &[PlaneEdge], side: Side) -> [DVec2; 2] {
    let points = &edges[side.edge].polyline;
    let (first, last) = (points[1] - points[0], points[points.len() - 1] - points[points.len() - 2]);
    if side.is_forward { [first, last] } else { [-last, -first] }
}

fn polyline(edges: &[PlaneEdge], bound: &[Side]) -> Vec<DVec2> {
    let points = |side: &Side| {
        let mut points = edges[side.edge].polyline.clone();
        if !side.is_forward {
            points.reverse();
        }
        points.pop();
        points
    };
    bound.iter().flat_map(points).collect()
}

/// Twice the signed area.
fn area(polyline: &[DVec2]) -> f64 {
    let from = polyline.first().copied().unwrap_or_default();
    let next = polyline.iter().cycle().skip(1);
    polyline.iter().zip(next).map(|(&a, &b)| (a - from).perp_dot(b - from)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Domain;
    use crate::samples::Random;

    /// A square cut into quarters again and again, at random.
    fn quadtree(random: &mut Random, splits: usize) -> Vec<Domain> {
        let mut tiles = vec![Domain { min: DVec2::ZERO, max: DVec2::ONE }];
        for _ in 0..splits {
            let tile = tiles.swap_remove((random.unit() * tiles.len() as f64) as usize);
            let half = 0.5 * tile.size();
            for corner in [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE] {
                let min = tile.min + corner * half;
                tiles.push(Domain { min, max: min + half });
            }
        }
        tiles
    }

    fn star(random: &mut Random, center: DVec2, radius: f64, count: usize) -> Vec<DVec2> {
        let arm = |k| {
            let length = radius * (0.4 + 0.6 * random.unit());
            center + length * DVec2::from_angle(TAU * f64::from(k) / count as f64)
        };
        (0..count as i32).map(arm).collect()
    }

    fn rectangle(min: [f64; 2], max: [f64; 2]) -> Vec<DVec2> {
        [min, [max[0], min[1]], max, [min[0], max[1]]].map(DVec2::from).to_vec()
    }

    fn reversed(mut polyline: Vec<DVec2>) -> Vec<DVec2> {
        polyline.reverse();
        polyline
    }

    /// A shell is a disk with holes: checks its Euler number, that every edge has its faces on the right sides,
    /// and that the faces fill what the trims enclose.
    fn check(tiles: Vec<Domain>, loops: &[Vec<DVec2>]) -> Layout {
        let tiling = Tiling::new(tiles.clone());
        let trims = cut(loops, &tiling);
        let layout = Layout::new(&tiling, &trims, &vec![vec![0, 1]; trims.len()]);
        let mut uses = vec![[0, 0]; layout.edges.len()];
        let mut filled = 0.0;
        for face in &layout.faces {
            for (k, bound) in face.bounds.iter().enumerate() {
                let polyline = polyline(&layout.edges, bound);
                assert_eq!(area(&polyline) > 0.0, k == 0);
                filled += area(&polyline);
                // what rounding leaves of a crossing is far below the size of a rectangle
                let tile = &tiles[face.rectangle];
                assert!(polyline.iter().all(|&p| p.distance(tile.clamp(p)) <= 1e-15), "{tile:?}");
                for (side, next) in bound.iter().zip(bound.iter().cycle().skip(1)) {
                    uses[side.edge][usize::from(side.is_forward)] += 1;
                    assert_eq!(ends(&layout.edges, *side)[1], ends(&layout.edges, *next)[0]);
                }
            }
        }
        for (edge, uses) in layout.edges.iter().zip(uses) {
            assert_eq!(uses, [usize::from(edge.right.is_some()), 1]);
            assert_eq!(edge.right.is_none(), edge.trim.is_some());
        }
        let enclosed: f64 = trims.iter().map(|trim| area(&trim.points)).sum();
        assert!((filled - enclosed).abs() <= 1e-12, "{filled} {enclosed}");
        let nodes: BTreeSet<usize> = layout.edges.iter().flat_map(|edge| edge.ends).collect();
        let faces: i64 = layout.faces.iter().map(|face| 2 - face.bounds.len() as i64).sum();
        assert_eq!(nodes.len() as i64 - layout.edges.len() as i64 + faces, 2 - loops.len() as i64);
        layout
    }

    #[test]
    fn shells_close_whatever_way_trims_run() {
        let mut random = Random::new(12);
        for splits in [0, 1, 5, 20, 60] {
            for _ in 0..20 {
                let tiles = quadtree(&mut random, splits);
                let border = rectangle([0.0, 0.0], [1.0, 1.0]);
                let layout = check(tiles.clone(), std::slice::from_ref(&border));
                assert_eq!(layout.faces.len(), tiles.len());
                let outer = star(&mut random, DVec2::splat(0.5), 0.5, 60);
                let hole = reversed(star(&mut random, DVec2::new(0.5, 0.45), 0.14, 9));
                check(tiles.clone(), &[outer, hole]);
                let small = reversed(star(&mut random, DVec2::new(0.6, 0.71), 1e-3, 5));
                check(tiles, &[border, small]);
            }
        }
    }

    #[test]
    fn trims_may_run_along_sides_and_through_corners() {
        let mut random = Random::new(5);
        for splits in [5, 20, 60] {
            let tiles = quadtree(&mut random, splits);
            // along lines of many rectangles, with corners on them
            check(tiles.clone(), &[rectangle([0.0, 0.25], [0.5, 0.75])]);
            check(
                tiles.clone(),
                &[rectangle([0.0, 0.0], [1.0, 1.0]), reversed(rectangle([0.25, 0.25], [0.5, 0.75]))],
            );
            let diamond = [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]].map(DVec2::from).to_vec();
            check(tiles.clone(), &[diamond]);
            // nearer to lines than any face may be wide
            let near = 0.4 * super::super::CURVE_TOLERANCE;
            let layout = check(tiles.clone(), &[rectangle([near, 0.25 - near], [0.5 + near, 0.75 + near])]);
            let exact = check(tiles, &[rectangle([0.0, 0.25], [0.5, 0.75])]);
            assert_eq!(layout.faces.len(), exact.faces.len());
        }
    }

    #[test]
    fn a_hole_belongs_to_the_piece_around_it() {
        // a comb over two rectangles: each tooth is a face of the upper one, one with a hole
        let tiles = vec![
            Domain { min: DVec2::ZERO, max: DVec2::new(1.0, 0.5) },
            Domain { min: DVec2::new(0.0, 0.5), max: DVec2::ONE },
        ];
        let comb =
            [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.7, 0.9], [0.7, 0.4], [0.3, 0.4], [0.3, 0.9], [0.1, 0.9]];
        let hole = reversed(rectangle([0.75, 0.6], [0.85, 0.8]));
        let layout = check(tiles, &[comb.map(DVec2::from).to_vec(), hole]);
        let bounds: Vec<(usize, usize)> =
            layout.faces.iter().map(|face| (face.rectangle, face.bounds.len())).collect();
        assert_eq!(layout.faces.len(), 3);
        assert_eq!(bounds.iter().filter(|&&face| face == (1, 2)).count(), 1);
        assert_eq!(bounds.iter().filter(|&&face| face == (1, 1)).count(), 1);
    }
}
