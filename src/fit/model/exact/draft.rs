//! Faces, edges and vertices of exact carriers before they are a model.

use super::Obstacle;
use super::edges::{Meeting, Shape, corner, meet, sine_at};
use super::evidence::gradient;
use super::recognize::Recognized;
use super::rim::rim;
use crate::mesh::{Chain, Features, Mesh, Regions};
use crate::model::{
    Builder, Carrier, Coedge, Cylinder, Edge, EdgeCurve, EdgeId, FaceId, Frame, ModelError, Plane, VertexId,
};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// A piece of a curve between two vertices.
#[derive(Debug, Clone)]
pub(crate) struct DraftEdge {
    pub shape: Shape,
    pub vertices: [usize; 2],
    /// Parameters at the vertices; they increase.
    pub ends: [f64; 2],
    pub is_smooth: bool,
}

impl DraftEdge {
    /// Whether nothing but itself says where it begins.
    pub(crate) fn is_ring(&self) -> bool {
        self.vertices[0] == self.vertices[1]
    }
}

/// Edges in order, and whether the loop runs along them.
pub(crate) type DraftLoop = Vec<(usize, bool)>;

/// A bounded part of a carrier.
#[derive(Debug, Clone)]
pub(crate) struct DraftFace {
    pub carrier: Carrier,
    /// Whether its front is the side to which the carrier's normal points.
    pub is_forward: bool,
    /// The outer one first.
    pub loops: Vec<DraftLoop>,
    /// That of its triangles.
    pub label: u32,
}

/// What a model is made of.
#[derive(Debug, Clone, Default)]
pub(crate) struct Draft {
    pub vertices: Vec<DVec3>,
    pub edges: Vec<DraftEdge>,
    pub faces: Vec<DraftFace>,
    /// By corner of the features: its vertex.
    pub corners: BTreeMap<u32, usize>,
    /// Vertices of rings that another face counts on.
    pub held: Vec<usize>,
}

/// Edges of a model end in its vertices within this part of the diagonal, the least that other programs tell apart.
const CORNER: f64 = 5e-8;
/// Nodes of an edge may be off by this many deviations of noise.
const NOISE: f64 = 5.0;
/// Sine below which the angle of two faces no longer magnifies what is allowed at their edge.
const LEAST_SINE: f64 = 0.2;

/// Lengths against which a draft is checked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    pub tolerance: f64,
    pub noise: f64,
    pub diagonal: f64,
}

impl Draft {
    /// Of regions that all have a carrier. Labels are those of the triangles, or none.
    pub(crate) fn new(
        mesh: &Mesh,
        features: &Features,
        regions: &Regions,
        found: &[Recognized],
        labels: &[u32],
        scale: &Scale,
    ) -> Result<Self, Obstacle> {
        let mut draft = Self::default();
        let rims = rims(mesh, features, regions, found, scale)?;
        let meetings = features.chains.iter().enumerate().map(|(chain, of)| {
            let places = places_of(mesh, of);
            let beside = beside(regions, found, &rims, chain)?;
            let meeting = meet(beside[0], beside[1], &places).ok_or(Obstacle::Edge { chain })?;
            check_places(&meeting, beside, &places, scale).then_some(meeting).ok_or(Obstacle::Edge { chain })
        });
        let meetings = meetings.collect::<Result<Vec<Meeting>, Obstacle>>()?;
        draft.add_corners(mesh, features, regions, (found, &rims), &meetings, scale)?;
        for (chain, (of, meeting)) in features.chains.iter().zip(&meetings).enumerate() {
            let mut edge = draft.edge(mesh, of, meeting).ok_or(Obstacle::Edge { chain })?;
            // an edge of one face meets nothing at an angle
            edge.is_smooth |= rims[chain].is_some();
            draft.edges.push(edge);
        }
        for (region, of) in regions.regions.iter().enumerate() {
            let found = &found[region];
            let one_loop = |row: &Vec<crate::mesh::Side>| {
                row.iter().map(|side| (side.chain as usize, side.is_forward)).collect()
            };
            draft.faces.push(DraftFace {
                carrier: found.carrier.clone(),
                is_forward: found.evidence.looks_along(&found.carrier),
                loops: of.loops.iter().map(one_loop).collect(),
                label: labels.get(of.triangles[0] as usize).copied().unwrap_or(0),
            });
        }
        let polygons = |face: &DraftFace| -> Vec<Vec<DVec3>> {
            face.loops.iter().map(|row| polygon(mesh, &features.chains, row)).collect()
        };
        // seams cut edges of faces that come later
        let polygons: Vec<_> = draft.faces.iter().map(polygons).collect();
        for (face, polygons) in polygons.iter().enumerate() {
            draft.order_loops(face, polygons)?;
        }
        Ok(draft)
    }

