//! Example 1 of the framework paper: a bar and a triangle, hinged and released from rest under gravity (Sec. 6.1).

use tg_coords::{CoordType, Pose};
use tg_integrate::State;
use tg_model::{BuildError, Form, Joining, Model, ModelBuilder};

use crate::error::CaseError;
use crate::plane::{BAR_MASS, G, SPLIT, triangle, vertex};

/// Choices of modelling that must not change the motion.
#[derive(Clone, Copy, Debug)]
pub struct Choices {
    /// Coordinate type of the triangle.
    pub coord_type: CoordType,
    /// How the hinge is modelled.
    pub joining: Joining,
    /// Part of the triangle's I_z in J_xx.
    pub split: f64,
}

impl Default for Choices {
    /// RUV, shared, the real triangle.
    fn default() -> Self {
        Self { coord_type: CoordType::Ruv, joining: Joining::Share, split: SPLIT }
    }
}

/// The model and the points that are looked at.
#[derive(Clone, Debug)]
pub struct DoublePendulum {
    /// The model.
    pub model: Model<2>,
    /// The hinge.
    pub joint: Form<2>,
    /// Mass centre of the triangle.
    pub centre: Form<2>,
}

impl DoublePendulum {
    /// The paper's double pendulum.
    ///
    /// # Errors
    /// The choices do not fit together.
    pub fn new(choices: Choices) -> Result<Self, CaseError> {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -G])?;
        let hinge = [0.05, -0.05];
        let bar = b.bar("bar 1", BAR_MASS, [0.0, 0.0], hinge)?;
        let body = triangle(choices.coord_type, choices.split).map_err(|source| BuildError::Coordinates {
            kind: "member",
            name: "triangle 2".into(),
            source,
        })?;
        let body = b.member("triangle 2", body, Pose::planar(hinge[0], hinge[1], 0.0))?;
        b.fix("pivot", bar.node(0))?;
        b.joint("hinge", &[bar.node(1), vertex(body, choices.coord_type, 0)], choices.joining)?;
        let model = b.build()?;
        let (joint, centre) = (model.form(bar.node(1))?, model.form(body.mass_centre())?);
        Ok(Self { model, joint, centre })
    }

    /// θ1 and θ2 \[rad\]: the bar, and the line from the hinge to the triangle's mass centre, from the downward
    /// vertical.
    pub fn angles(&self, state: &State) -> [f64; 2] {
        let (joint, centre) = (self.joint.eval(&state.q), self.centre.eval(&state.q));
        [joint, centre - joint].map(|arm| arm.x.atan2(-arm.y))
    }

    /// Mechanical energy \[J\], zero potential at the pivot.
    pub fn energy(&self, state: &State) -> f64 {
        self.model.energy(&state.q, &state.v, &[]).total()
    }
}
