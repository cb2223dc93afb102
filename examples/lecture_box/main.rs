//! The lecture's radiosity method in four steps on a small room: patches, form factors, Gauss-Seidel, pictures.

mod picture;
mod room;

use std::error::Error;

use glam::DVec3;
use radiosity::form_factor::visible_point_to_polygon;
use radiosity::patch::{Element, Enclosure, Field, Refinement};
use radiosity::solve::{Facet, FormFactors, GaussSeidel, Solver, Stop, System, phong_start};

use picture::Picture;
use room::Room;

const STOP: Stop<f64> = Stop { tolerance: 1e-4, most_steps: 100 };

fn main() -> Result<(), Box<dyn Error>> {
    let room = Room::new()?;
    let shapes = room.shapes();

    // 1. Cut the surfaces into patches, all of about the same size.
    let elements = room.cut();
    println!("{} patches", elements.len());

    // 2. The form factors of all pairs, with what stands between; then finer patches where the light varies.
    let blockers = room.blockers();
    let blockers: Vec<&[DVec3]> = blockers.iter().map(|element| element.corners()).collect();
    let mut form_factor = |a: &Element<DVec3>, b: &Element<DVec3>| {
        // The mean over four points of the smaller patch; each sees the larger one exactly.
        let points = a.corners().iter().map(|&corner| (a.center + corner) * 0.5);
        let seen = points.map(|point| visible_point_to_polygon(point, a.normal, b.corners(), &blockers));
        seen.sum::<f64>() / a.corners().len() as f64
    };
    let mut enclosure = Enclosure::new(&shapes, elements, &STOP, &mut form_factor);
    let settings = Refinement { tolerance: 0.06, smallest_area: 0.001, most_elements: 1200, stop: STOP };
    let (end, error) = enclosure.refine(&shapes, &settings, &mut form_factor);
    println!("{} patches after refinement ({end:?}), estimated error {:.1} %", enclosure.elements.len(), 100.0 * error);

    // 3. Solve b = e + rho F b, from zero and from what local lighting gives.
    let of =
        |get: fn(&room::Shape) -> DVec3| enclosure.elements.iter().map(|e| get(&shapes[e.shape])).collect::<Vec<_>>();
    let (exitance, reflectance) = (of(|shape| shape.exitance), of(|shape| shape.reflectance));
    let system = System::new(&exitance, &reflectance, &enclosure.exchange);
    let mut radiosity = vec![DVec3::ZERO; exitance.len()];
    solve("zero", &system, &mut radiosity);
    let facet = |e: &Element<DVec3>| Facet { center: e.center, normal: e.normal, area: e.area };
    let facets: Vec<Facet<DVec3, f64>> = enclosure.elements.iter().map(facet).collect();
    phong_start(&system, &facets, &[], &mut radiosity);
    solve("Phong", &system, &mut radiosity);

    // 4. Pictures: each patch in its radiosity, and a continuous function through all of them.
    let field = Field::new(&shapes, &enclosure.elements, &radiosity);
    Picture::flat(&enclosure.elements, &field)?.write_png("lecture_box_patches.png")?;
    Picture::interpolated(&enclosure.elements, &field)?.write_png("lecture_box.png")?;
    println!("lecture_box_patches.png shows the patches, lecture_box.png what is interpolated between them");
    Ok(())
}

/// Prints how fast Gauss-Seidel gets from a start to the solution.
fn solve(start: &str, system: &System<DVec3, impl FormFactors<Scalar = f64>>, radiosity: &mut [DVec3]) {
    println!("Gauss-Seidel from {start}:");
    for sweep in 1..=STOP.most_steps {
        let accuracy = GaussSeidel.step(system, radiosity);
        let share = (accuracy.error / accuracy.largest).max_element();
        println!("  sweep {sweep:2}: within {:.4} % of the brightest patch", 100.0 * share);
        if accuracy.is_within(STOP.tolerance) {
            break;
        }
    }
}
