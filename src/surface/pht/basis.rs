//! Control points, basis functions in Bezier form, and the operators that make one from the other on a leaf.
//!
//! Deng et al. 2008, section 4.2. At a vertex with the widths `du1, du2, dv1, dv2`, one third of the
//! cells to the left, right, below and above and 0 beyond the border, four functions have the jets in the rows
//! of b, and zero jets at all other basis vertices:
//! ```text
//! al = 1/(du1+du2)   be = 1/(dv1+dv2)   la = al du1   mu = be dv1
//! --  (1-la)(1-mu)  -al(1-mu)  -be(1-la)   al be
//! +-  la(1-mu)       al(1-mu)  -be la     -al be
//! -+  (1-la)mu      -al mu      be(1-la)  -al be
//! ++  la mu          al mu      be la      al be
//! C_st = f + p f_u + q f_v + p q f_uv,   p in {-du1, +du2}, q in {-dv1, +dv2}
//! ```
//! They are not negative, and they sum to one. With the widths of the level at which the vertex came into being
//! control points never change under refinement, but beside finer cells the four functions become nearly
//! parallel; with those of the widest leaf of the support on each side they stay apart.

use super::expansion::{Matrix, expansions};
use super::jet::{self, ROWS};
use super::{PhtError, PhtSurface};
use crate::memory::{self, CollectVec};
use crate::surface::tensor::Axis;
use crate::tmesh::Topology;
use crate::tmesh::{TMesh, Vertex};

/// Which widths the four functions of a vertex have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Basis {
    /// Those of the paper: the cells at the vertex's birth. Independent of later refinement.
    #[default]
    Canonical,
    /// The widest leaf of the support on each side: condition numbers do not grow with the levels.
    SupportSized,
}

/// One third of the widths on both sides along u and v; 0 beyond the border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Widths {
    /// To the left and right.
    pub u: [f64; 2],
    /// Below and above.
    pub v: [f64; 2],
}

impl Widths {
    /// The matrix b: a row for each function, --, +-, -+, ++; columns f, f_u, f_v, f_uv.
    pub fn function_jets(&self) -> Matrix {
        let (al, be) = (1.0 / (self.u[0] + self.u[1]), 1.0 / (self.v[0] + self.v[1]));
        let (la, mu) = (al * self.u[0], be * self.v[0]);
        let along_u = [[1.0 - la, -al], [la, al]];
        let along_v = [[1.0 - mu, -be], [mu, be]];
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[s, t]| {
            let (a, b) = (along_u[s], along_v[t]);
            [a[0] * b[0], a[1] * b[0], a[0] * b[1], a[1] * b[1]]
        })
    }

    /// The cells at the vertex's birth.
    fn canonical(mesh: &TMesh, vertex: Vertex) -> Self {
        let side = Vertex::side_at(vertex.birth_level());
        let last = mesh.last_vertex();
        let widths = |axis: Axis| {
            let (at, end) = (vertex.along(axis), last.along(axis));
            let here = mesh.parameter(axis, at);
            let below = if at > 0 { (here - mesh.parameter(axis, at - side)) / 3.0 } else { 0.0 };
            let above = if at < end { (mesh.parameter(axis, at + side) - here) / 3.0 } else { 0.0 };
            [below, above]
        };
        Self { u: widths(Axis::U), v: widths(Axis::V) }
    }
}

/// One of the four functions of a vertex on one leaf.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierForm {
    /// The leaf.
    pub leaf: usize,
    /// Sixteen ordinates for each of the four functions --, +-, -+, ++, v running fastest.
    pub ordinates: [[f64; 16]; 4],
}

/// From the control points that act on a leaf to its Bezier ordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalExtraction {
    /// The basis vertices, ascending.
    pub vertices: Vec<u32>,
    /// Sixteen rows, v running fastest, of four numbers for each of the vertices.
    pub matrix: Vec<f64>,
}

/// The basis functions of a surface.
#[derive(Debug, Clone, Copy)]
pub struct BasisFunctions<'a> {
    mesh: &'a TMesh,
    topology: &'a Topology,
    expansions: &'a [Vec<(u32, Matrix)>],
    widths: &'a [Widths],
}

impl BasisFunctions<'_> {
    /// The widths at a basis vertex.
    pub fn widths(&self, rank: usize) -> &Widths {
        &self.widths[rank]
    }

    /// The four functions of a basis vertex on each leaf of their support.
    pub fn functions(&self, rank: usize) -> Vec<BezierForm> {
        let acts = |&vertex: &u32| self.expansion(vertex, rank).is_some();
        let leaves = self.topology.corners.iter().enumerate();
        leaves
            .filter(|(_, corners)| corners.iter().any(acts))
            .map(|(leaf, _)| {
                let rows = self.leaf_ordinates(leaf, rank);
                let ordinates = [0, 1, 2, 3].map(|k| std::array::from_fn(|row| rows[4 * row + k]));
                BezierForm { leaf, ordinates }
            })
            .collect_vec()
    }

    /// The extraction operator of a leaf.
    pub fn extraction(&self, leaf: usize) -> LocalExtraction {
        let expansions = self.topology.corners[leaf].map(|vertex| &self.expansions[vertex as usize]);
        let mut vertices: Vec<u32> = expansions.into_iter().flatten().map(|&(rank, _)| rank).collect_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let columns: Vec<_> =
            vertices.iter().map(|&rank| self.leaf_ordinates(leaf, rank as usize)).collect_vec();
        let row = |i: usize| columns.iter().flat_map(move |column| column[4 * i..4 * i + 4].iter().copied());
        LocalExtraction { matrix: (0..16).flat_map(row).collect_vec(), vertices }
    }

    fn expansion(&self, vertex: u32, rank: usize) -> Option<&Matrix> {
        let expansion = &self.expansions[vertex as usize];
        let place = expansion.binary_search_by_key(&(rank as u32), |&(rank, _)| rank).ok()?;
        Some(&expansion[place].1)
    }

    /// Sixteen rows of the four functions of a vertex on a leaf.
    fn leaf_ordinates(&self, leaf: usize, rank: usize) -> [f64; 64] {
        let functions = self.widths[rank].function_jets();
        let jets = self.topology.corners[leaf].map(|vertex| {
            let mut jet = [0.0; 16];
            if let Some(matrix) = self.expansion(vertex, rank) {
                for (row, jet) in matrix.iter().zip(jet.chunks_exact_mut(4)) {
                    for (function, value) in functions.iter().zip(jet) {
                        *value = row.iter().zip(function).map(|(m, b)| m * b).sum();
                    }
                }
            }
            jet
        });
        let size = self.mesh.cell_domain(self.mesh.cell(self.topology.leaves[leaf])).size();
        let mut ordinates = [0.0; 64];
        jet::ordinates(jets.each_ref().map(|jet| jet.as_slice()), size.to_array(), 4, &mut ordinates);
        ordinates
    }
}

