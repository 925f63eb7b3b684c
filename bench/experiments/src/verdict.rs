//! Verdict of the data on a target.

use crate::table::number;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    Met,
    Missed,
    NotMeasured,
}

#[derive(Clone, Debug)]
pub struct Verdict {
    pub claim: String,
    pub target: String,
    pub measured: String,
    pub answer: Answer,
}

impl Verdict {
    fn new(claim: &str, target: String, measured: String, holds: bool) -> Self {
        let answer = if holds { Answer::Met } else { Answer::Missed };
        Self { claim: claim.to_string(), target, measured, answer }
    }

    pub fn not_measured(claim: &str, target: &str, why: &str) -> Self {
        Self {
            claim: claim.to_string(),
            target: target.to_string(),
            measured: why.to_string(),
            answer: Answer::NotMeasured,
        }
    }

    /// `value` is at most `limit`; NaN stands for what could not be measured.
    pub fn at_most(claim: &str, value: f64, limit: f64) -> Self {
        let target = format!("at most {limit}");
        if value.is_nan() {
            return Self::not_measured(claim, &target, "-");
        }
        Self::new(claim, target, number(value), value <= limit)
    }

    pub fn at_least(claim: &str, value: f64, limit: f64) -> Self {
        let target = format!("at least {limit}");
        if value.is_nan() {
            return Self::not_measured(claim, &target, "-");
        }
        Self::new(claim, target, number(value), value >= limit)
    }

    /// The values differ by at most the fraction `tolerance`, the largest from the smallest.
    pub fn flat(claim: &str, values: &[f64], tolerance: f64) -> Self {
        let target = format!("flat within {:.0} %", 100.0 * tolerance);
        if values.len() < 2 {
            return Self::not_measured(claim, &target, "too few sizes");
        }
        let (low, high) = extremes(values);
        // Differences of times may be anything: no constant is near such values.
        if !(low > 0.0 && high.is_finite()) {
            let measured = format!("{} to {}", number(low), number(high));
            return Self::new(claim, target, measured, false);
        }
        let measured =
            format!("{} to {} ({:.0} %)", number(low), number(high), 100.0 * variation(values));
        Self::new(claim, target, measured, variation(values) <= tolerance)
    }

    pub fn holds(claim: &str, target: &str, measured: String, holds: bool) -> Self {
        Self::new(claim, target.to_string(), measured, holds)
    }
}

/// NaN if any value is.
fn extremes(values: &[f64]) -> (f64, f64) {
    if values.iter().any(|v| v.is_nan()) {
        return (f64::NAN, f64::NAN);
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    (low, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

/// Returns the fraction by which the largest value exceeds the smallest.
pub fn variation(values: &[f64]) -> f64 {
    let (low, high) = extremes(values);
    high / low - 1.0
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// y = intercept + slope x by least squares.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub slope: f64,
    pub intercept: f64,
    /// Coefficient of determination: 1 where the points are on the line.
    pub determination: f64,
}

/// NaN in every field for fewer than three points.
pub fn fit_line(points: &[(f64, f64)]) -> Line {
    if points.len() < 3 {
        return Line { slope: f64::NAN, intercept: f64::NAN, determination: f64::NAN };
    }
    let n = points.len() as f64;
    let x_mean = points.iter().map(|p| p.0).sum::<f64>() / n;
    let y_mean = points.iter().map(|p| p.1).sum::<f64>() / n;
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        points.iter().map(|p| f(p.0 - x_mean, p.1 - y_mean)).sum()
    };
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    let slope = xy / xx;
    Line { slope, intercept: y_mean - slope * x_mean, determination: xy * xy / (xx * yy) }
}

/// The exponent of the power law through the points: the slope between logarithms.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|p| (p.0.ln(), p.1.ln())).collect();
    fit_line(&logs).slope
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rising_curve_is_not_flat() {
        let rising: Vec<f64> = (0..5).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
        assert_eq!(Verdict::flat("", &rising, 0.25).answer, Answer::Missed);
        let falling: Vec<f64> = rising.iter().rev().copied().collect();
        assert_eq!(Verdict::flat("", &falling, 0.25).answer, Answer::Missed);
        assert_eq!(Verdict::flat("", &rising[..3], 0.25).answer, Answer::Met);
        assert_eq!(Verdict::flat("", &rising[..1], 0.25).answer, Answer::NotMeasured);
        assert_eq!(Verdict::flat("", &[-5.0, 4.0], 0.25).answer, Answer::Missed);
        assert_eq!(Verdict::flat("", &[-5.0, -5.0], 0.25).answer, Answer::Missed);
        assert_eq!(Verdict::flat("", &[1.0, f64::NAN], 0.25).answer, Answer::Missed);
    }

    #[test]
    fn bounds_hold_at_their_ends() {
        assert_eq!(Verdict::at_most("", 1.15, 1.15).answer, Answer::Met);
        assert_eq!(Verdict::at_most("", 1.16, 1.15).answer, Answer::Missed);
        assert_eq!(Verdict::at_most("", f64::NAN, 1.15).answer, Answer::NotMeasured);
        assert_eq!(Verdict::at_least("", 0.97, 0.98).answer, Answer::Missed);
    }

    #[test]
    fn lines_and_powers_are_found() {
        let line = fit_line(&[(1.0, 5.0), (2.0, 7.0), (4.0, 11.0)]);
        assert!((line.slope - 2.0).abs() < 1e-12 && (line.intercept - 3.0).abs() < 1e-12);
        assert!((line.determination - 1.0).abs() < 1e-12);
        assert!(fit_line(&[(1.0, 1.0), (2.0, 9.0), (3.0, 1.0)]).determination < 0.1);
        assert!((exponent(&[(1.0, 3.0), (10.0, 300.0), (100.0, 3e4)]) - 2.0).abs() < 1e-12);
        assert!(fit_line(&[(1.0, 1.0), (2.0, 2.0)]).slope.is_nan());
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(mean(&[1.0, 2.0, 6.0]), 3.0);
    }
}
