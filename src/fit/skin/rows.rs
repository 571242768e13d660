//! From rows of points to section curves.
//!
//! Parameters along a row are shares of its chord length. A point that lies on the one before it is merged with it; a
//! row of one place is a constant.

use super::align;
use super::distinct::{Distinct, Order};
use super::sections::{Section, Sources};
use super::{SectionEnds, SkinError, SkinOptions};
use crate::curve::{Curve, CurveError, EndRule, Interpolant};
use crate::geometry::Bounds;
use crate::memory::{self, CollectVec};

/// Rows of points: `counts` says how many each has.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a> {
    /// Points of `dim` numbers, row after row.
    pub points: &'a [f64],
    /// Points of each row.
    pub counts: &'a [usize],
    /// Numbers of a point.
    pub dim: usize,
}

/// Points nearer than this share of the diagonal are one.
const MERGE_DISTANCE: f64 = 1e-12;

/// What is skinned: curves, and the data at which the surface is measured.
#[derive(Debug)]
pub(super) struct Data {
    pub sources: Sources,
    /// The points, in the caller's order.
    pub values: Vec<f64>,
    /// For each of them its row, and its place along it.
    pub places: Vec<(usize, f64)>,
    pub bounds: Bounds,
    pub has_tangents: [bool; 2],
    pub is_periodic: bool,
    pub merged_points: usize,
    pub aligned_rows: usize,
    pub twisted_row: Option<usize>,
}

impl Data {
    pub(super) fn of_rows(rows: &Rows, options: &SkinOptions) -> Result<Self, SkinError> {
        check(rows)?;
        let Rows { points, counts, dim } = *rows;
        let bounds = Bounds::of_rows(points, dim);
        let starts: Vec<usize> = starts(counts);
        let row_points = |j: usize| &points[starts[j] * dim..starts[j + 1] * dim];
        let merge_distance = MERGE_DISTANCE * bounds.diagonal();
        let distinct: Vec<Distinct> = (0..counts.len())
            .map(|j| Distinct::new(row_points(j), dim, merge_distance, options.closed))
            .collect_vec();
        let alignment = align::align(&distinct, options.closed, options.align);
        let is_periodic = match options.ends {
            SectionEnds::Auto => options.closed,
            SectionEnds::Periodic => true,
            _ => false,
        };
        let ends = Ends::new(options, counts.len(), dim, is_periodic)?;
        let (mut sections, mut places) = (Vec::new(), memory::filled((0, 0.0), starts[counts.len()]));
        for (j, (row, order)) in distinct.iter().zip(&alignment.orders).enumerate() {
            let (parameters, length) = row.chord_parameters(order);
            for (k, &owner) in row.owner.iter().enumerate() {
                places[starts[j] + k] = (j, parameters[order.place(owner, row.count())]);
            }
            let fail = |error| SkinError::Row { row: j, error };
            let section = section(row.ordered(order), parameters, ends.rule(j, order, length).as_rule());
            memory::push(&mut sections, section.map_err(fail)?);
        }
        let row_count = counts.len();
        let mut has_tangents = [false; 2];
        for (end, (tangents, j)) in
            [(options.begin_tangents, 0), (options.end_tangents, row_count - 1)].into_iter().enumerate()
        {
            let Some(tangents) = tangents else { continue };
            check_vectors(tangents, counts[j], dim, ["begin_tangents", "end_tangents"][end])?;
            let (row, order) = (&distinct[j], &alignment.orders[j]);
            let rule = if is_periodic { EndRule::Periodic } else { EndRule::Parabolic };
            let fail = |error| SkinError::Row { row: j, error };
            let along = row.chord_parameters(order).0;
            memory::push(&mut sections, section(row.ordered_of(tangents, order), along, rule).map_err(fail)?);
            has_tangents[end] = true;
        }
        Ok(Self {
            sources: Sources { sections, row_count, dim },
            values: memory::copied(points),
            places,
            bounds,
            has_tangents,
            is_periodic,
            merged_points: distinct.iter().map(Distinct::merged_count).sum(),
            aligned_rows: alignment.changed_count(),
            twisted_row: alignment.twisted_row,
        })
    }

