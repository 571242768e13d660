//! Triangles in the parameter plane divided alike, so that neighbours share their nodes: each side of a face falls into
//! n parts.
//! ```text
//!   c                 node (i,j) of a face: a + i/n (b - a) + j/n (c - a)
//!   | \               corners are the mesh's; nodes of sides are counted once,
//!   o---o             from the end with the smaller number
//!   | \ | \
//!   a---o---b         n = 2
//! ```

use super::error::TessellateError;
use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::Facets;
use glam::{DVec2, DVec3};

/// A division into `parts` parts a side, as a mesh.
pub(crate) fn subdivided(
    surface: &dyn Facets,
    parts: usize,
    max_points: usize,
) -> Result<Mesh, TessellateError> {
    Division::new(surface, parts.max(1), max_points, &Watch::default())?.finish()
}

struct Division {
    parts: usize,
    /// The nodes of each face, row by row from the side opposite to c: see [`place_in_face`].
    nodes: Vec<u32>,
    face_count: usize,
    uv: Vec<DVec2>,
    points: Vec<DVec3>,
}

/// Where node (i,j) stands among those of its face.
fn place_in_face(parts: usize, i: usize, j: usize) -> usize {
    j * (parts + 1) - j * j.saturating_sub(1) / 2 + i
}

impl Division {
    fn new(
        surface: &dyn Facets,
        parts: usize,
        max_points: usize,
        watch: &Watch,
    ) -> Result<Self, TessellateError> {
        let faces = surface.triangles();
        if faces.is_empty() {
            return Err(TessellateError::Empty);
        }
        let places = surface.places();
        let sides = Sides::new(&faces);
        let per_side = parts - 1;
        let per_face = per_side * parts.saturating_sub(2) / 2;
        let side_start = places.len();
        let face_start = side_start + sides.count * per_side;
        let count = face_start + faces.len() * per_face;
        if count > max_points {
            return Err(TessellateError::TooLarge { limit: max_points });
        }
        let mut division = Self {
            parts,
            nodes: memory::with_capacity(faces.len() * (parts + 1) * (parts + 2) / 2),
            face_count: faces.len(),
            uv: memory::filled(DVec2::NAN, count),
            points: memory::filled(DVec3::NAN, count),
        };
        for (number, face) in faces.iter().enumerate() {
            watch.check()?;
            let mut inner = face_start + number * per_face;
            let first = division.nodes.len();
            for j in 0..=parts {
                for i in 0..=parts - j {
                    let k = parts - i - j;
                    // on side s the distance from its first corner, in parts
                    let node = match (i, j, k) {
                        (0, 0, _) => face[0] as usize,
                        (_, 0, 0) => face[1] as usize,
                        (0, _, 0) => face[2] as usize,
                        (_, 0, _) => side_start + sides.node(3 * number, i, parts),
                        (_, _, 0) => side_start + sides.node(3 * number + 1, j, parts),
                        (0, _, _) => side_start + sides.node(3 * number + 2, k, parts),
                        _ => {
                            inner += 1;
                            inner - 1
                        }
                    };
                    memory::push(&mut division.nodes, node as u32);
                }
            }
            division.evaluate(surface, number, face, first);
        }
        Ok(division)
    }

    /// The nodes of a face that no face before it had.
    fn evaluate(&mut self, surface: &dyn Facets, number: usize, face: &[u32; 3], first: usize) {
        let [a, b, c] = face.map(|corner| surface.places()[corner as usize]);
        let parts = self.parts as f64;
        let (mut fresh, mut uv) = (Vec::new(), Vec::new());
        for j in 0..=self.parts {
            for i in 0..=self.parts - j {
                let node = self.nodes[first + place_in_face(self.parts, i, j)] as usize;
                if self.uv[node].is_nan() {
                    let (s, t) = (i as f64 / parts, j as f64 / parts);
                    memory::push(&mut fresh, node);
                    uv.push(match (i, j) {
                        (0, 0) => a,
                        (i, 0) if i == self.parts => b,
                        (0, j) if j == self.parts => c,
                        _ => (1.0 - s - t) * a + s * b + t * c,
                    });
                }
            }
        }
        let mut rows = memory::filled(0.0, 3 * uv.len());
        surface.eval_on_facet(number, &uv, &mut rows);
        for ((&node, uv), row) in fresh.iter().zip(uv).zip(rows.chunks_exact(3)) {
            self.uv[node] = uv;
            self.points[node] = DVec3::from_slice(row);
        }
    }

