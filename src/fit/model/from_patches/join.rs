//! Which sides of given patches meet: vertices, edges, senses and pieces.
//!
//! Corners within the tolerance of each other are one vertex. Sides between the same vertices whose curves lie within the
//! tolerance of each other are one edge, whatever their parameters. Neighbours are then turned, by exchanging u and v, until all
//! of a piece look the same way.

use super::FromPatchesError;
use crate::layout::{Layout, Side};
use crate::surface::Surface;
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Samples of a side that are compared with another side.
const COMPARED: usize = 17;
/// Samples of the other side between which the nearest place is looked for.
const SCANNED: usize = 65;
/// Steps of the search for the nearest place: thirds of an interval, down to a millionth of it.
const THIRDS: usize = 34;

/// A patch over the unit square.
#[derive(Debug, Clone, Copy)]
pub(super) struct Given<'a> {
    pub surface: &'a TensorSurface,
    /// Its number among all that are given.
    pub number: usize,
    /// Whether u and v are exchanged.
    pub is_turned: bool,
}

impl Given<'_> {
    /// The point at a place of the unit square, and the tangents along its u and v.
    pub(super) fn jet(&self, uv: DVec2) -> [DVec3; 3] {
        let domain = self.surface.domain();
        let size = domain.size();
        let own = if self.is_turned { DVec2::new(uv.y, uv.x) } else { uv };
        let mut row = [0.0; 9];
        self.surface.eval_rows(&[domain.clamp(domain.min + own * size)], 1, &mut row);
        let [point, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
        let (along_u, along_v) = (size.x * along_u, size.y * along_v);
        if self.is_turned { [point, along_v, along_u] } else { [point, along_u, along_v] }
    }

    pub(super) fn point(&self, uv: DVec2) -> DVec3 {
        self.jet(uv)[0]
    }

    /// A point of a side, in its direction.
    fn on_side(&self, side: usize, t: f64) -> DVec3 {
        self.point(Side { quad: 0, side: side as u8 }.place(t, 0.0).uv)
    }
}

/// Patches in one piece.
pub(super) struct Joined<'a> {
    pub layout: Layout,
    pub patches: Vec<Given<'a>>,
}

/// How far the sides that have been joined are apart.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Seams {
    /// Largest distance between the sides of an edge.
    pub gap: f64,
    /// Largest difference of unit normals across an edge.
    pub normal_jump: f64,
    /// Edges of two sides.
    pub count: usize,
}

/// A side of a patch: its patch and its number.
type SideAt = (usize, usize);

/// An edge with one side or two.
struct Joint {
    first: SideAt,
    second: Option<SideAt>,
}

