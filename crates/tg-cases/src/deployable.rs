//! Example 3 of the framework paper: the spatial deployable tower of six bars, four tetrahedra and twenty-four cables
//! (Sec. 6.3, Tables 4 and 5).
//!
//! A two-stage prism of bars stands on three points of the ground and carries tetrahedron 7; tetrahedra 8, 9 and 10 are
//! stacked upon it, 8 and 9 apex to apex in one point. `geometry` says where everything stands, [`statics`] which
//! rest lengths hold it there.

mod geometry;
pub mod statics;

use std::array::from_fn;
use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::Vector3;
use tg_coords::{CoordType, CoordsError, MassProperties, Member};
use tg_model::{BuildError, CableId, CableLaw, Form, Joining, MemberId, Model, ModelBuilder, Place, Signal};

use crate::error::CaseError;
use crate::plane::G;

pub use geometry::{BAR_LENGTH, BASE_RADIUS, Configuration, TETRAHEDRON_HEIGHT, ground_points, vertices};

/// Number of cables.
pub const CABLES: usize = 24;
/// Mass of a bar \[kg\].
pub const BAR_MASS: f64 = 0.08;
/// Mass of a tetrahedron \[kg\].
pub const TETRAHEDRON_MASS: f64 = 0.2999233976;
/// Principal moments of inertia of a tetrahedron \[kg m²\], the last about the axis through its apex.
pub const TETRAHEDRON_INERTIA: [f64; 3] = [7.6639282053e-4, 7.6638139752e-4, 1.2464720496e-3];
/// Height of the mass centre of a tetrahedron above its base \[m\].
pub const CENTRE_HEIGHT: f64 = 0.1562442983 - 0.2 * FRAC_1_SQRT_2;
/// Stiffness κ of cables 1 to 9 and of the others \[N/m\].
const STIFFNESS: [f64; 2] = [1000.0, 500.0];
/// Number of cables of the prism.
const PRISM_CABLES: usize = 9;

/// A tetrahedron in a coordinate type of space: basic points are the vertices in their order, the apex first; base
/// vectors are the unit axes that the type still needs, those with the last letters.
///
/// # Errors
/// The type is not one of a body in space.
pub fn tetrahedron(coord_type: CoordType) -> Result<Member<3>, CoordsError> {
    let (vertices, axes) = (vertices().map(Vector3::from), [Vector3::x(), Vector3::y(), Vector3::z()]);
    let nodes: Vec<_> = (0..coord_type.nodes())
        .map(|k| if coord_type.is_point(k) { vertices[k] } else { axes[k - 1] })
        .collect();
    let centre = Vector3::new(0.0, 0.0, CENTRE_HEIGHT);
    let mass = MassProperties::from_principal_moments(TETRAHEDRON_MASS, centre, TETRAHEDRON_INERTIA)?;
    Member::new(coord_type, &nodes, mass)
}

/// Parameters of the structure and choices of modelling.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Where the structure stands at t = 0.
    pub configuration: Configuration,
    /// Rest lengths of cables 1 to 24 \[m\].
    pub rest: [Signal; CABLES],
    /// Motion of the ground points along x \[m\].
    pub ground: Signal,
    /// Damping η of all cables \[N s/m\].
    pub damping: f64,
    /// Coordinate types of tetrahedra 7 to 10.
    pub types: [CoordType; 4],
}

impl Choices {
    /// The paper's structure with constant rest lengths \[m\] on resting ground.
    pub fn still(configuration: Configuration, rest: &[f64; CABLES]) -> Self {
        use CoordType::{Rrrr, Rrrw, Rrvw, Ruvw};
        Self {
            configuration,
            rest: rest.map(Signal::Constant),
            ground: Signal::Constant(0.0),
            damping: 2.0,
            types: [Rrrr, Rrrw, Rrvw, Ruvw],
        }
    }

    /// The deployment of Sec. 6.3.3: rest lengths \[m\] go linearly from the initial to the target ones in `duration`
    /// seconds (Fig. 21).
    pub fn deployment(initial: &[f64; CABLES], target: &[f64; CABLES], duration: f64) -> Self {
        let rest = from_fn(|k| Signal::ramp(initial[k], target[k], duration));
        Self { rest, ..Self::still(Configuration::Initial, initial) }
    }

    /// The same on ground that moves by x = 0.01 sin(2πνt) \[m\], ν = `frequency` \[Hz\]; zero for ground at rest.
    #[must_use]
    pub fn on_seismic_ground(self, frequency: f64) -> Self {
        let ground = if frequency == 0.0 { Signal::Constant(0.0) } else { Signal::sine(0.01, frequency) };
        Self { ground, ..self }
    }
}

/// The model and what is looked at.
#[derive(Clone, Debug)]
pub struct Deployable {
    /// The model.
    pub model: Model<3>,
    /// Tetrahedra 7 to 10.
    pub tetrahedra: [MemberId; 4],
    /// Their mass centres.
    pub centres: [Form<3>; 4],
    /// Their vertices, the apex first.
    pub vertices: [[Form<3>; 4]; 4],
    /// Ring points R_1 to R_3.
    pub ring: [Form<3>; 3],
    /// Ground points G_1 to G_3.
    pub ground: [Form<3>; 3],
    /// Cables 1 to 24.
    pub cables: Vec<CableId>,
}

