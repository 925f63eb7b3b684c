//! The table of options. From its rows come [`super::Options`] and its defaults, the ranges that
//! are enforced, the fields of `nm_options`, the arguments of both programs, Python's keywords and
//! the tables of `docs/options.md`. CONTRIBUTING.md tells what a new row needs.

use super::Options;
use super::choices::{
    Algorithm, Choice, Choices, Criterion, Crossings, Extent, GivesWay, Interior, Labels,
    NetOrdering, Output,
};

/// Calls the macro `$then` with the rows of the table, in the order of `nm_options`.
///
/// A row begins with the option's name among [`crate::error::Name`] and the field of
/// [`super::Options`]. `on_ranks` tells whether meshes of several ranks have the option. In `help`
/// names of options stand between backticks; each way into the library puts its own names there.
macro_rules! each_option {
    ($then:ident) => {
        $then! {
            Criterion criterion: Criterion {
                default: Criterion::VoronoiAspect, group: Quality, on_ranks: true,
                kind: words::<Criterion>(),
                help: "Quality measure that `quality_bound` bounds.",
            }
            QualityBound quality_bound: f64 {
                default: 0.0, group: Quality, on_ranks: true,
                kind: number("X", &[
                    by_dimension([3.0, 4.0, 5.0, 6.0], [2.2, 2.5, 3.5, 4.5], 100.0),
                    by_dimension([1.5, 2.0, 2.5, 3.0], [0.9, 1.1, 1.75, 2.25], 50.0),
                ]),
                help: "Largest value of `criterion`: a smaller one makes better cells and more of \
them.",
            }
            MinAngle min_angle: f64 {
                default: 0.0, group: Quality, on_ranks: true,
                // Within the range of the radius-edge ratio.
                kind: number("DEGREES", &[constant(0.0, 0.6, 33.7)]),
                help: "Smallest angle of the triangles in degrees, in 2D, in place of `criterion` \
and `quality_bound`. Above 30 the run usually ends; give `max_vertices`, too. \
Triangles beside the cages of a hierarchical mesh may miss it.",
            }
            MinDihedral min_dihedral: f64 {
                default: 0.0, group: Quality, on_ranks: false,
                // Beyond about 20 most meshes keep some smaller angles.
                kind: number("DEGREES", &[constant(0.0, 0.0, 22.0)]),
                help: "Least dihedral angle in degrees, in 3D, of tetrahedra with all vertices in \
one domain: Steiner points move and further ones come until no angle is \
smaller. Not with `distance_ratio`.",
            }
            GivesWay gives_way: GivesWay {
                default: GivesWay::Angle, group: Quality, on_ranks: true,
                kind: words::<GivesWay>(),
                help: "Promise that gives way where `min_dihedral` and `quality_bound` cannot \
both be kept; what misses it is counted.",
            }
            Extent extent: Extent {
                default: Extent::Auto, group: Domain, on_ranks: false,
                kind: words::<Extent>(),
                help: "Region that the mesh covers; what lies beyond is cut away. Above 3D auto or \
all.",
            }
            Interior interior: Interior {
                default: Interior::Auto, group: Domain, on_ranks: false,
                kind: words::<Interior>(),
                help: "Rule by which regions between segments, in 3D between facets, are inside, \
where `extent` is auto or boundary; seeds may make holes of them.",
            }
            Crossings crossings: Crossings {
                default: Crossings::Refuse, group: Domain, on_ranks: false,
                kind: words::<Crossings>(),
                help: "Treatment of segments, in 3D of facets too, that cross where no input is.",
            }
            Coplanar coplanar: f64 {
                default: 0.0, group: Domain, on_ranks: false,
                // Beyond that a surface that is meant to be round would become flat.
                kind: number("DEGREES", &[constant(0.0, 0.0, 10.0)]),
                help: "Angle from flat in degrees, in 3D, up to which triangles of a surface that \
share an edge and have one marker are one facet, and facets may be bent; by default only as far as \
roundings explain.",
            }
            Labels labels: Labels {
                default: Labels::Seeds, group: Domain, on_ranks: false,
                kind: words::<Labels>(),
                help: "Labels of the regions that segments, in 3D facets, separate.",
            }
            MaxEdge max_edge: f64 {
                default: 0.0, group: Sizes, on_ranks: false,
                kind: number("LENGTH", &[constant(0.0, 0.0, f64::INFINITY)]),
                help: "Length that no edge exceeds of simplices that meet the box of the inputs. \
Not in hierarchical meshes.",
            }
            SizeFromCurvature size_from_curvature: f64 {
                default: 0.0, group: Sizes, on_ranks: false,
                kind: number("ERROR", &[constant(0.0, 0.0, f64::INFINITY)]),
                help: "Largest distance, in 3D, of an edge's middle from the round surface that \
facets approximate; nothing is round where these bend by more than 50 degrees. Not in hierarchical \
meshes.",
            }
            DistanceRatio distance_ratio: f64 {
                default: 0.0, group: Sizes, on_ranks: false,
                kind: number("X", &[constant(0.0, 0.05, 1.0)]),
                help: "Largest reach of a cell, relative to the distance from its vertex to the \
nearest input, unless that input is the nearest one everywhere in the cell; \
for filtrations of the mesh. Not in hierarchical meshes.",
            }
            Output output: Output {
                default: Output::Auto, group: Algorithm, on_ranks: true,
                kind: words::<Output>(),
                help: "Kind of mesh that the run leaves behind.",
            }
            Algorithm algorithm: Algorithm {
                default: Algorithm::Netmesh, group: Algorithm, on_ranks: false,
                kind: words::<Algorithm>(),
                help: "Algorithm that makes the mesh.",
            }
            Threads threads: u32 {
                default: 1, group: Run, on_ranks: true,
                kind: Kind::Whole(u32::MAX as u64),
                help: "Number of threads, 0 for all cores; the mesh does not depend on it. Of use \
in 2D and 3D from 524,288 distinct inputs on, for the Delaunay triangulation of \
inputs in 3D from 20,000 on.",
            }
            Instruments instruments: bool {
                default: false, group: Run, on_ranks: false,
                kind: Kind::Switch,
                help: "Measurement of ply, of intersections of D-balls and of the constants of \
the paper's Definitions 7 and 8, which takes about as long again as the run \
or longer. The mesh is the same.",
            }
            RandomSeed seed: u64 {
                default: 0, group: Run, on_ranks: true,
                kind: Kind::Whole(u64::MAX),
                help: "Seed of every random choice: equal inputs, options and seeds make equal \
meshes. Without effect where `ordering` is deterministic.",
            }
            MaxVertices max_vertices: u64 {
                default: 0, group: Run, on_ranks: true,
                kind: Kind::Whole(u64::MAX),
                help: "Number of vertices beyond which the run fails and leaves the mesh as it \
was; 0 for as many as there are ids.",
            }
            Ordering ordering: NetOrdering {
                default: NetOrdering::SampledNet, group: Paper, on_ranks: true,
                kind: words::<NetOrdering>(),
                help: "Choice of the inputs that a round inserts.",
            }
            Epsilon epsilon: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[constant(0.5, 0.05, 0.6)]),
                help: "Separation at which a cluster becomes a domain of its own: a pair at \
distance x gets one of radius x / `epsilon` if no other vertex is near. A \
smaller value makes fewer domains.",
            }
            Delta delta: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[by_dimension([0.8, 1.0, 1.0, 1.0], [0.1; 4], 1.0)]),
                help: "Spacing of a cage's vertices, relative to the radius of its sphere: a \
smaller one makes rounder cages of more vertices.",
            }
            Gamma gamma: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[constant(0.1, 0.01, 0.25)]),
                help: "Radius within which a new cage vertex yields to an input, relative to its \
distance to the nearest vertex.",
            }
            YieldRadius yield_radius: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                // At 1.0 the corner of a D-ball that has inputs always yields, to inputs that are
                // not medial.
                kind: number("X", &[constant(1.0, 0.05, 1.0)]),
                help: "Radius within which a Steiner point yields to an input, relative to the \
radius of its empty ball.",
            }
            Encroachment encroachment: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[constant(1.0, 1.0, 4.0)]),
                help: "Distance that vertices outside a domain keep from its centre, relative to \
its radius over `epsilon`.",
            }
            CageScale cage_scale: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[constant(0.8, 0.3, 0.9)]),
                help: "Radius of a cage's sphere, relative to the radius of its domain; keep it \
clearly above `epsilon`.",
            }
            RootScale root_scale: f64 {
                default: 0.0, group: Paper, on_ranks: true,
                kind: number("X", &[by_dimension([2.5, 2.5, 3.0, 4.0], [2.0; 4], 16.0)]),
                help: "Radius of the root ball, relative to the bounding ball of the inputs.",
            }
        }
    };
}
pub(crate) use each_option;

