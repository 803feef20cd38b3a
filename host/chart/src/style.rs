//! Eight ways of drawing a series, told apart by colour, dash and mark. The pages have the same eight.

/// One of them.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Colour on white.
    pub colour: &'static str,
    /// Dash pattern; empty: a solid line.
    pub dash: &'static str,
    /// Path of the mark around 0,0.
    pub mark: &'static str,
}

const COLOURS: [&str; 4] = ["#0a62a3", "#a65300", "#00704f", "#94407f"];

const fn style(colour: usize, dash: &'static str, mark: &'static str) -> Style {
    Style { colour: COLOURS[colour], dash, mark }
}

/// All of them.
pub const STYLES: [Style; 8] = [
    style(0, "", "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z"),
    style(1, "8 4", "M-4-4h8v8h-8Z"),
    style(2, "2 4", "M0-5 5 4h-10Z"),
    style(3, "9 3 2 3", "M0-5.5 5.5 0 0 5.5-5.5 0Z"),
    style(0, "14 4", "M0 5-5-4h10Z"),
    style(1, "4 2", "M-1.5-5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5Z"),
    style(2, "12 3 2 3 2 3", "M-5-5h10l-3 5 3 5h-10l3-5Z"),
    style(3, "1 3", "M0-5.5 5-1v5.5h-10V-1Z"),
];

impl Style {
    /// The style of that number; grey lines have none.
    pub fn of(number: Option<u8>) -> Self {
        number.map_or(Self { colour: "#5d646d", ..STYLES[0] }, |n| STYLES[n as usize % STYLES.len()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pages_have_the_same_eight() {
        let pages = include_str!("../../../web/app/src/charts/series-style.ts");
        let tokens = include_str!("../../../web/app/src/style/tokens.css");
        for (i, Style { colour, dash, mark }) in STYLES.iter().enumerate() {
            assert!(pages.contains(&format!("dash: '{dash}', marker: '{mark}'")), "style {i} differs");
            assert!(tokens.contains(&format!("--series-{}: light-dark({colour}", i % 4)), "colour {i} differs");
        }
    }
}
