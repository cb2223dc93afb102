//! All solvers against rooms whose radiosities are known, and against the laws of the radiosity equation.

#[path = "reference/systems.rs"]
mod systems;

use glam::DVec3;
use radiosity::solve::*;
use radiosity::spectrum::{Bands, CORNELL_GREEN, CORNELL_RED, CORNELL_WHITE, Spectrum, cornell_lamp};
use systems::{Quantity, Room, rooms};

type Named<'a, 'f, S> = (&'static str, Box<dyn Solver<S, Dense<'f, <S as Spectrum>::Scalar>> + 'a>);

/// Memory for all solvers at once.
struct Scratch<S>([Vec<S>; 4]);

impl<S: Spectrum> Scratch<S> {
    fn new(count: usize) -> Self {
        Self([1, 2, 3, 1].map(|share| vec![S::default(); share * count]))
    }

    fn solvers<'a, 'f: 'a>(
        &'a mut self,
        system: &System<S, Dense<'f, S::Scalar>>,
        areas: &'a [S::Scalar],
        omega: S::Scalar,
    ) -> [Named<'a, 'f, S>; 6] {
        let [one, two, three, unshot] = &mut self.0;
        [
            ("Jacobi", Box::new(Jacobi::new(one))),
            ("Gauss-Seidel", Box::new(GaussSeidel)),
            ("over-relaxation", Box::new(OverRelaxation { omega })),
            ("Chebyshev", Box::new(Chebyshev::new(system, two))),
            ("conjugate gradient", Box::new(ConjugateGradient::new(system, areas, three))),
            ("Southwell", Box::new(Southwell::new(system, areas, unshot))),
        ]
    }
}

/// Two long walls and a lamp in an open hall: areas, form factors that obey reciprocity, and 12 patches.
fn open_hall() -> (Vec<f64>, Vec<f64>) {
    let areas: Vec<f64> = (0..12).map(|i| 0.5 + 0.25 * (i * 5 % 7) as f64).collect();
    let exchange = |i: usize, j: usize| if i == j { 0.0 } else { 0.01 + 0.004 * ((i + j) * 7 % 11) as f64 };
    let factors = (0..144).map(|k| exchange(k / 12, k % 12) / areas[k / 12]).collect();
    (areas, factors)
}

/// Elimination without pivots, which such systems do not need.
fn eliminate(factors: &[f64], reflectance: &[DVec3], exitance: &[DVec3], band: usize) -> Vec<f64> {
    let count = exitance.len();
    let unit = |i, j| if i == j { 1.0 } else { 0.0 };
    let row = |i: usize| (0..count).map(move |j| unit(i, j) - reflectance[i][band] * factors[i * count + j]);
    let mut rows: Vec<Vec<f64>> = (0..count).map(|i| row(i).chain([exitance[i][band]]).collect()).collect();
    for k in 0..count {
        let pivot: Vec<f64> = rows[k].iter().map(|entry| entry / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let share = if i == k { 0.0 } else { row[k] };
            row.iter_mut().zip(&pivot).for_each(|(entry, pivot)| *entry -= share * pivot);
        }
        rows[k] = pivot;
    }
    rows.into_iter().map(|row| row[count]).collect()
}

fn check_known(room: &Room, radiosity: &[DVec3], solver: &str) {
    let dense = Dense { count: room.areas.len(), factors: &room.factors };
    for known in &room.known {
        let got = match known.quantity {
            Quantity::Radiosity(i, band) => radiosity[i][band],
            Quantity::Received(i, band) => dense.receive(i, radiosity)[band],
        };
        assert!((got - known.value).abs() < 1e-10, "{} by {solver}: {got} instead of {}", known.name, known.value);
    }
}

/// Each solver gives each known radiosity to 1e-10, from zero, from far off and from what is emitted.
#[test]
fn known_rooms() {
    let mut cases = 0;
    for room in rooms() {
        let count = room.areas.len();
        let dense = Dense { count, factors: &room.factors };
        let system = System::new(&room.exitance, &room.reflectance, &dense);
        cases += room.known.len();
        for start in [vec![DVec3::ZERO; count], vec![DVec3::new(7.0, 0.0, 100.0); count], room.exitance.clone()] {
            let mut scratch = Scratch::new(count);
            let omega = OverRelaxation::new(&system).omega;
            for (name, mut solver) in scratch.solvers(&system, &room.areas, omega) {
                let mut radiosity = start.clone();
                let stop = Stop { tolerance: 1e-13, most_steps: 20_000 };
                let solution = solver.solve(&system, &mut radiosity, &stop);
                assert!(solution.is_converged && solution.bound < 1e-10, "{name}: {solution:?}");
                check_known(&room, &radiosity, name);
            }
        }
    }
    assert_eq!(cases, 49);
}

