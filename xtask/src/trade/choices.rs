//! One choice against the other on one structure: what each costs and how far the motion is off.

mod alpha;
mod bars;
mod coordinates;
mod newton;
mod output;
mod slack;

use tg_integrate::{NewtonOptions, Stepper, Symplectic};
use tg_model::Model;
use tg_trade::{Motion, Quantity, Reference, Subject, TrialError};

use crate::TaskError;
use crate::bench::page::{digits, table};

/// Runs of which the fastest counts.
const REPEATS: usize = 5;
/// Processor time of the runs behind a reference \[s\].
const REFERENCE: f64 = 4.0;

/// A table with its heading and what it says.
struct Topic {
    title: &'static str,
    text: &'static str,
    table: String,
}

/// All topics.
pub(super) fn section() -> Result<String, TaskError> {
    let topics: [fn() -> Result<Topic, TaskError>; 9] = [
        newton::tolerance,
        newton::kept_factors,
        newton::projection,
        alpha::spectral_radius,
        coordinates::coordinate_type,
        coordinates::joints,
        bars::thick,
        slack::smoothed,
        output::stride,
    ];
    let mut text = String::new();
    for topic in topics {
        let Topic { title, text: words, table } = topic()?;
        eprintln!("{title}");
        text += &format!("### {title}\n\n{words}\n\n{table}\n");
    }
    Ok(text)
}

/// What a motion of one choice costs, beside what it gives.
struct Cost {
    name: String,
    motion: Motion,
}

impl Cost {
    /// The fastest of some runs by a stepper of its own each.
    fn of<'m, const D: usize, S: Stepper + 'm>(
        name: impl Into<String>,
        subject: &Subject<'m, D>,
        step: f64,
        make: impl Fn(&'m Model<D>) -> Result<S, tg_integrate::StartError>,
    ) -> Result<Self, TrialError> {
        let run = || subject.motion_by(&mut make(subject.model())?, step);
        let mut motion: Motion = run()?;
        for _ in 1..REPEATS {
            motion.seconds = motion.seconds.min(run()?.seconds);
        }
        Ok(Self { name: name.into(), motion })
    }

    /// The symplectic scheme as it is by default.
    fn symplectic<'m, const D: usize>(
        name: impl Into<String>,
        subject: &Subject<'m, D>,
        step: f64,
    ) -> Result<Self, TrialError> {
        Self::of(name, subject, step, |model| Symplectic::new(model, NewtonOptions::default()))
    }

    /// Time and iterations of a step.
    fn per_step(&self) -> [String; 2] {
        let summary = &self.motion.summary;
        let steps = summary.steps as f64;
        [digits(1e6 * self.motion.seconds / steps), digits(summary.iterations as f64 / steps)]
    }
}

/// A row of the table for each choice: cost of a step, errors against a motion.
fn rows(costs: &[Cost], reference: &Motion) -> Vec<Vec<String>> {
    let row = |cost: &Cost| {
        let errors = reference.distance(&cost.motion);
        let mut row = vec![cost.name.clone()];
        row.extend(cost.per_step());
        row.extend(Quantity::ALL.map(|quantity| digits(errors[quantity])));
        row
    };
    costs.iter().map(row).collect()
}

/// The table of such rows.
fn of_rows(head: &str, rows: &[Vec<String>]) -> String {
    let header = [head, "µs per step", "iterations", "positions [m]", "tensions [N]", "energy [J]"];
    table(&header.map(String::from), rows)
}

/// The table of choices that are held against one motion.
fn against(head: &str, costs: &[Cost], reference: &Motion) -> String {
    of_rows(head, &rows(costs, reference))
}

/// The true motion of a subject.
fn truth<const D: usize>(subject: &Subject<'_, D>) -> Result<Motion, TrialError> {
    Ok(Reference::new(subject, REFERENCE)?.motion)
}
