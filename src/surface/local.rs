//! A triangulation with vertices near each other next to each other in memory, and so its
//! simplices: whoever goes from star to star finds most of the next one in the cache. The vertices
//! are in the order of a Z-order curve in their box; where many share a cell of it, nothing is
//! gained.

use crate::memory::{AllocResult, Lists, collected, filled, with_capacity};
use crate::mesh::{Boundary, NONE, Stats, Triangulation, VertexKind};
use crate::query::view::View;

/// Bits of a key along an axis.
const BITS: u32 = 21;

/// A triangulation numbered anew.
pub struct Local {
    /// Its points, simplices and neighbours; all else is left out.
    pub mesh: Triangulation,
    /// Vertex of the triangulation -> its number here.
    pub numbers: Vec<u32>,
    /// Vertex here -> that of the triangulation.
    pub vertices: Vec<u32>,
    /// Simplex here -> that of the triangulation.
    simplices: Vec<u32>,
}

impl Local {
    /// Makes a triangulation that is numbered anew. O(simplices + vertices log vertices).
    pub fn new<const D: usize>(mesh: &Triangulation) -> AllocResult<Self> {
        let view = View::<D> { mesh };
        let vertices = order(view)?;
        let numbers = inverse(&vertices)?;
        let first = |simplex: u32| {
            let own = view.simplex(simplex).iter().map(|&vertex| numbers[vertex as usize]);
            own.fold(NONE, u32::min)
        };
        let count = mesh.simplex_count() as u32;
        let by_first = || (0..count).map(|simplex| (first(simplex), simplex));
        let simplices = Lists::of_pairs(vertices.len(), by_first)?.ids;
        let simplex_numbers = inverse(&simplices)?;
        let rows = |of: &[u32], numbers: &[u32]| -> AllocResult<Vec<u32>> {
            let mut all = with_capacity(of.len())?;
            for &simplex in &simplices {
                let row = of[simplex as usize * (D + 1)..][..D + 1].iter();
                all.extend(row.map(|&at| if at == NONE { NONE } else { numbers[at as usize] }));
            }
            Ok(all)
        };
        let mut points = with_capacity(mesh.points.len())?;
        vertices.iter().for_each(|&vertex| points.extend(view.point(vertex)));
        let mesh = Triangulation {
            dim: D,
            points,
            simplices: rows(&mesh.simplices, &numbers)?,
            neighbors: rows(&mesh.neighbors, &simplex_numbers)?,
            kinds: filled(vertices.len(), VertexKind::Input)?,
            vertex_domains: filled(vertices.len(), NONE)?,
            cage_of: filled(vertices.len(), NONE)?,
            domains: Vec::new(),
            precision_limited: filled(vertices.len(), false)?,
            below_min_dihedral: Vec::new(),
            boundary: Boundary::default(),
            sizes: Vec::new(),
            beyond_bound: Vec::new(),
            parameters: mesh.parameters.clone(),
            stats: Stats::default(),
        };
        Ok(Self { mesh, numbers, vertices, simplices })
    }

    /// Returns values of the simplices here in the order of the triangulation.
    pub fn of_simplices<T: Copy>(&self, values: &[T], none: T) -> AllocResult<Vec<T>> {
        scattered(&self.simplices, values, none)
    }

    /// Returns values of the vertices here in the order of the triangulation.
    pub fn of_vertices<T: Copy>(&self, values: &[T], none: T) -> AllocResult<Vec<T>> {
        scattered(&self.vertices, values, none)
    }
}

