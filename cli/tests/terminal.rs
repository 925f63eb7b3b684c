//! A person at a terminal, who sees and does this: progress of every stage, and Ctrl-C.
#![cfg(unix)]

use crate::workbench::Workbench;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::Duration;

const SIGHUP: i32 = 1;
const SIGINT: i32 = 2;
const SIGQUIT: i32 = 3;
const SIGTERM: i32 = 15;

fn bench_with_sample(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../samples/knot_3d.xyz");
    bench.write("points.xyz", &std::fs::read_to_string(path).expect("the sample is shipped"));
    bench
}

const LINE: &str = "points.xyz -q -o a.voronoi.json";

/// Starts a program in the directory and sends it `signal` as soon as a file is under way; its
/// status, and false if the program was faster.
fn signal_while_writing(
    bench: &Workbench,
    mut command: Command,
    signal: i32,
) -> (ExitStatus, bool) {
    command.current_dir(bench.directory()).stderr(Stdio::null());
    let mut child = command.spawn().expect("the program starts");
    let is_writing = || bench.files().iter().any(|name| name.ends_with(".tmp"));
    loop {
        if is_writing() {
            let pid = child.id().to_string();
            let kill = Command::new("kill").args([format!("-{signal}"), pid]).status();
            let was_there = kill.expect("kill is there").success();
            let was_faster =
                child.try_wait().expect("it can be asked").is_some_and(|s| s.success());
            return (child.wait().expect("it ends"), was_there && !was_faster);
        }
        if let Some(status) = child.try_wait().expect("it can be asked") {
            return (status, false);
        }
        sleep(Duration::from_millis(1));
    }
}

/// Returns true for a signal that programs started from here ignore, as under `nohup`.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let set = ignored.and_then(|set| u64::from_str_radix(set.trim(), 16).ok());
    set.is_some_and(|set| set >> (signal - 1) & 1 == 1)
}

#[test]
fn a_signal_while_writing_leaves_nothing_behind() {
    for signal in [SIGHUP, SIGINT, SIGQUIT, SIGTERM] {
        if is_ignored(signal) {
            println!("skipped: signal {signal}, which these tests were started to ignore");
            continue;
        }
        let bench = bench_with_sample(&format!("signal_{signal}"));
        // On a busy machine the signal may come too late.
        let interrupted = (0..20).any(|_| {
            let _ = std::fs::remove_file(bench.directory().join("a.voronoi.json"));
            let (status, _) = signal_while_writing(&bench, bench.command(LINE), signal);
            assert!(status.success() || status.signal() == Some(signal), "{status}");
            status.signal().is_some()
        });
        assert!(interrupted, "signal {signal} never came while a file was being written");
        assert_eq!(bench.files(), ["points.xyz"], "signal {signal}");
    }
}

/// `nohup` and jobs in the background of a script begin so: Ctrl-C at the terminal is not for them.
#[test]
#[cfg(target_os = "linux")]
fn a_signal_that_was_ignored_at_the_start_stays_ignored() {
    for (signal, name) in [(SIGHUP, "HUP"), (SIGINT, "INT"), (SIGQUIT, "QUIT")] {
        let bench = bench_with_sample(&format!("ignored_{name}"));
        let came = (0..20).any(|_| {
            let _ = std::fs::remove_file(bench.directory().join("a.voronoi.json"));
            let script = format!("trap '' {name}; exec {} {LINE}", env!("CARGO_BIN_EXE_netmesh"));
            let mut command = Command::new("sh");
            command.args(["-c", &script]);
            let (status, came) = signal_while_writing(&bench, command, signal);
            assert!(status.success(), "SIG{name}: {status}");
            came
        });
        assert!(came, "SIG{name} never came while a file was being written");
        assert_eq!(bench.files(), ["a.voronoi.json", "points.xyz"], "SIG{name}");
    }
}

/// The limit is a signal too, but what it says is that the output cannot be written.
#[test]
fn a_file_beyond_the_limit_of_sizes_is_an_output_that_cannot_be_written() {
    let bench = bench_with_sample("file_size_limit");
    let script = format!("ulimit -f 8; exec {} {LINE}", env!("CARGO_BIN_EXE_netmesh"));
    let mut command = Command::new("sh");
    let output = command.args(["-c", &script]).current_dir(bench.directory()).output();
    let output = output.expect("sh starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(8), "{}: {said}", output.status);
    assert!(said.contains("a.voronoi.json: cannot write"), "{said}");
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn every_stage_shows_itself() {
    let bench = bench_with_sample("stages");
    let program = env!("CARGO_BIN_EXE_netmesh");
    let in_a_terminal = |options: &str| {
        let line = format!("stty cols 120; {program} points.xyz {options}");
        let mut script = Command::new("script");
        script.args(["--quiet", "--return", "--command", &line, "/dev/null"]);
        script.env("TERM", "xterm").current_dir(bench.directory()).stdin(Stdio::null());
        let output = script.output().expect("it starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    if Command::new("script").arg("--version").output().is_err() {
        eprintln!("skipped: there is no program `script` to make a terminal");
        return;
    }
    let shown = in_a_terminal("-o mesh.vtu --validate");
    for stage in ["inserting", "writing", "certifying", "measuring"] {
        assert!(shown.contains(stage), "no '{stage}' in: {shown}");
    }
    assert_eq!(in_a_terminal("-q -o mesh.vtu --validate"), "");
    // Without a terminal there is nothing but the summary.
    bench.run("points.xyz -o mesh.vtu").assert_success();
}
