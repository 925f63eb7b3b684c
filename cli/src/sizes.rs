//! Sizes at the points of the input, from a file as TetGen's `.mtr`: a line with the number of
//! points, then a line a point whose first number is the size. `#` begins a comment.

use crate::exit_code::{ExitCode, Failure};
use netmesh::Mesh;
use std::path::Path;

/// Gives `mesh` the sizes in a file.
pub fn set(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let refuse = |message: String| {
        Failure::new(ExitCode::InputUnreadable, format!("{}: {message}", path.display()))
    };
    let text = std::fs::read_to_string(path).map_err(|error| refuse(error.to_string()))?;
    let sizes = parse(&text).map_err(&refuse)?;
    let count = mesh.inputs().count();
    if sizes.len() != count {
        return Err(refuse(format!("{} sizes for {count} points", sizes.len())));
    }
    mesh.set_sizes(&sizes).map_err(|error| refuse(error.message().to_owned()))
}

fn parse(text: &str) -> Result<Vec<f64>, String> {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or("").trim());
    let mut lines = lines.zip(1..).filter(|(line, _)| !line.is_empty());
    let (head, _) = lines.next().ok_or("it is empty; the first line has the number of points")?;
    let count: usize = first(head)
        .parse()
        .map_err(|_| format!("line 1: {head}; the first number is the number of points"))?;
    let mut sizes = Vec::new();
    for (line, number) in lines {
        let size = first(line).parse();
        sizes.push(size.map_err(|_| format!("line {number}: {line}; a line begins with a size"))?);
    }
    if sizes.len() != count {
        return Err(format!("it has {} sizes, and its first line says {count}", sizes.len()));
    }
    Ok(sizes)
}

fn first(line: &str) -> &str {
    line.split_whitespace().next().unwrap_or("")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_tetgen_are_read() {
        let text = "# from TetGen\n3 1\n0.5\n 1e-3 # fine\n\ninf\n";
        assert_eq!(parse(text), Ok(vec![0.5, 1e-3, f64::INFINITY]));
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        for (text, words) in [
            ("", "it is empty"),
            ("x 1\n0.5\n", "line 1: x 1; the first number"),
            ("2 1\n0.5\n", "it has 1 sizes, and its first line says 2"),
            ("2 1\n0.5\n\nsmall\n", "line 4: small; a line begins with a size"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.starts_with(words), "{message}");
        }
    }
}