/// Returns the vertices in the order of the curve.
fn order<const D: usize>(view: View<'_, D>) -> AllocResult<Vec<u32>> {
    let points = || view.mesh.points.chunks_exact(D);
    let bound = |axis: usize, worse: fn(f64, f64) -> f64| {
        points().map(|point| 0.5 * point[axis]).reduce(worse).unwrap_or(0.0)
    };
    let low: [f64; D] = std::array::from_fn(|axis| bound(axis, f64::min));
    let high: [f64; D] = std::array::from_fn(|axis| bound(axis, f64::max));
    let width = low.iter().zip(&high).fold(0.0f64, |width, (low, high)| width.max(high - low));
    // A cube, so that cells are cubes; one point is a cell.
    let cells = f64::from(1u32 << BITS);
    let cell = |x: f64, low: f64| ((0.5 * x - low) / width * cells).min(cells - 1.0) as u64;
    let mut keys = with_capacity(view.mesh.vertex_count())?;
    for (vertex, point) in (0u32..).zip(points()) {
        let cells: [u64; D] = std::array::from_fn(|axis| cell(point[axis], low[axis]));
        keys.push((interleaved(&cells), vertex));
    }
    // Of those in one cell, by their coordinates: the caller's order does not count.
    let compare =
        |a: u32, b: u32| view.point(a).partial_cmp(view.point(b)).expect("coordinates are finite");
    keys.sort_unstable_by(|a, b| a.0.cmp(&b.0).then_with(|| compare(a.1, b.1)));
    collected(keys.into_iter().map(|(_, vertex)| vertex))
}

/// Returns the bits of numbers in turn, the highest of all first.
fn interleaved<const D: usize>(numbers: &[u64; D]) -> u64 {
    let bits = (0..BITS).rev().flat_map(|bit| numbers.iter().map(move |x| x >> bit & 1));
    bits.fold(0, |key, bit| key << 1 | bit)
}

/// Returns for each number from 0 on where it is in a list of all of them.
fn inverse(list: &[u32]) -> AllocResult<Vec<u32>> {
    let mut places = filled(list.len(), 0)?;
    (0..).zip(list).for_each(|(at, &number)| places[number as usize] = at);
    Ok(places)
}

/// Returns values at the places that a list of all places has for them.
fn scattered<T: Copy>(places: &[u32], values: &[T], none: T) -> AllocResult<Vec<T>> {
    let mut all = filled(places.len(), none)?;
    places.iter().zip(values).for_each(|(&at, &value)| all[at as usize] = value);
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Algorithm, Mesh, Options};

    #[test]
    fn it_is_the_same_triangulation() {
        let mut random = crate::numerics::SplitMix(5);
        let points: Vec<f64> = (0..900).map(|_| random.next_word() as f64 * 1e287).collect();
        let mut mesh = Mesh::new(3, 300, &points, 3).unwrap();
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        mesh.run(&options, None).unwrap();
        let whole = mesh.result().unwrap();
        let local = Local::new::<3>(whole).unwrap();
        for (here, &vertex) in local.vertices.iter().enumerate() {
            assert_eq!(local.mesh.point(here as u32), whole.point(vertex));
            assert_eq!(local.numbers[vertex as usize], here as u32);
        }
        let renamed = |ids: &[u32], names: &[u32]| {
            ids.iter().map(|&id| if id == NONE { NONE } else { names[id as usize] }).collect()
        };
        for (here, &simplex) in local.simplices.iter().enumerate() {
            let vertices: Vec<u32> = renamed(local.mesh.simplex(here), &local.vertices);
            assert_eq!(vertices, whole.simplex(simplex as usize));
            let neighbors: Vec<u32> = renamed(local.mesh.neighbors_of(here), &local.simplices);
            assert_eq!(neighbors, whole.neighbors_of(simplex as usize));
        }
        let values: Vec<u32> = (0..local.simplices.len() as u32).collect();
        let places = local.of_simplices(&local.simplices, NONE).unwrap();
        assert_eq!(places, values);
    }

    #[test]
    fn keys_go_round_in_quarters() {
        let quarter = |x: u64, y: u64| interleaved(&[x, y]) >> (2 * BITS - 2);
        let half = 1 << (BITS - 1);
        assert_eq!(
            [(0, 0), (0, half), (half, 0), (half, half)].map(|(x, y)| quarter(x, y)),
            [0, 1, 2, 3]
        );
        assert!(interleaved(&[1, 0]) == 2 && interleaved(&[0, 2]) == 4);
    }
}
