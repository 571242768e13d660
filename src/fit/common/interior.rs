//! Errors between the nodes, and the part of them that flat facets explain.

use super::Standards;
use super::errors::data_errors;
use super::neighbours::triangles_between;
use crate::control::{Pool, Watch};
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use crate::surface::{Surface, normal};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Errors at triangle centroids and edge middles.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct InteriorErrors {
    /// The largest error.
    pub max: f64,
    /// The part of it that facets explain: the rest is the largest error beyond what its own facet explains.
    pub sagitta: f64,
    /// The largest error beyond what its own facet explains, by the demands there.
    pub max_excess: f64,
    /// The same without the facets beside sharp edges, which a smooth surface cannot follow.
    pub max_smooth_excess: f64,
}

/// Values on the nodes of a mesh over parameters.
#[derive(Clone, Copy)]
pub(crate) struct MeshData<'a> {
    pub mesh: &'a Mesh,
    pub uv: &'a [DVec2],
    pub values: &'a [f64],
    /// Whether the values are the nodes' places in space.
    pub is_shape: bool,
}

impl MeshData<'_> {
    /// Measures a surface between the nodes.
    pub(crate) fn interior_errors(
        &self,
        surface: &dyn Surface,
        standards: &Standards,
        pool: &Pool,
    ) -> InteriorErrors {
        Between::nodes(self, surface.dim(), standards, pool.watch()).measure(surface, pool)
    }
}

/// Places between the nodes of a mesh, with what is known of the shape there: made once for many surfaces.
pub(crate) struct Between {
    /// Four places for each triangle: its centroid and the middles of its edges.
    pub uv: Vec<DVec2>,
    values: Vec<f64>,
    /// What each triangle explains.
    explained: Sagittas,
    /// The tolerance of the fit by that in each triangle; empty if all are 1.
    factors: Vec<f64>,
    is_shape: bool,
}

impl Between {
    /// Between the nodes of a mesh. A cancelled call throws it away.
    pub(crate) fn nodes(data: &MeshData, dim: usize, standards: &Standards, watch: &Watch) -> Self {
        let triangles = data.mesh.triangles();
        let (uv, values) = interior_samples(triangles, data.uv, data.values, dim, watch);
        let explained = if data.is_shape {
            triangle_sagittas(data.mesh, watch)
        } else {
            Sagittas::smooth(triangle_spreads(triangles, data.values, dim))
        };
        Self { uv, values, explained, factors: factors(triangles, standards), is_shape: data.is_shape }
    }

    /// Between scattered data, of which neighbours in (u,v) make triangles.
    pub(crate) fn scattered(
        uv: &[DVec2],
        values: &[f64],
        dim: usize,
        data: &Domain,
        standards: &Standards,
        watch: &Watch,
    ) -> Self {
        let mut triangles = triangles_between(uv, data, watch);
        if standards.leaves_out() {
            // triangles between those that are not
            let kept: Vec<u32> =
                (0..uv.len() as u32).filter(|&k| !standards.is_left_out(k as usize)).collect();
            let places: Vec<DVec2> = kept.iter().map(|&datum| uv[datum as usize]).collect();
            triangles = triangles_between(&places, data, watch);
            triangles.as_flattened_mut().iter_mut().for_each(|datum| *datum = kept[*datum as usize]);
        }
        let (places, rows) = interior_samples(&triangles, uv, values, dim, watch);
        let explained = Sagittas::smooth(triangle_spreads(&triangles, values, dim));
        let factors = factors(&triangles, standards);
        Self { uv: places, values: rows, explained, factors, is_shape: false }
    }

    /// What is known in one triangle of so many that at most `most` are left.
    pub(crate) fn thinned(&self, most: usize) -> Self {
        let every = self.explained.heights.len().div_ceil(most).max(1);
        let width = self.values.len() / self.uv.len().max(1);
        let places = self.uv.chunks(4).step_by(every).flatten().copied().collect_vec();
        let values = self.values.chunks((4 * width).max(1)).step_by(every).flatten().copied().collect_vec();
        let explained = Sagittas {
            heights: self.explained.heights.iter().step_by(every).copied().collect_vec(),
            is_sharp: self.explained.is_sharp.iter().step_by(every).copied().collect_vec(),
        };
        let factors = self.factors.iter().step_by(every).copied().collect();
        Self { uv: places, values, explained, factors, is_shape: self.is_shape }
    }

    fn factor(&self, triangle: usize) -> f64 {
        self.factors.get(triangle).copied().unwrap_or(1.0)
    }

