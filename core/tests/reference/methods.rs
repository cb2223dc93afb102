//! The known cases as polygons and as closed forms, for all who apply a method to them.

use glam::DVec3;
use radiosity::form_factor::*;
use radiosity::math::{Real, Vector};

use super::points::Target;
use super::surfaces::Surfaces;

pub type Corners = Vec<DVec3>;

/// `corner`, `corner + u`, `corner + u + v`, `corner + v`.
pub fn rectangle(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Corners {
    let [corner, u, v] = [corner, u, v].map(DVec3::from_array);
    vec![corner, corner + u, corner + u + v, corner + v]
}

/// The closed form, where there is one: faces of a tetrahedron are known by symmetry only.
pub fn closed_form<R: Real>(surfaces: &Surfaces) -> Option<R> {
    let number = R::from_f64;
    let bounds = |[x, y]: [[f64; 2]; 2]| Bounds { x: x.map(number), y: y.map(number) };
    Some(match *surfaces {
        Surfaces::ParallelRectangles { width, height, distance } => {
            parallel_rectangles(number(width), number(height), number(distance))
        }
        Surfaces::ParallelOffset { a, b, distance } => {
            parallel_rectangles_offset(bounds(a), bounds(b), number(distance))
        }
        Surfaces::PerpendicularRectangles { length, width, height } => {
            perpendicular_rectangles(number(length), number(width), number(height))
        }
        Surfaces::PerpendicularOffset { a, b } => perpendicular_rectangles_offset(bounds(a), bounds(b)),
        Surfaces::TiltedSquares { degrees } => tilted_rectangles(R::ONE, R::ONE, R::ONE, number(degrees.to_radians())),
        Surfaces::CoaxialDiscs { from, to, distance } => coaxial_discs(number(from), number(to), number(distance)),
        Surfaces::SphereToDisc { radius, distance } => sphere_to_disc(number(radius), number(distance)),
        Surfaces::SphereToRectangle { width, height, distance } => {
            sphere_to_rectangle(number(width), number(height), number(distance))
        }
        Surfaces::SphereToCubeFace => number(4.0) * sphere_to_rectangle(number(0.5), number(0.5), number(0.5)),
        Surfaces::CubeFaceToSphere { radius } => {
            let back = number(4.0) * sphere_to_rectangle(number(0.5), number(0.5), number(0.5));
            back * number(4.0 * std::f64::consts::PI * radius * radius)
        }
        Surfaces::OuterSphereToInner { inner, outer } => outer_sphere_to_inner(number(inner), number(outer)),
        Surfaces::TwoSpheres { from, to, distance } => sphere_to_sphere(number(from), number(to), number(distance)),
        Surfaces::CoaxialCylinders { inner, outer, height } => {
            inner_cylinder_to_outer(number(inner), number(outer), number(height))
        }
        Surfaces::CylinderSideToItself { radius, height } => cylinder_side_to_itself(number(radius), number(height)),
        Surfaces::CylinderBaseToSide { radius, height } => cylinder_base_to_side(number(radius), number(height)),
        Surfaces::Hemisphere => inside_sphere(number(2.0) * R::PI, R::ONE),
        Surfaces::ParallelStrips { width, distance } => parallel_strips(number(width), number(distance)),
        Surfaces::StripsAtAnAngle { degrees } => strips_at_an_angle(R::ONE, R::ONE, number(degrees.to_radians())),
        Surfaces::TriangularDuct { from, to, third } => {
            strips_at_an_angle(number(from), number(to), number(duct_angle(from, to, third)))
        }
        Surfaces::BoxRow { width, height, depth } => {
            let two = number(2.0);
            let (width, height, depth) = (number(width), number(height), number(depth));
            parallel_rectangles(width, height, depth)
                + two * perpendicular_rectangles(width, height, depth)
                + two * perpendicular_rectangles(height, width, depth)
        }
        Surfaces::Tetrahedron => return None,
    })
}

/// The sender and all receivers, where they are polygons.
pub fn surface_polygons(surfaces: &Surfaces) -> Option<(Corners, Vec<Corners>)> {
    let floor = |[x, y]: [[f64; 2]; 2]| rectangle([x[0], y[0], 0.0], [x[1] - x[0], 0.0, 0.0], [0.0, y[1] - y[0], 0.0]);
    let roof =
        |[x, y]: [[f64; 2]; 2], z: f64| rectangle([x[0], y[0], z], [0.0, y[1] - y[0], 0.0], [x[1] - x[0], 0.0, 0.0]);
    let wall = |[z, y]: [[f64; 2]; 2]| rectangle([0.0, y[0], z[0]], [0.0, y[1] - y[0], 0.0], [0.0, 0.0, z[1] - z[0]]);
    Some(match *surfaces {
        Surfaces::ParallelRectangles { width, height, distance } => {
            let bounds = [[0.0, width], [0.0, height]];
            (floor(bounds), vec![roof(bounds, distance)])
        }
        Surfaces::ParallelOffset { a, b, distance } => (floor(a), vec![roof(b, distance)]),
        Surfaces::PerpendicularRectangles { length, width, height } => {
            (floor([[0.0, width], [0.0, length]]), vec![wall([[0.0, height], [0.0, length]])])
        }
        Surfaces::PerpendicularOffset { a, b } => (floor(a), vec![wall(b)]),
        Surfaces::TiltedSquares { degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let square = [[0.0, 1.0], [0.0, 1.0]];
            (floor(square), vec![rectangle([0.0; 3], [0.0, 1.0, 0.0], [cos, 0.0, sin])])
        }
        Surfaces::BoxRow { width: w, height: h, depth: d } => {
            let walls = vec![
                roof([[0.0, w], [0.0, h]], d),
                rectangle([0.0; 3], [0.0, h, 0.0], [0.0, 0.0, d]),
                rectangle([w, 0.0, 0.0], [0.0, 0.0, d], [0.0, h, 0.0]),
                rectangle([0.0; 3], [0.0, 0.0, d], [w, 0.0, 0.0]),
                rectangle([0.0, h, 0.0], [w, 0.0, 0.0], [0.0, 0.0, d]),
            ];
            (floor([[0.0, w], [0.0, h]]), walls)
        }
        Surfaces::Tetrahedron => {
            let [a, b, c, d] =
                [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(DVec3::from_array);
            (vec![a, c, b], vec![vec![a, b, d]])
        }
        _ => return None,
    })
}

/// The same for strips, whose receivers end at `far` on both sides.
///
/// A piece of a strip without end sends as much to another one as all of it. What lies beyond the ends counts with the
/// cube of distance over `far`.
pub fn strip_polygons(surfaces: &Surfaces, far: f64) -> Option<(Corners, Vec<Corners>)> {
    let piece = |width: f64| rectangle([0.0, -0.5, 0.0], [width, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let ends = [0.0, 2.0 * far, 0.0];
    // It shares an edge with the piece and leans over it.
    let wall =
        |width: f64, angle: f64| rectangle([0.0, -far, 0.0], ends, [width * angle.cos(), 0.0, width * angle.sin()]);
    Some(match *surfaces {
        Surfaces::ParallelStrips { width, distance } => {
            (piece(width), vec![rectangle([0.0, -far, distance], ends, [width, 0.0, 0.0])])
        }
        Surfaces::StripsAtAnAngle { degrees } => (piece(1.0), vec![wall(1.0, degrees.to_radians())]),
        Surfaces::TriangularDuct { from, to, third } => (piece(from), vec![wall(to, duct_angle(from, to, third))]),
        _ => return None,
    })
}

/// Between the first two of three sides.
pub fn duct_angle(from: f64, to: f64, third: f64) -> f64 {
    ((from * from + to * to - third * third) / (2.0 * from * to)).acos()
}

/// What an element at the origin looks at, where it is a polygon; strips end at `far` on both sides.
pub fn target_polygon(target: &Target, far: f64) -> Option<Corners> {
    let ahead =
        |[x, y]: [[f64; 2]; 2], z: f64| rectangle([x[0], y[0], z], [0.0, y[1] - y[0], 0.0], [x[1] - x[0], 0.0, 0.0]);
    Some(match *target {
        Target::Polygon(corners) => corners.iter().map(|&corner| DVec3::from_array(corner)).collect(),
        Target::ParallelRectangle { width, height, distance } => ahead([[0.0, width], [0.0, height]], distance),
        Target::PerpendicularRectangle { width, height, distance } => {
            rectangle([distance, 0.0, 0.0], [0.0, 0.0, height], [0.0, width, 0.0])
        }
        Target::Strip { from, to } => ahead([[from, to], [-far, far]], 2.0),
        _ => return None,
    })
}

/// The closed form for what an element at the origin looks at, but for polygons in general.
pub fn point_closed_form<V: Vector>(normal: [f64; 3], target: &Target) -> Option<V::Scalar> {
    let number = V::Scalar::from_f64;
    let at = |point: [f64; 3]| V::from_array(point.map(number));
    let (origin, normal) = (V::default(), at(normal));
    let disc = |center, radius| {
        let disc = Disc { center: at(center), normal: at([0.0, 0.0, -1.0]), radius: number(radius) };
        point_to_disc(origin, normal, &disc)
    };
    Some(match *target {
        Target::ParallelRectangle { width, height, distance } => {
            point_to_parallel_rectangle(number(width), number(height), number(distance))
        }
        Target::PerpendicularRectangle { width, height, distance } => {
            point_to_perpendicular_rectangle(number(width), number(height), number(distance))
        }
        Target::Disc { center, radius } => disc(center, radius),
        Target::Sphere { distance, degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            point_to_sphere(origin, normal, at([distance * sin, 0.0, distance * cos]), V::Scalar::ONE)
        }
        Target::Sky { degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            point_to_sky(at([sin, 0.0, cos]), normal)
        }
        Target::Strip { from, to } => {
            let ends = [[to, 2.0], [from, 2.0]].map(|end| end.map(number));
            point_to_strip([V::Scalar::ZERO; 2], [V::Scalar::ZERO, V::Scalar::ONE], ends)
        }
        Target::DiscLessShadow => disc([0.0, 0.0, 2.0], 1.0) - disc([0.0, 0.0, 2.0], 0.6),
        Target::Polygon(_) | Target::SquareLessShadow => return None,
    })
}
