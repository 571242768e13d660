//! `planish trim`.

use crate::bar::with_bar;
use crate::input::threads;
use crate::output::{self, Table};
use crate::rows::RowFile;
use crate::step::StepArguments;
use crate::{Failure, Given, Outcome};
use clap::Args;
use glam::DVec3;
use planish::curve::{Curve, CurveError, EndRule, interpolate};
use planish::export::native;
use planish::fit::report::{Tolerance, ToleranceScale};
use planish::fit::trim::{CurveTrimOptions, CurveTrimReport, trim_by_curves};
use planish::query::project::Projector;
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct TrimArguments {
    /// Saved surface (.planish).
    surface: PathBuf,
    /// Closed curves, each one trim: a saved curve (.planish), or a text file of closed rows as for planish skin, each one
    /// curve through its points. May be given several times; the outer trim comes first, unless they are added.
    #[arg(long = "loop", required = true, value_name = "FILE")]
    loops: Vec<PathBuf>,
    /// How far the trims may lie from the curves, and the curves from the surface, as a fraction of the diagonal of the
    /// curves' box.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    tolerance: f64,
    /// Take the tolerance in model units.
    #[arg(long)]
    absolute: bool,
    /// Add the trims to those that the surface has, in which they cut holes, instead of replacing them.
    #[arg(long)]
    add: bool,
    /// Write a file: .planish, .step or .stp, .vtu, or a tessellation as .obj; may be given several times.
    #[arg(long, value_name = "FILE")]
    out: Vec<PathBuf>,
    #[command(flatten)]
    step: StepArguments,
    /// Threads; 0 for all cores.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = threads)]
    threads: usize,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &TrimArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    StepArguments::check_used(given, output::writes_step(&arguments.out))?;
    let mut surface = native::load_file(&arguments.surface)?;
    let mut curves = Vec::new();
    for path in &arguments.loops {
        curves.extend(read_curves(path)?);
    }
    let loops: Vec<Vec<&Curve>> = curves.iter().map(|curve| vec![curve]).collect();
    let scale = if arguments.absolute { ToleranceScale::Absolute } else { ToleranceScale::Relative };
    let options =
        CurveTrimOptions { tolerance: Tolerance { value: arguments.tolerance, scale }, adds: arguments.add };
    let projector = Projector::new(surface.as_surface())?;
    let found = with_bar(arguments.threads, |control| {
        trim_by_curves(surface.as_surface(), &projector, &loops, &options, control)
    })?;
    surface.as_surface_mut().region_mut().trims = found.trims;
    let stem = arguments.surface.file_stem().unwrap_or_default().to_string_lossy();
    let step = arguments.step.step(&surface.as_surface().region().label, &stem);
    for path in &arguments.out {
        output::write_surface(&surface, path, &step)?;
    }
    if arguments.json {
        output::print(format_args!("{}\n", json_report(arguments, loops.len(), &found.report)))?;
    } else {
        output::print(table(arguments, loops.len(), &found.report))?;
    }
    Ok(Outcome::Done)
}

/// The closed curves that a file holds.
fn read_curves(path: &Path) -> Result<Vec<Curve>, Failure> {
    if output::is_saved(path) {
        return Ok(vec![native::load_curve_file(path)?]);
    }
    curves_of(&RowFile::read(path)?)
        .map_err(|Failure(sentence)| Failure::new(format!("{}: {sentence}", path.display())))
}

fn curves_of(file: &RowFile) -> Result<Vec<Curve>, Failure> {
    let closed = |(row, points): (usize, &[f64])| {
        if !file.is_closed {
            let count = points.len() / 3;
            return Err(Failure::new(format!("row {row} is open, a loop is 'row {row} {count} closed'")));
        }
        closed_curve(points).map_err(|error| Failure::new(format!("row {row}: {error}")))
    };
    file.rows().enumerate().map(closed).collect()
}

