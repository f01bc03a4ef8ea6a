//! Statics and modes, dense and sparse.

use tg_modal::{ModeOptions, damped, modes};
use tg_model::Model;
use tg_statics::{
    Configuration, ContinuationOptions, Forward, ForwardOptions, FreeBodyReport, InputFamily, InverseStatics,
    PrestressStability, Request, Seek, SelfStress, Unknown, continuation, critical_parameter,
    prestress_stability, stability_with,
};
use tg_tangent::{EigenOptions, Method, Metric};

use super::structures::{column, crane, linkage, net, prism};
use super::{Outcome, Units, assert_similar, per};

const METHODS: [Method; 2] = [Method::Dense, Method::Sparse];

fn settled<const D: usize>(model: &Model<D>) -> Outcome<Configuration> {
    let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
    let u = model.inputs_at(0.0);
    Ok(Forward::new(model, options).solve(&model.initial_coordinates(), &u)?.configuration)
}

#[test]
fn forward_statics() {
    assert_similar("crane", |units| {
        let model = crane(units)?;
        let at = settled(&model)?;
        let report = FreeBodyReport::new(&model, &at.q, &at.u)?;
        Ok(vec![per(units.length, at.q), per(units.force(), [report.force_scale])])
    });
}

#[test]
fn forward_statics_from_afar() {
    assert_similar("prism", |units| {
        let model = prism(units)?;
        let q: Vec<f64> = model.initial_coordinates();
        let u: Vec<f64> =
            model.inputs_at(0.0).iter().enumerate().map(|(k, x)| x * (0.9 - 0.01 * k as f64)).collect();
        let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
        let found = Forward::new(&model, options).solve(&q, &u)?;
        let at = &found.configuration;
        let states = model.cables().map(|c| model.cable(c, &at.q, &vec![0.0; at.q.len()], &u));
        let (lengths, tensions): (Vec<f64>, Vec<f64>) = states.map(|s| (s.length, s.tension)).unzip();
        Ok(vec![per(units.length, lengths), per(units.force(), tensions)])
    });
}

#[test]
fn relaxation() {
    // Three iterations of Newton's method do not arrive.
    assert_similar("net, relaxed", |units| {
        let model = net(units, 2, 3)?;
        let options = ForwardOptions { max_iterations: 3, ..ForwardOptions::default() };
        let found =
            Forward::new(&model, options).solve(&model.initial_coordinates(), &model.inputs_at(0.0))?;
        assert!(found.report.relaxation_steps > 0);
        Ok(vec![per(units.length, found.configuration.q)])
    });
}

#[test]
fn self_stress_and_mechanisms() {
    assert_similar("prism", |units| {
        let model = prism(units)?;
        let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
        let found = SelfStress::new(&model, &at)?;
        let counts = [found.rank.rank, found.states.len(), found.mechanisms.len(), found.rigid_motions.len()];
        let PrestressStability::Stable { tensions, stiffness } = prestress_stability(&model, &at, &found)?
        else {
            return Err("not prestress stable".into());
        };
        Ok(vec![
            counts.map(|n| n as f64).to_vec(),
            found.rank.singular_values.clone(),
            tensions,
            // Tensions of one newton.
            per(1.0 / units.length, [stiffness]),
        ])
    });
}

#[test]
fn stability() {
    for method in METHODS {
        assert_similar(&format!("prism, {method:?}"), |units| {
            let model = prism(units)?;
            let at = settled(&model)?;
            let options = EigenOptions { method, ..EigenOptions::new(9, Metric::Coordinates) };
            let found = stability_with(&model, &at, &options)?;
            let counts =
                [found.counts.negative, found.counts.zero, found.counts.positive, found.rigid_motions];
            let positive = found.lowest.iter().skip(found.counts.zero).map(|pair| pair.value);
            Ok(vec![counts.map(|n| n as f64).to_vec(), per(units.stiffness(), positive)])
        });
    }
}

