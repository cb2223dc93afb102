//! The square root that Arm processors have, where libm computes it: 3 instructions instead of 50 to 76, the same bits.
//!
//! IEEE 754 asks for the correctly rounded root, which both give.
#![expect(unsafe_code, reason = "no function of core becomes the instruction; this one reads and writes one register")]

core::arch::global_asm!(
    ".fpu fpv4-sp-d16",
    ".section .text.radiosity_sqrt, \"ax\"",
    ".global radiosity_sqrt",
    ".type radiosity_sqrt, %function",
    "radiosity_sqrt:",
    "vsqrt.f32 s0, s0",
    "bx lr",
);

unsafe extern "C" {
    /// Square root; NaN below 0.
    #[link_name = "radiosity_sqrt"]
    pub safe fn sqrt(x: f32) -> f32;
}
