//! Draws Nusselt's projection of a polygon to `nusselt.svg` and finds its form factor in four ways.

use std::fmt::Write;
use std::fs;

use glam::{DVec3, Vec3};
use radiosity::form_factor::*;
use radiosity::geometry::{BruteForce, Hit};

const FILE: &str = "nusselt.svg";
const N: usize = 256;

/// Pixels for the radius of the disc.
const RADIUS: f64 = 118.0;
/// The center of the disc in space, and in the plane.
const CENTERS: [[f64; 2]; 2] = [[140.0, 290.0], [512.0, 185.0]];

fn main() -> std::io::Result<()> {
    let polygon = polygon();
    println!("by arcs of ellipses  {:.9}", nusselt_area(DVec3::ZERO, DVec3::Z, &polygon));
    println!("by Lambert's sum     {:.9}", point_to_polygon(DVec3::ZERO, DVec3::Z, &polygon));

    let [a, b, c, d] = polygon.map(|corner| corner.as_vec3());
    let (samples, mut row) = (Samples { scrambles: 16, points: 4096, seed: 0 }, [Estimate::<f64>::default()]);
    let sender = |_| [Vec3::ZERO, Vec3::Z];
    let occluders = BruteForce([[a, b, c], [a, c, d]]);
    nusselt_rays(sender, &occluders, |_: &Hit| Some(0), &samples, &mut row, &mut [0]);
    println!("by 65536 rays        {:.6} +- {:.6}", row[0].value, row[0].error);

    let (mut items, mut depths) = (vec![0; hemicube_pixels(N)], vec![0.0; hemicube_pixels(N)]);
    let mut deltas = vec![0.0; hemicube_deltas(N)];
    let buffers = HemicubeBuffers { items: &mut items, depths: &mut depths, deltas: &mut deltas };
    let mut hemicube = Hemicube::new(N, buffers).expect("the buffers fit");
    hemicube.point_row([DVec3::ZERO, DVec3::Z], 0.0, &[&polygon], &mut row);
    println!("by a hemicube of {N} {:.6} +- {:.6}", row[0].value, row[0].error);

    fs::write(FILE, picture())?;
    println!("{FILE} shows it");
    Ok(())
}

/// A tilted parallelogram above the origin, counter-clockwise seen from there.
fn polygon() -> [DVec3; 4] {
    let (center, u, v) = (DVec3::new(1.0, 0.5, 1.45), DVec3::new(0.25, -0.55, 0.2), DVec3::new(0.45, 0.2, -0.35));
    [center - u - v, center - u + v, center + u + v, center + u - v]
}

/// On the left all of it in space, on the right the disc as the point sees it.
pub fn picture() -> String {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 660 370\" width=\"660\" font-family=\"sans-serif\" font-size=\"14\">\n\
         <rect width=\"660\" height=\"370\" rx=\"8\" fill=\"#fff\"/>\n",
    );
    in_space(&mut svg).and_then(|()| on_the_disc(&mut svg)).expect("strings take all");
    svg.push_str("</svg>\n");
    svg
}

