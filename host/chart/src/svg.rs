//! A chart as a file that stands alone: title, axes with units, key with n, intervals, notes.

use crate::paper::{Paper, QUIET, escaped, fault_spans, faults, wrapped};
use crate::place::Places;
use crate::{Chart, Form, Placing, Point, Scale, Series, Style};

const WIDTH: f64 = 820.0;
const ROW: f64 = 19.0;
/// Length of the arrow of a point that is at least so far to the right.
const ARROW: f64 = 20.0;

/// One chart.
pub fn chart(chart: &Chart) -> String {
    page(std::slice::from_ref(chart))
}

/// Several charts, one below the other.
pub fn page(charts: &[Chart]) -> String {
    let (mut paper, mut y) = (Paper::default(), 0.0);
    for chart in charts {
        y += Drawing::new(chart, y).draw(&mut paper);
    }
    let told = |of: fn(&Chart) -> &str| charts.iter().map(|chart| escaped(of(chart))).collect::<Vec<_>>().join(" ");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {y}\" width=\"{WIDTH}\" height=\"{y}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#1c2025\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
        told(|chart| &chart.title),
        told(|chart| &chart.finding),
        paper.into_text()
    )
}

struct Drawing<'a> {
    chart: &'a Chart,
    /// A row for each series, named at the axis.
    rows: bool,
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
        let (left, right, height) = match rows {
            true => (210.0, WIDTH - 190.0, ROW * (chart.series.len() as f64 + 0.4)),
            false => (76.0, WIDTH - 24.0, 340.0),
        };
        let (x, y) = (Placing::new(&chart.x, chart.xs()), Placing::new(&chart.y, chart.ys()));
        Self { chart, rows, x, y, plot: [left, first, right, first + height], top, head }
    }

    /// Writes everything; the height.
    fn draw(&self, paper: &mut Paper) -> f64 {
        let title = escaped(&self.chart.title);
        paper.words([12.0, self.top + 24.0], "font-size=\"16\" font-weight=\"bold\"", title);
        for (i, line) in self.head.iter().enumerate() {
            paper.words([12.0, self.top + 44.0 + 16.0 * i as f64], "", escaped(line));
        }
        self.grid(paper);
        let mut y = self.plot[3] + 58.0;
        for (row, series) in self.chart.series.iter().enumerate() {
            self.series(paper, series);
            if self.rows {
                self.row(paper, series, row);
            }
        }
        if !self.rows {
            self.names(paper);
            for (name, series, n) in self.keys() {
                self.key(paper, series, &format!("{name} (n = {n})"), y);
                y += ROW;
            }
        }
        for line in self.chart.notes.iter().flat_map(|note| wrapped(note)) {
            paper.words([12.0, y], &format!("fill=\"{QUIET}\""), escaped(&line));
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

    fn grid(&self, paper: &mut Paper) {
        let [left, top, right, bottom] = self.plot;
        if let (Some(end), Some(name)) = (self.x.lane(), &self.chart.x.lane) {
            let width = (right - left) * end - 6.0;
            paper.rect([left, top, width, bottom - top], "#e8eef2");
            // The bound stands in brackets, below.
            for (i, line) in name.splitn(2, " (").enumerate() {
                let line = if i == 0 { line.to_owned() } else { format!("({line}") };
                paper.label([left + 0.5 * width, bottom + 16.0 + 13.0 * i as f64], "middle", &line);
            }
        }
        for (share, label) in self.x.ticks(8) {
            let x = round(left + (right - left) * share);
            paper.path(format!("M{x} {top}V{bottom}"), "stroke=\"#ddd\"");
            paper.label([x, bottom + 16.0], "middle", &label);
        }
        for (share, label) in self.y.ticks(7) {
            let y = round(bottom - (bottom - top) * share);
            paper.path(format!("M{left} {y}H{right}"), "stroke=\"#ddd\"");
            paper.label([left - 7.0, y + 4.0], "end", &label);
        }
        paper.label([0.5 * (left + right), bottom + 36.0], "middle", &self.chart.x.label);
        if !self.rows {
            paper.put(&format!("<g transform=\"translate(16,{}) rotate(-90)\">", 0.5 * (top + bottom)));
            paper.label([0.0, 0.0], "middle", &self.chart.y.label);
            paper.put("</g>");
        }
    }

    fn series(&self, paper: &mut Paper, series: &Series) {
        let Style { colour, dash, mark } = Style::of(series.style);
        if series.points.len() > 1 {
            let (width, dash) = if series.form == Form::Rule { (1.2, "") } else { (1.8, dash) };
            let line = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" {}", dashed(dash));
            paper.path(self.path(series), &line);
        }
        let thin = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.2\"");
        for point in series.points.iter().filter(|_| series.form == Form::Line) {
            let [x, y] = self.at(point);
            if let (Some(lo), Some(hi)) = (point.y_lo, point.y_hi) {
                paper.path(format!("M{x} {}V{}", self.up(lo), self.up(hi)), &thin);
            }
            if let (Some(_), Some(lo), Some(hi)) = (point.x, point.x_lo, point.x_hi) {
                paper.path(format!("M{} {y}H{}", self.across(Some(lo)), self.across(Some(hi))), &thin);
            }
            if point.at_least {
                paper.path(format!("M{x} {y}h{ARROW}m-5-4l5 4l-5 4"), &thin);
            }
            let fill = if point.filled { colour } else { "#fff" };
            let look =
                format!("transform=\"translate({x},{y})\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"");
            paper.path(mark, &look);
        }
    }

    /// Name and n at both ends of a row.
    fn row(&self, paper: &mut Paper, series: &Series, row: usize) {
        let y = self.up(row as f64) + 4.0;
        paper.words([self.plot[0] - 8.0, y], "text-anchor=\"end\"", escaped(&series.name));
        for point in &series.points {
            paper.words([self.plot[2] + 12.0, y], "", format!("n = {}{}", point.n, fault_spans(point)));
        }
    }

    /// The line; on a signed axis it breaks where the sign changes.
    fn path(&self, series: &Series) -> String {
        let sign = |point: &Point| point.x.map(f64::signum);
        let step = |(i, point): (usize, &Point)| {
            let [x, y] = self.at(point);
            let before = i.checked_sub(1).map(|before| &series.points[before]);
            let joined = before.is_some_and(|b| self.chart.x.scale != Scale::Signed || sign(b) == sign(point));
            match (joined, series.form) {
                (false, _) => format!("M{x} {y}"),
                (true, Form::Steps) => format!("H{x}V{y}"),
                (true, _) => format!("L{x} {y}"),
            }
        };
        series.points.iter().enumerate().map(step).collect()
    }

    fn names(&self, paper: &mut Paper) {
        let points = || self.chart.series.iter().filter(|s| s.form == Form::Line).flat_map(|s| &s.points);
        let mark = |point: &Point| {
            let [x, y] = self.at(point);
            [x, y, if point.at_least { ARROW } else { 6.0 }]
        };
        let marks: Vec<[f64; 3]> = points().map(mark).collect();
        let mut places = Places::new(self.plot, &marks);
        for (point, mark) in points().zip(&marks) {
            let Some(name) = &point.name else { continue };
            let letters = name.chars().count() + faults(point).map(|(words, _)| words.len()).sum::<usize>();
            paper.words(places.beside(*mark, letters, 12.0), "", escaped(name) + &fault_spans(point));
        }
    }

    /// What stands for what, each name once, with how many values are behind it.
    fn keys(&self) -> Vec<(String, &Series, u64)> {
        let mut keys: Vec<(String, &Series, u64)> = Vec::new();
        for series in self.chart.series.iter().filter(|series| series.form != Form::Rule) {
            let n = match series.form {
                Form::Steps => series.points.last().map_or(0, |point| point.n),
                _ => series.points.iter().map(|point| point.n).sum(),
            };
            match keys.iter_mut().find(|(name, ..)| *name == series.name) {
                Some((_, _, known)) => *known += n,
                None => keys.push((series.name.clone(), series, n)),
            }
        }
        keys
    }

    fn key(&self, paper: &mut Paper, series: &Series, words: &str, y: f64) {
        let Style { colour, dash, mark } = Style::of(series.style);
        let line = format!("stroke=\"{colour}\" stroke-width=\"1.8\" {}", dashed(dash));
        paper.path(format!("M12 {}h34", y - 4.0), &line);
        if series.form == Form::Line {
            paper.path(mark, &format!("transform=\"translate(29,{})\" fill=\"{colour}\"", y - 4.0));
        }
        paper.words([56.0, y], "", escaped(words));
    }
}

fn dashed(dash: &str) -> String {
    if dash.is_empty() { String::new() } else { format!("stroke-dasharray=\"{dash}\"") }
}

fn round(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
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
            preliminary: false,
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
