//! The surfaces of an input as polygons that see and block one another, and how results are put together from them.

use crate::flaw::Flaw;
use crate::polygon::{Outline, Polygon, outline};
use crate::vs3::{Input, Kind, Surface};

/// How far a part may stand off its base, as a share of its own radius, before that is a mistake.
const OFF_BASE: f64 = 1e-5;

/// All polygons of an input, and the surfaces to report.
#[derive(Debug, Default)]
pub struct Geometry {
    /// What exchanges heat, with weights in [`Reported`].
    pub parts: Vec<Piece>,
    /// What blocks the view between parts: whole surfaces.
    pub blockers: Vec<Piece>,
    /// What only blocks, less what lies on it: for methods that look from one part at all others.
    pub obstacles: Vec<Polygon>,
    pub reported: Vec<Reported>,
    pub warnings: Vec<Flaw>,
}

/// How a surface with others on it becomes parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cutting {
    /// Exchange is additive: what leaves a wall with a window in it is what leaves the whole rectangle less what leaves
    /// the window. So the wall has two parts, with weights 1 and -1.
    Signed,
    /// The wall is cut into convex pieces around the window, so that no part lies on another.
    Disjoint,
}

/// A polygon and the surface that it is cut from: the one at the end of all bases.
#[derive(Debug)]
pub struct Piece {
    pub polygon: Polygon,
    pub root: usize,
}

impl Piece {
    /// It lies on the other one, as a window lies in a wall.
    pub fn lies_on(&self, other: &Piece) -> bool {
        let margin = OFF_BASE * self.polygon.radius;
        let height = |&corner| other.polygon.height(corner).abs();
        self.root == other.root && self.polygon.corners.iter().map(height).fold(0.0, f64::max) <= margin
    }
}

/// A surface with a row of its own in the result.
#[derive(Debug)]
pub struct Reported {
    /// Numbers in the input of all that is combined into it, itself first.
    pub numbers: Vec<usize>,
    pub name: String,
    /// Of what radiates; masked parts count.
    pub area: f64,
    /// Mean over the area.
    pub emissivity: f64,
    /// Which parts it consists of, and with which sign.
    pub weights: Vec<(usize, f64)>,
    /// Reported surfaces that cover an area of it from close by, and that area.
    pub masks: Vec<(usize, f64)>,
}

/// Checks the polygons and sorts out what each of them does.
pub fn geometry(input: &Input, cutting: Cutting) -> Result<Geometry, Flaw> {
    let mut geometry = Geometry::default();
    let outlines = outlines(&input.surfaces, &mut geometry.warnings)?;
    let surfaces = Surfaces { given: &input.surfaces, outlines: &outlines };
    surfaces.check()?;
    let parts = geometry.add_polygons(&surfaces, cutting);
    geometry.report(&surfaces, &parts, cutting);
    geometry.add_masks(&surfaces);
    Ok(geometry)
}

/// The polygons of each surface.
fn outlines(surfaces: &[Surface], warnings: &mut Vec<Flaw>) -> Result<Vec<Outline>, Flaw> {
    let mut outlines = Vec::new();
    for surface in surfaces {
        let named = |what: String| Flaw::new(surface.line, format!("surface {} {what}", surface.number));
        let mut outline = outline(&surface.corners).map_err(named)?;
        warnings.extend(outline.remark.take().map(named));
        outlines.push(outline);
    }
    Ok(outlines)
}

impl Geometry {
    /// Sorts polygons into parts and what blocks; returns the parts of each surface.
    fn add_polygons(&mut self, surfaces: &Surfaces, cutting: Cutting) -> Vec<Vec<usize>> {
        let mut parts = Vec::new();
        for surface in surfaces.given {
            let root = surfaces.root(surface);
            let piece = |polygon| Piece { polygon, root };
            if surface.base == 0 {
                self.blockers.extend(surfaces.polygons(surface).iter().cloned().map(piece));
            }
            let first = self.parts.len();
            match (surface.kind, cutting) {
                (Kind::Obstruction, _) => self.obstacles.extend(surfaces.bare(surface)),
                (Kind::Radiating, Cutting::Disjoint) => {
                    self.parts.extend(surfaces.bare(surface).into_iter().map(piece))
                }
                (Kind::Radiating, Cutting::Signed) => {
                    self.parts.extend(surfaces.polygons(surface).iter().cloned().map(piece));
                }
                // What a mask hides of its base faces as the base does.
                (_, Cutting::Signed) => {
                    self.parts.extend(surfaces.polygons(surface).iter().map(Polygon::turned).map(piece));
                }
                (_, Cutting::Disjoint) => self.obstacles.extend(surfaces.polygons(surface).iter().cloned()),
            }
            parts.push((first..self.parts.len()).collect());
        }
        parts
    }

    /// Makes one reported surface of all that are combined.
    fn report(&mut self, surfaces: &Surfaces, parts: &[Vec<usize>], cutting: Cutting) {
        let has_row =
            |surface: &&Surface| matches!(surface.kind, Kind::Radiating | Kind::Mask) && surface.combined_with == 0;
        for first in surfaces.given.iter().filter(has_row) {
            let is_member = |other: &&Surface| other.number == first.number || other.combined_with == first.number;
            let members: Vec<&Surface> = surfaces.given.iter().filter(is_member).collect();
            let areas: Vec<f64> = members.iter().map(|member| surfaces.area(member)).collect();
            let area: f64 = areas.iter().sum();
            let emitted: f64 = members.iter().zip(&areas).map(|(member, area)| member.emissivity * area).sum();
            if members.iter().any(|member| member.emissivity != first.emissivity) {
                let what = format!("surface {} is combined of several emissivities; their mean is taken", first.number);
                self.warnings.push(Flaw::new(first.line, what));
            }
            self.reported.push(Reported {
                numbers: members.iter().map(|member| member.number).collect(),
                name: first.name.clone(),
                area,
                emissivity: emitted / area,
                weights: members.iter().flat_map(|member| surfaces.weights(member, parts, cutting)).collect(),
                masks: Vec::new(),
            });
        }
    }

