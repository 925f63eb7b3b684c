//! The caller's points, of which exact duplicates are identified.

use super::{MAX_DIM, MIN_DIM, NONE};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocError, AllocResult, TryGrow, copied, filled, prefetch, with_capacity};

/// Fails unless all coordinates of points, one after the other, are finite.
pub(crate) fn check_finite(dim: usize, points: &[f64]) -> Result<()> {
    let Some(at) = points.iter().position(|x| !x.is_finite()) else { return Ok(()) };
    let message = message!(
        "points[{}] has a non-finite coordinate {}: {}; every coordinate must be finite",
        at / dim,
        at % dim,
        points[at]
    );
    Err(Error::new(ErrorKind::NonFinite, message))
}

/// The caller's points with their own bits; exact duplicates are identified.
#[derive(Clone, Debug)]
pub struct Inputs {
    dim: usize,
    /// Coordinates of all n points, `n x dim`, with the caller's bits.
    coordinates: Vec<f64>,
    /// Input -> its vertex; the distinct inputs are vertices `0..distinct` in input order.
    vertices: Vec<u32>,
    /// Vertex -> the first input that has its coordinates.
    first_input: Vec<u32>,
}

impl Inputs {
    /// Copies `n` points of `dim` coordinates, which begin `stride` doubles apart (0 means `dim`).
    ///
    /// # Errors
    /// `Dimension`, `InvalidArgument` (stride, length), `NonFinite` (names point and coordinate),
    /// `Capacity` (2^32 - 2 points at most), `DegenerateInput` (fewer than two distinct points).
    pub fn new(dim: usize, n: usize, points: &[f64], stride: usize) -> Result<Self> {
        if !(MIN_DIM..=MAX_DIM).contains(&dim) {
            let message = message!("dim is {dim}; it must be {MIN_DIM} to {MAX_DIM}");
            return Err(Error::new(ErrorKind::Dimension, message));
        }
        let stride = if stride == 0 { dim } else { stride };
        if stride < dim {
            let message = message!("stride is {stride}; it must be 0 or at least dim = {dim}");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        if n as u64 >= NONE as u64 {
            let message = message!("n is {n}; at most {} points fit 32-bit ids", NONE - 1);
            return Err(Error::new(ErrorKind::Capacity, message));
        }
        let needed = match n {
            0 => Some(0),
            _ => (n - 1).checked_mul(stride).and_then(|start| start.checked_add(dim)),
        };
        if needed.is_none_or(|needed| points.len() < needed) {
            let message = message!(
                "points holds {} doubles; n = {n} points with stride {stride} need more",
                points.len()
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let no_memory = |_| no_memory(n, dim);
        let mut coordinates = with_capacity(n * dim).map_err(no_memory)?;
        let mut vertices = with_capacity(n).map_err(no_memory)?;
        for i in 0..n {
            let point = &points[i * stride..][..dim];
            if let Some(axis) = point.iter().position(|x| !x.is_finite()) {
                let message = message!(
                    "points[{i}] has a non-finite coordinate {axis}: {}; every coordinate must be \
                     finite",
                    point[axis]
                );
                return Err(Error::new(ErrorKind::NonFinite, message));
            }
            coordinates.extend_from_slice(point);
        }
        let first_input = identify_duplicates(dim, &coordinates, &mut vertices)?;
        if first_input.len() < 2 {
            let message = message!(
                "{n} points, {} of them distinct; a mesh needs at least two distinct points",
                first_input.len()
            );
            return Err(Error::new(ErrorKind::DegenerateInput, message));
        }
        Ok(Self { dim, coordinates, vertices, first_input })
    }

    /// Returns the inputs of a mesh that has only the vertices `kept`, ascending; the other inputs
    /// have no vertex in it.
    pub(crate) fn of_vertices(&self, kept: &[u32]) -> AllocResult<Self> {
        let mut vertices = filled(self.count(), NONE)?;
        let mut first_input = Vec::new();
        for (new, &old) in
            kept.iter().enumerate().filter(|&(_, &old)| (old as usize) < self.distinct())
        {
            let first = self.first_input[old as usize];
            first_input.try_push(first)?;
            vertices[first as usize] = new as u32;
        }
        for input in 0..self.count() {
            vertices[input] = vertices[self.first_input[self.vertices[input] as usize] as usize];
        }
        Ok(Self { dim: self.dim, coordinates: copied(&self.coordinates)?, vertices, first_input })
    }

    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Returns the number of inputs, duplicates included.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the number of distinct inputs, which are the vertices `0..distinct()` of every mesh
    /// of these inputs.
    pub fn distinct(&self) -> usize {
        self.first_input.len()
    }

    pub fn duplicates(&self) -> usize {
        self.count() - self.distinct()
    }

    /// Returns the vertex of each input. Equal inputs share one.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Returns the first input at each of the vertices `0..distinct()`, ascending; other vertices
    /// are no inputs. This is the inverse of [`Inputs::vertices`] except for duplicates, which have
    /// the vertex of the input that they repeat.
    pub fn first_inputs(&self) -> &[u32] {
        &self.first_input
    }

    /// Returns the first input at `vertex`; `None` for a vertex that is no input.
    pub fn first_input(&self, vertex: usize) -> Option<u32> {
        self.first_input.get(vertex).copied()
    }

    /// Returns the coordinates of input `i`, with the caller's bits.
    pub fn point(&self, i: usize) -> &[f64] {
        &self.coordinates[i * self.dim..][..self.dim]
    }

    /// Returns the coordinates of the distinct input that is vertex `v`.
    pub fn distinct_point(&self, v: usize) -> &[f64] {
        self.point(self.first_input[v] as usize)
    }

    /// Returns the coordinates of the distinct inputs, `distinct x dim`.
    pub fn distinct_points(&self) -> Vec<f64> {
        (0..self.distinct()).flat_map(|v| self.distinct_point(v)).copied().collect()
    }
}

/// Returns the error that there is no memory for a copy of the points; without numbers if there is
/// none for the message either.
fn no_memory(n: usize, dim: usize) -> Error {
    let bytes = n as u128 * dim as u128 * size_of::<f64>() as u128;
    let message = message!("cannot allocate a copy of the points: n = {n}, {bytes} bytes");
    if message.is_empty() {
        return AllocError::Memory.into();
    }
    Error::new(ErrorKind::OutOfMemory, message)
}

/// Number of points after which one follows whose place in the table is asked for: places are
/// anywhere in memory.
const AHEAD: usize = 12;

/// Fills `vertices`, and returns the first input of each distinct point. Zeros of either sign are
/// equal. Expected O(n), by an open hash table of ids that is at most half full.
fn identify_duplicates(
    dim: usize,
    coordinates: &[f64],
    vertices: &mut Vec<u32>,
) -> Result<Vec<u32>> {
    let n = coordinates.len() / dim;
    let mut first_input = with_capacity(n)?;
    let mask = (2 * n).next_power_of_two() - 1;
    let mut table: Vec<u32> = filled(mask + 1, NONE)?;
    let mut later = coordinates.chunks_exact(dim).skip(AHEAD);
    for (i, point) in coordinates.chunks_exact(dim).enumerate() {
        if let Some(later) = later.next() {
            prefetch(&table, hash(later) & mask);
        }
        let mut slot = hash(point) & mask;
        let vertex = loop {
            match table[slot] {
                NONE => {
                    table[slot] = first_input.len() as u32;
                    first_input.push(i as u32);
                    break table[slot];
                }
                vertex
                    if coordinates[first_input[vertex as usize] as usize * dim..][..dim]
                        == *point =>
                {
                    break vertex;
                }
                _ => slot = (slot + 1) & mask,
            }
        };
        vertices.push(vertex);
    }
    Ok(first_input)
}

/// Returns the hash of a point, of all bits of its coordinates. Adding zero makes a negative zero
/// positive.
fn hash(point: &[f64]) -> usize {
    // The finaliser of SplitMix64, as in `numerics`, which plain data does not use.
    let mix = |hash: u64, x: &f64| {
        let mixed = hash ^ (x + 0.0).to_bits();
        let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    };
    point.iter().fold(0x9e37_79b9_7f4a_7c15, mix) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;
    use std::collections::HashMap;

    /// Inputs are duplicates just if they compare equal: a lattice with few values an axis has both
    /// zeros and neighbouring doubles.
    #[test]
    fn duplicates_are_those_that_compare_equal() {
        let values = [0.0, -0.0, 1.0, 1.0f64.next_up(), -1.0, 5e-324, 1e308];
        let mut random = Random(1);
        let mut draw = || values[random.integer(0, values.len() as i64 - 1) as usize];
        let points: Vec<f64> = (0..3 * 4000).map(|_| draw()).collect();
        let inputs = Inputs::new(3, 4000, &points, 0).unwrap();
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        for (i, point) in points.chunks_exact(3).enumerate() {
            let key = std::array::from_fn(|axis| (point[axis] + 0.0).to_bits());
            let next = known.len() as u32;
            assert_eq!(inputs.vertices()[i], *known.entry(key).or_insert(next));
        }
        assert_eq!((inputs.distinct(), known.len()), (216, 216));
        for (vertex, &first) in inputs.first_input.iter().enumerate() {
            assert_eq!(inputs.vertices()[first as usize] as usize, vertex);
            assert!(!inputs.vertices()[..first as usize].contains(&(vertex as u32)));
        }
    }

    /// Regular inputs fill as many slots of a half full table as random ones, (1 - exp(-1/2)) of
    /// it.
    #[test]
    fn hashes_of_lattices_are_spread() {
        for scale in [1.0, 2f64.powi(-1000), 0.1, 2f64.powi(900)] {
            let mut used = vec![false; 1 << 13];
            for i in 0..1 << 12 {
                let cell = [i % 16, i / 16 % 16, i / 256].map(|k| f64::from(k) * scale);
                used[hash(&cell) % (1 << 13)] = true;
            }
            let filled = used.iter().filter(|&&used| used).count() as f64 / (1 << 13) as f64;
            assert!((filled - 0.3935).abs() < 0.02, "{scale}: {filled}");
        }
    }
}
