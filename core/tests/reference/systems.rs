//! Rooms of a few patches whose radiosities are known: by exact fractions, or to 13 digits by elimination.

use glam::DVec3;

/// Of which patch, and in which band.
#[derive(Clone, Copy, Debug)]
pub enum Quantity {
    /// `b_i`
    Radiosity(usize, usize),
    /// `sum_j F_ij b_j`
    Received(usize, usize),
}

/// What is known.
pub struct Known {
    pub name: &'static str,
    pub quantity: Quantity,
    pub value: f64,
}

/// A closed room of patches of constant radiosity, in three bands.
pub struct Room {
    pub areas: Vec<f64>,
    /// Row after row.
    pub factors: Vec<f64>,
    pub reflectance: Vec<DVec3>,
    pub exitance: Vec<DVec3>,
    pub known: Vec<Known>,
}

/// All of them.
pub fn rooms() -> Vec<Room> {
    let mut rooms: Vec<Room> = [0.2, 0.5, 0.99].into_iter().map(white_furnace).collect();
    rooms.extend([cube_half(), cube_bright(), cornell(), tetrahedron(), plates(), spheres()]);
    rooms.extend([integrating_sphere(), uniform_sphere(), square_duct(), cylinder()]);
    rooms
}

/// The form factor between opposite faces of a cube; see Howell's catalogue, C-11.
fn opposite_faces() -> f64 {
    let root = 2.0_f64.sqrt();
    2.0 / core::f64::consts::PI * (0.5 * (4.0_f64 / 3.0).ln() + 2.0 * root * (0.5 * root).atan() - 2.0 * 1.0_f64.atan())
}

/// Faces 0 and 1, 2 and 3, 4 and 5 are opposite.
pub fn cube() -> Vec<f64> {
    let opposite = opposite_faces();
    let factor = |i: usize, j: usize| match i ^ j {
        0 => 0.0,
        1 => opposite,
        _ => (1.0 - opposite) / 4.0,
    };
    (0..36).map(|k| factor(k / 6, k % 6)).collect()
}

fn radiosities(names: &[(&'static str, usize, f64)]) -> Vec<Known> {
    let known = |&(name, i, value)| Known { name, quantity: Quantity::Radiosity(i, 0), value };
    names.iter().map(known).collect()
}

fn gray(areas: &[f64], factors: Vec<f64>, reflectance: &[f64], exitance: &[f64], known: Vec<Known>) -> Room {
    let splat = |numbers: &[f64]| numbers.iter().copied().map(DVec3::splat).collect();
    Room { areas: areas.to_vec(), factors, reflectance: splat(reflectance), exitance: splat(exitance), known }
}

/// `b = e / (1 - rho)`.
fn white_furnace(rho: f64) -> Room {
    let known = (0..6).map(|i| Known {
        name: "white furnace",
        quantity: Quantity::Radiosity(i, i % 3),
        value: match rho {
            0.2 => 1.25,
            0.5 => 2.0,
            _ => 100.0,
        },
    });
    gray(&[1.0; 6], cube(), &[rho; 6], &[1.0; 6], known.collect())
}

fn cube_half() -> Room {
    let known = radiosities(&[
        ("cube, rho 0.5: opposite", 1, 0.181_745_826_107_8),
        ("cube, rho 0.5: adjacent", 3, 0.181_836_268_946_1),
    ]);
    gray(&[1.0; 6], cube(), &[0.5; 6], &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], known)
}

fn cube_bright() -> Room {
    let known = radiosities(&[("cube, rho 0.8: emitter", 0, 1.551_724_153_645)]);
    gray(&[1.0; 6], cube(), &[0.8; 6], &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], known)
}

/// Ceiling, which emits 1, floor, red wall, green wall, back, front.
fn cornell() -> Room {
    let (white, red, green) = (DVec3::splat(0.74), DVec3::new(0.63, 0.06, 0.06), DVec3::new(0.14, 0.45, 0.09));
    let known = [
        ("Cornell cube, R: floor", 1, 0, 0.325_215_551_045_3),
        ("Cornell cube, R: red wall", 2, 0, 0.282_421_435_346_1),
        ("Cornell cube, R: green wall", 3, 0, 0.068_738_210_891_29),
        ("Cornell cube, R: back", 4, 0, 0.325_338_444_929_5),
        ("Cornell cube, G: red wall", 2, 1, 0.026_493_589_839_93),
        ("Cornell cube, G: green wall", 3, 1, 0.184_494_309_043_7),
        ("Cornell cube, G: back", 4, 1, 0.288_022_722_375),
        ("Cornell cube, B: floor", 1, 2, 0.246_795_567_84),
        ("Cornell cube, B: red wall", 2, 2, 0.022_714_253_123_46),
        ("Cornell cube, B: green wall", 3, 2, 0.033_870_738_765_05),
        ("Cornell cube, B: back", 4, 2, 0.246_918_461_724_2),
    ];
    let known = known.map(|(name, i, band, value)| Known { name, quantity: Quantity::Radiosity(i, band), value });
    let mut exitance = vec![DVec3::ZERO; 6];
    exitance[0] = DVec3::ONE;
    let reflectance = vec![white, white, red, green, white, white];
    Room { areas: vec![1.0; 6], factors: cube(), reflectance, exitance, known: known.into() }
}

