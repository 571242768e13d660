//! Faults of arrays and files that are mended, so that a mesh can be made of them.
//!
//! The numbers of the caller stay: nodes that no triangle needs are kept and passed over, copies of nodes come
//! after all others, only triangles that are none leave a gap, and the mesh remembers what its nodes and
//! triangles were. The order matters:
//! ```text
//! triangles with a corner twice go, near nodes become one (which makes more of them),
//! copies of triangles go, edges of three and more triangles are parted into sheets,
//! triangles are turned over until neighbours agree, a component is picked,
//! nodes where the surface touches itself are parted into one for each fan.
//! ```

use super::topology::{self, Pairing, Topology};
use super::{Mesh, MeshError, Origins, check_sizes, first_not_finite, weld};
use crate::memory::{self, CollectVec};
use glam::DVec3;

/// Which faults are mended; the others are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repair(u32);

impl Repair {
    /// Nothing is mended.
    pub const NONE: Self = Self(0);
    /// Nodes that no triangle needs are kept and passed over, whatever their coordinates are.
    pub const UNUSED_NODES: Self = Self(1);
    /// Triangles with a corner twice are left out, and faces of less than three corners.
    pub const REPEATED_CORNERS: Self = Self(1 << 1);
    /// Of triangles with the same three nodes, whatever their orientation, only the first is kept.
    pub const DUPLICATE_TRIANGLES: Self = Self(1 << 2);
    /// Nodes where the surface touches itself become one for each fan of triangles, the copies after all others.
    pub const TOUCHING_NODES: Self = Self(1 << 3);
    /// Triangles are turned over until neighbours agree: as few as that takes in each component.
    pub const ORIENTATION: Self = Self(1 << 4);
    /// Edges of three and more triangles are parted: each sheet that only meets others there gets nodes of its own.
    pub const SHEETS: Self = Self(1 << 5);
    /// All that changes no shape and needs no guess.
    pub const SAFE: Self = Self(0b1_1111);
    /// Everything.
    pub const ALL: Self = Self(0b11_1111);

    /// What stands in either.
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all that is mended by `other` is mended.
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The choice whose bits these are.
    pub const fn from_bits(bits: u32) -> Option<Self> {
        if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
    }
}

impl Default for Repair {
    fn default() -> Self {
        Self::SAFE
    }
}

/// Which parts that hang together by edges become the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Components {
    /// All of them.
    #[default]
    All,
    /// The one of most triangles; of equals the first.
    Largest,
    /// One by its number, in the order of their first triangles.
    One(u32),
}

/// What was done to arrays or a file to make a mesh of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshRepairs {
    /// Nodes that vanished because they were welded to others.
    pub welded_nodes: usize,
    /// Triangles and faces that were left out because two of their corners are one node, as given or by welding,
    /// or because they have less than three.
    pub dropped_triangles: usize,
    /// Triangles that were left out because an earlier one has the same nodes.
    pub duplicate_triangles: usize,
    /// Triangles that were turned over.
    pub flipped_triangles: usize,
    /// Nodes that no triangle needs.
    pub unused_nodes: usize,
    /// Copies of nodes that were appended.
    pub split_nodes: usize,
    /// Edges of three and more triangles that were parted into sheets.
    pub parted_edges: usize,
    /// Triangles of components that were not asked for: a choice, no repair.
    pub excluded_triangles: usize,
    /// The file has texture coordinates that are no parameters: a node has several or none, or they lie on a line.
    pub dropped_parameters: bool,
    /// The file ends before it says that it does; what it has is whole.
    pub missing_end: bool,
    /// The node of the mesh that each node given became; none if they are the same.
    pub node_map: Option<Vec<u32>>,
}

impl MeshRepairs {
    /// Whether the mesh is what was given, or the part of it that was asked for.
    pub fn is_empty(&self) -> bool {
        let counts = [
            self.welded_nodes,
            self.dropped_triangles,
            self.duplicate_triangles,
            self.flipped_triangles,
            self.unused_nodes,
            self.split_nodes,
            self.parted_edges,
        ];
        counts == [0; 7] && !self.dropped_parameters && !self.missing_end
    }
}

