//! The rules of the house: which room may name which. Each rule is an absence.
//!
//! Every file under src is parsed, and every path in it read: `use` trees, paths in code, and paths within macros; comments, texts and
//! tests do not count. A path's room is the first word after `crate`, wherever it is named from; a room that is not in the
//! table is an error, so that no new room goes without rules.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

/// A room, and the rooms that it may name beside itself.
struct Room {
    name: &'static str,
    may_name: &'static [&'static str],
    /// Why it may name no other.
    why: &'static str,
}

const ROOMS: &[Room] = &[
    Room { name: "geometry", may_name: &[], why: "points and signs: it knows nothing of ours" },
    Room { name: "mesh", may_name: &["geometry"], why: "topology knows no engine, file, clock or report" },
    Room { name: "report", may_name: &[], why: "plain data, that any front end can show" },
    Room {
        name: "canvas",
        may_name: &["mesh", "report"],
        why: "what can be asked of pixels, as data: no pixels, no engine, no renderer",
    },
    Room {
        name: "engine",
        may_name: &["canvas", "geometry", "mesh", "report"],
        why: "an engine knows no front end, file, recording or session",
    },
    Room {
        name: "recording",
        may_name: &["engine", "mesh", "report"],
        why: "it holds the engines' events and the ids in them, and opens no file",
    },
    Room {
        name: "assets",
        may_name: &["canvas", "geometry", "mesh", "recording", "report"],
        why: "it makes meshes and maps of what a recording names, and knows nothing of cuts",
    },
    Room {
        name: "render",
        may_name: &["canvas", "geometry", "mesh", "report"],
        why: "it carries jobs out, and knows no engine, file or session",
    },
    Room {
        name: "replay",
        may_name: &["assets", "canvas", "engine", "mesh", "recording", "report"],
        why: "the session drives engines, and knows no goldens and no front end",
    },
    Room {
        name: "verify",
        may_name: &["assets", "canvas", "recording", "replay", "report"],
        why: "goldens are compared with reports: no engine, no front end",
    },
    Room {
        name: "measure",
        may_name: &[
            "assets",
            "canvas",
            "engine",
            "geometry",
            "mesh",
            "recording",
            "render",
            "replay",
            "report",
            "verify",
        ],
        why: "it times whatever there is, and answers with reports: it shows nothing",
    },
    Room {
        name: "attack",
        may_name: &[
            "assets",
            "canvas",
            "engine",
            "geometry",
            "measure",
            "mesh",
            "recording",
            "render",
            "replay",
            "report",
            "verify",
        ],
        why: "it attacks every room but the front ends, and answers with findings and reports",
    },
    Room {
        name: "cli",
        may_name: &[
            "assets",
            "attack",
            "canvas",
            "measure",
            "recording",
            "render",
            "replay",
            "report",
            "tui",
            "verify",
        ],
        why: "a front end shows reports: it computes nothing, and knows no engine",
    },
    Room {
        name: "tui",
        may_name: &["assets", "canvas", "mesh", "recording", "render", "replay", "report", "verify"],
        why: "a front end shows reports: it computes nothing, and knows no engine",
    },
];

/// Something from outside that only some places may name.
struct Ban {
    path: &'static str,
    /// Places, as `room` or `room/file`, that may name it.
    but: &'static [&'static str],
    why: &'static str,
}

