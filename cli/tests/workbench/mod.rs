//! A directory of its own for each test, and the program to run in it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

pub struct Workbench {
    directory: PathBuf,
}

/// End of a run.
pub struct Outcome {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Workbench {
    /// An empty directory; `test` must be unique in the whole suite.
    pub fn new(test: &str) -> Self {
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        let _ = fs::remove_dir_all(&directory);
        fs::create_dir_all(&directory).expect("the test directory can be made");
        Self { directory }
    }

    /// Writes a file; `name` may begin with a directory, which is made.
    pub fn write(&self, name: &str, text: &str) {
        let path = self.directory.join(name);
        let directory = path.parent().expect("the test directory");
        fs::create_dir_all(directory).expect("the directory can be made");
        fs::write(path, text).expect("the test file can be written");
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.directory.join(name)).expect("the output can be read")
    }

    /// Text, or what of a binary file is text.
    pub fn read(&self, name: &str) -> String {
        String::from_utf8_lossy(&self.bytes(name)).into_owned()
    }

    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Names of all files, sorted.
    pub fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.directory).expect("the test directory can be listed");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs `netmesh` in the directory with the words of `line`.
    pub fn run(&self, line: &str) -> Outcome {
        Outcome::new(&self.command(line).output().expect("the program starts"))
    }

    /// Runs the program with `text` on standard input.
    pub fn run_with_input(&self, line: &str, text: &str) -> Outcome {
        self.write("standard input", text);
        let input = fs::File::open(self.directory.join("standard input")).expect("it is there");
        fs::remove_file(self.directory.join("standard input")).expect("it can be removed");
        let output = self.command(line).stdin(input).output().expect("the program starts");
        Outcome::new(&output)
    }

    /// `netmesh` in the directory with the words of `line`, not yet started.
    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_netmesh"));
        command.args(line.split_whitespace()).current_dir(&self.directory);
        command
    }
}

impl Outcome {
    fn new(output: &Output) -> Self {
        Self {
            code: output.status.code().expect("the program ends by itself"),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// The run must have failed with `code`, said `words` on stderr and nothing on stdout.
    #[track_caller]
    pub fn assert_failure(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, code, "stderr: {}", self.stderr);
        assert_eq!(self.stdout, "");
        for word in words {
            assert!(self.stderr.contains(word), "no '{word}' in: {}", self.stderr);
        }
    }

    #[track_caller]
    pub fn assert_success(&self) {
        assert_eq!(self.code, 0, "stderr: {}", self.stderr);
        assert_eq!(self.stderr, "");
    }
}
