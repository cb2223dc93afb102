//! From charts to texels: which texel lies where on which triangle.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use glam::{Vec2, Vec3};

use super::clip::clip_to_unit_square;
use super::{Layout, Links, NONE};
use crate::geometry::Hit;
use crate::math;
use crate::progress::{Cancelled, Progress};
use crate::scene::World;

/// The side of a block of texels that are kept together in lists, for the sake of caches.
pub const BLOCK: u32 = 8;

/// Of [`Texel::quarters`]: all of the texel is covered, and nothing stands in it.
pub const ALL_QUARTERS: u8 = 0b1111;
/// Among [`Texel::quarters`]: something stands in the texel, so that only its quarters are known to be visible or not.
pub const CROSSED: u8 = 1 << 4;

/// A texel that a surface covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Where it is in the world: its center where that is covered, else the centroid of what is covered.
    pub position: Vec3,
    /// Interpolated, or that of the curved surface which the mesh stands for; of length 1.
    pub normal: Vec3,
    /// What it covers of the world, in square meters.
    pub area: f32,
    /// Index of the triangle of the world on which it lies.
    pub triangle: u32,
    /// Column and row in its image.
    pub pixel: [u16; 2],
    /// Index of its image.
    pub image: u16,
    /// Which quarters of the texel have a covered center in the plane of the triangle that is not hidden from the
    /// position: bit `2 * lower + right`; and [`CROSSED`].
    pub quarters: u8,
    /// Its chart, counted through the whole bake.
    pub chart: u32,
}

/// The covered texels of some images of a bake, image by image, block by block.
#[derive(Clone, Debug, Default)]
pub struct Texels {
    /// The covered texels.
    pub list: Vec<Texel>,
    /// For each image and each of its texels, row by row, the index into `list`, or [`NONE`]; empty for images whose
    /// texels are not here.
    pub index: Vec<Vec<u32>>,
    /// The images whose texels are here.
    pub here: Range<usize>,
    /// Width and height of each image.
    pub sizes: Vec<[u32; 2]>,
    /// For each triangle of the world where it lies in the images.
    pub places: Vec<Place>,
    /// Which texels a wall parts; empty until [`super::check`] looks.
    pub links: Links,
}

/// Where a triangle lies in the images.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its corners in its image, in texels.
    pub corners: [Vec2; 3],
    /// Its image, or [`NONE`].
    pub image: u32,
}

/// What covers less of a texel than this is a rounding of the border of a chart, unless it is all there is of it.
const LEAST_SHARE: f32 = 0.005;

/// What covers a texel, while that is being found out.
#[derive(Clone, Copy)]
struct Cover {
    triangle: u32,
    /// Covered share by `triangle`, plus 1 where it covers the center.
    claim: f32,
    area: f32,
}

impl Texels {
    /// Finds all texels of some images that the receiving surfaces of a world cover, be it ever so little.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel.
    pub fn new(world: &World, layout: &Layout, images: Range<usize>, progress: &Progress) -> Result<Self, Cancelled> {
        let index = vec![Vec::new(); layout.images.len()];
        let mut texels = Self { sizes: layout.images.clone(), index, here: images.clone(), ..Self::default() };
        texels.place_triangles(world, layout);
        let charts = first_charts(world, layout);
        let covers: Vec<Vec<Cover>> =
            images.clone().map(|image| texels.cover(image, world, progress)).collect::<Result<_, _>>()?;
        let covered = covers.iter().flatten().filter(|cover| cover.triangle != NONE).count();
        texels.list.reserve_exact(covered);
        for (image, covers) in images.zip(covers) {
            texels.list_image(image, &covers, world, layout, &charts, progress)?;
        }
        texels.mark_quarters(world, progress)?;
        Ok(texels)
    }

    /// The point on its triangle that stands for a texel.
    pub fn hit(&self, texel: u32) -> Hit {
        let Texel { triangle, pixel, .. } = self.list[texel as usize];
        self.site(triangle, pixel)
    }

    /// The covered texel that a hit falls on, if it is here.
    #[inline]
    pub fn at(&self, hit: &Hit) -> Option<u32> {
        let (image, [x, y]) = self.place(hit)?;
        self.at_pixel(image, x, y)
    }

    /// The image, column and row that a hit falls on, whether the texels of that image are here or not.
    #[inline]
    pub fn place(&self, hit: &Hit) -> Option<(u32, [i32; 2])> {
        let Place { corners, image } = self.places[hit.triangle as usize];
        if image == NONE {
            return None;
        }
        let point = hit.interpolate(corners);
        Some((image, [point.x as i32, point.y as i32]))
    }

    /// The covered texel at a column and row of an image, which may lie outside or not be here.
    #[inline]
    pub fn at_pixel(&self, image: u32, x: i32, y: i32) -> Option<u32> {
        let [width, height] = self.sizes[image as usize];
        if x < 0 || y < 0 || x >= width as i32 || y >= height as i32 {
            return None;
        }
        let texel = *self.index[image as usize].get(y as usize * width as usize + x as usize)?;
        (texel != NONE).then_some(texel)
    }

