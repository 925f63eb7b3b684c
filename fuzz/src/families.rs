//! Kinds of points that have broken predicates and meshers before.

use super::bytes::Bytes;

/// Returns `count` points of dimension `dim`, with finite coordinates.
pub fn points(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    match bytes.below(6) {
        0 => (0..count * dim).map(|_| bytes.finite()).collect(),
        1 => lattice(bytes, dim, count),
        2 => ulps(bytes, dim, count),
        3 => flat_lattice(bytes, dim, count),
        4 => cospherical(bytes, dim, count),
        _ => mixed(bytes, dim, count),
    }
}

/// Returns small integers times one power of two.
fn lattice(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    let scale = bytes.power_of_two();
    let side = 1 + bytes.small().abs() % 9;
    (0..count * dim).map(|_| finite((bytes.small() % side) as f64 * scale)).collect()
}

/// Returns numbers a few units in the last place around one value, which is often 1.
fn ulps(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    let base = if bytes.once_in(2) { bytes.finite() } else { 1.0 };
    (0..count * dim)
        .map(|_| {
            let step = bytes.byte();
            let distance = u64::from(step & 7) << (step >> 3 & 31);
            finite(f64::from_bits(base.to_bits() ^ distance))
        })
        .collect()
}

/// Returns integer combinations of a few directions: points in an affine subspace of any rank.
fn flat_lattice(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    let scale = bytes.power_of_two();
    let rank = 1 + bytes.below(dim as u8);
    let start: Vec<i64> = (0..dim).map(|_| bytes.small()).collect();
    let directions: Vec<i64> = (0..rank * dim).map(|_| bytes.small() % 8).collect();
    let mut all = Vec::with_capacity(count * dim);
    for _ in 0..count {
        let steps: Vec<i64> = (0..rank).map(|_| bytes.small() % 4).collect();
        for axis in 0..dim {
            let along: i64 = (0..rank).map(|k| steps[k] * directions[k * dim + axis]).sum();
            all.push(finite((start[axis] + along) as f64 * scale));
        }
    }
    all
}

/// Returns signed rotations of one lattice vector, which are on one sphere.
fn cospherical(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    let scale = bytes.power_of_two();
    let vector: Vec<i64> = (0..dim).map(|_| bytes.small() % 5).collect();
    let center: Vec<i64> = (0..dim).map(|_| bytes.small() % 3).collect();
    let mut all = Vec::with_capacity(count * dim);
    for _ in 0..count {
        let (turn, signs) = (bytes.below(dim as u8), bytes.byte());
        for axis in 0..dim {
            let length = vector[(axis + turn) % dim];
            let x = if signs >> axis & 1 == 0 { length } else { -length };
            all.push(finite((center[axis] + x) as f64 * scale));
        }
    }
    all
}

/// Returns coordinates each of its own kind, often made from an earlier one: equal, opposite, next
/// to it.
fn mixed(bytes: &mut Bytes<'_>, dim: usize, count: usize) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::with_capacity(count * dim);
    for _ in 0..count * dim {
        let kind = bytes.below(10);
        let earlier = match all.len() {
            0 => 1.0,
            // The same axis of an earlier point, as a rule.
            n => all[n - (dim * (1 + bytes.below(4))).min(n)],
        };
        all.push(match kind {
            0 => bytes.finite(),
            1 => 0.0,
            2 => bytes.small() as f64,
            3 => bytes.power_of_two(),
            4 => -bytes.power_of_two(),
            5 => finite(earlier.next_up()),
            6 => finite(earlier.next_down()),
            7 => -earlier,
            8 => f64::from_bits(u64::from(bytes.byte())),
            _ => earlier,
        });
    }
    all
}

fn finite(value: f64) -> f64 {
    value.clamp(-f64::MAX, f64::MAX)
}
