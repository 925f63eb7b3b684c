//! A complex made of plain arrays, such as a partition from another process.

use super::{Complex, SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocError, TryGrow};

impl<const D: usize> Complex<D> {
    /// Makes the complex of simplices that are given by their vertices and the neighbours opposite
    /// these, D + 1 each. There are `vertices` vertex ids. A simplex that is its own neighbour is
    /// at an interface there.
    pub fn of_arrays(
        vertices: usize,
        simplices: &[VertexId],
        neighbors: &[SimplexId],
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let mut complex = Self::new(vertices)?;
        let count = simplices.len() / Self::VERTICES;
        if count > complex.id_limit {
            return Err(AllocError::Ids.into());
        }
        complex.records.reserve(count * Self::RECORD)?;
        let records =
            simplices.chunks(Self::VERTICES).zip(neighbors.chunks(Self::VERTICES)).zip(0..count);
        for ((corners, neighbors), simplex) in records {
            tick()?;
            for &vertex in corners {
                complex.records.try_push(vertex.number())?;
                if vertex != VertexId::INFINITE {
                    complex.incident[vertex] = SimplexId::new(simplex);
                }
            }
            for &neighbor in neighbors {
                complex.records.try_push(neighbor.number())?;
            }
        }
        Ok(complex)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_a_complex_make_it_again() {
        let mut complex = Complex::<3>::new(5).unwrap();
        complex.begin(&VertexId::below(4).collect::<Vec<_>>()).unwrap();
        let all = || complex.simplices();
        let simplices: Vec<_> = all().flat_map(|s| complex.vertices(s).to_vec()).collect();
        let neighbors: Vec<_> = all().flat_map(|s| complex.neighbors(s).to_vec()).collect();
        let again = Complex::<3>::of_arrays(5, &simplices, &neighbors, || Ok(())).unwrap();
        assert_eq!(again.simplex_count(), 5);
        for simplex in all() {
            assert_eq!(again.vertices(simplex), complex.vertices(simplex));
            assert_eq!(again.neighbors(simplex), complex.neighbors(simplex));
        }
        for vertex in VertexId::below(4) {
            assert!(again.vertices(again.incident(vertex)).contains(&vertex));
        }
        assert!(!again.contains_vertex(VertexId::new(4)));
    }
}
