//! Frequencies against a parameter, modes followed through crossings.
//!
//! Consecutive parameter values are matched by the modal assurance criterion in the mass metric, all tracks at once
//! (largest sum of MACs). Where some MAC stays small the interval is halved: shapes that turn quickly, where frequencies
//! veer, are then followed in smaller turns.

use std::error::Error;
use std::ops::Deref;

use tg_model::Mechanics;
use tg_tangent::{Configuration, TangentError};
use thiserror::Error;

use crate::error::ModalError;
use crate::modes::{ModeOptions, modes};
use crate::tracking::{Front, Point, Step};

/// How modes are found and followed. What each setting does: docs/accuracy-and-speed.md, "Modes against a parameter".
#[derive(Clone, Copy, Debug)]
pub struct SweepOptions {
    /// Modes to follow (the lowest `count` at the first parameter, and what completes their last group of equal ω²), and
    /// how modes are found.
    pub modes: ModeOptions,
    /// Modes that are found beyond those followed, so that a followed mode may rise above others.
    pub spare: usize,
    /// MAC below which a match is ambiguous. The MACs of one track with all modes sum to one at most, so above ½ a match
    /// has no equal rival; 0.8 keeps rivals below a quarter of it.
    pub least_mac: f64,
    /// How often an interval may be halved where a match is ambiguous: 6 makes at most 64 of one.
    pub halvings: u32,
    /// Neighbouring ω² within this part of their size are one group. 1e-6 is far above what rounding leaves between equal
    /// ones and below what is seen on a diagram.
    pub cluster: f64,
}

impl SweepOptions {
    /// Follows the `count` lowest modes with the default settings.
    pub fn new(count: usize) -> Self {
        let spare = count.max(4);
        Self { modes: ModeOptions::new(count), spare, least_mac: 0.8, halvings: 6, cluster: 1e-6 }
    }
}

/// One mode along the sweep.
#[derive(Clone, Debug)]
pub struct Track {
    /// ω² at each parameter \[1/s²\], negative where unstable.
    pub omega_squared: Vec<f64>,
    /// MAC with the shape at the parameter before, 1 at the first.
    pub mac: Vec<f64>,
    /// δq at the last parameter, as [`crate::Mode::shape`], its sign continued from the first.
    pub shape: Vec<f64>,
}

/// Modes against a parameter.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Parameters, those asked for and those between them that ambiguous matches needed.
    pub parameters: Vec<f64>,
    /// Whether each parameter was asked for.
    pub requested: Vec<bool>,
    /// Tracks, ω² ascending at the first parameter; all lists are as long as `parameters`.
    pub tracks: Vec<Track>,
    /// Indices into `parameters` whose match with the one before stayed ambiguous in the smallest interval: identities
    /// across them are a guess.
    pub ambiguous: Vec<usize>,
}

/// Why a sweep ended.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The caller's function has no structure or equilibrium there.
    #[error("no equilibrium at parameter {parameter}: {source}")]
    Equilibrium {
        /// The parameter.
        parameter: f64,
        /// Its reason.
        source: Box<dyn Error + Send + Sync>,
    },
    /// No modes there.
    #[error("at parameter {parameter}: {source}")]
    Modes {
        /// The parameter.
        parameter: f64,
        /// The reason.
        source: ModalError,
    },
    /// The structure has other coordinates, or fewer degrees of freedom than tracks.
    #[error(
        "at parameter {parameter} the structure has {got} {what}, before it had {expected}; sweep over one structure"
    )]
    Changed {
        /// The parameter.
        parameter: f64,
        /// What is counted.
        what: &'static str,
        /// How many there are.
        got: usize,
        /// How many are needed.
        expected: usize,
    },
}

