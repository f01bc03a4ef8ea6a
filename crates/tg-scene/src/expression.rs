//! Values of expressions, and names with expressions in braces.

use std::collections::{BTreeSet, HashMap, VecDeque};
use std::sync::Arc;

use crate::arithmetic::{Arithmetic, is_function, is_name};
use crate::deserialize::list;
use crate::error::ReadError;
use crate::node::Span;
use crate::quantity::{Expression, Quantity};
use crate::scene::Parameters;
use crate::spanned::Spanned;

/// Values of parameters and of the indices of arrays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables {
    /// The same in all copies of all arrays.
    parameters: Arc<Values>,
    /// The innermost last.
    indices: Vec<(String, f64)>,
}

/// Values by name.
#[derive(Debug, Default)]
struct Values {
    list: Vec<(String, f64)>,
    position: HashMap<String, usize>,
}

impl Values {
    fn insert(&mut self, name: &str, value: f64) {
        self.position.insert(name.into(), self.list.len());
        self.list.push((name.into(), value));
    }
}

impl Variables {
    /// Values of the parameters, which may use each other in any order. `overrides` replace values.
    pub(crate) fn of(parameters: &Parameters, overrides: &[(String, f64)]) -> Result<Self, ReadError> {
        let number_of: HashMap<&str, usize> =
            parameters.0.iter().map(|(name, _)| name.value.as_str()).zip(0..).collect();
        let mut known = Values::default();
        for (name, value) in overrides {
            if !number_of.contains_key(name.as_str()) {
                let names: Vec<_> = parameters.0.iter().map(|(name, _)| name.value.as_str()).collect();
                let error = ReadError::new(format!("the scene has no parameter `{name}` that could be set"));
                return Err(error.suggest(name, &names));
            }
            known.insert(name, *value);
        }
        // How many others each one waits for, and who waits for it.
        let mut waits = vec![0_usize; parameters.0.len()];
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); parameters.0.len()];
        for (k, (name, quantity)) in parameters.0.iter().enumerate() {
            check_name(name)?;
            if known.position.contains_key(&name.value) {
                continue;
            }
            for other in names(quantity) {
                if let Some(&other) = number_of.get(other.as_str())
                    && !known.position.contains_key(&parameters.0[other].0.value)
                {
                    waits[k] += 1;
                    waiting[other].push(k);
                }
            }
        }
        let open = |k: &usize| !known.position.contains_key(&parameters.0[*k].0.value);
        let mut ready: VecDeque<usize> = (0..waits.len()).filter(|&k| waits[k] == 0 && open(&k)).collect();
        let mut left: usize = (0..waits.len()).filter(open).count();
        let mut values = Self { parameters: Arc::new(known), indices: Vec::new() };
        while let Some(k) = ready.pop_front() {
            let (name, quantity) = &parameters.0[k];
            let value = values.number(quantity)?;
            if let Some(known) = Arc::get_mut(&mut values.parameters) {
                known.insert(&name.value, value);
            }
            left -= 1;
            for &other in &waiting[k] {
                waits[other] -= 1;
                if waits[other] == 0 {
                    ready.push_back(other);
                }
            }
        }
        if left > 0 {
            let circle: Vec<&(Spanned<String>, Quantity)> =
                parameters.0.iter().zip(&waits).filter(|(_, waits)| **waits > 0).map(|(p, _)| p).collect();
            let names = circle.iter().map(|(name, _)| name.value.as_str()).take(10).collect::<Vec<_>>();
            let message = format!("the parameter `{}` depends on itself", names[0]);
            let help = format!("these wait for each other: {}", list(&names));
            return Err(ReadError::new(message).at(&circle[0].1.span).help(help));
        }
        // In the order of the file again.
        let mut sorted = Values::default();
        for (name, _) in &parameters.0 {
            if let Some(value) = values.get(&name.value) {
                sorted.insert(&name.value, value);
            }
        }
        Ok(Self { parameters: Arc::new(sorted), indices: Vec::new() })
    }

    /// The same with one more variable, which hides another of its name.
    pub(crate) fn with(&self, name: &str, value: f64) -> Self {
        let mut inner = self.clone();
        inner.indices.push((name.into(), value));
        inner
    }

    fn get(&self, name: &str) -> Option<f64> {
        let index = self.indices.iter().rfind(|(other, _)| other == name).map(|(_, value)| *value);
        index.or_else(|| self.parameters.position.get(name).map(|&k| self.parameters.list[k].1))
    }

    /// Names and values of all parameters.
    pub(crate) fn all(&self) -> &[(String, f64)] {
        &self.parameters.list
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
                let all = self.indices.iter().chain(&self.parameters.list);
                let known: Vec<&str> = all.map(|(name, _)| name.as_str()).collect();
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

/// Names that a quantity uses, each once.
fn names(quantity: &Quantity) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    if let Expression::Text(text) = &quantity.value
        && let Ok(expression) = Arithmetic::parse(text)
    {
        expression.each_name(&mut |name| {
            names.insert(name.into());
        });
    }
    names
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
