//! Tensor fits: the tables of the method, and what every fit promises.

mod common;

use glam::{DVec2, DVec3};
use planish::Control;
use planish::fit::common::{FitError, Regularize};
use planish::fit::report::{FitReport, Remarks, StopReason, Tolerance, ToleranceScale};
use planish::fit::tensor::{Ends, Knots, Method, TensorFit, TensorOptions, fit_field, fit_mesh, fit_points};
use planish::mesh::Mesh;
use planish::parameterize::{Border, ParameterizeOptions};
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::samples::{self, Random};
use planish::surface::Surface;

fn fit(mesh: &Mesh, options: &TensorOptions) -> TensorFit {
    fit_mesh(mesh, options, &mut Control::new(2)).unwrap()
}

fn largest_side(mesh: &Mesh) -> f64 {
    mesh.bounds().sides().fold(0.0, f64::max)
}

/// A tolerance of 1e-4 of the largest side, and grids of at most 5,000 knots, as in the table.
fn as_in_the_table(mesh: &Mesh) -> TensorOptions<'static> {
    TensorOptions {
        tolerance: Tolerance { value: 1e-4 * largest_side(mesh), scale: ToleranceScale::Absolute },
        knots: Knots::Uniform,
        max_coefficients: 5000,
        max_grid: 1025,
        ..TensorOptions::default()
    }
}

const TRUE: (Method, f64) = (Method::LeastSquares, 1e-6);
const TRUE_SMOOTH: (Method, f64) = (Method::LeastSquares, 1e-3);
const PSEUDO: (Method, f64) = (Method::Ferguson, 1e-3);

/// Doublings between two numbers of knots.
fn doublings(count: usize, expected: usize) -> i32 {
    ((count - 1) as f64 / (expected - 1) as f64).log2().round().abs() as i32
}

/// A shape, whether to regularize, and for each method the grid of the table, or the error (as a share of the
/// largest side) of a fit that fails.
enum Row {
    Grid([usize; 2]),
    Fails(f64),
}

