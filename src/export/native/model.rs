//! A model.
//!
//! ```text
//! offset  type          content
//! 24      u64 x 5       counts of surfaces, vertices, edges, faces, shells
//! 64      f64           diagonal
//! 72                    for each surface: u64 0 and what follows dim (included) in a tensor surface;
//!                       or u64 1 (plane) or 2 (cylinder), f64 x 9 origin, first and third axis, for a cylinder
//!                       its f64 radius
//!                       for each vertex: f64 x 3
//!                       for each edge: u64 x 2 its vertices, u64 1 if it is sharp, else 0, plus 2 for an arc of a
//!                       circle or ellipse; then what follows dim (included) in a curve, or for an arc f64 x 9 centre,
//!                       first and third axis, f64 x 2 radii, f64 x 2 the parameters at its ends
//!                       for each face: u64 its surface, u64 1 if it is not turned, u64 label, u64 number of loops;
//!                       for each loop: u64 number of edges; for each of them: u64 the edge, u64 1 if it runs along
//!                       it, u64 1 if there is a p-curve, and then the p-curve as a curve
//!                       for each shell: u64 0 open, 1 solid, 2 void, u64 the shell it is a void in (else 0), u64
//!                       number of faces, the faces as u64
//!                       for a model that a fit made, else nothing: u64 number of nodes; for each of them: u64 its
//!                       face plus 1, or 0 for none, f64 x 3 u, v, error; u64 number of pieces of patches; for each of
//!                       them: u64 number of quads; for each quad: u64 x 4 its corners, u64 x 4 the edges of its sides,
//!                       u64 number of splits, u64 x 3 level, i, j of each cell that is split; u64 number of creases,
//!                       the edges as u64; u64 number of sectors between borders and creases; for each of them u64 x 2
//!                       quad and side of its first corner, f64 its angle; and if there are pieces, for each face
//!                       u64 x 2 its piece plus 1, or 0 for none, and quad
//! ```

use super::bytes::{Reader, Writer};
use super::{FIRST_VERSION, LoadError, MODEL, Save, curve, pht, tensor};
use crate::curve::Curve;
use crate::layout::{Creases, Layout, Sector, Side};
use crate::memory;
use crate::model::{
    Arc, Builder, Carrier, Coedge, Cylinder, Edge, EdgeCurve, EdgeId, Face, FaceId, Frame, Loop, Model,
    NodePlace, Origin, PatchPiece, Plane, Role, ShellId, SurfaceId, VertexId,
};
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// The first version that knows arcs.
const VERSION_OF_ARCS: u32 = 2;
/// Added to the flag of a sharp edge that is an arc.
const ARC: usize = 2;
/// Bytes of a count, flag, number or double.
const FIELD: usize = 8;

impl Save for Model {
    fn file_kind(&self) -> u32 {
        MODEL
    }

    fn version(&self) -> u32 {
        let has_arcs = self.edges().iter().any(|edge| edge.curve.spline().is_none());
        if has_arcs { VERSION_OF_ARCS } else { FIRST_VERSION }
    }

    fn content_size(&self) -> usize {
        let surface = |carrier: &Carrier| match carrier {
            Carrier::Spline(spline) => FIELD + spline.content_size(),
            Carrier::Plane(_) => 10 * FIELD,
            Carrier::Cylinder(_) => 11 * FIELD,
        };
        let edge = |edge: &Edge| match &edge.curve {
            EdgeCurve::Spline(curve) => 3 * FIELD + curve.content_size(),
            EdgeCurve::Arc(_) => 16 * FIELD,
        };
        let coedge = |coedge: &Coedge| 3 * FIELD + coedge.pcurve.as_ref().map_or(0, Save::content_size);
        let bound = |bound: &Loop| FIELD + bound.iter().map(coedge).sum::<usize>();
        let face = |face: &Face| 4 * FIELD + face.bounds.iter().map(bound).sum::<usize>();
        6 * FIELD
            + self.surfaces().iter().map(surface).sum::<usize>()
            + 3 * FIELD * self.vertices().len()
            + self.edges().iter().map(edge).sum::<usize>()
            + self.faces().iter().map(face).sum::<usize>()
            + self.shells().iter().map(|shell| (3 + shell.faces.len()) * FIELD).sum::<usize>()
            + self.origin().map_or(0, origin_size)
    }

