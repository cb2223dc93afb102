//! Bevy's meshes, images, materials, lights and units, and those of the core. The only file that knows both.

pub mod cubics;
mod sky;

pub(crate) use self::sky::*;

use std::f32::consts::PI;

use bevy::gltf::GltfMaterial;
use bevy::image::{ImageAddressMode, ImageFilterMode, ImageSampler};
use bevy::light::{DirectionalLight, PointLight, RectLight, SpotLight};
use bevy::material::AlphaMode;
use bevy::math::Affine2;
use bevy::mesh::{Indices, Mesh, MeshVertexAttribute, PrimitiveTopology, UvChannel, VertexAttributeValues};
use bevy::prelude::*;
use radiosity::light::{self, LightSource};
use radiosity::material::{self, Filter, Texels, Texture, TextureRef, UvSet, Wrap};
use wgpu_types::TextureFormat;

/// A mesh as the core has it.
///
/// # Errors
///
/// Says why the mesh cannot take part in a bake, as the end of a sentence about it.
pub fn mesh(name: &str, mesh: &Mesh) -> Result<radiosity::geometry::Mesh, &'static str> {
    let positions = match mesh.try_attribute_option(Mesh::ATTRIBUTE_POSITION) {
        Ok(Some(VertexAttributeValues::Float32x3(positions))) => positions.iter().map(|&p| Vec3::from(p)).collect(),
        Ok(_) => return Err("has no positions of three floats"),
        Err(_) => return Err("lives on the GPU only; load it with `RenderAssetUsages::MAIN_WORLD`"),
    };
    let positions: Vec<Vec3> = positions;
    let triangles = triangles(mesh, positions.len())?;
    Ok(radiosity::geometry::Mesh {
        name: name.to_owned(),
        normals: vec3s(mesh, Mesh::ATTRIBUTE_NORMAL),
        uv_0: vec2s(mesh, Mesh::ATTRIBUTE_UV_0),
        uv_1: vec2s(mesh, Mesh::ATTRIBUTE_UV_1),
        colors: vec4s(mesh, Mesh::ATTRIBUTE_COLOR),
        positions,
        triangles,
        uv_1_in_use: false,
    })
}

/// The triangles of a list or a strip. Those with an index that no vertex has are left out.
fn triangles(mesh: &Mesh, vertices: usize) -> Result<Vec<[u32; 3]>, &'static str> {
    let indices: Vec<u32> = match mesh.try_indices_option() {
        Ok(Some(Indices::U16(indices))) => indices.iter().map(|&index| u32::from(index)).collect(),
        Ok(Some(Indices::U32(indices))) => indices.clone(),
        _ => (0..vertices as u32).collect(),
    };
    let triangles: Vec<[u32; 3]> = match mesh.primitive_topology() {
        PrimitiveTopology::TriangleList => indices.chunks_exact(3).map(|i| [i[0], i[1], i[2]]).collect(),
        PrimitiveTopology::TriangleStrip => {
            let turned = |(number, i): (usize, &[u32])| match number % 2 {
                0 => [i[0], i[1], i[2]],
                _ => [i[0], i[2], i[1]],
            };
            indices.windows(3).enumerate().map(turned).collect()
        }
        _ => return Err("consists of points or lines"),
    };
    Ok(triangles.into_iter().filter(|triangle| triangle.iter().all(|&index| (index as usize) < vertices)).collect())
}

fn vec2s(mesh: &Mesh, attribute: MeshVertexAttribute) -> Vec<Vec2> {
    match mesh.try_attribute_option(attribute) {
        Ok(Some(VertexAttributeValues::Float32x2(list))) => list.iter().map(|&v| v.into()).collect(),
        _ => Vec::new(),
    }
}

fn vec3s(mesh: &Mesh, attribute: MeshVertexAttribute) -> Vec<Vec3> {
    match mesh.try_attribute_option(attribute) {
        Ok(Some(VertexAttributeValues::Float32x3(list))) => list.iter().map(|&v| v.into()).collect(),
        _ => Vec::new(),
    }
}

fn vec4s(mesh: &Mesh, attribute: MeshVertexAttribute) -> Vec<Vec4> {
    match mesh.try_attribute_option(attribute) {
        Ok(Some(VertexAttributeValues::Float32x4(list))) => list.iter().map(|&v| v.into()).collect(),
        _ => Vec::new(),
    }
}