/// Joins patches along sides within a tolerance.
pub(super) fn join<'a>(
    surfaces: &[&'a TensorSurface],
    tolerance: f64,
) -> Result<(Vec<Joined<'a>>, Seams), FromPatchesError> {
    let given = |(number, &surface): (usize, &&'a TensorSurface)| Given { surface, number, is_turned: false };
    let mut patches: Vec<Given> = surfaces.iter().enumerate().map(given).collect();
    let quads = corners(&patches, tolerance)?;
    let (joints, mut edges, seams) = edges(&patches, &quads, tolerance)?;
    check_whole(&patches, &quads, &joints, tolerance)?;
    let (pieces, is_turned) = senses(&quads, &joints)?;
    let mut quads = quads;
    for (patch, &is_turned) in is_turned.iter().enumerate() {
        if is_turned {
            turn(&mut patches[patch], &mut quads[patch], &mut edges[patch]);
        }
    }
    let joined = pieces.into_iter().map(|piece| {
        if is_closed(&piece, &joints) && piece.iter().map(|&patch| volume(&patches[patch])).sum::<f64>() < 0.0
        {
            for &patch in &piece {
                turn(&mut patches[patch], &mut quads[patch], &mut edges[patch]);
            }
        }
        let layout = layout_of(&piece, &quads, &edges)?;
        Ok(Joined { layout, patches: piece.iter().map(|&patch| patches[patch]).collect() })
    });
    Ok((joined.collect::<Result<_, FromPatchesError>>()?, seams))
}

/// The vertices at the corners of each patch, counterclockwise.
fn corners(patches: &[Given], tolerance: f64) -> Result<Vec<[u32; 4]>, FromPatchesError> {
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut boxes: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let cell = |p: DVec3| (p / (2.0 * tolerance)).floor().to_array().map(|x| x as i64);
    let mut quads = Vec::new();
    for patch in patches {
        let mut quad = [0; 4];
        for (side, corner) in quad.iter_mut().enumerate() {
            let point = patch.on_side(side, 0.0);
            let at = cell(point);
            let near = (0..27).map(|k| [at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1]);
            let known = near.filter_map(|cell| boxes.get(&cell)).flatten().copied();
            let known = known.filter(|&vertex| vertices[vertex as usize].distance(point) <= tolerance);
            *corner = known.min().unwrap_or_else(|| {
                vertices.push(point);
                boxes.entry(at).or_default().push(vertices.len() as u32 - 1);
                vertices.len() as u32 - 1
            });
        }
        if let Some(side) = (0..4).find(|&k| quad[k] == quad[(k + 1) % 4]) {
            return Err(FromPatchesError::ShortSide { patch: patch.number, side });
        }
        if quad[0] == quad[2] || quad[1] == quad[3] {
            return Err(FromPatchesError::MeetsItself { patch: patch.number });
        }
        quads.push(quad);
    }
    Ok(quads)
}

/// The edges, the edge of each side, and how far joined sides are apart.
type Edges = (Vec<Joint>, Vec<[u32; 4]>, Seams);

/// Finds which sides meet.
fn edges(patches: &[Given], quads: &[[u32; 4]], tolerance: f64) -> Result<Edges, FromPatchesError> {
    let mut joints: Vec<Joint> = Vec::new();
    let mut between: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    let (mut numbers, mut seams) = (vec![[0; 4]; quads.len()], Seams::default());
    for (patch, quad) in quads.iter().enumerate() {
        for side in 0..4 {
            let [a, b] = [quad[side], quad[(side + 1) % 4]];
            let known = between.entry([a.min(b), a.max(b)]).or_default();
            let fitting = known.iter().find_map(|&edge| {
                let (other, of_other) = joints[edge as usize].first;
                let is_reversed = quads[other][of_other] != a;
                let seam = seam((&patches[patch], side), (&patches[other], of_other), is_reversed);
                (seam.gap <= tolerance).then_some((edge, seam))
            });
            numbers[patch][side] = match fitting {
                Some((edge, _)) if joints[edge as usize].second.is_some() => {
                    return Err(FromPatchesError::ThirdSide { patch: patches[patch].number, side });
                }
                Some((edge, seam)) => {
                    joints[edge as usize].second = Some((patch, side));
                    seams.gap = seams.gap.max(seam.gap);
                    seams.normal_jump = seams.normal_jump.max(seam.normal_jump);
                    seams.count += 1;
                    edge
                }
                None => {
                    joints.push(Joint { first: (patch, side), second: None });
                    known.push(joints.len() as u32 - 1);
                    joints.len() as u32 - 1
                }
            };
        }
    }
    Ok((joints, numbers, seams))
}

/// How far two sides are apart.
fn seam(one: (&Given, usize), other: (&Given, usize), is_reversed: bool) -> Seams {
    let normal = |(patch, side): (&Given, usize), t: f64| {
        let [_, u, v] = patch.jet(Side { quad: 0, side: side as u8 }.place(t, 0.0).uv);
        u.cross(v).normalize_or_zero()
    };
    // a patch that runs the same way along the edge shows its other side
    let sense = if is_reversed { 1.0 } else { -1.0 };
    let mut seam = Seams::default();
    for k in 0..COMPARED {
        let t = k as f64 / (COMPARED - 1) as f64;
        let point = one.0.on_side(one.1, t);
        let (nearest, distance) = nearest(other.0, other.1, point);
        seam.gap = seam.gap.max(distance);
        seam.normal_jump = seam.normal_jump.max(normal(one, t).distance(sense * normal(other, nearest)));
    }
    seam
}

/// The place on a side nearest to a point, and its distance.
fn nearest(patch: &Given, side: usize, point: DVec3) -> (f64, f64) {
    let distance = |t: f64| patch.on_side(side, t).distance(point);
    let step = 1.0 / (SCANNED - 1) as f64;
    let scanned = (0..SCANNED).map(|k| k as f64 * step);
    let near = scanned.min_by(|&s, &t| distance(s).total_cmp(&distance(t))).unwrap_or(0.0);
    let (mut from, mut to) = ((near - step).max(0.0), (near + step).min(1.0));
    for _ in 0..THIRDS {
        let [a, b] = [from + (to - from) / 3.0, to - (to - from) / 3.0];
        if distance(a) < distance(b) { to = b } else { from = a }
    }
    let found = [near, 0.5 * (from + to)].into_iter().min_by(|&s, &t| distance(s).total_cmp(&distance(t)));
    let found = found.unwrap_or(near);
    (found, distance(found))
}

/// Refuses corners inside free sides: there two patches meet one.
fn check_whole(
    patches: &[Given],
    quads: &[[u32; 4]],
    joints: &[Joint],
    tolerance: f64,
) -> Result<(), FromPatchesError> {
    let free: Vec<SideAt> =
        joints.iter().filter(|joint| joint.second.is_none()).map(|joint| joint.first).collect();
    let mut ends: Vec<(u32, SideAt)> = free.iter().map(|&(p, s)| (quads[p][s], (p, s))).collect();
    ends.sort_unstable();
    ends.dedup_by_key(|(vertex, _)| *vertex);
    for &(patch, side) in &free {
        let points: Vec<DVec3> =
            (0..COMPARED).map(|k| patches[patch].on_side(side, k as f64 / (COMPARED - 1) as f64)).collect();
        let longest = points.windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max);
        let own = [quads[patch][side], quads[patch][(side + 1) % 4]];
        for &(vertex, (other, of_other)) in ends.iter().filter(|(vertex, _)| !own.contains(vertex)) {
            let corner = patches[other].on_side(of_other, 0.0);
            let is_near = points.iter().any(|p| p.distance(corner) <= longest + tolerance);
            if is_near && nearest(&patches[patch], side, corner).1 <= tolerance {
                let [patch, other] = [patch, other].map(|patch| patches[patch].number);
                return Err(FromPatchesError::CornerOnSide { patch, side, other, vertex });
            }
        }
    }
    Ok(())
}

