//! `paths`: how the equilibria of the statics papers' examples change with load and free length.

use comfy_table::{Table, presets};
use serde_json::{Value, json};
use tg_cases::antiprism::path::{LoadPath, examples, past_fold};
use tg_cases::verify::mechanism::homotopy::certified_sweep;

use crate::TaskError;

/// Prints both antiprisms' load paths and the sweep of the mechanism's L01.
pub(crate) fn print(as_json: bool) -> Result<bool, TaskError> {
    let mut document = serde_json::Map::new();
    for (name, structure) in examples()? {
        let path = past_fold(&structure)?;
        if as_json {
            document.insert(name.into(), data(&path));
        } else {
            println!("antiprism, {name}: equilibria as the load grows\n{}\n", table(&path));
        }
    }
    sweep(&mut document, as_json)?;
    if as_json {
        println!("{}", serde_json::to_string_pretty(&document)?);
    }
    Ok(true)
}

/// Points and events in the order of the branch.
fn table(path: &LoadPath) -> Table {
    let mut table =
        plain(&["load factor", "negative", "top [N]", "bottom [N]", "lateral [N]", "clearance [mm]", ""]);
    let least = |tensions: &[f64]| format!("{:.4}", tensions.iter().copied().fold(f64::INFINITY, f64::min));
    for (k, point) in path.points.iter().enumerate() {
        for event in path.events.iter().filter(|event| event.after + 1 == k) {
            let mut row =
                vec![format!("{:.8}", event.factor), format!("{} to {}", event.negative.0, event.negative.1)];
            row.extend(vec![String::new(); 4]);
            row.push(event.kind.to_string());
            table.add_row(row);
        }
        let mut row = vec![format!("{:.8}", point.factor), point.negative.to_string()];
        row.extend(point.tensions.iter().map(|tensions| least(tensions)));
        row.push(format!("{:.4}", point.clearance * 1e3));
        row.push(if point.negative == 0 { "stable" } else { "unstable" }.into());
        table.add_row(row);
    }
    table
}

fn data(path: &LoadPath) -> Value {
    let points = path.points.iter().map(|p| {
        json!({ "factor": p.factor, "q": p.q, "negative": p.negative, "tensions": p.tensions, "clearance": p.clearance })
    });
    let events = path.events.iter().map(|e| {
        json!({ "kind": e.kind.to_string(), "factor": e.factor, "q": e.q, "after": e.after, "negative": e.negative })
    });
    json!({ "points": points.collect::<Vec<_>>(), "events": events.collect::<Vec<_>>() })
}

fn sweep(document: &mut serde_json::Map<String, Value>, as_json: bool) -> Result<(), TaskError> {
    let sweep = certified_sweep()?;
    let value = |sample: usize| sweep.samples[sample].0;
    let mut table = plain(&["from L01 [m]", "to [m]", "negative", "", "energy there [J]", ""]);
    let mut curves = Vec::new();
    for curve in &sweep.curves {
        let energies = curve.points.iter().map(|&p| (value(p.sample), sweep.at(p).energy));
        let energies: Vec<(f64, f64)> = energies.collect();
        let [(from, first), .., (to, last)] = energies[..] else { continue };
        table.add_row([
            format!("{from:.2}"),
            format!("{to:.2}"),
            curve.negative.to_string(),
            if curve.stable { "stable" } else { "unstable" }.into(),
            format!("{first:.6}"),
            format!("{last:.6}"),
        ]);
        let q: Vec<_> = curve.points.iter().map(|&p| &sweep.at(p).configuration.q).collect();
        curves.push(
            json!({ "negative": curve.negative, "stable": curve.stable, "energies": energies, "q": q }),
        );
    }
    let folds: Vec<f64> = sweep.folds.iter().map(|fold| fold.value).collect();
    if as_json {
        document.insert("mechanism".into(), json!({ "curves": curves, "folds": folds }));
    } else {
        let folds: Vec<String> = folds.iter().map(|fold| format!("{fold:.12} m")).collect();
        println!("mechanism: equilibria as L01 grows, L02 = 0\n{table}\nfolds at {}", folds.join(", "));
    }
    Ok(())
}

fn plain(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header(header.to_vec());
    table
}
