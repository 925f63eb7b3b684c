//! Enums from C: any 32 bits, of which some are a value. A parameter or field that C fills is a
//! `MaybeUninit` of its enum (cbindgen writes the enum itself).

use super::enums::{nm_filtration, nm_interpolation, nm_surface_kind};
use crate::arrays::SelectionExtent;
use crate::error::{Error, Result, message};
use crate::io::Format;
use crate::options;
use crate::quality::Measure;
use crate::query::{Interpolation, Method, Outside};
use crate::surface::SurfaceKind;
use std::fmt::Display;
use std::mem::MaybeUninit;

/// Returns the format that C asks for in argument `format`.
pub(super) fn decode_format(raw: MaybeUninit<Format>) -> Result<Format> {
    let formats = [
        Format::Auto,
        Format::Vtu,
        Format::TetgenNode,
        Format::Gmsh,
        Format::Medit,
        Format::Off,
        Format::Ply,
        Format::Xyz,
        Format::Csv,
        Format::Npy,
        Format::VoronoiJson,
        Format::DomainsJson,
        Format::Poly,
        Format::Geojson,
        Format::Wkt,
        Format::Smesh,
        Format::Stl,
        Format::Obj,
        Format::Svg,
        Format::Html,
    ];
    decode("format", "nm_format", raw, formats)
}

/// Returns the measure that C asks for in argument `measure`.
pub(super) fn decode_measure(raw: MaybeUninit<Measure>) -> Result<Measure> {
    let measures =
        [Measure::DihedralAngle, Measure::RadiusEdge, Measure::Aspect, Measure::SmallestAngle];
    decode("measure", "nm_measure", raw, measures)
}

/// Returns the extent of a selection, where NM_EXTENT_AUTO is NM_EXTENT_ALL.
pub(super) fn decode_extent(
    argument: &str,
    raw: MaybeUninit<options::Extent>,
) -> Result<SelectionExtent> {
    decode(
        argument,
        "nm_extent",
        raw,
        [SelectionExtent::All, SelectionExtent::All, SelectionExtent::Hull, SelectionExtent::Box],
    )
}

/// Returns true for [`nm_filtration::NM_FILTRATION_MESH`].
pub(super) fn decode_filtration(raw: MaybeUninit<nm_filtration>) -> Result<bool> {
    decode("filtration", "nm_filtration", raw, [false, true])
}

pub(super) fn decode_surface(raw: MaybeUninit<nm_surface_kind>) -> Result<SurfaceKind> {
    decode("kind", "nm_surface_kind", raw, [SurfaceKind::Closed, SurfaceKind::Open])
}

pub(super) fn decode_interpolation(raw: MaybeUninit<nm_interpolation>) -> Result<Method> {
    let value = bits(raw);
    let interpolation = match value & 15 {
        0 => Some(Interpolation::Linear),
        1 => Some(Interpolation::Sibson),
        2 => Some(Interpolation::Laplace),
        _ => None,
    };
    let outside = match value >> 4 {
        0 => Some(Outside::Nan),
        1 => Some(Outside::Nearest),
        _ => None,
    };
    interpolation
        .zip(outside)
        .map(|(interpolation, outside)| Method { interpolation, outside })
        .ok_or_else(|| {
            Error::invalid(message!(
                "interpolation is {value}; it must be one of nm_interpolation, 0 to 2 or 16 to 18"
            ))
        })
}

/// Returns `by_value[raw]`, or `InvalidArgument` naming the field, the value and the range.
pub(super) fn decode<E, T: Copy>(
    field: impl Display,
    kind: impl Display,
    raw: MaybeUninit<E>,
    by_value: impl AsRef<[T]>,
) -> Result<T> {
    let (value, by_value) = (bits(raw), by_value.as_ref());
    usize::try_from(value).ok().and_then(|index| by_value.get(index)).copied().ok_or_else(|| {
        let last = by_value.len() - 1;
        Error::invalid(message!("{field} is {value}; it must be one of {kind}, 0 to {last}"))
    })
}

/// Returns the 32 bits that C passed for an enum.
pub(super) fn bits<E>(raw: MaybeUninit<E>) -> i32 {
    const { assert!(size_of::<E>() == size_of::<i32>()) };
    // SAFETY: the sizes agree, and C always passes four initialised bytes; any are a valid i32.
    unsafe { std::mem::transmute_copy(&raw) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::enums::{nm_status, vertex_kind_byte};
    use crate::capi::test_support::from_c;
    use crate::error::ErrorKind;
    use crate::mesh::VertexKind;

    #[test]
    fn values_are_those_of_the_rust_enums() {
        for value in 0..=11 {
            assert_eq!(decode_format(from_c(value)).unwrap() as i32, value);
        }
        for value in 0..=3 {
            assert_eq!(decode_measure(from_c(value)).unwrap() as i32, value);
        }
        assert!(decode_extent("extent", from_c(4)).is_err());
        let extents = [0, 1, 2, 3].map(|value| decode_extent("extent", from_c(value)).unwrap());
        assert_eq!(
            extents,
            [
                SelectionExtent::All,
                SelectionExtent::All,
                SelectionExtent::Hull,
                SelectionExtent::Box
            ]
        );
        for kind in [VertexKind::Input, VertexKind::Steiner, VertexKind::Cage] {
            assert_eq!(vertex_kind_byte(kind), kind as u8);
        }
    }

    #[test]
    fn statuses_have_the_kinds_values() {
        let kinds = [
            ErrorKind::NullArgument,
            ErrorKind::InvalidArgument,
            ErrorKind::NonFinite,
            ErrorKind::Dimension,
            ErrorKind::Capacity,
            ErrorKind::DegenerateInput,
            ErrorKind::Limit,
            ErrorKind::Cancelled,
            ErrorKind::Io,
            ErrorKind::Format,
            ErrorKind::State,
            ErrorKind::OutOfMemory,
            ErrorKind::Panic,
        ];
        for (kind, value) in kinds.into_iter().zip(1..) {
            assert_eq!(kind as i32, value);
            assert_eq!(nm_status::from(kind) as i32, value);
        }
    }

    #[test]
    fn unknown_values_name_the_field_and_the_value() {
        for value in [-1, 20, i32::MIN, i32::MAX] {
            let error = decode_format(from_c(value)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            assert_eq!(
                error.message(),
                format!("format is {value}; it must be one of nm_format, 0 to 19")
            );
        }
    }
}
