//! Subdivision before and after solving, against laws and against each other.

use glam::DVec3;
use radiosity::form_factor::{
    Estimate, Hemicube, HemicubeBuffers, Samples, hemicube_deltas, hemicube_pixels, point_to_polygon,
    polygon_to_polygon, visible_point_to_polygon,
};
use radiosity::patch::*;
use radiosity::solve::{Dense, FormFactors, Stop};
use radiosity::spline::BezierSurface;

const STOP: Stop<f64> = Stop { tolerance: 1e-9, most_steps: 1000 };

type Quad = [DVec3; 4];

fn rectangle([corner, u, v]: [DVec3; 3]) -> Quad {
    [corner, corner + u, corner + u + v, corner + v]
}

/// The sides of the unit cube, seen from inside: below, above, and around.
fn cube() -> [[Patch<'static, DVec3>; 1]; 6] {
    let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let sides = [[o, x, y], [z, y, x], [o, y, z], [x, z, y], [o, z, x], [y, x, z]];
    sides.map(|side| [Patch::Quad(rectangle(side))])
}

fn exact(a: &Element<DVec3>, b: &Element<DVec3>) -> f64 {
    polygon_to_polygon(a.corners(), b.corners())
}

/// Where all emit and reflect alike, every element ends at e / (1 - rho), however unevenly the room is cut; and there
/// is nothing to refine.
#[test]
fn white_furnace_on_uneven_elements() {
    let sides = cube();
    let shapes = sides.each_ref().map(|patches| Shape { patches, reflectance: 0.75, exitance: 1.0 });
    let mut elements: Vec<_> = (0..6).flat_map(|k| uniform(k, &sides[k], [1 + k % 2; 2]).collect::<Vec<_>>()).collect();
    let settings = Proximity { largest_exchange: 0.03, smallest_area: 0.01, most_elements: 200 };
    by_proximity(&shapes, &mut elements, &settings);
    assert!(elements.len() > 30);
    let mut enclosure = Enclosure::new(&shapes, elements, &STOP, &mut exact);
    assert!(enclosure.radiosity.iter().all(|b: &f64| (b - 4.0).abs() < 1e-7));
    let settings = Refinement { tolerance: 1e-6, smallest_area: 0.0, most_elements: 1000, stop: STOP };
    let before = enclosure.elements.len();
    let (end, error) = enclosure.refine(&shapes, &settings, &mut exact);
    assert_eq!((end, enclosure.elements.len()), (Refined::Tolerance, before), "{error}");
}

/// In a closed room all that is emitted is absorbed: sum A e = sum A (1 - rho) E, where b = e + rho E, on any elements.
#[test]
fn energy_is_kept() {
    let sides = cube();
    let shape =
        |k: usize| Shape { patches: &sides[k][..], reflectance: 0.2 + 0.1 * k as f64, exitance: (k == 3) as u8 as f64 };
    let shapes: [Shape<DVec3, f64>; 6] = core::array::from_fn(shape);
    let elements = (0..6).flat_map(|k| uniform(k, &sides[k], [3, 3]).collect::<Vec<_>>()).collect();
    let mut enclosure = Enclosure::new(&shapes, elements, &STOP, &mut exact);
    let settings = Refinement { tolerance: 0.01, smallest_area: 0.0, most_elements: 300, stop: STOP };
    enclosure.refine(&shapes, &settings, &mut exact);
    let absorbed = enclosure.elements.iter().zip(&enclosure.radiosity).map(|(element, b)| {
        let Shape { reflectance, exitance, .. } = shapes[element.shape];
        element.area * (1.0 - reflectance) * (b - exitance) / reflectance
    });
    let absorbed: f64 = absorbed.sum();
    assert!((absorbed - 1.0).abs() < 1e-7, "{absorbed} from {} elements", enclosure.elements.len());
}

/// The continuous radiosity of the unit cube, where one side emits 1 and all reflect half, is known by extrapolation of
/// two methods: mean over the opposite side 0.1712160, over the others 0.1811055, and 0.1976045 in the middle of the
/// opposite side. Six elements give 0.1817 for the first.
#[test]
fn the_continuous_cube() {
    let sides = cube();
    let shape = |k: usize| Shape { patches: &sides[k][..], reflectance: 0.5, exitance: if k == 0 { 1.0 } else { 0.0 } };
    let shapes: [Shape<DVec3, f64>; 6] = core::array::from_fn(shape);
    let elements = (0..6).flat_map(|k| uniform(k, &sides[k], [3, 3]).collect::<Vec<_>>()).collect();
    let mut enclosure = Enclosure::new(&shapes, elements, &STOP, &mut exact);
    let settings = Refinement { tolerance: 0.015, smallest_area: 0.0, most_elements: 600, stop: STOP };
    let (end, _) = enclosure.refine(&shapes, &settings, &mut exact);
    assert_eq!(end, Refined::Tolerance);
    let pieces = || enclosure.elements.iter().zip(&enclosure.radiosity);
    for (side, mean) in [(1, 0.171_216_0), (2, 0.181_105_5), (5, 0.181_105_5)] {
        let found: f64 = pieces().filter(|(e, _)| e.shape == side).map(|(e, b)| e.area * b).sum();
        assert!((found / mean - 1.0).abs() < 2e-3, "side {side}: {found}");
    }
    let field = enclosure.field(&shapes);
    let middle = DVec3::new(0.5, 0.5, 1.0);
    let holds = |e: &Element<DVec3>| e.shape == 1 && e.center.distance(middle) < 0.71 * e.area.sqrt();
    let i = enclosure.elements.iter().position(holds).expect("the opposite side has a middle");
    let found = field.value(i, &enclosure.elements[i], middle);
    assert!((found / 0.197_604_5 - 1.0).abs() < 1e-2, "in the middle: {found}");
}

/// Two plates at right angles: elements are smallest at the common edge, and their size grows away from it.
#[test]
fn proximity_cuts_finer_where_surfaces_lie_near_each_other() {
    let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let plates = [[o, x, y], [o, z, x]].map(|plate| [Patch::Quad(rectangle(plate))]);
    let shapes = plates.each_ref().map(|patches| Shape { patches, reflectance: 0.5, exitance: 1.0 });
    let mut elements: Vec<_> = (0..2).map(|k| Element::whole(k, 0, &plates[k][0])).collect();
    let settings = Proximity { largest_exchange: 3e-4, smallest_area: 0.0, most_elements: 5000 };
    by_proximity(&shapes, &mut elements, &settings);
    let distance = |element: &Element<DVec3>| element.center.y + element.center.z;
    let area = |near: f64, far: f64| {
        let between = elements.iter().filter(|element| (near..far).contains(&distance(element)));
        between.map(|element| element.area).fold(0.0, f64::max)
    };
    let (edge, middle, end) = (area(0.0, 0.05), area(0.3, 0.5), area(0.8, 1.0));
    assert!(edge < middle && middle <= end, "{edge} {middle} {end}");
    let same = elements.iter().map(|element| element.area).fold(1.0, f64::min);
    assert!((elements.len() as f64) < 0.25 * 2.0 / same, "{} elements, the smallest of {same}", elements.len());
    for (i, a) in elements.iter().enumerate() {
        assert!(elements[..i].iter().all(|b| expected_exchange(a, b) * 3.0 <= 1.01 * 3e-4 * 2.0));
    }
}

/// A floor under a lamp, with a screen that stands on it and casts a shadow. Neither lamp nor screen reflects, so the
/// radiosity of the floor is known: its reflectance times what the lamp sends there.
struct Shadow {
    patches: [[Patch<'static, DVec3>; 1]; 2],
    lamp: Quad,
    screen: Quad,
}

impl Shadow {
    fn new() -> Self {
        let floor = rectangle([DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0]);
        let lamp = rectangle([DVec3::new(0.9, 0.1, 1.5), DVec3::Y * 0.2, DVec3::X * 0.2]);
        let screen = rectangle([DVec3::new(0.4, 1.0, 0.0), DVec3::X * 1.2, DVec3::Z * 0.6]);
        Self { patches: [[Patch::Quad(floor)], [Patch::Quad(lamp)]], lamp, screen }
    }

    fn shapes(&self) -> [Shape<'_, DVec3, f64>; 2] {
        let [floor, lamp] = &self.patches;
        [
            Shape { patches: floor, reflectance: 0.6, exitance: 0.0 },
            Shape { patches: lamp, reflectance: 0.0, exitance: 30.0 },
        ]
    }

    fn grid(&self, count: usize) -> Vec<Element<DVec3>> {
        uniform(0, &self.patches[0], [count; 2]).chain(uniform(1, &self.patches[1], [1, 1])).collect()
    }

    /// From the floor to the lamp, as the mean of what four points see.
    fn form_factor(&self, a: &Element<DVec3>, b: &Element<DVec3>) -> f64 {
        let (floor, lamp) = if a.shape == 0 { (a, b) } else { (b, a) };
        let points = floor.corners().iter().map(|&corner| (floor.center + corner) * 0.5);
        let seen = points.map(|point| visible_point_to_polygon(point, floor.normal, lamp.corners(), &[&self.screen]));
        seen.sum::<f64>() / 4.0 * floor.area / a.area
    }

    /// The root mean square of how far the interpolated radiosity is from the truth, on the floor.
    fn error(&self, enclosure: &Enclosure<DVec3, f64>) -> f64 {
        let field = enclosure.field(&self.shapes());
        let (mut error, mut total) = (0.0, 0.0);
        for (i, element) in enclosure.elements.iter().enumerate().filter(|(_, element)| element.shape == 0) {
            for k in 0..9 {
                let [a, b, c, d] = *element.corners() else { unreachable!("the floor is cut into squares") };
                let (s, t) = ((k % 3) as f64 / 3.0 + 0.17, (k / 3) as f64 / 3.0 + 0.17);
                let point = a.lerp(b, s).lerp(d.lerp(c, s), t);
                let truth = 0.6 * 30.0 * visible_point_to_polygon(point, DVec3::Z, &self.lamp, &[&self.screen]);
                error += (field.value(i, element, point) - truth).powi(2) * element.area;
                total += truth * truth * element.area;
            }
        }
        (error / total).sqrt()
    }
}

/// With at most a third of the elements of a uniform grid, and with fewer form factors, the error is as small.
#[test]
fn adaptive_needs_fewer_elements_than_uniform() {
    let scene = Shadow::new();
    let mut form_factor = |a: &Element<DVec3>, b: &Element<DVec3>| scene.form_factor(a, b);
    let even = Enclosure::new(&scene.shapes(), scene.grid(40), &STOP, &mut form_factor);
    let error = scene.error(&even);
    let start = Enclosure::new(&scene.shapes(), scene.grid(8), &STOP, &mut form_factor);
    let mut fit = start.clone();
    let mut tolerance = 0.1;
    while scene.error(&fit) > error {
        tolerance *= 0.9;
        let settings = Refinement { tolerance, smallest_area: 0.0, most_elements: 1600, stop: STOP };
        fit.clone_from(&start);
        let (end, _) = fit.refine(&scene.shapes(), &settings, &mut form_factor);
        assert_eq!(end, Refined::Tolerance);
    }
    assert!(3 * fit.elements.len() <= even.elements.len(), "{} of {}", fit.elements.len(), even.elements.len());
    assert!(fit.pairs < even.pairs, "{} of {}", fit.pairs, even.pairs);
}

/// What limits refinement is kept, and named.
#[test]
fn refinement_ends() {
    let scene = Shadow::new();
    let mut form_factor = |a: &Element<DVec3>, b: &Element<DVec3>| scene.form_factor(a, b);
    let start = Enclosure::new(&scene.shapes(), scene.grid(4), &STOP, &mut form_factor);
    for (smallest_area, most_elements, expected) in
        [(0.25, 1000, Refined::SmallestArea), (0.0, 100, Refined::MostElements)]
    {
        let settings = Refinement { tolerance: 1e-6, smallest_area, most_elements, stop: STOP };
        let mut enclosure = start.clone();
        let (end, error) = enclosure.refine(&scene.shapes(), &settings, &mut form_factor);
        assert_eq!(end, expected);
        assert!(error > 1e-6 && enclosure.elements.len() < 130);
        assert!(enclosure.elements.iter().all(|element| element.area >= smallest_area.min(0.01)));
    }
}

/// A gray surface under a small lamp that does not reflect: the truth is Lambert's formula for a point and the lamp.
struct UnderLamp<'a> {
    surface: &'a [Patch<'a, DVec3>],
    lamp: [Patch<'static, DVec3>; 1],
    corners: Quad,
}

impl<'a> UnderLamp<'a> {
    /// A lamp of 0.2 x 0.2, centered at a point and horizontal.
    fn new(surface: &'a [Patch<'a, DVec3>], center: DVec3) -> Self {
        let corners = rectangle([center - DVec3::new(0.1, 0.1, 0.0), DVec3::Y * 0.2, DVec3::X * 0.2]);
        Self { surface, lamp: [Patch::Quad(corners)], corners }
    }

    fn shapes(&self) -> [Shape<'_, DVec3, f64>; 2] {
        [
            Shape { patches: self.surface, reflectance: 0.6, exitance: 0.0 },
            Shape { patches: &self.lamp, reflectance: 0.0, exitance: 30.0 },
        ]
    }

    fn refine(&self, divisions: [usize; 2], tolerance: f64) -> (Refined, f64, Enclosure<DVec3, f64>) {
        let shapes = self.shapes();
        let elements = uniform(0, self.surface, divisions).chain(uniform(1, &self.lamp, [1, 1])).collect();
        let mut enclosure = Enclosure::new(&shapes, elements, &STOP, &mut exact);
        let settings = Refinement { tolerance, smallest_area: 0.0, most_elements: 2000, stop: STOP };
        let (end, error) = enclosure.refine(&shapes, &settings, &mut exact);
        (end, error, enclosure)
    }

    /// The root mean square of how far the interpolated radiosity is from the truth, at points of the true surface.
    fn error(&self, enclosure: &Enclosure<DVec3, f64>) -> f64 {
        let field = enclosure.field(&self.shapes());
        let (mut error, mut total) = (0.0, 0.0);
        for (i, element) in enclosure.elements.iter().enumerate().filter(|(_, element)| element.shape == 0) {
            let patch = &self.surface[element.patch];
            for k in 0..25 {
                let place = place(element, [0.1 + 0.2 * f64::from(k % 5), 0.1 + 0.2 * f64::from(k / 5)]);
                let (point, normal) = (patch.point(place), patch.normal(place));
                let truth = 0.6 * 30.0 * point_to_polygon(point, normal, &self.corners);
                error += (field.value(i, element, point) - truth).powi(2) * element.area;
                total += truth * truth * element.area;
            }
        }
        (error / total).sqrt()
    }
}

/// Where a point of the unit square lies in the domain of the patch of an element.
fn place(element: &Element<DVec3>, [s, t]: [f64; 2]) -> [f64; 2] {
    let weights = match element.parameters() {
        [_, _, _] if s + t > 1.0 => [s + t - 1.0, 1.0 - s, 1.0 - t, 0.0],
        [_, _, _] => [1.0 - s - t, s, t, 0.0],
        _ => [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t],
    };
    let mean = |axis: usize| element.parameters().iter().zip(weights).map(|(place, w)| place[axis] * w).sum();
    [mean(0), mean(1)]
}

/// A flat dome over the unit square.
const DOME: [DVec3; 9] = [
    DVec3::new(0.0, 0.0, 0.0),
    DVec3::new(0.5, 0.0, 0.1),
    DVec3::new(1.0, 0.0, 0.0),
    DVec3::new(0.0, 0.5, 0.1),
    DVec3::new(0.5, 0.5, 0.3),
    DVec3::new(1.0, 0.5, 0.1),
    DVec3::new(0.0, 1.0, 0.0),
    DVec3::new(0.5, 1.0, 0.1),
    DVec3::new(1.0, 1.0, 0.0),
];

/// Under the middle of a lamp four quarters are alike, one element has no neighbors, and a row of elements has none to
/// the side; they say nothing of the error, and still the tolerance is met.
#[test]
fn refinement_is_not_fooled_by_symmetry() {
    let floor = [Patch::Quad(rectangle([DVec3::ZERO, DVec3::X, DVec3::Y]))];
    let dome = [Patch::Spline(BezierSurface::new(&DOME, 3).unwrap())];
    for (surface, height) in [(&floor, 0.3), (&dome, 0.5)] {
        let scene = UnderLamp::new(surface, DVec3::new(0.5, 0.5, height));
        for divisions in [[1, 1], [2, 2], [1, 3], [3, 3]] {
            for tolerance in [0.1, 0.05, 0.02] {
                let (end, estimate, enclosure) = scene.refine(divisions, tolerance);
                let (error, count) = (scene.error(&enclosure), enclosure.elements.len());
                println!("{divisions:?} {tolerance}: {count} elements, estimated {estimate:.4}, true {error:.4}");
                assert_eq!(end, Refined::Tolerance);
                assert!(error <= tolerance, "{divisions:?}: {error} with {count} elements");
            }
        }
    }
}

/// Triangles, polygons and splines from one element for each patch to the tolerance, under a lamp beside the middle.
#[test]
fn refinement_of_all_kinds_of_patches() {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let triangle = vec![Patch::Triangle([corner(0.0, 0.0), corner(1.0, 0.1), corner(0.3, 1.0)])];
    let corners = [corner(0.2, 0.0), corner(0.9, 0.1), corner(1.0, 0.7), corner(0.5, 1.0), corner(0.0, 0.6)];
    let pentagon: Vec<_> = polygon(&corners).collect();
    let spline = vec![Patch::Spline(BezierSurface::new(&DOME, 3).unwrap())];
    for surface in [triangle, pentagon, spline] {
        let scene = UnderLamp::new(&surface, DVec3::new(0.4, 0.45, 0.6));
        let (end, estimate, enclosure) = scene.refine([1, 1], 0.02);
        let (error, count) = (scene.error(&enclosure), enclosure.elements.len());
        println!("{count} elements, estimated {estimate:.4}, true {error:.4}");
        assert_eq!(end, Refined::Tolerance);
        assert!(error <= 0.02 && count < 500, "{error} with {count} elements");
    }
}

/// The rows of a cube by hemicubes: reciprocal and near the exact form factors, and the furnace is white to what the
/// pixels leave.
#[test]
fn exchange_by_hemicubes() {
    const N: usize = 64;
    let sides = cube();
    let elements: Vec<_> = (0..6).flat_map(|k| uniform(k, &sides[k], [2, 2]).collect::<Vec<_>>()).collect();
    let polygons: Vec<&[DVec3]> = elements.iter().map(|element| element.corners()).collect();
    let count = elements.len();
    let (mut items, mut depths) = (vec![0; hemicube_pixels(N)], vec![0.0; hemicube_pixels(N)]);
    let mut deltas = vec![0.0; hemicube_deltas(N)];
    let buffers = HemicubeBuffers { items: &mut items, depths: &mut depths, deltas: &mut deltas };
    let mut hemicube = Hemicube::new(N, buffers).unwrap();
    let (mut factors, mut errors) = (Vec::new(), Vec::new());
    let (mut row, mut scratch) = (vec![Estimate::default(); count], vec![Estimate::default(); count]);
    for polygon in &polygons {
        hemicube.polygon_row(
            polygon,
            &polygons,
            &Samples { points: 16, scrambles: 4, seed: 1 },
            &mut row,
            &mut scratch,
        );
        factors.extend(row.iter().map(|entry| entry.value));
        errors.extend(row.iter().map(|entry| entry.error));
    }
    let exchange = Exchange::from_rows(&elements, &Dense { count, factors: &factors });
    let truth = Exchange::new(&elements, &mut exact);
    for i in 0..count {
        assert!((exchange.row_sum(i) - 1.0).abs() < 0.02, "{}", exchange.row_sum(i));
        for j in 0..count {
            let [found, expected] = [&exchange, &truth].map(|exchange| exchange.between(i, j) / elements[i].area);
            let error = 0.5 * (errors[i * count + j] + errors[j * count + i]);
            assert!((found - expected).abs() <= error, "{i} {j}: {found} +- {error} is not {expected}");
            assert!((found - expected).abs() < 0.1 * expected.max(0.01), "{i} {j}: {found} is not {expected}");
        }
    }
    let shapes = sides.each_ref().map(|patches| Shape { patches, reflectance: 0.75, exitance: 1.0 });
    let mut enclosure = Enclosure { elements, exchange, radiosity: vec![0.0; count], sweeps: 0, pairs: 0 };
    enclosure.solve(&shapes, &STOP);
    assert!(enclosure.radiosity.iter().all(|b: &f64| (b / 4.0 - 1.0).abs() < 0.03), "{:?}", enclosure.radiosity);
}
