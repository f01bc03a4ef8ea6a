//! Cables, partitioned by law, evaluated without a branch per cable.
//!
//! ```text
//! l = J q,  l = |l|,  l̂ = l / l,  l̇ = l̂·(J q̇)                                        (26), (27)
//! F = -Jᵀ l̂ f                                                                          (28)
//! -∂F/∂q = Jᵀ [ (f/l)(I - l̂ l̂ᵀ) + f_l l̂ l̂ᵀ + (f_l̇/l) l̂ (L̇ - l̇ l̂)ᵀ ] J,  L̇ = J q̇   (B.3), exact damping term
//! -∂F/∂q̇ = Jᵀ f_l̇ l̂ l̂ᵀ J                                                               (B.4)
//! ```
//! The last line of (B.3) as printed is not the derivative of the line before it when η l̇ ≠ 0; this is.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};

use crate::form::{Form, FormList};
use crate::law::{CableLaw, Tension, TensionLaw};
use crate::mechanics::At;

/// State of one cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CableState {
    /// Length l \[m\].
    pub length: f64,
    /// Rate of length l̇ \[m/s\].
    pub rate: f64,
    /// Rest length μ \[m\].
    pub rest: f64,
    /// Tension f \[N\], positive when the cable pulls.
    pub tension: f64,
    /// Whether a slacking cable is slack.
    pub slack: bool,
}

/// All cables that touch a free coordinate, one set per law.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cables {
    linear: CableSet<LinearLaw<false, false>>,
    linear_damped: CableSet<LinearLaw<false, true>>,
    slacking: CableSet<LinearLaw<true, false>>,
    slacking_damped: CableSet<LinearLaw<true, true>>,
    user: CableSet<UserLaw>,
    /// Cable of each switch.
    switches: Vec<usize>,
}

/// Calls a method on each set in turn, in the one order that fixes all entry orders.
macro_rules! each_set {
    ($cables:expr, |$set:ident| $body:expr) => {{
        let $set = &$cables.linear;
        $body;
        let $set = &$cables.linear_damped;
        $body;
        let $set = &$cables.slacking;
        $body;
        let $set = &$cables.slacking_damped;
        $body;
        let $set = &$cables.user;
        $body;
    }};
}

impl Cables {
    /// Adds cable `id`, whose rest length is input `id`; `l = form(q)`. `pairs` says which node pairs have a tangent.
    pub(crate) fn push<const D: usize>(
        &mut self,
        id: usize,
        form: &Form<D>,
        law: &CableLaw,
        pairs: impl Fn(usize, usize) -> bool,
    ) {
        match *law {
            CableLaw::Linear { stiffness, damping: 0.0 } => {
                self.linear.push(id, 0, form, LinearLaw { stiffness, damping: 0.0 }, pairs);
            }
            CableLaw::Linear { stiffness, damping } => {
                self.linear_damped.push(id, 0, form, LinearLaw { stiffness, damping }, pairs);
            }
            CableLaw::Slacking { stiffness, damping } => {
                let switch = self.switches.len();
                self.switches.push(id);
                if damping == 0.0 {
                    self.slacking.push(id, switch, form, LinearLaw { stiffness, damping }, pairs);
                } else {
                    self.slacking_damped.push(id, switch, form, LinearLaw { stiffness, damping }, pairs);
                }
            }
            CableLaw::User(ref law) => self.user.push(id, 0, form, UserLaw(Arc::clone(law)), pairs),
        }
    }

    pub(crate) fn switches(&self) -> &[usize] {
        &self.switches
    }

    pub(crate) fn force<const D: usize>(&self, at: At<'_>, f: &mut [f64]) {
        each_set!(self, |set| set.force::<D>(at, f));
    }

    pub(crate) fn stiffness<const D: usize>(&self, at: At<'_>, values: &mut [f64]) {
        let mut values = values.iter_mut();
        each_set!(self, |set| set.tangent::<D>(at, &mut values, stiffness_block));
    }

    pub(crate) fn damping<const D: usize>(&self, at: At<'_>, values: &mut [f64]) {
        let mut values = values.iter_mut();
        each_set!(self, |set| if set.damped() {
            set.tangent::<D>(at, &mut values, damping_block)
        });
    }

