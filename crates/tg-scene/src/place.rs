//! References to points of a structure.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::quantity::Quantity;
use crate::spanned::Spanned;

/// Where something is attached, with its place in the file.
pub type PlaceRef = Spanned<PlaceName>;

/// Where something is attached.
#[derive(Clone, Debug)]
pub enum PlaceName {
    /// An anchor, a particle, or `member.point`.
    Name(String),
    /// A point of a member that has no name.
    On(OnMember),
    /// A point of space.
    Position(Vec<Quantity>),
}

/// A point of a member that has no name.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnMember {
    /// Name of the member.
    pub on: Spanned<String>,
    /// On a bar one number, the part of its length from its first end. On a body, a point \[m\] of its local frame.
    pub at: Vec<Quantity>,
}

impl<'de> Deserialize<'de> for PlaceName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Place;
        impl<'de> Visitor<'de> for Place {
            type Value = PlaceName;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a point: \"anchor\", \"bar.from\", \"body.point\" or { on = \"bar\", at = [0.5] }",
                )
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<PlaceName, E> {
                Ok(PlaceName::Name(name.into()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PlaceName, A::Error> {
                OnMember::deserialize(MapAccessDeserializer::new(map)).map(PlaceName::On)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<PlaceName, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(PlaceName::Position)
            }
        }
        deserializer.deserialize_any(Place)
    }
}

impl JsonSchema for PlaceName {
    fn schema_name() -> Cow<'static, str> {
        "Place".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (on, position) =
            (generator.subschema_for::<OnMember>(), generator.subschema_for::<Vec<Quantity>>());
        json_schema!({
            "description": "A place: the name of an anchor, of a particle or (where a position is asked for) of a point; or \"member.point\", the points of a bar being from, to and centre, those of a body its own names, origin and centre; or { on = \"member\", at = [...] }; or, for positions, coordinates [m].",
            "anyOf": [{ "type": "string" }, on, position]
        })
    }
}
