//! From the points to a mesh that conforms to segments.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::{Arrangement, Subsegment};
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::segments::chain::{Chains, Line};

impl Mesher<'_, '_, 2> {
    /// Inserts the inputs, makes all segments chains of edges, and finds the regions between them.
    /// No bound counts meanwhile.
    pub(in crate::netmesh) fn conform(
        &mut self,
        arrangement: &Arrangement,
        cavity: &mut Cavity,
    ) -> Result<()> {
        self.begin_to_conform(arrangement, &[], 1.0, cavity)?;
        let lines = self.lines_of(arrangement, cavity)?;
        self.make_domains()?;
        for line in &lines {
            self.watch.poll_after(1)?;
            self.leave_domains(line.ends[0], line.ends[1])?;
        }
        for domain in (1..self.state.hierarchy.len()).map(DomainId::new) {
            self.make_cage(domain, cavity)?;
        }
        let count = self.state.delaunay.point_count();
        self.state.segments.chains = Chains::new(lines, count, &mut self.watch)?;
        self.state.find_sharp_ends()?;
        self.recover_boundary(cavity)?;
        self.find_regions()?;
        self.judge_regions(&arrangement.regions)
    }

    /// Returns the lines of the arrangement. Crossings become vertices.
    fn lines_of(&mut self, arrangement: &Arrangement, cavity: &mut Cavity) -> Result<Vec<Line>> {
        let mut vertices = self.vertices_of_inputs()?;
        self.add_points(&arrangement.crossings, &mut vertices, cavity)?;
        let mut lines = with_capacity(arrangement.subsegments.len())?;
        for subsegment in &arrangement.subsegments {
            let ends = subsegment.ends.map(|end| vertices[end as usize]);
            let &Subsegment { segment, balance, .. } = subsegment;
            lines.push(Line { ends, segment, is_sharp: [false; 2], balance });
        }
        Ok(lines)
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts the inputs into the outer cage, which surrounds `further` points, too, and is
    /// `distance` times as far away as for points alone. No bound counts until the mesh conforms.
    pub(in crate::netmesh) fn begin_to_conform(
        &mut self,
        arrangement: &Arrangement,
        further: &[[f64; D]],
        distance: f64,
        cavity: &mut Cavity,
    ) -> Result<()> {
        self.state.stage.bound = f64::INFINITY;
        let center = self.start_outer_cage(further, distance, cavity)?;
        self.insert_points(center, cavity)?;
        self.state.stats.near_inputs = arrangement.near_inputs;
        self.state.stats.farthest_near_input = arrangement.farthest_near_input;
        Ok(())
    }

    /// Returns the vertex of each distinct input.
    pub(in crate::netmesh) fn vertices_of_inputs(&mut self) -> Result<Vec<VertexId>> {
        let mut vertices = filled(self.state.inputs, VertexId::NONE)?;
        for (vertex, &input) in self.order.iter().enumerate() {
            self.watch.poll_after(1)?;
            vertices[input.index()] = VertexId::new(vertex);
        }
        Ok(vertices)
    }

    /// Appends to `vertices` those at further points of the arrangement: crossings of segments in
    /// the plane, corners of a box in space.
    pub(in crate::netmesh) fn add_points(
        &mut self,
        points: &[[f64; D]],
        vertices: &mut Vec<VertexId>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        for x in points {
            let near = vertices.last().copied().unwrap_or(VertexId::new(0));
            let vertex = self.vertex_at_point(x, near, cavity)?;
            vertices.try_push(vertex)?;
        }
        Ok(())
    }

    /// Finds the vertex at a point of the arrangement that is no input, or makes it.
    fn vertex_at_point(
        &mut self,
        x: &[f64; D],
        near: VertexId,
        cavity: &mut Cavity,
    ) -> Result<VertexId> {
        let start = self.state.delaunay.complex().incident(near);
        if let Some(vertex) = self.state.delaunay.vertex_at(start, x) {
            return Ok(vertex);
        }
        let start = self.state.delaunay.locate(start, x).expect("no vertex is there");
        self.state.delaunay.find_cavity(start, x, cavity)?;
        let domain = self.enter_from_segment(x, cavity)?;
        let vertex = self.state.add_vertex(*x)?;
        self.state.stats.segment_points += 1;
        self.state.hierarchy.set_domain(vertex, domain);
        self.insert_into_cavity(vertex, cavity)?;
        Ok(vertex)
    }
}
