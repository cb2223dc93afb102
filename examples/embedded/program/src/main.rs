//! The same program on the host, which tells what every target must compute.

use std::process::ExitCode;

use program::{Board, expected, run};

struct Host;

impl Board for Host {
    fn instructions(&mut self) -> u64 {
        0
    }

    fn write(&mut self, text: &str) {
        print!("{text}");
    }
}

fn main() -> ExitCode {
    if run(&mut Host) == expected::CHECKSUMS { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
