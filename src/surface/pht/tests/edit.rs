use super::*;

#[test]
fn a_split_keeps_the_surface_and_a_merge_takes_it_back_to_the_bit() {
    for is_rational in [false, true] {
        let original = random_surface(11, 40, 3, is_rational);
        let canonical = original.control_points(Basis::Canonical);
        let old: Vec<Vertex> = original.jets().map(|(vertex, _)| vertex).collect();
        for node in original.mesh().leaves() {
            let cell = original.mesh().cell(node);
            let mut surface = original.clone();
            surface.split(&[cell]).unwrap();
            assert!(difference(&original, &surface, 50) <= 32.0 * f64::EPSILON, "{cell:?}");
            // T-vertices that became crossings have the jets they had
            for (vertex, jet) in surface.jets() {
                if original.mesh().role(vertex) != Role::Absent {
                    assert_eq!(jet, original.jet_at(vertex), "{vertex:?}");
                }
            }
            let points = surface.control_points(Basis::Canonical);
            let width = 4 * surface.width();
            for (rank, (vertex, _)) in surface.jets().enumerate() {
                if let Ok(before) = old.binary_search(&vertex) {
                    assert_eq!(points[rank * width..][..width], canonical[before * width..][..width]);
                }
            }
            surface.merge(&[cell]).unwrap();
            assert_eq!(surface, original);
        }
    }
}

#[test]
fn random_sequences_of_splits_and_merges_keep_all_tables_right() {
    let mut random = Random::new(5);
    let mut surface = random_surface(2, 10, 1, false);
    let start = surface.clone();
    let mut splits = Vec::new();
    for step in 0..300 {
        let leaves: Vec<Cell> = surface.mesh().leaves().map(|leaf| surface.mesh().cell(leaf)).collect();
        let cell = leaves[(random.unit() * leaves.len() as f64) as usize];
        if cell.level < 9 && (step % 3 != 0) {
            surface.split(&[cell]).unwrap();
            splits.push(cell);
        } else if let Some(cell) = splits.pop() {
            surface.merge(&[cell]).unwrap();
        }
        let (mesh, topology) = (surface.mesh(), Topology::new(surface.mesh()));
        assert_eq!(mesh.leaf_count(), topology.leaves.len());
        assert_eq!(surface.jets().len(), topology.basis.len());
        for (number, &vertex) in topology.vertices.iter().enumerate() {
            let is_basis = matches!(topology.kinds[number], VertexKind::Basis(_));
            assert_eq!(mesh.role(vertex) == Role::Basis, is_basis, "{vertex:?}");
            assert_eq!(surface.jets.contains_key(&vertex), is_basis, "{vertex:?}");
        }
    }
    assert!(difference(&start, &surface, 200) <= 1e3 * f64::EPSILON);
    while let Some(cell) = splits.pop() {
        surface.merge(&[cell]).unwrap();
    }
    assert_eq!(surface, start);
}

#[test]
fn a_removal_changes_a_cell_that_does_not_touch_it() {
    let cells = [cell(0, 0, 0), cell(1, 0, 0), cell(1, 1, 0), cell(2, 2, 0)];
    let mesh = unit_square(&cells);
    let count = Topology::new(&mesh).basis.len();
    let mut random = Random::new(1);
    let jets: Vec<f64> = (0..4 * count).map(|_| random.signed()).collect();
    let original = PhtSurface::new(1, false, mesh, &jets).unwrap();
    let patch = |surface: &PhtSurface, at| {
        surface.patch(surface.topology().leaf_of(surface.mesh().find(at).unwrap()))
    };
    let far = cell(3, 5, 1);
    let mut surface = original.clone();
    surface.merge(&[cells[1]]).unwrap();
    assert_ne!(patch(&surface, far), patch(&original, far));
    // simplification sees it: what it accepts stays near everywhere
    for tolerance in [1e-3, 1e-1, 1.0, 3.0] {
        let mut surface = original.clone();
        let result = surface.simplify(tolerance).unwrap();
        assert!(result.deviation <= tolerance);
        assert!(difference(&original, &surface, 2000) <= result.deviation + 1e-14);
    }
}

