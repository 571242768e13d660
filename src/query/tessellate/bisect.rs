//! Tessellation of surfaces over triangles, as fine as each place asks.
//!
//! M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques", Int. J.
//! Numer. Meth. Engng. 20 (1984), 745-756: the middle of an edge that is too far from the surface, or the edge too long,
//! becomes a node; every triangle that gets a node is divided at the middle of its longest edge first, so that no angle
//! falls below half of the smallest at the start, and no node lies inside an edge.
//! ```text
//!        c              c              c              c         longest edge a b;
//!       / \            /|\            /|\            /|\        divided: none, it alone,
//!      /   \          / | \          / | q          p | q       it and one more, all three
//!     /     \        /  |  \        /  |/ \        / \|/ \
//!    a-------b      a---m---b      a---m---b      a---m---b
//! ```
//! The error is measured at the middles of all edges and of all triangles, on the surface. Kinks that no edge follows
//! end the division of their neighbourhood after [`MOST_ROUNDS`].

use super::error::TessellateError;
use super::tessellation::{Tessellation, distance_to_segment, least_angle};
use crate::control::{Cancelled, Watch};
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::Facets;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Rounds of division: two of them halve a triangle's size.
const MOST_ROUNDS: usize = 16;

/// Chord tolerance where none is given, as a share of the diagonal: that of fits, and what the eye takes for smooth.
pub const CHORD_SHARE: f64 = 1e-3;

/// When a tessellation is fine enough.
pub(super) struct Fineness {
    /// 0 takes [`CHORD_SHARE`] of the diagonal.
    pub chord_tolerance: f64,
    /// 0 for no limit.
    pub max_edge_length: f64,
    pub max_points: usize,
}

/// Triangles near enough to the surface.
pub(super) fn tessellate_facets(
    surface: &dyn Facets,
    fineness: &Fineness,
    watch: &Watch,
) -> Result<Tessellation, TessellateError> {
    let mut division = Division::new(surface, fineness, watch)?;
    for _ in 0..MOST_ROUNDS {
        division.measure()?;
        if !division.mark()? {
            break;
        }
        division.divide()?;
    }
    division.measure()?;
    division.finish()
}

/// The middle of an edge, which may become a node.
#[derive(Debug, Clone, Copy)]
struct Middle {
    uv: DVec2,
    point: DVec3,
    /// Its distance from the edge.
    error: f64,
    length: f64,
    is_marked: bool,
    /// [`NONE`] while it is none.
    node: u32,
}

#[derive(Debug, Clone, Copy)]
struct Triangle {
    nodes: [u32; 3],
    facet: u32,
    /// The distance of the surface from its middle; NaN until it is measured.
    error: f64,
}

const NONE: u32 = u32::MAX;

struct Division<'a> {
    surface: &'a dyn Facets,
    fineness: &'a Fineness,
    watch: &'a Watch,
    tolerance: f64,
    uv: Vec<DVec2>,
    points: Vec<DVec3>,
    triangles: Vec<Triangle>,
    middles: HashMap<[u32; 2], Middle>,
}

/// Both triangles of an edge know it by this.
fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [edge(a, b), edge(b, c), edge(c, a)]
}

