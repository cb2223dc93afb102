//! The command line of `bevy_radiosity`; see `bake --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    bevy_radiosity::cli::run(std::env::args_os())
}
