//! Planar convex polygons, and how any triangle or quadrilateral becomes one or two of them.

use glam::{DVec3, Vec3};

/// Corners that stand further from their plane than this share of the radius are split into triangles.
const FLAT: f64 = 1e-6;

/// Less than this share of an area is what rounding leaves.
const NOTHING: f64 = 1e-12;

/// Convex, planar, counter-clockwise from its front.
#[derive(Clone, Debug)]
pub struct Polygon {
    pub corners: Vec<DVec3>,
    /// Of length 1; where the front faces.
    pub normal: DVec3,
    /// Mean of the corners.
    pub center: DVec3,
    /// Distance from the center to the farthest corner.
    pub radius: f64,
    pub area: f64,
}

impl Polygon {
    pub fn new(corners: Vec<DVec3>) -> Self {
        let center = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        let twice_area = twice_area(&corners);
        let radius = corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        let area = 0.5 * twice_area.length();
        Self { normal: twice_area.normalize_or_zero(), center, radius, area, corners }
    }

    /// The same polygon, seen from behind.
    pub fn turned(&self) -> Self {
        Self::new(self.corners.iter().rev().copied().collect())
    }

    /// How far a point stands in front of the plane.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.center)
    }

    /// Some corner of the other one stands in front, by more than what rounding may do.
    pub fn faces(&self, other: &Polygon) -> bool {
        let margin = FLAT * self.radius.max(other.radius);
        other.corners.iter().any(|&corner| self.height(corner) > margin)
    }

    /// Each edge from corner to corner.
    pub fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        (0..self.corners.len()).map(|i| (self.corners[i], self.corners[(i + 1) % self.corners.len()]))
    }

    /// The other one lies within this one and its plane, up to `margin`.
    pub fn contains(&self, other: &Polygon, margin: f64) -> bool {
        let is_inside = |&corner: &DVec3| {
            let inward = |(from, to): (DVec3, DVec3)| self.normal.cross((to - from).normalize_or_zero());
            self.height(corner).abs() <= margin && self.edges().all(|edge| inward(edge).dot(corner - edge.0) >= -margin)
        };
        other.corners.iter().all(is_inside)
    }

    /// Both lie in one plane and have more than `margin` of their insides in common: no edge separates them.
    pub fn overlaps(&self, other: &Polygon, margin: f64) -> bool {
        let separates = |one: &Polygon, other: &Polygon| {
            one.edges().any(|(from, to)| {
                let outward = (to - from).normalize_or_zero().cross(one.normal);
                other.corners.iter().all(|&corner| outward.dot(corner - from) >= -margin)
            })
        };
        !separates(self, other) && !separates(other, self)
    }
}

impl Polygon {
    /// What is left of this one around another one that lies in it: convex pieces.
    pub fn without(&self, hole: &Polygon) -> Vec<Polygon> {
        let mut pieces = Vec::new();
        let mut rest = self.corners.clone();
        for (from, to) in hole.edges() {
            let inward = self.normal.cross(to - from);
            pieces.push(Polygon::new(beyond(&rest, from, -inward)));
            rest = beyond(&rest, from, inward);
        }
        pieces.retain(|piece| piece.area > NOTHING * self.area);
        pieces
    }
}

/// The corners in single precision, for what works with rays and pixels.
pub fn single(corners: &[DVec3]) -> Vec<Vec3> {
    corners.iter().map(|corner| corner.as_vec3()).collect()
}

/// The triangles of a convex polygon.
pub fn fan<V: Copy>(corners: &[V]) -> Vec<[V; 3]> {
    corners[1..].windows(2).map(|edge| [corners[0], edge[0], edge[1]]).collect()
}

/// The part of a convex polygon on the side of a point to which the direction shows.
fn beyond(corners: &[DVec3], point: DVec3, direction: DVec3) -> Vec<DVec3> {
    let height = |corner: DVec3| direction.dot(corner - point);
    let mut part = Vec::new();
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % corners.len()];
        let (low, high) = (height(from), height(to));
        if low >= 0.0 {
            part.push(from);
        }
        if low * high < 0.0 {
            part.push(from.lerp(to, low / (low - high)));
        }
    }
    part
}

/// What a list of corners describes.
#[derive(Debug)]
pub struct Outline {
    /// One polygon, or two triangles.
    pub parts: Vec<Polygon>,
    /// Why it is not the one polygon that the user meant.
    pub remark: Option<String>,
}

/// Checks the corners of a triangle or quadrilateral and cuts it in two where it is not convex or not planar.
pub fn outline(corners: &[DVec3]) -> Result<Outline, String> {
    let distinct = without_repeats(corners);
    let whole = Polygon::new(distinct.clone());
    if distinct.len() < 3 || !whole.area.is_finite() || whole.area <= NOTHING * whole.radius * whole.radius {
        return Err(
            "has no area: its corners coincide, stand in a line or are listed crosswise; correct or delete it".into()
        );
    }
    let repeated = (distinct.len() < corners.len()).then(|| "has a corner twice; it is taken as a triangle".into());
    if distinct.len() == 3 {
        return Ok(Outline { parts: vec![whole], remark: repeated });
    }
    let reflex: Vec<usize> = (0..4).filter(|&i| turn(&distinct, i).dot(whole.normal) < -NOTHING * whole.area).collect();
    let bend = distinct.iter().map(|&corner| whole.height(corner).abs()).fold(0.0, f64::max) / whole.radius;
    match reflex[..] {
        [] if bend <= FLAT => Ok(Outline { parts: vec![whole], remark: None }),
        [] => Ok(cut(&distinct, shorter_diagonal(&distinct), format!("is not planar (by {bend:.1e} of its radius)"))),
        [corner] => Ok(cut(&distinct, corner, "is not convex".into())),
        _ => Err("has edges that cross; list its corners counter-clockwise as seen from its front".into()),
    }
}

