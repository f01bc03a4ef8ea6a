//! Energy and work along the motion.

use super::*;
use std::array::from_fn;

#[test]
fn energy_is_constant_on_still_ground() -> Result<(), ReferenceError> {
    let times: Vec<f64> = (0..=400).map(|k| 5e-3 * f64::from(k)).collect();
    for setup in [Setup::Un, Setup::Us] {
        let tower = still(setup);
        let e0 = tower.energy(0.0, &some_state());
        let run = tower.solve_from(&some_state(), &times)?;
        for (&t, s) in times.iter().zip(&run.trajectory.states) {
            assert!(
                (tower.energy(t, s) - e0).abs() < 1e-12 * e0,
                "{setup:?} {t} {}",
                tower.energy(t, s) - e0
            );
        }
        if setup == Setup::Us {
            assert!(run.slack.len() > 20);
        }
    }
    Ok(())
}

/// Nodes and weights over the intervals between `breaks`: Gauss's rule with five points on panels of at most `panel`.
fn quadrature(breaks: &[f64], panel: f64) -> (Vec<f64>, Vec<f64>) {
    let inner = (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let outer = (5.0 + 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let (w1, w2) = ((322.0 + 13.0 * 70.0_f64.sqrt()) / 900.0, (322.0 - 13.0 * 70.0_f64.sqrt()) / 900.0);
    let rule = [(-outer, w2), (-inner, w1), (0.0, 128.0 / 225.0), (inner, w1), (outer, w2)];
    let (mut nodes, mut weights) = (vec![], vec![]);
    for ends in breaks.windows(2) {
        let panels = ((ends[1] - ends[0]) / panel).ceil();
        let half = 0.5 * (ends[1] - ends[0]) / panels;
        for p in 0..panels as u32 {
            nodes.extend(rule.map(|(x, _)| ends[0] + half * (2.0 * f64::from(p) + 1.0 + x)));
            weights.extend(rule.map(|(_, w)| half * w));
        }
    }
    (nodes, weights)
}

/// l̇_j from lengths an instant apart, along the state's own velocities.
fn length_rates(tower: &Tower, t: f64, s: &TowerState) -> [f64; CABLES] {
    let d = 1e-4;
    let at = |k: f64| {
        let moved = TowerState { theta: from_fn(|a| s.theta[a] + k * d * s.omega[a]), ..*s };
        tower.cable_lengths(t, &moved)
    };
    let (m2, m1, p1, p2) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
    from_fn(|j| (8.0 * (p1[j] - m1[j]) - (p2[j] - m2[j])) / (12.0 * d))
}

/// Still ground: E falls by ∫ Σ_j η l̇_j² dt. With slacking, power is lost as (f - κ(l - μ)) l̇ wherever l > μ, which
/// counts the cable that (30) lets go while it is still stretched.
#[test]
fn damping_takes_what_the_cables_dissipate() -> Result<(), ReferenceError> {
    for (slacking, eta, panel, tolerance) in [(false, 0.1, 2e-3, 1e-9), (true, 0.5, 2e-4, 5e-7)] {
        let tower = Tower { slacking, eta, ..still(Setup::Dn) };
        // The damping force jumps where a cable is taut again; where (30) lets go the integrand has a kink, which
        // leaves the quadrature of second order in the panel.
        let mut breaks = vec![0.0];
        let slack = tower.solve_from(&some_state(), &[0.5])?.slack;
        breaks.extend(slack.iter().map(|s| s.to).filter(|t| *t < 0.5));
        breaks.sort_by(f64::total_cmp);
        breaks.push(0.5);
        let (mut times, weights) = quadrature(&breaks, panel);
        times.push(0.5);
        let run = tower.solve_from(&some_state(), &times)?;
        let states = &run.trajectory.states;
        let mut lost = 0.0;
        for ((&t, s), w) in times.iter().zip(states).zip(&weights) {
            let (rates, f) = (length_rates(&tower, t, s), tower.tensions(t, s));
            let (l, mu) = (tower.cable_lengths(t, s), tower.rest_lengths());
            for j in (0..CABLES).filter(|j| !slacking || l[*j] > mu[*j]) {
                lost += w * (f[j] - tower.kappa * (l[j] - mu[j])) * rates[j];
            }
        }
        let fall = tower.energy(0.0, &some_state()) - tower.energy(0.5, &states[times.len() - 1]);
        assert!(fall > 0.05, "{fall}");
        assert!((fall - lost).abs() < tolerance, "{slacking} {fall} {lost}");
    }
    Ok(())
}

/// Moving ground: all horizontal forces on the tower act at the ground points, which share the velocity ẋ_g, so that
/// dE/dt = ẋ_g dP/dt with the momentum P = dX/dt, X = Σ m x. By parts, to a time t1 with ẋ_g = 0,
/// E(t1) - E(0) = -ẋ_g(0) P(0) - ẍ_g(t1) X(t1) + ẍ_g(0) X(0) + ∫ x⃛_g X dt.
#[test]
fn moving_ground_does_the_work_of_its_reaction() -> Result<(), ReferenceError> {
    let tower = Tower::paper(Setup::Un);
    let t1 = 1.0 / 12.0 + 1.0 / 6.0 * 6.0;
    let (mut times, weights) = quadrature(&[0.0, t1], 5e-3);
    times.push(t1);
    let states = tower.solve(&times)?.trajectory.states;
    let moment = |t: f64, s: &TowerState| -> f64 {
        let (b, d) = (tower.bar_mass, tower.triangle_mass);
        tower.mass_centres(t, s).iter().zip([b, b, d, b, d, b, d]).map(|(c, m)| m * c[0]).sum()
    };
    let w = 6.0 * std::f64::consts::PI;
    let acceleration = |t: f64| -0.01 * w * w * (w * t).sin();
    // At the start only the bars 1 and 2 move, their centres with half the ground's velocity.
    let velocity = 0.01 * w;
    let mut work = -velocity * (2.0 * tower.bar_mass * 0.5 * velocity);
    work += acceleration(0.0) * moment(0.0, &tower.start())
        - acceleration(t1) * moment(t1, &states[times.len() - 1]);
    for ((&t, s), weight) in times.iter().zip(&states).zip(&weights) {
        work += weight * -0.01 * w.powi(3) * (w * t).cos() * moment(t, s);
    }
    let gain = tower.energy(t1, &states[times.len() - 1]) - tower.energy(0.0, &tower.start());
    assert!(gain.abs() > 1e-2);
    assert!((gain - work).abs() < 1e-12);
    Ok(())
}
