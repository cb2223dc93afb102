//! Reads the input format of View3D: what its manual describes in section 5, as facts.
//!
//! | line | what it says |
//! |---|---|
//! | `T text` | title |
//! | `C name=value ...` | control: `eps`, `encl`, `emit`, `list`, `row`, `col`, and what only View3D needs |
//! | `F 3` or `F 3a` | corners by vertex number, or each surface in a plane of its own |
//! | `V n x y z` | vertex |
//! | `S n v1 v2 v3 v4 base cmb emit name` | surface, counter-clockwise from its front; `v4` is 0 for a triangle |
//! | `M ...`, `N ...` | a part of the surface `base` that faces it closely, or that is not there |
//! | `O n v1 v2 v3 v4` | blocks the view, and has no row of its own |
//! | `! ...`, `/ ...` | comment |
//! | `E ...` or `*` | end; what follows is not read |
//!
//! With `F 3a` the corners of an entry are replaced by a shape, `R`, `Q` or `T`, and the next lines hold
//! `x y z azimuth tilt` of its plane and either width and height, or the corners in that plane.

use glam::DVec3;

use crate::flaw::Flaw;
use crate::lines::{Fields, Line, lines};
use crate::plane::{Shape, corners_in_plane};

/// A geometry and what is asked about it.
#[derive(Debug, Default)]
pub struct Input {
    pub title: String,
    pub control: Control,
    pub vertices: usize,
    /// In the order of their numbers, which start at 1.
    pub surfaces: Vec<Surface>,
    /// What was understood otherwise than it may have been meant.
    pub warnings: Vec<Flaw>,
}

/// What the `C` lines ask for.
#[derive(Debug, Default)]
pub struct Control {
    /// `eps`: how exact a view factor shall be.
    pub accuracy: Option<f64>,
    /// `encl`: the surfaces enclose a space, so rows shall sum to 1.
    pub is_enclosure: bool,
    /// `emit`: gray surfaces, that is Hottel's total exchange besides the view factors.
    pub is_gray: bool,
    /// `list`: how much to print.
    pub list: usize,
    /// `row`: the only surface to compute, or 0.
    pub row: usize,
    /// `col`: the only surface that it looks at, or 0.
    pub column: usize,
}

/// What a surface does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// `S`: exchanges heat.
    Radiating,
    /// `M`: faces its base closely, so that this part of it sees nothing else.
    Mask,
    /// `N`: takes this part out of its base.
    Null,
    /// `O`: only blocks.
    Obstruction,
}

/// One entry of the geometry.
#[derive(Clone, Debug)]
pub struct Surface {
    pub line: usize,
    /// Counted from 1.
    pub number: usize,
    pub kind: Kind,
    /// 3 or 4, counter-clockwise from the front.
    pub corners: Vec<DVec3>,
    /// The surface that this is a part of, or 0.
    pub base: usize,
    /// The surface that this is reported with, or 0.
    pub combined_with: usize,
    /// In `[0, 1]`.
    pub emissivity: f64,
    pub name: String,
}

const VERTEX: &str = "V number x y z";
const SURFACE: &str = "S number v1 v2 v3 v4 base cmb emit name";
const PLANE: &str = "S number R|Q|T base cmb emit name, then x y z azimuth tilt and the shape";

/// Where the corners of a surface come from.
enum Outline {
    Vertices([usize; 4]),
    Corners(Vec<DVec3>),
}

/// What has been read so far.
#[derive(Default)]
struct Draft {
    input: Input,
    vertices: Vec<DVec3>,
    outlines: Vec<Outline>,
    in_planes: bool,
}

/// Reads a whole file. The corners are known afterwards; whether they make sense is not.
pub fn parse(text: &str) -> Result<Input, Flaw> {
    let mut draft = Draft::default();
    let mut lines = lines(text);
    let end = loop {
        match lines.next() {
            Some(line) if matches!(line.letter(), 'E' | '*') => break true,
            Some(line) => draft.read(&line, &mut lines)?,
            None => break false,
        }
    };
    if !end {
        let last = text.lines().count();
        draft.warn(last, "the file has no end line; check that it is whole, and add `End of data`");
    }
    draft.finish()
}

