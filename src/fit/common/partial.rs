//! Fields without values at some nodes, and fields with one value on each triangle.
//!
//! Such values are scattered data over the parameters of the nodes, or of the middles of the triangles; the surface is
//! one over all of the mesh, with its loops as trims, all the same.

use super::checks::{check_count, check_weights};
use super::error::FitError;
use super::fitted::Fit;
use super::parameters::{NodeParameters, trims};
use crate::control::Control;
use crate::geometry::Domain;
use crate::mesh::Mesh;
use crate::surface::Surface;
use glam::DVec2;
use std::time::Instant;

/// What a value means that is NaN.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Missing {
    /// A mistake: the fit is refused.
    #[default]
    Refused,
    /// There is none: the datum is passed over, and has no error.
    Skipped,
}

/// Fits values that some nodes of a mesh do not have, or triangles have, `rows` in all, as scattered ones over all of the
/// mesh: `map` gives the nodes their parameters, `fit` fits what has a place over a box.
pub(in crate::fit) fn fit_on_mesh<S: Surface>(
    mesh: &Mesh,
    rows: usize,
    control: &mut Control,
    map: impl FnOnce(&mut Control) -> Result<NodeParameters, FitError>,
    fit: impl FnOnce(&[Option<DVec2>], Domain, &mut Control) -> Result<Fit<S>, FitError>,
) -> Result<Fit<S>, FitError> {
    let start = Instant::now();
    control.set_stage(0.0, 0.3);
    let map = map(control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    control.set_stage(0.3, 1.0);
    let places = places_of_values(mesh, &map.uv, rows);
    let mut fitted = fit(&places, box_of_nodes(mesh, &map.uv), control)?;
    let domain = fitted.surface.domain();
    fitted.surface.region_mut().trims = trims(Some(mesh), &map.uv, &domain);
    fitted.report.parameterize_seconds = parameterize_seconds;
    fitted.report.remarks.0 |= map.remarks.0;
    fitted.report.measure_map(mesh, &map.uv, control.pool().watch());
    Ok(fitted)
}

/// Fits values that some points do not have over the box of all.
pub(in crate::fit) fn fit_at_points<S>(
    uv: &[DVec2],
    fit: impl FnOnce(&[Option<DVec2>], Domain) -> Result<Fit<S>, FitError>,
) -> Result<Fit<S>, FitError> {
    let places: Vec<Option<DVec2>> = uv.iter().copied().map(Some).collect();
    fit(&places, Domain::around(uv.iter().copied()))
}

/// The parameters at which the values of a field on a mesh are: those of its nodes, or, where there are as many rows as
/// triangles and not as nodes, those of the triangles' centroids. Nodes that no triangle needs have no place.
fn places_of_values(mesh: &Mesh, uv: &[DVec2], rows: usize) -> Vec<Option<DVec2>> {
    if is_on_triangles(mesh, rows) {
        let middle = |nodes: &[u32; 3]| nodes.iter().map(|&node| uv[node as usize]).sum::<DVec2>() / 3.0;
        return mesh.triangles().iter().map(|nodes| Some(middle(nodes))).collect();
    }
    (0..uv.len()).map(|node| mesh.is_used(node as u32).then_some(uv[node])).collect()
}

/// The box of the parameters of a mesh: its border lies beyond the middles of its triangles.
fn box_of_nodes(mesh: &Mesh, uv: &[DVec2]) -> Domain {
    Domain::around((0..).zip(uv).filter(|&(node, _)| mesh.is_used(node)).map(|(_, &uv)| uv))
}

/// Whether so many rows are the values of triangles.
pub(in crate::fit) fn is_on_triangles(mesh: &Mesh, rows: usize) -> bool {
    rows == mesh.triangles().len() && rows != mesh.points().len()
}

/// Whether some value is missing, and may be.
pub(in crate::fit) fn is_partial(values: &[f64], missing: Missing) -> bool {
    missing == Missing::Skipped && values.iter().any(|x| x.is_nan())
}

/// The data that have values, of all that might.
pub(in crate::fit) struct Partial {
    /// Parameters of those that have.
    pub uv: Vec<DVec2>,
    /// Their rows.
    pub values: Vec<f64>,
    weights: Option<Vec<f64>>,
    /// Their numbers among all.
    given: Vec<usize>,
    /// Of all, with the place of the first that has a value for those without a place.
    all_uv: Vec<DVec2>,
    /// The box of all, and of the mesh they lie on.
    pub data_box: Domain,
}

impl Partial {
    /// `values`: rows of `dim` numbers; a row with a NaN is missing if that is allowed.
    pub(crate) fn of(
        places: &[Option<DVec2>],
        data_box: Domain,
        values: &[f64],
        dim: usize,
        weights: Option<&[f64]>,
        missing: Missing,
    ) -> Result<Self, FitError> {
        let expected = places.len().saturating_mul(dim);
        if values.len() != expected {
            return Err(FitError::Count { what: "the values", count: values.len(), expected });
        }
        check_weights(places.len(), weights)?;
        let row = |datum: usize| &values[datum * dim..][..dim];
        let is_missing = |datum: usize| missing == Missing::Skipped && row(datum).iter().any(|x| x.is_nan());
        let all = places.iter().enumerate().filter_map(|(datum, place)| Some((datum, (*place)?)));
        let (given, uv): (Vec<usize>, Vec<DVec2>) = all.filter(|&(datum, _)| !is_missing(datum)).unzip();
        check_count(given.len())?;
        let some_place = uv[0];
        Ok(Self {
            values: given.iter().flat_map(|&datum| row(datum)).copied().collect(),
            weights: weights.map(|weights| given.iter().map(|&datum| weights[datum]).collect()),
            all_uv: places.iter().map(|place| place.unwrap_or(some_place)).collect(),
            data_box,
            uv,
            given,
        })
    }

    pub(crate) fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Fits these data and tells of all.
    pub(crate) fn fit<S>(
        self,
        fit: impl FnOnce(&Self) -> Result<Fit<S>, FitError>,
    ) -> Result<Fit<S>, FitError> {
        let mut fitted = fit(&self).map_err(|error| self.told(error))?;
        self.spread(&mut fitted);
        Ok(fitted)
    }

    /// An error of the fit in the numbers of all data.
    fn told(&self, mut error: FitError) -> FitError {
        if let FitError::ParametersNotFinite { index }
        | FitError::ValuesNotFinite { index }
        | FitError::Weight { index, .. } = &mut error
        {
            *index = self.given.get(*index).copied().unwrap_or(*index);
        }
        error
    }

    /// Gives what the fit found to all data: one without a value has no error.
    fn spread<S>(self, fitted: &mut Fit<S>) {
        let mut all_uv = self.all_uv;
        let mut all_errors = vec![f64::NAN; all_uv.len()];
        for (place, &datum) in self.given.iter().enumerate() {
            (all_uv[datum], all_errors[datum]) = (fitted.parameters[place], fitted.errors[place]);
        }
        fitted.report.worst_index = self.given[fitted.report.worst_index];
        (fitted.parameters, fitted.errors) = (all_uv, all_errors);
    }
}
