use super::*;

#[test]
fn turbo_runs_from_dark_over_blue_green_and_yellow_to_dark_red() {
    let [low, middle, high] = [0.0, 0.5, 1.0].map(|t| Colormap::Turbo.at(t));
    assert!(low.iter().all(|&c| c < 110), "{low:?}");
    let blue = Colormap::Turbo.at(0.15);
    assert!(blue[2] > 200 && blue[2] > blue[0] && blue[2] > blue[1], "{blue:?}");
    assert!(middle[1] > 200 && middle[1] > middle[0] && middle[1] > middle[2], "{middle:?}");
    assert!(high[0] > 100 && high[1] < 40 && high[2] < 40, "{high:?}");
}

#[test]
fn viridis_and_cividis_grow_brighter() {
    for map in [Colormap::Viridis, Colormap::Cividis] {
        let light =
            |t: f64| map.at(t).iter().zip([0.2126, 0.7152, 0.0722]).map(|(&c, w)| f64::from(c) * w).sum::<f64>();
        assert!((0..20).all(|i| light(f64::from(i) / 20.0) < light(f64::from(i + 1) / 20.0)), "{map:?}");
    }
}

#[test]
fn linear_positions_are_even_and_clamped() {
    let at = |x| Scale::Linear.position(x, [10.0, 20.0]);
    assert_eq!([at(10.0), at(12.5), at(20.0), at(0.0), at(99.0)], [0.0, 0.25, 1.0, 0.0, 1.0]);
}

#[test]
fn logarithmic_positions_are_even_per_decade() {
    let at = |x| Scale::Log.position(x, [1.0, 10_000.0]);
    assert!((at(100.0) - 0.5).abs() < 1e-12);
    assert_eq!([at(1.0), at(0.0), at(-5.0), at(1e9)], [0.0, 0.0, 0.0, 1.0]);
    assert!((Scale::Log.position(1.0, [0.0, 1e6]) - 0.5).abs() < 1e-12, "a range from 0 spans twelve decades");
    assert_eq!(Scale::Log.position(-1.0, [-2.0, -1.0]), 0.0);
}

#[test]
fn a_range_without_width_has_one_color() {
    for scale in [Scale::Linear, Scale::Log] {
        assert_eq!(scale.position(3.0, [3.0, 3.0]), 0.0);
    }
}

#[test]
fn no_value_is_grey() {
    assert_eq!(color(Colormap::Turbo, Scale::Linear, None, [0.0, 1.0]), NO_DATA);
    assert_eq!(color(Colormap::Turbo, Scale::Linear, Some(1.0), [0.0, 1.0]), Colormap::Turbo.at(1.0));
}

#[test]
fn a_difference_is_purple_below_white_at_zero_and_orange_above() {
    let [low, middle, high] = [0.0, 0.5, 1.0].map(|t| Colormap::PurpleOrange.at(t));
    assert!(low[2] > low[0] && low[2] > low[1], "{low:?}");
    assert!(middle.iter().all(|&c| c > 230), "{middle:?}");
    assert!(high[0] > high[1] && high[1] > high[2], "{high:?}");
}
