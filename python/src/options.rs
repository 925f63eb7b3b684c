//! Options by keyword.

use crate::errors::{self, invalid};
use netmesh::Options;
use netmesh::options::{Kind, Row, TABLE, Value};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Returns the options that are given, and the defaults of others.
pub fn options(given: &Bound<'_, PyDict>) -> PyResult<Options> {
    let mut options = Options::default();
    for (name, value) in given {
        let name: String = name.extract()?;
        // Arrays, meshes and functions are no options of the table: see `sizes`.
        if name == "size" || name == "background" {
            continue;
        }
        let row = Row::named(&name);
        let row = row.ok_or_else(|| PyTypeError::new_err(format!("there is no option {name}")))?;
        row.set(&mut options, value_of(row, &value)?);
    }
    Ok(options)
}

fn value_of(row: &Row, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    Ok(match row.kind {
        Kind::Number { .. } => Value::Number(number(row.name, value)?),
        Kind::Whole(largest) => match whole(row.name, value, largest)? {
            number if number <= largest => Value::Whole(number),
            _ => {
                let message = format!("{} is {value}; it must be 0 to {largest}", row.name);
                return Err(invalid(value.py(), message));
            }
        },
        Kind::Switch => Value::Switch(value.is_truthy()?),
        Kind::Words(words) => {
            let words: Vec<_> = words.iter().map(|word| word.word).zip(0..).collect();
            Value::Word(choice(row.name, value, &words)?)
        }
    })
}

/// Returns options by keyword, with the words of Python for their values.
pub fn by_keyword<'py>(py: Python<'py>, options: &Options) -> PyResult<Bound<'py, PyDict>> {
    let by_name = PyDict::new(py);
    for row in TABLE {
        match row.get(options) {
            Value::Number(value) => by_name.set_item(row.name, value)?,
            Value::Whole(value) => by_name.set_item(row.name, value)?,
            Value::Switch(value) => by_name.set_item(row.name, value)?,
            value @ Value::Word(_) => {
                by_name.set_item(row.name, row.word(value).map(|word| word.word))?;
            }
        }
    }
    Ok(by_name)
}

/// Returns the value that has a name.
pub fn choice<T: Copy>(name: &str, value: &Bound<'_, PyAny>, names: &[(&str, T)]) -> PyResult<T> {
    let text = value.extract::<String>().ok();
    if let Some((_, found)) = names.iter().find(|(known, _)| Some(*known) == text.as_deref()) {
        return Ok(*found);
    }
    let known: Vec<String> = names.iter().map(|(known, _)| format!("'{known}'")).collect();
    let message = format!("{name} is {}; it must be {}", value.repr()?, known.join(" or "));
    Err(invalid(value.py(), message))
}

/// Returns a double.
pub fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    value.extract().map_err(|_| wrong_type(name, value, "a number"))
}

/// Returns a whole number from 0 to `largest`.
pub fn whole<'py, T>(name: &str, value: &Bound<'py, PyAny>, largest: T) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr> + std::fmt::Display,
{
    value.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyOverflowError>(value.py()) {
            let message = format!("{name} is {value}; it must be 0 to {largest}");
            return invalid(value.py(), message);
        }
        wrong_type(name, value, "a whole number")
    })
}

/// Returns the exception for an argument that is not `wanted`.
pub fn wrong_type(name: &str, value: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "unknown".into(), |name| name.to_string());
    errors::wrong_type(value.py(), format!("{name} is of type {kind}; it must be {wanted}"))
}
