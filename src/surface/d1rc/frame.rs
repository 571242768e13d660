//! The triangulation whose links are taken: the parameter mesh, cut along its creases, with rings of knots beyond
//! its boundary.
//!
//! Links close around inner knots only, so `k` rings of clones go around every boundary:
//! ```text
//!            interior              for each boundary edge and ring two triangles;
//!   a0 -------------- b0           outer boundary: clones j steps outside and a little aside, `phantom`: real
//!    |  \_             |           knots whose control points continue the surface affinely; or `clamped`: as
//!    |     \_          |           creases are.
//!   a1 -------\------ b1           crease: each side of a cut has vertices of its own, clones of them lie between
//!    .                 .           the cut and the vertex, which steps back to make room while links are built.
//!   ak . . . . . . .  bk           Then all fall back on the vertex: k + 1 equal knots.
//! ```
//! A slit that ends inside the mesh is a boundary like any other: the vertex at its tip keeps one copy, stepping
//! back ahead of the slit.

use super::configuration::mean_row;
use super::error::D1rcError;
use super::locate::Locator;
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec2;
use std::f64::consts::TAU;

/// The border of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// Real knots beyond it, whose control points continue the surface: smooth everywhere.
    #[default]
    Phantom,
    /// Repeated knots on it: the boundary polygon is interpolated.
    Clamped,
    /// No knots beyond it: the domain shrinks by some rings of faces.
    Open,
}

/// The triangulation whose links are taken.
#[derive(Debug, Default)]
pub(super) struct Frame {
    /// Of the knots while links are built.
    pub link_places: Vec<DVec2>,
    /// Of the knots in the functions.
    pub places: Vec<DVec2>,
    /// The vertex of the parameter mesh that each knot was.
    pub origins: Vec<u32>,
    /// The share of each vertex of the control mesh in a knot's control point.
    pub rows: Vec<Vec<(u32, f64)>>,
    pub triangles: Vec<[u32; 3]>,
    /// By vertex of the parameter mesh: whether its knots are repeated.
    pub is_clamped: Vec<bool>,
}

/// Clones of clamped knots are this close, against the smallest height of a face there: near enough for links to
/// see each cluster as one point, far enough for the predicates not to need all their digits.
const CLUSTER: f64 = 0.01;
/// By ring, how far a phantom knot stands aside, as a share of the way to the next of its ring. Knots straight outside
/// a vertex would be collinear with it and the edge behind it, and the surface nearly kinked along that line; farther
/// aside they make fits worse beside the border.
const ASIDE: [f64; 3] = [0.06, 0.02, 0.05];
/// Corners sharper than this (the sine of half the angle) do not push their clones any farther.
const SHARPEST: f64 = 0.25;
/// Phantom rings shrink to half this often before the boundary is refused.
const MOST_HALVINGS: usize = 24;

/// The parameter mesh as the frame sees it.
pub(super) struct Plane<'a> {
    pub mesh: &'a Mesh,
    pub places: &'a [DVec2],
    /// The control point of each vertex.
    pub rows: &'a [Vec<(u32, f64)>],
    /// By half-edge: whether the mesh is cut there.
    pub cut: &'a [bool],
    /// By vertex: whether it is to be interpolated.
    pub is_fixed: &'a [bool],
}

impl Frame {
    /// The parameter mesh, cut, with `degree` rings around it.
    pub(super) fn new(plane: &Plane, boundary: Boundary, degree: usize) -> Result<Self, D1rcError> {
        let mut builder = Builder::new(plane, boundary, degree);
        builder.split_vertices();
        builder.step_back();
        builder.add_clusters()?;
        builder.add_rings()?;
        Ok(builder.frame)
    }
}

/// The triangles around a copy of a vertex on a boundary.
struct Sector {
    half_edges: Vec<HalfEdge>,
    knot: u32,
    is_clamped: bool,
}

struct Builder<'a> {
    plane: &'a Plane<'a>,
    boundary: Boundary,
    degree: usize,
    frame: Frame,
    /// By half-edge: the knot at the corner it leaves.
    corners: Vec<u32>,
    /// Those on a boundary, by knot.
    sectors: Vec<Option<Sector>>,
}

