//! The folder of `tg trade`: the answer, a table and plots.

use std::path::Path;

use serde_json::Value;
use tg_report::{Axis, Channel, Plot, Series, Table, write_file};
use tg_trade::{Curve, Quantity};

use super::Measured;
use crate::answer::{Failure, pretty};

/// Size of plots \[px\].
const SIZE: [f64; 2] = [840.0, 480.0];

pub(super) fn write(folder: &Path, document: &Value, measured: &Measured) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::Usage(format!("{}: {error}", folder.display())))?;
    write_file(&folder.join("trade.json"), pretty(document).as_bytes())?;
    table(&measured.curves).write_csv(&folder.join("trade.csv"))?;
    for quantity in Quantity::ALL {
        let plot = plot(&measured.curves, quantity);
        // A structure without cables has no tensions to draw.
        if plot.series.iter().any(|series| series.values.iter().any(|&error| error > 0.0)) {
            write_file(&folder.join(format!("{quantity}.svg")), plot.svg(SIZE)?.as_bytes())?;
        }
    }
    Ok(())
}

/// Error of a quantity over processor time, a curve for each scheme.
fn plot(curves: &[Curve], quantity: Quantity) -> Plot {
    let series = curves.iter().filter(|curve| !curve.rungs.is_empty()).map(|curve| {
        let (seconds, errors) = curve.points(quantity);
        Series::over(curve.scheme.to_string(), seconds, errors)
    });
    let x = Axis::new("processor time", "s");
    let y = Axis::new(format!("error of {quantity}"), quantity.unit());
    Plot::log_log(format!("Error of {quantity} against processor time"), x, y, series.collect())
}

/// A row for each setting; schemes by their place in the list of all.
fn table(curves: &[Curve]) -> Table {
    let mut channels = vec![
        Channel::new("scheme", "", "number"),
        Channel::new("step", "s", "step"),
        Channel::new("tolerance", "", "tolerance"),
        Channel::new("processor time", "s", "time"),
    ];
    channels.extend(Quantity::ALL.map(|quantity| Channel::new(quantity.name(), quantity.unit(), "error")));
    let rows = curves.iter().enumerate().flat_map(|(k, curve)| {
        curve.rungs.iter().map(move |rung| {
            let method = &rung.method;
            let settings = [k as f64, method.step, method.tolerance.unwrap_or(f64::NAN), rung.seconds];
            settings
                .into_iter()
                .chain(Quantity::ALL.map(|quantity| rung.errors[quantity]))
                .collect::<Vec<_>>()
        })
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    let columns = (0..channels.len()).map(|k| rows.iter().map(|row| row[k]).collect());
    Table { columns: columns.collect(), channels }
}