/// Row of the table: all that is to be known of an option.
pub struct Row {
    /// Name of the field in C, Rust and Python.
    pub name: &'static str,
    /// Name of the value's type in Rust.
    pub type_name: &'static str,
    /// Group of options that people think of together.
    pub group: Group,
    /// Type of the option's value, with its words or its range.
    pub kind: Kind,
    /// True if meshes of several ranks have the option.
    pub on_ranks: bool,
    /// Sentences that explain the option, with names of options between backticks.
    pub help: &'static str,
    pub(super) get: fn(&Options) -> Value,
    pub(super) choice: fn(&Options) -> Option<Choice>,
    pub(super) set: fn(&mut Options, Value) -> bool,
}

/// Groups of options, in the order of `nm_options`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Quality,
    Domain,
    Sizes,
    Algorithm,
    Run,
    Paper,
}

impl Group {
    /// All groups, in the order of `nm_options`.
    pub const ALL: [Self; 6] =
        [Self::Quality, Self::Domain, Self::Sizes, Self::Algorithm, Self::Run, Self::Paper];

    /// Returns the heading of the group in `--help` and in the documents.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Quality => "Quality",
            Self::Domain => "Domain",
            Self::Sizes => "Sizes",
            Self::Algorithm => "Algorithm",
            Self::Run => "Run",
            Self::Paper => "Constants of the paper",
        }
    }
}