impl Draft {
    fn read<'a>(&mut self, line: &Line<'a>, more: &mut impl Iterator<Item = Line<'a>>) -> Result<(), Flaw> {
        match line.letter() {
            'T' => self.input.title = line.rest().into(),
            'C' => self.control(line)?,
            'F' => self.in_planes = format(line)?,
            'V' => self.vertex(line)?,
            'S' => self.surface(Kind::Radiating, line, more)?,
            'M' => self.surface(Kind::Mask, line, more)?,
            'N' => self.surface(Kind::Null, line, more)?,
            'O' => self.surface(Kind::Obstruction, line, more)?,
            'X' => self.warn(line.number, "coordinates are taken as they are, as View3D does; this line is not read"),
            _ => {
                let what = format!("`{}` starts no entry; this line is not read", line.words[0]);
                self.warn(line.number, &what);
            }
        }
        Ok(())
    }

    fn warn(&mut self, line: usize, what: &str) {
        self.input.warnings.push(Flaw::new(line, what));
    }

    fn vertex(&mut self, line: &Line) -> Result<(), Flaw> {
        let mut fields = line.fields(VERTEX);
        fields.number("vertex", self.vertices.len() + 1)?;
        let [x, y, z] = ["x", "y", "z"].map(|axis| fields.real(&format!("coordinate {axis}")));
        self.vertices.push(DVec3::new(x?, y?, z?));
        Ok(())
    }

    fn control(&mut self, line: &Line) -> Result<(), Flaw> {
        let told = line.words[1..].join(" ");
        let words: Vec<&str> = told.split(['=', ' ']).filter(|word| !word.is_empty()).collect();
        for pair in words.chunks(2) {
            let mut value = Fields::of(line.number, "C name=value name=value ...", pair[1..].to_vec());
            let control = &mut self.input.control;
            match pair[0].to_ascii_lowercase().as_str() {
                "eps" => control.accuracy = Some(positive(&mut value, "eps")?),
                "encl" => control.is_enclosure = value.index("encl")? != 0,
                "emit" => control.is_gray = value.index("emit")? != 0,
                "list" => control.list = value.index("list")?,
                "row" => control.row = value.index("row")?,
                "col" => control.column = value.index("col")?,
                "maxu" | "maxo" | "mino" | "maxv" | "prjd" | "out" => {}
                other => self.warn(line.number, &format!("`{other}` is no control word; it is not read")),
            }
        }
        Ok(())
    }

    fn surface<'a>(
        &mut self,
        kind: Kind,
        line: &Line<'a>,
        more: &mut impl Iterator<Item = Line<'a>>,
    ) -> Result<(), Flaw> {
        let mut fields = line.fields(if self.in_planes { PLANE } else { SURFACE });
        let number = fields.number("surface", self.outlines.len() + 1)?;
        let (outline, mut surface) = if self.in_planes {
            let shape = shape(&mut fields)?;
            let surface = properties(kind, number, &mut fields)?;
            (Outline::Corners(corners(shape, &mut fields, more)?), surface)
        } else {
            let vertices = ["first", "second", "third", "fourth"].map(|name| fields.index(&format!("{name} vertex")));
            let [a, b, c, d] = vertices;
            (Outline::Vertices([a?, b?, c?, d?]), properties(kind, number, &mut fields)?)
        };
        surface.line = line.number;
        self.outlines.push(outline);
        self.input.surfaces.push(surface);
        Ok(())
    }

    fn finish(mut self) -> Result<Input, Flaw> {
        self.input.vertices = self.vertices.len();
        for (surface, outline) in self.input.surfaces.iter_mut().zip(self.outlines) {
            surface.corners = match outline {
                Outline::Corners(corners) => corners,
                Outline::Vertices(numbers) => resolve(surface, numbers, &self.vertices)?,
            };
        }
        let surfaces = &self.input.surfaces;
        if !surfaces.iter().any(|surface| surface.kind == Kind::Radiating) {
            return Err(Flaw::new(1, format!("there is no surface; write `{SURFACE}`")));
        }
        surfaces.iter().try_for_each(|surface| check_references(surface, surfaces))?;
        check_selection(&self.input)?;
        Ok(self.input)
    }
}

fn format(line: &Line) -> Result<bool, Flaw> {
    match line.words.get(1).map(|word| word.to_ascii_lowercase()).as_deref() {
        Some("3") => Ok(false),
        Some("3a") => Ok(true),
        _ => Err(Flaw::new(line.number, "the geometry is not one in space; write `F 3` or `F 3a`")),
    }
}

fn positive(value: &mut Fields, name: &str) -> Result<f64, Flaw> {
    let number = value.real(name)?;
    let flaw = || Flaw::new(value.line, format!("{name} is {number}; give a number above 0, such as 1e-6"));
    (number > 0.0).then_some(number).ok_or_else(flaw)
}

fn shape(fields: &mut Fields) -> Result<Shape, Flaw> {
    let word = fields.word("shape")?;
    match word.chars().next().map(|c| c.to_ascii_uppercase()) {
        Some('R') => Ok(Shape::Rectangle),
        Some('Q') => Ok(Shape::Polygon(4)),
        Some('T') => Ok(Shape::Polygon(3)),
        _ => Err(Flaw::new(fields.line, format!("the shape is `{word}`; write R, Q or T"))),
    }
}