    /// A vertex for each corner: where all carriers around it meet.
    fn add_corners(
        &mut self,
        mesh: &Mesh,
        features: &Features,
        regions: &Regions,
        (found, rims): (&[Recognized], &[Option<Carrier>]),
        meetings: &[Meeting],
        scale: &Scale,
    ) -> Result<(), Obstacle> {
        let ends_at = |is_asked: &dyn Fn(usize) -> bool| {
            let mut ends: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
            for (chain, of) in features.chains.iter().enumerate().filter(|&(chain, _)| is_asked(chain)) {
                for &end in of.nodes.first().into_iter().chain(of.nodes.last()) {
                    ends.entry(end).or_default().push(chain);
                }
            }
            ends
        };
        let smooth_at = ends_at(&|chain| meetings[chain].is_smooth);
        let rims_at = ends_at(&|chain| rims[chain].is_some());
        for &node in &features.corners {
            let mut around: Vec<u32> =
                mesh.outgoing(node).map(|edge| regions.of_triangle[edge.triangle()]).collect();
            around.sort_unstable();
            around.dedup();
            let mut carriers: Vec<Carrier> =
                around.iter().map(|&region| found[region as usize].carrier.clone()).collect();
            for &chain in smooth_at.get(&node).into_iter().flatten() {
                let [left, _] = sides(regions, chain)?;
                carriers.extend(meetings[chain].shape.upright(&found[left as usize].carrier));
            }
            carriers
                .extend(rims_at.get(&node).into_iter().flatten().filter_map(|&chain| rims[chain].clone()));
            let place = mesh.points()[node as usize];
            let (vertex, off) = corner(&carriers, place).ok_or(Obstacle::Corner { node })?;
            let is_near = smooth_at.contains_key(&node) || vertex.distance(place) <= reach(scale, LEAST_SINE);
            if off > CORNER * scale.diagonal || !is_near {
                return Err(Obstacle::Corner { node });
            }
            self.corners.insert(node, self.vertices.len());
            self.vertices.push(vertex);
        }
        Ok(())
    }

    /// The piece of a curve along a chain.
    fn edge(&mut self, mesh: &Mesh, chain: &Chain, meeting: &Meeting) -> Option<DraftEdge> {
        let mut places = places_of(mesh, chain);
        let corners = [chain.nodes.first()?, chain.nodes.last()?].map(|node| self.corners.get(node).copied());
        let vertices = match (chain.is_closed, corners) {
            (true, _) => {
                let first = meeting.shape.place(meeting.shape.parameter(places[0]));
                places[0] = first;
                places.push(first);
                self.vertices.push(first);
                [self.vertices.len() - 1; 2]
            }
            (false, [Some(start), Some(end)]) => {
                let last = places.len() - 1;
                places[0] = self.vertices[start];
                places[last] = self.vertices[end];
                [start, end]
            }
            _ => return None,
        };
        let sweep = meeting.shape.sweep(places.iter().copied());
        let shape = if sweep < 0.0 { meeting.shape.reversed()? } else { meeting.shape };
        let is_whole = vertices[0] == vertices[1];
        if is_whole && (sweep.abs() - TAU).abs() > 1e-6 {
            return None;
        }
        let from = shape.parameter(places[0]);
        let sweep = if is_whole { TAU } else { sweep.abs() };
        (sweep > 0.0).then_some(DraftEdge {
            shape,
            vertices,
            ends: [from, from + sweep],
            is_smooth: meeting.is_smooth,
        })
    }

