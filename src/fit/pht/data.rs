//! What is fitted: nodes or points, and the middles of triangles.
//!
//! With more coefficients than nodes the nodes alone say nothing. The middle of a
//! triangle of a shape is taken where a smooth surface would have it, above the facet.

use crate::control::{Pool, Watch};
use crate::fit::common::errors::{DataErrors, data_errors};
use crate::fit::common::interior::{InteriorErrors, MeshData, Sagittas, heights_over, triangle_sagittas};
use crate::fit::common::neighbours::z_order;
use crate::fit::common::report::{Goal, Tolerance};
use crate::fit::common::samples::bulge;
use crate::fit::common::sides::GivenSide;
use crate::fit::common::{Demands, FitError, Frame, Standards};
use crate::geometry::{Bounds, Domain};
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use std::borrow::Cow;

/// Weight of the middle of a triangle against that of a node: an estimate, which must not pull the surface off the
/// nodes.
const MIDDLE_WEIGHT: f64 = 0.3;

/// The data of a fit.
pub(super) struct Data<'a> {
    pub mesh: Option<&'a Mesh>,
    /// Whether the values are the nodes' places in space.
    pub is_shape: bool,
    /// Rows of `dim` numbers, as given.
    pub values: Cow<'a, [f64]>,
    pub dim: usize,
    /// Parameters of the data; sweeps move them.
    pub uv: Vec<DVec2>,
    /// Parameters as they were at first.
    pub first_uv: Vec<DVec2>,
    /// The box of `uv` as it was at first.
    pub data_box: Domain,
    pub frame: Frame,
    pub bounds: Bounds,
    /// Values of the samples in the frame: those of the data, then those of the middles of triangles.
    pub sample_values: Vec<f64>,
    /// A weight for each sample; empty for all 1.
    pub sample_weights: Vec<f64>,
    /// `order[k]` is the number that datum `k` was given with; empty if they are as given.
    pub order: Vec<u32>,
    /// Height of the shape above each triangle; empty for what is no shape.
    sagittas: Vec<f64>,
    pub standards: Standards,
    /// Whether the side of the largest u is a mirror.
    pub is_mirrored: bool,
    /// Sides that are given.
    pub sides: Vec<GivenSide>,
}

impl<'a> Data<'a> {
    /// Scattered data, in an order in which neighbours in the plane are neighbours in memory: later passes over
    /// the data of a cell find them together.
    pub(super) fn of_points(uv: &[DVec2], values: &[f64], dim: usize, weights: Option<&[f64]>) -> Self {
        let order = z_order(uv);
        let at = |&k: &u32| k as usize;
        let sorted = order.iter().flat_map(|k| &values[at(k) * dim..][..dim]).copied().collect_vec();
        let weights: Option<Vec<f64>> =
            weights.map(|weights| order.iter().map(|k| weights[at(k)]).collect_vec());
        let uv = order.iter().map(|k| uv[at(k)]).collect_vec();
        Self { order, ..Self::new(uv, Cow::Owned(sorted), dim, weights.as_deref()) }
    }

    fn new(uv: Vec<DVec2>, values: Cow<'a, [f64]>, dim: usize, weights: Option<&[f64]>) -> Self {
        let (bounds, data_box) = (Bounds::of_rows(&values, dim), Domain::around(uv.iter().copied()));
        let frame = Frame::new(&bounds);
        Self {
            mesh: None,
            is_shape: false,
            sample_values: frame.inward(&values),
            sample_weights: weights.map_or(Vec::new(), <[f64]>::to_vec),
            order: Vec::new(),
            sagittas: Vec::new(),
            standards: Standards::default(),
            is_mirrored: false,
            sides: Vec::new(),
            values,
            dim,
            first_uv: memory::copied(&uv),
            uv,
            data_box,
            frame,
            bounds,
        }
    }

    /// Something of each datum in the order in which they were given.
    pub(super) fn as_given<T: Copy>(&self, sorted: Vec<T>) -> Vec<T> {
        let mut given = memory::copied(&sorted);
        self.order.iter().zip(sorted).for_each(|(&k, x)| given[k as usize] = x);
        given
    }

