//! What the settings of monodromy loops and of certificates cost and give, on two general quartics of the plane.

use comfy_table::Table;
use tg_homotopy::{
    CertifyOptions, HomotopyError, MonodromyOptions, PolynomialSystem, SystemBuilder, certify, find_seed,
    monodromy,
};

use super::plain;

/// Solutions of two quartics in general.
const ALL: usize = 16;
/// Systems.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=10;

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, HomotopyError> {
    Ok(vec![
        (
            "Loops of monodromy: two general quartics with 16 solutions, from one of them, ten seeds; by the size of the loops and \
             how many in a row may find nothing new",
            loops()?,
        ),
        (
            "Refinement of certificates: those 16 solutions moved by a distance, and how many are certified; by how far refinement may \
             move a point",
            moves()?,
        ),
    ])
}

/// Two quartics: all coefficients but one are parameters.
fn quartics() -> Result<PolynomialSystem, HomotopyError> {
    let mut b = SystemBuilder::new();
    let (x, y) = (b.unknown("x"), b.unknown("y"));
    for (k, leading) in [(4, 0), (0, 4)].into_iter().enumerate() {
        // With a fixed coefficient the size of the parameters means something.
        let mut quartic = x.pow(leading.0) * y.pow(leading.1);
        for (m, n) in (0..=4).flat_map(|m| (0..=4 - m).map(move |n| (m, n))).filter(|&at| at != leading) {
            quartic = quartic + b.parameter(format!("c{k} {m} {n}")) * x.pow(m) * y.pow(n);
        }
        b.equation(quartic);
    }
    b.build()
}

fn loops() -> Result<Table, HomotopyError> {
    let system = quartics()?;
    let mut table = plain(["size", "fruitless loops", "all found, of 10", "loops", "paths", "lost"]);
    for (radius, fruitless_loops) in
        [(0.01, 10), (0.1, 10), (0.3, 10), (1.0, 10), (3.0, 10), (1.0, 1), (1.0, 3), (1.0, 30)]
    {
        let (mut complete, mut made, mut paths, mut lost) = (0, 0, 0, 0);
        for seed in SEEDS {
            let (x, p) = find_seed(&system, seed)?;
            let options = MonodromyOptions { seed, radius, fruitless_loops, ..MonodromyOptions::default() };
            let (instance, report) = monodromy(&system, &p, &[x], &options)?;
            complete += usize::from(instance.solutions.len() == ALL);
            made += report.loops;
            paths += report.paths;
            lost += report.lost;
        }
        table.add_row([
            radius.to_string(),
            fruitless_loops.to_string(),
            complete.to_string(),
            made.to_string(),
            paths.to_string(),
            lost.to_string(),
        ]);
    }
    Ok(table)
}

fn moves() -> Result<Table, HomotopyError> {
    let system = quartics()?;
    let (x, p) = find_seed(&system, *SEEDS.start())?;
    let (instance, _) = monodromy(&system, &p, &[x], &MonodromyOptions::default())?;
    let mut table = plain(["moved by", "largest move 1e-9", "1e-6", "1e-3", "1"]);
    for distance in [1e-12, 1e-8, 1e-5, 1e-2] {
        let mut row = vec![format!("{distance:.0e}")];
        for largest_move in [1e-9, 1e-6, 1e-3, 1.0] {
            let mut points = instance.solutions.clone();
            points.iter_mut().for_each(|x| x[0] *= 1.0 + distance);
            let options = CertifyOptions { largest_move, ..CertifyOptions::default() };
            row.push(certify(&system, &p, &points, &options)?.count().to_string());
        }
        table.add_row(row);
    }
    Ok(table)
}
