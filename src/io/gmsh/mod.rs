//! Gmsh's `.msh`: version 4.1 is written; the nodes of versions 4.1 and 2 are read. As text: Gmsh
//! saves so if not told otherwise, and programs beside Gmsh often read nothing else.

mod elements;
mod groups;
mod write;

use super::text::{Line, Lines, Points, quoted};
use super::{PointCloud, Table};
use crate::error::{Error, Result};
use crate::mesh::LeftOut;
pub(super) use write::write;

pub(super) fn read(mut lines: Lines<'_>) -> Result<Table> {
    let mut version = None;
    let mut points = None;
    let mut left_out = LeftOut::default();
    while let Some(line) = lines.next()? {
        let section = match line.text.strip_prefix('$') {
            Some(section) if !section.starts_with("End") => section,
            _ => return Err(line.error(format!("{} is outside of a section", quoted(line.text)))),
        };
        match (section, version) {
            ("MeshFormat", _) => version = Some(Version::read(&mut lines)?),
            ("Nodes", None) => return Err(line.error("$Nodes before $MeshFormat")),
            ("Nodes", Some(version)) => {
                if points.is_some() {
                    return Err(line.error("a second section $Nodes"));
                }
                points = Some(read_nodes(&mut lines, version)?);
            }
            ("Elements", Some(version)) => {
                elements::leave_out(&mut lines, version, &mut left_out)?;
            }
            _ => {
                let section = section.to_string();
                skip_section(&mut lines, &section)?;
            }
        }
    }
    let points = points.ok_or_else(|| Error::format("no section $Nodes"))?;
    Ok(Table { left_out, ..Table::new(in_the_plane(points.finish()?), Vec::new()) })
}

#[derive(Clone, Copy)]
enum Version {
    /// A number of nodes, then a node per line with its id.
    Two,
    /// Blocks of nodes, one per entity: the ids first, then the coordinates.
    FourOne,
}

impl Version {
    fn read(lines: &mut Lines<'_>) -> Result<Self> {
        let lacks = || "the section $MeshFormat is not complete".into();
        let version = Self::of_line(&lines.require(lacks)?)?;
        require_end_of(lines, "MeshFormat")?;
        Ok(version)
    }

    fn of_line(line: &Line<'_>) -> Result<Self> {
        let mut words = line.words().map(|(_, word)| word);
        let version = match words.next() {
            Some("4.1") => Self::FourOne,
            Some(version) if version == "2" || version.starts_with("2.") => Self::Two,
            version => {
                let message = format!(
                    "version {}; versions 4.1 and 2 are read",
                    quoted(version.unwrap_or_default())
                );
                return Err(line.error(message));
            }
        };
        if words.next() != Some("0") {
            return Err(line.error("a binary file; only text is read (in Gmsh: Mesh.Binary = 0)"));
        }
        Ok(version)
    }
}

fn require_end_of(lines: &mut Lines<'_>, section: &str) -> Result<()> {
    let line = lines.require(|| format!("the section ${section} has no end"))?;
    if line.text.strip_prefix("$End") != Some(section) {
        let message = format!("{} where $End{section} is expected", quoted(line.text));
        return Err(line.error(message));
    }
    Ok(())
}

fn skip_section(lines: &mut Lines<'_>, section: &str) -> Result<()> {
    let lacks = || format!("the section {} has no end", quoted(section));
    while lines.require(lacks)?.text.strip_prefix("$End") != Some(section) {}
    Ok(())
}

fn read_nodes(lines: &mut Lines<'_>, version: Version) -> Result<Points> {
    let mut points = Points::of_dimension(3);
    match version {
        Version::Two => {
            let lacks = || "the number of nodes is missing".into();
            let [nodes] = lines.require(lacks)?.integers(["number of nodes"])?;
            for index in 0..nodes {
                let line = lines.require(|| format!("{index} of {nodes} nodes"))?;
                line.require_words(4)?;
                for (column, word) in line.words().take(1) {
                    line.integer(column, word, "node id")?;
                }
                points.add(&line, line.words().skip(1))?;
            }
        }
        Version::FourOne => read_blocks(lines, &mut points)?,
    }
    require_end_of(lines, "Nodes")?;
    Ok(points)
}

