//! The jets of T-vertices: what each is made of.
//!
//! A T-vertex lies inside an edge of its host, whose cubics give its jet from those of the ends; ends may be
//! T-vertices again, of larger hosts.

use super::jet::{Line, ROWS, between, row_pairs};
use crate::geometry::Axis;
use crate::memory;
use crate::tmesh::{Hanging, TMesh, Topology, VertexKind};

/// How a T-vertex lies on the edge of its host.
fn hanging_line(topology: &Topology, mesh: &TMesh, number: u32, hanging: &Hanging) -> Line {
    let [at, from, to] = [number, hanging.ends[0], hanging.ends[1]]
        .map(|vertex| topology.vertices[vertex as usize].along(hanging.axis));
    line_between(mesh, hanging.axis, at, [from, to])
}

/// From the jets of the basis vertices to those of all vertices.
pub fn all_jets(topology: &Topology, mesh: &TMesh, jets: &[f64], width: usize) -> Vec<f64> {
    let length = ROWS * width;
    let mut all = memory::filled(0.0, topology.vertices.len() * length);
    for (&vertex, jet) in topology.basis.iter().zip(jets.chunks_exact(length)) {
        all[vertex as usize * length..][..length].copy_from_slice(jet);
    }
    for &number in &topology.hanging {
        let VertexKind::Hanging(hanging) = topology.kinds[number as usize] else { continue };
        let line = hanging_line(topology, mesh, number, &hanging);
        let ends = hanging.ends.map(|end| &all[end as usize * length..][..length]);
        let jet = between(hanging.axis, &line, ends, width);
        all[number as usize * length..][..length].copy_from_slice(&jet);
    }
    all
}

/// For each vertex, the basis vertices its jet is made of with their 4 by 4 matrices, ranks ascending.
pub fn expansions(topology: &Topology, mesh: &TMesh) -> Vec<Vec<(u32, Matrix)>> {
    let mut expansions: Vec<Vec<(u32, Matrix)>> = memory::filled(Vec::new(), topology.vertices.len());
    for (rank, &vertex) in topology.basis.iter().enumerate() {
        memory::push(&mut expansions[vertex as usize], (rank as u32, IDENTITY));
    }
    for &number in &topology.hanging {
        let VertexKind::Hanging(hanging) = topology.kinds[number as usize] else { continue };
        let line = hanging_line(topology, mesh, number, &hanging);
        let mut sum: Vec<(u32, Matrix)> = Vec::new();
        for (end, &vertex) in hanging.ends.iter().enumerate() {
            let share = end_matrix(hanging.axis, &line, end);
            for (rank, matrix) in &expansions[vertex as usize] {
                let product = multiply(&share, matrix);
                match sum.iter_mut().find(|(other, _)| other == rank) {
                    Some((_, total)) => add(total, &product),
                    None => sum.push((*rank, product)),
                }
            }
        }
        sum.sort_unstable_by_key(|&(rank, _)| rank);
        expansions[number as usize] = sum;
    }
    expansions
}

/// How the coordinate `at` lies on the line from one coordinate to another.
pub(super) fn line_between(mesh: &TMesh, axis: Axis, at: u32, [from, to]: [u32; 2]) -> Line {
    let length = mesh.parameter(axis, to) - mesh.parameter(axis, from);
    Line::at(f64::from(at - from) / f64::from(to - from), length)
}

/// Maps one jet into another, row by row.
pub type Matrix = [[f64; ROWS]; ROWS];

const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// What one end of a line contributes to the jet on it.
fn end_matrix(axis: Axis, line: &Line, end: usize) -> Matrix {
    let mut matrix = [[0.0; ROWS]; ROWS];
    for [row, derivative] in row_pairs(axis) {
        (matrix[row][row], matrix[row][derivative]) = (line.value[end][0], line.value[end][1]);
        (matrix[derivative][row], matrix[derivative][derivative]) = (line.slope[end][0], line.slope[end][1]);
    }
    matrix
}

fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    let mut product = [[0.0; ROWS]; ROWS];
    for i in 0..ROWS {
        for k in 0..ROWS {
            for j in 0..ROWS {
                product[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    product
}

fn add(sum: &mut Matrix, other: &Matrix) {
    for (sum, other) in sum.iter_mut().flatten().zip(other.iter().flatten()) {
        *sum += other;
    }
}
