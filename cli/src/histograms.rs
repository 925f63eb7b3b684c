//! Histograms of `--histogram`: the spread of angles, radius-edge ratios and aspects.

use crate::numbers::{counted, grouped, measure};
use netmesh::quality::{Histogram, Measure, histogram};
use netmesh::{Result, Triangulation};
use std::fmt::Write;

/// The number of marks in the longest bar.
const LONGEST_BAR: f64 = 40.0;

/// Bounds of radius-edge ratios; none is below 0.57.
const RATIOS: [f64; 18] = [
    0.5,
    0.6,
    0.7,
    0.8,
    0.9,
    1.0,
    1.1,
    1.2,
    1.4,
    1.6,
    1.8,
    2.0,
    2.5,
    3.0,
    4.0,
    6.0,
    10.0,
    f64::INFINITY,
];
const ASPECTS: [f64; 16] =
    [0.0, 1.0, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.5, 4.0, 5.0, 6.0, 10.0, f64::INFINITY];

pub struct Histograms {
    pub tables: Vec<Table>,
}

pub struct Table {
    /// Name of the histogram in the JSON record.
    pub name: &'static str,
    title: &'static str,
    pub edges: Vec<f64>,
    /// Numbers of values in each bin; of simplices those without a vertex on the hull.
    pub counts: Vec<u64>,
    /// Numbers of values of simplices with a vertex on the hull; `None` for cells, which only count
    /// off the hull.
    pub counts_at_hull: Option<Vec<u64>>,
    pub least: f64,
    pub largest: f64,
}

impl Histograms {
    pub fn of(triangulation: &Triangulation) -> Result<Self> {
        let (angles, smallest) = match triangulation.dim {
            2 => ("angles in degrees", "smallest angle of each simplex in degrees"),
            _ => {
                ("dihedral angles in degrees", "smallest dihedral angle of each simplex in degrees")
            }
        };
        let of = |name, title, measure, edges: &[f64]| {
            Table::of(triangulation, name, title, measure, edges)
        };
        let tables = vec![
            of("dihedral_angle", angles, Measure::DihedralAngle, &degrees())?,
            of("smallest_angle", smallest, Measure::SmallestAngle, &small_degrees())?,
            of("radius_edge", "radius-edge ratios", Measure::RadiusEdge, &RATIOS)?,
            of("aspect", "aspects of cells off the hull", Measure::Aspect, &ASPECTS)?,
        ];
        Ok(Self { tables })
    }

    pub fn text(&self) -> String {
        self.tables.iter().map(Table::text).collect()
    }
}

/// Returns the bounds of angles in degrees: tens from 0 to 180, and 5 and 175 at the ends.
fn degrees() -> Vec<f64> {
    let tens = (1..=17).map(|ten| f64::from(10 * ten));
    [0.0, 5.0].into_iter().chain(tens).chain([175.0, 180.0]).collect()
}

/// Returns the bounds of smallest angles, of which none is above 90 degrees.
fn small_degrees() -> Vec<f64> {
    (0..=18).map(|five| f64::from(5 * five)).collect()
}

impl Table {
    fn of(
        triangulation: &Triangulation,
        name: &'static str,
        title: &'static str,
        measure: Measure,
        edges: &[f64],
    ) -> Result<Self> {
        let Histogram { counts: off_hull, least, largest } =
            histogram(triangulation, measure, false, edges)?;
        let mut table = Self {
            name,
            title,
            edges: edges.to_vec(),
            counts: bins(&off_hull),
            counts_at_hull: None,
            least,
            largest,
        };
        if measure != Measure::Aspect {
            let all = histogram(triangulation, measure, true, edges)?;
            let at_hull = all.counts.iter().zip(&off_hull).map(|(all, off)| all - off);
            table.counts_at_hull = Some(bins(&at_hull.collect::<Vec<_>>()));
            (table.least, table.largest) = (all.least, all.largest);
        }
        Ok(table)
    }

    fn text(&self) -> String {
        let Some((first, last)) = self.occupied() else {
            return format!("\n{}: none\n", self.title);
        };
        let mut text = format!(
            "\n{}: {} from {} to {}\n",
            self.title,
            counted((first..=last).map(|bin| self.total(bin)).sum(), "value", "values"),
            measure(self.least),
            measure(self.largest),
        );
        if self.counts_at_hull.is_some() {
            let _ = writeln!(text, "{:>30}{:>14}", "off the hull", "at the hull");
        }
        let most = (first..=last).map(|bin| self.total(bin)).max().unwrap_or(0).max(1);
        for bin in first..=last {
            let at_hull = self
                .counts_at_hull
                .as_ref()
                .map_or(String::new(), |counts| format!("{:>14}", grouped(counts[bin])));
            let line = format!(
                "{:>6} to {:<8}{:>12}{at_hull}  {}",
                self.edges[bin],
                self.edges[bin + 1],
                grouped(self.counts[bin]),
                bar(self.total(bin), most),
            );
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text
    }

    fn total(&self, bin: usize) -> u64 {
        self.counts[bin] + self.counts_at_hull.as_ref().map_or(0, |counts| counts[bin])
    }

    /// Returns the first and the last bin that has values.
    fn occupied(&self) -> Option<(usize, usize)> {
        let mut bins = (0..self.counts.len()).filter(|&bin| self.total(bin) > 0);
        let first = bins.next()?;
        Some((first, bins.next_back().unwrap_or(first)))
    }
}

/// Returns the counts without those below the first edge and above the last: the tables' edges
/// leave nothing there.
fn bins(counts: &[u64]) -> Vec<u64> {
    counts[1..counts.len() - 1].to_vec()
}

/// Returns a bar as long as `count` is of `most`, with a mark at least for any count but 0.
fn bar(count: u64, most: u64) -> String {
    let marks = (LONGEST_BAR * count as f64 / most as f64).round() as usize;
    "#".repeat(if count > 0 { marks.max(1) } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_shows_its_occupied_bins() {
        let table = Table {
            name: "name",
            title: "angles",
            edges: vec![0.0, 5.0, 10.0, 20.0, 30.0, f64::INFINITY],
            counts: vec![0, 1000, 0, 1, 0],
            counts_at_hull: Some(vec![0, 1000, 0, 499, 0]),
            least: 5.5,
            largest: 29.0,
        };
        let expected = "\n\
            angles: 2 500 values from 5.500 to 29.00\n\
            \u{20}                 off the hull   at the hull\n\
            \u{20}    5 to 10             1 000         1 000  \
            ########################################\n\
            \u{20}   10 to 20                 0             0\n\
            \u{20}   20 to 30                 1           499  ##########\n";
        assert_eq!(table.text(), expected);
    }

    #[test]
    fn bars_show_what_is_there() {
        assert_eq!([bar(0, 9), bar(1, 1_000_000), bar(20, 40)], ["", "#", "####################"]);
    }

    #[test]
    fn an_empty_table_says_so() {
        let edges = vec![0.0, 1.0];
        let (least, largest) = (f64::INFINITY, f64::NEG_INFINITY);
        let (name, title) = ("name", "angles");
        let empty =
            Table { name, title, edges, counts: vec![0], counts_at_hull: None, least, largest };
        assert_eq!(empty.text(), "\nangles: none\n");
    }
}
