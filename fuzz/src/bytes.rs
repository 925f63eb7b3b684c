//! Bytes as a source of choices. When they run out there are only zeros, so every prefix of an
//! input is an input.

pub struct Bytes<'a> {
    rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Self { rest: data }
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// Returns all bytes that are left.
    pub fn rest(&mut self) -> &'a [u8] {
        std::mem::take(&mut self.rest)
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.rest.split_first() else { return 0 };
        self.rest = rest;
        *first
    }

    /// Returns one of `0..count`.
    pub fn below(&mut self, count: u8) -> usize {
        usize::from(self.byte() % count)
    }

    /// Returns true once in `count`.
    pub fn once_in(&mut self, count: u8) -> bool {
        self.byte() % count == count - 1
    }

    pub fn word(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// Returns a small integer of either sign.
    pub fn small(&mut self) -> i64 {
        i64::from(self.byte() as i8)
    }

    /// Returns any double, by its bits.
    pub fn double(&mut self) -> f64 {
        f64::from_bits(self.word())
    }

    /// Returns any finite double, by its bits.
    pub fn finite(&mut self) -> f64 {
        let value = self.double();
        if value.is_finite() { value } else { f64::from_bits(value.to_bits() & !(1 << 62)) }
    }

    /// Returns a power of two, anywhere in the range of doubles.
    pub fn power_of_two(&mut self) -> f64 {
        let exponent = i32::from(self.byte()) * 8 - 1022 - 52;
        2f64.powi(exponent.max(-1022)) * 2f64.powi(exponent - exponent.max(-1022))
    }
}
