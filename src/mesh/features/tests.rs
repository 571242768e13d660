use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::samples::{self, Random};
use std::collections::BTreeSet;

/// A mesh of the sides of a box from 0 to `size`, with nodes one apart.
fn block(size: [u32; 3]) -> Mesh {
    let mut numbers = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
        for (side, a, b) in
            (0..2).flat_map(|s| (0..size[i]).flat_map(move |a| (0..size[j]).map(move |b| (s, a, b))))
        {
            let mut corner = |da: u32, db: u32| {
                let mut at = [0; 3];
                (at[axis], at[i], at[j]) = (side * size[axis], a + da, b + db);
                *numbers.entry(at).or_insert_with(|| {
                    points.push(DVec3::from(at.map(f64::from)));
                    points.len() as u32 - 1
                })
            };
            let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            triangles.extend(if side == 1 { [[p, q, r], [p, r, s]] } else { [[p, r, q], [p, s, r]] });
        }
    }
    Mesh::new(points, triangles).unwrap()
}

/// A cylinder of `n` sides with lids, and its nodes moved along a random normal by about `noise` edges.
fn cylinder(n: u32, rings: u32) -> Mesh {
    let mut points = vec![DVec3::ZERO];
    let height = f64::from(rings) * std::f64::consts::TAU / f64::from(n);
    for k in 0..=rings {
        points.extend((0..n).map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            DVec3::new(angle.cos(), angle.sin(), height * f64::from(k) / f64::from(rings))
        }));
    }
    points.push(DVec3::Z * height);
    let node = |k: u32, i: u32| 1 + k * n + i % n;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, node(0, i + 1), node(0, i)]);
        for k in 0..rings {
            triangles.extend([
                [node(k, i), node(k, i + 1), node(k + 1, i + 1)],
                [node(k, i), node(k + 1, i + 1), node(k + 1, i)],
            ]);
        }
        triangles.push([points.len() as u32 - 1, node(rings, i), node(rings, i + 1)]);
    }
    Mesh::new(points, triangles).unwrap()
}

/// Nodes moved along the mean normal by a normal variable of this deviation, in mean edges of length 1.
fn noisy(mesh: &Mesh, deviation: f64, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    // the sum of twelve uniform variables is as good as normal
    let mut variable = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let along = |node: u32| {
        let facets =
            mesh.outgoing(node).map(|edge| normal(mesh.points(), &mesh.triangles()[edge.triangle()]));
        facets.map(DVec3::normalize_or_zero).sum::<DVec3>().normalize_or_zero()
    };
    let moved = (0..).zip(mesh.points()).map(|(node, &point)| point + deviation * variable() * along(node));
    Mesh::new(moved.collect(), mesh.triangles().to_vec()).unwrap()
}

fn find(mesh: &Mesh, options: FeatureOptions) -> Features {
    mesh.find_features(&options).unwrap()
}

/// The edges of a block's twelve sides.
fn sides(mesh: &Mesh, size: [u32; 3]) -> Vec<[u32; 2]> {
    let bounds = |node: u32| -> BTreeSet<usize> {
        let p = mesh.points()[node as usize].to_array();
        (0..3).filter(|&k| p[k] == 0.0 || p[k] == f64::from(size[k])).collect()
    };
    let edges = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let is_side = |&[a, b]: &[u32; 2]| bounds(a).intersection(&bounds(b)).count() >= 2 && a < b;
    // a facet's diagonal at a corner may join two sides
    let is_straight =
        |&[a, b]: &[u32; 2]| mesh.points()[a as usize].distance(mesh.points()[b as usize]) == 1.0;
    let mut sides: Vec<[u32; 2]> = edges.filter(is_side).filter(is_straight).collect();
    sides.sort_unstable();
    sides.dedup();
    sides
}

#[test]
fn a_block_has_twelve_chains_between_eight_corners() {
    // so large that most nodes are farther from the creases than the estimate of noise looks
    let size = [20, 16, 12];
    let mesh = block(size);
    let features = find(&mesh, FeatureOptions::default());
    assert_eq!(features.edges, sides(&mesh, size));
    assert_eq!((features.chains.len(), features.corners.len()), (12, 8));
    assert!(features.chains.iter().all(|chain| !chain.is_closed));
    assert_eq!((features.prolonged_count, features.dropped_count, features.border_count), (0, 0, 0));
    assert!(features.noise < 1e-12);
}

