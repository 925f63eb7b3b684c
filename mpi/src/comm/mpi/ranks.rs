//! The messages of MPI, by the C layer.

#![allow(unsafe_code)]
#![warn(clippy::undocumented_unsafe_blocks, unsafe_op_in_unsafe_fn)]

use super::super::{Operation, Transport};
use netmesh::distributed::memory::{collected, filled};
use netmesh::{Error, ErrorKind, Result};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr::null_mut;

/// The C layer's struct.
#[repr(C)]
pub(super) struct RawRanks {
    _private: [u8; 0],
}

/// A wait was ended by a failure elsewhere.
const INTERRUPTED: c_int = -1;
const NO_MEMORY: c_int = -2;
const NOT_RUNNING: c_int = -3;

/// The most bytes that MPI is given at once: its counts are 32-bit.
const CHUNK: u64 = 1 << 30;

unsafe extern "C" {
    fn netmesh_processor_seconds() -> f64;
    fn netmesh_ranks_open(of: *const c_void, opened: *mut *mut RawRanks) -> c_int;
    fn netmesh_ranks_open_world(opened: *mut *mut RawRanks) -> c_int;
    fn netmesh_ranks_close(ranks: *mut RawRanks);
    fn netmesh_ranks_rank(ranks: *const RawRanks) -> c_int;
    fn netmesh_ranks_size(ranks: *const RawRanks) -> c_int;
    fn netmesh_ranks_error(code: c_int, text: *mut c_char, capacity: c_int);
    fn netmesh_ranks_reduce(
        ranks: *mut RawRanks,
        values: *mut c_void,
        count: u64,
        are_doubles: c_int,
        operation: c_int,
    ) -> c_int;
    fn netmesh_ranks_broadcast(
        ranks: *mut RawRanks,
        root: c_int,
        bytes: *mut c_void,
        size: u64,
    ) -> c_int;
    fn netmesh_ranks_gather_integers(ranks: *mut RawRanks, value: u64, values: *mut u64) -> c_int;
    fn netmesh_ranks_exchange_integers(
        ranks: *mut RawRanks,
        values: *const u64,
        received: *mut u64,
    ) -> c_int;
    fn netmesh_ranks_gather(
        ranks: *mut RawRanks,
        bytes: *const c_void,
        gathered: *const *mut c_void,
        sizes: *const u64,
        chunk: u64,
    ) -> c_int;
    fn netmesh_ranks_exchange(
        ranks: *mut RawRanks,
        messages: *const *const c_void,
        sizes: *const u64,
        received: *const *mut c_void,
        received_sizes: *const u64,
        chunk: u64,
    ) -> c_int;
    fn netmesh_ranks_send(
        ranks: *mut RawRanks,
        to: c_int,
        tag: c_int,
        bytes: *const c_void,
        size: u64,
        chunk: u64,
    ) -> c_int;
    fn netmesh_ranks_receive_size(
        ranks: *mut RawRanks,
        from: c_int,
        tag: c_int,
        size: *mut u64,
    ) -> c_int;
    fn netmesh_ranks_receive(
        ranks: *mut RawRanks,
        from: c_int,
        tag: c_int,
        bytes: *mut c_void,
        size: u64,
        chunk: u64,
    ) -> c_int;
    fn netmesh_ranks_notify(ranks: *mut RawRanks);
    fn netmesh_mpi_begin() -> c_int;
    fn netmesh_mpi_end() -> c_int;
}

/// Begins MPI, for a program that has not done so.
pub fn begin() -> Result<()> {
    // SAFETY: no other thread calls MPI yet.
    checked("MPI_Init_thread", unsafe { netmesh_mpi_begin() })
}

/// Ends MPI. Collective; every [`Ranks`] is gone by then.
pub fn end() -> Result<()> {
    // SAFETY: `begin` was called.
    checked("MPI_Finalize", unsafe { netmesh_mpi_end() })
}

/// Returns the processor time of this thread, in seconds from some beginning.
pub fn processor_seconds() -> f64 {
    // SAFETY: no condition.
    unsafe { netmesh_processor_seconds() }
}

