//! The compliant-mechanism paper's planar mechanism in natural coordinates (Rhodes, Tanouye, Vikas: Nonlinear behavior of
//! planar compliant tensegrity mechanism with variable free-lengths), one module or two in series.
//!
//! ```text
//! fixed body     points 1, 2, 3
//! bar 1-4        rigid, hinged at both ends; γ1 is its angle
//! top body       frame with origin 4 and x axis 4→6, points 5 and 6; γ2 is its angle
//! springs        1: 2-6 (k1, L01),  2: 3-5 (k2, L02); they push when short
//! ```
//! Eq. (2) of the paper exchanges points 5 and 6. There is no gravity; masses enter nothing. Child `series`: two modules,
//! the second standing on the first one's top body.

mod series;

use std::array::from_fn;
use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use tg_coords::{CoordType, CoordsError, MassProperties, Member, Pose};
use tg_model::{BuildError, CableId, CableLaw, Form, Joining, MemberId, Model, ModelBuilder, Place};

use crate::error::CaseError;

pub use series::{FORCE, Series};

/// The paper's three cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// Both springs have zero free length.
    One,
    /// Spring 1 has a free length of 11.5 m.
    Two,
    /// Both have.
    Three,
}

impl Case {
    /// All, in the paper's order.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Three];

    /// As the paper names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::One => "case 1",
            Self::Two => "case 2",
            Self::Three => "case 3",
        }
    }

    /// L01 and L02 \[m\].
    pub fn rest(self) -> [f64; 2] {
        match self {
            Self::One => [0.0, 0.0],
            Self::Two => [11.5, 0.0],
            Self::Three => [11.5, 11.5],
        }
    }
}

/// Parameters of a module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Points 1, 2, 3 of the fixed body \[m\].
    pub fixed: [[f64; 2]; 3],
    /// Length L3 of the bar \[m\].
    pub bar: f64,
    /// Point 5 of the top body in its frame \[m\].
    pub five: [f64; 2],
    /// Point 6 of the top body in its frame \[m\]; on the x axis by the frame's definition.
    pub six: [f64; 2],
    /// k1, k2 \[N/m\].
    pub stiffness: [f64; 2],
    /// Free lengths L01, L02 \[m\].
    pub rest: [f64; 2],
}

impl Parameters {
    /// Table 1 as printed, with the free lengths of a case.
    pub fn paper(case: Case) -> Self {
        Self {
            fixed: [[0.0, 0.0], [3.19, 0.0], [-2.55, 4.93]],
            bar: 9.0,
            five: [-0.3, -3.45],
            six: [4.25, 0.0],
            stiffness: [2.81, 2.81],
            rest: case.rest(),
        }
    }

    /// Some mechanism of the paper's proportions: the same for the same seed on every machine. Every fourth spring has zero
    /// free length.
    pub fn random(seed: u64) -> Self {
        let mut state = seed;
        let mut between = |low: f64, high: f64| low + (high - low) * uniform(&mut state);
        let one = [between(-1.0, 1.0), between(-1.0, 1.0)];
        let two = [one[0] + between(2.0, 5.0), one[1] + between(-1.0, 1.0)];
        let three = [one[0] + between(-4.0, -1.0), one[1] + between(3.0, 6.0)];
        Self {
            fixed: [one, two, three],
            bar: between(5.0, 11.0),
            six: [between(2.0, 6.0), 0.0],
            five: [between(-2.0, 2.0), between(-5.0, -2.0)],
            stiffness: [between(1.0, 5.0), between(1.0, 5.0)],
            rest: [(); 2].map(|()| if between(0.0, 1.0) < 0.25 { 0.0 } else { between(2.0, 14.0) }),
        }
    }
}

/// The next number of Steele, Lea and Flood's SplitMix64, in [0, 1).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// One module: the model and its parts.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// The model, as built at γ1 = π/2, γ2 = 0: no equilibrium.
    pub model: Model<2>,
    /// The parameters.
    pub parameters: Parameters,
    /// The module's parts.
    pub module: Module,
}

impl Mechanism {
    /// Builds the mechanism on fixed ground.
    ///
    /// # Errors
    /// A parameter is not one of a structure.
    pub fn new(parameters: &Parameters) -> Result<Self, CaseError> {
        let mut b = ModelBuilder::<2>::new();
        let parts = ModuleParts::on_ground(&mut b, parameters)?;
        let model = b.build()?;
        let module = parts.finish(&model, parameters)?;
        Ok(Self { model, parameters: *parameters, module })
    }

    /// Full coordinates at the angles γ1, γ2 \[rad\].
    pub fn coordinates(&self, angles: [f64; 2]) -> Vec<f64> {
        let mut q = self.model.initial_coordinates();
        self.module.place(&mut q, self.parameters.fixed[0].into(), angles);
        q
    }

