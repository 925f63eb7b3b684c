//! Ranks that are threads: how they talk, how they fail together, and what they have of a mesh.

use netmesh::{Error, ErrorKind, Mesh, Options};
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::comm::{Communicator, Operation, agree, agreed, threads};
use netmesh_mpi::distributed::NO_ID;
use std::collections::{BTreeMap, BTreeSet};

/// Returns pseudorandom points, one after another.
fn points(dim: usize, count: usize) -> Vec<f64> {
    let mut state = 7u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..dim * count).map(|_| number()).collect()
}

/// Returns the points of a rank: blocks of one size.
fn share(all: &[f64], dim: usize, comm: &dyn Communicator) -> Vec<f64> {
    let start = |rank| all.len() / dim * rank / comm.size() * dim;
    all[start(comm.rank())..start(comm.rank() + 1)].to_vec()
}

fn parts(dim: usize, all: &[f64], ranks: usize) -> Vec<DistributedMesh> {
    let run = |comm: &dyn Communicator| {
        netmesh_mpi::run(comm, dim, &share(all, dim, comm), &Options::default(), None).unwrap()
    };
    threads::run(ranks, run)
}

#[test]
fn messages_of_all_lengths_arrive() {
    for size in [1, 2, 5] {
        threads::run(size, |comm| {
            let rank = comm.rank();
            let message = |from: usize, to: usize| vec![(from * 10 + to) as u8; from * to];
            let sent = (0..size).map(|to| message(rank, to)).collect();
            let received = comm.all_to_all(sent).unwrap();
            assert_eq!(received, (0..size).map(|from| message(from, rank)).collect::<Vec<_>>());
            let gathered = comm.all_gather(&vec![rank as u8; rank]).unwrap();
            assert_eq!(gathered, (0..size).map(|from| vec![from as u8; from]).collect::<Vec<_>>());
            let sums = comm.exclusive_sum(rank as u64 + 1).unwrap();
            assert_eq!(sums, ((rank * (rank + 1) / 2) as u64, (size * (size + 1) / 2) as u64));
            let mut numbers = [rank as f64, -1.0];
            comm.all_reduce_numbers(&mut numbers, Operation::Max).unwrap();
            assert_eq!(numbers, [size as f64 - 1.0, -1.0]);
            let mut integers = [rank as u64 + 3, 1];
            comm.all_reduce_integers(&mut integers, Operation::Sum).unwrap();
            assert_eq!(integers[1], size as u64);
            comm.send((rank + 1) % size, 3, &[rank as u8]).unwrap();
            comm.send((rank + 1) % size, 4, &[]).unwrap();
            let before = (rank + size - 1) % size;
            assert_eq!(comm.receive(before, 4).unwrap(), []);
            assert_eq!(comm.receive(before, 3).unwrap(), [before as u8]);
        });
    }
}

/// Lets one rank fail while the others are in any call, or wait for a message that never comes.
#[test]
fn a_failure_of_one_rank_reaches_all_wherever_they_are() {
    type Call = fn(&dyn Communicator) -> netmesh::Result<()>;
    let calls: [Call; 7] = [
        |comm| comm.barrier(),
        |comm| comm.all_gather(&[1]).map(drop),
        |comm| comm.all_to_all(vec![vec![2]; comm.size()]).map(drop),
        |comm| comm.exclusive_sum(1).map(drop),
        |comm| comm.all_reduce_integers(&mut [1], Operation::Sum),
        |comm| comm.receive(0, 9).map(drop),
        |comm| agree(comm, Err(Error::new(ErrorKind::Limit, "higher ranks are not heard"))),
    ];
    for call in calls {
        let answers = threads::run(4, |comm| {
            agreed(comm, || match comm.rank() {
                1 => Err(Error::new(ErrorKind::Io, "the disk is full")),
                _ if comm.rank() == 0 => comm.barrier(),
                _ => call(comm),
            })
            .unwrap_err()
        });
        for error in answers {
            assert_eq!(
                (error.kind(), error.message()),
                (ErrorKind::Io, "the disk is full (rank 1)")
            );
        }
    }
}

