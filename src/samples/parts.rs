//! Small relatives of scans and parts that come from elsewhere: what a head, a cast or a limb asks of a fit.

use super::{Random, mesh_over, outlined};
use crate::mesh::{Mesh, MeshError};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A bust, open at the neck, with two ears and a nose. About 2,100 nodes, no parameters.
pub fn bust(seed: u64) -> Result<Mesh, MeshError> {
    /// How far down the head goes, from the crown.
    const NECK: f64 = 0.8 * PI;
    const SPACING: f64 = 0.0425;
    // angle from the crown and around it, height and width
    const FEATURES: [(f64, f64, f64, f64); 3] =
        [(1.5, FRAC_PI_2, 0.45, 0.22), (1.5, -FRAC_PI_2, 0.45, 0.22), (1.6, 0.0, 0.3, 0.18)];
    let rim: Vec<DVec2> = circle((TAU / SPACING) as usize).collect();
    let direction =
        |down: f64, around: f64| DVec3::new(down.sin() * around.cos(), down.sin() * around.sin(), down.cos());
    let mut mesh = mesh_over(outlined(&[rim], SPACING, seed), |p| {
        // equal areas of the disk are equal areas of the sphere
        let down = 2.0 * (p.length() * (NECK / 2.0).sin()).asin();
        let at = direction(down, p.y.atan2(p.x));
        let bump = |(down, around, height, width): (f64, f64, f64, f64)| {
            height * (-(at.angle_between(direction(down, around)) / width).powi(2)).exp()
        };
        let radius = 1.0 + 0.1 * at.x * at.x + FEATURES.into_iter().map(bump).sum::<f64>();
        (radius * at, p)
    })?;
    mesh.clear_parameters();
    Ok(mesh)
}

/// An angle bracket with sharp edges all around and a square hole in its foot: closed, of genus 1, 1,080 nodes.
pub fn bracket() -> Result<Mesh, MeshError> {
    /// Cells of the foot along x and y, and of the wall along z; the thickness of both.
    const SIZE: [i32; 3] = [20, 12, 14];
    const THICKNESS: i32 = 4;
    let is_solid = |[i, j, k]: [i32; 3]| {
        let is_in_box = (0..3).all(|axis| (0..SIZE[axis]).contains(&[i, j, k][axis]));
        let is_hole = (10..16).contains(&i) && (3..9).contains(&j);
        is_in_box && (i < THICKNESS || (k < THICKNESS && !is_hole))
    };
    let (mut numbers, mut points, mut triangles) = (BTreeMap::new(), Vec::new(), Vec::new());
    let mut node = |at: [i32; 3]| {
        *numbers.entry(at).or_insert_with(|| {
            points.push(DVec3::from(at.map(f64::from)) / 10.0);
            points.len() as u32 - 1
        })
    };
    let cells =
        (0..SIZE[0]).flat_map(|i| (0..SIZE[1]).flat_map(move |j| (0..SIZE[2]).map(move |k| [i, j, k])));
    for cell in cells.filter(|&cell| is_solid(cell)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut beside = cell;
            beside[axis] += 2 * side - 1;
            if is_solid(beside) {
                continue;
            }
            // a square between solid and air, seen from the air
            let mut corner = |a: i32, b: i32| {
                let mut at = cell;
                at[axis] += side;
                at[(axis + 1) % 3] += a;
                at[(axis + 2) % 3] += b;
                node(at)
            };
            let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            triangles.extend(if side == 1 { [[p, q, r], [p, r, s]] } else { [[p, r, q], [p, s, r]] });
        }
    }
    Mesh::new(points, triangles)
}

/// A limb: a bent tube of varying girth with a sinew, closed at its far end. 1,369 nodes, no parameters.
pub fn limb(seed: u64) -> Result<Mesh, MeshError> {
    /// Nodes around, and rings along.
    const AROUND: usize = 36;
    const RINGS: usize = 38;
    let mut random = Random::new(seed);
    let mut points = vec![limb_place(0.0, 0.0)];
    for ring in 1..=RINGS {
        for k in 0..AROUND {
            let (along, around) = (0.3 * random.signed(), 0.3 * random.signed());
            // the last ring is the border, which is even
            let along = if ring < RINGS { along } else { 0.0 };
            // rings are denser at the end, where they become small
            let share = ((ring as f64 + along) / RINGS as f64).powf(1.3);
            points.push(limb_place(share, TAU * (k as f64 + around) / AROUND as f64));
        }
    }
    let node = |ring: usize, k: usize| (1 + (ring - 1) * AROUND + k % AROUND) as u32;
    let mut triangles: Vec<[u32; 3]> = (0..AROUND).map(|k| [0, node(1, k), node(1, k + 1)]).collect();
    for (ring, k) in (1..RINGS).flat_map(|ring| (0..AROUND).map(move |k| (ring, k))) {
        let [p, q, r, s] = [node(ring, k), node(ring + 1, k), node(ring + 1, k + 1), node(ring, k + 1)];
        triangles.extend([[p, q, r], [p, r, s]]);
    }
    Mesh::new(points, triangles)
}

/// The place of a limb at a share of its length from the far end, and at an angle around.
pub(super) fn limb_place(share: f64, around: f64) -> DVec3 {
    const LENGTH: f64 = 4.0;
    /// Length of the round end.
    const END: f64 = 0.6;
    let along = LENGTH * share;
    let girth = 0.42 + 0.1 * (1.8 * along).cos() * share;
    let round = if along < END { (1.0 - (1.0 - along / END).powi(2)).sqrt() } else { 1.0 };
    // flatter on one side, with a sinew that winds around it
    let beside = (around - 5.0 * share + PI).rem_euclid(TAU) - PI;
    let sinew = 0.15 * share * (-(beside / 0.3).powi(2)).exp();
    let radius = girth * round * (1.0 + 0.12 * (2.0 * around).cos() + sinew);
    let axis = DVec2::new(0.5 * (0.6 * along).sin(), 0.1 * along);
    (axis + radius * DVec2::from_angle(around)).extend(-along)
}

fn circle(count: usize) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |k| DVec2::from_angle(TAU * k as f64 / count as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::rocker;

    #[test]
    fn parts_have_the_topology_they_promise() {
        for (mesh, loops, genus, nodes) in [
            (bust(1), 1, 0, 1900..2400),
            (bust(2), 1, 0, 1900..2400),
            (limb(1), 1, 0, 1369..1370),
            (bracket(), 0, 1, 1080..1081),
            (rocker(1500, 1), 0, 1, 1200..1900),
        ] {
            let mesh = mesh.unwrap();
            assert_eq!((mesh.loops().len(), mesh.genus(), mesh.component_count()), (loops, genus, 1));
            assert!(nodes.contains(&mesh.points().len()), "{} nodes", mesh.points().len());
        }
    }
}
