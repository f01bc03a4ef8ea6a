//! The span of the kept rows of `[I, −Aᵀ; A, 0]` and what lies outside of it, by sparse solves.
//!
//! A row that was taken out depends on few others. Each of its solves therefore visits only the fronts where something
//! is not zero: forward, those from the entries of the right-hand side up to the front of the row; backward, from there
//! down as long as components stay above [`TINY`].

use crate::error::Row;
use crate::pattern::SaddlePattern;
use crate::pivot::PivotRule;
use crate::refinement::stands_probe;
use crate::static_lu::StaticLu;
use std::collections::BTreeSet;

/// Pivots of kept rows below this are probed for being rounding error.
const PIVOT_WEAK: f64 = 1e-2;

/// Pivots up to this multiple of the smallest one that fails the probe go with it.
const AT_FAULT: f64 = 4.0;

/// Components below this are rounding errors: rows have length one.
const TINY: f64 = 1e-15;

/// Most steps of refinement of one solve.
const REFINEMENTS: usize = 4;

/// Refinement ends when it changes the part outside of the span by less than this, or no less than the step before.
const SETTLED: f64 = 1e-12;

/// A row that was taken out: its part outside of the span of the others, and its combination of them.
pub(crate) struct Outside {
    /// Row in the pattern's Jacobian.
    pub(crate) row: usize,
    /// (unknown's position, component), ascending.
    pub(crate) part: Vec<(u32, f64)>,
    /// (row in the pattern's Jacobian, coefficient), ascending.
    pub(crate) combination: Vec<(usize, f64)>,
}

impl Outside {
    /// Makes the part orthogonal to that of another row, which counts as independent.
    pub(crate) fn remove(&mut self, other: &Self) {
        let square: f64 = other.part.iter().map(|(_, x)| x * x).sum();
        let mut product = 0.0;
        merged(&self.part, &other.part, |_, a, b| product += a * b);
        let factor = product / square;
        if factor == 0.0 {
            return;
        }
        let mut part = Vec::with_capacity(self.part.len() + other.part.len());
        merged(&self.part, &other.part, |key, a, b| part.push((key, a - factor * b)));
        let mut combination = Vec::with_capacity(self.combination.len() + other.combination.len());
        merged(&self.combination, &other.combination, |key, a, b| combination.push((key, a - factor * b)));
        let at = combination.partition_point(|&(key, _)| key < other.row);
        combination.insert(at, (other.row, factor));
        self.part = part;
        self.combination = combination;
    }
}

/// Visits the union of two ascending sparse vectors.
fn merged<K: Copy + Ord>(a: &[(K, f64)], b: &[(K, f64)], mut visit: impl FnMut(K, f64, f64)) {
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    loop {
        let key = match (a.peek(), b.peek()) {
            (Some(&&(p, _)), Some(&&(q, _))) => p.min(q),
            (Some(&&(p, _)), None) => p,
            (None, Some(&&(q, _))) => q,
            (None, None) => return,
        };
        let take = |list: &mut std::iter::Peekable<std::slice::Iter<'_, (K, f64)>>| {
            list.next_if(|&&(k, _)| k == key).map_or(0.0, |&(_, x)| x)
        };
        visit(key, take(&mut a), take(&mut b));
    }
}

/// Factors without the rows that depend on others, and solves with them.
pub(crate) struct Span<'a> {
    pattern: &'a SaddlePattern,
    matrix: &'a [f64],
    lu: StaticLu,
    is_dropped: Vec<bool>,
    /// Zero between calls.
    solution: Vec<f64>,
    /// Zero between calls.
    work: Vec<f64>,
}

impl<'a> Span<'a> {
    /// `matrix`: values of `[I, −Aᵀ; A, 0]` with rows of length one, by slot.
    pub(crate) fn new(pattern: &'a SaddlePattern, matrix: &'a [f64]) -> Self {
        let size = pattern.size();
        Self {
            pattern,
            matrix,
            lu: StaticLu::new(&pattern.symbolic),
            is_dropped: vec![false; size],
            solution: vec![0.0; size],
            work: vec![0.0; size],
        }
    }

    /// Factors without the rows whose pivot is not above `below`, and without those that a second solve unmasks as
    /// rounding error. On failure the row without a finite pivot.
    pub(crate) fn factor(&mut self, below: f64) -> Result<(), Row> {
        loop {
            let rule = PivotRule::Drop { below, also: &self.is_dropped };
            self.lu
                .factor(self.pattern, self.matrix, rule)
                .map_err(|trouble| self.pattern.row_at(trouble.position))?;
            self.lu.dropped.iter().for_each(|&p| self.is_dropped[p as usize] = true);
            if !self.unmask() {
                return Ok(());
            }
        }
    }

