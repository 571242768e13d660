//! Rows that run against one another, or begin elsewhere.
//!
//! Two rows are compared at equal shares of their chord lengths: the root of the mean squared distance. A row may be
//! turned round, and a closed one may begin at any of its points.

use super::distinct::{Distinct, Order};
use crate::memory;

/// Less by more than rounding, so that of equal orders the given one stays.
const CLEARLY_LESS: f64 = 1.0 - 1e-12;
/// Shares of the length at which rows are compared.
const SAMPLES: usize = 64;

/// First points that are tried when twisted rows are only looked for, not put right.
const COARSE_SHIFTS: usize = 16;

/// The orders of all rows.
#[derive(Debug)]
pub(super) struct Alignment {
    pub orders: Vec<Order>,
    /// The first row that another order brings twice as near to the one before.
    pub twisted_row: Option<usize>,
}

impl Alignment {
    pub(super) fn changed_count(&self) -> usize {
        self.orders.iter().filter(|&&order| order != Order::default()).count()
    }
}

/// Looks at each row and the one before; changes orders only if asked to.
pub(super) fn align(rows: &[Distinct], is_closed: bool, changes: bool) -> Alignment {
    let mut alignment = Alignment { orders: vec![Order::default()], twisted_row: None };
    let mut before = samples(&rows[0], &Order::default());
    for (j, row) in rows.iter().enumerate().skip(1) {
        let given = samples(row, &Order::default());
        let as_given = distance_sq(&before, &given);
        let mut best = (as_given, Order::default());
        for order in orders(row.count(), is_closed, if changes { row.count() } else { COARSE_SHIFTS }) {
            let distance = distance_sq(&before, &samples(row, &order));
            if distance < best.0 * CLEARLY_LESS {
                best = (distance, order);
            }
        }
        if 4.0 * best.0 < as_given && !changes {
            alignment.twisted_row = alignment.twisted_row.or(Some(j));
        }
        if !changes {
            best = (as_given, Order::default());
        }
        before = if best.1 == Order::default() { given } else { samples(row, &best.1) };
        memory::push(&mut alignment.orders, best.1);
    }
    alignment
}

/// The orders that a row may have: reversed, or for a closed row with other first points, about `shifts` of them.
fn orders(count: usize, is_closed: bool, shifts: usize) -> impl Iterator<Item = Order> {
    let step = if is_closed { count.div_ceil(shifts.max(1)) } else { count };
    let firsts = (0..count).step_by(step);
    firsts.flat_map(move |first| {
        let reversed = if is_closed { first } else { count - 1 };
        [Order { first, is_reversed: false }, Order { first: reversed, is_reversed: true }]
    })
}

/// Points at equal shares of a row's length, on straight lines between its points.
fn samples(row: &Distinct, order: &Order) -> Vec<f64> {
    let (parameters, _) = row.chord_parameters(order);
    let points = row.ordered(order);
    let dim = points.len() / parameters.len();
    let (mut rows, mut l) = (memory::with_capacity(SAMPLES * dim), 0);
    for k in 0..SAMPLES {
        let share = k as f64 / (SAMPLES - 1) as f64;
        while l + 2 < parameters.len() && parameters[l + 1] <= share {
            l += 1;
        }
        let x = (share - parameters[l]) / (parameters[l + 1] - parameters[l]);
        memory::extend(
            &mut rows,
            (0..dim).map(|c| (1.0 - x) * points[l * dim + c] + x * points[(l + 1) * dim + c]),
        );
    }
    rows
}

fn distance_sq(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}
