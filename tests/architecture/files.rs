//! Dependencies between the files below one module, read from parsed sources, tests apart: by
//! imports and other paths, and by calls of methods. The type of a receiver is told from the fields
//! and parameters that lead to it; where it is not known, the name of the method decides if no
//! other module has one of that name.

use super::uses::{Source, attributes, flatten, is_for_tests, is_standard, words};
use std::collections::{BTreeMap, BTreeSet};
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{Expr, Item, Pat, Token, Type};

type Names = BTreeSet<String>;

/// A method, by its type and its name.
pub type Method = (String, String);

/// Files that depend on others, each with what it takes from them.
#[derive(Default)]
pub struct Graph {
    pub files: BTreeMap<String, BTreeMap<String, Names>>,
    pub methods: BTreeMap<Method, BTreeSet<Method>>,
}

/// Definitions in the files below the module.
#[derive(Default)]
struct Definitions {
    /// Modules by their paths from the root -> their files.
    modules: BTreeMap<Vec<String>, String>,
    /// File and name of an item.
    items: BTreeSet<(String, String)>,
    /// File and name -> the path that a `use` there gives the name.
    imports: BTreeMap<(String, String), Vec<String>>,
    /// Name of a method -> the types that have one, with the file.
    methods: BTreeMap<String, BTreeSet<(String, String)>>,
    /// Type and field -> the names in the field's type.
    fields: BTreeMap<(String, String), Names>,
    /// Method -> the names in the type that it returns.
    returns: BTreeMap<Method, Names>,
    /// Methods of other modules.
    foreign: Names,
}

impl Graph {
    /// Reads the files of module `root` of the crate that has the `sources`.
    pub fn of(sources: &[Source], root: &str) -> Self {
        let is_below = |source: &&Source| source.modules().first().is_some_and(|top| top == root);
        let mut definitions = Definitions::default();
        for source in sources {
            match is_below(&source) {
                true => definitions.add(source),
                false => definitions.add_foreign(source),
            }
        }
        let mut graph = Self::default();
        for source in sources.iter().filter(is_below) {
            graph.files.entry(source.path.clone()).or_default();
            let mut reader = Reader {
                definitions: &definitions,
                graph: &mut graph,
                file: &source.path,
                modules: source.modules(),
                of: None,
                within: None,
                parameters: BTreeMap::new(),
                unsure: Vec::new(),
            };
            source.items.iter().for_each(|item| reader.visit_item(item));
            reader.guess();
        }
        graph
    }

    /// Returns the faults of the files if those of a folder may use their own and the `folders`
    /// before it only, files beside the folders may use all, and no files depend on each other in
    /// a circle.
    pub fn complaints(&self, root: &str, folders: &[String]) -> Vec<String> {
        let rank = |path: &str| {
            let below = path.strip_prefix(root).and_then(|path| path.strip_prefix('/'));
            let folder = below.and_then(|below| below.split_once('/')).map(|(folder, _)| folder);
            let folder = folder.or(below.and_then(|below| below.strip_suffix(".rs")));
            folders.iter().position(|name| Some(name.as_str()) == folder).unwrap_or(usize::MAX)
        };
        let mut complaints = Vec::new();
        for (file, others) in &self.files {
            for (other, names) in others.iter().filter(|(other, _)| rank(other) > rank(file)) {
                complaints.push(format!("{file} is below {other}, and uses {names:?}"));
            }
        }
        let successors = self.files.iter().map(|(file, others)| (file, others.keys().collect()));
        for circle in circles(&successors.collect()) {
            complaints.push(format!("{circle:?} depend on each other"));
        }
        complaints
    }

    /// The sets of methods that call each other in a circle.
    pub fn method_circles(&self) -> Vec<Vec<String>> {
        let successors =
            self.methods.iter().map(|(method, called)| (method, called.iter().collect()));
        let name = |method: &Method| format!("{}::{}", method.0, method.1);
        let circles = circles(&successors.collect());
        circles.into_iter().map(|circle| circle.into_iter().map(name).collect()).collect()
    }
}

