use super::least_squares::{System, Targets};
use super::samples::ByCell;
use super::*;
use crate::control::Pool;
use crate::failure::Classify;
use crate::samples::Random;
use crate::samples::layouts::{PlacedQuads, random_sphere, stellated_tetrahedron, torus, trapezohedron};
use crate::surface::Surface;
use crate::surface::g1::{Space, conform, normal_jump};
use crate::tmesh::TMesh;
use glam::DVec3;

/// Places in all cells, `k` times `k` in each.
pub(super) fn dense_places(space: &Space, k: usize) -> Vec<Place> {
    let mut places = Vec::new();
    for (quad, surface_mesh) in (0..).zip(space.meshes()) {
        for leaf in surface_mesh.leaves() {
            let domain = surface_mesh.cell_domain(surface_mesh.cell(leaf));
            for n in 0..k * k {
                let at = DVec2::new((n / k) as f64, (n % k) as f64) + 0.5;
                places.push(Place { quad, uv: domain.min + domain.size() * at / k as f64 });
            }
        }
    }
    places
}

/// The patches of the space that are nearest to `points` at `places`.
pub(super) fn solve(space: &Space, places: &[Place], points: &[DVec3], smoothing: f64) -> Vec<PhtSurface> {
    let targets = Targets {
        uv: places.iter().map(|place| place.uv).collect(),
        points: points.to_vec(),
        weights: vec![1.0; points.len()],
    };
    let pool = Pool::new(1);
    let by_cell = ByCell::sort(space, places, &pool);
    let energy = vec![smoothing; by_cell.cell_count()];
    let solve = Control::new(1)
        .watch(|pool, watch| System::new(space, pool).solve(&targets, &by_cell, &energy, pool, watch));
    space.surfaces(&solve.unwrap().unwrap(), 3).unwrap()
}

pub(super) fn points_at(surfaces: &[PhtSurface], places: &[Place]) -> Vec<DVec3> {
    let point = |place: &Place| {
        let mut row = [0.0; 3];
        surfaces[place.quad as usize].eval_rows(&[place.uv], 0, &mut row);
        DVec3::from_array(row)
    };
    places.iter().map(point).collect()
}

/// Bilinear places between the vertices, on the unit sphere unless `is_flat`.
pub(super) fn between_vertices(
    (quads, vertices): &PlacedQuads,
    places: &[Place],
    is_flat: bool,
) -> Vec<DVec3> {
    let point = |place: &Place| {
        let [a, b, c, d] = quads[place.quad as usize].map(|v| vertices[v as usize]);
        let (low, high) = (a.lerp(b, place.uv.x), d.lerp(c, place.uv.x));
        let point = low.lerp(high, place.uv.y);
        if is_flat { point } else { point.normalize() }
    };
    places.iter().map(point).collect()
}

/// A smooth map of space, far from linear.
fn bent(p: DVec3) -> DVec3 {
    p + 0.25
        * DVec3::new(
            (1.7 * p.y + 0.3).sin(),
            (1.3 * p.z - 0.2).sin() * p.x.cos(),
            (1.1 * p.x + 0.5 * p.y).sin(),
        )
}

/// Meshes split at random, made to agree along edges.
fn random_meshes(layout: &Layout, level: u32, splits: usize, seed: u64) -> Vec<TMesh> {
    let mut meshes = uniform(layout, level).unwrap();
    let mut random = Random::new(seed);
    for _ in 0..splits {
        let mesh = &mut meshes[(random.unit() * layout.quads().len() as f64) as usize];
        let leaves: Vec<_> = mesh.leaves().collect();
        let leaf = leaves[(random.unit() * leaves.len() as f64) as usize];
        if mesh.cell(leaf).level < 6 {
            mesh.split(leaf);
        }
    }
    conform(layout, &mut meshes);
    meshes
}

/// A smooth surface near the sphere or torus over random cells, with noise.
fn check_smoothness(name: &str, quads: PlacedQuads, level: u32, splits: usize, is_flat: bool) {
    let layout = Layout::new(&quads.0).unwrap();
    check_smoothness_over(name, &layout, &quads, [level, splits as u32], is_flat);
}

