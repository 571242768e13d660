//! Branch and bound for one point.

use super::foot;
use super::index::{BRANCHES, Index, LEAF};
use super::inside::Inside;
use super::kernel::{Square, Verdict};
use crate::geometry::Domain;
use crate::memory;
use glam::DVec2;

/// Most cells that one point may look at in one index. A search that ends here has found a local minimum, but has
/// not proved that none is lower, and says so. It takes a continuum of nearly nearest points that no box or
/// polynomial follows.
const MAX_CELLS: usize = 200_000;

/// Rounding of the distance of a far point, with room.
const RELATIVE_TOLERANCE: f64 = 1e-14;

/// The nearest place so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    pub uv: DVec2,
    pub distance_sq: f64,
    /// The square of the distance that another place must have to be worth a look.
    limit_sq: f64,
}

impl Best {
    pub(super) fn new(distance_sq: f64, uv: DVec2, tolerance: f64) -> Self {
        // coefficients of the squared distance are rounded in proportion to it
        let limit = (distance_sq.sqrt() * (1.0 - RELATIVE_TOLERANCE) - tolerance).max(0.0);
        Self { uv, distance_sq, limit_sq: limit * limit }
    }
}

/// Memory that points share one after the other.
#[derive(Debug, Default)]
pub(super) struct Workspace {
    nodes: Vec<(f64, u32)>,
    /// Leaves whose foot point can wait: a sample's squared distance, the bound, the leaf.
    waiting: Vec<(f64, f64, u32)>,
    /// Cells of the leaf in hand, one after the other.
    ordinates: Vec<f64>,
    cells: Vec<Cell>,
    /// The lines of the trims that touch these cells, in the same order.
    lines: Vec<u32>,
    square: Square,
}

/// Part of a leaf.
#[derive(Debug, Clone, Copy)]
struct Cell {
    min: [f64; 2],
    max: [f64; 2],
    is_whole: bool,
    /// Lines of the trims that touch it; with none it lies inside.
    line_count: usize,
}

impl Cell {
    /// Which sides, the lower and the upper along each axis, lie within the leaf.
    #[inline(always)]
    fn shared(&self) -> [[bool; 2]; 2] {
        [0, 1].map(|axis| [self.min[axis] > 0.0, self.max[axis] < 1.0])
    }
}

/// A search for the point of a surface nearest to `point`.
pub(super) struct Search<'a> {
    pub point: &'a [f64],
    /// Differences of distance below this do not count.
    pub tolerance: f64,
    pub best: Best,
    /// Places outside do not count. That the nearest place may lie on a trim is the caller's care: trims are
    /// searched as curves.
    pub inside: Option<&'a Inside>,
    /// The leaf whose local minimum a start has led to.
    pub started: Option<usize>,
    /// Whether no cell was left out for lack of patience.
    pub is_proven: bool,
    pub workspace: &'a mut Workspace,
}

