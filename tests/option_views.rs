//! Views of the table of options that are checked in: the tables of `docs/options.md`, and the
//! keywords of Python with their types and descriptions. `NETMESH_WRITE_PAGES=1 cargo test
//! option_views` writes them.

use netmesh::options::{Bounds, Choices, Group, Kind, Row, TABLE, Value};
use netmesh::{Criterion, Options, Parameters};
use std::fs;
use std::path::Path;

const WIDTH: usize = 100;

/// Groups before the sizes that Python takes as arrays and functions, and those after them.
const FIRST: [Group; 3] = [Group::Quality, Group::Domain, Group::Sizes];
const LAST: [Group; 3] = [Group::Algorithm, Group::Run, Group::Paper];

fn rows(groups: &[Group]) -> impl Iterator<Item = &'static Row> {
    TABLE.iter().filter(|row| groups.contains(&row.group))
}

/// Holds the lines of a file from the one that begins with `start` to before the one that begins
/// with `end`, counted from the first line with `after`, to be `wanted`; or writes them.
fn hold(path: &str, after: &str, [start, end]: [&str; 2], wanted: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = fs::read_to_string(&file).unwrap().replace('\r', "");
    let line = |from: usize, beginning: &str| {
        let found = text[from..].find(&format!("\n{beginning}"));
        from + 1 + found.unwrap_or_else(|| panic!("{path} has no line {beginning}"))
    };
    let from = line(0, after);
    let (from, to) = (line(from - 1, start), line(from, end));
    if std::env::var_os("NETMESH_WRITE_PAGES").is_some() {
        fs::write(&file, [&text[..from], wanted, &text[to..]].concat()).unwrap();
        return;
    }
    for (is, should) in text[from..to].lines().zip(wanted.lines()) {
        assert_eq!(is, should, "{path}; see the top of tests/option_views.rs");
    }
    assert_eq!(text[from..to].len(), wanted.len(), "{path}: {start} to {end} has another length");
}

/// Returns the meanings of words, each after its word.
fn meanings(row: &Row, word: impl Fn(&netmesh::options::Word) -> String) -> String {
    let Kind::Words(words) = row.kind else { return String::new() };
    let meanings = words.iter().map(|each| format!("{}: {}", word(each), each.help));
    format!(" {}.", meanings.collect::<Vec<_>>().join("; "))
}

#[test]
fn the_tables_of_options_are_the_rows() {
    // Values that the defaults by dimension become.
    let full = Parameters::resolve(3, &Options::default()).unwrap().options();
    let mut text = String::new();
    for group in Group::ALL {
        text += &format!("### {}\n\n", group.heading());
        text += "| option | default in 2D, 3D, 4D, above | range | meaning |\n|---|---|---|---|\n";
        for row in TABLE.iter().filter(|row| row.group == group) {
            let meaning =
                row.help.to_owned() + &meanings(row, |word| format!("*{}*", word.argument));
            let mut add = |name: &str, default: String, range: String| {
                text += &format!("| {name} | {default} | {range} | {meaning} |\n");
            };
            let name = format!("`{}`", row.name);
            match row.kind {
                Kind::Number { ranges: [only], .. } => {
                    add(&name, only.default_text(), only.range_text());
                }
                Kind::Number { ranges, .. } => {
                    let named = ranges.iter().zip(Criterion::WORDS);
                    named.for_each(|(range, word): (&Bounds, _)| {
                        let name = format!("{name} ({})", word.argument);
                        add(&name, range.default_text(), range.range_text());
                    });
                }
                Kind::Whole(_) => {
                    let Value::Whole(default) = row.get(&full) else { panic!("{name}") };
                    add(&name, default.to_string(), "any".to_owned());
                }
                Kind::Switch => add(&name, row.default_text(), "off, on".to_owned()),
                Kind::Words(words) => {
                    let words: Vec<_> = words.iter().map(|word| word.argument).collect();
                    add(&name, row.default_text(), words.join(", "));
                }
            }
        }
        text += "\n";
    }
    hold("docs/options.md", "In C fields", ["### Quality", "## Choosing"], &text);
}

/// Returns the parameter of an option in Python's signature.
fn parameter(row: &Row) -> String {
    let (kind, default) = match row.kind {
        Kind::Number { .. } => ("float".to_owned(), "0.0".to_owned()),
        Kind::Whole(_) => ("int".to_owned(), row.default_text()),
        Kind::Switch => ("bool".to_owned(), "False".to_owned()),
        Kind::Words(words) => {
            let quoted: Vec<_> = words.iter().map(|word| format!("{:?}", word.word)).collect();
            (format!("Literal[{}]", quoted.join(", ")), quoted[0].clone())
        }
    };
    format!("    {}: {kind} = {default},\n", row.name)
}

/// Returns a list of the options in Python's docstring, by their groups.
fn overview() -> String {
    let line = |group: &Group| {
        let mut names: Vec<_> = rows(&[*group]).map(|row| format!("`{}`", row.name)).collect();
        let others: &[&str] = match group {
            Group::Sizes => &["`size`", "`background`"],
            Group::Run => &["`progress`"],
            _ => &[],
        };
        names.extend(others.iter().map(|name| name.to_string()));
        let text = wrapped(&format!("{}: {}.", group.heading(), names.join(", ")));
        // The first line has the dash, the others are as far in as its text.
        text.replacen("        ", "    - ", 1).replace("        ", "      ")
    };
    Group::ALL.iter().map(line).collect::<String>() + "\n"
}

/// Returns the description of an option in Python's docstring.
fn description(row: &Row) -> String {
    let kind = match row.kind {
        Kind::Number { .. } => "float".to_owned(),
        Kind::Whole(_) => "int".to_owned(),
        Kind::Switch => "bool".to_owned(),
        Kind::Words(words) => {
            let words = words.iter().map(|word| format!("'{}'", word.word));
            format!("{{{}}}", words.collect::<Vec<_>>().join(", "))
        }
    };
    let mut help = row.help.to_owned() + &meanings(row, |word| format!("'{}'", word.word));
    let bounds = row.bounds_text();
    if let Some(first) = bounds.chars().next() {
        help += &format!(" {}{}.", first.to_uppercase(), &bounds[first.len_utf8()..]);
    }
    format!("    {} : {kind}\n{}", row.name, wrapped(&help))
}

/// Returns a text in lines of Python's docstring.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::from("       ")];
    for word in text.split_whitespace() {
        if lines[lines.len() - 1].len() + 1 + word.len() > WIDTH {
            lines.push(String::from("       "));
        }
        let line = lines.last_mut().expect("there is one");
        *line += &format!(" {word}");
    }
    lines.join("\n") + "\n"
}

#[test]
fn pythons_keywords_are_the_rows() {
    let file = "python/netmesh/_mesh.py";
    let signature = |groups: &[Group]| rows(groups).map(parameter).collect::<String>();
    let ends = [["    criterion: ", "    size: "], ["    output: ", "    progress: "]];
    hold(file, "def mesh(", ends[0], &signature(&FIRST));
    hold(file, "def mesh(", ends[1], &signature(&LAST));
    hold(file, "def mesh(", ["    - Quality: ", "    Parameters"], &overview());
    let descriptions = |groups: &[Group]| rows(groups).map(description).collect::<String>();
    let ends = [["    criterion : ", "    size : "], ["    output : ", "    progress : "]];
    hold(file, "    Parameters", ends[0], &descriptions(&FIRST));
    hold(file, "    Parameters", ends[1], &descriptions(&LAST));
}
