//! `bindings/planish_c.f90`: names, records and interfaces for `include/planish.f90`, which wraps them by hand.

use crate::api::{Api, Argument, Base, Enumeration, Field, Function, Pointer, Record, Role, Type};
use crate::documentation::first_sentence;

/// The longest line.
const WIDTH: usize = 118;

const HEAD: &str = "\
! SPDX-License-Identifier: MIT OR Apache-2.0
! Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.

!> Names and records of planish.h, which users see through the module planish. Records are the same bytes as in C, born
!> with the defaults. A pointer in one is set by an argument of the call, and indices count from 1.
module planish_records
  use, intrinsic :: iso_c_binding
  implicit none
  private

  !> Bytes of a pointer, and of a size_t.
  integer(c_size_t), parameter :: word = storage_size(0_c_size_t) / 8
  !> IEEE's infinity, which has no literal.
  real(c_double), parameter :: infinity = transfer(int(z'7FF0000000000000', c_int64_t), 1.0_c_double)
";

const CALLS: &str = "
end module

!> The functions of planish.h as they are: planish_x of C is c_x. NULL is an absent argument.
module planish_calls
  use, intrinsic :: iso_c_binding
  use planish_records
  implicit none
  public

  interface
";

pub fn text(api: &Api) -> String {
    let mut text = HEAD.to_owned();
    text.push_str("\n  !> The version of planish.h that this follows.\n");
    for (part, value) in ["MAJOR", "MINOR", "PATCH"].iter().zip(&api.version) {
        text.push_str(&format!(
            "  integer(c_int32_t), parameter, public :: PLANISH_VERSION_{part} = {value}\n"
        ));
    }
    for constant in &api.constants {
        text.push('\n');
        comment(&mut text, 2, &constant.documentation.sentence());
        let (kind, value) = match constant.value {
            value if value == u64::from(u32::MAX) => ("c_int32_t", -1),
            u64::MAX => ("c_int64_t", -1),
            value => ("c_int64_t", value as i64),
        };
        text.push_str(&format!("  integer({kind}), parameter, public :: {} = {value}\n", constant.name));
    }
    api.enumerations.iter().for_each(|enumeration| self::enumeration(api, enumeration, &mut text));
    api.records.iter().for_each(|record| self::record(record, &mut text));
    text.push_str(CALLS);
    let functions = api.functions.iter().map(function).collect::<Vec<_>>();
    text.push_str(&functions.join("\n"));
    text.push_str("  end interface\n\n");
    inits(api, &mut text);
    text.push_str("end module\n");
    text
}

/// One name for all functions that fill options with the defaults.
fn inits(api: &Api, text: &mut String) {
    let records = || {
        let names = api.records.iter().map(|record| &record.name);
        names.filter(|name| api.function(&format!("{name}_init")).is_some())
    };
    let local = |name: &str| name.replacen("planish_", "init_", 1);
    text.push_str(
        "  !> Puts a record back to the defaults that the library has: `call planish_options_init(options)`.\n  \
         interface planish_options_init\n",
    );
    for name in records() {
        text.push_str(&format!("    module procedure {}\n", local(name)));
    }
    text.push_str("  end interface\n");
    for name in records() {
        text.push_str(&format!("  private :: {}\n", local(name)));
    }
    text.push_str("\ncontains\n");
    for name in records() {
        let call = name.replacen("planish_", "c_", 1);
        text.push_str(&format!(
            "\n  subroutine {}(options)\n    type({name}), intent(inout) :: options\n    integer(c_int) :: status\n    \
             status = {call}_init(options, c_sizeof(options)) ! which cannot fail\n  end subroutine\n",
            local(name)
        ));
    }
}

