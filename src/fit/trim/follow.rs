//! One loop: feet of places on its curves, joined by straight lines in (u,v) that are halved until the surface over them
//! is near the curve.
//!
//! What lies over a line is compared with the piece of the curve that the line stands for, and with no other: where
//! neighbouring feet are far apart, on both sides of a seam, no halving mends it, and it is noticed.

use super::CurveTrimError;
use super::chain::Link;
use crate::control::Control;
use crate::curve::Curve;
use crate::memory::{self, CollectVec};
use crate::query::project::{ProjectOptions, Projector};
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Where the surface over a line is compared with the curve, as shares of the line: its begin, and between.
const ON_LINE: [f64; 8] = [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];
/// Where the curve is compared with the line, as shares of its piece; it is halved at the middle one.
const ON_CURVE: [f64; 3] = [0.25, 0.5, 0.75];
/// A piece that is still off after so many halvings stays off.
const MOST_HALVINGS: usize = 16;
/// Places of a loop at least that are first projected one after the other, each found from the one before it: a loop that
/// runs along a seam of the surface then stays on its own side of it.
const LEAST_STEPS: usize = 256;
/// Newton steps from a place on the line to the nearest one of its piece of curve; ends that are not nearest only make
/// the distance larger.
const NEWTON_STEPS: usize = 4;

/// What a loop is made from.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub surface: &'a dyn Surface,
    pub projector: &'a Projector,
    pub tolerance: f64,
}

/// A distance, and where on the curves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distance {
    pub distance: f64,
    pub curve: usize,
    pub parameter: f64,
}

/// A loop in the parameter plane, and how far the surface over it is from its curves.
#[derive(Debug, Default)]
pub(super) struct Followed {
    /// The first is not repeated.
    pub loop_uv: Vec<DVec2>,
    pub at_vertices: Vec<Distance>,
    pub between: Vec<Distance>,
    pub unproven: usize,
}

/// The nearest place on the surface.
#[derive(Debug, Clone, Copy)]
struct Foot {
    uv: DVec2,
    is_proven: bool,
}

/// A piece of a curve, and the line that stands for it.
#[derive(Debug, Clone, Copy)]
struct Piece<'a> {
    link: Link<'a>,
    t: [f64; 2],
    feet: [Foot; 2],
}

impl Piece<'_> {
    fn t_at(&self, share: f64) -> f64 {
        self.t[0] + share * (self.t[1] - self.t[0])
    }

    fn uv_at(&self, share: f64) -> DVec2 {
        self.feet[0].uv.lerp(self.feet[1].uv, share)
    }

    /// The share of the line that is nearest to a place in the parameter plane.
    fn nearest_share(&self, uv: DVec2) -> f64 {
        let [from, to] = self.feet.map(|foot| foot.uv);
        let along = to - from;
        let share = (uv - from).dot(along) / along.length_squared();
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }

    fn halves(self, middle: Foot) -> [Self; 2] {
        let [begin, end] = self.feet;
        let t = self.t_at(0.5);
        [
            Self { t: [self.t[0], t], feet: [begin, middle], ..self },
            Self { t: [t, self.t[1]], feet: [middle, end], ..self },
        ]
    }
}

/// How far a line is from its piece of curve.
#[derive(Debug, Clone)]
struct Measured {
    on_line: Vec<Distance>,
    worst: Distance,
}

/// Follows the curves of a loop.
pub(super) fn follow(
    ground: &Ground,
    links: &[Link],
    control: &mut Control,
) -> Result<Followed, CurveTrimError> {
    let mut done: Vec<Option<Measured>> = Vec::new();
    let mut pieces = first_pieces(ground, links, control)?;
    done.resize(pieces.len(), None);
    for round in 0_usize.. {
        let open = pieces.iter().zip(&done).filter(|(_, done)| done.is_none()).map(|(piece, _)| *piece);
        let open = open.collect_vec();
        if open.is_empty() {
            break;
        }
        let feet = feet_inside(ground, &open, control)?;
        let measured = control.run(|| {
            let pairs = open.par_iter().zip(&feet);
            pairs.map(|(piece, feet)| measure(ground.surface, piece, feet)).collect::<Vec<_>>()
        });
        if round == MOST_HALVINGS {
            check_reached(&measured, ground.tolerance)?;
        }
        (pieces, done) = halved(pieces, done, measured.into_iter().zip(feet), ground.tolerance);
        control.report(1.0 - 0.5_f64.powi(round as i32 + 1), f64::NAN)?;
    }
    Ok(followed(&pieces, done))
}

