use super::*;
use crate::fit::report::{Tolerance, ToleranceScale};
use crate::samples::Random;
use crate::samples::rows::{RowSet, dustpan, head, screwdriver, wave};

impl RowSet {
    fn as_rows(&self) -> Rows<'_> {
        Rows { points: &self.points, counts: &self.counts, dim: 3 }
    }
}

/// The settings of the paper.
fn paper(tolerance: f64) -> SkinOptions<'static> {
    SkinOptions {
        tolerance: Tolerance { value: tolerance, scale: ToleranceScale::Relative },
        ends: SectionEnds::Parabolic,
        extra_checks: 0,
        ..SkinOptions::default()
    }
}

#[track_caller]
fn fit(set: &RowSet, options: &SkinOptions) -> SkinFit {
    skin(&set.as_rows(), options, &mut Control::new(2)).unwrap()
}

#[test]
fn the_four_sets_need_as_few_control_points_as_the_theory_says() {
    // name, set, tolerance, total at most, baseline at most
    for (name, set, tolerance, total, baseline) in [
        ("dustpan", dustpan(), 1e-5, 511, 988),
        ("wave", wave(), 5e-4, 663, 1015),
        ("screwdriver", screwdriver(), 1e-4, 544, 924),
        ("head", head(), 5e-4, 3410, 7854),
    ] {
        let options = SkinOptions { compare: true, ..paper(tolerance) };
        let fit = fit(&set, &options);
        let (found, common) = (fit.report.coefficient_count, fit.skin.common_count);
        println!(
            "{name}: {found} of {total}, common {common} of {baseline}, {:?} {:?}",
            fit.report, fit.skin
        );
        assert!(fit.report.max_error < fit.report.tolerance, "{name}: {:?}", fit.report);
        assert!(100 * found <= 101 * total, "{name}: {found} control points");
        assert!(100 * common <= 102 * baseline, "{name}: {common} with common knots");
        assert!(4 * found < 3 * common, "{name}");
    }
}
