//! Triangle meshes: construction, topology, files, cutting, decimation.
//!
//! A [`Mesh`] is manifold and consistently oriented: every edge has one or two triangles, and two run along
//! it in opposite directions. Its constructor checks that and names what is wrong, so nothing after it asks
//! again. Allowed are several components, holes, nodes without triangles (whose coordinates may be anything) and
//! nodes where the surface only touches itself ([`Mesh::pinched_nodes`]). Arrays and files that are no mesh yet are
//! repaired ([`Repair`]) where that needs no guess.

mod boundary;
mod cut;
mod decimate;
mod error;
mod features;
mod halve;
mod polygon;
mod priced;
mod read;
mod repair;
pub(crate) mod rings;
#[cfg(test)]
mod tests;
mod topology;
mod weld;

pub(crate) use boundary::{close_loop, loop_edges};
pub use cut::{CutError, Piece};
pub(crate) use decimate::Quadric;
pub use decimate::{DecimateError, DecimateOptions, DecimateReport, Decimation};
pub use error::MeshError;
pub(crate) use features::FacetNormals;
pub use features::{Chain, FeatureError, FeatureOptions, Features, LabelParts, Region, Regions, Side};
pub(crate) use halve::Middles;
pub use polygon::Faces;
pub use read::{Format, ReadError, read, read_as, read_bytes, read_face_property};
pub use repair::{Components, MeshRepairs, Repair};
pub use topology::{HalfEdge, Topology};

use crate::geometry::{Bounds, safe_scale};
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use glam::{DVec2, DVec3};
use polygon::Triangulation;
use repair::Draft;
use std::borrow::Cow;

/// How arrays become a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeshOptions {
    /// Nodes not further apart than this become one, in model units. Default 0: nothing is welded, except
    /// that nodes of STL files with equal coordinates always are.
    pub weld_distance: f64,
    /// Which faults are mended; the others are refused. Default: [`Repair::SAFE`].
    pub repair: Repair,
    /// Which components become the mesh. Default: all.
    pub components: Components,
    /// The number of the first node in the triangles given; files know theirs. Default 0.
    pub index_base: u32,
    /// Most bytes of a file, unpacked, that are read; 0 (default) for three quarters of the machine's memory.
    pub max_memory: u64,
}

impl MeshOptions {
    with_fields! {
        with_weld_distance weld_distance: f64,
        with_repair repair: Repair,
        with_components components: Components,
        with_index_base index_base: u32,
        with_max_memory max_memory: u64,
    }
}

/// A number on each node, by name.
#[derive(Debug, PartialEq)]
pub struct Field {
    /// Its name, unique in the mesh.
    pub name: String,
    /// By node; may be NaN where nothing is known.
    pub values: Vec<f64>,
}

impl Clone for Field {
    fn clone(&self) -> Self {
        Self { name: self.name.clone(), values: memory::copied(&self.values) }
    }
}

/// A manifold, consistently oriented triangle mesh.
#[derive(Debug, PartialEq)]
pub struct Mesh {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    parameters: Option<Vec<DVec2>>,
    fields: Vec<Field>,
    topology: Topology,
    loops: Vec<Vec<u32>>,
    component_count: usize,
    used_count: usize,
    origins: Origins,
}

/// What nodes and triangles were in the arrays, the file or the mesh that they come from.
#[derive(Debug, PartialEq, Default)]
struct Origins {
    /// By node; none if the numbers are the same.
    nodes: Option<Vec<u32>>,
    /// By triangle; none if the numbers are the same.
    triangles: Option<Vec<u32>>,
}

impl Clone for Origins {
    fn clone(&self) -> Self {
        let copied = |numbers: &Option<Vec<u32>>| numbers.as_deref().map(memory::copied);
        Self { nodes: copied(&self.nodes), triangles: copied(&self.triangles) }
    }
}

impl Clone for Mesh {
    fn clone(&self) -> Self {
        let Self {
            points,
            triangles,
            parameters,
            fields,
            topology,
            loops,
            component_count,
            used_count,
            origins,
        } = self;
        Self {
            points: memory::copied(points),
            triangles: memory::copied(triangles),
            parameters: parameters.as_deref().map(memory::copied),
            fields: fields.clone(),
            topology: topology.clone(),
            loops: loops.iter().map(|nodes| memory::copied(nodes)).collect_vec(),
            component_count: *component_count,
            used_count: *used_count,
            origins: origins.clone(),
        }
    }
}

