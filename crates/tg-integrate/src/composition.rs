//! Symmetric compositions of the modified symplectic scheme: higher order from the same second-order step.
//!
//! ```text
//! Ψ_h = Φ_{γ_s h} ∘ … ∘ Φ_{γ_1 h},   Σ γ_i = 1,   Σ γ_i³ = 0  (order 4),   Σ γ_i⁵ = 0 and one more (order 6),   γ_i = γ_{s+1-i}
//! ```
//! E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. (2006), Sec. V.3. The composition is symmetric and
//! symplectic as Φ is: no drift of the energy. Some γ_i are negative, and Φ goes back in time there: damping then
//! feeds energy for a moment, which at small steps does no harm (the order is kept), but a step must not be so long that
//! |γ_i| h η/m comes near to one. Supports and inputs are taken at the times of the substeps, all within [t, t + h].
//!
//! Of the known sets these two were the best for their cost on the planar tower and the guyed mast: with the three steps of
//! the "triple jump" (order 4) the error is 55 to 110 times that of Suzuki's five at the same h, 7 to 14 times at the same cost;
//! with Yoshida's seven (order 6) 20 to 35 times that of the nine of Kahan and Li, 4 to 8 times at the same cost.

use tg_model::Mechanics;

use crate::check;
use crate::error::{StartError, StepError};
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::symplectic::Symplectic;

/// A set of coefficients γ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CompositionScheme {
    /// Order 4 in five steps, γ = 1/(4 - ∛4) twice on either side of 1 - 4γ = -0.66: M. Suzuki, Phys. Lett. A 146 (1990)
    /// 319–323.
    #[default]
    Suzuki4,
    /// Order 6 in nine steps: W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089–1099, scheme s9odr6a.
    KahanLi6,
}

static SUZUKI_4: [f64; 5] = [
    0.414_490_771_794_375_7,
    0.414_490_771_794_375_7,
    -0.657_963_087_177_502_9,
    0.414_490_771_794_375_7,
    0.414_490_771_794_375_7,
];

static KAHAN_LI_6: [f64; 9] = [
    0.392_161_444_007_314_1,
    0.332_599_136_789_359_43,
    -0.706_246_172_557_639_3,
    0.082_213_596_293_550_8,
    0.798_543_990_934_83,
    0.082_213_596_293_550_8,
    -0.706_246_172_557_639_3,
    0.332_599_136_789_359_43,
    0.392_161_444_007_314_1,
];

impl CompositionScheme {
    fn coefficients(self) -> &'static [f64] {
        match self {
            Self::Suzuki4 => &SUZUKI_4,
            Self::KahanLi6 => &KAHAN_LI_6,
        }
    }
}

/// A composition of [`Symplectic`] steps. Each step costs as many of them as the scheme has coefficients; the multipliers of a
/// state are those of its last one, at that one's midpoint.
pub struct Composition<'m> {
    scheme: CompositionScheme,
    base: Symplectic<'m>,
    /// Where substeps are tried: a step that fails leaves the state unchanged.
    trial: State,
}

impl<'m> Composition<'m> {
    /// A stepper for a system, with its workspace.
    ///
    /// # Errors
    /// An option is out of range, or the pattern of the system cannot be analysed.
    pub fn new(
        mechanics: &'m dyn Mechanics,
        scheme: CompositionScheme,
        options: NewtonOptions,
    ) -> Result<Self, StartError> {
        let sizes = mechanics.sizes();
        let zeros = || vec![0.0; sizes.coordinates];
        let lambda = vec![0.0; sizes.constraints];
        let base = Symplectic::new(mechanics, options)?.either_way();
        let memory = vec![0.0; base.memory()];
        Ok(Self { scheme, base, trial: State { q: zeros(), v: zeros(), lambda, memory, ..State::default() } })
    }
}

impl Stepper for Composition<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.base.mechanics()
    }

    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        self.base.start(t, q, v)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        check::step(state, h, self.base.mechanics().sizes(), self.trial.memory.len())?;
        self.trial.copy_from(state);
        let mut total = StepReport::default();
        for gamma in self.scheme.coefficients() {
            let report = self.base.step(&mut self.trial, gamma * h)?;
            total.iterations += report.iterations;
            total.residual = total.residual.max(report.residual);
            total.substeps = total.substeps.max(report.substeps);
            total.frozen += report.frozen;
            total.forced += report.forced;
            total.fallbacks += report.fallbacks;
        }
        // The coefficients' sum is one but for rounding, which is not carried into the time.
        (self.trial.t, self.trial.t_rest) = (state.t, state.t_rest);
        self.trial.advance_time(h);
        state.copy_from(&self.trial);
        Ok(total)
    }
}
