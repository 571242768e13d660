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
//! Beside the patches there may be planes. A plane is one face, whose loops are made of the sharp edges of the layout, piece
//! by piece as the patches have them, and of straight lines to other planes.

use super::{
    Builder, Coedge, Edge, EdgeId, Face, FaceId, Loop, Model, ModelError, Plane, Role, VertexId, straight,
};
use crate::curve::Curve;
use crate::geometry::{Axis, Domain};
use crate::knots::KnotVector;
use crate::layout::{HalfEdge, Layout, Place, Side};
use crate::surface::Surface;
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::TensorSurface;
use crate::tmesh::Vertex;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};

/// A vertex in the loop of a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RimVertex {
    /// One of the layout.
    Layout(u32),
    /// One that only planes have, by its number in [`Planes::vertices`].
    Further(u32),
}

/// A part of the loop of a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rim {
    /// An edge of the layout, in the direction in which the loop runs.
    Edge(HalfEdge),
    /// A straight line.
    Line([RimVertex; 2]),
}

/// A face in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneFace {
    /// Its normal points out of the front.
    pub plane: Plane,
    /// Its loops, each closed, with the face on the left.
    pub loops: Vec<Vec<Rim>>,
    /// What the caller calls it.
    pub label: u32,
}

/// The planes beside patches.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Planes {
    /// Places of vertices that the layout does not have.
    pub vertices: Vec<DVec3>,
    /// The faces.
    pub faces: Vec<PlaneFace>,
}

/// Patches over a layout, and planes, in one shell.
#[derive(Debug, Clone, Copy)]
pub struct Patchwork<'a> {
    /// How the patches meet.
    pub layout: &'a Layout,
    /// One for each quad, with equal vertices along common edges.
    pub surfaces: &'a [PhtSurface],
    /// What closes it where the layout has borders.
    pub planes: Option<&'a Planes>,
    /// What the caller calls each patch; empty for nothing, which is 0.
    pub labels: &'a [u32],
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
    /// For each piece its planes.
    planes: Vec<Vec<FaceId>>,
}

impl PatchModel {
    /// The face of a plane of a piece.
    pub fn plane_at(&self, piece: usize, plane: usize) -> FaceId {
        self.planes[piece][plane]
    }

    /// The face at a place of a piece; its parameters are those of the place.
    pub fn face_at(&self, piece: usize, place: Place) -> FaceId {
        let faces = &self.faces[piece][place.quad as usize];
        let holds = |(domain, _): &&(Domain, FaceId)| domain.contains(place.uv);
        // places lie in [0,1]^2, which the rectangles cover
        faces.iter().find(holds).unwrap_or(&faces[0]).1
    }

    /// For each face its piece and, in that, its quad.
    pub fn patch_of_face(&self) -> Vec<Option<[u32; 2]>> {
        let mut patches = vec![None; self.model.faces().len()];
        for (piece, quads) in (0..).zip(&self.faces) {
            for (quad, faces) in (0..).zip(quads) {
                faces.iter().for_each(|&(_, face)| patches[face.index()] = Some([piece, quad]));
            }
        }
        patches
    }
}

/// The model of patches over layouts, a shell for each; cells of one face differ by at most `level_spread` levels.
pub fn of_patches(pieces: &[Patchwork], level_spread: u32) -> Result<PatchModel, ModelError> {
    let mut builder = Builder::default();
    let mut shells = Vec::new();
    let (mut faces, mut planes) = (Vec::new(), Vec::new());
    for piece in pieces {
        let mut stitching = Stitching::new(piece, level_spread)?;
        let of_patches = stitching.build(&mut builder);
        let of_planes = stitching.add_planes(&mut builder);
        let role = match piece.void_in {
            Some(solid) if stitching.is_closed() && solid < shells.len() => Role::VoidIn(shells[solid]),
            _ if stitching.is_closed() => Role::Solid,
            _ => Role::Open,
        };
        let all = of_patches.iter().flatten().map(|&(_, face)| face).chain(of_planes.iter().copied());
        shells.push(builder.shell(all.collect(), role));
        faces.push(of_patches);
        planes.push(of_planes);
    }
    Ok(PatchModel { model: builder.finish()?, faces, planes })
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
    /// Of planes only.
    Further(u32),
}