#[test]
fn rims_are_closed_chains() {
    let mesh = cylinder(60, 12);
    let features = find(&mesh, FeatureOptions::default());
    assert_eq!(features.chains.len(), 2);
    assert!(features.chains.iter().all(|chain| chain.is_closed && chain.nodes.len() == 60));
    assert!(features.corners.is_empty());
}

#[test]
fn noise_is_measured_and_hides_no_edge() {
    let size = [20, 16, 12];
    let clean = block(size);
    for seed in 1..4 {
        // edges of the grid are 1 and sqrt 2 long: noise in parts of their mean
        let mean = (2.0 + 2.0_f64.sqrt()) / 3.0;
        let mesh = noisy(&clean, 0.1 * mean, seed);
        let features = find(&mesh, FeatureOptions::default());
        assert!((features.noise - 0.1).abs() < 0.03, "noise {}", features.noise);
        assert_eq!(features.edges, sides(&clean, size), "seed {seed}");
        assert_eq!(features.corners.len(), 8);
        assert!(!features.are_texture());
    }
}

#[test]
fn smooth_shapes_have_no_features() {
    for mesh in [samples::ball(2000, 1), samples::handles(1, 3000, 2)] {
        let features = find(&mesh.unwrap(), FeatureOptions::default());
        assert!(features.edges.is_empty(), "{features:?}");
    }
}

#[test]
fn borders_labels_and_given_edges_are_features() {
    let sheet = samples::planar(1).unwrap();
    let features = find(&sheet, FeatureOptions::default().with_sharp_angle(None));
    assert_eq!(features.edges.len(), sheet.topology().boundary_edge_count());
    assert_eq!(features.border_count, features.edges.len());
    // two labels on a ball: the edges between them, each in one chain
    let ball = samples::ball(1500, 4).unwrap();
    let is_high = |t: &[u32; 3]| t.iter().map(|&node| ball.points()[node as usize].z).sum::<f64>() > 0.0;
    let labels: Vec<u32> = ball.triangles().iter().map(|t| u32::from(is_high(t))).collect();
    let mut beside = std::collections::BTreeMap::<[u32; 2], BTreeSet<u32>>::new();
    for (triangle, &label) in ball.triangles().iter().zip(&labels) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (triangle[i], triangle[j])) {
            beside.entry([a.min(b), a.max(b)]).or_default().insert(label);
        }
    }
    let between: Vec<[u32; 2]> =
        beside.into_iter().filter(|(_, labels)| labels.len() == 2).map(|(edge, _)| edge).collect();
    let options = FeatureOptions::default().with_sharp_angle(None).with_labels(&labels);
    let features = find(&ball, FeatureOptions { corner_angle: PI, ..options });
    assert_eq!(features.edges, between);
    let in_chains = |chain: &Chain| chain.nodes.len() - usize::from(!chain.is_closed);
    assert_eq!(features.chains.iter().map(in_chains).sum::<usize>(), between.len());
    // one edge of the caller's, short as it is
    let given = [ball.triangles()[0][0], ball.triangles()[0][1]];
    let features = find(&ball, FeatureOptions::default().with_sharp_angle(None).with_sharp_edges(&[given]));
    assert_eq!(features.edges, [[given[0].min(given[1]), given[0].max(given[1])]]);
    assert_eq!(features.corners.len(), 2);
}

#[test]
fn chains_go_on_along_weak_edges_and_short_bits_go() {
    // a roof whose ridge flattens out: 60 degrees at one end, none from the middle on
    let (n, m) = (40, 10);
    let slope = |x: f64| (60.0 - 2.5 * x).max(0.0).to_radians() / 2.0;
    let mut points = Vec::new();
    for i in 0..=n {
        for j in -m..=m {
            let x = f64::from(i);
            points.push(DVec3::new(x, f64::from(j), -f64::from(i32::abs(j)) * slope(x).tan()));
        }
    }
    let node = |i: i32, j: i32| (i * (2 * m + 1) + j + m) as u32;
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in -m..m {
            triangles.extend([
                [node(i, j), node(i + 1, j), node(i + 1, j + 1)],
                [node(i, j), node(i + 1, j + 1), node(i, j + 1)],
            ]);
        }
    }
    let mesh = Mesh::new(points, triangles).unwrap();
    let ridge = |features: &Features| {
        let on_ridge = |edge: &&[u32; 2]| edge.iter().all(|&node| mesh.points()[node as usize].y == 0.0);
        features.edges.iter().filter(on_ridge).count()
    };
    let options = FeatureOptions { filter_noise: false, ..FeatureOptions::default() };
    let sharp = find(&mesh, options.with_weak_angle(PI));
    let long = find(&mesh, options);
    assert_eq!(ridge(&sharp) + long.prolonged_count, ridge(&long));
    assert!(ridge(&sharp) >= 7 && ridge(&long) > ridge(&sharp) + 5, "{} {}", ridge(&sharp), ridge(&long));
    // a bit is shorter than half the diagonal
    let bits = find(&mesh, FeatureOptions { least_length: 0.9, ..options });
    assert_eq!(ridge(&bits), 0);
    assert_eq!(bits.dropped_count, ridge(&long));
    assert!(bits.are_texture() && !sharp.are_texture());
}

