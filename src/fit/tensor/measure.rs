//! What a grid is measured with, and what is fitted beside the nodes.

use super::Problem;
use crate::control::Pool;
use crate::fit::common::interior::{InteriorErrors, MeshData};
use crate::fit::common::samples::{bulge, interior_places};
use crate::fit::common::uniform::grid::UniformGrid;
use crate::surface::Trims;
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};

impl Problem<'_> {
    /// Measures a surface between the nodes.
    pub fn interior_errors(&self, surface: &TensorSurface, pool: &Pool) -> InteriorErrors {
        let Some(mesh) = self.mesh else {
            return InteriorErrors::default();
        };
        let data = MeshData { mesh, uv: &self.uv, values: self.values, is_shape: self.is_shape };
        data.interior_errors(surface, pool)
    }
}

impl Problem<'_> {
    /// Cells without data inside the loops of the mesh, or inside the box of scattered data: there the surface
    /// is smooth guesswork.
    pub fn empty_cell_count(&self, grid: &[UniformGrid; 2], trims: &Trims) -> usize {
        let cells_v = grid[1].count - 1;
        let mut is_empty = vec![true; (grid[0].count - 1) * cells_v];
        for uv in &self.uv {
            is_empty[grid[0].locate(uv.x).0 * cells_v + grid[1].locate(uv.y).0] = false;
        }
        let is_inside = |cell: usize| {
            let middle = |grid: &UniformGrid, k: usize| grid.knot(k) + grid.step / 2.0;
            let uv = DVec2::new(middle(&grid[0], cell / cells_v), middle(&grid[1], cell % cells_v));
            self.data_box.contains(uv) && trims.contains(uv)
        };
        is_empty.iter().enumerate().filter(|&(cell, &empty)| empty && is_inside(cell)).count()
    }
}

/// Places inside triangles, in the frame, with the weights of their triangles.
#[derive(Default)]
pub struct InteriorData {
    pub uv: Vec<DVec2>,
    pub values: Vec<f64>,
    pub weights: Vec<f64>,
}

impl Problem<'_> {
    /// The places inside triangles that are larger than the cells of a grid; `values` are those of the nodes.
    pub fn interior_data(&self, grid: &[UniformGrid; 2], values: &[f64]) -> InteriorData {
        let mut data = InteriorData::default();
        let Some(mesh) = self.mesh else { return data };
        let mut shape_normals = None;
        for place in interior_places(mesh, &self.uv, grid, self.options.weights) {
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
