//! Verdicts of the curves on the targets.

use super::settings::{Kind, Setting};
use super::{Averaged, values};
use crate::table::number;
use crate::verdict::{Verdict, fit_line, median};

/// log2 of the gap from which on cages are worth their vertices.
const PLATEAU: f64 = 12.0;
/// Between these gaps cages are not yet worth it.
const HUMP: std::ops::RangeInclusive<f64> = 2.0..=10.0;
/// log2 of the pacing up to which a chain has no gaps to save. Beyond, it is all gaps.
const NO_GAPS: f64 = 1.5;

pub fn verdicts(
    kind: Kind,
    dim: usize,
    settings: &[Setting],
    averaged: &[Averaged],
) -> Vec<Verdict> {
    let of = |name: &str| averaged.iter().find(|curve| curve.name == name);
    let mut verdicts = Vec::new();
    if let Some(ours) = of("NETMESH") {
        verdicts.extend(match kind {
            Kind::Chain => chain_verdicts(dim, settings, ours),
            _ => plateau_verdicts(kind, dim, settings, ours),
        });
    }
    if let Some(svr) = of("SVR") {
        verdicts.extend(svr_verdicts(kind, dim, settings, svr));
    }
    verdicts
}

fn plateau_verdicts(
    kind: Kind,
    dim: usize,
    settings: &[Setting],
    curve: &Averaged,
) -> Vec<Verdict> {
    let place = format!("{}, {dim}D", kind.name());
    let figures = |touches: bool| -> Vec<(f64, f64)> {
        values(settings, curve, touches)
            .filter_map(|(setting, y)| setting.log_gap.map(|gap| (gap, y)))
            .collect()
    };
    let plateau = |figures: &[(f64, f64)]| -> Vec<f64> {
        figures.iter().filter(|p| p.0 >= PLATEAU).map(|p| p.1).collect()
    };
    let growth = |touches: bool, words: &str| {
        let plateau = plateau(&figures(touches));
        let ratio = match (plateau.first(), plateau.last()) {
            (Some(first), Some(last)) => last / first,
            _ => f64::NAN,
        };
        let claim = format!("{place}: {words} at the largest spread over the plateau's start");
        Verdict::at_most(&claim, ratio, 1.15)
    };
    let sizes = figures(false);
    let highest =
        sizes.iter().filter(|p| HUMP.contains(&p.0)).map(|p| p.1).fold(f64::NAN, f64::max);
    let claim = format!("{place}: largest m/n between gap 2^2 and 2^10 over the plateau");
    let hump = Verdict::at_most(&claim, highest / median(&plateau(&sizes)), 1.5);
    vec![growth(false, "m/n"), hump, growth(true, "touches/n")]
}

fn chain_verdicts(dim: usize, settings: &[Setting], curve: &Averaged) -> Vec<Verdict> {
    let figures =
        |touches: bool| values(settings, curve, touches).filter(|(s, _)| s.exponent <= NO_GAPS);
    let sizes: Vec<(f64, f64)> = figures(false).map(|(s, y)| (s.exponent, y)).collect();
    let line = fit_line(&sizes);
    let claim = format!(
        "chain, {dim}D: m/n is {} + {} log2 pacing up to 2^{NO_GAPS} (R^2 of that line)",
        number(line.intercept),
        number(line.slope)
    );
    let touches: Vec<f64> =
        figures(true).filter(|(s, _)| s.exponent >= 0.5).map(|(_, y)| y).collect();
    let growth = touches
        .first()
        .map_or(f64::NAN, |first| touches.iter().copied().fold(f64::MIN, f64::max) / first);
    let claim_touches =
        format!("chain, {dim}D: most touches/n up to pacing 2^{NO_GAPS} over those at 2^0.5");
    vec![
        Verdict::at_least(&claim, line.determination, 0.98),
        Verdict::at_most(&claim_touches, growth, 1.5),
    ]
}

/// Pairs count from where they are closer than their neighbours.
fn svr_verdicts(kind: Kind, dim: usize, settings: &[Setting], curve: &Averaged) -> Vec<Verdict> {
    let is_in_law = |setting: &Setting| kind != Kind::Pairs || setting.log_gap >= Some(4.0);
    let verdict = |(touches, words): (bool, &str)| {
        let points: Vec<(f64, f64)> = values(settings, curve, touches)
            .filter(|(setting, _)| is_in_law(setting))
            .map(|(setting, y)| (setting.log_spread, y))
            .collect();
        let claim =
            format!("{}, {dim}D: SVR's {words} are linear in log spread (R^2)", kind.name());
        Verdict::at_least(&claim, fit_line(&points).determination, 0.98)
    };
    [(false, "m/n"), (true, "touches/n")].map(verdict).to_vec()
}

#[cfg(test)]
mod tests {
    use super::super::{Averaged, Cell, Method};
    use super::*;
    use crate::verdict::Answer;

    /// Clusters whose m/n is `size` of the gap, with constant touches.
    fn answers(size: impl Fn(f64) -> f64) -> Vec<Answer> {
        let gaps = [2.0, 4.0, 8.0, 12.0, 24.0, 48.0];
        let setting =
            |gap: f64| Setting { exponent: gap, log_gap: Some(gap), log_spread: 19.0 * gap };
        let cell = |gap: f64| Cell::Size { per_input: size(gap), touches: Some(40.0) };
        let ours = Averaged {
            name: "NETMESH",
            method: Method::Netmesh { seed: 1 },
            runs: 1,
            cells: gaps.map(cell).to_vec(),
        };
        let verdicts = verdicts(Kind::Clusters, 2, &gaps.map(setting), &[ours]);
        verdicts.into_iter().map(|verdict| verdict.answer).collect()
    }

    #[test]
    fn a_level_curve_passes_and_a_rising_one_fails() {
        assert_eq!(answers(|_| 4.0), [Answer::Met; 3]);
        assert_eq!(answers(|gap| 4.0 + 0.1 * gap), [Answer::Missed, Answer::Met, Answer::Met]);
    }

    #[test]
    fn a_hump_fails() {
        let humped = |gap: f64| if gap == 4.0 { 6.1 } else { 4.0 };
        assert_eq!(answers(humped), [Answer::Met, Answer::Missed, Answer::Met]);
    }
}
