//! Points as text: a line belongs to the rank that has its first byte. Lines are the core's
//! business.

use super::{Share, io_error, start_of};
use netmesh::io::Format;
use netmesh::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};

pub fn read(mut file: File, rank: u64, ranks: u64) -> Result<Share> {
    let length = file.seek(SeekFrom::End(0)).map_err(|error| io_error("cannot read", &error))?;
    let mut place = |rank| line_start(&mut file, start_of(rank, ranks, length), length);
    let (start, end) = (place(rank)?, place(rank + 1)?);
    let mut input = at(&mut file, start)?.take(end - start);
    let read = match refuse_count(&mut input) {
        Ok(()) => netmesh::io::read(&mut input, Format::Xyz),
        Err(error) => Err(error),
    };
    match read {
        Ok(cloud) => Ok(Share { dim: cloud.dim, points: cloud.coordinates }),
        // Blank lines and comments only.
        Err(error) if error.message() == "the file holds no points" => Ok(Share::default()),
        Err(error) => Err(from_first_line(&mut file, start, error)),
    }
}

/// Refuses a first line with one whole number: the number of points of a file, which the core would
/// expect to be that of a rank's share.
fn refuse_count(input: &mut impl BufRead) -> Result<()> {
    let bytes = input.fill_buf().map_err(|error| io_error("cannot read", &error))?;
    let line = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii();
    if line.is_empty() || !line.iter().all(u8::is_ascii_digit) {
        return Ok(());
    }
    let message = format!(
        "line 1: {} is a number of points; ranks read files of points without it",
        line.escape_ascii()
    );
    Err(Error::format(message))
}

fn at(file: &mut File, offset: u64) -> Result<BufReader<&mut File>> {
    file.seek(SeekFrom::Start(offset)).map_err(|error| io_error("cannot read", &error))?;
    Ok(BufReader::new(file))
}

/// Returns the offset of the first line that begins at `offset` or after it.
fn line_start(file: &mut File, offset: u64, length: u64) -> Result<u64> {
    if offset == 0 || offset >= length {
        return Ok(offset);
    }
    let mut input = at(file, offset - 1)?;
    let mut start = offset - 1;
    loop {
        let bytes = input.fill_buf().map_err(|error| io_error("cannot read", &error))?;
        if bytes.is_empty() {
            return Ok(length);
        }
        if let Some(end) = bytes.iter().position(|byte| *byte == b'\n') {
            return Ok((start + end as u64 + 1).min(length));
        }
        let count = bytes.len();
        start += count as u64;
        input.consume(count);
    }
}

/// Returns the error of a line counted from `start`, with lines counted from the file's first.
fn from_first_line(file: &mut File, start: u64, error: Error) -> Error {
    let Some(rest) = error.message().strip_prefix("line ") else { return error };
    let (number, rest) =
        rest.split_at(rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()));
    match (number.parse::<u64>(), lines_before(file, start)) {
        (Ok(number), Ok(before)) => {
            Error::new(error.kind(), format!("line {}{rest}", number + before))
        }
        _ => Error::new(ErrorKind::Io, format!("{} after byte {start}", error.message())),
    }
}

fn lines_before(file: &mut File, end: u64) -> Result<u64> {
    let mut input = at(file, 0)?.take(end);
    let mut lines = 0;
    loop {
        let bytes = input.fill_buf().map_err(|error| io_error("cannot read", &error))?;
        if bytes.is_empty() {
            return Ok(lines);
        }
        lines += bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
        let count = bytes.len();
        input.consume(count);
    }
}
