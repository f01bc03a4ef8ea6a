//! `defaults`: what the default settings of the solvers cost and give.
//!
//! - `stepping`: remedies of a time step, tolerance of explicit ones;
//! - `eigen`: dense or sparse eigenpairs, the limit of zero; `modes`: what still is an equilibrium, modes along a parameter;
//! - `equilibrium`: tolerance of forward statics, steps of continuation;
//! - `homotopy`: settings of the paths to all equilibria; `loops`: of monodromy loops and certificates.

mod eigen;
mod equilibrium;
mod homotopy;
mod loops;
mod modes;
mod stepping;

use comfy_table::{Table, presets};

use crate::TaskError;

/// One table per setting, its title before the colon as a heading.
pub(crate) fn section() -> Result<String, TaskError> {
    let tables = [
        stepping::tables()?,
        eigen::tables()?,
        modes::tables()?,
        equilibrium::tables()?,
        homotopy::tables()?,
        loops::tables()?,
    ];
    let sections = tables.into_iter().flatten().map(|(title, table)| {
        let (heading, rest) = title.split_once(": ").unwrap_or((title, ""));
        let mut rest = rest.to_string();
        if let Some(first) = rest.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        format!("### {heading}\n\n{rest}\n\n{table}\n")
    });
    Ok(sections.collect::<Vec<_>>().join("\n"))
}

fn plain<const N: usize>(header: [&str; N]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::ASCII_MARKDOWN);
    table.set_header(header);
    table
}
