//! Seeded shapes for demonstrations, tests and benchmarks.
//!
//! Each is a tessellation with exact places; those with natural parameters carry them. The same seed gives the
//! same bits on every machine.

pub mod closed;
pub mod layouts;
pub mod machine;
mod parts;
pub mod rows;
mod solids;
mod strips;

pub use parts::{bracket, bust, limb};
pub use solids::{ball, handles, holed_block, rocker, starfish};
pub use strips::{Strips, wing_strips};

use crate::mesh::{Mesh, MeshError};
use crate::surface::{Domain, Trims};
use glam::{DVec2, DVec3};
use spade::{DelaunayTriangulation, Point2, Triangulation};
use std::f64::consts::PI;

/// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014): enough
/// for jitter, and the same everywhere.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next number in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

/// A triangulated grid on the unit square: the diagonals of its cells are drawn at random, inner nodes are moved
/// by up to `jitter` cells, and cells are kept where `keep` says so of their middle. Without a jitter the
/// places are exact fractions.
pub fn grid(
    [count_u, count_v]: [usize; 2],
    jitter: f64,
    seed: u64,
    keep: impl Fn(DVec2) -> bool,
) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut random = Random::new(seed);
    let cells = DVec2::new((count_u - 1) as f64, (count_v - 1) as f64);
    let mut places = Vec::with_capacity(count_u * count_v);
    for i in 0..count_u {
        for j in 0..count_v {
            let is_inner = (1..count_u - 1).contains(&i) && (1..count_v - 1).contains(&j);
            let moved = DVec2::new(random.signed(), random.signed()) * jitter;
            let place = DVec2::new(i as f64, j as f64) + if is_inner { moved } else { DVec2::ZERO };
            places.push(place / cells);
        }
    }
    let mut triangles = Vec::new();
    for i in 0..count_u - 1 {
        for j in 0..count_v - 1 {
            let node = |a: usize, b: usize| ((i + a) * count_v + j + b) as u32;
            let [p, q, r, s] = [node(0, 0), node(1, 0), node(1, 1), node(0, 1)];
            let middle = [p, q, r, s].iter().map(|&n| places[n as usize]).sum::<DVec2>() / 4.0;
            let rising = random.unit() < 0.5;
            if keep(middle) {
                triangles.extend(if rising { [[p, q, r], [p, r, s]] } else { [[p, q, s], [q, r, s]] });
            }
        }
    }
    (places, triangles)
}

/// The mesh of a map over such a grid, without the nodes that no triangle uses.
fn mesh_over(
    (places, triangles): (Vec<DVec2>, Vec<[u32; 3]>),
    map: impl Fn(DVec2) -> (DVec3, DVec2),
) -> Result<Mesh, MeshError> {
    let mut numbers = vec![u32::MAX; places.len()];
    let (mut points, mut uvs) = (Vec::new(), Vec::new());
    let mut number = |node: u32| {
        let entry = &mut numbers[node as usize];
        if *entry == u32::MAX {
            let (point, uv) = map(places[node as usize]);
            *entry = points.len() as u32;
            points.push(point);
            uvs.push(uv);
        }
        *entry
    };
    let triangles = triangles.into_iter().map(|triangle| triangle.map(&mut number)).collect();
    let mut mesh = Mesh::new(points, triangles)?;
    mesh.set_parameters(uvs)?;
    Ok(mesh)
}

/// The notched domain with a slot, a hole and a cut corner, 8 by 6, of [`planar`] and [`curved_notch`].
fn notched(place: DVec2) -> bool {
    let DVec2 { x, y } = place * DVec2::new(8.0, 6.0);
    let notch = x > 3.0 && x < 5.0 && y < 2.4;
    let slot = x > 6.2 && x < 7.0 && y > 1.4 && y < 2.6;
    let hole = (x - 2.0).powi(2) + (y - 4.0).powi(2) < 0.6;
    !(notch || slot || hole || x + y > 12.6)
}

/// A tilted plane with a notch and two holes.
pub fn planar(seed: u64) -> Result<Mesh, MeshError> {
    mesh_over(grid([90, 70], 0.25, seed, notched), |place| {
        let DVec2 { x: u, y: v } = place * DVec2::new(8.0, 6.0);
        let point = DVec3::new(1.0 + 0.8 * u + 0.1 * v, 2.0 - 0.3 * u + 0.9 * v, 0.5 + 0.4 * u - 0.2 * v);
        (point, DVec2::new(u, v))
    })
}

