//! `tg run`: the motion of a scene, streamed into a results folder.

mod channels;
mod checkpoint;
mod method;
mod outcome;
mod recording;

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::json;
use tg_integrate::{Run as Integration, Turning};
use tg_report::{Existing, Formats, Kind, Manifest, Results, ResultsWriter, write_glb, write_vtk};
use tg_scene::{Format, RunSettings, Structure};
use tg_trade::{Choice, Method};

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Run;
use crate::loading::{Loaded, remarks, stem};
use crate::picture::Painter;
use crate::progress::{INTERRUPTED, watch_for_interrupts};
use crate::results::{manifest, told, write_view};
use channels::Channels;
use checkpoint::Earlier;
use outcome::counts;
use recording::Recording;

pub(crate) use method::method;
pub(crate) use outcome::{doubts, ended};

pub(crate) fn run(arguments: &Run) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    let settings = settings(&loaded, arguments)?;
    watch_for_interrupts()?;
    with_structure!(&loaded.built, structure => simulate(&loaded, structure, &settings, arguments))
}

/// The scene's run section, with what the command line says instead.
fn settings(loaded: &Loaded, arguments: &Run) -> Result<RunSettings, Failure> {
    let &Run { duration, step, accuracy, scheme, tolerance, .. } = arguments;
    let mut settings = match (loaded.file.run(&loaded.set)?, duration) {
        (Some(settings), _) => settings,
        (None, Some(duration)) if step.or(accuracy).or(tolerance).is_some() => RunSettings::new(duration),
        (None, _) => {
            let message = "the scene has no [run] section; give --duration and --step";
            return Err(Failure::Usage(message.into()));
        }
    };
    settings.duration = duration.unwrap_or(settings.duration);
    if let Some(scheme) = scheme {
        settings.scheme = scheme;
        // A tolerance of the scene is one of the scene's scheme.
        settings.tolerance = settings.tolerance.filter(|_| scheme.controls_error());
    }
    if accuracy.is_some() {
        (settings.step, settings.accuracy, settings.tolerance) = (None, accuracy, None);
    }
    if step.is_some() {
        (settings.step, settings.accuracy) = (step, None);
    }
    if tolerance.is_some() {
        if !settings.scheme.controls_error() {
            let message = format!(
                "the scheme {} has no error control; leave --tolerance out, or give --scheme runge-kutta-5 or \
                 runge-kutta-8",
                settings.scheme
            );
            return Err(Failure::Usage(message));
        }
        (settings.tolerance, settings.accuracy) = (tolerance, None);
    }
    Ok(settings)
}

/// The results folder that a scene gets if the user names none.
fn default_folder(loaded: &Loaded) -> PathBuf {
    PathBuf::from(format!("{}-run", stem(Path::new(&loaded.file.name))))
}

