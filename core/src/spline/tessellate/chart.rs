//! A surface as a chart of a lightmap: parameters scaled so that texels have the same size everywhere.

use alloc::vec;
use alloc::vec::Vec;

use crate::math::{Real, Vector, VectorSpace as _};
use crate::spline::{BSplineSurface, Direction, KnotVector, SurfacePoint};

/// What is the same for all texels of a surface, as far as each parameter alone can make it so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChartScale {
    /// The area of texels. It is exactly the same on a surface of revolution, an extrusion, a plane; towards a pole texels
    /// grow narrow and high.
    #[default]
    Area,
    /// Their width and their height, in the mean over a column or a row. Towards a pole texels grow narrow.
    Length,
}

/// Steps in a piece between knots.
const STEPS: usize = 8;
/// No column and no row is narrower than this share of the mean.
const LEAST: f64 = 1e-3;

/// Parameters to coordinates in `0..1`.
pub(super) struct Chart<R> {
    axes: [Axis<R>; 2],
}

/// One parameter.
struct Axis<R> {
    /// Parameters, at least two, increasing.
    at: Vec<R>,
    /// How fast the coordinate grows with the parameter there.
    density: Vec<R>,
    /// The coordinate there.
    coordinate: Vec<R>,
    /// Mean length in meters.
    length: R,
}

impl<R: Real> Chart<R> {
    pub fn new<P: SurfacePoint<Scalar = R>>(surface: &BSplineSurface<P>, scale: ChartScale) -> Self {
        let [us, vs] = [Direction::U, Direction::V].map(|direction| nodes(&surface.knots(direction)));
        let [by_u, by_v] = [weights(&us), weights(&vs)];
        let mut density = [vec![R::ZERO; us.len()], vec![R::ZERO; vs.len()]];
        let mut length = [R::ZERO; 2];
        for (j, &v) in vs.iter().enumerate() {
            for (i, &u) in us.iter().enumerate() {
                let [_, du, dv] = surface.tangents(u, v);
                let lengths = [du.length(), dv.length()];
                let sizes = match scale {
                    ChartScale::Area => [du.cross(dv).length(); 2],
                    ChartScale::Length => lengths,
                };
                density[0][i] += sizes[0] * by_v[j];
                density[1][j] += sizes[1] * by_u[i];
                length = [0, 1].map(|k| length[k] + lengths[k] * by_u[i] * by_v[j]);
            }
        }
        let [along_v, along_u] = [&vs, &us].map(|at| at[at.len() - 1] - at[0]);
        let [of_u, of_v] = density;
        Self { axes: [Axis::new(us, of_u, length[0] / along_v), Axis::new(vs, of_v, length[1] / along_u)] }
    }

    /// Mean width and height in meters.
    pub fn size(&self) -> [R; 2] {
        [0, 1].map(|k| self.axes[k].length)
    }

    /// Parameters so that the domain is `0..1`.
    pub fn linear(&self, uv: [R; 2]) -> [R; 2] {
        [0, 1].map(|k| {
            let at = &self.axes[k].at;
            ((uv[k] - at[0]) / (at[at.len() - 1] - at[0])).clamp(R::ZERO, R::ONE)
        })
    }

    /// Parameters as coordinates in the lightmap, in `0..1`.
    pub fn scaled(&self, uv: [R; 2]) -> [R; 2] {
        [0, 1].map(|k| self.axes[k].scaled(uv[k]))
    }

    /// The parameters whose coordinates in the lightmap lie in the middle between two others.
    ///
    /// A triangle cut there is cut by a straight line in the lightmap, so that none of its parts is turned over.
    pub fn middle(&self, a: [R; 2], b: [R; 2]) -> [R; 2] {
        [0, 1].map(|k| if a[k] == b[k] { a[k] } else { self.axes[k].middle(a[k], b[k]) })
    }
}

impl<R: Real> Axis<R> {
    fn new(at: Vec<R>, mut density: Vec<R>, length: R) -> Self {
        let half = R::from_f64(0.5);
        let step = |i: usize| at[i + 1] - at[i];
        let total =
            |density: &[R]| (1..at.len()).map(|i| (density[i - 1] + density[i]) * half * step(i - 1)).sum::<R>();
        let mean = total(&density) / (at[at.len() - 1] - at[0]);
        let least = if mean > R::ZERO { mean * R::from_f64(LEAST) } else { R::ONE };
        density.iter_mut().for_each(|density| *density = density.max(least));
        let whole = total(&density);
        density.iter_mut().for_each(|density| *density = *density / whole);
        let mut coordinate = vec![R::ZERO];
        for i in 1..at.len() {
            coordinate.push(coordinate[i - 1] + (density[i - 1] + density[i]) * half * step(i - 1));
        }
        Self { at, density, coordinate, length }
    }

    fn middle(&self, a: R, b: R) -> R {
        let half = (self.scaled(a) + self.scaled(b)) * R::from_f64(0.5);
        let last = self.at.len() - 2;
        let i = self.coordinate.partition_point(|&at| at <= half).saturating_sub(1).min(last);
        let ([low, high], past) = ([self.density[i], self.density[i + 1]], half - self.coordinate[i]);
        let slope = (high - low) / (self.at[i + 1] - self.at[i]);
        let root = (low * low + (slope + slope) * past).max(R::ZERO).sqrt();
        (self.at[i] + (past + past) / (low + root)).clamp(a.min(b), a.max(b))
    }

    /// The integral of the density, which is linear between nodes.
    fn scaled(&self, t: R) -> R {
        let last = self.at.len() - 2;
        let i = self.at.partition_point(|&at| at <= t).saturating_sub(1).min(last);
        let [low, high] = [self.density[i], self.density[i + 1]];
        let past = t - self.at[i];
        let share = past / (self.at[i + 1] - self.at[i]);
        let mean = low + (high - low) * share * R::from_f64(0.5);
        (self.coordinate[i] + mean * past).clamp(R::ZERO, R::ONE)
    }
}

/// Parameters at equal distances in each piece.
fn nodes<R: Real>(knots: &KnotVector<R>) -> Vec<R> {
    let [_, end] = knots.domain();
    let in_span = |span: usize| {
        let [low, high] = [knots.knots()[span], knots.knots()[span + 1]];
        (0..STEPS).map(move |k| low + (high - low) * R::from_usize(k) / R::from_usize(STEPS))
    };
    knots.spans().flat_map(in_span).chain([end]).collect()
}

/// How much of the domain each node stands for.
fn weights<R: Real>(at: &[R]) -> Vec<R> {
    let half = R::from_f64(0.5);
    let last = at.len() - 1;
    (0..=last).map(|i| (at[(i + 1).min(last)] - at[i.saturating_sub(1)]) * half).collect()
}
