//! One register of 512 bits.

use core::arch::x86_64::*;
use core::ops::{Add, Mul, Sub};

use super::{Bits, Lanes, Numbers};

/// Sixteen numbers in one register. Values are made in [`super::Path::run`] alone, below a check for the instructions.
#[derive(Clone, Copy)]
pub struct Avx512(__m512);

/// Calls instructions on values that exist only where these instructions do.
macro_rules! instructions {
    ($body:expr) => {
        // SAFETY: `Path::run` makes values of this type only after it has found AVX-512 F, BW, DQ and VL; addresses are
        // those of references to as many numbers as are read or written, and need no alignment.
        unsafe { $body }
    };
}

impl Add for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        instructions!(Self(_mm512_add_ps(self.0, other.0)))
    }
}

impl Sub for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        instructions!(Self(_mm512_sub_ps(self.0, other.0)))
    }
}

impl Mul for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        instructions!(Self(_mm512_mul_ps(self.0, other.0)))
    }
}

impl Numbers for Avx512 {
    type Mask = __mmask16;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        instructions!(Self(_mm512_set1_ps(x)))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        instructions!(Self(_mm512_fmadd_ps(self.0, factor.0, summand.0)))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        instructions!(Self(_mm512_abs_ps(self.0)))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        instructions!(Self(_mm512_min_ps(self.0, other.0)))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        instructions!(Self(_mm512_max_ps(self.0, other.0)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        instructions!(Self(_mm512_sqrt_ps(self.0)))
    }

    #[inline(always)]
    fn lanes(bits: Bits) -> Self::Mask {
        bits as __mmask16
    }

    #[inline(always)]
    fn unless_above(keep: Self::Mask, x: Self, bound: Self) -> Self::Mask {
        instructions!(_mm512_mask_cmp_ps_mask::<_CMP_NGT_UQ>(keep, x.0, bound.0))
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> Bits {
        Bits::from(mask)
    }
}

impl Lanes for Avx512 {
    #[inline(always)]
    fn load(from: &[f32; 16]) -> Self {
        instructions!(Self(_mm512_loadu_ps(from.as_ptr())))
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 16]) {
        instructions!(_mm512_storeu_ps(to.as_mut_ptr(), self.0))
    }

    #[inline(always)]
    fn spread(from: &[f32; 4]) -> Self {
        instructions!(Self(_mm512_castps128_ps512(_mm_loadu_ps(from.as_ptr()))).spread_of(0))
    }

    #[inline(always)]
    fn spread_of(self, four: usize) -> Self {
        instructions!({
            let lanes = _mm512_set_epi32(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
            Self(_mm512_permutexvar_ps(_mm512_add_epi32(lanes, _mm512_set1_epi32(4 * four as i32)), self.0))
        })
    }

    #[inline(always)]
    fn tile(from: &[f32; 4]) -> Self {
        instructions!(Self(_mm512_broadcast_f32x4(_mm_loadu_ps(from.as_ptr()))))
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        instructions!(Self(_mm512_rcp14_ps(self.0)))
    }

    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        instructions!(_mm512_cmp_ps_mask::<_CMP_GT_OQ>(self.0, other.0))
    }

    #[inline(always)]
    fn either(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        one | other
    }

    #[inline(always)]
    fn or_else(self, mask: Self::Mask, other: Self) -> Self {
        instructions!(Self(_mm512_mask_blend_ps(mask, other.0, self.0)))
    }

    #[inline(always)]
    fn least(self, among: Bits) -> usize {
        instructions!({
            let lanes = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
            let upper = _mm512_and_si512(_mm512_castps_si512(self.0), _mm512_set1_epi32(!15));
            let keys = _mm512_or_si512(upper, lanes);
            _mm512_mask_reduce_min_epu32(among as __mmask16, keys) as usize % 16
        })
    }

    #[inline(always)]
    fn pairs(bits: Bits, spread: &[u32; 4], tile: &[u32; 4], to: [&mut [u32; 16]; 2]) {
        instructions!({
            let [to_spread, to_tile] = to;
            let bits = bits as __mmask16;
            let spread = _mm_loadu_si128(spread.as_ptr().cast());
            let tile = _mm_loadu_si128(tile.as_ptr().cast());
            let order = _mm512_set_epi32(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
            let spread = _mm512_permutexvar_epi32(order, _mm512_castsi128_si512(spread));
            let spread = _mm512_maskz_compress_epi32(bits, spread);
            let tile = _mm512_maskz_compress_epi32(bits, _mm512_broadcast_i32x4(tile));
            _mm512_storeu_si512(to_spread.as_mut_ptr().cast(), spread);
            _mm512_storeu_si512(to_tile.as_mut_ptr().cast(), tile);
        })
    }

    #[inline(always)]
    fn prefetch<T>(what: &T) {
        super::avx2::prefetch(what);
    }
}
