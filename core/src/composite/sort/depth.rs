//! How near a thing is: one number for its place in the order.

use glam::Vec3;

/// What counts as near. All depths are in the unit of the coordinates, and larger where something is nearer; what lies
/// at the eye has depth 0, what lies in front of it a negative one.
///
/// ```
/// use glam::Vec3;
/// use radiosity::composite::{Bounds, BoxPoint, ViewDepth};
///
/// let camera = ViewDepth::Radial { eye: Vec3::ZERO };
/// assert_eq!(camera.of_point(Vec3::new(3.0, 0.0, -4.0)), -5.0);
/// let bounds = Bounds { center: Vec3::new(0.0, 0.0, -5.0), half_axes: [Vec3::X, Vec3::Y, Vec3::Z] };
/// assert_eq!(camera.of_bounds(&bounds, BoxPoint::Nearest), -4.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViewDepth {
    /// The distance from the plane through the eye: what a depth buffer measures. Turning the camera changes the order.
    Planar {
        /// Where the camera is.
        eye: Vec3,
        /// Where it looks, of length 1.
        forward: Vec3,
    },
    /// The distance from the eye: turning the camera changes nothing.
    Radial {
        /// Where the camera is.
        eye: Vec3,
    },
    /// The position along an axis, whatever the camera does: for layered worlds seen from one side.
    Axis {
        /// Towards what is drawn last, of length 1.
        axis: Vec3,
    },
}

/// Which point of a box stands for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BoxPoint {
    /// Its center.
    #[default]
    Center,
    /// The one nearest to the eye: large things are drawn after small ones that they contain.
    Nearest,
    /// The one farthest from the eye: large things are drawn before small ones in front of them.
    Farthest,
}

/// A box that may be turned: the points `center` + Σ s half_axis with every s in -1..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Its middle.
    pub center: Vec3,
    /// From its middle to the middles of three of its sides.
    pub half_axes: [Vec3; 3],
}

impl ViewDepth {
    /// The depth of a point.
    pub fn of_point(&self, point: Vec3) -> f32 {
        match *self {
            Self::Planar { eye, forward } => (eye - point).dot(forward),
            Self::Radial { eye } => -eye.distance(point),
            Self::Axis { axis } => point.dot(axis),
        }
    }

    /// The depth of a point of a box.
    ///
    /// For [`ViewDepth::Radial`] the nearest point is exact where the axes are perpendicular to each other; in a sheared box
    /// it is one of its points that may lie farther away.
    pub fn of_bounds(&self, bounds: &Bounds, point: BoxPoint) -> f32 {
        let towards = match *self {
            Self::Radial { eye } => return -eye.distance(bounds.seen_from(eye, point)),
            Self::Planar { forward, .. } => forward,
            Self::Axis { axis } => axis,
        };
        let reach: f32 = bounds.half_axes.iter().map(|axis| axis.dot(towards).abs()).sum();
        match point {
            BoxPoint::Center => self.of_point(bounds.center),
            BoxPoint::Nearest => self.of_point(bounds.center) + reach,
            BoxPoint::Farthest => self.of_point(bounds.center) - reach,
        }
    }
}

impl Bounds {
    fn seen_from(&self, eye: Vec3, point: BoxPoint) -> Vec3 {
        let to_eye = eye - self.center;
        let shares = self.half_axes.map(|axis| match (to_eye.dot(axis), point) {
            (_, BoxPoint::Center) => 0.0,
            (along, BoxPoint::Nearest) => (along / axis.length_squared().max(f32::MIN_POSITIVE)).clamp(-1.0, 1.0),
            (along, BoxPoint::Farthest) => {
                if along > 0.0 {
                    -1.0
                } else {
                    1.0
                }
            }
        });
        self.half_axes.iter().zip(shares).fold(self.center, |sum, (&axis, share)| sum + axis * share)
    }
}

#[cfg(test)]
mod tests {
    use glam::{EulerRot, Quat};

    use super::*;

    /// The extreme points of a box are its extreme points: nothing of a fine grid of them is nearer or farther.
    #[test]
    fn boxes_by_all_their_points() {
        let turned = Quat::from_euler(EulerRot::XYZ, 0.4, -0.7, 1.1);
        let half_axes = [Vec3::X * 2.0, Vec3::Y * 0.25, Vec3::Z * 2.0].map(|axis| turned * axis);
        let bounds = Bounds { center: Vec3::new(1.0, 2.25, -5.0), half_axes };
        let forward = Vec3::new(0.48, -0.6, -0.64);
        for eye in [Vec3::ZERO, Vec3::new(1.0, 2.2, -5.0), Vec3::new(9.0, -3.0, -9.0)] {
            for depth in
                [ViewDepth::Planar { eye, forward }, ViewDepth::Radial { eye }, ViewDepth::Axis { axis: forward }]
            {
                let (mut nearest, mut farthest) = (f32::NEG_INFINITY, f32::INFINITY);
                for k in 0..21 * 21 * 21 {
                    let shares = [k % 21, k / 21 % 21, k / 441].map(|k| k as f32 / 10.0 - 1.0);
                    let point = half_axes.iter().zip(shares).fold(bounds.center, |sum, (&axis, s)| sum + axis * s);
                    let found = depth.of_point(point);
                    (nearest, farthest) = (nearest.max(found), farthest.min(found));
                }
                let [by_nearest, by_farthest] =
                    [BoxPoint::Nearest, BoxPoint::Farthest].map(|point| depth.of_bounds(&bounds, point));
                assert!(by_nearest >= nearest - 1e-5 && by_nearest <= nearest + 0.1, "{by_nearest} {nearest}");
                assert!((by_farthest - farthest).abs() < 1e-5, "{by_farthest} {farthest}");
                assert_eq!(depth.of_bounds(&bounds, BoxPoint::Center), depth.of_point(bounds.center));
            }
        }
    }
}
