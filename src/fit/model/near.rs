//! The mesh under each patch: nearest points and normals that never come from across a crease.

use crate::layout::{Layout, Place};
use crate::mesh::Mesh;
use crate::query::triangles::TriangleTree;
use glam::DVec3;

/// A smooth piece of the mesh.
struct Region {
    tree: TriangleTree<Mesh>,
    /// By triangle of the piece, its number in the whole.
    triangles: Vec<u32>,
}

/// The nearest place of the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub point: DVec3,
    pub distance: f64,
    pub triangle: u32,
}

/// The pieces of a mesh cut along creases, by the quads that lie over them.
pub(super) struct NearMesh {
    regions: Vec<Region>,
    /// By quad, its region; those of a piece of the layout without nodes search them all.
    of_quads: Vec<Option<u32>>,
}

impl NearMesh {
    /// The components of a mesh whose nodes have places on a layout. A layout in one smooth piece lies over all of them.
    pub(super) fn new(mesh: &Mesh, layout: &Layout, places: impl Iterator<Item = (u32, Place)>) -> Self {
        let piece_of = layout.smooth_pieces();
        let piece_count = piece_of.iter().max().map_or(0, |&piece| piece as usize + 1);
        let (labels, count) = mesh.topology().components();
        let whole = || {
            let triangles = (0..mesh.triangles().len() as u32).collect();
            let region = Region { tree: TriangleTree::new(mesh.clone()), triangles };
            Self { regions: vec![region], of_quads: vec![Some(0); piece_of.len()] }
        };
        if piece_count <= 1 || count <= 1 {
            return whole();
        }
        let mut label_of_node = vec![u32::MAX; mesh.points().len()];
        for (triangle, &label) in mesh.triangles().iter().zip(&labels) {
            triangle.iter().for_each(|&node| label_of_node[node as usize] = label);
        }
        // most nodes of a piece are in its component; on creases a place may say the other side
        let mut votes = vec![vec![0_u32; count]; piece_count];
        for (node, place) in places {
            let label = label_of_node[node as usize];
            if label != u32::MAX {
                votes[piece_of[place.quad as usize] as usize][label as usize] += 1;
            }
        }
        let winner = |votes: &Vec<u32>| {
            let most = votes.iter().copied().max().filter(|&most| most > 0)?;
            votes.iter().position(|&count| count == most).map(|label| label as u32)
        };
        let of_pieces: Vec<Option<u32>> = votes.iter().map(winner).collect();
        let mut triangles: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (triangle, &label) in (0..).zip(&labels) {
            triangles[label as usize].push(triangle);
        }
        let Ok(parts) = mesh.split_components() else { return whole() };
        let region = |(part, triangles): (crate::mesh::Piece, Vec<u32>)| Region {
            tree: TriangleTree::new(part.mesh),
            triangles,
        };
        Self {
            regions: parts.into_iter().zip(triangles).map(region).collect(),
            of_quads: piece_of.iter().map(|&piece| of_pieces[piece as usize]).collect(),
        }
    }

    /// The place of a quad's piece of the mesh that is nearest to a point.
    pub(super) fn nearest(&self, quad: u32, point: DVec3) -> Option<Near> {
        let of_quad = self.of_quads[quad as usize];
        let regions = match of_quad {
            Some(region) => &self.regions[region as usize..=region as usize],
            None => &self.regions[..],
        };
        let nearest = regions.iter().filter_map(|region| {
            let near = region.tree.nearest(point)?;
            let triangle = region.triangles[near.triangle as usize];
            Some(Near { point: near.point, distance: near.distance, triangle })
        });
        nearest.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}
