//! Where a fitted model comes from: the place of each node of the mesh, and the patches that its faces are parts of.

use super::{FaceId, Model, ModelError};
use crate::layout::Layout;
use crate::tmesh::{Cell, TMesh, TMeshError};
use glam::DVec2;

/// Where a node of the fitted mesh went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodePlace {
    /// The face.
    pub face: FaceId,
    /// Its parameters on the surface of the face.
    pub uv: DVec2,
    /// Its distance from the model there.
    pub error: f64,
}

/// Patches in one piece that meet smoothly: what a smooth space is built over.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchPiece {
    layout: Layout,
    /// By quad: the cells that are split, each before its quarters.
    splits: Vec<Vec<Cell>>,
}

impl PatchPiece {
    /// Patches over the quads of a layout, with their cells.
    pub fn new<'a>(layout: Layout, meshes: impl Iterator<Item = &'a TMesh>) -> Self {
        Self { layout, splits: meshes.map(|mesh| mesh.splits().collect()).collect() }
    }

    /// The same from the cells that are split, each before its quarters, if they can be.
    pub fn from_splits(layout: Layout, splits: Vec<Vec<Cell>>) -> Result<Self, TMeshError> {
        splits.iter().try_for_each(|splits| mesh_of(splits).map(drop))?;
        Ok(Self { layout, splits })
    }

    /// How they meet.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// By quad: the cells that are split, each before its quarters.
    pub fn splits(&self) -> &[Vec<Cell>] {
        &self.splits
    }

    /// The cells of each quad.
    pub fn meshes(&self) -> Vec<TMesh> {
        let mesh = |splits: &Vec<Cell>| mesh_of(splits).expect("they have been split before");
        self.splits.iter().map(mesh).collect()
    }
}

/// One cell, split.
fn mesh_of(splits: &[Cell]) -> Result<TMesh, TMeshError> {
    let mut mesh = TMesh::new(&[0.0, 1.0], &[0.0, 1.0])?;
    mesh.split_all(splits)?;
    Ok(mesh)
}

/// Where a model comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Origin {
    /// By node of the mesh; None for a node without triangles.
    pub nodes: Vec<Option<NodePlace>>,
    /// The patches; none for a model of one chart.
    pub pieces: Vec<PatchPiece>,
    /// For each face its piece and, in that, its quad, whose parameters it has; None for a face that is no part of a
    /// patch. Empty without patches.
    pub patch_of_face: Vec<Option<[u32; 2]>>,
}

/// How far the nodes on one face are from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceErrors {
    /// Nodes on it.
    pub node_count: usize,
    /// The largest error; NaN without nodes.
    pub max: f64,
    /// Square root of the mean of its square; NaN without nodes.
    pub rms: f64,
}

impl Default for FaceErrors {
    fn default() -> Self {
        Self { node_count: 0, max: f64::NAN, rms: f64::NAN }
    }
}

impl Origin {
    /// Refuses faces, pieces and quads that do not exist.
    fn check(&self, face_count: usize) -> Result<(), ModelError> {
        let is_lost = |node: &Option<NodePlace>| node.is_some_and(|node| node.face.index() >= face_count);
        if let Some(index) = self.nodes.iter().position(is_lost) {
            return Err(ModelError::NoSuch { part: "node", index });
        }
        let is_there = |[piece, quad]: [u32; 2]| {
            self.pieces.get(piece as usize).is_some_and(|piece| (quad as usize) < piece.splits.len())
        };
        let is_whole = self.patch_of_face.is_empty() == self.pieces.is_empty()
            && (self.patch_of_face.is_empty() || self.patch_of_face.len() == face_count)
            && self.pieces.iter().all(|piece| piece.splits.len() == piece.layout.quads().len());
        match self.patch_of_face.iter().position(|patch| !patch.is_none_or(is_there)) {
            Some(index) => Err(ModelError::NoSuch { part: "face", index }),
            None if !is_whole => Err(ModelError::NoSuch { part: "face", index: self.patch_of_face.len() }),
            None => Ok(()),
        }
    }

    /// Errors of each face.
    fn errors(&self, face_count: usize) -> Vec<FaceErrors> {
        let mut sums = vec![(0_usize, 0.0, 0.0); face_count];
        for node in self.nodes.iter().flatten() {
            let (count, max, sum_sq) = &mut sums[node.face.index()];
            *count += 1;
            *max = f64::max(*max, node.error);
            *sum_sq += node.error * node.error;
        }
        let of_face = |(node_count, max, sum_sq): (usize, f64, f64)| match node_count {
            0 => FaceErrors::default(),
            _ => FaceErrors { node_count, max, rms: (sum_sq / node_count as f64).sqrt() },
        };
        sums.into_iter().map(of_face).collect()
    }
}

impl Model {
    /// The same model with what is known of where it comes from.
    pub fn with_origin(mut self, origin: Origin) -> Result<Self, ModelError> {
        origin.check(self.faces().len())?;
        self.face_errors = origin.errors(self.faces().len());
        self.origin = Some(origin.into());
        Ok(self)
    }

    /// Where it comes from; None for a model that no fit made.
    pub fn origin(&self) -> Option<&Origin> {
        self.origin.as_deref()
    }

    /// How far the nodes on a face are from it; no nodes for a model that no fit made.
    pub fn face_errors(&self, face: FaceId) -> FaceErrors {
        self.face_errors.get(face.index()).copied().unwrap_or_default()
    }
}
