//! Two questions about segments: do they form closed curves, so that they alone determine what they
//! enclose, and do they enclose anything.

use crate::error::{Choice, Error, ErrorKind, Result, say};
use crate::memory::{Sets, filled};
use crate::mesh::{Arrangement, Inputs, Segments};
use crate::options::Interior;

/// Fails unless the segments form closed curves. For parity every input must be an end of an even
/// number of segments; for winding, the first end of as many segments as it is the second end.
/// Equal inputs count as one. O(inputs + segments).
///
/// # Errors
/// `InvalidArgument` (an input where curves do not close), `OutOfMemory`.
pub fn check_closed(inputs: &Inputs, segments: &Segments, interior: Interior) -> Result<()> {
    match first_open(inputs, segments, interior)? {
        Some((vertex, counts)) => Err(open_at(inputs, vertex, counts, interior)),
        None => Ok(()),
    }
}

/// Returns true if the rule `interior` puts a region that the segments bound inside. `arrangement`
/// is the arrangement of the segments. Open curves enclose nothing under a rule that asks for
/// closed ones. O((inputs + segments) log inputs).
///
/// # Errors
/// `OutOfMemory`.
pub fn encloses(
    inputs: &Inputs,
    segments: &Segments,
    arrangement: &Arrangement,
    interior: Interior,
) -> Result<bool> {
    if first_open(inputs, segments, interior)?.is_some() {
        return Ok(false);
    }
    // The regions on the two sides of a piece differ by its balance, so that one of them is inside
    // where the balance counts.
    let mut balances = arrangement.subsegments.iter().map(|piece| piece.balance);
    match interior {
        Interior::Auto | Interior::Seeds => has_cycle(inputs.distinct(), arrangement),
        Interior::Parity => Ok(balances.any(|balance| balance % 2 != 0)),
        Interior::Winding => Ok(balances.any(|balance| balance != 0)),
    }
}

/// Returns true if the pieces of the arrangement contain a cycle. Since pieces meet only at their
/// ends, a cycle of them is the only thing that can divide the plane.
fn has_cycle(distinct_inputs: usize, arrangement: &Arrangement) -> Result<bool> {
    let vertices = distinct_inputs + arrangement.crossings.len();
    let mut connected = Sets::new(vertices)?;
    for piece in &arrangement.subsegments {
        let [first, second] = piece.ends.map(|end| connected.find(end as usize));
        if first == second {
            return Ok(true);
        }
        connected.join(first, second);
    }
    Ok(false)
}

/// Returns the first vertex at which a curve is open, with the numbers of segments that begin and
/// that end there. [`Interior::Seeds`] does not need closed curves.
fn first_open(
    inputs: &Inputs,
    segments: &Segments,
    interior: Interior,
) -> Result<Option<(usize, [u32; 2])>> {
    if matches!(interior, Interior::Auto | Interior::Seeds) {
        return Ok(None);
    }
    // Vertex -> of how many segments it is the first end, and of how many the second.
    let mut counts = filled(inputs.distinct(), [0u32; 2])?;
    for (_, ends) in segments.inputs.iter().enumerate().filter(|&(at, _)| segments.encloses(at)) {
        for (which, &end) in ends.iter().enumerate() {
            counts[inputs.vertices()[end as usize] as usize][which] += 1;
        }
    }
    let is_open = |&[starts, ends]: &[u32; 2]| match interior {
        Interior::Parity => starts % 2 != ends % 2,
        _ => starts != ends,
    };
    Ok(counts.iter().position(is_open).map(|vertex| (vertex, counts[vertex])))
}

