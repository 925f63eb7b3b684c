//! Cases that are measured: points, and the options that they are meshed with.

use crate::inputs::Distribution;
use netmesh::validate::validate;
use netmesh::{Algorithm, Criterion, Mesh, Options, Output};

/// Kinds of results, and the points that they are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Default options.
    Hierarchical(Distribution),
    /// A mesh without cages of uniform points, its radius-edge ratios at most 2.
    Finished,
    /// The triangulation of uniform points, without Steiner points.
    Delaunay,
}

impl Kind {
    pub const ALL: [Self; 7] = [
        Self::Hierarchical(Distribution::Uniform),
        Self::Hierarchical(Distribution::Gaussian),
        Self::Hierarchical(Distribution::Clusters),
        Self::Hierarchical(Distribution::Sphere),
        Self::Hierarchical(Distribution::Lattice),
        Self::Finished,
        Self::Delaunay,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Hierarchical(Distribution::Uniform) => "uniform",
            Self::Hierarchical(Distribution::Gaussian) => "gaussian",
            Self::Hierarchical(Distribution::Clusters) => "clusters",
            Self::Hierarchical(Distribution::Sphere) => "sphere",
            Self::Hierarchical(Distribution::Lattice) => "lattice",
            Self::Finished => "finished",
            Self::Delaunay => "delaunay",
        }
    }

    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub dim: usize,
    pub n: usize,
    pub kind: Kind,
}

impl Case {
    /// The points, not meshed yet.
    pub fn mesh(&self) -> netmesh::Result<Mesh> {
        let distribution = match self.kind {
            Kind::Hierarchical(distribution) => distribution,
            Kind::Finished | Kind::Delaunay => Distribution::Uniform,
        };
        Mesh::new(self.dim, self.n, &distribution.points(self.dim, self.n), 0)
    }

    pub fn options(&self) -> Options {
        match self.kind {
            Kind::Hierarchical(_) => Options::default(),
            Kind::Finished => Options {
                output: Output::WellSpaced,
                criterion: Criterion::RadiusEdge,
                quality_bound: 2.0,
                ..Options::default()
            },
            Kind::Delaunay => Options { algorithm: Algorithm::Delaunay, ..Options::default() },
        }
    }
}

/// A fast mesh that is wrong is no figure.
///
/// # Panics
/// If the mesh has not been run or its certificate does not hold in full.
pub fn require_certificate(mesh: &Mesh) {
    let triangulation = mesh.triangulation().expect("a mesh that has been run");
    let report = validate(mesh.inputs(), triangulation, 3).expect("memory for the certificate");
    assert!(report.violations == 0 && report.level == 3, "the mesh is wrong: {report:?}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_their_kinds() {
        for kind in Kind::ALL {
            assert_eq!(Kind::named(kind.name()), Some(kind));
        }
        assert_eq!(Kind::named("torus"), None);
    }

    #[test]
    fn meshes_of_every_kind_are_right() {
        for kind in Kind::ALL {
            let case = Case { dim: 3, n: 200, kind };
            let mut mesh = case.mesh().unwrap();
            mesh.run(&case.options(), None).unwrap();
            require_certificate(&mesh);
        }
    }
}
