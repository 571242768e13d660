//! Models of patches over a quad layout: a shell of faces that share their edges exactly, closed where the layout is.
//!
//! Each patch is a PHT-spline over `[0,1]^2` and gives one face for each rectangle of cells of nearly equal size.
//! ```text
//! +-------+---+---+    The side of a rectangle is cut wherever a rectangle on either side of it has a corner (o),
//! |       |   |   |    across edges of the layout too. Each piece is one edge of the model: a cubic with the knots of
//! |       o---o---+    the side that came first, used by the faces on both sides. Corners and pieces are known by
//! |       |       |    integers, so nothing is matched by distance.
//! +-------o-------+
//! ```

use super::{Builder, Coedge, EdgeId, FaceId, Model, ModelError, Role, VertexId, straight};
use crate::curve::Curve;
use crate::geometry::{Axis, Domain};
use crate::knots::KnotVector;
use crate::layout::{Layout, Place, Side};
use crate::surface::Surface;
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::TensorSurface;
use crate::tmesh::Vertex;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};

/// Patches over a layout in one piece.
#[derive(Debug, Clone, Copy)]
pub struct Patchwork<'a> {
    /// How the patches meet.
    pub layout: &'a Layout,
    /// One for each quad, with equal vertices along common edges.
    pub surfaces: &'a [PhtSurface],
    /// The solid, by its number among the pieces, in which this piece bounds a void: its fronts look into it.
    pub void_in: Option<usize>,
}

/// A model of patches, and which faces a patch became.
#[derive(Debug, Clone)]
pub struct PatchModel {
    /// The model: a shell for each piece, in order.
    pub model: Model,
    /// For each piece and quad the faces with the rectangles that they have of the quad's parameters.
    faces: Vec<Vec<Vec<(Domain, FaceId)>>>,
}

impl PatchModel {
    /// The face at a place of a piece; its parameters are those of the place.
    pub fn face_at(&self, piece: usize, place: Place) -> FaceId {
        let faces = &self.faces[piece][place.quad as usize];
        let holds = |(domain, _): &&(Domain, FaceId)| domain.contains(place.uv);
        // places lie in [0,1]^2, which the rectangles cover
        faces.iter().find(holds).unwrap_or(&faces[0]).1
    }
}

/// The model of patches over layouts, a shell for each; cells of one face differ by at most `level_spread` levels.
pub fn of_patches(pieces: &[Patchwork], level_spread: u32) -> Result<PatchModel, ModelError> {
    let mut builder = Builder::default();
    let mut shells = Vec::new();
    let mut faces = Vec::new();
    for piece in pieces {
        let of_piece = Stitching::new(piece, level_spread)?.build(&mut builder);
        let is_closed = piece.layout.edges().iter().all(|edge| edge.second.is_some());
        let role = match piece.void_in {
            Some(solid) if is_closed && solid < shells.len() => Role::VoidIn(shells[solid]),
            _ if is_closed => Role::Solid,
            _ => Role::Open,
        };
        shells.push(builder.shell(of_piece.iter().flatten().map(|&(_, face)| face).collect(), role));
        faces.push(of_piece);
    }
    Ok(PatchModel { model: builder.finish()?, faces })
}

/// A corner of rectangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Corner {
    /// At a vertex of the layout.
    Vertex(u32),
    /// Inside an edge of the layout, along its first side.
    OnEdge(u32, u32),
    /// Inside a quad.
    Inside(u32, Vertex),
}

/// A piece of a line between rectangles, from one integer to another along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Piece {
    /// Of an edge of the layout, along its first side.
    OfEdge(u32, [u32; 2]),
    /// Of a line inside a quad: at constant i, or else j.
    Inside(u32, bool, u32, [u32; 2]),
}

/// A rectangle of cells.
struct Tile {
    quad: u32,
    min: Vertex,
    max: Vertex,
    surface: TensorSurface,
}

/// The patches of one piece while faces are made of them.
struct Stitching<'a> {
    layout: &'a Layout,
    tiles: Vec<Tile>,
    /// Where lines inside quads are cut: by quad, direction and coordinate.
    cuts_inside: BTreeMap<(u32, bool, u32), BTreeSet<u32>>,
    /// Where edges of the layout are cut, along their first sides.
    cuts_of_edges: BTreeMap<u32, BTreeSet<u32>>,
    vertices: BTreeMap<Corner, VertexId>,
    edges: BTreeMap<Piece, KnownEdge>,
}

/// An edge that one face has already.
struct KnownEdge {
    id: EdgeId,
    /// Where it begins.
    start: Corner,
    /// In space.
    curve: Curve,
}

