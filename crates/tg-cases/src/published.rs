//! Reference values of the framework paper's examples, computed independently of this project.
//!
//! `data/framework.json`: minimal coordinates, Taylor or high-order Runge–Kutta integration with located events;
//! values named `scheme_*` are of the paper's own discrete scheme.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

/// Source named in rows that compare with exact values.
pub const EXACT: &str = "reference values, minimal coordinates";
/// Source named in rows that compare with the discrete scheme.
pub const SCHEME: &str = "reference values of the scheme";

/// Everything that the planar examples use.
#[derive(Debug, Deserialize)]
pub struct Framework {
    /// Double pendulum.
    pub example1: Example1,
    /// Class-3 tower.
    pub example2: Example2,
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
