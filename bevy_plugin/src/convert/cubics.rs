//! Bevy's cubic curves and those of the core, both ways, without a rounding.
//!
//! Both keep a piece by the coefficients of its powers, so that pieces are copied; so are control points, knots and
//! weights. What `CubicGenerator::to_curve` makes of control points agrees with the core up to the rounding of its sums.
//! `From` cannot be implemented here between types that are both from elsewhere; for [`SplineCurve`] it is.

use bevy::math::cubic_splines::{
    CubicBSpline, CubicBezier, CubicCardinalSpline, CubicCurve, CubicHermite, CubicNurbs, CubicSegment, RationalCurve,
    RationalSegment,
};
use bevy::math::{Vec3, VectorSpace};
use radiosity::spline::{
    ControlPoint, Cubic, Homogeneous, OwnedBSpline, OwnedBezier, OwnedNurbs, SplineError, cardinal_tangents,
};

use crate::spline::SplineCurve;

/// A point of both worlds: `f32`, `Vec2`, `Vec3`, `Vec3A` or `Vec4`.
pub trait Point: ControlPoint<Scalar = f32, Point = Self> + VectorSpace<Scalar = f32> {}

impl<P: ControlPoint<Scalar = f32, Point = P> + VectorSpace<Scalar = f32>> Point for P {}

/// A piece of the core from one of Bevy.
pub fn from_segment<P: Point>(segment: &CubicSegment<P>) -> Cubic<P> {
    Cubic(segment.coeff)
}

/// A piece of Bevy from one of the core.
pub fn to_segment<P: Point>(cubic: &Cubic<P>) -> CubicSegment<P> {
    CubicSegment { coeff: cubic.0 }
}

/// A rational piece of the core from one of Bevy.
pub fn from_rational_segment<P: Point>(segment: &RationalSegment<P>) -> Cubic<Homogeneous<P>> {
    let RationalSegment { coeff, weight_coeff, .. } = segment;
    Cubic([0, 1, 2, 3].map(|k| Homogeneous { scaled: coeff[k], weight: weight_coeff[k] }))
}

/// A rational piece of Bevy from one of the core, over an interval of parameters of this length.
pub fn to_rational_segment<P: Point>(cubic: &Cubic<Homogeneous<P>>, knot_span: f32) -> RationalSegment<P> {
    let Cubic(points) = cubic;
    RationalSegment {
        coeff: points.map(|point| point.scaled),
        weight_coeff: points.map(|point| point.weight),
        knot_span,
    }
}

/// The pieces of a curve of Bevy.
pub fn from_curve<P: Point>(curve: &CubicCurve<P>) -> Vec<Cubic<P>> {
    curve.segments().iter().map(from_segment).collect()
}

/// A curve of Bevy from its pieces; none from no pieces.
pub fn to_curve<P: Point>(pieces: &[Cubic<P>]) -> Option<CubicCurve<P>> {
    CubicCurve::from_segments(pieces.iter().map(to_segment))
}

/// The pieces of a rational curve of Bevy, each with the length of its interval of parameters.
pub fn from_rational_curve<P: Point>(curve: &RationalCurve<P>) -> Vec<(Cubic<Homogeneous<P>>, f32)> {
    curve.segments().iter().map(|segment| (from_rational_segment(segment), segment.knot_span)).collect()
}

/// A rational curve of Bevy from its pieces; none from no pieces.
pub fn to_rational_curve<P: Point>(pieces: &[(Cubic<Homogeneous<P>>, f32)]) -> Option<RationalCurve<P>> {
    RationalCurve::from_segments(pieces.iter().map(|(piece, span)| to_rational_segment(piece, *span)))
}

/// Bezier curves of the core from those of Bevy.
///
/// # Errors
///
/// Where a coordinate is not finite.
pub fn from_bezier<P: Point>(curves: &CubicBezier<P>) -> Result<Vec<OwnedBezier<P>>, SplineError> {
    curves.control_points.iter().map(|points| OwnedBezier::new(points.to_vec())).collect()
}

/// Bezier curves of Bevy from those of the core; none where one is not cubic.
pub fn to_bezier<P: Point>(curves: &[OwnedBezier<P>]) -> Option<CubicBezier<P>> {
    let cubics = curves.iter().map(|curve| curve.curve().points().try_into().ok());
    cubics.collect::<Option<Vec<[P; 4]>>>().map(CubicBezier::new)
}

/// Points and tangents at the times 0, 1, 2 ..., as [`Hermite`](radiosity::spline::Hermite) takes them, from a spline of
/// Bevy.
pub fn from_hermite<P: Point>(spline: &CubicHermite<P>) -> (Vec<P>, Vec<P>) {
    spline.control_points.iter().copied().unzip()
}

/// A spline of Bevy from points and tangents at the times 0, 1, 2 ...; as many as there are of both.
pub fn to_hermite<P: Point>(points: &[P], tangents: &[P]) -> CubicHermite<P> {
    CubicHermite::new(points.iter().copied(), tangents.iter().copied())
}

