//! Defaults for parts, which facets bound, where the options leave them open: `netmesh part.stl`
//! makes the mesh of the inside that people mean who give nothing else. And the criterion of a
//! bound that is given alone.

use crate::arguments::{Arguments, Product};
use netmesh::{Algorithm, Criterion, Extent, Labels, Mesh, Options};

/// Angle from flat in degrees up to which triangles are one facet. Flat faces that were stored in
/// single precision are facets again, and turned surfaces of some hundred sides keep their edges.
const COPLANAR: f64 = 0.1;

/// Smallest dihedral angle in degrees.
const MIN_DIHEDRAL: f64 = 10.0;

/// Returns the options of the run, with these defaults if the input has facets that may bound the
/// mesh.
pub fn options(arguments: &Arguments, mesh: &Mesh) -> Options {
    let mut options = arguments.options();
    let bounds_mesh = matches!(options.extent, Extent::Auto | Extent::Boundary);
    let is_refined = options.algorithm == Algorithm::Netmesh && !arguments.hierarchical;
    let is_open = |name: &str| !arguments.given.contains(&name);
    if options.quality_bound != 0.0 && is_open("criterion") && conforms(&options, mesh) {
        // No other one goes with facets, segments, hulls and boxes.
        options.criterion = Criterion::RadiusEdge;
    }
    if mesh.given_facets().count() == 0 || !bounds_mesh {
        return options;
    }
    if is_open("coplanar") {
        options.coplanar = COPLANAR;
    }
    if is_open("labels") {
        options.labels = Labels::Regions;
    }
    let keeps_angles = is_refined && options.quality_bound.is_finite();
    if keeps_angles && arguments.product() == Product::Mesh && is_open("min_dihedral") {
        options.min_dihedral = MIN_DIHEDRAL;
    }
    options
}

/// Returns true if the mesh conforms to more than its points.
fn conforms(options: &Options, mesh: &Mesh) -> bool {
    mesh.given_facets().count() > 0
        || mesh.segments().count() > 0
        || matches!(options.extent, Extent::Hull | Extent::Box)
}

/// Returns the line of the summary that tells these defaults, if any apply.
pub fn told(arguments: &Arguments, mesh: &Mesh) -> Option<String> {
    let (given, used) = (arguments.options(), options(arguments, mesh));
    let coplanar = (used.coplanar != given.coplanar).then(|| format!("--coplanar {COPLANAR}"));
    let angle = used.min_dihedral != given.min_dihedral;
    let angle = angle.then(|| format!("--min-dihedral {MIN_DIHEDRAL}"));
    let labels = (used.labels != given.labels).then(|| "--labels regions".to_owned());
    let all: Vec<String> = [coplanar, angle, labels].into_iter().flatten().collect();
    let [first @ .., last] = &all[..] else { return None };
    let list = if first.is_empty() { last } else { &format!("{} and {last}", first.join(", ")) };
    Some(format!("{list} by default"))
}
