//! Two modules in series under load.
//!
//! The paper has one module; this is the smallest structure beyond it. The second module stands on the first one's top
//! body as the first stands on the ground: its points 1', 2', 3' have in the frame at point 4 the coordinates of points 1, 2,
//! 3 in space, so that with the paper's numbers both bars and the first top body meet in point 4. A force acts on point
//! 5' of the second top body.
//!
//! With zero free lengths the potential is a Laurent polynomial in the four e^{iγ} with the exponents
//! ```text
//! ±(γ1, γ2, γ2-γ1),  ±(γ3-γ2, γ4-γ2, γ4-γ3) of the springs,  ±(γ1, γ3, γ4) of the force
//! ```
//! and has as many critical points as 4! times the volume of their hull (Kouchnirenko): 52, and 36 without the force. With
//! a free length of spring 1 there are 532. A force on point 6', where spring 1 pulls too, is a special one: 520.

use std::array::from_fn;

use nalgebra::Vector2;
use tg_model::{LoadId, Model, ModelBuilder, Place};

use super::{Module, ModuleParts, Parameters};
use crate::error::CaseError;

/// The force on point 5' that the cases use \[N\].
pub const FORCE: [f64; 2] = [0.0, -5.0];

/// Two modules with the same parameters in series.
#[derive(Clone, Debug)]
pub struct Series {
    /// The model, as built at γ = (π/2, 0, π/2, 0): no equilibrium.
    pub model: Model<2>,
    /// Parameters of each module.
    pub parameters: Parameters,
    /// The module on the ground and the one upon it.
    pub modules: [Module; 2],
    /// The force on point 5'.
    pub load: LoadId,
}

impl Series {
    /// Builds two modules with a force on point 5' \[N\].
    ///
    /// # Errors
    /// A parameter is not one of a structure.
    pub fn new(parameters: &Parameters, force: [f64; 2]) -> Result<Self, CaseError> {
        let mut b = ModelBuilder::<2>::new();
        let lower = ModuleParts::on_ground(&mut b, parameters)?;
        let base: [Place<2>; 3] = from_fn(|k| match parameters.fixed[k] {
            [0.0, 0.0] => lower.top.node(0),
            point => lower.top.at(point),
        });
        let one = Vector2::from(parameters.fixed[0]);
        let four = one + Vector2::new(0.0, parameters.bar);
        let upper = ModuleParts::add(&mut b, "upper ", base, (four + one, parameters))?;
        let load = b.load("force", upper.top.at(parameters.five), force, 1.0)?;
        let model = b.build()?;
        let modules = [lower.finish(&model, parameters)?, upper.finish(&model, parameters)?];
        Ok(Self { model, parameters: *parameters, modules, load })
    }

    /// Full coordinates at the angles of bar, top body, upper bar and upper top body from the x axis \[rad\].
    pub fn coordinates(&self, angles: [f64; 4]) -> Vec<f64> {
        let mut q = self.model.initial_coordinates();
        let one = Vector2::from(self.parameters.fixed[0]);
        let four = self.modules[0].place(&mut q, one, [angles[0], angles[1]]);
        let (sin, cos) = angles[1].sin_cos();
        let upper = four + Vector2::new(cos * one.x - sin * one.y, sin * one.x + cos * one.y);
        for &(node, _) in self.modules[1].one.terms() {
            q[2 * node..2 * node + 2].copy_from_slice(upper.as_slice());
        }
        self.modules[1].place(&mut q, upper, [angles[2], angles[3]]);
        q
    }

    /// Those angles in (-π, π] \[rad\] at full coordinates.
    pub fn angles(&self, q: &[f64]) -> [f64; 4] {
        let [[a, b], [c, d]] = [self.modules[0].angles(q), self.modules[1].angles(q)];
        [a, b, c, d]
    }
}
