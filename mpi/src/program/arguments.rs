//! The command line: the words of `netmesh`, as far as they are for several ranks.

use crate::exit_code;
use crate::whole::whole;
use clap::{Parser, ValueEnum};
use netmesh::{Criterion, GivesWay, NetOrdering, Options, Output};
use std::path::PathBuf;

pub const EXAMPLES: &str = "\
Examples:
  mpirun -np 8 netmesh-mpi points.npy -o mesh.pvtu
  mpirun -np 8 netmesh-mpi points.xyz -o mesh.npy --finish --bound 3.5";

/// The heading of options that `netmesh` has and meshes of several ranks cannot have.
const REFUSED: &str = "Always refused: ask netmesh, on one process";

/// Mesh points on the ranks of an MPI program: in goes a file of points, out comes the mesh that
/// netmesh makes of them on one process, in parts.
///
/// Each rank reads its part of the input and writes its part of the output; all must see the same
/// files, and be called with the same options but for --threads. The number of coordinates in the input
/// is the dimension, 2 or 3.
#[derive(Clone, Debug, Parser)]
#[command(name = "netmesh-mpi", version, after_help = format!("{EXAMPLES}\n\n{}", exit_code::HELP))]
pub struct Arguments {
    /// File of points: a NumPy array (.npy), or a line each (.xyz)
    pub input: PathBuf,

    /// Where the mesh goes: NAME.pvtu, with a NAME_RANK.vtu of each rank; or NAME.npy, for
    /// NAME.points.npy and NAME.simplices.npy. Without it only the summary is made
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the input, where the extension does not tell
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub input_format: Option<InputFormat>,

    /// Format of the output, where the extension does not tell
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub output_format: Option<OutputFormat>,

    /// Make a well-spaced mesh of one domain (FINISHMESH), also where nothing asks for one. An angle
    /// does; otherwise the mesh is hierarchical
    #[arg(long)]
    pub finish: bool,

    /// Make a hierarchical mesh, also where an angle asks for a well-spaced one; some triangles beside
    /// cages then miss the angle
    #[arg(long, conflicts_with = "finish")]
    pub hierarchical: bool,

    /// Check the mesh with the certificate checker, which has nothing from what made it
    #[arg(long)]
    pub validate: bool,

    /// Where a table goes of what every step of the run took on every rank: processor time, bytes
    /// that it has sent (comma-separated values)
    #[arg(long, value_name = "FILE")]
    pub work: Option<PathBuf>,

    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,

    #[command(flatten)]
    pub meshing: Meshing,
}

/// Options of the algorithm.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Meshing")]
pub struct Meshing {
    /// How a round of inputs is chosen: by a seeded sample, or by nets without any random number
    #[arg(long, value_enum, default_value_t = OrderingName::Sampled)]
    pub ordering: OrderingName,

    /// The quality measure that --bound bounds
    #[arg(long, value_enum, default_value_t = CriterionName::Aspect)]
    pub criterion: CriterionName,

    /// Quality bound; by default aspect 3 in 2D, 4 in 3D, 5 in 4D and 6 above, or half of it as
    /// radius-edge ratio
    #[arg(long, visible_alias = "quality-bound", value_name = "X", allow_negative_numbers = true)]
    pub bound: Option<f64>,

