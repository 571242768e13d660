//! Elimination orders for unknowns on a grid.
//!
//! A. George, "Nested dissection of a regular finite element mesh", SIAM J. Numer. Anal. 10 (1973),
//! 345-363. A strip as wide as the stencil separates two halves; the strip is eliminated last.

use crate::memory;

/// Blocks of at most this many unknowns are not cut further: below it the separators cost more than they save.
const SMALLEST_BLOCK: usize = 64;

/// An order of the unknowns `i * count_v + j` of a grid whose stencil reaches `reach` unknowns far.
pub fn grid_order(count_u: usize, count_v: usize, reach: usize) -> Vec<usize> {
    let mut order = memory::with_capacity(count_u * count_v);
    dissect(0..count_u, 0..count_v, count_v, reach, &mut order);
    order
}

fn dissect(
    u: std::ops::Range<usize>,
    v: std::ops::Range<usize>,
    count_v: usize,
    reach: usize,
    order: &mut Vec<usize>,
) {
    let (length_u, length_v) = (u.len(), v.len());
    let longest = length_u.max(length_v);
    if length_u * length_v <= SMALLEST_BLOCK || longest < 3 * reach {
        order.extend(u.flat_map(|i| v.clone().map(move |j| i * count_v + j)));
        return;
    }
    let cut = (longest - reach) / 2;
    if length_u >= length_v {
        let (a, b) = (u.start + cut, u.start + cut + reach);
        dissect(u.start..a, v.clone(), count_v, reach, order);
        dissect(b..u.end, v.clone(), count_v, reach, order);
        order.extend((a..b).flat_map(|i| v.clone().map(move |j| i * count_v + j)));
    } else {
        let (a, b) = (v.start + cut, v.start + cut + reach);
        dissect(u.clone(), v.start..a, count_v, reach, order);
        dissect(u.clone(), b..v.end, count_v, reach, order);
        order.extend((a..b).flat_map(|j| u.clone().map(move |i| i * count_v + j)));
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn each_unknown_occurs_once() {
        for (count_u, count_v) in [(1, 1), (2, 90), (40, 33), (7, 300)] {
            let mut order = super::grid_order(count_u, count_v, 3);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..count_u * count_v), "{count_u} x {count_v}");
        }
    }
}
