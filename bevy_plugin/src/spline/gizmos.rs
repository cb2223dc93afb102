//! Control points, knots and frames as lines.

use bevy::color::palettes::basic::{BLUE, GREEN, RED};
use bevy::gizmos::config::GizmoConfigGroup;
use bevy::prelude::*;
use radiosity::spline::Direction;

use super::{ControlNet, SplineCurve, SplineMesh, SplinePath, SplineSurface};

/// Draws the control points, the knots and the frames of the curve or the surface on this entity.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component, Default)]
pub struct SplineGizmo {
    /// Of control points and the lines between them; `Color::NONE` draws none.
    pub polygon: Color,
    /// Of the places on a curve, and the lines on a surface, at which polynomials join.
    pub knots: Color,
    /// How many frames there are along a curve: its direction blue, its normal green, the third one red.
    pub frames: usize,
    /// Of crosses and frames, in meters.
    pub size: f32,
}

impl Default for SplineGizmo {
    fn default() -> Self {
        Self { polygon: Color::srgb(1.0, 0.7, 0.1), knots: Color::srgb(0.2, 0.8, 1.0), frames: 16, size: 0.05 }
    }
}

/// How the lines look: its `GizmoConfig` sets their width and whether they shine through.
#[derive(Default, Reflect, GizmoConfigGroup)]
pub struct SplineGizmos;

/// Draws every [`SplineGizmo`].
#[derive(Clone, Copy, Debug, Default)]
pub struct SplineGizmoPlugin;

impl Plugin for SplineGizmoPlugin {
    fn build(&self, app: &mut App) {
        app.init_gizmo_group::<SplineGizmos>()
            .add_systems(PostUpdate, (draw_curves, draw_surfaces).after(TransformSystems::Propagate));
    }
}

/// Points that a line joins, in the space of the spline.
type Line = (Vec<Vec3>, Color);

fn draw_curves(
    mut gizmos: Gizmos<SplineGizmos>,
    curves: Query<(&SplineGizmo, &SplineCurve, &SplinePath, &GlobalTransform)>,
) {
    for (gizmo, curve, path, transform) in &curves {
        draw(&mut gizmos, transform, gizmo.of_curve(curve, path));
    }
}

fn draw_surfaces(
    mut gizmos: Gizmos<SplineGizmos>,
    surfaces: Query<(&SplineGizmo, &SplineSurface, &SplineMesh, &GlobalTransform)>,
) {
    for (gizmo, surface, mesh, transform) in &surfaces {
        draw(&mut gizmos, transform, gizmo.of_surface(surface, mesh));
    }
}

fn draw(gizmos: &mut Gizmos<SplineGizmos>, transform: &GlobalTransform, lines: Vec<Line>) {
    for (points, color) in lines {
        gizmos.linestrip(points.into_iter().map(|point| transform.transform_point(point)), color);
    }
}

impl SplineGizmo {
    fn of_curve(&self, curve: &SplineCurve, path: &SplinePath) -> Vec<Line> {
        let (nurbs, mut polygon) = (curve.nurbs(), curve.points.clone());
        if nurbs.as_ref().is_ok_and(|nurbs| nurbs.curve().is_closed()) {
            polygon.extend(curve.points.first());
        }
        let mut lines = vec![(polygon, self.polygon)];
        lines.extend(curve.points.iter().flat_map(|&point| self.cross(point, self.polygon)));
        if let Ok(nurbs) = &nurbs {
            let nurbs = nurbs.curve();
            let knots = nurbs.knots();
            let breaks = knots.spans().map(|span| knots.knots()[span]).chain([knots.domain()[1]]);
            lines.extend(breaks.flat_map(|t| self.cross(nurbs.point(t), self.knots)));
        }
        for frame in path.evenly(self.frames) {
            let axes = [(frame.binormal, RED), (frame.normal, GREEN), (frame.tangent, BLUE)];
            lines.extend(axes.map(|(axis, color)| (vec![frame.point, frame.point + self.size * axis], color.into())));
        }
        lines
    }

    fn of_surface(&self, surface: &SplineSurface, mesh: &SplineMesh) -> Vec<Line> {
        let mut lines = match surface {
            SplineSurface::Net(net) => self.of_net(net),
            SplineSurface::Revolution { profile: curve, .. } | SplineSurface::Extrusion { curve, .. } => {
                self.of_curve(curve, &SplinePath::default())
            }
            SplineSurface::Ruled { first, last } => {
                [first, last].into_iter().flat_map(|curve| self.of_curve(curve, &SplinePath::default())).collect()
            }
            SplineSurface::Loft { curves, .. } => {
                curves.iter().flat_map(|curve| self.of_curve(curve, &SplinePath::default())).collect()
            }
            SplineSurface::Coons { edges } => {
                edges.iter().flat_map(|curve| self.of_curve(curve, &SplinePath::default())).collect()
            }
        };
        lines.extend(self.knot_lines(mesh));
        lines
    }

    /// Along the rows and the columns of a net.
    fn of_net(&self, net: &ControlNet) -> Vec<Line> {
        let columns = net.knots[0].len().saturating_sub(net.degrees[0] + 1).max(1);
        let rows = net.points.chunks(columns).map(<[Vec3]>::to_vec);
        let columns = (0..columns).map(|i| net.points.iter().skip(i).step_by(columns).copied().collect());
        rows.chain(columns).map(|points| (points, self.polygon)).collect()
    }

    /// Where polynomials join on the surface that the mesh was made from.
    fn knot_lines(&self, mesh: &SplineMesh) -> Vec<Line> {
        const STEPS: usize = 48;
        let surface = mesh.surface();
        let domain = surface.domain();
        let lines = [Direction::U, Direction::V].into_iter().flat_map(|across| {
            let knots = surface.knots(across);
            let breaks = knots.spans().map(move |span| knots.knots()[span]).chain([knots.domain()[1]]);
            let [start, end] = domain[1 - across as usize];
            breaks.map(move |t| {
                let at = |k: usize| start + (end - start) * k as f32 / STEPS as f32;
                (0..=STEPS)
                    .map(|k| match across {
                        Direction::U => surface.point(t, at(k)),
                        Direction::V => surface.point(at(k), t),
                    })
                    .collect::<Vec<_>>()
            })
        });
        lines.map(|points| (points, self.knots)).collect()
    }

    fn cross(&self, point: Vec3, color: Color) -> [Line; 3] {
        Vec3::AXES.map(|axis| (vec![point - 0.5 * self.size * axis, point + 0.5 * self.size * axis], color))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As many lines as the shape has points and knots, all of them on it.
    #[test]
    fn lines_are_where_the_shape_is() {
        let gizmo = SplineGizmo { frames: 5, ..default() };
        let curve = SplineCurve::open(2, vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Z]);
        let path = SplinePath::new(&curve).unwrap();
        let lines = gizmo.of_curve(&curve, &path);
        // The polygon, a cross of three lines for four points and three knots, five frames of three.
        assert_eq!(lines.len(), 1 + 3 * 4 + 3 * 3 + 3 * 5);
        let ring = SplineCurve::closed(2, vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Z]);
        let lines = gizmo.of_curve(&ring, &SplinePath::default());
        assert_eq!(lines[0].0, [Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Z, Vec3::ZERO], "it comes back");
        let net = ControlNet::bezier(3, (0..9).map(|i| Vec3::new((i % 3) as f32, 0.0, (i / 3) as f32)).collect());
        assert_eq!(gizmo.of_net(&net).len(), 6);
    }
}
