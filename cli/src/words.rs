//! Words of the command line for the things that the library's messages name.

use netmesh::error::{Choice, Error, Name, Words};
use netmesh::options::{Chosen, Row};
use netmesh::{Algorithm, Output, Region};
use std::fmt::{Formatter, Result};

/// Names for what was given on the command line and in the files that it names.
#[derive(Clone, Copy, Debug)]
pub struct CommandLine<'a> {
    /// Regions and holes of the input.
    pub regions: &'a [Region],
    /// Option that asks for the plain Delaunay triangulation.
    pub delaunay: &'static str,
}

impl Default for CommandLine<'_> {
    fn default() -> Self {
        Self { regions: &[], delaunay: "--algorithm delaunay" }
    }
}

/// Returns the message of an error that is about nothing but options.
pub fn in_options(error: &Error) -> String {
    error.in_words(CommandLine::default()).to_string()
}

/// Returns the argument of an option, with its dashes.
pub fn argument(option: &str) -> String {
    Row::named(option).map_or_else(String::new, |row| format!("--{}", row.argument()))
}

impl Words for CommandLine<'_> {
    fn write(&self, name: Name, f: &mut Formatter<'_>) -> Result {
        match name {
            Name::Chosen(Choice::Output(Output::Auto)) => f.write_str("no --finish"),
            Name::Chosen(Choice::Output(Output::Hierarchical)) => f.write_str("--hierarchical"),
            Name::Chosen(Choice::Output(Output::WellSpaced)) => f.write_str("--finish"),
            Name::Chosen(Choice::Algorithm(Algorithm::Delaunay)) => f.write_str(self.delaunay),
            Name::Chosen(choice) => {
                let Chosen { option, word, .. } = choice.chosen();
                write!(f, "{} {}", argument(option), word.argument)
            }
            Name::Size | Name::Sizes => f.write_str("--sizes"),
            Name::Background => f.write_str("--background"),
            Name::Columns => f.write_str("--columns"),
            Name::Attributes => f.write_str("--attributes"),
            Name::Seed(number) => {
                let (is_hole, at) = Region::number_among_its_kind(self.regions, number as usize);
                write!(f, "{}[{at}]", if is_hole { "holes" } else { "regions" })
            }
            Name::SizeAt(at) | Name::BackgroundSizeAt(at) => write!(f, "sizes[{at}]"),
            Name::Interpolation => f.write_str("the interpolation"),
            Name::SelectedDomain => f.write_str("the domain"),
            other => match other.option() {
                Some(option) => f.write_str(&argument(option)),
                None => write!(f, "{other}"),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use netmesh::Extent;

    /// Words for one name.
    struct Said<'a>(CommandLine<'a>, Name);

    impl std::fmt::Display for Said<'_> {
        fn fmt(&self, f: &mut Formatter<'_>) -> Result {
            self.0.write(self.1, f)
        }
    }

    #[test]
    fn names_are_those_of_options_and_files() {
        let hole = Region { is_hole: true, ..Region::default() };
        let regions = [Region::default(), hole, hole, Region::default()];
        let words = CommandLine { regions: &regions, delaunay: "--alpha-shape" };
        for (name, expected) in [
            (Name::QualityBound, "--bound"),
            (Name::MaxVertices, "--max-vertices"),
            (Name::Sizes, "--sizes"),
            (Name::Columns, "--columns"),
            (Choice::Output(Output::Hierarchical).into(), "--hierarchical"),
            (Choice::Algorithm(Algorithm::Delaunay).into(), "--alpha-shape"),
            (Choice::Extent(Extent::Hull).into(), "--extent hull"),
            (Name::Seed(0), "regions[0]"),
            (Name::Seed(2), "holes[1]"),
            (Name::Seed(3), "regions[1]"),
            (Name::Seed(9), "regions[9]"),
        ] {
            assert_eq!(Said(words, name).to_string(), expected);
        }
    }
}
