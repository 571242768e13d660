//! Evaluation: points that follow each other on one face go through the kernel together.
//!
//! A point gives the same bits alone and among others. Beyond the domain the surface is continued by the tangent
//! plane at the nearest place of its border.

use super::D1rcSurface;
use super::kernel::{LANES, Workspace};
use super::simplex::Site;
use crate::memory::{self, CollectVec};
use crate::surface::derivative_rows;
use crate::surface::homogeneous::divide;
use glam::DVec2;

/// Sums over functions at `L` points, by component, then by derivative; the last component of a rational surface
/// is its weight.
type Sums<const L: usize> = Vec<[[f64; L]; 6]>;

impl D1rcSurface {
    /// What [`eval_rows`](crate::surface::Surface::eval_rows) promises.
    pub(super) fn eval_points(&self, uv: &[DVec2], order: usize, out: &mut [f64]) {
        let row = self.dim * derivative_rows(order);
        // all that is inlined here uses the wide registers that the processor has
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut batch = Batch::new(self, order);
                let mut sites = uv.iter().map(|&uv| self.space.find(uv)).peekable();
                let mut done = 0;
                while let Some(found) = sites.next() {
                    let Some((face, site)) = found else {
                        batch.continued(uv[done], &mut out[done * row..][..row]);
                        done += 1;
                        continue;
                    };
                    let mut together = [site; LANES];
                    let mut count = 1;
                    while count < LANES {
                        let same = |next: &Option<(u32, Site)>| next.is_some_and(|(other, _)| other == face);
                        let Some(Some((_, site))) = sites.next_if(same) else { break };
                        together[count] = site;
                        count += 1;
                    }
                    batch.eval(face, &together[..count], &mut out[done * row..][..count * row]);
                    done += count;
                }
            },
        );
    }

    /// Values at points of one face of the domain.
    pub(super) fn eval_on_domain_face(&self, face: u32, uv: &[DVec2], out: &mut [f64]) {
        let row = self.dim;
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut batch = Batch::new(self, 0);
                for (uv, out) in uv.chunks(LANES).zip(out.chunks_mut(LANES * row)) {
                    let mut sites = [Site::new(DVec2::ZERO); LANES];
                    for (site, &uv) in sites.iter_mut().zip(uv) {
                        *site = self.space.locator.site_on(face, uv);
                    }
                    batch.eval(face, &sites[..uv.len()], out);
                }
            },
        );
    }
}

/// Points under way, with room for what they need.
struct Batch<'a> {
    surface: &'a D1rcSurface,
    order: usize,
    single: (Workspace<1>, Sums<1>),
    several: (Workspace<LANES>, Sums<LANES>),
}

impl<'a> Batch<'a> {
    fn new(surface: &'a D1rcSurface, order: usize) -> Self {
        let width = surface.dim + usize::from(surface.space.is_rational);
        Self {
            surface,
            order,
            single: (Workspace::default(), memory::filled([[0.0; 1]; 6], width)),
            several: (Workspace::default(), memory::filled([[0.0; LANES]; 6], width)),
        }
    }

    /// At most [`LANES`] points of one face.
    #[inline(always)]
    fn eval(&mut self, face: u32, sites: &[Site], out: &mut [f64]) {
        let Some(&first) = sites.first() else { return };
        if sites.len() == 1 {
            let (workspace, sums) = &mut self.single;
            add_functions(self.surface, face, &[first], self.order, workspace, sums);
            write_rows(self.surface, self.order, sums, out);
        } else {
            let mut all = [first; LANES];
            all[..sites.len()].copy_from_slice(sites);
            let (workspace, sums) = &mut self.several;
            add_functions(self.surface, face, &all, self.order, workspace, sums);
            write_rows(self.surface, self.order, sums, out);
        }
    }

    /// A point outside.
    fn continued(&mut self, uv: DVec2, out: &mut [f64]) {
        out.fill(f64::NAN);
        let near = if uv.is_finite() { self.surface.space.locator.nearest(uv) } else { None };
        let Some((face, near)) = near else { return };
        let dim = self.surface.dim;
        let site = self.surface.space.locator.site_in(face, near);
        let mut tangents = memory::filled(0.0, 3 * dim);
        let mut batch = Batch::new(self.surface, 1);
        batch.eval(face, &[site], &mut tangents);
        let (value, slopes) = tangents.split_at(dim);
        let (su, sv) = slopes.split_at(dim);
        let step = uv - near;
        for k in 0..dim {
            out[k] = value[k] + step.x * su[k] + step.y * sv[k];
        }
        let rows = out.len();
        out[dim..].fill(0.0);
        let known = rows.min(3 * dim);
        out[dim..known].copy_from_slice(&slopes[..known - dim]);
    }
}

/// The sums of all functions of a face at some of its points.
#[inline(always)]
fn add_functions<const L: usize>(
    surface: &D1rcSurface,
    face: u32,
    sites: &[Site; L],
    order: usize,
    workspace: &mut Workspace<L>,
    sums: &mut Sums<L>,
) {
    let (space, dim) = (&surface.space, surface.dim);
    let rows = derivative_rows(order);
    sums.fill([[0.0; L]; 6]);
    for &function in space.regions.functions(face) {
        let Some(jets) = space.jets(function, sites, order, workspace) else { continue };
        let weight = space.configurations[function as usize].weight;
        let point = &surface.coefficients[function as usize * dim..][..dim];
        for k in 0..sums.len() {
            let factor = if k < dim { weight * point[k] } else { weight };
            for r in 0..rows {
                for l in 0..L {
                    sums[k][r][l] += factor * jets[r][l];
                }
            }
        }
    }
}

/// As many of the points as there is room for.
#[inline(always)]
fn write_rows<const L: usize>(surface: &D1rcSurface, order: usize, sums: &Sums<L>, out: &mut [f64]) {
    let (dim, rows) = (surface.dim, derivative_rows(order));
    for (l, out) in out.chunks_exact_mut(dim * rows).enumerate() {
        if surface.space.is_rational {
            let homogeneous: Vec<f64> =
                (0..rows).flat_map(|r| sums.iter().map(move |sum| sum[r][l])).collect_vec();
            divide(&homogeneous, dim, order, out);
            continue;
        }
        for r in 0..rows {
            for k in 0..dim {
                out[r * dim + k] = sums[k][r][l];
            }
        }
    }
}
