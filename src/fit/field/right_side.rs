//! The right side `N^T W x` of the normal equations, again and again for other values.
//!
//! Everything that does not depend on the values is kept: the data in the order of their cells, and the weights of
//! the 16 unknowns that each of them meets, as four along u (times the datum's own weight) and four along v. The
//! same rows read a solution at the data: the transpose, `W N c`.

use crate::control::Pool;
use crate::fit::common::samples::{InteriorPlace, interior_weight};
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::{TensorBasis, by_cell};
use crate::linalg::SolveMemory;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use glam::DVec2;
use rayon::prelude::*;
use std::fmt;

/// Data read in one piece of work. Pieces do not depend on the number of threads.
const CHUNK: usize = 1024;

/// Where the data of a fit lie and how much they weigh: nodes, then places inside triangles.
pub(super) struct Data {
    pub uv: Vec<DVec2>,
    pub weights: Vec<f64>,
    nodes: Vec<u32>,
    places: Vec<InteriorPlace>,
}

impl Data {
    pub(super) fn new(
        uv: &[DVec2],
        known: Option<&[u32]>,
        weights: Option<&[f64]>,
        places: Vec<InteriorPlace>,
        smoothing: f64,
    ) -> Self {
        let nodes: Vec<u32> = known.map_or_else(|| (0..uv.len() as u32).collect_vec(), <[u32]>::to_vec);
        let weight = |&node: &u32| weights.map_or(1.0, |weights| weights[node as usize]);
        let inner = interior_weight(smoothing);
        Self {
            uv: nodes
                .iter()
                .map(|&node| uv[node as usize])
                .chain(places.iter().map(|place| place.mean(|node| uv[node])))
                .collect_vec(),
            weights: nodes
                .iter()
                .map(weight)
                .chain(places.iter().map(|place| inner * place.weight))
                .collect_vec(),
            nodes,
            places,
        }
    }

    /// One datum of weight 1 at each place.
    pub(super) fn plain(uv: &[DVec2]) -> Self {
        Self {
            uv: memory::copied(uv),
            weights: memory::filled(1.0, uv.len()),
            nodes: (0..uv.len() as u32).collect_vec(),
            places: Vec::new(),
        }
    }
}

/// What a datum takes its value from.
enum Source {
    Node(u32),
    Place(u32),
}

/// A datum and how it weighs the unknowns of its window.
struct Row {
    source: Source,
    u: [f64; 4],
    v: [f64; 4],
}

/// Everything about the right side but the values.
pub(super) struct RightSide {
    /// In the order of their cells.
    rows: Vec<Row>,
    /// Where the rows of each cell begin, and the end.
    starts: Vec<u32>,
    nodes: Vec<u32>,
    places: Vec<InteriorPlace>,
}

impl fmt::Debug for RightSide {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("RightSide").field("rows", &self.rows.len()).finish_non_exhaustive()
    }
}

/// Memory of one fit.
pub(super) struct Scratch {
    pub dim: usize,
    /// Middle and half the size of the values' box.
    center: Vec<f64>,
    scale: f64,
    /// Sums of one row of cells after the other, and room for the sums of one cell.
    strips: Vec<f64>,
    /// Columns of unknowns, one for each component.
    pub columns: Vec<f64>,
    pub memory: SolveMemory,
    rows: Vec<f64>,
    along_u: Vec<f64>,
    pub control_points: Vec<f64>,
    /// One row for each datum, where the columns are read.
    data: Vec<f64>,
}

impl fmt::Debug for Scratch {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Scratch").field("dim", &self.dim).finish_non_exhaustive()
    }
}

impl Scratch {
    pub(super) fn new(basis: &TensorBasis, right_side: &RightSide, dim: usize, memory: SolveMemory) -> Self {
        let (count_u, count_v) = (basis.u.grid.count + 2, basis.v.grid.count + 2);
        let [cells_u, _] = basis.cells();
        Self {
            dim,
            center: memory::filled(0.0, dim),
            scale: 1.0,
            strips: memory::filled(0.0, cells_u * right_side.strip_len(basis, dim)),
            columns: memory::filled(0.0, basis.len() * dim),
            memory,
            rows: memory::filled(0.0, basis.len() * dim),
            along_u: memory::filled(0.0, count_u * basis.v.len() * dim),
            control_points: memory::filled(0.0, count_u * count_v * dim),
            data: Vec::new(),
        }
    }

