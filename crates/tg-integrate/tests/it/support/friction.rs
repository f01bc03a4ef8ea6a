//! A mass of 1 kg with dry friction of 1 N: a switch that chatters once the mass has come to rest.

use tg_model::{At, Entry, Features, HessianEntry, Mechanics, Sizes};

pub(crate) struct Friction;

const MASS: [Entry; 1] = [Entry { row: 0, col: 0, value: 1.0 }];

impl Mechanics for Friction {
    fn sizes(&self) -> Sizes {
        Sizes { coordinates: 1, constraints: 0, inputs: 0, switches: 1 }
    }
    fn features(&self) -> Features {
        Features { damping: true, ..Features::default() }
    }
    fn free(&self) -> &[usize] {
        &[0]
    }
    fn mass(&self) -> &[Entry] {
        &MASS
    }
    fn stiffness_pattern(&self) -> &[(usize, usize)] {
        &[]
    }
    fn damping_pattern(&self) -> &[(usize, usize)] {
        &[]
    }
    fn jacobian_pattern(&self) -> &[(usize, usize)] {
        &[]
    }
    fn constraint_hessian(&self) -> &[HessianEntry] {
        &[]
    }
    fn constraint_scales(&self) -> &[f64] {
        &[]
    }
    fn size(&self) -> f64 {
        1.0
    }
    fn prescribe(&self, _: f64, _: &mut [f64], _: &mut [f64]) {}
    fn prescribed_acceleration(&self, _: f64, _: &mut [f64]) {}
    fn inputs(&self, _: f64, _: &mut [f64]) {}
    fn force(&self, at: At<'_>, f: &mut [f64]) {
        let forward = at.taut.map_or(at.v[0] > 0.0, |taut| taut[0]);
        f[0] = if forward { -1.0 } else { 1.0 };
    }
    fn stiffness(&self, _: At<'_>, _: &mut [f64]) {}
    fn damping(&self, _: At<'_>, _: &mut [f64]) {}
    fn constraints(&self, _: &[f64], _: &mut [f64]) {}
    fn jacobian(&self, _: &[f64], _: &mut [f64]) {}
    fn active_set(&self, at: At<'_>, taut: &mut [bool]) {
        taut[0] = at.v[0] > 0.0;
    }
    fn potential(&self, _: &[f64], _: &[f64]) -> f64 {
        0.0
    }
    fn force_scale(&self, _: At<'_>) -> f64 {
        1.0
    }
}
