//! What a model is fitted to: places of the mesh with their parameters on the patches.
//!
//! Nodes count 1. Between them, so that no cell is left to itself: centroids of facets, middles of edges, and a grid
//! on facets much longer than usual. These have their parameters from the facet's corners, over at most two patches that
//! are unfolded into one plane; the few that lie over more are left out. The middle of an edge of a crease lies on the
//! crease too.

use super::locks::{Lock, feature_at, halfway, lock, same_places};
use crate::control::Pool;
use crate::layout::{Layout, NodeMap, Place, cube_place};
use crate::lists::Lists;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::Mesh;
use crate::surface::g1::Space;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// A cell of all patches together.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellPlace {
    pub min: DVec2,
    pub size: f64,
}

/// Where the nodes of a mesh lie on a layout.
#[derive(Debug, Clone, Copy)]
pub enum NodePlaces<'a> {
    /// On the unit sphere, over the cube's layout: no facet is too large.
    Sphere(&'a [DVec3]),
    /// On the patches; None for a node without triangles.
    Patches(&'a [Option<Place>]),
    /// The same as a map, which may know of places between the nodes.
    Map(&'a NodeMap),
}

impl NodePlaces<'_> {
    /// The place that is a mean of nodes; none over more patches than can be unfolded.
    pub(super) fn mean(&self, layout: &Layout, nodes: &[u32], shares: &[f64]) -> Option<Place> {
        match self {
            Self::Sphere(directions) => {
                let direction: DVec3 =
                    nodes.iter().zip(shares).map(|(&node, &share)| share * directions[node as usize]).sum();
                (direction != DVec3::ZERO).then(|| cube_place(direction))
            }
            Self::Patches(places) => mean_place(places, layout, nodes, shares),
            Self::Map(map) => {
                let (nodes, shares) = map.finest(nodes, shares);
                mean_place(map.all_places(), layout, &nodes, &shares)
            }
        }
    }

    /// By node; none on a sphere.
    fn places(&self) -> Option<&[Option<Place>]> {
        match self {
            Self::Sphere(_) => None,
            Self::Patches(places) => Some(places),
            Self::Map(map) => Some(map.places()),
        }
    }

    /// The place and lock halfway along an edge of a crease; none for an edge inside, or over a whole side.
    fn on_crease(&self, layout: &Layout, [a, b]: [u32; 2]) -> Option<(Place, Lock)> {
        let places = self.places()?;
        let [a, b] = [a, b].map(|node| places[node as usize].and_then(|place| feature_at(layout, place)));
        let middle = halfway(layout, a?, b?)?;
        Some((middle.place(), middle.lock()))
    }

    /// The place of a node; none for a node that the map leaves out.
    fn node(&self, node: u32) -> Option<Place> {
        match self {
            Self::Sphere(directions) => {
                Some(directions[node as usize]).filter(|&at| at != DVec3::ZERO).map(cube_place)
            }
            Self::Patches(places) => places[node as usize],
            Self::Map(map) => map.place(node),
        }
    }

    /// Number of nodes.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Sphere(directions) => directions.len(),
            Self::Patches(places) => places.len(),
            Self::Map(map) => map.places().len(),
        }
    }
}

/// The mean of the places of some nodes, in a picture of the patches that they lie on.
fn mean_place(places: &[Option<Place>], layout: &Layout, nodes: &[u32], shares: &[f64]) -> Option<Place> {
    let of_nodes: Option<Vec<Vec<Place>>> =
        nodes.iter().map(|&node| Some(same_places(layout, places[node as usize]?))).collect();
    let of_nodes = of_nodes?;
    let over = |Place { quad, uv: near }: Place| {
        let mut uv = DVec2::ZERO;
        for (same, share) in of_nodes.iter().zip(shares) {
            let unfolded = same.iter().filter_map(|&place| layout.unfold(quad, place, near));
            let distance = |uv: &DVec2| uv.distance_squared(near);
            uv += share * unfolded.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        }
        Some(layout.cross(quad, uv))
    };
    of_nodes.iter().flatten().find_map(|&place| over(place))
}

