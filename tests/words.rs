//! Doc comments are sentences that stand alone: none begins with a word that makes it a fragment or
//! leans on its neighbour, and those of functions begin with a verb in the third person.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Words that no doc comment, and no later paragraph of one, begins with.
const OPENERS: &[&str] =
    &["What", "Whether", "Of", "By", "As", "Those", "Where", "Which", "How", "That", "Like", "..."];

/// Beginnings of two words that lean on a neighbour. Those with "As" are refused already.
const LEANING: &[&str] = &["The same"];

/// Words that end as a verb in the third person does, and are none at the beginning of a comment.
const NO_VERBS: &str = "\
    Across Always Angles Arguments Arrays As Attributes Axes Balls Besides Bits Bounds Bytes \
    Cages Cells Centres Chords Circumcentres Circumradius Clusters Columns Coordinates Corners \
    Curves D-balls Denominators Diameters Differences Digits Dimensions Directions Distances \
    Domains Doubles Edges Elements Entries Errors Faces Facets Files Formats Ids In-radius \
    Indices Inputs Integers Its Kinds Lengths Less Limbs Lines Magnitudes Messages Neighbours \
    Nodes Numbers Numerators Options Others Out-radius Pairs Perhaps Permanents Pieces Plus \
    Points Positions Powers Products Radius Ranges Ranks Ridges Rows Seconds Segments \
    Simplices Sizes Slivers Solutions Sometimes Subsegments Tens Terms This Threads \
    Thresholds Thus Triangles Units Unless Us Values Vertices Violations Volumes Was Weights \
    Words Zeros";

/// Folders whose comments are still to be rewritten, with the number of their faults. The numbers
/// only shrink; a folder without faults leaves the list. Folders below one have their own entries.
const EXEMPT: &[(&str, usize)] = &[];

/// Folders whose sources are read, and the headers that are written by hand.
const FOLDERS: &[&str] = &["src", "mpi/src", "cli/src", "python/src", "fuzz/src", "include"];

/// Folders of tests and benches, where the comment of a function may begin with a noun.
const TEST_FOLDERS: &[&str] = &[
    "tests",
    "bench",
    "cli/tests",
    "mpi/tests",
    "mpi/examples",
    "cpp_tests",
    "examples",
    "fuzz/fuzz_targets",
];

/// A doc comment: consecutive lines of one kind, without the signs that make them one.
#[derive(Debug, PartialEq)]
struct Comment {
    /// Number of its first line in the file, from 1.
    line: usize,
    text: Vec<String>,
    /// True if it documents a function that is no test.
    documents_function: bool,
}

/// A beginning that the rules refuse.
#[derive(Debug, PartialEq)]
struct Fault {
    line: usize,
    word: String,
    rule: &'static str,
}

/// Returns the text after the sign of a doc comment in Rust, and the sign.
fn documentation(line: &str) -> Option<(&'static str, &str)> {
    let line = line.trim_start();
    let sign = ["///", "//!"].into_iter().find(|sign| line.starts_with(sign))?;
    let text = &line[sign.len()..];
    (!text.starts_with('/')).then_some((sign, text))
}

/// Returns the doc comments of a source in Rust.
fn comments_of_rust(source: &str) -> Vec<Comment> {
    let lines: Vec<&str> = source.lines().collect();
    let mut comments = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        let Some((sign, _)) = documentation(lines[at]) else {
            at += 1;
            continue;
        };
        let is_of_block =
            |line: &&&str| documentation(line).is_some_and(|(other, _)| other == sign);
        let block: Vec<&str> = lines[at..].iter().take_while(is_of_block).copied().collect();
        let text = block.iter().filter_map(|line| documentation(line));
        let text = text.map(|(_, text)| text.trim().to_owned()).collect();
        let end = at + block.len();
        let documents_function = sign == "///" && is_function(&lines[end..]);
        comments.push(Comment { line: at + 1, text, documents_function });
        at = end;
    }
    comments
}

