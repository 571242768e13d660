//! Shapes that are their own mirror images: the plane, and the half that is fitted.
//!
//! ```text
//! find the plane, or take it: principal planes, then the best plane between nodes and where their images lie
//! cut the mesh along it, map the half on to a square whose side u = 0 is the cut
//! fold the other half over: each node to where its image lies on the half
//! fit the half under the conditions of a mirror along u = 0, and unfold it
//! ```
//! Across the plane a symmetric surface is odd along the normal and even along the plane. A reflection that takes points
//! nearest to others is that of the least eigenvector of the symmetric part of their covariance (as K. Arun, T. Huang and
//! S. Blostein, "Least-squares fitting of two 3-D point sets", IEEE Trans. Pattern Anal. 9 (1987), do for rotations).

use super::error::FitError;
use crate::control::{Control, Pool};
use crate::mesh::Mesh;
use crate::parameterize::{Border, ParameterizeOptions, parameterize};
use crate::query::triangles::TriangleTree;
use glam::{DMat3, DVec2, DVec3};
use nalgebra::Matrix3;
use rayon::prelude::*;

/// Whether a fit of a shape is its own mirror image.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Symmetry {
    /// As it comes.
    #[default]
    None,
    /// About this plane.
    About(Plane),
    /// About the plane for which the mesh is nearest to its image.
    Found,
}

impl Symmetry {
    pub(super) fn check(&self) -> Result<(), FitError> {
        match self {
            Self::About(plane)
                if !(plane.point.is_finite() && plane.normal.is_finite() && plane.normal != DVec3::ZERO) =>
            {
                Err(FitError::NoPlane)
            }
            _ => Ok(()),
        }
    }
}

/// A plane in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A place in it.
    pub point: DVec3,
    /// Across it; not zero.
    pub normal: DVec3,
}

impl Plane {
    fn distance(&self, place: DVec3) -> f64 {
        (place - self.point).dot(self.normal)
    }

    fn image(&self, place: DVec3) -> DVec3 {
        place - 2.0 * self.distance(place) * self.normal
    }

    /// Rows: across the plane and along it.
    fn axes(&self) -> DMat3 {
        let along = self.normal.any_orthonormal_vector();
        DMat3::from_cols(self.normal, along, self.normal.cross(along)).transpose()
    }
}

/// The half of a shape on the side that the normal points away from, with all of its nodes folded on to it.
pub(in crate::fit) struct Half {
    pub plane: Plane,
    /// The largest distance of a node's image to the mesh.
    pub distance: f64,
    /// Places in the square from (-1, 0) to (0, 1): of the nodes of the mesh, then along the cut.
    pub uv: Vec<DVec2>,
    /// The same in space, folded: across the plane, at most 0, and along it.
    pub places: Vec<f64>,
    /// Nodes of the mesh that lie on the other side.
    pub is_folded: Vec<bool>,
}

impl Half {
    /// Cuts and folds a mesh that is symmetric within the tolerance.
    pub(crate) fn of(
        mesh: &Mesh,
        symmetry: Symmetry,
        tolerance: f64,
        options: &ParameterizeOptions,
        control: &mut Control,
    ) -> Result<Self, FitError> {
        let tree = TriangleTree::new(mesh);
        let plane = match symmetry {
            Symmetry::About(Plane { point, normal }) => Plane { point, normal: normal.normalize() },
            _ => control.watch(|pool, _| find(&tree, pool))?,
        };
        let distances = control.watch(|pool, _| image_distances(&tree, &plane, mesh.points(), pool))?;
        let distance = distances.into_iter().fold(0.0, f64::max);
        if !(distance <= tolerance) {
            return Err(FitError::NotSymmetric { distance, tolerance });
        }
        let cut = Cut::of(mesh, &plane)?;
        let corners = cut.corners()?;
        // the cut is straight, and pieces of triangles beside it are no reason to stretch the map
        let border = Border::Corners(corners);
        let square = ParameterizeOptions {
            border,
            bulge: 0.0,
            boundary_slide: 0.0,
            unroll: false,
            stretch_steps: 0,
            ..*options
        };
        let map = control.without_error(|control| parameterize(&cut.mesh, &square, control))?;
        Ok(cut.fold(mesh, plane, distance, &map.uv))
    }

    /// Where a place in the folded frame lies in space.
    pub(crate) fn unfold(&self, place: &mut [f64]) {
        let out = self.plane.axes().transpose() * DVec3::from_slice(place) + self.plane.point;
        place.copy_from_slice(&out.to_array());
    }

