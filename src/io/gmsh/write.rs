//! Version 4.1: elements stand by the physical group that they are of, which is an entity of its
//! own.

use super::groups::{Group, Groups};
use crate::arrays::domains::domain_of;
use crate::io::attributes::Scalar;
use crate::io::text::{write_number, write_point};
use crate::io::{Markers, allocation_failed};
use crate::memory::{AllocResult, with_capacity};
use crate::mesh::{Attribute, Boundary, NONE, Triangulation};
use std::io::{self, Write};

/// Writes the section names, entities and the mesh; then the data of nodes and elements.
pub(in crate::io) fn write(
    triangulation: &Triangulation,
    markers: Markers<'_>,
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

/// Simplices by the labels of their regions, and the triangles of facets and edges of segments by
/// the markers of these. Simplex s is element s + 1; the triangles follow, and then the edges.
struct Elements<'a> {
    mesh: &'a Triangulation,
    /// True if there are labels or markers at all.
    is_labelled: bool,
    /// Elements of one dimension each, from the highest down.
    families: Vec<Family<'a>>,
}

/// Elements of one dimension.
struct Family<'a> {
    dim: usize,
    /// Begin of the names of groups.
    name: &'static str,
    /// Vertices of the elements, one more than the dimension for each.
    vertices: &'a [u32],
    /// Tag of the first element.
    first: u64,
    groups: Groups,
}

impl<'a> Family<'a> {
    /// Makes a family of elements whose labels are given.
    fn new(
        name: &'static str,
        dim: usize,
        vertices: &'a [u32],
        first: u64,
        label: impl Fn(usize) -> i32,
    ) -> AllocResult<Self> {
        let groups = Groups::new(vertices.len() / (dim + 1), label)?;
        Ok(Self { dim, name, vertices, first, groups })
    }

    fn count(&self) -> usize {
        self.vertices.len() / (self.dim + 1)
    }

    fn vertices_of(&self, element: u32) -> &'a [u32] {
        &self.vertices[element as usize * (self.dim + 1)..][..self.dim + 1]
    }

    fn tag_of(&self, element: u32) -> u64 {
        self.first + u64::from(element)
    }
}

impl<'a> Elements<'a> {
    fn new(mesh: &'a Triangulation, markers: Markers<'_>) -> AllocResult<Self> {
        let Boundary { subsegments, parents, subfacets, subfacet_parents, .. } = &mesh.boundary;
        let label = |simplex| mesh.boundary.simplex_regions.get(simplex).copied().unwrap_or(0);
        let marker = |markers: &[i32], parent: u32| markers.get(parent as usize).copied();
        let of_facet = |at: usize| marker(markers.facets, subfacet_parents[at]).unwrap_or(0);
        let of_segment = |at: usize| marker(markers.segments, parents[at]).unwrap_or(0);
        // The boundary of what is meshed has markers; in space segments are something else.
        let name_of_edges = if mesh.dim == 2 { "marker" } else { "segment" };
        let mut families = with_capacity(3)?;
        families.push(Family::new("region", mesh.dim, &mesh.simplices, 1, label)?);
        let mut first = mesh.simplex_count() as u64 + 1;
        if !subfacets.is_empty() {
            families.push(Family::new("marker", 2, subfacets.as_flattened(), first, of_facet)?);
            first += subfacets.len() as u64;
        }
        if !subsegments.is_empty() {
            let ends = subsegments.as_flattened();
            families.push(Family::new(name_of_edges, 1, ends, first, of_segment)?);
        }
        Ok(Self { mesh, is_labelled: mesh.boundary.has_any(), families })
    }

    fn count(&self) -> usize {
        self.families.iter().map(Family::count).sum()
    }

    /// Returns the groups, family by family, and within each their elements.
    fn groups(&self) -> impl Iterator<Item = (&Family<'a>, Group, &[u32])> {
        self.families.iter().flat_map(|family| {
            family.groups.iter().map(move |(group, elements)| (family, group, elements))
        })
    }

