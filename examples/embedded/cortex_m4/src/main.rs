//! The program on a Cortex-M4F.
#![no_std]
#![no_main]

#[path = "../../stack.rs"]
mod stack;

use core::panic::PanicInfo;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use program::Board;
use program::report::Report;
use semihosting::io::Write;

/// QEMU executes an instruction each nanosecond and gives this board a clock of 25 MHz.
const INSTRUCTIONS_PER_TICK: u64 = 40;
/// The counter has 24 bits.
const TICKS: u32 = 1 << 24;

static WRAPS: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    WRAPS.fetch_add(1, Ordering::Relaxed);
}

struct Mps2 {
    console: Option<semihosting::io::Stdout>,
}

impl Board for Mps2 {
    fn instructions(&mut self) -> u64 {
        let (wraps, left) = (WRAPS.load(Ordering::Relaxed), SYST::get_current());
        (u64::from(wraps) * u64::from(TICKS) + u64::from(TICKS - 1 - left)) * INSTRUCTIONS_PER_TICK
    }

    fn write(&mut self, text: &str) {
        // There is nobody to tell where there is no console; the exit code says whether the results are right.
        let _ = self.console.as_mut().map(|console| console.write_all(text.as_bytes()));
    }
}

#[entry]
fn main() -> ! {
    let stack = stack::Painted::new(cortex_m_rt::heap_start());
    if let Some(mut peripherals) = cortex_m::Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(TICKS - 1);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
        peripherals.SYST.enable_interrupt();
    }
    let mut board = Mps2 { console: semihosting::io::stdout().ok() };
    let checksums = program::run(&mut board);
    Report::new(&mut board).count("peak of the stack in bytes", stack.peak());
    semihosting::process::exit(i32::from(checksums != program::expected::CHECKSUMS))
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    semihosting::process::exit(101)
}
