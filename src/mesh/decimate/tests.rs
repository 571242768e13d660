use super::*;
use crate::samples;

fn decimate(mesh: &Mesh, options: &DecimateOptions) -> Decimation {
    mesh.decimate(options, &mut Control::new(1)).unwrap()
}

fn to(target_count: usize) -> DecimateOptions<'static> {
    DecimateOptions::default().with_target_count(target_count)
}

/// Nodes of each of the six sides of the unit cube, `n` by `n` cells a side, bent by `bend` where it is not flat.
fn cube(n: u32, place: impl Fn(DVec3) -> DVec3) -> Mesh {
    let mut numbers = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    let mut node = |at: [u32; 3]| {
        *numbers.entry(at).or_insert_with(|| {
            points.push(place(DVec3::from(at.map(f64::from)) / f64::from(n)));
            points.len() as u32 - 1
        })
    };
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for (side, i, j) in (0..2).flat_map(|s| (0..n).flat_map(move |i| (0..n).map(move |j| (s, i, j)))) {
            let mut corner = |a: u32, b: u32| {
                let mut at = [0; 3];
                (at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]) = (side * n, i + a, j + b);
                node(at)
            };
            let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            triangles.extend(if side == 1 { [[p, q, r], [p, r, s]] } else { [[p, r, q], [p, s, r]] });
        }
    }
    Mesh::new(points, triangles).unwrap()
}

/// What a decimation may not change.
#[track_caller]
fn assert_same_kind(mesh: &Mesh, coarse: &Decimation) {
    let Piece { mesh: result, nodes } = &coarse.piece;
    assert_eq!(result.euler_characteristic(), mesh.euler_characteristic());
    assert_eq!(result.component_count(), mesh.component_count());
    assert_eq!(result.loops().len(), mesh.loops().len());
    assert_eq!(result.pinched_nodes().len(), mesh.pinched_nodes().len());
    for (node, &old) in nodes.iter().enumerate() {
        assert_eq!(result.points()[node], mesh.points()[old as usize]);
        assert_eq!(result.is_boundary(node as u32), mesh.is_boundary(old));
    }
    let [before, after] = [mesh, result].map(|mesh| side(mesh.triangles(), mesh.parameters()));
    assert_eq!(before, after);
    assert!(result.triangles().iter().all(|t| features::normal(result.points(), t) != DVec3::ZERO));
}

#[test]
fn topology_boundary_and_map_are_kept() {
    for mesh in [
        samples::planar(1).unwrap(),
        samples::curved_notch(2).unwrap(),
        samples::half_fuselage().unwrap(),
        samples::wing().unwrap(),
        samples::sphere_with_holes(3000, 3).unwrap(),
        samples::fuselage_panel(1).unwrap(),
        cube(12, |p| p),
    ] {
        for target_count in [1500, 400] {
            let coarse = decimate(&mesh, &to(target_count));
            let count = coarse.piece.nodes.len();
            assert_eq!(count, target_count.min(mesh.points().len()));
            assert_eq!(coarse.report.excess_count, 0);
            assert_eq!(coarse.report.collapse_count, mesh.points().len() - count);
            assert_same_kind(&mesh, &coarse);
        }
    }
}

#[test]
fn what_cannot_be_reached_is_reported() {
    let mesh = samples::planar(1).unwrap();
    let coarse = decimate(&mesh, &to(3));
    assert_same_kind(&mesh, &coarse);
    let count = coarse.piece.nodes.len();
    assert!(coarse.report.excess_count > 0);
    assert_eq!(coarse.report.excess_count, count - 3);
    // a closed mesh ends as a tetrahedron at the coarsest
    let closed = decimate(&cube(4, |p| p), &to(3));
    assert_eq!(closed.piece.mesh.euler_characteristic(), 2);
    assert!(closed.report.excess_count >= 1);
}

#[test]
fn a_plane_stays_the_same_plane_region() {
    // straight sides between corners, which stay: the region is the same, and so is its area
    let is_window = |p: DVec2| p.x > 0.3 && p.x < 0.5 && p.y > 0.2 && p.y < 0.7;
    let (uv, triangles) = samples::grid([41, 31], 0.0, 1, |p| !is_window(p));
    let axes = [DVec3::new(0.8, -0.3, 0.4), DVec3::new(0.1, 0.9, -0.2)];
    let points = uv.iter().map(|p| p.x * axes[0] + p.y * axes[1]).collect();
    let mut mesh = Mesh::new(points, triangles).unwrap();
    mesh.set_parameters(uv).unwrap();
    let area = |mesh: &Mesh| -> f64 {
        mesh.triangles().iter().map(|t| 0.5 * features::normal(mesh.points(), t).length()).sum()
    };
    let coarse = decimate(&mesh, &to(30));
    assert_eq!(coarse.report.excess_count, 0);
    // products of coordinates below 1, a few roundings for each triangle
    let tol = 16.0 * mesh.triangles().len() as f64 * f64::EPSILON;
    assert!((area(&coarse.piece.mesh) - area(&mesh)).abs() <= tol);
    let normal = axes[0].cross(axes[1]).normalize();
    for t in coarse.piece.mesh.triangles() {
        let points = coarse.piece.mesh.points();
        let turned = features::normal(points, t);
        // errors of an ulp in edges below 1.5, against the area
        let tol = 1.5 * 16.0 * f64::EPSILON / turned.length();
        assert!((turned.normalize() - normal).length() <= tol, "{turned} against {normal}");
    }
}

