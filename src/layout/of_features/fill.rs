//! Quads over a piece, and the places of its nodes on them.
//!
//! A piece of several loops is cut open along shortest ways between vertices of the layout on its loops: each way becomes
//! an edge. What is left is a disk, whose border has the layout's vertices: a polygon. The best filling of that
//! (`polygon`) is drawn into a regular polygon with its inner vertices in the middle of their neighbours, and so is the
//! mesh (W. Tutte, "How to draw a graph", 1963; M. Floater's weights): nodes are on the quads that they are drawn in.

use super::FeatureLayoutError;
use super::border::Loop;
use super::pieces::Sheet;
use super::polygon::{Filling, Polygon};
use crate::Control;
use crate::control::{Cancelled, Stage};
use crate::failure::{Classify, ErrorKind};
use crate::layout::Place;
use crate::layout::bilinear::place_in;
use crate::layout::complex::Fine;
use crate::mesh::{HalfEdge, Mesh};
use crate::parameterize::{Border, ParameterizeOptions, parameterize};
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::f64::consts::TAU;

/// Quads over a sheet. Vertices are the stops of its loops, one loop after the other, and then those inside.
#[derive(Debug, Clone)]
pub(super) struct Quads {
    pub corners: Vec<[u32; 4]>,
    /// By side: the number of its edge, the same for two sides that meet.
    pub edges: Vec<[u32; 4]>,
    /// By node of the piece; none for those that come back later.
    pub places: Vec<Option<Place>>,
    /// What comes back, if not all nodes have places.
    pub fine: Option<Fine>,
    /// Edges inside that were split for the sake of the quads, and vertices of two quads that were removed.
    pub splits: usize,
    pub doublets: usize,
}

/// Borders longer than this are left to other methods.
const MOST_SIDES: usize = 16;
/// Quads that are tried on a polygon; the best filling so far is taken after them.
const STEPS: usize = 100_000;
/// A way to a corner narrower than this, in quarter turns, would part it in two: it is this much longer.
const NARROW: f64 = 1.5;
const NARROW_PRICE: f64 = 3.0;
/// Rounds that place the inner vertices of a polygon.
const DRAWING_ROUNDS: usize = 300;

/// The best quads over a piece of few loops and stops; none if it is none, or there are none.
pub(super) fn fill(
    sheet: &Sheet,
    loops: &[Loop],
    control: &mut Control,
) -> Result<Option<Quads>, FeatureLayoutError> {
    let sides: usize = loops.iter().map(|border| border.stops.len()).sum();
    if loops.is_empty() || sheet.mesh.genus() > 0 || sides + 2 * (loops.len() - 1) > MOST_SIDES {
        return Ok(None);
    }
    let Some(ways) = ways(sheet, loops) else { return Ok(None) };
    let is_way = |edge: HalfEdge| {
        let [a, b] = [edge.origin(sheet.mesh.triangles()), edge.target(sheet.mesh.triangles())];
        ways.iter().any(|way| way.contains(&[a.min(b), a.max(b)]))
    };
    let all: Vec<u32> = (0..sheet.mesh.triangles().len() as u32).collect();
    let disk = sheet.mesh.cut_out(&all, is_way)?;
    if !disk.mesh.is_disk() || disk.mesh.loops().len() != 1 {
        return Ok(None);
    }
    let outline = Outline::new(&disk.mesh, &disk.nodes, loops, &ways);
    let Some(filling) = outline.polygon(loops).filled(STEPS) else { return Ok(None) };
    let Some(uv) = drawn(&disk.mesh, &outline, control)? else { return Ok(None) };
    let Some(places) = places(&filling, &outline, &uv) else { return Ok(None) };
    let mut of_piece = vec![None; sheet.mesh.points().len()];
    for (&node, place) in disk.nodes.iter().zip(places) {
        of_piece[node as usize].get_or_insert(place);
    }
    let (corners, edges) = outline.numbered(&filling, sides as u32);
    Ok(Some(Quads { corners, edges, places: of_piece, fine: None, splits: 0, doublets: 0 }))
}

/// The edges of a way, the smaller node first.
type Way = BTreeSet<[u32; 2]>;

