//! A sweep over pieces of segments (Shamos and Hoey, "Geometric intersection problems", 1976;
//! Bentley and Ottmann, 1979), which splits them exactly at the vertices on them, and finds their
//! crossings.
//!
//! Vertices and crossings come in their exact order, so that the order of the lines in the status
//! is exact. Two lines that cross are neighbours in it before their crossing, which is found then.

use super::poll::Poll;
use super::ranked::{Key, RankedVertices, key};
use super::status::{ABOVE, BELOW, Status};
use crate::error::{Choice, Error, ErrorKind, Name, Result, say};
use crate::memory::{AllocError, AllocResult, Lists, TryGrow, collected, filled};
use crate::mesh::{NONE, Subsegment};
use crate::numerics::{Lines, Sign, compare_crossings, compare_to_crossing, crossing, orientation};
use crate::options::Crossings;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Part of a line between two vertices, which are given by rank, the left end first.
#[derive(Clone, Copy)]
pub(super) struct LinePart {
    pub line: u32,
    pub ends: [u32; 2],
    pub segment: u32,
    /// Sum of the balances of the pieces that overlap here, counted from left to right.
    pub balance: i64,
}

/// Crossing of two lines, at rounded coordinates.
#[derive(Clone, Copy)]
pub(super) struct Found {
    pub lines: [u32; 2],
    /// True for each line whose right end is lower than its left one.
    pub falls: [bool; 2],
    pub point: [f64; 2],
}

/// Vertex that a line goes through because its coordinates are the doubles nearest to the line.
#[derive(Clone, Copy)]
pub(super) struct OnLine {
    pub line: u32,
    pub falls: bool,
    pub point: [f64; 2],
}

/// Rules for lines that cross.
#[derive(Clone, Copy)]
pub(super) struct Handling<'a> {
    /// Function that returns the point where two segments cross if they must not; `None` if they
    /// may.
    pub refuses: &'a dyn Fn([u32; 2]) -> Option<[f64; 2]>,
    /// Function that returns true if lines of these two segments snap: a line that passes an end of
    /// the other within a rounding goes through that end instead of a new vertex.
    pub snaps: &'a dyn Fn([u32; 2]) -> bool,
}

/// Result of a sweep: distinct parts without a vertex in their interior, and the crossings of the
/// parts.
#[derive(Default)]
pub(super) struct Swept {
    pub parts: Vec<LinePart>,
    pub found: Vec<Found>,
    pub snapped: Vec<OnLine>,
}

/// Line of pieces that overlap: from the last vertex that the sweep has met on them to their
/// farthest end.
#[derive(Clone, Copy)]
struct Line {
    from: u32,
    to: u32,
    /// Node of the line in the status, or [`NONE`].
    node: u32,
    /// Index of the bundle of the line's pieces, or [`NONE`] if it has one piece.
    bundle: u32,
    /// Sum of the balances of the pieces that have not ended, counted from left to right.
    balance: i64,
}

/// Pieces of a line, the smallest segment number first; some of them may have ended.
type Bundle = BinaryHeap<Reverse<(u32, u32)>>;

/// Exchange of two lines at their crossing. The leftmost one compares as the greatest, so that the
/// heap returns it first.
struct Swap {
    /// Key of the rounded crossing. Rounding may make two coordinates equal, but exchanges no two.
    key: Key,
    lower: u32,
    upper: u32,
    ends: [[[f64; 2]; 2]; 2],
}

impl Swap {
    fn lines(&self) -> Lines<'_> {
        self.ends.each_ref().map(|ends| ends.each_ref())
    }

    fn is_before(&self, vertex: &[f64; 2]) -> bool {
        let (lines, other) = (self.lines(), key(vertex));
        let exact = |axis: usize| compare_to_crossing(lines, axis, vertex[axis]);
        let axis = |axis: usize| self.key[axis].cmp(&other[axis]).then_with(|| exact(axis));
        axis(0).then_with(|| axis(1)).is_lt()
    }
}