    /// Those on the nodes of a mesh, and in the middles of its triangles. A cancelled call throws them away.
    pub(super) fn of_mesh(
        mesh: &'a Mesh,
        uv: Vec<DVec2>,
        (values, dim): (&'a [f64], usize),
        is_shape: bool,
        weights: Option<&[f64]>,
        watch: &Watch,
    ) -> Self {
        let base = Self::new(uv, Cow::Borrowed(values), dim, weights);
        let mut data = Self { mesh: Some(mesh), is_shape, ..base };
        let middles = if is_shape { bulged_middles(mesh, &data) } else { flat_middles(mesh, &data) };
        memory::extend(&mut data.sample_values, middles);
        if is_shape {
            let Sagittas { heights, is_sharp } = triangle_sagittas(mesh, watch);
            // a smooth surface cannot follow a sharp edge: what it misses beside one asks for no more cells
            let allowed = |(height, is_sharp)| if is_sharp { f64::INFINITY } else { height };
            data.sagittas = heights.into_iter().zip(is_sharp).map(allowed).collect_vec();
        }
        let weight = |n: u32| weights.map_or(1.0, |weights| weights[n as usize]);
        let mean = |nodes: &[u32; 3]| nodes.iter().map(|&n| weight(n)).sum::<f64>() / 3.0;
        memory::reserve(&mut data.sample_weights, mesh.points().len() + mesh.triangles().len());
        data.sample_weights.resize(mesh.points().len(), 1.0);
        memory::extend(
            &mut data.sample_weights,
            mesh.triangles().iter().map(|nodes| MIDDLE_WEIGHT * mean(nodes)),
        );
        data
    }

    /// Takes over what single data demand, in the order in which they were given.
    pub(super) fn demand(
        &mut self,
        demands: &Demands,
        asked: &Tolerance,
        goal: &Goal,
    ) -> Result<(), FitError> {
        let at = |k: usize| self.order.get(k).map_or(k, |&given| given as usize);
        let count = self.uv.len();
        let sorted = |tolerances: &[f64]| (0..count).map(|k| tolerances[at(k)]).collect::<Vec<f64>>();
        let tolerances = demands.tolerances.map(sorted);
        let mut places: Vec<u32> = (0..count as u32).collect();
        (0..count).for_each(|k| places[at(k)] = k as u32);
        let fixed: Vec<u32> = demands.fixed.iter().map(|&datum| places[datum as usize]).collect();
        let sorted = Demands { fixed: &fixed, tolerances: tolerances.as_deref(), ..*demands };
        let standards = Standards::new(&sorted, asked, goal, &self.uv, (&self.values, self.dim));
        self.standards = standards.map_err(|error| match error {
            FitError::Contradiction { first, second, distance } => {
                let (first, second) = (at(first).min(at(second)), at(first).max(at(second)));
                FitError::Contradiction { first, second, distance }
            }
            error => error,
        })?;
        if !self.standards.are_alike() {
            self.weigh();
        }
        Ok(())
    }

    /// Weighs the data by what they demand, and triangles by the least of their corners.
    fn weigh(&mut self) {
        let triangles = self.mesh.map_or(&[][..], Mesh::triangles);
        self.sample_weights.resize(self.uv.len() + triangles.len(), 1.0);
        let factor = |node: usize| self.standards.weight(node);
        let (nodes, middles) = self.sample_weights.split_at_mut(self.uv.len());
        nodes.iter_mut().enumerate().for_each(|(node, weight)| *weight *= factor(node));
        for (middle, corners) in middles.iter_mut().zip(triangles) {
            *middle *= corners.map(|node| factor(node as usize)).into_iter().fold(f64::INFINITY, f64::min);
        }
    }

    /// Measures a surface at the data.
    pub(super) fn errors(&self, surface: &dyn Surface, pool: &Pool) -> DataErrors {
        self.standards.measure(data_errors(surface, &self.uv, &self.values, pool))
    }

    /// Measures a surface between the nodes of a mesh.
    pub(super) fn interior_errors(&self, surface: &dyn Surface, pool: &Pool) -> Option<InteriorErrors> {
        Some(self.on_mesh()?.interior_errors(surface, &self.standards, pool))
    }

    /// Parameters of all samples.
    pub(super) fn sample_uv(&self) -> Vec<DVec2> {
        let triangles = self.mesh.map_or(&[][..], Mesh::triangles);
        let middle = |nodes: &[u32; 3]| nodes.iter().map(|&n| self.uv[n as usize]).sum::<DVec2>() / 3.0;
        self.uv.iter().copied().chain(triangles.iter().map(middle)).collect_vec()
    }

    /// By how much the middle of each triangle of a shape misses the surface beyond its sagitta; `sample_uv` are
    /// the parameters of all samples.
    pub(super) fn excesses(&self, surface: &dyn Surface, sample_uv: &[DVec2], pool: &Pool) -> Vec<f64> {
        let Some(mesh) = self.mesh.filter(|_| self.is_shape) else { return Vec::new() };
        let place = |n: u32| DVec3::from_slice(&self.values[3 * n as usize..]);
        let middle = |&[a, b, c]: &[u32; 3]| ((place(a) + place(b) + place(c)) / 3.0).to_array();
        let middles: Vec<f64> = mesh.triangles().iter().flat_map(middle).collect_vec();
        let heights = heights_over(surface, &sample_uv[self.uv.len()..], &middles, pool);
        let excesses = heights.into_iter().zip(&self.sagittas).map(|(height, sagitta)| height - sagitta);
        if self.standards.are_alike() {
            return excesses.collect();
        }
        let factor = |corners: &[u32; 3]| {
            corners.map(|node| self.standards.factor(node as usize)).into_iter().fold(f64::INFINITY, f64::min)
        };
        excesses.zip(mesh.triangles()).map(|(excess, corners)| factor(corners) * excess).collect()
    }

    fn on_mesh(&self) -> Option<MeshData<'_>> {
        let is_shape = self.is_shape;
        self.mesh.map(|mesh| MeshData { mesh, uv: &self.uv, values: &self.values, is_shape })
    }
}

fn bulged_middles(mesh: &Mesh, data: &Data) -> Vec<f64> {
    let normals = mesh.node_normals();
    let middle = |nodes: &[u32; 3]| {
        let nodes = nodes.map(|node| node as usize);
        let corners = nodes.map(|n| DVec3::from_slice(&data.sample_values[3 * n..]));
        let normals = nodes.map(|n| normals[n].normalize_or_zero());
        bulge(corners, normals, [1.0 / 3.0; 3]).to_array()
    };
    mesh.triangles().iter().flat_map(middle).collect_vec()
}

fn flat_middles(mesh: &Mesh, data: &Data) -> Vec<f64> {
    let row = |n: u32| &data.sample_values[n as usize * data.dim..][..data.dim];
    let middle =
        |&[a, b, c]: &[u32; 3]| (0..data.dim).map(move |k| (row(a)[k] + row(b)[k] + row(c)[k]) / 3.0);
    mesh.triangles().iter().flat_map(middle).collect_vec()
}
