//! INSERT and INSERTINPUT (§6.3): every insertion is medial in its domain, because the hierarchy
//! is changed first.

use super::domains::ROOT;
use super::encroach::LEVELS;
use super::{Cell, Mesher, Scratch, some};
use crate::error::Result;
use crate::memory::AllocResult;
use crate::numerics::distance;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    /// INSERTINPUT(v): larger cages where `input` encroaches from inside, a new cage where it is
    /// not medial, then INSERT. The paper makes the new cage first; when the nearest neighbour is
    /// itself a vertex of the encroached cage, the new one would stick out of that, release it
    /// from outside and leave nothing to grow. Whether nothing of that is left to do (`rim`).
    pub(super) fn insert_input(&mut self, input: u32) -> Result<bool> {
        if self.is_inserted(input) {
            return Ok(true);
        }
        self.find_cavity_of_input(input)?;
        match self.parameters.algorithm {
            Algorithm::Netmesh => {}
            Algorithm::Svr => {
                self.hierarchy.set_domain(input, ROOT);
                return self.insert_into_cavity(input).map(|()| true);
            }
            Algorithm::Delaunay => return self.insert_into_cavity(input).map(|()| true),
        }
        let x = *self.delaunay.point(input);
        if !self.may_insert(&x) {
            return Ok(false);
        }
        for _ in 0..LEVELS {
            let Some(domain) = self.inner_encroached(input) else { break };
            let start = self.location.home(input);
            if !self.grow_cage_for(domain, &x, start)? {
                return Ok(false);
            }
            if !self.look_again(input)? {
                return Ok(true);
            }
        }
        if let Some(wanted) = self.wanted_cage(input)? {
            if !self.may_make_cage(&wanted)? {
                return Ok(false);
            }
            let start = self.location.home(input);
            self.new_cage(wanted, start)?;
            if !self.look_again(input)? {
                return Ok(true);
            }
        }
        if !self.may_insert(&x) {
            return Ok(false);
        }
        let domain = self.enter(&x)?;
        self.hierarchy.set_domain(input, domain);
        self.insert_into_cavity(input)?;
        Ok(true)
    }

    /// Finds the cavity of `input` anew after a cage operation, unless a cage took it in.
    fn look_again(&mut self, input: u32) -> AllocResult<bool> {
        if self.is_inserted(input) {
            return Ok(false);
        }
        self.find_cavity_of_input(input)?;
        Ok(true)
    }

    pub(super) fn find_cavity_of_input(&mut self, input: u32) -> AllocResult<()> {
        let q = *self.delaunay.point(input);
        let home = self.location.home(input);
        self.delaunay.find_cavity(home, &q, &mut self.scratch.cavity)
    }

    /// INSERT, second half: adds `vertex`, whose conflicts are the scratch cavity and whose
    /// domain is set, to the Voronoi diagram; updates homes, distances and the refine list.
    pub(super) fn insert_into_cavity(&mut self, vertex: u32) -> Result<()> {
        let Scratch { cavity, created, .. } = &mut self.scratch;
        let work = 4 * cavity.boundary.len() as u32;
        self.delaunay.insert(vertex, cavity, created)?;
        self.location.rehome(&self.delaunay, cavity, created, vertex, &mut self.watch)?;
        self.refine.forget(created, self.delaunay.complex().simplex_bound())?;
        self.rim.forget(created);
        if self.parameters.algorithm != Algorithm::Delaunay {
            self.update_star(vertex)?;
            if self.parameters.instruments {
                self.observe_insertion(vertex)?;
            }
        }
        if self.parameters.algorithm == Algorithm::Svr {
            self.queue_crowded()?;
        }
        if self.watch.is_due(work) {
            self.report_progress()?;
        }
        Ok(())
    }

    /// Nearest distances, cages' clearances and the quality of cells after `vertex` went in. Its
    /// neighbours are the corners of its cavity: no vertex is inside that, for all keep a star.
    fn update_star(&mut self, vertex: u32) -> AllocResult<()> {
        let mut nearest = f64::INFINITY;
        let neighbors = std::mem::take(&mut self.scratch.cavity.corners.ids);
        let x = *self.delaunay.point(vertex);
        let mut nearer = std::mem::take(&mut self.scratch.nearer);
        nearer.clear();
        nearer.make_room(neighbors.len())?;
        let cells: &mut [Cell] = &mut self.cells;
        for &neighbor in &neighbors {
            let gap = distance(&x, self.delaunay.point(neighbor));
            nearest = nearest.min(gap);
            let cell = &mut cells[neighbor as usize];
            let is_nearer = gap < cell.nearest;
            cell.nearest = if is_nearer { gap } else { cell.nearest };
            nearer.push_if(is_nearer, neighbor);
        }
        cells[vertex as usize].nearest = nearest;
        let are_alike =
            self.hierarchy.is_alike(&neighbors) && self.hierarchy.is_alike(&[vertex, neighbors[0]]);
        if !are_alike {
            self.update_clearances(vertex, &neighbors)?;
        }
        self.scratch.cavity.corners.ids = neighbors;
        self.examine_created(are_alike)?;
        for &neighbor in &nearer {
            self.examine_cell(neighbor)?;
        }
        self.scratch.nearer = nearer;
        Ok(())
    }

    /// The nearest distance of a corner of the first simplex; its farthest corner is not known.
    pub(super) fn measure_nearest(&mut self, vertex: u32) {
        let simplex = self.delaunay.complex().incident(vertex);
        let x = self.delaunay.point(vertex);
        let nearest = self
            .delaunay
            .complex()
            .vertices(simplex)
            .iter()
            .filter(|&&other| some(other).is_some() && other != vertex)
            .map(|&other| distance(x, self.delaunay.point(other)))
            .fold(f64::INFINITY, f64::min);
        self.cells[vertex as usize].nearest = nearest;
        self.cells[vertex as usize].farthest = f64::INFINITY;
    }
}
