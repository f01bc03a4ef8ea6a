//! The variables of a planar structure in isotropic coordinates.
//!
//! ```text
//! P = x + i y,  P̄ = x - i y   for each node,   z = exp(i γ),  z̄ = exp(-i γ)   for each member's rotation from its place
//! P_a = P_0 + z (P_a - P_0)⁰   points,         P_a = z P_a⁰   base vectors,     z z̄ = 1
//! ```
//! Orientation is built in: a member's mirror image is no solution. Joints and supports are linear and are eliminated.

use nalgebra::Vector2;
use tg_homotopy::Complex64;
use tg_model::{Mechanics, MemberId, Model};

use crate::affine::{Affine, Relation};
use crate::error::EquilibriaError;

/// What a variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// P or z; its conjugate is the next variable.
    Holomorphic,
    /// P̄ or z̄.
    Antiholomorphic,
    /// A real coordinate of a node that is held along the other axis.
    Real,
}

/// A rotating member: the variables z and z̄.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rotation {
    pub(crate) z: usize,
    pub(crate) conjugate: usize,
}

/// The form of a planar structure.
pub(crate) struct Planar {
    pub(crate) kinds: Vec<Kind>,
    pub(crate) names: Vec<String>,
    pub(crate) rotations: Vec<Rotation>,
    /// For each node P and P̄ as constants and (variable, coefficient).
    pub(crate) nodes: Vec<[Form; 2]>,
    pub(crate) affine: Affine,
}

/// An affine function of variables.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    pub(crate) constant: Complex64,
    pub(crate) terms: Vec<(usize, Complex64)>,
}

const I: Complex64 = Complex64::new(0.0, 1.0);
const ONE: Complex64 = Complex64::new(1.0, 0.0);

impl Planar {
    /// The form of a structure at rest in its initial configuration.
    pub(crate) fn new(model: &Model<2>) -> Result<Self, EquilibriaError> {
        let q = model.initial_coordinates();
        let nodes = q.len() / 2;
        let mut is_free = vec![false; q.len()];
        model.free().iter().for_each(|&i| is_free[i] = true);
        let mut form = Self {
            kinds: Vec::new(),
            names: Vec::new(),
            rotations: Vec::new(),
            nodes: Vec::new(),
            affine: Affine { independent: Vec::new(), values: Vec::new() },
        };
        for node in 0..nodes {
            let variables = form.node(model, node, &q, &is_free);
            form.nodes.push(variables);
        }
        let node_variables = form.kinds.len();
        let mut relations = Vec::new();
        for member in model.members() {
            form.rotate(model, member, &q, &mut relations);
        }
        form.joints(model, &q, &mut relations)?;
        // Nodes first: rotations stay where there is a choice.
        let preference: Vec<usize> = (0..node_variables).chain(node_variables..form.kinds.len()).collect();
        form.affine = Affine::solve(form.kinds.len(), &relations, &preference)
            .ok_or(EquilibriaError::NotAlgebraic { what: "joints that contradict each other".into() })?;
        form.check_pairs()?;
        Ok(form)
    }

    fn variable(&mut self, kind: Kind, name: String) -> usize {
        self.kinds.push(kind);
        self.names.push(name);
        self.kinds.len() - 1
    }

    /// P and P̄ of a node as functions of new variables, as far as supports leave it free.
    fn node(&mut self, model: &Model<2>, node: usize, q: &[f64], is_free: &[bool]) -> [Form; 2] {
        let (x, y) = (q[2 * node], q[2 * node + 1]);
        let name = model.node_name(node).to_string();
        match (is_free[2 * node], is_free[2 * node + 1]) {
            (true, true) => {
                let p = self.variable(Kind::Holomorphic, format!("P of {name}"));
                let conjugate = self.variable(Kind::Antiholomorphic, format!("conjugate P of {name}"));
                [Form::variable(p), Form::variable(conjugate)]
            }
            (false, false) => [Form::constant(Complex64::new(x, y)), Form::constant(Complex64::new(x, -y))],
            (true, false) => {
                let s = self.variable(Kind::Real, format!("x of {name}"));
                let at = |sign: f64| Form { constant: I * (sign * y), terms: vec![(s, ONE)] };
                [at(1.0), at(-1.0)]
            }
            (false, true) => {
                let s = self.variable(Kind::Real, format!("y of {name}"));
                let at = |sign: f64| Form { constant: Complex64::new(x, 0.0), terms: vec![(s, I * sign)] };
                [at(1.0), at(-1.0)]
            }
        }
    }

