//! What a fallible call answers: a kind that maps one to one to `nm_status`, and a message that
//! names the argument, the index and the rule.

use std::borrow::Cow;
use std::fmt::{self, Write};

/// `format!` for messages: where memory runs out the message ends, not the process.
macro_rules! message {
    ($($argument:tt)*) => {
        $crate::error::written(format_args!($($argument)*))
    };
}
pub(crate) use message;

/// The kinds of failure. The C ABI's `nm_status` carries the same values (append only).
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

/// A failure: its kind and one sentence for a person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    kind: ErrorKind,
    message: Cow<'static, str>,
    is_of_content: bool,
}

impl Error {
    pub fn new(kind: ErrorKind, message: impl Into<Cow<'static, str>>) -> Self {
        Self { kind, message: message.into(), is_of_content: false }
    }

    /// Marks a failure as one of what an input says: it could be read as what it is, and what it
    /// says cannot be meshed.
    pub fn of_content(self) -> Self {
        Self { is_of_content: true, ..self }
    }

    /// Returns true for a failure that [`Error::of_content`] has marked.
    pub fn is_of_content(&self) -> bool {
        self.is_of_content
    }

    /// Puts the name of a file before the message.
    pub(crate) fn in_file(self, path: &std::path::Path) -> Self {
        let message = message!("{}: {}", path.display(), self.message);
        Self { message: message.into(), ..self }
    }

    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// What [`message!`] stands for.
pub(crate) fn written(arguments: fmt::Arguments<'_>) -> String {
    let mut text = Text(String::new());
    // Cut off where memory ran out; the error's kind says the rest.
    let _ = text.write_fmt(arguments);
    text.0
}

/// A string that refuses to grow where `String` ends the process.
struct Text(String);

impl Write for Text {
    fn write_str(&mut self, piece: &str) -> fmt::Result {
        self.0.try_reserve(piece.len()).map_err(|_| fmt::Error)?;
        self.0.push_str(piece);
        Ok(())
    }
}

/// Shorthand for results of this crate.
pub type Result<T> = std::result::Result<T, Error>;