    /// How the world position changes from one texel to the next, along a row and along a column of the image.
    pub fn steps(&self, world: &World, triangle: u32) -> [Vec3; 2] {
        let [a, b, c] = self.places[triangle as usize].corners;
        let [p, q, r] = world.corners[triangle as usize];
        let (ab, ac) = (b - a, c - a);
        let determinant = ab.perp_dot(ac);
        if determinant == 0.0 {
            return [Vec3::ZERO; 2];
        }
        let (pq, pr) = (q - p, r - p);
        [(pq * ac.y - pr * ab.y) / determinant, (pr * ab.x - pq * ac.x) / determinant]
    }

    /// The point at the middle of a texel's square, as high above its triangle as its position, covered or not.
    pub fn middle(&self, world: &World, texel: &Texel) -> Vec3 {
        let [right, down] = self.steps(world, texel.triangle);
        let (corner, flat) = (world.corners[texel.triangle as usize][0], world.normals[texel.triangle as usize]);
        let center = Vec2::from(texel.pixel.map(f32::from)) + 0.5 - self.places[texel.triangle as usize].corners[0];
        let point = corner + right * center.x + down * center.y;
        point + flat * (texel.position - point).dot(flat)
    }

    fn place_triangles(&mut self, world: &World, layout: &Layout) {
        for &source in &world.sources {
            let surface = &world.scene.surfaces[source.surface as usize];
            let (placement, uv) = (layout.placements[source.surface as usize], &layout.uvs[surface.mesh]);
            let (Some(placement), Some(uv)) = (placement, uv) else {
                self.places.push(Place { corners: [Vec2::ZERO; 3], image: NONE });
                continue;
            };
            let [width, height] = self.sizes[placement.image];
            let scale = Vec2::new(width as f32, height as f32);
            let corner =
                |vertex: u32| (placement.min + uv.uv_1[vertex as usize] * (placement.max - placement.min)) * scale;
            let corners = world.in_order(source, uv.triangles[source.triangle as usize].map(corner));
            self.places.push(Place { corners, image: placement.image as u32 });
        }
    }

    /// For each texel of an image the triangle that covers it best.
    fn cover(&self, image: usize, world: &World, progress: &Progress) -> Result<Vec<Cover>, Cancelled> {
        let [width, height] = self.sizes[image];
        let mut covers = vec![Cover { triangle: NONE, claim: 0.0, area: 0.0 }; (width * height) as usize];
        for triangle in self.triangles_in(image..image + 1) {
            progress.check()?;
            let [p, q, r] = world.corners[triangle as usize];
            let [a, b, c] = self.places[triangle as usize].corners;
            let pixels = 0.5 * (b - a).perp_dot(c - a).abs();
            let stretch = 0.5 * (q - p).cross(r - p).length() / pixels.max(f32::MIN_POSITIVE);
            let least = LEAST_SHARE * pixels.min(1.0);
            self.for_each_pixel(triangle, |_, x, y, local| {
                let Some((share, _)) = clip_to_unit_square(local).filter(|(share, _)| *share > least) else { return };
                let claim = share + if contains(&local, Vec2::splat(0.5)) { 1.0 } else { 0.0 };
                let cover = &mut covers[(y * width + x) as usize];
                cover.area += share * stretch;
                if claim > cover.claim {
                    (cover.triangle, cover.claim) = (triangle, claim);
                }
            });
        }
        Ok(covers)
    }

    fn list_image(
        &mut self,
        image: usize,
        covers: &[Cover],
        world: &World,
        layout: &Layout,
        charts: &[u32],
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let [width, height] = self.sizes[image];
        let mut index = vec![NONE; covers.len()];
        for block_y in (0..height).step_by(BLOCK as usize) {
            progress.check()?;
            for block_x in (0..width).step_by(BLOCK as usize) {
                for y in block_y..(block_y + BLOCK).min(height) {
                    for x in block_x..(block_x + BLOCK).min(width) {
                        let cover = &covers[(y * width + x) as usize];
                        if cover.triangle != NONE {
                            index[(y * width + x) as usize] = self.list.len() as u32;
                            let chart = chart_of(world, layout, charts, cover.triangle);
                            let texel = self.texel(world, cover, [x as u16, y as u16], chart);
                            self.list.push(Texel { image: image as u16, ..texel });
                        }
                    }
                }
            }
        }
        self.index[image] = index;
        Ok(())
    }

    fn texel(&self, world: &World, cover: &Cover, pixel: [u16; 2], chart: u32) -> Texel {
        let hit = self.site(cover.triangle, pixel);
        Texel {
            position: smooth_position(world, &hit),
            normal: world.shading_normal(&hit),
            area: cover.area,
            triangle: cover.triangle,
            pixel,
            image: 0,
            quarters: 0,
            chart,
        }
    }

