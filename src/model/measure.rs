//! Size, area and volume of a model, and how well its faces meet.
//!
//! Both integrals are taken over the part of each parameter plane that the loops enclose: the area of `|Su x Sv|`, and
//! the volume by the divergence theorem as a third of `S . (Su x Sv)`. By Green's theorem
//! ```text
//!   integral of f over D  =  line integral of F dv round D,   F(u,v) = integral of f from the left end of the
//!                                                             span around u, to u
//!   +-------+-------+        F starts anew at each knot line, so a loop that leaves span k upwards in u at v takes
//!   |    .--+-->.   |        with it what it leaves behind there: minus the integral of f over all of the span
//!   |   /   |    \  |        below v; and gives it back where it returns.
//!   +-------+-------+
//! ```
//! Gauss rules on the pieces of a span are exact for the volume of polynomial surfaces up to bicubic ones.

use super::{Carrier, EdgeId, FaceId, Model, Role};
use crate::geometry::{Axis, Bounds};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Patches, Surface, normal};
use glam::{DVec2, DVec3};

/// What a model measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Least coordinates, from samples of every span.
    pub min: DVec3,
    /// Largest coordinates, from samples of every span.
    pub max: DVec3,
    /// Area of all faces.
    pub area: f64,
    /// Volume of all solids, voids taken off; 0 for open shells.
    pub volume: f64,
    /// Largest distance between the images of an edge on the two surfaces beside it.
    pub max_gap: f64,
    /// Largest angle between the normals on both sides of an edge that is not sharp, in radians.
    pub max_normal_jump: f64,
    /// Edges of one face.
    pub free_edge_count: usize,
    /// Edges that are sharp on purpose.
    pub sharp_edge_count: usize,
}

/// Places on [-1, 1] and weights of the Gauss rule of six points: exact to degree 11. The volume of a bicubic patch
/// has degree 8 in each direction, and one more after the first integral.
const GAUSS: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_35),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_35),
];
/// Samples of a span of an edge at which the surfaces beside it are compared.
const EDGE_SAMPLES: usize = 8;
/// Samples along each side of a patch for the box.
const BOX_SAMPLES: usize = 8;

/// Places and weights of the rule on an interval.
fn gauss(from: f64, to: f64) -> [(f64, f64); 6] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    GAUSS.map(|(place, weight)| (middle + half * place, half * weight))
}

/// Area and volume, or parts of them.
type Sums = [f64; 2];

/// How two faces meet along an edge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Joint {
    /// Largest distance between the images of the edge on both surfaces.
    pub gap: f64,
    /// Largest angle between the normals of both faces, in radians.
    pub angle: f64,
}

impl Model {
    /// Measures a model.
    pub fn measure(&self) -> Measure {
        let bounds = self.bounds();
        let [min, max] = [&bounds.min, &bounds.max].map(|corner| DVec3::from_slice(corner));
        let center = min.midpoint(max);
        let (mut area, mut volume) = (0.0, 0.0);
        for shell in self.shells() {
            for &face in &shell.faces {
                let sums = self.integrals(face, center);
                // loops of a face that is turned run clockwise in the plane
                area += sums[0].abs();
                volume += if shell.role == Role::Open { 0.0 } else { sums[1] };
            }
        }
        let (mut max_gap, mut max_normal_jump) = (0.0, 0.0);
        for edge in self.edge_ids() {
            let joint = self.joint(edge);
            max_gap = f64::max(max_gap, joint.gap);
            if !self.edge(edge).is_sharp {
                max_normal_jump = f64::max(max_normal_jump, joint.angle);
            }
        }
        Measure {
            min,
            max,
            area,
            volume,
            max_gap,
            max_normal_jump,
            free_edge_count: self.free_edge_count(),
            sharp_edge_count: self.edges().iter().filter(|edge| edge.is_sharp).count(),
        }
    }