impl Ord for Swap {
    fn cmp(&self, other: &Self) -> Ordering {
        if self.ends == other.ends {
            return Ordering::Equal;
        }
        let exact = |axis: usize| compare_crossings(self.lines(), other.lines(), axis);
        let axis = |axis: usize| self.key[axis].cmp(&other.key[axis]).then_with(|| exact(axis));
        axis(0).then_with(|| axis(1)).reverse()
    }
}

impl PartialOrd for Swap {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Swap {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Swap {}

struct Sweep<'a> {
    ranked: &'a RankedVertices,
    pieces: &'a [Subsegment],
    handling: Handling<'a>,
    /// Lines by number; a line has the number of the piece that it began with.
    lines: Vec<Line>,
    /// Piece -> the number of the line that it is on.
    line_of: Vec<u32>,
    has_ended: Vec<bool>,
    bundles: Vec<Bundle>,
    status: Status,
    swaps: BinaryHeap<Swap>,
    swept: Swept,
}

/// Position of a vertex in the status.
#[derive(Default)]
struct Around {
    /// Nodes of the lines through the vertex, from below to above.
    nodes: Vec<u32>,
    /// Nodes directly below and above these, or [`NONE`].
    sides: [u32; 2],
}

/// Number of polls' units of work for a vertex, an end of a piece or a crossing.
const WORK: u32 = 8;

/// Sweeps over pieces between the vertices of `ranked`, and returns their parts and crossings.
/// Expected O((n + k) log n) for k crossings.
///
/// # Errors
/// `InvalidArgument` (a crossing that `handling` refuses), `OutOfMemory`, and those of `poll`.
pub(super) fn sweep<'a>(
    ranked: &'a RankedVertices,
    pieces: &'a [Subsegment],
    handling: Handling<'a>,
    poll: Poll<'_>,
) -> Result<Swept> {
    let count = pieces.len();
    let line = |piece: &Subsegment| {
        let [a, b] = piece.ends.map(|end| ranked.ranks[end as usize]);
        let balance = balance_to_right(ranked, piece);
        Line { from: a.min(b), to: a.max(b), node: NONE, bundle: NONE, balance }
    };
    let lines = collected(pieces.iter().map(line))?;
    let vertices = ranked.points.len();
    let starts = || lines.iter().zip(0u32..).map(|(line, piece)| (line.from, piece));
    let ends = || lines.iter().zip(0u32..).map(|(line, piece)| (line.to, piece));
    let starts = Lists::of_pairs(vertices, starts)?;
    let ends = Lists::of_pairs(vertices, ends)?;
    let mut sweep = Sweep {
        ranked,
        pieces,
        handling,
        lines,
        line_of: collected(0..count as u32)?,
        has_ended: filled(count, false)?,
        bundles: Vec::new(),
        status: Status::new(),
        swaps: BinaryHeap::new(),
        swept: Swept::default(),
    };
    let (mut around, mut fan) = (Around::default(), Vec::new());
    for vertex in 0..vertices as u32 {
        sweep.swap_before(vertex, poll)?;
        let (starts, ends) = (starts.of(vertex as usize), ends.of(vertex as usize));
        poll(WORK * (1 + starts.len() + ends.len()) as u32)?;
        if !(starts.is_empty() && sweep.status.is_empty()) {
            sweep.find(vertex, ends, &mut around)?;
            sweep.end_parts(vertex, ends, &around)?;
            sweep.order_fan(vertex, starts, &around, &mut fan)?;
            if !(around.nodes.is_empty() && fan.is_empty()) {
                sweep.replace(&mut around, &fan)?;
                sweep.test_sides(&around)?;
            }
        }
    }
    Ok(sweep.swept)
}

/// Returns the balance of a piece as seen from its left end.
fn balance_to_right(ranked: &RankedVertices, piece: &Subsegment) -> i64 {
    let [from, to] = piece.ends.map(|end| ranked.ranks[end as usize]);
    if from < to { piece.balance } else { -piece.balance }
}

