//! Options, from C and to C.

use super::decode::decode;
use super::enums::nm_status;
use super::getters::result;
use super::handle::{barrier, nm_mesh, with_mesh};
use super::memory::OutStruct;
use super::structs::nm_options;
use crate::error::{Error, Result, message};
use crate::mesh::Mesh;
use crate::options::{Choices, Options, each_option};
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

/// Type of an option, in Rust and as a field of `nm_options`.
trait Field: Sized {
    type InC;

    /// Returns the value as a field of C's struct.
    fn in_c(self) -> Self::InC;

    /// Returns the value of the field `name`; fails if that of C is none in Rust.
    fn decode(name: &str, raw: Self::InC) -> Result<Self>;
}

macro_rules! number_fields {
    ($($type:ty)*) => {$(
        impl Field for $type {
            type InC = Self;

            fn in_c(self) -> Self {
                self
            }

            fn decode(_: &str, raw: Self) -> Result<Self> {
                Ok(raw)
            }
        }
    )*};
}
// The ranges of numbers are the core's affair.
number_fields! { f64 u64 u32 }

impl<E: Choices> Field for E {
    type InC = MaybeUninit<Self>;

    fn in_c(self) -> Self::InC {
        MaybeUninit::new(self)
    }

    fn decode(name: &str, raw: Self::InC) -> Result<Self> {
        let (field, kind) = (format_args!("options.{name}"), format_args!("nm_{name}"));
        decode(field, kind, raw, Self::VALUES)
    }
}

impl Field for bool {
    type InC = u32;

    fn in_c(self) -> u32 {
        u32::from(self)
    }

    fn decode(name: &str, raw: u32) -> Result<Self> {
        match raw {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Error::invalid(message!("options.{name} is {other}; it must be 0 or 1"))),
        }
    }
}

macro_rules! declare_conversions {
    ($($name:ident $field:ident: $type:ty { $($row:tt)* })*) => {
        /// Returns `options` as C sees them.
        pub fn encode(options: &Options) -> nm_options {
            nm_options {
                struct_size: size_of::<nm_options>() as u32,
                $($field: options.$field.in_c(),)*
                size: None,
                size_user_data: null_mut(),
                progress: None,
                user_data: null_mut(),
                reserved_domain: 0,
                reserved: 0,
            }
        }

        /// Returns the options that C asks for, enums and switches checked.
        pub(super) fn decode_options(options: &nm_options) -> Result<Options> {
            check_reserved("reserved_domain", options.reserved_domain)?;
            check_reserved("reserved", options.reserved)?;
            Ok(Options {
                $($field: Field::decode(stringify!($field), options.$field)?,)*
            })
        }
    };
}
each_option!(declare_conversions);

fn check_reserved(name: &str, given: u32) -> Result<()> {
    if given == 0 {
        return Ok(());
    }
    Err(Error::invalid(message!("options.{name} is {given}; it must be 0")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::memory::read_struct;
    use crate::capi::run::nm_run;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::error::ErrorKind;
    use crate::options::{Criterion, Extent, Kind, Output, TABLE, Value};
    use std::mem::offset_of;

    const SIZE: usize = size_of::<nm_options>();

    fn init(bytes: &mut [u8; 256], struct_size: u32) -> nm_status {
        // SAFETY: the tests' sizes are at most the buffer's, or refused.
        unsafe { nm_options_init(bytes.as_mut_ptr().cast(), struct_size) }
    }

    /// Returns what nm_run reads from a struct of these bytes.
    fn read(bytes: &[u8; 256]) -> nm_options {
        let defaults = encode(&Options { seed: 77, ..Options::default() });
        // SAFETY: the tests' sizes are at most the buffer's.
        unsafe { read_struct("options", bytes.as_ptr().cast(), defaults) }.unwrap()
    }

    #[test]
    fn options_survive_the_way_to_c_and_back() {
        let survives = |options: &Options| {
            assert_eq!(decode_options(&encode(options)).unwrap(), *options);
        };
        let mut all = Options::default();
        survives(&all);
        for (row, at) in TABLE.iter().zip(2_u32..) {
            let values = match row.kind {
                Kind::Number { .. } => vec![Value::Number(f64::from(at) + 0.5)],
                Kind::Whole(_) => vec![Value::Whole(u64::from(at))],
                Kind::Switch => vec![Value::Switch(true)],
                Kind::Words(words) => (0..words.len()).map(Value::Word).collect(),
            };
            for value in values {
                row.set(&mut all, value);
                survives(&all);
            }
        }
    }

    #[test]
    fn the_options_of_a_run_have_no_auto() {
        let mesh = square();
        let mut found = encode(&Options::default());
        let mut read = || {
            // SAFETY: a live handle and a whole struct.
            let status = unsafe { nm_mesh_options(&mesh, &mut found) };
            (status, decode_options(&found).unwrap())
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
        assert_eq!(init(&mut bytes, 240), nm_status::NM_OK);
        assert_eq!(bytes[..4], 240_u32.to_ne_bytes());
        assert!(bytes[SIZE..240].iter().all(|&byte| byte == 0));
        assert!(bytes[240..].iter().all(|&byte| byte == 0xee));
        let options = read(&bytes);
        assert_eq!(decode_options(&options).unwrap(), Options::default());
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
        let legal: Vec<_> = (8..=SIZE).step_by(8).collect();
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
            let message = decode_options(&options).unwrap_err().message().to_owned();
            assert!(message.starts_with(&format!("options.{field} is {value};")), "{message}");
        }
    }

    #[test]
    fn the_switch_is_checked_and_so_is_what_follows_it() {
        let good = encode(&Options::default());
        let refusals = [
            (nm_options { instruments: 2, ..good }, "options.instruments is 2; it must be 0 or 1"),
            (nm_options { reserved: 7, ..good }, "options.reserved is 7; it must be 0"),
        ];
        for (options, message) in refusals {
            let error = decode_options(&options).unwrap_err();
            assert_eq!((error.kind(), error.message()), (ErrorKind::InvalidArgument, message));
        }
    }
}
