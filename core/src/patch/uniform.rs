//! The uniform grid: all pieces alike, one after the other, without memory.

use super::{Element, Parameters, Patch};
use crate::math::{Real, Vector};

/// Cuts the patches of a shape into elements, `divisions` along `u` and `v`.
///
/// A quad or a spline gives `u x v` elements, a triangle `n x n` with the larger of both; zero counts as one. The
/// corners of neighbors have the same coordinates.
pub fn uniform<'a, V: Vector>(
    shape: usize,
    patches: &'a [Patch<'a, V>],
    divisions: [usize; 2],
) -> impl Iterator<Item = Element<V>> + 'a {
    patches.iter().enumerate().flat_map(move |(index, patch)| {
        let [columns, rows] = grid(patch, divisions);
        (0..columns * rows).map(move |cell| {
            let (places, sides) = cell_of(patch, [cell % columns, cell / columns], [columns, rows]);
            Element::new(shape, index, patch, places, sides)
        })
    })
}

/// How many cells the domain of a patch has in each direction.
fn grid<V: Vector>(patch: &Patch<V>, divisions: [usize; 2]) -> [usize; 2] {
    let [columns, rows] = divisions.map(|count| count.max(1));
    match patch {
        Patch::Triangle(_) => [columns.max(rows); 2],
        _ => [columns, rows],
    }
}

/// The corners of a cell. The cells of a square that lie beyond its diagonal are, in a triangle, those that stand on
/// their heads.
fn cell_of<V: Vector>(
    patch: &Patch<V>,
    [i, j]: [usize; 2],
    [columns, rows]: [usize; 2],
) -> ([Parameters<V>; 4], usize) {
    let share = |k: usize, count: usize| V::Scalar::from_usize(k) / V::Scalar::from_usize(count);
    let at = |i: usize, j: usize| [share(i, columns), share(j, rows)];
    match patch {
        Patch::Triangle(_) if i + j < columns => ([at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1)], 3),
        Patch::Triangle(_) => {
            let (i, j) = (columns - i, columns - j);
            ([at(i, j), at(i - 1, j), at(i, j - 1), at(i, j - 1)], 3)
        }
        _ => ([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], 4),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn a_grid_covers_its_patch() {
        let patches = [
            Patch::Triangle([DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.5, 1.0, 0.0)]),
            Patch::Quad([DVec3::ZERO, DVec3::X * 3.0, DVec3::new(2.0, 1.0, 0.0), DVec3::Y]),
        ];
        for (patch, count, area) in [(0, 9, 1.0), (1, 6, 2.5)] {
            let elements = || uniform(7, &patches[patch..=patch], [3, 2]);
            assert_eq!(elements().count(), count);
            assert!((elements().map(|element| element.area).sum::<f64>() - area).abs() < 1e-14);
            assert!(elements().all(|element| element.normal.dot(DVec3::Z) > 1.0 - 1e-14 && element.shape == 7));
        }
    }

    /// All pieces of a triangle are congruent to each other; each lies in the triangle.
    #[test]
    fn pieces_of_a_triangle_are_alike() {
        let triangle = [Patch::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y])];
        let pieces = || uniform(0, &triangle, [4, 4]);
        assert!(pieces().all(|piece| (piece.area - 0.5 / 16.0).abs() < 1e-6));
        let inside = |corner: &Vec3| corner.x >= 0.0 && corner.y >= 0.0 && corner.x + corner.y <= 1.0 + 1e-6;
        assert!(pieces().all(|piece| piece.corners().iter().all(inside)));
        let mean = pieces().map(|piece| piece.center).sum::<Vec3>() / 16.0;
        assert!(mean.abs_diff_eq(Vec3::new(1.0, 1.0, 0.0) / 3.0, 1e-6));
    }
}
