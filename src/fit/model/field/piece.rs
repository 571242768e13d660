//! Fields over the patches of one piece: the smooth space of the shape, factored once.

use super::super::least_squares::{Solver, System, Targets};
use super::super::samples::{ByCell, NodePlaces};
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::samples::interior_weight;
use crate::fit::field::{FieldError, FieldOptions};
use crate::layout::{Layout, Place};
use crate::mesh::Mesh;
use crate::surface::g1::{Combination, Space};
use crate::surface::pht::PhtSurface;
use crate::tmesh::TMesh;
use glam::DVec3;

/// A datum: the mean of one, two or three nodes.
#[derive(Debug, Clone, Copy)]
struct Sample {
    nodes: [u32; 3],
    shares: [f64; 3],
    weight: f64,
}

/// The factored least squares of one piece.
#[derive(Debug)]
pub(super) struct PieceFitter {
    pub layout: Layout,
    pub meshes: Vec<TMesh>,
    system: System,
    solver: Solver,
    /// By quad, four rows a basis vertex.
    jets: Vec<Vec<Combination>>,
    /// Nodes first, then means of nodes.
    samples: Vec<Sample>,
    pub nodes: Vec<u32>,
    pub places: Vec<Place>,
    pub by_cell: ByCell,
}

/// Places for values: what a solution is read at.
#[derive(Debug)]
pub(super) struct Readings {
    pub places: Vec<Place>,
    by_cell: ByCell,
}