/// A picture as the core has it: 8-bit formats as they are, 16-bit ones rounded to 8 bits, others as floats.
///
/// # Errors
///
/// Says why the picture cannot be read and what to do, as the end of a sentence about it.
pub fn texture(name: &str, image: &Image) -> Result<Texture, String> {
    let size = image.texture_descriptor.size;
    let count = size.width as usize * size.height as usize;
    let Some(data) = image.data.as_deref() else {
        return Err("lives on the GPU only; load it with `RenderAssetUsages::MAIN_WORLD`".into());
    };
    if count == 0 {
        return Err("is empty; replace the file".into());
    }
    let format = image.texture_descriptor.format;
    let eight_bits = || -> Vec<[u8; 4]> { data.as_chunks().0.iter().take(count).copied().collect() };
    let swapped = || -> Vec<[u8; 4]> { eight_bits().into_iter().map(|[b, g, r, a]| [r, g, b, a]).collect() };
    let texels = match format {
        TextureFormat::Rgba8UnormSrgb => Texels::Srgb8(eight_bits()),
        TextureFormat::Rgba8Unorm => Texels::Linear8(eight_bits()),
        TextureFormat::Bgra8UnormSrgb => Texels::Srgb8(swapped()),
        TextureFormat::Bgra8Unorm => Texels::Linear8(swapped()),
        _ => other_texels(image).ok_or_else(|| {
            format!("has the format {format:?}, which cannot be read on the CPU; convert it to PNG or JPEG")
        })?,
    };
    let complete = match &texels {
        Texels::Srgb8(list) | Texels::Linear8(list) => list.len() == count,
        Texels::Linear32(list) => list.len() == count,
    };
    if !complete {
        return Err("ends too early; replace the file".into());
    }
    let (wrap_u, wrap_v) = wrap(&image.sampler);
    Ok(Texture {
        name: name.to_owned(),
        width: size.width,
        height: size.height,
        texels,
        wrap_u,
        wrap_v,
        filter: filter(&image.sampler),
    })
}

/// Texels of any format that Bevy can read.
///
/// 16 bits for a share in `[0, 1]` are more than a bake can tell apart. They take a quarter of the memory in 8 bits, of
/// which sRGB leaves enough to the dark.
fn other_texels(image: &Image) -> Option<Texels> {
    let places = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
    let colors = places.map(|(x, y)| image.get_color_at(x, y).ok());
    match image.texture_descriptor.format {
        TextureFormat::R16Unorm
        | TextureFormat::R16Uint
        | TextureFormat::Rg16Unorm
        | TextureFormat::Rg16Uint
        | TextureFormat::Rgba16Unorm
        | TextureFormat::Rgba16Uint => {
            colors.map(|color| Some(color?.to_srgba().to_u8_array())).collect::<Option<_>>().map(Texels::Srgb8)
        }
        _ => colors.map(|color| Some(color?.to_linear().to_f32_array())).collect::<Option<_>>().map(Texels::Linear32),
    }
}

fn wrap(sampler: &ImageSampler) -> (Wrap, Wrap) {
    let wrap = |mode: &ImageAddressMode| match mode {
        ImageAddressMode::Repeat => Wrap::Repeat,
        ImageAddressMode::MirrorRepeat => Wrap::Mirror,
        ImageAddressMode::ClampToEdge | ImageAddressMode::ClampToBorder => Wrap::Clamp,
    };
    match sampler {
        // The default of `ImagePlugin` clamps.
        ImageSampler::Default => (Wrap::Clamp, Wrap::Clamp),
        ImageSampler::Descriptor(descriptor) => (wrap(&descriptor.address_mode_u), wrap(&descriptor.address_mode_v)),
    }
}

/// How a picture looks where it is larger than its texels, as those of pixel art are.
fn filter(sampler: &ImageSampler) -> Filter {
    match sampler {
        ImageSampler::Descriptor(descriptor) if descriptor.mag_filter == ImageFilterMode::Nearest => Filter::Nearest,
        // The default of `ImagePlugin` mixes.
        ImageSampler::Descriptor(_) | ImageSampler::Default => Filter::Linear,
    }
}

