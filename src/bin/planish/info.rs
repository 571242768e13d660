//! `planish info`.

use crate::input::MeshInput;
use crate::output::{self, Table};
use crate::{Failure, Given, Outcome};
use clap::Args;
use planish::curve::Curve;
use planish::export::native::{Saved, load_any_file};
use planish::model::{Model, Role};
use planish::surface::d1rc::D1rcSurface;
use planish::surface::pht::PhtSurface;
use planish::surface::tensor::{Axis, TensorSurface};
use planish::surface::tspline::TSplineSurface;
use planish::surface::{AnySurface, Surface};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// Mesh file (OFF, OBJ, PLY, STL) or what was saved (.planish): a surface, model or curve.
    file: PathBuf,
    #[command(flatten)]
    input: MeshInput,
}

pub(crate) fn run(arguments: &InfoArguments, given: &Given) -> Result<Outcome, Failure> {
    let table = if output::is_saved(&arguments.file) {
        MeshInput::refuse(given)?;
        match load_any_file(&arguments.file)? {
            Saved::Surface(surface) => surface_table(&arguments.file, &surface),
            Saved::Model(model) => model_table(&arguments.file, &model),
            Saved::Curve(curve) => curve_table(&arguments.file, &curve),
        }
    } else {
        mesh_table(arguments)?
    };
    output::print(table)?;
    Ok(Outcome::Done)
}

fn mesh_table(arguments: &InfoArguments) -> Result<Table, Failure> {
    let (mesh, repairs) = arguments.input.read(&arguments.file)?;
    let mut table = Table::default();
    table.row("mesh", arguments.file.display().to_string());
    table.row("nodes", mesh.points().len().to_string());
    table.row("triangles", mesh.triangles().len().to_string());
    table.row("edges", mesh.edge_count().to_string());
    table.row("components", mesh.component_count().to_string());
    table.row("genus", mesh.genus().to_string());
    let loops: Vec<String> = mesh.loops().iter().take(12).map(|nodes| nodes.len().to_string()).collect();
    let more = if mesh.loops().len() > loops.len() { ", ..." } else { "" };
    table.row(
        "boundary loops",
        match loops.len() {
            0 => "none: closed".to_owned(),
            _ => format!("{} ({}{more} nodes)", mesh.loops().len(), loops.join(", ")),
        },
    );
    let bounds = mesh.bounds();
    let sides: Vec<String> = bounds.sides().map(|side| format!("{side:.6}")).collect();
    table.row("bounding box", format!("{}, diagonal {:.6}", sides.join(" x "), bounds.diagonal()));
    table.row("parameters", if mesh.parameters().is_some() { "yes" } else { "no" }.to_owned());
    let fields: Vec<&str> = mesh.fields().iter().map(|field| field.name.as_str()).collect();
    table.row("fields", if fields.is_empty() { "none".to_owned() } else { fields.join(", ") });
    for (what, nodes) in [("unused nodes", mesh.unused_nodes()), ("pinched nodes", mesh.pinched_nodes())] {
        if !nodes.is_empty() {
            table.row(what, nodes.len().to_string());
        }
    }
    output::repair_rows(&mut table, &repairs);
    output::loose_row(&mut table, &mesh);
    Ok(table)
}

fn curve_table(path: &Path, curve: &Curve) -> Table {
    let mut table = Table::default();
    table.row("curve", path.display().to_string());
    table.row("degree", curve.knots().degree().to_string());
    table.row("control points", curve.knots().basis_count().to_string());
    table.row("dimension", curve.dim().to_string());
    let (from, to) = curve.knots().domain();
    table.row("domain", format!("u {from} to {to}"));
    table
}

