//! Where the data lie in the parameter plane of a control mesh.
//!
//! The boundary of a coarser mesh cuts corners, so nodes of the boundary go to the nearest place on its boundary, and
//! so does what lies outside; nodes of sharp edges go to the nearest place on its sharp edges. A control mesh that
//! was made elsewhere has a plane of its own: there each node gets the parameters of its nearest place in space.

use crate::control::Pool;
use crate::mesh::Mesh;
use crate::query::triangles::TriangleTree;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// The parameters of nodes over one control mesh.
pub struct Placement {
    pub uv: Vec<DVec2>,
    /// By node: whether it lies on the boundary or a sharp edge and has to stay there.
    pub is_held: Vec<bool>,
}

impl Placement {
    /// In the plane that a mesh shares with the control mesh made of it; `sharp` are the sharp edges of both.
    pub fn in_plane(fine: &Mesh, coarse: &Mesh, sharp: (&[[u32; 2]], &[[u32; 2]]), pool: &Pool) -> Self {
        let [uv, places] = [fine, coarse].map(|mesh| mesh.parameters().unwrap_or_default());
        let sides = |edges: &mut dyn Iterator<Item = [u32; 2]>| -> Vec<[DVec2; 2]> {
            edges.map(|edge| edge.map(|node| places[node as usize])).collect()
        };
        let boundary = sides(&mut boundary_edges(coarse));
        let creases = sides(&mut sharp.1.iter().copied());
        let mut kinds = vec![Kind::Free; uv.len()];
        sharp.0.iter().flatten().for_each(|&node| kinds[node as usize] = Kind::Crease);
        fine.loops().iter().flatten().for_each(|&node| kinds[node as usize] = Kind::Boundary);
        let is_held = kinds.iter().map(|&kind| kind != Kind::Free).collect();
        let flat = flat(coarse, places);
        let tree = flat.as_ref().map(TriangleTree::new);
        let place = |(&uv, kind): (&DVec2, Kind)| match kind {
            Kind::Boundary => nearest(uv, &boundary),
            Kind::Crease => nearest(uv, &creases),
            Kind::Free => {
                let near = tree.as_ref().and_then(|tree| tree.nearest(uv.extend(0.0)));
                near.filter(|near| near.distance > 0.0).map_or(uv, |near| near.point.truncate())
            }
        };
        let uv = pool.run(|| uv.par_iter().zip(kinds).map(place).collect());
        Self { uv, is_held }
    }

    /// From nearest places in space.
    pub fn in_space(mesh: &Mesh, coarse: &Mesh, pool: &Pool) -> Self {
        let places = coarse.parameters().unwrap_or_default();
        let tree = TriangleTree::new(coarse);
        let place = |&point: &DVec3| {
            let Some(near) = tree.nearest(point) else { return DVec2::ZERO };
            let nodes = coarse.triangles()[near.triangle as usize].map(|node| node as usize);
            let shares = barycentric(near.point, nodes.map(|node| coarse.points()[node]));
            nodes.iter().zip(shares).map(|(&node, share)| share * places[node]).sum()
        };
        let uv = pool.run(|| mesh.points().par_iter().map(place).collect());
        let mut is_held = vec![false; mesh.points().len()];
        mesh.loops().iter().flatten().for_each(|&node| is_held[node as usize] = true);
        Self { uv, is_held }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Free,
    Crease,
    Boundary,
}

/// A mesh of the parameters.
fn flat(mesh: &Mesh, uv: &[DVec2]) -> Option<Mesh> {
    Mesh::new(uv.iter().map(|uv| uv.extend(0.0)).collect(), mesh.triangles().to_vec()).ok()
}

fn boundary_edges(mesh: &Mesh) -> impl Iterator<Item = [u32; 2]> {
    mesh.loops()
        .iter()
        .flat_map(|nodes| nodes.iter().zip(nodes.iter().cycle().skip(1)).map(|(&from, &to)| [from, to]))
}

/// The nearest place on some segments; the point itself if there are none.
fn nearest(point: DVec2, segments: &[[DVec2; 2]]) -> DVec2 {
    let on = |&[from, to]: &[DVec2; 2]| {
        let along = to - from;
        from + ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along
    };
    let distance = |place: &DVec2| place.distance_squared(point);
    segments.iter().map(on).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(point)
}

/// The shares of the corners of a triangle in a place on it.
fn barycentric(place: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let share = |from: DVec3, to: DVec3| {
        let area = (to - from).cross(place - from).dot(normal) / normal.length_squared();
        if area.is_finite() { area.clamp(0.0, 1.0) } else { 1.0 / 3.0 }
    };
    let (of_b, of_c) = (share(c, a), share(a, b));
    [1.0 - of_b - of_c, of_b, of_c]
}
