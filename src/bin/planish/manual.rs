//! `planish completions` and `planish manual`: what shells and `man` show, made of the arguments themselves.

use crate::{Arguments, Failure, Outcome, output};
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// Which shell.
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManualArguments {
    /// Where to write the pages; it must exist.
    folder: PathBuf,
}

pub(crate) fn complete(arguments: &CompletionsArguments) -> Result<Outcome, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "planish", &mut text);
    output::print(String::from_utf8_lossy(&text))?;
    Ok(Outcome::Done)
}

pub(crate) fn write(arguments: &ManualArguments) -> Result<Outcome, Failure> {
    clap_mangen::generate_to(Arguments::command(), &arguments.folder)?;
    Ok(Outcome::Done)
}
