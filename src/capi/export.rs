//! Writing meshes to files and to callbacks.

use super::arrays::read_selection;
use super::decode::decode_format;
use super::enums::nm_status;
use super::environment::Environment;
use super::error::null_argument;
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::utf8_path;
use super::structs::nm_selection;
use crate::arrays::Selection;
use crate::error::{Error, ErrorKind, Result, message};
use crate::io::{self, Buffered, Format};
use crate::memory::copied;
use crate::mesh::{Attribute, Mesh};
use std::ffi::{c_char, c_void};
use std::io::Write;
use std::mem::MaybeUninit;
use std::ptr::null;

/// The most bytes that a write callback gets at once is about this.
const CHUNK: usize = 1 << 16;

/// Receives an export from nm_export_write, piece by piece and in order, on the thread that called.
/// data: size bytes, at least 1, valid during the call. user_data: as given. Nonzero stops the
/// export, which then answers NM_IO and does not call again.
///
/// It must return: no exception, longjmp or thread exit may leave it. It may read the mesh; nm_run
/// on it answers NM_STATE, and it must not be freed.
#[allow(non_camel_case_types)]
pub type nm_write_fn =
    Option<unsafe extern "C" fn(data: *const c_void, size: usize, user_data: *mut c_void) -> i32>;

/// Writes the mesh to a file, replacing what was there. The file is written under another name and
/// then renamed: after a failure there is no half of one.
///
/// path_utf8: UTF-8 on every system. format: NM_FORMAT_AUTO goes by the extension.
///
/// Errors: NM_NULL_ARGUMENT (mesh, path_utf8), NM_INVALID_ARGUMENT (path_utf8 empty or not UTF-8,
/// an unknown format or extension, a format that cannot hold the mesh), NM_STATE (a mesh format
/// before nm_run; nm_run at work, poisoned), NM_IO (the message has the system's reason),
/// NM_OUT_OF_MEMORY.
///
/// O(vertices + simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export(
    mesh: *const nm_mesh,
    path_utf8: *const c_char,
    format: MaybeUninit<Format>,
) -> nm_status {
    // SAFETY: the caller's promises are the same; NULL selects all.
    unsafe { nm_export_selected(mesh, null(), path_utf8, format) }
}

/// Writes the mesh to a callback instead of a file; for NM_FORMAT_TETGEN_NODE the .node part, then
/// the .ele part. After a failure the callback may have received some of it.
///
/// format: not NM_FORMAT_AUTO. write: must not be NULL. user_data: handed to write, may be NULL.
///
/// Errors: NM_NULL_ARGUMENT (mesh, write), NM_INVALID_ARGUMENT (format), NM_STATE (a mesh format
/// before nm_run; nm_run at work, poisoned), NM_IO (write answered nonzero; the message has the
/// value), NM_OUT_OF_MEMORY.
///
/// O(vertices + simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_write(
    mesh: *const nm_mesh,
    format: MaybeUninit<Format>,
    write: nm_write_fn,
    user_data: *mut c_void,
) -> nm_status {
    // SAFETY: the caller's promises are the same; NULL selects all.
    unsafe { nm_export_write_selected(mesh, null(), format, write, user_data) }
}

/// Writes a selection to a file as nm_export does: its simplices and their vertices, numbered anew,
/// and the numbers of domains as they are. NM_FORMAT_DOMAINS_JSON takes no selection
/// (NM_INVALID_ARGUMENT).
///
/// selection: NULL for all.
///
/// Errors: as nm_export, and NM_INVALID_ARGUMENT (a field of the selection; the message names it).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_selected(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    path_utf8: *const c_char,
    format: MaybeUninit<Format>,
) -> nm_status {
    let body = |mesh: &Mesh, attributes: &[Attribute]| {
        // SAFETY: the caller gave NULL or a C string.
        let path = unsafe { utf8_path(path_utf8)? };
        io::write_file_with(mesh, attributes, path, decode_format(format)?)
    };
    // SAFETY: the caller's promises are those of `with_selected`.
    unsafe { with_selected(mesh, selection, format, body) }
}

/// Hands a selection to a callback as nm_export_write does, numbered as by nm_export_selected.
///
/// Errors: as nm_export_write, and NM_INVALID_ARGUMENT (a field of the selection; the message names
/// it).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_write_selected(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    format: MaybeUninit<Format>,
    write: nm_write_fn,
    user_data: *mut c_void,
) -> nm_status {
    let caller = Environment::current();
    let body = |mesh: &Mesh, attributes: &[Attribute]| {
        let format = decode_format(format)?;
        let callback = write.ok_or_else(|| null_argument("write"))?;
        let send = |bytes: &[u8]| {
            // SAFETY: the caller's function, with the caller's `user_data`.
            caller.run(|| unsafe { callback(bytes.as_ptr().cast(), bytes.len(), user_data) })
        };
        write_through(send, |out| io::write_with(mesh, attributes, format, out))
    };
    // SAFETY: the caller's promises are those of `with_selected`.
    unsafe { with_selected(mesh, selection, format, body) }
}