impl<'a> Builder<'a> {
    fn new(plane: &'a Plane<'a>, boundary: Boundary, degree: usize) -> Self {
        let count = plane.places.len();
        let frame = Frame {
            link_places: memory::copied(plane.places),
            places: memory::copied(plane.places),
            origins: (0..count as u32).collect_vec(),
            rows: memory::copied(plane.rows),
            triangles: Vec::new(),
            is_clamped: memory::filled(false, count),
        };
        let corners = plane.mesh.triangles().iter().flatten().copied().collect_vec();
        Self { plane, boundary, degree, frame, corners, sectors: Vec::new() }
    }

    /// Gives each sector of a cut vertex a knot, the first keeps the vertex's.
    fn split_vertices(&mut self) {
        let mesh = self.plane.mesh;
        memory::reserve(&mut self.sectors, self.plane.places.len());
        self.sectors.resize_with(self.plane.places.len(), || None);
        for vertex in 0..self.plane.places.len() as u32 {
            let Some(start) = mesh.topology().first(vertex) else { continue };
            for (number, half_edges) in mesh.sectors(start, self.plane.cut).into_iter().enumerate() {
                if !self.is_boundary(half_edges[0]) {
                    continue; // all around an inner vertex
                }
                let knot =
                    if number == 0 { vertex } else { self.copy(vertex, self.plane.places[vertex as usize]) };
                half_edges.iter().for_each(|half_edge| self.corners[half_edge.index()] = knot);
                let ends = [half_edges[0], half_edges[half_edges.len() - 1].previous()];
                let is_clamped = self.boundary == Boundary::Clamped
                    || self.plane.is_fixed[vertex as usize]
                    || ends.iter().any(|&end| self.is_crease(end));
                self.frame.is_clamped[vertex as usize] |= is_clamped;
                self.sectors[knot as usize] = Some(Sector { half_edges, knot, is_clamped });
            }
        }
        self.frame.triangles = memory::copied(self.corners.as_chunks().0);
    }

    /// A further knot with the control point of another.
    fn copy(&mut self, knot: u32, place: DVec2) -> u32 {
        let frame = &mut self.frame;
        memory::push(&mut frame.link_places, place);
        memory::push(&mut frame.places, place);
        let (origin, row) = (frame.origins[knot as usize], frame.rows[knot as usize].clone());
        memory::push(&mut frame.origins, origin);
        memory::push(&mut frame.rows, row);
        memory::push(&mut self.sectors, None);
        frame.places.len() as u32 - 1
    }

    fn is_crease(&self, half_edge: HalfEdge) -> bool {
        self.plane.cut[half_edge.index()]
    }

    fn is_boundary(&self, half_edge: HalfEdge) -> bool {
        self.is_crease(half_edge) || self.plane.mesh.topology().twin(half_edge).is_none()
    }

    /// The direction into a sector that leaves both of its borders at the speed 1.
    fn inward(&self, sector: &Sector) -> DVec2 {
        let place =
            |half_edge: HalfEdge| self.plane.places[half_edge.origin(self.plane.mesh.triangles()) as usize];
        let angle: f64 = sector
            .half_edges
            .iter()
            .map(|&h| (place(h.next()) - place(h)).angle_to(place(h.previous()) - place(h)))
            .sum();
        let half = angle.clamp(0.0, TAU) / 2.0;
        let first = sector.half_edges[0];
        let along = (place(first.next()) - place(first)).normalize();
        DVec2::from_angle(half).rotate(along) / half.sin().max(SHARPEST)
    }

    /// Moves clamped knots back from their boundaries, for their clones to lie in between.
    fn step_back(&mut self) {
        let step = self.cluster_step();
        let steps: Vec<(u32, DVec2)> = self
            .sectors
            .iter()
            .flatten()
            .filter(|sector| sector.is_clamped)
            .map(|sector| (sector.knot, (self.degree + 1) as f64 * step * self.inward(sector)))
            .collect_vec();
        for (knot, step) in steps {
            self.frame.link_places[knot as usize] += step;
        }
    }

    /// From one clone of a clamped knot to the next.
    fn cluster_step(&self) -> f64 {
        let clamped = self.sectors.iter().flatten().filter(|sector| sector.is_clamped);
        let faces = clamped.flat_map(|sector| &sector.half_edges).map(|half_edge| half_edge.triangle());
        let heights = faces.map(|face| self.height(face));
        CLUSTER / (self.degree + 1) as f64 * heights.fold(f64::INFINITY, f64::min)
    }

