//! Words and numbers of a text, with the line they stand on.
//!
//! A line ends with LF, CR LF, or CR alone as on old Macs. A byte order mark is white space wherever it stands:
//! files are glued together too.

use super::ReadError;

/// U+FEFF in UTF-8.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Goes through a text word by word.
#[derive(Clone)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    position: usize,
    /// Counted from 1.
    pub line: usize,
    /// Begins a remark that lasts to the end of the line.
    comment: Option<u8>,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(bytes: &'a [u8], comment: Option<u8>) -> Self {
        Self { bytes, position: 0, line: 1, comment }
    }

    /// Bytes not yet read.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// How many bytes were read.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// The next word of this line.
    pub(super) fn word_in_line(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.position)? {
                b'\n' | b'\r' => return None,
                b'\\' if self.continues_line() => {}
                byte if byte.is_ascii_whitespace() => self.position += 1,
                &byte if Some(byte) == self.comment => self.position += line_length(self.rest()),
                0xef if self.rest().starts_with(BYTE_ORDER_MARK) => self.position += BYTE_ORDER_MARK.len(),
                _ => break,
            }
        }
        let rest = self.rest();
        let ends = |&byte: &u8| byte.is_ascii_whitespace() || Some(byte) == self.comment;
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        self.position += length;
        Some(&rest[..length])
    }

    /// Steps over a backslash that ends the line.
    fn continues_line(&mut self) -> bool {
        let end = line_end_size(&self.rest()[1..]);
        if end > 0 {
            self.position += 1 + end;
            self.line += 1;
        }
        end > 0
    }

    /// The next word on this or a later line.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.word_in_line() {
                Some(word) => return Some(word),
                None if !self.next_line() => return None,
                None => {}
            }
        }
    }

    /// Goes to the beginning of the next line; false if there is none.
    pub(super) fn next_line(&mut self) -> bool {
        while self.word_in_line().is_some() {}
        self.end_line()
    }

    /// Steps over the end of the line, which is where the scanner stands; false at the end of the text.
    fn end_line(&mut self) -> bool {
        let end = line_end_size(self.rest());
        self.position += end;
        self.line += usize::from(end > 0);
        end > 0
    }

    /// Goes to the byte after this line's end, whatever stands in between.
    pub(super) fn skip_line(&mut self) {
        self.position += line_length(self.rest());
        self.end_line();
    }

    /// The same where it is known whether lines end with CR alone.
    pub(super) fn skip_line_as(&mut self, ends_in_cr: bool) {
        self.position += line_length(self.rest());
        let end = if ends_in_cr { usize::from(!self.rest().is_empty()) } else { line_end_size(self.rest()) };
        self.position += end;
        self.line += usize::from(end > 0);
    }

    /// Goes back over the last bytes of the word read last.
    pub(super) fn step_back(&mut self, count: usize) {
        self.position -= count;
    }

    /// The next word as a number, wherever it stands.
    pub(super) fn number(&mut self, what: &str) -> Result<f64, ReadError> {
        let word = self.word();
        self.coordinate(word, what)
    }

    /// The next word of this line as a number.
    pub(super) fn number_in_line(&mut self, what: &str) -> Result<f64, ReadError> {
        let word = self.word_in_line();
        self.coordinate(word, what)
    }

    fn coordinate(&self, word: Option<&[u8]>, what: &str) -> Result<f64, ReadError> {
        match word {
            Some(word) if is_not_a_number(word) => Ok(f64::NAN),
            _ => self.parsed(word, what, "a number"),
        }
    }

    /// The next word as a count or index, wherever it stands.
    pub(super) fn count(&mut self, what: &str) -> Result<usize, ReadError> {
        let word = self.word();
        self.parsed(word, what, "a whole number")
    }

    fn parsed<T: std::str::FromStr>(
        &self,
        word: Option<&[u8]>,
        what: &str,
        kind: &str,
    ) -> Result<T, ReadError> {
        let Some(word) = word else {
            let place = if self.position == self.bytes.len() { "file" } else { "line" };
            return Err(self.error(format!("the {place} ends where {what} should stand")));
        };
        parse(word).ok_or_else(|| self.error(format!("{what} should be {kind}, not '{}'", shown(word))))
    }

    /// Whether `count` things of at least `size` bytes can still follow, the last without a separator.
    pub(super) fn check_room(&self, count: usize, size: usize, what: &str) -> Result<(), ReadError> {
        let rest = self.rest().len();
        if count > (rest + 1) / size {
            return Err(self.error(format!("{count} {what} cannot stand in the {rest} bytes left")));
        }
        Ok(())
    }

    pub(super) fn error(&self, problem: impl Into<String>) -> ReadError {
        ReadError::Text { line: self.line, problem: problem.into() }
    }
}

/// A word as a number, if it is one.
pub(super) fn parse<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// How the C library of Windows writes what is no finite number: `-1.#IND`, `1.#QNAN`, `1.#INF`, `-nan(ind)`.
fn is_not_a_number(word: &[u8]) -> bool {
    let digits = word.strip_prefix(b"-").unwrap_or(word);
    digits.starts_with(b"1.#") || digits.get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"nan("))
}

/// Bytes before the end of the line.
fn line_length(rest: &[u8]) -> usize {
    rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len())
}

/// Bytes of the line's end that the text begins with: 2, 1 or 0.
fn line_end_size(rest: &[u8]) -> usize {
    match rest {
        [b'\r', b'\n', ..] => 2,
        [b'\r' | b'\n', ..] => 1,
        _ => 0,
    }
}

/// The beginning of a word, fit to be shown.
pub(super) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word);
    text.chars().take(30).map(|c| if c.is_control() { '?' } else { c }).collect()
}
