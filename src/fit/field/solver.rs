//! The factored equations of the nodes that have values, and those of fewer of them.

use super::FieldOptions;
use super::right_side::{Data, RightSide, Scratch};
use crate::control::{Pool, Watch};
use crate::fit::common::checks::check_count;
use crate::fit::common::samples::InteriorPlace;
use crate::fit::common::uniform::Energy;
use crate::fit::common::uniform::normal_equations::{NormalEquations, Samples, TensorBasis};
use crate::fit::common::{FitError, Missing};
use crate::linalg::Cholesky;
use crate::memory::{self, CollectVec};
use crate::surface::Domain;
use glam::DVec2;
use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The equations of some nodes, factored.
#[derive(Debug)]
pub(crate) struct Solver {
    /// The nodes, in order; None for all.
    pub known: Option<Vec<u32>>,
    pub right_side: RightSide,
    pub factor: Cholesky,
    /// What calls have used and others may use again.
    scratch: Mutex<Vec<Scratch>>,
}

impl Solver {
    /// Runs `work` with memory of an earlier call of the same `dim`, or new one.
    pub(crate) fn with_scratch<R>(
        &self,
        basis: &TensorBasis,
        dim: usize,
        work: impl FnOnce(&mut Scratch) -> R,
    ) -> R {
        let found = {
            let mut kept = lock(&self.scratch);
            kept.iter().position(|scratch| scratch.dim == dim).map(|place| kept.swap_remove(place))
        };
        let new = || Scratch::new(basis, &self.right_side, dim, self.factor.memory(dim));
        let mut scratch = found.unwrap_or_else(new);
        let result = work(&mut scratch);
        lock(&self.scratch).push(scratch);
        result
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the equations of nodes are made of.
#[derive(Debug)]
pub(crate) struct Parts {
    pub basis: TensorBasis,
    pub smoothing: f64,
    energy: Energy,
    weights: Option<Vec<f64>>,
    /// Inside triangles whose nodes all may have values.
    places: Vec<InteriorPlace>,
}

impl Parts {
    pub(crate) fn new(
        basis: TensorBasis,
        options: &FieldOptions,
        energy: Energy,
        places: Vec<InteriorPlace>,
    ) -> Self {
        let weights = options.weights.map(memory::copied);
        Self { basis, smoothing: options.smoothing, energy, weights, places }
    }

    /// The equations of the known of these nodes.
    pub(crate) fn solver(
        &self,
        uv: &[DVec2],
        known: Option<Vec<u32>>,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Solver, FitError> {
        let is_known =
            |node: usize| known.as_ref().is_none_or(|known| known.binary_search(&(node as u32)).is_ok());
        let places = self.places.iter().filter(|place| place.nodes.into_iter().all(is_known));
        let places = places.copied().collect_vec();
        let data = Data::new(uv, known.as_deref(), self.weights.as_deref(), places, self.smoothing);
        watch.check()?;
        let factor = self.factor(&data, pool, watch)?;
        watch.check()?;
        let right_side = RightSide::new(&self.basis, data, pool);
        Ok(Solver { known, right_side, factor, scratch: Mutex::default() })
    }

    fn factor(&self, data: &Data, pool: &Pool, watch: &Watch) -> Result<Cholesky, FitError> {
        let nothing = memory::filled(0.0, data.uv.len());
        let samples = Samples { uv: &data.uv, values: &nothing, dim: 1, weights: Some(&data.weights) };
        let equations = NormalEquations::assemble(self.basis, &samples, pool);
        watch.check()?;
        let symbolic = equations.analyse();
        watch.check()?;
        let terms = self.energy.terms(&self.basis.u, &self.basis.v);
        equations.factor(&symbolic, self.smoothing / 12.0, &terms).map_err(|_| FitError::Singular)
    }
}

/// The equations of fields that lack values at other nodes than they are made for.
#[derive(Debug)]
pub(crate) struct Partly {
    missing: Missing,
    data_box: Domain,
    /// Those of the field before.
    last: Mutex<Option<Arc<Solver>>>,
}

impl Partly {
    pub(crate) fn new(missing: Missing, data_box: Domain) -> Self {
        Self { missing, data_box, last: Mutex::default() }
    }

    /// The nodes that have values, of those that may have; None where these are all.
    pub(crate) fn known_of(&self, solver: &Solver, values: &[f64], dim: usize) -> Option<Vec<u32>> {
        let has_value = |node: u32| values[node as usize * dim..][..dim].iter().all(|x| !x.is_nan());
        if self.missing == Missing::Refused || dim == 0 {
            return None;
        }
        let may_have = solver.right_side.nodes();
        if may_have.iter().all(|&node| has_value(node)) {
            return None;
        }
        Some(may_have.iter().copied().filter(|&node| has_value(node)).collect_vec())
    }

    /// The equations of some of the nodes.
    pub(crate) fn solver(
        &self,
        parts: &Parts,
        uv: &[DVec2],
        known: Vec<u32>,
        pool: &Pool,
    ) -> Result<Arc<Solver>, FitError> {
        let is_it = |solver: &&Arc<Solver>| solver.known.as_ref() == Some(&known);
        if let Some(last) = lock(&self.last).as_ref().filter(is_it) {
            return Ok(Arc::clone(last));
        }
        check_count(known.len())?;
        let known_uv: Vec<DVec2> = known.iter().map(|&node| uv[node as usize]).collect_vec();
        parts.energy.determining(&known_uv, &self.data_box)?;
        let solver = Arc::new(parts.solver(uv, Some(known), pool, pool.watch())?);
        *lock(&self.last) = Some(Arc::clone(&solver));
        Ok(solver)
    }
}

/// Equations that are there, or have been made for a field.
pub(crate) enum Chosen<'a> {
    /// Of all nodes that may have values.
    Whole(&'a Solver),
    /// Of some of them.
    Part(Arc<Solver>),
}

impl Deref for Chosen<'_> {
    type Target = Solver;

    fn deref(&self) -> &Solver {
        match self {
            Self::Whole(solver) => solver,
            Self::Part(solver) => solver,
        }
    }
}