    pub(crate) fn stiffness_pattern<const D: usize>(&self) -> Vec<(usize, usize)> {
        let mut pattern = Vec::new();
        each_set!(self, |set| set.pattern::<D>(&mut pattern));
        pattern
    }

    pub(crate) fn damping_pattern<const D: usize>(&self) -> Vec<(usize, usize)> {
        let mut pattern = Vec::new();
        each_set!(self, |set| if set.damped() {
            set.pattern::<D>(&mut pattern)
        });
        pattern
    }

    pub(crate) fn active_set<const D: usize>(&self, at: At<'_>, taut: &mut [bool]) {
        self.slacking.active_set::<D>(at, taut);
        self.slacking_damped.active_set::<D>(at, taut);
    }

    pub(crate) fn energy<const D: usize>(&self, q: &[f64], u: &[f64]) -> f64 {
        let mut sum = 0.0;
        each_set!(self, |set| sum += set.energy::<D>(q, u));
        sum
    }

    pub(crate) fn has_damping(&self) -> bool {
        let mut damped = false;
        each_set!(self, |set| damped |= set.damped());
        damped
    }
}

/// A law as the loops see it.
trait Law {
    /// Whether a set of this law has a velocity tangent at all.
    fn damped(laws: &[Self]) -> bool
    where
        Self: Sized;
    fn tension(&self, length: f64, rate: f64, rest: f64, taut: Option<bool>) -> Tension;
    fn energy(&self, length: f64, rest: f64) -> f64;
    /// Law (30)'s choice of branch.
    fn taut(&self, length: f64, rate: f64, rest: f64) -> bool {
        let _ = (length, rate, rest);
        true
    }
}

/// κ and η; the two flags leave out what a set does not have.
#[derive(Clone, Debug)]
struct LinearLaw<const SLACKING: bool, const DAMPED: bool> {
    stiffness: f64,
    damping: f64,
}

impl<const SLACKING: bool, const DAMPED: bool> LinearLaw<SLACKING, DAMPED> {
    fn taut_tension(&self, length: f64, rate: f64, rest: f64) -> f64 {
        let elastic = self.stiffness * (length - rest);
        if DAMPED { elastic + self.damping * rate } else { elastic }
    }
}

impl<const SLACKING: bool, const DAMPED: bool> Law for LinearLaw<SLACKING, DAMPED> {
    fn damped(laws: &[Self]) -> bool {
        DAMPED && !laws.is_empty()
    }

    fn tension(&self, length: f64, rate: f64, rest: f64, taut: Option<bool>) -> Tension {
        if SLACKING && !taut.unwrap_or_else(|| self.taut(length, rate, rest)) {
            return Tension::default();
        }
        Tension {
            force: self.taut_tension(length, rate, rest),
            by_length: self.stiffness,
            by_rate: if DAMPED { self.damping } else { 0.0 },
        }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        let stretch = length - rest;
        if SLACKING && stretch < 0.0 { 0.0 } else { 0.5 * self.stiffness * stretch * stretch }
    }

    fn taut(&self, length: f64, rate: f64, rest: f64) -> bool {
        length >= rest && (!DAMPED || self.taut_tension(length, rate, rest) >= 0.0)
    }
}

/// A user's law behind the same interface.
#[derive(Clone)]
struct UserLaw(Arc<dyn TensionLaw>);

impl std::fmt::Debug for UserLaw {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("UserLaw")
    }
}

impl Law for UserLaw {
    fn damped(laws: &[Self]) -> bool {
        laws.iter().any(|law| law.0.damped())
    }

    fn tension(&self, length: f64, rate: f64, rest: f64, _taut: Option<bool>) -> Tension {
        self.0.tension(length, rate, rest)
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        self.0.energy(length, rest)
    }
}

/// Cables of one law, structure of arrays.
#[derive(Clone, Debug)]
struct CableSet<L> {
    forms: FormList,
    laws: Vec<L>,
    /// Input that is the rest length (the cable's id).
    input: Vec<u32>,
    /// Switch, where the law has one.
    switch: Vec<u32>,
    /// Node pairs with a tangent, cable by cable: `w_a w_b` and the pair.
    pair_start: Vec<u32>,
    pairs: Vec<(f64, u32, u32)>,
}

