//! `planish sample`.

use crate::{Failure, Given, Outcome, output};
use clap::{Args, ValueEnum};
use planish::export::mesh::{self as mesh_files, Encoding};
use planish::samples::{self, Strips, machine, rows::RowSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct SampleArguments {
    /// Which shape.
    #[arg(value_enum)]
    shape: Shape,
    /// Where to write it: .obj, .off, .ply or .stl for a mesh, .ply with labels, .txt for rows.
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
    /// A warped sheet with two narrow ridges and twelve bumps.
    RidgedSheet,
    /// A wavy sheet with noise: for `planish fair`.
    NoisySheet,
    /// A plane control mesh with one node raised: a blending function of `planish d1rc`.
    Hat,
    /// A control mesh with a sharp ridge.
    Roof,
    /// A round bar.
    Cylinder,
    /// A block with a round hole.
    BoxWithHole,
    /// An L of plates with a hole.
    AngleBracket,
    /// A round plate with a bore and six holes.
    Flange,
    /// A shaft of three diameters with a bore.
    SteppedShaft,
    /// A wheel of twelve straight teeth.
    Gear,
    /// A plate with round ends and a slot.
    SlottedPlate,
    /// A rocker arm: closed and smooth, with a hole through its hub.
    Rocker,
    /// A closed wing whose skins are 40 strips, with labels: `label` of the faces of a PLY file.
    WingStrips,
    /// Rows of points round a dustpan.
    DustpanRows,
    /// Rows of points along waves of unlike length.
    WaveRows,
    /// Rows of points round a head, closed.
    HeadRows,
    /// Closed rows of points on the wavy sheet, its border and a hole: for `planish trim`.
    SheetLoops,
}

impl Shape {
    /// Whether its nodes are jittered.
    fn is_jittered(self) -> bool {
        !matches!(
            self,
            Self::HalfFuselage
                | Self::Wing
                | Self::DustpanRows
                | Self::WaveRows
                | Self::HeadRows
                | Self::SheetLoops
        )
    }
}

/// Nodes of machine parts, about.
const PART_NODES: usize = 3000;
/// Nodes of smooth solids, about.
const SOLID_NODES: usize = 6000;

pub(crate) fn run(arguments: &SampleArguments, given: &Given) -> Result<Outcome, Failure> {
    given.refuse("seed", arguments.shape.is_jittered(), "is not used: this shape has no jitter")?;
    let seed = arguments.seed;
    let mesh = match arguments.shape {
        Shape::FuselagePanel => samples::fuselage_panel(seed),
        Shape::HalfFuselage => samples::half_fuselage(),
        Shape::Wing => samples::wing(),
        Shape::Sphere => samples::sphere_with_holes(5000, seed),
        Shape::CurvedNotch => samples::curved_notch(seed),
        Shape::Planar => samples::planar(seed),
        Shape::RidgedSheet => samples::ridged_sheet(seed),
        Shape::NoisySheet => samples::noisy_sheet(seed),
        Shape::Hat => samples::hat(seed),
        Shape::Roof => samples::roof(seed),
        Shape::Cylinder => machine::cylinder(PART_NODES, seed).map(|part| part.mesh),
        Shape::BoxWithHole => machine::box_with_hole(PART_NODES, seed).map(|part| part.mesh),
        Shape::AngleBracket => machine::angle_bracket(PART_NODES, seed).map(|part| part.mesh),
        Shape::Flange => machine::flange(PART_NODES, seed).map(|part| part.mesh),
        Shape::SteppedShaft => machine::stepped_shaft(PART_NODES, seed).map(|part| part.mesh),
        Shape::Gear => machine::gear(PART_NODES, seed).map(|part| part.mesh),
        Shape::SlottedPlate => machine::slotted_plate(PART_NODES, seed).map(|part| part.mesh),
        Shape::Rocker => samples::rocker(SOLID_NODES, seed),
        Shape::WingStrips => return write_strips(&samples::wing_strips(seed)?, &arguments.out),
        Shape::DustpanRows => return write_rows(&samples::rows::dustpan(), false, &arguments.out),
        Shape::WaveRows => return write_rows(&samples::rows::wave(), false, &arguments.out),
        Shape::HeadRows => return write_rows(&samples::rows::head(), true, &arguments.out),
        Shape::SheetLoops => return write_rows(&samples::rows::sheet_loops(), true, &arguments.out),
    }?;
    output::write_mesh(&mesh, &arguments.out)?;
    done(&arguments.out)
}

fn done(path: &Path) -> Result<Outcome, Failure> {
    output::print(format_args!("written  {}\n", path.display()))?;
    Ok(Outcome::Done)
}

/// Writes a mesh with labels, in the one format that has them.
fn write_strips(strips: &Strips, path: &Path) -> Result<Outcome, Failure> {
    output::check_name(path, &["ply"])?;
    mesh_files::write_labelled(&strips.mesh, &strips.labels, path, Encoding::Binary)?;
    done(path)
}

/// Writes rows for `planish skin` and `planish trim`; the first point of a closed row, which the samples repeat, stands there once.
fn write_rows(rows: &RowSet, is_closed: bool, path: &Path) -> Result<Outcome, Failure> {
    let mut text = format!("rows {}\n", rows.counts.len());
    for index in 0..rows.counts.len() {
        let count = rows.counts[index] - usize::from(is_closed);
        let flag = if is_closed { " closed" } else { "" };
        // writing into a string cannot fail
        let _ = writeln!(text, "row {index} {count}{flag}");
        for point in rows.row(index).chunks_exact(3).take(count) {
            let _ = writeln!(text, "{} {} {}", point[0], point[1], point[2]);
        }
    }
    output::check_name(path, &["txt"])?;
    output::write_text(&text, path)?;
    done(path)
}
