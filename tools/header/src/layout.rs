//! `cpp_tests/layout.c`: what a C compiler must find of the records.

use crate::api::{Api, Record};

const HEAD: &str = "\
/* Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.
 *
 * Records have the layout that other languages copy: no implicit padding, fields where they are told to be. */
#include \"planish.h\"

#include <stddef.h>

#define HOLDS(name, condition) typedef char name[(condition) ? 1 : -1]
#define END(record, field) (offsetof(record, field) + sizeof(((record *)0)->field))
/* `field` lies right behind `before`, so no padding is between them */
#define FOLLOWS(record, before, field) \\
  HOLDS(record##_##field##_follows, offsetof(record, field) == END(record, before))
#define FIRST(record) HOLDS(record##_begins_with_its_size, offsetof(record, struct_size) == 0)
#define LAST(record, field) HOLDS(record##_ends_with_##field, sizeof(record) == END(record, field))

HOLDS(status_is_an_int, sizeof(planish_status) == sizeof(int));
";

pub fn text(api: &Api) -> String {
    HEAD.to_owned() + &api.records.iter().map(record).collect::<String>()
}

fn record(record: &Record) -> String {
    let name = &record.name;
    let mut text = format!("\nFIRST({name});\n");
    for pair in record.fields.windows(2) {
        text.push_str(&format!("FOLLOWS({name}, {}, {});\n", pair[0].name, pair[1].name));
    }
    if let Some(last) = record.fields.last() {
        text.push_str(&format!("LAST({name}, {});\n", last.name));
    }
    text
}
