//! What is saved comes back, and nothing else is taken for a surface.

use super::*;
use crate::curve::Curve;
use crate::knots::KnotVector;
use crate::surface::d1rc::{D1rcOptions, D1rcSurface};
use crate::surface::pht::{PhtSurface, TruncatedBasis};
use crate::surface::tensor::TensorSurface;
use crate::surface::tspline::TSplineSurface;
use crate::surface::{Domain, Region, Surface, Trims, Unit};
use crate::tmesh::{Cell, TMesh};
use glam::DVec2;

fn tensor() -> AnySurface {
    let knots_u = KnotVector::new(vec![0., 0., 0., 0.5, 1., 1., 1.], 2).unwrap();
    let knots_v = KnotVector::new(vec![-1., 0., 1., 2.], 1).unwrap();
    let points = (0..16).map(|k| f64::from(k).sqrt()).collect();
    let weights = (1..9).map(f64::from).collect();
    let mut surface = TensorSurface::new(2, knots_u, knots_v, points, Some(weights)).unwrap();
    let triangle = [(0.1, 0.1), (0.9, 0.1), (0.5, 0.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    let data = Domain { min: DVec2::splat(0.1), max: DVec2::splat(0.9) };
    let trims = Trims::new(vec![triangle], &surface.domain()).unwrap();
    *surface.region_mut() = Region { data_box: Some(data), trims, ..Region::default() };
    AnySurface::Tensor(surface)
}

fn tspline() -> AnySurface {
    let knots_v = KnotVector::new(vec![-1., 0., 1., 2., 2., 3., 4., 4.5, 5.], 3).unwrap();
    let curves = (0..5).map(|j| {
        let breaks: Vec<f64> = (0..=j + 1).map(|k| f64::from(k) / f64::from(j + 1)).collect();
        let knots = KnotVector::clamped(&breaks, 3).unwrap();
        let points = (0..2 * knots.basis_count()).map(|k| (k as f64 + f64::from(j)).sqrt()).collect();
        Curve::new(2, knots, points).unwrap()
    });
    let mut surface = TSplineSurface::new(knots_v, curves.collect()).unwrap();
    let triangle = [(0.1, 2.1), (0.9, 2.1), (0.5, 2.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    let trims = Trims::new(vec![triangle], &surface.domain()).unwrap();
    *surface.region_mut() = Region { data_box: Some(surface.domain()), trims, ..Region::default() };
    AnySurface::TSpline(surface)
}

fn pht() -> AnySurface {
    let cell = |level, i, j| Cell { level, i, j };
    let mut mesh = TMesh::new(&[0.0, 1.0, 3.0], &[0.0, 2.0]).unwrap();
    mesh.split_all(&[cell(0, 1, 0), cell(1, 2, 1)]).unwrap();
    let mut surface = PhtSurface::zero(1, true, mesh).unwrap();
    surface.set_jets(&[0, 3], &[0.5, 2.0, 0.1, 0.0, 0.2, 0.1, 0.3, 0.0].repeat(2)).unwrap();
    let triangle = [(0.1, 0.1), (0.9, 0.1), (0.5, 0.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    surface.region_mut().trims = Trims::new(vec![triangle], &surface.domain()).unwrap();
    AnySurface::Pht(surface)
}

fn smooth_pht() -> AnySurface {
    let mut mesh = TMesh::new(&[0.0, 1.0, 3.0], &[0.0, 2.0]).unwrap();
    mesh.split_all(&[Cell { level: 0, i: 1, j: 0 }, Cell { level: 1, i: 2, j: 1 }]).unwrap();
    let count = TruncatedBasis::new(&mesh).count();
    let points: Vec<f64> = (0..2 * count).map(|k| f64::from(k as u32).sqrt()).collect();
    let mut surface = PhtSurface::truncated(2, mesh, &points).unwrap();
    surface.split(&[Cell { level: 0, i: 0, j: 0 }]).unwrap();
    surface.region_mut().data_box = Some(surface.domain());
    AnySurface::Pht(surface)
}

fn d1rc() -> AnySurface {
    let (places, triangles) = crate::samples::grid([4, 4], 0.1, 1, |_| true);
    let points = places.iter().map(|p| p.extend(p.x * p.y)).collect();
    let mut mesh = crate::mesh::Mesh::new(points, triangles).unwrap();
    mesh.set_parameters(places).unwrap();
    let options = D1rcOptions::default().with_degree(2);
    let mut surface = D1rcSurface::from_mesh(&mesh, &options, &[[4, 5], [5, 6]], &[10]).unwrap();
    surface.region_mut().data_box = Some(surface.domain());
    AnySurface::D1rc(surface)
}

/// One of each family, with the bytes at which its counts and flags lie.
fn families() -> Vec<(AnySurface, std::ops::Range<usize>)> {
    vec![(tensor(), 24..88), (tspline(), 24..56), (pht(), 24..88), (smooth_pht(), 24..80), (d1rc(), 24..112)]
}

#[test]
fn a_surface_comes_back_to_the_bit() {
    for (surface, _) in families() {
        let bytes = save(surface.as_saved());
        assert_eq!(bytes.len(), save_size(surface.as_saved()));
        assert_eq!(load(&bytes).unwrap(), surface);
        assert_eq!(save(load(&bytes).unwrap().as_saved()), bytes);
    }
}

#[test]
fn every_flipped_bit_and_every_truncation_is_refused() {
    for (surface, _) in families() {
        let bytes = save(surface.as_saved());
        for byte in 0..bytes.len() {
            for bit in 0..8 {
                let mut flipped = bytes.clone();
                flipped[byte] ^= 1 << bit;
                let error = load(&flipped).unwrap_err();
                assert!(matches!(error, LoadError::Format { .. }), "byte {byte}: {error}");
            }
            assert!(matches!(load(&bytes[..byte]), Err(LoadError::Format { .. })), "{byte} bytes");
        }
    }
}

/// Writes a field and makes the checksum right again.
fn forge(surface: &AnySurface, at: usize, field: &[u8]) -> Vec<u8> {
    with_field(save(surface.as_saved()), at, field)
}

fn with_field(mut bytes: Vec<u8>, at: usize, field: &[u8]) -> Vec<u8> {
    bytes[at..at + field.len()].copy_from_slice(field);
    let end = bytes.len() - 8;
    let sum = crc32fast::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(&u64::from(sum).to_le_bytes());
    bytes
}

#[test]
fn forged_sizes_are_refused_before_memory_is_asked_for() {
    for (surface, sizes) in families() {
        for at in sizes.step_by(8) {
            for value in [u64::MAX, u64::MAX / 8, 1 << 40, 77] {
                let result = load(&forge(&surface, at, &value.to_le_bytes()));
                assert!(matches!(result, Err(LoadError::Format { .. })), "{value} at {at}: {result:?}");
            }
        }
    }
}

#[test]
fn later_versions_and_unknown_kinds_are_named() {
    let later = load(&forge(&tensor(), 8, &4u32.to_le_bytes()));
    assert_eq!(later.unwrap_err(), LoadError::Version { version: 4 });
    let unknown = load(&forge(&tensor(), 12, &77u32.to_le_bytes()));
    assert!(unknown.unwrap_err().to_string().contains("kind 77"));
}

fn curve() -> Curve {
    let knots = KnotVector::new(vec![0., 0., 0., 0.5, 1., 1., 1.], 2).unwrap();
    Curve::new(3, knots, (0..12).map(|k| f64::from(k).sqrt()).collect()).unwrap()
}

#[test]
fn a_curve_comes_back_to_the_bit_and_nothing_else_does() {
    let bytes = save(&curve());
    assert_eq!(bytes.len(), save_size(&curve()));
    assert_eq!(load_curve(&bytes).unwrap(), curve());
    for byte in 0..bytes.len() {
        for bit in 0..8 {
            let mut flipped = bytes.clone();
            flipped[byte] ^= 1 << bit;
            let error = load_curve(&flipped).unwrap_err();
            assert!(matches!(error, LoadError::Format { .. }), "byte {byte}: {error}");
        }
        assert!(matches!(load_curve(&bytes[..byte]), Err(LoadError::Format { .. })), "{byte} bytes");
    }
    for at in [24, 32, 40] {
        for value in [u64::MAX, u64::MAX / 8, 1 << 40, 77] {
            let result = load_curve(&with_field(bytes.clone(), at, &value.to_le_bytes()));
            assert!(matches!(result, Err(LoadError::Format { .. })), "{value} at {at}: {result:?}");
        }
    }
}

#[test]
fn curves_and_surfaces_are_not_taken_for_one_another() {
    assert!(load(&save(&curve())).unwrap_err().to_string().contains("a curve, not a surface"));
    let refused = load_curve(&save(tensor().as_saved())).unwrap_err();
    assert!(refused.to_string().contains("the kind is 0"), "{refused}");
}

#[test]
fn models_are_saved_to_the_bit_and_damage_is_refused() {
    use crate::model::of_parts;
    use crate::model::shapes::{circle, hollow_cube, pipe, rectangle, torus_piece, trimmed};
    let trimmed = trimmed(torus_piece(), vec![rectangle(0.1, 0.9), circle([0.5, 0.5], 0.2, 12)]);
    for model in [of_parts(&trimmed, vec![trimmed.clone()]).unwrap(), hollow_cube(false), pipe()] {
        let bytes = save(&model);
        assert_eq!(bytes.len(), save_size(&model));
        assert_eq!(load_model(&bytes).unwrap(), model);
        assert!(load(&bytes).is_err() && load_curve(&bytes).is_err());
        for at in (24..bytes.len() - 8).step_by(37) {
            let mut damaged = bytes[..bytes.len() - 8].to_vec();
            damaged[at] ^= 0x41;
            let sum = u64::from(crc32fast::hash(&damaged));
            damaged.extend(sum.to_le_bytes());
            if let Ok(loaded) = load_model(&damaged) {
                assert_ne!(loaded, model, "byte {at} does not matter");
            }
        }
    }
}

#[test]
fn name_and_unit_come_back() {
    for (name, unit) in [("", Unit::Inch), ("a", Unit::Millimetre), ("ein Flügel", Unit::Metre)] {
        let mut surface = tensor();
        surface.as_surface_mut().region_mut().label = Label { name: name.into(), unit };
        let saved = save(surface.as_saved());
        assert_eq!((saved.len(), saved.len() % 8), (save_size(surface.as_saved()), 0));
        let loaded = load(&saved).unwrap();
        assert_eq!(loaded.as_surface().region(), surface.as_surface().region());
    }
    // what is as it is by default is not told, and the label of a name is no surface's tail
    assert_eq!(save_size(tensor().as_saved()), save(tensor().as_saved()).len());
    let mut surface = tensor();
    surface.as_surface_mut().region_mut().label.name = "name".into();
    let mut saved = save(surface.as_saved());
    let end = saved.len() - 8;
    saved[end - 4] = 1; // behind the name
    let sum = u64::from(crc32fast::hash(&saved[..end]));
    saved[end..].copy_from_slice(&sum.to_le_bytes());
    assert_eq!(load(&saved).unwrap_err().kind(), ErrorKind::Format);
}
