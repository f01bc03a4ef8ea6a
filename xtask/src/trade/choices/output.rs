//! How often rows are written.

use std::fs;

use tg_fixtures::mast;
use tg_integrate::{NewtonOptions, Run, State, StepReport, Stepper, Symplectic};
use tg_report::{Channel, Existing, Formats, Kind, Manifest, ReportError, ResultsWriter};

use super::Topic;
use crate::TaskError;
use crate::bench::clock::timed;
use crate::bench::page::{digits, table};

/// Step and simulated time \[s\].
const STEP: f64 = 1e-3;
const END: f64 = 1.0;

pub(super) fn stride() -> Result<Topic, TaskError> {
    let folder = std::env::temp_dir().join(format!("tg-stride-{}", std::process::id()));
    let none = seconds(None, &folder)?;
    let mut rows = vec![vec!["none".into(), digits(1e6 * none * STEP / END), digits(1.0), "–".into()]];
    for every in [1_u32, 2, 5, 10, 100] {
        let time = seconds(Some(every), &folder)?;
        let bytes = size(&folder)?;
        fs::remove_dir_all(&folder)?;
        rows.push(vec![
            format!("every {every}"),
            digits(1e6 * time * STEP / END),
            digits(time / none),
            digits(1e-3 * bytes as f64),
        ]);
    }
    let header = ["rows", "µs per step", "times no rows", "kB"].map(String::from);
    Ok(Topic {
        title: "Output stride",
        text: "Guyed mast of 8 stages, 1 s in steps of 1 ms; rows of its 96 lengths and tensions and its energies into a results \
               folder, every step or fewer (`every` of a scene).",
        table: table(&header, &rows),
    })
}

/// Processor time of the run, with rows every so many steps.
fn seconds(every: Option<u32>, folder: &std::path::Path) -> Result<f64, TaskError> {
    let mast = mast(8)?;
    let model = &mast.model;
    let mut channels = vec![Channel::time(), Channel::new("energy", "J", "energy")];
    for cable in model.cables() {
        for (what, unit) in [("tension", "N"), ("length", "m")] {
            channels.push(Channel::new(format!("{}.{what}", model.cable_name(cable)), unit, what));
        }
    }
    let writer = every.map(|every| -> Result<_, ReportError> {
        let manifest = Manifest { channels, ..Manifest::new(Kind::Run, "stride") };
        Ok((every, ResultsWriter::create(folder, manifest, Formats::default(), Existing::Replace)?))
    });
    let mut writer = writer.transpose()?;
    let mut stepper = Symplectic::new(model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    let mut failed = Ok(());
    let (seconds, done) = timed(|| -> Result<(), TaskError> {
        let mut count = 0;
        let mut write = |State { t, q, v, .. }: &State, _: &StepReport| {
            if let Some((every, writer)) = &mut writer
                && count % *every == 0
            {
                let inputs = model.inputs_at(*t);
                let mut row = vec![*t, model.energy(q, v, &inputs).total()];
                for cable in model.cables() {
                    let cable = model.cable(cable, q, v, &inputs);
                    row.extend([cable.tension, cable.length]);
                }
                if let (Err(error), Ok(())) = (writer.row(&row), &failed) {
                    failed = Err(error);
                }
            }
            count += 1;
        };
        Run::new(STEP, END).observe(&mut write).go(&mut stepper, &mut state)?;
        if let Some((_, writer)) = writer {
            writer.finish(|_| ())?;
        }
        Ok(())
    });
    failed?;
    done?;
    Ok(seconds)
}

/// Bytes of the trajectory.
fn size(folder: &std::path::Path) -> Result<u64, TaskError> {
    let parts = fs::read_dir(folder.join("trajectory"))?;
    parts.map(|part| Ok(part?.metadata()?.len())).sum()
}
