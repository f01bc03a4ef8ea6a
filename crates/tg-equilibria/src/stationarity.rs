//! The polynomial system whose real solutions are the equilibria, without cleared denominators.
//!
//! ```text
//! z ∂L/∂z - z̄ ∂L/∂z̄ = 0,  z z̄ = 1      each angle whose z and z̄ are unknowns
//! ∂L/∂y = 0,  c = 0                      the other unknowns and norms c,  L = V - ½ Σ λ c
//! u_j² g_j = 1                           each spring with a free length: u = ±1/d
//! ```
//! A spring without free length needs no u. Rest lengths μ are the parameters of the family.

use tg_homotopy::{Conjugation, Grouping, Polynomial, PolynomialSystem, SystemBuilder};
use tg_model::{Model, Tensioned};

use crate::coordinates::Coordinates;
use crate::error::EquilibriaError;
use crate::potential::Potential;
use crate::unknowns::{Norm, Unknowns};
use crate::variable::Kind;

/// A system with what is needed to read its solutions. Unknowns are y, then the u, then multipliers.
pub(crate) struct Stationarity<const D: usize> {
    pub(crate) unknowns: Unknowns<D>,
    pub(crate) system: PolynomialSystem,
    /// What real means: conjugation, with its exchange of unknowns.
    pub(crate) conjugation: Conjugation,
    /// The system that conjugation maps to itself to the last bit, for certificates.
    pub(crate) symmetric: PolynomialSystem,
    /// Inputs that are parameters: rest lengths of cables with a free length, in the order of the u, then loads.
    pub(crate) inputs: Vec<usize>,
    /// Number of cables with a free length.
    springs: usize,
    /// Inputs without effect.
    pub(crate) idle: Vec<usize>,
    /// Partitions of the unknowns to choose a start system from.
    pub(crate) groupings: Vec<Grouping>,
}

impl<const D: usize> Stationarity<D> {
    /// The system of a structure whose cables with rest lengths other than zero in `u` have a free length.
    pub(crate) fn new(model: &Model<D>, u: &[f64]) -> Result<Self, EquilibriaError> {
        let coordinates = Coordinates::new(model)?;
        let mut b = SystemBuilder::new();
        let unknowns = Unknowns::new(&coordinates, &mut b);
        let potential = Potential::new(model, &unknowns, u)?;
        let y = unknowns.y.len();

        let mut inputs = Vec::new();
        let mut slopes: Vec<Polynomial> = (0..y).map(|k| -potential.work.derivative(k)).collect();
        let mut lengths = Vec::new();
        for spring in &potential.springs {
            let mut density = Polynomial::constant(0.5 * spring.stiffness);
            if u[spring.cable] != 0.0 {
                let inverse =
                    b.unknown(format!("1/length of {}", Tensioned::cable_name(model, spring.cable)));
                let rest = b.parameter(model.input_name(spring.cable));
                density = &density * (1.0 - rest * &inverse);
                lengths.push(&(&inverse * &inverse) * &spring.square - 1.0);
                inputs.push(spring.cable);
            }
            for (k, slope) in slopes.iter_mut().enumerate() {
                *slope = &*slope + &density * spring.square.derivative(k);
            }
        }

        let springs = inputs.len();
        for (input, work) in &potential.loads {
            let load = b.parameter(model.input_name(*input));
            for (k, slope) in slopes.iter_mut().enumerate() {
                *slope = &*slope - &load * work.derivative(k);
            }
            inputs.push(*input);
        }

        let mut multipliers = 0;
        for norm in unknowns.norms.iter().filter(|norm| norm.angle.is_none() && norm.constraint.degree() > 0)
        {
            let half = 0.5 * b.unknown(format!("multiplier of the {}", norm.name));
            for (k, slope) in slopes.iter_mut().enumerate() {
                *slope = &*slope - &half * norm.constraint.derivative(k);
            }
            multipliers += 1;
        }
        for equation in equations(&unknowns, slopes).into_iter().chain(lengths) {
            b.equation(equation);
        }
        let system = b.build()?;
        let conjugation = Conjugation::exchanging(&system, &unknowns.conjugates, &[])?;
        let symmetric = system.symmetrized(&conjugation)?;
        let groupings = groupings(&unknowns.blocks, y, springs, multipliers)?;
        Ok(Self {
            unknowns,
            system,
            conjugation,
            symmetric,
            inputs,
            springs,
            idle: potential.idle,
            groupings,
        })
    }

    /// Cables with a free length, in the order of their u.
    pub(crate) fn springs(&self) -> &[usize] {
        &self.inputs[..self.springs]
    }

    /// Of the space of configurations, a product of circles (0), spheres (2) and rotation groups (0), where it is one and
    /// the potential is smooth: what the indices of all equilibria add up to.
    pub(crate) fn euler_characteristic(&self) -> Option<i64> {
        let unknowns = &self.unknowns;
        let placed: usize = unknowns.norms.iter().map(|norm| norm.unknowns).sum();
        let smooth = self.springs == 0;
        let spheres = |norm: &Norm| if norm.unknowns == 3 { 2 } else { 0 };
        (smooth && placed == unknowns.y.len()).then(|| unknowns.norms.iter().map(spheres).product())
    }
}

/// Balance along every unknown, and the norms.
fn equations<const D: usize>(unknowns: &Unknowns<D>, slopes: Vec<Polynomial>) -> Vec<Polynomial> {
    let y = &unknowns.y;
    let mut equations = Vec::new();
    let mut in_angle = vec![false; y.len()];
    for Norm { constraint, angle, .. } in &unknowns.norms {
        if let Some([z, conjugate]) = *angle {
            equations.push(&y[z] * &slopes[z] - &y[conjugate] * &slopes[conjugate]);
            (in_angle[z], in_angle[conjugate]) = (true, true);
        }
        if constraint.degree() > 0 {
            equations.push(constraint.clone());
        }
    }
    equations.extend(slopes.into_iter().zip(in_angle).filter(|(_, done)| !done).map(|(slope, _)| slope));
    equations
}

/// Partitions of the unknowns: those of one kind together or apart, each u for itself or all together, multipliers too.
fn groupings(
    blocks: &[(Kind, Vec<usize>)],
    y: usize,
    springs: usize,
    multipliers: usize,
) -> Result<Vec<Grouping>, EquilibriaError> {
    let unknowns = y + springs + multipliers;
    let apart: Vec<Vec<usize>> = blocks.iter().map(|(_, block)| block.clone()).collect();
    let mut together: Vec<(Kind, Vec<usize>)> = Vec::new();
    for (kind, block) in blocks {
        match together.iter_mut().find(|(known, _)| known == kind) {
            Some((_, all)) => all.extend(block),
            None => together.push((*kind, block.clone())),
        }
    }
    let together: Vec<Vec<usize>> = together.into_iter().map(|(_, block)| block).collect();
    let choices = |range: std::ops::Range<usize>| {
        let each: Vec<Vec<usize>> = range.clone().map(|k| vec![k]).collect();
        if range.len() > 1 { vec![each, vec![range.collect()]] } else { vec![each] }
    };
    let mut list = vec![Grouping::single(unknowns)];
    for coordinates in [&together, &apart] {
        for inverse in choices(y..y + springs) {
            for multiplier in choices(y + springs..unknowns) {
                let groups: Vec<&[usize]> =
                    coordinates.iter().chain(&inverse).chain(&multiplier).map(Vec::as_slice).collect();
                list.push(Grouping::new(unknowns, &groups)?);
            }
        }
    }
    Ok(list)
}