    /// The outer loop first; two loops round a cylinder become one with a seam.
    fn order_loops(&mut self, face: usize, polygons: &[Vec<DVec3>]) -> Result<(), Obstacle> {
        let refuse = Obstacle::Loops { region: face };
        let (carrier, is_forward) = (self.faces[face].carrier.clone(), self.faces[face].is_forward);
        let sense = if is_forward { 1.0 } else { -1.0 };
        if let Carrier::Cylinder(cylinder) = &carrier {
            let round = Shape::Conic { frame: *cylinder.frame(), radii: [cylinder.radius(); 2] };
            let turn = |polygon: &Vec<DVec3>| {
                let closed = polygon.iter().chain(polygon.first()).copied();
                (round.sweep(closed) / TAU).round() as i32
            };
            let turns: Vec<i32> = polygons.iter().map(turn).collect();
            let winding: Vec<usize> = (0..turns.len()).filter(|&k| turns[k] != 0).collect();
            match winding[..] {
                [] => {}
                [a, b] if turns[a] + turns[b] == 0 && turns[a].abs() == 1 => {
                    let holes = (0..turns.len()).filter(|&k| turns[k] == 0).map(|k| &polygons[k]);
                    let holes: Vec<[f64; 2]> = holes.map(|hole| angles(&round, hole)).collect();
                    return self.add_seam(face, [a, b], &round, &holes).ok_or(refuse);
                }
                _ => return Err(refuse),
            }
        }
        let areas = polygons.iter().map(|polygon| sense * area(&carrier, polygon));
        let outer: Vec<usize> = areas.enumerate().filter(|(_, area)| *area > 0.0).map(|(k, _)| k).collect();
        let [outer] = outer[..] else { return Err(refuse) };
        self.faces[face].loops.swap(0, outer);
        Ok(())
    }

    /// The same elsewhere.
    pub(crate) fn moved(mut self, by: DVec3) -> Option<Self> {
        let moved = |frame: &Frame| Frame::from_axes(frame.origin() + by, frame.z(), frame.x());
        self.vertices.iter_mut().for_each(|place| *place += by);
        for edge in &mut self.edges {
            match &mut edge.shape {
                Shape::Line { origin, .. } => *origin += by,
                Shape::Conic { frame, .. } => *frame = moved(frame)?,
            }
        }
        for face in &mut self.faces {
            face.carrier = match &face.carrier {
                Carrier::Plane(Plane(frame)) => Plane(moved(frame)?).into(),
                Carrier::Cylinder(cylinder) => {
                    Cylinder::new(moved(cylinder.frame())?, cylinder.radius())?.into()
                }
                Carrier::Spline(_) => return None,
            };
        }
        Some(self)
    }

    /// The loops of all faces with edges of a model.
    pub(crate) fn build(&self, builder: &mut Builder) -> Result<Vec<FaceId>, ModelError> {
        let vertices: Vec<VertexId> = self.vertices.iter().map(|&place| builder.vertex(place)).collect();
        let curve = |edge: &DraftEdge| -> Option<EdgeCurve> {
            match edge.shape {
                // a line ends in its vertices to the bit
                Shape::Line { .. } => EdgeCurve::line(edge.vertices.map(|vertex| self.vertices[vertex])),
                Shape::Conic { .. } => edge.shape.part(edge.ends),
            }
        };
        let mut edges: Vec<EdgeId> = Vec::with_capacity(self.edges.len());
        for (index, edge) in self.edges.iter().enumerate() {
            let curve = curve(edge).ok_or(ModelError::NoSuch { part: "edge", index })?;
            let ends = edge.vertices.map(|vertex| vertices[vertex]);
            edges.push(builder.add_edge(Edge { curve, vertices: ends, is_sharp: !edge.is_smooth }));
        }
        let coedge =
            |&(edge, is_forward): &(usize, bool)| Coedge { edge: edges[edge], is_forward, pcurve: None };
        let mut faces = Vec::with_capacity(self.faces.len());
        for face in &self.faces {
            let surface = builder.surface(face.carrier.clone());
            let bounds = face.loops.iter().map(|row| row.iter().map(coedge).collect()).collect();
            faces.push(builder.add_face(crate::model::Face {
                surface,
                is_forward: face.is_forward,
                bounds,
                label: face.label,
            }));
        }
        Ok(faces)
    }
}

/// The regions on both sides of a chain, which must be two.
fn sides(regions: &Regions, chain: usize) -> Result<[u32; 2], Obstacle> {
    match regions.beside[chain] {
        [Some(left), Some(right)] if left != right => Ok([left, right]),
        _ => Err(Obstacle::Edge { chain }),
    }
}

