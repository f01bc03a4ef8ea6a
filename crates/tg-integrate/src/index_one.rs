//! The index-1 equations: accelerations from positions and velocities, and the projection of both by the same factors.
//!
//! ```text
//! [M -Aᵀ] [q̈]   [   F  ]        [M -Aᵀ] [δq]   [  0 ]        [M -Aᵀ] [δq̇]   [  0  ]
//! [A   0] [λ] = [-Ȧ q̇ ]        [A   0] [ν ] = [ -Φ ]        [A   0] [ν ] = [-A q̇ ]
//! ```
//! on the free components; prescribed ones move columns to the right-hand side. Φ(q) = 0 is differentiated twice, so q and
//! q̇ drift from it with the error of a step and are projected: among all consistent states the one nearest in the metric of
//! the mass matrix (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Sec. VII.2). The drift of a step is so
//! small that one matrix, factored where the step ends, serves the accelerations and both projections: Newton's method with
//! a matrix that is off by the drift δ leaves δ² after one correction.
//!
//! **Supports that jump.** What their rates gain over a step beyond their accelerations at the stages is a kick of the supports;
//! the projection of the velocities passes it on: M_ff δq̇_f - A_fᵀ ν = -M_fp δq̇_p.
//!
//! Measured on the guyed mast of eight stages, 0.5 s in steps of 2 to 10 ms: one correction of q a step suffices; without
//! any projection the error is 30 to 1000 times larger and the time the same; accelerations found once more behind the
//! projection change no digit and cost a sixth.

use tg_model::{At, Inertia, InertialSystem, Jacobian, Mechanics, ProjectionError, Run};
use tg_sparse::SparseError;

use crate::check::ASSEMBLED;
use crate::curvature::Curvature;
use crate::dormand_prince::Tableau;
use crate::error::StepFailure;
use crate::error_control::Tolerances;
use crate::state::State;
use crate::supports::Supports;
use crate::system::Failure;

/// Scaled constraint residual that counts as rounding.
const CONSISTENT: f64 = 1e-14;
/// Corrections of q before what is left is taken as it is; one or two is what steps within their tolerance need.
const MOST_CORRECTIONS: u32 = 5;

/// Share of its rate by which a support must jump for a kick; smooth signals leave the error of a quadrature.
const KICK: f64 = 1e-6;

/// The equations at one point of time, with every buffer.
///
/// States are *packed*: the free components of q, then those of q̇.
pub(crate) struct IndexOne<'m> {
    pub(crate) mechanics: &'m dyn Mechanics,
    unknowns: usize,
    inertia: Inertia,
    operator: Jacobian,
    curvature: Curvature,
    system: InertialSystem<'m>,
    moving: bool,
    driven: bool,
    supports: Supports,
    /// Jumps of the supports' velocities over a substep, full; whether there is one.
    kick: Vec<f64>,
    kicked: bool,
    /// The same of their values.
    shift: Vec<f64>,
    /// Values, rates and accelerations of the supports at other times, full.
    signals: [Vec<f64>; 3],
    /// (entry of the Jacobian, constraint, coordinate) of the prescribed columns.
    prescribed: Vec<(u32, u32, u32)>,
    /// Full coordinates, velocities, and accelerations of the prescribed components (zero elsewhere).
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    carried: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    force: Vec<f64>,
    /// A where the velocities are projected.
    jacobian: Vec<f64>,
    phi: Vec<f64>,
    /// Right-hand side in, solution out: free components, then multipliers.
    rhs: Vec<f64>,
}

