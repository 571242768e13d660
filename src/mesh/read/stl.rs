//! STL: triangles by their corners, as text or as 50 bytes each.
//!
//! Binary files may begin with `solid` too, so their size decides first: 84 bytes and 50 for each triangle.
//! Normals are passed over, the order of the corners says which side is out. Lines of a text that are not known, such as
//! colours, are passed over between facets and within one, but not within its loop. A text may end without `endsolid`
//! after a whole facet, which is told.

use super::scanner::{Scanner, shown};
use super::{ReadError, Soup};
use crate::memory;
use glam::DVec3;

/// A name of 80 bytes and the number of triangles.
const HEADER_SIZE: usize = 84;
/// A normal, three corners, two spare bytes.
const TRIANGLE_SIZE: usize = 50;

/// Whether the size is exactly what the number of triangles asks for.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let size = |count: u32| HEADER_SIZE as u64 + u64::from(count) * TRIANGLE_SIZE as u64;
    triangle_count(bytes).is_some_and(|count| bytes.len() as u64 == size(count))
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let start = bytes.trim_ascii_start();
    let begins = |word: &[u8]| start.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    let is_text = (begins(b"solid") || begins(b"facet")) && !bytes.iter().take(512).any(|&byte| byte == 0);
    if is_text && !is_binary(bytes) { read_text(bytes) } else { read_binary(bytes) }
}

fn triangle_count(bytes: &[u8]) -> Option<u32> {
    let header: &[u8; HEADER_SIZE] = bytes.first_chunk()?;
    header.last_chunk().map(|count| u32::from_le_bytes(*count))
}

fn read_binary(bytes: &[u8]) -> Result<Soup, ReadError> {
    let short = |problem: String| ReadError::Binary { byte: bytes.len(), problem };
    let count = triangle_count(bytes)
        .ok_or_else(|| short(format!("the file ends within its header of {HEADER_SIZE} bytes")))?;
    let body = &bytes[HEADER_SIZE..];
    if body.len() / TRIANGLE_SIZE < count as usize {
        return Err(short(format!("the file ends before the last of its {count} triangles")));
    }
    let mut soup = Soup { points: memory::with_capacity(3 * count as usize), ..Soup::default() };
    soup.faces.reserve(count as usize);
    for record in body.chunks_exact(TRIANGLE_SIZE).take(count as usize) {
        let corners = record[12..48].as_chunks::<12>().0;
        for corner in corners {
            let numbers = corner.as_chunks::<4>().0;
            let [x, y, z] = [0, 1, 2].map(|axis| f64::from(f32::from_le_bytes(numbers[axis])));
            add_corner(&mut soup, DVec3::new(x, y, z));
        }
        soup.faces.end_face();
    }
    Ok(soup)
}

fn read_text(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, None);
    let mut soup = Soup::default();
    let mut place = Place::Outside;
    while let Some(word) = scanner.word() {
        place = match (word.to_ascii_lowercase().as_slice(), place) {
            (b"solid", Place::Outside | Place::Solid) => {
                scanner.skip_line(); // its name may hold anything
                Place::Solid
            }
            (b"endsolid", Place::Solid) => {
                scanner.skip_line();
                Place::Outside
            }
            (b"facet", Place::Outside | Place::Solid) => Place::Facet,
            (b"outer", Place::Facet) => {
                if !scanner.word().is_some_and(|word| word.eq_ignore_ascii_case(b"loop")) {
                    return Err(scanner.error("'loop' should follow 'outer'"));
                }
                Place::Loop(0)
            }
            (b"vertex", Place::Loop(count)) => {
                let x = scanner.number("x")?;
                let y = scanner.number("y")?;
                let z = scanner.number("z")?;
                add_corner(&mut soup, DVec3::new(x, y, z));
                Place::Loop(count + 1)
            }
            (b"endloop", Place::Loop(count)) => {
                if count < 3 {
                    return Err(scanner.error(format!("a facet has {count} corners, it needs three")));
                }
                soup.faces.end_face();
                Place::AfterLoop
            }
            (b"endfacet", Place::AfterLoop) => Place::Solid,
            (
                b"solid" | b"endsolid" | b"facet" | b"outer" | b"vertex" | b"endloop" | b"endfacet"
                | b"inner",
                _,
            )
            | (_, Place::Loop(_)) => {
                return Err(scanner.error(format!("'{}' should not stand here", shown(word))));
            }
            (b"normal", Place::Facet) => {
                for _ in 0..3 {
                    scanner.word_in_line(); // passed over, may be missing
                }
                Place::Facet
            }
            (_, Place::Outside) => {
                return Err(scanner.error(format!("'{}' should not stand here", shown(word))));
            }
            (_, place) => {
                scanner.skip_line(); // a colour or another program's remark
                place
            }
        }
    }
    match place {
        Place::Facet | Place::Loop(_) => return Err(scanner.error("the file ends within a facet")),
        _ if soup.points.is_empty() => return Err(scanner.error("the file ends before its first facet")),
        Place::Solid | Place::AfterLoop => soup.missing_end = true,
        Place::Outside => {}
    }
    Ok(soup)
}

/// Where in the text a word stands.
#[derive(Clone, Copy)]
enum Place {
    Outside,
    Solid,
    Facet,
    /// So many corners were read.
    Loop(usize),
    AfterLoop,
}

fn add_corner(soup: &mut Soup, point: DVec3) {
    soup.faces.push(soup.points.len() as u32); // more corners than that are refused with the mesh
    memory::push(&mut soup.points, point);
}
