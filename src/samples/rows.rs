//! Rows of points to be skinned: shapes with counts that differ from row to row.

use glam::DVec2;
use std::f64::consts::PI;

/// Rows of points in space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RowSet {
    /// Three numbers a point, row after row.
    pub points: Vec<f64>,
    /// Points of each row.
    pub counts: Vec<usize>,
}

impl RowSet {
    fn push(&mut self, row: impl IntoIterator<Item = [f64; 3]>) {
        let start = self.points.len();
        self.points.extend(row.into_iter().flatten());
        self.counts.push((self.points.len() - start) / 3);
    }

    /// The points of one row.
    pub fn row(&self, index: usize) -> &[f64] {
        let start: usize = self.counts[..index].iter().sum();
        &self.points[3 * start..3 * (start + self.counts[index])]
    }
}

/// `count` numbers from 0 to 1.
fn shares(count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |k| k as f64 / (count - 1) as f64)
}

/// A dustpan: 11 rows of 10 to 30 points, 222 in all; walls, fillets and a floor, sampled thinly on the straight parts.
pub fn dustpan() -> RowSet {
    const COUNTS: [usize; 11] = [10, 30, 26, 26, 22, 22, 22, 18, 18, 16, 12];
    let mut set = RowSet::default();
    for (j, &count) in COUNTS.iter().enumerate() {
        let y = j as f64 / 10.0;
        let (width, height) = (1.0 - 0.35 * y * y, 0.12 + 0.4 * (0.5 * PI * y).sin());
        let (radius, flare) = (0.05 + 0.18 * y, 0.25 * (1.0 - y));
        let on_arc = ((count - 4) / 4).max(2);
        let straight = count - 2 * on_arc;
        let on_wall = (straight / 4).max(1);
        let on_floor = straight - 2 * on_wall;
        let [top, foot] = [(-width - flare, height), (-width, radius)];
        let wall = |s: f64| (top.0 + (foot.0 - top.0) * s, top.1 + (foot.1 - top.1) * s);
        let arc = |s: f64| {
            let angle = PI + 0.5 * PI * s;
            (-width + radius + radius * angle.cos(), radius + radius * angle.sin())
        };
        let mut profile: Vec<(f64, f64)> = (0..on_wall).map(|k| wall(k as f64 / on_wall as f64)).collect();
        profile.extend(shares(on_arc).map(arc));
        let half = width - radius;
        profile.extend(shares(on_floor + 2).skip(1).take(on_floor).map(|s| (-half + 2.0 * half * s, 0.0)));
        // the right side is the left one mirrored and backwards
        profile.extend(shares(on_arc).map(|s| arc(1.0 - s)).map(|(x, z)| (-x, z)));
        profile.extend(shares(on_wall + 1).skip(1).map(|s| wall(1.0 - s)).map(|(x, z)| (-x, z)));
        set.push(profile.into_iter().map(|(x, z)| [x, 1.6 * y, z]));
    }
    set
}

/// Waves: 5 rows of 54 to 158 points, 504 in all, each with a wavelength of its own, denser where it bends.
pub fn wave() -> RowSet {
    const WAVES: [(f64, usize); 5] = [(2.0, 54), (4.0, 80), (7.0, 112), (11.0, 158), (6.0, 100)];
    const DENSE: usize = 20001;
    let mut set = RowSet::default();
    for (j, (waves, count)) in WAVES.into_iter().enumerate() {
        let y = j as f64 / 4.0 * 0.7;
        let height = |x: f64| 0.06 * (2.0 * PI * waves * x + 0.4 * j as f64).sin() * (1.0 - 0.25 * x);
        let curve: Vec<[f64; 3]> = shares(DENSE).map(|x| [x, y, height(x)]).collect();
        let slope = differences(&curve.iter().map(|p| p[2]).collect::<Vec<f64>>());
        let second = differences(&slope);
        let bend = |(s, b): (&f64, &f64)| b.abs() / (1.0 + s * s).powf(1.5);
        let curvature: Vec<f64> = slope.iter().zip(&second).map(bend).collect();
        let most = curvature.iter().copied().fold(0.0, f64::max);
        let density = |k: usize| 0.35 * (curvature[k] / most).sqrt() + 0.25;
        set.push(resample(&curve, count, density));
    }
    set
}