#[test]
fn grids_are_those_of_the_table_within_a_doubling() {
    use Row::{Fails, Grid};
    let table = [
        (
            "curved",
            samples::curved_notch(2),
            Regularize::Never,
            [Grid([17, 9]), Grid([17, 9]), Grid([17, 9])],
        ),
        (
            "sphere",
            samples::sphere_with_holes(5000, 5),
            Regularize::Never,
            [Grid([17, 17]), Grid([17, 17]), Grid([33, 33])],
        ),
        (
            "fuselage, v = y",
            samples::half_fuselage(),
            Regularize::Never,
            [Fails(2.7e-3), Fails(3.0e-3), Fails(4.1e-3)],
        ),
        (
            "fuselage, sliding",
            samples::half_fuselage(),
            Regularize::Auto,
            [Grid([17, 9]), Grid([17, 17]), Grid([9, 33])],
        ),
        (
            "wing, u = chord",
            samples::wing(),
            Regularize::Never,
            [Grid([513, 5]), Fails(1.9e-4), Fails(4.2e-4)],
        ),
        (
            "wing, sliding",
            samples::wing(),
            Regularize::Auto,
            [Grid([33, 17]), Grid([65, 17]), Grid([129, 17])],
        ),
    ];
    for (name, mesh, regularize, rows) in table {
        let mesh = mesh.unwrap();
        for ((method, smoothing), row) in [TRUE, TRUE_SMOOTH, PSEUDO].into_iter().zip(rows) {
            let options = TensorOptions { method, smoothing, regularize, ..as_in_the_table(&mesh) };
            let report = fit(&mesh, &options).report;
            let grid = [report.grid_u, report.grid_v];
            let what = format!("{name}, {method:?} {smoothing:e}: {grid:?}, error {:e}", report.max_error);
            match row {
                Grid(expected) => {
                    assert!(report.max_error <= report.tolerance, "{what}");
                    let off: i32 = (0..2).map(|k| doublings(grid[k], expected[k])).sum();
                    assert!(off <= 1, "{what}, the table has {expected:?}");
                }
                Fails(error) => {
                    assert!(report.remarks.has(Remarks::TOLERANCE_NOT_MET), "{what}");
                    assert_eq!(report.stop, StopReason::Limit, "{what}");
                    assert!(
                        report.max_error < 1.2 * error * largest_side(&mesh),
                        "{what}, the table has {error:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_plane_is_one_bilinear_cell() {
    let mesh = samples::planar(1).unwrap();
    for (method, smoothing) in [TRUE, TRUE_SMOOTH, PSEUDO] {
        let report = fit(&mesh, &TensorOptions { method, smoothing, ..as_in_the_table(&mesh) }).report;
        assert_eq!([report.grid_u, report.grid_v], [2, 2]);
        // 5,000 rows on numbers of size 8, in equations of condition 10
        assert!(report.max_error < 2e-13, "{:e}", report.max_error);
    }
}

#[test]
fn errors_on_the_sphere_fall_as_in_the_table() {
    let mesh = samples::sphere_with_holes(5000, 5).unwrap();
    let error = |(method, smoothing), count| {
        let fixed_grid = Some([count, count]);
        fit(&mesh, &TensorOptions { method, smoothing, fixed_grid, ..TensorOptions::default() })
            .report
            .max_error
    };
    for (count, exact, pseudo) in
        [(9, 1.1e-3, 1.1e-3), (17, 4.8e-5, 2.6e-4), (33, 2.8e-6, 6.2e-5), (65, 3.5e-7, 1.9e-5)]
    {
        // other jitter than the table's: its digits are not ours, its sizes are
        let (ours, theirs) = (error(TRUE, count), error(PSEUDO, count));
        assert!((0.5..2.0).contains(&(ours / exact)), "{count}: {ours:e}, the table has {exact:e}");
        assert!((0.5..2.0).contains(&(theirs / pseudo)), "{count}: {theirs:e}, the table has {pseudo:e}");
    }
}

#[test]
fn what_was_asked_for_is_kept_or_the_report_says_so() {
    let mut held_out = Vec::new();
    for seed in 0..40 {
        let (mesh, height) = samples::bumps([40, 30], 3, seed).unwrap();
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5] {
            let options = TensorOptions {
                tolerance: Tolerance { value: tolerance, ..Tolerance::default() },
                max_grid: 65,
                ..TensorOptions::default()
            };
            let result = fit(&mesh, &options);
            let report = &result.report;
            let is_met = report.max_error <= tolerance * report.diagonal;
            assert_eq!(is_met, !report.remarks.has(Remarks::TOLERANCE_NOT_MET), "seed {seed}");
            let is_limit = [StopReason::Limit, StopReason::DataExhausted].contains(&report.stop);
            assert!(is_met || is_limit, "seed {seed} at {tolerance:e}: {report:?}");
            assert!(is_met || tolerance <= 1e-4, "seed {seed} misses {tolerance:e}: {:e}", report.max_error);
            assert!(
                report.coefficient_count <= mesh.points().len(),
                "seed {seed} at {tolerance:e}: {report:?}"
            );
            held_out.push(held_out_error(&result, &height, seed) / report.max_error.max(1e-9));
        }
    }
    held_out.sort_by(f64::total_cmp);
    let (median, last) = (held_out[held_out.len() / 2], held_out[held_out.len() - 1]);
    println!(
        "error at ten times as many exact points, as a multiple of max_error: {median:.2}, at most {last:.2}"
    );
    // nodes sample smooth bumps well: between them the error is of the same size
    assert!(median < 2.0, "{median}");
}

/// The largest error at ten times as many exact points as there are nodes.
fn held_out_error(fit: &TensorFit, height: &impl Fn(DVec2) -> f64, seed: u64) -> f64 {
    let mut random = Random::new(seed + 1000);
    let places: Vec<DVec2> =
        (0..10 * fit.parameters.len()).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    let mut rows = vec![0.0; 3 * places.len()];
    fit.surface.eval_rows(&places, 0, &mut rows);
    let error = |(p, row): (&DVec2, &[f64])| p.extend(height(*p)).distance(DVec3::from_slice(row));
    places.iter().zip(rows.chunks_exact(3)).map(error).fold(0.0, f64::max)
}

#[test]
fn nodes_in_the_corner_of_an_empty_border_do_no_harm() {
    // 240 scattered nodes: some outer rows of cells hold next to nothing
    let mut random = Random::new(7);
    let uv: Vec<DVec2> = (0..240).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    let values: Vec<f64> = uv.iter().map(|p| (3.0 * p.x).sin() * (2.0 * p.y).cos()).collect();
    let options = |method, smoothing| TensorOptions {
        method,
        smoothing,
        fixed_grid: Some([17, 9]),
        ..TensorOptions::default()
    };
    for (method, smoothing, most) in [
        (Method::Ferguson, 1e-3, 5e-3),
        (Method::LeastSquares, 1e-3, 2e-3),
        (Method::LeastSquares, 1e-6, 1e-4),
    ] {
        let result = fit_points(&uv, &values, 1, &options(method, smoothing), &mut Control::new(1)).unwrap();
        let error = result.report.max_error;
        assert!(error < most, "{method:?} {smoothing:e}: {error:e}");
    }
}

#[test]
fn few_data_or_data_on_a_line_are_told_apart() {
    let options = TensorOptions::default();
    let mut control = Control::new(1);
    let mut fit = |uv: &[(f64, f64)]| {
        let uv: Vec<DVec2> = uv.iter().map(|&(u, v)| DVec2::new(u, v)).collect();
        let values: Vec<f64> = uv.iter().map(|p| p.x + 2.0 * p.y).collect();
        fit_points(&uv, &values, 1, &options, &mut control)
    };
    // the beam energy leaves a + bu + cv + duv free, which three data do not fix
    let result = fit(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]).unwrap();
    assert!(result.report.remarks.has(Remarks::PLATE_ENERGY_USED));
    assert!(result.report.max_error < 1e-12);
    assert_eq!(fit(&[(0.0, 0.0), (1.0, 1.0)]).unwrap_err(), FitError::TooFew { count: 2 });
    let line: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), f64::from(k))).collect();
    assert_eq!(fit(&line).unwrap_err(), FitError::Singular);
    let row: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), 3.0)).collect();
    assert_eq!(fit(&row).unwrap_err(), FitError::DegenerateRange { axis: 'v', at: 3.0 });
}

