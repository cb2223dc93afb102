//! Replays the public inputs of View3D against exact values, and checks what the format can say.

use radiosity::form_factor::visible_polygon_to_polygon_by_rays;
use radiosity::geometry::BruteForce;

use crate::factors::ViewFactors;
use crate::flaw::Flaw;
use crate::method::{METHODS, Method};
use crate::polygon::{Polygon, fan, single};
use crate::solution::{Solution, solve};

const CUBE: &str = include_str!("cube.vs3");
const SQUARES: &str = include_str!("square_obstruction.vs3");
const L_ROOM: &str = include_str!("l_room.vs3");
const L_ROOM_IN_PLANES: &str = include_str!("l_room_in_planes.vs3");

/// Howell's catalogue, C-11 and C-14.
const OPPOSITE: f64 = 0.199_824_895_698_4;
const ADJACENT: f64 = 0.200_043_776_075_4;

/// All view factors of the L-shaped room, found another way: tanh-sinh quadrature of Lambert's sum over what each
/// point sees. Rows sum to 1 within 1e-13. Surfaces 4, 5 and 6 mirror 3, 2 and 1; 8 mirrors 7.
const L_ROOM_FACTORS: &str = "
0              .1131544143036 .3780928977993 .0274734057075 .0328902475631 .1823559036686 .1330165654789 .1330165654789
.3394632429107 0              .3189967014790 0              0              .0986707426893 .1214346564605 .1214346564605
.5671393466990 .1594983507395 0              0              0              .0412101085613 .1160760970001 .1160760970001
.0412101085613 0              0              0              .1594983507395 .5671393466990 .1160760970001 .1160760970001
.0986707426893 0              0              .3189967014790 0              .3394632429107 .1214346564605 .1214346564605
.1823559036686 .0328902475631 .0274734057075 .3780928977993 .1131544143036 0              .1330165654789 .1330165654789
.2394298178621 .0728607938763 .1392913164001 .1392913164001 .0728607938763 .2394298178621 0              .0968361437230
.2394298178621 .0728607938763 .1392913164001 .1392913164001 .0728607938763 .2394298178621 .0968361437230 0";

fn l_room_factors() -> Vec<Vec<f64>> {
    let row = |line: &str| line.split_whitespace().map(|word| word.parse().expect("a number")).collect();
    L_ROOM_FACTORS.trim().lines().map(row).collect()
}

/// What View3D 4.0 prints for the first row of that room.
const L_ROOM_VIEW3D: [f64; 8] = [0.0, 0.113_147, 0.378_091, 0.027_473, 0.032_905, 0.182_349, 0.133_016, 0.133_019];

fn solved(text: &str) -> Solution {
    solve(text, Method::Auto, Some(1e-9)).expect("a good input")
}

/// As the command line does it without options.
fn as_given(text: &str) -> Solution {
    solve(text, Method::Auto, None).expect("a good input")
}

fn refused(text: &str) -> Flaw {
    solve(text, Method::Auto, None).expect_err("a bad input")
}

/// `A_i F_ij`
fn exchange(solution: &Solution, i: usize, j: usize) -> f64 {
    solution.geometry.reported[i].area * solution.factors.factor(i, j)
}

/// At least 100 times closer to the truth than what View3D prints.
fn assert_beats(found: f64, printed: f64, exact: f64) {
    let (own, theirs) = ((found - exact).abs(), (printed - exact).abs());
    assert!(own <= 0.01 * theirs, "{found} is off by {own:.1e}, View3D by {theirs:.1e}");
}

#[test]
fn cube_against_view3d() {
    let cube = as_given(CUBE).closed.expect("an enclosure");
    for i in 0..6 {
        for j in (0..6).filter(|&j| j != i) {
            match i % 3 == j % 3 {
                true => assert_beats(cube.factor(i, j), 0.199_825, OPPOSITE),
                false => assert_beats(cube.factor(i, j), 0.200_044, ADJACENT),
            }
        }
    }
}

/// Of each line between the squares a quarter is hidden, in every direction; the surface between them faces the upper
/// one only, of which it is seen as a quarter of a square of the same size at half the distance (C-11).
#[test]
fn square_obstruction_against_view3d() {
    let squares = as_given(SQUARES);
    assert_beats(squares.factors.factor(0, 1), 0.149_870, 0.75 * OPPOSITE);
    assert!((squares.factors.factor(2, 1) - 0.415_253_283_577_1).abs() < 1e-12);
    assert_eq!((squares.factors.factor(0, 2), squares.factors.row_sum(0)), (0.0, squares.factors.factor(0, 1)));
}

