//! The rules that keep the sources readable: who may name whom, and how long things may get.
//!
//! They are checked on the text of the sources, with comments and literals blanked.

use std::fs;
use std::path::{Path, PathBuf};

const LONGEST_FUNCTION: usize = 60;
const LONGEST_FILE: usize = 600;

/// Each outside crate of the core and the only place that may name it.
const DOORS: [(&str, &str); 5] = [
    ("libm", "core/src/math"),
    ("obvhs", "core/src/geometry/bvh.rs"),
    ("pulp", "core/src/geometry/wide/avx2.rs"),
    ("uvunwrap", "core/src/lightmap/unwrap.rs"),
    ("rayon", "core/src/parallel"),
];

/// The only place of the plugin that knows what is inside both worlds.
const CONVERT: &str = "bevy_plugin/src/convert";
const MODULES_OF_THE_CORE: [&str; 4] = ["geometry", "material", "light", "scene"];
const INSIDES_OF_BEVY: [&str; 6] =
    ["VertexAttributeValues", "Indices", "PrimitiveTopology", "StandardMaterial", "GltfMaterial", "TextureFormat"];

/// A source file; the code has the line breaks of the file, and blanks for comments and literals.
struct Source {
    path: String,
    code: String,
}

/// The lines of a function, from its name to its closing brace, counted from 0.
struct Function {
    first: usize,
    body: usize,
    last: usize,
}

#[test]
fn a_module_uses_only_modules_above_it() {
    let map = fs::read_to_string(root().join("core/src/lib.rs")).expect("the core has a lib.rs");
    let order: Vec<&str> = map.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    assert!(order.len() > 5, "lib.rs is the map of the core: {order:?}");
    assert_none(sources("core/src").iter().flat_map(|source| upward_uses(source, &order)));
}

#[test]
fn bevy_never_enters_the_core() {
    let is_bevy = |word: &str| word.starts_with("bevy") || word.starts_with("Bevy");
    assert_none(sources("core/src").iter().flat_map(|source| naming(source, is_bevy)));
}

#[test]
fn every_outside_crate_has_one_door() {
    let files = ["core/src", "bevy_plugin/src"].into_iter().flat_map(sources).collect::<Vec<_>>();
    for (name, door) in DOORS {
        let elsewhere = files.iter().filter(|source| !source.path.starts_with(door));
        assert_none(elsewhere.flat_map(|source| naming(source, |word| word == name)));
    }
}

/// Outside the door, a file that handles meshes, materials, lights or scenes of the core may pass Bevy's on, but not
/// look inside.
#[test]
fn only_convert_knows_both_worlds() {
    let files = sources("bevy_plugin/src");
    let others = files.iter().filter(|source| !source.path.starts_with(CONVERT));
    let of_core = others.filter(|source| {
        uses_of("radiosity::", &source.code).iter().any(|(_, name)| MODULES_OF_THE_CORE.contains(&name.as_str()))
    });
    assert_none(of_core.flat_map(|source| naming(source, |word| INSIDES_OF_BEVY.contains(&word))));
}

#[test]
fn functions_are_short() {
    assert_none(all_sources().iter().flat_map(|source| {
        let long = functions(&source.code).into_iter().filter(|f| f.last - f.first + 1 > LONGEST_FUNCTION);
        long.map(|f| format!("{}:{} has {} lines", source.path, f.first + 1, f.last - f.first + 1)).collect::<Vec<_>>()
    }));
}

#[test]
fn files_are_short() {
    let long = |source: &Source| source.code.lines().count() > LONGEST_FILE;
    assert_none(all_sources().iter().filter(|source| long(source)).map(|source| source.path.clone()));
}

/// `expect` with a reason instead.
#[test]
fn no_lint_is_allowed() {
    assert_none(all_sources().iter().flat_map(|source| lines_with(source, |line| line.contains("[allow("))));
}