/// Arrays on their way to a mesh.
pub(super) struct Draft {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    origins: Origins,
    repairs: MeshRepairs,
    repair: Repair,
}

impl Draft {
    /// From nodes and triangles whose nodes exist.
    pub(super) fn new(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        repair: Repair,
    ) -> Result<Self, MeshError> {
        check_sizes(&points, &triangles)?;
        let (origins, repairs) = (Origins::default(), MeshRepairs::default());
        Ok(Self { points, triangles, origins, repairs, repair })
    }

    /// `weld`: the distance, 0 for equal coordinates; none for no welding.
    pub(super) fn into_mesh(
        mut self,
        weld: Option<f64>,
        components: Components,
    ) -> Result<(Mesh, MeshRepairs), MeshError> {
        self.drop_repeated_corners()?;
        if let Some(node) = first_not_finite(&self.points, &self.triangles) {
            return Err(MeshError::NotFinite { node });
        }
        if let Some(distance) = weld {
            self.weld(distance)?;
        }
        let mut topology = self.connect()?;
        self.count_unused(&topology)?;
        if self.pick(components, &topology)? {
            topology = self.topology()?;
        }
        if self.split_touching_nodes(&topology)? {
            topology = self.topology()?;
        }
        let mesh = Mesh::assemble(self.points, self.triangles, topology, self.origins);
        Ok((mesh, self.repairs))
    }

    fn drop_repeated_corners(&mut self) -> Result<(), MeshError> {
        let is_repeated = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
        let Some(triangle) = self.triangles.iter().position(is_repeated) else { return Ok(()) };
        if !self.repair.has(Repair::REPEATED_CORNERS) {
            let [a, b, c] = self.triangles[triangle];
            return Err(MeshError::RepeatedNode { triangle, node: if a == b { a } else { c } });
        }
        self.repairs.dropped_triangles += self.keep(|_, triangle| !is_repeated(triangle));
        if self.triangles.is_empty() {
            return Err(MeshError::NoArea { count: self.repairs.dropped_triangles });
        }
        Ok(())
    }

    /// Joins near nodes, and drops the triangles that thereby have a corner twice.
    fn weld(&mut self, distance: f64) -> Result<(), MeshError> {
        let firsts = weld::weld(&self.points, distance);
        let mut nodes = Vec::new();
        let mut node_map = memory::with_capacity(firsts.len());
        for (i, &first) in firsts.iter().enumerate() {
            if first as usize == i {
                memory::push(&mut node_map, nodes.len() as u32);
                memory::push(&mut nodes, i as u32);
            } else {
                node_map.push(node_map[first as usize]); // first < i
            }
        }
        self.repairs.welded_nodes = self.points.len() - nodes.len();
        if self.repairs.welded_nodes == 0 {
            return Ok(());
        }
        self.triangles.iter_mut().flatten().for_each(|node| *node = node_map[*node as usize]);
        self.repairs.dropped_triangles += self.keep(|_, &[a, b, c]| a != b && b != c && c != a);
        if self.triangles.is_empty() {
            return Err(MeshError::NothingLeft { distance });
        }
        self.points = nodes.iter().map(|&node| self.points[node as usize]).collect_vec();
        self.origins.nodes = Some(nodes);
        self.repairs.node_map = Some(node_map);
        Ok(())
    }

    /// Pairs edges, after what keeps them from pairing has been mended.
    fn connect(&mut self) -> Result<Topology, MeshError> {
        let error = match Topology::new(&self.triangles, self.points.len()) {
            Ok(topology) => return Ok(topology),
            Err(error) => error,
        };
        if self.repair.has(Repair::DUPLICATE_TRIANGLES)
            && matches!(error, MeshError::DuplicateTriangle { .. })
        {
            let first_of_its_kind = topology::first_copies(&self.triangles);
            self.repairs.duplicate_triangles = self.keep(|t, _| first_of_its_kind[t]);
        }
        if self.repair.has(Repair::SHEETS) {
            self.part_sheets();
        }
        if self.repair.has(Repair::ORIENTATION) {
            let flipped = topology::orient(&mut self.triangles, self.points.len());
            self.repairs.flipped_triangles = flipped.map_err(|error| error.renumbered(&self.origins))?;
        }
        self.topology()
    }