/// A smooth graph over the domain of [`planar`].
pub fn curved_notch(seed: u64) -> Result<Mesh, MeshError> {
    mesh_over(grid([90, 70], 0.25, seed, notched), |place| {
        let DVec2 { x: u, y: v } = place * DVec2::new(8.0, 6.0);
        let z = 1.2 * (0.5 * u).sin() * (0.35 * v).cos() + 0.05 * u * v;
        (DVec3::new(u, v, z), DVec2::new(u, v))
    })
}

/// Half a fuselage with v = y: the slope across is infinite at both long sides.
pub fn half_fuselage() -> Result<Mesh, MeshError> {
    const LENGTH: f64 = 8.0;
    mesh_over(grid([80, 70], 0.0, 3, |_| true), |place| {
        let (x, angle) = (LENGTH * place.x, PI * place.y);
        let radius = 1.0 + 0.25 * (PI * x / LENGTH).sin() - 0.12 * (x / LENGTH).powi(2);
        let is_end = place.y == 0.0 || place.y == 1.0;
        let y = if place.y == 1.0 { -radius } else { radius * angle.cos() };
        let z = if is_end { 0.0 } else { radius * angle.sin() };
        (DVec3::new(x, y, z), DVec2::new(x, y))
    })
}

/// The upper side of a tapered, swept, twisted NACA 4412 wing with a cut-out; u is the chord fraction, so the
/// slope is infinite at the nose.
pub fn wing() -> Result<Mesh, MeshError> {
    let keep = |place: DVec2| !(place.y > 0.55 && place.y < 0.8 && place.x > 0.62 && place.x < 0.8);
    mesh_over(grid([100, 60], 0.0, 4, keep), |place| {
        let x = 0.5 * (1.0 - (PI * place.x).cos());
        let thickness =
            0.6 * (0.2969 * x.sqrt() - 0.1260 * x - 0.3516 * x * x + 0.2843 * x.powi(3) - 0.1036 * x.powi(4));
        let (camber, at) = (0.04, 0.4);
        let camber = if x < at {
            camber / (at * at) * (2.0 * at * x - x * x)
        } else {
            camber / (1.0 - at).powi(2) * ((1.0 - 2.0 * at) + 2.0 * at * x - x * x)
        };
        let b = place.y;
        let (chord, twist) = (2.0 - 1.2 * b, (-4.0 * b).to_radians());
        let (along, up) = (chord * x, chord * (camber + thickness));
        let point = DVec3::new(
            1.5 * b + along * twist.cos() + up * twist.sin(),
            6.0 * b,
            0.4 * b - along * twist.sin() + up * twist.cos(),
        );
        (point, DVec2::new(x, 6.0 * b))
    })
}

/// A cap of the unit sphere with three round holes over stereographic parameters, about `count` nodes.
pub fn sphere_with_holes(count: usize, seed: u64) -> Result<Mesh, MeshError> {
    const CIRCLES: [(f64, f64, f64); 4] =
        [(0.0, 0.0, 0.9), (-0.35, 0.2, 0.16), (0.3, -0.25, 0.2), (0.25, 0.4, 0.1)];
    let spacing = (4.0 * CIRCLES[0].2 * CIRCLES[0].2 * 0.8 / count as f64).sqrt();
    let circle = |(x, y, radius): (f64, f64, f64)| {
        let count = ((2.0 * PI * radius / spacing) as usize).max(8);
        let place = move |k: usize| DVec2::from_angle(2.0 * PI * k as f64 / count as f64);
        (0..count).map(|k| DVec2::new(x, y) + radius * place(k)).collect()
    };
    mesh_over(outlined(&CIRCLES.map(circle), spacing, seed), |p| {
        let d = 1.0 + p.length_squared();
        (DVec3::new(2.0 * p.x, 2.0 * p.y, 2.0 - d) / d, p)
    })
}

