//! Arguments of the command line, and the options of the library that they stand for.

use crate::choices::{AddedValues, FiltrationName, ReadableFormat, WritableFormat};
use crate::exit_code;
use crate::merging::parse_ratio;
use crate::meshing::Meshing;
use clap::parser::ValueSource;
use clap::{CommandFactory, FromArgMatches, Parser};
use netmesh::io::{AttributeColumns, Choice, Columns, Format};
use netmesh::options::{Group, Row, TABLE, Value};
use netmesh::{Algorithm, Options, Output};
use std::path::PathBuf;

/// The part of `--help` that shows uses.
pub const EXAMPLES: &str = "\
Examples:
  netmesh points.xyz -o mesh.vtu --validate
  netmesh points.csv -o mesh.off --finish --bound 3.5
  netmesh points.xyz -o delaunay.vtu --algorithm delaunay
  netmesh part.off -o part.msh --max-edge 0.5
  netmesh scan.csv --columns x,y,z --attributes intensity -o scan.vtu
  program | netmesh - --input-format xyz -o - --output-format off > mesh.off";

/// Mesh points: in goes a file of points, out comes a conforming quality Delaunay mesh.
///
/// The number of coordinates in the input is the dimension, 2 to 8. A number out of its range is
/// refused, and the message tells the range in that dimension. Facets are those of a part: its
/// inside is meshed, with --coplanar 0.1, --min-dihedral 10 and --labels regions where these are
/// not given.
#[derive(Debug, Parser)]
#[command(name = "netmesh", version, after_help = format!("{EXAMPLES}\n\n{}", exit_code::HELP))]
pub struct Arguments {
    /// File of points, perhaps with segments or facets; of a mesh its points. "-" is standard
    /// input, with --input-format
    pub input: PathBuf,

    /// Further file of points, facets and segments, which are meshed together with those of the
    /// input: points inside, walls, patches of one surface in a file each. Polygons become
    /// triangles if other files have triangles. Markers of each file are raised until they are
    /// larger than those before, so that they differ. May be given again
    #[arg(long, value_name = "FILE", conflicts_with_all = ["attributes", "sizes"])]
    pub with: Vec<PathBuf>,

    /// File for the mesh; its extension names the format. "-" is standard output, with
    /// --output-format; the summary then goes to standard error. Without it only the summary is
    /// made. Of a mesh in 3D .ply and .stl have the boundary; the numbers of .stl have single
    /// precision. A browser shows .svg, of a mesh in 2D, and .html, in 2D and 3D
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the input, where the extension does not tell
    #[arg(long, value_name = "FORMAT")]
    pub input_format: Option<ReadableFormat>,

    /// Columns of the input that are the coordinates: numbers from 1 (1,2,5), a range (1-3), or
    /// names of a CSV header (x,y,z). For XYZ, CSV and NumPy files, which often have more columns
    #[arg(long, value_name = "LIST", value_parser = parse_columns, allow_hyphen_values = true)]
    pub columns: Option<Columns>,

    /// Read the points of the input alone, and leave segments, facets and regions
    #[arg(long)]
    pub points: bool,

    /// Columns of the input that the output gets as attributes of the points: names (of a CSV
    /// header or of PLY's properties), numbers from 1, ranges, NAME=COLUMN for another name, or
    /// all. From TetGen, PLY, XYZ, CSV and NumPy files to VTU, TetGen, Gmsh, PLY, CSV, NumPy
    /// and HTML files
    #[arg(long, value_name = "LIST", value_parser = parse_attributes, requires = "output")]
    pub attributes: Option<AttributeColumns>,

    /// Values of attributes at vertices that are no inputs
    #[arg(long, value_name = "WORD", value_enum, default_value_t = AddedValues::Linear)]
    #[arg(requires = "attributes")]
    pub added_values: AddedValues,

    /// Write the faces and the values of a filtration instead of the mesh, for persistent homology:
    /// to a file that ends with .filtration (GUDHI's text) or .dipha
    #[arg(long, value_enum, value_name = "KIND", requires = "output")]
    #[arg(conflicts_with_all = ["output_format", "attributes"])]
    pub filtration: Option<FiltrationName>,

