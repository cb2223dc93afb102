//! Adaptive against uniform subdivision at equal error on three scenes: elements, form factors and time, as a table.
//!
//! The error is that of the interpolated radiosity at scattered points, as a root mean square over all surfaces and a
//! share of that of the reflected radiosity. The truth gathers at each point, with exact visibility, what a fine
//! uniform grid sends there.

use std::iter::repeat_n;
use std::time::Instant;

use glam::{DVec2, DVec3};
use radiosity::form_factor::{visible_point_to_polygon, visible_polygon_to_polygon};
use radiosity::patch::{Element, Enclosure, Patch, Refinement, Shape, uniform};
use radiosity::solve::Stop;

const STOP: Stop<f64> = Stop { tolerance: 1e-7, most_steps: 1000 };
/// Absolute error of form factors.
const ACCURACY: f64 = 1e-4;
/// Tolerances of the adaptive runs, from coarse to fine, each a factor below the one before.
const STEP: f64 = 0.84;
/// Each measurement is the best of so many.
const REPETITIONS: usize = 2;

type Quad = [DVec3; 4];
type Shapes<'a> = [Shape<'a, DVec3, f64>];

/// Rectangles, seen from their front.
struct Scene {
    name: &'static str,
    faces: Vec<Face>,
    /// The largest side of the elements that adaptive runs start with.
    start: f64,
    /// The largest sides of the elements of the uniform grids.
    sides: [f64; 3],
    /// The largest side of the elements of the grid that lights the truth.
    fine: f64,
}

struct Face {
    corners: Quad,
    reflectance: f64,
    exitance: f64,
    blocks: bool,
}

/// A point where the radiosity is known.
struct Probe {
    shape: usize,
    point: DVec3,
    area: f64,
    radiosity: f64,
}

/// What a way of cutting costs and gives.
#[derive(Clone, Copy)]
struct Run {
    elements: usize,
    pairs: usize,
    error: f64,
    seconds: f64,
}

fn main() {
    println!(
        "| scene | error | elements, uniform | adaptive | ratio | form factors, uniform | adaptive | time, uniform | adaptive |"
    );
    println!("|{}", repeat_n("---|", 9).collect::<String>());
    for scene in [cube(), plates(), room()] {
        let patches: Vec<[Patch<DVec3>; 1]> = scene.faces.iter().map(|face| [Patch::Quad(face.corners)]).collect();
        let shapes: Vec<Shape<DVec3, f64>> =
            scene.faces.iter().zip(&patches).map(|(face, patch)| face.shape(patch)).collect();
        compare(&scene, &shapes);
    }
}

/// Prints a row for each uniform grid, with the cheapest adaptive run that is not worse.
fn compare(scene: &Scene, shapes: &Shapes) {
    let probes = probes(scene, shapes);
    let start = || grid(scene, shapes, scene.start);
    let mut tolerance = 0.1;
    for side in scene.sides {
        let even = measure(shapes, &probes, || solve(scene, shapes, grid(scene, shapes, side)));
        let fit = loop {
            let run = measure(shapes, &probes, || refine(scene, shapes, start(), tolerance));
            if run.error <= even.error {
                break run;
            }
            tolerance *= STEP;
        };
        println!(
            "| {} | {:.2} % | {} | {} | {:.1} | {} | {} | {:.2} s | {:.2} s |",
            scene.name,
            100.0 * even.error,
            even.elements,
            fit.elements,
            even.elements as f64 / fit.elements as f64,
            even.pairs,
            fit.pairs,
            even.seconds,
            fit.seconds,
        );
    }
}

fn solve(scene: &Scene, shapes: &Shapes, elements: Vec<Element<DVec3>>) -> Enclosure<DVec3, f64> {
    Enclosure::new(shapes, elements, &STOP, &mut |a, b| form_factor(scene, a, b))
}

fn refine(scene: &Scene, shapes: &Shapes, start: Vec<Element<DVec3>>, tolerance: f64) -> Enclosure<DVec3, f64> {
    let mut enclosure = solve(scene, shapes, start);
    let settings = Refinement { tolerance, smallest_area: 0.0, most_elements: 4000, stop: STOP };
    enclosure.refine(shapes, &settings, &mut |a, b| form_factor(scene, a, b));
    enclosure
}

