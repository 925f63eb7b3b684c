//! Location of a point: a walk from a vertex nearby, every step decided by an exact sign.

use super::Index;
use super::marked_ids::MarkedIds;
use super::view::View;
use crate::memory::AllocResult;
use crate::mesh::NONE;
use crate::nearest::{Stop, sort_by_leaf};
use crate::numerics::{Sign, coordinates, orientation};

/// Simplex that holds a point, and the face of it whose interior does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The simplex that holds it, the least where several do; [`NONE`] outside.
    pub simplex: u32,
    /// The least face of that simplex that holds it: bit i stands for the simplex's vertex i. With
    /// all bits the point is in the interior, with one it is a vertex, with none it is outside.
    pub face: u32,
}

impl Place {
    pub const OUTSIDE: Self = Self { simplex: NONE, face: 0 };

    /// Returns the dimension of the face that holds the point in its interior: 0 for a vertex, 1
    /// for an edge, the mesh's for a simplex; `None` outside.
    pub fn dimension(&self) -> Option<u32> {
        self.face.count_ones().checked_sub(1)
    }
}

/// The simplex alone.
impl From<Place> for u32 {
    fn from(place: Place) -> Self {
        place.simplex
    }
}

/// Memory that a thread uses again.
#[derive(Default)]
pub(super) struct Scratch {
    pub keys: Vec<u64>,
    pub set: MarkedIds,
}

/// Finds the places of points one after the other.
pub(super) struct Locator<'a, const D: usize> {
    pub view: View<'a, D>,
    pub index: &'a Index,
    /// Simplices from this number on were cropped from the mesh.
    end: u32,
    /// The state of a generator of numbers, which decide where a step looks first.
    random: u32,
    /// Places are of no use any more once it is set.
    stop: Stop<'a>,
}

impl<'a, const D: usize> Locator<'a, D> {
    const ALL: u32 = (1 << (D + 1)) - 1;

    pub fn new(view: View<'a, D>, index: &'a Index, stop: Stop<'a>) -> Self {
        let end = view.mesh.simplex_count() as u32;
        // The hull of a cropped mesh need not be convex.
        match (view.mesh.boundary.whole.as_deref(), index.whole.as_deref()) {
            (Some(mesh), Some(index)) => Self { view: View { mesh }, index, end, random: 1, stop },
            _ => Self { view, index, end, random: 1, stop },
        }
    }

    /// Calls `take` with the number and the place of each of the points, near ones in turn, until
    /// the work is stopped.
    pub fn each(
        &mut self,
        points: &[f64],
        scratch: &mut Scratch,
        mut take: impl FnMut(&mut Self, &mut Scratch, usize, Place) -> AllocResult<()>,
    ) -> AllocResult<()> {
        // To sort all that is left would take as long as many answers.
        if self.stop.is_set() {
            return Ok(());
        }
        sort_by_leaf::<D>(&self.index.all, points, &mut scratch.keys)?;
        for k in 0..scratch.keys.len() {
            if self.stop.is_set() {
                break;
            }
            let (leaf, at) = ((scratch.keys[k] >> 32) as usize, scratch.keys[k] as u32 as usize);
            let place = self.place(leaf, coordinates(points, at), &mut scratch.set)?;
            take(self, scratch, at, place)?;
        }
        Ok(())
    }

    /// Locates a point that belongs in that leaf of the tree of all vertices.
    pub fn place(&mut self, leaf: usize, q: &[f64; D], set: &mut MarkedIds) -> AllocResult<Place> {
        let near = self.index.all.near(leaf, q);
        let start = near.map_or(NONE, |vertex| self.index.least_simplex[vertex as usize]);
        match self.holder(start, q) {
            Some((simplex, face)) => {
                let place = self.least_place(simplex, face, set)?;
                Ok(if place.simplex < self.end { place } else { Place::OUTSIDE })
            }
            None => Ok(Place::OUTSIDE),
        }
    }

    /// Returns a simplex that holds `q`, and the face of it that does; `None` outside.
    fn holder(&mut self, start: u32, q: &[f64; D]) -> Option<(u32, u32)> {
        if start == NONE {
            return None;
        }
        let (mut previous, mut current) = (NONE, start);
        for _ in 0..self.view.mesh.simplex_count() {
            if self.stop.is_set() {
                return None;
            }
            match self.step(current, previous, q) {
                Ok(face) => return Some((current, face)),
                // The hull is convex: a point beyond one of its facets is outside.
                Err(NONE) => return None,
                Err(next) => (previous, current) = (current, next),
            }
        }
        self.scan(q)
    }

