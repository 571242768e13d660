//! Truncated hierarchical B-splines: the splines over a T-mesh with two continuous derivatives.
//!
//! C. Giannelli, B. Juettler, H. Speleers, "THB-splines: The truncated basis for hierarchical splines", Comput. Aided
//! Geom. Des. 29 (2012), 485-498.
//! ```text
//! cells of level l      those that the mesh has, split or not: Omega^l in the paper
//! a function of level l a bicubic B-spline over the uniform refinement of level l of the initial grid, with clamped ends
//! active                all cells of level l in its support are there, and one of them is a leaf
//! trunc^(l+1) f         f as a sum of functions of level l+1, without those whose support the mesh has at level l+1
//! ```
//! The truncated active functions are a basis, sum to one and are not negative. On a leaf all are bicubic, and they are
//! C2: their splines are PHT-splines, and what those can do they can do.
//!
//! On a cell of level l all functions are sums of the sixteen of that level. From a cell to its quarters the weights
//! change by knot insertion; then rows of functions that are there at the finer level are emptied (the truncation), and
//! those of active ones hold a one:
//! ```text
//! C_(l+1) = (R_u x R_v) C_l,    row of a function whose support is there := 0, or the unit row if it is active
//! ```

use super::{PhtError, PhtSurface, ROWS};
use crate::basis::{BasisRow, raise};
use crate::geometry::Axis;
use crate::knots::MAX_DEGREE;
use crate::memory::{self, CollectVec};
use crate::tmesh::{Cell, NodeId, TMesh, Topology};

const DEGREE: usize = 3;
/// Functions of one level on a cell along one direction.
const LINE: usize = DEGREE + 1;
/// Functions of one level on a cell, and Hermite unknowns of a cell.
const COUNT: usize = LINE * LINE;

/// What a B-spline of a level is known by: `i` and `j` are those of the last cell of its support, were there cells
/// beyond the border.
type Index = [u32; 2];

/// The functions of one level whose support the mesh has.
#[derive(Debug, Default)]
struct Level {
    /// Ascending, with the rank of each active one.
    functions: Vec<(Index, Option<u32>)>,
}

impl Level {
    /// The four functions `[i, j..j + 4]`, of which some are there.
    fn line(&self, [i, j]: Index) -> [Option<Option<u32>>; LINE] {
        let from = self.functions.partition_point(|(index, _)| *index < [i, j]);
        let mut line = [None; LINE];
        for &([at, b], rank) in self.functions[from..].iter().take(LINE) {
            if at == i && b < j + LINE as u32 {
                line[(b - j) as usize] = Some(rank);
            }
        }
        line
    }
}

/// What the spline on one leaf is made of.
#[derive(Debug, Clone)]
pub struct LeafFunctions {
    /// The functions that are not zero there, ascending.
    pub ranks: Vec<u32>,
    /// For each of them its Hermite data in units of the cell: at each corner, in the order of the quadrants, `f, H_u f_u,
    /// H_v f_v, H_u H_v f_uv`.
    pub hermite: Vec<[f64; COUNT]>,
    /// Which of the sixteen functions of the leaf's own level the last of them are.
    own: Vec<u8>,
}

/// The truncated basis over a T-mesh.
#[derive(Debug)]
pub struct TruncatedBasis {
    count: usize,
    /// In the order of [`TMesh::leaves`].
    leaves: Vec<LeafFunctions>,
}

/// A matrix of four by four along one direction.
type LineMatrix = [[f64; LINE]; LINE];

/// Weights of the functions of one level on a cell, one column for each function that is not zero there.
#[derive(Default)]
struct Columns {
    ranks: Vec<u32>,
    weights: Vec<[f64; COUNT]>,
    /// Which of the sixteen the last ones are: active functions of that level.
    own: Vec<u8>,
}

impl TruncatedBasis {
    /// The basis over a mesh; its functions are numbered level after level, in each along u, then v.
    pub fn new(mesh: &TMesh) -> Self {
        let mut basis = Self { count: 0, leaves: memory::with_capacity(mesh.leaf_count()) };
        let levels = basis.number_functions(mesh);
        let [count_u, count_v] = mesh.grid_size();
        for (i, j) in (0..count_u).flat_map(|i| (0..count_v).map(move |j| (i, j))) {
            let cell = Cell { level: 0, i, j };
            if let Some(node) = mesh.find(cell) {
                let columns = Columns::default().with_active(&levels[0], cell);
                basis.descend(mesh, &levels, node, columns);
            }
        }
        basis
    }

