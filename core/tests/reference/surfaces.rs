//! Form factors between surfaces, nothing between, whose values are known. Each value was computed by two independent
//! routes that agree to at least 1e-11, those of two spheres to 1e-9.

/// Two surfaces, from the first to the second.
pub enum Surfaces {
    /// Equal and opposite.
    ParallelRectangles {
        width: f64,
        height: f64,
        distance: f64,
    },
    /// `[x, x], [y, y]` of both.
    ParallelOffset {
        a: [[f64; 2]; 2],
        b: [[f64; 2]; 2],
        distance: f64,
    },
    /// Sharing an edge at a right angle.
    PerpendicularRectangles {
        length: f64,
        width: f64,
        height: f64,
    },
    /// Distances from the line where the planes meet, and places along it, of both.
    PerpendicularOffset {
        a: [[f64; 2]; 2],
        b: [[f64; 2]; 2],
    },
    /// Unit squares that share an edge, with so many degrees between them.
    TiltedSquares {
        degrees: f64,
    },
    CoaxialDiscs {
        from: f64,
        to: f64,
        distance: f64,
    },
    /// From a sphere to a disc it has on its axis.
    SphereToDisc {
        radius: f64,
        distance: f64,
    },
    /// From a sphere to a rectangle with one corner straight ahead.
    SphereToRectangle {
        width: f64,
        height: f64,
        distance: f64,
    },
    /// From a sphere in the middle of a unit cube to one of its faces.
    SphereToCubeFace,
    /// Back again.
    CubeFaceToSphere {
        radius: f64,
    },
    OuterSphereToInner {
        inner: f64,
        outer: f64,
    },
    TwoSpheres {
        from: f64,
        to: f64,
        distance: f64,
    },
    /// From the outside of the inner one to the inside of the outer one, of equal height.
    CoaxialCylinders {
        inner: f64,
        outer: f64,
        height: f64,
    },
    CylinderSideToItself {
        radius: f64,
        height: f64,
    },
    CylinderBaseToSide {
        radius: f64,
        height: f64,
    },
    /// The inside of a hemisphere to itself.
    Hemisphere,
    /// Strips without end.
    ParallelStrips {
        width: f64,
        distance: f64,
    },
    /// Strips of width 1 that share an edge.
    StripsAtAnAngle {
        degrees: f64,
    },
    /// From side to side of a triangular duct: the first two of the sides and the third one.
    TriangularDuct {
        from: f64,
        to: f64,
        third: f64,
    },
    /// The sum over all that one face of a box sees; the face is `width` x `height`.
    BoxRow {
        width: f64,
        height: f64,
        depth: f64,
    },
    /// From face to face of a regular tetrahedron.
    Tetrahedron,
}

pub struct SurfaceCase {
    pub name: &'static str,
    pub surfaces: Surfaces,
    pub factor: f64,
}

use Surfaces::*;

const UNIT: [f64; 2] = [0.0, 1.0];

const fn case(name: &'static str, surfaces: Surfaces, factor: f64) -> SurfaceCase {
    SurfaceCase { name, surfaces, factor }
}

const fn squares(name: &'static str, distance: f64, factor: f64) -> SurfaceCase {
    case(name, ParallelRectangles { width: 1.0, height: 1.0, distance }, factor)
}

const fn corner(name: &'static str, length: f64, width: f64, height: f64, factor: f64) -> SurfaceCase {
    case(name, PerpendicularRectangles { length, width, height }, factor)
}

const fn tilted(name: &'static str, degrees: f64, factor: f64) -> SurfaceCase {
    case(name, TiltedSquares { degrees }, factor)
}

const fn spheres(name: &'static str, from: f64, to: f64, distance: f64, factor: f64) -> SurfaceCase {
    case(name, TwoSpheres { from, to, distance }, factor)
}

const fn wedge(name: &'static str, degrees: f64, factor: f64) -> SurfaceCase {
    case(name, StripsAtAnAngle { degrees }, factor)
}

const fn offset(name: &'static str, a: [[f64; 2]; 2], b: [[f64; 2]; 2], distance: f64, factor: f64) -> SurfaceCase {
    case(name, ParallelOffset { a, b, distance }, factor)
}

const fn across(name: &'static str, a: [[f64; 2]; 2], b: [[f64; 2]; 2], factor: f64) -> SurfaceCase {
    case(name, PerpendicularOffset { a, b }, factor)
}

