//! Options, from C and to C.

use super::decode::{
    decode_algorithm, decode_criterion, decode_crossings, decode_gives_way, decode_interior,
    decode_ordering, decode_output, decode_run_extent,
};
use super::enums::nm_status;
use super::getters::result;
use super::handle::{barrier, nm_mesh, with_mesh};
use super::memory::OutStruct;
use super::structs::nm_options;
use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::Mesh;
use crate::options::Options;
use std::mem::MaybeUninit;
use std::ptr::null_mut;

/// Fills options with the defaults and sets its struct_size; bytes beyond this version's struct
/// become zero. Call it as nm_options_init(&options, sizeof options).
///
/// struct_size: the size of the caller's struct, 4..4096 bytes, not ending inside a field.
///
/// Errors: NM_NULL_ARGUMENT (options), NM_INVALID_ARGUMENT (struct_size). O(1); any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_options_init(options: *mut nm_options, struct_size: u32) -> nm_status {
    barrier(|| {
        // SAFETY: the caller gave NULL or `struct_size` writable bytes.
        let out = unsafe { OutStruct::with_size("options", options, struct_size)? };
        out.write(&encode(&Options::default()));
        out.write_size_and_clear_tail();
        Ok(())
    })
}

/// Writes the options that the last run had, with every default filled in: output and extent are
/// what the run made of NM_OUTPUT_AUTO and NM_EXTENT_AUTO, never these two themselves, and
/// interior is NM_INTERIOR_SEEDS where the extent became NM_EXTENT_ALL. In 2D with
/// NM_CRITERION_RADIUS_EDGE min_angle and quality_bound are both set, as one says what the other
/// does; segments make that the criterion. progress, size and what is handed to them are NULL.
/// O(1).
///
/// options: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, options), NM_INVALID_ARGUMENT (options->struct_size), NM_STATE
/// (no result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_options(
    mesh: *const nm_mesh,
    options: *mut nm_options,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("options", options)? };
        out.write(&encode(&result(mesh)?.parameters.options()));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// `options` as C sees them.
pub(super) fn encode(options: &Options) -> nm_options {
    nm_options {
        struct_size: size_of::<nm_options>() as u32,
        output: MaybeUninit::new(options.output.into()),
        algorithm: MaybeUninit::new(options.algorithm.into()),
        ordering: MaybeUninit::new(options.ordering.into()),
        criterion: MaybeUninit::new(options.criterion.into()),
        threads: options.threads,
        quality_bound: options.quality_bound,
        epsilon: options.epsilon,
        delta: options.delta,
        gamma: options.gamma,
        yield_radius: options.yield_radius,
        encroachment: options.encroachment,
        cage_scale: options.cage_scale,
        root_scale: options.root_scale,
        seed: options.seed,
        max_vertices: options.max_vertices,
        progress: None,
        user_data: null_mut(),
        instruments: u32::from(options.instruments),
        reserved: 0,
        distance_ratio: options.distance_ratio,
        min_angle: options.min_angle,
        min_dihedral: options.min_dihedral,
        max_edge: options.max_edge,
        size: None,
        size_user_data: null_mut(),
        gives_way: MaybeUninit::new(options.gives_way.into()),
        reserved_after_gives_way: 0,
        extent: MaybeUninit::new(options.extent.into()),
        crossings: MaybeUninit::new(options.crossings.into()),
        interior: MaybeUninit::new(options.interior.into()),
        reserved_after_interior: 0,
    }
}

/// What C asks for, enums checked; the ranges of the numbers are the core's business.
pub(super) fn decode(options: &nm_options) -> Result<Options> {
    Ok(Options {
        output: decode_output(options.output)?,
        algorithm: decode_algorithm(options.algorithm)?,
        ordering: decode_ordering(options.ordering)?,
        criterion: decode_criterion(options.criterion)?,
        threads: options.threads,
        quality_bound: options.quality_bound,
        epsilon: options.epsilon,
        delta: options.delta,
        gamma: options.gamma,
        yield_radius: options.yield_radius,
        encroachment: options.encroachment,
        cage_scale: options.cage_scale,
        root_scale: options.root_scale,
        seed: options.seed,
        max_vertices: options.max_vertices,
        instruments: decode_instruments(options)?,
        distance_ratio: options.distance_ratio,
        min_angle: options.min_angle,
        min_dihedral: options.min_dihedral,
        extent: decode_run_extent(options.extent)?,
        crossings: decode_crossings(options.crossings)?,
        max_edge: options.max_edge,
        gives_way: decode_gives_way(options.gives_way)?,
        interior: decode_interior(options.interior)?,
    })
}

