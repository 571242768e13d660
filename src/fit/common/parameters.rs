//! Where the nodes of a mesh get their (u,v) from.

use super::error::FitError;
use super::plane::prefer_plane;
use super::report::Remarks;
use crate::control::Control;
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::parameterize::{
    Border, ParameterizeError, ParameterizeOptions, ParameterizeReport, RegularizeOptions, parameterize,
    regularize,
};
use crate::surface::Trims;
use glam::DVec2;

/// What to do with parameters that came with a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Regularize {
    /// Even them out if they are uneven and it helps.
    #[default]
    Auto,
    /// Take them as they are.
    Never,
    /// Even them out.
    Always,
}

/// The parameters of the nodes, and how they came about.
#[derive(Debug)]
pub(in crate::fit) struct NodeParameters {
    pub uv: Vec<DVec2>,
    pub remarks: Remarks,
}

pub(in crate::fit) fn node_parameters(
    mesh: &Mesh,
    options: &ParameterizeOptions,
    when: Regularize,
    control: &mut Control,
) -> Result<NodeParameters, FitError> {
    let mut remarks = Remarks::default();
    let Some(given) = mesh.parameters() else {
        let map = control.without_error(|control| parameterize(mesh, options, control))?;
        remarks.add_if(true, Remarks::PARAMETERIZED);
        remarks.add_if(has_high_stretch(&map.report), Remarks::SEGMENTATION_ADVISED);
        let map = NodeParameters { uv: map.uv, remarks };
        let is_choice = options.border == Border::Auto && options.unroll;
        return if is_choice { prefer_plane(mesh, map, control) } else { Ok(map) };
    };
    let choice = match when {
        Regularize::Never => return Ok(NodeParameters { uv: memory::copied(given), remarks }),
        Regularize::Auto => crate::parameterize::RegularizeWhen::Auto,
        Regularize::Always => crate::parameterize::RegularizeWhen::Always,
    };
    // a mesh that is no disk keeps what was given: only regularizing needs its connectivity
    match regularize(mesh, &RegularizeOptions::default().with_when(choice), control) {
        Ok(map) => {
            remarks.add_if(map.report.replaced, Remarks::REGULARIZED);
            Ok(NodeParameters { uv: map.uv, remarks })
        }
        Err(ParameterizeError::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(error) if when == Regularize::Always => Err(error.into()),
        Err(_) => Ok(NodeParameters { uv: memory::copied(given), remarks }),
    }
}

fn has_high_stretch(report: &ParameterizeReport) -> bool {
    report.remarks.contains(crate::parameterize::Remarks::HIGH_STRETCH)
}

/// The boundary loops of a mesh in the parameter plane.
pub(in crate::fit) fn trims(mesh: Option<&Mesh>, uv: &[DVec2], domain: &Domain) -> Trims {
    let loops = mesh.map_or(&[][..], |mesh| mesh.loops());
    let loops = loops.iter().map(|nodes| nodes.iter().map(|&n| uv[n as usize]).collect_vec());
    // parameters of data lie in the domain, and loops have three nodes at least
    Trims::new(loops.collect_vec(), domain).unwrap_or_default()
}