/// Samples of a mesh; the nodes come first, in their order.
#[derive(Debug, Clone)]
pub(super) struct Samples {
    pub places: Vec<Place>,
    pub points: Vec<DVec3>,
    /// How each may move.
    pub locks: Vec<Lock>,
    /// The normal of the mesh there.
    pub normals: Vec<DVec3>,
    /// How far the shape may lie above the facet there: 0 at nodes.
    pub allowances: Vec<f64>,
    /// The node of each of the first samples.
    pub nodes: Vec<u32>,
    /// Samples left out because their facet lies over too many patches.
    pub dropped: usize,
}

/// Weight of a sample that is no node.
const BETWEEN: f64 = 0.3;
/// What a place on a facet counts beside a node, by how far the shape may lie above it: less where that is more than
/// `known`, the distance to which facets say where the shape is.
pub(super) fn weight_on_facet(sagitta: f64, known: f64) -> f64 {
    let share = (known / sagitta).min(1.0);
    BETWEEN * share * share
}

/// A facet whose longest edge is this many times the median gets a grid.
const LONG: f64 = 3.0;
/// Rows of a grid on one facet, at most.
const MOST_ROWS: usize = 16;

impl Samples {
    /// Samples of all facets; `is_corner` by vertex of the layout.
    pub(super) fn new(
        mesh: &Mesh,
        map: NodePlaces,
        layout: &Layout,
        sagittas: &[f64],
        is_corner: &[bool],
    ) -> Self {
        let (points, triangles) = (mesh.points(), mesh.triangles());
        let nodes = (0..points.len() as u32).filter(|&node| mesh.is_used(node));
        let known =
            nodes.filter_map(|node| Some((node, lock(layout, map.node(node)?, is_corner)))).collect_vec();
        let nodes = known.iter().map(|&(node, _)| node).collect_vec();
        let places = known.iter().map(|&(_, (_, place))| place).collect_vec();
        let locks = known.into_iter().map(|(_, (lock, _))| lock).collect_vec();
        let (of_nodes, of_facets) = (node_normals(mesh), facet_normals(mesh));
        let mut samples = Self {
            places,
            locks,
            points: nodes.iter().map(|&node| points[node as usize]).collect_vec(),
            normals: nodes.iter().map(|&node| of_nodes[node as usize]).collect_vec(),
            allowances: memory::filled(0.0, nodes.len()),
            nodes,
            dropped: 0,
        };
        let facets = || triangles.iter().zip(&of_facets).zip(sagittas);
        for ((triangle, &normal), &sagitta) in facets() {
            let place = map.mean(layout, triangle, &THIRDS).map(|place| (place, Lock::Free));
            samples.add(mesh, place, (triangle, &THIRDS), (normal, sagitta));
        }
        for ((triangle, &normal), &sagitta) in facets() {
            for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|ends| ends.map(|k| triangle[k])) {
                let is_border = mesh.edge_between(b, a).is_none();
                // of both facets at an edge the one that runs upwards, at a border the only one
                if a < b || is_border {
                    let on_crease = is_border.then(|| map.on_crease(layout, [a, b])).flatten();
                    let place = on_crease.or_else(|| Some((map.mean(layout, &[a, b], &HALVES)?, Lock::Free)));
                    samples.add(mesh, place, (&[a, b], &HALVES), (normal, sagitta));
                }
            }
        }
        for (((triangle, &normal), &sagitta), rows) in facets().zip(grid_rows(mesh)) {
            for a in 0..rows {
                for b in 0..rows - a {
                    let share = |k: usize| (k as f64 + 1.0 / 3.0) / rows as f64;
                    let shares = [share(a), share(b), share(rows - 1 - a - b)];
                    let place = map.mean(layout, triangle, &shares).map(|place| (place, Lock::Free));
                    samples.add(mesh, place, (triangle, &shares), (normal, sagitta));
                }
            }
        }
        samples
    }

    fn add(
        &mut self,
        mesh: &Mesh,
        place: Option<(Place, Lock)>,
        (nodes, shares): (&[u32], &[f64]),
        (normal, sagitta): (DVec3, f64),
    ) {
        let Some((place, lock)) = place else {
            self.dropped += 1;
            return;
        };
        let terms = nodes.iter().zip(shares);
        let point = terms.map(|(&node, &share)| share * mesh.points()[node as usize]).sum();
        memory::push(&mut self.points, point);
        memory::push(&mut self.places, place);
        memory::push(&mut self.locks, lock);
        memory::push(&mut self.normals, normal);
        memory::push(&mut self.allowances, sagitta);
    }

    /// What a sample counts beside a node.
    pub(super) fn weight(&self, sample: usize, known: f64) -> f64 {
        if sample < self.nodes.len() {
            self.locks[sample].weight()
        } else {
            weight_on_facet(self.allowances[sample], known)
        }
    }
}

