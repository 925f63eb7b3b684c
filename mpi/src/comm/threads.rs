//! Ranks that are threads of one process: for tests, and for runs without MPI.

use super::{Collective, Communicator, Operation, Transport};
use netmesh::distributed::memory::copied;
use netmesh::{Error, Result};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Runs `body` on `size` ranks; answers what each has answered, by rank.
pub fn run<R: Send>(size: usize, body: impl Fn(&dyn Communicator) -> R + Sync) -> Vec<R> {
    let network = Arc::new(Network::new(size));
    std::thread::scope(|scope| {
        let start = |rank| {
            let (network, body) = (network.clone(), &body);
            scope.spawn(move || body(&Collective::new(Thread { rank, network })))
        };
        let running: Vec<_> = (0..size).map(start).collect();
        let answer = |thread: std::thread::ScopedJoinHandle<'_, R>| {
            thread.join().unwrap_or_else(|payload| std::panic::resume_unwind(payload))
        };
        running.into_iter().map(answer).collect()
    })
}

/// A rank.
struct Thread {
    rank: usize,
    network: Arc<Network>,
}

/// State that the ranks share.
struct Network {
    size: usize,
    state: Mutex<State>,
    changed: Condvar,
}

struct State {
    /// Messages that the ranks have brought to the collective call under way, for each rank.
    brought: Vec<Option<Vec<Vec<u8>>>>,
    /// Number of ranks that have taken theirs from it.
    taken: usize,
    /// Ranks may take, not bring.
    is_complete: bool,
    /// Messages by sender, receiver and tag.
    messages: HashMap<(usize, usize, u16), VecDeque<Vec<u8>>>,
    is_failing: bool,
}

impl Network {
    fn new(size: usize) -> Self {
        let state = State {
            brought: vec![None; size],
            taken: 0,
            is_complete: false,
            messages: HashMap::new(),
            is_failing: false,
        };
        Self { size, state: Mutex::new(state), changed: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State>) -> MutexGuard<'a, State> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }
}

impl Thread {
    /// Brings a message for each rank, and takes those of all ranks for this one.
    fn exchange_all(&self, messages: Vec<Vec<u8>>) -> Vec<Vec<u8>> {
        let network = &*self.network;
        let mut state = network.lock();
        while state.is_complete {
            state = network.wait(state);
        }
        state.brought[self.rank] = Some(messages);
        if state.brought.iter().all(Option::is_some) {
            state.is_complete = true;
            state.taken = 0;
            network.changed.notify_all();
        }
        while !state.is_complete {
            state = network.wait(state);
        }
        let mine = |brought: &mut Option<Vec<Vec<u8>>>| {
            brought
                .as_mut()
                .map(|messages| std::mem::take(&mut messages[self.rank]))
                .unwrap_or_default()
        };
        let received = state.brought.iter_mut().map(mine).collect();
        state.taken += 1;
        if state.taken == network.size {
            state.is_complete = false;
            state.brought.iter_mut().for_each(|brought| *brought = None);
            network.changed.notify_all();
        }
        received
    }

    fn share(&self, bytes: &[u8]) -> Vec<Vec<u8>> {
        self.exchange_all(vec![bytes.to_vec(); self.network.size])
    }

    fn share_words(&self, words: impl Iterator<Item = [u8; 8]>) -> Vec<Vec<u8>> {
        self.share(&words.flatten().collect::<Vec<_>>())
    }
}

fn word(bytes: &[u8], at: usize) -> [u8; 8] {
    bytes.get(8 * at..).and_then(<[u8]>::first_chunk).copied().unwrap_or_default()
}

impl Transport for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.network.size
    }

    fn reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()> {
        let shared = self.share_words(values.iter().map(|value| value.to_le_bytes()));
        for (at, value) in values.iter_mut().enumerate() {
            let all = shared.iter().map(|bytes| u64::from_le_bytes(word(bytes, at)));
            *value = all.reduce(|a, b| operation.of_integers(a, b)).unwrap_or(*value);
        }
        Ok(())
    }

    fn reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()> {
        let shared = self.share_words(values.iter().map(|value| value.to_le_bytes()));
        for (at, value) in values.iter_mut().enumerate() {
            let all = shared.iter().map(|bytes| f64::from_le_bytes(word(bytes, at)));
            *value = all.reduce(|a, b| operation.of_numbers(a, b)).unwrap_or(*value);
        }
        Ok(())
    }

    fn broadcast(&self, root: usize, bytes: &mut [u8]) -> Result<()> {
        bytes.copy_from_slice(&self.share(bytes)[root]);
        Ok(())
    }

    fn gather_integers(&self, value: u64, values: &mut [u64]) -> Result<()> {
        for (value, bytes) in values.iter_mut().zip(self.share(&value.to_le_bytes())) {
            *value = u64::from_le_bytes(word(&bytes, 0));
        }
        Ok(())
    }

    fn exchange_integers(&self, values: &[u64], received: &mut [u64]) -> Result<()> {
        let messages = values.iter().map(|value| value.to_le_bytes().to_vec()).collect();
        for (value, bytes) in received.iter_mut().zip(self.exchange_all(messages)) {
            *value = u64::from_le_bytes(word(&bytes, 0));
        }
        Ok(())
    }

    fn gather(&self, bytes: &[u8], gathered: &mut [Vec<u8>]) -> Result<()> {
        gathered.iter_mut().zip(self.share(bytes)).for_each(|(to, from)| *to = from);
        Ok(())
    }

    fn exchange(&self, messages: &[Vec<u8>], received: &mut [Vec<u8>]) -> Result<()> {
        let all = self.exchange_all(messages.to_vec());
        received.iter_mut().zip(all).for_each(|(to, from)| *to = from);
        Ok(())
    }

    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<bool> {
        if to >= self.network.size {
            return Err(Error::invalid("there is no such rank to send to"));
        }
        let message = copied(bytes)?;
        let mut state = self.network.lock();
        state.messages.entry((self.rank, to, tag)).or_default().push_back(message);
        self.network.changed.notify_all();
        Ok(!state.is_failing)
    }

    fn receive(&self, from: usize, tag: u16) -> Result<Option<Vec<u8>>> {
        let mut state = self.network.lock();
        loop {
            let queue = state.messages.get_mut(&(from, self.rank, tag));
            if let Some(message) = queue.and_then(VecDeque::pop_front) {
                return Ok(Some(message));
            }
            if state.is_failing {
                return Ok(None);
            }
            state = self.network.wait(state);
        }
    }

    fn notify(&self) {
        self.network.lock().is_failing = true;
        self.network.changed.notify_all();
    }
}
