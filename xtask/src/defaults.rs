//! `defaults`: what the default settings of the solvers cost and give.
//!
//! - `stepping`: tolerance and remedies of a time step;
//! - `eigen`: dense or sparse eigenpairs, the limit of zero;
//! - `equilibrium`: tolerance of forward statics, steps of continuation;
//! - `homotopy`: tolerances of the paths to all equilibria.

mod eigen;
mod equilibrium;
mod homotopy;
mod stepping;

use comfy_table::{Table, presets};

use crate::TaskError;

/// Prints one table per setting; always true.
pub(crate) fn measure() -> Result<bool, TaskError> {
    let tables = [stepping::tables()?, eigen::tables()?, equilibrium::tables()?, homotopy::tables()?];
    for (title, table) in tables.into_iter().flatten() {
        println!("{title}\n\n{table}\n");
    }
    Ok(true)
}

fn plain<const N: usize>(header: [&str; N]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header(header);
    table
}
