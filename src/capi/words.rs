//! Words of C for the things that messages name.

use crate::error::{Choice, Error, Name, Words};
use crate::options::Chosen;
use std::fmt::{Formatter, Result, Write};

/// Words of C: fields of nm_options, and enumerators.
pub struct InC;

/// Returns the message of an error in the words of C.
pub fn in_words_of_c(error: &Error) -> String {
    error.in_words(InC).to_string()
}

impl Words for InC {
    fn write(&self, name: Name, f: &mut Formatter<'_>) -> Result {
        match name {
            Name::Chosen(choice) => write_choice(choice, f),
            Name::Size => f.write_str("options.size"),
            Name::Sizes => f.write_str("nm_mesh_set_sizes"),
            Name::Background => f.write_str("nm_mesh_set_background"),
            Name::SizeAt(at) | Name::BackgroundSizeAt(at) => write!(f, "values[{at}]"),
            Name::Interpolation => f.write_str("interpolation"),
            other => write!(f, "{other}"),
        }
    }
}

fn write_choice(choice: Choice, f: &mut Formatter<'_>) -> Result {
    let Chosen { option, word, .. } = choice.chosen();
    write!(f, "options.{option} = NM_")?;
    let constant = option.chars().chain(['_']).chain(word.word.chars());
    constant.map(|letter| letter.to_ascii_uppercase()).try_for_each(|letter| f.write_char(letter))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::say;
    use crate::options::{Crossings, NetOrdering};

    #[test]
    fn messages_have_fields_and_enumerators() {
        let says = |message| Error::invalid(message).in_words(InC).to_string();
        let crossing = say!("with ", Choice::Crossings(Crossings::Split), " they are split");
        assert_eq!(says(crossing), "with options.crossings = NM_CROSSINGS_SPLIT they are split");
        let ordering = say!(Choice::NetOrdering(NetOrdering::DeterministicNet));
        assert_eq!(says(ordering), "options.ordering = NM_ORDERING_DETERMINISTIC_NET");
        let size = say!(Name::Sizes, " and ", Name::Size, "; ", Name::MaxEdge, " is 1");
        assert_eq!(says(size), "nm_mesh_set_sizes and options.size; options.max_edge is 1");
        assert_eq!(
            says(say!(Name::Seed(2), " is on segments[0]")),
            "regions[2].seed is on segments[0]"
        );
    }
}