#[test]
fn l_room_against_view3d() {
    let exact = l_room_factors();
    for text in [L_ROOM, L_ROOM_IN_PLANES] {
        let room = as_given(text).closed.expect("an enclosure");
        for j in 1..8 {
            assert_beats(room.factor(0, j), L_ROOM_VIEW3D[j], exact[0][j]);
        }
    }
}

/// Every entry of the room, and the estimate of its errors, before rows are scaled.
#[test]
fn l_room_against_another_way() {
    for text in [L_ROOM, L_ROOM_IN_PLANES] {
        let room = solved(text).factors;
        for (i, exact) in l_room_factors().iter().enumerate() {
            let error: f64 = room.row(i).iter().zip(exact).map(|(found, exact)| (found - exact).abs()).sum();
            assert!(error < 5e-9, "row {i}: {error:.1e}, estimated {:.1e}", room.errors[i]);
        }
    }
}

/// Both descriptions put the same vertices into the same surfaces.
#[test]
fn planes_and_vertices_describe_the_same_room() {
    let [by_vertices, in_planes] = [L_ROOM, L_ROOM_IN_PLANES].map(solved);
    for (one, other) in by_vertices.input.surfaces.iter().zip(&in_planes.input.surfaces) {
        assert!(one.corners.iter().all(|corner| other.corners.contains(corner)), "surface {}", one.number);
        let turns = [one, other].map(|s| (s.corners[1] - s.corners[0]).cross(s.corners[2] - s.corners[1]).normalize());
        assert_eq!(turns[0], turns[1]);
    }
}

/// The errors of a row sum up to what is estimated for it, or to what was asked.
fn assert_within_errors(factors: &ViewFactors, exact: &[Vec<f64>], accuracy: f64, name: &str) {
    for (i, exact) in exact.iter().enumerate() {
        let error: f64 = factors.row(i).iter().zip(exact).map(|(found, exact)| (found - exact).abs()).sum();
        let allowed = factors.errors[i].max(accuracy * exact.len() as f64);
        assert!(error <= allowed, "{name}, row {i}: {error:.1e}, estimated {:.1e}", factors.errors[i]);
        assert!(factors.errors[i] < 0.3, "{name}, row {i}: {:.1e} is no estimate", factors.errors[i]);
    }
}

#[test]
fn every_method_within_its_error() {
    let exact = |i: usize, j: usize| {
        if i == j {
            0.0
        } else if i % 3 == j % 3 {
            OPPOSITE
        } else {
            ADJACENT
        }
    };
    let cube: Vec<Vec<f64>> = (0..6).map(|i| (0..6).map(|j| exact(i, j)).collect()).collect();
    for (name, method) in METHODS {
        let of_cube = solve(CUBE, method, Some(1e-3)).expect("a good input");
        assert_within_errors(&of_cube.factors, &cube, 1e-3, name);
        let of_room = solve(L_ROOM, method, Some(1e-3)).expect("a good input");
        let warnings = of_room.warnings.iter().filter(|warning| warning.what.contains("does not see")).count();
        assert_eq!(warnings, usize::from(!method.sees_blockers()));
        if method.sees_blockers() {
            assert_within_errors(&of_room.factors, &l_room_factors(), 1e-3, name);
        }
    }
}

/// The error of rays is what the core tells, at most what was asked for, and not hidden by rays that nobody needs.
#[test]
fn rays_stop_at_the_accuracy_asked_for() {
    const ACCURACY: f64 = 1.0 / 1024.0;
    let squares = solve(SQUARES, Method::Rays, Some(ACCURACY)).expect("a good input");
    let corners = |polygon: &Polygon| single(&polygon.corners);
    let [a, b] = [0, 1].map(|part| corners(&squares.geometry.parts[part].polygon));
    let between = fan(&corners(&squares.geometry.parts[2].polygon));
    let found = visible_polygon_to_polygon_by_rays(&a, &b, &BruteForce(between), ACCURACY as f32);
    assert!(f64::from(found.error) <= ACCURACY && found.error > 0.0, "{found:?}");
    assert_eq!((squares.factors.factor(0, 1), squares.factors.errors[0]), (found.value.into(), found.error.into()));
    assert!((squares.factors.factor(0, 1) - 0.75 * OPPOSITE).abs() <= squares.factors.errors[0]);
}

