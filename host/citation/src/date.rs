//! Days of the calendar.

/// Year, month and day of a time in microseconds since the Unix epoch, UTC, in the Gregorian calendar.
///
/// Years are counted from 1 March of year 0, so that the odd day comes last, and by eras of 400, which all have the same
/// number of days (E. M. Reingold, N. Dershowitz, *Calendrical Calculations*).
pub fn date(at_us: i64) -> (i64, usize, i64) {
    const DAY_US: i64 = 24 * 3600 * 1_000_000;
    const ERA: i64 = 146_097;
    let days = at_us.div_euclid(DAY_US) + 719_468;
    let (era, day) = (days.div_euclid(ERA), days.rem_euclid(ERA));
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    // March is 0: five months have 153 days, in the same pattern again and again.
    let month = (5 * day + 2) / 153;
    let in_month = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    (era * 400 + year + later, month as usize, in_month)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        let of = |seconds: i64| date(seconds * 1_000_000);
        assert_eq!(of(0), (1970, 1, 1));
        assert_eq!(of(-1), (1969, 12, 31));
        assert_eq!(of(951_782_399), (2000, 2, 28));
        assert_eq!(of(951_782_400), (2000, 2, 29));
        assert_eq!(of(1_709_251_200), (2024, 3, 1));
        assert_eq!(of(1_795_305_599), (2026, 11, 21));
        assert_eq!(of(4_107_542_400), (2100, 3, 1));
        // Every day of eight centuries follows the one before.
        let mut last = of(-86_400);
        for day in 0..292_194 {
            let (year, month, in_month) = of(day * 86_400);
            let next = (year, month, in_month) == (last.0, last.1, last.2 + 1);
            let first = in_month == 1 && (month == last.1 % 12 + 1) && year == last.0 + i64::from(month == 1);
            assert!(next || first, "{last:?} is followed by {year}-{month}-{in_month}");
            last = (year, month, in_month);
        }
        assert_eq!(last, (2769, 12, 31));
    }
}