fn enumeration(api: &Api, enumeration: &Enumeration, text: &mut String) {
    let kind = match (enumeration.name.as_str(), api.width(&enumeration.name)) {
        ("planish_status", _) => "c_int",
        (_, 1) => "c_int8_t",
        (_, 8) => "c_int64_t",
        _ => "c_int32_t",
    };
    text.push('\n');
    comment(text, 2, &format!("{}.", enumeration.documentation.sentence()));
    for enumerator in &enumeration.enumerators {
        let declaration =
            format!("  integer({kind}), parameter, public :: {} = {}", enumerator.name, enumerator.value);
        with_comment(text, 2, &declaration, &enumerator.documentation.sentence());
    }
}

fn record(record: &Record, text: &mut String) {
    text.push('\n');
    comment(text, 2, &format!("{}.", record.documentation.sentence()));
    text.push_str(&format!("  type, bind(c), public :: {}\n", record.name));
    let is_options = record.name.ends_with("_options");
    for field in &record.fields {
        let (kind, initial) = if field.name == "struct_size" {
            ("integer(c_size_t)".to_owned(), size(record))
        } else {
            (kind(&field.of), initial(field, is_options))
        };
        let count = field.of.count.map_or(String::new(), |count| format!("({count})"));
        let declaration = format!("    {kind} :: {}{count} = {initial}", field.name);
        let told = field.name == "struct_size" || field.name == "reserved";
        let sentence = field.documentation.text().replace("counted from 0", "counted from 1");
        with_comment(text, 4, &declaration, if told { "" } else { &sentence });
    }
    text.push_str("  end type\n");
}

/// A record's size as a sum of words, which depend on the machine, and bytes.
fn size(record: &Record) -> String {
    let words: usize = record
        .fields
        .iter()
        .filter(|field| field.of.is_word())
        .map(|field| field.of.count.unwrap_or(1))
        .sum();
    match record.size - 8 * words {
        0 => format!("{words} * word"),
        rest => format!("{words} * word + {rest}"),
    }
}

/// What a field is born with.
fn initial(field: &Field, is_option: bool) -> String {
    if !field.of.pointers.is_empty() {
        return "c_null_ptr".into();
    }
    if matches!(field.of.base, Base::Callback(_)) {
        return "c_null_funptr".into();
    }
    let default = field.default.as_deref().filter(|_| is_option).unwrap_or("0");
    match default {
        "0" | "0.0" => "0".into(),
        "infinity" => "infinity".into(),
        _ if field.of.base != Base::Number("double") => default.into(),
        _ => {
            let number = |text: &str| match text {
                "pi" => "acos(-1.0_c_double)".to_owned(),
                _ if text.bytes().all(|c| c.is_ascii_digit()) => text.to_owned(),
                _ => format!("{text}_c_double"),
            };
            default.split(" / ").map(number).collect::<Vec<_>>().join(" / ")
        }
    }
}

/// The kind of a number, pointer or callback.
fn kind(of: &Type) -> String {
    match &of.base {
        _ if !of.pointers.is_empty() => "type(c_ptr)",
        Base::Callback(_) => "type(c_funptr)",
        base => number(base),
    }
    .to_owned()
}

fn number(base: &Base) -> &'static str {
    match base {
        Base::Number("double") => "real(c_double)",
        Base::Number("size_t") => "integer(c_size_t)",
        Base::Number("int32_t" | "uint32_t") => "integer(c_int32_t)",
        Base::Number("int64_t" | "uint64_t") => "integer(c_int64_t)",
        Base::Status => "integer(c_int)",
        Base::Char => "character(kind=c_char)",
        _ => "integer(c_int8_t)",
    }
}

