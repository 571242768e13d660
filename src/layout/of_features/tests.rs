use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::mesh::FeatureOptions;
use crate::samples;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A profile of radii and heights turned about an axis in `n` steps; the first and the last radius are 0.
fn turned(n: u32, profile: &[[f64; 2]]) -> Mesh {
    let last = profile.len() as u32 - 1;
    let mut points = vec![DVec3::Z * profile[0][1]];
    for &[radius, height] in &profile[1..last as usize] {
        points.extend((0..n).map(|i| {
            let angle = TAU * f64::from(i) / f64::from(n);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), height)
        }));
    }
    points.push(DVec3::Z * profile[last as usize][1]);
    let node = |k: u32, i: u32| 1 + (k - 1) * n + i % n;
    let top = points.len() as u32 - 1;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, node(1, i + 1), node(1, i)]);
        for k in 1..last - 1 {
            triangles.extend([
                [node(k, i), node(k, i + 1), node(k + 1, i + 1)],
                [node(k, i), node(k + 1, i + 1), node(k + 1, i)],
            ]);
        }
        triangles.push([top, node(last - 1, i), node(last - 1, i + 1)]);
    }
    Mesh::new(points, triangles).unwrap()
}

/// A line of so many steps from one place to another, without its end.
fn line(from: [f64; 2], to: [f64; 2], steps: u32) -> impl Iterator<Item = [f64; 2]> {
    (0..steps).map(move |k| [0, 1].map(|c| from[c] + (to[c] - from[c]) * f64::from(k) / f64::from(steps)))
}

fn cylinder() -> Mesh {
    let wall = line([1.0, 0.0], [1.0, 2.0], 12);
    turned(60, &[vec![[0.0, 0.0]], wall.collect(), vec![[1.0, 2.0], [0.0, 2.0]]].concat())
}

/// A square plate with a round hole, `n` steps around, a multiple of 8.
fn holed_plate(n: u32) -> Mesh {
    const STEPS: u32 = 6;
    const RADIUS: f64 = 0.4;
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..n {
        let angle = TAU * f64::from(i) / f64::from(n);
        let round = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let square = round / round.abs().max_element();
        let top = DVec3::Z * 0.5;
        let (inner, outer) = (RADIUS * round, square);
        for [from, to] in
            [[outer, outer + top], [outer + top, inner + top], [inner + top, inner], [inner, outer]]
        {
            points.extend((0..STEPS).map(|k| from.lerp(to, f64::from(k) / f64::from(STEPS))));
        }
    }
    let node = |i: u32, k: u32| (i % n) * 4 * STEPS + k % (4 * STEPS);
    for (i, k) in (0..n).flat_map(|i| (0..4 * STEPS).map(move |k| (i, k))) {
        triangles.extend([
            [node(i, k), node(i + 1, k), node(i + 1, k + 1)],
            [node(i, k), node(i + 1, k + 1), node(i, k + 1)],
        ]);
    }
    Mesh::new(points, triangles).unwrap()
}

/// An eighth of a ball: one round side of three corners, and three planes.
fn octant(n: u32) -> Mesh {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    let mut numbers = BTreeMap::new();
    let mut node = |at: [u32; 3], is_round: bool| {
        let key = (at, is_round && at.iter().all(|&k| k > 0));
        *numbers.entry(key).or_insert_with(|| {
            let p = DVec3::from(at.map(f64::from));
            let scale = f64::from(at.iter().sum::<u32>()) / f64::from(n);
            points.push(p.normalize_or_zero() * scale);
            points.len() as u32 - 1
        })
    };
    let mut sheet = |place: &mut dyn FnMut(u32, u32) -> u32| {
        for i in 0..n {
            for j in 0..n - i {
                triangles.push([place(i, j), place(i + 1, j), place(i, j + 1)]);
                if i + j + 2 <= n {
                    triangles.push([place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)]);
                }
            }
        }
    };
    sheet(&mut |i, j| node([i, j, n - i - j], true));
    for axis in 0..3 {
        sheet(&mut |i, j| {
            let mut at = [0; 3];
            (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (j, i);
            node(at, false)
        });
    }
    Mesh::new(points, triangles).unwrap()
}

struct Part {
    mesh: Mesh,
    features: Features,
    regions: Regions,
    has_patches: Vec<bool>,
}

