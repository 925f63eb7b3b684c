//! Findings of the certificate: the first violation in words, and counts that all ranks have.

use crate::comm::Communicator;
use crate::distributed::NO_ID;
use crate::words::{Words, append};
use netmesh::{Error, ErrorKind, Result};

/// Bytes of a message that fit the C ABI's `char[160]` with its NUL.
const MESSAGE_BYTES: usize = 159;

/// The rule that a [`Violation`] breaks (values are part of the C ABI: append only). 1 to 99 belong
/// to level 1, 101 to 199 to level 2, 201 to 299 to level 3. A rule of [`netmesh::validate`] has
/// the value that it has there; those from 51 on are of what ranks have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Rule {
    /// An array does not have the length that the others ask for.
    ArrayLength = 1,
    /// A coordinate is infinite or not a number.
    NonFinite = 2,
    /// A simplex names a vertex that does not exist.
    VertexOutOfRange = 3,
    /// A simplex names a vertex twice.
    RepeatedVertex = 4,
    /// A vertex is in no simplex.
    UnusedVertex = 5,
    /// A simplex names a neighbour that is neither an own simplex nor a ghost.
    NeighborOutOfRange = 6,
    /// Two simplices have the same vertices.
    DuplicateSimplex = 7,
    /// A facet is in more than two simplices.
    OverfullFacet = 8,
    /// A simplex shares a facet with another one but names no neighbour there.
    MissingNeighbor = 9,
    /// A simplex names another neighbour than the one that shares its facet.
    NeighborFacet = 11,
    /// The numbers of faces of each dimension do not add up to a ball's.
    EulerCharacteristic = 13,
    /// The simplices round a vertex are not connected through facets at that vertex.
    VertexStar = 14,
    /// The link of a vertex is not a sphere, or on the hull a ball, by its Euler characteristic.
    VertexLink = 15,
    /// A hull ridge is not in exactly two hull facets.
    HullRidge = 16,
    /// Ids do not rise, or are out of range, or two ranks count them from different numbers.
    Ids = 51,
    /// Two ranks have different coordinates, kinds, domains or cages of a vertex.
    SharedVertex = 52,
    /// The owner of a vertex is not the lowest rank that has a simplex with it.
    VertexOwner = 53,
    /// A ghost is not what its owner has under its id, or shares no vertex with the rank.
    Ghost = 54,
    /// A simplex that shares a vertex with the rank is not among its ghosts.
    MissingGhost = 55,
    /// The interface is not the facets whose neighbours are ghosts.
    Interface = 56,
    /// The sizes of the whole mesh are not those of all parts.
    Totals = 57,
    /// Two ranks have different centres, radii or parents of a domain.
    SharedDomain = 58,

    /// A simplex is flat or negatively oriented.
    Orientation = 101,
    /// Two neighbours lie on the same side of the facet that they share.
    FoldedFacet = 102,
    /// The opposite vertex of a neighbour is strictly inside a simplex's circumball.
    Delaunay = 103,
    /// The hull is not convex at a ridge.
    NonConvexHull = 104,

    /// An input's vertex does not exist, or is not that of the first of equal inputs.
    InputVertex = 201,
    /// The vertex of a distinct input does not have that input's bits.
    InputBits = 202,
    /// A vertex's kind contradicts its id: those of inputs are below the number of inputs.
    VertexKind = 203,
    /// The domains are not a tree: the root is not the only one without a parent, or a ball is
    /// larger than its parent's.
    DomainTree = 205,
    /// A domain's radius is not positive and finite.
    DomainBall = 206,
    /// The vertex at a domain's centre is elsewhere, or not labelled as in that domain's subtree.
    DomainCenter = 207,
    /// A domain's ball reaches out of its parent's.
    DomainOutsideParent = 208,
    /// A vertex is labelled with a domain that does not exist, or that does not contain it.
    VertexDomain = 210,
    /// A vertex's kind contradicts the cage that it is part of, or it is outside of that cage's
    /// domain.
    CageOf = 211,
    /// A cage vertex is not near its cage's sphere.
    CageRadius = 212,
    /// A cage has too few vertices to enclose its domain's centre.
    CageIncomplete = 213,
    /// A vertex on the hull is not of the root's cage.
    HullVertex = 214,
    /// An input inside a domain's ball encroaches its cage (Definition 2).
    InnerEncroachment = 215,
    /// A vertex outside a domain's ball encroaches its cage (Definition 2).
    OuterEncroachment = 216,
    /// Simplices span more domains than un-encroached cages allow.
    DomainSpan = 217,
    /// The Voronoi cell of a vertex has a worse aspect than the bound.
    VertexAspect = 218,
    /// The union cell of a cage has a worse aspect than the bound.
    CageAspect = 219,
    /// A simplex has a larger ratio of circumradius to shortest edge than the bound.
    RadiusEdge = 220,
    /// A finished mesh has other domains than the root.
    NotFinished = 221,
}

