//! Layouts of meshes with sharp edges (docs/theory.md, models of many patches).
//!
//! Only some regions between the features get patches; planes and other exact faces do not. Each region is an open
//! surface by itself. Patches of two regions meet along a chain in the same edges:
//!
//! 1. Regions are cut out of the mesh (`pieces`).
//! 2. Chains are divided into edges, so that every region has an even border and good quads (`division`, `places`).
//! 3. Each region gets nodes where those edges end (`stops`), and is filled with quads: the best of all ways to do so (`border`, `polygon`, `fill`), or where it has too
//!    many corners, loops or limbs for that, its base complex (`over`).
//! 4. The nodes of each region are relaxed over its quads; those on chains stay where their length along it says.

mod border;
mod division;
mod error;
mod fill;
mod over;
mod pieces;
mod places;
mod polygon;
mod stops;
#[cfg(test)]
mod tests;

pub use error::FeatureLayoutError;

use super::{Creases, Layout, NodeMap, Place, Sector, Side, complex};
use crate::Control;
use crate::control::Stage;
use crate::mesh::{Features, Mesh, Regions};
use crate::options::with_fields;
use border::{ChainEdge, Loop};
use fill::Quads;
use over::Halving;
use pieces::{Line, Piece, Sheet};
use places::{Division, Stop};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::time::Instant;

/// How a layout over regions is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeatureLayoutOptions {
    /// About how many patches regions have that are not filled by few: a share of this by their share of the area.
    /// Default 40.
    pub patches: usize,
    /// Most sweeps over the nodes of each region. Default 300; they end before where nothing is gained.
    pub sweeps: usize,
}

impl Default for FeatureLayoutOptions {
    fn default() -> Self {
        Self { patches: 40, sweeps: 300 }
    }
}

impl FeatureLayoutOptions {
    with_fields! {
        with_patches patches: usize,
        with_sweeps sweeps: usize,
    }
}

/// A part of a mesh, opened along creases: triangles on both sides of one have copies of its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct CutMesh {
    /// The open mesh, one component a region.
    pub mesh: Mesh,
    /// By node: which one of the whole mesh it is.
    pub nodes: Vec<u32>,
    /// By node: its region.
    pub regions: Vec<u32>,
    /// By triangle: which one of the whole mesh it is.
    pub triangles: Vec<u32>,
}

/// The part of a chain that a layout edge covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The chain.
    pub chain: u32,
    /// The length along it where the edge's first side begins.
    pub from: f64,
    /// Where that side ends: less than `from` if it runs against the chain. Over the first node of a closed chain
    /// lengths go on beyond the chain's.
    pub to: f64,
}

/// Where a vertex of the layout comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VertexSource {
    /// It is a corner of the features, at this node of the whole mesh.
    Corner(u32),
    /// It lies on a chain.
    OnChain {
        /// The chain.
        chain: u32,
        /// The length along it.
        length: f64,
    },
    /// It lies inside a region.
    Inside,
}

/// How good a layout is and what it took.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureLayoutReport {
    /// By region: its patches; 0 for those that get none.
    pub patches: Vec<usize>,
    /// Symmetric Dirichlet energy of the node map by area of the patches: 4 for an isometry of every region.
    pub energy: f64,
    /// Nodes with a triangle whose image is turned over.
    pub folded_nodes: usize,
    /// Nodes whose triangles are spread over quads that have no common corner.
    pub spread_nodes: usize,
    /// Edges of coarse meshes that were split because their triangles could not be paired.
    pub splits: usize,
    /// Vertices of only two quads that were removed, each with one patch.
    pub doublets: usize,
    /// Whether all cells were halved, with two to four times the patches, because some region had no quads otherwise.
    pub is_halved: bool,
    /// Wall time.
    pub seconds: f64,
}

