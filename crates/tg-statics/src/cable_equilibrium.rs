//! The reduced equilibrium matrix of the cables: what each unit tension does on the motions that the members allow.
//!
//! ```text
//! B f = Nᵀ F₀,   B = Nᵀ (∂l/∂q)ᵀ,   f_j = γ_j l_j                (32), F₀: all forces but the cables'
//! ```

use tg_model::{At, Layout, Tensioned};
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, Entries, NullSpace, Tangent, TangentError};

/// Equilibrium of the cables at a configuration, constraint forces eliminated.
#[derive(Clone, Debug)]
pub(crate) struct CableEquilibrium {
    /// N.
    pub(crate) null_space: NullSpace,
    /// Cables that act on a free coordinate; the others carry whatever they carry.
    pub(crate) acting: Vec<usize>,
    /// Lengths of all cables.
    pub(crate) lengths: Vec<f64>,
    /// ∂l/∂q, cables by free coordinates.
    pub(crate) gradient: Entries,
    /// B, degrees of freedom by acting cables.
    pub(crate) matrix: Mat<f64>,
}

impl CableEquilibrium {
    pub(crate) fn new(structure: &dyn Tensioned, at: &Configuration) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let null_space = NullSpace::new(&Tangent::new(mechanics, at))?;
        let (lengths, gradient) = lengths(structure, &at.q);
        let mut acts = vec![false; lengths.len()];
        gradient.iter().for_each(|(cable, _, _)| acts[cable] = true);
        let acting: Vec<usize> = (0..lengths.len()).filter(|&c| acts[c]).collect();
        let all = gradient.times(&null_space.basis);
        let matrix = Mat::from_fn(null_space.basis.ncols(), acting.len(), |k, c| all[(acting[c], k)]);
        Ok(Self { null_space, acting, lengths, gradient, matrix })
    }

    /// Nᵀ F₀ at the inputs of a configuration.
    pub(crate) fn reduced_load(&self, structure: &dyn Tensioned, at: &Configuration) -> Mat<f64> {
        let mechanics = structure.mechanics();
        let rest = vec![0.0; at.q.len()];
        let mut force = rest.clone();
        mechanics.force(At { q: &at.q, v: &rest, u: &at.u, taut: None }, &mut force);
        let mut load: Vec<f64> = mechanics.free().iter().map(|&i| force[i]).collect();
        let tensions: Vec<f64> =
            (0..self.lengths.len()).map(|c| structure.static_tension(c, self.lengths[c], at.u[c])).collect();
        self.gradient.add_transposed_product(1.0, &tensions, &mut load);
        self.null_space.basis.transpose() * Mat::from_fn(load.len(), 1, |k, _| load[k])
    }
}

/// Lengths of all cables, and ∂l/∂q, cables by free coordinates.
pub(crate) fn lengths(structure: &dyn Tensioned, q: &[f64]) -> (Vec<f64>, Entries) {
    let layout = Layout::new(structure.mechanics());
    let pattern = structure.length_pattern();
    let (mut lengths, mut values) = (vec![0.0; structure.cable_count()], vec![0.0; pattern.len()]);
    structure.lengths(q, &mut lengths, &mut values);
    let places = pattern.iter().map(|&(cable, i)| (Some(cable), layout.unknown(i)));
    let entries = places.zip(&values).map(|((cable, i), &value)| (cable, i, value));
    let gradient = Entries::new(lengths.len(), layout.unknowns(), entries);
    (lengths, gradient)
}
