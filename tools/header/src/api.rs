//! What the C interface consists of.

use crate::documentation::{Documentation, words};
use crate::sources::Source;
use std::collections::BTreeSet;
use syn::ext::IdentExt;

pub struct Api {
    pub version: [String; 3],
    pub constants: Vec<Constant>,
    pub enumerations: Vec<Enumeration>,
    pub handles: Vec<Handle>,
    pub callbacks: Vec<Callback>,
    pub records: Vec<Record>,
    pub functions: Vec<Function>,
}

/// `#define NAME VALUE`.
pub struct Constant {
    pub name: String,
    pub value: u64,
    pub documentation: Documentation,
}

pub struct Enumeration {
    pub name: String,
    pub enumerators: Vec<Enumerator>,
    pub documentation: Documentation,
}

pub struct Enumerator {
    /// As in C, such as `PLANISH_STATUS_OK`.
    pub name: String,
    /// Without the name of its enumeration, such as `ok`.
    pub word: String,
    pub value: i64,
    pub documentation: Documentation,
}

/// A type that C knows by pointers only.
pub struct Handle {
    pub name: String,
    pub documentation: Documentation,
}

pub struct Callback {
    pub name: String,
    pub arguments: Vec<(String, Type)>,
    pub result: Type,
    pub documentation: Documentation,
}

pub struct Record {
    pub name: String,
    pub fields: Vec<Field>,
    /// Bytes where pointers have 8.
    pub size: usize,
    pub documentation: Documentation,
}

pub struct Field {
    pub name: String,
    pub of: Type,
    /// Bytes from the record's begin, where pointers have 8.
    pub offset: usize,
    /// The enumeration that the number stands for, and whether it holds bits of several.
    pub choice: Option<Choice>,
    /// The extents of the array that it points to.
    pub array: Option<Vec<String>>,
    pub default: Option<String>,
    pub documentation: Documentation,
}

#[derive(Debug, Clone)]
pub struct Choice {
    pub enumeration: String,
    pub are_bits: bool,
}

pub struct Function {
    pub name: String,
    pub arguments: Vec<Argument>,
    pub result: Type,
    pub result_choice: Option<Choice>,
    pub is_must_use: bool,
    pub documentation: Documentation,
}