    /// Number of functions.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What each leaf is made of, in the order of [`TMesh::leaves`].
    pub fn leaves(&self) -> &[LeafFunctions] {
        &self.leaves
    }

    /// The jets of the basis vertices of a spline with control points of `width` numbers.
    pub fn jets(&self, mesh: &TMesh, topology: &Topology, control_points: &[f64], width: usize) -> Vec<f64> {
        let mut jets = memory::filled(0.0, topology.basis.len() * ROWS * width);
        let mut ranks = memory::filled(usize::MAX, topology.vertices.len());
        topology.basis.iter().enumerate().for_each(|(rank, &vertex)| ranks[vertex as usize] = rank);
        let leaves = topology.leaves.iter().zip(&topology.corners).zip(&self.leaves);
        for ((&node, corners), functions) in leaves {
            let size = mesh.cell_domain(mesh.cell(node)).size();
            let units = [1.0, size.x, size.y, size.x * size.y];
            for (corner, &vertex) in corners.iter().enumerate() {
                // all leaves around a vertex have one jet there; the first has it taken down
                let rank = std::mem::replace(&mut ranks[vertex as usize], usize::MAX);
                if rank == usize::MAX {
                    continue;
                }
                let jet = &mut jets[rank * ROWS * width..][..ROWS * width];
                for (row, (out, unit)) in jet.chunks_exact_mut(width).zip(units).enumerate() {
                    for (&rank, hermite) in functions.ranks.iter().zip(&functions.hermite) {
                        let weight = hermite[ROWS * corner + row] / unit;
                        let point = &control_points[rank as usize * width..][..width];
                        out.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
                    }
                }
            }
        }
        jets
    }

    /// The control points of a spline over the mesh that is C2. A truncated function has the coefficient that the function
    /// of its level has on a leaf of that level (C. Giannelli, B. Juettler, H. Speleers, "Strongly stable bases for
    /// adaptively refined multilevel spline spaces", Adv. Comput. Math. 40 (2014), theorem 9): the blossom at its knots.
    fn control_points(&self, surface: &PhtSurface) -> Vec<f64> {
        let (mesh, width) = (&surface.mesh, surface.width());
        let mut control_points = memory::filled(0.0, self.count * width);
        for (leaf, functions) in self.leaves.iter().enumerate() {
            let cell = mesh.cell(surface.topology().leaves[leaf]);
            let along = |axis| {
                let knots = knots_around(mesh, axis, cell);
                let (from, to) = (knots[2], knots[3]);
                blossoms(&[from, from, from, to, to, to], |j, p| knots[j + p - 1])
            };
            let [lines_u, lines_v] = [along(Axis::U), along(Axis::V)];
            let ordinates = surface.view().leaf_ordinates(leaf);
            let ranks = &functions.ranks[functions.ranks.len() - functions.own.len()..];
            for (&rank, &place) in ranks.iter().zip(&functions.own) {
                let (a, b) = (place as usize / LINE, place as usize % LINE);
                let shares = lines_u[a].iter().flat_map(|u| lines_v[b].iter().map(move |v| u * v));
                let point = &mut control_points[rank as usize * width..][..width];
                point.fill(0.0);
                for (share, ordinate) in shares.zip(ordinates.chunks_exact(width)) {
                    point.iter_mut().zip(ordinate).for_each(|(sum, x)| *sum += share * x);
                }
            }
        }
        control_points
    }

    /// Finds the functions whose support is there, level by level, and numbers the active ones.
    fn number_functions(&mut self, mesh: &TMesh) -> Vec<Level> {
        let mut levels = Vec::new();
        let [count_u, count_v] = mesh.grid_size();
        let first = (0..count_u).flat_map(|i| (0..count_v).map(move |j| Cell { level: 0, i, j }));
        let mut cells: Vec<NodeId> = first.filter_map(|cell| mesh.find(cell)).collect_vec();
        while !cells.is_empty() {
            let level = levels.len() as u32;
            let ends = [count_u << level, count_v << level];
            levels.push(self.number_level(mesh, &cells, ends));
            cells = cells.iter().filter_map(|&node| mesh.children(node)).flatten().collect_vec();
        }
        levels
    }