#[test]
fn labels_that_meet_smoothly_are_one() {
    let samples::Strips { mesh, labels, .. } = samples::wing_strips(3).unwrap();
    let base = FeatureOptions::default().with_sharp_angle(None).with_labels(&labels);
    let count = |options: FeatureOptions| regions_of(&mesh, options).1.regions.len();
    assert_eq!(count(base), 42);
    // upper and lower skin, root and tip
    let angle = 5.0_f64.to_radians();
    assert_eq!(count(base.with_label_angle(angle)), 4);
    assert_eq!(count(base.with_label_angle(PI)), 1);
    // one edge that turns more is enough: strips with a dent between them, away from all others, stay two
    let is_between = |node: u32| {
        let around: BTreeSet<u32> = mesh.outgoing(node).map(|edge| labels[edge.triangle()]).collect();
        around == BTreeSet::from([4, 5])
    };
    let ends = |edge: HalfEdge| [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
    let raised = mesh.edges().map(ends).find(|ends| ends.iter().all(|&node| is_between(node))).unwrap();
    let is_raised = |node: usize| raised.contains(&(node as u32));
    let points =
        mesh.points().iter().enumerate().map(|(k, &p)| if is_raised(k) { p + 0.05 * DVec3::Z } else { p });
    let dented = Mesh::new(points.collect(), mesh.triangles().to_vec()).unwrap();
    assert_eq!(regions_of(&dented, base.with_label_angle(angle)).1.regions.len(), 5);
}

#[test]
fn labels_tell_their_pieces_and_handles() {
    let ring = samples::handles(1, 3000, 2).unwrap();
    let middle = |t: &[u32; 3]| t.iter().map(|&node| ring.points()[node as usize]).sum::<DVec3>() / 3.0;
    // two patches on the left and right; the rest of a ring keeps its handle
    let label = |t: &[u32; 3]| u32::from(middle(t).x.abs() > 1.3) + 7;
    let labels: Vec<u32> = ring.triangles().iter().map(label).collect();
    let parts = ring.label_parts(&labels).unwrap();
    let told: Vec<[usize; 3]> = parts.iter().map(|of| [of.label as usize, of.pieces, of.handles]).collect();
    assert_eq!(told, [[7, 1, 1], [8, 2, 0]]);
    assert_eq!(parts.iter().map(|of| of.triangle_count).sum::<usize>(), ring.triangles().len());
    assert_eq!(ring.label_parts(&[]).unwrap(), []);
    assert!(matches!(ring.label_parts(&labels[1..]), Err(FeatureError::LabelCount { .. })));
}

#[test]
fn refusals_name_the_offender() {
    let mesh = block([3, 3, 3]);
    let refuse = |options: FeatureOptions| mesh.find_features(&options).unwrap_err();
    let base = FeatureOptions::default();
    assert_eq!(refuse(base.with_sharp_angle(Some(4.0))).kind(), ErrorKind::InvalidArgument);
    assert_eq!(refuse(base.with_label_angle(-1.0)).kind(), ErrorKind::InvalidArgument);
    assert_eq!(refuse(FeatureOptions { least_length: f64::NAN, ..base }).kind(), ErrorKind::InvalidArgument);
    assert_eq!(refuse(base.with_labels(&[1, 2])), FeatureError::LabelCount { given: 2, count: 108 });
    let far = refuse(base.with_sharp_edges(&[[0, 1], [0, 999]]));
    assert_eq!((far.kind(), far.index()), (ErrorKind::Index, Some(1)));
    let none = refuse(base.with_sharp_edges(&[[0, 0]]));
    assert_eq!((none.kind(), none.index()), (ErrorKind::Topology, Some(0)));
}

/// The loops of a region as corner rows, and that each side knows what lies across.
fn check_regions(mesh: &Mesh, features: &Features, regions: &Regions) {
    let mut seen = BTreeSet::new();
    for (number, region) in (0..).zip(&regions.regions) {
        for row in &region.loops {
            for (k, side) in row.iter().enumerate() {
                assert_eq!(side.to, row[(k + 1) % row.len()].from, "{row:?}");
                assert!(seen.insert((side.chain, side.is_forward)), "{side:?} bounds twice");
                assert_eq!(regions.beside[side.chain as usize][usize::from(!side.is_forward)], Some(number));
            }
        }
    }
    // each chain inside has two sides, each on the border one
    assert_eq!(seen.len(), regions.beside.iter().flatten().flatten().count());
    let is_outside = |beside: &[Option<u32>; 2]| beside.iter().any(Option::is_none);
    let border: usize = (features.chains.iter().zip(&regions.beside))
        .filter(|(_, beside)| is_outside(beside))
        .map(|(chain, _)| chain.nodes.len() - usize::from(!chain.is_closed))
        .sum();
    assert_eq!(border, mesh.topology().boundary_edge_count());
    // regions meet only along features
    let is_feature = |a: u32, b: u32| features.edges.binary_search(&[a.min(b), a.max(b)]).is_ok();
    for edge in mesh.edges() {
        let Some(twin) = mesh.topology().twin(edge) else { continue };
        let [left, right] = [edge, twin].map(|side| regions.of_triangle[side.triangle()]);
        assert!(left == right || is_feature(edge.origin(mesh.triangles()), edge.target(mesh.triangles())));
    }
    let listed: usize = regions.regions.iter().map(|region| region.triangles.len()).sum();
    assert_eq!(listed, mesh.triangles().len());
}

fn regions_of(mesh: &Mesh, options: FeatureOptions) -> (Features, Regions) {
    let features = find(mesh, options);
    let regions = features.regions(mesh);
    check_regions(mesh, &features, &regions);
    (features, regions)
}

#[test]
fn regions_of_a_block_are_its_six_sides() {
    let (_, regions) = regions_of(&block([5, 4, 3]), FeatureOptions::default());
    assert_eq!(regions.regions.len(), 6);
    for (number, region) in (0..).zip(&regions.regions) {
        assert_eq!((region.loops.len(), region.loops[0].len(), region.genus), (1, 4, 0));
        assert_eq!(regions.neighbours(number).len(), 4);
    }
}

#[test]
fn a_wall_between_rims_has_two_loops_of_one_side() {
    let mesh = cylinder(60, 12);
    let (features, regions) = regions_of(&mesh, FeatureOptions::default());
    let loops: Vec<Vec<usize>> =
        regions.regions.iter().map(|region| region.loops.iter().map(Vec::len).collect()).collect();
    assert_eq!(loops, [vec![1], vec![1, 1], vec![1]]);
    let sides = regions.regions[1].loops.iter().flatten();
    assert!(sides.clone().all(|side| side.from == side.to && regions.across(side) != Some(1)));
    assert!(sides.clone().all(|side| features.chains[side.chain as usize].nodes[0] == side.from));
    assert_eq!((regions.neighbours(1), regions.regions[1].genus), (vec![0, 2], 0));
}

#[test]
fn handles_and_bodies_are_regions_without_bound() {
    let smooth = FeatureOptions { corner_angle: PI, ..FeatureOptions::default().with_sharp_angle(None) };
    let (_, regions) = regions_of(&samples::handles(2, 3000, 5).unwrap(), smooth);
    assert_eq!((regions.regions.len(), regions.regions[0].genus), (1, 2));
    assert!(regions.regions[0].loops.is_empty());
    // a ring cut by a label is a tube: the handle is gone
    let ring = samples::handles(1, 3000, 2).unwrap();
    let is_right = |t: &[u32; 3]| t.iter().map(|&node| ring.points()[node as usize].x).sum::<f64>() > 0.0;
    let labels: Vec<u32> = ring.triangles().iter().map(|t| u32::from(is_right(t))).collect();
    let (_, regions) = regions_of(&ring, smooth.with_labels(&labels));
    let shape = |region: &Region| (region.loops.len(), region.genus);
    assert_eq!(regions.regions.iter().map(shape).collect::<Vec<_>>(), [(2, 0), (2, 0)]);
    // two blocks apart
    let block = block([2, 2, 2]);
    let count = block.points().len() as u32;
    let points = block.points().iter().chain(block.points());
    let points = points.enumerate().map(|(k, &p)| if k < count as usize { p } else { p + 9.0 });
    let triangles = block.triangles().iter().copied();
    let triangles = triangles.clone().chain(triangles.map(|t| t.map(|node| node + count)));
    let pair = Mesh::new(points.collect(), triangles.collect()).unwrap();
    assert_eq!(regions_of(&pair, FeatureOptions::default()).1.regions.len(), 12);
}

#[test]
fn a_chain_that_ends_inside_does_not_separate() {
    // the border of a sheet, a dart from it, and a chain inside
    let n = 8;
    let node = |i: u32, j: u32| i * (n + 1) + j;
    let points =
        (0..=n).flat_map(|i| (0..=n).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0))).collect();
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [p, q, r, s] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        [[p, q, r], [p, r, s]]
    });
    let mesh = Mesh::new(points, triangles.collect()).unwrap();
    let dart = [[node(4, 0), node(4, 1)], [node(4, 1), node(4, 2)]];
    let inside = [[node(2, 5), node(3, 5)], [node(3, 5), node(4, 5)]];
    let given = [dart, inside].concat();
    let options = FeatureOptions::default().with_sharp_angle(None).with_sharp_edges(&given);
    let (features, regions) = regions_of(&mesh, FeatureOptions { least_length: 0.0, ..options });
    assert_eq!(regions.regions.len(), 1);
    // five chains between the corners on the border, and both sides of the dart; both sides of the chain inside
    let region = &regions.regions[0];
    assert_eq!(region.loops.iter().map(Vec::len).collect::<Vec<_>>(), [7, 2]);
    assert_eq!(region.genus, 0);
    let is_inside = |chain: u32| regions.is_inside(chain);
    assert_eq!((0..features.chains.len() as u32).filter(|&chain| is_inside(chain)).count(), 2);
    assert!(regions.neighbours(0).is_empty());
}

