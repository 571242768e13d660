//! The page of a surface or model that is measured against a mesh.

use super::{Page, write};
use crate::control::{Cancelled, Control, Pool, Stage};
use crate::export::ExportError;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::{Remarks, ToleranceScale};
use crate::mesh::Mesh;
use crate::model::{FaceId, Model, ModelDeviation};
use crate::query::deviation::{DeviationError, DeviationOptions, deviation};
use crate::query::side::signed;
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate};
use crate::surface::{Kind, Surface};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::path::Path;

/// What a page says beside what is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportOptions<'a> {
    /// Its headline.
    pub title: &'a str,
    /// What one unit of length is called.
    pub unit: &'a str,
    /// The largest distance allowed; None takes the largest found.
    pub tolerance: Option<f64>,
    /// What `tolerance` is measured in; the diagonal is that of the mesh's bounding box.
    pub tolerance_scale: ToleranceScale,
    /// What the fit had to remark.
    pub remarks: Remarks,
}

impl Default for ReportOptions<'_> {
    fn default() -> Self {
        Self {
            title: "Deviation",
            unit: "mm",
            tolerance: None,
            tolerance_scale: ToleranceScale::default(),
            remarks: Remarks::default(),
        }
    }
}

impl ReportOptions<'_> {
    fn check(&self) -> Result<(), ReportError> {
        match self.tolerance.filter(|&value| !(value > 0.0 && value.is_finite())) {
            Some(tolerance) => Err(ReportError::Tolerance(tolerance)),
            None => Ok(()),
        }
    }

    /// The largest distance allowed, in model units.
    fn limit(&self, mesh: &Mesh, found: f64) -> f64 {
        let scale = match self.tolerance_scale {
            ToleranceScale::Relative => mesh.diagonal(),
            ToleranceScale::Absolute => 1.0,
        };
        self.tolerance.map_or(found, |value| value * scale)
    }
}

/// Nodes whose side is looked for in one piece of work.
const NODES_AT_ONCE: usize = 512;

/// A page cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// The tolerance is none.
    #[error("the tolerance is {0}, it must be positive and finite, or 0 for the largest distance")]
    Tolerance(f64),
    /// The distances cannot be measured.
    #[error(transparent)]
    Deviation(#[from] DeviationError),
    /// The surface cannot be shown.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// The file cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for ReportError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Tolerance(_) => ErrorKind::InvalidArgument,
            Self::Deviation(error) => error.kind(),
            Self::Tessellate(error) => error.kind(),
            Self::Export(error) => error.kind(),
            Self::Cancelled(error) => error.kind(),
        }
    }

    fn index(&self) -> Option<usize> {
        match self {
            Self::Deviation(error) => error.index(),
            _ => None,
        }
    }
}

/// Measures a surface against a mesh and writes the page.
pub fn write_report(
    surface: &dyn Surface,
    mesh: &Mesh,
    options: &ReportOptions,
    path: &Path,
    control: &mut Control,
) -> Result<(), ReportError> {
    options.check()?;
    control.enter(Stage::Project);
    let found = deviation(surface, mesh, &DeviationOptions::default(), control.pool())?;
    let distances = signed(surface, mesh.points(), &found.uv, &found.nodes.each, control.pool());
    control.report(0.6, f64::NAN)?;
    control.enter(Stage::Tessellate);
    let triangles = tessellate(surface, &TessellateOptions::default())?.mesh;
    control.report(0.9, f64::NAN)?;
    control.enter(Stage::Write);
    let net = surface.control_net();
    let page = Page {
        title: options.title,
        unit: options.unit,
        mesh,
        distances: &distances,
        places: &|node| format!("{:.4}, {:.4}", found.uv[node].x, found.uv[node].y),
        tolerance: options.limit(mesh, found.nodes.max),
        facts: &facts(surface),
        remarks: &words(options.remarks),
        surface: Some(&triangles),
        net: net.as_ref(),
    };
    Ok(write(&page, path)?)
}

