//! Least squares over all samples in the jets of the basis vertices.
//!
//! ```text
//! minimize  sum_n w_n |S(u_n,v_n) - P_n|^2 + smoothing sum_cells plate energy of the unit cell
//! ```
//! Unknowns are the jets times 1, h_u, h_v, h_u h_v with the size of the largest cell at the vertex. The sums of a
//! cell go to its corners, and from T-vertices on to the basis vertices that they are made of. The matrix is made
//! of blocks of four by four.

use super::data::Data;
use super::sums::{ByLeaf, Energy, KnownSums};
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{CellMatrix, CellSums, weights};
use crate::linalg::{Condition, Conditions, SymbolicCholesky, impose_all};
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use crate::surface::pht::{Matrix, expansions};
use crate::tmesh::{Cell, TMesh, Topology, Vertex};
use glam::DVec2;
use sprs::CsMat;

type Block = [[f64; 4]; 4];

/// The matrix of one mesh: what stays when samples move.
pub(super) struct System<'a> {
    mesh: &'a TMesh,
    topology: &'a Topology,
    expansions: Vec<Vec<(u32, Matrix)>>,
    /// Size of the largest cell at each basis vertex.
    sizes: Vec<DVec2>,
    /// The rows of the blocks of the lower triangle by columns.
    rows: Lists,
    symbolic: SymbolicCholesky,
}

/// What one leaf adds.
#[derive(Default)]
struct Share {
    blocks: Vec<(u32, Block)>,
    right: Vec<(u32, Vec<f64>)>,
}

