//! Arguments that must be the same on all ranks. They are compared before anything depends on them:
//! ranks that go on with different ones would wait for each other for ever.

use crate::comm::{Communicator, Operation, agreed};
use netmesh::{Error, ErrorKind, Result};
use std::fmt::{Debug, Write};

/// The name of the dimension among arguments, whose disagreement has a status of its own.
const DIMENSION: &str = "dim";

/// Arguments of a collective call under the caller's names, with values as texts: different values
/// have different texts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Arguments {
    entries: Vec<(String, String)>,
}

impl Arguments {
    /// Begins the arguments of a call; `name` is that of the call.
    pub fn of_call(name: &str) -> Self {
        Self::default().and("the call", name)
    }

    /// Adds an argument.
    pub fn and(mut self, name: &str, value: impl ToString) -> Self {
        self.entries.push((name.to_owned(), value.to_string()));
        self
    }

    /// Adds the fields of a struct, and those of structs in it, as they print: no two floats print
    /// alike. `name` makes the caller's name out of a field's. No field can be forgotten.
    pub fn and_fields(mut self, of: &impl Debug, name: impl Fn(&str) -> String) -> Self {
        let before = self.entries.len();
        let is_end = |line: &&str| {
            line.trim_end_matches(',').len() == 1 && line.starts_with([')', '}', ']'])
        };
        let text = format!("{of:#?}");
        for line in text.lines().skip(1).map(str::trim).filter(|line| !is_end(line)) {
            let whole = line.strip_suffix(',').unwrap_or(line);
            match (whole.split_once(": "), self.entries.last_mut()) {
                (Some((field, value)), _) if is_field(field) => {
                    self.entries.push((name(field), value.to_owned()));
                }
                // The rest of a value of several lines.
                (_, Some((_, value))) => value.push_str(line),
                (_, None) => {}
            }
        }
        self.entries[before..].iter_mut().for_each(|(_, value)| *value = in_words(value));
        self
    }

    /// Returns a digest of the arguments (Fowler, Noll and Vo's, of 64 bits).
    fn digest(&self) -> u64 {
        let mut text = String::new();
        for entry in &self.entries {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{entry:?}");
        }
        digest([text.as_bytes()])
    }
}

/// Returns the digest of some bytes.
pub fn digest<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    parts.into_iter().flatten().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Returns an optional value as who gave it knows it.
fn in_words(value: &str) -> String {
    match value.strip_prefix("Some(") {
        Some(inner) => inner.strip_suffix(',').unwrap_or(inner).to_owned(),
        None if value == "None" => "not given".to_owned(),
        None => value.to_owned(),
    }
}

fn is_field(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'_')
}

/// Collective. Refuses arguments that differ between ranks; all ranks answer the same, in the words
/// of the lowest rank that differs from rank 0. `subject`, which may differ, begins the message.
/// `own` makes the arguments, or says what is wrong with them on this rank alone.
///
/// Calls that some ranks may confuse begin with this one, before any other word to each other: only
/// so is it known what the others are at.
///
/// # Errors
/// `InvalidArgument`; `Dimension` where it is `dim` that differs; those of `own`.
pub fn require_same(
    comm: &dyn Communicator,
    subject: &str,
    own: impl FnOnce() -> Result<Arguments>,
) -> Result<()> {
    let own = agreed(comm, own)?;
    let digest = own.digest();
    let (mut least, mut most) = ([digest], [digest]);
    comm.all_reduce_integers(&mut least, Operation::Min)?;
    comm.all_reduce_integers(&mut most, Operation::Max)?;
    if least == most {
        return Ok(());
    }
    let text = own.entries.iter().map(|(_, value)| value.as_str()).collect::<Vec<_>>().join("\0");
    let told = comm.all_gather(if comm.rank() == 0 { text.as_bytes() } else { &[] })?;
    agreed(comm, || {
        let first = String::from_utf8_lossy(&told[0]);
        let firsts = first.split('\0').map(Some).chain(std::iter::repeat(None));
        let differs =
            |(own, first): &(&(String, String), Option<&str>)| Some(own.1.as_str()) != *first;
        match own.entries.iter().zip(firsts).find(differs) {
            None => Ok(()),
            Some((own, first)) => Err(disagreement(subject, own, first.unwrap_or("not given"))),
        }
    })?;
    let message = "arguments are not the same on all ranks";
    Err(Error::invalid(message))
}