/// The sets of two or more nodes that lead to each other.
fn circles<'a, T: Ord>(successors: &BTreeMap<&'a T, BTreeSet<&'a T>>) -> Vec<Vec<&'a T>> {
    let reached = |from: &'a T| {
        let mut seen = BTreeSet::new();
        let mut waiting = vec![from];
        while let Some(node) = waiting.pop() {
            for &next in successors.get(node).into_iter().flatten() {
                if seen.insert(next) {
                    waiting.push(next);
                }
            }
        }
        seen
    };
    let all: BTreeMap<&T, BTreeSet<&T>> =
        successors.keys().map(|&node| (node, reached(node))).collect();
    let mut circles: BTreeSet<Vec<&T>> = BTreeSet::new();
    for (&node, seen) in all.iter().filter(|(node, seen)| seen.contains(*node)) {
        let is_back = |other: &&&T| all.get(**other).is_some_and(|seen| seen.contains(node));
        circles.insert(seen.iter().filter(is_back).copied().collect());
    }
    circles.into_iter().filter(|circle| circle.len() > 1).collect()
}

/// The names in a type.
fn names_in(ty: &Type) -> Names {
    struct Collector(Names);
    impl<'ast> Visit<'ast> for Collector {
        fn visit_path_segment(&mut self, segment: &'ast syn::PathSegment) {
            self.0.insert(segment.ident.to_string());
            visit::visit_path_segment(self, segment);
        }
    }
    let mut collector = Collector(Names::new());
    collector.visit_type(ty);
    collector.0
}

fn name_of(ty: &Type) -> Option<String> {
    match ty {
        Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
        Type::Reference(reference) => name_of(&reference.elem),
        _ => None,
    }
}

/// The name of an item that another file may import.
fn item_name(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(item) => item.ident.to_string(),
        Item::Enum(item) => item.ident.to_string(),
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Static(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        Item::Trait(item) => item.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        _ => return None,
    })
}

/// The methods of an item, with their types. Those of traits of other crates, of `Iterator` say,
/// are everywhere.
fn methods_of(item: &Item) -> Vec<(String, &syn::Signature)> {
    match item {
        Item::Impl(item) if item.trait_.is_none() => {
            let Some(of) = name_of(&item.self_ty) else { return Vec::new() };
            let methods = item.items.iter().filter_map(|item| match item {
                syn::ImplItem::Fn(method) if !is_for_tests(&method.attrs) => {
                    Some((of.clone(), &method.sig))
                }
                _ => None,
            });
            methods.collect()
        }
        Item::Trait(item) => {
            let methods = item.items.iter().filter_map(|part| match part {
                syn::TraitItem::Fn(method) => Some((item.ident.to_string(), &method.sig)),
                _ => None,
            });
            methods.collect()
        }
        _ => Vec::new(),
    }
}

impl Definitions {
    fn add(&mut self, source: &Source) {
        let file = &source.path;
        self.modules.insert(source.modules(), file.clone());
        for item in &source.items {
            self.items.extend(item_name(item).map(|name| (file.clone(), name)));
            for (of, signature) in methods_of(item) {
                let name = signature.ident.to_string();
                self.methods.entry(name.clone()).or_default().insert((of.clone(), file.clone()));
                if let syn::ReturnType::Type(_, ty) = &signature.output {
                    let mut names = names_in(ty);
                    if names.remove("Self") {
                        names.insert(of.clone());
                    }
                    self.returns.insert((of, name), names);
                }
            }
            match item {
                Item::Struct(item) => {
                    for (number, field) in item.fields.iter().enumerate() {
                        let name = field.ident.as_ref().map(ToString::to_string);
                        let key = (item.ident.to_string(), name.unwrap_or(number.to_string()));
                        self.fields.insert(key, names_in(&field.ty));
                    }
                }
                Item::Use(item) => {
                    let mut paths = Vec::new();
                    flatten(&item.tree, Vec::new(), &mut paths);
                    for (path, name) in paths {
                        self.imports.insert((file.clone(), name), path);
                    }
                }
                _ => {}
            }
        }
    }

    fn add_foreign(&mut self, source: &Source) {
        let methods = source.items.iter().flat_map(methods_of);
        self.foreign.extend(methods.map(|(_, signature)| signature.ident.to_string()));
    }

