//! How near a thing is: one number for its place in the order.

use glam::Vec3;

/// What counts as near. All depths are in the unit of the coordinates, and larger where something is nearer; what lies
/// at the eye has depth 0, what lies in front of it a negative one.
///
/// ```
/// use glam::Vec3;
/// use radiosity::composite::{BoxPoint, ViewDepth};
///
/// let camera = ViewDepth::Radial { eye: Vec3::ZERO };
/// assert_eq!(camera.of_point(Vec3::new(3.0, 0.0, -4.0)), -5.0);
/// let [low, high] = [Vec3::new(-1.0, -1.0, -6.0), Vec3::new(1.0, 1.0, -4.0)];
/// assert_eq!(camera.of_box(low, high, BoxPoint::Nearest), -4.0);
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

impl ViewDepth {
    /// The depth of a point.
    pub fn of_point(&self, point: Vec3) -> f32 {
        match *self {
            Self::Planar { eye, forward } => (eye - point).dot(forward),
            Self::Radial { eye } => -eye.distance(point),
            Self::Axis { axis } => point.dot(axis),
        }
    }

    /// The depth of a point of the box between two corners, `low` not above `high`.
    pub fn of_box(&self, low: Vec3, high: Vec3, point: BoxPoint) -> f32 {
        let (center, half) = ((low + high) * 0.5, (high - low) * 0.5);
        let reach = match *self {
            Self::Radial { eye } => return -eye.distance(of_box_to(eye, [low, high], point)),
            Self::Planar { forward, .. } => forward.abs().dot(half),
            Self::Axis { axis } => axis.abs().dot(half),
        };
        match point {
            BoxPoint::Center => self.of_point(center),
            BoxPoint::Nearest => self.of_point(center) + reach,
            BoxPoint::Farthest => self.of_point(center) - reach,
        }
    }
}

fn of_box_to(eye: Vec3, [low, high]: [Vec3; 2], point: BoxPoint) -> Vec3 {
    let center = (low + high) * 0.5;
    match point {
        BoxPoint::Center => center,
        BoxPoint::Nearest => eye.clamp(low, high),
        BoxPoint::Farthest => Vec3::select(eye.cmplt(center), high, low),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The extreme points of a box are its extreme points: nothing of a fine grid of them is nearer or farther.
    #[test]
    fn boxes_by_all_their_points() {
        let (low, high) = (Vec3::new(-1.0, 2.0, -7.0), Vec3::new(3.0, 2.5, -3.0));
        let forward = Vec3::new(0.48, -0.6, -0.64);
        for eye in [Vec3::ZERO, Vec3::new(1.0, 2.2, -5.0), Vec3::new(9.0, -3.0, -9.0)] {
            for depth in
                [ViewDepth::Planar { eye, forward }, ViewDepth::Radial { eye }, ViewDepth::Axis { axis: forward }]
            {
                let (mut nearest, mut farthest) = (f32::NEG_INFINITY, f32::INFINITY);
                for k in 0..21 * 21 * 21 {
                    let share = Vec3::new((k % 21) as f32, (k / 21 % 21) as f32, (k / 441) as f32) / 20.0;
                    let found = depth.of_point(low + (high - low) * share);
                    (nearest, farthest) = (nearest.max(found), farthest.min(found));
                }
                let [by_nearest, by_farthest] =
                    [BoxPoint::Nearest, BoxPoint::Farthest].map(|point| depth.of_box(low, high, point));
                assert!(by_nearest >= nearest - 1e-5 && by_nearest <= nearest + 0.1, "{by_nearest} {nearest}");
                assert!((by_farthest - farthest).abs() < 1e-5, "{by_farthest} {farthest}");
                let center = depth.of_box(low, high, BoxPoint::Center);
                assert_eq!(center, depth.of_point((low + high) / 2.0));
            }
        }
    }
}