    /// Sets the frame: the values are taken less `center`, in their own size.
    pub(super) fn set_center(&mut self, center: impl Iterator<Item = f64>) {
        self.center.iter_mut().zip(center).for_each(|(c, x)| *c = x);
        self.scale = 1.0;
    }

    /// What the values are taken less of.
    pub(super) fn center(&self) -> &[f64] {
        &self.center
    }

    /// From the columns of unknowns to control points in the frame of the values.
    pub(super) fn write_control_points(&mut self, basis: &TensorBasis, dim: usize) {
        let n = basis.len();
        for (k, column) in self.columns.chunks_exact(n).enumerate() {
            self.rows[k..].iter_mut().step_by(dim).zip(column).for_each(|(row, x)| *row = *x);
        }
        basis.u.write_control_points(&self.rows, basis.v.len() * dim, &mut self.along_u);
        let lines = self.along_u.chunks_exact(basis.v.len() * dim);
        let points = self.control_points.chunks_exact_mut((basis.v.grid.count + 2) * dim);
        lines.zip(points).for_each(|(line, points)| basis.v.write_control_points(line, dim, points));
        for point in self.control_points.chunks_exact_mut(dim) {
            point.iter_mut().zip(&self.center).for_each(|(x, c)| *x = *x * self.scale + c);
        }
    }
}

impl RightSide {
    pub(super) fn new(basis: &TensorBasis, data: Data, pool: &Pool) -> Self {
        let row = |&datum: &u32| {
            let (uv, weight) = (data.uv[datum as usize], data.weights[datum as usize]);
            let ((cell_u, s), (cell_v, t)) = (basis.u.grid.locate(uv.x), basis.v.grid.locate(uv.y));
            let source = match data.nodes.get(datum as usize) {
                Some(&node) => Source::Node(node),
                None => Source::Place(datum - data.nodes.len() as u32),
            };
            Row {
                source,
                u: basis.u.window(cell_u, s, 0).weights.map(|x| weight * x),
                v: basis.v.window(cell_v, t, 0).weights,
            }
        };
        let (rows, starts) = pool.run(|| {
            let (starts, order) = by_cell(basis, &data.uv).into_parts();
            (order.par_iter().map(row).collect_vec(), starts)
        });
        Self { rows, starts, nodes: data.nodes, places: data.places }
    }

    /// Numbers that one row of cells needs: its sums, 16 of one cell for each component, and one value.
    fn strip_len(&self, basis: &TensorBasis, dim: usize) -> usize {
        (basis.u.width() * basis.v.len() + 17) * dim
    }