/// Exact for neighbors; else the mean of what the four quarters of the smaller element see from their centers.
fn form_factor(scene: &Scene, a: &Element<DVec3>, b: &Element<DVec3>) -> f64 {
    let blockers: Vec<&[DVec3]> = scene.blockers().collect();
    if (a.center - b.center).length_squared() < 9.0 * b.area {
        return visible_polygon_to_polygon(a.corners(), b.corners(), &blockers, ACCURACY).value;
    }
    let middle =
        |&corner: &DVec3| visible_point_to_polygon((a.center + corner) * 0.5, a.normal, b.corners(), &blockers);
    a.corners().iter().map(middle).sum::<f64>() / a.corners().len() as f64
}

fn measure(shapes: &Shapes, probes: &[Probe], run: impl Fn() -> Enclosure<DVec3, f64>) -> Run {
    let mut seconds = f64::INFINITY;
    let mut enclosure = None;
    for _ in 0..REPETITIONS {
        let start = Instant::now();
        enclosure = Some(run());
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    let enclosure = enclosure.expect("it ran");
    let error = error(shapes, probes, &enclosure);
    Run { elements: enclosure.elements.len(), pairs: enclosure.pairs, error, seconds }
}

/// How far the interpolated radiosity is from that of the probes.
fn error(shapes: &Shapes, probes: &[Probe], enclosure: &Enclosure<DVec3, f64>) -> f64 {
    let field = enclosure.field(shapes);
    let (mut error, mut reflected) = (0.0, 0.0);
    for probe in probes {
        let at = |element: &Element<DVec3>| element.shape == probe.shape && holds(element, probe.point);
        let i = enclosure.elements.iter().position(at).expect("the elements cover their shape");
        let radiosity = field.value(i, &enclosure.elements[i], probe.point);
        error += (radiosity - probe.radiosity).powi(2) * probe.area;
        reflected += (probe.radiosity - shapes[probe.shape].exitance).powi(2) * probe.area;
    }
    (error / reflected).sqrt()
}

fn holds(element: &Element<DVec3>, point: DVec3) -> bool {
    let corners = element.corners();
    let next = |k: usize| corners[(k + 1) % corners.len()];
    (0..corners.len()).all(|k| (next(k) - corners[k]).cross(point - corners[k]).dot(element.normal) >= -1e-12)
}

/// Points scattered evenly over all surfaces that reflect, with what they gather from a fine grid.
fn probes(scene: &Scene, shapes: &Shapes) -> Vec<Probe> {
    let fine = solve(scene, shapes, grid(scene, shapes, scene.fine));
    let blockers: Vec<&[DVec3]> = scene.blockers().collect();
    let mut probes = Vec::new();
    for (shape, face) in scene.faces.iter().enumerate().filter(|(_, face)| face.reflectance > 0.0) {
        let divisions = face.divisions(0.3 * scene.start);
        let cells: Vec<_> = uniform(shape, shapes[shape].patches, divisions).collect();
        for (k, cell) in cells.iter().enumerate() {
            // The R2 sequence of Roberts, so that points stand at all distances from the sides of elements.
            let place = (DVec2::new(0.754_877_666, 0.569_840_291) * (k as f64 + 0.5)).fract();
            let [a, b, _, d] = *cell.corners() else { continue };
            let point = a + (b - a) * place.x + (d - a) * place.y;
            let sent = fine.elements.iter().zip(&fine.radiosity).map(|(element, radiosity)| {
                radiosity * visible_point_to_polygon(point, cell.normal, element.corners(), &blockers)
            });
            let radiosity = face.exitance + face.reflectance * sent.sum::<f64>();
            probes.push(Probe { shape, point, area: cell.area, radiosity });
        }
    }
    probes
}

/// All shapes cut into rectangles with sides up to `side`.
fn grid(scene: &Scene, shapes: &Shapes, side: f64) -> Vec<Element<DVec3>> {
    let cut = |(k, face): (usize, &Face)| uniform(k, shapes[k].patches, face.divisions(side));
    scene.faces.iter().enumerate().flat_map(cut).collect()
}

impl Face {
    fn shape<'a>(&self, patches: &'a [Patch<'a, DVec3>]) -> Shape<'a, DVec3, f64> {
        Shape { patches, reflectance: self.reflectance, exitance: self.exitance }
    }

    fn divisions(&self, side: f64) -> [usize; 2] {
        let [a, b, _, d] = self.corners;
        [b - a, d - a].map(|edge| (edge.length() / side - 1e-9).ceil() as usize)
    }
}

impl Scene {
    fn blockers(&self) -> impl Iterator<Item = &[DVec3]> {
        self.faces.iter().filter(|face| face.blocks).map(|face| &face.corners[..])
    }
}

/// The unit cube: one side emits, all reflect half.
fn cube() -> Scene {
    let face = |(k, corners): (usize, Quad)| Face {
        corners,
        reflectance: 0.5,
        exitance: if k == 0 { 1.0 } else { 0.0 },
        blocks: false,
    };
    let faces = walls(DVec3::ZERO, DVec3::ONE).into_iter().enumerate().map(face).collect();
    Scene { name: "unit cube", faces, start: 0.3, sides: [0.125, 0.08, 0.05], fine: 0.04 }
}

/// A plate stands on a floor and casts a shadow that begins at their common edge.
fn plates() -> Scene {
    let plate = rectangle([0.4, 1.0, 0.0], [1.2, 0.0, 0.0], [0.0, 0.0, 0.6]);
    let floor = rectangle([0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    let lamp = rectangle([0.9, 0.1, 1.5], [0.0, 0.2, 0.0], [0.2, 0.0, 0.0]);
    let gray = |corners, blocks| Face { corners, reflectance: 0.6, exitance: 0.0, blocks };
    let faces = vec![gray(floor, false), gray(plate, true), gray(turned(plate), false), lit(lamp)];
    Scene { name: "plates", faces, start: 0.25, sides: [0.125, 0.08, 0.05], fine: 0.05 }
}

/// The corner of a room with a block under a small lamp.
fn room() -> Scene {
    let gray = |corners, blocks| Face { corners, reflectance: 0.6, exitance: 0.0, blocks };
    let [floor, _, left, _, back, _] = walls(DVec3::ZERO, DVec3::new(3.0, 3.0, 2.0));
    let block = walls(DVec3::new(1.1, 0.8, 0.0), DVec3::new(1.9, 1.6, 0.9)).map(turned);
    let lamp = rectangle([1.6, 1.9, 2.0], [0.0, 0.3, 0.0], [0.3, 0.0, 0.0]);
    let mut faces: Vec<Face> = [floor, left, back].map(|corners| gray(corners, false)).into();
    faces.extend(block[1..].iter().map(|&corners| gray(corners, true)));
    faces.push(lit(lamp));
    Scene { name: "room", faces, start: 0.4, sides: [0.25, 0.16, 0.12], fine: 0.12 }
}

fn lit(corners: Quad) -> Face {
    Face { corners, reflectance: 0.0, exitance: 30.0, blocks: true }
}

fn rectangle(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Quad {
    let [a, u, v] = [corner, u, v].map(DVec3::from_array);
    [a, a + u, a + u + v, a + v]
}

/// The other side.
fn turned([a, b, c, d]: Quad) -> Quad {
    [a, d, c, b]
}

/// The sides of a box, seen from inside: below and above, then those at the least and the greatest x and y.
fn walls(low: DVec3, high: DVec3) -> [Quad; 6] {
    let [x, y, z] = (high - low).to_array();
    let side = |corner: [f64; 3], u, v| rectangle((low + DVec3::from_array(corner)).to_array(), u, v);
    let [u, v, w] = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    [side([0.0; 3], u, v), side(w, v, u), side([0.0; 3], v, w), side(u, w, v), side([0.0; 3], w, u), side(v, u, w)]
}