/// The widest leaf of each vertex's support on each side.
fn support_widths(mesh: &TMesh, topology: &Topology, expansions: &[Vec<(u32, Matrix)>]) -> Vec<Widths> {
    let mut widths = memory::filled(Widths { u: [0.0; 2], v: [0.0; 2] }, topology.basis.len());
    for (&node, corners) in topology.leaves.iter().zip(&topology.corners) {
        let [low, _, _, high] = mesh.cell(node).corners();
        let third = mesh.cell_domain(mesh.cell(node)).size() / 3.0;
        for (rank, _) in corners.iter().flat_map(|&vertex| &expansions[vertex as usize]) {
            let vertex = topology.vertices[topology.basis[*rank as usize] as usize];
            let widths = &mut widths[*rank as usize];
            // a leaf never straddles the lines of a vertex that acts on it: those are lines of a larger leaf
            let (u, v) = (usize::from(low.i >= vertex.i), usize::from(low.j >= vertex.j));
            debug_assert!((u == 1 || high.i <= vertex.i) && (v == 1 || high.j <= vertex.j), "{vertex:?}");
            widths.u[u] = widths.u[u].max(third.x);
            widths.v[v] = widths.v[v].max(third.y);
        }
    }
    widths
}

impl PhtSurface {
    /// The basis functions over the mesh. Their tables are made once for a mesh.
    pub fn basis(&self, basis: Basis) -> BasisFunctions<'_> {
        let (mesh, topology) = (&self.mesh, self.topology());
        BasisFunctions { mesh, topology, expansions: self.expansions(), widths: self.widths(basis) }
    }

    fn expansions(&self) -> &[Vec<(u32, Matrix)>] {
        let view = self.view();
        view.expansions.get_or_init(|| expansions(&view.topology, &self.mesh))
    }

    fn widths(&self, basis: Basis) -> &[Widths] {
        let view = self.view();
        view.widths[basis as usize].get_or_init(|| match basis {
            Basis::Canonical => {
                self.jets.keys().map(|&vertex| Widths::canonical(&self.mesh, vertex)).collect_vec()
            }
            Basis::SupportSized => support_widths(&self.mesh, &view.topology, self.expansions()),
        })
    }

    /// The control points: for each basis vertex in order the rows --, +-, -+, ++ of [`PhtSurface::width`]
    /// numbers, homogeneous where there are weights.
    pub fn control_points(&self, basis: Basis) -> Vec<f64> {
        let width = self.width();
        let mut points = memory::filled(0.0, ROWS * width * self.jets.len());
        let vertices = self.jets.values().zip(self.widths(basis));
        for ((jet, widths), points) in vertices.zip(points.chunks_exact_mut(ROWS * width)) {
            for (k, point) in points.chunks_exact_mut(width).enumerate() {
                let (p, q) = ([-widths.u[0], widths.u[1]][k % 2], [-widths.v[0], widths.v[1]][k / 2]);
                jet::ordinate(jet, p, q, point);
            }
        }
        points
    }

    /// Replaces the control points of some basis vertices: for each the rows --, +-, -+, ++.
    pub fn set_control_points(
        &mut self,
        ranks: &[usize],
        basis: Basis,
        points: &[f64],
    ) -> Result<(), PhtError> {
        let (width, all) = (self.width(), self.widths(basis));
        let expected = ranks.len() * ROWS * width;
        if points.len() != expected {
            return Err(PhtError::Count { what: "the control points", count: points.len(), expected });
        }
        let mut jets = memory::filled(0.0, expected);
        let rows = points.chunks_exact(ROWS * width).zip(jets.chunks_exact_mut(ROWS * width));
        for (&rank, (points, jet)) in ranks.iter().zip(rows) {
            let widths = all.get(rank).ok_or(PhtError::NoSuchVertex { index: rank, count: all.len() })?;
            for (function, point) in widths.function_jets().iter().zip(points.chunks_exact(width)) {
                for (&share, row) in function.iter().zip(jet.chunks_exact_mut(width)) {
                    row.iter_mut().zip(point).for_each(|(sum, x)| *sum += share * x);
                }
            }
        }
        self.set_jets(ranks, &jets)
    }
}
