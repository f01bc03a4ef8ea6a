//! `tg trade`: error against processor time of a scene's motion, by every scheme.

mod files;
mod table;

use std::sync::atomic::Ordering::Relaxed;

use serde_json::json;
use tg_scene::{RunSettings, Scheme, Structure};
use tg_trade::{Budget, Curve, Errors, Quantity, Reference, Rung, Subject, cheapest};

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Trade;
use crate::loading::{Loaded, remarks};
use crate::progress::{INTERRUPTED, bar, watch_for_interrupts};

/// Part of the largest displacement that the recommendation is for, if nobody says.
const ACCURACY: f64 = 1e-3;
/// Times the limit of a run that the runs behind the reference may take: it must be finer than all others.
const REFERENCE: f64 = 4.0;

/// What was measured.
struct Measured {
    /// Simulated time \[s\].
    duration: f64,
    reference: Reference,
    curves: Vec<Curve>,
    decades: Vec<Decade>,
    /// Position error that the recommendation is for \[m\].
    accuracy: f64,
    recommended: Option<Rung>,
}

/// The cheapest setting that reaches an error.
struct Decade {
    quantity: Quantity,
    error: f64,
    rung: Rung,
}

pub(crate) fn trade(arguments: &Trade) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    let settings = match (loaded.file.run(&loaded.set)?, arguments.duration) {
        (Some(settings), None) => settings,
        (Some(settings), Some(duration)) => RunSettings { duration, ..settings },
        (None, Some(duration)) => RunSettings::new(duration),
        (None, None) => {
            return Err(Failure::Usage("the scene has no [run] section; give --duration".into()));
        }
    };
    watch_for_interrupts()?;
    with_structure!(&loaded.built, structure => answer(&loaded, structure, &settings, arguments))
}

fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    settings: &RunSettings,
    arguments: &Trade,
) -> Result<Answer, Failure> {
    let measured = measure(structure, settings, arguments)?;
    let document = json!({
        "scene": loaded.file.name,
        "duration": measured.duration,
        "reference": {
            "by": measured.reference.by,
            "uncertainty": measured.reference.uncertainty,
            "checked_by": measured.reference.check.as_ref().map(|(by, _)| by),
            "apart": measured.reference.check.as_ref().map(|(_, apart)| apart),
            "size": measured.reference.motion.size(),
        },
        "curves": measured.curves,
        "cheapest": measured.decades.iter().map(|decade| json!({
            "quantity": decade.quantity,
            "error": decade.error,
            "setting": decade.rung,
        })).collect::<Vec<_>>(),
        "accuracy": measured.accuracy,
        "recommended": measured.recommended,
    });
    let mut text = table::text(&loaded.title(), &measured);
    if let Some(folder) = &arguments.output {
        files::write(folder, &document, &measured)?;
        text += &format!("tables and plots in {}\n", folder.display());
    }
    let mut answer = Answer::new(document, text).warn(remarks(structure));
    if measured.recommended.is_none() {
        answer.failed = Some(format!(
            "no setting reaches {} m within {} s of processor time; give a larger --accuracy or --budget",
            measured.accuracy, arguments.budget
        ));
    }
    Ok(answer)
}

fn measure<const D: usize>(
    structure: &Structure<D>,
    settings: &RunSettings,
    arguments: &Trade,
) -> Result<Measured, Failure> {
    let duration = settings.duration;
    let subject = Subject::new(&structure.model, &structure.velocities, duration).cancel_on(&INTERRUPTED);
    let schemes = if arguments.scheme.is_empty() { Scheme::ALL.to_vec() } else { arguments.scheme.clone() };
    let progress = bar(schemes.len() as u64 + 1, "{wide_bar} {pos} of {len} curves");
    let reference = Reference::new(&subject, REFERENCE * arguments.budget).map_err(|error| {
        Failure::analysis(format!("there is no motion to compare with: {error}; give a larger --budget"))
    })?;
    progress.inc(1);
    let budget = Budget { run: arguments.budget };
    let mut curves = Vec::new();
    for scheme in schemes {
        curves.push(Curve::measure(&subject, &reference, scheme, settings.spectral_radius, budget));
        progress.inc(1);
        if INTERRUPTED.load(Relaxed) {
            return Err(Failure::analysis("stopped by Ctrl-C before all schemes were measured"));
        }
    }
    progress.finish_and_clear();
    let size = reference.motion.size();
    let asked = arguments.accuracy.or(settings.accuracy);
    let accuracy = asked.unwrap_or(ACCURACY * size[Quantity::Positions]);
    let recommended = cheapest(&curves, Quantity::Positions, accuracy).cloned();
    let decades = decades(&curves, &reference, &size);
    Ok(Measured { duration, reference, curves, decades, accuracy, recommended })
}

/// The cheapest setting for every power of ten between how much a quantity varies and the reference's uncertainty.
fn decades(curves: &[Curve], reference: &Reference, size: &Errors) -> Vec<Decade> {
    let mut decades = Vec::new();
    for quantity in Quantity::ALL {
        let (largest, least) =
            (size[quantity].log10().floor(), reference.uncertainty[quantity].log10().ceil());
        if !(largest.is_finite() && least.is_finite()) {
            continue;
        }
        for power in (least as i32..=largest as i32 - 1).rev() {
            let error = 10.0_f64.powi(power);
            let rung = cheapest(curves, quantity, error).cloned();
            decades.extend(rung.map(|rung| Decade { quantity, error, rung }));
        }
    }
    decades
}
