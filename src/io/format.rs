//! The formats and their extensions.

use crate::error::{Error, Result, message};
use std::path::Path;

/// File formats, with the C ABI's values. `docs/formats.md` has them all in one table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// Format that the file's extension names.
    #[default]
    Auto = 0,
    /// VTK's XML unstructured grid, for ParaView: triangles (z = 0) or tetrahedra as appended raw
    /// little-endian binary. Dimensions 2 and 3; cannot be read.
    ///
    /// Per point: `kind` ([`crate::VertexKind`]), `domain` (index, or [`crate::NONE`]), `input`
    /// (the first input that is this vertex, or [`crate::NONE`]), `precision_limited` (0 or 1) and
    /// `aspect` (of the Voronoi cell, over all its corners; NaN on the hull, where cells are
    /// unbounded, and for the vertices of cages). Per cell: `cell_domain` (the innermost domain
    /// that holds all vertices, or [`crate::NONE`]) and `radius_edge` (circumradius over shortest
    /// edge). With segments, `region` per cell (the label), and beside points and cells `segments`
    /// (two points for each edge of one) and `segment_markers`.
    Vtu = 1,
    /// TetGen's (3D) and Triangle's (2D) `.node` and `.ele`, continued to any dimension.
    ///
    /// Written with ids from 0 and [`crate::VertexKind`] as the boundary marker. Read: ids from 0
    /// or 1; attributes and markers are checked, and dropped where they are not asked for. Where
    /// the path ends with `.ele` the points are in its `.node` sibling.
    TetgenNode = 2,
    /// Gmsh's `.msh`, version 4.1 as text: triangles (z = 0) or tetrahedra in one entity and one
    /// physical group, `kind` as node data and `domain` (VTU's `cell_domain`, 0 without domains) as
    /// element data. With segments, a physical group for each label and marker, with the edges as
    /// lines. Dimensions 2 and 3.
    ///
    /// Read: the nodes of versions 4.1 and 2, as text. A node has three coordinates; where every z
    /// is zero the points are of dimension 2.
    Gmsh = 3,
    /// Medit's `.mesh`: vertices with [`crate::VertexKind`] as reference, triangles or tetrahedra
    /// with their domain (as in [`Format::Gmsh`]). Dimensions 2 and 3. Read: the vertices;
    /// references are checked and dropped, other fields are skipped.
    Medit = 4,
    /// In the plane `OFF`, with z = 0 and triangles, which every viewer opens (and which reads back
    /// as points of dimension 3, the dimension of `OFF`). In dimension d >= 3 `nOFF`: d, the
    /// counts, the vertices, then the simplices as cells of d + 1 indices; tetrahedra are not
    /// polygons, and an `OFF` that lists them as such would be read wrongly.
    ///
    /// Read: the vertices of `OFF` and `nOFF`, one per line. The faces of `OFF` are facets, those of
    /// two vertices segments; those of `nOFF` are checked and left out.
    Off = 5,
    /// Stanford's `.ply`, little-endian binary with doubles: the vertices with `kind` and `domain`,
    /// and triangles. In the plane these are the mesh (z = 0); in dimension 3 they are the mesh's
    /// boundary, as the format has no tetrahedra. Dimensions 2 and 3.
    ///
    /// Read: `x`, `y` and, where it is there, `z` of the element `vertex` (so a planar mesh reads
    /// back as points of dimension 3), from text and binary of either byte order, and in space the
    /// list `vertex_indices` or `vertex_index` of the element `face` as facets; all else that is
    /// not asked for is checked as far as its size goes and dropped.
    Ply = 6,
    /// Text points, one per line, separated by whitespace or commas, but not by both in one line
    /// (a decimal comma would read so). The first point's number of columns is the dimension. A
    /// first line may be the number of points, as in `.pts` files; there columns beyond three are
    /// intensity and colour.
    Xyz = 7,
    /// Comma-separated points. A first line without any number is a header. Where it names the
    /// columns `x` and `y` (in either case), these and a column `z` are the coordinates; otherwise
    /// `x0`, `x1` and so on, as [`crate::io::write()`] names them; otherwise all columns, without a
    /// last one called `kind`. Other columns may hold anything. A field may stand between quotes,
    /// with commas in it; a quote in it is written twice.
    Csv = 8,
    /// NumPy's `.npy`, an array of shape (points, dim). Written as version 1.0, `<f8`, C order;
    /// with attributes as a structured array of the fields `points`, `kind` and the attributes.
    /// Read: versions 1.0 to 3.0, doubles and floats of either byte order, C and Fortran order;
    /// structured arrays too, whose fields name the coordinates as the header of [`Format::Csv`]
    /// does, or are called `points`.
    Npy = 9,
    /// The Voronoi diagram of the vertices, dual to the mesh, as JSON (`.voronoi.json`). Any
    /// dimension; cannot be read. `docs/formats.md` has the fields.
    VoronoiJson = 10,
    /// The hierarchy of domains and their cages as JSON (`.domains.json`). Any dimension; cannot be
    /// read. `docs/formats.md` has the fields.
    DomainsJson = 11,
    /// `.poly` of Triangle (points and segments of the plane) and of TetGen (points and facets of
    /// space), with holes and regions. Ids from 0 or 1; where it promises no points, they are in
    /// the `.node` file beside. A region's label is a whole number, its largest area or volume
    /// becomes the edge of the equilateral triangle or regular tetrahedron of that measure. Cannot
    /// be written.
    Poly = 12,
    /// GeoJSON (RFC 7946): points, lines and polygons of the plane, each position as an input and
    /// each line between two as a segment, whose marker is the number of its feature, from 1. A
    /// third coordinate must be 0. Cannot be written.
    GeoJson = 13,
    /// Well-known text (OGC 06-103r4): geometries one after another, as of [`Format::GeoJson`]; the
    /// marker is the number of the geometry, from 1. Z and M are refused. Cannot be written.
    Wkt = 14,
    /// TetGen's `.smesh`: as its `.poly`, with facets of one polygon each. Cannot be written.
    Smesh = 15,
}

