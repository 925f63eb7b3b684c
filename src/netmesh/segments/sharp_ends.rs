//! The ends of lines at which they make a sharp angle with another.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::netmesh::questions::subsegments::SHARP;
use crate::netmesh::state::State;
use crate::netmesh::state::segments::chain::AtEnd;

impl State<2> {
    /// Marks the ends of lines at which they make a sharp angle with another.
    pub(super) fn find_sharp_ends(&mut self) -> AllocResult<()> {
        let (mut fan, mut sharp) = (Vec::new(), Vec::new());
        for lines in self.segments.chains.fans() {
            let ends = self.segments.chains.lines[lines[0].line as usize].ends;
            let center = if ends[0] == lines[0].other { ends[1] } else { ends[0] };
            fan.clear();
            if let [first, second] = lines {
                match self.is_sharp_between(center, [first.other, second.other]) {
                    Some(true) => {
                        sharp.try_extend(&[(center, first.line), (center, second.line)])?
                    }
                    Some(false) => {}
                    None => fan.try_extend(lines)?,
                }
            } else {
                fan.try_extend(lines)?;
            }
            self.find_sharp_in_fan(center, &fan, &mut sharp)?;
        }
        let lines = &mut self.segments.chains.lines;
        for (end, line) in sharp {
            let line = &mut lines[line as usize];
            line.is_sharp[usize::from(line.ends[0] != end)] = true;
        }
        Ok(())
    }

    /// Adds to `sharp` the lines of a fan that make sharp angles with the next ones.
    fn find_sharp_in_fan(
        &self,
        center: VertexId,
        lines: &[AtEnd],
        sharp: &mut Vec<(VertexId, u32)>,
    ) -> AllocResult<()> {
        let mut fan = collected(
            lines.iter().map(|at_end| (self.direction(center, at_end.other), at_end.line)),
        )?;
        fan.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (at, &(direction, line)) in fan.iter().enumerate() {
            let (next, other) = fan[(at + 1) % fan.len()];
            let turn = (next - direction).rem_euclid(360.0);
            if turn < SHARP {
                sharp.try_extend(&[(center, line), (center, other)])?;
            }
        }
        Ok(())
    }
}