/// After each step of each solver, in each band, the error is at most what the solver says; and that is not much more
/// than the truth when light is the same everywhere.
#[test]
fn errors_stay_within_their_bounds() {
    let (hall_areas, hall_factors) = open_hall();
    let hall = Room {
        reflectance: (0..12).map(|i| DVec3::new(0.9, 0.08 * i as f64, 1.0 / (1.0 + i as f64))).collect(),
        exitance: (0..12).map(|i| DVec3::new((i % 2) as f64, (i == 3) as u8 as f64, 1.0)).collect(),
        areas: hall_areas,
        factors: hall_factors,
        known: Vec::new(),
    };
    for room in rooms().into_iter().chain([hall]) {
        let count = room.areas.len();
        let dense = Dense { count, factors: &room.factors };
        let system =
            System::new(&room.exitance, &room.reflectance, &dense).look_ahead(&mut vec![DVec3::ZERO; count], 9);
        let truth = [0, 1, 2].map(|band| eliminate(&room.factors, &room.reflectance, &room.exitance, band));
        let mut scratch = Scratch::new(count);
        for (name, mut solver) in scratch.solvers(&system, &room.areas, 1.2) {
            let mut radiosity: Vec<DVec3> = (0..count).map(|i| DVec3::new(i as f64, 1.0, 0.0)).collect();
            for step in 0..60 {
                let accuracy = solver.step(&system, &mut radiosity);
                for (band, truth) in truth.iter().enumerate() {
                    let errors = radiosity.iter().zip(truth).map(|(b, truth)| (b[band] - truth).abs());
                    let (error, bound) = (errors.fold(0.0, f64::max), accuracy.error[band]);
                    assert!(error <= bound + 1e-11, "{name}, step {step}: error {error}, bound {bound}");
                }
            }
        }
    }
}

/// In a closed room of one reflectance the bound of a bounce is the error itself.
#[test]
fn the_bound_is_sharp() {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let system = System::new(&[1.0; 6], &[0.75_f64; 6], &dense);
    assert!((system.decay.per_bounce - 0.75).abs() < 1e-12 && (system.decay.amplification - 4.0).abs() < 1e-12);
    let (mut radiosity, mut received) = ([0.0; 6], [0.0; 6]);
    let mut jacobi = Jacobi::new(&mut received);
    for _ in 0..20 {
        let accuracy = jacobi.step(&system, &mut radiosity);
        assert!((accuracy.error - (4.0 - radiosity[0])).abs() < 1e-12);
    }
}

/// Where nothing is absorbed light gathers forever: no solver says that it is done, and none runs forever.
#[test]
fn a_closed_room_of_perfect_mirrors_of_diffuse_light_has_no_solution() {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let exitance = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let system = System::new(&exitance, &[1.0; 6], &dense).look_ahead(&mut [0.0; 6], 1000);
    assert_eq!(system.decay.amplification, f64::INFINITY);
    let mut scratch = Scratch::new(6);
    for (name, mut solver) in scratch.solvers(&system, &[1.0; 6], 1.1) {
        let solution = solver.solve(&system, &mut [0.0; 6], &Stop { tolerance: 1e-3, most_steps: 500 });
        assert!(!solution.is_converged && solution.bound == f64::INFINITY, "{name}: {solution:?}");
        assert_eq!(solution.steps, 500);
    }
}

