//! NumPy's `.npy`: an array of points in C order, of which a rank reads its rows.

use super::{Share, io_error, start_of};
use netmesh::distributed::memory::{filled, with_capacity};
use netmesh::mesh::{MAX_DIM, MIN_DIM};
use netmesh::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// The longest header that is read.
const MAX_HEADER: usize = 1 << 16;

/// Number of bytes that are read at once.
const BLOCK: usize = 1 << 20;

/// Header of a NumPy file.
#[derive(Debug, PartialEq)]
struct Header {
    /// Number of bytes of a number.
    size: usize,
    is_big_endian: bool,
    points: u64,
    dim: usize,
}

pub fn read(mut file: File, rank: u64, ranks: u64) -> Result<Share> {
    let (header, data) = read_header(&mut file)?;
    let row = (header.size * header.dim) as u64;
    let length = file.seek(SeekFrom::End(0)).map_err(|error| io_error("cannot read", &error))?;
    let needed = header.points.checked_mul(row).and_then(|bytes| bytes.checked_add(data));
    if needed != Some(length) {
        let points = header.points;
        let message = format!("the file has {length} bytes; {points} points need another number");
        return Err(Error::format(message));
    }
    let start = start_of(rank, ranks, header.points);
    let end = start_of(rank + 1, ranks, header.points);
    let mut points = with_capacity((end - start) as usize * header.dim)?;
    file.seek(SeekFrom::Start(data + start * row))
        .map_err(|error| io_error("cannot read", &error))?;
    let mut left = ((end - start) * row) as usize;
    let mut block = filled(BLOCK.min(left), 0)?;
    while left > 0 {
        let bytes = &mut block[..BLOCK.min(left)];
        file.read_exact(bytes).map_err(|error| io_error("cannot read", &error))?;
        for bytes in bytes.chunks_exact(header.size) {
            let at = points.len() as u64;
            points.push(header.number(
                bytes,
                start + at / header.dim as u64,
                at % header.dim as u64,
            )?);
        }
        left -= bytes.len();
    }
    Ok(Share { dim: header.dim, points })
}

fn read_header(file: &mut File) -> Result<(Header, u64)> {
    let mut start = [0; 8];
    let short = || bad("no header of a NumPy file");
    file.read_exact(&mut start).map_err(|_| short())?;
    if start[..6] != *MAGIC {
        return Err(short());
    }
    // Version 1 has a length of two bytes, those after it one of four.
    let wide = start[6] > 1;
    let mut length = [0; 4];
    let digits = if wide { 4 } else { 2 };
    file.read_exact(&mut length[..digits]).map_err(|_| short())?;
    let length = u32::from_le_bytes(length) as usize;
    if length > MAX_HEADER {
        return Err(bad("a header of more than 64 KiB"));
    }
    let mut text = vec![0; length];
    file.read_exact(&mut text).map_err(|_| short())?;
    Ok((Header::parse(&String::from_utf8_lossy(&text))?, (8 + digits + length) as u64))
}

impl Header {
    /// Parses a header such as `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }`.
    fn parse(text: &str) -> Result<Self> {
        let value = |key: &str| {
            let rest = text.split_once(&format!("'{key}'")).map(|(_, rest)| rest);
            let rest = rest.and_then(|rest| rest.trim_start().strip_prefix(':'));
            rest.map(str::trim_start).ok_or_else(|| bad(&format!("the header has no '{key}'")))
        };
        let (size, is_big_endian) = match value("descr")?.get(..5) {
            Some("'<f8'") => (8, false),
            Some("'>f8'") => (8, true),
            Some("'<f4'") => (4, false),
            Some("'>f4'") => (4, true),
            _ => return Err(bad("doubles ('<f8', '>f8') and floats ('<f4', '>f4') are read only")),
        };
        if !value("fortran_order")?.starts_with("False") {
            return Err(bad("'fortran_order' must be False: ranks read rows"));
        }
        let shape = value("shape")?.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        let shape = shape.map(|(shape, _)| shape.split(',').map(str::trim)).into_iter().flatten();
        let lengths: Vec<_> =
            shape.filter(|word| !word.is_empty()).map(str::parse::<u64>).collect();
        let [Ok(points), Ok(dim)] = *lengths else {
            return Err(bad("a shape other than (points, dim)"));
        };
        if !(MIN_DIM as u64..=MAX_DIM as u64).contains(&dim) {
            let message = format!("points of dimension {dim}; it must be {MIN_DIM} to {MAX_DIM}");
            return Err(Error::new(ErrorKind::Dimension, message));
        }
        Ok(Self { size, is_big_endian, points, dim: dim as usize })
    }

    fn number(&self, bytes: &[u8], point: u64, axis: u64) -> Result<f64> {
        let mut wide = [0; 8];
        let wide = &mut wide[..self.size];
        wide.copy_from_slice(bytes);
        if self.is_big_endian {
            wide.reverse();
        }
        let value = match *wide {
            [a, b, c, d] => f32::from_le_bytes([a, b, c, d]).into(),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
            _ => f64::NAN,
        };
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("point {point} has the non-finite coordinate {axis}: {value}");
        Err(Error::new(ErrorKind::NonFinite, message))
    }
}

fn bad(why: &str) -> Error {
    Error::format(why.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_say_what_numpy_means() {
        let header = |text: &str| Header::parse(text);
        let expected = Header { size: 4, is_big_endian: true, points: 3, dim: 2 };
        let text = "{'descr': '>f4', 'fortran_order': False, 'shape': (3, 2), }  \n";
        assert_eq!(header(text).unwrap(), expected);
        for (text, why) in [
            ("{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2), }", "fortran_order"),
            ("{'descr': '<i8', 'fortran_order': False, 'shape': (3, 2), }", "doubles"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }", "shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2, 2), }", "shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 9), }", "dimension 9"),
            ("{'descr': '<f8', 'shape': (3, 2), }", "'fortran_order'"),
        ] {
            let error = header(text).unwrap_err();
            assert!(error.message().contains(why), "{error}");
        }
    }
}