impl Rule {
    pub const ALL: [Self; 45] = [
        Self::ArrayLength,
        Self::NonFinite,
        Self::VertexOutOfRange,
        Self::RepeatedVertex,
        Self::UnusedVertex,
        Self::NeighborOutOfRange,
        Self::DuplicateSimplex,
        Self::OverfullFacet,
        Self::MissingNeighbor,
        Self::NeighborFacet,
        Self::EulerCharacteristic,
        Self::VertexStar,
        Self::VertexLink,
        Self::HullRidge,
        Self::Ids,
        Self::SharedVertex,
        Self::VertexOwner,
        Self::Ghost,
        Self::MissingGhost,
        Self::Interface,
        Self::Totals,
        Self::SharedDomain,
        Self::Orientation,
        Self::FoldedFacet,
        Self::Delaunay,
        Self::NonConvexHull,
        Self::InputVertex,
        Self::InputBits,
        Self::VertexKind,
        Self::DomainTree,
        Self::DomainBall,
        Self::DomainCenter,
        Self::DomainOutsideParent,
        Self::VertexDomain,
        Self::CageOf,
        Self::CageRadius,
        Self::CageIncomplete,
        Self::HullVertex,
        Self::InnerEncroachment,
        Self::OuterEncroachment,
        Self::DomainSpan,
        Self::VertexAspect,
        Self::CageAspect,
        Self::RadiusEdge,
        Self::NotFinished,
    ];
}

/// One broken rule, with the ids in the whole mesh that it concerns ([`NO_ID`] where none).
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    pub rule: Rule,
    /// The rank whose part of the mesh breaks it.
    pub rank: usize,
    pub simplex: u64,
    pub vertex: u64,
    /// One sentence that names the rule and the values, at most 159 bytes.
    pub message: String,
}

impl Violation {
    pub fn new(rule: Rule, rank: usize, mut message: String) -> Self {
        let mut end = message.len().min(MESSAGE_BYTES);
        while !message.is_char_boundary(end) {
            end -= 1;
        }
        message.truncate(end);
        Self { rule, rank, simplex: NO_ID, vertex: NO_ID, message }
    }

    pub fn simplex(self, simplex: u64) -> Self {
        Self { simplex, ..self }
    }

    pub fn vertex(self, vertex: u64) -> Self {
        Self { vertex, ..self }
    }
}

/// Findings of the certificate, equal on all ranks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The highest level that holds in full, with all below it; 0 if level 1 does not. Never above
    /// the level that was asked for.
    pub level: u32,
    /// Violations that all ranks have found. Checks that would stand on a broken array are not
    /// made.
    pub violations: u64,
    /// Number of single checks made on all ranks.
    pub checked: u64,
    /// First violation of the lowest level that does not hold, on the lowest rank that found one.
    pub first: Option<Violation>,
}

/// Counts checks of a rank and keeps the first violation. Messages are made for that one only.
#[derive(Default)]
pub struct Findings {
    violations: u64,
    checked: u64,
    first: Option<Violation>,
}

impl Findings {
    /// Records one check; returns whether it held.
    pub fn check(&mut self, holds: bool, violation: impl FnOnce() -> Violation) -> bool {
        self.checked += 1;
        if !holds {
            self.violations += 1;
            if self.first.is_none() {
                self.first = Some(violation());
            }
        }
        holds
    }

    /// Returns true if everything so far held on this rank.
    pub fn is_clean(&self) -> bool {
        self.violations == 0
    }

    /// Collective. Returns true if everything so far held on all ranks.
    pub fn clean_everywhere(&self, comm: &dyn Communicator) -> Result<bool> {
        Ok(comm.exclusive_sum(self.violations)?.1 == 0)
    }

    /// Collective. Returns what all ranks have found, as if one had.
    pub fn of_all(self, comm: &dyn Communicator) -> Result<Self> {
        let mut message = Vec::new();
        append(&mut message, &[self.violations, self.checked])?;
        if let Some(first) = &self.first {
            let place = [first.rule as u64, first.rank as u64, first.simplex, first.vertex];
            append(&mut message, &place)?;
            message.extend_from_slice(first.message.as_bytes());
        }
        let mut all = Self::default();
        for message in comm.all_gather(&message)? {
            let (words, text) = message.split_at(message.len().min(6 * 8));
            let mut words = Words::new(words);
            all.violations += words.next()?;
            all.checked += words.next()?;
            if !words.is_empty() && all.first.is_none() {
                let value = words.next()?;
                let rule = Rule::ALL.into_iter().find(|rule| *rule as u64 == value);
                let rule = rule.ok_or_else(|| Error::new(ErrorKind::Panic, "a rule is unknown"))?;
                let rank = words.next()? as usize;
                let violation =
                    Violation::new(rule, rank, String::from_utf8_lossy(text).into_owned());
                all.first = Some(violation.simplex(words.next()?).vertex(words.next()?));
            }
        }
        Ok(all)
    }

