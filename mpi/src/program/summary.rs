//! Summary that rank 0 prints at the end.

use crate::arguments::Arguments;
use netmesh::Result;
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::Report;
use netmesh_mpi::comm::{Communicator, Operation};
use std::io::Write;
use std::time::Duration;

#[derive(Default)]
pub struct Times {
    pub read: Duration,
    pub mesh: Duration,
    pub write: Option<Duration>,
    pub validate: Option<Duration>,
}

/// Prints the summary on rank 0. Collective.
pub fn print(
    comm: &dyn Communicator,
    arguments: &Arguments,
    mesh: &DistributedMesh,
    report: Option<&Report>,
    times: &Times,
) -> Result<()> {
    let own = [mesh.simplex_count() as u64, mesh.ghosts.len() as u64, mesh.bytes_sent];
    let (mut most, mut sum) = (own, own);
    comm.all_reduce_integers(&mut most, Operation::Max)?;
    comm.all_reduce_integers(&mut sum, Operation::Sum)?;
    let alone = mesh.work.iter().filter(|work| work.step.is_alone());
    let own: f64 = alone.map(|work| work.seconds).sum();
    let (mut slowest, mut all) = ([own], [own]);
    comm.all_reduce_numbers(&mut slowest, Operation::Max)?;
    comm.all_reduce_numbers(&mut all, Operation::Sum)?;
    if comm.rank() != 0 {
        return Ok(());
    }
    let [simplices, ghosts, bytes] = most.map(spaced);
    let totals = &mesh.totals;
    let counts =
        [totals.inputs, totals.duplicates, totals.vertices, totals.simplices, totals.domains];
    let [inputs, duplicates, vertices, all_simplices, domains] = counts.map(spaced);
    let (pieces, sent, seed) =
        (spaced(totals.pieces), spaced(sum[2]), arguments.meshing.options.seed);
    let task = if mesh.promise.is_finished { "finished mesh" } else { "hierarchical mesh" };
    let (dim, ranks) = (mesh.dim, mesh.ranks);
    let milliseconds = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
    let mut text = format!(
        "input       {}: {inputs} points in {dim}D, {duplicates} duplicates\n\
         task        {task} on {ranks} ranks, seed {seed}\n\
         mesh        {vertices} vertices\n            \
         {all_simplices} simplices, {domains} domains, {pieces} pieces\n\
         ranks       {simplices} simplices and {ghosts} ghosts at most\n            \
         sent {sent} bytes, {bytes} by one at most\n\
         work        {} for partitions by one rank at most, {} by each on average\n\
         time        mesh {}, read {}",
        arguments.input.display(),
        milliseconds(Duration::from_secs_f64(slowest[0])),
        milliseconds(Duration::from_secs_f64(all[0] / ranks as f64)),
        milliseconds(times.mesh),
        milliseconds(times.read),
    );
    if let Some(time) = times.write {
        text += &format!(", write {}", milliseconds(time));
    }
    if let Some(time) = times.validate {
        text += &format!(", certificate {}", milliseconds(time));
    }
    if let (Some(_), Some(path)) = (times.write, &arguments.output) {
        text += &format!("\nwritten     {}", path.display());
    }
    if let Some(report) = report {
        let (level, checks) = (report.level, spaced(report.checked));
        text += &match report.violations {
            0 => format!("\ncertificate holds at level {level}: {checks} checks, no violation"),
            found => {
                format!("\ncertificate violated: {} violations in {checks} checks", spaced(found))
            }
        };
    }
    // Who reads this may have gone.
    let _ = writeln!(std::io::stdout(), "{text}");
    Ok(())
}

/// Returns the digits of a number in groups of three.
fn spaced(number: u64) -> String {
    let digits = number.to_string();
    let group = |(at, digit): (usize, char)| {
        let space = at > 0 && (digits.len() - at) % 3 == 0;
        space.then_some(' ').into_iter().chain([digit])
    };
    digits.chars().enumerate().flat_map(group).collect()
}

#[cfg(test)]
mod tests {
    use super::spaced;

    #[test]
    fn digits_stand_in_groups() {
        assert_eq!([0, 999, 1000, 1234567].map(spaced), ["0", "999", "1 000", "1 234 567"]);
    }
}
