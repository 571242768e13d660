//! How any mesh becomes a model, and what it has become.

use super::{LayoutFit, ModelOptions, ModelReport};
use crate::fit::common::report::Remarks;
use crate::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use crate::layout::{Layout, Place};
use crate::mesh::{FeatureOptions, Mesh};
use crate::model::{FaceId, Model, NodePlace, PatchPiece, Planes};
use crate::options::with_fields;
use crate::summary::summarize;
use crate::surface::pht::PhtSurface;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// Which way a mesh becomes a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Family {
    /// What serves: exact faces, patches that keep sharp edges, smooth ones or a chart ([`fit_mesh`](super::fit_mesh)).
    #[default]
    Auto,
    /// One chart.
    Chart,
    /// Patches over a layout.
    Patches,
}

/// How any mesh becomes a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshModelOptions<'a> {
    /// Chart or patches.
    pub family: Family,
    /// Whether a mesh of planes and cylinders becomes exact faces, unless a chart or patches are asked for. Default: yes.
    pub exact: bool,
    /// What its sharp edges are.
    pub features: FeatureOptions<'a>,
    /// How patches are fitted; the tolerance holds for a chart too.
    pub fit: ModelOptions,
    /// Which layout patches have.
    pub layout: MeshLayoutOptions,
    /// By how much levels of cells in one face may differ. Default 1: few faces, and no huge nets, which other
    /// programs integrate badly.
    pub level_spread: u32,
}

impl Default for MeshModelOptions<'_> {
    fn default() -> Self {
        Self {
            family: Family::default(),
            exact: true,
            features: FeatureOptions::default(),
            fit: ModelOptions::default(),
            layout: MeshLayoutOptions::default(),
            level_spread: 1,
        }
    }
}

impl<'a> MeshModelOptions<'a> {
    with_fields! {
        with_family family: Family,
        with_exact exact: bool,
        with_features features: FeatureOptions<'a>,
        with_fit fit: ModelOptions,
        with_layout layout: MeshLayoutOptions,
        with_level_spread level_spread: u32,
    }
}

/// What one component has become.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentReport {
    /// Handles.
    pub genus: usize,
    /// Which layout it has; None for a chart or exact faces.
    pub layout: Option<LayoutKind>,
    /// Faces on planes and cylinders, also those beside patches.
    pub exact_faces: usize,
    /// Symmetric Dirichlet energy of the node map by area: 4 for an isometry.
    pub map_energy: f64,
    /// Nodes or triangles that the map folds.
    pub fold_count: usize,
    /// The component in which it is a void.
    pub void_in: Option<usize>,
    /// Whether the mesh was inside out and has been turned.
    pub is_turned: bool,
    /// Whether sharp edges were found that its patches round off, because what keeps them was no better.
    pub rounds_edges: bool,
    /// Seconds for layout and map.
    pub map_seconds: f64,
    /// The fit.
    pub fit: ModelReport,
}

/// The patches of one component.
#[derive(Debug, Clone)]
pub struct Piece {
    /// How they meet.
    pub layout: Layout,
    /// One for each quad.
    pub surfaces: Vec<PhtSurface>,
    /// What closes them where the layout has borders.
    pub planes: Planes,
    /// By patch the label of the region that it covers, or where patches run over labels the one that most of it has; empty
    /// without labels.
    pub labels: Vec<u32>,
}

/// Where a node of a component lies.
#[derive(Debug, Clone, Copy)]
pub(super) enum Spot {
    /// On a patch.
    Patch(Place),
    /// On a plane, by its number, at parameters.
    Plane(usize, DVec2),
}

/// A component that has become patches and planes; places and errors by its nodes.
pub(super) struct Component {
    pub piece: Piece,
    pub spots: Vec<Option<Spot>>,
    pub errors: Vec<f64>,
    pub report: ComponentReport,
    /// Whether its patches are as good as noise lets them be, which may be more than the tolerance, and its planes lie in
    /// the middle of it.
    pub misses_noise_only: bool,
}

impl Component {
    pub(super) fn smooth(layout: Layout, fit: LayoutFit, report: ComponentReport) -> Self {
        let spots = fit.places.into_iter().map(|place| place.map(Spot::Patch)).collect();
        let piece = Piece { layout, surfaces: fit.surfaces, planes: Planes::default(), labels: Vec::new() };
        Self { piece, spots, errors: fit.errors, report, misses_noise_only: false }
    }

