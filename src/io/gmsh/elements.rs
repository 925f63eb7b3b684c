//! The elements of a file, which are counted and left out.

use super::super::text::{Line, Lines};
use super::{Version, require_end_of};
use crate::error::Result;
use crate::mesh::LeftOut;

/// Counts what the section `$Elements` holds, whose first line comes next.
pub(super) fn leave_out(
    lines: &mut Lines<'_>,
    version: Version,
    left_out: &mut LeftOut,
) -> Result<()> {
    match version {
        Version::Two => leave_out_rows(lines, left_out)?,
        Version::FourOne => leave_out_blocks(lines, left_out)?,
    }
    require_end_of(lines, "Elements")
}

/// Reads an element a line, of which only its type matters here, and counts the elements that are
/// left out.
fn leave_out_rows(lines: &mut Lines<'_>, left_out: &mut LeftOut) -> Result<()> {
    let lacks = || "the number of elements is missing".into();
    let [elements] = lines.require(lacks)?.integers(["number of elements"])?;
    for index in 0..elements {
        let line = lines.require(|| format!("{index} of {elements} elements"))?;
        let Some((column, word)) = line.words().nth(1) else {
            return Err(line.error("an element without a type"));
        };
        left_out.add(dimension_of(line.integer(column, word, "type of an element")?), 1);
    }
    Ok(())
}

/// Blocks of elements, one per entity, whose first line has the dimension of all.
fn leave_out_blocks(lines: &mut Lines<'_>, left_out: &mut LeftOut) -> Result<()> {
    let header = lines.require(|| "the numbers of blocks and elements are missing".into())?;
    let names = ["number of blocks", "number of elements", "smallest id", "largest id"];
    let [blocks, elements, _, _] = header.integers(names)?;
    let mut done = 0;
    for index in 0..blocks {
        let line = lines.require(|| format!("{index} of {blocks} blocks of elements"))?;
        let [dimension, count] = block_of(&line)?;
        if count > elements - done {
            let left = elements - done;
            return Err(line.error(format!("{count} elements where {left} of {elements} are left")));
        }
        for _ in 0..count {
            lines.require(|| format!("{done} of {elements} elements"))?;
            done += 1;
        }
        left_out.add(dimension, count);
    }
    match elements - done {
        0 => Ok(()),
        _ => {
            let message = format!("the blocks hold {done} of {elements} elements");
            Err(lines.error(crate::error::ErrorKind::Format, &message))
        }
    }
}

/// Reads the dimension and the number of elements of a block: its line has the entity's tag, which
/// may be negative, and the type between them.
fn block_of(line: &Line<'_>) -> Result<[u64; 2]> {
    line.require_words(4)?;
    let mut block = [0; 2];
    for (column, word) in line.words() {
        match column {
            0 => block[0] = line.integer(column, word, "dimension of an entity")?,
            3 => block[1] = line.integer(column, word, "number of elements")?,
            _ => line.skip_number(column, word)?,
        }
    }
    if block[0] > 3 {
        return Err(
            line.error("a block of elements begins with: dimension (0 to 3) tag type elements")
        );
    }
    Ok(block)
}

/// Returns the dimension of a type of elements; all that are not listed are of three dimensions.
fn dimension_of(element: u64) -> u64 {
    match element {
        15 => 0,
        1 | 8 | 26..=28 | 62..=66 => 1,
        2 | 3 | 9 | 10 | 16 | 20..=25 | 36..=61 => 2,
        _ => 3,
    }
}
