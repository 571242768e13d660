//! `planish sample`.

use crate::{Failure, Outcome};
use clap::{Args, ValueEnum};
use planish::export::obj;
use planish::samples;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct SampleArguments {
    /// Which shape.
    #[arg(value_enum)]
    shape: Shape,
    /// Where to write it (.obj).
    out: PathBuf,
    /// Seed of the jitter.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Shape {
    /// A fuselage panel with a notch and three windows, without parameters.
    FuselagePanel,
    /// Half a fuselage with parameters whose slope is infinite at both sides.
    HalfFuselage,
    /// The upper side of a wing with a cut-out.
    Wing,
    /// A cap of a sphere with three holes.
    Sphere,
    /// A smooth graph with a notch and two holes.
    CurvedNotch,
    /// A plane with a notch and two holes.
    Planar,
}

pub fn run(arguments: &SampleArguments) -> Result<Outcome, Failure> {
    let seed = arguments.seed;
    let mesh = match arguments.shape {
        Shape::FuselagePanel => samples::fuselage_panel(seed),
        Shape::HalfFuselage => samples::half_fuselage(),
        Shape::Wing => samples::wing(),
        Shape::Sphere => samples::sphere_with_holes(5000, seed),
        Shape::CurvedNotch => samples::curved_notch(seed),
        Shape::Planar => samples::planar(seed),
    }?;
    obj::write(&mesh, &arguments.out)?;
    Ok(Outcome::Done)
}
