//! OFF: a header word, counts of nodes, faces and edges, one node a line, one face a line.
//!
//! Letters before `OFF` say what follows the coordinates of a node, whatever their order: `N` a normal, `C` a colour,
//! `ST` two texture coordinates at the end, which become parameters. Colours behind faces are passed over. The word
//! `BINARY` behind the header says that big-endian numbers of four bytes follow: counts and indices are integers, all
//! others floating-point numbers, and a colour has four of them.

use super::scanner::{Scanner, parse, shown};
use super::{ReadError, Soup};
use crate::memory;
use glam::{DVec2, DVec3};

/// What nodes have beside their coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Kind {
    has_texture: bool,
    has_color: bool,
    has_normal: bool,
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut scanner = Scanner::new(bytes, Some(b'#'));
    let (kind, is_binary) = read_header(&mut scanner)?;
    if is_binary { read_binary(bytes, scanner.position(), kind) } else { read_text(scanner, kind) }
}

/// What a word of the form `STNCOFF` says, and the digits that other programs glue to it; none if it is none.
pub(super) fn header(word: &[u8]) -> Option<(Kind, &[u8])> {
    let digits = word.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    let (word, count) = word.split_at(word.len() - digits);
    if word == b"off" {
        return Some((Kind::default(), count));
    }
    let mut letters = word.strip_suffix(b"OFF")?;
    let mut kind = Kind::default();
    while !letters.is_empty() {
        let (flag, rest) = match letters {
            [b'S', b'T', rest @ ..] => (&mut kind.has_texture, rest),
            [b'C', rest @ ..] => (&mut kind.has_color, rest),
            [b'N', rest @ ..] => (&mut kind.has_normal, rest),
            _ => return None,
        };
        if std::mem::replace(flag, true) {
            return None;
        }
        letters = rest;
    }
    Some((kind, count))
}

/// Reads the header word, which files that begin with their counts have not, and says whether binary numbers follow.
fn read_header(scanner: &mut Scanner) -> Result<(Kind, bool), ReadError> {
    let mut ahead = scanner.clone();
    let Some(word) = ahead.word() else { return Err(ahead.error("the file is empty")) };
    let Some((kind, count)) = header(word) else {
        return match word {
            _ if word.iter().all(u8::is_ascii_digit) => Ok((Kind::default(), false)),
            _ if word.ends_with(b"OFF") => {
                Err(ahead.error(format!("nodes of the kind '{}' are not known", shown(word))))
            }
            _ => Err(ahead.error(format!("an OFF file does not begin with '{}'", shown(word)))),
        };
    };
    *scanner = ahead.clone();
    if !count.is_empty() {
        scanner.step_back(count.len());
    } else if ahead.word_in_line() == Some(b"BINARY") {
        ahead.skip_line();
        *scanner = ahead;
        return Ok((kind, true));
    }
    Ok((kind, false))
}

