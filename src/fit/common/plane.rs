//! The map of a height field is chosen by what a fit over it costs, not by its stretch.
//!
//! A map that keeps lengths follows every bump, and the surface over it has to undo that: raw peaks, steep and over
//! 10,000 nodes, take 66,049 coefficients over their unrolled map and 1,089 over the coordinates of their plane. Of
//! cylinders the opposite holds. A coarse grid tells.

use super::error::FitError;
use super::report::Remarks;
use super::uniform::energy::Energy;
use super::uniform::grid::{Ends, UniformBasis, UniformGrid};
use super::uniform::normal_equations::{NormalEquations, Samples, TensorBasis};
use super::{Frame, NodeParameters};
use crate::control::{Control, Pool};
use crate::geometry::{Bounds, Domain};
use crate::mesh::Mesh;
use crate::parameterize::plane_coordinates;
use glam::DVec2;

/// Most knots of the coarse grid along one direction.
const KNOTS: usize = 17;
/// Fewest: on coarser grids every map is bad.
const LEAST_KNOTS: usize = 5;
/// Data for each of its unknowns: with fewer the errors at them would be none.
const DATA_PER_UNKNOWN: usize = 4;
/// Weight of the energy: so small that it determines what the data do not, and no more.
const SMOOTHING: f64 = 1e-6;
/// The plane is taken when the error over it is below this share of the other's. Near one, the map that keeps lengths
/// makes the more even surface.
const WORTH_TAKING: f64 = 0.8;
/// Errors below this share of the data's diagonal are no reason to choose: either map is good for any tolerance asked for.
const NEGLIGIBLE: f64 = 1e-6;

/// A map of the nodes, or the coordinates of the plane that the mesh is a height field over if a coarse fit is better over
/// these.
pub(in crate::fit) fn prefer_plane(
    mesh: &Mesh,
    mut map: NodeParameters,
    control: &mut Control,
) -> Result<NodeParameters, FitError> {
    let knots = (mesh.points().len() / DATA_PER_UNKNOWN).isqrt().min(KNOTS);
    let Some(plane) = (knots >= LEAST_KNOTS).then(|| plane_coordinates(mesh)).flatten() else {
        return Ok(map);
    };
    let costs = control.watch(|pool, _| [&map.uv, &plane].map(|uv| coarse_error(mesh, uv, knots, pool)))?;
    // of a map that cannot be fitted over nothing is known
    if let [Some(cost), Some(over_plane)] = costs
        && over_plane < WORTH_TAKING * cost
        && cost > NEGLIGIBLE
    {
        map.uv = plane;
        map.remarks.remove(Remarks::SEGMENTATION_ADVISED);
    }
    Ok(map)
}

/// The root of the mean square error at the nodes of a spline over equal cells, as a share of the diagonal.
fn coarse_error(mesh: &Mesh, uv: &[DVec2], knots: usize, pool: &Pool) -> Option<f64> {
    let nodes = || (0..uv.len()).filter(|&node| mesh.is_used(node as u32));
    let uv: Vec<DVec2> = nodes().map(|node| uv[node]).collect();
    let places: Vec<f64> = nodes().flat_map(|node| mesh.points()[node].to_array()).collect();
    let values = Frame::new(&Bounds::of_rows(&places, 3)).inward(&places);
    let domain = Domain::around(uv.iter().copied());
    let [u, v] = [(domain.min.x, domain.max.x), (domain.min.y, domain.max.y)]
        .map(|(min, max)| UniformBasis { grid: UniformGrid::over(min, max, 0.0, knots), ends: Ends::Free });
    let basis = TensorBasis { u, v };
    let samples = Samples { uv: &uv, values: &values, dim: 3, weights: None };
    let equations = NormalEquations::assemble(basis, &samples, pool);
    let energy = Energy::Plate.terms(&u, &v);
    let factor = equations.factor(&equations.analyse(), SMOOTHING / 12.0, &energy).ok()?;
    let unknowns = equations.solve(&factor, &[]);
    let sum: f64 =
        uv.iter().zip(values.chunks_exact(3)).map(|(&uv, value)| basis.error_sq(uv, value, &unknowns)).sum();
    Some((sum / uv.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::common::{Regularize, node_parameters};
    use crate::parameterize::{ParameterizeOptions, parameterize};
    use crate::samples;
    use glam::DVec3;

    /// MATLAB's peaks over x and y from -3 to 3.
    fn peaks(count: usize) -> Mesh {
        let (places, triangles) = samples::grid([count, count], 0.0, 1, |_| true);
        let point = |p: &DVec2| {
            let (x, y) = (6.0 * p.x - 3.0, 6.0 * p.y - 3.0);
            let z = 3.0 * (1.0 - x).powi(2) * (-x * x - (y + 1.0).powi(2)).exp()
                - 10.0 * (x / 5.0 - x.powi(3) - y.powi(5)) * (-x * x - y * y).exp()
                - (-(x + 1.0).powi(2) - y * y).exp() / 3.0;
            DVec3::new(x, y, z)
        };
        Mesh::new(places.iter().map(point).collect(), triangles).unwrap()
    }

    fn chosen(mesh: &Mesh) -> Vec<DVec2> {
        let options = ParameterizeOptions::TENSOR;
        node_parameters(mesh, &options, Regularize::Auto, &mut Control::new(1)).unwrap().uv
    }

    #[test]
    fn steep_peaks_are_fitted_over_their_plane_and_deep_pipes_unrolled() {
        let mesh = peaks(50);
        assert_eq!(chosen(&mesh), plane_coordinates(&mesh).unwrap());
        // nearly half a pipe: upright along both sides, seen from above
        let (places, triangles) = samples::grid([40, 40], 0.0, 1, |_| true);
        let bent = |p: &DVec2| {
            let angle = 3.0 * (p.x - 0.5);
            DVec3::new(angle.sin(), p.y, angle.cos())
        };
        let pipe = Mesh::new(places.iter().map(bent).collect(), triangles).unwrap();
        assert!(plane_coordinates(&pipe).is_some());
        let least_stretched = parameterize(&pipe, &ParameterizeOptions::TENSOR, &mut Control::new(1));
        assert_eq!(chosen(&pipe), least_stretched.unwrap().uv);
    }
}
