//! Rows that sum to one.

use super::{Matrix, MatrixError, check_length, enforce_reciprocity, is_share};
use crate::form_factor::Bins;
use crate::math::Real;

/// Sweeps after which a scaling that does not settle is given up.
const MOST_SWEEPS: usize = 1000;

/// How far the rows of a matrix are from one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Closure<R> {
    /// The row that is farthest off.
    pub row: usize,
    /// `|1 - sum|` of that row with its bins.
    pub error: R,
}

/// What a repair did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Repair<R> {
    /// The closure before, with reciprocity enforced.
    pub before: Closure<R>,
    /// The closure now.
    pub after: Closure<R>,
    /// The largest change of any form factor, relative to itself, that the scaling made.
    pub largest_change: R,
    /// Sweeps over all rows that it took.
    pub sweeps: usize,
}

/// The row that is farthest from summing to one with its sky and its void.
///
/// # Errors
///
/// Where there is not one pair of bins for each row.
pub fn closure<M: Matrix>(matrix: &M, bins: &[Bins<M::Scalar>]) -> Result<Closure<M::Scalar>, MatrixError> {
    check_length("bins", bins.len(), matrix.count())?;
    let errors = bins.iter().enumerate().map(|(row, bins)| {
        let error = (M::Scalar::ONE - (matrix.row_sum(row) + bins.sky + bins.void)).abs();
        Closure { row, error }
    });
    Ok(errors.fold(Closure::default(), |worst, next| if next.error > worst.error { next } else { worst }))
}

/// Makes all rows sum to one with their bins while `A_i F_ij = A_j F_ji` holds, by scaling.
///
/// Reciprocity is enforced first. Then each patch gets one number `d_i > 0`: its form factors become `d_i F_ij d_j`, its
/// bins `d_i` times themselves. This is the symmetric form of Sinkhorn's scaling: it keeps the factors as near to what
/// they were, in relative entropy, as the two laws allow, keeps zeros zero and signs positive. The numbers are those of
/// the lowest point of `sum_ij A_i F_ij d_i d_j / 2 + sum_i A_i (bins_i d_i - ln d_i)`, convex in their logarithms, and
/// are found one coordinate after the other. In an open scene the bins are estimates like the factors, so they are scaled
/// too; bins of zero stay zero, so that a closed enclosure stays closed.
///
/// Sinkhorn and Knopp, Pacific J. Math. 1967; Knight, Ruiz and Ucar, SIAM J. Matrix Anal. 2014. `scales` has one entry
/// for each row and holds the `d_i` at the end. Rows close to a few roundings: below 1e-12 in double precision.
///
/// # Errors
///
/// Where areas, factors, bins or lengths are unsuitable, or where no scaling closes the rows: a patch that sees nothing
/// but a smaller one, without any sky. The matrix then has its reciprocity enforced and is not scaled.
pub fn repair_closure<M: Matrix>(
    areas: &[M::Scalar],
    matrix: &mut M,
    bins: &mut [Bins<M::Scalar>],
    scales: &mut [M::Scalar],
) -> Result<Repair<M::Scalar>, MatrixError> {
    check_bins(bins)?;
    check_length("scales", scales.len(), matrix.count())?;
    check_length("bins", bins.len(), matrix.count())?;
    enforce_reciprocity(areas, matrix)?;
    let before = closure(matrix, bins)?;
    scales.fill(M::Scalar::ONE);
    let sweeps = settle(matrix, bins, scales)?;
    let largest_change = scale(areas, matrix, scales);
    for (bins, &scale) in bins.iter_mut().zip(&*scales) {
        *bins = Bins { sky: bins.sky * scale, void: bins.void * scale };
    }
    Ok(Repair { before, after: closure(matrix, bins)?, largest_change, sweeps })
}

fn check_bins<R: Real>(bins: &[Bins<R>]) -> Result<(), MatrixError> {
    match bins.iter().position(|bins| !is_share(bins.sky) || !is_share(bins.void)) {
        Some(row) => Err(MatrixError::Bin { row }),
        None => Ok(()),
    }
}

