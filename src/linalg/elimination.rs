//! The elimination tree of a symmetric pattern: which rows every block of pivots fills.
//!
//! J. W. H. Liu, "The role of elimination trees in sparse factorization", SIAM J. Matrix Anal.
//! Appl. 11 (1990), 134-172; merging of small blocks after C. Ashcraft, R. Grimes, "The influence
//! of relaxed supernode partitions on the multifrontal method", ACM TOMS 15 (1989), 291-309.
//!
//! Eliminating a column fills its later rows into its parent, the first of them. Columns with the
//! same rows are a *supernode*, one dense block; small supernodes are merged with their parent
//! when few zeros come in. Supernodes are numbered children before parents, heaviest child first.

use super::ordering::Graph;
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use std::ops::Range;

/// A block of pivots with the same rows below.
#[derive(Debug, Clone)]
pub(super) struct Supernode {
    /// The pivots, in elimination order.
    pub columns: Range<usize>,
    /// Where its rows below the pivots stand in [`EliminationTree::rows`].
    pub rows: Range<usize>,
    /// Supernode that receives its update; none for a root.
    pub parent: Option<usize>,
    /// First supernode of its subtree, which is `first_descendant..=self`.
    pub first_descendant: usize,
    /// Multiplications of its subtree, roughly.
    pub work: f64,
}

impl Supernode {
    /// Order of the dense front: pivots and rows below.
    pub(super) fn front_size(&self) -> usize {
        self.columns.len() + self.rows.len()
    }
}

/// What elimination in a given order will fill.
#[derive(Debug, Clone)]
pub(super) struct EliminationTree {
    /// `order[k]` is the node eliminated k-th.
    pub order: Vec<u32>,
    /// `position[node]` is its place in `order`.
    pub position: Vec<u32>,
    /// Children before parents.
    pub supernodes: Vec<Supernode>,
    /// Rows below the pivots of all supernodes, as positions, ascending in each.
    pub rows: Vec<u32>,
    /// Children of each supernode, ascending (heaviest first).
    pub children: Vec<Vec<u32>>,
}

const NONE: u32 = u32::MAX;

impl EliminationTree {
    /// Analyses elimination in (nearly) the given order; equivalent orders fill the same.
    pub(super) fn new(graph: &Graph, order: &[u32]) -> Self {
        let (order, parents) = postordered(graph, order);
        let position = inverse(&order);
        let (blocks, rows) = fundamental_supernodes(graph, &order, &position, &parents);
        let merged_into = merge_small(&blocks);
        assemble(&order, &blocks, &rows, &merged_into)
    }
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = memory::filled(0, order.len());
    for (k, &node) in order.iter().enumerate() {
        position[node as usize] = k as u32;
    }
    position
}

/// The order rearranged so that every subtree is contiguous, with the parent of each position.
fn postordered(graph: &Graph, order: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let parents = elimination_parents(graph, order);
    let post = postorder(&parents, |_| 0.0);
    let rank = inverse(&post);
    let new_order = post.iter().map(|&k| order[k as usize]).collect_vec();
    let new_parents = post
        .iter()
        .map(|&k| match parents[k as usize] {
            NONE => NONE,
            parent => rank[parent as usize],
        })
        .collect_vec();
    (new_order, new_parents)
}

/// Liu's algorithm: parent of each position, with path compression.
fn elimination_parents(graph: &Graph, order: &[u32]) -> Vec<u32> {
    let position = inverse(order);
    let mut parents = memory::filled(NONE, order.len());
    let mut ancestors = memory::filled(NONE, order.len());
    for (k, &node) in order.iter().enumerate() {
        for &neighbour in graph.neighbours(node as usize) {
            let mut below = position[neighbour as usize] as usize;
            while below < k {
                let next = std::mem::replace(&mut ancestors[below], k as u32);
                if next == NONE {
                    parents[below] = k as u32;
                    break;
                }
                below = next as usize;
            }
        }
    }
    parents
}

/// The indices of `owners` by owner, ascending in each list; owner [`NONE`] is list `count`.
fn by_owner(owners: &[u32], count: usize) -> Lists {
    let list = move |&owner: &u32| if owner == NONE { count as u32 } else { owner };
    Lists::new(count + 1, owners.iter().map(list).zip(0..))
}

