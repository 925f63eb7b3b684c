//! Words for values of the program's own arguments, and what they are to the library.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use netmesh::io::Format;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AddedValues {
    /// Linear in the Delaunay triangulation of the inputs, those of the nearest input beyond its
    /// hull
    Linear,
    /// Not a number
    Nan,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FiltrationName {
    /// Alpha values, of the Delaunay triangulation of the input, which is made instead of a mesh
    Alpha,
    /// The distance to the input, followed by the cells of the mesh; best with --finish
    Mesh,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatName {
    /// VTK XML unstructured grid, write only (.vtu)
    Vtu,
    /// TetGen .node and .ele
    Tetgen,
    /// Gmsh, as text (.msh)
    Gmsh,
    /// Medit, as text (.mesh)
    Medit,
    /// OFF, nOFF from three dimensions on (.off)
    Off,
    /// Polygons: of a planar mesh all triangles, in 3D the boundary (.ply)
    Ply,
    /// Points, separated by spaces (.xyz)
    Xyz,
    /// Points, separated by commas (.csv)
    Csv,
    /// Points as a NumPy array (.npy)
    Npy,
    /// The Voronoi diagram of the vertices, write only (.voronoi.json)
    VoronoiJson,
    /// The domains and their cages, write only (.domains.json)
    DomainsJson,
    /// Points with segments (Triangle) or facets (TetGen) and regions, read only (.poly)
    Poly,
    /// TetGen's points, facets and regions, a line for each facet, read only (.smesh)
    Smesh,
    /// Triangles of STL, read as text or binary data; in 3D the boundary is written, with numbers
    /// of single precision (.stl)
    Stl,
    /// Points, polygons and lines of OBJ, read only (.obj)
    Obj,
    /// Points, lines and polygons of GeoJSON, read only (.geojson)
    #[value(name = "geojson")]
    Geojson,
    /// Points, lines and polygons of well-known text, read only (.wkt)
    Wkt,
    /// A picture of a planar mesh, write only (.svg)
    Svg,
    /// A page that turns, cuts and colours the mesh in any browser, write only (.html)
    Html,
}

/// Format that points can be read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadableFormat(pub FormatName);

impl ValueEnum for ReadableFormat {
    fn value_variants<'a>() -> &'a [Self] {
        const READABLE: [ReadableFormat; 14] = [
            ReadableFormat(FormatName::Tetgen),
            ReadableFormat(FormatName::Gmsh),
            ReadableFormat(FormatName::Medit),
            ReadableFormat(FormatName::Off),
            ReadableFormat(FormatName::Ply),
            ReadableFormat(FormatName::Xyz),
            ReadableFormat(FormatName::Csv),
            ReadableFormat(FormatName::Npy),
            ReadableFormat(FormatName::Poly),
            ReadableFormat(FormatName::Smesh),
            ReadableFormat(FormatName::Stl),
            ReadableFormat(FormatName::Obj),
            ReadableFormat(FormatName::Geojson),
            ReadableFormat(FormatName::Wkt),
        ];
        &READABLE
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        self.0.to_possible_value()
    }
}

/// Format that meshes can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WritableFormat(pub FormatName);

impl ValueEnum for WritableFormat {
    fn value_variants<'a>() -> &'a [Self] {
        const WRITABLE: [WritableFormat; 14] = [
            WritableFormat(FormatName::Vtu),
            WritableFormat(FormatName::Tetgen),
            WritableFormat(FormatName::Gmsh),
            WritableFormat(FormatName::Medit),
            WritableFormat(FormatName::Off),
            WritableFormat(FormatName::Ply),
            WritableFormat(FormatName::Stl),
            WritableFormat(FormatName::Xyz),
            WritableFormat(FormatName::Csv),
            WritableFormat(FormatName::Npy),
            WritableFormat(FormatName::VoronoiJson),
            WritableFormat(FormatName::DomainsJson),
            WritableFormat(FormatName::Svg),
            WritableFormat(FormatName::Html),
        ];
        &WRITABLE
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        self.0.to_possible_value()
    }
}

impl FormatName {
    pub fn format(self) -> Format {
        match self {
            Self::Vtu => Format::Vtu,
            Self::Tetgen => Format::TetgenNode,
            Self::Gmsh => Format::Gmsh,
            Self::Medit => Format::Medit,
            Self::Off => Format::Off,
            Self::Ply => Format::Ply,
            Self::Xyz => Format::Xyz,
            Self::Csv => Format::Csv,
            Self::Npy => Format::Npy,
            Self::VoronoiJson => Format::VoronoiJson,
            Self::DomainsJson => Format::DomainsJson,
            Self::Poly => Format::Poly,
            Self::Smesh => Format::Smesh,
            Self::Stl => Format::Stl,
            Self::Obj => Format::Obj,
            Self::Geojson => Format::Geojson,
            Self::Wkt => Format::Wkt,
            Self::Svg => Format::Svg,
            Self::Html => Format::Html,
        }
    }
}