impl Part {
    /// Patches for all regions that are not flat.
    fn new(mesh: Mesh, options: FeatureOptions) -> Self {
        let features = mesh.find_features(&options).unwrap();
        let regions = features.regions(&mesh);
        let normal = |&triangle: &u32| {
            let [a, b, c] = mesh.triangles()[triangle as usize].map(|node| mesh.points()[node as usize]);
            (b - a).cross(c - a).normalize()
        };
        let is_curved =
            |triangles: &Vec<u32>| triangles.iter().any(|t| normal(t).dot(normal(&triangles[0])) < 0.999_999);
        let has_patches = regions.regions.iter().map(|region| is_curved(&region.triangles)).collect();
        Self { mesh, features, regions, has_patches }
    }

    fn make(&self) -> Result<FeatureLayout, FeatureLayoutError> {
        let Self { mesh, features, regions, has_patches } = self;
        let options = FeatureLayoutOptions::default();
        layout_of_features(mesh, features, regions, has_patches, &options, &mut Control::new(1))
    }

    /// A layout of which everything holds that must hold of each.
    #[track_caller]
    fn sound(&self) -> FeatureLayout {
        let made = self.make().unwrap();
        eprintln!("{} patches, {:?}", made.layout.quads().len(), made.report);
        self.check(&made);
        made
    }

    #[track_caller]
    fn check(&self, made: &FeatureLayout) {
        let FeatureLayout { layout, cut, map, vertices, .. } = made;
        assert_eq!(made.report.patches.iter().sum::<usize>(), layout.quads().len());
        assert_eq!(vertices.len(), layout.vertex_count());
        let kept = |region: &u32| self.has_patches[*region as usize];
        let triangles =
            (0..self.mesh.triangles().len() as u32).filter(|&t| kept(&self.regions.of_triangle[t as usize]));
        assert_eq!(triangles.collect::<BTreeSet<_>>(), cut.triangles.iter().copied().collect());
        for (triangle, &old) in cut.mesh.triangles().iter().zip(&cut.triangles) {
            assert_eq!(triangle.map(|node| cut.nodes[node as usize]), self.mesh.triangles()[old as usize]);
        }
        self.check_edges(made);
        for sector in layout.sectors() {
            assert!(sector.is_open() || sector.valence() >= 3);
        }
        for (node, place) in (0..).zip(map.places()) {
            let Some(place) = place else { panic!("node {node} has no place") };
            assert!(place.uv.cmpge(DVec2::ZERO).all() && place.uv.cmple(DVec2::ONE).all());
        }
        // a map on to the layout, one to one: areas inside a quad stay below the quad's
        let mut covered = vec![0.0; layout.quads().len()];
        for triangle in cut.mesh.triangles() {
            let [a, b, c] = triangle.map(|node| map.place(node).unwrap());
            let is_free = triangle.iter().any(|&node| !cut.mesh.is_boundary(node));
            if a.quad == b.quad && b.quad == c.quad && is_free && made.report.folded_nodes == 0 {
                let double_area = (b.uv - a.uv).perp_dot(c.uv - a.uv);
                assert!(double_area > 0.0, "triangle {triangle:?} is turned over");
                covered[a.quad as usize] += 0.5 * double_area;
            }
        }
        assert!(covered.iter().all(|&area| area <= 1.0 + 1e-9), "{covered:?}");
    }

    /// Edges on chains cover them once on each side; nodes on both sides have the same place on them.
    #[track_caller]
    fn check_edges(&self, made: &FeatureLayout) {
        let FeatureLayout { layout, cut, map, spans, sharp, .. } = made;
        let mut covered = vec![0.0; self.features.chains.len()];
        for (number, edge) in (0..).zip(layout.edges()) {
            assert_eq!(sharp[number as usize], spans[number as usize].is_some());
            assert_eq!(layout.is_smooth(number), !sharp[number as usize]);
            if let Some(span) = spans[number as usize] {
                covered[span.chain as usize] += (span.to - span.from).abs();
                for (end, length) in edge.ends.into_iter().zip([span.from, span.to]) {
                    self.check_end(made, end, span.chain, length);
                }
            }
        }
        for (chain, covered) in (0..).zip(covered) {
            let has_patches =
                |region: &Option<u32>| region.is_some_and(|region| self.has_patches[region as usize]);
            let is_used = self.regions.beside[chain].iter().any(has_patches);
            let length = Line::new(&self.mesh, &self.features.chains[chain]).length();
            let expected = if is_used { length } else { 0.0 };
            assert!((covered - expected).abs() <= 1e-12 * length, "chain {chain}: {covered} of {length}");
        }
        // by original node: the lengths along edges at which its copies lie
        let mut lengths: BTreeMap<(u32, u32), f64> = BTreeMap::new();
        for node in (0..cut.nodes.len() as u32).filter(|&node| cut.mesh.is_boundary(node)) {
            let place = map.place(node).unwrap();
            let on_side = |&side: &Side| {
                side.coordinates(place.uv)[1] == 0.0 && sharp[layout.edge_of(side).edge as usize]
            };
            let side = (0..4).map(|side| Side { quad: place.quad, side }).find(on_side);
            let Some(side) = side else { panic!("node {node} on the border lies at {place:?}") };
            let edge = layout.edge_of(side);
            let [mut t, _] = side.coordinates(place.uv);
            if !edge.is_forward {
                t = 1.0 - t;
            }
            if t > 1e-9 && t < 1.0 - 1e-9 {
                let other = *lengths.entry((cut.nodes[node as usize], edge.edge)).or_insert(t);
                assert!((other - t).abs() <= 1e-12, "{other} and {t} on edge {}", edge.edge);
            }
        }
    }

