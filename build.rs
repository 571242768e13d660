//! Gives the shared library its soname: `libplanish.so.0.MINOR` before 1.0, `libplanish.so.MAJOR` after.
//!
//! It depends on the version alone, so that CMake and plain cargo build the very same library and can share
//! one target directory. `cmake/cargo.cmake` follows the same rule.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let part = |name: &str| env::var(name).unwrap_or_default();
    let major = part("CARGO_PKG_VERSION_MAJOR");
    let abi = if major == "0" { format!("0.{}", part("CARGO_PKG_VERSION_MINOR")) } else { major };
    match part("CARGO_CFG_TARGET_OS").as_str() {
        "linux" | "android" | "freebsd" | "netbsd" | "openbsd" | "dragonfly" | "illumos" | "solaris" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libplanish.so.{abi}");
            // every reference must resolve at link time, except those to a sanitizer: the program has it
            if env::var_os("CARGO_CFG_SANITIZE").is_none() {
                println!("cargo::rustc-cdylib-link-arg=-Wl,-z,defs");
            }
        }
        "macos" | "ios" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libplanish.{abi}.dylib");
        }
        _ => {} // Windows has no sonames
    }
}