    /// The error at each place.
    fn errors(&self, surface: &dyn Surface, pool: &Pool) -> Vec<f64> {
        if self.is_shape {
            heights_over(surface, &self.uv, &self.values, pool)
        } else {
            data_errors(surface, &self.uv, &self.values, pool).each
        }
    }

    /// Measures a surface.
    pub(crate) fn measure(&self, surface: &dyn Surface, pool: &Pool) -> InteriorErrors {
        let errors = self.errors(surface, pool);
        let mut result = InteriorErrors::default();
        let mut unexplained: f64 = 0.0;
        for (triangle, errors) in errors.chunks_exact(4).enumerate() {
            let factor = self.factor(triangle);
            if factor == 0.0 {
                continue;
            }
            let max = errors.iter().copied().fold(0.0, f64::max);
            result.max = result.max.max(max);
            let excess = max - self.explained.of(triangle);
            unexplained = unexplained.max(excess);
            result.max_excess = result.max_excess.max(factor * excess);
            if !self.explained.is_sharp[triangle] {
                result.max_smooth_excess = result.max_smooth_excess.max(factor * excess);
            }
        }
        result.sagitta = result.max - unexplained;
        result
    }

    /// The error at each place beyond what its triangle explains.
    pub(crate) fn excess(&self, surface: &dyn Surface, pool: &Pool) -> Vec<f64> {
        let mut errors = self.errors(surface, pool);
        for (triangle, errors) in errors.chunks_exact_mut(4).enumerate() {
            let (explained, is_sharp) = (self.explained.of(triangle), self.explained.is_sharp[triangle]);
            // what a smooth surface misses beside a sharp edge asks for no more knots
            let factor = self.factor(triangle);
            let excess = |error: f64| if is_sharp { 0.0 } else { factor * (error - explained) };
            errors.iter_mut().for_each(|error| *error = excess(*error));
        }
        errors
    }
}

/// Between data the most lenient of them holds; empty if all are alike.
fn factors(triangles: &[[u32; 3]], standards: &Standards) -> Vec<f64> {
    if standards.are_alike() {
        return Vec::new();
    }
    let least = |corners: &[u32; 3]| {
        corners.map(|datum| standards.factor(datum as usize)).into_iter().fold(f64::INFINITY, f64::min)
    };
    triangles.iter().map(least).collect()
}

/// Distances from places on facets to the tangent planes of the surface at their parameters. A map that
/// stretches unevenly puts the mean of parameters beside the mean of places, along the surface: that is no
/// error of the shape. Where the surface has no tangent plane the whole distance counts.
pub(crate) fn heights_over(surface: &dyn Surface, uv: &[DVec2], values: &[f64], pool: &Pool) -> Vec<f64> {
    const CHUNK: usize = 1024;
    let mut heights = memory::filled(0.0, uv.len());
    pool.run(|| {
        let data = uv.par_chunks(CHUNK).zip(values.par_chunks(3 * CHUNK));
        heights.par_chunks_mut(CHUNK).zip(data).for_each(|(heights, (uv, values))| {
            // a cancelled call throws its heights away
            if pool.check().is_err() {
                return;
            }
            let mut rows = memory::filled(0.0, uv.len() * 9);
            surface.eval_rows(uv, 1, &mut rows);
            for ((height, row), value) in heights.iter_mut().zip(rows.chunks(9)).zip(values.chunks(3)) {
                let [s, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
                let miss = DVec3::from_slice(value) - s;
                let normal = normal(su, sv);
                *height = if normal.is_nan() { miss.length() } else { miss.dot(normal).abs() };
            }
        });
    });
    heights
}

/// Centroid and three edge middles of each triangle; of fewer once the call is cancelled.
fn interior_samples(
    triangles: &[[u32; 3]],
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    watch: &Watch,
) -> (Vec<DVec2>, Vec<f64>) {
    let count = 4 * triangles.len();
    let (mut places, mut rows) = (memory::with_capacity(count), memory::with_capacity(count * dim));
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        if watch.check_at(triangle).is_err() {
            break;
        }
        for nodes in [[a, b, c].as_slice(), &[a, b], &[b, c], &[c, a]] {
            let share = 1.0 / nodes.len() as f64;
            memory::push(&mut places, nodes.iter().map(|&n| uv[n as usize]).sum::<DVec2>() * share);
            for k in 0..dim {
                memory::push(
                    &mut rows,
                    nodes.iter().map(|&n| values[n as usize * dim + k]).sum::<f64>() * share,
                );
            }
        }
    }
    (places, rows)
}

