//! `verify`: every number of the papers' examples beside ours.

use std::time::Instant;

use comfy_table::{CellAlignment, Table, presets};
use serde_json::json;
use tg_cases::row::Row;
use tg_cases::verify::{CASES, Case};

use crate::TaskError;

/// Runs the cases and prints tables or JSON; true if every row holds.
pub(crate) fn verify(name: Option<&str>, as_json: bool) -> Result<bool, TaskError> {
    let cases: Vec<Case> =
        CASES.into_iter().filter(|case| name.is_none_or(|name| name == case.name)).collect();
    if cases.is_empty() {
        let known: Vec<&str> = CASES.iter().map(|case| case.name).collect();
        return Err(
            format!("no case is named \"{}\"; there are {}", name.unwrap_or(""), known.join(", ")).into()
        );
    }
    let start = Instant::now();
    let mut all = Vec::new();
    for case in cases {
        let rows = (case.rows)().map_err(|error| format!("{}: {error}", case.name))?;
        if !as_json {
            println!("{} - {}\n{}\n", case.name, case.title, table(&rows));
        }
        all.extend(rows);
    }
    let failed = all.iter().filter(|row| !row.pass).count();
    if as_json {
        let passed = all.len() - failed;
        println!(
            "{}",
            serde_json::to_string_pretty(&json!({ "rows": all, "passed": passed, "failed": failed }))?
        );
    } else {
        let seconds = start.elapsed().as_secs_f64();
        println!("{} of {} numbers hold ({seconds:.1} s)", all.len() - failed, all.len());
        for row in all.iter().filter(|row| !row.pass) {
            println!("does not hold: {}: {}", row.case, row.quantity);
        }
    }
    Ok(failed == 0)
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header(["quantity", "unit", "ours", "reference", "difference", "tolerance", "holds", "source"]);
    for row in rows {
        table.add_row([
            row.quantity.clone(),
            row.unit.into(),
            number(row.value),
            number(row.reference),
            format!("{:.1e}", (row.value - row.reference).abs()),
            format!("{:.1e}", row.tolerance),
            if row.pass { "yes" } else { "NO" }.into(),
            row.source.into(),
        ]);
    }
    for column in 2..6 {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// Twelve digits where they mean something, an exponent where the number is small or large.
fn number(x: f64) -> String {
    if x == x.trunc() && x.abs() < 1e6 {
        format!("{x:.0}")
    } else if x.abs() >= 1e-3 && x.abs() < 1e6 {
        format!("{x:.12}")
    } else {
        format!("{x:.3e}")
    }
}
