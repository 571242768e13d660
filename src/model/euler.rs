//! Euler's formula: what counts of vertices, edges and faces are possible.

use super::{FaceId, Model};
use std::collections::{BTreeMap, BTreeSet};

impl Model {
    /// Whether each piece of the model is a surface with handles and holes: V - E + sum (2 - loops) = 2 - 2 H - B with a
    /// number H of handles that is whole and not negative, and B closed rows of free edges. Pieces whose free edges touch
    /// in a vertex are left out.
    pub(super) fn keeps_eulers_formula(&self) -> bool {
        self.pieces().iter().all(|faces| {
            let bounds = faces.iter().flat_map(|&face| &self.face(face).bounds);
            let edges: BTreeSet<_> = bounds.flatten().map(|coedge| coedge.edge).collect();
            let vertices: BTreeSet<_> = edges.iter().flat_map(|&edge| self.edge(edge).vertices).collect();
            let free: Vec<_> = edges.iter().filter(|&&edge| self.is_free(edge)).collect();
            let mut ends = BTreeMap::new();
            for vertex in free.iter().flat_map(|&&edge| self.edge(edge).vertices) {
                *ends.entry(vertex).or_insert(0) += 1;
            }
            if ends.values().any(|&count| count != 2) {
                return true;
            }
            // in closed rows each vertex joins two edges: rows are the pieces of that graph
            let mut root: BTreeMap<_, _> = ends.keys().map(|&vertex| (vertex, vertex)).collect();
            let mut row_count = ends.len() as i64;
            for &&edge in &free {
                let [a, b] = self.edge(edge).vertices.map(|mut vertex| {
                    while root[&vertex] != vertex {
                        vertex = root[&vertex];
                    }
                    vertex
                });
                if a != b {
                    root.insert(a, b);
                    row_count -= 1;
                }
            }
            let of_faces: i64 = faces.iter().map(|&face| 2 - self.face(face).bounds.len() as i64).sum();
            let handles_twice = 2 - row_count - (vertices.len() as i64 - edges.len() as i64 + of_faces);
            handles_twice >= 0 && handles_twice % 2 == 0
        })
    }

    /// The faces that hang together by edges.
    fn pieces(&self) -> Vec<Vec<FaceId>> {
        let mut is_seen = vec![false; self.faces().len()];
        let mut pieces = Vec::new();
        for seed in self.face_ids() {
            if is_seen[seed.index()] {
                continue;
            }
            is_seen[seed.index()] = true;
            let mut piece = vec![seed];
            let mut done = 0;
            while done < piece.len() {
                for coedge in self.face(piece[done]).bounds.iter().flatten() {
                    for at in self.uses(coedge.edge) {
                        if !std::mem::replace(&mut is_seen[at.face.index()], true) {
                            piece.push(at.face);
                        }
                    }
                }
                done += 1;
            }
            pieces.push(piece);
        }
        pieces
    }
}
