//! Shapes of triangles with a normal at each corner.

use std::f32::consts::TAU;

use bevy::math::{Affine3A, Vec2, Vec3};

/// Triangles, counter-clockwise seen from the front.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// In meters.
    pub positions: Vec<Vec3>,
    /// One for each position, of length 1.
    pub normals: Vec<Vec3>,
    /// Indices into the positions.
    pub triangles: Vec<[u32; 3]>,
}

impl Shape {
    /// A flat quadrilateral.
    pub fn quad(corners: [Vec3; 4]) -> Self {
        let normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalize();
        Self { positions: corners.to_vec(), normals: vec![normal; 4], triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    /// A box, seen from outside.
    pub fn cuboid(low: impl Into<Vec3>, high: impl Into<Vec3>) -> Self {
        let (low, high) = (low.into(), high.into());
        let middle = low.midpoint(high);
        let half = 0.5 * (high - low);
        let faces = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
        Self::joined(faces.map(|normal| {
            let side = half * Vec3::new(normal.y, normal.z, normal.x).abs();
            let up = normal.cross(side).normalize().abs() * half;
            let up = if side.cross(up).dot(normal) > 0.0 { up } else { -up };
            let center = middle + half * normal;
            Self::quad([center - side - up, center + side - up, center + side + up, center - side + up])
        }))
    }

    /// A wall from `origin`, `length` along `along` and `height` upwards, without its `openings`; each is given by its
    /// lower left and its upper right corner. Its front is the side from which `along` runs to the right.
    pub fn wall(origin: Vec3, along: Vec3, length: f32, height: f32, openings: &[[Vec2; 2]]) -> Self {
        let cuts = |end: f32, axis: usize| {
            let mut cuts = vec![0.0, end];
            cuts.extend(openings.iter().flatten().map(|corner| corner[axis]));
            cuts.sort_by(f32::total_cmp);
            cuts.dedup();
            cuts
        };
        let (us, vs) = (cuts(length, 0), cuts(height, 1));
        let mut wall = Self::grid(us.len() - 1, vs.len() - 1, |column, row| {
            (origin + us[column] * along + vs[row] * Vec3::Y, along.cross(Vec3::Y))
        });
        let is_open = |triangle: &[u32; 3]| {
            let middle = triangle.iter().map(|&vertex| wall.positions[vertex as usize]).sum::<Vec3>() / 3.0 - origin;
            let point = Vec2::new(middle.dot(along), middle.y);
            openings.iter().any(|[low, high]| point.cmpgt(*low).all() && point.cmplt(*high).all())
        };
        wall.triangles = wall.triangles.iter().copied().filter(|triangle| !is_open(triangle)).collect();
        wall
    }

    /// The four sides of an opening whose corners run counter-clockwise seen from inside, `depth` through the wall.
    pub fn reveal(corners: [Vec3; 4], depth: Vec3) -> Self {
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            Self::quad([a, b, b + depth, a + depth])
        };
        Self::joined((0..4).map(side))
    }

    /// A cylinder of this many sides that stands on `foot`, with smooth sides, a top and a bottom.
    pub fn cylinder(foot: impl Into<Vec3>, radius: f32, height: f32, sides: usize) -> Self {
        Self::cone(foot, [radius, radius], height, sides)
    }

    /// A cut cone of this many sides that stands on `foot`; its two radii are those below and above.
    pub fn cone(foot: impl Into<Vec3>, [below, above]: [f32; 2], height: f32, sides: usize) -> Self {
        let foot = foot.into();
        let slope = (below - above) / height;
        let around = |column: usize| {
            Vec3::new((TAU * column as f32 / sides as f32).cos(), 0.0, -(TAU * column as f32 / sides as f32).sin())
        };
        let mantle = Self::grid(sides, 1, |column, row| {
            let radius = if row == 0 { below } else { above };
            let outward = around(column % sides);
            (foot + radius * outward + row as f32 * height * Vec3::Y, (outward + slope * Vec3::Y).normalize())
        });
        let ring =
            |y: f32, radius: f32| (0..sides).map(move |column| foot + y * Vec3::Y + radius * around(column)).collect();
        let [top, mut bottom]: [Vec<Vec3>; 2] = [ring(height, above), ring(0.0, below)];
        bottom.reverse();
        Self::joined([mantle, Self::polygon(&top), Self::polygon(&bottom)])
    }

    /// A flat convex polygon.
    pub fn polygon(corners: &[Vec3]) -> Self {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let triangles = (2..corners.len() as u32).map(|i| [0, i - 1, i]).collect();
        Self { positions: corners.to_vec(), normals: vec![normal; corners.len()], triangles }
    }

    /// A polygon in the plane of `x` and `y`, swept along `depth`: both ends and the sides. Seen from `+z` it runs
    /// counter-clockwise; `depth` points to `-z`.
    pub fn prism(faces: &[Vec<Vec3>], outline: &[Vec3], depth: Vec3) -> Self {
        let front = faces.iter().map(|face| Self::polygon(face));
        let back = faces.iter().map(|face| {
            let moved: Vec<Vec3> = face.iter().rev().map(|&corner| corner + depth).collect();
            Self::polygon(&moved)
        });
        let sides = (0..outline.len()).map(|i| {
            let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
            Self::quad([a, a + depth, b + depth, b])
        });
        Self::joined(front.chain(back).chain(sides))
    }

    /// A lamp bulb or a fruit: an octahedron whose faces are cut into `cuts` squared parts, blown up to a ball.
    pub fn ball(center: impl Into<Vec3>, radius: f32, cuts: usize) -> Self {
        let center = center.into();
        let mut ball = Self::default();
        let signs = [1.0, -1.0];
        for (x, y, z) in signs.into_iter().flat_map(|x| signs.into_iter().flat_map(move |y| signs.map(|z| (x, y, z)))) {
            let corners = [x * Vec3::X, y * Vec3::Y, z * Vec3::Z];
            let first = ball.positions.len() as u32;
            for row in 0..=cuts {
                for column in 0..=cuts - row {
                    let share = Vec3::new((cuts - row - column) as f32, column as f32, row as f32);
                    let normal = (corners[0] * share.x + corners[1] * share.y + corners[2] * share.z).normalize();
                    ball.positions.push(center + radius * normal);
                    ball.normals.push(normal);
                }
            }
            let at = |column: usize, row: usize| {
                first + (row * (cuts + 1) - row * row.saturating_sub(1) / 2 + column) as u32
            };
            for row in 0..cuts {
                for column in 0..cuts - row {
                    ball.triangles.push([at(column, row), at(column + 1, row), at(column, row + 1)]);
                    if column + 1 < cuts - row {
                        ball.triangles.push([at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)]);
                    }
                }
            }
            if x * y * z < 0.0 {
                let turned = ball.triangles.iter_mut().filter(|triangle| triangle[0] >= first);
                turned.for_each(|triangle| triangle.swap(1, 2));
            }
        }
        ball
    }

