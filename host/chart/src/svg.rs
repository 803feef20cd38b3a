//! A chart as a file that stands alone: title, axes with units, key with n, intervals, notes.

use crate::place::Places;
use crate::{Chart, Form, Placing, Point, Scale, Series, Style};

const WIDTH: f64 = 820.0;
const LETTERS: usize = 118;
const ROW: f64 = 19.0;

/// One chart.
pub fn chart(chart: &Chart) -> String {
    page(std::slice::from_ref(chart))
}

/// Several charts, one below the other.
pub fn page(charts: &[Chart]) -> String {
    let (mut body, mut y) = (String::new(), 0.0);
    for chart in charts {
        y += Drawing::new(chart, y).draw(&mut body);
    }
    let titles: Vec<String> = charts.iter().map(|chart| escaped(&chart.title)).collect();
    let findings: Vec<String> = charts.iter().map(|chart| escaped(&chart.finding)).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {y}\" width=\"{WIDTH}\" height=\"{y}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#1c2025\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n",
        titles.join("; "),
        findings.join(" ")
    )
}

struct Drawing<'a> {
    chart: &'a Chart,
    x: Placing,
    y: Placing,
    /// Of the plot: left, top, right, bottom.
    plot: [f64; 4],
    top: f64,
    head: Vec<String>,
}

impl<'a> Drawing<'a> {
    fn new(chart: &'a Chart, top: f64) -> Self {
        let rows = chart.y.scale == Scale::Rows;
        let head = wrapped(&chart.finding);
        let first = top + 44.0 + head.len() as f64 * 16.0;
        let height = if rows { ROW * (chart.series.len() as f64 + 0.4) } else { 340.0 };
        Self {
            chart,
            x: Placing::new(&chart.x, chart.xs()),
            y: Placing::new(&chart.y, chart.ys()),
            plot: [if rows { 210.0 } else { 76.0 }, first, WIDTH - if rows { 190.0 } else { 24.0 }, first + height],
            top,
            head,
        }
    }

    /// Writes everything; the height.
    fn draw(&self, text: &mut String) -> f64 {
        put(
            text,
            format!(
                "<text x=\"12\" y=\"{}\" font-size=\"16\" font-weight=\"bold\">{}</text>",
                self.top + 24.0,
                escaped(&self.chart.title)
            ),
        );
        for (i, line) in self.head.iter().enumerate() {
            put(text, format!("<text x=\"12\" y=\"{}\">{}</text>", self.top + 44.0 + 16.0 * i as f64, escaped(line)));
        }
        self.grid(text);
        self.chart.series.iter().enumerate().for_each(|(row, series)| self.series(text, series, row));
        if self.chart.y.scale != Scale::Rows {
            self.names(text);
        }
        let mut y = self.plot[3] + 58.0;
        if self.chart.y.scale != Scale::Rows {
            for series in self.chart.series.iter().filter(|series| series.form != Form::Rule) {
                self.key(text, series, y);
                y += ROW;
            }
        }
        for line in self.chart.notes.iter().flat_map(|note| wrapped(note)) {
            put(text, format!("<text x=\"12\" y=\"{y}\" fill=\"#474e57\">{}</text>", escaped(&line)));
            y += 16.0;
        }
        y + 14.0 - self.top
    }

    fn at(&self, point: &Point) -> [f64; 2] {
        [self.across(point.x), self.up(point.y)]
    }

    fn across(&self, x: Option<f64>) -> f64 {
        let [left, _, right, _] = self.plot;
        round(left + (right - left) * self.x.at(x))
    }

    fn up(&self, y: f64) -> f64 {
        let [_, top, _, bottom] = self.plot;
        round(bottom - (bottom - top) * self.y.at(Some(y)))
    }