#[test]
fn a_sphere_is_met_within_the_sagitta_of_even_triangles() {
    let unit = cube(24, |p| (p - 0.5).normalize());
    let count = 300_u32;
    let coarse = decimate(&unit, &to(count as usize));
    assert_same_kind(&unit, &coarse);
    // Corners lie on the sphere, so the plane of a triangle of circumradius R lies 1 - sqrt(1 - R^2) below it.
    // 2 n - 4 equal triangles of the sphere's area have sides of L^2 = 16 pi / (sqrt(3) (2 n - 4)) and
    // R^2 = L^2 / 3. On average ours may lie as deep as those of half as many nodes, and nowhere deeper than
    // those of an eighth.
    let depth = |n: f64| 1.0 - (1.0 - 16.0 * PI / (3.0 * 3.0_f64.sqrt() * (2.0 * n - 4.0))).sqrt();
    let mesh = &coarse.piece.mesh;
    let below = mesh.triangles().iter().map(|t| {
        let normal = features::normal(mesh.points(), t).normalize();
        1.0 - mesh.points()[t[0] as usize].dot(normal)
    });
    let below: Vec<f64> = below.collect();
    let n = f64::from(count);
    let (mean, deepest) =
        (below.iter().sum::<f64>() / below.len() as f64, below.into_iter().fold(0.0, f64::max));
    assert!(mean <= depth(n / 2.0), "{mean} below the sphere on average, {} allowed", depth(n / 2.0));
    assert!(deepest <= depth(n / 8.0), "{deepest} below the sphere, {} allowed", depth(n / 8.0));
}

#[test]
fn sharp_edges_survive_as_chains_between_corners() {
    let n = 10;
    let mesh = cube(n, |p| p);
    for sharp in [DecimateOptions::default().with_sharp_angle(Some(FRAC_PI_4)), DecimateOptions::default()] {
        let coarse = decimate(&mesh, &sharp.with_target_count(40));
        assert_same_kind(&mesh, &coarse);
        if sharp.sharp_angle.is_none() {
            assert!(coarse.sharp_edges.is_empty());
            continue;
        }
        let points = coarse.piece.mesh.points();
        let corners = points.iter().filter(|p| p.to_array().iter().all(|x| [0.0, 1.0].contains(x))).count();
        assert_eq!(corners, 8);
        let length: f64 =
            coarse.sharp_edges.iter().map(|e| points[e[0] as usize].distance(points[e[1] as usize])).sum();
        // twelve sides of length 1, each in at most n parts, each rounded
        assert!(
            (length - 12.0).abs() <= 12.0 * f64::from(n) * f64::EPSILON,
            "sharp edges of length {length}"
        );
    }
}

