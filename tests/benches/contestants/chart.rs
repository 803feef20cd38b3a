//! The rows as a picture: one panel per object and workload, a line per contestant, time on a logarithmic axis.

use std::fmt::Write;

use crate::report::Row;

const LEFT: f64 = 190.0;
const WIDTH: f64 = 560.0;
const LINE: f64 = 18.0;
const HEAD: f64 = 46.0;

/// A picture that stands alone: title, axis with unit, legend, n.
pub fn svg(rows: &[Row], machine: &str) -> String {
    let mut groups: Vec<(String, Vec<&Row>)> = Vec::new();
    for row in rows.iter().filter(|row| row.median_ns.is_some()) {
        let title = format!("{}, {}", row.object, row.workload);
        match groups.iter_mut().find(|(known, _)| *known == title) {
            Some((_, members)) => members.push(row),
            None => groups.push((title, vec![row])),
        }
    }
    let lines: usize = groups.iter().map(|(_, members)| members.len()).sum();
    let height = groups.len() as f64 * (HEAD + 34.0) + lines as f64 * LINE + 60.0;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"10\" y=\"20\">Median time per query with its 95 % interval. {}</text>\n\
         <text x=\"10\" y=\"36\">Filled: nothing wrong, ranked. Hollow: wrong answers or no rank.</text>\n",
        LEFT + WIDTH + 170.0,
        escaped(machine)
    );
    let mut y = 50.0;
    for (title, mut members) in groups {
        members.sort_by(|a, b| a.median_ns.map(|m| m[0]).partial_cmp(&b.median_ns.map(|m| m[0])).expect("numbers"));
        y += panel(&mut text, y, &title, &members);
    }
    text.push_str("</svg>\n");
    text
}

/// One panel; its height.
fn panel(text: &mut String, top: f64, title: &str, members: &[&Row]) -> f64 {
    let ends = members.iter().filter_map(|row| row.median_ns);
    let (low, high) = ends.fold((f64::INFINITY, 0.0f64), |(low, high), [_, lo, hi]| (low.min(lo), high.max(hi)));
    let (first, last) = (low.max(1.0).log10().floor(), high.max(10.0).log10().ceil());
    let x = |ns: f64| LEFT + WIDTH * ((ns.max(1.0).log10() - first) / (last - first).max(1.0));
    let body = members.len() as f64 * LINE;
    let mut put = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    put(format!("<text x=\"10\" y=\"{}\" font-weight=\"bold\">{}</text>", top + 24.0, escaped(title)));
    for decade in first as i32..=last as i32 {
        let at = x(10f64.powi(decade));
        put(format!("<path d=\"M{at} {}v{body}\" stroke=\"#ddd\"/>", top + HEAD - 10.0));
        let label = ["1 ns", "10 ns", "100 ns", "1 us", "10 us", "100 us", "1 ms", "10 ms", "100 ms", "1 s", "10 s"];
        let label = usize::try_from(decade).ok().and_then(|i| label.get(i)).copied().unwrap_or("");
        put(format!("<text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{label}</text>", top + HEAD + body + 8.0));
    }
    for (i, row) in members.iter().enumerate() {
        let Some([median, lo, hi]) = row.median_ns else { continue };
        let y = top + HEAD + i as f64 * LINE;
        let fill = if row.rank.is_some() { "#0b5cad" } else { "#fff" };
        put(format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            y + 4.0,
            escaped(&row.algorithm)
        ));
        put(format!("<path d=\"M{} {y}H{}\" stroke=\"#0b5cad\"/>", x(lo), x(hi)));
        put(format!("<circle cx=\"{}\" cy=\"{y}\" r=\"4\" fill=\"{fill}\" stroke=\"#0b5cad\"/>", x(median)));
        let mut note = format!("n = {}", row.n);
        if row.wrong > 0 {
            write!(note, ", {} wrong", row.wrong).expect("text");
        }
        put(format!("<text x=\"{}\" y=\"{}\">{note}</text>", LEFT + WIDTH + 12.0, y + 4.0));
    }
    HEAD + body + 34.0
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