/// A triangulation between outlines, the outer one first: the outlines' corners, and inside nodes of a jittered
/// hexagonal pattern `spacing` apart.
fn outlined(outlines: &[Vec<DVec2>], spacing: f64, seed: u64) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let domain = Domain::around(outlines[0].iter().copied());
    let Ok(inside) = Trims::new(outlines.to_vec(), &domain) else { return Default::default() };
    let mut random = Random::new(seed);
    let mut places = Vec::new();
    let row_height = spacing * 3.0_f64.sqrt() / 2.0;
    let size = domain.size();
    for i in 0..=(size.x / spacing) as usize {
        for j in 0..=(size.y / row_height) as usize {
            let offset = if j % 2 == 1 { spacing / 2.0 } else { 0.0 };
            let regular = domain.min + DVec2::new(i as f64 * spacing + offset, j as f64 * row_height);
            let place = regular + 0.15 * spacing * DVec2::new(random.signed(), random.signed());
            let is_free = |q: &DVec2| q.distance(place) > 0.6 * spacing;
            if inside.contains(place) && outlines.iter().flatten().all(is_free) {
                places.push(place);
            }
        }
    }
    places.extend(outlines.iter().flatten());
    let middle = |t: &[u32; 3]| t.iter().map(|&n| places[n as usize]).sum::<DVec2>() / 3.0;
    let triangles = delaunay(&places, spacing).into_iter().filter(|t| inside.contains(middle(t))).collect();
    (places, triangles)
}

/// Delaunay triangles of places about `spacing` apart, without flat ones.
fn delaunay(places: &[DVec2], spacing: f64) -> Vec<[u32; 3]> {
    let vertices = places.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let Ok(triangulation) = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(vertices) else {
        return Vec::new();
    };
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|n| places[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let faces = triangulation.inner_faces();
    let nodes = faces.map(|face| face.vertices().map(|vertex| vertex.fix().index() as u32));
    nodes.filter(|t| area(t) > 1e-6 * spacing * spacing).collect()
}

/// A quarter of a cylinder of radius 1 and height pi/2 over the square of its angle and height, all lengths of which
/// are those of the surface. `count` nodes: as many along a side as in a square grid, inside a scrambled lattice (R2, M.
/// Roberts 2018) turned and jittered by the seed.
pub fn cylinder_patch(count: usize, seed: u64) -> Result<Mesh, MeshError> {
    /// Inverse powers of the number whose cube is itself and 1: the lattice has no large gaps.
    const STEPS: DVec2 = DVec2::new(0.754_877_666_246_692_7, 0.569_840_290_998_053_2);
    let side = (count as f64).sqrt() as usize;
    let spacing = 1.0 / side as f64;
    let mut random = Random::new(seed);
    let mut places = Vec::with_capacity(count);
    let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    for (k, corner) in corners.into_iter().enumerate() {
        let next = corners[(k + 1) % 4];
        places.extend((0..side).map(|i| corner.lerp(next, i as f64 * spacing)));
    }
    let start = DVec2::new(random.unit(), random.unit());
    for k in 0..count.saturating_sub(places.len()) {
        let regular = (start + k as f64 * STEPS).fract_gl();
        let moved = 0.15 * spacing * DVec2::new(random.signed(), random.signed());
        places.push(DVec2::splat(0.65 * spacing) + (1.0 - 1.3 * spacing) * regular + moved);
    }
    let triangles = delaunay(&places, spacing);
    mesh_over((places, triangles), |p| {
        let DVec2 { x: angle, y: height } = PI / 2.0 * p;
        (DVec3::new(angle.cos(), angle.sin(), height), DVec2::new(angle, height))
    })
}

/// Two hills and a dale over the unit square: R. Franke, "Scattered data interpolation: tests of some methods", Math.
/// Comp. 38 (1982), 181-200.
pub fn franke(p: DVec2) -> f64 {
    let bell = |height: f64, a: f64, b: f64| height * (-a - b).exp();
    let DVec2 { x, y } = 9.0 * p;
    bell(0.75, (x - 2.0).powi(2) / 4.0, (y - 2.0).powi(2) / 4.0)
        + bell(0.75, (x + 1.0).powi(2) / 49.0, (y + 1.0) / 10.0)
        + bell(0.5, (x - 7.0).powi(2) / 4.0, (y - 3.0).powi(2) / 4.0)
        - bell(0.2, (x - 4.0).powi(2), (y - 7.0).powi(2))
}

/// A panel of a fuselage: double curvature, a notch for a door and three windows with round corners; no
/// parameters. About 6,000 nodes.
pub fn fuselage_panel(seed: u64) -> Result<Mesh, MeshError> {
    const LENGTH: f64 = 6.0;
    const HEIGHT: f64 = 3.8;
    const SPACING: f64 = 0.062;
    let corners = [(0.0, 0.0), (4.4, 0.0), (4.4, 1.5), (5.3, 1.5), (5.3, 0.0), (LENGTH, 0.0)];
    let outer = corners.into_iter().chain([(LENGTH, HEIGHT), (0.0, HEIGHT)]);
    let outer: Vec<DVec2> = outer.map(|(x, y)| DVec2::new(x, y)).collect();
    // superellipses of fourth degree: straight sides, round corners
    let window = |center: DVec2| -> Vec<DVec2> {
        let at = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            center
                + DVec2::new(0.32 * cos.signum() * cos.abs().sqrt(), 0.46 * sin.signum() * sin.abs().sqrt())
        };
        (0..720).map(|k| at(2.0 * PI * f64::from(k) / 720.0)).collect()
    };
    let windows = [1.0, 2.2, 3.4].map(|x| window(DVec2::new(x, 2.1)));
    let outlines: Vec<Vec<DVec2>> =
        [outer].into_iter().chain(windows).map(|outline| even(&outline, SPACING)).collect();
    let mut mesh = mesh_over(outlined(&outlines, SPACING, seed), |place| {
        let radius = 1.95 - 0.012 * (place.x - 2.0).powi(2);
        let angle = (place.y - HEIGHT / 2.0) / 1.95;
        (DVec3::new(place.x, radius * angle.sin(), radius * angle.cos()), place)
    })?;
    mesh.clear_parameters();
    Ok(mesh)
}