/// Reflectance 1 on five walls: one bounce proves nothing, because a wall may keep all; two do, and light finds its
/// end on the sixth.
#[test]
fn patches_that_absorb_nothing_in_a_room_that_absorbs() {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let reflectance = [DVec3::ONE, DVec3::ONE, DVec3::ONE, DVec3::ONE, DVec3::ONE, DVec3::new(0.0, 0.5, 0.9)];
    let exitance = [DVec3::X, DVec3::ZERO, DVec3::Y, DVec3::ZERO, DVec3::Z, DVec3::ZERO];
    let unproven = System::new(&exitance, &reflectance, &dense);
    assert_eq!(unproven.decay.amplification, DVec3::splat(f64::INFINITY));
    let system = unproven.look_ahead(&mut [DVec3::ZERO; 6], 1000);
    // The mean number of walls that light meets until it is absorbed, from the other walls: about 6 / (1 - rho).
    for (band, expected) in [6.0, 12.0, 60.0].into_iter().enumerate() {
        assert!((0.9..2.2).contains(&(system.decay.amplification[band] / expected)), "{:?}", system.decay);
    }
    let mut scratch = Scratch::new(6);
    for (name, mut solver) in scratch.solvers(&system, &[1.0; 6], 1.1) {
        let mut radiosity = [DVec3::ZERO; 6];
        let solution = solver.solve(&system, &mut radiosity, &Stop { tolerance: 1e-12, most_steps: 9000 });
        assert!(solution.is_converged && solution.bound < 1e-9, "{name}: {solution:?}");
        let truth = [0, 1, 2].map(|band| eliminate(&factors, &reflectance, &exitance, band));
        for (i, b) in radiosity.into_iter().enumerate() {
            let truth = DVec3::from_array(truth.each_ref().map(|truth| truth[i]));
            assert!(b.abs_diff_eq(truth, 1e-9), "{name}: {b} instead of {truth}");
        }
    }
}

/// In an open scene light leaves even where nothing absorbs.
#[test]
fn open_scenes_converge_at_reflectance_one() {
    let dense = Dense { count: 2, factors: &[0.0, 0.4, 0.4, 0.0] };
    let system = System::new(&[1.0, 0.0], &[1.0; 2], &dense);
    assert!((system.decay.amplification - 1.0 / 0.6_f64).abs() < 1e-12);
    let mut radiosity = [0.0; 2];
    let solution = gauss_seidel(&system, &mut radiosity, &Stop { tolerance: 1e-12, most_steps: 40 });
    assert!(solution.is_converged);
    let exact: f64 = 1.0 / (1.0 - 0.16);
    assert!((radiosity[0] - exact).abs() < 1e-12 && (radiosity[1] - 0.4 * exact).abs() < 1e-12);
}

/// What is not a number, and relaxation that cannot converge, are told from a solution.
#[test]
fn nonsense_is_not_converged() {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let stop = Stop { tolerance: 1e-6, most_steps: 2000 };
    let exitance = [1.0, f64::NAN, 0.0, 0.0, 0.0, 0.0];
    for (e, rho) in [(exitance, [0.5; 6]), ([1.0; 6], exitance)] {
        let system = System::new(&e, &rho, &dense);
        let mut scratch = Scratch::new(6);
        for (name, mut solver) in scratch.solvers(&system, &[1.0; 6], 1.1) {
            let solution = solver.solve(&system, &mut [0.0; 6], &stop);
            assert!(!solution.is_converged && solution.bound == f64::INFINITY, "{name}: {solution:?}");
        }
    }
    let system = System::new(&[1.0; 6], &[0.9; 6], &dense);
    for omega in [f64::NAN, -0.5, 0.0, 2.5] {
        assert!(!over_relaxation(&system, omega, &mut [0.0; 6], &stop).is_converged, "{omega}");
    }
    let none = System::new(&[], &[], &Dense { count: 0, factors: &[] });
    assert!(gauss_seidel::<f64, _>(&none, &mut [], &stop).is_converged);
}

/// Radiosities after twelve steps of each solver but Southwell, whose order of shots depends on all bands.
fn twelve_steps<S: Spectrum<Scalar = f32>>(system: &System<S, Dense<f32>>) -> Vec<S> {
    let mut scratch = Scratch::new(6);
    let mut found = Vec::new();
    for (_, mut solver) in scratch.solvers(system, &[1.0; 6], 1.1).into_iter().take(5) {
        let mut radiosity = [S::default(); 6];
        for _ in 0..12 {
            solver.step(system, &mut radiosity);
        }
        found.extend(radiosity);
    }
    found
}

