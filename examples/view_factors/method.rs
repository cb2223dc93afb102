//! The methods to choose from, each one call of the core.

use glam::{DVec3, Vec3};
use radiosity::form_factor::{
    Estimate, double_integral, polygon_to_polygon, visible_polygon_to_polygon, visible_polygon_to_polygon_by_rays,
};
use radiosity::geometry::BruteForce;

use crate::geometry::{Cutting, Geometry};
use crate::polygon::{Polygon, fan, single};
use crate::rows::{Rows, hemicube_rows, nusselt_rows};

/// How the share of the power leaving one polygon that reaches another is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// `Contour` for an open view, else `Clipping`.
    Auto,
    /// Around both edges: exact for an open view.
    Contour,
    /// Over both areas: for an open view.
    DoubleIntegral,
    /// Over one area, with what is hidden of the other cut out exactly.
    Clipping,
    /// The share of point pairs that see each other, times the exact value of the open view.
    Rays,
    /// All others drawn onto half a cube, at many points.
    Hemicube,
    /// The share of cosine-weighted rays that hit.
    NusseltRays,
}

/// All of them, with their names on the command line.
pub const METHODS: [(&str, Method); 7] = [
    ("auto", Method::Auto),
    ("contour", Method::Contour),
    ("double-integral", Method::DoubleIntegral),
    ("clipping", Method::Clipping),
    ("rays", Method::Rays),
    ("hemicube", Method::Hemicube),
    ("nusselt-rays", Method::NusseltRays),
];

/// What [`polygon_to_polygon`] promises.
const CONTOUR_ERROR: f64 = 1e-12;

/// The share of what leaves one polygon that reaches another, past blockers and with an accuracy.
type Share = fn(&Polygon, &Polygon, &[&[DVec3]], f64) -> Estimate<f64>;

/// What a method is asked.
pub enum Way {
    /// One pair after the other.
    Pairs(Share),
    /// All pairs at once, with an accuracy.
    Rows(fn(&Geometry, f64) -> Rows),
}

impl Method {
    /// The method of a name on the command line.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = METHODS.iter().find(|(known, _)| *known == name);
        let names = || METHODS.map(|(known, _)| known).join(", ");
        found.map(|&(_, method)| method).ok_or_else(|| format!("{name} is no method; there are {}", names()))
    }

    pub fn name(self) -> &'static str {
        METHODS.iter().find(|&&(_, method)| method == self).map_or("", |(name, _)| name)
    }

    /// Whether what stands between two polygons makes a difference.
    pub fn sees_blockers(self) -> bool {
        !matches!(self, Method::Contour | Method::DoubleIntegral)
    }

    /// How surfaces become parts.
    pub fn cutting(self) -> Cutting {
        match self.way() {
            Way::Pairs(_) => Cutting::Signed,
            Way::Rows(_) => Cutting::Disjoint,
        }
    }

    pub fn way(self) -> Way {
        match self {
            Method::Auto => Way::Pairs(|a, b, blockers, accuracy| match blockers {
                [] => contour(a, b),
                _ => visible_polygon_to_polygon(&a.corners, &b.corners, blockers, accuracy),
            }),
            Method::Contour => Way::Pairs(|a, b, _, _| contour(a, b)),
            Method::DoubleIntegral => Way::Pairs(|a, b, _, accuracy| double_integral(&a.corners, &b.corners, accuracy)),
            Method::Clipping => Way::Pairs(|a, b, blockers, accuracy| {
                visible_polygon_to_polygon(&a.corners, &b.corners, blockers, accuracy)
            }),
            Method::Rays => Way::Pairs(rays),
            Method::Hemicube => Way::Rows(hemicube_rows),
            Method::NusseltRays => Way::Rows(nusselt_rows),
        }
    }
}

fn contour(a: &Polygon, b: &Polygon) -> Estimate<f64> {
    Estimate { value: polygon_to_polygon(&a.corners, &b.corners), error: CONTOUR_ERROR }
}

fn rays(a: &Polygon, b: &Polygon, blockers: &[&[DVec3]], accuracy: f64) -> Estimate<f64> {
    let triangles: Vec<[Vec3; 3]> = blockers.iter().flat_map(|blocker| fan(&single(blocker))).collect();
    let [a, b] = [a, b].map(|polygon| single(&polygon.corners));
    // Accuracy and error are both four standard errors.
    let found = visible_polygon_to_polygon_by_rays(&a, &b, &BruteForce(triangles), accuracy as f32);
    Estimate { value: found.value.into(), error: found.error.into() }
}
