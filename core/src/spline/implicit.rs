//! The implicit form of a plane curve: the function that is 0 on it.

use super::bernstein::PASCAL;
use super::{Bezier, ControlPoint, MAX_DEGREE};
use crate::math::{Real, VectorSpace};

impl<P: ControlPoint> Bezier<'_, P> {
    /// The implicit form `f(x, y)` of the curve in the plane of the first two coordinates, at a point.
    ///
    /// 0 where the curve and its continuation pass, to rounding, of other signs on both sides of it. The determinant of
    /// Bezout's matrix of the two equations `x(t) = x` and `y(t) = y`, whose entries in Bernstein form are areas of
    /// triangles of the point and two control points: Sederberg and Chen 1995; degree 1 gives the equation of a line.
    /// The work grows with the third power of the degree.
    pub fn implicit(&self, point: P::Point) -> P::Scalar {
        let n = self.degree();
        let mut bezout = [[P::Scalar::ZERO; MAX_DEGREE]; MAX_DEGREE];
        for (i, row) in bezout[..n].iter_mut().enumerate() {
            for (j, entry) in row[..n].iter_mut().enumerate() {
                let least = (i + j + 1).saturating_sub(n);
                *entry = (least..=i.min(j)).map(|m| self.area(point, m, i + j + 1 - m)).sum();
            }
        }
        determinant(&mut bezout[..n])
    }

    /// Twice the area of the triangle of a point and two control points, times their weights and binomials.
    fn area(&self, point: P::Point, i: usize, j: usize) -> P::Scalar {
        let [a, b] = [i, j].map(|k| {
            let offset = self.points()[k].project() - point;
            let factor = P::Scalar::from_f64(PASCAL[self.degree()][k]) * self.points()[k].weight();
            [offset.coordinate(0) * factor, offset.coordinate(1) * factor]
        });
        a[0] * b[1] - a[1] * b[0]
    }
}

/// By elimination, with the largest pivot of each column; 1 without rows.
fn determinant<R: Real, const N: usize>(rows: &mut [[R; N]]) -> R {
    let n = rows.len();
    let mut product = R::ONE;
    for k in 0..n {
        let largest = (k..n).fold(k, |best, i| if rows[i][k].abs() > rows[best][k].abs() { i } else { best });
        if rows[largest][k] == R::ZERO {
            return R::ZERO;
        }
        if largest != k {
            rows.swap(k, largest);
            product = -product;
        }
        let (done, rest) = rows.split_at_mut(k + 1);
        let pivot = &done[k];
        product *= pivot[k];
        for row in rest {
            let factor = row[k] / pivot[k];
            (k..n).for_each(|j| row[j] -= factor * pivot[j]);
        }
    }
    product
}
