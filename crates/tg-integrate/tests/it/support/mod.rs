//! Structures and helpers that several test files and the benchmark share.
//!
//! - here: starting and running, positions of points, example 1, a pendulum, particles;
//! - [`tower`]: example 2, the planar class-3 tower, in its setups;
//! - [`prism`]: prestressed prisms in space, one or a chain;
//! - [`friction`]: a mass with dry friction, whose switch chatters;
//! - [`momentum`]: linear and angular momentum from poses and twists.

pub(crate) mod friction;
pub(crate) mod momentum;
pub(crate) mod prism;
pub(crate) mod tower;

use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, NewtonOptions, Run, RungeKutta, State,
    Stepper, Summary, Symplectic, Tolerances,
};
use tg_model::{Joining, Mechanics, MemberId, Model, ModelBuilder, Place};

pub(crate) const GRAVITY: [f64; 2] = [0.0, -9.81];
pub(crate) const BAR_MASS: f64 = 2.693_497_779_8e-2;
pub(crate) const TRIANGLE_MASS: f64 = 0.127_142_559_7;
/// I_z of the triangle about its mass centre.
pub(crate) const TRIANGLE_MOMENT: f64 = TRIANGLE_MASS * (0.01 / 24.0 + 0.0025 / 18.0);
/// Part of I_z that is J_xx of a uniform triangle.
pub(crate) const SPLIT: f64 = 0.75;
/// p1, p2 and the apex p3 in the triangle's frame.
pub(crate) const CORNERS: [[f64; 2]; 3] = [[0.0, 0.0], [0.1, 0.0], [0.05, 0.05]];

/// The triangle of examples 1 and 2 in a planar coordinate type; `split` is the part of I_z given to J_xx.
pub(crate) fn triangle(coord_type: CoordType, split: f64) -> Member<2> {
    let moment = [[split * TRIANGLE_MOMENT, 0.0], [0.0, (1.0 - split) * TRIANGLE_MOMENT]];
    let centre = [0.05, 0.05 / 3.0];
    let mass = MassProperties::from_second_moment(TRIANGLE_MASS, centre.into(), moment.into()).unwrap();
    let nodes = match coord_type {
        CoordType::Ruv => [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]],
        CoordType::Rrv => [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]],
        _ => CORNERS,
    };
    Member::new(coord_type, &nodes.map(Into::into), mass).unwrap()
}

/// Example 1 and its two members.
pub(crate) struct DoublePendulum {
    pub(crate) model: Model<2>,
    pub(crate) bar: MemberId,
    pub(crate) triangle: MemberId,
}

/// Example 1: a bar hinged at the origin, the triangle hinged at its end, released from rest.
pub(crate) fn double_pendulum(coord_type: CoordType, joining: Joining, split: f64) -> DoublePendulum {
    let mut b = ModelBuilder::<2>::new();
    b.gravity(GRAVITY).unwrap();
    let bar = b.bar("bar 1", BAR_MASS, [0.0, 0.0], [0.05, -0.05]).unwrap();
    let pose = Pose::planar(0.05, -0.05, 0.0);
    let triangle = b.member("triangle 2", triangle(coord_type, split), pose).unwrap();
    b.fix("pivot", bar.node(0)).unwrap();
    b.joint("hinge", &[bar.node(1), triangle.node(0)], joining).unwrap();
    DoublePendulum { model: b.build().unwrap(), bar, triangle }
}

/// Example 1 as the paper builds it.
pub(crate) fn example1() -> DoublePendulum {
    double_pendulum(CoordType::Ruv, Joining::Share, SPLIT)
}

/// A thin rod of length `length` \[m\] hinged at the origin, at `angle` \[rad\] from the downward vertical.
pub(crate) fn pendulum(length: f64, angle: f64) -> (Model<2>, MemberId) {
    let mut b = ModelBuilder::<2>::new();
    b.gravity(GRAVITY).unwrap();
    let rod = b.bar("rod", 1.0, [0.0, 0.0], [length * angle.sin(), -length * angle.cos()]).unwrap();
    b.fix("pivot", rod.node(0)).unwrap();
    (b.build().unwrap(), rod)
}

pub(crate) fn symplectic(mechanics: &dyn Mechanics) -> Symplectic<'_> {
    Symplectic::new(mechanics, NewtonOptions::default()).unwrap()
}

pub(crate) fn alpha(mechanics: &dyn Mechanics, rho: f64) -> GeneralizedAlpha<'_> {
    GeneralizedAlpha::new(mechanics, rho, NewtonOptions::default()).unwrap()
}

/// A pair under error control.
pub(crate) fn explicit(mechanics: &dyn Mechanics, pair: EmbeddedPair, tolerance: f64) -> RungeKutta<'_> {
    RungeKutta::new(mechanics, pair, Tolerances::relative(tolerance)).unwrap()
}

/// A pair with fixed steps.
pub(crate) fn fixed(mechanics: &dyn Mechanics, pair: EmbeddedPair) -> RungeKutta<'_> {
    RungeKutta::fixed(mechanics, pair).unwrap()
}

pub(crate) fn composition(mechanics: &dyn Mechanics, scheme: CompositionScheme) -> Composition<'_> {
    Composition::new(mechanics, scheme, NewtonOptions::default()).unwrap()
}

/// The start at rest as built.
pub(crate) fn start<const D: usize>(model: &Model<D>, stepper: &mut dyn Stepper) -> State {
    stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest()).unwrap()
}

pub(crate) fn run(stepper: &mut dyn Stepper, state: &mut State, h: f64, end: f64) -> Summary {
    Run::new(h, end).go(stepper, state).unwrap()
}

/// The state at `end` of a run from rest.
pub(crate) fn at_end<const D: usize>(model: &Model<D>, stepper: &mut dyn Stepper, h: f64, end: f64) -> State {
    let mut state = start(model, stepper);
    run(stepper, &mut state, h, end);
    state
}

/// Positions of the corners of triangles, one after the other.
pub(crate) fn corners(model: &Model<2>, triangles: &[MemberId], q: &[f64]) -> Vec<f64> {
    let places = triangles.iter().flat_map(|&m| CORNERS.map(|corner| m.at(corner)));
    places.flat_map(|place| position(model, place, q)).collect()
}

pub(crate) fn position<const D: usize>(model: &Model<D>, place: Place<D>, x: &[f64]) -> [f64; D] {
    model.form(place).unwrap().eval(x).into()
}

/// Largest absolute difference; all numbers must be finite.
#[track_caller]
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().chain(b).all(|x| x.is_finite()), "not finite");
    a.iter().zip(b).fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

/// Observed order from the differences of three successive halvings of the step.
pub(crate) fn order(runs: [&[f64]; 3]) -> f64 {
    (distance(runs[0], runs[1]) / distance(runs[1], runs[2])).log2()
}

/// Largest |A(q) q̇| over the constraints.
pub(crate) fn constraint_rate(mechanics: &dyn Mechanics, state: &State) -> f64 {
    let pattern = mechanics.jacobian_pattern();
    let mut values = vec![0.0; pattern.len()];
    mechanics.jacobian(&state.q, &mut values);
    let mut rate = vec![0.0; mechanics.sizes().constraints];
    for (&(row, i), a) in pattern.iter().zip(&values) {
        rate[row] += a * state.v[i];
    }
    rate.iter().fold(0.0, |worst: f64, r| worst.max(r.abs()))
}
