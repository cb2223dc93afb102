//! What surfaces do with light: symmetric, without gain, and chosen as their densities say.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use radiosity::geometry::hash;
use radiosity::scatter::*;

const SAMPLES: u32 = 100_000;
/// Bins of equal cosine and of equal angle around the normal.
const BINS: [usize; 2] = [16, 24];

fn surfaces() -> Vec<(&'static str, Matter<f32>)> {
    let (reflectance, lambert) = (0.8, Lambert { reflectance: 0.5 });
    vec![
        ("lambert", Matter::Lambert(Lambert { reflectance })),
        ("phong 0", Matter::Phong(Phong { reflectance, exponent: 0.0 })),
        ("phong 20", Matter::Phong(Phong { reflectance, exponent: 20.0 })),
        ("ggx 0.3", Matter::Ggx(Ggx::new(0.04, 0.3))),
        ("ggx 0.6", Matter::Ggx(Ggx::new(1.0, 0.6))),
        ("ggx 1", Matter::Ggx(Ggx::new(0.9, 1.0))),
        ("coated", Matter::Coated(Coated { coat: Ggx::new(0.04, 0.4), base: lambert, chance: 0.3 })),
        ("glossy", Matter::Glossy(Mixture { first: Ggx::new(0.9, 0.5), second: lambert, share: 0.3 })),
    ]
}

/// Directions from steep to grazing.
fn departures() -> [Vec3; 4] {
    [0.0_f32, 0.6, 1.1, 1.45].map(|angle| Vec3::new(0.6 * angle.sin(), -0.8 * angle.sin(), angle.cos()))
}

/// Three numbers in `[0, 1)` that look random.
fn numbers(index: u32) -> Vec3 {
    let number = |dimension: u32| (hash(hash(index, 77), dimension) >> 8) as f32 / 16_777_216.0;
    Vec3::new(number(1), number(2), number(3))
}

fn direction(cos: f32, angle: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    Vec3::new(sin * angle.cos(), sin * angle.sin(), cos)
}

/// The integral of a function over the directions of a bin, by the rule of midpoints.
fn over_bin(row: usize, column: usize, function: impl Fn(Vec3) -> f32) -> f64 {
    const STEPS: usize = 24;
    let width = [1.0 / (BINS[0] * STEPS) as f32, TAU / (BINS[1] * STEPS) as f32];
    let at = |i: usize| {
        let cos = ((row * STEPS + i / STEPS) as f32 + 0.5) * width[0];
        let angle = ((column * STEPS + i % STEPS) as f32 + 0.5) * width[1];
        f64::from(function(direction(cos, angle)))
    };
    (0..STEPS * STEPS).map(at).sum::<f64>() * f64::from(width[0] * width[1])
}

fn over_hemisphere(function: impl Fn(Vec3) -> f32) -> f64 {
    (0..BINS[0] * BINS[1]).map(|bin| over_bin(bin / BINS[1], bin % BINS[1], &function)).sum()
}

/// Pearson's statistic of what `sample` chooses against `density`, and the value that one of 10 000 exceeds.
fn chi_square(surface: &Matter<f32>, departure: Vec3, density: impl Fn(Vec3) -> f32) -> [f64; 2] {
    let mut met = vec![0.0; BINS[0] * BINS[1] + 1];
    for index in 0..SAMPLES {
        let bin =
            surface.sample(departure, numbers(index)).map_or(BINS[0] * BINS[1], |Scattered { arrival, .. }| {
                let row = ((arrival.z * BINS[0] as f32) as usize).min(BINS[0] - 1);
                let turn = arrival.y.atan2(arrival.x).rem_euclid(TAU) / TAU;
                row * BINS[1] + ((turn * BINS[1] as f32) as usize).min(BINS[1] - 1)
            });
        met[bin] += 1.0;
    }
    let mut expected: Vec<f64> = (0..BINS[0] * BINS[1])
        .map(|bin| over_bin(bin / BINS[1], bin % BINS[1], &density) * f64::from(SAMPLES))
        .collect();
    expected.push((f64::from(SAMPLES) - expected.iter().sum::<f64>()).max(0.0));
    // Bins in which little is expected count together.
    let (mut sum, mut bins, mut rest) = (0.0, 0.0, [0.0; 2]);
    for (met, expected) in met.into_iter().zip(expected) {
        if expected < 20.0 {
            rest = [rest[0] + met, rest[1] + expected];
        } else {
            sum += (met - expected).powi(2) / expected;
            bins += 1.0;
        }
    }
    sum += (rest[0] - rest[1]).powi(2) / rest[1].max(20.0);
    // Wilson and Hilferty.
    let degrees: f64 = bins;
    let most = degrees * (1.0 - 2.0 / (9.0 * degrees) + 3.72 * (2.0 / (9.0 * degrees)).sqrt()).powi(3);
    [sum, most]
}