    /// The point of a triangle that stands for a texel: the center of the texel, or the centroid of what is covered.
    fn site(&self, triangle: u32, pixel: [u16; 2]) -> Hit {
        let corner = Vec2::new(f32::from(pixel[0]), f32::from(pixel[1]));
        let local = self.places[triangle as usize].corners.map(|point| point - corner);
        let center = Vec2::splat(0.5);
        let point = match clip_to_unit_square(local) {
            Some((_, centroid)) if !contains(&local, center) => centroid,
            _ => center,
        };
        Hit { triangle, distance: 0.0, barycentric: barycentric(&local, point), front: true }
    }

    fn mark_quarters(&mut self, world: &World, progress: &Progress) -> Result<(), Cancelled> {
        let triangles: Vec<u32> = self.triangles_in(self.here.clone()).collect();
        for triangle in triangles {
            progress.check()?;
            let mut marks = Vec::new();
            self.for_each_pixel(triangle, |image, x, y, local| {
                let Some(texel) = self.at_pixel(image as u32, x as i32, y as i32) else { return };
                let other = self.list[texel as usize].triangle;
                if other == triangle || are_coplanar(world, triangle, other) {
                    marks.push((texel, (0..4).map(|k| u8::from(contains(&local, quarter(k))) << k).sum::<u8>()));
                }
            });
            marks.into_iter().for_each(|(texel, bits)| self.list[texel as usize].quarters |= bits);
        }
        Ok(())
    }

    /// The triangles that lie in some images.
    fn triangles_in(&self, images: Range<usize>) -> impl Iterator<Item = u32> + '_ {
        let is_in = move |image: u32| images.contains(&(image as usize));
        (0..self.places.len() as u32).filter(move |&triangle| is_in(self.places[triangle as usize].image))
    }

    /// Calls `visit` with image, column, row and the corners of the triangle relative to each texel in its box.
    fn for_each_pixel(&self, triangle: u32, mut visit: impl FnMut(usize, u32, u32, [Vec2; 3])) {
        let Place { corners: [a, b, c], image } = self.places[triangle as usize];
        if image == NONE {
            return;
        }
        let [width, height] = self.sizes[image as usize];
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let (right, bottom) = (math::ceil(high.x).max(0.0) as u32, math::ceil(high.y).max(0.0) as u32);
        for y in low.y.max(0.0) as u32..bottom.min(height) {
            for x in low.x.max(0.0) as u32..right.min(width) {
                let corner = Vec2::new(x as f32, y as f32);
                visit(image as usize, x, y, [a - corner, b - corner, c - corner]);
            }
        }
    }
}

/// The center of a quarter of a texel: bit 0 of `k` says right, bit 1 says lower.
pub fn quarter(k: usize) -> Vec2 {
    Vec2::new(0.25 + 0.5 * (k & 1) as f32, 0.25 + 0.5 * (k >> 1) as f32)
}

/// For each surface the first of its charts, counted through the whole bake.
fn first_charts(world: &World, layout: &Layout) -> Vec<u32> {
    let mut next = 0;
    let surfaces = &world.scene.surfaces;
    surfaces
        .iter()
        .enumerate()
        .map(|(index, surface)| {
            let first = next;
            if layout.placements[index].is_some() {
                next += layout.charts[surface.mesh].iter().max().map_or(0, |&last| last + 1);
            }
            first
        })
        .collect()
}

fn chart_of(world: &World, layout: &Layout, charts: &[u32], triangle: u32) -> u32 {
    let source = world.sources[triangle as usize];
    let mesh = world.scene.surfaces[source.surface as usize].mesh;
    charts[source.surface as usize] + layout.charts[mesh][source.triangle as usize]
}

/// Weights of the second and the third corner at a point, held inside the triangle.
fn barycentric(triangle: &[Vec2; 3], point: Vec2) -> Vec2 {
    let [a, b, c] = *triangle;
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let determinant = ab.perp_dot(ac);
    if determinant == 0.0 {
        return Vec2::splat(1.0 / 3.0);
    }
    let weights = Vec2::new(ap.perp_dot(ac), ab.perp_dot(ap)) / determinant;
    let inside = weights.clamp(Vec2::ZERO, Vec2::ONE);
    inside / inside.element_sum().max(1.0)
}

fn contains(triangle: &[Vec2; 3], point: Vec2) -> bool {
    let [a, b, c] = triangle.map(|corner| corner - point);
    let signs = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
    signs.iter().all(|&sign| sign >= 0.0) || signs.iter().all(|&sign| sign <= 0.0)
}

fn are_coplanar(world: &World, triangle: u32, other: u32) -> bool {
    let (normal, other_normal) = (world.normals[triangle as usize], world.normals[other as usize]);
    normal.dot(other_normal) > 0.9999
}

/// The point on the smooth surface that the corner normals suggest, so that facets do not shadow each other.
///
/// Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021. A flat triangle keeps its point.
fn smooth_position(world: &World, hit: &Hit) -> Vec3 {
    let corners = world.corners[hit.triangle as usize];
    let position = hit.interpolate(corners);
    let normals = world.corner_normals(hit.triangle);
    let lifts: [Vec3; 3] = core::array::from_fn(|k| normals[k] * -(position - corners[k]).dot(normals[k]).min(0.0));
    position + hit.interpolate(lifts)
}
