//! Shapes that are their own mirror images: half of them is fitted, and unfolded cell by cell.

use super::data::Data;
use super::refine::Refinement;
use super::{Estimator, FitError, PhtFit, PhtOptions};
use crate::control::Control;
use crate::fit::common::checks::{check_unused, check_values};
use crate::fit::common::symmetric::{Folded, finish};
use crate::fit::common::{Demands, Half};
use crate::geometry::Axis;
use crate::mesh::Mesh;
use crate::parameterize::ParameterizeOptions;
use crate::surface::pht::PhtSurface;
use crate::tmesh::{Cell, TMesh, Topology, Vertex};
use std::collections::BTreeMap;

/// Fits the shape of a mesh that is its own mirror image by a surface that is.
pub(super) fn fit_symmetric(
    mesh: &Mesh,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    const BY: &str = "the fit of a symmetric shape";
    options.check()?;
    options.demands.check(mesh.points().len())?;
    check_unused(options.estimator == Estimator::Global, "estimator", BY)?;
    check_unused(options.sides.are_free(), "sides", BY)?;
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    check_values(mesh.points().len(), &values, 3, options.weights)?;
    let (tolerance, map) = (options.tolerance, options.parameterize.unwrap_or(ParameterizeOptions::TENSOR));
    control.set_stage(0.0, 0.3);
    let folded = Folded::new(mesh, &options.demands, options.weights, &tolerance, &map, control)?;
    let half_options = PhtOptions {
        tolerance: folded.tolerance,
        demands: Demands { tolerances: Some(&folded.tolerances), ..Demands::default() },
        ..*options
    };
    control.set_stage(0.3, 1.0);
    let half = &folded.half;
    let mut data = Data::of_points(&half.uv, &half.places, 3, Some(&folded.weights));
    data.is_mirrored = true;
    let fit = Refinement::new(data, &half_options)?.run(control)?;
    let surface = unfolded(&fit.surface, half)?;
    let asked = (&folded, &tolerance);
    let mut whole = finish(surface, fit.report, mesh, options.demands.tolerances, asked, control);
    whole.report.cell_count = whole.surface.mesh().leaf_count();
    Ok(whole)
}

/// The surface of which a half is given.
fn unfolded(surface: &PhtSurface, half: &Half) -> Result<PhtSurface, FitError> {
    let own = surface.mesh();
    let lines = own.breaks(Axis::U);
    let images = lines[..lines.len() - 1].iter().rev().map(|x| -x);
    let whole_lines: Vec<f64> = lines.iter().copied().chain(images).collect();
    let mut mesh = TMesh::new(&whole_lines, own.breaks(Axis::V)).map_err(|_| FitError::Singular)?;
    let count = 2 * own.grid_size()[0];
    let splits: Vec<Cell> = own.splits().collect();
    let image = |cell: &Cell| Cell { i: (count << cell.level) - 1 - cell.i, ..*cell };
    let images: Vec<Cell> = splits.iter().map(image).collect();
    for cells in [&splits, &images] {
        mesh.split_all(cells).map_err(|_| FitError::Singular)?;
    }
    let jets: BTreeMap<Vertex, &[f64]> = surface.jets().collect();
    let middle = own.last_vertex().i;
    let topology = Topology::new(&mesh);
    let mut all = Vec::with_capacity(12 * topology.basis.len());
    for &vertex in &topology.basis {
        let vertex = topology.vertices[vertex as usize];
        let own = Vertex { i: vertex.i.min(2 * middle - vertex.i), ..vertex };
        let jet = jets.get(&own).ok_or(FitError::Singular)?;
        // f, f_u, f_v, f_uv: what is odd in all vanishes in the plane, and changes its sign beyond it
        let mut rows: Vec<f64> = jet.to_vec();
        for (k, x) in rows.iter_mut().enumerate() {
            let is_odd = (k % 3 == 0) != ((k / 3) % 2 == 1);
            *x = match vertex.i.cmp(&middle) {
                std::cmp::Ordering::Equal if is_odd => 0.0,
                std::cmp::Ordering::Greater if is_odd => -*x,
                _ => *x,
            };
        }
        let (place, slopes) = rows.split_at_mut(3);
        half.unfold(place);
        slopes.chunks_exact_mut(3).for_each(|slope| half.turn(slope));
        all.extend(rows);
    }
    PhtSurface::new(3, false, mesh, &all).map_err(|_| FitError::Singular)
}