#[test]
fn samplers_choose_as_their_densities_say() {
    for (name, surface) in surfaces() {
        for departure in departures() {
            let [sum, most] = chi_square(&surface, departure, |arrival| surface.density(arrival, departure));
            assert!(sum < most, "{name} towards {departure}: {sum} above {most}");
        }
    }
}

/// The test sees a density that is wrong: that of a lobe slightly sharper.
#[test]
fn another_density_is_found_out() {
    let surface = Matter::Phong(Phong { reflectance: 0.8, exponent: 20.0 });
    let other = Phong { reflectance: 0.8, exponent: 21.0 };
    let departure = departures()[1];
    let [sum, most] = chi_square(&surface, departure, |arrival| Scatter::<f32>::density(&other, arrival, departure));
    assert!(sum > most, "{sum} below {most}");
}

#[test]
fn light_may_go_either_way() {
    for (name, surface) in surfaces() {
        for index in 0..2000 {
            let numbers = [numbers(2 * index), numbers(2 * index + 1)];
            let [a, b] = numbers.map(|numbers| direction(numbers.x.max(0.01), TAU * numbers.y));
            let [there, back] = [surface.evaluate(a, b), surface.evaluate(b, a)];
            assert!((there - back).abs() <= 1e-4 * there.max(back), "{name}: {there} {back}");
            assert_eq!(surface.evaluate(-a, b), 0.0, "{name} lets nothing through");
        }
    }
}

/// No gain, and weights whose mean is the integral of the BSDF times the cosine.
#[test]
fn albedo_is_the_mean_weight() {
    for (name, surface) in surfaces() {
        for departure in departures() {
            let weights = (0..SAMPLES).filter_map(|index| surface.sample(departure, numbers(index)));
            let (mut sum, mut squares) = (0.0, 0.0);
            for weight in weights.map(|scattered| f64::from(scattered.weight)) {
                sum += weight;
                squares += weight * weight;
            }
            let mean = sum / f64::from(SAMPLES);
            let error = ((squares / f64::from(SAMPLES) - mean * mean).max(0.0) / f64::from(SAMPLES)).sqrt();
            let albedo = over_hemisphere(|arrival| surface.evaluate(arrival, departure) * arrival.z);
            assert!((mean - albedo).abs() < 4.0 * error + 2e-3 * albedo, "{name} towards {departure}: {mean} {albedo}");
            assert!(albedo <= 1.0 + 1e-4, "{name}: {albedo}");
        }
    }
}

/// Weight times density is BSDF times cosine.
#[test]
fn weights_are_consistent() {
    for (name, surface) in surfaces() {
        for index in 0..1000 {
            let departure = departures()[index as usize % 4];
            let Some(scattered) = surface.sample(departure, numbers(index)) else { continue };
            let Density::PerSteradian(density) = scattered.density else { panic!("{name} has no Dirac part") };
            let expected = surface.evaluate(scattered.arrival, departure) * scattered.arrival.z / density;
            assert!(
                (scattered.weight - expected).abs() < 1e-3 * expected.max(1e-3),
                "{name}: {scattered:?} {expected}"
            );
        }
    }
}

#[test]
fn closed_albedos() {
    let up = Vec3::Z;
    let phong = |exponent| Phong { reflectance: 0.8_f32, exponent };
    for exponent in [0.0, 3.0, 40.0] {
        let albedo = over_hemisphere(|arrival| phong(exponent).evaluate(arrival, up) * arrival.z);
        assert!((albedo - 0.8).abs() < 1e-3, "{exponent}: {albedo}");
    }
    let lambert = Lambert { reflectance: 0.8_f32 };
    assert!((lambert.evaluate(up, up) - 0.8 / PI).abs() < 1e-7);
    let mirror = Mirror { reflectance: 0.8_f32 }.sample(departures()[2], Vec3::ZERO).unwrap();
    assert_eq!((mirror.weight, mirror.density), (0.8, Density::Dirac));
    assert!((mirror.arrival.z - departures()[2].z).abs() < 1e-6 && mirror.arrival.x == -departures()[2].x);
    assert_eq!(Mirror { reflectance: 0.8_f32 }.sample(-up, Vec3::ZERO), None);
}

