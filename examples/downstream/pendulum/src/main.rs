// A guyed mast on a shaken ground: build, simulate, look at a cable.

use std::error::Error;

use tg_integrate::{NewtonOptions, Recorder, Run, Stepper, Symplectic};
use tg_model::{CableLaw, Joining, ModelBuilder, Signal};

fn main() -> Result<(), Box<dyn Error>> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81])?;
    let mast = b.bar("mast", 1.0, [0.0, 0.0], [0.0, 2.0])?;
    let law = CableLaw::slacking(2e3).with_damping(5.0);
    let mut guys = Vec::new();
    let foot = b.anchor("foot", [0.0, 0.0])?;
    b.joint("hinge", &[foot.into(), mast.node(0)], Joining::Share)?;
    b.shake("ground", foot, Signal::sine(0.02, 1.5))?;
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x, 0.0])?;
        guys.push(b.cable(&format!("{name} guy"), peg, mast.node(1), law.clone(), 2.2)?);
    }
    let model = b.build()?;
    println!("{}", model.report());

    let top = model.form(mast.node(1))?;
    let mut recorder =
        Recorder::every(10).channel("top x", |state| top.eval(&state.q).x).channel("left tension", |state| {
            model.cable(guys[0], &state.q, &state.v, &model.inputs_at(state.t)).tension
        });
    let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    let summary = Run::new(1e-3, 2.0).observe(&mut recorder).go(&mut stepper, &mut state)?;

    let largest = |name| recorder.values(name).into_iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
    println!(
        "{} steps: the top swings {:.1} mm, the left guy pulls up to {:.1} N",
        summary.steps,
        1e3 * largest("top x"),
        largest("left tension")
    );
    if largest("top x") < 0.5 { Ok(()) } else { Err("the mast fell".into()) }
}
