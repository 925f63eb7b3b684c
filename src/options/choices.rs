//! Values of options that have words. The numbers are those of C: cbindgen exports these enums to
//! `netmesh.h` under the names that `cbindgen.toml` gives them, and links to values become C's
//! constants there.

use super::table::{OptionValue, Value, Word};

/// Kind of mesh that a run leaves behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Output {
    /// [`Output::WellSpaced`] where something is asked for that a cage would break: min_angle,
    /// min_dihedral, a size (max_edge, a function, values at the inputs or on a background, the
    /// largest edge of a region), distance_ratio, or an extent other than [`Extent::All`], also one
    /// that [`Extent::Auto`] has become. Otherwise [`Output::Hierarchical`].
    #[default]
    Auto = 0,
    /// A hierarchical mesh of O(n) vertices whatever the spread of the input (the paper's NETMESH):
    /// a tree of balls (domains), each surrounded by a cage, with quality inside each.
    Hierarchical = 1,
    /// A well-spaced mesh of a single domain of optimal size O(m) (the paper's FINISHMESH). m is at
    /// most n times the logarithm of the spread.
    WellSpaced = 2,
}

/// Algorithm that makes the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Algorithm {
    /// NETMESH: O(n log n) (plus the output for [`Output::WellSpaced`]), whatever the spread.
    #[default]
    Netmesh = 0,
    /// Sparse Voronoi Refinement: no cages, a well-spaced mesh of one domain whatever the output;
    /// O(n log spread + m). The baseline for comparisons.
    Svr = 1,
    /// The plain Delaunay triangulation of the input, without Steiner points and without a bound on
    /// quality. Its size may be of order n^ceil(dim/2). Points in a lower-dimensional affine
    /// subspace are refused as degenerate. In 2D and 3D it depends on the points alone, also where
    /// many of them are on one sphere: not on their order, the seed or the threads.
    Delaunay = 2,
}

/// Region: how far the result of a run reaches, or which simplices a selection has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Extent {
    /// For a run [`Extent::Boundary`] where segments, or facets in space, enclose something by the
    /// option interior, otherwise [`Extent::All`]; curves and surfaces that are not closed, where
    /// that option asks for closed ones, enclose nothing. For a selection [`Extent::All`].
    #[default]
    Auto = 0,
    /// Everywhere, to the cage round all inputs.
    All = 1,
    /// The convex hull of the inputs. For runs in 2D and 3D alone; inputs that are on its
    /// boundary up to rounding are vertices of it.
    Hull = 2,
    /// The least box that holds the inputs, its sides along the axes. For runs in 2D and 3D alone;
    /// corners that are no inputs become further vertices.
    Box = 3,
    /// The region that segments, or facets in space, enclose, without holes: all that cannot be
    /// reached from the hull without crossing one. For runs alone; segments and facets are set
    /// before.
    Boundary = 4,
}

/// Choice of the inputs that a round inserts (the paper's Section 6.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum NetOrdering {
    /// A sample driven by the option seed, whose success is verified: the time bound is expected
    /// time.
    #[default]
    SampledNet = 0,
    /// A deterministic net (the paper's Theorem 3): the time bound is worst-case time. No random
    /// number is used, so the option seed has no effect.
    DeterministicNet = 1,
}

/// Measure that the option quality_bound bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Criterion {
    /// The paper's tau: a Voronoi cell's out-radius (distance to its farthest corner) over its
    /// in-radius (half the distance to the nearest neighbour). The stronger measure: it bounds
    /// circumradius over shortest edge by tau/2.
    #[default]
    VoronoiAspect = 0,
    /// A simplex's circumradius over its shortest edge, the measure of TetGen and Triangle. 1.0 in
    /// 2D is a smallest angle of 30 degrees, sqrt(2) one of 20.7.
    RadiusEdge = 1,
}

/// Treatment of segments, in space of facets too, that cross where no input is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Crossings {
    /// The run is refused as an invalid argument, and the message names two of them.
    #[default]
    Refuse = 0,
    /// The double nearest to the crossing of two segments becomes a vertex of both. In space,
    /// points where an edge or segment meets a facet or another edge become vertices of both, but
    /// for roundings, and the line along which two facets meet becomes an edge of both; an area
    /// that several facets share is left to the first; triangles without an area are left out.
    Split = 1,
}

/// Rule by which regions between segments are inside, with [`Extent::Auto`] and
/// [`Extent::Boundary`]. Seeds may make holes of such regions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Interior {
    /// [`Interior::Parity`] where the segments are those of a file of polygons (GeoJSON, WKT),
    /// [`Interior::Winding`] where triangles in space are surfaces that are closed and oriented
    /// alike, [`Interior::Seeds`] otherwise. The options of the finished run tell which it was.
    #[default]
    Auto = 0,
    /// All that cannot be reached from outside without crossing a segment, in space a facet, is
    /// inside.
    Seeds = 1,
    /// Regions are inside into which a path from outside crosses an odd number of segments (the
    /// even-odd rule): rings within rings are alternately inside and outside. Every input must be
    /// an end of an even number of segments. Of a file of polygons only the sides of these count,
    /// not its lines. In space facets stand for segments, and every edge must have an even number
    /// of them.
    Parity = 2,
    /// Regions are inside whose winding number is not 0 (the nonzero rule): the number of segments
    /// that a path from outside crosses from their right to their left, less that from their left
    /// to their right. Every input must be the first end of as many segments as it is the second
    /// end. Of a file of polygons only the sides of these count. In space facets stand for
    /// segments, their left is where their normal does not point to, and they must run through
    /// every edge as often one way as the other.
    Winding = 3,
}

