//! Seismic runs.

use super::*;
use std::array::from_fn;

/// Framework reference values (minimal-coordinate model with located events): t and mass centre of triangle 3.
const UN: [[f64; 3]; 6] = [
    [0.0, 0.05, 0.1166666666667],
    [0.4, 0.02541137305027, 0.1106732892912],
    [0.8, 0.02450121681862, 0.1116166889514],
    [1.2, 0.04304916811703, 0.1166609100774],
    [1.6, 0.0471340247356, 0.1164456695935],
    [2.0, 0.02440555422477, 0.1133358155481],
];
const US: [[f64; 3]; 6] = [
    [0.0, 0.05, 0.1166666666667],
    [0.4, 0.04832728763056, 0.1160393706836],
    [0.8, 0.0337022140612, 0.1141768766901],
    [1.2, 0.02301632494888, 0.1144140157632],
    [1.6, 0.02245745910856, -0.08169413777965],
    [2.0, -0.01535480431561, -0.05902183677255],
];

#[test]
fn agrees_with_the_framework_reference_values() -> Result<(), ReferenceError> {
    for (setup, rows) in [(Setup::Un, UN), (Setup::Us, US)] {
        let tower = Tower::paper(setup);
        let run = tower.solve(&rows.map(|r| r[0]))?;
        for (row, s) in rows.iter().zip(&run.trajectory.states) {
            let centre = tower.triangle3_centre(row[0], s);
            // The values are printed to 13 or 14 digits; the fall of US is chaotic.
            let tolerance = if setup == Setup::Us && row[0] > 1.5 { 1e-11 } else { 1e-13 };
            for k in 0..2 {
                assert!((centre[k] - row[1 + k]).abs() < tolerance, "{setup:?} {} {centre:?}", row[0]);
            }
        }
    }
    Ok(())
}

/// Damping and resting anchors shift triangle 3 from the first step on. Framework reference values: x of its mass centre
/// in the paper's own scheme after 1 to 5 steps of 1 ms, whose error is of second order and cancels in the shift from UN.
#[test]
fn setups_part_as_in_the_papers_scheme() -> Result<(), ReferenceError> {
    let scheme_un = [
        0.05000003098156162,
        0.05000012026600501,
        0.05000032586018623,
        0.05000070518464291,
        0.05000131479464237,
    ];
    let scheme_dn = [
        0.05000008845968732,
        0.05000034975327191,
        0.05000084077272823,
        0.05000161731661346,
        0.05000273386081279,
    ];
    let scheme_us_aux = [
        0.05000003282271291,
        0.05000013136686653,
        0.05000036127225374,
        0.05000078801572393,
        0.05000147683058691,
    ];
    let times: [f64; 5] = from_fn(|k| 1e-3 * (k + 1) as f64);
    let x = |setup: Setup| -> Result<[f64; 5], ReferenceError> {
        let tower = Tower::paper(setup);
        let states = tower.solve(&times)?.trajectory.states;
        Ok(from_fn(|k| tower.triangle3_centre(times[k], &states[k])[0]))
    };
    let (un, dn, us_aux) = (x(Setup::Un)?, x(Setup::Dn)?, x(Setup::UsAux)?);
    for k in 0..5 {
        let (damped, scheme) = (dn[k] - un[k], scheme_dn[k] - scheme_un[k]);
        assert!((scheme / damped - 1.0).abs() < 2e-3, "DN, step {k}: {damped:e} {scheme:e}");
        // This shift begins with t³, for which a scheme of second order is off by about 1/(2k²).
        let (resting, scheme) = (us_aux[k] - un[k], scheme_us_aux[k] - scheme_un[k]);
        let step = (k + 1) as f64;
        assert!(
            (scheme / resting - 1.0).abs() < 0.7 / (step * step),
            "US-AUX, step {k}: {resting:e} {scheme:e}"
        );
    }
    Ok(())
}

