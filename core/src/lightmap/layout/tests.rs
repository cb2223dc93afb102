//! Laws of every layout, on meshes that are made here.

use core::f32::consts::{PI, TAU};
use std::collections::HashMap;

use glam::{Affine3A, Quat, Vec3, vec2, vec3};

use super::*;
use crate::parallel::Workers;
use crate::scene::Surface;

/// A sheet of `n` x `m` cells bent by a function of `0..1` x `0..1`.
fn sheet(name: &str, [n, m]: [u32; 2], bend: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let mut mesh = Mesh { name: name.into(), ..Mesh::default() };
    for j in 0..=m {
        mesh.positions.extend((0..=n).map(|i| bend(i as f32 / n as f32, j as f32 / m as f32)));
    }
    for j in 0..m {
        for a in (0..n).map(|i| j * (n + 1) + i) {
            mesh.triangles.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
        }
    }
    mesh
}

fn plane(width: f32, height: f32) -> Mesh {
    sheet("plane", [1, 1], |u, v| vec3(u * width, v * height, 0.0))
}

fn sphere() -> Mesh {
    sheet("sphere", [32, 16], |u, v| {
        let (s, c) = (u * TAU).sin_cos();
        vec3((v * PI).sin() * c, (v * PI).sin() * s, (v * PI).cos())
    })
}

fn torus() -> Mesh {
    sheet("torus", [40, 20], |u, v| {
        let (s, c) = (u * TAU).sin_cos();
        let radius = 1.0 + 0.4 * (v * TAU).cos();
        vec3(radius * c, radius * s, 0.4 * (v * TAU).sin())
    })
}

/// A box of 1 x 2 x 3 meters whose faces share their corners.
fn cuboid() -> Mesh {
    let positions = (0..8).map(|i| vec3((i & 1) as f32, (i >> 1 & 1) as f32 * 2.0, (i >> 2) as f32 * 3.0)).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { name: "cuboid".into(), positions, triangles, ..Mesh::default() }
}

/// Triangles anywhere, some of them twice, some without area, some not even numbers.
fn soup() -> Mesh {
    let mut state = 1u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    let mut positions: Vec<Vec3> = (0..300).map(|_| vec3(random(), random(), random()) * 4.0).collect();
    positions.extend([Vec3::NAN, Vec3::splat(f32::INFINITY), Vec3::splat(1e30)]);
    let mut triangles: Vec<[u32; 3]> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    triangles.extend([[0, 1, 2], [5, 4, 3], [7, 7, 8], [0, 1, 300], [301, 4, 9], [0, 1, 30], [0, 1, 31], [0, 1, 33]]);
    Mesh { name: "soup".into(), positions, triangles, ..Mesh::default() }
}