/// By chain on the border: what the face beside it meets there.
fn rims(
    mesh: &Mesh,
    features: &Features,
    regions: &Regions,
    found: &[Recognized],
    scale: &Scale,
) -> Result<Vec<Option<Carrier>>, Obstacle> {
    let rim_of = |(chain, of): (usize, &Chain)| match regions.beside[chain] {
        [Some(region), None] | [None, Some(region)] => {
            let carrier = &found[region as usize].carrier;
            let rim = rim(carrier, &places_of(mesh, of), scale.tolerance.max(NOISE * scale.noise));
            rim.map(Some).ok_or(Obstacle::Edge { chain })
        }
        _ => Ok(None),
    };
    features.chains.iter().enumerate().map(rim_of).collect()
}

/// The carriers on both sides of a chain.
fn beside<'a>(
    regions: &Regions,
    found: &'a [Recognized],
    rims: &'a [Option<Carrier>],
    chain: usize,
) -> Result<[&'a Carrier; 2], Obstacle> {
    match (regions.beside[chain], &rims[chain]) {
        ([Some(region), None] | [None, Some(region)], Some(rim)) => {
            Ok([&found[region as usize].carrier, rim])
        }
        _ => Ok(sides(regions, chain)?.map(|region| &found[region as usize].carrier)),
    }
}

fn places_of(mesh: &Mesh, chain: &Chain) -> Vec<DVec3> {
    chain.nodes.iter().map(|&node| mesh.points()[node as usize]).collect()
}

/// How far nodes may be from an edge at which faces meet at this sine.
fn reach(scale: &Scale, sine: f64) -> f64 {
    scale.tolerance.max(NOISE * scale.noise / sine.max(LEAST_SINE))
}

/// Whether the nodes of a chain lie on its curve. Where faces are tangent the nodes lie on both, wherever the chain runs.
fn check_places(meeting: &Meeting, beside: [&Carrier; 2], places: &[DVec3], scale: &Scale) -> bool {
    meeting.is_smooth
        || places
            .iter()
            .all(|&place| meeting.shape.distance(place) <= reach(scale, sine_at(beside[0], beside[1], place)))
}

/// The nodes of a loop in order, each once.
fn polygon(mesh: &Mesh, chains: &[Chain], row: &DraftLoop) -> Vec<DVec3> {
    let mut places = Vec::new();
    for &(chain, is_forward) in row {
        let mut of_chain = places_of(mesh, &chains[chain]);
        if !is_forward {
            of_chain.reverse();
        }
        if chains[chain].is_closed {
            return of_chain;
        }
        of_chain.pop();
        places.extend(of_chain);
    }
    places
}

/// The area within a polygon on a plane or unrolled cylinder, positive if it runs counter-clockwise about the normal.
fn area(carrier: &Carrier, polygon: &[DVec3]) -> f64 {
    let pairs = polygon.iter().zip(polygon.iter().cycle().skip(1));
    match carrier {
        Carrier::Cylinder(cylinder) => {
            let frame = cylinder.frame();
            let round = Shape::Conic { frame: *frame, radii: [cylinder.radius(); 2] };
            let height = |place: DVec3| (place - frame.origin()).dot(frame.z());
            let under = pairs.map(|(&a, &b)| {
                -0.5 * (height(a) + height(b)) * round.sweep([a, b].into_iter()) * cylinder.radius()
            });
            under.sum()
        }
        _ => {
            let origin = polygon.first().copied().unwrap_or_default();
            let normal = gradient(carrier, origin);
            0.5 * pairs.map(|(&a, &b)| (a - origin).cross(b - origin).dot(normal)).sum::<f64>()
        }
    }
}

/// The range of angles of a loop that does not go round.
fn angles(round: &Shape, polygon: &[DVec3]) -> [f64; 2] {
    let mut angle = polygon.first().map_or(0.0, |&place| round.parameter(place));
    let mut range = [angle; 2];
    for pair in polygon.windows(2) {
        let step = round.parameter(pair[1]) - round.parameter(pair[0]);
        angle += (step + PI).rem_euclid(TAU) - PI;
        range = [range[0].min(angle), range[1].max(angle)];
    }
    range
}
