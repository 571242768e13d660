//! `planish render`.

use crate::output::{self, write_png};
use crate::picture::View;
use crate::picture::{RenderOptions, render, render_model};
use crate::{Failure, Given, Outcome};
use clap::Args;
use planish::Control;
use planish::export::native::{self, Saved};
use planish::mesh::{MeshOptions, read};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    /// Saved surface or model (.planish).
    surface: PathBuf,
    /// The picture to write.
    #[arg(long, value_name = "PNG")]
    out: PathBuf,
    /// Colour the surface by its distance to the nodes of this mesh (OFF, OBJ, PLY, STL).
    #[arg(long, value_name = "MESH")]
    deviation: Option<PathBuf>,
    /// Draw the parameter plane instead of the surface.
    #[arg(long)]
    plane: bool,
    /// Draw the knot lines, or the edges of a model.
    #[arg(long)]
    knots: bool,
    /// Draw the trims.
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
    let saved = native::load_any_file(&arguments.surface)?;
    let is_model = matches!(saved, Saved::Model(_));
    given.refuse("net", !is_model, "is not used for a model: it has no control net of its own")?;
    given.refuse("net", !arguments.plane, "is not used with --plane: a control net lies in space")?;
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
    if matches!(saved, Saved::Model(_)) && (options.isophotes || options.combs) {
        return Err(Failure::new("isophotes and combs are drawn of surfaces: a model has none"));
    }
    let control = Control::default();
    let picture = match &saved {
        Saved::Surface(surface) => render(surface.as_surface(), &options, control.pool())?,
        Saved::Model(_) if options.plane => {
            return Err(Failure::new("a model has no parameter plane: leave out --plane"));
        }
        Saved::Model(model) => render_model(model, &options, control.pool())?,
        Saved::Curve(_) => return Err(Failure::new("a curve cannot be drawn, only surfaces and models")),
    };
    write_png(&picture, &arguments.out)?;
    output::print(format_args!("written  {}\n", arguments.out.display()))?;
    Ok(Outcome::Done)
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
