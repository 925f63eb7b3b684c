//! The floating-point environment of a thread: how results are rounded, whether subnormal numbers
//! are taken as zero, which exceptions trap, and which have occurred.
//!
//! Rust computes in the default environment and in no other. The caller's may differ: one shared
//! object that is linked with `-Ofast` sets flush-to-zero for the whole process. So every entry of
//! the C ABI sets the default one and restores the caller's when it returns, and the caller's
//! functions are called in the caller's.
//!
//! On x86-64 doubles are computed by SSE alone, which the register MXCSR controls; the control word
//! of the x87 unit stays as it is, since nothing here uses that unit. On aarch64 it is FPCR, and
//! FPSR has the flags. Other processors are left as they are.

/// A thread's floating-point environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Environment(registers::Registers);

impl Environment {
    /// The environment that a program starts with: rounding to nearest, subnormal numbers, no trap
    /// and no flag.
    pub const DEFAULT: Self = Self(registers::DEFAULT);

    /// Returns the environment of the calling thread.
    pub fn current() -> Self {
        Self(registers::read())
    }

    /// Runs `body` in this environment and restores the one before, all flags included, also where
    /// `body` panics. In another environment than [`Self::DEFAULT`] `body` must not compute: it is
    /// a call of a function that was not made by this compiler.
    pub fn run<R>(self, body: impl FnOnce() -> R) -> R {
        let _restored = Restored(Self::current());
        registers::write(self.0);
        apart(body)
    }
}

/// Calls `body` in a frame of its own: no operation of it moves to before the registers are set, or
/// to after they are restored.
#[inline(never)]
fn apart<R>(body: impl FnOnce() -> R) -> R {
    body()
}

/// Restores an environment when it is dropped.
struct Restored(Environment);

impl Drop for Restored {
    fn drop(&mut self) {
        registers::write(self.0.0);
    }
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
mod registers {
    use std::arch::asm;

    /// The register MXCSR.
    pub type Registers = u32;

    /// Every exception is masked.
    pub const DEFAULT: Registers = 0x1f80;

    pub fn read() -> Registers {
        let mut value: Registers = 0;
        // SAFETY: it stores four bytes where there are four.
        unsafe {
            asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack, preserves_flags));
        }
        value
    }

    pub fn write(value: Registers) {
        // SAFETY: it loads four bytes that are there; they have been read from the register or are
        // its default, so that no reserved bit is set. No Rust computes in another environment than
        // the default one, as `Environment::run` asks.
        unsafe {
            asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack, preserves_flags));
        }
    }
}

#[cfg(all(target_arch = "aarch64", not(miri)))]
mod registers {
    use std::arch::asm;

    /// The registers FPCR and FPSR.
    pub type Registers = [u64; 2];

    pub const DEFAULT: Registers = [0, 0];

    pub fn read() -> Registers {
        let (control, flags): (u64, u64);
        // SAFETY: it reads two registers that every such processor has.
        unsafe {
            asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) flags,
                 options(nomem, nostack, preserves_flags));
        }
        [control, flags]
    }

    pub fn write([control, flags]: Registers) {
        // SAFETY: the values have been read from the registers or are their default. No Rust
        // computes in another environment than the default one, as `Environment::run` asks.
        unsafe {
            asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) flags,
                 options(nostack, preserves_flags));
        }
    }
}

#[cfg(any(miri, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
mod registers {
    pub type Registers = ();

    pub const DEFAULT: Registers = ();

    pub fn read() -> Registers {}

    pub fn write((): Registers) {}
}

#[cfg(all(test, any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
mod tests {
    use super::*;
    use crate::capi::enums::nm_status;
    use crate::capi::handle::barrier;
    use std::hint::black_box;

    /// Rounding upwards, flush-to-zero, denormals-are-zero, and the flag of an inexact result.
    #[cfg(target_arch = "x86_64")]
    const STRANGE: Environment = Environment(0x1f80 | 0x4000 | 0x8000 | 0x40 | 0x20);
    #[cfg(target_arch = "aarch64")]
    const STRANGE: Environment = Environment([1 << 24 | 1 << 22, 1 << 4]);

    /// Returns true if the thread computes with subnormal numbers and rounds to nearest.
    #[inline(never)]
    fn computes_as_usual() -> bool {
        let (one, least) = (black_box(1.0), black_box(f64::MIN_POSITIVE));
        least / 2.0 > 0.0 && one + f64::EPSILON / 4.0 == 1.0
    }

    #[test]
    fn a_strange_environment_is_strange() {
        assert!(computes_as_usual());
        let usual = Environment::current();
        assert!(!STRANGE.run(computes_as_usual));
        assert_eq!((Environment::current(), STRANGE.run(Environment::current)), (usual, STRANGE));
    }

    #[test]
    fn the_default_is_the_environment_of_a_program() {
        // It has no flags, which a thread may inherit.
        let of_thread = || Environment::DEFAULT.run(Environment::current);
        assert_eq!(std::thread::spawn(of_thread).join().unwrap(), Environment::DEFAULT);
        assert!(Environment::DEFAULT.run(computes_as_usual));
    }

    #[test]
    fn entries_compute_as_usual_and_restore_whatever_happens() {
        STRANGE.run(|| {
            let mut is_usual = [false; 3];
            let ok = barrier(|| {
                is_usual[0] = computes_as_usual();
                Ok(())
            });
            assert_eq!((ok, Environment::current()), (nm_status::NM_OK, STRANGE));
            let refused = barrier(|| {
                is_usual[1] = computes_as_usual();
                Err(crate::Error::new(crate::ErrorKind::Limit, "on purpose"))
            });
            assert_eq!((refused, Environment::current()), (nm_status::NM_LIMIT, STRANGE));
            let panicked = barrier(|| {
                is_usual[2] = computes_as_usual();
                panic!("on purpose")
            });
            assert_eq!((panicked, Environment::current()), (nm_status::NM_PANIC, STRANGE));
            assert_eq!(is_usual, [true; 3]);
        });
    }

    #[test]
    fn threads_that_an_entry_starts_compute_as_usual() {
        STRANGE.run(|| {
            let mut is_usual = false;
            let status = barrier(|| {
                is_usual = std::thread::scope(|scope| {
                    let nested = || std::thread::spawn(computes_as_usual).join().unwrap();
                    let thread = scope.spawn(move || computes_as_usual() && nested());
                    thread.join().unwrap()
                });
                Ok(())
            });
            assert_eq!((status, is_usual), (nm_status::NM_OK, true));
        });
    }
}
