//! Four registers of four numbers, for processors without AVX2.

use core::ops::{Add, Mul, Sub};

use super::{Bits, Four, Lanes, Numbers};

/// Sixteen numbers in four registers.
#[derive(Clone, Copy)]
pub struct Portable([Four; 4]);

/// The same for each register.
macro_rules! each {
    ($i:ident => $value:expr) => {
        [each!($i = 0, $value), each!($i = 1, $value), each!($i = 2, $value), each!($i = 3, $value)]
    };
    ($i:ident = $number:literal, $value:expr) => {{
        let $i = $number;
        $value
    }};
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(each!(i => self.0[i] + other.0[i]))
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(each!(i => self.0[i] - other.0[i]))
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(each!(i => self.0[i] * other.0[i]))
    }
}

impl Numbers for Portable {
    type Mask = [Four; 4];

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self([Four::splat(x); 4])
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(each!(i => self.0[i].abs()))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(each!(i => Numbers::min(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(each!(i => Numbers::max(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(each!(i => self.0[i].sqrt()))
    }

    #[inline(always)]
    fn lanes(bits: Bits) -> Self::Mask {
        each!(i => Four::lanes(bits >> (4 * i)))
    }

    #[inline(always)]
    fn unless_above(keep: Self::Mask, x: Self, bound: Self) -> Self::Mask {
        each!(i => Four::unless_above(keep[i], x.0[i], bound.0[i]))
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> Bits {
        let [first, second, third, fourth] = each!(i => mask[i].to_bitmask());
        first | second << 4 | third << 8 | fourth << 12
    }
}

impl Lanes for Portable {
    const NARROW: bool = true;

    #[inline(always)]
    fn load(from: &[f32; 16]) -> Self {
        let from = from.as_chunks().0;
        Self(each!(i => Four::new(from[i])))
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 16]) {
        for (four, to) in self.0.iter().zip(to.as_chunks_mut().0) {
            *to = four.to_array();
        }
    }

    #[inline(always)]
    fn spread(from: &[f32; 4]) -> Self {
        Self(each!(i => Four::splat(from[i])))
    }

    #[inline(always)]
    fn spread_of(self, four: usize) -> Self {
        Self::spread(self.0[four].as_array())
    }

    #[inline(always)]
    fn tile(from: &[f32; 4]) -> Self {
        Self([Four::new(*from); 4])
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self(each!(i => Four::splat(1.0) / self.0[i]))
    }

    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        each!(i => self.0[i].simd_gt(other.0[i]))
    }

    #[inline(always)]
    fn either(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        each!(i => one[i] | other[i])
    }

    #[inline(always)]
    fn or_else(self, mask: Self::Mask, other: Self) -> Self {
        Self(each!(i => mask[i].bitselect(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn least(self, mut among: Bits) -> usize {
        let mut numbers = [0.0; 16];
        self.store(&mut numbers);
        let (mut least, mut found) = (f32::INFINITY, 0);
        while among != 0 {
            let lane = among.trailing_zeros() as usize % 16;
            among &= among - 1;
            if numbers[lane] < least {
                (least, found) = (numbers[lane], lane);
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
