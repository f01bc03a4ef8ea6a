//! Supports: which coordinates they prescribe, and whether they agree with each other and with the constraints.

use crate::constraints::{Constraint, ConstraintSource, Constraints, Named};
use crate::drive::Prescription;
use crate::error::BuildError;
use crate::form::Form;
use crate::nodes::{MEETING, Nodes};
use crate::parts::{Parts, Place, axis_name};

/// Which components are prescribed, by whom, and the constraints of supports at material points.
pub(crate) struct Supports<const D: usize> {
    pub(crate) prescribed: Vec<Option<Prescription>>,
    pub(crate) constraints: Vec<Named<D>>,
}

impl<const D: usize> Supports<D> {
    pub(crate) fn new(parts: &Parts<D>, nodes: &mut Nodes<D>) -> Result<Self, BuildError> {
        let mut by_support: Vec<(usize, usize)> = Vec::new();
        let mut constraints = Vec::new();
        for (s, support) in parts.supports.iter().enumerate() {
            let form = match support.place {
                Place::Node(..) => nodes.node_form(parts, "support", &support.name, support.place)?,
                place => nodes.point(parts, "support", &support.name, place)?,
            };
            let coordinate = match form.terms() {
                [(node, 1.0)] => node * D + support.axis,
                _ => {
                    let hidden = nodes.add_hidden(&form, &support.name);
                    let gap = form.minus(&Form::new([(hidden, 1.0)]));
                    let scale = nodes.scale(parts, &[support.place]);
                    constraints.push(Named {
                        name: format!("support \"{}\"", support.name),
                        source: ConstraintSource::Support { name: support.name.clone(), axis: support.axis },
                        constraint: Constraint::component(&gap, support.axis, scale),
                    });
                    hidden * D + support.axis
                }
            };
            by_support.push((coordinate, s));
        }
        let mut prescribed = vec![None; nodes.count() * D];
        for anchor in nodes.fixed() {
            prescribed[anchor * D..anchor * D + D].fill(Some(Prescription::AtRest));
        }
        for (coordinate, s) in by_support {
            if let Some(Prescription::By(other)) = prescribed[coordinate] {
                let (first, second) = (&parts.supports[other], &parts.supports[s]);
                if first.offset != second.offset {
                    return Err(BuildError::ContradictorySupports {
                        first: first.name.clone(),
                        second: second.name.clone(),
                        axis: axis_name(second.axis),
                        place: nodes.describe(parts, second.place),
                    });
                }
            }
            prescribed[coordinate] = Some(Prescription::By(s));
        }
        Ok(Self { prescribed, constraints })
    }
}

/// A constraint that supports hold wholly: it must be satisfied, also in its rate; then it is dropped.
pub(crate) fn check_held<const D: usize>(named: &Named<D>, q: &[f64], v: &[f64]) -> Result<(), BuildError> {
    let flat = Constraints::new(std::slice::from_ref(&named.constraint));
    let pattern = flat.jacobian_pattern::<D>();
    let mut row = vec![0.0; pattern.len()];
    flat.jacobian::<D>(q, &mut row);
    let parts = || row.iter().zip(&pattern).map(|(a, &(_, i))| a * v[i]);
    let speed: f64 = parts().map(f64::abs).sum();
    let rate = if speed > 0.0 { parts().sum::<f64>().abs() / speed } else { 0.0 };
    let violation = rate.max(named.constraint.residual(q).abs() / named.constraint.scale());
    if violation <= MEETING {
        Ok(())
    } else {
        Err(BuildError::UnsatisfiableConstraint { constraint: named.name.clone(), violation })
    }
}
