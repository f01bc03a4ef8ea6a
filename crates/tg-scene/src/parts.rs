//! What a structure consists of, at the top of a scene and in each of its arrays.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::cable::Cable;
use crate::load::Load;
use crate::member::{Bar, Body, Particle};
use crate::place::PlaceRef;
use crate::quantity::{Quantity, Vector};
use crate::signal::SignalSpec;
use crate::spanned::{Named, Spanned};

/// Declares a table of a scene that holds parts of a structure besides its own keys.
macro_rules! with_parts {
    ($(#[$meta:meta])* pub struct $name:ident { $($own:tt)* }) => {
        $(#[$meta])*
        pub struct $name {
            $($own)*
            /// Named points of space \[m\]: they have no mechanics, positions refer to them.
            #[serde(default)]
            pub points: Named<crate::place::PlaceRef>,
            /// Rigid bars.
            #[serde(default, alias = "struts", alias = "rods")]
            #[schemars(extend("x-aliases" = ["struts", "rods"]))]
            pub bars: Named<crate::member::Bar>,
            /// Rigid bodies.
            #[serde(default)]
            pub bodies: Named<crate::member::Body>,
            /// Masses at a point.
            #[serde(default)]
            pub particles: Named<crate::member::Particle>,
            /// Fixed points of the ground \[m\], which supports may move.
            #[serde(default)]
            pub anchors: Named<crate::place::PlaceRef>,
            /// Joints: pins in the plane, ball joints in space.
            #[serde(default)]
            pub joints: Named<crate::parts::Joint>,
            /// Supports: components of places that are held or moved.
            #[serde(default)]
            pub supports: Named<crate::parts::Support>,
            /// Cables.
            #[serde(default, alias = "strings", alias = "ties", alias = "tendons", alias = "springs")]
            #[schemars(extend("x-aliases" = ["strings", "ties", "tendons", "springs"]))]
            pub cables: Named<crate::cable::Cable>,
            /// Forces and moments.
            #[serde(default)]
            pub loads: Named<crate::load::Load>,
            /// Parts repeated by count.
            #[serde(default)]
            pub arrays: Named<crate::parts::Array>,
        }

        impl $name {
            /// The parts that stand here.
            pub(crate) fn parts(&self) -> crate::parts::Parts<'_> {
                crate::parts::Parts {
                    points: &self.points.0,
                    bars: &self.bars.0,
                    bodies: &self.bodies.0,
                    particles: &self.particles.0,
                    anchors: &self.anchors.0,
                    joints: &self.joints.0,
                    supports: &self.supports.0,
                    cables: &self.cables.0,
                    loads: &self.loads.0,
                    arrays: &self.arrays.0,
                }
            }
        }
    };
}
pub(crate) use with_parts;

type List<'a, T> = &'a [(Spanned<String>, T)];

/// The parts of a scene or of an array.
#[derive(Clone, Copy)]
pub(crate) struct Parts<'a> {
    pub(crate) points: List<'a, PlaceRef>,
    pub(crate) bars: List<'a, Bar>,
    pub(crate) bodies: List<'a, Body>,
    pub(crate) particles: List<'a, Particle>,
    pub(crate) anchors: List<'a, PlaceRef>,
    pub(crate) joints: List<'a, Joint>,
    pub(crate) supports: List<'a, Support>,
    pub(crate) cables: List<'a, Cable>,
    pub(crate) loads: List<'a, Load>,
    pub(crate) arrays: List<'a, Array>,
}

impl Parts<'_> {
    /// How many parts stand here, those of arrays not counted.
    pub(crate) fn count(&self) -> usize {
        let members = self.bars.len() + self.bodies.len() + self.particles.len();
        let attached = self.joints.len() + self.supports.len() + self.cables.len() + self.loads.len();
        self.points.len() + self.anchors.len() + members + attached
    }
}

with_parts! {
    /// Parts repeated `count` times, each time turned and shifted once more. In names and references `{i}` stands for the
    /// index, `{(i + 1) % 3}` for an expression of it; quantities may use it as a variable.
    #[derive(Clone, Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    pub struct Array {
        /// How many times.
        pub count: Quantity,
        /// Name of the index, which counts from 0; `i` if not given.
        pub index: Option<Spanned<String>>,
        /// Angle from one copy to the next \[rad\], about the origin in the plane and about `axis` in space.
        pub rotate: Option<Quantity>,
        /// Axis of that rotation in space, z if not given.
        pub axis: Option<Vector>,
        /// Centre of that rotation \[m\], the origin if not given.
        #[serde(alias = "center")]
        #[schemars(extend("x-aliases" = ["center"]))]
        pub centre: Option<Vector>,
        /// Shift from one copy to the next \[m\].
        #[serde(alias = "shift")]
        #[schemars(extend("x-aliases" = ["shift"]))]
        pub translate: Option<Vector>,
    }
}

/// A torqueless joint of two or more points.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// The points that are one.
    #[serde(alias = "points")]
    #[schemars(extend("x-aliases" = ["points"]))]
    pub places: Spanned<Vec<PlaceRef>>,
    /// How it is modelled; the motion is the same. By sharing where all points are basic points or anchors, else by
    /// constraints.
    pub joining: Option<JoiningName>,
}

/// How a joint is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JoiningName {
    /// The points become one set of coordinates.
    Share,
    /// Constraints hold them together.
    Constrain,
}

/// Components of a place that are held, or moved by signals.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// The place.
    #[serde(alias = "place")]
    #[schemars(extend("x-aliases" = ["place"]))]
    pub at: PlaceRef,
    /// The components, as `"xy"` or `"z"`; all if not given.
    pub axes: Option<Spanned<String>>,
    /// Displacements along the held components over time \[m\].
    #[serde(default)]
    pub motion: Motion,
}

/// Displacements of a support over time.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Along x \[m\].
    pub x: Option<SignalSpec>,
    /// Along y \[m\].
    pub y: Option<SignalSpec>,
    /// Along z \[m\].
    pub z: Option<SignalSpec>,
}
