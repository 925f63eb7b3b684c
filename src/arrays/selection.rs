//! Selections: some of the simplices of a mesh.

use super::domains::{domain_of, is_within};
use super::{Part, Placement};
use crate::error::{Error, ErrorKind, Name, Result, message, say};
use crate::memory::{AllocResult, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{Attribute, Boundary, Boxed, Inputs, Mesh, NONE, Triangulation};
use crate::options::{Criterion, Extent};
use crate::query::check_arrays;

/// Region of space that a selection is restricted to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SelectionExtent {
    /// The whole space.
    #[default]
    All,
    /// The convex hull of the inputs.
    Hull,
    /// The bounding box of the inputs.
    Box,
}

/// Conditions for simplices; a selection has the simplices that fulfil all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Region in which the simplices must lie.
    pub extent: SelectionExtent,
    /// True to include simplices whose interior is partly in the region.
    pub across: bool,
    /// Domain to which the simplices must belong, itself or in a domain inside it; [`NONE`] for
    /// any. A simplex belongs to the innermost domain that contains all its vertices.
    pub domain: u32,
}

impl Default for Selection {
    fn default() -> Self {
        Self { extent: SelectionExtent::All, across: false, domain: NONE }
    }
}

impl<'a> Part<'a> {
    /// Returns the part of the mesh that a selection picks. `placements` are those of all simplices
    /// with respect to the selection's extent; [`SelectionExtent::All`] needs none.
    ///
    /// # Errors
    /// `InvalidArgument` (a domain that does not exist; a number of placements that is not that of
    /// the simplices; arrays that do not fit together), `OutOfMemory`.
    pub fn of(
        mesh: &'a Triangulation,
        selection: &Selection,
        placements: &[Placement],
    ) -> Result<Self> {
        check_arrays(mesh)?;
        let (domain, domains) = (selection.domain, mesh.domains.len());
        if domain != NONE && domain as usize >= domains {
            let message =
                say!(Name::SelectedDomain, " is {domain}; the mesh has {domains} domains");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let is_everywhere = selection.extent == SelectionExtent::All;
        if is_everywhere && domain == NONE {
            return Self::whole(mesh);
        }
        if !is_everywhere && placements.len() != mesh.simplex_count() {
            let message = message!(
                "placements has length {}; it must be that of the simplices, {}",
                placements.len(),
                mesh.simplex_count()
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let is_there = |simplex: usize| match placements.get(simplex) {
            _ if is_everywhere => true,
            Some(Placement::Inside) => true,
            Some(Placement::Across) => selection.across,
            _ => false,
        };
        let is_of_domain = |simplex: usize| {
            domain == NONE || is_within(mesh, domain_of(mesh, mesh.simplex(simplex)), domain)
        };
        let is_chosen = |simplex| is_there(simplex) && is_of_domain(simplex);
        Self::of_chosen(mesh, collected((0..mesh.simplex_count()).map(is_chosen))?)
    }

    /// Returns a mesh of the part's simplices and their vertices, for a writer, with the attributes
    /// at these vertices. Vertices and simplices are numbered anew in the same order. Domains keep
    /// their numbers; if the centre of a domain is no vertex any more, it becomes 0.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn to_mesh(
        &self,
        inputs: &Inputs,
        attributes: &[Attribute],
    ) -> Result<(Mesh, Vec<Attribute>)> {
        let mesh = self.mesh;
        let mut new_vertex = filled(mesh.vertex_count(), NONE)?;
        for simplex in self.simplices() {
            mesh.simplex(simplex as usize).iter().for_each(|&v| new_vertex[v as usize] = 0);
        }
        let is_kept = |vertex: &u32| new_vertex[*vertex as usize] != NONE;
        let kept = collected((0..mesh.vertex_count() as u32).filter(is_kept))?;
        let mut kept_attributes = with_capacity(attributes.len())?;
        for attribute in attributes {
            let values = kept.iter().flat_map(|&vertex| attribute.of(vertex as usize)).copied();
            let (name, values) = (attribute.name.clone(), collected(values)?);
            kept_attributes.push(Attribute { name, values, ..*attribute });
        }
        kept.iter().enumerate().for_each(|(new, &old)| new_vertex[old as usize] = new as u32);
        let ids = collected(self.simplices())?;
        let mut new_simplex = filled(mesh.simplex_count(), NONE)?;
        ids.iter().enumerate().for_each(|(new, &old)| new_simplex[old as usize] = new as u32);
        let mut part = Triangulation {
            dim: mesh.dim,
            points: Vec::new(),
            simplices: Vec::new(),
            neighbors: Vec::new(),
            kinds: collected(kept.iter().map(|&v| mesh.kinds[v as usize]))?,
            vertex_domains: collected(kept.iter().map(|&v| mesh.vertex_domains[v as usize]))?,
            cage_of: collected(kept.iter().map(|&v| mesh.cage_of[v as usize]))?,
            domains: copied(&mesh.domains)?,
            precision_limited: collected(kept.iter().map(|&v| mesh.precision_limited[v as usize]))?,
            boundary: Boundary::of_part(mesh, [&new_vertex, &new_simplex], &ids)?,
            sizes: collected(kept.iter().filter_map(|&v| mesh.sizes.get(v as usize)).copied())?,
            below_min_dihedral: renumbered(&mesh.below_min_dihedral, &new_simplex)?,
            beyond_bound: match mesh.parameters.criterion {
                Criterion::VoronoiAspect => renumbered(&mesh.beyond_bound, &new_vertex)?,
                Criterion::RadiusEdge => renumbered(&mesh.beyond_bound, &new_simplex)?,
            },
            parameters: mesh.parameters.clone(),
            stats: mesh.stats.clone(),
        };
        for domain in &mut part.domains {
            domain.center = new_vertex[domain.center as usize];
        }
        kept.iter().try_for_each(|&v| part.points.try_extend(mesh.point(v)))?;
        for &simplex in &ids {
            for (i, &vertex) in mesh.simplex(simplex as usize).iter().enumerate() {
                let neighbor = self.neighbor(simplex, i);
                let neighbor = if neighbor == NONE { NONE } else { new_simplex[neighbor as usize] };
                part.simplices.try_push(new_vertex[vertex as usize])?;
                part.neighbors.try_push(neighbor)?;
            }
        }
        Ok((Mesh::from_parts(inputs.of_vertices(&kept)?, part), kept_attributes))
    }

    /// Returns a triangulation of the part's simplices, numbered anew, with all vertices of the
    /// mesh under their numbers, for measures of quality: domains have their centres, vertices of
    /// no simplex have no cell, and of the simplices at the part's boundary only those at the outer
    /// cage of the mesh are not measured.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn for_measures(&self) -> Result<Triangulation> {
        let mesh = self.mesh;
        let ids = collected(self.simplices())?;
        let mut new_simplex = filled(mesh.simplex_count(), NONE)?;
        let mut is_kept = filled(mesh.vertex_count(), false)?;
        let mut part = without_simplices(mesh)?;
        for (new, &simplex) in ids.iter().enumerate() {
            new_simplex[simplex as usize] = new as u32;
            mesh.simplex(simplex as usize).iter().for_each(|&v| is_kept[v as usize] = true);
        }
        for &simplex in &ids {
            part.simplices.try_extend(mesh.simplex(simplex as usize))?;
            for i in 0..=mesh.dim {
                let neighbor = self.neighbor(simplex, i);
                let of_part = new_simplex.get(neighbor as usize).copied();
                part.neighbors.try_push(of_part.unwrap_or(NONE))?;
            }
        }
        let mut whole = without_simplices(mesh)?;
        if mesh.parameters.extent == Extent::All {
            let all = mesh.boundary.whole.as_deref().unwrap_or(mesh);
            whole.kinds = copied(&all.kinds)?;
            whole.simplices = copied(&all.simplices)?;
            whole.neighbors = copied(&all.neighbors)?;
        }
        part.boundary = Boundary {
            flat: renumbered(&mesh.boundary.flat, &new_simplex)?,
            forced: renumbered(&mesh.boundary.forced, &new_simplex)?,
            whole: Some(Boxed::new(whole)?),
            ..Boundary::default()
        };
        let beyond = mesh.beyond_bound.iter().copied();
        part.beyond_bound = match mesh.parameters.criterion {
            Criterion::VoronoiAspect => collected(beyond.filter(|&v| is_kept[v as usize]))?,
            Criterion::RadiusEdge => renumbered(&mesh.beyond_bound, &new_simplex)?,
        };
        Ok(part)
    }
}

/// Returns the vertices and domains of a mesh without its simplices, and without a boundary.
fn without_simplices(mesh: &Triangulation) -> AllocResult<Triangulation> {
    Ok(Triangulation {
        dim: mesh.dim,
        points: copied(&mesh.points)?,
        simplices: Vec::new(),
        neighbors: Vec::new(),
        kinds: copied(&mesh.kinds)?,
        vertex_domains: copied(&mesh.vertex_domains)?,
        cage_of: copied(&mesh.cage_of)?,
        domains: copied(&mesh.domains)?,
        precision_limited: copied(&mesh.precision_limited)?,
        below_min_dihedral: Vec::new(),
        boundary: Boundary::default(),
        sizes: Vec::new(),
        beyond_bound: Vec::new(),
        parameters: mesh.parameters.clone(),
        stats: mesh.stats.clone(),
    })
}

/// Returns the new numbers of those `ids` that have one.
fn renumbered(ids: &[u32], new: &[u32]) -> AllocResult<Vec<u32>> {
    collected(ids.iter().map(|&id| new[id as usize]).filter(|&id| id != NONE))
}