/// Derivatives by central differences of values at equal steps over the unit interval.
fn differences(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let difference = |k: usize| {
        let (a, b) = (k.saturating_sub(1), (k + 1).min(last));
        (values[b] - values[a]) / ((b - a) as f64 / last as f64)
    };
    (0..=last).map(difference).collect()
}

/// The grip of a screwdriver: 12 closed rows of 90 to 150 points, 1,224 in all, the first one of each repeated at its
/// end.
pub fn screwdriver() -> RowSet {
    const COUNTS: [usize; 12] = [90, 92, 96, 100, 106, 112, 150, 108, 98, 92, 90, 90];
    const DENSE: usize = 8001;
    let mut set = RowSet::default();
    for (j, &count) in COUNTS.iter().enumerate() {
        let y = j as f64 / 11.0;
        let radius = 0.35 + 0.15 * (PI * (y * 0.9 + 0.05)).sin() + 0.04 * (7.0 * y).cos();
        let depth = 0.05 * (PI * ((y - 0.05) / 0.9).clamp(0.0, 1.0)).sin().powi(2);
        let curve: Vec<[f64; 3]> = shares(DENSE)
            .map(|s| {
                let angle = 2.0 * PI * s;
                let r = radius * (1.0 - depth / radius * (3.0 * angle).cos().abs().powi(6));
                [r * angle.cos(), r * angle.sin(), 3.0 * y]
            })
            .collect();
        set.push(resample(&curve, count, |_| 1.0));
    }
    set
}

/// A limb: 14 closed rows, 820 points in all, the first one of each repeated at its end.
pub fn limb() -> RowSet {
    const COUNTS: [usize; 14] = [40, 44, 48, 54, 60, 66, 72, 76, 72, 66, 60, 58, 54, 50];
    const DENSE: usize = 4001;
    let mut set = RowSet::default();
    for (j, &count) in COUNTS.iter().enumerate() {
        let share = 0.15 + 0.85 * j as f64 / (COUNTS.len() - 1) as f64;
        let curve: Vec<[f64; 3]> =
            shares(DENSE).map(|s| super::parts::limb_place(share, 2.0 * PI * s).to_array()).collect();
        set.push(resample(&curve, count, |_| 1.0));
    }
    set
}

/// A head: 100 closed rows, 18,368 points in all, with nose, ears, eyes, mouth, chin and some hair; the first point of
/// each row is repeated at its end.
pub fn head() -> RowSet {
    const ROWS: usize = 100;
    const TOTAL: usize = 18_368;
    const DENSE: usize = 6001;
    // angle, height, depth, and their widths
    const FEATURES: [(f64, f64, f64, f64, f64); 7] = [
        (0.0, 0.48, 0.16, 0.10, 0.05),
        (PI / 2.0, 0.5, 0.10, 0.10, 0.06),
        (-PI / 2.0, 0.5, 0.10, 0.10, 0.06),
        (0.33, 0.6, -0.04, 0.10, 0.03),
        (-0.33, 0.6, -0.04, 0.10, 0.03),
        (0.0, 0.33, 0.05, 0.25, 0.025),
        (0.0, 0.25, 0.07, 0.30, 0.05),
    ];
    let heights: Vec<f64> = (0..ROWS).map(|j| (j as f64 + 0.5) / ROWS as f64).collect();
    let girth: Vec<f64> = heights.iter().map(|y| (PI * (0.08 + 0.86 * y)).sin().powf(0.8)).collect();
    let weight = |girth: &f64| 0.45 + 0.55 * girth;
    let weights: f64 = girth.iter().map(weight).sum();
    let mut counts: Vec<usize> =
        girth.iter().map(|girth| (weight(girth) / weights * TOTAL as f64) as usize).collect();
    counts[ROWS / 2] += TOTAL - counts.iter().sum::<usize>();
    let turn = |angle: f64| (angle + PI).rem_euclid(2.0 * PI) - PI;
    let mut set = RowSet::default();
    for ((&y, &girth), &count) in heights.iter().zip(&girth).zip(&counts) {
        let radius = |angle: f64| {
            let seen = turn(angle);
            let mut r = (0.32 + 0.55 * girth) * (1.0 + 0.12 * seen.cos().powi(2));
            for (at, height, depth, width, reach) in FEATURES {
                let away = turn(seen - at);
                r += depth * (-(away / width).powi(2) - ((y - height) / reach).powi(2)).exp();
            }
            let hair = (26.0 * seen + 9.0 * y).sin() * (-(seen.abs() - PI).powi(2)).exp();
            r + 0.010 * hair * (-((y - 0.7) / 0.25).powi(2)).exp()
        };
        let curve: Vec<[f64; 3]> = shares(DENSE)
            .map(|s| {
                let angle = 2.0 * PI * s; // the seam is at the back
                let r = radius(angle);
                [r * angle.cos(), r * angle.sin(), 2.4 * y]
            })
            .collect();
        set.push(resample(&curve, count, |_| 1.0));
    }
    set
}

