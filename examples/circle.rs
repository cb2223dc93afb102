//! Draws a circle in four forms to `circle.svg`, implicit, explicit, parametric and rational, and tells how round each is.

use std::fmt::{self, Write};
use std::fs;

use glam::{DVec2, dvec2};
use radiosity::spline::{Bezier, CIRCLE_KNOTS, Circle, KnotVector, Nurbs, arc_length};

const FILE: &str = "circle.svg";
const CIRCLE: Circle<DVec2> = Circle { center: DVec2::ZERO, x: DVec2::X, y: DVec2::Y };

/// Steps of the parameter in a picture, and of a check.
const STEPS: usize = 24;
const CHECKS: usize = 10_000;
/// Pixels of a radius, and of a panel.
const RADIUS: f64 = 70.0;
const PANEL: [f64; 2] = [190.0, 240.0];

/// A form of the circle: its name, its formula, and the point at a share of its domain.
struct Form {
    name: &'static str,
    formula: &'static str,
    domain: [f64; 2],
    point: fn(f64) -> DVec2,
}

/// The implicit form has no parameter: here the points are where rays from the center meet the curve, found by bisection.
const FORMS: [Form; 4] = [
    Form { name: "implicit", formula: "x^2 + y^2 - 1 = 0", domain: [0.0, std::f64::consts::TAU], point: traced },
    Form { name: "explicit", formula: "y = sqrt(1 - x^2)", domain: [-1.0, 1.0], point: |x| CIRCLE.explicit(x) },
    Form {
        name: "parametric",
        formula: "(cos a, sin a)",
        domain: [0.0, std::f64::consts::TAU],
        point: |alpha| CIRCLE.parametric(alpha),
    },
    Form {
        name: "rational",
        formula: "((1 - t^2), 2 t) / (1 + t^2)",
        domain: [-1.0, 1.0],
        point: |t| CIRCLE.rational(t),
    },
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:<10}  {:<28}  {:>12}  {:>9}  {:>9}", "form", "formula", "off by (ulp)", "shortest", "longest");
    for form in &FORMS {
        let [shortest, longest] = steps(form);
        let (name, formula, error) = (form.name, form.formula, form_error(form.domain, form.point));
        println!("{name:<10}  {formula:<28}  {error:>12.1}  {shortest:>9.4}  {longest:>9.4}");
    }
    let points = CIRCLE.nurbs();
    let nurbs = Nurbs::new(KnotVector::new(&CIRCLE_KNOTS, 2)?, &points)?;
    let error = form_error([0.0, 1.0], |t| nurbs.point(t));
    println!("{:<10}  {:<28}  {error:>12.1}", "NURBS", "9 points, degree 2");
    // What drawing programs use: four cubics without weights.
    let reach = 4.0 / 3.0 * (std::f64::consts::SQRT_2 - 1.0);
    let quarter = [DVec2::X, dvec2(1.0, reach), dvec2(reach, 1.0), DVec2::Y];
    let quarter = Bezier::new(&quarter)?;
    let error = form_error([0.0, 1.0], |t| quarter.point(t));
    println!("{:<10}  {:<28}  {error:>12.1e}", "cubic", "4 points, without weights");
    println!(
        "length of the NURBS curve / 2 pi = {:.15}",
        arc_length(&nurbs, [0.0, 1.0], 1e-13) / std::f64::consts::TAU
    );
    fs::write(FILE, picture()?)?;
    println!("{FILE} shows the points at equal steps of the parameter");
    Ok(())
}

/// Where a ray from the center leaves the inside of the implicit form.
fn traced(alpha: f64) -> DVec2 {
    let direction = DVec2::from_angle(alpha);
    let (mut inside, mut outside) = (0.0, 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if CIRCLE.implicit(direction * middle) < 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    direction * outside
}

/// The largest distance from the circle, in units in the last place of the radius.
fn form_error([from, to]: [f64; 2], point: impl Fn(f64) -> DVec2) -> f64 {
    let errors = (0..=CHECKS).map(|i| (point(from + (to - from) * i as f64 / CHECKS as f64).length() - 1.0).abs());
    errors.fold(0.0, f64::max) / f64::EPSILON
}

fn samples(form: &Form) -> Vec<DVec2> {
    let [from, to] = form.domain;
    (0..=STEPS).map(|i| (form.point)(from + (to - from) * i as f64 / STEPS as f64)).collect()
}

/// The shortest and the longest distance between two points at equal steps.
fn steps(form: &Form) -> [f64; 2] {
    let points = samples(form);
    let lengths = points.windows(2).map(|pair| pair[0].distance(pair[1]));
    lengths.fold([f64::MAX, 0.0], |[shortest, longest], length| [shortest.min(length), longest.max(length)])
}

fn picture() -> Result<String, fmt::Error> {
    let [width, height] = PANEL;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {height}\" font-family=\"sans-serif\" \
         text-anchor=\"middle\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        4.0 * width
    );
    for (number, form) in FORMS.iter().enumerate() {
        let (x, y) = ((number as f64 + 0.5) * width, 0.45 * height);
        let place = |p: DVec2| format!("{:.2},{:.2}", x + RADIUS * p.x, y - RADIUS * p.y);
        writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{RADIUS}\" fill=\"none\" stroke=\"#ccd\"/>")?;
        let line: Vec<String> = samples(form).into_iter().map(place).collect();
        writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"#357\"/>", line.join(" "))?;
        for point in samples(form) {
            let (cx, cy) = (x + RADIUS * point.x, y - RADIUS * point.y);
            writeln!(svg, "<circle cx=\"{cx:.2}\" cy=\"{cy:.2}\" r=\"3\" fill=\"#b40\"/>")?;
        }
        writeln!(svg, "<text x=\"{x}\" y=\"{}\" font-size=\"14\">{}</text>", height - 32.0, form.name)?;
        writeln!(svg, "<text x=\"{x}\" y=\"{}\" font-size=\"12\">{}</text>", height - 14.0, form.formula)?;
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}