    /// How the faces beside an edge meet; zeros for a free edge.
    pub fn joint(&self, edge: EdgeId) -> Joint {
        let uses: Vec<_> = self.uses(edge).collect();
        let &[a, b] = uses.as_slice() else { return Joint::default() };
        let of_sides = [a, b].map(|at| self.coedge(at).pcurve.as_ref());
        let in_plane = of_sides.into_iter().flatten().flat_map(|curve| curve.knots().breaks());
        let mut breaks: Vec<f64> = in_plane.chain(self.edge(edge).curve.breaks()).collect();
        breaks.sort_unstable_by(f64::total_cmp);
        breaks.dedup();
        let parameters = between(&breaks, EDGE_SAMPLES);
        let [a, b] = [a, b].map(|at| {
            let places = self.places(at, &parameters);
            let mut rows = vec![0.0; 9 * places.len()];
            self.carrier(at.face).eval_rows(&places, 1, &mut rows);
            let sense = if self.face(at.face).is_forward { 1.0 } else { -1.0 };
            let row = move |row: &[f64]| {
                let [s, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
                (s, sense * normal(su, sv))
            };
            rows.chunks_exact(9).map(row).collect::<Vec<_>>()
        });
        a.into_iter().zip(b).fold(Joint::default(), |joint, ((p, m), (q, n))| Joint {
            gap: joint.gap.max(p.distance(q)),
            // f64::max leaves out places without a normal; acos is blind to small angles
            angle: joint.angle.max(m.cross(n).length().atan2(m.dot(n))),
        })
    }

    /// The box around samples of every span.
    fn bounds(&self) -> Bounds {
        let mut points = self.vertices().to_vec();
        for edge in self.edges() {
            points.extend(edge.curve.points(&between(&edge.curve.breaks(), BOX_SAMPLES)));
        }
        for face in self.face_ids() {
            if let (Some(surface), Ok(trims)) = (self.carrier(face).spline(), self.trims(face)) {
                for index in 0..surface.patch_count() {
                    let domain = surface.patch(index).domain;
                    let [u, v] =
                        [0, 1].map(|axis| between(&[domain.min[axis], domain.max[axis]], BOX_SAMPLES));
                    let grid = u.iter().flat_map(|&u| v.iter().map(move |&v| DVec2::new(u, v)));
                    let inside: Vec<DVec2> = grid.filter(|&uv| trims.contains(uv)).collect();
                    points.extend(self.carrier(face).points(&inside));
                }
            }
        }
        let rows: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
        Bounds::of_rows(&rows, 3)
    }

    /// Area and volume under a face, seen from `center`; both negative where the loops run clockwise.
    fn integrals(&self, face: FaceId, center: DVec3) -> Sums {
        match self.carrier(face) {
            Carrier::Spline(surface) => {
                let mut field = Field::new(surface, center);
                self.polylines(face).iter().map(|polyline| field.around(polyline)).fold([0.0; 2], add)
            }
            Carrier::Plane(plane) => {
                // area = line integral of x dy
                let frame = plane.0;
                let area = self.around(face, |place, along| {
                    (place - frame.origin()).dot(frame.x()) * along.dot(frame.y())
                });
                [area, area * (frame.origin() - center).dot(frame.z()) / 3.0]
            }
            Carrier::Cylinder(cylinder) => {
                // v du, which closes whether there is a seam or not
                let (frame, radius) = (*cylinder.frame(), cylinder.radius());
                let form = |place: DVec3, along: DVec3, height: &dyn Fn(DVec3) -> f64| {
                    let from = place - frame.origin();
                    let outward = (from - from.dot(frame.z()) * frame.z()).normalize_or_zero();
                    let distance = from.dot(outward);
                    let turn = along.dot(frame.z().cross(outward)) / distance;
                    -from.dot(frame.z()) * radius * turn * height(outward)
                };
                let area = self.around(face, |place, along| form(place, along, &|_| 1.0));
                let off = frame.origin() - center;
                let volume =
                    self.around(face, |place, along| form(place, along, &|n| (radius + off.dot(n)) / 3.0));
                [area, volume]
            }
        }
    }

    /// The integral of a form, a function of place and derivative, along all loops of a face.
    fn around(&self, face: FaceId, form: impl Fn(DVec3, DVec3) -> f64) -> f64 {
        let mut sum = 0.0;
        for coedge in self.face(face).bounds.iter().flatten() {
            let curve = &self.edge(coedge.edge).curve;
            let sense = if coedge.is_forward { 1.0 } else { -1.0 };
            for span in curve.breaks().windows(2) {
                for (t, weight) in gauss(span[0], span[1]) {
                    let mut row = [0.0; 6];
                    curve.eval_rows(&[t], 1, &mut row);
                    let [place, along] = [0, 3].map(|k| DVec3::from_slice(&row[k..]));
                    sum += sense * weight * form(place, along);
                }
            }
        }
        sum
    }
}

/// All breaks, and `pieces - 1` places between each two of them.
pub(super) fn between(breaks: &[f64], pieces: usize) -> Vec<f64> {
    let inner = breaks.windows(2).flat_map(|span| {
        let (from, to) = (span[0], span[1]);
        (0..pieces).map(move |k| from + (to - from) * k as f64 / pieces as f64)
    });
    inner.chain(breaks.last().copied()).collect()
}

fn add(a: Sums, b: Sums) -> Sums {
    [a[0] + b[0], a[1] + b[1]]
}

/// What is integrated over the parameter plane of a spline.
struct Field<'a> {
    surface: &'a TensorSurface,
    center: DVec3,
    breaks: [Vec<f64>; 2],
    /// For each span of u that a loop has left: the integrals over it below each break of v.
    columns: Vec<Option<Vec<Sums>>>,
}

