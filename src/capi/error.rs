//! The calling thread's last message.

use super::enums::nm_status;
use super::words::InC;
use crate::error::{Error, ErrorKind, message};
use std::any::Any;
use std::cell::RefCell;
use std::ffi::c_char;
use std::fmt::{self, Display, Write};

/// The longest message that is kept.
const MESSAGE_BYTES: usize = 2047;

/// A message in place. It needs no allocation and no destructor, whose registration would
/// allocate: there may be no memory to say so with.
struct LastMessage {
    bytes: [u8; MESSAGE_BYTES],
    length: usize,
}

impl LastMessage {
    fn text(&self) -> &str {
        std::str::from_utf8(&self.bytes[..self.length]).unwrap_or("")
    }

    /// Keeps `text`, cut between characters if need be, with its NULs made visible.
    fn set(&mut self, text: impl Display) {
        self.length = 0;
        // What does not fit is left out, which is no error.
        let _ = write!(self, "{text}");
    }

    fn append(&mut self, piece: &str) {
        let kept = prefix(piece, MESSAGE_BYTES - self.length);
        self.bytes[self.length..][..kept.len()].copy_from_slice(kept.as_bytes());
        self.length += kept.len();
    }
}

impl Write for LastMessage {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for (i, piece) in text.split('\0').enumerate() {
            if i > 0 {
                self.append("\\0");
            }
            self.append(piece);
        }
        Ok(())
    }
}

thread_local! {
    static LAST_MESSAGE: RefCell<LastMessage> =
        const { RefCell::new(LastMessage { bytes: [0; MESSAGE_BYTES], length: 0 }) };
}

/// Keeps the message for this thread and answers the status.
pub(super) fn fail(error: &Error) -> nm_status {
    // A thread that is being torn down has lost its storage: the status must do.
    let _ = LAST_MESSAGE.try_with(|last| {
        last.borrow_mut().set(error.in_words(InC));
    });
    error.kind().into()
}

pub fn null_argument(name: impl Display) -> Error {
    Error::new(ErrorKind::NullArgument, message!("{name} is NULL"))
}

/// Returns a caught panic as an error.
pub(super) fn panicked(payload: &(dyn Any + Send)) -> Error {
    let reason = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no reason given");
    Error::new(ErrorKind::Panic, message!("internal error: {reason}; please report it"))
}

/// Returns the longest prefix of `text` of at most `limit` bytes that ends between characters.
pub(super) fn prefix(text: &str, limit: usize) -> &str {
    let mut end = limit.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

/// Copies the calling thread's last message into buf: one sentence about the last call on this
/// thread that did not answer NM_OK, in UTF-8, "" if there was none. Successful calls leave it.
///
/// buf: room for cap bytes, or NULL. At most cap bytes are written, the last one a NUL; a message
/// that does not fit is cut between characters. NULL or cap 0 writes nothing.
///
/// Returns the size in bytes of the whole message with its NUL (at least 1). Cannot fail. O(size);
/// each thread has its own message.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_last_error(buf: *mut c_char, cap: usize) -> usize {
    let size = LAST_MESSAGE.try_with(|last| {
        let last = last.borrow();
        if !buf.is_null() && cap > 0 {
            let shown = prefix(last.text(), cap - 1);
            // SAFETY: the caller gave `cap` writable bytes and `shown` has at most `cap - 1`.
            unsafe {
                buf.cast::<u8>().copy_from_nonoverlapping(shown.as_ptr(), shown.len());
                buf.add(shown.len()).write(0);
            }
        }
        last.text().len() + 1
    });
    size.unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::last_message;

    #[test]
    fn each_thread_has_its_own_message() {
        fail(&Error::new(ErrorKind::Io, "mine"));
        std::thread::spawn(|| {
            assert_eq!(last_message(), "");
            fail(&Error::new(ErrorKind::Io, "theirs"));
            assert_eq!(last_message(), "theirs");
        })
        .join()
        .unwrap();
        assert_eq!(last_message(), "mine");
    }

    #[test]
    fn a_short_buffer_gets_a_prefix_of_whole_characters() {
        assert_eq!(fail(&Error::new(ErrorKind::Limit, "aé\0b")), nm_status::NM_LIMIT);
        let mut buf = [b'#' as c_char; 8];
        // SAFETY: the buffer has as many bytes as is said.
        let sizes =
            unsafe { [nm_last_error(std::ptr::null_mut(), 9), nm_last_error(buf.as_mut_ptr(), 0)] };
        assert_eq!((sizes, buf), ([7, 7], [b'#' as c_char; 8]), "a é \\ 0 b and the NUL");
        // SAFETY: as above.
        assert_eq!(unsafe { nm_last_error(buf.as_mut_ptr(), 3) }, 7);
        let bytes = buf.map(|byte| byte as u8);
        assert_eq!(&bytes, b"a\0######", "é needs two bytes beside the NUL");
        // SAFETY: as above.
        assert_eq!(unsafe { nm_last_error(buf.as_mut_ptr(), 7) }, 7);
        assert_eq!(last_message(), "aé\\0b");
        assert_eq!(buf.map(|byte| byte as u8)[6..], *b"\0#");
    }

    #[test]
    fn a_panics_reason_is_in_the_message() {
        let message = |payload: Box<dyn Any + Send>| panicked(&*payload).message().to_owned();
        assert!(message(Box::new("why")).contains("why"));
        assert!(message(Box::new(String::from("where"))).contains("where"));
        assert!(message(Box::new(3)).contains("no reason"));
    }
}
