//! How a run is stepped: as the scene says, or as trial runs choose.

use tg_scene::{RunSettings, Structure};
use tg_trade::{Choice, Method, Subject, choose};

use crate::answer::Failure;
use crate::progress::INTERRUPTED;

/// The method of a run, and what it was chosen by if an accuracy is asked for.
pub(crate) fn method<const D: usize>(
    structure: &Structure<D>,
    settings: &RunSettings,
) -> Result<(Method, Option<Choice>), Failure> {
    let method = Method::of(settings);
    match settings.accuracy {
        Some(accuracy) => {
            let subject = Subject::new(&structure.model, &structure.velocities, settings.duration);
            let choice = choose(&subject.cancel_on(&INTERRUPTED), accuracy, &method);
            let choice = choice.map_err(Failure::analysis)?;
            Ok((choice.method, Some(choice)))
        }
        None if settings.step.or(settings.tolerance).is_some() => Ok((method, None)),
        None => Err(Failure::Usage("the run has no step; give --step or --accuracy".into())),
    }
}

/// A method in words, for people.
pub(super) fn words(method: &Method) -> String {
    match method.tolerance {
        None => format!("{} s", method.step),
        Some(tolerance) => format!("at most {} s, tolerance {tolerance:e},", method.step),
    }
}