impl<'a> Field<'a> {
    fn new(surface: &'a TensorSurface, center: DVec3) -> Self {
        let breaks = [Axis::U, Axis::V].map(|axis| surface.knots(axis).breaks());
        let columns = vec![None; breaks[0].len() - 1];
        Self { surface, center, breaks, columns }
    }

    /// The integral over what a closed polyline encloses, the inside on its left.
    fn around(&mut self, polyline: &[DVec2]) -> Sums {
        let next = polyline.iter().cycle().skip(1);
        let corners: Vec<DVec2> = polyline.iter().zip(next).flat_map(|(&a, &b)| self.cut(a, b)).collect();
        let ends = corners.iter().cycle().skip(1);
        let pieces: Vec<[DVec2; 2]> = corners.iter().zip(ends).map(|(&a, &b)| [a, b]).collect();
        let spans: Vec<usize> = pieces.iter().map(|&[a, b]| self.span(0, 0.5 * (a.x + b.x))).collect();
        let mut sum = [0.0; 2];
        for (k, (&[a, b], &span)) in pieces.iter().zip(&spans).enumerate() {
            let before = spans[(k + spans.len() - 1) % spans.len()];
            for left in before..span {
                sum = add(sum, self.below(left, a.y).map(|part| -part));
            }
            for entered in span..before {
                sum = add(sum, self.below(entered, a.y));
            }
            if a.y != b.y {
                sum = add(sum, self.along(self.breaks[0][span], a, b));
            }
        }
        sum
    }

    /// A side with its crossings of knot lines, the first end included, the last one not.
    fn cut(&self, a: DVec2, b: DVec2) -> Vec<DVec2> {
        let mut cuts = vec![(0.0, a)];
        for axis in [0, 1] {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            let breaks = &self.breaks[axis];
            let first = breaks.partition_point(|&at| at <= low);
            for &at in breaks[first..].iter().take_while(|&&at| at < high) {
                let share = (at - a[axis]) / (b[axis] - a[axis]);
                let mut crossing = a.lerp(b, share);
                crossing[axis] = at;
                cuts.push((share, crossing));
            }
        }
        cuts.sort_by(|(s, _), (t, _)| s.total_cmp(t));
        cuts.into_iter().map(|(_, place)| place).collect()
    }

    fn span(&self, axis: usize, at: f64) -> usize {
        let breaks = &self.breaks[axis];
        breaks.partition_point(|&knot| knot <= at).clamp(1, breaks.len() - 1) - 1
    }

    /// The integral of F dv along a piece, with F from `start`.
    fn along(&self, start: f64, a: DVec2, b: DVec2) -> Sums {
        let mut sum = [0.0; 2];
        for (share, weight) in gauss(0.0, 1.0) {
            let place = a.lerp(b, share);
            let inner = self.row(start, place.x, place.y);
            sum = add(sum, inner.map(|part| weight * (b.y - a.y) * part));
        }
        sum
    }

    /// The integral over a span of u below `v`.
    fn below(&mut self, span: usize, v: f64) -> Sums {
        let last = self.span(1, v);
        let (from, to) = (self.breaks[0][span], self.breaks[0][span + 1]);
        if self.columns[span].is_none() {
            let mut sum = [0.0; 2];
            let mut column = vec![sum];
            for rows in self.breaks[1].windows(2) {
                sum = add(sum, self.rectangle([from, to], [rows[0], rows[1]]));
                column.push(sum);
            }
            self.columns[span] = Some(column);
        }
        let whole = self.columns[span].as_ref().map_or([0.0; 2], |column| column[last]);
        add(whole, self.rectangle([from, to], [self.breaks[1][last], v]))
    }

    fn rectangle(&self, u: [f64; 2], v: [f64; 2]) -> Sums {
        let rows = gauss(v[0], v[1]).map(|(v, weight)| self.row(u[0], u[1], v).map(|part| weight * part));
        rows.into_iter().fold([0.0; 2], add)
    }

    /// The integral along a line of constant v inside one span.
    fn row(&self, from: f64, to: f64, v: f64) -> Sums {
        let rule = gauss(from, to);
        let uv = rule.map(|(u, _)| DVec2::new(u, v));
        let mut rows = [0.0; 54];
        self.surface.eval_rows(&uv, 1, &mut rows);
        let mut sum = [0.0; 2];
        for ((_, weight), row) in rule.iter().zip(rows.chunks_exact(9)) {
            let [s, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
            let n = su.cross(sv);
            sum = add(sum, [weight * n.length(), weight * (s - self.center).dot(n) / 3.0]);
        }
        sum
    }
}