    /// γ1, γ2 in (-π, π] \[rad\] at full coordinates.
    pub fn angles(&self, q: &[f64]) -> [f64; 2] {
        self.module.angles(q)
    }
}

/// A module within a model.
#[derive(Clone, Debug)]
pub struct Module {
    /// Bar 1-4.
    pub bar: MemberId,
    /// The top body.
    pub top: MemberId,
    /// Springs 1 (2-6) and 2 (3-5).
    pub springs: [CableId; 2],
    /// Point 1.
    pub one: Form<2>,
    /// Point 4.
    pub four: Form<2>,
    /// Point 5.
    pub five: Form<2>,
    /// Point 6.
    pub six: Form<2>,
    /// Axes of the top body.
    axes: [Form<2>; 2],
    length: f64,
}

impl Module {
    /// γ1, γ2 in (-π, π] \[rad\] at full coordinates.
    pub fn angles(&self, q: &[f64]) -> [f64; 2] {
        let [bar, axis] = [self.four.eval(q) - self.one.eval(q), self.axes[0].eval(q)];
        [bar, axis].map(|v| v.y.atan2(v.x))
    }

    /// Writes the nodes of a module with point 1 at `one`, and returns point 4.
    fn place(&self, q: &mut [f64], one: Vector2<f64>, [bar, top]: [f64; 2]) -> Vector2<f64> {
        let along = |angle: f64| Vector2::new(angle.cos(), angle.sin());
        let four = one + along(bar) * self.length;
        let x = along(top);
        let values = [four, x, Vector2::new(-x.y, x.x)];
        for (form, value) in [&self.four, &self.axes[0], &self.axes[1]].into_iter().zip(values) {
            // Each is a node of its own with weight one.
            for &(node, _) in form.terms() {
                q[2 * node..2 * node + 2].copy_from_slice(value.as_slice());
            }
        }
        four
    }
}

/// A module's members and springs while the model is being built.
struct ModuleParts {
    bar: MemberId,
    top: MemberId,
    springs: [CableId; 2],
}

impl ModuleParts {
    fn on_ground(b: &mut ModelBuilder<2>, parameters: &Parameters) -> Result<Self, BuildError> {
        let mut base = Vec::new();
        for (k, point) in parameters.fixed.into_iter().enumerate() {
            base.push(b.anchor(&format!("point {}", k + 1), point)?.into());
        }
        Self::add(b, "", from_fn(|k| base[k]), (parameters.fixed[0].into(), parameters))
    }

    /// Adds a module whose point 1 is now at `one`, its fixed points being `base`.
    fn add(
        b: &mut ModelBuilder<2>,
        prefix: &str,
        base: [Place<2>; 3],
        (one, parameters): (Vector2<f64>, &Parameters),
    ) -> Result<Self, BuildError> {
        let Parameters { bar: length, five, six, stiffness, rest, .. } = *parameters;
        let four = one + Vector2::new(FRAC_PI_2.cos(), FRAC_PI_2.sin()) * length;
        let bar = b.bar(&format!("{prefix}bar"), 1.0, one.into(), four.into())?;
        let name = format!("{prefix}top body");
        let body = body().map_err(|source| BuildError::Coordinates {
            kind: "member",
            name: name.clone(),
            source,
        })?;
        let top = b.member(&name, body, Pose::planar(four.x, four.y, 0.0))?;
        let joining =
            if matches!(base[0], Place::Material(..)) { Joining::Constrain } else { Joining::Share };
        b.joint(&format!("{prefix}hinge 1"), &[base[0], bar.node(0)], joining)?;
        b.joint(&format!("{prefix}hinge 4"), &[bar.node(1), top.node(0)], Joining::Share)?;
        let mut spring = |k: usize, from: Place<2>, to: [f64; 2]| {
            let name = format!("{prefix}spring {}", k + 1);
            b.cable(&name, from, top.at(to), CableLaw::linear(stiffness[k]), rest[k])
        };
        let springs = [spring(0, base[1], six)?, spring(1, base[2], five)?];
        Ok(Self { bar, top, springs })
    }

    fn finish(&self, model: &Model<2>, parameters: &Parameters) -> Result<Module, CaseError> {
        let Self { bar, top, springs } = *self;
        Ok(Module {
            bar,
            top,
            springs,
            one: model.form(bar.node(0))?,
            four: model.form(bar.node(1))?,
            five: model.form(top.at(parameters.five))?,
            six: model.form(top.at(parameters.six))?,
            axes: [model.form(top.node(1))?, model.form(top.node(2))?],
            length: parameters.bar,
        })
    }
}

/// A body with point 4 and two axes as its nodes; some mass, which statics without gravity does not see.
fn body() -> Result<Member<2>, CoordsError> {
    let nodes = [Vector2::zeros(), Vector2::x(), Vector2::y()];
    Member::new(CoordType::Ruv, &nodes, MassProperties::from_polar_moment(1.0, Vector2::zeros(), 1.0)?)
}
