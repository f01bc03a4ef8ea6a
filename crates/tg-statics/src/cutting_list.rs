//! The cutting list: how long to make each cable.

use std::fmt;

/// One cable of a cutting list.
#[derive(Clone, Debug, PartialEq)]
pub struct CuttingRow {
    /// Name of the cable.
    pub cable: String,
    /// Length l in the configuration \[m\].
    pub length: f64,
    /// Rest length μ \[m\]: the length to cut, between the attachments, without tension.
    pub rest_length: f64,
    /// Tension f \[N\].
    pub tension: f64,
    /// Strain (l - μ)/μ.
    pub strain: f64,
}

impl fmt::Display for CuttingRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cable, length, rest_length, tension, strain } = self;
        write!(
            f,
            "{cable}: length {length:.6} m, rest length {rest_length:.6} m, tension {tension:.6} N, strain {strain:.6}"
        )
    }
}
