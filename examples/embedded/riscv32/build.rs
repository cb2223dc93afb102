//! Where the memory of the board lies; with features `large` and `bake` there is more of it.

use std::path::PathBuf;
use std::{env, fs};

fn main() -> std::io::Result<()> {
    let has = |feature: &str| env::var_os(feature).is_some();
    let (flash, ram) = match [has("CARGO_FEATURE_BAKE"), has("CARGO_FEATURE_LARGE")] {
        [true, _] => ("1M", "15M"),
        [_, true] => ("96K", "256K"),
        _ => ("96K", "64K"),
    };
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let regions = ["TEXT", "RODATA"].map(|name| format!("REGION_ALIAS(\"REGION_{name}\", FLASH);\n")).concat()
        + &["DATA", "BSS", "HEAP", "STACK"].map(|name| format!("REGION_ALIAS(\"REGION_{name}\", RAM);\n")).concat();
    let memory = format!(
        "MEMORY\n{{\n    FLASH : ORIGIN = 0x80000000, LENGTH = {flash}\n    RAM : ORIGIN = 0x80100000, LENGTH = {ram}\n}}\n{regions}"
    );
    fs::write(folder.join("memory.x"), memory)?;
    println!("cargo:rustc-link-search={}", folder.display());
    println!("cargo:rerun-if-changed=build.rs");
    Ok(())
}