    fn node(&self, face: usize, i: usize, j: usize) -> usize {
        let size = (self.parts + 1) * (self.parts + 2) / 2;
        self.nodes[face * size + place_in_face(self.parts, i, j)] as usize
    }

    fn finish(self) -> Result<Mesh, TessellateError> {
        let mut numbers = memory::filled(u32::MAX, self.points.len());
        let (mut points, mut uv, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for face in 0..self.face_count {
            for j in 0..self.parts {
                for i in 0..self.parts - j {
                    let lower = [(i, j), (i + 1, j), (i, j + 1)];
                    let upper = [(i + 1, j), (i + 1, j + 1), (i, j + 1)];
                    let has_upper = i + j + 1 < self.parts;
                    for corners in std::iter::once(lower).chain(has_upper.then_some(upper)) {
                        let nodes = corners.map(|(i, j)| self.node(face, i, j));
                        let triangle = nodes.map(|node| {
                            if numbers[node] == u32::MAX {
                                numbers[node] = points.len() as u32;
                                memory::push(&mut points, self.points[node]);
                                memory::push(&mut uv, self.uv[node]);
                            }
                            numbers[node]
                        });
                        memory::push(&mut triangles, triangle);
                    }
                }
            }
        }
        let mut mesh = Mesh::new(points, triangles)?;
        mesh.set_parameters(uv)?;
        Ok(mesh)
    }
}

/// The sides of all faces, each counted once.
struct Sides {
    /// By three times the face and the corner that a side leaves.
    numbers: Vec<u32>,
    /// Whether the side leaves the smaller of its ends.
    is_forward: Vec<bool>,
    count: usize,
}

impl Sides {
    fn new(faces: &[[u32; 3]]) -> Self {
        let ends = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
        let all: Vec<[u32; 2]> = faces.iter().flat_map(ends).collect_vec();
        let mut sorted: Vec<[u32; 2]> = all.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect_vec();
        sorted.sort_unstable();
        sorted.dedup();
        let number = |&[a, b]: &[u32; 2]| sorted.partition_point(|side| *side < [a.min(b), a.max(b)]) as u32;
        Self {
            numbers: all.iter().map(number).collect_vec(),
            is_forward: all.iter().map(|[a, b]| a < b).collect_vec(),
            count: sorted.len(),
        }
    }

    /// The node of a side so many parts from its first corner.
    fn node(&self, side: usize, from: usize, parts: usize) -> usize {
        let from = if self.is_forward[side] { from } else { parts - from };
        self.numbers[side] as usize * (parts - 1) + from - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::grid;
    use crate::surface::Surface;
    use crate::surface::d1rc::{D1rcOptions, D1rcSurface};

    fn bowl() -> D1rcSurface {
        let (places, triangles) = grid([6, 5], 0.2, 3, |_| true);
        let points = places.iter().map(|p| p.extend(p.length_squared())).collect();
        let mut mesh = Mesh::new(points, triangles).unwrap();
        mesh.set_parameters(places).unwrap();
        D1rcSurface::from_mesh(&mesh, &D1rcOptions::default(), &[], &[]).unwrap()
    }

    #[test]
    fn divisions_have_the_nodes_of_the_surface_and_no_seams() {
        let surface = bowl();
        let facets = surface.facets().unwrap();
        for parts in [1, 2, 3, 7] {
            let mesh = subdivided(facets.as_ref(), parts, 1_000_000).unwrap();
            assert_eq!(mesh.triangles().len(), 40 * parts * parts);
            assert!(mesh.is_disk() && mesh.loops()[0].len() == 18 * parts, "{parts} parts");
            let uv = mesh.parameters().unwrap();
            let mut rows = vec![0.0; 3 * uv.len()];
            surface.eval_rows(uv, 0, &mut rows);
            for (row, point) in rows.chunks_exact(3).zip(mesh.points()) {
                // the same functions from this or that side of an edge
                assert!(DVec3::from_slice(row).distance(*point) <= 1e-14, "{parts} parts");
            }
        }
    }
}