    /// Gives each patch the label, of those by triangle, that most corners of triangles on it have; of equals the smallest.
    pub(super) fn name_patches(&mut self, mesh: &Mesh, labels: &[u32]) {
        if labels.is_empty() {
            return;
        }
        let mut votes: Vec<BTreeMap<u32, usize>> = vec![BTreeMap::new(); self.piece.surfaces.len()];
        for (triangle, &label) in mesh.triangles().iter().zip(labels) {
            for spot in triangle.iter().filter_map(|&node| self.spots[node as usize]) {
                if let Spot::Patch(place) = spot {
                    *votes[place.quad as usize].entry(label).or_default() += 1;
                }
            }
        }
        let most = |votes: &BTreeMap<u32, usize>| {
            votes
                .iter()
                .max_by_key(|&(&label, &count)| (count, Reverse(label)))
                .map_or(0, |(&label, _)| label)
        };
        self.piece.labels = votes.iter().map(most).collect();
    }
}

impl Piece {
    /// What its smooth space is built over.
    pub(super) fn origin(&self) -> PatchPiece {
        PatchPiece::new(self.layout.clone(), self.surfaces.iter().map(PhtSurface::mesh))
    }
}

/// Where the nodes went, for the model to keep.
pub(super) fn origins(places: &[Option<(FaceId, DVec2)>], errors: &[f64]) -> Vec<Option<NodePlace>> {
    let keep = |(place, &error): (&Option<_>, _)| place.map(|(face, uv)| NodePlace { face, uv, error });
    places.iter().zip(errors).map(keep).collect()
}

/// A model with all that is known of it.
#[derive(Debug, Clone)]
pub struct ModelFit {
    /// The model.
    pub model: Model,
    /// The patches it was made of; none for a chart or exact faces.
    pub pieces: Vec<Piece>,
    /// The face and parameters of each node; None for a node without triangles.
    pub places: Vec<Option<(FaceId, DVec2)>>,
    /// The error of each node; NaN without a place.
    pub errors: Vec<f64>,
    /// Component by component, solids before their voids.
    pub components: Vec<ComponentReport>,
    /// All components together.
    pub report: ModelReport,
    /// Seconds in all.
    pub seconds: f64,
}

impl ModelFit {
    /// Whether it is one chart.
    pub fn is_chart(&self) -> bool {
        self.pieces.is_empty() && self.components.iter().all(|component| component.exact_faces == 0)
    }
}

/// The reports of all components in one.
pub(super) fn together(mesh: &Mesh, components: &[ComponentReport], errors: &[f64]) -> ModelReport {
    let fits = || components.iter().map(|component| &component.fit);
    let largest = |of: fn(&ModelReport) -> f64| fits().map(of).fold(0.0, f64::max);
    let max_interior_error = largest(|fit| fit.max_interior_error);
    // nodes without triangles have none
    let known = summarize(errors.iter().map(|error| if error.is_nan() { 0.0 } else { *error }).collect());
    let used = errors.iter().filter(|error| !error.is_nan()).count().max(1) as f64;
    let share = used / errors.len().max(1) as f64;
    let mut remarks = Remarks::default();
    fits().for_each(|fit| remarks.0 |= fit.remarks.0);
    ModelReport {
        max_error: known.max,
        rms_error: known.rms / share.sqrt(),
        mean_error: known.mean / share,
        worst_node: known.worst_index,
        tolerance: largest(|fit| fit.tolerance),
        diagonal: mesh.diagonal(),
        max_interior_error,
        facet_sagitta: max_interior_error - largest(|fit| fit.max_interior_error - fit.facet_sagitta),
        max_back_distance: largest(|fit| fit.max_back_distance),
        max_back_excess: largest(|fit| fit.max_back_excess),
        normal_jump: largest(|fit| fit.normal_jump),
        gap: largest(|fit| fit.gap),
        crease_error: largest(|fit| fit.crease_error),
        folded_cells: fits().map(|fit| fit.folded_cells).sum(),
        volume: fits().map(|fit| fit.volume).sum(),
        mesh_volume: fits().map(|fit| fit.mesh_volume).sum(),
        patches: fits().flat_map(|fit| fit.patches.iter().cloned()).collect(),
        coefficient_count: fits().map(|fit| fit.coefficient_count).sum(),
        free_count: fits().map(|fit| fit.free_count).sum(),
        cell_count: fits().map(|fit| fit.cell_count).sum(),
        deepest_level: fits().map(|fit| fit.deepest_level).max().unwrap_or(0),
        dropped_samples: fits().map(|fit| fit.dropped_samples).sum(),
        passes: fits().map(|fit| fit.passes).max().unwrap_or(0),
        mesh_crossings: 0,
        crossings: None,
        stop: fits().map(|fit| fit.stop).find(|&stop| stop != Default::default()).unwrap_or_default(),
        remarks,
        fit_seconds: fits().map(|fit| fit.fit_seconds).sum(),
    }
}
