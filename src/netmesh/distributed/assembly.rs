//! Pieces become a partition, which goes through rounds and refinement as those of one process do
//! (`partitions`), and that becomes a piece again.

use crate::complex::{Complex, SimplexId, VertexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected, filled, with_capacity};
use crate::mesh::{Inputs, Stats};
use crate::netmesh::distributed::hierarchy::{Domains, with_domains};
use crate::netmesh::distributed::names::{NOTHING, is_input, made_by};
use crate::netmesh::distributed::piece::{NamedVertex, Piece};
use crate::netmesh::state::conflict_lists::ConflictLists;
use crate::netmesh::state::facets::Facets;
use crate::netmesh::state::hierarchy::{DomainId, Hierarchy};
use crate::netmesh::state::interface::Interface;
use crate::netmesh::state::order::by_locality;
use crate::netmesh::state::refine_list::RefineList;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::{Cell, Mesher, Stage, State};
use crate::numerics::random_numbers;
use crate::options::Output;
use crate::parameters::Parameters;

/// Pieces that have been put together.
pub(super) struct Assembly<const D: usize> {
    /// Vertex -> name.
    pub names: Vec<u64>,
    pub domains: Domains,
    pub outer: Vec<[u64; D]>,
    pub encroaching: Vec<u64>,
    /// The vertices of simplices at interfaces, which stay as they are even if they get bad, each
    /// with its distance to the nearest other vertex when the pieces were put together; negative if
    /// it has fallen before.
    pub watched: Vec<(VertexId, f64)>,
    pub state: State<D>,
}

/// Vertices that get the first ids: the inputs of the state.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum First {
    /// Inputs that wait for their insertion, in an order of locality.
    Waiting,
    /// All inputs, by their names. None may wait.
    Inputs,
}

/// Ids of vertices in the assembly, and what the pieces know of them.
struct Vertices<const D: usize> {
    named: Vec<NamedVertex<D>>,
    /// Piece -> vertex of it -> id.
    ids: Vec<Vec<u32>>,
    /// Number of vertices that come first, by [`First`].
    first: usize,
}

