//! Orders for polygons that have none: cut, and checked ray by ray.

use glam::{Vec3, vec3};
use heapless::Vec as Few;
use radiosity::composite::{BspTree, Piece, SplitError, Viewpoint, paint_order};

/// A number in `[0, 1)` for each pair of numbers.
fn chance(seed: u32, k: u32) -> f32 {
    let mut bits = seed.wrapping_mul(0x9e37_79b9) ^ k.wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    ((bits ^ (bits >> 15)) >> 8) as f32 / (1 << 24) as f32
}

fn point(seed: u32, k: u32) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| 2.0 * chance(seed, 3 * k + axis) - 1.0))
}

fn parallelogram(corner: Vec3, a: Vec3, b: Vec3) -> [Vec3; 4] {
    [corner, corner + a, corner + a + b, corner + b]
}

/// Three bars, each over the next at one end and under the one before at the other.
fn cycle() -> [[Vec3; 4]; 3] {
    [0, 1, 2].map(|k| {
        let (sin, cos) = (k as f32 * std::f32::consts::TAU / 3.0).sin_cos();
        let turn = |p: Vec3| vec3(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z);
        [(-1.0, -0.6, -0.3), (1.0, -0.6, 0.3), (1.0, -0.3, 0.3), (-1.0, -0.3, -0.3)]
            .map(|(x, y, z)| turn(vec3(x, y, z)))
    })
}

/// Where a ray from `eye` meets a convex polygon, in multiples of the direction; none near its outline.
fn hit(corners: &[Vec3], eye: Vec3, direction: Vec3) -> Option<f32> {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let place = normal.dot(corners[0] - eye) / normal.dot(direction);
    let at = eye + direction * place;
    let next = |k: usize| corners[(k + 1) % corners.len()];
    let turns = (0..corners.len()).map(|k| (next(k) - corners[k]).cross(at - corners[k]).dot(normal));
    let (low, high) =
        turns.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), turn| (low.min(turn), high.max(turn)));
    (place > 0.0 && (low > 1e-5 || high < -1e-5)).then_some(place)
}

/// Along rays in all directions pieces come from far to near, each polygon is met where it was, and once. How often.
fn check(polygons: &[[Vec3; 4]], order: &[Piece], viewpoint: Viewpoint) -> usize {
    let mut met = 0;
    for k in 0..500 {
        let (eye, direction) = match viewpoint {
            Viewpoint::Eye(eye) => (eye, 0.8 * point(77, k) - eye),
            Viewpoint::Direction(direction) => (1.2 * point(78, k) - 5.0 * direction, direction),
        };
        let hits: Vec<(f32, u32)> =
            order.iter().filter_map(|piece| Some((hit(piece.corners(), eye, direction)?, piece.source))).collect();
        assert!(hits.is_sorted_by(|a, b| a.0 >= b.0 - 2e-4), "{viewpoint:?}: {hits:?}");
        for (source, corners) in (0..).zip(polygons) {
            let pieces = hits.iter().filter(|found| found.1 == source);
            match hit(corners, eye, direction) {
                // Close to a cut a ray may miss both parts.
                Some(place) => {
                    assert!(pieces.clone().count() <= 1 && pieces.clone().all(|found| (found.0 - place).abs() < 1e-3))
                }
                None => assert_eq!(pieces.count(), 0),
            }
        }
        met += hits.len();
    }
    met
}

/// The area of all pieces of each polygon is its area.
fn check_areas(polygons: &[[Vec3; 4]], pieces: &[Piece]) {
    let area = |corners: &[Vec3]| {
        let fan = corners[1..].windows(2).map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
        0.5 * fan.sum::<Vec3>().length()
    };
    for (source, corners) in (0..).zip(polygons) {
        let sum: f32 = pieces.iter().filter(|piece| piece.source == source).map(|piece| area(piece.corners())).sum();
        assert!((sum - area(corners)).abs() < 1e-4, "{sum} {}", area(corners));
    }
}

