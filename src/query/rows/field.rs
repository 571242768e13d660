//! The harmonic field between two sources, and its levels.
//!
//! The field is the weighted mean of its neighbours in every node that is no source. Weights are the cotangents of
//! U. Pinkall and K. Polthier, "Computing discrete minimal surfaces and their conjugates" (1993), held positive, so that
//! the field has no extrema but its sources (maximum principle).

use super::{SampleRowsError, half_edges};
use crate::linalg::SymbolicCholesky;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use sprs::TriMat;

/// Cotangents are kept in this range. The lower end keeps the maximum principle; it must not be so small that rounding
/// makes flat places of the field, nor so large that obtuse triangles bend it. The upper end keeps needles finite.
const COTANGENTS: (f64, f64) = (1e-2, 1e3);

/// The field that is 0 on the first source and 1 on the second.
pub(super) fn harmonic(mesh: &Mesh, sources: &[Vec<u32>; 2]) -> Result<Vec<f64>, SampleRowsError> {
    let mut field = memory::filled(f64::NAN, mesh.points().len());
    for (value, source) in [0.0, 1.0].into_iter().zip(sources) {
        for &node in source {
            if !field[node as usize].is_nan() && field[node as usize] != value {
                return Err(SampleRowsError::SameSource { node });
            }
            field[node as usize] = value;
        }
    }
    let mut unknown = memory::filled(usize::MAX, field.len());
    let mut count = 0;
    for node in 0..field.len() {
        if field[node].is_nan() && mesh.is_used(node as u32) {
            unknown[node] = count;
            count += 1;
        }
    }
    let mut lower = TriMat::new((count, count));
    let mut right = memory::filled(0.0, count);
    for (edge, nodes) in half_edges(mesh) {
        let weight = cotangent(mesh, edge);
        for [node, other] in [nodes, [nodes[1], nodes[0]]] {
            let (row, column) = (unknown[node as usize], unknown[other as usize]);
            if row == usize::MAX {
                continue;
            }
            lower.add_triplet(row, row, weight);
            match column {
                usize::MAX => right[row] += weight * field[other as usize],
                _ if row > column => lower.add_triplet(row, column, -weight),
                _ => {}
            }
        }
    }
    let lower: sprs::CsMat<f64> = lower.to_csc();
    let symbolic = SymbolicCholesky::new(&lower.view(), None);
    symbolic.factor(&lower.view())?.solve(&mut right, 1);
    for (value, &unknown) in field.iter_mut().zip(&unknown).filter(|(_, unknown)| **unknown != usize::MAX) {
        *value = right[unknown].clamp(0.0, 1.0);
    }
    Ok(field)
}

/// Of the angle opposite to a half-edge.
fn cotangent(mesh: &Mesh, edge: HalfEdge) -> f64 {
    let at = |edge: HalfEdge| mesh.points()[edge.origin(mesh.triangles()) as usize];
    let apex = at(edge.previous());
    let (a, b) = (at(edge) - apex, at(edge.next()) - apex);
    let cotangent = a.dot(b) / a.cross(b).length();
    if cotangent.is_nan() { COTANGENTS.0 } else { cotangent.clamp(COTANGENTS.0, COTANGENTS.1) }
}

/// Levels between which, and beside the outer ones half as much, the area of the mesh is the same. The area of a
/// triangle counts as spread evenly over the values that it has.
pub(super) fn levels_of_equal_area(mesh: &Mesh, field: &[f64], count: usize) -> Vec<f64> {
    // where the area per value changes, and by how much
    let mut changes = memory::with_capacity(2 * mesh.triangles().len());
    for nodes in mesh.triangles() {
        let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
        let values = nodes.map(|node| field[node as usize]);
        let (least, most) =
            (values.iter().copied().fold(1.0, f64::min), values.iter().copied().fold(0.0, f64::max));
        if most > least {
            let density = (b - a).cross(c - a).length() / (most - least);
            memory::extend(&mut changes, [(least, density), (most, -density)]);
        }
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    // values, and the area below them
    let (mut density, mut below) = (0.0, vec![(0.0, 0.0)]);
    for (value, change) in changes {
        let (from, area) = below[below.len() - 1];
        memory::push(&mut below, (value, area + density * (value - from)));
        density += change;
    }
    let whole = below[below.len() - 1].1;
    let level = |row: usize| {
        let wanted = (row as f64 + 0.5) / count as f64 * whole;
        let k = below.partition_point(|&(_, area)| area < wanted).clamp(1, below.len() - 1);
        let ((from, less), (to, more)) = (below[k - 1], below[k]);
        from + (to - from) * if more > less { (wanted - less) / (more - less) } else { 0.0 }
    };
    (0..count).map(level).collect_vec()
}
