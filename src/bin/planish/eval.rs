//! `planish eval`.

use crate::{Failure, Outcome, output};
use clap::Args;
use planish::Control;
use planish::export::native;
use planish::memory;
use planish::surface::Domain;
use planish::surface::evaluate::{Output, OutsideRule, Points, Quantity, evaluate};
use std::io::Read;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct EvalArguments {
    /// Saved surface (.planish).
    surface: PathBuf,
    /// Text file with u and v in each line; - reads standard input.
    #[arg(long, value_name = "FILE", conflicts_with = "grid")]
    uv: Option<PathBuf>,
    /// A grid over the box of the data instead, such as 10x20, in lines that end with flags: 0, or the sum of 1 (outside
    /// the domain), 2 (outside the trims) and 4 (beyond the data).
    #[arg(long, value_name = "UxV")]
    grid: Option<String>,
    /// Derivatives up to this order: S, Su, Sv, Suu, Suv, Svv.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u8).range(..=2))]
    derivatives: u8,
    /// Continue the surface beyond its domain instead of refusing.
    #[arg(long)]
    extrapolate: bool,
}

pub(crate) fn run(arguments: &EvalArguments) -> Result<Outcome, Failure> {
    let surface = native::load_file(&arguments.surface)?;
    let surface = surface.as_surface();
    let uv = match (&arguments.uv, &arguments.grid) {
        (Some(path), _) => read_pairs(path)?,
        (None, Some(grid)) => {
            grid_pairs(grid, &surface.region().data_box.unwrap_or_else(|| surface.domain()))?
        }
        (None, None) => return Err(Failure::new("give --uv FILE or --grid UxV")),
    };
    let count = uv.len() / 2;
    let quantity = Quantity::Derivatives(usize::from(arguments.derivatives));
    let width = quantity.width(surface.dim());
    let rule = if arguments.extrapolate { OutsideRule::Extrapolate } else { OutsideRule::Fail };
    let mut values = memory::filled(0.0, count.saturating_mul(width));
    let control = Control::default();
    let points = Points::new(&uv, 2, count);
    let mut flags = memory::filled(0, if arguments.grid.is_some() { count } else { 0 });
    let output = Output { rows: &mut values, stride: width, flags: &mut flags };
    evaluate(surface, quantity, points, rule, output, control.pool())?;
    let mut text = String::new();
    for (place, (uv, row)) in uv.chunks_exact(2).zip(values.chunks_exact(width)).enumerate() {
        let mut numbers: Vec<String> = uv.iter().chain(row).map(f64::to_string).collect();
        numbers.extend(flags.get(place).map(u8::to_string));
        text.push_str(&numbers.join(" "));
        text.push('\n');
    }
    output::print(text)?;
    Ok(Outcome::Done)
}

fn read_pairs(path: &Path) -> Result<Vec<f64>, Failure> {
    let fail = |error: std::io::Error| Failure::new(format!("cannot read {}: {error}", path.display()));
    let mut text = String::new();
    if path.as_os_str() == "-" {
        std::io::stdin().read_to_string(&mut text).map_err(fail)?;
    } else {
        text = output::read_text(path)?;
    }
    let mut pairs = Vec::new();
    for (line, content) in text.lines().enumerate() {
        let numbers: Vec<&str> = content.split_whitespace().collect();
        if numbers.is_empty() || numbers[0].starts_with('#') {
            continue;
        }
        let parsed: Result<Vec<f64>, _> = numbers.iter().map(|number| number.parse()).collect();
        match parsed {
            Ok(pair) if pair.len() == 2 => pairs.extend(pair),
            _ => {
                let path = path.display();
                return Err(Failure::new(format!("line {} of {path} is not a pair u v", line + 1)));
            }
        }
    }
    Ok(pairs)
}

fn grid_pairs(grid: &str, domain: &Domain) -> Result<Vec<f64>, Failure> {
    let counts = grid.split_once('x').and_then(|(u, v)| Some((u.parse().ok()?, v.parse().ok()?)));
    let Some((count_u, count_v)) = counts.filter(|&(u, v): &(usize, usize)| u >= 2 && v >= 2) else {
        return Err(Failure::new(format!("{grid} is no grid, say 10x20 with at least 2 points each way")));
    };
    let place = |k: usize, count: usize, from: f64, to: f64| {
        let share = k as f64 / (count - 1) as f64;
        from * (1.0 - share) + to * share
    };
    let mut pairs = memory::with_capacity(count_u.saturating_mul(count_v).saturating_mul(2));
    for i in 0..count_u {
        for j in 0..count_v {
            pairs.push(place(i, count_u, domain.min.x, domain.max.x));
            pairs.push(place(j, count_v, domain.min.y, domain.max.y));
        }
    }
    Ok(pairs)
}