    fn write(&self, writer: &mut Writer) {
        let (vertices, edges) = (self.vertices().len(), self.edges().len());
        for count in [self.surfaces().len(), vertices, edges, self.faces().len(), self.shells().len()] {
            writer.count(count);
        }
        writer.doubles(&[self.diagonal()]);
        self.surfaces().iter().for_each(|carrier| write_carrier(carrier, writer));
        self.vertices().iter().for_each(|place| writer.doubles(&place.to_array()));
        for edge in self.edges() {
            edge.vertices.iter().for_each(|vertex| writer.count(vertex.index()));
            match &edge.curve {
                EdgeCurve::Spline(curve) => {
                    writer.count(usize::from(edge.is_sharp));
                    curve.write(writer);
                }
                EdgeCurve::Arc(arc) => {
                    writer.count(usize::from(edge.is_sharp) + ARC);
                    write_frame(arc.frame(), writer);
                    let (from, to) = arc.domain();
                    writer.doubles(&[arc.radii()[0], arc.radii()[1], from, to]);
                }
            }
        }
        self.faces().iter().for_each(|face| write_face(face, writer));
        for shell in self.shells() {
            let (role, solid) = match shell.role {
                Role::Open => (0, 0),
                Role::Solid => (1, 0),
                Role::VoidIn(solid) => (2, solid.index()),
            };
            [role, solid, shell.faces.len()].into_iter().for_each(|number| writer.count(number));
            shell.faces.iter().for_each(|face| writer.count(face.index()));
        }
        if let Some(origin) = self.origin() {
            write_origin(origin, writer);
        }
    }
}

fn origin_size(origin: &Origin) -> usize {
    let quads = |piece: &PatchPiece| piece.splits().iter().map(|splits| 9 + 3 * splits.len()).sum::<usize>();
    let creases = |layout: &Layout| 2 + creases(layout).count() + 3 * open_sectors(layout).count();
    let pieces = origin.pieces.iter().map(|piece| 1 + quads(piece) + creases(piece.layout())).sum::<usize>();
    FIELD * (2 + 4 * origin.nodes.len() + pieces + 2 * origin.patch_of_face.len())
}

/// The edges of two sides that are sharp.
fn creases(layout: &Layout) -> impl Iterator<Item = u32> {
    let is_crease = |&edge: &u32| layout.edges()[edge as usize].second.is_some() && !layout.is_smooth(edge);
    (0..layout.edges().len() as u32).filter(is_crease)
}

fn open_sectors(layout: &Layout) -> impl Iterator<Item = &Sector> {
    layout.sectors().iter().filter(|sector| sector.is_open())
}

fn write_origin(origin: &Origin, writer: &mut Writer) {
    writer.count(origin.nodes.len());
    for node in &origin.nodes {
        writer.count(node.map_or(0, |node| node.face.index() + 1));
        writer.doubles(&node.map_or([0.0; 3], |node| [node.uv.x, node.uv.y, node.error]));
    }
    writer.count(origin.pieces.len());
    for piece in &origin.pieces {
        let layout = piece.layout();
        writer.count(layout.quads().len());
        for ((quad, corners), splits) in (0..).zip(layout.quads()).zip(piece.splits()) {
            corners.iter().for_each(|&corner| writer.count(corner as usize));
            (0..4).for_each(|side| writer.count(layout.edge_of(Side { quad, side }).edge as usize));
            writer.count(splits.len());
            for cell in splits {
                [cell.level, cell.i, cell.j].into_iter().for_each(|number| writer.count(number as usize));
            }
        }
        writer.count(creases(layout).count());
        creases(layout).for_each(|edge| writer.count(edge as usize));
        writer.count(open_sectors(layout).count());
        for sector in open_sectors(layout) {
            let Side { quad, side } = sector.corners[0];
            writer.count(quad as usize);
            writer.count(side.into());
            writer.doubles(&[sector.angle]);
        }
    }
    for patch in &origin.patch_of_face {
        // 0 stands for none
        patch
            .map_or([0; 2], |[piece, quad]| [piece + 1, quad])
            .iter()
            .for_each(|&x| writer.count(x as usize));
    }
}

