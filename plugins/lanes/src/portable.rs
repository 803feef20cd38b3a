//! An array, for processors without AVX2: the compiler makes of it what it can.

use core::ops::{Add, Mul, Sub};

use super::{Bits, Lanes};

/// Sixteen numbers in an array.
#[derive(Clone, Copy)]
pub struct Portable([f32; 16]);

impl Portable {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let mut out = [0.0; 16];
        for i in 0..16 {
            out[i] = f(self.0[i], other.0[i]);
        }
        Self(out)
    }
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |x, y| x + y)
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |x, y| x - y)
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |x, y| x * y)
    }
}

impl Lanes for Portable {
    type Mask = [u32; 16];

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self([x; 16])
    }

    #[inline(always)]
    fn load(from: &[f32; 16]) -> Self {
        Self(*from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 16]) {
        *to = self.0;
    }

    #[inline(always)]
    fn spread(from: &[f32; 4]) -> Self {
        let [x, y, z, w] = *from;
        Self([x, x, x, x, y, y, y, y, z, z, z, z, w, w, w, w])
    }

    #[inline(always)]
    fn spread_of(self, four: usize) -> Self {
        Self::spread(&self.0.as_chunks().0[four])
    }

    #[inline(always)]
    fn tile(from: &[f32; 4]) -> Self {
        let [x, y, z, w] = *from;
        Self([x, y, z, w, x, y, z, w, x, y, z, w, x, y, z, w])
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        // Rounded twice: a fused one would be a function call.
        self * factor + summand
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(other, |x, y| if x < y { x } else { y })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(other, |x, y| if x > y { x } else { y })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self(self.0.map(|x| 1.0 / x))
    }

    #[inline(always)]
    fn lanes(bits: Bits) -> Self::Mask {
        let mut out = [0; 16];
        for i in 0..16 {
            out[i] = 0u32.wrapping_sub(bits >> i & 1);
        }
        out
    }

    #[inline(always)]
    fn unless_above(keep: Self::Mask, x: Self, bound: Self) -> Self::Mask {
        let mut out = keep;
        for i in 0..16 {
            out[i] &= if x.0[i] > bound.0[i] { 0 } else { u32::MAX };
        }
        out
    }

    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        let mut out = [0; 16];
        for i in 0..16 {
            out[i] = if self.0[i] > other.0[i] { u32::MAX } else { 0 };
        }
        out
    }

    #[inline(always)]
    fn either(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        let mut out = one;
        for i in 0..16 {
            out[i] |= other[i];
        }
        out
    }

    #[inline(always)]
    fn or_else(self, mask: Self::Mask, other: Self) -> Self {
        let mut out = other.0;
        for i in 0..16 {
            out[i] = if mask[i] != 0 { self.0[i] } else { out[i] };
        }
        Self(out)
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> Bits {
        mask.iter().enumerate().fold(0, |bits, (i, &set)| bits | (set & 1) << i)
    }

    #[inline(always)]
    fn least(self, mut among: Bits) -> usize {
        let (mut least, mut found) = (f32::INFINITY, 0);
        while among != 0 {
            let lane = among.trailing_zeros() as usize % 16;
            among &= among - 1;
            if self.0[lane] < least {
                (least, found) = (self.0[lane], lane);
            }
        }
        found
    }

    #[inline(always)]
    fn pairs(mut bits: Bits, spread: &[u32; 4], tile: &[u32; 4], to: [&mut [u32; 16]; 2]) {
        let mut count = 0;
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize % 16;
            bits &= bits - 1;
            to[0][count] = spread[lane / 4];
            to[1][count] = tile[lane % 4];
            count = (count + 1) % 16;
        }
    }

    #[inline(always)]
    fn prefetch<T>(_what: &T) {}
}