/// What follows the corners in an entry: nothing for an obstruction.
fn properties(kind: Kind, number: usize, fields: &mut Fields) -> Result<Surface, Flaw> {
    let mut surface = Surface {
        line: fields.line,
        number,
        kind,
        corners: Vec::new(),
        base: 0,
        combined_with: 0,
        emissivity: 1.0,
        name: format!("surface-{number}"),
    };
    if kind == Kind::Obstruction {
        return Ok(surface);
    }
    surface.base = fields.index("base surface")?;
    surface.combined_with = fields.index("surface to combine with")?;
    surface.emissivity = fields.real("emissivity")?;
    if fields.left() > 0 {
        surface.name = fields.word("name")?.into();
    }
    if !(0.0..=1.0).contains(&surface.emissivity) {
        let what = format!("the emissivity of surface {number} is {}; give one from 0 to 1", surface.emissivity);
        return Err(Flaw::new(fields.line, what));
    }
    Ok(surface)
}

/// Reads the lines that follow an entry with a shape, as many as it takes.
fn corners<'a>(
    shape: Shape,
    header: &mut Fields<'a>,
    more: &mut impl Iterator<Item = Line<'a>>,
) -> Result<Vec<DVec3>, Flaw> {
    let mut fields = Fields::of(header.line, PLANE, Vec::new());
    while fields.left() < shape.numbers() {
        let starts_entry = |line: &Line| line.words[0].starts_with(|c: char| c.is_ascii_alphabetic() || c == '*');
        let Some(line) = more.next().filter(|line| !starts_entry(line)) else {
            let what = format!("the plane and the shape take {} numbers, not {}", shape.numbers(), fields.left());
            return Err(Flaw::new(fields.line, format!("{what}; write `{PLANE}`")));
        };
        fields.extend(&line);
    }
    let numbers = (0..shape.numbers()).map(|_| fields.real("plane or shape")).collect::<Result<Vec<f64>, Flaw>>()?;
    Ok(corners_in_plane(shape, &numbers))
}

fn resolve(surface: &Surface, numbers: [usize; 4], vertices: &[DVec3]) -> Result<Vec<DVec3>, Flaw> {
    let count = if numbers[3] == 0 { 3 } else { 4 };
    let vertex = |&number: &usize| {
        let known = format!("the vertices are numbered 1 to {}", vertices.len());
        let what = format!("surface {} has a corner at vertex {number}, but {known}", surface.number);
        let flaw = Flaw::new(surface.line, format!("{what}; correct the number or add the vertex"));
        number.checked_sub(1).and_then(|index| vertices.get(index)).copied().ok_or(flaw)
    };
    numbers[..count].iter().map(vertex).collect()
}

/// Bases and combinations point at surfaces that can be one.
fn check_references(surface: &Surface, surfaces: &[Surface]) -> Result<(), Flaw> {
    let number = surface.number;
    let flaw = |what: String| Err(Flaw::new(surface.line, what));
    let kind_of = |other: usize| other.checked_sub(1).and_then(|index| surfaces.get(index)).map(|other| other.kind);
    match (surface.base, kind_of(surface.base), surface.kind) {
        (0, _, Kind::Mask | Kind::Null) => {
            return flaw(format!("surface {number} covers a part of another one; give that one's number as its base"));
        }
        (0, ..) | (_, Some(Kind::Obstruction), Kind::Radiating) => {}
        (base, Some(Kind::Radiating), _) if base < number => {}
        (base, ..) => {
            return flaw(format!(
                "surface {number} lies on {base}; the base has to be a surface `S` with a lower number"
            ));
        }
    }
    match (surface.combined_with, kind_of(surface.combined_with), surface.kind) {
        (0, ..) => Ok(()),
        (with, Some(Kind::Radiating), Kind::Radiating) if with < number && surfaces[with - 1].combined_with == 0 => {
            Ok(())
        }
        (with, ..) => flaw(format!(
            "surface {number} is combined with {with}; only surfaces `S` are, all with the one of the lowest number"
        )),
    }
}

fn check_selection(input: &Input) -> Result<(), Flaw> {
    let Control { row, column, .. } = input.control;
    let is_reported = |number: usize| {
        let kind = number.checked_sub(1).and_then(|index| input.surfaces.get(index)).map(|surface| surface.kind);
        number == 0 || matches!(kind, Some(Kind::Radiating | Kind::Mask))
    };
    if !is_reported(row) || !is_reported(column) {
        return Err(Flaw::new(
            1,
            format!("there is no result for row={row} col={column}; give numbers of surfaces `S`"),
        ));
    }
    if column != 0 && row == 0 {
        return Err(Flaw::new(1, format!("col={column} needs a row; write `C row=1 col={column}`")));
    }
    Ok(())
}