impl<'m> IndexOne<'m> {
    /// # Errors
    /// The pattern cannot be analysed.
    pub(crate) fn new(mechanics: &'m dyn Mechanics) -> Result<Self, ProjectionError> {
        let sizes = mechanics.sizes();
        let system =
            InertialSystem::new(mechanics).map_err(|source| ProjectionError::solver(mechanics, source))?;
        let layout = system.layout();
        let entries = mechanics.jacobian_pattern().iter().enumerate();
        let prescribed = entries
            .filter(|(_, (_, i))| layout.unknown(*i).is_none())
            .map(|(e, &(row, i))| (e as u32, row as u32, i as u32))
            .collect();
        let zeros = || vec![0.0; sizes.coordinates];
        Ok(Self {
            inertia: Inertia::new(sizes.coordinates, mechanics.mass()),
            operator: Jacobian::new(mechanics),
            curvature: Curvature::new(mechanics),
            moving: mechanics.features().moving_supports,
            driven: mechanics.features().driven_inputs,
            supports: Supports::new(mechanics),
            kick: zeros(),
            shift: zeros(),
            kicked: false,
            signals: [zeros(), zeros(), zeros()],
            prescribed,
            q: zeros(),
            v: zeros(),
            carried: zeros(),
            inputs: vec![0.0; sizes.inputs],
            force: zeros(),
            jacobian: vec![0.0; mechanics.jacobian_pattern().len()],
            phi: vec![0.0; sizes.constraints],
            rhs: vec![0.0; system.size()],
            unknowns: system.layout().unknowns(),
            system,
            mechanics,
        })
    }

