//! Numbers of a scene: written as such, or as an expression over parameters.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Visitor};

use crate::spanned::Spanned;

/// A number or an expression.
#[derive(Clone, Debug)]
pub enum Expression {
    /// A number.
    Number(f64),
    /// Arithmetic over parameters, as `sqrt(2) / 20`.
    Text(String),
}

/// A number or an expression, with its place in the file. SI units.
pub type Quantity = Spanned<Expression>;

/// Components of a point or a vector: two in the plane, three in space.
pub type Vector = Spanned<Vec<Quantity>>;

impl<'de> Deserialize<'de> for Expression {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl Visitor<'_> for Number {
            type Value = Expression;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or an expression in quotes")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Expression, E> {
                Ok(Expression::Number(value as f64))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Expression, E> {
                Ok(Expression::Number(value as f64))
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Expression, E> {
                Ok(Expression::Number(value))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Expression, E> {
                Ok(Expression::Text(text.into()))
            }
        }
        deserializer.deserialize_any(Number)
    }
}

impl JsonSchema for Expression {
    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": ["number", "string"],
            "description": "A number, or an expression in quotes over parameters and array indices. Operators: + - * / % ^; functions: sqrt, sin, cos, tan, asin, acos, atan, atan2(y, x), exp, ln, abs, floor, min(a, b), max(a, b); constants: PI, TAU, deg = PI/180, g = 9.81. The first stage of an array has index 0."
        })
    }
}