    fn write_names(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "$PhysicalNames\n{}", self.groups().count())?;
        for Family { dim, name, groups, .. } in self.families.iter().rev() {
            for Group { label, tag, .. } in groups.all() {
                match self.is_labelled {
                    true => writeln!(out, "{dim} {tag} \"{name}_{label}\"")?,
                    false => writeln!(out, "{dim} {tag} \"mesh\"")?,
                }
            }
        }
        out.write_all(b"$EndPhysicalNames\n")
    }

    fn write_entities(&self, out: &mut dyn Write) -> io::Result<()> {
        let count = |dim| {
            let family = self.families.iter().find(|family| family.dim == dim);
            family.map_or(0, |family| family.groups.all().len())
        };
        writeln!(out, "$Entities\n0 {} {} {}", count(1), count(2), count(3))?;
        for family in self.families.iter().rev() {
            for (group, elements) in family.groups.iter() {
                let vertices = elements.iter().flat_map(|&element| family.vertices_of(element));
                self.write_entity(group, vertices, out)?;
            }
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
        let entity = self.groups().next().map_or(1, |(_, group, _)| group.tag);
        write!(out, "$Nodes\n1 {nodes} 1 {nodes}\n{dim} {entity} 0 {nodes}\n")?;
        (1..=nodes).try_for_each(|tag| writeln!(out, "{tag}"))?;
        for point in self.mesh.points.chunks_exact(dim) {
            write_point(out, point, " ")?;
            out.write_all(if dim == 2 { b" 0\n" } else { b"\n" })?;
        }
        out.write_all(b"$EndNodes\n")
    }

    fn write_elements(&self, out: &mut dyn Write) -> io::Result<()> {
        let (blocks, count) = (self.groups().count(), self.count());
        write!(out, "$Elements\n{blocks} {count} 1 {count}\n")?;
        for (family, Group { tag, .. }, elements) in self.groups() {
            let (dim, kind) = (family.dim, TYPES[family.dim - 1]);
            writeln!(out, "{dim} {tag} {kind} {}", elements.len())?;
            for &element in elements {
                write_element(out, family.tag_of(element), family.vertices_of(element))?;
            }
        }
        out.write_all(b"$EndElements\n")
    }

    /// Returns each element with its domain, 0 where there is none, in the order of the file:
    /// programs beside Gmsh take the values one after the other.
    fn domains(&self) -> impl Iterator<Item = (u64, u32)> {
        let elements = self.groups().flat_map(|(family, _, elements)| {
            elements.iter().map(|&at| (family.tag_of(at), family.vertices_of(at)))
        });
        elements.map(|(tag, vertices)| match domain_of(self.mesh, vertices) {
            NONE => (tag, 0),
            domain => (tag, domain),
        })
    }
}

/// Gmsh's numbers for lines, triangles and tetrahedra.
const TYPES: [u8; 3] = [1, 2, 4];

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

    #[test]
    fn facets_are_surfaces_and_regions_volumes() {
        let mut text = Vec::new();
        write(&samples::solid_with_facets(), Format::Gmsh, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let names = "$PhysicalNames\n7\n1 1 \"segment_0\"\n1 6 \"segment_6\"\n\
                     2 1 \"marker_-5\"\n2 2 \"marker_0\"\n2 9 \"marker_9\"\n\
                     3 1 \"region_-8\"\n3 7 \"region_7\"\n$EndPhysicalNames\n\
                     $Entities\n0 2 3 2\n";
        assert!(text.contains(names), "{text}");
        let elements = "$Elements\n7 8 1 8\n3 1 4 1\n2 2 3 4 5\n3 7 4 1\n1 1 2 3 4\n\
                        2 1 2 1\n3 2 1 3\n2 2 2 1\n5 5 3 4\n2 9 2 1\n4 4 2 3\n\
                        1 1 1 2\n7 2 3\n8 3 4\n1 6 1 1\n6 4 2\n$EndElements\n";
        assert!(text.contains(elements), "{text}");
        let domains = text.split("\"domain\"").nth(1).unwrap();
        let tags = domains.lines().skip(7).take(8).map(|line| line.split_once(' ').unwrap().0);
        assert_eq!(tags.collect::<Vec<_>>(), ["2", "1", "3", "5", "4", "7", "8", "6"]);
    }
}
