//! The energies that smooth a fit, as sums of products of one-dimensional matrices.

use super::grid::{Banded4, UniformBasis};

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
