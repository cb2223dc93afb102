//! A bake on a heap, without a word: the exit code says whether its bits are those of the host.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use cortex_m as _; // Its critical section.
use cortex_m_rt::entry;
use embedded_alloc::TlsfHeap;

/// The rest of the 16 MiB is left to the stack.
const HEAP_BYTES: usize = 12 << 20;

#[global_allocator]
static HEAP: TlsfHeap = TlsfHeap::empty();

#[entry]
fn main() -> ! {
    // SAFETY: it is called once, before anything is allocated; nothing else lies between the statics and the stack.
    unsafe { HEAP.init(cortex_m_rt::heap_start() as usize, HEAP_BYTES) };
    semihosting::process::exit(i32::from(small_bake::checksum() != Ok(small_bake::EXPECTED)))
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    semihosting::process::exit(101)
}
