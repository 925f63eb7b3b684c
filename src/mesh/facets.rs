//! Facets in space: polygons between inputs, and the triangles of a surface.

use super::Inputs;
use super::boundary::{check_dimension, check_markers, markers_or_zeros};
use crate::error::{Error, ErrorKind, Name, Result, message, say};
use crate::memory::{collected, copied};

/// Facets as the caller gave them. A facet has one or more loops of inputs; a point of its plane is
/// in it if a ray from there crosses its loops an odd number of times. A loop of two inputs is a
/// segment in the facet, a loop of one input a vertex in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Facets {
    /// Facet -> its first loop, then the number of loops. Empty without facets.
    pub loop_starts: Vec<u32>,
    /// Loop -> its first input among `inputs`, then the number of those. Empty without facets.
    pub input_starts: Vec<u32>,
    /// Inputs of the loops, in the caller's numbers.
    pub inputs: Vec<u32>,
    /// Number that the caller gave each facet.
    pub markers: Vec<i32>,
    /// True if the facets are the triangles of a surface. Those that share an edge, lie in one
    /// plane and have one marker are one facet of the mesh.
    pub are_triangles: bool,
}

impl Facets {
    /// Returns the number of facets.
    pub fn count(&self) -> usize {
        self.markers.len()
    }

    /// Returns the loops of a facet.
    pub fn loops(&self, facet: usize) -> impl Iterator<Item = &[u32]> + Clone {
        let [first, last] = [facet, facet + 1].map(|at| self.loop_starts[at] as usize);
        self.input_starts[first..=last]
            .windows(2)
            .map(|range| &self.inputs[range[0] as usize..range[1] as usize])
    }
}

/// Triangle of a facet: three vertices of an arrangement, counterclockwise where the normal of the
/// facet points to the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacetTriangle {
    /// Distinct inputs, or [`Inputs::distinct`] plus the index of a corner.
    pub vertices: [u32; 3],
    /// Number of the facet in [`super::Arrangement::facets`].
    pub facet: u32,
}

/// Facet of an arrangement: a polygon in a plane, or triangles of the caller's that lie in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ArrangedFacet {
    /// Facet of the caller's, the first of those that it is made of; [`NONE`](super::NONE) for a
    /// side of a hull or box.
    pub parent: u32,
    /// Number by which the winding number of what is behind the facet, where its normal does not
    /// point to, is larger than of what is before it.
    pub balance: i64,
}

/// Largest number of facets, of loops and of their inputs that 32-bit ids can tell apart.
const MAX_COUNT: usize = u32::MAX as usize - 1;

impl Facets {
    /// Makes facets of loops of inputs, where facet `i` has the loops `loop_starts[i]` to
    /// `loop_starts[i + 1]`, and loop `j` the elements `input_starts[j]` to `input_starts[j + 1]`
    /// of `members`. Without `markers` every facet has 0.
    pub(super) fn of_loops(
        inputs: &Inputs,
        [loop_starts, input_starts]: [&[u64]; 2],
        members: &[u32],
        markers: Option<&[i32]>,
    ) -> Result<Self> {
        check_dimension(inputs, "facets", 3..=3)?;
        let count = loop_starts.len().saturating_sub(1);
        check_capacity("facets", count)?;
        check_capacity("loops", input_starts.len().saturating_sub(1))?;
        check_capacity("inputs of loops", members.len())?;
        check_starts("loop_starts", loop_starts)?;
        check_starts("input_starts", input_starts)?;
        check_end("loop_starts", loop_starts, "loops", input_starts.len().saturating_sub(1))?;
        check_end("input_starts", input_starts, "inputs", members.len())?;
        check_markers(markers, "facets", count)?;
        if count == 0 {
            return Ok(Self::default());
        }
        let facets = Self {
            loop_starts: collected(loop_starts.iter().map(|&start| start as u32))?,
            input_starts: collected(input_starts.iter().map(|&start| start as u32))?,
            inputs: copied(members)?,
            markers: markers_or_zeros(markers, count)?,
            are_triangles: false,
        };
        (0..count).try_for_each(|facet| facets.check_loops(inputs, facet))?;
        Ok(facets)
    }

