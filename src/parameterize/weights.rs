//! Weights of the neighbours of each interior node.
//!
//! M. Floater, "Mean value coordinates", Comput. Aided Geom. Design 20 (2003), 19-27; U. Pinkall,
//! K. Polthier, "Computing discrete minimal surfaces and their conjugates", Exp. Math. 2 (1993).
//! ```text
//! mean value   w_nm = (tan(alpha/2) + tan(beta/2)) / |P_n - P_m|      alpha, beta at n
//! harmonic     w_nm = (cot(gamma) + cot(delta)) / 2                   opposite the edge
//! ```
//! over the two triangles of the edge. Mean value weights are positive and not symmetric; harmonic
//! ones are symmetric and negative where gamma + delta > pi. Triangles without area give none.

use super::patch::Patch;
use super::{Method, ParameterizeError};
use crate::memory::{self, CollectVec};
use glam::DVec3;

/// The weights by slot, rows of unknowns scaled to sum 1.
pub(super) fn weights(patch: &Patch, method: Method) -> Result<Vec<f64>, ParameterizeError> {
    let mut weights = memory::filled(0.0, patch.neighbours.nodes().len());
    for &[a, b, c] in &patch.triangles {
        for [n, next, last] in [[a, b, c], [b, c, a], [c, a, b]] {
            let corner = [n, next, last].map(|node| patch.points[node as usize]);
            match method {
                Method::MeanValue => {
                    let [to_next, to_last] = mean_value_shares(corner);
                    weights[patch.neighbours.slot(n, next)] += to_next;
                    weights[patch.neighbours.slot(n, last)] += to_last;
                }
                Method::Harmonic => {
                    let share = cotangent(corner) / 2.0;
                    weights[patch.neighbours.slot(next, last)] += share;
                    weights[patch.neighbours.slot(last, next)] += share;
                }
            }
        }
    }
    scale_rows(patch, &mut weights)?;
    check_ties(patch, &weights)?;
    Ok(weights)
}

/// Of half an angle, 2e-4 short of a right one. A node on the side of its own triangle would have weights without
/// bound, and a map that leaves that triangle no area; this far from the side nothing is lost by rounding.
const LARGEST_TANGENT: f64 = 1e4;

/// What the triangle adds to the weights of its two edges at the first corner.
fn mean_value_shares([at, next, last]: [DVec3; 3]) -> [f64; 2] {
    let (e1, e2) = (next - at, last - at);
    let (length1, length2) = (e1.length(), e2.length());
    let (sine, cosine) = (e1.cross(e2).length(), e1.dot(e2)); // times both lengths
    // of the half angle; of the two forms the one in which nothing cancels
    let tangent = if cosine > 0.0 {
        sine / (length1 * length2 + cosine)
    } else {
        ((length1 * length2 - cosine) / sine).min(LARGEST_TANGENT)
    };
    let shares = [tangent / length1, tangent / length2];
    if shares.iter().all(|share| share.is_finite()) { shares } else { [0.0; 2] }
}

/// Of the angle at the first corner; 0 without area.
fn cotangent([at, next, last]: [DVec3; 3]) -> f64 {
    let (e1, e2) = (next - at, last - at);
    let cotangent = e1.dot(e2) / e1.cross(e2).length();
    if cotangent.is_finite() { cotangent } else { 0.0 }
}

/// Scales the rows of the unknowns to sum 1.
pub(super) fn scale_rows(patch: &Patch, weights: &mut [f64]) -> Result<(), ParameterizeError> {
    for &node in &patch.nodes {
        let row = &mut weights[patch.neighbours.slots(node as usize)];
        let total: f64 = row.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return Err(ParameterizeError::ZeroWeight { node: node as usize, total });
        }
        row.iter_mut().for_each(|weight| *weight /= total);
    }
    Ok(())
}

/// Each unknown needs a path of weights to a fixed node, else the system is singular.
fn check_ties(patch: &Patch, weights: &[f64]) -> Result<(), ParameterizeError> {
    let mut tied: Vec<bool> = (0..patch.points.len()).map(|i| patch.is_fixed(i as u32)).collect_vec();
    let mut stack: Vec<u32> = (0..patch.points.len() as u32).filter(|&i| patch.is_fixed(i)).collect_vec();
    while let Some(node) = stack.pop() {
        for &other in patch.neighbours.of(node as usize) {
            if !tied[other as usize] && weights[patch.neighbours.slot(other, node)] != 0.0 {
                tied[other as usize] = true;
                stack.push(other);
            }
        }
    }
    match tied.iter().position(|tied| !tied) {
        Some(node) => Err(ParameterizeError::Untied { node }),
        None => Ok(()),
    }
}
