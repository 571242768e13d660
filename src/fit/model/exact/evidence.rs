//! Planes and cylinders by least squares from the nodes and facets of a region.

use crate::linalg::principal_axes;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::model::{Carrier, Cylinder, Frame, Plane};
use glam::{DVec2, DVec3};
use nalgebra::{Matrix3, SMatrix, SVector};

/// What a region says of the surface under it.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// Its nodes, each once.
    pub points: Vec<DVec3>,
    /// Twice the area of each facet, along its normal.
    facets: Vec<[DVec3; 2]>,
    /// Where the nodes are on average, and how far from there they reach.
    centre: DVec3,
    extent: f64,
}

/// How far nodes may be from a carrier: the largest, the 99th percentile and the root of the mean square.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// No node may be farther.
    pub max: f64,
    /// All but one of a hundred are nearer.
    pub percentile: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// Standard deviation of the nodes' noise.
    pub noise: f64,
}

/// The largest error of a node may be this share of the tolerance: edges and facets need the rest.
const SHARE_OF_MAX: f64 = 1.0 / 3.0;
/// Root of the mean square, by tolerance: what is round by more is no plane, though it may be within the tolerance.
const SHARE_OF_RMS: f64 = 0.1;
/// Of normal noise one of 10^5 nodes is off by more than this many deviations, and one of a hundred by more than 2.6.
const NOISE_MAX: f64 = 4.5;
const NOISE_PERCENTILE: f64 = 2.9;
const NOISE_RMS: f64 = 1.3;

impl Limits {
    /// For a tolerance and a standard deviation of noise, both lengths.
    pub fn new(tolerance: f64, noise: f64) -> Self {
        let max = SHARE_OF_MAX * tolerance;
        Self {
            max: max.max(NOISE_MAX * noise),
            percentile: max.max(NOISE_PERCENTILE * noise),
            rms: (SHARE_OF_RMS * tolerance).max(NOISE_RMS * noise),
            noise,
        }
    }

    /// All limits times a factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { max: factor * self.max, percentile: factor * self.percentile, rms: factor * self.rms, ..self }
    }

    fn hold(&self, mut distances: Vec<f64>) -> bool {
        let last = distances.len() - 1;
        let rms = root_mean_square(&distances);
        // below a hundred nodes the second largest: one may stand out
        let rank = last - (last / 100).max(usize::from(last > 2)).min(last);
        let (_, &mut percentile, above) = distances.select_nth_unstable_by(rank, f64::total_cmp);
        let max = above.iter().copied().fold(percentile, f64::max);
        max <= self.max && percentile <= self.percentile && rms <= self.rms
    }
}

fn root_mean_square(distances: &[f64]) -> f64 {
    (distances.iter().map(|d| d * d).sum::<f64>() / distances.len().max(1) as f64).sqrt()
}

/// Part of the area of a region whose facets must look the way the carrier does: the rest may be turned by noise.
const LEAST_AGREEMENT: f64 = 0.8;
/// Radii beyond so many times the extent of the nodes are not told from planes.
const LARGEST_RADIUS: f64 = 50.0;
/// Steps of Gauss and Newton's method: quadratic near the answer, and the start is near.
const STEPS: usize = 20;
/// A step below this part of the extent is rounding.
const SMALL_STEP: f64 = 1e-15;

impl Evidence {
    /// Of some triangles; none without area.
    pub fn new(mesh: &Mesh, triangles: &[u32]) -> Option<Self> {
        let mut nodes: Vec<u32> =
            triangles.iter().flat_map(|&triangle| mesh.triangles()[triangle as usize]).collect_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let place = |node: u32| mesh.points()[node as usize];
        let points: Vec<DVec3> = nodes.into_iter().map(place).collect_vec();
        let facet = |&triangle: &u32| {
            let [a, b, c] = mesh.triangles()[triangle as usize].map(place);
            [(a + b + c) / 3.0, (b - a).cross(c - a)]
        };
        let facets: Vec<[DVec3; 2]> = triangles.iter().map(facet).collect_vec();
        let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let extent = points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
        (extent > 0.0).then_some(Self { points, facets, centre, extent })
    }

    /// Half the length of the area vectors.
    pub fn area(&self) -> f64 {
        0.5 * self.facets.iter().map(|[_, facet]| facet.length()).sum::<f64>()
    }

