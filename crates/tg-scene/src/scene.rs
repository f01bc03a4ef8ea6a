//! The top of a scene file.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::cable::Group;
use crate::parts::with_parts;
use crate::quantity::{Quantity, Vector};
use crate::run::RunSection;
use crate::signal::SignalSpec;
use crate::spanned::{Named, Spanned};

/// Named numbers.
pub type Parameters = Named<Quantity>;

with_parts! {
    /// A scene: a structure and what is asked of it. SI units throughout; tension is positive; angles are in radians and
    /// counterclockwise or right-handed.
    #[derive(Clone, Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    pub struct Scene {
        /// Where editors find the schema of this file; not used otherwise.
        #[serde(rename = "$schema")]
        pub schema: Option<String>,
        /// Version of the format: 1.
        pub version: Spanned<u32>,
        /// One line for headings.
        pub title: Option<String>,
        /// What the scene shows and where its numbers come from.
        pub description: Option<String>,
        /// 2 for the plane (x to the right, y up), 3 for space (z up).
        #[serde(alias = "space")]
        #[schemars(extend("x-aliases" = ["space"]))]
        pub dimension: Spanned<u32>,
        /// Named numbers, which all quantities may use.
        #[serde(default)]
        pub parameters: Parameters,
        /// Acceleration of gravity \[m/s²\], none if not given.
        pub gravity: Option<Vector>,
        /// What happens to redundant constraints.
        #[serde(default)]
        pub redundancies: RedundanciesName,
        /// Named functions of time.
        #[serde(default)]
        pub signals: Named<SignalSpec>,
        /// Properties that cables share.
        #[serde(default)]
        pub groups: Named<Group>,
        /// The simulation that the scene is made for.
        pub run: Option<RunSection>,
    }
}

/// What happens to redundant constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RedundanciesName {
    /// They are a mistake, and named.
    #[default]
    Reject,
    /// They are left out, and named in the report.
    Drop,
}
