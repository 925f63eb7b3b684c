//! What a fallible call answers: a kind that maps one to one to `nm_status`, and a message that
//! names the argument, the index and the rule.

use std::borrow::Cow;
use std::fmt::{self, Write};

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
    /// The system's number for the reason, where the system gave one.
    system_code: Option<i32>,
}

impl Error {
    pub fn new(kind: ErrorKind, message: impl Into<Cow<'static, str>>) -> Self {
        Self { kind, message: message.into(), system_code: None }
    }

    /// Returns the same error with the system's number for its reason (`errno`).
    pub fn with_system_code(self, system_code: Option<i32>) -> Self {
        Self { system_code, ..self }
    }

    /// Returns the system's number for the reason (`errno`), where the system gave one.
    pub fn system_code(&self) -> Option<i32> {
        self.system_code
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

/// `format!` for messages: where memory runs out the message ends, not the process.
macro_rules! message {
    ($($argument:tt)*) => {
        $crate::error::written(format_args!($($argument)*))
    };
}
pub(crate) use message;

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
