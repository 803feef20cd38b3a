//! The question, with its lengths as people write them: 1%, 0.5mm, 0.02.

use ocb_advice::Question;

use crate::args::{AdviseArgs, Unit};
use crate::failure::{Failure, Result};

/// Tolerance when none is given.
const USUAL_TOLERANCE: Length = Length::Share(0.01);

/// A length as it was written.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Length {
    /// A share of A's longest side.
    Share(f64),
    /// In the objects' unit.
    Units(f64),
}

/// What is asked, before the objects are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    tolerance: Length,
    clearance: Option<Length>,
}

impl Wanted {
    /// Reads the arguments.
    pub fn read(args: &AdviseArgs) -> Result<Self> {
        let clearance = match args.question.split_once('=') {
            Some(("clearance", given)) => Some(length("The clearance", given, args.unit, true)?),
            None if args.question == "distance" => None,
            _ => {
                return Err(Failure::Input(format!(
                    "--question must be distance or clearance=LENGTH, not {}.",
                    args.question
                )));
            }
        };
        let given = args.tolerance.as_deref().map(|given| length("The tolerance", given, args.unit, false));
        let given = given.transpose()?;
        if clearance.is_some() && given.is_some() {
            eprintln!("ocb: The tolerance has no effect on a clearance query, which is answered exactly.");
        }
        if let Some(wrong) = args.distance.iter().find(|x| !(0.0..=1000.0).contains(*x)) {
            return Err(Failure::Input(format!("The relative distance must be a number from 0 to 1000, not {wrong}.")));
        }
        Ok(Self { tolerance: given.unwrap_or(USUAL_TOLERANCE), clearance })
    }

    /// The question to objects of which A has this longest side.
    pub fn question(&self, longest_side: f64) -> Question {
        let of = |length: Length| match length {
            Length::Share(share) => share * longest_side,
            Length::Units(units) => units,
        };
        match self.clearance {
            Some(clearance) => Question::Clearance { clearance: of(clearance) },
            None => Question::Distance { tolerance: of(self.tolerance) },
        }
    }
}

/// A length of a scene, in its unit.
pub fn of_scene(what: &str, given: &str, unit: Unit, zero: bool) -> Result<f64> {
    match length(what, given, unit, zero)? {
        Length::Units(units) => Ok(units),
        Length::Share(_) => Err(Failure::Input(format!("{what} must be a length such as 1mm, not a share."))),
    }
}

fn length(what: &str, given: &str, unit: Unit, zero: bool) -> Result<Length> {
    let metres = |unit| match unit {
        Unit::Mm => 0.001,
        Unit::Cm => 0.01,
        Unit::M => 1.0,
    };
    let end = given.find(|c: char| c.is_ascii_alphabetic() && c != 'e' && c != 'E' || c == '%').unwrap_or(given.len());
    let (number, suffix) = given.split_at(end);
    let number: Option<f64> =
        number.trim().parse().ok().filter(|x: &f64| x.is_finite() && (*x > 0.0 || zero && *x == 0.0));
    let named = |named: Unit, x: f64| Length::Units(x * metres(named) / metres(unit));
    let read = number.and_then(|x| match suffix {
        "%" => Some(Length::Share(x / 100.0)),
        "" => Some(Length::Units(x)),
        "mm" => Some(named(Unit::Mm, x)),
        "cm" => Some(named(Unit::Cm, x)),
        "m" => Some(named(Unit::M, x)),
        _ => None,
    });
    read.ok_or_else(|| {
        let least = if zero { "of at least 0" } else { "above 0" };
        Failure::Input(format!(
            "{what} must be a length {least} such as 1%, 0.5mm or 0.02 (units of the files), not {given}."
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_shares_units_or_metric() {
        let read = |given| length("It", given, Unit::Cm, true).ok();
        assert_eq!(read("1%"), Some(Length::Share(0.01)));
        assert_eq!(read("2e-3"), Some(Length::Units(0.002)));
        assert_eq!(read("5mm"), Some(Length::Units(0.5)));
        assert_eq!(read("0"), Some(Length::Units(0.0)));
        for wrong in ["-1", "1ft", "", "%", "nan", "1 %%"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
        assert!(length("It", "0", Unit::Mm, false).is_err());
    }
}
