//! Attributes in formats whose columns are single numbers.

use crate::mesh::Attribute;
use std::fmt;

/// The name of one component of an attribute: the attribute's if it has no other, else with the
/// number of the component.
pub(super) struct Scalar<'a>(pub &'a Attribute, pub usize);

impl fmt::Display for Scalar<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(Attribute { name, components, .. }, component) = self;
        match components {
            1 => f.write_str(name),
            _ => write!(f, "{name}_{component}"),
        }
    }
}
