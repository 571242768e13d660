//! Batches of points on faces: see [`surface::evaluate`](crate::surface::evaluate) for quantities, rules and flags.

use super::{Carrier, FaceId, Model};
use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::surface::evaluate::{EvalError, Output, OutsideRule, Points, Quantity, evaluate};
use crate::surface::{curvatures, derivative_rows, normal};
use glam::{DVec2, DVec3};

/// Points on faces cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelEvalError {
    /// There is no such face.
    #[error("point {index} is on face {face}, there are {count}")]
    NoFace {
        /// The point.
        index: usize,
        /// Its face.
        face: u32,
        /// Faces of the model.
        count: usize,
    },
    /// The points of a face cannot be evaluated.
    #[error(transparent)]
    Eval(#[from] EvalError),
}

impl Classify for ModelEvalError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NoFace { .. } => ErrorKind::Index,
            Self::Eval(error) => error.kind(),
        }
    }

    fn index(&self) -> Option<usize> {
        match self {
            Self::NoFace { index, .. } => Some(*index),
            Self::Eval(error) => error.index(),
        }
    }
}

/// What was computed at points.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelValues {
    /// A row for each point.
    pub rows: Vec<f64>,
    /// The `FLAG_` bits of each point.
    pub flags: Vec<u8>,
    /// How many points lie outside the domains of their surfaces.
    pub outside: usize,
}

impl Model {
    /// Evaluates `quantity` at parameters `uv` on the surfaces of `faces`. Normals point out of the front of the face,
    /// and curvatures are positive where it bends towards them.
    pub fn evaluate(
        &self,
        quantity: Quantity,
        faces: &[u32],
        uv: &[DVec2],
        rule: OutsideRule,
        pool: &Pool,
    ) -> Result<ModelValues, ModelEvalError> {
        let width = quantity.width(3);
        let mut values =
            ModelValues { rows: vec![0.0; width * uv.len()], flags: vec![0; uv.len()], outside: 0 };
        for group in by_face(faces, self.faces().len())? {
            let face = FaceId(faces[group[0]]);
            let places: Vec<DVec2> = group.iter().map(|&index| uv[index]).collect();
            let mut rows = vec![0.0; width * group.len()];
            let mut flags = vec![0; group.len()];
            let output = Output { rows: &mut rows, stride: width, flags: &mut flags };
            values.outside += self
                .evaluate_on(face, quantity, &places, rule, output, pool)
                .map_err(|error| of_all(error, &group))?;
            if !self.face(face).is_forward {
                rows.chunks_exact_mut(width).for_each(|row| turn(quantity, row));
            }
            for ((&index, row), flag) in group.iter().zip(rows.chunks_exact(width)).zip(flags) {
                values.rows[width * index..][..width].copy_from_slice(row);
                values.flags[index] = flag;
            }
        }
        Ok(values)
    }

    fn evaluate_on(
        &self,
        face: FaceId,
        quantity: Quantity,
        uv: &[DVec2],
        rule: OutsideRule,
        output: Output,
        pool: &Pool,
    ) -> Result<usize, EvalError> {
        let carrier = self.carrier(face);
        if let Carrier::Spline(surface) = carrier {
            let rows: Vec<f64> = uv.iter().flat_map(|uv| uv.to_array()).collect();
            return evaluate(surface, quantity, Points::new(&rows, 2, uv.len()), rule, output, pool);
        }
        if let Some(index) = uv.iter().position(|uv| !uv.is_finite()) {
            return Err(EvalError::NotFinite { index });
        }
        let max_derivative = match quantity {
            Quantity::Values => 0,
            Quantity::Derivatives(order) => order,
            Quantity::Normals => 1,
            Quantity::Curvatures => 2,
        };
        let given = 3 * derivative_rows(max_derivative);
        let mut rows = vec![0.0; given * uv.len()];
        carrier.eval_rows(uv, max_derivative, &mut rows);
        for (row, out) in rows.chunks_exact(given).zip(output.rows.chunks_exact_mut(output.stride)) {
            let vector = |k: usize| DVec3::from_slice(&row[3 * k..]);
            match quantity {
                Quantity::Values | Quantity::Derivatives(_) => out[..given].copy_from_slice(row),
                Quantity::Normals => out[..3].copy_from_slice(&normal(vector(1), vector(2)).to_array()),
                Quantity::Curvatures => {
                    let bent = curvatures([1, 2, 3, 4, 5].map(vector));
                    out[..2].copy_from_slice(&[bent.k1, bent.k2]);
                    out[2..5].copy_from_slice(&bent.direction1.to_array());
                    out[5..8].copy_from_slice(&bent.direction2.to_array());
                }
            }
        }
        Ok(0)
    }
}

