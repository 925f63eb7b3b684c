//! Findings of the certificate: the first violation in words, and counts that all ranks have.

use crate::comm::Communicator;
use crate::distributed::NO_ID;
use crate::words::{Words, append};
use netmesh::validate::ViolationKind;
use netmesh::{Error, ErrorKind, Result};

/// Bytes of a message that fit the C ABI's `char[160]` with its NUL.
const MESSAGE_BYTES: usize = 159;

/// One broken rule, with the ids in the whole mesh that it concerns ([`NO_ID`] where none).
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    pub kind: ViolationKind,
    /// The rank whose part of the mesh breaks it.
    pub rank: usize,
    pub simplex: u64,
    pub vertex: u64,
    /// One sentence that names the rule and the values, at most 159 bytes.
    pub message: String,
}

impl Violation {
    pub fn new(kind: ViolationKind, rank: usize, mut message: String) -> Self {
        let mut end = message.len().min(MESSAGE_BYTES);
        while !message.is_char_boundary(end) {
            end -= 1;
        }
        message.truncate(end);
        Self { kind, rank, simplex: NO_ID, vertex: NO_ID, message }
    }

    pub fn simplex(self, simplex: u64) -> Self {
        Self { simplex, ..self }
    }

    pub fn vertex(self, vertex: u64) -> Self {
        Self { vertex, ..self }
    }
}

/// Findings of the certificate, equal on all ranks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The highest level that holds in full, with all below it; 0 if level 1 does not. Never above
    /// the level that was asked for.
    pub level: u32,
    /// Violations that all ranks have found. Checks that would stand on a broken array are not
    /// made.
    pub violations: u64,
    /// Number of single checks made on all ranks.
    pub checked: u64,
    /// First violation of the lowest level that does not hold, on the lowest rank that found one.
    pub first: Option<Violation>,
}

/// Counts checks of a rank and keeps the first violation. Messages are made for that one only.
#[derive(Default)]
pub struct Findings {
    violations: u64,
    checked: u64,
    first: Option<Violation>,
}

impl Findings {
    /// Records one check; returns whether it held.
    pub fn check(&mut self, holds: bool, violation: impl FnOnce() -> Violation) -> bool {
        self.checked += 1;
        if !holds {
            self.violations += 1;
            if self.first.is_none() {
                self.first = Some(violation());
            }
        }
        holds
    }

    /// Returns true if everything so far held on this rank.
    pub fn is_clean(&self) -> bool {
        self.violations == 0
    }

    /// Collective. Returns true if everything so far held on all ranks.
    pub fn clean_everywhere(&self, comm: &dyn Communicator) -> Result<bool> {
        Ok(comm.exclusive_sum(self.violations)?.1 == 0)
    }

    /// Collective. Returns what all ranks have found, as if one had.
    pub fn of_all(self, comm: &dyn Communicator) -> Result<Self> {
        let mut message = Vec::new();
        append(&mut message, &[self.violations, self.checked])?;
        if let Some(first) = &self.first {
            let place = [first.kind as u64, first.rank as u64, first.simplex, first.vertex];
            append(&mut message, &place)?;
            message.extend_from_slice(first.message.as_bytes());
        }
        let mut all = Self::default();
        for message in comm.all_gather(&message)? {
            let (words, text) = message.split_at(message.len().min(6 * 8));
            let mut words = Words::new(words);
            all.violations += words.next()?;
            all.checked += words.next()?;
            if !words.is_empty() && all.first.is_none() {
                let value = words.next()?;
                let kind = ViolationKind::ALL.into_iter().find(|kind| *kind as u64 == value);
                let unknown = || Error::new(ErrorKind::Panic, "a kind of violations is unknown");
                let kind = kind.ok_or_else(unknown)?;
                let rank = words.next()? as usize;
                let violation =
                    Violation::new(kind, rank, String::from_utf8_lossy(text).into_owned());
                all.first = Some(violation.simplex(words.next()?).vertex(words.next()?));
            }
        }
        Ok(all)
    }

    /// Adds a level to a report; all levels below it hold.
    pub fn enter(self, report: &mut Report) -> bool {
        let holds = self.is_clean();
        report.violations += self.violations;
        report.checked += self.checked;
        report.first = report.first.take().or(self.first);
        holds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::threads;

    #[test]
    fn ranks_agree_on_the_first_violation() {
        let reports = threads::run(4, |comm| {
            let mut findings = Findings::default();
            findings.check(true, || unreachable!());
            findings.check(comm.rank() % 2 == 0, || {
                let message = format!("rank {} {}", comm.rank(), "é".repeat(100));
                Violation::new(ViolationKind::Ghost, comm.rank(), message).simplex(7)
            });
            assert!(!findings.clean_everywhere(comm).unwrap());
            let mut report = Report::default();
            assert!(!findings.of_all(comm).unwrap().enter(&mut report));
            report
        });
        for report in &reports {
            assert_eq!((report.level, report.violations, report.checked), (0, 2, 8));
            let first = report.first.as_ref().unwrap();
            assert_eq!((first.kind, first.rank, first.simplex), (ViolationKind::Ghost, 1, 7));
            assert_eq!((first.vertex, first.message.len()), (NO_ID, 159));
            assert!(first.message.starts_with("rank 1 é"));
        }
    }
}