fn read_blocks(lines: &mut Lines<'_>, points: &mut Points) -> Result<()> {
    let header = lines.require(|| "the numbers of blocks and nodes are missing".into())?;
    let names = ["number of blocks", "number of nodes", "smallest node id", "largest node id"];
    let [blocks, nodes, _, _] = header.integers(names)?;
    let mut left = nodes;
    for index in 0..blocks {
        let line = lines.require(|| format!("{index} of {blocks} blocks of nodes"))?;
        let block = Block::read(&line)?;
        if block.nodes > left {
            let message = format!("{} nodes where {left} of {nodes} are left", block.nodes);
            return Err(line.error(message));
        }
        let lacks = |index: u64, left: u64| format!("{} of {nodes} nodes", nodes - left + index);
        for index in 0..block.nodes {
            lines.require(|| lacks(index, left))?.integers(["node id"])?;
        }
        for index in 0..block.nodes {
            let line = lines.require(|| lacks(index, left))?;
            line.require_words(block.columns)?;
            points.add(&line, line.words().take(3))?;
            for (column, word) in line.words().skip(3) {
                line.skip_number(column, word)?;
            }
        }
        left -= block.nodes;
    }
    match left {
        0 => Ok(()),
        _ => {
            let message = format!("the blocks hold {} of {nodes} nodes", nodes - left);
            Err(Error::format(message))
        }
    }
}

/// The line before the nodes of an entity.
struct Block {
    nodes: u64,
    /// Numbers in a node's line: its coordinates, and as many parameters as the entity has
    /// dimensions if there are any.
    columns: usize,
}

impl Block {
    fn read(line: &Line<'_>) -> Result<Self> {
        line.require_words(4)?;
        let mut counts = [0; 4];
        let names =
            ["dimension of an entity", "", "mark of parameters (0 or 1)", "number of nodes"];
        for (column, word) in line.words() {
            match column {
                // The entity's tag, which may be negative.
                1 => line.skip_number(column, word)?,
                _ => counts[column] = line.integer(column, word, names[column])?,
            }
        }
        let [dim, _, parametric, nodes] = counts;
        if dim > 3 || parametric > 1 {
            let message =
                "a block of nodes begins with: dimension (0 to 3) tag parametric (0 or 1) nodes";
            return Err(line.error(message));
        }
        Ok(Self { nodes, columns: 3 + (dim * parametric) as usize })
    }
}

/// Drops the third coordinate where all are zero: every node has three, those of planar meshes too.
fn in_the_plane(mut cloud: PointCloud) -> PointCloud {
    if cloud.coordinates.chunks_exact(3).any(|point| point[2] != 0.0) {
        return cloud;
    }
    let points = cloud.coordinates.len() / 3;
    for index in 0..points {
        cloud.coordinates.copy_within(3 * index..3 * index + 2, 2 * index);
    }
    cloud.coordinates.truncate(2 * points);
    PointCloud { dim: 2, ..cloud }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read, samples, write};
    use super::*;

    fn points(text: &str) -> Result<PointCloud> {
        read(&mut text.as_bytes(), Format::Gmsh)
    }

    #[test]
    fn nodes_of_both_versions_are_read() {
        let expected = PointCloud { dim: 3, coordinates: vec![1.0, 2.0, 3.0, -4.0, 5e9, -0.0] };
        for text in [
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n7 1 2 3\n3 -4 5e9 -0.0\n$EndNodes\n",
            "$MeshFormat\n2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a # b\"\n\
             $EndPhysicalNames\n\
             $Nodes\n2\n1 1 2 3\n2 -4 5e9 -0\n$EndNodes\n$Elements\n1\n1 15 0 1\n$EndElements\n",
            "$Comments\nanything $Nodes\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
             $Nodes\n3 2 1 9\n0 -1 0 1\n9\n1 2 3\n1 4 0 0\n2 1 1 1\n4\n-4 5e9 -0 0.5 0.25\n\
             $EndNodes\n",
            "$MeshFormat\r\n4.1 0 8\r\n$EndMeshFormat\r\n\r\n\
             $Nodes\r\n1 2 1 2\r\n3 1 0 2\r\n1\r\n2\r\n1 2 3\r\n-4 5e9 -0\r\n$EndNodes\r\n",
        ] {
            let read = points(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(read.dim, 3);
            samples::assert_same_bits(&read.coordinates, &expected.coordinates);
        }
    }

    #[test]
    fn points_without_height_are_planar() {
        let text = |z: &str| {
            format!(
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 1 2 0\n2 3 4 {z}\n$EndNodes\n"
            )
        };
        for zero in ["0", "-0.0", "1e-999"] {
            let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, 3.0, 4.0] };
            assert_eq!(points(&text(zero)).unwrap(), expected);
        }
        assert_eq!(points(&text("5e-324")).unwrap().dim, 3);
        assert_eq!(points(&text("-5e-324")).unwrap().dim, 3);
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in [2, 3] {
            let mesh = samples::mesh(dim);
            let mut text = Vec::new();
            write(&mesh, Format::Gmsh, &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::Gmsh).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &mesh.triangulation().unwrap().points);
        }
    }
}
