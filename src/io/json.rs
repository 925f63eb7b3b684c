//! JSON, a piece at a time: nothing here holds more than one number.

use super::text::write_number;
use crate::mesh::NONE;
use std::io::{self, Write};

/// Writes a number; `null` for infinity and NaN, which JSON has no numbers for.
pub(super) fn number(out: &mut dyn Write, value: f64) -> io::Result<()> {
    if value.is_finite() { write_number(out, value) } else { out.write_all(b"null") }
}

/// Writes an id; `null` for [`NONE`].
pub(super) fn id(out: &mut dyn Write, id: u32) -> io::Result<()> {
    if id == NONE { out.write_all(b"null") } else { write!(out, "{id}") }
}

/// Writes `[a,b,..]`, each element as `write` writes it.
pub(super) fn list<T>(
    out: &mut dyn Write,
    elements: impl IntoIterator<Item = T>,
    mut write: impl FnMut(&mut dyn Write, T) -> io::Result<()>,
) -> io::Result<()> {
    out.write_all(b"[")?;
    for (index, element) in elements.into_iter().enumerate() {
        if index > 0 {
            out.write_all(b",")?;
        }
        write(out, element)?;
    }
    out.write_all(b"]")
}

/// Writes a list with each element on a line of its own.
pub(super) fn lines<T>(
    out: &mut dyn Write,
    elements: impl IntoIterator<Item = T>,
    mut write: impl FnMut(&mut dyn Write, T) -> io::Result<()>,
) -> io::Result<()> {
    list(out, elements, |out, element| {
        out.write_all(b"\n")?;
        write(out, element)
    })
}

/// Writes a point: the list of its coordinates.
pub(super) fn point(out: &mut dyn Write, point: &[f64]) -> io::Result<()> {
    list(out, point, |out, value| number(out, *value))
}