pub const SURFACE_CASES: &[SurfaceCase] = &[
    squares("parallel squares at 0.1", 0.1, 0.8269945223973),
    squares("parallel squares at 0.5", 0.5, 0.4152532835771),
    squares("parallel squares at 1", 1.0, 0.1998248956984),
    squares("parallel squares at 2", 2.0, 0.06858958881855),
    squares("parallel squares at 5", 5.0, 0.01240397731324),
    squares("parallel squares at 10", 10.0, 0.003162056838757),
    case(
        "parallel rectangles 2 x 1 at 1",
        ParallelRectangles { width: 2.0, height: 1.0, distance: 1.0 },
        0.2858753848507,
    ),
    offset("parallel, side by side", [UNIT, UNIT], [[1.0, 2.0], UNIT], 1.0, 0.08605048915233),
    offset("parallel, overlapping", [UNIT, UNIT], [[0.5, 1.5], [0.25, 1.25]], 0.75, 0.1979911831276),
    offset("parallel, of two sizes", [UNIT, [0.0, 2.0]], [[2.0, 4.0], [-1.0, 0.5]], 1.5, 0.02641036756062),
    offset("parallel, at a slant", [UNIT, UNIT], [[3.0, 4.0], [3.0, 4.0]], 0.25, 6.58665153347e-5),
    corner("corner 1, 1, 1", 1.0, 1.0, 1.0, 0.2000437760754),
    corner("corner 1, 1, 2", 1.0, 1.0, 2.0, 0.2328526027954),
    corner("corner 1, 0.1, 0.1", 1.0, 0.1, 0.1, 0.2818878067879),
    corner("corner 2, 1, 1", 2.0, 1.0, 1.0, 0.240636006177),
    across("perpendicular with gaps", [[0.1, 1.1], UNIT], [[0.1, 1.1], UNIT], 0.1542068684941),
    across("perpendicular, shifted", [[0.5, 1.5], UNIT], [[0.25, 2.0], [1.0, 3.0]], 0.06913976014511),
    across("perpendicular, apart", [[1.0, 3.0], [0.0, 2.0]], [UNIT, [-1.0, 0.0]], 0.008817337892227),
    tilted("squares at 30 degrees", 30.0, 0.6190283230908),
    tilted("squares at 45 degrees", 45.0, 0.4833476954789),
    tilted("squares at 60 degrees", 60.0, 0.3709053211501),
    tilted("squares at 90 degrees", 90.0, 0.2000437760754),
    tilted("squares at 120 degrees", 120.0, 0.08661500111828),
    tilted("squares at 150 degrees", 150.0, 0.02134532541269),
    case("discs 1 and 2 at 1", CoaxialDiscs { from: 1.0, to: 2.0, distance: 1.0 }, 0.7639320225002),
    case("sphere to a disc, R 1, h 2", SphereToDisc { radius: 1.0, distance: 2.0 }, 0.05278640450004),
    case("sphere to a disc, R 2, h 1.5", SphereToDisc { radius: 2.0, distance: 1.5 }, 0.2),
    case("sphere to a rectangle", SphereToRectangle { width: 1.0, height: 2.0, distance: 1.5 }, 0.03658894613947),
    case("sphere to a face of the cube around it", SphereToCubeFace, 1.0 / 6.0),
    case("face of a cube to a sphere in it", CubeFaceToSphere { radius: 0.25 }, 0.1308996938996),
    case("concentric spheres", OuterSphereToInner { inner: 1.0, outer: 2.0 }, 0.25),
    spheres("spheres 1 and 1 at 4", 1.0, 1.0, 4.0, 0.01615624436987),
    spheres("spheres 1 and 2 at 5", 1.0, 2.0, 5.0, 0.04227799796385),
    spheres("spheres 1 and 1 at 2.5", 1.0, 1.0, 2.5, 0.0441189329067),
    case("coaxial cylinders 0.5 and 0.75", CoaxialCylinders { inner: 0.5, outer: 0.75, height: 1.0 }, 0.8165946348147),
    case("coaxial cylinders 1 and 2", CoaxialCylinders { inner: 1.0, outer: 2.0, height: 1.0 }, 0.4645489964878),
    case("side of a cylinder", CylinderSideToItself { radius: 1.0, height: 1.0 }, 0.3819660112501),
    case("base to side of a cylinder", CylinderBaseToSide { radius: 1.0, height: 1.0 }, 0.6180339887499),
    case("inside of a hemisphere", Hemisphere, 0.5),
    case("strips at 0.5", ParallelStrips { width: 1.0, distance: 0.5 }, 0.6180339887499),
    case("strips at 1", ParallelStrips { width: 1.0, distance: 1.0 }, 0.4142135623731),
    wedge("wedge of 30 degrees", 30.0, 0.7411809548975),
    wedge("wedge of 60 degrees", 60.0, 0.5),
    wedge("wedge of 90 degrees", 90.0, 0.2928932188135),
    wedge("wedge of 120 degrees", 120.0, 0.1339745962156),
    case("duct with sides 3, 4, 5", TriangularDuct { from: 3.0, to: 4.0, third: 5.0 }, 1.0 / 3.0),
    case("all a face of a cube sees", BoxRow { width: 1.0, height: 1.0, depth: 1.0 }, 1.0),
    case("all a face of a box sees", BoxRow { width: 1.0, height: 2.0, depth: 3.0 }, 1.0),
    case("ends of a box", ParallelRectangles { width: 1.0, height: 2.0, distance: 3.0 }, 0.06033138536995),
    case("faces of a tetrahedron", Tetrahedron, 1.0 / 3.0),
];
