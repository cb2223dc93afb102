//! What a small target shall compute, and how it tells: without heap, operating system and `core::fmt`.
//!
//! [`run`] does three things one after the other, so that they share the stack: it solves the [Cornell box](mod@box),
//! evaluates and tessellates a [NURBS sphere](surface), and draws it behind glass in fog ([`picture`]). Each gives a
//! checksum over the bits of its results, which must be those in [`expected`].
#![no_std]
#![forbid(unsafe_code)]

pub mod r#box;
pub mod checksum;
pub mod expected;
pub mod picture;
pub mod radiosity;
pub mod report;
#[cfg(not(feature = "large"))]
#[path = "size_small.rs"]
pub mod size;
#[cfg(feature = "large")]
#[path = "size_large.rs"]
pub mod size;
pub mod surface;

use checksum::Checksum;
use report::Report;

/// The machine that the program runs on.
pub trait Board {
    /// How many instructions were executed so far; 0 where nobody counts.
    fn instructions(&mut self) -> u64;
    /// Prints a piece of text.
    fn write(&mut self, text: &str);
}

/// The checksums of what was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checksums {
    /// Of the form factors of all pairs.
    pub form_factors: Checksum,
    /// Of the radiosities.
    pub radiosities: Checksum,
    /// Of the points and normals of the surface.
    pub surface: Checksum,
    /// Of the pixels.
    pub picture: Checksum,
}

/// Computes everything, prints it, and gives back the checksums.
pub fn run(board: &mut impl Board) -> Checksums {
    let mut report = Report::new(board);
    let [form_factors, radiosities] = radiosity::solve(&mut report);
    let surface = surface::tessellate(&mut report);
    let picture = picture::draw(&mut report);
    let checksums = Checksums { form_factors, radiosities, surface, picture };
    report.verdict(checksums == expected::CHECKSUMS);
    checksums
}
