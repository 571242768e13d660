//! PLY: a header in text that describes elements and their properties, then rows of numbers.
//!
//! Nodes are the element `vertex` with x, y, z. A pair (u,v), (s,t), (texture_u,texture_v) or
//! (texture_s,texture_t) becomes parameters, every other number a field. Faces are the lists
//! `vertex_indices` or `vertex_index` of the element `face`, or of `tristrips`: there each node makes a triangle with
//! the two before it, every second one turned over, and -1 begins a new strip. The rest is passed over.

use super::scanner::{Scanner, shown};
use super::{Faces, Field, ReadError, Soup};
use crate::memory;
use glam::{DVec2, DVec3};

/// Names of parameter pairs, the best first.
const PARAMETERS: [[&str; 2]; 4] =
    [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, None);
    let (encoding, elements) = read_header(&mut scanner)?;
    match encoding {
        Encoding::Ascii => read_body(&mut Text(scanner), &elements),
        Encoding::LittleEndian => {
            read_body(&mut Binary::<false> { bytes, position: scanner.position() }, &elements)
        }
        Encoding::BigEndian => {
            read_body(&mut Binary::<true> { bytes, position: scanner.position() }, &elements)
        }
    }
}

/// A number of each face by its name.
pub(super) fn face_property(bytes: &[u8], name: &str) -> Result<Vec<f64>, ReadError> {
    let mut scanner = Scanner::new(bytes, None);
    let (encoding, elements) = read_header(&mut scanner)?;
    match encoding {
        Encoding::Ascii => read_face_property(&mut Text(scanner), &elements, name),
        Encoding::LittleEndian => {
            let mut source = Binary::<false> { bytes, position: scanner.position() };
            read_face_property(&mut source, &elements, name)
        }
        Encoding::BigEndian => {
            let mut source = Binary::<true> { bytes, position: scanner.position() };
            read_face_property(&mut source, &elements, name)
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

#[derive(Debug)]
struct Property {
    name: String,
    kind: Kind,
    /// The type of a list's length; none for a single number.
    length: Option<Kind>,
}

#[derive(Debug)]
struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

fn read_header(scanner: &mut Scanner) -> Result<(Encoding, Vec<Element>), ReadError> {
    if scanner.word() != Some(b"ply") {
        return Err(scanner.error("a PLY file begins with 'ply'"));
    }
    // numbers may begin with a byte that looks like the other half of a line's end
    let ends_in_cr = matches!(scanner.rest(), [b'\r', next, ..] if *next != b'\n');
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let Some(word) = scanner.word() else {
            return Err(scanner.error("the file ends before 'end_header'"));
        };
        match word {
            b"comment" | b"obj_info" => {}
            b"format" => {
                encoding = Some(match scanner.word_in_line() {
                    Some(b"ascii") => Encoding::Ascii,
                    Some(b"binary_little_endian") => Encoding::LittleEndian,
                    Some(b"binary_big_endian") => Encoding::BigEndian,
                    other => {
                        let name = shown(other.unwrap_or_default());
                        return Err(scanner.error(format!("the format '{name}' is not known")));
                    }
                });
            }
            b"element" => {
                let name = read_name(scanner)?;
                let count = scanner.count("the number of rows")?;
                memory::push(&mut elements, Element { name, count, properties: Vec::new() });
            }
            b"property" => {
                let property = read_property(scanner)?;
                let Some(element) = elements.last_mut() else {
                    return Err(scanner.error("a property stands before the first element"));
                };
                memory::push(&mut element.properties, property);
            }
            b"end_header" => {
                scanner.skip_line_as(ends_in_cr);
                break;
            }
            _ => return Err(scanner.error(format!("'{}' is no part of a header", shown(word)))),
        }
        scanner.skip_line();
    }
    let encoding = encoding.ok_or_else(|| scanner.error("the header names no format"))?;
    Ok((encoding, elements))
}

fn read_name(scanner: &mut Scanner) -> Result<String, ReadError> {
    match scanner.word_in_line() {
        Some(name) => Ok(String::from_utf8_lossy(name).into_owned()),
        None => Err(scanner.error("a name is missing")),
    }
}

fn read_property(scanner: &mut Scanner) -> Result<Property, ReadError> {
    let kind = |scanner: &mut Scanner, word: Option<&[u8]>| {
        let word = word.unwrap_or_default();
        Kind::of_name(word).ok_or_else(|| scanner.error(format!("the type '{}' is not known", shown(word))))
    };
    let first = scanner.word_in_line();
    let length = match first {
        Some(b"list") => {
            let word = scanner.word_in_line();
            Some(kind(scanner, word)?)
        }
        _ => None,
    };
    let word = if length.is_some() { scanner.word_in_line() } else { first };
    let kind = kind(scanner, word)?;
    Ok(Property { name: read_name(scanner)?, kind, length })
}

/// Where the numbers of the rows come from.
trait Source {
    fn number(&mut self, kind: Kind) -> Result<f64, ReadError>;
    /// Fails unless this many rows of at least these properties can follow.
    fn check_room(&self, count: usize, element: &Element) -> Result<(), ReadError>;
    /// A fault of the number read last.
    fn error(&self, problem: String) -> ReadError;
}

struct Text<'a>(Scanner<'a>);

impl Source for Text<'_> {
    fn number(&mut self, _: Kind) -> Result<f64, ReadError> {
        self.0.number("a property")
    }

    fn check_room(&self, count: usize, element: &Element) -> Result<(), ReadError> {
        self.0.check_room(
            count,
            "0\n".len() * element.properties.len(),
            &format!("rows of '{}'", element.name),
        )
    }

    fn error(&self, problem: String) -> ReadError {
        self.0.error(problem)
    }
}

