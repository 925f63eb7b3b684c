//! Exit codes: a script learns from the number alone whose turn it is, the caller's, the data's or
//! the machine's. `docs/command_line.md` and `--help` say the same; values are append only.

use crate::words::{CommandLine, in_options};
use netmesh::error::{Name, Words};
use netmesh::{Error, ErrorKind};

/// Why the program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum ExitCode {
    Success = 0,
    /// Anything without a code of its own; a defect of the program.
    Other = 1,
    /// A wrong argument: unknown option or format, value out of range, an output that is the input.
    /// clap exits with 2 too.
    Usage = 2,
    /// The input is missing, unreadable, ragged or not numbers.
    InputUnreadable = 3,
    /// The input was read and cannot be meshed: non-finite, degenerate, dimension out of range,
    /// segments, facets and regions that no mesh has, a surface in a format that is not read.
    InputRefused = 4,
    /// A limit was reached: `--max-vertices`, 32-bit ids, memory, the largest double.
    Limit = 5,
    Cancelled = 6,
    /// `--validate` found a violation. The mesh has been written, for inspection.
    CertificateViolated = 7,
    /// The output cannot be written. No part of it is left behind.
    OutputNotWritable = 8,
}

/// The part of `--help` that documents the codes.
pub const HELP: &str = "\
Exit codes:
  0  the mesh was made (and written, and certified, if asked for)
  1  anything that has no code of its own
  2  wrong usage: unknown option, format or column, value out of range, an
     output that would replace the input (see --force)
  3  input missing, unreadable or malformed
  4  input refused: non-finite coordinate, fewer than two distinct points,
     dimension other than 2 to 8, lower affine rank with --algorithm delaunay,
     segments, facets or seeds that no mesh can have, surfaces as .3mf or .gltf,
     sizes that are none
  5  limit reached: --max-vertices, 32-bit ids, memory, or points so far
     apart (above about 2e307) that the cage around them leaves the doubles
  6  cancelled
  7  --validate found a violation; the mesh was still written
  8  output not writable; nothing is left behind";

/// A failure on its way to the user: one sentence and the code to exit with.
#[derive(Debug)]
pub struct Failure {
    pub code: ExitCode,
    pub message: String,
}

impl Failure {
    pub fn new(code: ExitCode, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }

    /// Returns a failure to mesh what `path` holds, in the words of what was given: where no option
    /// is to blame, the input is.
    pub fn of_run(path: &str, error: &Error, words: impl Words) -> Self {
        let message = error.in_words(words).to_string();
        match error.kind() {
            ErrorKind::InvalidArgument if !error.subject().is_some_and(is_option) => {
                Self::new(ExitCode::InputRefused, named(path, message))
            }
            kind => Self::new(code_of(kind), message),
        }
    }

    /// Returns a failure to read `path`.
    pub fn reading(path: &str, error: &Error) -> Self {
        Self::reading_in(path, error, CommandLine::default())
    }

    /// Returns a failure to read `path`, in words for what it has.
    pub fn reading_in(path: &str, error: &Error, words: impl Words) -> Self {
        let code = match error.kind() {
            ErrorKind::Format | ErrorKind::InvalidArgument if error.is_of_content() => {
                ExitCode::InputRefused
            }
            ErrorKind::Io | ErrorKind::Format => ExitCode::InputUnreadable,
            _ => code_of(error.kind()),
        };
        Self::new(code, named(path, error.in_words(words).to_string()))
    }

    /// Returns a failure to use what `path` holds beside the input: a value that is out of range is
    /// one of the file.
    pub fn using(path: &str, error: &Error) -> Self {
        let reading = Self::reading(path, error);
        match reading.code {
            ExitCode::Usage => Self { code: ExitCode::InputRefused, ..reading },
            _ => reading,
        }
    }

    /// Returns a failure to write `path`.
    pub fn writing(path: &str, error: &Error) -> Self {
        let code = match error.kind() {
            ErrorKind::Io => ExitCode::OutputNotWritable,
            _ => code_of(error.kind()),
        };
        Self::new(code, at_path(path, error))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::new(code_of(error.kind()), in_options(&error))
    }
}

fn at_path(path: &str, error: &Error) -> String {
    named(path, in_options(error))
}

/// Names the file, unless the message does so already.
fn named(path: &str, message: String) -> String {
    match message.contains(path) {
        true => message,
        false => format!("{path}: {message}"),
    }
}

/// Returns true for what is given on the command line, and false for what files say.
fn is_option(name: Name) -> bool {
    let is_size = matches!(name, Name::SizeAt(_) | Name::BackgroundSizeAt(_));
    let is_feature = matches!(name, Name::Facet(_) | Name::Triangle(_) | Name::Segment(_));
    !(is_size || is_feature || matches!(name, Name::Seed(_) | Name::Input(_)))
}

fn code_of(kind: ErrorKind) -> ExitCode {
    match kind {
        ErrorKind::InvalidArgument => ExitCode::Usage,
        ErrorKind::NonFinite | ErrorKind::Dimension | ErrorKind::DegenerateInput => {
            ExitCode::InputRefused
        }
        ErrorKind::Capacity | ErrorKind::Limit | ErrorKind::OutOfMemory => ExitCode::Limit,
        ErrorKind::Cancelled => ExitCode::Cancelled,
        ErrorKind::NullArgument
        | ErrorKind::Io
        | ErrorKind::Format
        | ErrorKind::State
        | ErrorKind::Panic => ExitCode::Other,
    }
}
