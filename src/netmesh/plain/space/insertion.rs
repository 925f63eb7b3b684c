//! A point goes into a triangulation of space: a walk finds its tetrahedron, all those whose balls
//! it is in make room for its star (Bowyer 1981, Watson 1981).

use super::links::Links;
use super::region::Region;
use super::room::Room;
use super::signs::Signs;
use super::tetrahedra::{FACES, Face, INFINITE, Record, Tetrahedra};
use crate::memory::{AllocResult, TryGrow, reserve};
use crate::numerics::Sign;

/// Outcome of an insertion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Outcome {
    Inserted,
    /// It is not in, since its walk or its cavity leaves the region.
    Leaves,
    /// It is not in, since there is no room for its star.
    LacksRoom,
}

/// One that inserts points, in a region of space of its own.
pub(super) struct Inserter<'a> {
    points: &'a [[f64; 3]],
    region: Region,
    signs: Signs<'a>,
    pub room: Room,
    /// A finite tetrahedron of the last vertex, where the next walk begins.
    pub last: u32,
    cavity: Vec<u32>,
    rim: Vec<RimFace>,
    links: Links,
    pub steps: u64,
    pub most_steps: u64,
    pub created: u64,
}

/// A face between a cavity and what stays.
#[derive(Clone, Copy)]
struct RimFace {
    /// Corners in the order of [`FACES`] for the tetrahedron of the cavity.
    corners: [u32; 3],
    outside: Face,
}

impl<'a> Inserter<'a> {
    /// Begins in all of space, at a finite tetrahedron.
    pub fn new(points: &'a [[f64; 3]], last: u32) -> Self {
        Self::at(points, Region::ALL, Signs::new(points), last)
    }

    /// Returns one that inserts in a region and begins there, at a finite tetrahedron.
    pub fn in_region(&self, region: Region, last: u32) -> Self {
        Self::at(self.points, region, self.signs.again(), last)
    }

    fn at(points: &'a [[f64; 3]], region: Region, signs: Signs<'a>, last: u32) -> Self {
        Self {
            points,
            region,
            signs,
            room: Room::default(),
            last,
            cavity: Vec::new(),
            rim: Vec::new(),
            links: Links::new(),
            steps: 0,
            most_steps: 0,
            created: 0,
        }
    }

    /// Goes on where another one has stopped, with its room and its counts.
    pub fn absorb(&mut self, other: Self) -> AllocResult<()> {
        self.room.join(other.room)?;
        self.last = other.last;
        self.signs.fallbacks += other.signs.fallbacks;
        self.steps += other.steps;
        self.most_steps = self.most_steps.max(other.most_steps);
        self.created += other.created;
        Ok(())
    }

    /// Returns the number of signs that filters did not tell.
    pub fn fallbacks(&self) -> u64 {
        self.signs.fallbacks
    }

    /// Inserts a point, or leaves everything as it was.
    pub fn insert(&mut self, tetrahedra: &Tetrahedra, vertex: u32) -> AllocResult<Outcome> {
        let Some(found) = self.locate(tetrahedra, vertex) else {
            return Ok(Outcome::Leaves);
        };
        let outcome = match self.dig(tetrahedra, found, vertex)? {
            false => Outcome::Leaves,
            true if self.cavity.len() + self.room.size() < self.rim.len() => Outcome::LacksRoom,
            true => {
                self.fill(tetrahedra, vertex)?;
                return Ok(Outcome::Inserted);
            }
        };
        self.cavity.iter().for_each(|&tetrahedron| tetrahedra.at(tetrahedron).revive());
        Ok(outcome)
    }

    /// Returns the tetrahedron that a point is in, or the infinite one whose face it is strictly
    /// beyond; `None` if the walk leaves the region. A walk in a Delaunay triangulation never comes
    /// back (Edelsbrunner 1990).
    pub fn locate(&mut self, tetrahedra: &Tetrahedra, vertex: u32) -> Option<u32> {
        let (mut tetrahedron, mut entered) = (self.last, u32::MAX);
        let mut steps = 1;
        let found = loop {
            let corners = tetrahedra.corners(tetrahedron);
            if !self.is_own(&corners) {
                break None;
            }
            if corners[3] == INFINITE {
                break Some(tetrahedron);
            }
            let beyond = (0..4u32).find(|&place| {
                let face = FACES[place as usize].map(|at| corners[at]);
                4 * tetrahedron + place != entered
                    && self.signs.orientation(face, vertex) == Sign::Negative
            });
            let Some(place) = beyond else {
                break Some(tetrahedron);
            };
            entered = tetrahedra.twin(4 * tetrahedron + place);
            tetrahedron = entered / 4;
            steps += 1;
        };
        self.steps += steps;
        self.most_steps = self.most_steps.max(steps);
        found
    }

