//! Explicit Runge–Kutta schemes of high order on the index-1 equations, with projection, error control and located switches.
//!
//! ```text
//! y = [q; q̇],   f(t, y) = [q̇; q̈],   M q̈ - Aᵀ λ = F,   A q̈ = -Ȧ q̇            on the free components
//! Y_i = y_n + h Σ a_ij k_j,   k_i = f(t_n + c_i h, Y_i),   ŷ = y_n + h Σ b_i k_i
//! y_{n+1} = projection of ŷ on Φ(q) = 0, A q̇ = 0
//! ```
//! Prescribed components follow their signals at the times of the stages. The evaluation at ŷ closes a step and opens the next
//! one: its matrix also serves the projection, which moves ŷ by less than the error of the step, so that the order of k_1 is
//! kept without another evaluation.
//!
//! **Switches.** Law (30) bends, or jumps if damped, where a cable goes slack. Under error control substeps end there, so that
//! the order is kept; see the module `switching`.

use tg_model::{Mechanics, Projector};
use tg_sparse::SparseError;

use crate::check;
use crate::dormand_prince::{DORMAND_PRINCE_5, DORMAND_PRINCE_8, Tableau};
use crate::error::{StartError, StepError, StepFailure};
use crate::error_control::{Controller, Tolerances};
use crate::index_one::IndexOne;
use crate::state::State;
use crate::stepper::{StepReport, Stepper};
use crate::substep::{Projected, Substep};
use crate::switching::Switch;

/// Times that a substep may be shortened to end at a switch; two or three suffice.
const MOST_SHORTENED: u32 = 10;
/// Chattering: so many substeps shorter than this part of what the error allows, without a longer one that has no switch.
/// Switches are then passed over in substeps of `SLIDING` of what is allowed, and counted, until one has none.
const MOST_CHATTER: u32 = 50;
const CHATTER: f64 = 1e-2;
const SLIDING: f64 = 1e-2;
/// Least substep as a part of the step or of the time: some roundings of the time.
const SMALLEST: f64 = 1e-13;
/// Numbers in the memory of a state before the accelerations.
const HEAD: usize = 3;

/// An explicit embedded Runge–Kutta pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EmbeddedPair {
    /// Order 5(4) in six evaluations of the accelerations a step.
    #[default]
    DormandPrince5,
    /// Order 8(5,3) in twelve evaluations a step, the pair of the program DOP853; for 1e-7 and finer.
    DormandPrince8,
}

impl EmbeddedPair {
    fn tableau(self) -> &'static Tableau {
        match self {
            Self::DormandPrince5 => &DORMAND_PRINCE_5,
            Self::DormandPrince8 => &DORMAND_PRINCE_8,
        }
    }
}

/// Explicit Runge–Kutta time stepping: for structures that are not stiff, far more exact for its cost than the implicit schemes.
///
/// With error control, [`Stepper::step`] advances by `h` in as many substeps as the tolerance asks for; the substep to try next
/// is carried in the state, so that a checkpoint continues bit for bit. Of the report, `iterations` counts evaluations
/// of the accelerations (one factorisation each), `substeps` the accepted substeps, `rejected` those that were made
/// again, `frozen` those that end at a switch, `forced` switches that were passed over. The multipliers of a state are those
/// at its time. Under error control substeps also end where the velocity of a support jumps that carries mass or a joint; with fixed
/// steps, let them end there, or the order is lost. The memory of a state is: substep, error, largest velocity so far,
/// accelerations of the free components.
///
/// ```
/// use tg_integrate::{EmbeddedPair, Run, RungeKutta, Stepper, Tolerances};
/// # use tg_model::{Joining, ModelBuilder};
/// # let mut b = ModelBuilder::<2>::new();
/// # b.gravity([0.0, -9.81])?;
/// # let pivot = b.anchor("pivot", [0.0, 0.0])?;
/// # let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
/// # b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
/// # let model = b.build()?;
/// let mut stepper = RungeKutta::new(&model, EmbeddedPair::DormandPrince8, Tolerances::relative(1e-10))?;
/// let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
/// Run::new(0.1, 2.0).go(&mut stepper, &mut state)?;
/// assert!(model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total().abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct RungeKutta<'m> {
    substep: Substep<'m>,
    projector: Projector<'m>,
}

/// What became of a substep.
enum Outcome {
    /// Accepted with this error.
    Accepted(f64),
    /// It has to end after this time for a switch.
    Shorten(f64),
    /// It has to begin with another active set.
    Reopened,
    /// The error is above one or NaN; the coordinate where it is largest.
    TooLong(f64, usize),
    /// The end is too far from the constraints to be projected; their scaled residual.
    Apart(f64),
    /// The equations cannot be solved somewhere in it.
    Failed(SparseError),
}

