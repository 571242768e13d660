//! Control points by least squares, with an energy that determines those without data.
//!
//! ```text
//! minimize  sum_n w_n |S(u_n,v_n) - P_n|^2 + mu (W/A) sum_e (A_1 + A_2)^2 |jump_e|^2
//! ```
//! S is linear in the control points; jump_e is the jump of the gradient of the control mesh, as a function over its
//! parameters, across the inner edge e between faces of areas A_1 and A_2. It vanishes for linear functions only.
//! The energy of all edges is that of `mu h^4` times the squared second derivatives, h the width of a face, so mu
//! is a pure number; A is the area of all faces, W the sum of the weights.

use crate::control::{Cancelled, Pool, Watch};
use crate::linalg::SymbolicCholesky;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::Mesh;
use crate::surface::d1rc::D1rcSurface;
use glam::DVec2;
use rayon::prelude::*;
use sprs::CsMat;

/// What is fitted: places in the domain, values of three components, and a weight for each.
pub(super) struct Samples<'a> {
    pub uv: &'a [DVec2],
    pub values: &'a [f64],
    pub weights: &'a [f64],
}

/// Share of the energy that acts across sharp edges: enough to determine what has no data, too little to be seen.
const SHARP_SHARE: f64 = 1e-6;
/// Places evaluated in one piece.
const CHUNK: usize = 512;

/// Rows of the least squares matrix: where each ends, its columns and numbers.
#[derive(Default)]
struct Rows {
    ends: Vec<usize>,
    columns: Vec<usize>,
    numbers: Vec<f64>,
}

impl Rows {
    fn push(&mut self, row: impl IntoIterator<Item = (u32, f64)>) {
        for (column, number) in row {
            memory::push(&mut self.columns, column as usize);
            memory::push(&mut self.numbers, number);
        }
        memory::push(&mut self.ends, self.columns.len());
    }

    fn append(&mut self, other: Self) {
        let before = self.columns.len();
        memory::extend(&mut self.ends, other.ends.iter().map(|end| before + end));
        memory::extend(&mut self.columns, other.columns);
        memory::extend(&mut self.numbers, other.numbers);
    }

    fn into_matrix(self, columns: usize) -> CsMat<f64> {
        let count = self.ends.len();
        let starts = [0].into_iter().chain(self.ends).collect_vec();
        CsMat::new((count, columns), starts, self.columns, self.numbers)
    }
}

/// The energy's rows without its weight: the jumps times the areas, fewer across sharp edges.
pub(super) struct Energy {
    rows: Vec<[(u32, f64); 4]>,
}

impl Energy {
    /// Of a control mesh over its parameters.
    pub(super) fn new(mesh: &Mesh, uv: &[DVec2], sharp_edges: &[[u32; 2]]) -> Self {
        let (triangles, topology) = (mesh.triangles(), mesh.topology());
        let double_area = |t: usize| {
            let [a, b, c] = triangles[t].map(|node| uv[node as usize]);
            (b - a).perp_dot(c - a)
        };
        let whole: f64 = (0..triangles.len()).map(double_area).sum();
        let ordered = |&[a, b]: &[u32; 2]| [a.min(b), a.max(b)];
        let mut sharp: Vec<[u32; 2]> = sharp_edges.iter().map(ordered).collect_vec();
        sharp.sort_unstable();
        let inner = mesh.edges().filter_map(|edge| Some((edge, topology.twin(edge)?)));
        let rows = inner.map(|(edge, twin)| {
            let ends = [edge.origin(triangles), edge.target(triangles)];
            let tips = [edge, twin].map(|side| side.previous().origin(triangles));
            let share: f64 = if sharp.binary_search(&ordered(&ends)).is_ok() { SHARP_SHARE } else { 1.0 };
            let areas = double_area(edge.triangle()) + double_area(twin.triangle());
            let scale = (0.5 * share / whole).sqrt() * areas;
            jump(ends, tips, uv).map(|(node, number)| (node, scale * number))
        });
        Self { rows: rows.collect_vec() }
    }
}

/// The jump of the gradient across an edge, by node. Along the edge a and b with tips c and d at the distances h_c
/// and h_d the functions 1 and s, the place along the edge, have none, which leaves
/// ```text
/// f_c / h_c + f_d / h_d - sum over a and b of what makes both vanish
/// ```
fn jump([a, b]: [u32; 2], tips: [u32; 2], uv: &[DVec2]) -> [(u32, f64); 4] {
    let [from, to] = [a, b].map(|node| uv[node as usize]);
    let along = to - from;
    let length = along.length();
    let of_tip = tips.map(|tip| {
        let r = uv[tip as usize] - from;
        let height = along.perp_dot(r).abs() / length;
        (tip, 1.0 / height, along.dot(r) / (length * length))
    });
    let at_b: f64 = of_tip.iter().map(|&(_, slope, place)| -slope * place).sum();
    let at_a: f64 = of_tip.iter().map(|&(_, slope, place)| -slope * (1.0 - place)).sum();
    let [(c, at_c, _), (d, at_d, _)] = of_tip;
    [(a, at_a), (b, at_b), (c, at_c), (d, at_d)]
}