impl Search<'_> {
    #[inline(always)]
    fn offer(&mut self, distance_sq: f64, uv: DVec2, is_cut: bool) {
        let counts = || !is_cut || self.inside.is_none_or(|inside| inside.contains(uv));
        if distance_sq < self.best.distance_sq && counts() {
            self.best = Best::new(distance_sq, uv, self.tolerance);
        }
    }

    /// Offers the corners of a leaf that is probably near: a first bound for little.
    #[inline(always)]
    pub(super) fn sample(&mut self, index: &Index) {
        let (mut entry, mut is_found) = (0, index.leaf_count() > 0);
        while is_found && entry & LEAF == 0 {
            let bounds = index.distances_sq(entry, self.point);
            let is_open = |b: &usize| !self.inside.is_some_and(|inside| inside.is_closed(entry, *b));
            let children = index.children(entry);
            let nearest =
                (0..children.len()).filter(is_open).min_by(|&a, &b| bounds[a].total_cmp(&bounds[b]));
            is_found = nearest.is_some();
            entry = nearest.map_or(entry, |b| children[b]);
        }
        if !is_found {
            return;
        }
        let leaf = (entry & !LEAF) as usize;
        self.load(index, leaf);
        let is_cut = self.inside.is_some_and(|inside| !inside.lines_of(leaf).is_empty());
        for at in CORNERS {
            let distance_sq = corner_distance_sq(index, &self.workspace.ordinates, at);
            self.offer(distance_sq, index.place(leaf).uv(at), is_cut);
        }
    }

    /// Searches all leaves of an index.
    #[inline(always)]
    pub(super) fn run(&mut self, index: &Index) {
        if index.leaf_count() == 0 {
            return;
        }
        let mut budget = MAX_CELLS;
        self.workspace.nodes.clear();
        memory::push(&mut self.workspace.nodes, (0.0, 0));
        while let Some((bound, entry)) = self.workspace.nodes.pop() {
            if bound >= self.best.limit_sq {
                continue;
            }
            if entry & LEAF != 0 {
                self.search_leaf(index, (entry & !LEAF) as usize, true, &mut budget);
            } else {
                self.open(index, entry);
            }
        }
        self.settle(index, &mut budget);
    }

    /// Searches the leaves that were put off, beginning with the one whose sample is nearest.
    #[inline(always)]
    fn settle(&mut self, index: &Index, budget: &mut usize) {
        let mut waiting = std::mem::take(&mut self.workspace.waiting);
        waiting.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        for &(_, bound, leaf) in &waiting {
            if bound < self.best.limit_sq {
                self.search_leaf(index, leaf as usize, false, budget);
            }
        }
        waiting.clear();
        self.workspace.waiting = waiting;
    }

    /// Puts the children of a node on the stack, the nearest on top.
    #[inline(always)]
    fn open(&mut self, index: &Index, node: u32) {
        let bounds = index.distances_sq(node, self.point);
        let limit_sq = self.best.limit_sq;
        let mut near = [(0.0, 0); BRANCHES];
        let mut count = 0;
        for (b, (&child, &bound)) in index.children(node).iter().zip(&bounds).enumerate() {
            if bound < limit_sq && !self.inside.is_some_and(|inside| inside.is_closed(node, b)) {
                let mut k = count;
                while k > 0 && near[k - 1].0 < bound {
                    near[k] = near[k - 1];
                    k -= 1;
                }
                near[k] = (bound, child);
                count += 1;
            }
        }
        self.workspace.nodes.extend_from_slice(&near[..count]);
    }

    /// Starts from a place given by the caller: what it finds bounds the rest of the search.
    #[inline(always)]
    pub(super) fn try_leaf(&mut self, index: &Index, leaf: usize, at: [f64; 2]) {
        if self.inside.is_some_and(|inside| inside.is_outside(leaf)) {
            return;
        }
        self.started = Some(leaf);
        self.load(index, leaf);
        let form = index.kernel.form;
        let foot = foot::find(&form, &self.workspace.ordinates[..form.len()], at);
        self.offer(foot.distance_sq, index.place(leaf).uv(foot.at), true);
    }

    /// Ordinates of a leaf relative to the point.
    #[inline(always)]
    fn load(&mut self, index: &Index, leaf: usize) {
        let (form, source) = (index.kernel.form, index.ordinates(leaf));
        let count = form.count();
        let cell = &mut self.workspace.ordinates;
        cell.clear();
        let weights = form.is_rational.then(|| &source[form.dim * count..]);
        for (component, &x) in source.chunks_exact(count).zip(self.point) {
            match weights {
                Some(weights) => cell.extend(component.iter().zip(weights).map(|(a, w)| a - w * x)),
                None => cell.extend(component.iter().map(|a| a - x)),
            }
        }
        cell.extend_from_slice(weights.unwrap_or(&[]));
    }

    #[inline(always)]
    fn search_leaf(&mut self, index: &Index, leaf: usize, can_wait: bool, budget: &mut usize) {
        if self.started == Some(leaf) && index.is_convex_from(leaf, self.point) {
            return; // its one local minimum is known
        }
        self.load(index, leaf);
        let lines = self.inside.map_or(&[][..], |inside| inside.lines_of(leaf));
        self.workspace.lines.clear();
        self.workspace.lines.extend_from_slice(lines);
        self.workspace.cells.clear();
        let line_count = lines.len();
        memory::push(
            &mut self.workspace.cells,
            Cell { min: [0.0; 2], max: [1.0; 2], is_whole: true, line_count },
        );
        while let Some(cell) = self.workspace.cells.pop() {
            if *budget == 0 {
                self.is_proven = false;
                return;
            }
            *budget -= 1;
            self.search_cell(index, leaf, cell, can_wait);
        }
    }

    /// Settles the last cell of the stack, or replaces it by its halves.
    #[inline(always)]
    fn search_cell(&mut self, index: &Index, leaf: usize, cell: Cell, can_wait: bool) {
        let form = index.kernel.form;
        let first = self.workspace.ordinates.len() - form.len();
        let is_cut = cell.line_count > 0;
        let uv = |at: [f64; 2]| {
            index.place(leaf).uv([0, 1].map(|k| cell.min[k] + at[k] * (cell.max[k] - cell.min[k])))
        };
        if !cell.is_whole || self.best.distance_sq == f64::INFINITY {
            for at in CORNERS {
                let distance_sq = corner_distance_sq(index, &self.workspace.ordinates[first..], at);
                self.offer(distance_sq, uv(at), is_cut);
            }
        }
        let (limit_sq, slack) = (self.best.limit_sq, self.tolerance * self.best.distance_sq.sqrt());
        let workspace = &mut *self.workspace;
        let ordinates = &workspace.ordinates[first..];
        let square = &mut workspace.square;
        let (axis, start) = match index.kernel.judge(ordinates, limit_sq, slack, cell.shared(), square) {
            Verdict::Beyond | Verdict::Slope => return self.drop_cell(&cell, first),
            // of a cut cell: where this minimum lies outside the least distance is found on a trim
            Verdict::Convex(start) => (None, start),
            Verdict::Split(axis, start) => (Some(axis), start),
        };
        // a least coefficient on the border says that the nearest place is probably on a neighbour
        let is_inside = |k: usize| form.degree[k] == 0 || (start[k] > 0.0 && start[k] < 1.0);
        if axis.is_none() && cell.is_whole && self.started == Some(leaf) {
            return self.drop_cell(&cell, first); // its one local minimum is known
        }
        if axis.is_none() && cell.is_whole && can_wait && !(is_inside(0) && is_inside(1)) {
            let sample = foot::distance_sq(&form, ordinates, start);
            memory::push(&mut workspace.waiting, (sample, workspace.square.lowest, leaf as u32));
            self.drop_cell(&cell, first);
            return self.offer(sample, uv(start), is_cut);
        }
        if axis.is_none() || cell.is_whole {
            let foot = foot::find(&form, ordinates, start);
            self.offer(foot.distance_sq, uv(foot.at), is_cut);
        }
        let ordinates = &self.workspace.ordinates[first..];
        match axis {
            Some(axis) if extent(index, ordinates) > self.tolerance => {
                self.halve(index, cell, first, axis);
                if let (Some(inside), true) = (self.inside, is_cut) {
                    self.sort_lines(inside, index, leaf, cell.line_count);
                }
            }
            _ => self.drop_cell(&cell, first),
        }
    }

    /// Forgets the ordinates and the lines of the cell popped last.
    #[inline(always)]
    fn drop_cell(&mut self, cell: &Cell, first: usize) {
        self.workspace.ordinates.truncate(first);
        self.workspace.lines.truncate(self.workspace.lines.len() - cell.line_count);
    }

    /// Gives the two halves on top of the stack the lines that touch them, of the last `count`; a half that lies
    /// outside goes.
    fn sort_lines(&mut self, inside: &Inside, index: &Index, leaf: usize, count: usize) {
        let (len, place) = (index.kernel.form.len(), index.place(leaf));
        let workspace = &mut *self.workspace;
        let begin = workspace.lines.len() - count;
        let end = begin + count;
        for from_top in [1, 0] {
            let number = workspace.cells.len() - 1 - from_top;
            let Cell { min, max, .. } = workspace.cells[number];
            let cell = Domain { min: place.uv(min), max: place.uv(max) };
            let before = workspace.lines.len();
            for k in begin..end {
                if inside.touches(workspace.lines[k], &cell) {
                    workspace.lines.push(workspace.lines[k]);
                }
            }
            workspace.cells[number].line_count = workspace.lines.len() - before;
            if workspace.lines.len() == before && !inside.holds(&cell) {
                workspace.cells.remove(number);
                let last = workspace.ordinates.len() - from_top * len;
                workspace.ordinates.drain(last - len..last);
            }
        }
        workspace.lines.drain(begin..end);
    }

    /// Replaces the cell that begins at `first` by its halves, the nearer one last.
    fn halve(&mut self, index: &Index, cell: Cell, first: usize, axis: usize) {
        let form = index.kernel.form;
        let middle = (cell.min[axis] + cell.max[axis]) / 2.0;
        let (mut low, mut high) = (Cell { is_whole: false, ..cell }, Cell { is_whole: false, ..cell });
        (low.max[axis], high.min[axis]) = (middle, middle);
        let ordinates = &mut self.workspace.ordinates;
        ordinates.extend_from_within(first..);
        let (first_half, last_half) = ordinates[first..].split_at_mut(form.len());
        // the nearer end decides which half comes last
        let ends = [[0.0, 0.0], [1.0, 1.0]].map(|at| corner_distance_sq(index, first_half, at));
        if ends[0] < ends[1] {
            halve_ordinates(&form.degree, axis, last_half, first_half);
            memory::extend(&mut self.workspace.cells, [high, low]);
        } else {
            halve_ordinates(&form.degree, axis, first_half, last_half);
            memory::extend(&mut self.workspace.cells, [low, high]);
        }
    }
}