/// The switch, and that the fields between others are not in use.
fn decode_instruments(options: &nm_options) -> Result<bool> {
    let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
    for (name, value) in [
        ("reserved", options.reserved),
        ("reserved_after_gives_way", options.reserved_after_gives_way),
        ("reserved_after_interior", options.reserved_after_interior),
    ] {
        if value != 0 {
            return refuse(message!("options.{name} is {value}; it must be 0"));
        }
    }
    match options.instruments {
        0 => Ok(false),
        1 => Ok(true),
        other => refuse(message!("options.instruments is {other}; it must be 0 or 1")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::memory::read_struct;
    use crate::capi::run::nm_run;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::options::{
        Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Output,
    };
    use std::mem::offset_of;

    const SIZE: usize = size_of::<nm_options>();

    fn init(bytes: &mut [u8; 256], struct_size: u32) -> nm_status {
        // SAFETY: the tests' sizes are at most the buffer's, or refused.
        unsafe { nm_options_init(bytes.as_mut_ptr().cast(), struct_size) }
    }

    /// What nm_run reads from a struct of these bytes.
    fn read(bytes: &[u8; 256]) -> nm_options {
        let defaults = encode(&Options { seed: 77, ..Options::default() });
        // SAFETY: the tests' sizes are at most the buffer's.
        unsafe { read_struct("options", bytes.as_ptr().cast(), defaults) }.unwrap()
    }

    #[test]
    fn options_survive_the_way_to_c_and_back() {
        let options = Options {
            output: Output::WellSpaced,
            algorithm: Algorithm::Delaunay,
            ordering: NetOrdering::DeterministicNet,
            criterion: Criterion::RadiusEdge,
            threads: 2,
            quality_bound: 3.0,
            epsilon: 4.0,
            delta: 5.0,
            gamma: 6.0,
            yield_radius: 7.0,
            encroachment: 8.0,
            cage_scale: 9.0,
            root_scale: 10.0,
            seed: 11,
            max_vertices: 12,
            instruments: true,
            distance_ratio: 13.0,
            min_angle: 14.0,
            min_dihedral: 15.0,
            extent: Extent::Boundary,
            crossings: Crossings::Split,
            max_edge: 16.0,
            gives_way: GivesWay::Bound,
            interior: Interior::Parity,
        };
        assert_eq!(decode(&encode(&options)).unwrap(), options);
        assert_eq!(decode(&encode(&Options::default())).unwrap(), Options::default());
        let named =
            Options { output: Output::Hierarchical, extent: Extent::All, ..options.clone() };
        assert_eq!(decode(&encode(&named)).unwrap(), named);
        let svr = Options { algorithm: Algorithm::Svr, interior: Interior::Winding, ..options };
        assert_eq!(decode(&encode(&svr)).unwrap(), svr);
    }

    #[test]
    fn the_options_of_a_run_have_no_auto() {
        let mesh = square();
        let mut found = encode(&Options::default());
        let mut read = || {
            // SAFETY: a live handle and a whole struct.
            let status = unsafe { nm_mesh_options(&mesh, &mut found) };
            (status, decode(&found).unwrap())
        };
        assert_eq!(read(), (nm_status::NM_STATE, Options::default()));
        let run = |options: Options| {
            // SAFETY: a live handle and a whole struct.
            let status = unsafe { nm_run((&raw const mesh).cast_mut(), &encode(&options)) };
            assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        };
        run(Options { seed: 7, ..Options::default() });
        let (status, options) = read();
        assert_eq!((status, options.seed), (nm_status::NM_OK, 7));
        assert_eq!((options.output, options.extent), (Output::Hierarchical, Extent::All));
        assert_eq!((options.quality_bound, options.epsilon), (3.0, 0.5));
        run(Options { extent: Extent::Box, min_angle: 20.0, ..Options::default() });
        let (_, options) = read();
        assert_eq!((options.output, options.extent), (Output::WellSpaced, Extent::Box));
        assert_eq!(options.criterion, Criterion::RadiusEdge);
        assert!((options.min_angle - 20.0).abs() < 1e-12, "{}", options.min_angle);
        // SAFETY: NULL is allowed.
        let status = unsafe { nm_mesh_options(&mesh, null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "options is NULL"));
    }

    #[test]
    fn init_writes_the_defaults_and_clears_the_tail() {
        let mut bytes = [0xee; 256];
        assert_eq!(init(&mut bytes, 200), nm_status::NM_OK);
        assert_eq!(bytes[..4], 200_u32.to_ne_bytes());
        assert!(bytes[SIZE..200].iter().all(|&byte| byte == 0));
        assert!(bytes[200..].iter().all(|&byte| byte == 0xee));
        let options = read(&bytes);
        assert_eq!(decode(&options).unwrap(), Options::default());
        assert!(options.progress.is_none() && options.user_data.is_null());
    }

    #[test]
    fn an_older_struct_is_filled_to_its_end() {
        let mut bytes = [0xee; 256];
        let size = offset_of!(nm_options, seed);
        assert_eq!(init(&mut bytes, size as u32), nm_status::NM_OK);
        assert!(bytes[size..].iter().all(|&byte| byte == 0xee));
        let options = read(&bytes);
        assert_eq!((options.threads, options.seed), (1, 77), "seed is missing, so the default");
    }

    #[test]
    fn sizes_that_end_inside_a_field_are_refused() {
        let mut bytes = [0xee; 256];
        let word = size_of::<usize>();
        let legal = [4, 8, 12, 16, 20].into_iter().chain((24..=104).step_by(8)).chain([
            104 + word,
            104 + 2 * word,
            108 + 2 * word,
            112 + 2 * word,
            120 + 2 * word,
            128 + 2 * word,
            136 + 2 * word,
            144 + 2 * word,
            144 + 3 * word,
            144 + 4 * word,
            148 + 4 * word,
            152 + 4 * word,
            156 + 4 * word,
            160 + 4 * word,
            164 + 4 * word,
            168 + 4 * word,
        ]);
        let legal: Vec<_> = legal.collect();
        for size in 0..=SIZE {
            let accepted = init(&mut bytes, size as u32) == nm_status::NM_OK;
            assert_eq!(accepted, legal.contains(&size), "{size}");
        }
        assert_eq!(init(&mut bytes, 4097), nm_status::NM_INVALID_ARGUMENT);
        bytes = [0xee; 256];
        assert_eq!(init(&mut bytes, 26), nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(bytes, [0xee; 256]);
        assert!(last_message().starts_with("options.struct_size is 26; it ends inside a field"));
        // SAFETY: NULL is allowed.
        let status = unsafe { nm_options_init(null_mut(), 120) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "options is NULL"));
    }

    #[test]
    fn every_enum_field_is_checked() {
        let good = encode(&Options::default());
        let bad = [
            ("output", 3, nm_options { output: from_c(3), ..good }),
            ("extent", 5, nm_options { extent: from_c(5), ..good }),
            ("algorithm", 3, nm_options { algorithm: from_c(3), ..good }),
            ("ordering", -1, nm_options { ordering: from_c(-1), ..good }),
            ("criterion", 2, nm_options { criterion: from_c(2), ..good }),
            ("gives_way", 2, nm_options { gives_way: from_c(2), ..good }),
            ("interior", 4, nm_options { interior: from_c(4), ..good }),
        ];
        for (field, value, options) in bad {
            let message = decode(&options).unwrap_err().message().to_owned();
            assert!(message.starts_with(&format!("options.{field} is {value};")), "{message}");
        }
    }

    #[test]
    fn the_switch_is_checked_and_so_is_what_follows_it() {
        let good = encode(&Options::default());
        let refusals = [
            (nm_options { instruments: 2, ..good }, "options.instruments is 2; it must be 0 or 1"),
            (nm_options { reserved: 7, ..good }, "options.reserved is 7; it must be 0"),
            (
                nm_options { reserved_after_gives_way: 7, ..good },
                "options.reserved_after_gives_way is 7; it must be 0",
            ),
            (
                nm_options { reserved_after_interior: 7, ..good },
                "options.reserved_after_interior is 7; it must be 0",
            ),
        ];
        for (options, message) in refusals {
            let error = decode(&options).unwrap_err();
            assert_eq!((error.kind(), error.message()), (ErrorKind::InvalidArgument, message));
        }
    }
}
