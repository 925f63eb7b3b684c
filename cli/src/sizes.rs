//! Sizes at points, those of the input or of a background, from a file as TetGen's `.mtr`: a line
//! with the number of points and of values each, then a line a point with its size. `#` begins a
//! comment.

use crate::exit_code::{ExitCode, Failure};
use netmesh::io::{self, Choice, Format, PointCloud, read_points, read_table_file};
use netmesh::{Algorithm, Attribute, Mesh, Options};
use std::path::Path;

/// Gives `mesh` the sizes in a file.
pub fn set(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let sizes = read(path, mesh.inputs().count())?;
    mesh.set_sizes(&sizes).map_err(|error| using(path, &error))
}

/// Gives `mesh` sizes on the Delaunay triangulation of the points in a file.
pub fn set_background(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let (points, sizes) = read_background(path)?;
    let refuse = |error: netmesh::Error| using(path, &error);
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

/// Reads points, and a size for each.
fn read_background(path: &Path) -> Result<(PointCloud, Vec<f64>), Failure> {
    let name = path.display().to_string();
    let reading = |error: netmesh::Error| Failure::reading(&name, &error);
    // An unknown format is no fault of the file.
    io::input_path(path, Format::Auto).map_err(reading)?;
    let beside = path.with_extension("mtr");
    if beside.exists() {
        let points = read_points(path, Format::Auto).map_err(reading)?;
        let sizes = read(&beside, points.coordinates.len() / points.dim)?;
        return Ok((points, sizes));
    }
    // Attributes of a .node file have no names: there may be one.
    let is_node = matches!(Format::from_path(path), Ok(Format::TetgenNode));
    let attributes = if is_node { "all" } else { "size" }.parse().map_err(reading)?;
    let choice = Choice { attributes, ..Choice::default() };
    let table = read_table_file(path, Format::Auto, &choice);
    let mut table = table.map_err(|error| using(path, &error))?;
    match (table.attributes.pop(), table.attributes.len()) {
        (Some(Attribute { values, .. }), 0) => Ok((table.points, values)),
        (None, _) => Err(refused(path, "it has no attribute \"size\"")),
        (Some(_), others) => {
            let message = format!(
                "{} attributes a point, and no names for them; a size is one, or in a .mtr file \
                 beside",
                others + 1
            );
            Err(refused(path, &message))
        }
    }
}

/// Returns the sizes in a file, one for each of `count` points.
fn read(path: &Path, count: usize) -> Result<Vec<f64>, Failure> {
    let text = std::fs::read_to_string(path);
    let text = text.map_err(|error| malformed(path, &error.to_string()))?;
    let sizes = parse(&text).map_err(|fault| match fault {
        Fault::Malformed(message) => malformed(path, &message),
        Fault::Refused(message) => refused(path, &message),
    })?;
    match sizes.len() == count {
        true => Ok(sizes),
        false => Err(refused(path, &format!("{} sizes for {count} points", sizes.len()))),
    }
}

fn using(path: &Path, error: &netmesh::Error) -> Failure {
    Failure::using(&path.display().to_string(), error)
}

fn malformed(path: &Path, message: &str) -> Failure {
    Failure::new(ExitCode::InputUnreadable, format!("{}: {message}", path.display()))
}

fn refused(path: &Path, message: &str) -> Failure {
    Failure::new(ExitCode::InputRefused, format!("{}: {message}", path.display()))
}

/// Why no sizes come of a text.
#[derive(Debug, PartialEq)]
enum Fault {
    /// It is no such file.
    Malformed(String),
    /// It is one, of something else than sizes.
    Refused(String),
}

fn parse(text: &str) -> Result<Vec<f64>, Fault> {
    let malformed = |message: String| Fault::Malformed(message);
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or("").trim());
    let mut lines = (1..).zip(lines).filter(|(_, line)| !line.is_empty());
    let empty = "it is empty; the first line has the number of points";
    let (number, head) = lines.next().ok_or_else(|| malformed(empty.to_owned()))?;
    let counts: Result<Vec<usize>, _> = head.split_whitespace().map(str::parse).collect();
    let (count, values) = match counts.as_deref() {
        Ok([count]) => (*count, 1),
        Ok([count, values]) => (*count, *values),
        _ => {
            let message = format!(
                "line {number}: {head}; the first line has the number of points, and that of \
                 values at each, 1"
            );
            return Err(malformed(message));
        }
    };
    if values != 1 {
        let message = format!(
            "line {number}: {values} values a point, as metric tensors have them; a size is one \
             number, the length that edges shall have"
        );
        return Err(Fault::Refused(message));
    }
    let mut sizes = Vec::new();
    for (number, line) in lines {
        let mut words = line.split_whitespace();
        let size = words.next().unwrap_or("").parse();
        let size =
            size.map_err(|_| malformed(format!("line {number}: {line}; a size is a number")))?;
        let others = words.count();
        if others > 0 {
            let message =
                format!("line {number}: {line}; a size is one number, and here are {}", others + 1);
            return Err(malformed(message));
        }
        sizes.push(size);
    }
    if sizes.len() != count {
        let message = format!("it has {} sizes, and its first line says {count}", sizes.len());
        return Err(malformed(message));
    }
    Ok(sizes)
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
            ("x 1\n0.5\n", "line 1: x 1; the first line has the number of points, and that of"),
            ("1 1 1\n0.5\n", "line 1: 1 1 1; the first line"),
            ("1 1.0\n0.5\n", "line 1: 1 1.0; the first line"),
            ("-1 1\n0.5\n", "line 1: -1 1; the first line"),
            ("2 1\n0.5\n", "it has 1 sizes, and its first line says 2"),
            ("2 1\n0.5\n\nsmall\n", "line 4: small; a size is a number"),
            ("2 1\n0.5\n1 0.2\n", "line 3: 1 0.2; a size is one number, and here are 2"),
            ("2\n0.5\n1 0 1\n", "line 3: 1 0 1; a size is one number, and here are 3"),
        ] {
            let fault = parse(text).unwrap_err();
            let Fault::Malformed(message) = &fault else { panic!("{text}: {fault:?}") };
            assert!(message.starts_with(words), "{message}");
        }
    }

    /// Three values in the plane, or six in space, are a tensor and no length.
    #[test]
    fn tensors_are_no_sizes() {
        for (text, words) in [
            ("2 3\n1 0 1\n4 0 4\n", "line 1: 3 values a point, as metric tensors have them"),
            ("# in space\n1 6\n1 0 0 1 0 1\n", "line 2: 6 values a point, as metric"),
            ("2 0\n", "line 1: 0 values a point"),
        ] {
            let fault = parse(text).unwrap_err();
            let Fault::Refused(message) = &fault else { panic!("{text}: {fault:?}") };
            assert!(message.starts_with(words), "{message}");
        }
        assert_eq!(parse("2\n0.5\n0.25\n"), Ok(vec![0.5, 0.25]));
    }
}
