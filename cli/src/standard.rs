//! Standard input and output in the place of files: "-".

use std::path::Path;

pub fn is_meant(path: &Path) -> bool {
    path == Path::new("-")
}

/// Returns the name of an input in messages.
pub fn input_name(path: &Path) -> String {
    if is_meant(path) { "standard input".to_owned() } else { path.display().to_string() }
}

/// Returns the name of an output in messages.
pub fn output_name(path: &Path) -> String {
    if is_meant(path) { "standard output".to_owned() } else { path.display().to_string() }
}
