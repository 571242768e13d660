//! D1RC-splines over real control meshes and our own maps of them: the functions sum to one and keep the plane.

mod common;

use glam::DVec2;
use planish::Control;
use planish::mesh::Mesh;
use planish::parameterize::{ParameterizeOptions, parameterize};
use planish::samples::Random;
use planish::surface::Surface;
use planish::surface::d1rc::{Boundary, D1rcOptions, D1rcSurface, Recipe, Space, sharp_edges};

/// The mesh with our map; None, and a line that says so, where the file is absent.
fn mapped(name: &str) -> Option<Mesh> {
    let mut mesh = common::mesh(name)?;
    let map = parameterize(&mesh, &ParameterizeOptions::default(), &mut Control::default()).unwrap();
    mesh.set_parameters(map.uv).unwrap();
    Some(mesh)
}

/// The (u,v) of a mesh as control points over themselves.
fn plane(mesh: &Mesh, options: D1rcOptions, sharp: &[[u32; 2]]) -> D1rcSurface {
    let uv = mesh.parameters().unwrap().to_vec();
    let points = uv.iter().flat_map(|p| p.to_array()).collect();
    let triangles = mesh.triangles().to_vec();
    let recipe = Recipe { uv, triangles, options, sharp_edges: sharp.to_vec(), corners: Vec::new() };
    D1rcSurface::new(Space::new(recipe).unwrap(), 2, points).unwrap()
}

#[test]
fn real_control_meshes_keep_the_plane() {
    for name in ["bust", "limb", "mask_control_1290.off", "maxface_disk_4k.off"] {
        let Some(mesh) = mapped(name) else { continue };
        let sharp = sharp_edges(&mesh, 40_f64.to_radians()).unwrap();
        for (degree, boundary, sharp) in [
            (2, Boundary::Phantom, &[][..]),
            (3, Boundary::Phantom, &[]),
            (3, Boundary::Clamped, &[]),
            (3, Boundary::Phantom, &sharp),
        ] {
            let options = D1rcOptions::default().with_degree(degree).with_boundary(boundary);
            let surface = plane(&mesh, options, sharp);
            let scale = surface.domain().size().length();
            let mut random = Random::new(3);
            for triangle in mesh.triangles() {
                let [a, b, c] = triangle.map(|vertex| mesh.parameters().unwrap()[vertex as usize]);
                let (s, t) = (random.unit(), random.unit());
                for uv in [a, a + (s * (b - a) + t * (c - a)) / 2.0] {
                    let shares = surface.space().shares(uv).unwrap();
                    let sum: f64 = shares.iter().map(|share| share.1).sum();
                    let mut at = [0.0; 2];
                    surface.eval_rows(&[uv], 0, &mut at);
                    let off = (DVec2::from(at) - uv).length() / scale;
                    let what =
                        format!("{name}, degree {degree}, {boundary:?}, {} sharp at {uv}", sharp.len());
                    assert!((sum - 1.0).abs() < 1e-13, "{what}: {sum}");
                    assert!(off < 1e-13, "{what}: {off:e}");
                    assert!(shares.iter().all(|share| share.1 > -1e-13), "{what}");
                }
            }
        }
    }
}
