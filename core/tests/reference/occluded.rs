//! Form factors past blockers whose values are known. Each value was computed by two independent routes that agree to
//! the tolerance beside it; none of them is a route of the library.

/// A corner.
pub type Point = [f64; 3];

/// Two polygons, counter-clockwise seen from their fronts, with convex blockers between.
pub struct OccludedPair {
    pub name: &'static str,
    pub a: &'static [Point],
    pub b: &'static [Point],
    pub blockers: &'static [&'static [Point]],
    /// The share of the power leaving `a` that lands on `b`.
    pub factor: f64,
    /// How well the value is known.
    pub tolerance: f64,
}

/// A point that looks along `+z` at a polygon past blockers.
pub struct OccludedPoint {
    pub name: &'static str,
    pub point: Point,
    pub polygon: &'static [Point],
    pub blocker: &'static [Point],
    pub factor: f64,
    pub tolerance: f64,
}

/// Discs on one axis: one, another one that faces it, and a third between.
pub struct OccludedDiscs {
    pub name: &'static str,
    pub radii: [f64; 2],
    pub distance: f64,
    pub blocker_radius: f64,
    pub blocker_distance: f64,
    pub factor: f64,
    pub tolerance: f64,
}

/// A rectangle at height `z` that looks up.
const fn up(x: [f64; 2], y: [f64; 2], z: f64) -> [Point; 4] {
    [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
}

/// A rectangle at height `z` that looks down.
const fn down(x: [f64; 2], y: [f64; 2], z: f64) -> [Point; 4] {
    [[x[0], y[0], z], [x[0], y[1], z], [x[1], y[1], z], [x[1], y[0], z]]
}

/// An upright wall of height 3 on the right of the way from one place to another, which it looks at.
const fn wall(from: [f64; 2], to: [f64; 2]) -> [Point; 4] {
    [[from[0], from[1], 0.0], [to[0], to[1], 0.0], [to[0], to[1], 3.0], [from[0], from[1], 3.0]]
}

const UNIT: [f64; 2] = [0.0, 1.0];
const HALF: [f64; 2] = [0.25, 0.75];
/// So long that its ends change values by less than 1e-12: they count with the inverse cube of their distance.
const ENDLESS: [f64; 2] = [-1e4, 1e4];

const FLOOR: &[Point] = &up(UNIT, UNIT, 0.0);
const CEILING: &[Point] = &down(UNIT, UNIT, 1.0);
/// Between parallel unit squares at distance 1 with nothing between.
const UNOCCLUDED: f64 = 0.199_824_895_698_4;

const fn unit_squares(
    name: &'static str,
    blockers: &'static [&'static [Point]],
    factor: f64,
    tolerance: f64,
) -> OccludedPair {
    OccludedPair { name, a: FLOOR, b: CEILING, blockers, factor, tolerance }
}

const MIDDLE: &[&[Point]] = &[&up(HALF, HALF, 0.5)];
const NEAR_RECEIVER: &[&[Point]] = &[&up(HALF, HALF, 0.9)];
const QUARTER_HEIGHT: &[&[Point]] = &[&up(HALF, HALF, 0.25)];
const THIN_STRIP: &[&[Point]] = &[&up([0.45, 0.55], [-1.0, 2.0], 0.5)];
/// The example of View3D's `square-obstruction.vs3`.
const CORNER: &[&[Point]] = &[&up([0.0, 0.5], [0.0, 0.5], 0.5)];
const WHOLE: &[&[Point]] = &[&up(UNIT, UNIT, 0.5)];

const OFFSET_A: &[Point] = &up([0.0, 2.0], [0.0, 1.0], 0.0);
const OFFSET_B: &[Point] = &down([-0.5, 1.0], [0.25, 2.0], 1.5);
const OFFSET_BLOCKER: &[&[Point]] = &[&up([0.1, 0.9], [0.2, 1.1], 0.6)];

/// The L-shaped room of Pinney and Bean 1988: two corridors 1 wide, 3 long and 3 high that meet in a corner.
const ROOM_SOUTH: &[Point] = &wall([3.0, 0.0], [0.0, 0.0]);
const ROOM_WEST: &[Point] = &wall([0.0, 0.0], [0.0, 3.0]);
const ROOM_NORTH_END: &[Point] = &wall([0.0, 3.0], [1.0, 3.0]);
const ROOM_EAST_END: &[Point] = &wall([3.0, 1.0], [3.0, 0.0]);
/// The inner corner.
const ROOM_INNER: &[&[Point]] = &[&wall([1.0, 3.0], [1.0, 1.0]), &wall([1.0, 1.0], [3.0, 1.0])];