    /// A mask takes the light of the area below it, and gives all of its own to it.
    fn add_masks(&mut self, surfaces: &Surfaces) {
        let row_of = |rows: &[Reported], number: usize| rows.iter().position(|row| row.numbers.contains(&number));
        for mask in surfaces.given.iter().filter(|surface| surface.kind == Kind::Mask) {
            if let (Some(row), Some(base)) = (row_of(&self.reported, mask.number), row_of(&self.reported, mask.base)) {
                let area = surfaces.area(mask);
                self.reported[base].masks.push((row, area));
                self.reported[row].masks.push((base, area));
            }
        }
    }
}

/// The entries of the input, and their polygons in the same order.
struct Surfaces<'a> {
    given: &'a [Surface],
    outlines: &'a [Outline],
}

impl<'a> Surfaces<'a> {
    fn polygons(&self, surface: &Surface) -> &'a [Polygon] {
        &self.outlines[surface.number - 1].parts
    }

    /// All that lies directly on a surface.
    fn on(&self, base: usize) -> impl Iterator<Item = &'a Surface> {
        self.given.iter().filter(move |other| other.base == base)
    }

    fn root(&self, surface: &Surface) -> usize {
        let mut root = surface;
        while root.base > 0 {
            root = &self.given[root.base - 1];
        }
        root.number
    }

    /// The polygons of a surface less those of what lies on it.
    fn bare(&self, surface: &Surface) -> Vec<Polygon> {
        let mut pieces = self.polygons(surface).to_vec();
        for other in self.on(surface.number) {
            for hole in self.polygons(other) {
                let hole = if hole.normal.dot(pieces[0].normal) < 0.0 { hole.turned() } else { hole.clone() };
                pieces = pieces.iter().flat_map(|piece| piece.without(&hole)).collect();
            }
            if pieces.is_empty() {
                break;
            }
        }
        pieces
    }

    /// Which parts a surface consists of: itself less what lies on it. A mask sees nothing but its base.
    fn weights(&self, surface: &Surface, parts: &[Vec<usize>], cutting: Cutting) -> Vec<(usize, f64)> {
        if surface.kind == Kind::Mask {
            return Vec::new();
        }
        let weighted =
            |surface: &Surface, weight: f64| parts[surface.number - 1].iter().map(move |&part| (part, weight));
        let own = weighted(surface, 1.0);
        match cutting {
            Cutting::Signed => own.chain(self.on(surface.number).flat_map(|other| weighted(other, -1.0))).collect(),
            Cutting::Disjoint => own.collect(),
        }
    }

    fn whole(&self, surface: &Surface) -> f64 {
        self.polygons(surface).iter().map(|polygon| polygon.area).sum()
    }

    /// Without the surfaces on it that have an area of their own, and without what is cut out.
    fn area(&self, surface: &Surface) -> f64 {
        let takes_area = |other: &&Surface| other.kind != Kind::Mask;
        let taken: f64 = self.on(surface.number).filter(takes_area).map(|other| self.whole(other)).sum();
        self.whole(surface) - taken
    }

    /// What lies on a surface lies in it, faces the right way and overlaps nothing else there.
    fn check(&self) -> Result<(), Flaw> {
        self.given.iter().filter(|surface| surface.base > 0).try_for_each(|surface| {
            let base = self.polygons(&self.given[surface.base - 1]);
            let named = |what| Flaw::new(surface.line, format!("surface {} {what}", surface.number));
            self.check_part(surface, base).map_err(named)
        })?;
        let is_covered =
            |surface: &&Surface| surface.kind == Kind::Radiating && self.area(surface) <= 1e-9 * self.whole(surface);
        match self.given.iter().find(is_covered) {
            Some(Surface { line, number, .. }) => {
                let what = format!("nothing is left of surface {number} under what lies on it");
                Err(Flaw::new(*line, format!("{what}; make it an obstruction `O`")))
            }
            None => Ok(()),
        }
    }

    fn check_part(&self, surface: &Surface, base: &[Polygon]) -> Result<(), String> {
        let own = self.polygons(surface);
        let is_turned = own[0].normal.dot(base[0].normal) < 0.0;
        match surface.kind {
            Kind::Radiating if is_turned => {
                return Err(format!("faces away from its base {}; reverse the order of its corners", surface.base));
            }
            Kind::Mask | Kind::Null if !is_turned => {
                return Err(format!("faces as its base {} does; reverse the order of its corners", surface.base));
            }
            _ => {}
        }
        let lies_in = |part: &Polygon| base.iter().any(|base| base.contains(part, OFF_BASE * part.radius));
        if !own.iter().all(lies_in) {
            return Err(format!("is not within its base {}, or not in its plane; correct its corners", surface.base));
        }
        let overlaps = |other: &&Surface| {
            let others = self.polygons(other);
            own.iter().any(|part| others.iter().any(|other| part.overlaps(other, OFF_BASE * part.radius)))
        };
        let mut before = self.on(surface.base).take_while(|other| other.number < surface.number);
        match before.find(overlaps) {
            Some(other) => {
                Err(format!("overlaps surface {}, which lies on the same base; separate them", other.number))
            }
            None => Ok(()),
        }
    }
}
