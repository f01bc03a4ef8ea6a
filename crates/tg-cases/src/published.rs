//! Reference values of the framework paper's examples and of the mast, computed independently of this project.
//!
//! - `data/framework.json`: minimal coordinates, Taylor or high-order Runge–Kutta integration with located events;
//!   values named `scheme_*` are of the paper's own discrete scheme;
//! - `data/mast.json`: central differences, converged; modes by scipy.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

/// Source named in rows that compare with exact values.
pub const EXACT: &str = "reference values, minimal coordinates";
/// Source named in rows that compare with the discrete scheme.
pub const SCHEME: &str = "reference values of the scheme";

/// Everything that the examples use.
#[derive(Debug, Deserialize)]
pub struct Framework {
    /// Double pendulum.
    pub example1: Example1,
    /// Class-3 tower.
    pub example2: Example2,
    /// Spatial deployable tower.
    pub example3: Example3,
}

/// Reference values of example 1.
#[derive(Debug, Deserialize)]
pub struct Example1 {
    /// Energy at the start \[J\].
    #[serde(rename = "E0")]
    pub energy: f64,
    /// Angles and rates at chosen times.
    pub exact: Angles,
    /// The scheme's first steps at h = 1e-3 s.
    #[serde(rename = "scheme_first_steps_h1e-3")]
    pub first_steps: PendulumSteps,
    /// Largest error of θ by horizon and step.
    #[serde(rename = "scheme_error_theta_max")]
    pub errors: BTreeMap<String, BTreeMap<String, f64>>,
    /// Scalar mass matrices by member.
    #[serde(rename = "mass_matrices_scalar")]
    pub masses: BTreeMap<String, Vec<Vec<f64>>>,
}

/// Trajectory of the double pendulum.
#[derive(Debug, Deserialize)]
pub struct Angles {
    /// Times \[s\].
    pub t: Vec<f64>,
    /// Bar from the downward vertical \[rad\].
    pub theta1: Vec<f64>,
    /// Line from the joint to the triangle's mass centre \[rad\].
    pub theta2: Vec<f64>,
    /// Rate of θ1 \[rad/s\].
    pub omega1: Vec<f64>,
    /// Rate of θ2 \[rad/s\].
    pub omega2: Vec<f64>,
}

/// First steps of example 1, the start included in the points.
#[derive(Debug, Deserialize)]
pub struct PendulumSteps {
    /// Joint \[m\].
    pub joint: Vec<[f64; 2]>,
    /// Mass centre of the triangle \[m\].
    pub triangle_centroid: Vec<[f64; 2]>,
    /// Multiplier of the bar \[N/m\].
    pub lambda_bar: Vec<f64>,
}

/// Reference values of example 2.
#[derive(Debug, Deserialize)]
pub struct Example2 {
    /// Natural frequencies \[Hz\], ascending, by rest length ratios.
    pub frequencies: BTreeMap<String, [f64; 5]>,
    /// Ratio α = β at which stability is lost.
    pub critical_ratio: f64,
    /// Mass centre of triangle 3 by setup.
    #[serde(rename = "triangle3_centroid_exact")]
    pub exact: BTreeMap<String, Path>,
    /// Largest error of that point at h = 1e-3 s by setup and horizon.
    #[serde(rename = "scheme_error_h1e-3")]
    pub errors: BTreeMap<String, f64>,
    /// The scheme's first steps at h = 1e-3 s by setup, the start included.
    #[serde(rename = "scheme_first_steps_h1e-3_tri3_centroid")]
    pub first_steps: BTreeMap<String, Vec<[f64; 2]>>,
}

/// A point's path.
#[derive(Debug, Deserialize)]
pub struct Path {
    /// Times \[s\].
    pub t: Vec<f64>,
    /// x \[m\].
    pub x: Vec<f64>,
    /// y \[m\].
    pub y: Vec<f64>,
}

/// Reference values of example 3.
#[derive(Debug, Deserialize)]
pub struct Example3 {
    /// The folded state.
    pub initial: Upright,
    /// The unfolded state.
    pub target: Upright,
    /// Scalar mass matrices by member.
    #[serde(rename = "mass_matrices_scalar")]
    pub masses: BTreeMap<String, Vec<Vec<f64>>>,
    /// The scheme's first steps at h = 1e-3 s from the initial state at ν = 0.5 Hz: mass centres \[m\] by tetrahedron,
    /// the start included.
    #[serde(rename = "scheme_first_steps_h1e-3_seis_initial_nu0.5")]
    pub first_steps: BTreeMap<String, Vec<[f64; 3]>>,
    /// The seismic run from the initial state at ν = 0.5 Hz.
    #[serde(rename = "seismic initial nu=0.5")]
    pub seismic: Top,
    /// The deployment in 10 s at ν = 0.5 Hz.
    #[serde(rename = "deployment Td=10 nu=0.5")]
    pub deployment: Deployment,
}

