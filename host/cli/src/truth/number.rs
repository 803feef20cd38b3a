//! Decimal and C99 hexadecimal numbers, each rounded to the nearest f64 once.

/// A finite number, or why the word is none.
pub fn number(word: &str) -> Result<f64, String> {
    let (negative, digits) = match word.as_bytes().first() {
        Some(b'-') => (true, &word[1..]),
        Some(b'+') => (false, &word[1..]),
        _ => (false, word),
    };
    let hexadecimal = digits.strip_prefix("0x").or_else(|| digits.strip_prefix("0X"));
    let magnitude = match hexadecimal {
        Some(rest) => hex(rest).ok_or_else(|| format!("{word:?} is not a hexadecimal number"))?,
        // Only digits: words such as "nan" and "infinity" are no coordinates.
        None if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            return Err(format!("{word:?} is not a finite number"));
        }
        None => digits.parse::<f64>().map_err(|_| format!("{word:?} is not a number"))?,
    };
    if magnitude.is_infinite() {
        return Err(format!("{word:?} is beyond the range of double precision"));
    }
    Ok(if negative { -magnitude } else { magnitude })
}

/// `h.hhhp±d` behind the prefix; the point and the exponent may be missing.
fn hex(text: &str) -> Option<f64> {
    let (mantissa, exponent) = match text.split_once(['p', 'P']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    // The value is `head * 2^shift`, plus something below one unit of the head when digits were dropped from it.
    let (mut head, mut shift, mut dropped) = (0u128, 0i64, false);
    for (digit, behind_point) in whole.bytes().map(|c| (c, false)).chain(fraction.bytes().map(|c| (c, true))) {
        let digit = char::from(digit).to_digit(16)?;
        if head >> 120 == 0 {
            head = head << 4 | u128::from(digit);
            shift -= if behind_point { 4 } else { 0 };
        } else {
            dropped |= digit != 0;
            shift += if behind_point { 0 } else { 4 };
        }
    }
    Some(rounded(head, dropped, shift.saturating_add(exponent)))
}

/// The f64 nearest to `head * 2^shift` (to even on ties); `dropped`: a little more than that.
fn rounded(head: u128, dropped: bool, shift: i64) -> f64 {
    if head == 0 {
        return 0.0;
    }
    let length = i64::from(128 - head.leading_zeros());
    // The last bit kept: 53 bits, fewer below the normal range.
    let last = (shift.saturating_add(length) - 53).max(-1074);
    let cut = last.saturating_sub(shift);
    let kept = if cut <= 0 {
        // Nothing is cut; `dropped` digits only follow 120 bits, of which most are cut.
        head << (-cut).min(127)
    } else if cut > 128 {
        0
    } else {
        let whole = if cut == 128 { 0 } else { head >> cut };
        let rest = if cut == 128 { head } else { head & ((1 << cut) - 1) };
        let half = 1u128 << (cut - 1);
        let up = rest > half || (rest == half && (dropped || whole & 1 == 1));
        whole + u128::from(up)
    };
    // At most 54 bits, so exact; two factors, because one alone may leave the range.
    let last = last.clamp(-1074, 2000) as i32;
    kept as f64 * 2f64.powi(last / 2) * 2f64.powi(last - last / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_once() {
        let cases = [
            ("0x1p+0", 1.0),
            ("-0x1.8p1", -3.0),
            ("0X1.FFFFFFFFFFFFFP+1023", f64::MAX),
            ("0x1p-1074", 5e-324),
            ("0x0.8p-1073", 5e-324),
            ("0x1p-1022", f64::MIN_POSITIVE),
            ("0x1.8p-1074", 1e-323),
            ("0x1p-1075", 0.0),
            ("0x1.0000000000001p-1075", 5e-324),
            ("0x1.00000000000008p0", 1.0),
            ("0x1.000000000000081p0", 1.0 + f64::EPSILON),
            ("0x1.00000000000018p0", 1.0 + 2.0 * f64::EPSILON),
            ("0x1.000000000000080000000000000000000000000000000001p0", 1.0 + f64::EPSILON),
            ("0x10000000000000000000000000000000000000000000000000000p-208", 1.0),
            ("0xff", 255.0),
            ("0x.8", 0.5),
            ("0x0p0", 0.0),
            ("0x1.f400000000004p+12", 8000.000000000004),
            ("1.8189894035458565e-12", 1.8189894035458565e-12),
            ("+2.5", 2.5),
            (".5", 0.5),
            ("0e0", 0.0),
        ];
        for (word, expected) in cases {
            assert_eq!(number(word).map(f64::to_bits), Ok(f64::to_bits(expected)), "{word}");
        }
        assert_eq!(number("-0x0p0").map(f64::to_bits), Ok((-0.0f64).to_bits()));
    }

    #[test]
    fn what_is_no_finite_number_is_refused() {
        for word in
            ["", "-", "nan", "inf", "-infinity", "0x", "0x.p1", "0x1p", "0x1g", "0x1p1.5", "1e999", "0x1p1024", "1,5"]
        {
            assert!(number(word).is_err(), "{word}");
        }
        assert!(number("0x1.fffffffffffff8p1023").is_err(), "rounds beyond the range");
    }
}