fn in_space(svg: &mut String) -> std::fmt::Result {
    let polygon = polygon();
    let sphere: Vec<DVec3> = outline(&polygon).iter().map(|corner| corner.normalize()).collect();
    let disc: Vec<DVec3> = sphere.iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect();
    let circle: Vec<DVec3> =
        (0..72).map(|k| DVec3::from((glam::DVec2::from_angle(f64::from(k).to_radians() * 5.0), 0.0))).collect();
    let [x, y] = CENTERS[0];
    let (left, right) = (x - RADIUS, x + RADIUS);
    area(svg, &circle, "fill=\"#eef1f5\" stroke=\"#667\"")?;
    for corner in polygon {
        let (high, low) = (corner.normalize(), corner.normalize() * DVec3::new(1.0, 1.0, 0.0));
        line(svg, DVec3::ZERO, corner, "stroke=\"#357\" stroke-dasharray=\"5 3\"")?;
        line(svg, high, low, "stroke=\"#b40\" stroke-dasharray=\"2 3\"")?;
    }
    area(svg, &disc, "fill=\"#2a7\" fill-opacity=\".75\" stroke=\"#152\"")?;
    writeln!(
        svg,
        "<path d=\"M{left:.1} {y:.1}A{RADIUS} {RADIUS} 0 0 1 {right:.1} {y:.1}\" fill=\"#9ab\" fill-opacity=\".15\" stroke=\"#667\"/>"
    )?;
    area(svg, &sphere, "fill=\"#f80\" fill-opacity=\".6\" stroke=\"#b40\"")?;
    area(svg, &polygon, "fill=\"#48c\" fill-opacity=\".55\" stroke=\"#135\"")?;
    line(svg, DVec3::ZERO, DVec3::Z * 0.45, "stroke=\"#000\" stroke-width=\"2\"")?;
    let [tip_x, tip_y] = project(DVec3::Z * 0.45);
    writeln!(
        svg,
        "<circle cx=\"{x}\" cy=\"{y}\" r=\"3\"/>\n<text x=\"{:.1}\" y=\"{:.1}\">n</text>",
        tip_x - 14.0,
        tip_y + 8.0
    )
}

fn on_the_disc(svg: &mut String) -> std::fmt::Result {
    let [x, y] = CENTERS[1];
    writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{RADIUS}\" fill=\"#eef1f5\" stroke=\"#667\"/>")?;
    let (mut path, mut ellipses) = (String::new(), String::new());
    nusselt_arcs(DVec3::ZERO, DVec3::Z, &polygon(), |arc| {
        let turn = (-arc.axis[1]).atan2(arc.axis[0]).to_degrees();
        let minor = arc.minor.abs() * RADIUS;
        let [from, to] =
            [arc.from, arc.to].map(|[right, up]| format!("{:.1} {:.1}", x + right * RADIUS, y - up * RADIUS));
        let sweep = u8::from(arc.minor < 0.0);
        let start = if path.is_empty() { format!("M{from}") } else { String::new() };
        path += &format!("{start}A{RADIUS} {minor:.1} {turn:.1} 0 {sweep} {to}");
        ellipses += &format!(
            "<ellipse rx=\"{RADIUS}\" ry=\"{minor:.1}\" transform=\"translate({x} {y}) rotate({turn:.1})\" \
             fill=\"none\" stroke=\"#899\" stroke-dasharray=\"2 4\"/>\n"
        );
    });
    writeln!(
        svg,
        "{ellipses}<path d=\"{path}Z\" fill=\"#2a7\" fill-opacity=\".75\" stroke=\"#152\" stroke-width=\"1.5\"/>"
    )?;
    let factor = nusselt_area(DVec3::ZERO, DVec3::Z, &polygon());
    writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"3\"/>")?;
    writeln!(
        svg,
        "<text x=\"{x}\" y=\"{:.1}\" text-anchor=\"middle\">F = green / disc = {factor:.4}</text>",
        y + RADIUS + 28.0
    )
}

/// The boundary of a polygon in small steps.
fn outline(polygon: &[DVec3; 4]) -> Vec<DVec3> {
    let point = |k: usize| polygon[k / 16].lerp(polygon[(k / 16 + 1) % 4], (k % 16) as f64 / 16.0);
    (0..64).map(point).collect()
}

/// A point of space in the picture: seen from the side and from 18 degrees above.
fn project(point: DVec3) -> [f64; 2] {
    let (turned, (sin, cos)) = (glam::DQuat::from_rotation_z(-0.8) * point, 0.32_f64.sin_cos());
    [CENTERS[0][0] + turned.x * RADIUS, CENTERS[0][1] - (turned.z * cos + turned.y * sin) * RADIUS]
}

fn area(svg: &mut String, corners: &[DVec3], style: &str) -> std::fmt::Result {
    let points: Vec<String> =
        corners.iter().map(|&corner| project(corner)).map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    writeln!(svg, "<polygon points=\"{}\" {style}/>", points.join(" "))
}

fn line(svg: &mut String, from: DVec3, to: DVec3, style: &str) -> std::fmt::Result {
    let ([x1, y1], [x2, y2]) = (project(from), project(to));
    writeln!(svg, "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>")
}
