//! Files as other programs write them: each kind that was once refused or misread, in `tests/reported` as it came in
//! and in seeded variants, is read rightly or refused with the sentence that names the way on.

use glam::DVec3;
use planish::failure::{Classify, ErrorKind};
use planish::mesh::{Components, Format, Mesh, MeshOptions, MeshRepairs, Repair, read, read_bytes};
use std::path::Path;

/// Variants of each kind.
const VARIANTS: u64 = 10;

/// A small generator of numbers, the same everywhere (D. E. Knuth's multiplier).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % end as u64) as usize
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    fn number(&mut self) -> f64 {
        self.below(1 << 20) as f64 / (1 << 20) as f64
    }
}

/// Nodes and faces, to be written in any format.
#[derive(Clone)]
struct Shape {
    points: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

impl Shape {
    /// A sheet of 3 to 6 quads each way, waving a little, as triangles.
    fn sheet(random: &mut Random) -> Self {
        let (m, n) = (3 + random.below(4), 3 + random.below(4));
        Self::sheet_of(m, n, random)
    }

    fn sheet_of(m: usize, n: usize, random: &mut Random) -> Self {
        let node = |i: usize, j: usize| j * (m + 1) + i;
        let places = (0..=n).flat_map(|j| (0..=m).map(move |i| (i, j)));
        let points = places.map(|(i, j)| [i as f64, j as f64, 0.1 * random.number()]).collect();
        let quads = (0..n).flat_map(|j| (0..m).map(move |i| (i, j)));
        let faces = quads.flat_map(|(i, j)| {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            [vec![a, b, c], vec![a, c, d]]
        });
        Self { points, faces: faces.collect() }
    }

    fn text(&self, format: Format) -> String {
        let join = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let corners = |face: &[usize], base: usize| {
            face.iter().map(|node| (node + base).to_string()).collect::<Vec<_>>().join(" ")
        };
        let rows = |begin: &str| -> String {
            self.points.iter().map(|point| format!("{begin}{}\n", join(point))).collect()
        };
        let counted = || -> String {
            self.faces.iter().map(|face| format!("{} {}\n", face.len(), corners(face, 0))).collect()
        };
        let (points, faces) = (self.points.len(), self.faces.len());
        match format {
            Format::Off => format!("OFF\n{points} {faces} 0\n{}{}", rows(""), counted()),
            Format::Obj => {
                let faces: String =
                    self.faces.iter().map(|face| format!("f {}\n", corners(face, 1))).collect();
                rows("v ") + &faces
            }
            Format::Ply => format!(
                "ply\nformat ascii 1.0\nelement vertex {points}\nproperty double x\nproperty double y\n\
                 property double z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n{}{}",
                rows(""),
                counted()
            ),
            Format::Stl => {
                let facet = |face: &Vec<usize>| {
                    let corners: String =
                        face.iter().map(|&node| format!("vertex {}\n", join(&self.points[node]))).collect();
                    format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n")
                };
                format!("solid s\n{}endsolid s\n", self.faces.iter().map(facet).collect::<String>())
            }
        }
    }

    fn area(&self) -> f64 {
        let at = |node: usize| DVec3::from(self.points[node]);
        self.faces.iter().map(|f| (at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])).length() / 2.0).sum()
    }
}

const INDEXED: [Format; 3] = [Format::Off, Format::Obj, Format::Ply];
const ALL: [Format; 4] = [Format::Off, Format::Obj, Format::Ply, Format::Stl];