    /// Makes facets of triangles, three inputs for each; without `markers` every triangle has 0.
    pub(crate) fn of_triangles(
        inputs: &Inputs,
        corners: &[u32],
        markers: Option<&[i32]>,
    ) -> Result<Self> {
        check_dimension(inputs, "triangles", 3..=3)?;
        if corners.len() % 3 != 0 {
            return Err(Error::invalid(message!(
                "triangles has length {}; it must be a multiple of 3: three inputs a triangle",
                corners.len()
            )));
        }
        let count = corners.len() / 3;
        check_capacity("inputs of triangles", corners.len())?;
        check_markers(markers, "triangles", count)?;
        for (at, corners) in corners.chunks_exact(3).enumerate() {
            check_triangle(inputs, at, corners)?;
        }
        if count == 0 {
            return Ok(Self::default());
        }
        Ok(Self {
            loop_starts: collected(0..=count as u32)?,
            input_starts: collected((0..=count as u32).map(|triangle| 3 * triangle))?,
            inputs: copied(corners)?,
            markers: markers_or_zeros(markers, count)?,
            are_triangles: true,
        })
    }

    /// Returns these facets, and after them triangles.
    pub(crate) fn with_triangles(&self, triangles: &[[u32; 3]], markers: &[i32]) -> Result<Self> {
        check_capacity("facets", self.count() + triangles.len())?;
        check_capacity("inputs of loops", self.inputs.len() + 3 * triangles.len())?;
        let [loops, inputs] = [self.input_starts.len() - 1, self.inputs.len()];
        let starts = |first: usize, step: usize| {
            (1..=triangles.len()).map(move |at| (first + step * at) as u32)
        };
        let after = |own: &[u32], more: &mut dyn Iterator<Item = u32>| {
            collected(own.iter().copied().chain(more))
        };
        let corners = &mut triangles.as_flattened().iter().copied();
        Ok(Self {
            loop_starts: after(&self.loop_starts, &mut starts(loops, 1))?,
            input_starts: after(&self.input_starts, &mut starts(inputs, 3))?,
            inputs: after(&self.inputs, corners)?,
            markers: collected(self.markers.iter().chain(markers).copied())?,
            are_triangles: self.are_triangles,
        })
    }

    /// Fails if a loop of a facet has a number that is no input, or a point twice in a row, or if
    /// no loop is a polygon.
    fn check_loops(&self, inputs: &Inputs, facet: usize) -> Result<()> {
        let (name, count) = (Name::Facet(facet), inputs.count());
        let refuse = |message| Err(Error::invalid(message));
        for (number, members) in self.loops(facet).enumerate() {
            if let Some(bad) = members.iter().find(|&&input| input as usize >= inputs.count()) {
                return refuse(say!(
                    name,
                    " has the input {bad} in its loop {number}; it must be less than the number of \
                     inputs, {count}"
                ));
            }
            let next = members.iter().cycle().skip(1);
            let mut pairs = members.iter().zip(next).filter(|_| members.len() > 1);
            if let Some((from, to)) = pairs.find(|&(from, to)| are_equal(inputs, *from, *to)) {
                let [one, other] = [from, to].map(|&input| Name::Input(input as usize));
                let rule = "the length between must not be 0";
                return refuse(match from == to {
                    true => {
                        say!(
                            name,
                            " has input ",
                            one,
                            " twice in a row in its loop {number}; {rule}"
                        )
                    }
                    false => say!(
                        name,
                        " has the inputs ",
                        one,
                        " and ",
                        other,
                        " in a row in its loop {number}, which are the same point; {rule}"
                    ),
                });
            }
        }
        if self.loops(facet).all(|members| members.len() < 3) {
            let rule = "a facet must have one, and may have segments (two inputs) and vertices \
                        (one input) besides";
            return refuse(say!(name, " has no loop of three or more inputs; {rule}"));
        }
        Ok(())
    }
}