/// What a bake needs of a material, whichever of Bevy's material types it comes from.
#[derive(Clone, Debug)]
pub struct MaterialInputs {
    /// Linear or not, with alpha.
    pub base_color: Color,
    /// Multiplies the base color.
    pub base_color_texture: Option<(Handle<Image>, UvChannel)>,
    /// In `[0, 1]`.
    pub metallic: f32,
    /// Perceptual, in `[0, 1]`.
    pub roughness: f32,
    /// Its blue channel multiplies `metallic`, its green channel `roughness`.
    pub metallic_texture: Option<(Handle<Image>, UvChannel)>,
    /// In cd/m2; alpha has no meaning.
    pub emissive: LinearRgba,
    /// Multiplies `emissive`.
    pub emissive_texture: Option<(Handle<Image>, UvChannel)>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Applied to the coordinates of all textures.
    pub uv_transform: Affine2,
    /// Whether back faces reflect and emit.
    pub double_sided: bool,
    /// Whether light has no say in how the material looks.
    pub unlit: bool,
    /// Share of the light that passes as through glass, in `[0, 1]`.
    pub transmission: f32,
    /// Of the glass, in meters; 0: nothing is absorbed within.
    pub thickness: f32,
    /// What is left of white light after `attenuation_distance`.
    pub attenuation_color: Color,
    /// In meters; infinite: nothing is absorbed.
    pub attenuation_distance: f32,
    /// Whether any texture is looked up by the second set of coordinates.
    pub reads_uv_1: bool,
}

/// Reads the fields that `GltfMaterial` and `StandardMaterial` have in common.
macro_rules! material_inputs {
    ($material:expr) => {{
        let material = $material;
        let used = |texture: &Option<Handle<Image>>, channel: &UvChannel| {
            texture.clone().map(|texture| (texture, channel.clone()))
        };
        let base_color_texture = used(&material.base_color_texture, &material.base_color_channel);
        let metallic_texture = used(&material.metallic_roughness_texture, &material.metallic_roughness_channel);
        let emissive_texture = used(&material.emissive_texture, &material.emissive_channel);
        let normal_map = used(&material.normal_map_texture, &material.normal_map_channel);
        let occlusion = used(&material.occlusion_texture, &material.occlusion_channel);
        let all = [&base_color_texture, &metallic_texture, &emissive_texture, &normal_map, &occlusion];
        let reads_uv_1 = all.into_iter().flatten().any(|(_, channel)| matches!(channel, UvChannel::Uv1));
        MaterialInputs {
            base_color: material.base_color,
            base_color_texture,
            metallic: material.metallic,
            roughness: material.perceptual_roughness,
            metallic_texture,
            emissive: material.emissive,
            emissive_texture,
            alpha_mode: material.alpha_mode,
            uv_transform: material.uv_transform,
            double_sided: material.double_sided,
            unlit: material.unlit,
            transmission: material.specular_transmission,
            thickness: material.thickness,
            attenuation_color: material.attenuation_color,
            attenuation_distance: material.attenuation_distance,
            reads_uv_1,
        }
    }};
}

impl From<&GltfMaterial> for MaterialInputs {
    fn from(material: &GltfMaterial) -> Self {
        material_inputs!(material)
    }
}

#[cfg(feature = "render")]
impl From<&bevy::pbr::StandardMaterial> for MaterialInputs {
    fn from(material: &bevy::pbr::StandardMaterial) -> Self {
        material_inputs!(material)
    }
}

