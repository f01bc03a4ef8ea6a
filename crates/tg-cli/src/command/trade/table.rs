//! What was measured, for people.

use tg_trade::{Curve, Method, Quantity, Rung};

use super::Measured;

pub(super) fn text(title: &str, measured: &Measured) -> String {
    let reference = &measured.reference;
    let [positions, tensions, energy] = Quantity::ALL.map(|quantity| reference.uncertainty[quantity]);
    let mut text = format!(
        "{title}: {} s\nerrors against {}, which is uncertain by {positions:.0e} m, {tensions:.0e} N, {energy:.0e} J\n",
        measured.duration, reference.by
    );
    text += &match &reference.check {
        Some((by, apart)) => format!("({by}: {:.0e} m away)\n", apart[Quantity::Positions]),
        None => "(no second scheme gives a motion that could check it)\n".into(),
    };
    text += &format!(
        "\n{:<17}  {:<14}  {:>9}  {:>13}  {:>12}  {:>10}\n",
        "scheme", "step/tolerance", "CPU [ms]", "positions [m]", "tensions [N]", "energy [J]"
    );
    for curve in &measured.curves {
        text += &rows(curve);
    }
    text += "\ncheapest setting for each power of ten\n";
    for decade in &measured.decades {
        let (quantity, error) = (decade.quantity, decade.error);
        text += &format!(
            "{:<10} {error:>6.0e} {:<2}  {}\n",
            quantity.name(),
            quantity.unit(),
            line(&decade.rung)
        );
    }
    text += &match &measured.recommended {
        Some(rung) => format!(
            "\nrecommended for {:.1e} m: {}; error {:.1e} m, {:.3} ms\n",
            measured.accuracy,
            settings(&rung.method),
            rung.errors[Quantity::Positions],
            1e3 * rung.seconds
        ),
        None => String::new(),
    };
    text
}

fn rows(curve: &Curve) -> String {
    let mut text: String = curve.rungs.iter().map(|rung| format!("{}\n", line(rung))).collect();
    if let Some(failure) = &curve.failure {
        let (scheme, finer) = (curve.scheme.to_string(), if curve.rungs.is_empty() { "" } else { "finer: " });
        text += &format!("{scheme:<17}  {finer}{failure}\n");
    }
    text
}

fn line(rung: &Rung) -> String {
    let [positions, tensions, energy] = Quantity::ALL.map(|quantity| rung.errors[quantity]);
    let dial = rung.method.tolerance.unwrap_or(rung.method.step);
    format!(
        "{:<17}  {dial:<14.4e}  {:>9.3}  {positions:>13.1e}  {tensions:>12.1e}  {energy:>10.1e}",
        rung.method.scheme.to_string(),
        1e3 * rung.seconds
    )
}

/// As it is written in a scene.
fn settings(method: &Method) -> String {
    match method.tolerance {
        Some(tolerance) => format!("scheme = \"{}\", tolerance = {tolerance:e}", method.scheme),
        None => format!("scheme = \"{}\", step = {:e}", method.scheme, method.step),
    }
}