/// Fails unless `starts` rise from 0; an array without elements may be empty.
pub(crate) fn check_starts(name: &str, starts: &[u64]) -> Result<()> {
    let refuse = |message| Err(Error::invalid(message));
    match starts.first() {
        Some(0) | None => {}
        Some(first) => return refuse(message!("{name}[0] is {first}; it must be 0")),
    }
    match starts.windows(2).position(|pair| pair[0] >= pair[1]) {
        None => Ok(()),
        Some(at) => refuse(message!(
            "{name}[{}] is {} and {name}[{at}] is {}; starts must rise, since no list is empty",
            at + 1,
            starts[at + 1],
            starts[at]
        )),
    }
}

/// Fails unless the last of `starts` is the number of `elements` between them.
fn check_end(name: &str, starts: &[u64], elements: &str, count: usize) -> Result<()> {
    let last = starts.last().copied().unwrap_or(0);
    if last == count as u64 {
        return Ok(());
    }
    let message =
        message!("{name} ends with {last}; it must end with the number of {elements}, {count}");
    Err(Error::invalid(message))
}

fn check_capacity(elements: &str, count: usize) -> Result<()> {
    if count <= MAX_COUNT {
        return Ok(());
    }
    let message = message!("{count} {elements}; at most {MAX_COUNT} fit 32-bit ids");
    Err(Error::new(ErrorKind::Capacity, message))
}

fn check_triangle(inputs: &Inputs, at: usize, corners: &[u32]) -> Result<()> {
    let (triangle, count) = (Name::Triangle(at), inputs.count());
    if let Some(bad) = corners.iter().find(|&&input| input as usize >= count) {
        return Err(Error::invalid(say!(
            triangle,
            " has the input {bad}; it must be less than the number of inputs, {count}"
        )));
    }
    Ok(())
}