/// The same over a layout of the quads, from cells of a level and so many splits.
pub(super) fn check_smoothness_over(
    name: &str,
    layout: &Layout,
    quads: &PlacedQuads,
    [level, splits]: [u32; 2],
    is_flat: bool,
) {
    let space = Space::new(layout, random_meshes(layout, level, splits as usize, 5)).unwrap();
    let places = dense_places(&space, 4);
    let mut random = Random::new(9);
    let mut noisy = |p: DVec3| bent(p) + 0.002 * DVec3::from_array([(); 3].map(|()| random.signed()));
    let points: Vec<DVec3> = between_vertices(quads, &places, is_flat).into_iter().map(&mut noisy).collect();
    let surfaces = solve(&space, &places, &points, 1e-6);
    let jump = normal_jump(layout, &surfaces).unwrap();
    assert!(jump.normal <= 1e-12 && jump.gap <= 2e-15, "{name}: {jump:?}");
}

#[test]
fn patches_share_their_tangent_planes_over_every_layout() {
    for n in [3, 5, 6, 8] {
        check_smoothness(&format!("trapezohedron {n}"), trapezohedron(n), 2, 12, false);
    }
    check_smoothness("stellated tetrahedron", stellated_tetrahedron(), 2, 12, false);
    for (count, seed) in [(9, 1), (12, 2), (14, 3)] {
        check_smoothness(&format!("sphere of {count}"), random_sphere(count, seed), 2, 30, false);
    }
    check_smoothness("torus", torus(6, 5), 1, 20, true);
}

#[test]
fn patches_share_their_tangent_planes_up_to_borders() {
    for (name, quads, drop) in [
        ("trapezohedron without a quad", trapezohedron(6), 1),
        ("trapezohedron without three", trapezohedron(8), 3),
        ("sphere with a hole", random_sphere(9, 1), 5),
    ] {
        let open = (quads.0[drop..].to_vec(), quads.1);
        match Layout::new(&open.0) {
            Ok(_) => check_smoothness(name, open, 2, 20, false),
            Err(error) => panic!("{name}: {error}"),
        }
    }
}

/// Errors of the best approximation of a smooth map of a coarse smooth surface over the same layout, level by level.
fn orders(quads: &PlacedQuads, base: u32, levels: [u32; 2]) -> f64 {
    orders_over(&Layout::new(&quads.0).unwrap(), quads, base, levels, false)
}

/// The same over a layout of the quads.
pub(super) fn orders_over(
    layout: &Layout,
    quads: &PlacedQuads,
    base: u32,
    levels: [u32; 2],
    is_flat: bool,
) -> f64 {
    let coarse = Space::new(layout, uniform(layout, base).unwrap()).unwrap();
    let places = dense_places(&coarse, 6);
    let target = solve(&coarse, &places, &between_vertices(quads, &places, is_flat), 1e-6);
    let [coarse, fine] = levels.map(|level| {
        let space = Space::new(layout, uniform(layout, level).unwrap()).unwrap();
        let places = dense_places(&space, 5);
        let points: Vec<DVec3> = points_at(&target, &places).into_iter().map(bent).collect();
        let surfaces = solve(&space, &places, &points, 1e-9);
        let between = dense_places(&space, 7);
        let exact = points_at(&target, &between).into_iter().map(bent);
        let errors = points_at(&surfaces, &between).into_iter().zip(exact).map(|(a, b)| a.distance(b));
        errors.fold(0.0, f64::max)
    });
    (coarse / fine).log2() / f64::from(levels[1] - levels[0])
}

#[test]
fn smooth_shapes_converge_at_order_four() {
    for (name, quads) in [("5", trapezohedron(5)), ("6", trapezohedron(6)), ("8", trapezohedron(8))] {
        let order = orders(&quads, 1, [2, 3]);
        assert!(order >= 3.8, "trapezohedron {name}: {order}");
    }
    let order = orders(&stellated_tetrahedron(), 1, [2, 3]);
    assert!(order >= 3.8, "stellated tetrahedron: {order}");
}