    /// The file below the module that a path, seen in `modules`, leads to.
    fn file_of(&self, modules: &[String], path: &[String], steps: usize) -> Option<String> {
        let first = path.first()?.as_str();
        let up = path.iter().take_while(|name| *name == "super" || *name == "self");
        let up_count = up.clone().count();
        let (mut at, rest) = match first {
            "crate" => (Vec::new(), &path[1..]),
            "super" | "self" => {
                let supers = up.filter(|name| *name == "super").count();
                (modules[..modules.len().checked_sub(supers)?].to_vec(), &path[up_count..])
            }
            _ => return None,
        };
        let mut rest = rest;
        while let Some((name, after)) = rest.split_first() {
            at.push(name.clone());
            if !self.modules.keys().any(|module| module.starts_with(&at)) {
                at.pop();
                break;
            }
            rest = after;
        }
        let file = self.modules.get(&at)?.clone();
        let Some(name) = rest.first() else { return Some(file) };
        let key = (file.clone(), name.clone());
        match self.imports.get(&key) {
            Some(import) if !self.items.contains(&key) && steps > 0 => {
                self.file_of(&at, import, steps - 1)
            }
            _ => Some(file),
        }
    }
}

/// A call that may be of several methods.
struct Unsure {
    /// The types that have a method of that name, each with its file.
    owners: BTreeSet<(String, String)>,
    method: String,
    caller: Option<Method>,
}

/// Reads one file.
struct Reader<'a> {
    definitions: &'a Definitions,
    graph: &'a mut Graph,
    file: &'a str,
    modules: Vec<String>,
    /// The type whose methods are read.
    of: Option<String>,
    /// The method that is read.
    within: Option<String>,
    /// Its parameters, and those of closures -> the names in their types.
    parameters: BTreeMap<String, Names>,
    /// Calls that may be of several methods.
    unsure: Vec<Unsure>,
}