impl Deployable {
    /// Builds the structure.
    ///
    /// # Errors
    /// A type is not one of a body in space, or a number is not finite.
    pub fn new(choices: &Choices) -> Result<Self, CaseError> {
        let mut b = ModelBuilder::<3>::new();
        b.gravity([0.0, 0.0, -G])?;
        let places = Places::add(&mut b, choices)?;
        for (k, foot) in places.ground.into_iter().enumerate() {
            b.shake(&format!("ground {}", k + 1), foot, choices.ground.clone())?;
        }
        let mut cables = Vec::new();
        for (k, ((from, to), rest)) in places.cable_ends().into_iter().zip(&choices.rest).enumerate() {
            let stiffness = STIFFNESS[usize::from(k >= PRISM_CABLES)];
            let law = CableLaw::slacking(stiffness).with_damping(choices.damping);
            cables.push(b.cable(&format!("cable {}", k + 1), from, to, law, rest.clone())?);
        }
        let model = b.build()?;
        let (tetrahedra, [v7, v8, v9, v10]) = (places.tetrahedra, places.vertices);
        Ok(Self {
            centres: forms(&model, tetrahedra.map(MemberId::mass_centre))?,
            vertices: [forms(&model, v7)?, forms(&model, v8)?, forms(&model, v9)?, forms(&model, v10)?],
            ring: forms(&model, places.ring)?,
            ground: forms(&model, places.ground)?,
            model,
            tetrahedra,
            cables,
        })
    }
}

fn forms<const N: usize>(model: &Model<3>, places: [Place<3>; N]) -> Result<[Form<3>; N], CaseError> {
    let forms = places.into_iter().map(|place| model.form(place)).collect::<Result<Vec<_>, _>>()?;
    Ok(from_fn(|k| forms[k].clone()))
}

/// The structure's points while it is being built.
struct Places {
    tetrahedra: [MemberId; 4],
    ground: [Place<3>; 3],
    ring: [Place<3>; 3],
    /// Vertices of tetrahedra 7 to 10, the apex first.
    vertices: [[Place<3>; 4]; 4],
}

impl Places {
    /// Adds members and joints.
    fn add(b: &mut ModelBuilder<3>, choices: &Choices) -> Result<Self, BuildError> {
        let mut tetrahedra = Vec::new();
        for ((k, &coord_type), pose) in (7..).zip(&choices.types).zip(choices.configuration.poses()) {
            let name = format!("tetrahedron {k}");
            let body = tetrahedron(coord_type).map_err(|source| BuildError::Coordinates {
                kind: "member",
                name: name.clone(),
                source,
            })?;
            tetrahedra.push(b.member(&name, body, pose)?);
        }
        let tetrahedra: [MemberId; 4] = from_fn(|k| tetrahedra[k]);
        let vertices: [[Place<3>; 4]; 4] =
            from_fn(|k| from_fn(|v| vertex(tetrahedra[k], choices.types[k], v)));
        let (lower, upper) = Self::add_bars(b, choices.configuration)?;
        let ring = upper.map(|bar| bar.node(0));
        // A vertex of tetrahedron 7 can be shared where its type has a basic point there.
        let joining = |v| if choices.types[0].is_point(v) { Joining::Share } else { Joining::Constrain };
        for i in 0..3 {
            let (k, v) = (next(i), 1 + next(i));
            b.joint(&format!("ring {}", k + 1), &[lower[i].node(1), ring[k]], Joining::Share)?;
            let ends = [upper[i].node(1), vertices[0][v]];
            b.joint(&format!("bar {} - tetrahedron 7", i + 4), &ends, joining(v))?;
        }
        b.joint("tetrahedron 8 - tetrahedron 9", &[vertices[1][0], vertices[2][0]], Joining::Share)?;
        Ok(Self { tetrahedra, ground: lower.map(|bar| bar.node(0)), ring, vertices })
    }

    /// Bars 1 to 3 from the ground to the ring, and 4 to 6 from there to the base of tetrahedron 7.
    fn add_bars(
        b: &mut ModelBuilder<3>,
        configuration: Configuration,
    ) -> Result<([MemberId; 3], [MemberId; 3]), BuildError> {
        let (ground, ring, pose) = (ground_points(), configuration.ring(), configuration.poses()[0]);
        let base = |i: usize| pose.apply_point(&vertices()[1 + i].into()).into();
        let mut bars = Vec::new();
        for i in 0..3 {
            bars.push(b.bar(&format!("bar {}", i + 1), BAR_MASS, ground[i], ring[next(i)])?);
        }
        for i in 0..3 {
            bars.push(b.bar(&format!("bar {}", i + 4), BAR_MASS, ring[i], base(next(i)))?);
        }
        Ok((from_fn(|i| bars[i]), from_fn(|i| bars[3 + i])))
    }

    /// Ends of cables 1 to 24.
    fn cable_ends(&self) -> Vec<(Place<3>, Place<3>)> {
        let (ground, ring, [t7, t8, t9, t10]) = (&self.ground, &self.ring, &self.vertices);
        // Turning a tetrahedron over exchanges two vertices of its base.
        let turned_over = [1, 3, 2];
        let groups: [&dyn Fn(usize) -> (Place<3>, Place<3>); 8] = [
            &|i| (ground[i], ring[i]),
            &|i| (ring[i], ring[next(i)]),
            &|i| (ring[i], t7[1 + i]),
            &|i| (t7[0], t8[1 + i]),
            &|i| (t7[1 + i], t8[1 + i]),
            &|i| (t8[1 + i], t9[turned_over[i]]),
            &|i| (t9[1 + i], t10[1 + i]),
            &|i| (t9[1 + i], t10[0]),
        ];
        groups.iter().flat_map(|group| (0..3).map(group)).collect()
    }
}

/// Vertex `v` of a tetrahedron: a basic point where its type has one there, else a material point.
fn vertex(tetrahedron: MemberId, coord_type: CoordType, v: usize) -> Place<3> {
    if coord_type.is_point(v) { tetrahedron.node(v) } else { tetrahedron.at(vertices()[v]) }
}

/// The next of three corners.
fn next(i: usize) -> usize {
    (i + 1) % 3
}