/// Children before parents; of siblings the heaviest first, then the smaller index.
fn postorder(parents: &[u32], weight: impl Fn(u32) -> f64) -> Vec<u32> {
    let children = by_owner(parents, parents.len());
    let mut post = memory::with_capacity(parents.len());
    // visited parents first and last child first, then turned round
    let mut stack = Vec::new();
    let push = |stack: &mut Vec<u32>, owner: usize| {
        let start = stack.len();
        stack.extend_from_slice(children.of(owner));
        stack[start..].sort_by(|&a, &b| weight(b).total_cmp(&weight(a)));
    };
    push(&mut stack, parents.len());
    while let Some(k) = stack.pop() {
        memory::push(&mut post, k);
        push(&mut stack, k as usize);
    }
    post.reverse();
    post
}

/// A supernode before merging.
struct Block {
    columns: Range<usize>,
    /// Its rows below the pivots, as a range of the common array; unsorted.
    rows: Range<usize>,
    /// The parent block; while blocks are being found, the parent column.
    parent: u32,
}

/// Joins consecutive columns whose rows are those of the column before, less itself. Returns the
/// blocks and their rows, as positions.
fn fundamental_supernodes(
    graph: &Graph,
    order: &[u32],
    position: &[u32],
    parents: &[u32],
) -> (Vec<Block>, Vec<u32>) {
    let n = order.len();
    let mut child_count = memory::filled(0_u32, n);
    for &parent in parents.iter().filter(|&&parent| parent != NONE) {
        child_count[parent as usize] += 1;
    }
    let later = |k: usize| {
        let neighbours = graph.neighbours(order[k] as usize).iter();
        neighbours.map(|&node| position[node as usize]).filter(move |&p| p as usize > k)
    };
    let mut blocks: Vec<Block> = Vec::new();
    let mut rows: Vec<u32> = Vec::new();
    let mut block_of = memory::filled(NONE, n);
    let mut mark = memory::filled(NONE, n); // last block that has this row
    // blocks whose update goes to a column first, as a chain: the last of them, then the one before
    let (mut last_sender, mut sender_before) = (memory::filled(NONE, n), Vec::new());
    for k in 0..n {
        let current = (blocks.len() as u32).wrapping_sub(1);
        let continues = k > 0
            && parents[k - 1] as usize == k
            && child_count[k] == 1
            && later(k).all(|row| mark[row as usize] == current);
        if !continues {
            if let Some(block) = blocks.last_mut() {
                close(block, &mut rows, parents);
                let previous = match block.parent {
                    NONE => NONE,
                    parent => std::mem::replace(&mut last_sender[parent as usize], current),
                };
                memory::push(&mut sender_before, previous);
            }
            let (id, start) = (blocks.len() as u32, rows.len());
            let mut enter = |row: u32, rows: &mut Vec<u32>| {
                if row as usize > k && std::mem::replace(&mut mark[row as usize], id) != id {
                    memory::push(rows, row);
                }
            };
            later(k).for_each(|row| enter(row, &mut rows));
            let mut sender = last_sender[k];
            while sender != NONE {
                for at in blocks[sender as usize].rows.clone() {
                    enter(rows[at], &mut rows);
                }
                sender = sender_before[sender as usize];
            }
            memory::push(&mut blocks, Block { columns: k..k, rows: start..rows.len(), parent: NONE });
        }
        let id = blocks.len() - 1;
        blocks[id].columns.end = k + 1;
        block_of[k] = id as u32;
    }
    if let Some(block) = blocks.last_mut() {
        close(block, &mut rows, parents);
    }
    for block in blocks.iter_mut().filter(|block| block.parent != NONE) {
        block.parent = block_of[block.parent as usize];
    }
    (blocks, rows)
}

/// The last block is complete: only rows below its columns remain.
fn close(block: &mut Block, rows: &mut Vec<u32>, parents: &[u32]) {
    let end = block.columns.end;
    let mut kept = block.rows.start;
    for at in block.rows.clone() {
        if rows[at] as usize >= end {
            rows[kept] = rows[at];
            kept += 1;
        }
    }
    rows.truncate(kept);
    block.rows.end = kept;
    block.parent = parents[end - 1];
}

/// Merged blocks of at most so many columns may hold this share of zeros; more would cost
/// arithmetic, fewer leave fronts so small that their bookkeeping costs more than they do.
const ZERO_SHARE: [(usize, f64); 4] = [(4, 1.0), (16, 0.3), (48, 0.1), (usize::MAX, 0.03)];