/// Type of an option's value.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number, of which 0 is the default.
    Number {
        /// Placeholder of the number in `--help`.
        unit: &'static str,
        /// The only range, or one for each [`Criterion`].
        ranges: &'static [Bounds],
    },
    /// A whole number from 0 to this one.
    Whole(u64),
    /// Off or on.
    Switch,
    /// One of these values, in the order of their numbers in C.
    Words(&'static [Word]),
}

/// Bounds of a number, and its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Default in 2D, 3D, 4D and above; 0 if there is none.
    pub default: [f64; 4],
    /// Smallest number in 2D, 3D, 4D and above.
    pub lowest: [f64; 4],
    /// Largest number, in every dimension.
    pub highest: f64,
}

/// Value that has words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// Name of the value in Rust.
    pub value: &'static str,
    /// Word in Python, and, in capitals, in C's constants.
    pub word: &'static str,
    /// Word on the command line.
    pub argument: &'static str,
    /// Meaning of the value, as the end of a sentence.
    pub help: &'static str,
}

/// Value of any option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    Whole(u64),
    Switch(bool),
    /// Index among the words of the option.
    Word(usize),
}

/// Type of a field of [`Options`].
pub(crate) trait OptionValue: Sized {
    /// Returns the value as one of any option.
    fn to_value(self) -> Value;

