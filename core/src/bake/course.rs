//! The passes of a bake over its parts.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::mem;

use glam::Vec3A;

use super::assemble::{Assembly, Gatherers, Repairs};
use super::coarse::Coarse;
use super::emitters::Lamp;
use super::estimate::{Estimate, Foreseen, light_of};
use super::parts::Parts;
use super::pieces::Pieces;
use super::rays::RayBudget;
use super::summary::{Done, Tally};
use super::{BakeSettings, Baker, DirectLights, Keep, Log, Seeds};
use crate::geometry::Occluders;
use crate::lightmap::{
    DirectError, LightmapImage, Nodes, Seams, Smooth, filter, seam_texels, split_seams, without_torn,
};
use crate::math;
use crate::progress::{Cancelled, Stage};
use crate::transport::{Codes, Contact, Contacts, Lighting, PatchLight, Row, Rows, Solution, Surfaces, Transport};

/// What all passes have to know.
pub(super) struct Course<'a> {
    pub lamps: &'a [Lamp],
    /// For each surface whether its emission is among the lamps.
    pub is_light: &'a [bool],
    pub lighting: &'a Lighting,
    pub settings: &'a BakeSettings,
    pub budget: RayBudget,
    /// What rows of nodes may take where only those of contacts are kept, in bytes.
    pub room: usize,
}

/// The light of a part that comes straight from the lamps, until it is needed again.
enum Lit {
    /// Of the only part, with what its surfaces do with light.
    Only(Box<(Surfaces, DirectLights)>),
    /// Of the texels of one of several parts.
    OneOf {
        /// Irradiance / pi.
        light: Codes,
        /// For each texel the roots of [`DirectError::noise`] and [`DirectError::spread`], and [`DirectError::darkest`].
        errors: Coarse,
    },
}

/// The light of all parts that comes straight from the lamps.
pub(super) struct AllLit {
    /// Of each part.
    lit: Vec<Lit>,
    /// How bright all will be.
    foreseen: Foreseen,
}

