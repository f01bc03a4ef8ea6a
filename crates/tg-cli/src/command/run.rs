//! `tg run`: the motion of a scene, streamed into a results folder.

mod accuracy;
mod channels;
mod recording;

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tg_integrate::{
    Ended, GeneralizedAlpha, NewtonOptions, Run as Integration, State, Stepper, Summary, Symplectic,
};
use tg_report::{Existing, Formats, Kind, Manifest, Results, ResultsWriter, write_glb, write_vtk};
use tg_scene::{Format, RunSettings, Scheme, Structure};

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Run;
use crate::loading::{Loaded, remarks, stem};
use crate::picture::Painter;
use crate::progress::{INTERRUPTED, watch_for_interrupts};
use crate::results::{hash, manifest, set, told, write_view};
use channels::Channels;
use recording::Recording;

pub(crate) fn run(arguments: &Run) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    let settings = settings(&loaded, arguments)?;
    watch_for_interrupts()?;
    with_structure!(&loaded.built, structure => simulate(&loaded, structure, &settings, arguments))
}

/// The scene's run section, with what the command line says instead.
fn settings(loaded: &Loaded, arguments: &Run) -> Result<RunSettings, Failure> {
    let mut settings = match (loaded.file.run(&loaded.set)?, arguments.duration) {
        (Some(settings), _) => settings,
        (None, Some(duration)) if arguments.step.is_some() || arguments.accuracy.is_some() => {
            RunSettings::new(duration)
        }
        (None, _) => {
            let message = "the scene has no [run] section; give --duration and --step";
            return Err(Failure::Usage(message.into()));
        }
    };
    settings.duration = arguments.duration.unwrap_or(settings.duration);
    if arguments.step.is_some() || arguments.accuracy.is_some() {
        (settings.step, settings.accuracy) = (arguments.step, arguments.accuracy);
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
    let mut stepper = stepper(structure, settings)?;
    let formats = Formats {
        csv: settings.formats.contains(&Format::Csv),
        npy: settings.formats.contains(&Format::Npy),
    };
    let painter = Painter::new(structure)?;
    let channels = Channels::new(structure, settings)?;
    let (mut state, step, writer) = if arguments.resume {
        let (state, step) = checkpoint(loaded, &folder)?;
        let writer = ResultsWriter::resume(&folder, formats, state.t)?;
        (state, step, writer)
    } else {
        let (step, evidence) = step(structure, settings)?;
        let manifest = describe(loaded, settings, step, evidence, &channels, &painter);
        let existing = if arguments.force { Existing::Replace } else { Existing::Keep };
        let writer = ResultsWriter::create(&folder, manifest, formats, existing)?;
        let model = &structure.model;
        let state = stepper.start(0.0, &model.initial_coordinates(), &structure.velocities);
        (state.map_err(Failure::analysis)?, step, writer)
    };
    let resumed = arguments.resume.then_some(state.t);
    let mut recording = Recording::new(writer, channels, &painter, settings, (step, resumed));
    let outcome = Integration::new(step, settings.duration)
        .observe(&mut recording)
        .cancel_on(&INTERRUPTED)
        .go(stepper.as_mut(), &mut state);
    let (summary, why) = match outcome {
        Ok(summary) if summary.ended == Ended::Cancelled => (summary, Some("stopped by Ctrl-C".to_string())),
        Ok(summary) => (summary, None),
        Err(error) => (error.summary, Some(error.to_string())),
    };
    let mut warnings = remarks(structure);
    warnings.extend(doubts(&summary));
    let counts = counts(&summary, &state);
    recording.finish(&state, &counts, &warnings, why.clone())?;
    other_formats(&folder, settings)?;
    if !arguments.no_view {
        write_view(&folder, &folder.join("view.html"))?;
    }
    let document = json!({
        "scene": loaded.file.name,
        "results": folder,
        "complete": why.is_none(),
        "interrupted": why,
        "summary": counts,
    });
    let mut text = format!("{}: {} steps of {step} s to t = {} s\n", loaded.title(), summary.steps, state.t);
    text +=
        &if arguments.no_view { format!("results in {}\n", folder.display()) } else { told(Some(&folder)) };
    let mut answer = Answer::new(document, text).warn(warnings);
    answer.failed = why.map(|why| format!("{why}; --resume goes on from t = {} s", state.t));
    Ok(answer)
}

fn stepper<'s, const D: usize>(
    structure: &'s Structure<D>,
    settings: &RunSettings,
) -> Result<Box<dyn Stepper + 's>, Failure> {
    let (model, options) = (&structure.model, NewtonOptions::default());
    Ok(match settings.scheme {
        Scheme::Symplectic => Box::new(Symplectic::new(model, options).map_err(Failure::analysis)?),
        Scheme::GeneralizedAlpha => Box::new(
            GeneralizedAlpha::new(model, settings.spectral_radius, options).map_err(Failure::analysis)?,
        ),
    })
}