/// The pieces between breaks, divided as often as the degree says: a straight one is not.
fn first_pieces<'a>(
    ground: &Ground,
    links: &[Link<'a>],
    control: &Control,
) -> Result<Vec<Piece<'a>>, CurveTrimError> {
    let mut ends: Vec<(Link, [f64; 2])> = Vec::new();
    for link in links {
        let divisions = link.curve.knots().degree().max(1);
        for pair in link.breaks().windows(2) {
            let at = |k: usize| match k {
                0 => pair[0],
                k if k == divisions => pair[1],
                k => pair[0] + (pair[1] - pair[0]) * k as f64 / divisions as f64,
            };
            memory::extend(&mut ends, (0..divisions).map(|k| (*link, [at(k), at(k + 1)])));
        }
    }
    let feet = march(ground, &ends, control)?;
    let next = |k: usize| feet[(k + 1) % feet.len()];
    let pieces = ends.iter().enumerate();
    Ok(pieces.map(|(k, &(link, t))| Piece { link, t, feet: [feet[k], next(k)] }).collect_vec())
}

/// The foot of the begin of each piece: all the way along the loop in small steps, twice, so that the first also follows
/// from the last. Where two curves meet it is that of the middle of the gap.
fn march(
    ground: &Ground,
    pieces: &[(Link, [f64; 2])],
    control: &Control,
) -> Result<Vec<Foot>, CurveTrimError> {
    let steps = LEAST_STEPS.div_ceil(pieces.len());
    let mut places = memory::with_capacity(steps * pieces.len());
    for (k, (link, t)) in pieces.iter().enumerate() {
        let (before, last) = &pieces[(k + pieces.len() - 1) % pieces.len()];
        memory::push(&mut places, (before.place(last[1]) + link.place(t[0])) / 2.0);
        let inner = (1..steps).map(|step| t[0] + (t[1] - t[0]) * step as f64 / steps as f64);
        memory::extend(&mut places, inner.map(|t| link.place(t)));
    }
    let (mut feet, mut worst) = (memory::with_capacity(pieces.len()), (0.0, 0));
    let mut guess: Option<DVec2> = None;
    for lap in 0..2 {
        for (k, place) in places.iter().enumerate() {
            let guesses = guess.as_ref().map(std::slice::from_ref);
            let (foot, distance) = project(ground, &place.to_array(), guesses, control)?[0];
            guess = Some(foot.uv);
            if distance > worst.0 {
                worst = (distance, k);
            }
            if lap == 1 && k.is_multiple_of(steps) {
                memory::push(&mut feet, foot);
            }
        }
    }
    let (link, t) = pieces[worst.1 / steps];
    let parameter = t[0] + (t[1] - t[0]) * (worst.1 % steps) as f64 / steps as f64;
    check_near(Distance { distance: worst.0, curve: link.number, parameter }, ground.tolerance)?;
    Ok(feet)
}

/// Feet and distances, anywhere on the surface.
fn project(
    ground: &Ground,
    points: &[f64],
    guesses: Option<&[DVec2]>,
    control: &Control,
) -> Result<Vec<(Foot, f64)>, CurveTrimError> {
    let options = ProjectOptions { guesses, keep_trims: false, ..ProjectOptions::default() };
    let found = ground.projector.project(points, &options, control.pool())?;
    let domain = ground.surface.domain();
    let foot = |(uv, flags): (&DVec2, &u8)| Foot { uv: domain.clamp(*uv), is_proven: *flags == 0 };
    Ok(found.uv.iter().zip(&found.flags).map(foot).zip(found.distances.iter().copied()).collect_vec())
}

/// The feet of places inside each piece.
fn feet_inside(
    ground: &Ground,
    pieces: &[Piece],
    control: &Control,
) -> Result<Vec<[Foot; 3]>, CurveTrimError> {
    let count = ON_CURVE.len() * pieces.len();
    let (mut points, mut guesses) = (memory::with_capacity(3 * count), memory::with_capacity(count));
    for piece in pieces {
        for share in ON_CURVE {
            memory::extend(&mut points, piece.link.place(piece.t_at(share)).to_array());
            memory::push(&mut guesses, piece.uv_at(share));
        }
    }
    let found = project(ground, &points, Some(&guesses), control)?;
    for (piece, found) in pieces.iter().zip(found.chunks_exact(ON_CURVE.len())) {
        for (share, (_, distance)) in ON_CURVE.iter().zip(found) {
            let (curve, parameter) = (piece.link.number, piece.t_at(*share));
            check_near(Distance { distance: *distance, curve, parameter }, ground.tolerance)?;
        }
    }
    Ok(found.as_chunks::<3>().0.iter().map(|feet| feet.map(|(foot, _)| foot)).collect_vec())
}

fn check_near(far: Distance, tolerance: f64) -> Result<(), CurveTrimError> {
    let Distance { distance, curve, parameter } = far;
    if distance <= tolerance {
        return Ok(());
    }
    Err(CurveTrimError::TooFar { curve, parameter, distance, tolerance })
}

