//! Files of the mesh and of the record. Whatever is wrong with them and can be known before the
//! work is said before the work.

use crate::arguments::{Arguments, Product};
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{self, Data, Format};
use netmesh::{Error, ErrorKind, Mesh};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Refuses a path that no file can be written to.
pub fn require_place(path: &Path) -> Result<(), Failure> {
    if standard::is_meant(path) {
        return Ok(());
    }
    let refuse = |reason: &str| {
        let message = format!("{}: {reason}", path.display());
        Err(Failure::new(ExitCode::OutputNotWritable, message))
    };
    if path.is_dir() {
        return refuse("is a directory; the output must be a file");
    }
    match path.parent() {
        Some(parent) if parent != Path::new("") && !parent.is_dir() => {
            refuse("the directory for the output does not exist")
        }
        _ => Ok(()),
    }
}

/// Refuses files that could not be written after the work, by trying now to write beside them.
pub fn require_writable(paths: &[PathBuf]) -> Result<(), Failure> {
    let files = paths.iter().filter(|path| !standard::is_meant(path));
    files.into_iter().try_for_each(|path| {
        require_place(path)?;
        io::require_writable(path).map_err(|error| failure(path, &error))
    })
}

/// Refuses standard output without a format, and for the format that is two files.
pub fn require_stream_format(path: &Path, format: Format) -> Result<(), Failure> {
    let refuse = |message: &str| Err(Failure::new(ExitCode::Usage, message));
    match format {
        _ if !standard::is_meant(path) => Ok(()),
        Format::Auto => refuse(
            "standard output has no name that tells the format; add --output-format, for example \
             --output-format off",
        ),
        Format::TetgenNode => refuse(
            "a TetGen mesh is two files and cannot go to standard output; name a file or another \
             --output-format",
        ),
        _ => Ok(()),
    }
}

/// Refuses a format that holds no attributes.
pub fn require_attributes(path: &Path, format: Format) -> Result<(), Failure> {
    let format = resolved(path, format)?;
    if format.holds_attributes() {
        return Ok(());
    }
    let message = format!(
        "{}: {} holds no attributes; with --attributes write VTU, TetGen, Gmsh, PLY, \
         CSV, NumPy or HTML",
        standard::output_name(path),
        format.name()
    );
    Err(Failure::new(ExitCode::Usage, message))
}

fn resolved(path: &Path, format: Format) -> Result<Format, Failure> {
    format.resolve_output(path).map_err(|error| failure(path, &error))
}

/// Refuses a format that cannot hold the mesh that is going to be made of `mesh`.
pub fn require_format(mesh: &Mesh, path: &Path, format: Format) -> Result<(), Failure> {
    match io::write(mesh, resolved(path, format)?, &mut Shut) {
        Err(error) if error.kind() == ErrorKind::InvalidArgument => Err(failure(path, &error)),
        // No result yet, or it came to writing: the format is right.
        _ => Ok(()),
    }
}

/// Returns true if the file of the mesh tells measures of it.
pub fn needs_measures(arguments: &Arguments) -> bool {
    let Some(path) = arguments.output.as_deref() else { return false };
    let format = arguments.output_format().resolve_output(path);
    arguments.product() == Product::Mesh && format.is_ok_and(Format::needs_measures)
}

/// Writes the mesh with data of its vertices.
pub fn write(mesh: &Mesh, data: Data<'_>, path: &Path, format: Format) -> Result<(), Failure> {
    let written = match standard::is_meant(path) {
        true => {
            let mut out = std::io::stdout().lock();
            io::write_with(mesh, data, format, &mut out)
        }
        false => io::write_file_with(mesh, data, path, format),
    };
    written.map_err(|error| failure(path, &error))
}

/// Writes a file of text: complete, or not at all. A device or a pipe is written into.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    io::write_text_file(path, text).map_err(|error| failure(path, &error))
}

fn failure(path: &Path, error: &Error) -> Failure {
    Failure::writing(&standard::output_name(path), error)
}

/// Takes nothing.
struct Shut;

impl Write for Shut {
    fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
        Err(std::io::ErrorKind::Unsupported.into())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
