//! The antiprism paper's structures: n struts between a bottom and a top polygon of ties, with lateral ties between
//! (Crane, Duffy, Correa: Static Analysis of Tensegrity Structures).
//!
//! ```text
//! strut j from E_j to A_j;   top ties A_j A_{j+1}, bottom ties E_j E_{j+1}, lateral ties A_j E_{j+1}     (9) to (11)
//! unloaded: E_j = R_B (cos, sin)((j-1)γ), A_j = R_T (cos, sin)(jγ + α) at height H                     (37) to (41)
//! ```
//! Everything here is in metres and newtons; the paper is in millimetres. Ties are two-way springs, as the paper's law
//! (23) has no slacking. Children: `unloaded` (Yin's equations), [`path`] (what happens as the load
//! grows), `nearest` (distances between struts).

mod nearest;
pub mod path;
mod unloaded;

use nalgebra::Vector3;
use tg_model::{BuildError, CableId, CableLaw, LoadId, MemberId, Model, ModelBuilder, MomentAxes};

use crate::error::CaseError;

pub use unloaded::{Unloaded, unloaded};

/// Stiffness and free length of one kind of ties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    /// k \[N/m\].
    pub stiffness: f64,
    /// Free length \[m\].
    pub free: f64,
}

/// Parameters of an antiprism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Number of struts n, at least three.
    pub struts: usize,
    /// Length L_s of a strut \[m\].
    pub length: f64,
    /// Top ties.
    pub top: Tie,
    /// Bottom ties.
    pub bottom: Tie,
    /// Lateral (connecting) ties.
    pub lateral: Tie,
}

/// Example 1 (Table 1): three struts.
pub const EXAMPLE_1: Parameters = Parameters {
    struts: 3,
    length: 0.1,
    top: Tie { stiffness: 500.0, free: 0.035 },
    bottom: Tie { stiffness: 300.0, free: 0.052 },
    lateral: Tie { stiffness: 1000.0, free: 0.08 },
};

/// Force on each top in example 1 (Table 3) \[N\].
pub const FORCE: [f64; 3] = [0.0, 0.0, -10.0];

/// Example 2 (Table 6): four struts.
pub const EXAMPLE_2: Parameters = Parameters {
    struts: 4,
    length: 0.1,
    top: Tie { stiffness: 500.0, free: 0.04 },
    bottom: Tie { stiffness: 500.0, free: 0.04 },
    lateral: Tie { stiffness: 500.0, free: 0.04 },
};

/// M_ε and M_β on struts 1 to 4 in example 2 (Table 8) \[N m\].
pub const MOMENTS: [[f64; 2]; 4] = [[0.45, 0.45], [-0.9, 0.45], [0.45, 0.45], [-0.9, 0.45]];

/// How the feet are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feet {
    /// On the plane z = 0, where they slide.
    Sliding,
    /// At their places of the unloaded state.
    Fixed,
}

/// The load on each strut.
#[derive(Clone, Debug, PartialEq)]
pub enum Loads {
    /// Nothing.
    None,
    /// One force for each strut \[N\], the same on all, at this distance from the foot per length of the strut.
    Force([f64; 3], f64),
    /// M_ε and M_β about the axes of each strut's universal joint \[N m\].
    JointMoments(Vec<[f64; 2]>),
    /// A moment vector on each strut, fixed in space \[N m\]: another load than [`Loads::JointMoments`].
    MomentVectors(Vec<[f64; 3]>),
}

/// The model and its parts.
#[derive(Clone, Debug)]
pub struct Antiprism {
    /// The model, in the unloaded state as built.
    pub model: Model<3>,
    /// The parameters.
    pub parameters: Parameters,
    /// The unloaded state by Yin's equations.
    pub unloaded: Unloaded,
    /// Struts 1 to n.
    pub struts: Vec<MemberId>,
    /// Top ties A_j A_{j+1}.
    pub top: Vec<CableId>,
    /// Bottom ties E_j E_{j+1}.
    pub bottom: Vec<CableId>,
    /// Lateral ties A_j E_{j+1}.
    pub lateral: Vec<CableId>,
    /// Loads on struts 1 to n; empty without.
    pub loads: Vec<LoadId>,
}

