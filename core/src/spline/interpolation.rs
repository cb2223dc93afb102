//! B-splines through points, and near to many points.

use super::bezier::MAX_ORDER;
use super::control_point::{check_finite, check_highest};
use super::split::check_buffer;
use super::{KnotVector, SplineError};
use crate::math::{Real, VectorSpace};

/// Writes the knots for a curve of a degree through points at ascending parameters, clamped.
///
/// Inner knots are means of as many parameters as the degree, so that each basis function is above its point. "The
/// NURBS Book", equation 9.8.
///
/// # Errors
///
/// Where the degree is above [`MAX_DEGREE`](super::MAX_DEGREE), or there are not more parameters than the degree, or not
/// `degree + 1` knots more than parameters.
pub fn averaged_knots<R: Real>(parameters: &[R], degree: usize, knots: &mut [R]) -> Result<(), SplineError> {
    let [Some(&first), Some(&last)] = [parameters.first(), parameters.last()] else { return Err(SplineError::Empty) };
    check_highest(degree)?;
    if parameters.len() <= degree {
        return Err(SplineError::PointCount { points: parameters.len(), wanted: degree + 1 });
    }
    check_buffer(knots.len(), parameters.len() + degree + 1)?;
    for (i, knot) in knots.iter_mut().enumerate() {
        *knot = if i <= degree {
            first
        } else if i >= parameters.len() {
            last
        } else {
            let near = &parameters[i - degree..i.max(i - degree + 1)];
            near.iter().copied().sum::<R>() / R::from_usize(near.len())
        };
    }
    Ok(())
}

/// How many numbers [`interpolate`] and [`fit`] need at most as scratch: a band around the diagonal of their matrix.
pub const fn band(count: usize, degree: usize) -> usize {
    count * (2 * degree + 1)
}

/// Writes the control points of the B-spline that goes through `points` at `parameters`.
///
/// `scratch` has [`band`] numbers. Basis functions have no negative values anywhere and their matrix is totally
/// positive, so that elimination without pivots is stable (de Boor and Pinkus 1977). The curve has `degree - 1`
/// continuous derivatives where knots are simple.
///
/// # Errors
///
/// Where there are not as many parameters, points and control points as basis functions, a buffer does not fit, a
/// number is not finite, a parameter lies outside of the domain by more than rounding, or a basis function is 0 at its
/// point (Schoenberg and Whitney 1953), as it may be where parameters do not ascend.
pub fn interpolate<V: VectorSpace>(
    knots: KnotVector<V::Scalar>,
    parameters: &[V::Scalar],
    points: &[V],
    scratch: &mut [V::Scalar],
    control_points: &mut [V],
) -> Result<(), SplineError> {
    let (count, degree) = (knots.count(), knots.degree());
    check_sizes(knots, [parameters.len(), points.len(), control_points.len()], scratch)?;
    check_buffer(points.len(), count)?;
    check_finite(points)?;
    check_parameters(knots, parameters)?;
    let mut band = Band { rows: scratch, half: degree };
    band.rows.fill(V::Scalar::ZERO);
    for (i, &t) in parameters.iter().enumerate() {
        let (first, basis) = basis_at(knots, t);
        for (k, &value) in basis.iter().enumerate().take(degree + 1) {
            match band.entry(i, first + k) {
                Some(entry) => *entry = value,
                None if value == V::Scalar::ZERO => {}
                None => return Err(SplineError::Singular { index: i }),
            }
        }
    }
    control_points.copy_from_slice(points);
    band.solve(control_points)
}

/// Writes the control points of the B-spline that is nearest to `points` at `parameters`: the sum of the squares of all
/// distances is the least.
///
/// `scratch` has [`band`] numbers. The equations are taken one by one into a triangle with `degree` diagonals by rotations
/// (Givens 1958), which keep all digits that the points determine; the normal equations would lose half of them. Lawson
/// and Hanson, "Solving Least Squares Problems", chapter 27. Returns the root of the mean of the squared distances.
///
/// # Errors
///
/// Where there are not as many parameters as points and as many control points as basis functions, a buffer does not
/// fit, a number is not finite, a parameter lies outside of the domain by more than rounding, or there are too few points
/// near a basis function.
pub fn fit<V: VectorSpace>(
    knots: KnotVector<V::Scalar>,
    parameters: &[V::Scalar],
    points: &[V],
    scratch: &mut [V::Scalar],
    control_points: &mut [V],
) -> Result<V::Scalar, SplineError> {
    let degree = knots.degree();
    check_sizes(knots, [parameters.len(), points.len(), control_points.len()], scratch)?;
    check_finite(points)?;
    check_parameters(knots, parameters)?;
    let mut triangle = Triangle { rows: scratch, width: degree + 1 };
    triangle.rows.fill(V::Scalar::ZERO);
    control_points.fill(V::default());
    for (&t, &point) in parameters.iter().zip(points) {
        let (first, mut basis) = basis_at(knots, t);
        triangle.take(first, &mut basis[..=degree], point, control_points);
    }
    triangle.solve(control_points)?;
    let squared = parameters.iter().zip(points).map(|(&t, &point)| {
        let (first, basis) = basis_at(knots, t);
        let near = control_points[first..=first + degree].iter().zip(basis);
        (near.fold(V::default(), |sum, (&p, b)| sum + p * b) - point).length_squared()
    });
    Ok((squared.sum::<V::Scalar>() / V::Scalar::from_usize(points.len().max(1))).sqrt())
}

