//! Seen during a motion: extreme tensions, slackness, displacements.

use nalgebra::SVector;
use serde::Serialize;
use tg_integrate::{Observer, State, StepReport};
use tg_model::{Form, PlaceError};
use tg_scene::Structure;

/// Where and when a quantity was largest or smallest.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Extreme {
    pub(super) value: f64,
    /// The cable, or the member that a point belongs to.
    pub(super) of: String,
    /// Time \[s\].
    pub(super) time: f64,
}

/// An extreme while it is sought: value, number of what it belongs to, time.
type Found = Option<(f64, usize, f64)>;

/// Watches a motion at its steps.
pub(super) struct Extremes<'s, const D: usize> {
    structure: &'s Structure<D>,
    /// Vertices with the number of their member, and where they started.
    vertices: Vec<(usize, Form<D>)>,
    start: Vec<SVector<f64, D>>,
    inputs: Vec<f64>,
    largest: Found,
    smallest: Found,
    displacement: Found,
    /// Time of the last step and the time until then that ended with a slack cable \[s\].
    last: f64,
    slack: f64,
}

impl<'s, const D: usize> Extremes<'s, D> {
    pub(super) fn new(structure: &'s Structure<D>) -> Result<Self, PlaceError> {
        let model = &structure.model;
        let members = model.members().zip(&structure.pictures).enumerate();
        let vertices = members.flat_map(|(k, (member, picture))| {
            let place = move |vertex: &[f64; 3]| member.at(std::array::from_fn(|i| vertex[i]));
            picture.outline.vertices.iter().map(move |vertex| Ok((k, model.form(place(vertex))?)))
        });
        Ok(Self {
            vertices: vertices.collect::<Result<_, PlaceError>>()?,
            start: Vec::new(),
            inputs: vec![0.0; model.mechanics().sizes().inputs],
            largest: None,
            smallest: None,
            displacement: None,
            last: 0.0,
            slack: 0.0,
            structure,
        })
    }

    pub(super) fn largest_tension(&self) -> Option<Extreme> {
        self.of_cable(self.largest)
    }

    pub(super) fn smallest_tension(&self) -> Option<Extreme> {
        self.of_cable(self.smallest)
    }

    /// Of the vertices of all members, from where they started.
    pub(super) fn largest_displacement(&self) -> Option<Extreme> {
        let model = &self.structure.model;
        let (value, k, time) = self.displacement?;
        let of = model.members().nth(k).map(|member| model.member_name(member))?;
        Some(Extreme { value, of: of.into(), time })
    }

    /// Part of the time with a slack cable, each step counted as its end.
    pub(super) fn slack_share(&self) -> Option<f64> {
        (self.last > 0.0).then(|| self.slack / self.last)
    }

    fn of_cable(&self, found: Found) -> Option<Extreme> {
        let model = &self.structure.model;
        let (value, k, time) = found?;
        let of = model.cables().nth(k).map(|cable| model.cable_name(cable))?;
        Some(Extreme { value, of: of.into(), time })
    }
}

impl<const D: usize> Observer for Extremes<'_, D> {
    fn observe(&mut self, state: &State, _: &StepReport) {
        let model = &self.structure.model;
        let State { t, q, v, .. } = state;
        model.mechanics().inputs(*t, &mut self.inputs);
        let mut slack = false;
        for (k, cable) in model.cables().enumerate() {
            let cable = model.cable(cable, q, v, &self.inputs);
            slack |= cable.slack;
            // Of equal values the first stays.
            if self.largest.is_none_or(|(largest, ..)| cable.tension > largest) {
                self.largest = Some((cable.tension, k, *t));
            }
            if self.smallest.is_none_or(|(smallest, ..)| cable.tension < smallest) {
                self.smallest = Some((cable.tension, k, *t));
            }
        }
        if slack {
            self.slack += t - self.last;
        }
        self.last = *t;
        if self.start.is_empty() {
            self.start.extend(self.vertices.iter().map(|(_, vertex)| vertex.eval(q)));
        }
        for ((k, vertex), start) in self.vertices.iter().zip(&self.start) {
            let displacement = (vertex.eval(q) - start).norm();
            if self.displacement.is_none_or(|(largest, ..)| displacement > largest) {
                self.displacement = Some((displacement, *k, *t));
            }
        }
    }
}
