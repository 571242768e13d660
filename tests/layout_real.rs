//! Layouts of real meshes: patches and energies of a prototype, and no folds.
//!
//! Skips, and says so, where the shared meshes are not at hand; seeded shapes are in the module's own tests.

mod common;

use planish::Control;
use planish::layout::Side;
use planish::layout::of_mesh::{LayoutKind, MeshLayoutOptions, layout_of_mesh};

#[test]
fn base_complexes_of_real_meshes_are_as_good_as_measured() {
    // patches asked for, most that may be there, energy allowed
    for (name, patches, energy) in
        [("rockerarm_genus1_10k.off", 40, 4.8), ("fandisk_closed_6k.off", 38, 5.05)]
    {
        let Some(mesh) = common::mesh(name) else { continue };
        let options = MeshLayoutOptions::default().with_kind(LayoutKind::Complex).with_patches(patches);
        let made = layout_of_mesh(&mesh, &options, &mut Control::new(2)).expect(name);
        let report = made.report;
        eprintln!("{name:28} {} patches, {report:?}", made.layout.quads().len());
        assert_eq!(made.layout.quads().len() + report.doublets, patches, "{name}");
        assert_eq!(made.layout.genus(), Some(mesh.genus()), "{name}");
        assert_eq!((report.folded_nodes, report.spread_nodes), (0, 0), "{name}");
        assert!(report.energy <= energy, "{name}: energy {}, allowed {energy}", report.energy);
    }
}

#[test]
fn open_meshes_get_layouts_with_borders() {
    for (name, energy) in
        [("maxface_disk_4k.off", 4.6), ("mannequin_disk_13k.off", 5.0), ("camelhead_disk_11k.off", 5.1)]
    {
        let Some(mesh) = common::mesh(name) else { continue };
        let made = layout_of_mesh(&mesh, &MeshLayoutOptions::default(), &mut Control::new(2)).expect(name);
        let report = made.report;
        eprintln!("{name:28} {} patches, {report:?}", made.layout.quads().len());
        assert_eq!(made.layout.euler_characteristic(), mesh.euler_characteristic(), "{name}");
        assert_eq!((report.folded_nodes, report.spread_nodes), (0, 0), "{name}");
        assert!(report.energy <= energy, "{name}: energy {}, allowed {energy}", report.energy);
        for &node in mesh.loops().iter().flatten() {
            let place = made.map.place(node).expect("a node of a loop has triangles");
            let is_on = |side: u8| {
                let side = Side { quad: place.quad, side };
                made.layout.opposite(side).is_none() && side.coordinates(place.uv)[1] == 0.0
            };
            assert!((0..4).any(is_on), "{name}: node {node} at {place:?}");
        }
    }
}

#[test]
fn spheres_become_cubes() {
    for name in ["igea_closed_45k.ply", "hammer_closed_30k.ply"] {
        let Some(mesh) = common::mesh(name) else { continue };
        let made = layout_of_mesh(&mesh, &MeshLayoutOptions::default(), &mut Control::new(2)).expect(name);
        assert_eq!((made.report.kind, made.layout.quads().len()), (LayoutKind::Cube, 6));
        assert_eq!((made.report.folded_nodes, made.report.spread_nodes), (0, 0), "{name}");
        assert!(made.map.places().iter().all(Option::is_some), "{name}");
    }
}