#[test]
fn ten_copies_of_each_node_with_ten_times_the_smoothing_change_nothing() {
    let (mesh, _) = samples::bumps([20, 20], 3, 5).unwrap();
    let uv = mesh.parameters().unwrap();
    let values: Vec<f64> = mesh.points().iter().map(|p| p.z).collect();
    let options =
        |smoothing| TensorOptions { smoothing, fixed_grid: Some([9, 9]), ..TensorOptions::default() };
    let once = fit_points(uv, &values, 1, &options(1e-4), &mut Control::new(1)).unwrap();
    let copied =
        fit_points(&uv.repeat(10), &values.repeat(10), 1, &options(1e-3), &mut Control::new(1)).unwrap();
    let weights = vec![10.0; uv.len()];
    let weighted = TensorOptions { weights: Some(&weights), ..options(1e-3) };
    let weighted = fit_points(uv, &values, 1, &weighted, &mut Control::new(1)).unwrap();
    for other in [copied, weighted] {
        for (a, b) in once.surface.control_points().iter().zip(other.surface.control_points()) {
            // the systems differ by rounding, of condition 1e5
            assert!((a - b).abs() < 1e-9, "{a} is not {b}");
        }
    }
}

#[test]
fn a_field_is_fitted_over_the_parameters_of_its_mesh() {
    let mesh = samples::curved_notch(2).unwrap();
    let field: Vec<f64> =
        mesh.parameters().unwrap().iter().flat_map(|p| [(0.4 * p.x).sin(), 300.0 + p.y * p.x]).collect();
    let result = fit_field(&mesh, &field, 2, &TensorOptions::default(), &mut Control::new(1)).unwrap();
    assert_eq!(result.surface.dim(), 2);
    assert!(result.report.max_error <= 1e-3 * result.report.diagonal);
    assert_eq!(result.surface.region().trims.loops().len(), 3);
}

