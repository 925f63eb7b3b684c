//! JSON (RFC 8259), read a piece at a time: whoever reads says what may come, and skips the rest.

use crate::error::{Error, Result};
use crate::io::scanner::{Scanner, Shown, TextPosition};
use std::fmt;
use std::io::BufRead;

/// Largest number of objects and lists inside each other: reading them is recursive.
const MAX_DEPTH: u32 = 100;

pub(super) struct Json<'a> {
    text: Scanner<'a>,
    depth: u32,
}

/// Kind of a value, which its first byte tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Object,
    Array,
    String,
    Number,
    /// `true`, `false`, `null`, and any bytes that are no value.
    Word,
}

impl<'a> Json<'a> {
    pub fn new(input: &'a mut dyn BufRead) -> Result<Self> {
        Ok(Self { text: Scanner::new(input)?, depth: 0 })
    }

    /// Refuses further data.
    pub fn require_end(&mut self) -> Result<()> {
        match self.next_byte()? {
            None => Ok(()),
            Some(_) => Err(self.text.unexpected("the end of the file")),
        }
    }

    /// Returns the position of the next value.
    pub fn place(&mut self) -> Result<TextPosition> {
        self.next_byte()?;
        Ok(self.text.place())
    }

    pub fn kind_of_next(&mut self) -> Result<Kind> {
        Ok(match self.next_byte()? {
            Some(b'{') => Kind::Object,
            Some(b'[') => Kind::Array,
            Some(b'"') => Kind::String,
            Some(b'-' | b'0'..=b'9') => Kind::Number,
            _ => Kind::Word,
        })
    }

    /// Reads an object; `read` is called with the name of each member, and takes its value.
    pub fn object(
        &mut self,
        what: &str,
        mut read: impl FnMut(&mut Self, Name) -> Result<()>,
    ) -> Result<()> {
        self.open(b'{', what)?;
        self.each(b'}', |json| {
            let name = json.string("the name of a member")?;
            json.require(b':', "\":\"")?;
            read(json, name)
        })
    }

    /// Reads a list; `read` takes each element.
    pub fn array(&mut self, what: &str, read: impl FnMut(&mut Self) -> Result<()>) -> Result<()> {
        self.open(b'[', what)?;
        self.each(b']', read)
    }

    fn open(&mut self, bracket: u8, what: &str) -> Result<()> {
        let is_next = self.next_byte()? == Some(bracket);
        if is_next && self.depth == MAX_DEPTH {
            let message = format_args!("more than {MAX_DEPTH} lists and objects in each other");
            return Err(self.text.place().error(message));
        }
        self.depth += 1;
        self.require(bracket, what)
    }

    /// Reads what stands between commas, up to `end`.
    fn each(&mut self, end: u8, mut read: impl FnMut(&mut Self) -> Result<()>) -> Result<()> {
        if self.next_byte()? != Some(end) {
            read(self)?;
            while self.next_is(b',')? {
                read(self)?;
            }
        }
        self.require(end, if end == b'}' { "\",\" or \"}\"" } else { "\",\" or \"]\"" })?;
        self.depth -= 1;
        Ok(())
    }

    /// Reads the characters of a string.
    pub fn string(&mut self, what: &str) -> Result<Name> {
        self.require(b'"', what)?;
        let mut name = Name::default();
        loop {
            let is_plain = |byte| byte >= b' ' && byte != b'"' && byte != b'\\';
            self.text.pass(is_plain, |_, bytes| {
                bytes.iter().for_each(|byte| name.push(*byte));
                Ok(())
            })?;
            match self.text.ahead()? {
                Some(b'"') => break,
                Some(b'\\') => name.push(self.escaped()?),
                _ => return Err(self.text.unexpected("a character or the end of a string")),
            }
        }
        self.text.take()?;
        Ok(name)
    }

    /// Reads the character of an escape; all that are not ASCII look the same here.
    fn escaped(&mut self) -> Result<u8> {
        self.text.take()?;
        let character = match self.text.ahead()? {
            Some(byte @ (b'"' | b'\\' | b'/')) => byte,
            Some(b'b') => 8,
            Some(b'f') => 12,
            Some(b'n') => b'\n',
            Some(b'r') => b'\r',
            Some(b't') => b'\t',
            Some(b'u') => return self.unicode(),
            _ => return Err(self.text.unexpected("one of \"\\/bfnrtu after a backslash")),
        };
        self.text.take()?;
        Ok(character)
    }