/// A triangulated unit sphere of `n` by `n` nodes a cube face, at the places of which `radius` applies.
fn star_shape(n: u32, shape: impl Fn(DVec3) -> DVec3) -> (Mesh, Vec<DVec3>) {
    use crate::layout::CUBE_FACES;
    let mut numbers = std::collections::BTreeMap::new();
    let (mut directions, mut triangles) = (Vec::new(), Vec::new());
    for face in CUBE_FACES {
        let mut at = |i: u32, j: u32| {
            let on_cube = face.point(DVec2::new(f64::from(i), f64::from(j)) / f64::from(n));
            let key = (on_cube * f64::from(n)).round().to_array().map(|x| x as i64);
            *numbers.entry(key).or_insert_with(|| {
                // evenly spread: the tangent of an eighth of a turn is 1
                directions.push((on_cube * std::f64::consts::FRAC_PI_4).to_array().map(f64::tan).into());
                directions.len() as u32 - 1
            })
        };
        for i in 0..n {
            for j in 0..n {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    let directions: Vec<DVec3> = directions.into_iter().map(|d: DVec3| d.normalize()).collect();
    let points = directions.iter().map(|&d| shape(d)).collect();
    (Mesh::new(points, triangles).unwrap(), directions)
}

#[test]
fn a_bumpy_ball_becomes_a_smooth_surface_within_the_tolerance() {
    let bumpy = |d: DVec3| d * (1.0 + 0.15 * (3.0 * d.x).sin() * (4.0 * d.y + 1.0).cos());
    let (mesh, directions) = star_shape(24, bumpy);
    let layout = Layout::cube();
    let mut reports = Vec::new();
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let options = ModelOptions::default()
            .with_tolerance(crate::fit::report::Tolerance { value: tolerance, ..Default::default() });
        let fit =
            fit_over_layout(&mesh, &layout, NodePlaces::Sphere(&directions), &options, &mut Control::new(2));
        let LayoutFit { report, surfaces, places, errors } = fit.unwrap();
        assert!(report.max_error <= tolerance * report.diagonal, "{report:?}");
        assert!(report.normal_jump <= 1e-12 && report.gap <= 1e-14, "{report:?}");
        assert!((report.volume / report.mesh_volume - 1.0).abs() <= 5e-3, "{report:?}");
        // errors again through the public evaluation
        for (node, (place, error)) in places.iter().zip(&errors).enumerate() {
            let point = points_at(&surfaces, &[place.unwrap()])[0];
            assert_eq!(point.distance(mesh.points()[node]), *error);
        }
        reports.push(report);
    }
    assert!(reports[0].coefficient_count <= reports[1].coefficient_count);
    assert!(reports[1].coefficient_count <= reports[2].coefficient_count);
}

#[test]
fn results_do_not_depend_on_threads() {
    let (mesh, directions) = star_shape(12, |d| d * DVec3::new(3.0, 1.0, 1.5));
    let layout = Layout::cube();
    let fit = |threads| {
        let options = ModelOptions::default();
        let places = NodePlaces::Sphere(&directions);
        fit_over_layout(&mesh, &layout, places, &options, &mut Control::new(threads)).unwrap()
    };
    let (one, three) = (fit(1), fit(3));
    assert_eq!(one.surfaces, three.surfaces);
    assert_eq!(one.errors, three.errors);
}

#[test]
fn a_fit_is_cancelled_and_bad_places_are_named() {
    let (mesh, directions) = star_shape(6, |d| d);
    let layout = Layout::cube();
    let options = ModelOptions::default();
    let mut stop = |_: f64, _: f64| std::ops::ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    let fit = fit_over_layout(&mesh, &layout, NodePlaces::Sphere(&directions), &options, &mut control);
    assert_eq!(fit.unwrap_err().kind(), crate::failure::ErrorKind::Cancelled);

    let mut places = vec![Some(Place { quad: 0, uv: DVec2::splat(0.5) }); mesh.points().len()];
    places[7] = Some(Place { quad: 6, uv: DVec2::splat(0.5) });
    let fit = fit_over_layout(&mesh, &layout, NodePlaces::Patches(&places), &options, &mut Control::new(1));
    assert_eq!(fit.unwrap_err(), ModelFitError::Place { node: 7 });
    let options = options.with_start_level(9);
    let fit =
        fit_over_layout(&mesh, &layout, NodePlaces::Sphere(&directions), &options, &mut Control::new(1));
    assert_eq!(fit.unwrap_err().kind(), crate::failure::ErrorKind::InvalidArgument);
}

/// Both ways between points of the mesh and of the model, face by face through its surfaces.
fn check_model(mesh: &Mesh, fit: &ModelFit) {
    let ModelFit { model, places, errors, report, .. } = fit;
    let measure = model.measure();
    assert_eq!(model.free_edge_count(), 0);
    assert!(model.edge_ids().all(|edge| model.uses(edge).count() == 2));
    assert!(measure.max_gap <= 1e-14 * model.diagonal(), "{measure:?}");
    assert!(measure.max_normal_jump <= 1e-7, "angles are no better than roots of roundings: {measure:?}");
    assert!((measure.volume / report.volume - 1.0).abs() <= 1e-10, "{} {}", measure.volume, report.volume);
    for (node, (place, error)) in places.iter().zip(errors).enumerate() {
        let Some((face, uv)) = *place else { continue };
        let point = model.carrier(face).points(&[uv])[0];
        let miss = point.distance(mesh.points()[node]);
        assert!((miss - error).abs() <= 1e-12 * report.diagonal, "node {node}: {miss} {error}");
    }
}

fn model_of(mesh: &Mesh, tolerance: f64) -> ModelFit {
    let tolerance = crate::fit::report::Tolerance { value: tolerance, ..Default::default() };
    let fit = ModelOptions::default().with_tolerance(tolerance);
    fit_mesh(mesh, &MeshModelOptions { fit, ..Default::default() }, &mut Control::new(2)).unwrap()
}

#[test]
fn closed_meshes_become_solids_without_free_edges() {
    let (ball, _) = star_shape(16, |d| d * (1.0 + 0.1 * (4.0 * d.z).sin()));
    let fit = model_of(&ball, 1e-3);
    assert!(fit.report.max_error <= 1e-3 * fit.report.diagonal, "{:?}", fit.report);
    assert_eq!((fit.model.shells().len(), fit.model.euler_characteristic()), (1, 2));
    check_model(&ball, &fit);
}

#[test]
fn a_torus_gets_patches_of_its_own() {
    let (quads, points) = torus(48, 24);
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh::new(points, triangles).unwrap();
    let fit = model_of(&mesh, 1e-3);
    assert!(fit.report.max_error <= 1e-3 * fit.report.diagonal, "{:?}", fit.report);
    assert_eq!((fit.components[0].genus, fit.model.euler_characteristic()), (1, 0));
    assert!(fit.report.normal_jump <= 1e-10, "{}", fit.report.normal_jump);
    check_model(&mesh, &fit);
}

/// Several meshes as one.
fn joined(meshes: &[&Mesh]) -> Mesh {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let first = points.len() as u32;
        points.extend_from_slice(mesh.points());
        triangles.extend(mesh.triangles().iter().map(|triangle| triangle.map(|node| node + first)));
    }
    Mesh::new(points, triangles).unwrap()
}

#[test]
fn components_become_shells_and_voids_whatever_way_they_are_turned() {
    let [outer, inner, beside] = [(2.0, DVec3::ZERO), (0.7, DVec3::ZERO), (1.0, 5.0 * DVec3::X)]
        .map(|(radius, middle)| star_shape(8, move |d| middle + radius * d).0);
    let inside_out = |mesh: &Mesh| {
        let triangles = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
        Mesh::new(mesh.points().to_vec(), triangles).unwrap()
    };
    let hollow = 4.0 / 3.0 * std::f64::consts::PI * (8.0 - 0.343 + 1.0);
    for mesh in
        [joined(&[&inner, &outer, &beside]), joined(&[&inside_out(&inner), &inside_out(&outer), &beside])]
    {
        let fit = model_of(&mesh, 1e-2);
        let voids: Vec<Option<usize>> = fit.components.iter().map(|component| component.void_in).collect();
        assert_eq!(voids.iter().flatten().count(), 1);
        assert_eq!(fit.model.shells().len(), 3);
        assert_eq!(fit.components.iter().filter(|component| component.is_turned).count(), 1);
        // three balls of few facets
        assert!((fit.report.volume / hollow - 1.0).abs() <= 0.05, "{}", fit.report.volume);
        check_model(&mesh, &fit);
    }
}

/// A box of twelve triangles.
fn coarse_box(half: f64) -> Mesh {
    let layout = Layout::cube();
    let mut points = vec![DVec3::ZERO; 8];
    let mut triangles = Vec::new();
    for (face, quad) in crate::layout::CUBE_FACES.iter().zip(layout.quads()) {
        for (uv, &vertex) in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].into_iter().zip(quad) {
            points[vertex as usize] = half * face.point(uv);
        }
        let &[a, b, c, d] = quad;
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Mesh::new(points, triangles).unwrap()
}

#[test]
fn a_box_keeps_its_edges_beside_what_is_not_exact() {
    let (ball, _) = star_shape(8, |d| 0.6 * d);
    let mesh = joined(&[&coarse_box(1.0), &ball]);
    let fit = model_of(&mesh, 1e-3);
    assert!(fit.components.iter().all(|component| !component.rounds_edges), "{:?}", fit.components);
    assert_eq!(fit.report.remarks.0, 0);
    let off = (fit.report.volume / fit.report.mesh_volume - 1.0).abs();
    assert!(off <= 5e-3, "{off:e}");
}

#[test]
fn a_model_that_leaves_large_facets_is_told() {
    // eight nodes say nothing of what lies between them
    let features = crate::mesh::FeatureOptions::default().with_sharp_angle(None);
    let options = MeshModelOptions { exact: false, features, ..Default::default() };
    let report = fit_mesh(&coarse_box(1.0), &options, &mut Control::new(1)).unwrap().report;
    assert!(report.max_back_excess > report::BACK_SLACK * report.tolerance, "{report:?}");
    assert!(report.remarks.has(crate::fit::report::Remarks::ROUGH_BETWEEN_NODES), "{:?}", report.remarks);
}

#[test]
fn what_has_no_model_is_named() {
    let (ball, _) = star_shape(4, |d| d);
    let open = Mesh::new(ball.points().to_vec(), ball.triangles()[1..].to_vec()).unwrap();
    let patches = MeshModelOptions { family: Family::Patches, ..Default::default() };
    let refuse =
        |mesh: &Mesh, options: &MeshModelOptions| fit_mesh(mesh, options, &mut Control::new(1)).unwrap_err();
    assert!(matches!(refuse(&open, &patches), ModelFitError::Open { loops: 1, .. }));
    let flat =
        Mesh::new(ball.points().iter().map(|p| p.with_z(0.0)).collect(), ball.triangles().to_vec()).unwrap();
    let refused = refuse(&flat, &patches);
    assert_eq!(refused.kind(), crate::failure::ErrorKind::Degenerate, "{refused}");
    let huge =
        Mesh::new(ball.points().iter().map(|p| 1e60 * p).collect(), ball.triangles().to_vec()).unwrap();
    assert!(matches!(refuse(&huge, &patches), ModelFitError::Size { .. }));
    let layout = crate::layout::of_mesh::MeshLayoutOptions::default().with_patches(1_000_000);
    let refused = refuse(&ball, &MeshModelOptions { layout, ..patches });
    assert!(refused.to_string().starts_with("patches is 1000000, it must be from 6 to"), "{refused}");
    let too_deep = MeshModelOptions { fit: ModelOptions::default().with_max_level(30), ..patches };
    assert_eq!(refuse(&ball, &too_deep).kind(), crate::failure::ErrorKind::InvalidArgument);
    // one chart serves an open mesh
    let upper = |triangle: &&[u32; 3]| triangle.iter().all(|&node| ball.points()[node as usize].z >= -1e-9);
    let upper = ball.triangles().iter().filter(upper).copied().collect();
    let half = Mesh::new(ball.points().to_vec(), upper).unwrap();
    let fit = model_of(&half, 1e-2);
    assert!(fit.pieces.is_empty() && fit.components[0].layout.is_none());
    assert!(fit.model.free_edge_count() > 0);
}
