//! Whether segments are closed curves, so that what they enclose is told by them alone.

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::filled;
use crate::mesh::{Inputs, Segments};
use crate::options::Interior;

/// Fails unless every input is an end of an even number of segments (parity), or the first end of
/// as many as it is the second (winding). Inputs that are equal are one. O(inputs + segments).
///
/// # Errors
/// `InvalidArgument` (an input where curves do not close), `OutOfMemory`.
pub fn check_closed(inputs: &Inputs, segments: &Segments, interior: Interior) -> Result<()> {
    if matches!(interior, Interior::Auto | Interior::Seeds) {
        return Ok(());
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
    match counts.iter().position(is_open) {
        Some(vertex) => Err(open_at(inputs, vertex, counts[vertex], interior)),
        None => Ok(()),
    }
}

fn open_at(inputs: &Inputs, vertex: usize, [starts, ends]: [u32; 2], interior: Interior) -> Error {
    let input = inputs.first_input(vertex).unwrap_or(0);
    let all = u64::from(starts) + u64::from(ends);
    let message = match interior {
        Interior::Parity => message!(
            "input {input} is an end of {all} segments; with options.interior parity that number \
             must be even at every input, so that all curves are closed"
        ),
        _ => message!(
            "input {input} is the first end of {starts} segments and the second end of {ends}; with \
             options.interior {} these must be equally many at every input, so that all curves are \
             closed",
            interior.word()
        ),
    };
    Error::new(ErrorKind::InvalidArgument, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Input 4 equals input 0.
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

    #[test]
    fn the_input_where_a_curve_is_open_is_named() {
        let parity = "input 0 is an end of 1 segments; with options.interior parity that number must \
                      be even at every input, so that all curves are closed";
        assert_eq!(refusal(&[[0, 1], [1, 2], [2, 3]], Interior::Parity), parity);
        let winding = "input 1 is the first end of 0 segments and the second end of 2; with \
                       options.interior winding these must be equally many at every input, so that \
                       all curves are closed";
        let turned = [[0, 1], [2, 1], [2, 3], [3, 4]];
        assert_eq!(refusal(&turned, Interior::Winding), winding);
    }
}
