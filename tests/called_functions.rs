//! Each function of `netmesh.h`, and each of the class of `netmesh.hpp`, is called by a test in C
//! or C++: these alone go the way that a caller's program goes.

use crate::compiler::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Returns a file's code: comments, and what stands between quotes, become blanks.
fn code_of(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match rest {
            _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            _ if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            // A mark within a number separates its digits.
            _ if first == '"' || first == '\'' && !code.ends_with(char::is_alphanumeric) => {
                quoted(rest)
            }
            _ => 0,
        };
        if length == 0 {
            code.push(first);
        } else {
            code.push(' ');
        }
        rest = &rest[length.max(first.len_utf8())..];
    }
    code
}

/// Returns the length of a literal with its quotes.
fn quoted(text: &str) -> usize {
    let mut is_escaped = false;
    let inner = text[1..].find(|letter: char| {
        let ends = !is_escaped && text.starts_with(letter);
        is_escaped = !is_escaped && letter == '\\';
        ends
    });
    inner.map_or(text.len(), |inner| inner + 2)
}

/// Returns the names in some code, each with the code before and behind it.
fn names(code: &str) -> Vec<(&str, &str, &str)> {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(start) = code[at..].find(is_part).map(|start| at + start) {
        let end =
            code[start..].find(|letter| !is_part(letter)).map_or(code.len(), |end| start + end);
        found.push((&code[..start], &code[start..end], &code[end..]));
        at = end;
    }
    found
}

/// Returns the functions that the C header declares.
fn functions_of(header: &str) -> BTreeSet<String> {
    let code = code_of(header);
    let declared = names(&code);
    let declared = declared
        .iter()
        .filter(|(_, name, behind)| name.starts_with("nm_") && behind.starts_with('('));
    declared.map(|(_, name, _)| (*name).to_owned()).collect()
}

/// Returns the public functions of a class: its code is indented by four blanks.
fn methods_of(header: &str, class: &str) -> BTreeSet<String> {
    let code = code_of(header);
    let start = code.find(&format!("\nclass {class} ")).expect("the header has the class");
    let body = &code[start..];
    let ends = ["\nprivate:", "\nprotected:"].map(|word| body.find(word));
    let body = &body[..ends.into_iter().flatten().min().expect("a part that is not public")];
    let begin = |line: &&str| line.starts_with("    ") && !line.starts_with("     ");
    let named = body.lines().filter(begin).filter_map(|line| {
        names(line).iter().find(|(_, _, behind)| behind.starts_with('(')).map(|(_, name, _)| *name)
    });
    named.filter(|name| *name != class).map(str::to_owned).collect()
}

/// Returns the base of a class.
fn base_of<'a>(header: &'a str, class: &str) -> &'a str {
    let (_, head) = header.split_once(&format!("\nclass {class} : ")).expect("a base");
    let (head, _) = head.split_once(" {").expect("the body");
    head.rsplit([' ', ':']).next().expect("the name of the base")
}

/// Returns the public functions of `netmesh::mesh`, with those of its bases. Each base has a header
/// of its name; `getters`, the last, has no public function.
fn methods_of_mesh() -> BTreeSet<String> {
    let mut header = read("include/netmesh.hpp");
    let mut class = "mesh".to_owned();
    let mut methods = BTreeSet::new();
    while class != "getters" {
        methods.append(&mut methods_of(&header, &class));
        class = base_of(&header, &class).to_owned();
        header = read(&format!("include/netmesh/{class}.hpp"));
    }
    methods
}

/// Returns the sources of the tests in C and C++, as code.
fn sources() -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = ["cpp_tests", "tests/c"].map(|folder| root().join(folder)).to_vec();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the folder can be read") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if is_source(&path) {
                let text = std::fs::read_to_string(&path).expect("a source is text");
                found.push((path, code_of(&text)));
            }
        }
    }
    found
}

fn is_source(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|extension| ["c", "cpp", "h", "hpp"].contains(&extension))
}

/// Returns the functions of the C header that some code calls, or hands to what calls them.
fn called_functions(code: &str) -> impl Iterator<Item = &str> {
    names(code).into_iter().filter_map(|(_, name, _)| name.starts_with("nm_").then_some(name))
}

/// Returns the names that some code calls as functions of a class.
fn called_methods(code: &str) -> impl Iterator<Item = &str> {
    names(code).into_iter().filter_map(|(before, name, behind)| {
        let belongs = [".", "->", "::"].iter().any(|sign| before.ends_with(sign));
        (belongs && behind.starts_with('(')).then_some(name)
    })
}

/// Returns what of `declared` no source calls.
fn not_called<'a, I: Iterator<Item = &'a str>>(
    declared: BTreeSet<String>,
    sources: &'a [(PathBuf, String)],
    called: impl Fn(&'a str) -> I,
) -> Vec<String> {
    let called: BTreeSet<&str> = sources.iter().flat_map(|(_, code)| called(code)).collect();
    declared.into_iter().filter(|name| !called.contains(name.as_str())).collect()
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).expect("the header can be read")
}

#[test]
fn a_test_calls_each_function_of_the_c_header() {
    let declared = functions_of(&read("include/netmesh.h"));
    let exported = read("cpp_tests/symbols.txt");
    let exported: BTreeSet<String> = exported.split_whitespace().map(str::to_owned).collect();
    assert_eq!(declared, exported, "the functions are found in the header");
    let left = not_called(declared, &sources(), called_functions);
    assert!(left.is_empty(), "no test in C or C++ calls {left:?}");
}

/// A function that ends with an exception calls its partner, `try_` and its name, which so needs no
/// call of its own.
#[test]
fn a_test_calls_each_function_of_the_class() {
    let declared = methods_of_mesh();
    let of_each_base = ["try_run", "release", "to_string", "set_facets", "locate", "faces", "hull"];
    assert!(declared.len() > 100 && of_each_base.iter().all(|name| declared.contains(*name)));
    let partner = |name: &String| name.strip_prefix("try_").map(str::to_owned);
    let alone = |name: &String| partner(name).is_none_or(|other| !declared.contains(&other));
    let wanted = declared.iter().filter(|name| alone(name)).cloned().collect();
    let left = not_called(wanted, &sources(), called_methods);
    assert!(left.is_empty(), "no test in C++ calls {left:?}");
}

#[test]
fn a_call_that_is_taken_away_is_missed() {
    let header =
        "/* nm_none(); */ NM_API nm_status nm_run(struct nm_mesh *mesh);\nint nm_two(void);";
    let declared = functions_of(header);
    assert_eq!(declared.iter().collect::<Vec<_>>(), ["nm_run", "nm_two"]);
    let left = |code: &str| {
        let sources = [(PathBuf::new(), code_of(code))];
        not_called(declared.clone(), &sources, called_functions)
    };
    assert!(left("nm_run(mesh); fetch(nm_two);").is_empty());
    assert_eq!(left("nm_run(mesh); // nm_two();\n f(\"nm_two(\\\"\");"), ["nm_two"]);
    assert_eq!(left("/* nm_run(mesh);\n */ nm_two(1'000, '\"');"), ["nm_run"]);
    let class = "x\nclass mesh {\n    mesh(int x);\n    int *get() {\n        go();\n    }\n\
                 private:\n    hide();";
    assert_eq!(methods_of(class, "mesh").into_iter().collect::<Vec<_>>(), ["get"]);
    assert_eq!(base_of("\nclass mesh : public detail::writers {\n", "mesh"), "writers");
    assert_eq!(
        called_methods("get(); a.get(); b->put(); c.size;").collect::<Vec<_>>(),
        ["get", "put"]
    );
}
