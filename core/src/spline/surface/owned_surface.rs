//! Surfaces that own their knots and points: they can be edited, refined, split and cut into curves.

use alloc::vec;
use alloc::vec::Vec;

use super::{BSplineSurface, Direction, SurfacePoint};
use crate::math::{Real, VectorSpace};
use crate::spline::{KnotVector, MAX_DEGREE, OwnedBSpline, SplineError};

/// A tensor product surface that owns its knots and control points.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedSurface<P: VectorSpace> {
    knots: [Vec<P::Scalar>; 2],
    degrees: [usize; 2],
    points: Vec<P>,
}

impl<P: SurfacePoint> OwnedSurface<P> {
    /// A surface with knots and degrees along `u` and `v`, and rows of control points along `u`.
    ///
    /// # Errors
    ///
    /// As those of [`KnotVector::new`] and [`BSplineSurface::new`].
    pub fn new(knots: [Vec<P::Scalar>; 2], degrees: [usize; 2], points: Vec<P>) -> Result<Self, SplineError> {
        let [u, v] = [0, 1].map(|k| KnotVector::new(&knots[k], degrees[k]));
        BSplineSurface::new([u?, v?], &points)?;
        Ok(Self { knots, degrees, points })
    }

    /// A surface that comes back to its beginning along one direction or both, like a tube or a ring.
    ///
    /// As for a [closed](crate::spline::BSpline::closed) curve, the distances of the first `2 degree + 1` knots of such a
    /// direction repeat themselves at the end, and `degree` columns (along `u`) or rows (along `v`) of control points less
    /// are given, which are those at the beginning again. The surface keeps them twice, as [`points`](Self::points) shows:
    /// it is an open one whose ends meet, with `degree - 1` continuous derivatives where knots are simple. Parameters
    /// outside of the domain are not taken round.
    ///
    /// # Errors
    ///
    /// As for [`new`](Self::new), with so many points less; also where the knots of a closed direction do not repeat
    /// themselves.
    pub fn closed(
        directions: &[Direction],
        knots: [Vec<P::Scalar>; 2],
        degrees: [usize; 2],
        points: &[P],
    ) -> Result<Self, SplineError> {
        let [u, v] = [0, 1].map(|k| KnotVector::new(&knots[k], degrees[k]));
        let all = [u?, v?];
        let given = |direction: Direction| match directions.contains(&direction) {
            true => all[direction as usize].period(),
            false => Ok(all[direction as usize].count()),
        };
        let (columns, rows) = (given(Direction::U)?, given(Direction::V)?);
        if points.len() != columns * rows {
            return Err(SplineError::PointCount { points: points.len(), wanted: columns * rows });
        }
        let [wider, higher] = all.map(|knots| knots.count());
        let at = |j: usize, i: usize| points[j % rows * columns + i % columns];
        let repeated = (0..higher).flat_map(|j| (0..wider).map(move |i| at(j, i))).collect();
        Self::new(knots, degrees, repeated)
    }

    /// A copy of a borrowed surface.
    pub fn copy_of(surface: &BSplineSurface<P>) -> Self {
        let all = [Direction::U, Direction::V].map(|direction| surface.knots(direction));
        let (knots, degrees) = (all.map(|knots| knots.knots().to_vec()), all.map(|knots| knots.degree()));
        Self { knots, degrees, points: surface.points().to_vec() }
    }

