//! What a model is fitted to: places of the mesh with their parameters on the patches.
//!
//! Nodes count 1. Between them, so that no cell is left to itself: centroids of facets, middles of edges, and a grid
//! on facets much longer than usual. These have their parameters from the facet's corners, over at most two patches that
//! are unfolded into one plane; the few that lie over more are left out.

use super::least_squares::CellPlace;
use crate::control::Pool;
use crate::layout::{Layout, Place, cube_place};
use crate::lists::Lists;
use crate::mesh::Mesh;
use crate::surface::g1::Space;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Where the nodes of a mesh lie on a layout.
#[derive(Debug, Clone, Copy)]
pub enum NodePlaces<'a> {
    /// On the unit sphere, over the cube's layout: no facet is too large.
    Sphere(&'a [DVec3]),
    /// On the patches; None for a node without triangles.
    Patches(&'a [Option<Place>]),
}

impl NodePlaces<'_> {
    /// The place that is a mean of nodes; none over more patches than can be unfolded.
    fn mean(&self, layout: &Layout, nodes: &[u32], shares: &[f64]) -> Option<Place> {
        match self {
            Self::Sphere(directions) => {
                let direction: DVec3 =
                    nodes.iter().zip(shares).map(|(&node, &share)| share * directions[node as usize]).sum();
                (direction != DVec3::ZERO).then(|| cube_place(direction))
            }
            Self::Patches(places) => {
                let Place { quad, uv: near } = places[nodes[0] as usize]?;
                let mut uv = DVec2::ZERO;
                for (&node, &share) in nodes.iter().zip(shares) {
                    uv += share * layout.unfold(quad, places[node as usize]?, near)?;
                }
                Some(layout.cross(quad, uv))
            }
        }
    }

    /// The place of a node; none for a node that the map leaves out.
    fn node(&self, node: u32) -> Option<Place> {
        match self {
            Self::Sphere(directions) => {
                Some(directions[node as usize]).filter(|&at| at != DVec3::ZERO).map(cube_place)
            }
            Self::Patches(places) => places[node as usize],
        }
    }

    /// Number of nodes.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Sphere(directions) => directions.len(),
            Self::Patches(places) => places.len(),
        }
    }
}

/// Samples of a mesh; the nodes come first, in their order.
#[derive(Debug, Clone)]
pub struct Samples {
    pub places: Vec<Place>,
    pub points: Vec<DVec3>,
    /// How far the shape may lie above the facet there: 0 at nodes.
    pub allowances: Vec<f64>,
    /// The node of each of the first samples.
    pub nodes: Vec<u32>,
    /// Samples left out because their facet lies over too many patches.
    pub dropped: usize,
}

/// Weight of a sample that is no node.
const BETWEEN: f64 = 0.3;
/// What a place on a facet counts beside a node, by how far the shape may lie above it.
pub fn weight_on_facet(sagitta: f64, tolerance: f64) -> f64 {
    let known = (tolerance / sagitta).min(1.0);
    BETWEEN * known * known
}

/// A facet whose longest edge is this many times the median gets a grid.
const LONG: f64 = 3.0;
/// Rows of a grid on one facet, at most.
const MOST_ROWS: usize = 16;

