//! Cross insertion and removal (Deng et al. 2008).
//!
//! A split stores the jets that the leaf's patch has at its middle and at those of its edge middles that become
//! basis vertices; a T-vertex of a neighbour there becomes a crossing with exactly the jet it had. Nothing
//! else changes, whatever the difference of levels. A merge drops the jets of the vertices that are no basis
//! vertices any more.

use super::evaluate::View;
use super::expansion::line_between;
use super::jet::{ROWS, between, inside};
use super::{PhtError, PhtSurface};
use crate::memory;
use crate::surface::tensor::Axis;
use crate::tmesh::{Cell, EDGES, NodeId, Role, TMesh, TMeshError, Vertex};
use std::sync::OnceLock;

impl PhtSurface {
    /// Splits leaves one after the other; later ones may be quarters of earlier ones. Changes nothing if one
    /// of them cannot be split.
    pub fn split(&mut self, cells: &[Cell]) -> Result<(), PhtError> {
        self.mesh.clone().split_all(cells)?;
        let is_smooth = self.smooth.is_some();
        for (index, &cell) in cells.iter().enumerate() {
            self.split_node(self.mesh.splittable(index, cell)?);
        }
        if is_smooth {
            self.renew_smooth()?;
        }
        Ok(())
    }

    /// Merges the quarters of cells, one cell after the other. Changes nothing if the quarters of one of them
    /// are not four leaves when its turn comes.
    pub fn merge(&mut self, cells: &[Cell]) -> Result<(), PhtError> {
        let mut mesh = self.mesh.clone();
        for (index, &cell) in cells.iter().enumerate() {
            mesh.merge(mergeable(&mesh, index, cell)?);
        }
        for (index, &cell) in cells.iter().enumerate() {
            self.merge_node(mergeable(&self.mesh, index, cell)?);
        }
        Ok(())
    }

    /// Replaces the jets of some basis vertices: for each the rows f, f_u, f_v, f_uv of
    /// [`PhtSurface::width`] numbers.
    pub fn set_jets(&mut self, ranks: &[usize], jets: &[f64]) -> Result<(), PhtError> {
        let length = ROWS * self.width();
        let (count, expected) = (self.jets.len(), ranks.len() * length);
        if jets.len() != expected {
            return Err(PhtError::Count { what: "the data of the vertices", count: jets.len(), expected });
        }
        if let Some(&index) = ranks.iter().find(|&&rank| rank >= count) {
            return Err(PhtError::NoSuchVertex { index, count });
        }
        if let Some(at) = jets.iter().position(|x| !x.is_finite()) {
            return Err(PhtError::NotFinite { index: ranks[at / length] });
        }
        let mut changed = self.clone();
        let topology = self.topology();
        for (&rank, jet) in ranks.iter().zip(jets.chunks_exact(length)) {
            let vertex = topology.vertices[topology.basis[rank] as usize];
            changed.jets.insert(vertex, memory::copied(jet));
        }
        (changed.smooth, changed.view) = (None, OnceLock::new());
        changed.view.get_or_init(|| View::new(&changed, topology.clone()));
        changed.check_weights()?;
        *self = changed;
        Ok(())
    }

    /// The jet at a vertex: that of a basis vertex, or what the host of a T-vertex has there.
    pub(super) fn jet_at(&self, vertex: Vertex) -> Vec<f64> {
        match self.jets.get(&vertex) {
            Some(jet) => jet.clone(),
            None => match self.mesh.role(vertex) {
                Role::Hanging(host) => self.jet_in_edge(self.mesh.cell(host), vertex),
                role => unreachable!("{vertex:?} is {role:?} and has no jet"),
            },
        }
    }

    /// The jet at a place inside an edge of a leaf.
    fn jet_in_edge(&self, cell: Cell, at: Vertex) -> Vec<f64> {
        let corners = cell.corners();
        let is_on = |along: Axis, corner: Vertex| match along {
            Axis::U => at.j == corner.j,
            Axis::V => at.i == corner.i,
        };
        let edge = EDGES.iter().find(|edge| is_on(edge.along, corners[edge.ends[0]]));
        let edge = edge.expect("the place lies in an edge of the leaf");
        let ends = edge.ends.map(|end| corners[end]);
        let range = ends.map(|end| end.along(edge.along));
        let line = line_between(&self.mesh, edge.along, at.along(edge.along), range);
        let [from, to] = ends.map(|end| self.jet_at(end));
        between(edge.along, &line, [&from, &to], self.width())
    }

    /// The jet that the patch of a leaf has at a place in it.
    pub(super) fn jet_in_cell(&self, cell: Cell, at: Vertex) -> Vec<f64> {
        let corners = cell.corners();
        let jets = corners.map(|corner| self.jet_at(corner));
        let lines = [Axis::U, Axis::V].map(|axis| {
            let range = [corners[0], corners[3]].map(|corner| corner.along(axis));
            line_between(&self.mesh, axis, at.along(axis), range)
        });
        inside(jets.each_ref().map(Vec::as_slice), lines, self.width())
    }

    pub(super) fn split_node(&mut self, leaf: NodeId) {
        let cell = self.mesh.cell(leaf);
        let middle = (cell.middle(), self.jet_in_cell(cell, cell.middle()));
        let edges = cell.edge_middles().map(|vertex| (vertex, self.jet_in_edge(cell, vertex)));
        self.mesh.split(leaf);
        let mesh = &self.mesh;
        let new = edges.into_iter().filter(|&(vertex, _)| mesh.role(vertex) == Role::Basis);
        self.jets.extend(new.chain([middle]));
        (self.smooth, self.view) = (None, OnceLock::new());
    }

    pub(super) fn merge_node(&mut self, node: NodeId) {
        self.mesh.merge(node);
        let cell = self.mesh.cell(node);
        for vertex in cell.edge_middles().into_iter().chain([cell.middle()]) {
            if self.mesh.role(vertex) != Role::Basis {
                self.jets.remove(&vertex);
            }
        }
        (self.smooth, self.view) = (None, OnceLock::new());
    }
}

fn mergeable(mesh: &TMesh, index: usize, cell: Cell) -> Result<NodeId, TMeshError> {
    let node = mesh.find(cell).filter(|&node| mesh.is_mergeable(node));
    node.ok_or(TMeshError::NotMergeable { index, cell })
}
