//! Sequences of C API calls with good and bad arguments on a few handles. Every status must be the
//! documented one, and a call that fails must leave its mesh as it was.

mod arguments;
mod create;
mod export;
mod getters;
mod handle;
mod measures;
mod run;

use super::bytes::Bytes;
use handle::Handle;
use netmesh::capi::{nm_last_error, nm_status};

/// Number of handles that live at the same time.
const HANDLES: u8 = 3;

/// Largest number of calls in a sequence.
const CALLS: usize = 40;

/// Checks a sequence of calls: each takes a byte for its kind, one for its handle, and its
/// arguments.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let mut handles: [Option<Handle>; HANDLES as usize] = Default::default();
    for _ in 0..CALLS {
        if bytes.is_empty() {
            break;
        }
        let kind = bytes.below(12);
        let slot = &mut handles[bytes.below(HANDLES)];
        match kind {
            0 | 1 => create::create(&mut bytes, slot),
            2 => create::create_refused(&mut bytes),
            3 => create::create_from_file(&mut bytes),
            4 => *slot = None,
            5 | 6 => run::run(&mut bytes, slot.as_mut()),
            7 => run::options_init(&mut bytes),
            8 => getters::get(&mut bytes, slot.as_ref()),
            9 => measures::measure(&mut bytes, slot.as_ref()),
            10 => export::export_write(&mut bytes, slot.as_ref()),
            _ => export::export(&mut bytes, slot.as_ref()),
        }
    }
}

/// Asserts the status; a failure must have a message.
fn expect(status: nm_status, expected: nm_status) {
    assert_eq!(status, expected, "{}", last_error());
    if status != nm_status::NM_OK {
        assert!(!last_error().is_empty());
    }
}

/// Returns the last message of this thread.
fn last_error() -> String {
    // SAFETY: NULL asks for the size, and the buffer has it.
    unsafe {
        let size = nm_last_error(std::ptr::null_mut(), 0);
        let mut buffer = vec![0u8; size];
        assert_eq!(nm_last_error(buffer.as_mut_ptr().cast(), size), size);
        assert_eq!(buffer.pop(), Some(0));
        String::from_utf8(buffer).expect("messages are UTF-8")
    }
}