fn area(mesh: &Mesh) -> f64 {
    let corners = mesh.triangles().iter().map(|t| t.map(|node| mesh.points()[node as usize]));
    corners.map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

fn reported(name: &str) -> (Mesh, MeshRepairs) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reported").join(name);
    read(&path, &MeshOptions::default()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn parsed(bytes: impl AsRef<[u8]>, format: Format) -> (Mesh, MeshRepairs) {
    let bytes = bytes.as_ref();
    let text = || String::from_utf8_lossy(bytes).into_owned();
    read_bytes(bytes, format, &MeshOptions::default())
        .unwrap_or_else(|error| panic!("{error} in\n{}", text()))
}

/// What is said when nothing is to be mended.
fn refusal(bytes: impl AsRef<[u8]>, format: Format) -> String {
    let options = MeshOptions::default().with_repair(Repair::NONE);
    read_bytes(bytes.as_ref(), format, &options).expect_err("nothing is mended").to_string()
}

fn variants(kind: u64, check: impl Fn(&mut Random)) {
    (0..VARIANTS).for_each(|seed| check(&mut Random(1000 * kind + seed)));
}

fn sizes(mesh: &Mesh) -> (usize, usize) {
    (mesh.points().len(), mesh.triangles().len())
}

#[test]
fn strips_of_ply_become_triangles() {
    assert_eq!(sizes(&reported("strips.ply").0), (5, 3));
    variants(1, |random| {
        // zigzag bands, each a strip, joined by -1, by rows of their own, or by nodes that come twice
        let bands = 1 + random.below(3);
        let counts: Vec<usize> = (0..bands).map(|_| 3 + random.below(6)).collect();
        let mut points = Vec::new();
        let mut strips: Vec<Vec<i64>> = Vec::new();
        for (band, &count) in counts.iter().enumerate() {
            let from = points.len() as i64;
            points.extend((0..count).map(|k| [0.5 * k as f64, (1 - k % 2) as f64 + 3.0 * band as f64, 0.0]));
            strips.push((from..from + count as i64).collect());
        }
        let expected: usize = counts.iter().map(|count| count - 2).sum();
        let rows: Vec<Vec<i64>> = match random.below(3) {
            0 => strips,
            1 => vec![strips.iter().flat_map(|strip| strip.iter().copied().chain([-1])).collect()],
            _ => {
                // the last node twice, the first of the next strip twice, once more where the sides would change
                let mut row: Vec<i64> = Vec::new();
                for strip in strips {
                    if let Some(&last) = row.last() {
                        row.extend([last, strip[0]]);
                        if row.len() % 2 == 1 {
                            row.push(strip[0]);
                        }
                    }
                    row.extend(strip);
                }
                vec![row]
            }
        };
        let kind = random.of(&["int", "short"]);
        let header = |format: &str| {
            format!(
                "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
                 property double z\nelement tristrips {}\nproperty list int {kind} vertex_indices\nend_header\n",
                points.len(),
                rows.len()
            )
        };
        let big = random.of(&[None, Some(false), Some(true)]);
        let bytes = match big {
            None => {
                let mut text = header("ascii");
                points.iter().for_each(|p| text += &format!("{} {} {}\n", p[0], p[1], p[2]));
                for row in &rows {
                    let words: Vec<String> = row.iter().map(i64::to_string).collect();
                    text += &format!("{} {}\n", row.len(), words.join(" "));
                }
                text.into_bytes()
            }
            Some(is_big) => {
                let name = if is_big { "binary_big_endian" } else { "binary_little_endian" };
                let mut bytes = header(name).into_bytes();
                let mut put = |word: &[u8]| {
                    let mut word = word.to_vec();
                    if is_big {
                        word.reverse();
                    }
                    bytes.extend(word);
                };
                points.iter().flatten().for_each(|x: &f64| put(&x.to_le_bytes()));
                for row in &rows {
                    put(&(row.len() as i32).to_le_bytes());
                    for &node in row {
                        match kind {
                            "int" => put(&(node as i32).to_le_bytes()),
                            _ => put(&(node as i16).to_le_bytes()),
                        }
                    }
                }
                bytes
            }
        };
        let (mesh, repairs) = parsed(&bytes, Format::Ply);
        assert_eq!(sizes(&mesh), (points.len(), expected));
        assert_eq!(mesh.component_count(), bands);
        assert!(repairs.is_empty(), "{repairs:?}");
        let signs = mesh.triangles().iter().map(|t| {
            let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
            (b - a).cross(c - a).z
        });
        let signs: Vec<f64> = signs.collect();
        assert!(signs.iter().all(|z| *z < 0.0) || signs.iter().all(|z| *z > 0.0), "{signs:?}");
    });
}

#[test]
fn unused_nodes_stay_and_are_passed_over() {
    let (mesh, repairs) = reported("unused.obj");
    assert_eq!((repairs.unused_nodes, mesh.unused_nodes().len()), (1, 1));
    variants(2, |random| {
        let (format, mut shape) = (random.of(&INDEXED), Shape::sheet(random));
        let count = 1 + random.below(3);
        let mut places: Vec<usize> = Vec::new();
        for _ in 0..count {
            let place = random.below(shape.points.len() + 1);
            let odd = random.of(&[f64::NAN, 1e9, -3.0, f64::INFINITY]);
            shape.points.insert(place, [odd, 0.0, 1.0]);
            shape.faces.iter_mut().flatten().filter(|node| **node >= place).for_each(|node| *node += 1);
            places.iter_mut().filter(|other| **other >= place).for_each(|other| *other += 1);
            places.push(place);
        }
        places.sort_unstable();
        let text = shape.text(format);
        let (mesh, repairs) = parsed(&text, format);
        assert_eq!(sizes(&mesh), (shape.points.len(), shape.faces.len()));
        assert_eq!(mesh.unused_nodes().iter().map(|&node| node as usize).collect::<Vec<_>>(), places);
        assert_eq!(repairs.unused_nodes, count);
        assert!((area(&mesh) - shape.area()).abs() <= 1e-12 * shape.area());
        let sentence = refusal(&text, format);
        assert!(
            sentence.contains(&format!("node {}", places[0])) && sentence.contains("'unused'"),
            "{sentence}"
        );
    });
}

#[test]
fn copies_of_triangles_go() {
    let (_, repairs) = reported("dup.off");
    assert_eq!(repairs.duplicate_triangles, 1);
    variants(3, |random| {
        let (format, shape) = (random.of(&INDEXED), Shape::sheet(random));
        let mut doubled = shape.clone();
        let count = 1 + random.below(4);
        for _ in 0..count {
            let mut copy = random.of(&shape.faces.iter().collect::<Vec<_>>()).clone();
            copy.rotate_left(random.below(3));
            if random.below(2) == 0 {
                copy.reverse();
            }
            let place = random.below(doubled.faces.len() + 1);
            doubled.faces.insert(place, copy);
        }
        let text = doubled.text(format);
        let (mesh, repairs) = parsed(&text, format);
        assert_eq!(sizes(&mesh), (shape.points.len(), shape.faces.len()));
        assert_eq!(repairs.duplicate_triangles, count);
        let sentence = refusal(&text, format);
        assert!(sentence.contains("same nodes as triangle") && sentence.contains("'copies'"), "{sentence}");
    });
}

#[test]
fn polygons_with_bridges_to_their_holes_are_cut_up() {
    let (mesh, _) = reported("keyhole.obj");
    assert_eq!((sizes(&mesh), area(&mesh), mesh.loops().len()), ((8, 8), 8.0, 2));
    variants(5, |random| {
        // a rectangle with one or two holes, joined to the rim by bridges that do not cross
        let width = 10.0 + random.below(10) as f64;
        let mut points = vec![[0.0, 0.0], [width, 0.0], [width, 9.0], [0.0, 9.0]];
        let mut polygon = vec![0, 1, 2, 3];
        let mut expected = 9.0 * width;
        for hole in 0..1 + random.below(2) {
            let left = 1.0 + 4.5 * hole as f64 + random.number();
            let (w, h) = (1.0 + random.number(), 2.0 + 3.0 * random.number());
            let low = 1.0 + 2.0 * random.number();
            let from = points.len();
            points.extend([[left, low], [left, low + h], [left + w, low + h], [left + w, low]]);
            expected -= w * h;
            // from the lower left corner of the hole to a node right below it, added to the lower side
            let foot = points.len();
            points.push([left, 0.0]);
            let place = polygon.iter().position(|&node| node == 1).unwrap();
            polygon.splice(place..place, [foot, from, from + 1, from + 2, from + 3, from, foot]);
        }
        let turn = random.below(polygon.len());
        polygon.rotate_left(turn);
        if random.below(2) == 0 {
            polygon.reverse();
        }
        let tilt = random.number();
        let shape = Shape {
            points: points.iter().map(|p| [p[0], p[1], tilt * p[0]]).collect(),
            faces: vec![polygon.clone()],
        };
        let (mesh, repairs) = parsed(shape.text(Format::Obj), Format::Obj);
        let slope = (1.0 + tilt * tilt).sqrt();
        assert!((area(&mesh) - expected * slope).abs() <= 1e-12 * expected * slope, "{polygon:?}");
        assert_eq!(mesh.triangles().len(), polygon.len() - 2);
        assert_eq!((mesh.component_count(), mesh.genus()), (1, 0));
        assert_eq!(mesh.loops().len(), 1 + (points.len() - 4) / 5, "{polygon:?}");
        assert!(repairs.is_empty(), "{repairs:?}");
    });
}

#[test]
fn headers_of_off_come_in_many_forms() {
    assert_eq!(sizes(&reported("glued.off").0), (4, 2));
    assert_eq!(sizes(&reported("ncoff.off").0), (3, 1));
    variants(6, |random| {
        let shape = Shape::sheet(random);
        let mut letters = vec!["N", "C", "ST"];
        letters.truncate(random.below(4));
        let turn = random.below(letters.len().max(1));
        letters.rotate_left(turn);
        let has = |letter: &str| letters.contains(&letter);
        let begin = format!("{}OFF", letters.concat());
        let (points, faces) = (shape.points.len(), shape.faces.len());
        let mut text = match random.below(5) {
            0 => format!("{begin}{points} {faces} 0\n"),
            1 => format!("{begin}\n{points} {faces}\n"),
            2 => format!("{begin} {points} {faces} 7 # edges\n"),
            3 => format!("# made by hand\n{begin}\n\n{points}\n{faces}\n0\n"),
            _ => format!("{begin}\n# counts\n{points} {faces} 0\n\n"),
        };
        for p in &shape.points {
            text += &format!("{} {} {}", p[0], p[1], p[2]);
            text += if has("N") { " 0 0 1" } else { "" };
            text += if has("C") { random.of(&[" 255 0 0 255", " 0.5 0.5 0.5 1"]) } else { "" };
            text += &if has("ST") { format!(" {} {}\n", p[0], p[1]) } else { "\n".to_owned() };
        }
        for face in &shape.faces {
            text += &format!("3 {} {} {}\n", face[0], face[1], face[2]);
        }
        let (mesh, repairs) = parsed(&text, Format::Off);
        assert_eq!(sizes(&mesh), (points, faces));
        assert_eq!(mesh.parameters().is_some(), has("ST"));
        assert!(repairs.is_empty() && (area(&mesh) - shape.area()).abs() <= 1e-12 * shape.area());
        assert_eq!(Format::of_bytes(text.as_bytes()), Some(Format::Off));
    });
    let fourth = read_bytes(b"4OFF\n1 0 0\n0 0 0 1\n", Format::Off, &MeshOptions::default()).unwrap_err();
    assert!(fourth.to_string().contains("'4OFF'"), "{fourth}");
}

#[test]
fn binary_off_is_read() {
    variants(60, |random| {
        let shape = Shape::sheet(random);
        let kind = random.of(&["", "C", "N", "ST", "CN"]);
        let mut bytes = format!("{kind}OFF BINARY\n").into_bytes();
        let mut put = |word: [u8; 4]| bytes.extend(word);
        for count in [shape.points.len(), shape.faces.len(), 0] {
            put((count as i32).to_be_bytes());
        }
        for p in &shape.points {
            p.iter().for_each(|&x| put((x as f32).to_be_bytes()));
            let extra = match kind {
                "C" => 4,
                "N" => 3,
                "CN" => 7,
                _ => 0,
            };
            (0..extra).for_each(|_| put(0.5_f32.to_be_bytes()));
            if kind == "ST" {
                p[..2].iter().for_each(|&x| put((x as f32).to_be_bytes()));
            }
        }
        for face in &shape.faces {
            put(3_i32.to_be_bytes());
            face.iter().for_each(|&node| put((node as i32).to_be_bytes()));
            put(1_i32.to_be_bytes());
            put(0.25_f32.to_be_bytes());
        }
        let (mesh, repairs) = parsed(&bytes, Format::Off);
        assert_eq!(sizes(&mesh), (shape.points.len(), shape.faces.len()));
        assert!(repairs.is_empty() && (area(&mesh) - shape.area()).abs() <= 1e-6 * shape.area());
        assert_eq!(mesh.parameters().is_some(), kind == "ST");
        let header = format!("{kind}OFF BINARY\n").len();
        for size in header..bytes.len() {
            let cut = read_bytes(&bytes[..size], Format::Off, &MeshOptions::default()).unwrap_err();
            assert!(cut.to_string().starts_with("byte "), "{size} bytes: {cut}");
        }
    });
}

#[test]
fn byte_order_marks_are_white_space() {
    assert_eq!(sizes(&reported("bom.obj").0).0, 5);
    variants(8, |random| {
        let (format, shape) = (random.of(&ALL), Shape::sheet(random));
        let mut text = shape.text(format);
        if random.below(2) == 0 {
            text = text.replace('\n', "\r\n");
        }
        let plain = parsed(&text, format);
        assert_eq!(parsed(format!("\u{feff}{text}"), format), plain);
        if format == Format::Obj {
            // glued together from two files
            let nodes = 1 + random.below(shape.points.len() - 1);
            let at = text.match_indices("v ").nth(nodes).unwrap().0;
            assert_eq!(parsed(format!("{}\u{feff}{}", &text[..at], &text[at..]), format), plain);
        }
        let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        for mark in [&b"\xff\xfe"[..], b""] {
            let error = read_bytes(&[mark, &wide].concat(), format, &MeshOptions::default()).unwrap_err();
            assert!(error.to_string().contains("UTF-16"), "{error}");
        }
    });
}

#[test]
fn texts_of_stl_are_taken_as_they_come() {
    let (mesh, repairs) = reported("no_endsolid.stl");
    assert_eq!((mesh.triangles().len(), repairs.missing_end), (1, true));
    let strict = MeshOptions { repair: Repair::NONE, ..MeshOptions::default() };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reported/no_endsolid.stl");
    let refused = read(&path, &strict).unwrap_err();
    assert!(refused.to_string().contains("without 'endsolid'"), "{refused}");
    variants(9, |random| {
        let shape = Shape::sheet(random);
        let whole = shape.text(Format::Stl);
        let mut text = whole.clone();
        let has_end = random.below(2) == 0;
        if !has_end {
            text = text.replace("endsolid s\n", "");
        }
        for (from, to) in [
            ("outer loop", "outer  loop"),
            ("endfacet\n", "endfacet\ncolor 0.5 0.5 0.5\n"),
            ("endloop\n", "endloop\n  attribute 7\n"),
            ("facet normal 0 0 1\n", "facet normal 0 0 1 "),
            ("facet normal 0 0 1", "facet normal nan nan nan"),
        ] {
            if random.below(2) == 0 {
                text = text.replacen(from, to, 1 + random.below(5));
            }
        }
        if random.below(2) == 0 {
            text = text.to_uppercase();
        }
        let ((mesh, repairs), (plain, _)) = (parsed(&text, Format::Stl), parsed(&whole, Format::Stl));
        assert_eq!((mesh.points(), mesh.triangles()), (plain.points(), plain.triangles()));
        assert_eq!(repairs.missing_end, !has_end);
        // half a facet is a fault
        let cut = text.to_lowercase().rfind("vertex").unwrap();
        let error = read_bytes(&text.as_bytes()[..cut], Format::Stl, &MeshOptions::default()).unwrap_err();
        assert!(error.to_string().contains("the file ends within a facet"), "{error}");
    });
}

#[test]
fn faces_without_area_go() {
    for name in ["collapsed.obj", "two_corners.obj"] {
        let (mesh, repairs) = reported(name);
        assert_eq!((mesh.triangles().len(), repairs.dropped_triangles), (1, 1), "{name}");
        assert_eq!(mesh.triangle_origins().collect::<Vec<_>>(), [1], "{name}");
    }
    variants(10, |random| {
        let (format, shape) = (random.of(&INDEXED), Shape::sheet(random));
        let mut broken = shape.clone();
        let count = 1 + random.below(4);
        let mut numbers: Vec<usize> = (0..shape.faces.len()).collect();
        for _ in 0..count {
            let [a, b] = [random.below(shape.points.len()), random.below(shape.points.len())];
            let odd = random.of(&[0, 1, 2, 3]);
            let face = [vec![a, b], vec![a, b, b], vec![a], vec![a, b, a]][odd].clone();
            let place = random.below(broken.faces.len() + 1);
            broken.faces.insert(place, face);
            numbers.iter_mut().filter(|number| **number >= place).for_each(|number| *number += 1);
        }
        let text = broken.text(format);
        let (mesh, repairs) = parsed(&text, format);
        assert_eq!(sizes(&mesh), (shape.points.len(), shape.faces.len()));
        assert_eq!(repairs.dropped_triangles, count);
        assert_eq!(mesh.triangle_origins().map(|face| face as usize).collect::<Vec<_>>(), numbers);
        let sentence = refusal(&text, format);
        assert!(sentence.contains("'corners'"), "{sentence}");
    });
}

#[test]
fn texture_coordinates_that_are_no_parameters_cost_nothing() {
    for name in ["vt_all_equal.obj", "vt_missing.obj"] {
        let (mesh, repairs) = reported(name);
        assert!(mesh.parameters().is_none() && repairs.dropped_parameters, "{name}");
    }
    variants(11, |random| {
        let shape = Shape::sheet(random);
        let (slope, kind) = (random.number(), random.below(6));
        let pair = |node: usize| {
            let p = shape.points[node];
            match kind {
                0 => "0.5 0.5".to_owned(),
                1 => format!("{} {}", p[0], slope),
                2 => format!("{} {}", p[0] / 7.0, slope * p[0] / 7.0),
                3 => format!("{} nan", p[0]),
                4 => "a,b c".to_owned(),
                _ => format!("{} {}", p[0], p[1]),
            }
        };
        let mut text: String =
            shape.points.iter().map(|p| format!("v {} {} {}\n", p[0], p[1], p[2])).collect();
        // kind 5: the faces name what is not there
        let count = if kind == 5 { random.below(3) } else { shape.points.len() };
        (0..count).for_each(|node| text += &format!("vt {}\n", pair(node)));
        for face in &shape.faces {
            let corners: Vec<String> = face.iter().map(|node| format!("{0}/{0}", node + 1)).collect();
            text += &format!("f {}\n", corners.join(" "));
        }
        let (mesh, repairs) = parsed(&text, Format::Obj);
        assert_eq!(sizes(&mesh), (shape.points.len(), shape.faces.len()));
        assert!(mesh.parameters().is_none() && repairs.dropped_parameters, "kind {kind}");
    });
}

#[test]
fn nodes_where_the_surface_touches_itself_are_parted() {
    let (mesh, repairs) = reported("bowtie.off");
    assert_eq!((repairs.split_nodes, mesh.pinched_nodes().len()), (1, 0));
    variants(15, |random| {
        let (m, n) = (4 + random.below(3), 4 + random.below(3));
        let (format, shape) = (random.of(&INDEXED), Shape::sheet_of(m, n, random));
        // two opposite triangles of the six around a node go whose neighbours lie inside too
        let inner = 2 * (m + 1) + 2 + random.below(m - 3);
        let around: Vec<usize> =
            (0..shape.faces.len()).filter(|&f| shape.faces[f].contains(&inner)).collect();
        let first = random.of(&around);
        let touches = |&&f: &&usize| {
            shape.faces[f].iter().filter(|node| shape.faces[first].contains(node)).count() == 1
        };
        let apart: Vec<usize> = around.iter().filter(touches).copied().collect();
        let second = random.of(&apart);
        let mut holed = shape.clone();
        holed.faces = (0..shape.faces.len())
            .filter(|f| *f != first && *f != second)
            .map(|f| shape.faces[f].clone())
            .collect();
        let text = holed.text(format);
        let (mesh, repairs) = parsed(&text, format);
        assert_eq!(sizes(&mesh), (shape.points.len() + 1, holed.faces.len()));
        assert_eq!((repairs.split_nodes, mesh.node_origins().last()), (1, Some(inner as u32)));
        assert!(mesh.pinched_nodes().is_empty());
        let sentence = refusal(&text, format);
        assert!(sentence.contains(&format!("node {inner}")) && sentence.contains("'touching'"), "{sentence}");
    });
}

#[test]
fn neighbours_that_disagree_are_turned_over() {
    let (_, repairs) = reported("flipped.obj");
    assert_eq!(repairs.flipped_triangles, 1);
    variants(16, |random| {
        let (format, shape) = (random.of(&INDEXED), Shape::sheet(random));
        let mut turned = shape.clone();
        let count = 1 + random.below(shape.faces.len() / 3);
        let from = random.below(shape.faces.len() - count);
        turned.faces[from..from + count].iter_mut().for_each(|face| face.reverse());
        let text = turned.text(format);
        let (mesh, repairs) = parsed(&text, format);
        assert_eq!((repairs.flipped_triangles, mesh.loops().len()), (count, 1));
        let sentence = refusal(&text, format);
        assert!(sentence.contains("same direction") && sentence.contains("'orientation'"), "{sentence}");
    });
}

#[test]
fn lines_may_end_with_cr_alone() {
    assert_eq!(reported("cr.obj").0.triangles().len(), 1);
    variants(18, |random| {
        let (format, shape) = (random.of(&ALL), Shape::sheet(random));
        let text = shape.text(format);
        let plain = parsed(&text, format);
        for end in ["\r", "\r\n"] {
            assert_eq!(parsed(text.replace('\n', end), format), plain);
        }
        let (before, after) = text.rsplit_once('0').unwrap();
        let fault = format!("{before}zero{after}").replace('\n', "\r");
        let error = read_bytes(fault.as_bytes(), format, &MeshOptions::default()).unwrap_err();
        assert!(error.to_string().contains("line "), "{error}");
    });
    // numbers of a binary file that look like the end of a line
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
                  property uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
    for end in ["\n", "\r\n", "\r"] {
        let mut bytes = header.replace('\n', end).into_bytes();
        bytes.extend([10, 13, 10, 11, 0, 0, 0, 12, 0, 3, 0, 1, 2]);
        let (mesh, _) = parsed(&bytes, Format::Ply);
        assert_eq!(mesh.points()[0], DVec3::new(10.0, 13.0, 10.0), "{end:?}");
    }
}

#[test]
fn point_clouds_are_told_what_is_missing() {
    variants(20, |random| {
        let (format, mut shape) = (random.of(&INDEXED), Shape::sheet(random));
        shape.faces.clear();
        let error = read_bytes(shape.text(format).as_bytes(), format, &MeshOptions::default()).unwrap_err();
        let sentence = error.to_string();
        assert!(sentence.contains(&format!("{} points but no triangles", shape.points.len())), "{sentence}");
    });
}

#[test]
fn packed_files_are_unpacked_within_the_limit() {
    use flate2::{Compression, write::GzEncoder};
    use std::io::Write;
    variants(21, |random| {
        let (format, shape) = (random.of(&ALL), Shape::sheet(random));
        let text = shape.text(format);
        let mut packer = GzEncoder::new(Vec::new(), Compression::default());
        packer.write_all(text.as_bytes()).unwrap();
        let packed = packer.finish().unwrap();
        assert_eq!(parsed(&packed, format), parsed(&text, format));
        let cut = read_bytes(&packed[..packed.len() / 2], format, &MeshOptions::default()).unwrap_err();
        assert!(cut.to_string().contains("unpacked"), "{cut}");
        let options = MeshOptions { max_memory: text.len() as u64 - 1, ..MeshOptions::default() };
        let error = read_bytes(&packed, format, &options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TooLarge, "{error}");
    });
}

#[test]
fn components_are_picked_from_files_too() {
    variants(22, |random| {
        let (format, small, large) = (random.of(&INDEXED), Shape::sheet(random), Shape::sheet(random));
        let (small, large) =
            if small.faces.len() > large.faces.len() { (large, small) } else { (small, large) };
        let count = small.points.len();
        let mut both = small.clone();
        both.points.extend(large.points.iter().map(|p| [p[0] + 100.0, p[1], p[2]]));
        both.faces
            .extend(large.faces.iter().map(|face| face.iter().map(|node| node + count).collect::<Vec<_>>()));
        if small.faces.len() == large.faces.len() {
            return;
        }
        let options = MeshOptions::default().with_components(Components::Largest);
        let (mesh, repairs) = read_bytes(both.text(format).as_bytes(), format, &options).unwrap();
        assert_eq!((mesh.component_count(), mesh.triangles().len()), (1, large.faces.len()));
        assert_eq!((repairs.excluded_triangles, mesh.points().len()), (small.faces.len(), both.points.len()));
        assert!(mesh.triangle_origins().eq(small.faces.len() as u32..both.faces.len() as u32));
    });
}
