//! The nodes of a structure as affine functions of as few variables as joints and supports leave.
//!
//! ```text
//! P_a = P_0 + R (P_a - P_0)⁰   points,     P_a = R P_a⁰   base vectors of a member with rotation R
//! P = x + i y, P̄ = x - i y     in the plane
//! ```
//! Orientation is built in: a member's mirror image is no solution. Joints and supports are linear and are eliminated.

use nalgebra::{SVector, Vector3};
use tg_homotopy::Complex64;
use tg_model::{Mechanics, MemberId, Model};

use crate::affine::{Affine, Form, Obstacle};
use crate::error::EquilibriaError;
use crate::turn::{Turn, cartesian};
use crate::variable::{Kind, Rotation, Variables};

/// Vectors whose cross product is below this part of their lengths are parallel.
const PARALLEL: f64 = 1e-9;

const I: Complex64 = Complex64::new(0.0, 1.0);
const ONE: Complex64 = Complex64::new(1.0, 0.0);

/// The variables of a structure, its nodes by them, and which of them are independent. Lengths are per unit.
pub(crate) struct Coordinates<const D: usize> {
    /// The unit of length \[m\], near the structure's size, so that polynomials have coefficients of order one.
    pub(crate) unit: f64,
    pub(crate) variables: Variables,
    /// The D sides of each node.
    pub(crate) nodes: Vec<Vec<Form>>,
    pub(crate) rotations: Vec<Rotation>,
    pub(crate) affine: Affine,
}

impl<const D: usize> Coordinates<D> {
    /// The coordinates of a structure that starts from its initial configuration.
    pub(crate) fn new(model: &Model<D>) -> Result<Self, EquilibriaError> {
        let unit = model.unit();
        let q: Vec<f64> = model.initial_coordinates().iter().map(|x| x / unit).collect();
        let places: Vec<SVector<f64, D>> = q.chunks_exact(D).map(SVector::from_column_slice).collect();
        let mut is_free = vec![false; q.len()];
        model.free().iter().for_each(|&i| is_free[i] = true);
        let mut variables = Variables::default();
        let mut nodes = Vec::new();
        for (node, place) in places.iter().enumerate() {
            let free = &is_free[D * node..D * (node + 1)];
            nodes.push(node_sides(&mut variables, model.node_name(node), place, free));
        }
        let mut coordinates =
            Self { unit, variables, nodes, rotations: Vec::new(), affine: Affine::default() };
        let mut relations = Vec::new();
        for member in model.members() {
            coordinates.turn(model, member, &places, &is_free, &mut relations);
        }
        coordinates.join(model, &q, &mut relations);
        coordinates.eliminate(&relations)?;
        Ok(coordinates)
    }

    /// A member's nodes turn together.
    fn turn(
        &mut self,
        model: &Model<D>,
        member: MemberId,
        places: &[SVector<f64, D>],
        is_free: &[bool],
        relations: &mut Vec<Form>,
    ) {
        let ids = model.member_node_ids(member);
        let Some((&first, others)) = ids.split_first().filter(|(_, others)| !others.is_empty()) else {
            return;
        };
        let points = model.member(member).coord_type().points();
        let held = |node: usize| is_free[D * node..D * (node + 1)].iter().all(|free| !free);
        let mut arms = Vec::new();
        let mut fixed = Vec::new();
        for (k, &node) in others.iter().enumerate() {
            let is_point = k + 1 < points;
            let arm = if is_point { places[node] - places[first] } else { places[node] };
            if held(node) && (!is_point || held(first)) {
                fixed.push(arm);
            }
            arms.push((node, is_point, arm));
        }
        let turn = self.rotation(model.member_name(member), &arms, &fixed);
        self.rotations.extend(turn.rotation());
        for (node, is_point, arm) in &arms {
            for (side, turned) in turn.turned(arm).into_iter().enumerate() {
                let mut relation = self.nodes[*node][side].clone();
                if *is_point {
                    relation.add(&self.nodes[first][side], -ONE);
                }
                relation.add(&turned, -ONE);
                relations.push(relation);
            }
        }
    }

