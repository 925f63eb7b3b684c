//! The domain hierarchy (§4) as a tree that answers "does this domain hold that one" at once.

use crate::memory::{AllocResult, Lists, collected, filled};
use crate::mesh::{Domain, NONE};

/// Nested intervals of a walk over the tree of domains; child lists.
pub(crate) struct DomainTree {
    parents: Vec<u32>,
    enter: Vec<u32>,
    leave: Vec<u32>,
    children: Lists,
}

impl DomainTree {
    /// Builds the tree; `None` unless domain 0 is the only root and every parent stands before its
    /// children.
    pub fn new(domains: &[Domain]) -> AllocResult<Option<Self>> {
        if first_misplaced(domains).is_some() {
            return Ok(None);
        }
        let parents = collected(domains.iter().map(|domain| domain.parent))?;
        let mut sizes = filled(parents.len(), 1u32)?;
        for i in (1..parents.len()).rev() {
            sizes[parents[i] as usize] += sizes[i];
        }
        // The root's parent is no domain: it is in no list.
        let children = Lists::of_pairs(parents.len(), || parents.iter().copied().zip(0u32..))?;
        let mut enter = filled(parents.len(), 0u32)?;
        let mut next = filled(parents.len(), 1u32)?;
        for i in 1..parents.len() {
            let parent = parents[i] as usize;
            enter[i] = next[parent];
            next[parent] += sizes[i];
            next[i] = enter[i] + 1;
        }
        let leave = collected(enter.iter().zip(&sizes).map(|(enter, size)| enter + size))?;
        Ok(Some(Self { parents, enter, leave, children }))
    }

    /// Returns true if `domain` is `ancestor` or below it.
    pub fn holds(&self, ancestor: u32, domain: u32) -> bool {
        let (ancestor, domain) = (ancestor as usize, domain as usize);
        (self.enter[ancestor]..self.leave[ancestor]).contains(&self.enter[domain])
    }

    /// Returns the parent of a domain, or [`NONE`] for the root.
    pub fn parent(&self, domain: u32) -> u32 {
        self.parents[domain as usize]
    }

    pub fn children(&self, domain: u32) -> &[u32] {
        self.children.of(domain as usize)
    }
}

/// Returns the first domain whose parent is not what a tree in order needs, or 0 if there are no
/// domains.
pub(crate) fn first_misplaced(domains: &[Domain]) -> Option<usize> {
    if domains.first().is_none_or(|root| root.parent != NONE) {
        return Some(0);
    }
    (1..domains.len()).find(|&i| domains[i].parent as usize >= i)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn domains(parents: &[u32]) -> Vec<Domain> {
        parents.iter().map(|&parent| Domain { center: 0, parent, radius: 1.0 }).collect()
    }

    #[test]
    fn a_tree_knows_its_descendants() {
        let parents = [NONE, 0, 0, 1, 1, 3, 2];
        let tree = DomainTree::new(&domains(&parents)).unwrap().unwrap();
        for i in 0..parents.len() as u32 {
            let mut ancestors = vec![i];
            while tree.parent(ancestors[ancestors.len() - 1]) != NONE {
                ancestors.push(tree.parent(ancestors[ancestors.len() - 1]));
            }
            for j in 0..parents.len() as u32 {
                assert_eq!(tree.holds(j, i), ancestors.contains(&j), "{j} holds {i}");
            }
        }
        assert_eq!(tree.children(1), [3, 4]);
        assert!(tree.children(6).is_empty());
    }

    #[test]
    fn what_is_no_tree_is_refused() {
        for parents in [&[][..], &[0], &[NONE, NONE], &[NONE, 2, 1], &[NONE, 1], &[NONE, 0, 9]] {
            assert!(DomainTree::new(&domains(parents)).unwrap().is_none(), "{parents:?}");
        }
    }
}
