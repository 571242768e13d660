//! Models of surfaces in space: one face inside the trims, or a shell of faces that share edges where the surface is
//! cut into parts: a T-spline in strips, a PHT-spline in patches.
//!
//! Trims are polylines in (u,v) and bound the faces exactly: each edge has a p-curve of degree 1 through their points
//! and a cubic in space over the same parameters, the p-curve's image within a tolerance, with a kink wherever the
//! polyline has one. Smoothing the polylines would make curves that are easier to edit, but no longer the bounds that
//! every other call of the library keeps to.

mod image;
mod layout;
mod loops;
mod tiling;

use super::{Builder, Coedge, Model, ModelError, Role};
use crate::control::Watch;
use crate::curve::Curve;
use crate::geometry::{Bounds, Domain};
use crate::options::with_fields;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{AnySurface, ConvertError, Surface};
use glam::{DVec2, DVec3};
use image::{Image, image, points};
use layout::{Layout, PlaneEdge, Side, Trim, cut};
use tiling::Tiling;

/// What a model of a surface is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// The same surface as one tensor surface.
    #[default]
    Tensor,
    /// A T-spline as one face for each span of v, over the knots of four control curves: far fewer control points.
    Strips,
    /// A PHT-spline as one face for each rectangle of cells of nearly equal size.
    Patches,
}

/// How a surface becomes a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormOptions {
    /// What is made of a T-spline or PHT-spline.
    pub form: Form,
    /// By how much the levels of cells in one face of [`Form::Patches`] may differ.
    pub level_spread: u32,
    /// Most control points that [`Form::Tensor`] may take.
    pub max_coefficients: usize,
}

impl Default for FormOptions {
    fn default() -> Self {
        Self { form: Form::default(), level_spread: 1, max_coefficients: 4_000_000 }
    }
}

impl FormOptions {
    with_fields! {
        with_form form: Form,
        with_level_spread level_spread: u32,
        with_max_coefficients max_coefficients: usize,
    }
}

/// How near the curves of edges are to the surface, as a share of the diagonal.
pub const CURVE_TOLERANCE: f64 = 1e-7;

/// Sides nearer to each other than this share of the tolerance of curves are one: the curve of one is as near to the other
/// as curves may be.
const SEAM_SHARE: f64 = 0.1;

/// How far the surface of a face goes on beyond its trims, as a share of their ranges: a curve on the very border of a
/// surface is harder on programs that extend or offset it.
const MARGIN: f64 = 0.01;

/// A turn of the image by more than this is a corner: below 45 degrees, the corner of an octagon, and above the
/// turns of a round hole drawn with a dozen points. More corners only make more edges.
const CORNER_DEGREES: f64 = 40.0;

/// The part of a surface inside its trims, as an open shell. A spline over triangles is refused: a model of it is one
/// of a surface fitted to it.
pub fn of_surface(surface: &AnySurface, options: &FormOptions, watch: &Watch) -> Result<Model, ModelError> {
    let parts = match (surface, options.form) {
        (AnySurface::Tensor(tensor), _) => vec![around_trims(tensor)],
        (AnySurface::TSpline(tspline), Form::Strips) => tspline.to_strips().map_err(ConvertError::from)?,
        (AnySurface::Pht(pht), Form::Patches) => {
            pht.to_tensor_patches_watched(options.level_spread, watch)?
        }
        _ => vec![around_trims(&surface.to_tensor(options.max_coefficients, watch)?)],
    };
    of_parts_watched(surface.as_surface(), parts, watch)
}

/// The part of a surface around its trims and a little more, cut at knot lines where some are near: what lies farther
/// off belongs to no face, but programs draw it and count it into the box of the shape.
fn around_trims(surface: &TensorSurface) -> TensorSurface {
    let trims = &surface.region().trims;
    if trims.is_empty() {
        return surface.clone();
    }
    let trimmed = Domain::around(trims.loops().iter().flatten().copied());
    let (margin, whole) = (MARGIN * trimmed.size(), surface.domain());
    let [(u0, u1), (v0, v1)] = [
        (Axis::U, [trimmed.min.x, trimmed.max.x], margin.x),
        (Axis::V, [trimmed.min.y, trimmed.max.y], margin.y),
    ]
    .map(|(axis, [from, to], margin)| {
        let breaks = surface.knots(axis).breaks();
        let before = breaks.iter().rev().find(|&&at| at < from && from - margin <= at);
        let after = breaks.iter().find(|&&at| to < at && at <= to + margin);
        (before.copied().unwrap_or(from - margin), after.copied().unwrap_or(to + margin))
    });
    let part = Domain { min: whole.clamp(DVec2::new(u0, v0)), max: whole.clamp(DVec2::new(u1, v1)) };
    // of a surface whose numbers overflow the whole is left, for the writer to tell
    surface.restrict(part).unwrap_or_else(|_| surface.clone())
}

