//! A node of a hundred thousand neighbours, as cone tips and cap fans of STL files have them.

use planish::Control;
use planish::fit::tensor::{TensorOptions, fit_mesh};
use planish::mesh::{DecimateOptions, Format, Mesh, MeshOptions, read_bytes};
use planish::parameterize::{ParameterizeOptions, parameterize};
use std::fmt::Write;

const COUNT: u32 = 100_000;

/// A cone of height 0.3 over the unit disk as OBJ, its tip first.
fn cone() -> String {
    let mut text = String::from("v 0 0 0.3\n");
    for k in 0..COUNT {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(COUNT)).sin_cos();
        writeln!(text, "v {cos} {sin} 0").unwrap();
    }
    for k in 0..COUNT {
        writeln!(text, "f 1 {} {}", k + 2, (k + 1) % COUNT + 2).unwrap();
    }
    text
}

#[test]
fn a_node_of_a_hundred_thousand_neighbours_is_no_obstacle() {
    let mut control = Control::new(2);
    let (mesh, _): (Mesh, _) = read_bytes(cone().as_bytes(), Format::Obj, &MeshOptions::default()).unwrap();
    assert_eq!((mesh.points().len(), mesh.triangles().len()), (COUNT as usize + 1, COUNT as usize));
    let map = parameterize(&mesh, &ParameterizeOptions::TENSOR, &mut control).unwrap();
    assert_eq!(map.uv.len(), mesh.points().len());
    let coarse = mesh.decimate(&DecimateOptions::default(), &mut control).unwrap();
    assert!(coarse.piece.mesh.points().len() < mesh.points().len() / 10);
    let mut mapped = mesh.clone();
    mapped.set_parameters(mesh.points().iter().map(|p| p.truncate()).collect()).unwrap();
    let fit = fit_mesh(&mapped, &TensorOptions::default(), &mut control).unwrap();
    assert!(fit.report.max_error <= 1e-3 * fit.report.diagonal, "{}", fit.report.max_error);
}
