//! Names beside marks, so that no two lie on each other.

/// A rectangle: left, top, right, bottom.
pub type Rect = [f64; 4];

/// Rough width of a letter and height of a line, as shares of the font's size.
const LETTER: f64 = 0.56;

/// Finds places for texts, one after the other.
pub struct Places {
    within: Rect,
    taken: Vec<Rect>,
}

impl Places {
    /// Inside this rectangle; the marks are to stay free: x, y, and how far each reaches to the right.
    pub fn new(within: Rect, marks: &[[f64; 3]]) -> Self {
        Self { within, taken: marks.iter().map(|[x, y, reach]| [x - 6.0, y - 6.0, x + reach, y + 6.0]).collect() }
    }

    /// Where the text of a mark begins (left end of its base line); right of the mark when nothing is free.
    pub fn beside(&mut self, [x, y, reach]: [f64; 3], letters: usize, size: f64) -> [f64; 2] {
        let width = letters as f64 * size * LETTER;
        let columns = [x + reach + 4.0, x - 10.0 - width, x - 0.5 * width];
        let shifts = [4.0, -9.0, 17.0, -22.0, 30.0, -35.0, 43.0];
        let all = shifts.iter().flat_map(|dy| columns.iter().map(move |left| [*left, y + dy]));
        let rect = |[left, base]: [f64; 2]| [left, base - 0.8 * size, left + width, base + 0.25 * size];
        let free = |place: &[f64; 2]| {
            let me = rect(*place);
            let inside = me[0] >= self.within[0] && me[2] <= self.within[2] && me[1] >= self.within[1];
            inside && me[3] <= self.within[3] && !self.taken.iter().any(|other| overlap(&me, other))
        };
        let place = all.into_iter().find(free).unwrap_or([x + reach + 4.0, y + 4.0]);
        self.taken.push(rect(place));
        place
    }
}

fn overlap(a: &Rect, b: &Rect) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_close_marks_do_not_touch() {
        let marks = [[100.0, 100.0, 6.0], [104.0, 103.0, 6.0], [98.0, 108.0, 6.0], [380.0, 100.0, 6.0]];
        let mut places = Places::new([0.0, 0.0, 400.0, 200.0], &marks);
        let rects: Vec<Rect> = marks
            .iter()
            .map(|mark| places.beside(*mark, 10, 12.0))
            .map(|[left, base]| [left, base - 9.6, left + 10.0 * 12.0 * LETTER, base + 3.0])
            .collect();
        for (i, a) in rects.iter().enumerate() {
            assert!(a[0] >= 0.0 && a[2] <= 400.0, "{a:?}");
            assert!(rects[i + 1..].iter().all(|b| !overlap(a, b)), "{rects:?}");
        }
    }

    #[test]
    fn a_name_stands_behind_the_arrow_of_its_mark() {
        let within = [0.0, 0.0, 400.0, 200.0];
        let x = |reach| Places::new(within, &[[100.0, 100.0, reach]]).beside([100.0, 100.0, reach], 5, 12.0)[0];
        assert_eq!([x(6.0), x(20.0)], [110.0, 124.0]);
    }
}
