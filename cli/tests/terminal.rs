//! What a person at a terminal sees and does: progress of every stage, and Ctrl-C.
#![cfg(unix)]

mod workbench;

use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;
use workbench::Workbench;

const SIGINT: i32 = 2;
const SIGTERM: i32 = 15;

fn bench_with_sample(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../samples/knot_3d.xyz");
    bench.write("points.xyz", &std::fs::read_to_string(path).expect("the sample is shipped"));
    bench
}

/// Sends `signal` as soon as a file is under way; false if the program was faster.
fn is_interrupted_while_writing(bench: &Workbench, signal: i32) -> bool {
    let mut command = bench.command("points.xyz -q -o a.voronoi.json");
    let mut child = command.stderr(Stdio::null()).spawn().expect("the program starts");
    let is_writing = || bench.files().iter().any(|name| name.ends_with(".tmp"));
    let status = loop {
        if is_writing() {
            let pid = child.id().to_string();
            let kill = Command::new("kill").args([format!("-{signal}"), pid]).status();
            assert!(kill.is_ok(), "kill is there");
            break child.wait().expect("it ends");
        }
        if let Some(status) = child.try_wait().expect("it can be asked") {
            break status;
        }
        sleep(Duration::from_millis(1));
    };
    assert!(status.success() || status.signal() == Some(signal), "{status}");
    status.signal().is_some()
}

#[test]
fn a_signal_while_writing_leaves_nothing_behind() {
    for signal in [SIGINT, SIGTERM] {
        let bench = bench_with_sample(&format!("signal_{signal}"));
        // On a busy machine the signal may come too late.
        let interrupted = (0..20).any(|_| {
            let _ = std::fs::remove_file(bench.directory().join("a.voronoi.json"));
            is_interrupted_while_writing(&bench, signal)
        });
        assert!(interrupted, "the program was faster than twenty signals");
        assert_eq!(bench.files(), ["points.xyz"], "signal {signal}");
    }
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