/// The faces that `parts`, which meet with equal parameters, have inside the trims of the `whole`.
pub fn of_parts(whole: &dyn Surface, parts: Vec<TensorSurface>) -> Result<Model, ModelError> {
    of_parts_watched(whole, parts, &Watch::default())
}

fn of_parts_watched(
    whole: &dyn Surface,
    parts: Vec<TensorSurface>,
    watch: &Watch,
) -> Result<Model, ModelError> {
    if whole.dim() != 3 {
        return Err(ModelError::Dimension { dim: whole.dim() });
    }
    let loops = loops::bounds(whole)?;
    let diagonal = Bounds::of_rows(&samples(whole, &loops), 3).diagonal();
    let tolerance = CURVE_TOLERANCE * diagonal;
    if !(diagonal.is_finite() && tolerance.is_normal()) {
        return Err(ModelError::Size { diagonal });
    }
    watch.check().map_err(ConvertError::from)?;
    let tiling = Tiling::new(parts.iter().map(|part| part.domain()).collect());
    let trims = cut(&loops, &tiling);
    if let Some(index) = trims.iter().position(|trim| trim.points.len() < 3) {
        return Err(ModelError::Collapsed { index });
    }
    let starts: Vec<Vec<usize>> = trims.iter().map(|trim| starts(&parts, trim)).collect();
    watch.check().map_err(ConvertError::from)?;
    let layout = Layout::new(&tiling, &trims, &starts);
    let mut images = Vec::with_capacity(layout.edges.len());
    for edge in &layout.edges {
        watch.check().map_err(ConvertError::from)?;
        let image = image(&parts[edge.left], &edge.polyline, tolerance)?;
        images.push((extent(&image) > tolerance).then_some(image));
    }
    for trim in 0..trims.len() {
        let mut edges = layout.edges.iter().zip(&images).filter(|(edge, _)| edge.trim == Some(trim));
        if edges.all(|(_, image)| image.is_none()) {
            return Err(ModelError::Collapsed { index: trim });
        }
    }
    let seams = seams(&parts, &layout.edges, &images, tiling.domain(), tolerance);
    assemble(parts, layout, images, &seams, diagonal)
}

/// Points of the surface inside the trims and on them.
fn samples(surface: &dyn Surface, loops: &[Vec<DVec2>]) -> Vec<f64> {
    const SAMPLES: usize = 33;
    let box_of_loops = Domain::around(loops.iter().flatten().copied());
    let trims = &surface.region().trims;
    let mut places: Vec<DVec2> = loops.concat();
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let share = DVec2::new(i as f64, j as f64) / (SAMPLES - 1) as f64;
            let uv = surface.domain().clamp(box_of_loops.min + share * box_of_loops.size());
            if trims.contains(uv) {
                places.push(uv);
            }
        }
    }
    let mut rows = vec![0.0; 3 * places.len()];
    surface.eval_rows(&places, 0, &mut rows);
    rows
}

