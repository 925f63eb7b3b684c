//! Names in messages: options, their values, and other things that a caller has given.

use crate::options::{Algorithm, Criterion, Crossings, Extent, Interior, Output};
use std::fmt::{self, Display, Formatter};

/// Thing that the caller has given. C, the command line and Python have their own words for it;
/// Rust's are its [`Display`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Name {
    /// Option with the value that the caller has chosen.
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
    /// Function that gives sizes.
    Size,
    /// Sizes given by values at the inputs.
    Sizes,
    /// Sizes given by values at the vertices of a background.
    Background,
    /// Size at an input, by the number of the input.
    SizeAt(usize),
    /// Size at a vertex of a background, by the number of the vertex.
    BackgroundSizeAt(usize),
    /// Choice of how values are interpolated between vertices.
    Interpolation,
    /// Seed point of a region or hole, by its number among all regions.
    Seed(u32),
    /// Columns that are coordinates.
    Columns,
    /// Columns that are attributes.
    Attributes,
    /// Domain of a selection.
    SelectedDomain,
}

/// Option whose values have names, with one of them.
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
    /// Returns the option's name in C, Rust and Python; `None` for a name that is no option, or an
    /// option whose values have names.
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

/// Names in the words of Rust.
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

/// Options and values in the words of Rust.
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
