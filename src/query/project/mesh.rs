//! The places of a mesh nearest to points, and the triangles that these lie on.

use super::{CHUNK, ProjectError, ProjectOptions};
use crate::control::Pool;
use crate::memory;
use crate::mesh::Mesh;
use crate::query::triangles::{NearestTriangle, TriangleTree};
use glam::DVec3;
use rayon::prelude::*;
use std::borrow::Borrow;

impl<M: Borrow<Mesh> + Sync> TriangleTree<M> {
    /// The nearest place for each point; None for those farther away than [`ProjectOptions::max_distance`], or farther
    /// than a double can square. Guesses and trims are not used: the answers are global, and a mesh has none.
    ///
    /// The result for a point depends on nothing but the point and the options.
    pub fn project(
        &self,
        points: &[DVec3],
        options: &ProjectOptions,
        pool: &Pool,
    ) -> Result<Vec<Option<NearestTriangle>>, ProjectError> {
        options.check(points)?;
        let mut nearest = memory::filled(None, points.len());
        let piece = |(found, points): (&mut [Option<NearestTriangle>], &[DVec3])| {
            if pool.check().is_ok() {
                for (found, &point) in found.iter_mut().zip(points) {
                    *found = self.nearest(point).filter(|place| place.distance <= options.max_distance);
                }
            }
        };
        pool.run(|| nearest.par_chunks_mut(CHUNK).zip(points.par_chunks(CHUNK)).for_each(piece));
        pool.check()?;
        Ok(nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{Random, bumps};

    #[test]
    fn all_points_find_what_each_finds_on_any_number_of_threads() {
        let (mesh, _) = bumps([20, 20], 8, 1).unwrap();
        let tree = TriangleTree::new(&mesh);
        let mut random = Random::new(4);
        let mut point = || DVec3::new(random.signed(), random.signed(), random.signed()) * 2.0;
        let points: Vec<DVec3> = (0..3 * CHUNK + 7).map(|_| point()).collect();
        let each: Vec<_> = points.iter().map(|&point| tree.nearest(point)).collect();
        for threads in [1, 3] {
            let pool = Pool::new(threads);
            assert_eq!(tree.project(&points, &ProjectOptions::default(), &pool).unwrap(), each);
            let near = ProjectOptions::default().with_max_distance(0.5);
            let found = tree.project(&points, &near, &pool).unwrap();
            for (found, each) in found.iter().zip(&each) {
                assert_eq!(*found, each.filter(|place| place.distance <= 0.5));
            }
            assert!(found.contains(&None) && found.iter().any(Option::is_some));
        }
    }

    #[test]
    fn what_is_no_point_and_no_distance_is_refused() {
        let (mesh, _) = bumps([4, 4], 1, 1).unwrap();
        let tree = TriangleTree::new(&mesh);
        let (pool, options) = (Pool::new(1), ProjectOptions::default());
        let refused = |points: &[DVec3], options| tree.project(points, options, &pool).unwrap_err();
        let points = [DVec3::ZERO, DVec3::new(0.0, f64::NAN, 0.0)];
        assert_eq!(refused(&points, &options), ProjectError::NotFinite { index: 1 });
        let value = -1.0;
        let negative = options.with_max_distance(value);
        assert_eq!(refused(&points, &negative), ProjectError::MaxDistance { value });
        assert_eq!(tree.project(&[DVec3::splat(1e200)], &options, &pool).unwrap(), [None]);
        assert_eq!(tree.project(&[], &options, &pool).unwrap(), []);
    }
}
