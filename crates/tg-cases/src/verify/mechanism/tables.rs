//! The paper's Tables 2 to 4 beside ours.
//!
//! They were computed with slightly other numbers than Table 1 prints, and Tables 3 and 4 list roots that are no
//! solutions of the equations. The paper's stable flags come from eigenvalues of a Jacobian whose rows can be ordered
//! and scaled at will and say nothing.

use super::{Expected, degrees, nearest};
use crate::mechanism::Case;
use crate::reference::mechanism::Equilibrium;
use crate::row::Rows;

/// γ1, γ2 \[°\] of Table 2's real solutions.
const TABLE_2: [[f64; 2]; 4] = [[75.034, 289.04], [276.53, 330.79], [252.35, 123.74], [93.67, 124.97]];

/// γ1, γ2 \[°\] and d1 \[m\] of Table 3.
const TABLE_3: [[f64; 3]; 14] = [
    [121.69, -170.30, 13.95],
    [-53.70, -137.78, 10.16],
    [-134.63, -118.07, -15.35],
    [109.42, -113.03, 9.08],
    [43.84, -111.10, -2.88],
    [108.06, -79.05, 6.78],
    [115.19, -5.97, -8.19],
    [-49.06, 13.59, -8.97],
    [121.04, 41.45, 11.50],
    [-121.20, 64.23, -7.14],
    [-57.21, 65.86, 5.03],
    [35.41, 67.86, -10.81],
    [-55.72, 94.46, -3.56],
    [129.99, 112.18, -15.14],
];

/// Rows of Table 3 that do not satisfy the equations.
const ADDED_TO_TABLE_3: [usize; 4] = [7, 8, 13, 14];

/// γ1, γ2 \[°\] of Table 4.
const TABLE_4: [[f64; 2]; 30] = [
    [118.75, 35.52],
    [1.86, 11.31],
    [123.69, 48.35],
    [158.85, 147.91],
    [27.01, -135.42],
    [81.58, -60.61],
    [114.38, 24.21],
    [113.32, 148.87],
    [158.45, -18.37],
    [121.96, 43.85],
    [-16.11, 152.17],
    [1.55, -177.34],
    [116.20, -141.81],
    [-99.16, 157.70],
    [-178.95, -69.89],
    [-109.34, 109.14],
    [-60.03, 49.95],
    [-119.62, -94.00],
    [-82.25, -172.07],
    [-92.63, -46.78],
    [-173.90, 5.31],
    [-1.03, -33.82],
    [-59.06, -143.69],
    [111.37, 16.39],
    [52.62, 85.56],
    [56.10, 108.90],
    [118.69, -152.47],
    [48.02, 60.96],
    [-60.20, -120.65],
    [113.25, 21.29],
];

/// Rows of Table 4 that do not satisfy the equations.
const ADDED_TO_TABLE_4: [usize; 4] = [3, 7, 10, 24];

/// Largest distance of Tables 2, 3 and 4 from the solutions for Table 1 \[°\].
const OFF: [f64; 3] = [1.4, 0.8, 2.2];

const OTHER_NUMBERS: [&str; 3] = [
    "paper, Table 2, from other numbers than Table 1",
    "paper, Table 3, from other numbers than Table 1",
    "paper, Table 4, from other numbers than Table 1",
];
const ADDED: &str = "paper; not a solution of its (6), (7)";
const NO_JUDGE: &str = "paper's flag: of a Jacobian of arbitrary row order";

pub(super) fn rows(rows: &mut Rows, case: Case, expected: &Expected) {
    match case {
        Case::One => table_2(rows, expected),
        Case::Two => table_3(rows, expected),
        Case::Three => table_4(rows, expected),
    }
}

fn table_2(rows: &mut Rows, expected: &Expected) {
    for (k, printed) in (1..).zip(TABLE_2) {
        pair(rows, &format!("Table 2, solution {k}"), nearest(&expected.equilibria, printed), (printed, 0));
    }
    if let Some((found, _)) = nearest(&expected.equilibria, TABLE_2[2]) {
        let what = "Table 2, solution 3 (printed as stable): negative eigenvalues";
        rows.exact(what, (found.negative, 1), NO_JUDGE);
    }
}

fn table_3(rows: &mut Rows, expected: &Expected) {
    for (k, [a, b, d1]) in (1..).zip(TABLE_3) {
        let (name, printed) = (format!("Table 3, row {k}"), [a, b]);
        let same_sign = || expected.all().filter(|e| e.lengths[0] * d1 > 0.0);
        if ADDED_TO_TABLE_3.contains(&k) {
            absent(rows, &name, same_sign(), (printed, 1));
            continue;
        }
        let found = nearest(same_sign(), printed);
        pair(rows, &name, found, (printed, 1));
        if let Some((found, _)) = found {
            rows.near(format!("{name}: d1"), "m", (found.lengths[0], d1), OTHER_NUMBERS[1], 0.05);
        }
    }
    // 8 and 14 are no solutions at all; 12 has a negative length.
    if let Some((found, _)) = nearest(expected.all(), [35.41, 67.86]) {
        let what = "Table 3, row 12 (printed as stable): negative eigenvalues on its branch";
        rows.exact(what, (found.negative, 1), NO_JUDGE);
    }
}

fn table_4(rows: &mut Rows, expected: &Expected) {
    for (k, printed) in (1..).zip(TABLE_4) {
        let name = format!("Table 4, row {k}");
        if ADDED_TO_TABLE_4.contains(&k) {
            absent(rows, &name, expected.all(), (printed, 2));
        } else {
            pair(rows, &name, nearest(expected.all(), printed), (printed, 2));
        }
    }
}

/// γ1 and γ2 of the nearest equilibrium.
fn pair(
    rows: &mut Rows,
    name: &str,
    found: Option<(&Equilibrium, f64)>,
    (printed, table): ([f64; 2], usize),
) {
    let angles = found.map_or([f64::NAN; 2], |(found, _)| degrees(found, printed));
    for i in 0..2 {
        let what = format!("{name}: γ{}", i + 1);
        rows.near(what, "°", (angles[i], printed[i]), OTHER_NUMBERS[table], OFF[table]);
    }
}

/// No equilibrium near a printed one.
fn absent<'a>(
    rows: &mut Rows,
    name: &str,
    all: impl Iterator<Item = &'a Equilibrium>,
    (printed, table): ([f64; 2], usize),
) {
    let near = all.filter(|e| nearest([*e], printed).is_some_and(|(_, off)| off < OFF[table])).count();
    rows.exact(format!("{name}: solutions there"), (near, 0), ADDED);
}
