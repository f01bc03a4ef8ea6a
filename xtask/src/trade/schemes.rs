//! Error against processor time of every scene by every scheme.

use std::fmt::Write as _;
use std::fs;

use tg_report::{Axis, Plot, Series};
use tg_scene::Scheme;
use tg_trade::{Budget, Curve, Method, Quantity, Reference, cheapest};

use super::Options;
use super::scenes::{Measured, with_subject};
use crate::bench::page::{digits, table};
use crate::{TaskError, root};

/// Size of plots \[px\].
const SIZE: [f64; 2] = [760.0, 420.0];

/// Tables and, if the page is written, a plot for each scene.
pub(super) fn section(scenes: &[Measured], options: &Options) -> Result<String, TaskError> {
    let mut text = String::new();
    for scene in scenes {
        eprintln!("{}: schemes", scene.name);
        let curves: Vec<Curve> = Scheme::ALL.map(|scheme| measure(scene, scheme, options)).into();
        // A string takes every write.
        let _ = write!(text, "### {}\n\n{}\n", scene.name, head(scene));
        text += &decades(&scene.reference, &curves);
        text += &failures(&curves);
        if options.write {
            let file = format!("trade-{}.svg", scene.name);
            fs::create_dir_all(root().join("docs/figures"))?;
            fs::write(root().join("docs/figures").join(&file), plot(scene.name, &curves).svg(SIZE)?)?;
            let _ = write!(text, "\n![Error against processor time, {}](figures/{file})\n", scene.name);
        }
        text += "\n";
    }
    Ok(text)
}

fn measure(scene: &Measured, scheme: Scheme, options: &Options) -> Curve {
    let (radius, budget) = (scene.settings.spectral_radius, Budget { run: options.budget });
    with_subject!(scene, subject => Curve::measure(&subject, &scene.reference, scheme, radius, budget))
}

/// What errors are told by.
fn head(scene: &Measured) -> String {
    let reference = &scene.reference;
    let [positions, tensions, energy] = Quantity::ALL.map(|quantity| reference.uncertainty[quantity]);
    let size = reference.motion.size();
    let mut text = format!(
        "{} s; points move {} m, tensions reach {} N. Errors against {}, uncertain by {positions:.0e} m, {tensions:.0e} N, {energy:.0e} J",
        scene.settings.duration,
        digits(size[Quantity::Positions]),
        digits(size[Quantity::Tensions]),
        reference.by
    );
    text += &match &reference.check {
        Some((by, apart)) => format!("; {by} is {:.0e} m away.\n", apart[Quantity::Positions]),
        None => "; no second scheme could check it.\n".into(),
    };
    text
}

/// The cheapest setting of all, and of each scheme the time, for each power of ten of the position error.
fn decades(reference: &Reference, curves: &[Curve]) -> String {
    let size = reference.motion.size()[Quantity::Positions].log10().floor() as i32;
    let least = reference.uncertainty[Quantity::Positions].max(1e-12).log10().ceil() as i32;
    let mut header = vec!["ms to an error of".to_string()];
    header.extend(curves.iter().map(|curve| curve.scheme.to_string()));
    header.push("cheapest".into());
    let rows = (least..size).rev().map(|power| {
        let error = 10.0_f64.powi(power);
        let cost = |curves: &[Curve]| cheapest(curves, Quantity::Positions, error).cloned();
        let mut row = vec![format!("1e{power} m")];
        row.extend(curves.iter().map(|curve| {
            cost(std::slice::from_ref(curve)).map_or("–".into(), |rung| digits(1e3 * rung.seconds))
        }));
        row.push(cost(curves).map_or("–".into(), |rung| setting(&rung.method)));
        row
    });
    table(&header, &rows.collect::<Vec<_>>())
}

/// A setting in few words.
pub(super) fn setting(method: &Method) -> String {
    match method.tolerance {
        Some(tolerance) => format!("{}, {tolerance:.0e}", method.scheme),
        None => format!("{}, {} s", method.scheme, digits(method.step)),
    }
}

/// Schemes that fail at their finest, and why.
fn failures(curves: &[Curve]) -> String {
    let failed = curves.iter().filter_map(|curve| {
        let failure = curve.failure.as_ref()?;
        Some(format!("\n{} fails: {failure}.\n", curve.scheme))
    });
    failed.collect()
}

fn plot(name: &str, curves: &[Curve]) -> Plot {
    let series = curves.iter().filter(|curve| !curve.rungs.is_empty()).map(|curve| {
        let (seconds, errors) = curve.points(Quantity::Positions);
        Series::over(curve.scheme.to_string(), seconds, errors)
    });
    let (x, y) = (Axis::new("processor time", "s"), Axis::new("error of positions", "m"));
    Plot::log_log(name.replace('_', " "), x, y, series.collect())
}
