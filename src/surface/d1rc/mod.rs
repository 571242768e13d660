//! D1RC-splines: smooth surfaces from any triangular control mesh, with sharp features.
//!
//! J. Cao, J. Zheng, "Bivariate splines over triangular meshes for freeform surface modeling with sharp features",
//! Computer-Aided Design and Applications (2016), and links of links after Y. Liu, J. Snoeyink (2007):
//! ```text
//! S(t) = sum_X P_X b_X(t) / sum_X b_X(t)        X: k knots; P_X: the mean of their control points
//! ```
//! In the mode [`D1rcMode::Reproducing`] the functions sum to one, nothing is divided, and a plane mesh is its own
//! surface; [`D1rcMode::Paper`] is the construction as printed. Degree k is C^(k-1) for knots in general position.
//! Surfaces stay inside the hull of their control points (with phantom knots: beyond the border inside that of the
//! continued mesh).
//!
//! * `simplex`, `configuration`: the functions by definition; `kernel`: the same, fast.
//! * `frame`, `links`, `polygon`: configurations that reproduce polynomials; `paper`: those of the paper.
//! * `sharp`: sharp edges; `locate`, `regions`, `turned`: which face, which functions.
//! * `space`: all that does not depend on control points; here: a surface.

mod configuration;
mod error;
mod evaluate;
mod frame;
mod kernel;
mod links;
mod locate;
mod options;
mod paper;
mod polygon;
mod regions;
mod sharp;
pub mod simplex;
mod space;
#[cfg(test)]
mod tests;
mod turned;

pub use configuration::{Configuration, Jet};
pub use error::D1rcError;
pub use frame::Boundary;
pub use options::{D1rcMode, D1rcOptions, SharpRule};
pub use sharp::sharp_edges;
pub use space::{Recipe, Space};

use super::{ControlNet, Domain, Facets, Kind, Region, Surface};
use crate::control::Watch;
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::Trims;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A D1RC-spline surface.
#[derive(Debug, Clone)]
pub struct D1rcSurface {
    space: Arc<Space>,
    dim: usize,
    /// Rows of `dim` numbers, by vertex of the control mesh.
    control_points: Vec<f64>,
    /// The same by function.
    coefficients: Vec<f64>,
    /// The functions whose control points depend on a vertex.
    dependents: Arc<Lists>,
    region: Region,
}

impl PartialEq for D1rcSurface {
    fn eq(&self, other: &Self) -> bool {
        self.space.recipe == other.space.recipe
            && self.dim == other.dim
            && self.control_points == other.control_points
            && self.region == other.region
    }
}

impl D1rcSurface {
    /// The surface of a control mesh in space with parameters.
    pub fn from_mesh(
        mesh: &Mesh,
        options: &D1rcOptions,
        sharp_edges: &[[u32; 2]],
        corners: &[u32],
    ) -> Result<Self, D1rcError> {
        Self::from_mesh_watched(mesh, options, sharp_edges, corners, &Watch::default())
    }

    /// The same, for a call that may be cancelled.
    pub fn from_mesh_watched(
        mesh: &Mesh,
        options: &D1rcOptions,
        sharp_edges: &[[u32; 2]],
        corners: &[u32],
        watch: &Watch,
    ) -> Result<Self, D1rcError> {
        let recipe = Recipe {
            uv: memory::copied(mesh.parameters().ok_or(D1rcError::NoParameters)?),
            triangles: memory::copied(mesh.triangles()),
            options: *options,
            sharp_edges: memory::copied(sharp_edges),
            corners: memory::copied(corners),
        };
        let points = mesh.points().iter().flat_map(|point| point.to_array()).collect_vec();
        Self::new(Space::new_watched(recipe, watch)?, 3, points)
    }

    /// The surface in a space with `dim` numbers for each vertex of the control mesh.
    pub fn new(space: Space, dim: usize, control_points: Vec<f64>) -> Result<Self, D1rcError> {
        if dim == 0 {
            return Err(D1rcError::Dimension);
        }
        let expected = dim * space.vertex_count();
        check_numbers(&control_points, dim, expected)?;
        let rows = space.configurations.iter().enumerate();
        let mut pairs: Vec<(u32, u32)> = rows
            .flat_map(|(function, c)| c.row.iter().map(move |&(vertex, _)| (vertex, function as u32)))
            .collect_vec();
        pairs.sort_unstable();
        let mut surface = Self {
            dim,
            control_points,
            coefficients: memory::filled(0.0, dim * space.configurations.len()),
            dependents: Arc::new(Lists::new(space.vertex_count(), pairs.iter().copied())),
            region: Region { data_box: None, trims: trims(&space), ..Region::default() },
            space: Arc::new(space),
        };
        (0..surface.space.configurations.len()).for_each(|function| surface.update(function));
        Ok(surface)
    }

