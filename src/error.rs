//! Errors of fallible calls: a kind that maps one to one to `nm_status`, and a message that names
//! the argument, the index and the rule. A message knows which options it names, so that C, the
//! command line and Python say it in their callers' words.

mod message;
mod name;
mod text;

pub(crate) use message::say;
pub use message::{Message, Words};
pub use name::{Choice, Name};
pub(crate) use text::{message, written};

use crate::options::Extent;
use message::InWords;
use std::fmt::{self, Display};

/// Kinds of failure. The C ABI's `nm_status` has the same values, to which new ones are appended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum ErrorKind {
    NullArgument = 1,
    InvalidArgument = 2,
    NonFinite = 3,
    Dimension = 4,
    Capacity = 5,
    DegenerateInput = 6,
    Limit = 7,
    Cancelled = 8,
    Io = 9,
    Format = 10,
    State = 11,
    OutOfMemory = 12,
    Panic = 13,
}

/// Failure of a call: its kind, and one sentence for a person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    kind: ErrorKind,
    message: Message,
    is_of_content: bool,
    /// Number of the reason, `errno`, if the system gave one.
    system_code: Option<i32>,
}

impl Error {
    pub fn new(kind: ErrorKind, message: impl Into<Message>) -> Self {
        Self { kind, message: message.into(), is_of_content: false, system_code: None }
    }

    /// Returns the error of an argument that is out of its range, or that does not fit others.
    pub fn invalid(message: impl Into<Message>) -> Self {
        Self::new(ErrorKind::InvalidArgument, message)
    }

    /// Returns the error of a hull or box whose inputs are on a line.
    pub(crate) fn without_area(extent: Extent) -> Self {
        let message = say!(
            Choice::Extent(extent),
            " has no area: all inputs are on a line, but for roundings"
        );
        Self::new(ErrorKind::DegenerateInput, message)
    }

    /// Returns the error of a hull or box that doubles are too coarse for.
    pub(crate) fn without_room(extent: Extent) -> Self {
        let message = say!(
            "doubles have no room for the boundary of ",
            Choice::Extent(extent),
            ", on which inputs are too near"
        );
        Self::new(ErrorKind::Limit, message)
    }

    /// Returns the error of a triangle of facets at a point that doubles are too coarse for.
    pub(crate) fn without_room_for_facets(&[x, y, z]: &[f64; 3]) -> Self {
        let message = message!(
            "doubles have no room for a triangle of facets near ({x:?}, {y:?}, {z:?}), which other \
             vertices are within roundings of"
        );
        Self::new(ErrorKind::Limit, message)
    }

    /// Marks a failure as caused by the content of an input: it could be read in its format, but it
    /// cannot be meshed.
    pub fn of_content(self) -> Self {
        Self { is_of_content: true, ..self }
    }

    /// Returns true for a failure that [`Error::of_content`] has marked.
    pub fn is_of_content(&self) -> bool {
        self.is_of_content
    }

    /// Returns the error with the system's number for its reason (`errno`).
    pub fn with_system_code(self, system_code: Option<i32>) -> Self {
        Self { system_code, ..self }
    }

    /// Returns the system's number for the reason (`errno`), if the system gave one.
    pub fn system_code(&self) -> Option<i32> {
        self.system_code
    }

    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// Returns the message in the words of Rust.
    pub fn message(&self) -> &str {
        self.message.text()
    }

    /// Returns the name that the message begins with: the argument or option at fault.
    pub fn subject(&self) -> Option<Name> {
        self.message.subject()
    }

    /// Returns the message with all names in the given words.
    pub fn in_words(&self, words: impl Words) -> impl Display {
        InWords { message: &self.message, words }
    }

    /// Returns the error of a file that breaks the rules of its format.
    pub fn format(message: impl Into<Message>) -> Self {
        Self::new(ErrorKind::Format, message)
    }

    /// Returns the error with `place` and a colon before its message.
    pub(crate) fn within(self, place: &dyn Display) -> Self {
        Self { message: self.message.within(place), ..self }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

impl std::error::Error for Error {}

/// Result of a fallible call of this crate.
pub type Result<T> = std::result::Result<T, Error>;
