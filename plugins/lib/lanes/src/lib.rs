#![doc = include_str!("../README.md")]
#![expect(clippy::needless_range_loop, reason = "kernels number lanes, of several arrays at once")]

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod four;
mod path;
mod portable;

use core::ops::{Add, Mul, Sub};

pub use path::{Path, Work};
/// Four numbers, in one register of most processors.
pub use wide::f32x4 as Four;

/// A bit for each lane, the first lane's the lowest.
pub type Bits = u32;

/// Some numbers at once.
///
/// A comparison with a NaN is false, and `min` and `max` give their second operand when one is a NaN, as x86 has it: kernels
/// that only ever *reject* by a comparison keep what they cannot judge.
pub trait Numbers: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The outcome of a comparison in each lane.
    type Mask: Copy;

    /// The same number in all lanes.
    fn splat(x: f32) -> Self;
    /// `self * factor + summand`, rounded once or twice.
    fn mul_add(self, factor: Self, summand: Self) -> Self;
    /// The magnitude.
    fn abs(self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self;
    /// The larger one.
    fn max(self, other: Self) -> Self;
    /// The square root.
    fn sqrt(self) -> Self;
    /// A mask with these bits.
    fn lanes(bits: Bits) -> Self::Mask;
    /// `keep` without the lanes where `x > bound`.
    fn unless_above(keep: Self::Mask, x: Self, bound: Self) -> Self::Mask;
    /// The mask as bits.
    fn bits(mask: Self::Mask) -> Bits;
}

/// Sixteen numbers.
pub trait Lanes: Numbers {
    /// Whether sixteen numbers take so many registers that a test ends early where it can, rather than without a branch.
    const NARROW: bool = false;

    /// Sixteen numbers from memory.
    fn load(from: &[f32; 16]) -> Self;
    /// Into memory.
    fn store(self, to: &mut [f32; 16]);
    /// Four numbers, each in four lanes side by side: lane `4 i + j` gets number `i`.
    fn spread(from: &[f32; 4]) -> Self;
    /// The same with four of these numbers, those from `4 four` on.
    fn spread_of(self, four: usize) -> Self;
    /// Four numbers, four times one after the other: lane `4 i + j` gets number `j`.
    fn tile(from: &[f32; 4]) -> Self;
    /// Roughly `1 / self`: to 2^-11 or better.
    fn reciprocal(self) -> Self;
    /// Where `self > other`.
    fn above(self, other: Self) -> Self::Mask;
    /// Where either mask is set.
    fn either(one: Self::Mask, other: Self::Mask) -> Self::Mask;
    /// `self` where the mask is set, else `other`.
    fn or_else(self, mask: Self::Mask, other: Self) -> Self;
    /// The lane of the smallest number, to 19 bits, among these lanes; the numbers are not negative. Any lane if there is none.
    fn least(self, among: Bits) -> usize;
    /// For each bit, lowest first: number `i` of the first four and number `j` of the other four, where `4 i + j` is its lane.
    /// What comes after those is anything.
    fn pairs(bits: Bits, spread: &[u32; 4], tile: &[u32; 4], to: [&mut [u32; 16]; 2]);
    /// Asks for the cache lines of something that will be read soon.
    fn prefetch<T>(what: &T);
}

/// The same for 0, 1 and 2. Not `map` of an array, whose closure is compiled for any processor.
#[macro_export]
macro_rules! three {
    ($i:ident => $value:expr) => {
        [
            {
                let $i = 0;
                $value
            },
            {
                let $i = 1;
                $value
            },
            {
                let $i = 2;
                $value
            },
        ]
    };
}

/// Three coordinates of as many points.
pub type Points<L> = [L; 3];

/// Scalar products.
#[inline(always)]
pub fn dot<L: Numbers>(a: &Points<L>, b: &Points<L>) -> L {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Differences.
#[inline(always)]
pub fn sub<L: Numbers>(a: &Points<L>, b: &Points<L>) -> Points<L> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Vector products.
#[inline(always)]
pub fn cross<L: Numbers>(a: &Points<L>, b: &Points<L>) -> Points<L> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a + s b`.
#[inline(always)]
pub fn add_scaled<L: Numbers>(a: &Points<L>, s: L, b: &Points<L>) -> Points<L> {
    [s.mul_add(b[0], a[0]), s.mul_add(b[1], a[1]), s.mul_add(b[2], a[2])]
}

/// `1 / x` to 2^-20 or better: a step of Newton's iteration squares the error of the rough one, and rounds four times.
#[inline(always)]
pub fn inverse<L: Lanes>(x: L) -> L {
    let rough = x.reciprocal();
    rough * (L::splat(2.0) - x * rough)
}
