//! The unknowns of the polynomial system that places a structure, and its nodes as polynomials in them.

use std::collections::BTreeMap;

use nalgebra::SVector;
use tg_homotopy::{Complex64, Polynomial, SystemBuilder};

use crate::affine::Form;
use crate::coordinates::Coordinates;
use crate::turn::cartesian;
use crate::variable::{Kind, PAIRS, Rotation};

/// Coefficients below this part of a polynomial's largest are what cancellation left.
const ROUNDING: f64 = 1e-13;

/// A rotation's constraint c = 0: z z̄ = 1, d·d = 1 or e·e = 1.
pub(crate) struct Norm {
    pub(crate) name: String,
    /// c as a polynomial; unless all of the rotation's variables are independent it says something about others.
    pub(crate) constraint: Polynomial,
    /// The numbers of z and z̄ where both are unknowns.
    pub(crate) angle: Option<[usize; 2]>,
    /// Number of unknowns that are the rotation's own: 2, 3 or 4 if it is independent, and 0 if others decide it.
    pub(crate) unknowns: usize,
}

/// Unknowns y that place a structure.
pub(crate) struct Unknowns<const D: usize> {
    /// Each unknown as a polynomial; its number is its position.
    pub(crate) y: Vec<Polynomial>,
    pub(crate) norms: Vec<Norm>,
    /// Unknowns that conjugation exchanges.
    pub(crate) conjugates: Vec<(usize, usize)>,
    /// Quaternions by the first of their products: e and -e are one rotation.
    pub(crate) quaternions: BTreeMap<usize, [usize; 4]>,
    /// Unknowns that belong together, with their kind.
    pub(crate) blocks: Vec<(Kind, Vec<usize>)>,
    /// Each variable as a polynomial in y.
    values: Vec<Polynomial>,
    /// Products of unknowns that norms replace.
    rules: Vec<((usize, usize), Polynomial)>,
    /// Sides of each node, per unit.
    nodes: Vec<Vec<Polynomial>>,
    /// The unit of length \[m\].
    pub(crate) unit: f64,
}

impl<const D: usize> Unknowns<D> {
    pub(crate) fn new(coordinates: &Coordinates<D>, builder: &mut SystemBuilder) -> Self {
        let Coordinates { unit, variables, affine, rotations, nodes } = coordinates;
        let mut this = Self {
            y: Vec::new(),
            norms: Vec::new(),
            conjugates: Vec::new(),
            quaternions: BTreeMap::new(),
            blocks: Vec::new(),
            values: Vec::new(),
            rules: Vec::new(),
            nodes: Vec::new(),
            unit: *unit,
        };
        // Independent variables are unknowns or products of unknowns.
        let mut independent = BTreeMap::new();
        let mut numbers = BTreeMap::new();
        for &k in affine.independent.iter().filter(|&&k| variables.kinds[k] != Kind::Product) {
            let number = this.unknown(builder, &variables.names[k]);
            let kind = variables.kinds[k];
            match this.blocks.last_mut() {
                Some((last, block)) if *last == kind && !kind.is_conjugate() => block.push(number),
                _ => this.blocks.push((kind, vec![number])),
            }
            numbers.insert(k, number);
            independent.insert(k, this.y[number].clone());
        }
        for &rotation in rotations {
            if let Rotation::Quaternion(first) = rotation {
                let parts =
                    ["e0", "e1", "e2", "e3"].map(|part| format!("{part} of the {}", variables.names[first]));
                let e = parts.map(|name| this.unknown(builder, &name));
                for (at, (a, b)) in PAIRS.into_iter().enumerate() {
                    independent.insert(first + at, &this.y[e[a]] * &this.y[e[b]]);
                }
                this.blocks.push((Kind::Product, e.to_vec()));
                this.quaternions.insert(first, e);
            }
        }
        for (constant, terms) in &affine.values {
            let parts = terms.iter().map(|&(at, c)| c * &independent[&affine.independent[at]]);
            this.values.push(Polynomial::sum(parts.chain([Polynomial::constant(*constant)])));
        }
        this.conjugates = (numbers.iter())
            .filter(|(k, _)| variables.kinds[**k] == Kind::Holomorphic)
            .map(|(_, &number)| (number, number + 1))
            .collect();
        for &rotation in rotations {
            this.norm(rotation, &numbers, &variables.names);
        }
        this.nodes =
            nodes.iter().map(|sides| sides.iter().map(|side| this.polynomial(side)).collect()).collect();
        this
    }

