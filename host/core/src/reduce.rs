//! The fewest parts of a thing that still show a failure: delta debugging.

/// Looks for a small set of the parts `0..count` for which `fails` still holds, with at most `tries` questions.
///
/// `fails` is taken to hold for all of them. Parts are left out in ever smaller portions; what is given back failed, and
/// with tries left none of its parts can be left out alone.
pub fn reduce(count: usize, mut tries: usize, mut fails: impl FnMut(&[usize]) -> bool) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..count).collect();
    let mut portion = count.div_ceil(2);
    while portion > 0 && kept.len() > 1 {
        let mut start = 0;
        let mut shrunk = false;
        while start < kept.len() && tries > 0 {
            let end = (start + portion).min(kept.len());
            let rest: Vec<usize> = kept[..start].iter().chain(&kept[end..]).copied().collect();
            tries -= 1;
            if !rest.is_empty() && fails(&rest) {
                kept = rest;
                shrunk = true;
            } else {
                start = end;
            }
        }
        if tries == 0 {
            break;
        }
        // At portions of one it goes round until nothing more can go.
        portion = if portion == 1 { usize::from(shrunk) } else { portion.div_ceil(2) };
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_needed_stays_and_nothing_else() {
        let mut asked = 0;
        let needs = |set: &[usize]| [3, 77].iter().all(|part| set.contains(part));
        let kept = reduce(100, 1000, |set| {
            asked += 1;
            needs(set)
        });
        assert_eq!(kept, [3, 77]);
        assert!(asked < 100, "{asked}");
        assert_eq!(reduce(5, 1000, |_| true).len(), 1);
        assert_eq!(reduce(5, 1000, |_| false), [0, 1, 2, 3, 4]);
        assert_eq!(reduce(1, 1000, |_| true), [0]);
        // Few tries: larger than need be, but failing.
        let kept = reduce(100, 5, needs);
        assert!(kept.len() < 100 && needs(&kept));
    }
}
