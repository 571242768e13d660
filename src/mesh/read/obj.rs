//! Wavefront OBJ: `v`, `vt` and `f` lines; everything else is passed over.
//!
//! Corners are `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or backwards from -1 for the last so far. Texture
//! coordinates are a gift: if those of a face are missing or no numbers there are no parameters, but a mesh there is.

use super::scanner::{Scanner, parse, shown};
use super::{ReadError, Soup};
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec3};

/// Stands for a corner without `vt`.
const NONE: u32 = u32::MAX;

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, Some(b'#'));
    let mut soup = Soup::default();
    let mut textures: Vec<DVec2> = Vec::new();
    let mut corner_textures: Vec<u32> = Vec::new();
    // the largest node of a face and its line: files may refer to what comes later
    let mut farthest = (0, 0);
    loop {
        match scanner.word_in_line() {
            Some(b"v") => {
                let x = scanner.number_in_line("x")?;
                let y = scanner.number_in_line("y")?;
                let z = scanner.number_in_line("z")?;
                memory::push(&mut soup.points, DVec3::new(x, y, z)); // a weight or a colour may follow
            }
            Some(b"vt") => {
                let mut number = || scanner.word_in_line().map(|word| parse(word).unwrap_or(f64::NAN));
                memory::push(
                    &mut textures,
                    DVec2::new(number().unwrap_or(f64::NAN), number().unwrap_or(0.0)),
                );
            }
            Some(b"f" | b"fo") => {
                while let Some(word) = scanner.word_in_line() {
                    let mut parts = word.split(|&byte| byte == b'/');
                    let node = parts.next().unwrap_or_default();
                    let node = node_index(&scanner, node, soup.points.len())?;
                    if node >= farthest.0 {
                        farthest = (node + 1, scanner.line);
                    }
                    let texture = parts.next().and_then(parse).and_then(|index| place(index, textures.len()));
                    soup.faces.push(node);
                    memory::push(&mut corner_textures, texture.unwrap_or(NONE));
                }
                soup.faces.end_face();
                corner_textures.truncate(soup.faces.corners().len());
            }
            _ => {}
        }
        if !scanner.next_line() {
            break;
        }
    }
    let ((last, line), count) = (farthest, soup.points.len());
    if last as usize > count {
        return Err(ReadError::Text { line, problem: format!("the face refers to node {last} of {count}") });
    }
    if corner_textures.iter().any(|&texture| texture != NONE) {
        soup.parameters = parameters(&soup, &textures, &corner_textures);
        soup.dropped_parameters = soup.parameters.is_none();
    }
    Ok(soup)
}

/// The place, from 0, of the node that a face names.
fn node_index(scanner: &Scanner, word: &[u8], count: usize) -> Result<u32, ReadError> {
    let index = parse(word).ok_or_else(|| scanner.error(format!("'{}' is no index", shown(word))))?;
    place(index, count).ok_or_else(|| scanner.error(format!("the face refers to node {index} of {count}")))
}

/// The place, from 0, that an index of a face names when `count` things are known.
fn place(index: i64, count: usize) -> Option<u32> {
    let place = if index < 0 { index.checked_add(count as i64) } else { index.checked_sub(1) };
    place.and_then(|place| u32::try_from(place).ok()).filter(|&place| place < NONE)
}

/// The one `vt` of each node; none if a node of a face has several, or has none.
fn parameters(soup: &Soup, textures: &[DVec2], corner_textures: &[u32]) -> Option<Vec<DVec2>> {
    let mut of_node = memory::filled(NONE, soup.points.len());
    for (&node, &texture) in soup.faces.corners().iter().zip(corner_textures) {
        let known = &mut of_node[node as usize];
        let value = textures.get(texture as usize)?;
        match *known {
            NONE => *known = texture,
            other if textures[other as usize] == *value => {}
            _ => return None,
        }
    }
    // nodes without a face get some parameter that leaves the range as it is
    let any = *textures.get(*corner_textures.first()? as usize)?;
    Some(of_node.iter().map(|&texture| textures.get(texture as usize).copied().unwrap_or(any)).collect_vec())
}