#[test]
fn free_ends_and_parameter_correction_need_no_more_coefficients() {
    let mesh = samples::curved_notch(2).unwrap();
    let plain = fit(&mesh, &as_in_the_table(&mesh)).report;
    let free = TensorOptions { ends: Ends::Free, buffer: 0.0, ..as_in_the_table(&mesh) };
    let free = fit(&mesh, &free).report;
    assert!(free.max_error <= free.tolerance);
    assert!((free.grid_u, free.grid_v) <= (plain.grid_u, plain.grid_v));
    let swept = fit(&mesh, &TensorOptions { correction_sweeps: 3, ..as_in_the_table(&mesh) }).report;
    assert!(swept.max_error <= swept.tolerance && swept.coefficient_count <= plain.coefficient_count);
    assert_eq!(swept.flipped_count, 0);
}

#[test]
fn bits_do_not_depend_on_threads() {
    let mut mesh = samples::sphere_with_holes(20_000, 5).unwrap();
    mesh.clear_parameters();
    let options = TensorOptions { fixed_grid: Some([65, 65]), ..TensorOptions::default() };
    let fits: Vec<TensorFit> =
        [1, 2, 5].map(|threads| fit_mesh(&mesh, &options, &mut Control::new(threads)).unwrap()).into();
    let without_times = |report: &FitReport| FitReport {
        seconds: 0.0,
        parameterize_seconds: 0.0,
        max_distance: 0.0,
        ..report.clone()
    };
    for other in &fits[1..] {
        assert_eq!(fits[0].surface, other.surface);
        assert_eq!(without_times(&fits[0].report), without_times(&other.report));
        assert_eq!((&fits[0].parameters, &fits[0].errors), (&other.parameters, &other.errors));
    }
}

/// Mesh, most coefficients at 1e-2 of the diagonal, and at 1e-3 either most coefficients or the error with as
/// many as there are nodes.
const REAL: [(&str, usize, Result<usize, f64>); 8] = [
    ("bust", 1089, Err(5e-3)),
    ("limb", 289, Err(5e-3)),
    ("maxface_disk_4k.off", 240, Ok(2400)),
    ("camelhead_disk_11k.off", 1300, Err(3.5e-3)),
    ("igea_disk_43k.ply", 720, Err(1.6e-3)),
    // 108 coefficients meet 1e-2 too, but leave the part by half its diagonal beyond the border and in the door openings
    ("neon_side_holes_16k.off", 240, Ok(4500)),
    ("blow_shell_displacement.ply", 16, Ok(81)),
    ("mannequin_disk_13k.off", 2600, Err(5.5e-3)),
];

#[test]
fn real_meshes_need_no_more_coefficients_than_measured_before() {
    for (name, coarse, fine) in REAL {
        let Some(mut mesh) = common::mesh(name) else { continue };
        mesh.clear_parameters();
        let at = |value| {
            let tolerance = Tolerance { value, ..Tolerance::default() };
            let report = fit(&mesh, &TensorOptions { tolerance, ..TensorOptions::default() }).report;
            assert_eq!(report.flipped_count, 0, "{name}");
            assert!(!report.remarks.has(Remarks::FOLDED_PARAMETERS), "{name}");
            (report.max_error / report.diagonal, report.coefficient_count)
        };
        let (error, count) = at(1e-2);
        assert!(error <= 1e-2 && count <= coarse, "{name}: {error:e} with {count}");
        let (error, count) = at(1e-3);
        match fine {
            Ok(most) => assert!(error <= 1e-3 && count <= most, "{name}: {error:e} with {count}"),
            Err(most) => {
                assert!(error <= most && count <= mesh.points().len(), "{name}: {error:e} with {count}")
            }
        }
    }
}

