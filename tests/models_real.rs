//! Models of real meshes: nodes within the tolerance, smooth to rounding, watertight, the volume of the mesh.
//!
//! Skips, and says so, where the shared meshes are not at hand; seeded shapes are in the module's own tests.

mod common;

use planish::Control;
use planish::fit::model::{MeshModelOptions, fit_mesh};

#[test]
fn real_meshes_become_solids_within_the_tolerance() {
    for name in ["hammer_closed_30k.ply", "rockerarm_genus1_10k.off"] {
        let Some(mesh) = common::mesh(name) else { continue };
        let fit = fit_mesh(&mesh, &MeshModelOptions::default(), &mut Control::new(2)).expect(name);
        let report = &fit.report;
        eprintln!(
            "{name:28} {} patches, {} control points, nodes {:.2e}, model to mesh {:.2e}, jump {:.1e}",
            report.patches.len(),
            report.coefficient_count,
            report.max_error / report.diagonal,
            report.max_back_distance / report.diagonal,
            report.normal_jump
        );
        assert!(report.max_error <= report.tolerance, "{name}: {}", report.max_error);
        assert!(report.normal_jump <= 1e-10, "{name}: {}", report.normal_jump);
        assert!(report.gap <= 1e-14 * report.diagonal, "{name}: {}", report.gap);
        assert!((report.volume / report.mesh_volume - 1.0).abs() <= 1e-3, "{name}: {}", report.volume);
        assert_eq!(fit.model.free_edge_count(), 0, "{name}");
        assert_eq!(fit.components[0].genus, mesh.genus(), "{name}");
    }
}