/// Shortest ways that join all loops, from stop to stop through the inside; none if some loop cannot be reached so.
fn ways(sheet: &Sheet, loops: &[Loop]) -> Option<Vec<Way>> {
    let mesh = &sheet.mesh;
    // by node: the loop, and the price of a way that ends there
    let mut ends: BTreeMap<u32, (usize, f64)> = BTreeMap::new();
    for (index, border) in loops.iter().enumerate() {
        for stop in &border.stops {
            let price = if stop.corner.angle < NARROW { NARROW_PRICE } else { 1.0 };
            ends.extend(stop.node.map(|node| (node, (index, price))));
        }
    }
    let mut is_closed: Vec<bool> =
        (0..mesh.points().len() as u32).map(|node| mesh.is_boundary(node)).collect();
    let mut is_joined = vec![false; loops.len()];
    is_joined[0] = true;
    let mut ways = Vec::new();
    while is_joined.iter().any(|is_joined| !is_joined) {
        let way = shortest_way(mesh, &ends, &is_closed, &is_joined)?;
        is_joined[ends[&way[0]].0] = true;
        way.iter().for_each(|&node| is_closed[node as usize] = true);
        // a stop has one way: two would leave the sector between them to nobody
        [way[0], way[way.len() - 1]].iter().for_each(|end| {
            ends.entry(*end).and_modify(|(_, price)| *price *= NARROW_PRICE);
        });
        ways.push(way.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]).collect());
    }
    Some(ways)
}

/// The shortest way from a loop that is joined to one that is not, from its end on, through nodes that are not closed.
fn shortest_way(
    mesh: &Mesh,
    ends: &BTreeMap<u32, (usize, f64)>,
    is_closed: &[bool],
    is_joined: &[bool],
) -> Option<Vec<u32>> {
    let scale = mesh.diagonal();
    let mut reached: Vec<(f64, u32)> = vec![(f64::INFINITY, u32::MAX); mesh.points().len()];
    let mut heap = BinaryHeap::new();
    for (&node, &(_, price)) in ends.iter().filter(|(_, (index, _))| is_joined[*index]) {
        let length = (price - 1.0) * scale;
        reached[node as usize].0 = length;
        heap.push(Reverse((length.to_bits(), node)));
    }
    let mut best: Option<(f64, u32)> = None;
    // lengths are positive, and sort as their bits do
    while let Some(Reverse((bits, node))) = heap.pop() {
        let length = f64::from_bits(bits);
        if best.is_some_and(|(least, _)| least <= length) {
            break;
        }
        if length > reached[node as usize].0 {
            continue;
        }
        for next in mesh.neighbours(node) {
            let further = length + mesh.points()[node as usize].distance(mesh.points()[next as usize]);
            if further >= reached[next as usize].0 {
                continue;
            }
            match ends.get(&next) {
                Some(&(index, price)) if !is_joined[index] => {
                    // along the border there is no way: edges of loops join nodes of one loop
                    reached[next as usize] = (further, node);
                    let priced = further + (price - 1.0) * scale;
                    if best.is_none_or(|(least, _)| priced < least) {
                        best = Some((priced, next));
                    }
                }
                _ if !is_closed[next as usize] => {
                    reached[next as usize] = (further, node);
                    heap.push(Reverse((further.to_bits(), next)));
                }
                _ => {}
            }
        }
    }
    let mut way = vec![best?.1];
    while let Some(&node) = way.last()
        && reached[node as usize].1 != u32::MAX
    {
        way.push(reached[node as usize].1);
    }
    Some(way)
}

/// What a side of the polygon is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SideOf {
    /// The layout edge that leaves a stop along its loop.
    Stop(u32),
    /// A way along which the piece was cut.
    Way(u32),
}

/// The border of a piece that was cut open.
struct Outline {
    /// By vertex of the polygon: the stop it is a copy of.
    stops: Vec<u32>,
    /// By side, which follows the vertex.
    sides: Vec<SideOf>,
    /// Nodes of the disk on each side, with the fraction along it.
    nodes: Vec<(u32, usize, f64)>,
}

/// A vertex of the polygon or a node of the disk on the way around it.
enum Item {
    /// With what the side is that ends there.
    Stop {
        stop: u32,
        way: Option<u32>,
    },
    Node(u32),
}