#[test]
fn an_airplane_with_holes_is_told_to_be_cut_into_charts() {
    let Some(mesh) = common::mesh("airplane_holes_8k.off") else { return };
    let report = fit(&mesh, &TensorOptions { max_grid: 65, ..TensorOptions::default() }).report;
    assert_eq!(report.flipped_count, 0);
    assert!(report.remarks.has(Remarks::TOLERANCE_NOT_MET));
    assert!(report.remarks.has(Remarks::SEGMENTATION_ADVISED));
}

#[test]
fn a_field_that_meets_its_tolerance_says_so() {
    let mesh = samples::curved_notch(3).unwrap();
    // waves of a dozen edges: between the nodes the field leaves its facets by more than the tolerance
    let field: Vec<f64> =
        mesh.parameters().unwrap().iter().map(|p| (0.9 * p.x).sin() * (0.7 * p.y).cos()).collect();
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let tolerance = Tolerance { value: tolerance, scale: ToleranceScale::Relative };
        let options = TensorOptions { tolerance, ..TensorOptions::default() };
        let report = fit_field(&mesh, &field, 1, &options, &mut Control::new(1)).unwrap().report;
        assert!(report.max_error <= report.tolerance, "{report:?}");
        assert!(report.max_interior_error > report.tolerance || tolerance.value > 1e-3, "{report:?}");
        assert_eq!(report.stop, StopReason::ToleranceMet, "{report:?}");
        assert!(!report.remarks.has(Remarks::STAGNATED), "{report:?}");
    }
}

#[test]
fn a_height_field_without_parameters_takes_few_coefficients() {
    let (places, triangles) = samples::grid([100, 100], 0.2, 1, |_| true);
    let mesh = Mesh::new(places.iter().map(|&p| p.extend(franke(p))).collect(), triangles).unwrap();
    let report = fit(&mesh, &TensorOptions::default()).report;
    assert!(report.max_error <= report.tolerance, "{report:?}");
    assert!(report.coefficient_count < 1000, "{report:?}");
}

/// Franke's function, the hills and dales of scattered data interpolation.
fn franke(p: DVec2) -> f64 {
    let (x, y) = (9.0 * p.x, 9.0 * p.y);
    0.75 * (-((x - 2.0).powi(2) + (y - 2.0).powi(2)) / 4.0).exp()
        + 0.75 * (-(x + 1.0).powi(2) / 49.0 - (y + 1.0) / 10.0).exp()
        + 0.5 * (-((x - 7.0).powi(2) + (y - 3.0).powi(2)) / 4.0).exp()
        - 0.2 * (-(x - 4.0).powi(2) - (y - 7.0).powi(2)).exp()
}

/// MATLAB's peaks over the unit square, a twentieth as high.
fn peaks(p: DVec2) -> f64 {
    let (x, y) = (6.0 * p.x - 3.0, 6.0 * p.y - 3.0);
    0.05 * (3.0 * (1.0 - x).powi(2) * (-x * x - (y + 1.0).powi(2)).exp()
        - 10.0 * (x / 5.0 - x.powi(3) - y.powi(5)) * (-x * x - y * y).exp()
        - (-(x + 1.0).powi(2) - y * y).exp() / 3.0)
}

/// Rows (x, y, height) at places.
fn heights(places: &[DVec2], height: impl Fn(DVec2) -> f64) -> Vec<f64> {
    places.iter().flat_map(|&p| [p.x, p.y, height(p)]).collect()
}