    /// The functions of one level; `ends` are the cells of its whole grid along u and v.
    fn number_level(&mut self, mesh: &TMesh, cells: &[NodeId], ends: [u32; 2]) -> Level {
        let touched = |&node: &NodeId| {
            let (Cell { i, j, .. }, is_leaf) = (mesh.cell(node), mesh.is_leaf(node));
            let line = 0..LINE as u32;
            line.clone().flat_map(move |a| line.clone().map(move |b| ([i + a, j + b], is_leaf)))
        };
        let mut touches: Vec<(Index, bool)> = cells.iter().flat_map(touched).collect_vec();
        touches.sort_unstable();
        // support cells along one direction: last - 3 to last, inside the grid
        let span = |last: u32, end: u32| last.min(end - 1) - last.saturating_sub(DEGREE as u32) + 1;
        let mut level = Level::default();
        for touches in touches.chunk_by(|a, b| a.0 == b.0) {
            let index = touches[0].0;
            if touches.len() as u32 == span(index[0], ends[0]) * span(index[1], ends[1]) {
                let is_active = touches.iter().any(|(_, is_leaf)| *is_leaf);
                memory::push(&mut level.functions, (index, is_active.then_some(self.count as u32)));
                self.count += usize::from(is_active);
            }
        }
        level
    }

    /// Takes down the leaves below a node, on which functions have these weights.
    fn descend(&mut self, mesh: &TMesh, levels: &[Level], node: NodeId, columns: Columns) {
        let cell = mesh.cell(node);
        let Some(children) = mesh.children(node) else {
            memory::push(&mut self.leaves, columns.to_leaf(mesh, cell));
            return;
        };
        for child in children {
            let quarter = mesh.cell(child);
            let refined = columns.refined(mesh, cell, quarter);
            let columns = refined.with_active(&levels[quarter.level as usize], quarter);
            self.descend(mesh, levels, child, columns);
        }
    }
}

impl Columns {
    /// The same functions in those of the level of a quarter.
    fn refined(&self, mesh: &TMesh, cell: Cell, quarter: Cell) -> Self {
        let along = |axis| {
            let (coarse, fine) = (knots_around(mesh, axis, cell), knots_around(mesh, axis, quarter));
            blossoms(&coarse, |j, p| fine[j + p - 1])
        };
        let lines = [along(Axis::U), along(Axis::V)];
        let weights = self.weights.iter().map(|column| product(&lines, column)).collect_vec();
        Self { ranks: memory::copied(&self.ranks), weights, own: Vec::new() }
    }

    /// Truncated, and with the active functions of the level of a cell.
    fn with_active(mut self, level: &Level, cell: Cell) -> Self {
        let mut own = Vec::new();
        for a in 0..LINE {
            let line = level.line([cell.i + a as u32, cell.j]);
            for (b, found) in line.into_iter().enumerate() {
                let place = LINE * a + b;
                if let Some(rank) = found {
                    self.weights.iter_mut().for_each(|column| column[place] = 0.0);
                    own.extend(rank.map(|rank| (rank, place as u8)));
                }
            }
        }
        let columns = self.ranks.into_iter().zip(self.weights);
        let kept = columns.filter(|(_, column)| column.iter().any(|&weight| weight != 0.0));
        let unit = |place: u8| std::array::from_fn(|k| f64::from(u8::from(k == place as usize)));
        let (ranks, weights) = kept.chain(own.iter().map(|&(rank, place)| (rank, unit(place)))).unzip();
        Self { ranks, weights, own: own.into_iter().map(|(_, place)| place).collect() }
    }

    fn to_leaf(&self, mesh: &TMesh, cell: Cell) -> LeafFunctions {
        let along = |axis| {
            let knots = knots_around(mesh, axis, cell);
            let (from, to) = (knots[2], knots[3]);
            let [p, q, r, s] = blossoms(&knots, |j, p| if p <= j { to } else { from });
            // value and slope at both ends
            let slope = |a: [f64; LINE], b: [f64; LINE]| std::array::from_fn(|k| 3.0 * (b[k] - a[k]));
            [p, slope(p, q), s, slope(r, s)]
        };
        let lines = [along(Axis::U), along(Axis::V)];
        let hermite = self.weights.iter().map(|column| by_corner(product(&lines, column))).collect_vec();
        LeafFunctions { ranks: memory::copied(&self.ranks), hermite, own: memory::copied(&self.own) }
    }
}