    fn grid(&self, text: &mut String) {
        let [left, top, right, bottom] = self.plot;
        let small = "font-size=\"11\" fill=\"#474e57\"";
        if let (Some(end), Some(name)) = (self.x.lane(), &self.chart.x.lane) {
            let width = (right - left) * end - 6.0;
            put(
                text,
                format!(
                    "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{}\" fill=\"#e8eef2\"/>",
                    bottom - top
                ),
            );
            put(
                text,
                format!(
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" {small}>{}</text>",
                    left + 0.5 * width,
                    bottom + 16.0,
                    escaped(name)
                ),
            );
        }
        for (share, label) in self.x.ticks(8) {
            let x = round(left + (right - left) * share);
            put(text, format!("<path d=\"M{x} {top}V{bottom}\" stroke=\"#ddd\"/>"));
            put(text, format!("<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\" {small}>{label}</text>", bottom + 16.0));
        }
        for (share, label) in self.y.ticks(7) {
            let y = round(bottom - (bottom - top) * share);
            put(text, format!("<path d=\"M{left} {y}H{right}\" stroke=\"#ddd\"/>"));
            put(
                text,
                format!("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" {small}>{label}</text>", left - 7.0, y + 4.0),
            );
        }
        let middle = 0.5 * (left + right);
        put(
            text,
            format!(
                "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" {small}>{}</text>",
                bottom + 34.0,
                escaped(&self.chart.x.label)
            ),
        );
        if self.chart.y.scale != Scale::Rows {
            let centre = 0.5 * (top + bottom);
            put(
                text,
                format!(
                    "<text transform=\"translate(16,{centre}) rotate(-90)\" text-anchor=\"middle\" {small}>{}</text>",
                    escaped(&self.chart.y.label)
                ),
            );
        }
    }

    fn series(&self, text: &mut String, series: &Series, row: usize) {
        let style = Style::of(series.style);
        let dash = if style.dash.is_empty() || series.style.is_none() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", style.dash)
        };
        let width = if series.form == Form::Rule { 1.2 } else { 1.8 };
        if series.points.len() > 1 {
            put(
                text,
                format!(
                    "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"{dash}/>",
                    self.path(series),
                    style.colour
                ),
            );
        }
        if series.form != Form::Line {
            return;
        }
        for point in &series.points {
            let [x, y] = self.at(point);
            let mut bar =
                |d: String| put(text, format!("<path d=\"{d}\" stroke=\"{}\" stroke-width=\"1.2\"/>", style.colour));
            if let (Some(lo), Some(hi)) = (point.y_lo, point.y_hi) {
                bar(format!("M{x} {}V{}", self.up(lo), self.up(hi)));
            }
            if let (Some(_), Some(lo), Some(hi)) = (point.x, point.x_lo, point.x_hi) {
                bar(format!("M{} {y}H{}", self.across(Some(lo)), self.across(Some(hi))));
            }
            if point.at_least {
                put(text, format!("<path d=\"M{x} {y}h20m-5-4l5 4l-5 4\" fill=\"none\" stroke=\"{}\"/>", style.colour));
            }
            let fill = if point.filled { style.colour } else { "#fff" };
            put(
                text,
                format!(
                    "<path d=\"{}\" transform=\"translate({x},{y})\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"1.5\"/>",
                    style.mark, style.colour
                ),
            );
        }
        if self.chart.y.scale == Scale::Rows {
            let y = self.up(row as f64) + 4.0;
            put(
                text,
                format!(
                    "<text x=\"{}\" y=\"{y}\" text-anchor=\"end\">{}</text>",
                    self.plot[0] - 8.0,
                    escaped(&series.name)
                ),
            );
            for point in &series.points {
                put(
                    text,
                    format!(
                        "<text x=\"{}\" y=\"{y}\">n = {}{}</text>",
                        self.plot[2] + 12.0,
                        point.n,
                        fault_spans(point)
                    ),
                );
            }
        }
    }

    /// The line; on a signed axis it breaks where the sign changes.
    fn path(&self, series: &Series) -> String {
        let mut d = String::new();
        let mut before: Option<&Point> = None;
        for point in &series.points {
            let [x, y] = self.at(point);
            let broken =
                |b: &Point| self.chart.x.scale == Scale::Signed && b.x.map(f64::signum) != point.x.map(f64::signum);
            let step = match before {
                None => format!("M{x} {y}"),
                Some(b) if broken(b) => format!("M{x} {y}"),
                Some(_) if series.form == Form::Steps => format!("H{x}V{y}"),
                Some(_) => format!("L{x} {y}"),
            };
            d.push_str(&step);
            before = Some(point);
        }
        d
    }