fn read_text(mut scanner: Scanner, kind: Kind) -> Result<Soup, ReadError> {
    let point_count = scanner.count("the number of nodes")?;
    let face_count = scanner.count("the number of faces")?;
    skip_edge_count(&mut scanner);
    scanner.check_room(point_count, "0 0 0\n".len(), "nodes")?;
    scanner.check_room(face_count, "0\n".len(), "faces")?;

    let mut soup = Soup { points: memory::with_capacity(point_count), ..Soup::default() };
    let mut parameters = Vec::new();
    for _ in 0..point_count {
        let x = scanner.number("a coordinate")?;
        let y = scanner.number_in_line("a coordinate")?;
        let z = scanner.number_in_line("a coordinate")?;
        memory::push(&mut soup.points, DVec3::new(x, y, z));
        if kind.has_texture {
            memory::push(&mut parameters, read_texture(&mut scanner)?);
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
    soup.parameters = kind.has_texture.then_some(parameters);
    Ok(soup)
}

/// Goes to the line of the first node, past the number of edges, which nobody needs: it may stand on a line of its
/// own, or nowhere.
fn skip_edge_count(scanner: &mut Scanner) {
    let has_edge_count = scanner.word_in_line().is_some();
    scanner.next_line();
    let mut ahead = scanner.clone();
    let is_alone = ahead.word().is_some() && ahead.word_in_line().is_none();
    if !has_edge_count && is_alone {
        *scanner = ahead;
        scanner.next_line();
    }
}

/// The last two numbers of the line.
fn read_texture(scanner: &mut Scanner) -> Result<DVec2, ReadError> {
    let mut last = DVec2::new(scanner.number_in_line("s")?, scanner.number_in_line("t")?);
    while let Some(word) = scanner.word_in_line() {
        let value = parse(word).ok_or_else(|| scanner.error(format!("'{}' is not a number", shown(word))))?;
        last = DVec2::new(last.y, value);
    }
    Ok(last)
}

fn read_binary(bytes: &[u8], position: usize, kind: Kind) -> Result<Soup, ReadError> {
    let mut words = Words { bytes, position };
    let [point_count, face_count, _] = [words.count("nodes")?, words.count("faces")?, words.count("edges")?];
    let extra = 3 * usize::from(kind.has_normal) + 4 * usize::from(kind.has_color);
    let point_size = 3 + extra + 2 * usize::from(kind.has_texture);
    words.check_room(point_count, point_size, "nodes")?;
    words.check_room(face_count, 2, "faces")?; // the number of corners and that of colours
    let mut soup = Soup { points: memory::with_capacity(point_count), ..Soup::default() };
    let mut parameters = Vec::new();
    for _ in 0..point_count {
        memory::push(&mut soup.points, DVec3::new(words.number()?, words.number()?, words.number()?));
        words.skip(extra)?;
        if kind.has_texture {
            memory::push(&mut parameters, DVec2::new(words.number()?, words.number()?));
        }
    }
    for _ in 0..face_count {
        for _ in 0..words.count("corners")? {
            let node = words.count("a node")?;
            if node >= point_count {
                return Err(words.error(format!("the face refers to node {node} of {point_count}")));
            }
            soup.faces.push(node as u32);
        }
        soup.faces.end_face();
        let color_size = words.count("colours")?;
        words.skip(color_size)?;
    }
    soup.parameters = kind.has_texture.then_some(parameters);
    Ok(soup)
}

/// Words of four bytes, the most significant first.
struct Words<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl Words<'_> {
    fn word(&mut self) -> Result<[u8; 4], ReadError> {
        let word = self.bytes.get(self.position..).and_then(<[u8]>::first_chunk);
        let word = *word.ok_or_else(|| self.error("the file ends within a number".to_owned()))?;
        self.position += word.len();
        Ok(word)
    }

    fn number(&mut self) -> Result<f64, ReadError> {
        Ok(f64::from(f32::from_be_bytes(self.word()?)))
    }

    fn count(&mut self, what: &str) -> Result<usize, ReadError> {
        let number = i32::from_be_bytes(self.word()?);
        usize::try_from(number).map_err(|_| self.error(format!("the number of {what} cannot be {number}")))
    }

    fn skip(&mut self, count: usize) -> Result<(), ReadError> {
        self.check_room(count, 1, "numbers")?;
        self.position += 4 * count;
        Ok(())
    }

    /// Fails unless this many things of `size` words can follow.
    fn check_room(&self, count: usize, size: usize, what: &str) -> Result<(), ReadError> {
        let rest = self.bytes.len() - self.position;
        match count > rest / (4 * size) {
            true => Err(self.error(format!("{count} {what} cannot stand in the {rest} bytes left"))),
            false => Ok(()),
        }
    }

    fn error(&self, problem: String) -> ReadError {
        ReadError::Binary { byte: self.position, problem }
    }
}
