//! The domains of pieces. A partition that has the centre of a domain, its cage, and all simplices
//! at them may grow or release it. Others know what it was when one that joined them last had all
//! of it; they may lower its clearance and add to its cage, and what all know together counts.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::netmesh::distributed::names::{NOTHING, ROOT_NAME, made_by};
use crate::netmesh::distributed::piece::{NamedDomain, NamedVertex, Piece};
use crate::netmesh::state::hierarchy::{DomainId, Hierarchy, ROOT};

/// Names, versions and owners of a partition's domains, which its hierarchy does not have.
pub(super) struct Domains {
    /// Domain -> name.
    names: Vec<u64>,
    versions: Vec<u64>,
    /// Domain -> its centre and the vertices of its cage, where the partition may not change it.
    fixed: Vec<Option<(u64, Vec<u64>)>>,
    released: Vec<[u64; 2]>,
    /// Number of domains that other partitions may know.
    known: usize,
}

/// Makes the hierarchy of the domains of all `pieces`, over vertices that `vertices` describes and
/// that have the given names. `shared`: vertex -> true if others have simplices at it.
pub(super) fn with_domains<const D: usize>(
    pieces: &[Piece<D>],
    vertices: &[NamedVertex<D>],
    names: &[u64],
    shared: &[bool],
) -> AllocResult<(Hierarchy<D>, Domains)> {
    let mut released = collected(pieces.iter().flat_map(|piece| piece.released.iter().copied()))?;
    released.sort_unstable();
    released.dedup();
    let taken_by = |mut name: u64| {
        while let Ok(at) = released.binary_search_by_key(&name, |&[name, _]| name) {
            name = released[at][1];
        }
        name
    };
    let mut copies: Vec<&NamedDomain<D>> =
        collected(pieces.iter().flat_map(|piece| &piece.domains))?;
    copies.retain(|domain| taken_by(domain.name) == domain.name);
    // By name, the latest version first. The root has the least name.
    copies.sort_unstable_by_key(|domain| (domain.name, u64::MAX - domain.version));
    let mut latest = Vec::new();
    for copies in copies.chunk_by(|a, b| a.name == b.name) {
        latest.try_push(merged(copies)?)?;
    }
    let id = |name: u64| match name {
        NOTHING => DomainId::NONE,
        _ => {
            let name = taken_by(name);
            let at = latest.binary_search_by_key(&name, |domain| domain.name);
            DomainId::new(at.expect("a piece has the domains around its own"))
        }
    };
    let own = vertices_of_domains(&latest, names)?;
    let vertex = |name: u64| {
        let at = own.binary_search_by_key(&name, |&(name, _)| name).ok()?;
        let vertex = own[at].1;
        (!shared[vertex]).then(|| VertexId::new(vertex))
    };
    let mut hierarchy = Hierarchy::new(vertices.len())?;
    let mut domains = Domains {
        names: with_capacity(latest.len())?,
        versions: with_capacity(latest.len())?,
        fixed: with_capacity(latest.len())?,
        released: Vec::new(),
        known: latest.len(),
    };
    for domain in &latest {
        let parent = id(domain.parent);
        let center = vertex(domain.center);
        let is_owned = domain.name != ROOT_NAME
            && center.is_some()
            && domain.cage.iter().all(|&name| vertex(name).is_some());
        let made = hierarchy.create(
            center.unwrap_or(VertexId::NONE),
            domain.point,
            domain.radius,
            parent,
            if is_owned { domain.cage.len() } else { 0 },
        )?;
        let node = hierarchy.node_mut(made);
        node.outside = domain.outside;
        if is_owned {
            node.cage.extend(domain.cage.iter().filter_map(|&name| vertex(name)));
        }
        domains.names.push(domain.name);
        domains.versions.push(domain.version);
        domains.fixed.push(match is_owned {
            true => None,
            false => Some((domain.center, collected(domain.cage.iter().copied())?)),
        });
    }
    for (number, named) in vertices.iter().enumerate() {
        let vertex = VertexId::new(number);
        hierarchy.set_domain(vertex, id(named.domain));
        // The cage of a domain that was dissolved is a cage no more.
        if named.cage != NOTHING && taken_by(named.cage) == named.cage {
            hierarchy.set_cage(vertex, id(named.cage));
        }
    }
    domains.released = released;
    Ok((hierarchy, domains))
}

/// Returns the domain that `copies` describe together, the latest first. Every partition that has
/// vertices on both sides may have lowered the clearance and narrowed gaps of the cage.
fn merged<const D: usize>(copies: &[&NamedDomain<D>]) -> AllocResult<NamedDomain<D>> {
    let mut cage = collected(copies[0].cage.iter().copied())?;
    let mut outside = copies[0].outside;
    for copy in &copies[1..] {
        outside = outside.min(copy.outside);
        if copy.cage != copies[0].cage {
            cage.try_extend(&copy.cage)?;
        }
    }
    if cage.len() > copies[0].cage.len() {
        cage.sort_unstable();
        cage.dedup();
    }
    Ok(NamedDomain { outside, cage, ..*copies[0] })
}

