//! The formats and their extensions.

use crate::error::{Error, Result, message};
use std::path::Path;

/// File formats; docs/formats.md tells what each contains. Point formats (XYZ, CSV, NPY) can be
/// written before a run; the others are refused then (NM_STATE in C), and so is a format that
/// cannot hold the mesh's dimension (NM_INVALID_ARGUMENT). VTU, SVG, HTML and the two JSON formats
/// cannot be read. Of the others the points are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// Format that the extension of the path names: .vtu, .node and .ele, .msh, .mesh, .off, .ply,
    /// .xyz (.txt, .xy, .pts), .csv, .npy, .poly, .smesh, .stl, .obj, .geojson, .wkt,
    /// .voronoi.json, .domains.json, .svg, .html.
    #[default]
    Auto = 0,
    /// VTK XML unstructured grid (.vtu), for ParaView and VTK, with arrays per point and per cell.
    /// Dimensions 2 and 3.
    Vtu = 1,
    /// TetGen and Triangle: points (.node) and simplices (.ele).
    TetgenNode = 2,
    /// Gmsh 4.1 as text (.msh); versions 4.1 and 2 are read, as text. Dimensions 2 and 3.
    Gmsh = 3,
    /// Medit as text (.mesh). Dimensions 2 and 3.
    Medit = 4,
    /// Object file format (.off), nOFF from dimension 3 on.
    Off = 5,
    /// Polygon file format (.ply): the triangles of a planar mesh, the boundary of one in dimension
    /// 3, where facets are given with their markers.
    Ply = 6,
    /// Points as text, one per line, separated by spaces (.xyz).
    Xyz = 7,
    /// Points as text, one per line, separated by commas (.csv).
    Csv = 8,
    /// Points as a NumPy array of shape points x dim (.npy).
    Npy = 9,
    /// The Voronoi diagram of the vertices as JSON (.voronoi.json).
    VoronoiJson = 10,
    /// The hierarchy of domains with their cages as JSON (.domains.json).
    DomainsJson = 11,
    /// Triangle's points, segments, holes and regions of the plane, or TetGen's points, facets,
    /// holes and regions of space, read only (.poly); the points may be in the .node file beside.
    Poly = 12,
    /// GeoJSON (RFC 7946): points, lines and polygons of the plane, read only (.geojson). Lines and
    /// rings are segments; their marker is the number of the feature, from 1. A third coordinate
    /// must be 0.
    Geojson = 13,
    /// Well-known text: geometries of the plane, one after another, read only (.wkt). As of
    /// [`Format::Geojson`]; the marker is the number of the geometry, from 1.
    Wkt = 14,
    /// TetGen's points, facets of one polygon each, holes and regions, read only (.smesh).
    Smesh = 15,
    /// Stereolithography's triangles (.stl), read as text or binary data. Equal corners are one
    /// point; the marker of a triangle is the number of its solid, from 1. Of a mesh of dimension 3
    /// the boundary is written, as binary data with coordinates of single precision.
    Stl = 16,
    /// Wavefront's points, polygons and lines, read only (.obj). Markers are the numbers of groups,
    /// from 1 by the order of their first names, and 0 before any.
    Obj = 17,
    /// Scalable vector graphics, write only (.svg): a picture of a planar mesh, with its segments,
    /// its regions in colours, and its inputs if they are few. Dimension 2.
    Svg = 18,
    /// A page for any browser, write only (.html): the mesh can be turned and cut, and is coloured
    /// by quality, region or attribute. It needs no network. Dimensions 2 and 3.
    Html = 19,
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
            Some("stl") => Ok(Self::Stl),
            Some("obj") => Ok(Self::Obj),
            Some("geojson") => Ok(Self::Geojson),
            Some("wkt") => Ok(Self::Wkt),
            Some("svg") => Ok(Self::Svg),
            Some("html") => Ok(Self::Html),
            _ => Err(Error::invalid(message!(
                "{}: the extension names no known format; name one, or use .vtu, .node, .ele, \
                     .msh, .mesh, .off, .ply, .xyz, .txt, .xy, .pts, .csv, .npy, .poly, .smesh, \
                     .stl, .obj, .geojson, .wkt, .voronoi.json, .domains.json, .svg or .html",
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
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Geojson => "GeoJSON",
            Self::Wkt => "WKT",
            Self::Svg => "SVG",
            Self::Html => "HTML",
        }
    }

    /// Returns true if files of the format tell measures of the mesh
    /// ([`Measures`](crate::quality::Measures)).
    pub fn needs_measures(self) -> bool {
        matches!(self, Self::Vtu | Self::Svg | Self::Html)
    }

    /// Returns true if files of the format can hold attributes of points.
    pub fn holds_attributes(self) -> bool {
        match self {
            Self::Vtu
            | Self::TetgenNode
            | Self::Gmsh
            | Self::Ply
            | Self::Csv
            | Self::Npy
            | Self::Html => true,
            Self::Auto
            | Self::Medit
            | Self::Off
            | Self::Xyz
            | Self::VoronoiJson
            | Self::DomainsJson
            | Self::Poly
            | Self::Smesh
            | Self::Stl
            | Self::Obj
            | Self::Geojson
            | Self::Wkt
            | Self::Svg => false,
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
                 .vtu, .node, .ele, .msh, .mesh, .off, .ply, .stl, .xyz, .txt, .xy, .pts, .csv, \
                 .npy, .voronoi.json, .domains.json, .svg or .html",
                path.display()
            );
            Error::invalid(message)
        })?;
        match resolved {
            Self::Poly | Self::Smesh | Self::Obj | Self::Geojson | Self::Wkt => {
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
                 .smesh, .stl, .obj, .geojson or .wkt",
                path.display()
            );
            Error::invalid(message)
        })
    }

    /// Refuses a format that is written only.
    pub(super) fn check_readable(self) -> Result<()> {
        match self {
            Self::Vtu | Self::VoronoiJson | Self::DomainsJson | Self::Svg | Self::Html => {
                Err(Error::invalid(message!(
                    "{} cannot be read, only written; points are read from TetGen, Gmsh, Medit, \
                     OFF, PLY, XYZ, CSV, NumPy, .poly, .smesh, STL, OBJ, GeoJSON and WKT files",
                    self.name()
                )))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a dimension that the format has no cells for.
    pub(super) fn check_dimension(self, dim: usize) -> Result<()> {
        match self {
            Self::Vtu | Self::Gmsh | Self::Medit | Self::Ply | Self::Html
                if !(2..=3).contains(&dim) =>
            {
                Err(Error::invalid(message!(
                    "{} holds meshes of dimension 2 and 3, not {dim}; use OFF (nOFF) or TetGen",
                    self.name()
                )))
            }
            Self::Stl if dim != 3 => {
                let others = if dim == 2 { "PLY" } else { "OFF (nOFF) or TetGen" };
                Err(Error::invalid(message!(
                    "STL holds the boundary of meshes of dimension 3, not {dim}; use {others}"
                )))
            }
            Self::Svg if dim != 2 => {
                let others = if dim == 3 { "HTML" } else { "OFF (nOFF) or TetGen" };
                Err(Error::invalid(message!(
                    "SVG holds meshes of the plane, dimension 2, not {dim}; use {others}"
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
        "{}: {name} is a surface in a format that is not read yet; convert it to .stl, .off or \
         .ply",
        path.display()
    );
    Some(Error::invalid(message).of_content())
}

/// Extensions of files of surfaces, and what messages call such a file.
const SURFACES: [(&str, &str); 3] =
    [("3mf", "a 3MF file"), ("gltf", "a glTF file"), ("glb", "a glTF file")];

/// Returns the part after the last dot in lower case; of names that end with `.json` the part
/// before, too.
fn extension(path: &Path) -> Option<String> {
    let last = |path: &Path| Some(path.extension()?.to_str()?.to_ascii_lowercase());
    match last(path)?.as_str() {
        "json" => Some(last(Path::new(path.file_stem()?))? + ".json"),
        other => Some(other.to_string()),
    }
}
