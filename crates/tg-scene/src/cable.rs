//! Cables, and the properties that a group of them shares.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::place::PlaceRef;
use crate::quantity::Quantity;
use crate::signal::SignalSpec;
use crate::spanned::Spanned;

/// A massless cable (string, tie, tendon, spring) between two places. What it does not say, its group says. Exactly one of
/// `rest`, `rest_ratio`, `tension` and `force_density` tells its rest length.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cable {
    /// The two places that it joins.
    #[serde(alias = "nodes", alias = "between")]
    #[schemars(extend("x-aliases" = ["nodes", "between"]))]
    pub ends: Spanned<Vec<PlaceRef>>,
    /// Name of the group that it belongs to: shared properties, and one colour or one variable in analyses.
    pub group: Option<Spanned<String>>,
    /// Whether it goes slack.
    pub law: Option<Law>,
    /// Stiffness κ \[N/m\].
    #[serde(alias = "k")]
    #[schemars(extend("x-aliases" = ["k"]))]
    pub stiffness: Option<Quantity>,
    /// Axial stiffness EA \[N\] instead: κ = EA / rest length.
    #[serde(alias = "EA")]
    #[schemars(extend("x-aliases" = ["EA"]))]
    pub axial_stiffness: Option<Quantity>,
    /// Damping η \[N s/m\], 0 if not given.
    #[serde(alias = "c")]
    #[schemars(extend("x-aliases" = ["c"]))]
    pub damping: Option<Quantity>,
    /// Rest length μ \[m\], constant or reeled.
    #[serde(alias = "rest_length", alias = "free_length", alias = "natural_length")]
    #[schemars(extend("x-aliases" = ["rest_length", "free_length", "natural_length"]))]
    pub rest: Option<SignalSpec>,
    /// Rest length as a part of the length as built.
    pub rest_ratio: Option<Quantity>,
    /// Tension as built \[N\], positive: the rest length follows.
    #[serde(alias = "pretension")]
    #[schemars(extend("x-aliases" = ["pretension"]))]
    pub tension: Option<Quantity>,
    /// Force density as built \[N/m\], tension by length: the rest length follows.
    pub force_density: Option<Quantity>,
}

/// Properties of all cables of a group; a cable's own take precedence.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Whether the cables go slack.
    pub law: Option<Law>,
    /// Stiffness κ \[N/m\].
    #[serde(alias = "k")]
    #[schemars(extend("x-aliases" = ["k"]))]
    pub stiffness: Option<Quantity>,
    /// Axial stiffness EA \[N\] instead: κ = EA / rest length.
    #[serde(alias = "EA")]
    #[schemars(extend("x-aliases" = ["EA"]))]
    pub axial_stiffness: Option<Quantity>,
    /// Damping η \[N s/m\].
    #[serde(alias = "c")]
    #[schemars(extend("x-aliases" = ["c"]))]
    pub damping: Option<Quantity>,
    /// Rest length μ \[m\], constant or reeled.
    #[serde(alias = "rest_length", alias = "free_length", alias = "natural_length")]
    #[schemars(extend("x-aliases" = ["rest_length", "free_length", "natural_length"]))]
    pub rest: Option<SignalSpec>,
    /// Rest length as a part of the length as built.
    pub rest_ratio: Option<Quantity>,
    /// Tension as built \[N\], positive: the rest length follows.
    #[serde(alias = "pretension")]
    #[schemars(extend("x-aliases" = ["pretension"]))]
    pub tension: Option<Quantity>,
    /// Force density as built \[N/m\], tension by length: the rest length follows.
    pub force_density: Option<Quantity>,
}

/// How a cable answers to being shorter than its rest length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// It goes slack (the default).
    #[serde(alias = "cable")]
    Slacking,
    /// It pushes: a two-way spring.
    #[serde(alias = "spring", alias = "two_way")]
    Linear,
}
