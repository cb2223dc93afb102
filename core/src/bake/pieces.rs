//! Surfaces in pieces: their materials, what they see of each other, and the direct light of those without texels.

use alloc::vec;
use alloc::vec::Vec;
use core::f32::consts::PI;
use core::ops::Range;

use glam::{Vec2, Vec3};

use crate::geometry::{Hit, Occluders, Sobol, cosine_direction, hash};
use crate::light::{Guide, Lamps, Region};
use crate::lightmap::{NONE, Patch, Patches, Site, Texels};
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::World;
use crate::transport::{Cells, Codes, Row, Rows, Surfaces, Tracer};

/// Points of a patch from which direct light is looked for where it has no texels to average.
const DIRECT_POINTS: u32 = 16;

/// Things touch where they are nearer than so many sides of a patch. Corners of cells between which light is interpolated
/// see nothing so near.
const TOUCH: f32 = 1.0;

/// Texels whose neighbors are found before they are put together.
const BATCH: usize = 1 << 17;

/// The texels that are here, all patches, and what looks at them.
pub(super) struct Pieces<'a, O> {
    pub tracer: &'a Tracer<'a, O>,
    pub texels: &'a Texels,
    pub patches: &'a Patches,
    /// The patches whose members are here.
    pub own: Range<usize>,
    pub workers: &'a Workers,
    pub progress: &'a Progress,
    pub seed: u32,
}

