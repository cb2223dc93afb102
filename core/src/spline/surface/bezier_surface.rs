//! Bezier surfaces: curves of curves.

use super::SurfaceJet;
use crate::math::{Real, Vector};
use crate::spline::control_point::{check_degree, check_finite};
use crate::spline::{Jet, MAX_DEGREE, SplineError, de_casteljau};

/// A tensor product Bezier surface on borrowed control points; `u` runs along the rows and `v` from row to row.
///
/// Its front is the side from which `u` to `v` is a turn to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BezierSurface<'a, V> {
    points: &'a [V],
    columns: usize,
}

impl<'a, V: Vector> BezierSurface<'a, V> {
    /// A surface of degree `columns - 1` in `u` and of one less than the number of rows in `v`.
    ///
    /// # Errors
    ///
    /// Where the points do not fill rows of `columns`, a degree is above [`MAX_DEGREE`], or a coordinate is not finite.
    pub fn new(points: &'a [V], columns: usize) -> Result<Self, SplineError> {
        check_degree(points.len().min(1))?;
        check_degree(columns)?;
        if !points.len().is_multiple_of(columns) {
            return Err(SplineError::Ragged { points: points.len(), columns });
        }
        check_degree(points.len() / columns)?;
        check_finite(points)?;
        Ok(Self { points, columns })
    }

    /// The point at `u` and `v` in `[0, 1]` with its derivatives: de Casteljau along each row, then across the rows.
    pub fn at(&self, u: V::Scalar, v: V::Scalar) -> SurfaceJet<V> {
        let mut row = [V::default(); MAX_DEGREE + 1];
        let mut across = [[V::default(); MAX_DEGREE + 1]; 3];
        let rows = self.points.len() / self.columns;
        for (j, points) in self.points.chunks_exact(self.columns).enumerate() {
            row[..self.columns].copy_from_slice(points);
            let Jet { point, first, second } = de_casteljau(&mut row[..self.columns], u);
            [across[0][j], across[1][j], across[2][j]] = [point, first, second];
        }
        let [position, by_u, by_uu] = across.each_mut().map(|points| de_casteljau(&mut points[..rows], v));
        SurfaceJet {
            point: position.point,
            du: by_u.point,
            dv: position.first,
            duu: by_uu.point,
            duv: by_u.first,
            dvv: position.second,
        }
    }

