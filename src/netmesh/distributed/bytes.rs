//! Pieces as bytes, to be sent. All numbers are written with the least byte first.

use crate::error::{Error, ErrorKind, Result};
use crate::memory::{AllocResult, TryGrow, with_capacity};
use crate::netmesh::distributed::piece::{NamedDomain, NamedVertex, Piece};

/// A value that can be sent.
trait Sent: Sized {
    fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()>;
    fn read(bytes: &mut Bytes<'_>) -> Result<Self>;
}

/// Bytes that are left to read.
struct Bytes<'a>(&'a [u8]);

fn torn() -> Error {
    Error::new(ErrorKind::InvalidArgument, "the bytes of a piece of a mesh are not complete")
}

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let (first, rest) = self.0.split_at_checked(count).ok_or_else(torn)?;
        self.0 = rest;
        Ok(first)
    }
}

macro_rules! sent_number {
    ($number:ty) => {
        impl Sent for $number {
            fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()> {
                bytes.try_extend(&self.to_le_bytes())
            }

            fn read(bytes: &mut Bytes<'_>) -> Result<Self> {
                let own = bytes.take(size_of::<Self>())?;
                Ok(Self::from_le_bytes(own.try_into().map_err(|_| torn())?))
            }
        }
    };
}

sent_number!(u32);

sent_number!(u64);

sent_number!(f64);

impl Sent for bool {
    fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()> {
        bytes.try_push(u8::from(*self))
    }

    fn read(bytes: &mut Bytes<'_>) -> Result<Self> {
        Ok(bytes.take(1)?[0] != 0)
    }
}

impl<T: Sent + Clone + Default, const N: usize> Sent for [T; N] {
    fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()> {
        self.iter().try_for_each(|value| value.write(bytes))
    }

    fn read(bytes: &mut Bytes<'_>) -> Result<Self> {
        let mut values = std::array::from_fn(|_| T::default());
        for value in &mut values {
            *value = T::read(bytes)?;
        }
        Ok(values)
    }
}

impl<T: Sent> Sent for Vec<T> {
    fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()> {
        (self.len() as u64).write(bytes)?;
        self.iter().try_for_each(|value| value.write(bytes))
    }

    fn read(bytes: &mut Bytes<'_>) -> Result<Self> {
        let count = u64::read(bytes)? as usize;
        // No value takes less than a byte.
        if count > bytes.0.len() {
            return Err(torn());
        }
        let mut values = with_capacity(count)?;
        for _ in 0..count {
            values.push(T::read(bytes)?);
        }
        Ok(values)
    }
}

/// A struct is sent field by field.
macro_rules! sent_fields {
    ($name:ident $(<const $dimension:ident>)?, $($field:ident),+) => {
        impl $(<const $dimension: usize>)? Sent for $name $(<$dimension>)? {
            fn write(&self, bytes: &mut Vec<u8>) -> AllocResult<()> {
                $(self.$field.write(bytes)?;)+
                Ok(())
            }

            fn read(bytes: &mut Bytes<'_>) -> Result<Self> {
                Ok(Self { $($field: Sent::read(bytes)?),+ })
            }
        }
    };
}

sent_fields!(
    NamedVertex<const D>, name, point, nearest, domain, cage, is_precision_limited
);

sent_fields!(NamedDomain<const D>, name, parent, point, radius, outside, center, cage, version);

sent_fields!(
    Piece<const D>,
    vertices,
    waiting,
    simplices,
    neighbors,
    is_unsettled,
    domains,
    released,
    outer,
    encroaching,
    wanted,
    nearer,
    maker
);

impl<const D: usize> Piece<D> {
    /// Returns the piece as bytes.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.write(&mut bytes)?;
        Ok(bytes)
    }

    /// Returns the piece that [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// `InvalidArgument` if they are not all the bytes of a piece; `OutOfMemory`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let mut bytes = Bytes(bytes);
        let piece = Self::read(&mut bytes)?;
        match bytes.0.is_empty() && piece.is_consistent() {
            true => Ok(piece),
            false => Err(torn()),
        }
    }

    /// Returns true if every id names something that the piece has.
    fn is_consistent(&self) -> bool {
        let count = self.simplex_count();
        let is_vertex = |&id: &u32| id == u32::MAX || (id as usize) < self.vertices.len();
        self.simplices.len() == count * Self::PER_SIMPLEX
            && self.neighbors.len() == self.simplices.len()
            && self.waiting.len() <= self.vertices.len()
            && self.neighbors.iter().chain(&self.waiting).all(|&id| (id as usize) < count)
            && self.simplices.iter().all(is_vertex)
    }
}
