//! What a simulation of the scene does, if the user of the program says nothing else.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::quantity::Quantity;
use crate::scheme::Scheme;
use crate::spanned::Spanned;

/// A simulation: how long, how finely, and what is kept.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunSection {
    /// Simulated time \[s\].
    #[serde(alias = "end")]
    #[schemars(extend("x-aliases" = ["end"]))]
    pub duration: Quantity,
    /// Time step \[s\]. Either this or `accuracy`. With a `tolerance` it is the longest step, and may be left out:
    /// `every` is taken then, or else the time between pictures.
    pub step: Option<Quantity>,
    /// Position error \[m\] that is aimed at instead: the step, of Runge–Kutta schemes the tolerance, is chosen
    /// by comparing trial runs with coarser ones.
    pub accuracy: Option<Quantity>,
    /// Time stepping; the symplectic scheme if not given.
    pub scheme: Option<Scheme>,
    /// Error control of a Runge–Kutta scheme: error of each of its substeps relative to coordinates and
    /// velocities, a hundredth of it \[m, m/s\] where these are near zero. Fixed steps if not given.
    pub tolerance: Option<Quantity>,
    /// Spectral radius of generalised-α at infinity, from 0 to less than 1; 0.7 if not given.
    pub spectral_radius: Option<Quantity>,
    /// Time between rows of the trajectory \[s\]; every step if not given.
    pub every: Option<Quantity>,
    /// Pictures per second of simulated time; 50 if not given.
    pub frame_rate: Option<Quantity>,
    /// What the trajectory holds; energies, lengths and tensions if not given.
    pub channels: Option<Vec<ChannelName>>,
    /// Points whose positions and velocities the channel `points` holds: `"member.point"`.
    #[serde(default)]
    pub points: Vec<Spanned<String>>,
    /// Further forms of the trajectory.
    #[serde(default)]
    pub formats: Vec<Format>,
}

/// A kind of columns of the trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChannelName {
    /// Kinetic, elastic, gravitational and load energy and their sum \[J\].
    Energies,
    /// Tension of each cable \[N\].
    Tensions,
    /// Length of each cable \[m\].
    Lengths,
    /// Rest length of each cable \[m\].
    RestLengths,
    /// Whether each cable is slack (1) or not (0).
    Slack,
    /// Positions \[m\] and velocities \[m/s\] of the points listed.
    Points,
    /// Position \[m\] and orientation of each member: an angle \[rad\] in the plane, a quaternion in space.
    Poses,
    /// Force of each support on the structure \[N\].
    Reactions,
    /// Iterations of each step and its largest scaled residual.
    Solver,
}

/// A form of the trajectory besides the columnar one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// Comma-separated values.
    Csv,
    /// A NumPy array.
    Npy,
    /// ParaView time series.
    Vtk,
    /// An animated scene for viewers of 3D models.
    Gltf,
}