    /// The same for a direction.
    pub(crate) fn turn(&self, direction: &mut [f64]) {
        let out = self.plane.axes().transpose() * DVec3::from_slice(direction);
        direction.copy_from_slice(&out.to_array());
    }

    /// The parameters of the nodes of the mesh on the whole surface.
    pub(crate) fn parameters(&self) -> Vec<DVec2> {
        let unfolded = |(&uv, &folded): (&DVec2, &bool)| if folded { DVec2::new(-uv.x, uv.y) } else { uv };
        self.uv.iter().zip(&self.is_folded).map(unfolded).collect()
    }
}

/// How far the images of places lie from the mesh.
fn image_distances<M: std::borrow::Borrow<Mesh> + Sync>(
    tree: &TriangleTree<M>,
    plane: &Plane,
    places: &[DVec3],
    pool: &Pool,
) -> Vec<f64> {
    let distance = |&place: &DVec3| match pool.check() {
        Ok(()) => tree.nearest(plane.image(place)).map_or(f64::INFINITY, |near| near.distance),
        // a cancelled call throws its distances away
        Err(_) => 0.0,
    };
    pool.run(|| places.par_iter().with_min_len(64).map(distance).collect())
}

/// Places that candidates are compared at, and directions tried between principal axes of nearly equal moments.
const SAMPLES: usize = 400;
const DIRECTIONS: usize = 8;
/// Principal moments that differ by a smaller share do not tell their axes apart.
const SAME_MOMENT: f64 = 0.3;
/// Candidates that are refined, and how often.
const REFINED: usize = 3;
const ROUNDS: usize = 12;

