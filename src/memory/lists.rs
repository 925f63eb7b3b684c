//! Lists of ids in one array, such as the simplices of each vertex.

use super::{AllocResult, TryGrow, filled, with_capacity};

/// Lists of ids, one for each vertex or another thing: list `i` is `ids[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    /// Positions in `ids` where the lists begin, and the length of `ids` as a last entry.
    pub starts: Vec<usize>,
    pub ids: Vec<u32>,
}

impl Lists {
    /// Makes the lists of `count` owners, by a counting sort of pairs (owner, id). `pairs` is
    /// called twice and must give the same pairs in the same order. Pairs whose owner is not below
    /// `count` are left out. Ids stand in the order of the pairs. O(`count` + pairs).
    pub(crate) fn of_pairs<I: Iterator<Item = (u32, u32)>>(
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
        let mut ids = filled(starts[count], 0u32)?;
        for (owner, id) in pairs().filter(|(owner, _)| within(*owner)) {
            let next = &mut starts[owner as usize];
            ids[*next] = id;
            *next += 1;
        }
        // Each start has moved to the start of the next list.
        starts.rotate_right(1);
        starts[0] = 0;
        Ok(Self { starts, ids })
    }

    /// Returns no lists, with a reserve for `lists` of them.
    pub(crate) fn with_capacity(lists: usize) -> AllocResult<Self> {
        let mut starts = with_capacity(lists + 1)?;
        starts.push(0);
        Ok(Self { starts, ids: Vec::new() })
    }

    /// Ends the list that consists of the ids added since the last one ended.
    pub(crate) fn end_list(&mut self) -> AllocResult<()> {
        self.starts.try_push(self.ids.len())
    }

    /// Returns the number of lists.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn of(&self, at: usize) -> &[u32] {
        &self.ids[self.starts[at]..self.starts[at + 1]]
    }

    /// Returns all lists in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.count()).map(|at| self.of(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_those_of_the_pairs() {
        let pairs = [(2, 10), (0, 11), (2, 12), (u32::MAX, 13), (4, 14), (2, 9)];
        let lists = Lists::of_pairs(5, || pairs.into_iter()).unwrap();
        let expected = [&[11][..], &[], &[10, 12, 9], &[], &[14]];
        assert!(lists.iter().eq(expected));
        let mut same = Lists::with_capacity(5).unwrap();
        for list in expected {
            same.ids.try_extend(list).unwrap();
            same.end_list().unwrap();
        }
        assert_eq!(same, lists);
    }
}