    /// To evaluate it.
    pub fn surface(&self) -> BSplineSurface<'_, P> {
        let knots = [0, 1].map(|k| KnotVector::trusted(&self.knots[k], self.degrees[k]));
        BSplineSurface::assume(knots, &self.points)
    }

    /// Moves control points, in rows along `u`.
    ///
    /// # Errors
    ///
    /// Where there are not as many as before, a coordinate is not finite, or a weight is not positive.
    pub fn set_points(&mut self, points: &[P]) -> Result<(), SplineError> {
        BSplineSurface::new([Direction::U, Direction::V].map(|d| self.surface().knots(d)), points)?;
        self.points.copy_from_slice(points);
        Ok(())
    }

    /// The same surface with more knots along a direction.
    ///
    /// # Errors
    ///
    /// Where a knot lies outside of the domain or there are too many equal ones.
    pub fn with_knots(&self, direction: Direction, knots: &[P::Scalar]) -> Result<Self, SplineError> {
        let [low, high] = self.surface().knots(direction).domain();
        if let Some(outside) = knots.iter().find(|&&knot| !(low <= knot && knot <= high)) {
            let domain = [low, high].map(Real::to_f64);
            return Err(SplineError::Parameter { parameter: outside.to_f64(), domain });
        }
        let probe = self.lines(direction).next().ok_or(SplineError::Empty)?.with_inserted_knots(knots);
        KnotVector::new(&probe, self.degrees[direction as usize])?;
        Ok(self.changed(direction, |line| line.with_inserted(knots)))
    }

    /// A surface with one knot less along a direction, and how far it is away at most.
    ///
    /// # Errors
    ///
    /// As [`BSpline::remove`](crate::spline::BSpline::remove), with the index of a point in its row or column.
    pub fn without_knot(&self, direction: Direction, knot: P::Scalar) -> Result<(Self, P::Scalar), SplineError> {
        let removed: Result<Vec<_>, _> = self.lines(direction).map(|line| line.removed(knot)).collect();
        let (lines, distances): (Vec<_>, Vec<_>) = removed?.into_iter().unzip();
        let farthest = distances.into_iter().fold(P::Scalar::ZERO, Real::max);
        Ok((self.with_lines(direction, lines), farthest))
    }

    /// The same surface with every inner knot as often as its degree, so that each piece has the control points of a Bezier
    /// surface.
    ///
    /// Its single points are found faster: the basis functions of such a piece share one quotient in each direction. "The
    /// NURBS Book", algorithm A5.7.
    pub fn decomposed(&self) -> Self {
        [Direction::U, Direction::V].into_iter().fold(self.clone(), |surface, direction| {
            let (all, degree) = (surface.surface().knots(direction), surface.degrees[direction as usize]);
            let [low, high] = all.domain();
            let inner = all.spans().map(|span| all.knots()[span]).filter(|&knot| low < knot && knot < high);
            let missing = inner.flat_map(|knot| vec![knot; degree.saturating_sub(all.multiplicity(knot))]);
            let missing: Vec<_> = missing.collect();
            surface.changed(direction, |line| line.with_inserted(&missing))
        })
    }

    /// The same surface with a degree higher by one along a direction.
    ///
    /// # Errors
    ///
    /// Where it is [`MAX_DEGREE`] already.
    pub fn elevated(&self, direction: Direction) -> Result<Self, SplineError> {
        match self.degrees[direction as usize] {
            MAX_DEGREE => Err(SplineError::Degree { degree: MAX_DEGREE + 1 }),
            _ => Ok(self.changed(direction, OwnedBSpline::raised)),
        }
    }

    /// The parts before and after a parameter.
    ///
    /// # Errors
    ///
    /// Where the parameter is not inside of the domain.
    pub fn split(&self, direction: Direction, t: P::Scalar) -> Result<[Self; 2], SplineError> {
        let [low, high] = self.surface().knots(direction).domain();
        if !(low < t && t < high) {
            return Err(SplineError::Parameter { parameter: t.to_f64(), domain: [low, high].map(Real::to_f64) });
        }
        Ok([0, 1].map(|part| self.changed(direction, |line| line.part(t, part))))
    }

    /// The curve on the surface along a direction, where the other parameter is `t`, held within the domain.
    pub fn isocurve(&self, along: Direction, t: P::Scalar) -> OwnedBSpline<P> {
        let mut points = vec![P::default(); self.surface().knots(along).count()];
        // The buffer fits.
        let _ = self.surface().isocurve(along, t, &mut points);
        let along = along as usize;
        OwnedBSpline { knots: self.knots[along].clone(), degree: self.degrees[along], points }
    }

    /// The control points, in rows along `u`.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// With `u` and `v` exchanged; the front becomes the back.
    pub fn transposed(&self) -> Self {
        let columns = self.surface().columns();
        let points = (0..columns).flat_map(|i| self.points.iter().skip(i).step_by(columns).copied()).collect();
        let ([u, v], [p, q]) = (self.knots.clone(), self.degrees);
        Self { knots: [v, u], degrees: [q, p], points }
    }

    /// Surfaces over the unit square with the same degree and the same knots along a direction.
    pub(super) fn alike(surfaces: [Self; 3], direction: Direction) -> [Self; 3] {
        let index = direction as usize;
        let probes = surfaces.iter().filter_map(|surface| surface.lines(direction).next()).collect();
        let (knots, degree) = match super::compatible::compatible(probes).into_iter().next() {
            Some(probe) => (probe.knots, probe.degree),
            None => return surfaces,
        };
        surfaces.map(|mut surface| {
            while surface.degrees[index] < degree {
                surface = surface.changed(direction, OwnedBSpline::raised);
            }
            surface.changed(direction, |line| line.with_knots(knots.clone()))
        })
    }

    /// From lines of control points along `u`, all with the same knots, one for each control point along `v`.
    pub(super) fn from_rows(
        rows: Vec<OwnedBSpline<P>>,
        v_knots: Vec<P::Scalar>,
        v_degree: usize,
    ) -> Result<Self, SplineError> {
        let (u_knots, u_degree) = rows.first().map(|row| (row.knots.clone(), row.degree)).ok_or(SplineError::Empty)?;
        let points = rows.into_iter().flat_map(|row| row.points).collect();
        Self::new([u_knots, v_knots], [u_degree, v_degree], points)
    }

    /// The lines of control points along a direction, as curves.
    fn lines(&self, direction: Direction) -> impl Iterator<Item = OwnedBSpline<P>> + '_ {
        let columns = self.surface().columns();
        let rows = self.points.len() / columns;
        let (count, length, step, stride) = match direction {
            Direction::U => (rows, columns, columns, 1),
            Direction::V => (columns, rows, 1, columns),
        };
        let (knots, degree) = (&self.knots[direction as usize], self.degrees[direction as usize]);
        (0..count).map(move |line| OwnedBSpline {
            knots: knots.clone(),
            degree,
            points: (0..length).map(|k| self.points[line * step + k * stride]).collect(),
        })
    }

    /// The same change to all lines along a direction.
    fn changed(&self, direction: Direction, change: impl Fn(&OwnedBSpline<P>) -> OwnedBSpline<P>) -> Self {
        self.with_lines(direction, self.lines(direction).map(|line| change(&line)).collect())
    }

    /// With other lines along a direction, as many as before, all with the same knots.
    fn with_lines(&self, direction: Direction, lines: Vec<OwnedBSpline<P>>) -> Self {
        let (knots, degree, length) = (lines[0].knots.clone(), lines[0].degree, lines[0].points.len());
        let mut changed = self.clone();
        let index = direction as usize;
        (changed.knots[index], changed.degrees[index]) = (knots, degree);
        changed.points = match direction {
            Direction::U => lines.into_iter().flat_map(|line| line.points).collect(),
            Direction::V => (0..length).flat_map(|k| lines.iter().map(move |line| line.points[k])).collect(),
        };
        changed
    }
}