/// Whether all parameters lie in the domain, but for the rounding with which its ends may have been computed.
fn check_parameters<R: Real>(knots: KnotVector<R>, parameters: &[R]) -> Result<(), SplineError> {
    let [start, end] = knots.domain();
    let slack = R::EPSILON * R::from_f64(4.0) * (start.abs() + end.abs());
    // No number lies nowhere.
    match parameters.iter().find(|&&t| !(t >= start - slack && t <= end + slack)) {
        Some(&t) => Err(knots.outside(t)),
        None => Ok(()),
    }
}

/// The basis functions at a parameter, and the index of the first of them.
fn basis_at<R: Real>(knots: KnotVector<R>, t: R) -> (usize, [R; MAX_ORDER]) {
    let [start, end] = knots.domain();
    let t = t.clamp(start, end);
    let span = knots.span(t);
    (span - knots.degree(), knots.basis(span, t))
}

fn check_sizes<R: Real>(
    knots: KnotVector<R>,
    [parameters, points, control_points]: [usize; 3],
    scratch: &[R],
) -> Result<(), SplineError> {
    if parameters != points {
        return Err(SplineError::PointCount { points: parameters, wanted: points });
    }
    check_buffer(control_points, knots.count())?;
    check_buffer(scratch.len(), band(knots.count(), knots.degree()))
}

/// A matrix that is 0 but for `half` diagonals on both sides of the middle one.
struct Band<'a, R> {
    rows: &'a mut [R],
    half: usize,
}

impl<R: Real> Band<'_, R> {
    fn entry(&mut self, row: usize, column: usize) -> Option<&mut R> {
        let width = 2 * self.half + 1;
        let place = (column + self.half).checked_sub(row).filter(|&place| place < width)?;
        self.rows.get_mut(row * width + place)
    }

    fn value(&self, row: usize, column: usize) -> R {
        self.rows[row * (2 * self.half + 1) + column + self.half - row]
    }

    /// Elimination without pivots; the right sides become the solution.
    fn solve<V: VectorSpace<Scalar = R>>(&mut self, right: &mut [V]) -> Result<(), SplineError> {
        let (n, half) = (right.len(), self.half);
        let tiny = R::EPSILON * (0..n).map(|i| self.value(i, i).abs()).fold(R::ZERO, R::max);
        for k in 0..n {
            let pivot = self.value(k, k);
            if pivot.abs() <= tiny {
                return Err(SplineError::Singular { index: k });
            }
            let reach = (k + half).min(n - 1);
            for i in k + 1..=reach {
                let factor = self.value(i, k) / pivot;
                for j in k + 1..=reach {
                    let above = self.value(k, j);
                    if let Some(entry) = self.entry(i, j) {
                        *entry -= factor * above;
                    }
                }
                right[i] = right[i] - right[k] * factor;
            }
        }
        for k in (0..n).rev() {
            let known = (k + 1..=(k + half).min(n - 1)).fold(V::default(), |sum, j| sum + right[j] * self.value(k, j));
            right[k] = (right[k] - known) / self.value(k, k);
        }
        Ok(())
    }
}

/// A matrix that is 0 below its diagonal and above the `width - 1` diagonals next to it.
struct Triangle<'a, R> {
    rows: &'a mut [R],
    width: usize,
}

impl<R: Real> Triangle<'_, R> {
    /// Takes in an equation whose factors begin at column `first`.
    fn take<V: VectorSpace<Scalar = R>>(&mut self, first: usize, factors: &mut [R], mut right: V, rights: &mut [V]) {
        for k in 0..factors.len() {
            let factor = factors[k];
            if factor == R::ZERO {
                continue;
            }
            let row = &mut self.rows[(first + k) * self.width..][..self.width];
            let length = (row[0] * row[0] + factor * factor).sqrt();
            let (cos, sin) = (row[0] / length, factor / length);
            for (above, below) in row.iter_mut().zip(&mut factors[k..]) {
                (*above, *below) = (*above * cos + *below * sin, *below * cos - *above * sin);
            }
            let above = rights[first + k];
            (rights[first + k], right) = (above * cos + right * sin, right * cos - above * sin);
        }
    }

    /// The right sides become the solution.
    fn solve<V: VectorSpace<Scalar = R>>(&self, rights: &mut [V]) -> Result<(), SplineError> {
        let row = |i: usize| &self.rows[i * self.width..][..self.width];
        let largest = (0..rights.len()).map(|i| row(i)[0].abs()).fold(R::ZERO, R::max);
        let tiny = largest * R::EPSILON * R::from_usize(rights.len());
        for i in (0..rights.len()).rev() {
            if row(i)[0].abs() <= tiny {
                return Err(SplineError::Singular { index: i });
            }
            let known = row(i)[1..].iter().zip(&rights[i + 1..]);
            let rest = known.fold(rights[i], |rest, (&factor, &right)| rest - right * factor);
            rights[i] = rest / row(i)[0];
        }
        Ok(())
    }
}
