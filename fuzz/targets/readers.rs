//! Mesh files of any content: no panic, no more memory than the bytes can mean, and what was read is a mesh that is
//! written and read back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use planish::export::mesh::{Encoding, bytes};
use planish::mesh::{Components, Format, MeshOptions, Repair, read_bytes};

const FORMATS: [Format; 4] = [Format::Off, Format::Obj, Format::Ply, Format::Stl];

fuzz_target!(|data: &[u8]| {
    let [choice, repair, content @ ..] = data else { return };
    let format = FORMATS[usize::from(choice % 4)];
    let options = MeshOptions {
        weld_distance: if choice & 4 == 0 { 0.0 } else { 0.25 },
        repair: Repair::from_bits(u32::from(repair % 64)).unwrap_or_default(),
        components: if choice & 8 == 0 { Components::All } else { Components::Largest },
        max_memory: 1 << 20,
        ..MeshOptions::default()
    };
    let named = if choice & 16 == 0 { Some(format) } else { None };
    let Ok((mesh, _)) = read_bytes(content, named, &options) else { return };
    assert_eq!(mesh.node_origins().len(), mesh.points().len());
    let is_touching = !mesh.pinched_nodes().is_empty();
    assert!(!(is_touching && options.repair.has(Repair::TOUCHING_NODES)));
    for written in [Format::Off, Format::Obj, Format::Ply] {
        for encoding in [Encoding::Binary, Encoding::Text] {
            let (again, _) = read_bytes(&bytes(&mesh, written, encoding), written, &MeshOptions::default())
                .expect("what was written is a mesh");
            assert_eq!(again.triangles().len(), mesh.triangles().len());
        }
    }
});
