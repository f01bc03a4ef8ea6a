//! Cables of one law: forces and tangents.
//!
//! ```text
//! l = J q,  l = |l|,  l̂ = l / l,  l̇ = l̂·(J q̇)                                        (26), (27)
//! F = -Jᵀ l̂ f                                                                          (28)
//! -∂F/∂q = Jᵀ [ (f/l)(I - l̂ l̂ᵀ) + f_l l̂ l̂ᵀ + (f_l̇/l) l̂ (L̇ - l̇ l̂)ᵀ ] J,  L̇ = J q̇   (B.3), exact damping term
//! -∂F/∂q̇ = Jᵀ f_l̇ l̂ l̂ᵀ J                                                               (B.4)
//! ```
//! The last line of (B.3) as printed is not the derivative of the line before it when η l̇ ≠ 0; this is.

use nalgebra::{SMatrix, SVector};

use crate::form::{Form, Forms};
use crate::law::Tension;
use crate::mechanics::At;
use crate::tension::Law;

/// Cables of one law and one kind of form, structure of arrays.
#[derive(Clone, Debug)]
pub(crate) struct CableSet<L, F> {
    forms: F,
    laws: Vec<L>,
    /// Input that is the rest length (the cable's id).
    input: Vec<u32>,
    /// Switch, where the law has one.
    switch: Vec<u32>,
    /// Node pairs with a tangent, cable by cable: `w_a w_b` and the pair.
    pair_start: Vec<u32>,
    pairs: Vec<(f64, u32, u32)>,
}

impl<L, F: Forms> Default for CableSet<L, F> {
    fn default() -> Self {
        Self {
            forms: F::default(),
            laws: Vec::new(),
            input: Vec::new(),
            switch: Vec::new(),
            pair_start: vec![0],
            pairs: Vec::new(),
        }
    }
}

/// Direction, length and rates of one cable.
pub(crate) struct Line<const D: usize> {
    direction: SVector<f64, D>,
    length: f64,
    rate: f64,
    /// L̇ = J q̇.
    velocity: SVector<f64, D>,
}

impl<L: Law, F: Forms> CableSet<L, F> {
    pub(crate) fn push<const D: usize>(
        &mut self,
        id: usize,
        switch: usize,
        form: &Form<D>,
        law: L,
        pairs: impl Fn(usize, usize) -> bool,
    ) {
        self.forms.push(form);
        self.laws.push(law);
        self.input.push(id as u32);
        self.switch.push(switch as u32);
        for &(a, wa) in form.terms() {
            for &(b, wb) in form.terms() {
                if pairs(a, b) {
                    self.pairs.push((wa * wb, a as u32, b as u32));
                }
            }
        }
        self.pair_start.push(self.pairs.len() as u32);
    }

    pub(crate) fn damped(&self) -> bool {
        L::damped(&self.laws)
    }

    #[inline(always)]
    fn line<const D: usize>(&self, i: usize, at: At<'_>, with_velocity: bool) -> Line<D> {
        let l = self.forms.eval::<D>(i, at.q);
        let length = l.norm();
        let direction = l / length;
        if with_velocity {
            let velocity = self.forms.eval::<D>(i, at.v);
            Line { direction, length, rate: direction.dot(&velocity), velocity }
        } else {
            Line { direction, length, rate: 0.0, velocity: SVector::zeros() }
        }
    }

    #[inline(always)]
    fn tension<const D: usize>(&self, i: usize, line: &Line<D>, at: At<'_>) -> Tension {
        self.laws[i].tension(line.length, line.rate, at.u[self.input[i] as usize], self.taut(i, at))
    }

    /// What a given active set says of a cable.
    #[inline(always)]
    fn taut(&self, i: usize, at: At<'_>) -> Option<bool> {
        at.taut.map(|flags| flags.get(self.switch[i] as usize).copied().unwrap_or(true))
    }

    pub(crate) fn force<const D: usize>(&self, at: At<'_>, f: &mut [f64]) {
        let damped = self.damped();
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, damped);
            let tension = self.tension(i, &line, at).force;
            if tension != 0.0 {
                self.forms.spread(i, &(line.direction * -tension), f);
            }
        }
    }

    pub(crate) fn tangent<const D: usize>(
        &self,
        at: At<'_>,
        values: &mut std::slice::IterMut<'_, f64>,
        block: impl Fn(&Line<D>, &Tension) -> SMatrix<f64, D, D>,
    ) {
        let damped = self.damped();
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, damped);
            let tension = self.tension(i, &line, at);
            let block = if tension == Tension::default() { SMatrix::zeros() } else { block(&line, &tension) };
            self.spread_block(i, &block, values);
        }
    }

    /// Tangent blocks of given tensions, one per cable of the structure, without elasticity.
    pub(crate) fn geometric<const D: usize>(
        &self,
        at: At<'_>,
        tension: &[f64],
        values: &mut std::slice::IterMut<'_, f64>,
    ) {
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, false);
            let force = tension[self.input[i] as usize];
            let block = stiffness_block(&line, &Tension { force, by_length: 0.0, by_rate: 0.0 });
            self.spread_block(i, &block, values);
        }
    }

    /// The block spread by the products of weights, in the entry order of the pattern.
    fn spread_block<const D: usize>(
        &self,
        i: usize,
        block: &SMatrix<f64, D, D>,
        values: &mut std::slice::IterMut<'_, f64>,
    ) {
        for &(w, _, _) in &self.pairs[self.pair_start[i] as usize..self.pair_start[i + 1] as usize] {
            for r in 0..D {
                for (c, value) in (0..D).zip(&mut *values) {
                    *value = w * block[(r, c)];
                }
            }
        }
    }

    pub(crate) fn pattern<const D: usize>(&self, pattern: &mut Vec<(usize, usize)>) {
        for &(_, a, b) in &self.pairs {
            for r in 0..D {
                for c in 0..D {
                    pattern.push((a as usize * D + r, b as usize * D + c));
                }
            }
        }
    }

    pub(crate) fn active_set<const D: usize>(&self, at: At<'_>, taut: &mut [bool]) {
        let damped = self.damped();
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, damped);
            let rest = at.u[self.input[i] as usize];
            taut[self.switch[i] as usize] = self.laws[i].taut(line.length, line.rate, rest);
        }
    }

    pub(crate) fn energy<const D: usize>(&self, q: &[f64], u: &[f64]) -> f64 {
        (0..self.laws.len())
            .map(|i| self.laws[i].energy(self.forms.eval::<D>(i, q).norm(), u[self.input[i] as usize]))
            .sum()
    }
}

pub(crate) fn stiffness_block<const D: usize>(line: &Line<D>, tension: &Tension) -> SMatrix<f64, D, D> {
    let n = &line.direction;
    let density = tension.force / line.length;
    let mut block = n * ((tension.by_length - density) * n).transpose();
    if tension.by_rate != 0.0 {
        block += n * ((line.velocity - n * line.rate) * (tension.by_rate / line.length)).transpose();
    }
    for d in 0..D {
        block[(d, d)] += density;
    }
    block
}

pub(crate) fn damping_block<const D: usize>(line: &Line<D>, tension: &Tension) -> SMatrix<f64, D, D> {
    line.direction * (line.direction * tension.by_rate).transpose()
}