    /// Make the alpha shape of the input instead of a mesh: the faces of its Delaunay triangulation
    /// up to an alpha value. ALPHA is a squared radius; "connected", the least for which the shape
    /// is; or "optimal", the least for which its simplices reach all points and are one piece. The
    /// output is its boundary, a file that ends with .ply, .off, .stl or .obj; the summary has its
    /// topology
    #[arg(long, value_name = "ALPHA", value_parser = parse_alpha, allow_negative_numbers = true)]
    #[arg(
        conflicts_with_all = ["output_format", "attributes", "filtration", "finish", "hierarchical"]
    )]
    pub alpha_shape: Option<AlphaChoice>,

    /// Find the closed surface that goes through the points, of which no normals are asked; a
    /// closed curve in the plane. The output is the surface, a file that ends with .ply, .off, .stl
    /// or .obj; outliers, and points that noise moved off it, are left out and counted
    #[arg(long)]
    #[arg(conflicts_with_all = [
        "output_format", "attributes", "filtration", "alpha_shape", "hierarchical", "with", "merge",
        "sizes"
    ])]
    pub surface: bool,

    /// Let the surface through the points end, or have one side alone, as a sheet, a terrain or a
    /// Moebius strip; in the plane curves with ends. Holes of more than some five distances of
    /// points stay
    #[arg(long, requires = "surface", conflicts_with = "volume")]
    pub open: bool,

    /// Make the mesh of what the surface encloses, as of a part: the output is a mesh
    #[arg(long, requires = "surface")]
    pub volume: bool,

    /// Format of the output, where the extension does not tell
    #[arg(long, value_name = "FORMAT")]
    pub output_format: Option<WritableFormat>,

    /// Let the output replace the input file; without it that is refused
    #[arg(long)]
    pub force: bool,

    /// Make a well-spaced mesh of one domain (FINISHMESH), also where nothing asks for one. An
    /// angle, a size, --distance-ratio and an extent other than all do; otherwise the mesh is
    /// hierarchical
    #[arg(long)]
    pub finish: bool,

    /// Make a hierarchical mesh, also where an angle or an extent asks for a well-spaced one; some
    /// triangles beside cages then miss the angle
    #[arg(long, conflicts_with = "finish")]
    pub hierarchical: bool,

    /// Check the mesh with the independent certificate checker
    #[arg(long)]
    pub validate: bool,

    /// Make no mesh, but tell what keeps the facets of the input from being a closed surface that a
    /// mesh can conform to: edges that are open, of three or more facets or turned round, facets
    /// without an area, and all pairs that cross, touch or overlap. They are the cells of FILE, in
    /// VTK's format, and its name ends with .vtu. Of the options of a mesh only --coplanar may be
    /// given, up to which polygons count as plane
    #[arg(long, value_name = "FILE")]
    #[arg(conflicts_with_all = [
        "output", "output_format", "attributes", "filtration", "alpha_shape", "finish",
        "hierarchical", "json", "validate", "stats", "histogram", "quiet", "sizes", "background"
    ])]
    pub diagnose: Option<PathBuf>,

    /// Close holes of the surface that have at most so many edges, from 3 to 1000, with triangles
    /// between their corners, before it is meshed or diagnosed. They are bent as little as can be
    #[arg(long, value_name = "EDGES", value_parser = clap::value_parser!(u32).range(3..=1000))]
    pub close_holes: Option<u32>,

    /// Split all polygons of the surface into triangles, before its holes are closed. Without it
    /// they are split only if one of them is not plane, or if other files (--with) have triangles.
    /// Triangles in one plane are one facet again
    #[arg(long)]
    pub triangulate: bool,

    /// Make corners of facets one that are at most RATIO times the diagonal of the surface from
    /// each other, 0 to 0.001: programs write a point several times, with other roundings.
    /// Triangles of which two corners become one are left out, and loops of polygons of which fewer
    /// than three corners stay. Without it equal corners alone are one
    #[arg(long, value_name = "RATIO", value_parser = parse_ratio)]
    pub merge: Option<f64>,

    /// Print nothing but errors. The quality is then not measured (unless --json asks for it),
    /// which takes longer than the meshing of a large input
    #[arg(short, long)]
    pub quiet: bool,

    /// Print what the run did as well: rounds, touches, cages, points by kind, exact tests,
    /// parameters, and the constants of the paper's theorems as measured, which takes about as long
    /// again
    #[arg(long)]
    pub stats: bool,

    /// Print histograms of the quality as well: angles, radius-edge ratios and aspects of cells
    #[arg(long)]
    pub histogram: bool,

    /// Write counts, options, quality and statistics as a JSON object; what --stats and
    /// --histogram measure is null without them. "-" is standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    #[command(flatten)]
    pub size_files: SizeFiles,

    #[command(flatten)]
    pub meshing: Meshing,

    /// Options of the library that were given, by their names.
    #[arg(skip)]
    pub given: Vec<&'static str>,
}

