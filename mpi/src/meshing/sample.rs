//! The sample that the coarse mesh is of: inputs that their coordinates choose, so that it does not
//! matter which rank has them, and those that say how far all of them reach.

use crate::comm::{Communicator, agreed};
use crate::words::{append, hash, words_of};
use netmesh::distributed::memory::{TryGrow, collected};
use netmesh::{Error, ErrorKind, Result};
use std::cmp::Ordering;

/// Number of inputs of which one is in the sample, unless that would have more than [`MOST`]. With
/// a larger sample the coarse mesh, which all ranks make, would take a share of the time that does
/// not shrink with them; with a smaller one more inputs would wait at the seams, whose simplices
/// are as large as those of the coarse mesh.
const SAMPLED: u64 = 32;

/// Number of inputs that a sample has at most, about: what all ranks make is bounded.
const MOST: u64 = 1 << 20;

/// Returns the number of inputs of which one is in the sample.
pub fn one_of(total: u64) -> u64 {
    SAMPLED.max(total / MOST)
}

/// An input and its number among those of all ranks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<const D: usize> {
    pub name: u64,
    pub point: [f64; D],
}

impl<const D: usize> Input<D> {
    /// Returns the bits of the coordinates, with zeros of one sign: points are equal if these are.
    pub fn bits(&self) -> [u64; D] {
        self.point.map(|x| (x + 0.0).to_bits())
    }

    fn append_to(&self, bytes: &mut Vec<u8>) -> Result<()> {
        append(bytes, &[self.name])?;
        append(bytes, &self.point.map(f64::to_bits))
    }

    /// Orders points so that ranks make no difference.
    fn order(&self, other: &Self) -> Ordering {
        let coordinates = self.point.iter().zip(&other.point);
        // Zeros are equal, whatever their signs.
        let mut orders = coordinates.map(|(a, b)| (a + 0.0).total_cmp(&(b + 0.0)));
        let order = orders.find(|order| order.is_ne());
        order.unwrap_or(Ordering::Equal).then(self.name.cmp(&other.name))
    }
}

/// Reads the inputs of a message.
pub fn inputs_of<const D: usize>(bytes: &[u8]) -> Result<Vec<Input<D>>> {
    let words: Vec<u64> = collected(words_of(bytes))?;
    Ok(collected(words.chunks_exact(1 + D).map(|words| Input {
        name: words[0],
        point: std::array::from_fn(|axis| f64::from_bits(words[1 + axis])),
    }))?)
}

/// Keeps the first of equal inputs, those with the least names, and puts all in the order of names.
pub fn keep_distinct<const D: usize>(inputs: &mut Vec<Input<D>>) {
    inputs.sort_unstable_by_key(|input| (input.bits(), input.name));
    inputs.dedup_by_key(|input| input.bits());
    inputs.sort_unstable_by_key(|input| input.name);
}

/// Collective. Returns the sample, equal on all ranks, by rising names. `first` is the number of
/// this rank's first point, `total` that of all points.
pub fn sample<const D: usize>(
    comm: &dyn Communicator,
    points: &[[f64; D]],
    first: u64,
    total: u64,
) -> Result<Vec<Input<D>>> {
    let inputs = || (first..).zip(points).map(|(name, &point)| Input { name, point });
    let mut chosen = Vec::new();
    let ends = ends(comm, inputs, total)?;
    let message = agreed(comm, || {
        let mut bytes = Vec::new();
        let one_of = one_of(total);
        let own = inputs().filter(|input| hash(&input.bits()) % one_of == 0);
        own.into_iter().try_for_each(|input| input.append_to(&mut bytes))?;
        Ok(bytes)
    })?;
    for bytes in comm.all_gather(&message)? {
        chosen.try_extend(&inputs_of(&bytes)?)?;
    }
    chosen.try_extend(&ends)?;
    keep_distinct(&mut chosen);
    Ok(chosen)
}

/// Collective. Returns the inputs at the ends of every axis, the one nearest to the middle of their
/// box, and that farthest from the latter. The coarse mesh asks for them.
fn ends<const D: usize, I: Iterator<Item = Input<D>>>(
    comm: &dyn Communicator,
    inputs: impl Fn() -> I,
    total: u64,
) -> Result<Vec<Input<D>>> {
    let mut found = Vec::new();
    let mut middle = [0.0; D];
    for axis in 0..D {
        let low = least(comm, inputs(), |point| point[axis])?;
        let high = least(comm, inputs(), |point| -point[axis])?;
        if let (Some(low), Some(high)) = (low, high) {
            middle[axis] = 0.5 * low.point[axis] + 0.5 * high.point[axis];
            found.try_extend(&[low, high])?;
        }
    }
    let center = least(comm, inputs(), |point| netmesh::numerics::distance(point, &middle))?;
    let Some(center) = center else {
        let message = "0 points, 0 of them distinct; a mesh needs at least two distinct points";
        return Err(Error::new(ErrorKind::DegenerateInput, message));
    };
    let farthest =
        least(comm, inputs(), |point| -netmesh::numerics::distance(point, &center.point))?;
    found.try_extend(&[center])?;
    found.try_extend(farthest.as_slice())?;
    if found.iter().all(|input| input.bits() == center.bits()) {
        let message = format!(
            "{total} points, 1 of them distinct; a mesh needs at least two distinct points"
        );
        return Err(Error::new(ErrorKind::DegenerateInput, message));
    }
    Ok(found)
}

/// Collective. Returns the input with the least measure, of several the first in [`Input::order`].
fn least<const D: usize>(
    comm: &dyn Communicator,
    inputs: impl Iterator<Item = Input<D>>,
    measure: impl Fn(&[f64; D]) -> f64,
) -> Result<Option<Input<D>>> {
    let order = |a: &Input<D>, b: &Input<D>| {
        let [own, other] = [a, b].map(|input| measure(&input.point) + 0.0);
        own.total_cmp(&other).then_with(|| a.order(b))
    };
    let mut message = Vec::new();
    if let Some(own) = inputs.min_by(&order) {
        own.append_to(&mut message)?;
    }
    let mut all = Vec::new();
    for bytes in comm.all_gather(&message)? {
        all.try_extend(&inputs_of(&bytes)?)?;
    }
    Ok(all.into_iter().min_by(&order))
}