/// Rays and hemicubes see a wall in pieces around what lies on it; all others the whole less its parts.
#[test]
fn every_method_cuts_out_what_lies_on_a_base() {
    for entry in ["S 7 9 10 11 12  1 0 .5 hatch", "M 7 12 11 10 9  1 0 .5 mat", "N 7 12 11 10 9  1 0 .5 hole"] {
        let text = cube_with(entry).replace("encl=1", "encl=0");
        let exact = solved(&text).factors;
        let exact: Vec<Vec<f64>> = (0..exact.count).map(|i| exact.row(i).to_vec()).collect();
        for (name, method) in METHODS {
            let found = solve(&text, method, Some(1e-3)).expect("a good input");
            assert_within_errors(&found.factors, &exact, 1e-3, name);
        }
    }
}

/// Rows of gray surfaces in an enclosure sum to their emissivity, and `A_i F_ij` is symmetric.
#[test]
fn total_exchange_keeps_energy() {
    let text = L_ROOM.replace("0.9   west", "0.25  west").replace("0.9   south", "0     south");
    let room = solved(&text);
    let total = room.total.expect("gray surfaces");
    for i in 0..8 {
        assert!((total.row_sum(i) - room.geometry.reported[i].emissivity).abs() < 1e-11);
        let area = |i: usize| room.geometry.reported[i].area;
        (0..8).for_each(|j| assert!((area(i) * total.factor(i, j) - area(j) * total.factor(j, i)).abs() < 1e-11));
    }
}

/// The matrix of a gray cube is diagonal in three kinds of patterns: uniform, odd and even in opposite faces.
#[test]
fn total_exchange_of_a_gray_cube() {
    let total = solved(&CUBE.replace("encl=1", "encl=1 emit=1")).total.expect("gray surfaces");
    let (e, rho) = (0.5, 0.5);
    let (uniform, odd, even) = (1.0, -OPPOSITE, OPPOSITE - 2.0 * ADJACENT);
    let gain = |eigenvalue: f64| e * e * eigenvalue / (1.0 - rho * eigenvalue);
    let opposite = gain(uniform) / 6.0 - gain(odd) / 2.0 + gain(even) / 3.0;
    let adjacent = gain(uniform) / 6.0 - gain(even) / 6.0;
    assert!((total.factor(0, 3) - opposite).abs() < 1e-9, "{} {opposite}", total.factor(0, 3));
    assert!((total.factor(0, 1) - adjacent).abs() < 1e-9, "{} {adjacent}", total.factor(0, 1));
}

/// The cube with more in it: vertices 9 to 12 lie in the floor.
fn cube_with(entry: &str) -> String {
    let vertices = "V 9 .25 .25 0\nV 10 .75 .25 0\nV 11 .75 .75 0\nV 12 .25 .75 0\n";
    CUBE.replace("!  n   v1", &format!("{vertices}!  n   v1")).replace("End", &format!("{entry}\nEnd"))
}

/// A hatch in the floor takes its share from the floor; together they are the floor again.
#[test]
fn subsurface_and_base_are_the_whole() {
    let [whole, parts] = [CUBE.to_owned(), cube_with("S 7 9 10 11 12  1 0 .5 hatch")].map(|text| solved(&text));
    assert_eq!((parts.geometry.reported[0].area, parts.geometry.reported[6].area), (0.75, 0.25));
    for j in 1..6 {
        let sum = exchange(&parts, 0, j) + exchange(&parts, 6, j);
        assert!((sum - exchange(&whole, 0, j)).abs() < 1e-9);
    }
    assert_eq!(parts.factors.factor(0, 6), 0.0);
    let together = solved(&cube_with("S 7 9 10 11 12  1 1 .5 hatch"));
    (1..6).for_each(|j| assert!((together.factors.factor(0, j) - whole.factors.factor(0, j)).abs() < 1e-9));
}

