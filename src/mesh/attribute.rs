//! Values of points under names.

use crate::error::{Error, ErrorKind, Result, message};

/// Values that belong to points, under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// See [`Attribute::check_name`].
    pub name: String,
    pub components: usize,
    /// `points x components`.
    pub values: Vec<f64>,
    /// Whether other vertices than the inputs get values too; else NaN.
    pub is_extended: bool,
}

/// The longest name of an attribute.
const NAME_BYTES: usize = 64;

/// Names that files have for something else, beside `x0`, `x1` and so on.
const RESERVED: [&str; 13] = [
    "x",
    "y",
    "z",
    "points",
    "kind",
    "domain",
    "input",
    "precision_limited",
    "aspect",
    "cell_domain",
    "radius_edge",
    "below_min_dihedral",
    "beyond_bound",
];

impl Attribute {
    /// The values of a point.
    pub fn of(&self, point: usize) -> &[f64] {
        &self.values[point * self.components..][..self.components]
    }

    /// Refuses a name that an attribute cannot have.
    ///
    /// # Errors
    /// `InvalidArgument`: it must be 1 to 64 ASCII letters, digits, `_`, `-` and `.`, and none that
    /// files have for something else.
    pub fn check_name(name: &str) -> Result<()> {
        match rule_against(name) {
            None => Ok(()),
            Some(rule) => {
                let message = message!("name is '{name}'; {rule}");
                Err(Error::new(ErrorKind::InvalidArgument, message))
            }
        }
    }
}

/// The rule that a name breaks.
pub(crate) fn rule_against(name: &str) -> Option<&'static str> {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "_-.".contains(letter);
    if name.is_empty() || name.len() > NAME_BYTES || !name.chars().all(is_plain) {
        return Some("it must be 1 to 64 ASCII letters, digits, '_', '-' and '.'");
    }
    let is_axis = name
        .strip_prefix('x')
        .is_some_and(|rest| !rest.is_empty() && rest.chars().all(|digit| digit.is_ascii_digit()));
    (is_axis || RESERVED.contains(&name)).then_some("files have that name for something else")
}