#[test]
fn simplification_keeps_what_was_promised_and_removes_much() {
    let original = bump(4);
    let mut before = original.coefficient_count();
    for tolerance in [0.0, 1e-4, 1e-3, 1e-2] {
        let mut surface = original.clone();
        let result = surface.simplify(tolerance).unwrap();
        assert!(result.deviation <= tolerance, "{result:?}");
        let measured = difference(&original, &surface, 5000);
        assert!(measured <= tolerance + 1e-15, "asked {tolerance:e}, moved {measured:e}");
        assert!(surface.coefficient_count() <= before, "{tolerance:e}");
        before = surface.coefficient_count();
    }
    assert!(4 * before <= original.coefficient_count(), "{before} are left");
    // a plane needs one cell
    let mut plane = PhtSurface::new(
        1,
        false,
        unit_square(&[]),
        &[0., 1., 2., 0., 2., 1., 2., 0., 1., 1., 2., 0., 3., 1., 2., 0.],
    )
    .unwrap();
    let exact = plane.clone();
    plane.split(&[cell(0, 0, 0), cell(1, 1, 1), cell(2, 2, 2)]).unwrap();
    plane.simplify(1e-12).unwrap();
    assert_eq!(plane, exact);
}

#[test]
fn stitched_edges_have_equal_positions_and_opposite_slopes() {
    use BorderSide::{HighU, HighV, LowU, LowV};
    for (sides, is_reversed) in
        [([HighU, LowU], false), ([HighU, HighU], true), ([LowV, HighV], true), ([HighV, LowU], false)]
    {
        let make = |seed: u64, cells: &[Cell]| {
            let mesh = split_mesh([&[0.0, 2.0], &[-1.0, 0.0]], cells);
            let mut random = Random::new(seed);
            let jets: Vec<f64> =
                (0..12 * Topology::new(&mesh).basis.len()).map(|_| random.signed()).collect();
            PhtSurface::new(3, false, mesh, &jets).unwrap()
        };
        let mut a = make(1, &[cell(0, 0, 0), cell(1, 1, 1), cell(1, 0, 0), cell(2, 0, 0)]);
        let mut b = make(2, &[cell(0, 0, 0), cell(1, 1, 0)]);
        stitch((&mut a, sides[0]), (&mut b, sides[1]), is_reversed).unwrap();
        let place = |side: BorderSide, s: f64| match side {
            LowU => DVec2::new(0.0, s - 1.0),
            HighU => DVec2::new(2.0, s - 1.0),
            LowV => DVec2::new(2.0 * s, -1.0),
            HighV => DVec2::new(2.0 * s, 0.0),
        };
        // derivative away from the edge, over fractions of the domain
        let away = |surface: &PhtSurface, side: BorderSide, s: f64| {
            let mut rows = [0.0; 9];
            surface.eval_rows(&[place(side, s)], 1, &mut rows);
            let row = |k: usize| glam::DVec3::from_slice(&rows[3 * k..]);
            let slope = match side {
                LowU => 2.0 * row(1),
                HighU => -2.0 * row(1),
                LowV => row(2),
                HighV => -row(2),
            };
            (row(0), slope)
        };
        for k in 0..=20 {
            let s = f64::from(k) / 20.0;
            let (p, slope_a) = away(&a, sides[0], s);
            let (q, slope_b) = away(&b, sides[1], if is_reversed { 1.0 - s } else { s });
            assert!((p - q).length() <= 64.0 * f64::EPSILON, "{sides:?} {s}: {p} {q}");
            assert!((slope_a + slope_b).length() <= 1e3 * f64::EPSILON, "{sides:?} {s}: {slope_a} {slope_b}");
        }
    }
}

#[test]
fn local_detail_stays_in_its_support() {
    let original = random_surface(31, 20, 1, false);
    let mut surface = original.clone();
    let region = Domain { min: DVec2::new(-0.6, 11.5), max: DVec2::new(-0.3, 12.0) };
    surface.refine_region(region, 4, 10_000).unwrap();
    assert!(difference(&original, &surface, 500) <= 64.0 * f64::EPSILON);
    let ranks = surface.vertices_in(region);
    assert!(!ranks.is_empty());
    let width: Vec<f64> = ranks.iter().flat_map(|_| [5.0, 0.0, 0.0, 0.0]).collect();
    let before = surface.clone();
    surface.set_jets(&ranks, &width).unwrap();
    let functions = before.basis(Basis::Canonical);
    let mut touched: Vec<usize> =
        ranks.iter().flat_map(|&rank| functions.functions(rank)).map(|form| form.leaf).collect();
    touched.sort_unstable();
    for leaf in (0..surface.patch_count()).filter(|leaf| touched.binary_search(leaf).is_err()) {
        assert_eq!(surface.patch(leaf), before.patch(leaf));
    }
    assert!(surface.refine_region(region, 9, 100).is_err());
}