struct Binary<'a, const BIG_ENDIAN: bool> {
    bytes: &'a [u8],
    position: usize,
}

impl<const BIG_ENDIAN: bool> Binary<'_, BIG_ENDIAN> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ReadError> {
        let Some(&(mut word)) = self.bytes.get(self.position..).and_then(<[u8]>::first_chunk) else {
            return Err(self.error("the file ends within a number".to_owned()));
        };
        self.position += N;
        if BIG_ENDIAN {
            word.reverse();
        }
        Ok(word)
    }
}

impl<const BIG_ENDIAN: bool> Source for Binary<'_, BIG_ENDIAN> {
    #[inline]
    fn number(&mut self, kind: Kind) -> Result<f64, ReadError> {
        Ok(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Kind::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Kind::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn check_room(&self, count: usize, element: &Element) -> Result<(), ReadError> {
        let row_size: usize = element.properties.iter().map(|p| p.length.unwrap_or(p.kind).size()).sum();
        let rest = self.bytes.len() - self.position;
        if count > rest / row_size {
            let name = &element.name;
            return Err(self.error(format!("{count} rows of '{name}' cannot stand in the {rest} bytes left")));
        }
        Ok(())
    }

    fn error(&self, problem: String) -> ReadError {
        ReadError::Binary { byte: self.position, problem }
    }
}

fn read_body(source: &mut impl Source, elements: &[Element]) -> Result<Soup, ReadError> {
    let mut soup = Soup::default();
    let rows = || elements.iter().filter(|element| !element.properties.is_empty());
    let point_count = rows().find(|element| element.name == "vertex").map_or(0, |vertex| vertex.count);
    let mut has_points = false;
    let mut has_faces = false;
    for element in rows() {
        source.check_room(element.count, element)?;
        match element.name.as_str() {
            "vertex" if !has_points => {
                read_points(source, element, &mut soup)?;
                has_points = true;
            }
            "face" | "tristrips" => {
                let is_strips = element.name == "tristrips";
                read_faces(source, element, point_count, is_strips, &mut soup.faces)?;
                has_faces = element.count > 0;
            }
            _ => {
                for _ in 0..element.count {
                    element.properties.iter().try_for_each(|property| skip(source, property))?;
                }
            }
        }
        if has_points && has_faces {
            break; // what follows is not for us
        }
    }
    Ok(soup)
}

fn read_face_property(
    source: &mut impl Source,
    elements: &[Element],
    name: &str,
) -> Result<Vec<f64>, ReadError> {
    for element in elements.iter().filter(|element| !element.properties.is_empty()) {
        source.check_room(element.count, element)?;
        let is_asked = |property: &Property| property.name == name && property.length.is_none();
        let asked = element.properties.iter().position(is_asked).filter(|_| element.name == "face");
        let mut values = Vec::with_capacity(if asked.is_some() { element.count } else { 0 });
        for _ in 0..element.count {
            for (place, property) in element.properties.iter().enumerate() {
                match asked {
                    Some(asked) if asked == place => values.push(source.number(property.kind)?),
                    _ => skip(source, property)?,
                }
            }
        }
        if asked.is_some() {
            return Ok(values);
        }
    }
    Err(source.error(format!("the faces have no number '{name}'")))
}

fn skip(source: &mut impl Source, property: &Property) -> Result<(), ReadError> {
    let length = match property.length {
        Some(kind) => read_length(source, kind)?,
        None => 1,
    };
    (0..length).try_for_each(|_| source.number(property.kind).map(|_| ()))
}

fn read_length(source: &mut impl Source, kind: Kind) -> Result<usize, ReadError> {
    let length = source.number(kind)?;
    match length.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&length) {
        true => Ok(length as usize),
        false => Err(source.error(format!("a list cannot have {length} entries"))),
    }
}

