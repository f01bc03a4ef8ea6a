//! A chain of particles along x between two walls, its closed forms, and how it is asked.

use tg_integrate::{Run, Stepper};
use tg_model::{BuildError, CableLaw, MemberId, Model, ModelBuilder};

use crate::TaskError;

/// Masses \[kg\] joined by two-way cables of 1 m \[N/m\], the first from the wall; with one cable more than masses the last
/// leads to another wall. Motions across are held.
pub(super) struct Chain {
    pub(super) model: Model<2>,
    pub(super) masses: Vec<MemberId>,
}

impl Chain {
    /// The chain with a force \[N\] along x on its last mass, every cable at its rest length.
    pub(super) fn new(masses: &[f64], stiffness: &[f64], force: f64) -> Result<Self, BuildError> {
        let mut b = ModelBuilder::<2>::new();
        let mut last = b.anchor("wall", [0.0, 0.0])?.into();
        let mut members = Vec::new();
        for (k, &stiffness) in stiffness.iter().enumerate() {
            let x = [k as f64 + 1.0, 0.0];
            let place = match masses.get(k) {
                Some(&mass) => {
                    let id = b.particle(&format!("mass {k}"), mass, x)?;
                    b.support(&format!("guide {k}"), id.node(0), 1, 0.0)?;
                    members.push(id);
                    id.node(0)
                }
                None => b.anchor("far wall", x)?.into(),
            };
            b.cable(&format!("cable {k}"), last, place, CableLaw::linear(stiffness), 1.0)?;
            last = place;
        }
        if let Some(end) = members.last() {
            b.load("pull", end.node(0), [force, 0.0], 1.0)?;
        }
        Ok(Self { model: b.build()?, masses: members })
    }

    /// Coordinate of a mass along x in q.
    pub(super) fn x(&self, mass: usize, q: &[f64]) -> f64 {
        self.model.member_nodes(self.masses[mass], q)[0].x
    }

    /// The initial coordinates with masses displaced along x.
    pub(super) fn displaced(&self, by: &[f64]) -> Vec<f64> {
        let mut q = self.model.initial_coordinates();
        for (mass, by) in self.masses.iter().zip(by) {
            q[2 * self.model.member_node_ids(*mass)[0]] += by;
        }
        q
    }
}

/// The largest distance of a quantity from its course, looked at after every step; from rest at `q`.
pub(super) fn worst_along(
    stepper: &mut dyn Stepper,
    q: &[f64],
    (step, end): (f64, f64),
    mut distance: impl FnMut(f64, &[f64]) -> f64,
) -> Result<f64, TaskError> {
    let mut state = stepper.start(0.0, q, &vec![0.0; q.len()])?;
    let mut worst = 0.0_f64;
    let mut watch = |state: &tg_integrate::State, _: &_| {
        let off = distance(state.t, &state.q).abs();
        worst = if off.is_nan() || worst.is_nan() { f64::NAN } else { worst.max(off) };
    };
    Run::new(step, end).observe(&mut watch).go(stepper, &mut state)?;
    Ok(worst)
}
