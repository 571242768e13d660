//! What the documentation of an item says, to readers and to this program.

use std::collections::BTreeMap;

/// The lines of a documentation comment, without the blank that follows the slashes.
#[derive(Debug, Clone, Default)]
pub struct Documentation {
    lines: Vec<String>,
}

impl Documentation {
    pub fn new(attributes: &[syn::Attribute]) -> Self {
        let text = |attribute: &syn::Attribute| {
            let syn::Meta::NameValue(pair) = &attribute.meta else { return None };
            let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &pair.value else {
                return None;
            };
            let text = text.value();
            pair.path.is_ident("doc").then(|| text.strip_prefix(' ').unwrap_or(&text).trim_end().to_owned())
        };
        Self { lines: attributes.iter().filter_map(text).collect() }
    }

    /// All of it as one line, without what is meant for this program.
    pub fn text(&self) -> String {
        let lines = self.lines.iter().map(String::as_str).filter(|line| !line.starts_with("Array: ["));
        lines.map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
    }

    /// The first sentence, without its stop.
    pub fn sentence(&self) -> String {
        first_sentence(&self.text())
    }

    /// The paragraphs before the arguments, as one line.
    pub fn purpose(&self) -> String {
        let is_argument = |line: &&String| argument_line(line).is_none() && !line.starts_with("Returns ");
        let lines = self.lines.iter().take_while(is_argument).map(|line| line.trim());
        lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
    }

    /// What is said of the result: the text from "Returns" on.
    pub fn returns(&self) -> String {
        let lines =
            self.lines.iter().skip_while(|line| !line.starts_with("Returns ")).map(|line| line.trim());
        lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
    }

    /// What is said of each argument: lines `name: text` or `name, name: text` and those indented below.
    pub fn arguments(&self) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        let mut open: Vec<String> = Vec::new();
        for line in &self.lines {
            let text = match argument_line(line) {
                Some((names, text)) => {
                    open = names.split(", ").map(str::to_owned).collect();
                    text
                }
                None if line.starts_with(' ') => line.as_str(),
                None => {
                    open.clear();
                    continue;
                }
            };
            for name in &open {
                let told: &mut String = found.entry(name.clone()).or_default();
                told.push_str(if told.is_empty() { "" } else { " " });
                told.push_str(text.trim());
            }
        }
        found
    }

    /// The extents of the arrays among a function's arguments.
    pub fn arrays(&self) -> Result<BTreeMap<String, Vec<String>>, String> {
        let mut lines = self.lines.iter().skip_while(|line| !line.starts_with("Arrays: "));
        let Some(first) = lines.next() else { return Ok(BTreeMap::new()) };
        let mut text = first["Arrays: ".len()..].to_owned();
        lines
            .take_while(|line| line.starts_with(' '))
            .for_each(|line| text = format!("{text} {}", line.trim()));
        let mut arrays = BTreeMap::new();
        for part in text.trim_end_matches('.').split_inclusive(']') {
            let part = part.trim_start_matches([',', ' ']);
            let (name, extents) =
                part.split_once('[').ok_or(format!("'Arrays:' has '{part}', not name[extents]"))?;
            arrays.insert(name.to_owned(), self::extents(extents)?);
        }
        Ok(arrays)
    }

    /// The extents of the array that a field points to.
    pub fn array(&self) -> Result<Option<Vec<String>>, String> {
        let line = self.lines.iter().find_map(|line| line.strip_prefix("Array: ["));
        line.map(|line| extents(line.trim_end_matches('.'))).transpose()
    }

    /// The default of an option: `X (default)` or `Default X`.
    pub fn default(&self) -> Option<String> {
        let text = self.text();
        let told = if let Some((before, _)) = text.split_once(" (default") {
            before.rsplit(' ').next()?.to_owned()
        } else {
            let (_, after) = text.split_once("Default ").or_else(|| text.split_once("default "))?;
            let (first, rest) = after.split_once(' ').unwrap_or((after, ""));
            // a fraction such as pi / 4
            match rest.strip_prefix("/ ") {
                Some(rest) => format!("{first} / {}", rest.split([' ', '.']).next()?),
                None => first.to_owned(),
            }
        };
        Some(told.trim_end_matches(['.', ',', ';', ':']).to_owned())
    }
}

/// `count, 2]` as extents.
fn extents(text: &str) -> Result<Vec<String>, String> {
    let text = text.strip_suffix(']').ok_or(format!("'[{text}' lacks its ']'"))?;
    Ok(text.split(',').map(|extent| extent.trim().to_owned()).collect())
}

/// Names and text of a line `name, name: text`.
fn argument_line(line: &str) -> Option<(&str, &str)> {
    let (names, text) = line.split_once(':')?;
    let is_name = |name: &str| {
        name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.bytes().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_')
    };
    (text.starts_with(' ') && names.split(", ").all(is_name)).then_some((names, text))
}

/// The text up to its first stop that ends a sentence, without the stop.
pub fn first_sentence(text: &str) -> String {
    let end = text.find(". ").unwrap_or(text.len());
    text[..end].trim_end_matches('.').to_owned()
}

/// The words of a text that may be names.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
}