/// Cuts a quadrilateral along the diagonal from a corner.
fn cut(corners: &[DVec3], from: usize, why: String) -> Outline {
    let triangle = |steps: [usize; 3]| Polygon::new(steps.map(|step| corners[(from + step) % 4]).to_vec());
    let parts = vec![triangle([0, 1, 2]), triangle([0, 2, 3])];
    Outline { parts, remark: Some(format!("{why}; it is taken as two triangles")) }
}

fn shorter_diagonal(corners: &[DVec3]) -> usize {
    usize::from(corners[1].distance(corners[3]) < corners[0].distance(corners[2]))
}

/// Twice the area of the triangle at a corner, along its normal.
fn turn(corners: &[DVec3], i: usize) -> DVec3 {
    let [before, here, after] = [i + 3, i, i + 1].map(|k| corners[k % 4]);
    (here - before).cross(after - here)
}

fn without_repeats(corners: &[DVec3]) -> Vec<DVec3> {
    let mut distinct = corners.to_vec();
    distinct.dedup();
    if distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    distinct
}

/// The vector area, times two: exact for planar polygons, the mean for bent ones.
fn twice_area(corners: &[DVec3]) -> DVec3 {
    let origin = corners.first().copied().unwrap_or_default();
    corners.windows(2).map(|edge| (edge[0] - origin).cross(edge[1] - origin)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(corners: [[f64; 3]; 4]) -> Result<Outline, String> {
        outline(&corners.map(DVec3::from_array))
    }

    #[test]
    fn a_square_is_one_polygon() {
        let square = quad([[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [0., 1., 0.]]).unwrap();
        assert!(square.remark.is_none());
        assert_eq!((square.parts[0].area, square.parts[0].normal), (2.0, DVec3::Z));
    }

    /// An arrowhead of area 1 is cut at its notch; its triangles have the same area and face the same way.
    #[test]
    fn a_notch_is_cut() {
        let arrow = quad([[0., 0., 0.], [2., -1., 0.], [1., 0., 0.], [2., 1., 0.]]).unwrap();
        assert!(arrow.remark.unwrap().contains("not convex"));
        assert_eq!(arrow.parts.iter().map(|part| part.area).sum::<f64>(), 1.0);
        assert!(arrow.parts.iter().all(|part| part.normal == DVec3::Z));
    }

    #[test]
    fn a_bent_quadrilateral_becomes_triangles() {
        let bent = quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.1], [0., 1., 0.]]).unwrap();
        assert_eq!(bent.parts.len(), 2);
        assert!(bent.remark.unwrap().contains("not planar"));
    }

    #[test]
    fn crossed_and_degenerate_ones_are_refused() {
        assert!(quad([[0., 0., 0.], [2., 1., 0.], [2., 0., 0.], [0., 2., 0.]]).unwrap_err().contains("cross"));
        assert!(quad([[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [3., 0., 0.]]).unwrap_err().contains("no area"));
    }

    #[test]
    fn a_repeated_corner_leaves_a_triangle() {
        let triangle = quad([[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 1., 0.]]).unwrap();
        assert_eq!((triangle.parts[0].corners.len(), triangle.parts[0].area), (3, 0.5));
    }

    #[test]
    fn overlap_is_more_than_a_common_edge() {
        let square = |x: f64| {
            Polygon::new([[x, 0., 0.], [x + 1., 0., 0.], [x + 1., 1., 0.], [x, 1., 0.]].map(DVec3::from_array).to_vec())
        };
        assert!(!square(0.0).overlaps(&square(1.0), 1e-9));
        assert!(square(0.0).overlaps(&square(0.9), 1e-9));
        assert!(square(0.0).contains(&square(0.0), 1e-9) && !square(0.0).contains(&square(0.1), 1e-9));
    }

    /// A window in a wall leaves four pieces, one in its corner two; nothing is lost.
    #[test]
    fn pieces_around_a_hole() {
        let rectangle = |[x0, x1, y0, y1]: [f64; 4]| {
            Polygon::new([[x0, y0, 0.], [x1, y0, 0.], [x1, y1, 0.], [x0, y1, 0.]].map(DVec3::from_array).to_vec())
        };
        let wall = rectangle([0.0, 4.0, 0.0, 3.0]);
        for (hole, count) in [([1.0, 2.0, 1.0, 2.0], 4), ([0.0, 2.0, 0.0, 2.0], 2), ([0.0, 4.0, 0.0, 3.0], 0)] {
            let hole = rectangle(hole);
            let pieces = wall.without(&hole);
            assert_eq!(pieces.len(), count);
            assert!((pieces.iter().map(|piece| piece.area).sum::<f64>() + hole.area - wall.area).abs() < 1e-12);
            assert!(pieces.iter().all(|piece| piece.normal == DVec3::Z && !piece.overlaps(&hole, 1e-9)));
        }
    }
}
