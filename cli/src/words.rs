//! The words of the command line for what the library's messages name.

use netmesh::error::{Choice, Error, Name, Words};
use netmesh::{Algorithm, Criterion, Crossings, Extent, Interior, Output, Region};
use std::fmt::{Formatter, Result};

/// What was given on the command line and in the files that it names.
#[derive(Clone, Copy, Debug)]
pub struct CommandLine<'a> {
    /// The regions and holes of the input.
    pub regions: &'a [Region],
    /// The option that asks for the plain Delaunay triangulation.
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

impl Words for CommandLine<'_> {
    fn write(&self, name: Name, f: &mut Formatter<'_>) -> Result {
        match name {
            Name::Chosen(choice) => f.write_str(self.choice(choice)),
            Name::QualityBound => f.write_str("--bound"),
            Name::Instruments => f.write_str("--stats"),
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
                Some(option) => write!(f, "--{}", option.replace('_', "-")),
                None => write!(f, "{other}"),
            },
        }
    }
}

impl CommandLine<'_> {
    fn choice(&self, choice: Choice) -> &'static str {
        match choice {
            Choice::Output(Output::Auto) => "no --finish",
            Choice::Output(Output::Hierarchical) => "--hierarchical",
            Choice::Output(Output::WellSpaced) => "--finish",
            Choice::Algorithm(Algorithm::Netmesh) => "--algorithm netmesh",
            Choice::Algorithm(Algorithm::Svr) => "--algorithm svr",
            Choice::Algorithm(Algorithm::Delaunay) => self.delaunay,
            Choice::Criterion(Criterion::VoronoiAspect) => "--criterion aspect",
            Choice::Criterion(Criterion::RadiusEdge) => "--criterion radius-edge",
            Choice::Extent(Extent::Auto) => "--extent auto",
            Choice::Extent(Extent::All) => "--extent all",
            Choice::Extent(Extent::Hull) => "--extent hull",
            Choice::Extent(Extent::Box) => "--extent box",
            Choice::Extent(Extent::Boundary) => "--extent boundary",
            Choice::Crossings(Crossings::Refuse) => "--crossings refuse",
            Choice::Crossings(Crossings::Split) => "--crossings split",
            Choice::Interior(Interior::Auto) => "--interior auto",
            Choice::Interior(Interior::Seeds) => "--interior seeds",
            Choice::Interior(Interior::Parity) => "--interior parity",
            Choice::Interior(Interior::Winding) => "--interior winding",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words for one name.
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
