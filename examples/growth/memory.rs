//! What the program has of the heap.

use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// Forgets the most that was ever used; returns what is used now, in bytes.
pub fn start() -> u64 {
    HEAP.reset_peak_usage();
    HEAP.current_usage() as u64
}

/// The most that was used since the start.
pub fn peak() -> u64 {
    HEAP.peak_usage() as u64
}
