//! What a fit over a layout with creases keeps exactly: corners, and planes beside the creases.
//!
//! All rules of the space are linear, so a crease lies in a plane if its unknowns do: positions in the plane itself, derivatives
//! in its directions. After each solution every unknown y of such creases goes to the nearest one that does,
//! ```text
//! y -= A^+ (A y - b)      A: normals of all planes of the unknown;  b: their offsets for a position, 0 for a derivative
//! ```
//! Gram and Schmidt make the normals orthonormal; one that nearly follows from those before adds nothing.

use crate::surface::g1::Space;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// The points x with `normal . x = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneEquation {
    /// Of length 1.
    pub normal: DVec3,
    /// Distance of the origin, against the normal.
    pub offset: f64,
}

/// What is known of the vertices and edges of a layout.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Constraints {
    /// Vertices at corners of the mesh: the nodes there stay.
    pub corners: Vec<u32>,
    /// The planes.
    pub planes: Vec<PlaneEquation>,
    /// Planes, by number, in which a sharp edge lies.
    pub of_edges: BTreeMap<u32, Vec<u32>>,
    /// Planes, by number, through a vertex, also those that only meet it there.
    pub of_vertices: BTreeMap<u32, Vec<u32>>,
}

/// Planes below this distance from those before, as sine of the angle, say nothing new.
const INDEPENDENT: f64 = 1e-3;

/// Orthonormal rows of one unknown, with their offsets.
#[derive(Debug, Clone)]
struct Held {
    unknown: u32,
    rows: Vec<(DVec3, f64)>,
}

/// The constraints of a space as they act on its unknowns.
#[derive(Debug, Clone, Default)]
pub(super) struct Projector(Vec<Held>);

impl Projector {
    /// For the unknowns of a space.
    pub(super) fn new(space: &Space, constraints: &Constraints) -> Self {
        // by unknown: whether it is a position, and its planes
        let mut planes_of: BTreeMap<u32, (bool, BTreeSet<u32>)> = BTreeMap::new();
        for crease in space.crease_unknowns() {
            let planes = constraints.of_edges.get(&crease.edge).into_iter().flatten();
            planes_of
                .entry(crease.unknown)
                .or_insert_with(|| (crease.is_position, BTreeSet::new()))
                .1
                .extend(planes);
        }
        for (&vertex, planes) in &constraints.of_vertices {
            let Some(unknown) = space.vertex_unknown(vertex) else { continue };
            planes_of.entry(unknown).or_insert_with(|| (true, BTreeSet::new())).1.extend(planes);
        }
        let held = |(unknown, (is_position, planes)): (u32, (bool, BTreeSet<u32>))| {
            let planes = planes.into_iter().map(|plane| constraints.planes[plane as usize]);
            let rows = orthonormal(planes, is_position);
            (!rows.is_empty()).then_some(Held { unknown, rows })
        };
        Self(planes_of.into_iter().filter_map(held).collect())
    }

    /// Moves the unknowns, three numbers each, on to their planes, and mends what that does to the enclosure equations
    /// of the space with the others.
    pub(super) fn apply(&self, space: &Space, unknowns: &mut [f64]) {
        if self.0.is_empty() {
            return;
        }
        for held in &self.0 {
            let row = &mut unknowns[3 * held.unknown as usize..][..3];
            row.copy_from_slice(&moved_into(&held.rows, DVec3::from_slice(row)).to_array());
        }
        self.enclose(space, unknowns);
    }

    /// The least change of unknowns without planes that meets the enclosure equations: `C C^T z = C y`, `y -= C^T z`.
    fn enclose(&self, space: &Space, unknowns: &mut [f64]) {
        let count = space.enclosures().len();
        if count == 0 {
            return;
        }
        let held: BTreeSet<u32> = self.0.iter().map(|held| held.unknown).collect();
        let rows: Vec<BTreeMap<u32, f64>> = space
            .enclosures()
            .iter()
            .map(|enclosure| {
                enclosure.sum.terms().iter().copied().filter(|(unknown, _)| !held.contains(unknown)).collect()
            })
            .collect();
        let dot = |a: &BTreeMap<u32, f64>, b: &BTreeMap<u32, f64>| -> f64 {
            a.iter().filter_map(|(unknown, x)| Some(x * b.get(unknown)?)).sum()
        };
        let gram = faer::Mat::from_fn(count, count, |i, j| dot(&rows[i], &rows[j])).partial_piv_lu();
        for component in 0..3 {
            for _ in 0..2 {
                let miss = faer::Mat::from_fn(count, 1, |i, _| {
                    let terms = space.enclosures()[i].sum.terms().iter();
                    terms.map(|&(unknown, x)| x * unknowns[3 * unknown as usize + component]).sum::<f64>()
                });
                let shares = faer::linalg::solvers::Solve::solve(&gram, &miss);
                for (i, row) in rows.iter().enumerate() {
                    for (&unknown, x) in row {
                        unknowns[3 * unknown as usize + component] -= x * shares[(i, 0)];
                    }
                }
            }
        }
    }
}

/// The place in planes that is nearest to a point.
pub(super) fn nearest_in(planes: impl Iterator<Item = PlaneEquation>, point: DVec3) -> DVec3 {
    moved_into(&orthonormal(planes, true), point)
}

fn moved_into(rows: &[(DVec3, f64)], mut point: DVec3) -> DVec3 {
    // once more, for the rounding of the first time
    for _ in 0..2 {
        for &(normal, offset) in rows {
            point -= (normal.dot(point) - offset) * normal;
        }
    }
    point
}

/// The planes as orthonormal rows.
fn orthonormal(planes: impl Iterator<Item = PlaneEquation>, is_position: bool) -> Vec<(DVec3, f64)> {
    let mut rows: Vec<(DVec3, f64)> = Vec::new();
    for PlaneEquation { normal, offset } in planes {
        let (mut rest, mut offset) = (normal, if is_position { offset } else { 0.0 });
        for &(row, at) in &rows {
            let share = rest.dot(row);
            rest -= share * row;
            offset -= share * at;
        }
        let length = rest.length();
        if length > INDEPENDENT && rows.len() < 3 {
            rows.push((rest / length, offset / length));
        }
    }
    rows
}
