//! Everything that depends on time: prescribed coordinates q̃(t) and inputs u(t).
//!
//! Inputs are the rest lengths of all cables, then the components of each load: D of a force, 1 or 3 of a moment in the
//! plane or in space, 2 of a universal joint's moments.

use crate::parts::Parts;
use crate::signal::Signal;

/// What prescribes a coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Prescription {
    /// An anchor that no support moves.
    AtRest,
    /// The support with this index.
    By(usize),
}

#[derive(Clone, Debug)]
pub(crate) struct Drive {
    /// Prescribed coordinates that do not move, with their values.
    held: Vec<(usize, f64)>,
    /// Prescribed coordinates that move: initial value plus signal.
    moved: Vec<(usize, f64, Signal)>,
    /// All inputs; driven ones hold their value at t = 0.
    inputs: Vec<f64>,
    /// Driven inputs: index, factor, signal.
    driven: Vec<(usize, f64, Signal)>,
}

impl Drive {
    /// `prescribed` says of each coordinate whether and by what it is prescribed; `q` holds the positions that
    /// supports' offsets count from.
    pub(crate) fn new<const D: usize>(
        parts: &Parts<D>,
        prescribed: &[Option<Prescription>],
        q: &[f64],
    ) -> Self {
        let (mut held, mut moved) = (Vec::new(), Vec::new());
        for (i, prescription) in prescribed.iter().enumerate() {
            let offset = match *prescription {
                None => continue,
                Some(Prescription::AtRest) => Signal::Constant(0.0),
                Some(Prescription::By(s)) => parts.supports[s].offset.clone(),
            };
            match offset.constant() {
                Some(offset) => held.push((i, q[i] + offset)),
                None => moved.push((i, q[i], offset)),
            }
        }
        let rests = parts.cables.iter().map(|cable| (1.0, &cable.rest));
        let loads = parts.loads.iter().flat_map(|load| load.components.iter().map(|&f| (f, &load.factor)));
        let (mut inputs, mut driven) = (Vec::new(), Vec::new());
        for (i, (factor, signal)) in rests.chain(loads).enumerate() {
            inputs.push(factor * signal.at(0.0).0);
            if signal.constant().is_none() {
                driven.push((i, factor, signal.clone()));
            }
        }
        Self { held, moved, inputs, driven }
    }

    pub(crate) fn prescribe(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        for &(i, value) in &self.held {
            (q[i], v[i]) = (value, 0.0);
        }
        for (i, base, signal) in &self.moved {
            let (value, rate) = signal.at(t);
            (q[*i], v[*i]) = (base + value, rate);
        }
    }

    pub(crate) fn prescribed_acceleration(&self, t: f64, a: &mut [f64]) {
        for &(i, _) in &self.held {
            a[i] = 0.0;
        }
        for (i, _, signal) in &self.moved {
            a[*i] = signal.acceleration(t);
        }
    }

    pub(crate) fn inputs(&self, t: f64, u: &mut [f64]) {
        u.copy_from_slice(&self.inputs);
        for (i, factor, signal) in &self.driven {
            let value = factor * signal.at(t).0;
            // Infinity would pass for a cable that is slack for ever.
            u[*i] = if value.is_finite() { value } else { f64::NAN };
        }
    }

    pub(crate) fn input_count(&self) -> usize {
        self.inputs.len()
    }

    pub(crate) fn moves_supports(&self) -> bool {
        !self.moved.is_empty()
    }

    pub(crate) fn drives_inputs(&self) -> bool {
        !self.driven.is_empty()
    }
}
