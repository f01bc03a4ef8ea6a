//! A model as [`Mechanics`]: evaluation into flat slices.

use nalgebra::SVector;

use crate::mechanics::{At, Entry, Features, HessianEntry, Mechanics, Sizes};
use crate::model::Model;
use crate::parts::axis_name;
use crate::placed::Cable;

/// Tensions below this part of κ l are not known to the twelve digits that solvers ask of a balance: l is rounded.
const RESOLVED: f64 = 1e-4;

impl<const D: usize> Mechanics for Model<D> {
    fn sizes(&self) -> Sizes {
        Sizes {
            coordinates: self.initial.len(),
            constraints: self.constraints.len(),
            inputs: self.drive.input_count(),
            switches: self.in_equations.switches().len(),
        }
    }

    fn features(&self) -> Features {
        Features {
            damping: self.in_equations.has_damping(),
            moving_supports: self.drive.moves_supports(),
            driven_inputs: self.drive.drives_inputs(),
        }
    }

    fn free(&self) -> &[usize] {
        &self.free
    }

    fn mass(&self) -> &[Entry] {
        &self.mass
    }

    fn stiffness_pattern(&self) -> &[(usize, usize)] {
        &self.stiffness_pattern
    }

    fn damping_pattern(&self) -> &[(usize, usize)] {
        &self.damping_pattern
    }

    fn jacobian_pattern(&self) -> &[(usize, usize)] {
        &self.jacobian_pattern
    }

    fn constraint_hessian(&self) -> &[HessianEntry] {
        &self.hessian
    }

    fn constraint_scales(&self) -> &[f64] {
        self.constraints.scales()
    }

    fn size(&self) -> f64 {
        self.size
    }

    fn prescribe(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        self.drive.prescribe(t, q, v);
    }

    fn prescribed_acceleration(&self, t: f64, a: &mut [f64]) {
        self.drive.prescribed_acceleration(t, a);
    }

    fn inputs(&self, t: f64, u: &mut [f64]) {
        self.drive.inputs(t, u);
    }

    fn force(&self, at: At<'_>, f: &mut [f64]) {
        f.copy_from_slice(&self.weight);
        for (form, input) in &self.forces {
            let load = SVector::<f64, D>::from_column_slice(&at.u[*input..input + D]);
            for &(node, w) in form.terms() {
                crate::form::add_to_node(f, node, &(load * w));
            }
        }
        self.moments.force(at, f);
        self.in_equations.force::<D>(at, f);
    }

    fn stiffness(&self, at: At<'_>, values: &mut [f64]) {
        let (cables, moments) = values.split_at_mut(self.cable_entries);
        self.in_equations.stiffness::<D>(at, cables);
        self.moments.stiffness(at, moments);
    }

    fn damping(&self, at: At<'_>, values: &mut [f64]) {
        self.in_equations.damping::<D>(at, values);
    }

    fn constraints(&self, q: &[f64], phi: &mut [f64]) {
        self.constraints.residual::<D>(q, phi);
    }

    fn jacobian(&self, q: &[f64], values: &mut [f64]) {
        self.constraints.jacobian::<D>(q, values);
    }

    fn active_set(&self, at: At<'_>, taut: &mut [bool]) {
        self.in_equations.active_set::<D>(at, taut);
    }

    fn potential(&self, q: &[f64], u: &[f64]) -> f64 {
        self.energy(q, &[], u).potential()
    }

    fn force_scale(&self, at: At<'_>) -> f64 {
        let tension = |(cable, rest): (&Cable<D>, &f64)| {
            let length = cable.form.eval(at.q).norm();
            let tension = cable.law.static_tension(length, *rest).abs();
            let known = RESOLVED * cable.law.linear_stiffness().unwrap_or(0.0) * length;
            // A slack cable says nothing; one that is taut and carries nothing is still known no better.
            if tension == 0.0 && length < *rest { 0.0 } else { tension.max(known) }
        };
        let tensions = self.cables.iter().zip(at.u).map(tension);
        let forces = self.forces.iter().flat_map(|(_, input)| &at.u[*input..input + D]);
        let given = forces.chain(&self.weight).map(|f| f.abs());
        tensions.chain(given).fold(self.moments.largest_force(at), f64::max)
    }

    fn coordinate_name(&self, coordinate: usize) -> String {
        format!("{} component of {}", axis_name(coordinate % D), self.node_names[coordinate / D])
    }

    fn constraint_name(&self, constraint: usize) -> String {
        self.constraint_names[constraint].clone()
    }

    fn switch_name(&self, switch: usize) -> String {
        format!("cable \"{}\"", self.cables[self.in_equations.switches()[switch]].name)
    }

    fn cables_at(&self, coordinate: usize) -> Vec<String> {
        let node = coordinate / D;
        let at_node = |terms: &[(usize, f64)]| terms.iter().any(|&(n, _)| n == node);
        let cables = self.cables.iter().filter(|cable| at_node(cable.form.terms()));
        cables.map(|cable| cable.name.clone()).collect()
    }
}