/// Points about `spacing` apart along a closed outline; sharp corners are kept.
fn even(outline: &[DVec2], spacing: f64) -> Vec<DVec2> {
    let (mut points, mut left) = (Vec::new(), 0.0);
    for (k, &a) in outline.iter().enumerate() {
        let b = outline[(k + 1) % outline.len()];
        let length = a.distance(b);
        if length > spacing {
            let count = (length / spacing).round();
            points.extend((0..count as usize).map(|k| a.lerp(b, k as f64 / count)));
        } else if left <= 0.0 {
            points.push(a);
            left += spacing;
        }
        left -= length.min(spacing);
    }
    points
}

/// A graph over the unit square: `bumps` Gaussian hills and dales of random place, height and width. Returns the
/// mesh with (x,y) as parameters, and the height function.
pub fn bumps(
    counts: [usize; 2],
    bumps: usize,
    seed: u64,
) -> Result<(Mesh, impl Fn(DVec2) -> f64 + Clone), MeshError> {
    let mut random = Random::new(seed);
    let hills: Vec<(DVec2, f64, f64)> = (0..bumps)
        .map(|_| {
            let center = DVec2::new(random.unit(), random.unit());
            (center, 0.2 * random.signed(), 0.12 + 0.3 * random.unit())
        })
        .collect();
    let height = move |p: DVec2| -> f64 {
        hills.iter().map(|(c, h, w)| h * (-p.distance_squared(*c) / (w * w)).exp()).sum()
    };
    let mesh = mesh_over(grid(counts, 0.3, seed.wrapping_add(1), |_| true), |p| (p.extend(height(p)), p))?;
    Ok((mesh, height))
}

/// A smooth warp of the unit square with two ridges and twelve bumps, about a hundred times narrower than it.
pub fn ridged_surface(random: &mut Random) -> impl Fn(DVec2) -> DVec3 + use<> {
    let mut between = |from: f64, to: f64| from + (to - from) * random.unit();
    let bumps: Vec<[f64; 4]> = (0..12)
        .map(|_| [between(0.05, 0.95), between(0.05, 0.95), between(0.008, 0.03), between(-0.06, 0.06)])
        .collect();
    move |uv| {
        let [u, v] = uv.to_array();
        let wave = 0.15 * (2.0 * PI * u).sin() * (1.5 * PI * v).cos() + 0.10 * u * v;
        let ridge = 0.10 / ((v - (0.30 + 0.15 * (2.5 * u).sin())) / 0.02).cosh();
        let step = 0.06 * ((u - (0.65 + 0.10 * v * v)) / 0.015).tanh();
        let slant = 0.08 * (3.0 * PI * (u - 0.3 * v)).cos();
        let hill = |[a, b, s, h]: &[f64; 4]| h * (-((u - a).powi(2) + (v - b).powi(2)) / (2.0 * s * s)).exp();
        let x = u + 0.16 * (2.0 * PI * v).sin() * u * (1.0 - u);
        let y = v + 0.04 * (2.0 * PI * u).sin();
        DVec3::new(x, y, wave + slant + ridge + step + bumps.iter().map(hill).sum::<f64>())
    }
}

