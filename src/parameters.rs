//! The meshing parameters (§4, end): defaults per dimension, and the ranges that are accepted.
//! Plain data that a result keeps; what the algorithm derives from them is its own affair.

use crate::error::{Choice, Error, ErrorKind, Message, Name, Result, say};
use crate::options::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Options, Output,
};

mod auto;

pub(crate) use auto::output_for;

/// The more, the less is deferred at interfaces; the fewer, the more threads have work.
const INPUTS_PER_PARTITION: usize = 1 << 18;

/// The range of `min_angle`, in degrees: within that of the radius-edge ratio.
const SMALLEST_ANGLE: f64 = 0.6;
const LARGEST_ANGLE: f64 = 33.7;
/// The largest dihedral angle that can be asked for, in degrees: beyond about 20 most meshes keep
/// some smaller ones.
const MAX_DIHEDRAL: f64 = 22.0;

/// Options with every default filled in and every range checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Never [`Output::Auto`].
    pub output: Output,
    pub algorithm: Algorithm,
    pub ordering: NetOrdering,
    pub criterion: Criterion,
    pub threads: u32,
    /// tau for [`Criterion::VoronoiAspect`], circumradius / shortest edge otherwise.
    pub quality_bound: f64,
    pub epsilon: f64,
    pub delta: f64,
    pub gamma: f64,
    pub yield_radius: f64,
    pub encroachment: f64,
    pub cage_scale: f64,
    pub root_scale: f64,
    pub seed: u64,
    pub max_vertices: u64,
    pub instruments: bool,
    /// 0: none.
    pub distance_ratio: f64,
    /// In 2D with [`Criterion::RadiusEdge`], the angle in degrees that no angle of a triangle
    /// within the bound B is below: `asin(1 / (2 B))`. Otherwise 0.
    pub min_angle: f64,
    /// In degrees; 0 = none.
    pub min_dihedral: f64,
    /// How far the result reaches; never [`Extent::Auto`].
    pub extent: Extent,
    /// What becomes of segments that cross.
    pub crossings: Crossings,
    /// 0: none.
    pub max_edge: f64,
    pub gives_way: GivesWay,
    /// Which of the regions between segments are inside; never [`Interior::Auto`].
    pub interior: Interior,
    /// A mesh of at least twice this number of inputs is made in partitions of about this number
    /// or fewer.
    pub(crate) inputs_per_partition: Option<usize>,
    /// Whether the inputs are a sample of more, which come when the mesh of these is made.
    pub(crate) is_sample: bool,
}

impl Parameters {
    /// Returns options that say the same in full. Where `min_angle` is not 0, it says the same as
    /// `criterion` and `quality_bound`, which are set, too.
    pub fn options(&self) -> Options {
        Options {
            output: self.output,
            algorithm: self.algorithm,
            ordering: self.ordering,
            criterion: self.criterion,
            threads: self.threads,
            quality_bound: self.quality_bound,
            epsilon: self.epsilon,
            delta: self.delta,
            gamma: self.gamma,
            yield_radius: self.yield_radius,
            encroachment: self.encroachment,
            cage_scale: self.cage_scale,
            root_scale: self.root_scale,
            seed: self.seed,
            max_vertices: self.max_vertices,
            instruments: self.instruments,
            distance_ratio: self.distance_ratio,
            min_angle: self.min_angle,
            min_dihedral: self.min_dihedral,
            extent: self.extent,
            crossings: self.crossings,
            max_edge: self.max_edge,
            gives_way: self.gives_way,
            interior: self.interior,
        }
    }