/// Edges that are points in space, such as the side of a domain at a pole, are left out, and their ends are one
/// vertex.
fn assemble(
    parts: Vec<TensorSurface>,
    layout: Layout,
    images: Vec<Option<Image>>,
    seams: &[Option<Seam>],
    diagonal: f64,
) -> Result<Model, ModelError> {
    let mut numbers = Vertices::new(&layout.edges, &images, seams);
    let mut is_used = vec![false; layout.edges.len()];
    layout
        .faces
        .iter()
        .flat_map(|face| face.bounds.iter().flatten())
        .for_each(|side| is_used[side.edge] = true);
    // edges with length that bound a face, and the numbers of their vertices
    let mut kept = Vec::with_capacity(images.len());
    let mut places: Vec<Option<DVec3>> = Vec::new();
    for (((plane, image), is_used), seam) in layout.edges.iter().zip(images).zip(is_used).zip(seams) {
        kept.push(image.filter(|_| is_used && seam.is_none()).map(|image| {
            let vertices = plane.ends.map(|node| numbers.number(node));
            places.resize(numbers.count, None);
            let [start, end] = image.ends();
            for (vertex, place) in [(vertices[1], end), (vertices[0], start)] {
                places[vertex].get_or_insert(place);
            }
            (image, vertices)
        }));
    }
    let mut builder = Builder::default();
    let vertices: Vec<_> = places.into_iter().flatten().map(|place| builder.vertex(place)).collect();
    let edges: Vec<_> = kept
        .into_iter()
        .map(|edge| {
            edge.map(|(image, ends)| (builder.edge(image.curve, ends.map(|end| vertices[end])), image.pcurve))
        })
        .collect();
    let mut parts: Vec<Option<TensorSurface>> = parts.into_iter().map(Some).collect();
    let mut surfaces = vec![None; parts.len()];
    let mut faces = Vec::with_capacity(layout.faces.len());
    for face in layout.faces {
        let coedge = |side: &Side| match &seams[side.edge] {
            None => {
                let (edge, pcurve) = edges[side.edge].as_ref()?;
                Some(Coedge { edge: *edge, is_forward: side.is_forward, pcurve: Some(pcurve.clone()) })
            }
            Some(seam) => {
                let (edge, pcurve) = edges[seam.partner].as_ref()?;
                let pcurve = seam.across(pcurve);
                Some(Coedge { edge: *edge, is_forward: !side.is_forward, pcurve: Some(pcurve) })
            }
        };
        let bounds = face.bounds.iter().map(|bound| bound.iter().filter_map(coedge).collect::<Vec<_>>());
        let bounds: Vec<_> = bounds.filter(|bound| !bound.is_empty()).collect();
        if !bounds.is_empty() {
            let part = parts[face.rectangle].take();
            if let Some(part) = part {
                surfaces[face.rectangle] = Some(builder.surface(part));
            }
            let surface = surfaces[face.rectangle].expect("each rectangle has its part");
            faces.push(builder.face(surface, bounds));
        }
    }
    builder.shell(faces, Role::Open);
    builder.diagonal(diagonal);
    builder.finish()
}

/// An edge on the low side of the domain that is one in space with its partner on the high side, which runs against it:
/// there the surface closes on itself, as a tube does.
#[derive(Debug, Clone, Copy)]
struct Seam {
    partner: usize,
    /// The direction that closes.
    axis: usize,
    /// Its least parameter.
    start: f64,
}

impl Seam {
    /// The preimage of the partner on this side.
    fn across(&self, pcurve: &Curve) -> Curve {
        let mut points = pcurve.control_points().to_vec();
        points.iter_mut().skip(self.axis).step_by(2).for_each(|coordinate| *coordinate = self.start);
        let knots = pcurve.knots().clone();
        Curve::new(2, knots, points).expect("other coordinates are as many and as finite")
    }
}

/// Which edges are seams: their images differ by less than curves may be off the surface.
fn seams(
    parts: &[TensorSurface],
    edges: &[PlaneEdge],
    images: &[Option<Image>],
    domain: &Domain,
    tolerance: f64,
) -> Vec<Option<Seam>> {
    /// Places at which both sides of an edge are compared.
    const SAMPLES: usize = 33;
    let lies_at = |edge: &PlaneEdge, axis: usize, at: f64| edge.polyline.iter().all(|p| p[axis] == at);
    let is_against = |edge: &PlaneEdge, other: &PlaneEdge, along: usize| {
        let pairs = edge.polyline.iter().zip(other.polyline.iter().rev());
        edge.polyline.len() == other.polyline.len() && pairs.into_iter().all(|(p, q)| p[along] == q[along])
    };
    let are_one = |edge: &PlaneEdge, other: &PlaneEdge| {
        let places = |edge: &PlaneEdge| -> Vec<DVec2> {
            let sides = edge.polyline.windows(2);
            sides
                .flat_map(|s| (0..=SAMPLES).map(move |k| s[0].lerp(s[1], k as f64 / SAMPLES as f64)))
                .collect()
        };
        let here = points(&parts[edge.left], &places(edge));
        let there = points(&parts[other.left], &places(other));
        here.iter().zip(there.iter().rev()).all(|(a, b)| a.distance(*b) <= SEAM_SHARE * tolerance)
    };
    let seam = |(edge, image): (&PlaneEdge, &Option<Image>)| {
        image.as_ref()?;
        (0..2).find_map(|axis| {
            let (start, end) = (domain.min[axis], domain.max[axis]);
            if !lies_at(edge, axis, start) {
                return None;
            }
            let is_partner = |other: &PlaneEdge| {
                lies_at(other, axis, end) && is_against(edge, other, 1 - axis) && are_one(edge, other)
            };
            let partner =
                edges.iter().zip(images).position(|(other, image)| image.is_some() && is_partner(other));
            partner.map(|partner| Seam { partner, axis, start })
        })
    };
    edges.iter().zip(images).map(seam).collect()
}