#[test]
fn a_panic_of_one_rank_is_an_error_on_all() {
    let answers = threads::run(3, |comm| {
        let fails = || {
            assert!(comm.rank() != 2, "a defect");
            comm.barrier()
        };
        let error = agreed(comm, fails).unwrap_err();
        // Whatever comes next has the same answer, at once.
        assert_eq!(comm.barrier().unwrap_err(), error);
        assert_eq!(comm.receive(0, 1).unwrap_err(), error);
        error
    });
    for error in answers {
        assert_eq!(error.kind(), ErrorKind::Panic);
        assert_eq!(error.message(), "internal error: a defect; please report it (rank 2)");
    }
}

/// Returns the simplices as the bits of the coordinates of their vertices.
fn simplices_of<'a>(
    dim: usize,
    simplices: impl Iterator<Item = &'a [u32]>,
    points: &[f64],
) -> BTreeSet<Vec<Vec<u64>>> {
    let coordinates = |vertex: &u32| {
        points[*vertex as usize * dim..][..dim].iter().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    let sorted = |simplex: &[u32]| {
        let mut vertices: Vec<_> = simplex.iter().map(coordinates).collect();
        vertices.sort();
        vertices
    };
    simplices.map(sorted).collect()
}

/// Makes several partitions and seams, wherever they are made.
#[test]
fn the_parts_of_all_ranks_are_the_mesh_of_one() {
    for (dim, count) in [(2, 4000), (3, 2500)] {
        let all = points(dim, count);
        let mut expected = BTreeSet::new();
        let mut totals = None;
        for ranks in [1, 2, 3, 8] {
            let parts = parts(dim, &all, ranks);
            let mut found = BTreeSet::new();
            for part in &parts {
                let own = part.simplices.chunks_exact(dim + 1);
                let own = simplices_of(dim, own, &part.points);
                assert_eq!(own.len(), part.simplex_count());
                found.extend(own);
                assert_eq!(part.totals, parts[0].totals);
            }
            assert_eq!(found.len() as u64, parts[0].totals.simplices);
            let pieces = parts[0].totals.pieces;
            assert!(pieces > 4, "{pieces} pieces");
            if ranks == 1 {
                (expected, totals) = (found, Some(parts[0].totals));
                continue;
            }
            assert!(found == expected, "{dim}D on {ranks} ranks");
            assert_eq!(Some(parts[0].totals), totals);
        }
        let mut mesh = Mesh::new(dim, count, &all, 0).unwrap();
        mesh.run(&Options::default(), None).unwrap();
        let usual = mesh.triangulation().unwrap().vertex_count() as f64;
        let made = totals.unwrap();
        assert_eq!((made.inputs, made.duplicates), (count as u64, 0));
        assert!((0.95..1.05).contains(&(made.vertices as f64 / usual)), "{made:?} {usual}");
    }
}

/// Ghosts are all simplices of others that share a vertex, and nothing else.
#[test]
fn ghosts_complete_the_stars_of_own_vertices() {
    let all = points(3, 120);
    let parts = parts(3, &all, 4);
    let ids = |part: &DistributedMesh, vertices: &[u32]| -> BTreeSet<u64> {
        vertices.iter().map(|vertex| part.vertex_ids[*vertex as usize]).collect()
    };
    let mut whole = BTreeMap::new();
    for part in &parts {
        for simplex in 0..part.simplex_count() {
            let id = part.first_simplex + simplex as u64;
            whole.insert(id, (part.rank, ids(part, part.simplex(simplex))));
        }
    }
    for part in &parts {
        let own: BTreeSet<u64> = part.vertex_ids[..part.own_vertices].iter().copied().collect();
        let expected: BTreeMap<u64, (usize, BTreeSet<u64>)> = whole
            .iter()
            .filter(|(_, (rank, vertices))| *rank != part.rank && !vertices.is_disjoint(&own))
            .map(|(id, simplex)| (*id, simplex.clone()))
            .collect();
        let found: BTreeMap<u64, (usize, BTreeSet<u64>)> = (0..part.ghosts.len())
            .map(|at| {
                (part.ghosts[at].id, (part.ghosts[at].owner as usize, ids(part, part.ghost(at))))
            })
            .collect();
        assert_eq!(found, expected);
        for (slot, &neighbor) in part.neighbors.iter().enumerate().filter(|(_, n)| **n != NO_ID) {
            let simplex = &whole[&(part.first_simplex + slot as u64 / 4)].1;
            assert_eq!(whole[&neighbor].1.intersection(simplex).count(), 3);
        }
    }
}

#[test]
fn what_does_not_fit_together_is_told_to_all() {
    let all = points(2, 50);
    type Change = fn(usize, &mut Vec<f64>, &mut usize, &mut Options);
    let changes: [(Change, ErrorKind, &str); 5] = [
        (
            |rank, points, _, _| points[3] = [0.0, f64::NAN][rank % 2],
            ErrorKind::NonFinite,
            "points[1] has a non-finite coordinate 1: NaN; every coordinate must be finite (rank \
             1)",
        ),
        (
            |rank, points, dim, _| (*points, *dim) = (Vec::new(), 2 + rank % 2),
            ErrorKind::Dimension,
            "dim is 3, on rank 0 it is 2; it must be the same on all ranks (rank 1)",
        ),
        (
            |rank, _, _, options| options.seed = rank as u64,
            ErrorKind::InvalidArgument,
            "options.seed is 1, on rank 0 it is 0; it must be the same on all ranks (rank 1)",
        ),
        (
            |_, _, _, options| options.epsilon = -1.0,
            ErrorKind::InvalidArgument,
            "options.epsilon is -1;",
        ),
        (
            |_, points, _, _| points.clear(),
            ErrorKind::DegenerateInput,
            "0 points, 0 of them distinct",
        ),
    ];
    for (change, kind, message) in changes {
        let errors = threads::run(3, |comm| {
            let (mut points, mut dim, mut options) = (share(&all, 2, comm), 2, Options::default());
            change(comm.rank(), &mut points, &mut dim, &mut options);
            netmesh_mpi::run(comm, dim, &points, &options, None).unwrap_err()
        });
        for error in &errors {
            assert_eq!((error, error.kind()), (&errors[0], kind));
            assert!(error.message().starts_with(message), "{error}");
        }
    }
    // Threads may differ, and a rank may have all points.
    let made = threads::run(3, |comm| {
        let options = Options { threads: comm.rank() as u32, ..Options::default() };
        let points = if comm.rank() == 2 { all.clone() } else { Vec::new() };
        netmesh_mpi::run(comm, 2, &points, &options, None).unwrap().totals.inputs
    });
    assert_eq!(made, [50; 3]);
}

#[test]
fn a_cancelled_rank_cancels_all() {
    let all = points(2, 200);
    let errors = threads::run(3, |comm| {
        let mut cancel = |_: &netmesh::Progress| comm.rank() != 1;
        let points = share(&all, 2, comm);
        netmesh_mpi::run(comm, 2, &points, &Options::default(), Some(&mut cancel)).unwrap_err()
    });
    assert!(errors.iter().all(|error| error.kind() == ErrorKind::Cancelled), "{errors:?}");
}

/// Holds that the file that is missing is named as the rank knows it that misses it.
#[test]
fn a_file_that_one_rank_misses_has_that_ranks_name() {
    let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("shares");
    let _ = std::fs::remove_dir_all(&directory);
    std::fs::create_dir_all(&directory).unwrap();
    let path = |rank: usize| directory.join(format!("points_{rank}.xyz"));
    (0..2).for_each(|rank| std::fs::write(path(rank), "0 0\n1 0\n0 1\n").unwrap());
    let read = |comm: &dyn Communicator| {
        let read = netmesh_mpi::input::read(comm, &path(comm.rank()), netmesh::io::Format::Auto);
        read.map(|share| share.points.len() / 2)
    };
    assert_eq!(threads::run(2, read).into_iter().map(Result::unwrap).sum::<usize>(), 3);
    let name = path(2).display().to_string();
    for (content, words) in
        [(None, "cannot open"), (Some("0 0\n"), "the file's length in bytes is 4")]
    {
        if let Some(content) = content {
            std::fs::write(path(2), content).unwrap();
        }
        for error in threads::run(3, read).into_iter().map(Result::unwrap_err) {
            let message = error.message();
            assert!(message.starts_with(&format!("{name}: {words}")), "{message}");
            assert!(message.ends_with("(rank 2)"), "{message}");
        }
    }
}
