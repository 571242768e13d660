//! `python/planish/_abi.py`: the interface for ctypes.

use std::collections::{BTreeMap, BTreeSet};

use crate::api::{Api, Base, Field, Function, Pointer, Record, Role, Type};

const HEAD: &str = r#"# SPDX-License-Identifier: MIT OR Apache-2.0
# Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.
"""What planish.h declares, for ctypes: constants, enumerations, records and functions."""

from __future__ import annotations

from ctypes import (CFUNCTYPE, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t, c_uint8, c_uint32, c_uint64,
                    c_void_p, sizeof)

"#;

const TAIL: &str = r#"

def declare(library) -> None:
    """Tells a loaded library the types of its functions' arguments and results."""
    for name, (result, *arguments) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
"#;

pub fn text(api: &Api) -> String {
    let mut text = HEAD.to_owned();
    text.push_str(&format!("VERSION = \"{}\"\n", api.version.join(".")));
    for constant in &api.constants {
        text.push_str(&format!("{} = {}\n", constant.name.replacen("PLANISH_", "", 1), constant.value));
    }
    text.push_str("\n#: The words of each enumeration and their values.\nENUMERATIONS = {\n");
    for enumeration in &api.enumerations {
        text.push_str(&format!("    \"{}\": {{\n", enumeration.name));
        for enumerator in &enumeration.enumerators {
            text.push_str(&format!("        \"{}\": {},\n", enumerator.word, enumerator.value));
        }
        text.push_str("    },\n");
    }
    text.push_str("}\n\n");
    for callback in &api.callbacks {
        let arguments = callback.arguments.iter().map(|(_, of)| kind(of)).collect::<Vec<_>>();
        text.push_str(&format!(
            "{} = CFUNCTYPE({}, {})\n",
            callback.name,
            kind(&callback.result),
            arguments.join(", ")
        ));
    }
    api.records.iter().for_each(|record| self::record(record, &mut text));
    text.push_str("\n\n#: Bytes of each record.\nSIZES = {\n");
    for record in &api.records {
        text.push_str(&format!("    {}: {},\n", record.name, record.size));
    }
    text.push_str(
        "}\nif sizeof(c_void_p) == 8:\n    for _record, _size in SIZES.items():\n        assert sizeof(_record) == _size, \
         _record.__name__\n",
    );
    text.push_str("\n#: The types of each function's result and arguments.\nFUNCTIONS = {\n");
    api.functions.iter().for_each(|function| text.push_str(&declaration(function)));
    text.push_str(
        "}\n\n#: Arguments that stand for an enumerator: function, argument, enumeration.\nCHOICES = {\n",
    );
    for function in &api.functions {
        let result = function.result_choice.iter().map(|choice| ("return", choice));
        let arguments = function.arguments.iter().filter_map(|a| Some((a.name.as_str(), a.choice.as_ref()?)));
        for (name, choice) in arguments.chain(result) {
            text.push_str(&format!("    (\"{}\", \"{name}\"): \"{}\",\n", function.name, choice.enumeration));
        }
    }
    text.push_str(
        "}\n\n#: Arrays that are not of doubles: function, argument, what they are made of.\nELEMENTS = {\n",
    );
    for function in &api.functions {
        for argument in
            function.arguments.iter().filter(|argument| matches!(argument.role, Role::Array { .. }))
        {
            if let Base::Number(number @ ("size_t" | "uint32_t" | "uint8_t" | "int32_t")) = &argument.of.base
            {
                let (function, argument) = (&function.name, &argument.name);
                text.push_str(&format!("    (\"{function}\", \"{argument}\"): {},\n", self::number(number)));
            }
        }
    }
    text.push_str("}\n");
    text.push_str(&report_fields(api));
    text.push_str(TAIL);
    text
}

