//! D1RC fits of real meshes: what least squares gain over plain vertices, and that sharp edges stay.

mod common;

use planish::Control;
use planish::fit::d1rc::{D1rcFit, D1rcFitOptions, fit_mesh};
use planish::fit::errors::{DataErrors, data_errors};
use planish::fit::report::{StopReason, Tolerance};
use planish::mesh::{DecimateOptions, Decimation, Mesh, Piece};
use planish::surface::d1rc::D1rcSurface;
use std::collections::BTreeMap;

fn errors(surface: &D1rcSurface, mesh: &Mesh, fit: &D1rcFit) -> DataErrors {
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    data_errors(surface, &fit.parameters, &values, Control::default().pool())
}

/// The errors with the vertices of the control mesh as control points, at the parameters of the fit.
fn plain(mesh: &Mesh, fit: &D1rcFit) -> DataErrors {
    let options = fit.surface.space().recipe().options;
    errors(&D1rcSurface::from_mesh(&fit.control_mesh, &options, &fit.sharp_edges, &[]).unwrap(), mesh, fit)
}

#[test]
fn heads_have_half_the_error_of_plain_vertices() {
    for (name, control_count) in [("bust", 640), ("maxface_disk_4k.off", 1290)] {
        let Some(mesh) = common::mesh(name) else { continue };
        let options = D1rcFitOptions { control_count, ..D1rcFitOptions::default() };
        let fit = fit_mesh(&mesh, &options, &mut Control::default()).unwrap();
        assert_eq!(fit.surface.control_points().len(), 3 * control_count);
        let (report, plain) = (&fit.report, plain(&mesh, &fit));
        let relative = |error: f64| error / report.diagonal;
        eprintln!("{name}: {:.2e}, plain {:.2e}", relative(report.max_error), relative(plain.max));
        assert!(report.max_error <= 0.5 * plain.max, "{name}: {} against {}", report.max_error, plain.max);
        assert!(report.rms_error <= 0.5 * plain.rms, "{name}: {} against {}", report.rms_error, plain.rms);
    }
}

#[test]
fn a_control_mesh_from_elsewhere_serves_as_well() {
    let names = ["maxface_disk_4k.off", "mask_control_1290.off"];
    let [Some(fine), Some(coarse)] = names.map(common::mesh) else { return };
    let options = D1rcFitOptions { control_mesh: Some(&coarse), ..D1rcFitOptions::default() };
    let fit = fit_mesh(&fine, &options, &mut Control::default()).unwrap();
    let plain = plain(&fine, &fit);
    let relative = |error: f64| error / fit.report.diagonal;
    eprintln!("given: {:.2e}, plain {:.2e}", relative(fit.report.max_error), relative(plain.max));
    assert_eq!(fit.surface.space().recipe().triangles, coarse.triangles());
    // over the map of least stretch that the control mesh gets, 5.89e-3 of the diagonal against 1.10e-2
    assert!(fit.report.max_error <= 0.6 * plain.max, "{} against {}", fit.report.max_error, plain.max);
}

#[test]
fn heads_meet_their_tolerance() {
    for (name, values) in [("bust", [2e-2, 1e-2]), ("maxface_disk_4k.off", [1e-2, 3e-3])] {
        let Some(mesh) = common::mesh(name) else { continue };
        for value in values {
            let tolerance = Tolerance { value, ..Tolerance::default() };
            let options = D1rcFitOptions { tolerance, ..D1rcFitOptions::default() };
            let report = fit_mesh(&mesh, &options, &mut Control::default()).unwrap().report;
            eprintln!(
                "{name}, {value:e}: {} vertices after {} passes",
                report.coefficient_count, report.passes
            );
            assert_eq!(report.stop, StopReason::ToleranceMet, "{name}: {report:?}");
            assert!(report.max_error <= value * report.diagonal);
        }
    }
}

