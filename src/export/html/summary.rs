//! The words and numbers beside the picture.

use super::{Page, escaped};
use crate::summary::{percentile, sorted_sizes};
use std::fmt::Write;

/// Signed distances in a few numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// The largest on the side of the normal; 0 if there is none.
    pub largest_outside: f64,
    /// The largest on the other side, negative; 0 if there is none.
    pub largest_inside: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// The mean.
    pub mean: f64,
    /// What 50, 95 and 99 of a hundred distances do not exceed.
    pub percentiles: [f64; 3],
    /// The share of distances within the tolerance, 0 to 1.
    pub share_within: f64,
}

impl Statistics {
    /// Sums up; all 0 without data.
    pub fn of(distances: &[f64], tolerance: f64) -> Self {
        let sizes = sorted_sizes(distances);
        let count = sizes.len().max(1) as f64;
        Self {
            largest_outside: distances.iter().copied().fold(0.0, f64::max),
            largest_inside: distances.iter().copied().fold(0.0, f64::min),
            rms: (sizes.iter().map(|d| d * d).sum::<f64>() / count).sqrt(),
            mean: distances.iter().filter(|d| !d.is_nan()).sum::<f64>() / count,
            percentiles: [0.50, 0.95, 0.99].map(|share| percentile(&sizes, share)),
            share_within: sizes.partition_point(|&d| d <= tolerance) as f64 / count,
        }
    }
}

/// How many of the worst places are listed.
const WORST: usize = 10;

/// Bars of the histogram: an odd number, so that one stands for zero.
const BARS: usize = 41;

/// The whole column as HTML.
pub(super) fn html(page: &Page) -> String {
    let statistics = Statistics::of(page.distances, page.tolerance);
    let mut text = format!("<h1>{}</h1>\n", escaped(page.title));
    text.push_str(&verdict(page, &statistics));
    text.push_str(&table(page, &statistics));
    if !page.remarks.is_empty() {
        text.push_str("<h2>Worth knowing</h2>\n<ul>\n");
        for (remark, advice) in page.remarks {
            // writing into a string cannot fail
            let _ = writeln!(text, "<li><b>{}</b> {}</li>", escaped(remark), escaped(advice));
        }
        text.push_str("</ul>\n");
    }
    text.push_str(&histogram(page));
    text.push_str(&worst_places(page));
    text
}

fn length(value: f64, unit: &str) -> String {
    format!("{} {}", digits(value), escaped(unit)).trim_end().to_owned()
}

/// Four digits that count, without needless zeros.
fn digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.3e}");
    }
    let decimals = (3 - value.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{value:.decimals$}")
}

fn verdict(page: &Page, statistics: &Statistics) -> String {
    let largest = statistics.largest_outside.max(-statistics.largest_inside);
    let (class, word) = if largest <= page.tolerance { ("met", "met") } else { ("missed", "missed") };
    format!(
        "<p class=\"verdict {class}\">Tolerance {word}: {} of {} allowed</p>\n",
        length(largest, page.unit),
        length(page.tolerance, page.unit)
    )
}

fn table(page: &Page, statistics: &Statistics) -> String {
    let [half, most, nearly_all] = statistics.percentiles;
    let unit = page.unit;
    let rows = [
        ("largest outside".to_owned(), length(statistics.largest_outside, unit)),
        ("largest inside".to_owned(), length(statistics.largest_inside, unit)),
        ("root mean square".to_owned(), length(statistics.rms, unit)),
        ("mean".to_owned(), length(statistics.mean, unit)),
        ("half of the nodes within".to_owned(), length(half, unit)),
        ("95 % of the nodes within".to_owned(), length(most, unit)),
        ("99 % of the nodes within".to_owned(), length(nearly_all, unit)),
        ("nodes within the tolerance".to_owned(), format!("{:.2} %", 100.0 * statistics.share_within)),
        ("nodes".to_owned(), page.mesh.points().len().to_string()),
        ("triangles".to_owned(), page.mesh.triangles().len().to_string()),
    ];
    let facts = page.facts.iter().map(|(name, value)| (escaped(name), escaped(value)));
    let rows = rows
        .into_iter()
        .chain(facts)
        .map(|(name, value)| format!("<tr><td>{name}</td><td>{value}</td></tr>\n"));
    format!("<table>\n{}</table>\n", rows.collect::<String>())
}

/// How many distances fall into each of `BARS` equal parts of -tolerance to tolerance; those beyond are in the last.
fn counts(page: &Page) -> [usize; BARS] {
    let mut counts = [0; BARS];
    for distance in page.distances {
        let share = (distance / page.tolerance.max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        let bar = ((share + 1.0) / 2.0 * BARS as f64) as usize;
        counts[bar.min(BARS - 1)] += 1;
    }
    counts
}

fn histogram(page: &Page) -> String {
    let counts = counts(page);
    let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    let bars = counts.iter().enumerate().map(|(bar, &count)| {
        // heights are square roots: single nodes stay visible beside thousands
        let height = 100.0 * (count as f64 / most).sqrt();
        let middle = (2.0 * (bar as f64 + 0.5) / BARS as f64 - 1.0) * page.tolerance;
        format!(
            "<rect x=\"{}\" y=\"{:.1}\" width=\"7\" height=\"{height:.1}\" fill=\"#4a7fb5\"><title>about {}: {count} nodes\
             </title></rect>",
            8 * bar,
            100.0 - height,
            length(middle, page.unit),
        )
    });
    format!(
        "<h2>Distances, from -{0} to {0} (heights: square roots)</h2>\n<svg id=\"histogram\" viewBox=\"0 0 {1} 100\" \
         width=\"100%\">{2}</svg>\n",
        length(page.tolerance, page.unit),
        8 * BARS,
        bars.collect::<String>()
    )
}

fn worst_places(page: &Page) -> String {
    let mut nodes: Vec<usize> = (0..page.distances.len()).collect();
    // ties by number, so that the page is the same each time
    nodes.sort_unstable_by(|&a, &b| {
        page.distances[b].abs().total_cmp(&page.distances[a].abs()).then(a.cmp(&b))
    });
    nodes.truncate(WORST);
    let rows = nodes.iter().map(|&node| {
        let p = page.mesh.points()[node];
        format!(
            "<tr data-index=\"{node}\"><td>{node}</td><td>{}</td><td>{}, {}, {}</td><td>{}</td></tr>\n",
            digits(page.distances[node]),
            digits(p.x),
            digits(p.y),
            digits(p.z),
            escaped(&(page.places)(node)),
        )
    });
    format!(
        "<h2>Worst places (click)</h2>\n<table id=\"worst\">\n<tr><th>node</th><th>distance</th><th>x, y, z</th>\
         <th>nearest place</th></tr>\n{}</table>\n",
        rows.collect::<String>()
    )
}
