//! What the readme shows is what the documentation compiles.

/// The first block of code of a text that starts with `fence`, without `prefix` before its lines.
fn block(text: &str, fence: &str, prefix: &str) -> String {
    let lines = text.lines().skip_while(|line| *line != fence).skip(1);
    let code = lines.take_while(|line| !line.ends_with("```"));
    code.map(|line| line.strip_prefix(prefix).unwrap_or(line).trim_start_matches("//!")).collect::<Vec<_>>().join("\n")
}

#[test]
fn hello_world_of_the_readme_compiles() {
    let readme = block(include_str!("../README.md"), "```rust", "");
    let documentation = block(include_str!("../bevy_plugin/src/lib.rs"), "//! ```no_run", "//! ");
    assert!(readme.contains("fn main()"), "{readme}");
    assert_eq!(readme, documentation);
    assert!(readme.lines().count() <= 15);
}