impl Origins {
    /// From all numbers.
    fn new(nodes: Vec<u32>, triangles: Vec<u32>) -> Self {
        let unless_same = |numbers: Vec<u32>| {
            let is_same = numbers.iter().zip(0..).all(|(&number, i)| number == i);
            (!is_same).then_some(numbers)
        };
        Self { nodes: unless_same(nodes), triangles: unless_same(triangles) }
    }

    fn node(&self, node: u32) -> u32 {
        self.nodes.as_ref().map_or(node, |nodes| nodes[node as usize])
    }

    fn triangle(&self, triangle: u32) -> u32 {
        self.triangles.as_ref().map_or(triangle, |triangles| triangles[triangle as usize])
    }
}

impl Mesh {
    /// From arrays that need no repair. Nodes without triangles and touching nodes may be there.
    pub fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_sizes(&points, &triangles)?;
        check_indices(&points, &triangles, 0)?;
        let is_repeated = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
        if let Some(triangle) = triangles.iter().position(is_repeated) {
            let [a, b, c] = triangles[triangle];
            return Err(MeshError::RepeatedNode { triangle, node: if a == b { a } else { c } });
        }
        if let Some(node) = first_not_finite(&points, &triangles) {
            return Err(MeshError::NotFinite { node });
        }
        let topology = Topology::new(&triangles, points.len())?;
        Ok(Self::assemble(points, triangles, topology, Origins::default()))
    }

    /// From arrays, repaired as far as `options` ask for it.
    pub fn with_options(
        points: Vec<DVec3>,
        mut triangles: Vec<[u32; 3]>,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        check_sizes(&points, &triangles)?;
        check_indices(&points, &triangles, options.index_base)?;
        triangles.iter_mut().flatten().for_each(|node| *node -= options.index_base);
        Self::repaired(points, triangles, weld_distance(options), options)
    }

    /// From polygons, repaired as far as `options` ask for it. The triangles that errors speak of are those that the
    /// polygons are cut into.
    pub fn from_faces(
        points: Vec<DVec3>,
        mut faces: Faces,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        if points.is_empty() {
            return Err(MeshError::NoPoints);
        }
        faces.rebase(options.index_base, points.len())?;
        Self::from_faces_welded(points, faces, weld_distance(options), options)
    }

    fn from_faces_welded(
        points: Vec<DVec3>,
        faces: Faces,
        weld: Option<f64>,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        let left_out = faces.left_out();
        if let Some((face, count)) = left_out.filter(|_| !options.repair.has(Repair::REPEATED_CORNERS)) {
            return Err(MeshError::FewCorners { face, count });
        }
        let Triangulation { triangles, faces } = faces.into_triangles(&points)?;
        if let (true, Some((_, count))) = (triangles.is_empty(), left_out) {
            return Err(MeshError::NoArea { count });
        }
        let (mut mesh, mut repairs) = Self::repaired(points, triangles, weld, options)?;
        repairs.dropped_triangles += left_out.map_or(0, |(_, count)| count);
        if let Some(faces) = faces {
            let numbers = 0..mesh.triangles.len() as u32;
            let face = |triangle| faces[mesh.origins.triangle(triangle) as usize];
            mesh.origins.triangles = Some(numbers.map(face).collect());
        }
        Ok((mesh, repairs))
    }

    /// `weld`: the distance, 0 for equal coordinates; none for no welding whatever the options say.
    fn repaired(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        weld: Option<f64>,
        options: &MeshOptions,
    ) -> Result<(Self, MeshRepairs), MeshError> {
        if let Some(distance) = weld.filter(|distance| !(distance.is_finite() && *distance >= 0.0)) {
            return Err(MeshError::WeldDistance { distance });
        }
        Draft::new(points, triangles, options.repair)?.into_mesh(weld, options.components)
    }

    /// From checked arrays: everything that follows from them.
    fn assemble(points: Vec<DVec3>, triangles: Vec<[u32; 3]>, topology: Topology, origins: Origins) -> Self {
        let loops = ordered_loops(&points, &triangles, &topology);
        let (_, component_count) = topology.components();
        let used_count = (0..points.len()).filter(|&i| topology.first(i as u32).is_some()).count();
        Self {
            points,
            triangles,
            parameters: None,
            fields: Vec::new(),
            topology,
            loops,
            component_count,
            used_count,
            origins,
        }
    }

    /// What each node was in the arrays or the file, or in the mesh that this one was cut from.
    pub fn node_origins(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        (0..self.points.len() as u32).map(|node| self.origins.node(node))
    }

    /// What each triangle was in the arrays, or in the mesh that this one was cut from; for files the face.
    pub fn triangle_origins(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        (0..self.triangles.len() as u32).map(|triangle| self.origins.triangle(triangle))
    }

    /// The nodes.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Moves the nodes. Parameters and fields stay.
    pub fn set_points(&mut self, points: Vec<DVec3>) -> Result<(), MeshError> {
        if points.len() != self.points.len() {
            return Err(MeshError::PointCount { given: points.len(), count: self.points.len() });
        }
        if let Some(node) = first_not_finite(&points, &self.triangles) {
            return Err(MeshError::NotFinite { node });
        }
        self.points = points;
        self.loops = ordered_loops(&self.points, &self.triangles, &self.topology); // by length
        Ok(())
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

    /// Removes the field of this name; false if there is none.
    pub fn remove_field(&mut self, name: &str) -> bool {
        let before = self.fields.len();
        self.fields.retain(|field| field.name != name);
        self.fields.len() < before
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
        (0..self.points.len() as u32).filter(|&node| !self.is_used(node)).collect_vec()
    }

    /// All edges, each by that of its half-edges with the smaller number.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdge> + '_ {
        let half_edges =
            (0..self.triangles.len()).flat_map(|t| [0, 1, 2].map(|corner| HalfEdge::new(t, corner)));
        half_edges.filter(|&edge| self.topology.twin(edge).is_none_or(|twin| edge < twin))
    }

    /// The normals of the nodes: sums of the area vectors of their triangles, not of length 1.
    pub fn node_normals(&self) -> Vec<DVec3> {
        let (safe, _) = self.at_safe_scale();
        let mut normals = memory::filled(DVec3::ZERO, self.points.len());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|node| safe.points[node as usize]);
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

    /// The same mesh, or one of about size one where squares of areas would leave the range of doubles, and the power
    /// of two by which its places were multiplied: rounding is the same.
    pub fn at_safe_scale(&self) -> (Cow<'_, Self>, f64) {
        let scale = safe_scale(self.points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max));
        if scale == 1.0 {
            return (Cow::Borrowed(self), 1.0);
        }
        let mut scaled = self.clone();
        scaled.points.iter_mut().for_each(|p| *p *= scale);
        (Cow::Owned(scaled), scale)
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
        _ => Ok(()),
    }
}

