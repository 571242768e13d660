//! What integration tests share.
#![allow(dead_code, reason = "each test file uses a part of it")]

use std::path::PathBuf;

/// A file of the data folder beside the checkout; None, with a visible line, where it is absent.
pub fn shared_data(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!("SKIPPED: {name} is not in ../shared/data");
    None
}
