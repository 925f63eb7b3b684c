//! Arguments as C passes them: any bits for an enum, any `struct_size`.

use super::super::bytes::Bytes;
use std::mem::MaybeUninit;

/// Number of bytes of the largest struct that is accepted.
pub const ROOM: usize = 4096;

/// Returns `value` as C passes it for an enum, known to the enum or not.
pub fn from_c<E>(value: i32) -> MaybeUninit<E> {
    const { assert!(size_of::<E>() == size_of::<i32>()) };
    // SAFETY: the sizes agree and any bits are a valid MaybeUninit.
    unsafe { std::mem::transmute_copy(&value) }
}

/// Returns a `struct_size`: mostly that of the struct, else any.
pub fn struct_size<T>(bytes: &mut Bytes<'_>) -> u32 {
    match bytes.below(8) {
        0..=4 => size_of::<T>() as u32,
        5 => u32::from(bytes.byte()),
        6 => u32::from(bytes.byte()) * 32,
        _ => bytes.word() as u32,
    }
}

/// Memory of the caller for a struct: `struct_size` first, then the rest, aligned as in C.
#[repr(C, align(16))]
pub struct Room(pub [u8; ROOM]);

impl Room {
    pub fn filled(byte: u8, struct_size: u32) -> Box<Self> {
        let mut room = Box::new(Self([byte; ROOM]));
        room.0[..4].copy_from_slice(&struct_size.to_ne_bytes());
        room
    }

    pub fn pointer<T>(&mut self) -> *mut T {
        self.0.as_mut_ptr().cast()
    }
}
