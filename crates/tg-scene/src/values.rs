//! Quantities as numbers, vectors and matrices, with errors that say how many components were expected.

use nalgebra::{SMatrix, SVector};

use crate::error::ReadError;
use crate::expression::Variables;
use crate::quantity::{Quantity, Vector};
use crate::spanned::Spanned;

/// How many components a vector has.
pub(crate) const COMPONENTS: &str = "scenes with dimension = 2 have x and y, with 3 x, y and z";

/// A positive number.
pub(crate) fn positive(variables: &Variables, quantity: &Quantity) -> Result<f64, ReadError> {
    let value = variables.number(quantity)?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(ReadError::new(format!("the value is {value}; it must be positive")).at(&quantity.span))
}

/// A number that is positive or zero.
pub(crate) fn not_negative(variables: &Variables, quantity: &Quantity) -> Result<f64, ReadError> {
    let value = variables.number(quantity)?;
    if value >= 0.0 {
        return Ok(value);
    }
    Err(ReadError::new(format!("the value is {value}; it must not be negative")).at(&quantity.span))
}

/// A whole number between bounds.
pub(crate) fn whole(variables: &Variables, quantity: &Quantity, most: usize) -> Result<usize, ReadError> {
    let value = variables.number(quantity)?;
    if value.fract() == 0.0 && value >= 0.0 && value <= most as f64 {
        return Ok(value as usize);
    }
    Err(ReadError::new(format!("the value is {value}; it must be a whole number from 0 to {most}"))
        .at(&quantity.span))
}

/// N components.
pub(crate) fn components<const N: usize>(
    variables: &Variables,
    list: &[Quantity],
) -> Result<Option<[f64; N]>, ReadError> {
    if list.len() != N {
        return Ok(None);
    }
    let mut values = [0.0; N];
    for (value, quantity) in values.iter_mut().zip(list) {
        *value = variables.number(quantity)?;
    }
    Ok(Some(values))
}

/// A vector of N components.
pub(crate) fn vector<const N: usize>(
    variables: &Variables,
    given: &Vector,
) -> Result<SVector<f64, N>, ReadError> {
    let values = components::<N>(variables, &given.value)?;
    values.map(Into::into).ok_or_else(|| {
        let message = format!("expected {}, found {}", count(N), given.value.len());
        ReadError::new(message).at(&given.span).help(COMPONENTS)
    })
}

fn count(n: usize) -> String {
    if n == 1 { "one number in brackets".into() } else { format!("{n} components") }
}

/// A matrix of N rows and columns, row by row.
pub(crate) fn matrix<const N: usize>(
    variables: &Variables,
    rows: &Spanned<Vec<Vector>>,
) -> Result<SMatrix<f64, N, N>, ReadError> {
    if rows.value.len() != N {
        let message = format!("expected {N} rows of {N} numbers, found {} rows", rows.value.len());
        return Err(ReadError::new(message).at(&rows.span));
    }
    let mut matrix = SMatrix::<f64, N, N>::zeros();
    for (i, row) in rows.value.iter().enumerate() {
        matrix.set_row(i, &vector::<N>(variables, row)?.transpose());
    }
    Ok(matrix)
}
