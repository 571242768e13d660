//! What integration tests share: meshes that every checkout has, and those of the data folder beside it.
#![allow(dead_code, reason = "each test file uses a part of it")]

use planish::mesh::{Mesh, MeshOptions, read};
use planish::samples;
use std::io::Write;
use std::path::PathBuf;

/// A file of the data folder beside the checkout; None, and a line that says so, where it is absent. The line goes
/// round libtest, which swallows what passing tests print, and into the file that `PLANISH_SKIPPED` names: the last
/// lines of scripts/test tell how many tests were skipped in whole or in part.
pub(crate) fn shared_data(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    let thread = std::thread::current();
    let line = format!("SKIPPED: {} without {name} of ../shared/data\n", thread.name().unwrap_or("a test"));
    // a test need not fail because nobody hears that it is skipped
    let _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(log) = std::env::var_os("PLANISH_SKIPPED") {
        let file = std::fs::OpenOptions::new().create(true).append(true).open(log);
        let _ = file.and_then(|mut file| file.write_all(line.as_bytes()));
    }
    None
}

/// A mesh by its name: one of the samples, which are always there, or a file of the data folder.
pub(crate) fn mesh(name: &str) -> Option<Mesh> {
    let sample = match name {
        "bust" => samples::bust(1),
        "bracket" => samples::bracket(),
        "rocker" => samples::rocker(1500, 1),
        "limb" => samples::limb(1),
        file => {
            let path = shared_data(file)?;
            return Some(read(&path, &MeshOptions::default()).unwrap_or_else(|e| panic!("{file}: {e}")).0);
        }
    };
    Some(sample.unwrap_or_else(|error| panic!("{name}: {error}")))
}
