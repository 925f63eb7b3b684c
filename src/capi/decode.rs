//! Enums from C: any 32 bits, of which some are a value. A parameter or field that C fills is a
//! `MaybeUninit` of its enum (cbindgen writes the enum itself).

use super::enums::{
    nm_algorithm, nm_criterion, nm_crossings, nm_extent, nm_filtration, nm_format, nm_gives_way,
    nm_interior, nm_interpolation, nm_measure, nm_ordering, nm_output,
};
use crate::arrays::Extent;
use crate::error::{Error, ErrorKind, Result, message};
use crate::io::Format;
use crate::options::{
    self, Algorithm, Criterion, Crossings, GivesWay, Interior, NetOrdering, Output,
};
use crate::quality::Measure;
use crate::query::{Interpolation, Method, Outside};
use std::mem::MaybeUninit;

/// The format that C asks for in argument `format`.
pub(super) fn decode_format(raw: MaybeUninit<nm_format>) -> Result<Format> {
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
        Format::GeoJson,
        Format::Wkt,
    ];
    decode("format", raw, formats)
}

pub(super) fn decode_output(raw: MaybeUninit<nm_output>) -> Result<Output> {
    decode("options.output", raw, [Output::Auto, Output::Hierarchical, Output::WellSpaced])
}

pub(super) fn decode_algorithm(raw: MaybeUninit<nm_algorithm>) -> Result<Algorithm> {
    let algorithms = [Algorithm::Netmesh, Algorithm::Svr, Algorithm::Delaunay];
    decode("options.algorithm", raw, algorithms)
}

pub(super) fn decode_ordering(raw: MaybeUninit<nm_ordering>) -> Result<NetOrdering> {
    let orderings = [NetOrdering::SampledNet, NetOrdering::DeterministicNet];
    decode("options.ordering", raw, orderings)
}

pub(super) fn decode_criterion(raw: MaybeUninit<nm_criterion>) -> Result<Criterion> {
    decode("options.criterion", raw, [Criterion::VoronoiAspect, Criterion::RadiusEdge])
}

pub(super) fn decode_gives_way(raw: MaybeUninit<nm_gives_way>) -> Result<GivesWay> {
    decode("options.gives_way", raw, [GivesWay::Angle, GivesWay::Bound])
}

pub(super) fn decode_measure(raw: MaybeUninit<nm_measure>) -> Result<Measure> {
    let measures =
        [Measure::DihedralAngle, Measure::RadiusEdge, Measure::Aspect, Measure::SmallestAngle];
    decode("measure", raw, measures)
}

pub(super) fn decode_extent(argument: &str, raw: MaybeUninit<nm_extent>) -> Result<Extent> {
    // NM_EXTENT_AUTO is NM_EXTENT_ALL here.
    decode(argument, raw, [Extent::All, Extent::All, Extent::Hull, Extent::Box])
}

/// That of a run.
pub(super) fn decode_run_extent(raw: MaybeUninit<nm_extent>) -> Result<options::Extent> {
    use options::Extent::{All, Auto, Boundary, Box, Hull};
    decode("options.extent", raw, [Auto, All, Hull, Box, Boundary])
}

pub(super) fn decode_crossings(raw: MaybeUninit<nm_crossings>) -> Result<Crossings> {
    decode("options.crossings", raw, [Crossings::Refuse, Crossings::Split])
}

pub(super) fn decode_interior(raw: MaybeUninit<nm_interior>) -> Result<Interior> {
    use Interior::{Auto, Parity, Seeds, Winding};
    decode("options.interior", raw, [Auto, Seeds, Parity, Winding])
}

/// Whether it is [`nm_filtration::NM_FILTRATION_MESH`].
pub(super) fn decode_filtration(raw: MaybeUninit<nm_filtration>) -> Result<bool> {
    decode("filtration", raw, [false, true])
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
            let message = message!(
                "interpolation is {value}; it must be one of nm_interpolation, 0 to 2 or 16 to 18"
            );
            Error::new(ErrorKind::InvalidArgument, message)
        })
}

/// `by_value[raw]`, or `InvalidArgument` naming the field, the value and the range.
fn decode<E, T: Copy, const N: usize>(
    field: &str,
    raw: MaybeUninit<E>,
    by_value: [T; N],
) -> Result<T> {
    let value = bits(raw);
    usize::try_from(value).ok().and_then(|index| by_value.get(index)).copied().ok_or_else(|| {
        let last = N - 1;
        let kind = std::any::type_name::<E>().rsplit("::").next().unwrap_or_default();
        let message = message!("{field} is {value}; it must be one of {kind}, 0 to {last}");
        Error::new(ErrorKind::InvalidArgument, message)
    })
}

/// The 32 bits that C passed for an enum.
pub(super) fn bits<E>(raw: MaybeUninit<E>) -> i32 {
    const { assert!(size_of::<E>() == size_of::<i32>()) };
    // SAFETY: the sizes agree, and C always passes four initialised bytes; any are a valid i32.
    unsafe { std::mem::transmute_copy(&raw) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::enums::{nm_phase, nm_status, vertex_kind_byte};
    use crate::capi::test_support::from_c;
    use crate::mesh::VertexKind;
    use crate::options::Phase;

    #[test]
    fn values_are_those_of_the_rust_enums() {
        for value in 0..=11 {
            assert_eq!(decode_format(from_c(value)).unwrap() as i32, value);
        }
        for value in 0..=1 {
            assert_eq!(decode_ordering(from_c(value)).unwrap() as i32, value);
            assert_eq!(decode_criterion(from_c(value)).unwrap() as i32, value);
            assert_eq!(decode_gives_way(from_c(value)).unwrap() as i32, value);
            assert_eq!(decode_crossings(from_c(value)).unwrap() as i32, value);
        }
        for value in 0..=2 {
            assert_eq!(decode_output(from_c(value)).unwrap() as i32, value);
            assert_eq!(decode_algorithm(from_c(value)).unwrap() as i32, value);
        }
        for value in 0..=3 {
            assert_eq!(decode_measure(from_c(value)).unwrap() as i32, value);
            assert_eq!(decode_interior(from_c(value)).unwrap() as i32, value);
        }
        for value in 0..=4 {
            assert_eq!(decode_run_extent(from_c(value)).unwrap() as i32, value);
        }
        assert!(decode_extent("extent", from_c(4)).is_err());
        let extents = [0, 1, 2, 3].map(|value| decode_extent("extent", from_c(value)).unwrap());
        assert_eq!(extents, [Extent::All, Extent::All, Extent::Hull, Extent::Box]);
        for kind in [VertexKind::Input, VertexKind::Steiner, VertexKind::Cage] {
            assert_eq!(vertex_kind_byte(kind), kind as u8);
        }
        for phase in [Phase::Prepare, Phase::Insert, Phase::Finish, Phase::Export] {
            assert_eq!(nm_phase::from(phase) as u32, phase as u32);
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
        for value in [-1, 15, i32::MIN, i32::MAX] {
            let error = decode_format(from_c(value)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            assert_eq!(
                error.message(),
                format!("format is {value}; it must be one of nm_format, 0 to 14")
            );
        }
        let error = decode_algorithm(from_c(3)).unwrap_err();
        assert_eq!(
            error.message(),
            "options.algorithm is 3; it must be one of nm_algorithm, 0 to 2"
        );
    }
}