    /// Fills the defaults for `dim` into `options`, for a run without sizes but `max_edge`;
    /// [`Extent::Auto`] and [`Interior::Auto`] are those of a mesh without segments.
    ///
    /// # Errors
    /// `InvalidArgument`, naming the option, its value and the range.
    pub fn resolve(dim: usize, options: &Options) -> Result<Self> {
        let (criterion, quality_bound) = bound(dim, options)?;
        // At 1.0 the corner of a D-ball that has inputs always yields, to inputs that are not
        // medial.
        let yield_radius = match options.algorithm {
            Algorithm::Svr => pick(dim, [0.6, 0.9, 0.9, 0.9]),
            _ => 1.0,
        };
        let max_vertices = match options.max_vertices {
            0 => u64::from(u32::MAX - 1),
            given => given.min(u64::from(u32::MAX - 1)),
        };
        let distance_ratio = distance_ratio(options)?;
        // So the hull and its cells are far enough from the cells that are refined.
        let least_root_scale = if distance_ratio > 0.0 { 12.0 } else { 0.0 };
        let root_scale = pick(dim, [2.5, 2.5, 3.0, 4.0]).max(least_root_scale);
        Ok(Self {
            output: output_for(options, false),
            algorithm: options.algorithm,
            ordering: options.ordering,
            criterion,
            threads: options.threads,
            quality_bound,
            epsilon: number(Name::Epsilon, options.epsilon, 0.5, 0.05, 0.6)?,
            delta: number(Name::Delta, options.delta, pick(dim, [0.8, 1.0, 1.0, 1.0]), 0.1, 1.0)?,
            gamma: number(Name::Gamma, options.gamma, 0.1, 0.01, 0.25)?,
            yield_radius: number(Name::YieldRadius, options.yield_radius, yield_radius, 0.05, 1.0)?,
            encroachment: number(Name::Encroachment, options.encroachment, 1.0, 1.0, 4.0)?,
            cage_scale: number(Name::CageScale, options.cage_scale, 0.8, 0.3, 0.9)?,
            root_scale: number(Name::RootScale, options.root_scale, root_scale, 2.0, 16.0)?,
            seed: options.seed,
            max_vertices,
            instruments: options.instruments,
            distance_ratio,
            min_angle: match (dim, criterion) {
                (2, Criterion::RadiusEdge) => (0.5 / quality_bound).asin().to_degrees(),
                _ => 0.0,
            },
            min_dihedral: angle(dim, options)?,
            extent: match options.extent {
                Extent::Auto => Extent::All,
                named => named,
            },
            crossings: options.crossings,
            max_edge: max_edge(options)?,
            gives_way: options.gives_way,
            interior: with_interior(options, false).interior,
            inputs_per_partition: Some(INPUTS_PER_PARTITION),
            is_sample: false,
        })
    }
}

/// The options of a mesh with segments. There the bound is on angles: the cell of a vertex on a
/// boundary reaches beyond that.
///
/// # Errors
/// `InvalidArgument`, naming the option, its value and the rule.
pub fn with_segments(options: &Options) -> Result<Options> {
    let Options { algorithm, criterion, quality_bound, distance_ratio, .. } = *options;
    if algorithm != Algorithm::Netmesh {
        return refuse(say!(
            Choice::Algorithm(algorithm),
            " goes neither with segments nor with a hull or box; these take ",
            Choice::Algorithm(Algorithm::Netmesh)
        ));
    }
    if criterion == Criterion::VoronoiAspect && quality_bound != 0.0 {
        return refuse(say!(
            Name::QualityBound,
            " is {quality_bound}; with segments it must be 0, or go with ",
            Choice::Criterion(Criterion::RadiusEdge)
        ));
    }
    if distance_ratio != 0.0 {
        return refuse(say!(
            Name::DistanceRatio,
            " is {distance_ratio}; it must be 0 with segments"
        ));
    }
    Ok(Options { criterion: Criterion::RadiusEdge, ..options.clone() })
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
    Err(Error::new(ErrorKind::InvalidArgument, message))
}

