//! Named values of points.

use crate::error::{Error, ErrorKind, Result, message};

/// Named values of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name of the values, which fulfils [`Attribute::check_name`].
    pub name: String,
    pub components: usize,
    /// Values, `points x components`.
    pub values: Vec<f64>,
    /// True if values are extended to vertices that are no inputs; else they are NaN there.
    pub is_extended: bool,
}

/// Largest length of a name, in bytes.
const NAME_BYTES: usize = 64;

/// Names that files use for something else, beside `x0`, `x1` and so on.
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
    /// Returns the values of a point.
    pub fn of(&self, point: usize) -> &[f64] {
        &self.values[point * self.components..][..self.components]
    }

    /// Fails for a name that an attribute cannot have.
    ///
    /// # Errors
    /// `InvalidArgument`: the name is not 1 to 64 ASCII letters, digits, `_`, `-` and `.`, or files
    /// use it for something else.
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

/// Returns the rule that a name breaks; `None` for a valid name.
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
