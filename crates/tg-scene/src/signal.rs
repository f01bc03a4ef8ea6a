//! Functions of time.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, forward_to_deserialize_any};

use crate::quantity::{Expression, Quantity};
use crate::spanned::Spanned;

/// A constant or a function of time, with its place in the file.
pub type SignalSpec = Spanned<SignalValue>;

/// A constant or a function of time.
#[derive(Clone, Debug)]
pub enum SignalValue {
    /// The same at all times.
    Constant(Expression),
    /// A function of time.
    Function(Box<Function>),
}

/// A function of time, in the unit of what it drives.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Function {
    /// A signal declared under `signals`.
    Signal(Spanned<String>),
    /// amplitude · sin(2π frequency t + phase).
    Sine(Sine),
    /// Linear from one value to another, held before and after.
    Ramp(Ramp),
    /// Piecewise linear through samples, held outside.
    Table(Samples),
    /// Piecewise linear through two columns of a CSV file, held outside.
    File(CsvFile),
    /// The sum of signals.
    Sum(Vec<SignalSpec>),
}

/// A sine.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sine {
    /// Amplitude, in the unit of what it drives.
    pub amplitude: Quantity,
    /// Frequency \[Hz\].
    pub frequency: Quantity,
    /// Phase at t = 0 \[rad\], 0 if not given.
    pub phase: Option<Quantity>,
}

/// A ramp.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// Value before the ramp.
    pub from: Quantity,
    /// Value after the ramp.
    pub to: Quantity,
    /// Begin \[s\], 0 if not given.
    pub start: Option<Quantity>,
    /// Length of time \[s\].
    pub duration: Quantity,
}

/// Samples.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Samples {
    /// Times \[s\], increasing.
    pub times: Vec<Quantity>,
    /// One value for each time.
    pub values: Vec<Quantity>,
}

/// Two columns of a CSV file with a header line.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CsvFile {
    /// The file, from the scene's folder.
    #[serde(alias = "path", alias = "csv")]
    #[schemars(extend("x-aliases" = ["path", "csv"]))]
    pub file: Spanned<String>,
    /// Name of the column of times \[s\], `t` if not given.
    pub time: Option<Spanned<String>>,
    /// Name of the column of values.
    #[serde(alias = "column")]
    #[schemars(extend("x-aliases" = ["column"]))]
    pub value: Spanned<String>,
    /// Factor of the values, 1 if not given: 9.81 makes m/s² of g, 0.001 makes metres of millimetres.
    pub scale: Option<Quantity>,
    /// What the values are: `value` (the default), or `acceleration`: then the signal is the displacement \[m\] from rest whose
    /// acceleration \[m/s²\] goes linearly through the samples, less the constant that would leave the ground moving at the end.
    pub kind: Option<RecordKind>,
}

/// What a recorded column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RecordKind {
    /// The values themselves.
    Value,
    /// Accelerations of ground motion.
    Acceleration,
}

impl<'de> Deserialize<'de> for SignalValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Signal;
        impl<'de> Visitor<'de> for Signal {
            type Value = SignalValue;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, an expression in quotes, or a signal such as { sine = { ... } }")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<SignalValue, E> {
                Ok(SignalValue::Constant(Expression::Number(value as f64)))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<SignalValue, E> {
                Ok(SignalValue::Constant(Expression::Number(value as f64)))
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<SignalValue, E> {
                Ok(SignalValue::Constant(Expression::Number(value)))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<SignalValue, E> {
                Ok(SignalValue::Constant(Expression::Text(text.into())))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SignalValue, A::Error> {
                Function::deserialize(OneEntry(map)).map(|f| SignalValue::Function(Box::new(f)))
            }
        }
        deserializer.deserialize_any(Signal)
    }
}

/// A table of one entry as the enumeration that it writes down.
struct OneEntry<A>(A);

impl<'de, A: MapAccess<'de>> Deserializer<'de> for OneEntry<A> {
    type Error = A::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, A::Error> {
        visitor.visit_enum(MapAccessDeserializer::new(self.0))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

impl JsonSchema for SignalValue {
    fn schema_name() -> Cow<'static, str> {
        "Signal".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (constant, function) =
            (generator.subschema_for::<Expression>(), generator.subschema_for::<Function>());
        json_schema!({
            "description": "A constant (number or expression), or a function of time.",
            "anyOf": [constant, function]
        })
    }
}