/// For each block the block it is merged into: itself, or its parent.
fn merge_small(blocks: &[Block]) -> Vec<u32> {
    let mut merged_into: Vec<u32> = (0..blocks.len() as u32).collect_vec();
    let mut columns: Vec<usize> = blocks.iter().map(|block| block.columns.len()).collect_vec();
    let mut zeros = memory::filled(0.0, blocks.len());
    // children come before parents, so a child's own children are settled when its turn comes
    for (id, block) in blocks.iter().enumerate().filter(|(_, block)| block.parent != NONE) {
        let parent = block.parent as usize;
        let (own, above) = (columns[id], columns[parent] + blocks[parent].rows.len());
        let brought_in = (own * (above - block.rows.len())) as f64;
        let zeros_after = zeros[id] + zeros[parent] + brought_in;
        let width = own + columns[parent];
        let height = blocks[parent].rows.len();
        let entries = (width * (width + 1) / 2 + width * height) as f64;
        let allowed = ZERO_SHARE.iter().find(|&&(limit, _)| width <= limit).map_or(0.0, |&(_, share)| share);
        if zeros_after <= allowed * entries {
            merged_into[id] = parent as u32;
            columns[parent] = width;
            zeros[parent] = zeros_after;
        }
    }
    merged_into
}

/// Numbers the merged supernodes, heaviest child first, and translates columns and rows.
fn assemble(order: &[u32], blocks: &[Block], block_rows: &[u32], merged_into: &[u32]) -> EliminationTree {
    let mut top: Vec<u32> = memory::copied(merged_into);
    for id in (0..blocks.len()).rev() {
        top[id] = top[top[id] as usize];
    }
    let members = by_owner(&top, blocks.len());
    let tops: Vec<u32> = (0..blocks.len() as u32).filter(|&id| top[id as usize] == id).collect_vec();
    let mut index_of = memory::filled(NONE, blocks.len());
    tops.iter().enumerate().for_each(|(index, &id)| index_of[id as usize] = index as u32);
    let parent_of = |&id: &u32| match blocks[id as usize].parent {
        NONE => NONE,
        parent => index_of[top[parent as usize] as usize],
    };
    let parents: Vec<u32> = tops.iter().map(parent_of).collect_vec();
    let work = subtree_work(blocks, &members, &tops, &parents);
    let post = postorder(&parents, |index| work[index as usize]);
    let rank = inverse(&post);

    let mut new_order = memory::with_capacity(order.len());
    let mut supernodes: Vec<Supernode> = memory::with_capacity(post.len());
    for &index in &post {
        let start = new_order.len();
        for &id in members.of(tops[index as usize] as usize) {
            new_order.extend_from_slice(&order[blocks[id as usize].columns.clone()]);
        }
        let parent = parents[index as usize];
        supernodes.push(Supernode {
            columns: start..new_order.len(),
            rows: 0..0,
            parent: (parent != NONE).then(|| rank[parent as usize] as usize),
            first_descendant: supernodes.len(),
            work: work[index as usize],
        });
    }
    let position = inverse(&new_order);
    let mut rows = Vec::new();
    for (supernode, &index) in supernodes.iter_mut().zip(&post) {
        let start = rows.len();
        let old = &block_rows[blocks[tops[index as usize] as usize].rows.clone()];
        memory::extend(&mut rows, old.iter().map(|&row| position[order[row as usize] as usize]));
        rows[start..].sort_unstable();
        supernode.rows = start..rows.len();
    }
    let children = link_children(&mut supernodes);
    EliminationTree { order: new_order, position, supernodes, rows, children }
}

/// Work of each merged supernode with everything below it.
fn subtree_work(blocks: &[Block], members: &Lists, tops: &[u32], parents: &[u32]) -> Vec<f64> {
    let own = |&id: &u32| {
        let width: usize = members.of(id as usize).iter().map(|&id| blocks[id as usize].columns.len()).sum();
        front_work(width, blocks[id as usize].rows.len())
    };
    let mut work: Vec<f64> = tops.iter().map(own).collect_vec();
    for index in 0..tops.len() {
        if parents[index] != NONE {
            work[parents[index] as usize] += work[index];
        }
    }
    work
}

/// Multiplications of one front with `width` pivots and `height` rows below.
fn front_work(width: usize, height: usize) -> f64 {
    let (width, height) = (width as f64, height as f64);
    width * (width * width / 3.0 + width * height + height * height) + 50.0 * (width + height)
}

fn link_children(supernodes: &mut [Supernode]) -> Vec<Vec<u32>> {
    let mut children = memory::filled(Vec::new(), supernodes.len());
    for s in 0..supernodes.len() {
        if let Some(parent) = supernodes[s].parent {
            memory::push(&mut children[parent], s as u32);
            let first = supernodes[s].first_descendant;
            supernodes[parent].first_descendant = supernodes[parent].first_descendant.min(first);
        }
    }
    children
}
