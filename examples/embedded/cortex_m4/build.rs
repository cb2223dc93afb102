//! Where the memory of the board lies; with features `large` and `bake` there is more of it.

use std::path::PathBuf;
use std::{env, fs};

fn main() -> std::io::Result<()> {
    let has = |feature: &str| env::var_os(feature).is_some();
    let (flash, ram) = match [has("CARGO_FEATURE_BAKE"), has("CARGO_FEATURE_LARGE")] {
        // The second memory of the board in QEMU.
        [true, _] => ("4M", "ORIGIN = 0x21000000, LENGTH = 16M"),
        [_, true] => ("96K", "ORIGIN = 0x20000000, LENGTH = 256K"),
        _ => ("96K", "ORIGIN = 0x20000000, LENGTH = 64K"),
    };
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let memory = format!("MEMORY\n{{\n    FLASH : ORIGIN = 0x00000000, LENGTH = {flash}\n    RAM : {ram}\n}}\n");
    fs::write(folder.join("memory.x"), memory)?;
    println!("cargo:rustc-link-search={}", folder.display());
    println!("cargo:rerun-if-changed=build.rs");
    Ok(())
}