/// Returns true if the lines begin with a function that is no test, after its attributes.
fn is_function(lines: &[&str]) -> bool {
    let mut depth = 0;
    for line in lines.iter().map(|line| line.trim()) {
        let is_attribute = depth > 0 || line.starts_with("#[");
        if !is_attribute && !line.starts_with("//") {
            return is_head_of_function(line);
        }
        if is_attribute {
            if line.starts_with("#[test]") {
                return false;
            }
            let brackets = |bracket: char| line.matches(bracket).count();
            depth = (depth + brackets('[')).saturating_sub(brackets(']'));
        }
    }
    false
}

/// Returns true if `fn` follows words that may stand before it.
fn is_head_of_function(line: &str) -> bool {
    for word in line.split_whitespace() {
        match word {
            "fn" => return true,
            "const" | "unsafe" | "async" | "extern" | "\"C\"" | "\"C-unwind\"" => {}
            _ if word == "pub" || word.starts_with("pub(") || word.ends_with(')') => {}
            _ => return false,
        }
    }
    false
}

/// Returns the comments of a header in C++: consecutive lines that begin with `//`.
fn comments_of_header(source: &str) -> Vec<Comment> {
    let mut comments: Vec<Comment> = Vec::new();
    let mut is_open = false;
    for (at, line) in source.lines().enumerate() {
        let text = line.trim_start().strip_prefix("//");
        if let Some(text) = text {
            if !is_open {
                comments.push(Comment {
                    line: at + 1,
                    text: Vec::new(),
                    documents_function: false,
                });
            }
            let text = text.trim_start_matches(['/', '!']);
            let is_code = text.starts_with("    ");
            let text = if is_code { "" } else { text.trim() };
            comments.last_mut().expect("the comment that is open").text.push(text.to_owned());
        }
        is_open = text.is_some();
    }
    comments
}

/// Returns the beginnings of a comment's paragraphs, with the numbers of their lines in it.
/// Headings, lists, tables and code are none.
fn paragraphs(text: &[String]) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut in_code = false;
    let mut is_first = true;
    for (at, line) in text.iter().enumerate() {
        if line.starts_with("```") {
            in_code = !in_code;
        } else if is_first && !in_code && !line.is_empty() && !is_marked(line) {
            found.push((at, line.as_str()));
        }
        is_first = line.is_empty() || line.starts_with('#') || line.starts_with("```");
    }
    found
}

/// Returns true if a line is of a heading, a list, a table or a command.
fn is_marked(line: &str) -> bool {
    ["#", "- ", "* ", "|", "\\", "@"].iter().any(|sign| line.starts_with(sign))
}

/// Returns the first word of a paragraph, without the sign after it; `code` stands for all code.
/// The label of functions that all ranks call is skipped.
fn first_word(paragraph: &str) -> &str {
    if paragraph.starts_with('`') || paragraph.starts_with("[`") {
        return "`code`";
    }
    let mut words = paragraph.split_whitespace();
    let mut word = words.next().unwrap_or_default();
    if word == "Collective." {
        word = words.next().unwrap_or(word);
    }
    if word.starts_with("...") { "..." } else { word.trim_end_matches([',', ':', ';', '.', '!']) }
}

/// Returns true if a word may be a verb in the third person.
fn is_verb(word: &str) -> bool {
    let is_plain = word.chars().all(|letter| letter.is_ascii_alphabetic() || letter == '-');
    is_plain
        && word.ends_with('s')
        && !word.ends_with("ss")
        && NO_VERBS.split(' ').all(|noun| noun != word)
}

/// Returns the rule that the beginning of a paragraph breaks.
fn broken_rule(paragraph: &str, needs_verb: bool) -> Option<&'static str> {
    let word = first_word(paragraph);
    if OPENERS.iter().any(|opener| opener.eq_ignore_ascii_case(word)) {
        return Some("begins no sentence that stands alone");
    }
    if LEANING.iter().any(|words| paragraph.starts_with(words)) {
        return Some("leans on a neighbour");
    }
    (needs_verb && !is_verb(word)).then_some("is no verb in the third person")
}