fn simulate<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    settings: &RunSettings,
    arguments: &Run,
) -> Result<Answer, Failure> {
    let folder = arguments.output.clone().unwrap_or_else(|| default_folder(loaded));
    let formats = Formats {
        csv: settings.formats.contains(&Format::Csv),
        npy: settings.formats.contains(&Format::Npy),
    };
    let painter = Painter::new(structure)?;
    let channels = Channels::new(structure, settings)?;
    let mut warnings = Vec::new();
    let mut existing = if arguments.force { Existing::Replace } else { Existing::Keep };
    let mut earlier = None;
    if arguments.resume {
        match Earlier::find(loaded, structure, &folder, arguments)? {
            Earlier::At(checkpoint) => earlier = Some(*checkpoint),
            Earlier::Nothing { folder: begun } => {
                let folder = folder.display();
                warnings.push(format!("{folder}: there was nothing to go on with; the run was begun anew"));
                existing = if begun { Existing::Replace } else { Existing::Keep };
            }
        }
    }
    let (method, choice) = match &earlier {
        Some(earlier) => (earlier.method, None),
        None => method(structure, settings)?,
    };
    let model = &structure.model;
    let mut stepper = method.stepper(model).map_err(Failure::analysis)?;
    let before = earlier.as_ref().map(|earlier| (earlier.state.t, earlier.totals));
    let (mut state, writer) = if let Some(earlier) = earlier {
        let writer = ResultsWriter::resume(&folder, formats, earlier.state.t)?;
        (earlier.state, writer)
    } else {
        let manifest = describe(loaded, settings, &method, choice.as_ref(), &channels, &painter);
        let writer = ResultsWriter::create(&folder, manifest, formats, existing)?;
        let state = stepper.start(0.0, &model.initial_coordinates(), &structure.velocities);
        (state.map_err(Failure::analysis)?, writer)
    };
    let mut turning = Turning::default();
    // A very long time is none that a clock can tell.
    let between = Duration::try_from_secs_f64(arguments.checkpoint_every).unwrap_or(Duration::MAX);
    let mut recording = Recording::new(writer, channels, &painter, (settings, between), method, before);
    let outcome = Integration::new(method.step, settings.duration)
        .observe(&mut recording)
        .observe(&mut turning)
        .cancel_on(&INTERRUPTED)
        .go(stepper.as_mut(), &mut state);
    let (summary, why) = ended(outcome);
    let summary = recording.totals(summary);
    warnings.extend(remarks(structure));
    warnings.extend(doubts(&summary, &turning, &method));
    let mut counts = counts(&summary, &state);
    counts["estimated_error"] = json!(choice.as_ref().map(|choice| choice.error));
    recording.finish(&state, &counts, &warnings, why.clone())?;
    pictures(&folder, settings, arguments).map_err(|failure| {
        let folder = folder.display();
        Failure::analysis(format!("{failure}; the results are complete, `tg view {folder}` makes their page"))
    })?;
    let document = json!({
        "scene": loaded.file.name,
        "results": folder,
        "complete": why.is_none(),
        "interrupted": why,
        "summary": counts,
    });
    let (steps, words) = (summary.steps, method::words(&method));
    let mut text = format!("{}: {steps} steps of {words} to t = {} s\n", loaded.title(), state.t);
    if let (Some(choice), None) = (&choice, &why) {
        let error = choice.error;
        text += &format!(
            "chosen by {} trials; positions are exact to about {error:.1e} m\n",
            choice.trials.len()
        );
    }
    text +=
        &if arguments.no_view { format!("results in {}\n", folder.display()) } else { told(Some(&folder)) };
    let mut answer = Answer::new(document, text).warn(warnings);
    answer.failed = why.map(|why| format!("{why}; --resume goes on from t = {} s", state.t));
    Ok(answer)
}

fn describe<const D: usize>(
    loaded: &Loaded,
    settings: &RunSettings,
    method: &Method,
    choice: Option<&Choice>,
    channels: &Channels<'_, D>,
    painter: &Painter<'_, D>,
) -> Manifest {
    let settings = json!({
        "command": "run",
        "duration": settings.duration,
        "step": method.step,
        "tolerance": method.tolerance,
        "accuracy": settings.accuracy,
        "step_chosen_by": choice,
        "scheme": method.scheme,
        "every": settings.every,
        "frame_rate": settings.frame_rate,
    });
    let mut manifest = manifest(Kind::Run, loaded, painter.outline(), settings);
    manifest.channels = channels.list();
    manifest
}

/// What is made of the results: the page, and the formats with pictures.
fn pictures(folder: &Path, settings: &RunSettings, arguments: &Run) -> Result<(), Failure> {
    other_formats(folder, settings)?;
    if arguments.no_view { Ok(()) } else { write_view(folder, &folder.join("view.html")) }
}

fn other_formats(folder: &Path, settings: &RunSettings) -> Result<(), Failure> {
    let (vtk, gltf) = (settings.formats.contains(&Format::Vtk), settings.formats.contains(&Format::Gltf));
    if !vtk && !gltf {
        return Ok(());
    }
    let results = Results::open(folder)?;
    let Some(outline) = &results.manifest.outline else { return Ok(()) };
    let frames = results.frames()?;
    if vtk {
        write_vtk(&folder.join("motion.pvd"), outline, &frames)?;
    }
    if gltf {
        write_glb(&folder.join("motion.glb"), outline, &frames)?;
    }
    Ok(())
}
