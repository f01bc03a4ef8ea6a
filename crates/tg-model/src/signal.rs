//! Signals: scalar functions of time that move supports, reel rest lengths and scale loads.
//!
//! A signal gives its value `s(t)`, its rate `ṡ(t)` and its acceleration `s̈(t)`; at a kink they are those of the right
//! side.

use std::fmt;
use std::sync::Arc;

use thiserror::Error;

/// Time over which the rate of a user's function is differenced \[s\]; a power of two, so that times stay exact.
const DIFFERENCE: f64 = 1.0 / 8192.0;

/// A user's function of time, `t \[s\] ↦ (value, rate)`.
pub type SignalFn = dyn Fn(f64) -> (f64, f64) + Send + Sync;

/// A scalar function of time with its rate.
///
/// The unit is that of the driven quantity: metres for supports and rest lengths, one for load factors.
#[derive(Clone)]
pub enum Signal {
    /// The same value at all times.
    Constant(f64),
    /// `from` until `start`, then linear to `to` in `duration` seconds, then held
    /// (the actuation coefficient of the framework paper's Fig. 21).
    Ramp {
        /// Value before `start`.
        from: f64,
        /// Value after `start + duration`.
        to: f64,
        /// Begin of the ramp \[s\].
        start: f64,
        /// Length of the ramp \[s\], positive.
        duration: f64,
    },
    /// `amplitude · sin(2π · frequency · t + phase)`.
    Sine {
        /// Amplitude, in the unit of the signal.
        amplitude: f64,
        /// Frequency \[Hz\].
        frequency: f64,
        /// Phase at t = 0 \[rad\].
        phase: f64,
    },
    /// Piecewise linear through the samples, held before the first and after the last.
    Table(Arc<Table>),
    /// The sum of signals.
    Sum(Vec<Signal>),
    /// A user's function.
    User(Arc<SignalFn>),
}

/// Samples of a piecewise linear signal; made by [`Signal::table`], which checks them.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
}

/// What is wrong with a signal's parameters.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SignalError {
    /// A parameter is NaN or infinite.
    #[error("the {0} of the signal is {1}; give a finite number")]
    NotFinite(&'static str, f64),
    /// A ramp needs time.
    #[error("the ramp lasts {0} s; give a positive duration (for a jump there is no rate)")]
    RampDuration(f64),
    /// A table needs as many times as values, and at least one.
    #[error("the table has {times} times and {values} values; give one value for each time, at least one")]
    TableLength {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Times must increase.
    #[error(
        "the table's time number {index} is {time} s, not after the one before it; sort the table and remove repeated times"
    )]
    TableOrder {
        /// Position in the table, from zero.
        index: usize,
        /// The offending time \[s\].
        time: f64,
    },
}

impl Signal {
    /// A sine through zero at t = 0: `amplitude · sin(2π · frequency · t)`.
    pub fn sine(amplitude: f64, frequency: f64) -> Self {
        Self::Sine { amplitude, frequency, phase: 0.0 }
    }

    /// Linear from `from` at t = 0 to `to` at `duration` \[s\], then held.
    pub fn ramp(from: f64, to: f64, duration: f64) -> Self {
        Self::Ramp { from, to, start: 0.0, duration }
    }

    /// Piecewise linear through `(times, values)`, held outside.
    ///
    /// # Errors
    /// Lengths differ or are zero, times do not increase, or a number is not finite.
    pub fn table(times: Vec<f64>, values: Vec<f64>) -> Result<Self, SignalError> {
        let signal = Self::Table(Arc::new(Table { times, values }));
        signal.check()?;
        Ok(signal)
    }

    /// A user's function `t ↦ (value, rate)`.
    pub fn user(function: impl Fn(f64) -> (f64, f64) + Send + Sync + 'static) -> Self {
        Self::User(Arc::new(function))
    }

    /// Value and rate at time `t` \[s\].
    pub fn at(&self, t: f64) -> (f64, f64) {
        match self {
            Self::Constant(value) => (*value, 0.0),
            Self::Ramp { from, to, start, duration } => {
                let slope = (to - from) / duration;
                if t < *start {
                    (*from, 0.0)
                } else if t < start + duration {
                    (from + slope * (t - start), slope)
                } else {
                    (*to, 0.0)
                }
            }
            Self::Sine { amplitude, frequency, phase } => {
                let omega = std::f64::consts::TAU * frequency;
                let (sin, cos) = (omega * t + phase).sin_cos();
                (amplitude * sin, amplitude * omega * cos)
            }
            Self::Table(table) => table.at(t),
            Self::Sum(signals) => signals.iter().fold((0.0, 0.0), |(value, rate), signal| {
                let (v, r) = signal.at(t);
                (value + v, rate + r)
            }),
            Self::User(function) => function(t),
        }
    }