/// Returns the faults of comments.
fn faults(comments: &[Comment]) -> Vec<Fault> {
    let mut found = Vec::new();
    for comment in comments {
        for (number, (at, paragraph)) in paragraphs(&comment.text).into_iter().enumerate() {
            let needs_verb = comment.documents_function && number == 0;
            if let Some(rule) = broken_rule(paragraph, needs_verb) {
                let word = first_word(paragraph).to_owned();
                found.push(Fault { line: comment.line + at, word, rule });
            }
        }
        let end = comment.text.last().map_or("", String::as_str);
        if end.ends_with("...") || end.ends_with([',', ';']) {
            let line = comment.line + comment.text.len() - 1;
            let word = end.rsplit(' ').next().unwrap_or_default().to_owned();
            found.push(Fault { line, word, rule: "ends in the midst of a sentence" });
        }
    }
    found
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the comments of all sources of a tree by their paths, with slashes.
fn comments_of_tree(root: &Path) -> BTreeMap<String, Vec<Comment>> {
    let mut found = BTreeMap::new();
    let named = FOLDERS.iter().chain(TEST_FOLDERS);
    let mut folders: Vec<PathBuf> = named.map(|folder| root.join(folder)).collect();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                // Cargo may have built there.
                if !path.ends_with("target") {
                    folders.push(path);
                }
                continue;
            }
            let read = match path.extension().and_then(|extension| extension.to_str()) {
                Some("rs") => comments_of_rust,
                Some("hpp" | "cpp") => comments_of_header,
                _ => continue,
            };
            let source = fs::read_to_string(&path).expect("a source");
            let (path, mut comments) = (below(root, &path), read(&source));
            if TEST_FOLDERS.iter().any(|folder| Path::new(&path).starts_with(folder)) {
                comments.iter_mut().for_each(|comment| comment.documents_function = false);
            }
            found.insert(path, comments);
        }
    }
    found
}

fn below(root: &Path, path: &Path) -> String {
    let below = path.strip_prefix(root).expect("a path below the root");
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// Returns the exempt folder that a file is in; folders below it are not exempt with it.
fn exemption(path: &str) -> Option<&'static str> {
    let (own, _) = path.rsplit_once('/')?;
    EXEMPT.iter().map(|(folder, _)| *folder).find(|folder| *folder == own)
}

#[test]
fn doc_comments_begin_as_sentences_do() {
    let mut faults_of_exempt: BTreeMap<&str, usize> = BTreeMap::new();
    let mut refused = Vec::new();
    for (path, comments) in comments_of_tree(&root()) {
        let faults = faults(&comments);
        match exemption(&path) {
            Some(folder) => *faults_of_exempt.entry(folder).or_default() += faults.len(),
            None => {
                refused.extend(faults.into_iter().map(|fault| {
                    format!("{path}:{}: \"{}\" {}", fault.line, fault.word, fault.rule)
                }))
            }
        }
    }
    for &(folder, most) in EXEMPT {
        let count = faults_of_exempt.get(folder).copied().unwrap_or(0);
        if count > most {
            refused.push(format!("{folder}: {count} faults, where there were {most}"));
        }
    }
    assert!(refused.is_empty(), "doc comments:\n{}", refused.join("\n"));
}