impl Reader<'_> {
    fn depend(&mut self, file: &str, name: &str) {
        if file != self.file {
            let others = self.graph.files.entry(self.file.to_owned()).or_default();
            others.entry(file.to_owned()).or_default().insert(name.to_owned());
        }
    }

    fn note_path(&mut self, path: &[String]) {
        // A path in the code may be that of a method or of a variant of an enumeration.
        if let Some(file) = self.definitions.file_of(&self.modules, path, 4) {
            self.depend(&file, path.last().map_or("", String::as_str));
        }
    }

    fn caller(&self) -> Option<Method> {
        self.of.clone().zip(self.within.clone())
    }

    fn call(&mut self, of: &str, method: &str, file: &str, caller: Option<Method>) {
        self.depend(file, method);
        if let Some(caller) = caller {
            let called = self.graph.methods.entry(caller).or_default();
            called.insert((of.to_owned(), method.to_owned()));
        }
    }

    /// A call of a method; `types` are the names in the receiver's type, if they are known.
    fn note_call(&mut self, method: &str, types: Option<&Names>) {
        let Some(all) = self.definitions.methods.get(method) else { return };
        let mut all = all.clone();
        match types {
            Some(types) => all.retain(|(of, _)| types.contains(of)),
            None if is_standard(method) || self.definitions.foreign.contains(method) => return,
            None => {}
        }
        let caller = self.caller();
        match all.len() {
            0 => {}
            1 => all.iter().for_each(|(of, file)| self.call(of, method, file, caller.clone())),
            _ => self.unsure.push(Unsure { owners: all, method: method.to_owned(), caller }),
        }
    }

    /// Takes, from the methods that a call may be of, those in files that are used anyway, or else
    /// all.
    fn guess(&mut self) {
        for Unsure { owners: all, method, caller } in std::mem::take(&mut self.unsure) {
            let known = self.graph.files.get(self.file);
            let is_known = |file: &String| {
                file == self.file || known.is_some_and(|known| known.contains_key(file))
            };
            let mut likely: Vec<_> = all.iter().filter(|(_, file)| is_known(file)).collect();
            if likely.is_empty() {
                likely = all.iter().collect();
            }
            for (of, file) in likely {
                self.call(of, &method, file, caller.clone());
            }
        }
    }

    /// The names in the type of an expression, as far as fields, parameters and methods tell.
    fn types_of(&self, expression: &Expr) -> Option<Names> {
        match expression {
            Expr::Path(path) => {
                let name = path.path.get_ident()?.to_string();
                match (name.as_str(), &self.of) {
                    ("self", Some(of)) => Some(Names::from([of.clone()])),
                    _ => self.parameters.get(&name).cloned().or_else(|| self.fields_named(&name)),
                }
            }
            Expr::Field(field) => {
                let name = match &field.member {
                    syn::Member::Named(name) => name.to_string(),
                    syn::Member::Unnamed(index) => index.index.to_string(),
                };
                let Some(bases) = self.types_of(&field.base) else {
                    return self.fields_named(&name);
                };
                let of_base =
                    |base: &String| self.definitions.fields.get(&(base.clone(), name.clone()));
                let found: Vec<_> = bases.iter().filter_map(of_base).collect();
                match found.is_empty() {
                    true => self.fields_named(&name),
                    false => Some(found.into_iter().flatten().cloned().collect()),
                }
            }
            Expr::MethodCall(call) => {
                let method = call.method.to_string();
                let bases = self.types_of(&call.receiver)?;
                let returned =
                    |base: &String| self.definitions.returns.get(&(base.clone(), method.clone()));
                let found: Vec<_> = bases.iter().filter_map(returned).collect();
                (!found.is_empty()).then(|| found.into_iter().flatten().cloned().collect())
            }
            Expr::Index(index) => self.types_of(&index.expr),
            Expr::Paren(inner) => self.types_of(&inner.expr),
            Expr::Reference(inner) => self.types_of(&inner.expr),
            Expr::Try(inner) => self.types_of(&inner.expr),
            Expr::Unary(inner) => self.types_of(&inner.expr),
            _ => None,
        }
    }

    /// The names in the types of all fields of a name: a variable has mostly that of the field that
    /// it was taken from.
    fn fields_named(&self, name: &str) -> Option<Names> {
        let fields = self.definitions.fields.iter().filter(|((_, field), _)| field == name);
        let mut fields = fields.peekable();
        fields.peek()?;
        Some(fields.flat_map(|(_, names)| names.iter().cloned()).collect())
    }

    fn read_tokens(&mut self, tokens: &str) {
        let words = words(tokens);
        let is = |at: usize, text: &str| words.get(at).is_some_and(|word| *word == text);
        for (at, word) in words.iter().enumerate() {
            if *word == "." && is(at + 2, "(") {
                self.note_call(words[at + 1], None);
            }
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        let before = std::mem::replace(&mut self.of, name_of(&item.self_ty));
        visit::visit_item_impl(self, item);
        self.of = before;
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if is_for_tests(&item.attrs) {
            return;
        }
        self.within = Some(item.sig.ident.to_string());
        visit::visit_impl_item_fn(self, item);
        self.within = None;
        self.parameters.clear();
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        visit::visit_item_fn(self, item);
        self.parameters.clear();
    }

    fn visit_pat_type(&mut self, pattern: &'ast syn::PatType) {
        if let Pat::Ident(name) = &*pattern.pat {
            let mut names = names_in(&pattern.ty);
            if let (true, Some(of)) = (names.contains("Self"), &self.of) {
                names.insert(of.clone());
            }
            self.parameters.insert(name.ident.to_string(), names);
        }
        visit::visit_pat_type(self, pattern);
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        // Names that a file only passes on are used by those who take them from there.
        if matches!(item.vis, syn::Visibility::Inherited) {
            let mut paths = Vec::new();
            flatten(&item.tree, Vec::new(), &mut paths);
            paths.iter().for_each(|(path, _)| self.note_path(path));
        }
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.note_path(&names);
        if let [.., of, method] = names.as_slice() {
            let of = if of == "Self" { self.of.clone() } else { Some(of.clone()) };
            if let Some(of) = of {
                self.note_call(method, Some(&Names::from([of])));
            }
        }
        visit::visit_path(self, path);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let types = self.types_of(&call.receiver);
        self.note_call(&call.method.to_string(), types.as_ref());
        visit::visit_expr_method_call(self, call);
    }

    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        match item.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            // The expressions live no longer than this call: a reader of their own.
            Ok(expressions) => {
                let mut inner = Reader {
                    definitions: self.definitions,
                    graph: &mut *self.graph,
                    file: self.file,
                    modules: self.modules.clone(),
                    of: self.of.clone(),
                    within: self.within.clone(),
                    parameters: self.parameters.clone(),
                    unsure: Vec::new(),
                };
                expressions.iter().for_each(|expression| inner.visit_expr(expression));
                self.unsure.append(&mut inner.unsure);
            }
            Err(_) => self.read_tokens(&item.tokens.to_string()),
        }
    }
}
