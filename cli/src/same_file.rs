//! An output that would replace the input, by whatever path.

use crate::arguments::{Arguments, Product};
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{self, Format};
use std::fs;
use std::path::{Path, PathBuf};

/// Refuses outputs that are the input or each other.
pub fn require_distinct(arguments: &Arguments) -> Result<(), Failure> {
    let outputs = outputs(arguments)?;
    if let Some(json) = arguments.json.as_deref() {
        if outputs
            .iter()
            .chain(&all_parts(arguments)?)
            .any(|output| will_be_same(output, json) || are_same(output, json))
        {
            let message = format!(
                "{}: both the mesh and the JSON object would go here; name another file for --json",
                standard::output_name(json)
            );
            return Err(Failure::new(ExitCode::Usage, message));
        }
    }
    require_no_input(outputs.iter().chain(&arguments.json).chain(&arguments.diagnose), arguments)
}

/// Refuses files of segments and facets that are the input.
pub fn require_distinct_parts(parts: &[PathBuf], arguments: &Arguments) -> Result<(), Failure> {
    require_no_input(parts.iter(), arguments)
}

/// Refuses outputs that are the input.
fn require_no_input<'a>(
    mut outputs: impl Iterator<Item = &'a PathBuf>,
    arguments: &Arguments,
) -> Result<(), Failure> {
    if arguments.force {
        return Ok(());
    }
    let own = (!standard::is_meant(&arguments.input))
        .then(|| io::input_path(&arguments.input, arguments.input_format()));
    let further = arguments.with.iter().map(|path| io::input_path(path, Format::Auto));
    // An input that cannot be read is refused when it is opened, with the reason.
    let inputs: Vec<PathBuf> = own.into_iter().chain(further).filter_map(Result::ok).collect();
    match outputs.find(|output| inputs.iter().any(|input| are_same(input, output))) {
        None => Ok(()),
        Some(output) => {
            let message = format!(
                "{}: this is the input, which the output would replace; add --force to do so",
                output.display()
            );
            Err(Failure::new(ExitCode::Usage, message))
        }
    }
}

/// Returns the files that the mesh goes to.
pub fn outputs(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    match arguments.output.as_deref() {
        None => Ok(Vec::new()),
        Some(path) if standard::is_meant(path) || arguments.product() != Product::Mesh => {
            Ok(vec![path.to_path_buf()])
        }
        Some(path) => io::output_paths(path, arguments.output_format())
            .map_err(|error| Failure::writing(&path.display().to_string(), &error)),
    }
}

/// Returns the files that the mesh goes to besides, if it has a dimension and segments or facets.
pub fn parts(arguments: &Arguments, dim: usize) -> Result<Vec<PathBuf>, Failure> {
    match arguments.output.as_deref() {
        Some(path) if !standard::is_meant(path) && arguments.product() == Product::Mesh => {
            io::part_paths(path, arguments.output_format(), dim)
                .map_err(|error| Failure::writing(&path.display().to_string(), &error))
        }
        _ => Ok(Vec::new()),
    }
}

/// Returns the files that segments or facets of any dimension would make.
pub fn all_parts(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    Ok([parts(arguments, 2)?, parts(arguments, 3)?].concat())
}

/// Returns true for two names of a file that need not be there yet.
fn will_be_same(a: &Path, b: &Path) -> bool {
    let files = io::follow_links(a).ok().zip(io::follow_links(b).ok());
    files.is_some_and(|(a, b)| a == b)
}

/// Returns true for two names of one file, links too. A terminal may well be read and written.
fn are_same(a: &Path, b: &Path) -> bool {
    let files = fs::metadata(a).ok().zip(fs::metadata(b).ok());
    files.is_some_and(|(of_a, of_b)| {
        of_a.is_file() && of_b.is_file() && have_same_identity((a, &of_a), (b, &of_b))
    })
}

#[cfg(unix)]
fn have_same_identity((_, a): (&Path, &fs::Metadata), (_, b): (&Path, &fs::Metadata)) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn have_same_identity((a, _): (&Path, &fs::Metadata), (b, _): (&Path, &fs::Metadata)) -> bool {
    fs::canonicalize(a).ok().zip(fs::canonicalize(b).ok()).is_some_and(|(a, b)| a == b)
}