/// One of the two static states of example 3.
#[derive(Debug, Deserialize)]
pub struct Upright {
    /// Lowest natural frequencies \[Hz\], ascending.
    #[serde(rename = "freq")]
    pub frequencies: Vec<f64>,
    /// Rest lengths μ of cables 1 to 24 \[m\].
    #[serde(rename = "mu")]
    pub rest: [f64; 24],
    /// Lengths of cables 1 to 24 \[m\].
    #[serde(rename = "l0")]
    pub lengths: [f64; 24],
    /// Tensions of cables 1 to 24 \[N\].
    #[serde(rename = "tension")]
    pub tensions: [f64; 24],
    /// Where everything stands.
    pub nodes: Nodes,
}

/// Points of one of the two states of example 3 \[m\].
#[derive(Debug, Deserialize)]
pub struct Nodes {
    /// Ground points G_1 to G_3.
    pub ground: [[f64; 3]; 3],
    /// Ring points R_1 to R_3.
    #[serde(rename = "ring2_all")]
    pub ring: [[f64; 3]; 3],
    /// Tetrahedra by number.
    #[serde(rename = "tets")]
    pub tetrahedra: BTreeMap<u8, Tetrahedron>,
}

/// Points of a tetrahedron \[m\].
#[derive(Debug, Deserialize)]
pub struct Tetrahedron {
    /// p_1.
    pub apex: [f64; 3],
    /// p_2 to p_4.
    pub base: [[f64; 3]; 3],
    /// Mass centre.
    pub mass_centre: [f64; 3],
}

/// Path of the mass centre of tetrahedron 10 in the vertical plane of the ground's motion.
#[derive(Debug, Deserialize)]
pub struct Top {
    /// Times \[s\].
    pub t: Vec<f64>,
    /// x \[m\].
    #[serde(rename = "x10")]
    pub x: Vec<f64>,
    /// z \[m\].
    #[serde(rename = "z10")]
    pub z: Vec<f64>,
    /// Largest error of the scheme at h = 1e-3 s \[m\], where it is known.
    #[serde(rename = "scheme_error_h1e-3")]
    pub error: Option<f64>,
}

/// A deployment that collapses.
#[derive(Debug, Deserialize)]
pub struct Deployment {
    /// Path before the collapse.
    #[serde(flatten)]
    pub top: Top,
    /// Time at which the mass centre of tetrahedron 10 falls below z = 0.12 m \[s\].
    #[serde(rename = "z10_below_0.12_at")]
    pub collapse: f64,
    /// Numbers of the cables that are slack at t = 10 s.
    pub slack_at_10s: Vec<usize>,
}

/// The reference values.
///
/// # Panics
/// If the file that is compiled in is damaged, which a test of this crate would show.
#[allow(clippy::expect_used)]
pub fn framework() -> &'static Framework {
    static VALUES: LazyLock<Framework> = LazyLock::new(|| {
        serde_json::from_str(include_str!("../data/framework.json")).expect("the compiled-in data parse")
    });
    &VALUES
}

/// Source named in rows that compare with the mast's positions.
pub const CONVERGED: &str = "reference positions, converged";

/// Node positions of the mast at a few times, and its lowest modes.
#[derive(Debug, Deserialize)]
pub struct Mast {
    /// Times \[s\].
    pub t: Vec<f64>,
    /// ω² of the ten lowest modes about the loaded equilibrium \[1/s²\], ascending, by number of stages.
    pub omega_squared: BTreeMap<usize, Vec<f64>>,
    #[serde(rename = "2")]
    two: Vec<Vec<[f64; 3]>>,
    #[serde(rename = "8")]
    eight: Vec<Vec<[f64; 3]>>,
    #[serde(rename = "32")]
    thirty_two: Vec<Vec<[f64; 3]>>,
}

impl Mast {
    /// Numbers of stages that have positions.
    pub const STAGES: [usize; 3] = [2, 8, 32];

    /// Positions \[m\] at each time: level s, corner j is node 3 s + j. `None` for other numbers of stages.
    pub fn positions(&self, stages: usize) -> Option<&[Vec<[f64; 3]>]> {
        match stages {
            2 => Some(&self.two),
            8 => Some(&self.eight),
            32 => Some(&self.thirty_two),
            _ => None,
        }
    }
}

/// The mast's positions and modes.
///
/// # Panics
/// If the file that is compiled in is damaged, which a test of this crate would show.
#[allow(clippy::expect_used)]
pub fn mast() -> &'static Mast {
    static VALUES: LazyLock<Mast> = LazyLock::new(|| {
        serde_json::from_str(include_str!("../data/mast.json")).expect("the compiled-in data parse")
    });
    &VALUES
}