/// Files that tell sizes, beside the library's options.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = Group::Sizes.heading())]
pub struct SizeFiles {
    /// File with the length that edges shall have at each point of the input, as TetGen's .mtr: the
    /// number of points, then one number a line
    #[arg(long, value_name = "FILE")]
    pub sizes: Option<PathBuf>,

    /// File with points of a background, such as TetGen's .b.node, and the length that edges shall
    /// have there: in a .mtr file of the same name beside it, or else as the attribute "size" (the
    /// first attribute of a .node file). Between the points lengths are linear
    #[arg(long, value_name = "FILE")]
    pub background: Option<PathBuf>,
}

/// Returns the heading under which the program has an option of the library, if it has it by name:
/// the kind of output and the measurements have arguments of their own.
pub fn heading(row: &Row) -> Option<&'static str> {
    (!["output", "instruments"].contains(&row.name)).then(|| row.group.heading())
}

/// Choice of an alpha shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaChoice {
    Value(f64),
    Connected,
    Optimal,
}

/// Thing that the output is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Product {
    Mesh,
    Filtration(FiltrationName),
    AlphaShape(AlphaChoice),
    Surface,
}

impl Arguments {
    /// Returns the arguments of this process, or ends it with a message.
    pub fn of_command_line() -> Self {
        let matches = Self::command().get_matches();
        let mut arguments = Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
        let has = |name: &&str| matches.value_source(name) == Some(ValueSource::CommandLine);
        let names = TABLE.iter().filter(|row| heading(row).is_some()).map(|row| row.name);
        arguments.given = names.filter(has).collect();
        arguments
    }

    pub fn input_format(&self) -> Format {
        self.input_format.map_or(Format::Auto, |readable| readable.0.format())
    }

    pub fn output_format(&self) -> Format {
        self.output_format.map_or(Format::Auto, |writable| writable.0.format())
    }

    /// Returns the columns that are read.
    pub fn choice(&self) -> Choice {
        Choice {
            coordinates: self.columns.clone().unwrap_or_default(),
            attributes: self.attributes.clone().unwrap_or_default(),
            has_points_alone: self.points,
        }
    }

    pub fn product(&self) -> Product {
        let filtration = self.filtration.map(Product::Filtration);
        let alpha_shape = self.alpha_shape.map(Product::AlphaShape);
        let surface = (self.surface && !self.volume).then_some(Product::Surface);
        filtration.or(alpha_shape).or(surface).unwrap_or(Product::Mesh)
    }