    /// Marks kept rows whose small pivot is rounding error: solving for the residual changes their component as much as
    /// solving did. True when there are any.
    fn unmask(&mut self) -> bool {
        let symbolic = &self.pattern.symbolic;
        let size = symbolic.order.len();
        let weak: Vec<usize> =
            (0..size).filter(|&p| !self.is_dropped[p] && self.lu.pivot(p).pivot < PIVOT_WEAK).collect();
        if weak.is_empty() {
            return false;
        }
        let mut right = vec![0.0; size];
        weak.iter().for_each(|&p| right[p] = 1.0);
        let mut solution = right.clone();
        self.lu.solve(symbolic, &mut solution);
        let products = self.pattern.slots.products(self.matrix, &solution);
        let mut correction: Vec<f64> =
            right.iter().zip(products).map(|(b, (product, _))| b - product).collect();
        self.lu.solve(symbolic, &mut correction);
        // Rows of the same dependent set fail together; only the smallest pivots among them are at fault.
        let fails = |&&p: &&usize| !stands_probe(solution[p], correction[p]);
        let smallest =
            weak.iter().filter(fails).map(|&p| self.lu.pivot(p).pivot).fold(f64::INFINITY, f64::min);
        let at_fault = |&&p: &&usize| self.lu.pivot(p).pivot <= AT_FAULT * smallest;
        let mut found = false;
        for &p in weak.iter().filter(fails).filter(at_fault) {
            self.is_dropped[p] = true;
            found = true;
        }
        found
    }

    /// Positions taken out, by ascending row of `A`.
    pub(crate) fn dropped(&self) -> Vec<usize> {
        let order = &self.pattern.symbolic.order;
        let mut dropped: Vec<usize> = self.lu.dropped.iter().map(|&p| p as usize).collect();
        dropped.sort_unstable_by_key(|&p| order[p]);
        dropped
    }

    /// Solves `x − A_Kᵀ c = a_jᵀ, A_K x = 0` for the row at a position.
    pub(crate) fn outside(&mut self, position: usize) -> Outside {
        let pattern = self.pattern;
        let symbolic = &pattern.symbolic;
        let n = pattern.n;
        let top = symbolic.front_of(position);
        let right: Vec<(usize, f64)> = self.row(position).collect();
        let mut seeds: BTreeSet<usize> = right.iter().map(|&(at, _)| at).collect();
        right.iter().for_each(|&(at, value)| self.work[at] = value);
        let mut support = BTreeSet::new();
        let mut before = f64::INFINITY;
        for step in 0..=REFINEMENTS {
            let visited = self.solve_sparse(&seeds, top);

            let mut change = 0.0_f64;
            for at in visited {
                let d = std::mem::take(&mut self.work[at]);
                if d != 0.0 {
                    self.solution[at] += d;
                    support.insert(at);
                    if (symbolic.order[at] as usize) < n {
                        change = change.max(d.abs());
                    }
                }
            }
            if change <= SETTLED || change > 0.1 * before || step == REFINEMENTS {
                break;
            }
            before = change;
            // The residual of the next step. K_ij = −K_ji off the diagonal: rows serve as columns.
            let last = symbolic.fronts[top].first + symbolic.fronts[top].width;
            seeds = right.iter().map(|&(at, _)| at).collect();
            right.iter().for_each(|&(at, value)| self.work[at] = value);
            for &column in &support {
                let x = self.solution[column];
                let rows = &pattern.slots.rows;
                for slot in rows.start()[column]..rows.start()[column + 1] {
                    let row = rows.column()[slot] as usize;
                    if row < last && !self.is_dropped[row] {
                        let value = if row == column { self.matrix[slot] } else { -self.matrix[slot] };
                        self.work[row] -= value * x;
                        seeds.insert(row);
                    }
                }
            }
        }
        let mut part = Vec::new();
        let mut combination = Vec::new();
        for at in support {
            let x = std::mem::take(&mut self.solution[at]);
            match symbolic.order[at] as usize {
                unknown if unknown < n => part.push((at as u32, x)),
                variable => combination.push((variable - n, -x)),
            }
        }
        combination.sort_unstable_by_key(|&(row, _)| row);
        Outside { row: symbolic.order[position] as usize - n, part, combination }
    }

    /// Entries of a row of the matrix.
    fn row(&self, position: usize) -> impl Iterator<Item = (usize, f64)> {
        let rows = &self.pattern.slots.rows;
        let range = rows.start()[position]..rows.start()[position + 1];
        rows.column()[range.clone()].iter().map(|&c| c as usize).zip(self.matrix[range].iter().copied())
    }

    /// Solves in `work`, which is not zero at the seeds only, over the subtree of a front. Returns the positions visited.
    fn solve_sparse(&mut self, seeds: &BTreeSet<usize>, top: usize) -> Vec<usize> {
        let symbolic = &self.pattern.symbolic;
        let mut path = BTreeSet::from([top]);
        for &seed in seeds {
            let mut front = symbolic.front_of(seed);
            while path.insert(front) {
                front = symbolic.front_of(symbolic.rest[symbolic.fronts[front].rest.start] as usize);
            }
        }
        self.lu.forward(symbolic, path.iter().copied(), &mut self.work);
        let beyond = &symbolic.rest[symbolic.fronts[top].rest.clone()];
        beyond.iter().for_each(|&i| self.work[i as usize] = 0.0);

        let mut visited = Vec::new();
        let mut stack = vec![top];
        while let Some(at) = stack.pop() {
            let front = &symbolic.fronts[at];
            self.lu.backward(symbolic, std::iter::once(at), &mut self.work);
            let own = front.first..front.first + front.width;
            for x in &mut self.work[own.clone()] {
                if x.abs() <= TINY {
                    *x = 0.0;
                }
            }
            visited.extend(own.clone());
            let rest = symbolic.rest[front.rest.clone()].iter().map(|&i| i as usize);
            let is_zero = own.chain(rest).all(|i| self.work[i] == 0.0);
            let children = symbolic.children[front.children.clone()].iter().map(|&child| child as usize);
            stack.extend(children.filter(|child| !is_zero || path.contains(child)));
        }
        visited
    }
}
