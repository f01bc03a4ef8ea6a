//! How honest the errors are that a chosen step or tolerance is said to make.

use tg_scene::Scheme;
use tg_trade::{ChoiceError, LOOKS, Method, Quantity, choose};

use super::Options;
use super::scenes::{Measured, with_subject};
use crate::TaskError;
use crate::bench::page::{digits, table};

/// Parts of the largest displacement that are asked for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// A factor by which an estimate may be off, and the share of those that must not be off by more.
const FACTOR: f64 = 5.0;
const SHARE: f64 = 0.95;
/// Times the reference's uncertainty from which an error is known well enough.
const KNOWN: f64 = 10.0;

/// One accuracy asked for.
struct Asked {
    scene: &'static str,
    accuracy: f64,
    method: Method,
    estimated: f64,
    error: f64,
    trials: usize,
}

impl Asked {
    /// Estimated per true error.
    fn ratio(&self) -> f64 {
        self.estimated / self.error
    }

    fn is_honest(&self) -> bool {
        (1.0 / FACTOR..=FACTOR).contains(&self.ratio())
    }
}

/// The table, and whether the estimates are honest.
pub(super) fn section(scenes: &[Measured], options: &Options) -> Result<(String, bool), TaskError> {
    let (mut asked, mut refused) = (Vec::new(), Vec::new());
    for scene in scenes {
        eprintln!("{}: estimates", scene.name);
        for scheme in Scheme::ALL {
            for part in ACCURACIES {
                let accuracy = part * scene.reference.motion.size()[Quantity::Positions];
                match ask(scene, scheme, accuracy, options)? {
                    Ok(found) => asked.push(found),
                    Err(refusal) => refused.push((scene.name, scheme, accuracy, refusal)),
                }
            }
        }
    }
    let known = asked.len();
    let honest = asked.iter().filter(|asked| asked.is_honest()).count();
    let reached = asked.iter().filter(|asked| asked.error <= asked.accuracy).count();
    let share = honest as f64 / known.max(1) as f64;
    let mut text = format!(
        "{known} accuracies: a hundredth, a thousandth and a ten-thousandth of the largest displacement, of every scene by \
         every scheme. {honest} estimates ({:.1} %) are within a factor of {FACTOR} of the true error; {reached} runs \
         ({:.1} %) are as exact as was asked for. {} were not reached within the time or at all, and said so.\n\n",
        100.0 * share,
        100.0 * reached as f64 / known.max(1) as f64,
        refused.len()
    );
    asked.sort_by(|a, b| a.ratio().total_cmp(&b.ratio()));
    let header = ["estimated / true", "scene", "asked [m]", "chosen", "estimated [m]", "true [m]", "trials"];
    text += &table(
        &header.map(String::from),
        &asked.iter().filter(|asked| odd(asked)).map(row).collect::<Vec<_>>(),
    );
    let quantile =
        |part: f64| asked.get((part * (known.max(1) - 1) as f64) as usize).map_or(f64::NAN, Asked::ratio);
    text += &format!(
        "\nThe table has those that are off by more than a factor of 2. Quantiles of the ratio: 5 % {}, 50 % {}, 95 % {}.\n",
        digits(quantile(0.05)),
        digits(quantile(0.5)),
        digits(quantile(0.95))
    );
    let mut words: Vec<String> =
        refused.iter().map(|(scene, scheme, _, why)| format!("- {scene}, {scheme}: {why}")).collect();
    words.dedup();
    text += &format!("\nNot reached:\n\n{}\n", words.join("\n"));
    Ok((text, share >= SHARE))
}

/// Chooses, runs what was chosen, and compares; or why there is nothing to compare.
fn ask(
    scene: &Measured,
    scheme: Scheme,
    accuracy: f64,
    options: &Options,
) -> Result<Result<Asked, String>, TaskError> {
    // Under error control as well steps end where motions are compared.
    let step = scene.settings.duration / f64::from(LOOKS);
    let method = Method { scheme, step, ..Method::of(&scene.settings) };
    let chosen = with_subject!(scene, subject => choose(&subject.limited(options.budget), accuracy, &method));
    let choice = match chosen {
        Ok(choice) => choice,
        Err(ChoiceError::Unreached { tried, .. }) => return Ok(Err(format!("no {tried} reached it"))),
        Err(ChoiceError::TooLong(_)) => return Ok(Err("not within the time".into())),
        Err(error) => return Err(error.into()),
    };
    let motion = with_subject!(scene, subject => subject.motion(&choice.method))?;
    let error = scene.reference.errors(&motion)[Quantity::Positions];
    if error < KNOWN * scene.reference.uncertainty[Quantity::Positions] {
        return Ok(Err("the reference is not known well enough to tell".into()));
    }
    let (estimated, trials) = (choice.error, choice.trials.len());
    Ok(Ok(Asked { scene: scene.name, accuracy, method: choice.method, estimated, error, trials }))
}

fn odd(asked: &Asked) -> bool {
    !(0.5..=2.0).contains(&asked.ratio())
}

fn row(asked: &Asked) -> Vec<String> {
    vec![
        digits(asked.ratio()),
        asked.scene.to_string(),
        digits(asked.accuracy),
        super::schemes::setting(&asked.method),
        digits(asked.estimated),
        digits(asked.error),
        asked.trials.to_string(),
    ]
}
