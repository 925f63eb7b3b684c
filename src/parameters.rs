//! Parameters of a mesh (§4, end): options with the defaults of a dimension filled in and their
//! ranges checked, by [`crate::options::TABLE`]. A result keeps them.

use crate::error::{Choice, Error, Message, Name, Result, say};
use crate::options::{
    Algorithm, Bounds, Criterion, Crossings, Extent, GivesWay, Interior, Kind, Labels, NetOrdering,
    Options, Output, Row, Value, each_option, pick,
};

mod auto;

pub(crate) use auto::output_for;

/// Number of inputs of a partition. The more, the less is deferred at interfaces; the fewer, the
/// more threads have work.
const INPUTS_PER_PARTITION: usize = 1 << 18;

macro_rules! declare_parameters {
    ($($name:ident $field:ident: $type:ty {
        default: $default:expr, group: $group:ident, on_ranks: $on_ranks:expr,
        kind: $kind:expr, help: $help:literal,
    })*) => {
        /// Options with every default filled in and every range checked. `output`, `extent` and
        /// `interior` are never auto. In 2D with [`Criterion::RadiusEdge`] `min_angle` is the angle
        /// in degrees that no angle of a triangle within the bound B is below, asin(1 / (2 B)).
        #[derive(Clone, Debug, PartialEq)]
        pub struct Parameters {
            $(#[doc = $help] pub $field: $type,)*
            /// Number of inputs of a partition: a mesh of at least twice as many inputs is made in
            /// partitions of about this number or fewer.
            pub(crate) inputs_per_partition: Option<usize>,
            /// True if the inputs are a sample of more, which come when the mesh of these is made.
            pub(crate) is_sample: bool,
        }

        fn options_of(parameters: &Parameters) -> Options {
            Options { $($field: parameters.$field,)* }
        }

        fn parameters_of(full: Options) -> Parameters {
            let (inputs_per_partition, is_sample) = (Some(INPUTS_PER_PARTITION), false);
            Parameters { $($field: full.$field,)* inputs_per_partition, is_sample }
        }
    };
}
each_option!(declare_parameters);

impl Parameters {
    /// Returns options that say the same in full. Where `min_angle` is not 0, it says the same as
    /// `criterion` and `quality_bound`, which are set, too.
    pub fn options(&self) -> Options {
        options_of(self)
    }

    /// Fills the defaults for `dim` into `options`, for a run without sizes but `max_edge`;
    /// [`Extent::Auto`] and [`Interior::Auto`] are those of a mesh without segments.
    ///
    /// # Errors
    /// `InvalidArgument`, naming the option, its value and the range.
    pub fn resolve(dim: usize, options: &Options) -> Result<Self> {
        require_bound(dim, options)?;
        require_dihedral(dim, options)?;
        require_space(dim, options)?;
        let mut full = options.clone();
        for name in Name::OPTIONS {
            fill_number(dim, *name, options, &mut full)?;
        }
        require_no_cages(options)?;
        full.output = output_for(options, false);
        full.extent = match options.extent {
            Extent::Auto => Extent::All,
            named => named,
        };
        full.interior = with_interior(options, false).interior;
        if options.min_angle != 0.0 {
            full.criterion = Criterion::RadiusEdge;
            full.quality_bound = 0.5 / options.min_angle.to_radians().sin();
        }
        full.min_angle = match (dim, full.criterion) {
            (2, Criterion::RadiusEdge) => (0.5 / full.quality_bound).asin().to_degrees(),
            _ => 0.0,
        };
        full.max_vertices = match options.max_vertices {
            0 => u64::from(u32::MAX - 1),
            given => given.min(u64::from(u32::MAX - 1)),
        };
        Ok(parameters_of(full))
    }
}

/// Fills in the default of a number, and refuses one that is out of its range.
fn fill_number(dim: usize, name: Name, options: &Options, full: &mut Options) -> Result<()> {
    let Some(row) = name.option().and_then(Row::named) else { return Ok(()) };
    let (Kind::Number { ranges, .. }, Value::Number(given)) = (row.kind, row.get(options)) else {
        return Ok(());
    };
    // One range for all criteria, or one for each.
    let range = ranges.get(options.criterion as usize).unwrap_or(&ranges[0]);
    let default = default_of(dim, name, options, range);
    if given == 0.0 {
        row.set(full, Value::Number(default));
        return Ok(());
    }
    let (lowest, highest) = (range.lowest_in(dim), range.highest);
    if (lowest..=highest).contains(&given) {
        return Ok(());
    }
    refuse(match highest == f64::INFINITY {
        true => say!(name, " is {given}; it must be 0 (none) or above"),
        false => {
            say!(name, " is {given}; it must be 0 (default {default}) or in [{lowest}, {highest}]")
        }
    })
}

/// Returns the default of a number, which other options may change.
fn default_of(dim: usize, name: Name, options: &Options, range: &Bounds) -> f64 {
    match name {
        Name::YieldRadius if options.algorithm == Algorithm::Svr => pick(dim, [0.6, 0.9, 0.9, 0.9]),
        // So the hull and its cells are far enough from the cells that are refined.
        Name::RootScale if options.distance_ratio > 0.0 => range.default_in(dim).max(12.0),
        _ => range.default_in(dim),
    }
}

/// Features that a mesh conforms to, as messages name them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Features {
    Segments,
    Facets,
}

