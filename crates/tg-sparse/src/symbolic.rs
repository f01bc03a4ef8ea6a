//! Symbolic factorisation: fronts of the multifrontal method (Duff and Reid 1983; Liu 1992).
//!
//! A *front* eliminates `width` consecutive positions whose rows have one pattern: the positions themselves, then the
//! `rest`, r later positions. Its numbers are a panel of `width` rows, each `[U row: width + r | L column: r]`, and an
//! update matrix r × r that its parent adds to itself. Update matrices live on two stacks, by the parity of the depth
//! in the tree of fronts: a front reads its children's from one and writes its own to the other.

use crate::elimination_tree::{EliminationTree, NONE};
use crate::order::Rows;
use std::ops::Range;

/// One front.
#[derive(Clone, Debug)]
pub(crate) struct Front {
    /// First position that it eliminates.
    pub(crate) first: usize,
    /// How many it eliminates.
    pub(crate) width: usize,
    /// Range in [`Symbolic::rest`].
    pub(crate) rest: Range<usize>,
    /// Offset of its panel, `width · (width + 2r)` numbers.
    pub(crate) panel: usize,
    /// Which stack its update matrix lies on.
    pub(crate) even: bool,
    /// Offset of the update matrix in that stack.
    pub(crate) update: usize,
    /// Range in [`Symbolic::children`].
    pub(crate) children: Range<usize>,
}

impl Front {
    /// r, the number of later positions in its rows.
    pub(crate) fn rest_len(&self) -> usize {
        self.rest.end - self.rest.start
    }

    /// Length of a panel row.
    pub(crate) fn stride(&self) -> usize {
        self.width + 2 * self.rest_len()
    }
}

/// Fronts in elimination order (children before parents), with the final order of the matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Symbolic {
    /// Position → variable.
    pub(crate) order: Vec<u32>,
    pub(crate) fronts: Vec<Front>,
    /// Later positions of each front, ascending.
    pub(crate) rest: Vec<u32>,
    /// Where each of them stands in the rows of the parent front.
    pub(crate) relative: Vec<u32>,
    /// Children of each front, by index of front.
    pub(crate) children: Vec<u32>,
    /// Total length of the panels.
    pub(crate) panel_len: usize,
    /// Length of the stacks of update matrices: odd depths, even depths.
    pub(crate) stack_len: [usize; 2],
    /// Longest front: width + r.
    pub(crate) longest: usize,
    /// Entries of L and U, diagonal counted once, with the zeros that merged fronts store.
    pub(crate) factor_entries: usize,
    /// Multiplications of one factorisation, zeros included.
    pub(crate) multiplications: f64,
}

/// A front while fronts are merged.
#[derive(Clone, Default)]
struct Node {
    columns: Vec<u32>,
    rest: usize,
    children: Vec<u32>,
}

impl Symbolic {
    /// `matrix`: symmetric pattern in the positions of `order`; `order`: position → variable.
    pub(crate) fn new(matrix: &Rows, order: &[u32]) -> Self {
        let tree = EliminationTree::new(matrix);
        let nodes = merge_fronts(equal_pattern_fronts(&tree));
        let (fronts, positions) = number_columns(&nodes);
        let final_order: Vec<u32> = positions.iter().map(|&new| tree.postorder[new as usize]).collect();
        let mut symbolic = Self {
            order: final_order.iter().map(|&old| order[old as usize]).collect(),
            fronts,
            ..Self::default()
        };
        symbolic.find_rests(matrix, &final_order);
        symbolic.place();
        symbolic
    }

    /// The front that eliminates a position.
    pub(crate) fn front_of(&self, position: usize) -> usize {
        self.fronts.partition_point(|front| front.first <= position) - 1
    }

    /// Rests, children and relative positions. `old`: position → row of `matrix`.
    fn find_rests(&mut self, matrix: &Rows, old: &[u32]) {
        let n = old.len();
        let mut position = vec![0_u32; n];
        for (new, &row) in old.iter().enumerate() {
            position[row as usize] = new as u32;
        }
        let mut front_of = vec![0_u32; n];
        for (s, front) in self.fronts.iter().enumerate() {
            front_of[front.first..front.first + front.width].fill(s as u32);
        }
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); self.fronts.len()];
        let mut marked_by = vec![NONE; n];
        let mut slot = vec![0_u32; n];
        let mut found = Vec::new();
        for s in 0..self.fronts.len() {
            let Front { first, width, .. } = self.fronts[s];
            let end = first + width;
            found.clear();
            let mut visit = |i: u32| {
                if i as usize >= end && marked_by[i as usize] != s as u32 {
                    marked_by[i as usize] = s as u32;
                    found.push(i);
                }
            };
            for &row in &old[first..end] {
                for &c in matrix.row(row as usize) {
                    visit(position[c as usize]);
                }
            }
            for &child in &children[s] {
                self.rest[self.fronts[child as usize].rest.clone()].iter().for_each(|&i| visit(i));
            }
            found.sort_unstable();
            for (at, &i) in found.iter().enumerate() {
                slot[i as usize] = (width + at) as u32;
            }
            for &child in &children[s] {
                for at in self.fronts[child as usize].rest.clone() {
                    let i = self.rest[at] as usize;
                    self.relative[at] = if i < end { (i - first) as u32 } else { slot[i] };
                }
            }
            let start = self.rest.len();
            self.rest.extend_from_slice(&found);
            self.relative.resize(self.rest.len(), 0);
            self.fronts[s].rest = start..self.rest.len();
            let start = self.children.len();
            self.children.extend_from_slice(&children[s]);
            self.fronts[s].children = start..self.children.len();
            if let Some(&next) = found.first() {
                children[front_of[next as usize] as usize].push(s as u32);
            }
        }
    }

    /// Offsets of panels and update matrices, sizes.
    fn place(&mut self) {
        let mut even = vec![true; self.fronts.len()];
        for s in (0..self.fronts.len()).rev() {
            for at in self.fronts[s].children.clone() {
                even[self.children[at] as usize] = !even[s];
            }
        }
        let mut top = [0_usize; 2];
        for (s, &even) in even.iter().enumerate() {
            for at in self.fronts[s].children.clone() {
                let child = &self.fronts[self.children[at] as usize];
                top[usize::from(child.even)] -= child.rest_len() * child.rest_len();
            }
            let front = &mut self.fronts[s];
            let (w, r) = (front.width, front.rest_len());
            front.even = even;
            front.panel = self.panel_len;
            front.update = top[usize::from(even)];
            top[usize::from(even)] += r * r;
            self.panel_len += w * (w + 2 * r);
            self.factor_entries += w * (w + 2 * r);
            self.longest = self.longest.max(w + r);
            self.multiplications += multiplications(w, r);
            for (length, &top) in self.stack_len.iter_mut().zip(&top) {
                *length = (*length).max(top);
            }
        }
    }
}