fn write_frame(frame: &Frame, writer: &mut Writer) {
    [frame.origin(), frame.x(), frame.z()].iter().for_each(|axis| writer.doubles(&axis.to_array()));
}

fn write_carrier(carrier: &Carrier, writer: &mut Writer) {
    match carrier {
        Carrier::Spline(spline) => {
            writer.count(0);
            spline.write(writer);
        }
        Carrier::Plane(plane) => {
            writer.count(1);
            write_frame(&plane.0, writer);
        }
        Carrier::Cylinder(cylinder) => {
            writer.count(2);
            write_frame(cylinder.frame(), writer);
            writer.doubles(&[cylinder.radius()]);
        }
    }
}

fn write_face(face: &Face, writer: &mut Writer) {
    writer.count(face.surface.index());
    writer.count(usize::from(face.is_forward));
    writer.count(face.label as usize);
    writer.count(face.bounds.len());
    for bound in &face.bounds {
        writer.count(bound.len());
        for coedge in bound {
            writer.count(coedge.edge.index());
            writer.count(usize::from(coedge.is_forward));
            writer.count(usize::from(coedge.pcurve.is_some()));
            coedge.pcurve.iter().for_each(|pcurve| pcurve.write(writer));
        }
    }
}

pub(super) fn read(reader: &mut Reader) -> Result<Model, LoadError> {
    let mut counts = [0; 5];
    for count in &mut counts {
        *count = reader.count()?;
    }
    let [surfaces, vertices, edges, faces, shells] = counts;
    let mut builder = Builder::default();
    builder.diagonal(reader.double()?);
    for _ in 0..surfaces {
        builder.surface(read_carrier(reader)?);
    }
    for _ in 0..vertices {
        builder.vertex(read_place(reader)?);
    }
    for _ in 0..edges {
        let vertices = [reader.number()?, reader.number()?].map(VertexId::new);
        let (is_sharp, curve) = read_edge_curve(reader)?;
        builder.add_edge(Edge { curve, vertices, is_sharp });
    }
    for _ in 0..faces {
        builder.add_face(read_face(reader)?);
    }
    for _ in 0..shells {
        let (role, solid, count) = (reader.count()?, reader.number()?, reader.count()?);
        let role = match role {
            0 => Role::Open,
            1 => Role::Solid,
            2 => Role::VoidIn(ShellId::new(solid)),
            _ => return Err(reader.wrong(format!("the role {role} of a shell is unknown"))),
        };
        let mut faces = Vec::new();
        for _ in 0..count {
            memory::push(&mut faces, FaceId::new(reader.number()?));
        }
        builder.shell(faces, role);
    }
    let model = builder.finish().map_err(|error| reader.wrong(error.to_string()))?;
    if reader.end().is_ok() {
        return Ok(model);
    }
    let origin = read_origin(reader, faces)?;
    model.with_origin(origin).map_err(|error| reader.wrong(error.to_string()))
}

fn read_origin(reader: &mut Reader, face_count: usize) -> Result<Origin, LoadError> {
    let (node_count, mut nodes) = (reader.count()?, Vec::new());
    for _ in 0..node_count {
        let face = reader.number()?.checked_sub(1).map(FaceId::new);
        let [u, v, error] = [reader.double()?, reader.double()?, reader.double()?];
        nodes.push(face.map(|face| NodePlace { face, uv: DVec2::new(u, v), error }));
    }
    let (piece_count, mut pieces) = (reader.count()?, Vec::new());
    for _ in 0..piece_count {
        pieces.push(read_patches(reader)?);
    }
    let mut patch_of_face = Vec::new();
    for _ in 0..if pieces.is_empty() { 0 } else { face_count } {
        let [piece, quad] = [reader.number()?, reader.number()?];
        patch_of_face.push(piece.checked_sub(1).map(|piece| [piece, quad]));
    }
    Ok(Origin { nodes, pieces, patch_of_face })
}

