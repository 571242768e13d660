//! OFF: a header word, counts of nodes, faces and edges, one node a line, one face a line.
//!
//! Letters before `OFF` say what follows the coordinates of a node: `N` a normal, `C` a colour, `ST` two
//! texture coordinates at the end, which become parameters. Colours behind faces are passed over.

use super::scanner::{Scanner, shown};
use super::{ReadError, Soup};
use glam::{DVec2, DVec3};

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, Some(b'#'));
    let has_texture = read_header(&mut scanner)?;
    let point_count = scanner.count("the number of nodes")?;
    let face_count = scanner.count("the number of faces")?;
    scanner.next_line(); // and the number of edges, which nobody needs
    scanner.check_room(point_count, "0 0 0\n".len(), "nodes")?;
    scanner.check_room(face_count, "0\n".len(), "faces")?;

    let mut soup = Soup { points: Vec::with_capacity(point_count), ..Soup::default() };
    let mut parameters = Vec::new();
    for _ in 0..point_count {
        let x = scanner.number("a coordinate")?;
        let y = scanner.number_in_line("a coordinate")?;
        let z = scanner.number_in_line("a coordinate")?;
        soup.points.push(DVec3::new(x, y, z));
        if has_texture {
            parameters.push(read_texture(&mut scanner)?);
        }
        scanner.next_line();
    }
    for _ in 0..face_count {
        let corner_count = scanner.count("the number of corners")?;
        for _ in 0..corner_count {
            let node = scanner.count("a node of the face")?;
            if node >= point_count {
                return Err(scanner.error(format!("the face refers to node {node} of {point_count}")));
            }
            soup.faces.push(node as u32);
        }
        soup.faces.end_face();
        scanner.next_line();
    }
    soup.parameters = has_texture.then_some(parameters);
    Ok(soup)
}

/// Reads the header word; files that begin with their counts have none. Says whether nodes have texture.
fn read_header(scanner: &mut Scanner) -> Result<bool, ReadError> {
    let mut ahead = Scanner::new(scanner.rest(), Some(b'#'));
    let Some(word) = ahead.word() else { return Err(ahead.error("the file is empty")) };
    let Some(letters) = word.strip_suffix(b"OFF") else {
        return match word.iter().all(u8::is_ascii_digit) {
            true => Ok(false),
            false => Err(ahead.error(format!("an OFF file does not begin with '{}'", shown(word)))),
        };
    };
    scanner.word();
    let (has_texture, letters) = match letters.strip_prefix(b"ST") {
        Some(rest) => (true, rest),
        None => (false, letters),
    };
    if !matches!(letters, b"" | b"C" | b"N" | b"CN") {
        return Err(ahead.error(format!("nodes of the kind '{}' are not known", shown(word))));
    }
    if ahead.word_in_line() == Some(b"BINARY") {
        return Err(ahead.error("binary OFF is not supported"));
    }
    Ok(has_texture)
}

/// The last two numbers of the line.
fn read_texture(scanner: &mut Scanner) -> Result<DVec2, ReadError> {
    let mut last = DVec2::new(scanner.number_in_line("s")?, scanner.number_in_line("t")?);
    while let Some(word) = scanner.word_in_line() {
        let value = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        let value = value.ok_or_else(|| scanner.error(format!("'{}' is not a number", shown(word))))?;
        last = DVec2::new(last.y, value);
    }
    Ok(last)
}