impl Antiprism {
    /// Builds an antiprism in its unloaded state.
    ///
    /// # Errors
    /// Yin's equations have no solution near the free lengths, or a parameter is not one of a structure.
    pub fn new(parameters: &Parameters, feet: Feet, loads: &Loads) -> Result<Self, CaseError> {
        let unloaded = unloaded(parameters)?;
        let n = parameters.struts;
        let mut b = ModelBuilder::<3>::new();
        let mut struts = Vec::new();
        for j in 0..n {
            let [foot, top] = unloaded.ends(j).map(Into::into);
            // The paper's struts have no mass; statics without gravity does not see it.
            struts.push(b.bar(&format!("strut {}", j + 1), 1.0, foot, top)?);
        }
        for (j, strut) in struts.iter().enumerate() {
            let name = format!("foot {}", j + 1);
            match feet {
                Feet::Sliding => b.support(&name, strut.node(0), 2, 0.0)?,
                Feet::Fixed => b.fix(&name, strut.node(0))?,
            }
        }
        let mut ties = |kind: &str, ends: [usize; 2], tie: Tie| -> Result<Vec<CableId>, BuildError> {
            let law = CableLaw::linear(tie.stiffness);
            let tie = |j: usize| {
                let (from, to) = (struts[j].node(ends[0]), struts[(j + 1) % n].node(ends[1]));
                b.cable(&format!("{kind} tie {}", j + 1), from, to, law.clone(), tie.free)
            };
            (0..n).map(tie).collect()
        };
        let top = ties("top", [1, 1], parameters.top)?;
        let bottom = ties("bottom", [0, 0], parameters.bottom)?;
        let lateral = ties("lateral", [1, 0], parameters.lateral)?;
        let loads = add_loads(&mut b, &struts, &unloaded, loads)?;
        let model = b.build()?;
        Ok(Self { model, parameters: *parameters, unloaded, struts, top, bottom, lateral, loads })
    }

    /// E_j and A_j of strut `j`, from 0, at full coordinates \[m\].
    pub fn ends(&self, j: usize, q: &[f64]) -> [Vector3<f64>; 2] {
        let nodes = self.model.member_nodes(self.struts[j], q);
        [nodes[0], nodes[1]]
    }

    /// ε_j and β_j of strut `j`, from 0, at full coordinates \[rad\], eq. (8).
    pub fn angles(&self, j: usize, q: &[f64]) -> [f64; 2] {
        let [foot, top] = self.ends(j, q);
        angles(&(top - foot))
    }

    /// Tensions of the top, bottom and lateral ties at full coordinates \[N\]; negative where a tie pushes.
    pub fn tensions(&self, q: &[f64]) -> [Vec<f64>; 3] {
        let (u, rest) = (self.model.inputs_at(0.0), vec![0.0; q.len()]);
        [&self.top, &self.bottom, &self.lateral]
            .map(|ties| ties.iter().map(|&tie| self.model.cable(tie, q, &rest, &u).tension).collect())
    }

    /// Inputs with the loads times a factor.
    pub fn inputs(&self, factor: f64) -> Vec<f64> {
        let mut u = self.model.inputs_at(0.0);
        for &load in &self.loads {
            u[self.model.load_inputs(load)].iter_mut().for_each(|x| *x *= factor);
        }
        u
    }
}

/// ε and β of a strut with this direction.
pub fn angles(u: &Vector3<f64>) -> [f64; 2] {
    [(-u.y).atan2(u.z), u.x.atan2(u.y.hypot(u.z))]
}

fn add_loads(
    b: &mut ModelBuilder<3>,
    struts: &[MemberId],
    unloaded: &Unloaded,
    loads: &Loads,
) -> Result<Vec<LoadId>, BuildError> {
    let add = |(j, &strut): (usize, &MemberId)| {
        let name = format!("load {}", j + 1);
        match loads {
            Loads::None => None,
            Loads::Force(force, part) => {
                // A strut's local frame is that of space as built.
                let [foot, top] = unloaded.ends(j);
                Some(b.load(&name, strut.at((foot + (top - foot) * *part).into()), *force, 1.0))
            }
            Loads::JointMoments(moments) => {
                moments.get(j).map(|moments| b.joint_moments(&name, strut, *moments, 1.0))
            }
            Loads::MomentVectors(moments) => {
                moments.get(j).map(|moment| b.moment(&name, strut, MomentAxes::Space, *moment, 1.0))
            }
        }
    };
    struts.iter().enumerate().filter_map(add).collect()
}
