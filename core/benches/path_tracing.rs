//! A picture by paths of light of a scene in a text file, with its standard errors, to hold it against other programs.
//!
//!     cargo bench -p radiosity --bench path_tracing -- SCENE.txt OUT.csv SIDE PATHS
//!
//! `bevy_plugin/benches/rivals/paths.py` makes such scenes and runs this. Each line of a scene is a word with numbers:
//! `eye` and `target` are points, `fov` an angle in degrees; `lambert R G B EMISSION`, `mirror R G B` or `glass INDEX` begin a
//! material, of which the `triangle`s that follow are made, nine numbers each. A line of the result is a pixel: mean and
//! standard error in RGB. The last line that is printed has the seconds.

use std::fs;
use std::time::Instant;

use glam::Vec3;
use radiosity::geometry::tree;
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::render::{Camera, Facet, Facets, PATHS, PathPicture, PathTracer};
use radiosity::scatter::{Glass, Lambert, Matter, Mirror};

#[derive(Default)]
struct Scene {
    eye: Vec3,
    target: Vec3,
    fov: f32,
    corners: Vec<[Vec3; 3]>,
    of_triangle: Vec<u32>,
    materials: Vec<Facet<Vec3>>,
}

impl Scene {
    fn read(text: &str) -> Self {
        let mut scene = Self::default();
        for line in text.lines() {
            let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
            let numbers: Vec<f32> = rest.split(' ').map(|number| number.parse().expect("it is a number")).collect();
            scene.take(word, &numbers);
        }
        scene
    }

    fn take(&mut self, word: &str, numbers: &[f32]) {
        let matter = match word {
            "eye" => return self.eye = Vec3::from_slice(numbers),
            "target" => return self.target = Vec3::from_slice(numbers),
            "fov" => return self.fov = numbers[0].to_radians(),
            "triangle" => {
                self.corners.push([0, 3, 6].map(|first| Vec3::from_slice(&numbers[first..])));
                return self.of_triangle.push(self.materials.len() as u32 - 1);
            }
            "lambert" => Matter::Lambert(Lambert { reflectance: Vec3::from_slice(numbers) }),
            "mirror" => Matter::Mirror(Mirror { reflectance: Vec3::from_slice(numbers) }),
            "glass" => Matter::Glass(Glass { index: numbers[0], absorption: Vec3::ZERO }),
            _ => panic!("there is no {word} in scenes"),
        };
        let emission = Vec3::splat(numbers.get(3).copied().unwrap_or(0.0));
        self.materials.push(Facet { matter, emission });
    }
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let [scene, out, side, paths] = &args[..] else {
        println!("name a scene, a result, pixels and paths; bevy_plugin/benches/rivals/paths.py does");
        return;
    };
    let [side, paths]: [u32; 2] = [side, paths].map(|number| number.parse().expect("it is a number"));
    let Scene { eye, target, fov, corners, of_triangle, materials } =
        &Scene::read(&fs::read_to_string(scene).expect("the scene can be read"));
    let occluders = tree(corners.clone());
    let facets = Facets { corners, of_triangle, materials, occluders, sky: |_| Vec3::ZERO };
    let tracer = PathTracer::new(facets, Vec::new());
    let camera = Camera::looking_at(*eye, *target, *fov);
    let (mut picture, workers, progress) = (PathPicture::new([side; 2], 7), Workers::new(0), Progress::default());
    let start = Instant::now();
    for _ in 0..paths.div_ceil(PATHS) {
        picture.step(&tracer, &camera, &workers, &progress).expect("nobody cancels it");
    }
    let seconds = start.elapsed().as_secs_f64();
    let row =
        |numbers: [Vec3; 2]| numbers.map(|color| color.to_array().map(|number| number.to_string()).join(",")).join(",");
    let rows: Vec<String> = picture.pixels.iter().map(|pixel| row([pixel.mean, pixel.standard_error()])).collect();
    fs::write(out, rows.join("\n") + "\n").expect("the result can be written");
    println!("{seconds}");
}
