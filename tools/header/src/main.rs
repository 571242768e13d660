//! Writes what follows from `src/ffi`; with `--verify` it only tells whether the files are up to date and no promise is
//! broken:
//!
//! | file | for |
//! |---|---|
//! | `include/planish.h` | C and C++ |
//! | `bindings/planish.api.json` | programs that write or check bindings |
//! | `bindings/planish_c.f90` | Fortran: names, records and interfaces below `include/planish.f90` |
//! | `python/planish/_abi.py` | Python: the same for ctypes |
//! | `cpp_tests/layout.c` | the tests: where a C compiler must put the fields of records |
//!
//! With `--freeze` it also writes `bindings/planish.abi`, the promises that `--verify` holds the interface to.
//!
//! Rust's declarations say the most; the rest is read from their documentation, where readers of the header need
//! it too. What is missing is an error, which names the place.
//!
//! * **Arrays.** One line before `Returns` (or at the end) gives the extents of each array among the arguments,
//!   slowest first; what is `const` comes in, the rest goes out. A pointer to a single number is an array of one.
//!   ```text
//!   /// Arrays: uv[count, 2], out_values[count, surface_dim], out_count[1].
//!   ```
//!   An extent is a number, an argument, a field `options.dim`, a function without its `planish_`
//!   (`mesh_point_count`), sums and products of these, or `*` where only the text can tell. The line may go on in
//!   the next, indented. Texts, handles, records and `void *user` are none of its business, arrays of handles are.
//!   A record's array has the line for itself, with words such as `data`, `nodes` or `points` for what a call is given:
//!   ```text
//!   /// A positive weight for each datum; NULL (default) for all 1.
//!   /// Array: [data].
//!   pub weights: *const f64,
//!   ```
//! * **Choices.** The text of a number that stands for an enumerator says so: "A planish_axis", "bits of planish_flag".
//! * **Defaults.** The text of an option has "X (default)" or "Default X": a number, an enumerator, NULL, infinity.
//!   Zero and NULL need not be told.
//! * **NULL.** An argument whose text speaks of NULL otherwise than as "not NULL" may be NULL.
//! * **Freeing.** A new handle, `out_x: *mut *mut planish_x`, is destroyed by `planish_x_free`, which must exist.

mod abi;
mod api;
mod documentation;
mod fortran;
mod header;
mod json;
mod layout;
mod python;
mod sources;

use api::Api;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let task = match std::env::args().skip(1).collect::<Vec<_>>().as_slice() {
        [] => Task::Renew,
        [flag] if flag == "--verify" => Task::Verify,
        [flag] if flag == "--freeze" => Task::Freeze,
        _ => {
            eprintln!("usage: planish-header [--verify | --freeze]");
            return ExitCode::FAILURE;
        }
    };
    match run(task) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("planish-header: {error}");
            ExitCode::FAILURE
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Task {
    Renew,
    Verify,
    Freeze,
}

/// Where the promises stand.
const PROMISES: &str = "bindings/planish.abi";

fn run(task: Task) -> Result<ExitCode, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let version = version(&fs::read_to_string(root.join("Cargo.toml"))?)?;
    let files = sources::read(&root.join("src/ffi"))?;
    let api = Api::new(&files, &version)?;
    let written = [
        ("include/planish.h", header::text(&root, &files, &api)?),
        ("bindings/planish.api.json", json::text(&api)),
        ("bindings/planish_c.f90", fortran::text(&api)),
        ("python/planish/_abi.py", python::text(&api)),
        ("cpp_tests/layout.c", layout::text(&api)),
    ];
    let mut same = true;
    for (name, text) in &written {
        same &=
            if task == Task::Verify { is_up_to_date(&root, name, text) } else { renew(&root, name, text)? };
    }
    match task {
        Task::Renew => {}
        Task::Verify => same &= keeps_promises(&api, &fs::read_to_string(root.join(PROMISES))?),
        Task::Freeze => same &= renew(&root, PROMISES, &abi::text(&api))?,
    }
    Ok(if same { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Writes a file, unless it is what it should be: its time of change then stays too.
fn renew(root: &Path, name: &str, text: &str) -> Result<bool, Box<dyn Error>> {
    let path = root.join(name);
    if fs::read_to_string(&path).ok().as_deref() != Some(text) {
        fs::create_dir_all(path.parent().unwrap_or(root))?;
        fs::write(&path, text)?;
    }
    Ok(true)
}

/// Compares a file with what it should be, and tells where they part.
fn is_up_to_date(root: &Path, name: &str, text: &str) -> bool {
    let committed = fs::read_to_string(root.join(name)).unwrap_or_default();
    if committed == text {
        return true;
    }
    let same = committed.lines().zip(text.lines()).take_while(|(old, new)| old == new).count();
    eprintln!("{name} is not what src/ffi says; they part at line {}:", same + 1);
    eprintln!("  committed: {}", committed.lines().nth(same).unwrap_or("(end of file)"));
    eprintln!("  generated: {}", text.lines().nth(same).unwrap_or("(end of file)"));
    eprintln!("`cargo run -p planish-header` renews it");
    false
}

/// Whether all that compiled programs rely on is still so.
fn keeps_promises(api: &Api, committed: &str) -> bool {
    let broken = abi::broken(api, committed);
    for fact in &broken {
        eprintln!("{PROMISES}: no longer true: {fact}");
    }
    broken.is_empty()
}

/// Major, minor and patch version of the library.
fn version(manifest: &str) -> Result<[String; 3], Box<dyn Error>> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("version = "));
    let parts = line.ok_or("Cargo.toml has no version")?.trim_matches('"').split('.').map(str::to_owned);
    let parts: Vec<String> = parts.collect();
    Ok(parts.try_into().map_err(|_| "the version in Cargo.toml has not three numbers")?)
}