/// As seen from the other side of the surface.
fn turn(quantity: Quantity, row: &mut [f64]) {
    match quantity {
        Quantity::Values | Quantity::Derivatives(_) => {}
        Quantity::Normals => row.iter_mut().for_each(|x| *x = -*x),
        Quantity::Curvatures => {
            (row[0], row[1]) = (-row[1], -row[0]);
            let (first, second) = row[2..8].split_at_mut(3);
            first.swap_with_slice(second);
        }
    }
}

/// An error about the points of one face, told of all points.
pub(super) fn of_all(error: EvalError, group: &[usize]) -> EvalError {
    match error {
        EvalError::NotFinite { index } => EvalError::NotFinite { index: group[index] },
        EvalError::Outside { index, u, v } => EvalError::Outside { index: group[index], u, v },
        other => other,
    }
}

/// The points on each face that has any, face after face.
pub(super) fn by_face(faces: &[u32], count: usize) -> Result<Vec<Vec<usize>>, ModelEvalError> {
    if let Some(index) = faces.iter().position(|&face| face as usize >= count) {
        return Err(ModelEvalError::NoFace { index, face: faces[index], count });
    }
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by_key(|&index| faces[index]);
    Ok(order.chunk_by(|&a, &b| faces[a] == faces[b]).map(<[usize]>::to_vec).collect())
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{PIPE_RADIUS, hollow_cube, pipe};
    use super::*;

    #[test]
    fn normals_and_curvatures_are_those_of_the_fronts() {
        let model = pipe();
        let pool = Pool::new(1);
        let uv = [DVec2::new(0.3, 1.0), DVec2::new(0.1, 0.2)];
        let normals = model.evaluate(Quantity::Normals, &[0, 2], &uv, OutsideRule::Fail, &pool).unwrap().rows;
        let Carrier::Cylinder(cylinder) = &model.surfaces()[0] else { panic!("the wall is a cylinder") };
        let outward = 0.3_f64.cos() * cylinder.frame().x() + 0.3_f64.sin() * cylinder.frame().y();
        assert!(DVec3::from_slice(&normals).distance(outward) < 1e-14);
        assert!(DVec3::from_slice(&normals[3..]).distance(cylinder.frame().z()) < 1e-14);
        let bent =
            model.evaluate(Quantity::Curvatures, &[0], &uv[..1], OutsideRule::Fail, &pool).unwrap().rows;
        assert!(bent[0].abs() < 1e-14 && (bent[1] + 1.0 / PIPE_RADIUS).abs() < 1e-14, "{bent:?}");
        let refused = model.evaluate(Quantity::Values, &[0, 3], &uv, OutsideRule::Fail, &pool).unwrap_err();
        assert_eq!(refused, ModelEvalError::NoFace { index: 1, face: 3, count: 3 });
    }

    #[test]
    fn points_of_many_faces_come_back_in_their_order() {
        let model = hollow_cube(false);
        let faces: Vec<u32> = (0..12).rev().chain(0..12).collect();
        let uv: Vec<DVec2> = (0..24).map(|k| DVec2::new(f64::from(k) / 24.0, 0.25)).collect();
        let values = model.evaluate(Quantity::Values, &faces, &uv, OutsideRule::Fail, &Pool::new(2)).unwrap();
        for (k, row) in values.rows.chunks_exact(3).enumerate() {
            assert_eq!(DVec3::from_slice(row), model.carrier(FaceId(faces[k])).points(&uv[k..=k])[0]);
        }
        let beyond = [DVec2::splat(0.5), DVec2::new(2.0, 0.5)];
        let outside = model.evaluate(Quantity::Values, &[1, 0], &beyond, OutsideRule::Fail, &Pool::new(1));
        assert!(matches!(outside, Err(ModelEvalError::Eval(EvalError::Outside { index: 1, .. }))));
    }
}