impl Features {
    fn name(self) -> &'static str {
        match self {
            Self::Segments => "segments",
            Self::Facets => "facets",
        }
    }
}

/// Returns the options of a mesh that conforms to segments or facets. There the bound is on angles:
/// the cell of a vertex on a boundary reaches beyond that.
///
/// # Errors
/// `InvalidArgument`, naming the option, its value and the rule.
pub fn conforming(options: &Options, features: Features) -> Result<Options> {
    let features = features.name();
    let Options { algorithm, criterion, quality_bound, distance_ratio, extent, .. } = *options;
    let has_frame = matches!(extent, Extent::Hull | Extent::Box);
    let extent = Choice::Extent(extent);
    if algorithm != Algorithm::Netmesh {
        return refuse(say!(
            Choice::Algorithm(algorithm),
            " goes neither with {features} nor with a hull or box; these take ",
            Choice::Algorithm(Algorithm::Netmesh)
        ));
    }
    if criterion == Criterion::VoronoiAspect && quality_bound != 0.0 {
        let other = Choice::Criterion(Criterion::RadiusEdge);
        let name = Name::QualityBound;
        return refuse(match has_frame {
            true => say!(
                name,
                " is {quality_bound}; with ",
                extent,
                " it must be 0, or go with ",
                other
            ),
            false => {
                say!(name, " is {quality_bound}; with {features} it must be 0, or go with ", other)
            }
        });
    }
    if distance_ratio != 0.0 {
        let (name, must) = (Name::DistanceRatio, "it must be 0 with");
        return refuse(match has_frame {
            true => say!(name, " is {distance_ratio}; {must} ", extent),
            false => say!(name, " is {distance_ratio}; {must} {features}"),
        });
    }
    Ok(Options { criterion: Criterion::RadiusEdge, ..options.clone() })
}

/// Returns the parameters of a mesh with facets or segments in space, or the sides of a hull or
/// box. An infinite bound asks for a mesh that conforms to them, and for no quality.
///
/// # Errors
/// `InvalidArgument`, naming the option, its value and the rule.
pub fn in_space(options: &Options, features: Features) -> Result<Parameters> {
    let options = conforming(options, features)?;
    let quality_bound = options.quality_bound;
    if quality_bound != f64::INFINITY {
        return Parameters::resolve(3, &options);
    }
    let resolved = Parameters::resolve(3, &Options { quality_bound: 0.0, ..options })?;
    Ok(Parameters { quality_bound: f64::INFINITY, ..resolved })
}

/// Resolves which regions are inside: those by parity where polygons of a file may be cut out, all
/// that is not outside otherwise.
pub fn with_interior(options: &Options, has_polygons: bool) -> Options {
    let reaches_on = matches!(options.extent, Extent::All | Extent::Hull | Extent::Box);
    let interior = match options.interior {
        Interior::Auto if has_polygons && !reaches_on => Interior::Parity,
        Interior::Auto => Interior::Seeds,
        given => given,
    };
    Options { interior, ..options.clone() }
}

