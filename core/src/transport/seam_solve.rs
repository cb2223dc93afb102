//! The least squares problem of seams, and conjugate gradients for it.
//!
//! Iwanicki, "Lighting Technology of The Last of Us", SIGGRAPH 2013.

use alloc::vec;
use alloc::vec::Vec;

use glam::{BVec3A, DVec3, Vec3A};

use super::Seams;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// What is left of the residual, as a share.
const TOLERANCE: f32 = 3e-3;
/// Iterations that are enough wherever texels lie side by side.
const MOST_ITERATIONS: usize = 60;
/// How often texels that would become negative are found.
const ROUNDS: usize = 3;
/// Rows that are worked on together.
const CHUNK: usize = 4096;
/// How much both sides of half a texel of a seam must agree, against all below.
const AGREEMENT: f32 = 4.0;
/// How stiff the light is across a border of a chart.
const BENDING: f32 = 0.05;
/// How firmly texels side by side change alike.
const FADING: f32 = 0.15;

/// The normal equations of the least squares problem of seams: `(S + B + L + H) x = (L + H) x0`.
///
/// `x0` is the light of touched texels before, `x` after. `S` asks that both sides of seams agree, `B` that the light
/// does not bend across borders of charts, `L` that what changes fades into the chart, and `H` that texels hold their
/// light. None of them depends on the light.
pub struct SeamSolver<'a> {
    seams: &'a Seams,
    /// Where in `entries` each row ends.
    ends: Vec<u32>,
    /// Columns and numbers of the matrix.
    entries: Vec<(u32, f32)>,
    /// 1 / diagonal.
    inverse: Vec<f32>,
}

/// What a texel is given during the iteration.
#[derive(Clone, Copy, Default)]
struct Unknown {
    light: Vec3A,
    residual: Vec3A,
    product: Vec3A,
    /// The channels that are held at zero.
    held: BVec3A,
}

impl Unknown {
    /// Zero in the channels that are held.
    fn free(&self, light: Vec3A) -> Vec3A {
        Vec3A::select(self.held, Vec3A::ZERO, light)
    }
}

impl<'a> SeamSolver<'a> {
    /// Sets up the matrix.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel.
    pub fn new(seams: &'a Seams, workers: &Workers, progress: &Progress) -> Result<Self, Cancelled> {
        let users = Users::new(seams);
        let rows = workers.map(seams.touched(), 1024, progress, |range| {
            range.map(|texel| users.row(seams, texel as u32)).collect()
        })?;
        let mut solver = Self { seams, ends: Vec::new(), entries: Vec::new(), inverse: Vec::new() };
        for (texel, row) in rows.iter().enumerate() {
            let diagonal = row.iter().find(|(column, _)| *column as usize == texel).map_or(1.0, |(_, number)| *number);
            solver.inverse.push(1.0 / diagonal);
            solver.entries.extend_from_slice(row);
            solver.ends.push(solver.entries.len() as u32);
        }
        Ok(solver)
    }

    /// Changes the light of touched texels so that the sides of seams agree; it stays non-negative.
    ///
    /// What would become negative is held at zero, and the others are solved anew. Returns the iterations.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel; the light is as it was.
    pub fn solve(&self, light: &mut [Vec3A], workers: &Workers, progress: &Progress) -> Result<usize, Cancelled> {
        let target = self.target(light);
        let mut unknowns: Vec<Unknown> = light.iter().map(|&light| Unknown { light, ..Default::default() }).collect();
        let (mut iterations, mut enough) = (0, DVec3::ZERO);
        for _ in 0..ROUNDS {
            iterations += self.iterate(&target, &mut unknowns, &mut enough, workers, progress)?;
            for unknown in &mut unknowns {
                unknown.held |= unknown.light.cmplt(Vec3A::ZERO);
                unknown.light = unknown.light.max(Vec3A::ZERO);
            }
        }
        light.iter_mut().zip(&unknowns).for_each(|(light, unknown)| *light = unknown.light);
        Ok(iterations)
    }

    /// The right side of the equations.
    fn target(&self, light: &[Vec3A]) -> Vec<Vec3A> {
        let mut target: Vec<Vec3A> = light.iter().zip(&self.seams.holds).map(|(light, hold)| light * *hold).collect();
        for &[a, b] in &self.seams.links {
            let [a, b] = [a as usize, b as usize];
            let pull = FADING * (light[a] - light[b]);
            target[a] += pull;
            target[b] -= pull;
        }
        target
    }