impl Format {
    /// Returns the format that a path's extension stands for, in either case.
    ///
    /// # Errors
    /// `InvalidArgument` where the extension is missing or unknown; the message lists the known.
    pub fn from_path(path: &Path) -> Result<Self> {
        match extension(path).as_deref() {
            Some("vtu") => Ok(Self::Vtu),
            Some("node" | "ele") => Ok(Self::TetgenNode),
            Some("msh") => Ok(Self::Gmsh),
            Some("mesh") => Ok(Self::Medit),
            Some("off") => Ok(Self::Off),
            Some("ply") => Ok(Self::Ply),
            Some("xyz" | "txt" | "xy" | "pts") => Ok(Self::Xyz),
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            Some("voronoi.json") => Ok(Self::VoronoiJson),
            Some("domains.json") => Ok(Self::DomainsJson),
            Some("poly") => Ok(Self::Poly),
            Some("smesh") => Ok(Self::Smesh),
            Some("geojson") => Ok(Self::GeoJson),
            Some("wkt") => Ok(Self::Wkt),
            _ => Err(Error::invalid(message!(
                "{}: the extension names no known format; name one, or use .vtu, .node, .ele, \
                     .msh, .mesh, .off, .ply, .xyz, .txt, .xy, .pts, .csv, .npy, .poly, .smesh, \
                     .geojson, .wkt, .voronoi.json or .domains.json",
                path.display()
            ))),
        }
    }

