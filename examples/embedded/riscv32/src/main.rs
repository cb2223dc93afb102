//! The program on a RISC-V of 32 bits without floating point unit.
#![no_std]
#![no_main]

#[path = "../../stack.rs"]
mod stack;

use core::panic::PanicInfo;

use program::Board;
use program::report::Report;
use riscv_rt::entry;
use semihosting::io::Write;

struct Virt {
    console: Option<semihosting::io::Stdout>,
}

impl Board for Virt {
    fn instructions(&mut self) -> u64 {
        riscv::register::minstret::read64()
    }

    fn write(&mut self, text: &str) {
        // There is nobody to tell where there is no console; the exit code says whether the results are right.
        let _ = self.console.as_mut().map(|console| console.write_all(text.as_bytes()));
    }
}

#[entry]
fn main() -> ! {
    let stack = stack::Painted::new(riscv_rt::heap_start().cast());
    let mut board = Virt { console: semihosting::io::stdout().ok() };
    let checksums = program::run(&mut board);
    Report::new(&mut board).count("peak of the stack in bytes", stack.peak());
    semihosting::process::exit(i32::from(checksums != program::expected::CHECKSUMS))
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    semihosting::process::exit(101)
}