/// Shares of the nodes in the middle of a facet.
const THIRDS: [f64; 3] = [1.0 / 3.0; 3];
/// The same for an edge.
const HALVES: [f64; 2] = [0.5; 2];

/// The normal of each facet, of length 1.
pub(super) fn facet_normals(mesh: &Mesh) -> Vec<DVec3> {
    areas(mesh).map(DVec3::normalize_or_zero).collect_vec()
}

/// The normal of each node, the mean of its facets'.
fn node_normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = memory::filled(DVec3::ZERO, mesh.points().len());
    for (triangle, area) in mesh.triangles().iter().zip(areas(mesh)) {
        triangle.iter().for_each(|&node| sums[node as usize] += area);
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect_vec()
}

fn areas(mesh: &Mesh) -> impl Iterator<Item = DVec3> + '_ {
    mesh.triangles().iter().map(|triangle| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a)
    })
}

/// Rows of the grid on each facet; 0 for a facet of usual size.
fn grid_rows(mesh: &Mesh) -> Vec<usize> {
    let longest: Vec<f64> = mesh
        .triangles()
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
            a.distance(b).max(b.distance(c)).max(c.distance(a))
        })
        .collect_vec();
    let mut sorted = memory::copied(&longest);
    let middle = sorted.len() / 2;
    if sorted.is_empty() {
        return Vec::new();
    }
    let median = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
    let rows = |length: &f64| {
        let times = (length / median).ceil();
        if times >= LONG { (times as usize).min(MOST_ROWS) } else { 0 }
    };
    longest.iter().map(rows).collect_vec()
}

/// Samples sorted by the cells of all patches.
#[derive(Debug)]
pub(super) struct ByCell(Lists);

impl ByCell {
    /// Sorts places by the cells of a space, patch after patch and leaf after leaf.
    pub(super) fn sort(space: &Space, places: &[Place], pool: &Pool) -> Self {
        let mut first_cells = vec![0];
        for topology in space.topologies() {
            first_cells.push(first_cells[first_cells.len() - 1] + topology.leaves.len() as u32);
        }
        let cell = |place: &Place| {
            let quad = place.quad as usize;
            let leaf = space.topologies()[quad].leaf_of(space.meshes()[quad].locate(place.uv));
            first_cells[quad] + leaf as u32
        };
        let cells: Vec<u32> = pool.run(|| places.par_iter().with_min_len(4096).map(cell).collect_vec());
        Self(Lists::by_key(first_cells[first_cells.len() - 1] as usize, &cells))
    }

    /// The samples of a cell.
    pub(super) fn of(&self, cell: usize) -> &[u32] {
        self.0.of(cell)
    }

    /// Number of cells.
    pub(super) fn cell_count(&self) -> usize {
        self.0.count()
    }
}

/// The quad of each cell, and where the cell lies on it.
pub(super) fn quads_of_cells(space: &Space) -> Vec<u32> {
    let counts = space.topologies().iter().map(|topology| topology.leaves.len());
    (0..).zip(counts).flat_map(|(quad, count)| std::iter::repeat_n(quad, count)).collect_vec()
}

/// Cells with fewer samples get places of their own.
const ENOUGH: usize = 9;
/// Places along a side of such a cell.
const GUARDS: usize = 3;

/// Places in cells with too few samples, three times three a cell.
pub(super) fn guard_places(quads: &[u32], cells: &[CellPlace], by_cell: &ByCell) -> Vec<Place> {
    let mut places = Vec::new();
    for (number, (&quad, cell)) in quads.iter().zip(cells).enumerate() {
        if by_cell.of(number).len() < ENOUGH {
            for k in 0..GUARDS * GUARDS {
                let at = DVec2::new((k / GUARDS) as f64, (k % GUARDS) as f64) + 0.5;
                memory::push(&mut places, Place { quad, uv: cell.min + cell.size / GUARDS as f64 * at });
            }
        }
    }
    places
}
