//! `bindings/planish.abi`: what programs that were compiled against the library rely on, one fact a line.
//!
//! Functions with the types of their arguments, fields with type and place, enumerators with their values. More may come
//! with every version, at the end of a record too; a line that is no longer true is a change that breaks programs.

use crate::api::Api;
use std::collections::BTreeSet;

const HEAD: &str = "\
# What compiled programs rely on; `cargo run -p planish-header -- --freeze` writes it, when a version is released that
# programs may be compiled against. Additions need nothing; a line that is no longer true fails the tests.
";

pub fn text(api: &Api) -> String {
    HEAD.to_owned() + &facts(api).into_iter().map(|fact| fact + "\n").collect::<String>()
}

fn facts(api: &Api) -> Vec<String> {
    let enumerators = api.enumerations.iter().flat_map(|enumeration| &enumeration.enumerators);
    let mut facts: Vec<String> = enumerators.map(|each| format!("{} = {}", each.name, each.value)).collect();
    facts.extend(api.constants.iter().map(|constant| format!("{} = {}", constant.name, constant.value)));
    for callback in &api.callbacks {
        let arguments = callback.arguments.iter().map(|(_, of)| of.to_c()).collect::<Vec<_>>();
        facts.push(format!("{} (*{})({})", callback.result.to_c(), callback.name, arguments.join(", ")));
    }
    for record in &api.records {
        let field = |field: &crate::api::Field| {
            format!("{}.{} at {}: {}", record.name, field.name, field.offset, field.of.to_c())
        };
        facts.extend(record.fields.iter().map(field));
    }
    for function in &api.functions {
        let arguments = function.arguments.iter().map(|argument| argument.of.to_c()).collect::<Vec<_>>();
        facts.push(format!("{} {}({})", function.result.to_c(), function.name, arguments.join(", ")));
    }
    facts
}

/// The committed facts that are no longer true.
pub fn broken<'a>(api: &Api, committed: &'a str) -> Vec<&'a str> {
    let true_now: BTreeSet<String> = facts(api).into_iter().collect();
    committed.lines().filter(|line| !line.starts_with('#') && !true_now.contains(*line)).collect()
}