    /// The functions and faces.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.space.degree()
    }

    /// The control points: rows by vertex of the control mesh.
    pub fn control_points(&self) -> &[f64] {
        &self.control_points
    }

    /// Moves control points: `rows` has one for each of `vertices`. Nothing is changed on an error.
    pub fn set_control_points(&mut self, vertices: &[u32], rows: &[f64]) -> Result<(), D1rcError> {
        check_numbers(rows, self.dim, self.dim.saturating_mul(vertices.len()))?;
        check_vertices("vertex", vertices, self.space.vertex_count())?;
        for (&vertex, row) in vertices.iter().zip(rows.chunks_exact(self.dim)) {
            self.control_points[vertex as usize * self.dim..][..self.dim].copy_from_slice(row);
        }
        let dependents = self.dependents.clone();
        let mut functions: Vec<u32> =
            vertices.iter().flat_map(|&vertex| dependents.of(vertex as usize)).copied().collect_vec();
        functions.sort_unstable();
        functions.dedup();
        functions.into_iter().for_each(|function| self.update(function as usize));
        Ok(())
    }

    /// The control point of a function from those of the vertices.
    fn update(&mut self, function: usize) {
        let coefficient = &mut self.coefficients[function * self.dim..][..self.dim];
        coefficient.fill(0.0);
        for &(vertex, weight) in &self.space.configurations[function].row {
            let point = &self.control_points[vertex as usize * self.dim..][..self.dim];
            coefficient.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
        }
    }

    /// The same control points with other sharp edges. The trims stay. Nothing is changed on an error.
    pub fn set_sharp_edges(&mut self, sharp_edges: &[[u32; 2]], corners: &[u32]) -> Result<(), D1rcError> {
        let mut recipe = self.space.recipe.clone();
        recipe.sharp_edges = memory::copied(sharp_edges);
        recipe.corners = memory::copied(corners);
        let region = self.region.clone();
        *self = Self::new(Space::new(recipe)?, self.dim, self.control_points.clone())?;
        self.region = region;
        Ok(())
    }

    /// The faces of the control mesh that move with a vertex, in increasing order.
    pub fn influence(&self, vertex: u32) -> Result<Vec<u32>, D1rcError> {
        let functions = self.functions_of(vertex)?;
        let faces = functions.iter().flat_map(|&function| self.space.regions.faces(function));
        let mut faces: Vec<u32> = faces.map(|&face| self.space.parents[face as usize]).collect_vec();
        faces.sort_unstable();
        faces.dedup();
        Ok(faces)
    }

    fn functions_of(&self, vertex: u32) -> Result<&[u32], D1rcError> {
        check_vertices("vertex", &[vertex], self.space.vertex_count())?;
        Ok(self.dependents.of(vertex as usize))
    }

    /// The blending weights of the control vertices at a point, by vertex; they sum to one. Empty outside the domain.
    pub fn vertex_weights(&self, uv: DVec2, out: &mut Vec<(u32, f64)>) {
        out.clear();
        for (function, share) in self.space.shares(uv).unwrap_or_default() {
            let row = &self.space.configurations[function as usize].row;
            out.extend(row.iter().map(|&(vertex, weight)| (vertex, share * weight)));
        }
        out.sort_by_key(|&(vertex, _)| vertex);
        out.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            kept.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
    }

    /// The blending weight of one vertex at points of the domain.
    pub fn blending_values(&self, vertex: u32, uv: &[DVec2]) -> Result<Vec<f64>, D1rcError> {
        let functions = self.functions_of(vertex)?;
        let part = |&(function, share): &(u32, f64)| {
            functions.binary_search(&function).ok()?;
            let row = &self.space.configurations[function as usize].row;
            let at = row.binary_search_by_key(&vertex, |&(vertex, _)| vertex).ok()?;
            Some(share * row[at].1)
        };
        let value = |(index, &uv): (usize, &DVec2)| match self.space.shares(uv) {
            Some(shares) => Ok(shares.iter().filter_map(part).sum()),
            None if uv.is_finite() => Err(D1rcError::Outside { index, u: uv.x, v: uv.y }),
            None => Err(D1rcError::PointNotFinite { index }),
        };
        uv.iter().enumerate().map(value).collect()
    }

    /// How often the surface is differentiable across edges of the control mesh, for knots in general position: 0
    /// on creases and on edges that touch a repeated knot, else the degree less one.
    pub fn edge_continuity(&self, edges: &[[u32; 2]]) -> Result<Vec<usize>, D1rcError> {
        let recipe = &self.space.recipe;
        let sorted = |edges: &mut dyn Iterator<Item = [u32; 2]>| {
            let mut all: Vec<[u32; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect_vec();
            all.sort_unstable();
            all
        };
        let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
        let sides = sorted(&mut recipe.triangles.iter().flat_map(sides));
        let sharp = sorted(&mut recipe.sharp_edges.iter().copied());
        let order = |(index, &vertices): (usize, &[u32; 2])| {
            let count = self.space.vertex_count();
            if let Some(&vertex) = vertices.iter().find(|&&vertex| vertex as usize >= count) {
                return Err(D1rcError::NoSuchVertex { what: "an end of edge", index, vertex, count });
            }
            let edge = [vertices[0].min(vertices[1]), vertices[0].max(vertices[1])];
            if sides.binary_search(&edge).is_err() {
                return Err(D1rcError::NotAnEdge { index, vertices });
            }
            let is_sharp = sharp.binary_search(&edge).is_ok();
            let is_clamped = edge.iter().any(|&end| self.space.is_clamped[end as usize]);
            Ok(if is_sharp || is_clamped { 0 } else { self.degree() - 1 })
        };
        edges.iter().enumerate().map(order).collect()
    }
}

