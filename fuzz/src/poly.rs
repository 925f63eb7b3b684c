//! The readers of `.poly`, of `.smesh`, and of surfaces that are read only.

use super::outlines;
use netmesh::io::Format;

/// Checks the bytes as a file.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Checks a file in all formats; returns true if one of the first two accepted it.
pub fn check_text(text: &[u8]) -> bool {
    let accepted = [Format::Poly, Format::Smesh].map(|format| outlines::check_text(format, text));
    for format in [Format::Stl, Format::Obj] {
        outlines::check_surface(format, text);
    }
    accepted.contains(&true)
}
