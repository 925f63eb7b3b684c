//! An axis: from values to places, and where its ticks are.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    Linear,
    Log,
}

#[derive(Clone, Debug)]
pub struct Axis {
    pub label: String,
    pub scale: Scale,
    /// What stands at 1, 2, ... instead of numbers; curves have no lines then.
    pub names: Vec<&'static str>,
}

impl Axis {
    pub fn log(label: &str) -> Self {
        Self { label: label.to_string(), scale: Scale::Log, names: Vec::new() }
    }

    pub fn linear(label: &str) -> Self {
        Self { label: label.to_string(), scale: Scale::Linear, names: Vec::new() }
    }

    pub fn named(names: &[&'static str]) -> Self {
        Self { label: String::new(), scale: Scale::Linear, names: names.to_vec() }
    }

    /// Covers the values; the names, where the axis has these.
    pub fn range(&self, values: impl Iterator<Item = f64>) -> Range {
        match self.names.len() {
            0 => Range::covering(self.scale, values),
            count => Range { scale: Scale::Linear, low: 0.4, high: count as f64 + 0.6 },
        }
    }

    pub fn ticks(&self, range: &Range) -> Vec<Tick> {
        if self.names.is_empty() {
            return range.ticks();
        }
        let tick = |(i, name): (usize, &&str)| Tick {
            value: (i + 1) as f64,
            label: Some(name.to_string()),
        };
        self.names.iter().enumerate().map(tick).collect()
    }
}

/// An axis with the range of its data.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    scale: Scale,
    low: f64,
    high: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub value: f64,
    /// None for a grid line without a number.
    pub label: Option<String>,
}

impl Range {
    /// Covers the values with some room; a linear axis starts at 0. A log axis needs positive
    /// values. No values at all answer 1 to 10.
    fn covering(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            assert!(scale == Scale::Linear || value > 0.0, "{value} on a log axis");
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            (low, high) = (1.0, 10.0);
        }
        match scale {
            Scale::Linear => Self { scale, low: low.min(0.0), high: 1.05 * high.max(low + 1e-300) },
            // At least a factor of three, so that noise does not look like a trend.
            Scale::Log => {
                let room = (3.0 / (high / low)).max(1.0).sqrt() * 1.12;
                Self { scale, low: low / room, high: high * room }
            }
        }
    }

    /// 0 at the lower end, 1 at the upper one.
    pub fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }

    fn ticks(&self) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.linear_ticks(),
            Scale::Log => self.log_ticks(),
        }
    }

    fn linear_ticks(&self) -> Vec<Tick> {
        let raw = (self.high - self.low) / 5.0;
        let decade = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|s| s * decade).into_iter().find(|&s| s >= raw);
        let step = step.unwrap_or(10.0 * decade);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last)
            .map(|i| i as f64 * step)
            .map(|value| Tick { value, label: Some(label(value)) })
            .collect()
    }

    /// A line at every whole multiple of a decade; numbers at the decades, and where these are few
    /// at 2 and 5 as well.
    fn log_ticks(&self) -> Vec<Tick> {
        let decades = (self.high / self.low).log10();
        let first = self.low.log10().floor() as i32;
        let last = self.high.log10().ceil() as i32;
        let mut ticks = Vec::new();
        for decade in first..=last {
            for digit in 1..=9 {
                let value = f64::from(digit) * 10f64.powi(decade);
                if value < self.low || value > self.high {
                    continue;
                }
                let numbered = match digit {
                    1 => true,
                    2 | 5 => decades < 3.0,
                    3 | 4 | 7 => decades < 0.9,
                    _ => false,
                };
                ticks.push(Tick { value, label: numbered.then(|| label(value)) });
            }
        }
        ticks
    }
}

/// 1 000 as 1k, a million as 1M.
fn label(value: f64) -> String {
    let trimmed = |x: f64| {
        let text = format!("{x:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    };
    match value.abs() {
        0.0 => "0".to_string(),
        x if x >= 1e9 => format!("{value:.0e}"),
        x if x >= 1e6 => trimmed(value / 1e6) + "M",
        x if x >= 1e3 => trimmed(value / 1e3) + "k",
        x if x >= 1e-3 => trimmed(value),
        _ => format!("{value:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: Range) -> Vec<String> {
        range.ticks().into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn log_axes_have_a_number_at_each_decade() {
        let range = Range::covering(Scale::Log, [900.0, 1e6, 3.0].into_iter());
        assert_eq!(labels(range), ["10", "100", "1k", "10k", "100k", "1M"]);
        assert!(range.ticks().iter().any(|tick| tick.value == 3e3 && tick.label.is_none()));
    }

    #[test]
    fn short_log_axes_have_numbers_between() {
        let range = Range::covering(Scale::Log, [2.0, 60.0].into_iter());
        assert_eq!(labels(range), ["2", "5", "10", "20", "50"]);
    }

    #[test]
    fn equal_factors_are_equal_lengths() {
        let range = Range::covering(Scale::Log, [1.0, 1e4].into_iter());
        let steps: Vec<f64> =
            (0..4).map(|i| range.place(10f64.powi(i + 1)) - range.place(10f64.powi(i))).collect();
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-12), "{steps:?}");
        assert!(range.place(1.0) > 0.0 && range.place(1e4) < 1.0);
    }

    #[test]
    fn linear_axes_start_at_nothing() {
        let range = Range::covering(Scale::Linear, [20.0, 95.0].into_iter());
        assert_eq!(labels(range), ["0", "20", "40", "60", "80"]);
        assert_eq!(range.place(0.0), 0.0);
    }

    #[test]
    fn names_stand_at_whole_numbers() {
        let axis = Axis::named(&["a", "b", "c"]);
        let range = axis.range([7.0].into_iter());
        let ticks: Vec<(f64, String)> =
            axis.ticks(&range).into_iter().map(|t| (t.value, t.label.unwrap())).collect();
        assert_eq!(ticks, [(1.0, "a".to_string()), (2.0, "b".to_string()), (3.0, "c".to_string())]);
        assert!((range.place(2.0) - 0.5).abs() < 1e-12 && range.place(3.0) < 1.0);
    }

    #[test]
    fn one_value_has_a_range() {
        let range = Range::covering(Scale::Log, [5.0].into_iter());
        assert!((range.place(5.0) - 0.5).abs() < 1e-12 && !range.ticks().is_empty());
        assert!(!Range::covering(Scale::Log, std::iter::empty()).ticks().is_empty());
    }

    #[test]
    #[should_panic(expected = "on a log axis")]
    fn log_axes_refuse_nothing() {
        Range::covering(Scale::Log, [0.0].into_iter());
    }
}
