//! Files that claim much and hold little, or much of nothing: refused within bounded memory and
//! time.

use netmesh::io::{Format, read, read_points};
use netmesh::{Error, ErrorKind};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fs::File;
use std::io::{BufReader, Read};
use std::time::{Duration, Instant};

const READABLE: [Format; 8] = [
    Format::Xyz,
    Format::Csv,
    Format::TetgenNode,
    Format::Off,
    Format::Gmsh,
    Format::Medit,
    Format::Ply,
    Format::Npy,
];
const NO_NPY: &str = "byte 1: the file does not begin as an .npy file does";
const GIGABYTE: u64 = 1 << 30;
/// Bytes that a reader may hold beside the points: its buffer, a line, and room for the vectors to
/// grow.
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

/// Returns the answer of `body`, and the most that it held beyond what was held before.
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
        let points = "1 3\n0 1 2 3\n";
        for (facets, expected) in [
            (
                format!("{count}\n1\n1 0\n"),
                format!("the file ends after line 5: 1 of {count} facets"),
            ),
            (
                format!("1\n{count}\n1 0\n"),
                format!("the file ends after line 5: 1 of {count} polygons"),
            ),
            (
                format!("1\n1\n{count} 0\n"),
                format!("the file ends after line 5: 1 of {count} points of"),
            ),
            (
                format!("0\n{count}\n0 1 2 3\n"),
                format!("the file ends after line 5: 1 of {count} holes"),
            ),
        ] {
            let error = refusal(Format::Poly, (points.to_owned() + &facets).as_bytes());
            assert!(error.message().starts_with(&expected), "{error}");
        }
        let holes = format!("{}1\n1 {count}\n3 0 1 2\n", "3 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n");
        let error = refusal(Format::Poly, holes.as_bytes());
        assert!(error.message().contains(&format!("0 of {count} holes of a facet")), "{error}");
        let nodes = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{count}\n1 1 2 3\n");
        let error = refusal(Format::Gmsh, nodes.as_bytes());
        let expected = format!("the file ends after line 6: 1 of {count} nodes");
        assert_eq!(error.message(), expected);
        let blocks = format!(
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n{count} {count} 1 1\n3 1 0 {count}\n1\n"
        );
        let error = refusal(Format::Gmsh, blocks.as_bytes());
        let expected = format!("the file ends after line 7: 1 of {count} nodes");
        assert_eq!(error.message(), expected);
        let vertices = format!("MeshVersionFormatted 2\nDimension 3\nVertices {count}\n1 2 3 0\n");
        let error = refusal(Format::Medit, vertices.as_bytes());
        let expected = format!("the file ends after line 4: 1 of {count} vertices");
        assert_eq!(error.message(), expected);
    }
}

#[test]
fn huge_declared_sizes_of_binary_data_take_no_memory() {
    for count in ["4294967295", "1000000000000", "9223372036854775807", "18446744073709551615"] {
        let vertices = "property double x\nproperty double y\n";
        for (encoding, row, expected) in [
            ("ascii", &b"1 2\n"[..], "the file ends after line 7: 1 of"),
            ("binary_big_endian", &[0; 16], "the file ends after byte 16 after the header: 1 of"),
        ] {
            let header = format!("ply\nformat {encoding} 1.0\nelement vertex {count}\n{vertices}");
            let file = [header.as_bytes(), b"end_header\n", row].concat();
            let error = refusal(Format::Ply, file.as_slice());
            assert_eq!(error.message(), format!("{expected} {count} elements \"vertex\""));
        }
        // Rows that are skipped, all at once and one by one; the second claims 2^64 bytes and more.
        for property in ["double a", "list uint double a"] {
            let header = format!(
                "ply\nformat binary_little_endian 1.0\nelement e {count}\nproperty {property}\n\
                 element vertex 1\n{vertices}end_header\n"
            );
            let file = [header.as_bytes(), &[0xff; 20]].concat();
            let error = refusal(Format::Ply, file.as_slice());
            assert!(error.message().starts_with("the file ends after byte 20 after"), "{error}");
        }
        for order in ["True", "False"] {
            let header =
                format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': ({count}, 8)}}");
            let length = (header.len() as u16).to_le_bytes();
            let file = [b"\x93NUMPY\x01\0", &length[..], header.as_bytes(), &[0; 80]].concat();
            let error = refusal(Format::Npy, file.as_slice());
            assert!(error.message().starts_with("the file ends after byte"), "{error}");
            assert!(error.message().contains(&format!(" of {count} points")), "{error}");
        }
    }
}

