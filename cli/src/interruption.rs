//! What a signal leaves behind: nothing. The library knows no signals, so the program removes the
//! files that the library has under way.

use std::path::PathBuf;

/// From now on SIGINT (Ctrl-C) and SIGTERM remove what is unfinished of `outputs`, then end the
/// program as they do by default, so that a shell sees the signal.
#[cfg(unix)]
pub fn clean_up_after(outputs: Vec<PathBuf>) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    if outputs.is_empty() {
        return;
    }
    // Where no handler can be set the signals still end the program.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
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
