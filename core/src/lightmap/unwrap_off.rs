//! Stands in for unwrapping in builds without the feature `unwrap`.

use alloc::string::String;

use glam::Vec3;

use super::chart::Charts;
use super::layout::LayoutError;
use crate::progress::Cancelled;

/// Refuses.
///
/// # Errors
///
/// Always: this build cannot unwrap.
pub(super) fn unwrap(
    _positions: &[Vec3],
    _triangles: &[[u32; 3]],
    _advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Charts, LayoutError> {
    let reason = String::from("this build cannot unwrap it, because the feature `unwrap` of the crate is off");
    Err(LayoutError::UnusableUv { mesh: String::new(), reason })
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use glam::{Affine3A, Vec2};

    use super::*;
    use crate::geometry::Mesh;
    use crate::lightmap::{LayoutSettings, layout};
    use crate::progress::Progress;
    use crate::scene::{Receiver, Scene, Surface};

    /// A mesh with coordinates is laid out in any build; one without is refused with the feature that it takes.
    #[test]
    fn says_which_feature_is_missing() {
        let corners = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let mut mesh = Mesh {
            name: "quad".into(),
            positions: corners.iter().map(|corner| corner.extend(0.0)).collect(),
            uv_1: corners,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        let surface = Surface {
            name: "wall".into(),
            mesh: 0,
            material: 0,
            transform: Affine3A::IDENTITY,
            receiver: Receiver::Lightmap { density: 1.0 },
            casts: true,
        };
        let scene =
            |mesh: &Mesh| Scene { meshes: vec![mesh.clone()], surfaces: vec![surface.clone()], ..Scene::default() };
        let lay_out = |mesh: &Mesh| layout(&scene(mesh), &LayoutSettings::default(), &Progress::with_clock(|| 0.0));
        assert!(lay_out(&mesh).unwrap().placements[0].is_some());
        mesh.uv_1.clear();
        let Err(LayoutError::UnusableUv { mesh, reason }) = lay_out(&mesh) else { panic!("nothing refused") };
        assert_eq!(mesh, "quad");
        assert!(reason.contains("`unwrap`"), "{reason}");
    }
}