impl Sweep<'_> {
    /// Returns the side of a line that a vertex is on: positive above the line.
    #[inline]
    fn side(&self, line: u32, vertex: u32) -> Sign {
        let Line { from, to, .. } = self.lines[line as usize];
        orientation(&[from, to, vertex].map(|rank| self.ranked.point(rank)))
    }

    /// Returns how two lines through a vertex lie to the right of it: positive if the second is
    /// above.
    fn turn(&self, vertex: u32, first: u32, second: u32) -> Sign {
        let [first, second] = [first, second].map(|line| self.lines[line as usize].to);
        orientation(&[vertex, first, second].map(|rank| self.ranked.point(rank)))
    }

    fn is_on(&self, line: u32, vertex: u32) -> bool {
        let Line { from, to, .. } = self.lines[line as usize];
        if !(from < vertex && vertex < to) {
            return vertex == to;
        }
        let [a, b, y] = [from, to, vertex].map(|rank| self.ranked.point(rank)[1]);
        a.min(b) <= y && y <= a.max(b) && self.side(line, vertex).is_zero()
    }

    /// Finds the position of a vertex in the status; the lines through it are neighbours there.
    fn find(&self, vertex: u32, ends: &[u32], around: &mut Around) -> AllocResult<()> {
        let status = &self.status;
        around.nodes.clear();
        let is_on = |node: u32| node != NONE && self.is_on(status.line(node), vertex);
        // The node of a line that ends here spares the search.
        let ending =
            ends.iter().map(|&piece| self.lines[self.line_of[piece as usize] as usize].node);
        let mut lowest = match ending.into_iter().find(|&node| is_on(node)) {
            Some(node) => node,
            None => status.lowest_not_below(|line| self.side(line, vertex).is_positive()),
        };
        let below = |node: u32| match node {
            NONE => status.extreme(ABOVE),
            _ => status.neighbor(node, BELOW),
        };
        while is_on(below(lowest)) {
            lowest = below(lowest);
        }
        around.sides[BELOW] = below(lowest);
        while is_on(lowest) {
            around.nodes.try_push(lowest)?;
            lowest = status.neighbor(lowest, ABOVE);
        }
        around.sides[ABOVE] = lowest;
        Ok(())
    }

    /// Ends, at a vertex, the parts of the lines through it.
    fn end_parts(&mut self, vertex: u32, ends: &[u32], around: &Around) -> AllocResult<()> {
        for &node in &around.nodes {
            self.end_part(self.status.line(node), vertex)?;
        }
        for &piece in ends {
            self.has_ended[piece as usize] = true;
            let line = &mut self.lines[self.line_of[piece as usize] as usize];
            line.balance -= balance_to_right(self.ranked, &self.pieces[piece as usize]);
        }
        Ok(())
    }

    fn end_part(&mut self, line: u32, vertex: u32) -> AllocResult<()> {
        let Line { from, balance, .. } = self.lines[line as usize];
        if let Some(segment) = self.segment(line) {
            self.swept.parts.try_push(LinePart { line, ends: [from, vertex], segment, balance })?;
        }
        self.lines[line as usize].from = vertex;
        Ok(())
    }

    /// Returns the first segment with a piece on the line that has not ended; `None` if all have.
    fn segment(&mut self, line: u32) -> Option<u32> {
        let Line { bundle, .. } = self.lines[line as usize];
        if bundle == NONE {
            let has_ended = self.has_ended[line as usize];
            return (!has_ended).then(|| self.pieces[line as usize].segment);
        }
        let bundle = &mut self.bundles[bundle as usize];
        while let Some(Reverse((segment, piece))) = bundle.peek() {
            if !self.has_ended[*piece as usize] {
                return Some(*segment);
            }
            bundle.pop();
        }
        None
    }

    /// Fills `fan` with the lines that leave a vertex to the right, from below to above.
    fn order_fan(
        &mut self,
        vertex: u32,
        starts: &[u32],
        around: &Around,
        fan: &mut Vec<u32>,
    ) -> AllocResult<()> {
        fan.clear();
        for &node in &around.nodes {
            let line = self.status.line(node);
            self.lines[line as usize].node = NONE;
            if self.segment(line).is_some() {
                fan.try_push(line)?;
            }
        }
        fan.try_extend(starts)?;
        if fan.len() < 2 {
            return Ok(());
        }
        let is_new = |line: u32| starts.binary_search(&line).is_ok();
        fan.sort_unstable_by(|&a, &b| match self.turn(vertex, a, b) {
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            // Those that go on come first, and take in those that start.
            Sign::Zero => (is_new(a), a).cmp(&(is_new(b), b)),
        });
        let mut kept = 1;
        for at in 1..fan.len() {
            let (line, last) = (fan[at], fan[kept - 1]);
            if is_new(line) && self.turn(vertex, last, line).is_zero() {
                self.join(last, line)?;
            } else {
                fan[kept] = line;
                kept += 1;
            }
        }
        fan.truncate(kept);
        Ok(())
    }

    /// Adds a piece to a line that it starts on and runs along.
    fn join(&mut self, line: u32, piece: u32) -> AllocResult<()> {
        let entry = |piece: u32| Reverse((self.pieces[piece as usize].segment, piece));
        let entries = [entry(line), entry(piece)];
        let Line { to: far, balance, .. } = self.lines[piece as usize];
        let line_data = &mut self.lines[line as usize];
        line_data.to = line_data.to.max(far);
        line_data.balance += balance;
        let is_first = line_data.bundle == NONE;
        if is_first {
            line_data.bundle = self.bundles.len() as u32;
            self.bundles.try_push(Bundle::new())?;
        }
        let bundle = &mut self.bundles[line_data.bundle as usize];
        bundle.try_reserve(2).map_err(AllocError::from)?;
        bundle.extend(&entries[usize::from(!is_first)..]);
        self.line_of[piece as usize] = line;
        Ok(())
    }

    /// Replaces, in the status, the lines that reach a vertex by those that leave it.
    fn replace(&mut self, around: &mut Around, fan: &[u32]) -> AllocResult<()> {
        let mut lower = around.sides[BELOW];
        for (at, &line) in fan.iter().enumerate() {
            lower = match around.nodes.get(at) {
                Some(&node) => {
                    self.status.set_line(node, line);
                    node
                }
                None => {
                    let node = self.status.insert_above(lower, line)?;
                    around.nodes.try_push(node)?;
                    node
                }
            };
            self.lines[line as usize].node = lower;
        }
        for &node in &around.nodes[fan.len()..] {
            self.status.remove(node)?;
        }
        around.nodes.truncate(fan.len());
        Ok(())
    }

    /// Tests lines that have become neighbours for crossings.
    fn test_sides(&mut self, around: &Around) -> Result<()> {
        let [below, above] = around.sides;
        match (around.nodes.first(), around.nodes.last()) {
            (Some(&lowest), Some(&highest)) => {
                self.test(below, lowest)?;
                self.test(highest, above)
            }
            _ => self.test(below, above),
        }
    }

    /// Records the crossing of two neighbours, if there is one to the right of the sweep that is no
    /// vertex.
    fn test(&mut self, lower: u32, upper: u32) -> Result<()> {
        if lower == NONE || upper == NONE {
            return Ok(());
        }
        let [lower, upper] = [lower, upper].map(|node| self.status.line(node));
        let [low, high] = [lower, upper].map(|line| self.lines[line as usize].to);
        let cross = match low.cmp(&high) {
            Ordering::Less => self.side(upper, low).is_positive(),
            Ordering::Equal => false,
            Ordering::Greater => self.side(lower, high).is_negative(),
        };
        if cross { self.record(lower, upper) } else { Ok(()) }
    }

    fn record(&mut self, lower: u32, upper: u32) -> Result<()> {
        let ends = [lower, upper].map(|line| {
            let Line { from, to, .. } = self.lines[line as usize];
            [from, to].map(|rank| *self.ranked.point(rank))
        });
        let swap = Swap { key: [0; 2], lower, upper, ends };
        // There is one: the lines are not parallel.
        let Some(point) = crossing(swap.lines()) else { return Ok(()) };
        if let Some(vertex) = self.ranked.find(&point) {
            // If it is the exact crossing, it splits both.
            if [lower, upper].iter().all(|&line| self.side(line, vertex).is_zero()) {
                return Ok(());
            }
        }
        self.check_crossing(lower, upper)?;
        let falls = ends.map(|[from, to]| to[1] < from[1]);
        let segments = [lower, upper].map(|line| self.pieces[line as usize].segment);
        let is_snapped = (self.handling.snaps)(segments)
            && (self.snap(lower, ends[0], ends[1])? | self.snap(upper, ends[1], ends[0])?);
        if !is_snapped {
            self.swept.found.try_push(Found { lines: [lower, upper], falls, point })?;
        }
        self.swaps.try_reserve(1).map_err(AllocError::from)?;
        self.swaps.push(Swap { key: key(&point), ..swap });
        Ok(())
    }

    /// Leads a line through each end of another line whose x or y is the double nearest to the line
    /// there. Returns false if there is none.
    fn snap(&mut self, line: u32, ends: [[f64; 2]; 2], others: [[f64; 2]; 2]) -> AllocResult<bool> {
        let mut is_snapped = false;
        for other in others {
            let is_near = (0..2).any(|axis| {
                // Of the line through the end along the axis.
                let mut far = other;
                far[axis] = if other[axis] == 0.0 { 1.0 } else { 0.0 };
                crossing([ends.each_ref(), [&other, &far]]) == Some(other)
            });
            let is_within = (0..2).all(|k| {
                ends[0][k].min(ends[1][k]) <= other[k] && other[k] <= ends[0][k].max(ends[1][k])
            });
            if is_near && is_within {
                let falls = ends[1][1] < ends[0][1];
                self.swept.snapped.try_push(OnLine { line, falls, point: other })?;
                is_snapped = true;
            }
        }
        Ok(is_snapped)
    }

    /// Fails if the first segments on two crossing lines must not cross.
    fn check_crossing(&self, lower: u32, upper: u32) -> Result<()> {
        // The first of those that overlap and reach the other line.
        let reaches = |piece: usize, other: u32, side: Sign| {
            let ends = self.pieces[piece].ends.map(|end| self.ranked.ranks[end as usize]);
            self.side(other, ends[0].max(ends[1])) == side
        };
        let first = |line: u32, other: u32, side: Sign| {
            let on_line = |&piece: &usize| self.line_of[piece] == line && !self.has_ended[piece];
            let pieces = (0..self.pieces.len()).filter(on_line);
            let pieces = pieces.filter(|&piece| reaches(piece, other, side));
            pieces.map(|piece| self.pieces[piece].segment).min().unwrap_or(NONE)
        };
        let mut segments =
            [first(lower, upper, Sign::Positive), first(upper, lower, Sign::Negative)];
        segments.sort_unstable();
        let Some([x, y]) = (self.handling.refuses)(segments) else { return Ok(()) };
        let [first, second] = segments.map(|segment| Name::Segment(segment as usize));
        let message = say!(
            first,
            " and ",
            second,
            " cross near ({x:?}, {y:?}), where no input \
             is; with ",
            Choice::Crossings(Crossings::Split),
            " they are split there"
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }

    /// Exchanges, in the status, the lines that cross before a vertex.
    fn swap_before(&mut self, vertex: u32, poll: Poll<'_>) -> Result<()> {
        let ranked = self.ranked;
        while self.swaps.peek().is_some_and(|swap| swap.is_before(ranked.point(vertex))) {
            poll(WORK)?;
            let Some(Swap { lower, upper, .. }) = self.swaps.pop() else { break };
            let [below, above] = [lower, upper].map(|line| self.lines[line as usize].node);
            // They have, or others cross at the same place, and they are tested again.
            if self.status.neighbor(below, ABOVE) != above {
                continue;
            }
            for (node, line) in [(below, upper), (above, lower)] {
                self.status.set_line(node, line);
                self.lines[line as usize].node = node;
            }
            self.test(self.status.neighbor(below, BELOW), below)?;
            self.test(above, self.status.neighbor(above, ABOVE))?;
        }
        Ok(())
    }
}
