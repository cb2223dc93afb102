//! Polygon to polygon with visibility: the double integral of the point formula times `s(p, q)`, which is 1 where `p`
//! sees `q` and 0 elsewhere. The inner integral is exact, the outer one adaptive and split where the view changes.

use crate::math::{Real, Vector};

use super::critical::{Critical, longest};
use super::cubature::halves;
use super::shadow::{Fan, area_vector, cut, fans, seen};
use super::shaft::Shaft;
use super::triangle_rule::{Means, means};
use super::{Estimate, polygon_to_polygon};

/// Triangles that wait; each split adds two at most.
const WAITING: usize = 64;
/// Triangles after which no more are split.
pub(super) const MOST_CELLS: usize = 1 << 16;
/// Blockers of one triangle; where more are in the way, all are asked.
const NEAR_BLOCKERS: usize = 32;
/// A triangle may err by this share of the accuracy, however small it is.
const LEAST_SHARE: f64 = 1.0 / 256.0;
/// A triangle in which the view changes is split in any case while it sends more than this many times the accuracy, so
/// that no shadow is missed between the points of the rules.
const HEAVY: f64 = 64.0;
/// What a kink in a triangle may change of the mean of 16 points, as a share of the range of the integrand.
const KINK: f64 = 0.004;

/// Share of the power leaving `a` that lands on `b` past convex planar `blockers`, with an estimate of its error.
///
/// Both are convex, run counter-clockwise seen from their fronts and exchange light there only; a blocker stops light
/// from both sides. `accuracy` is the absolute error to aim for, at least a few units in the last place of 1. In
/// `[0, 1]`; 0 where a polygon has no area. `F_ab = 1/A_a int F_p->b dA` over the points `p` of `a`, with the exact
/// factor of [`visible_point_to_polygon`](super::visible_point_to_polygon) inside; or the same with `a` and `b`
/// exchanged, whichever changes less from point to point. The outer polygon is cut into triangles along the critical
/// lines on which the view changes its form, and these are bisected until two rules agree. After 65536 triangles the
/// rest is left as it is, and the error says so. Time grows with the square of the number of blockers that stand between
/// the same parts of `a` and `b`; [`polygon_to_polygon_among`](super::polygon_to_polygon_among) takes rays where they are
/// many. Measured in `f64`: 40 kB of stack, and 10 kB more for each halving of `b` down to its smallest visible piece, at
/// most 41 of them.
pub fn visible_polygon_to_polygon<V: Vector>(
    a: &[V],
    b: &[V],
    blockers: &[&[V]],
    accuracy: V::Scalar,
) -> Estimate<V::Scalar> {
    within(a, b, blockers, accuracy, MOST_CELLS)
}

/// [`visible_polygon_to_polygon`] with another bound on the number of triangles.
pub(super) fn within<V: Vector>(
    a: &[V],
    b: &[V],
    blockers: &[&[V]],
    accuracy: V::Scalar,
    most_cells: usize,
) -> Estimate<V::Scalar> {
    let [area_a, area_b] = [a, b].map(|polygon| area_vector(polygon.iter().copied()).length());
    if !(area_a > V::Scalar::ZERO && area_b > V::Scalar::ZERO) {
        return Estimate::default();
    }
    let ratio = area_b / area_a;
    if is_smoother(a, area_a, b, area_b, blockers) {
        let found = integral(a, b, blockers, accuracy, most_cells);
        return Estimate { value: found.value.min(V::Scalar::ONE), ..found };
    }
    let reverse = integral(b, a, blockers, accuracy / ratio, most_cells);
    Estimate { value: (reverse.value * ratio).min(V::Scalar::ONE), error: reverse.error * ratio }
}

/// Whether what points of `a` see changes less than what points of `b` see: shadows on what is small and far from the
/// blockers are soft.
fn is_smoother<V: Vector>(a: &[V], area_a: V::Scalar, b: &[V], area_b: V::Scalar, blockers: &[&[V]]) -> bool {
    let shaft = Shaft::new(a, b);
    let near = || blockers.iter().flat_map(|blocker| fans(blocker)).filter(|blocker| shaft.meets(blocker));
    let heights = [a, b].map(|polygon| {
        let normal = area_vector(polygon.iter().copied()).normalize_or_zero();
        near().flat_map(|blocker| blocker.corners()).map(|corner| normal.dot(corner - polygon[0]).abs()).sum()
    });
    let [height_a, height_b]: [V::Scalar; 2] = if near().next().is_some() { heights } else { [V::Scalar::ONE; 2] };
    height_a * height_a * area_b >= height_b * height_b * area_a
}

/// The mean over the points of `a` of what they see of `b`; both have an area.
fn integral<V: Vector>(
    a: &[V],
    b: &[V],
    blockers: &[&[V]],
    accuracy: V::Scalar,
    most_cells: usize,
) -> Estimate<V::Scalar> {
    let [normal_a, normal_b] = [a, b].map(|polygon| area_vector(polygon.iter().copied()));
    let area = normal_a.length();
    let accuracy = accuracy.max(V::Scalar::from_f64(8.0) * V::Scalar::EPSILON);
    let mut integral = Integral { normal: normal_a / area, area, b, blockers, accuracy, cells: 0, most_cells };
    let mut sum = Estimate::default();
    for i in 2..a.len() {
        let corners = [a[0], a[i - 1], a[i]].map(|corner| corner - b[0]);
        let front = cut(&corners, normal_b.normalize_or_zero(), V::Scalar::EPSILON * area.sqrt());
        for j in 2..front.len() {
            let part = integral.over([front[0], front[j - 1], front[j]].map(|corner| corner + b[0]));
            sum.value += part.value;
            sum.error += part.error;
        }
    }
    sum
}

