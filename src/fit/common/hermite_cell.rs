//! Sums over one cell: least squares in the sixteen Hermite unknowns of its corners, and its plate energy.
//!
//! Unknowns are in units of the cell: at each corner, in the order of the quadrants, `f, H_u f_u, H_v f_v,
//! H_u H_v f_uv`. In these the energy is the same matrix for all cells.

use crate::hermite::shape_functions;
use crate::memory;
use std::sync::LazyLock;

/// Unknowns of a cell.
pub(crate) const COUNT: usize = 16;

/// A matrix over the unknowns of a cell.
pub(crate) type CellMatrix = [[f64; COUNT]; COUNT];

/// Weights of the unknowns at the place `x`, `y` of the unit cell.
#[inline(always)]
pub(crate) fn weights(x: f64, y: f64) -> [f64; COUNT] {
    let ([a, b, c, d], [e, f, g, h]) = (shape_functions(x), shape_functions(y));
    let (along_u, along_v) = ([[a, c], [b, d]], [[e, g], [f, h]]);
    let mut weights = [0.0; COUNT];
    for i in 0..2 {
        for j in 0..2 {
            let corner = &mut weights[4 * (2 * i + j)..][..4];
            corner[0] = along_u[i][0] * along_v[j][0];
            corner[1] = along_u[i][1] * along_v[j][0];
            corner[2] = along_u[i][0] * along_v[j][1];
            corner[3] = along_u[i][1] * along_v[j][1];
        }
    }
    weights
}

/// Normal equations of one cell.
pub(crate) struct CellSums {
    /// Products of the unknowns' weights.
    pub matrix: CellMatrix,
    /// A row of `dim` numbers for each unknown.
    pub right: Vec<f64>,
}

impl CellSums {
    pub(crate) fn new(dim: usize) -> Self {
        Self { matrix: [[0.0; COUNT]; COUNT], right: memory::filled(0.0, COUNT * dim) }
    }

    /// Adds a sample.
    #[inline(always)]
    pub(crate) fn add(&mut self, n: &[f64; COUNT], value: &[f64], weight: f64) {
        for i in 0..COUNT {
            let scaled = weight * n[i];
            for j in 0..COUNT {
                self.matrix[i][j] += scaled * n[j];
            }
        }
        for (row, n) in self.right.chunks_exact_mut(value.len()).zip(n) {
            row.iter_mut().zip(value).for_each(|(sum, x)| *sum += weight * n * x);
        }
    }

    /// The matrix with `plate` times the energy of a plate, and with that of a membrane.
    pub(crate) fn with_energy(&self, plate: f64, membrane: Membrane) -> CellMatrix {
        let mut matrix = self.matrix;
        let mut add = |weight: f64, energy: &CellMatrix| {
            for (row, energy) in matrix.iter_mut().zip(energy).filter(|_| weight > 0.0) {
                row.iter_mut().zip(energy).for_each(|(sum, e)| *sum += weight * e);
            }
        };
        add(plate, &PLATE);
        match membrane.parts {
            Membrane::WHOLE => add(membrane.weight, &MEMBRANE),
            parts => (0..PARTS * PARTS)
                .filter(|part| parts & (1 << part) != 0)
                .for_each(|part| add(membrane.weight, &MEMBRANES[part])),
        }
        matrix
    }
}

/// Rows and columns of parts of a cell that a membrane can be in.
pub(crate) const PARTS: usize = 4;

/// A membrane in parts of a cell.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Membrane {
    /// Weight of its energy.
    pub weight: f64,
    /// Bit `PARTS * i + j` for the part of column `i` along u and row `j` along v.
    pub parts: u16,
}

impl Membrane {
    /// All of the cell.
    pub(crate) const WHOLE: u16 = u16::MAX;
}

/// The integral of `f_xx^2 + 2 f_xy^2 + f_yy^2` over the unit cell.
static PLATE: LazyLock<CellMatrix> = LazyLock::new(|| energy(&[(1.0, 2, 0), (2.0, 1, 1), (1.0, 0, 2)]));

/// The integral of `f_x^2 + f_y^2` over the unit cell.
static MEMBRANE: LazyLock<CellMatrix> = LazyLock::new(|| energy(&MEMBRANE_TERMS));
const MEMBRANE_TERMS: [(f64, usize, usize); 2] = [(1.0, 1, 0), (1.0, 0, 1)];

/// The same over each part of it.
static MEMBRANES: LazyLock<[CellMatrix; PARTS * PARTS]> = LazyLock::new(|| {
    let ends = |k: usize| [k as f64 / PARTS as f64, (k + 1) as f64 / PARTS as f64];
    std::array::from_fn(|part| energy_in(&MEMBRANE_TERMS, [ends(part / PARTS), ends(part % PARTS)]))
});

/// The integral of weighed squares of derivatives of some orders over the unit cell.
fn energy(terms: &[(f64, usize, usize)]) -> CellMatrix {
    energy_in(terms, [[0.0, 1.0]; 2])
}

