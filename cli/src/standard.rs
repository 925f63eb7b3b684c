//! Standard input and output in the place of files: "-".

use std::path::Path;

pub fn is_meant(path: &Path) -> bool {
    path == Path::new("-")
}

/// How messages call an input.
pub fn input_name(path: &Path) -> String {
    if is_meant(path) { "standard input".to_owned() } else { path.display().to_string() }
}

/// How messages call an output.
pub fn output_name(path: &Path) -> String {
    if is_meant(path) { "standard output".to_owned() } else { path.display().to_string() }
}