impl PieceFitter {
    /// For fields on the nodes that have places here and values.
    pub(super) fn new(
        (layout, meshes): (&Layout, &[TMesh]),
        mesh: &Mesh,
        places: &[Option<Place>],
        options: &FieldOptions,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Self, FieldError> {
        let space = Space::new(layout, meshes.to_vec())?;
        watch.check()?;
        let system = System::new(&space, pool);
        watch.check()?;
        let data = Data::new(mesh, layout, places, options);
        let by_cell = ByCell::sort(&space, &data.places, pool);
        let targets = Targets {
            uv: data.places.iter().map(|place| place.uv).collect(),
            points: vec![DVec3::ZERO; data.places.len()],
            weights: data.samples.iter().map(|sample| sample.weight).collect(),
        };
        let solver = system.factor(&targets, &by_cell, options.smoothing, pool, watch)?;
        let of_quad = |quad: usize| {
            let ranks = 0..space.topologies()[quad].basis.len() as u32;
            ranks.flat_map(|rank| space.jet_rows(quad, rank).to_vec()).collect()
        };
        let jets = (0..meshes.len()).map(of_quad).collect();
        let Data { samples, nodes, places } = data;
        let (layout, meshes) = (layout.clone(), meshes.to_vec());
        Ok(Self { layout, meshes, system, solver, jets, samples, nodes, places, by_cell })
    }

    /// The free unknowns, column after column, of the field with these values less `center`.
    pub(super) fn unknowns(&self, values: &[f64], dim: usize, center: &[f64], pool: &Pool) -> Vec<f64> {
        let mut rows = vec![0.0; dim * self.samples.len()];
        for (sample, row) in self.samples.iter().zip(rows.chunks_exact_mut(dim)) {
            for (&node, &share) in sample.nodes.iter().zip(&sample.shares).filter(|(_, share)| **share != 0.0)
            {
                let value = &values[node as usize * dim..][..dim];
                row.iter_mut().zip(value).zip(center).for_each(|((sum, x), c)| *sum += share * (x - c));
            }
            row.iter_mut().for_each(|sum| *sum *= sample.weight);
        }
        self.solve(&self.places, &self.by_cell, &rows, dim, pool)
    }

    /// What forces at other places, weighted rows, do to the free unknowns.
    pub(super) fn unknowns_of_forces(
        &self,
        at: &Readings,
        forces: &[f64],
        dim: usize,
        pool: &Pool,
    ) -> Vec<f64> {
        self.solve(&at.places, &at.by_cell, forces, dim, pool)
    }

    fn solve(&self, places: &[Place], by_cell: &ByCell, rows: &[f64], dim: usize, pool: &Pool) -> Vec<f64> {
        let right = self.system.gather(places, by_cell, rows, dim, pool);
        self.solver.solve(right)
    }

    /// Places of this piece to read solutions at.
    pub(super) fn readings(&self, places: Vec<Place>, pool: &Pool) -> Result<Readings, FieldError> {
        let space = Space::new(&self.layout, self.meshes.clone())?;
        let by_cell = ByCell::sort(&space, &places, pool);
        Ok(Readings { places, by_cell })
    }

    /// The values of a solution at places: rows.
    pub(super) fn read(&self, at: &Readings, unknowns: &[f64], dim: usize, pool: &Pool) -> Vec<f64> {
        self.system.read(&at.places, &at.by_cell, unknowns, dim, pool)
    }

    /// Adds what a solution sends to the nodes: the transpose of [`PieceFitter::unknowns`] without its solution.
    pub(super) fn add_to_nodes(&self, unknowns: &[f64], dim: usize, out: &mut [f64], pool: &Pool) {
        let rows = self.system.read(&self.places, &self.by_cell, unknowns, dim, pool);
        for (sample, row) in self.samples.iter().zip(rows.chunks_exact(dim)) {
            for (&node, &share) in sample.nodes.iter().zip(&sample.shares).filter(|(_, share)| **share != 0.0)
            {
                let to = &mut out[node as usize * dim..][..dim];
                to.iter_mut().zip(row).for_each(|(sum, x)| *sum += share * sample.weight * x);
            }
        }
    }

    /// The surfaces of a solution, one a quad, with `center` added.
    pub(super) fn surfaces(
        &self,
        unknowns: &[f64],
        dim: usize,
        center: &[f64],
    ) -> Result<Vec<PhtSurface>, FitError> {
        let n = unknowns.len() / dim;
        let surface = |(jets, mesh): (&Vec<Combination>, &TMesh)| {
            let mut rows = vec![0.0; dim * jets.len()];
            for (k, (combination, row)) in jets.iter().zip(rows.chunks_exact_mut(dim)).enumerate() {
                for (c, sum) in row.iter_mut().enumerate() {
                    let column = &unknowns[c * n..][..n];
                    *sum = combination.terms().iter().map(|&(number, x)| x * column[number as usize]).sum();
                    // the first row of a jet is the value
                    *sum += if k % 4 == 0 { center[c] } else { 0.0 };
                }
            }
            PhtSurface::new(dim, false, mesh.clone(), &rows).map_err(|_| FitError::Singular)
        };
        self.jets.iter().zip(&self.meshes).map(surface).collect()
    }

    /// Control points of all patches, four a basis vertex.
    pub(super) fn coefficient_count(&self) -> usize {
        self.jets.iter().map(Vec::len).sum()
    }
}

/// What the values of a piece are fitted at.
struct Data {
    samples: Vec<Sample>,
    nodes: Vec<u32>,
    places: Vec<Place>,
}

impl Data {
    fn new(mesh: &Mesh, layout: &Layout, places: &[Option<Place>], options: &FieldOptions) -> Self {
        let is_known = |node: u32| {
            places[node as usize].is_some() && options.is_known.is_none_or(|known| known[node as usize])
        };
        let weight = |node: u32| options.weights.map_or(1.0, |weights| weights[node as usize]);
        let nodes: Vec<u32> = (0..places.len() as u32).filter(|&node| is_known(node)).collect();
        let mut data = Self {
            samples: nodes
                .iter()
                .map(|&node| Sample { nodes: [node; 3], shares: [1.0, 0.0, 0.0], weight: weight(node) })
                .collect(),
            places: nodes.iter().filter_map(|&node| places[node as usize]).collect(),
            nodes,
        };
        let map = NodePlaces::Patches(places);
        let between = interior_weight(options.smoothing);
        let mut add = |nodes: &[u32]| {
            if !nodes.iter().all(|&node| is_known(node)) {
                return;
            }
            let count = nodes.len();
            let share = 1.0 / count as f64;
            if let Some(place) = map.mean(layout, nodes, &[share; 3][..count]) {
                let at = |k: usize| nodes[k.min(count - 1)];
                let mean = nodes.iter().map(|&node| weight(node)).sum::<f64>() * share;
                let shares = [0, 1, 2].map(|k| if k < count { share } else { 0.0 });
                data.samples.push(Sample { nodes: [at(0), at(1), at(2)], shares, weight: between * mean });
                data.places.push(place);
            }
        };
        for triangle in mesh.triangles() {
            add(triangle);
            for ends in [[0, 1], [1, 2], [2, 0]].map(|ends| ends.map(|k| triangle[k])) {
                // of both facets at an edge the one that runs upwards, at a border the only one
                if ends[0] < ends[1] || mesh.edge_between(ends[1], ends[0]).is_none() {
                    add(&ends);
                }
            }
        }
        data
    }
}
