//! Pseudo-random numbers and hashes: SplitMix64 (G. Steele, D. Lea and C. Flood, "Fast splittable
//! pseudorandom number generators", 2014).

use rand_pcg::Pcg64Mcg;

/// Mixes the bits of a word, so that words that differ little give unlike results: the finaliser of
/// SplitMix64, which is a bijection.
#[inline]
pub const fn mixed(word: u64) -> u64 {
    let word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ word >> 31
}

/// Sequence of pseudo-random words; the number that it begins with is its seed.
#[derive(Clone, Debug)]
pub struct SplitMix(pub u64);

impl SplitMix {
    /// Difference of consecutive states: 2^64 over the golden ratio, made odd.
    pub const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

    /// Returns the next word.
    #[inline]
    pub fn next_word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(Self::STEP);
        mixed(self.0)
    }

    /// Returns the next number in [-1, 1), a multiple of 2^-52.
    pub fn unit(&mut self) -> f64 {
        (self.next_word() >> 11) as f64 * f64::EPSILON - 1.0
    }
}

/// Returns the random numbers of a seed for a part of the work, which has a number. No two seeds
/// have the same for one part, and no two parts for one seed.
pub fn random_numbers(seed: u64, part: u64) -> Pcg64Mcg {
    // The generator sets the lowest bit of its state, so what tells seeds apart is above.
    Pcg64Mcg::new(u128::from(mixed(seed ^ mixed(part))) << 64 | 0xcafe_f00d_d15e_a5e5)
}

#[cfg(test)]
mod tests {
    use rand_core::Rng;

    use super::*;

    /// Words of the authors' program for seed 1234567.
    #[test]
    fn words_are_those_of_splitmix64() {
        let mut words = SplitMix(1_234_567);
        let first = [0x599e_d017_fb08_fc85, 0x2c73_f084_5854_0fa5, 0x883e_bce5_a3f2_7c77];
        assert_eq!(first.map(|_| words.next_word()), first);
    }

    #[test]
    fn seeds_and_parts_have_numbers_of_their_own() {
        let numbers = |seed, part| {
            let mut random = random_numbers(seed, part);
            [(); 4].map(|()| random.next_u64())
        };
        let near = [0, 1, 2, 3, 4, 5, 1 << 63, u64::MAX - 1, u64::MAX];
        for vary in [|number| (number, 0), |number| (0, number), |number| (number, 7)] {
            let mut all = near.map(vary).map(|(seed, part)| numbers(seed, part));
            all.sort_unstable();
            assert!(all.windows(2).all(|pair| pair[0][0] != pair[1][0]), "{all:x?}");
        }
    }
}
