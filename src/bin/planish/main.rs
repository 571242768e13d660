//! `planish`: fits, measures and converts from the command line; a thin client of the library.
//!
//! Exit code 0: done, and the tolerance met; 2: done, but the tolerance not met; 1: any error.

mod d1rc;
mod decimate;
mod eval;
mod fit;
mod info;
mod model;
mod morph;
mod output;
mod picture;
mod render;
mod sample;
mod skin;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Smooth spline surfaces from triangle meshes, within a stated tolerance.
#[derive(Debug, Parser)]
#[command(name = "planish", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Fit a surface to a mesh file (OFF, OBJ, PLY, STL) and report how close it came.
    Fit(fit::FitArguments),
    /// Skin rows of points by one surface and report how close it came.
    Skin(skin::SkinArguments),
    /// Make a mesh of fewer nodes by collapsing edges; sharp edges and the boundary stay.
    Decimate(decimate::DecimateArguments),
    /// Make a smooth surface from a triangular control mesh.
    D1rc(d1rc::D1rcArguments),
    /// Say what a mesh file or a saved surface holds.
    Info(info::InfoArguments),
    /// Evaluate a saved surface.
    Eval(eval::EvalArguments),
    /// Draw a sequence of pictures of a mesh's surface, moved by a displacement on its nodes.
    Morph(morph::MorphArguments),
    /// Draw a picture of a saved surface.
    Render(render::RenderArguments),
    /// Write one of the seeded sample meshes.
    Sample(sample::SampleArguments),
}

/// How a command ended well.
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

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) if !error.use_stderr() => {
            // help and version; a closed pipe is no error of ours
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        Err(error) => {
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            eprintln!("planish: {} (see planish --help)", line.trim_start_matches("error: "));
            return ExitCode::from(1);
        }
    };
    let outcome = match arguments.command {
        Command::Fit(arguments) => fit::run(&arguments),
        Command::Skin(arguments) => skin::run(&arguments),
        Command::Decimate(arguments) => decimate::run(&arguments),
        Command::D1rc(arguments) => d1rc::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Eval(arguments) => eval::run(&arguments),
        Command::Morph(arguments) => morph::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Sample(arguments) => sample::run(&arguments),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::ToleranceNotMet) => ExitCode::from(2),
        Err(Failure(sentence)) => {
            eprintln!("planish: {sentence}");
            ExitCode::from(1)
        }
    }
}
