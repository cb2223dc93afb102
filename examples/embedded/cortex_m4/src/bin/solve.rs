//! The Cornell box alone, without a word: what is linked into this binary contains no panic.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use cortex_m_rt::entry;
use program::report::Report;
use program::{Board, expected, radiosity};

struct Mute;

impl Board for Mute {
    fn instructions(&mut self) -> u64 {
        0
    }

    fn write(&mut self, _: &str) {}
}

#[entry]
fn main() -> ! {
    let [form_factors, radiosities] = radiosity::solve(&mut Report::new(&mut Mute));
    let is_right = form_factors == expected::CHECKSUMS.form_factors && radiosities == expected::CHECKSUMS.radiosities;
    semihosting::process::exit(i32::from(!is_right))
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    semihosting::process::exit(101)
}