impl<'a> System<'a> {
    pub(super) fn new(mesh: &'a TMesh, topology: &'a Topology) -> Self {
        let expansions = expansions(topology, mesh);
        let mut sizes = memory::filled(DVec2::ZERO, topology.basis.len());
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (&node, corners) in topology.leaves.iter().zip(&topology.corners) {
            let size = mesh.cell_domain(mesh.cell(node)).size();
            let expanded = corners.iter().flat_map(|&vertex| &expansions[vertex as usize]);
            let mut ranks: Vec<u32> = expanded.map(|&(rank, _)| rank).collect_vec();
            ranks.sort_unstable();
            ranks.dedup();
            for (k, &column) in ranks.iter().enumerate() {
                sizes[column as usize] = sizes[column as usize].max(size);
                pairs.extend(ranks[k..].iter().map(|&row| (column, row)));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let rows = Lists::new(topology.basis.len(), pairs.into_iter());
        let zeros = vec![[[0.0; 4]; 4]; rows.items().len()];
        let symbolic = SymbolicCholesky::new(&lower_triangle(&rows, &zeros).view(), None);
        Self { mesh, topology, expansions, sizes, rows, symbolic }
    }

    /// The jets in the frame of the data: for each basis vertex four rows of `dim` numbers.
    pub(super) fn solve(
        &self,
        data: &Data,
        by_leaf: &ByLeaf,
        known: &mut KnownSums,
        energy: &Energy,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Vec<f64>, FitError> {
        let (dim, n) = (data.dim, 4 * self.topology.basis.len());
        let mut blocks = vec![[[0.0; 4]; 4]; self.rows.items().len()];
        let mut right = memory::filled(0.0, n * dim);
        by_leaf.add_shares(
            (self.mesh, self.topology),
            data,
            known,
            (pool, watch),
            |leaf, sums| self.share(leaf, sums, energy, dim),
            |_, share: Share| {
                for (place, block) in share.blocks {
                    let sums = blocks[place as usize].iter_mut().flatten();
                    sums.zip(block.iter().flatten()).for_each(|(sum, x)| *sum += x);
                }
                for (rank, rows) in share.right {
                    for (unknown, row) in (4 * rank as usize..).zip(rows.chunks_exact(dim)) {
                        (0..dim).for_each(|k| right[k * n + unknown] += row[k]);
                    }
                }
            },
        )?;
        let mut matrix = lower_triangle(&self.rows, &blocks);
        let pinned = self.pinned(data);
        pinned.eliminate(&mut matrix, &mut right, n);
        let factor = self.symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        factor.solve(&mut right, dim);
        pinned.impose(&mut right, n);
        let values = (&data.sample_values[..], dim);
        let mut conditions = match data.is_mirrored {
            true => self.mirror_conditions(dim, data.frame.inward(&memory::filled(0.0, dim))[0]),
            false => data.standards.conditions(&data.uv, values, |uv| self.terms(uv)),
        };
        for condition in conditions.iter_mut().flat_map(|all| &mut all.conditions) {
            *condition = pinned.without(std::mem::take(condition));
        }
        impose_all(&conditions, &factor, &mut right, n);
        watch.check()?;
        Ok(self.jets(&right, dim))
    }

    /// The unknowns that the value at a place is made of, and their weights.
    fn terms(&self, uv: DVec2) -> Vec<(usize, f64)> {
        let leaf = self.topology.leaf_of(self.mesh.locate(uv));
        let domain = self.mesh.cell_domain(self.cell(leaf));
        let (at, cell_units) = ((uv - domain.min) / domain.size(), units(domain.size()));
        let weights = weights(at.x, at.y);
        let mut terms = Vec::with_capacity(16);
        for (corner, &vertex) in self.topology.corners[leaf].iter().enumerate() {
            for (rank, matrix) in &self.expansions[vertex as usize] {
                let vertex_units = units(self.sizes[*rank as usize]);
                for c in 0..4 {
                    let part = |r: usize| weights[4 * corner + r] * cell_units[r] * matrix[r][c];
                    let weight = (0..4).map(part).sum::<f64>() / vertex_units[c];
                    terms.push((4 * *rank as usize + c, weight));
                }
            }
        }
        terms
    }

    /// The conditions of a mirror along the side of the largest u: the first component is odd across it, the others are
    /// even. `across` is the plane's place in the frame of the data.
    fn mirror_conditions(&self, dim: usize, across: f64) -> Vec<Conditions> {
        let on_mirror = self.vertices_on(1);
        let hold = |row: usize, value: f64, columns: usize| {
            on_mirror.iter().map(move |rank| Condition {
                terms: vec![(4 * rank + row, 1.0)],
                values: memory::filled(value, columns),
            })
        };
        vec![
            Conditions { columns: 0..1, conditions: hold(0, across, 1).chain(hold(2, 0.0, 1)).collect_vec() },
            Conditions {
                columns: 1..dim,
                conditions: hold(1, 0.0, dim - 1).chain(hold(3, 0.0, dim - 1)).collect_vec(),
            },
        ]
    }

    /// The basis vertices on a side: that of the least u, the largest u, the least v or the largest v.
    pub(crate) fn vertices_on(&self, side: usize) -> Vec<usize> {
        let last = self.mesh.last_vertex();
        let is_on = |&rank: &usize| {
            let vertex = self.vertex(rank);
            match side {
                0 => vertex.i == 0,
                1 => vertex.i == last.i,
                2 => vertex.j == 0,
                _ => vertex.j == last.j,
            }
        };
        (0..self.topology.basis.len()).filter(is_on).collect_vec()
    }

    fn vertex(&self, rank: usize) -> Vertex {
        self.topology.vertices[self.topology.basis[rank] as usize]
    }

    /// The parameters of a basis vertex.
    pub(crate) fn place_of(&self, rank: usize) -> DVec2 {
        self.mesh.parameters(self.vertex(rank))
    }

    /// The size of the largest cell at a basis vertex.
    pub(crate) fn size_of(&self, rank: usize) -> DVec2 {
        self.sizes[rank]
    }

    fn jets(&self, unknowns: &[f64], dim: usize) -> Vec<f64> {
        let n = 4 * self.topology.basis.len();
        let mut jets = Vec::with_capacity(n * dim);
        for (rank, size) in self.sizes.iter().enumerate() {
            for (row, scale) in units(*size).into_iter().enumerate() {
                jets.extend((0..dim).map(|k| unknowns[k * n + 4 * rank + row] / scale));
            }
        }
        jets
    }

    fn cell(&self, leaf: usize) -> Cell {
        self.mesh.cell(self.topology.leaves[leaf])
    }

    fn share(&self, leaf: usize, sums: &CellSums, energy: &Energy, dim: usize) -> Share {
        let domain = self.mesh.cell_domain(self.cell(leaf));
        let level = self.cell(leaf).level;
        let matrix = sums.with_energy(energy.plate(level), energy.membrane(leaf));
        self.expand(leaf, &matrix, &sums.right, units(domain.size()), dim)
    }

    /// From the unknowns of a cell to those of the basis vertices that its corners are made of.
    fn expand(
        &self,
        leaf: usize,
        matrix: &CellMatrix,
        right_rows: &[f64],
        cell_units: [f64; 4],
        dim: usize,
    ) -> Share {
        let corners = self.topology.corners[leaf].map(|vertex| &self.expansions[vertex as usize]);
        let transforms: Vec<(usize, u32, Block)> = corners
            .iter()
            .enumerate()
            .flat_map(|(corner, expansion)| {
                expansion.iter().map(move |(rank, matrix)| {
                    let vertex_units = units(self.sizes[*rank as usize]);
                    let scaled = |r: usize, c: usize| cell_units[r] * matrix[r][c] / vertex_units[c];
                    (corner, *rank, std::array::from_fn(|r| std::array::from_fn(|c| scaled(r, c))))
                })
            })
            .collect_vec();
        let mut share = Share { blocks: Vec::with_capacity(10), right: Vec::with_capacity(4) };
        for (corner_b, column, b) in &transforms {
            let rows = right_rows[4 * corner_b * dim..][..4 * dim].chunks_exact(dim);
            let mut right = memory::filled(0.0, 4 * dim);
            for (row, weights) in rows.zip(b) {
                for (sum, weight) in right.chunks_exact_mut(dim).zip(weights) {
                    sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += weight * x);
                }
            }
            share.right.push((*column, right));
            for (corner_a, row, a) in &transforms {
                if row < column {
                    continue;
                }
                let product = congruence(matrix, *corner_a, a, *corner_b, b);
                let place = self.place(*row, *column);
                match share.blocks.iter_mut().find(|(other, _)| *other == place) {
                    Some((_, sum)) => {
                        let sums = sum.iter_mut().flatten();
                        sums.zip(product.iter().flatten()).for_each(|(sum, x)| *sum += x);
                    }
                    None => share.blocks.push((place, product)),
                }
            }
        }
        share
    }

    /// The number of a block of the lower triangle.
    fn place(&self, row: u32, column: u32) -> u32 {
        let found = self.rows.of(column as usize).binary_search(&row);
        let from = self.rows.range(column as usize).start;
        (from + found.expect("the pattern holds all pairs of a leaf")) as u32
    }
}

/// What the four unknowns of a jet are multiplied by.
pub(crate) fn units(size: DVec2) -> [f64; 4] {
    [1.0, size.x, size.y, size.x * size.y]
}

/// `a^T M b` for the part of `M` that belongs to two corners.
fn congruence(matrix: &CellMatrix, corner_a: usize, a: &Block, corner_b: usize, b: &Block) -> Block {
    let mut half = [[0.0; 4]; 4];
    for r in 0..4 {
        let part = &matrix[4 * corner_a + r][4 * corner_b..][..4];
        for k in 0..4 {
            for c in 0..4 {
                half[r][c] += part[k] * b[k][c];
            }
        }
    }
    let mut whole = [[0.0; 4]; 4];
    for k in 0..4 {
        for r in 0..4 {
            for c in 0..4 {
                whole[r][c] += a[k][r] * half[k][c];
            }
        }
    }
    whole
}

/// The scalar matrix: its lower triangle in columns.
fn lower_triangle(rows: &Lists, blocks: &[Block]) -> CsMat<f64> {
    let n = 4 * rows.count();
    let mut pointers = Vec::with_capacity(n + 1);
    let (mut indices, mut values) =
        (Vec::with_capacity(16 * blocks.len()), Vec::with_capacity(16 * blocks.len()));
    pointers.push(0);
    for column in 0..rows.count() {
        for c in 0..4 {
            for (row, block) in rows.of(column).iter().zip(&blocks[rows.range(column)]) {
                let first = if *row as usize == column { c } else { 0 };
                for r in first..4 {
                    indices.push(4 * *row as usize + r);
                    values.push(block[r][c]);
                }
            }
            pointers.push(indices.len());
        }
    }
    CsMat::new_csc((n, n), pointers, indices, values)
}
