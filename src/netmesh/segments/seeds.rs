//! Seeds: points of the caller's that say of the regions around them what they are. Each must be in
//! a region that it can say something of, and no region has two: otherwise a misplaced seed would
//! leave the mesh as if it had not been given.

use crate::complex::{SimplexId, VertexId};
use crate::error::{Choice, Error, ErrorKind, Message, Name, Result, say};
use crate::memory::{AllocResult, Lists, TryGrow, filled, with_capacity};
use crate::mesh::{NONE, Region};
use crate::netmesh::state::segments::regions::OUTSIDE;
use crate::netmesh::state::segments::{At, Seed};
use crate::netmesh::state::{Mesher, State};
use crate::numerics::{Sign, orientation};
use crate::options::{Extent, Labels};
use crate::parameters::Parameters;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Finds which regions belong to the domain, and what their seeds say of them. All regions are
    /// known.
    pub(in crate::netmesh) fn judge_regions(&mut self, seeds: &[Region]) -> Result<()> {
        let count = self.state.segments.regions.len();
        let mut is_inside = self.state.enclosed_regions()?;
        let open = if D == 3 { "facets enclose nothing" } else { "segments enclose nothing" };
        self.state.refuse_nothing(&is_inside, open)?;
        self.find_seeds(seeds, &is_inside)?;
        let mut labels = filled(count, 0)?;
        let mut max_edges = filled(count, f64::INFINITY)?;
        let (mut has_label, mut taken) = (filled(count, false)?, with_capacity(seeds.len())?);
        for (&Seed { region, .. }, given) in self.state.segments.seeds.iter().zip(seeds) {
            let region = region as usize;
            if given.is_hole {
                is_inside[region] = false;
                continue;
            }
            (labels[region], has_label[region]) = (given.label, true);
            taken.push(given.label);
            if given.max_edge > 0.0 {
                max_edges[region] = given.max_edge;
            }
        }
        self.state.refuse_nothing(&is_inside, "all that is inside is a hole")?;
        if self.state.parameters.labels == Labels::Regions {
            taken.sort_unstable();
            self.state.number_regions(&has_label, &is_inside, &taken, &mut labels)?;
        }
        let regions = &mut self.state.segments.regions;
        (regions.is_inside, regions.labels) = (is_inside, labels);
        regions.max_edges = max_edges;
        Ok(())
    }

    /// Finds the region of each seed. Refuses one that is in no region, and two in the same.
    fn find_seeds(&mut self, seeds: &[Region], is_enclosed: &[bool]) -> Result<()> {
        // Region -> the seed that is in it.
        let mut seed_of = filled(is_enclosed.len(), NONE)?;
        let mut near = self.state.delaunay.complex().incident(VertexId::new(0));
        let mut subfacets_at = None;
        for (number, seed) in (0..).zip(seeds) {
            self.watch.poll_after(1)?;
            let x = std::array::from_fn(|axis| seed.seed[axis]);
            let mut region = OUTSIDE;
            // Beyond the outer cage is more of what surrounds all segments.
            if let Some(simplex) = self.state.delaunay.simplex_at(near, &x) {
                near = simplex;
                self.state.refuse_on_segment(number, &x, simplex, &mut subfacets_at)?;
                let known = self.state.segments.regions.of(simplex);
                region = known.expect("all regions are known");
            }
            self.state.refuse_outside(number, seed, region, is_enclosed[region as usize])?;
            let wall = wall::<D>();
            let earlier = std::mem::replace(&mut seed_of[region as usize], number);
            if earlier != NONE {
                return refuse(say!(
                    Name::Seed(number),
                    " is in the same region as ",
                    Name::Seed(earlier),
                    "; no {wall} is between them, and a region must have one seed at most"
                ));
            }
            let found = Seed { number, x: seed.seed, region };
            self.state.segments.seeds.try_push(found)?;
        }
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Refuses a seed in a region that is no part of the domain. A hole there is what the rule of
    /// `options.interior` has made already, unless it is outside of all segments.
    fn refuse_outside(
        &self,
        number: u32,
        seed: &Region,
        region: u32,
        is_enclosed: bool,
    ) -> Result<()> {
        let Parameters { extent, interior, .. } = self.parameters;
        let (x, wall) = (At(&seed.seed[..D]), wall::<D>());
        if is_enclosed || seed.is_hole && region != OUTSIDE {
            return Ok(());
        }
        let seed = Name::Seed(number);
        let must = "it must be in a region of the domain";
        refuse(match (extent, region) {
            (Extent::Boundary, OUTSIDE) => {
                say!(seed, " is {x}, outside of all that {wall}s enclose; {must}")
            }
            (Extent::Boundary, _) => say!(
                seed,
                " is {x}, which ",
                Choice::Interior(interior),
                " leaves out, so that only a hole may be there; {must}"
            ),
            _ => say!(
                seed,
                " is {x}, beyond the boundary, with ",
                Choice::Extent(extent),
                "; {must}"
            ),
        })
    }

    /// Refuses a domain that has no region, for which `why` is the reason.
    fn refuse_nothing(&self, is_inside: &[bool], why: &str) -> Result<()> {
        let Parameters { extent, interior, .. } = self.parameters;
        if is_inside.contains(&true) {
            return Ok(());
        }
        let has_frame = matches!(extent, Extent::Hull | Extent::Box);
        if has_frame && self.segments.regions.len() == 1 {
            if D == 2 {
                return Err(Error::without_area(extent));
            }
            return Err(Error::without_room(extent));
        }
        refuse(say!(
            "{why}, with ",
            Choice::Extent(extent),
            " and ",
            Choice::Interior(interior),
            "; the domain must not be empty"
        ))
    }

    /// Refuses a seed that is so near to a segment that it is in another region since the segment's
    /// vertices came, each of them rounded. All regions are known.
    pub(in crate::netmesh) fn check_seeds(&self) -> Result<()> {
        let State { delaunay, segments, .. } = self;
        let mut near = delaunay.complex().incident(VertexId::new(0));
        let mut subfacets_at = None;
        for seed in &segments.seeds {
            let x = std::array::from_fn(|axis| seed.x[axis]);
            let Some(simplex) = delaunay.simplex_at(near, &x) else { continue };
            near = simplex;
            self.refuse_on_segment(seed.number, &x, simplex, &mut subfacets_at)?;
            if segments.regions.of(simplex) != Some(seed.region) {
                let wall = wall::<D>();
                return refuse(say!(
                    Name::Seed(seed.number),
                    " is within a rounding of a {wall}; it must be in the interior of a region"
                ));
            }
        }
        Ok(())
    }

    /// Refuses a seed on a segment, which is in no region. `simplex` holds it. `subfacets_at` is
    /// filled for the first seed that needs it.
    fn refuse_on_segment(
        &self,
        number: u32,
        x: &[f64; D],
        simplex: SimplexId,
        subfacets_at: &mut Option<Lists>,
    ) -> Result<()> {
        let wall = match self.as_space() {
            Some(state) => {
                let x = std::array::from_fn(|axis| x[axis]);
                state.facet_under(&x, simplex, subfacets_at)?
            }
            None => self
                .line_under(x, simplex)
                .map(|line| self.segments.chains.lines[line as usize].segment),
        };
        let name = |wall: u32| {
            if D == 3 { Name::Facet(wall as usize) } else { Name::Segment(wall as usize) }
        };
        let (seed, must) = (Name::Seed(number), "it must be in the interior of a region");
        match wall {
            None => Ok(()),
            Some(NONE) => refuse(say!(seed, " is on the boundary of the hull or box; {must}")),
            Some(wall) => refuse(say!(seed, " is on ", name(wall), "; {must}")),
        }
    }

    /// Returns the line that a point of the closure of `simplex` is on. At a vertex of a line it
    /// may be that no side of the simplex is of that line.
    fn line_under(&self, x: &[f64; D], simplex: SimplexId) -> Option<u32> {
        let State { delaunay, segments, .. } = self;
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

impl State<3> {
    /// Returns the caller's facet that a point of the closure of `simplex` is on; [`NONE`] for a
    /// side of the hull or box. On an edge or at a vertex of a facet it may be that no face of the
    /// simplex is of that facet, so that all at its vertices are asked: `subfacets_at` has them,
    /// and is filled where it is `None`.
    fn facet_under(
        &self,
        x: &[f64; 3],
        simplex: SimplexId,
        subfacets_at: &mut Option<Lists>,
    ) -> AllocResult<Option<u32>> {
        let vertices = self.delaunay.complex().vertices(simplex);
        let is_on = |index: usize| {
            let mut points: [&[f64; 3]; 4] =
                std::array::from_fn(|at| self.delaunay.point(vertices[at]));
            points[index] = x;
            orientation(&points) == Sign::Zero
        };
        // The vertices of the face that has the point in its interior.
        let carrier = || (0..4).filter(|&index| !is_on(index)).map(|index| vertices[index]);
        let (Some(first), false) = (carrier().next(), carrier().count() == 4) else {
            return Ok(None);
        };
        let subfacets_at = match subfacets_at {
            Some(lists) => lists,
            None => {
                let count = self.delaunay.point_count();
                subfacets_at.insert(self.facets.subfacets_at_vertices(count)?)
            }
        };
        let mut own = subfacets_at.of(first.index()).iter().map(|&own| self.facets.get(own));
        let found = own.find(|own| carrier().all(|vertex| own.vertices.contains(&vertex)));
        Ok(found.map(|own| self.facets.facets[own.facet as usize].parent))
    }
}

/// Returns the word for what bounds regions.
const fn wall<const D: usize>() -> &'static str {
    if D == 3 { "facet" } else { "segment" }
}

fn refuse(message: Message) -> Result<()> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}