/// Patches over some regions of a mesh with the places of its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureLayout {
    /// The patches.
    pub layout: Layout,
    /// By layout edge: whether it lies on a chain.
    pub sharp: Vec<bool>,
    /// The mesh of the regions, open along the chains.
    pub cut: CutMesh,
    /// Where the nodes of the cut mesh lie; copies on a chain lie at the same length along its edges.
    pub map: NodeMap,
    /// By layout edge: the part of the chain that it covers, in the direction of its first side.
    pub spans: Vec<Option<Span>>,
    /// By layout vertex.
    pub vertices: Vec<VertexSource>,
    /// How good it is.
    pub report: FeatureLayoutReport,
}

/// Makes a layout over the regions of a mesh that are to get patches; `has_patches` says which, by region.
pub fn layout_of_features(
    mesh: &Mesh,
    features: &Features,
    regions: &Regions,
    has_patches: &[bool],
    options: &FeatureLayoutOptions,
    control: &mut Control,
) -> Result<FeatureLayout, FeatureLayoutError> {
    let start = Instant::now();
    control.enter(Stage::Layout);
    if has_patches.len() != regions.regions.len() {
        let (given, count) = (has_patches.len(), regions.regions.len());
        return Err(FeatureLayoutError::RegionCount { given, count });
    }
    if !has_patches.contains(&true) {
        return Err(FeatureLayoutError::NoPatches);
    }
    let lines: Vec<Line> = features.chains.iter().map(|chain| Line::new(mesh, chain)).collect();
    let pieces = pieces::pieces(mesh, features, regions, &lines, has_patches)?;
    control.set_stage(0.0, 0.2);
    let division = division::divide(mesh, &pieces, &lines, control)?;
    let mut made = match lay_out(mesh, &pieces, &lines, &division, Halving::No, options, control) {
        Err(FeatureLayoutError::NoLayout { .. }) => {
            let halved = division.halved(&lines);
            lay_out(mesh, &pieces, &lines, &halved, Halving::Yes, options, control)
        }
        made => made,
    }?;
    made.report.patches.resize(regions.regions.len(), 0);
    made.report.seconds = start.elapsed().as_secs_f64();
    Ok(made)
}

/// Lays quads over all pieces.
fn lay_out(
    mesh: &Mesh,
    pieces: &[Piece],
    lines: &[Line],
    division: &Division,
    halving: Halving,
    options: &FeatureLayoutOptions,
    control: &mut Control,
) -> Result<FeatureLayout, FeatureLayoutError> {
    let whole_area: f64 = pieces.iter().map(|piece| area(&piece.sheet.mesh)).sum();
    let mut assembly = Assembly::new(lines, division, halving);
    for (number, piece) in pieces.iter().enumerate() {
        let [from, to] = [number, number + 1].map(|k| 0.2 + 0.8 * k as f64 / pieces.len() as f64);
        control.set_stage(from, to);
        let sheet = piece.sheet.with_stops(lines, division, halving)?;
        let loops = border::loops(&sheet, lines, division);
        let wanted = (options.patches as f64 * area(&sheet.mesh) / whole_area).ceil() as usize;
        let mut filled = assembly.best(&sheet, &loops, wanted, options.sweeps, control)?;
        filled.places.truncate(piece.nodes.len());
        assembly.add(sheet.region, &loops, filled);
    }
    assembly.finish(mesh, pieces)
}

/// Quads over a piece with its nodes relaxed over them.
#[derive(Debug, Clone)]
struct Filled {
    corners: Vec<[u32; 4]>,
    edges: Vec<[u32; 4]>,
    /// By quad and corner: the angle of the sector that the corner is in.
    angles: Vec<[f64; 4]>,
    /// Sides on the border, with the edges on their chains.
    sides: BTreeMap<Side, ChainEdge>,
    places: Vec<Option<Place>>,
    quality: complex::Relaxed,
    splits: usize,
    doublets: usize,
}

impl Filled {
    /// Nodes that are not where they should be.
    fn rank(&self) -> usize {
        self.quality.folded + self.quality.spread
    }
}

/// Few quads are taken up to this energy: 4 is an isometry, and lengths twice and half as long have 8.5.
const GOOD_ENERGY: f64 = 8.5;
/// Beyond it, more are taken if they have no more than this part of the energy.
const WORTH_PATCHES: f64 = 0.7;

