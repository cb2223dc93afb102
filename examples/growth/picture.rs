//! A series on paper with logarithms along both axes.

use std::error::Error;

use plotters::prelude::*;

use super::series::Series;

/// An SVG of the points, of the power law that fits them, and of the growth that should be.
pub fn draw(series: &Series) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (640, 440)).into_drawing_area();
        root.fill(&WHITE)?;
        let [x, y] = [0, 1].map(|axis| bounds(series.points.iter().map(|point| point[axis])));
        let mut chart = ChartBuilder::on(&root)
            .margin(12)
            .caption(format!("power {:.2}; {}", series.slope(), series.law), ("sans-serif", 18))
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d((x[0]..x[1]).log_scale(), (y[0]..y[1]).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .label_style(("sans-serif", 16))
            .axis_desc_style(("sans-serif", 18))
            .x_desc(series.name)
            .y_desc(series.measured)
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .draw()?;
        let law = series.points.iter().map(|&[x, _]| (x, law(series, x))).filter(|(_, at)| *at <= y[1]);
        chart.draw_series(DashedLineSeries::new(law, 4, 4, BLACK.mix(0.5).into()))?;
        let points = || series.points.iter().map(|&[x, y]| (x, y));
        chart.draw_series(LineSeries::new(points(), BLUE.stroke_width(2)))?;
        chart.draw_series(points().map(|point| Circle::new(point, 4, BLUE.filled())))?;
        root.present()?;
    }
    Ok(svg)
}

/// Where the growth should be at a number, through the first point.
fn law(series: &Series, at: f64) -> f64 {
    let [x, y] = series.points[0];
    if series.name == "triangles" { y * at.ln() / x.ln() } else { y * at / x }
}

/// A little more than all numbers.
fn bounds(numbers: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let (low, high) = (numbers.clone().fold(f64::INFINITY, f64::min), numbers.fold(0.0, f64::max));
    [0.7 * low.max(1e-9), 1.5 * high.max(2e-9)]
}

fn label(number: &f64) -> String {
    if *number >= 1e4 { format!("{number:.0e}") } else { format!("{number}") }
}
