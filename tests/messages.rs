//! Messages tell a range as `0 to 2` or `[0, 2]`: no text between quotes has one of Rust's.

use crate::compiler::root;
use std::fs;

/// Folders whose sources make messages.
const FOLDERS: [&str; 4] = ["src", "cli/src", "mpi/src", "python/src"];

/// Returns the texts between quotes in a source, each with the number of its line. Comments have
/// none.
fn texts(source: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = source[at..].chars().next() {
        let rest = &source[at..];
        at += match first {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '"' => {
                let length = length_between_quotes(rest);
                let line = source[..at].matches('\n').count() + 1;
                found.push((line, &rest[1..length - 1]));
                length
            }
            '\'' => ["'\"'", "'\\\"'"]
                .iter()
                .find(|quote| rest.starts_with(**quote))
                .map_or(1, |q| q.len()),
            _ => first.len_utf8(),
        };
    }
    found
}

/// Returns the length of a text with the quotes that it begins and ends with.
fn length_between_quotes(text: &str) -> usize {
    let mut is_escaped = false;
    let end = text[1..].find(|letter| {
        let ends = !is_escaped && letter == '"';
        is_escaped = !is_escaped && letter == '\\';
        ends
    });
    end.expect("a text that ends") + 2
}

/// Returns true if a text has a range of Rust's between numbers, or between what becomes one.
fn has_range(text: &str) -> bool {
    let is_end = |letter: char| letter.is_ascii_digit() || letter == '{' || letter == '}';
    text.contains("..=")
        || text.match_indices("..").any(|(at, dots)| {
            text[..at].ends_with(is_end) && text[at + dots.len()..].starts_with(is_end)
        })
}

/// Returns the ranges of Rust's in the texts of a source, each after the number of its line.
fn ranges(source: &str) -> Vec<String> {
    let with_range = texts(source).into_iter().filter(|(_, text)| has_range(text));
    with_range.map(|(line, text)| format!("{line}: {text}")).collect()
}

#[test]
fn ranges_are_told_in_words() {
    let mut found = Vec::new();
    let mut folders: Vec<_> = FOLDERS.iter().map(|folder| root().join(folder)).collect();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let source = fs::read_to_string(&path).expect("a source");
                let name = path.strip_prefix(root()).expect("a path below the root").display();
                found.extend(ranges(&source).iter().map(|text| format!("{name}:{text}")));
            }
        }
    }
    assert!(found.is_empty(), "ranges of Rust's in messages:\n{}", found.join("\n"));
}

#[test]
fn planted_ranges_are_found() {
    let refused =
        "let quote = '\"';\n// \"0..=1\"\nfail(\"it must be \\\n    in 0..=2\", \"{low}..{high}\")";
    assert_eq!(ranges(refused), ["3: it must be \\\n    in 0..=2", "4: {low}..{high}"]);
    let right = "let all = 0..=2; say(\"../a.xyz ... 0 to 2, [0, 2] \\\" \", 0..3)";
    assert!(ranges(right).is_empty());
}
