//! Solves a room of some hundred patches by all solvers and draws how many sweeps each needs into `convergence.svg`.
//!
//! The room is a closed cube whose ceiling has a lamp in its middle; all patches have the same reflectance.

use std::error::Error;
use std::fs;

use glam::DVec3;
use plotters::prelude::*;
use radiosity::form_factor::polygon_to_polygon;
use radiosity::solve::*;

const FILE: &str = "convergence.svg";
/// Patches along an edge of the room.
const SIDE: usize = 7;
const COUNT: usize = 6 * SIDE * SIDE;
const TOLERANCE: f64 = 1e-6;
const NAMES: [&str; 6] = ["Jacobi", "Gauss-Seidel", "over-relaxation", "shooting", "Chebyshev", "conjugate gradients"];

fn main() -> Result<(), Box<dyn Error>> {
    fs::write(FILE, picture()?)?;
    println!("{FILE} shows it; dashed is what theory says of Jacobi and of Chebyshev");
    Ok(())
}

/// Solves, prints and draws.
pub fn picture() -> Result<String, Box<dyn Error>> {
    let factors = form_factors(&patches());
    println!("{COUNT} patches; sweeps until the error is at most {TOLERANCE:e} of the brightest patch");
    println!("{:>5} {}", "rho", NAMES.map(|name| format!("{name:>22}")).concat());
    let mut curves = [const { Vec::new() }; 6];
    for percent in (5..90).step_by(5).chain(90..=99) {
        let rho = f64::from(percent) / 100.0;
        let sweeps = sweeps(&factors, rho);
        println!("{rho:5} {}", sweeps.map(|sweeps| format!("{sweeps:22.1}")).concat());
        curves.iter_mut().zip(sweeps).for_each(|(curve, sweeps)| curve.push((rho, sweeps)));
    }
    let mut svg = String::new();
    draw(&curves, &mut svg)?;
    Ok(svg)
}

/// The squares of the six faces, counter-clockwise seen from inside; first the ceiling.
fn patches() -> Vec<[DVec3; 4]> {
    let faces = [DVec3::NEG_Y, DVec3::Y, DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    let square = |k: usize| {
        let normal = faces[k / (SIDE * SIDE)];
        let (u, v) = normal.any_orthonormal_pair();
        let at = |i: usize, j: usize| {
            let [x, y] = [i, j].map(|index| index as f64 / SIDE as f64 - 0.5);
            u * x + v * y - normal * 0.5
        };
        let (i, j) = (k / SIDE % SIDE, k % SIDE);
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    };
    (0..COUNT).map(square).collect()
}

/// All patches are of one size, so that the matrix is symmetric.
fn form_factors(patches: &[[DVec3; 4]]) -> Vec<f64> {
    let mut factors = vec![0.0; COUNT * COUNT];
    for i in 0..COUNT {
        for j in 0..i {
            let factor = polygon_to_polygon(&patches[i], &patches[j]);
            (factors[i * COUNT + j], factors[j * COUNT + i]) = (factor, factor);
        }
    }
    factors
}

/// From what is emitted; `COUNT` shots are a sweep.
fn sweeps(factors: &[f64], rho: f64) -> [f64; 6] {
    let dense = Dense { count: COUNT, factors };
    let (mut exitance, reflectance, areas) = ([0.0; COUNT], [rho; COUNT], [1.0; COUNT]);
    exitance[SIDE * SIDE / 2] = 1.0;
    let system = System::new(&exitance, &reflectance, &dense);
    let stop = Stop { tolerance: TOLERANCE, most_steps: 1_000_000 };
    let solve = |solver: &mut dyn Solver<f64, _>| solver.solve(&system, &mut exitance.clone(), &stop).steps as f64;
    let mut scratch = [0.0; 3 * COUNT];
    [
        solve(&mut Jacobi::new(&mut scratch)),
        solve(&mut GaussSeidel),
        solve(&mut OverRelaxation::new(&system)),
        solve(&mut Southwell::new(&system, &areas, &mut scratch)) / COUNT as f64,
        solve(&mut Chebyshev::new(&system, &mut scratch)),
        solve(&mut ConjugateGradient::new(&system, &areas, &mut scratch)),
    ]
}

/// What theory says of Jacobi, whose error falls by `rho` a sweep, and of Chebyshev.
fn theory(rho: f64) -> [f64; 2] {
    let root = (1.0 - rho * rho).sqrt();
    [TOLERANCE.ln() / rho.ln(), (2.0 / TOLERANCE).ln() / ((1.0 + root) / rho).ln()]
}

fn draw(curves: &[Vec<(f64, f64)>; 6], svg: &mut String) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::with_string(svg, (720, 440)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..1.0, (0.7..2000.0).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .x_desc("reflectance of all patches")
        .y_desc("sweeps until the error is 1e-6")
        .y_label_formatter(&|sweeps| format!("{sweeps}"))
        .draw()?;
    for which in 0..2 {
        let line = (5..=99).map(|percent| f64::from(percent) / 100.0).map(|rho| (rho, theory(rho)[which]));
        chart.draw_series(DashedLineSeries::new(line, 3, 4, BLACK.mix(0.5).into()))?;
    }
    for (index, curve) in curves.iter().enumerate() {
        let color = HSLColor(index as f64 * 0.16, 0.9, 0.4);
        let series = chart.draw_series(LineSeries::new(curve.iter().copied(), color.stroke_width(2)))?;
        series.label(NAMES[index]).legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .label_font(("sans-serif", 16))
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE)
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(root.present()?)
}