/// The criterion and its bound: as they are given, or those of `min_angle`.
fn bound(dim: usize, options: &Options) -> Result<(Criterion, f64)> {
    if options.min_angle != 0.0 {
        return Ok((Criterion::RadiusEdge, radius_edge_of(dim, options)?));
    }
    let (default, lowest, highest) = match options.criterion {
        Criterion::VoronoiAspect => (pick(dim, [3.0, 4.0, 5.0, 6.0]), least_aspect(dim), 100.0),
        Criterion::RadiusEdge => {
            (pick(dim, [1.5, 2.0, 2.5, 3.0]), pick(dim, [0.9, 1.1, 1.75, 2.25]), 50.0)
        }
    };
    let given = number(Name::QualityBound, options.quality_bound, default, lowest, highest)?;
    Ok((options.criterion, given))
}

/// The least aspect that may be asked for.
pub(crate) fn least_aspect(dim: usize) -> f64 {
    pick(dim, [2.2, 2.5, 3.5, 4.5])
}

/// The radius-edge ratio of the isosceles triangle whose smallest angle is the one that is asked
/// for.
fn radius_edge_of(dim: usize, options: &Options) -> Result<f64> {
    let Options { min_angle, quality_bound, .. } = *options;
    if dim != 2 {
        return refuse(say!(
            Name::MinAngle,
            " is {min_angle}; it must be 0 in {dim}D, since only in 2D does a radius-edge ratio \
             bound the angles"
        ));
    }
    if quality_bound != 0.0 {
        return refuse(say!(
            Name::MinAngle,
            " is {min_angle} and ",
            Name::QualityBound,
            " is {quality_bound}; one of them must be 0, since each is a bound on the angles"
        ));
    }
    let angle = number(Name::MinAngle, min_angle, 0.0, SMALLEST_ANGLE, LARGEST_ANGLE)?;
    Ok(0.5 / angle.to_radians().sin())
}

/// A least dihedral angle, which only tetrahedra can be given.
fn angle(dim: usize, options: &Options) -> Result<f64> {
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
    number(Name::MinDihedral, given, 0.0, 0.0, MAX_DIHEDRAL)
}

/// The default for 2D, 3D, 4D and everything above.
fn pick(dim: usize, defaults: [f64; 4]) -> f64 {
    defaults[(dim - 2).min(3)]
}

fn distance_ratio(options: &Options) -> Result<f64> {
    let ratio = number(Name::DistanceRatio, options.distance_ratio, 0.0, 0.05, 1.0)?;
    match cages_or_other(options) {
        Some(other) if ratio > 0.0 => {
            refuse(say!(Name::DistanceRatio, " is {ratio}; it does not go with ", other))
        }
        _ => Ok(ratio),
    }
}

/// A largest edge, if there is one.
fn max_edge(options: &Options) -> Result<f64> {
    let given = options.max_edge;
    if given.is_nan() || given < 0.0 {
        return refuse(say!(Name::MaxEdge, " is {given}; it must be 0 (none) or above"));
    }
    match cages_or_other(options) {
        Some(other) if given > 0.0 => {
            refuse(say!(Name::MaxEdge, " is {given}; it does not go with ", other))
        }
        _ => Ok(given),
    }
}

/// Fails if meshes by these `options` may have no sizes. `given` tells them.
pub(crate) fn check_sized(options: &Options, given: Name) -> Result<()> {
    match cages_or_other(options) {
        Some(other) => refuse(say!(given, " is given; it does not go with ", other)),
        None => Ok(()),
    }
}

/// The same for sizes of regions.
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

fn number(name: Name, given: f64, default: f64, lowest: f64, highest: f64) -> Result<f64> {
    if given == 0.0 {
        return Ok(default);
    }
    if !(lowest..=highest).contains(&given) {
        return refuse(say!(
            name,
            " is {given}; it must be 0 (default {default}) or in [{lowest}, {highest}]"
        ));
    }
    Ok(given)
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
        for ends in [SMALLEST_ANGLE, LARGEST_ANGLE] {
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