impl Samples {
    /// Samples of all facets.
    pub fn new(mesh: &Mesh, map: NodePlaces, layout: &Layout, sagittas: &[f64]) -> Self {
        let (points, triangles) = (mesh.points(), mesh.triangles());
        let nodes = (0..points.len() as u32).filter(|&node| mesh.is_used(node));
        let (nodes, places): (Vec<u32>, Vec<Place>) =
            nodes.filter_map(|node| map.node(node).map(|place| (node, place))).unzip();
        let at_nodes = nodes.iter().map(|&node| points[node as usize]).collect();
        let mut samples =
            Self { places, points: at_nodes, allowances: vec![0.0; nodes.len()], nodes, dropped: 0 };
        let mut add = |nodes: &[u32], shares: &[f64], sagitta: f64| {
            samples.add(mesh, map.mean(layout, nodes, shares), nodes, shares, sagitta);
        };
        for (triangle, &sagitta) in triangles.iter().zip(sagittas) {
            add(triangle, &[1.0 / 3.0; 3], sagitta);
        }
        for (triangle, &sagitta) in triangles.iter().zip(sagittas) {
            for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|ends| ends.map(|k| triangle[k])) {
                // of both facets at an edge the one that runs upwards, at a border the only one
                if a < b || mesh.edge_between(b, a).is_none() {
                    add(&[a, b], &[0.5; 2], sagitta);
                }
            }
        }
        for ((triangle, &sagitta), rows) in triangles.iter().zip(sagittas).zip(grid_rows(mesh)) {
            for a in 0..rows {
                for b in 0..rows - a {
                    let share = |k: usize| (k as f64 + 1.0 / 3.0) / rows as f64;
                    add(triangle, &[share(a), share(b), share(rows - 1 - a - b)], sagitta);
                }
            }
        }
        samples
    }

    fn add(&mut self, mesh: &Mesh, place: Option<Place>, nodes: &[u32], shares: &[f64], sagitta: f64) {
        let Some(place) = place else {
            self.dropped += 1;
            return;
        };
        let terms = nodes.iter().zip(shares);
        self.points.push(terms.map(|(&node, &share)| share * mesh.points()[node as usize]).sum());
        self.places.push(place);
        self.allowances.push(sagitta);
    }

    /// What a sample counts beside a node: less where the facet itself is farther from the shape than the tolerance.
    pub fn weight(&self, sample: usize, tolerance: f64) -> f64 {
        if sample < self.nodes.len() { 1.0 } else { weight_on_facet(self.allowances[sample], tolerance) }
    }
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
        .collect();
    let mut sorted = longest.clone();
    let middle = sorted.len() / 2;
    if sorted.is_empty() {
        return Vec::new();
    }
    let median = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
    let rows = |length: &f64| {
        let times = (length / median).ceil();
        if times >= LONG { (times as usize).min(MOST_ROWS) } else { 0 }
    };
    longest.iter().map(rows).collect()
}

/// Samples sorted by the cells of all patches.
pub struct ByCell(Lists);

impl ByCell {
    /// Sorts places by the cells of a space, patch after patch and leaf after leaf.
    pub fn sort(space: &Space, places: &[Place], pool: &Pool) -> Self {
        let mut first_cells = vec![0];
        for topology in space.topologies() {
            first_cells.push(first_cells[first_cells.len() - 1] + topology.leaves.len() as u32);
        }
        let cell = |place: &Place| {
            let quad = place.quad as usize;
            let leaf = space.topologies()[quad].leaf_of(space.meshes()[quad].locate(place.uv));
            first_cells[quad] + leaf as u32
        };
        let cells: Vec<u32> = pool.run(|| places.par_iter().with_min_len(4096).map(cell).collect());
        Self(Lists::by_key(first_cells[first_cells.len() - 1] as usize, &cells))
    }

    /// The samples of a cell.
    pub fn of(&self, cell: usize) -> &[u32] {
        self.0.of(cell)
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.0.count()
    }
}

/// The quad of each cell, and where the cell lies on it.
pub fn quads_of_cells(space: &Space) -> Vec<u32> {
    let counts = space.topologies().iter().map(|topology| topology.leaves.len());
    (0..).zip(counts).flat_map(|(quad, count)| std::iter::repeat_n(quad, count)).collect()
}

/// Cells with fewer samples get places of their own.
const ENOUGH: usize = 9;
/// Places along a side of such a cell.
const GUARDS: usize = 3;

/// Places in cells with too few samples, three times three a cell.
pub fn guard_places(quads: &[u32], cells: &[CellPlace], by_cell: &ByCell) -> Vec<Place> {
    let mut places = Vec::new();
    for (number, (&quad, cell)) in quads.iter().zip(cells).enumerate() {
        if by_cell.of(number).len() < ENOUGH {
            for k in 0..GUARDS * GUARDS {
                let at = DVec2::new((k / GUARDS) as f64, (k % GUARDS) as f64) + 0.5;
                places.push(Place { quad, uv: cell.min + cell.size / GUARDS as f64 * at });
            }
        }
    }
    places
}
