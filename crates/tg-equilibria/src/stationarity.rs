//! The polynomial system whose real solutions are the equilibria, without cleared denominators.
//!
//! ```text
//! ∂V/∂y = Σ_j ½ κ_j (1 - μ_j u_j) (l̄_j ∂l_j/∂y + l_j ∂l̄_j/∂y) - ½ Σ_n (w̄_n ∂P_n/∂y + w_n ∂P̄_n/∂y)
//! z ∂V/∂z - z̄ ∂V/∂z̄ = 0,   z z̄ = 1          each rotation, where all of them are independent
//! ∂V/∂y - Σ_m λ_m ∂(z_m z̄_m)/∂y = 0           otherwise, with multipliers
//! u_j² l_j l̄_j = 1                             each spring with a free length: u = ±1/d
//! ```
//! A spring without free length needs no u. Rest lengths μ are the parameters of the family.

use tg_homotopy::{Complex64, Grouping, Polynomial, PolynomialSystem, SystemBuilder};
use tg_model::{At, Mechanics, Model, Tensioned};

use crate::error::EquilibriaError;
use crate::planar::{Form, Kind, Planar};

/// A system with what is needed to read its solutions.
pub(crate) struct Stationarity {
    pub(crate) form: Planar,
    pub(crate) system: PolynomialSystem,
    /// Cables with a free length, in the order of the u and of the parameters.
    pub(crate) springs: Vec<usize>,
    /// Number of coordinates y; the u follow.
    pub(crate) coordinates: usize,
    /// Pairs of unknowns that conjugation exchanges.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// Partitions of the unknowns to choose a start system from.
    pub(crate) groupings: Vec<Grouping>,
}

/// The affine functions that the equations are made of.
struct Parts {
    /// l and l̄ of each cable that acts, with its index, stiffness.
    lines: Vec<(usize, f64, [Form; 2])>,
    /// -∂V/∂P-part of constant forces: Σ ½ (w̄ P + w P̄).
    load: Form,
}

