//! A series on paper with logarithms along both axes.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::series::{Curve, Law, Series};

/// An SVG of time and memory: the points, the power law that fits them, and the growth that should be.
pub fn draw(series: &Series) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (1000, 400)).into_drawing_area();
        root.fill(&WHITE)?;
        for (area, curve) in root.split_evenly((1, 2)).iter().zip([&series.time, &series.memory]) {
            draw_curve(area, series.name, curve)?;
        }
        root.present()?;
    }
    Ok(svg)
}

fn draw_curve(area: &DrawingArea<SVGBackend<'_>, Shift>, name: &str, curve: &Curve) -> Result<(), Box<dyn Error>> {
    let Curve { measured, points, law } = curve;
    let [x, y] = [0, 1].map(|axis| bounds(points.iter().map(|point| point[axis])));
    let y = decades(y);
    let dashed = match law {
        Law::Linear => "as their number",
        Law::Logarithmic => "as its logarithm",
    };
    let slope = curve.slope();
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .caption(format!("power {slope:.2}; dashed: {dashed}"), ("sans-serif", 18))
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d((x[0]..x[1]).log_scale(), (y[0]..y[1]).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .x_desc(name)
        .y_desc(*measured)
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .draw()?;
    let should = points.iter().map(|&[x, _]| (x, law.at(points[0], x))).filter(|(_, at)| *at <= y[1]);
    chart.draw_series(DashedLineSeries::new(should, 4, 4, BLACK.mix(0.5).into()))?;
    let points = || points.iter().map(|&[x, y]| (x, y));
    chart.draw_series(LineSeries::new(points(), BLUE.stroke_width(2)))?;
    chart.draw_series(points().map(|point| Circle::new(point, 4, BLUE.filled())))?;
    Ok(())
}

/// A little more than all numbers.
fn bounds(numbers: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let (low, high) = (numbers.clone().fold(f64::INFINITY, f64::min), numbers.fold(0.0, f64::max));
    [0.7 * low.max(1e-9), 1.5 * high.max(2e-9)]
}

/// Out to powers of ten, which have labels.
fn decades([low, high]: [f64; 2]) -> [f64; 2] {
    [10_f64.powf(low.log10().floor()), 10_f64.powf(high.log10().ceil())]
}

fn label(number: &f64) -> String {
    let rounded = (number * 1e9).round() / 1e9;
    if *number >= 1e4 { format!("{number:.0e}") } else { format!("{rounded}") }
}
