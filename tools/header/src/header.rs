//! `include/planish.h`, by cbindgen.

use crate::api::Api;
use crate::sources::Source;
use quote::ToTokens;
use std::error::Error;
use std::fs;
use std::path::Path;

pub fn text(root: &Path, sources: &[Source], api: &Api) -> Result<String, Box<dyn Error>> {
    let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml"))?;
    let macros = config.after_includes.take().unwrap_or_default();
    let [major, minor, patch] = &api.version;
    let macros = macros.replace("@MAJOR@", major).replace("@MINOR@", minor).replace("@PATCH@", patch);
    config.after_includes = Some(macros);
    // most enumerations arrive only as integers, so cbindgen would drop them
    config.export.include = api.enumerations.iter().map(|enumeration| enumeration.name.clone()).collect();
    // file by file, not the crate: the core's public constants are none of the header's business
    let folder = std::env::temp_dir().join(format!("planish-header-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in sources {
        let path = folder.join(source.name);
        fs::write(&path, source.file.to_token_stream().to_string())?;
        builder = builder.with_src(path);
    }
    let generated = builder.generate();
    fs::remove_dir_all(&folder)?;
    let mut text = Vec::new();
    generated?.write(&mut text);
    // a flag that another thread sets while the call runs, for which Rust has no type
    Ok(String::from_utf8(text)?.replace("const int32_t *cancel;", "const volatile int32_t *cancel;"))
}