    /// Returns the value of a field; `None` if it is of another type or out of the type's range.
    fn from_value(value: Value) -> Option<Self>;

    /// Returns the option with this value, if it has words for its values.
    fn choice(self) -> Option<Choice> {
        None
    }
}

macro_rules! option_values {
    ($($type:ty: $variant:ident)*) => {$(
        impl OptionValue for $type {
            fn to_value(self) -> Value {
                Value::$variant(self.into())
            }

            fn from_value(value: Value) -> Option<Self> {
                let Value::$variant(value) = value else { return None };
                value.try_into().ok()
            }
        }
    )*};
}
option_values! { f64: Number u64: Whole u32: Whole bool: Switch }

const fn words<T: Choices>() -> Kind {
    Kind::Words(T::WORDS)
}

const fn number(unit: &'static str, ranges: &'static [Bounds]) -> Kind {
    Kind::Number { unit, ranges }
}

const fn constant(default: f64, lowest: f64, highest: f64) -> Bounds {
    by_dimension([default; 4], [lowest; 4], highest)
}

const fn by_dimension(default: [f64; 4], lowest: [f64; 4], highest: f64) -> Bounds {
    Bounds { default, lowest, highest }
}

macro_rules! declare_table {
    ($($name:ident $field:ident: $type:ty {
        default: $default:expr, group: $group:ident, on_ranks: $on_ranks:expr,
        kind: $kind:expr, help: $help:literal,
    })*) => {
        /// All options, in the order of `nm_options`.
        pub const TABLE: &[Row] = &[$(Row {
            name: stringify!($field),
            type_name: stringify!($type),
            group: Group::$group,
            kind: $kind,
            on_ranks: $on_ranks,
            help: $help,
            get: |options| options.$field.to_value(),
            choice: |options| options.$field.choice(),
            set: |options, value| {
                OptionValue::from_value(value).map(|value| options.$field = value).is_some()
            },
        },)*];
    };
}
each_option!(declare_table);

impl Row {
    /// Returns the row of an option.
    pub fn named(name: &str) -> Option<&'static Self> {
        TABLE.iter().find(|row| row.name == name)
    }

    /// Returns the option's value among `options`.
    pub fn get(&self, options: &Options) -> Value {
        (self.get)(options)
    }

    /// Returns the option with its value among `options`, if it has words for its values.
    pub fn choice(&self, options: &Options) -> Option<Choice> {
        (self.choice)(options)
    }

    /// Gives the option a value among `options`.
    ///
    /// # Panics
    /// If the value is of another type than the option.
    pub fn set(&self, options: &mut Options, value: Value) {
        assert!((self.set)(options, value), "{} cannot be {value:?}", self.name);
    }

    /// Returns the name of the option's argument on the command line, without dashes.
    pub fn argument(&self) -> String {
        match self.name {
            "quality_bound" => "bound".to_owned(),
            "instruments" => "stats".to_owned(),
            name => name.replace('_', "-"),
        }
    }

    /// Returns true if the values are numbers other than whole ones.
    pub fn is_number(&self) -> bool {
        matches!(self.kind, Kind::Number { .. })
    }

    /// Returns the word for a value of the option, if it has words.
    pub fn word(&self, value: Value) -> Option<&'static Word> {
        match (self.kind, value) {
            (Kind::Words(words), Value::Word(number)) => words.get(number),
            _ => None,
        }
    }
}

impl Bounds {
    /// Returns the default in `dim` dimensions.
    pub fn default_in(&self, dim: usize) -> f64 {
        pick(dim, self.default)
    }

    /// Returns the smallest number in `dim` dimensions.
    pub fn lowest_in(&self, dim: usize) -> f64 {
        pick(dim, self.lowest)
    }
}

/// Returns the number for 2D, 3D, 4D, or everything above.
pub(crate) fn pick(dim: usize, numbers: [f64; 4]) -> f64 {
    numbers[(dim - 2).min(3)]
}