impl<const D: usize> Assembly<D> {
    /// Puts `pieces` together. Where two of them have the same facet they are linked. `maker` is
    /// the number of the partition that this makes.
    pub fn new(
        pieces: &[Piece<D>],
        first: First,
        parameters: &Parameters,
        template: Vec<[f64; D]>,
        maker: u32,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Self> {
        let vertices = number(pieces, first, watch)?;
        let bases = simplex_bases(pieces)?;
        let (simplices, neighbors) = linked(pieces, &vertices, &bases, watch)?;
        let count = vertices.named.len();
        let complex = Complex::of_arrays(count, &simplices, &neighbors, || watch.poll_after(1))?;
        drop((simplices, neighbors));
        let mut points = Array::with_capacity(count)?;
        let mut cells = Array::with_capacity(count)?;
        for vertex in &vertices.named {
            points.try_push(vertex.point)?;
            cells.try_push(Cell { nearest: vertex.nearest, ..Cell::NEW })?;
        }
        let delaunay = Delaunay::of_complex(points, complex, || watch.poll_after(1))?;
        let shared = delaunay.interface_vertices()?;
        measure_farthest(&mut cells, &delaunay, &shared);
        let names = collected(vertices.named.iter().map(|vertex| vertex.name))?;
        let (hierarchy, domains): (Hierarchy<D>, Domains) =
            with_domains(pieces, &vertices.named, &names, &shared)?;
        let conflict_lists = match first {
            First::Waiting => conflict_lists(pieces, &vertices, &bases, &delaunay, watch)?,
            First::Inputs => {
                let mut lists = ConflictLists::new(vertices.first)?;
                (0..vertices.first).for_each(|_| lists.dismiss_unassigned());
                lists
            }
        };
        let is_whole = pieces.iter().all(|piece| piece.outer.is_empty()) && !shared.contains(&true);
        let mut interface = match is_whole {
            true => Interface::default(),
            false => Interface::new(domains.non_owned()?)?,
        };
        let (mut encroaching, mut nearer) = (Vec::new(), Vec::new());
        for piece in pieces {
            encroaching.try_extend(&piece.encroaching)?;
            nearer.try_extend(&piece.nearer)?;
            for domain in piece.wanted.iter().filter_map(|&name| domains.of_name(name)) {
                interface.want_non_owned(domain);
            }
        }
        nearer.sort_unstable();
        let mut watched = Vec::new();
        let is_watched = at_interface(&delaunay)?;
        for vertex in VertexId::below(count).filter(|&vertex| is_watched[vertex]) {
            let has_fallen = nearer.binary_search(&names[vertex]).is_ok();
            let nearest = if has_fallen { -1.0 } else { cells[vertex].nearest };
            watched.try_push((vertex, nearest))?;
        }
        let state = State {
            random: random_numbers(parameters.seed, maker.into()),
            precision_limited: collected(
                vertices.named.iter().map(|vertex| vertex.is_precision_limited),
            )?,
            delaunay,
            hierarchy,
            conflict_lists,
            refine_list: RefineList::new()?,
            segments: SegmentState::default(),
            facets: Facets::default(),
            interface,
            stage: Stage::of_insertion(parameters.loose_bound()),
            cells,
            inputs: vertices.first,
            removed: Vec::new(),
            template,
            stats: Stats::default(),
            parameters: parameters.clone(),
        };
        Ok(Self { names, domains, outer: outer(pieces)?, encroaching, watched, state })
    }

    /// Goes through rounds and refinement, as far as the interface allows, and becomes a piece.
    pub fn refine(mut self, maker: u32, watch: Watch<'_, '_>) -> Result<Piece<D>> {
        let encroaching = std::mem::take(&mut self.encroaching);
        let mut mesher = Mesher::resume(self.state, watch);
        let mut cavity = Cavity::default();
        mesher.lock()?;
        let mut left = Vec::new();
        if !encroaching.is_empty() {
            for (vertex, name) in self.names.iter().enumerate() {
                let vertex = VertexId::new(vertex);
                if encroaching.contains(name) && !mesher.make_room(vertex, &mut cavity)? {
                    left.try_push(*name)?;
                }
            }
        }
        mesher.clean(&mut cavity)?;
        mesher.run_rounds_locked(&mut cavity)?;
        mesher.refine_spanning_domains(&mut cavity)?;
        drop(cavity);
        self.encroaching = left;
        self.state = mesher.state;
        self.into_piece(maker)
    }

    /// Returns the live simplices as a piece.
    pub fn into_piece(mut self, maker: u32) -> Result<Piece<D>> {
        let known = self.names.len();
        for number in known..self.state.delaunay.point_count() {
            self.names.try_push(made_by(maker, number - known))?;
        }
        self.domains.name_new(&self.state.hierarchy, maker)?;
        for &(_, input) in &self.state.interface.deferred {
            let name = self.names[input];
            if !self.encroaching.contains(&name) {
                self.encroaching.try_push(name)?;
            }
        }
        let mut piece = Piece {
            outer: std::mem::take(&mut self.outer),
            encroaching: std::mem::take(&mut self.encroaching),
            maker,
            ..Piece::default()
        };
        self.write_simplices(&mut piece)?;
        self.write_vertices(&mut piece)?;
        let State { hierarchy, interface, parameters, .. } = &mut self.state;
        let has_work_left = |domain: DomainId| {
            parameters.output == Output::WellSpaced || interface.has_work_left(domain)
        };
        self.domains.write(hierarchy, &self.names, has_work_left, &mut piece)?;
        Ok(piece)
    }

    /// Writes simplices with the ids that their vertices have here; [`Self::write_vertices`] puts
    /// in those of the piece.
    fn write_simplices(&self, piece: &mut Piece<D>) -> Result<()> {
        let complex = self.state.delaunay.complex();
        let mut ids = filled(complex.simplex_bound(), u32::MAX)?;
        let live = || complex.simplices().filter(|&simplex| complex.is_live(simplex));
        for (id, simplex) in (0..).zip(live()) {
            ids[simplex.index()] = id;
        }
        let count = complex.simplex_count();
        piece.simplices = with_capacity(count * Piece::<D>::PER_SIMPLEX)?;
        piece.neighbors = with_capacity(count * Piece::<D>::PER_SIMPLEX)?;
        piece.is_unsettled = with_capacity(count)?;
        for simplex in live() {
            piece.simplices.extend(complex.vertices(simplex).iter().map(|vertex| vertex.number()));
            let neighbors = complex.neighbors(simplex).iter();
            piece.neighbors.extend(neighbors.map(|neighbor| ids[neighbor.index()]));
            piece.is_unsettled.push(self.state.conflict_lists.count(simplex) > 0);
        }
        let mut is_nearer = filled(self.state.delaunay.point_count(), false)?;
        for &(vertex, before) in &self.watched {
            // A distance that had fallen before is below that of any vertex.
            if before < 0.0 || self.state.cells[vertex].nearest < before {
                is_nearer[vertex.index()] = true;
                piece.nearer.try_push(self.names[vertex.index()])?;
            }
        }
        for &simplex in &self.state.interface.blocked {
            if complex.is_live(simplex) && self.state.refine_list.is_limited(simplex) {
                piece.is_unsettled[ids[simplex.index()] as usize] = true;
            }
        }
        for simplex in live().filter(|&simplex| self.has_nearer(simplex, &is_nearer)) {
            piece.is_unsettled[ids[simplex.index()] as usize] = true;
        }
        for input in VertexId::below(self.state.inputs) {
            if !complex.contains_vertex(input) {
                let simplex = self.state.conflict_lists.simplex_of(input);
                piece.waiting.try_push(ids[simplex.index()])?;
            }
        }
        Ok(())
    }

    fn has_nearer(&self, simplex: SimplexId, is_nearer: &[bool]) -> bool {
        let mut vertices = self.state.delaunay.complex().vertices(simplex).iter();
        vertices.any(|vertex| is_nearer.get(vertex.index()) == Some(&true))
    }

    /// Writes the vertices: waiting inputs first, then the vertices of simplices.
    fn write_vertices(&mut self, piece: &mut Piece<D>) -> Result<()> {
        let count = self.state.delaunay.point_count();
        let mut ids = filled(count, u32::MAX)?;
        let mut order = Vec::new();
        let is_in = |vertex: &VertexId| self.state.delaunay.complex().contains_vertex(*vertex);
        let waiting = VertexId::below(self.state.inputs).filter(|vertex| !is_in(vertex));
        for vertex in waiting.chain(VertexId::below(count).filter(is_in)) {
            ids[vertex.index()] = order.len() as u32;
            order.try_push(vertex)?;
        }
        let limited = self.limited_vertices()?;
        piece.vertices = with_capacity(order.len())?;
        for vertex in order {
            let is_inserted = self.state.delaunay.complex().contains_vertex(vertex);
            let Cell { nearest, .. } = self.state.cells[vertex];
            let hierarchy = &mut self.state.hierarchy;
            let cage = hierarchy.cage_of(vertex);
            let domain = is_inserted.then(|| hierarchy.domain_of(vertex));
            piece.vertices.push(NamedVertex {
                name: self.names[vertex.index()],
                point: *self.state.delaunay.point(vertex),
                nearest,
                domain: domain.map_or(NOTHING, |domain| self.domains.name(domain)),
                cage: self.domains.name(cage),
                is_precision_limited: limited[vertex.index()],
            });
        }
        for vertex in piece.simplices.iter_mut().filter(|vertex| **vertex != u32::MAX) {
            *vertex = ids[*vertex as usize];
        }
        Ok(())
    }

    /// Returns, for every vertex, true if doubles ran out next to it, or the corner of a simplex at
    /// it could not be inserted for want of precision.
    fn limited_vertices(&self) -> AllocResult<Vec<bool>> {
        let State { delaunay, refine_list, interface, .. } = &self.state;
        let mut limited = collected(self.state.precision_limited.iter().copied())?;
        let mut is_blocked = filled(delaunay.complex().simplex_bound(), false)?;
        interface.blocked.iter().for_each(|&simplex| is_blocked[simplex.index()] = true);
        for simplex in delaunay.complex().simplices() {
            let is_free = !is_blocked[simplex.index()] && !interface.is_locked(simplex);
            if is_free && refine_list.is_limited(simplex) && delaunay.complex().is_live(simplex) {
                for vertex in delaunay.complex().vertices(simplex).iter().filter(|v| v.is_valid()) {
                    limited[vertex.index()] = true;
                }
            }
        }
        Ok(limited)
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Grows the domains around `input`, which encroaches them from inside. Whether the interface
    /// allowed it.
    fn make_room(&mut self, input: VertexId, cavity: &mut Cavity) -> Result<bool> {
        if !self.state.is_inserted(input) {
            return Ok(false);
        }
        let x = *self.state.delaunay.point(input);
        loop {
            let domain = self.state.hierarchy.domain_of(input);
            let outer = match self.state.hierarchy.cage_of(input) == domain {
                true => self.state.hierarchy.parent(domain),
                false => domain,
            };
            let Some(domain) = self.state.inner_encroached_from(outer, &x) else { return Ok(true) };
            let start = self.state.delaunay.complex().incident(input);
            if !self.grow_cage_for(domain, &x, start, cavity)? {
                return Ok(false);
            }
        }
    }
}

/// Returns, for every vertex, true if it is of a simplex at an interface.
fn at_interface<const D: usize>(delaunay: &Delaunay<D>) -> AllocResult<Vec<bool>> {
    let complex = delaunay.complex();
    let mut is_at_interface = filled(delaunay.point_count(), false)?;
    for simplex in complex.simplices() {
        if (0..=D).any(|index| complex.is_interface(simplex, index)) {
            for vertex in complex.vertices(simplex).iter().filter(|vertex| vertex.is_valid()) {
                is_at_interface[vertex.index()] = true;
            }
        }
    }
    Ok(is_at_interface)
}

/// Measures the farthest corner of each vertex; that of a `shared` one is not known.
fn measure_farthest<const D: usize>(cells: &mut [Cell], delaunay: &Delaunay<D>, shared: &[bool]) {
    for simplex in delaunay.complex().simplices() {
        if let Some(radius) = delaunay.radius(simplex) {
            for &vertex in delaunay.complex().vertices(simplex) {
                let cell = &mut cells[vertex.index()];
                cell.farthest = cell.farthest.max(radius);
            }
        }
    }
    for (cell, _) in cells.iter_mut().zip(shared).filter(|(_, is_shared)| **is_shared) {
        cell.farthest = f64::INFINITY;
    }
}

/// Returns the number at which the simplices of each piece begin.
fn simplex_bases<const D: usize>(pieces: &[Piece<D>]) -> Result<Vec<usize>> {
    let mut bases = with_capacity(pieces.len())?;
    let mut next = 0;
    for piece in pieces {
        bases.push(next);
        next += piece.simplex_count();
    }
    if next >= u32::MAX as usize {
        return Err(AllocError::Ids.into());
    }
    Ok(bases)
}

/// Assigns numbers to the vertices of all pieces, one to those of one name.
fn number<const D: usize>(
    pieces: &[Piece<D>],
    first: First,
    watch: &mut Watch<'_, '_>,
) -> Result<Vertices<D>> {
    let mut all = with_capacity(pieces.iter().map(|piece| piece.vertices.len()).sum())?;
    for (at, piece) in pieces.iter().enumerate() {
        for (number, vertex) in piece.vertices.iter().enumerate() {
            watch.poll_after(1)?;
            let is_first = match first {
                First::Waiting => number < piece.waiting.len(),
                First::Inputs => is_input(vertex.name),
            };
            all.push((vertex.name, !is_first, at as u32, number as u32));
        }
    }
    all.sort_unstable();
    // One entry a name: the first of those that have it. An input waits in one piece only, and is
    // in the mesh in none.
    let vertex_of_entry =
        |entry: &(u64, bool, u32, u32)| &pieces[entry.2 as usize].vertices[entry.3 as usize];
    let groups = || all.chunk_by(|a, b| a.0 == b.0);
    let mut firsts = collected(groups().map(|group| group[0]).filter(|entry| !entry.1))?;
    if first == First::Waiting {
        let points = collected(firsts.iter().map(|entry| vertex_of_entry(entry).point))?;
        if points.len() > 1 {
            let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0)?;
            let order = by_locality::<D>(&inputs, 1, watch)?;
            firsts = collected(order.iter().map(|input| firsts[input.index()]))?;
        }
    }
    let mut ids = with_capacity(pieces.len())?;
    for piece in pieces {
        ids.push(filled(piece.vertices.len(), u32::MAX)?);
    }
    let mut named = with_capacity(firsts.len())?;
    // Those that are not the first come in the order of the pieces, which is one of locality.
    for entry in &firsts {
        ids[entry.2 as usize][entry.3 as usize] = named.len() as u32;
        named.push(*vertex_of_entry(entry));
    }
    let count = named.len();
    let mut leaders = with_capacity(all.len())?;
    for group in groups() {
        leaders.extend(group.iter().map(|entry| ((entry.2, entry.3), (group[0].2, group[0].3))));
    }
    leaders.sort_unstable();
    for ((at, vertex), (leader, leading)) in leaders {
        watch.poll_after(1)?;
        let known = ids[leader as usize][leading as usize];
        let own = &pieces[at as usize].vertices[vertex as usize];
        if known == u32::MAX {
            let id = named.len() as u32;
            named.try_push(*own)?;
            ids[leader as usize][leading as usize] = id;
            ids[at as usize][vertex as usize] = id;
            continue;
        }
        ids[at as usize][vertex as usize] = known;
        let known: &mut NamedVertex<D> = &mut named[known as usize];
        known.nearest = known.nearest.min(own.nearest);
        known.is_precision_limited |= own.is_precision_limited;
        if known.domain == NOTHING {
            known.domain = own.domain;
        }
        if known.cage == NOTHING {
            known.cage = own.cage;
        }
    }
    Ok(Vertices { named, ids, first: count })
}

/// Returns the vertices and neighbours of all simplices, linked where pieces have the same facet.
fn linked<const D: usize>(
    pieces: &[Piece<D>],
    vertices: &Vertices<D>,
    bases: &[usize],
    watch: &mut Watch<'_, '_>,
) -> Result<(Vec<VertexId>, Vec<SimplexId>)> {
    let length = pieces.iter().map(|piece| piece.simplices.len()).sum();
    let (mut simplices, mut neighbors) = (with_capacity(length)?, with_capacity(length)?);
    let mut facets = Vec::new();
    for ((piece, ids), &base) in pieces.iter().zip(&vertices.ids).zip(bases) {
        watch.poll()?;
        simplices.extend(piece.simplices.iter().map(|&vertex| match vertex {
            u32::MAX => VertexId::INFINITE,
            _ => VertexId::from_number(ids[vertex as usize]),
        }));
        neighbors.extend(
            piece.neighbors.iter().map(|&neighbor| SimplexId::new(base + neighbor as usize)),
        );
        for (simplex, index) in piece.interface_facets() {
            watch.poll_after(1)?;
            facets.try_push((piece.facet(simplex, index), base + simplex, index))?;
        }
    }
    facets.sort_unstable();
    for pair in facets.windows(2) {
        let [(facet, first, at), (other, second, opposite)] = [pair[0], pair[1]];
        if facet == other {
            neighbors[first * Piece::<D>::PER_SIMPLEX + at] = SimplexId::new(second);
            neighbors[second * Piece::<D>::PER_SIMPLEX + opposite] = SimplexId::new(first);
        }
    }
    Ok((simplices, neighbors))
}

/// Puts waiting inputs on the lists of the simplices that they are known to conflict with.
fn conflict_lists<const D: usize>(
    pieces: &[Piece<D>],
    vertices: &Vertices<D>,
    bases: &[usize],
    delaunay: &Delaunay<D>,
    watch: &mut Watch<'_, '_>,
) -> Result<ConflictLists> {
    let mut simplex_of = filled(vertices.first, SimplexId::NONE)?;
    for ((piece, ids), &base) in pieces.iter().zip(&vertices.ids).zip(bases) {
        for (input, &simplex) in piece.waiting.iter().enumerate() {
            simplex_of[ids[input] as usize] = SimplexId::new(base + simplex as usize);
        }
    }
    let mut lists = ConflictLists::new(vertices.first)?;
    lists.cover(delaunay.complex().simplex_bound())?;
    for (input, &simplex) in VertexId::below(vertices.first).zip(&simplex_of) {
        watch.poll_after(1)?;
        debug_assert!(delaunay.in_conflict(simplex, delaunay.point(input)));
        lists.assign(input, simplex);
    }
    Ok(lists)
}

/// Returns the outer facets of the pieces together: those of two of them are inside.
fn outer<const D: usize>(pieces: &[Piece<D>]) -> AllocResult<Vec<[u64; D]>> {
    let mut all = collected(pieces.iter().flat_map(|piece| piece.outer.iter().copied()))?;
    all.sort_unstable();
    let single = all.chunk_by(|a, b| a == b).filter(|facets| facets.len() == 1);
    collected(single.map(|facets| facets[0]))
}