    /// The nodes with values, in order.
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Chooses the box in which sums of squares keep their digits.
    pub(super) fn frame(&self, values: &[f64], dim: usize, scratch: &mut Scratch) {
        let mut diagonal_sq = 0.0;
        for (k, center) in scratch.center.iter_mut().enumerate() {
            let component = self.nodes.iter().map(|&node| values[node as usize * dim + k]);
            let (min, max) = component
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max): (f64, f64), x| {
                    (min.min(x), max.max(x))
                });
            *center = min + (max - min) / 2.0;
            diagonal_sq += (max - min) * (max - min);
        }
        let diagonal: f64 = diagonal_sq.sqrt();
        scratch.scale = if diagonal > 0.0 && diagonal.is_finite() { diagonal } else { 1.0 };
    }

    /// Adds up the values of all data. Rows of cells are independent pieces of work, added in their order.
    pub(super) fn assemble(
        &self,
        values: &[f64],
        dim: usize,
        basis: &TensorBasis,
        scratch: &mut Scratch,
        pool: &Pool,
    ) {
        let strip_len = self.strip_len(basis, dim);
        let Scratch { strips, columns, center, scale, .. } = scratch;
        let framed = Framed { values, dim, center, scale: *scale };
        pool.run(|| {
            strips
                .par_chunks_mut(strip_len)
                .enumerate()
                .for_each(|(cell_u, strip)| self.sum_strip(cell_u, &framed, basis, strip));
        });
        let (n, rows) = (basis.len(), basis.v.len());
        columns.fill(0.0);
        for (cell_u, strip) in strips.chunks_exact(strip_len).enumerate() {
            let (first, len) = (basis.u.first(cell_u) * rows, basis.u.width() * rows);
            for (k, sums) in strip.chunks_exact(len).take(dim).enumerate() {
                columns[k * n + first..][..len].iter_mut().zip(sums).for_each(|(sum, x)| *sum += x);
            }
        }
    }

    /// The transpose of [`RightSide::assemble`]: what the columns of unknowns are at the data, times their weights,
    /// added up for the nodes that the data take their values from. Other nodes get 0.
    pub(super) fn transpose(&self, basis: &TensorBasis, scratch: &mut Scratch, out: &mut [f64], pool: &Pool) {
        let Scratch { columns, data, dim, .. } = scratch;
        let dim = *dim;
        data.resize(self.rows.len() * dim, 0.0);
        pool.run(|| {
            let chunks = data.par_chunks_mut(CHUNK * dim).enumerate();
            chunks.for_each(|(chunk, data)| self.read(chunk * CHUNK, columns, basis, dim, data));
        });
        out.fill(0.0);
        for (row, value) in self.rows.iter().zip(data.chunks_exact(dim)) {
            let mut add = |node: usize, share: f64| {
                let sums = &mut out[node * dim..][..dim];
                sums.iter_mut().zip(value).for_each(|(sum, x)| *sum += share * x);
            };
            match row.source {
                Source::Node(node) => add(node as usize, 1.0),
                Source::Place(place) => {
                    let InteriorPlace { nodes, shares, .. } = self.places[place as usize];
                    nodes.into_iter().zip(shares).for_each(|(node, share)| add(node, share));
                }
            }
        }
    }

    /// What the columns are at the data from row `first` on.
    fn read(&self, first: usize, columns: &[f64], basis: &TensorBasis, dim: usize, out: &mut [f64]) {
        let [_, cells_v] = basis.cells();
        let (n, rows, width_u, width_v) = (basis.len(), basis.v.len(), basis.u.width(), basis.v.width());
        let mut cell = self.starts.partition_point(|&start| start as usize <= first) - 1;
        for (index, out) in (first..).zip(out.chunks_exact_mut(dim)) {
            while self.starts[cell + 1] as usize <= index {
                cell += 1;
            }
            let row = &self.rows[index];
            let corner = basis.u.first(cell / cells_v) * rows + basis.v.first(cell % cells_v);
            for (column, out) in columns.chunks_exact(n).zip(out) {
                let line = |a: usize| {
                    let line = &column[corner + a * rows..][..width_v];
                    line.iter().zip(&row.v).map(|(x, v)| x * v).sum::<f64>()
                };
                *out = (0..width_u).map(|a| row.u[a] * line(a)).sum();
            }
        }
    }

    fn sum_strip(&self, cell_u: usize, framed: &Framed, basis: &TensorBasis, strip: &mut [f64]) {
        let (width_u, width_v, rows, dim) = (basis.u.width(), basis.v.width(), basis.v.len(), framed.dim);
        let [_, cells_v] = basis.cells();
        strip.fill(0.0);
        let (sums, rest) = strip.split_at_mut(width_u * rows * dim);
        let (of_cell, value) = rest.split_at_mut(16 * dim);
        for cell_v in 0..cells_v {
            let cell = cell_u * cells_v + cell_v;
            let data = &self.rows[self.starts[cell] as usize..self.starts[cell + 1] as usize];
            if data.is_empty() {
                continue;
            }
            of_cell.fill(0.0);
            for row in data {
                framed.read(&row.source, &self.places, value);
                for (x, of_cell) in value.iter().zip(of_cell.chunks_exact_mut(16)) {
                    for (u, line) in row.u.iter().zip(of_cell.chunks_exact_mut(4)) {
                        let product = u * x;
                        line.iter_mut().zip(&row.v).for_each(|(sum, v)| *sum += product * v);
                    }
                }
            }
            let first_v = basis.v.first(cell_v);
            for (k, of_cell) in of_cell.chunks_exact(16).enumerate() {
                for (a, line) in of_cell.chunks_exact(4).take(width_u).enumerate() {
                    let to = &mut sums[(k * width_u + a) * rows + first_v..][..width_v];
                    to.iter_mut().zip(line).for_each(|(sum, x)| *sum += x);
                }
            }
        }
    }
}

/// Values in their frame.
struct Framed<'a> {
    values: &'a [f64],
    dim: usize,
    center: &'a [f64],
    scale: f64,
}

impl Framed<'_> {
    fn read(&self, source: &Source, places: &[InteriorPlace], out: &mut [f64]) {
        let at = |node: usize, k: usize| (self.values[node * self.dim + k] - self.center[k]) / self.scale;
        for (k, out) in out.iter_mut().enumerate() {
            *out = match *source {
                Source::Node(node) => at(node as usize, k),
                Source::Place(place) => places[place as usize].mean(|node| at(node, k)),
            };
        }
    }
}
