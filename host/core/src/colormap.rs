//! Scalars become colours, for files that other programs read. The pages colour by themselves, with the same maps.

use serde::{Deserialize, Serialize};

/// Which colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Colormap {
    /// Google's turbo, as in the 2020 paper.
    #[default]
    Turbo,
    /// Matplotlib's viridis: perceptually uniform.
    Viridis,
    /// Cividis: reads the same with colour vision deficiency.
    Cividis,
    /// ColorBrewer's purple and orange about white, for differences: tells their signs apart with colour vision
    /// deficiency.
    PurpleOrange,
}

/// How values are spread over the colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By logarithm; values that are not positive get the colour of the lower end.
    Log,
}

/// sRGB grey for vertices without a value.
pub const NO_DATA: [u8; 3] = [128, 128, 128];

impl Scale {
    /// Where a value lies in `range` (low, high), from 0 to 1; values outside are clamped. A range of no width maps
    /// everything to 0.
    ///
    /// A logarithmic range whose low end is not positive starts at the smallest positive number that still separates
    /// twelve decades: high / 10^12.
    pub fn position(self, value: f64, [lo, hi]: [f64; 2]) -> f64 {
        let (x, lo, hi) = match self {
            Self::Linear => (value, lo, hi),
            Self::Log if hi <= 0.0 => return 0.0,
            Self::Log => {
                let lo = if lo > 0.0 { lo } else { hi * 1e-12 };
                (value.max(lo).ln(), lo.ln(), hi.ln())
            }
        };
        if hi > lo { ((x - lo) / (hi - lo)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

impl Colormap {
    /// The sRGB colour at `position` from 0 to 1.
    pub fn at(self, position: f64) -> [u8; 3] {
        let gradient = match self {
            Self::Turbo => colorous::TURBO,
            Self::Viridis => colorous::VIRIDIS,
            Self::Cividis => colorous::CIVIDIS,
            Self::PurpleOrange => colorous::PURPLE_ORANGE,
        };
        gradient.eval_continuous(position.clamp(0.0, 1.0)).as_array()
    }
}

/// The sRGB colour of a vertex value; grey when there is none.
pub fn color(map: Colormap, scale: Scale, value: Option<f64>, range: [f64; 2]) -> [u8; 3] {
    value.map_or(NO_DATA, |x| map.at(scale.position(x, range)))
}

#[cfg(test)]
mod tests;
