//! One-parameter families of structures: what continuation follows.

use tg_model::{BuildError, CableId, CableLaw, Model, Tensioned};

/// A structure with its inputs at one value of the parameter.
pub struct Instance<'f> {
    structure: Held<'f>,
    /// Inputs u.
    pub u: Vec<f64>,
}

enum Held<'f> {
    Borrowed(&'f dyn Tensioned),
    Owned(Box<dyn Tensioned + 'f>),
}

impl<'f> Instance<'f> {
    /// A structure that does not depend on the parameter.
    pub fn borrowed(structure: &'f dyn Tensioned, u: Vec<f64>) -> Self {
        Self { structure: Held::Borrowed(structure), u }
    }

    /// A structure made for the parameter; its coordinates and patterns are the same for all values.
    pub fn owned(structure: impl Tensioned + 'f, u: Vec<f64>) -> Self {
        Self { structure: Held::Owned(Box::new(structure)), u }
    }

    /// The structure.
    pub fn structure(&self) -> &dyn Tensioned {
        match &self.structure {
            Held::Borrowed(structure) => *structure,
            Held::Owned(structure) => structure.as_ref(),
        }
    }
}

/// A family of structures with one scalar parameter.
pub trait Family {
    /// The structure and inputs at a value of the parameter.
    ///
    /// # Errors
    /// The parameter is outside of what the structure allows.
    fn at(&self, parameter: f64) -> Result<Instance<'_>, BuildError>;
}

/// Inputs that change along a line, u = origin + p direction: a load factor, a rest length, several at once.
pub struct InputFamily<'s> {
    structure: &'s dyn Tensioned,
    origin: Vec<f64>,
    direction: Vec<f64>,
}

impl<'s> InputFamily<'s> {
    /// Inputs `origin + p direction` (rest lengths \[m\], then the components of loads \[N or N m\]).
    ///
    /// # Panics
    /// When the vectors do not have the length of the structure's inputs.
    #[track_caller]
    pub fn new(structure: &'s dyn Tensioned, origin: &[f64], direction: &[f64]) -> Self {
        let inputs = structure.sizes().inputs;
        assert_eq!(origin.len(), inputs, "length of the origin of inputs");
        assert_eq!(direction.len(), inputs, "length of the direction of inputs");
        Self { structure, origin: origin.to_vec(), direction: direction.to_vec() }
    }

    /// The loads of `u` times the parameter, rest lengths as they are.
    #[track_caller]
    pub fn load_factor(structure: &'s dyn Tensioned, u: &[f64]) -> Self {
        let (rest, loads) = u.split_at(structure.cable_count());
        let zeros = |x: &[f64]| vec![0.0; x.len()];
        Self::new(structure, &[rest, &zeros(loads)].concat(), &[&zeros(rest), loads].concat())
    }

    /// The rest length of one cable is the parameter \[m\], all other inputs are those of `u`.
    #[track_caller]
    pub fn rest_length(structure: &'s dyn Tensioned, u: &[f64], cable: usize) -> Self {
        let (mut origin, mut direction) = (u.to_vec(), vec![0.0; u.len()]);
        (origin[cable], direction[cable]) = (0.0, 1.0);
        Self::new(structure, &origin, &direction)
    }
}

impl Family for InputFamily<'_> {
    fn at(&self, parameter: f64) -> Result<Instance<'_>, BuildError> {
        let u = self.origin.iter().zip(&self.direction).map(|(a, b)| a + parameter * b).collect();
        Ok(Instance::borrowed(self.structure, u))
    }
}

/// The stiffness κ \[N/m\] of some cables is the parameter; their laws are linear.
pub struct StiffnessFamily<'s, const D: usize> {
    model: &'s Model<D>,
    cables: Vec<CableId>,
    u: Vec<f64>,
}

impl<'s, const D: usize> StiffnessFamily<'s, D> {
    /// The stiffness of `cables` as parameter, at inputs `u`; cables with a user's law stay as they are.
    pub fn new(model: &'s Model<D>, cables: &[CableId], u: &[f64]) -> Self {
        Self { model, cables: cables.to_vec(), u: u.to_vec() }
    }
}

impl<const D: usize> Family for StiffnessFamily<'_, D> {
    fn at(&self, parameter: f64) -> Result<Instance<'_>, BuildError> {
        let mut model = self.model.clone();
        for &cable in &self.cables {
            let law = match *model.cable_law(cable) {
                CableLaw::Linear { damping, .. } => CableLaw::Linear { stiffness: parameter, damping },
                CableLaw::Slacking { damping, .. } => CableLaw::Slacking { stiffness: parameter, damping },
                CableLaw::User(ref law) => CableLaw::User(law.clone()),
            };
            model = model.with_law(cable, law)?;
        }
        Ok(Instance::owned(model, self.u.clone()))
    }
}