/// All pieces with their patches, put together.
struct Assembly<'a> {
    lines: &'a [Line],
    division: &'a Division,
    halving: Halving,
    corners: Vec<[u32; 4]>,
    edges: Vec<[u32; 4]>,
    /// By quad and corner: the angle of the sector that the corner is in.
    angles: Vec<[f64; 4]>,
    stops: BTreeMap<Stop, u32>,
    sources: Vec<VertexSource>,
    chain_edges: BTreeMap<(u32, u32), u32>,
    edge_count: u32,
    /// By side of a quad that lies on a chain.
    spans: BTreeMap<Side, Span>,
    places: Vec<Option<Place>>,
    /// Sum of energies by patch.
    energy: f64,
    report: FeatureLayoutReport,
}

impl<'a> Assembly<'a> {
    fn new(lines: &'a [Line], division: &'a Division, halving: Halving) -> Self {
        Self {
            lines,
            division,
            halving,
            corners: Vec::new(),
            edges: Vec::new(),
            angles: Vec::new(),
            stops: BTreeMap::new(),
            sources: Vec::new(),
            chain_edges: BTreeMap::new(),
            edge_count: 0,
            spans: BTreeMap::new(),
            places: Vec::new(),
            energy: 0.0,
            report: FeatureLayoutReport {
                patches: Vec::new(),
                is_halved: halving == Halving::Yes,
                energy: 0.0,
                folded_nodes: 0,
                spread_nodes: 0,
                splits: 0,
                doublets: 0,
                seconds: 0.0,
            },
        }
    }

    /// The best quads over a piece: the fewest, if its shape is simple enough for them, else its base complex with about
    /// so many patches.
    fn best(
        &self,
        sheet: &Sheet,
        loops: &[Loop],
        patches: usize,
        sweeps: usize,
        control: &mut Control,
    ) -> Result<Filled, FeatureLayoutError> {
        if loops.is_empty() {
            let quads = over::closed(sheet, control)?;
            return self.relaxed(sheet, loops, quads, sweeps, control);
        }
        let few = match fill::fill(sheet, loops, control)? {
            Some(quads) => self.candidate(sheet, loops, quads, sweeps, control)?,
            None => None,
        };
        if let Some(few) = few.as_ref().filter(|few| few.rank() == 0 && few.quality.energy <= GOOD_ENERGY) {
            return Ok(few.clone());
        }
        let many = match over::over(sheet, loops, patches, self.halving, control)? {
            Some(quads) => self.candidate(sheet, loops, quads, sweeps, control)?,
            None => None,
        };
        let is_worth_it = |few: &Filled, many: &Filled| {
            let share = if many.corners.len() > few.corners.len() { WORTH_PATCHES } else { 1.0 };
            many.rank() < few.rank()
                || (many.rank() == few.rank() && many.quality.energy < share * few.quality.energy)
        };
        match (few, many) {
            (Some(few), Some(many)) => Ok(if is_worth_it(&few, &many) { many } else { few }),
            (few, many) => few.or(many).ok_or(FeatureLayoutError::NoLayout { region: sheet.region as usize }),
        }
    }

