//! Lists of ids per id, in one array, by a counting sort: the simplices of each vertex, the
//! children of each domain.

use super::{AllocResult, filled};

/// For each owner in `0..count` the list of its members.
pub struct Incidence {
    /// Where each list begins; one more at the end.
    starts: Vec<usize>,
    members: Vec<u32>,
}

impl Incidence {
    /// From pairs (owner, member). `pairs` is called twice and must give the same pairs in the same
    /// order. Pairs whose owner is not below `count` are left out. Members stand in the order of
    /// the pairs. O(`count` + pairs).
    pub fn new<I: Iterator<Item = (u32, u32)>>(
        count: usize,
        pairs: impl Fn() -> I,
    ) -> AllocResult<Self> {
        let mut starts = filled(count + 1, 0usize)?;
        let within = |owner: u32| (owner as usize) < count;
        for (owner, _) in pairs().filter(|(owner, _)| within(*owner)) {
            starts[owner as usize + 1] += 1;
        }
        for owner in 0..count {
            starts[owner + 1] += starts[owner];
        }
        let mut members = filled(starts[count], 0u32)?;
        for (owner, member) in pairs().filter(|(owner, _)| within(*owner)) {
            let next = &mut starts[owner as usize];
            members[*next] = member;
            *next += 1;
        }
        // Each start has moved to the start of the next list.
        starts.rotate_right(1);
        starts[0] = 0;
        Ok(Self { starts, members })
    }

    pub fn of(&self, owner: usize) -> &[u32] {
        &self.members[self.starts[owner]..self.starts[owner + 1]]
    }

    /// Where each list begins, with one more at the end, and the lists one after the other.
    pub fn into_parts(self) -> (Vec<usize>, Vec<u32>) {
        (self.starts, self.members)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_those_of_the_pairs() {
        let pairs = [(2, 10), (0, 11), (2, 12), (u32::MAX, 13), (4, 14), (2, 9)];
        let incidence = Incidence::new(5, || pairs.into_iter()).unwrap();
        let lists: Vec<&[u32]> = (0..5).map(|owner| incidence.of(owner)).collect();
        assert_eq!(lists, [&[11][..], &[], &[10, 12, 9], &[], &[14]]);
    }
}
