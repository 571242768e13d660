//! Wavefront OBJ: `v`, `vt` and `f` lines; everything else is passed over.
//!
//! Corners are `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or backwards from -1 for the last so far.

use super::scanner::{Scanner, shown};
use super::{ReadError, Soup};
use glam::{DVec2, DVec3};

/// Stands for a corner without `vt`.
const NONE: u32 = u32::MAX;

/// A largest index and the line it stands on: files may refer to what comes later.
type Farthest = (u32, usize);

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, Some(b'#'));
    let mut soup = Soup::default();
    let mut textures: Vec<DVec2> = Vec::new();
    let mut corner_textures: Vec<u32> = Vec::new();
    let mut farthest: [Farthest; 2] = [(0, 0); 2];
    loop {
        match scanner.word_in_line() {
            Some(b"v") => {
                let x = scanner.number_in_line("x")?;
                let y = scanner.number_in_line("y")?;
                let z = scanner.number_in_line("z")?;
                soup.points.push(DVec3::new(x, y, z)); // a weight or a colour may follow
            }
            Some(b"vt") => {
                let u = scanner.number_in_line("u")?;
                let v = match scanner.word_in_line() {
                    Some(word) => std::str::from_utf8(word).ok().and_then(|text| text.parse().ok()),
                    None => Some(0.0),
                };
                textures.push(DVec2::new(u, v.ok_or_else(|| scanner.error("v should be a number"))?));
            }
            Some(b"f") => {
                let before = soup.faces.corners().len();
                while let Some(word) = scanner.word_in_line() {
                    let mut parts = word.split(|&byte| byte == b'/');
                    let node = parts.next().unwrap_or_default();
                    let node = index(&scanner, node, soup.points.len(), "node", &mut farthest[0])?;
                    let texture = match parts.next() {
                        None | Some(b"") => NONE,
                        Some(part) => index(&scanner, part, textures.len(), "vt", &mut farthest[1])?,
                    };
                    soup.faces.push(node);
                    corner_textures.push(texture);
                }
                match soup.faces.corners().len() - before {
                    0..3 => return Err(scanner.error("a face needs three corners")),
                    _ => soup.faces.end_face(),
                }
            }
            _ => {}
        }
        if !scanner.next_line() {
            break;
        }
    }
    for ((last, line), count, what) in
        [(farthest[0], soup.points.len(), "node"), (farthest[1], textures.len(), "vt")]
    {
        if last as usize > count {
            let problem = format!("the face refers to {what} {last} of {count}");
            return Err(ReadError::Text { line, problem });
        }
    }
    if corner_textures.iter().any(|&texture| texture != NONE) {
        soup.parameters = parameters(&soup, &textures, &corner_textures);
        soup.dropped_parameters = soup.parameters.is_none();
    }
    Ok(soup)
}

/// The place, from 0, that an index of a face names.
fn index(
    scanner: &Scanner,
    word: &[u8],
    count: usize,
    what: &str,
    farthest: &mut Farthest,
) -> Result<u32, ReadError> {
    let value: Option<i64> = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    let value = value.ok_or_else(|| scanner.error(format!("'{}' is no index", shown(word))))?;
    let place = if value < 0 { value.checked_add(count as i64) } else { value.checked_sub(1) };
    let place = place.and_then(|place| u32::try_from(place).ok()).filter(|&place| place < NONE);
    let place =
        place.ok_or_else(|| scanner.error(format!("the face refers to {what} {value} of {count}")))?;
    if place + 1 > farthest.0 {
        *farthest = (place + 1, scanner.line);
    }
    Ok(place)
}

/// The one `vt` of each node; none if a node of a face has several, or has none.
fn parameters(soup: &Soup, textures: &[DVec2], corner_textures: &[u32]) -> Option<Vec<DVec2>> {
    let mut of_node = vec![NONE; soup.points.len()];
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
    Some(of_node.iter().map(|&texture| textures.get(texture as usize).copied().unwrap_or(any)).collect())
}