/// Sec. 6.2.2: who stands and who falls, and which cables are slack.
#[test]
fn only_us_falls() -> Result<(), ReferenceError> {
    for setup in [Setup::Un, Setup::Dn, Setup::UsAux] {
        let run = Tower::paper(setup).solve(&[2.0])?;
        assert_eq!((run.vertex_on_ground, run.singular_pose), (None, None), "{setup:?}");
    }
    let tower = Tower::paper(Setup::Us);
    let run = tower.solve(&[1.4, 2.0])?;
    // On the paper's grid of 1 ms a vertex is first below the ground at 1.424 s.
    let contact = run.vertex_on_ground.unwrap();
    assert!(contact > 1.423 && contact < 1.424);
    let flat = run.singular_pose.unwrap();
    let run = tower.solve(&[contact, flat])?;
    let heights = tower.points(contact, &run.trajectory.states[0]).map(|p| p[1]);
    let lowest = heights[4..].iter().copied().fold(f64::INFINITY, f64::min);
    assert!(lowest.abs() < 1e-13, "{heights:?}");
    assert!((run.trajectory.states[1].theta[0].abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-13);
    Ok(())
}

#[test]
fn slack_intervals_are_those_of_the_lengths() -> Result<(), ReferenceError> {
    let times: Vec<f64> = (0..=4000).map(|k| 5e-4 * f64::from(k)).collect();
    for setup in [Setup::Us, Setup::UsAux, Setup::Dn] {
        let tower = Tower::paper(setup);
        let run = tower.solve(&times)?;
        let inside =
            |cable: usize, t: f64| run.slack.iter().any(|s| s.cable == cable && s.from < t && t < s.to);
        for (&t, s) in times.iter().zip(&run.trajectory.states).take(4000) {
            let slack = tower.slack(t, s);
            (0..CABLES)
                .for_each(|j| assert_eq!(slack[j], inside(j + 1, t), "{setup:?} cable {} at {t}", j + 1));
        }
        let mut ends: Vec<(f64, usize)> =
            run.slack.iter().flat_map(|s| [(s.from, s.cable), (s.to, s.cable)]).collect();
        ends.retain(|(t, _)| *t < 2.0);
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = tower.solve(&ends.iter().map(|e| e.0).collect::<Vec<_>>())?;
        for ((t, cable), s) in ends.iter().zip(&at.trajectory.states) {
            let stretch = tower.cable_lengths(*t, s)[cable - 1] - tower.rest_lengths()[cable - 1];
            assert!(stretch.abs() < 1e-13, "{setup:?} cable {cable} at {t}: {stretch:e}");
        }
    }
    // The paper's counts: almost all cables in US; at 1.23 s one auxiliary cable in US-AUX.
    let slack_at = |setup: Setup, t: f64| -> Result<Vec<usize>, ReferenceError> {
        let run = Tower::paper(setup).solve(&[2.0])?;
        let mut cables: Vec<usize> =
            run.slack.iter().filter(|s| s.from < t && t < s.to).map(|s| s.cable).collect();
        cables.sort_unstable();
        Ok(cables)
    };
    assert_eq!(slack_at(Setup::UsAux, 1.23)?, [1]);
    assert_eq!(slack_at(Setup::Us, 1.228)?, [2, 3, 6, 7, 10, 11]);
    Ok(())
}

#[test]
fn everything_but_the_ground_rests_at_the_start() -> Result<(), ReferenceError> {
    let tower = Tower::paper(Setup::UsAux);
    assert!((tower.start().omega[0] - 0.6 * std::f64::consts::PI).abs() < 1e-14);
    let d = 1e-6;
    let before = tower.points(0.0, &tower.start());
    let after = tower.points(d, &tower.solve(&[d])?.trajectory.states[0]);
    for (k, name) in POINT_NAMES.iter().enumerate() {
        let speed = if k < 2 { 0.06 * std::f64::consts::PI } else { 0.0 };
        assert!(((after[k][0] - before[k][0]) / d - speed).abs() < 1e-6, "{name}");
        assert!(((after[k][1] - before[k][1]) / d).abs() < 2e-4, "{name}");
    }
    Ok(())
}

/// The ground moving the other way gives the mirror image, cables of a pair exchanged.
#[test]
fn mirrored_ground_mirrors_the_motion() -> Result<(), ReferenceError> {
    let tower = Tower::paper(Setup::Us);
    let mirrored = Tower { ground_amplitude: -tower.ground_amplitude, ..tower };
    let (run, image) = (tower.solve(&[0.6, 1.2])?, mirrored.solve(&[0.6, 1.2])?);
    for (s, m) in run.trajectory.states.iter().zip(&image.trajectory.states) {
        for a in 0..ANGLES {
            assert!((s.theta[a] + m.theta[a]).abs() < 1e-12 && (s.omega[a] + m.omega[a]).abs() < 1e-11);
        }
    }
    assert_eq!(run.slack.len(), image.slack.len());
    for (s, m) in run.slack.iter().zip(&image.slack) {
        assert_eq!((s.cable - 1) / 2, (m.cable - 1) / 2);
        assert_ne!(s.cable, m.cable);
        assert!((s.from - m.from).abs() < 1e-12);
    }
    Ok(())
}

#[test]
fn states_do_not_depend_on_the_other_times_requested() -> Result<(), ReferenceError> {
    let tower = Tower::paper(Setup::Us);
    let fine: Vec<f64> = (0..=1200).map(|k| 1e-3 * f64::from(k)).collect();
    let (many, few) = (tower.solve(&fine)?, tower.solve(&[fine[350], fine[1200]])?);
    assert_eq!(many.trajectory.states[350], few.trajectory.states[0]);
    assert_eq!(many.trajectory.states[1200], few.trajectory.states[1]);
    assert_eq!(many.slack, few.slack);
    Ok(())
}

/// α = β = 1: every indicator starts at zero.
#[test]
fn cables_may_start_at_their_rest_lengths() -> Result<(), ReferenceError> {
    let limp = Tower { alpha: 1.0, beta: 1.0, gravity: 0.0, ..still(Setup::Us) };
    let run = limp.solve(&[0.5])?;
    assert_eq!(run.trajectory.states[0], TowerState::default());
    assert!(run.slack.is_empty());
    // Pushed without gravity, the tower keeps its energy while cables tighten and slacken.
    let push = TowerState { omega: [1.0, -2.0, 0.5, 1.5, -1.0], ..TowerState::default() };
    let states = limp.solve_from(&push, &[0.5])?.trajectory.states;
    assert!((limp.energy(0.5, &states[0]) - limp.energy(0.0, &push)).abs() < 1e-14);
    Ok(())
}

#[test]
fn undefined_motions_are_refused() {
    let massless = Tower { bar_mass: 0.0, bar_inertia: 0.0, ..Tower::paper(Setup::Un) };
    assert!(massless.solve(&[0.1]).is_ok(), "massless bars leave a regular mass matrix");
    let infinite = Tower { kappa: f64::INFINITY, ..Tower::paper(Setup::Un) };
    assert!(matches!(infinite.solve(&[0.1]), Err(ReferenceError::StepTooSmall { t: 0.0 })));
    assert!(matches!(
        Tower::paper(Setup::Un).solve(&[1.0, 0.5]),
        Err(ReferenceError::Times { index: 1, .. })
    ));
}
