//! How smooth a surface of patches really is, and what it encloses: measured on the finished surfaces.

use super::SpaceError;
use crate::layout::{Layout, Side};
use crate::summary::sum;
use crate::surface::pht::PhtSurface;
use crate::surface::{Patches, Surface};
use crate::tmesh::Vertex;
use glam::{DVec2, DVec3};

/// What separates patches along their common edges.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jump {
    /// Largest |N_A - N_B| of the unit normals, at smooth edges.
    pub normal: f64,
    /// Largest distance between the sides of an edge.
    pub gap: f64,
    /// The edge where the normal jumps most.
    pub edge: usize,
}

/// Places in each segment of an edge.
const PER_SEGMENT: usize = 7;
/// Places from the ends: where derivatives are blended, a mistake shows next to them.
const NEAR_ENDS: [f64; 4] = [0.0, 1e-6, 1e-4, 1e-2];

/// Measures the jumps between patches: inside all segments of all edges, and close to their ends.
pub fn normal_jump(layout: &Layout, surfaces: &[PhtSurface]) -> Result<Jump, SpaceError> {
    if surfaces.len() != layout.quads().len() {
        return Err(SpaceError::MeshCount { meshes: surfaces.len(), quads: layout.quads().len() });
    }
    let mut jump = Jump::default();
    for (number, edge) in layout.edges().iter().enumerate() {
        let Some(second) = edge.second else { continue };
        let breaks = breaks(&surfaces[edge.first.quad as usize], edge.first);
        let mut places: Vec<f64> = NEAR_ENDS.iter().flat_map(|&s| [s, 1.0 - s]).collect();
        for pair in breaks.windows(2) {
            let at = |k: usize| pair[0] + (pair[1] - pair[0]) * (k as f64 + 0.5) / PER_SEGMENT as f64;
            places.extend((0..PER_SEGMENT).map(at));
        }
        let reversed: Vec<f64> = places.iter().map(|s| 1.0 - s).collect();
        let a = points_and_normals(&surfaces[edge.first.quad as usize], edge.first, &places);
        let b = points_and_normals(&surfaces[second.quad as usize], second, &reversed);
        for ((p, n), (q, m)) in a.into_iter().zip(b) {
            jump.gap = jump.gap.max(p.distance(q));
            let distance = n.distance(m);
            if layout.is_smooth(number as u32) && !(distance <= jump.normal) {
                (jump.normal, jump.edge) = (distance, number);
            }
        }
    }
    Ok(jump)
}

/// The parameters along a side at which its polynomials meet.
fn breaks(surface: &PhtSurface, side: Side) -> Vec<f64> {
    let unit = Vertex::side_at(0);
    let to_fraction = |at: u32| f64::from(at) / f64::from(unit);
    let vertices = surface.jets().map(|(vertex, _)| vertex);
    let mut breaks: Vec<f64> = vertices
        .map(|vertex| side.coordinates(DVec2::new(to_fraction(vertex.i), to_fraction(vertex.j))))
        .filter(|&[_, q]| q == 0.0)
        .map(|[t, _]| t)
        .collect();
    breaks.sort_unstable_by(f64::total_cmp);
    breaks
}

fn points_and_normals(surface: &PhtSurface, side: Side, places: &[f64]) -> Vec<(DVec3, DVec3)> {
    let uv: Vec<DVec2> = places.iter().map(|&t| side.place(t, 0.0).uv).collect();
    let mut rows = vec![0.0; 9 * uv.len()];
    surface.eval_rows(&uv, 1, &mut rows);
    rows.chunks_exact(9)
        .map(|row| {
            let [point, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
            (point, along_u.cross(along_v).normalize())
        })
        .collect()
}

/// The volume that closed surfaces enclose, exactly: a third of the integral of S . (S_u x S_v), whose degree is 8 in each
/// direction.
pub fn enclosed_volume(surfaces: &[PhtSurface]) -> f64 {
    sum(surfaces.iter().flat_map(|surface| (0..surface.patch_count()).map(|cell| cell_volume(surface, cell))))
}

/// Gauss points per direction: exact to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (0.5, 64.0 / 225.0),
    (0.5 - 0.269_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.5 + 0.269_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.5 - 0.453_089_922_969_332, 0.118_463_442_528_094_5),
    (0.5 + 0.453_089_922_969_332, 0.118_463_442_528_094_5),
];

fn cell_volume(surface: &PhtSurface, cell: usize) -> f64 {
    let domain = surface.patch(cell).domain;
    let size = domain.size();
    let places = GAUSS.iter().flat_map(|(x, w)| GAUSS.iter().map(move |(y, z)| (DVec2::new(*x, *y), w * z)));
    let (uv, weights): (Vec<DVec2>, Vec<f64>) =
        places.map(|(at, weight)| (domain.min + at * size, weight)).unzip();
    let mut rows = vec![0.0; 9 * uv.len()];
    surface.eval_rows(&uv, 1, &mut rows);
    let shares = rows.chunks_exact(9).zip(weights).map(|(row, weight)| {
        let [point, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
        weight * point.dot(along_u.cross(along_v))
    });
    sum(shares) * size.x * size.y / 3.0
}