/// A material as the core has it; `texture_index` finds the texture of the scene for a picture, if it can be read.
pub fn material(
    name: &str,
    inputs: &MaterialInputs,
    mut texture_index: impl FnMut(&Handle<Image>) -> Option<usize>,
) -> material::Material {
    let transform = inputs.uv_transform;
    let mut reference = |texture: &Option<(Handle<Image>, UvChannel)>| {
        let (image, channel) = texture.as_ref()?;
        Some(TextureRef { texture: texture_index(image)?, uv_set: uv_set(channel), transform })
    };
    let base_color = Vec4::from_array(inputs.base_color.to_linear().to_f32_array()).clamp(Vec4::ZERO, Vec4::ONE);
    let transmission = inputs.transmission.clamp(0.0, 1.0);
    let (alpha, base_color, transmission) = match inputs.alpha_mode {
        AlphaMode::Opaque => (material::AlphaMode::Opaque, base_color, transmission),
        AlphaMode::Mask(cutoff) => (material::AlphaMode::Mask(cutoff), base_color, transmission),
        // What is added to the picture does not hold light back as a surface does.
        AlphaMode::Add => (material::AlphaMode::Blend, base_color.truncate().extend(0.0), transmission),
        // What is behind is multiplied by the color as far as alpha says: that is glass.
        AlphaMode::Multiply => (material::AlphaMode::Opaque, Vec4::ONE.lerp(base_color, base_color.w).with_w(1.0), 1.0),
        AlphaMode::Blend | AlphaMode::Premultiplied | AlphaMode::AlphaToCoverage => {
            (material::AlphaMode::Blend, base_color, transmission)
        }
    };
    material::Material {
        name: name.to_owned(),
        base_color,
        base_color_texture: reference(&inputs.base_color_texture),
        metallic: if inputs.alpha_mode == AlphaMode::Multiply { 0.0 } else { inputs.metallic.clamp(0.0, 1.0) },
        roughness: inputs.roughness.clamp(0.0, 1.0),
        metallic_texture: reference(&inputs.metallic_texture),
        emissive: inputs.emissive.to_vec3().max(Vec3::ZERO),
        emissive_texture: reference(&inputs.emissive_texture),
        alpha,
        transmission,
        absorption: absorption(inputs),
        thickness: inputs.thickness.max(0.0),
        double_sided: inputs.double_sided,
    }
}

/// Darker attenuation colors than this absorb as this one does.
const DARKEST: f32 = 1e-4;

/// What glass takes from light on its way, in 1/m: nothing where it has no thickness, as glTF has it.
fn absorption(inputs: &MaterialInputs) -> Vec3 {
    if !(inputs.thickness > 0.0 && inputs.attenuation_distance.is_finite()) {
        return Vec3::ZERO;
    }
    let left = inputs.attenuation_color.to_linear().to_vec3().clamp(Vec3::splat(DARKEST), Vec3::ONE);
    left.map(|left| -left.ln() / inputs.attenuation_distance.max(f32::MIN_POSITIVE))
}

fn uv_set(channel: &UvChannel) -> UvSet {
    match channel {
        UvChannel::Uv0 => UvSet::Uv0,
        UvChannel::Uv1 => UvSet::Uv1,
    }
}

/// A point light; its lumens leave evenly in all directions.
pub fn point_light(light: &PointLight, transform: &GlobalTransform) -> LightSource {
    LightSource::Point(light::PointLight {
        position: transform.translation(),
        intensity: rgb(light.color) * candela(light.intensity),
        range: light.range,
        radius: light.radius,
    })
}

/// A spot light. As in Bevy its lumens are those of a point light of the same brightness, not of the cone.
pub fn spot_light(light: &SpotLight, transform: &GlobalTransform) -> LightSource {
    LightSource::Spot(light::SpotLight {
        point: light::PointLight {
            position: transform.translation(),
            intensity: rgb(light.color) * candela(light.intensity),
            range: light.range,
            radius: light.radius,
        },
        direction: forward(transform),
        inner_angle: light.inner_angle,
        outer_angle: light.outer_angle,
    })
}

/// A directional light that is seen under an angle in radians.
pub fn directional_light(light: &DirectionalLight, transform: &GlobalTransform, angular_diameter: f32) -> LightSource {
    LightSource::Directional(light::DirectionalLight {
        direction: forward(transform),
        illuminance: rgb(light.color) * light.illuminance,
        angular_diameter,
    })
}

/// A rectangular light, which shines towards its -Z; its lumens are spread over its area as it is scaled.
pub fn rect_light(light: &RectLight, transform: &GlobalTransform) -> LightSource {
    let [x, y, _] = transform.affine().matrix3.to_cols_array_2d().map(Vec3::from);
    let (half_width, half_height) = (x * light.width * 0.5, y * light.height * 0.5);
    let area = 4.0 * half_width.length() * half_height.length();
    LightSource::Rect(light::RectLight {
        center: transform.translation(),
        // Right x up points back, and the light leaves forward.
        half_width: half_height,
        half_height: half_width,
        radiance: rgb(light.color) * light.intensity / (area * PI),
        range: light.range,
    })
}