fn open_at(inputs: &Inputs, vertex: usize, [starts, ends]: [u32; 2], interior: Interior) -> Error {
    let input = inputs.first_input(vertex).unwrap_or(0);
    let all = u64::from(starts) + u64::from(ends);
    let rule = Choice::Interior(interior);
    let message = match interior {
        Interior::Parity => say!(
            "input {input} is an end of {all} segments; with ",
            rule,
            " that number must be even at every input, so that all curves are closed"
        ),
        _ => say!(
            "input {input} is the first end of {starts} segments and the second end of \
             {ends}; with ",
            rule,
            " these must be equally many at every input, so that all curves are closed"
        ),
    };
    Error::new(ErrorKind::InvalidArgument, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrangement::{SharedVertices, Task, arrange};
    use crate::options::Crossings;

    /// Checks segments between the corners of a square, of which inputs 0 and 4 are equal.
    fn check(segments: &[[u32; 2]], interior: Interior) -> Result<()> {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-0.0, 0.0]];
        let inputs = Inputs::new(2, 5, points.as_flattened(), 0).unwrap();
        let (inputs_of, markers) = (segments.to_vec(), vec![0; segments.len()]);
        let segments = Segments { inputs: inputs_of, markers, ..Segments::default() };
        check_closed(&inputs, &segments, interior)
    }

    fn refusal(segments: &[[u32; 2]], interior: Interior) -> String {
        let error = check(segments, interior).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        error.message().to_owned()
    }

    #[test]
    fn curves_that_close_pass() {
        let ring = [[0, 1], [1, 2], [2, 3], [3, 4]];
        let mixed = [[1, 0], [1, 2], [3, 2], [3, 4]];
        for interior in [Interior::Seeds, Interior::Parity, Interior::Winding] {
            check(&ring, interior).unwrap();
            check(&[ring, ring].concat(), interior).unwrap();
            check(&[[0, 1], [1, 0]], interior).unwrap();
            assert_eq!(check(&mixed, interior).is_ok(), interior != Interior::Winding);
            assert_eq!(check(&[[0, 1], [4, 1]], interior).is_ok(), interior != Interior::Winding);
            assert_eq!(check(&ring[..3], interior).is_ok(), interior == Interior::Seeds);
        }
    }

    /// Returns true if segments between the corners of a square and a point to the right of it
    /// enclose something. Inputs 0 and 4 are equal.
    fn is_enclosing(segments: &[[u32; 2]], interior: Interior) -> bool {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-0.0, 0.0], [3.0, 0.0]];
        let inputs = Inputs::new(2, 6, points.as_flattened(), 0).unwrap();
        let (ends, markers) = (segments.to_vec(), vec![0; segments.len()]);
        let segments = Segments { inputs: ends, markers, ..Segments::default() };
        let (own, crossings) = (segments.count(), Crossings::Split);
        let task = Task {
            inputs: &inputs,
            segments: &segments,
            own,
            shared: &SharedVertices::default(),
            crossings,
        };
        let arrangement = arrange(&task, &mut |_| Ok(())).unwrap();
        encloses(&inputs, &segments, &arrangement, interior).unwrap()
    }

    #[test]
    fn what_encloses_something_depends_on_the_rule() {
        let ring = [[0, 1], [1, 2], [2, 3], [3, 4]];
        let turned = ring.map(|[from, to]| [to, from]);
        type Case = (&'static str, Vec<[u32; 2]>, [bool; 3]);
        let cases: [Case; 8] = [
            ("a ring", ring.to_vec(), [true; 3]),
            (
                "a ring of no one direction",
                vec![[1, 0], [1, 2], [3, 2], [3, 4]],
                [true, true, false],
            ),
            ("three sides", ring[..3].to_vec(), [false; 3]),
            ("a ring with a tail", [&ring[..], &[[1, 5]]].concat(), [true, false, false]),
            ("a ring twice", [ring, ring].concat(), [true, false, true]),
            ("a ring and back", [ring, turned].concat(), [true, false, false]),
            ("there and back", vec![[0, 1], [1, 4]], [false; 3]),
            (
                "curves that cross and close there",
                vec![[0, 2], [1, 3], [0, 1]],
                [true, false, false],
            ),
        ];
        for (name, segments, expected) in cases {
            let rules = [Interior::Seeds, Interior::Parity, Interior::Winding];
            assert_eq!(rules.map(|rule| is_enclosing(&segments, rule)), expected, "{name}");
        }
    }

    #[test]
    fn the_input_where_a_curve_is_open_is_named() {
        let parity = "input 0 is an end of 1 segments; with options.interior = \
                      Interior::Parity that number must be even at every input, so that all \
                      curves are closed";
        assert_eq!(refusal(&[[0, 1], [1, 2], [2, 3]], Interior::Parity), parity);
        let winding = "input 1 is the first end of 0 segments and the second end of 2; with \
                       options.interior = Interior::Winding these must be equally many at every \
                       input, so that all curves are closed";
        let turned = [[0, 1], [2, 1], [2, 3], [3, 4]];
        assert_eq!(refusal(&turned, Interior::Winding), winding);
    }
}
