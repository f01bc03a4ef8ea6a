//! Functions of time as the model takes them; recorded ones from files.

use std::cell::Cell;
use std::collections::HashMap;
use std::sync::Arc;

use tg_model::Signal;

use crate::error::ReadError;
use crate::expression::Variables;
use crate::node::Span;
use crate::quantity::Quantity;
use crate::read::Files;
use crate::signal::{CsvFile, Function, RecordKind, SignalSpec, SignalValue};
use crate::spanned::{Named, Spanned};

/// Signals are copied to where they are used; more terms of sums than this are a slip of the pen.
const MOST_TERMS: usize = if cfg!(fuzzing) { 10_000 } else { 1_000_000 };

/// The named signals of a scene, and where recorded ones are.
pub(crate) struct Signals<'s> {
    named: HashMap<&'s str, Signal>,
    files: &'s dyn Files,
    /// Terms copied so far.
    terms: Cell<usize>,
}

impl<'s> Signals<'s> {
    /// Reads the named signals; each may use those before it.
    pub(crate) fn of(
        named: &'s Named<SignalSpec>,
        variables: &Variables,
        files: &'s dyn Files,
    ) -> Result<Self, ReadError> {
        let mut signals = Self { named: HashMap::new(), files, terms: Cell::new(0) };
        for (name, given) in &named.0 {
            let signal = signals.signal(given, variables)?;
            signals.named.insert(&name.value, signal);
        }
        Ok(signals)
    }

    /// The signal that is written in a scene.
    pub(crate) fn signal(&self, given: &SignalSpec, variables: &Variables) -> Result<Signal, ReadError> {
        let signal = match &given.value {
            SignalValue::Constant(value) => {
                let quantity = Spanned { value: value.clone(), span: given.span.clone() };
                Signal::Constant(variables.number(&quantity)?)
            }
            SignalValue::Function(function) => self.function(function, variables)?,
        };
        signal.check().map_err(|error| ReadError::from_below(&error).at(&given.span))?;
        Ok(signal)
    }

    fn function(&self, function: &Function, variables: &Variables) -> Result<Signal, ReadError> {
        let number = |quantity: &Quantity| variables.number(quantity);
        let or_zero = |quantity: &Option<Quantity>| quantity.as_ref().map_or(Ok(0.0), number);
        let all = |list: &[Quantity]| list.iter().map(number).collect::<Result<Vec<_>, _>>();
        Ok(match function {
            Function::Signal(name) => {
                let signal = self.named.get(name.value.as_str()).ok_or_else(|| {
                    let mut known: Vec<&str> = self.named.keys().copied().collect();
                    known.sort_unstable();
                    let error = ReadError::new(format!("there is no signal \"{}\" above", name.value));
                    error.at(&name.span).suggest(&name.value, &known)
                })?;
                let terms = if let Signal::Sum(list) = signal { list.len() } else { 1 };
                self.terms.set(self.terms.get() + terms);
                if self.terms.get() > MOST_TERMS {
                    let message = format!("the sums of signals have more than {MOST_TERMS} terms");
                    return Err(ReadError::new(message).at(&name.span));
                }
                signal.clone()
            }
            Function::Sine(sine) => Signal::Sine {
                amplitude: number(&sine.amplitude)?,
                frequency: number(&sine.frequency)?,
                phase: or_zero(&sine.phase)?,
            },
            Function::Ramp(ramp) => Signal::Ramp {
                from: number(&ramp.from)?,
                to: number(&ramp.to)?,
                start: or_zero(&ramp.start)?,
                duration: number(&ramp.duration)?,
            },
            Function::Table(table) => {
                let signal = Signal::table(all(&table.times)?, all(&table.values)?);
                let span = table.times.first().map_or(0..0, |first| first.span.clone());
                signal.map_err(|error| ReadError::from_below(&error).at(&span))?
            }
            Function::File(file) => self.recorded(file, variables)?,
            Function::Sum(list) => {
                let mut terms = Vec::new();
                for part in list {
                    // A sum of sums is one, however deep.
                    match self.signal(part, variables)? {
                        Signal::Sum(inner) => terms.extend(inner),
                        other => terms.push(other),
                    }
                }
                Signal::Sum(terms)
            }
        })
    }