    fn unknown(&mut self, builder: &mut SystemBuilder, name: &str) -> usize {
        self.y.push(builder.unknown(name));
        self.y.len() - 1
    }

    fn norm(&mut self, rotation: Rotation, numbers: &BTreeMap<usize, usize>, names: &[String]) {
        let one = Polynomial::constant(1.0);
        let (first, square, rule) = match rotation {
            Rotation::Angle(z) => {
                let pair = numbers.get(&z).map(|&number| ((number, number + 1), one.clone()));
                (z, &self.values[z] * &self.values[z + 1], pair)
            }
            Rotation::Direction(first) => {
                let square = self.square(first..first + 3);
                let own: Option<Vec<usize>> = (first..first + 3).map(|k| numbers.get(&k).copied()).collect();
                let rule = own.map(|own| {
                    let others = Polynomial::sum(own[1..].iter().map(|&k| &self.y[k] * &self.y[k]));
                    ((own[0], own[0]), &one - &others)
                });
                (first, square, rule)
            }
            Rotation::Quaternion(first) => {
                let square = Polynomial::sum((first..first + 4).map(|k| self.values[k].clone()));
                let others = Polynomial::sum((first + 1..first + 4).map(|k| self.values[k].clone()));
                let e0 = self.quaternions[&first][0];
                (first, square, Some(((e0, e0), &one - &others)))
            }
        };
        let angle = match rotation {
            Rotation::Angle(z) => numbers.get(&z).map(|&number| [number, number + 1]),
            _ => None,
        };
        let unknowns = match (&rule, rotation) {
            (None, _) => 0,
            (_, Rotation::Angle(_)) => 2,
            (_, Rotation::Direction(_)) => 3,
            (_, Rotation::Quaternion(_)) => 4,
        };
        self.rules.extend(rule);
        let constraint = (square - one).chopped(ROUNDING);
        self.norms.push(Norm { name: names[first].clone(), constraint, angle, unknowns });
    }

    fn square(&self, variables: std::ops::Range<usize>) -> Polynomial {
        Polynomial::sum(variables.map(|k| &self.values[k] * &self.values[k]))
    }

    fn polynomial(&self, form: &Form) -> Polynomial {
        let terms = form.terms.iter().map(|&(k, c)| c * &self.values[k]);
        Polynomial::sum(terms.chain([Polynomial::constant(form.constant)])).chopped(ROUNDING)
    }

    /// Σ w_n P_n over nodes: the sides of a point.
    pub(crate) fn point(&self, terms: &[(usize, f64)]) -> Vec<Polynomial> {
        let side = |s: usize| Polynomial::sum(terms.iter().map(|&(node, w)| w * &self.nodes[node][s]));
        (0..D).map(side).collect()
    }

    /// |x|² of a vector given by its sides, per unit.
    pub(crate) fn square_length(&self, sides: &[Polynomial]) -> Polynomial {
        let square = match sides {
            [p, conjugate] => p * conjugate,
            _ => Polynomial::sum(sides.iter().map(|x| x * x)),
        };
        self.simplified(square)
    }

    /// Σ f_n·P_n over nodes, P per unit.
    pub(crate) fn work(&self, forces: &[f64]) -> Polynomial {
        let parts = forces.iter().enumerate().filter(|(_, f)| **f != 0.0).flat_map(|(i, &f)| {
            let sides = cartesian::<D>(i % D);
            sides.into_iter().map(move |(side, factor)| (factor * f) * &self.nodes[i / D][side])
        });
        self.simplified(Polynomial::sum(parts))
    }

    /// The same on all rotations, in lower degree, without what cancellation left.
    fn simplified(&self, polynomial: Polynomial) -> Polynomial {
        self.rules.iter().fold(polynomial, |p, (pair, product)| p.modulo(*pair, product)).chopped(ROUNDING)
    }

    /// Real coordinates of all nodes at a real solution.
    pub(crate) fn coordinates(&self, y: &[Complex64]) -> Vec<f64> {
        let node = |sides: &Vec<Polynomial>| -> SVector<f64, D> {
            let values: Vec<Complex64> = sides.iter().map(|side| side.evaluate(y, &[])).collect();
            SVector::from_fn(|axis, _| {
                let sides = cartesian::<D>(axis).into_iter();
                self.unit * sides.map(|(side, c)| c * values[side]).sum::<Complex64>().re
            })
        };
        self.nodes.iter().flat_map(|sides| node(sides).as_slice().to_vec()).collect()
    }
}