fn check_vertices(what: &'static str, vertices: &[u32], count: usize) -> Result<(), D1rcError> {
    match vertices.iter().position(|&vertex| vertex as usize >= count) {
        Some(index) => Err(D1rcError::NoSuchVertex { what, index, vertex: vertices[index], count }),
        None => Ok(()),
    }
}

fn check_numbers(rows: &[f64], dim: usize, expected: usize) -> Result<(), D1rcError> {
    if rows.len() != expected {
        return Err(D1rcError::Count { what: "the control points", count: rows.len(), expected });
    }
    match rows.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(D1rcError::NotFinite { index: index / dim }),
        None => Ok(()),
    }
}

/// The boundary loops of the faces on which a surface is best shown: those of the domain, in the mode `Paper` those
/// whose vertices are all inside.
fn trims(space: &Space) -> Trims {
    let triangles = space.shown.iter().map(|&face| space.locator.faces()[face as usize]).collect_vec();
    let places = space.locator.places();
    let Ok(mesh) = Mesh::new(places.iter().map(|uv| uv.extend(0.0)).collect_vec(), triangles) else {
        return Trims::default(); // no face is shown
    };
    let polyline = |line: &Vec<u32>| line.iter().map(|&knot| places[knot as usize]).collect_vec();
    Trims::new(mesh.loops().iter().map(polyline).collect(), &space.locator.domain()).unwrap_or_default()
}

impl Surface for D1rcSurface {
    fn kind(&self) -> Kind {
        Kind::D1rc
    }

    fn dim(&self) -> usize {
        self.dim
    }

    fn domain(&self) -> Domain {
        self.space.locator.domain()
    }

    fn contains(&self, uv: DVec2) -> bool {
        self.space.find(uv).is_some()
    }

    fn coefficient_count(&self) -> usize {
        self.space.vertex_count()
    }

    fn region(&self) -> &Region {
        &self.region
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.region
    }

    fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        self.eval_points(uv, max_derivative, out);
    }

    fn facets(&self) -> Option<Arc<dyn Facets>> {
        Some(Arc::new(self.clone()))
    }

    /// The control mesh.
    fn control_net(&self) -> Option<ControlNet> {
        if self.dim != 3 {
            return None;
        }
        let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
        let mut edges: Vec<[u32; 2]> = self.space.recipe.triangles.iter().flat_map(sides).collect_vec();
        edges.sort_unstable();
        edges.dedup();
        Some(ControlNet {
            points: self.control_points.chunks_exact(3).map(DVec3::from_slice).collect(),
            weights: None,
            lines: edges.iter().map(|edge| memory::copied(edge)).collect(),
        })
    }
}

impl Facets for D1rcSurface {
    fn places(&self) -> &[DVec2] {
        self.space.locator.places()
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        self.space.shown.iter().map(|&face| self.space.locator.faces()[face as usize]).collect()
    }

    fn eval_on_facet(&self, face: usize, uv: &[DVec2], out: &mut [f64]) {
        self.eval_on_domain_face(self.space.shown[face], uv, out);
    }

    fn has_own_trims(&self) -> bool {
        self.region.trims == trims(&self.space)
    }

    fn nearest_in_domain(&self, uv: DVec2) -> DVec2 {
        if self.contains(uv) || !uv.is_finite() {
            return uv;
        }
        self.space.locator.nearest(uv).map_or(uv, |(_, near)| near)
    }
}