#[test]
fn regions_part_at_pinched_nodes() {
    // two triangles that touch in a node: two chains of border from it to itself
    let points =
        [[0, 0], [1, 0], [1, 1], [-1, 0], [-1, -1]].map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.0));
    let mesh = Mesh::new(points.to_vec(), vec![[0, 1, 2], [0, 3, 4]]).unwrap();
    let (features, regions) =
        regions_of(&mesh, FeatureOptions { corner_angle: PI, ..FeatureOptions::default() });
    assert_eq!((features.corners, regions.regions.len()), (vec![0], 2));
    assert!(regions.regions.iter().all(|region| region.loops.len() == 1 && region.loops[0].len() == 1));
}

/// A block whose top is a roof: it rises towards the middle of y by a slope that falls from one end of x to the other as
/// `slopes` do.
fn roofed(size: [u32; 3], slopes: [f64; 2]) -> Mesh {
    let mesh = block(size);
    let [length, width, height] = size.map(f64::from);
    let lifted = |p: &DVec3| {
        let slope = slopes[0] + (slopes[1] - slopes[0]) * p.x / length;
        let rise = if p.z == height { slope * (0.5 * width - (p.y - 0.5 * width).abs()) } else { 0.0 };
        *p + rise * DVec3::Z
    };
    Mesh::new(mesh.points().iter().map(lifted).collect(), mesh.triangles().to_vec()).unwrap()
}

#[test]
fn blunt_ridges_that_divide_a_surface_are_features() {
    let size = [20, 16, 12];
    let expected = sides(&block(size), size).len() + size[0] as usize;
    // a turn of 20 degrees along the ridge, and one that fades out towards the other end
    let slope = 10.0_f64.to_radians().tan();
    for slopes in [[slope; 2], [slope, 0.0], [slope, 0.2 * slope]] {
        let mesh = roofed(size, slopes);
        let features = find(&mesh, FeatureOptions::default());
        assert_eq!(features.edges.len(), expected, "{slopes:?}");
        assert_eq!((features.chains.len(), features.corners.len()), (15, 10), "{slopes:?}");
        assert_eq!(features.regions(&mesh).regions.len(), 7, "{slopes:?}");
        // who looks for sharp edges alone finds those
        let sharp_only = find(&mesh, FeatureOptions::default().with_weak_angle(PI));
        assert_eq!(sharp_only.edges.len(), expected - size[0] as usize, "{slopes:?}");
    }
    // walls of 20 sides turn by 18 degrees at every edge: round, not ridged
    let mesh = cylinder(20, 8);
    assert_eq!(find(&mesh, FeatureOptions::default()).chains.len(), 2);
}