impl<L> Default for CableSet<L> {
    fn default() -> Self {
        Self {
            forms: FormList::new(),
            laws: Vec::new(),
            input: Vec::new(),
            switch: Vec::new(),
            pair_start: vec![0],
            pairs: Vec::new(),
        }
    }
}

/// Direction, length and rates of one cable.
struct Line<const D: usize> {
    direction: SVector<f64, D>,
    length: f64,
    rate: f64,
    /// L̇ = J q̇.
    velocity: SVector<f64, D>,
}

impl<L: Law> CableSet<L> {
    fn push<const D: usize>(
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

    fn damped(&self) -> bool {
        L::damped(&self.laws)
    }

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

    fn tension<const D: usize>(&self, i: usize, line: &Line<D>, at: At<'_>) -> Tension {
        let taut = at.taut.map(|flags| flags.get(self.switch[i] as usize).copied().unwrap_or(true));
        self.laws[i].tension(line.length, line.rate, at.u[self.input[i] as usize], taut)
    }

    fn force<const D: usize>(&self, at: At<'_>, f: &mut [f64]) {
        let damped = self.damped();
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, damped);
            let tension = self.tension(i, &line, at).force;
            if tension != 0.0 {
                self.forms.spread(i, &(line.direction * -tension), f);
            }
        }
    }

    fn tangent<const D: usize>(
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
            for &(w, _, _) in &self.pairs[self.pair_start[i] as usize..self.pair_start[i + 1] as usize] {
                for r in 0..D {
                    for (c, value) in (0..D).zip(&mut *values) {
                        *value = w * block[(r, c)];
                    }
                }
            }
        }
    }

    fn pattern<const D: usize>(&self, pattern: &mut Vec<(usize, usize)>) {
        for &(_, a, b) in &self.pairs {
            for r in 0..D {
                for c in 0..D {
                    pattern.push((a as usize * D + r, b as usize * D + c));
                }
            }
        }
    }

    fn active_set<const D: usize>(&self, at: At<'_>, taut: &mut [bool]) {
        let damped = self.damped();
        for i in 0..self.laws.len() {
            let line = self.line::<D>(i, at, damped);
            let rest = at.u[self.input[i] as usize];
            taut[self.switch[i] as usize] = self.laws[i].taut(line.length, line.rate, rest);
        }
    }

    fn energy<const D: usize>(&self, q: &[f64], u: &[f64]) -> f64 {
        (0..self.laws.len())
            .map(|i| self.laws[i].energy(self.forms.eval::<D>(i, q).norm(), u[self.input[i] as usize]))
            .sum()
    }
}

fn stiffness_block<const D: usize>(line: &Line<D>, tension: &Tension) -> SMatrix<f64, D, D> {
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

fn damping_block<const D: usize>(line: &Line<D>, tension: &Tension) -> SMatrix<f64, D, D> {
    line.direction * (line.direction * tension.by_rate).transpose()
}

/// State of one cable of any law, for reports; the hot loops do not come here.
pub(crate) fn cable_state<const D: usize>(
    form: &Form<D>,
    law: &CableLaw,
    rest: f64,
    q: &[f64],
    v: &[f64],
) -> CableState {
    let l = form.eval(q);
    let length = l.norm();
    let rate = l.dot(&form.eval(v)) / length;
    let (tension, slack) = match *law {
        CableLaw::Linear { stiffness, damping } => {
            let law = LinearLaw::<false, true> { stiffness, damping };
            (law.tension(length, rate, rest, None).force, false)
        }
        CableLaw::Slacking { stiffness, damping } => {
            let law = LinearLaw::<true, true> { stiffness, damping };
            (law.tension(length, rate, rest, None).force, !law.taut(length, rate, rest))
        }
        CableLaw::User(ref law) => (law.tension(length, rate, rest).force, false),
    };
    CableState { length, rate, rest, tension, slack }
}
