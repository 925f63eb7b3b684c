//! The code in the tutorial and in the recipes is that of the examples, which ctest builds and
//! runs.
//!
//! A block of code follows a line `<!-- FILE: REGION -->`, or is a session of Python, which the
//! tests of the package run. In the file the region stands between a comment `[REGION]` and a
//! comment `[end]`. `NETMESH_WRITE_PAGES=1 cargo test pages` copies the regions into the pages.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const PAGES: [&str; 6] = [
    "docs/tutorial.md",
    "docs/cpp.md",
    "docs/recipes.md",
    "docs/slivers.md",
    "docs/domains.md",
    "docs/python_jobs.md",
];
const EXAMPLES: [&str; 3] = ["examples/c", "examples/cpp", "examples/python"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    let text = fs::read_to_string(root().join(path));
    text.unwrap_or_else(|error| panic!("{path}: {error}")).replace('\r', "")
}

/// The name in a comment that is nothing but `[name]`.
fn mark(line: &str) -> Option<&str> {
    let comment =
        line.trim().trim_start_matches(['/', '*', '#', ' ']).trim_end_matches(['*', '/', ' ']);
    let is_comment = ["//", "/*", "#"].iter().any(|start| line.trim().starts_with(start));
    comment.strip_prefix('[')?.strip_suffix(']').filter(|_| is_comment)
}