    #[track_caller]
    fn check_end(&self, made: &FeatureLayout, vertex: u32, chain: u32, length: f64) {
        let line = Line::new(&self.mesh, &self.features.chains[chain as usize]);
        match made.vertices[vertex as usize] {
            VertexSource::Corner(node) => {
                assert!(self.features.corners.contains(&node));
                let end = if length == 0.0 { 0 } else { line.nodes.len() - 1 };
                assert_eq!(line.nodes[end], node);
                assert!(length == 0.0 || length == line.length());
            }
            VertexSource::OnChain { chain: of, length: at } => {
                assert_eq!(of, chain);
                let rounding = 4.0 * f64::EPSILON * length;
                assert!(at == length || (line.is_closed && (at + line.length() - length).abs() <= rounding));
            }
            VertexSource::Inside => panic!("an edge of a chain ends inside"),
        }
    }
}

fn part(mesh: Mesh) -> Part {
    Part::new(mesh, FeatureOptions::default())
}

#[test]
fn walls_between_planes_are_rings_of_four() {
    for mesh in [cylinder(), holed_plate(64)] {
        let made = part(mesh).sound();
        assert_eq!(made.layout.quads().len(), 4);
        assert!(made.report.energy < 5.0, "{:?}", made.report);
        assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0));
        assert!((0..made.layout.vertex_count() as u32).all(|vertex| made.layout.valence(vertex) == 2));
    }
}

#[test]
fn a_triangle_is_three_quads() {
    let made = part(octant(16)).sound();
    assert_eq!(made.layout.quads().len(), 3);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0));
    let inside = made.vertices.iter().filter(|source| **source == VertexSource::Inside).count();
    assert_eq!(inside, 1);
}

#[test]
fn curved_regions_share_their_crease() {
    // a cone on a cylinder: the crease between them has two sides, and both see the same four edges
    let profile = [
        vec![[0.0, 0.0]],
        line([1.0, 0.0], [1.0, 1.0], 8).collect(),
        line([1.0, 1.0], [0.5, 1.5], 8).collect(),
        vec![[0.5, 1.5], [0.0, 1.5]],
    ];
    let made = part(turned(48, &profile.concat())).sound();
    assert_eq!(made.layout.quads().len(), 8);
    assert_eq!(made.layout.edges().iter().filter(|edge| edge.second.is_some()).count(), 4 + 4 + 4);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0));
    // two caps of a sphere: each is a square with four quads around it
    let cap = |sign: f64| {
        (1..10).map(move |k| {
            let angle = PI / 3.0 * f64::from(k) / 10.0;
            [angle.sin(), sign * (angle.cos() - (PI / 3.0).cos())]
        })
    };
    let profile = [
        vec![[0.0, -0.5]],
        cap(-1.0).collect(),
        vec![[(PI / 3.0).sin(), 0.0]],
        cap(1.0).rev().collect(),
        vec![[0.0, 0.5]],
    ];
    let made = part(turned(48, &profile.concat())).sound();
    assert_eq!(made.layout.quads().len(), 10);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0));
}

#[test]
fn a_dart_ends_in_three_quads() {
    // a cylinder whose wall has a sharp edge up to its middle
    let mesh = cylinder();
    let dart: Vec<[u32; 2]> = (0..6).map(|k| [1 + 60 * k, 1 + 60 * (k + 1)]).collect();
    let part = Part::new(
        mesh,
        FeatureOptions { least_length: 0.0, ..FeatureOptions::default().with_sharp_edges(&dart) },
    );
    let made = part.sound();
    let tip = part.features.corners.iter().find(|&&node| node == 361).unwrap();
    let vertex = made.vertices.iter().position(|source| *source == VertexSource::Corner(*tip)).unwrap();
    assert!(made.layout.valence(vertex as u32) >= 3);
    assert!(made.layout.quads().len() <= 9);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0));
}