/// Returns the names and ids of the centres and the vertices of cages that there are.
fn vertices_of_domains<const D: usize>(
    domains: &[NamedDomain<D>],
    names: &[u64],
) -> AllocResult<Vec<(u64, usize)>> {
    let mut wanted = collected(
        domains.iter().flat_map(|domain| domain.cage.iter().copied().chain([domain.center])),
    )?;
    wanted.sort_unstable();
    wanted.dedup();
    let all = names.iter().copied().zip(0..);
    let mut found = Vec::new();
    for (name, vertex) in all.filter(|(name, _)| wanted.binary_search(name).is_ok()) {
        found.try_push((name, vertex))?;
    }
    found.sort_unstable();
    Ok(found)
}

impl Domains {
    /// Returns the name of `domain`, which may be none.
    pub fn name(&self, domain: DomainId) -> u64 {
        match domain.is_valid() {
            true => self.names[domain.index()],
            false => NOTHING,
        }
    }

    /// Returns the living domain of that name, if the pieces have it.
    pub fn of_name(&self, name: u64) -> Option<DomainId> {
        self.names[..self.known].binary_search(&name).ok().map(DomainId::new)
    }

    /// Returns, for every domain, true if the partition must leave it as it is.
    pub fn non_owned(&self) -> AllocResult<Vec<bool>> {
        collected(self.fixed.iter().map(Option::is_some))
    }

    /// Names the domains that the partition has made.
    pub fn name_new<const D: usize>(
        &mut self,
        hierarchy: &Hierarchy<D>,
        maker: u32,
    ) -> AllocResult<()> {
        let known = self.names.len();
        for number in known..hierarchy.len() {
            self.names.try_push(made_by(maker, number - known))?;
            self.versions.try_push(0)?;
            self.fixed.try_push(None)?;
        }
        Ok(())
    }

    /// Writes the living domains to `piece`, and the dissolved ones of which others may know.
    /// `names`: vertex -> name. `has_work_left`: domain -> true if something is left to do there.
    pub fn write<const D: usize>(
        &mut self,
        hierarchy: &mut Hierarchy<D>,
        names: &[u64],
        has_work_left: impl Fn(DomainId) -> bool,
        piece: &mut Piece<D>,
    ) -> AllocResult<()> {
        piece.released = std::mem::take(&mut self.released);
        for domain in (0..hierarchy.len()).map(DomainId::new) {
            if !hierarchy.node(domain).alive {
                if domain.index() < self.known {
                    let taker = hierarchy.find(domain);
                    piece.released.try_push([self.name(domain), self.name(taker)])?;
                }
                continue;
            }
            let at = domain.index();
            let parent = hierarchy.parent(domain);
            let node = hierarchy.node(domain);
            let own = node.cage.iter().map(|vertex| names[vertex.index()]);
            let (center, cage) = match self.fixed[at].take() {
                Some((center, mut cage)) => {
                    own.into_iter().try_for_each(|name| cage.try_push(name))?;
                    (center, cage)
                }
                None => {
                    self.versions[at] += 1;
                    (names[node.center.index()], collected(own)?)
                }
            };
            debug_assert!((domain == ROOT) == (self.names[at] == ROOT_NAME));
            if domain != ROOT && has_work_left(domain) {
                piece.wanted.try_push(self.names[at])?;
            }
            piece.domains.try_push(NamedDomain {
                name: self.names[at],
                parent: self.name(parent),
                point: node.point,
                radius: node.radius,
                outside: node.outside,
                center,
                cage,
                version: self.versions[at],
            })?;
        }
        piece.wanted.sort_unstable();
        Ok(())
    }
}

/// Nothing known: the domains of a mesh that one process has begun.
impl Default for Domains {
    fn default() -> Self {
        Self {
            names: Vec::new(),
            versions: Vec::new(),
            fixed: Vec::new(),
            released: Vec::new(),
            known: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_all_copies_of_a_domain_know_counts() {
        let copy = |version, parent, outside, cage: &[u64]| NamedDomain::<2> {
            name: 5,
            parent,
            point: [0.5; 2],
            radius: 1.0,
            outside,
            center: 7,
            cage: cage.to_vec(),
            version,
        };
        let latest = copy(3, 2, 8.0, &[12, 10, 11]);
        assert_eq!(merged(&[&latest]).unwrap(), latest);
        let copies = [&latest, &copy(3, 2, 6.0, &[12, 10, 11, 40]), &copy(2, 1, 7.0, &[10, 30])];
        assert_eq!(merged(&copies).unwrap(), copy(3, 2, 6.0, &[10, 11, 12, 30, 40]));
    }
}
