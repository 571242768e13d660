//! Cells of a surface in a hierarchy of boxes.
//!
//! Leaves are Bezier patches, halved while they bend much; nodes have four children, sorted so that cells near
//! each other in space share them. Boxes are those of the ordinates, so they hold the surface exactly.

use super::kernel::{Form, Kernel, Square};
use crate::bezier::BezierPatch;
use crate::geometry::{Bounds, Domain};
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// Children of a node: their boxes are tested together.
pub(super) const BRANCHES: usize = 4;
/// Entries of the children of a node with this bit are leaves.
pub(super) const LEAF: u32 = 1 << 31;
/// Entry of the children of a node for a place that is not used.
const NONE: u32 = u32::MAX;

/// Where a leaf lies in the parameter plane.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place {
    /// The unit square becomes this rectangle.
    Rectangle(Domain),
    /// The unit interval becomes this line.
    Line(DVec2, DVec2),
}

impl Place {
    fn corners(&self) -> [DVec2; 2] {
        match *self {
            Self::Rectangle(Domain { min, max }) => [min, max],
            Self::Line(from, to) => [from, to],
        }
    }

    /// From the unit square to (u,v); the sides are met exactly.
    pub(super) fn uv(&self, at: [f64; 2]) -> DVec2 {
        let mix = |from: f64, to: f64, t: f64| {
            if t <= 0.5 { from + t * (to - from) } else { to - (1.0 - t) * (to - from) }
        };
        match *self {
            Self::Rectangle(Domain { min, max }) => {
                DVec2::new(mix(min.x, max.x, at[0]), mix(min.y, max.y, at[1]))
            }
            Self::Line(from, to) => DVec2::new(mix(from.x, to.x, at[0]), mix(from.y, to.y, at[0])),
        }
    }
}

/// A hierarchy over cells of one form.
#[derive(Debug, Clone)]
pub(super) struct Index {
    pub kernel: Kernel,
    places: Vec<Place>,
    /// [`Form::len`] numbers a leaf.
    ordinates: Vec<f64>,
    nodes: Vec<[u32; BRANCHES]>,
    /// For each node and component the least values of its children, then the largest.
    boxes: Vec<[f64; BRANCHES]>,
    /// For each node the rectangles around its children in the parameter plane.
    rectangles: Vec<[Domain; BRANCHES]>,
    /// For each leaf a ball of points from which it has one local minimum at most: centre and radius.
    balls: Vec<f64>,
}

impl Index {
    /// `patches` have the same degrees, dimension and rationality.
    pub(super) fn new(patches: Vec<(BezierPatch, Place)>) -> Self {
        let form =
            patches.first().map_or(Form { degree: [1, 1], dim: 1, is_rational: false }, |(patch, _)| Form {
                degree: patch.degree,
                dim: patch.dim,
                is_rational: patch.is_rational,
            });
        let mut index = Self {
            kernel: Kernel::new(form),
            places: memory::with_capacity(patches.len()),
            ordinates: memory::with_capacity(patches.len() * form.len()),
            nodes: Vec::new(),
            boxes: Vec::new(),
            rectangles: Vec::new(),
            balls: Vec::new(),
        };
        let mut bounds = memory::with_capacity(patches.len());
        for (patch, place) in patches {
            for k in 0..form.width() {
                memory::extend(
                    &mut index.ordinates,
                    patch.ordinates.iter().copied().skip(k).step_by(form.width()),
                );
            }
            memory::push(&mut bounds, patch.bounds());
            memory::push(&mut index.places, place);
        }
        let mut leaves: Vec<u32> = (0..bounds.len() as u32).collect_vec();
        if !leaves.is_empty() {
            index.add_node(&mut leaves, &bounds);
        }
        let mut square = Square::default();
        for (leaf, bounds) in bounds.iter().enumerate() {
            let centre: Vec<f64> =
                bounds.min.iter().zip(&bounds.max).map(|(a, b)| a + (b - a) / 2.0).collect_vec();
            let radius = index.kernel.convex_radius(index.ordinates(leaf), &centre, &mut square);
            memory::extend(&mut index.balls, centre);
            memory::push(&mut index.balls, radius);
        }
        index
    }

    /// Whether a leaf has one local minimum at most, seen from a point. If not, that is unknown.
    #[inline(always)]
    pub(super) fn is_convex_from(&self, leaf: usize, point: &[f64]) -> bool {
        let dim = point.len();
        let ball = &self.balls[leaf * (dim + 1)..][..dim + 1];
        let distance_sq = point.iter().zip(ball).map(|(x, c)| (x - c) * (x - c)).sum::<f64>();
        distance_sq <= ball[dim] * ball[dim]
    }

    /// Number of leaves.
    pub(super) fn leaf_count(&self) -> usize {
        self.places.len()
    }

    /// Where a leaf lies.
    pub(super) fn place(&self, leaf: usize) -> &Place {
        &self.places[leaf]
    }

    /// The ordinates of a leaf, component by component.
    pub(super) fn ordinates(&self, leaf: usize) -> &[f64] {
        let len = self.kernel.form.len();
        &self.ordinates[leaf * len..][..len]
    }

