//! The Cornell box as it was measured, in quads: positions and reflectances of the "Cornell Box Data" that Cornell
//! University publishes, read at 620, 548 and 452 nm.

use glam::Vec3;
use heapless::Vec;
use radiosity::form_factor::{Facet, Screen};
use radiosity::spectrum::{CORNELL_GREEN, CORNELL_RED, CORNELL_WHITE};

/// Surfaces, of which the last ten are the faces of the blocks.
pub const SURFACES: usize = 19;
/// Faces of the blocks: walls hide nothing.
pub const SCREENS: usize = 10;

/// Radiance of the lamp in cd/m2, in all bands.
const LAMP_RADIANCE: f32 = 11_500.0;
const CEILING: f32 = 548.8;
const LAMP: [[f32; 3]; 4] =
    [[343.0, CEILING, 227.0], [343.0, CEILING, 332.0], [213.0, CEILING, 332.0], [213.0, CEILING, 227.0]];
const OUTLINE: [[f32; 3]; 4] =
    [[556.0, CEILING, 0.0], [556.0, CEILING, 559.2], [0.0, CEILING, 559.2], [0.0, CEILING, 0.0]];

const WHITE: Vec3 = at_bands(&CORNELL_WHITE.0);
const RED: Vec3 = at_bands(&CORNELL_RED.0);
const GREEN: Vec3 = at_bands(&CORNELL_GREEN.0);

/// The bands of 4 nm from 400 nm that hold 620, 548 and 452 nm.
const fn at_bands(spectrum: &[f32; 76]) -> Vec3 {
    Vec3::new(spectrum[55], spectrum[37], spectrum[13])
}

/// A quad of one material.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// In meters, counter-clockwise seen from inside the room.
    pub corners: [Vec3; 4],
    /// Of each band.
    pub reflectance: Vec3,
    /// Emitted radiance in cd/m2.
    pub exitance: Vec3,
    /// Facets along the first and the second side.
    pub divisions: [u16; 2],
}

/// Cuts per surface: those of a wall, of a piece of the ceiling, of the lamp, of a side of the blocks, of their tops.
#[derive(Clone, Copy, Debug)]
pub struct Fineness {
    /// The four large walls.
    pub wall: [u16; 2],
    /// The four trapezoids around the lamp.
    pub ceiling: [u16; 2],
    /// The lamp.
    pub lamp: [u16; 2],
    /// Each side of the short block and of the tall one.
    pub sides: [[u16; 2]; 2],
    /// The tops of both.
    pub top: [u16; 2],
}

/// All surfaces.
pub fn surfaces(fineness: &Fineness) -> Vec<Surface, SURFACES> {
    let mut surfaces = Vec::new();
    let mut add = |corners: [[f32; 3]; 4], reflectance, divisions| {
        let corners = corners.map(|corner| Vec3::from_array(corner) / 1000.0);
        // The capacity is that of all surfaces.
        let _ = surfaces.push(Surface { corners, reflectance, exitance: Vec3::ZERO, divisions });
    };
    add([[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]], WHITE, fineness.wall);
    add([[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, CEILING, 559.2], [556.0, CEILING, 559.2]], WHITE, fineness.wall);
    add([[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, CEILING, 0.0], [0.0, CEILING, 559.2]], GREEN, fineness.wall);
    add([[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, CEILING, 559.2], [556.0, CEILING, 0.0]], RED, fineness.wall);
    let [a, b, c, d] = OUTLINE;
    let [e, f, g, h] = LAMP;
    for corners in [[a, b, f, e], [b, c, g, f], [c, d, h, g], [d, a, e, h]] {
        add(corners, WHITE, fineness.ceiling);
    }
    add(LAMP, Vec3::splat(0.78), fineness.lamp);
    let blocks = [
        (165.0, [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]]),
        (330.0, [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]]),
    ];
    for ((height, feet), sides) in blocks.into_iter().zip(fineness.sides) {
        let [a, b, c, d] = feet.map(|[x, z]: [f32; 2]| [[x, 0.0, z], [x, height, z]]);
        add([a[1], b[1], c[1], d[1]], WHITE, fineness.top);
        for [from, to] in [[a, b], [b, c], [c, d], [d, a]] {
            add([from[0], to[0], to[1], from[1]], WHITE, sides);
        }
    }
    if let Some(lamp) = surfaces.get_mut(8) {
        lamp.exitance = Vec3::splat(LAMP_RADIANCE);
    }
    surfaces
}

/// What stands in the way of light: the faces of the blocks.
pub fn screens(surfaces: &[Surface]) -> Vec<Screen, SCREENS> {
    let mut screens = Vec::new();
    for surface in surfaces.iter().skip(SURFACES - SCREENS) {
        // The capacity is that of all faces.
        let _ = screens.push(Screen::new(surface.corners));
    }
    screens
}

impl Surface {
    /// Its facets, row after row.
    pub fn facets(&self) -> impl Iterator<Item = Facet> {
        let [columns, rows] = self.divisions;
        let [a, b, c, d] = self.corners;
        let point = move |i: u16, j: u16| {
            let (u, v) = (f32::from(i) / f32::from(columns), f32::from(j) / f32::from(rows));
            (a * (1.0 - u) + b * u) * (1.0 - v) + (d * (1.0 - u) + c * u) * v
        };
        (0..rows).flat_map(move |j| {
            (0..columns).map(move |i| Facet::new([point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]))
        })
    }
}