/// The regions of a file, without the indentation that all their lines share.
fn regions(path: &str) -> BTreeMap<String, String> {
    let mut regions = BTreeMap::new();
    let mut open: Option<(String, Vec<String>)> = None;
    for line in read(path).lines() {
        match (mark(line), open.take()) {
            (Some("end"), Some((name, lines))) => {
                assert!(
                    regions.insert(name.clone(), dedented(&lines)).is_none(),
                    "{path}: {name} twice"
                );
            }
            (Some("end"), None) => panic!("{path}: an end without a beginning"),
            (Some(name), Some((outer, _))) => panic!("{path}: {name} begins within {outer}"),
            (Some(name), None) => open = Some((name.to_owned(), Vec::new())),
            (None, Some((name, mut lines))) => {
                lines.push(line.to_owned());
                open = Some((name, lines));
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "{path}: {open:?} has no end");
    regions
}

fn dedented(lines: &[String]) -> String {
    let written = lines.iter().filter(|line| !line.trim().is_empty());
    let indentation = written.map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
    lines.iter().map(|line| format!("{}\n", line.get(indentation..).unwrap_or(""))).collect()
}

/// The page with each block's code as the examples have it, and the regions that it quotes.
fn rewritten(page: &str) -> (String, BTreeSet<(String, String)>) {
    let text = read(page);
    let mut lines = text.lines().peekable();
    let (mut result, mut quoted) = (String::new(), BTreeSet::new());
    let mut source: Option<(String, String)> = None;
    while let Some(line) = lines.next() {
        result += &format!("{line}\n");
        if let Some(comment) = line.strip_prefix("<!-- ").and_then(|rest| rest.strip_suffix(" -->"))
        {
            let (file, region) = comment.split_once(": ").expect("FILE: REGION");
            source = Some((file.to_owned(), region.to_owned()));
        } else if line.starts_with("```") {
            if source.is_none() && lines.peek().is_some_and(|first| first.starts_with(">>>")) {
                let session = lines.by_ref().take_while(|line| !line.starts_with("```"));
                session.for_each(|line| result += &format!("{line}\n"));
                result += "```\n";
                continue;
            }
            let from = source
                .take()
                .unwrap_or_else(|| panic!("{page}: a block without its source: {line}"));
            let code = regions(&from.0).remove(&from.1);
            result += &code.unwrap_or_else(|| panic!("{page}: there is no {from:?}"));
            let end = lines.by_ref().find(|line| line.starts_with("```"));
            result += &format!("{}\n", end.expect("the block ends"));
            quoted.insert(from);
        } else {
            assert!(source.is_none(), "{page}: no block follows {source:?}");
        }
    }
    (result, quoted)
}

#[test]
fn code_in_the_pages_is_that_of_the_examples() {
    for page in PAGES {
        let (wanted, _) = rewritten(page);
        if std::env::var_os("NETMESH_WRITE_PAGES").is_some() {
            fs::write(root().join(page), &wanted).expect("the page can be written");
        }
        let page_text = read(page);
        for (number, (is, should)) in page_text.lines().zip(wanted.lines()).enumerate() {
            assert_eq!(is, should, "{page}, line {}; see the top of tests/pages.rs", number + 1);
        }
        assert_eq!(page_text.len(), wanted.len(), "{page} ends otherwise");
    }
}

#[test]
fn every_region_of_the_examples_is_in_a_page() {
    let quoted: BTreeSet<_> = PAGES.iter().flat_map(|page| rewritten(page).1).collect();
    let mut found = 0;
    for directory in EXAMPLES {
        for entry in fs::read_dir(root().join(directory)).expect("the examples are there") {
            let path = entry.expect("an entry").path();
            let relative = relative(&path);
            for region in regions(&relative).into_keys() {
                found += 1;
                assert!(
                    quoted.contains(&(relative.clone(), region.clone())),
                    "{relative}: {region}"
                );
            }
        }
    }
    assert_eq!(found, quoted.len());
}

/// The documents of the project: those at the root, in docs and its reports, and in bench.
fn documents() -> Vec<String> {
    let directories = ["", "docs", "docs/reports", "bench"].map(|name| root().join(name));
    let entries = directories.iter().flat_map(|path| fs::read_dir(path).expect("a directory"));
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let pages = paths.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    pages.map(|path| relative(&path)).collect()
}

/// The anchors of a document's headings, as they are usually made of them.
fn anchors(path: &str) -> BTreeSet<String> {
    let text = read(path);
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| -> String {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept =
            words.chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
        kept.map(|letter| if letter == ' ' { '-' } else { letter }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn links_lead_somewhere() {
    let mut links = 0;
    for document in documents() {
        // Without code, which has brackets of its own.
        let text: String = read(&document).split("```").step_by(2).collect();
        let directory = root().join(&document).parent().expect("a directory").to_owned();
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if target.contains("://") {
                continue;
            }
            links += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = directory.join(file);
            assert!(file.is_empty() || path.exists(), "{document} links to {target}");
            let page = if file.is_empty() { document.clone() } else { resolved(&document, file) };
            let is_there = anchor.is_empty() || anchors(&page).contains(anchor);
            assert!(is_there, "{document} links to {target}, which has no such heading");
        }
    }
    assert!(links > 50, "{links} links");
}

#[test]
fn the_glossary_has_each_word_once_and_in_order() {
    let text = read("docs/glossary.md");
    let rows = text.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells: Vec<Vec<&str>> = rows.map(|line| line.split('|').map(str::trim).collect()).collect();
    assert!(cells.len() > 50, "{} words", cells.len());
    for row in &cells {
        // Nothing before the first bar and after the last, and between them word, meaning and
        // place.
        assert_eq!(row.len(), 5, "{row:?}");
        assert!(row[1..4].iter().all(|cell| !cell.is_empty()), "{row:?}");
        assert!(row[2].ends_with('.'), "{}: the meaning is a sentence", row[1]);
    }
    let words: Vec<String> = cells.iter().map(|row| row[1].to_lowercase()).collect();
    for pair in words.windows(2) {
        assert!(pair[0] < pair[1], "{} stands before {}", pair[0], pair[1]);
    }
}

/// The path from the root of what `document` links to.
fn resolved(document: &str, link: &str) -> String {
    let mut parts: Vec<&str> = document.split('/').collect();
    parts.pop();
    for part in link.split('/') {
        match part {
            ".." => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

fn relative(path: &Path) -> String {
    let below = path.strip_prefix(root()).expect("a path of the repository");
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}
