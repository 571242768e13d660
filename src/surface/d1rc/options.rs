//! How a D1RC-spline is made from a control mesh.

use super::error::D1rcError;
use super::frame::Boundary;
use crate::options::with_fields;

/// Which functions there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum D1rcMode {
    /// Links of links: the functions sum to one and reproduce polynomials, on the whole domain.
    #[default]
    Reproducing,
    /// As printed: rational, only inner vertices count, the surface ends a ring before the mesh does.
    Paper,
}

/// What happens at sharp edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SharpRule {
    /// What suits the mode: `Cut` for `Reproducing`, `Additive` for `Paper`.
    #[default]
    Automatic,
    /// Cut and clamped: the crease is the control polyline. For `Reproducing` only.
    Cut,
    /// Functions of the crease, and smooth functions only on their side of it. For `Paper` only.
    Sector,
    /// Functions of the crease beside all smooth ones: a soft crease. The surface becomes rational.
    Additive,
}

/// How a D1RC-spline is made from a control mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct D1rcOptions {
    /// 1, 2 or 3. Default: 3.
    pub degree: usize,
    /// Which functions there are. Default: `Reproducing`.
    pub mode: D1rcMode,
    /// The border of the domain; does not count in the mode `Paper`. Default: `Phantom`.
    pub boundary: Boundary,
    /// What happens at sharp edges. Default: what suits the mode.
    pub sharp: SharpRule,
    /// The weight of the functions that sharp edges and corners add with `Sector` and `Additive`. Default: 1.
    pub sharp_weight: f64,
}

impl Default for D1rcOptions {
    fn default() -> Self {
        Self {
            degree: 3,
            mode: D1rcMode::default(),
            boundary: Boundary::default(),
            sharp: SharpRule::default(),
            sharp_weight: 1.0,
        }
    }
}

impl D1rcOptions {
    with_fields! {
        with_degree degree: usize,
        with_mode mode: D1rcMode,
        with_boundary boundary: Boundary,
        with_sharp sharp: SharpRule,
        with_sharp_weight sharp_weight: f64,
    }

    /// The rule for sharp edges, chosen by the mode if it is automatic.
    pub fn sharp_rule(&self) -> SharpRule {
        match (self.sharp, self.mode) {
            (SharpRule::Automatic, D1rcMode::Reproducing) => SharpRule::Cut,
            (SharpRule::Automatic, D1rcMode::Paper) => SharpRule::Additive,
            (rule, _) => rule,
        }
    }

    pub(super) fn check(&self) -> Result<(), D1rcError> {
        if !(1..=3).contains(&self.degree) {
            return Err(D1rcError::Degree { degree: self.degree });
        }
        if !(self.sharp_weight > 0.0 && self.sharp_weight.is_finite()) {
            return Err(D1rcError::Weight { weight: self.sharp_weight });
        }
        match (self.mode, self.sharp_rule()) {
            (D1rcMode::Reproducing, SharpRule::Sector) => {
                Err(D1rcError::SharpRule { mode: "reproducing", rule: "sector" })
            }
            (D1rcMode::Paper, SharpRule::Cut) => Err(D1rcError::SharpRule { mode: "paper", rule: "cut" }),
            _ => Ok(()),
        }
    }
}
