//! Uses between the top-level modules of a crate, read from its parsed sources, tests apart: by
//! paths from the root and past it by `super`, by names that the root or another module re-exports,
//! and by calls of methods that another module alone defines.

use std::collections::{BTreeMap, BTreeSet};
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, Meta, Token, UseTree};

pub type Layers = BTreeMap<String, BTreeSet<String>>;

/// Methods of the standard library's types whose names the crate uses for its own too. A call of
/// one of these says nothing of a module.
const STANDARD: &[&str] = &[
    "abs",
    "add",
    "all",
    "any",
    "as_mut_ptr",
    "as_mut_slice",
    "as_ptr",
    "as_slice",
    "chain",
    "clear",
    "cloned",
    "cmp",
    "collect",
    "contains",
    "copied",
    "copy_from_slice",
    "count",
    "expect",
    "extend",
    "extend_from_slice",
    "fill",
    "filter",
    "find",
    "first",
    "flush",
    "fold",
    "get",
    "get_mut",
    "index",
    "insert",
    "into_iter",
    "is_empty",
    "is_infinite",
    "is_none",
    "is_some",
    "iter",
    "iter_mut",
    "join",
    "kind",
    "last",
    "len",
    "lock",
    "map",
    "max",
    "min",
    "name",
    "next",
    "parent",
    "pop",
    "position",
    "push",
    "read",
    "reduce",
    "remove",
    "replace",
    "resize",
    "retain",
    "rev",
    "reverse",
    "scan",
    "skip",
    "sort",
    "split",
    "sqrt",
    "step_by",
    "sum",
    "swap",
    "take",
    "truncate",
    "write",
    "zip",
];

/// A source file: its path below src, with slashes, and its items without those for tests.
pub struct Source {
    pub path: String,
    pub items: Vec<Item>,
}

impl Source {
    /// # Panics
    /// If the text is no Rust.
    pub fn parse(path: &str, text: &str) -> Self {
        let mut file = syn::parse_file(text).unwrap_or_else(|error| panic!("{path}: {error}"));
        file.items.retain(|item| !is_for_tests(attributes(item)));
        Self { path: path.to_owned(), items: file.items }
    }

    /// The modules from the root to this file's.
    pub fn modules(&self) -> Vec<String> {
        let path = self.path.trim_end_matches(".rs");
        let path = path.strip_suffix("/mod").unwrap_or(path);
        path.split('/').filter(|name| *name != "lib").map(str::to_owned).collect()
    }
}

pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

pub fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => {
            let condition = list.tokens.to_string().replace(' ', "");
            condition == "test" || condition.starts_with("all(test")
        }
        _ => false,
    })
}

/// Returns true if the standard library's types have methods of that name.
pub fn is_standard(method: &str) -> bool {
    STANDARD.contains(&method)
}

/// Definitions in the sources of a crate that another module may use unseen.
#[derive(Default)]
struct Definitions {
    modules: BTreeSet<String>,
    /// Module ("" for the root) and name -> the module that the name really belongs to.
    exports: BTreeMap<(String, String), String>,
    /// Method -> the modules that define one of this name.
    methods: BTreeMap<String, BTreeSet<String>>,
    traits: BTreeSet<String>,
}

/// Returns the modules that each module uses.
///
/// # Panics
/// If a path from the root names neither a module nor what the root re-exports.
pub fn uses(sources: &[Source]) -> Layers {
    let definitions = Definitions::of(sources);
    let mut uses: Layers =
        definitions.modules.iter().map(|m| (m.clone(), BTreeSet::new())).collect();
    let mut calls: Layers = Layers::new();
    for source in sources.iter().filter(|source| source.path != "lib.rs") {
        let modules = source.modules();
        let top = modules[0].clone();
        let mut reader = Reader {
            path: &source.path,
            definitions: &definitions,
            modules,
            used: BTreeSet::new(),
            called: BTreeSet::new(),
        };
        source.items.iter().for_each(|item| reader.visit_item(item));
        uses.entry(top.clone()).or_default().extend(reader.used);
        calls.entry(top).or_default().extend(reader.called);
    }
    for (module, called) in calls {
        let used = uses.entry(module.clone()).or_default();
        let known: BTreeSet<&String> = used.iter().chain([&module]).collect();
        let others = called.iter().filter_map(|method| definitions.methods.get(method));
        // A method of that name in a module that is used anyway is taken for the one that is
        // called.
        let others = others.filter(|owners| !owners.iter().any(|owner| known.contains(owner)));
        let others: BTreeSet<String> = others.flatten().cloned().collect();
        used.extend(others);
    }
    for (module, used) in &mut uses {
        used.remove(module);
    }
    uses
}

impl Definitions {
    fn of(sources: &[Source]) -> Self {
        let mut all = Self::default();
        let tops = sources.iter().filter_map(|source| source.modules().first().cloned());
        all.modules = tops.collect();
        for item in sources.iter().flat_map(|source| &source.items) {
            if let Item::Trait(item) = item {
                all.traits.insert(item.ident.to_string());
            }
        }
        for source in sources {
            let modules = source.modules();
            for item in &source.items {
                all.add(&modules, item);
            }
        }
        all
    }

    fn add(&mut self, modules: &[String], item: &Item) {
        let top = modules.first().cloned().unwrap_or_default();
        match item {
            Item::Use(item) if !matches!(item.vis, syn::Visibility::Inherited) => {
                let mut paths = Vec::new();
                flatten(&item.tree, Vec::new(), &mut paths);
                for (path, name) in paths {
                    let owner = self.owner(modules, &path).filter(|owner| *owner != top);
                    if let Some(owner) = owner {
                        self.exports.insert((top.clone(), name), owner);
                    }
                }
            }
            Item::Impl(item) => {
                let of = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
                // Methods of other crates' traits, of `Iterator` say, are everywhere.
                if of.is_some_and(|of| !self.traits.contains(&of.ident.to_string())) {
                    return;
                }
                for item in &item.items {
                    if let syn::ImplItem::Fn(method) = item {
                        self.add_method(&top, &method.sig);
                    }
                }
            }
            Item::Trait(item) => {
                for item in &item.items {
                    if let syn::TraitItem::Fn(method) = item {
                        self.add_method(&top, &method.sig);
                    }
                }
            }
            _ => {}
        }
    }

