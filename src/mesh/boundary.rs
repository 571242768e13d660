//! The boundary of a mesh, edge by edge, and what closes it.

use super::Mesh;
use glam::DVec3;

impl Mesh {
    /// The edges of all boundary loops, from node to node as the loops run: the mesh lies on their left.
    pub fn boundary_edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.loops().iter().flat_map(|nodes| loop_edges(nodes))
    }
}

/// The edges of a loop, the closing one last.
pub(crate) fn loop_edges(nodes: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    nodes.iter().zip(nodes.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

/// Closes a boundary loop by a fan of triangles around the mean of its nodes, which is the last point then.
pub(crate) fn close_loop(nodes: &[u32], points: &mut Vec<DVec3>, triangles: &mut Vec<[u32; 3]>) {
    let tip = points.len() as u32;
    let sum: DVec3 = nodes.iter().map(|&node| points[node as usize]).sum();
    points.push(sum / nodes.len() as f64);
    // the loop runs with the mesh on its left, so the fan takes its edges the other way
    triangles.extend(loop_edges(nodes).map(|[a, b]| [b, a, tip]));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_closed_on_the_other_side() {
        let points = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]].map(DVec3::from_array);
        let mesh = Mesh::new(points.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        assert_eq!(mesh.boundary_edges().collect::<Vec<_>>(), [[0, 1], [1, 2], [2, 3], [3, 0]]);
        let (mut points, mut triangles) = (mesh.points().to_vec(), mesh.triangles().to_vec());
        close_loop(&mesh.loops()[0], &mut points, &mut triangles);
        assert_eq!(points[4], DVec3::new(0.5, 0.5, 0.0));
        let closed = Mesh::new(points, triangles).unwrap();
        assert!(closed.loops().is_empty() && closed.boundary_edges().next().is_none());
        assert_eq!((closed.triangles().len(), closed.genus()), (6, 0));
    }
}
