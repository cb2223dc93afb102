//! Adaptive against uniform subdivision at equal error, as a Markdown table: elements, form factors and time.
use radiosity::solve::Stop;
const STOP: Stop<f64> = Stop { tolerance: 1e-7, most_steps: 500 };
use std::time::Instant;

use glam::{DVec2, DVec3};
use radiosity::patch::{Element, Enclosure, Field, Patch, Refinement, Shape, uniform};

type Quad = [DVec3; 4];
struct Room {
    name: &'static str,
    quads: Vec<(Quad, f64, f64)>,
    blockers: Vec<Quad>,
    side: f64,
    smallest: f64,
}

fn quad(o: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Quad {
    let [o, u, v] = [o, u, v].map(DVec3::from_array);
    [o, o + u, o + u + v, o + v]
}
fn flip(q: Quad) -> Quad {
    [q[0], q[3], q[2], q[1]]
}

fn inward_box([x, y, z]: [f64; 3]) -> [Quad; 6] {
    [
        quad([0.; 3], [x, 0., 0.], [0., y, 0.]),
        quad([0., 0., z], [0., y, 0.], [x, 0., 0.]),
        quad([0.; 3], [0., y, 0.], [0., 0., z]),
        quad([x, 0., 0.], [0., 0., z], [0., y, 0.]),
        quad([0.; 3], [0., 0., z], [x, 0., 0.]),
        quad([0., y, 0.], [x, 0., 0.], [0., 0., z]),
    ]
}

fn cube() -> Room {
    let quads = inward_box([1.0; 3]).iter().enumerate().map(|(k, &q)| (q, 0.5, f64::from(u8::from(k == 0)))).collect();
    Room { name: "cube", quads, blockers: vec![], side: 0.5, smallest: 0.0 }
}
fn shadow() -> Room {
    let mut quads: Vec<_> = inward_box([4.0, 3.0, 2.5]).iter().map(|&q| (q, 0.6, 0.0)).collect();
    let lamp = quad([1.7, 1.2, 2.4], [0., 0.5, 0.], [0.5, 0., 0.]);
    quads.push((lamp, 0.0, 30.0));
    let block: Vec<Quad> =
        inward_box([1.0, 0.8, 1.0]).iter().skip(1).map(|&q| flip(q).map(|p| p + DVec3::new(2.4, 0.6, 0.0))).collect();
    quads.extend(block.iter().map(|&q| (q, 0.5, 0.0)));
    let mut blockers = block;
    blockers.push(lamp);
    Room { name: "room", quads, blockers, side: 1.0, smallest: 0.0 }
}
fn plates() -> Room {
    let plate = quad([0.4, 1.0, 0.0], [1.2, 0., 0.], [0., 0., 0.6]);
    let lamp = quad([0.8, 0.1, 1.5], [0., 0.3, 0.], [0.4, 0., 0.]);
    let quads = vec![
        (quad([0.; 3], [2., 0., 0.], [0., 2., 0.]), 0.6, 0.0),
        (plate, 0.6, 0.0),
        (flip(plate), 0.6, 0.0),
        (lamp, 0.0, 30.0),
    ];
    Room { name: "plates", quads, blockers: vec![plate, lamp], side: 0.5, smallest: 0.0 }
}

fn lambert(p: DVec3, n: DVec3, poly: &[DVec3]) -> f64 {
    let mut c: Vec<DVec3> = Vec::with_capacity(6);
    for i in 0..poly.len() {
        let (a, b) = (poly[i] - p, poly[(i + 1) % poly.len()] - p);
        let (h, k) = (a.dot(n), b.dot(n));
        if h >= 0.0 {
            c.push(a);
        }
        if (h > 0.0) != (k > 0.0) && h != k {
            c.push(a.lerp(b, h / (h - k)));
        }
    }
    let mut s = 0.0;
    for i in 0..c.len() {
        let (a, b) = (c[i], c[(i + 1) % c.len()]);
        let x = a.cross(b);
        let l = x.length();
        if l > 1e-30 {
            s += l.atan2(a.dot(b)) * x.dot(n) / l;
        }
    }
    (-s / core::f64::consts::TAU).max(0.0)
}
fn blocks(q: &Quad, p: DVec3, r: DVec3) -> bool {
    let n = (q[1] - q[0]).cross(q[3] - q[0]);
    let (h, k) = ((p - q[0]).dot(n), (r - q[0]).dot(n));
    let eps = 1e-9 * n.length();
    if !(h > eps && k < -eps || h < -eps && k > eps) {
        return false;
    }
    let x = p.lerp(r, h / (h - k)) - q[0];
    let (u, v) = (q[1] - q[0], q[3] - q[0]);
    let (s, t) = (x.dot(u) / u.dot(u), x.dot(v) / v.dot(v));
    s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0
}
fn point_in(c: &[DVec3], s: f64, t: f64) -> DVec3 {
    c[0].lerp(c[1], s).lerp(c[3].lerp(c[2], s), t)
}

fn form_factor(room: &Room, a: &Element<DVec3>, b: &Element<DVec3>) -> f64 {
    const K: usize = 3;
    const G: [(f64, f64); 3] =
        [(0.112701665379, 0.277777777778), (0.5, 0.444444444444), (0.887298334621, 0.277777777778)];
    let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &p in a.corners().iter().chain(b.corners()) {
        lo = lo.min(p);
        hi = hi.max(p);
    }
    let near: Vec<&Quad> = room
        .blockers
        .iter()
        .filter(|q| {
            let (l, h) = q.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
            l.cmplt(hi).all() && h.cmpgt(lo).all() || (l.cmple(hi).all() && h.cmpge(lo).all())
        })
        .collect();
    let mut sum = 0.0;
    for i in 0..K {
        for j in 0..K {
            let p = point_in(a.corners(), G[i].0, G[j].0);
            let mut f = lambert(p, a.normal, b.corners());
            if f > 0.0 && !near.is_empty() {
                let m = 4;
                let seen = (0..m * m)
                    .filter(|k| {
                        let r =
                            point_in(b.corners(), ((k % m) as f64 + 0.5) / m as f64, ((k / m) as f64 + 0.5) / m as f64);
                        !near.iter().any(|q| blocks(q, p, r))
                    })
                    .count();
                f *= seen as f64 / (m * m) as f64;
            }
            sum += f * G[i].1 * G[j].1;
        }
    }
    sum
}

fn grid(room: &Room, shapes: &[Shape<DVec3, f64>], side: f64) -> Vec<Element<DVec3>> {
    let count = |d: DVec3| (d.length() / side).ceil() as usize;
    room.quads
        .iter()
        .enumerate()
        .flat_map(|(k, (q, ..))| {
            uniform(k, shapes[k].patches, [count(q[1] - q[0]), count(q[3] - q[0])]).collect::<Vec<_>>()
        })
        .collect()
}

fn main() {
    for room in [cube()] {
        let patches: Vec<[Patch<DVec3>; 1]> = room.quads.iter().map(|q| [Patch::Quad(q.0)]).collect();
        let shapes: Vec<Shape<DVec3, f64>> = room
            .quads
            .iter()
            .zip(&patches)
            .map(|(q, p)| Shape { patches: p, reflectance: q.1, exitance: q.2 })
            .collect();
        let mut ff = |a: &Element<DVec3>, b: &Element<DVec3>| form_factor(&room, a, b);
        let t = Instant::now();
        let fine = Enclosure::new(&shapes, grid(&room, &shapes, room.side / 8.0), &STOP, &mut ff);
        // sample points
        let mut points: Vec<(usize, DVec3, f64, f64)> = vec![];
        for (k, (q, rho, e)) in room.quads.iter().enumerate() {
            if *rho == 0.0 {
                continue;
            }
            let n = (q[1] - q[0]).cross(q[3] - q[0]);
            let count = |d: DVec3| (d.length() / room.side * 12.0).ceil() as usize;
            let (nu, nv) = (count(q[1] - q[0]), count(q[3] - q[0]));
            let h: DVec2 = DVec2::new(0.754877666, 0.569840291);
            for i in 0..nu * nv {
                let j = (h * (i as f64 + 0.5)).fract();
                let p = point_in(q, ((i % nu) as f64 + j.x) / nu as f64, ((i / nu) as f64 + j.y) / nv as f64);
                let a = n.length() / (nu * nv) as f64;
                let n = n.normalize();
                let mut b = *e;
                for (el, &rad) in fine.elements.iter().zip(&fine.radiosity) {
                    let f = lambert(p, n, el.corners());
                    if f <= 0.0 {
                        continue;
                    }
                    let m = if rad > 10.0 { 16 } else { 2 };
                    let seen = if room.blockers.is_empty() {
                        m * m
                    } else {
                        (0..m * m)
                            .filter(|k| {
                                let r = point_in(
                                    el.corners(),
                                    ((k % m) as f64 + 0.5) / m as f64,
                                    ((k / m) as f64 + 0.5) / m as f64,
                                );
                                !room.blockers.iter().any(|q| blocks(q, p, r))
                            })
                            .count()
                    };
                    b += rho * f * rad * seen as f64 / (m * m) as f64;
                }
                points.push((k, p, a, b));
            }
        }
        let area: f64 = points.iter().map(|p| p.2).sum();
        let rms = (points
            .iter()
            .map(|p| {
                let r = p.3 - shapes[p.0].exitance;
                r * r * p.2
            })
            .sum::<f64>()
            / area)
            .sqrt();
        println!(
            "{}: fine {} elements, {} points, rms {rms:.4}, {:.1} s",
            room.name,
            fine.elements.len(),
            points.len(),
            t.elapsed().as_secs_f64()
        );
        let errors = |s: &Enclosure<DVec3, f64>| {
            let field: Field<_, _> = s.field(&shapes);
            let (mut c, mut l) = (0.0, 0.0);
            for &(k, p, a, b) in &points {
                let i = s
                    .elements
                    .iter()
                    .position(|e| {
                        e.shape == k && {
                            let c = e.corners();
                            (0..c.len()).all(|m| (c[(m + 1) % c.len()] - c[m]).cross(p - c[m]).dot(e.normal) >= -1e-12)
                        }
                    })
                    .unwrap();
                c += (s.radiosity[i] - b).powi(2) * a;
                l += (field.value(i, &s.elements[i], p) - b).powi(2) * a;
            }
            [(c / area).sqrt() / rms, (l / area).sqrt() / rms]
        };
        for n in [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0] {
            let t = Instant::now();
            let s = Enclosure::new(&shapes, grid(&room, &shapes, room.side / n), &STOP, &mut ff);
            let t = t.elapsed().as_secs_f64();
            let [c, l] = errors(&s);
            println!(
                "uniform  {:5} elements {:8} pairs {:6.2} s constant {:.4} linear {:.4}",
                s.elements.len(),
                s.pairs,
                t,
                c,
                l
            );
        }
        for tol in [0.1, 0.05, 0.025, 0.0125, 0.006, 0.004, 0.003] {
            let t = Instant::now();
            let mut s = Enclosure::new(&shapes, grid(&room, &shapes, room.side * 0.6), &STOP, &mut ff);
            let r = s.refine(
                &shapes,
                &Refinement { tolerance: tol, smallest_area: room.smallest, most_elements: 4000, stop: STOP },
                &mut ff,
            );
            let t = t.elapsed().as_secs_f64();
            let [c, l] = errors(&s);
            println!(
                "adaptive {:5} elements {:8} pairs {:6.2} s constant {:.4} linear {:.4} estimate {:?}",
                s.elements.len(),
                s.pairs,
                t,
                c,
                l,
                r
            );
        }
    }
}
