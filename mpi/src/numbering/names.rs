//! Numbers of names: each is that of the names below it on all ranks.

use crate::comm::Communicator;
use crate::words::{bytes_of, empty_messages, words_of};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, collected, with_capacity};

/// Number of its names that a rank tells all for the choice of ranges.
const SAMPLES: usize = 64;

/// Collective. Returns the numbers of rising names without repetition, and how many names there are
/// on all ranks. A name of several ranks has one number.
///
/// Each rank counts the names of a range. The ranges are chosen by samples, so that they are about
/// equally full; a rank whose names are next to each other sends few of them elsewhere.
pub fn number(comm: &dyn Communicator, names: &[u64]) -> Result<(Vec<u64>, u64)> {
    debug_assert!(names.is_sorted());
    let bounds = bounds(comm, names)?;
    let mut start = 0;
    let mut questions = with_capacity(comm.size())?;
    for bound in bounds.iter().map(Some).chain([None]) {
        let end = bound.map_or(names.len(), |bound| names.partition_point(|name| name < bound));
        questions.push(bytes_of(&names[start..end])?);
        start = end;
    }
    let questions = comm.all_to_all(questions)?;
    let mut all = with_capacity(questions.iter().map(|question| question.len() / 8).sum())?;
    questions.iter().for_each(|question| all.extend(words_of(question)));
    all.sort_unstable();
    all.dedup();
    let (first, count) = comm.exclusive_sum(all.len() as u64)?;
    let mut answers = empty_messages(comm.size())?;
    for (answer, question) in answers.iter_mut().zip(&questions) {
        let mut at = 0;
        *answer = with_capacity(question.len())?;
        for name in words_of(question) {
            at += all[at..].partition_point(|other| *other < name);
            answer.extend_from_slice(&(first + at as u64).to_le_bytes());
        }
    }
    drop(questions);
    let answers = comm.all_to_all(answers)?;
    Ok((collected(answers.iter().flat_map(|answer| words_of(answer)))?, count))
}

/// Returns where the ranges of the ranks but the first begin.
fn bounds(comm: &dyn Communicator, names: &[u64]) -> Result<Vec<u64>> {
    let samples = names.len().min(SAMPLES);
    let mut message = vec![names.len() as u64];
    message.extend((0..samples).map(|at| names[at * names.len() / samples]));
    let mut all = Vec::new();
    let mut total = 0.0;
    for message in comm.all_gather(&bytes_of(&message)?)? {
        let mut words = words_of(&message);
        let weight = words.next().unwrap_or(0) as f64;
        total += weight;
        let count = words.len() as f64;
        words.try_for_each(|name| all.try_push((name, weight / count)))?;
    }
    all.sort_unstable_by_key(|sample| sample.0);
    let mut before = 0.0;
    let mut bounds = with_capacity(comm.size() - 1)?;
    for (name, weight) in all {
        while bounds.len() + 1 < comm.size()
            && before >= total * (bounds.len() + 1) as f64 / comm.size() as f64
        {
            bounds.push(name);
        }
        before += weight;
    }
    bounds.resize(comm.size() - 1, u64::MAX);
    Ok(bounds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::threads;

    /// Names of which ranks have some in common, in any distribution.
    #[test]
    fn numbers_are_those_of_all_names_in_order() {
        for ranks in [1, 2, 3, 5] {
            for spread in [1, 7, 1 << 40] {
                let names_of = |rank: usize| -> Vec<u64> {
                    let count = [200, 0, 3, 1000, 77][rank];
                    let mut names: Vec<u64> =
                        (0..count).map(|i| (i * i + rank as u64 % 2) * spread).collect();
                    names.sort_unstable();
                    names.dedup();
                    names
                };
                let mut all: Vec<u64> = (0..ranks).flat_map(names_of).collect();
                all.sort_unstable();
                all.dedup();
                let numbered =
                    threads::run(ranks, |comm| number(comm, &names_of(comm.rank())).unwrap());
                for (rank, (numbers, count)) in numbered.iter().enumerate() {
                    let found: Vec<u64> =
                        numbers.iter().map(|number| all[*number as usize]).collect();
                    assert_eq!((found, *count), (names_of(rank), all.len() as u64));
                }
            }
        }
    }
}