impl Stationarity {
    /// The system of a structure whose cables with positive entries in `rest` have a free length.
    pub(crate) fn new(model: &Model<2>, u: &[f64]) -> Result<Self, EquilibriaError> {
        let form = Planar::new(model)?;
        let parts = Parts::new(model, &form, u)?;
        let springs: Vec<usize> = parts.lines.iter().map(|line| line.0).filter(|&c| u[c] != 0.0).collect();

        let mut b = SystemBuilder::new();
        let independent = &form.affine.independent;
        let y: Vec<Polynomial> = independent.iter().map(|&k| b.unknown(form.names[k].as_str())).collect();
        let inverse: Vec<Polynomial> = springs
            .iter()
            .map(|&c| b.unknown(format!("1/length of {}", Tensioned::cable_name(model, c))))
            .collect();
        let rest: Vec<Polynomial> = springs
            .iter()
            .map(|&c| b.parameter(format!("rest length of {}", Tensioned::cable_name(model, c))))
            .collect();
        let value = |affine: &Form| polynomial(&reduced(&form, affine), &y);

        // ∂V/∂y for each independent variable.
        let mut slopes = vec![Polynomial::default(); y.len()];
        for (cable, stiffness, [l, conjugate]) in &parts.lines {
            let (value_l, value_conjugate) = (value(l), value(conjugate));
            let mut density = Polynomial::constant(0.5 * stiffness);
            if let Some(s) = springs.iter().position(|c| c == cable) {
                density = density.clone() - &density * &(&rest[s] * &inverse[s]);
            }
            for (at, c) in reduced(&form, l).terms {
                slopes[at] = slopes[at].clone() + &(&density * &value_conjugate) * &Polynomial::constant(c);
            }
            for (at, c) in reduced(&form, conjugate).terms {
                slopes[at] = slopes[at].clone() + &(&density * &value_l) * &Polynomial::constant(c);
            }
        }
        for (at, c) in reduced(&form, &parts.load).terms {
            slopes[at] = slopes[at].clone() - Polynomial::constant(c);
        }

        let position = |k: usize| independent.binary_search(&k).ok();
        let free_rotations = form.rotations.iter().all(|r| position(r.z).is_some());
        let mut in_rotation = vec![false; y.len()];
        let mut multipliers = Vec::new();
        for rotation in &form.rotations {
            let z = value(&variable(rotation.z));
            let conjugate = value(&variable(rotation.conjugate));
            match (position(rotation.z), position(rotation.conjugate)) {
                (Some(at), Some(at_conjugate)) if free_rotations => {
                    in_rotation[at] = true;
                    in_rotation[at_conjugate] = true;
                    b.equation(&z * &slopes[at] - &conjugate * &slopes[at_conjugate]);
                }
                _ => {
                    let lambda = b.unknown(format!("multiplier of {}", form.names[rotation.z]));
                    for (at, c) in reduced(&form, &variable(rotation.z)).terms {
                        slopes[at] = slopes[at].clone() - &(&lambda * &conjugate) * &Polynomial::constant(c);
                    }
                    for (at, c) in reduced(&form, &variable(rotation.conjugate)).terms {
                        slopes[at] = slopes[at].clone() - &(&lambda * &z) * &Polynomial::constant(c);
                    }
                    multipliers.push(y.len() + springs.len() + multipliers.len());
                }
            }
            b.equation(&z * &conjugate - Polynomial::constant(1.0));
        }
        for (slope, _) in slopes.into_iter().zip(&in_rotation).filter(|(_, done)| !**done) {
            b.equation(slope);
        }
        for (s, cable) in springs.iter().enumerate() {
            let Some((_, _, [l, conjugate])) = parts.lines.iter().find(|line| line.0 == *cable) else {
                continue;
            };
            b.equation(
                &(&inverse[s] * &inverse[s]) * &(&value(l) * &value(conjugate)) - Polynomial::constant(1.0),
            );
        }
        let system = b.build()?;
        let coordinates = y.len();
        let kind = |at: usize| form.kinds[independent[at]];
        let pairs =
            (0..coordinates).filter(|&at| kind(at) == Kind::Holomorphic).map(|at| (at, at + 1)).collect();
        let of = |wanted: Kind| (0..coordinates).filter(|&at| kind(at) == wanted).collect::<Vec<_>>();
        let groupings = groupings(
            system.unknowns(),
            &[of(Kind::Holomorphic), of(Kind::Antiholomorphic), of(Kind::Real)],
            &(coordinates..coordinates + springs.len()).collect::<Vec<_>>(),
            &multipliers,
        )?;
        Ok(Self { form, system, springs, coordinates, pairs, groupings })
    }
}

/// A form over the independent variables, by their positions.
fn reduced(form: &Planar, affine: &Form) -> Form {
    let mut sum = Form::constant(affine.constant);
    for &(k, c) in &affine.terms {
        let (constant, terms) = &form.affine.values[k];
        sum.constant += c * constant;
        sum.terms.extend(terms.iter().map(|&(at, a)| (at, c * a)));
    }
    let mut merged: Vec<(usize, Complex64)> = Vec::new();
    sum.terms.sort_by_key(|t| t.0);
    for (at, c) in sum.terms {
        match merged.last_mut() {
            Some((last, total)) if *last == at => *total += c,
            _ => merged.push((at, c)),
        }
    }
    merged.retain(|(_, c)| c.norm() > 1e-14);
    Form { constant: sum.constant, terms: merged }
}

fn variable(k: usize) -> Form {
    Form { constant: Complex64::new(0.0, 0.0), terms: vec![(k, Complex64::new(1.0, 0.0))] }
}

fn polynomial(reduced: &Form, y: &[Polynomial]) -> Polynomial {
    let terms = reduced.terms.iter().map(|&(at, c)| &y[at] * &Polynomial::constant(c));
    Polynomial::sum(terms.chain([Polynomial::constant(reduced.constant)]))
}