impl<'m> RungeKutta<'m> {
    /// A stepper with error control.
    ///
    /// # Errors
    /// A tolerance is out of range, or the pattern of the system cannot be analysed.
    pub fn new(
        mechanics: &'m dyn Mechanics,
        pair: EmbeddedPair,
        tolerances: Tolerances,
    ) -> Result<Self, StartError> {
        tolerances.check()?;
        Self::with(mechanics, pair, Some(tolerances))
    }

    /// A stepper whose every step is one step of the method, without error control. Switches are not located either: each
    /// stage lets the laws decide, and the order falls to two where cables go slack, to one where they are damped.
    ///
    /// # Errors
    /// The pattern of the system cannot be analysed.
    pub fn fixed(mechanics: &'m dyn Mechanics, pair: EmbeddedPair) -> Result<Self, StartError> {
        Self::with(mechanics, pair, None)
    }

    fn with(
        mechanics: &'m dyn Mechanics,
        pair: EmbeddedPair,
        tolerances: Option<Tolerances>,
    ) -> Result<Self, StartError> {
        let substep = Substep::new(IndexOne::new(mechanics)?, pair.tableau(), tolerances);
        Ok(Self { substep, projector: Projector::new(mechanics)? })
    }

    /// One step of the method.
    fn fixed_step(&mut self, state: &State, h: f64, report: &mut StepReport) -> Result<(), StepFailure> {
        let (t, substep) = (state.t, &mut self.substep);
        if let Err(jump) = substep.equations.check_supports(state, h) {
            let mechanics = substep.equations.mechanics;
            return Err(jump.explain(mechanics, (String::new(), Vec::new()), 0, f64::NAN));
        }
        match substep.attempt(t, h, report).and_then(|_| substep.accept(t + h, report)) {
            Ok(Projected::Done | Projected::Moved(..)) => Ok(()),
            Ok(Projected::Apart(residual)) => Err(substep.equations.not_projected(residual)),
            Err(error) => Err(substep.equations.failure(error)),
        }
    }

    /// Substeps under error control from `t` to `t + h`.
    fn controlled_step(
        &mut self,
        (t, h): (f64, f64),
        tolerances: Tolerances,
        controller: &mut Controller,
        report: &mut StepReport,
    ) -> Result<(), StepFailure> {
        let order = self.substep.tableau.error_order;
        let smallest = SMALLEST * h.max(t.abs());
        self.substep.equations.active_set(&mut self.substep.taut);
        if controller.proposal <= 0.0 {
            controller.proposal = self.substep.first_length(&tolerances).min(h);
        }
        let (mut done, mut shortened, mut times_shortened, mut chatter) = (0.0, None, 0, 0);
        while done < h {
            if report.substeps + report.rejected >= tolerances.most_substeps {
                let (at, substeps) = (t + done, tolerances.most_substeps);
                return Err(StepFailure::TooManySubsteps { at, substeps, substep: controller.proposal });
            }
            let left = h - done;
            let allowed = controller.proposal.min(h);
            let chattering = chatter >= MOST_CHATTER;
            let next = if chattering { SLIDING * allowed } else { allowed };
            let length = shortened.take().unwrap_or_else(|| portion(next, left));
            let switches = (report.frozen, report.forced);
            // The last substep ends where the step does, to the last bit.
            let end = if length >= left { h } else { done + length };
            let shortest = (times_shortened < MOST_SHORTENED && !chattering).then_some(smallest);
            let refused = match self.try_substep((t + done, t + end), length, shortest, report) {
                Outcome::Accepted(error) => {
                    // A substep that was cut at a switch tells nothing about the length of the next one.
                    if times_shortened == 0 && !chattering {
                        controller.accept(length, error, order);
                    }
                    if length < CHATTER * allowed {
                        chatter += 1;
                    } else if switches == (report.frozen, report.forced) {
                        chatter = 0;
                    }
                    (done, times_shortened) = (end, 0);
                    continue;
                }
                Outcome::Shorten(to) => {
                    (shortened, times_shortened) = (Some(to), times_shortened + 1);
                    report.rejected += 1;
                    continue;
                }
                Outcome::Reopened => {
                    times_shortened += 1;
                    report.rejected += 1;
                    continue;
                }
                refused => refused,
            };
            report.rejected += 1;
            let error = if let Outcome::TooLong(error, _) = refused { error } else { f64::NAN };
            controller.refuse(length, error, order);
            if controller.proposal < smallest {
                return Err(self.hopeless(refused, t + done, controller.proposal));
            }
        }
        Ok(())
    }