fn are_equal(inputs: &Inputs, from: u32, to: u32) -> bool {
    inputs.vertices()[from as usize] == inputs.vertices()[to as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// Returns a mesh of six inputs in space, of which the last is a duplicate of the first.
    fn mesh() -> Mesh {
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.5, 0.5, 1.0],
            [0.0, -0.0, 0.0],
        ];
        Mesh::new(3, 6, points.as_flattened(), 0).unwrap()
    }

    fn refusal(result: Result<()>) -> (ErrorKind, String) {
        let error = result.unwrap_err();
        (error.kind(), error.message().to_owned())
    }

    #[test]
    fn facets_are_kept_until_others_replace_them() {
        let mut mesh = mesh();
        assert_eq!(*mesh.given_facets(), Facets::default());
        let members = [0, 1, 2, 3, 0, 2, 1, 1, 2, 4];
        mesh.set_facets(&[0, 3, 4], &[0, 4, 6, 7, 10], &members, Some(&[-5, 8])).unwrap();
        let kept = mesh.given_facets().clone();
        assert_eq!((kept.count(), kept.are_triangles, &*kept.markers), (2, false, &[-5, 8][..]));
        let loops = |facet| kept.loops(facet).collect::<Vec<_>>();
        assert_eq!(loops(0), [&[0, 1, 2, 3][..], &[0, 2], &[1]]);
        assert_eq!(loops(1), [&[1, 2, 4]]);
        mesh.set_triangles(&[0, 1, 9], None).unwrap_err();
        assert_eq!(*mesh.given_facets(), kept);
        mesh.set_triangles(&[0, 1, 4, 1, 2, 4], None).unwrap();
        let kept = mesh.given_facets().clone();
        assert_eq!((kept.count(), kept.are_triangles, &*kept.markers), (2, true, &[0, 0][..]));
        let loops: Vec<_> = (0..2).flat_map(|facet| kept.loops(facet)).collect();
        assert_eq!(loops, [[0, 1, 4], [1, 2, 4]]);
        mesh.set_facets(&[], &[], &[], None).unwrap();
        assert_eq!(*mesh.given_facets(), Facets::default());
        mesh.set_triangles(&[0, 1, 4], None).unwrap();
        mesh.set_triangles(&[], Some(&[])).unwrap();
        assert_eq!(*mesh.given_facets(), Facets::default());
        mesh.set_facets(&[0], &[0], &[], None).unwrap();
    }

    #[test]
    fn facets_that_cannot_be_are_refused_by_name() {
        let bad = |loop_starts: &[u64], input_starts: &[u64], members: &[u32]| {
            let (kind, message) =
                refusal(mesh().set_facets(loop_starts, input_starts, members, None));
            assert_eq!(kind, ErrorKind::InvalidArgument);
            message
        };
        let first = "loop_starts[0] is 1; it must be 0";
        assert_eq!(bad(&[1, 2], &[0, 3], &[0, 1, 2]), first);
        let falls = "loop_starts[2] is 1 and loop_starts[1] is 1; starts must rise, since no list \
                     is empty";
        assert_eq!(bad(&[0, 1, 1], &[0, 3], &[0, 1, 2]), falls);
        let falls = "input_starts[2] is 2 and input_starts[1] is 3; starts must rise, since no \
                     list is empty";
        assert_eq!(bad(&[0, 2], &[0, 3, 2], &[0, 1, 2]), falls);
        let loops = "loop_starts ends with 2; it must end with the number of loops, 1";
        assert_eq!(bad(&[0, 2], &[0, 3], &[0, 1, 2]), loops);
        let inputs = "input_starts ends with 3; it must end with the number of inputs, 4";
        assert_eq!(bad(&[0, 1], &[0, 3], &[0, 1, 2, 3]), inputs);
        let loops = "loop_starts ends with 0; it must end with the number of loops, 1";
        assert_eq!(bad(&[], &[0, 3], &[0, 1, 2]), loops);
        let range = "facets[0] has the input 6 in its loop 1; it must be less than the number of \
                     inputs, 6";
        assert_eq!(bad(&[0, 2], &[0, 3, 5], &[0, 1, 2, 1, 6]), range);
        let twice = "facets[0] has input 2 twice in a row in its loop 0; the length between must \
                     not be 0";
        assert_eq!(bad(&[0, 1], &[0, 4], &[0, 1, 2, 2]), twice);
        assert_eq!(bad(&[0, 1], &[0, 4], &[2, 0, 1, 2]), twice);
        let same = "facets[1] has the inputs 5 and 0 in a row in its loop 0, which are the same \
                    point; the length between must not be 0";
        assert_eq!(bad(&[0, 1, 2], &[0, 3, 7], &[0, 1, 2, 0, 1, 4, 5]), same);
        let short = "facets[1] has no loop of three or more inputs; a facet must have one, and may \
                     have segments (two inputs) and vertices (one input) besides";
        assert_eq!(bad(&[0, 1, 3], &[0, 3, 5, 6], &[0, 1, 2, 0, 1, 4]), short);
        let (_, message) = refusal(mesh().set_facets(&[0, 1], &[0, 3], &[0, 1, 2], Some(&[1, 2])));
        assert_eq!(message, "markers has length 2; it must be that of the facets, 1");
    }

    #[test]
    fn triangles_that_cannot_be_are_refused_by_name() {
        let bad = |corners: &[u32], markers: Option<&[i32]>| {
            let (kind, message) = refusal(mesh().set_triangles(corners, markers));
            assert_eq!(kind, ErrorKind::InvalidArgument);
            message
        };
        let length = "triangles has length 4; it must be a multiple of 3: three inputs a triangle";
        assert_eq!(bad(&[0, 1, 2, 3], None), length);
        let range = "triangles[1] has the input 6; it must be less than the number of inputs, 6";
        assert_eq!(bad(&[0, 1, 2, 0, 6, 2], None), range);
        let markers = "markers has length 0; it must be that of the triangles, 1";
        assert_eq!(bad(&[0, 1, 2], Some(&[])), markers);
    }

    #[test]
    fn facets_are_for_space() {
        for dim in [2, 4] {
            let points: Vec<f64> = (0..3 * dim * dim).map(|at| (at * at) as f64).collect();
            let mut mesh = Mesh::new(dim, 3, &points, 0).unwrap();
            let (kind, message) = refusal(mesh.set_facets(&[], &[], &[], None));
            let rule = format!("the mesh has dimension {dim}; facets are for 3D");
            assert_eq!((kind, message), (ErrorKind::InvalidArgument, rule));
            let (kind, message) = refusal(mesh.set_triangles(&[0, 1, 2], None));
            let rule = format!("the mesh has dimension {dim}; triangles are for 3D");
            assert_eq!((kind, message), (ErrorKind::InvalidArgument, rule));
        }
    }
}