impl Course<'_> {
    /// What patches do with light and get from the lamps, and the direct light of each part.
    pub fn direct<O: Occluders>(&self, parts: &mut Parts<'_, O>) -> Result<(PatchLight, AllLit), Cancelled> {
        let (mut light, mut lit, mut foreseen) = (PatchLight::default(), Vec::new(), Foreseen::default());
        for number in (0..parts.len()).rev() {
            parts.progress.enter_group(parts.len() - 1 - number, parts.len());
            parts.turn_to(number)?;
            let pieces = parts.pieces();
            let mut surfaces = pieces.surfaces(self.is_light)?;
            if parts.len() > 1 {
                surfaces.forget_neighbors();
            }
            let baker = self.baker(&pieces, &surfaces, &parts.is_valid, number);
            let direct = baker.direct(self.lamps, self.lighting)?;
            let of_part = PatchLight::new(&surfaces, self.lighting, &direct.sums);
            if lit.is_empty() {
                light = of_part;
            } else {
                light.take_in(&of_part, parts.own());
            }
            lit.push(if parts.len() == 1 {
                Lit::Only(Box::new((surfaces, direct)))
            } else {
                foreseen.add(&surfaces.patch_of, &parts.is_valid, &direct.sums);
                Lit::shortened(&direct)
            });
        }
        lit.reverse();
        Ok((light, AllLit { lit, foreseen }))
    }

    /// Rows of form factors between all patches. The sky and the black see nothing.
    pub fn rows<O: Occluders>(&self, parts: &mut Parts<'_, O>) -> Result<Rows, Cancelled> {
        let mut rows = Rows::default();
        for number in 0..parts.len() {
            parts.progress.enter_group(number, parts.len());
            parts.turn_to(number)?;
            rows.append(parts.pieces().rows(self.budget.row)?);
        }
        rows.append(vec![Row::default(); parts.tracer.world.sky_patches() as usize + 1]);
        let columns = rows.len() as u32;
        Ok(if parts.tracer.is_plain { rows } else { rows.through(columns) })
    }

    /// Gathers, and hands over the finished images.
    pub fn gather<O: Occluders>(
        &self,
        parts: &mut Parts<'_, O>,
        AllLit { mut lit, mut foreseen }: AllLit,
        mut rows: Rows,
        solution: &Solution,
        log: &mut Log,
        take: &mut dyn FnMut(usize, LightmapImage) -> Result<(), Cancelled>,
    ) -> Result<(Tally, Option<Transport>), Cancelled> {
        let areas = parts.patches.list.iter().map(|patch| patch.area);
        let mut tally = Tally::new(&rows, solution.energy_balance(areas, &rows));
        let mut transport = None;
        foreseen.receive(&solution.received);
        while let Some(of_part) = lit.pop() {
            let (number, tracer) = (lit.len(), parts.tracer);
            log.turn_to(Stage::Gather, tracer);
            parts.progress.enter_group(parts.len() - 1 - number, parts.len());
            parts.turn_to(number)?;
            let (pieces, is_valid) = (parts.pieces(), &parts.is_valid[..]);
            let Pieces { texels, patches, workers, progress, .. } = pieces;
            let (surfaces, direct) = self.recalled(of_part, &pieces)?;
            let DirectLights { sums: direct, errors: direct_errors, kept } = direct;
            let known = match self.settings.target_error {
                0.0 => 0.0,
                _ => known_error(&pieces, is_valid, &surfaces, (&direct, &direct_errors), solution, &foreseen)?,
            };
            let mut radiance = surfaces.radiance(self.lighting, &direct, solution, workers, progress)?;
            tally.lowered += surfaces.count_lowered(self.lighting);
            let baker = self.baker(&pieces, &surfaces, is_valid, number);
            let nodes = baker.gather(&direct, &mut radiance, (known, self.room))?;
            tally.row_bytes = tally.row_bytes.max(nodes.bytes);
            let gatherers = self.touch(nodes, &baker, &solution.received, radiance)?;
            let indirect = filter(&gatherers.gathered, texels, is_valid, workers, progress)?;
            tally.nodes += gatherers.gathered.iter().filter(|node| node.rays > 0).count();

            log.turn_to(Stage::Finish, tracer);
            if number == 0 {
                progress.enter(Stage::Finish);
            }
            let light = light_of(&direct, &indirect);
            let is_valid = &without_torn(texels, is_valid, &light, workers, progress)?[..];
            let estimate = Estimate::new(texels, is_valid, &light, (&direct, &direct_errors), &indirect, &foreseen);
            let assembly = Assembly { texels, is_valid, patches, workers, progress };
            let (mut images, fills) = assembly.images(&direct, &indirect, &estimate.errors)?;
            let seams = Seams::new(texels, is_valid, &estimate.errors, tracer, workers, progress)?;
            let seam_report = seams.solve(&mut images, estimate.whole, workers, progress)?;
            let done = Done { world: tracer.world, texels, is_valid, surfaces: &surfaces, solution };
            let seam_texels = seam_texels(&seams, &images, estimate.whole, texels.here.start);
            tally.add(&Tally { seams: seam_report, seam_texels, ..done.tally(&estimate, &indirect) });
            for (index, image) in texels.here.clone().zip(images) {
                take(index, image)?;
            }
            if self.settings.keep == Keep::Transport {
                let (rows, repairs) = (mem::take(&mut rows), Repairs { fills, seams });
                transport = Some(assembly.transport(surfaces, kept, rows, gatherers, repairs, tracer.world.scene)?);
            }
        }
        tally.split_seams = split_seams(&parts.images, &parts.texels, parts.tracer, parts.workers, parts.progress)?;
        Ok((tally, transport))
    }

    /// Mends what nodes gathered of things that they touch.
    fn touch<O: Occluders>(
        &self,
        nodes: Nodes,
        baker: &Baker<'_, O>,
        received: &[Vec3A],
        mut radiance: Vec<Vec3A>,
    ) -> Result<Gatherers, Cancelled> {
        let Pieces { workers, progress, .. } = *baker.pieces;
        let (mut gathered, seers, rows) = nodes.split();
        let rows = if baker.pieces.tracer.is_plain { rows } else { rows.through(baker.surfaces.columns() as u32) };
        let of = |seer: &Contact| gathered[seer.texel as usize];
        let touches = |seer: &&Contact| baker.pieces.touches(seer.texel as usize, of(seer).distance);
        let contacts: Vec<Contact> = seers.iter().filter(touches).copied().collect();
        let mut light: Vec<Vec3A> = contacts.iter().map(|contact| of(contact).irradiance.into()).collect();
        let exchange = Contacts { surfaces: baker.surfaces, list: &contacts, rows: &rows };
        exchange.exchange(self.lighting, received, &mut radiance, &mut light, workers, progress)?;
        for (&Contact { texel, .. }, &light) in contacts.iter().zip(&light) {
            gathered[texel as usize].irradiance = light.into();
        }
        Ok(Gatherers { gathered, rows, contacts })
    }

    /// What the surfaces of a part do with light, and the direct light of its texels.
    fn recalled<O: Occluders>(&self, lit: Lit, pieces: &Pieces<'_, O>) -> Result<(Surfaces, DirectLights), Cancelled> {
        match lit {
            Lit::Only(both) => Ok(*both),
            Lit::OneOf { light, errors } => {
                let error = |texel| {
                    let [noise, spread, darkest] = errors.three(texel);
                    DirectError { noise: noise * noise, spread: spread * spread, darkest }
                };
                let direct = DirectLights {
                    sums: (0..light.len() / 3).map(|texel| light.rgb(texel)).collect(),
                    errors: (0..light.len() / 3).map(error).collect(),
                    kept: Vec::new(),
                };
                Ok((pieces.surfaces(self.is_light)?, direct))
            }
        }
    }

    fn baker<'a, O>(
        &self,
        pieces: &'a Pieces<'a, O>,
        surfaces: &'a Surfaces,
        is_valid: &'a [bool],
        number: usize,
    ) -> Baker<'a, O> {
        let Self { settings, budget, .. } = *self;
        let seeds = Seeds(settings.seed).of_part(number);
        Baker { pieces, surfaces, is_valid, budget, keep: settings.keep, seeds }
    }
}

