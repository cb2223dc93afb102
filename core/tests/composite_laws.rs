//! The laws of compositing, on seeded random layers.

use glam::Vec4;
use radiosity::composite::*;

/// Numbers of Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// In `[0, 1)`.
    fn share(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }

    fn below(&mut self, end: usize) -> usize {
        (self.bits() >> 33) as usize % end
    }

    /// One in eight is clear, one in eight a wall.
    fn alpha(&mut self) -> f32 {
        match self.below(8) {
            0 => 0.0,
            1 => 1.0,
            _ => self.share(),
        }
    }

    fn straight(&mut self) -> StraightRgba {
        StraightRgba { rgb: [self.share(), self.share(), self.share()], alpha: self.alpha() }
    }

    fn shuffle<T>(&mut self, list: &mut [T]) {
        (1..list.len()).for_each(|k| list.swap(k, self.below(k + 1)));
    }
}

fn difference(a: PremultipliedRgba, b: PremultipliedRgba) -> f32 {
    (Vec4::from_array(a.to_array()) - Vec4::from_array(b.to_array())).abs().max_element()
}

fn steps<const N: usize>(a: [impl Into<i64>; N], b: [impl Into<i64>; N]) -> i64 {
    a.map(Into::into).into_iter().zip(b.map(Into::into)).map(|(a, b)| (a - b).abs()).max().unwrap_or(0)
}

/// Each product is rounded to half a step at most: two on either side.
#[test]
fn over_is_associative() {
    let mut random = Random(1);
    for _ in 0..100_000 {
        let [a, b, c] = [(); 3].map(|()| random.straight().premultiplied());
        assert!(difference(a.over(b).over(c), a.over(b.over(c))) < 2e-7);
        let [a, b, c] = [a, b, c].map(|color| color.stored_as::<u8>());
        assert!(steps(a.over(b).over(c).to_array(), a.over(b.over(c)).to_array()) <= 2);
        let [a, b, c] = [a, b, c].map(|color| color.stored_as::<u16>());
        assert!(steps(a.over(b).over(c).to_array(), a.over(b.over(c)).to_array()) <= 2);
    }
}

/// Straight layers merge to what premultiplied ones do, and the same one is found for all colors of alpha 0.
#[test]
fn straight_layers_agree() {
    let mut random = Random(2);
    for _ in 0..100_000 {
        let [a, b] = [(); 2].map(|()| random.straight());
        assert!(difference(a.over(b).premultiplied(), a.premultiplied().over(b.premultiplied())) < 3e-7);
        assert_eq!(a.over(b).alpha == 0.0, a.over(b) == StraightRgba::TRANSPARENT);
    }
}

/// Each step rounds to half a unit at most, and what stands in front lessens it.
#[test]
fn front_to_back_is_back_to_front() {
    let mut random = Random(3);
    for _ in 0..10_000 {
        let layers: Vec<_> = (0..random.below(30)).map(|_| random.straight().premultiplied()).collect();
        let reverse = || layers.iter().rev().copied();
        assert!(difference(front_to_back(layers.iter().copied()), back_to_front(reverse())) < 1e-6);
        let forth = front_to_back(layers.iter().map(|layer| layer.stored_as::<u16>()));
        let back = back_to_front(reverse().map(|layer| layer.stored_as::<u16>()));
        assert!(steps(forth.to_array(), back.to_array()) <= layers.len() as i64);
        let forth = front_to_back(layers.iter().map(|layer| layer.stored_as::<u8>()));
        let back = back_to_front(reverse().map(|layer| layer.stored_as::<u8>()));
        assert!(steps(forth.to_array(), back.to_array()) <= layers.len() as i64);
    }
}

#[test]
fn spans_are_pixels() {
    let mut random = Random(4);
    for length in [0, 1, 7, 64, 333] {
        let front: Vec<_> = (0..length).map(|_| random.straight().premultiplied()).collect();
        let back: Vec<_> = (0..length + 3).map(|_| random.straight().premultiplied()).collect();
        let mut span = back.clone();
        over_span(&front, &mut span);
        front.iter().zip(&back).zip(&span).for_each(|((a, b), c)| assert_eq!(a.over(*b), *c));
        assert_eq!(span[length..], back[length..]);
    }
}

/// Layers at depths that differ, the nearest first, and their exact sum.
fn stack(random: &mut Random, count: usize, glows: bool) -> (Vec<Layer>, PremultipliedRgba) {
    let layer = |k: usize| {
        let color = match (glows, random.below(3)) {
            (true, 0) => PremultipliedRgba::new([3.0 * random.share(), random.share(), 0.0, 0.3 * random.share()]),
            _ => random.straight().premultiplied(),
        };
        Layer { color, depth: (count - k) as f32 + 0.5 * random.share() }
    };
    let layers: Vec<Layer> = (0..count).map(layer).collect();
    let exact = front_to_back(layers.iter().map(|layer| layer.color));
    (layers, exact)
}

