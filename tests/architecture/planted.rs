//! The checker on a small crate of text: it sees what is planted there.

use super::uses::{Layers, Source, uses};

const LIBRARY: &str = "
    pub mod mesh;
    mod netmesh;
    pub mod validate;
    pub use mesh::Mesh;
    pub use netmesh::{Parameters as Settings, run};
";

const MESH: &str = "
    pub struct Mesh(Vec<f64>);
    impl Mesh { pub fn points(&self) -> &[f64] { &self.0 } }
";

const NETMESH: &str = "
    use crate::mesh::Mesh;
    pub struct Parameters;
    impl Mesh { pub fn closes(&self) -> bool { self.points().is_empty() } }
    pub fn run() -> Parameters { Parameters }
";

const VALIDATE: &str = "
    mod cages;
    use crate::mesh::Mesh;
    pub fn validate(mesh: &Mesh) -> bool { mesh.points().len() > 1 }
    #[cfg(test)]
    mod tests { use crate::netmesh::run; }
";

/// Returns the uses between the modules of that crate if `planted` stands in `validate/cages.rs`.
fn uses_with(planted: &str) -> Layers {
    uses(&[
        Source::parse("lib.rs", LIBRARY),
        Source::parse("mesh.rs", MESH),
        Source::parse("netmesh.rs", NETMESH),
        Source::parse("validate/mod.rs", VALIDATE),
        Source::parse("validate/cages.rs", planted),
    ])
}

fn used_by_validate(planted: &str) -> Vec<String> {
    uses_with(planted)["validate"].iter().cloned().collect()
}

#[test]
fn a_crate_in_order_has_no_use_too_many() {
    let uses = uses_with("use super::validate; fn f() { assert!(1 < 2, \"{}\", 3); }");
    assert!(uses["mesh"].is_empty());
    assert_eq!(uses["netmesh"].iter().collect::<Vec<_>>(), ["mesh"]);
    assert_eq!(uses["validate"].iter().collect::<Vec<_>>(), ["mesh"]);
}

#[test]
fn a_use_past_the_root_by_super_is_seen() {
    for planted in [
        "use super::super::netmesh::run;",
        "fn f() { super::super::netmesh::run(); }",
        "fn f() { assert!(super::super::netmesh::run().is_fine(), \"{}\", 1); }",
        "mod inner { use super::super::super::{mesh::Mesh, netmesh as other}; }",
    ] {
        assert_eq!(used_by_validate(planted), ["mesh", "netmesh"], "{planted}");
    }
}

#[test]
fn a_use_of_what_the_root_re_exports_is_seen() {
    for planted in [
        "use crate::run;",
        "use crate::{Mesh, Settings};",
        "type Of = Vec<crate::Settings>;",
        "fn f() -> bool { matches!(1, x if crate::run().holds(x)) }",
    ] {
        assert_eq!(used_by_validate(planted), ["mesh", "netmesh"], "{planted}");
    }
}

#[test]
fn a_call_of_a_method_that_another_module_defines_is_seen() {
    for planted in [
        "fn f(mesh: &super::Mesh) -> bool { mesh.closes() }",
        "fn f(mesh: &super::Mesh) { assert!(mesh.closes()); }",
        "fn f(mesh: &super::Mesh) -> bool { matches!(mesh.closes(), true if 1 < 2) }",
    ] {
        assert_eq!(used_by_validate(planted), ["mesh", "netmesh"], "{planted}");
    }
}

#[test]
fn a_use_through_a_module_that_passes_it_on_is_seen() {
    let passing = format!("pub use crate::netmesh::run; {VALIDATE}");
    let sources = [
        Source::parse("lib.rs", &format!("{LIBRARY} mod io;")),
        Source::parse("mesh.rs", MESH),
        Source::parse("netmesh.rs", NETMESH),
        Source::parse("validate/mod.rs", &passing),
        Source::parse("io.rs", "use crate::validate::run;"),
    ];
    assert_eq!(uses(&sources)["io"].iter().collect::<Vec<_>>(), ["netmesh", "validate"]);
}
