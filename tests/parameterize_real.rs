//! Real disk meshes: no map folds, and each stretches as `theory/parameterization.md` 8 has it.
//!
//! Skips, and says so, where the shared meshes are not at hand.

use glam::DVec3;
use planish::Control;
use planish::mesh::Mesh;
use planish::parameterize::{Border, ParameterizeOptions, ParameterizeReport, parameterize};
use std::path::{Path, PathBuf};

fn shared_data() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if !folder.is_dir() {
        eprintln!("SKIPPED: no {}", folder.display());
        return None;
    }
    Some(folder)
}

fn load(path: &Path) -> Mesh {
    let bytes = std::fs::read(path).unwrap();
    if path.extension().unwrap() == "off" { load_off(&bytes) } else { load_ply(&bytes) }
}

fn load_off(bytes: &[u8]) -> Mesh {
    let text = std::str::from_utf8(bytes).unwrap();
    let mut words = text.lines().filter(|l| !l.starts_with('#')).flat_map(|l| l.split_whitespace()).skip(1);
    let mut next = || words.next().unwrap().parse::<f64>().unwrap();
    let (n, t, _) = (next() as usize, next() as usize, next());
    let points = (0..n).map(|_| DVec3::new(next(), next(), next())).collect();
    let triangles = (0..t)
        .map(|_| {
            next();
            [next() as u32, next() as u32, next() as u32]
        })
        .collect();
    Mesh::new(points, triangles).unwrap()
}

fn load_ply(bytes: &[u8]) -> Mesh {
    let end = bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let count = |name: &str| -> usize {
        let line = header.lines().find(|l| l.starts_with(&format!("element {name} "))).unwrap();
        line.split_whitespace().last().unwrap().parse().unwrap()
    };
    let floats = header.lines().filter(|l| l.starts_with("property float")).count();
    let (n, t) = (count("vertex"), count("face"));
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as f64;
    let int = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let points = (0..n)
        .map(|i| end + 4 * floats * i)
        .map(|at| DVec3::new(float(at), float(at + 4), float(at + 8)))
        .collect();
    let faces = end + 4 * floats * n;
    let triangles =
        (0..t).map(|i| faces + 13 * i + 1).map(|at| [int(at), int(at + 4), int(at + 8)]).collect();
    Mesh::new(points, triangles).unwrap()
}

#[test]
fn table() {
    let Some(folder) = shared_data() else { return };
    for name in [
        "blow_shell_displacement.ply",
        "maxface_disk_4k.off",
        "neon_side_holes_16k.off",
        "camelhead_disk_11k.off",
        "mannequin_disk_13k.off",
        "airplane_holes_8k.off",
        "igea_disk_43k.ply",
    ] {
        let mesh = load(&folder.join(name));
        let o = ParameterizeOptions::TENSOR;
        for (label, options) in [
            ("mv turns", ParameterizeOptions::MEAN_VALUE.with_border(Border::SquareByTurns)),
            ("mv circle", ParameterizeOptions::MEAN_VALUE.with_border(Border::Circle)),
            ("harm circle", ParameterizeOptions::HARMONIC.with_border(Border::Circle)),
            ("arc", o.with_border(Border::SquareByArc)),
            ("turns", o.with_border(Border::SquareByTurns)),
            ("circle", o.with_border(Border::Circle)),
            ("pht auto", ParameterizeOptions::PHT),
        ] {
            let r = parameterize(&mesh, &options, &mut Control::new(2));
            match r {
                Ok(p) => {
                    let r: ParameterizeReport = p.report;
                    eprintln!(
                        "{name:28} {label:12} {:.4e} {:.4e} {:.3e}  flips {} degen {} solves {} steps {} {:.3}s {:?} {:#b}",
                        r.stretch.l2,
                        r.stretch.max,
                        r.stretch.area_ratio,
                        r.flipped_triangles,
                        r.degenerate_triangles,
                        r.solves,
                        r.steps,
                        r.seconds,
                        r.border,
                        r.remarks.bits()
                    )
                }
                Err(e) => eprintln!("{name} {label} {e}"),
            }
        }
    }
}