/// Multiplications of eliminating w rows of a dense front of order w + r.
fn multiplications(w: usize, r: usize) -> f64 {
    let square = |k: f64| k * (k + 1.0) * (2.0 * k + 1.0) / 6.0;
    let (w, r) = (w as f64, r as f64);
    square(w + r - 1.0) - square(r - 1.0)
}

/// Time of a front in units of one multiplication and subtraction, fitted to measured runs: a fixed part, the panel's
/// and the update matrix' traffic, and the arithmetic. Only speed depends on it.
fn cost(w: usize, r: usize) -> f64 {
    let (width, rest) = (w as f64, r as f64);
    COST_FRONT + COST_PANEL * width * (width + 2.0 * rest) + COST_UPDATE * rest * rest + multiplications(w, r)
}

const COST_FRONT: f64 = 30.0;
const COST_PANEL: f64 = 2.0;
const COST_UPDATE: f64 = 3.0;

/// Maximal runs of columns in which each has the pattern of the next and the next itself.
fn equal_pattern_fronts(tree: &EliminationTree) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut node_of = vec![0_u32; tree.parent.len()];
    for j in 0..tree.parent.len() {
        let joins = j > 0 && tree.parent[j - 1] == j as u32 && tree.count[j - 1] == tree.count[j] + 1;
        match nodes.last_mut() {
            Some(node) if joins => node.columns.push(j as u32),
            _ => nodes.push(Node { columns: vec![j as u32], ..Node::default() }),
        }
        node_of[j] = nodes.len() as u32 - 1;
        if let Some(node) = nodes.last_mut() {
            node.rest = tree.count[j] as usize;
        }
    }
    for s in 0..nodes.len() {
        let parent = nodes[s].columns.last().map_or(NONE, |&last| tree.parent[last as usize]);
        if parent != NONE {
            nodes[node_of[parent as usize] as usize].children.push(s as u32);
        }
    }
    nodes
}

/// Merges a front into its parent where the zeros that this stores cost less than a front more. Merged nodes are left
/// without columns.
fn merge_fronts(mut nodes: Vec<Node>) -> Vec<Node> {
    for p in 0..nodes.len() {
        let mut candidates = std::mem::take(&mut nodes[p].children);
        let mut kept = Vec::new();
        while let Some(c) = candidates.pop() {
            let child = &nodes[c as usize];
            let (wc, rc) = (child.columns.len(), child.rest);
            let (wp, rp) = (nodes[p].columns.len(), nodes[p].rest);
            if cost(wc + wp, rp) < cost(wc, rc) + cost(wp, rp) {
                let child = std::mem::take(&mut nodes[c as usize]);
                nodes[p].columns.extend(child.columns);
                candidates.extend(child.children);
            } else {
                kept.push(c);
            }
        }
        kept.sort_unstable();
        nodes[p].children = kept;
        nodes[p].columns.sort_unstable();
    }
    nodes
}

/// Postorder of the merged fronts: (fronts with their columns numbered in sequence, new position → tree position).
fn number_columns(nodes: &[Node]) -> (Vec<Front>, Vec<u32>) {
    let mut is_child = vec![false; nodes.len()];
    for &c in nodes.iter().flat_map(|node| &node.children) {
        is_child[c as usize] = true;
    }
    let mut stack: Vec<u32> = (0..nodes.len())
        .filter(|&s| !is_child[s] && !nodes[s].columns.is_empty())
        .map(|s| s as u32)
        .collect();
    let mut sequence = Vec::with_capacity(nodes.len());
    while let Some(s) = stack.pop() {
        sequence.push(s);
        stack.extend_from_slice(&nodes[s as usize].children);
    }
    sequence.reverse();
    let mut positions = Vec::new();
    let mut fronts = Vec::with_capacity(sequence.len());
    for s in sequence {
        let columns = &nodes[s as usize].columns;
        fronts.push(Front {
            first: positions.len(),
            width: columns.len(),
            rest: 0..0,
            panel: 0,
            even: true,
            update: 0,
            children: 0..0,
        });
        positions.extend_from_slice(columns);
    }
    (fronts, positions)
}
