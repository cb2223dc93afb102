//! What JavaScript sees: numbers and addresses.

use alloc::boxed::Box;
use core::panic::PanicInfo;
use core::ptr;
use core::sync::atomic::{AtomicU32, Ordering};

use glam::Vec3;

use crate::baked::Baked;
use crate::room::Room;

/// Rays between two looks at the clock.
const RAYS: u32 = 64;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Whether the slice is over.
    safe fn is_over() -> u32;
    /// Comes back in the next slice: the page puts the module to sleep until then.
    safe fn rest();
}

#[global_allocator]
static HEAP: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}

/// A room with a picture of `side` x `side` pixels; null where that is too large.
#[unsafe(no_mangle)]
extern "C" fn room_new(side: u32) -> *mut Room {
    Room::new(side).map_or(ptr::null_mut(), |room| Box::into_raw(Box::new(room)))
}

/// Goes on by about `pairs` pairs of patches; 1 while there is more to do.
///
/// # Safety
///
/// `room` comes from [`room_new`], here and below.
#[unsafe(no_mangle)]
unsafe extern "C" fn room_step(room: *mut Room, pairs: u32) -> u32 {
    // SAFETY: the page has one room and one thread.
    u32::from(unsafe { &mut *room }.step(pairs as usize))
}

/// The share of the patches that have shot.
#[unsafe(no_mangle)]
unsafe extern "C" fn room_progress(room: *const Room) -> f32 {
    // SAFETY: as above.
    let room = unsafe { &*room };
    room.rows() as f32 / room.patches() as f32
}

/// Gives the lamp another color.
#[unsafe(no_mangle)]
unsafe extern "C" fn room_relight(room: *mut Room, red: f32, green: f32, blue: f32) {
    // SAFETY: as above.
    unsafe { &mut *room }.relight(Vec3::new(red, green, blue));
}

/// Where the bytes of the picture lie, which is drawn anew.
#[unsafe(no_mangle)]
unsafe extern "C" fn room_draw(room: *mut Room) -> *const u8 {
    // SAFETY: as above.
    unsafe { &mut *room }.draw().as_ptr()
}

/// Bakes lightmaps for a picture of `side` x `side` pixels, with rests; null where that fails.
#[unsafe(no_mangle)]
extern "C" fn baked_new(side: u32) -> *mut Baked {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    let between_rays = || {
        if CALLS.fetch_add(1, Ordering::Relaxed).is_multiple_of(RAYS) && is_over() != 0 {
            rest();
        }
    };
    Baked::new(side, between_rays).map_or(ptr::null_mut(), |baked| Box::into_raw(Box::new(baked)))
}

/// Gives the lamp another color.
///
/// # Safety
///
/// `baked` comes from [`baked_new`], here and below.
#[unsafe(no_mangle)]
unsafe extern "C" fn baked_relight(baked: *mut Baked, red: f32, green: f32, blue: f32) {
    // SAFETY: as above.
    unsafe { &mut *baked }.relight(Vec3::new(red, green, blue));
}

/// Where the bytes of the picture lie, which is drawn anew.
#[unsafe(no_mangle)]
unsafe extern "C" fn baked_draw(baked: *mut Baked) -> *const u8 {
    // SAFETY: as above.
    unsafe { &mut *baked }.draw().as_ptr()
}

/// Whether the program for microcontrollers and the small bake compute here what it computes on the host, bit by bit.
#[unsafe(no_mangle)]
extern "C" fn same_bits() -> u32 {
    let is_same = program::run(&mut Silent) == program::expected::CHECKSUMS;
    u32::from(is_same && small_bake::checksum() == Ok(small_bake::EXPECTED))
}

struct Silent;

impl program::Board for Silent {
    fn instructions(&mut self) -> u64 {
        0
    }

    fn write(&mut self, _: &str) {}
}
