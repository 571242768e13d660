//! Gives the shared library the soname that the CMake build asks for.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=PLANISH_SONAME");
    // set by CMake only: a plain `cargo build` keeps the name that cargo's own tools expect
    if let Ok(soname) = env::var("PLANISH_SONAME")
        && env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux")
    {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,{soname}");
        // every reference must resolve at link time
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,defs");
    }
}
