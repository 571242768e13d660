//! Parameter correction: data move towards their foot points on the surface.
//!
//! J. Hoschek, "Intrinsic parametrization for approximation", Comput. Aided Geom. Des. 5 (1988), 27-31;
//! the rule that keeps triangles from folding is our own.

use crate::control::Pool;
use crate::geometry::safe_scale;
use crate::linalg::Symmetric2;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use crate::parameterize::crossing_nodes;
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// Gauss-Newton steps a datum makes in one sweep.
const STEPS: usize = 2;
/// Longest step, in cells.
pub(crate) const LONGEST_STEP: f64 = 0.3;
/// How often a move is halved before it is given up.
const HALVINGS: u32 = 8;

/// Squared sine of the angle between tangents that are parallel: a thousandth of a minute of arc. A step along them
/// would be a quotient of roundings; with a larger share surfaces that are merely skew would keep their data still.
const PARALLEL: f64 = 1e-12;
/// Data moved in one piece of work, at least.
const PIECE: usize = 256;

/// Where data go that move towards their foot points. From a place they move by no more than `longest` says, and they
/// end where `settle` puts a datum that would go from the one place to the other.
pub(crate) fn foot_points(
    surface: &dyn Surface,
    values: &[f64],
    uv: &[DVec2],
    longest: impl Fn(DVec2) -> DVec2 + Sync,
    settle: impl Fn(usize, DVec2, DVec2) -> DVec2 + Sync,
    pool: &Pool,
) -> Vec<DVec2> {
    let dim = surface.dim();
    let mut moved = memory::copied(uv);
    pool.run(|| {
        let data = moved.par_iter_mut().zip(values.par_chunks(dim)).enumerate().with_min_len(PIECE);
        data.for_each_init(
            || memory::filled(0.0, 3 * dim),
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
    // products of products, of tangents of any length
    let scale = safe_scale(row[dim..].iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (scale * a) * (scale * b)).sum::<f64>();
    let miss: Vec<f64> = value.iter().zip(s).map(|(p, s)| p - s).collect_vec();
    let metric = Symmetric2 { uu: dot(su, su), uv: dot(su, sv), vv: dot(sv, sv) };
    if metric.is_within(PARALLEL) {
        return DVec2::ZERO;
    }
    metric.solve(DVec2::new(dot(su, &miss), dot(sv, &miss)))
}

/// Halves the moves of the nodes of every triangle that would lose nearly all its area, and of every two pieces of the
/// boundary that would meet, until there are none.
///
/// `first` are the parameters whose areas count, of which a triangle keeps at least the share `least`. A map that is
/// mirrored as a whole, as texture coordinates may be, is held as firmly: areas count with the sign that most have.
pub(crate) fn hold_back(mesh: &Mesh, (first, least): (&[DVec2], f64), from: &[DVec2], to: &mut [DVec2]) {
    let triangles = mesh.triangles();
    let area = |uv: &[DVec2], t: &[u32; 3]| {
        let [a, b, c] = t.map(|n| uv[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let turned = triangles.iter().filter(|t| area(first, t) < 0.0).count();
    let sign = if 2 * turned > triangles.len() { -1.0 } else { 1.0 };
    let is_spoilt = |to: &[DVec2], t: &[u32; 3]| {
        let before = sign * area(first, t);
        !(sign * area(to, t) >= least * before) && before > 0.0
    };
    let mut halvings = memory::filled(0, from.len());
    let spoilt = triangles.iter().filter(|t| is_spoilt(to, t));
    let mut nodes: Vec<u32> = spoilt.flatten().copied().chain(crossing_nodes(mesh, to)).collect_vec();
    loop {
        nodes.sort_unstable();
        nodes.dedup();
        nodes.retain(|&n| to[n as usize] != from[n as usize]);
        if nodes.is_empty() {
            return;
        }
        for &n in &nodes {
            let n = n as usize;
            halvings[n] += 1;
            to[n] = if halvings[n] > HALVINGS { from[n] } else { from[n] + (to[n] - from[n]) / 2.0 };
        }
        // a node that moves back may spoil a neighbour; nothing else has changed
        let around = nodes.iter().flat_map(|&n| mesh.outgoing(n)).map(HalfEdge::triangle);
        let mut around: Vec<usize> = around.collect_vec();
        around.sort_unstable();
        around.dedup();
        let has_boundary = nodes.iter().any(|&n| mesh.is_boundary(n));
        nodes.clear();
        let spoilt = around.into_iter().map(|t| &triangles[t]).filter(|t| is_spoilt(to, t));
        memory::extend(&mut nodes, spoilt.flatten().copied());
        if has_boundary {
            memory::extend(&mut nodes, crossing_nodes(mesh, to));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameterize::folds;
    use crate::samples::{Random, curved_notch};

    #[test]
    fn wild_moves_neither_fold_a_map_nor_tangle_its_borders() {
        for mirror in [1.0, -1.0] {
            let mesh = curved_notch(1).unwrap();
            let from: Vec<DVec2> =
                mesh.parameters().unwrap().iter().map(|uv| DVec2::new(mirror * uv.x, uv.y)).collect();
            for reach in [0.1, 1.0] {
                let mut random = Random::new(5);
                let mut to: Vec<DVec2> =
                    from.iter().map(|uv| uv + reach * DVec2::new(random.signed(), random.signed())).collect();
                let wanted = to.clone();
                assert!(!crossing_nodes(&mesh, &to).is_empty());
                hold_back(&mesh, (&from, 1e-3), &from, &mut to);
                assert_eq!(folds(mesh.triangles(), &to), (0, 0), "mirrored {mirror}, moves of {reach}");
                assert!(crossing_nodes(&mesh, &to).is_empty(), "mirrored {mirror}, moves of {reach}");
                assert!(to.iter().zip(&from).any(|(a, b)| a != b));
                assert!(reach > 0.5 || to.iter().zip(&wanted).any(|(a, b)| a == b));
            }
        }
    }
}