/// A mesh of [`ridged_surface`] with parameters, 40,000 nodes.
pub fn ridged_sheet(seed: u64) -> Result<Mesh, MeshError> {
    let surface = ridged_surface(&mut Random::new(seed));
    mesh_over(grid([200, 200], 0.3, seed, |_| true), |uv| (surface(uv), uv))
}

/// The sheet of [`noisy_sheet`] without noise, over the unit square.
fn wavy_sheet(uv: DVec2) -> DVec3 {
    DVec3::new(2.0 * uv.x, uv.y, 0.2 * (3.0 * uv.x).sin() * (2.0 * uv.y + 0.4).cos())
}

/// A wavy sheet of 3,600 nodes with parameters, each node off by up to 0.002 in every direction.
pub fn noisy_sheet(seed: u64) -> Result<Mesh, MeshError> {
    let mut random = Random::new(seed);
    let mut error = move || 0.002 * random.signed();
    let (places, triangles) = grid([60, 60], 0.3, seed, |_| true);
    let errors: Vec<DVec3> = places.iter().map(|_| DVec3::new(error(), error(), error())).collect();
    let points = places.iter().zip(errors).map(|(&uv, error)| wavy_sheet(uv) + error).collect();
    let mut mesh = Mesh::new(points, triangles)?;
    mesh.set_parameters(places)?;
    Ok(mesh)
}

/// A coarse plane control mesh with one node raised in its middle: its surface is that node's blending function.
pub fn hat(seed: u64) -> Result<Mesh, MeshError> {
    const COUNT: usize = 11;
    let (places, triangles) = grid([COUNT, COUNT], 0.3, seed, |_| true);
    let middle = places[COUNT * COUNT / 2];
    let height = move |uv: DVec2| if uv == middle { 0.4 } else { 0.0 };
    mesh_over((places, triangles), |uv| (uv.extend(height(uv)), uv))
}

/// A coarse control mesh of a roof: its halves meet at a ridge of edges at 60 degrees, which is not quite straight.
pub fn roof(seed: u64) -> Result<Mesh, MeshError> {
    /// Less than half a cell.
    const SIDEWAYS: f64 = 0.05;
    let fall = (PI / 6.0).tan();
    let half = |side: f64, seed: u64| {
        let (places, triangles) = grid([7, 11], 0.25, seed, |_| true);
        (places.into_iter().map(|p| DVec2::new(side * p.x, p.y)).collect::<Vec<_>>(), triangles)
    };
    let (mut places, mut triangles) = half(1.0, seed);
    let (left, mirrored) = half(-1.0, seed.wrapping_add(1));
    // both halves have the nodes of the ridge, at u = 0, first and in the same order
    let ridge = left.iter().filter(|p| p.x == 0.0).count() as u32;
    let shift = places.len() as u32 - ridge;
    let number = |node: u32| if node < ridge { node } else { node + shift };
    triangles.extend(mirrored.into_iter().map(|[a, b, c]| [number(a), number(c), number(b)]));
    places.extend(left.into_iter().skip(ridge as usize));
    // knots on one straight line would leave a kink there in every spline over them
    let mut random = Random::new(seed.wrapping_add(2));
    places[1..ridge as usize - 1].iter_mut().for_each(|p| p.x += SIDEWAYS * random.signed());
    let height = |p: DVec2| {
        let from_ridge = if p.x.abs() <= SIDEWAYS { 0.0 } else { p.x.abs() };
        -fall * from_ridge + 0.15 * p.x * p.x * (5.0 * p.y).sin()
    };
    mesh_over((places, triangles), |uv| (uv.extend(height(uv)), uv))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_disks_with_the_holes_they_promise() {
        for (mesh, holes, nodes) in [
            (planar(1), 2, 5000..5500),
            (curved_notch(2), 2, 5000..5500),
            (half_fuselage(), 0, 5600..5601),
            (wing(), 1, 5500..6000),
            (sphere_with_holes(5000, 5), 3, 5000..5500),
            (fuselage_panel(1), 3, 5000..6600),
            (ridged_sheet(1), 0, 40_000..40_001),
            (noisy_sheet(1), 0, 3600..3601),
            (hat(1), 0, 121..122),
            (roof(1), 0, 143..144),
            (cylinder_patch(4321, 1), 0, 4321..4322),
        ] {
            let mesh = mesh.unwrap();
            assert_eq!(mesh.loops().len(), holes + 1);
            assert_eq!((mesh.component_count(), mesh.genus()), (1, 0));
            assert!(nodes.contains(&mesh.points().len()), "{} nodes", mesh.points().len());
        }
    }
}
