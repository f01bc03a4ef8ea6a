//! Example 2 of the framework paper: the planar class-3 tower of four bars, three triangles and twelve cables
//! (Sec. 6.2).

use nalgebra::Vector2;
use tg_coords::{CoordType, Pose, Twist};
use tg_integrate::State;
use tg_model::{BuildError, CableId, CableLaw, Form, Joining, MemberId, Model, ModelBuilder, Place, Signal};

use crate::error::CaseError;
use crate::plane::{BAR_MASS, G, SPLIT, triangle, vertex};
use crate::slack;

/// Cable setups of Sec. 6.2.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setup {
    /// Undamped, no slacking.
    Un,
    /// Damped, no slacking.
    Dn,
    /// Undamped, slacking.
    Us,
    /// As US, but the anchors of the auxiliary cables stay at rest.
    UsAux,
}

impl Setup {
    /// The four setups in the paper's order.
    pub const ALL: [Self; 4] = [Self::Un, Self::Dn, Self::Us, Self::UsAux];

    /// The paper's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Un => "UN",
            Self::Dn => "DN",
            Self::Us => "US",
            Self::UsAux => "US-AUX",
        }
    }
}

/// How the seven joints are modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// As the paper does: two by sharing, five by constraints.
    Paper,
    /// All by constraints.
    Constrained,
    /// All by sharing; the triangles must be RRR.
    Shared,
}

/// Parameters of the tower and choices of modelling.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Law of all cables.
    pub law: CableLaw,
    /// Rest length of cables 3 to 12 as a part of their initial length.
    pub alpha: f64,
    /// The same of cables 1 and 2.
    pub beta: f64,
    /// Gravity \[m/s²\], downwards.
    pub gravity: f64,
    /// Horizontal motion of the ground \[m\].
    pub ground: Signal,
    /// Whether the anchors of cables 1 and 2 move with the ground.
    pub anchors_move: bool,
    /// Coordinate types of triangles 3, 5 and 7.
    pub types: [CoordType; 3],
    /// How joints are modelled.
    pub joints: Joints,
    /// Part of a triangle's I_z in J_xx.
    pub split: f64,
}

impl Choices {
    /// The paper's dynamic runs.
    pub fn paper(setup: Setup) -> Self {
        let law = match setup {
            Setup::Un => CableLaw::linear(100.0),
            Setup::Dn => CableLaw::linear(100.0).with_damping(0.1),
            Setup::Us | Setup::UsAux => CableLaw::slacking(100.0),
        };
        Self {
            law,
            alpha: 0.95,
            beta: 0.998,
            gravity: G,
            ground: Signal::sine(0.01, 3.0),
            anchors_move: setup != Setup::UsAux,
            types: [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr],
            joints: Joints::Paper,
            split: SPLIT,
        }
    }
}

impl Choices {
    /// The tower of the modal analysis (Sec. 6.2.1): no gravity, ground at rest, α = β = `ratio`.
    pub fn modal(ratio: f64) -> Self {
        let ground = Signal::Constant(0.0);
        Self { alpha: ratio, beta: ratio, gravity: 0.0, ground, ..Self::paper(Setup::Un) }
    }
}

/// The model and what is looked at.
#[derive(Clone, Debug)]
pub struct Tower {
    /// The model.
    pub model: Model<2>,
    /// Mass centre of triangle 3.
    pub centre3: Form<2>,
    /// Vertices of triangles 3, 5 and 7.
    pub vertices: Vec<Form<2>>,
    /// Cables 1 to 12.
    pub cables: Vec<CableId>,
    /// Bars 1, 2, 4 and 6.
    pub bars: [MemberId; 4],
    /// Triangles 3, 5 and 7.
    pub triangles: [MemberId; 3],
}