/// Whether a light has a place, a direction, a size and a brightness that a bake can reckon with.
///
/// A direction is lost below a scale of 0; a rectangle without area has no radiance.
pub fn is_usable(source: &LightSource) -> bool {
    let is_strength = |strength: Vec3| strength.is_finite() && strength.min_element() >= 0.0;
    let is_point = |point: &light::PointLight| {
        point.position.is_finite() && is_strength(point.intensity) && point.range > 0.0 && point.radius.is_finite()
    };
    match source {
        LightSource::Point(point) => is_point(point),
        LightSource::Spot(spot) => {
            let angles = [spot.inner_angle, spot.outer_angle];
            is_point(&spot.point) && spot.direction.is_finite() && angles.iter().all(|angle| angle.is_finite())
        }
        LightSource::Directional(sun) => {
            sun.direction.is_finite() && is_strength(sun.illuminance) && sun.angular_diameter.is_finite()
        }
        LightSource::Rect(rect) => {
            let normal = rect.half_width.cross(rect.half_height);
            let has_area = normal.is_finite() && normal != Vec3::ZERO;
            has_area && rect.center.is_finite() && is_strength(rect.radiance) && rect.range > 0.0
        }
    }
}

/// Where an entity looks, with length 1; not finite below a scale of 0, where Bevy's own way panics in development.
fn forward(transform: &GlobalTransform) -> Vec3 {
    -Vec3::from(transform.affine().matrix3.z_axis).normalize()
}

fn candela(lumens: f32) -> f32 {
    lumens / (4.0 * PI)
}

fn rgb(color: Color) -> Vec3 {
    color.to_linear().to_vec3()
}

#[cfg(test)]
mod tests {
    use bevy::asset::RenderAssetUsages;
    use wgpu_types::{Extent3d, TextureDimension};

    use super::*;

    fn bevy_mesh(topology: PrimitiveTopology, vertices: usize, usages: RenderAssetUsages) -> Mesh {
        let positions: Vec<[f32; 3]> = (0..vertices).map(|i| [i as f32, 0.0, 0.0]).collect();
        Mesh::new(topology, usages).with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
    }

    fn placed(transform: Transform) -> GlobalTransform {
        transform.into()
    }

