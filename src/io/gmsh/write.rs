//! Version 4.1: elements stand by the physical group that they are of, which is an entity of its
//! own.

use super::groups::{Group, Groups};
use crate::arrays::domains::domain_of;
use crate::io::allocation_failed;
use crate::io::attributes::Scalar;
use crate::io::text::{write_number, write_point};
use crate::memory::AllocResult;
use crate::mesh::{Attribute, NONE, Triangulation};
use std::io::{self, Write};

/// Writes the section names, entities and the mesh; then the data of nodes and elements.
pub(in crate::io) fn write(
    triangulation: &Triangulation,
    markers: &[i32],
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let elements = Elements::new(triangulation, markers).map_err(allocation_failed)?;
    out.write_all(b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")?;
    elements.write_names(out)?;
    elements.write_entities(out)?;
    elements.write_nodes(out)?;
    elements.write_elements(out)?;
    let kinds = triangulation.kinds.iter().zip(1..).map(|(kind, node)| (node, *kind as u32));
    write_data(out, "Node", "kind", triangulation.vertex_count(), kinds)?;
    for attribute in attributes {
        write_attribute(attribute, out)?;
    }
    write_data(out, "Element", "domain", elements.count(), elements.domains())
}

/// Triangles or tetrahedra, by the labels of their regions, and the edges of segments, by the
/// markers of these. Simplex s is element s + 1; the edges follow.
struct Elements<'a> {
    mesh: &'a Triangulation,
    /// True if there are labels or markers at all.
    is_labelled: bool,
    simplices: Groups,
    edges: Option<Groups>,
}

impl<'a> Elements<'a> {
    fn new(mesh: &'a Triangulation, markers: &[i32]) -> AllocResult<Self> {
        let boundary = &mesh.boundary;
        let label = |simplex| boundary.simplex_regions.get(simplex).copied().unwrap_or(0);
        let marker = |edge: usize| markers.get(boundary.parents[edge] as usize).copied();
        Ok(Self {
            mesh,
            is_labelled: boundary.has_any(),
            simplices: Groups::new(mesh.simplex_count(), label)?,
            edges: match boundary.subsegments.len() {
                0 => None,
                count => Some(Groups::new(count, |edge| marker(edge).unwrap_or(0))?),
            },
        })
    }

    fn count(&self) -> usize {
        self.mesh.simplex_count() + self.mesh.boundary.subsegments.len()
    }

    /// Returns the groups of edges.
    fn curves(&self) -> impl Iterator<Item = (Group, &[u32])> {
        self.edges.iter().flat_map(Groups::iter)
    }

    fn vertices_of(&self, simplex: u32) -> &[u32] {
        let size = self.mesh.dim + 1;
        &self.mesh.simplices[simplex as usize * size..][..size]
    }

    fn ends_of(&self, edge: u32) -> &[u32] {
        &self.mesh.boundary.subsegments[edge as usize]
    }

    fn tag_of_edge(&self, edge: u32) -> u64 {
        self.mesh.simplex_count() as u64 + u64::from(edge) + 1
    }

    fn write_names(&self, out: &mut dyn Write) -> io::Result<()> {
        let dim = self.mesh.dim;
        let simplices = self.simplices.all();
        let edges = self.edges.as_ref().map_or(&[][..], Groups::all);
        writeln!(out, "$PhysicalNames\n{}", simplices.len() + edges.len())?;
        for Group { label, tag, .. } in edges {
            writeln!(out, "1 {tag} \"marker_{label}\"")?;
        }
        for Group { label, tag, .. } in simplices {
            match self.is_labelled {
                true => writeln!(out, "{dim} {tag} \"region_{label}\"")?,
                false => writeln!(out, "{dim} {tag} \"mesh\"")?,
            }
        }
        out.write_all(b"$EndPhysicalNames\n")
    }

    fn write_entities(&self, out: &mut dyn Write) -> io::Result<()> {
        let (simplices, curves) = (self.simplices.all().len(), self.curves().count());
        let [surfaces, volumes] = if self.mesh.dim == 2 { [simplices, 0] } else { [0, simplices] };
        writeln!(out, "$Entities\n0 {curves} {surfaces} {volumes}")?;
        for (group, edges) in self.curves() {
            self.write_entity(group, edges.iter().flat_map(|&edge| self.ends_of(edge)), out)?;
        }
        for (group, simplices) in self.simplices.iter() {
            let vertices = simplices.iter().flat_map(|&simplex| self.vertices_of(simplex));
            self.write_entity(group, vertices, out)?;
        }
        out.write_all(b"$EndEntities\n")
    }