fn model_table(path: &Path, model: &Model) -> Table {
    let measure = model.measure();
    let mut table = Table::default();
    table.row("model", path.display().to_string());
    let count = |role: fn(&Role) -> bool| model.shells().iter().filter(|shell| role(&shell.role)).count();
    let solids = count(|role| *role == Role::Solid);
    let voids = count(|role| matches!(role, Role::VoidIn(_)));
    table.row("shells", format!("{solids} solid, {voids} void, {} open", count(|role| *role == Role::Open)));
    table.row("faces", model.faces().len().to_string());
    let (free, sharp) = (measure.free_edge_count, measure.sharp_edge_count);
    table.row("edges", format!("{}, {free} free, {sharp} sharp", model.edges().len()));
    table.row("vertices", model.vertices().len().to_string());
    table.row("control points", model.pole_count().to_string());
    let sides = (measure.max - measure.min).to_array().map(|side| format!("{side:.6}"));
    table.row("bounding box", format!("{}, diagonal {:.6}", sides.join(" x "), model.diagonal()));
    table.row("area", format!("{:.9}", measure.area));
    if solids > 0 {
        table.row("volume", format!("{:.9}", measure.volume));
    }
    table.row("largest gap", format!("{:.1e}", measure.max_gap));
    table.row("normal jump", format!("{:.1e} rad across edges that are not sharp", measure.max_normal_jump));
    table
}

fn surface_table(path: &Path, surface: &AnySurface) -> Table {
    let mut table = Table::default();
    table.row("surface", path.display().to_string());
    match surface {
        AnySurface::Tensor(tensor) => tensor_rows(tensor, &mut table),
        AnySurface::TSpline(tspline) => tspline_rows(tspline, &mut table),
        AnySurface::Pht(pht) => pht_rows(pht, &mut table),
        AnySurface::D1rc(d1rc) => d1rc_rows(d1rc, &mut table),
    }
    let surface = surface.as_surface();
    let domain = surface.domain();
    table.row("dimension", surface.dim().to_string());
    table.row(
        "domain",
        format!("u {} to {}, v {} to {}", domain.min.x, domain.max.x, domain.min.y, domain.max.y),
    );
    if let Some(data) = surface.region().data_box {
        let (min, max) = (data.min, data.max);
        table.row("box of the data", format!("u {} to {}, v {} to {}", min.x, max.x, min.y, max.y));
    }
    table.row("trims", surface.region().trims.loops().len().to_string());
    table
}

fn tensor_rows(surface: &TensorSurface, table: &mut Table) {
    let (knots_u, knots_v) = (surface.knots(Axis::U), surface.knots(Axis::V));
    table.row("kind", "tensor".to_owned());
    table.row("degrees", format!("{} x {}", knots_u.degree(), knots_v.degree()));
    table.row("control points", format!("{} x {}", knots_u.basis_count(), knots_v.basis_count()));
    table.row("weights", if surface.weights().is_some() { "yes" } else { "no" }.to_owned());
}

fn tspline_rows(surface: &TSplineSurface, table: &mut Table) {
    let counts = surface.curves().iter().map(|curve| curve.knots().basis_count());
    let (least, most) = (counts.clone().min().unwrap_or(0), counts.max().unwrap_or(0));
    table.row("kind", "T-spline".to_owned());
    table.row("control curves", format!("{}, of {least} to {most} control points", surface.curves().len()));
    table.row("control points", surface.coefficient_count().to_string());
}

fn d1rc_rows(d1rc: &D1rcSurface, table: &mut Table) {
    let space = d1rc.space();
    table.row("kind", "D1RC-spline".to_owned());
    table.row("degree", d1rc.degree().to_string());
    table.row("control points", space.vertex_count().to_string());
    table.row("faces", space.recipe().triangles.len().to_string());
    table.row("sharp edges", space.recipe().sharp_edges.len().to_string());
    table.row("functions", space.configurations().len().to_string());
}

fn pht_rows(surface: &PhtSurface, table: &mut Table) {
    let mesh = surface.mesh();
    let deepest = mesh.leaves().map(|leaf| mesh.cell(leaf).level).max().unwrap_or(0);
    table.row("kind", "PHT-spline".to_owned());
    table.row("continuous derivatives", surface.continuity().to_string());
    table.row("cells", format!("{} down to level {deepest}", mesh.leaf_count()));
    table.row("control points", surface.coefficient_count().to_string());
    table.row("weights", if surface.is_rational() { "yes" } else { "no" }.to_owned());
}
