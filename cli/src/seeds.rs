//! What messages call the seeds of regions: a file has holes, and regions with labels, each counted
//! from 1 in the file's order.

use netmesh::{Error, Region};

/// Returns the error with seeds named as a file's reader knows them.
pub fn named(error: &Error, regions: &[Region]) -> Error {
    let mut parts = error.message().split("regions[");
    let mut message = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let seed = part.split_once("].seed").and_then(|(at, rest)| Some((at.parse().ok()?, rest)));
        message += &match seed {
            Some((at, rest)) => format!("the seed of {}{rest}", name(at, regions)),
            None => format!("regions[{part}"),
        };
    }
    Error::new(error.kind(), message)
}

fn name(at: usize, regions: &[Region]) -> String {
    let is_hole = regions.get(at).is_some_and(|region| region.is_hole);
    let number = regions.iter().take(at + 1).filter(|region| region.is_hole == is_hole).count();
    format!("{} {number}", if is_hole { "hole" } else { "region" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use netmesh::ErrorKind;

    #[test]
    fn seeds_are_counted_as_in_the_file() {
        let hole = Region { is_hole: true, ..Region::default() };
        let regions = [hole, hole, Region::default()];
        let text = |message: &str| {
            let error = Error::new(ErrorKind::InvalidArgument, message.to_owned());
            named(&error, &regions).message().to_owned()
        };
        let same = text("regions[2].seed is in the same region as regions[1].seed; no segment");
        assert_eq!(
            same,
            "the seed of region 1 is in the same region as the seed of hole 2; no segment"
        );
        for other in ["regions[2].max_edge is -1", "options.min_angle is 90"] {
            assert_eq!(text(other), other);
        }
    }
}