impl Tower {
    /// Builds the tower.
    ///
    /// # Errors
    /// The choices do not fit together.
    pub fn new(choices: &Choices) -> Result<Self, CaseError> {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -choices.gravity])?;
        let mut bar = |name, from, to| b.bar(name, BAR_MASS, from, to);
        let bars = [
            bar("bar 1", [0.0, 0.0], [0.0, 0.1])?,
            bar("bar 2", [0.1, 0.0], [0.1, 0.1])?,
            bar("bar 4", [0.05, 0.15], [0.05, 0.25])?,
            bar("bar 6", [0.05, 0.25], [0.05, 0.35])?,
        ];
        let mut triangles = Vec::new();
        for (name, coord_type, y) in [("triangle 3", 0, 0.1), ("triangle 5", 1, 0.2), ("triangle 7", 2, 0.3)]
            .map(|(name, k, y)| (name, choices.types[k], y))
        {
            let body = triangle(coord_type, choices.split).map_err(|source| BuildError::Coordinates {
                kind: "member",
                name: name.into(),
                source,
            })?;
            triangles.push((b.member(name, body, Pose::planar(0.0, y, 0.0))?, coord_type));
        }
        let at = |k: usize, v: usize| vertex(triangles[k].0, triangles[k].1, v - 1);
        let anchors = [b.anchor("r01", [-0.1, 0.0])?, b.anchor("r02", [0.2, 0.0])?];

        b.shake("foot 1", bars[0].node(0), choices.ground.clone())?;
        b.shake("foot 2", bars[1].node(0), choices.ground.clone())?;
        if choices.anchors_move {
            b.shake("anchor 1", anchors[0], choices.ground.clone())?;
            b.shake("anchor 2", anchors[1], choices.ground.clone())?;
        }
        join(&mut b, choices.joints, bars, at)?;

        let (ground, bar_end) = (anchors.map(Place::from), |k: usize, end| bars[k].node(end));
        let ends = [
            (at(1, 1), ground[0]),
            (at(1, 2), ground[1]),
            (bar_end(0, 0), bar_end(1, 1)),
            (bar_end(0, 1), bar_end(1, 0)),
            (at(0, 1), at(1, 1)),
            (at(0, 2), at(1, 2)),
            (at(0, 3), at(1, 1)),
            (at(0, 3), at(1, 2)),
            (at(1, 1), at(2, 1)),
            (at(1, 2), at(2, 2)),
            (at(1, 3), at(2, 1)),
            (at(1, 3), at(2, 2)),
        ];
        let mut cables = Vec::new();
        for ((k, (from, to)), length) in (1..).zip(ends).zip(initial_lengths()) {
            let ratio = if k <= 2 { choices.beta } else { choices.alpha };
            cables.push(b.cable(&format!("cable {k}"), from, to, choices.law.clone(), ratio * length)?);
        }
        let model = b.build()?;
        let mut vertices = Vec::new();
        for (k, v) in (0..3).flat_map(|k| (1..4).map(move |v| (k, v))) {
            vertices.push(model.form(at(k, v))?);
        }
        let centre3 = model.form(triangles[0].0.mass_centre())?;
        let triangles = std::array::from_fn(|k| triangles[k].0);
        Ok(Self { model, centre3, vertices, cables, bars, triangles })
    }

    /// Full velocities with triangle 7 pushed sideways at `speed` \[m/s\], not yet projected onto the constraints.
    ///
    /// # Errors
    /// Never for this tower; the member's coordinates would have to be degenerate.
    pub fn kick(&self, speed: f64) -> Result<Vec<f64>, CaseError> {
        let mut v = self.model.velocities_at_rest();
        let twist = Twist::planar(Vector2::new(speed, 0.0), 0.0);
        self.model.set_twist(self.triangles[2], &twist, &self.model.initial_coordinates(), &mut v)?;
        Ok(v)
    }

    /// Lengths less rest lengths of cables 1 to 12 \[m\]: slack where negative.
    pub fn stretches(&self, state: &State) -> Vec<f64> {
        slack::stretches(&self.model, state)
    }

    /// Height of the lowest vertex of a triangle \[m\].
    pub fn lowest_vertex(&self, state: &State) -> f64 {
        self.vertices.iter().map(|form| form.eval(&state.q).y).fold(f64::INFINITY, f64::min)
    }
}

fn join(
    b: &mut ModelBuilder<2>,
    joints: Joints,
    [bar1, bar2, bar4, bar6]: [MemberId; 4],
    at: impl Fn(usize, usize) -> Place<2>,
) -> Result<(), BuildError> {
    let (shared, constrained) = match joints {
        Joints::Paper => (Joining::Share, Joining::Constrain),
        Joints::Constrained => (Joining::Constrain, Joining::Constrain),
        Joints::Shared => (Joining::Share, Joining::Share),
    };
    b.joint("bar 1 - triangle 3", &[bar1.node(1), at(0, 1)], shared)?;
    b.joint("bar 6 - triangle 7", &[bar6.node(1), at(2, 3)], shared)?;
    b.joint("bar 2 - triangle 3", &[bar2.node(1), at(0, 2)], constrained)?;
    b.joint("triangle 3 - bar 4", &[at(0, 3), bar4.node(0)], constrained)?;
    b.joint("bar 4 - triangle 5 - bar 6", &[at(1, 3), bar4.node(1), bar6.node(0)], constrained)
}

/// Initial lengths of cables 1 to 12 \[m\], exact.
pub fn initial_lengths() -> [f64; 12] {
    let (diagonal, side) = (0.1 * 2.0_f64.sqrt(), 0.05 * 2.0_f64.sqrt());
    let guy = 0.1 * 5.0_f64.sqrt();
    [guy, guy, diagonal, diagonal, 0.1, 0.1, side, side, 0.1, 0.1, side, side]
}