fn read_patches(reader: &mut Reader) -> Result<PatchPiece, LoadError> {
    let (count, mut quads, mut edges, mut splits) = (reader.count()?, Vec::new(), Vec::new(), Vec::new());
    let four = |reader: &mut Reader| -> Result<[u32; 4], LoadError> {
        Ok([reader.number()?, reader.number()?, reader.number()?, reader.number()?])
    };
    for _ in 0..count {
        quads.push(four(reader)?);
        edges.push(four(reader)?);
        let count = reader.count()?;
        splits.push(pht::read_splits(reader, count)?);
    }
    let (crease_count, mut sharp) = (reader.count()?, BTreeSet::new());
    for _ in 0..crease_count {
        sharp.insert(reader.number()?);
    }
    let (sector_count, mut angles) = (reader.count()?, BTreeMap::new());
    for _ in 0..sector_count {
        let corner = [reader.number()?, reader.number()?];
        let angle = reader.double()?;
        if !angle.is_finite() {
            return Err(reader.wrong("the angle of a sector is not finite"));
        }
        angles.insert(corner, angle);
    }
    let angle = |sector: &Sector| {
        let Side { quad, side } = sector.corners[0];
        angles.get(&[quad, side.into()]).copied().unwrap_or(PI)
    };
    let creases = Creases { sharp: &sharp, angle: &angle };
    let layout = Layout::with_creases(&quads, &edges, &creases);
    let layout = layout.map_err(|error| reader.wrong(error.to_string()))?;
    PatchPiece::from_splits(layout, splits).map_err(|error| reader.wrong(error.to_string()))
}

fn read_place(reader: &mut Reader) -> Result<DVec3, LoadError> {
    Ok(DVec3::from_slice(&reader.doubles(3)?))
}

fn read_edge_curve(reader: &mut Reader) -> Result<(bool, EdgeCurve), LoadError> {
    let flags = reader.count()?;
    if flags < ARC {
        return Ok((flags == 1, curve::read(reader)?.into()));
    }
    if flags > ARC + 1 {
        return Err(reader.wrong(format!("the flags {flags} of an edge are unknown")));
    }
    let frame = read_frame(reader)?;
    let numbers = reader.doubles(4)?;
    let arc = Arc::new(frame, [numbers[0], numbers[1]], [numbers[2], numbers[3]]);
    let arc = arc.ok_or_else(|| reader.wrong("radii or ends of an arc are none"))?;
    Ok((flags == ARC + 1, arc.into()))
}

fn read_carrier(reader: &mut Reader) -> Result<Carrier, LoadError> {
    match reader.count()? {
        0 => Ok(tensor::read(reader)?.into()),
        1 => Ok(Plane(read_frame(reader)?).into()),
        2 => {
            let frame = read_frame(reader)?;
            let cylinder = Cylinder::new(frame, reader.double()?);
            Ok(cylinder.ok_or_else(|| reader.wrong("the radius of a cylinder is not positive"))?.into())
        }
        kind => Err(reader.wrong(format!("the kind {kind} of a surface under a face is unknown"))),
    }
}

fn read_frame(reader: &mut Reader) -> Result<Frame, LoadError> {
    let [origin, x, z] = [read_place(reader)?, read_place(reader)?, read_place(reader)?];
    Frame::from_axes(origin, z, x)
        .ok_or_else(|| reader.wrong("axes are not at right angles or not of length 1"))
}

fn read_face(reader: &mut Reader) -> Result<Face, LoadError> {
    let surface = SurfaceId::new(reader.number()?);
    let is_forward = reader.flag()?;
    let (label, loop_count) = (reader.number()?, reader.count()?);
    let mut bounds: Vec<Loop> = Vec::new();
    for _ in 0..loop_count {
        let count = reader.count()?;
        let mut bound = Vec::new();
        for _ in 0..count {
            let edge = EdgeId::new(reader.number()?);
            let is_forward = reader.flag()?;
            let pcurve: Option<Curve> = if reader.flag()? { Some(curve::read(reader)?) } else { None };
            memory::push(&mut bound, Coedge { edge, is_forward, pcurve });
        }
        memory::push(&mut bounds, bound);
    }
    Ok(Face { surface, is_forward, bounds, label })
}
