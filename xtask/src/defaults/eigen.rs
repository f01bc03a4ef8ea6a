//! What the settings of [`EigenOptions`] cost and give.

use std::time::Instant;

use comfy_table::Table;
use tg_fixtures::{prism, spine};
use tg_model::{CableLaw, Mechanics, Model};
use tg_tangent::{Configuration, EigenOptions, Method, Metric, Sign, Spectrum, TangentError, lowest};

use super::plain;
use crate::TaskError;

/// Repetitions of which the fastest counts.
const REPEATS: u32 = 5;

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, TaskError> {
    Ok(vec![
        (
            "Dense or sparse eigenpairs: ten lowest modes of a spine, fastest of five; the larger the ratio, the better is sparse",
            methods()?,
        ),
        (
            "Zero eigenvalues: those of free prisms per the largest eigenvalue, and the smallest one that is not zero",
            zeros()?,
        ),
    ])
}

fn at(model: &Model<3>) -> Result<Configuration, TangentError> {
    Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0))
}

fn methods() -> Result<Table, TaskError> {
    let mut table =
        plain(["vertebrae", "coordinates", "dense [ms]", "sparse [ms]", "ratio", "largest difference"]);
    for vertebrae in [2, 5, 10, 15, 20, 25, 30, 40] {
        let model = spine(vertebrae, 8.0, 0.0)?.model;
        let at = at(&model)?;
        let time = |method| -> Result<(Spectrum, f64), TangentError> {
            let options = EigenOptions { method, ..EigenOptions::new(10, Metric::Mass) };
            let mut fastest = f64::INFINITY;
            for _ in 1..REPEATS {
                let start = Instant::now();
                lowest(&model, &at, &options)?;
                fastest = fastest.min(start.elapsed().as_secs_f64());
            }
            Ok((lowest(&model, &at, &options)?, 1e3 * fastest))
        };
        let ((dense, a), (sparse, b)) = (time(Method::Dense)?, time(Method::Sparse)?);
        let pairs = dense.pairs.iter().zip(&sparse.pairs);
        let apart = pairs.map(|(a, b)| (a.value / b.value - 1.0).abs()).fold(0.0, f64::max);
        table.add_row([
            vertebrae.to_string(),
            model.free().len().to_string(),
            format!("{a:.2}"),
            format!("{b:.2}"),
            format!("{:.2}", a / b),
            format!("{apart:.1e}"),
        ]);
    }
    Ok(table)
}

fn zeros() -> Result<Table, TaskError> {
    let mut table = plain(["bars", "metric", "method", "largest zero", "smallest other"]);
    for n in [3, 6, 12, 24] {
        let model = prism(n, 10.0, 0.0, CableLaw::slacking)?.model;
        let at = at(&model)?;
        for metric in [Metric::Mass, Metric::Coordinates] {
            for method in [Method::Dense, Method::Sparse] {
                let found = lowest(&model, &at, &EigenOptions { method, ..EigenOptions::new(12, metric) })?;
                let share = |wanted: Sign| {
                    let pairs = found.pairs.iter().filter(move |pair| pair.sign == wanted);
                    pairs.map(|pair| pair.value.abs() / found.largest)
                };
                table.add_row([
                    n.to_string(),
                    format!("{metric:?}"),
                    format!("{method:?}"),
                    format!("{:.1e}", share(Sign::Zero).fold(0.0, f64::max)),
                    format!("{:.1e}", share(Sign::Positive).fold(f64::INFINITY, f64::min)),
                ]);
            }
        }
    }
    Ok(table)
}