    /// Returns true if all finite corners are in the region.
    #[inline]
    pub fn is_own(&self, corners: &[u32; 4]) -> bool {
        let points = self.points;
        let is_in = |corner: u32| corner == INFINITE || self.region.holds(&points[corner as usize]);
        self.region.is_all() || corners.iter().all(|&corner| is_in(corner))
    }

    /// Kills all tetrahedra whose balls a point is in, and collects the faces around them. Returns
    /// false if one is not in the region.
    fn dig(&mut self, tetrahedra: &Tetrahedra, first: u32, vertex: u32) -> AllocResult<bool> {
        self.cavity.clear();
        self.rim.clear();
        self.cavity.try_push(first)?;
        tetrahedra.at(first).kill();
        let point = self.points[vertex as usize];
        let mut next = 0;
        while let Some(&tetrahedron) = self.cavity.get(next) {
            next += 1;
            let record = tetrahedra.at(tetrahedron);
            let (corners, twins) = (record.corners(), record.twins());
            reserve(&mut self.cavity, 4)?;
            reserve(&mut self.rim, 4)?;
            for (place, outside) in twins.into_iter().enumerate() {
                let other = tetrahedra.at(outside / 4);
                if other.is_dead() {
                    continue;
                }
                let others = other.corners();
                let is_in_conflict = match others[3] {
                    INFINITE => self.is_beyond(tetrahedra, other, vertex),
                    _ => self.signs.is_in_sphere(&others, vertex, &point),
                };
                if !is_in_conflict {
                    let corners = FACES[place].map(|at| corners[at]);
                    self.rim.push(RimFace { corners, outside });
                    continue;
                }
                if !self.is_own(&others) {
                    return Ok(false);
                }
                other.kill();
                tetrahedra.prefetch_neighbors(other);
                self.cavity.push(outside / 4);
            }
        }
        Ok(true)
    }

    /// Returns true if a point is strictly beyond the face of an infinite tetrahedron, or on its
    /// plane and inside the ball of the finite one there.
    #[inline(never)]
    fn is_beyond(&mut self, tetrahedra: &Tetrahedra, infinite: &Record, vertex: u32) -> bool {
        let [a, b, c, _] = infinite.corners();
        match self.signs.orientation([a, b, c], vertex) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => {
                let finite = tetrahedra.corners(infinite.twins()[3] / 4);
                self.signs.is_in_sphere_with_care(&finite, vertex)
            }
        }
    }

    /// Fills the cavity with the star of a vertex.
    fn fill(&mut self, tetrahedra: &Tetrahedra, vertex: u32) -> AllocResult<()> {
        self.links.begin(self.rim.len())?;
        let mut places = self.cavity.iter();
        for &RimFace { corners: [a, b, c], outside } in &self.rim {
            let taken = places.next().copied().or_else(|| self.room.take());
            let tetrahedron = taken.expect("there is room for the star");
            let mut tip = Tip { tetrahedra, links: &mut self.links, tetrahedron, outside };
            // Even permutations in which the vertex at infinity is the last corner.
            match [a, b, c].map(|corner| corner == INFINITE) {
                [true, ..] => tip.make::<0>([vertex, c, b, a]),
                [_, true, _] => tip.make::<1>([c, vertex, a, b]),
                [.., true] => tip.make::<2>([b, a, vertex, c]),
                _ => {
                    tip.make::<3>([a, b, c, vertex]);
                    self.last = tetrahedron;
                }
            }
        }
        for &place in places {
            self.room.add(place)?;
        }
        self.created += self.rim.len() as u64;
        Ok(())
    }
}

/// A tetrahedron of a star in the making.
struct Tip<'a> {
    tetrahedra: &'a Tetrahedra,
    links: &'a mut Links,
    tetrahedron: u32,
    /// The face of what stays outside of the star.
    outside: Face,
}

impl Tip<'_> {
    /// Makes it of corners, the one in `PLACE` the vertex of the star, and joins it to what is
    /// outside and to those of the star that have been made before.
    #[inline(always)]
    fn make<const PLACE: usize>(&mut self, corners: [u32; 4]) {
        let Self { tetrahedra, tetrahedron, outside, .. } = *self;
        let record = tetrahedra.at(tetrahedron);
        record.set(corners);
        record.join(PLACE, outside);
        tetrahedra.at(outside / 4).join((outside % 4) as usize, 4 * tetrahedron + PLACE as u32);
        let [a, b, c] = FACES[PLACE];
        for (opposite, [from, to]) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
            let face = 4 * tetrahedron + opposite as u32;
            if let Some(other) = self.links.meet(corners[from], corners[to], face) {
                record.join(opposite, other);
                tetrahedra.at(other / 4).join((other % 4) as usize, face);
            }
        }
    }
}