    /// Returns the option that asks for the plain Delaunay triangulation, if one does.
    pub fn delaunay_option(&self) -> &'static str {
        match self.product() {
            Product::Filtration(FiltrationName::Alpha) => "--filtration alpha",
            Product::AlphaShape(_) => "--alpha-shape",
            Product::Surface => "--surface",
            Product::Filtration(FiltrationName::Mesh) | Product::Mesh => "--algorithm delaunay",
        }
    }

    /// Returns the arguments that were given and have no effect on the algorithm.
    pub fn without_effect(&self) -> Vec<String> {
        let options = self.options();
        let outputs = [(self.finish, "--finish"), (self.hierarchical, "--hierarchical")];
        let outputs = outputs.iter().filter(|(is_given, _)| *is_given);
        let outputs = outputs.map(|(_, name)| (*name).to_owned());
        let is_promise =
            |row: &&Row| matches!(row.group, Group::Quality | Group::Paper) && row.is_number();
        let numbers = TABLE.iter().filter(is_promise);
        let is_given = |row: &&Row| row.get(&options) != Value::Number(0.0);
        let numbers = numbers.filter(is_given).map(|row| format!("--{}", row.argument()));
        match options.algorithm {
            Algorithm::Netmesh => Vec::new(),
            Algorithm::Svr => outputs.collect(),
            Algorithm::Delaunay => outputs.chain(numbers).collect(),
        }
    }

    /// Returns the options of the run.
    pub fn options(&self) -> Options {
        let given = self.meshing.options.clone();
        Options {
            output: match (self.finish, self.hierarchical) {
                (true, _) => Output::WellSpaced,
                (_, true) => Output::Hierarchical,
                _ => Output::Auto,
            },
            algorithm: match self.product() {
                Product::Filtration(FiltrationName::Alpha)
                | Product::AlphaShape(_)
                | Product::Surface => Algorithm::Delaunay,
                _ => given.algorithm,
            },
            instruments: self.stats,
            ..given
        }
    }
}

fn parse_alpha(text: &str) -> Result<AlphaChoice, String> {
    match text {
        "connected" => Ok(AlphaChoice::Connected),
        "optimal" => Ok(AlphaChoice::Optimal),
        _ => match text.parse::<f64>() {
            Ok(alpha) if alpha >= 0.0 => Ok(AlphaChoice::Value(alpha)),
            _ => Err("it must be a squared radius of at least 0, connected or optimal".to_owned()),
        },
    }
}

fn parse_columns(text: &str) -> Result<Columns, String> {
    text.parse().map_err(without_name)
}

fn parse_attributes(text: &str) -> Result<AttributeColumns, String> {
    text.parse().map_err(without_name)
}

/// Returns the message without the name of the library's argument that it begins with: here clap
/// names the option.
fn without_name(error: netmesh::Error) -> String {
    let message = error.message();
    message.split_once(": ").map_or(message, |(_, rest)| rest).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use netmesh::options::Kind;

    #[test]
    fn the_command_is_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn without_options_the_library_defaults_apply() {
        let arguments = Arguments::parse_from(["netmesh", "points.xyz"]);
        assert_eq!(arguments.options(), Options::default());
        assert_eq!(arguments.input_format(), Format::Auto);
        assert_eq!(arguments.output_format(), Format::Auto);
    }

    #[test]
    fn every_option_reaches_the_library() {
        let options = |arguments: &[&str]| {
            let line = ["netmesh", "points.xyz"].iter().chain(arguments);
            Arguments::parse_from(line).options()
        };
        for row in TABLE.iter().filter(|row| heading(row).is_some()) {
            let given = match row.kind {
                Kind::Number { .. } => vec![("0.75", Value::Number(0.75))],
                Kind::Whole(_) => vec![("7", Value::Whole(7))],
                Kind::Switch => panic!("{} has no value", row.name),
                Kind::Words(words) => {
                    let words = words.iter().map(|word| word.argument);
                    words.zip((0..).map(Value::Word)).collect()
                }
            };
            for (text, value) in given {
                let mut expected = Options::default();
                row.set(&mut expected, value);
                assert_eq!(options(&[&format!("--{}", row.argument()), text]), expected);
            }
        }
        let measured = Options { instruments: true, ..Options::default() };
        assert_eq!(options(&["--stats"]), measured);
        for (flag, output) in
            [("--finish", Output::WellSpaced), ("--hierarchical", Output::Hierarchical)]
        {
            assert_eq!(options(&[flag]), Options { output, ..Options::default() });
        }
    }
}
