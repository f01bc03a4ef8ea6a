//! Inverse statics of the deployable tower (Sec. 6.3.1): the rest lengths of Table 5.

use std::array::from_fn;

use tg_statics::{Answer, Given, InverseStatics, Request, SolutionSet, Unknown};

use super::{CABLES, Choices, Configuration, Deployable};
use crate::error::CaseError;

/// Rest lengths that the paper chooses beforehand: cables 13 to 15 and 19 to 21, the outer ones of the class-1 modules
/// \[m\].
const OUTER: f64 = 0.03;
/// The same of cables 16 to 18, of the class-2 module \[m\].
const JOINT: f64 = 0.1;

/// The structure in one of its configurations with rest lengths yet to be found.
///
/// # Errors
/// Never; the geometry is consistent.
pub fn untuned(configuration: Configuration) -> Result<Deployable, CaseError> {
    Deployable::new(&Choices::still(configuration, &[JOINT; CABLES]))
}

/// All rest lengths that hold a configuration: a set of three dimensions.
///
/// # Errors
/// A decomposition fails.
pub fn solution_set(structure: &Deployable) -> Result<SolutionSet, CaseError> {
    let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
    Ok(InverseStatics::new(&structure.model, &q, &u)?.solutions(&Request::new(Unknown::RestLength))?)
}

/// The paper's choice among them.
///
/// # Errors
/// A decomposition fails.
pub fn inverse(structure: &Deployable) -> Result<Answer, CaseError> {
    let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
    let outer = (12..15).chain(18..21).map(|cable| (cable, OUTER));
    let request = outer
        .chain((15..18).map(|cable| (cable, JOINT)))
        .fold(Request::new(Unknown::RestLength), |r, (cable, rest)| r.give(cable, Given::RestLength(rest)));
    Ok(InverseStatics::new(&structure.model, &q, &u)?.solve(&request)?)
}

/// The rest lengths of Table 5 with all their digits \[m\].
///
/// # Errors
/// A decomposition fails.
pub fn rest_lengths(configuration: Configuration) -> Result<[f64; CABLES], CaseError> {
    let answer = inverse(&untuned(configuration)?)?;
    Ok(from_fn(|cable| answer.rest_lengths[cable]))
}
