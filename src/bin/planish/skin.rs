//! `planish skin`.

use crate::input::threads;
use crate::output::{self, Table};
use crate::rows::RowFile;
use crate::step::Step;
use crate::{Failure, Given, Outcome};
use clap::{Args, ValueEnum};
use planish::Control;
use planish::export::step::{StepOptions, Unit};
use planish::fit::conversion::ConversionOptions;
use planish::fit::report::{Remarks, Tolerance, ToleranceScale};
use planish::fit::skin::{Rows, SectionEnds, SkinFit, SkinMethod, SkinOptions, VRule, VSlopes, skin};
use planish::model::{Form, FormOptions};
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct SkinArguments {
    /// Text file: `rows N`, then for each row `row I COUNT` (and `closed`) and COUNT lines x y z; lines that begin with
    /// # are comments.
    rows: PathBuf,
    /// Largest error allowed at the points, as a fraction of the bounding box's diagonal.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    tolerance: f64,
    /// Take the tolerance in model units.
    #[arg(long)]
    absolute: bool,
    /// Write a file: .step or .stp, .obj (a tessellation), .planish (the surface itself); may be given several times.
    #[arg(long, value_name = "FILE")]
    out: Vec<PathBuf>,
    /// What STEP files hold, which know no T-splines.
    #[arg(long, value_enum, default_value_t = FormName::Tensor)]
    step_form: FormName,
    /// The last row is followed by the first one.
    #[arg(long)]
    closed_v: bool,
    /// Turn rows round, and move the first point of closed ones, where that brings them nearer to the row before.
    #[arg(long)]
    align: bool,
    /// Places between two points at which the surface is checked too.
    #[arg(long, default_value_t = 3, value_name = "N")]
    extra_checks: usize,
    /// Look for fewer knots across the rows than there are rows.
    #[arg(long)]
    approximate_v: bool,
    /// Steps across the rows by mean distances instead of those of the end points.
    #[arg(long)]
    mean_steps: bool,
    /// Run from row to row so that nothing can overshoot: for rows that are bunched, at the price of second derivatives.
    #[arg(long)]
    monotone: bool,
    /// Leave the ends of open rows straight instead of parabolic.
    #[arg(long)]
    natural_ends: bool,
    /// Insert many knots in each pass: faster, some more control points.
    #[arg(long)]
    batch: bool,
    /// Take knots out again that turn out not to be needed.
    #[arg(long)]
    removal: bool,
    /// Bound the distance from the skin through the section curves.
    #[arg(long)]
    certify: bool,
    /// Count the control points that common knots would need.
    #[arg(long)]
    compare: bool,
    /// Threads; 0 for all cores.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = threads)]
    threads: usize,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FormName {
    /// The same surface over the knots of all control curves.
    Tensor,
    /// The same surface as one face for each pair of rows.
    Strips,
    /// The classical skin over common knots.
    Common,
}

pub(crate) fn run(arguments: &SkinArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    let writes_step = output::writes_step(&arguments.out);
    given.refuse("step-form", writes_step, "is not used: no STEP file is written")?;
    let read = RowFile::read(&arguments.rows)?;
    let rows = Rows { points: &read.points, counts: &read.counts, dim: 3 };
    let options = options(arguments, read.is_closed);
    let fit = skin(&rows, &options, &mut Control::new(arguments.threads))?;
    // a STEP file over common knots is a skin of its own, with errors of its own
    let common = match arguments.step_form {
        FormName::Common => {
            let options = SkinOptions { method: SkinMethod::CommonKnots, ..options };
            Some(skin(&rows, &options, &mut Control::new(arguments.threads))?)
        }
        _ => None,
    };
    for path in &arguments.out {
        let written = common.as_ref().filter(|_| output::is_step(path)).unwrap_or(&fit);
        write(written, arguments, path)?;
    }
    if arguments.json {
        output::print(format_args!("{}\n", json_report(arguments, &rows, &fit, common.as_ref())))?;
    } else {
        output::print(table(arguments, &rows, &fit, common.as_ref()))?;
    }
    let misses = |fit: &SkinFit| fit.report.remarks.has(Remarks::TOLERANCE_NOT_MET);
    let is_met = !misses(&fit) && !common.as_ref().is_some_and(misses);
    Ok(if is_met { Outcome::Done } else { Outcome::ToleranceNotMet })
}

fn options(arguments: &SkinArguments, is_closed: bool) -> SkinOptions<'static> {
    let scale = if arguments.absolute { ToleranceScale::Absolute } else { ToleranceScale::Relative };
    SkinOptions {
        tolerance: Tolerance { value: arguments.tolerance, scale },
        closed: is_closed,
        closed_v: arguments.closed_v,
        ends: if arguments.natural_ends { SectionEnds::Natural } else { SectionEnds::Auto },
        v_rule: if arguments.mean_steps { VRule::Mean } else { VRule::Endpoints },
        v_slopes: if arguments.monotone { VSlopes::Monotone } else { VSlopes::Smooth },
        align: arguments.align,
        approximate_v: arguments.approximate_v,
        extra_checks: arguments.extra_checks,
        batch: arguments.batch,
        removal: arguments.removal,
        certify: arguments.certify,
        compare: arguments.compare,
        ..SkinOptions::default()
    }
}