/// Sweeps over the rows until all sum to one; tells how many sweeps it took.
fn settle<M: Matrix>(matrix: &M, bins: &[Bins<M::Scalar>], scales: &mut [M::Scalar]) -> Result<usize, MatrixError> {
    let tolerance = M::Scalar::EPSILON * M::Scalar::from_usize(16 + matrix.count());
    let mut worst = Closure::default();
    for sweep in 0..MOST_SWEEPS {
        worst = Closure::default();
        for row in 0..matrix.count() {
            let error = balance(matrix, &bins[row], scales, row);
            if error > worst.error {
                worst = Closure { row, error };
            }
            if scales[row] == M::Scalar::INFINITY {
                return Err(MatrixError::NotClosed { row, error: error.to_f64() });
            }
        }
        if worst.error <= tolerance {
            return Ok(sweep + 1);
        }
    }
    Err(MatrixError::NotClosed { row: worst.row, error: worst.error.to_f64() })
}

/// Scales one row so that it sums to one: `F_ii d^2 + (sum of the others) d = 1`. Tells by how much it did not.
fn balance<M: Matrix>(matrix: &M, bins: &Bins<M::Scalar>, scales: &mut [M::Scalar], i: usize) -> M::Scalar {
    let (mut own, mut others) = (M::Scalar::ZERO, bins.sky + bins.void);
    for k in 0..matrix.width(i) {
        let (j, factor) = matrix.entry(i, k);
        if i == j {
            own = factor;
        } else {
            others += factor * scales[j];
        }
    }
    let error = (M::Scalar::ONE - scales[i] * (others + own * scales[i])).abs();
    let [two, four] = [2.0, 4.0].map(M::Scalar::from_f64);
    scales[i] = two / (others + (others * others + four * own).sqrt());
    error
}

