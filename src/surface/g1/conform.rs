//! Meshes whose vertices agree along the edges of a layout.

use crate::layout::{Edge, Layout, Side};
use crate::tmesh::{NodeId, TMesh, TMeshError, Vertex};

/// One mesh a quad, each split `level` times everywhere.
pub fn uniform(layout: &Layout, level: u32) -> Result<Vec<TMesh>, TMeshError> {
    let mut mesh = TMesh::new(&[0.0, 1.0], &[0.0, 1.0])?;
    for _ in 0..level {
        let leaves: Vec<NodeId> = mesh.leaves().collect();
        leaves.into_iter().for_each(|leaf| mesh.split(leaf));
    }
    Ok(vec![mesh; layout.quads().len()])
}

/// Splits leaves on the sides of quads until both sides of each edge have the same vertices: always the leaf on
/// the coarser side, so no leaf becomes smaller than the smallest.
pub fn conform(layout: &Layout, meshes: &mut [TMesh]) {
    let mut is_changed = true;
    while is_changed {
        is_changed = false;
        for edge in layout.edges() {
            while match_sides(edge, meshes) {
                is_changed = true;
            }
        }
    }
}

/// Splits the larger of two leaves that begin at the same place of an edge; whether any was split.
fn match_sides(edge: &Edge, meshes: &mut [TMesh]) -> bool {
    let Some(second) = edge.second else { return false };
    let a = leaves_along(&meshes[edge.first.quad as usize], edge.first);
    let mut b = leaves_along(&meshes[second.quad as usize], second);
    let unit = Vertex::side_at(0);
    b.reverse();
    b.iter_mut().for_each(|leaf| leaf.from = unit - leaf.from - leaf.length);
    let (mut k, mut l, mut is_split) = (0, 0, false);
    while k < a.len() && l < b.len() {
        let (x, y) = (&a[k], &b[l]);
        if x.from == y.from && x.length != y.length {
            let (quad, leaf) = if x.length > y.length { (edge.first.quad, x) } else { (second.quad, y) };
            meshes[quad as usize].split(leaf.node);
            is_split = true;
        }
        let (x_end, y_end) = (x.from + x.length, y.from + y.length);
        k += usize::from(x_end <= y_end);
        l += usize::from(y_end <= x_end);
    }
    is_split
}

/// A leaf on a side.
struct SideLeaf {
    node: NodeId,
    from: u32,
    length: u32,
}

/// The leaves along a side, in its direction.
fn leaves_along(mesh: &TMesh, side: Side) -> Vec<SideLeaf> {
    let unit = Vertex::side_at(0);
    // on the sides 2 and 3 the direction is against u or v
    let mut leaves = Vec::new();
    let mut at = 0;
    while at < unit {
        let (vertex, quadrant) = match side.side {
            0 => (Vertex { i: at, j: 0 }, [1, 1]),
            1 => (Vertex { i: unit, j: at }, [0, 1]),
            2 => (Vertex { i: unit - at, j: unit }, [0, 0]),
            _ => (Vertex { i: 0, j: unit - at }, [1, 0]),
        };
        let node = mesh.leaf_beside(vertex, quadrant).expect("the side lies in the domain");
        let length = mesh.cell(node).side();
        leaves.push(SideLeaf { node, from: at, length });
        at += length;
    }
    leaves
}