/// What the error will be without noise of indirect light, where texels receive what the patches around them do.
fn known_error<O: Occluders>(
    pieces: &Pieces<'_, O>,
    is_valid: &[bool],
    surfaces: &Surfaces,
    direct: (&[Vec3A], &[DirectError]),
    solution: &Solution,
    foreseen: &Foreseen,
) -> Result<f32, Cancelled> {
    let Pieces { texels, workers, progress, .. } = *pieces;
    let received = |texel| Smooth { irradiance: surfaces.around.mean(texel, &solution.received).into(), variance: 0.0 };
    let indirect: Vec<Smooth> = workers.map(is_valid.len(), 4096, progress, |range| range.map(received).collect())?;
    let light = light_of(direct.0, &indirect);
    Ok(Estimate::new(texels, is_valid, &light, direct, &indirect, foreseen).rms)
}

impl Lit {
    /// In few bytes.
    fn shortened(direct: &DirectLights) -> Self {
        let texels = direct.errors.len();
        let light = direct.sums[..texels].iter().flat_map(Vec3A::to_array);
        let three = |error: &DirectError| [math::sqrt(error.noise), math::sqrt(error.spread), error.darkest];
        Self::OneOf { light: Codes::new(light), errors: Coarse::new(direct.errors.iter().flat_map(three)) }
    }
}