    fn unicode(&mut self) -> Result<u8> {
        self.text.take()?;
        let mut code = 0;
        for _ in 0..4 {
            let Some(digit) = self.text.ahead()?.and_then(|byte| (byte as char).to_digit(16))
            else {
                return Err(self.text.unexpected("a hexadecimal digit of a \\u"));
            };
            code = 16 * code + digit;
            self.text.take()?;
        }
        Ok(u8::try_from(code).ok().filter(u8::is_ascii).unwrap_or(0xff))
    }

    /// Reads a coordinate.
    pub fn number(&mut self) -> Result<f64> {
        let place = self.place()?;
        let word = self.text.read_word(is_part_of_word)?;
        if word.is_empty() {
            return Err(self.text.unexpected("a number"));
        }
        let value = place.coordinate(word)?;
        match is_number(word.as_bytes()) {
            true => Ok(value),
            false => Err(place.error(format_args!("{} is not a number of JSON", Shown(word)))),
        }
    }

    /// Returns true if the next value is `null`, which is taken.
    pub fn is_null(&mut self) -> Result<bool> {
        if self.next_byte()? != Some(b'n') {
            return Ok(false);
        }
        self.skip_word()?;
        Ok(true)
    }

    /// Takes a value, whatever it is.
    pub fn skip(&mut self) -> Result<()> {
        match self.kind_of_next()? {
            Kind::Object => self.object("an object", |json, _| json.skip()),
            Kind::Array => self.array("a list", Self::skip),
            Kind::String => self.string("a string").map(drop),
            Kind::Number | Kind::Word => self.skip_word(),
        }
    }

    /// Skips a word of JSON, or one that Python and JavaScript write where they have no number.
    fn skip_word(&mut self) -> Result<()> {
        const WORDS: [&str; 6] = ["true", "false", "null", "NaN", "Infinity", "-Infinity"];
        let place = self.place()?;
        let word = self.text.read_word(is_part_of_word)?;
        if WORDS.contains(&word) || is_number(word.as_bytes()) {
            return Ok(());
        }
        match word {
            "" => Err(self.text.unexpected("a value")),
            word => Err(place.error(format_args!("{} is not a value of JSON", Shown(word)))),
        }
    }

    /// Returns the error of the next value where something else is expected.
    pub fn unexpected(&mut self, expected: &str) -> Error {
        match self.next_byte() {
            Ok(_) => self.text.unexpected(expected),
            Err(error) => error,
        }
    }

    fn require(&mut self, byte: u8, what: impl fmt::Display) -> Result<()> {
        match self.next_is(byte)? {
            true => Ok(()),
            false => Err(self.text.unexpected(what)),
        }
    }

    fn next_is(&mut self, byte: u8) -> Result<bool> {
        self.next_byte()?;
        self.text.next_is(byte)
    }

    /// Returns the next byte that is no blank.
    fn next_byte(&mut self) -> Result<Option<u8>> {
        self.text.pass_over(|byte| matches!(byte, b' ' | b'\t' | b'\n' | b'\r'))?;
        self.text.ahead()
    }
}

fn is_part_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.')
}

/// Returns true for a number of RFC 8259, 6: `-0.5e+3` is one, `.5`, `5.`, `+5` and `05` are none.
fn is_number(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").unwrap_or(word);
    let (mantissa, exponent) = match word.iter().position(|byte| matches!(byte, b'e' | b'E')) {
        Some(at) => (&word[..at], Some(&word[at + 1..])),
        None => (word, None),
    };
    let (whole, fraction) = match mantissa.iter().position(|byte| *byte == b'.') {
        Some(at) => (&mantissa[..at], Some(&mantissa[at + 1..])),
        None => (mantissa, None),
    };
    let are_digits = |digits: &[u8]| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
    let unsigned = |exponent: &[u8]| match exponent {
        [b'+' | b'-', rest @ ..] => are_digits(rest),
        digits => are_digits(digits),
    };
    are_digits(whole)
        && (whole[0] != b'0' || whole.len() == 1)
        && fraction.is_none_or(are_digits)
        && exponent.is_none_or(unsigned)
}

/// The first characters of a string: as many as it takes to tell GeoJSON's names from others.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Name {
    bytes: [u8; 32],
    length: usize,
}

impl Name {
    fn push(&mut self, byte: u8) {
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
            self.length += 1;
        }
    }

    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{}\"", self.as_bytes().escape_ascii())
    }
}