/// Elements of nothing would go on for ever, as their rows take no bytes; headers are kept.
#[test]
fn a_header_of_declarations_is_bounded() {
    let endless = b"ply\nformat ascii 1.0\n".chain(Repeated(b"element vertex 1\n", 0));
    let error = refusal(Format::Ply, endless);
    assert_eq!(error.message(), "line 4: a second element \"vertex\"");
    let comments = b"ply\nformat ascii 1.0\n".chain(Repeated(b"comment c\n", 0).take(GIGABYTE / 8));
    let error = refusal(Format::Ply, comments);
    assert!(error.message().starts_with("the file ends after line"), "{error}");
}

/// Reader of some bytes again and again.
struct Repeated(&'static [u8], usize);

impl Read for Repeated {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        for byte in buffer.iter_mut() {
            *byte = self.0[self.1];
            self.1 = (self.1 + 1) % self.0.len();
        }
        Ok(buffer.len())
    }
}

/// No more than a line's length is read of a first line that never ends.
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
            let expected = if format == Format::Npy { NO_NPY } else { expected };
            assert_eq!(refusal(format, &mut input).message(), expected, "{format:?}");
            let taken = GIGABYTE - input.limit();
            assert!(taken <= (1 << 20) + (1 << 17), "{format:?}: {taken} bytes were read");
        }
    }
}

/// In GeoJSON and well-known text a line may be a file. What is kept of one is the points alone.
#[test]
fn long_lines_are_refused_within_bounded_memory() {
    const NAME: &str = "{\"type\":\"Point\",\"name\":";
    for (format, begin, repeated, at_once, message) in [
        (Format::Geojson, "", "\0", true, "line 1, byte 1: a NUL byte; this is not a text file"),
        (Format::Geojson, "", "1", true, "line 1, byte 1: \"1\" where an object of GeoJSON is"),
        (Format::Geojson, NAME, "1", true, "line 1, byte 24: a word of more than 2048 bytes"),
        (Format::Geojson, NAME, "[", true, "line 1, byte 123: more than 100 lists and objects in"),
        (
            Format::Geojson,
            NAME,
            "{\"a\":",
            true,
            "line 1, byte 519: more than 100 lists and objects",
        ),
        (
            Format::Geojson,
            "",
            " ",
            false,
            "the file ends at line 1, byte 134217729, where an object",
        ),
        (
            Format::Geojson,
            "{\"",
            "abc",
            false,
            "the file ends at line 1, byte 134217731, where a char",
        ),
        (
            Format::Geojson,
            "{\"a\":[0",
            ",[]",
            false,
            "the file ends at line 1, byte 134217736, where",
        ),
        (Format::Wkt, "", "\0", true, "line 1, byte 1: a NUL byte; this is not a text file"),
        (Format::Wkt, "", "1", true, "line 1, byte 1: a word of more than 2048 bytes"),
        (Format::Wkt, "POINT(", "1", true, "line 1, byte 7: a word of more than 2048 bytes"),
        (Format::Wkt, "", "GEOMETRYCOLLECTION(", true, "line 1, byte 1920: more than 100 collect"),
        (Format::Wkt, "", " ", false, "the file holds no points"),
        (Format::Wkt, "#", " ", false, "the file holds no points"),
        (Format::Wkt, "MULTIPOINT(EMPTY", ",EMPTY", false, "line 1, byte 134217744: \"E\" where"),
    ] {
        let mut rest = Repeated(repeated.as_bytes(), 0).take(GIGABYTE / 8);
        let error = refusal(format, begin.as_bytes().chain(&mut rest));
        assert!(error.message().starts_with(message), "{format:?} {begin:?} {repeated:?}: {error}");
        let taken = GIGABYTE / 8 - rest.limit();
        assert_eq!(taken < 1 << 18, at_once, "{format:?} {begin:?} {repeated:?}: {taken} bytes");
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

/// A real file of a gigabyte is refused at once, too: one that takes no room on the disk.
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
        let message = error.message();
        let refused = message.ends_with("line 1, byte 1: a NUL byte; this is not a text file");
        assert!(refused || message.ends_with(NO_NPY), "{error}");
        assert!(peak < FEW_BYTES, "{peak} bytes");
    }
}
