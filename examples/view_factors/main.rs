//! View factors between the surfaces of a file in the input format of View3D, with an estimate of their errors.
//!
//! `view_factors FILE.vs3 [--method M] [--accuracy E]`: start reading at [`solution::solve`].

mod args;
mod blocking;
mod exchange;
mod factors;
mod flaw;
mod geometry;
mod lines;
mod method;
mod plane;
mod polygon;
mod report;
mod rows;
mod solution;
#[cfg(test)]
mod tests;
mod vs3;

use std::io::Write;
use std::process::ExitCode;
use std::{env, fs, io};

fn main() -> ExitCode {
    if env::args().any(|word| word == "--help" || word == "-h") {
        println!("{}", args::USAGE);
        return ExitCode::SUCCESS;
    }
    let args = match args::parse(env::args().skip(1)) {
        Ok(args) => args,
        Err(what) => {
            eprintln!("view_factors: {what}\n\n{}", args::USAGE);
            return ExitCode::from(2);
        }
    };
    let name = args.file.display();
    let text = match fs::read(&args.file) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) => {
            eprintln!("{name}: {error}; give the path of a file that can be read");
            return ExitCode::FAILURE;
        }
    };
    match solution::solve(&text, args.method, args.accuracy) {
        Ok(solution) => {
            solution.warnings.iter().for_each(|warning| eprintln!("{name}:{warning} (warning)"));
            // Whoever reads only the first lines closes the pipe: no reason to panic.
            io::stdout().write_all(solution.to_string().as_bytes()).map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS)
        }
        Err(flaw) => {
            eprintln!("{name}:{flaw}");
            ExitCode::FAILURE
        }
    }
}
