//! The reduced equilibrium matrix of the cables: what each unit tension does on the motions that the members allow.
//!
//! ```text
//! B f = Nᵀ F₀,   B = Nᵀ (∂l/∂q)ᵀ,   f_j = γ_j l_j                (32), F₀: all forces but the cables'
//! ```

use tg_model::{At, Layout, Tensioned};
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, Entries, NullSpace, Tangent, TangentError};

/// The cables at a configuration and the load that they have to balance.
#[derive(Clone, Debug)]
pub(crate) struct Cables {
    /// Lengths of all cables.
    pub(crate) lengths: Vec<f64>,
    /// ∂l/∂q, cables by free coordinates.
    pub(crate) gradient: Entries,
    /// Whether each cable acts on a free coordinate.
    pub(crate) acts: Vec<bool>,
    /// F₀ over the free coordinates.
    pub(crate) load: Vec<f64>,
}

impl Cables {
    pub(crate) fn new(structure: &dyn Tensioned, at: &Configuration) -> Self {
        let mechanics = structure.mechanics();
        let (lengths, gradient) = lengths(structure, &at.q);
        let mut acts = vec![false; lengths.len()];
        gradient.iter().for_each(|(cable, _, _)| acts[cable] = true);
        let rest = vec![0.0; at.q.len()];
        let mut force = rest.clone();
        mechanics.force(At { q: &at.q, v: &rest, u: &at.u, taut: None }, &mut force);
        let mut load: Vec<f64> = mechanics.free().iter().map(|&i| force[i]).collect();
        let tension = |c: usize| structure.static_tension(c, lengths[c], at.u[c]);
        let tensions: Vec<f64> = (0..lengths.len()).map(tension).collect();
        gradient.add_transposed_product(1.0, &tensions, &mut load);
        Self { lengths, gradient, acts, load }
    }
}

/// Equilibrium of the cables at a configuration, constraint forces eliminated.
#[derive(Clone, Debug)]
pub(crate) struct CableEquilibrium {
    /// N.
    pub(crate) null_space: NullSpace,
    /// Cables that act on a free coordinate; the others carry whatever they carry.
    pub(crate) acting: Vec<usize>,
    /// Lengths of all cables.
    pub(crate) lengths: Vec<f64>,
    /// B, degrees of freedom by acting cables.
    pub(crate) matrix: Mat<f64>,
}

impl CableEquilibrium {
    pub(crate) fn new(structure: &dyn Tensioned, at: &Configuration) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let null_space = NullSpace::new(&Tangent::new(mechanics, at))?;
        let Cables { lengths, gradient, acts, .. } = Cables::new(structure, at);
        let acting: Vec<usize> = (0..lengths.len()).filter(|&c| acts[c]).collect();
        let all = gradient.times(&null_space.basis);
        let matrix = Mat::from_fn(null_space.basis.ncols(), acting.len(), |k, c| all[(acting[c], k)]);
        Ok(Self { null_space, acting, lengths, matrix })
    }

    /// Nᵀ F₀, F₀ over the free coordinates.
    pub(crate) fn reduced(&self, load: &[f64]) -> Mat<f64> {
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
