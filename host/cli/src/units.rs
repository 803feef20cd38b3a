//! Numbers as people read them.

/// Nanoseconds with three digits and a fitting unit.
pub fn time(ns: f64) -> String {
    let (value, unit) = match ns.abs() {
        x if x < 1e3 => (ns, "ns"),
        x if x < 1e6 => (ns / 1e3, "µs"),
        x if x < 1e9 => (ns / 1e6, "ms"),
        _ => (ns / 1e9, "s"),
    };
    format!("{} {unit}", digits(value))
}

/// Seconds that somebody waits.
pub fn wait(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "less than a second".to_owned(),
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// A count that is a mean.
pub fn mean(value: f64) -> String {
    if value >= 1000.0 { format!("{value:.0}") } else { digits(value) }
}

/// Bytes in binary units.
pub fn bytes(count: u64) -> String {
    let value = count as f64;
    match count {
        0..1024 => format!("{count} B"),
        1024..1_048_576 => format!("{} KiB", digits(value / 1024.0)),
        1_048_576..1_073_741_824 => format!("{} MiB", digits(value / 1_048_576.0)),
        _ => format!("{} GiB", digits(value / 1_073_741_824.0)),
    }
}

/// Three significant digits, as far as they lie behind the point.
fn digits(value: f64) -> String {
    match value.abs() {
        x if x < 10.0 => format!("{value:.2}"),
        x if x < 100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_fitting_units() {
        assert_eq!(time(512.3), "512 ns");
        assert_eq!(time(1_234.0), "1.23 µs");
        assert_eq!(time(98_760.0), "98.8 µs");
        assert_eq!(time(2.5e9), "2.50 s");
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(1536), "1.50 KiB");
        assert_eq!(mean(12.34), "12.3");
        assert_eq!(mean(123_456.7), "123457");
        assert_eq!(wait(0.2), "less than a second");
        assert_eq!(wait(600.0), "10 min");
    }
}
