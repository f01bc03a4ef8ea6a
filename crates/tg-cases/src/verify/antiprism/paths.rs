//! Load paths of both examples by continuation in the load factor, past their folds, and what the virtual-work model says
//! of their events.
//!
//! Example 1: the symmetric path loses its stability just before the full load, so that Table 4's state is unstable; at a
//! twist of 180° all struts meet on the axis and the lateral ties are at their free length, in closed form
//! ```text
//! R_B R_T = (L_s² - L_0²)/3,   k_T (√3 R_T - T_0) = k_B (√3 R_B - B_0)
//! f = √3 k_B (√3 R_B - B_0) H / (R_B + R_T),   H² = L_s² - (R_B + R_T)²
//! ```

use tg_statics::{Forward, ForwardOptions, stability};
use tg_tangent::Sign;

use super::{EXACT, MODEL, apart, ends, forces, moments, twin};
use crate::antiprism::path::{LoadPath, PathEvent, PathEventKind, past_fold};
use crate::antiprism::{Antiprism, EXAMPLE_1, EXAMPLE_2, FORCE, Feet, Loads};
use crate::error::CaseError;
use crate::row::Rows;

/// Load factors around the loss of stability of example 1.
const FACTORS: [f64; 10] = [0.925, 0.93, 0.935, 0.94, 0.945, 0.975, 0.98, 0.985, 0.99, 0.995];

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    let loads = forces::loads();
    let structure = Antiprism::new(&EXAMPLE_1, Feet::Sliding, &loads)?;
    let found = past_fold(&structure)?;
    first(rows, &structure, &found)?;
    fold(rows, "example 1", (&structure, Feet::Sliding, &loads), &found)?;

    let loads = moments::loads();
    let structure = Antiprism::new(&EXAMPLE_2, Feet::Fixed, &loads)?;
    let found = past_fold(&structure)?;
    fold(rows, "example 2", (&structure, Feet::Fixed, &loads), &found)?;
    second(rows, &structure, &loads, &found)
}

fn factor(event: Option<&PathEvent>) -> f64 {
    event.map_or(f64::NAN, |event| event.factor)
}

/// Loss of stability, slack ties and meeting struts of example 1.
fn first(rows: &mut Rows, structure: &Antiprism, found: &LoadPath) -> Result<(), CaseError> {
    let lost = found.first(|kind| *kind == PathEventKind::Stability);
    let twins = twins_loss(structure)?;
    let name = "example 1: load factor where the symmetric path loses stability";
    // Within 1e-12 of the largest eigenvalue the twin's signs are rounding: 2e-8 of the load.
    rows.near(name, "1", (eigenvalue_root(structure)?, twins), MODEL, 1e-7);
    // Two eigenvalues pass zero together, and by the threefold symmetry other branches cross there at finite slopes: right
    // beside the crossing Newton's method may land on any of them.
    let name = "example 1: the same by continuation";
    rows.near(name, "1", (factor(lost), twins), MODEL, 1e-5);
    rows.exact("example 1: negative eigenvalues at the full load", (at_full_load(found), 2), EXACT);

    let exact = struts_on_the_axis();
    let pushes = |kind: &PathEventKind| matches!(kind, PathEventKind::Pushes { .. });
    let meet = |kind: &PathEventKind| matches!(kind, PathEventKind::StrutsMeet { .. });
    let name = "example 1: load factor where lateral ties begin to push";
    rows.near(name, "1", (factor(found.first(pushes)), exact), "closed form", 1e-9);
    let name = "example 1: load factor where struts meet";
    rows.near(name, "1", (factor(found.first(meet)), exact), "closed form", 1e-9);
    let count = |wanted: &dyn Fn(&PathEventKind) -> bool| {
        found.events.iter().filter(|event| wanted(&event.kind)).count()
    };
    rows.exact("example 1: ties that begin to push", (count(&pushes), 3), "symmetry");
    rows.exact("example 1: pairs of struts that meet", (count(&meet), 3), "symmetry");
    Ok(())
}

/// The load factor at which the lowest eigenvalue is zero, from equilibria that are well away from there: inverse
/// interpolation (Neville).
fn eigenvalue_root(structure: &Antiprism) -> Result<f64, CaseError> {
    let options = ForwardOptions { load_steps: 20, relax: false, ..ForwardOptions::default() };
    let forward = Forward::new(&structure.model, options);
    let (q, none) = (structure.model.initial_coordinates(), structure.inputs(0.0));
    let (mut values, mut factors) = (Vec::new(), Vec::new());
    for factor in FACTORS {
        let at = forward.solve_from(&q, &none, &structure.inputs(factor))?.configuration;
        let pairs = stability(&structure.model, &at, 4)?.lowest;
        let internal = pairs.iter().find(|pair| pair.sign != Sign::Zero);
        values.push(internal.map_or(f64::NAN, |pair| pair.value));
        factors.push(factor);
    }
    for width in 1..values.len() {
        for k in 0..values.len() - width {
            let (a, b) = (values[k], values[k + width]);
            factors[k] = (b * factors[k] - a * factors[k + 1]) / (b - a);
        }
    }
    Ok(factors[0])
}

/// Negative eigenvalues on the path between the points around the full load.
fn at_full_load(found: &LoadPath) -> usize {
    found.points.iter().find(|point| point.factor >= 1.0).map_or(usize::MAX, |point| point.negative)
}

