//! Two registers of 256 bits.

use core::arch::x86_64::*;
use core::ops::{Add, Mul, Sub};

use super::{Bits, Lanes, Numbers};

/// Sixteen numbers in two registers. Values are made in [`super::Path::run`] alone, below a check for the instructions.
#[derive(Clone, Copy)]
pub struct Avx2(__m256, __m256);

/// Calls instructions on values that exist only where these instructions do.
macro_rules! instructions {
    ($body:expr) => {
        // SAFETY: `Path::run` makes values of this type only after it has found AVX2 and FMA; addresses are those of
        // references to as many numbers as are read or written, and need no alignment.
        unsafe { $body }
    };
}

/// A function of two values for both registers.
macro_rules! of_two {
    ($one:expr, $other:expr, $instruction:ident) => {
        instructions!(Self($instruction($one.0, $other.0), $instruction($one.1, $other.1)))
    };
}

impl Add for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        of_two!(self, other, _mm256_add_ps)
    }
}

impl Sub for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        of_two!(self, other, _mm256_sub_ps)
    }
}

impl Mul for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        of_two!(self, other, _mm256_mul_ps)
    }
}

impl Numbers for Avx2 {
    type Mask = (__m256, __m256);

    #[inline(always)]
    fn splat(x: f32) -> Self {
        instructions!(Self(_mm256_set1_ps(x), _mm256_set1_ps(x)))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        let low = instructions!(_mm256_fmadd_ps(self.0, factor.0, summand.0));
        Self(low, instructions!(_mm256_fmadd_ps(self.1, factor.1, summand.1)))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let sign = Self::splat(-0.0);
        of_two!(sign, self, _mm256_andnot_ps)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        of_two!(self, other, _mm256_min_ps)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        of_two!(self, other, _mm256_max_ps)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        instructions!(Self(_mm256_sqrt_ps(self.0), _mm256_sqrt_ps(self.1)))
    }

    #[inline(always)]
    fn lanes(bits: Bits) -> Self::Mask {
        instructions!({
            let bits = _mm256_set1_epi32(bits as i32);
            let low = _mm256_set_epi32(0x80, 0x40, 0x20, 0x10, 8, 4, 2, 1);
            let high = _mm256_slli_epi32::<8>(low);
            let set = |of| _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(bits, of), of));
            (set(low), set(high))
        })
    }

    #[inline(always)]
    fn unless_above(keep: Self::Mask, x: Self, bound: Self) -> Self::Mask {
        let low = instructions!(_mm256_and_ps(keep.0, _mm256_cmp_ps::<_CMP_NGT_UQ>(x.0, bound.0)));
        (low, instructions!(_mm256_and_ps(keep.1, _mm256_cmp_ps::<_CMP_NGT_UQ>(x.1, bound.1))))
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> Bits {
        instructions!(_mm256_movemask_ps(mask.0) as Bits | (_mm256_movemask_ps(mask.1) as Bits) << 8)
    }
}