    /// Returns the face of `simplex` that holds `q` or, if none does, the neighbour across a facet
    /// that has `q` strictly on its other side. A walk that came from `previous` does not look back
    /// there.
    ///
    /// In a Delaunay triangulation such a walk passes balls of ever smaller power of `q` (H.
    /// Edelsbrunner, "An acyclicity theorem for cell complexes in d dimensions", 1990), except
    /// among cospherical vertices, where it may go in a circle; it leaves that at random.
    fn step(&mut self, simplex: u32, previous: u32, q: &[f64; D]) -> Result<u32, u32> {
        let neighbors = self.view.neighbors(simplex);
        let mut points = self.view.points_of(self.view.simplex(simplex));
        self.random = self.random.wrapping_mul(0x0019_660d).wrapping_add(0x3c6e_f35f);
        let mut index = ((u64::from(self.random) * (D as u64 + 1)) >> 32) as usize;
        let mut face = Self::ALL;
        for _ in 0..=D {
            index = if index == D { 0 } else { index + 1 };
            if neighbors[index] == previous && previous != NONE {
                continue;
            }
            let kept = std::mem::replace(&mut points[index], q);
            match orientation(&points[..=D]) {
                Sign::Negative => return Err(neighbors[index]),
                Sign::Zero => face &= !(1 << index),
                Sign::Positive => (),
            }
            points[index] = kept;
        }
        Ok(face)
    }

    /// Tries all simplices, for a point that a walk of as many steps as there are simplices has not
    /// found.
    #[cold]
    fn scan(&mut self, q: &[f64; D]) -> Option<(u32, u32)> {
        let count = self.view.mesh.simplex_count() as u32;
        let stop = self.stop;
        let mut all = (0..count).take_while(|_| !stop.is_set());
        all.find_map(|simplex| Some((simplex, self.step(simplex, NONE, q).ok()?)))
    }

    /// Returns the place of the same face in the least of all simplices that have it.
    fn least_place(&self, simplex: u32, face: u32, set: &mut MarkedIds) -> AllocResult<Place> {
        let vertices = self.view.simplex(simplex);
        let least = match face.count_ones() as usize {
            count if count == D + 1 => return Ok(Place { simplex, face }),
            count if count == D => {
                let opposite = (Self::ALL & !face).trailing_zeros() as usize;
                simplex.min(self.view.neighbors(simplex)[opposite])
            }
            1 => self.index.least_simplex[vertices[face.trailing_zeros() as usize] as usize],
            _ => self.least_around(simplex, face, set)?,
        };
        let is_of_face = |v: &u32| {
            let at = vertices.iter().position(|other| other == v);
            at.is_some_and(|at| face >> at & 1 == 1)
        };
        let bit = |(i, v): (usize, &u32)| u32::from(is_of_face(v)) << i;
        let face = self.view.simplex(least).iter().enumerate().map(bit).sum();
        Ok(Place { simplex: least, face })
    }

    /// Returns the least simplex that has a face of `simplex`. Those that have it are connected by
    /// facets that have it too.
    fn least_around(&self, simplex: u32, face: u32, set: &mut MarkedIds) -> AllocResult<u32> {
        let mut of_face = [NONE; 8];
        let own = self.view.simplex(simplex);
        let members = (0..=D).filter(|i| face >> i & 1 == 1);
        of_face.iter_mut().zip(members).for_each(|(v, i)| *v = own[i]);
        set.clear();
        set.add(simplex, true)?;
        let (mut least, mut done) = (simplex, 0);
        while let Some(member) = set.members().get(done) {
            done += 1;
            let id = member.id;
            least = least.min(id);
            let pairs = self.view.simplex(id).iter().zip(self.view.neighbors(id));
            for (v, &neighbor) in pairs {
                if neighbor != NONE && !of_face.contains(v) && set.mark(neighbor).is_none() {
                    set.add(neighbor, true)?;
                }
            }
        }
        Ok(least)
    }
}