    /// The normal of length 1 at `u` and `v` in `[0, 1]`; zero where the surface has none.
    ///
    /// Where an edge is collapsed to a point, it is the limit on the way towards the middle of the surface.
    pub fn normal(&self, u: V::Scalar, v: V::Scalar) -> V {
        let half = V::Scalar::from_f64(0.5);
        self.at(u, v).normal([half - u, half - v])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    fn wavy() -> [DVec3; 12] {
        core::array::from_fn(|k| {
            let (i, j) = ((k % 4) as f64, (k / 4) as f64);
            DVec3::new(i + 0.2 * j, j - 0.1 * i * j, (1.3 * i + 2.1 * j).sin())
        })
    }

    #[test]
    fn corners_are_control_points_and_weights_sum_to_one() {
        let points = wavy();
        let surface = BezierSurface::new(&points, 4).unwrap();
        for (u, v, corner) in [(0.0, 0.0, 0), (1.0, 0.0, 3), (0.0, 1.0, 8), (1.0, 1.0, 11)] {
            assert_eq!(surface.at(u, v).point, points[corner]);
        }
        let moved = points.map(|point| point + DVec3::new(3.0, -2.0, 5.0));
        let moved = BezierSurface::new(&moved, 4).unwrap();
        let difference = moved.at(0.3, 0.8).point - surface.at(0.3, 0.8).point;
        assert!((difference - DVec3::new(3.0, -2.0, 5.0)).length() < 1e-13);
    }

    #[test]
    fn derivatives_are_limits_of_differences() {
        let points = wavy();
        let surface = BezierSurface::new(&points, 4).unwrap();
        let h = 1e-4;
        for (u, v) in [(0.2, 0.3), (0.9, 0.1), (0.5, 0.77)] {
            let jet = surface.at(u, v);
            let by_u =
                |of: fn(SurfaceJet<DVec3>) -> DVec3| (of(surface.at(u + h, v)) - of(surface.at(u - h, v))) / (2.0 * h);
            let by_v =
                |of: fn(SurfaceJet<DVec3>) -> DVec3| (of(surface.at(u, v + h)) - of(surface.at(u, v - h))) / (2.0 * h);
            for (exact, limit) in [
                (jet.du, by_u(|jet| jet.point)),
                (jet.dv, by_v(|jet| jet.point)),
                (jet.duu, by_u(|jet| jet.du)),
                (jet.duv, by_v(|jet| jet.du)),
                (jet.dvv, by_v(|jet| jet.dv)),
            ] {
                assert!((exact - limit).length() < 1e-6, "{exact} is not {limit}");
            }
        }
    }

    /// Control points of a plane give a plane, whatever the degree; the normal is that of the plane.
    #[test]
    fn a_plane_stays_a_plane() {
        let points: [Vec3; 20] = core::array::from_fn(|k| {
            let (x, y) = ((k % 5) as f32, (k / 5) as f32);
            Vec3::new(x + 0.1 * y * y, y, 0.5 * (x + 0.1 * y * y) - 2.0 * y + 1.0)
        });
        let surface = BezierSurface::new(&points, 5).unwrap();
        let normal = Vec3::new(-0.5, 2.0, 1.0).normalize();
        for step in 0..=10 {
            let (u, v) = (step as f32 / 10.0, (step * 7 % 11) as f32 / 10.0);
            assert!((surface.at(u, v).point - Vec3::Z).dot(normal).abs() < 1e-5);
            assert!(surface.normal(u, v).abs_diff_eq(normal, 1e-5));
        }
    }

    /// The paraboloid `z = x^2 + y^2` over the unit square, in Bernstein form: the blossom of `t^2` is `0, 0, 1`.
    #[test]
    fn a_paraboloid() {
        let square = [0.0, 0.0, 1.0];
        let points: [DVec3; 9] = core::array::from_fn(|k| {
            DVec3::new((k % 3) as f64 / 2.0, (k / 3) as f64 / 2.0, square[k % 3] + square[k / 3])
        });
        let surface = BezierSurface::new(&points, 3).unwrap();
        for (u, v) in [(0.0, 0.0), (0.25, 0.5), (0.8, 0.3), (1.0, 1.0)] {
            let point = surface.at(u, v).point;
            assert!((point - DVec3::new(u, v, u * u + v * v)).length() < 1e-14);
            assert!((surface.normal(u, v) - DVec3::new(-2.0 * u, -2.0 * v, 1.0).normalize()).length() < 1e-14);
        }
    }

    /// A dome whose last row is one point has the normal of its top there; on the first row likewise, turned over.
    #[test]
    fn collapsed_edges_have_normals() {
        let quarter = |height: f64, radius: f64| {
            [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(radius * x, radius * y, height))
        };
        let dome: [DVec3; 9] = [quarter(0.0, 1.0), quarter(1.0, 1.0), quarter(1.0, 0.0)].concat().try_into().unwrap();
        let bowl: [DVec3; 9] = [quarter(-1.0, 0.0), quarter(-1.0, 1.0), quarter(0.0, 1.0)].concat().try_into().unwrap();
        for u in [0.0, 0.3, 1.0] {
            let up = BezierSurface::new(&dome, 3).unwrap();
            assert!((up.normal(u, 1.0) - DVec3::Z).length() < 1e-12, "{}", up.normal(u, 1.0));
            assert!((up.normal(u, 1.0 - 1e-12) - DVec3::Z).length() < 1e-6);
            let down = BezierSurface::new(&bowl, 3).unwrap();
            assert!((down.normal(u, 0.0) + DVec3::Z).length() < 1e-12, "{}", down.normal(u, 0.0));
        }
        assert_eq!(BezierSurface::new(&[Vec3::ONE; 4], 2).unwrap().normal(0.5, 0.5), Vec3::ZERO);
    }

    #[test]
    fn errors_name_the_points() {
        assert_eq!(BezierSurface::<Vec3>::new(&[], 2), Err(SplineError::Empty));
        assert_eq!(BezierSurface::new(&[Vec3::ZERO; 4], 0), Err(SplineError::Empty));
        assert_eq!(BezierSurface::new(&[Vec3::ZERO; 5], 2), Err(SplineError::Ragged { points: 5, columns: 2 }));
        assert_eq!(BezierSurface::new(&[Vec3::ZERO; 34], 2), Err(SplineError::Degree { degree: 16 }));
        assert_eq!(BezierSurface::new(&[Vec3::INFINITY; 4], 2), Err(SplineError::NotFinite { index: 0 }));
    }
}
