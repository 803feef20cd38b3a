//! Four numbers: the `wide` library's, which has them in a register of x86-64, of AArch64 and of WebAssembly, or else in an array.

use super::{Bits, Four, Numbers};

impl Numbers for Four {
    type Mask = Self;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self::splat(x)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        // Rounded twice: a fused one might be a function call.
        self * factor + summand
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // Other processors' instructions make something else of a NaN.
        if cfg!(target_arch = "x86_64") { self.fast_min(other) } else { self.simd_lt(other).bitselect(self, other) }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if cfg!(target_arch = "x86_64") { self.fast_max(other) } else { self.simd_gt(other).bitselect(self, other) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn lanes(bits: Bits) -> Self {
        Self::new(MASKS[bits as usize % 16])
    }

    #[inline(always)]
    fn unless_above(keep: Self, x: Self, bound: Self) -> Self {
        !x.simd_gt(bound) & keep
    }

    #[inline(always)]
    fn bits(mask: Self) -> Bits {
        mask.to_bitmask()
    }
}

/// The mask of each four bits: all bits of a lane, or none.
const MASKS: [[f32; 4]; 16] = {
    let mut masks = [[0.0; 4]; 16];
    let mut place = 0;
    while place < 64 {
        if (place / 4) >> (place % 4) & 1 == 1 {
            masks[place / 4][place % 4] = f32::from_bits(u32::MAX);
        }
        place += 1;
    }
    masks
};