    fn topology(&self) -> Result<Topology, MeshError> {
        Topology::new(&self.triangles, self.points.len()).map_err(|error| error.renumbered(&self.origins))
    }

    /// Parts the edges of three and more triangles, by giving each sheet nodes of its own there.
    ///
    /// The triangles around a node hang together by edges of two triangles. Such a group has at most two triangles
    /// of any other edge, because it is a ring, or a chain that begins and ends at such edges: when each group has
    /// its own node, no edge has more than two.
    fn part_sheets(&mut self) {
        let pairing = Pairing::new(&self.triangles, self.points.len());
        if pairing.crowded.is_empty() {
            return;
        }
        self.repairs.parted_edges = pairing.crowded.len();
        let mut nodes: Vec<u32> = pairing.crowded.iter().flat_map(|edge| edge.nodes).collect_vec();
        nodes.sort_unstable();
        nodes.dedup();
        for (node, corners) in pairing.further_groups(&self.triangles, &nodes) {
            let copy = self.append_copy(node);
            corners.into_iter().for_each(|corner| self.triangles[corner / 3][corner % 3] = copy);
        }
    }

    fn count_unused(&mut self, topology: &Topology) -> Result<(), MeshError> {
        let mut unused = (0..self.points.len() as u32).filter(|&node| topology.first(node).is_none());
        if let Some(node) = unused.next() {
            if !self.repair.has(Repair::UNUSED_NODES) {
                return Err(MeshError::UnusedNode { node: self.origins.node(node) as usize });
            }
            self.repairs.unused_nodes = 1 + unused.count();
        }
        Ok(())
    }

    /// Leaves out the triangles of other components; whether there were any.
    fn pick(&mut self, components: Components, topology: &Topology) -> Result<bool, MeshError> {
        if components == Components::All {
            return Ok(false);
        }
        let (labels, count) = topology.components();
        let picked = match components {
            Components::One(component) if component as usize >= count => {
                return Err(MeshError::NoSuchComponent { component, count });
            }
            Components::One(component) => component,
            _ => {
                let mut sizes = memory::filled(0_usize, count);
                labels.iter().for_each(|&label| sizes[label as usize] += 1);
                (0..count).rev().max_by_key(|&component| sizes[component]).unwrap_or(0) as u32
            }
        };
        self.repairs.excluded_triangles = self.keep(|t, _| labels[t] == picked);
        Ok(self.repairs.excluded_triangles > 0)
    }

    /// Gives the further fans of each node copies of it; whether there are any.
    fn split_touching_nodes(&mut self, topology: &Topology) -> Result<bool, MeshError> {
        let mut is_split = false;
        for (node, start) in topology.further_fans() {
            if !self.repair.has(Repair::TOUCHING_NODES) {
                return Err(MeshError::TouchingNode { node: self.origins.node(node) as usize });
            }
            let copy = self.append_copy(node);
            for half_edge in topology.fan_from(start) {
                self.triangles[half_edge.triangle()][half_edge.corner()] = copy;
            }
            is_split = true;
        }
        Ok(is_split)
    }

    /// A new node in the place of another.
    fn append_copy(&mut self, node: u32) -> u32 {
        let copy = self.points.len() as u32;
        let nodes = self.origins.nodes.get_or_insert_with(|| (0..copy).collect_vec());
        nodes.push(nodes[node as usize]);
        self.points.push(self.points[node as usize]);
        self.repairs.split_nodes += 1;
        copy
    }

    /// Keeps some triangles, and returns how many went.
    fn keep(&mut self, is_kept: impl Fn(usize, &[u32; 3]) -> bool) -> usize {
        let before = self.triangles.len();
        let mut kept = memory::with_capacity(before);
        let mut t = 0;
        self.triangles.retain(|triangle| {
            let keeps = is_kept(t, triangle);
            if keeps {
                memory::push(&mut kept, self.origins.triangle(t as u32));
            }
            t += 1;
            keeps
        });
        let gone = before - kept.len();
        if gone > 0 {
            self.origins.triangles = Some(kept);
        }
        gone
    }
}