/// From value and slope at both ends along u, times the same along v, to corners with four rows.
fn by_corner(ends: [f64; COUNT]) -> [f64; COUNT] {
    std::array::from_fn(|unknown| {
        let (corner, row) = (unknown / ROWS, unknown % ROWS);
        let (u, v) = (2 * (corner / 2) + row % 2, 2 * (corner % 2) + row / 2);
        ends[LINE * u + v]
    })
}

/// `(A x B) column`.
fn product([a, b]: &[LineMatrix; 2], column: &[f64; COUNT]) -> [f64; COUNT] {
    let mut half = [0.0; COUNT];
    for i in 0..LINE {
        for k in 0..LINE {
            half[LINE * i + k] = (0..LINE).map(|m| b[k][m] * column[LINE * i + m]).sum();
        }
    }
    let mut whole = [0.0; COUNT];
    for i in 0..LINE {
        for m in 0..LINE {
            let weight = a[i][m];
            for k in 0..LINE {
                whole[LINE * i + k] += weight * half[LINE * m + k];
            }
        }
    }
    whole
}

/// The knots at which the functions on a cell are not simple polynomials: three on each side, ends repeated.
fn knots_around(mesh: &TMesh, axis: Axis, cell: Cell) -> [f64; 2 * DEGREE] {
    let at = match axis {
        Axis::U => cell.i,
        Axis::V => cell.j,
    };
    let end = mesh.last_vertex().along(axis);
    std::array::from_fn(|k| {
        let line = (at + k as u32).saturating_sub(2).saturating_mul(cell.side()).min(end);
        mesh.parameter(axis, line)
    })
}

/// Row `j` weighs the four functions on the middle interval of some knots for the blossom at three places,
/// `place(j, 1..=3)`.
fn blossoms(knots: &[f64; 2 * DEGREE], place: impl Fn(usize, usize) -> f64) -> LineMatrix {
    std::array::from_fn(|j| {
        let mut values: BasisRow = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        for p in 1..=DEGREE {
            raise(knots, DEGREE - 1, place(j, p), p, &mut values);
        }
        std::array::from_fn(|r| values[r])
    })
}

impl PhtSurface {
    /// The spline with two continuous derivatives over `mesh` with these control points of `dim` numbers, in the order of
    /// the functions of its [`TruncatedBasis`].
    pub fn truncated(dim: usize, mesh: TMesh, control_points: &[f64]) -> Result<Self, PhtError> {
        let basis = TruncatedBasis::new(&mesh);
        Self::of_truncated(dim, mesh, &basis, memory::copied(control_points))
    }

    /// The same for those who have the basis of the mesh.
    pub fn of_truncated(
        dim: usize,
        mesh: TMesh,
        basis: &TruncatedBasis,
        control_points: Vec<f64>,
    ) -> Result<Self, PhtError> {
        if dim == 0 {
            return Err(PhtError::Dimension);
        }
        let (count, expected) = (control_points.len(), basis.count().saturating_mul(dim));
        if count != expected {
            return Err(PhtError::Count { what: "the control points", count, expected });
        }
        if let Some(at) = control_points.iter().position(|x| !x.is_finite()) {
            return Err(PhtError::NotFinite { index: at / dim });
        }
        let jets = basis.jets(&mesh, &Topology::new(&mesh), &control_points, dim);
        let mut surface = Self::new(dim, false, mesh, &jets)?;
        surface.smooth = Some(control_points);
        Ok(surface)
    }

    /// The control points of a spline that was made with two continuous derivatives, in the order of the functions of the
    /// [`TruncatedBasis`] of its mesh; None for others, and for one that was changed since.
    pub fn smooth_control_points(&self) -> Option<&[f64]> {
        self.smooth.as_deref()
    }

    /// Finds the control points anew after cells were split, which changes no shape but for rounding: jets are those of the
    /// control points always.
    pub(super) fn renew_smooth(&mut self) -> Result<(), PhtError> {
        let basis = TruncatedBasis::new(&self.mesh);
        let points = basis.control_points(self);
        let renewed = Self::of_truncated(self.dim, self.mesh.clone(), &basis, points)?;
        let region = std::mem::take(&mut self.region);
        *self = Self { region, ..renewed };
        Ok(())
    }

    /// Continuous derivatives that the surface is known to have: 2 or 1.
    pub fn continuity(&self) -> u32 {
        if self.smooth.is_some() { 2 } else { 1 }
    }
}
