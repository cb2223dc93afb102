//! B-splines and NURBS against scipy and geomdl: `reference/splines.py` wrote the cases.

use glam::DVec3;
use radiosity::spline::{BSpline, BSplineSurface, Homogeneous, Jet, KnotVector, Nurbs, NurbsSurface, SurfaceJet};

const CASES: &str = include_str!("reference/splines.txt");

/// The numbers of a case, taken one after the other.
struct Numbers<'a>(std::str::SplitAsciiWhitespace<'a>);

impl Numbers<'_> {
    fn one<T: std::str::FromStr<Err: std::fmt::Debug>>(&mut self) -> T {
        self.0.next().expect("cases are complete").parse().expect("cases hold numbers")
    }
    fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.one()).collect()
    }
    fn point(&mut self) -> DVec3 {
        DVec3::new(self.one(), self.one(), self.one())
    }
    fn points(&mut self, count: usize) -> Vec<DVec3> {
        (0..count).map(|_| self.point()).collect()
    }
}

/// A point with its derivatives, found in three ways.
type Found = (Jet<DVec3>, [DVec3; 3], DVec3);

#[test]
fn curves_equal_those_of_scipy_and_geomdl() {
    let cases: Vec<&str> = CASES.lines().filter_map(|line| line.strip_prefix("curve ")).collect();
    assert_eq!(cases.len(), 120);
    for case in cases {
        let mut numbers = Numbers(case.split_ascii_whitespace());
        let (degree, count, is_rational) = (numbers.one(), numbers.one(), numbers.one::<usize>() == 1);
        let knots = numbers.list(count + degree + 1);
        let knots = KnotVector::new(&knots, degree).unwrap();
        let points = numbers.points(count);
        let weights = numbers.list(if is_rational { count } else { 0 });
        let weighted: Vec<_> = points.iter().zip(&weights).map(|(&point, &w)| Homogeneous::new(point, w)).collect();
        let curve: Box<dyn Fn(f64) -> Found> = if is_rational {
            let curve = Nurbs::new(knots, &weighted).unwrap();
            Box::new(move |t| (curve.at(t), with_derivatives(|to| curve.derivatives(t, to)), curve.point(t)))
        } else {
            let curve = BSpline::new(knots, &points).unwrap();
            Box::new(move |t| (curve.at(t), with_derivatives(|to| curve.derivatives(t, to)), curve.point(t)))
        };
        for _ in 0..3 {
            let t = numbers.one();
            let expected = [numbers.point(), numbers.point(), numbers.point()];
            let (jet, derivatives, point) = curve(t);
            for found in [[jet.point, jet.first, jet.second], derivatives, [point, jet.first, jet.second]] {
                for (order, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                    let scale = 10.0 + expected.length() + if order > 0 { jet.first.length() } else { 0.0 };
                    let error = (found - expected).length() / scale;
                    assert!(error < 1e-12, "order {order} at {t}: {found} is not {expected}, off by {error:e}: {case}");
                }
            }
        }
        assert!(numbers.0.next().is_none());
    }
}

#[test]
fn surfaces_equal_those_of_geomdl() {
    let cases: Vec<&str> = CASES.lines().filter_map(|line| line.strip_prefix("surface ")).collect();
    assert_eq!(cases.len(), 80);
    for case in cases {
        let mut numbers = Numbers(case.split_ascii_whitespace());
        let (degrees, counts): ([usize; 2], [usize; 2]) =
            ([numbers.one(), numbers.one()], [numbers.one(), numbers.one()]);
        let is_rational = numbers.one::<usize>() == 1;
        let all = [0, 1].map(|k| numbers.list(counts[k] + degrees[k] + 1));
        let knots = [0, 1].map(|k| KnotVector::new(&all[k], degrees[k]).unwrap());
        let count = counts[0] * counts[1];
        let points = numbers.points(count);
        let weights = numbers.list(if is_rational { count } else { 0 });
        let weighted: Vec<_> = points.iter().zip(&weights).map(|(&point, &w)| Homogeneous::new(point, w)).collect();
        let at = |u: f64, v: f64| -> (SurfaceJet<DVec3>, DVec3, [DVec3; 3]) {
            if is_rational {
                let surface = NurbsSurface::new(knots, &weighted).unwrap();
                (surface.at(u, v), surface.point(u, v), surface.tangents(u, v))
            } else {
                let surface = BSplineSurface::new(knots, &points).unwrap();
                (surface.at(u, v), surface.point(u, v), surface.tangents(u, v))
            }
        };
        for _ in 0..2 {
            let [u, v] = [numbers.one(), numbers.one()];
            let expected: [DVec3; 6] = std::array::from_fn(|_| numbers.point());
            let (jet, point, tangents) = at(u, v);
            let found = [jet.point, jet.du, jet.dv, jet.duu, jet.duv, jet.dvv];
            let slope = 10.0 + expected[1].length() + expected[2].length();
            for (order, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                let scale = [10.0, slope, slope, slope * slope, slope * slope, slope * slope][order];
                let error = (found - expected).length() / (scale + expected.length());
                assert!(error < 1e-13, "derivative {order} at {u} {v}: {found} is not {expected}, {error:e}: {case}");
            }
            assert!((point - jet.point).length() < 1e-12 && (tangents[0] - point).length() < 1e-12);
            assert!((tangents[1] - jet.du).length() + (tangents[2] - jet.dv).length() < 1e-11 * slope);
        }
        assert!(numbers.0.next().is_none());
    }
}

fn with_derivatives(of: impl Fn(&mut [DVec3])) -> [DVec3; 3] {
    let mut derivatives = [DVec3::ZERO; 3];
    of(&mut derivatives);
    derivatives
}
