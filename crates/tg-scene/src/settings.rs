//! The run section in numbers.

use crate::error::ReadError;
use crate::expression::Variables;
use crate::quantity::Quantity;
use crate::run::{ChannelName, Format, RunSection};
use crate::scheme::Scheme;
use crate::values;

/// Spectral radius of generalised-α at infinity that a scene need not say: docs/accuracy-and-speed.md, "Spectral radius".
const SPECTRAL_RADIUS: f64 = 0.7;
/// Pictures per second that a scene need not say: motion to the eye, no matter of accuracy.
const FRAME_RATE: f64 = 50.0;

/// The numbers of a scene's run section.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Simulated time \[s\].
    pub duration: f64,
    /// Step \[s\]; under error control the longest one.
    pub step: Option<f64>,
    /// Position error aimed at \[m\].
    pub accuracy: Option<f64>,
    /// Time stepping.
    pub scheme: Scheme,
    /// Relative error of a substep under error control; fixed steps without.
    pub tolerance: Option<f64>,
    /// Spectral radius of generalised-α.
    pub spectral_radius: f64,
    /// Time between rows \[s\].
    pub every: Option<f64>,
    /// Pictures per second.
    pub frame_rate: f64,
    /// Columns.
    pub channels: Vec<ChannelName>,
    /// Further forms of the trajectory.
    pub formats: Vec<Format>,
}

impl RunSettings {
    /// The settings of a scene that says nothing about its run, without a step.
    pub fn new(duration: f64) -> Self {
        Self {
            duration,
            step: None,
            accuracy: None,
            scheme: Scheme::default(),
            tolerance: None,
            spectral_radius: SPECTRAL_RADIUS,
            every: None,
            frame_rate: FRAME_RATE,
            channels: vec![ChannelName::Energies, ChannelName::Lengths, ChannelName::Tensions],
            formats: Vec::new(),
        }
    }

    /// Longest step under error control \[s\]: as given, else from row to row, else from picture to picture.
    pub fn longest_step(&self) -> f64 {
        self.step.or(self.every).unwrap_or(1.0 / self.frame_rate)
    }
}

pub(crate) fn run_settings(run: &RunSection, variables: &Variables) -> Result<RunSettings, ReadError> {
    let positive = |quantity: &Quantity| values::positive(variables, quantity);
    let optional = |quantity: &Option<Quantity>| quantity.as_ref().map(positive).transpose();
    check(run)?;
    let spectral_radius =
        run.spectral_radius.as_ref().map_or(Ok(SPECTRAL_RADIUS), |r| variables.number(r))?;
    if let (Some(given), false) = (&run.spectral_radius, (0.0..1.0).contains(&spectral_radius)) {
        let message =
            format!("the spectral radius is {spectral_radius}; it must be at least 0 and less than 1");
        let help =
            "1 would damp nothing, and is not stable with constraints; scheme = \"symplectic\" damps nothing";
        return Err(ReadError::new(message).at(&given.span).help(help));
    }
    let mut settings = RunSettings::new(positive(&run.duration)?);
    if let Some(channels) = &run.channels {
        settings.channels.clone_from(channels);
    }
    if !run.points.is_empty() && !settings.channels.contains(&ChannelName::Points) {
        settings.channels.push(ChannelName::Points);
    }
    Ok(RunSettings {
        step: optional(&run.step)?,
        accuracy: optional(&run.accuracy)?,
        scheme: run.scheme.unwrap_or_default(),
        tolerance: optional(&run.tolerance)?,
        spectral_radius,
        every: optional(&run.every)?,
        frame_rate: optional(&run.frame_rate)?.unwrap_or(FRAME_RATE),
        formats: run.formats.clone(),
        ..settings
    })
}

/// Of step, accuracy and tolerance what the scheme needs, and no more.
fn check(run: &RunSection) -> Result<(), ReadError> {
    let scheme = run.scheme.unwrap_or_default();
    if let (Some(_), Some(accuracy)) = (&run.step, &run.accuracy) {
        let error = ReadError::new("step and accuracy are both given").at(&accuracy.span);
        return Err(error.help("keep one"));
    }
    if let (Some(tolerance), false) = (&run.tolerance, scheme.controls_error()) {
        let error = ReadError::new(format!("the scheme {scheme} has no error control")).at(&tolerance.span);
        return Err(
            error.help("leave tolerance out, or take scheme = \"runge-kutta-5\" or \"runge-kutta-8\"")
        );
    }
    if let (Some(tolerance), Some(_)) = (&run.tolerance, &run.accuracy) {
        let error = ReadError::new("tolerance and accuracy are both given").at(&tolerance.span);
        return Err(error.help("keep one; accuracy chooses the tolerance"));
    }
    if run.step.is_none() && run.accuracy.is_none() && run.tolerance.is_none() {
        return Err(ReadError::new("the run has no step")
            .at(&run.duration.span)
            .help("give step [s] or accuracy [m]"));
    }
    Ok(())
}