impl Outline {
    fn new(disk: &Mesh, nodes: &[u32], loops: &[Loop], ways: &[Way]) -> Self {
        let mut place: BTreeMap<u32, (usize, f64)> = BTreeMap::new();
        let mut first_stops = vec![0_u32];
        for (index, border) in loops.iter().enumerate() {
            place.extend(border.nodes.iter().map(|&(node, at)| (node, (index, at))));
            first_stops.push(first_stops[index] + border.stops.len() as u32);
        }
        let (mut items, mut length) = (Vec::new(), 0.0);
        let around = &disk.loops()[0];
        for (k, &u) in around.iter().enumerate() {
            let v = around[(k + 1) % around.len()];
            let [from, to] = [u, v].map(|node| nodes[node as usize]);
            let step = disk.points()[u as usize].distance(disk.points()[v as usize]);
            let way = ways.iter().position(|way| way.contains(&[from.min(to), from.max(to)]));
            let (index, end) = place.get(&to).copied().unwrap_or_default();
            let border = &loops[index];
            let numbered = || (first_stops[index]..).zip(&border.stops);
            if let Some(way) = way {
                // the way ends at a stop, or goes on
                let here = place
                    .contains_key(&to)
                    .then(|| numbered().find(|(_, stop)| stop.node == Some(to)))
                    .flatten();
                items.extend(
                    here.map(|(stop, _)| (length + step, Item::Stop { stop, way: Some(way as u32) })),
                );
            } else {
                let begin = place[&from].1;
                let end = if end <= begin { border.length } else { end };
                let at = |at: f64| if at == 0.0 { border.length } else { at };
                let mut met: Vec<(f64, u32)> = numbered()
                    .map(|(number, stop)| (at(stop.at), number))
                    .filter(|&(at, _)| begin < at && at <= end)
                    .collect();
                met.sort_by(|a, b| a.0.total_cmp(&b.0));
                items.extend(met.into_iter().map(|(at, stop)| {
                    (length + step * (at - begin) / (end - begin), Item::Stop { stop, way: None })
                }));
            }
            length += step;
            items.push((length, Item::Node(v)));
        }
        Self::of_items(items, length)
    }

    fn of_items(mut items: Vec<(f64, Item)>, length: f64) -> Self {
        let first = items.iter().position(|(_, item)| matches!(item, Item::Stop { .. })).unwrap_or(0);
        items.rotate_left(first);
        let begin = items[0].0;
        let mut outline = Self { stops: Vec::new(), sides: Vec::new(), nodes: Vec::new() };
        let (mut incoming, mut begins) = (Vec::new(), Vec::new());
        let mut of_nodes = Vec::new();
        for (at, item) in items {
            let at = (at - begin).rem_euclid(length);
            match item {
                Item::Stop { stop, way } => {
                    outline.stops.push(stop);
                    incoming.push(way);
                    begins.push(at);
                }
                Item::Node(node) => of_nodes.push((node, begins.len() - 1, at)),
            }
        }
        let count = outline.stops.len();
        for side in 0..count {
            outline.sides.push(match incoming[(side + 1) % count] {
                Some(way) => SideOf::Way(way),
                None => SideOf::Stop(outline.stops[side]),
            });
        }
        begins.push(length);
        outline.nodes = of_nodes
            .into_iter()
            .map(|(node, side, at)| {
                let share = (at - begins[side]) / (begins[side + 1] - begins[side]);
                (node, side, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 })
            })
            .collect();
        outline
    }

    fn count(&self) -> usize {
        self.stops.len()
    }

    fn polygon(&self, loops: &[Loop]) -> Polygon {
        let stops: Vec<_> = loops.iter().flat_map(|border| &border.stops).collect();
        let mut numbers = BTreeMap::new();
        for stop in &stops {
            let next = numbers.len() as u32;
            numbers.entry(stop.stop).or_insert(next);
        }
        Polygon {
            vertices: self.stops.iter().map(|&stop| numbers[&stops[stop as usize].stop]).collect(),
            groups: self.stops.clone(),
            corners: stops.iter().map(|stop| stop.corner).collect(),
        }
    }

    /// A corner of the regular polygon.
    fn corner(&self, k: usize) -> DVec2 {
        DVec2::from_angle(TAU * (k % self.count()) as f64 / self.count() as f64)
    }

    /// The quads with stops and inner vertices in place of the polygon's vertices, and the numbers of their edges.
    fn numbered(&self, filling: &Filling, stop_count: u32) -> (Vec<[u32; 4]>, Vec<[u32; 4]>) {
        let count = self.count() as u32;
        let vertex = |v: u32| if v < count { self.stops[v as usize] } else { stop_count + v - count };
        let way_count = ways_of(&self.sides);
        let mut inner = BTreeMap::new();
        let mut number = |a: u32, b: u32| {
            if a < count && b == (a + 1) % count {
                return match self.sides[a as usize] {
                    SideOf::Stop(stop) => stop,
                    SideOf::Way(way) => stop_count + way,
                };
            }
            let next = stop_count + way_count + inner.len() as u32;
            *inner.entry([a.min(b), a.max(b)]).or_insert(next)
        };
        let edges = filling.quads.iter().map(|quad| [0, 1, 2, 3].map(|k| number(quad[k], quad[(k + 1) % 4])));
        let edges = edges.collect();
        (filling.quads.iter().map(|quad| quad.map(vertex)).collect(), edges)
    }
}

