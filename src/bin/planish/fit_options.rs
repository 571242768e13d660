//! What `planish fit` is asked for, and the options that this means to each family.

use crate::Failure;
use crate::input::{MeshInput, degrees, threads};
use crate::step::StepArguments;
use clap::{Args, ValueEnum};
use planish::export::native::{Saved, load_any_file};
use planish::fit::common::{Demands, Outliers, Plane, Regularize, Symmetry};
use planish::fit::d1rc::D1rcFitOptions;
use planish::fit::pht::{Coarsening, Continuity, PhtOptions};
use planish::fit::report::{Tolerance, ToleranceScale};
use planish::fit::tensor::{Ends, Knots, Method, Sides, TensorOptions};
use planish::mesh::Mesh;
use planish::parameterize::{Border, ParameterizeOptions};
use planish::surface::AnySurface;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct FitArguments {
    /// Mesh file: OFF, OBJ, PLY or STL.
    pub mesh: PathBuf,
    /// Family of the surface.
    #[arg(long, value_enum, default_value_t = FamilyName::Auto)]
    pub family: FamilyName,
    /// Patches of a model, about so many; a layout of its own for the shape.
    #[arg(long, value_name = "N")]
    pub patches: Option<usize>,
    /// Layout of the patches of a model.
    #[arg(long, value_enum, default_value_t = LayoutName::Auto)]
    pub layout: LayoutName,
    /// Largest error allowed at the nodes, as a fraction of the bounding box's diagonal.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: f64,
    /// Take the tolerance in model units.
    #[arg(long)]
    pub absolute: bool,
    /// Write a file: .step or .stp (the trimmed surface), .vtu or .glb (the mesh on the surface with its deviation), .obj,
    /// .off, .ply or .stl (a tessellation), .planish (the surface itself); may be given several times.
    #[arg(long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    #[command(flatten)]
    pub step: StepArguments,
    /// Write a picture of the surface coloured by deviation.
    #[arg(long, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// Write a report: a page with the mesh in the colours of its distances, numbers and worst places.
    #[arg(long, value_name = "HTML")]
    pub report: Option<PathBuf>,
    /// Border of the map for meshes without parameters.
    #[arg(long, value_enum, default_value_t = BorderName::Auto)]
    pub border: BorderName,
    /// Ignore parameters that the file has.
    #[arg(long)]
    pub ignore_parameters: bool,
    /// Most knots along one direction.
    #[arg(long, default_value_t = 257, value_name = "N")]
    pub max_grid: usize,
    /// Where the knot lines of a tensor surface stand.
    #[arg(long, value_enum, default_value_t = KnotsName::Adaptive)]
    pub knots: KnotsName,
    /// Continuous derivatives of a surface with cells: 1, or 2, which takes the fewest coefficients (pht).
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=2))]
    pub continuity: u32,
    /// Merge cells again as long as the tolerance is met, or not; auto does where the surface has two continuous
    /// derivatives (pht).
    #[arg(long, value_enum, default_value_t = CoarseningName::Auto)]
    pub coarsening: CoarseningName,
    /// Weight of the bending energy; 0 finds one for a tensor surface and takes the default of the other families.
    #[arg(long, default_value_t = 0.0, value_name = "MU", allow_negative_numbers = true)]
    pub smoothing: f64,
    /// Leave the ends of the knots free instead of straight.
    #[arg(long)]
    pub free_ends: bool,
    /// Use the equations of Dannenhoffer and Haimes instead of least squares.
    #[arg(long)]
    pub ferguson: bool,
    /// Edges whose triangles turn by more than this stay sharp (d1rc, model; 40 for a model if it is left out).
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_negative_numbers = true)]
    pub sharp_angle: Option<f64>,
    /// A number for each triangle, edges between different ones stay: a number of the faces of a PLY file by its name, or
    /// a text file with one a line (model).
    #[arg(long, value_name = "NAME")]
    pub labels: Option<String>,
    /// Labels are one where the triangles turn by no more than this along all edges between them (model; 0 if it is left
    /// out: all edges between labels stay).
    #[arg(long, value_name = "DEGREES", value_parser = degrees, requires = "labels", allow_negative_numbers = true)]
    pub label_angle: Option<f64>,
    /// Make patches of planes and cylinders too (model).
    #[arg(long)]
    pub no_exact: bool,
    /// Ignore sharp edges: smooth patches everywhere (model).
    #[arg(long)]
    pub smooth: bool,
    /// Vertices of the control mesh (d1rc); as many as the tolerance takes if it is left out.
    #[arg(long, value_name = "N")]
    pub control: Option<usize>,
    /// Sweeps of parameter correction on each grid, or in each round; the default depends on the family.
    #[arg(long, value_name = "N")]
    pub sweeps: Option<usize>,
    /// Nodes that the surface passes through (tensor, pht).
    #[arg(long, value_name = "NODE", value_delimiter = ',')]
    pub fixed: Vec<u32>,
    /// Field of the mesh file with a tolerance for each node; infinity leaves a node out (tensor, pht).
    #[arg(long, value_name = "FIELD")]
    pub tolerances: Option<String>,
    /// Field of the mesh file with a weight for each node (tensor, pht, d1rc).
    #[arg(long, value_name = "FIELD")]
    pub weights: Option<String>,
    /// Leave out at most this share of the nodes as gross errors (tensor, pht).
    #[arg(long, value_name = "SHARE", conflicts_with = "outlier_scale", allow_negative_numbers = true)]
    pub outlier_share: Option<f64>,
    /// Leave out nodes that miss the surface of the others by more than this, measured like the tolerance (tensor, pht).
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    pub outlier_scale: Option<f64>,
    /// Make the surface its own mirror image about a plane: `found`, or a place in it and a normal (tensor, pht).
    #[arg(long, value_name = "found|X,Y,Z,NX,NY,NZ", value_parser = symmetry, allow_hyphen_values = true)]
    pub symmetry: Option<Symmetry>,
    /// Take a side over from a saved curve, or from the nearest side of a saved surface with its tangent planes
    /// (tensor, pht): SIDE is u-low, u-high, v-low or v-high; may be given several times.
    #[arg(long, value_name = "SIDE=FILE", value_parser = side)]
    pub side: Vec<(usize, PathBuf)>,
    #[command(flatten)]
    pub input: MeshInput,
    /// Threads; 0 for all cores.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = threads)]
    pub threads: usize,
    /// Print the report as JSON.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum BorderName {
    /// The least stretched of the others.
    Auto,
    Circle,
    /// Square with its corners at the sharpest turns.
    Turns,
    /// Square with its corners at quarters of the length.
    Arc,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum FamilyName {
    /// A model for a closed mesh; for one with a boundary a tensor surface if it meets the tolerance, else what does better.
    Auto,
    /// Patches that meet smoothly, exact faces, sharp edges: a solid of a closed mesh of any shape, a shell of another.
    Model,
    /// One grid of knots: what every CAD system edits.
    Tensor,
    /// Cells as small as the shape asks, place by place.
    Pht,
    /// A triangular control mesh, which may have sharp edges.
    D1rc,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum LayoutName {
    /// The cube where there is one and it serves, else a base complex.
    Auto,
    /// The six faces of a cube: for meshes without handles.
    Cube,
    /// Patches that follow the shape.
    Complex,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum KnotsName {
    /// Where the error asks for them.
    Adaptive,
    /// At equal distances.
    Uniform,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum CoarseningName {
    Auto,
    On,
    Off,
}

pub(crate) fn tolerance(arguments: &FitArguments) -> Tolerance {
    let scale = if arguments.absolute { ToleranceScale::Absolute } else { ToleranceScale::Relative };
    Tolerance { value: arguments.tolerance, scale }
}

pub(crate) fn border(arguments: &FitArguments) -> Border {
    match arguments.border {
        BorderName::Auto => Border::Auto,
        BorderName::Circle => Border::Circle,
        BorderName::Turns => Border::SquareByTurns,
        BorderName::Arc => Border::SquareByArc,
    }
}

/// A plane of symmetry from its word or its numbers.
pub(crate) fn symmetry(text: &str) -> Result<Symmetry, String> {
    if text == "found" {
        return Ok(Symmetry::Found);
    }
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z, nx, ny, nz]) => {
            Ok(Symmetry::About(Plane { point: [x, y, z].into(), normal: [nx, ny, nz].into() }))
        }
        _ => Err("is neither found nor six numbers, say 0,0,0,1,0,0".to_owned()),
    }
}

