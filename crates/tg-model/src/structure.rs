//! The parts of a model as the builder took them: who is attached to whom. The solvers never ask; reports about single
//! parts do.

use crate::load::Load;
use crate::model::Model;
use crate::parts::{CableId, Joining, LoadId, Place};

/// A joint of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<'m, const D: usize> {
    /// Its name.
    pub name: &'m str,
    /// The places that it joins.
    pub places: &'m [Place<D>],
    /// How it is modelled.
    pub joining: Joining,
}

/// A support of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support<'m, const D: usize> {
    /// Its name.
    pub name: &'m str,
    /// The place of which it prescribes one component.
    pub place: Place<D>,
    /// The component, from 0.
    pub axis: usize,
}

impl<const D: usize> Model<D> {
    /// All joints in the order in which they were added.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = Joint<'_, D>> {
        let joints = self.parts.joints.iter();
        joints.map(|part| Joint { name: &part.name, places: &part.places, joining: part.joining })
    }

    /// All supports in the order in which they were added.
    pub fn supports(&self) -> impl ExactSizeIterator<Item = Support<'_, D>> {
        let supports = self.parts.supports.iter();
        supports.map(|part| Support { name: &part.name, place: part.place, axis: part.axis })
    }

    /// The two places that a cable joins.
    #[track_caller]
    pub fn cable_places(&self, cable: CableId) -> [Place<D>; 2] {
        let part = &self.parts.cables[cable.0];
        [part.from, part.to]
    }

    /// All loads in the order in which they were added.
    pub fn loads(&self) -> impl ExactSizeIterator<Item = LoadId> + use<D> {
        (0..self.parts.loads.len()).map(LoadId)
    }

    /// What a load is and what it acts on.
    #[track_caller]
    pub fn load(&self, load: LoadId) -> Load<D> {
        self.parts.loads[load.0].load
    }

    /// Acceleration of gravity \[m/s²\].
    pub fn gravity(&self) -> [f64; D] {
        self.parts.gravity.into()
    }
}