fn write(fit: &SkinFit, arguments: &SkinArguments, path: &Path) -> Result<(), Failure> {
    let stem = arguments.rows.file_stem().unwrap_or_default().to_string_lossy();
    let form = if arguments.step_form == FormName::Strips { Form::Strips } else { Form::Tensor };
    let form = FormOptions { form, ..FormOptions::default() };
    let step = Step {
        text: StepOptions { unit: Unit::Millimetre, product: &stem, ..StepOptions::default() },
        conversion: ConversionOptions { form, ..ConversionOptions::default() },
        ..Step::default()
    };
    output::write_surface(&fit.surface.clone().into(), path, &step)
}

fn table(arguments: &SkinArguments, rows: &Rows, fit: &SkinFit, common: Option<&SkinFit>) -> String {
    let (report, skin) = (&fit.report, &fit.skin);
    let mut table = Table::default();
    let both = |error: f64| format!("{error:.3e}   {:.2e} of the diagonal", error / report.diagonal);
    table.row("rows", format!("{}", arguments.rows.display()));
    table.row("points", format!("{} in {} rows", rows.points.len() / 3, rows.counts.len()));
    let spread =
        format!("{} to {} in each of {} curves", skin.least_count, skin.largest_count, skin.curve_count);
    table.row("control points", format!("{}, {spread}", report.coefficient_count));
    let poles = format!("{} as a tensor surface, {} in strips", skin.tensor_count, skin.strip_count);
    table.row("for STEP", poles);
    if skin.common_count > 0 {
        table.row("common knots", format!("{} control points", skin.common_count));
    }
    table.row("tolerance", both(report.tolerance));
    table.row("max error", both(report.max_error));
    table.row("rms, mean error", format!("{:.3e}, {:.3e}", report.rms_error, report.mean_error));
    if let Some(SkinFit { report, .. }) = common {
        let count = report.coefficient_count;
        table
            .row("in the STEP file", format!("{count} control points, max error {}", both(report.max_error)));
    }
    if skin.certified_distance.is_finite() {
        table.row(
            "everywhere",
            format!("within {} of the skin through the curves", both(skin.certified_distance)),
        );
    }
    table.row("seconds", format!("{:.3}, {} passes", report.seconds, report.passes));
    let is_missed = report.remarks.has(Remarks::TOLERANCE_NOT_MET);
    table.row("result", if is_missed { "TOLERANCE NOT MET" } else { "tolerance met" }.to_owned());
    for remark in remarks(fit) {
        table.row("remark", remark);
    }
    for path in output::names(&arguments.out) {
        table.row("written", path);
    }
    table.to_string()
}

fn remarks(fit: &SkinFit) -> Vec<String> {
    let skin = &fit.skin;
    let twisted = skin.twisted_row.unwrap_or(0);
    [
        (Remarks::TOLERANCE_RAISED, "the tolerance was below rounding and has been raised".to_owned()),
        (Remarks::STAGNATED, "points are so near to one another that no knot fits between".to_owned()),
        (Remarks::MERGED_POINTS, format!("{} points lay on the one before them", skin.merged_point_count)),
        (Remarks::TWISTED_ROWS, format!("row {twisted} looks turned round or shifted: see --align")),
        (
            Remarks::CLUSTERED_ROWS,
            format!(
                "clustered rows: control curves overshoot {:.0} times, and the surface may bulge between rows: see \
                 --monotone",
                skin.overshoot
            ),
        ),
        (Remarks::MEAN_STEPS, "the end points of rows are too near to one another for steps".to_owned()),
    ]
    .into_iter()
    .filter(|(remark, _)| fit.report.remarks.has(*remark))
    .map(|(_, sentence)| sentence)
    .collect()
}

fn json_report(
    arguments: &SkinArguments,
    rows: &Rows,
    fit: &SkinFit,
    common: Option<&SkinFit>,
) -> serde_json::Value {
    let (report, skin) = (&fit.report, &fit.skin);
    json!({
        "points": rows.points.len() / 3,
        "rows": rows.counts.len(),
        "tolerance_met": !report.remarks.has(Remarks::TOLERANCE_NOT_MET),
        "tolerance": report.tolerance,
        "diagonal": report.diagonal,
        "max_error": report.max_error,
        "rms_error": report.rms_error,
        "mean_error": report.mean_error,
        "worst_point": report.worst_index,
        "coefficient_count": report.coefficient_count,
        "curve_count": skin.curve_count,
        "tensor_count": skin.tensor_count,
        "strip_count": skin.strip_count,
        "common_count": skin.common_count,
        "removed_knot_count": skin.removed_knot_count,
        "overshoot": skin.overshoot,
        "certified_distance": skin.certified_distance.is_finite().then_some(skin.certified_distance),
        "step_max_error": common.map(|common| common.report.max_error),
        "passes": report.passes,
        "seconds": report.seconds,
        "remarks": remarks(fit),
        "written": output::names(&arguments.out),
    })
}
