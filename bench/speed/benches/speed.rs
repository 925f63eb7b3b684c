//! Wall time of `Mesh::run`, without making the points and without freeing the mesh.
//!
//!     cargo bench --manifest-path bench/speed/Cargo.toml [-- FILTER]
//!     cargo bench --manifest-path bench/speed/Cargo.toml -- --save-baseline before
//!     cargo bench --manifest-path bench/speed/Cargo.toml -- --baseline before
//!
//! FILTER is a part of a name, as 3d/clusters. The certificate of each case has to hold before the
//! case is timed.

use criterion::{BatchSize, Criterion, SamplingMode, criterion_group, criterion_main};
use netmesh::Mesh;
use netmesh_speed::cases::{Case, Kind, require_certificate};
use netmesh_speed::inputs::Distribution::{Clusters, Gaussian, Sphere, Uniform};
use std::cell::LazyCell;
use std::time::Duration;

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (dim, n) in [(2, 10_000), (3, 10_000), (4, 1_000)] {
        for distribution in [Uniform, Gaussian, Clusters, Sphere] {
            cases.push(Case { dim, n, kind: Kind::Hierarchical(distribution) });
        }
    }
    for kind in [Kind::Finished, Kind::Delaunay] {
        cases.push(Case { dim: 3, n: 10_000, kind });
    }
    cases
}

fn fresh(case: &Case) -> Mesh {
    case.mesh().expect("points that can be meshed")
}

fn run(case: &Case, mut mesh: Mesh) -> Mesh {
    mesh.run(&case.options(), None).expect("a run without an error");
    mesh
}

fn mesh_run(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("run");
    // A run takes a good part of a second: few samples, and as many runs in each.
    group.sampling_mode(SamplingMode::Flat).sample_size(15);
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(10));
    for case in cases() {
        // Only for what the filter leaves: the certificate takes longer than the run.
        let certified = LazyCell::new(|| require_certificate(&run(&case, fresh(&case))));
        let name = format!("{}d/{}/{}", case.dim, case.kind.name(), case.n);
        group.bench_function(name, |bencher| {
            LazyCell::force(&certified);
            bencher.iter_batched(|| fresh(&case), |mesh| run(&case, mesh), BatchSize::PerIteration);
        });
    }
    group.finish();
}

criterion_group!(benches, mesh_run);
criterion_main!(benches);