/// Vertices for the ends of edges, one for all ends that are joined by edges without length.
struct Vertices {
    /// An end nearer to the one that stands for all.
    parent: Vec<usize>,
    number: Vec<Option<usize>>,
    count: usize,
}

impl Vertices {
    fn new(edges: &[PlaneEdge], images: &[Option<Image>], seams: &[Option<Seam>]) -> Self {
        let count = edges.iter().flat_map(|edge| edge.ends).max().map_or(0, |last| last + 1);
        let mut vertices = Self { parent: (0..count).collect(), number: vec![None; count], count: 0 };
        for (edge, _) in edges.iter().zip(images).filter(|(_, image)| image.is_none()) {
            let [a, b] = edge.ends.map(|end| vertices.root(end));
            vertices.parent[b] = a;
        }
        for (edge, seam) in edges.iter().zip(seams) {
            let Some(seam) = seam else { continue };
            let [end, start] = edges[seam.partner].ends;
            for (here, there) in edge.ends.into_iter().zip([start, end]) {
                let (here, there) = (vertices.root(here), vertices.root(there));
                vertices.parent[here] = there;
            }
        }
        vertices
    }

    fn root(&self, mut end: usize) -> usize {
        while self.parent[end] != end {
            end = self.parent[end];
        }
        end
    }

    fn number(&mut self, end: usize) -> usize {
        let root = self.root(end);
        *self.number[root].get_or_insert_with(|| {
            self.count += 1;
            self.count - 1
        })
    }
}

/// How far an edge gets from where it begins.
fn extent(image: &Image) -> f64 {
    let points = image.curve.control_points();
    let start = DVec3::from_slice(points);
    points.chunks_exact(3).map(|point| start.distance(DVec3::from_slice(point))).fold(0.0, f64::max)
}

/// Where edges begin: at the corners, and if there are fewer than two, also half way round.
fn starts(surfaces: &[TensorSurface], trim: &Trim) -> Vec<usize> {
    let count = trim.points.len();
    let mut starts: Vec<usize> = (0..count).filter(|&k| is_corner(surfaces, trim, k)).collect();
    if starts.len() < 2 {
        let first = starts.first().copied().unwrap_or(0);
        let place = |k: usize| points(&surfaces[trim.left[k]], &trim.points[k..=k])[0];
        starts = vec![first, half_way(&(0..count).map(place).collect::<Vec<_>>(), first)];
        starts.sort_unstable();
    }
    starts
}

/// The point of a closed polyline that is most nearly half its length away from another.
fn half_way(points: &[DVec3], first: usize) -> usize {
    let count = points.len();
    let mut along = 0.0;
    let lengths: Vec<f64> = (0..count)
        .map(|k| {
            along += points[(first + k) % count].distance(points[(first + k + 1) % count]);
            along
        })
        .collect();
    let from_half = |k: &usize| (lengths[*k] - 0.5 * along).abs();
    let nearest = (0..count - 1).min_by(|a, b| from_half(a).total_cmp(&from_half(b))).unwrap_or(0);
    (first + nearest + 1) % count
}

/// Whether the image of a trim turns sharply at a point.
fn is_corner(surfaces: &[TensorSurface], trim: &Trim, k: usize) -> bool {
    let count = trim.points.len();
    let tangent = |from: usize, to: usize, side: usize| {
        let mut row = [0.0; 9];
        surfaces[trim.left[side]].eval_rows(&trim.points[k..=k], 1, &mut row);
        let along = trim.points[to] - trim.points[from];
        let [su, sv] = [3, 6].map(|column| DVec3::from_slice(&row[column..]));
        (su * along.x + sv * along.y).normalize_or_zero()
    };
    let before = (k + count - 1) % count;
    let turn = tangent(before, k, before).dot(tangent(k, (k + 1) % count, k));
    turn < CORNER_DEGREES.to_radians().cos()
}