    /// Number of free coordinates.
    pub(crate) fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// The largest velocity where the equations are placed, or √(f L/m) if that is more: the speed that the largest force gives
    /// the whole mass over the structure's size.
    pub(crate) fn speed(&self) -> f64 {
        let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut: None };
        let mass: f64 = self.mechanics.mass().iter().filter(|e| e.row == e.col).map(|e| e.value).sum();
        let speed = (self.mechanics.force_scale(at) * self.mechanics.size() / mass).sqrt();
        let least = if speed.is_finite() { speed } else { 0.0 };
        self.v.iter().fold(least, |largest, v| largest.max(v.abs()))
    }

    /// λ of the last solution.
    pub(crate) fn multipliers(&self) -> &[f64] {
        &self.rhs[self.unknowns..]
    }

    /// Systems that needed the pivoting factorisation so far.
    pub(crate) fn fallbacks(&self) -> u64 {
        self.system.fallbacks()
    }

    /// Takes over what does not change within a step, and packs the state.
    pub(crate) fn load(&mut self, state: &State, packed: &mut [f64]) {
        self.q.copy_from_slice(&state.q);
        self.v.copy_from_slice(&state.v);
        self.mechanics.inputs(state.t, &mut self.inputs);
        let (q, v) = packed.split_at_mut(self.unknowns);
        for ((q, v), &i) in q.iter_mut().zip(v).zip(self.mechanics.free()) {
            (*q, *v) = (state.q[i], state.v[i]);
        }
    }

    /// Moves to a packed state at time `t`.
    pub(crate) fn place(&mut self, t: f64, packed: &[f64]) {
        let (q, v) = packed.split_at(self.unknowns);
        for &Run { coordinate, unknown, len } in self.system.layout().runs() {
            self.q[coordinate..coordinate + len].copy_from_slice(&q[unknown..unknown + len]);
            self.v[coordinate..coordinate + len].copy_from_slice(&v[unknown..unknown + len]);
        }
        if self.moving {
            self.mechanics.prescribe(t, &mut self.q, &mut self.v);
            self.mechanics.prescribed_acceleration(t, &mut self.carried);
        }
        if self.driven {
            self.mechanics.inputs(t, &mut self.inputs);
        }
    }

    /// Refuses a step in which a support jumps.
    pub(crate) fn check_supports(&mut self, state: &State, h: f64) -> Result<(), Failure> {
        let [q, v, _] = &mut self.signals;
        self.mechanics.prescribe(state.t + h, q, v);
        self.supports.check(state, q, v, h)
    }

    /// Finds the kicks of the supports in a substep from `t`. By how much their values and `h` times their rates miss what the stages
    /// have seen of them, against a tolerance, and where most.
    pub(crate) fn jumps(
        &mut self,
        (t, h): (f64, f64),
        tableau: &Tableau,
        tolerances: Option<Tolerances>,
    ) -> (f64, usize) {
        let joined = self.supports.joined();
        if joined.is_empty() {
            return (0.0, 0);
        }
        let (mechanics, [q, v, a]) = (self.mechanics, &mut self.signals);
        let (kick, shift) = (&mut self.kick, &mut self.shift);
        mechanics.prescribe(t, q, v);
        for &i in joined {
            (shift[i], kick[i]) = (-q[i], -v[i]);
        }
        for &(stage, weight) in tableau.weights {
            let time = t + tableau.nodes[stage] * h;
            mechanics.prescribe(time, q, v);
            mechanics.prescribed_acceleration(time, a);
            for &i in joined {
                shift[i] -= h * weight * v[i];
                kick[i] -= h * weight * a[i];
            }
        }
        mechanics.prescribe(t + h, q, v);
        let length = mechanics.size();
        let (mut missed, mut worst, mut hardest, mut fastest) = (0.0, 0, 0.0_f64, 0.0_f64);
        for &i in joined {
            (shift[i], kick[i]) = (shift[i] + q[i], kick[i] + v[i]);
            (hardest, fastest) =
                (hardest.max(kick[i].abs()), fastest.max(v[i].abs()).max((v[i] - kick[i]).abs()));
            let scale = tolerances.map_or(f64::INFINITY, |tolerances| tolerances.scale(q[i], q[i], length));
            let here = (shift[i].abs() + h * kick[i].abs()) / scale;
            if here > missed {
                (missed, worst) = (here, i);
            }
        }
        self.kicked = hardest > KICK * fastest;
        (missed, worst)
    }

    /// Whether supports kicked in the last substep.
    pub(crate) fn kicked(&self) -> bool {
        self.kicked
    }

    /// Factors the matrix where the equations are placed.
    pub(crate) fn factor(&mut self) -> Result<(), SparseError> {
        self.system.factor(&self.q)
    }

    /// Free accelerations by the present factors; `taut` freezes the active set.
    pub(crate) fn accelerate(&mut self, taut: Option<&[bool]>, a: &mut [f64]) -> Result<(), SparseError> {
        let n = self.unknowns;
        let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut };
        self.mechanics.force(at, &mut self.force);
        let (forces, rates) = self.rhs.split_at_mut(n);
        for &Run { coordinate, unknown, len } in self.system.layout().runs() {
            forces[unknown..unknown + len].copy_from_slice(&self.force[coordinate..coordinate + len]);
        }
        self.curvature.negative_rate(&self.v, rates);
        if self.moving {
            for (rhs, &i) in forces.iter_mut().zip(self.mechanics.free()) {
                *rhs -= self.inertia.row(i, &self.carried);
            }
            for &(entry, row, i) in &self.prescribed {
                rates[row as usize] -= self.system.jacobian()[entry as usize] * self.carried[i as usize];
            }
        }
        self.system.solve(&mut self.rhs)?;
        a.copy_from_slice(&self.rhs[..n]);
        Ok(())
    }

    /// The change of the accelerations where the active set becomes `other` instead of `taut`, by the present factors.
    pub(crate) fn jump(&mut self, taut: &[bool], other: &[bool], a: &mut [f64]) -> Result<(), SparseError> {
        let n = self.unknowns;
        for (sign, taut) in [(-1.0, taut), (1.0, other)] {
            let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut: Some(taut) };
            self.mechanics.force(at, &mut self.force);
            for (a, &i) in a.iter_mut().zip(self.mechanics.free()) {
                *a = if sign < 0.0 { -self.force[i] } else { *a + self.force[i] };
            }
        }
        self.rhs[..n].copy_from_slice(a);
        self.rhs[n..].fill(0.0);
        self.system.solve(&mut self.rhs)?;
        a.copy_from_slice(&self.rhs[..n]);
        Ok(())
    }

    /// The active set of the laws where the equations are placed.
    pub(crate) fn active_set(&self, taut: &mut [bool]) {
        self.mechanics.active_set(At { q: &self.q, v: &self.v, u: &self.inputs, taut: None }, taut);
    }

    /// Moves the packed state, where the equations are placed and were factored nearby, onto Φ = 0 and A q̇ = 0; the scaled
    /// residual of Φ that is left. Above [`ASSEMBLED`] the velocities are not projected.
    pub(crate) fn project(&mut self, packed: &mut [f64]) -> Result<f64, SparseError> {
        let n = self.unknowns;
        let mut residual = self.constraint_residual();
        for _ in 0..MOST_CORRECTIONS {
            if residual <= CONSISTENT {
                break;
            }
            self.correct(packed, 0)?;
            let before = residual;
            residual = self.constraint_residual();
            if residual > 0.5 * before {
                break;
            }
        }
        if residual.is_nan() || residual > ASSEMBLED {
            return Ok(residual);
        }
        self.mechanics.jacobian(&self.q, &mut self.jacobian);
        self.operator.product(&self.jacobian, &self.v, &mut self.phi);
        self.correct(packed, n)?;
        Ok(residual)
    }

    /// Solves with `-phi` below and adds the solution to the packed numbers from `first` on, and to q or q̇.
    fn correct(&mut self, packed: &mut [f64], first: usize) -> Result<(), SparseError> {
        let n = self.unknowns;
        self.rhs[..n].fill(0.0);
        if first > 0 && self.kicked {
            for (rhs, &i) in self.rhs.iter_mut().zip(self.mechanics.free()) {
                *rhs = -self.inertia.row(i, &self.kick);
            }
        }
        for (rhs, phi) in self.rhs[n..].iter_mut().zip(&self.phi) {
            *rhs = -phi;
        }
        self.system.solve(&mut self.rhs)?;
        let full = if first == 0 { &mut self.q } else { &mut self.v };
        for &Run { coordinate, unknown, len } in self.system.layout().runs() {
            let packed = &mut packed[first + unknown..first + unknown + len];
            packed.iter_mut().zip(&self.rhs[unknown..]).for_each(|(x, change)| *x += change);
            full[coordinate..coordinate + len].copy_from_slice(packed);
        }
        Ok(())
    }

    /// Φ into `phi`; its largest scaled component.
    fn constraint_residual(&mut self) -> f64 {
        self.mechanics.constraints(&self.q, &mut self.phi);
        let mut worst = 0.0_f64;
        for (phi, scale) in self.phi.iter().zip(self.mechanics.constraint_scales()) {
            let scaled = phi.abs() / scale;
            // NaN stays.
            if scaled > worst || scaled.is_nan() {
                worst = scaled;
            }
        }
        worst
    }

    /// Why q does not come to the constraints, from the last [`IndexOne::project`].
    pub(crate) fn not_projected(&self, residual: f64) -> StepFailure {
        let scaled =
            self.phi.iter().zip(self.mechanics.constraint_scales()).map(|(phi, scale)| phi.abs() / scale);
        let worst =
            scaled.enumerate().fold((0, 0.0), |best, (j, r)| if r > best.1 { (j, r) } else { best }).0;
        let worst = self.mechanics.constraint_name(worst);
        StepFailure::NotConverged { iterations: MOST_CORRECTIONS, residual, worst, cables: Vec::new() }
    }

    /// Name of a coordinate and the cables there.
    pub(crate) fn words(&self, coordinate: usize) -> (String, Vec<String>) {
        (self.mechanics.coordinate_name(coordinate), self.mechanics.cables_at(coordinate))
    }

    /// A solver's error at the start.
    pub(crate) fn projection_error(&self, source: SparseError) -> ProjectionError {
        ProjectionError::solver(self.mechanics, source)
    }

    /// A solver's error in words.
    pub(crate) fn failure(&self, source: SparseError) -> StepFailure {
        let culprit = self.system.layout().name(self.mechanics, &source);
        match source {
            SparseError::NonFiniteVector { .. } | SparseError::NonFiniteMatrix { .. } => {
                let cables = match source.row() {
                    Some(tg_sparse::Row::Unknown(k)) => self.words(self.mechanics.free()[k]).1,
                    _ => Vec::new(),
                };
                StepFailure::NotFinite { worst: culprit, cables }
            }
            source => StepFailure::Solver { culprit, source },
        }
    }
}
