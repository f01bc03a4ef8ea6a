//! What the motion adds to the second derivative of the constraints: `Φ̈ = A q̈ + Ȧ q̇`.
//!
//! ```text
//! (Ȧ q̇)_c = Σ_ab (∂²Φ_c/∂q_a ∂q_b) q̇_a q̇_b
//! ```
//! Φ is quadratic in natural coordinates, so the second derivatives are constant: one flat list, sorted by constraint, each
//! pair of coordinates once.

use std::collections::BTreeMap;

use tg_model::Mechanics;

/// The second derivatives of Φ as a quadratic form in q̇, one for each constraint.
pub(crate) struct Curvature {
    /// First term of each constraint, and the end of all.
    start: Vec<u32>,
    terms: Vec<Term>,
}

struct Term {
    a: u32,
    b: u32,
    value: f64,
}

impl Curvature {
    pub(crate) fn new(mechanics: &dyn Mechanics) -> Self {
        let mut sums = BTreeMap::<(usize, usize, usize), f64>::new();
        for entry in mechanics.constraint_hessian() {
            let (a, b) = (entry.row.min(entry.col), entry.row.max(entry.col));
            *sums.entry((entry.constraint, a, b)).or_default() += entry.value;
        }
        sums.retain(|_, value| *value != 0.0);
        let mut start = vec![0; mechanics.sizes().constraints + 1];
        for (constraint, _, _) in sums.keys() {
            start[constraint + 1] += 1;
        }
        for c in 1..start.len() {
            start[c] += start[c - 1];
        }
        let term = |((_, a, b), value)| Term { a: a as u32, b: b as u32, value };
        Self { start, terms: sums.into_iter().map(term).collect() }
    }

    /// Writes -Ȧ q̇, one number for each constraint; v is full.
    pub(crate) fn negative_rate(&self, v: &[f64], out: &mut [f64]) {
        for (bounds, out) in self.start.windows(2).zip(out) {
            let mut sum = 0.0;
            for term in &self.terms[bounds[0] as usize..bounds[1] as usize] {
                sum += term.value * v[term.a as usize] * v[term.b as usize];
            }
            *out = -sum;
        }
    }
}
