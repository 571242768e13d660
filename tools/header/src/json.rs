//! `bindings/planish.api.json`: the interface for programs.

use crate::api::{
    Api, Argument, Callback, Choice, Constant, Enumeration, Enumerator, Field, Function, Handle, Record,
    Role, Type,
};
use std::fmt;

/// A value whose objects keep their order, so that names come first.
enum Json {
    Text(String),
    Number(i128),
    True,
    List(Vec<Json>),
    Object(Vec<(&'static str, Json)>),
}

impl From<&str> for Json {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Json {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// In one line.
impl fmt::Display for Json {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => write!(out, "{}", serde_json::Value::from(text.as_str())),
            Self::Number(number) => write!(out, "{number}"),
            Self::True => write!(out, "true"),
            Self::List(list) => {
                let members = list.iter().map(Self::to_string).collect::<Vec<_>>();
                write!(out, "[{}]", members.join(", "))
            }
            Self::Object(object) => {
                let members =
                    object.iter().map(|(name, value)| format!("\"{name}\": {value}")).collect::<Vec<_>>();
                write!(out, "{{{}}}", members.join(", "))
            }
        }
    }
}

fn list<T>(items: &[T], json: impl Fn(&T) -> Json) -> Json {
    Json::List(items.iter().map(json).collect())
}

/// The longest line of an object.
const WIDTH: usize = 140;

pub fn text(api: &Api) -> String {
    let value = Json::Object(vec![
        (
            "about",
            "Generated from src/ffi by `cargo run -p planish-header`, which tells in its first comment how."
                .into(),
        ),
        ("version", api.version.join(".").into()),
        ("constants", list(&api.constants, constant)),
        ("enumerations", list(&api.enumerations, enumeration)),
        ("handles", list(&api.handles, handle)),
        ("callbacks", list(&api.callbacks, callback)),
        ("records", list(&api.records, record)),
        ("functions", list(&api.functions, function)),
    ]);
    let mut text = String::new();
    write(&value, 0, &mut text);
    text.push('\n');
    text
}

fn constant(constant: &Constant) -> Json {
    Json::Object(vec![
        ("name", constant.name.as_str().into()),
        ("value", Json::Number(constant.value.into())),
        ("text", constant.documentation.text().into()),
    ])
}

fn enumeration(enumeration: &Enumeration) -> Json {
    let enumerator = |enumerator: &Enumerator| {
        Json::Object(vec![
            ("name", enumerator.name.as_str().into()),
            ("value", Json::Number(enumerator.value.into())),
            ("text", enumerator.documentation.text().into()),
        ])
    };
    Json::Object(vec![
        ("name", enumeration.name.as_str().into()),
        ("text", enumeration.documentation.text().into()),
        ("enumerators", list(&enumeration.enumerators, enumerator)),
    ])
}

fn handle(handle: &Handle) -> Json {
    Json::Object(vec![
        ("name", handle.name.as_str().into()),
        ("free", format!("{}_free", handle.name).into()),
        ("text", handle.documentation.text().into()),
    ])
}

fn callback(callback: &Callback) -> Json {
    let argument = |(name, of): &(String, Type)| {
        Json::Object(vec![("name", name.as_str().into()), ("type", of.to_c().into())])
    };
    Json::Object(vec![
        ("name", callback.name.as_str().into()),
        ("text", callback.documentation.text().into()),
        ("result", callback.result.to_c().into()),
        ("arguments", list(&callback.arguments, argument)),
    ])
}

fn record(record: &Record) -> Json {
    Json::Object(vec![
        ("name", record.name.as_str().into()),
        ("text", record.documentation.text().into()),
        ("size", Json::Number(record.size as i128)),
        ("fields", list(&record.fields, field)),
    ])
}

fn field(field: &Field) -> Json {
    let mut object = vec![
        ("name", field.name.as_str().into()),
        ("type", field.of.to_c().into()),
        ("offset", Json::Number(field.offset as i128)),
    ];
    object.extend(field.default.as_deref().map(|default| ("default", default.into())));
    object.extend(field.choice.as_ref().map(choice));
    object.extend(field.array.as_ref().map(|extents| ("extents", self::extents(extents))));
    object.push(("text", field.documentation.text().into()));
    Json::Object(object)
}

fn function(function: &Function) -> Json {
    let mut object = vec![
        ("name", function.name.as_str().into()),
        ("text", function.documentation.purpose().into()),
        ("result", function.result.to_c().into()),
    ];
    object.extend(function.result_choice.as_ref().map(choice));
    object.extend(function.is_must_use.then_some(("must_use", Json::True)));
    object.push(("returns", function.documentation.returns().into()));
    object.push(("arguments", list(&function.arguments, argument)));
    Json::Object(object)
}

fn argument(argument: &Argument) -> Json {
    let direction = |goes_out: bool| ("direction", if goes_out { "out".into() } else { "in".into() });
    let role = match &argument.role {
        Role::Value => "value",
        Role::Text => "text",
        Role::Handle { .. } => "handle",
        Role::NewHandle { .. } => "new handle",
        Role::Record { .. } => "record",
        Role::Array { .. } => "array",
        Role::Opaque => "opaque",
    };
    let mut object = vec![
        ("name", argument.name.as_str().into()),
        ("type", argument.of.to_c().into()),
        ("role", role.into()),
    ];
    match &argument.role {
        Role::Handle { changes } => {
            object.push(("direction", if *changes { "inout".into() } else { "in".into() }))
        }
        Role::NewHandle { free } => object.push(("free", free.as_str().into())),
        Role::Record { goes_out } => object.push(direction(*goes_out)),
        Role::Array { extents, goes_out } => {
            object.extend([direction(*goes_out), ("extents", self::extents(extents))])
        }
        Role::Value | Role::Text | Role::Opaque => {}
    }
    object.extend(argument.may_be_null.then_some(("null", Json::True)));
    object.extend(argument.choice.as_ref().map(choice));
    object.push(("text", argument.text.as_str().into()));
    Json::Object(object)
}

fn extents(extents: &[String]) -> Json {
    list(extents, |extent| extent.as_str().into())
}

fn choice(choice: &Choice) -> (&'static str, Json) {
    (if choice.are_bits { "bits" } else { "choice" }, choice.enumeration.as_str().into())
}

/// What fits into so many columns stands in one line, so that one change is one line of a comparison.
fn write(value: &Json, depth: usize, text: &mut String) {
    let line = value.to_string();
    let fits = 2 * depth + line.len() <= WIDTH;
    let (open, close, members): (_, _, Vec<(String, &Json)>) = match value {
        Json::List(list) if list.iter().any(|member| matches!(member, Json::Object(_))) => {
            ('[', ']', list.iter().map(|member| (String::new(), member)).collect())
        }
        Json::Object(object) if !fits || line.contains('[') => {
            ('{', '}', object.iter().map(|(name, member)| (format!("\"{name}\": "), member)).collect())
        }
        _ => return text.push_str(&line),
    };
    text.push(open);
    for (i, (name, member)) in members.iter().enumerate() {
        text.push_str(if i == 0 { "\n" } else { ",\n" });
        text.push_str(&"  ".repeat(depth + 1));
        text.push_str(name);
        write(member, depth + 1, text);
    }
    text.push('\n');
    text.push_str(&"  ".repeat(depth));
    text.push(close);
}