pub struct Argument {
    pub name: String,
    pub of: Type,
    pub role: Role,
    pub may_be_null: bool,
    pub choice: Option<Choice>,
    pub text: String,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Role {
    Value,
    /// A text that comes in, ended by NUL.
    Text,
    /// A handle; `changes` if the call may change it.
    Handle {
        changes: bool,
    },
    /// Receives a handle, which `free` destroys.
    NewHandle {
        free: String,
    },
    /// A record that comes in, or that is filled.
    Record {
        goes_out: bool,
    },
    /// An array of numbers, bytes or handles.
    Array {
        extents: Vec<String>,
        goes_out: bool,
    },
    /// Handed through as it is.
    Opaque,
}

/// A C type: `count` elements (a field only) or pointers to `base`, each read-only or not, the outermost first.
#[derive(Debug, Clone, PartialEq)]
pub struct Type {
    pub base: Base,
    pub pointers: Vec<Pointer>,
    pub count: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pointer {
    Const,
    Mut,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Base {
    Void,
    Char,
    Number(&'static str),
    Status,
    Record(String),
    Handle(String),
    Callback(String),
}

/// Rust's numbers that cross the border, with their names in C and their bytes.
pub const NUMBERS: &[(&str, &str, usize)] = &[
    ("f64", "double", 8),
    ("usize", "size_t", 8),
    ("i32", "int32_t", 4),
    ("u32", "uint32_t", 4),
    ("u8", "uint8_t", 1),
    ("i64", "int64_t", 8),
    ("u64", "uint64_t", 8),
];

impl Type {
    pub fn size(&self) -> usize {
        let one = match &self.base {
            _ if !self.pointers.is_empty() => 8,
            Base::Number(number) => {
                NUMBERS.iter().find(|(_, c, _)| c == number).map_or(0, |&(_, _, size)| size)
            }
            Base::Callback(_) => 8,
            Base::Status => 4,
            Base::Char => 1,
            Base::Void | Base::Record(_) | Base::Handle(_) => 0,
        };
        one * self.count.unwrap_or(1)
    }

    /// Whether it has the size of an address: pointers, callbacks and `size_t`.
    pub fn is_word(&self) -> bool {
        !self.pointers.is_empty() || matches!(self.base, Base::Callback(_) | Base::Number("size_t"))
    }

    /// As C writes it, without a name.
    pub fn to_c(&self) -> String {
        let base = match &self.base {
            Base::Void => "void",
            Base::Char => "char",
            Base::Number(number) => number,
            Base::Status => "planish_status",
            Base::Record(name) | Base::Handle(name) | Base::Callback(name) => name,
        };
        let text = match self.pointers.as_slice() {
            [] => base.to_owned(),
            [Pointer::Const] => format!("const {base} *"),
            [Pointer::Mut] => format!("{base} *"),
            [Pointer::Const, Pointer::Const] => format!("const {base} *const *"),
            _ => format!("{base} **"),
        };
        self.count.map_or(text.clone(), |count| format!("{text}[{count}]"))
    }
}

/// Names of the types declared, to tell one kind of type from another.
struct Names {
    enumerations: BTreeSet<String>,
    records: BTreeSet<String>,
    handles: BTreeSet<String>,
    callbacks: BTreeSet<String>,
}

impl Api {
    /// All that the files declare; else every complaint about them.
    pub fn new(sources: &[Source], version: &[String; 3]) -> Result<Self, String> {
        let mut problems = Vec::new();
        let items: Vec<(&str, &syn::Item)> = sources
            .iter()
            .flat_map(|source| source.file.items.iter().map(|item| (source.name, item)))
            .collect();
        let names = Names {
            enumerations: names_of(&items, |item| match item {
                syn::Item::Enum(item) if is_c(&item.attrs) => Some(&item.ident),
                _ => None,
            }),
            records: names_of(&items, |item| match item {
                syn::Item::Struct(item) if is_c(&item.attrs) => Some(&item.ident),
                _ => None,
            }),
            handles: names_of(&items, |item| match item {
                syn::Item::Struct(item) if is_handle(item) => Some(&item.ident),
                _ => None,
            }),
            callbacks: names_of(&items, |item| match item {
                syn::Item::Type(item) if is_public(&item.vis) => Some(&item.ident),
                _ => None,
            }),
        };
        let mut api = Self {
            version: version.clone(),
            constants: Vec::new(),
            enumerations: Vec::new(),
            handles: Vec::new(),
            callbacks: Vec::new(),
            records: Vec::new(),
            functions: Vec::new(),
        };
        for (file, item) in items {
            if let Err(problem) = api.add(item, &names) {
                problems.push(format!("src/ffi/{file}: {problem}"));
            }
        }
        problems.extend(api.check());
        if problems.is_empty() { Ok(api) } else { Err(format!("\n  {}", problems.join("\n  "))) }
    }

    fn add(&mut self, item: &syn::Item, names: &Names) -> Result<(), String> {
        match item {
            syn::Item::Const(item) if is_public(&item.vis) => self.constants.push(constant(item)?),
            syn::Item::Enum(item) if is_c(&item.attrs) => self.enumerations.push(enumeration(item)?),
            syn::Item::Struct(item) if is_c(&item.attrs) => self.records.push(record(item, names)?),
            syn::Item::Struct(item) if is_handle(item) => self.handles.push(Handle {
                name: item.ident.to_string(),
                documentation: Documentation::new(&item.attrs),
            }),
            syn::Item::Type(item) if is_public(&item.vis) => self.callbacks.push(callback(item, names)?),
            syn::Item::Fn(item) if is_exported(item) => self.functions.push(function(item, names)?),
            _ => {}
        }
        Ok(())
    }

    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions.iter().find(|function| function.name == name)
    }

    /// What only the whole can tell: extents that nothing has, handles that nothing destroys.
    fn check(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for function in &self.functions {
            for argument in &function.arguments {
                match &argument.role {
                    Role::NewHandle { free } if self.function(free).is_none() => {
                        problems
                            .push(format!("{}: there is no {free}() for {}", function.name, argument.name));
                    }
                    Role::Array { extents, .. } => {
                        let wrong = extents.iter().flat_map(|extent| self.unknown(function, extent));
                        problems.extend(wrong.map(|word| {
                            format!(
                                "{}: '{word}' in the extents of {} is neither a number, an argument, options.field nor a \
                                 function without planish_; '*' leaves it to the text",
                                function.name, argument.name
                            )
                        }));
                    }
                    _ => {}
                }
            }
        }
        problems
    }

    /// The words of an extent that mean nothing.
    fn unknown<'a>(&self, function: &Function, extent: &'a str) -> Vec<&'a str> {
        let parts = extent.split([' ', '+', '-', '*', '(', ')']).filter(|word| !word.is_empty());
        let is_known = |word: &&str| {
            let argument = |name: &str| function.arguments.iter().find(|argument| argument.name == name);
            if let Some((record, field)) = word.split_once('.') {
                let Some(Base::Record(of)) = argument(record).map(|argument| &argument.of.base) else {
                    return false;
                };
                let of = self.records.iter().find(|record| record.name == *of);
                return of.is_some_and(|record| record.fields.iter().any(|other| other.name == field));
            }
            word.bytes().all(|c| c.is_ascii_digit())
                || argument(word).is_some()
                || self.function(&format!("planish_{word}")).is_some()
        };
        parts.filter(|word| !is_known(word)).collect()
    }

