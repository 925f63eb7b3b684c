//! Report of an experiment, as files and as a section of docs/reports/experiments.md.

use crate::table::Table;
use crate::verdict::{Answer, Verdict};
use std::fmt::Write;
use std::path::Path;

/// Longer tables are only linked to.
const SHOWN_ROWS: usize = 48;

#[derive(Default)]
pub struct Report {
    pub name: &'static str,
    pub title: &'static str,
    /// The law, how it is measured, and what the columns are.
    pub text: String,
    pub verdicts: Vec<Verdict>,
    pub tables: Vec<Table>,
    pub pictures: Vec<Picture>,
}

/// Picture that bench/plots/draw.py draws of the experiment's table.
pub struct Picture {
    /// Name of the file without its extension.
    pub name: String,
    pub title: String,
}

impl Picture {
    pub fn new(name: &str, title: &str) -> Self {
        Self { name: name.to_string(), title: title.to_string() }
    }
}

impl Report {
    /// `links` is the path from the section's file to the tables and pictures.
    pub fn section(&self, links: &str) -> String {
        let mut out = format!("## {}\n\n{}\n\n", self.title, self.text.trim());
        if !self.verdicts.is_empty() {
            out += "| claim | target | measured | verdict |\n|---|---|---|---|\n";
        }
        for verdict in &self.verdicts {
            let Verdict { claim, target, measured, answer } = verdict;
            let _ = writeln!(out, "| {claim} | {target} | {measured} | {} |", word(*answer));
        }
        for picture in &self.pictures {
            let _ = writeln!(out, "\n![{}]({links}/{}.svg)", picture.title, picture.name);
        }
        for table in &self.tables {
            let link = format!("[{name}.csv]({links}/{name}.csv)", name = table.name);
            if table.len() <= SHOWN_ROWS {
                let _ = write!(out, "\n{link}:\n\n{}", table.markdown());
            } else {
                let _ = writeln!(out, "\nThe figures: {link} ({} rows).", table.len());
            }
        }
        out
    }

    /// Writes the tables into `folder`.
    pub fn write_files(&self, folder: &Path) -> std::io::Result<()> {
        for table in &self.tables {
            std::fs::write(folder.join(format!("{}.csv", table.name)), table.csv())?;
        }
        Ok(())
    }
}

fn word(answer: Answer) -> &'static str {
    match answer {
        Answer::Met => "met",
        Answer::Missed => "**missed**",
        Answer::NotMeasured => "not measured",
    }
}

/// The sections of a document, between marks, so that one experiment can be run without the others.
#[derive(Debug, Default, PartialEq)]
pub struct Sections {
    all: Vec<(String, String)>,
}

impl Sections {
    pub fn of(document: &str) -> Self {
        let all = document.split("<!-- begin ").skip(1).filter_map(|part| {
            let (name, rest) = part.split_once(" -->\n")?;
            let (text, _) = rest.split_once(&format!("<!-- end {name} -->"))?;
            Some((name.to_string(), text.to_string()))
        });
        Self { all: all.collect() }
    }

    pub fn replace(&mut self, name: &str, text: String) {
        match self.all.iter_mut().find(|(other, _)| other == name) {
            Some((_, old)) => *old = text,
            None => self.all.push((name.to_string(), text)),
        }
    }

    /// In the order of `names`.
    pub fn document(&self, introduction: &str, names: &[&str]) -> String {
        let mut out = introduction.to_string();
        for name in names {
            if let Some((_, text)) = self.all.iter().find(|(other, _)| other == name) {
                let _ = write!(out, "\n<!-- begin {name} -->\n{text}<!-- end {name} -->\n");
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_section_is_replaced_and_the_others_are_kept() {
        let mut sections = Sections::default();
        sections.replace("b", "two\n".to_string());
        sections.replace("a", "one\n".to_string());
        let first = sections.document("# Title\n", &["a", "b", "c"]);
        let mut read = Sections::of(&first);
        assert_eq!(read.document("# Title\n", &["a", "b", "c"]), first);
        read.replace("b", "new\n".to_string());
        let second = read.document("# Title\n", &["a", "b", "c"]);
        assert_eq!(second, first.replace("two", "new"));
        assert!(second.find("one") < second.find("new"));
    }

    #[test]
    fn a_missed_target_shows() {
        let verdicts = vec![Verdict::at_most("size", 2.0, 1.0), Verdict::at_most("size", 0.5, 1.0)];
        let report = Report { verdicts, ..Report::default() };
        assert_eq!(report.section("x").matches("**missed**").count(), 1);
        assert_eq!(report.section("x").matches("| met |").count(), 1);
    }
}