/// The measured Cornell box as a cube: 76 wavelengths in one solve are 76 solves of one wavelength, bit for bit.
#[test]
fn wavelengths_do_not_see_each_other() {
    let factors: Vec<f32> = systems::cube().into_iter().map(|factor| factor as f32).collect();
    let dense = Dense { count: 6, factors: &factors };
    let ceiling = CORNELL_WHITE * 0.94 + Bands::splat(0.78 * 0.06);
    let reflectance = [ceiling, CORNELL_WHITE, CORNELL_RED, CORNELL_GREEN, CORNELL_WHITE, Bands::default()];
    let mut exitance = [Bands::default(); 6];
    exitance[0] = cornell_lamp() * 0.06;
    let together = twelve_steps(&System::new(&exitance, &reflectance, &dense));
    for band in 0..76 {
        let (e, rho) = (exitance.map(|e| e.0[band]), reflectance.map(|rho| rho.0[band]));
        let alone = twelve_steps(&System::new(&e, &rho, &dense));
        for (k, (together, alone)) in together.iter().zip(alone).enumerate() {
            assert_eq!(together.0[band].to_bits(), alone.to_bits(), "band {band}, entry {k}");
        }
    }
}

/// Sweeps until the error is a millionth, in a room of one reflectance lit by one wall.
fn sweeps(rho: f64) -> [usize; 6] {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let (exitance, reflectance) = ([1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [rho; 6]);
    let system = System::new(&exitance, &reflectance, &dense);
    let mut scratch = Scratch::new(6);
    let stop = Stop { tolerance: 1e-6, most_steps: 100_000 };
    let omega = OverRelaxation::new(&system).omega;
    scratch.solvers(&system, &[1.0; 6], omega).map(|(_, mut solver)| solver.solve(&system, &mut [0.0; 6], &stop).steps)
}

/// Jacobi needs `ln(tolerance) / ln(rho)` sweeps, Gauss-Seidel and shooting fewer, Chebyshev the square root.
#[test]
fn sweeps_are_as_in_theory() {
    for rho in [0.5, 0.9, 0.98_f64] {
        let [jacobi, gauss_seidel, over_relaxed, chebyshev, gradient, shots] = sweeps(rho);
        let expected = 1e-6_f64.ln() / rho.ln();
        assert!((jacobi as f64 / expected - 1.0).abs() < 0.05, "{jacobi} instead of {expected}");
        let polynomial = 2e6_f64.ln() / ((1.0 + (1.0 - rho * rho).sqrt()) / rho).ln();
        assert!((chebyshev as f64) < 1.1 * polynomial + 2.0, "{chebyshev} instead of {polynomial}");
        assert!(gauss_seidel < jacobi * 3 / 4, "{gauss_seidel}");
        assert!(over_relaxed < gauss_seidel && (over_relaxed < gauss_seidel / 4 || rho < 0.98), "{over_relaxed}");
        // Three different eigenvalues, so three steps from the first residual.
        assert!(gradient <= 5, "{gradient}");
        assert!(shots < 6 * jacobi, "{shots}");
    }
}

/// Gauss-Seidel is over-relaxation by 1.
#[test]
fn over_relaxation_by_one_is_gauss_seidel() {
    let room = systems::rooms().remove(5);
    let dense = Dense { count: 6, factors: &room.factors };
    let system = System::new(&room.exitance, &room.reflectance, &dense);
    let (mut one, mut other) = ([DVec3::ZERO; 6], [DVec3::ZERO; 6]);
    for _ in 0..9 {
        GaussSeidel.step(&system, &mut one);
        OverRelaxation { omega: 1.0 }.step(&system, &mut other);
        assert!(one.iter().zip(&other).all(|(one, other)| one.abs_diff_eq(*other, 1e-15)));
    }
}

/// The first shot is that of the brightest lamp. In a closed room of one reflectance what is shown with the ambient term
/// holds all power from then on.
#[test]
fn the_ambient_term_stands_for_light_that_is_still_under_way() {
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let exitance = [0.0, 0.3, 2.0, 0.0, 0.0, 0.0];
    let system = System::new(&exitance, &[0.7; 6], &dense);
    let (areas, mut unshot, mut radiosity) = ([1.0; 6], [0.0; 6], [0.0; 6]);
    let mut southwell = Southwell::new(&system, &areas, &mut unshot);
    for shot in 0..20 {
        southwell.step(&system, &mut radiosity);
        assert!(shot > 0 || southwell.unshot()[2] == 0.0);
        let ambient = southwell.ambient(&system);
        let shown = radiosity.map(|b| b + 0.7 * ambient);
        assert!((shown.iter().sum::<f64>() * 0.3 - 2.3).abs() < 1e-12, "{shown:?}");
    }
}

/// A shot reaches patches of other areas by reciprocity: no power is lost in a room that absorbs nothing.
#[test]
fn shots_conserve_power() {
    let room = systems::rooms().pop().unwrap();
    let dense = Dense { count: 3, factors: &room.factors };
    let (exitance, reflectance) = ([0.3, 0.0, 1.0], [1.0; 3]);
    let system = System::new(&exitance, &reflectance, &dense);
    let (mut unshot, mut radiosity) = ([0.0; 3], [0.0; 3]);
    let mut southwell = Southwell::new(&system, &room.areas, &mut unshot);
    for _ in 0..50 {
        southwell.step(&system, &mut radiosity);
        let power: f64 = southwell.unshot().iter().zip(&room.areas).map(|(unshot, area)| unshot * area).sum();
        assert!((power - 2.3).abs() < 1e-12, "{power}");
    }
}

/// In single precision all come to the same five digits at reflectances up to 0.98.
#[test]
fn single_precision() {
    let factors: Vec<f32> = systems::cube().into_iter().map(|factor| factor as f32).collect();
    let dense = Dense { count: 6, factors: &factors };
    let (exitance, reflectance) = ([1.0, 0.0, 0.0, 0.5, 0.0, 0.0], [0.98, 0.5, 0.98, 0.98, 0.7, 0.98]);
    let doubles = |numbers: [f32; 6]| numbers.map(|number| DVec3::splat(f64::from(number)));
    let truth = eliminate(&systems::cube(), &doubles(reflectance), &doubles(exitance), 0);
    let system = System::new(&exitance, &reflectance, &dense);
    let mut scratch = Scratch::new(6);
    for (name, mut solver) in scratch.solvers(&system, &[1.0; 6], 1.1) {
        let mut radiosity = [0.0; 6];
        let solution = solver.solve(&system, &mut radiosity, &Stop { tolerance: 1e-5, most_steps: 5000 });
        assert!(solution.is_converged, "{name}: {solution:?}");
        (0..6).for_each(|i| assert!((f64::from(radiosity[i]) - truth[i]).abs() < 3e-5, "{name}: {radiosity:?}"));
    }
}

/// A unit cube of six facets with a lamp: local lighting is a closed form, and a better start than what is emitted.
#[test]
fn lit_starts_are_nearer() {
    let axes = [DVec3::NEG_Z, DVec3::Z, DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y];
    let facets = axes.map(|normal| Facet { center: normal * -0.5, normal, area: 1.0 });
    let factors = systems::cube();
    let dense = Dense { count: 6, factors: &factors };
    let exitance = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let system = System::new(&exitance, &[0.8; 6], &dense);
    let mut lit = [0.0; 6];
    phong_start(&system, &facets, &[Lamp { position: DVec3::Z * 0.25, intensity: 2.0 }], &mut lit);
    // The lamp is 1/4 below the facet that looks down, and 3/4 above the other; opposite emitters count A / (pi + A).
    let opposite = 1.0 / (core::f64::consts::PI + 1.0);
    assert!((lit[0] - 0.8 * 2.0 * 16.0 - 0.8 * adjacent()).abs() < 1e-12);
    assert!((lit[1] - 0.8 * 2.0 * 16.0 / 9.0 - 0.8 * adjacent()).abs() < 1e-12);
    let side = 0.5 / 0.3125_f64.powf(1.5);
    assert!((lit[2] - 0.8 * (2.0 * side + opposite)).abs() < 1e-12);
    assert!((lit[3] - 1.0 - 0.8 * 2.0 * side).abs() < 1e-12);

    phong_start(&system, &facets, &[], &mut lit);
    let truth = eliminate(&factors, &[DVec3::splat(0.8); 6], &exitance.map(DVec3::splat), 0);
    let error = |b: &[f64; 6]| b.iter().zip(&truth).map(|(b, truth)| (b - truth).abs()).fold(0.0, f64::max);
    assert!(error(&lit) < error(&exitance));

    /// Both cosines are 1/sqrt(2) at a distance of 1/sqrt(2).
    fn adjacent() -> f64 {
        0.5 / (core::f64::consts::PI * 0.5 + 1.0)
    }
}
