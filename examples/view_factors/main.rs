//! View factors between the surfaces of a file in the input format of View3D, with an estimate of their errors.
//!
//! `view_factors FILE.vs3 [--method M] [--accuracy E]`: start reading at [`solution::solve`].
//!
//! # Beside View3D
//!
//! The largest error of the view factors that View3D 4.0 prints for its public inputs (of the L-shaped room the first
//! row), and of those found here without options:
//!
//! | input | error, View3D | error, here | factor | time, View3D | time, here |
//! |---|---|---|---|---|---|
//! | `cube.vs3` | 2.2e-7 | 1.0e-14 | 2e7 | below 10 ms | 0.05 ms |
//! | `square_obstruction.vs3` | 1.3e-6 | 2.2e-10 | 6e3 | below 10 ms | 1.6 ms |
//! | `l_room.vs3` | 1.5e-5 | 9.3e-11 | 2e5 | below 10 ms | 33 ms |
//! | `l_room_in_planes.vs3` | 1.5e-5 | 3.7e-11 | 4e5 | below 10 ms | 28 ms |
//!
//! View3D prints six digits: its error in the cube is that of printing, those in the others are its own. Its times are
//! known as bounds only. On the L-shaped room, where walls hide each other, it is probably several times faster, at its
//! lower accuracy.
//!
//! # Beside pyviewfactor
//!
//! Printed by `compare_pyviewfactor.py`, which names the geometries. Rows are not scaled here:
//!
//! | geometry | error, here | error, pyviewfactor | time, here | time, pyviewfactor |
//! |---|---|---|---|---|
//! | parallel squares | 1.0e-14 | 1.3e-14 | 0.03 ms | 0.21 ms |
//! | squares with a common edge | 0 | 9.2e-08 | 0.02 ms | 0.22 ms |
//! | triangles with a common edge | 2.9e-15 | 9.2e-08 | 0.02 ms | 0.15 ms |
//! | sphere, 30 triangles: row sums | 3.0e-14 | 5.9e-07 | 1.26 ms | 106.04 ms |
//! | cube, 384 cells: row sums | 1.6e-13 | 9.2e-08 | 225.40 ms | 2289.40 ms |
//! | cube.vs3 | 1.0e-14 | 9.2e-08 | 0.05 ms | 39.99 ms |
//! | square_obstruction.vs3 | 2.2e-10 | 1.5e-01 | 1.59 ms | 39.98 ms |
//! | l_room.vs3 | 2.2e-10 | 3.3e-02 | 32.37 ms | 56.03 ms |
//! | l_room_in_planes.vs3 | 1.8e-10 | 3.3e-02 | 24.77 ms | 51.99 ms |
//!
//! By default pyviewfactor takes a pair for hidden or open as a whole, hence its errors where something hides a
//! part. All times are the best of some runs on two cores that had other work to do, so that only their ratio tells.

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
