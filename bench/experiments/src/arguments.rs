//! The command line.

use crate::experiments::{ALL, Scale};
use std::path::PathBuf;

pub const USAGE: &str = "\
usage: experiments [options] [names...]

Runs the experiments (all, without names) and prints their tables' verdicts.

  --quick             smaller sizes, a few minutes
  --tiny              seconds, for the tests: the figures mean nothing
  --jobs N            runs at a time where nothing is timed (2)
  --peers FILE        the program of CMake's target experiment_peers
  --triangle PY FILE  a Python with the module triangle, and refine_with_triangle.py
  --scratch FOLDER    where peers read and write (the system's folder for temporary files)
  --output FOLDER     where tables (.csv) go
  --document FILE     where the sections go; OUTPUT's name is the link to tables and pictures
  --from-csv          runs nothing: verdicts again from the tables in OUTPUT";

#[derive(Debug, PartialEq)]
pub struct Arguments {
    pub scale: Scale,
    pub jobs: usize,
    pub peers: Option<PathBuf>,
    pub triangle: Option<(PathBuf, PathBuf)>,
    pub scratch: PathBuf,
    pub output: Option<PathBuf>,
    pub document: Option<PathBuf>,
    pub from_csv: bool,
    /// Names of the experiments to run, in the order of [`ALL`].
    pub names: Vec<&'static str>,
}

impl Arguments {
    /// # Errors
    /// A sentence for the user.
    pub fn parse(given: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self {
            scale: Scale::Full,
            jobs: 2,
            peers: None,
            triangle: None,
            scratch: std::env::temp_dir(),
            output: None,
            document: None,
            from_csv: false,
            names: Vec::new(),
        };
        let mut wanted = Vec::new();
        let mut given = given;
        while let Some(argument) = given.next() {
            let mut next = || given.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--quick" => arguments.scale = Scale::Quick,
                "--tiny" => arguments.scale = Scale::Tiny,
                "--jobs" => {
                    let value = next()?;
                    let jobs = value.parse().ok().filter(|&jobs| jobs > 0);
                    arguments.jobs =
                        jobs.ok_or(format!("--jobs is {value}; it must be at least 1"))?;
                }
                "--from-csv" => arguments.from_csv = true,
                "--peers" => arguments.peers = Some(next()?.into()),
                "--triangle" => arguments.triangle = Some((next()?.into(), next()?.into())),
                "--scratch" => arguments.scratch = next()?.into(),
                "--output" => arguments.output = Some(next()?.into()),
                "--document" => arguments.document = Some(next()?.into()),
                name if ALL.iter().any(|experiment| experiment.name == name) => {
                    wanted.push(name.to_string());
                }
                other => return Err(format!("{other} is neither an option nor an experiment")),
            }
        }
        if arguments.from_csv && arguments.output.is_none() {
            return Err("--from-csv needs --output, where the tables are".to_string());
        }
        arguments.names = ALL
            .iter()
            .map(|experiment| experiment.name)
            .filter(|&name| wanted.is_empty() || wanted.iter().any(|w| w == name))
            .collect();
        Ok(arguments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(words: &str) -> Result<Arguments, String> {
        Arguments::parse(words.split_whitespace().map(str::to_string))
    }

    #[test]
    fn names_come_in_the_document_s_order() {
        let arguments = parse("sizes --quick spread --jobs 1").unwrap();
        assert_eq!(arguments.names, ["spread", "sizes"]);
        assert_eq!((arguments.scale, arguments.jobs), (Scale::Quick, 1));
        assert_eq!(parse("").unwrap().names.len(), ALL.len());
    }

    #[test]
    fn wrong_words_are_refused() {
        for words in ["spred", "--jobs", "--jobs 0", "--triangle python3", "--from-csv"] {
            assert!(parse(words).is_err(), "{words}");
        }
    }
}
