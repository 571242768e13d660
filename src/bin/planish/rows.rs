//! Text files of rows of points: `rows N`, then for each row `row I COUNT` (and `closed`) and COUNT lines x y z; lines that
//! begin with # are comments.

use crate::{Failure, output};
use std::path::Path;

/// What a file of rows holds.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct RowFile {
    /// Three numbers a point, row after row.
    pub points: Vec<f64>,
    /// Points of each row.
    pub counts: Vec<usize>,
    /// Whether the last point of each row is followed by its first.
    pub is_closed: bool,
}

impl RowFile {
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let text = output::read_text(path)?;
        Self::parse(&text)
            .map_err(|Failure(sentence)| Failure::new(format!("{}: {sentence}", path.display())))
    }

    /// The points of each row.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[f64]> {
        let mut rest = self.points.as_slice();
        self.counts.iter().map(move |&count| {
            let (row, others) = rest.split_at(3 * count);
            rest = others;
            row
        })
    }

    fn parse(text: &str) -> Result<Self, Failure> {
        let mut file = Self::default();
        let mut announced = None;
        // points that the present row still lacks
        let mut missing = 0;
        for (number, line) in text.lines().enumerate() {
            let wrong = |problem: &str| Failure::new(format!("line {}: {problem}", number + 1));
            let line = line.split('#').next().unwrap_or_default();
            let words: Vec<&str> = line.split_whitespace().collect();
            match words.as_slice() {
                [] => {}
                ["rows", count] if announced.is_none() => {
                    announced =
                        Some(count.parse::<usize>().map_err(|_| wrong("the number of rows is none"))?);
                }
                ["row", _, count, flags @ ..] if missing == 0 => {
                    missing = count.parse().map_err(|_| wrong("the number of points is none"))?;
                    let is_closed = flags.first().is_some_and(|&flag| flag == "closed" || flag == "1");
                    if !file.counts.is_empty() && is_closed != file.is_closed {
                        return Err(wrong("rows are either all closed or all open"));
                    }
                    file.is_closed = is_closed;
                    file.counts.push(missing);
                }
                ["row", ..] => return Err(wrong(&format!("the row before lacks {missing} points"))),
                [x, y, z] if missing > 0 => {
                    for word in [x, y, z] {
                        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
                        file.points.push(number.ok_or_else(|| wrong(&format!("'{word}' is no number")))?);
                    }
                    missing -= 1;
                }
                _ => return Err(wrong("neither a row nor one of its points")),
            }
        }
        match announced {
            _ if missing > 0 => Err(Failure::new(format!("the last row lacks {missing} points"))),
            Some(count) if count != file.counts.len() => {
                Err(Failure::new(format!("{count} rows are announced, {} are there", file.counts.len())))
            }
            _ => Ok(file),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_rows_is_read() {
        let text =
            "# a comment\nrows 2\nrow 0 2 closed\n0 0 0\n1 0 0 # and another\n\nrow 1 1 closed\n0.5 1e0 0\n";
        let file = RowFile::parse(text).map_err(|Failure(sentence)| sentence).unwrap();
        assert_eq!((file.counts, file.is_closed), (vec![2, 1], true));
        assert_eq!(file.points, [0., 0., 0., 1., 0., 0., 0.5, 1., 0.]);
    }

    #[test]
    fn wrong_files_are_refused_by_line() {
        for (text, words) in [
            ("rows 1\nrow 0 2\n0 0 0\nrow 1 1\n", "line 4: the row before lacks 1"),
            ("rows 1\nrow 0 2\n0 0 0\n", "lacks 1 points"),
            ("rows 2\nrow 0 1\n0 0 0\n", "2 rows are announced, 1"),
            ("row 0 1\n0 0 zero\n", "line 2: 'zero'"),
            ("row 0 1\n0 0 inf\n", "line 2: 'inf'"),
            ("row 0 1\n0 0\n", "line 2: neither"),
            ("row 0 1 closed\n0 0 0\nrow 1 1 open\n0 0 0\n", "line 3: rows are either"),
        ] {
            let Failure(sentence) = RowFile::parse(text).unwrap_err();
            assert!(sentence.contains(words), "{sentence}");
        }
    }
}