fn function(function: &Function) -> String {
    let result = match (&function.result.base, function.result.pointers.as_slice()) {
        (Base::Void, []) => None,
        _ => Some(kind(&function.result)),
    };
    let local = function.name.replacen("planish_", "c_", 1);
    let (begin, end) = match &result {
        None => (format!("subroutine {local}("), "subroutine"),
        Some(result) => {
            let pure = if is_pure(function) { "pure " } else { "" };
            (format!("{pure}{result} function {local}("), "function")
        }
    };
    let names = function.arguments.iter().map(|argument| argument.name.as_str()).collect::<Vec<_>>();
    let bound = format!("bind(c, name=\"{}\")", function.name);
    let mut text = format!("    {begin}{}) {bound}", names.join(", "));
    if text.len() > WIDTH {
        text = format!("    {begin} &\n{}) &\n        {bound}", wrap(&names, 8));
    }
    text.push_str("\n      import\n      implicit none\n");
    for argument in &function.arguments {
        text.push_str(&format!("      {}\n", declaration(argument)));
    }
    text.push_str(&format!("    end {end}\n"));
    text
}

/// Whether it only looks at a handle and hands back a number.
fn is_pure(function: &Function) -> bool {
    let is_number = function.result.pointers.is_empty() && matches!(function.result.base, Base::Number(_));
    let only_looks =
        |argument: &Argument| matches!(argument.role, Role::Value | Role::Handle { changes: false });
    let has_handle = function.arguments.iter().any(|argument| matches!(argument.role, Role::Handle { .. }));
    is_number && has_handle && function.arguments.iter().all(only_looks)
}

fn declaration(argument: &Argument) -> String {
    let optional = if argument.may_be_null { ", optional" } else { "" };
    let intent = match argument.of.pointers.first() {
        Some(Pointer::Const) => "intent(in)",
        _ => "intent(inout)",
    };
    let name = &argument.name;
    match &argument.role {
        Role::Value | Role::Handle { .. } | Role::Opaque => {
            format!("{}, value :: {name}", kind(&argument.of))
        }
        Role::Text => format!("character(kind=c_char), intent(in){optional} :: {name}(*)"),
        Role::NewHandle { .. } => format!("type(c_ptr), intent(inout){optional} :: {name}"),
        Role::Record { .. } => {
            let Base::Record(record) = &argument.of.base else { return String::new() };
            format!("type({record}), {intent}{optional} :: {name}")
        }
        Role::Array { extents, .. } => {
            let of = if argument.of.pointers.len() > 1 { "type(c_ptr)" } else { number(&argument.of.base) };
            let count = if extents.len() == 1 && extents[0] == "1" { "" } else { "(*)" };
            format!("{of}, {intent}{optional} :: {name}{count}")
        }
    }
}

/// Names in lines of their own, joined by commas.
fn wrap(names: &[&str], indent: usize) -> String {
    let mut lines = vec![" ".repeat(indent)];
    for (i, name) in names.iter().enumerate() {
        let name = if i + 1 < names.len() { format!("{name}, ") } else { (*name).to_owned() };
        if lines.last().is_some_and(|line| line.len() + name.len() > WIDTH - 4) {
            lines.push(" ".repeat(indent));
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(&name);
        }
    }
    lines.join("&\n")
}

/// A declaration with what is said of it: behind it if that fits, else above it.
fn with_comment(text: &mut String, indent: usize, declaration: &str, told: &str) {
    let sentence = first_sentence(told);
    if sentence.is_empty() {
        text.push_str(&format!("{declaration}\n"));
    } else if declaration.len() + 4 + sentence.len() <= WIDTH {
        text.push_str(&format!("{declaration} !! {sentence}\n"));
    } else {
        comment(text, indent, &sentence);
        text.push_str(&format!("{declaration}\n"));
    }
}

/// A text as lines of comment.
fn comment(text: &mut String, indent: usize, told: &str) {
    let mut line = format!("{}!>", " ".repeat(indent));
    for word in told.split(' ') {
        if line.len() + 1 + word.len() > WIDTH {
            text.push_str(&format!("{line}\n"));
            line = format!("{}!>", " ".repeat(indent));
        }
        line.push(' ');
        line.push_str(word);
    }
    text.push_str(&format!("{line}\n"));
}
