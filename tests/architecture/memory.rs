//! Memory that runs out is a status, so that nothing asks for memory that cannot say no. Stable
//! sorts do, from some twenty elements on, which no test of failing memory with little data sees.

use super::library_files;
use syn::visit::{self, Visit};
use syn::{ExprMethodCall, ItemMod};

/// The stable sorts that a source calls outside its tests.
#[derive(Default)]
struct StableSorts(Vec<String>);

impl StableSorts {
    fn of(text: &str) -> Vec<String> {
        let mut found = Self::default();
        found.visit_file(&syn::parse_file(text).expect("Rust"));
        found.0
    }
}

impl<'ast> Visit<'ast> for StableSorts {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if module.ident != "tests" {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast ExprMethodCall) {
        let (name, arguments) = (call.method.to_string(), call.args.len());
        if [("sort", 0), ("sort_by", 1), ("sort_by_key", 1), ("sort_by_cached_key", 1)]
            .contains(&(name.as_str(), arguments))
        {
            self.0.push(name);
        }
        visit::visit_expr_method_call(self, call);
    }
}

#[test]
fn sorts_ask_for_no_memory() {
    let files = library_files();
    assert!(files.len() > 300, "the sources of the library");
    for (path, text) in files {
        let found = StableSorts::of(&text);
        assert!(
            found.is_empty(),
            "{path} calls {found:?}; sort_unstable and its kin need no memory"
        );
    }
}

#[test]
fn a_stable_sort_is_seen() {
    let planted = "fn f(x: &mut [u8]) { x.sort_unstable(); x.sort_by_key(|y| *y); }
        mod tests { fn f(x: &mut [u8]) { x.sort(); } }";
    assert_eq!(StableSorts::of(planted), ["sort_by_key"]);
}
