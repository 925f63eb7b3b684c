//! Signs of determinants by full expansion: every product of the Leibniz formula as an integer, in
//! units of a power of 2^-1074, added to one sum that is wide enough for all finite doubles. No
//! difference is taken, nothing is divided or rounded, no library is used: nothing here is shared
//! with the signs under test.

/// Number of 32-bit digits: 8 factors of up to 2^2098 each, and their products' ends.
const DIGITS: usize = 8 * 2045 / 32 + 20;

/// Largest number of factors of a product: 6 coordinates and the square of one.
const FACTORS: usize = 8;

/// Returns the sign of det[p1 - p0, ..., pD - p0] as -1, 0 or 1.
pub fn orientation<const D: usize>(simplex: &[[f64; D]]) -> i8 {
    // Rows (p, 1). Taking the first row off the others leaves det[pi - p0] behind the 1 in the
    // last column of the first row.
    let sign = Expansion::<D>::new(simplex, false).sign();
    if D % 2 == 0 { sign } else { -sign }
}

/// Returns 1 for a point inside, 0 on and -1 outside the sphere through a positively oriented
/// simplex.
pub fn in_ball<const D: usize>(simplex: &[[f64; D]], q: &[f64; D]) -> i8 {
    // Rows (p, |p|^2, 1). Likewise det[v, |v|^2] is left, v = p - p0, which is negative inside.
    let mut rows = simplex.to_vec();
    rows.push(*q);
    let sign = Expansion::<D>::new(&rows, true).sign();
    if D % 2 == 0 { sign } else { -sign }
}

/// Expansion of a determinant whose last column is 1. If `lifted`, the column before it is the
/// square of the rest of the row.
struct Expansion<'a, const D: usize> {
    rows: &'a [[f64; D]],
    lifted: bool,
    sum: Sum,
}

impl<'a, const D: usize> Expansion<'a, D> {
    fn new(rows: &'a [[f64; D]], lifted: bool) -> Self {
        assert_eq!(rows.len(), D + 1 + usize::from(lifted));
        Self { rows, lifted, sum: Sum::default() }
    }

    fn sign(mut self) -> i8 {
        self.expand(0, 0, &Product::ONE);
        self.sum.sign()
    }

    /// Adds all products of `product` with an entry of each row from `row` on, from columns that
    /// are not in the set `used`.
    fn expand(&mut self, row: usize, used: u32, product: &Product) {
        if row == self.rows.len() {
            self.sum.add(product);
            return;
        }
        let mut negative = false;
        for column in 0..self.rows.len() {
            if used >> column & 1 == 1 {
                continue;
            }
            let signed = product.with_sign(product.negative ^ negative);
            negative = !negative;
            self.expand_entry(row, column, used | 1 << column, &signed);
        }
    }

    fn expand_entry(&mut self, row: usize, column: usize, used: u32, product: &Product) {
        let point = &self.rows[row];
        if column < D {
            self.expand_if_nonzero(row, used, product.times(point[column]));
        } else if self.lifted && column == D {
            for x in point {
                self.expand_if_nonzero(row, used, product.times(*x).times(*x));
            }
        } else {
            // A 1, of as many units as the others have: no coordinate, or the square of one.
            self.expand(row + 1, used, product);
        }
    }

    fn expand_if_nonzero(&mut self, row: usize, used: u32, product: Product) {
        if !product.is_zero() {
            self.expand(row + 1, used, &product);
        }
    }
}

/// Product of doubles: an integer times a power of two.
#[derive(Clone, Copy)]
struct Product {
    negative: bool,
    /// Number of limbs in use.
    length: usize,
    /// Exponent of the unit: 2^-1074 for each factor, times 2 to this power.
    shift: usize,
    limbs: [u64; FACTORS - 1],
}

impl Product {
    const ONE: Self = Self { negative: false, length: 1, shift: 0, limbs: [1, 0, 0, 0, 0, 0, 0] };

    fn is_zero(&self) -> bool {
        self.length == 0
    }

    fn with_sign(&self, negative: bool) -> Self {
        Self { negative, ..*self }
    }

    fn times(&self, x: f64) -> Self {
        let bits = x.to_bits();
        let (biased, fraction) = (bits >> 52 & 0x7ff, bits & ((1 << 52) - 1));
        assert!(biased < 0x7ff, "a coordinate is not finite");
        let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mut product = Self {
            negative: self.negative ^ (bits >> 63 == 1),
            length: 0,
            shift: self.shift + biased.max(1) as usize - 1,
            limbs: [0; FACTORS - 1],
        };
        if mantissa == 0 {
            return product;
        }
        let mut carry = 0u128;
        for i in 0..self.length {
            carry += u128::from(self.limbs[i]) * u128::from(mantissa);
            product.limbs[i] = carry as u64;
            carry >>= 64;
        }
        product.length = self.length;
        if carry > 0 {
            product.limbs[product.length] = carry as u64;
            product.length += 1;
        }
        product
    }
}

/// Sum of products with the same number of factors. Digits are signed and carry only at the end.
struct Sum {
    digits: [i64; DIGITS],
    low: usize,
    high: usize,
}

impl Default for Sum {
    fn default() -> Self {
        Self { digits: [0; DIGITS], low: DIGITS, high: 0 }
    }
}

impl Sum {
    fn add(&mut self, product: &Product) {
        let (first, bits) = (product.shift / 32, product.shift % 32);
        for (i, limb) in product.limbs[..product.length].iter().enumerate() {
            let shifted = u128::from(*limb) << bits;
            for k in 0..3 {
                let digit = i64::from((shifted >> (32 * k)) as u32);
                self.digits[first + 2 * i + k] += if product.negative { -digit } else { digit };
            }
        }
        self.low = self.low.min(first);
        self.high = self.high.max(first + 2 * product.length + 1);
    }

    fn sign(&self) -> i8 {
        let (mut carry, mut rest) = (0i64, 0u32);
        for digit in &self.digits[self.low.min(self.high)..self.high] {
            carry += digit;
            rest |= carry as u32;
            carry >>= 32;
        }
        // The value is carry * 2^(32 k) and something in 0..2^(32 k).
        match carry.signum() {
            0 => i8::from(rest != 0),
            sign => sign as i8,
        }
    }
}
