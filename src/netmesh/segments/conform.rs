//! From the points to a mesh that conforms to segments.

use super::chain::{Chains, Line};
use super::{Seed, Segments, name_of};
use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::{Choice, Error, ErrorKind, Name, Result, say};
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::{Arrangement, Region, Subsegment};
use crate::netmesh::{Mesher, State};
use crate::numerics::{Sign, orientation};
use crate::options::Extent;
use crate::parameters::Parameters;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts the inputs, makes all segments chains of edges, and finds the regions between them.
    /// No bound counts meanwhile.
    pub(in crate::netmesh) fn conform(
        &mut self,
        arrangement: &Arrangement,
        cavity: &mut Cavity,
    ) -> Result<()> {
        self.state.stage.bound = f64::INFINITY;
        let center = self.start_outer_cage(cavity)?;
        self.insert_points(center, cavity)?;
        let lines = self.lines_of(arrangement, cavity)?;
        self.cage_clusters(&lines, cavity)?;
        self.state.segments.chains = Chains::new(lines, self.state.delaunay.point_count())?;
        self.find_sharp_ends()?;
        self.recover_segments(cavity)?;
        let State { delaunay, segments, .. } = &mut self.state;
        let Segments { chains, regions, visited, .. } = segments;
        regions.find(delaunay, chains, visited)?;
        self.judge_regions(&arrangement.regions)
    }

    /// The lines of the arrangement. Crossings become vertices.
    fn lines_of(&mut self, arrangement: &Arrangement, cavity: &mut Cavity) -> Result<Vec<Line>> {
        let mut vertices = filled(self.state.inputs, VertexId::NONE)?;
        for (vertex, &input) in self.order.iter().enumerate() {
            vertices[input.index()] = VertexId::new(vertex);
        }
        for x in &arrangement.crossings {
            let x = std::array::from_fn(|axis| x[axis]);
            let near = vertices.last().copied().unwrap_or(VertexId::new(0));
            let vertex = self.crossing_at(&x, near, cavity)?;
            vertices.try_push(vertex)?;
        }
        let mut lines = with_capacity(arrangement.subsegments.len())?;
        for subsegment in &arrangement.subsegments {
            let ends = subsegment.ends.map(|end| vertices[end as usize]);
            let &Subsegment { segment, balance, .. } = subsegment;
            lines.push(Line { ends, segment, is_sharp: [false; 2], balance });
        }
        Ok(lines)
    }

    /// The vertex at a point where segments cross, found or made.
    fn crossing_at(
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
        let vertex = self.add_vertex(*x)?;
        self.state.stats.segment_points += 1;
        self.state.hierarchy.set_domain(vertex, domain);
        self.insert_into_cavity(vertex, cavity)?;
        Ok(vertex)
    }

    /// Which regions belong to the domain, and what their seeds say of them.
    fn judge_regions(&mut self, seeds: &[Region]) -> Result<()> {
        let count = self.state.segments.regions.len();
        let mut is_inside = self.state.enclosed_regions()?;
        self.refuse_nothing(&is_inside, "segments enclose nothing")?;
        let mut labels = filled(count, 0)?;
        let mut max_edges = filled(count, f64::INFINITY)?;
        let mut near = self.state.delaunay.complex().incident(VertexId::new(0));
        for (number, seed) in seeds.iter().enumerate() {
            let x = std::array::from_fn(|axis| seed.seed[axis]);
            let Some(simplex) = self.state.delaunay.simplex_at(near, &x) else { continue };
            near = simplex;
            self.refuse_on_segment(number, &x, simplex)?;
            let region = self.state.segments.regions.of(simplex);
            let region = region.expect("all regions are known") as usize;
            let found = Seed { number: number as u32, x: seed.seed, region: region as u32 };
            self.state.segments.seeds.try_push(found)?;
            is_inside[region] &= !seed.is_hole;
            if !seed.is_hole {
                labels[region] = seed.label;
                if seed.max_edge > 0.0 {
                    max_edges[region] = seed.max_edge;
                }
            }
        }
        self.refuse_nothing(&is_inside, "all that is inside is a hole")?;
        let is_all = self.state.parameters.extent == Extent::All;
        let regions = &mut self.state.segments.regions;
        for (is_refined, &is_inside) in regions.is_refined.iter_mut().zip(&is_inside) {
            *is_refined = is_all || is_inside;
        }
        (regions.is_inside, regions.labels) = (is_inside, labels);
        regions.max_edges = max_edges;
        Ok(())
    }

    /// Refuses a domain that is cut out and has no region, for which `why` is the reason.
    fn refuse_nothing(&self, is_inside: &[bool], why: &str) -> Result<()> {
        let Parameters { extent, interior, .. } = self.state.parameters;
        if extent == Extent::All || is_inside.contains(&true) {
            return Ok(());
        }
        let message = say!(
            "{why}, with ",
            Choice::Extent(extent),
            " and ",
            Choice::Interior(interior),
            "; the domain must not be empty"
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }

    /// Refuses a seed that is so near to a segment that it is in another region since the segment's
    /// vertices came, each of them rounded. All regions are known.
    pub(super) fn check_seeds(&self) -> Result<()> {
        let State { delaunay, segments, .. } = &self.state;
        let mut near = delaunay.complex().incident(VertexId::new(0));
        for seed in &segments.seeds {
            let x = std::array::from_fn(|axis| seed.x[axis]);
            let Some(simplex) = delaunay.simplex_at(near, &x) else { continue };
            near = simplex;
            self.refuse_on_segment(seed.number as usize, &x, simplex)?;
            if segments.regions.of(simplex) != Some(seed.region) {
                let message = say!(
                    Name::Seed(seed.number),
                    " is within a rounding of a segment; it must be in the interior of a region"
                );
                return Err(Error::new(ErrorKind::InvalidArgument, message));
            }
        }
        Ok(())
    }

    /// Refuses a seed on a segment, which is in no region. `simplex` holds it.
    fn refuse_on_segment(&self, number: usize, x: &[f64; D], simplex: SimplexId) -> Result<()> {
        let Some(line) = self.line_under(x, simplex) else { return Ok(()) };
        let name = name_of(self.state.segments.chains.lines[line as usize].segment);
        let message = say!(
            Name::Seed(number as u32),
            " is on {name}; it must be in the interior of a region"
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }

    /// The line that a point of the closure of `simplex` is on. At a vertex of a line it may be that
    /// no side of the simplex is of that line.
    fn line_under(&self, x: &[f64; D], simplex: SimplexId) -> Option<u32> {
        let State { delaunay, segments, .. } = &self.state;
        let (vertices, chains) = (delaunay.complex().vertices(simplex), &segments.chains);
        let at_vertex = vertices.iter().find(|&&vertex| delaunay.point(vertex) == x);
        if let Some(&vertex) = at_vertex {
            return chains.line_at(vertex);
        }
        let is_on = |index: usize| {
            let mut points: [&[f64; D]; 3] = std::array::from_fn(|at| delaunay.point(vertices[at]));
            points[index] = x;
            orientation(&points) == Sign::Zero
        };
        let sides = chains.sides_of(vertices).into_iter().enumerate();
        let side = sides.filter(|&(index, _)| is_on(index)).find_map(|(_, side)| side)?;
        Some(chains.get(side).line)
    }
}