/// A side and the file that it is taken from.
pub(crate) fn side(text: &str) -> Result<(usize, PathBuf), String> {
    let found = text.split_once('=').and_then(|(side, file)| {
        let number = ["u-low", "u-high", "v-low", "v-high"].iter().position(|name| *name == side)?;
        Some((number, PathBuf::from(file)))
    });
    found.ok_or_else(|| "is no side and file, say u-low=edge.planish".to_owned())
}

/// The curves and surfaces that sides are taken from.
pub(crate) fn saved_sides(arguments: &FitArguments) -> Result<Vec<(usize, Saved)>, Failure> {
    let load = |(side, path): &(usize, PathBuf)| match load_any_file(path)? {
        saved @ (Saved::Curve(_) | Saved::Surface(AnySurface::Tensor(_) | AnySurface::Pht(_))) => {
            Ok((*side, saved))
        }
        _ => Err(Failure::new(format!(
            "'{}' holds no curve, no tensor surface and no PHT-spline",
            path.display()
        ))),
    };
    arguments.side.iter().map(load).collect()
}

pub(crate) fn sides(saved: &[(usize, Saved)]) -> Sides<'_> {
    let mut sides = Sides::default();
    for (side, saved) in saved {
        match saved {
            Saved::Curve(curve) => sides.curves[*side] = Some(curve),
            Saved::Surface(AnySurface::Tensor(surface)) => sides.neighbours[*side] = Some(surface.into()),
            Saved::Surface(AnySurface::Pht(surface)) => sides.neighbours[*side] = Some(surface.into()),
            _ => {}
        }
    }
    sides
}