fn refuse<T>(message: Message) -> Result<T> {
    Err(Error::invalid(message))
}

/// Returns the least aspect that may be asked for.
pub(crate) fn least_aspect(dim: usize) -> f64 {
    match Row::named("quality_bound").map(|row| row.kind) {
        Some(Kind::Number { ranges, .. }) => {
            ranges[Criterion::VoronoiAspect as usize].lowest_in(dim)
        }
        _ => 0.0,
    }
}

/// Refuses a smallest angle that is no bound on radius-edge ratios, or not the only bound.
fn require_bound(dim: usize, options: &Options) -> Result<()> {
    let Options { min_angle, quality_bound, .. } = *options;
    if min_angle != 0.0 && dim != 2 {
        return refuse(say!(
            Name::MinAngle,
            " is {min_angle}; it must be 0 in {dim}D, since only in 2D does a radius-edge ratio \
             bound the angles"
        ));
    }
    if min_angle != 0.0 && quality_bound != 0.0 {
        return refuse(say!(
            Name::MinAngle,
            " is {min_angle} and ",
            Name::QualityBound,
            " is {quality_bound}; one of them must be 0, since each is a bound on the angles"
        ));
    }
    Ok(())
}

/// Refuses a least dihedral angle where no tetrahedra can be mended.
fn require_dihedral(dim: usize, options: &Options) -> Result<()> {
    let given = options.min_dihedral;
    if dim != 3 && given != 0.0 {
        return refuse(say!(
            Name::MinDihedral,
            " is {given}; it must be 0 in {dim}D: only tetrahedra are mended"
        ));
    }
    // Cells that are refined by distance would reach farther when vertices move.
    if options.distance_ratio > 0.0 && given != 0.0 {
        return refuse(say!(
            Name::MinDihedral,
            " is {given}; it must be 0 with ",
            Name::DistanceRatio
        ));
    }
    Ok(())
}

/// Refuses what is asked of facets where there are none.
fn require_space(dim: usize, options: &Options) -> Result<()> {
    let asked = [
        (Name::Coplanar, options.coplanar),
        (Name::SizeFromCurvature, options.size_from_curvature),
    ];
    match asked.into_iter().find(|&(_, given)| dim != 3 && given != 0.0) {
        Some((name, given)) => {
            refuse(say!(name, " is {given}; it must be 0 in {dim}D: facets are for 3D"))
        }
        None => Ok(()),
    }
}

/// Refuses what cages would break in a mesh that has them, or that an algorithm does not keep.
fn require_no_cages(options: &Options) -> Result<()> {
    let Some(other) = cages_or_other(options) else { return Ok(()) };
    let asked = [
        (Name::DistanceRatio, options.distance_ratio),
        (Name::MaxEdge, options.max_edge),
        (Name::SizeFromCurvature, options.size_from_curvature),
    ];
    match asked.into_iter().find(|(_, given)| *given > 0.0) {
        Some((name, given)) => refuse(say!(name, " is {given}; it does not go with ", other)),
        None => Ok(()),
    }
}

/// Fails if meshes by these `options` may have no sizes. `given` tells them.
pub(crate) fn check_sized(options: &Options, given: Name) -> Result<()> {
    match cages_or_other(options) {
        Some(other) => refuse(say!(given, " is given; it does not go with ", other)),
        None => Ok(()),
    }
}

/// Fails if meshes by these `options` may have no regions with sizes.
pub(crate) fn check_region_sizes(options: &Options) -> Result<()> {
    match cages_or_other(options) {
        Some(other) => refuse(say!(other, " does not go with the largest edges of regions")),
        None => Ok(()),
    }
}

