//! The certificate of meshes of several ranks: meshes that hold, and for each rule one that is
//! damaged.

mod between;
mod complexes;
mod domains;
mod geometry;
mod made;
mod promises;
mod whole;

use made::{certify, clusters, duplicates, parts, share, uniform};
use netmesh::{Criterion, Options, Output};
use netmesh_mpi::certificate::validate;
use netmesh_mpi::comm::threads;
use netmesh_mpi::run;

#[test]
fn meshes_of_any_number_of_ranks_hold() {
    let finished = Options { output: Output::WellSpaced, ..Options::default() };
    let edges = Options { criterion: Criterion::RadiusEdge, ..finished.clone() };
    type Shape = fn(usize, usize) -> Vec<f64>;
    let shapes: [(&str, Shape); 3] =
        [("uniform", uniform), ("clusters", clusters), ("duplicates", duplicates)];
    for (dim, count) in [(2, 300), (3, 120)] {
        for (shape, make) in shapes {
            let all = make(dim, count);
            for options in [&Options::default(), &finished, &edges] {
                for ranks in 1..=5 {
                    let report = certify(&parts(dim, &all, ranks, options), 3);
                    let case = format!("{shape} in {dim}D on {ranks} ranks, {options:?}");
                    assert_eq!((report.level, &report.first), (3, &None), "{case}");
                    assert!(report.violations == 0 && report.checked > 1000, "{case}");
                }
            }
        }
    }
}

/// Meshes of several partitions, made by the ranks themselves.
#[test]
fn meshes_that_ranks_make_hold() {
    for (dim, count, ranks) in [(2, 18_000, 1), (2, 18_000, 4), (3, 8_500, 2)] {
        let all = uniform(dim, count);
        let made = threads::run(ranks, |comm| {
            run(comm, dim, &share(&all, dim, comm), &Options::default(), None).unwrap()
        });
        let report = certify(&made, 3);
        assert_eq!((report.level, report.first), (3, None), "{dim}D on {ranks} ranks");
        assert!(ranks == 1 || made.iter().filter(|part| part.simplex_count() > 0).count() > 1);
    }
}

#[test]
fn lower_levels_check_less() {
    let parts = parts(2, &uniform(2, 100), 3, &Options::default());
    let [one, two, three] = [1, 2, 3].map(|level| certify(&parts, level));
    assert_eq!([one.level, two.level, three.level], [1, 2, 3]);
    assert!(one.checked < two.checked && two.checked < three.checked);
    for level in [0, 4] {
        let errors = threads::run(3, |comm| {
            validate(comm, &parts[comm.rank()], level).unwrap_err().message().to_owned()
        });
        assert_eq!(errors, vec![format!("level is {level}; it must be 1, 2 or 3 (rank 0)"); 3]);
    }
    threads::run(3, |comm| {
        let error = validate(comm, &parts[comm.rank()], 1 + comm.rank() as u32 % 2).unwrap_err();
        assert!(error.message().starts_with("level is 2, on rank 0 it is 1;"), "{error}");
    });
    threads::run(2, |comm| {
        let error = validate(comm, &parts[comm.rank()], 1).unwrap_err();
        assert!(error.message().starts_with("the mesh is that of rank 0 of 3"), "{error}");
    });
}

/// Domains in domains, eighty deep.
#[test]
fn deep_hierarchies_hold() {
    for dim in [2, 3] {
        let mut all = vec![0.0; dim];
        for scale in (0..80).map(|level| 2f64.powi(-12 * level)) {
            for axis in 0..dim {
                let mut point = vec![0.0; dim];
                point[axis] = scale;
                point[(axis + 1) % dim] = 0.3 * scale;
                all.extend(point);
            }
        }
        for ranks in [1, 3] {
            let parts = parts(dim, &all, ranks, &Options::default());
            assert!(parts[0].totals.domains >= 80, "{dim}D");
            let report = certify(&parts, 3);
            assert_eq!((report.level, report.first), (3, None), "{dim}D on {ranks} ranks");
        }
    }
}