    /// The leaf over a parameter pair, and the place on its unit square.
    pub(super) fn leaf_at(&self, uv: DVec2) -> Option<(usize, [f64; 2])> {
        // nodes of a path: each level leaves three at most behind
        let (mut stack, mut count) = ([0; 3 * 32], usize::from(!self.nodes.is_empty()));
        while count > 0 {
            count -= 1;
            let entry = stack[count];
            if entry & LEAF == 0 {
                for (&child, domain) in self.children(entry).iter().zip(&self.rectangles[entry as usize]) {
                    if domain.contains(uv) {
                        stack[count] = child;
                        count += 1;
                    }
                }
            } else if let Place::Rectangle(domain) = self.places[(entry & !LEAF) as usize] {
                return Some(((entry & !LEAF) as usize, ((uv - domain.min) / domain.size()).to_array()));
            }
        }
        None
    }

    /// Number of nodes; those below a node come after it.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The leaves whose rectangles meet another.
    pub(super) fn visit_leaves_near(&self, rectangle: &Domain, mut visit: impl FnMut(usize)) {
        let mut stack = if self.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(entry) = stack.pop() {
            if entry & LEAF != 0 {
                visit((entry & !LEAF) as usize);
                continue;
            }
            let meets = |domain: &Domain| {
                domain.min.cmple(rectangle.max).all() && domain.max.cmpge(rectangle.min).all()
            };
            let children = self.children(entry).iter().zip(&self.rectangles[entry as usize]);
            stack.extend(children.filter(|(_, domain)| meets(domain)).map(|(&child, _)| child));
        }
    }

    /// The children of a node that are used.
    #[inline(always)]
    pub(super) fn children(&self, node: u32) -> &[u32] {
        let children = &self.nodes[node as usize];
        &children[..children.iter().position(|&child| child == NONE).unwrap_or(BRANCHES)]
    }

    /// Squared distances from a point to the boxes of a node's children.
    #[inline(always)]
    pub(super) fn distances_sq(&self, node: u32, point: &[f64]) -> [f64; BRANCHES] {
        let dim = point.len();
        let boxes = &self.boxes[node as usize * 2 * dim..][..2 * dim];
        // the same loop, once more with a fixed length
        if let Ok(point) = <&[f64; 3]>::try_from(point) {
            sum_gaps(boxes, point)
        } else {
            sum_gaps(boxes, point)
        }
    }

    fn add_node(&mut self, leaves: &mut [u32], bounds: &[Bounds]) -> u32 {
        let (node, dim) = (self.nodes.len(), self.kernel.form.dim);
        memory::push(&mut self.nodes, [NONE; BRANCHES]);
        memory::push(&mut self.rectangles, [Domain::around([]); BRANCHES]);
        memory::extend(&mut self.boxes, std::iter::repeat_n([f64::INFINITY; BRANCHES], dim));
        memory::extend(&mut self.boxes, std::iter::repeat_n([f64::NEG_INFINITY; BRANCHES], dim));
        for (b, part) in quarters(leaves, bounds).into_iter().filter(|part| !part.is_empty()).enumerate() {
            let corners = part.iter().flat_map(|&leaf| self.places[leaf as usize].corners());
            self.rectangles[node][b] = Domain::around(corners);
            for &leaf in part.iter() {
                let leaf = &bounds[leaf as usize];
                for k in 0..dim {
                    let (low, high) = (node * 2 * dim + k, node * 2 * dim + dim + k);
                    self.boxes[low][b] = self.boxes[low][b].min(leaf.min[k]);
                    self.boxes[high][b] = self.boxes[high][b].max(leaf.max[k]);
                }
            }
            self.nodes[node][b] = if let [leaf] = *part { leaf | LEAF } else { self.add_node(part, bounds) };
        }
        node as u32
    }
}

#[inline(always)]
fn sum_gaps(boxes: &[[f64; BRANCHES]], point: &[f64]) -> [f64; BRANCHES] {
    let (least, largest) = boxes.split_at(point.len());
    let mut sums = [0.0; BRANCHES];
    for ((&x, min), max) in point.iter().zip(least).zip(largest) {
        for b in 0..BRANCHES {
            // comparisons, because f64::max cares for NaN
            let (below, above) = (min[b] - x, x - max[b]);
            let gap = if below > above { below } else { above };
            let gap = if gap > 0.0 { gap } else { 0.0 };
            sums[b] += gap * gap;
        }
    }
    sums
}

/// Four parts of nearly equal size by two halvings.
fn quarters<'a>(leaves: &'a mut [u32], bounds: &[Bounds]) -> [&'a mut [u32]; BRANCHES] {
    let (low, high) = halve(leaves, bounds);
    let ((a, b), (c, d)) = (halve(low, bounds), halve(high, bounds));
    [a, b, c, d]
}

/// Two halves along the longest side of the box around the middles.
fn halve<'a>(leaves: &'a mut [u32], bounds: &[Bounds]) -> (&'a mut [u32], &'a mut [u32]) {
    let middle = |leaf: u32, k: usize| {
        let leaf = &bounds[leaf as usize];
        leaf.min[k] + (leaf.max[k] - leaf.min[k]) / 2.0
    };
    let dim = bounds[0].min.len();
    let extent = |k: usize| {
        let (min, max) = leaves.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), &leaf| {
            let x = middle(leaf, k);
            (f64::min(min, x), f64::max(max, x))
        });
        max - min
    };
    let longest =
        (0..dim).map(|k| (extent(k), k)).fold((f64::NEG_INFINITY, 0), |a, b| if b.0 > a.0 { b } else { a }).1;
    let half = leaves.len() / 2;
    if leaves.len() > 1 {
        let key = |&leaf: &u32| (middle(leaf, longest), leaf);
        leaves.select_nth_unstable_by(half, |a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        });
    }
    leaves.split_at_mut(half)
}
