//! Writes `include/planish.h` from `src/ffi`; with `--verify` it only tells whether the file is up to date.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// The files of `src/ffi` in the order of the header.
const SOURCES: &[&str] = &[
    "status.rs",
    "progress.rs",
    "mesh.rs",
    "decimate.rs",
    "parameterize.rs",
    "report.rs",
    "surface.rs",
    "patch.rs",
    "tensor.rs",
    "field.rs",
    "transfer.rs",
    "query.rs",
    "rows.rs",
    "export.rs",
    "step.rs",
    "curve.rs",
    "curve_query.rs",
    "tspline.rs",
    "pht.rs",
    "pht_parts.rs",
    "d1rc.rs",
    "d1rc_fit.rs",
];

fn main() -> ExitCode {
    let verify = match std::env::args().skip(1).collect::<Vec<_>>().as_slice() {
        [] => false,
        [flag] if flag == "--verify" => true,
        _ => {
            eprintln!("usage: planish-header [--verify]");
            return ExitCode::FAILURE;
        }
    };
    match run(verify) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("planish-header: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(verify: bool) -> Result<ExitCode, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let path = root.join("include/planish.h");
    let header = header(&root)?;
    let committed = fs::read_to_string(&path).unwrap_or_default();
    if committed == header {
        return Ok(ExitCode::SUCCESS);
    }
    if !verify {
        fs::create_dir_all(root.join("include"))?;
        fs::write(&path, header)?;
        return Ok(ExitCode::SUCCESS);
    }
    let same = committed.lines().zip(header.lines()).take_while(|(old, new)| old == new).count();
    eprintln!("include/planish.h is not what src/ffi says; they part at line {}:", same + 1);
    eprintln!("  committed: {}", committed.lines().nth(same).unwrap_or("(end of file)"));
    eprintln!("  generated: {}", header.lines().nth(same).unwrap_or("(end of file)"));
    eprintln!("`cargo run -p planish-header` renews it");
    Ok(ExitCode::FAILURE)
}

/// The text of the header.
fn header(root: &Path) -> Result<String, Box<dyn Error>> {
    let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml"))?;
    let version = version(&fs::read_to_string(root.join("Cargo.toml"))?)?;
    let macros = config.after_includes.take().unwrap_or_default();
    let [major, minor, patch] = version;
    let macros = macros.replace("@MAJOR@", &major).replace("@MINOR@", &minor).replace("@PATCH@", &patch);
    config.after_includes = Some(macros);
    let sources = SOURCES.iter().map(|name| root.join("src/ffi").join(name));
    // file by file, not the crate: the core's public constants are none of the header's business
    let builder = sources.fold(cbindgen::Builder::new().with_config(config), |b, path| b.with_src(path));
    let mut text = Vec::new();
    builder.generate()?.write(&mut text);
    Ok(String::from_utf8(text)?)
}

/// Major, minor and patch version of the library.
fn version(manifest: &str) -> Result<[String; 3], Box<dyn Error>> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("version = "));
    let parts = line.ok_or("Cargo.toml has no version")?.trim_matches('"').split('.').map(str::to_owned);
    let parts: Vec<String> = parts.collect();
    Ok(parts.try_into().map_err(|_| "the version in Cargo.toml has not three numbers")?)
}