/// What becomes of a property of a node.
#[derive(Clone, Copy)]
enum Role {
    Coordinate(usize),
    Parameter(usize),
    Field(usize),
    List,
}

fn read_points(source: &mut impl Source, element: &Element, soup: &mut Soup) -> Result<(), ReadError> {
    let number = |name: &str| element.properties.iter().any(|p| p.name == name && p.length.is_none());
    if let Some(missing) = ["x", "y", "z"].into_iter().find(|name| !number(name)) {
        return Err(source.error(format!("the nodes have no '{missing}'")));
    }
    let pair = PARAMETERS.into_iter().find(|pair| pair.iter().all(|name| number(name)));
    let mut roles = Vec::new();
    for property in &element.properties {
        let place = |names: &[&str]| names.iter().position(|&name| name == property.name);
        roles.push(if property.length.is_some() {
            Role::List
        } else if let Some(axis) = place(&["x", "y", "z"]) {
            Role::Coordinate(axis)
        } else if let Some(axis) = pair.and_then(|pair| place(&pair)) {
            Role::Parameter(axis)
        } else {
            let values = memory::with_capacity(element.count);
            memory::push(&mut soup.fields, Field { name: property.name.clone(), values });
            Role::Field(soup.fields.len() - 1)
        });
    }
    let mut parameters = memory::with_capacity(if pair.is_some() { element.count } else { 0 });
    soup.points.reserve(element.count);
    for _ in 0..element.count {
        let (mut point, mut uv) = ([0.0; 3], [0.0; 2]);
        for (property, &role) in element.properties.iter().zip(&roles) {
            match role {
                Role::Coordinate(axis) => point[axis] = source.number(property.kind)?,
                Role::Parameter(axis) => uv[axis] = source.number(property.kind)?,
                Role::Field(field) => soup.fields[field].values.push(source.number(property.kind)?),
                Role::List => skip(source, property)?,
            }
        }
        memory::push(&mut soup.points, DVec3::from_array(point));
        if pair.is_some() {
            memory::push(&mut parameters, DVec2::from_array(uv));
        }
    }
    soup.parameters = pair.map(|_| parameters);
    Ok(())
}

fn read_faces(
    source: &mut impl Source,
    element: &Element,
    point_count: usize,
    is_strips: bool,
    faces: &mut Faces,
) -> Result<(), ReadError> {
    let is_nodes = |property: &Property| {
        property.length.is_some() && ["vertex_indices", "vertex_index"].contains(&property.name.as_str())
    };
    let Some(nodes) = element.properties.iter().position(is_nodes) else {
        return Err(source.error("the faces have no list 'vertex_indices'".to_owned()));
    };
    faces.reserve(element.count);
    for _ in 0..element.count {
        for (i, property) in element.properties.iter().enumerate() {
            let Some(length) = property.length.filter(|_| i == nodes) else {
                skip(source, property)?;
                continue;
            };
            let mut strip = Strip::default();
            for _ in 0..read_length(source, length)? {
                let node = source.number(property.kind)?;
                if is_strips && ends_strip(node, property.kind) {
                    strip = Strip::default();
                } else if !(node >= 0.0 && node < point_count as f64 && node.fract() == 0.0) {
                    return Err(source.error(format!("the face refers to node {node} of {point_count}")));
                } else if is_strips {
                    strip.push(node as u32, faces);
                } else {
                    faces.push(node as u32);
                }
            }
            if !is_strips {
                faces.end_face();
            }
        }
    }
    Ok(())
}

/// Whether a number is the -1 that ends a strip, also where the type has no signs.
fn ends_strip(node: f64, kind: Kind) -> bool {
    node == -1.0 || (kind == Kind::U32 && node == f64::from(u32::MAX))
}

/// The triangles of a strip, node by node.
/// ```text
///   1---3---5    0 1 2, then 1 3 2 (not 1 2 3, which turns the other way), 2 3 4, 3 5 4
///  / \ / \ / \
/// 0---2---4---6
/// ```
#[derive(Default)]
struct Strip {
    last: [u32; 2],
    count: usize,
}

impl Strip {
    fn push(&mut self, node: u32, faces: &mut Faces) {
        let [a, b] = self.last;
        // programs join strips by nodes that come twice: these triangles are meant to vanish
        if self.count >= 2 && a != b && b != node && node != a {
            let corners = if self.count.is_multiple_of(2) { [a, b, node] } else { [b, a, node] };
            corners.into_iter().for_each(|corner| faces.push(corner));
            faces.end_face();
        }
        self.last = [b, node];
        self.count += 1;
    }
}