/// Each face sees the three others alike.
fn tetrahedron() -> Room {
    let known = radiosities(&[
        ("tetrahedron: 0", 0, 217.0 / 159.0),
        ("tetrahedron: 1", 1, 565.0 / 2067.0),
        ("tetrahedron: 2", 2, 113.0 / 159.0),
        ("tetrahedron: 3", 3, 830.0 / 689.0),
    ]);
    let factors = (0..16).map(|k| if k / 4 == k % 4 { 0.0 } else { 1.0 / 3.0 }).collect();
    gray(&[1.0; 4], factors, &[0.5, 0.25, 0.75, 0.9], &[1.0, 0.0, 0.0, 0.5], known)
}

/// Two infinite planes that face each other.
fn plates() -> Room {
    let known = radiosities(&[
        ("infinite plates: 1", 0, (1.0 + 0.3 * 0.25) / (1.0 - 0.3 * 0.8)),
        ("infinite plates: 2", 1, (0.25 + 0.8) / (1.0 - 0.3 * 0.8)),
    ]);
    gray(&[1.0; 2], vec![0.0, 1.0, 1.0, 0.0], &[0.3, 0.8], &[1.0, 0.25], known)
}

/// Radii 1 and 2; the outer one sees itself.
fn spheres() -> Room {
    let known = radiosities(&[("spheres: inner", 0, 4.0 / 3.0), ("spheres: outer", 1, 2.0 / 3.0)]);
    gray(&[1.0, 4.0], vec![0.0, 1.0, 0.25, 0.75], &[0.5, 0.8], &[1.0, 0.0], known)
}

/// Inside a sphere each point sees all areas alike, `F_ij = A_j / A`. Ulbricht 1900.
fn ulbricht(share: f64, reflectance: [f64; 2], known: Vec<Known>) -> Room {
    let areas = [share, 1.0 - share];
    gray(&areas, [areas, areas].concat(), &reflectance, &[1.0, 0.0], known)
}

/// A luminous cap of 5 %.
fn integrating_sphere() -> Room {
    let mut known = radiosities(&[("integrating sphere: wall", 1, 0.575_757_575_757_6)]);
    known.extend([0, 1].map(|i| Known {
        name: "integrating sphere: irradiance",
        quantity: Quantity::Received(i, 0),
        value: 0.606_060_606_060_6,
    }));
    ulbricht(0.05, [0.3, 0.95], known)
}

/// `b = rho f / (1 - rho)` outside of a luminous patch of the share `f`.
fn uniform_sphere() -> Room {
    ulbricht(1.0 / 80.0, [0.9, 0.9], radiosities(&[("sphere of one reflectance", 1, 0.1125)]))
}

/// An infinitely long one; its form factors are those of crossed strings. The strips follow each other.
fn square_duct() -> Room {
    let known = radiosities(&[
        ("square duct: adjacent", 1, 0.269_752_143_389_8),
        ("square duct: opposite", 2, 0.316_034_294_237_1),
    ]);
    let (adjacent, opposite) = (1.0 - 0.5_f64.sqrt(), 2.0_f64.sqrt() - 1.0);
    let factors = (0..16).map(|k| [0.0, adjacent, opposite, adjacent][(k / 4 + 4 - k % 4) % 4]).collect();
    gray(&[1.0; 4], factors, &[0.5; 4], &[1.0, 0.0, 0.0, 0.0], known)
}

/// Base, top and side of one as high as its radius.
fn cylinder() -> Room {
    let known = radiosities(&[
        ("cylinder: base", 0, 1.092_563_461_886),
        ("cylinder: top", 1, 0.369_501_249_323_1),
        ("cylinder: side", 2, 0.520_489_806_269),
    ]);
    let discs = (3.0 - 5.0_f64.sqrt()) / 2.0;
    let (out, back) = (1.0 - discs, (1.0 - discs) / 2.0);
    let factors = vec![0.0, discs, out, discs, 0.0, out, back, back, discs];
    gray(&[1.0, 1.0, 2.0], factors, &[0.2, 0.5, 0.8], &[1.0, 0.0, 0.0], known)
}