/// The control points, three components each, with an energy and its weight mu W; none if samples and energy leave
/// them undetermined.
pub(super) fn solve(
    surface: &D1rcSurface,
    samples: &Samples,
    energy: (&Energy, f64),
    pool: &Pool,
    watch: &Watch,
) -> Result<Option<Vec<f64>>, Cancelled> {
    let count = surface.space().vertex_count();
    let mut rows = Rows::default();
    let mut right = memory::with_capacity(samples.values.len());
    // batches bound the time between looks at the watch
    for (k, uv) in samples.uv.chunks(64 * CHUNK).enumerate() {
        watch.check()?;
        let first = 64 * CHUNK * k;
        let parts: Vec<Rows> = pool.run(|| {
            let part = |(part, uv): (usize, &[DVec2])| {
                let weights = &samples.weights[first + CHUNK * part..];
                let (mut rows, mut blend) = (Rows::default(), Vec::new());
                // a cancelled call throws its rows away
                for (&uv, weight) in uv.iter().zip(weights).take_while(|_| watch.check().is_ok()) {
                    surface.vertex_weights(uv, &mut blend);
                    rows.push(blend.iter().map(|&(vertex, share)| (vertex, weight.sqrt() * share)));
                }
                rows
            };
            uv.par_chunks(CHUNK).enumerate().map(part).collect_vec()
        });
        parts.into_iter().for_each(|part| rows.append(part));
    }
    for (value, weight) in samples.values.chunks_exact(3).zip(samples.weights) {
        memory::extend(&mut right, value.iter().map(|x| weight.sqrt() * x));
    }
    let (energy, weight) = energy;
    let scale = weight.sqrt();
    for row in &energy.rows {
        let mut row = row.map(|(node, number)| (node, scale * number));
        row.sort_unstable_by_key(|&(node, _)| node);
        rows.push(row);
    }
    let matrix = rows.into_matrix(count);
    watch.check()?;
    Ok(solve_normal_equations(&matrix, &right))
}

/// Solves `A^T A x = A^T b` for three components; rows beyond those of b have zeros there.
fn solve_normal_equations(matrix: &CsMat<f64>, right: &[f64]) -> Option<Vec<f64>> {
    let n = matrix.cols();
    let mut columns = memory::filled(0.0, 3 * n);
    for (row, value) in matrix.outer_iterator().zip(right.chunks_exact(3)) {
        for (column, number) in row.iter() {
            (0..3).for_each(|k| columns[k * n + column] += number * value[k]);
        }
    }
    // sprs cannot be refused: the transpose, and at most as many products as pairs in a row
    let products: usize = matrix.outer_iterator().map(|row| row.nnz() * row.nnz()).sum();
    memory::ensure((matrix.nnz() + products).saturating_mul(size_of::<(usize, f64)>()));
    let transposed = matrix.transpose_view().to_csr();
    let lower = lower_triangle(&(&transposed * matrix));
    let factor = SymbolicCholesky::new(&lower.view(), None).factor(&lower.view()).ok()?;
    factor.solve(&mut columns, 3);
    Some((0..n).flat_map(|i| [0, 1, 2].map(|k| columns[k * n + i])).collect_vec())
}

/// The lower triangle in columns of a symmetric matrix in rows.
fn lower_triangle(symmetric: &CsMat<f64>) -> CsMat<f64> {
    let n = symmetric.cols();
    let (mut starts, mut indices, mut numbers) = (vec![0], Vec::new(), Vec::new());
    for (k, row) in symmetric.outer_iterator().enumerate() {
        for (column, &number) in row.iter().filter(|&(column, _)| column >= k) {
            memory::push(&mut indices, column);
            memory::push(&mut numbers, number);
        }
        memory::push(&mut starts, indices.len());
    }
    CsMat::new_csc((n, n), starts, indices, numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn the_energy_is_blind_to_linear_functions_and_sees_folds() {
        let mesh = samples::planar(3).unwrap();
        let uv = mesh.parameters().unwrap();
        let energy = Energy::new(&mesh, uv, &[]);
        let linear: Vec<f64> = uv.iter().map(|p| 0.3 + 2.0 * p.x - 0.7 * p.y).collect();
        let folded: Vec<f64> = uv.iter().map(|p| (p.x - 4.0).abs()).collect();
        let apply =
            |row: &[(u32, f64); 4], f: &[f64]| row.iter().map(|&(n, x)| x * f[n as usize]).sum::<f64>();
        for row in &energy.rows {
            let size: f64 = row.iter().map(|(_, x)| x.abs()).sum();
            // values up to 17, three roundings in each weight
            assert!(apply(row, &linear).abs() <= 17.0 * 8.0 * f64::EPSILON * size, "{row:?}");
        }
        assert!(energy.rows.iter().any(|row| apply(row, &folded).abs() > 1e-3));
        // an edge that is sharp costs a thousandth
        let [a, b, ..] = energy.rows[7].map(|(node, _)| node);
        let sharp = Energy::new(&mesh, uv, &[[b, a]]);
        for (before, after) in energy.rows[7].iter().zip(&sharp.rows[7]) {
            assert!((after.1 - 1e-3 * before.1).abs() <= 8.0 * f64::EPSILON * before.1.abs());
        }
    }
}