fn frequencies<const D: usize>(model: &Model<D>, units: Units, method: Method) -> Outcome<Vec<Vec<f64>>> {
    let at = settled(model)?;
    let found = modes(model, &at, &ModeOptions { method, ..ModeOptions::all() })?;
    let counts = [found.counts.negative, found.counts.zero, found.counts.positive].map(|n| n as f64);
    let damped = damped(model, &at, &found)?;
    let ratios =
        damped.iter().filter(|mode| mode.frequency * units.time > 1e-3).map(|mode| mode.damping_ratio);
    Ok(vec![
        counts.to_vec(),
        per(1.0 / units.time, found.frequencies()),
        ratios.map(|ratio| 1.0 + ratio).collect(),
    ])
}

#[test]
fn natural_and_damped_modes() {
    for method in METHODS {
        assert_similar(&format!("crane, {method:?}"), |units| frequencies(&crane(units)?, units, method));
        assert_similar(&format!("prism, {method:?}"), |units| frequencies(&prism(units)?, units, method));
    }
}

fn held<const D: usize>(model: &Model<D>, units: Units, request: &Request) -> Outcome<Vec<Vec<f64>>> {
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let answer = InverseStatics::new(model, &q, &u)?.solve(request)?;
    Ok(vec![
        vec![answer.set.rank.rank as f64, answer.set.freedom as f64],
        per(units.force(), answer.tensions),
        per(units.length, answer.rest_lengths),
    ])
}

#[test]
fn inverse_statics() {
    for unknown in [Unknown::Tension, Unknown::ForceDensity, Unknown::RestLength] {
        assert_similar(&format!("net, {unknown:?}"), |units| {
            held(&net(units, 2, 3)?, units, &Request::new(unknown))
        });
        assert_similar(&format!("net, {unknown:?}, many cables"), |units| {
            held(&net(units, 7, 11)?, units, &Request::new(unknown))
        });
    }
}

#[test]
fn inverse_statics_with_bounds() {
    for (rows, columns) in [(2, 3), (7, 11)] {
        for unknown in [Unknown::Tension, Unknown::ForceDensity, Unknown::RestLength] {
            assert_similar(&format!("net {rows} × {columns}, {unknown:?}"), |units| {
                let request = Request::new(unknown).tension_between(1.0 * units.force(), 1e3 * units.force());
                held(&net(units, rows, columns)?, units, &request)
            });
        }
        assert_similar(&format!("net {rows} × {columns}, least total tension"), |units| {
            let request = Request::new(Unknown::Tension);
            let request =
                request.tension_between(1.0 * units.force(), 1e3 * units.force()).least_total_tension();
            held(&net(units, rows, columns)?, units, &request)
        });
    }
}

#[test]
fn continued_equilibria() {
    assert_similar("linkage", |units| {
        let model = linkage(units)?;
        let at = settled(&model)?;
        let u = model.inputs_at(0.0);
        let mut down = vec![0.0; u.len()];
        down[u.len() - 1] = -units.force();
        let family = InputFamily::new(&model, &u, &down);
        let branch = continuation(&family, &at.q, (0.0, 20.0), &ContinuationOptions::default())?;
        let events: Vec<f64> = branch.events.iter().map(|event| event.parameter).collect();
        let last = branch.points.last().ok_or("no point")?;
        let numbers = [branch.points.len(), events.len()].map(|n| n as f64);
        Ok(vec![numbers.to_vec(), events, per(units.length, last.configuration.q.clone())])
    });
}

#[test]
fn critical_loads() {
    assert_similar("column", |units| {
        let model = column(units)?;
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let mut down = vec![0.0; u.len()];
        down[u.len() - 1] = -units.force();
        let family = InputFamily::new(&model, &u, &down);
        let found = critical_parameter(&family, &q, (0.0, 100.0))?;
        Ok(vec![vec![found.parameter], per(units.length, found.configuration.q)])
    });
}