fn pixel<P: Pixel>(layers: &[Layer]) -> P {
    let mut pixel = P::EMPTY;
    layers.iter().for_each(|&layer| pixel.add(layer));
    pixel
}

/// Up to `K` layers the order of arrival does not change a bit.
#[test]
fn any_order_of_arrival_up_to_k() {
    let mut random = Random(5);
    for _ in 0..20_000 {
        let count = random.below(9);
        let (mut layers, exact) = stack(&mut random, count, true);
        random.shuffle(&mut layers);
        let pixel = pixel::<Layers<8>>(&layers);
        assert_eq!((pixel.color(), pixel.error()), (exact, 0.0));
    }
}

fn within_its_bound<const K: usize>() -> [f32; 3] {
    let mut random = Random(6 + K as u64);
    let (mut largest, mut sum, mut sum_of_bounds) = (0.0_f32, 0.0, 0.0);
    for _ in 0..5_000 {
        let (count, glows) = (random.below(40), random.below(2) == 0);
        let (mut layers, exact) = stack(&mut random, count, glows);
        random.shuffle(&mut layers);
        let pixel = pixel::<Layers<K>>(&layers);
        let error = difference(pixel.color(), exact);
        assert!(error <= pixel.error() + 4e-6, "{error} exceeds {}", pixel.error());
        assert!((pixel.color().alpha() - exact.alpha()).abs() < 1e-6, "alpha does not depend on the order");
        (largest, sum, sum_of_bounds) = (largest.max(error), sum + error, sum_of_bounds + pixel.error());
    }
    println!("K = {K}: error {:.4} in the mean, {largest:.3} at most, bound {:.3}", sum / 5e3, sum_of_bounds / 5e3);
    [largest, sum, sum_of_bounds]
}

/// Beyond `K` layers the error stays within the bound that the pixel tells, and both shrink with `K`.
#[test]
fn beyond_k_within_the_bound() {
    let errors = [within_its_bound::<1>(), within_its_bound::<2>(), within_its_bound::<4>(), within_its_bound::<8>()];
    errors.windows(2).for_each(|pair| assert!(pair[1][1] < pair[0][1] && pair[1][2] < pair[0][2]));
}

/// One layer is enough where layers arrive in order, and for two in any.
#[test]
fn one_layer_takes_sorted_ones() {
    let mut random = Random(7);
    for _ in 0..20_000 {
        let count = random.below(12);
        let (mut layers, exact) = stack(&mut random, count, false);
        assert!(difference(pixel::<DepthPixel>(&layers).color(), exact) < 1e-6);
        layers.reverse();
        assert!(difference(pixel::<DepthPixel>(&layers).color(), exact) < 1e-6);
        let (mut pair, exact) = stack(&mut random, 2, false);
        pair.swap(0, 1);
        assert!(difference(pixel::<DepthPixel>(&pair).color(), exact) < 1e-6);
    }
}

/// Triangles of all kinds, in two pictures of the same: drawn at once, and in tiles by 1, 2 and 16 threads.
#[test]
#[cfg(feature = "alloc")]
fn tiles_are_the_picture() {
    use radiosity::parallel::Workers;
    use radiosity::progress::Progress;

    const SIZE: [u32; 2] = [70, 53];
    let mut random = Random(8);
    let mut corner = || Vec4::new(random.share() * 4.0 - 2.0, random.share() * 4.0 - 2.0, random.share(), 1.0);
    let triangles: Vec<[Vec4; 3]> = (0..200).map(|_| [corner(), corner(), corner()]).collect();
    let color = |k: usize| PremultipliedRgba::new([(k % 7) as f32 / 20.0, (k % 5) as f32 / 20.0, 0.1, 0.4]);
    let draw = |picture: &mut Framebuffer<Layers<4>>| {
        triangles.iter().enumerate().for_each(|(k, corners)| picture.draw(corners, |_| color(k)));
    };
    let mut whole = vec![Layers::EMPTY; 4 * 70 * 53];
    draw(&mut Framebuffer::new(SIZE, Samples::Four, &mut whole).unwrap());
    for threads in [1, 2, 16] {
        let mut tiled = vec![Layers::EMPTY; 4 * 70 * 53];
        let mut picture = Framebuffer::new(SIZE, Samples::Four, &mut tiled).unwrap();
        picture.draw_tiles(&Workers::new(threads), &Progress::default(), draw).unwrap();
        assert!(tiled == whole);
    }
}
