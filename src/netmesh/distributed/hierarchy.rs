//! The domains of pieces. A partition that has the centre of a domain, its cage, and all simplices
//! at them may change it. Others know what it was when it was last changed in one that joined them.

use super::names::{NOTHING, ROOT_NAME, made_by};
use super::piece::{Corner, NamedDomain, Piece};
use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::netmesh::cages::domains::{DomainId, Hierarchy, ROOT};

/// What a partition knows of its domains beside their hierarchy.
pub(super) struct Domains {
    /// Domain -> name.
    names: Vec<u64>,
    versions: Vec<u64>,
    /// Domain -> its centre and the vertices of its cage, where the partition may not change it.
    fixed: Vec<Option<(u64, Vec<u64>)>>,
    released: Vec<[u64; 2]>,
    /// How many of them others may know.
    known: usize,
}

/// The hierarchy of the domains of all `pieces`, over vertices that `corners` describes and that
/// have the given names. `shared`: vertex -> whether others have simplices at it.
pub(super) fn with_domains<const D: usize>(
    pieces: &[Piece<D>],
    corners: &[Corner<D>],
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
    let mut latest: Vec<&NamedDomain<D>> =
        collected(pieces.iter().flat_map(|piece| &piece.domains))?;
    latest.retain(|domain| taken_by(domain.name) == domain.name);
    // By name, the latest version first. The root has the least name.
    latest.sort_by_key(|domain| (domain.name, u64::MAX - domain.version));
    latest.dedup_by_key(|domain| domain.name);
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
    let mut hierarchy = Hierarchy::new(corners.len())?;
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
        let is_own = domain.name != ROOT_NAME
            && center.is_some()
            && domain.cage.iter().all(|&name| vertex(name).is_some());
        let made = hierarchy.create(
            center.unwrap_or(VertexId::NONE),
            domain.point,
            domain.radius,
            parent,
            if is_own { domain.cage.len() } else { 0 },
        )?;
        let node = hierarchy.node_mut(made);
        node.outside = domain.outside;
        if is_own {
            node.cage.extend(domain.cage.iter().filter_map(|&name| vertex(name)));
        }
        domains.names.push(domain.name);
        domains.versions.push(domain.version);
        domains.fixed.push(match is_own {
            true => None,
            false => Some((domain.center, collected(domain.cage.iter().copied())?)),
        });
    }
    for (vertex, corner) in corners.iter().enumerate() {
        let vertex = VertexId::new(vertex);
        hierarchy.set_domain(vertex, id(corner.domain));
        // The cage of a domain that was dissolved is a cage no more.
        if corner.cage != NOTHING && taken_by(corner.cage) == corner.cage {
            hierarchy.set_cage(vertex, id(corner.cage));
        }
    }
    domains.released = released;
    Ok((hierarchy, domains))
}

/// Names and ids of the centres and the vertices of cages that there are.
fn vertices_of_domains<const D: usize>(
    domains: &[&NamedDomain<D>],
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
    /// The name of `domain`, which may be none.
    pub fn name(&self, domain: DomainId) -> u64 {
        match domain.is_valid() {
            true => self.names[domain.index()],
            false => NOTHING,
        }
    }

    /// Domain -> whether the partition must leave it as it is.
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
    /// `names`: vertex -> name.
    pub fn write<const D: usize>(
        &mut self,
        hierarchy: &mut Hierarchy<D>,
        names: &[u64],
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
            let (center, cage) = match self.fixed[at].take() {
                Some(fixed) => fixed,
                None => {
                    self.versions[at] += 1;
                    let cage = node.cage.iter().map(|vertex| names[vertex.index()]);
                    (names[node.center.index()], collected(cage)?)
                }
            };
            debug_assert!((domain == ROOT) == (self.names[at] == ROOT_NAME));
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
