//! Light between things that nearly touch, texel by texel instead of patch by patch.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3A;

use super::{Lighting, Rows, Size, Surfaces};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// The light of contacts is this close, as a share of their light and a tenth of the mean.
const TOLERANCE: f32 = 0.001;
/// Light that is still moving after so many bounces lies between mirrors, not between walls.
const MOST_SWEEPS: usize = 64;

/// A texel that sees things nearer than patches are wide, as in gaps and corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact {
    /// The texel.
    pub texel: u32,
    /// The row of what it sees.
    pub node: u32,
}

/// Contacts and what they see.
///
/// A patch that reaches out of a gap is as bright as what lies outside. In the gap its texels are looked at one by one,
/// so the light of their own, which the rows tell, replaces that of the patches there; and theirs that of others, until
/// it changes no more: Jacobi's iteration of the radiosity equation on texels, where patches are too coarse for it.
pub struct Contacts<'a> {
    /// What surfaces do with light.
    pub surfaces: &'a Surfaces,
    /// The texels.
    pub list: &'a [Contact],
    /// What each node sees.
    pub rows: &'a Rows,
}

/// A contact on its way.
struct State {
    /// What it receives from other surfaces: irradiance / pi.
    received: Vec3A,
    reflectance: Vec3A,
    /// Its columns, and the share of each that it is.
    columns: [(u32, f32); 3],
}

impl Contacts<'_> {
    /// Brings the `radiance` of all columns up to date, and what contacts `gathered` of it, irradiance / pi; `received` is
    /// what patches receive.
    ///
    /// Rows may be of fewer rays than the light was gathered with: they tell how it changes.
    pub fn exchange(
        &self,
        lighting: &Lighting,
        received: &[Vec3A],
        radiance: &mut [Vec3A],
        gathered: &mut [Vec3A],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let mut states = self.start(lighting, received);
        let seen = |k: usize, radiance: &[Vec3A]| self.rows.mean(self.list[k].node as usize, radiance);
        let rests: Vec<Vec3A> = (0..states.len()).map(|k| gathered[k] - seen(k, radiance)).collect();
        for _ in 0..MOST_SWEEPS {
            let light: Vec<Vec3A> = workers.map(states.len(), 256, progress, |range| {
                range.map(|k| (seen(k, radiance) + rests[k]).max(Vec3A::ZERO)).collect()
            })?;
            let floor = light.iter().sum::<Vec3A>() * (0.1 / light.len().max(1) as f32);
            let mut is_done = true;
            for (state, &light) in states.iter_mut().zip(&light) {
                let change = light - state.received;
                is_done &= change.abs().cmple((light + floor) * TOLERANCE).all();
                state.received = light;
                for (column, share) in state.columns {
                    radiance[column as usize] += change * state.reflectance * share;
                }
            }
            gathered.copy_from_slice(&light);
            if is_done {
                break;
            }
        }
        Ok(())
    }

    /// Contacts as patches see them.
    fn start(&self, lighting: &Lighting, received: &[Vec3A]) -> Vec<State> {
        let surfaces = self.surfaces;
        let sizes = [Size::Texel, Size::Two, Size::Four];
        let areas = sizes.map(|size| self.areas(size));
        let state = |&Contact { texel, .. }: &Contact| {
            let area = surfaces.texel_areas[texel as usize];
            let columns = core::array::from_fn(|k| {
                let column = surfaces.column(texel, sizes[k]);
                let whole = areas[k].get((column - surfaces.first(sizes[k])) as usize).copied();
                (column, whole.map_or(1.0, |whole| area / whole.max(f32::MIN_POSITIVE)))
            });
            State {
                received: surfaces.around.mean(texel as usize, received),
                reflectance: surfaces.reflectance_of(texel, lighting),
                columns,
            }
        };
        self.list.iter().map(state).collect()
    }

    /// The area of each cell of a size; none of texels.
    fn areas(&self, size: Size) -> Vec<f32> {
        let Some(cells) = self.surfaces.cells_of(size) else { return Vec::new() };
        let mut areas = vec![0.0; cells.count as usize];
        for (&cell, &area) in cells.of_texel.iter().zip(&self.surfaces.texel_areas) {
            areas[cell as usize] += area;
        }
        areas
    }
}