impl Parts {
    fn new(model: &Model<2>, form: &Planar, u: &[f64]) -> Result<Self, EquilibriaError> {
        let q = model.initial_coordinates();
        let (mut lengths, mut gradients) =
            (vec![0.0; model.cable_count()], vec![0.0; model.length_pattern().len()]);
        let mut lines = Vec::new();
        for (index, cable) in model.cables().enumerate() {
            let stiffness = model.linear_stiffness(index).ok_or_else(|| EquilibriaError::NotAlgebraic {
                what: format!("the law of cable \"{}\"", model.cable_name(cable)),
            })?;
            let mut ends =
                [Form::constant(Complex64::new(0.0, 0.0)), Form::constant(Complex64::new(0.0, 0.0))];
            for &(node, w) in model.cable_form(cable).terms() {
                for (end, side) in ends.iter_mut().zip(&form.nodes[node]) {
                    end.add(side, Complex64::new(w, 0.0));
                }
            }
            if !reduced(form, &ends[0]).terms.is_empty() {
                lines.push((index, stiffness, ends));
            }
        }
        // What is left of the force without the cables is constant, or there is no such form.
        let constant = |q: &[f64], lengths: &mut [f64], gradients: &mut [f64]| {
            let rest = vec![0.0; q.len()];
            let mut force = rest.clone();
            model.force(At { q, v: &rest, u, taut: None }, &mut force);
            model.lengths(q, lengths, gradients);
            for (&(cable, i), gradient) in model.length_pattern().iter().zip(&*gradients) {
                force[i] += model.static_tension(cable, lengths[cable], u[cable]) * gradient;
            }
            force
        };
        let force = constant(&q, &mut lengths, &mut gradients);
        let moved: Vec<f64> = q.iter().enumerate().map(|(i, x)| x + 0.1 * (1.0 + i as f64).sin()).collect();
        let elsewhere = constant(&moved, &mut lengths, &mut gradients);
        let size = force.iter().fold(1.0_f64, |a, f| a.max(f.abs()));
        if let Some(&i) = model.free().iter().find(|&&i| (force[i] - elsewhere[i]).abs() > 1e-8 * size) {
            let what =
                format!("a load that depends on the configuration at the {}", model.coordinate_name(i));
            return Err(EquilibriaError::NotAlgebraic { what });
        }
        let mut load = Form::constant(Complex64::new(0.0, 0.0));
        for (node, [p, conjugate]) in form.nodes.iter().enumerate() {
            let w = Complex64::new(force[2 * node], force[2 * node + 1]);
            load.add(p, w.conj() * 0.5);
            load.add(conjugate, w * 0.5);
        }
        Ok(Self { lines, load })
    }
}

/// Partitions by kind of unknown: each u for itself or together, rotations together or for themselves.
fn groupings(
    unknowns: usize,
    coordinates: &[Vec<usize>],
    inverse: &[usize],
    multipliers: &[usize],
) -> Result<Vec<Grouping>, EquilibriaError> {
    let together: Vec<Vec<usize>> = coordinates.to_vec();
    let apart: Vec<Vec<usize>> = coordinates.iter().flatten().map(|&at| vec![at]).collect();
    let own_inverse: Vec<Vec<usize>> = inverse.iter().map(|&s| vec![s]).collect();
    let all_inverse = vec![inverse.to_vec()];
    let mut list = vec![Grouping::single(unknowns)];
    for coordinates in [&together, &apart] {
        for inverse in [&own_inverse, &all_inverse] {
            let groups: Vec<&[usize]> = coordinates
                .iter()
                .chain(inverse)
                .map(Vec::as_slice)
                .chain([multipliers])
                .filter(|group| !group.is_empty())
                .collect();
            list.push(Grouping::new(unknowns, &groups)?);
        }
    }
    Ok(list)
}