    /// Adds a level to a report; all levels below it hold.
    pub fn enter(self, report: &mut Report) -> bool {
        let holds = self.is_clean();
        report.violations += self.violations;
        report.checked += self.checked;
        report.first = report.first.take().or(self.first);
        holds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::threads;
    use netmesh::validate::ViolationKind;

    #[test]
    fn rules_of_one_process_have_its_values() {
        let same = [
            (Rule::ArrayLength, ViolationKind::ArrayLength),
            (Rule::NonFinite, ViolationKind::NonFinite),
            (Rule::VertexOutOfRange, ViolationKind::VertexOutOfRange),
            (Rule::RepeatedVertex, ViolationKind::RepeatedVertex),
            (Rule::UnusedVertex, ViolationKind::UnusedVertex),
            (Rule::NeighborOutOfRange, ViolationKind::NeighborOutOfRange),
            (Rule::DuplicateSimplex, ViolationKind::DuplicateSimplex),
            (Rule::OverfullFacet, ViolationKind::OverfullFacet),
            (Rule::MissingNeighbor, ViolationKind::MissingNeighbor),
            (Rule::NeighborFacet, ViolationKind::NeighborFacet),
            (Rule::EulerCharacteristic, ViolationKind::EulerCharacteristic),
            (Rule::VertexStar, ViolationKind::VertexStar),
            (Rule::VertexLink, ViolationKind::VertexLink),
            (Rule::HullRidge, ViolationKind::HullRidge),
            (Rule::Orientation, ViolationKind::Orientation),
            (Rule::FoldedFacet, ViolationKind::FoldedFacet),
            (Rule::Delaunay, ViolationKind::Delaunay),
            (Rule::NonConvexHull, ViolationKind::NonConvexHull),
            (Rule::InputVertex, ViolationKind::InputVertex),
            (Rule::InputBits, ViolationKind::InputBits),
            (Rule::VertexKind, ViolationKind::VertexKind),
            (Rule::DomainTree, ViolationKind::DomainTree),
            (Rule::DomainBall, ViolationKind::DomainBall),
            (Rule::DomainCenter, ViolationKind::DomainCenter),
            (Rule::DomainOutsideParent, ViolationKind::DomainOutsideParent),
            (Rule::VertexDomain, ViolationKind::VertexDomain),
            (Rule::CageOf, ViolationKind::CageOf),
            (Rule::CageRadius, ViolationKind::CageRadius),
            (Rule::CageIncomplete, ViolationKind::CageIncomplete),
            (Rule::HullVertex, ViolationKind::HullVertex),
            (Rule::InnerEncroachment, ViolationKind::InnerEncroachment),
            (Rule::OuterEncroachment, ViolationKind::OuterEncroachment),
            (Rule::DomainSpan, ViolationKind::DomainSpan),
            (Rule::VertexAspect, ViolationKind::VertexAspect),
            (Rule::CageAspect, ViolationKind::CageAspect),
            (Rule::RadiusEdge, ViolationKind::RadiusEdge),
            (Rule::NotFinished, ViolationKind::NotFinished),
        ];
        assert!(same.iter().all(|(rule, kind)| *rule as u32 == *kind as u32));
        let between = |rule: &&Rule| (51..100).contains(&(**rule as u32));
        assert_eq!(same.len() + Rule::ALL.iter().filter(between).count(), Rule::ALL.len());
    }

    #[test]
    fn ranks_agree_on_the_first_violation() {
        let reports = threads::run(4, |comm| {
            let mut findings = Findings::default();
            findings.check(true, || unreachable!());
            findings.check(comm.rank() % 2 == 0, || {
                let message = format!("rank {} {}", comm.rank(), "é".repeat(100));
                Violation::new(Rule::Ghost, comm.rank(), message).simplex(7)
            });
            assert!(!findings.clean_everywhere(comm).unwrap());
            let mut report = Report::default();
            assert!(!findings.of_all(comm).unwrap().enter(&mut report));
            report
        });
        for report in &reports {
            assert_eq!((report.level, report.violations, report.checked), (0, 2, 8));
            let first = report.first.as_ref().unwrap();
            assert_eq!((first.rule, first.rank, first.simplex), (Rule::Ghost, 1, 7));
            assert_eq!((first.vertex, first.message.len()), (NO_ID, 159));
            assert!(first.message.starts_with("rank 1 é"));
        }
    }
}
