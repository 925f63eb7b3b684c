//! Domains of space: facets become faces of an exactly Delaunay mesh, whatever their angles. The
//! certificate says so of every mesh here, at its third level.

mod angles;
mod bent;
mod cages;
mod crossings;
mod curvature;
mod dihedral;
mod extents;
mod files;
mod folds;
mod holes;
mod hulls;
mod labels;
mod options;
mod roundings;
mod shapes;
mod thin;
mod units;

use netmesh::options::Options;
use netmesh::validate::validate_mesh;
use netmesh::{Criterion, Mesh, Region, Triangulation};

pub type Point = [f64; 3];

/// Points and polygons between them, and regions.
#[derive(Clone, Default)]
pub struct Solid {
    pub points: Vec<Point>,
    pub polygons: Vec<Vec<u32>>,
    pub regions: Vec<Region>,
}

impl Solid {
    pub fn mesh(&self) -> Mesh {
        let mut mesh = Mesh::new(3, self.points.len(), self.points.as_flattened(), 0).unwrap();
        let loops: Vec<u64> = (0..=self.polygons.len() as u64).collect();
        let mut starts = vec![0];
        for polygon in &self.polygons {
            starts.push(starts[starts.len() - 1] + polygon.len() as u64);
        }
        mesh.set_facets(&loops, &starts, &self.polygons.concat(), None).unwrap();
        mesh.set_regions(&self.regions).unwrap();
        mesh
    }

    /// Returns the mesh of a run, whose certificate holds.
    pub fn run(&self, options: &Options) -> Triangulation {
        let mut mesh = self.mesh();
        mesh.run(options, None).unwrap_or_else(|error| panic!("{error}"));
        assert_holds(&mesh);
        mesh.result().unwrap().clone()
    }

    /// Moves all of it.
    pub fn moved(mut self, place: impl Fn(Point) -> Point) -> Self {
        self.points.iter_mut().for_each(|point| *point = place(*point));
        self.regions.iter_mut().for_each(|region| region.seed = place(region.seed));
        self
    }

    /// Adds what another one has.
    pub fn with(mut self, other: &Self) -> Self {
        let first = self.points.len() as u32;
        self.points.extend(&other.points);
        let moved = |polygon: &Vec<u32>| polygon.iter().map(|input| input + first).collect();
        self.polygons.extend(other.polygons.iter().map(moved));
        self.regions.extend(&other.regions);
        self
    }
}

/// Returns the box between two corners; its sides have their normals outside.
pub fn cuboid(low: Point, high: Point) -> Solid {
    let corner = |at: usize| -> Point {
        std::array::from_fn(|axis| if (at >> axis) & 1 == 0 { low[axis] } else { high[axis] })
    };
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Solid {
        points: (0..8).map(corner).collect(),
        polygons: sides.iter().map(|side| side.to_vec()).collect(),
        regions: Vec::new(),
    }
}

/// Returns a place in a frame that is parallel to no axis.
pub fn tilted([x, y, z]: Point) -> Point {
    let (s, c) = 0.7f64.sin_cos();
    let (x, y) = (c * x - s * y, s * x + c * y);
    let (s, c) = 0.4f64.sin_cos();
    [x + 0.1, c * y - s * z, s * y + c * z]
}

/// Returns the options of a domain with a bound of the radius-edge ratio; infinity asks for
/// conformity alone.
pub fn bounded(quality_bound: f64) -> Options {
    Options { criterion: Criterion::RadiusEdge, quality_bound, ..Options::default() }
}

pub fn assert_holds(mesh: &Mesh) {
    let report = validate_mesh(mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

/// Returns the sum of the volumes of all simplices.
pub fn volume(mesh: &Triangulation) -> f64 {
    let of = |simplex: usize| -> f64 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|at| mesh.point(mesh.simplex(simplex)[at]));
        let [u, v, w] = [b, c, d].map(|x| [0, 1, 2].map(|axis| x[axis] - a[axis]));
        (u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0]))
            / 6.0
    };
    // With what each sum loses to rounding: that is more than the volumes lose themselves.
    let (whole, lost) = (0..mesh.simplex_count()).map(of).fold((0.0, 0.0), |(sum, lost), own| {
        let next: f64 = sum + own;
        (next, lost + (own - (next - sum)))
    });
    whole + lost
}

/// Fails if any simplex is excused from the bound: by a small angle of the input, or by doubles.
/// The certificate keeps all others to it.
pub fn assert_none_excused(mesh: &Triangulation) {
    assert!(mesh.boundary.forced.is_empty(), "{} forced", mesh.boundary.forced.len());
    assert!(!mesh.precision_limited.contains(&true));
}
