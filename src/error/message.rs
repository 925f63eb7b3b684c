//! Messages that know which things they name, so that each interface of the library can say them in
//! its callers' words.

use super::Name;
use super::text::Text;
use std::borrow::Cow;
use std::fmt::{self, Display, Formatter, Write};

/// Words of one interface of the library for the things that messages name.
pub trait Words {
    /// Writes the caller's word for `name`.
    ///
    /// # Errors
    /// Errors of the formatter.
    fn write(&self, name: Name, f: &mut Formatter<'_>) -> fmt::Result;
}

/// Sentence in the words of Rust, with the positions of the names in it. It ends early if memory
/// runs out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Message {
    text: Cow<'static, str>,
    /// Names in the sentence, in their order.
    names: Vec<Place>,
}

/// Name in a message, with the range of its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    start: usize,
    end: usize,
    name: Name,
}

impl Message {
    /// Returns the message that begins with a name and goes on with `rest`.
    pub fn about(name: impl Into<Name>, rest: impl Display) -> Self {
        let mut message = Self::default();
        message.add_name(name.into());
        message.add_text(format_args!("{rest}"));
        message
    }

    /// Appends text.
    pub(crate) fn add_text(&mut self, arguments: fmt::Arguments<'_>) {
        let mut text = Text(std::mem::take(&mut self.text).into_owned());
        // Cut off where memory ran out; the error's kind says the rest.
        let _ = text.write_fmt(arguments);
        self.text = text.0.into();
    }

    /// Appends a name.
    pub(crate) fn add_name(&mut self, name: Name) {
        let start = self.text.len();
        self.add_text(format_args!("{name}"));
        if self.names.try_reserve(1).is_ok() {
            self.names.push(Place { start, end: self.text.len(), name });
        }
    }

    /// Returns the message with `place` and a colon before it.
    pub(super) fn within(self, place: &dyn Display) -> Self {
        let mut within = Self::default();
        within.add_text(format_args!("{place}: "));
        let shift = within.text.len();
        within.add_text(format_args!("{}", self.text));
        let shifted = |place: &Place| {
            let Place { start, end, name } = *place;
            Place { start: start + shift, end: end + shift, name }
        };
        within.names = self.names;
        within.names.iter_mut().for_each(|place| *place = shifted(place));
        within
    }

    /// Returns the name that the message begins with; `None` if it begins otherwise.
    pub(super) fn subject(&self) -> Option<Name> {
        self.names.first().filter(|place| place.start == 0).map(|place| place.name)
    }

    /// Returns the message in the words of Rust.
    pub(super) fn text(&self) -> &str {
        &self.text
    }
}

impl<T: Into<Cow<'static, str>>> From<T> for Message {
    fn from(text: T) -> Self {
        Self { text: text.into(), names: Vec::new() }
    }
}

/// Message to be written in the words of another interface.
pub(super) struct InWords<'a, W> {
    pub message: &'a Message,
    pub words: W,
}

impl<W: Words> Display for InWords<'_, W> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Message { text, names } = self.message;
        let mut end = 0;
        for place in names {
            // A message that was truncated ends before its last names.
            f.write_str(text.get(end..place.start).unwrap_or_default())?;
            self.words.write(place.name, f)?;
            end = place.end;
        }
        f.write_str(text.get(end..).unwrap_or_default())
    }
}

/// Makes a [`Message`] of parts separated by commas: literals are texts with format arguments in
/// them, all others are names.
macro_rules! say {
    (@ $message:ident) => {};
    (@ $message:ident $text:literal $(, $($rest:tt)*)?) => {
        $message.add_text(format_args!($text));
        $($crate::error::say!(@ $message $($rest)*);)?
    };
    (@ $message:ident $name:expr $(, $($rest:tt)*)?) => {
        $message.add_name($crate::error::Name::from($name));
        $($crate::error::say!(@ $message $($rest)*);)?
    };
    ($($parts:tt)*) => {{
        let mut message = $crate::error::Message::default();
        $crate::error::say!(@ message $($parts)*);
        message
    }};
}
pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::super::{Choice, Error, ErrorKind};
    use super::*;
    use crate::options::Extent;

    /// Words for tests, unlike those of Rust.
    struct Shouted;

    impl Words for Shouted {
        fn write(&self, name: Name, f: &mut Formatter<'_>) -> fmt::Result {
            match name {
                Name::MaxEdge => f.write_str("EDGE"),
                Name::Chosen(Choice::Extent(_)) => f.write_str("EXTENT"),
                _ => f.write_str("?"),
            }
        }
    }

    #[test]
    fn names_are_told_apart_from_text() {
        let given = 0.5;
        let extent = Choice::Extent(Extent::Box);
        let message = say!(Name::MaxEdge, " is {given}; options.max_edge and ", extent, "!");
        let error = Error::new(ErrorKind::InvalidArgument, message);
        let rust = "options.max_edge is 0.5; options.max_edge and options.extent = Extent::Box!";
        assert_eq!(error.message(), rust);
        let shouted = "EDGE is 0.5; options.max_edge and EXTENT!";
        assert_eq!(error.in_words(Shouted).to_string(), shouted);
        assert_eq!(error.subject(), Some(Name::MaxEdge));
        let error = error.within(&"file é");
        assert_eq!(error.subject(), None);
        assert_eq!(error.message(), format!("file é: {rust}"));
        assert_eq!(error.in_words(Shouted).to_string(), format!("file é: {shouted}"));
        let plain = Error::new(ErrorKind::Io, "nothing has a name");
        assert_eq!(plain.subject(), None);
        assert_eq!(plain.in_words(Shouted).to_string(), plain.message());
    }
}