/// The ranks of a communicator of MPI, which talk apart from what else goes through that.
pub struct Ranks {
    raw: *mut RawRanks,
    rank: usize,
    size: usize,
    chunk: u64,
}

impl Ranks {
    /// Collective. Opens the ranks of the program.
    pub fn of_world() -> Result<Self> {
        let mut raw = null_mut();
        // SAFETY: the layer checks that MPI runs.
        let code = unsafe { netmesh_ranks_open_world(&raw mut raw) };
        Self::opened(code, raw)
    }

    /// Collective. Opens the ranks of the caller's communicator.
    ///
    /// # Safety
    /// `of` points to an `MPI_Comm` of the MPI that this was compiled with.
    pub unsafe fn of(of: *const c_void) -> Result<Self> {
        let mut raw = null_mut();
        // SAFETY: the caller's promise.
        let code = unsafe { netmesh_ranks_open(of, &raw mut raw) };
        Self::opened(code, raw)
    }

    fn opened(code: c_int, raw: *mut RawRanks) -> Result<Self> {
        checked("the communicator cannot be duplicated", code)?;
        // SAFETY: open, as there was no error.
        let (rank, size) = unsafe { (netmesh_ranks_rank(raw), netmesh_ranks_size(raw)) };
        Ok(Self { raw, rank: rank as usize, size: size as usize, chunk: CHUNK })
    }

    /// Splits messages into pieces of at most `chunk` bytes from now on, for tests.
    pub fn in_chunks_of(self, chunk: u32) -> Self {
        let mut ranks = self;
        ranks.chunk = u64::from(chunk).clamp(1, CHUNK);
        ranks
    }

    pub(super) fn raw(&self) -> *mut RawRanks {
        self.raw
    }

    fn rank_of(&self, rank: usize) -> Result<c_int> {
        if rank >= self.size {
            let message = format!("rank {rank} of {}: there is no such rank", self.size);
            return Err(Error::invalid(message));
        }
        Ok(rank as c_int)
    }
}

impl Drop for Ranks {
    fn drop(&mut self) {
        // SAFETY: open, and not used afterwards.
        unsafe { netmesh_ranks_close(self.raw) };
    }
}

/// Turns a code of MPI's into an error, if it is one.
pub(super) fn checked(what: &str, code: c_int) -> Result<()> {
    if code == 0 {
        return Ok(());
    }
    let mut text = [0 as c_char; 512];
    // SAFETY: as many bytes as is said.
    unsafe { netmesh_ranks_error(code, text.as_mut_ptr(), text.len() as c_int) };
    // SAFETY: the layer ends it with a NUL.
    let reason = unsafe { CStr::from_ptr(text.as_ptr()) }.to_string_lossy();
    let kind = match code {
        NO_MEMORY => ErrorKind::OutOfMemory,
        NOT_RUNNING => ErrorKind::State,
        _ => ErrorKind::Io,
    };
    Err(Error::new(kind, format!("{what}: {reason}")))
}

fn pointers(buffers: &mut [Vec<u8>]) -> Result<Vec<*mut c_void>> {
    Ok(collected(buffers.iter_mut().map(|buffer| buffer.as_mut_ptr().cast()))?)
}

fn sizes(buffers: &[Vec<u8>]) -> Result<Vec<u64>> {
    Ok(collected(buffers.iter().map(|buffer| buffer.len() as u64))?)
}

impl Transport for Ranks {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()> {
        let (pointer, count) = (values.as_mut_ptr().cast(), values.len() as u64);
        // SAFETY: so many values, of eight bytes each.
        let code = unsafe { netmesh_ranks_reduce(self.raw, pointer, count, 0, operation as c_int) };
        checked("MPI_Allreduce", code)
    }

    fn reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()> {
        let (pointer, count) = (values.as_mut_ptr().cast(), values.len() as u64);
        // SAFETY: as above.
        let code = unsafe { netmesh_ranks_reduce(self.raw, pointer, count, 1, operation as c_int) };
        checked("MPI_Allreduce", code)
    }