/// A piece of a line between rectangles, from one integer to another along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Piece {
    /// Of an edge of the layout, along its first side.
    OfEdge(u32, [u32; 2]),
    /// Of a line inside a quad: at constant i, or else j.
    Inside(u32, bool, u32, [u32; 2]),
    /// Straight between two corners, the smaller first.
    Line([Corner; 2]),
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
    planes: Option<&'a Planes>,
    /// By patch.
    labels: &'a [u32],
    /// Edges of the layout in the loops of planes.
    rims: BTreeSet<u32>,
}

/// An edge that one face has already.
struct KnownEdge {
    id: EdgeId,
    /// Where it begins.
    start: Corner,
    /// In space.
    curve: Curve,
    /// Faces that have it.
    uses: u32,
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
        let rims = piece.planes.iter().flat_map(|planes| &planes.faces).flat_map(|face| &face.loops);
        let rims = rims.flatten().filter_map(|rim| match rim {
            Rim::Edge(half_edge) => Some(half_edge.edge),
            Rim::Line(_) => None,
        });
        let mut stitching = Self {
            planes: piece.planes,
            labels: piece.labels,
            rims: rims.collect(),
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

    fn build(&mut self, builder: &mut Builder) -> Vec<Vec<(Domain, FaceId)>> {
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
            let label = self.labels.get(quad as usize).copied().unwrap_or(0);
            let face = Face { surface, is_forward: true, bounds: vec![bound], label };
            faces[quad as usize].push((domain, builder.add_face(face)));
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
            let is_sharp = match piece {
                Piece::OfEdge(edge, _) => {
                    let is_crease = self.layout.edges()[edge as usize].second.is_some();
                    !self.layout.is_smooth(edge) && (is_crease || self.rims.contains(&edge))
                }
                _ => false,
            };
            let id = builder.add_edge(Edge { curve: curve.clone().into(), vertices, is_sharp });
            self.edges.insert(piece, KnownEdge { id, start: corners[0], curve, uses: 0 });
            (id, corners[0])
        });
        self.count_use(piece);
        // the edge runs as its first user's parameters increase; this one's may decrease along it
        let runs_along = start == corners[0];
        let mut ends = places.map(to_parameters);
        if !runs_along {
            ends.reverse();
        }
        let pcurve = Some(straight(&self.edges[&piece].curve, ends));
        Coedge { edge, is_forward: is_forward == runs_along, pcurve }
    }

    fn count_use(&mut self, piece: Piece) {
        if let Some(known) = self.edges.get_mut(&piece) {
            known.uses += 1;
        }
    }

    /// Whether every edge has two faces.
    fn is_closed(&self) -> bool {
        self.edges.values().all(|edge| edge.uses == 2)
    }

    /// Faces of the planes, over edges that the patches have already.
    fn add_planes(&mut self, builder: &mut Builder) -> Vec<FaceId> {
        let Some(planes) = self.planes else { return Vec::new() };
        let mut faces = Vec::new();
        for face in &planes.faces {
            let mut bounds: Vec<(f64, Loop)> = Vec::new();
            for rims in &face.loops {
                let (mut bound, mut points) = (Loop::new(), Vec::new());
                for &rim in rims {
                    for (piece, start) in self.pieces_of_rim(builder, planes, rim) {
                        let known = &self.edges[&piece];
                        let is_forward = known.start == start;
                        bound.push(Coedge { edge: known.id, is_forward, pcurve: None });
                        let mut along: Vec<DVec3> =
                            known.curve.control_points().chunks_exact(3).map(DVec3::from_slice).collect();
                        if !is_forward {
                            along.reverse();
                        }
                        points.extend(along);
                        self.count_use(piece);
                    }
                }
                bounds.push((area(&points, face.plane.0.z()), bound));
            }
            // the outer loop has the face inside: of all its area is the largest
            bounds.sort_by(|a, b| b.0.total_cmp(&a.0));
            let surface = builder.surface(face.plane);
            let bounds = bounds.into_iter().map(|(_, bound)| bound).collect();
            faces.push(builder.add_face(Face { surface, is_forward: true, bounds, label: face.label }));
        }
        faces
    }

    /// The edges of a part of a loop, with the corners at which the loop enters them.
    fn pieces_of_rim(&mut self, builder: &mut Builder, planes: &Planes, rim: Rim) -> Vec<(Piece, Corner)> {
        match rim {
            Rim::Edge(HalfEdge { edge, is_forward }) => {
                let cuts: Vec<u32> = self.cuts_of_edges[&edge].iter().copied().collect();
                let of_pair = |pair: &[u32]| {
                    let start = if is_forward { pair[0] } else { pair[1] };
                    (Piece::OfEdge(edge, [pair[0], pair[1]]), self.corner_on(edge, start))
                };
                let mut pieces: Vec<(Piece, Corner)> = cuts.windows(2).map(of_pair).collect();
                if !is_forward {
                    pieces.reverse();
                }
                pieces
            }
            Rim::Line(ends) => {
                let corners = ends.map(|end| match end {
                    RimVertex::Layout(vertex) => Corner::Vertex(vertex),
                    RimVertex::Further(number) => Corner::Further(number),
                });
                let piece = Piece::Line([corners[0].min(corners[1]), corners[0].max(corners[1])]);
                if !self.edges.contains_key(&piece) {
                    let vertices = [0, 1].map(|k| {
                        *self.vertices.entry(corners[k]).or_insert_with(|| match ends[k] {
                            RimVertex::Further(number) => builder.vertex(planes.vertices[number as usize]),
                            RimVertex::Layout(_) => {
                                unreachable!("the patches have all vertices of their layout")
                            }
                        })
                    });
                    let curve = line(vertices.map(|vertex| builder.place(vertex)));
                    let id = builder.add_edge(Edge { curve: curve.clone().into(), vertices, is_sharp: true });
                    self.edges.insert(piece, KnownEdge { id, start: corners[0], curve, uses: 0 });
                }
                vec![(piece, corners[0])]
            }
        }
    }

    fn corner(&self, quad: u32, at: Vertex) -> Corner {
        let side = [(true, at.i), (false, at.j)]
            .into_iter()
            .find_map(|(is_upright, line)| Some((side_of_line(quad, is_upright, line)?, is_upright)));
        let Some((side, is_upright)) = side else { return Corner::Inside(quad, at) };
        let (edge, along) = self.on_edge(side, if is_upright { at.j } else { at.i });
        self.corner_on(edge, along)
    }

    fn corner_on(&self, edge: u32, along: u32) -> Corner {
        let ends = self.layout.edges()[edge as usize].ends;
        match along {
            0 => Corner::Vertex(ends[0]),
            UNIT => Corner::Vertex(ends[1]),
            _ => Corner::OnEdge(edge, along),
        }
    }
}

/// The area that a closed polygon has around a normal: negative the other way round.
fn area(points: &[DVec3], normal: DVec3) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    let doubled: DVec3 = points.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum();
    0.5 * doubled.dot(normal)
}

/// The straight curve between two places.
fn line(ends: [DVec3; 2]) -> Curve {
    let knots = KnotVector::clamped(&[0.0, 1.0], 1).expect("the unit interval");
    Curve::new(3, knots, ends.iter().flat_map(|end| end.to_array()).collect()).expect("two control points")
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