/// Measures a model against a mesh and writes the page.
pub fn write_model_report(
    model: &Model,
    mesh: &Mesh,
    options: &ReportOptions,
    path: &Path,
    control: &mut Control,
) -> Result<(), ReportError> {
    options.check()?;
    control.enter(Stage::Project);
    let found = model.deviation(mesh, &DeviationOptions::default(), control.pool())?;
    control.report(0.5, f64::NAN)?;
    let distances = signed_by_fronts(model, mesh, &found, control.pool());
    control.enter(Stage::Tessellate);
    let triangles = model.tessellate_by(&TessellateOptions::default(), control.pool())?.mesh;
    control.report(0.8, f64::NAN)?;
    let facts = facts_of_model(model);
    control.enter(Stage::Write);
    let place = |node: usize| {
        let uv = found.uv[node];
        let face = found.faces[node].map_or("no face".to_owned(), |face| format!("face {}", face.index()));
        format!("{face} at {:.4}, {:.4}", uv.x, uv.y)
    };
    let page = Page {
        title: options.title,
        unit: options.unit,
        mesh,
        distances: &distances,
        places: &place,
        tolerance: options.limit(mesh, found.nodes.max),
        facts: &facts,
        remarks: &words(options.remarks),
        surface: Some(&triangles),
        net: None,
    };
    Ok(write(&page, path)?)
}

/// The distances of the nodes, negative behind the front of the nearest face.
fn signed_by_fronts(model: &Model, mesh: &Mesh, found: &ModelDeviation, pool: &Pool) -> Vec<f64> {
    let sides: Vec<f64> = pool.run(|| {
        let nodes = mesh.points().par_iter().zip(&found.faces).zip(&found.uv).with_min_len(NODES_AT_ONCE);
        let side = |((&point, face), &uv): ((&DVec3, &Option<FaceId>), &DVec2)| {
            let Some(face) = *face else { return 1.0 };
            let mut row = [0.0; 9];
            model.carrier(face).eval_rows(&[uv], 1, &mut row);
            let [at, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
            let front = if model.face(face).is_forward { 1.0 } else { -1.0 };
            if front * along_u.cross(along_v).dot(point - at) < 0.0 { -1.0 } else { 1.0 }
        };
        nodes.map(side).collect()
    });
    found.nodes.each.iter().zip(sides).map(|(distance, side)| side * distance).collect()
}

fn facts_of_model(model: &Model) -> Vec<(String, String)> {
    let measure = model.measure();
    let count = |count: usize| count.to_string();
    let mut facts = vec![
        ("shells", count(model.shells().len())),
        ("faces", count(model.faces().len())),
        ("edges", count(model.edges().len())),
        ("edges of one face", count(measure.free_edge_count)),
        ("sharp edges", count(measure.sharp_edge_count)),
        ("control points", count(model.pole_count())),
        ("largest gap", format!("{:.1e}", measure.max_gap)),
        ("largest angle across a smooth edge", format!("{:.1e} rad", measure.max_normal_jump)),
        ("area", format!("{:.6e}", measure.area)),
    ];
    if measure.volume != 0.0 {
        facts.push(("volume", format!("{:.6e}", measure.volume)));
    }
    facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn facts(surface: &dyn Surface) -> [(String, String); 2] {
    let family = match surface.kind() {
        Kind::Tensor => "tensor",
        Kind::TSpline => "T-spline",
        Kind::Pht => "PHT-spline",
        Kind::D1rc => "D1RC-spline",
    };
    let count = surface.coefficient_count().to_string();
    [("family".to_owned(), family.to_owned()), ("control points".to_owned(), count)]
}

/// What each remark means, and what to do about it.
fn words(remarks: Remarks) -> Vec<(String, String)> {
    remarks.words().map(|words| (sentence(words.what), sentence(words.advice))).collect()
}

/// Words with a capital and a stop.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}