    /// Returns the name that people know the format by.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "the format of the extension",
            Self::Vtu => "VTU",
            Self::TetgenNode => "TetGen",
            Self::Gmsh => "Gmsh",
            Self::Medit => "Medit",
            Self::Off => "OFF",
            Self::Ply => "PLY",
            Self::Xyz => "XYZ",
            Self::Csv => "CSV",
            Self::Npy => "NumPy",
            Self::VoronoiJson => "the Voronoi diagram",
            Self::DomainsJson => "the hierarchy of domains",
            Self::Poly => "Triangle's and TetGen's .poly",
            Self::Smesh => "TetGen's .smesh",
            Self::GeoJson => "GeoJSON",
            Self::Wkt => "WKT",
        }
    }

    /// Returns true if files of the format can hold attributes of points.
    pub fn holds_attributes(self) -> bool {
        match self {
            Self::Vtu | Self::TetgenNode | Self::Gmsh | Self::Ply | Self::Csv | Self::Npy => true,
            Self::Auto
            | Self::Medit
            | Self::Off
            | Self::Xyz
            | Self::VoronoiJson
            | Self::DomainsJson
            | Self::Poly
            | Self::Smesh
            | Self::GeoJson
            | Self::Wkt => false,
        }
    }

    pub(super) fn resolve(self, path: &Path) -> Result<Self> {
        if self == Self::Auto { Self::from_path(path) } else { Ok(self) }
    }

    /// Returns this format, or that of the extension, if it is one that can be written.
    ///
    /// # Errors
    /// `InvalidArgument`; the message lists the extensions of formats that can be written.
    pub fn resolve_output(self, path: &Path) -> Result<Self> {
        let resolved = self.resolve(path).map_err(|_| {
            let message = message!(
                "{}: the extension names no format that can be written; name the format, or use \
                 .vtu, .node, .ele, .msh, .mesh, .off, .ply, .xyz, .txt, .xy, .pts, .csv, .npy, \
                 .voronoi.json or .domains.json",
                path.display()
            );
            Error::invalid(message)
        })?;
        match resolved {
            Self::Poly | Self::Smesh | Self::GeoJson | Self::Wkt => {
                Err(resolved.read_only().within(&path.display()))
            }
            _ => Ok(resolved),
        }
    }

    /// Returns the error of writing a format that is read only.
    pub(super) fn read_only(self) -> Error {
        let message =
            message!("{} cannot be written, only read; write TetGen or Gmsh", self.name());
        Error::invalid(message)
    }

    /// Resolves the format of a file to read as [`Format::resolve`] does; an unknown extension is
    /// answered with those that can be read.
    pub(super) fn resolve_input(self, path: &Path) -> Result<Self> {
        self.resolve(path).map_err(|_| {
            if let Some(refusal) = surface_at(path) {
                return refusal;
            }
            let message = message!(
                "{}: the extension names no format that can be read; name the format, or use \
                 .node, .ele, .msh, .mesh, .off, .ply, .xyz, .txt, .xy, .pts, .csv, .npy, .poly, \
                 .smesh, .geojson or .wkt",
                path.display()
            );
            Error::invalid(message)
        })
    }

    /// Refuses a format that is written only.
    pub(super) fn check_readable(self) -> Result<()> {
        match self {
            Self::Vtu | Self::VoronoiJson | Self::DomainsJson => Err(Error::invalid(message!(
                "{} cannot be read, only written; points are read from TetGen, Gmsh, Medit, \
                     OFF, PLY, XYZ, CSV, NumPy, .poly, .smesh, GeoJSON and WKT files",
                self.name()
            ))),
            _ => Ok(()),
        }
    }

    /// Refuses a dimension that the format has no cells for.
    pub(super) fn check_dimension(self, dim: usize) -> Result<()> {
        match self {
            Self::Vtu | Self::Gmsh | Self::Medit | Self::Ply if !(2..=3).contains(&dim) => {
                Err(Error::invalid(message!(
                    "{} holds meshes of dimension 2 and 3, not {dim}; use OFF (nOFF) or TetGen",
                    self.name()
                )))
            }
            _ => Ok(()),
        }
    }
}

/// Returns the error of a file whose extension says that it is a surface. It refuses the content of
/// the file, not the name of a format.
fn surface_at(path: &Path) -> Option<Error> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    let (_, name) = SURFACES.iter().find(|(known, _)| *known == extension)?;
    let message = message!(
        "{}: {name} is a surface in a format that is not read yet; convert it to .off or .ply",
        path.display()
    );
    Some(Error::invalid(message).of_content())
}

/// Extensions of files of surfaces, and what messages call such a file.
const SURFACES: [(&str, &str); 5] = [
    ("stl", "an STL file"),
    ("obj", "an OBJ file"),
    ("3mf", "a 3MF file"),
    ("gltf", "a glTF file"),
    ("glb", "a glTF file"),
];

/// Returns the part after the last dot in lower case; of names that end with `.json` the part
/// before, too.
fn extension(path: &Path) -> Option<String> {
    let last = |path: &Path| Some(path.extension()?.to_str()?.to_ascii_lowercase());
    match last(path)?.as_str() {
        "json" => Some(last(Path::new(path.file_stem()?))? + ".json"),
        other => Some(other.to_string()),
    }
}