    /// A piece relaxed over quads, if they make a layout: no quad may meet a vertex twice, from both sides of a chain.
    fn candidate(
        &self,
        sheet: &Sheet,
        loops: &[Loop],
        quads: Quads,
        sweeps: usize,
        control: &mut Control,
    ) -> Result<Option<Filled>, FeatureLayoutError> {
        let stops: Vec<Stop> = loops.iter().flat_map(|border| &border.stops).map(|stop| stop.stop).collect();
        let stop = |vertex: u32| stops.get(vertex as usize);
        let meets_twice = |quad: &[u32; 4]| {
            (0..4).any(|k| stop(quad[k]).is_some() && (0..k).any(|j| stop(quad[j]) == stop(quad[k])))
        };
        if quads.corners.iter().any(meets_twice) {
            return Ok(None);
        }
        match self.relaxed(sheet, loops, quads, sweeps, control) {
            Ok(filled) => Ok(Some(filled)),
            Err(FeatureLayoutError::Layout(_)) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Relaxes the nodes of a piece over quads.
    fn relaxed(
        &self,
        sheet: &Sheet,
        loops: &[Loop],
        quads: Quads,
        sweeps: usize,
        control: &mut Control,
    ) -> Result<Filled, FeatureLayoutError> {
        let stops: Vec<_> = loops.iter().flat_map(|border| &border.stops).collect();
        let Quads { corners, edges, mut places, fine, splits, doublets } = quads;
        let angle =
            |vertex: u32| stops.get(vertex as usize).map_or(TAU, |stop| FRAC_PI_2 * stop.corner.angle);
        let angles: Vec<[f64; 4]> = corners.iter().map(|corners| corners.map(angle)).collect();
        let local = layout(&corners, &edges, &BTreeSet::new(), &|sector| {
            let corner = sector.corners[0];
            angles[corner.quad as usize][corner.side as usize]
        })?;
        let sides = border_sides(&stops, &edges);
        self.place_border(sheet, &sides, &mut places);
        let quality = complex::relax_all(&sheet.mesh, &local, &mut places, fine, sweeps, control)?;
        Ok(Filled { corners, edges, angles, sides, places, quality, splits, doublets })
    }

    /// Adds a piece with its quads.
    fn add(&mut self, region: u32, loops: &[Loop], filled: Filled) {
        let stops: Vec<_> = loops.iter().flat_map(|border| &border.stops).collect();
        let Filled { corners, edges, angles, sides, places, quality, splits, doublets } = filled;
        self.energy += quality.energy * corners.len() as f64;
        self.report.folded_nodes += quality.folded;
        self.report.spread_nodes += quality.spread;
        self.report.splits += splits;
        self.report.doublets += doublets;
        let region = region as usize;
        self.report.patches.resize(self.report.patches.len().max(region + 1), 0);
        self.report.patches[region] = corners.len();

        let first = self.corners.len() as u32;
        let moved = |place: Place| Place { quad: place.quad + first, ..place };
        self.places.extend(places.into_iter().map(|place| place.map(moved)));
        self.spans.extend(sides.iter().map(|(&side, edge)| {
            let [from, to] =
                self.division.span(edge.chain, edge.rank as usize, &self.lines[edge.chain as usize]);
            let [from, to] = if edge.is_forward { [from, to] } else { [to, from] };
            (Side { quad: side.quad + first, ..side }, Span { chain: edge.chain, from, to })
        }));
        self.angles.extend(angles);
        let mut inner: BTreeMap<u32, u32> = BTreeMap::new();
        let mut inner_edges: BTreeMap<u32, u32> = BTreeMap::new();
        for (quad, (corners, edges)) in corners.iter().zip(&edges).enumerate() {
            let vertices = corners.map(|vertex| match stops.get(vertex as usize) {
                Some(stop) => self.vertex(stop.stop),
                None => *inner.entry(vertex).or_insert_with(|| {
                    self.sources.push(VertexSource::Inside);
                    self.sources.len() as u32 - 1
                }),
            });
            self.corners.push(vertices);
            let number = |k: usize| {
                let side = Side { quad: quad as u32, side: k as u8 };
                let next = self.edge_count;
                let number = match sides.get(&side) {
                    Some(edge) => *self.chain_edges.entry((edge.chain, edge.rank)).or_insert(next),
                    None => *inner_edges.entry(edges[k]).or_insert(next),
                };
                self.edge_count += u32::from(number == next);
                number
            };
            self.edges.push([0, 1, 2, 3].map(number));
        }
    }

    /// Gives nodes on chains the places that their lengths say.
    fn place_border(&self, sheet: &Sheet, sides: &BTreeMap<Side, ChainEdge>, places: &mut [Option<Place>]) {
        let side_of: BTreeMap<(u32, u32, bool), Side> =
            sides.iter().map(|(&side, edge)| ((edge.chain, edge.rank, edge.is_forward), side)).collect();
        for run in sheet.loops.iter().flatten() {
            let line = &self.lines[run.chain as usize];
            let edges = self.division.edge_count(run.chain, line);
            for (&node, &length) in run.nodes.iter().zip(&run.lengths) {
                for edge in 0..edges {
                    let [from, to] = self.division.span(run.chain, edge, line);
                    let Some(share) = share(from, to, length, line) else { continue };
                    let share = if run.is_forward { share } else { 1.0 - share };
                    let side = side_of[&(run.chain, edge as u32, run.is_forward)];
                    places[node as usize] = Some(side.place(share, 0.0));
                    break;
                }
            }
        }
    }

    fn vertex(&mut self, stop: Stop) -> u32 {
        *self.stops.entry(stop).or_insert_with(|| {
            self.sources.push(match stop {
                Stop::Corner(node) => VertexSource::Corner(node),
                Stop::OnChain { chain, rank } => {
                    let line = &self.lines[chain as usize];
                    let length = self.division.lengths[chain as usize][rank as usize];
                    let length = if line.is_closed { length.rem_euclid(line.length()) } else { length };
                    VertexSource::OnChain { chain, length }
                }
            });
            self.sources.len() as u32 - 1
        })
    }

    fn finish(self, mesh: &Mesh, pieces: &[Piece]) -> Result<FeatureLayout, FeatureLayoutError> {
        let sharp_numbers = self.chain_edges.values().copied().collect();
        let angles = &self.angles;
        let layout = layout(&self.corners, &self.edges, &sharp_numbers, &|sector| {
            let corner = sector.corners[0];
            angles[corner.quad as usize][corner.side as usize]
        })?;
        let spans: Vec<Option<Span>> =
            layout.edges().iter().map(|edge| self.spans.get(&edge.first).copied()).collect();
        let mut report = self.report;
        report.energy = self.energy / self.corners.len() as f64;
        Ok(FeatureLayout {
            sharp: spans.iter().map(Option::is_some).collect(),
            spans,
            layout,
            cut: cut_mesh(mesh, pieces)?,
            map: NodeMap::new(self.places),
            vertices: self.sources,
            report,
        })
    }
}

/// The sides of quads on the border, with the edges on their chains.
fn border_sides(stops: &[&border::BorderStop], edges: &[[u32; 4]]) -> BTreeMap<Side, ChainEdge> {
    let mut sides = BTreeMap::new();
    for (quad, numbers) in edges.iter().enumerate() {
        for k in 0..4 {
            // the edge along the loop has the number of the stop that it leaves
            if let Some(stop) = stops.get(numbers[k] as usize) {
                sides.insert(Side { quad: quad as u32, side: k as u8 }, stop.edge);
            }
        }
    }
    sides
}

/// A layout with these sharp edges, and with these angles between them.
fn layout(
    corners: &[[u32; 4]],
    edges: &[[u32; 4]],
    sharp: &BTreeSet<u32>,
    angle: &dyn Fn(&Sector) -> f64,
) -> Result<Layout, FeatureLayoutError> {
    Ok(Layout::with_creases(corners, edges, &Creases { sharp, angle })?)
}

/// How far a length is from one end of a span to the other; none outside.
fn share(from: f64, to: f64, length: f64, line: &Line) -> Option<f64> {
    let ways = [length, length + line.length()];
    let ways = if line.is_closed { &ways[..] } else { &ways[..1] };
    let length = ways.iter().copied().find(|length| (from..=to).contains(length))?;
    Some((length - from) / (to - from))
}

fn area(mesh: &Mesh) -> f64 {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    mesh.triangles().iter().map(area).sum()
}

/// All pieces as one mesh.
fn cut_mesh(mesh: &Mesh, pieces: &[Piece]) -> Result<CutMesh, FeatureLayoutError> {
    let (mut nodes, mut regions, mut triangles, mut origins) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for piece in pieces {
        let first = nodes.len() as u32;
        nodes.extend(&piece.nodes);
        regions.extend(piece.nodes.iter().map(|_| piece.sheet.region));
        triangles.extend(piece.sheet.mesh.triangles().iter().map(|corners| corners.map(|node| node + first)));
        origins.extend(&piece.triangles);
    }
    let points = nodes.iter().map(|&node| mesh.points()[node as usize]).collect();
    Ok(CutMesh { mesh: Mesh::new(points, triangles)?, nodes, regions, triangles: origins })
}