#[test]
fn no_configuration_inside_bodies() {
    assert_none(all_sources().iter().flat_map(|source| {
        let bodies = functions(&source.code);
        let inside = move |number| bodies.iter().any(|f| number >= f.body && number <= f.last);
        let lines = source.code.lines().enumerate();
        lines
            .filter(move |&(number, line)| (line.contains("#[cfg") || line.contains("cfg!(")) && inside(number))
            .map(|(number, _)| format!("{}:{}", source.path, number + 1))
    }));
}

/// The rules see what they forbid: without this, a mistake in them would let everything pass.
#[test]
fn rules_find_what_they_forbid() {
    let text = "//! libm\nuse crate::{math, bake::Bake};\nconst A: &str = \"{ rayon\\\"\"; // }\n\
                fn long<'a>(x: [u8; 2]) -> char {\n    #[cfg(test)]\n    let y = '{';\n    y\n}\nfn none();\n";
    let source = Source { path: "core/src/math/mod.rs".into(), code: blank(text) };
    assert_eq!(source.code.lines().count(), text.lines().count());
    assert_eq!(upward_uses(&source, &["math", "bake"]).len(), 1);
    assert!(naming(&source, |word| word == "libm" || word == "rayon").is_empty());
    assert_eq!(naming(&source, |word| word == "Bake").len(), 1);
    let found = functions(&source.code);
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].first, found[0].body, found[0].last), (3, 3, 7));
}

fn assert_none(violations: impl Iterator<Item = String>) {
    let violations: Vec<String> = violations.collect();
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn all_sources() -> Vec<Source> {
    ["core", "bevy_plugin", "tests", "examples"].into_iter().flat_map(sources).collect()
}

/// All Rust files below a folder of the repository, in the order of their paths.
fn sources(folder: &str) -> Vec<Source> {
    let mut paths = Vec::new();
    collect(&root().join(folder), &mut paths);
    paths.sort();
    let read = |path: &PathBuf| fs::read_to_string(path).expect("sources are readable text");
    let relative = |path: &PathBuf| path.strip_prefix(root()).expect("below the root").to_string_lossy().into_owned();
    paths.iter().map(|path| Source { path: relative(path), code: blank(&read(path)) }).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() && path.file_name().is_none_or(|name| name != "target") {
            collect(&path, paths);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            paths.push(path);
        }
    }
}

/// Uses of modules that stand below the one that a file belongs to. Its tests may use what they like.
fn upward_uses(source: &Source, order: &[&str]) -> Vec<String> {
    let inside = source.path.trim_start_matches("core/src/");
    let module = inside.split(['/', '.']).next().unwrap_or_default();
    let Some(own) = order.iter().position(|&name| name == module) else {
        return if module == "lib" { Vec::new() } else { vec![format!("{} is not in lib.rs", source.path)] };
    };
    let code = source.code.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let uses = uses_of("crate::", code).into_iter();
    let below = uses.filter(|(_, name)| order.iter().position(|other| other == name).is_some_and(|other| other > own));
    below.map(|(line, name)| format!("{}:{} uses {name}, which stands below {module}", source.path, line + 1)).collect()
}

/// The names that follow a path prefix, alone or in braces, each with its line.
fn uses_of(prefix: &str, code: &str) -> Vec<(usize, String)> {
    let mut uses = Vec::new();
    for (start, _) in code.match_indices(prefix) {
        if code[..start].ends_with(is_of_word) {
            continue;
        }
        let line = code[..start].matches('\n').count();
        let rest = &code[start + prefix.len()..];
        match rest.strip_prefix('{') {
            Some(list) => uses.extend(outer_names(list).into_iter().map(|name| (line, name))),
            None => uses.push((line, first_word(rest).to_owned())),
        }
    }
    uses
}

/// The first words of the items of a list, up to the brace that closes it.
fn outer_names(list: &str) -> Vec<String> {
    let mut depth = 0;
    let mut items = vec![String::new()];
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => items.push(String::new()),
            _ if depth == 0 => items.last_mut().expect("never empty").push(c),
            _ => {}
        }
    }
    items.iter().map(|item| first_word(item.trim()).to_owned()).filter(|name| !name.is_empty()).collect()
}

