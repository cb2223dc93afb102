//! The polar form of a piece of a B-spline: the tool that inserts knots, raises the degree and cuts out Bezier pieces.

use core::ops::{Add, Mul};

use super::bezier::MAX_ORDER;
use crate::math::Real;

/// The value of the multi-affine, symmetric function that is the polynomial of a piece where all arguments are equal.
///
/// `points` are the `p + 1` control points of the piece, `local` the `2 p` knots around it, and there are `p` arguments.
/// The construction of de Boor with another argument in each round: Ramshaw, "Blossoms are polar forms", 1989.
#[inline]
pub(super) fn blossom<P, R: Real>(points: &[P], local: &[R], arguments: impl Iterator<Item = R>) -> P
where
    P: Copy + Default + Add<Output = P> + Mul<R, Output = P>,
{
    let p = points.len() - 1;
    let mut left = [P::default(); MAX_ORDER];
    left[..=p].copy_from_slice(points);
    for (r, t) in arguments.take(p).enumerate() {
        for i in 0..p - r {
            let (low, high) = (local[i + r], local[i + p]);
            let share = (t - low) / (high - low);
            left[i] = left[i] * (R::ONE - share) + left[i + 1] * share;
        }
    }
    left[0]
}

/// The control points of the Bezier surface that is a part of a piece: `net` holds those of the piece, in rows, and gets
/// those of the part; `local` are the `2 p` knots around the piece in both directions, `part` is from where to where.
#[inline]
pub(super) fn cut_out<P, R: Real>(net: &mut [P], local: [&[R]; 2], part: [[R; 2]; 2])
where
    P: Copy + Default + Add<Output = P> + Mul<R, Output = P>,
{
    let [columns, rows] = local.map(|local| local.len() / 2 + 1);
    let arguments =
        |[from, to]: [R; 2], k: usize, count: usize| (1..count).map(move |i| if i <= k { to } else { from });
    let mut line = [P::default(); MAX_ORDER];
    for row in net.chunks_exact_mut(columns) {
        line[..columns].copy_from_slice(row);
        for (k, point) in row.iter_mut().enumerate() {
            *point = blossom(&line[..columns], local[0], arguments(part[0], k, columns));
        }
    }
    for i in 0..columns {
        (0..rows).for_each(|j| line[j] = net[j * columns + i]);
        (0..rows).for_each(|k| {
            net[k * columns + i] = blossom(&line[..rows], local[1], arguments(part[1], k, rows));
        });
    }
}