/// De Casteljau's algorithm at the middle: `low` holds a cell and keeps its lower half, `high` receives the
/// upper one. Equal ordinates stay equal.
fn halve_ordinates(degree: &[usize; 2], axis: usize, low: &mut [f64], high: &mut [f64]) {
    let [m, n] = degree.map(|degree| degree + 1);
    let (length, stride) = if axis == 0 { (m, n) } else { (n, 1) };
    for base in (0..low.len()).step_by(m * n) {
        for line in 0..m * n / length {
            let first = base + if axis == 0 { line } else { line * n };
            for round in 0..length {
                high[first + (length - 1 - round) * stride] = low[first + (length - 1) * stride];
                for k in (round + 1..length).rev() {
                    let at = first + k * stride;
                    low[at] = 0.5 * (low[at - stride] + low[at]);
                }
            }
        }
    }
}

/// Of the unit square.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];

/// The squared distance at a corner.
fn corner_distance_sq(index: &Index, ordinates: &[f64], at: [f64; 2]) -> f64 {
    let form = index.kernel.form;
    let [p, q] = form.degree;
    let corner = at[0] as usize * p * (q + 1) + at[1] as usize * q;
    let component = |k: usize| ordinates[k * form.count() + corner];
    let sum: f64 = (0..form.dim).map(|k| component(k) * component(k)).sum();
    if form.is_rational { sum / (component(form.dim) * component(form.dim)) } else { sum }
}

/// The longest side of the box of a cell.
fn extent(index: &Index, ordinates: &[f64]) -> f64 {
    let form = index.kernel.form;
    let count = form.count();
    let weights = form.is_rational.then(|| &ordinates[form.dim * count..]);
    let side = |component: &[f64]| {
        let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, &a) in component.iter().enumerate() {
            let x = weights.map_or(a, |weights| a / weights[k]);
            (min, max) = (min.min(x), max.max(x));
        }
        max - min
    };
    ordinates.chunks_exact(count).take(form.dim).map(side).fold(0.0, f64::max)
}
