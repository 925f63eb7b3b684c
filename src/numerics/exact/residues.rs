//! Arithmetic modulo the primes just below 2^63. An integer is known by its residues modulo enough
//! of them (Chinese remainder theorem), and residues need no memory that grows with the integer.

/// Differences of 2^63 and the primes, from the largest prime down.
const OFFSETS: [u16; Field::COUNT] = [
    25, 165, 259, 301, 375, 387, 391, 409, 457, 471, 517, 529, 549, 627, 649, 669, 711, 735, 751,
    849, 871, 891, 915, 1011, 1069, 1095, 1129, 1179, 1221, 1237, 1249, 1297, 1299, 1309, 1357,
    1395, 1467, 1489, 1501, 1531, 1551, 1561, 1575, 1609, 1629, 1635, 1755, 1809, 1831, 1855, 1909,
    1941, 2025, 2169, 2247, 2251, 2289, 2301, 2319, 2331, 2365, 2379, 2401, 2455, 2515, 2635, 2739,
    2761, 2847, 2851, 2859, 2905, 2961, 3007, 3075, 3127, 3261, 3339, 3379, 3441, 3519, 3567, 3639,
    3667, 3747, 3757, 3769, 3819, 3831, 3835, 3855, 3939, 3967, 3975, 4011, 4059, 4071, 4081, 4105,
    4119, 4135, 4195, 4237, 4239, 4245, 4249, 4267, 4321, 4351, 4357, 4569, 4581, 4659, 4699, 4737,
    4785, 4791, 4869, 4897, 4995, 5059, 5085, 5217, 5239, 5457, 5487, 5499, 5521, 5605, 5655, 5679,
    5781, 5869, 5887, 5985, 6009, 6045, 6087, 6349, 6387, 6439, 6451, 6477, 6505, 6519, 6559, 6565,
    6577, 6645, 6667, 6705, 6709, 6745, 6747, 6799, 6835, 6841, 6967, 6985, 7035, 7065, 7129, 7269,
    7299, 7311, 7341, 7357, 7381, 7461, 7471, 7539, 7651, 7707, 7725, 7837, 7927, 7969, 7989, 8095,
    8175, 8199, 8299, 8325, 8425, 8437, 8515, 8571, 8647, 8677, 8721, 8725, 8787, 8839, 8845, 8865,
    8949, 9021, 9037, 9057, 9267, 9421, 9429, 9487, 9547, 9565, 9609, 9639, 9679, 9747, 9775, 9777,
    9795, 9799, 9867, 9981, 9999, 10015, 10035, 10041, 10101, 10237, 10251, 10285, 10287, 10321,
    10435, 10465, 10485, 10489, 10509, 10635, 10665, 10717, 10789, 10807, 10861, 10885, 10917,
    10965, 11055, 11115, 11121, 11169, 11185, 11191, 11211, 11251, 11259, 11295, 11307, 11337,
    11391, 11407, 11491, 11521, 11557, 11575, 11725, 11751, 11785, 11797, 11869, 11895, 11961,
    11995, 12001, 12091, 12157, 12187, 12225, 12309, 12355, 12415, 12435, 12525, 12655, 12681,
    12751, 12781, 12795, 13009, 13029, 13051, 13095, 13135, 13165, 13257, 13279, 13327, 13341,
    13345, 13347, 13401, 13629, 13687, 13689, 13699, 13737, 13785, 13797, 13885, 13939, 13951,
    13981, 13999, 14031, 14067, 14107, 14157, 14247, 14257, 14389, 14419, 14431, 14569, 14571,
    14577, 14611, 14679, 14751, 14755, 14761, 14775, 14779, 14839, 14859, 14871, 15019, 15129,
    15165, 15171, 15285, 15315, 15337,
];

/// Inverse, modulo each prime, of the product of all primes before it.
static INVERSES: [u64; Field::COUNT] = {
    let mut inverses = [1; Field::COUNT];
    let mut index = 0;
    while index < Field::COUNT {
        let field = Field::nth(index);
        let mut product = 1;
        let mut before = 0;
        while before < index {
            product = field.multiply(product, field.distance(before));
            before += 1;
        }
        inverses[index] = field.power(product, field.prime() - 2); // Fermat
        index += 1;
    }
    inverses
};

/// Integers modulo a prime 2^63 - c, as 0 to prime - 1. With c < 2^14 a reduction folds twice: 2^63
/// has the residue c.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    index: usize,
    offset: u64,
}

const MASK: u128 = (1 << 63) - 1;

impl Field {
    /// Number of primes.
    pub const COUNT: usize = 334;

    pub const fn nth(index: usize) -> Self {
        Self { index, offset: OFFSETS[index] as u64 }
    }

    pub const fn prime(self) -> u64 {
        (1 << 63) - self.offset
    }

    /// Returns the residue of `value`, which must be below 2^127.
    #[inline]
    pub const fn reduce(self, value: u128) -> u64 {
        // Below 2^79, then below 2^63 + 2^30, which is less than twice the prime.
        let folded = self.fold(self.fold(value)) as u64;
        if folded >= self.prime() { folded - self.prime() } else { folded }
    }

