//! Cables: their own properties before those of their group, and the rest length from what is given.
//!
//! ```text
//! rest ratio r:       μ = r l                  κ given, or κ = EA / μ
//! tension f:          μ = l - f / κ            or μ = l / (1 + f / EA)
//! force density q:    f = q l
//! ```

use tg_model::{CableLaw, Signal};

use super::{Assembler, mistake};
use crate::cable::{Cable, Group, Law};
use crate::dimension::{Dimension, Space};
use crate::error::ReadError;
use crate::expression::Variables;
use crate::names::Copy;
use crate::quantity::Quantity;
use crate::signal::SignalSpec;
use crate::spanned::Spanned;
use crate::values::{not_negative, positive};

/// How a rest length is given.
#[derive(Clone, Copy)]
enum Rest<'s> {
    Length(&'s SignalSpec),
    Ratio(&'s Quantity),
    Tension(&'s Quantity),
    ForceDensity(&'s Quantity),
}

/// How a stiffness is given.
#[derive(Clone, Copy)]
enum Stiffness<'s> {
    Spring(&'s Quantity),
    Axial(&'s Quantity),
}

impl<'s, const D: usize> Assembler<'s, D>
where
    Space: Dimension<D>,
{
    pub(super) fn cable(
        &mut self,
        given: &Spanned<String>,
        cable: &'s Cable,
        copy: &Copy<D>,
    ) -> Result<(), ReadError> {
        let name = self.name("cable", given, copy)?;
        let [from, to] = cable.ends.value.as_slice() else {
            let message = format!("a cable has two ends, not {}", cable.ends.value.len());
            return Err(ReadError::new(message).at(&cable.ends.span));
        };
        let (from, to) = (self.names.place(from, copy)?, self.names.place(to, copy)?);
        let length = (to.position - from.position).norm();
        let group = cable.group.as_ref().map(|group| self.group(group, copy)).transpose()?;
        let (group_name, group) = group.map_or((None, None), |(name, group)| (Some(name), group));
        let rest =
            rest_of(cable)?.map_or_else(|| group.map_or(Ok(None), rest_of_group), |rest| Ok(Some(rest)))?;
        let rest = rest.ok_or_else(|| {
            ReadError::new("the cable has no rest length")
                .help("give one of rest, rest_ratio, tension, force_density, here or in its group")
        })?;
        let stiffness = match stiffness_of(&cable.stiffness, &cable.axial_stiffness)? {
            Some(own) => Some(own),
            None => group.map_or(Ok(None), |g| stiffness_of(&g.stiffness, &g.axial_stiffness))?,
        };
        let stiffness = stiffness.ok_or_else(|| {
            ReadError::new("the cable has no stiffness")
                .help("give stiffness [N/m] or axial_stiffness [N], here or in its group")
        })?;
        let variables = &copy.variables;
        let (stiffness, rest) = self.resolve(stiffness, rest, length, variables)?;
        let damping = cable.damping.as_ref().or(group.and_then(|g| g.damping.as_ref()));
        let damping = damping.map_or(Ok(0.0), |damping| not_negative(variables, damping))?;
        let law = match cable.law.or(group.and_then(|g| g.law)).unwrap_or(Law::Slacking) {
            Law::Slacking => CableLaw::slacking(stiffness),
            Law::Linear => CableLaw::linear(stiffness),
        };
        let law = law.with_damping(damping);
        self.builder
            .cable(&name, from.place, to.place, law, rest)
            .map_err(|error| mistake(&error, &given.span))?;
        self.groups.push(group_name);
        Ok(())
    }

    /// The group's name, and its properties where it is declared.
    fn group(
        &self,
        given: &Spanned<String>,
        copy: &Copy<D>,
    ) -> Result<(String, Option<&'s Group>), ReadError> {
        let name = copy.variables.fill(&given.value, &given.span)?;
        let groups = &self.scene.groups.0;
        let group = groups.iter().find(|(known, _)| known.value == name).map(|(_, group)| group);
        if group.is_none() && !groups.is_empty() {
            let known: Vec<&str> = groups.iter().map(|(known, _)| known.value.as_str()).collect();
            let error = ReadError::new(format!("the group \"{name}\" is not declared under [groups]"));
            return Err(error.at(&given.span).suggest(&name, &known));
        }
        Ok((name, group))
    }

    /// κ and μ at a length as built.
    fn resolve(
        &self,
        stiffness: Stiffness<'_>,
        rest: Rest<'_>,
        length: f64,
        variables: &Variables,
    ) -> Result<(f64, Signal), ReadError> {
        let tension = match rest {
            Rest::Tension(tension) => Some(variables.number(tension)?),
            Rest::ForceDensity(density) => Some(variables.number(density)? * length),
            Rest::Length(_) | Rest::Ratio(_) => None,
        };
        match (stiffness, rest, tension) {
            (Stiffness::Spring(k), Rest::Length(rest), _) => {
                Ok((not_negative(variables, k)?, self.signals.signal(rest, variables)?))
            }
            (Stiffness::Spring(k), Rest::Ratio(ratio), _) => {
                Ok((not_negative(variables, k)?, Signal::Constant(variables.number(ratio)? * length)))
            }
            (Stiffness::Spring(k), Rest::Tension(place) | Rest::ForceDensity(place), tension) => {
                let (k, f) = (positive(variables, k)?, tension.unwrap_or(0.0));
                let rest = length - f / k;
                if rest < 0.0 {
                    let message = format!("a tension of {f} N needs a rest length of {rest} m");
                    let help = format!("a cable of {length} m and {k} N/m holds at most {} N", k * length);
                    return Err(ReadError::new(message).at(&place.span).help(help));
                }
                Ok((k, Signal::Constant(rest)))
            }
            (Stiffness::Axial(ea), Rest::Length(rest), _) => {
                let (ea_value, signal) = (positive(variables, ea)?, self.signals.signal(rest, variables)?);
                let mu = signal.constant().filter(|mu| *mu > 0.0).ok_or_else(|| {
                    let error = ReadError::new("an axial stiffness needs a constant positive rest length");
                    error.at(&rest.span).help("give stiffness [N/m] to cables that are reeled")
                })?;
                Ok((ea_value / mu, signal))
            }
            (Stiffness::Axial(ea), Rest::Ratio(ratio), _) => {
                let mu = positive(variables, ratio)? * length;
                Ok((positive(variables, ea)? / mu, Signal::Constant(mu)))
            }
            (Stiffness::Axial(ea), Rest::Tension(_) | Rest::ForceDensity(_), tension) => {
                let ea_value = positive(variables, ea)?;
                let mu = length / (1.0 + tension.unwrap_or(0.0) / ea_value);
                if !(mu.is_finite() && mu > 0.0) {
                    return Err(ReadError::new("the axial stiffness does not hold this tension").at(&ea.span));
                }
                Ok((ea_value / mu, Signal::Constant(mu)))
            }
        }
    }
}

/// The one way in which a rest length is given, if it is.
fn only_one<'s>(given: [Option<Rest<'s>>; 4]) -> Result<Option<Rest<'s>>, ReadError> {
    let mut given = given.into_iter().flatten();
    let first = given.next();
    if given.next().is_some() {
        let help = "keep one of rest, rest_ratio, tension and force_density";
        return Err(ReadError::new("the rest length is given in more than one way").help(help));
    }
    Ok(first)
}

fn rest_of(cable: &Cable) -> Result<Option<Rest<'_>>, ReadError> {
    only_one([
        cable.rest.as_ref().map(Rest::Length),
        cable.rest_ratio.as_ref().map(Rest::Ratio),
        cable.tension.as_ref().map(Rest::Tension),
        cable.force_density.as_ref().map(Rest::ForceDensity),
    ])
}

fn rest_of_group(group: &Group) -> Result<Option<Rest<'_>>, ReadError> {
    only_one([
        group.rest.as_ref().map(Rest::Length),
        group.rest_ratio.as_ref().map(Rest::Ratio),
        group.tension.as_ref().map(Rest::Tension),
        group.force_density.as_ref().map(Rest::ForceDensity),
    ])
}

fn stiffness_of<'s>(
    spring: &'s Option<Quantity>,
    axial: &'s Option<Quantity>,
) -> Result<Option<Stiffness<'s>>, ReadError> {
    match (spring, axial) {
        (Some(_), Some(axial)) => {
            let error = ReadError::new("stiffness and axial_stiffness are both given").at(&axial.span);
            Err(error.help("keep one"))
        }
        (Some(spring), None) => Ok(Some(Stiffness::Spring(spring))),
        (None, Some(axial)) => Ok(Some(Stiffness::Axial(axial))),
        (None, None) => Ok(None),
    }
}
