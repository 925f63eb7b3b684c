//! The program's conduct when a signal ends it: nothing half written stays. The library knows no
//! signals, so the program removes the files that the library has under way.

use std::path::PathBuf;

/// Makes every signal that asks the program to end remove what is unfinished of `outputs` first;
/// then it ends the program as it does by default, so that a shell sees the signal. A signal that
/// the caller has the program ignore (`nohup`, a job in the background of a script) stays ignored.
#[cfg(unix)]
pub fn clean_up_after(outputs: Vec<PathBuf>) {
    use signal_hook::consts::SIGXFSZ;
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    if outputs.is_empty() {
        return;
    }
    let ignored = unix::ignored_signals();
    let handled = unix::ENDING.into_iter().chain([SIGXFSZ]);
    let handled = handled.filter(|signal| !unix::contains(ignored, *signal));
    // Where no handler can be set the signals still end the program.
    let Ok(mut signals) = Signals::new(handled) else { return };
    std::thread::spawn(move || {
        // Beyond the limit of a file's size a write fails, which says more than the signal.
        for signal in signals.forever().filter(|signal| *signal != SIGXFSZ) {
            let unfinished = outputs.iter().flat_map(|path| netmesh::io::unfinished_files(path));
            unfinished.for_each(|file| {
                // Another thread may have renamed it just now.
                let _ = std::fs::remove_file(file);
            });
            let _ = emulate_default_handler(signal);
        }
    });
}

/// Signals as these are known on Unix only.
#[cfg(not(unix))]
pub fn clean_up_after(_: Vec<PathBuf>) {}

#[cfg(unix)]
mod unix {
    use signal_hook::consts::*;

    /// Signals that others send to end a program: a terminal that closes, a person at it, a batch
    /// system, a limit of processor time. Each ends a program that does not handle it.
    pub const ENDING: [i32; 8] =
        [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM, SIGXCPU];

    /// Returns the signals that are ignored, a bit each; elsewhere than on Linux none is known.
    pub fn ignored_signals() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        of_status(&status)
    }

    fn of_status(status: &str) -> u64 {
        let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }

    pub fn contains(signals: u64, signal: i32) -> bool {
        signals >> (signal - 1) & 1 == 1
    }

    #[test]
    fn the_mask_has_a_bit_for_each_signal() {
        let ignored = of_status("SigBlk:\t00000000000000ff\nSigIgn:\t0000000000000006\n");
        assert!(contains(ignored, SIGINT) && contains(ignored, SIGQUIT));
        assert!(!contains(ignored, SIGHUP) && !contains(ignored, SIGTERM));
        assert_eq!(of_status("there is no such line"), 0);
    }
}