impl<O: Occluders> Pieces<'_, O> {
    /// Whether a texel that sees things at this harmonic mean distance sees them nearer than patches can tell.
    pub fn touches(&self, texel: usize, distance: f32) -> bool {
        let patch = self.patches.of_texel[texel];
        patch != NONE && distance < TOUCH * math::sqrt(self.patches.list[patch as usize].area)
    }

    fn world(&self) -> &World<'_> {
        self.tracer.world
    }

    /// Rows of form factors: `rays` from each patch whose members are here.
    pub fn rows(&self, rays: u32) -> Result<Vec<Row>, Cancelled> {
        self.workers.map(self.own.len(), 32, self.progress, |range| {
            range.map(|patch| self.row(self.own.start + patch, rays)).collect()
        })
    }

    fn row(&self, index: usize, rays: u32) -> Row {
        let sky = self.patches.list.len() as u32;
        let black = sky + self.world().sky_patches();
        let patch = &self.patches.list[index];
        let seed = hash(self.seed, index as u32);
        let sequence = Sobol::new(seed);
        let leave = |k: u32| {
            let (triangle, point, normal) = self.patches.point(self.world(), self.texels, patch, &sequence, k);
            let direction = cosine_direction(sequence.square(k), normal);
            self.tracer.leave(triangle, point, normal, direction, f32::INFINITY)
        };
        let column = |hit: Option<&Hit>, direction: Vec3| match hit {
            None => sky + self.world().sky_patch(direction),
            Some(hit) => self.patches.at(self.tracer, self.texels, hit).map_or(black, |(patch, _)| patch),
        };
        let nearest = |k: u32| {
            let ray = leave(k);
            column(self.tracer.nearest(&ray, hash(seed, k)).as_ref(), ray.direction)
        };
        let parts = |k: u32| {
            let arrival = self.tracer.follow(&leave(k), hash(seed, k));
            arrival.columns(
                column(arrival.hit.as_ref(), arrival.direction),
                [black + 1, black],
                sequence.dimension(k, 3),
            )
        };
        self.tracer.count(rays as usize);
        let mut ends: Vec<u32> = match self.tracer.is_plain {
            true => (0..rays).map(nearest).collect(),
            false => (0..rays).flat_map(parts).collect(),
        };
        Row::count(&mut ends)
    }

    /// What the surfaces do with light: the texels that are here, and their patches. `is_light` tells which of them are lamps, whose emission counts as direct light.
    pub fn surfaces(&self, is_light: &[bool]) -> Result<Surfaces, Cancelled> {
        let black = self.patches.list.len() as u32 + self.world().sky_patches();
        let of_texel = &self.patches.of_texel;
        let texel_area = |texel: usize| if of_texel[texel] == NONE { 0.0 } else { self.texels.list[texel].area };
        let details = self.details(is_light)?;
        let codes = |which: usize| Codes::new(details.iter().flat_map(move |detail| detail[which].to_array()));
        let [reflectance, emission] = [codes(0), codes(1)];
        drop(details);
        Ok(Surfaces {
            areas: self.patches.list.iter().map(|patch| patch.area).collect(),
            presence: self.of_own(0.0, |patch| self.presence(patch)),
            materials: self.of_own(0, |patch| self.material(patch)),
            bare: self.own.clone().filter(|&patch| self.is_bare(patch)).map(|patch| patch as u32).collect(),
            patch_of: of_texel.iter().map(|&patch| if patch == NONE { black } else { patch }).collect(),
            texel_areas: (0..of_texel.len()).map(texel_area).collect(),
            reflectance,
            emission,
            cells: [self.cells(4), self.cells(2)],
            around: self.all_around()?,
            sky: self.world().scene.sky_of_patches(),
        })
    }

    /// For texels, then patches, what textures make of reflectance and emission.
    fn details(&self, is_light: &[bool]) -> Result<Vec<[Vec3; 2]>, Cancelled> {
        let texels = self.workers.map(self.texels.list.len(), 1024, self.progress, |range| {
            range.map(|texel| self.detail(&self.texels.hit(texel as u32), is_light)).collect()
        })?;
        let mean = |patch: &Patch| {
            let mut sums = [Vec3::ZERO; 2];
            for (site, area) in self.patches.sites(patch) {
                let detail = match site {
                    Site::Texel(texel) => texels[texel as usize],
                    Site::Triangle(triangle) => self.detail(&middle(triangle), is_light),
                };
                (0..2).for_each(|which| sums[which] += detail[which] * area);
            }
            sums.map(|sum| sum / patch.area)
        };
        let patches = self.of_own([Vec3::ZERO; 2], mean);
        let mut all = texels;
        all.extend(patches);
        Ok(all)
    }

    /// For each patch whose members are here what `of_patch` says, for others `elsewhere`.
    fn of_own<T: Copy>(&self, elsewhere: T, of_patch: impl Fn(&Patch) -> T) -> Vec<T> {
        let mut all = vec![elsewhere; self.patches.list.len()];
        for patch in self.own.clone() {
            all[patch] = of_patch(&self.patches.list[patch]);
        }
        all
    }

    fn detail(&self, hit: &Hit, is_light: &[bool]) -> [Vec3; 2] {
        let surface = self.world().sources[hit.triangle as usize].surface;
        let emission = if is_light[surface as usize] { Vec3::ZERO } else { self.world().emission_of_white(hit) };
        [self.world().reflectance_of_white(hit), emission]
    }

    fn material(&self, patch: &Patch) -> u32 {
        let triangle = match self.patches.sites(patch).next() {
            Some((Site::Texel(texel), _)) => self.texels.list[texel as usize].triangle,
            Some((Site::Triangle(triangle), _)) => triangle,
            None => return 0,
        };
        let world = self.world();
        world.scene.surfaces[world.sources[triangle as usize].surface as usize].material as u32
    }

    /// The share of the light that meets a patch and does not go on.
    fn presence(&self, patch: &Patch) -> f32 {
        let at = |site: Site| match site {
            Site::Texel(texel) => self.texels.hit(texel),
            Site::Triangle(triangle) => middle(triangle),
        };
        let stays = |hit: &Hit| match self.world().mirror(hit) {
            Some(_) => 0.0,
            None => self.world().opacity(hit),
        };
        let passes = self.patches.sites(patch).map(|(site, area)| (1.0 - stays(&at(site))) * area).sum::<f32>();
        1.0 - passes / patch.area.max(f32::MIN_POSITIVE)
    }

    /// Whether no texels lie on the side of a patch.
    fn is_bare(&self, patch: usize) -> bool {
        let patch = &self.patches.list[patch];
        patch.side < 0.0 || matches!(self.patches.sites(patch).next(), Some((Site::Triangle(_), _)))
    }

    /// The groups of texels that share a patch and a square of this side. They are counted as their texels come.
    fn cells(&self, side: u16) -> Cells {
        let (mut count, mut open) = (0, Vec::new());
        let mut block = [u16::MAX; 3];
        let of_texel = self.texels.list.iter().zip(&self.patches.of_texel).map(|(texel, &patch)| {
            let square = texel.pixel.map(|position| position / side);
            let now = [texel.image, texel.pixel[0] / 8, texel.pixel[1] / 8];
            if now != block {
                // Texels come block by block.
                open.clear();
                block = now;
            }
            let key = (square, patch);
            let known = open.iter().find(|(other, _)| *other == key).map(|&(_, cell)| cell);
            known.unwrap_or_else(|| {
                open.push((key, count));
                count += 1;
                count - 1
            })
        });
        let of_texel = of_texel.collect();
        Cells { of_texel, count }
    }

    /// For each texel the patches around it, batch by batch: so many small lists at once leave holes in the memory.
    fn all_around(&self) -> Result<Rows, Cancelled> {
        let (mut rows, count) = (Rows::default(), self.texels.list.len());
        for start in (0..count).step_by(BATCH) {
            let texels = (count - start).min(BATCH);
            rows.append(
                self.workers.map(texels, 4096, self.progress, |range| {
                    range.map(|texel| self.around(start + texel)).collect()
                })?,
            );
        }
        Ok(rows)
    }

    /// Weights of the patches around a texel, bilinear, as far as they belong to its chart.
    fn around(&self, index: usize) -> Row {
        let (texel, of_texel) = (&self.texels.list[index], &self.patches.of_texel);
        if of_texel[index] == NONE {
            return Row::default();
        }
        let (cell, half) = (self.patches.cell as f32, (self.patches.cell / 2) as i32);
        let along = texel.pixel.map(|position| {
            let shifted = (f32::from(position) + 0.5) / cell + 0.5;
            shifted - math::floor(shifted)
        });
        let mut weights = Vec::new();
        for k in 0..4 {
            let (right, lower) = (k & 1, k >> 1);
            let [dx, dy] = [(2 * right - 1) * half, (2 * lower - 1) * half];
            let [x, y] = [i32::from(texel.pixel[0]) + dx, i32::from(texel.pixel[1]) + dy];
            let Some(other) = self.texels.at_pixel(u32::from(texel.image), x, y) else { continue };
            let patch = of_texel[other as usize];
            let is_near = self.texels.list[other as usize].chart == texel.chart;
            if patch != NONE && is_near && self.texels.is_connected(index as u32, dx, dy) {
                let share = |along: f32, side: i32| if side == 1 { along } else { 1.0 - along };
                weights.push((patch, share(along[0], right) * share(along[1], lower)));
            }
        }
        if weights.iter().all(|&(_, weight)| weight <= 0.0) {
            weights = vec![(of_texel[index], 1.0)];
        }
        Row::weigh(&mut weights)
    }

    /// Irradiance / pi from all lamps on a patch without texels on its side, from a few points of it.
    pub fn direct_on(&self, index: u32, lamps: &Lamps) -> Vec3 {
        let patch = &self.patches.list[index as usize];
        let sequence = Sobol::new(hash(self.seed ^ 0x00d1_9ec7, index));
        let site = |k| self.patches.point(self.world(), self.texels, patch, &sequence, k);
        let sites: [_; DIRECT_POINTS as usize] = core::array::from_fn(|k| site(k as u32));
        let region = Region::around(sites.iter().map(|&(_, point, normal)| (point, normal, 0.0)));
        let cut = lamps.cut(&region, sites[0].1, sites[0].2);
        let guide = Guide::new(&cut);
        let mut sum = Vec3::ZERO;
        for (k, &(triangle, point, normal)) in sites.iter().enumerate() {
            let square = sequence.square(k as u32);
            let seen = |lamp: u32| {
                let irradiance = lamps.irradiance(lamp, point, normal);
                let shadow = lamps.light(lamp).shadow_ray(square, point, normal);
                if irradiance == Vec3::ZERO || shadow.weight <= 0.0 {
                    return Vec3::ZERO;
                }
                self.tracer.count(1);
                irradiance * self.tracer.arriving((triangle, point, normal), &shadow, lamps.mirror(lamp))
            };
            sum += cut.lamps.iter().map(|&lamp| seen(lamp)).sum::<Vec3>();
            let choice = lamps.choose(&cut, &guide, point, normal, sequence.dimension(k as u32, 2));
            sum += choice.map_or(Vec3::ZERO, |choice| seen(choice.lamp) / choice.probability);
        }
        sum / (DIRECT_POINTS as f32 * PI)
    }
}

fn middle(triangle: u32) -> Hit {
    Hit { triangle, distance: 0.0, barycentric: Vec2::splat(1.0 / 3.0), front: true }
}