    fn names(&self, text: &mut String) {
        let points = || self.chart.series.iter().filter(|s| s.form == Form::Line).flat_map(|s| &s.points);
        let marks: Vec<[f64; 2]> = points().map(|point| self.at(point)).collect();
        let mut places = Places::new(self.plot, &marks);
        for (point, mark) in points().zip(&marks) {
            let Some(name) = &point.name else { continue };
            let letters = name.chars().count() + faults(point).map(|(words, _)| words.len()).sum::<usize>();
            let [x, y] = places.beside(*mark, letters, 12.0);
            put(text, format!("<text x=\"{x}\" y=\"{y}\">{}{}</text>", escaped(name), fault_spans(point)));
        }
    }

    fn key(&self, text: &mut String, series: &Series, y: f64) {
        let style = Style::of(series.style);
        put(
            text,
            format!(
                "<path d=\"M12 {}h34\" stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"/>",
                y - 4.0,
                style.colour,
                if style.dash.is_empty() { "none" } else { style.dash }
            ),
        );
        if series.form == Form::Line {
            put(
                text,
                format!(
                    "<path d=\"{}\" transform=\"translate(29,{})\" fill=\"{}\"/>",
                    style.mark,
                    y - 4.0,
                    style.colour
                ),
            );
        }
        let n: u64 = match series.form {
            Form::Steps => series.points.last().map_or(0, |point| point.n),
            _ => series.points.iter().map(|point| point.n).sum(),
        };
        put(text, format!("<text x=\"56\" y=\"{y}\">{} (n = {n})</text>", escaped(&series.name)));
    }
}

/// What is wrong with a point, in words, with their colours: red and amber.
fn faults(point: &Point) -> impl Iterator<Item = (String, &'static str)> {
    let both = [(point.missed, "#9c201c", "missed"), (point.false_alarms, "#7d4b00", "false alarms")];
    both.into_iter().filter(|(count, ..)| *count > 0).map(|(count, colour, what)| (format!(" {count} {what}"), colour))
}

fn fault_spans(point: &Point) -> String {
    faults(point).map(|(words, colour)| format!("<tspan fill=\"{colour}\">{words}</tspan>")).collect()
}

fn put(text: &mut String, line: String) {
    text.push_str(&line);
    text.push('\n');
}

fn round(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}

/// In lines of a page's width.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < LETTERS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Axis;

    fn example() -> Chart {
        let point = |x, y, name: &str| Point { name: Some(name.to_owned()), ..Point::at(x, y, 40) };
        let missed = Point { missed: 3, filled: false, ..point(1e-2, 4e4, "B & C") };
        let unseen = Point { x: None, x_hi: Some(3e-3), ..point(0.0, 2e4, "<A>") };
        let series = |name: &str, style, form, points| Series { name: name.to_owned(), style, form, points };
        Chart {
            kind: "board".into(),
            title: "Speed & accuracy".into(),
            finding: "A sentence.".into(),
            x: Axis { lane: Some("none seen".into()), ..Axis::new("wrong answers", "share", Scale::Log) },
            y: Axis::new("questions per second", "1/s", Scale::Log),
            series: vec![
                series("one", Some(0), Form::Line, vec![unseen.clone().within(1e4, 3e4)]),
                series("two", Some(9), Form::Line, vec![missed.clone()]),
                series("", None, Form::Rule, vec![unseen, missed]),
            ],
            notes: vec!["A note.".into()],
        }
    }

    #[test]
    fn a_file_says_everything_and_escapes_names() {
        let svg = chart(&example());
        for part in [
            "Speed &amp; accuracy",
            "&lt;A&gt;",
            "B &amp; C",
            "3 missed",
            "none seen",
            "n = 40",
            "A note.",
            "A sentence.",
            "wrong answers",
        ] {
            assert!(svg.contains(part), "{part} in {svg}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(svg.matches("<path").count(), svg.matches("/>").count() - svg.matches("<rect").count());
    }

    #[test]
    fn rows_carry_their_names_beside_the_axis() {
        let mut rows = example();
        rows.y.scale = Scale::Rows;
        for (i, series) in rows.series.iter_mut().enumerate() {
            series.points.iter_mut().for_each(|p| (p.y, p.y_lo, p.y_hi) = (i as f64, None, None));
        }
        let svg = page(&[rows.clone(), rows]);
        assert_eq!(svg.matches(">two</text>").count(), 2);
        assert!(svg.contains("n = 40"));
    }
}
