//! The clear text encoding of the exchange structure, ISO 10303-21: entities with numbers, reals, texts, lists.

use crate::memory::{self, CollectVec};
use std::fmt::{self, Display, Write};

/// The number of an entity of one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Id(usize);

impl Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// The data section in the making. An entity gets its number when it is added, so references point backwards.
#[derive(Debug, Default)]
pub(super) struct Part21 {
    text: String,
    count: usize,
}

impl Part21 {
    /// Lines are broken after a comma once they are this long; some readers have short buffers.
    const LINE: usize = 100;

    /// Adds an entity, such as `VERTEX_POINT('',#7)`.
    pub(super) fn add(&mut self, entity: impl Display) -> Id {
        self.count += 1;
        let id = Id(self.count);
        self.push_wrapped(&format!("{id}={entity};"));
        id
    }

    fn push_wrapped(&mut self, line: &str) {
        // a line may be broken after each comma
        memory::reserve_text(&mut self.text, 2 * line.len() + 1);
        let (mut length, mut is_text) = (0, false);
        for letter in line.chars() {
            self.text.push(letter);
            length += 1;
            is_text ^= letter == '\'';
            if letter == ',' && !is_text && length >= Self::LINE {
                self.text.push('\n');
                length = 0;
            }
        }
        self.text.push('\n');
    }

    /// The whole file. The header's entities are `FILE_DESCRIPTION`, `FILE_NAME` and `FILE_SCHEMA`.
    pub(super) fn finish(self, header: &[String]) -> String {
        let mut file = String::from("ISO-10303-21;\nHEADER;\n");
        for entity in header {
            // writing into a string cannot fail
            let _ = writeln!(file, "{entity};");
        }
        file.push_str("ENDSEC;\nDATA;\n");
        memory::reserve_text(&mut file, self.text.len() + 100);
        file.push_str(&self.text);
        file.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
        file
    }
}

/// A finite number, as short as reads back to the same bits, with the decimal point that the format wants.
pub(super) struct Real(pub f64);

impl Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // adding 0 turns -0 into 0
        let digits = format!("{:?}", self.0 + 0.0);
        match digits.split_once('e') {
            Some((mantissa, exponent)) if mantissa.contains('.') => write!(f, "{mantissa}E{exponent}"),
            Some((mantissa, exponent)) => write!(f, "{mantissa}.E{exponent}"),
            None => f.write_str(digits.strip_suffix('0').filter(|d| d.ends_with('.')).unwrap_or(&digits)),
        }
    }
}

/// A text in quotes; letters outside printable ASCII become `\X2\` or `\X4\` sequences.
pub(super) struct Text<'a>(pub &'a str);

impl Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_char('\'')?;
        for letter in self.0.chars() {
            match letter {
                '\'' => f.write_str("''")?,
                '\\' => f.write_str("\\\\")?,
                ' '..='~' => f.write_char(letter)?,
                '\0'..='\u{ffff}' => write!(f, "\\X2\\{:04X}\\X0\\", u32::from(letter))?,
                _ => write!(f, "\\X4\\{:08X}\\X0\\", u32::from(letter))?,
            }
        }
        f.write_char('\'')
    }
}

/// `(a,b,c)`.
pub(super) fn list<T: Display>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<String> = items.into_iter().map(|item| item.to_string()).collect_vec();
    format!("({})", items.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reals_have_a_point_and_read_back() {
        for (x, text) in [
            (0.0, "0."),
            (-0.0, "0."),
            (1.0, "1."),
            (-10.0, "-10."),
            (0.1, "0.1"),
            (100.5, "100.5"),
            (1e-7, "1.E-7"),
            (-2.5e-9, "-2.5E-9"),
            (1e22, "1.E22"),
        ] {
            assert_eq!(Real(x).to_string(), text);
        }
        for x in [std::f64::consts::PI, 1.0 / 3.0, f64::MIN_POSITIVE, f64::MAX, -5e-324] {
            assert_eq!(Real(x).to_string().replace(".E", ".0E").parse::<f64>(), Ok(x));
        }
    }

    #[test]
    fn texts_are_ascii_whatever_they_say() {
        assert_eq!(Text("it's a\\b").to_string(), "'it''s a\\\\b'");
        assert_eq!(Text("Flügel").to_string(), "'Fl\\X2\\00FC\\X0\\gel'");
        assert_eq!(Text("\n\u{1f6e9}").to_string(), "'\\X2\\000A\\X0\\\\X4\\0001F6E9\\X0\\'");
    }

    #[test]
    fn long_lines_are_broken_outside_texts() {
        let mut file = Part21::default();
        let id = file.add(format!("LIST({},{})", Text(&",".repeat(300)), list(0..100)));
        assert_eq!(id.to_string(), "#1");
        let lines: Vec<&str> = file.text.lines().collect();
        assert!(lines[0].len() > 300 && lines[1..].iter().all(|line| line.len() < Part21::LINE + 4));
    }
}