const UNIT: u32 = 1 << crate::tmesh::MAX_LEVEL;

impl<'a> Stitching<'a> {
    fn new(piece: &Patchwork<'a>, level_spread: u32) -> Result<Self, ModelError> {
        let mut tiles = Vec::new();
        for (quad, surface) in (0..).zip(piece.surfaces) {
            for surface in surface.to_tensor_patches(level_spread)? {
                let Domain { min, max } = surface.domain();
                tiles.push(Tile { quad, min: to_integers(min), max: to_integers(max), surface });
            }
        }
        let mut stitching = Self {
            layout: piece.layout,
            tiles,
            cuts_inside: BTreeMap::new(),
            cuts_of_edges: BTreeMap::new(),
            vertices: BTreeMap::new(),
            edges: BTreeMap::new(),
        };
        for tile in 0..stitching.tiles.len() {
            let Tile { quad, min, max, .. } = stitching.tiles[tile];
            for [i, j] in [[min.i, min.j], [max.i, min.j], [max.i, max.j], [min.i, max.j]] {
                stitching.cut(quad, Vertex { i, j });
            }
        }
        Ok(stitching)
    }

    /// Both lines through a corner are cut there.
    fn cut(&mut self, quad: u32, at: Vertex) {
        for (is_upright, line, along) in [(true, at.i, at.j), (false, at.j, at.i)] {
            match side_of_line(quad, is_upright, line) {
                Some(side) => {
                    let (edge, along) = self.on_edge(side, along);
                    self.cuts_of_edges.entry(edge).or_default().insert(along);
                }
                None => {
                    self.cuts_inside.entry((quad, is_upright, line)).or_default().insert(along);
                }
            }
        }
    }

    /// A coordinate along a side of a quad as one along the first side of the edge.
    fn on_edge(&self, side: Side, along: u32) -> (u32, u32) {
        let half_edge = self.layout.edge_of(side);
        // sides 2 and 3 run against i and j, second sides against the first
        let is_reversed = (side.side >= 2) == half_edge.is_forward;
        (half_edge.edge, if is_reversed { UNIT - along } else { along })
    }

    fn build(mut self, builder: &mut Builder) -> Vec<Vec<(Domain, FaceId)>> {
        let mut faces: Vec<Vec<(Domain, FaceId)>> = vec![Vec::new(); self.layout.quads().len()];
        for tile in std::mem::take(&mut self.tiles) {
            let mut bound = Vec::new();
            let Tile { quad, min, max, surface } = tile;
            // counterclockwise: along j = min, i = max, back along j = max, i = min
            for (is_upright, line, range, is_forward) in [
                (false, min.j, [min.i, max.i], true),
                (true, max.i, [min.j, max.j], true),
                (false, max.j, [min.i, max.i], false),
                (true, min.i, [min.j, max.j], false),
            ] {
                let mut pieces = self.pieces(quad, is_upright, line, range);
                if !is_forward {
                    pieces.reverse();
                }
                for range in pieces {
                    bound.push(self.coedge(builder, quad, &surface, (is_upright, line, range), is_forward));
                }
            }
            let domain = surface.domain();
            let surface = builder.surface(surface);
            faces[quad as usize].push((domain, builder.face(surface, vec![bound])));
        }
        faces
    }

