//! The connected parts of a surface, and their topology.

use crate::memory::{AllocResult, Sets, TryGrow, filled};

/// A connected part of a surface: a curve in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shell {
    pub facets: u64,
    pub vertices: u64,
    /// Number of handles: 0 for a sphere, 1 for a torus. 0 in the plane. Of a shell with one side
    /// the number of crosscaps: 1 for a Moebius strip.
    pub genus: u64,
    /// Number of closed curves at which it ends, in the plane of points; 0 if it is closed.
    pub ends: u64,
    /// True if it has one side alone, and its facets no common direction.
    pub is_one_sided: bool,
}

/// Returns the shells of a closed manifold, in the order of their first vertices. `facets` has
/// `dim` vertices each, of `vertices`. O(vertices + facets).
pub fn shells(dim: usize, vertices: usize, facets: &[u32]) -> AllocResult<Vec<Shell>> {
    let mut connected = Sets::new(vertices)?;
    let mut is_used = filled(vertices, false)?;
    for facet in facets.chunks_exact(dim) {
        facet.iter().for_each(|&vertex| {
            connected.join(facet[0] as usize, vertex as usize);
            is_used[vertex as usize] = true;
        });
    }
    let mut shell_of = filled(vertices, usize::MAX)?;
    let mut shells: Vec<Shell> = Vec::new();
    for vertex in (0..vertices).filter(|&vertex| is_used[vertex]) {
        // A set is called by its least vertex, which comes first.
        let first = connected.find(vertex);
        if first == vertex {
            shell_of[vertex] = shells.len();
            shells.try_push(Shell::default())?;
        }
        shell_of[vertex] = shell_of[first];
        shells[shell_of[first]].vertices += 1;
    }
    for facet in facets.chunks_exact(dim) {
        shells[shell_of[facet[0] as usize]].facets += 1;
    }
    if dim == 3 {
        // Vertices less edges, three for two facets, plus facets are two less two a handle.
        let genus = |shell: &Shell| (2 + shell.facets / 2).saturating_sub(shell.vertices) / 2;
        shells.iter_mut().for_each(|shell| shell.genus = genus(shell));
    }
    Ok(shells)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shells_have_their_handles() {
        let tetrahedron = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2];
        // Two triangles at each of the 3 x 3 places of a torus.
        let at = |i: u32, j: u32| 5 + i % 3 * 3 + j % 3;
        let torus = (0..9).map(|k| (k / 3, k % 3)).flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [a, b, c, a, c, d]
        });
        let facets: Vec<u32> = tetrahedron.into_iter().chain(torus).collect();
        let expected = [
            Shell { facets: 4, vertices: 4, genus: 0, ..Shell::default() },
            Shell { facets: 18, vertices: 9, genus: 1, ..Shell::default() },
        ];
        assert_eq!(shells(3, 14, &facets).unwrap(), expected);
        let curves = shells(2, 6, &[0, 1, 1, 2, 2, 0, 3, 5, 5, 4, 4, 3]).unwrap();
        assert_eq!(curves, [Shell { facets: 3, vertices: 3, genus: 0, ..Shell::default() }; 2]);
    }
}