impl Lanes for Avx2 {
    #[inline(always)]
    fn load(from: &[f32; 16]) -> Self {
        let (low, high) = from.split_at(8);
        instructions!(Self(_mm256_loadu_ps(low.as_ptr()), _mm256_loadu_ps(high.as_ptr())))
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 16]) {
        let (low, high) = to.split_at_mut(8);
        instructions!({
            _mm256_storeu_ps(low.as_mut_ptr(), self.0);
            _mm256_storeu_ps(high.as_mut_ptr(), self.1);
        })
    }

    #[inline(always)]
    fn spread(from: &[f32; 4]) -> Self {
        instructions!({
            let eight = _mm256_castps128_ps256(_mm_loadu_ps(from.as_ptr()));
            Self(eight, eight).spread_of(0)
        })
    }

    #[inline(always)]
    fn spread_of(self, four: usize) -> Self {
        let eight = if four < 2 { self.0 } else { self.1 };
        instructions!({
            let first = _mm256_set1_epi32(4 * (four % 2) as i32);
            let low = _mm256_add_epi32(first, _mm256_set_epi32(1, 1, 1, 1, 0, 0, 0, 0));
            let high = _mm256_add_epi32(first, _mm256_set_epi32(3, 3, 3, 3, 2, 2, 2, 2));
            Self(_mm256_permutevar8x32_ps(eight, low), _mm256_permutevar8x32_ps(eight, high))
        })
    }

    #[inline(always)]
    fn tile(from: &[f32; 4]) -> Self {
        instructions!({
            let four = _mm_loadu_ps(from.as_ptr());
            let twice = _mm256_set_m128(four, four);
            Self(twice, twice)
        })
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        instructions!(Self(_mm256_rcp_ps(self.0), _mm256_rcp_ps(self.1)))
    }

    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        let low = instructions!(_mm256_cmp_ps::<_CMP_GT_OQ>(self.0, other.0));
        (low, instructions!(_mm256_cmp_ps::<_CMP_GT_OQ>(self.1, other.1)))
    }

    #[inline(always)]
    fn either(one: Self::Mask, other: Self::Mask) -> Self::Mask {
        instructions!((_mm256_or_ps(one.0, other.0), _mm256_or_ps(one.1, other.1)))
    }

    #[inline(always)]
    fn or_else(self, mask: Self::Mask, other: Self) -> Self {
        instructions!(Self(_mm256_blendv_ps(other.0, self.0, mask.0), _mm256_blendv_ps(other.1, self.1, mask.1)))
    }

    #[inline(always)]
    fn least(self, among: Bits) -> usize {
        let (of_low, of_high) = Self::lanes(among);
        instructions!({
            let key = |numbers, lanes, among| {
                let upper = _mm256_and_si256(_mm256_castps_si256(numbers), _mm256_set1_epi32(!15));
                let others = _mm256_xor_si256(_mm256_castps_si256(among), _mm256_set1_epi32(-1));
                _mm256_or_si256(_mm256_or_si256(upper, lanes), others)
            };
            let low = key(self.0, _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0), of_low);
            let high = key(self.1, _mm256_set_epi32(15, 14, 13, 12, 11, 10, 9, 8), of_high);
            let eight = _mm256_min_epu32(low, high);
            let four = _mm_min_epu32(_mm256_castsi256_si128(eight), _mm256_extracti128_si256::<1>(eight));
            let two = _mm_min_epu32(four, _mm_shuffle_epi32::<0b_01_00_11_10>(four));
            let one = _mm_min_epu32(two, _mm_shuffle_epi32::<0b_10_11_00_01>(two));
            _mm_cvtsi128_si32(one) as usize % 16
        })
    }

    #[inline(always)]
    fn pairs(bits: Bits, spread: &[u32; 4], tile: &[u32; 4], to: [&mut [u32; 16]; 2]) {
        instructions!({
            // The lanes' numbers in order, four bits each, and those that are wanted packed to the front.
            let wanted = _pdep_u64(u64::from(bits), 0x1111_1111_1111_1111) * 0xf;
            let packed = _pext_u64(0xfedc_ba98_7654_3210, wanted);
            // A byte each, then 32 bits each.
            let packed = _mm_cvtsi64_si128(packed as i64);
            let nibble = _mm_set1_epi8(0xf);
            let high = _mm_and_si128(_mm_srli_epi16::<4>(packed), nibble);
            let bytes = _mm_unpacklo_epi8(_mm_and_si128(packed, nibble), high);
            let lanes = [_mm256_cvtepu8_epi32(bytes), _mm256_cvtepu8_epi32(_mm_srli_si128::<8>(bytes))];
            let spread = _mm256_broadcast_ps(&_mm_loadu_ps(spread.as_ptr().cast()));
            let tile = _mm256_broadcast_ps(&_mm_loadu_ps(tile.as_ptr().cast()));
            let [to_spread, to_tile] = to;
            for half in 0..2 {
                // Of each index, the two lowest bits count.
                let of_spread = _mm256_permutevar_ps(spread, _mm256_srli_epi32::<2>(lanes[half]));
                let of_tile = _mm256_permutevar_ps(tile, lanes[half]);
                _mm256_storeu_ps(to_spread.as_mut_ptr().add(8 * half).cast(), of_spread);
                _mm256_storeu_ps(to_tile.as_mut_ptr().add(8 * half).cast(), of_tile);
            }
        })
    }

    #[inline(always)]
    fn prefetch<T>(what: &T) {
        prefetch(what);
    }
}

/// Asks for all cache lines of a value.
#[inline(always)]
pub fn prefetch<T>(what: &T) {
    let start = core::ptr::from_ref(what).cast::<i8>();
    for line in (0..size_of::<T>()).step_by(64) {
        // SAFETY: the address stays within the value; every x86-64 processor can prefetch.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(start.add(line)) };
    }
}
