use super::*;
use crate::failure::Classify;
use crate::layout::of_mesh::layout_of_mesh;
use crate::mesh::Mesh;
use crate::parameterize::sphere::SphereError;
use crate::samples;

fn complex(mesh: &Mesh, patches: usize) -> MeshLayout {
    let options = MeshLayoutOptions::default().with_kind(LayoutKind::Complex).with_patches(patches);
    layout_of_mesh(mesh, &options, &mut Control::new(2)).unwrap()
}

/// What holds of every layout made for a mesh.
#[track_caller]
fn assert_sound(mesh: &Mesh, made: &MeshLayout) {
    assert_eq!(made.layout.euler_characteristic(), mesh.euler_characteristic());
    assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0), "{:?}", made.report);
    let is_closed = made.layout.edges().iter().all(|edge| edge.second.is_some());
    assert_eq!(is_closed, mesh.loops().is_empty());
    assert_eq!(made.map.places().len(), mesh.points().len());
    for (node, place) in (0..).zip(made.map.places()) {
        let Some(place) = place else { panic!("node {node} has no place") };
        assert!((place.quad as usize) < made.layout.quads().len());
        assert!(place.uv.cmpge(DVec2::ZERO).all() && place.uv.cmple(DVec2::ONE).all());
    }
    // a map on to the layout, one to one: the areas of images inside one quad stay below the quad's
    let mut covered = vec![0.0; made.layout.quads().len()];
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| made.map.place(node).unwrap());
        if a.quad == b.quad && b.quad == c.quad {
            let double_area = (b.uv - a.uv).perp_dot(c.uv - a.uv);
            assert!(double_area > 0.0, "triangle {triangle:?} is turned over");
            covered[a.quad as usize] += 0.5 * double_area;
        }
    }
    assert!(covered.iter().all(|&area| area <= 1.0 + 1e-9), "{covered:?}");
}

#[test]
fn every_genus_has_a_layout() {
    for (mesh, patches, most) in [
        (samples::ball(2000, 1), 20, 5.5),
        (samples::handles(1, 2000, 2), 30, 6.0),
        (samples::handles(2, 4000, 3), 40, 6.5),
        (samples::handles(3, 6000, 4), 60, 6.5),
        (samples::holed_block(5, 8000, 5), 80, 7.0),
    ] {
        let mesh = mesh.unwrap();
        let made = complex(&mesh, patches);
        eprintln!("genus {}: {} patches, {:?}", mesh.genus(), made.layout.quads().len(), made.report);
        assert_sound(&mesh, &made);
        assert_eq!(made.layout.quads().len() + made.report.doublets, patches);
        assert!(made.report.energy < most, "{:?}", made.report);
    }
}

/// Around some nodes of this mesh the least determinant has a ridge along which it grows by rounding alone.
#[test]
fn the_search_for_a_place_without_folds_ends() {
    let (_, mesh) = samples::closed::seeded_block(85).unwrap();
    let made = complex(&mesh, 40);
    assert_eq!(made.layout.euler_characteristic(), mesh.euler_characteristic());
}

#[test]
fn limbs_lose_their_doublets() {
    let mesh = samples::starfish(4000, 6).unwrap();
    let made = complex(&mesh, 60);
    eprintln!("{} patches, {:?}", made.layout.quads().len(), made.report);
    assert_eq!(made.layout.euler_characteristic(), 2);
    assert!((0..made.layout.vertex_count() as u32).all(|vertex| made.layout.valence(vertex) >= 3));
    assert_eq!(made.layout.quads().len() + made.report.doublets, 60);
    // thin limbs may leave a few stars over quads without a common vertex, which the report tells
    assert_eq!(made.report.folded_nodes, 0, "{:?}", made.report);
    assert!(made.report.spread_nodes <= 8, "{:?}", made.report);
}

#[test]
fn the_bits_do_not_depend_on_the_threads() {
    let mesh = samples::handles(1, 3000, 7).unwrap();
    let options = MeshLayoutOptions::default().with_sweeps(30);
    let [one, three] =
        [1, 3].map(|threads| layout_of_mesh(&mesh, &options, &mut Control::new(threads)).unwrap());
    assert_eq!((one.layout, one.map), (three.layout, three.map));
}

#[test]
fn genus_0_becomes_a_cube() {
    let mesh = samples::ball(1500, 8).unwrap();
    let made = layout_of_mesh(&mesh, &MeshLayoutOptions::default(), &mut Control::new(2)).unwrap();
    assert_eq!(made.report.kind, LayoutKind::Cube);
    assert_eq!(made.layout, Layout::cube());
    assert_sound(&mesh, &made);
}

#[test]
fn refusals_name_the_offender() {
    let refuse = |mesh: &Mesh, options: MeshLayoutOptions| {
        layout_of_mesh(mesh, &options, &mut Control::new(1)).unwrap_err()
    };
    let options = MeshLayoutOptions::default();
    let open = refuse(&samples::planar(1).unwrap(), options.with_kind(LayoutKind::Cube));
    assert!(matches!(open, MeshLayoutError::Sphere(SphereError::Open { loops: 3, .. })), "{open}");
    let torus = samples::handles(1, 500, 1).unwrap();
    let cube = refuse(&torus, options.with_kind(LayoutKind::Cube));
    assert_eq!(cube.to_string(), "the mesh has genus 1, a sphere has 0; use a layout of patches instead");
    let few = refuse(&torus, options.with_patches(5));
    assert_eq!(few, MeshLayoutError::Patches { given: 5, least: 6, most: 1060 });
    assert_eq!(few.kind(), crate::failure::ErrorKind::InvalidArgument);
}

#[test]
fn a_listener_cancels_every_stage() {
    let mesh = samples::handles(1, 3000, 9).unwrap();
    for stop_at in [0.1, 0.35] {
        let mut stop = |fraction: f64, _: f64| match fraction >= stop_at {
            true => std::ops::ControlFlow::Break(()),
            false => std::ops::ControlFlow::Continue(()),
        };
        let mut control = Control::new(1).with_progress(&mut stop);
        let made = layout_of_mesh(&mesh, &MeshLayoutOptions::default(), &mut control);
        assert_eq!(made.err().map(|error| error.kind()), Some(crate::failure::ErrorKind::Cancelled));
    }
}
