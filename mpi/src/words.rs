//! Messages as 64-bit words, in the byte order of files: ranks may be of different machines.

use netmesh::distributed::memory::{TryGrow, collected, with_capacity};
use netmesh::{Error, ErrorKind, Result};

/// Appends `words` to `bytes`.
pub fn append(bytes: &mut Vec<u8>, words: &[u64]) -> Result<()> {
    Ok(words.iter().try_for_each(|word| bytes.try_extend(&word.to_le_bytes()))?)
}

/// Returns the bytes of `words`.
pub fn bytes_of(words: &[u64]) -> Result<Vec<u8>> {
    let mut bytes = with_capacity(8 * words.len())?;
    words.iter().for_each(|word| bytes.extend_from_slice(&word.to_le_bytes()));
    Ok(bytes)
}

/// Returns the words of a message.
pub fn words_of(bytes: &[u8]) -> impl ExactSizeIterator<Item = u64> + Clone + '_ {
    bytes.chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().unwrap_or_default()))
}

/// Returns the words of several messages, one after another.
pub fn all_words(messages: &[Vec<u8>]) -> Result<Vec<u64>> {
    let mut words = with_capacity(messages.iter().map(|message| message.len() / 8).sum())?;
    messages.iter().for_each(|message| words.extend(words_of(message)));
    Ok(words)
}

/// Returns the words in order, each once; [`u64::MAX`] is none.
pub fn distinct(words: impl IntoIterator<Item = u64>) -> Result<Vec<u64>> {
    let mut all = Vec::new();
    for word in words {
        // Neighbours have the same often.
        if word != u64::MAX && all.last() != Some(&word) {
            all.try_push(word)?;
        }
    }
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Returns a message for each rank, to be filled.
pub fn empty_messages(ranks: usize) -> Result<Vec<Vec<u8>>> {
    Ok(collected((0..ranks).map(|_| Vec::new()))?)
}

/// Returns a hash that chooses something by these words alone: mixed as by Steele, Lea and Flood,
/// "Fast splittable pseudorandom number generators", 2014.
pub fn hash(words: &[u64]) -> u64 {
    words.iter().fold(0, |hash, word| {
        let mixed = (hash ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    })
}

/// Takes a message apart.
pub struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// Returns the next word; a message that ends before it is a defect of the sender.
    pub fn next(&mut self) -> Result<u64> {
        let (word, rest) = self
            .rest
            .split_first_chunk::<8>()
            .ok_or_else(|| Error::new(ErrorKind::Panic, "internal error: a message is cut off"))?;
        self.rest = rest;
        Ok(u64::from_le_bytes(*word))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_survive_the_way_to_bytes_and_back() {
        let mut bytes = bytes_of(&[1, u64::MAX]).unwrap();
        append(&mut bytes, &[7]).unwrap();
        assert!(words_of(&bytes).eq([1, u64::MAX, 7]));
        let mut words = Words::new(&bytes);
        assert_eq!(
            [words.next(), words.next(), words.next()].map(Result::unwrap),
            [1, u64::MAX, 7]
        );
        assert!(words.is_empty() && words.next().is_err());
    }
}
