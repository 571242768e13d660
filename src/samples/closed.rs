//! Closed meshes of any genus.

use super::Random;
use crate::mesh::{Mesh, MeshError};
use glam::{DVec3, IVec3};
use std::collections::BTreeMap;

/// A block with rounded edges and `holes` round-ish holes through it in a row. Each unit of length has `fineness` cells;
/// `rounding` sweeps of smoothing round it.
pub fn block(holes: usize, fineness: u32, rounding: usize) -> Result<Mesh, MeshError> {
    let fine = fineness as i32;
    let size = IVec3::new(2 * holes as i32 + 1, 3, 1) * fine;
    let is_solid = |cell: IVec3| {
        let is_in_block = cell.cmpge(IVec3::ZERO).all() && cell.cmplt(size).all();
        // holes have a unit of material around them
        let is_in_hole = (cell.x / fine) % 2 == 1 && cell.y / fine == 1;
        is_in_block && !is_in_hole
    };
    let mut numbers: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for cell in cells(size).filter(|&cell| is_solid(cell)) {
        for (normal, corners) in SIDES {
            if is_solid(cell + IVec3::from(normal)) {
                continue;
            }
            let [a, b, c, d] = corners.map(|corner| {
                let at = cell + IVec3::from(corner);
                *numbers.entry(at.to_array()).or_insert_with(|| {
                    points.push(at.as_dvec3() / f64::from(fine));
                    points.len() as u32 - 1
                })
            });
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    round(&mut points, &triangles, rounding);
    Mesh::new(points, triangles)
}

/// A block of up to six holes, its number of nodes, thickness, a limb at one end and noise by its seed, and words for them.
pub fn seeded_block(seed: u64) -> Result<(String, Mesh), MeshError> {
    let mut random = Random::new(seed);
    let holes = (random.unit() * 7.0) as usize;
    let fineness = 2 + (random.unit() * 6.0 / (1.0 + holes as f64).sqrt()) as u32;
    let mesh = block(holes, fineness.max(3), 2 + (random.unit() * 8.0) as usize)?;
    // thin plates and limbs: one direction shorter, or a bend that draws one end out
    let flat = [1.0, 0.3, 0.1][(random.unit() * 3.0) as usize];
    let limb = random.unit();
    let size = mesh.points().iter().fold(0.0, |size: f64, p| size.max(p.x));
    let moved = |p: &DVec3| {
        let along = p.x / size;
        DVec3::new(
            p.x * (1.0 + 2.0 * limb * along),
            p.y * (1.0 - 0.5 * limb * along),
            flat * p.z + 0.3 * along * along,
        )
    };
    let mesh = Mesh::new(mesh.points().iter().map(moved).collect(), mesh.triangles().to_vec())?;
    let noise = 0.2 * random.unit();
    let words = format!("genus {holes}, flat {flat}, limb {limb:.2}, noise {noise:.2}");
    Ok((words, with_noise(&mesh, noise, seed)?))
}

/// The same mesh with its nodes moved along the normals by normally distributed steps, in parts of the mean edge length.
pub fn with_noise(mesh: &Mesh, deviation: f64, seed: u64) -> Result<Mesh, MeshError> {
    let mut normals = vec![DVec3::ZERO; mesh.points().len()];
    let (mut length, mut count) = (0.0, 0.0);
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
        for node in triangle {
            normals[*node as usize] += (b - a).cross(c - a);
        }
        length += a.distance(b) + b.distance(c) + c.distance(a);
        count += 3.0;
    }
    let mut random = Random::new(seed);
    // the sum of twelve uniform numbers is nearly normal, of variance 4 for numbers in [-1, 1]
    let mut normal = || (0..12).map(|_| random.signed()).sum::<f64>() / 2.0;
    let moved = mesh.points().iter().zip(&normals);
    let points =
        moved.map(|(&point, n)| point + deviation * length / count * normal() * n.normalize_or_zero());
    Mesh::new(points.collect(), mesh.triangles().to_vec())
}

fn cells(size: IVec3) -> impl Iterator<Item = IVec3> {
    (0..size.x)
        .flat_map(move |x| (0..size.y).flat_map(move |y| (0..size.z).map(move |z| IVec3::new(x, y, z))))
}

/// Each node goes to the mean of its neighbours and itself, again and again, a step back for every step on so that
/// nothing shrinks (G. Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995).
fn round(points: &mut [DVec3], triangles: &[[u32; 3]], sweeps: usize) {
    for sweep in 0..2 * sweeps {
        let mut sums = vec![(DVec3::ZERO, 0.0); points.len()];
        for &[a, b, c] in triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                sums[from as usize].0 += points[to as usize];
                sums[from as usize].1 += 1.0;
            }
        }
        let step = if sweep % 2 == 0 { 0.5 } else { -0.52 };
        for (point, (sum, count)) in points.iter_mut().zip(sums) {
            *point += step * (sum / count - *point);
        }
    }
}

/// The sides of a cell: where the next cell is, and the corners counterclockwise from outside.
const SIDES: [([i32; 3], [[i32; 3]; 4]); 6] = [
    ([-1, 0, 0], [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]]),
    ([1, 0, 0], [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]),
    ([0, -1, 0], [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]),
    ([0, 1, 0], [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]]),
    ([0, 0, -1], [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]]),
    ([0, 0, 1], [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_as_many_handles_as_holes() {
        for holes in [0, 1, 2, 5] {
            let mesh = block(holes, 4, 6).unwrap();
            assert_eq!((mesh.loops().len(), mesh.component_count(), mesh.genus()), (0, 1, holes));
            let noisy = with_noise(&mesh, 0.1, 7).unwrap();
            assert_eq!(noisy.genus(), holes);
        }
    }
}
