//! Orders of drawing: true, stable, and calm.

use radiosity::composite::{Draw, DrawKey, Tolerance, resort, sort};

/// A number in `[0, 1)` for each pair of numbers.
fn chance(seed: u32, k: u32) -> f32 {
    let mut bits = seed.wrapping_mul(0x9e37_79b9) ^ k.wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    ((bits ^ (bits >> 15)) >> 8) as f32 / (1 << 24) as f32
}

fn draws(depths: impl IntoIterator<Item = f32>) -> Vec<Draw> {
    let draw = |(index, depth)| Draw { key: DrawKey::new(0, 0, depth), rank: index, index };
    (0..).zip(depths).map(draw).collect()
}

fn indices(draws: &[Draw]) -> Vec<u32> {
    draws.iter().map(|draw| draw.index).collect()
}

/// The same as a stable sort of the standard library, for all kinds of keys and counts; ranks are the new places.
#[test]
fn sorted_as_by_the_standard_library() {
    for count in [0, 1, 2, 10, 192, 193, 1000, 30_000] {
        for kind in 0..4 {
            let key = |k: u32| {
                let depth = -100.0 * chance(kind, k);
                match kind {
                    0 => DrawKey::new(0, 0, depth),
                    1 => DrawKey::new((k % 3) as i16 - 1, (k % 7) as i16 - 3, depth),
                    2 => DrawKey::new(0, 0, depth.round()),
                    _ => DrawKey::new(5, 0, if k.is_multiple_of(2) { -3.0 } else { f32::from_bits(k << 8) }),
                }
            };
            let mut draws: Vec<Draw> = (0..count).map(|k| Draw { key: key(k), rank: k, index: k }).collect();
            let mut expected = draws.clone();
            expected.sort_by_key(|draw| draw.key);
            let (mut again, mut in_place) = (draws.clone(), draws.clone());
            let mut scratch = expected.clone();
            sort(&mut draws, &mut scratch);
            assert_eq!(indices(&draws), indices(&expected), "{count} of kind {kind}");
            assert!((0..).zip(&draws).all(|(rank, draw)| draw.rank == rank));
            resort(&mut again, &mut scratch, Tolerance::NONE);
            sort(&mut in_place, &mut []);
            assert_eq!([&again, &in_place], [&draws; 2]);
        }
    }
}

/// Things that move a little from frame to frame are in true order in each.
#[test]
fn frame_by_frame() {
    let mut order = draws((0..2000).map(|k| -100.0 * chance(1, k)));
    sort(&mut order, &mut []);
    for frame in 0..200 {
        for draw in &mut order {
            let depth = -100.0 * chance(1, draw.index) + 3.0 * (0.02 * frame as f32 * chance(2, draw.index)).sin();
            draw.key = DrawKey::new(0, 0, depth);
        }
        resort(&mut order, &mut [], Tolerance::NONE);
        assert!(order.is_sorted_by_key(|draw| draw.key));
    }
}

/// Twenty panes at one depth and a camera that trembles: rounding favors another one in each frame, the order stays.
#[test]
fn equal_depths_do_not_flicker() {
    let mut order = draws((0..40).map(|k| if k % 2 == 0 { -5.0 } else { -10.0 * chance(3, k) }));
    sort(&mut order, &mut []);
    let calm = indices(&order);
    let mut changed = 0;
    for frame in 0..500 {
        for draw in &mut order {
            let k = draw.index;
            let depth = if k % 2 == 0 { -5.0 } else { -10.0 * chance(3, k) };
            draw.key = DrawKey::new(0, 0, depth + 1e-5 * (chance(frame, k) - 0.5));
        }
        let mut hasty = order.clone();
        resort(&mut hasty, &mut [], Tolerance::NONE);
        changed += usize::from(indices(&hasty) != calm);
        resort(&mut order, &mut [], within(1e-4));
        assert_eq!(indices(&order), calm, "frame {frame}");
    }
    assert!(changed > 400, "without a tolerance they flicker: {changed}");
}

/// However close depths lie: what differs by more than the tolerance is in true order, and neighbors change places less
/// often than without.
#[test]
fn no_pair_is_wrong_by_more_than_the_tolerance() {
    let [calm, hasty] = [0.01, 0.0].map(|tolerance| {
        let mut order = draws((0..600).map(|k| -chance(4, k)));
        let mut changes = 0;
        for frame in 0..100 {
            for draw in &mut order {
                draw.key = DrawKey::new(0, 0, -chance(4, draw.index) + 0.008 * chance(frame + 9, draw.index));
            }
            let before: Vec<(u32, u32)> = order.windows(2).map(|pair| (pair[0].index, pair[1].index)).collect();
            resort(&mut order, &mut [], within(tolerance));
            changes += order.windows(2).filter(|pair| !before.contains(&(pair[0].index, pair[1].index))).count();
            let mut farthest = f32::INFINITY;
            for draw in order.iter().rev() {
                assert!(draw.key.depth() <= farthest + tolerance);
                farthest = farthest.min(draw.key.depth());
            }
        }
        changes
    });
    assert!(calm < hasty / 4, "{calm} changes, {hasty} without tolerance");
}

/// New things find their place, and those that are gone leave none behind.
#[test]
fn things_come_and_go() {
    let mut order = draws((0..500).map(|k| -100.0 * chance(5, k)));
    sort(&mut order, &mut []);
    for frame in 1..50 {
        order.retain(|draw| draw.index % 50 != frame);
        let index = 1000 + frame;
        order.push(Draw { key: DrawKey::new(0, 0, -100.0 * chance(6, frame)), rank: u32::MAX, index });
        resort(&mut order, &mut [], within(1e-6));
        assert!(order.is_sorted_by_key(|draw| draw.key));
        assert!(order.iter().any(|draw| draw.index == index));
    }
}

fn within(least: f32) -> Tolerance {
    Tolerance { least, share: 0.0 }
}

/// What is far away, or lies there by a bias, makes nothing near equal; and what rounding makes of far things stays in order.
#[test]
fn far_things_leave_near_ones_alone() {
    let tolerance = Tolerance { least: 0.0, share: 4.0 * f32::EPSILON };
    let draw = |index: u32, depth: f32| Draw { key: DrawKey::new(0, 0, depth), rank: index, index };
    let mut order =
        [-1e8, 1e8, -2.0, -1.0].into_iter().zip(0..).map(|(depth, index)| draw(index, depth)).collect::<Vec<_>>();
    resort(&mut order, &mut [], tolerance);
    order.iter_mut().filter(|draw| draw.index == 3).for_each(|draw| draw.key = DrawKey::new(0, 0, -2.00001));
    resort(&mut order, &mut [], tolerance);
    let indices: Vec<u32> = order.iter().map(|draw| draw.index).collect();
    assert_eq!(indices, [0, 3, 2, 1]);
    // Two at 1e5 m tremble by a rounding of their depth.
    let mut far = [draw(0, -1e5), draw(1, -1e5)];
    for frame in 0..20_u32 {
        for draw in &mut far {
            let off = if (frame + draw.index) % 2 == 0 { 0.0078125 } else { 0.0 };
            draw.key = DrawKey::new(0, 0, -1e5 + off);
        }
        resort(&mut far, &mut [], tolerance);
        assert_eq!(far.map(|draw| draw.index), [0, 1], "frame {frame}");
    }
}
