//! A room of 2.6 m x 2 m x 2 m with a lamp, two blocks and a cushion, open to the front.

use glam::DVec3;
use radiosity::patch::{self, Element, Patch, uniform};
use radiosity::spline::{BezierSurface, SplineError};

pub type Shape<'a> = patch::Shape<'a, DVec3, DVec3>;

const WHITE: DVec3 = DVec3::new(0.75, 0.72, 0.68);
const RED: DVec3 = DVec3::new(0.63, 0.065, 0.05);
const GREEN: DVec3 = DVec3::new(0.14, 0.45, 0.091);
const BLUE: DVec3 = DVec3::new(0.25, 0.4, 0.7);
const LIGHT: DVec3 = DVec3::new(17.0, 13.0, 9.0);
/// The largest side of a patch in meters.
const SIDE: f64 = 0.26;
/// Pieces along each side of the cushion, where it is seen and where it blocks light.
const CUSHION: [usize; 2] = [8, 4];

/// Control points of a bicubic cushion: its outline lies on the floor, the four points inside lie above.
#[rustfmt::skip]
static CUSHION_POINTS: [DVec3; 16] = [
    DVec3::new(-0.75, 0.0, 0.85), DVec3::new(-0.55, 0.0, 0.95), DVec3::new(-0.25, 0.0, 0.95), DVec3::new(-0.05, 0.0, 0.85),
    DVec3::new(-0.85, 0.0, 0.65), DVec3::new(-0.75, 0.6, 0.80), DVec3::new(-0.05, 0.6, 0.80), DVec3::new(0.05, 0.0, 0.65),
    DVec3::new(-0.85, 0.0, 0.35), DVec3::new(-0.75, 0.6, 0.20), DVec3::new(-0.05, 0.6, 0.20), DVec3::new(0.05, 0.0, 0.35),
    DVec3::new(-0.75, 0.0, 0.15), DVec3::new(-0.55, 0.0, 0.05), DVec3::new(-0.25, 0.0, 0.05), DVec3::new(-0.05, 0.0, 0.15),
];

pub struct Room {
    surfaces: Vec<Surface>,
}

/// A shape of one patch, so that light is not smoothed across the edges of a block.
struct Surface {
    patches: [Patch<'static, DVec3>; 1],
    reflectance: DVec3,
    exitance: DVec3,
    divisions: [usize; 2],
    /// Columns and rows of the pieces that block light; none for the walls, which have nothing behind them.
    blocking: [usize; 2],
}

impl Surface {
    fn shape(&self) -> Shape<'_> {
        Shape { patches: &self.patches, reflectance: self.reflectance, exitance: self.exitance }
    }
}

impl Room {
    pub fn new() -> Result<Self, SplineError> {
        let mut room = Self { surfaces: Vec::new() };
        let [low, x, y, z] = [DVec3::new(-1.3, 0.0, -1.0), DVec3::X * 2.6, DVec3::Y * 2.0, DVec3::Z * 2.0];
        room.add([low, z, x], WHITE, DVec3::ZERO, 0);
        room.add([low + y, x, z], WHITE, DVec3::ZERO, 0);
        room.add([low, y, z], RED, DVec3::ZERO, 0);
        room.add([low + x, z, y], GREEN, DVec3::ZERO, 0);
        room.add([low, x, y], WHITE, DVec3::ZERO, 0);
        room.add_block(DVec3::new(-0.45, 0.0, -0.45), [0.55, 1.15], 0.35);
        room.add_block(DVec3::new(0.55, 0.0, 0.0), [0.55, 0.55], -0.3);
        room.add([DVec3::new(-0.25, 1.96, -0.35), DVec3::X * 0.5, DVec3::Z * 0.5], DVec3::ZERO, LIGHT, 1);
        let cushion = Patch::Spline(BezierSurface::new(&CUSHION_POINTS, 4)?);
        let [divisions, blocking] = CUSHION.map(|count| [count; 2]);
        room.surfaces.push(Surface {
            patches: [cushion],
            reflectance: BLUE,
            exitance: DVec3::ZERO,
            divisions,
            blocking,
        });
        Ok(room)
    }

    pub fn shapes(&self) -> Vec<Shape<'_>> {
        self.surfaces.iter().map(Surface::shape).collect()
    }

    /// All surfaces in pieces of about the same size.
    pub fn cut(&self) -> Vec<Element<DVec3>> {
        let pieces =
            |(k, surface): (usize, &'_ Surface)| uniform(k, &surface.patches, surface.divisions).collect::<Vec<_>>();
        self.surfaces.iter().enumerate().flat_map(pieces).collect()
    }

    /// Flat pieces of all that blocks light.
    pub fn blockers(&self) -> Vec<Element<DVec3>> {
        let blocking = self.surfaces.iter().filter(|surface| surface.blocking[0] > 0);
        blocking.flat_map(|surface| uniform(0, &surface.patches, surface.blocking)).collect()
    }

    /// A rectangle from its first corner along two edges, the first to the second a turn to the left.
    fn add(&mut self, [corner, u, v]: [DVec3; 3], reflectance: DVec3, exitance: DVec3, blocking: usize) {
        let patches = [Patch::Quad([corner, corner + u, corner + u + v, corner + v])];
        let divisions = [u, v].map(|edge| (edge.length() / SIDE).ceil() as usize);
        self.surfaces.push(Surface { patches, reflectance, exitance, divisions, blocking: [blocking; 2] });
    }

    /// A white block on the floor, turned by an angle; without its lower side.
    fn add_block(&mut self, foot: DVec3, [width, height]: [f64; 2], angle: f64) {
        let (sin, cos) = angle.sin_cos();
        let (x, z, up) = (DVec3::new(cos, 0.0, -sin) * width, DVec3::new(sin, 0.0, cos) * width, DVec3::Y * height);
        let corner = foot - (x + z) * 0.5;
        let sides =
            [[corner + up, z, x], [corner + z, x, up], [corner + x + z, -z, up], [corner + x, -x, up], [corner, z, up]];
        sides.into_iter().for_each(|side| self.add(side, WHITE, DVec3::ZERO, 1));
    }
}
