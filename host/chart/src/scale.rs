//! From numbers to places: 0 at the near end of an axis, 1 at the far one.

use crate::label::label;
use crate::{Axis, Scale};

/// Share of the axis that the lane takes.
const LANE: f64 = 0.17;

/// An axis with its ends.
#[derive(Clone, Debug)]
pub struct Placing {
    scale: Scale,
    unit: String,
    /// Smallest size of a value: where both directions of a signed axis begin.
    smallest: f64,
    ends: [f64; 2],
    lane: f64,
}

impl Placing {
    /// The axis, with ends a little beyond all values.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let mut placing = Self {
            scale: axis.scale,
            unit: axis.unit.clone(),
            smallest: 1.0,
            ends: [0.0, 1.0],
            lane: if axis.lane.is_some() { LANE } else { 0.0 },
        };
        let usable = |x: &f64| x.is_finite() && (axis.scale != Scale::Log || *x > 0.0);
        let values: Vec<f64> = values.filter(usable).collect();
        placing.smallest = values.iter().map(|x| x.abs()).filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min);
        if values.is_empty() || !placing.smallest.is_finite() {
            placing.smallest = 1.0;
        }
        let along = values.iter().map(|x| placing.along(*x));
        let (lo, hi) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
        placing.ends = match axis.scale {
            Scale::Linear if values.is_empty() => [0.0, 1.0],
            Scale::Linear => [lo.min(0.0), if hi > 0.0 { 1.05 * hi } else { 1.0 }],
            Scale::Rows => [-0.7, hi.max(0.0) + 0.7],
            // Without values a share has its own range, and nothing else minds.
            Scale::Log | Scale::Signed if values.is_empty() => [-4.0, 0.0],
            Scale::Log | Scale::Signed => {
                let room = (0.05 * (hi - lo)).max(0.15);
                [lo - room, hi + room]
            }
        };
        placing
    }

    /// Where a value lies; the middle of the lane without one.
    pub fn at(&self, value: Option<f64>) -> f64 {
        let Some(value) = value else { return 0.5 * self.lane };
        let [lo, hi] = self.ends;
        let share = ((self.along(value) - lo) / (hi - lo)).clamp(0.0, 1.0);
        let share = if self.scale == Scale::Rows { 1.0 - share } else { share };
        self.lane + (1.0 - self.lane) * share
    }

    /// Round values with their places and labels.
    pub fn ticks(&self, at_most: usize) -> Vec<(f64, String)> {
        let values = match self.scale {
            Scale::Rows => Vec::new(),
            Scale::Linear => self.evenly(at_most),
            Scale::Log => self.decades(at_most),
            Scale::Signed => self.both_ways(at_most),
        };
        values.into_iter().map(|value| (self.at(Some(value)), label(value, &self.unit))).collect()
    }

    /// Where the lane ends, if there is one.
    pub fn lane(&self) -> Option<f64> {
        (self.lane > 0.0).then_some(self.lane)
    }

    fn along(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear | Scale::Rows => value,
            Scale::Log => value.max(f64::MIN_POSITIVE).log10(),
            Scale::Signed if value == 0.0 => 0.0,
            Scale::Signed => value.signum() * (1.0 + (value.abs() / self.smallest).log10().max(0.0)),
        }
    }

    fn evenly(&self, at_most: usize) -> Vec<f64> {
        let [lo, hi] = self.ends;
        let rough = (hi - lo) / at_most.max(2) as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step = decade * [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * decade >= rough).unwrap_or(10.0);
        let first = (lo / step).ceil() as i64;
        (first..).map(|i| i as f64 * step).take_while(|x| *x <= hi).take(20).collect()
    }

    fn decades(&self, at_most: usize) -> Vec<f64> {
        let [lo, hi] = self.ends;
        let within = |mantissas: &[f64]| -> Vec<f64> {
            let decades = lo.floor() as i32..=hi.ceil() as i32;
            let all = decades.flat_map(|d| mantissas.iter().map(move |m| m * 10f64.powi(d)));
            all.filter(|x| (lo..=hi).contains(&x.log10())).collect()
        };
        let [dense, some, whole] = [&[1.0, 2.0, 5.0][..], &[1.0, 3.0], &[1.0]].map(within);
        if dense.len() <= at_most {
            dense
        } else if some.len() <= at_most {
            some
        } else {
            let every = whole.len().div_ceil(at_most.max(1));
            whole.into_iter().step_by(every.max(1)).collect()
        }
    }

    fn both_ways(&self, at_most: usize) -> Vec<f64> {
        let [lo, hi] = self.ends;
        let first = self.smallest.log10().ceil() as i32;
        let reach = |end: f64| if end > 1.0 { (self.smallest.log10() + end - 1.0).floor() as i32 } else { first - 1 };
        let sides = [(-1.0, reach(-lo)), (1.0, reach(hi))];
        let all: i32 = sides.iter().map(|(_, last)| last - first + 1).sum();
        let every = (all as usize).div_ceil(at_most.max(1)).max(1);
        let side = |(sign, last): (f64, i32)| (first..=last).rev().step_by(every).map(move |d| sign * 10f64.powi(d));
        sides.into_iter().flat_map(side).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placing(scale: Scale, values: &[f64]) -> Placing {
        Placing::new(&Axis::new("x", "", scale), values.iter().copied())
    }

    #[test]
    fn logarithms_give_equal_steps_and_round_ticks() {
        let x = placing(Scale::Log, &[1.0, 100.0]);
        let [a, b, c] = [1.0, 10.0, 100.0].map(|v| x.at(Some(v)));
        assert!((b - a - (c - b)).abs() < 1e-12 && a > 0.0 && c < 1.0);
        assert_eq!(x.ticks(3).into_iter().map(|(_, text)| text).collect::<Vec<_>>(), ["1", "10", "100"]);
        assert!(placing(Scale::Log, &[1e-9, 1e9]).ticks(7).len() <= 7);
    }

    #[test]
    fn a_signed_axis_mirrors() {
        let x = placing(Scale::Signed, &[-1e-2, -1e-8, 1e-8, 1e-2]);
        let [far, near, zero] = [1e-2, 1e-8, 0.0].map(|v| x.at(Some(v)));
        assert!((x.at(Some(-1e-2)) + far - 1.0).abs() < 1e-12 && (x.at(Some(-1e-8)) + near - 1.0).abs() < 1e-12);
        assert!((zero - 0.5).abs() < 1e-12 && near > zero && far > near);
        assert!(x.ticks(8).iter().any(|(_, text)| text.starts_with('-')));
    }

    #[test]
    fn what_has_no_value_stands_in_the_lane() {
        let axis = Axis { lane: Some("none".into()), ..Axis::new("x", "share", Scale::Log) };
        let x = Placing::new(&axis, [1e-4, 1e-2].into_iter());
        let lane = x.lane().expect("a lane");
        assert!(x.at(None) < lane && x.at(Some(1e-4)) > lane);
    }

    #[test]
    fn rows_go_down_and_nothing_is_no_number() {
        let rows = placing(Scale::Rows, &[0.0, 1.0, 2.0]);
        assert!(rows.at(Some(0.0)) > rows.at(Some(2.0)));
        for scale in [Scale::Linear, Scale::Log, Scale::Signed, Scale::Rows] {
            assert!(placing(scale, &[]).at(Some(1.0)).is_finite());
            assert!(placing(scale, &[7.0]).at(Some(7.0)).is_finite());
        }
    }
}
