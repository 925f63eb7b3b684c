//! Base64 (RFC 4648), as browsers decode it.

use std::io::{self, Write};

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Writes the bytes of numbers, one number after another.
pub(super) fn write<const N: usize>(
    numbers: impl Iterator<Item = [u8; N]>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (mut held, mut count) = ([0; 3], 0);
    for byte in numbers.flatten() {
        held[count] = byte;
        count += 1;
        if count == 3 {
            out.write_all(&digits(held))?;
            (held, count) = ([0; 3], 0);
        }
    }
    if count > 0 {
        let mut last = digits(held);
        last[count + 1..].fill(b'=');
        out.write_all(&last)?;
    }
    Ok(())
}

fn digits([a, b, c]: [u8; 3]) -> [u8; 4] {
    let bits = u32::from_be_bytes([0, a, b, c]);
    [18, 12, 6, 0].map(|shift| DIGITS[(bits >> shift) as usize % 64])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Holds the examples of RFC 4648, Section 10.
    #[test]
    fn the_examples_of_the_standard_are_written() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let mut out = Vec::new();
            write(bytes.bytes().map(|byte| [byte]), &mut out).unwrap();
            assert_eq!(out, text.as_bytes());
        }
        let mut out = Vec::new();
        write([[0xff, 0xfe, 0], [0x3f, 0xff, 0xbf]].into_iter(), &mut out).unwrap();
        assert_eq!(out, b"//4AP/+/");
    }
}
