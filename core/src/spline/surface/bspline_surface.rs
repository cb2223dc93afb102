//! B-spline surfaces and NURBS: tensor products of B-spline curves.

use super::{Curvature, SurfaceJet, SurfacePoint};
use crate::math::{Real, VectorSpace};
use crate::spline::basis::{cox_de_boor, cox_de_boor_orders};
use crate::spline::bezier::{MAX_ORDER, weighted};
use crate::spline::control_point::{check_degree, check_points};
use crate::spline::split::{check_buffer, hull};
use crate::spline::{ControlPoint, Homogeneous, KnotVector, SplineError};

/// A tensor product surface on borrowed knots and control points, of degree 0 to [`MAX_DEGREE`](crate::spline::MAX_DEGREE) in both directions.
///
/// Of points it is a B-spline surface, of [`Homogeneous`] points a [`NurbsSurface`]; with [`bezier`](Self::bezier) it has
/// one polynomial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BSplineSurface<'a, P: VectorSpace> {
    knots: [KnotVector<'a, P::Scalar>; 2],
    points: &'a [P],
}

/// A rational B-spline surface.
pub type NurbsSurface<'a, V> = BSplineSurface<'a, Homogeneous<V>>;

/// As many parameters of a grid are kept at a time.
const BLOCK: usize = 16;

/// The number that a surface has for parameters.
pub type Scalar<P> = <P as VectorSpace>::Scalar;

/// The first and the last `u`, the first and the last `v`.
pub type Domain<R> = [[R; 2]; 2];

/// The direction of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the rows of control points.
    U,
    /// From row to row.
    V,
}

impl<'a, P: SurfacePoint> BSplineSurface<'a, P> {
    /// A surface with knots along `u` and `v` and rows of control points, each as long as the knots along `u` say.
    ///
    /// # Errors
    ///
    /// Where there are not as many points as the knots of both directions say, a coordinate is not finite, or a weight is
    /// not positive.
    pub fn new([u, v]: [KnotVector<'a, P::Scalar>; 2], points: &'a [P]) -> Result<Self, SplineError> {
        let wanted = u.count() * v.count();
        if points.len() != wanted {
            return Err(SplineError::PointCount { points: points.len(), wanted });
        }
        check_points(points)?;
        Ok(Self { knots: [u, v], points })
    }

    /// A Bezier surface over the unit square, of degree `columns - 1` in `u` and of one less than the number of rows in
    /// `v`.
    ///
    /// # Errors
    ///
    /// Where the points do not fill rows of `columns`, a degree is above [`MAX_DEGREE`](crate::spline::MAX_DEGREE), a coordinate is not finite, or a
    /// weight is not positive.
    pub fn bezier(points: &'a [P], columns: usize) -> Result<Self, SplineError> {
        check_degree(points.len().min(1))?;
        check_degree(columns)?;
        if !points.len().is_multiple_of(columns) {
            return Err(SplineError::Ragged { points: points.len(), columns });
        }
        check_degree(points.len() / columns)?;
        Self::new([KnotVector::bezier(columns - 1)?, KnotVector::bezier(points.len() / columns - 1)?], points)
    }

    /// What was checked before.
    #[cfg(feature = "alloc")]
    pub(in crate::spline) fn assume(knots: [KnotVector<'a, P::Scalar>; 2], points: &'a [P]) -> Self {
        Self { knots, points }
    }

    /// The knots along a direction.
    pub fn knots(&self, direction: Direction) -> KnotVector<'a, P::Scalar> {
        self.knots[direction as usize]
    }

    /// The control points, row by row.
    pub fn points(&self) -> &'a [P] {
        self.points
    }

    /// How many control points a row has.
    pub fn columns(&self) -> usize {
        self.knots[0].count()
    }

    /// The parameters that it has points for; others lie on the continuation of its pieces at the border.
    pub fn domain(&self) -> Domain<P::Scalar> {
        self.knots.map(|knots| knots.domain())
    }

    /// The lowest and the highest corner of a box around the control points, and so around the surface.
    pub fn bounds(&self) -> [P::Point; 2] {
        hull(self.points)
    }

    /// The point at `u` and `v`.
    #[inline]
    pub fn point(&self, u: P::Scalar, v: P::Scalar) -> P::Point {
        self.partials_in::<1>(self.spans_at(u, v), u, v)[0][0].project()
    }