#[test]
fn many_loops_get_a_base_complex() {
    let part = Part::new(samples::sphere_with_holes(4000, 3).unwrap(), FeatureOptions::default());
    let made = part.sound();
    assert!(!made.report.is_halved);
    assert_eq!(made.layout.euler_characteristic(), -2);
    assert!(made.layout.quads().len() <= 60, "{:?}", made.report);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0), "{:?}", made.report);
}

#[test]
fn halved_cells_always_fit_together() {
    let part = part(samples::sphere_with_holes(4000, 3).unwrap());
    let Part { mesh, features, regions, has_patches } = &part;
    let mut control = Control::new(1);
    let lines: Vec<Line> = features.chains.iter().map(|chain| Line::new(mesh, chain)).collect();
    let pieces = pieces::pieces(mesh, features, regions, &lines, has_patches).unwrap();
    let mut division = division::divide(mesh, &pieces, &lines, &mut control).unwrap();
    // an odd border has no quads
    let odd = division.lengths.iter_mut().find(|lengths| !lengths.is_empty()).unwrap();
    odd.pop();
    let options = FeatureLayoutOptions::default();
    let mut lay_out = |division: &Division, halving: Halving| {
        lay_out(mesh, &pieces, &lines, division, halving, &options, &mut control)
    };
    assert_eq!(lay_out(&division, Halving::No).unwrap_err(), FeatureLayoutError::NoLayout { region: 0 });
    let made = lay_out(&division.halved(&lines), Halving::Yes).unwrap();
    eprintln!("{} patches, {:?}", made.layout.quads().len(), made.report);
    assert!(made.report.is_halved);
    part.check(&made);
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0), "{:?}", made.report);
}

#[test]
fn refusals_name_the_offender() {
    let mut part = part(cylinder());
    part.has_patches = vec![false; 3];
    assert_eq!(part.make().unwrap_err(), FeatureLayoutError::NoPatches);
    part.has_patches.push(true);
    let error = part.make().unwrap_err();
    assert_eq!(error, FeatureLayoutError::RegionCount { given: 4, count: 3 });
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
}

#[test]
fn coarse_chains_get_nodes_where_vertices_lie() {
    // rims of six edges in four parts: two vertices of each lie halfway between nodes
    let wall = line([1.0, 0.0], [1.0, 2.0], 4);
    let profile = [vec![[0.0, 0.0]], wall.collect(), vec![[1.0, 2.0], [0.0, 2.0]]].concat();
    // walls turn by 60 degrees, and so do the rims, without an edge or a corner there
    let options =
        FeatureOptions { corner_angle: 1.2, ..FeatureOptions::default().with_sharp_angle(Some(1.4)) };
    let part = Part::new(turned(6, &profile), options);
    let Part { mesh, features, regions, has_patches } = &part;
    let lines: Vec<Line> = features.chains.iter().map(|chain| Line::new(mesh, chain)).collect();
    let pieces = pieces::pieces(mesh, features, regions, &lines, has_patches).unwrap();
    let division = places::place(&pieces, &lines, &vec![4; lines.len()]);
    let [piece] = &pieces[..] else { panic!("one wall") };
    let sheet = piece.sheet.with_stops(&lines, &division, Halving::No).unwrap();
    let added = sheet.mesh.points().len() - piece.nodes.len();
    assert_eq!(added, 4);
    assert_eq!(sheet.mesh.triangles().len(), piece.triangles.len() + added);
    assert_eq!(sheet.mesh.points()[..piece.nodes.len()], *piece.sheet.mesh.points());
    assert!((area(&sheet.mesh) / area(&piece.sheet.mesh) - 1.0).abs() <= 1e-14);
    for border in border::loops(&sheet, &lines, &division) {
        assert_eq!(border.stops.len(), 4);
        let edge = border.length / 6.0;
        for stop in &border.stops {
            let place = sheet.mesh.points()[stop.node.unwrap() as usize];
            let is_between = ((stop.at / edge).fract() - 0.5).abs() < 1e-9;
            // halfway along a side of the hexagon, or at its corner
            let radius = if is_between { 0.75_f64.sqrt() } else { 1.0 };
            assert!((place.truncate().length() - radius).abs() <= 1e-14, "{stop:?} at {place}");
        }
    }
    let options = FeatureLayoutOptions::default();
    let mut control = Control::new(1);
    let made = lay_out(mesh, &pieces, &lines, &division, Halving::No, &options, &mut control).unwrap();
    part.check(&made);
    assert_eq!(made.layout.quads().len(), 4);
}