/// What single nodes demand.
pub(crate) fn demands<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> Demands<'a> {
    let outliers = match (arguments.outlier_share, arguments.outlier_scale) {
        (Some(share), _) => Outliers::Share(share),
        (_, Some(scale)) => Outliers::Scale(scale),
        _ => Outliers::None,
    };
    let symmetry = arguments.symmetry.unwrap_or_default();
    Demands { fixed: &arguments.fixed, tolerances: named(mesh, &arguments.tolerances), outliers, symmetry }
}

/// A field of the mesh that has been found to be there.
pub(crate) fn named<'a>(mesh: &'a Mesh, name: &Option<String>) -> Option<&'a [f64]> {
    name.as_deref().and_then(|name| mesh.field(name))
}

/// Fields that are asked for exist.
pub(crate) fn check_fields(arguments: &FitArguments, mesh: &Mesh) -> Result<(), Failure> {
    for name in arguments.tolerances.iter().chain(&arguments.weights) {
        if mesh.field(name).is_none() {
            let names: Vec<&str> = mesh.fields().iter().map(|field| field.name.as_str()).collect();
            let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            return Err(Failure::new(format!("the mesh has no field {name}; there are: {there}")));
        }
    }
    Ok(())
}

pub(crate) fn tensor_options<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> TensorOptions<'a> {
    TensorOptions {
        tolerance: tolerance(arguments),
        knots: match arguments.knots {
            KnotsName::Adaptive => Knots::Adaptive,
            KnotsName::Uniform => Knots::Uniform,
        },
        method: if arguments.ferguson { Method::Ferguson } else { Method::LeastSquares },
        ends: if arguments.free_ends { Ends::Free } else { Ends::Natural },
        smoothing: arguments.smoothing,
        max_grid: arguments.max_grid,
        max_coefficients: arguments.max_grid.saturating_mul(arguments.max_grid),
        correction_sweeps: arguments.sweeps.unwrap_or(0),
        regularize: Regularize::Auto,
        parameterize: ParameterizeOptions::TENSOR.with_border(border(arguments)),
        weights: named(mesh, &arguments.weights),
        demands: demands(arguments, mesh),
        ..TensorOptions::default()
    }
}

pub(crate) fn pht_options<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> PhtOptions<'a> {
    let defaults = PhtOptions::default();
    let is_asked = !matches!(arguments.border, BorderName::Auto);
    PhtOptions {
        tolerance: tolerance(arguments),
        continuity: if arguments.continuity == 2 { Continuity::C2 } else { Continuity::C1 },
        coarsening: match arguments.coarsening {
            CoarseningName::Auto => Coarsening::Auto,
            CoarseningName::On => Coarsening::On,
            CoarseningName::Off => Coarsening::Off,
        },
        smoothing: if arguments.smoothing == 0.0 { defaults.smoothing } else { arguments.smoothing },
        correction_sweeps: arguments.sweeps.unwrap_or(defaults.correction_sweeps),
        parameterize: is_asked.then(|| ParameterizeOptions::PHT.with_border(border(arguments))),
        weights: named(mesh, &arguments.weights),
        demands: demands(arguments, mesh),
        ..defaults
    }
}

pub(crate) fn d1rc_options<'a>(arguments: &FitArguments, mesh: &'a Mesh) -> D1rcFitOptions<'a> {
    let defaults = D1rcFitOptions::default();
    let is_asked = !matches!(arguments.border, BorderName::Auto);
    let map =
        if is_asked { defaults.parameterize.with_border(border(arguments)) } else { defaults.parameterize };
    D1rcFitOptions {
        tolerance: tolerance(arguments),
        smoothing: if arguments.smoothing == 0.0 { defaults.smoothing } else { arguments.smoothing },
        sharp_angle: arguments.sharp_angle.map(f64::to_radians),
        control_count: arguments.control.unwrap_or(defaults.control_count),
        correction_sweeps: arguments.sweeps.unwrap_or(defaults.correction_sweeps),
        parameterize: map,
        weights: named(mesh, &arguments.weights),
        ..defaults
    }
}
