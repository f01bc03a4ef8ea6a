//! Values of expressions, and names with expressions in braces.

use crate::arithmetic::{Arithmetic, is_function, is_name};
use crate::error::ReadError;
use crate::node::Span;
use crate::quantity::{Expression, Quantity};
use crate::scene::Parameters;
use crate::spanned::Spanned;

/// Values of parameters and of the indices of arrays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables(Vec<(String, f64)>);

impl Variables {
    /// Values of the parameters, which may use each other in any order. `overrides` replace values.
    pub(crate) fn of(parameters: &Parameters, overrides: &[(String, f64)]) -> Result<Self, ReadError> {
        for (name, _) in overrides {
            if !parameters.0.iter().any(|(parameter, _)| parameter.value == *name) {
                let known: Vec<_> = parameters.0.iter().map(|(name, _)| name.value.as_str()).collect();
                let error = ReadError::new(format!("the scene has no parameter `{name}` that could be set"));
                return Err(error.suggest(name, &known));
            }
        }
        let mut values = Self(overrides.to_vec());
        let mut open: Vec<_> =
            parameters.0.iter().filter(|(name, _)| values.get(&name.value).is_none()).collect();
        for (name, _) in &parameters.0 {
            check_name(name)?;
        }
        while !open.is_empty() {
            let before = open.len();
            let mut waiting = Vec::new();
            for entry in open {
                let (name, quantity) = entry;
                let others = |word: &str| parameters.0.iter().any(|(other, _)| other.value == word);
                match values.number(quantity) {
                    Ok(value) => values.0.push((name.value.clone(), value)),
                    Err(_) if uses(quantity, &|w| others(w) && values.get(w).is_none()) => {
                        waiting.push(entry);
                    }
                    Err(error) => return Err(error),
                }
            }
            if waiting.len() == before {
                let (name, quantity) = waiting[0];
                let circle = waiting.iter().map(|(name, _)| format!("`{}`", name.value)).collect::<Vec<_>>();
                let message = format!("the parameter `{}` depends on itself", name.value);
                let help = format!("these wait for each other: {}", circle.join(", "));
                return Err(ReadError::new(message).at(&quantity.span).help(help));
            }
            open = waiting;
        }
        Ok(values)
    }

    /// The same with one more variable, which hides another of its name.
    pub(crate) fn with(&self, name: &str, value: f64) -> Self {
        let mut inner = self.clone();
        inner.0.retain(|(other, _)| other != name);
        inner.0.push((name.into(), value));
        inner
    }

    pub(crate) fn get(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(other, _)| other == name).map(|(_, value)| *value)
    }

    /// All names and values.
    pub(crate) fn all(&self) -> &[(String, f64)] {
        &self.0
    }

    /// The finite value of a quantity.
    pub(crate) fn number(&self, quantity: &Quantity) -> Result<f64, ReadError> {
        let value = match &quantity.value {
            Expression::Number(value) => *value,
            Expression::Text(text) => self.evaluate(text, &quantity.span)?,
        };
        if value.is_finite() {
            return Ok(value);
        }
        let error = match &quantity.value {
            Expression::Number(_) => {
                ReadError::new(format!("the value is {value}")).help("give a finite number")
            }
            Expression::Text(text) => ReadError::new(format!("the value of `{text}` is {value}"))
                .help("a division by zero, or a function outside its range"),
        };
        Err(error.at(&quantity.span))
    }

    /// A text with the expressions in its braces replaced by their values: `strut {i + 1}`.
    pub(crate) fn fill(&self, text: &str, span: &Span) -> Result<String, ReadError> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let Some((expression, after)) = after.split_once('}') else {
                let error = ReadError::new(format!("`{text}` opens a brace and does not close it"));
                return Err(error.at(span).help("braces hold an expression: \"name {i + 1}\""));
            };
            let value = self.evaluate(expression, span)?;
            filled += before;
            filled += &value.to_string();
            rest = after;
        }
        Ok(filled + rest)
    }

    fn evaluate(&self, text: &str, span: &Span) -> Result<f64, ReadError> {
        let expression = Arithmetic::parse(text).map_err(|why| {
            let help = "numbers, parameters and + - * / % ^ sqrt(x) sin(x) ... make an expression";
            ReadError::new(format!("`{text}` is no expression: {why}")).at(span).help(help)
        })?;
        expression.value(&|name| {
            let constant =
                || CONSTANTS.iter().find(|(constant, _)| *constant == name).map(|(_, value)| *value);
            self.get(name).or_else(constant).ok_or_else(|| {
                let known: Vec<&str> = self.0.iter().map(|(name, _)| name.as_str()).collect();
                let error = ReadError::new(format!("there is no parameter `{name}`")).at(span);
                if known.is_empty() {
                    error.help("declare it under [parameters]")
                } else {
                    error.suggest(name, &known)
                }
            })
        })
    }
}

/// Constants that a parameter of the same name hides.
const CONSTANTS: [(&str, f64); 4] = [
    ("PI", std::f64::consts::PI),
    ("TAU", std::f64::consts::TAU),
    ("deg", std::f64::consts::PI / 180.0),
    ("g", 9.81),
];

/// Whether a quantity uses a name that satisfies a predicate.
fn uses(quantity: &Quantity, name: &impl Fn(&str) -> bool) -> bool {
    match &quantity.value {
        Expression::Text(text) => Arithmetic::parse(text).is_ok_and(|expression| expression.uses(name)),
        Expression::Number(_) => false,
    }
}

/// Refuses names that an expression could not use.
pub(crate) fn check_name(name: &Spanned<String>) -> Result<(), ReadError> {
    if is_name(&name.value) && !is_function(&name.value) {
        return Ok(());
    }
    Err(ReadError::new(format!("`{}` cannot be the name of a parameter", name.value))
        .at(&name.span)
        .help("use letters, digits and _, and no function's name"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_filled_with_whole_numbers() {
        let variables = Variables::default().with("i", 2.0);
        assert_eq!(variables.fill("strut {i+1}.to {(i+1)%3}", &(0..0)).unwrap(), "strut 3.to 0");
        assert!(variables.fill("strut {i", &(0..0)).is_err());
    }
}
