//! The reader of files on a small module of text: it sees the circles and the uses upwards that are
//! planted there.

use super::files::Graph;
use super::uses::Source;

const STATE: &str = "
    use crate::netmesh::state::lists::Lists;
    pub struct State { pub lists: Lists, pub count: usize }
    pub struct Mesher { pub state: State }
";

const LISTS: &str = "
    pub struct Lists(Vec<u32>);
    impl Lists {
        pub fn entries(&self) -> usize { self.0.len() }
        pub fn limit(&mut self) {}
    }
";

const QUALITY: &str = "
    use crate::netmesh::state::State;
    impl State { pub fn is_bad(&self) -> bool { self.lists.entries() > self.count } }
";

const CAGE: &str = "
    use crate::netmesh::state::Mesher;
    impl Mesher {
        pub fn new_cage(&mut self) { if self.state.is_bad() { self.release_cage() } }
        pub fn limit(&mut self) {}
    }
";

const RELEASE: &str = "
    use crate::netmesh::state::Mesher;
    impl Mesher { pub fn release_cage(&mut self) { self.state.lists.limit(); } }
";

/// The graph of that module if `planted` stands in file `place`, below what is there.
fn graph(place: &str, planted: &str) -> Graph {
    let files = [
        ("lib.rs", "mod netmesh;"),
        ("netmesh/mod.rs", "mod state; mod questions; mod operations; use state::Mesher;"),
        ("netmesh/state/mod.rs", STATE),
        ("netmesh/state/lists.rs", LISTS),
        ("netmesh/questions/quality.rs", QUALITY),
        ("netmesh/operations/cage.rs", CAGE),
        ("netmesh/operations/release.rs", RELEASE),
    ];
    let sources = files.map(|(path, text)| {
        let planted = if path == place { planted } else { "" };
        Source::parse(path, &format!("{text}{planted}"))
    });
    Graph::of(&sources, "netmesh")
}

fn complaints(place: &str, planted: &str) -> Vec<String> {
    let folders = ["state", "questions", "operations"].map(str::to_owned);
    graph(place, planted).complaints("netmesh", &folders)
}

#[test]
fn a_module_in_order_gives_no_complaint() {
    assert!(complaints("", "").is_empty());
    assert!(graph("", "").method_circles().is_empty());
    // Its own method, and not that of a list.
    let own = "impl Mesher { fn limit_all(&mut self) { self.limit() } }";
    assert!(complaints("netmesh/operations/release.rs", own).len() == 1);
    assert!(complaints("netmesh/operations/cage.rs", own).is_empty());
    let for_tests = "#[cfg(test)] mod tests { use crate::netmesh::operations::cage; }";
    assert!(complaints("netmesh/state/lists.rs", for_tests).is_empty());
}

#[test]
fn a_call_upwards_is_seen() {
    for planted in [
        "impl State { fn f(mesher: &mut Mesher) { mesher.release_cage() } }",
        "impl Mesher { fn f(&mut self) { self.release_cage() } }",
        "impl Mesher { fn f(&mut self) { assert!(self.release_cage() == (), \"{}\", 1); } }",
        "impl Mesher { fn f(&mut self) { (0..2).for_each(|_| self.release_cage()) } }",
        "impl Mesher { fn f() -> fn(&mut Self) { Mesher::release_cage } }",
        "fn f(it: &mut Box<Mesher>) { let it = it; it.release_cage() }",
    ] {
        let found = complaints("netmesh/questions/quality.rs", planted);
        let is_it = |text: &String| {
            text.contains("questions/quality.rs is below netmesh/operations/release.rs")
        };
        assert!(found.iter().any(is_it), "{planted}: {found:?}");
    }
}

#[test]
fn an_import_upwards_is_seen() {
    for planted in [
        "use crate::netmesh::questions::quality;",
        "use super::super::questions::quality as other;",
        "fn f() { crate::netmesh::questions::quality::f() }",
    ] {
        let found = complaints("netmesh/state/lists.rs", planted);
        let is_it =
            |text: &String| text.contains("state/lists.rs is below netmesh/questions/quality.rs");
        assert!(found.iter().any(is_it), "{planted}: {found:?}");
    }
}

/// Lists and cages have a method of this name: a call is taken for the one that is used anyway.
#[test]
fn a_call_that_may_be_of_several_methods_is_one_of_a_file_that_is_used() {
    let planted = "impl State { fn f(it: impl Fn() -> Lists) { let it = it(); it.limit() } }";
    assert!(complaints("netmesh/questions/quality.rs", planted).is_empty());
    let planted = "fn f(it: u32) { let it = it + 1; it.limit() }";
    let found = complaints("netmesh/questions/other.rs", planted);
    assert!(found.is_empty(), "no file of that name: {found:?}");
}

#[test]
fn a_name_that_the_folders_pass_on_upwards_belongs_where_it_is_defined() {
    assert!(complaints("netmesh/questions/quality.rs", "use crate::netmesh::Mesher;").is_empty());
}

#[test]
fn a_circle_in_one_folder_is_seen() {
    let planted = "impl Mesher { fn grow_cage(&mut self) { self.new_cage() } }";
    let found = complaints("netmesh/operations/release.rs", planted);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("cage.rs") && found[0].contains("release.rs"), "{found:?}");
    let planted = "use super::State; ";
    let found = complaints("netmesh/state/lists.rs", planted);
    assert!(found.len() == 1 && found[0].ends_with("depend on each other"), "{found:?}");
}

#[test]
fn a_circle_of_methods_is_seen() {
    let planted = "impl Mesher { fn grow_cage(&mut self) { self.new_cage_there() }
                   fn new_cage_there(&mut self) { self.grow_cage() } }";
    let circles = graph("netmesh/operations/release.rs", planted).method_circles();
    assert_eq!(circles, [["Mesher::grow_cage", "Mesher::new_cage_there"]]);
}