/// The same over a rectangle in it.
fn energy_in(terms: &[(f64, usize, usize)], [along_u, along_v]: [[f64; 2]; 2]) -> CellMatrix {
    let [grams_u, grams_v] = [along_u, along_v].map(|ends| [0, 1, 2].map(|order| gram(order, ends)));
    // the place of unknown k of a line: value and slope at its begin, then at its end
    let parts = |unknown: usize| {
        let (corner, row) = (unknown / 4, unknown % 4);
        (2 * (corner / 2) + row % 2, 2 * (corner % 2) + row / 2)
    };
    let entry = |i: usize, j: usize| {
        let ((a, b), (c, d)) = (parts(i), parts(j));
        terms.iter().map(|&(weight, p, q)| weight * grams_u[p][a][c] * grams_v[q][b][d]).sum()
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// Integrals over a part of the unit interval of products of derivatives of the cubics that have value or slope 1 at one
/// end: value and slope at 0, value and slope at 1.
fn gram(order: usize, [from, to]: [f64; 2]) -> [[f64; 4]; 4] {
    // coefficients of 1, x, x^2, x^3
    const CUBICS: [[f64; 4]; 4] =
        [[1.0, 0.0, -3.0, 2.0], [0.0, 1.0, -2.0, 1.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, -1.0, 1.0]];
    let derivative = |c: [f64; 4]| [c[1], 2.0 * c[2], 3.0 * c[3], 0.0];
    let cubics = CUBICS.map(|cubic| (0..order).fold(cubic, |c, _| derivative(c)));
    let product = |a: [f64; 4], b: [f64; 4]| -> f64 {
        let pairs = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
        let power = |i: usize, j: usize| {
            let exponent = i + j + 1;
            (to.powi(exponent as i32) - from.powi(exponent as i32)) / exponent as f64
        };
        pairs.map(|(i, j)| a[i] * b[j] * power(i, j)).sum()
    };
    cubics.map(|a| cubics.map(|b| product(a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unknowns of a polynomial x^p y^q.
    fn unknowns(p: i32, q: i32) -> [f64; COUNT] {
        let slope = |x: f64, p: i32| if p == 0 { 0.0 } else { f64::from(p) * x.powi(p - 1) };
        let mut unknowns = [0.0; COUNT];
        for (corner, [x, y]) in [[0.0_f64, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].into_iter().enumerate() {
            let (fx, fy) = ([x.powi(p), slope(x, p)], [y.powi(q), slope(y, q)]);
            unknowns[4 * corner..][..4].copy_from_slice(&[
                fx[0] * fy[0],
                fx[1] * fy[0],
                fx[0] * fy[1],
                fx[1] * fy[1],
            ]);
        }
        unknowns
    }

    #[test]
    fn bicubics_have_their_values_and_energies() {
        // integrals of (x^p y^q)_xx^2 + 2 _xy^2 + _yy^2 worked out by hand
        for (p, q, energy) in
            [(0, 0, 0.0), (1, 0, 0.0), (1, 1, 2.0), (2, 0, 4.0), (0, 3, 12.0), (2, 1, 4.0 / 3.0 + 8.0 / 3.0)]
        {
            let x = unknowns(p, q);
            let at = weights(0.3, 0.8);
            let value: f64 = at.iter().zip(x).map(|(w, x)| w * x).sum();
            assert!((value - 0.3f64.powi(p) * 0.8f64.powi(q)).abs() <= 16.0 * f64::EPSILON);
            let measured: f64 = (0..COUNT)
                .flat_map(|i| (0..COUNT).map(move |j| (i, j)))
                .map(|(i, j)| x[i] * PLATE[i][j] * x[j])
                .sum();
            // 256 terms of at most 12 * 3 * 3
            assert!((measured - energy).abs() <= 256.0 * 108.0 * f64::EPSILON, "{p} {q}: {measured}");
        }
        // (x y)_x^2 + (x y)_y^2 = x^2 + y^2
        let x = unknowns(1, 1);
        let pairs = (0..COUNT).flat_map(|i| (0..COUNT).map(move |j| (i, j)));
        let membrane: f64 = pairs.map(|(i, j)| x[i] * MEMBRANE[i][j] * x[j]).sum();
        assert!((membrane - 2.0 / 3.0).abs() <= 256.0 * f64::EPSILON, "{membrane}");
    }

    #[test]
    fn membranes_in_parts_make_one_in_the_cell() {
        let empty = CellSums::new(1);
        let energy = |x: &[f64; COUNT], parts: u16| -> f64 {
            let matrix = empty.with_energy(0.0, Membrane { weight: 3.0, parts });
            let pairs = (0..COUNT).flat_map(|i| (0..COUNT).map(move |j| (i, j)));
            pairs.map(|(i, j)| x[i] * matrix[i][j] * x[j]).sum()
        };
        let x = unknowns(2, 1);
        let part = |i: usize, j: usize| energy(&x, 1 << (PARTS * i + j));
        let sum: f64 =
            (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (i, j))).map(|(i, j)| part(i, j)).sum();
        // (x^2 y)_x^2 + (x^2 y)_y^2 = 4 x^2 y^2 + x^4
        let whole = 3.0 * (4.0 / 9.0 + 1.0 / 5.0);
        let tol = 1e3 * f64::EPSILON;
        assert!((sum - whole).abs() <= tol && (energy(&x, Membrane::WHOLE) - whole).abs() <= tol, "{sum}");
        assert!((energy(&x, Membrane::WHOLE ^ 1) + part(0, 0) - whole).abs() <= tol);
        // in the first column and the last row of parts
        let (x3, y3) = (0.25_f64.powi(3) / 3.0, (1.0 - 0.75_f64.powi(3)) / 3.0);
        let exact = 3.0 * (4.0 * x3 * y3 + 0.25_f64.powi(5) / 5.0 * 0.25);
        assert!((part(0, PARTS - 1) - exact).abs() <= tol, "{exact}");
    }
}