/// The step, and what it was chosen by.
fn step<const D: usize>(structure: &Structure<D>, settings: &RunSettings) -> Result<(f64, Value), Failure> {
    match (settings.step, settings.accuracy) {
        (Some(step), _) => Ok((step, Value::Null)),
        (None, Some(accuracy)) => accuracy::step(structure, settings, accuracy),
        (None, None) => Err(Failure::Usage("the run has no step; give --step or --accuracy".into())),
    }
}

fn describe<const D: usize>(
    loaded: &Loaded,
    settings: &RunSettings,
    step: f64,
    evidence: Value,
    channels: &Channels<'_, D>,
    painter: &Painter<'_, D>,
) -> Manifest {
    let settings = json!({
        "command": "run",
        "duration": settings.duration,
        "step": step,
        "accuracy": settings.accuracy,
        "step_chosen_by": evidence,
        "scheme": match settings.scheme {
            Scheme::Symplectic => "symplectic",
            Scheme::GeneralizedAlpha => "generalized-alpha",
        },
        "every": settings.every,
        "frame_rate": settings.frame_rate,
    });
    let mut manifest = manifest(Kind::Run, loaded, painter.outline(), settings);
    manifest.channels = channels.list();
    manifest
}

/// The state and step to go on with.
fn checkpoint(loaded: &Loaded, folder: &Path) -> Result<(State, f64), Failure> {
    let results = Results::open(folder)?;
    let earlier = results.manifest.scene.as_ref().map(|scene| scene.hash.as_str());
    let earlier_set = results.manifest.settings.get("set").unwrap_or(&Value::Null);
    if earlier != Some(hash(loaded).as_str()) || *earlier_set != set(loaded) {
        let message = format!(
            "{}: these results are of another scene or other parameters, or it has changed since",
            folder.display()
        );
        return Err(Failure::Usage(message));
    }
    let checkpoint: Option<recording::Checkpoint> = results.checkpoint()?;
    let checkpoint = checkpoint.ok_or_else(|| {
        Failure::Usage(format!("{}: there is no checkpoint to go on from; use --force", folder.display()))
    })?;
    Ok((checkpoint.state, checkpoint.step))
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

fn counts(summary: &Summary, state: &State) -> Value {
    json!({
        "end": state.t,
        "steps": summary.steps,
        "iterations": summary.iterations,
        "divided_steps": summary.divided,
        "frozen_substeps": summary.frozen,
        "forced_cables": summary.forced,
        "fallbacks": summary.fallbacks,
        "largest_residual": summary.residual,
    })
}

/// What makes the result doubtful.
fn doubts(summary: &Summary) -> Vec<String> {
    let mut doubts = Vec::new();
    if summary.forced > 0 {
        doubts.push(format!(
            "{} times a cable was held taut or slack against its law, where a damped cable re-tensions; a smaller step does \
             so less often",
            summary.forced
        ));
    }
    if summary.divided > summary.steps / 10 {
        doubts.push(format!(
            "{} of {} steps had to be divided; choose a smaller step",
            summary.divided, summary.steps
        ));
    }
    doubts
}
