//! Triangle meshes: construction, topology, files, cutting, decimation.
//!
//! A [`Mesh`] is manifold and consistently oriented: every edge has one or two triangles, and two run along
//! it in opposite directions. Its constructor checks that and names what is wrong, so nothing after it asks
//! again. Allowed are several components, holes, nodes without triangles and nodes where the surface only
//! touches itself ([`Mesh::pinched_nodes`]).

mod cut;
mod decimate;
mod error;
mod read;
pub(crate) mod rings;
#[cfg(test)]
mod tests;
mod topology;
mod weld;

pub use cut::{CutError, Piece};
pub(crate) use decimate::Quadric;
pub use decimate::{DecimateError, DecimateOptions, DecimateReport, Decimation};
pub use error::MeshError;
pub use read::{Format, ReadError, read, read_bytes};
pub use topology::{HalfEdge, Topology};

use crate::geometry::Bounds;
use glam::{DVec2, DVec3};

/// How arrays become a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeshOptions {
    /// Nodes not further apart than this become one, in model units. Default 0: nothing is welded, except
    /// that nodes of STL files with equal coordinates always are.
    pub weld_distance: f64,
    /// Whether triangles are turned over until neighbours agree. Default: no, disagreement is an error.
    pub orient: bool,
    /// The number of the first node in the triangles given; files know theirs. Default 0.
    pub index_base: u32,
}

impl MeshOptions {
    /// The same with another weld distance.
    pub const fn with_weld_distance(self, weld_distance: f64) -> Self {
        Self { weld_distance, ..self }
    }

    /// The same with or without repair of the orientation.
    pub const fn with_orient(self, orient: bool) -> Self {
        Self { orient, ..self }
    }

    /// The same for nodes counted from another number.
    pub const fn with_index_base(self, index_base: u32) -> Self {
        Self { index_base, ..self }
    }
}

/// What was done to arrays or a file to make a mesh of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshRepairs {
    /// Nodes that vanished because they were welded to others.
    pub welded_nodes: usize,
    /// Triangles that vanished because welding made two of their nodes one.
    pub dropped_triangles: usize,
    /// Triangles that were turned over.
    pub flipped_triangles: usize,
    /// The file has texture coordinates that are no parameters: a node has several, or none.
    pub dropped_parameters: bool,
    /// The node of the mesh that each node given became; none if they are the same.
    pub node_map: Option<Vec<u32>>,
}

impl MeshRepairs {
    /// Whether the mesh is what was given.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A number on each node, by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Its name, unique in the mesh.
    pub name: String,
    /// By node; may be NaN where nothing is known.
    pub values: Vec<f64>,
}

/// A manifold, consistently oriented triangle mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    parameters: Option<Vec<DVec2>>,
    fields: Vec<Field>,
    topology: Topology,
    loops: Vec<Vec<u32>>,
    component_count: usize,
    used_count: usize,
}