/// A mask gives all it has to its base, which sees so much less of the rest; all rows still sum to 1.
#[test]
fn mask_covers_a_part_of_its_base() {
    let masked = solved(&cube_with("M 7 12 11 10 9  1 0 .5 mat"));
    let hatched = solved(&cube_with("S 7 9 10 11 12  1 0 .5 hatch"));
    assert_eq!((masked.factors.factor(6, 0), masked.factors.factor(0, 6)), (1.0, 0.25));
    assert_eq!(masked.geometry.reported[0].area, 1.0);
    (1..6).for_each(|j| assert_eq!(exchange(&masked, 0, j), exchange(&hatched, 0, j)));
    assert!((masked.factors.row_sum(0) - 1.0).abs() < 1e-8);
}

/// A null surface takes its part out of the base: a smaller floor, seen by the same walls.
#[test]
fn null_surface_is_not_there() {
    let holed = solved(&cube_with("N 7 12 11 10 9  1 0 .5 hole").replace("encl=1", "encl=0"));
    let hatched = solved(&cube_with("S 7 9 10 11 12  1 0 .5 hatch"));
    assert_eq!((holed.geometry.reported.len(), holed.geometry.reported[0].area), (6, 0.75));
    (1..6).for_each(|j| assert_eq!(holed.factors.factor(0, j), hatched.factors.factor(0, j)));
}

/// An obstruction blocks as a surface does, whichever way it faces, and has no row.
#[test]
fn obstruction_only_blocks() {
    for corners in ["9 10 11 12", "12 11 10 9"] {
        let text = SQUARES.replace("S  3   9 10 11 12   0    0    0.5   between", &format!("O 3 {corners}"));
        let squares = solved(&text);
        assert_eq!(squares.geometry.reported.len(), 2);
        assert_beats(squares.factors.factor(0, 1), 0.149_870, 0.75 * OPPOSITE);
    }
}

/// What lies on an obstruction radiates, and its base does not hide it.
#[test]
fn surface_on_an_obstruction() {
    let text =
        SQUARES.replace("S  3   9 10 11 12   0    0    0.5   between", "S 3 9 10 11 12  4 0 .5 top\nO 4 9 10 11 12");
    let [on_obstruction, alone] = [text, SQUARES.to_owned()].map(|text| solved(&text).factors);
    (0..9).for_each(|k| assert_eq!(on_obstruction.factor(k / 3, k % 3), alone.factor(k / 3, k % 3)));
}

/// A square that is bent or notched is cut, with a warning, and the room stays closed.
#[test]
fn bent_surfaces_are_cut() {
    let bent = solved(&CUBE.replace("V  7   1  1  1", "V  7   1.1  1.2  1.1"));
    assert_eq!(bent.warnings.iter().filter(|warning| warning.what.contains("not planar")).count(), 3);
    (0..6).for_each(|i| assert!((bent.factors.row_sum(i) - 1.0).abs() < 1e-8, "{}", bent.factors.row_sum(i)));
}

#[test]
fn one_row_and_one_entry() {
    let all = solved(L_ROOM);
    let row = solved(&L_ROOM.replace("encl=1", "encl=1 row=11"));
    assert_eq!((row.rows(), row.columns()), (7..8, 0..8));
    assert_eq!(row.factors.row(7), all.factors.row(7));
    let entry = solved(&L_ROOM.replace("encl=1", "row=1, col=6"));
    assert_eq!(entry.factors.factor(0, 5), all.factors.factor(0, 5));
    assert_eq!(entry.factors.factor(0, 1), 0.0);
}

#[test]
fn the_report_has_all_that_was_asked() {
    let report = solved(&L_ROOM.replace("encl=1", "list=3 encl=1")).to_string();
    for word in ["L-shaped room", "ceiling (surfaces 7 9 10)", "as computed", "scaled", "script F", "(3, 0, 3)"] {
        assert!(report.contains(word), "{word} is missing in\n{report}");
    }
    assert!(solved(CUBE).to_string().contains("0.199824895"));
}