    fn add_method(&mut self, top: &str, signature: &syn::Signature) {
        let name = signature.ident.to_string();
        if signature.receiver().is_some() && !is_standard(&name) {
            self.methods.entry(name).or_default().insert(top.to_owned());
        }
    }

    /// The top-level module that a path seen in `modules` leads to; `None` if it does not leave its
    /// own module for a known one.
    fn owner(&self, modules: &[String], path: &[String]) -> Option<String> {
        let rest = from_root(modules, path)?;
        let name = rest.first()?;
        if self.modules.contains(name) {
            return Some(name.clone());
        }
        self.exports.get(&(String::new(), name.clone())).cloned()
    }
}

/// The path from the crate's root, if it is known without names that are imported.
fn from_root(modules: &[String], path: &[String]) -> Option<Vec<String>> {
    let first = path.first()?.as_str();
    if first == "crate" || modules.is_empty() {
        return Some(path[usize::from(first == "crate" || first == "self")..].to_vec());
    }
    let up = path.iter().skip(usize::from(first == "self")).take_while(|name| *name == "super");
    let up = up.count();
    if up == 0 {
        return None;
    }
    let kept = modules.len().checked_sub(up)?;
    let below = path.iter().skip(up + usize::from(first == "self"));
    Some(modules[..kept].iter().chain(below).cloned().collect())
}

/// The paths of a `use`, each with the name that it brings in.
pub fn flatten(tree: &UseTree, mut before: Vec<String>, paths: &mut Vec<(Vec<String>, String)>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            flatten(&path.tree, before, paths);
        }
        UseTree::Name(name) => {
            let name = name.ident.to_string();
            let last = before.last().cloned().unwrap_or_default();
            let brought = if name == "self" { last } else { name.clone() };
            before.extend((name != "self").then_some(name));
            paths.push((before, brought));
        }
        UseTree::Rename(rename) => {
            before.push(rename.ident.to_string());
            paths.push((before, rename.rename.to_string()));
        }
        UseTree::Glob(_) => {
            before.push("*".to_owned());
            paths.push((before, "*".to_owned()));
        }
        UseTree::Group(group) => {
            group.items.iter().for_each(|tree| flatten(tree, before.clone(), paths));
        }
    }
}

/// Reads one file.
struct Reader<'a> {
    path: &'a str,
    definitions: &'a Definitions,
    modules: Vec<String>,
    used: BTreeSet<String>,
    called: BTreeSet<String>,
}

impl Reader<'_> {
    fn note(&mut self, path: &[String]) {
        let Some(rest) = from_root(&self.modules, path) else { return };
        let Some(owner) = self.definitions.owner(&self.modules, path) else {
            panic!("{}: name the module: {}", self.path, path.join("::"));
        };
        // Names that the module only passes on belong to another one.
        let passed_on = rest.get(1).map(|name| (owner.clone(), name.clone()));
        let passed_on = passed_on.and_then(|key| self.definitions.exports.get(&key));
        self.used.extend(passed_on.cloned());
        self.used.insert(owner);
    }

    /// Text that does not parse as expressions: paths and calls by their words.
    fn read_tokens(&mut self, tokens: &str) {
        let words = words(tokens);
        let is = |at: usize, text: &str| words.get(at).is_some_and(|word| *word == text);
        for (i, word) in words.iter().enumerate() {
            if *word == "." && is(i + 2, "(") {
                self.called.insert(words[i + 1].to_owned());
            }
            // `pub(crate)` is no path.
            let is_visibility = is(i + 1, ")");
            let begins = ["crate", "super"].contains(word) && !(i > 0 && is(i - 1, ":"));
            let begins = begins && !is_visibility;
            if begins {
                let mut path = vec![(*word).to_owned()];
                let mut at = i + 1;
                while is(at, ":") && is(at + 1, ":") && at + 2 < words.len() {
                    path.push(words[at + 2].to_owned());
                    at += 3;
                }
                self.note(&path);
            }
        }
    }
}

/// Names, and every other character but space by itself.
pub fn words(text: &str) -> Vec<&str> {
    let is_name = |letter: char| letter == '_' || letter.is_alphanumeric();
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = if is_name(first) { rest.find(|c| !is_name(c)) } else { Some(first.len_utf8()) };
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        words.push(word);
        rest = after.trim_start();
    }
    words
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if !is_for_tests(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.modules.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.modules.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let mut paths = Vec::new();
        flatten(&item.tree, Vec::new(), &mut paths);
        paths.iter().for_each(|(path, _)| self.note(path));
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.note(&names);
        visit::visit_path(self, path);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        self.called.insert(call.method.to_string());
        visit::visit_expr_method_call(self, call);
    }

    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        match item.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            // The expressions live no longer than this call: a reader of their own.
            Ok(expressions) => {
                let mut inner = Reader {
                    path: self.path,
                    definitions: self.definitions,
                    modules: self.modules.clone(),
                    used: BTreeSet::new(),
                    called: BTreeSet::new(),
                };
                expressions.iter().for_each(|expression| inner.visit_expr(expression));
                self.used.extend(inner.used);
                self.called.extend(inner.called);
            }
            Err(_) => self.read_tokens(&item.tokens.to_string()),
        }
    }
}