    /// Sections that are curves already; their data are their values at the ends of their pieces.
    pub(super) fn of_curves(curves: &[Curve], options: &SkinOptions) -> Result<Self, SkinError> {
        let Some(first) = curves.first() else { return Err(SkinError::TooFewRows { count: 0, least: 2 }) };
        let dim = first.dim();
        if let Some(row) = curves.iter().position(|curve| curve.dim() != dim) {
            return Err(SkinError::Dimension { row, dim: curves[row].dim(), expected: dim });
        }
        let section = |(row, curve)| Section::of_curve(curve).map_err(|error| SkinError::Row { row, error });
        let mut sections = curves.iter().enumerate().map(section).collect::<Result<Vec<_>, _>>()?;
        let (mut values, mut places) = (Vec::new(), Vec::new());
        for (j, section) in sections.iter().enumerate() {
            let start = values.len();
            values.resize(start + section.breaks().len() * dim, 0.0);
            section.eval_rising(section.breaks(), &mut values[start..]);
            memory::extend(&mut places, section.breaks().iter().map(|&u| (j, u)));
        }
        let row_count = curves.len();
        let is_periodic = options.closed;
        let mut has_tangents = [false; 2];
        for (end, (tangents, j)) in
            [(options.begin_tangents, 0), (options.end_tangents, row_count - 1)].into_iter().enumerate()
        {
            let Some(tangents) = tangents else { continue };
            let breaks = sections[j].breaks().to_vec();
            check_vectors(tangents, breaks.len(), dim, ["begin_tangents", "end_tangents"][end])?;
            let rule = if is_periodic { EndRule::Periodic } else { EndRule::Parabolic };
            let across = Interpolant::new(dim, breaks, memory::copied(tangents), rule);
            memory::push(
                &mut sections,
                Section::Cubic(across.map_err(|error| SkinError::Row { row: j, error })?),
            );
            has_tangents[end] = true;
        }
        Ok(Self {
            bounds: Bounds::of_rows(&values, dim),
            sources: Sources { sections, row_count, dim },
            values,
            places,
            has_tangents,
            is_periodic,
            merged_points: 0,
            aligned_rows: 0,
            twisted_row: None,
        })
    }
}

/// Where each row starts, and where the last one ends.
fn starts(counts: &[usize]) -> Vec<usize> {
    let mut starts = vec![0];
    counts.iter().for_each(|count| starts.push(starts[starts.len() - 1] + count));
    starts
}

fn check(rows: &Rows) -> Result<(), SkinError> {
    let Rows { points, counts, dim } = *rows;
    if dim == 0 {
        return Err(SkinError::Option { option: "dim", value: 0.0, range: "at least 1" });
    }
    if counts.len() < 2 {
        return Err(SkinError::TooFewRows { count: counts.len(), least: 2 });
    }
    if let Some(row) = counts.iter().position(|&count| count == 0) {
        return Err(SkinError::EmptyRow { row });
    }
    let total = counts.iter().try_fold(0_usize, |sum, &count| sum.checked_add(count));
    let expected = total.and_then(|total| total.checked_mul(dim)).unwrap_or(usize::MAX);
    if points.len() != expected {
        return Err(SkinError::Count { what: "the points", count: points.len(), expected });
    }
    match points.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(at) => {
            let point = at / dim;
            let row = starts(counts).partition_point(|&start| start <= point) - 1;
            Err(SkinError::NotFinite { point, row })
        }
    }
}

fn check_vectors(vectors: &[f64], count: usize, dim: usize, what: &'static str) -> Result<(), SkinError> {
    let expected = count * dim;
    if vectors.len() != expected {
        return Err(SkinError::Count { what, count: vectors.len(), expected });
    }
    match vectors.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(SkinError::VectorNotFinite { what, index: at / dim }),
        None => Ok(()),
    }
}

fn section(points: Vec<f64>, parameters: Vec<f64>, rule: EndRule) -> Result<Section, CurveError> {
    let dim = points.len() / parameters.len();
    Ok(Section::Cubic(Interpolant::new(dim, parameters, points, rule)?))
}

/// The end rules of all rows.
struct Ends<'a> {
    ends: SectionEnds<'a>,
    dim: usize,
    is_periodic: bool,
}

/// The end rule of one row, with the slopes it may need.
enum RowEnds {
    Plain(EndRule<'static>),
    Slopes([Vec<f64>; 2]),
}

impl RowEnds {
    fn as_rule(&self) -> EndRule<'_> {
        match self {
            Self::Plain(rule) => *rule,
            Self::Slopes([begin, end]) => EndRule::Slopes { begin, end },
        }
    }
}

impl<'a> Ends<'a> {
    fn new(
        options: &SkinOptions<'a>,
        row_count: usize,
        dim: usize,
        is_periodic: bool,
    ) -> Result<Self, SkinError> {
        if options.ends == SectionEnds::Periodic && !options.closed {
            let range = "periodic for closed rows only";
            return Err(SkinError::Option { option: "ends", value: 4.0, range });
        }
        if let SectionEnds::Slopes(slopes) = options.ends {
            check_vectors(slopes, 2 * row_count, dim, "the end slopes")?;
        }
        Ok(Self { ends: options.ends, dim, is_periodic })
    }

    /// The rule of a row of this chord length: slopes change their sides and signs where a row is turned round.
    fn rule(&self, row: usize, order: &Order, length: f64) -> RowEnds {
        match self.ends {
            _ if self.is_periodic => RowEnds::Plain(EndRule::Periodic),
            SectionEnds::Natural => RowEnds::Plain(EndRule::Natural),
            SectionEnds::Slopes(slopes) => {
                let slope = |k: usize| {
                    let k = if order.is_reversed { 1 - k } else { k };
                    let factor = if order.is_reversed { -length } else { length };
                    let start = (2 * row + k) * self.dim;
                    slopes[start..start + self.dim].iter().map(|x| factor * x).collect_vec()
                };
                RowEnds::Slopes([slope(0), slope(1)])
            }
            _ => RowEnds::Plain(EndRule::Parabolic),
        }
    }
}