    /// A member's nodes turn together.
    fn rotate(&mut self, model: &Model<2>, member: MemberId, q: &[f64], relations: &mut Vec<Relation>) {
        let ids = model.member_node_ids(member);
        let Some((&first, others)) = ids.split_first().filter(|(_, others)| !others.is_empty()) else {
            return;
        };
        let name = model.member_name(member).to_string();
        let z = self.variable(Kind::Holomorphic, format!("rotation of \"{name}\""));
        let conjugate = self.variable(Kind::Antiholomorphic, format!("conjugate rotation of \"{name}\""));
        self.rotations.push(Rotation { z, conjugate });
        let place = |node: usize| Complex64::new(q[2 * node], q[2 * node + 1]);
        let points = model.member(member).coord_type().points();
        for (k, &node) in others.iter().enumerate() {
            let is_point = k + 1 < points;
            let arm = if is_point { place(node) - place(first) } else { place(node) };
            for (side, (turn, arm)) in [(z, arm), (conjugate, arm.conj())].into_iter().enumerate() {
                let mut relation = self.nodes[node][side].clone();
                if is_point {
                    relation.add(&self.nodes[first][side], -ONE);
                }
                relation.terms.push((turn, -arm));
                relations.push(Relation { terms: relation.terms, constant: relation.constant });
            }
        }
    }

    /// Joints by constraints: linear rows in x and y come in pairs.
    fn joints(
        &self,
        model: &Model<2>,
        q: &[f64],
        relations: &mut Vec<Relation>,
    ) -> Result<(), EquilibriaError> {
        let mut is_dot = vec![false; model.sizes().constraints];
        model.constraint_hessian().iter().for_each(|e| is_dot[e.constraint] = true);
        let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
        model.jacobian(q, &mut jacobian);
        let mut phi = vec![0.0; is_dot.len()];
        model.constraints(q, &mut phi);
        for (row, _) in is_dot.iter().enumerate().filter(|(_, dot)| !**dot) {
            let mut sum = Form::constant(Complex64::new(phi[row], 0.0));
            for (&(_, i), &a) in
                model.jacobian_pattern().iter().zip(&jacobian).filter(|((r, _), _)| *r == row)
            {
                let [p, conjugate] = &self.nodes[i / 2];
                let (a_p, a_conjugate) = if i % 2 == 0 {
                    (ONE * (0.5 * a), ONE * (0.5 * a))
                } else {
                    (-I * (0.5 * a), I * (0.5 * a))
                };
                sum.add(p, a_p);
                sum.add(conjugate, a_conjugate);
                sum.constant -= a * q[i];
            }
            relations.push(Relation { terms: sum.terms, constant: sum.constant });
        }
        Ok(())
    }

    /// Conjugate variables must be independent together, or "real" has no simple meaning.
    fn check_pairs(&self) -> Result<(), EquilibriaError> {
        let independent = |k: usize| self.affine.independent.binary_search(&k).is_ok();
        for (k, kind) in self.kinds.iter().enumerate() {
            if *kind == Kind::Holomorphic && independent(k) != independent(k + 1) {
                return Err(EquilibriaError::NotAlgebraic {
                    what: format!("a support that holds the {} along one axis only", self.names[k]),
                });
            }
        }
        Ok(())
    }

    /// Coordinates of all nodes at values of the independent variables that are real: P̄ the conjugate of P.
    pub(crate) fn coordinates(&self, independent: &[Complex64]) -> Vec<f64> {
        let variable = |k: usize| {
            let (constant, terms) = &self.affine.values[k];
            terms.iter().fold(*constant, |sum, &(at, c)| sum + c * independent[at])
        };
        let node = |[p, _]: &[Form; 2]| {
            let p = p.terms.iter().fold(p.constant, |sum, &(k, c)| sum + c * variable(k));
            Vector2::new(p.re, p.im)
        };
        self.nodes.iter().flat_map(|forms| <[f64; 2]>::from(node(forms))).collect()
    }
}

impl Form {
    pub(crate) fn constant(constant: Complex64) -> Self {
        Self { constant, terms: Vec::new() }
    }

    fn variable(k: usize) -> Self {
        Self { constant: Complex64::new(0.0, 0.0), terms: vec![(k, ONE)] }
    }

    pub(crate) fn add(&mut self, other: &Self, factor: Complex64) {
        self.constant += factor * other.constant;
        self.terms.extend(other.terms.iter().map(|&(k, c)| (k, factor * c)));
    }
}