    /// Writes number, box, physical groups and bounding entities of an entity.
    fn write_entity<'v>(
        &self,
        Group { tag, .. }: Group,
        vertices: impl Iterator<Item = &'v u32>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in vertices {
            for (axis, x) in self.mesh.point(*vertex).iter().enumerate() {
                bounds[0][axis] = bounds[0][axis].min(*x);
                bounds[1][axis] = bounds[1][axis].max(*x);
            }
        }
        write!(out, "{tag}")?;
        for bound in bounds.as_flattened() {
            out.write_all(b" ")?;
            write_number(out, if bound.is_finite() { *bound } else { 0.0 })?;
        }
        writeln!(out, " 1 {tag} 0")
    }

    /// Writes all nodes in the first entity of simplices: which one a node of several is in says
    /// nothing here.
    fn write_nodes(&self, out: &mut dyn Write) -> io::Result<()> {
        let (dim, nodes) = (self.mesh.dim, self.mesh.vertex_count());
        let entity = self.simplices.all().first().map_or(1, |group| group.tag);
        write!(out, "$Nodes\n1 {nodes} 1 {nodes}\n{dim} {entity} 0 {nodes}\n")?;
        (1..=nodes).try_for_each(|tag| writeln!(out, "{tag}"))?;
        for point in self.mesh.points.chunks_exact(dim) {
            write_point(out, point, " ")?;
            out.write_all(if dim == 2 { b" 0\n" } else { b"\n" })?;
        }
        out.write_all(b"$EndNodes\n")
    }

    fn write_elements(&self, out: &mut dyn Write) -> io::Result<()> {
        let (dim, count) = (self.mesh.dim, self.count());
        let blocks = self.simplices.all().len() + self.curves().count();
        write!(out, "$Elements\n{blocks} {count} 1 {count}\n")?;
        let kind = if dim == 2 { TRIANGLE } else { TETRAHEDRON };
        for (Group { tag, .. }, simplices) in self.simplices.iter() {
            writeln!(out, "{dim} {tag} {kind} {}", simplices.len())?;
            for &simplex in simplices {
                write_element(out, u64::from(simplex) + 1, self.vertices_of(simplex))?;
            }
        }
        for (Group { tag, .. }, edges) in self.curves() {
            writeln!(out, "1 {tag} {LINE} {}", edges.len())?;
            for &edge in edges {
                write_element(out, self.tag_of_edge(edge), self.ends_of(edge))?;
            }
        }
        out.write_all(b"$EndElements\n")
    }

    /// Returns each element with its domain, 0 where there is none, in the order of the file:
    /// programs beside Gmsh take the values one after the other.
    fn domains(&self) -> impl Iterator<Item = (u64, u32)> {
        let simplices = self.simplices.iter().flat_map(|(_, simplices)| simplices);
        let simplices = simplices.map(|&s| (u64::from(s) + 1, self.vertices_of(s)));
        let edges = self.curves().flat_map(|(_, edges)| edges);
        let edges = edges.map(|&edge| (self.tag_of_edge(edge), self.ends_of(edge)));
        simplices.chain(edges).map(|(tag, vertices)| match domain_of(self.mesh, vertices) {
            NONE => (tag, 0),
            domain => (tag, domain),
        })
    }
}

const LINE: u8 = 1;
const TRIANGLE: u8 = 2;
const TETRAHEDRON: u8 = 4;

fn write_element(out: &mut dyn Write, tag: u64, vertices: &[u32]) -> io::Result<()> {
    write!(out, "{tag}")?;
    vertices.iter().try_for_each(|vertex| write!(out, " {}", u64::from(*vertex) + 1))?;
    out.write_all(b"\n")
}

/// Writes values at the nodes: Gmsh has scalars, and vectors of three components, which two are
/// padded to.
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

/// Writes a number for each node or element, which Gmsh shows as a view.
fn write_data(
    out: &mut dyn Write,
    what: &str,
    name: &str,
    count: usize,
    values: impl Iterator<Item = (u64, u32)>,
) -> io::Result<()> {
    write!(out, "${what}Data\n1\n\"{name}\"\n1\n0\n3\n0\n1\n{count}\n")?;
    for (tag, value) in values {
        writeln!(out, "{tag} {value}")?;
    }
    writeln!(out, "$End{what}Data")
}

#[cfg(test)]
mod tests {
    use super::super::super::{Format, samples, write};

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

    #[test]
    fn labels_and_markers_are_physical_groups() {
        let mut text = Vec::new();
        write(&samples::square_with_segments(), Format::Gmsh, &mut text).unwrap();
        let nodes = "1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
        let expected = format!(
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n\
             1 1 \"marker_-5\"\n1 6 \"marker_6\"\n2 1 \"region_-8\"\n2 7 \"region_7\"\n\
             $EndPhysicalNames\n$Entities\n0 2 2 0\n1 0 0 0 1 1 0 1 1 0\n6 0 0 0 1 0 0 1 6 0\n\
             1 0 0 0 1 1 0 1 1 0\n7 0 0 0 1 1 0 1 7 0\n$EndEntities\n$Nodes\n{nodes}$EndNodes\n\
             $Elements\n4 4 1 4\n2 1 2 1\n2 1 3 4\n2 7 2 1\n1 1 2 3\n1 1 1 1\n3 1 3\n1 6 1 1\n\
             4 2 1\n\
             $EndElements\n\
             $NodeData\n1\n\"kind\"\n1\n0\n3\n0\n1\n4\n1 0\n2 0\n3 1\n4 2\n$EndNodeData\n\
             $ElementData\n1\n\"domain\"\n1\n0\n3\n0\n1\n4\n2 0\n1 0\n3 0\n4 0\n$EndElementData\n"
        );
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }
}