/// A border with round corners and a hole like a flower on the sheet of [`super::noisy_sheet`]: closed rows of 96 and 80
/// points, the first one of each repeated at its end.
pub fn sheet_loops() -> RowSet {
    // a superellipse of fourth degree, whose sides are nearly straight
    let border = |angle: f64| {
        let at = DVec2::from_angle(angle);
        at / (at.x.powi(4) + at.y.powi(4)).powf(0.25)
    };
    let flower = |angle: f64| (1.0 + 0.2 * (5.0 * angle).cos()) * DVec2::from_angle(angle);
    let row = |count: usize, size: DVec2, shape: &dyn Fn(f64) -> DVec2| {
        let place = |angle: f64| super::wavy_sheet(DVec2::splat(0.5) + size * shape(angle)).to_array();
        let mut points: Vec<[f64; 3]> =
            (0..count).map(|k| place(2.0 * PI * k as f64 / count as f64)).collect();
        points.push(points[0]);
        points
    };
    let mut set = RowSet::default();
    set.push(row(96, DVec2::splat(0.45), &border));
    set.push(row(80, DVec2::new(0.125, 0.25), &flower));
    set
}

/// `count` points on a polyline, even in its length times `density` of the segments.
fn resample(curve: &[[f64; 3]], count: usize, density: impl Fn(usize) -> f64) -> Vec<[f64; 3]> {
    let mut at = vec![0.0];
    for (k, pair) in curve.windows(2).enumerate() {
        let length: f64 = (0..3).map(|c| (pair[1][c] - pair[0][c]).powi(2)).sum::<f64>().sqrt();
        at.push(at[k] + length * density(k));
    }
    let whole = at[curve.len() - 1];
    let point = |share: f64| {
        let s = share * whole;
        let k = at.partition_point(|&t| t <= s).clamp(1, curve.len() - 1) - 1;
        let x = (s - at[k]) / (at[k + 1] - at[k]);
        [0, 1, 2].map(|c| curve[k][c] + x * (curve[k + 1][c] - curve[k][c]))
    };
    shares(count).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_have_the_rows_they_promise() {
        for (set, rows, points, least, most) in [
            (dustpan(), 11, 222, 10, 30),
            (wave(), 5, 504, 54, 158),
            (screwdriver(), 12, 1224, 90, 150),
            (limb(), 14, 820, 40, 76),
            (head(), 100, 18_368, 127, 268),
            (sheet_loops(), 2, 178, 81, 97),
        ] {
            assert_eq!((set.counts.len(), set.points.len()), (rows, 3 * points));
            assert_eq!(set.counts.iter().sum::<usize>(), points);
            assert!(set.counts.iter().all(|count| (least..=most).contains(count)), "{:?}", set.counts);
        }
    }
}
