//! Axis-parallel boxes in any dimension.

/// The smallest box around rows of `dim` numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// Least value of each component; +infinity while nothing was included.
    pub min: Vec<f64>,
    /// Largest value of each component; -infinity while nothing was included.
    pub max: Vec<f64>,
}

impl Bounds {
    /// The box of `rows`, stored row by row.
    pub fn of_rows(rows: &[f64], dim: usize) -> Self {
        let mut bounds = Self { min: vec![f64::INFINITY; dim], max: vec![f64::NEG_INFINITY; dim] };
        for row in rows.chunks_exact(dim) {
            for (k, &x) in row.iter().enumerate() {
                bounds.min[k] = bounds.min[k].min(x);
                bounds.max[k] = bounds.max[k].max(x);
            }
        }
        bounds
    }

    /// Length of each side; 0 for an empty box.
    pub fn sides(&self) -> impl Iterator<Item = f64> + '_ {
        self.min.iter().zip(&self.max).map(|(a, b)| (b - a).max(0.0))
    }

    /// Length of the diagonal: what relative tolerances refer to.
    pub fn diagonal(&self) -> f64 {
        self.sides().fold(0.0, |length: f64, side| length.hypot(side))
    }

    /// How far a row lies outside the box; 0 inside.
    pub fn distance(&self, row: &[f64]) -> f64 {
        let limits = self.min.iter().zip(&self.max);
        let beyond = row.iter().zip(limits).map(|(x, (min, max))| (min - x).max(x - max).max(0.0));
        beyond.fold(0.0, |length: f64, side| length.hypot(side))
    }
}