impl Mesh {
    /// From arrays that need no repair.
    pub fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_sizes(&points, &triangles)?;
        check_triangles(&points, &triangles, 0)?;
        Self::assemble(points, triangles)
    }

    /// From arrays, repaired as far as `options` ask for it.
    pub fn with_options(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        let weld = (options.weld_distance != 0.0).then_some(options.weld_distance);
        Self::repaired(points, triangles, weld, options)
    }

    /// `weld`: the distance, 0 for equal coordinates; none for no welding whatever the options say.
    fn repaired(
        mut points: Vec<DVec3>,
        mut triangles: Vec<[u32; 3]>,
        weld: Option<f64>,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        check_sizes(&points, &triangles)?;
        if let Some(distance) = weld.filter(|distance| !(distance.is_finite() && *distance >= 0.0)) {
            return Err(MeshError::WeldDistance { distance });
        }
        let mut repairs = MeshRepairs::default();
        // the numbers that the caller has for nodes and triangles; none while they are ours
        let mut numbers = None;

        check_indices(&points, &mut triangles, options.index_base)?;
        if let Some(distance) = weld {
            let firsts = weld::weld(&points, distance);
            numbers = apply_weld(&firsts, &mut points, &mut triangles, &mut repairs);
            if triangles.is_empty() {
                return Err(MeshError::NothingLeft { distance });
            }
        }
        let told = |error: MeshError| match &numbers {
            Some((nodes, kept)) => error.renumbered(nodes, kept),
            None => error,
        };
        if options.orient {
            repairs.flipped_triangles = topology::orient(&mut triangles, points.len()).map_err(told)?;
        }
        let mesh = Self::assemble(points, triangles).map_err(told)?;
        Ok((mesh, repairs))
    }

    /// From checked arrays: everything that follows from them.
    fn assemble(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let topology = Topology::new(&triangles, points.len())?;
        let loops = ordered_loops(&points, &triangles, &topology);
        let (_, component_count) = topology.components();
        let used_count = (0..points.len()).filter(|&i| topology.first(i as u32).is_some()).count();
        Ok(Self {
            points,
            triangles,
            parameters: None,
            fields: Vec::new(),
            topology,
            loops,
            component_count,
            used_count,
        })
    }

    /// The nodes.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Three nodes each, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The (u,v) of each node, if it has them.
    pub fn parameters(&self) -> Option<&[DVec2]> {
        self.parameters.as_deref()
    }

    /// Gives each node its (u,v).
    pub fn set_parameters(&mut self, parameters: Vec<DVec2>) -> Result<(), MeshError> {
        if parameters.len() != self.points.len() {
            return Err(MeshError::ParameterCount { given: parameters.len(), count: self.points.len() });
        }
        if let Some(node) = parameters.iter().position(|uv| !uv.is_finite()) {
            return Err(MeshError::ParameterNotFinite { node });
        }
        self.parameters = Some(parameters);
        Ok(())
    }

    /// Forgets the (u,v).
    pub fn clear_parameters(&mut self) {
        self.parameters = None;
    }

    /// The fields on the nodes, in the order they came.
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// The values of a field, by node.
    pub fn field(&self, name: &str) -> Option<&[f64]> {
        self.fields.iter().find(|field| field.name == name).map(|field| &field.values[..])
    }

    /// Adds a field, or replaces the one of this name.
    pub fn set_field(&mut self, name: &str, values: Vec<f64>) -> Result<(), MeshError> {
        if values.len() != self.points.len() {
            let (given, count) = (values.len(), self.points.len());
            return Err(MeshError::FieldCount { name: name.to_owned(), given, count });
        }
        match self.fields.iter_mut().find(|field| field.name == name) {
            Some(field) => field.values = values,
            None => self.fields.push(Field { name: name.to_owned(), values }),
        }
        Ok(())
    }

    /// Twins and fans.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Boundary loops as nodes in order, the interior on the left; the longest (in space) first. Each starts
    /// at its smallest node. A loop meets a pinched node as often as it passes through it.
    pub fn loops(&self) -> &[Vec<u32>] {
        &self.loops
    }

    /// Parts that hang together by edges.
    pub fn component_count(&self) -> usize {
        self.component_count
    }

    /// All edges, each counted once.
    pub fn edge_count(&self) -> usize {
        self.topology.edge_count()
    }

    /// Used nodes - edges + triangles. A pinched node counts once.
    pub fn euler_characteristic(&self) -> i64 {
        self.used_count as i64 - self.edge_count() as i64 + self.triangles.len() as i64
    }

    /// Handles of all components together. Pinched nodes are taken apart for the count, since a touch in a
    /// point is no handle.
    pub fn genus(&self) -> usize {
        let apart = self.euler_characteristic() + self.topology.further_fan_count() as i64;
        // each component has 2 - 2 genus - loops
        ((2 * self.component_count as i64 - self.loops.len() as i64 - apart) / 2) as usize
    }

    /// Nodes where the surface touches itself without an edge, in increasing order.
    pub fn pinched_nodes(&self) -> Vec<u32> {
        self.topology.pinched_nodes()
    }

    /// Whether the mesh is a disk, possibly with holes: one component, no handle, a boundary, nothing pinched.
    pub fn is_disk(&self) -> bool {
        self.component_count == 1
            && !self.loops.is_empty()
            && self.topology.further_fan_count() == 0
            && self.genus() == 0
    }

    /// Whether the node has a triangle.
    pub fn is_used(&self, node: u32) -> bool {
        self.topology.first(node).is_some()
    }

    /// Nodes without triangles, in increasing order.
    pub fn unused_nodes(&self) -> Vec<u32> {
        (0..self.points.len() as u32).filter(|&node| !self.is_used(node)).collect()
    }

    /// All edges, each by that of its half-edges with the smaller number.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdge> + '_ {
        let half_edges =
            (0..self.triangles.len()).flat_map(|t| [0, 1, 2].map(|corner| HalfEdge::new(t, corner)));
        half_edges.filter(|&edge| self.topology.twin(edge).is_none_or(|twin| edge < twin))
    }

    /// The normals of the nodes: sums of the area vectors of their triangles, not of length 1.
    pub fn node_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.points.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|node| self.points[node as usize]);
            let area = (b - a).cross(c - a);
            triangle.iter().for_each(|&node| normals[node as usize] += area);
        }
        normals
    }

    /// The half-edges that leave a node, counter-clockwise. If the node lies on the boundary they begin there
    /// and the last neighbour has none: see [`Mesh::neighbours`]. Pinched nodes: fan after fan.
    pub fn outgoing(&self, node: u32) -> impl Iterator<Item = HalfEdge> + '_ {
        self.topology.fans(node).flat_map(|start| self.topology.fan_from(start))
    }

    /// The nodes joined to a node by edges, counter-clockwise, beginning at the boundary if there is one.
    pub fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        self.outgoing(node).flat_map(|half_edge| {
            let last = half_edge.previous();
            let ends_fan = self.topology.twin(last).is_none();
            let target = half_edge.target(&self.triangles);
            [Some(target), ends_fan.then(|| last.origin(&self.triangles))].into_iter().flatten()
        })
    }

    /// Whether the node lies on the boundary.
    pub fn is_boundary(&self, node: u32) -> bool {
        self.topology.fans(node).any(|start| self.topology.twin(start).is_none())
    }

    /// The half-edge between two nodes: from the first to the second, or its other side if the first does not
    /// exist because the edge lies on the boundary.
    pub fn edge_between(&self, from: u32, to: u32) -> Option<HalfEdge> {
        self.outgoing(from).find_map(|half_edge| {
            let last = half_edge.previous();
            if half_edge.target(&self.triangles) == to {
                Some(half_edge)
            } else if last.origin(&self.triangles) == to && self.topology.twin(last).is_none() {
                Some(last)
            } else {
                None
            }
        })
    }

    /// The box of the nodes that have triangles.
    pub fn bounds(&self) -> Bounds {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (i, &point) in self.points.iter().enumerate() {
            if self.is_used(i as u32) {
                (low, high) = (low.min(point), high.max(point));
            }
        }
        Bounds { min: low.to_array().to_vec(), max: high.to_array().to_vec() }
    }

    /// Length of that box's diagonal.
    pub fn diagonal(&self) -> f64 {
        self.bounds().diagonal()
    }
}