/// The first node of a triangle that has a coordinate which is not finite.
fn first_not_finite(points: &[DVec3], triangles: &[[u32; 3]]) -> Option<usize> {
    let is_bad = |node: usize| !points[node].is_finite();
    if !(0..points.len()).any(is_bad) {
        return None;
    }
    triangles.iter().flatten().map(|&node| node as usize).filter(|&node| is_bad(node)).min()
}

fn weld_distance(options: &MeshOptions) -> Option<f64> {
    (options.weld_distance != 0.0).then_some(options.weld_distance)
}

fn check_indices(points: &[DVec3], triangles: &[[u32; 3]], first: u32) -> Result<(), MeshError> {
    let end = points.len() as u64 + u64::from(first);
    let exists = |node: u32| node >= first && u64::from(node) < end;
    for (triangle, nodes) in triangles.iter().enumerate() {
        if let Some(&node) = nodes.iter().find(|&&node| !exists(node)) {
            return Err(MeshError::IndexOutOfRange { triangle, node, first, last: end - 1 });
        }
    }
    Ok(())
}

fn ordered_loops(points: &[DVec3], triangles: &[[u32; 3]], topology: &Topology) -> Vec<Vec<u32>> {
    let mut loops: Vec<(f64, Vec<u32>)> = Vec::new();
    for chain in topology.boundary() {
        let mut nodes: Vec<u32> = chain.iter().map(|half_edge| half_edge.origin(triangles)).collect_vec();
        let smallest = (0..nodes.len()).min_by_key(|&i| nodes[i]).unwrap_or(0);
        nodes.rotate_left(smallest);
        let length = loop_edges(&nodes).map(|[a, b]| points[a as usize].distance(points[b as usize])).sum();
        loops.push((length, nodes));
    }
    loops.sort_by(|(a, x), (b, y)| b.total_cmp(a).then_with(|| x.cmp(y)));
    loops.into_iter().map(|(_, nodes)| nodes).collect_vec()
}