const BANS: &[Ban] = &[
    Ban { path: "std::fs", but: &["assets"], why: "assets alone opens files" },
    Ban { path: "std::net", but: &[], why: "nothing here needs a network" },
    Ban {
        path: "std::process::Command",
        but: &["attack/nightly/fuzzers.rs"],
        why: "nothing here starts programs, but a fuzzer ends its process at the first panic and needs a compiler of its own",
    },
    Ban { path: "std::env::args_os", but: &["main"], why: "what was typed is passed in" },
    Ban {
        path: "std::env::var_os",
        but: &["assets/cache.rs", "tui/environment.rs"],
        why: "where meshes and drafts are kept, and how a screen looks, are all that the environment decides",
    },
    Ban { path: "std::env::var", but: &[], why: "an environment must not decide what a run does" },
    Ban {
        path: "std::time",
        but: &[
            "replay",
            "render",
            "verify",
            "measure",
            "cli",
            "tui",
            "attack/nightly/mod.rs",
            "attack/nightly/parts.rs",
            "attack/nightly/fuzzers.rs",
        ],
        why: "only what times a run, or a pass of a frame, knows a clock",
    },
    Ban {
        path: "std::time::SystemTime",
        but: &["cli/nightly.rs"],
        why: "a run does not depend on its date, but a night is to try other things than the one before",
    },
    Ban {
        path: "std::thread",
        but: &[
            "attack/nightly/mod.rs",
            "verify/suite.rs",
            "cli/verify.rs",
            "cli/doctor.rs",
            "measure",
            "tui/terminal/errors.rs",
            "tui/terminal/events.rs",
            "tui/terminal/mod.rs",
            "tui/image/encoder.rs",
            "tui/worker/mod.rs",
            "tui/worker/compare.rs",
        ],
        why: "whole recordings and fuzzers run side by side, and beside a screen; within a run there is one order",
    },
    Ban {
        path: "std::io::stdin",
        but: &["tui/terminal/mod.rs"],
        why: "input is a file that is named, or keys of a terminal that was taken",
    },
    Ban {
        path: "std::io::stdout",
        but: &["tui/terminal/mod.rs"],
        why: "writers are passed in, but a terminal is given back from wherever a panic happens",
    },
    Ban { path: "std::collections::HashMap", but: &[], why: "its order differs from run to run" },
    Ban { path: "std::collections::HashSet", but: &[], why: "its order differs from run to run" },
    Ban { path: "std::collections::hash_map::HashMap", but: &[], why: "its order differs from run to run" },
    Ban { path: "gltf", but: &["assets"], why: "formats of files are for assets" },
    Ban { path: "ratatui", but: &["tui"], why: "terminals are for the front end" },
    Ban { path: "ratatui_image", but: &["tui"], why: "terminals are for the front end" },
    Ban { path: "crossterm", but: &["tui"], why: "terminals are for the front end" },
    Ban { path: "clap", but: &["cli"], why: "one parser, in the front end" },
    Ban { path: "anstream", but: &["cli"], why: "colour is for the front end" },
    Ban { path: "anstyle", but: &["cli"], why: "colour is for the front end" },
    Ban {
        path: "crate::engine::wound",
        but: &["attack", "engine", "measure", "recording/any.rs", "replay/open.rs"],
        why: "one file of a room lists the engines; the rest sees the trait",
    },
];