    /// How far the nodes reach from their centre.
    pub fn extent(&self) -> f64 {
        self.extent
    }

    /// Root of the mean square of the nodes' distances from a carrier.
    pub fn rms(&self, carrier: &Carrier) -> f64 {
        root_mean_square(&self.distances(carrier))
    }

    fn distances(&self, carrier: &Carrier) -> Vec<f64> {
        self.points.iter().map(|&point| signed_distance(carrier, point).abs()).collect_vec()
    }

    /// Whether the nodes lie on a carrier, and the facets look the way it does.
    pub fn accepts(&self, carrier: &Carrier, limits: &Limits) -> bool {
        let towards = self.facets.iter().map(|&[at, facet]| facet.dot(gradient(carrier, at)));
        let whole: f64 = self.facets.iter().map(|[_, facet]| facet.length()).sum();
        towards.sum::<f64>().abs() >= LEAST_AGREEMENT * whole && self.holds(carrier, limits)
    }

    /// Whether the nodes lie on a carrier, whichever way the facets look.
    pub fn holds(&self, carrier: &Carrier, limits: &Limits) -> bool {
        limits.hold(self.distances(carrier))
    }

    /// Whether the facets look away from the axis of a cylinder, or along the normal of a plane.
    pub fn looks_along(&self, carrier: &Carrier) -> bool {
        self.facets.iter().map(|&[at, facet]| facet.dot(gradient(carrier, at))).sum::<f64>() > 0.0
    }

    /// The plane nearest to the nodes, its normal on the side to which the facets look.
    pub fn plane(&self) -> Option<Plane> {
        let normal = self.axes(self.points.iter().map(|&p| p - self.centre))?[0];
        self.plane_along(normal)
    }

    /// The nearest plane with this normal, or the opposite one.
    pub fn plane_along(&self, normal: DVec3) -> Option<Plane> {
        let sum: DVec3 = self.facets.iter().map(|[_, facet]| *facet).sum();
        let normal = if sum.dot(normal) < 0.0 { -normal } else { normal };
        Some(Plane(Frame::new(self.centre, normal, least_aligned(normal))?))
    }

    /// Whether nodes under noise bend away from a plane by no more than noise does: a quadric through them leaves nearly as
    /// much. Few nodes do not tell.
    pub fn is_straight(&self, plane: &Frame) -> bool {
        /// A quadric through so many more nodes than it has coefficients explains noise only in part.
        const LEAST: usize = 2 * COEFFICIENTS;
        const COEFFICIENTS: usize = 6;
        /// The mean square that is left may be so many times larger without the quadric: bends of half of noise.
        const MOST: f64 = 1.25;
        /// By chance three coefficients explain as much as one node each does on average; ten times that is no chance.
        const CHANCE: f64 = 30.0;
        let count = self.points.len();
        if count < LEAST {
            return false;
        }
        let row = |point: &DVec3| {
            let from = (*point - self.centre) / self.extent;
            let (x, y) = (from.dot(plane.x()), from.dot(plane.y()));
            (SVector::<f64, 6>::new(1.0, x, y, x * x, x * y, y * y), from.dot(plane.z()))
        };
        let (mut matrix, mut right) = (SMatrix::<f64, 6, 6>::zeros(), SVector::<f64, 6>::zeros());
        for (row, height) in self.points.iter().map(row) {
            matrix += row * row.transpose();
            right += height * row;
        }
        // nodes on two lines lie on many quadrics
        let Some(solution) = matrix.cholesky().map(|factor| factor.solve(&right)) else { return false };
        let left = self.points.iter().map(row).map(|(row, height)| (height - row.dot(&solution)).powi(2));
        let (left, all) = (left.sum::<f64>(), self.points.iter().map(row).map(|(_, z)| z * z).sum::<f64>());
        all <= (MOST + CHANCE / (count - COEFFICIENTS) as f64) * left
    }

    /// The cylinder nearest to the nodes.
    pub fn cylinder(&self) -> Option<Cylinder> {
        // normals are across the axis
        let weighted =
            self.facets.iter().map(|[_, facet]| *facet / facet.length().sqrt().max(f64::MIN_POSITIVE));
        let axis = self.axes(weighted)?[0];
        let start = self.cylinder_along(axis, &[])?;
        self.improved(start)
    }