/// The plane for which the mesh is nearest to its image.
fn find<M: std::borrow::Borrow<Mesh> + Sync>(tree: &TriangleTree<M>, pool: &Pool) -> Plane {
    let points = tree.mesh().points();
    let samples: Vec<DVec3> = points.iter().step_by(points.len().div_ceil(SAMPLES)).copied().collect();
    let score = |plane: &Plane| -> f64 {
        image_distances(tree, plane, &samples, pool).into_iter().map(|d| d * d).sum()
    };
    let mut candidates: Vec<(f64, Plane)> =
        candidates(tree.mesh()).into_iter().map(|plane| (score(&plane), plane)).collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    candidates.truncate(REFINED);
    for (least, plane) in &mut candidates {
        for _ in 0..ROUNDS {
            let next = refined(tree, plane, &samples);
            let score = score(&next);
            if score >= *least {
                break;
            }
            (*least, *plane) = (score, next);
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    candidates[0].1
}

/// Planes through the centroid across the principal axes.
fn candidates(mesh: &Mesh) -> Vec<Plane> {
    let (mut area, mut center) = (0.0, DVec3::ZERO);
    let corners = |t: &[u32; 3]| t.map(|node| mesh.points()[node as usize]);
    let areas: Vec<f64> =
        mesh.triangles().iter().map(&corners).map(|[a, b, c]| (b - a).cross(c - a).length()).collect();
    for (t, weight) in mesh.triangles().iter().zip(&areas) {
        area += weight;
        center += *weight / 3.0 * corners(t).iter().sum::<DVec3>();
    }
    center /= area.max(f64::MIN_POSITIVE);
    let mut moments = Matrix3::zeros();
    for (t, weight) in mesh.triangles().iter().zip(&areas) {
        let middle = corners(t).iter().sum::<DVec3>() / 3.0 - center;
        let middle = nalgebra::Vector3::from(middle.to_array());
        moments += middle * middle.transpose() * *weight;
    }
    let axes = moments.symmetric_eigen();
    let axis = |k: usize| DVec3::from_slice(axes.eigenvectors.column(k).as_slice());
    let mut normals: Vec<DVec3> = (0..3).map(axis).collect();
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        let (x, y) = (axes.eigenvalues[a], axes.eigenvalues[b]);
        if (x - y).abs() <= SAME_MOMENT * x.abs().max(y.abs()) {
            let turn = |k: usize| DVec2::from_angle(std::f64::consts::PI * k as f64 / DIRECTIONS as f64);
            normals.extend((1..DIRECTIONS).map(turn).map(|turn| turn.x * axis(a) + turn.y * axis(b)));
        }
    }
    normals.into_iter().map(|normal| Plane { point: center, normal }).collect()
}

/// The plane that takes places best to where their images lie on the mesh.
fn refined<M: std::borrow::Borrow<Mesh>>(tree: &TriangleTree<M>, plane: &Plane, places: &[DVec3]) -> Plane {
    let pairs: Vec<(DVec3, DVec3)> = places
        .iter()
        .filter_map(|&place| tree.nearest(plane.image(place)).map(|near| (place, near.point)))
        .collect();
    let count = pairs.len().max(1) as f64;
    let (p, q) = pairs.iter().fold((DVec3::ZERO, DVec3::ZERO), |(p, q), (a, b)| (p + a, q + b));
    let (p, q) = (p / count, q / count);
    let mut covariance = Matrix3::zeros();
    for (a, b) in &pairs {
        let [a, b] = [*a - p, *b - q].map(|x| nalgebra::Vector3::from(x.to_array()));
        covariance += a * b.transpose() + b * a.transpose();
    }
    let axes = covariance.symmetric_eigen();
    let least = axes.eigenvalues.imin();
    let normal = DVec3::from_slice(axes.eigenvectors.column(least).as_slice());
    Plane { point: (p + q) / 2.0, normal: if normal.dot(plane.normal) < 0.0 { -normal } else { normal } }
}

/// Nodes nearer to the plane than this share of their shortest edge are drawn into it: else the cut leaves slivers, on which
/// maps are uneven.
const DRAWN_IN: f64 = 0.2;

/// The half of a mesh below a plane.
struct Cut {
    mesh: Mesh,
    /// The nodes of the whole mesh that the first nodes of the half are; those of the cut come after them.
    origins: Vec<u32>,
    /// Whether each node of the half lies in the plane.
    is_in_plane: Vec<bool>,
}

impl Cut {
    fn of(mesh: &Mesh, plane: &Plane) -> Result<Self, FitError> {
        let reach = reaches(mesh);
        let side = |(place, reach): (&DVec3, f64)| match plane.distance(*place) {
            d if d.abs() <= reach => 0,
            d if d < 0.0 => -1,
            _ => 1,
        };
        let sides: Vec<i32> = mesh.points().iter().zip(reach).map(side).collect();
        let (mut points, mut origins, mut number) = (Vec::new(), Vec::new(), vec![u32::MAX; sides.len()]);
        for (node, _) in sides.iter().enumerate().filter(|(_, side)| **side <= 0) {
            number[node] = points.len() as u32;
            origins.push(node as u32);
            let place = mesh.points()[node];
            points.push(if sides[node] == 0 { place - plane.distance(place) * plane.normal } else { place });
        }
        let mut crossings = std::collections::BTreeMap::new();
        let mut triangles = Vec::new();
        for triangle in mesh.triangles() {
            // the part below: its corners, and where its edges pass through the plane
            let mut part = Vec::with_capacity(4);
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                let (from, to) = (sides[a as usize], sides[b as usize]);
                if from <= 0 {
                    part.push(number[a as usize]);
                }
                if from * to < 0 {
                    let (low, high) = (a.min(b), a.max(b));
                    part.push(*crossings.entry((low, high)).or_insert_with(|| {
                        let [p, q] = [low, high].map(|node| mesh.points()[node as usize]);
                        let (x, y) = (plane.distance(p), plane.distance(q));
                        points.push(p + x / (x - y) * (q - p));
                        points.len() as u32 - 1
                    }));
                }
            }
            let is_below = triangle.iter().any(|&node| sides[node as usize] < 0);
            if is_below && part.len() >= 3 {
                triangles.extend((1..part.len() - 1).map(|k| [part[0], part[k], part[k + 1]]));
            }
        }
        let is_in_plane =
            (0..points.len()).map(|k| origins.get(k).is_none_or(|&node| sides[node as usize] == 0)).collect();
        let half = Mesh::new(points, triangles).map_err(|_| FitError::NotCutInTwo)?;
        Ok(Self { mesh: half, origins, is_in_plane })
    }

    /// The corners of the square: the ends of the cut are those of its side u = 0, the others turn most.
    fn corners(&self) -> Result<[u32; 4], FitError> {
        if self.mesh.component_count() != 1 || self.mesh.genus() != 0 {
            return Err(FitError::NotCutInTwo);
        }
        let outer = self.mesh.loops().first().ok_or(FitError::NotCutInTwo)?;
        let count = outer.len();
        let on = |k: usize| self.is_in_plane[outer[k % count] as usize];
        let starts: Vec<usize> = (0..count).filter(|&k| on(k) && !on(k + count - 1)).collect();
        let &[start] = starts.as_slice() else { return Err(FitError::NotCutInTwo) };
        let length = (0..count).take_while(|&k| on(start + k)).count();
        let rest = count - length;
        if length < 2 || rest < 2 {
            return Err(FitError::NotCutInTwo);
        }
        let end = start + length - 1;
        // two nodes between the end of the cut and its start, each the sharpest turn near a third of the way
        let place = |k: usize| self.mesh.points()[outer[k % count] as usize];
        let lengths: Vec<f64> = (end..start + count).map(|k| place(k).distance(place(k + 1))).collect();
        let total: f64 = lengths.iter().sum();
        let mut at = vec![0.0];
        lengths.iter().for_each(|length| at.push(at[at.len() - 1] + length / total));
        let turn = |k: usize| {
            let (a, b) = (place(k) - place(k + count - 1), place(k + 1) - place(k));
            a.angle_between(b)
        };
        let corner = |share: f64| {
            let near = (1..=rest).filter(|&k| (at[k] - share).abs() <= 0.16);
            let sharpest = near.max_by(|&a, &b| turn(end + a).total_cmp(&turn(end + b)).then(b.cmp(&a)));
            let nearest = (1..=rest).min_by(|&a, &b| (at[a] - share).abs().total_cmp(&(at[b] - share).abs()));
            let found = match sharpest {
                Some(k) if turn(end + k) > 0.5 => Some(k),
                _ => nearest,
            };
            found.map_or(end + 1, |k| end + k)
        };
        let (third, fourth) = (corner(1.0 / 3.0), corner(2.0 / 3.0));
        if third == fourth {
            return Err(FitError::NotCutInTwo);
        }
        let node = |k: usize| outer[k % count];
        Ok([node(fourth), node(start), node(end), node(third)])
    }

    /// Folds the nodes beyond the plane on to the half.
    fn fold(&self, mesh: &Mesh, plane: Plane, distance: f64, uv: &[DVec2]) -> Half {
        let tree = TriangleTree::new(&self.mesh);
        let shifted = |uv: DVec2| DVec2::new(uv.x - 1.0, uv.y);
        let on_half = |place: DVec3| {
            let near = tree.nearest(place).expect("the half has triangles");
            let corners = self.mesh.triangles()[near.triangle as usize].map(|node| node as usize);
            let shares = barycentric(near.point, corners.map(|node| self.mesh.points()[node]));
            shifted((0..3).map(|k| shares[k] * uv[corners[k]]).sum())
        };
        let mut number = vec![None; mesh.points().len()];
        self.origins.iter().enumerate().for_each(|(k, &node)| number[node as usize] = Some(k));
        let is_folded: Vec<bool> = mesh.points().iter().map(|&place| plane.distance(place) > 0.0).collect();
        let axes = plane.axes();
        let (mut places, mut parameters) = (Vec::new(), Vec::new());
        let mut add = |uv: DVec2, place: DVec3, is_in_plane: bool| {
            let mut folded = axes * (place - plane.point);
            folded.x = if is_in_plane { 0.0 } else { folded.x };
            places.extend(folded.to_array());
            parameters.push(uv.clamp(DVec2::new(-1.0, 0.0), DVec2::new(0.0, 1.0)));
        };
        for (&place, number) in mesh.points().iter().zip(&number) {
            let below = if plane.distance(place) > 0.0 { plane.image(place) } else { place };
            match number {
                Some(k) if !self.is_in_plane[*k] => add(shifted(uv[*k]), place, false),
                _ => add(on_half(below), below, false),
            }
        }
        let along_cut = |&k: &usize| self.is_in_plane[k] && self.mesh.is_used(k as u32);
        for k in (0..self.mesh.points().len()).filter(along_cut) {
            add(shifted(uv[k]), self.mesh.points()[k], true);
        }
        Half { plane, distance, uv: parameters, places, is_folded }
    }
}

/// How near to the plane each node is drawn in.
fn reaches(mesh: &Mesh) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; mesh.points().len()];
    for triangle in mesh.triangles() {
        for k in 0..3 {
            let [a, b] = [triangle[k] as usize, triangle[(k + 1) % 3] as usize];
            let length = mesh.points()[a].distance(mesh.points()[b]);
            shortest[a] = shortest[a].min(length);
            shortest[b] = shortest[b].min(length);
        }
    }
    shortest.into_iter().map(|length| if length.is_finite() { DRAWN_IN * length } else { 0.0 }).collect()
}

/// The shares of the corners at a place in a triangle.
fn barycentric(place: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let area = normal.length_squared();
    if area == 0.0 {
        return [1.0 / 3.0; 3];
    }
    let share = |p: DVec3, q: DVec3| (p - place).cross(q - place).dot(normal) / area;
    [share(b, c), share(c, a), share(a, b)]
}
