//! Members and cables with their places among the nodes.

use tg_coords::Member;

use crate::form::Form;
use crate::law::CableLaw;

/// A member and the nodes that hold its natural coordinates.
#[derive(Clone, Debug)]
pub(crate) struct PlacedMember<const D: usize> {
    pub(crate) name: String,
    pub(crate) member: Member<D>,
    pub(crate) nodes: Vec<usize>,
}

#[derive(Clone, Debug)]
pub(crate) struct Cable<const D: usize> {
    pub(crate) name: String,
    pub(crate) form: Form<D>,
    pub(crate) law: CableLaw,
}

impl<const D: usize> PlacedMember<D> {
    /// The form of a point of the member by its weights over the member's nodes.
    pub(crate) fn form(&self, weights: &[f64]) -> Form<D> {
        Form::new(self.nodes.iter().copied().zip(weights.iter().copied()))
    }
}