/// The integral over `a` of what its points see of `b`.
struct Integral<'a, V: Vector> {
    /// Of `a`, of length 1.
    normal: V,
    /// Twice that of `a`.
    area: V::Scalar,
    b: &'a [V],
    blockers: &'a [&'a [V]],
    accuracy: V::Scalar,
    /// How many triangles have been looked at.
    cells: usize,
    /// How many may be.
    most_cells: usize,
}

/// What is to be done with a triangle.
enum Step<V: Vector> {
    Add(Estimate<V::Scalar>),
    Split(heapless::Vec<[V; 3], 3>),
}

impl<'a, V: Vector> Integral<'a, V> {
    /// The part of one triangle of `a`.
    fn over(&mut self, triangle: [V; 3]) -> Estimate<V::Scalar> {
        let mut waiting: heapless::Vec<[V; 3], WAITING> = heapless::Vec::new();
        let mut sum = Estimate::default();
        let _ = waiting.push(triangle);
        while let Some(cell) = waiting.pop() {
            self.cells += 1;
            let may_split = waiting.len() + 3 < WAITING && self.cells + waiting.len() < self.most_cells;
            let all = self.blockers.iter().flat_map(|blocker| fans(blocker));
            let step = match near(&Shaft::new(&cell, self.b), all.clone()) {
                Ok(near) => self.step(&cell, near.iter().copied(), may_split),
                Err(_) => self.step(&cell, all, may_split),
            };
            match step {
                Step::Add(part) => {
                    sum.value += part.value;
                    sum.error += part.error;
                }
                Step::Split(parts) => parts.into_iter().for_each(|part| {
                    let _ = waiting.push(part);
                }),
            }
        }
        sum
    }

    /// Splits a triangle along a critical line or where the rules differ; otherwise the rules hold.
    fn step(&self, cell: &[V; 3], blockers: impl Iterator<Item = Fan<'a, V>> + Clone, may_split: bool) -> Step<V> {
        let share = area_vector(cell.iter().copied()).length() / self.area;
        if blockers.clone().next().is_none() {
            let value = share * polygon_to_polygon(cell, self.b);
            return Step::Add(Estimate { value, error: share * contour_error() });
        }
        let critical = longest(cell, fans(self.b), blockers.clone());
        let center = cell[0].lerp(cell[1].lerp(cell[2], V::Scalar::from_f64(0.5)), V::Scalar::from_f64(2.0 / 3.0));
        let weight = share * seen(center, self.normal, self.b, core::iter::empty());
        let apart = |critical: Option<Critical<V>>| {
            critical.map_or_else(|| heapless::Vec::from_iter(halves(cell)), |at| split(cell, &at))
        };
        if critical.is_some() && weight > self.accuracy * V::Scalar::from_f64(HEAVY) && may_split {
            return Step::Split(apart(critical));
        }
        let found = means(cell, |point| seen(point, self.normal, self.b, blockers.clone()));
        let error = share * error_of(&found, critical.is_some(), blockers.clone().nth(1).is_some());
        let is_settled = error <= self.accuracy * share.max(V::Scalar::from_f64(LEAST_SHARE));
        if is_settled || !may_split {
            // Where work ended too soon a shadow may have been missed.
            let missed = if is_settled { V::Scalar::ZERO } else { weight };
            return Step::Add(Estimate { value: share * found.fine, error: error + missed });
        }
        Step::Split(apart(critical))
    }
}

/// The blockers in a shaft, unless there are too many.
fn near<'a, V: Vector>(
    shaft: &Shaft<V>,
    mut blockers: impl Iterator<Item = Fan<'a, V>>,
) -> Result<heapless::Vec<Fan<'a, V>, NEAR_BLOCKERS>, Fan<'a, V>> {
    blockers.try_fold(heapless::Vec::new(), |mut near, blocker| {
        if shaft.meets(&blocker) {
            near.push(blocker)?;
        }
        Ok(near)
    })
}

/// That of [`polygon_to_polygon`].
pub(super) fn contour_error<R: Real>() -> R {
    R::EPSILON.max(R::from_f64(1e-12))
}

/// The error of the finer rule. Where the integrand has no kinks it is far below the difference of the rules, in which
/// the coarser one dominates: `|difference|^1.5` as in QUADPACK (Piessens et al. 1983), with a more careful constant.
/// Where it has kinks the difference is a matter of luck, and a share of the range is safer. Several blockers may meet
/// on curves that are not known, but seldom.
fn error_of<R: Real>(found: &Means<R>, is_critical: bool, are_several: bool) -> R {
    let difference = (found.fine - found.coarse).abs();
    let relative = R::from_f64(1000.0) * difference / found.fine.abs();
    if is_critical {
        return difference.max(found.range * R::from_f64(KINK));
    }
    match are_several {
        false if relative < R::ONE => difference * relative.sqrt(),
        false => difference,
        true => R::from_f64(3.0) * difference,
    }
}

/// The triangles on both sides of a plane.
fn split<V: Vector>(cell: &[V; 3], critical: &Critical<V>) -> heapless::Vec<[V; 3], 3> {
    let corners = cell.map(|corner| corner - critical.point);
    let sides = [critical.normal, -critical.normal].map(|normal| cut(&corners, normal, V::Scalar::ZERO));
    let mut parts = heapless::Vec::new();
    for side in &sides {
        for i in 2..side.len() {
            let part = [side[0], side[i - 1], side[i]].map(|corner| corner + critical.point);
            let _ = parts.push(part);
        }
    }
    parts
}