/// Follows the lowest modes along `parameters`. For a parameter, `structure` gives the mechanics (owned in a `Box` or
/// `Arc`, or borrowed) and its equilibrium. Where a match is ambiguous it is also called for parameters between the one
/// asked for, which comes first, and the one before that.
///
/// ```
/// use tg_modal::{SweepOptions, sweep};
/// use tg_model::{CableLaw, ModelBuilder};
/// use tg_tangent::Configuration;
///
/// // A bead of 1 kg on two cables of 1 m: ω² = 2 κ along them, 2 T = 20 across them.
/// let bead = |stiffness: f64| {
///     let mut b = ModelBuilder::<2>::new();
///     let bead = b.particle("bead", 1.0, [0.0, 0.0])?;
///     for (name, x) in [("left", -1.0), ("right", 1.0)] {
///         let peg = b.anchor(name, [x, 0.0])?;
///         b.cable(name, peg, bead.node(0), CableLaw::linear(stiffness), 1.0 - 10.0 / stiffness)?;
///     }
///     let model = Box::new(b.build()?);
///     let at = Configuration::at(&*model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
///     Ok::<_, Box<dyn std::error::Error + Send + Sync>>((model, at))
/// };
/// let found = sweep(&[20.0, 40.0], &SweepOptions::new(2), bead)?;
/// let [across, along] = [0, 1].map(|track| &found.tracks[track].omega_squared);
/// assert!((across[0] - 20.0).abs() < 1e-9 && (across[1] - 20.0).abs() < 1e-9);
/// assert!((along[0] - 40.0).abs() < 1e-9 && (along[1] - 80.0).abs() < 1e-9);
/// # Ok::<(), tg_modal::SweepError>(())
/// ```
///
/// # Errors
/// The function fails, modes cannot be had, or the structure changes its size.
pub fn sweep<P, E>(
    parameters: &[f64],
    options: &SweepOptions,
    mut structure: impl FnMut(f64) -> Result<(P, Configuration), E>,
) -> Result<Sweep, SweepError>
where
    P: Deref,
    P::Target: Mechanics + Sized,
    E: Into<Box<dyn Error + Send + Sync>>,
{
    let wanted = options.modes.count.saturating_add(options.spare);
    let settings = ModeOptions { count: wanted, ..options.modes };
    let mut find = |parameter: f64| -> Result<(P, Point), SweepError> {
        let (owner, at) = structure(parameter)
            .map_err(|source| SweepError::Equilibrium { parameter, source: source.into() })?;
        let mechanics: &dyn Mechanics = &*owner;
        let found =
            modes(mechanics, &at, &settings).map_err(|source| SweepError::Modes { parameter, source })?;
        let point = Point::new(mechanics, parameter, found, options.cluster);
        Ok((owner, point))
    };
    let mut result = Sweep { parameters: vec![], requested: vec![], tracks: vec![], ambiguous: vec![] };
    let Some((&first, rest)) = parameters.split_first() else { return Ok(result) };
    let mut front = find(first)?.1.first_front(options.modes.count);
    result.start(first, &front);
    for &target in rest {
        let mut pending = vec![Pending { found: find(target)?, requested: true, halvings: 0 }];
        while let Some(mut next) = pending.pop() {
            let step = advance(&front, &*next.found.0, &next.found.1)?;
            let clear = step.worst() >= options.least_mac;
            let (from, to) = (result.parameters[result.parameters.len() - 1], next.found.1.parameter);
            let middle = 0.5 * (from + to);
            if !clear && next.halvings < options.halvings && middle != from && middle != to {
                next.halvings += 1;
                let halvings = next.halvings;
                pending.push(next);
                pending.push(Pending { found: find(middle)?, requested: false, halvings });
                continue;
            }
            if !clear {
                result.ambiguous.push(result.parameters.len());
            }
            result.add(to, next.requested, &step);
            front = step.front;
        }
    }
    for (track, shape) in result.tracks.iter_mut().zip(front.shapes) {
        track.shape = shape;
    }
    Ok(result)
}

/// A parameter that waits for the ones before it.
struct Pending<P> {
    found: (P, Point),
    requested: bool,
    halvings: u32,
}

fn advance(front: &Front, mechanics: &dyn Mechanics, point: &Point) -> Result<Step, SweepError> {
    let parameter = point.parameter;
    let changed = |what, got, expected| Err(SweepError::Changed { parameter, what, got, expected });
    if point.shapes.len() < front.shapes.len() {
        return changed("modes", point.shapes.len(), front.shapes.len());
    }
    let coordinates = |shapes: &[Vec<f64>]| shapes.first().map_or(0, Vec::len);
    let (got, expected) = (coordinates(&point.shapes), coordinates(&front.shapes));
    if got != expected && !front.shapes.is_empty() {
        return changed("coordinates", got, expected);
    }
    front
        .follow(mechanics, point)
        .map_err(|source: TangentError| SweepError::Modes { parameter, source: source.into() })
}

impl Sweep {
    fn start(&mut self, parameter: f64, front: &Front) {
        self.parameters.push(parameter);
        self.requested.push(true);
        let track = |&value: &f64| Track { omega_squared: vec![value], mac: vec![1.0], shape: Vec::new() };
        self.tracks = front.omega_squared.iter().map(track).collect();
    }

    fn add(&mut self, parameter: f64, requested: bool, step: &Step) {
        self.parameters.push(parameter);
        self.requested.push(requested);
        let values = step.front.omega_squared.iter().zip(&step.mac);
        for (track, (&value, &mac)) in self.tracks.iter_mut().zip(values) {
            track.omega_squared.push(value);
            track.mac.push(mac);
        }
    }
}