/// Runs `body` on the mesh of a selection, with the attributes at its vertices.
///
/// # Safety
/// `mesh` is NULL or a live handle, `selection` NULL or as long as its `struct_size` says.
unsafe fn with_selected(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    format: MaybeUninit<Format>,
    body: impl FnOnce(&Mesh, &[Attribute]) -> Result<()>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let selection = read_selection(selection)?;
            if selection == Selection::default() {
                return body(mesh, prepared.vertex_attributes(mesh)?);
            }
            if decode_format(format)? == Format::DomainsJson {
                let rule = "format is NM_FORMAT_DOMAINS_JSON, which takes no selection";
                return Err(Error::invalid(rule));
            }
            result(mesh)?;
            let attributes = prepared.vertex_attributes(mesh)?;
            let part = prepared.part(mesh, &selection)?;
            let markers = copied(mesh.markers_of_result())?;
            let of_facets = copied(&mesh.facets_of_result().markers)?;
            let (mesh, attributes) = part.to_mesh(mesh.inputs(), attributes)?;
            body(&mesh.with_markers(markers).with_facet_markers(of_facets), &attributes)
        })
    }
}

/// Runs `export` on a buffered writer whose bytes go to `send`; nonzero stops it for good.
fn write_through(
    send: impl FnMut(&[u8]) -> i32,
    export: impl FnOnce(&mut dyn Write) -> Result<()>,
) -> Result<()> {
    let mut out = Buffered::new(CHUNK, CallbackWriter { send, stopped: 0 })?;
    let mut exported = export(&mut out);
    if exported.is_ok() {
        let flushed = out.flush();
        exported = flushed.map_err(|error| Error::new(ErrorKind::Io, message!("{error}")));
    }
    match out.into_inner().stopped {
        0 => exported,
        answer => Err(Error::new(ErrorKind::Io, stop_message(answer))),
    }
}

fn stop_message(answer: i32) -> String {
    message!("write answered {answer}, which stops the export")
}

/// Hands bytes to a callback until it answers nonzero.
struct CallbackWriter<F> {
    send: F,
    stopped: i32,
}

impl<F: FnMut(&[u8]) -> i32> Write for CallbackWriter<F> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.stopped == 0 && !bytes.is_empty() {
            self.stopped = (self.send)(bytes);
        }
        match self.stopped {
            0 => Ok(bytes.len()),
            _ => Err(std::io::ErrorKind::Other.into()),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{from_c, last_message, square};
    use std::ptr::null_mut;

    fn failure() -> Error {
        Error::new(ErrorKind::State, "the export's own")
    }

    fn io_error(error: std::io::Error) -> Error {
        Error::new(ErrorKind::Io, error.to_string())
    }

    #[test]
    fn every_byte_arrives_in_order_and_in_chunks() {
        // Made and cut in few steps, for Miri's sake; 251 has no factor in common with a chunk.
        let bytes = std::array::from_fn::<u8, 251, _>(|i| i as u8).repeat(1200);
        let (mut received, mut calls) = (Vec::new(), 0);
        let send = |chunk: &[u8]| {
            assert!(!chunk.is_empty());
            received.extend_from_slice(chunk);
            calls += 1;
            0
        };
        write_through(send, |out| {
            bytes.chunks(701).try_for_each(|chunk| out.write_all(chunk)).map_err(io_error)
        })
        .unwrap();
        assert!(received == bytes);
        assert!((5..=6).contains(&calls), "{calls}");
    }

    #[test]
    fn a_nonzero_answer_stops_for_good() {
        for swallowed in [false, true] {
            let mut calls = 0;
            let send = |_: &[u8]| {
                calls += 1;
                if calls == 2 { -7 } else { 0 }
            };
            let export = |out: &mut dyn Write| {
                let mut result = Ok(());
                for _ in 0..10 {
                    result = out.write_all(&[1; CHUNK]).map_err(io_error);
                }
                if swallowed { Ok(()) } else { result }
            };
            let error = write_through(send, export).unwrap_err();
            assert_eq!((error.kind(), calls), (ErrorKind::Io, 2));
            assert_eq!(error.message(), "write answered -7, which stops the export");
        }
    }

    #[test]
    fn the_last_chunk_may_stop_too() {
        let error = write_through(|_| 1, |out| out.write_all(b"x").map_err(io_error));
        assert_eq!(error.unwrap_err().kind(), ErrorKind::Io);
    }

    #[test]
    fn after_a_failed_export_nothing_more_is_sent() {
        let mut calls = 0;
        let send = |_: &[u8]| {
            calls += 1;
            0
        };
        let error = write_through(send, |out| {
            out.write_all(b"half").map_err(io_error)?;
            Err(failure())
        });
        assert_eq!((error.unwrap_err(), calls), (failure(), 0));
    }

    #[test]
    fn arguments_are_checked() {
        unsafe extern "C" fn accept(_: *const c_void, _: usize, _: *mut c_void) -> i32 {
            0
        }
        let mesh = square();
        let vtu = || from_c(1);
        // SAFETY: a live handle or NULL, C strings or NULL.
        unsafe {
            let null_path = nm_export(&mesh, null(), vtu());
            assert_eq!(null_path, nm_status::NM_NULL_ARGUMENT);
            assert_eq!(last_message(), "path_utf8 is NULL");
            let null_mesh = nm_export(null(), c"mesh.vtu".as_ptr(), vtu());
            assert_eq!(null_mesh, nm_status::NM_NULL_ARGUMENT);
            let format = nm_export(&mesh, c"mesh.vtu".as_ptr(), from_c(20));
            assert_eq!(format, nm_status::NM_INVALID_ARGUMENT);
            assert!(last_message().starts_with("format is 20;"));
            let null_write = nm_export_write(&mesh, vtu(), None, null_mut());
            assert_eq!(null_write, nm_status::NM_NULL_ARGUMENT);
            assert_eq!(last_message(), "write is NULL");
            let format = nm_export_write(&mesh, from_c(-1), Some(accept), null_mut());
            assert_eq!(format, nm_status::NM_INVALID_ARGUMENT);
        }
    }
}
