//! Gmsh's `.msh`: version 4.1 is written; the nodes of versions 4.1 and 2 are read. As text: Gmsh
//! saves so if not told otherwise, and programs beside Gmsh often read nothing else.

use super::PointCloud;
use super::attributes::Scalar;
use super::text::{Line, Lines, Points, quoted, write_number, write_point};
use crate::arrays::domains::simplices;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Attribute, Triangulation};
use std::io::{self, Write};

pub(super) fn read(mut lines: Lines<'_>) -> Result<PointCloud> {
    let mut version = None;
    let mut points = None;
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
            _ => {
                let section = section.to_string();
                skip_section(&mut lines, &section)?;
            }
        }
    }
    let points = points.ok_or_else(|| Error::new(ErrorKind::Format, "no section $Nodes"))?;
    Ok(in_the_plane(points.finish()?))
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
            Err(Error::new(ErrorKind::Format, message))
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
                "a block of nodes begins with: dimension (0..=3) tag parametric (0 or 1) nodes";
            return Err(line.error(message));
        }
        Ok(Self { nodes, columns: 3 + (dim * parametric) as usize })
    }
}

/// Every node has three coordinates, those of planar meshes too.
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

/// The section names, entities and the mesh; then what is known of nodes and elements.
pub(super) fn write(
    triangulation: &Triangulation,
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    write_entity(triangulation, out)?;
    write_nodes(triangulation, out)?;
    write_elements(triangulation, out)?;
    let kinds = triangulation.kinds.iter().map(|kind| *kind as u32);
    write_data(out, "Node", "kind", triangulation.vertex_count(), kinds)?;
    for attribute in attributes {
        write_attribute(attribute, out)?;
    }
    let domains = simplices(triangulation).map(|(_, domain)| domain);
    write_data(out, "Element", "domain", triangulation.simplex_count(), domains)
}

/// One surface or volume that holds everything, in a physical group.
fn write_entity(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let dim = triangulation.dim;
    out.write_all(b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")?;
    write!(out, "$PhysicalNames\n1\n{dim} 1 \"mesh\"\n$EndPhysicalNames\n")?;
    let count = if dim == 2 { "0 0 1 0" } else { "0 0 0 1" };
    write!(out, "$Entities\n{count}\n1")?;
    for pick in [f64::min, f64::max] {
        for axis in 0..3 {
            let coordinates = triangulation.points.chunks_exact(dim).map(|point| point.get(axis));
            let bound = coordinates.map(|x| *x.unwrap_or(&0.0)).reduce(pick);
            out.write_all(b" ")?;
            write_number(out, bound.unwrap_or(0.0))?;
        }
    }
    out.write_all(b" 1 1 0\n$EndEntities\n")
}

fn write_nodes(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let (dim, nodes) = (triangulation.dim, triangulation.vertex_count());
    write!(out, "$Nodes\n1 {nodes} 1 {nodes}\n{dim} 1 0 {nodes}\n")?;
    (1..=nodes).try_for_each(|tag| writeln!(out, "{tag}"))?;
    for point in triangulation.points.chunks_exact(dim) {
        write_point(out, point, " ")?;
        out.write_all(if dim == 2 { b" 0\n" } else { b"\n" })?;
    }
    out.write_all(b"$EndNodes\n")
}

fn write_elements(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let (dim, elements) = (triangulation.dim, triangulation.simplex_count());
    let kind = if dim == 2 { 2 } else { 4 };
    write!(out, "$Elements\n1 {elements} 1 {elements}\n{dim} 1 {kind} {elements}\n")?;
    for (index, simplex) in triangulation.simplices.chunks_exact(dim + 1).enumerate() {
        write!(out, "{}", index + 1)?;
        simplex.iter().try_for_each(|vertex| write!(out, " {}", u64::from(*vertex) + 1))?;
        out.write_all(b"\n")?;
    }
    out.write_all(b"$EndElements\n")
}

/// Values at the nodes: Gmsh has scalars, and vectors of three components, which two are padded to.
fn write_attribute(attribute: &Attribute, out: &mut dyn Write) -> io::Result<()> {
    let Attribute { name, components, values, .. } = attribute;
    let nodes = values.len() / components;
    if !(2..=3).contains(components) {
        for k in 0..*components {
            let name = Scalar(attribute, k);
            write!(out, "$NodeData\n1\n\"{name}\"\n1\n0\n3\n0\n1\n{nodes}\n")?;
            for node in 0..nodes {
                write!(out, "{} ", node + 1)?;
                write_number(out, attribute.of(node)[k])?;
                out.write_all(b"\n")?;
            }
            out.write_all(b"$EndNodeData\n")?;
        }
        return Ok(());
    }
    write!(out, "$NodeData\n1\n\"{name}\"\n1\n0\n3\n0\n3\n{nodes}\n")?;
    for node in 0..nodes {
        write!(out, "{} ", node + 1)?;
        write_point(out, attribute.of(node), " ")?;
        out.write_all(if *components == 2 { b" 0\n" } else { b"\n" })?;
    }
    out.write_all(b"$EndNodeData\n")
}

/// A number for each node or element, which Gmsh shows as a view.
fn write_data(
    out: &mut dyn Write,
    what: &str,
    name: &str,
    count: usize,
    values: impl Iterator<Item = u32>,
) -> io::Result<()> {
    write!(out, "${what}Data\n1\n\"{name}\"\n1\n0\n3\n0\n1\n{count}\n")?;
    for (index, value) in values.enumerate() {
        writeln!(out, "{} {value}", index + 1)?;
    }
    writeln!(out, "$End{what}Data")
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
            "$MeshFormat\n2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a # b\"\n$EndPhysicalNames\n\
             $Nodes\n2\n1 1 2 3\n2 -4 5e9 -0\n$EndNodes\n$Elements\n1\n1 15 0 1\n$EndElements\n",
            "$Comments\nanything $Nodes\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
             $Nodes\n3 2 1 9\n0 -1 0 1\n9\n1 2 3\n1 4 0 0\n2 1 1 1\n4\n-4 5e9 -0 0.5 0.25\n$EndNodes\n",
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

    #[test]
    fn a_planar_mesh_is_one_surface() {
        let mut text = Vec::new();
        write(&samples::square(), Format::Gmsh, &mut text).unwrap();
        let expected = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
            $PhysicalNames\n1\n2 1 \"mesh\"\n$EndPhysicalNames\n\
            $Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n\
            $Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n\
            $Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 1 3 4\n$EndElements\n\
            $NodeData\n1\n\"kind\"\n1\n0\n3\n0\n1\n4\n1 0\n2 0\n3 1\n4 2\n$EndNodeData\n\
            $ElementData\n1\n\"domain\"\n1\n0\n3\n0\n1\n2\n1 0\n2 0\n$EndElementData\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }
}
