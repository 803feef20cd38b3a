//! A drawing as PNG.

use resvg::render;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::failure::{Failure, Result};

/// Pixels of a unit of the drawing: sharp on paper and on dense screens.
const SCALE: u32 = 2;

/// A drawing as PNG. Its letters come with this program: a machine without any font draws the same picture.
pub fn png(svg: &str) -> Result<Vec<u8>> {
    let fault = |what: String| Failure::Fault(format!("Drawing the picture failed: {what}."));
    let tree = Tree::from_str(svg, &letters()).map_err(|e| fault(e.to_string()))?;
    let size = tree.size().to_int_size();
    let pixels = Pixmap::new(SCALE * size.width(), SCALE * size.height());
    let mut pixels = pixels.ok_or_else(|| fault("it is too large".to_owned()))?;
    render(&tree, Transform::from_scale(SCALE as f32, SCALE as f32), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| fault(e.to_string()))
}

fn letters() -> Options<'static> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    // The second has what the first lacks: arrows and raised digits.
    for font in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("Ubuntu");
    options
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many pixels of a picture of these words are not white.
    fn ink(words: &str) -> usize {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"40\" font-family=\"sans-serif\">\
             <rect width=\"90\" height=\"40\" fill=\"#fff\"/><text x=\"9\" y=\"30\">{words}</text></svg>"
        );
        let pixels = Pixmap::decode_png(&png(&svg).expect("a picture")).expect("a PNG");
        assert_eq!((pixels.width(), pixels.height()), (180, 80));
        pixels.pixels().iter().filter(|pixel| pixel.red() < 128).count()
    }

    #[test]
    fn every_letter_of_our_charts_is_drawn() {
        assert_eq!(ink(""), 0);
        for letter in ["a", "µ", "ε", "≤", "×", "–", "→", "←", "⁻", "⁶"] {
            assert!(ink(letter) > 4, "{letter}");
        }
    }
}