/// What the facets of a shape explain.
pub(crate) struct Sagittas {
    /// The height of the shape above each facet.
    pub heights: Vec<f64>,
    /// Whether an edge of the facet is sharp: there the facets are the shape, and explain nothing.
    pub is_sharp: Vec<bool>,
}

impl Sagittas {
    /// Without sharp edges.
    fn smooth(heights: Vec<f64>) -> Self {
        Self { is_sharp: memory::filled(false, heights.len()), heights }
    }

    /// By how much a facet may be missed.
    pub(crate) fn of(&self, triangle: usize) -> f64 {
        if self.is_sharp[triangle] { 0.0 } else { self.heights[triangle] }
    }
}

/// An edge across which normals turn by more than this, 30 degrees, is sharp.
const SHARP_COSINE: f64 = 0.866_025_403_784_438_6;

/// The height of the shape above each facet. A chord of length l whose end normals enclose the angle a belongs
/// to an arc of height `l/2 tan(a/4)`; the middle of an equilateral triangle on a sphere lies 4/3 as high as
/// the middle of its edges. Normals are rough at borders and on uneven triangles, so each facet takes the
/// largest height among the edges at its nodes. Sharp edges divide what meets at a node: each side has a normal of
/// its own.
/// ```text
///        |  /            corners of the triangles at a node, joined across smooth edges:
///    a   | /  b          two sides, a and b, between two sharp edges (=)
///  ======n======
///    c  /|\  c           and a third, c
/// ```
///
/// A cancelled call throws the heights away.
pub(crate) fn triangle_sagittas(mesh: &Mesh, watch: &Watch) -> Sagittas {
    let (mesh, scale) = mesh.at_safe_scale();
    let mesh = mesh.as_ref();
    let (points, triangles) = (mesh.points(), mesh.triangles());
    let areas: Vec<DVec3> = triangles.iter().map(|t| area_vector(points, t)).collect_vec();
    let half_edges = (0..triangles.len())
        .take_while(|&t| watch.check_at(t).is_ok())
        .flat_map(|t| (0..3).map(move |k| HalfEdge::new(t, k)));
    let twin = |h: HalfEdge| mesh.topology().twin(h);
    let is_sharp = |h: HalfEdge| {
        twin(h).is_some_and(|twin| {
            let (a, b) = (areas[h.triangle()], areas[twin.triangle()]);
            a.dot(b) < SHARP_COSINE * a.length() * b.length()
        })
    };
    let mut sides = Sides::new(3 * triangles.len());
    for h in half_edges.clone().filter(|&h| !is_sharp(h)) {
        if let Some(twin) = twin(h) {
            sides.join(h.index(), twin.next().index());
            sides.join(h.next().index(), twin.index());
        }
    }
    let side: Vec<usize> = (0..3 * triangles.len()).map(|corner| sides.of(corner)).collect_vec();
    let mut normals = memory::filled(DVec3::ZERO, side.len());
    let mut is_open = memory::filled(false, side.len());
    for h in half_edges.clone() {
        normals[side[h.index()]] += areas[h.triangle()];
        if twin(h).is_none() || is_sharp(h) {
            is_open[side[h.index()]] = true;
            is_open[side[h.next().index()]] = true;
        }
    }
    let mut heights = memory::filled(0.0_f64, side.len());
    for h in half_edges.clone() {
        let (a, b) = (side[h.index()], side[h.next().index()]);
        let angle = normals[a].cross(normals[b]).length().atan2(normals[a].dot(normals[b]));
        let ends = [h.origin(triangles), h.target(triangles)].map(|node| points[node as usize]);
        let height = ends[0].distance(ends[1]) / 2.0 * (angle / 4.0).tan();
        // a normal at the border is that of one side only, half an edge away
        let height = if is_open[a] || is_open[b] { 2.0 * height } else { height };
        heights[a] = heights[a].max(height);
        heights[b] = heights[b].max(height);
    }
    let corners = |t: usize| 3 * t..3 * t + 3;
    let highest = |t: usize| corners(t).map(|corner| heights[side[corner]]).fold(0.0, f64::max);
    let all = 0..triangles.len();
    Sagittas {
        heights: all.clone().map(|t| 4.0 / 3.0 * highest(t) / scale).collect_vec(),
        is_sharp: all.map(|t| (0..3).any(|k| is_sharp(HalfEdge::new(t, k)))).collect_vec(),
    }
}