/// The two halves of a closed mesh that lie on the sides of a plane across an axis.
fn halves(mesh: &Mesh, axis: usize) -> Vec<Piece> {
    let middle = 0.5 * (mesh.bounds().min[axis] + mesh.bounds().max[axis]);
    let is_above = |t: u32| {
        let nodes = mesh.triangles()[t as usize];
        nodes.iter().map(|&node| mesh.points()[node as usize][axis]).sum::<f64>() > 3.0 * middle
    };
    let (above, below): (Vec<u32>, Vec<u32>) = (0..mesh.triangles().len() as u32).partition(|&t| is_above(t));
    [below, above].iter().map(|other| mesh.remove_triangles(other).unwrap()).collect()
}

/// How many sharp edges meet at each node that has some, and their length in all.
fn chains(mesh: &Mesh, edges: &[[u32; 2]]) -> (BTreeMap<u32, usize>, f64) {
    let mut degrees = BTreeMap::new();
    edges.iter().flatten().for_each(|&node| *degrees.entry(node).or_insert(0) += 1);
    let [from, to] = [0, 1].map(|k| move |edge: &[u32; 2]| mesh.points()[edge[k] as usize]);
    (degrees, edges.iter().map(|edge| from(edge).distance(to(edge))).sum())
}

#[test]
fn all_sharp_edges_of_pieces_of_parts_stay() {
    let angle = 40_f64.to_radians();
    for (name, target_count) in [("bracket", 300), ("fandisk_closed_6k.off", 900)] {
        let Some(whole) = common::mesh(name) else { continue };
        for axis in 0..3 {
            for Piece { mesh: piece, .. } in halves(&whole, axis) {
                let sharp = piece.sharp_edges(angle);
                let options =
                    DecimateOptions::default().with_sharp_edges(&sharp).with_target_count(target_count);
                let coarse = piece.decimate(&options, &mut Control::default()).unwrap();
                assert_sharp_edges_stay(&piece, &sharp, &coarse);
            }
        }
    }
}

/// Ends and junctions stay with all their chains, nothing else becomes one, and chains keep their length.
#[track_caller]
fn assert_sharp_edges_stay(piece: &Mesh, sharp: &[[u32; 2]], coarse: &Decimation) {
    let (before, long) = chains(piece, sharp);
    let (after, short) = chains(&coarse.piece.mesh, &coarse.sharp_edges);
    let number = |node: u32| coarse.piece.nodes.binary_search(&node).unwrap() as u32;
    let special = |degrees: &BTreeMap<u32, usize>| -> Vec<(u32, usize)> {
        degrees.iter().map(|(&node, &degree)| (node, degree)).filter(|&(_, degree)| degree != 2).collect()
    };
    let kept: Vec<(u32, usize)> =
        special(&before).into_iter().map(|(node, degree)| (number(node), degree)).collect();
    assert_eq!(kept, special(&after));
    // chains are polylines through their own nodes: not longer, and hardly shorter
    let roundoff = 1e-12 * long;
    assert!(short <= long + roundoff && short >= 0.98 * long, "{short} of {long} is left");
    eprintln!("{} sharp edges of length {long:.3}, {} of {short:.3}", sharp.len(), coarse.sharp_edges.len());
}

#[test]
fn a_fit_of_a_piece_of_fandisk_keeps_its_creases() {
    let Some(whole) = common::mesh("fandisk_closed_6k.off") else { return };
    let piece = &halves(&whole, 1)[1].mesh;
    assert!(piece.is_disk());
    let angle = 40_f64.to_radians();
    let fit = |sharp_angle| {
        let options = D1rcFitOptions { control_count: 900, sharp_angle, ..D1rcFitOptions::default() };
        fit_mesh(piece, &options, &mut Control::default()).unwrap()
    };
    let (sharp, smooth) = (fit(Some(angle)), fit(None));
    let (_, long) = chains(piece, &piece.sharp_edges(angle));
    let (_, short) = chains(&sharp.control_mesh, &sharp.sharp_edges);
    assert!(short <= long && short >= 0.98 * long, "{short} of {long} is left");
    let relative = |fit: &D1rcFit| {
        (fit.report.max_error / fit.report.diagonal, fit.report.rms_error / fit.report.diagonal)
    };
    eprintln!("sharp {:?}, smooth {:?}", relative(&sharp), relative(&smooth));
    assert!(sharp.report.rms_error <= 0.5 * smooth.report.rms_error);
}