    /// The nearest cylinder of this direction that touches some planes along it: each plane by its normal and offset, on
    /// the side of the axis where `normal . place - offset` is negative.
    pub fn cylinder_along(&self, axis: DVec3, tangent: &[(DVec3, f64)]) -> Option<Cylinder> {
        let frame = Frame::new(self.centre, axis, least_aligned(axis))?;
        let flat: Vec<DVec2> = self.points.iter().map(|&p| flattened(&frame, p)).collect_vec();
        let touching = |&(normal, offset): &(DVec3, f64)| {
            let across = DVec2::new(normal.dot(frame.x()), normal.dot(frame.y()));
            (across, offset - normal.dot(self.centre))
        };
        let lines: Vec<(DVec2, f64)> = tangent.iter().map(touching).collect();
        let (centre, radius) = circle(&flat, &lines, self.extent)?;
        if radius > LARGEST_RADIUS * self.extent {
            return None;
        }
        let origin = self.centre + centre.x * frame.x() + centre.y * frame.y();
        Cylinder::new(Frame::new(origin, frame.z(), frame.x())?, radius)
    }

    /// Whether nodes stand at enough angles about the axis of a cylinder: through three lines there always is one, and
    /// the corners of a polygon lie near many; of few lines it must be told more exactly than by their chords.
    pub fn tells_roundness(&self, cylinder: &Cylinder, limits: &Limits) -> bool {
        const LEAST: usize = 4;
        const FEW: usize = 12;
        const SAME: f64 = 1e-3;
        const SHARE_OF_SAGITTA: f64 = 0.05;
        const ROUNDING: f64 = 1e-6;
        let frame = cylinder.frame();
        let angle = |&point: &DVec3| {
            let from = point - frame.origin();
            from.dot(frame.y()).atan2(from.dot(frame.x()))
        };
        let mut angles: Vec<f64> = self.points.iter().map(angle).collect_vec();
        angles.sort_unstable_by(f64::total_cmp);
        let gaps: Vec<f64> =
            angles.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > SAME).collect();
        let least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
        let sagitta = cylinder.radius() * (1.0 - (0.5 * least).cos());
        let carrier = Carrier::Cylinder(*cylinder);
        let off = || self.distances(&carrier).into_iter().fold(0.0, f64::max);
        gaps.len() + 1 >= LEAST
            && (gaps.len() >= FEW
                || off() <= SHARE_OF_SAGITTA * sagitta + ROUNDING * self.extent + NOISE_MAX * limits.noise)
    }

    /// With the axis turned and moved to the least squares of distances.
    fn improved(&self, mut cylinder: Cylinder) -> Option<Cylinder> {
        for _ in 0..STEPS {
            let frame = *cylinder.frame();
            let (mut matrix, mut right) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
            for &point in &self.points {
                let from = point - frame.origin();
                let height = from.dot(frame.z());
                let across = from - height * frame.z();
                let distance = across.length();
                if distance == 0.0 {
                    continue;
                }
                let outward = across / distance;
                let (ox, oy) = (outward.dot(frame.x()), outward.dot(frame.y()));
                // by the origin across, the axis's tilt scaled to the extent, and the radius
                let tilt = height / self.extent;
                let row = SVector::<f64, 5>::new(-ox, -oy, -tilt * ox, -tilt * oy, -1.0);
                matrix += row * row.transpose();
                right -= row * (distance - cylinder.radius());
            }
            let step = matrix.lu().solve(&right)?;
            let origin = frame.origin() + step[0] * frame.x() + step[1] * frame.y();
            let axis = frame.z() + (step[2] * frame.x() + step[3] * frame.y()) / self.extent;
            // the origin stays beside the nodes, so that tilt and place hardly depend on each other
            let along = axis.normalize_or_zero();
            let origin = origin + (self.centre - origin).dot(along) * along;
            cylinder = Cylinder::new(Frame::new(origin, along, frame.x())?, cylinder.radius() + step[4])?;
            if step.norm() <= SMALL_STEP * self.extent {
                break;
            }
        }
        (cylinder.radius() <= LARGEST_RADIUS * self.extent).then_some(cylinder)
    }

    /// Principal axes of some vectors, that of the least spread first.
    fn axes(&self, vectors: impl Iterator<Item = DVec3>) -> Option<[DVec3; 3]> {
        let axes = principal_axes(vectors);
        axes.iter().all(|axis| axis.is_finite()).then_some(axes)
    }
}