#[test]
fn given_sharp_edges_stay_though_nothing_turns_there() {
    let mesh = samples::planar(1).unwrap();
    let [from, to_node] = [[1.0, 5.5], [7.0, 5.2]].map(|[u, v]| {
        let distance = |&(_, uv): &(u32, DVec2)| uv.distance_squared(DVec2::new(u, v));
        let nodes = (0..).zip(mesh.parameters().unwrap().iter().copied());
        nodes.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
    });
    let path = mesh.shortest_path(from, to_node).unwrap();
    let edges: Vec<[u32; 2]> = path.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let coarse = decimate(&mesh, &to(300).with_sharp_edges(&edges));
    assert_same_kind(&mesh, &coarse);
    // one chain from end to end over nodes of the path in their order
    let at = |node: u32| path.iter().position(|&other| other == coarse.piece.nodes[node as usize]).unwrap();
    let mut steps: Vec<[usize; 2]> = coarse
        .sharp_edges
        .iter()
        .map(|edge| {
            let mut ends = edge.map(at);
            ends.sort_unstable();
            ends
        })
        .collect();
    steps.sort_unstable();
    assert_eq!((steps[0][0], steps[steps.len() - 1][1]), (0, path.len() - 1));
    assert!(steps.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{steps:?}");
    assert!(steps.len() < edges.len());
}

#[test]
fn the_result_is_always_the_same() {
    let mesh = samples::fuselage_panel(2).unwrap();
    let [one, two] = [1, 2]
        .map(|threads| mesh.decimate(&to(700), &mut Control::new(threads)).map(|d| (d.piece, d.sharp_edges)));
    assert_eq!(one.unwrap(), two.unwrap());
}

#[test]
fn refusals_name_the_offender() {
    let mesh = samples::half_fuselage().unwrap();
    let refuse = |options: DecimateOptions| mesh.decimate(&options, &mut Control::new(1)).unwrap_err();
    let small = refuse(to(2));
    assert_eq!((small.kind(), small.index()), (ErrorKind::InvalidArgument, None));
    assert_eq!(small.to_string(), "target_count is 2, it must be at least 3");
    assert_eq!(refuse(to(9).with_sharp_angle(Some(f64::NAN))).kind(), ErrorKind::InvalidArgument);
    let far = refuse(to(9).with_sharp_edges(&[[0, 1], [0, 99_999]]));
    assert_eq!(far, DecimateError::NoSuchNode { index: 1, node: 99_999, count: 5600 });
    assert_eq!((far.kind(), far.index()), (ErrorKind::Index, Some(1)));
    let none = refuse(to(9).with_sharp_edges(&[[0, 700]]));
    assert_eq!((none.kind(), none.index()), (ErrorKind::Topology, Some(0)));
    let mut folded = mesh.clone();
    let mut uv = mesh.parameters().unwrap().to_vec();
    uv[71] = uv[73];
    folded.set_parameters(uv).unwrap();
    let error = folded.decimate(&to(9), &mut Control::new(1)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Degenerate);
    let loose = DecimateOptions { keep_map: false, ..to(500) };
    assert_eq!(decimate(&folded, &loose).piece.nodes.len(), 500);
}

#[test]
fn a_listener_can_cancel() {
    let mesh = samples::planar(1).unwrap();
    let mut stop = |_: f64, _: f64| std::ops::ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    assert_eq!(mesh.decimate(&to(100), &mut control).unwrap_err(), DecimateError::Cancelled(Cancelled));
}

#[test]
fn all_sharp_edges_of_a_bracket_stay() {
    let mesh = samples::bracket().unwrap();
    let options = to(400).with_sharp_angle(Some(40_f64.to_radians()));
    let coarse = decimate(&mesh, &options);
    assert_same_kind(&mesh, &coarse);
    let sharp =
        |mesh: &Mesh, options: &DecimateOptions| Features::of(mesh, options, &Watch::default()).unwrap();
    let before = sharp(&mesh, &options);
    let after = sharp(&coarse.piece.mesh, &to(400).with_sharp_edges(&coarse.sharp_edges));
    // ends and junctions of chains stay, and the number of chains at each
    for (node, chain) in before.neighbours.iter().enumerate() {
        if ![0, 2].contains(&chain.len()) {
            let new = coarse.piece.nodes.binary_search(&(node as u32)).unwrap();
            assert_eq!(after.neighbours[new].len(), chain.len());
        }
    }
    let length = |mesh: &Mesh, features: &Features| -> f64 {
        let ends =
            features.neighbours.iter().enumerate().flat_map(|(a, ends)| ends.iter().map(move |&b| (a, b)));
        ends.map(|(a, b)| mesh.points()[a].distance(mesh.points()[b as usize])).sum::<f64>() / 2.0
    };
    let [long, short] = [length(&mesh, &before), length(&coarse.piece.mesh, &after)];
    // straight chains keep their length, but for the roundoff of its sum
    assert!((short - long).abs() <= 1e-12 * long, "{short} of {long} is left");
}

#[test]
fn a_hub_of_many_neighbours_stays_and_costs_no_more_than_others() {
    // a flat fan of two rings around a tip: with the cube of its neighbours this would not end
    const COUNT: u32 = 20_000;
    let on_ring = |ring: u32, k: u32| 1 + ring * COUNT + k % COUNT;
    let mut points = vec![DVec3::ZERO];
    for ring in 1..=2 {
        let place = |k: u32| DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(COUNT));
        points.extend((0..COUNT).map(|k| (f64::from(ring) * place(k)).extend(0.0)));
    }
    let mut triangles = Vec::new();
    for k in 0..COUNT {
        let [p, q, r, s] = [on_ring(0, k), on_ring(1, k), on_ring(1, k + 1), on_ring(0, k + 1)];
        triangles.extend([[0, p, s], [p, q, r], [p, r, s]]);
    }
    let mesh = Mesh::new(points, triangles).unwrap();
    let coarse = decimate(&mesh, &to(COUNT as usize));
    assert_same_kind(&mesh, &coarse);
    assert_eq!(coarse.piece.nodes[0], 0, "the tip stays");
    assert!(coarse.report.collapse_count > COUNT as usize / 2, "{:?}", coarse.report);
}
