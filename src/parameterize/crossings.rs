//! Where the boundary of a map meets itself.
//!
//! Without flips and without such meetings a map covers no place twice, and its trims are simple polygons.

use crate::geometry::visit_meetings;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use glam::DVec2;
use std::ops::ControlFlow;

/// Whether any two pieces of the boundary meet other than at a common node.
pub(super) fn boundary_crosses(mesh: &Mesh, uv: &[DVec2]) -> bool {
    visit_boundary(mesh, uv, |_, _| ControlFlow::Break(())).is_break()
}

/// The nodes at the ends of pieces of the boundary that meet others elsewhere than at a common node; some several
/// times.
pub(crate) fn crossing_nodes(mesh: &Mesh, uv: &[DVec2]) -> Vec<u32> {
    let mut nodes = Vec::new();
    let _ = visit_boundary(mesh, uv, |first, second| {
        memory::extend(&mut nodes, first);
        memory::extend(&mut nodes, second);
        ControlFlow::Continue(())
    });
    nodes
}

fn visit_boundary(
    mesh: &Mesh,
    uv: &[DVec2],
    visit: impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let pieces = mesh.boundary_edges().collect_vec();
    visit_meetings(pieces, |node| uv[node as usize], visit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn meetings_are_seen_however_slight() {
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let mesh = Mesh::new(
            [(0., 0.), (1., 0.), (1., 1.), (0., 1.), (0.5, 0.5)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
            triangles,
        )
        .unwrap();
        let crosses = |places: [(f64, f64); 5]| boundary_crosses(&mesh, &places.map(DVec2::from));
        let middle = (0.5, 0.5);
        assert!(!crosses([(0., 0.), (1., 0.), (1., 1.), (0., 1.), middle]));
        // a bow tie; a corner on the opposite side, exactly or a rounding short of it; a spike
        assert!(crosses([(0., 0.), (1., 1.), (1., 0.), (0., 1.), middle]));
        assert!(crosses([(0., 0.), (1., 0.), (0.25, 0.0), (0., 1.), middle]));
        assert!(!crosses([(0., 0.), (1., 0.), (0.25, f64::EPSILON), (0., 1.), middle]));
        assert!(crosses([(0., 0.), (1., 0.), (0.5, 0.0), (0., 1.), middle]));
    }
}
