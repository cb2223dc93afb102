//! Bicubic pieces in powers of the parameters: what a surface is turned into where single points must be fast.

use super::{BSplineSurface, Direction, SurfacePoint};
use crate::math::{Real, VectorSpace};
use crate::spline::{KnotVector, SplineError};

/// The surface `Σ a[i][j] u^i v^j`, `i` and `j` from 0 to 3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bicubic<P>(pub [[P; 4]; 4]);

impl<P: SurfacePoint> Bicubic<P> {
    /// The point at `u` and `v`, by Estrin's rule along both.
    #[inline]
    pub fn point(&self, u: P::Scalar, v: P::Scalar) -> P::Point {
        self.control_point(u, v).project()
    }

    /// The point before it is projected. It goes through memory, where all of its coordinates lie side by side: compilers
    /// then compute two of them at once.
    #[inline(never)]
    fn control_point(&self, u: P::Scalar, v: P::Scalar) -> P {
        estrin(&self.along(u), v)
    }

    /// The point with its first derivatives by `u` and by `v`.
    #[inline]
    pub fn tangents(&self, u: P::Scalar, v: P::Scalar) -> [P::Point; 3] {
        let along = self.along(u);
        let [_, b, c, d] = &self.0;
        let [two, three] = [2.0, 3.0].map(P::Scalar::from_f64);
        let by_u: [P; 4] = core::array::from_fn(|j| (d[j] * (three * u) + c[j] * two) * u + b[j]);
        let [[point, dv], [du, _]] =
            P::project_partials([[estrin(&along, v), slope(&along, v)], [estrin(&by_u, v), P::default()]]);
        [point, du, dv]
    }

    /// The coefficients of the curve at one `u`: all at once, since what lies side by side is then the same work.
    #[inline(always)]
    fn along(&self, u: P::Scalar) -> [P; 4] {
        let [a, b, c, d] = &self.0;
        let step = |high: &[P; 4], low: &[P; 4], u: P::Scalar| {
            [high[0] * u + low[0], high[1] * u + low[1], high[2] * u + low[2], high[3] * u + low[3]]
        };
        step(&step(d, c, u), &step(b, a, u), u * u)
    }
}

/// A cubic polynomial by Estrin's rule: as much work as by Horner's, of which less waits for other work.
#[inline(always)]
fn estrin<P: VectorSpace>(&[a, b, c, d]: &[P; 4], t: P::Scalar) -> P {
    (d * t + c) * (t * t) + (b * t + a)
}

#[inline(always)]
fn slope<P: VectorSpace>(&[_, b, c, d]: &[P; 4], t: P::Scalar) -> P {
    (d * (P::Scalar::from_f64(3.0) * t) + c * P::Scalar::from_f64(2.0)) * t + b
}

/// A B-spline surface of degree 3 or less in both directions as [`Bicubic`] pieces on borrowed memory, each in the
/// distances from the knots where it begins: single points take about half of the time they take on the surface, from which it
/// differs by rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bicubics<'a, P: VectorSpace> {
    knots: [KnotVector<'a, P::Scalar>; 2],
    /// Row by row, empty intervals of knots among them.
    pieces: &'a [Bicubic<P>],
}

impl<'a, P: SurfacePoint> Bicubics<'a, P> {
    /// How many pieces a surface has.
    pub fn count(surface: &BSplineSurface<P>) -> usize {
        [Direction::U, Direction::V].map(|direction| intervals(&surface.knots(direction))).into_iter().product()
    }

    /// Writes the pieces of a surface.
    ///
    /// # Errors
    ///
    /// Where a degree is above 3, or there is not as much memory as [`Bicubics::count`] says.
    pub fn new(surface: &BSplineSurface<'a, P>, memory: &'a mut [Bicubic<P>]) -> Result<Self, SplineError> {
        let knots = [Direction::U, Direction::V].map(|direction| surface.knots(direction));
        if let Some(degree) = knots.iter().map(|knots| knots.degree()).find(|&degree| degree > 3) {
            return Err(SplineError::Degree { degree });
        }
        let wanted = Self::count(surface);
        if memory.len() != wanted {
            return Err(SplineError::PointCount { points: memory.len(), wanted });
        }
        let [along, across] = &knots;
        let width = intervals(along);
        for (number, piece) in memory.iter_mut().enumerate() {
            let spans = [along.degree() + number % width, across.degree() + number / width];
            *piece = powers(surface, spans);
        }
        Ok(Self { knots, pieces: memory })
    }

    /// The point at `u` and `v`; outside of the domain, on the continuation of the pieces at the border.
    #[inline]
    pub fn point(&self, u: P::Scalar, v: P::Scalar) -> P::Point {
        let (piece, u, v) = self.piece(u, v);
        piece.point(u, v)
    }

    /// The point with its first derivatives by `u` and by `v`.
    #[inline]
    pub fn tangents(&self, u: P::Scalar, v: P::Scalar) -> [P::Point; 3] {
        let (piece, u, v) = self.piece(u, v);
        piece.tangents(u, v)
    }

    /// The piece at parameters, and its own parameters.
    #[inline(always)]
    fn piece(&self, u: P::Scalar, v: P::Scalar) -> (&'a Bicubic<P>, P::Scalar, P::Scalar) {
        let [along, across] = &self.knots;
        let [i, j] = [along.span_inlined(u), across.span_inlined(v)];
        let piece = &self.pieces[(j - across.degree()) * intervals(along) + i - along.degree()];
        (piece, u - along.knots()[i], v - across.knots()[j])
    }
}

#[inline(always)]
fn intervals<R: Real>(knots: &KnotVector<R>) -> usize {
    knots.count() - knots.degree()
}

/// Taylor's formula for both basis functions; all zero where an interval is empty.
fn powers<P: SurfacePoint>(surface: &BSplineSurface<P>, spans: [usize; 2]) -> Bicubic<P> {
    let mut piece = Bicubic([[P::default(); 4]; 4]);
    let knots = [Direction::U, Direction::V].map(|direction| surface.knots(direction));
    let is_empty = |k: usize| knots[k].knots()[spans[k]] >= knots[k].knots()[spans[k] + 1];
    if is_empty(0) || is_empty(1) {
        return piece;
    }
    let [along, across] = [0, 1].map(|k| knots[k].orders::<4>(spans[k], knots[k].knots()[spans[k]]));
    let factorials = [1.0, 1.0, 2.0, 6.0].map(P::Scalar::from_f64);
    for (row, points) in surface.rows(spans).enumerate() {
        for (column, &point) in points.iter().enumerate() {
            for (j, i) in (0..4).flat_map(|j| (0..4).map(move |i| (j, i))) {
                piece.0[i][j] += point * (along[i][column] / factorials[i] * (across[j][row] / factorials[j]));
            }
        }
    }
    piece
}
