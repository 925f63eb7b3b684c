//! The words of C for what messages name.

use super::enums::{
    nm_algorithm, nm_criterion, nm_crossings, nm_extent, nm_gives_way, nm_interior, nm_ordering,
    nm_output,
};
use crate::error::{Choice, Error, Name, Words};
use crate::options::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Output,
};
use std::fmt::{Formatter, Result};

/// C: fields of nm_options, and enumerators.
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
    match choice {
        Choice::Output(value) => write!(f, "options.output = {:?}", nm_output::from(value)),
        Choice::Algorithm(value) => {
            write!(f, "options.algorithm = {:?}", nm_algorithm::from(value))
        }
        Choice::Criterion(value) => {
            write!(f, "options.criterion = {:?}", nm_criterion::from(value))
        }
        Choice::Extent(value) => write!(f, "options.extent = {:?}", nm_extent::from(value)),
        Choice::Crossings(value) => {
            write!(f, "options.crossings = {:?}", nm_crossings::from(value))
        }
        Choice::Interior(value) => write!(f, "options.interior = {:?}", nm_interior::from(value)),
    }
}

impl From<Output> for nm_output {
    fn from(output: Output) -> Self {
        match output {
            Output::Auto => Self::NM_OUTPUT_AUTO,
            Output::Hierarchical => Self::NM_OUTPUT_HIERARCHICAL,
            Output::WellSpaced => Self::NM_OUTPUT_WELL_SPACED,
        }
    }
}

impl From<Algorithm> for nm_algorithm {
    fn from(algorithm: Algorithm) -> Self {
        match algorithm {
            Algorithm::Netmesh => Self::NM_ALGORITHM_NETMESH,
            Algorithm::Svr => Self::NM_ALGORITHM_SVR,
            Algorithm::Delaunay => Self::NM_ALGORITHM_DELAUNAY,
        }
    }
}

impl From<NetOrdering> for nm_ordering {
    fn from(ordering: NetOrdering) -> Self {
        match ordering {
            NetOrdering::SampledNet => Self::NM_ORDERING_SAMPLED_NET,
            NetOrdering::DeterministicNet => Self::NM_ORDERING_DETERMINISTIC_NET,
        }
    }
}

impl From<Criterion> for nm_criterion {
    fn from(criterion: Criterion) -> Self {
        match criterion {
            Criterion::VoronoiAspect => Self::NM_CRITERION_VORONOI_ASPECT,
            Criterion::RadiusEdge => Self::NM_CRITERION_RADIUS_EDGE,
        }
    }
}

impl From<GivesWay> for nm_gives_way {
    fn from(gives_way: GivesWay) -> Self {
        match gives_way {
            GivesWay::Angle => Self::NM_GIVES_WAY_ANGLE,
            GivesWay::Bound => Self::NM_GIVES_WAY_BOUND,
        }
    }
}

impl From<Extent> for nm_extent {
    fn from(extent: Extent) -> Self {
        match extent {
            Extent::Auto => Self::NM_EXTENT_AUTO,
            Extent::All => Self::NM_EXTENT_ALL,
            Extent::Hull => Self::NM_EXTENT_HULL,
            Extent::Box => Self::NM_EXTENT_BOX,
            Extent::Boundary => Self::NM_EXTENT_BOUNDARY,
        }
    }
}

impl From<Crossings> for nm_crossings {
    fn from(crossings: Crossings) -> Self {
        match crossings {
            Crossings::Refuse => Self::NM_CROSSINGS_REFUSE,
            Crossings::Split => Self::NM_CROSSINGS_SPLIT,
        }
    }
}

impl From<Interior> for nm_interior {
    fn from(interior: Interior) -> Self {
        match interior {
            Interior::Auto => Self::NM_INTERIOR_AUTO,
            Interior::Seeds => Self::NM_INTERIOR_SEEDS,
            Interior::Parity => Self::NM_INTERIOR_PARITY,
            Interior::Winding => Self::NM_INTERIOR_WINDING,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::{ErrorKind, say};

    #[test]
    fn messages_have_fields_and_enumerators() {
        let says =
            |message| Error::new(ErrorKind::InvalidArgument, message).in_words(InC).to_string();
        let crossing = say!("with ", Choice::Crossings(Crossings::Split), " they are split");
        assert_eq!(says(crossing), "with options.crossings = NM_CROSSINGS_SPLIT they are split");
        let size = say!(Name::Sizes, " and ", Name::Size, "; ", Name::MaxEdge, " is 1");
        assert_eq!(says(size), "nm_mesh_set_sizes and options.size; options.max_edge is 1");
        assert_eq!(
            says(say!(Name::Seed(2), " is on segments[0]")),
            "regions[2].seed is on segments[0]"
        );
    }
}