    fn recorded(&self, file: &CsvFile, variables: &Variables) -> Result<Signal, ReadError> {
        let wrong = |message: String| ReadError::new(format!("{}: {message}", file.file.value));
        let text = self.files.text(&file.file.value).map_err(|error| {
            wrong(error.to_string()).at(&file.file.span).help("the path counts from the scene's folder")
        })?;
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(|error| wrong(error.to_string()).at(&file.file.span))?.clone();
        let known: Vec<&str> = header.iter().collect();
        let column = |name: &str, span: &Span| {
            let position = known.iter().position(|known| *known == name);
            position
                .ok_or_else(|| wrong(format!("there is no column \"{name}\"")).at(span).suggest(name, &known))
        };
        let time = match &file.time {
            Some(name) => column(&name.value, &name.span)?,
            None => column("t", &file.file.span)?,
        };
        let value = column(&file.value.value, &file.value.span)?;
        let scale = file.scale.as_ref().map_or(Ok(1.0), |scale| variables.number(scale))?;
        let (mut times, mut values) = (Vec::new(), Vec::new());
        for record in reader.records() {
            let record = record.map_err(|error| wrong(error.to_string()).at(&file.file.span))?;
            let line = record.position().map_or(0, csv::Position::line);
            let number = |column: usize| {
                let field = record.get(column).unwrap_or_default();
                let parsed = field.parse::<f64>().ok().filter(|x| x.is_finite());
                parsed.ok_or_else(|| {
                    wrong(format!("line {line}: \"{field}\" is no number")).at(&file.file.span)
                })
            };
            times.push(number(time)?);
            values.push(number(value)? * scale);
        }
        // Checks lengths and the order of times for both kinds.
        let table = Signal::table(times.clone(), values.clone())
            .map_err(|error| wrong(error.to_string()).at(&file.file.span))?;
        Ok(match file.kind.unwrap_or(RecordKind::Value) {
            RecordKind::Value => table,
            RecordKind::Acceleration => GroundMotion::new(times, values).into_signal(),
        })
    }
}

/// Displacement and velocity whose acceleration is piecewise linear through the samples, at rest before the first. A constant is
/// taken from the acceleration so that the ground is at rest after the last sample as well (baseline correction).
struct GroundMotion {
    times: Vec<f64>,
    acceleration: Vec<f64>,
    velocity: Vec<f64>,
    displacement: Vec<f64>,
}

impl GroundMotion {
    fn new(times: Vec<f64>, mut acceleration: Vec<f64>) -> Self {
        let final_velocity: f64 = times
            .windows(2)
            .zip(acceleration.windows(2))
            .map(|(t, a)| (t[1] - t[0]) * (a[0] + a[1]) / 2.0)
            .sum();
        let duration = times[times.len() - 1] - times[0];
        let mean = if duration > 0.0 { final_velocity / duration } else { 0.0 };
        acceleration.iter_mut().for_each(|a| *a -= mean);
        let mut motion = Self { velocity: vec![0.0], displacement: vec![0.0], times, acceleration };
        for k in 1..motion.times.len() {
            let (displacement, velocity) = motion.within(k - 1, motion.times[k]);
            motion.displacement.push(displacement);
            motion.velocity.push(velocity);
        }
        motion
    }

    /// Displacement and velocity at a time within or after interval `k`.
    fn within(&self, k: usize, t: f64) -> (f64, f64) {
        let (h, s) = (self.times[k + 1] - self.times[k], t - self.times[k]);
        let (a, jerk) = (self.acceleration[k], (self.acceleration[k + 1] - self.acceleration[k]) / h);
        let velocity = self.velocity[k] + s * (a + s * jerk / 2.0);
        (self.displacement[k] + s * (self.velocity[k] + s * (a / 2.0 + s * jerk / 6.0)), velocity)
    }

    fn at(&self, t: f64) -> (f64, f64) {
        let last = self.times.len() - 1;
        if t <= self.times[0] {
            return (0.0, 0.0);
        }
        if t >= self.times[last] {
            return (self.displacement[last], 0.0);
        }
        self.within(self.times.partition_point(|time| *time <= t) - 1, t)
    }

    fn into_signal(self) -> Signal {
        let motion = Arc::new(self);
        Signal::user(move |t| motion.at(t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = cos t + 0.3 over a whole period: the correction takes the constant out.
    #[test]
    fn ground_comes_to_rest_and_its_rate_is_its_derivative() {
        let n = 400;
        let times: Vec<f64> = (0..=n).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(n)).collect();
        let acceleration = times.iter().map(|t| t.cos() + 0.3).collect();
        let motion = GroundMotion::new(times, acceleration);
        for t in [0.3, 1.0, 2.5, 6.0] {
            let (value, rate) = motion.at(t);
            assert!(
                (value - (1.0 - t.cos())).abs() < 1e-4 && (rate - t.sin()).abs() < 1e-4,
                "{t}: {value} {rate}"
            );
            let slope = (motion.at(t + 1e-6).0 - motion.at(t - 1e-6).0) / 2e-6;
            assert!((slope - rate).abs() < 1e-8);
        }
        assert_eq!(motion.at(7.0).1, 0.0);
    }
}