fn disagreement(subject: &str, (name, own): &(String, String), first: &str) -> Error {
    let kind = match name.as_str() {
        DIMENSION => ErrorKind::Dimension,
        _ => ErrorKind::InvalidArgument,
    };
    let message = format!(
        "{subject}{name} is {own}, on rank 0 it is {first}; it must be the same on all ranks"
    );
    Error::new(kind, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::threads;
    use netmesh::Options;
    use std::path::Path;

    #[test]
    fn every_field_is_an_argument() {
        #[derive(Debug)]
        #[allow(dead_code)]
        struct Inner {
            seed: u64,
        }
        #[derive(Debug)]
        #[allow(dead_code)]
        struct Outer<'a> {
            input: &'a Path,
            output: Option<&'a str>,
            inner: Inner,
            quiet: bool,
        }
        let outer = |input, output, seed| Outer {
            input: Path::new(input),
            output,
            inner: Inner { seed },
            quiet: false,
        };
        let of =
            |outer: &Outer<'_>| Arguments::default().and_fields(outer, |name| format!("--{name}"));
        let same = of(&outer("a\n b: c,", Some("d: e"), 1));
        assert_eq!(same, of(&outer("a\n b: c,", Some("d: e"), 1)));
        let others = [
            outer("a", Some("d: e"), 1),
            outer("a\n b: c,", None, 1),
            outer("a\n b: c,", Some("d: e"), 2),
        ];
        others.iter().for_each(|other| assert!(of(other).digest() != same.digest(), "{other:?}"));
        let names: Vec<_> = same.entries.iter().map(|(name, _)| name.as_str()).collect();
        let values: Vec<_> = same.entries.iter().map(|(_, value)| value.as_str()).collect();
        assert_eq!(values, ["\"a\\n b: c,\"", "\"d: e\"", "Inner {", "1", "false"]);
        let none = of(&outer("a", None, 1));
        assert_eq!(none.entries[1].1, "not given");
        assert_eq!(names, ["--input", "--output", "--inner", "--seed", "--quiet"]);
        // Bits count, and all fields of the options are there.
        let options = |epsilon| {
            Arguments::default()
                .and_fields(&Options { epsilon, ..Options::default() }, str::to_owned)
        };
        assert!(options(0.1 + 0.2).digest() != options(0.3).digest());
        assert!(options(0.0).digest() != options(-0.0).digest());
        assert!(options(0.0).entries.len() > 20);
    }

    #[test]
    fn the_lowest_rank_that_differs_speaks_for_all() {
        let answers = threads::run(4, |comm| {
            let rank = comm.rank();
            let own = Arguments::of_call("a_call")
                .and("dim", 2)
                .and("options.seed", if rank < 2 { 7 } else { rank });
            require_same(comm, &format!("file {rank}: "), || Ok(own))
                .map_err(|error| error.to_string())
        });
        let expected = "file 2: options.seed is 2, on rank 0 it is 7; it must be the same on all \
            ranks (rank 2)";
        assert_eq!(answers, vec![Err(expected.to_owned()); 4]);
        let answers = threads::run(3, |comm| {
            let own = Arguments::of_call("a_call").and("dim", 2 + comm.rank() / 2);
            require_same(comm, "", || Ok(own)).unwrap_err().kind()
        });
        assert_eq!(answers, [ErrorKind::Dimension; 3]);
        // Another call, with other arguments.
        let answers = threads::run(2, |comm| {
            let own = match comm.rank() {
                0 => Arguments::of_call("one").and("level", 1),
                _ => Arguments::of_call("other").and("path", "a").and("format", 2),
            };
            require_same(comm, "", || Ok(own)).unwrap_err().message().to_owned()
        });
        let expected =
            "the call is other, on rank 0 it is one; it must be the same on all ranks (rank 1)";
        assert_eq!(answers, [expected; 2]);
        let answers =
            threads::run(3, |comm| require_same(comm, "", || Ok(Arguments::of_call("one"))));
        assert_eq!(answers, vec![Ok(()); 3]);
    }
}