    /// How many bytes the numbers have that stand for an enumeration: 4 unless a field says otherwise.
    pub fn width(&self, enumeration: &str) -> usize {
        let fields = self.records.iter().flat_map(|record| &record.fields);
        let mut of_it =
            fields.filter(|field| field.choice.as_ref().is_some_and(|c| c.enumeration == enumeration));
        of_it.next().map_or(4, |field| match &field.of {
            of if of.pointers.is_empty() => of.size(),
            Type { base: Base::Number("uint8_t"), .. } => 1,
            _ => 4,
        })
    }
}

fn names_of<'a>(
    items: &[(&str, &'a syn::Item)],
    name: impl Fn(&'a syn::Item) -> Option<&'a syn::Ident>,
) -> BTreeSet<String> {
    items.iter().filter_map(|(_, item)| name(item)).map(|name| name.to_string()).collect()
}

fn is_public(visibility: &syn::Visibility) -> bool {
    matches!(visibility, syn::Visibility::Public(_))
}

/// Whether a type is `repr(C)` or of a number's representation.
fn is_c(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| attribute.path().is_ident("repr"))
}

fn is_handle(item: &syn::ItemStruct) -> bool {
    is_public(&item.vis) && !is_c(&item.attrs) && item.ident.to_string().starts_with("planish_")
}

fn is_exported(item: &syn::ItemFn) -> bool {
    is_public(&item.vis) && item.sig.abi.is_some()
}

fn constant(item: &syn::ItemConst) -> Result<Constant, String> {
    let name = item.ident.to_string();
    let value = match &*item.expr {
        syn::Expr::Path(path) if path.path.segments.last().is_some_and(|last| last.ident == "MAX") => {
            match path.path.segments.first().map(|first| first.ident.to_string()).as_deref() {
                Some("u32") => u32::MAX.into(),
                Some("u64" | "usize") => u64::MAX,
                _ => return Err(format!("{name}: a value that tools/header cannot tell")),
            }
        }
        other => {
            u64::try_from(number(other).ok_or(format!("{name}: a value that tools/header cannot tell"))?)
                .map_err(|_| format!("{name} is negative"))?
        }
    };
    Ok(Constant { name, value, documentation: Documentation::new(&item.attrs) })
}

/// The value of a literal, negative or shifted.
fn number(expression: &syn::Expr) -> Option<i64> {
    match expression {
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => number.base10_parse().ok(),
        syn::Expr::Unary(syn::ExprUnary { op: syn::UnOp::Neg(_), expr, .. }) => {
            number(expr).map(|value| -value)
        }
        syn::Expr::Binary(syn::ExprBinary { left, op: syn::BinOp::Shl(_), right, .. }) => {
            Some(number(left)? << number(right)?)
        }
        _ => None,
    }
}

fn enumeration(item: &syn::ItemEnum) -> Result<Enumeration, String> {
    let name = item.ident.to_string();
    let mut next = 0;
    let mut enumerators = Vec::new();
    for variant in &item.variants {
        if let Some((_, value)) = &variant.discriminant {
            next = number(value)
                .ok_or(format!("{name}::{}: a value that tools/header cannot tell", variant.ident))?;
        }
        let word = snake_case(&variant.ident.to_string());
        enumerators.push(Enumerator {
            name: format!("{name}_{word}").to_uppercase(),
            word,
            value: next,
            documentation: Documentation::new(&variant.attrs),
        });
        next += 1;
    }
    Ok(Enumeration { name, enumerators, documentation: Documentation::new(&item.attrs) })
}

/// `ToleranceNotMet` as `tolerance_not_met`.
fn snake_case(name: &str) -> String {
    let mut words = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !words.is_empty() {
            words.push('_');
        }
        words.push(c.to_ascii_lowercase());
    }
    words
}

fn callback(item: &syn::ItemType, names: &Names) -> Result<Callback, String> {
    let name = item.ident.to_string();
    let wrong = || format!("{name} is not Option<extern fn>");
    let syn::Type::Path(path) = &*item.ty else { return Err(wrong()) };
    let segment = path.path.segments.last().ok_or_else(wrong)?;
    let syn::PathArguments::AngleBracketed(inner) = &segment.arguments else { return Err(wrong()) };
    let Some(syn::GenericArgument::Type(syn::Type::BareFn(function))) = inner.args.first() else {
        return Err(wrong());
    };
    let mut arguments = Vec::new();
    for input in &function.inputs {
        let (argument, _) = input.name.as_ref().ok_or(format!("{name}: an argument without a name"))?;
        arguments.push((argument.unraw().to_string(), type_of(&input.ty, names)?));
    }
    let result = result_of(&function.output, names)?;
    Ok(Callback { name, arguments, result, documentation: Documentation::new(&item.attrs) })
}

fn record(item: &syn::ItemStruct, names: &Names) -> Result<Record, String> {
    let name = item.ident.to_string();
    let mut fields: Vec<Field> = Vec::new();
    let (mut size, mut widest) = (0_usize, 1);
    for field in &item.fields {
        let field_name = field.ident.as_ref().map(|name| name.unraw().to_string()).unwrap_or_default();
        let told = |problem: String| format!("{name}.{field_name}: {problem}");
        let documentation = Documentation::new(&field.attrs);
        let of = type_of(&field.ty, names).map_err(told)?;
        let width = of.size() / of.count.unwrap_or(1);
        if width == 0 || size % width != 0 {
            return Err(told(
                "it would not lie where the one before it ends: larger fields come first".into(),
            ));
        }
        let array = documentation.array().map_err(told)?;
        let points_to_numbers = !of.pointers.is_empty() && matches!(of.base, Base::Number(_));
        if points_to_numbers && array.is_none() && field_name != "cancel" {
            return Err(told(
                "its documentation lacks a line 'Array: [extent, ...].' (see tools/header)".into(),
            ));
        }
        fields.push(Field {
            choice: choice(&of, &documentation.text(), names),
            default: documentation.default(),
            offset: size,
            name: field_name,
            array,
            documentation,
            of,
        });
        widest = widest.max(width);
        size = fields.last().map_or(0, |last| last.offset + last.of.size());
    }
    if size % widest != 0 {
        return Err(format!("{name} would be padded at its end: add 'pub reserved: u32' or another field"));
    }
    Ok(Record { name, fields, size, documentation: Documentation::new(&item.attrs) })
}

fn function(item: &syn::ItemFn, names: &Names) -> Result<Function, String> {
    let name = item.sig.ident.to_string();
    let told = |problem: String| format!("{name}: {problem}");
    let documentation = Documentation::new(&item.attrs);
    let mut arrays = documentation.arrays().map_err(told)?;
    let texts = documentation.arguments();
    let mut arguments = Vec::new();
    for input in &item.sig.inputs {
        let syn::FnArg::Typed(input) = input else { return Err(told("it has self".into())) };
        let syn::Pat::Ident(pattern) = &*input.pat else {
            return Err(told("an argument without a name".into()));
        };
        let argument = pattern.ident.unraw().to_string();
        let of = type_of(&input.ty, names).map_err(told)?;
        let text = texts.get(&argument).cloned().unwrap_or_default();
        let role = role(&argument, &of, arrays.remove(&argument)).map_err(told)?;
        arguments.push(Argument {
            may_be_null: !of.pointers.is_empty() && may_be_null(&text),
            choice: choice(&of, &text, names),
            name: argument,
            text,
            role,
            of,
        });
    }
    if let Some((array, _)) = arrays.first_key_value() {
        return Err(told(format!("'Arrays:' has {array}, which is no array among the arguments")));
    }
    let result = result_of(&item.sig.output, names).map_err(told)?;
    let is_must_use = item.attrs.iter().any(|attribute| attribute.path().is_ident("must_use"));
    let result_choice = choice(&result, &documentation.purpose(), names);
    Ok(Function { name, arguments, result, result_choice, is_must_use, documentation })
}

/// Whether a text grants NULL: it speaks of it, and does not forbid it.
fn may_be_null(text: &str) -> bool {
    text.replace("not NULL", "").replace("none of them NULL", "").contains("NULL")
}

fn role(name: &str, of: &Type, extents: Option<Vec<String>>) -> Result<Role, String> {
    let goes_out = of.pointers.first() == Some(&Pointer::Mut);
    if let Some(extents) = extents {
        return if of.pointers.is_empty() {
            Err(format!("'Arrays:' has {name}, which is no pointer"))
        } else {
            Ok(Role::Array { extents, goes_out })
        };
    }
    match (&of.base, of.pointers.as_slice()) {
        (_, []) => Ok(Role::Value),
        (Base::Char, [Pointer::Const]) => Ok(Role::Text),
        (Base::Handle(_), [_]) => Ok(Role::Handle { changes: goes_out }),
        (Base::Handle(of), [Pointer::Mut, Pointer::Mut]) => {
            Ok(Role::NewHandle { free: format!("{of}_free") })
        }
        (Base::Record(_), [_]) => Ok(Role::Record { goes_out }),
        (Base::Void, [_]) if name == "user" => Ok(Role::Opaque),
        (Base::Number("int32_t"), [Pointer::Const]) if name == "cancel" => Ok(Role::Opaque),
        _ => Err(format!(
            "a line 'Arrays: {name}[extent, ...].' is missing in its documentation (see tools/header)"
        )),
    }
}

/// The enumeration that a number's text names first.
fn choice(of: &Type, text: &str, names: &Names) -> Option<Choice> {
    if !matches!(of.base, Base::Number("uint32_t" | "uint64_t" | "uint8_t" | "int32_t")) {
        return None;
    }
    let enumeration = words(text).find(|word| names.enumerations.contains(*word))?.to_owned();
    let are_bits = text.to_lowercase().contains(&format!("bits of {enumeration}"));
    Some(Choice { enumeration, are_bits })
}

fn result_of(output: &syn::ReturnType, names: &Names) -> Result<Type, String> {
    match output {
        syn::ReturnType::Default => Ok(Type { base: Base::Void, pointers: Vec::new(), count: None }),
        syn::ReturnType::Type(_, of) => type_of(of, names),
    }
}

fn type_of(of: &syn::Type, names: &Names) -> Result<Type, String> {
    match of {
        syn::Type::Ptr(pointer) => {
            let mut of = type_of(&pointer.elem, names)?;
            of.pointers.insert(0, if pointer.mutability.is_some() { Pointer::Mut } else { Pointer::Const });
            Ok(of)
        }
        syn::Type::Array(array) => {
            let count = number(&array.len).and_then(|count| usize::try_from(count).ok());
            Ok(Type {
                count: Some(count.ok_or("an array's length is no literal")?),
                ..type_of(&array.elem, names)?
            })
        }
        syn::Type::Path(path) => {
            let name = path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
            let base = match name.as_str() {
                "c_void" => Base::Void,
                "c_char" => Base::Char,
                "planish_status" => Base::Status,
                _ if names.records.contains(&name) => Base::Record(name),
                _ if names.handles.contains(&name) => Base::Handle(name),
                _ if names.callbacks.contains(&name) => Base::Callback(name),
                _ => {
                    let number = NUMBERS.iter().find(|(rust, _, _)| *rust == name);
                    Base::Number(number.ok_or(format!("{name} cannot cross the border"))?.1)
                }
            };
            Ok(Type { base, pointers: Vec::new(), count: None })
        }
        _ => Err("a type that cannot cross the border".into()),
    }
}