/// Points and tangents at the times 0, 1, 2 ... from a cardinal spline of Bevy, whose tension is half of one less that of
/// the core.
///
/// # Errors
///
/// None: there are as many tangents as points.
pub fn from_cardinal<P: Point>(spline: &CubicCardinalSpline<P>) -> Result<(Vec<P>, Vec<P>), SplineError> {
    let mut tangents = vec![P::default(); spline.control_points.len()];
    cardinal_tangents(&spline.control_points, 1.0 - 2.0 * spline.tension, &mut tangents)?;
    Ok((spline.control_points.clone(), tangents))
}

/// A cardinal spline of Bevy from points and a tension of the core.
pub fn to_cardinal<P: Point>(points: &[P], tension: f32) -> CubicCardinalSpline<P> {
    CubicCardinalSpline::new(0.5 * (1.0 - tension), points.iter().copied())
}

/// A B-spline of the core from one of Bevy, whose domain begins at 0 and has one piece for each unit.
///
/// # Errors
///
/// Where there are less than four points, or a coordinate is not finite.
pub fn from_b_spline<P: Point>(spline: &CubicBSpline<P>) -> Result<OwnedBSpline<P>, SplineError> {
    let knots = (0..spline.control_points.len() + 4).map(|i| i as f32 - 3.0).collect();
    OwnedBSpline::new(knots, 3, spline.control_points.clone())
}

/// A B-spline of Bevy from an open one of the core; none where that is not cubic or its knots not at equal distances.
pub fn to_b_spline<P: Point>(spline: &OwnedBSpline<P>) -> Option<CubicBSpline<P>> {
    let curve = spline.curve();
    let fits = curve.degree() == 3 && !curve.is_closed() && is_uniform(curve.knots().knots());
    fits.then(|| CubicBSpline::new(curve.points().iter().copied()))
}

/// Whether at least two knots stand at equal distances, but for the rounding of each, which is the larger a share of
/// those distances the more knots there are.
fn is_uniform(knots: &[f32]) -> bool {
    let [start, end] = [knots[0], knots[knots.len() - 1]].map(f64::from);
    let step = (end - start) / (knots.len() - 1) as f64;
    let rounding = 4.0 * f64::from(f32::EPSILON) * start.abs().max(end.abs());
    // Far from 0, rounding may be as large as a step; equal knots are never uniform.
    let slack = rounding.min(0.25 * step);
    knots.iter().enumerate().all(|(i, &knot)| (f64::from(knot) - (start + i as f64 * step)).abs() <= slack)
}

/// A NURBS curve of the core from one of Bevy, whose control points are multiplied with their weights already.
///
/// # Errors
///
/// Where a weight is not positive, or the knots are none for the core.
pub fn from_nurbs<P: Point>(nurbs: &CubicNurbs<P>) -> Result<OwnedNurbs<P>, SplineError> {
    let points = nurbs.control_points.iter().zip(&nurbs.weights);
    let points = points.map(|(&scaled, &weight)| Homogeneous { scaled, weight }).collect();
    OwnedNurbs::new(nurbs.knots.clone(), 3, points)
}

/// A NURBS curve of Bevy from an open one of the core; none where that is not cubic.
pub fn to_nurbs<P: Point>(nurbs: &OwnedNurbs<P>) -> Option<CubicNurbs<P>> {
    let curve = nurbs.curve();
    (curve.degree() == 3 && !curve.is_closed()).then(|| CubicNurbs {
        control_points: curve.points().iter().map(|point| point.scaled).collect(),
        weights: curve.points().iter().map(|point| point.weight).collect(),
        knots: curve.knots().knots().to_vec(),
    })
}

/// Piece for piece; those that meet share a control point.
impl From<&CubicCurve<Vec3>> for SplineCurve {
    fn from(curve: &CubicCurve<Vec3>) -> Self {
        let mut points: Vec<Vec3> = Vec::new();
        let mut knots = vec![0.0; 4];
        for (number, piece) in from_curve(curve).into_iter().enumerate() {
            let bezier = piece.to_bezier();
            let size = bezier.iter().map(|point| point.distance(bezier[0])).fold(0.0, f32::max);
            let meets = points.last().is_some_and(|end| end.distance(bezier[0]) <= 1e-5 * size);
            if number > 0 {
                knots.extend(vec![number as f32; if meets { 3 } else { 4 }]);
            }
            points.extend(&bezier[usize::from(meets)..]);
        }
        knots.extend([curve.segments().len() as f32; 4]);
        Self::new(3, knots, points)
    }
}

/// Its control points, not multiplied with their weights.
impl From<&CubicNurbs<Vec3>> for SplineCurve {
    fn from(nurbs: &CubicNurbs<Vec3>) -> Self {
        let points = nurbs.control_points.iter().zip(&nurbs.weights).map(|(&scaled, &weight)| scaled / weight);
        Self::new(3, nurbs.knots.clone(), points.collect()).with_weights(nurbs.weights.clone())
    }
}