/// Returns what sizes and distance ratios do not go with, if the caller has chosen it: cages, which
/// break them, or an algorithm that keeps none.
fn cages_or_other(options: &Options) -> Option<Choice> {
    match (options.algorithm, options.output) {
        (Algorithm::Netmesh, Output::Hierarchical) => Some(Choice::Output(Output::Hierarchical)),
        (Algorithm::Netmesh, _) => None,
        (other, _) => Some(Choice::Algorithm(other)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(dim: usize, options: Options) -> Parameters {
        Parameters::resolve(dim, &options).expect("the options are good")
    }

    fn refusal(dim: usize, options: Options) -> String {
        Parameters::resolve(dim, &options).unwrap_err().message().to_owned()
    }

    #[test]
    fn what_is_inside_of_polygons_goes_by_parity() {
        let resolved = |interior, extent, has_polygons| {
            let options = Options { interior, extent, ..Options::default() };
            with_interior(&options, has_polygons).interior
        };
        assert_eq!(resolved(Interior::Auto, Extent::Boundary, true), Interior::Parity);
        assert_eq!(resolved(Interior::Auto, Extent::Auto, true), Interior::Parity);
        assert_eq!(resolved(Interior::Auto, Extent::Boundary, false), Interior::Seeds);
        assert_eq!(resolved(Interior::Auto, Extent::Auto, false), Interior::Seeds);
        assert_eq!(resolved(Interior::Auto, Extent::Hull, true), Interior::Seeds);
        for given in [Interior::Seeds, Interior::Parity, Interior::Winding] {
            assert_eq!(resolved(given, Extent::Boundary, true), given);
        }
    }

    #[test]
    fn a_smallest_angle_is_a_radius_edge_bound() {
        let parameters = resolved(2, Options { min_angle: 30.0, ..Options::default() });
        assert_eq!(parameters.criterion, Criterion::RadiusEdge);
        assert!((parameters.quality_bound - 1.0).abs() < 1e-15);
        assert!((parameters.min_angle - 30.0).abs() < 1e-13);
        for ends in [0.6, 33.7] {
            let bound =
                resolved(2, Options { min_angle: ends, ..Options::default() }).quality_bound;
            assert!((0.9..=50.0).contains(&bound), "{ends} degrees: {bound}");
        }
    }

    #[test]
    fn a_radius_edge_bound_in_the_plane_promises_an_angle() {
        let angle = |dim, criterion| {
            let options = Options { criterion, quality_bound: 4.0, ..Options::default() };
            resolved(dim, options).min_angle
        };
        let sine = angle(2, Criterion::RadiusEdge).to_radians().sin();
        assert!((sine - 0.125).abs() < 1e-15, "{sine}");
        assert_eq!(angle(2, Criterion::VoronoiAspect), 0.0);
        assert_eq!(angle(3, Criterion::RadiusEdge), 0.0);
    }

    #[test]
    fn facets_may_be_bent_in_space_alone() {
        let angle = |coplanar| Options { coplanar, ..Options::default() };
        assert_eq!([0.0, 1e-9, 10.0].map(|x| resolved(3, angle(x)).coplanar), [0.0, 1e-9, 10.0]);
        let range = "options.coplanar is 10.5; it must be 0 (default 0) or in [0, 10]";
        assert_eq!(refusal(3, angle(10.5)), range);
        assert!(refusal(3, angle(-1.0)).starts_with("options.coplanar is -1; it must be 0"));
        for dim in [2, 4] {
            let rule = format!("options.coplanar is 1; it must be 0 in {dim}D: facets are for 3D");
            assert_eq!(refusal(dim, angle(1.0)), rule);
        }
    }

    #[test]
    fn a_smallest_angle_that_cannot_be_is_refused() {
        let angle = |min_angle| Options { min_angle, ..Options::default() };
        let range = "it must be 0 (default 0) or in [0.6, 33.7]";
        assert_eq!(refusal(2, angle(33.71)), format!("options.min_angle is 33.71; {range}"));
        assert_eq!(refusal(2, angle(0.5)), format!("options.min_angle is 0.5; {range}"));
        assert_eq!(refusal(2, angle(f64::NAN)), format!("options.min_angle is NaN; {range}"));
        assert!(refusal(3, angle(20.0)).starts_with("options.min_angle is 20; it must be 0 in 3D"));
        let both = refusal(2, Options { quality_bound: 1.5, ..angle(20.0) });
        let names = "options.min_angle is 20 and options.quality_bound is 1.5; one of them";
        assert!(both.starts_with(names), "{both}");
    }
}
