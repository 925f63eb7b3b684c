//! Every function of the C ABIs goes through the one barrier, which sets the floating-point
//! environment, and every function of the caller's is called in the caller's environment.

use super::root;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use syn::visit::{self, Visit};
use syn::{Expr, ExprCall, ExprClosure, ExprMethodCall, ItemFn, ItemMod};

/// Functions that neither compute with floating-point numbers nor call what does.
const WITHOUT_NUMBERS: [&str; 5] =
    ["nm_abi_version", "nm_last_error", "nm_mpi_last_error", "nm_status_name", "nm_version"];

/// A function, and the functions that it calls outside of closures.
#[derive(Default)]
struct Function {
    is_exported: bool,
    calls: BTreeSet<String>,
}

/// The functions of some files, and where these call the caller's.
#[derive(Default)]
struct Functions {
    by_name: BTreeMap<String, Function>,
    /// Names of the functions that the visitor is in.
    within: Vec<String>,
    closures: usize,
    in_callers_environment: usize,
    callbacks: Vec<bool>,
}

impl Functions {
    fn of(directories: &[&str]) -> Self {
        let mut functions = Self::default();
        for directory in directories {
            for entry in fs::read_dir(root().join(directory)).expect("a directory") {
                let path = entry.expect("an entry").path();
                if path.extension().is_some_and(|extension| extension == "rs") {
                    let text = fs::read_to_string(&path).expect("a source");
                    functions.visit_file(&syn::parse_file(&text).expect("Rust"));
                }
            }
        }
        functions
    }

    /// Returns the functions that always call `barrier`, or one that does.
    fn guarded(&self) -> BTreeSet<&str> {
        let mut guarded = BTreeSet::from(["barrier"]);
        loop {
            let reaches = |function: &Function| {
                function.calls.iter().any(|call| guarded.contains(call.as_str()))
            };
            let found = self.by_name.iter().filter(|(_, function)| reaches(function));
            let all: BTreeSet<&str> =
                found.map(|(name, _)| name.as_str()).chain(guarded.iter().copied()).collect();
            if all.len() == guarded.len() {
                return all;
            }
            guarded = all;
        }
    }

    fn exported(&self) -> BTreeSet<&str> {
        let exported = self.by_name.iter().filter(|(_, function)| function.is_exported);
        exported.map(|(name, _)| name.as_str()).collect()
    }
}

fn last_of_path(callee: &Expr) -> Option<String> {
    let Expr::Path(path) = callee else { return None };
    path.path.segments.last().map(|segment| segment.ident.to_string())
}

impl<'ast> Visit<'ast> for Functions {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if module.ident != "tests" {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        let name = function.sig.ident.to_string();
        let is_exported = function.attrs.iter().any(|attribute| {
            attribute.path().is_ident("unsafe")
                && attribute.parse_args::<syn::Ident>().is_ok_and(|name| name == "no_mangle")
        });
        self.by_name.insert(name.clone(), Function { is_exported, calls: BTreeSet::new() });
        self.within.push(name);
        visit::visit_item_fn(self, function);
        self.within.pop();
    }

    fn visit_expr_closure(&mut self, closure: &'ast ExprClosure) {
        self.closures += 1;
        visit::visit_expr_closure(self, closure);
        self.closures -= 1;
    }

    fn visit_expr_call(&mut self, call: &'ast ExprCall) {
        if let Some(name) = last_of_path(&call.func) {
            if name == "callback" {
                self.callbacks.push(self.in_callers_environment > 0);
            }
            if let (0, Some(function)) = (self.closures, self.within.last()) {
                let function = self.by_name.get_mut(function).expect("visited");
                function.calls.insert(name);
            }
        }
        visit::visit_expr_call(self, call);
    }

    fn visit_expr_method_call(&mut self, call: &'ast ExprMethodCall) {
        let is_it =
            call.method == "run" && last_of_path(&call.receiver).as_deref() == Some("caller");
        self.in_callers_environment += usize::from(is_it);
        visit::visit_expr_method_call(self, call);
        self.in_callers_environment -= usize::from(is_it);
    }
}

#[test]
fn every_exported_function_goes_through_the_barrier() {
    let functions = Functions::of(&["src/capi", "mpi/src/capi"]);
    let (exported, guarded) = (functions.exported(), functions.guarded());
    let unguarded: Vec<&str> = exported.difference(&guarded).copied().collect();
    assert_eq!(unguarded, WITHOUT_NUMBERS);
    let list = fs::read_to_string(root().join("cpp_tests/symbols.txt")).expect("the list");
    let listed: BTreeSet<&str> = list.lines().collect();
    let own: BTreeSet<&str> =
        exported.iter().copied().filter(|name| !name.contains("mpi_")).collect();
    assert_eq!(own, listed, "every function of the library was read");
    assert!(exported.len() > own.len() + 10, "every function on MPI was read");
}

#[test]
fn the_barrier_sets_the_environment() {
    let text = fs::read_to_string(root().join("src/capi/handle.rs")).expect("a source");
    let (_, barrier) = text.split_once("pub fn barrier(").expect("the barrier");
    let body = barrier.split("\n}\n").next().expect("its body");
    assert!(body.contains("Environment::DEFAULT.run(|| catch_unwind("), "{body}");
}

#[test]
fn callers_functions_run_in_the_callers_environment() {
    let functions = Functions::of(&["src/capi", "mpi/src/capi"]);
    assert_eq!(functions.callbacks, [true; 3], "write, progress and size");
}