fn scene(meshes: Vec<Mesh>, surfaces: &[(usize, Affine3A)]) -> Scene {
    let surfaces = surfaces.iter().enumerate().map(|(index, &(mesh, transform))| Surface {
        name: format!("surface {index}"),
        mesh,
        material: 0,
        transform,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    Scene { surfaces: surfaces.collect(), meshes, ..Scene::default() }
}

/// Every shape, some shared by surfaces of different size, turned, mirrored and stretched.
fn zoo() -> Scene {
    let stretched =
        Affine3A::from_scale_rotation_translation(vec3(1.0, 3.0, 0.5), Quat::from_rotation_x(0.7), vec3(3.0, 1.0, 2.0));
    let mut kept = plane(3.0, 2.0);
    kept.uv_1 = vec![vec2(0.1, 0.2), vec2(0.6, 0.2), vec2(0.1, 0.9), vec2(0.6, 0.9)];
    scene(
        vec![cuboid(), sphere(), torus(), soup(), plane(5.0, 2.0), kept],
        &[
            (0, Affine3A::from_scale(Vec3::splat(2.0))),
            (0, Affine3A::from_scale(Vec3::splat(1.0))),
            (0, Affine3A::from_scale(vec3(-3.3, 3.3, 3.3))),
            (1, stretched),
            (2, Affine3A::IDENTITY),
            (3, Affine3A::IDENTITY),
            (4, Affine3A::from_rotation_z(0.3)),
            (5, Affine3A::IDENTITY),
            (5, Affine3A::from_scale(Vec3::splat(0.6))),
        ],
    )
}

fn at(texels_per_meter: f32) -> LayoutSettings {
    LayoutSettings { resolution: Resolution::TexelsPerMeter(texels_per_meter), ..LayoutSettings::default() }
}

fn lay_out(scene: &Scene, settings: &LayoutSettings) -> Layout {
    layout(scene, settings, &Progress::default()).unwrap()
}

/// Corners of a triangle in texels of its image, and in the world.
struct Laid {
    surface: usize,
    chart: u32,
    image: usize,
    texels: [Vec2; 3],
    world: [Vec3; 3],
}

impl Laid {
    fn meters2(&self) -> f32 {
        let [a, b, c] = self.world;
        0.5 * (b - a).cross(c - a).length()
    }

    fn texels2(&self) -> f32 {
        let [a, b, c] = self.texels;
        0.5 * (b - a).perp_dot(c - a).abs()
    }
}

/// All proper triangles.
fn triangles(scene: &Scene, layout: &Layout) -> Vec<Laid> {
    let mut all = Vec::new();
    for (index, (surface, placement)) in scene.surfaces.iter().zip(&layout.placements).enumerate() {
        let Some(placement) = placement else { continue };
        let (mesh, uv) = (&scene.meshes[surface.mesh], layout.uvs[surface.mesh].as_ref().unwrap());
        let image = Vec2::from(layout.images[placement.image].map(|side| side as f32));
        for (number, (&old, &new)) in mesh.triangles.iter().zip(&uv.triangles).enumerate() {
            assert_eq!(new.map(|i| uv.sources[i as usize]), old, "the same vertices in the same order");
            let texels = new.map(|i| (placement.min + uv.uv_1[i as usize] * (placement.max - placement.min)) * image);
            assert!(texels.iter().all(|texel| texel.is_finite()));
            if chart::is_proper(&mesh.positions, old) && texels[0] != texels[1] {
                let world = old.map(|i| surface.transform.transform_point3(mesh.positions[i as usize]));
                let chart = layout.charts[surface.mesh][number];
                all.push(Laid { surface: index, chart, image: placement.image, texels, world });
            }
        }
    }
    all
}

/// Whether a triangle touches the inside of a texel, by separating axes.
fn touches(triangle: &[Vec2; 3], texel: Vec2) -> bool {
    let center = texel + Vec2::splat(0.5);
    let edges = [0, 1, 2].map(|i| (triangle[(i + 1) % 3] - triangle[i]).perp());
    [Vec2::X, Vec2::Y].into_iter().chain(edges).filter(|axis| axis.length() > 0.0).all(|axis| {
        let along = triangle.map(|corner| (corner - center).dot(axis));
        let (low, high) = (along[0].min(along[1]).min(along[2]), along[0].max(along[1]).max(along[2]));
        let half = 0.5 * (axis.x.abs() + axis.y.abs()) - 2e-3 * axis.length();
        low < half && high > -half
    })
}

/// Fails if two charts come nearer than 4 texels to each other, or 2 to the border of the image.
fn assert_gutters(scene: &Scene, layout: &Layout) {
    let mut owners: HashMap<(usize, i32, i32), (usize, u32)> = HashMap::new();
    for triangle in triangles(scene, layout) {
        let low = triangle.texels.iter().fold(Vec2::INFINITY, |low, &p| low.min(p)).floor();
        let high = triangle.texels.iter().fold(Vec2::NEG_INFINITY, |high, &p| high.max(p)).ceil();
        for y in low.y as i32..high.y as i32 {
            for x in (low.x as i32..high.x as i32).filter(|&x| touches(&triangle.texels, vec2(x as f32, y as f32))) {
                for (x, y) in (x - 2..=x + 2).flat_map(|x| (y - 2..=y + 2).map(move |y| (x, y))) {
                    let [width, height] = layout.images[triangle.image].map(|side| side as i32);
                    assert!((0..width).contains(&x) && (0..height).contains(&y), "the gutter leaves the image");
                    let owner = (triangle.surface, triangle.chart);
                    let first = *owners.entry((triangle.image, x, y)).or_insert(owner);
                    assert_eq!(first, owner, "at texel ({x}, {y})");
                }
            }
        }
    }
}

/// Charts with their gutters of 2 texels never meet, in any rectangle and any number of images.
#[test]
fn charts_keep_their_distance() {
    let scene = zoo();
    for density in [2.0, 8.0, 21.3] {
        assert_gutters(&scene, &lay_out(&scene, &at(density)));
    }
    let settings = LayoutSettings { max_image_size: 128, uv: UvMode::Unwrap, ..at(8.0) };
    let layout = lay_out(&scene, &settings);
    assert!(layout.images.len() > 1);
    assert_gutters(&scene, &layout);
}

/// Each triangle has the texels that its area asks for, whatever the scale of its surface and wherever it came from.
#[test]
fn density_is_the_same_everywhere() {
    let mut scene = zoo();
    scene.surfaces[6].receiver = Receiver::Lightmap { density: 0.5 };
    let layout = lay_out(&scene, &at(64.0));
    let mut sums = vec![(0.0, 0.0); scene.surfaces.len()];
    for triangle in triangles(&scene, &layout) {
        let factor = if triangle.surface == 6 { 0.25 } else { 1.0 };
        let (have, wanted) = (triangle.texels2(), factor * 64.0 * 64.0 * triangle.meters2());
        // Curved charts may be off by 1.2 in area; small ones by rounding to texels.
        assert!(wanted < 50.0 || (0.75..1.33).contains(&(have / wanted)), "{}: {have} {wanted}", triangle.surface);
        sums[triangle.surface] = (sums[triangle.surface].0 + have, sums[triangle.surface].1 + wanted);
    }
    for (surface, (have, wanted)) in sums.into_iter().enumerate() {
        assert!((have / wanted - 1.0).abs() < 0.05, "{surface}: {have} texels for {wanted}");
    }
}

/// Images have sides of multiples of 4; rectangles lie within them and share no block of 4 x 4 texels.
#[test]
fn rectangles_share_no_block() {
    let scene = zoo();
    for settings in [at(10.0), LayoutSettings { max_image_size: 256, ..at(10.0) }] {
        let layout = lay_out(&scene, &settings);
        let mut blocks = HashMap::new();
        for (surface, placement) in layout.placements.iter().enumerate() {
            let Placement { image, min, max } = placement.unwrap();
            let [width, height] = layout.images[image];
            assert!(width % 4 == 0 && height % 4 == 0 && width.max(height) <= settings.max_image_size);
            assert!(min.cmplt(max).all() && min.cmpge(Vec2::ZERO).all() && max.cmple(Vec2::ONE).all());
            let size = vec2(width as f32, height as f32);
            let (low, high) = ((min * size / 4.0 + 1e-3).floor(), (max * size / 4.0 - 1e-3).ceil());
            for (x, y) in (low.x as u32..high.x as u32).flat_map(|x| (low.y as u32..high.y as u32).map(move |y| (x, y)))
            {
                assert_eq!(blocks.insert((image, x, y), surface), None);
            }
        }
        for uv in layout.uvs.iter().flatten().flat_map(|uv| &uv.uv_1) {
            assert!(uv.cmpge(Vec2::ZERO).all() && uv.cmple(Vec2::ONE).all());
        }
    }
}

/// The edges of a rectangular wall lie on borders of texels, unwrapped or kept.
#[test]
fn walls_end_on_texel_borders() {
    let scene = scene(vec![plane(5.03, 2.01)], &[(0, Affine3A::from_rotation_z(0.4))]);
    let layout = lay_out(&scene, &at(10.0));
    for triangle in triangles(&scene, &layout) {
        assert!(triangle.texels.iter().all(|texel| texel.distance(texel.round()) < 1e-2), "{:?}", triangle.texels);
    }
}

/// A closed box has one chart for each face, and a bent sheet none across its crease.
#[test]
fn charts_end_at_creases() {
    let count = |mesh: Mesh| {
        let layout = lay_out(&scene(vec![mesh], &[(0, Affine3A::IDENTITY)]), &at(16.0));
        layout.charts[0].iter().max().unwrap() + 1
    };
    assert_eq!(count(cuboid()), 6);
    assert_eq!(count(sheet("bent", [8, 8], |u, v| vec3(u, v, (u - 0.5).max(0.0)))), 2);
    assert_eq!(count(sheet("flat", [8, 8], |u, v| vec3(u, v, u))), 1);
}

/// The same bits whatever the number of threads.
#[test]
fn threads_do_not_matter() {
    let scene = zoo();
    let with = |threads| {
        let lay_out = |_| vec![lay_out(&scene, &LayoutSettings::default())];
        Workers::new(threads).map(1, 1, &Progress::default(), lay_out).unwrap()
    };
    assert_eq!(with(1), with(2));
}

/// The number of texels asked for is met, or else the density is at a limit.
#[test]
fn texels_as_asked_for() {
    let scene = zoo();
    let texels = |wanted| {
        let settings = LayoutSettings { resolution: Resolution::Texels(wanted), ..LayoutSettings::default() };
        let layout = lay_out(&scene, &settings);
        let have: u32 = layout.images.iter().map(|&[w, h]| w * h).sum();
        (have as f32 / wanted as f32, layout.texels_per_meter)
    };
    for wanted in [1 << 17, 1 << 20] {
        let (share, density) = texels(wanted);
        assert!((0.95..1.05).contains(&share) && (1.0..64.0).contains(&density), "{share} {density}");
    }
    assert_eq!(texels(100).1, 1.0);
    assert_eq!(texels(1 << 30).1, 64.0);
}

/// One image of the side asked for, filled at the highest density: 3 % more do not fit.
#[test]
fn one_image_is_filled() {
    let scene = zoo();
    let settings = LayoutSettings { resolution: Resolution::SingleImage(512), ..LayoutSettings::default() };
    let layout = lay_out(&scene, &settings);
    assert_eq!(layout.images, [[512, 512]]);
    assert_gutters(&scene, &layout);
    let more = lay_out(&scene, &LayoutSettings { max_image_size: 512, ..at(layout.texels_per_meter * 1.03) });
    assert!(more.images.len() > 1);
}

/// Kept coordinates fill 0..1, and stay as they are where a texture uses them too.
#[test]
fn kept_coordinates() {
    let mut zoo = zoo();
    let bounds = |layout: &Layout| {
        let uv = layout.uvs[5].as_ref().unwrap();
        assert_eq!(uv.origin, UvOrigin::Kept);
        let fold = |start: Vec2, pick: fn(Vec2, Vec2) -> Vec2| uv.uv_1.iter().copied().fold(start, pick);
        (fold(Vec2::INFINITY, Vec2::min), fold(Vec2::NEG_INFINITY, Vec2::max))
    };
    assert_eq!(bounds(&lay_out(&zoo, &at(8.0))), (Vec2::ZERO, Vec2::ONE));
    zoo.meshes[5].uv_1_in_use = true;
    let settings = LayoutSettings { uv: UvMode::Unwrap, ..at(8.0) };
    let layout = lay_out(&zoo, &settings);
    assert_eq!(bounds(&layout), (vec2(0.1, 0.2), vec2(0.6, 0.9)));
    assert_gutters(&zoo, &layout);
}

/// Coordinates that cannot serve are named with what is wrong; unwrapping replaces them, a texture's are left alone.
#[test]
fn unusable_coordinates() {
    let broken = |wrong: fn(&mut Vec<Vec2>), expected: &str| {
        let mut mesh = sheet("wall", [2, 2], |u, v| vec3(u, v, 0.0));
        mesh.uv_1 = mesh.positions.iter().map(|position| position.truncate()).collect();
        wrong(&mut mesh.uv_1);
        let mut scene = scene(vec![mesh], &[(0, Affine3A::IDENTITY)]);
        let keep = LayoutSettings { uv: UvMode::Keep, ..at(8.0) };
        let Err(LayoutError::UnusableUv { mesh, reason }) = layout(&scene, &keep, &Progress::default()) else {
            panic!("usable: {expected}")
        };
        assert!(mesh == "wall" && reason.contains(expected), "{reason}");
        let unwrapped = lay_out(&scene, &at(8.0));
        assert_eq!(unwrapped.uvs[0].as_ref().unwrap().origin, UvOrigin::Unwrapped);
        assert_eq!(unwrapped.warnings.len(), usize::from(!scene.meshes[0].uv_1.is_empty()));
        scene.meshes[0].uv_1_in_use = true;
        let left_out = lay_out(&scene, &at(8.0));
        assert_eq!((left_out.placements, left_out.uvs), (vec![None], vec![None]));
        assert!(left_out.warnings[0].contains(expected), "{:?}", left_out.warnings);
    };
    broken(|uv| uv.clear(), "no second UV set");
    broken(|uv| uv.truncate(5), "5 coordinates for 9 vertices");
    broken(|uv| uv[4] = Vec2::NAN, "not finite");
    broken(|uv| uv[8] = vec2(1.5, 1.0), "outside 0..1");
    broken(|uv| uv[5] = vec2(0.2, 0.6), "overlap");
    broken(|uv| uv.iter_mut().for_each(|uv| uv.x = uv.x.min(0.5)), "collapse");
    broken(|uv| uv.iter_mut().for_each(|uv| uv.x = 0.5), "lie within 0");
    broken(|uv| uv.iter_mut().for_each(|uv| uv.x = (uv.x - 0.5).abs()), "overlap");
}

/// A mesh too large for an image gets fewer texels, and the warning says by how much.
#[test]
fn too_large_for_an_image() {
    for kept in [false, true] {
        let mut mesh = plane(100.0, 10.0);
        if kept {
            mesh.uv_1 = vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
        }
        let scene = scene(vec![mesh], &[(0, Affine3A::IDENTITY), (0, Affine3A::from_scale(Vec3::splat(0.25)))]);
        let layout = lay_out(&scene, &LayoutSettings { max_image_size: 512, ..at(10.0) });
        assert_gutters(&scene, &layout);
        let [warning] = &layout.warnings[..] else { panic!("{:?}", layout.warnings) };
        assert!(warning.contains("surface 0") && warning.contains("instead of 10.00"), "{warning}");
        let sizes = triangles(&scene, &layout);
        let density = |surface: usize| {
            let laid = sizes.iter().find(|laid| laid.surface == surface).unwrap();
            (laid.texels2() / laid.meters2()).sqrt()
        };
        assert!((4.5..5.2).contains(&density(0)) && (9.5..10.5).contains(&density(1)));
    }
}

/// What cannot be is refused with its name; what has no area is left out with a warning.
#[test]
fn refusals() {
    let scene = zoo();
    let refusal = |scene: &Scene, settings: &LayoutSettings| match layout(scene, settings, &Progress::default()) {
        Err(LayoutError::Invalid(text) | LayoutError::DoesNotFit(text)) => text,
        other => panic!("{other:?}"),
    };
    let with = |resolution| LayoutSettings { resolution, ..LayoutSettings::default() };
    assert!(refusal(&scene, &at(-1.0)).contains("-1 texels"));
    assert!(refusal(&scene, &at(f32::NAN)).contains("NaN texels"));
    assert!(refusal(&scene, &with(Resolution::Texels(0))).contains("at least 1"));
    assert!(refusal(&scene, &with(Resolution::SingleImage(30))).contains("multiple of 4"));
    assert!(refusal(&scene, &with(Resolution::SingleImage(32))).contains("larger image"));
    assert!(refusal(&scene, &LayoutSettings { max_image_size: 8192, ..at(1.0) }).contains("8192"));
    assert!(refusal(&scene, &LayoutSettings { max_image_size: 32, ..at(1.0) }).contains("soup"));
    let mut wrong = scene.clone();
    wrong.meshes[1].triangles[3][0] = 9999;
    assert!(refusal(&wrong, &at(8.0)).contains("sphere"));
    let mut wrong = scene.clone();
    wrong.surfaces[2].receiver = Receiver::Lightmap { density: 0.0 };
    assert!(refusal(&wrong, &at(8.0)).contains("surface 2"));
    let mut flat = scene;
    flat.surfaces[4].transform = Affine3A::from_scale(Vec3::ZERO);
    let layout = lay_out(&flat, &at(8.0));
    assert!(layout.placements[4].is_none() && layout.warnings[0].contains("surface 4"));
    assert!(layout.uvs[2].is_none() && layout.charts[2].is_empty());
}

/// Nothing to lay out is no error, and a cancelled progress ends the work.
#[test]
fn empty_and_cancelled() {
    assert_eq!(lay_out(&Scene::default(), &at(8.0)).images.len(), 0);
    let progress = Progress::default();
    progress.cancel();
    assert_eq!(layout(&zoo(), &at(8.0), &progress), Err(LayoutError::Cancelled));
}

/// Ten thousand surfaces of all sizes share few images that they fill.
#[test]
fn many_surfaces_fill_their_images() {
    let transforms: Vec<_> = (0..10_000)
        .map(|i| (0, Affine3A::from_scale(vec3(1.0 + (i % 17) as f32 * 0.3, 1.0 + (i % 23) as f32 * 0.2, 1.0))))
        .collect();
    let mut mesh = plane(1.0, 1.0);
    mesh.uv_1 = vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
    let scene = scene(vec![mesh], &transforms);
    let layout = lay_out(&scene, &LayoutSettings { max_image_size: 1024, ..at(8.0) });
    let blocks: u64 = layout
        .placements
        .iter()
        .flatten()
        .map(|placement| {
            let size = (placement.max - placement.min) * Vec2::from(layout.images[placement.image].map(|s| s as f32));
            let block = size.round().as_u64vec2() + 4;
            block.x.next_multiple_of(4) * block.y.next_multiple_of(4)
        })
        .sum();
    let texels: u64 = layout.images.iter().map(|&[w, h]| u64::from(w * h)).sum();
    assert!(blocks as f64 > 0.92 * texels as f64, "{blocks} of {texels}");
}
