//! Linear combinations of the free unknowns of a space.

/// Unknowns with their factors, ascending.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Combination(Vec<(u32, f64)>);

impl Combination {
    /// One unknown.
    pub fn unknown(number: u32) -> Self {
        Self(vec![(number, 1.0)])
    }

    /// The sum of combinations times factors.
    pub fn sum<'a>(terms: impl IntoIterator<Item = (f64, &'a Self)>) -> Self {
        let mut all: Vec<(u32, f64)> = Vec::new();
        for (factor, combination) in terms {
            if factor != 0.0 {
                all.extend(combination.0.iter().map(|&(number, x)| (number, factor * x)));
            }
        }
        // stable, so that equal unknowns are added in the order of the terms
        all.sort_by_key(|&(number, _)| number);
        let mut sum: Vec<(u32, f64)> = Vec::with_capacity(all.len());
        for (number, x) in all {
            match sum.last_mut() {
                Some(last) if last.0 == number => last.1 += x,
                _ => sum.push((number, x)),
            }
        }
        sum.retain(|&(_, x)| x != 0.0);
        Self(sum)
    }

    /// A multiple.
    pub fn scaled(&self, factor: f64) -> Self {
        Self::sum([(factor, self)])
    }

    /// The unknowns with their factors, ascending.
    pub fn terms(&self) -> &[(u32, f64)] {
        &self.0
    }

    /// The largest size of a factor.
    pub fn largest(&self) -> f64 {
        self.0.iter().fold(0.0, |largest, &(_, x)| x.abs().max(largest))
    }
}
