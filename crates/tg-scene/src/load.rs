//! Forces and moments.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::place::PlaceRef;
use crate::quantity::Vector;
use crate::signal::SignalSpec;
use crate::spanned::Spanned;

/// A force at a place, or a moment on a member: exactly one of `force`, `moment` and `joint_moments`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// The place of a force.
    #[serde(alias = "place")]
    #[schemars(extend("x-aliases" = ["place"]))]
    pub at: Option<PlaceRef>,
    /// The member of a moment.
    #[serde(alias = "member")]
    #[schemars(extend("x-aliases" = ["member"]))]
    pub on: Option<Spanned<String>>,
    /// Force \[N\], fixed in space.
    pub force: Option<Vector>,
    /// Moment \[N m\]: one number in the plane, counterclockwise; a vector in space, which is not conservative.
    pub moment: Option<Vector>,
    /// What the components of a moment in space refer to.
    pub axes: Option<MomentAxesName>,
    /// Moments (M_ε, M_β) \[N m\] about the axes of a universal joint that holds a bar: conservative (antiprism paper, eq. 22).
    pub joint_moments: Option<Vector>,
    /// Factor over time, 1 if not given.
    pub factor: Option<SignalSpec>,
}

/// Axes of a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MomentAxesName {
    /// The axes of space (the default).
    Space,
    /// The axes of the body, turning with it.
    Body,
}
