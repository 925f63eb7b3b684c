//! Facets that are there several times: triangles of a surface, of which one is a facet, and
//! polygons.

use super::TaskInSpace;
use crate::memory::{AllocResult, collected, copied, filled};
use crate::mesh::{Facets, Inputs};
use crate::options::Crossings;
use std::cmp::Ordering;

/// Returns for each triangle its balance: by how much the winding number grows behind it, which is
/// 1 for a triangle that is there once. If crossings are split, the first of several with the same
/// vertices has the sum of all, those that run the other way round counted negatively, and the
/// others have none. O(n log n).
pub(super) fn balances(task: &TaskInSpace<'_>) -> AllocResult<Vec<Option<i64>>> {
    let facets = task.facets;
    let mut balances = filled(facets.count(), Some(1))?;
    if task.crossings == Crossings::Refuse || !facets.are_triangles {
        return Ok(balances);
    }
    for same in sorted(task.inputs, facets)?.chunk_by(|a, b| a.vertices == b.vertices) {
        let turn = |own: &Turned| if own.is_upwards == same[0].is_upwards { 1 } else { -1 };
        let sum = same.iter().map(turn).sum();
        for (at, own) in same.iter().enumerate() {
            balances[own.number as usize] = (at == 0).then_some(sum);
        }
    }
    Ok(balances)
}

/// Returns the number of triangles with the vertices of an earlier one, or of polygons with its
/// loops, whatever their order, where they begin and the way round that they run. O(n log n) for n
/// inputs of facets.
pub fn count_duplicates(inputs: &Inputs, facets: &Facets) -> AllocResult<usize> {
    if !facets.are_triangles {
        return count_duplicate_polygons(inputs, facets);
    }
    let all = sorted(inputs, facets)?;
    Ok(all.windows(2).filter(|two| two[0].vertices == two[1].vertices).count())
}

/// Returns the number of polygons with the loops of an earlier one.
fn count_duplicate_polygons(inputs: &Inputs, facets: &Facets) -> AllocResult<usize> {
    if facets.count() == 0 {
        return Ok(0);
    }
    let vertices = facets.inputs.iter().map(|&input| inputs.vertices()[input as usize]);
    let mut one_way: Vec<u32> = collected(vertices)?;
    let mut other_way = copied(&one_way)?;
    let range = |number: u32| {
        let [start, end] = [0, 1].map(|more| facets.input_starts[number as usize + more] as usize);
        start..end
    };
    let loops = facets.input_starts.len() as u32 - 1;
    for number in 0..loops {
        let [one, other] = [&mut one_way, &mut other_way].map(|all| &mut all[range(number)]);
        other.reverse();
        rotate_to_least(one);
        rotate_to_least(other);
        if *other < *one {
            one.copy_from_slice(other);
        }
    }
    let of = |number: u32| &one_way[range(number)];
    let mut order: Vec<u32> = collected(0..loops)?;
    for own in facets.loop_starts.windows(2) {
        order[own[0] as usize..own[1] as usize].sort_unstable_by(|&a, &b| of(a).cmp(of(b)));
    }
    let polygon = |facet: u32| {
        let [first, last] = [0, 1].map(|more| facets.loop_starts[facet as usize + more] as usize);
        order[first..last].iter().map(|&number| of(number))
    };
    let mut polygons: Vec<u32> = collected(0..facets.count() as u32)?;
    polygons.sort_unstable_by(|&a, &b| polygon(a).cmp(polygon(b)));
    Ok(polygons.windows(2).filter(|two| polygon(two[0]).eq(polygon(two[1]))).count())
}

/// Turns a loop to the least of its rotations. O(n).
fn rotate_to_least(own: &mut [u32]) {
    let length = own.len();
    // Two places at which the least rotation may begin, and the number of vertices that are equal
    // from there on.
    let (mut a, mut b, mut equal) = (0, 1, 0);
    while a < length && b < length && equal < length {
        match own[(a + equal) % length].cmp(&own[(b + equal) % length]) {
            Ordering::Equal => equal += 1,
            // No place among those that are equal is better than the one they were compared with.
            Ordering::Less => (b, equal) = (b + equal + 1, 0),
            Ordering::Greater => (a, equal) = (a + equal + 1, 0),
        }
        b += usize::from(a == b);
    }
    own.rotate_left(a.min(b));
}

/// Triangle by its vertices in their order.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Turned {
    vertices: [u32; 3],
    number: u32,
    /// True if it runs through its vertices in their order.
    is_upwards: bool,
}

/// Returns all triangles, sorted by their vertices and then by their numbers.
fn sorted(inputs: &Inputs, facets: &Facets) -> AllocResult<Vec<Turned>> {
    let turned = |(own, number): (&[u32], u32)| {
        let own = [own[0], own[1], own[2]].map(|input| inputs.vertices()[input as usize]);
        let mut vertices = own;
        vertices.sort_unstable();
        let least = own.iter().position(|&vertex| vertex == vertices[0]).unwrap_or(0);
        Turned { vertices, number, is_upwards: own[(least + 1) % 3] == vertices[1] }
    };
    let mut all = collected(facets.inputs.chunks_exact(3).zip(0u32..).map(turned))?;
    all.sort_unstable();
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::super::tests::Case;
    use super::*;
    use crate::numerics::testing::Random;

    #[test]
    fn loops_are_turned_to_their_least_rotation() {
        let mut random = Random(3);
        for _ in 0..2000 {
            let length = 1 + random.integer(0, 9) as usize;
            let own: Vec<u32> = (0..length).map(|_| random.integer(0, 2) as u32).collect();
            let rotations = (0..length).map(|at| [&own[at..], &own[..at]].concat());
            let (least, mut turned) = (rotations.min().unwrap(), own);
            rotate_to_least(&mut turned);
            assert_eq!(turned, least);
        }
    }

    #[test]
    fn polygons_are_equal_whatever_the_order_and_the_direction_of_their_loops() {
        // The last point is equal to the first.
        let mut points: Vec<[f64; 3]> = (0..9).map(|x| [f64::from(x), 0.0, 0.0]).collect();
        points.push(points[0]);
        let facet = |loops: &[&[u32]]| loops.iter().map(|own| own.to_vec()).collect::<Vec<_>>();
        let given = facet(&[&[0, 1, 2, 3], &[4, 5, 6], &[7, 8]]);
        let count = |others: &[&[&[u32]]]| {
            let all: Vec<_> =
                others.iter().map(|loops| facet(loops)).chain([given.clone()]).collect();
            let case = Case::polygons(&points, &all);
            count_duplicates(&case.inputs, &case.facets).unwrap()
        };
        assert_eq!(count(&[]), 0);
        let turned: &[&[u32]] = &[&[8, 7], &[2, 1, 9, 3], &[6, 4, 5]];
        let reversed: &[&[u32]] = &[&[5, 4, 6], &[3, 2, 1, 0], &[7, 8]];
        assert_eq!((count(&[turned]), count(&[reversed]), count(&[turned, reversed])), (1, 1, 2));
        let others: [&[&[u32]]; 4] = [
            &[&[0, 2, 1, 3], &[4, 5, 6], &[7, 8]],
            &[&[0, 1, 2, 3], &[4, 5, 6]],
            &[&[0, 1, 2, 3], &[4, 5, 6], &[7]],
            &[&[0, 1, 2], &[3, 4, 5, 6], &[7, 8]],
        ];
        assert_eq!(count(&others), 0);
        let none = Case::polygons(&points, &[]);
        assert_eq!(count_duplicates(&none.inputs, &none.facets), Ok(0));
    }
}