/// Compares a line with its piece both ways.
fn measure(surface: &dyn Surface, piece: &Piece, feet: &[Foot; 3]) -> Measured {
    let shares = ON_LINE.iter().copied().chain(feet.iter().map(|foot| piece.nearest_share(foot.uv)));
    let shares = shares.collect_vec();
    let uv = shares.iter().map(|&share| piece.uv_at(share)).collect_vec();
    let mut rows = memory::filled(0.0, 3 * uv.len());
    surface.eval_rows(&uv, 0, &mut rows);
    let points = rows.chunks_exact(3).map(DVec3::from_slice).collect_vec();
    let (on_line, at_feet) = points.split_at(ON_LINE.len());
    let curve = piece.link.number;
    let from_line = |(&point, &share): (&DVec3, &f64)| {
        let (distance, parameter) = nearest(piece.link.curve, piece.t, piece.t_at(share), point);
        Distance { distance, curve, parameter }
    };
    let from_curve = |(point, &share): (&DVec3, &f64)| {
        let parameter = piece.t_at(share);
        Distance { distance: piece.link.place(parameter).distance(*point), curve, parameter }
    };
    let on_line = on_line.iter().zip(&ON_LINE).map(from_line).collect_vec();
    let both = on_line.iter().copied().chain(at_feet.iter().zip(&ON_CURVE).map(from_curve));
    let worst = both.reduce(farther).unwrap_or(Distance { distance: 0.0, curve, parameter: piece.t[0] });
    Measured { on_line, worst }
}

/// The farther of two places; one whose distance is no number is farther than any.
fn farther(a: Distance, b: Distance) -> Distance {
    if b.distance <= a.distance { a } else { b }
}

/// The distance of a point to a piece of a curve, and the parameter of the place found: a local minimum, or a place that
/// is no nearer.
fn nearest(curve: &Curve, ends: [f64; 2], start: f64, point: DVec3) -> (f64, f64) {
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let off = |t: f64| {
        let mut rows = [0.0; 6];
        curve.eval_rows(&[t], 1, &mut rows);
        (DVec3::from_slice(&rows) - point, DVec3::from_slice(&rows[3..]))
    };
    let (mut best, (mut from_point, mut speed)) = (start, off(start));
    for _ in 0..NEWTON_STEPS {
        let step = from_point.dot(speed) / speed.length_squared();
        if !step.is_finite() {
            break;
        }
        let next = (best - step).clamp(low, high);
        let (from_next, speed_next) = off(next);
        if !(from_next.length() < from_point.length()) {
            break;
        }
        (best, from_point, speed) = (next, from_next, speed_next);
    }
    (from_point.length(), best)
}

fn check_reached(measured: &[Measured], tolerance: f64) -> Result<(), CurveTrimError> {
    let worst = measured.iter().map(|measured| measured.worst).reduce(farther);
    match worst {
        Some(Distance { distance, curve, parameter }) if !(distance <= tolerance) => {
            Err(CurveTrimError::Unreached { curve, parameter, distance, tolerance })
        }
        _ => Ok(()),
    }
}

type Pieces<'a> = (Vec<Piece<'a>>, Vec<Option<Measured>>);

/// Keeps the measures of pieces within the tolerance, and halves the others.
fn halved<'a>(
    pieces: Vec<Piece<'a>>,
    done: Vec<Option<Measured>>,
    mut measured: impl Iterator<Item = (Measured, [Foot; 3])>,
    tolerance: f64,
) -> Pieces<'a> {
    let (mut next, mut next_done) =
        (memory::with_capacity(pieces.len()), memory::with_capacity(pieces.len()));
    for (piece, done) in pieces.into_iter().zip(done) {
        let found = if done.is_some() { None } else { measured.next() };
        match found {
            Some((measured, [_, middle, _])) if !(measured.worst.distance <= tolerance) => {
                memory::extend(&mut next, piece.halves(middle));
                memory::extend(&mut next_done, [None, None]);
            }
            found => {
                memory::push(&mut next, piece);
                memory::push(&mut next_done, done.or(found.map(|(measured, _)| measured)));
            }
        }
    }
    (next, next_done)
}

/// The loop, without vertices that lie on the one before.
fn followed(pieces: &[Piece], measured: Vec<Option<Measured>>) -> Followed {
    let mut found = Followed::default();
    for (piece, measured) in pieces.iter().zip(measured) {
        let [foot, next] = piece.feet;
        found.unproven += usize::from(!foot.is_proven);
        if foot.uv != next.uv {
            memory::push(&mut found.loop_uv, foot.uv);
        }
        let on_line = measured.map_or_else(Vec::new, |measured| measured.on_line);
        memory::extend(&mut found.at_vertices, on_line.iter().take(1).copied());
        memory::extend(&mut found.between, on_line.into_iter().skip(1));
    }
    found
}