impl<'a> Division<'a> {
    fn new(
        surface: &'a dyn Facets,
        fineness: &'a Fineness,
        watch: &'a Watch,
    ) -> Result<Self, TessellateError> {
        let facets = surface.triangles();
        if facets.is_empty() {
            return Err(TessellateError::Empty);
        }
        // only corners that facets use
        let mut numbers = memory::filled(NONE, surface.places().len());
        let (mut uv, mut points, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for (facet, corners) in facets.iter().enumerate() {
            watch.check_at(facet)?;
            let mut row = [0.0; 9];
            let places = corners.map(|corner| surface.places()[corner as usize]);
            surface.eval_on_facet(facet, &places, &mut row);
            let nodes = [0, 1, 2].map(|k| {
                let number = &mut numbers[corners[k] as usize];
                if *number == NONE {
                    *number = uv.len() as u32;
                    memory::push(&mut uv, places[k]);
                    memory::push(&mut points, DVec3::from_slice(&row[3 * k..]));
                }
                *number
            });
            memory::push(&mut triangles, Triangle { nodes, facet: facet as u32, error: f64::NAN });
        }
        let around = points
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), &p: &DVec3| (min.min(p), max.max(p)));
        let asked = fineness.chord_tolerance;
        let tolerance = if asked > 0.0 { asked } else { CHORD_SHARE * around.0.distance(around.1) };
        let middles = HashMap::new();
        let division = Self { surface, fineness, watch, tolerance, uv, points, triangles, middles };
        division.check_count()?;
        Ok(division)
    }

    fn check_count(&self) -> Result<(), TessellateError> {
        match self.points.len() > self.fineness.max_points {
            true => Err(TessellateError::TooLarge { limit: self.fineness.max_points }),
            false => Ok(()),
        }
    }

    /// Evaluates the middles of what is new.
    fn measure(&mut self) -> Result<(), TessellateError> {
        for index in 0..self.triangles.len() {
            self.watch.check_at(index)?;
            let Triangle { nodes, facet, error } = self.triangles[index];
            if !error.is_nan() {
                continue;
            }
            let fresh = edges(nodes).into_iter().filter(|edge| !self.middles.contains_key(edge));
            let fresh: Vec<[u32; 2]> = fresh.collect_vec();
            let place = |node: u32| self.uv[node as usize];
            let mut uv: Vec<DVec2> = fresh.iter().map(|&[a, b]| (place(a) + place(b)) / 2.0).collect_vec();
            memory::push(&mut uv, nodes.map(place).iter().sum::<DVec2>() / 3.0);
            let mut rows = memory::filled(0.0, 3 * uv.len());
            self.surface.eval_on_facet(facet as usize, &uv, &mut rows);
            let corners = nodes.map(|node| self.points[node as usize]);
            let middle = DVec3::from_slice(&rows[3 * fresh.len()..]);
            self.triangles[index].error = distance_to_plane(middle, corners);
            for ((&edge, &uv), row) in fresh.iter().zip(&uv).zip(rows.chunks_exact(3)) {
                let [a, b] = edge.map(|node| self.points[node as usize]);
                let point = DVec3::from_slice(row);
                let (error, length) = (distance_to_segment(point, a, b), a.distance(b));
                let middle = Middle { uv, point, error, length, is_marked: false, node: NONE };
                memory::reserve_entry(&mut self.middles);
                self.middles.insert(edge, middle);
            }
        }
        Ok(())
    }

    /// Marks the edges to divide; false if there are none.
    fn mark(&mut self) -> Result<bool, Cancelled> {
        let longest_allowed =
            if self.fineness.max_edge_length > 0.0 { self.fineness.max_edge_length } else { f64::INFINITY };
        let mut is_any = false;
        for (index, Triangle { nodes, error, .. }) in self.triangles.iter().enumerate() {
            self.watch.check_at(index)?;
            for edge in edges(*nodes) {
                let middle = self.middles.get_mut(&edge).expect("measured");
                let is_far = middle.error > self.tolerance || *error > self.tolerance;
                middle.is_marked |= is_far || middle.length > longest_allowed;
                is_any |= middle.is_marked;
            }
        }
        // the longest edge first: until no triangle asks for more
        let mut has_grown = is_any;
        while has_grown {
            has_grown = false;
            for (index, triangle) in self.triangles.iter().enumerate() {
                self.watch.check_at(index)?;
                let around = edges(triangle.nodes);
                let longest = around[self.longest(triangle.nodes)];
                if around.iter().any(|edge| self.middles[edge].is_marked) && !self.middles[&longest].is_marked
                {
                    self.middles.get_mut(&longest).expect("measured").is_marked = true;
                    has_grown = true;
                }
            }
        }
        Ok(is_any)
    }

    /// Which edge of a triangle is the longest; of equally long ones the same from both sides.
    fn longest(&self, nodes: [u32; 3]) -> usize {
        let around = edges(nodes);
        let key = |k: usize| (self.middles[&around[k]].length, around[k]);
        (1..3).fold(0, |best, k| {
            let (a, b) = (key(best), key(k));
            if a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).is_lt() { k } else { best }
        })
    }

    /// Divides all triangles with marked edges.
    fn divide(&mut self) -> Result<(), TessellateError> {
        let mut divided = memory::with_capacity(2 * self.triangles.len());
        for index in 0..self.triangles.len() {
            self.watch.check_at(index)?;
            let triangle = self.triangles[index];
            let first = self.longest(triangle.nodes);
            let [a, b, c] = [0, 1, 2].map(|k| triangle.nodes[(first + k) % 3]);
            let [Some(m), q, p] = [edge(a, b), edge(b, c), edge(c, a)].map(|edge| self.node_at(edge)) else {
                memory::push(&mut divided, triangle);
                continue;
            };
            let facet = triangle.facet;
            let mut add = |nodes| memory::push(&mut divided, Triangle { nodes, facet, error: f64::NAN });
            match p {
                Some(p) => [[a, m, p], [m, c, p]].into_iter().for_each(&mut add),
                None => add([a, m, c]),
            }
            match q {
                Some(q) => [[m, b, q], [m, q, c]].into_iter().for_each(&mut add),
                None => add([m, b, c]),
            }
        }
        self.triangles = divided;
        self.middles.retain(|_, middle| middle.node == NONE);
        self.check_count()
    }

    /// The node at the middle of a marked edge.
    fn node_at(&mut self, edge: [u32; 2]) -> Option<u32> {
        let middle = self.middles.get_mut(&edge).filter(|middle| middle.is_marked)?;
        if middle.node == NONE {
            middle.node = self.points.len() as u32;
            memory::push(&mut self.uv, middle.uv);
            memory::push(&mut self.points, middle.point);
        }
        Some(middle.node)
    }

    fn finish(self) -> Result<Tessellation, TessellateError> {
        let corners = |triangle: &Triangle| triangle.nodes.map(|node| self.points[node as usize]);
        let smallest_angle =
            self.triangles.iter().map(|t| least_angle(corners(t))).fold(f64::INFINITY, f64::min);
        let of_edges = self.middles.values().map(|middle| middle.error).fold(0.0, f64::max);
        let chord_error = self.triangles.iter().map(|t| t.error).fold(of_edges, f64::max);
        let mut mesh = Mesh::new(self.points, self.triangles.iter().map(|t| t.nodes).collect_vec())?;
        mesh.set_parameters(self.uv)?;
        Ok(Tessellation { mesh, smallest_angle, chord_error })
    }
}