    /// Writes the points of a grid, row after row: those at all `us` and the first of the `vs`, then those at the second.
    ///
    /// Much faster than point by point, where parameters ascend: what depends on one parameter alone is found once.
    ///
    /// # Errors
    ///
    /// Where there are not as many points as pairs of parameters.
    pub fn sample(&self, us: &[P::Scalar], vs: &[P::Scalar], points: &mut [P::Point]) -> Result<(), SplineError> {
        check_buffer(points.len(), us.len() * vs.len())?;
        let width = us.len().max(1);
        for (block, us) in us.chunks(BLOCK).enumerate() {
            let rows = points.chunks_exact_mut(width).map(|row| &mut row[block * BLOCK..]);
            match self.knots.map(|knots| knots.degree()) {
                [2, 2] => self.sample_block::<3>([2, 2], us, vs, rows),
                [3, 3] => self.sample_block::<4>([3, 3], us, vs, rows),
                degrees => self.sample_block::<MAX_ORDER>(degrees, us, vs, rows),
            }
        }
        Ok(())
    }

    /// The part of a grid with a few parameters along `u`.
    #[inline(always)]
    fn sample_block<'p, const N: usize>(
        &self,
        [p, q]: [usize; 2],
        us: &[P::Scalar],
        vs: &[P::Scalar],
        rows: impl Iterator<Item = &'p mut [P::Point]>,
    ) {
        let mut along = [(0, [P::Scalar::ZERO; N]); BLOCK];
        for (slot, &u) in along.iter_mut().zip(us) {
            let span = self.knots[0].span(u);
            *slot = (span, cox_de_boor(self.knots[0].around(span), p, u));
        }
        for (&v, row) in vs.iter().zip(rows) {
            let span = self.knots[1].span(v);
            let across: [P::Scalar; N] = cox_de_boor(self.knots[1].around(span), q, v);
            let mut column = [P::default(); N];
            let mut of = usize::MAX;
            for (point, (i, along)) in row.iter_mut().zip(&along[..us.len()]) {
                if *i != of {
                    (column, of) = (self.across([*i, span], [p, q], &across), *i);
                }
                *point = weighted(&column[..p + 1], |k| along[k]).project();
            }
        }
    }

    /// The control points of the curve along `u` that a piece of the surface has at one `v`.
    #[inline(always)]
    fn across<const N: usize>(&self, [i, j]: [usize; 2], [p, q]: [usize; 2], across: &[P::Scalar; N]) -> [P; N] {
        let mut column = [P::default(); N];
        let columns = self.columns();
        for (k, row) in self.points[(j - q) * columns + i - p..].chunks(columns).take(q + 1).enumerate() {
            column.iter_mut().zip(&row[..p + 1]).for_each(|(sum, &point)| *sum += point * across[k]);
        }
        column
    }

    /// The point with its first derivatives by `u` and by `v`.
    #[inline]
    pub fn tangents(&self, u: P::Scalar, v: P::Scalar) -> [P::Point; 3] {
        let [[point, dv], [du, _]] = self.derivatives::<2>(u, v);
        [point, du, dv]
    }

    /// The point with all derivatives up to the second.
    #[inline]
    pub fn at(&self, u: P::Scalar, v: P::Scalar) -> SurfaceJet<P::Point> {
        SurfaceJet::new(self.derivatives::<3>(u, v))
    }

    /// All derivatives of an order below `N`: `[a][b]` is the one `a` times by `u` and `b` times by `v`, zero where `a + b`
    /// is `N` or more. Where two pieces join, they are those of the piece with the larger parameters.
    #[inline]
    pub fn derivatives<const N: usize>(&self, u: P::Scalar, v: P::Scalar) -> [[P::Point; N]; N] {
        self.derivatives_in(self.spans_at(u, v), u, v)
    }

    /// The same from the piece in these intervals of knots, continued where the parameters lie outside of them.
    #[inline]
    pub(in crate::spline) fn derivatives_in<const N: usize>(
        &self,
        spans: [usize; 2],
        u: P::Scalar,
        v: P::Scalar,
    ) -> [[P::Point; N]; N] {
        P::project_partials(self.partials_in::<N>(spans, u, v))
    }

    /// The normal of length 1; zero where the surface has none.
    ///
    /// Where an edge is collapsed to a point, it is the limit on the way towards the middle of the surface.
    pub fn normal(&self, u: P::Scalar, v: P::Scalar) -> P::Point {
        let [_, du, dv] = self.tangents(u, v);
        let (normal, speed) = (crate::math::Vector::cross(du, dv), du.length_squared() + dv.length_squared());
        let length = normal.length();
        // Twice what decides in `SurfaceJet::normal`.
        if length > (P::Scalar::EPSILON.sqrt() + P::Scalar::EPSILON.sqrt()) * speed {
            return normal / length;
        }
        let [middle_u, middle_v] = self.domain().map(|[low, high]| (low + high) * P::Scalar::from_f64(0.5));
        self.at(u, v).normal([middle_u - u, middle_v - v])
    }

    /// How the surface bends.
    pub fn curvature(&self, u: P::Scalar, v: P::Scalar) -> Curvature<P::Scalar> {
        self.at(u, v).curvature()
    }

    /// The derivatives in the space of the control points.
    #[inline]
    fn partials_in<const N: usize>(&self, spans: [usize; 2], u: P::Scalar, v: P::Scalar) -> [[P; N]; N] {
        match self.knots.map(|knots| knots.degree()) {
            [1, 1] => self.partials_of_order::<N, 2, 2>(spans, u, v),
            [2, 1] => self.partials_of_order::<N, 3, 2>(spans, u, v),
            [2, 2] => self.partials_of_order::<N, 3, 3>(spans, u, v),
            [2, 3] => self.partials_of_order::<N, 3, 4>(spans, u, v),
            [3, 3] => self.partials_of_order::<N, 4, 4>(spans, u, v),
            _ => self.partials_of_any_order::<N>(spans, u, v),
        }
    }

    /// The same for the usual degrees, `A - 1` along `u` and `B - 1` along `v`.
    #[inline]
    fn partials_of_order<const N: usize, const A: usize, const B: usize>(
        &self,
        [i, j]: [usize; 2],
        u: P::Scalar,
        v: P::Scalar,
    ) -> [[P; N]; N] {
        let along = cox_de_boor_orders::<_, A, N>(self.knots[0].around(i), A - 1, u);
        let across = cox_de_boor_orders::<_, B, N>(self.knots[1].around(j), B - 1, v);
        let columns = self.columns();
        let mut partials = [[P::default(); N]; N];
        let start = (j + 1 - B) * columns + i + 1 - A;
        let rows = self.points[start..].chunks(columns).take(B).filter_map(|row| row.first_chunk::<A>());
        for (k, row) in rows.enumerate() {
            for (a, along) in along.iter().enumerate() {
                let mut of_row = row[0] * along[0];
                (1..A).for_each(|i| of_row += row[i] * along[i]);
                (0..N - a).for_each(|b| partials[a][b] += of_row * across[b][k]);
            }
        }
        partials
    }

    /// The same for all degrees.
    fn partials_of_any_order<const N: usize>(&self, spans: [usize; 2], u: P::Scalar, v: P::Scalar) -> [[P; N]; N] {
        let along = self.knots[0].orders::<N>(spans[0], u);
        let across = self.knots[1].orders::<N>(spans[1], v);
        let mut partials = [[P::default(); N]; N];
        for (j, row) in self.rows(spans).enumerate() {
            let mut of_row = [P::default(); N];
            for (i, &point) in row.iter().enumerate() {
                of_row.iter_mut().zip(&along).for_each(|(sum, weights)| *sum += point * weights[i]);
            }
            for (a, of_row) in of_row.into_iter().enumerate() {
                let sums = partials[a].iter_mut().zip(&across).take(N - a);
                sums.for_each(|(sum, weights)| *sum += of_row * weights[j]);
            }
        }
        partials
    }

    #[inline]
    fn spans_at(&self, u: P::Scalar, v: P::Scalar) -> [usize; 2] {
        [self.knots[0].span(u), self.knots[1].span(v)]
    }

    /// The parts of the rows that have an influence in an interval of knots.
    #[inline]
    pub(super) fn rows(&self, [i, j]: [usize; 2]) -> impl Iterator<Item = &'a [P]> + use<'a, P> {
        let [p, q] = [self.knots[0].degree(), self.knots[1].degree()];
        let columns = self.columns();
        self.points[(j - q) * columns..(j + 1) * columns].chunks_exact(columns).map(move |row| &row[i - p..=i])
    }
}

impl<'a, V: crate::math::Vector> NurbsSurface<'a, V> {
    /// The weights of the control points.
    pub fn weights(&self) -> impl Iterator<Item = V::Scalar> + use<'a, V> {
        self.points.iter().map(|point| point.weight())
    }
}
