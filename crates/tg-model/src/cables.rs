//! All cables of a structure, partitioned by law and by kind of form so that no loop branches per cable.

use std::sync::Arc;

use crate::cable_set::{CableSet, damping_block, stiffness_block};
use crate::form::{Form, FormList, Forms, NodePairs};
use crate::law::CableLaw;
use crate::mechanics::At;
use crate::placed::Cable;
use crate::tension::{Law, LinearLaw, UserLaw};

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

/// All cables that touch a free coordinate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cables {
    between_nodes: Laws<NodePairs>,
    between_points: Laws<FormList>,
    /// Cable of each switch.
    switches: Vec<usize>,
}

/// Cables of one kind of form, one set per law.
#[derive(Clone, Debug, Default)]
struct Laws<F: Forms> {
    linear: CableSet<LinearLaw<false, false>, F>,
    linear_damped: CableSet<LinearLaw<false, true>, F>,
    slacking: CableSet<LinearLaw<true, false>, F>,
    slacking_damped: CableSet<LinearLaw<true, true>, F>,
    user: CableSet<UserLaw, F>,
}

/// Calls a method on each set in turn, in the one order that fixes all entry orders.
macro_rules! each_set {
    ($cables:expr, |$set:ident| $body:expr) => {{
        each_set!($cables.between_nodes, [linear, linear_damped, slacking, slacking_damped, user], |$set| $body);
        each_set!($cables.between_points, [linear, linear_damped, slacking, slacking_damped, user], |$set| $body);
    }};
    ($laws:expr, [$($law:ident),*], |$set:ident| $body:expr) => {
        $(
            let $set = &$laws.$law;
            $body;
        )*
    };
}

impl Cables {
    /// The cables of a structure that touch a free coordinate; their tangents reach the free nodes.
    pub(crate) fn of<const D: usize>(list: &[Cable<D>], is_free: impl Fn(usize) -> bool) -> Self {
        let moves = |node: usize| (node * D..node * D + D).any(&is_free);
        let mut sets = Self::default();
        for (id, cable) in list.iter().enumerate() {
            if cable.form.terms().iter().any(|&(node, _)| moves(node)) {
                sets.push(id, &cable.form, &cable.law, |a, b| moves(a) && moves(b));
            }
        }
        sets
    }

    /// Adds cable `id`, whose rest length is input `id`; `l = form(q)`. `pairs` says which node pairs have a tangent.
    fn push<const D: usize>(
        &mut self,
        id: usize,
        form: &Form<D>,
        law: &CableLaw,
        pairs: impl Fn(usize, usize) -> bool,
    ) {
        let switch = self.switches.len();
        if let CableLaw::Slacking { .. } = law {
            self.switches.push(id);
        }
        match NodePairs::ends(form) {
            Some(_) => self.between_nodes.push(id, switch, form, law, pairs),
            None => self.between_points.push(id, switch, form, law, pairs),
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

    /// As [`Cables::stiffness`] with these tensions (one per cable) and no elasticity.
    pub(crate) fn geometric_stiffness<const D: usize>(
        &self,
        at: At<'_>,
        tension: &[f64],
        values: &mut [f64],
    ) {
        let mut values = values.iter_mut();
        each_set!(self, |set| set.geometric::<D>(at, tension, &mut values));
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
        self.between_nodes.slacking.active_set::<D>(at, taut);
        self.between_nodes.slacking_damped.active_set::<D>(at, taut);
        self.between_points.slacking.active_set::<D>(at, taut);
        self.between_points.slacking_damped.active_set::<D>(at, taut);
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

impl<F: Forms> Laws<F> {
    fn push<const D: usize>(
        &mut self,
        id: usize,
        switch: usize,
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
            CableLaw::Slacking { stiffness, damping: 0.0 } => {
                self.slacking.push(id, switch, form, LinearLaw { stiffness, damping: 0.0 }, pairs);
            }
            CableLaw::Slacking { stiffness, damping } => {
                self.slacking_damped.push(id, switch, form, LinearLaw { stiffness, damping }, pairs);
            }
            CableLaw::User(ref law) => self.user.push(id, 0, form, UserLaw(Arc::clone(law)), pairs),
        }
    }
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
    // Without length there is no direction: whichever way the ends part, the length grows as fast as they do.
    let velocity = form.eval(v);
    let rate = if length > 0.0 { l.dot(&velocity) / length } else { velocity.norm() };
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