    /// The parts of a side between the cuts, in the direction of increasing parameters.
    fn pieces(&self, quad: u32, is_upright: bool, line: u32, [from, to]: [u32; 2]) -> Vec<[u32; 2]> {
        let mut cuts: Vec<u32> = match side_of_line(quad, is_upright, line) {
            Some(side) => {
                let edge = self.layout.edge_of(side).edge;
                // the map on to the edge is its own inverse
                self.cuts_of_edges[&edge].iter().map(|&along| self.on_edge(side, along).1).collect()
            }
            None => self.cuts_inside[&(quad, is_upright, line)].iter().copied().collect(),
        };
        cuts.retain(|cut| (from..=to).contains(cut));
        cuts.sort_unstable();
        cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    fn coedge(
        &mut self,
        builder: &mut Builder,
        quad: u32,
        surface: &TensorSurface,
        (is_upright, line, range): (bool, u32, [u32; 2]),
        is_forward: bool,
    ) -> Coedge {
        let places =
            range.map(
                |along| {
                    if is_upright { Vertex { i: line, j: along } } else { Vertex { i: along, j: line } }
                },
            );
        let corners = places.map(|place| self.corner(quad, place));
        let piece = match side_of_line(quad, is_upright, line) {
            Some(side) => {
                let ends = range.map(|along| self.on_edge(side, along));
                Piece::OfEdge(ends[0].0, [ends[0].1.min(ends[1].1), ends[0].1.max(ends[1].1)])
            }
            None => Piece::Inside(quad, is_upright, line, range),
        };
        let known = self.edges.get(&piece).map(|known| (known.id, known.start));
        let (edge, start) = known.unwrap_or_else(|| {
            let curve = side_curve(surface, is_upright, places.map(to_parameters));
            let points = curve.control_points();
            let ends = [&points[..3], &points[points.len() - 3..]].map(DVec3::from_slice);
            let vertices =
                [0, 1].map(|k| *self.vertices.entry(corners[k]).or_insert_with(|| builder.vertex(ends[k])));
            let id = builder.edge(curve.clone(), vertices);
            self.edges.insert(piece, KnownEdge { id, start: corners[0], curve });
            (id, corners[0])
        });
        // the edge runs as its first user's parameters increase; this one's may decrease along it
        let runs_along = start == corners[0];
        let mut ends = places.map(to_parameters);
        if !runs_along {
            ends.reverse();
        }
        let pcurve = Some(straight(&self.edges[&piece].curve, ends));
        Coedge { edge, is_forward: is_forward == runs_along, pcurve }
    }

    fn corner(&self, quad: u32, at: Vertex) -> Corner {
        let side = [(true, at.i), (false, at.j)]
            .into_iter()
            .find_map(|(is_upright, line)| Some((side_of_line(quad, is_upright, line)?, is_upright)));
        let Some((side, is_upright)) = side else { return Corner::Inside(quad, at) };
        let (edge, along) = self.on_edge(side, if is_upright { at.j } else { at.i });
        let ends = self.layout.edges()[edge as usize].ends;
        match along {
            0 => Corner::Vertex(ends[0]),
            UNIT => Corner::Vertex(ends[1]),
            _ => Corner::OnEdge(edge, along),
        }
    }
}

/// The side of a quad that lies on a line.
fn side_of_line(quad: u32, is_upright: bool, line: u32) -> Option<Side> {
    let side = match (is_upright, line) {
        (false, 0) => 0,
        (true, UNIT) => 1,
        (false, UNIT) => 2,
        (true, 0) => 3,
        _ => return None,
    };
    Some(Side { quad, side })
}

fn to_integers(uv: DVec2) -> Vertex {
    // parameters of vertices are multiples of 2^-20
    let [i, j] = (uv * f64::from(UNIT)).to_array().map(|x| x as u32);
    Vertex { i, j }
}

fn to_parameters(at: Vertex) -> DVec2 {
    DVec2::new(f64::from(at.i), f64::from(at.j)) / f64::from(UNIT)
}

/// The cubic of a surface along a line of constant u (`is_upright`) or v, over the parameter that varies.
fn side_curve(surface: &TensorSurface, is_upright: bool, [from, to]: [DVec2; 2]) -> Curve {
    let (axis, along, across) = if is_upright { (Axis::V, 1, 0) } else { (Axis::U, 0, 1) };
    // the line may be cut where only its other side has a knot
    let (first, end) = (from[along], to[along]);
    let inner = surface.knots(axis).breaks().into_iter().filter(|&t| first < t && t < end);
    let breaks: Vec<f64> = [first].into_iter().chain(inner).chain([end]).collect();
    let places: Vec<DVec2> = breaks
        .iter()
        .map(|&t| if is_upright { DVec2::new(from[across], t) } else { DVec2::new(t, from[across]) })
        .collect();
    let mut rows = vec![0.0; 9 * places.len()];
    surface.eval_rows(&places, 1, &mut rows);
    let jet = |k: usize| {
        let slope = if is_upright { 6 } else { 3 };
        [0, slope].map(|first| DVec3::from_slice(&rows[9 * k + first..][..3]))
    };
    let last = breaks.len() - 1;
    let mut points = vec![jet(0)[0]];
    for k in 0..last {
        let third = (breaks[k + 1] - breaks[k]) / 3.0;
        let ([_, slope], [end, end_slope]) = (jet(k), jet(k + 1));
        points.extend([jet(k)[0] + third * slope, end - third * end_slope]);
    }
    points.push(jet(last)[0]);
    let doubled = breaks[1..last].iter().flat_map(|&t| [t, t]);
    let knots: Vec<f64> = [breaks[0]; 4].into_iter().chain(doubled).chain([breaks[last]; 4]).collect();
    let knots = KnotVector::new(knots, 3).expect("breaks increase");
    let numbers = points.iter().flat_map(|point| point.to_array()).collect();
    Curve::new(3, knots, numbers).expect("two control points a break")
}