/// The pieces, and which patches are to be turned so that neighbours look the same way.
fn senses(quads: &[[u32; 4]], joints: &[Joint]) -> Result<(Vec<Vec<usize>>, Vec<bool>), FromPatchesError> {
    let mut beside: Vec<Vec<(usize, bool)>> = vec![Vec::new(); quads.len()];
    for joint in joints {
        let ((a, side_a), Some((b, side_b))) = (joint.first, joint.second) else { continue };
        let runs_alike = quads[a][side_a] == quads[b][side_b];
        beside[a].push((b, runs_alike));
        beside[b].push((a, runs_alike));
    }
    let mut turned: Vec<Option<bool>> = vec![None; quads.len()];
    let mut pieces = Vec::new();
    for start in 0..quads.len() {
        if turned[start].is_some() {
            continue;
        }
        turned[start] = Some(false);
        let (mut piece, mut at) = (vec![start], 0);
        while let Some(&patch) = piece.get(at) {
            at += 1;
            for &(other, runs_alike) in &beside[patch] {
                let wanted = turned[patch].is_some_and(|turned| turned != runs_alike);
                match turned[other] {
                    None => {
                        turned[other] = Some(wanted);
                        piece.push(other);
                    }
                    Some(is_turned) if is_turned != wanted => {
                        return Err(FromPatchesError::OneSided { patch: other });
                    }
                    Some(_) => {}
                }
            }
        }
        piece.sort_unstable();
        pieces.push(piece);
    }
    Ok((pieces, turned.into_iter().map(|turned| turned == Some(true)).collect()))
}

/// Exchanges u and v of a patch.
fn turn(patch: &mut Given, corners: &mut [u32; 4], edges: &mut [u32; 4]) {
    patch.is_turned = !patch.is_turned;
    corners.swap(1, 3);
    *edges = [3, 2, 1, 0].map(|side| edges[side]);
}

fn is_closed(piece: &[usize], joints: &[Joint]) -> bool {
    joints.iter().all(|joint| joint.second.is_some() || piece.binary_search(&joint.first.0).is_err())
}

/// What a patch adds to the volume of its piece, from a grid.
fn volume(patch: &Given) -> f64 {
    let at = |i: usize, j: usize| patch.point(DVec2::new(i as f64, j as f64) / COMPARED as f64);
    let cells = (0..COMPARED * COMPARED).map(|k| (k / COMPARED, k % COMPARED));
    let cell = |(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        a.dot(b.cross(c)) + a.dot(c.cross(d))
    };
    cells.map(cell).sum()
}

/// The layout of the patches of one piece, whose vertices are numbered anew.
fn layout_of(piece: &[usize], quads: &[[u32; 4]], edges: &[[u32; 4]]) -> Result<Layout, FromPatchesError> {
    let mut numbers = BTreeMap::new();
    let mut own = |vertex: u32| {
        let next = numbers.len() as u32;
        *numbers.entry(vertex).or_insert(next)
    };
    let corners: Vec<[u32; 4]> = piece.iter().map(|&patch| quads[patch].map(&mut own)).collect();
    let sides: Vec<[u32; 4]> = piece.iter().map(|&patch| edges[patch]).collect();
    Ok(Layout::with_edges(&corners, &sides)?)
}
