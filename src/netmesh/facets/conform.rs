//! From the points to a mesh that conforms to segments and facets in space.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{TryGrow, collected, with_capacity};
use crate::mesh::{ArrangedFacet, Arrangement, NONE, Subsegment};
use crate::nearest::{Bounds, bounds_of};
use crate::netmesh::questions::exempt::unit_of;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::bent::Bent;
use crate::netmesh::state::facets::plane::Plane;
use crate::netmesh::state::facets::{Facet, Facets};
use crate::netmesh::state::segments::chain::{Chains, Line};
use crate::options::Extent;
use crate::parameters::Parameters;

/// Number of units in the last place of a facet's largest coordinate by which its vertices may be
/// beyond the box of its corners.
const MARGIN: f64 = 128.0;

/// Number of times that the outer cage is farther away where the mesh ends at facets and has no
/// bound. A ball through a triangle of the hull reaches out the farther the nearer the next vertex
/// behind it is, and must not hold the cage: so far out that costs no vertices unless the vertex is
/// nearer than a millionth of the triangle's size.
const FAR: f64 = 1048576.0;

impl Mesher<'_, '_, 3> {
    /// Inserts the inputs, makes all segments chains of edges and all facets sheets of faces, and
    /// finds the regions between them. No bound counts meanwhile.
    pub(in crate::netmesh) fn conform_to_facets(
        &mut self,
        arrangement: &Arrangement,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let distance = self.distance_of_cage();
        self.begin_to_conform(arrangement, &arrangement.corners, distance, cavity)?;
        let mut vertices = self.vertices_of_inputs()?;
        self.add_points(&arrangement.corners, &mut vertices, cavity)?;
        let mut lines = with_capacity(arrangement.subsegments.len())?;
        for &Subsegment { ends, segment, balance } in &arrangement.subsegments {
            self.watch.poll_after(1)?;
            let ends = ends.map(|end| vertices[end as usize]);
            // Any angle may be between facets at the ends: shells are right for all.
            lines.push(Line { ends, segment, is_sharp: [true; 2], balance });
        }
        let count = self.state.delaunay.point_count();
        self.state.segments.chains = Chains::new(lines, count, &mut self.watch)?;
        self.state.facets = self.sheets_of(arrangement, &vertices)?;
        self.find_sharp_lines()?;
        self.make_sheets_delaunay()?;
        self.recover_boundary(cavity)?;
        self.cage_components(cavity)?;
        self.recover_boundary(cavity)?;
        self.refuse_lost_subfacets()?;
        self.find_regions()?;
        self.judge_regions(&arrangement.regions)
    }

    /// Returns how many times as far as for points alone the outer cage is. With a bound it is as
    /// near: simplices within the hull may be flat where it is far, and ask for points far outside,
    /// which takes up to half as much time again.
    fn distance_of_cage(&self) -> f64 {
        let Parameters { extent, quality_bound, .. } = self.state.parameters;
        match extent {
            Extent::All => 1.0,
            _ if quality_bound.is_finite() => 1.0,
            _ => FAR,
        }
    }

    /// Refuses subfacets that doubles keep out of the mesh: regions would be one through such a
    /// hole.
    fn refuse_lost_subfacets(&mut self) -> Result<()> {
        for subfacet in 0..self.state.facets.len() as u32 {
            self.watch.poll_after(1)?;
            let vertices = self.state.facets.get(subfacet).vertices;
            if self.state.facets.is_limited(subfacet) && !self.state.has_face(&vertices)? {
                return Err(self.state.error_of_lost(subfacet));
            }
        }
        Ok(())
    }

    /// Returns the facets of the arrangement.
    fn sheets_of(&mut self, arrangement: &Arrangement, vertices: &[VertexId]) -> Result<Facets> {
        let triangles = collected(arrangement.triangles.iter().map(|triangle| {
            (triangle.vertices.map(|input| vertices[input as usize]), triangle.facet)
        }))?;
        self.watch.poll()?;
        let mut facets = with_capacity(arrangement.facets.len())?;
        let mut all_bent = Vec::new();
        let mut rest = &triangles[..];
        // Parts of one of the caller's facets are in its plane: in their own they would be off it.
        let is_one =
            |a: &ArrangedFacet, b: &ArrangedFacet| a.parent == b.parent && a.parent != NONE;
        for parts in arrangement.facets.chunk_by(is_one) {
            self.watch.poll_after(2)?;
            let end = (facets.len() + parts.len()) as u32;
            let own = rest.iter().take_while(|triangle| triangle.1 < end).count();
            let borrowed = borrowed_by(arrangement, parts[0].parent);
            let borrowed = borrowed.map(|own| own.map(|input| vertices[input as usize]));
            let all = rest[..own].iter().map(|triangle| triangle.0).chain(borrowed);
            let points = all.map(|own| own.map(|vertex| *self.state.delaunay.point(vertex)));
            let points = collected(points)?;
            let plane = Plane::of(&points);
            let bent = match Bent::of(&plane, &points)? {
                Some(own) => {
                    all_bent.try_push(own)?;
                    all_bent.len() as u32 - 1
                }
                None => NONE,
            };
            let bounds = wide_bounds_of(points.iter().flatten());
            for &ArrangedFacet { parent, .. } in parts {
                facets.push(Facet { parent, plane, bent, first_radius: f64::INFINITY, bounds });
            }
            rest = &rest[own..];
        }
        let balances = collected(arrangement.facets.iter().map(|facet| facet.balance))?;
        let count = self.state.delaunay.point_count();
        let chains = &self.state.segments.chains;
        Facets::new((facets, all_bent), &balances, &triangles, chains, count, &mut self.watch)
    }
}

/// Returns the box of a facet's corners, with a margin for its vertices, which have roundings.
fn wide_bounds_of<'a>(corners: impl Iterator<Item = &'a [f64; 3]>) -> Bounds {
    let [low, high] = bounds_of(corners);
    let margin = MARGIN * unit_of(&low).max(unit_of(&high));
    [low.map(|x| x - margin), high.map(|x| x + margin)]
}

/// Returns the triangles that one of the caller's facets has on those of earlier ones.
fn borrowed_by(arrangement: &Arrangement, parent: u32) -> impl Iterator<Item = [u32; 3]> {
    let begin = arrangement.borrowed.partition_point(|own| own.1 < parent);
    let own = arrangement.borrowed[begin..].iter().take_while(move |own| own.1 == parent);
    own.map(|own| own.0)
}