/// The load factor at which the lowest eigenvalues of the virtual-work model pass zero on its symmetric branch, by
/// bisection after steps of 0.05 from the unloaded state.
fn twins_loss(structure: &Antiprism) -> Result<f64, CaseError> {
    let at = |factor: f64| twin(structure, Feet::Sliding, &forces::loads(), factor);
    let unloaded = at(0.0).at(&ends(structure, &structure.model.initial_coordinates()));
    let mut start = [unloaded[0], unloaded[2], unloaded[3]];
    let (mut low, mut high) = (0.0, 1.0);
    while high - low > 1e-11 {
        let middle = if low < 0.9 { low + 0.05 } else { 0.5 * (low + high) };
        let twin = at(middle);
        let x = twin.symmetric_equilibrium(start)?;
        if twin.signs(&x).0 == 0 {
            (low, start) = (middle, [x[0], x[2], x[3]]);
        } else {
            high = middle;
        }
    }
    Ok(low)
}

/// The load factor of example 1 at which all struts lie in planes through the axis.
fn struts_on_the_axis() -> f64 {
    let (length, lateral) = (EXAMPLE_1.length, EXAMPLE_1.lateral.free);
    let (top, bottom) = (EXAMPLE_1.top, EXAMPLE_1.bottom);
    let root = 3_f64.sqrt();
    // R_T = slope R_B + offset in the product of both radii.
    let slope = bottom.stiffness / top.stiffness;
    let offset = (top.free - slope * bottom.free) / root;
    let product = (length * length - lateral * lateral) / 3.0;
    let below = ((offset * offset + 4.0 * slope * product).sqrt() - offset) / (2.0 * slope);
    let reach = below + slope * below + offset;
    let height = (length * length - reach * reach).sqrt();
    root * bottom.stiffness * (root * below - bottom.free) * height / reach / -FORCE[2]
}

/// The limit point, at which the virtual-work model is in equilibrium and critical.
fn fold(
    rows: &mut Rows,
    name: &str,
    (structure, feet, loads): (&Antiprism, Feet, &Loads),
    found: &LoadPath,
) -> Result<(), CaseError> {
    let limits = found.events.iter().filter(|event| event.kind == PathEventKind::LimitPoint);
    rows.exact(format!("{name}: limit points on the path"), (limits.count(), 1), MODEL);
    let Some(fold) = found.first(|kind| *kind == PathEventKind::LimitPoint) else { return Ok(()) };
    let twin = twin(structure, feet, loads, fold.factor);
    let x = twin.at(&ends(structure, &fold.q));
    rows.below(
        format!("{name}: largest generalised force of the twin at the fold"),
        "N or N mm",
        twin.gradient(&x).amax(),
        MODEL,
        1e-6,
    );
    rows.below(
        format!("{name}: smallest eigenvalue of the twin at the fold, per the largest"),
        "1",
        twin.criticality(&x),
        MODEL,
        1e-8,
    );
    let beyond = found.points.iter().filter(|point| point.factor > fold.factor + 1e-12);
    rows.exact(format!("{name}: equilibria on the path beyond the fold's load"), (beyond.count(), 0), MODEL);
    Ok(())
}

/// Example 2 carries its load with less than 1 % to spare, every tie pulling; behind the fold struts 3 and 4 meet.
fn second(rows: &mut Rows, structure: &Antiprism, loads: &Loads, found: &LoadPath) -> Result<(), CaseError> {
    let limit = found.first(|kind| *kind == PathEventKind::LimitPoint);
    let name = "example 2: load factor of the fold, a few percent above one";
    rows.near(name, "1", (factor(limit), 1.009121322), "continuation, checked by the twin above", 1e-8);
    let stable = limit.map_or((9, 9), |fold| fold.negative);
    rows.exact("example 2: negative eigenvalues before the fold", (stable.0, 0), MODEL);
    rows.exact("example 2: negative eigenvalues behind it", (stable.1, 1), MODEL);
    let pushes = |event: &&PathEvent| matches!(event.kind, PathEventKind::Pushes { .. });
    let pushing = found.events.iter().filter(pushes).count();
    rows.exact("example 2: ties that begin to push", (pushing, 0), MODEL);
    let meeting = found.first(|kind| matches!(kind, PathEventKind::StrutsMeet { .. }));
    let expected = PathEventKind::StrutsMeet { struts: (2, 3) };
    let same = meeting.is_some_and(|event| event.kind == expected && event.negative == (1, 1));
    rows.exact("example 2: struts 3 and 4 meet behind the fold", (usize::from(same), 1), MODEL);
    let Some(meeting) = meeting else { return Ok(()) };
    let state = ends(structure, &meeting.q);
    let twin = twin(structure, Feet::Fixed, loads, meeting.factor);
    let theirs = twin.ends(&twin.equilibrium(&twin.at(&state))?);
    let distance = apart(&state, &theirs);
    rows.below("example 2: distance from the twin's state where they meet", "mm", distance, MODEL, 1e-8);
    let [[p, p_end], [r, r_end]] = [theirs[2], theirs[3]];
    let normal = (p_end - p).cross(&(r_end - r)).normalize();
    let gap = normal.dot(&(r - p));
    rows.below("example 2: distance of the twin's struts 3 and 4 there", "mm", gap, MODEL, 1e-8);
    Ok(())
}