/// Labels of the regions that segments, in space facets, separate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Labels {
    /// A region has the label of its seed, without one 0.
    #[default]
    Seeds = 0,
    /// Regions of the domain without a seed are numbered from 1 on, but for the labels of seeds.
    /// They are in the order of the first facets that they are behind, where normals do not point
    /// to: so each of several shells numbers what it encloses. Those that are behind none come
    /// last, by the first facets that they are before. In the plane segments stand for facets, and
    /// behind is what is on their left. What is outside of all that they enclose has the label 0.
    Regions = 1,
}

/// Promise that gives way where min_dihedral and quality_bound cannot both be kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum GivesWay {
    /// The dihedral angle: the bound holds, and some simplices stay below the angle.
    #[default]
    Angle = 0,
    /// The bound: fewer simplices stay below the angle, and some cells
    /// ([`Criterion::VoronoiAspect`]) or simplices ([`Criterion::RadiusEdge`]) go beyond the bound.
    Bound = 1,
}

/// Type whose values have words.
pub trait Choices: Copy + 'static {
    /// Words for the values, in the order of their numbers.
    const WORDS: &'static [Word];
    /// All values, in the order of their numbers.
    const VALUES: &'static [Self];
}

/// Names of an option that has words, and of its value.
#[derive(Clone, Copy, Debug)]
pub struct Chosen {
    pub option: &'static str,
    /// Name of the option's type in Rust.
    pub kind: &'static str,
    pub word: &'static Word,
}

/// Declares the words of each value in the order of their numbers: the word in Python and in C's
/// constants, after `or` that of the command line where it is another, and what the value means.
macro_rules! choices {
    (@argument $word:literal) => { $word };
    (@argument $word:literal $argument:literal) => { $argument };
    ($($type:ident $option:literal {
        $($value:ident $word:literal $(or $argument:literal)? : $help:literal,)*
    })*) => {
        /// Option that has words for its values, with one of them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Choice {
            $($type($type),)*
        }

        impl Choice {
            /// Returns the names of the option, of its type and of the value.
            pub fn chosen(self) -> Chosen {
                match self {
                    $(Self::$type(value) => Chosen {
                        option: $option,
                        kind: stringify!($type),
                        word: &$type::WORDS[value as usize],
                    },)*
                }
            }
        }

        $(
            impl Choices for $type {
                const WORDS: &'static [Word] = &[$(Word {
                    value: stringify!($value),
                    word: $word,
                    argument: choices!(@argument $word $($argument)?),
                    help: $help,
                },)*];
                const VALUES: &'static [Self] = &[$(Self::$value,)*];
            }

            impl OptionValue for $type {
                fn to_value(self) -> Value {
                    Value::Word(self as usize)
                }

                fn from_value(value: Value) -> Option<Self> {
                    let Value::Word(number) = value else { return None };
                    Self::VALUES.get(number).copied()
                }

                fn choice(self) -> Option<Choice> {
                    Some(Choice::$type(self))
                }
            }
        )*
    };
}

choices! {
    Criterion "criterion" {
        VoronoiAspect "voronoi_aspect" or "aspect": "distance from a vertex to the farthest corner \
            of its Voronoi cell over half the distance to its nearest neighbour",
        RadiusEdge "radius_edge" or "radius-edge": "circumradius of a simplex over its shortest \
            edge",
    }
    GivesWay "gives_way" {
        Angle "angle": "some tetrahedra stay below the dihedral angle",
        Bound "bound": "some cells, or tetrahedra, go beyond the bound",
    }
    Extent "extent" {
        Auto "auto": "boundary where segments or facets enclose something, otherwise all",
        All "all": "all of the mesh, to the cage round all inputs",
        Hull "hull": "the convex hull of the inputs, in 2D and 3D",
        Box "box": "the bounding box of the inputs, in 2D and 3D",
        Boundary "boundary": "the region that segments or facets enclose",
    }
    Interior "interior" {
        Auto "auto": "parity for the polygons of a GeoJSON or WKT file, winding for triangles in \
            space that are closed and oriented alike, seeds otherwise",
        Seeds "seeds": "all that cannot be reached from outside without crossing a segment or \
            facet",
        Parity "parity": "regions into which a path from outside crosses an odd number of segments \
            or facets",
        Winding "winding": "regions whose winding number, by the directions of the segments or \
            the normals of the facets, is not 0",
    }
    Crossings "crossings" {
        Refuse "refuse": "the run is refused",
        Split "split": "the double nearest to the crossing becomes a vertex of both",
    }
    Labels "labels" {
        Seeds "seeds": "those of seeds, and 0",
        Regions "regions": "those of seeds; other regions of the domain are numbered from 1 on, \
            by their first segments or facets",
    }
    Output "output" {
        Auto "auto": "well-spaced where an angle, a size, `distance_ratio` or an extent other than \
            all is asked for, which cages would break, otherwise hierarchical",
        Hierarchical "hierarchical": "a mesh of linear size, whatever the spread of the inputs",
        WellSpaced "well_spaced" or "well-spaced": "a mesh of one domain, refined across the \
            scales, too",
    }
    Algorithm "algorithm" {
        Netmesh "netmesh": "the paper's algorithm, O(n log n) whatever the spread",
        Svr "svr": "Sparse Voronoi Refinement, the baseline for comparisons",
        Delaunay "delaunay": "the Delaunay triangulation of the inputs, without Steiner points",
    }
    NetOrdering "ordering" {
        SampledNet "sampled_net" or "sampled": "a sample that `seed` drives",
        DeterministicNet "deterministic_net" or "deterministic": "a net, made without any random \
            number",
    }
}
