//! `planish render`.

use crate::output::{self, write_png};
use crate::picture::{Picture, RenderOptions, View, render, render_mesh, render_model};
use crate::{Failure, Given, Outcome};
use clap::Args;
use planish::Control;
use planish::control::Pool;
use planish::export::native::{self, Saved};
use planish::mesh::{MeshOptions, read};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    /// Saved surface or model (.planish), or a mesh (OFF, OBJ, PLY, STL).
    file: PathBuf,
    /// The picture to write.
    #[arg(long, value_name = "PNG")]
    out: PathBuf,
    /// Colour the surface by its distance to the nodes of this mesh (OFF, OBJ, PLY, STL).
    #[arg(long, value_name = "MESH")]
    deviation: Option<PathBuf>,
    /// Draw the parameter plane instead of the surface.
    #[arg(long)]
    plane: bool,
    /// Draw the knot lines, the edges of a model, or those of a mesh's triangles.
    #[arg(long)]
    knots: bool,
    /// Draw the trims, free edges of a model, or the border of a mesh.
    #[arg(long)]
    trims: bool,
    /// Stripe the surface by equal brightness: they are as smooth as its tangent planes.
    #[arg(long, conflicts_with = "deviation", conflicts_with = "plane")]
    isophotes: bool,
    /// Draw combs of curvature on lines of the surface.
    #[arg(long, conflicts_with = "plane")]
    combs: bool,
    /// Draw the control net.
    #[arg(long)]
    net: bool,
    /// Pixels across and down.
    #[arg(long, default_value = "1200x900", value_name = "WxH")]
    size: String,
    /// Look from this direction, z upwards; the front of the shape if it is left out.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    from: Option<String>,
}

pub(crate) fn run(arguments: &RenderArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_name(&arguments.out, output::PICTURES)?;
    let mesh = match &arguments.deviation {
        Some(path) => Some(read(path, &MeshOptions::default())?.0),
        None => None,
    };
    let (width, height) = size(&arguments.size)?;
    let options = RenderOptions {
        width,
        height,
        view: arguments.from.as_deref().map(view).transpose()?,
        deviation_from: mesh.as_ref(),
        plane: arguments.plane,
        knot_lines: arguments.knots,
        trims: arguments.trims,
        isophotes: arguments.isophotes,
        combs: arguments.combs,
        control_net: arguments.net,
    };
    let control = Control::default();
    let picture = match output::is_saved(&arguments.file) {
        true => of_saved(&arguments.file, &options, given, control.pool())?,
        false => of_mesh(&arguments.file, &options, given)?,
    };
    write_png(&picture, &arguments.out)?;
    output::print(format_args!("written  {}\n", arguments.out.display()))?;
    Ok(Outcome::Done)
}

fn of_saved(path: &Path, options: &RenderOptions, given: &Given, pool: &Pool) -> Result<Picture, Failure> {
    match native::load_any_file(path)? {
        Saved::Surface(surface) => {
            given.refuse("net", !options.plane, "is not used with --plane: a control net lies in space")?;
            Ok(render(surface.as_surface(), options, pool)?)
        }
        Saved::Model(model) => {
            for option in ["net", "plane", "isophotes", "combs"] {
                given.refuse(option, false, "is not used for a model: it is drawn of one surface")?;
            }
            Ok(render_model(&model, options, pool)?)
        }
        Saved::Curve(_) => Err(Failure::new("a curve cannot be drawn, only surfaces, models and meshes")),
    }
}

fn of_mesh(path: &Path, options: &RenderOptions, given: &Given) -> Result<Picture, Failure> {
    for option in ["deviation", "net", "plane", "isophotes", "combs"] {
        given.refuse(option, false, "is not used for a mesh: it is drawn of what was fitted")?;
    }
    Ok(render_mesh(&read(path, &MeshOptions::default())?.0, options))
}

fn size(text: &str) -> Result<(usize, usize), Failure> {
    // a picture of more pixels would not fit into the memory of most machines
    const RANGE: std::ops::RangeInclusive<usize> = 64..=16384;
    let sizes =
        text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    sizes.filter(|(width, height)| RANGE.contains(width) && RANGE.contains(height)).ok_or_else(|| {
        Failure::new(format!(
            "{text} is no size, say 1200x900 with sides from {} to {}",
            RANGE.start(),
            RANGE.end()
        ))
    })
}

fn view(text: &str) -> Result<View, Failure> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() && (x, y, z) != (0.0, 0.0, 0.0) => {
            Ok(View::from([x, y, z]))
        }
        _ => Err(Failure::new(format!("{text} is no direction, say 1,-1,0.5"))),
    }
}
