//! The output that [`Output::Auto`] stands for.

use crate::options::{Extent, Options, Output};

/// Returns the output of a run with these options, which is never [`Output::Auto`]. `has_sizes`
/// tells that a function, values or regions ask for sizes, beside `max_edge`. An extent of
/// [`Extent::Auto`] must have become another one already; here it counts as [`Extent::All`].
///
/// Cages break what is asked for: between a cage and its surroundings there is a gap with simplices
/// of all sizes and angles, which reaches into a domain that is cut out.
pub(crate) fn output_for(options: &Options, has_sizes: bool) -> Output {
    let Options { min_angle, min_dihedral, distance_ratio, extent, .. } = *options;
    let Options { max_edge, size_from_curvature, .. } = *options;
    let numbers = [min_angle, min_dihedral, max_edge, size_from_curvature, distance_ratio];
    let is_cut = !matches!(extent, Extent::Auto | Extent::All);
    match options.output {
        Output::Auto if has_sizes || is_cut || numbers.iter().any(|&number| number != 0.0) => {
            Output::WellSpaced
        }
        Output::Auto => Output::Hierarchical,
        named => named,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_is_well_spaced_where_a_cage_would_break_what_is_asked_for() {
        let plain = Options::default();
        let asked = [
            Options { min_angle: 20.0, ..plain.clone() },
            Options { min_dihedral: 10.0, ..plain.clone() },
            Options { max_edge: 0.1, ..plain.clone() },
            Options { size_from_curvature: 0.1, ..plain.clone() },
            Options { distance_ratio: 0.5, ..plain.clone() },
            Options { extent: Extent::Hull, ..plain.clone() },
            Options { extent: Extent::Box, ..plain.clone() },
            Options { extent: Extent::Boundary, ..plain.clone() },
        ];
        for options in asked {
            assert_eq!(output_for(&options, false), Output::WellSpaced, "{options:?}");
            let named = Options { output: Output::Hierarchical, ..options };
            assert_eq!(output_for(&named, true), Output::Hierarchical);
        }
        assert_eq!(output_for(&plain, true), Output::WellSpaced);
        let others = [
            Options { extent: Extent::All, ..plain.clone() },
            Options { quality_bound: 2.5, epsilon: 0.3, seed: 7, ..plain.clone() },
            plain,
        ];
        for options in others {
            assert_eq!(output_for(&options, false), Output::Hierarchical, "{options:?}");
            let named = Options { output: Output::WellSpaced, ..options };
            assert_eq!(output_for(&named, false), Output::WellSpaced);
        }
    }
}