    /// Second derivative s̈(t), at a kink that of the right side.
    ///
    /// A kink's own impulse is left out: the acceleration of ramps and tables is zero, so a time stepping scheme of
    /// high order keeps its order only if its steps end at their kinks. A user's function gives no acceleration; its
    /// rate is differenced over 2⁻¹³ s to fourth order, which leaves some ten digits of a signal that
    /// changes within a tenth of a second.
    pub fn acceleration(&self, t: f64) -> f64 {
        match self {
            Self::Constant(_) | Self::Ramp { .. } | Self::Table(_) => 0.0,
            Self::Sine { amplitude, frequency, phase } => {
                let omega = std::f64::consts::TAU * frequency;
                -amplitude * omega * omega * (omega * t + phase).sin()
            }
            Self::Sum(signals) => signals.iter().map(|signal| signal.acceleration(t)).sum(),
            Self::User(function) => {
                let change = |d: f64| function(t + d).1 - function(t - d).1;
                (8.0 * change(DIFFERENCE) - change(2.0 * DIFFERENCE)) / (12.0 * DIFFERENCE)
            }
        }
    }

    /// The value if it never changes.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Sum(signals) => signals.iter().map(Self::constant).sum(),
            _ => None,
        }
    }

    /// Checks the parameters, of a user's function its value and rate at t = 0.
    ///
    /// # Errors
    /// A parameter is not finite, a ramp has no duration, or a table is not sorted.
    pub fn check(&self) -> Result<(), SignalError> {
        let finite = |name, x: f64| if x.is_finite() { Ok(()) } else { Err(SignalError::NotFinite(name, x)) };
        match self {
            Self::Constant(value) => finite("value", *value),
            Self::Ramp { from, to, start, duration } => {
                finite("first value", *from)?;
                finite("last value", *to)?;
                finite("start", *start)?;
                finite("duration", *duration)?;
                if *duration > 0.0 { Ok(()) } else { Err(SignalError::RampDuration(*duration)) }
            }
            Self::Sine { amplitude, frequency, phase } => {
                finite("amplitude", *amplitude)?;
                finite("frequency", *frequency)?;
                finite("phase", *phase)
            }
            Self::Table(table) => table.check(),
            Self::Sum(signals) => signals.iter().try_for_each(Self::check),
            Self::User(function) => {
                let (value, rate) = function(0.0);
                finite("value at t = 0", value)?;
                finite("rate at t = 0", rate)
            }
        }
    }
}

impl Table {
    fn at(&self, t: f64) -> (f64, f64) {
        let after = self.times.partition_point(|&time| time <= t);
        if after == 0 {
            return (self.values[0], 0.0);
        }
        let k = after - 1;
        if after == self.times.len() {
            return (self.values[k], 0.0);
        }
        let slope = (self.values[after] - self.values[k]) / (self.times[after] - self.times[k]);
        (self.values[k] + slope * (t - self.times[k]), slope)
    }

    fn check(&self) -> Result<(), SignalError> {
        let (times, values) = (self.times.len(), self.values.len());
        if times != values || times == 0 {
            return Err(SignalError::TableLength { times, values });
        }
        for (name, list) in [("times", &self.times), ("values", &self.values)] {
            if let Some(&bad) = list.iter().find(|x| !x.is_finite()) {
                return Err(SignalError::NotFinite(name, bad));
            }
        }
        match self.times.windows(2).position(|pair| pair[1] <= pair[0]) {
            Some(k) => Err(SignalError::TableOrder { index: k + 1, time: self.times[k + 1] }),
            None => Ok(()),
        }
    }
}

impl From<f64> for Signal {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl PartialEq for Signal {
    /// Equal parameters; user functions are equal only if they are the same object.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => a == b,
            (
                Self::Ramp { from, to, start, duration },
                Self::Ramp { from: f, to: e, start: s, duration: d },
            ) => (from, to, start, duration) == (f, e, s, d),
            (
                Self::Sine { amplitude, frequency, phase },
                Self::Sine { amplitude: a, frequency: f, phase: p },
            ) => (amplitude, frequency, phase) == (a, f, p),
            (Self::Table(a), Self::Table(b)) => a == b,
            (Self::Sum(a), Self::Sum(b)) => a == b,
            (Self::User(a), Self::User(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "Constant({value})"),
            Self::Ramp { from, to, start, duration } => {
                write!(f, "Ramp({from} → {to} from {start} s in {duration} s)")
            }
            Self::Sine { amplitude, frequency, phase } => {
                write!(f, "Sine({amplitude}·sin(2π·{frequency}·t + {phase}))")
            }
            Self::Table(table) => write!(f, "Table({} samples)", table.times.len()),
            Self::Sum(signals) => f.debug_tuple("Sum").field(signals).finish(),
            Self::User(_) => write!(f, "User(..)"),
        }
    }
}
