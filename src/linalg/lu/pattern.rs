//! What the pattern of a matrix says: where its entries and the updates of its fronts go.

use super::LuError;
use crate::linalg::elimination::{EliminationTree, Supernode};
use crate::linalg::ordering::Graph;
use crate::memory;
use sprs::CsMatView;

/// Where one entry of the matrix goes in its supernode's panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    pub entry: u32,
    pub place: u32,
}

/// For each entry the index of its mirror image: one pass, since both are met in the same order.
pub(super) fn mirror_entries(matrix: &CsMatView<f64>) -> Result<Vec<u32>, LuError> {
    let (starts, columns) = (matrix.indptr(), matrix.indices());
    let starts = starts.raw_storage();
    let mut next: Vec<usize> = starts[..matrix.rows()].to_vec();
    let mut mirror = memory::filled(0, columns.len());
    for row in 0..matrix.rows() {
        let mut has_diagonal = false;
        for entry in starts[row]..starts[row + 1] {
            let column = columns[entry];
            let image = next[column];
            if image >= starts[column + 1] || columns[image] != row {
                return Err(LuError::PatternNotSymmetric { row });
            }
            next[column] += 1;
            mirror[entry] = image as u32;
            has_diagonal |= column == row;
        }
        if !has_diagonal {
            return Err(LuError::PatternNotSymmetric { row });
        }
    }
    Ok(mirror)
}

pub(super) fn off_diagonal_graph(matrix: &CsMatView<f64>) -> Graph {
    let mut graph = Graph { starts: vec![0], neighbours: memory::with_capacity(matrix.nnz()) };
    for (row, entries) in matrix.outer_iterator().enumerate() {
        let others = entries.indices().iter().filter(|&&column| column != row);
        graph.neighbours.extend(others.map(|&column| column as u32));
        graph.starts.push(graph.neighbours.len() as u32);
    }
    graph
}

/// Where each row below a supernode stands in its parent's front; both lists ascend.
pub(super) fn parent_places(tree: &EliminationTree) -> Vec<u32> {
    let mut places = memory::filled(0, tree.rows.len());
    for supernode in &tree.supernodes {
        let Some(parent) = supernode.parent.map(|parent| &tree.supernodes[parent]) else { continue };
        let parent_rows = &tree.rows[parent.rows.clone()];
        let mut next = 0;
        for at in supernode.rows.clone() {
            let row = tree.rows[at] as usize;
            places[at] = if row < parent.columns.end {
                row - parent.columns.start
            } else {
                next += parent_rows[next..].iter().take_while(|&&r| (r as usize) < row).count();
                parent.columns.len() + next
            } as u32;
        }
    }
    places
}

/// Sorts the matrix entries into the panels: the supernode of the earlier pivot has both images.
pub(super) fn place_entries(
    matrix: &CsMatView<f64>,
    mirror: &[u32],
    tree: &EliminationTree,
) -> (Vec<Slot>, Vec<usize>) {
    let starts = matrix.indptr();
    let (starts, columns) = (starts.raw_storage(), matrix.indices());
    let mut slots = memory::with_capacity(columns.len());
    let mut slot_starts = vec![0];
    let mut place_of_row = memory::filled(0_u32, tree.order.len());
    for supernode in &tree.supernodes {
        let Supernode { columns: pivots, rows, .. } = supernode;
        let (size, width, height) = (supernode.front_size(), pivots.len(), rows.len());
        let front = pivots.clone().chain(tree.rows[rows.clone()].iter().map(|&row| row as usize));
        front.enumerate().for_each(|(place, row)| place_of_row[row] = place as u32);
        for (k, pivot) in pivots.clone().enumerate() {
            let node = tree.order[pivot] as usize;
            for entry in starts[node]..starts[node + 1] {
                let other = tree.position[columns[entry]] as usize;
                if other < pivot {
                    continue;
                }
                let place = place_of_row[other] as usize;
                let in_upper =
                    if place < width { place * size + k } else { size * width + k * height + place - width };
                slots.push(Slot { entry: entry as u32, place: in_upper as u32 });
                if other != pivot {
                    slots.push(Slot { entry: mirror[entry], place: (k * size + place) as u32 });
                }
            }
        }
        slot_starts.push(slots.len());
    }
    (slots, slot_starts)
}
