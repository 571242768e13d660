//! `planish`: fits, measures and converts from the command line; a thin client of the library.
//!
//! Exit code 0: done, and the tolerance met at the nodes and between them; 2: done, but the tolerance not met; 1: any error.

mod bar;
mod convert;
mod d1rc;
mod decimate;
mod eval;
mod fair;
mod fit;
mod fit_options;
mod info;
mod input;
mod manual;
mod model;
mod morph;
mod output;
mod picture;
mod render;
mod rows;
mod sample;
mod skin;
mod step;
mod topics;
mod trim;
mod verdict;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use planish::memory;
use std::io::Write;
use std::process::ExitCode;

/// Smooth spline surfaces from triangle meshes, within a stated tolerance.
#[derive(Debug, Parser)]
#[command(name = "planish", version, max_term_width = 100, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// What every help ends with.
const EXIT_CODES: &str = "\
Exit codes: 0 done, and the tolerance met at the nodes and between them; 2 done and written, but the tolerance not met;
1 any error, told in one line.
More by subject: planish help topics";

#[derive(Debug, Subcommand)]
#[allow(clippy::large_enum_variant, reason = "there is one in a run")]
enum Command {
    /// Fit a surface to a mesh file (OFF, OBJ, PLY, STL) and report how close it came.
    Fit(fit_options::FitArguments),
    /// Skin rows of points by one surface and report how close it came.
    Skin(skin::SkinArguments),
    /// Make a mesh of fewer nodes by collapsing edges; sharp edges and the boundary stay.
    Decimate(decimate::DecimateArguments),
    /// Make a smooth surface from a triangular control mesh.
    D1rc(d1rc::D1rcArguments),
    /// Write what was saved, or a mesh, in other formats: STEP, VTK, OBJ, OFF, PLY, STL, glTF.
    Convert(convert::ConvertArguments),
    /// Say what a mesh file or a saved surface holds.
    Info(info::InfoArguments),
    /// Evaluate a saved surface.
    Eval(eval::EvalArguments),
    /// Lower the energy of a saved surface within a tolerance.
    Fair(fair::FairArguments),
    /// Trim a saved surface along closed curves near it and report how close the trims came.
    Trim(trim::TrimArguments),
    /// Draw a sequence of pictures of a mesh's surface, moved by a displacement on its nodes.
    Morph(morph::MorphArguments),
    /// Draw a picture of a saved surface.
    Render(render::RenderArguments),
    /// Write one of the seeded sample meshes.
    Sample(sample::SampleArguments),
    /// Explain a subject: tolerance, families, files, units, repair, reports, exit codes.
    Topics(topics::TopicsArguments),
    /// Print completions for a shell.
    Completions(manual::CompletionsArguments),
    /// Write the manual's pages, planish.1 and one for each command, into a folder.
    #[command(hide = true)]
    Manual(manual::ManualArguments),
}

/// How a command ended well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Done,
    ToleranceNotMet,
}

/// Why a command failed: one sentence.
#[derive(Debug)]
struct Failure(String);

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

impl Failure {
    fn new(sentence: impl Into<String>) -> Self {
        Self(sentence.into())
    }
}

/// Which options stand on the command line, whatever their values.
struct Given<'a>(Option<&'a ArgMatches>);

impl Given<'_> {
    /// Refuses an option that was given although it would do nothing; `why` goes on after its name.
    fn refuse(&self, option: &str, is_used: bool, why: &str) -> Result<(), Failure> {
        let is_given = self.0.is_some_and(|matches| {
            matches.value_source(&option.replace('-', "_")) == Some(ValueSource::CommandLine)
        });
        match is_given && !is_used {
            true => Err(Failure::new(format!("--{option} {why}"))),
            false => Ok(()),
        }
    }
}

fn main() -> ExitCode {
    let parsed = Arguments::command().try_get_matches();
    let parsed = parsed.and_then(|matches| Ok((Arguments::from_arg_matches(&matches)?, matches)));
    let (arguments, matches) = match parsed {
        Ok(arguments) => arguments,
        Err(error) if is_help(error.kind()) => {
            // help and version; a closed pipe is no error of ours
            let _ = write!(std::io::stdout(), "{}", error.render());
            return ExitCode::SUCCESS;
        }
        Err(error) => return fail(&usage(&error.to_string())),
    };
    let given = Given(matches.subcommand().map(|(_, matches)| matches));
    let outcome = memory::catch(|| run(&arguments.command, &given));
    match outcome.unwrap_or_else(|error| Err(error.into())) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::ToleranceNotMet) => ExitCode::from(2),
        Err(Failure(sentence)) => fail(&sentence),
    }
}