fn first_word(text: &str) -> &str {
    text.split(|c| !is_of_word(c)).next().unwrap_or_default()
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The lines that name something.
fn naming(source: &Source, is_meant: impl Fn(&str) -> bool) -> Vec<String> {
    lines_with(source, |line| line.split(|c| !is_of_word(c)).any(&is_meant))
}

fn lines_with(source: &Source, is_meant: impl Fn(&str) -> bool) -> Vec<String> {
    let lines = source.code.lines().enumerate().filter(|(_, line)| is_meant(line));
    lines.map(|(number, line)| format!("{}:{}: {}", source.path, number + 1, line.trim())).collect()
}

/// All functions with a body, nested ones too.
fn functions(code: &str) -> Vec<Function> {
    let line_of = |at: usize| code[..at].matches('\n').count();
    let starts = code.match_indices("fn ").map(|(start, _)| start);
    let named = starts.filter(|&start| {
        !code[..start].ends_with(is_of_word) && code[start + 3..].starts_with(|c: char| c.is_alphabetic() || c == '_')
    });
    let with_body = named.filter_map(|start| {
        let open = start + end_of_signature(&code[start..])?;
        let close = open + closing_brace(&code[open..])?;
        Some(Function { first: line_of(start), body: line_of(open), last: line_of(close) })
    });
    with_body.collect()
}

/// Where the body opens, if there is one: the first brace outside parentheses and brackets.
fn end_of_signature(code: &str) -> Option<usize> {
    let mut depth = 0;
    for (at, c) in code.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '{' if depth == 0 => return Some(at),
            ';' if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

/// Where the brace that opens `code` is closed.
fn closing_brace(code: &str) -> Option<usize> {
    let mut depth = 0;
    code.char_indices().find_map(|(at, c)| {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        (depth == 0).then_some(at)
    })
}

/// The same text with blanks for comments and the insides of literals; line breaks stay.
fn blank(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let taken = comment(rest).or_else(|| raw_string(rest, &code)).or_else(|| quoted(rest));
        match taken {
            Some(length) => code.extend(rest[..length].chars().map(|c| if c == '\n' { '\n' } else { ' ' })),
            None => code.push(c),
        }
        rest = &rest[taken.unwrap_or(c.len_utf8())..];
    }
    code
}

/// Length of the comment that `text` starts with.
fn comment(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find('\n').unwrap_or(text.len()));
    }
    text.starts_with("/*").then(|| {
        let mut depth = 0;
        let end = text.char_indices().find(|&(at, _)| {
            depth += i32::from(text[at..].starts_with("/*")) - i32::from(text[..at].ends_with("*/"));
            at > 1 && depth == 0
        });
        end.map_or(text.len(), |(at, _)| at)
    })
}

/// Length of the raw string that `text` starts with, given what stands before it.
fn raw_string(text: &str, before: &str) -> Option<usize> {
    let hashes = text.strip_prefix('r').filter(|_| !before.ends_with(|c: char| is_of_word(c) && c != 'b'))?;
    let count = hashes.len() - hashes.trim_start_matches('#').len();
    let inside = hashes[count..].strip_prefix('"')?;
    let close = format!("\"{}", "#".repeat(count));
    let start = text.len() - inside.len();
    Some(inside.find(&close).map_or(text.len(), |at| start + at + close.len()))
}

/// Length of the string or character that `text` starts with; lifetimes are none.
fn quoted(text: &str) -> Option<usize> {
    let quote = text.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let mut escaped = false;
    let end = text.char_indices().skip(1).find(|&(_, c)| {
        let closes = c == quote && !escaped;
        escaped = c == '\\' && !escaped;
        closes
    });
    let length = end.map_or(text.len(), |(at, _)| at + 1);
    let characters = text[..length].chars().count() - 2;
    let is_string = quote == '"' || characters == 1 || text[1..].starts_with('\\');
    is_string.then_some(length)
}
