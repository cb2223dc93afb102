//! Form factors from a point whose values are known. Each value was computed by two independent routes that agree to at
//! least 1e-11.

/// A corner, a direction.
pub type Point = [f64; 3];

/// What a small element at the origin looks at.
pub enum Target {
    /// Counter-clockwise seen from its front.
    Polygon(&'static [Point]),
    /// With one corner straight ahead at `distance`.
    ParallelRectangle { width: f64, height: f64, distance: f64 },
    /// Its base lies in the plane of the element, with one end at the foot of the perpendicular.
    PerpendicularRectangle { width: f64, height: f64, distance: f64 },
    /// A disc that looks down.
    Disc { center: Point, radius: f64 },
    /// A sphere of radius 1 with so many degrees between the normal and the way to the center.
    Sphere { distance: f64, degrees: f64 },
    /// The upper half of all directions, for an element tilted by so many degrees.
    Sky { degrees: f64 },
    /// A strip without end at height 2, for an element that looks up at `x = 0`.
    Strip { from: f64, to: f64 },
    /// A unit square at height 1 around the axis, less the shadow of a square of side 1/4 at half that height.
    SquareLessShadow,
    /// A disc of radius 1 at height 2 around the axis, less the shadow of a disc of radius 0.3 at half that height.
    DiscLessShadow,
}

pub struct PointCase {
    pub name: &'static str,
    /// Which way the element looks; length 1 up to rounding.
    pub normal: Point,
    pub target: Target,
    pub factor: f64,
}

const UP: Point = [0.0, 0.0, 1.0];
const AHEAD: Point = [1.0, 0.0, 0.0];

const fn case(name: &'static str, normal: Point, target: Target, factor: f64) -> PointCase {
    PointCase { name, normal, target, factor }
}

const fn disc(center: Point, radius: f64) -> Target {
    Target::Disc { center, radius }
}

const fn ahead(width: f64, height: f64, distance: f64) -> Target {
    Target::ParallelRectangle { width, height, distance }
}

const fn beside(width: f64, height: f64, distance: f64) -> Target {
    Target::PerpendicularRectangle { width, height, distance }
}

/// `sqrt(1.05)`: the length of (0.2, 0.1, 1).
const TILTED: f64 = 1.024_695_076_595_959_8;

pub const POINT_CASES: &[PointCase] = &[
    case("disc on the axis, R 0.5, h 2", UP, disc([0.0, 0.0, 2.0], 0.5), 0.05882352941176),
    case("disc on the axis, R 3, h 1", UP, disc([0.0, 0.0, 1.0], 3.0), 0.9),
    case("parallel rectangle 1 x 1 at 1", UP, ahead(1.0, 1.0, 1.0), 0.1385316059949),
    case("parallel rectangle 2 x 1 at 0.5", UP, ahead(2.0, 1.0, 0.5), 0.2207776223348),
    case("the same as a polygon, 1 x 1 at 1", UP, Target::Polygon(&SQUARE_AHEAD), 0.1385316059949),
    case("the same as a polygon, 2 x 1 at 0.5", UP, Target::Polygon(&RECTANGLE_AHEAD), 0.2207776223348),
    case("perpendicular rectangle 1 x 1 at 1", UP, beside(1.0, 1.0, 1.0), 0.05573419700255),
    case("perpendicular rectangle 1 x 2 at 0.5", UP, beside(1.0, 2.0, 0.5), 0.1587748045143),
    case("disc off the axis, R 1, h 1, a 0.5", UP, disc([0.5, 0.0, 1.0], 1.0), 0.4379826327054),
    case("disc off the axis, R 1, h 1, a 2", UP, disc([2.0, 0.0, 1.0], 1.0), 0.05278640450004),
    case("disc off the axis, R 0.5, h 1, a 1.5", UP, disc([1.5, 0.0, 1.0], 0.5), 0.02565835097474),
    case("disc in a perpendicular plane", AHEAD, disc([1.0, 0.0, 2.0], 0.5), 0.0186496251526),
    case("sphere at 2, ahead", UP, Target::Sphere { distance: 2.0, degrees: 0.0 }, 0.25),
    case("sphere at 2, 75 degrees", UP, Target::Sphere { distance: 2.0, degrees: 75.0 }, 0.07041042695343),
    case("sphere at 2, 90 degrees", UP, Target::Sphere { distance: 2.0, degrees: 90.0 }, 0.02883444281122),
    case("sphere at 1.2, 90 degrees", UP, Target::Sphere { distance: 1.2, degrees: 90.0 }, 0.1669434930543),
    case("sphere at 5, 88 degrees", UP, Target::Sphere { distance: 5.0, degrees: 88.0 }, 0.002492272083912),
    case(
        "triangle of no special shape",
        [0.2 / TILTED, 0.1 / TILTED, 1.0 / TILTED],
        Target::Polygon(&[[0.3, -0.2, 1.0], [0.5, 1.1, 1.6], [1.4, 0.1, 0.7]]),
        0.09535000536994,
    ),
    case("rectangle through the horizon", UP, Target::Polygon(&THROUGH_HORIZON), 0.1605788133424),
    case("sky, 30 degrees", UP, Target::Sky { degrees: 30.0 }, 0.9330127018922),
    case("sky, 90 degrees", UP, Target::Sky { degrees: 90.0 }, 0.5),
    case("strip seen past an edge from -0.25", UP, Target::Strip { from: 0.5, to: 0.75 }, 0.05429390827603),
    case("strip seen past an edge from 0", UP, Target::Strip { from: 0.0, to: 0.5 }, 0.1212678125182),
    case("strip seen past an edge from 0.25", UP, Target::Strip { from: -0.5, to: 0.25 }, 0.1832851798128),
    case("strip seen past an edge from 0.5", UP, Target::Strip { from: -1.0, to: 0.0 }, 0.22360679775),
    case("strip seen past an edge from 1", UP, Target::Strip { from: -1.5, to: -0.5 }, 0.1787321874818),
    case("square less a shadow", UP, Target::SquareLessShadow, 0.1659788356483),
    case("disc less a shadow", UP, Target::DiscLessShadow, 0.1174311926606),
];

const SQUARE_AHEAD: [Point; 4] = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
const RECTANGLE_AHEAD: [Point; 4] = [[0.0, 0.0, 0.5], [0.0, 1.0, 0.5], [2.0, 1.0, 0.5], [2.0, 0.0, 0.5]];
const THROUGH_HORIZON: [Point; 4] = [[1.0, -1.0, -0.5], [1.0, -1.0, 1.5], [1.0, 1.0, 1.5], [1.0, 1.0, -0.5]];