/// Of a triangle; the distance from its first corner where it has no area.
fn distance_to_plane(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    match (b - a).cross(c - a).try_normalize() {
        Some(normal) => (p - a).dot(normal).abs(),
        None => p.distance(a),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::grid;
    use crate::surface::Surface;
    use crate::surface::d1rc::{D1rcOptions, D1rcSurface};

    /// A D1RC-spline over a grid of control vertices.
    fn spline(counts: [usize; 2], height: impl Fn(DVec2) -> f64) -> D1rcSurface {
        let (places, triangles) = grid(counts, 0.2, 3, |_| true);
        let points = places.iter().map(|p| p.extend(height(*p))).collect();
        let mut mesh = Mesh::new(points, triangles).unwrap();
        mesh.set_parameters(places).unwrap();
        D1rcSurface::from_mesh(&mesh, &D1rcOptions::default(), &[], &[]).unwrap()
    }

    fn tessellated(surface: &D1rcSurface, chord_tolerance: f64) -> Tessellation {
        let fineness = Fineness { chord_tolerance, max_edge_length: 0.0, max_points: 1_000_000 };
        tessellate_facets(surface.facets().unwrap().as_ref(), &fineness, &Watch::default()).unwrap()
    }

    #[test]
    fn the_chord_tolerance_is_kept_everywhere() {
        let surface = spline([6, 5], |p| p.length_squared());
        for chord_tolerance in [1e-2, 1e-3, 1e-4] {
            let Tessellation { mesh, chord_error, .. } = tessellated(&surface, chord_tolerance);
            assert!(chord_error <= chord_tolerance, "{chord_error}");
            assert!(mesh.is_disk(), "neighbours share their nodes");
            let uv = mesh.parameters().unwrap();
            let mut rows = vec![0.0; 3 * uv.len()];
            surface.eval_rows(uv, 0, &mut rows);
            for (row, point) in rows.chunks_exact(3).zip(mesh.points()) {
                // the same functions from this or that side of an edge
                assert!(DVec3::from_slice(row).distance(*point) <= 1e-14);
            }
            // between the places measured a quadratic piece bulges no more than four thirds
            for t in mesh.triangles() {
                let at = t
                    .iter()
                    .map(|&n| uv[n as usize])
                    .zip([0.6, 0.3, 0.1])
                    .map(|(uv, w)| w * uv)
                    .sum::<DVec2>();
                let mut row = [0.0; 3];
                surface.eval_rows(&[at], 0, &mut row);
                let corners = t.map(|n| mesh.points()[n as usize]);
                let off = distance_to_plane(DVec3::from_array(row), corners);
                assert!(off <= 1.5 * chord_tolerance, "{off} is more than {chord_tolerance}");
            }
        }
    }

    #[test]
    fn only_what_bends_is_divided() {
        // flat but for a bump in one corner
        let surface = spline([21, 21], |p| 0.2 * (-((p - 0.2).length_squared()) / 0.005).exp());
        let faces = surface.facets().unwrap().triangles().len();
        let (coarse, fine) = (tessellated(&surface, 1e-3), tessellated(&surface, 1e-5));
        let counts = [&coarse, &fine].map(|made| made.mesh.triangles().len());
        assert!(counts[0] < 3 * faces, "{counts:?} of {faces}");
        assert!(fine.chord_error <= 1e-5 && counts[1] < 400 * counts[0], "{counts:?}");
    }

    #[test]
    fn limits_are_for_what_is_returned() {
        let surface = spline([6, 5], |p| p.length_squared());
        let facets = surface.facets().unwrap();
        let count = tessellated(&surface, 1e-3).mesh.points().len();
        let with = |max_points: usize| {
            let fineness = Fineness { chord_tolerance: 1e-3, max_edge_length: 0.0, max_points };
            tessellate_facets(facets.as_ref(), &fineness, &Watch::default())
        };
        assert_eq!(with(count).unwrap().mesh.points().len(), count);
        assert_eq!(with(count - 1).unwrap_err(), TessellateError::TooLarge { limit: count - 1 });
        let fineness = Fineness { chord_tolerance: 1.0, max_edge_length: 0.05, max_points: 1_000_000 };
        let mesh = tessellate_facets(facets.as_ref(), &fineness, &Watch::default()).unwrap().mesh;
        for t in mesh.triangles() {
            let [a, b, c] = t.map(|n| mesh.points()[n as usize]);
            assert!(a.distance(b).max(b.distance(c)).max(c.distance(a)) <= 0.05);
        }
    }
}