/// Glass reflects as often as Fresnel says, from both sides, and the rest goes through with all its light.
#[test]
fn glass_chooses_by_fresnel() {
    let glass = Glass { index: 1.5, absorption: 0.0_f32 };
    for cos in [1.0_f32, 0.7, 0.3, 0.1, -0.9, -0.8, -0.5] {
        let expected = fresnel(cos.abs(), if cos > 0.0 { 1.0 / 1.5 } else { 1.5 }).0;
        let departure = direction(cos, 0.3);
        let arrivals: Vec<_> = (0..SAMPLES).filter_map(|index| glass.sample(departure, numbers(index))).collect();
        assert!(arrivals.len() == SAMPLES as usize && arrivals.iter().all(|scattered| scattered.weight == 1.0));
        let reflected = arrivals.iter().filter(|scattered| (scattered.arrival.z > 0.0) == (cos > 0.0)).count();
        let share = reflected as f32 / SAMPLES as f32;
        let error = (expected * (1.0 - expected) / SAMPLES as f32).sqrt();
        assert!((share - expected).abs() <= 4.0 * error, "{cos}: {share} {expected}");
    }
}

/// A mirror under a veil: its share of the light goes into one direction, the rest into all.
#[test]
fn mixtures_may_have_a_dirac_part() {
    let surface = Mixture { first: Mirror { reflectance: 0.9_f32 }, second: Lambert { reflectance: 0.4 }, share: 0.25 };
    let departure = departures()[1];
    let (mut mirrored, mut sum) = (0, 0.0);
    for scattered in (0..SAMPLES).filter_map(|index| surface.sample(departure, numbers(index))) {
        mirrored += u32::from(scattered.density == Density::Dirac);
        sum += f64::from(scattered.weight) / f64::from(SAMPLES);
    }
    assert!((mirrored as f32 / SAMPLES as f32 - 0.25).abs() < 0.006, "{mirrored}");
    assert!((sum - (0.25 * 0.9 + 0.75 * 0.4)).abs() < 3e-3, "{sum}");
    let coated = Coated { coat: surface.first, base: surface.second, chance: 0.2 };
    let weights = (0..SAMPLES).filter_map(|index| coated.sample(departure, numbers(index)));
    let sum: f64 = weights.map(|scattered| f64::from(scattered.weight) / f64::from(SAMPLES)).sum();
    assert!((sum - 1.3).abs() < 0.02, "{sum}");
    let arrival = direction(0.5, 2.0);
    assert!((surface.evaluate(arrival, departure) - 0.75 * 0.4 / PI).abs() < 1e-6);
}

/// Fresnel at the normal, at Brewster's angle and at the critical angle; Snell's law; the way back has the same share.
#[test]
fn glass_obeys_fresnel_and_snell() {
    let (at_normal, _) = fresnel(1.0, 1.0 / 1.5);
    assert!((at_normal - 0.04).abs() < 1e-6);
    let brewster = 1.5_f32.atan();
    // Only light across the plane is left there: ((n^2 - 1) / (n^2 + 1))^2 / 2.
    assert!((fresnel(brewster.cos(), 1.0 / 1.5).0 - 0.5 * (1.25_f32 / 3.25).powi(2)).abs() < 1e-6);
    assert_eq!(fresnel(0.7, 1.5), (1.0, 0.0));
    for angle in [0.0_f32, 0.4, 0.9, 1.4] {
        let (there, beyond) = fresnel(angle.cos(), 1.0 / 1.5);
        let (back, cos) = fresnel(beyond, 1.5);
        assert!((there - back).abs() < 1e-5 && (cos - angle.cos()).abs() < 1e-5, "{angle}");
        let glass = Glass { index: 1.5, absorption: 0.7_f32 };
        let departure = direction(angle.cos(), 0.3);
        let refracted = glass.sample(departure, Vec3::splat(0.999)).unwrap();
        assert!((refracted.arrival.truncate() * 1.5 + departure.truncate()).length() < 1e-6);
        assert!((refracted.arrival.length() - 1.0).abs() < 1e-5 && refracted.arrival.z < 0.0);
        let reflected = glass.sample(departure, Vec3::ZERO).unwrap();
        assert_eq!((reflected.arrival.z, reflected.weight), (departure.z, 1.0));
        let returned = glass.sample(refracted.arrival, Vec3::splat(0.999)).unwrap();
        assert!(returned.arrival.abs_diff_eq(departure, 1e-4));
    }
    assert!((Glass { index: 1.5, absorption: 0.7_f32 }.transmittance(2.0) - (-1.4_f32).exp()).abs() < 1e-6);
}