    /// Every second triangle of a strip is turned, so that all face the same way.
    #[test]
    fn lists_and_strips_with_and_without_indices() {
        let list = bevy_mesh(PrimitiveTopology::TriangleList, 6, default());
        assert_eq!(mesh("", &list).unwrap().triangles, [[0, 1, 2], [3, 4, 5]]);
        let strip = bevy_mesh(PrimitiveTopology::TriangleStrip, 5, default());
        assert_eq!(mesh("", &strip).unwrap().triangles, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        for indices in [Indices::U16(vec![2, 1, 0]), Indices::U32(vec![2, 1, 0])] {
            let indexed = list.clone().with_inserted_indices(indices);
            assert_eq!(mesh("", &indexed).unwrap().triangles, [[2, 1, 0]]);
        }
    }

    /// What Bevy would panic on is said instead.
    #[test]
    fn unusable_meshes_say_why() {
        let lines = bevy_mesh(PrimitiveTopology::LineList, 4, default());
        assert!(mesh("", &lines).unwrap_err().contains("lines"));
        let mut on_gpu = bevy_mesh(PrimitiveTopology::TriangleList, 3, RenderAssetUsages::RENDER_WORLD);
        on_gpu.take_gpu_data().unwrap();
        assert!(mesh("", &on_gpu).unwrap_err().contains("MAIN_WORLD"));
        let wild = bevy_mesh(PrimitiveTopology::TriangleList, 3, default())
            .with_inserted_indices(Indices::U32(vec![0, 1, 9, 0, 1, 2]));
        assert_eq!(mesh("", &wild).unwrap().triangles, [[0, 1, 2]]);
    }

    fn image(format: TextureFormat, texel: &[u8]) -> Image {
        let size = Extent3d { width: 2, height: 1, depth_or_array_layers: 1 };
        Image::new(size, TextureDimension::D2, texel.repeat(2), format, default())
    }

    #[test]
    fn eight_bits_stay_as_they_are() {
        let Texels::Srgb8(texels) = texture("", &image(TextureFormat::Rgba8UnormSrgb, &[1, 2, 3, 4])).unwrap().texels
        else {
            panic!("sRGB became linear")
        };
        assert_eq!(texels, [[1, 2, 3, 4]; 2]);
        let Texels::Linear8(texels) = texture("", &image(TextureFormat::Bgra8Unorm, &[1, 2, 3, 4])).unwrap().texels
        else {
            panic!("linear became sRGB")
        };
        assert_eq!(texels, [[3, 2, 1, 4]; 2]);
    }

    #[test]
    fn other_formats_become_floats_or_say_why_not() {
        let bytes: Vec<u8> = [7.5_f32, 0.5, 0.25, 1.0].iter().flat_map(|number| number.to_le_bytes()).collect();
        let Texels::Linear32(texels) = texture("", &image(TextureFormat::Rgba32Float, &bytes)).unwrap().texels else {
            panic!("floats became bytes")
        };
        assert_eq!(texels, [[7.5, 0.5, 0.25, 1.0]; 2]);
        // Bevy takes 16 bits for linear. The darkest of them is darker than the first step of 8 linear bits.
        for linear in [0.002_f32, 0.1, 0.5, 1.0] {
            let bits = ((linear * 65535.0) as u16).to_le_bytes();
            let texture = texture("", &image(TextureFormat::Rgba16Unorm, &bits.repeat(4))).unwrap();
            let sampled = texture.sample(Vec2::splat(0.5)).x;
            assert!((sampled - linear).abs() < 0.02 * linear.max(0.01), "{sampled} for {linear}");
        }
        let error = texture("", &image(TextureFormat::Rgb9e5Ufloat, &[0; 4])).unwrap_err();
        assert!(error.contains("Rgb9e5Ufloat") && error.contains("PNG"), "{error}");
        let mut gone = image(TextureFormat::Rgba8Unorm, &[0; 4]);
        gone.data = None;
        assert!(texture("", &gone).is_err());
    }

    #[test]
    fn samplers_say_how_pictures_are_filtered() {
        let mut picture = image(TextureFormat::Rgba8Unorm, &[0; 4]);
        assert_eq!(texture("", &picture).unwrap().filter, Filter::Linear);
        for (sampler, expected) in
            [(ImageSampler::nearest(), Filter::Nearest), (ImageSampler::linear(), Filter::Linear)]
        {
            picture.sampler = sampler;
            assert_eq!(texture("", &picture).unwrap().filter, expected);
        }
    }

    /// 4 pi lumens are one candela, for points and, as in Bevy, for spots; colors are linear.
    #[test]
    fn lumens_become_candela() {
        let color = Color::linear_rgb(1.0, 0.5, 0.25);
        let at = placed(Transform::from_xyz(1.0, 2.0, 3.0).looking_to(Vec3::X, Vec3::Y).with_scale(Vec3::splat(2.0)));
        let point = PointLight { color, intensity: 4.0 * PI, range: 7.0, radius: 0.1, ..default() };
        let LightSource::Point(point) = point_light(&point, &at) else { panic!("not a point") };
        assert!(point.intensity.abs_diff_eq(Vec3::new(1.0, 0.5, 0.25), 1e-6));
        assert_eq!((point.position, point.range, point.radius), (Vec3::new(1.0, 2.0, 3.0), 7.0, 0.1));
        let spot = SpotLight { color, intensity: 4.0 * PI, inner_angle: 0.2, outer_angle: 0.4, ..default() };
        let LightSource::Spot(spot) = spot_light(&spot, &at) else { panic!("not a spot") };
        assert!(spot.point.intensity.abs_diff_eq(point.intensity, 1e-6) && spot.direction.abs_diff_eq(Vec3::X, 1e-6));
        assert_eq!((spot.inner_angle, spot.outer_angle), (0.2, 0.4));
    }

    /// A rectangle of area A and radiance L sends out pi A L lumens, towards -Z, whatever its scale.
    #[test]
    fn rectangles_send_out_their_lumens() {
        let light = RectLight { color: Color::WHITE, intensity: 600.0, width: 2.0, height: 1.0, range: 9.0 };
        let at = placed(
            Transform::from_xyz(0.0, 3.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::X).with_scale(Vec3::new(1.5, 2.0, 1.0)),
        );
        let LightSource::Rect(rect) = rect_light(&light, &at) else { panic!("not a rectangle") };
        let normal = rect.half_width.cross(rect.half_height);
        assert!(normal.normalize().abs_diff_eq(Vec3::NEG_Y, 1e-6));
        assert!((4.0 * normal.length() - 6.0).abs() < 1e-5, "3 m x 2 m");
        assert!((PI * 6.0 * rect.radiance.x - 600.0).abs() < 1e-2);
    }

    #[test]
    fn materials_keep_what_a_bake_needs() {
        let texture = Handle::<Image>::default();
        let gltf = GltfMaterial {
            base_color: Color::linear_rgba(0.2, 0.4, 0.6, 0.8),
            metallic: 0.3,
            emissive: LinearRgba::new(2.0, 3.0, 4.0, 100.0),
            emissive_texture: Some(texture.clone()),
            emissive_channel: UvChannel::Uv1,
            alpha_mode: AlphaMode::Mask(0.4),
            double_sided: true,
            uv_transform: Affine2::from_scale(Vec2::splat(3.0)),
            ..default()
        };
        let inputs = MaterialInputs::from(&gltf);
        assert!(inputs.reads_uv_1 && !inputs.unlit);
        let core = material("paint", &inputs, |_| Some(5));
        assert!(core.base_color.abs_diff_eq(Vec4::new(0.2, 0.4, 0.6, 0.8), 1e-6));
        assert_eq!((core.metallic, core.emissive, core.double_sided), (0.3, Vec3::new(2.0, 3.0, 4.0), true));
        assert_eq!((core.alpha, core.base_color_texture.is_none()), (material::AlphaMode::Mask(0.4), true));
        let emissive = core.emissive_texture.unwrap();
        assert_eq!((emissive.texture, emissive.uv_set), (5, UvSet::Uv1));
        assert_eq!(emissive.transform.transform_point2(Vec2::ONE), Vec2::splat(3.0));
        // A picture that cannot be read leaves the factor.
        assert!(super::material("paint", &inputs, |_| None).emissive_texture.is_none());
    }

    /// Glass keeps its color and what it absorbs: after the attenuation distance its color is left. Smooth metal keeps its
    /// roughness. What multiplies the picture is glass.
    #[test]
    fn materials_keep_mirrors_and_glass() {
        let gltf = GltfMaterial {
            base_color: Color::linear_rgba(0.2, 0.4, 0.6, 0.5),
            metallic: 1.0,
            perceptual_roughness: 0.05,
            specular_transmission: 0.9,
            thickness: 0.02,
            attenuation_color: Color::linear_rgb(0.5, 0.25, 1.0),
            attenuation_distance: 0.1,
            ..default()
        };
        let core = |gltf: &GltfMaterial| material("glass", &MaterialInputs::from(gltf), |_| None);
        let glass = core(&gltf);
        assert_eq!((glass.metallic, glass.roughness, glass.transmission, glass.thickness), (1.0, 0.05, 0.9, 0.02));
        assert!(glass.transmittance(0.1).abs_diff_eq(Vec3::new(0.5, 0.25, 1.0), 1e-5));
        assert!(glass.may_be_mirror() && !core(&GltfMaterial::default()).may_be_mirror());
        let thin = core(&GltfMaterial { thickness: 0.0, ..gltf.clone() });
        assert_eq!(thin.absorption, Vec3::ZERO);
        let filter = core(&GltfMaterial { alpha_mode: AlphaMode::Multiply, ..gltf });
        assert_eq!((filter.transmission, filter.alpha), (1.0, material::AlphaMode::Opaque));
        assert!(filter.base_color.abs_diff_eq(Vec4::new(0.6, 0.7, 0.8, 1.0), 1e-6));
        assert_eq!(filter.opacity_at(&[], Vec2::NAN, Vec2::NAN, Vec4::ONE), 0.0);
    }

    /// What is blended holds back a part of the light, what is added or multiplied none of it.
    #[test]
    fn glass_lets_light_through() {
        let opacity = |alpha_mode| {
            let glass = GltfMaterial { base_color: Color::srgba(1.0, 1.0, 1.0, 0.4), alpha_mode, ..default() };
            let core = material("glass", &MaterialInputs::from(&glass), |_| None);
            assert_eq!(core.is_opaque(), alpha_mode == AlphaMode::Opaque);
            core.opacity_at(&[], Vec2::NAN, Vec2::NAN, Vec4::ONE)
        };
        for mode in [AlphaMode::Blend, AlphaMode::Premultiplied, AlphaMode::AlphaToCoverage] {
            assert_eq!(opacity(mode), 0.4, "{mode:?}");
        }
        assert_eq!([AlphaMode::Add, AlphaMode::Multiply].map(opacity), [0.0; 2]);
    }
}