/// The closed curve through the points of a row, at the lengths of its chords; its first point may be repeated at its end.
fn closed_curve(row: &[f64]) -> Result<Curve, CurveError> {
    let mut points: Vec<DVec3> = row.chunks_exact(3).map(DVec3::from_slice).collect();
    if points.last() != points.first() {
        points.push(points[0]);
    }
    points.dedup();
    let mut length = 0.0;
    let parameter = |(point, before): (&DVec3, &DVec3)| {
        length += point.distance(*before);
        length
    };
    let first = points.iter().take(1);
    let parameters: Vec<f64> = points.iter().zip(first.chain(&points)).map(parameter).collect();
    let flat: Vec<f64> = points.iter().flat_map(DVec3::to_array).collect();
    interpolate(3, &parameters, &flat, EndRule::Periodic)
}

fn table(arguments: &TrimArguments, loop_count: usize, report: &CurveTrimReport) -> Table {
    let both = |length: f64| format!("{length:.3e}   {:.2e} of the diagonal", length / report.diagonal);
    let mut table = Table::default();
    table.row("surface", format!("{}", arguments.surface.display()));
    table.row("trims", format!("{loop_count} with {} places", report.vertex_count));
    table.row("tolerance", both(report.tolerance));
    table.row("at places", both(report.max_vertex_distance));
    table.row("between them", both(report.max_distance_between));
    let rms = format!("{:.3e}, {:.3e}", report.rms_vertex_distance, report.rms_distance_between);
    table.row("rms of both", rms);
    table.row("farthest from", format!("curve {} at {}", report.worst_curve, report.worst_parameter));
    table.row("seconds", format!("{:.2}", report.seconds));
    if let Some(remark) = remark(report) {
        table.row("remark", remark);
    }
    for path in output::names(&arguments.out) {
        table.row("written", path);
    }
    table
}

fn remark(report: &CurveTrimReport) -> Option<String> {
    let count = report.unproven_count;
    (count > 0).then(|| format!("{count} places are not proved to be nearest to the curves"))
}

fn json_report(arguments: &TrimArguments, loop_count: usize, report: &CurveTrimReport) -> serde_json::Value {
    json!({
        "loops": loop_count,
        "places": report.vertex_count,
        "tolerance": report.tolerance,
        "diagonal": report.diagonal,
        "max_error": report.max_vertex_distance.max(report.max_distance_between),
        "max_vertex_distance": report.max_vertex_distance,
        "rms_vertex_distance": report.rms_vertex_distance,
        "max_distance_between": report.max_distance_between,
        "rms_distance_between": report.rms_distance_between,
        "worst_curve": report.worst_curve,
        "worst_parameter": report.worst_parameter,
        "unproven_count": report.unproven_count,
        "seconds": report.seconds,
        "remarks": remark(report).as_slice(),
        "written": output::names(&arguments.out),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(counts: &[usize], is_closed: bool, points: &[f64]) -> RowFile {
        RowFile { points: points.to_vec(), counts: counts.to_vec(), is_closed }
    }

    /// A square, and the same with its first point again at its end and one given twice.
    const SQUARE: [f64; 12] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    const REPEATED: [f64; 18] = [0., 0., 0., 1., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 0., 0., 0.];

    #[test]
    fn each_closed_row_is_a_curve_through_its_points() {
        let file = rows(&[4, 6], true, &[&SQUARE[..], &REPEATED].concat());
        let curves = curves_of(&file).map_err(|Failure(sentence)| sentence).unwrap();
        assert_eq!(curves.len(), 2);
        assert_eq!(curves[0], curves[1]);
        // the sides are 1 long, and so are the steps of the parameter; sums of a few products of numbers below 4
        for k in 0..=4 {
            let at = DVec3::from_slice(&curves[0].eval(k as f64));
            let point = DVec3::from_slice(&SQUARE[3 * (k % 4)..]);
            assert!(at.distance(point) <= 16.0 * f64::EPSILON, "{at} at {k}");
        }
    }

    #[test]
    fn rows_that_are_no_loops_are_refused_by_name() {
        for (file, words) in [
            (rows(&[4], false, &SQUARE), "row 0 is open, a loop is 'row 0 4 closed'"),
            (rows(&[4, 0], true, &SQUARE), "row 1: "),
            (rows(&[1], true, &[1.0; 3]), "row 0: "),
            (rows(&[2], true, &[1.0; 6]), "row 0: "),
        ] {
            let Failure(sentence) = curves_of(&file).unwrap_err();
            assert!(sentence.starts_with(words), "{sentence}");
        }
    }
}
