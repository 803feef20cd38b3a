//! Numbers on axes, as people read them.

/// A value in its unit, short.
pub fn label(value: f64, unit: &str) -> String {
    let pick = |table: &[(f64, &str)]| {
        let (factor, name) = table.iter().rev().find(|(f, _)| value.abs() >= *f * 0.999).or(table.first()).copied()?;
        Some(format!("{} {name}", plain(value / factor)).trim_end().to_owned())
    };
    let known = match unit {
        "ns" => pick(&[(1.0, "ns"), (1e3, "µs"), (1e6, "ms"), (1e9, "s")]),
        "1/s" => pick(&[(1.0, ""), (1e3, "k"), (1e6, "M"), (1e9, "G")]),
        "share" if value == 0.0 || value.abs() >= 0.999e-3 => Some(format!("{} %", plain(100.0 * value))),
        _ => None,
    };
    known.unwrap_or_else(|| plain(value))
}

/// Without a unit: at most three digits, as a power of ten when far from 1.
fn plain(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.abs() < 0.999e-2 || value.abs() >= 99_999.0 {
        return format!("{value:.0e}");
    }
    let digits = (2 - value.abs().log10().floor() as i32).clamp(0, 4) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_their_unit() {
        let all =
            [(1e3, "ns"), (5e5, "ns"), (2e4, "1/s"), (0.5, "1/s"), (0.01, "share"), (1e-5, "share"), (0.25, "share")];
        let texts = all.map(|(value, unit)| label(value, unit));
        assert_eq!(texts, ["1 µs", "500 µs", "20 k", "0.5", "1 %", "1e-5", "25 %"]);
        assert_eq!([label(0.0, "share"), label(12.0, "digits"), label(-1e-6, "of S")], ["0 %", "12", "-1e-6"]);
    }
}
