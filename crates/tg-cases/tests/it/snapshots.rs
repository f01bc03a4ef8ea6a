//! Key numbers, rounded far above the differences between machines (chaos multiplies rounding by 1e3 over 4 s).

use tg_cases::deployable::{Choices, Configuration, Deployable, statics};
use tg_cases::published::framework;
use tg_cases::simulate::{STEP, record, run};
use tg_cases::slack::SlackWatch;
use tg_cases::verify::tower::frequency_curves;
use tg_cases::{double_pendulum, tower};

/// Rounded to nanometres or nanoradians; no negative zero.
fn rounded(x: f64) -> String {
    format!("{:.9}", (x * 1e9).round() / 1e9 + 0.0)
}

#[test]
fn double_pendulum_angles() {
    let pendulum = double_pendulum::DoublePendulum::new(double_pendulum::Choices::default()).unwrap();
    let angles = record(&pendulum.model, STEP, 2.0, |state| pendulum.angles(state)).unwrap();
    let lines: Vec<String> = angles
        .iter()
        .enumerate()
        .step_by(250)
        .map(|(k, [a, b])| format!("{:.2} s: {} {}", k as f64 * STEP, rounded(*a), rounded(*b)))
        .collect();
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn tower_setups() {
    let mut lines = Vec::new();
    for setup in tower::Setup::ALL {
        let tower = tower::Tower::new(&tower::Choices::paper(setup)).unwrap();
        let centres = record(&tower.model, STEP, 1.2, |state| tower.centre3.eval(&state.q)).unwrap();
        for k in [300, 600, 900, 1200] {
            let (x, y) = (rounded(centres[k].x), rounded(centres[k].y));
            lines.push(format!("{} {:.1} s: {x} {y}", setup.name(), k as f64 * STEP));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn slack_intervals() {
    let mut lines = Vec::new();
    for setup in [tower::Setup::Us, tower::Setup::UsAux] {
        let tower = tower::Tower::new(&tower::Choices::paper(setup)).unwrap();
        let mut watch = SlackWatch::default();
        run(&tower.model, STEP, 1.2, |state| watch.see(state.t, tower.stretches(state))).unwrap();
        for s in watch.finish() {
            let (cable, from, to) = (s.cable + 1, s.from, s.to);
            lines.push(format!("{} cable {cable}: {from:.5} s to {to:.5} s", setup.name()));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn deployable_tower_vibrates_and_unfolds() {
    let published = &framework().example3;
    let [initial, target] = [&published.initial.rest, &published.target.rest];
    let mut lines = Vec::new();
    for (name, choices, end) in [
        ("initial", Choices::still(Configuration::Initial, initial), 3),
        ("target", Choices::still(Configuration::Target, target), 3),
        ("deployment in 10 s", Choices::deployment(initial, target, 10.0), 8),
    ] {
        let structure = Deployable::new(&choices.on_seismic_ground(0.5)).unwrap();
        let top = &structure.centres[3];
        let path = record(&structure.model, STEP, f64::from(end), |state| top.eval(&state.q)).unwrap();
        for k in 1..=end {
            let p = path[1000 * k as usize];
            lines.push(format!("{name} {k} s: {} {} {}", rounded(p.x), rounded(p.y), rounded(p.z)));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn tower_frequencies_against_the_ratio() {
    let (ratios, curves) = frequency_curves().unwrap();
    let line = |k: usize| {
        let values: Vec<String> = curves.iter().map(|curve| rounded(curve[k])).collect();
        format!("{:.3}: {}", ratios[k], values.join(" "))
    };
    insta::assert_snapshot!((0..ratios.len()).map(line).collect::<Vec<_>>().join("\n"));
}

#[test]
fn deployable_tower_statics() {
    let mut lines = Vec::new();
    for configuration in Configuration::ALL {
        let answer = statics::inverse(&statics::untuned(configuration).unwrap()).unwrap();
        lines.push(configuration.name().to_string());
        for row in answer.cutting_list() {
            let numbers = [row.length, row.rest_length, row.tension, row.strain].map(rounded);
            lines.push(format!("{}: {}", row.cable, numbers.join(" ")));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}