    /// Conjugate gradients with the diagonal as preconditioner, all channels at once; what is held stays. The residual that
    /// is small enough is a share of the largest at a start.
    fn iterate(
        &self,
        target: &[Vec3A],
        unknowns: &mut [Unknown],
        enough: &mut DVec3,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<usize, Cancelled> {
        let mut directions: Vec<Vec3A> = unknowns.iter().map(|unknown| unknown.light).collect();
        self.multiply(&directions, unknowns, workers, progress)?;
        for (texel, unknown) in unknowns.iter_mut().enumerate() {
            unknown.residual = unknown.free(target[texel] - unknown.product);
            directions[texel] = unknown.residual * self.inverse[texel];
        }
        let first = sum(unknowns.iter().zip(&directions).map(|(unknown, direction)| unknown.residual * direction));
        let (mut remaining, mut iterations) = (first, 0);
        *enough = enough.max(first * f64::from(TOLERANCE * TOLERANCE));
        while iterations < MOST_ITERATIONS && remaining.cmpgt(*enough).any() {
            let curvature = self.multiply(&directions, unknowns, workers, progress)?;
            let length = quotient(remaining, curvature);
            let after = self.advance(length, &directions, unknowns, workers, progress)?;
            let turn = quotient(after, remaining);
            workers.update(&mut directions, CHUNK, progress, |start, chunk| {
                for (texel, direction) in (start..).zip(chunk) {
                    *direction = unknowns[texel].residual * self.inverse[texel] + *direction * turn;
                }
            })?;
            (remaining, iterations) = (after, iterations + 1);
        }
        Ok(iterations)
    }

    /// The product of the matrix with `directions` into the unknowns; returns `directions` times it.
    fn multiply(
        &self,
        directions: &[Vec3A],
        unknowns: &mut [Unknown],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<DVec3, Cancelled> {
        let parts = workers.update(unknowns, CHUNK, progress, |start, chunk| {
            let mut entry = start.checked_sub(1).map_or(0, |before| self.ends[before] as usize);
            sum((start..).zip(chunk).map(|(texel, unknown)| {
                let end = self.ends[texel] as usize;
                let row = self.entries[entry..end].iter();
                let product = row.map(|&(column, number)| directions[column as usize] * number).sum();
                unknown.product = unknown.free(product);
                entry = end;
                unknown.product * directions[texel]
            }))
        })?;
        Ok(parts.into_iter().sum())
    }

    /// Goes so far along `directions`; returns the residual times the preconditioned residual.
    fn advance(
        &self,
        length: Vec3A,
        directions: &[Vec3A],
        unknowns: &mut [Unknown],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<DVec3, Cancelled> {
        let parts = workers.update(unknowns, CHUNK, progress, |start, chunk| {
            sum((start..).zip(chunk).map(|(texel, unknown)| {
                unknown.light += length * directions[texel];
                unknown.residual -= length * unknown.product;
                unknown.residual * unknown.residual * self.inverse[texel]
            }))
        })?;
        Ok(parts.into_iter().sum())
    }
}

fn sum(numbers: impl Iterator<Item = Vec3A>) -> DVec3 {
    numbers.map(|number| number.as_dvec3()).sum()
}

/// Zero where a channel has come to its end.
fn quotient(above: DVec3, below: DVec3) -> Vec3A {
    DVec3::select(below.cmpgt(DVec3::ZERO), above / below, DVec3::ZERO).as_vec3a()
}

/// For each touched texel the points, the rows and the links that use it.
struct Users {
    points: Lists,
    rows: Lists,
    links: Lists,
}

impl Users {
    fn new(seams: &Seams) -> Self {
        let of_points = |point: usize| seams.points[point].difference().map(|(texel, _)| texel);
        Self {
            points: Lists::new(seams.touched(), seams.points.len(), of_points),
            rows: Lists::new(seams.touched(), seams.rows.len(), |row| seams.rows[row]),
            links: Lists::new(seams.touched(), seams.links.len(), |link| seams.links[link]),
        }
    }

    /// A row of the matrix, in the order of the columns.
    fn row(&self, seams: &Seams, texel: u32) -> Vec<(u32, f32)> {
        let mut row = vec![(texel, seams.holds[texel as usize])];
        for &point in self.points.of(texel) {
            let point = &seams.points[point as usize];
            add_square(&mut row, texel, &point.difference(), AGREEMENT * point.weight);
        }
        for &index in self.rows.of(texel) {
            let [outside, border, inside] = seams.rows[index as usize];
            add_square(&mut row, texel, &[(outside, 1.0), (border, -2.0), (inside, 1.0)], BENDING);
        }
        for &link in self.links.of(texel) {
            let [a, b] = seams.links[link as usize];
            add_square(&mut row, texel, &[(a, 1.0), (b, -1.0)], FADING);
        }
        row.sort_by_key(|&(column, _)| column);
        row.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            kept.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
        row
    }
}

/// Adds what the square of a sum of texels gives to a row of the normal equations.
fn add_square(row: &mut Vec<(u32, f32)>, texel: u32, terms: &[(u32, f32)], weight: f32) {
    let own: f32 = terms.iter().filter(|(other, _)| *other == texel).map(|(_, factor)| factor).sum();
    let numbers = terms.iter().map(|&(other, factor)| (other, weight * own * factor));
    row.extend(numbers.filter(|(_, number)| *number != 0.0));
}

/// Lists of users, one after the other.
struct Lists {
    ends: Vec<u32>,
    users: Vec<u32>,
}

impl Lists {
    fn new<const N: usize>(count: usize, users: usize, used: impl Fn(usize) -> [u32; N]) -> Self {
        let mut pairs: Vec<(u32, u32)> =
            (0..users).flat_map(|user| used(user).map(|texel| (texel, user as u32))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut ends = vec![0; count];
        pairs.iter().for_each(|&(texel, _)| ends[texel as usize] += 1);
        let mut end = 0;
        for number in &mut ends {
            end += *number;
            *number = end;
        }
        Self { ends, users: pairs.into_iter().map(|(_, user)| user).collect() }
    }

    fn of(&self, texel: u32) -> &[u32] {
        let start = if texel == 0 { 0 } else { self.ends[texel as usize - 1] };
        &self.users[start as usize..self.ends[texel as usize] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::{Sample, SeamPoint};

    /// Two charts of two rows of four texels that meet along their long sides, with no gutters.
    fn strips() -> Seams {
        let side = |upper: u32| Sample { upper, lower: upper + 4, right: 0.5, down: 0.5 };
        let point = |k: u32| SeamPoint { sides: [side(k), side(8 + k)], weight: 1.0 };
        Seams {
            texels: vec![(0..16).collect()],
            holds: vec![0.02; 16],
            points: (0..3).map(point).collect(),
            rows: Vec::new(),
            links: (0..3).flat_map(|k| [0, 4, 8, 12].map(|row| [row + k, row + k + 1])).collect(),
        }
    }

    fn solved(seams: &Seams, light: impl Fn(usize) -> f32) -> Vec<f32> {
        let (workers, progress) = (Workers::new(1), Progress::with_clock(|| 0.0));
        let mut touched: Vec<Vec3A> = (0..16).map(|texel| Vec3A::splat(light(texel))).collect();
        let solver = SeamSolver::new(seams, &workers, &progress).unwrap();
        solver.solve(&mut touched, &workers, &progress).unwrap();
        touched.into_iter().map(|light| light.x).collect()
    }

    /// What is the same everywhere stays, but for rounding.
    #[test]
    fn without_a_step_nothing_changes() {
        let light = solved(&strips(), |_| 0.75);
        assert!(light.iter().all(|light| (light - 0.75).abs() < 1e-5), "{light:?}");
    }

    /// Both sides come to the middle where they hold alike, and the one that holds less gives way where not.
    #[test]
    fn sides_agree() {
        let mut seams = strips();
        let light = solved(&seams, |texel| if texel < 8 { 1.0 } else { 2.0 });
        assert!(light.iter().all(|light| (light - 1.5).abs() < 0.02), "{light:?}");
        seams.holds[8..].fill(2e-5);
        let light = solved(&seams, |texel| if texel < 8 { 1.0 } else { 2.0 });
        assert!(light.iter().all(|light| (light - 1.0).abs() < 0.02), "{light:?}");
    }

    /// A side that would have to become negative stays at zero, and the other comes to it.
    #[test]
    fn no_light_is_negative() {
        let mut seams = strips();
        seams.links.clear();
        let light = solved(&seams, |texel| if texel == 9 { 10.0 } else { 0.0 });
        assert!(light.iter().all(|light| *light >= 0.0) && light[9] > 1.0, "{light:?}");
    }
}