/// Applies the scales, each pair once so that reciprocity holds to rounding; tells the largest relative change.
fn scale<M: Matrix>(areas: &[M::Scalar], matrix: &mut M, scales: &[M::Scalar]) -> M::Scalar {
    let mut largest = M::Scalar::ZERO;
    for i in 0..matrix.count() {
        for k in 0..matrix.width(i) {
            let (j, factor) = matrix.entry(i, k);
            if j < i {
                continue;
            }
            let change = scales[i] * scales[j];
            matrix.set(i, k, factor * change);
            if let Some(back) = matrix.find(j, i).filter(|_| j != i) {
                matrix.set(j, back, factor * change * areas[i] / areas[j]);
            }
            if factor > M::Scalar::ZERO {
                largest = largest.max((change - M::Scalar::ONE).abs());
            }
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::{DenseRows, SparseRows, fill_dense, fill_sparse, reciprocity_error};
    use super::*;
    use crate::form_factor::nusselt_area;
    use crate::geometry::Sobol;

    const CLOSED: [Bins<f64>; 6] = [Bins { sky: 0.0, void: 0.0 }; 6];

    /// The faces of a box from the origin, counter-clockwise from inside: opposite ones follow each other.
    fn faces(size: DVec3) -> [[DVec3; 4]; 6] {
        core::array::from_fn(|face| {
            let (axis, high) = (face / 2, (face % 2) as f64);
            let order = if face % 2 == 0 { [0, 1, 2, 3] } else { [0, 3, 2, 1] };
            order.map(|k| {
                let mut corner = [0.0; 3];
                corner[axis] = high;
                corner[(axis + 1) % 3] = f64::from(k == 1 || k == 2);
                corner[(axis + 2) % 3] = f64::from(k >= 2);
                DVec3::from_array(corner) * size
            })
        })
    }

    /// The form factor from face `i` to `j` by 12 x 12 points, with an error of a few thousandths.
    fn factor([a, b, c, d]: [DVec3; 4], to: &[DVec3]) -> f64 {
        let normal = (b - a).cross(d - a).normalize();
        let points = (0..144).map(|k| [k % 12, k / 12].map(|k| (f64::from(k) + 0.5) / 12.0));
        points.map(|[x, y]| nusselt_area(a.lerp(b, x).lerp(d.lerp(c, x), y), normal, to)).sum::<f64>() / 144.0
    }

    fn noise(seed: u32, index: usize) -> f64 {
        f64::from(Sobol::new(seed).dimension(index as u32, 1)) * 2.0 - 1.0
    }

    fn assert_repaired(areas: &[f64; 6], factors: &mut [f64; 36]) -> Repair<f64> {
        let mut rows = DenseRows::new(6, factors).unwrap();
        let mut bins = CLOSED;
        let repair = repair_closure(areas, &mut rows, &mut bins, &mut [0.0; 6]).unwrap();
        assert!(repair.after.error < 1e-12 && closure(&rows, &bins).unwrap() == repair.after, "{repair:?}");
        assert!(reciprocity_error(areas, &rows).unwrap() < 1e-12);
        assert_eq!(bins, CLOSED);
        repair
    }

    /// Boxes of any shape, their factors off by up to 10 % each in its own direction: both laws hold afterwards, and the
    /// factors are nearer to the truth than before.
    #[test]
    fn boxes_are_repaired() {
        for seed in 0..8 {
            let size = Sobol::new(seed).square(1).extend(0.4).as_dvec3() * 3.0 + DVec3::splat(0.3);
            let faces = faces(size);
            let areas = faces.map(|[a, b, _, d]| (b - a).cross(d - a).length());
            let mut exact = core::array::from_fn(|k| factor(faces[k / 6], &faces[k % 6]));
            assert!(assert_repaired(&areas, &mut exact).before.error < 0.02);
            let mut factors: [f64; 36] = core::array::from_fn(|k| exact[k] * (1.0 + 0.1 * noise(seed, k)));
            let distance =
                |factors: &[f64]| -> f64 { factors.iter().zip(&exact).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() };
            let noisy = distance(&factors);
            let repair = assert_repaired(&areas, &mut factors);
            assert!(repair.sweeps < 60 && repair.largest_change < 0.3, "{repair:?}");
            assert!(distance(&factors) < 0.7 * noisy, "{} {noisy}", distance(&factors));
        }
    }

    /// In a tetrahedron and a cube nothing but 1/3, and 0.19982 and 0.20004, obeys both laws and the symmetry.
    #[test]
    fn symmetric_bodies_find_their_factors() {
        let mut tetrahedron = [0.0; 16];
        let mut rows = DenseRows::new(4, &mut tetrahedron).unwrap();
        fill_dense(&[0.5; 4], &mut rows, |_, _| 0.2).unwrap();
        let mut bins = CLOSED;
        repair_closure(&[0.5; 4], &mut rows, &mut bins[..4], &mut [0.0; 4]).unwrap();
        (0..4).for_each(|i| (0..4).for_each(|j| assert!(i == j || (rows.row(i)[j] - 1.0 / 3.0).abs() < 1e-15)));
        let mut cube: [f64; 36] = core::array::from_fn(|k| match (k / 6, k % 6) {
            (i, j) if i == j => 0.0,
            (i, j) if i / 2 == j / 2 => 0.199_824_895_7 * 1.1,
            _ => 0.200_043_776_1 * 1.1,
        });
        assert_repaired(&[1.0; 6], &mut cube);
        assert!((cube[1] - 0.199_824_895_7).abs() < 1e-10 && (cube[2] - 0.200_043_776_1).abs() < 1e-10);
    }

    /// Without its lid a box keeps its sky: rows close with their bins, which move as the factors do.
    #[test]
    fn open_scenes_close_with_their_bins() {
        let faces = faces(DVec3::new(1.0, 2.0, 0.7));
        let areas: [f64; 5] =
            core::array::from_fn(|k| (faces[k][1] - faces[k][0]).cross(faces[k][3] - faces[k][0]).length());
        let mut factors: [f64; 25] =
            core::array::from_fn(|k| factor(faces[k / 5], &faces[k % 5]) * (1.0 + 0.05 * noise(3, k)));
        let mut bins: [Bins<f64>; 5] = core::array::from_fn(|i| Bins { sky: factor(faces[i], &faces[5]), void: 0.0 });
        let mut rows = DenseRows::new(5, &mut factors).unwrap();
        let repair = repair_closure(&areas, &mut rows, &mut bins, &mut [0.0; 5]).unwrap();
        assert!(repair.before.error > 1e-3 && repair.after.error < 1e-12, "{repair:?}");
        assert!(reciprocity_error(&areas, &rows).unwrap() < 1e-12);
        assert!(bins.iter().enumerate().all(|(i, bins)| (bins.sky / factor(faces[i], &faces[5]) - 1.0).abs() < 0.1));
    }

    /// Sparse rows are repaired to the same numbers as dense ones, in single precision to its own rounding.
    #[test]
    fn sparse_is_dense_without_zeros() {
        let areas = [1.0_f32, 1.0, 2.0, 2.0, 0.5, 0.5];
        let pair = |i: usize, j: usize| if i / 2 == j / 2 { 0.0 } else { 0.2 + 0.01 * (i + j) as f32 / areas[i] };
        let (mut starts, mut columns, mut sparse) = ([0; 7], [0; 24], [0.0; 24]);
        assert_eq!(fill_sparse(&areas, &mut starts, &mut columns, &mut sparse, pair), Ok(24));
        let mut dense = [0.0; 36];
        let mut all = DenseRows::new(6, &mut dense).unwrap();
        fill_dense(&areas, &mut all, pair).unwrap();
        let mut bins = [[Bins { sky: 0.01, void: 0.02_f32 }; 6]; 2];
        let mut seen = SparseRows::new(&starts, &columns, &mut sparse).unwrap();
        let repair = repair_closure(&areas, &mut all, &mut bins[0], &mut [0.0; 6]).unwrap();
        assert_eq!(repair_closure(&areas, &mut seen, &mut bins[1], &mut [0.0; 6]).unwrap(), repair);
        assert!(repair.after.error < 4e-6 && bins[0] == bins[1]);
        for i in 0..6 {
            let (columns, factors) = seen.row(i);
            columns.iter().zip(factors).for_each(|(&j, &factor)| assert_eq!(factor, all.row(i)[j as usize]));
        }
    }

    #[test]
    fn errors_name_the_place() {
        let mut bins = CLOSED;
        let mut repair = |areas: &[f64], factors: &mut [f64]| {
            let mut rows = DenseRows::new(areas.len(), factors)?;
            repair_closure(areas, &mut rows, &mut bins[..areas.len()], &mut [0.0; 6][..areas.len()]).map(|_| ())
        };
        assert_eq!(repair(&[1.0, -1.0], &mut [0.0; 4]), Err(MatrixError::Area { index: 1 }));
        assert_eq!(repair(&[1.0, f64::NAN], &mut [0.0; 4]), Err(MatrixError::Area { index: 1 }));
        assert_eq!(repair(&[1.0; 2], &mut [0.0, 1.0, -0.1, 0.0]), Err(MatrixError::Factor { row: 1, column: 0 }));
        let length = MatrixError::Length { what: "factors", length: 3, expected: 4 };
        assert_eq!(repair(&[1.0; 2], &mut [0.0; 3]), Err(length));
        assert_eq!(repair(&[1.0; 2], &mut [0.0; 4]), Err(MatrixError::NotClosed { row: 0, error: 1.0 }));
        let alone = repair(&[1.0, 2.0], &mut [0.0, 0.9, 0.45, 0.0]);
        assert!(matches!(alone, Err(MatrixError::NotClosed { .. })), "a patch that sees a smaller one only: {alone:?}");
        assert_eq!(repair(&[1.0; 2], &mut [0.0, 0.9, 0.9, 0.0]), Ok(()));
        let order = SparseRows::new(&[0, 2, 2], &[1, 0], &mut [0.1, 0.2]).err();
        assert_eq!(order, Some(MatrixError::Order { row: 0 }));
        let full = fill_sparse(&[1.0; 2], &mut [0; 3], &mut [0], &mut [0.0], |_, _| 0.5);
        assert_eq!(full, Err(MatrixError::Full { row: 1, capacity: 1 }));
    }
}