#[test]
fn rooms_name_only_the_rooms_below_them() {
    let broken: Vec<String> =
        files().iter().flat_map(|file| file.named.iter().filter_map(|n| file.room_fault(n))).collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

#[test]
fn what_is_outside_is_named_in_its_place_alone() {
    let broken: Vec<String> =
        files().iter().flat_map(|file| file.named.iter().flat_map(|n| file.bans(n))).collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

#[test]
fn the_table_is_the_house() {
    let there: BTreeSet<String> = files().into_iter().map(|file| file.room).collect();
    let listed = ROOMS.iter().map(|room| room.name).chain(["lib", "main"]).map(str::to_owned).collect();
    assert_eq!(there, listed);
    let map = fs::read_to_string(source().join("lib.rs")).expect("lib.rs");
    for Room { name, .. } in ROOMS {
        assert!(map.contains(&format!("//! | [`{name}`] |")), "{name} is not on the map in lib.rs");
    }
}

#[test]
fn every_way_to_name_a_path_is_seen() {
    let code = r#"
        use crate::{cli::Console, verify as goldens};
        use std::{fs::{self, File}, time::*};
        mod inner { fn f() -> super::super::mesh::Mesh { println!("{}", std::env::var("X")); super::g() } }
        #[cfg(test)] mod tests { use crate::measure::x; }
        #[test] fn t() { std::net::y() }
        /// crate::replay::Replay
        fn h() { let text = "crate::assets"; fs::read(text); lancet::report::Check::pass("") }
    "#;
    let file = SourceFile::parse("engine", "engine/thing.rs", &["engine", "thing"], code);
    let named: BTreeSet<String> = file.named.iter().map(|n| n.path.join("::")).collect();
    let has = |path: &str| named.contains(path);
    for path in [
        "crate::cli::Console",
        "crate::verify",
        "std::fs",
        "std::fs::File",
        "std::time",
        "crate::engine::mesh::Mesh",
        "std::env::var",
        "crate::engine::thing::g",
        "crate::report::Check::pass",
    ] {
        assert!(has(path), "{path} is not in {named:#?}");
    }
    let all = named.iter().cloned().collect::<String>();
    assert!(["measure", "net", "replay", "assets"].iter().all(|unseen| !all.contains(unseen)), "{named:#?}");
    assert_eq!(file.named.iter().filter_map(|n| file.room_fault(n)).count(), 2, "cli and verify");
}

/// A path that is named, in full, and where.
struct Named {
    path: Vec<String>,
    line: usize,
}

struct SourceFile {
    room: String,
    /// Below src.
    place: String,
    named: Vec<Named>,
}

impl SourceFile {
    fn parse(room: &str, place: &str, module: &[&str], code: &str) -> Self {
        let parsed = syn::parse_file(code).unwrap_or_else(|error| panic!("{place}: {error}"));
        let mut paths = Paths { module: module.iter().map(|s| s.to_string()).collect(), named: Vec::new() };
        paths.visit_file(&parsed);
        Self { room: room.into(), place: place.into(), named: paths.named }
    }

    /// What is wrong with naming a path of ours here.
    fn room_fault(&self, named: &Named) -> Option<String> {
        let [root, room, ..] = named.path.as_slice() else { return None };
        if root != "crate" || *room == self.room || self.room == "lib" {
            return None;
        }
        let Some(rules) = ROOMS.iter().find(|rules| rules.name == self.room) else {
            return (self.room != "main" || room != "cli")
                .then(|| self.fault(named, "no rule for this room"));
        };
        (!rules.may_name.contains(&room.as_str())).then(|| self.fault(named, rules.why))
    }

    /// What is wrong with naming a path from outside here.
    fn bans(&self, named: &Named) -> Vec<String> {
        let path = named.path.join("::");
        let hit = |ban: &&Ban| path == ban.path || path.starts_with(&format!("{}::", ban.path));
        let banned = BANS.iter().filter(hit).filter(|ban| !ban.but.iter().any(|place| self.lies_in(place)));
        banned.map(|ban| self.fault(named, ban.why)).collect()
    }

    fn lies_in(&self, place: &str) -> bool {
        self.room == place || self.place == place
    }

    fn fault(&self, named: &Named, why: &str) -> String {
        format!("src/{}:{}: names {}, but: {why}", self.place, named.line, named.path.join("::"))
    }
}

/// Collects every path of a file.
struct Paths {
    /// The module that is being read, from the crate's root.
    module: Vec<String>,
    named: Vec<Named>,
}

impl Paths {
    /// Notes a path, `self`, `super` and the crate's own name resolved.
    fn name(&mut self, path: &[String], line: usize) {
        let mut module = self.module.clone();
        let mut rest = path;
        let mut ours = false;
        while let Some((first, below)) = rest.split_first() {
            match first.as_str() {
                "crate" | "lancet" | "$crate" => module.clear(),
                "self" => {}
                "super" => drop(module.pop()),
                _ => break,
            }
            (ours, rest) = (true, below);
        }
        let path = match ours {
            true => ["crate".to_owned()].into_iter().chain(module).chain(rest.iter().cloned()).collect(),
            false => rest.to_vec(),
        };
        self.named.push(Named { path, line });
    }

    fn name_tree(&mut self, tree: &syn::UseTree, above: &[String]) {
        let with = |ident: &syn::Ident| [above, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.name_tree(&path.tree, &with(&path.ident)),
            syn::UseTree::Group(group) => group.items.iter().for_each(|item| self.name_tree(item, above)),
            syn::UseTree::Glob(glob) => self.name(above, glob.star_token.spans[0].start().line),
            syn::UseTree::Name(name) if name.ident == "self" => {
                self.name(above, name.ident.span().start().line)
            }
            syn::UseTree::Name(name) => self.name(&with(&name.ident), name.ident.span().start().line),
            syn::UseTree::Rename(rename) => self.name(&with(&rename.ident), rename.ident.span().start().line),
        }
    }

    /// Paths in the tokens of a macro: words joined by `::`.
    fn name_tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        let mut line = 0;
        for token in tokens {
            match &token {
                TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
                TokenTree::Ident(ident) => {
                    if colons != 2 {
                        self.end(&mut path, line);
                    }
                    path.push(ident.to_string());
                    (colons, line) = (0, ident.span().start().line);
                }
                other => {
                    self.end(&mut path, line);
                    colons = 0;
                    if let TokenTree::Group(group) = other {
                        self.name_tokens(group.stream());
                    }
                }
            }
        }
        self.end(&mut path, line);
    }

    fn end(&mut self, path: &mut Vec<String>, line: usize) {
        let path = std::mem::take(path);
        if path.len() > 1 {
            self.name(&path, line);
        }
    }
}

impl<'ast> Visit<'ast> for Paths {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        self.module.push(module.ident.to_string());
        visit::visit_item_mod(self, module);
        self.module.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.name_tree(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let words: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        // A single word is a local name.
        if let (2.., Some(first)) = (words.len(), path.segments.first()) {
            self.name(&words, first.ident.span().start().line);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, mac: &'ast syn::Macro) {
        self.name_tokens(mac.tokens.clone());
        visit::visit_macro(self, mac);
    }
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    use syn::Item::{Const, Enum, Fn, Impl, Macro, Mod, Static, Struct, Trait, Type, Use};
    match item {
        Const(syn::ItemConst { attrs, .. })
        | Enum(syn::ItemEnum { attrs, .. })
        | Fn(syn::ItemFn { attrs, .. })
        | Impl(syn::ItemImpl { attrs, .. })
        | Macro(syn::ItemMacro { attrs, .. })
        | Mod(syn::ItemMod { attrs, .. })
        | Static(syn::ItemStatic { attrs, .. })
        | Struct(syn::ItemStruct { attrs, .. })
        | Trait(syn::ItemTrait { attrs, .. })
        | Type(syn::ItemType { attrs, .. })
        | Use(syn::ItemUse { attrs, .. }) => attrs,
        _ => &[],
    }
}

/// Whether `#[cfg(test)]` or `#[test]` stands before it.
fn is_test(attributes: &[syn::Attribute]) -> bool {
    let of_tests = |attribute: &syn::Attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        meta => meta.path().is_ident("test"),
    };
    attributes.iter().any(of_tests)
}

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every file under src that is no test.
fn files() -> Vec<SourceFile> {
    let mut paths = Vec::new();
    collect(&source(), &mut paths);
    paths.iter().map(|path| read(path)).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of src") {
        let path = entry.expect("an entry of it").path();
        let name = path.file_stem().unwrap_or_default();
        if path.is_dir() && name != "tests" {
            collect(&path, paths);
        } else if path.extension().is_some_and(|end| end == "rs") && name != "tests" {
            paths.push(path);
        }
    }
}

fn read(path: &Path) -> SourceFile {
    let code = fs::read_to_string(path).expect("a file that was listed");
    let place = path
        .strip_prefix(source())
        .expect("it lies there")
        .to_str()
        .expect("a plain name")
        .replace('\\', "/");
    let words: Vec<&str> = place.trim_end_matches(".rs").split('/').filter(|word| *word != "mod").collect();
    let module = if words == ["lib"] || words == ["main"] { &[][..] } else { &words[..] };
    SourceFile::parse(words[0], &place, module, &code)
}
