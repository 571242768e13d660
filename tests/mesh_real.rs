//! Mesh files: real ones have the topology of their table, and samples come back from a file as they went in.

mod common;

use planish::export::mesh::{Encoding, write};
use planish::mesh::{Format, Mesh, MeshOptions, MeshRepairs, read};
use std::path::Path;

fn mesh(path: &Path) -> (Mesh, MeshRepairs) {
    read(path, &MeshOptions::default()).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn samples_come_back_as_they_were_written() {
    for name in ["bust", "bracket", "rocker", "limb"] {
        let Some(sample) = common::mesh(name) else { continue };
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.obj"));
        write(&sample, &path, Format::Obj, Encoding::Text).unwrap();
        let (back, repairs) = mesh(&path);
        assert!(repairs.is_empty(), "{name}: {repairs:?}");
        assert_eq!((back.points(), back.triangles()), (sample.points(), sample.triangles()), "{name}");
    }
}

#[test]
fn real_meshes_have_the_topology_of_their_table() {
    // nodes, triangles, genus, nodes of each loop
    let table: [(&str, usize, usize, usize, &[usize]); 15] = [
        ("igea_closed_134k.ply", 134345, 268686, 0, &[]),
        ("igea_closed_45k.ply", 44992, 89980, 0, &[]),
        ("igea_disk_43k.ply", 43076, 86012, 0, &[138]),
        ("mannequin_disk_13k.off", 12977, 25888, 0, &[64]),
        ("camelhead_disk_11k.off", 11381, 22704, 0, &[56]),
        ("maxface_disk_4k.off", 4486, 8743, 0, &[227]),
        ("mask_control_1290.off", 1290, 2449, 0, &[129]),
        ("fandisk_closed_6k.off", 6475, 12946, 0, &[]),
        ("rockerarm_genus1_10k.off", 10044, 20088, 1, &[]),
        ("neon_side_holes_16k.off", 15896, 30376, 0, &[40, 310, 326, 744]),
        ("airplane_holes_8k.off", 8519, 16747, 0, &[12; 27]),
        ("hammer_closed_30k.ply", 30082, 60160, 0, &[]),
        ("bullet_closed_14k.ply", 13878, 27752, 0, &[]),
        ("brain_pial_10k_fields.ply", 10242, 20480, 0, &[]),
        ("blow_shell_displacement.ply", 511, 928, 0, &[92]),
    ];
    for (name, point_count, triangle_count, genus, loops) in table {
        let Some(path) = common::shared_data(name) else { continue };
        let (mesh, repairs) = mesh(&path);
        assert_eq!((mesh.points().len(), mesh.triangles().len()), (point_count, triangle_count), "{name}");
        assert_eq!((mesh.component_count(), mesh.genus()), (1, genus), "{name}");
        assert_eq!(mesh.loops().len(), loops.len(), "{name}");
        assert!(
            repairs.is_empty() && mesh.unused_nodes().is_empty() && mesh.pinched_nodes().is_empty(),
            "{name}"
        );
        if loops.len() < 27 {
            let mut sizes: Vec<usize> = mesh.loops().iter().map(Vec::len).collect();
            sizes.sort_unstable();
            assert_eq!(sizes, loops, "{name}");
        }
    }
}

#[test]
fn fields_and_parameters_come_with_the_files_that_have_them() {
    if let Some(path) = common::shared_data("brain_pial_10k_fields.ply") {
        let (brain, _) = mesh(&path);
        assert!(["sulc", "thickness", "curv"].iter().all(|name| brain.field(name).is_some()));
    }
    if let Some(path) = common::shared_data("synthetic/fuselage.obj") {
        let (panel, repairs) = mesh(&path);
        assert!(panel.parameters().is_some() && panel.is_disk() && repairs.is_empty());
    }
}
