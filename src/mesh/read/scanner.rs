//! Words and numbers of a text, with the line they stand on.

use super::ReadError;

/// Goes through a text word by word.
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    position: usize,
    /// Counted from 1.
    pub line: usize,
    /// Begins a remark that lasts to the end of the line.
    comment: Option<u8>,
}

impl<'a> Scanner<'a> {
    pub fn new(bytes: &'a [u8], comment: Option<u8>) -> Self {
        Self { bytes, position: 0, line: 1, comment }
    }

    /// Bytes not yet read.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// How many bytes were read.
    pub fn position(&self) -> usize {
        self.position
    }

    /// The next word of this line.
    pub fn word_in_line(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.position)? {
                b'\n' => return None,
                b'\\' if self.continues_line() => {}
                byte if byte.is_ascii_whitespace() => self.position += 1,
                &byte if Some(byte) == self.comment => {
                    let rest = self.rest();
                    self.position += rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
                }
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
        let skipped = match self.rest() {
            [b'\\', b'\n', ..] => 2,
            [b'\\', b'\r', b'\n', ..] => 3,
            _ => return false,
        };
        self.position += skipped;
        self.line += 1;
        true
    }

    /// The next word on this or a later line.
    pub fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.word_in_line() {
                Some(word) => return Some(word),
                None if !self.next_line() => return None,
                None => {}
            }
        }
    }

    /// Goes to the beginning of the next line; false if there is none.
    pub fn next_line(&mut self) -> bool {
        while self.word_in_line().is_some() {}
        let more = self.position < self.bytes.len();
        if more {
            self.position += 1;
            self.line += 1;
        }
        more
    }

    /// Goes to the byte after this line's end, whatever stands in between.
    pub fn skip_line(&mut self) {
        let rest = self.rest();
        match rest.iter().position(|&byte| byte == b'\n') {
            Some(length) => {
                self.position += length + 1;
                self.line += 1;
            }
            None => self.position = self.bytes.len(),
        }
    }

    /// The next word as a number, wherever it stands.
    pub fn number(&mut self, what: &str) -> Result<f64, ReadError> {
        let word = self.word();
        self.parsed(word, what, "a number")
    }

    /// The next word of this line as a number.
    pub fn number_in_line(&mut self, what: &str) -> Result<f64, ReadError> {
        let word = self.word_in_line();
        self.parsed(word, what, "a number")
    }

    /// The next word as a count or index, wherever it stands.
    pub fn count(&mut self, what: &str) -> Result<usize, ReadError> {
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
        let value = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        value.ok_or_else(|| self.error(format!("{what} should be {kind}, not '{}'", shown(word))))
    }

    /// Whether `count` things of at least `size` bytes can still follow, the last without a separator.
    pub fn check_room(&self, count: usize, size: usize, what: &str) -> Result<(), ReadError> {
        let rest = self.rest().len();
        if count > (rest + 1) / size {
            return Err(self.error(format!("{count} {what} cannot stand in the {rest} bytes left")));
        }
        Ok(())
    }

    pub fn error(&self, problem: impl Into<String>) -> ReadError {
        ReadError::Text { line: self.line, problem: problem.into() }
    }
}

/// The beginning of a word, fit to be shown.
pub(super) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word);
    text.chars().take(30).map(|c| if c.is_control() { '?' } else { c }).collect()
}
