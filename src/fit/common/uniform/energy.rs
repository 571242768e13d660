//! The energies that smooth a fit, as sums of products of one-dimensional matrices.

use super::grid::{Banded4, UniformBasis};
use crate::fit::common::FitError;
use crate::surface::Domain;
use glam::DVec2;

/// Which second derivatives cost energy, per cell of unit size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Energy {
    /// Elastic beams along the knot lines: `x_ss^2` on lines of constant v, `x_tt^2` on lines of constant u.
    /// Free are 1, s, t and st.
    #[default]
    Beam,
    /// An elastic plate: `x_ss^2 + 2 x_st^2 + x_tt^2` over the cells. Free are 1, s and t.
    Plate,
}

/// `weight * u (x) v`.
pub struct EnergyTerm {
    pub weight: f64,
    pub u: Banded4,
    pub v: Banded4,
}

impl Energy {
    /// This energy, or the plate's where this one leaves a surface over such data undetermined.
    pub(in crate::fit) fn determining(self, uv: &[DVec2], data: &Domain) -> Result<Self, FitError> {
        match FreeFunctions::of(uv, data) {
            FreeFunctions::None => Ok(self),
            FreeFunctions::Bilinear => Ok(Self::Plate),
            FreeFunctions::Linear => Err(FitError::Singular),
        }
    }

    /// The energy over the product of two bases.
    pub fn terms(self, u: &UniformBasis, v: &UniformBasis) -> Vec<EnergyTerm> {
        let term = |weight, u, v| EnergyTerm { weight, u, v };
        match self {
            Self::Beam => {
                vec![term(1.0, u.gram(2), v.knot_sum()), term(1.0, u.knot_sum(), v.gram(2))]
            }
            Self::Plate => vec![
                term(1.0, u.gram(2), v.gram(0)),
                term(2.0, u.gram(1), v.gram(1)),
                term(1.0, u.gram(0), v.gram(2)),
            ],
        }
    }
}

/// Which functions without energy vanish at all data, within rounding: those leave a fit undetermined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FreeFunctions {
    /// None of a + bu + cv + duv.
    None,
    /// One with d: the data lie on a hyperbola, or are three. The plate energy settles it.
    Bilinear,
    /// One without: the data lie on a line.
    Linear,
}

/// A pivot below this share of the number of data is zero: data this close to a line (the root of it, as a share
/// of their range) are on it. Not a share of its own diagonal entry, which is nothing but rounding where a function
/// vanishes at all data.
const LEAST_PIVOT: f64 = 1e-13;

impl FreeFunctions {
    /// Factors the Gram matrix of 1, u, v, uv over the data and looks for a pivot that vanishes. Elimination in this
    /// order and by hand: which pivot vanishes is the answer, and a library's pivoting would lose it.
    pub(crate) fn of(uv: &[DVec2], data: &Domain) -> Self {
        let (center, half) = ((data.min + data.max) / 2.0, data.size() / 2.0);
        let mut gram = [[0.0; 4]; 4];
        for p in uv {
            let DVec2 { x: s, y: t } = (*p - center) / half;
            let row = [1.0, s, t, s * t];
            for i in 0..4 {
                for j in 0..4 {
                    gram[i][j] += row[i] * row[j];
                }
            }
        }
        let count = gram[0][0];
        for k in 0..4 {
            if gram[k][k] <= LEAST_PIVOT * count {
                return if k < 3 { Self::Linear } else { Self::Bilinear };
            }
            for i in k + 1..4 {
                let share = gram[i][k] / gram[k][k];
                for j in k + 1..4 {
                    gram[i][j] -= share * gram[k][j];
                }
            }
        }
        Self::None
    }
}
