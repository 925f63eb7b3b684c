//! Physical groups: elements with one label.

use crate::memory::{AllocResult, TryGrow, collected};

/// Elements of one dimension, by their labels.
pub(super) struct Groups {
    /// Elements, sorted by label and then by number.
    elements: Vec<u32>,
    /// Groups, sorted by label.
    groups: Vec<Group>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Group {
    pub label: i32,
    /// A positive number that no other group of the dimension has: the label if that is positive.
    pub tag: u32,
    /// End of the group's elements in those of all groups.
    end: usize,
}

impl Groups {
    /// Groups the elements 0 to `count`; where there are none, the only group has no elements.
    pub fn new(count: usize, label: impl Fn(usize) -> i32) -> AllocResult<Self> {
        let label = |element: u32| label(element as usize);
        let mut elements: Vec<u32> = collected(0..count as u32)?;
        elements.sort_unstable_by_key(|element| (label(*element), *element));
        let mut groups: Vec<Group> = Vec::new();
        for same in elements.chunk_by(|a, b| label(*a) == label(*b)) {
            let begin = groups.last().map_or(0, |group| group.end);
            let label = label(same[0]);
            let tag = u32::try_from(label).unwrap_or(0);
            groups.try_push(Group { label, tag, end: begin + same.len() })?;
        }
        if groups.is_empty() {
            groups.try_push(Group { label: 0, tag: 0, end: 0 })?;
        }
        let labelled = groups.partition_point(|group| group.tag == 0);
        let (others, labelled) = groups.split_at_mut(labelled);
        give_free_tags(others, labelled);
        Ok(Self { elements, groups })
    }

    pub fn all(&self) -> &[Group] {
        &self.groups
    }

    /// Returns each group with its elements.
    pub fn iter(&self) -> impl Iterator<Item = (Group, &[u32])> {
        let begins = [0].into_iter().chain(self.groups.iter().map(|group| group.end));
        let pairs = begins.zip(&self.groups);
        pairs.map(|(begin, group)| (*group, &self.elements[begin..group.end]))
    }
}

/// Gives the groups the least numbers from 1 that are not taken. Gmsh has no group 0, and where a
/// number is negative it reverses the elements.
fn give_free_tags(groups: &mut [Group], taken: &[Group]) {
    let mut taken = taken.iter().peekable();
    let mut tag = 0;
    for group in groups {
        tag += 1;
        while taken.next_if(|other| other.tag == tag).is_some() {
            tag += 1;
        }
        group.tag = tag;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_stand_by_labels_and_groups_have_positive_tags() {
        let labels = [3, -7, 1, 0, 3, i32::MAX, 0, i32::MIN];
        let groups = Groups::new(labels.len(), |element| labels[element]).unwrap();
        let found: Vec<_> = groups.iter().map(|(g, all)| (g.label, g.tag, all.to_vec())).collect();
        let expected = [
            (i32::MIN, 2, vec![7]),
            (-7, 4, vec![1]),
            (0, 5, vec![3, 6]),
            (1, 1, vec![2]),
            (3, 3, vec![0, 4]),
            (i32::MAX, i32::MAX as u32, vec![5]),
        ];
        assert_eq!(found, expected);
        let nothing = Groups::new(0, |_| 7).unwrap();
        assert_eq!(nothing.all(), [Group { label: 0, tag: 1, end: 0 }]);
    }
}