/// Words may be separated by commas and tabs, letters be small, comments stand anywhere; what is unknown is said.
#[test]
fn the_format_is_read_as_view3d_reads_it() {
    let text = "/ comment\nt Two squares ! all of it\nc EPS = 1e-8, maxU=8 encl=0 foo=3\nf 3\nX 1 2\n\
                v 1,0,0,0 ! origin\nv\t2\t1.\t.0\t0.e0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\n\
                s 1 1 2 3 4 0 0 .9\ns 2 1 4 5 0 0 0 0.8 wall more words\n* the rest is not read\nV 9 9 9\n";
    let solution = as_given(text);
    assert_eq!(solution.input.title, "Two squares ! all of it");
    assert_eq!(solution.accuracy, 1e-8);
    let surfaces = &solution.input.surfaces;
    assert_eq!((surfaces[0].name.as_str(), surfaces[1].name.as_str()), ("surface-1", "wall"));
    assert_eq!((surfaces[1].corners.len(), surfaces[1].emissivity), (3, 0.8));
    let warnings: Vec<usize> = solution.warnings.iter().map(|warning| warning.line).collect();
    assert_eq!(warnings, [3, 5]);
}

/// Each flaw names its line and what to do.
#[test]
fn bad_inputs_are_refused() {
    for (text, line, what) in [
        (CUBE.replace("4  8  5  1", "4  8  5  9"), 16, "vertex 9"),
        (CUBE.replace("V  3 ", "V  2 "), 8, "vertex 2 stands where vertex 3 is due"),
        (CUBE.replace("S  5 ", "S  3 "), 19, "surface 3 stands where surface 5 is due"),
        (CUBE.replace("V  8   0  1  1", "V  8   0  NaN  1"), 13, "`NaN`, not a finite number"),
        (CUBE.replace("V  8   0  1  1", "V  8   0  1e999  1"), 13, "not a finite number"),
        (CUBE.replace("V  8   0  1  1", "V  8   0  1"), 13, "ends before its coordinate z"),
        (CUBE.replace("0.5   floor", "5.0   floor"), 15, "emissivity of surface 1 is 5"),
        (CUBE.replace("F 3", "F 2"), 3, "write `F 3`"),
        (CUBE.replace("encl=1", "encl=yes"), 2, "not a whole number"),
        (CUBE.replace("encl=1", "eps=-1"), 2, "above 0"),
        (CUBE.replace("encl=1", "row=9"), 1, "no result for row=9"),
        (CUBE.replace("1  2  3  4   0 ", "1  3  2  4   0 "), 15, "listed crosswise"),
        (CUBE.replace("1  2  3  4   0 ", "1  2  1  2   0 "), 15, "no area"),
        (CUBE.replace("1  2  3  4   0 ", "1  2  3  4   6 "), 15, "lower number"),
        (CUBE.replace("3  7  8  4   0    0", "3  7  8  4   0    9"), 20, "combined with 9"),
        (cube_with("S 7 12 11 10 9  1 0 .5 hatch"), 25, "reverse"),
        (cube_with("M 7 9 10 11 12  1 0 .5 mat"), 25, "reverse"),
        (cube_with("N 7 12 11 10 9  0 0 .5 mat"), 25, "as its base"),
        (cube_with("S 7 9 10 11 12  4 0 .5 hatch"), 25, "faces away"),
        (cube_with("S 7 1 2 3 4  1 0 .5 carpet"), 19, "nothing is left of surface 1"),
        (CUBE.replace("V  8   0  1  1", "V  8   0  1  1e200"), 16, "no area"),
        (cube_with("S 7 5 6 7 8  1 0 .5 hatch"), 25, "not within its base"),
        (cube_with("S 7 9 10 11 12  1 0 .5 a\nS 8 9 10 11 0  1 0 .5 b"), 26, "overlaps surface 7"),
        (L_ROOM_IN_PLANES.replace("3 0 0      0  90     3 3", "3 0 0      0  90     3"), 8, "take 7 numbers, not 6"),
        (L_ROOM_IN_PLANES.replace("S  1  R", "S  1  Z"), 7, "write R, Q or T"),
        ("T nothing\nF 3\nE\n".into(), 1, "no surface"),
    ] {
        let flaw = refused(&text);
        assert!(flaw.what.contains(what) && flaw.line == line, "line {line} {what}: {flaw}");
    }
}

/// A file that ends early is read, as View3D does, but not without a word.
#[test]
fn a_missing_end_is_told() {
    let solution = solved(&CUBE.replace("End", ""));
    assert!(solution.warnings.iter().any(|warning| warning.what.contains("no end line")));
    assert!(solved(CUBE).warnings.is_empty());
}

#[test]
fn an_open_enclosure_is_told() {
    let open = solved(&CUBE.replace("S  6 ", "O  6 "));
    assert_eq!(open.warnings.iter().filter(|warning| warning.what.contains("close the holes")).count(), 5);
}