    /// Returns a smaller number with the same residue: below 2^63 + 2^14 h for one below 2^63 h.
    #[inline]
    pub const fn fold(self, value: u128) -> u128 {
        (value & MASK) + (value >> 63) as u64 as u128 * self.offset as u128
    }

    #[inline]
    pub const fn multiply(self, a: u64, b: u64) -> u64 {
        self.reduce(a as u128 * b as u128)
    }

    #[inline]
    pub const fn subtract(self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + (self.prime() - b) }
    }

    const fn power(self, base: u64, exponent: u64) -> u64 {
        let (mut result, mut square, mut left) = (1, base, exponent);
        while left != 0 {
            if left & 1 == 1 {
                result = self.multiply(result, square);
            }
            square = self.multiply(square, square);
            left >>= 1;
        }
        result
    }

    /// Returns the residue of 2^63.
    pub const fn limb_unit(self) -> u64 {
        self.offset
    }

    /// Returns a number less than 2^78 with the residue of a product of residues: a sum of 2^16
    /// such numbers can be reduced.
    #[inline]
    pub fn folded_product(self, a: u64, b: u64) -> u128 {
        self.fold(u128::from(a) * u128::from(b))
    }

    /// Returns the residue of a sum of at most 2^16 products of residues.
    #[inline]
    pub fn sum_of_products(self, factors: impl Iterator<Item = (u64, u64)>) -> u64 {
        self.reduce(factors.map(|(a, b)| self.folded_product(a, b)).sum())
    }

    /// Returns the residue of an earlier field's prime, which is small.
    #[inline]
    pub const fn distance(self, before: usize) -> u64 {
        self.offset - OFFSETS[before] as u64
    }

    /// Returns the inverse of the product of all the primes of earlier fields.
    #[inline]
    pub fn inverse_of_earlier(self) -> u64 {
        INVERSES[self.index]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    fn power(base: u64, exponent: u64, modulus: u64) -> u64 {
        let times = |a, b| (u128::from(a) * u128::from(b) % u128::from(modulus)) as u64;
        (0..64).rev().fold(1, |result, bit| {
            let square = times(result, result);
            if exponent >> bit & 1 == 1 { times(square, base) } else { square }
        })
    }

    /// Returns true if `n` is prime, by Miller and Rabin's test, which is a proof for 64 bits with
    /// the first twelve primes as bases (Sorenson and Webster, "Strong pseudoprimes to twelve prime
    /// bases", 2017).
    fn is_prime(n: u64) -> bool {
        let twos = (n - 1).trailing_zeros();
        [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].iter().all(|base| {
            let mut x = power(*base, (n - 1) >> twos, n);
            if x == 1 {
                return true;
            }
            for _ in 1..twos {
                if x == n - 1 {
                    return true;
                }
                x = power(x, 2, n);
            }
            x == n - 1
        })
    }

    #[test]
    fn the_moduli_are_distinct_primes() {
        assert!(OFFSETS.is_sorted_by(|a, b| a < b) && OFFSETS[Field::COUNT - 1] < 1 << 14);
        for k in 0..Field::COUNT {
            assert!(is_prime(Field::nth(k).prime()), "{k}");
        }
    }

    #[test]
    fn arithmetic_is_that_of_remainders() {
        let mut random = Random(3);
        for k in 0..Field::COUNT {
            let field = Field::nth(k);
            let prime = u128::from(field.prime());
            let largest = (1u128 << 127) - 1;
            let drawn = (u128::from(random.bits()) << 64 | u128::from(random.bits())) >> 1;
            for value in [0, 1, prime - 1, prime, 2 * prime - 1, 2 * prime, drawn, largest] {
                assert_eq!(u128::from(field.reduce(value)), value % prime, "{k} {value}");
            }
            // The last fold leaves most where the bits below 63 are all ones.
            for high in 0..200u128 {
                let value = ((high + 1) << 63) - 1;
                assert_eq!(u128::from(field.reduce(value)), value % prime, "{k} {value}");
            }
            let residues = [0, 1, 2, field.prime() / 2, field.prime() - 1, drawn as u64 >> 2];
            for a in residues {
                for b in residues {
                    let difference = (u128::from(a) + prime - u128::from(b)) % prime;
                    assert_eq!(u128::from(field.subtract(a, b)), difference);
                    let product = u128::from(a) * u128::from(b) % prime;
                    assert_eq!(u128::from(field.multiply(a, b)), product);
                }
            }
            assert_eq!(u128::from(field.limb_unit()), (1 << 63) % prime);
            let most = std::iter::repeat_n((field.prime() - 1, field.prime() - 1), 1 << 16);
            assert_eq!(field.sum_of_products(most), 1 << 16);
        }
    }

    #[test]
    fn inverses_are_of_the_earlier_primes() {
        for k in 0..Field::COUNT {
            let (field, prime) = (Field::nth(k), u128::from(Field::nth(k).prime()));
            let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % prime) as u64;
            let product = (0..k).fold(1, |product, j| times(product, Field::nth(j).prime()));
            assert_eq!(times(product, field.inverse_of_earlier()), 1);
            (0..k).for_each(|j| {
                assert_eq!(field.distance(j), Field::nth(j).prime() - field.prime());
            });
        }
    }
}