pub const PAIRS: &[OccludedPair] = &[
    unit_squares("squares, blocker half way", MIDDLE, 0.099_506_294_598_98, 1e-10),
    unit_squares("squares, blocker half way, without it", &[], UNOCCLUDED, 1e-10),
    unit_squares("View3D's squares", CORNER, 0.75 * UNOCCLUDED, 1e-10),
    unit_squares("View3D's squares, without the blocker", &[], UNOCCLUDED, 1e-10),
    unit_squares("squares, blocker near the receiver", NEAR_RECEIVER, 0.133_488_790_916_4, 1e-10),
    unit_squares("squares, blocker near the receiver, without it", &[], UNOCCLUDED, 1e-10),
    unit_squares("squares, blocker at a quarter of the height", QUARTER_HEIGHT, 0.115_620_602_132_4, 1e-10),
    unit_squares("squares, blocker at a quarter of the height, without it", &[], UNOCCLUDED, 1e-10),
    unit_squares("squares, thin strip", THIN_STRIP, 0.167_444_111_185_3, 1e-10),
    unit_squares("squares, thin strip, without it", &[], UNOCCLUDED, 1e-10),
    OccludedPair {
        name: "offset rectangles",
        a: OFFSET_A,
        b: OFFSET_B,
        blockers: OFFSET_BLOCKER,
        factor: 0.064_653_642_740_3,
        tolerance: 1e-10,
    },
    OccludedPair {
        name: "offset rectangles, without the blocker",
        a: OFFSET_A,
        b: OFFSET_B,
        blockers: &[],
        factor: 0.158_099_546_875_1,
        tolerance: 1e-10,
    },
    unit_squares("squares, fully blocked", WHOLE, 0.0, 1e-12),
    OccludedPair {
        name: "L-shaped room, walls that share an edge",
        a: ROOM_SOUTH,
        b: ROOM_WEST,
        blockers: ROOM_INNER,
        factor: 0.182_355_903_668_6,
        tolerance: 1e-9,
    },
    OccludedPair {
        name: "L-shaped room, a wall and the end that faces it",
        a: ROOM_SOUTH,
        b: ROOM_NORTH_END,
        blockers: ROOM_INNER,
        factor: 0.032_890_247_563_1,
        tolerance: 1e-10,
    },
    OccludedPair {
        name: "L-shaped room, the other wall and the other end",
        a: ROOM_WEST,
        b: ROOM_EAST_END,
        blockers: ROOM_INNER,
        factor: 0.032_890_247_563_1,
        tolerance: 1e-10,
    },
    // A piece of an endless strip sees as much of another endless strip as the whole.
    OccludedPair {
        name: "endless strips",
        a: &up(UNIT, [-0.5, 0.5], 0.0),
        b: &down(UNIT, ENDLESS, 1.0),
        blockers: &[&up(HALF, ENDLESS, 0.5)],
        factor: 0.118_033_988_749_9,
        tolerance: 1e-12,
    },
];

const STRIP: &[Point] = &down([-0.5, 0.5], ENDLESS, 2.0);
const HALF_PLANE: &[Point] = &up([-1e4, 0.0], ENDLESS, 1.0);

/// An endless strip 1 wide at height 2, half of it behind an endless half-plane at height 1.
const fn penumbra(name: &'static str, x: f64, factor: f64) -> OccludedPoint {
    OccludedPoint { name, point: [x, 0.0, 0.0], polygon: STRIP, blocker: HALF_PLANE, factor, tolerance: 1e-12 }
}

pub const POINTS: &[OccludedPoint] = &[
    penumbra("strip over a half-plane, x = -0.25", -0.25, 0.054_293_908_276_03),
    penumbra("strip over a half-plane, x = 0", 0.0, 0.121_267_812_518_2),
    penumbra("strip over a half-plane, x = 0.25", 0.25, 0.183_285_179_812_8),
    penumbra("strip over a half-plane, x = 0.5", 0.5, 0.223_606_797_75),
    penumbra("strip over a half-plane, x = 1", 1.0, 0.178_732_187_481_8),
    OccludedPoint {
        name: "square behind a square",
        point: [0.0; 3],
        polygon: &down([-0.5, 0.5], [-0.5, 0.5], 1.0),
        blocker: &up([-0.125, 0.125], [-0.125, 0.125], 0.5),
        factor: 0.165_978_835_648_3,
        tolerance: 1e-12,
    },
];

/// The share that a disc of radius 1 at height 2 gets from a point below its center past a disc of radius 0.3 at 1.
pub const POINT_TO_RING: f64 = 0.117_431_192_660_6;

pub const DISCS: &[OccludedDiscs] = &[
    OccludedDiscs {
        name: "equal discs, near",
        radii: [1.0, 1.0],
        distance: 1.0,
        blocker_radius: 0.5,
        blocker_distance: 0.5,
        factor: 0.210_755_517_231_9,
        tolerance: 1e-8,
    },
    OccludedDiscs {
        name: "equal discs, far",
        radii: [1.0, 1.0],
        distance: 2.0,
        blocker_radius: 0.25,
        blocker_distance: 1.0,
        factor: 0.144_146_495_530_7,
        tolerance: 1e-8,
    },
    OccludedDiscs {
        name: "unequal discs",
        radii: [1.0, 0.5],
        distance: 1.5,
        blocker_radius: 0.4,
        blocker_distance: 0.5,
        factor: 0.043_985_258_507_22,
        tolerance: 1e-8,
    },
];