    /// One substep of length `h` from `t` to `t_end`. A switch that is further than `shortest` from its start shortens it, a
    /// nearer one changes its active set; without `shortest` switches are passed over.
    fn try_substep(
        &mut self,
        (t, t_end): (f64, f64),
        h: f64,
        shortest: Option<f64>,
        report: &mut StepReport,
    ) -> Outcome {
        let substep = &mut self.substep;
        let mut outcome = || {
            let (error, worst) = substep.attempt(t, h, report)?;
            if error > 1.0 || error.is_nan() {
                return Ok(Outcome::TooLong(error, worst));
            }
            let (frozen, forced) = match (substep.switch(t, h)?, shortest) {
                (Switch::Within { at, behind }, Some(shortest)) if at * h > shortest => {
                    return Ok(Outcome::Shorten(behind * h));
                }
                (Switch::Within { .. }, Some(_)) => {
                    substep.reopen(t, report)?;
                    return Ok(Outcome::Reopened);
                }
                (Switch::Within { .. }, None) => (0, 1),
                (Switch::AtEnd, _) => (1, 0),
                (Switch::None, _) => (0, 0),
            };
            match substep.accept(t_end, report)? {
                Projected::Done => {}
                Projected::Apart(residual) => return Ok(Outcome::Apart(residual)),
                Projected::Moved(moved, worst) => return Ok(Outcome::TooLong(moved, worst)),
            }
            report.frozen += frozen;
            report.forced += forced;
            Ok(Outcome::Accepted(error))
        };
        outcome().unwrap_or_else(Outcome::Failed)
    }

    /// Why a substep is refused however short it is.
    fn hopeless(&self, refused: Outcome, at: f64, substep: f64) -> StepFailure {
        let equations = &self.substep.equations;
        match refused {
            Outcome::Failed(error) => equations.failure(error),
            Outcome::Apart(residual) => equations.not_projected(residual),
            Outcome::TooLong(_, worst) if !self.substep.rates.iter().all(|rate| rate.is_finite()) => {
                let (worst, cables) = equations.words(worst);
                StepFailure::NotFinite { worst, cables }
            }
            Outcome::TooLong(_, worst) => {
                let (worst, cables) = equations.words(worst);
                StepFailure::StepTooSmall { at, substep, worst, cables }
            }
            Outcome::Accepted(_) | Outcome::Shorten(_) | Outcome::Reopened => {
                let (worst, cables) = equations.words(equations.mechanics.free()[0]);
                StepFailure::StepTooSmall { at, substep, worst, cables }
            }
        }
    }
}

impl Stepper for RungeKutta<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.substep.equations.mechanics
    }

    /// Also solves for the first accelerations.
    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        let Substep { equations, start: packed, .. } = &mut self.substep;
        let start = check::start(equations.mechanics, t, q, v)?;
        let mut state = check::project(&mut self.projector, start)?;
        equations.load(&state, packed);
        equations.place(t, packed);
        state.memory = vec![0.0; HEAD + equations.unknowns()];
        (state.memory[1], state.memory[2]) = (1.0, equations.speed());
        equations
            .factor()
            .and_then(|()| equations.accelerate(None, &mut state.memory[HEAD..]))
            .map_err(|source| equations.projection_error(source))?;
        state.lambda.copy_from_slice(equations.multipliers());
        Ok(state)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        let t = state.t;
        let substep = &mut self.substep;
        let n = substep.equations.unknowns();
        check::step(state, h, substep.equations.mechanics.sizes(), HEAD + n)?;
        let fallbacks = substep.equations.fallbacks();
        substep.equations.load(state, &mut substep.start);
        substep.equations.place(t, &substep.start);
        substep.rates[..n].copy_from_slice(&substep.start[n..]);
        substep.rates[n..2 * n].copy_from_slice(&state.memory[HEAD..]);
        substep.fastest = state.memory[2];
        let mut report = StepReport::default();
        let mut controller = Controller::new(state.memory[0], state.memory[1]);
        let done = match substep.tolerances {
            Some(tolerances) => self.controlled_step((t, h), tolerances, &mut controller, &mut report),
            None => self.fixed_step(state, h, &mut report),
        };
        let equations = &self.substep.equations;
        let done = done.and_then(|()| check::bounded(equations.mechanics, &equations.q, &equations.v));
        if let Err(failure) = done {
            return Err(StepError { t, h, residual: f64::NAN, failure });
        }
        let substep = &self.substep;
        state.advance_time(h);
        // The equations stand at the end: they hold the full vectors.
        state.q.copy_from_slice(&substep.equations.q);
        state.v.copy_from_slice(&substep.equations.v);
        state.lambda.copy_from_slice(&substep.lambda);
        (state.memory[0], state.memory[1]) = (controller.proposal, controller.last_error);
        state.memory[2] = substep.fastest;
        state.memory[HEAD..].copy_from_slice(&substep.rates[n..2 * n]);
        report.fallbacks = (substep.equations.fallbacks() - fallbacks) as u32;
        Ok(report)
    }
}

/// The next substep out of what is left: all of it if it fits, half if it would leave a crumb.
fn portion(proposal: f64, left: f64) -> f64 {
    if proposal >= left {
        left
    } else if 2.0 * proposal > left {
        0.5 * left
    } else {
        proposal
    }
}
