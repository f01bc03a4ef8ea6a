//! All equilibria of a small structure.

use tg_equilibria::{EquilibriaOptions, all_equilibria};

use super::structures::linkage;
use super::{assert_similar, per};

#[test]
fn all_of_a_linkage() {
    assert_similar("linkage", |units| {
        let model = linkage(units)?;
        let report = all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default())?;
        if !report.accounts_for_all() {
            return Err(report.to_string().into());
        }
        let energies = report.physical().map(|e| e.energy);
        let stable = report.physical().map(|e| f64::from(u8::from(e.stable))).collect();
        let lengths = report.physical().flat_map(|e| e.lengths.clone());
        Ok(vec![per(units.energy(), energies), stable, per(units.length, lengths)])
    });
}
