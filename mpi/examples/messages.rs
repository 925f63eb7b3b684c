//! A test of messages over MPI, run by mpirun: all lengths, in pieces of a few bytes, and failures
//! of a rank while others are in any call. Every rank ends with a panic where something is wrong.

use netmesh::{Error, ErrorKind, Result};
use netmesh_mpi::comm::mpi::{Ranks, begin, end};
use netmesh_mpi::comm::{Collective, Communicator, Operation, agreed};

fn main() -> Result<()> {
    begin()?;
    for chunk in [1, 7, 1 << 16, u32::MAX] {
        lengths(&Collective::new(Ranks::of_world()?.in_chunks_of(chunk)), chunk)?;
    }
    type Call = fn(&dyn Communicator) -> Result<()>;
    let calls: [Call; 6] = [
        |comm| comm.barrier(),
        |comm| comm.all_gather(&[1]).map(drop),
        |comm| comm.all_to_all(vec![vec![2]; comm.size()]).map(drop),
        |comm| comm.all_reduce_numbers(&mut [1.0], Operation::Sum),
        |comm| comm.receive(0, 9).map(drop),
        // Too long to be on its way before the receiver asks for it, which it never does.
        |comm| comm.send(0, 9, &vec![3; 1 << 22]),
    ];
    for call in calls {
        failure(&Collective::new(Ranks::of_world()?), call);
    }
    let first = Ranks::of_world().map(|ranks| Collective::new(ranks).rank() == 0)?;
    if first {
        println!("messages arrive, and failures too");
    }
    end()
}

fn lengths(comm: &dyn Communicator, chunk: u32) -> Result<()> {
    let (rank, size) = (comm.rank(), comm.size());
    // Some of no length, some of several pieces.
    let scale = if chunk < 100 { 3 } else { 50_000 };
    let message = |from: usize, to: usize| -> Vec<u8> {
        (0..from * to * scale).map(|i| (i * 31 + from * 7 + to) as u8).collect()
    };
    let received = comm.all_to_all((0..size).map(|to| message(rank, to)).collect())?;
    assert!(received.iter().enumerate().all(|(from, bytes)| *bytes == message(from, rank)));
    let gathered = comm.all_gather(&message(rank, 2))?;
    assert!(gathered.iter().enumerate().all(|(from, bytes)| *bytes == message(from, 2)));
    let sums = comm.exclusive_sum(rank as u64 + 1)?;
    assert_eq!(sums, ((rank * (rank + 1) / 2) as u64, (size * (size + 1) / 2) as u64));
    let mut numbers = [rank as f64, -1.0];
    comm.all_reduce_numbers(&mut numbers, Operation::Max)?;
    assert_eq!(numbers, [size as f64 - 1.0, -1.0]);
    // Round about, the even ranks first: a send may wait for its receiver.
    let (next, before) = ((rank + 1) % size, (rank + size - 1) % size);
    let send = || comm.send(next, 3, &message(rank, next)).and_then(|()| comm.send(next, 4, &[]));
    let receive = || {
        assert_eq!(comm.receive(before, 3)?, message(before, rank));
        assert_eq!(comm.receive(before, 4)?, []);
        Ok(())
    };
    match (size, rank % 2) {
        (1, _) => Ok(()),
        (_, 0) => send().and_then(|()| receive()),
        _ => receive().and_then(|()| send()),
    }
}

/// Checks that all ranks learn of a failure of the last rank while rank 0 is at a barrier and the
/// others are in `call`.
fn failure(comm: &dyn Communicator, call: fn(&dyn Communicator) -> Result<()>) {
    let last = comm.size() - 1;
    let error = agreed(comm, || match comm.rank() {
        rank if rank == last => Err(Error::new(ErrorKind::Limit, "enough")),
        0 => comm.barrier(),
        _ => call(comm),
    })
    .unwrap_err();
    let message = if last == 0 { "enough".to_owned() } else { format!("enough (rank {last})") };
    assert_eq!((error.kind(), error.message()), (ErrorKind::Limit, &*message));
}
