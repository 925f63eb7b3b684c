//! What messages name: options, their values, and other things that a caller has given.

use crate::options::{Algorithm, Criterion, Crossings, Extent, Interior, Output};
use std::fmt::{self, Display, Formatter};

/// Something that the caller has given. C, the command line and Python have words of their own for
/// it; those of Rust are its [`Display`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Name {
    /// An option with the value that the caller has chosen.
    Chosen(Choice),
    QualityBound,
    Epsilon,
    Delta,
    Gamma,
    YieldRadius,
    Encroachment,
    CageScale,
    RootScale,
    MaxVertices,
    DistanceRatio,
    MinAngle,
    MinDihedral,
    MaxEdge,
    Instruments,
    /// The function that tells sizes.
    Size,
    /// Sizes given by values at the inputs.
    Sizes,
    /// Sizes given by values at the vertices of a background.
    Background,
    /// A size at an input, by the number of the input.
    SizeAt(usize),
    /// A size at a vertex of a background.
    BackgroundSizeAt(usize),
    /// How a function goes on between vertices.
    Interpolation,
    /// The point of a region or hole, by its number among all regions.
    Seed(u32),
    /// The columns that are coordinates.
    Columns,
    /// The columns that are attributes.
    Attributes,
    /// The domain of a selection.
    SelectedDomain,
}

/// An option that has words for values, with one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    Output(Output),
    Algorithm(Algorithm),
    Criterion(Criterion),
    Extent(Extent),
    Crossings(Crossings),
    Interior(Interior),
}

impl From<Choice> for Name {
    fn from(choice: Choice) -> Self {
        Self::Chosen(choice)
    }
}

impl Name {
    /// Returns the name of the option, as C, Rust and Python have it; `None` for what is no option,
    /// or one whose values have words.
    pub fn option(self) -> Option<&'static str> {
        Some(match self {
            Self::QualityBound => "quality_bound",
            Self::Epsilon => "epsilon",
            Self::Delta => "delta",
            Self::Gamma => "gamma",
            Self::YieldRadius => "yield_radius",
            Self::Encroachment => "encroachment",
            Self::CageScale => "cage_scale",
            Self::RootScale => "root_scale",
            Self::MaxVertices => "max_vertices",
            Self::DistanceRatio => "distance_ratio",
            Self::MinAngle => "min_angle",
            Self::MinDihedral => "min_dihedral",
            Self::MaxEdge => "max_edge",
            Self::Instruments => "instruments",
            Self::Chosen(_)
            | Self::Size
            | Self::Sizes
            | Self::Background
            | Self::SizeAt(_)
            | Self::BackgroundSizeAt(_)
            | Self::Interpolation
            | Self::Seed(_)
            | Self::Columns
            | Self::Attributes
            | Self::SelectedDomain => return None,
        })
    }
}

/// The words of Rust.
impl Display for Name {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Chosen(choice) => write!(f, "{choice}"),
            Self::Size => f.write_str("size"),
            Self::Sizes => f.write_str("Mesh::set_sizes"),
            Self::Background => f.write_str("Mesh::set_background"),
            Self::SizeAt(at) | Self::BackgroundSizeAt(at) => write!(f, "sizes[{at}]"),
            Self::Interpolation => f.write_str("method.interpolation"),
            Self::Seed(number) => write!(f, "regions[{number}].seed"),
            Self::Columns => f.write_str("columns"),
            Self::Attributes => f.write_str("attributes"),
            Self::SelectedDomain => f.write_str("selection.domain"),
            _ => write!(f, "options.{}", self.option().unwrap_or_default()),
        }
    }
}

/// The words of Rust.
impl Display for Choice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Output(value) => write!(f, "options.output = Output::{value:?}"),
            Self::Algorithm(value) => write!(f, "options.algorithm = Algorithm::{value:?}"),
            Self::Criterion(value) => write!(f, "options.criterion = Criterion::{value:?}"),
            Self::Extent(value) => write!(f, "options.extent = Extent::{value:?}"),
            Self::Crossings(value) => write!(f, "options.crossings = Crossings::{value:?}"),
            Self::Interior(value) => write!(f, "options.interior = Interior::{value:?}"),
        }
    }
}
