//! What a grid is measured with, and what is fitted beside the nodes.

use super::Problem;
use crate::control::{Pool, Watch};
use crate::fit::common::interior::{Between, InteriorErrors, MeshData};
use crate::fit::common::samples::{bulge, places_in_cells};
use crate::surface::Trims;
use crate::surface::tensor::{Axis, TensorSurface};
use glam::{DVec2, DVec3};

impl Problem<'_> {
    /// Measures a surface between the nodes.
    pub(super) fn interior_errors(&self, surface: &TensorSurface, pool: &Pool) -> InteriorErrors {
        self.between(pool.watch()).measure(surface, pool)
    }

    /// What is known between the data. It is made on one thread: others may wait for it.
    pub(super) fn between(&self, watch: &Watch) -> &Between {
        self.between.get_or_init(|| match self.mesh_data() {
            Some(data) => Between::nodes(&data, self.dim, &self.standards, watch),
            None => {
                Between::scattered(&self.uv, self.values, self.dim, &self.data_box, &self.standards, watch)
            }
        })
    }

    /// Gives the data other parameters; returns those of before.
    pub(super) fn move_data(&mut self, uv: Vec<DVec2>) -> Vec<DVec2> {
        if uv != self.uv {
            self.between.take();
        }
        std::mem::replace(&mut self.uv, uv)
    }

    /// The mesh with its values and present parameters.
    pub(super) fn mesh_data(&self) -> Option<MeshData<'_>> {
        let data = |mesh| MeshData { mesh, uv: &self.uv, values: self.values, is_shape: self.is_shape };
        self.mesh.map(data)
    }
}

impl Problem<'_> {
    /// Cells without data inside the loops of the mesh, or inside the box of scattered data: there the surface
    /// is smooth guesswork.
    pub(super) fn empty_cell_count(&self, surface: &TensorSurface, trims: &Trims) -> usize {
        let [u, v] = [Axis::U, Axis::V].map(|axis| surface.knots(axis));
        let (breaks_u, breaks_v) = (u.breaks(), v.breaks());
        let cells_v = breaks_v.len() - 1;
        let mut is_empty = vec![true; (breaks_u.len() - 1) * cells_v];
        for uv in &self.uv {
            is_empty[u.rank_at(uv.x) * cells_v + v.rank_at(uv.y)] = false;
        }
        let is_inside = |cell: usize| {
            let middle = |breaks: &[f64], k: usize| (breaks[k] + breaks[k + 1]) / 2.0;
            let uv = DVec2::new(middle(&breaks_u, cell / cells_v), middle(&breaks_v, cell % cells_v));
            self.data_box.contains(uv) && trims.contains(uv)
        };
        is_empty.iter().enumerate().filter(|&(cell, &empty)| empty && is_inside(cell)).count()
    }
}

/// Places inside triangles, in the frame, with the weights of their triangles.
#[derive(Default)]
pub(super) struct InteriorData {
    pub uv: Vec<DVec2>,
    pub values: Vec<f64>,
    pub weights: Vec<f64>,
}

impl Problem<'_> {
    /// The places inside triangles that are larger than cells, which are one unit of `in_cells`; `values` are
    /// those of the nodes.
    pub(super) fn interior_data(&self, in_cells: impl Fn(DVec2) -> DVec2, values: &[f64]) -> InteriorData {
        let mut data = InteriorData::default();
        let Some(mesh) = self.mesh else { return data };
        let mut shape_normals = None;
        for place in places_in_cells(mesh, &self.uv, in_cells, self.weights.as_deref()) {
            data.uv.push(place.mean(|n| self.uv[n]));
            data.weights.push(place.weight);
            if self.is_shape {
                let normals = shape_normals.get_or_insert_with(|| mesh.node_normals());
                let corners = place.nodes.map(|n| DVec3::from_slice(&values[3 * n..]));
                let normals = place.nodes.map(|n| normals[n].normalize_or_zero());
                data.values.extend(bulge(corners, normals, place.shares).to_array());
            } else {
                data.values.extend((0..self.dim).map(|k| place.mean(|n| values[n * self.dim + k])));
            }
        }
        data
    }
}