fn ways_of(sides: &[SideOf]) -> u32 {
    let way = |side: &SideOf| if let SideOf::Way(way) = side { *way + 1 } else { 0 };
    sides.iter().map(way).max().unwrap_or(0)
}

/// Where the nodes of the disk are when its border is a regular polygon; none if there is no such map.
fn drawn(
    disk: &Mesh,
    outline: &Outline,
    control: &mut Control,
) -> Result<Option<Vec<DVec2>>, FeatureLayoutError> {
    let mut uv = vec![DVec2::ZERO; disk.points().len()];
    for &(node, side, share) in &outline.nodes {
        uv[node as usize] = outline.corner(side).lerp(outline.corner(side + 1), share);
    }
    if outline.nodes.len() == uv.len() {
        return Ok(Some(uv));
    }
    let mut disk = disk.clone();
    disk.set_parameters(uv)?;
    let options = ParameterizeOptions::MEAN_VALUE.with_border(Border::Kept);
    let map = parameterize(&disk, &options, control);
    control.enter(Stage::Layout);
    match map {
        Ok(map) => Ok(Some(map.uv)),
        Err(error) if error.kind() == ErrorKind::Cancelled => Err(Cancelled.into()),
        Err(_) => Ok(None),
    }
}

/// The quads on which points of the polygon lie; none if a quad is drawn without area.
fn places(filling: &Filling, outline: &Outline, uv: &[DVec2]) -> Option<Vec<Place>> {
    let vertices = drawn_vertices(filling, outline);
    let quads: Vec<[DVec2; 4]> =
        filling.quads.iter().map(|quad| quad.map(|v| vertices[v as usize])).collect();
    let is_flat = |quad: &[DVec2; 4]| {
        (0..4).any(|k| {
            let [before, here, after] = [k + 3, k, k + 1].map(|j| quad[j % 4]);
            (after - here).perp_dot(before - here) <= 0.0
        })
    };
    if quads.iter().any(is_flat) {
        return None;
    }
    let place = |&point: &DVec2| {
        let quad =
            (0..quads.len()).max_by(|&a, &b| depth(&quads[a], point).total_cmp(&depth(&quads[b], point)))?;
        Some(Place { quad: quad as u32, uv: place_in(&quads[quad], point) })
    };
    uv.iter().map(place).collect()
}

/// The vertices of a filling, those inside in the middle of their neighbours.
fn drawn_vertices(filling: &Filling, outline: &Outline) -> Vec<DVec2> {
    let count = outline.count();
    let vertex_count = filling.quads.iter().flatten().max().map_or(0, |&v| v as usize + 1);
    let mut places: Vec<DVec2> =
        (0..vertex_count).map(|v| if v < count { outline.corner(v) } else { DVec2::ZERO }).collect();
    let mut neighbours: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); vertex_count];
    for quad in &filling.quads {
        for k in 0..4 {
            let [a, b] = [quad[k], quad[(k + 1) % 4]];
            neighbours[a as usize].insert(b);
            neighbours[b as usize].insert(a);
        }
    }
    for _ in 0..DRAWING_ROUNDS {
        for vertex in count..vertex_count {
            let sum: DVec2 = neighbours[vertex].iter().map(|&other| places[other as usize]).sum();
            places[vertex] = sum / neighbours[vertex].len() as f64;
        }
    }
    places
}

/// How far inside a quad a point lies: the least distance from its sides, negative outside.
fn depth(quad: &[DVec2; 4], point: DVec2) -> f64 {
    let from_side = |k: usize| {
        let [a, b] = [quad[k], quad[(k + 1) % 4]];
        (b - a).perp_dot(point - a) / (b - a).length()
    };
    (0..4).map(from_side).fold(f64::INFINITY, f64::min)
}