/// The coordinate axis that is least along a direction.
pub(crate) fn least_aligned(direction: DVec3) -> DVec3 {
    let size = direction.abs();
    match size.min_element() {
        least if least == size.x => DVec3::X,
        least if least == size.y => DVec3::Y,
        _ => DVec3::Z,
    }
}

fn flattened(frame: &Frame, point: DVec3) -> DVec2 {
    let from = point - frame.origin();
    DVec2::new(from.dot(frame.x()), from.dot(frame.y()))
}

/// The circle nearest to some points that touches lines: `n . centre + radius = offset`, for each line its normal and offset.
///
/// The start minimizes the algebraic distance (I. Kasa, "A circle fitting procedure and its error analysis", IEEE Trans.
/// Instrum. Meas. 25 (1976)); Gauss and Newton's method with Lagrange multipliers for the lines, which are linear, does the rest.
pub(crate) fn circle(points: &[DVec2], lines: &[(DVec2, f64)], extent: f64) -> Option<(DVec2, f64)> {
    let (mut matrix, mut right) = (Matrix3::zeros(), SVector::<f64, 3>::zeros());
    for p in points.iter().map(|&p| p / extent) {
        let row = SVector::<f64, 3>::new(2.0 * p.x, 2.0 * p.y, 1.0);
        matrix += row * row.transpose();
        right += row * p.length_squared();
    }
    let start = matrix.lu().solve(&right)?;
    let mut centre = DVec2::new(start[0], start[1]);
    let mut radius = (start[2] + centre.length_squared()).max(0.0).sqrt();
    for _ in 0..STEPS {
        let size = 3 + lines.len();
        let mut matrix = nalgebra::DMatrix::<f64>::zeros(size, size);
        let mut right = nalgebra::DVector::<f64>::zeros(size);
        for p in points.iter().map(|&p| p / extent) {
            let from = p - centre;
            let distance = from.length();
            if distance == 0.0 {
                continue;
            }
            let row = [-from.x / distance, -from.y / distance, -1.0];
            for (i, a) in row.iter().enumerate() {
                row.iter().enumerate().for_each(|(j, b)| matrix[(i, j)] += a * b);
                right[i] -= a * (distance - radius);
            }
        }
        for (k, (normal, offset)) in (3..).zip(lines) {
            for (i, a) in [normal.x, normal.y, 1.0].into_iter().enumerate() {
                matrix[(i, k)] = a;
                matrix[(k, i)] = a;
            }
            right[k] = offset / extent - normal.dot(centre) - radius;
        }
        // lines that ask for the same, as opposite sides of a slot may not, leave no unique answer
        let step = matrix.lu().solve(&right)?;
        centre += DVec2::new(step[0], step[1]);
        radius += step[2];
        if step.rows(0, 3).norm() <= SMALL_STEP {
            break;
        }
    }
    let is_circle = centre.is_finite() && radius > 0.0 && radius.is_finite();
    is_circle.then_some((extent * centre, extent * radius))
}

/// The distance of a place from a plane or cylinder: positive in front of the plane, outside the cylinder.
pub(crate) fn signed_distance(carrier: &Carrier, place: DVec3) -> f64 {
    match carrier {
        Carrier::Plane(Plane(frame)) => (place - frame.origin()).dot(frame.z()),
        Carrier::Cylinder(cylinder) => across(cylinder, place).length() - cylinder.radius(),
        Carrier::Spline(_) => f64::NAN,
    }
}

/// The direction in which that distance grows.
pub(crate) fn gradient(carrier: &Carrier, place: DVec3) -> DVec3 {
    match carrier {
        Carrier::Plane(Plane(frame)) => frame.z(),
        Carrier::Cylinder(cylinder) => across(cylinder, place).normalize_or_zero(),
        Carrier::Spline(_) => DVec3::ZERO,
    }
}

fn across(cylinder: &Cylinder, place: DVec3) -> DVec3 {
    let from = place - cylinder.frame().origin();
    from - from.dot(cylinder.frame().z()) * cylinder.frame().z()
}
