//! Inverse statics of both states (Table 5), and the way back.

use tg_statics::{Forward, ForwardOptions, Verdict, stability};

use super::published;
use crate::deployable::statics::{inverse, solution_set, untuned};
use crate::deployable::{Choices, Configuration, Deployable};
use crate::error::CaseError;
use crate::published::EXACT;
use crate::reference::deployable as minimal;
use crate::row::Rows;

const TABLE: &str = "paper, Table 5";
const SECTION: &str = "paper, Sec. 6.3.1";
const MODEL: &str = "24-coordinate model of this project";

/// Rest lengths of cables 1 to 3, 4 to 6, .. as Table 5 prints them \[m\], with the unit of the last digit.
const PRINTED: [[(f64, f64); 8]; 2] = [
    [
        (0.1039, 1e-4),
        (0.1677, 1e-4),
        (0.1045, 1e-4),
        (0.07235, 1e-5),
        (0.03, 1e-5),
        (0.1, 1e-4),
        (0.03, 1e-5),
        (0.08412, 1e-5),
    ],
    [
        (0.1545, 1e-4),
        (0.1109, 1e-4),
        (0.1550, 1e-4),
        (0.07235, 1e-5),
        (0.03, 1e-5),
        (0.1, 1e-4),
        (0.03, 1e-5),
        (0.08412, 1e-5),
    ],
];

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    for (configuration, printed) in Configuration::ALL.into_iter().zip(PRINTED) {
        table(rows, configuration, &printed)?;
        way_back(rows, configuration)?;
    }
    Ok(())
}

fn table(rows: &mut Rows, configuration: Configuration, printed: &[(f64, f64); 8]) -> Result<(), CaseError> {
    let (name, known) = (configuration.name(), published(configuration));
    let structure = untuned(configuration)?;
    let set = solution_set(&structure)?;
    rows.exact(format!("{name}: rank of B"), (set.rank.rank, 21), SECTION);
    rows.exact(format!("{name}: dimensions of the solution set"), (set.null_space.len(), 3), SECTION);
    let (_, zero) = set.rank.gap();
    rows.below(
        format!("{name}: largest singular value of B that counts as zero, per the largest"),
        "1",
        zero.unwrap_or(f64::NAN),
        "rounding",
        1e-14,
    );
    let answer = inverse(&structure)?;
    rows.exact(
        format!("{name}: dimensions with nine rest lengths given"),
        (answer.set.null_space.len(), 0),
        SECTION,
    );
    for (group, &(printed, unit)) in printed.iter().enumerate() {
        let (first, last) = (3 * group + 1, 3 * group + 3);
        for (k, rest) in (first..=last).zip(&answer.rest_lengths[first - 1..last]) {
            rows.near(
                format!("{name}: rest length of cable {k}"),
                "m",
                (*rest, printed),
                TABLE,
                0.5001 * unit,
            );
        }
    }
    let worst = |ours: &[f64], theirs: &[f64]| {
        ours.iter().zip(theirs).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    };
    let rest = worst(&answer.rest_lengths, &known.rest);
    rows.below(format!("{name}: rest lengths, largest relative difference"), "1", rest, EXACT, 1e-9);
    let tensions = worst(&answer.tensions, &known.tensions);
    rows.below(format!("{name}: tensions, largest relative difference"), "1", tensions, EXACT, 1e-9);
    let slack = answer.tensions.iter().filter(|&&f| f <= 0.0).count();
    rows.exact(format!("{name}: slack cables"), (slack, 0), SECTION);

    let rest: [f64; 24] = std::array::from_fn(|k| answer.rest_lengths[k]);
    let gradient = minimal::Model::new(twin(configuration), &rest).gradient().amax();
    rows.below(format!("{name}: largest generalised force with them"), "N", gradient, MODEL, 1e-12);
    Ok(())
}

/// Perturbed, the structure comes back to where inverse statics wanted it, and is stable there.
fn way_back(rows: &mut Rows, configuration: Configuration) -> Result<(), CaseError> {
    let name = configuration.name();
    let rest = crate::deployable::statics::rest_lengths(configuration)?;
    let structure = Deployable::new(&Choices::still(configuration, &rest))?;
    let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
    let mut far = q.clone();
    let free = tg_model::Mechanics::free(&structure.model);
    free.iter().enumerate().for_each(|(k, &i)| far[i] += 0.005 * (1.0 + 1.3 * k as f64).sin());
    let found = Forward::new(&structure.model, ForwardOptions::default()).solve(&far, &u)?;
    let apart = found.configuration.q.iter().zip(&q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    rows.below(
        format!("{name}: perturbed by 5 mm and solved, largest distance from the start"),
        "m",
        apart,
        "round trip of inverse and forward statics",
        1e-10,
    );
    let stability = stability(&structure.model, &found.configuration, 1)?;
    let unstable = usize::from(stability.verdict != Verdict::Stable);
    rows.exact(format!("{name}: directions without stiffness"), (unstable, 0), SECTION);
    rows.exact(
        format!("{name}: positive eigenvalues of the Hessian"),
        (stability.counts.positive, 24),
        SECTION,
    );
    Ok(())
}

/// The same configuration in the independent model's own words.
pub(super) fn twin(configuration: Configuration) -> minimal::Configuration {
    match configuration {
        Configuration::Initial => minimal::Configuration::Initial,
        Configuration::Target => minimal::Configuration::Target,
    }
}
