//! Files that claim much and hold little, or much of nothing: refused within bounded memory and time.

use netmesh::io::{Format, read, read_points};
use netmesh::{Error, ErrorKind};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fs::File;
use std::io::{BufReader, Read};
use std::time::{Duration, Instant};

const READABLE: [Format; 4] = [Format::Xyz, Format::Csv, Format::TetgenNode, Format::Off];
const GIGABYTE: u64 = 1 << 30;
/// What a reader may hold beside the points: its buffer, a line, and room for the vectors to grow.
const FEW_BYTES: isize = 4 << 20;

/// Counts what the current thread holds: tests run side by side.
struct Counting;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
}

fn count(change: isize) {
    let held = HELD.get() + change;
    HELD.set(held);
    PEAK.set(PEAK.get().max(held));
}

// SAFETY: everything is the system allocator's; counting neither allocates nor panics.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What `body` answers, and the most that it held beyond what was held before.
fn peak_of<T>(body: impl FnOnce() -> T) -> (T, isize) {
    let before = HELD.get();
    PEAK.set(before);
    let answer = body();
    (answer, PEAK.get() - before)
}

fn refusal(format: Format, input: impl Read) -> Error {
    let (read, peak) =
        peak_of(|| read(&mut BufReader::with_capacity(1 << 16, input), format).map(|_| ()));
    let error = read.expect_err("nothing to read");
    assert!(peak < FEW_BYTES, "{format:?}: {peak} bytes, {error}");
    assert_eq!(error.kind(), ErrorKind::Format, "{format:?}: {error}");
    error
}

#[test]
fn the_memory_is_counted() {
    let (bytes, peak) = peak_of(|| vec![1_u8; 10_000_000].len());
    assert!(bytes == 10_000_000 && (10_000_000..10_001_000).contains(&peak), "{peak}");
}

/// Nothing is allocated for what a header claims before the data is there.
#[test]
fn huge_declared_sizes_take_no_memory() {
    for count in ["4294967295", "1000000000000", "9223372036854775807", "18446744073709551615"] {
        let node = format!("{count} 3 0 0\n0 1 2 3\n");
        let error = refusal(Format::TetgenNode, node.as_bytes());
        let expected = format!("the file ends after line 2: 1 of {count} points");
        assert_eq!(error.message(), expected);
        let attributes = format!("1 3 {count} 0\n0 1 2 3\n");
        let error = refusal(Format::TetgenNode, attributes.as_bytes());
        assert!(error.message().starts_with("line 2: 4 columns where"), "{error}");
        let vertices = format!("OFF\n{count} 0 0\n1 2 3\n");
        let error = refusal(Format::Off, vertices.as_bytes());
        let expected = format!("the file ends after line 3: 1 of {count} vertices");
        assert_eq!(error.message(), expected);
        let faces = format!("OFF\n1 {count} 0\n1 2 3\n1 0\n");
        let error = refusal(Format::Off, faces.as_bytes());
        let expected = format!("the file ends after line 4: 1 of {count} faces");
        assert_eq!(error.message(), expected);
        let corners = format!("OFF\n1 1 0\n1 2 3\n{count} 0 0\n");
        let error = refusal(Format::Off, corners.as_bytes());
        assert!(error.message().starts_with("line 4: the face ends before"), "{error}");
    }
}

/// Where the first line never ends, no more than a line's length is read.
#[test]
fn a_gigabyte_of_one_byte_is_refused_at_once() {
    for (byte, expected) in [
        (0, "line 1, byte 1: a NUL byte; this is not a text file"),
        (b' ', "line 1: the line is longer than 1 MiB"),
        (b'1', "line 1: the line is longer than 1 MiB"),
        (b'\r', "line 1: the line is longer than 1 MiB"),
        (b'#', "line 1: the line is longer than 1 MiB"),
        (b',', "line 1: the line is longer than 1 MiB"),
        (0xff, "line 1: the line is longer than 1 MiB"),
    ] {
        for format in READABLE {
            let mut input = std::io::repeat(byte).take(GIGABYTE);
            assert_eq!(refusal(format, &mut input).message(), expected, "{format:?}");
            let taken = GIGABYTE - input.limit();
            assert!(taken <= (1 << 20) + (1 << 17), "{format:?}: {taken} bytes were read");
        }
    }
}

/// A whole gigabyte has to be looked at, byte by byte but not line by line.
#[test]
fn a_gigabyte_of_empty_lines_is_refused_in_seconds() {
    let begun = Instant::now();
    let error = refusal(Format::Xyz, std::io::repeat(b'\n').take(GIGABYTE));
    assert_eq!(error.message(), "the file holds no points");
    let error = refusal(Format::TetgenNode, std::io::repeat(b'\n').take(GIGABYTE));
    let expected = "the file ends after line 1073741824: a .node file begins with its counts";
    assert_eq!(error.message(), expected);
    // Some two seconds; slow machines, and other work beside, may need many times that.
    assert!(begun.elapsed() < Duration::from_secs(120), "{:?}", begun.elapsed());
}

/// The same from a real file: one that takes no room on the disk.
#[cfg(unix)]
#[test]
fn a_sparse_file_of_a_gigabyte_is_refused_at_once() {
    let path = std::env::temp_dir().join(format!("netmesh-sparse-{}", std::process::id()));
    let made = File::create(&path).and_then(|file| file.set_len(GIGABYTE));
    let answers =
        READABLE.map(|format| peak_of(|| read_points(&path, format).map(|points| points.dim)));
    std::fs::remove_file(&path).unwrap();
    if let Err(error) = made {
        return println!("skipped: no sparse file here: {error}");
    }
    for (answer, peak) in answers {
        let error = answer.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Format, "{error}");
        assert!(error.message().ends_with("line 1, byte 1: a NUL byte; this is not a text file"));
        assert!(peak < FEW_BYTES, "{peak} bytes");
    }
}