    /// A mesh of `columns` x `rows` quadrilaterals; `vertex` gives position and normal at a crossing. Its front is the
    /// side from which columns run to the right and rows up.
    pub fn grid(columns: usize, rows: usize, vertex: impl Fn(usize, usize) -> (Vec3, Vec3)) -> Self {
        let places = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row)));
        let (positions, normals) = places.map(|(column, row)| vertex(column, row)).unzip();
        let mut grid = Self { positions, normals, triangles: Vec::new() };
        for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
            let a = (row * (columns + 1) + column) as u32;
            let c = a + columns as u32 + 1;
            grid.triangles.extend([[a, a + 1, c + 1], [a, c + 1, c]]);
        }
        // Where an edge is collapsed to a point, half of its triangles are.
        let size = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).length();
        let positions = &grid.positions;
        grid.triangles.retain(|triangle| size(triangle.map(|vertex| positions[vertex as usize])) > 1e-9);
        grid
    }

    /// All in one.
    pub fn joined(shapes: impl IntoIterator<Item = Self>) -> Self {
        shapes.into_iter().fold(Self::default(), |mut all, shape| {
            let first = all.positions.len() as u32;
            all.positions.extend(shape.positions);
            all.normals.extend(shape.normals);
            all.triangles.extend(shape.triangles.into_iter().map(|triangle| triangle.map(|vertex| first + vertex)));
            all
        })
    }

    /// At another place. `transform` moves, turns and stretches all directions alike.
    pub fn placed(mut self, transform: Affine3A) -> Self {
        self.positions.iter_mut().for_each(|position| *position = transform.transform_point3(*position));
        self.normals.iter_mut().for_each(|normal| *normal = transform.transform_vector3(*normal).normalize());
        self
    }

    /// Seen from the other side.
    pub fn turned(mut self) -> Self {
        self.normals.iter_mut().for_each(|normal| *normal = -*normal);
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        self
    }
}
