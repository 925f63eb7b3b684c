//! Arguments of the command line: those of `netmesh`, as far as they are for several ranks.

use crate::exit_code;
use crate::meshing::Meshing;
use clap::{Parser, ValueEnum};
use netmesh::options::Row;
use netmesh::{Options, Output};
use std::path::PathBuf;

pub const EXAMPLES: &str = "\
Examples:
  mpirun -np 8 netmesh-mpi points.npy -o mesh.pvtu
  mpirun -np 8 netmesh-mpi points.xyz -o mesh.npy --finish --bound 3.5";

/// Heading of options that `netmesh` has and meshes of several ranks cannot have.
const REFUSED: &str = "Always refused: ask netmesh, on one process";

/// Mesh points on the ranks of an MPI program: in goes a file of points, out comes the mesh that
/// netmesh makes of them on one process, in parts.
///
/// Each rank reads its part of the input and writes its part of the output; all must see the same
/// files, and be called with the same options but for --threads. The number of coordinates in the
/// input is the dimension, 2 or 3.
#[derive(Clone, Debug, Parser)]
#[command(name = "netmesh-mpi", version, after_help = format!("{EXAMPLES}\n\n{}", exit_code::HELP))]
pub struct Arguments {
    /// File of points: a NumPy array (.npy), or a line each (.xyz)
    pub input: PathBuf,

    /// File for the mesh: NAME.pvtu, with a NAME_RANK.vtu of each rank; or NAME.npy, for
    /// NAME.points.npy and NAME.simplices.npy. Without it only the summary is made
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the input, where the extension does not tell
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub input_format: Option<InputFormat>,

    /// Format of the output, where the extension does not tell
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub output_format: Option<OutputFormat>,

    /// Make a well-spaced mesh of one domain (FINISHMESH), also where nothing asks for one. An
    /// angle does; otherwise the mesh is hierarchical
    #[arg(long)]
    pub finish: bool,

    /// Make a hierarchical mesh, also where an angle asks for a well-spaced one; some triangles
    /// beside cages then miss the angle
    #[arg(long, conflicts_with = "finish")]
    pub hierarchical: bool,

    /// Check the mesh with the certificate checker, which has nothing from what made it
    #[arg(long)]
    pub validate: bool,

    /// File for a table of what every step of the run took on every rank: processor time, bytes
    /// that it has sent (comma-separated values)
    #[arg(long, value_name = "FILE")]
    pub work: Option<PathBuf>,

    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,

    #[command(flatten)]
    pub meshing: Meshing,
}

/// Returns the heading under which the program has an option of the library, if it has it by name:
/// the kind of output has arguments of its own. Numbers that meshes of several ranks do not have
/// are refused by the run, which says so in the program's words.
pub fn heading(row: &Row) -> Option<&'static str> {
    match row.on_ranks {
        true if row.name == "output" => None,
        true => Some(row.group.heading()),
        false => row.is_number().then_some(REFUSED),
    }
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

    /// Returns the options of the run.
    pub fn options(&self) -> Options {
        Options {
            output: match (self.finish, self.hierarchical) {
                (true, _) => Output::WellSpaced,
                (_, true) => Output::Hierarchical,
                _ => Output::Auto,
            },
            ..self.meshing.options.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;
    use netmesh::{Criterion, GivesWay, NetOrdering};

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
        let line = "netmesh-mpi in.npy --finish --ordering deterministic --criterion radius-edge \
                    --bound 1 --epsilon 2 --delta 3 --gamma 4 --yield-radius 5 --encroachment 6 \
                    --cage-scale 7 --root-scale 8 --distance-ratio 9 --min-dihedral 10 --max-edge \
                    11 --gives-way bound --seed 12 --max-vertices 13 --threads 14";
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
