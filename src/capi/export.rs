//! Writing meshes to files and to callbacks.

use super::enums::{decode_format, nm_format, nm_status};
use super::error::null_argument;
use super::handle::{nm_mesh, with_mesh};
use super::memory::utf8_path;
use crate::error::{Error, ErrorKind, Result};
use crate::io;
use crate::mesh::Mesh;
use std::ffi::{c_char, c_void};
use std::io::{BufWriter, Write};
use std::mem::MaybeUninit;

/// The most bytes that a write callback gets at once is about this.
const CHUNK: usize = 1 << 16;

/// Receives an export from nm_export_write, piece by piece and in order, on the thread that called.
/// data: size bytes, at least 1, valid during the call. user_data: as given. Nonzero stops the
/// export, which then answers NM_IO and does not call again.
///
/// It must return: no exception, longjmp or thread exit may leave it. It may read the mesh; nm_run on
/// it answers NM_STATE, and it must not be freed.
#[allow(non_camel_case_types)]
pub type nm_write_fn =
    Option<unsafe extern "C" fn(data: *const c_void, size: usize, user_data: *mut c_void) -> i32>;

/// Writes the mesh to a file, replacing what was there. The file is written under another name and
/// then renamed: after a failure there is no half of one.
///
/// path_utf8: UTF-8 on every system. format: NM_FORMAT_AUTO goes by the extension.
///
/// Errors: NM_NULL_ARGUMENT (mesh, path_utf8), NM_INVALID_ARGUMENT (path_utf8 empty or not UTF-8, an
/// unknown format or extension, a format that cannot hold the mesh), NM_STATE (a mesh format before
/// nm_run; nm_run at work, poisoned), NM_IO (the message has the system's reason).
///
/// O(vertices + simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export(
    mesh: *const nm_mesh,
    path_utf8: *const c_char,
    format: MaybeUninit<nm_format>,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or a C string.
        let path = unsafe { utf8_path(path_utf8)? };
        io::write_file(mesh, path, decode_format(format)?)
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Writes the mesh to a callback instead of a file; for NM_FORMAT_TETGEN_NODE the .node part, then
/// the .ele part. After a failure the callback may have received a part.
///
/// format: not NM_FORMAT_AUTO. write: must not be NULL. user_data: handed to write, may be NULL.
///
/// Errors: NM_NULL_ARGUMENT (mesh, write), NM_INVALID_ARGUMENT (format), NM_STATE (a mesh format
/// before nm_run; nm_run at work, poisoned), NM_IO (write answered nonzero; the message has the
/// value).
///
/// O(vertices + simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_write(
    mesh: *const nm_mesh,
    format: MaybeUninit<nm_format>,
    write: nm_write_fn,
    user_data: *mut c_void,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let format = decode_format(format)?;
        let callback = write.ok_or_else(|| null_argument("write"))?;
        let send = |bytes: &[u8]| {
            // SAFETY: the caller's function, with the caller's `user_data`.
            unsafe { callback(bytes.as_ptr().cast(), bytes.len(), user_data) }
        };
        write_through(send, |out| io::write(mesh, format, out))
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Runs `export` on a buffered writer whose bytes go to `send`; nonzero stops it for good.
fn write_through(
    send: impl FnMut(&[u8]) -> i32,
    export: impl FnOnce(&mut dyn Write) -> Result<()>,
) -> Result<()> {
    let mut out = BufWriter::with_capacity(CHUNK, CallbackWriter { send, stopped: 0 });
    let mut exported = export(&mut out);
    if exported.is_ok() {
        let flushed = out.flush();
        exported = flushed.map_err(|error| Error::new(ErrorKind::Io, error.to_string()));
    }
    // Taken apart, the buffer is not flushed once more when it is dropped.
    let (writer, _) = out.into_parts();
    match writer.stopped {
        0 => exported,
        answer => Err(Error::new(ErrorKind::Io, stop_message(answer))),
    }
}

fn stop_message(answer: i32) -> String {
    format!("write answered {answer}, which stops the export")
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
            answer => Err(std::io::Error::other(stop_message(answer))),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