/// The largest distance between a surface and rows.
fn distance(surface: &impl Surface, uv: &[DVec2], values: &[f64]) -> f64 {
    let mut rows = vec![0.0; values.len()];
    surface.eval_rows(uv, 0, &mut rows);
    let rows = rows.chunks_exact(3).zip(values.chunks_exact(3));
    rows.map(|(a, b)| DVec3::from_slice(a).distance(DVec3::from_slice(b))).fold(0.0, f64::max)
}

#[test]
fn free_knots_take_few_coefficients_and_hold_at_places_not_given() {
    type Height = fn(DVec2) -> f64;
    let functions: [(&str, Height, usize); 2] = [("peaks", peaks, 360), ("Franke", franke, 250)];
    for (name, function, most) in functions {
        let (places, _) = samples::grid([100, 100], 0.3, 7, |_| true);
        let tolerance = Tolerance { value: 1e-3, scale: ToleranceScale::Absolute };
        let options = TensorOptions { tolerance, ..TensorOptions::default() };
        let result =
            fit_points(&places, &heights(&places, function), 3, &options, &mut Control::new(2)).unwrap();
        let report = &result.report;
        assert_eq!(report.stop, StopReason::ToleranceMet, "{name}: {report:?}");
        assert!(report.max_error <= 1e-3 && report.coefficient_count <= most, "{name}: {report:?}");
        let mut random = Random::new(1);
        let others: Vec<DVec2> = (0..20_000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
        let held = distance(&result.surface, &others, &heights(&others, function));
        // places between data may be worse, by little
        assert!(held <= 1.15e-3, "{name}: {held:e} at places not given");
        let uniform = TensorOptions { knots: Knots::Uniform, ..options };
        let uniform =
            fit_points(&places, &heights(&places, function), 3, &uniform, &mut Control::new(2)).unwrap();
        assert!(uniform.report.coefficient_count > 2 * most, "{name}: {:?}", uniform.report);
    }
}

#[test]
fn any_flat_square_of_two_triangles_is_fitted() {
    let mut random = Random::new(12);
    let mut tenth = || (20.0 * random.unit()).round() / 10.0;
    let mut done = 0;
    while done < 300 {
        // corners of one decimal, in a plane across an axis: most are turned, some stand on a corner
        let (at, side) = (DVec2::new(tenth(), tenth()), DVec2::new(tenth(), tenth()));
        if side == DVec2::ZERO {
            continue;
        }
        let corners = [at, at + side, at + side + side.perp(), at + side.perp()];
        let points = corners.iter().map(|p| DVec3::new(p.x, 1.5, -p.y)).collect();
        let mesh = Mesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        for border in [Border::Auto, Border::Circle, Border::SquareByTurns, Border::SquareByArc] {
            let map = ParameterizeOptions::TENSOR.with_border(border);
            let report = fit(&mesh, &TensorOptions { parameterize: map, ..TensorOptions::default() }).report;
            assert!(report.max_error <= report.tolerance, "{corners:?}, {border:?}: {report:?}");
        }
        done += 1;
    }
}

#[test]
fn mirrored_parameters_are_held_as_firmly() {
    let mesh = samples::sphere_with_holes(2000, 3).unwrap();
    let uv = mesh.parameters().unwrap().to_vec();
    let with = |mirror: f64| {
        let mut mesh = mesh.clone();
        mesh.set_parameters(uv.iter().map(|p| DVec2::new(mirror * p.x, p.y)).collect()).unwrap();
        let tolerance = Tolerance { value: 1e-5, ..Tolerance::default() };
        let options =
            TensorOptions { tolerance, correction_sweeps: 3, max_grid: 33, ..TensorOptions::default() };
        let options = TensorOptions { knots: Knots::Uniform, ..options };
        fit(&mesh, &options)
    };
    let (plain, mirrored) = (with(1.0), with(-1.0));
    assert_eq!((plain.report.flipped_count, mirrored.report.flipped_count), (0, 0));
    assert_eq!(plain.report.coefficient_count, mirrored.report.coefficient_count);
    for fit in [plain, mirrored] {
        // the border is a simple polygon, and its nodes count at their own places
        let trims = &fit.surface.region().trims;
        assert!(mesh.loops().iter().flatten().all(|&node| trims.contains(fit.parameters[node as usize])));
        tessellate(&fit.surface, &TessellateOptions::default()).unwrap();
    }
}

#[test]
fn the_size_of_a_model_changes_nothing() {
    let mesh = samples::curved_notch(3).unwrap();
    let of_size = |size: f64| {
        let points = mesh.points().iter().map(|&p| size * p).collect();
        let scaled = Mesh::new(points, mesh.triangles().to_vec()).unwrap();
        let options =
            TensorOptions { correction_sweeps: 1, measure_distance: true, ..TensorOptions::default() };
        let options = TensorOptions { knots: Knots::Uniform, ..options };
        fit(&scaled, &options)
    };
    let plain = of_size(1.0);
    for size in [1e-100, 1e-60, 1e-9, 1e9, 1e60, 1e100] {
        let scaled = of_size(size);
        let (report, expected) = (&scaled.report, &plain.report);
        assert_eq!(report.coefficient_count, expected.coefficient_count, "{size:e}");
        assert_eq!(report.remarks, expected.remarks, "{size:e}");
        // the data differ by rounding, which the normal equations multiply by their condition
        let near = |a: f64, b: f64| (a / size - b).abs() <= 1e-7 * expected.diagonal;
        let points = scaled.surface.control_points().iter().zip(plain.surface.control_points());
        assert!(points.into_iter().all(|(a, b)| near(*a, *b)), "{size:e}");
        for (a, b) in [
            (report.max_error, expected.max_error),
            (report.max_interior_error, expected.max_interior_error),
            (report.max_distance, expected.max_distance),
        ] {
            assert!(near(a, b), "{size:e}: {a:e} is not {b:e}");
        }
    }
}

#[test]
fn what_no_double_can_hold_is_refused_by_name() {
    let uv: Vec<DVec2> = (0..100).map(|k| DVec2::new((k / 10) as f64, (k % 10) as f64)).collect();
    let values: Vec<f64> = uv.iter().map(|p| p.x * p.y).collect();
    let fit = |size: f64, height: f64| {
        let uv: Vec<DVec2> = uv.iter().map(|p| size * *p).collect();
        let values: Vec<f64> = values.iter().map(|x| height * x).collect();
        let options = TensorOptions { knots: Knots::Uniform, ..TensorOptions::default() };
        fit_points(&uv, &values, 1, &options, &mut Control::new(1))
    };
    let count = fit(1.0, 1.0).unwrap().report.coefficient_count;
    for size in [1e-130, 1e-100, 1e100, 1e130] {
        assert_eq!(fit(size, 1.0).unwrap().report.coefficient_count, count, "parameters of {size:e}");
        assert_eq!(fit(1.0, size).unwrap().report.coefficient_count, count, "values of {size:e}");
    }
    for size in [1e-320, 1e-305, 1e-200, 1e200, 1e306] {
        let sentence = fit(size, 1.0).unwrap_err().to_string();
        assert!(sentence.contains("parameters") && sentence.contains("1e140"), "{sentence}");
        let sentence = fit(1.0, size).unwrap_err().to_string();
        assert!(sentence.contains("value") && sentence.contains("1e140"), "{sentence}");
    }
}

#[test]
fn options_that_do_nothing_are_refused_by_name() {
    let mesh = samples::curved_notch(3).unwrap();
    let weights = vec![1.0; mesh.points().len()];
    let plain = TensorOptions { method: Method::Ferguson, ..TensorOptions::default() };
    for (options, name) in [
        (TensorOptions { ends: Ends::Free, ..plain }, "ends"),
        (TensorOptions { weights: Some(&weights), ..plain }, "weights"),
    ] {
        let error = fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap_err().to_string();
        assert!(error.starts_with(name) && error.contains("not used"), "{error}");
    }
}
