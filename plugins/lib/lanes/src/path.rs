//! Which instructions a query runs on.

use super::Lanes;
use super::portable::Portable;

/// A set of instructions that this machine has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Path(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Something to do with lanes of any kind. Everything below `run` must be inlined into it, or it is compiled for a
/// processor without the instructions: slow, not wrong.
pub trait Work {
    /// What comes out.
    type Output;
    /// Does it.
    fn run<L: Lanes>(self) -> Self::Output;
}

impl Path {
    /// The widest one, up to `width` numbers at once: 1 for portable code, 8 for AVX2, 16 for AVX-512.
    #[cfg_attr(not(target_arch = "x86_64"), expect(unused_variables, reason = "there is nothing to choose from"))]
    pub fn widest(width: usize) -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("lzcnt")
                && is_x86_feature_detected!("popcnt");
            if width >= 16 && avx512 && avx2 {
                return Self(Kind::Avx512);
            }
            if width >= 8 && avx2 {
                return Self(Kind::Avx2);
            }
        }
        Self(Kind::Portable)
    }

    /// Does some work with these instructions.
    #[inline]
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self.0 {
            Kind::Portable => work.run::<Portable>(),
            // SAFETY: a `Path` of this kind is made by `widest` alone, which has found these instructions.
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => unsafe { run_avx2(work) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => unsafe { run_avx512(work) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn run_avx2<W: Work>(work: W) -> W::Output {
    work.run::<super::avx2::Avx2>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn run_avx512<W: Work>(work: W) -> W::Output {
    work.run::<super::avx512::Avx512>()
}
