//! The variables that the nodes of a structure are affine functions of.

/// What a variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// P or z; its conjugate is the next variable.
    Holomorphic,
    /// P̄ or z̄.
    Antiholomorphic,
    /// A real coordinate of a node.
    Real,
    /// One of three components of a unit vector.
    Direction,
    /// One of ten products e_a e_b of a unit quaternion's components: no unknown itself.
    Product,
}

impl Kind {
    /// Whether conjugation exchanges it with its neighbour.
    pub(crate) fn is_conjugate(self) -> bool {
        matches!(self, Self::Holomorphic | Self::Antiholomorphic)
    }
}

/// A member's rotation from its place in the initial configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rotation {
    /// z = exp(i γ) and z̄, the variables from here on: z z̄ = 1.
    Angle(usize),
    /// The unit vector along a bar in space, three variables from here on: d·d = 1.
    Direction(usize),
    /// The products of a unit quaternion, ten variables from here on, by [`PAIRS`]: e·e = 1.
    Quaternion(usize),
}

/// The components of a quaternion that each product multiplies.
pub(crate) const PAIRS: [(usize, usize); 10] =
    [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (2, 3), (1, 3), (1, 2)];

/// Variables in the order of their making.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables {
    pub(crate) kinds: Vec<Kind>,
    pub(crate) names: Vec<String>,
}

impl Variables {
    pub(crate) fn len(&self) -> usize {
        self.kinds.len()
    }

    /// A new variable.
    pub(crate) fn add(&mut self, kind: Kind, name: String) -> usize {
        self.kinds.push(kind);
        self.names.push(name);
        self.len() - 1
    }

    /// Two conjugate variables; the first is returned.
    pub(crate) fn conjugates(&mut self, name: &str) -> usize {
        let first = self.add(Kind::Holomorphic, name.to_owned());
        self.add(Kind::Antiholomorphic, format!("conjugate {name}"));
        first
    }
}