    /// The variables of a member's rotation, as far as its `fixed` vectors leave it one.
    fn rotation(
        &mut self,
        name: &str,
        arms: &[(usize, bool, SVector<f64, D>)],
        fixed: &[SVector<f64, D>],
    ) -> Turn<D> {
        let name = format!("rotation of \"{name}\"");
        if D == 2 {
            return Turn::Plane { z: self.variables.conjugates(&name) };
        }
        let space = |x: &SVector<f64, D>| Vector3::new(x[0], x[1], x[2]);
        if let [(_, _, arm)] = arms {
            let first = self.variables.len();
            for axis in ["x", "y", "z"] {
                self.variables.add(Kind::Direction, format!("{axis} of the {name}"));
            }
            return Turn::Bar { first, direction: arm.normalize() };
        }
        if let Some(axis) = fixed.first().map(|x| space(x).normalize()) {
            let parallel = |x: &SVector<f64, D>| axis.cross(&space(x)).norm() <= PARALLEL * x.norm();
            if !fixed.iter().all(parallel) {
                return Turn::None;
            }
            return Turn::Axis { z: self.variables.conjugates(&name), axis };
        }
        let first = self.variables.len();
        for _ in crate::variable::PAIRS {
            self.variables.add(Kind::Product, name.clone());
        }
        Turn::Body { first }
    }

    /// Joints by constraints: the linear ones among the model's.
    fn join(&self, model: &Model<D>, q: &[f64], relations: &mut Vec<Form>) {
        let mut is_dot = vec![false; model.sizes().constraints];
        model.constraint_hessian().iter().for_each(|e| is_dot[e.constraint] = true);
        let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
        model.jacobian(q, &mut jacobian);
        let mut phi = vec![0.0; is_dot.len()];
        model.constraints(q, &mut phi);
        for row in (0..is_dot.len()).filter(|&row| !is_dot[row]) {
            // Linear: Φ per unit is Φ of the coordinates per unit.
            let mut sum = Form::constant(phi[row]);
            let entries = model.jacobian_pattern().iter().zip(&jacobian);
            for (&(_, i), &a) in entries.filter(|((r, _), _)| *r == row) {
                for (side, factor) in cartesian::<D>(i % D) {
                    sum.add(&self.nodes[i / D][side], factor * a);
                }
                sum.constant -= a * q[i];
            }
            relations.push(sum);
        }
    }

    fn eliminate(&mut self, relations: &[Form]) -> Result<(), EquilibriaError> {
        // Nodes come first: rotations stay where there is a choice.
        let kinds = &self.variables.kinds;
        let preference = (0..kinds.len()).filter(|&k| kinds[k] != Kind::Product);
        self.affine = Affine::solve(kinds.len(), relations, preference).map_err(|obstacle| {
            let what = match obstacle {
                Obstacle::Contradiction => "joints that contradict each other".into(),
                Obstacle::Left(k) => format!(
                    "a joint between bodies in space that holds more than a point, and with it the {}",
                    self.variables.names[k]
                ),
            };
            EquilibriaError::NotAlgebraic { what }
        })?;
        // Conjugate variables must be independent together, or "real" has no simple meaning.
        let independent = |k: usize| self.affine.independent.binary_search(&k).is_ok();
        for k in (0..kinds.len()).filter(|&k| kinds[k] == Kind::Holomorphic) {
            if independent(k) != independent(k + 1) {
                let what =
                    format!("a support that holds the {} along one axis only", self.variables.names[k]);
                return Err(EquilibriaError::NotAlgebraic { what });
            }
        }
        Ok(())
    }
}

/// The sides of a node as functions of new variables, as far as supports leave it free.
fn node_sides<const D: usize>(
    variables: &mut Variables,
    name: &str,
    place: &SVector<f64, D>,
    free: &[bool],
) -> Vec<Form> {
    if D == 2 && free.iter().all(|&f| f) {
        let p = variables.conjugates(&format!("P of {name}"));
        return vec![Form::variable(p), Form::variable(p + 1)];
    }
    let mut cartesian = Vec::new();
    for (axis, letter) in ["x", "y", "z"].iter().enumerate().take(D) {
        cartesian.push(if free[axis] {
            Form::variable(variables.add(Kind::Real, format!("{letter} of {name}")))
        } else {
            Form::constant(place[axis])
        });
    }
    match cartesian.as_slice() {
        [x, y] => vec![Form::sum([(x, ONE), (y, I)]), Form::sum([(x, ONE), (y, -I)])],
        _ => cartesian,
    }
}