    fn broadcast(&self, root: usize, bytes: &mut [u8]) -> Result<()> {
        let (root, size) = (self.rank_of(root)?, bytes.len() as u64);
        // SAFETY: so many bytes.
        let code =
            unsafe { netmesh_ranks_broadcast(self.raw, root, bytes.as_mut_ptr().cast(), size) };
        checked("MPI_Bcast", code)
    }

    fn gather_integers(&self, value: u64, values: &mut [u64]) -> Result<()> {
        assert_eq!(values.len(), self.size, "a value for each rank");
        // SAFETY: room for the value of each rank.
        let code = unsafe { netmesh_ranks_gather_integers(self.raw, value, values.as_mut_ptr()) };
        checked("MPI_Allgather", code)
    }

    fn exchange_integers(&self, values: &[u64], received: &mut [u64]) -> Result<()> {
        assert_eq!([values.len(), received.len()], [self.size; 2], "a value for each rank");
        // SAFETY: a value of and for each rank.
        let code = unsafe {
            netmesh_ranks_exchange_integers(self.raw, values.as_ptr(), received.as_mut_ptr())
        };
        checked("MPI_Alltoall", code)
    }

    fn gather(&self, bytes: &[u8], gathered: &mut [Vec<u8>]) -> Result<()> {
        assert_eq!(gathered.len(), self.size, "a buffer for each rank");
        assert_eq!(gathered[self.rank].len(), bytes.len(), "the own buffer's size");
        let (sizes, buffers) = (sizes(gathered)?, pointers(gathered)?);
        let (bytes, buffers) = (bytes.as_ptr().cast(), buffers.as_ptr());
        // SAFETY: a buffer for each rank, as long as is said.
        let code =
            unsafe { netmesh_ranks_gather(self.raw, bytes, buffers, sizes.as_ptr(), self.chunk) };
        checked("MPI_Bcast", code)
    }

    fn exchange(&self, messages: &[Vec<u8>], received: &mut [Vec<u8>]) -> Result<()> {
        assert_eq!([messages.len(), received.len()], [self.size; 2], "a buffer for each rank");
        let out: Vec<*const c_void> =
            collected(messages.iter().map(|message| message.as_ptr().cast()))?;
        let (out_sizes, in_sizes, buffers) =
            (sizes(messages)?, sizes(received)?, pointers(received)?);
        // SAFETY: buffers of and for each rank, as long as is said.
        let code = unsafe {
            netmesh_ranks_exchange(
                self.raw,
                out.as_ptr(),
                out_sizes.as_ptr(),
                buffers.as_ptr(),
                in_sizes.as_ptr(),
                self.chunk,
            )
        };
        checked("MPI_Isend and MPI_Irecv", code)
    }

    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<bool> {
        let (to, tag, size) = (self.rank_of(to)?, c_int::from(tag), bytes.len() as u64);
        let pointer = bytes.as_ptr().cast();
        // SAFETY: so many bytes. Of a wait that was ended nothing reads them later: the next call
        // is a checkpoint, before which every message is either taken or never will be.
        match unsafe { netmesh_ranks_send(self.raw, to, tag, pointer, size, self.chunk) } {
            INTERRUPTED => Ok(false),
            code => checked("MPI_Isend", code).map(|()| true),
        }
    }

    fn receive(&self, from: usize, tag: u16) -> Result<Option<Vec<u8>>> {
        let (from, tag, mut size) = (self.rank_of(from)?, c_int::from(tag), 0);
        // SAFETY: one integer.
        match unsafe { netmesh_ranks_receive_size(self.raw, from, tag, &raw mut size) } {
            INTERRUPTED => return Ok(None),
            code => checked("MPI_Irecv", code)?,
        }
        let mut message = filled(size as usize, 0_u8)?;
        let pointer = message.as_mut_ptr().cast();
        // SAFETY: so many bytes.
        match unsafe { netmesh_ranks_receive(self.raw, from, tag, pointer, size, self.chunk) } {
            INTERRUPTED => Ok(None),
            code => checked("MPI_Irecv", code).map(|()| Some(message)),
        }
    }

    fn mpi(&self) -> Option<&Ranks> {
        Some(self)
    }

    fn notify(&self) {
        // SAFETY: open.
        unsafe { netmesh_ranks_notify(self.raw) };
    }
}