    /// In 2D, the smallest angle of the triangles in degrees, up to 33.7, in place of --criterion
    /// and --bound
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["bound", "criterion"])]
    pub min_angle: Option<f64>,

    /// How far other points must be for a cage to start
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub epsilon: Option<f64>,

    /// Coarseness of a cage
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub delta: Option<f64>,

    /// Yield radius of a cage, relative to the distance to the nearest vertex
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub gamma: Option<f64>,

    /// Yield radius of refinement, relative to the D-ball's radius
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub yield_radius: Option<f64>,

    /// Outer encroachment factor of a cage
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub encroachment: Option<f64>,

    /// Radius of a cage relative to its domain
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub cage_scale: Option<f64>,

    /// Radius of the root ball relative to the input's bounding ball
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub root_scale: Option<f64>,

    /// Refused: meshes of several ranks have no bound by the distance to the input
    #[arg(long, value_name = "X", allow_negative_numbers = true, help_heading = REFUSED)]
    pub distance_ratio: Option<f64>,

    /// Refused: meshes of several ranks have no bound of dihedral angles
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = REFUSED)]
    pub min_dihedral: Option<f64>,

    /// Refused: meshes of several ranks have no sizes
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, help_heading = REFUSED)]
    pub max_edge: Option<f64>,

    /// Without effect, as --min-dihedral is refused
    #[arg(long, value_enum, default_value_t = GivesWayName::Angle, help_heading = REFUSED)]
    pub gives_way: GivesWayName,

    /// Seed of every random choice; the same seed makes the same mesh
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    #[arg(value_parser = whole::<u64>)]
    pub seed: u64,

    /// Stop with exit code 5 rather than make more vertices than this
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole::<u64>)]
    pub max_vertices: Option<u64>,

    /// Threads of each rank, 0 = all cores; the mesh does not depend on it
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true)]
    #[arg(value_parser = whole::<u32>)]
    pub threads: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OrderingName {
    Sampled,
    Deterministic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CriterionName {
    /// Voronoi aspect ratio: farthest corner over half the distance to the nearest neighbour
    Aspect,
    /// Circumradius over shortest edge of a simplex
    RadiusEdge,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GivesWayName {
    /// The angle: some tetrahedra stay below it
    Angle,
    /// The bound: some cells, or tetrahedra, go beyond it
    Bound,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum InputFormat {
    /// A NumPy array of points (.npy)
    Npy,
    /// Points as text, a line each (.xyz)
    Xyz,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OutputFormat {
    /// VTK's parallel unstructured grid (.pvtu)
    Pvtu,
    /// NumPy arrays of points and of simplices (.npy)
    Npy,
}

impl Arguments {
    pub fn input_format(&self) -> netmesh::io::Format {
        match self.input_format {
            None => netmesh::io::Format::Auto,
            Some(InputFormat::Npy) => netmesh::io::Format::Npy,
            Some(InputFormat::Xyz) => netmesh::io::Format::Xyz,
        }
    }

    pub fn output_format(&self) -> netmesh_mpi::output::Format {
        match self.output_format {
            None => netmesh_mpi::output::Format::Auto,
            Some(OutputFormat::Pvtu) => netmesh_mpi::output::Format::Pvtu,
            Some(OutputFormat::Npy) => netmesh_mpi::output::Format::Npy,
        }
    }

    pub fn options(&self) -> Options {
        let meshing = &self.meshing;
        let number = |given: Option<f64>| given.unwrap_or(0.0);
        Options {
            output: match (self.finish, self.hierarchical) {
                (true, _) => Output::WellSpaced,
                (_, true) => Output::Hierarchical,
                _ => Output::Auto,
            },
            ordering: match meshing.ordering {
                OrderingName::Sampled => NetOrdering::SampledNet,
                OrderingName::Deterministic => NetOrdering::DeterministicNet,
            },
            criterion: match meshing.criterion {
                CriterionName::Aspect => Criterion::VoronoiAspect,
                CriterionName::RadiusEdge => Criterion::RadiusEdge,
            },
            gives_way: match meshing.gives_way {
                GivesWayName::Angle => GivesWay::Angle,
                GivesWayName::Bound => GivesWay::Bound,
            },
            threads: meshing.threads,
            quality_bound: number(meshing.bound),
            epsilon: number(meshing.epsilon),
            delta: number(meshing.delta),
            gamma: number(meshing.gamma),
            yield_radius: number(meshing.yield_radius),
            encroachment: number(meshing.encroachment),
            cage_scale: number(meshing.cage_scale),
            root_scale: number(meshing.root_scale),
            distance_ratio: number(meshing.distance_ratio),
            min_angle: number(meshing.min_angle),
            min_dihedral: number(meshing.min_dihedral),
            max_edge: number(meshing.max_edge),
            seed: meshing.seed,
            max_vertices: meshing.max_vertices.unwrap_or(0),
            ..Options::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_help_lists_what_is_always_refused() {
        let help = Arguments::command().render_long_help().to_string();
        let (_, listed) = help.split_once(REFUSED).unwrap();
        for option in ["--distance-ratio", "--min-dihedral", "--max-edge"] {
            assert!(listed.contains(option), "{listed}");
        }
    }

    #[test]
    fn every_option_reaches_the_run() {
        let line = "netmesh-mpi in.npy --finish --ordering deterministic --criterion radius-edge --bound 1 \
                    --epsilon 2 --delta 3 --gamma 4 --yield-radius 5 --encroachment 6 --cage-scale 7 \
                    --root-scale 8 --distance-ratio 9 --min-dihedral 10 --max-edge 11 --gives-way bound \
                    --seed 12 --max-vertices 13 --threads 14";
        let expected = Options {
            output: Output::WellSpaced,
            ordering: NetOrdering::DeterministicNet,
            criterion: Criterion::RadiusEdge,
            gives_way: GivesWay::Bound,
            quality_bound: 1.0,
            epsilon: 2.0,
            delta: 3.0,
            gamma: 4.0,
            yield_radius: 5.0,
            encroachment: 6.0,
            cage_scale: 7.0,
            root_scale: 8.0,
            distance_ratio: 9.0,
            min_dihedral: 10.0,
            max_edge: 11.0,
            seed: 12,
            max_vertices: 13,
            threads: 14,
            ..Options::default()
        };
        assert_eq!(Arguments::parse_from(line.split_whitespace()).options(), expected);
        let angle = Arguments::parse_from(["netmesh-mpi", "in.npy", "--min-angle", "25"]).options();
        assert_eq!(angle, Options { min_angle: 25.0, ..Options::default() });
        let named = Arguments::parse_from(["netmesh-mpi", "in.npy", "--hierarchical"]).options();
        assert_eq!(named, Options { output: Output::Hierarchical, ..Options::default() });
    }
}
