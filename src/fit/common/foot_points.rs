//! Parameter correction: data move towards their foot points on the surface.
//!
//! J. Hoschek, "Intrinsic parametrization for approximation", Comput. Aided Geom. Des. 5 (1988), 27-31;
//! the rule that keeps triangles from folding: `parameterization.md` 5.

use crate::control::Pool;
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// Gauss-Newton steps a datum makes in one sweep.
const STEPS: usize = 2;
/// Longest step, in cells.
pub const LONGEST_STEP: f64 = 0.3;
/// How often a move is halved before it is given up.
const HALVINGS: u32 = 8;

/// Squared sine of the angle between tangents that are parallel: a thousandth of a minute of arc. A step along them
/// would be a quotient of roundings; with a larger share surfaces that are merely skew would keep their data still.
const PARALLEL: f64 = 1e-12;
/// Data moved in one piece of work, at least.
const PIECE: usize = 256;

/// Where data go that move towards their foot points. From a place they move by no more than `longest` says, and they
/// end where `settle` puts a datum that would go from the one place to the other.
pub fn foot_points(
    surface: &dyn Surface,
    values: &[f64],
    uv: &[DVec2],
    longest: impl Fn(DVec2) -> DVec2 + Sync,
    settle: impl Fn(usize, DVec2, DVec2) -> DVec2 + Sync,
    pool: &Pool,
) -> Vec<DVec2> {
    let dim = surface.dim();
    let mut moved = uv.to_vec();
    pool.run(|| {
        let data = moved.par_iter_mut().zip(values.par_chunks(dim)).enumerate().with_min_len(PIECE);
        data.for_each_init(
            || vec![0.0; 3 * dim],
            |row, (datum, (uv, value))| {
                // a cancelled call throws its foot points away
                if pool.check().is_err() {
                    return;
                }
                for _ in 0..STEPS {
                    surface.eval_rows(&[*uv], 1, row);
                    let longest = longest(*uv);
                    let step = gauss_newton_step(row, value).clamp(-longest, longest);
                    *uv = settle(datum, *uv, *uv + step);
                }
            },
        );
    });
    moved
}

/// Solves `min |S + du Su + dv Sv - P|`; zero where the tangents are parallel.
fn gauss_newton_step(row: &[f64], value: &[f64]) -> DVec2 {
    let dim = value.len();
    let (s, su, sv) = (&row[..dim], &row[dim..2 * dim], &row[2 * dim..]);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let miss: Vec<f64> = value.iter().zip(s).map(|(p, s)| p - s).collect();
    let (a, b, c) = (dot(su, su), dot(su, sv), dot(sv, sv));
    let (p, q) = (dot(su, &miss), dot(sv, &miss));
    let determinant = a * c - b * b;
    if determinant <= PARALLEL * a * c {
        return DVec2::ZERO;
    }
    DVec2::new(c * p - b * q, a * q - b * p) / determinant
}

/// Halves the moves of the nodes of every triangle that would lose nearly all its area, until none does.
///
/// `first` are the parameters whose areas count, of which a triangle keeps at least the share `least`.
pub fn hold_back(triangles: &[[u32; 3]], (first, least): (&[DVec2], f64), from: &[DVec2], to: &mut [DVec2]) {
    let area = |uv: &[DVec2], t: &[u32; 3]| {
        let [a, b, c] = t.map(|n| uv[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let mut halvings = vec![0; from.len()];
    let mut suspects: Vec<usize> = (0..triangles.len()).collect();
    loop {
        suspects.retain(|&t| {
            let before = area(first, &triangles[t]);
            !(area(to, &triangles[t]) >= least * before) && before > 0.0
        });
        let mut nodes: Vec<u32> = suspects.iter().flat_map(|&t| triangles[t]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.retain(|&n| to[n as usize] != from[n as usize]);
        if nodes.is_empty() {
            return;
        }
        for n in nodes {
            let n = n as usize;
            halvings[n] += 1;
            to[n] = if halvings[n] > HALVINGS { from[n] } else { from[n] + (to[n] - from[n]) / 2.0 };
        }
        // a node that moved back may have spoilt a neighbour
        suspects = (0..triangles.len()).collect();
    }
}