fn run(command: &Command, given: &Given) -> Result<Outcome, Failure> {
    match command {
        Command::Fit(arguments) => fit::run(arguments, given),
        Command::Skin(arguments) => skin::run(arguments, given),
        Command::Decimate(arguments) => decimate::run(arguments, given),
        Command::D1rc(arguments) => d1rc::run(arguments, given),
        Command::Convert(arguments) => convert::run(arguments, given),
        Command::Info(arguments) => info::run(arguments, given),
        Command::Eval(arguments) => eval::run(arguments),
        Command::Fair(arguments) => fair::run(arguments, given),
        Command::Trim(arguments) => trim::run(arguments, given),
        Command::Morph(arguments) => morph::run(arguments),
        Command::Render(arguments) => render::run(arguments, given),
        Command::Sample(arguments) => sample::run(arguments, given),
        Command::Topics(arguments) => topics::run(arguments),
        Command::Completions(arguments) => manual::complete(arguments),
        Command::Manual(arguments) => manual::write(arguments),
    }
}

/// Says why, as far as somebody listens.
fn fail(sentence: &str) -> ExitCode {
    let _ = writeln!(std::io::stderr(), "planish: {sentence}");
    ExitCode::from(1)
}

fn is_help(kind: ErrorKind) -> bool {
    use ErrorKind::{DisplayHelp, DisplayHelpOnMissingArgumentOrSubcommand, DisplayVersion};
    matches!(kind, DisplayHelp | DisplayHelpOnMissingArgumentOrSubcommand | DisplayVersion)
}

/// What clap says of a wrong call, as one sentence: what is wrong with the names it is about, the words that would do,
/// and the one that is near; without the usage.
fn usage(text: &str) -> String {
    let lines = text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:"));
    let lines = lines.filter(|line| !line.is_empty() && !line.starts_with("For more information"));
    let mut sentence = String::new();
    for line in lines {
        let line = line.trim_start_matches("error: ");
        let separator = match sentence.chars().last() {
            None => "",
            Some(':') => " ",
            Some(_) if line.starts_with("tip:") || line.starts_with('[') => "; ",
            Some(_) => ", ",
        };
        sentence.push_str(separator);
        sentence.push_str(line.trim_start_matches("tip: "));
    }
    format!("{sentence} (see planish --help)")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sentence(words: &[&str]) -> String {
        let error = Arguments::try_parse_from(words).expect_err("a wrong call");
        usage(&error.to_string())
    }

    #[test]
    fn wrong_calls_are_told_in_one_line_with_the_names() {
        let missing = sentence(&["planish", "decimate", "a.obj"]);
        assert!(missing.contains("<OUT>") && missing.contains("--vertices <N>"), "{missing}");
        let near = sentence(&["planish", "fit", "a.obj", "--tolerence", "1"]);
        assert!(near.contains("'--tolerence'") && near.contains("'--tolerance'"), "{near}");
        let family = sentence(&["planish", "fit", "a.obj", "--family", "tenser"]);
        for word in ["tenser", "tensor", "pht", "d1rc"] {
            assert!(family.contains(word), "{family}");
        }
        let command = sentence(&["planish", "fitt"]);
        assert!(command.contains("'fitt'") && command.contains("'fit'"), "{command}");
        let threads = sentence(&["planish", "fit", "a.obj", "--threads", "5000"]);
        assert!(threads.contains("5000") && threads.contains("0 to 1024"), "{threads}");
        for line in [missing, near, family, command, threads] {
            assert!(!line.contains('\n') && !line.contains("Usage"), "{line}");
        }
    }

    #[test]
    fn arguments_are_consistent_and_every_help_tells_the_exit_codes() {
        Arguments::command().debug_assert();
        let help = Arguments::command().render_help().to_string();
        assert!(help.contains("Exit codes: 0") && help.contains("planish help topics"), "{help}");
        let topics = Arguments::try_parse_from(["planish", "help", "topics"]).expect_err("a help");
        for word in ["tolerance", "families", "exit-codes"] {
            assert!(topics.to_string().contains(word), "{topics}");
        }
    }

    #[test]
    fn negative_numbers_are_numbers_and_nothing_asks_for_help() {
        assert!(Arguments::try_parse_from(["planish", "fit", "a.obj", "--tolerance", "-1"]).is_ok());
        let error = Arguments::try_parse_from(["planish"]).expect_err("no command");
        assert!(is_help(error.kind()), "{:?}", error.kind());
    }
}
