//! On the host: the room is solved step by step, and its lightmaps are baked.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use web::baked::Baked;
use web::room::Room;

/// After the shots of the lamp something is seen; at the end all is; then a red lamp leaves no blue.
#[test]
fn a_room_in_steps() {
    let mut room = Room::new(64).unwrap();
    let brightness = |room: &mut Room| room.draw().iter().map(|&byte| u64::from(byte)).sum::<u64>();
    let dark = brightness(&mut room);
    while room.rows() < 4 {
        assert!(room.step(500));
    }
    let early = brightness(&mut room);
    while room.step(5000) {}
    let late = brightness(&mut room);
    assert!(dark < early && early < late, "{dark} {early} {late}");
    room.relight(Vec3::new(1.0, 0.5, 1e-6));
    while room.step(5000) {}
    let sum =
        |band: usize, room: &mut Room| room.draw().chunks_exact(4).map(|pixel| u64::from(pixel[band])).sum::<u64>();
    let (red, blue) = (sum(0, &mut room), sum(2, &mut room));
    assert!(2 * blue < red, "blue {blue} of a lamp that has none, red {red}");
}

/// A bake asks for rests all along; its picture is as bright as that of the patches, and a red lamp leaves no blue.
#[test]
fn lightmaps_of_the_same_room() {
    static RESTS: AtomicUsize = AtomicUsize::new(0);
    let mut room = Room::new(64).unwrap();
    while room.step(5000) {}
    let mut baked = Baked::new(64, || _ = RESTS.fetch_add(1, Ordering::Relaxed)).unwrap();
    assert!(RESTS.load(Ordering::Relaxed) > 100_000, "{RESTS:?}");
    let (of_patches, of_texels) = (room.draw(), baked.draw());
    let differences = of_patches.iter().zip(of_texels).map(|(&a, &b)| u64::from(a.abs_diff(b)));
    let mean = differences.sum::<u64>() as f32 / of_patches.len() as f32;
    assert!(mean < 4.0, "{mean} of 255");

    baked.relight(Vec3::new(1.0, 0.5, 0.0));
    let [red, _, blue] =
        [0, 1, 2].map(|band| baked.draw().chunks_exact(4).map(|pixel| u64::from(pixel[band])).sum::<u64>());
    assert!(2 * blue < red, "blue {blue} of a lamp that has none, red {red}");
}
