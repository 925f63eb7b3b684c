//! Sizes at points, those of the input or of a background, from a file as TetGen's `.mtr`: a line
//! with the number of points, then a line a point whose first number is the size. `#` begins a
//! comment.

use crate::exit_code::{ExitCode, Failure};
use crate::words::in_options;
use netmesh::io::{Choice, Format, PointCloud, read_points, read_table_file};
use netmesh::{Algorithm, Attribute, Mesh, Options};
use std::path::Path;

/// Gives `mesh` the sizes in a file.
pub fn set(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let sizes = read(path, mesh.inputs().count())?;
    mesh.set_sizes(&sizes).map_err(|error| refusal(path, &in_options(&error)))
}

/// Gives `mesh` sizes on the Delaunay triangulation of the points in a file.
pub fn set_background(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let (points, sizes) = read_background(path)?;
    let refuse = |error: netmesh::Error| refusal(path, &in_options(&error));
    let PointCloud { dim, coordinates } = &points;
    let mut background = Mesh::new(*dim, sizes.len(), coordinates, 0).map_err(refuse)?;
    let plain = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    background.run(&plain, None).map_err(refuse)?;
    let inputs = background.inputs();
    let of_vertex = |vertex: usize| sizes[inputs.first_input(vertex).unwrap_or(0) as usize];
    let at_vertices: Vec<f64> = (0..inputs.distinct()).map(of_vertex).collect();
    let triangulation = background.result().map_err(refuse)?;
    mesh.set_background(Some((triangulation, &at_vertices))).map_err(refuse)
}

/// Points, and a size for each.
fn read_background(path: &Path) -> Result<(PointCloud, Vec<f64>), Failure> {
    let refuse = |error: netmesh::Error| refusal(path, &in_options(&error));
    let beside = path.with_extension("mtr");
    if beside.exists() {
        let points = read_points(path, Format::Auto).map_err(refuse)?;
        let sizes = read(&beside, points.coordinates.len() / points.dim)?;
        return Ok((points, sizes));
    }
    let is_node = matches!(Format::from_path(path), Ok(Format::TetgenNode));
    let attributes = if is_node { "size=1" } else { "size" }.parse().map_err(refuse)?;
    let choice = Choice { attributes, ..Choice::default() };
    let mut table = read_table_file(path, Format::Auto, &choice).map_err(refuse)?;
    match table.attributes.pop() {
        Some(Attribute { values, .. }) => Ok((table.points, values)),
        None => Err(refusal(path, "it has no attribute \"size\"")),
    }
}

/// The sizes in a file, one for each of `count` points.
fn read(path: &Path, count: usize) -> Result<Vec<f64>, Failure> {
    let refuse = |message: String| refusal(path, &message);
    let text = std::fs::read_to_string(path).map_err(|error| refuse(error.to_string()))?;
    let sizes = parse(&text).map_err(refuse)?;
    match sizes.len() == count {
        true => Ok(sizes),
        false => Err(refuse(format!("{} sizes for {count} points", sizes.len()))),
    }
}

fn refusal(path: &Path, message: &str) -> Failure {
    Failure::new(ExitCode::InputUnreadable, format!("{}: {message}", path.display()))
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