    /// The smallest height of a face.
    fn height(&self, face: usize) -> f64 {
        let [a, b, c] = self.plane.mesh.triangles()[face].map(|v| self.plane.places[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).perp_dot(c - a) / longest
    }

    /// Clones of inner vertices to be interpolated, each in a face of its own beside the vertex.
    fn add_clusters(&mut self) -> Result<(), D1rcError> {
        let plane = self.plane;
        let mut is_taken = memory::filled(false, plane.mesh.triangles().len());
        let is_inner = |this: &Self, v: usize| this.sectors[v].is_none() && plane.mesh.is_used(v as u32);
        let fixed = (0..plane.places.len()).filter(|&v| plane.is_fixed[v] && is_inner(self, v));
        for vertex in fixed.collect::<Vec<usize>>() {
            self.frame.is_clamped[vertex] = true;
            let around: Vec<HalfEdge> =
                plane.mesh.outgoing(vertex as u32).filter(|h| !is_taken[h.triangle()]).collect_vec();
            if around.len() < self.degree {
                return Err(D1rcError::NoRoom { vertex });
            }
            for number in 0..self.degree {
                let half_edge = around[number * around.len() / self.degree];
                is_taken[half_edge.triangle()] = true;
                self.add_clone_in(half_edge);
            }
        }
        Ok(())
    }

    /// A clone of the origin of a half-edge, close to it inside the triangle, which falls into three.
    fn add_clone_in(&mut self, half_edge: HalfEdge) {
        let face = half_edge.triangle();
        let [v, a, b] = [half_edge, half_edge.next(), half_edge.previous()].map(|h| self.corners[h.index()]);
        let [at, p, q] = [v, a, b].map(|knot| self.frame.link_places[knot as usize]);
        let clone = self.copy(v, self.frame.places[v as usize]);
        let inward = (p - at).normalize() + (q - at).normalize();
        self.frame.link_places[clone as usize] = at + CLUSTER * self.height(face) * inward;
        self.frame.triangles[face] = [v, a, clone];
        memory::extend(&mut self.frame.triangles, [[a, b, clone], [b, v, clone]]);
    }

    fn add_rings(&mut self) -> Result<(), D1rcError> {
        let locator =
            Locator::new(memory::copied(self.plane.places), memory::copied(self.plane.mesh.triangles()));
        let cluster_step = self.cluster_step();
        for line in self.boundary_lines() {
            let outer: Vec<f64> = line
                .iter()
                .filter_map(|&knot| self.out_edge(knot).filter(|&edge| !self.is_crease(edge)))
                .map(|edge| self.length(edge))
                .collect_vec();
            // half an edge, the natural distance of knots that continue the mesh
            let mut step = 0.5 * outer.iter().sum::<f64>() / outer.len().max(1) as f64;
            let mut halvings = 0;
            loop {
                let size = (self.frame.places.len(), self.frame.triangles.len());
                match self.add_ring(&line, [cluster_step, step], &locator) {
                    Ok(()) => break,
                    Err(vertex) if halvings == MOST_HALVINGS => return Err(D1rcError::NoRoom { vertex }),
                    Err(_) => self.forget_after(size),
                }
                step /= 2.0;
                halvings += 1;
            }
        }
        Ok(())
    }

    fn forget_after(&mut self, (knots, triangles): (usize, usize)) {
        let frame = &mut self.frame;
        frame.link_places.truncate(knots);
        frame.places.truncate(knots);
        frame.origins.truncate(knots);
        frame.rows.truncate(knots);
        frame.triangles.truncate(triangles);
        self.sectors.truncate(knots);
    }

    /// The boundary half-edge that leaves a knot, the interior on its left.
    fn out_edge(&self, knot: u32) -> Option<HalfEdge> {
        self.sectors[knot as usize].as_ref().map(|sector| sector.half_edges[0])
    }

    fn length(&self, half_edge: HalfEdge) -> f64 {
        let [from, to] = [half_edge, half_edge.next()]
            .map(|h| self.plane.places[h.origin(self.plane.mesh.triangles()) as usize]);
        from.distance(to)
    }

    /// The closed lines of knots that bound the cut mesh, by their smallest knot.
    fn boundary_lines(&self) -> Vec<Vec<u32>> {
        let mut seen = memory::filled(false, self.sectors.len());
        let mut lines = Vec::new();
        for start in 0..self.sectors.len() as u32 {
            let mut line = Vec::new();
            let mut knot = start;
            while let Some(edge) = self.out_edge(knot).filter(|_| !seen[knot as usize]) {
                seen[knot as usize] = true;
                memory::push(&mut line, knot);
                knot = self.corners[edge.next().index()];
            }
            memory::extend(&mut lines, (!line.is_empty()).then_some(line));
        }
        lines
    }

    /// Clones of all knots of a line, and the triangles between; or a vertex where there is no room for them.
    fn add_ring(&mut self, line: &[u32], steps: [f64; 2], locator: &Locator) -> Result<(), usize> {
        let clones: Vec<Vec<u32>> = line.iter().map(|&knot| self.add_clones(knot, steps)).collect_vec();
        let vertex = |this: &Self, knot: u32| this.frame.origins[knot as usize] as usize;
        for (k, &knot) in line.iter().enumerate() {
            let next = (k + 1) % line.len();
            let [a, b] = [&clones[k], &clones[next]];
            let Some(edge) = self.out_edge(knot) else { continue };
            if self.boundary == Boundary::Open && !self.is_crease(edge) {
                continue;
            }
            for j in 1..=self.degree {
                for triangle in [[b[j - 1], a[j - 1], a[j]], [b[j - 1], a[j], b[j]]] {
                    let [p, q, r] = triangle.map(|knot| self.frame.link_places[knot as usize]);
                    if orientation(p, q, r) != Orientation::Positive {
                        return Err(vertex(self, knot));
                    }
                    memory::push(&mut self.frame.triangles, triangle);
                }
                let is_phantom = self.frame.places[a[j] as usize] != self.plane.places[vertex(self, knot)];
                if is_phantom && locator.find(self.frame.places[a[j] as usize]).is_some() {
                    return Err(vertex(self, knot));
                }
            }
        }
        Ok(())
    }

    /// A knot and its clones, ring by ring; the knot alone where no ring passes.
    fn add_clones(&mut self, knot: u32, [cluster_step, step]: [f64; 2]) -> Vec<u32> {
        let mut clones = vec![knot];
        let Some(sector) = &self.sectors[knot as usize] else { return clones };
        let (is_clamped, inward) = (sector.is_clamped, self.inward(sector));
        let next = self.corners[sector.half_edges[0].next().index()] as usize;
        let next = self.sectors[next].as_ref().filter(|next| !next.is_clamped);
        let next = next.map(|next| (self.frame.places[next.knot as usize], self.inward(next)));
        let place = self.frame.places[knot as usize];
        for ring in 1..=self.degree {
            if is_clamped {
                let clone = self.copy(knot, place);
                let left = (self.degree + 1 - ring) as f64;
                self.frame.link_places[clone as usize] = place + left * cluster_step * inward;
                memory::push(&mut clones, clone);
            } else if self.boundary == Boundary::Phantom {
                let outside = |place: DVec2, inward: DVec2| place - ring as f64 * step * inward;
                let here = outside(place, inward);
                let next = next.map_or(here, |(place, inward)| outside(place, inward));
                let offset = here.lerp(next, ASIDE[ring - 1]) - place;
                let clone = self.copy(knot, place + offset);
                self.frame.rows[clone as usize] = self.extrapolated(knot, offset);
                memory::push(&mut clones, clone);
            }
        }
        clones
    }

    /// The control point of a place beside a knot: with the mean gradient of the faces around, by area.
    fn extrapolated(&self, knot: u32, offset: DVec2) -> Vec<(u32, f64)> {
        let mut row = self.frame.rows[knot as usize].clone();
        let Some(sector) = &self.sectors[knot as usize] else { return row };
        let faces = || {
            sector
                .half_edges
                .iter()
                .map(|&h| [h, h.next(), h.previous()].map(|h| h.origin(self.plane.mesh.triangles()) as usize))
        };
        let corners = |face: [usize; 3]| face.map(|vertex| self.plane.places[vertex]);
        let area: f64 = faces().map(corners).map(|[a, b, c]| (b - a).perp_dot(c - a)).sum();
        for face in faces() {
            let [a, b, c] = corners(face);
            for (vertex, side) in face.into_iter().zip([c - b, a - c, b - a]) {
                let share = side.perp().dot(offset) / area;
                row.extend(self.plane.rows[vertex].iter().map(|&(v, weight)| (v, share * weight)));
            }
        }
        mean_row([row.as_slice()].into_iter())
    }
}