fn viewpoints() -> Vec<Viewpoint> {
    let eyes = (0..12).map(|k| Viewpoint::Eye(3.0 * point(1, k).normalize()));
    let directions = (0..12).map(|k| Viewpoint::Direction(point(2, k).normalize()));
    eyes.chain(directions).collect()
}

fn random_panes(seed: u32, count: u32) -> Vec<[Vec3; 4]> {
    let pane = |k| parallelogram(0.6 * point(seed, 3 * k), 0.8 * point(seed, 3 * k + 1), 0.8 * point(seed, 3 * k + 2));
    (0..count).map(pane).collect()
}

#[test]
fn trees_have_an_order_for_every_viewpoint() {
    for polygons in [cycle().to_vec(), random_panes(3, 12), random_panes(4, 20)] {
        let mut tree = BspTree::<400>::default();
        (0..).zip(&polygons).for_each(|(source, corners)| tree.insert(corners, source).unwrap());
        let mut met = 0;
        for viewpoint in viewpoints() {
            let order: Vec<Piece> = tree.back_to_front(viewpoint).cloned().collect();
            assert_eq!(order.len(), tree.len());
            met += check(&polygons, &order, viewpoint);
            check_areas(&polygons, &order);
        }
        assert!(met > 2000, "the rays meet something: {met}");
    }
}

#[test]
fn painters_cut_what_has_no_order() {
    for polygons in [cycle().to_vec(), random_panes(3, 12), random_panes(4, 20)] {
        let mut met = 0;
        for viewpoint in viewpoints() {
            let pieces = (0..).zip(&polygons).map(|(source, corners)| Piece::new(corners, source).unwrap());
            let mut order: Few<Piece, 400> = pieces.collect();
            paint_order(&mut order, viewpoint).unwrap();
            met += check(&polygons, &order, viewpoint);
            check_areas(&polygons, &order);
        }
        assert!(met > 2000, "the rays meet something: {met}");
    }
}

/// Three in a cycle need a cut or two, as planes happen to run; panes that an order can draw are not cut.
#[test]
fn painters_cut_no_more_than_they_must() {
    let order = |polygons: &[[Vec3; 4]], viewpoint| {
        let pieces = (0..).zip(polygons).map(|(source, corners)| Piece::new(corners, source).unwrap());
        let mut order: Few<Piece, 64> = pieces.collect();
        paint_order(&mut order, viewpoint).unwrap();
        order.len()
    };
    assert!((4..=5).contains(&order(&cycle(), Viewpoint::Direction(Vec3::NEG_Z))));
    let tiles: Vec<_> = (0..10)
        .map(|k| parallelogram(vec3(0.1 * k as f32, 0.05 * k as f32, 0.2 * k as f32), vec3(1.0, 0.0, 0.1), Vec3::Y))
        .collect();
    viewpoints().into_iter().for_each(|viewpoint| assert_eq!(order(&tiles, viewpoint), 10));
}

#[test]
fn errors_name_the_culprit() {
    let square = [Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y];
    assert_eq!(Piece::new(&[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X], 0), Err(SplitError::Degenerate));
    assert_eq!(Piece::new(&[], 0), Err(SplitError::Degenerate));
    assert_eq!(Piece::new(&[Vec3::ZERO, Vec3::X, Vec3::splat(f32::NAN)], 0), Err(SplitError::Degenerate));
    let bent = [Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.5), Vec3::Y];
    assert!(matches!(Piece::new(&bent, 0), Err(SplitError::Bent { .. })));
    let dart = [[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]].map(|[x, y]| Vec3::new(x, y, 1.0));
    assert_eq!(Piece::new(&dart, 0), Err(SplitError::Concave { corner: 2 }));
    assert_eq!(Piece::new(&[square; 5].concat(), 0), Err(SplitError::Corners));

    let mut tree = BspTree::<2>::default();
    tree.insert(&square, 0).unwrap();
    let before = tree.clone();
    let across = parallelogram(vec3(0.5, 0.0, -1.0), Vec3::Y, 2.0 * Vec3::Z);
    assert_eq!(tree.insert(&across, 1), Err(SplitError::Full { pieces: 2 }));
    assert_eq!(tree, before, "what found no room left no trace");
}