/// Most nodes of one mesh: the largest index means "none" in places.
const MAX_NODES: usize = u32::MAX as usize;

fn check_sizes(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    match (points.len(), triangles.len()) {
        (0, _) => Err(MeshError::NoPoints),
        (_, 0) => Err(MeshError::NoTriangles),
        (count, _) if count > MAX_NODES => Err(MeshError::TooManyNodes { count, limit: MAX_NODES }),
        (_, count) if count > topology::MAX_TRIANGLES => {
            Err(MeshError::TooManyTriangles { count, limit: topology::MAX_TRIANGLES })
        }
        _ => match points.iter().position(|point| !point.is_finite()) {
            Some(node) => Err(MeshError::NotFinite { node }),
            None => Ok(()),
        },
    }
}

fn check_triangles(points: &[DVec3], triangles: &[[u32; 3]], first: u32) -> Result<(), MeshError> {
    let end = points.len() as u64 + u64::from(first);
    let exists = |node: u32| node >= first && u64::from(node) < end;
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        if let Some(node) = [a, b, c].into_iter().find(|&node| !exists(node)) {
            return Err(MeshError::IndexOutOfRange { triangle, node, first, last: end - 1 });
        }
        if a == b || b == c || c == a {
            return Err(MeshError::RepeatedNode { triangle, node: if a == b { a } else { c } - first });
        }
    }
    Ok(())
}

/// Checks the triangles and lets their nodes count from 0.
fn check_indices(points: &[DVec3], triangles: &mut [[u32; 3]], base: u32) -> Result<(), MeshError> {
    check_triangles(points, triangles, base)?;
    if base != 0 {
        triangles.iter_mut().flatten().for_each(|node| *node -= base);
    }
    Ok(())
}

/// Keeps the nodes that are their own first and the triangles that keep three nodes. Returns the old numbers
/// of both; none if no node was welded.
fn apply_weld(
    firsts: &[u32],
    points: &mut Vec<DVec3>,
    triangles: &mut Vec<[u32; 3]>,
    repairs: &mut MeshRepairs,
) -> Option<(Vec<u32>, Vec<u32>)> {
    let mut nodes = Vec::new();
    let mut node_map = Vec::with_capacity(firsts.len());
    for (i, &first) in firsts.iter().enumerate() {
        if first as usize == i {
            node_map.push(nodes.len() as u32);
            nodes.push(i as u32);
        } else {
            node_map.push(node_map[first as usize]); // first < i
        }
    }
    if nodes.len() == points.len() {
        return None;
    }
    let mut kept = Vec::with_capacity(triangles.len());
    let mut t = 0;
    triangles.retain_mut(|triangle| {
        *triangle = triangle.map(|node| node_map[node as usize]);
        let [a, b, c] = *triangle;
        let keeps = a != b && b != c && c != a;
        if keeps {
            kept.push(t);
        }
        t += 1;
        keeps
    });
    *repairs = MeshRepairs {
        welded_nodes: points.len() - nodes.len(),
        dropped_triangles: t as usize - kept.len(),
        node_map: Some(node_map),
        ..*repairs
    };
    *points = nodes.iter().map(|&node| points[node as usize]).collect();
    Some((nodes, kept))
}

fn ordered_loops(points: &[DVec3], triangles: &[[u32; 3]], topology: &Topology) -> Vec<Vec<u32>> {
    let mut loops: Vec<(f64, Vec<u32>)> = Vec::new();
    for chain in topology.boundary() {
        let mut nodes: Vec<u32> = chain.iter().map(|half_edge| half_edge.origin(triangles)).collect();
        let smallest = (0..nodes.len()).min_by_key(|&i| nodes[i]).unwrap_or(0);
        nodes.rotate_left(smallest);
        let ends = nodes.iter().zip(nodes.iter().cycle().skip(1));
        let length = ends.map(|(&a, &b)| points[a as usize].distance(points[b as usize])).sum();
        loops.push((length, nodes));
    }
    loops.sort_by(|(a, x), (b, y)| b.total_cmp(a).then_with(|| x.cmp(y)));
    loops.into_iter().map(|(_, nodes)| nodes).collect()
}