/// Prints a table: how many comments begin with a word. `NETMESH_WORDS_OF` names another tree.
#[test]
#[ignore = "prints a table"]
fn print_opening_words() {
    let tree = std::env::var_os("NETMESH_WORDS_OF").map_or_else(root, PathBuf::from);
    let mut words: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    let mut folders: BTreeMap<String, [usize; 3]> = BTreeMap::new();
    for (path, comments) in comments_of_tree(&tree) {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        let [openers, verbs, all] = folders.entry(folder).or_default();
        *all += comments.len();
        for fault in faults(&comments) {
            *(if fault.rule.contains("verb") { &mut *verbs } else { &mut *openers }) += 1;
        }
        for comment in &comments {
            for (number, (_, paragraph)) in paragraphs(&comment.text).into_iter().enumerate() {
                let (first, later) = words.entry(first_word(paragraph).to_owned()).or_default();
                *(if number == 0 { first } else { later }) += 1;
            }
        }
    }
    println!("{:40} {:>8} {:>8} {:>8}", "folder", "openers", "no verb", "comments");
    for (folder, [openers, verbs, all]) in &folders {
        println!("{folder:40} {openers:8} {verbs:8} {all:8}");
    }
    let sum = |column: usize| folders.values().map(|counts| counts[column]).sum::<usize>();
    println!("{:40} {:8} {:8} {:8}\n", "all", sum(0), sum(1), sum(2));
    println!("{:20} {:>8} {:>16}", "opening word", "comments", "later paragraphs");
    let mut words: Vec<_> = words.into_iter().collect();
    words.sort_by_key(|(word, (first, later))| (usize::MAX - first - later, word.clone()));
    for (word, (first, later)) in words.iter().filter(|(_, (first, later))| first + later > 2) {
        println!("{word:20} {first:8} {later:16}");
    }
}

/// Returns the words of the faults of a source in Rust.
fn words_refused(source: &str) -> Vec<String> {
    faults(&comments_of_rust(source)).into_iter().map(|fault| fault.word).collect()
}

#[test]
fn planted_fragments_are_found() {
    for opener in OPENERS.iter().chain(LEANING) {
        let source = format!("    /// {opener} it is.\n    pub size: f64,\n");
        assert_eq!(words_refused(&source).len(), 1, "{opener}");
        let later = format!("//! Number of points.\n//!\n//! {opener} it is.\n");
        assert_eq!(words_refused(&later).len(), 1, "{opener} in a later paragraph");
    }
    let source =
        "/// `Number` of points.\n\n/// what a cell is,\n/// whether or not.\nstruct Cell;\n";
    let found = faults(&comments_of_rust(source));
    assert_eq!((found.len(), found[0].line, found[0].word.as_str()), (1, 3, "what"));
}

#[test]
fn functions_without_a_verb_are_found() {
    let heads =
        ["fn", "pub(crate) fn", "pub const fn", "pub unsafe extern \"C\" fn", "#[cfg(\n[1])]\nfn"];
    for head in heads {
        for (comment, word) in [
            ("Number of points.", "Number"),
            ("Points, sorted.", "Points"),
            ("`true` for points.", "`code`"),
            ("Less than nothing.", "Less"),
        ] {
            let source = format!("/// {comment}\n#[inline]\n{head} count() -> usize {{\n");
            assert_eq!(words_refused(&source), [word], "{source}");
        }
        let source = format!("/// Counts points.\n#[inline]\n{head} count() -> usize {{\n");
        assert!(words_refused(&source).is_empty(), "{source}");
    }
}

#[test]
fn nothing_else_needs_a_verb() {
    for next in ["#[test]\nfn points_are_counted() {", "pub count: usize,", "struct Count(fn());"] {
        let source = format!("/// Number of points.\n///\n/// Points are inputs.\n{next}\n");
        assert!(words_refused(&source).is_empty(), "{source}");
    }
    let code =
        "/// Counts.\n///\n/// ```\n/// What(1);\n/// ```\n///\n/// - of lists\nfn count() {\n";
    assert!(words_refused(code).is_empty());
    assert!(words_refused("// What a common comment is.\n//// Of nobody.\n").is_empty());
}

#[test]
fn comments_of_headers_are_read() {
    let source =
        "// What it is.\nint a;\n  // Number of it.\n  //\n  // By it.\n\nint b;  // Of it.\n";
    let found = faults(&comments_of_header(source));
    let words: Vec<_> = found.iter().map(|fault| (fault.line, fault.word.as_str())).collect();
    assert_eq!(words, [(1, "What"), (5, "By")]);
}

#[test]
fn sentences_over_several_comments_are_found() {
    for end in ["and ...", "and,", "and;"] {
        let source = format!("/// Number of points\n/// {end}\npub points: usize,\n");
        assert_eq!(words_refused(&source), [end.rsplit(' ').next().expect("a word")]);
    }
}