/// What type checkers are told of reports: the attributes of all of them in one class.
fn report_fields(api: &Api) -> String {
    let mut types = BTreeMap::<&str, BTreeSet<String>>::new();
    let is_report = |record: &&Record| record.name.ends_with("_report") || record.name.ends_with("_repairs");
    for field in api.records.iter().filter(is_report).flat_map(|record| &record.fields) {
        let is_shown = field.name != "struct_size" && !field.name.starts_with("reserved");
        if is_shown && field.of.pointers.is_empty() {
            types.entry(&field.name).or_default().insert(python_type(field));
        }
    }
    let mut text = "\n\nclass ReportFields:\n    \"\"\"The attributes of all reports, for type checkers; a report has those of \
                    its record.\"\"\"\n\n"
        .to_owned();
    for (name, types) in types {
        let types = types.into_iter().collect::<Vec<_>>().join(" | ");
        text.push_str(&format!("    {name}: {types}\n"));
    }
    text
}

/// What a field of a report is in Python: words for enumerators, sets of words for bits.
fn python_type(field: &Field) -> String {
    let one = match (&field.choice, &field.of.base) {
        (Some(choice), _) if choice.are_bits => "frozenset[str]",
        (Some(_), _) => "str",
        (None, Base::Number("double")) => "float",
        _ => "int",
    };
    field.of.count.map_or_else(|| one.to_owned(), |_| format!("tuple[{one}, ...]"))
}

fn record(record: &Record, text: &mut String) {
    text.push_str(&format!("\n\nclass {}(Structure):\n    _fields_ = [\n", record.name));
    for field in &record.fields {
        let count = field.of.count.map_or(String::new(), |count| format!(" * {count}"));
        text.push_str(&format!("        (\"{}\", {}{count}),\n", field.name, kind(&field.of)));
    }
    text.push_str("    ]\n");
    let table = |name: &str, rows: Vec<(&Field, String)>| {
        let rows = rows
            .iter()
            .map(|(field, value)| format!("        \"{}\": {value},\n", field.name))
            .collect::<String>();
        if rows.is_empty() { rows } else { format!("    {name} = {{\n{rows}    }}\n") }
    };
    let choices = |are_bits: bool| {
        let of = |field| -> Option<(&Field, String)> {
            let field: &Field = field;
            let choice = field.choice.as_ref().filter(|choice| choice.are_bits == are_bits)?;
            Some((field, format!("\"{}\"", choice.enumeration)))
        };
        record.fields.iter().filter_map(of).collect()
    };
    text.push_str(&table("choices", choices(false)));
    text.push_str(&table("bits", choices(true)));
    let element = |field: &Field| {
        let Base::Number(number) = &field.of.base else { return None };
        field.array.as_ref().map(|_| self::number(number))
    };
    let elements = record.fields.iter().filter_map(|field| Some((field, element(field)?))).collect();
    text.push_str(&table("elements", elements));
    let extents = |field: &Field| {
        let extents = field.array.as_ref()?.iter().map(|extent| format!("\"{extent}\",")).collect::<Vec<_>>();
        Some(format!("({})", extents.join(" ")))
    };
    let arrays = record.fields.iter().filter_map(|field| Some((field, extents(field)?))).collect();
    text.push_str(&table("arrays", arrays));
}

fn declaration(function: &Function) -> String {
    let result = match &function.result {
        Type { base: Base::Void, pointers, .. } if pointers.is_empty() => "None".to_owned(),
        of => kind(of),
    };
    let arguments = function.arguments.iter().map(|argument| kind(&argument.of));
    let types = std::iter::once(result).chain(arguments).collect::<Vec<_>>();
    let comma = if types.len() == 1 { "," } else { "" };
    format!("    \"{}\": ({}{comma}),\n", function.name, types.join(", "))
}

fn kind(of: &Type) -> String {
    match &of.base {
        Base::Char if of.pointers == [Pointer::Const] => "c_char_p".to_owned(),
        _ if !of.pointers.is_empty() => "c_void_p".to_owned(),
        Base::Callback(name) => name.clone(),
        Base::Status => "c_int32".to_owned(),
        Base::Number(number) => self::number(number),
        Base::Void | Base::Char | Base::Record(_) | Base::Handle(_) => "c_void_p".to_owned(),
    }
}

/// The name in ctypes of a number.
fn number(name: &str) -> String {
    match name {
        "size_t" => "c_size_t".to_owned(),
        name => format!("c_{}", name.trim_end_matches("_t")),
    }
}
