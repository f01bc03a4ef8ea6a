//! Counts, places and energies.

use super::{EXACT, Expected, SEARCH, degrees, nearest};
use crate::mechanism::Case;
use crate::row::Rows;

/// A number with half a unit of its last printed digit.
type Printed = (f64, f64);

/// What is known of an equilibrium.
struct Known {
    what: &'static str,
    /// γ1, γ2 \[°\].
    angles: [Printed; 2],
    /// d1 \[m\].
    length: Option<Printed>,
    /// V \[J\].
    energy: Option<Printed>,
    negative: usize,
}

/// Half a unit of the eleventh decimal, and the rounding of an angle of some hundred degrees.
const ELEVENTH: f64 = 0.5e-11 + 1e-13;

const CASE_1: [Known; 4] = [
    Known {
        what: "stable",
        angles: [(75.04244532618, ELEVENTH), (289.01197856378, ELEVENTH)],
        length: None,
        energy: Some((46.345143042, 0.5e-9)),
        negative: 0,
    },
    Known {
        what: "maximum",
        angles: [(275.79995339288, ELEVENTH), (329.43231207844, ELEVENTH)],
        length: None,
        energy: None,
        negative: 2,
    },
    Known {
        what: "saddle 1",
        angles: [(252.46582872425, ELEVENTH), (123.20477028838, ELEVENTH)],
        length: None,
        energy: None,
        negative: 1,
    },
    Known {
        what: "saddle 2",
        angles: [(92.91320293, 0.5e-8), (124.280297235, 0.501e-9)],
        length: None,
        energy: None,
        negative: 1,
    },
];

const CASE_2: [Known; 2] = [
    Known {
        what: "stable 1",
        angles: [(109.31332208142, ELEVENTH), (-113.24111747552, ELEVENTH)],
        length: Some((9.08715408087, 0.5e-11)),
        energy: None,
        negative: 0,
    },
    Known {
        what: "stable 2",
        angles: [(120.80014323165, ELEVENTH), (41.30760422804, ELEVENTH)],
        length: Some((11.49882104597, 0.5e-11)),
        energy: None,
        negative: 0,
    },
];

const CASE_3: [Known; 1] = [Known {
    what: "stable, stressed",
    angles: [(-98.54574221443, ELEVENTH), (158.83018068091, ELEVENTH)],
    length: None,
    energy: Some((0.3603639, 0.5e-7)),
    negative: 0,
}];

/// γ1, γ2 of the points with d2 = 0 \[°\].
const CONES: [[f64; 2]; 2] = [[119.82284845, 38.75814361], [114.87690311, 25.88108940]];

pub(super) fn rows(rows: &mut Rows, case: Case, expected: &Expected) {
    let name = case.name();
    rows.exact(format!("{name}: boxes that the search leaves undecided"), (expected.undecided, 0), SEARCH);
    let (counts, stable, known): (&[_], _, &[Known]) = match case {
        Case::One => (&[([1.0, 1.0], 4)], 1, &CASE_1),
        Case::Two => (&[([1.0, 1.0], 6), ([-1.0, 1.0], 4)], 2, &CASE_2),
        Case::Three => {
            (&[([1.0, 1.0], 15), ([1.0, -1.0], 3), ([-1.0, 1.0], 4), ([-1.0, -1.0], 4)], 5, &CASE_3)
        }
    };
    let total = counts.iter().map(|(_, count)| count).sum();
    rows.exact(format!("{name}: real solutions{}", misprint(case)), (expected.all().count(), total), EXACT);
    rows.exact(format!("{name}: physical"), (expected.equilibria.len(), counts[0].1), EXACT);
    for &(signs, count) in &counts[1..] {
        let found = expected.unphysical.iter().find(|(other, _)| *other == signs);
        let found = found.map_or(0, |(_, found)| found.len());
        let [a, b] = signs.map(|sign| if sign < 0.0 { '-' } else { '+' });
        rows.exact(format!("{name}: solutions with signs {a}, {b} of d1, d2"), (found, count), EXACT);
    }
    rows.exact(format!("{name}: stable{}", misjudged(case)), (expected.stable(), stable), EXACT);
    indices(rows, name, expected);
    known.iter().for_each(|known| compare(rows, name, expected, known));
    if case == Case::Three {
        stress_free(rows, name, expected);
        cones(rows, name, expected);
    }
}

fn misprint(case: Case) -> &'static str {
    match case {
        Case::One => "",
        Case::Two => " (the paper prints 14, against its own Fig. 4: elimination added four)",
        Case::Three => " (the paper prints 30: cleared denominators added d2 = 0)",
    }
}

fn misjudged(case: Case) -> &'static str {
    match case {
        Case::One => " (the paper's one is a saddle)",
        Case::Two => " (the paper prints 3, all of them no physical equilibria)",
        Case::Three => "",
    }
}

/// Extrema less saddles of a function on the torus are none, cones that are extrema included.
fn indices(rows: &mut Rows, name: &str, expected: &Expected) {
    let saddles = expected.equilibria.iter().filter(|e| e.negative == 1).count();
    let peaks = expected.cones.iter().filter(|cone| cone.excess > 0.0).count();
    let extrema = expected.equilibria.len() - saddles + peaks;
    rows.exact(format!("{name}: extrema, as many as saddles"), (extrema, saddles), "Poincaré and Hopf");
}

fn compare(rows: &mut Rows, name: &str, expected: &Expected, known: &Known) {
    let name = format!("{name}, {}", known.what);
    let angles = known.angles.map(|(angle, _)| angle);
    let Some((found, _)) = nearest(&expected.equilibria, angles) else {
        return rows.exact(format!("{name}: found"), (0, 1), EXACT);
    };
    for (i, value) in degrees(found, angles).into_iter().enumerate() {
        let (reference, half) = known.angles[i];
        rows.near(format!("{name}: γ{}", i + 1), "°", (value, reference), EXACT, half);
    }
    if let Some((length, half)) = known.length {
        rows.near(format!("{name}: d1"), "m", (found.lengths[0], length), EXACT, half);
    }
    if let Some((energy, half)) = known.energy {
        rows.near(format!("{name}: V"), "J", (found.energy, energy), EXACT, half);
    }
    rows.exact(format!("{name}: negative eigenvalues of ∂²V"), (found.negative, known.negative), EXACT);
}

/// Both springs at their free lengths.
fn stress_free(rows: &mut Rows, name: &str, expected: &Expected) {
    let free: Vec<_> = expected.equilibria.iter().filter(|e| e.energy < 1e-20).collect();
    rows.exact(format!("{name}: stress-free equilibria"), (free.len(), 4), EXACT);
    let stable = free.iter().filter(|e| e.stable()).count();
    rows.exact(format!("{name}: stable ones of them"), (stable, 4), EXACT);
    let off = free.iter().flat_map(|e| e.lengths).map(|d| (d - 11.5).abs()).fold(0.0, f64::max);
    rows.below(format!("{name}: their lengths off 11.5 m"), "m", off, EXACT, 1e-14);
}

fn cones(rows: &mut Rows, name: &str, expected: &Expected) {
    rows.exact(format!("{name}: points with d2 = 0"), (expected.cones.len(), CONES.len()), EXACT);
    for (k, (cone, known)) in expected.cones.iter().zip(CONES).enumerate() {
        for (i, angle) in cone.angles.map(f64::to_degrees).into_iter().enumerate() {
            let what = format!("{name}: d2 = 0, point {}: γ{}", k + 1, i + 1);
            rows.near(what, "°", (angle, known[i]), EXACT, 0.5e-8);
        }
    }
}