/// Corners that belong together, as a forest: each points towards the one that stands for its side.
struct Sides {
    towards: Vec<u32>,
}

impl Sides {
    fn new(count: usize) -> Self {
        Self { towards: (0..count as u32).collect_vec() }
    }

    fn of(&mut self, corner: usize) -> usize {
        let mut at = corner;
        while self.towards[at] as usize != at {
            let next = self.towards[at] as usize;
            self.towards[at] = self.towards[next];
            at = next;
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.towards[a.max(b)] = a.min(b) as u32;
    }
}

/// Across the triangle, of twice its area.
fn area_vector(points: &[DVec3], triangle: &[u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|node| points[node as usize]);
    (b - a).cross(c - a)
}

/// How far the values of a field differ along the edges around each facet. What a field does between its nodes
/// is unknown, but a surface that leaves the values of a facet by more than they change around it oscillates.
fn triangle_spreads(triangles: &[[u32; 3]], values: &[f64], dim: usize) -> Vec<f64> {
    let value = |node: usize| &values[node * dim..][..dim];
    let mut spreads = memory::filled(0.0_f64, values.len() / dim);
    for &[a, b, c] in triangles {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let (a, b) = (a as usize, b as usize);
            let spread = value(a).iter().zip(value(b)).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
            spreads[a] = spreads[a].max(spread);
            spreads[b] = spreads[b].max(spread);
        }
    }
    let largest = |nodes: &[u32; 3]| nodes.iter().map(|&n| spreads[n as usize]).fold(0.0, f64::max);
    triangles.iter().map(largest).collect_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::report::{Remarks, Tolerance};
    use crate::fit::tensor::{Knots, TensorOptions, fit_mesh};
    use crate::samples::grid;

    /// A square folded along the line x = 1/2 so that its halves enclose an angle, over the unfolded square.
    fn folded(degrees: f64, count: usize) -> Mesh {
        let (places, triangles) = grid([count, count], 0.0, 1, |_| true);
        let slope = degrees.to_radians();
        let point = |p: &DVec2| {
            let over = (p.x - 0.5).max(0.0);
            DVec3::new(p.x.min(0.5) + over * slope.cos(), p.y, over * slope.sin())
        };
        let mut mesh = Mesh::new(places.iter().map(point).collect(), triangles).unwrap();
        mesh.set_parameters(places).unwrap();
        mesh
    }

    #[test]
    fn facets_beside_a_sharp_edge_explain_nothing() {
        for (degrees, is_sharp) in [(25.0, false), (35.0, true), (90.0, true), (170.0, true)] {
            let sagittas = triangle_sagittas(&folded(degrees, 9), &Watch::default());
            // four columns of cells on both sides of the fold
            assert_eq!(sagittas.is_sharp.contains(&true), is_sharp, "{degrees}");
            let highest = sagittas.heights.iter().copied().fold(0.0, f64::max);
            // the halves are flat: what does not look across a sharp edge sees no height at all
            assert_eq!(highest <= 1e-12, is_sharp, "{degrees}: {highest}");
        }
    }

    #[test]
    fn a_smooth_surface_over_a_sharp_edge_is_remarked() {
        for degrees in [40.0, 90.0] {
            let mesh = folded(degrees, 5);
            let tolerance = Tolerance { value: 1e-2, ..Tolerance::default() };
            let options = TensorOptions { tolerance, knots: Knots::Uniform, ..TensorOptions::default() };
            let report = fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap().report;
            let is_far = report.max_interior_error > report.tolerance;
            assert_eq!(report.remarks.has(Remarks::ROUGH_BETWEEN_NODES), is_far, "{degrees}: {report:?}");
            assert!(report.facet_sagitta <= report.max_interior_error);
            assert!(report.facet_sagitta <= 1e-12, "{degrees}: {report:?}");
        }
        // an open cube of ten triangles: the surface bulges far between its corners
        let corners =
            (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64)).collect();
        let sides = [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        let halves = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let cube = Mesh::new(corners, halves).unwrap();
        let tolerance = Tolerance { value: 1e-2, ..Tolerance::default() };
        let options = TensorOptions { tolerance, knots: Knots::Uniform, ..TensorOptions::default() };
        let report = fit_mesh(&cube, &options, &mut Control::new(1)).unwrap().report;
        assert!(report.max_interior_error > 10.0 * report.tolerance, "{report:?}");
        assert!(
            report.remarks.has(Remarks::ROUGH_BETWEEN_NODES) && report.facet_sagitta == 0.0,
            "{report:?}"
        );
    }
}
