//! Boundaries: segments between inputs, seeds of regions, and arrangements of segments and facets
//! without crossings.

use super::{ArrangedFacet, Boxed, FacetTriangle, Inputs, Mesh, NONE, Triangulation};
use crate::error::{Error, ErrorKind, Name, Result, message, say};
use crate::memory::{AllocError, AllocResult, Lists, collected, copied, filled, with_capacity};
use std::ops::RangeInclusive;

/// Largest number of segments that 32-bit ids can tell apart.
const MAX_SEGMENTS: usize = u32::MAX as usize - 1;

/// Segments as the caller gave them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Segments {
    /// Ends of each segment, as numbers of inputs.
    pub inputs: Vec<[u32; 2]>,
    /// Number that the caller gave each segment.
    pub markers: Vec<i32>,
    /// Segment of a file of polygons -> true if it is a side of one; empty for all other segments.
    pub sides: Vec<bool>,
}

/// Properties that a seed point gives to the region around it; a region has at most one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Region {
    /// Point in the region; in the plane the last coordinate is 0.
    pub seed: [f64; 3],
    /// Number that the caller gave the simplices of the region.
    pub label: i32,
    /// True if the region is no part of the result, whatever its extent.
    pub is_hole: bool,
    /// Largest length of an edge in the region; 0 for no bound.
    pub max_edge: f64,
}

impl Region {
    /// Returns a region of the plane with a seed, and with nothing else.
    pub fn in_plane([x, y]: [f64; 2]) -> Self {
        Self { seed: [x, y, 0.0], ..Self::default() }
    }

    /// Returns true if region `number` is a hole, and the number of regions of its kind that come
    /// before it: for interfaces that have holes apart from other regions. A number beyond the last
    /// counts as that of a region.
    pub fn number_among_its_kind(regions: &[Self], number: usize) -> (bool, usize) {
        let Some(region) = regions.get(number) else { return (false, number) };
        let before = regions[..number].iter().filter(|other| other.is_hole == region.is_hole);
        (region.is_hole, before.count())
    }
}

/// Piece of a segment, with its direction. Its interior contains no vertex of the arrangement and
/// meets no other piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subsegment {
    /// Ends: distinct inputs, or [`Inputs::distinct`] plus the index of a crossing or, in space, of
    /// a corner.
    pub ends: [u32; 2],
    /// Segment to which the piece belongs, the first if several overlap; [`NONE`](super::NONE) for
    /// an edge of a hull or box.
    pub segment: u32,
    /// Number of segments that run along the piece, less the number of those that run against it.
    /// Segments that enclose nothing do not count.
    pub balance: i64,
}

/// Point where doubles have no room for a vertex of a subsegment, since another vertex is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crowded {
    /// The caller's segment, or [`NONE`] for the boundary of an extent.
    pub segment: u32,
    pub x: [f64; 2],
    /// Ends of the subsegment of the arrangement, the nearer to the point first.
    pub ends: [[f64; 2]; 2],
}

/// Segments that meet only at their ends, into which the caller's segments are split.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    /// Points where segments cross and no input is.
    pub crossings: Vec<[f64; 2]>,
    /// Corners of a box in space where no input is.
    pub corners: Vec<[f64; 3]>,
    /// Pieces of segments, sorted by segment, and along each from its first end to its second.
    pub subsegments: Vec<Subsegment>,
    /// Facets in space, which meet only at common vertices and subsegments.
    pub facets: Vec<ArrangedFacet>,
    /// Triangles that the facets consist of, sorted by facet. Triangles of one facet that share an
    /// edge are neighbours there, unless the edge is a subsegment.
    pub triangles: Vec<FacetTriangle>,
    /// Triangles that the caller's facets have on those of earlier ones, each with the number of
    /// the facet's parent; sorted by that.
    pub borrowed: Vec<([u32; 3], u32)>,
    /// Properties that the caller gave the regions between segments or facets.
    pub regions: Vec<Region>,
    /// Number of segments without a piece of their own: duplicates, and those that others cover.
    pub covered_segments: u64,
    /// Points that a run could not make vertices of, since another vertex is in the way: segments
    /// must go through it together.
    pub crowded: Vec<Crowded>,
    /// Number of cases in which an input counts as on a segment without being exactly on it,
    /// because rounding may explain the gap.
    pub near_inputs: u64,
    /// Largest distance of such an input from the straight segment, in units in the last place of
    /// the segment's larger coordinates.
    pub farthest_near_input: f64,
}

/// Segments and regions of a triangulation; empty without segments.
#[derive(Clone, Debug, Default)]
pub struct Boundary {
    /// Edges into which segments are split, each in the direction of its segment; sorted by
    /// segment, and along each.
    pub subsegments: Vec<[u32; 2]>,
    /// Subsegment -> the segment to which it belongs; [`NONE`](super::NONE) for the boundary of a
    /// hull or box.
    pub parents: Vec<u32>,
    /// Triangles into which facets are split, counterclockwise where the normal of the facet points
    /// to the eye; sorted by facet.
    pub subfacets: Vec<[u32; 3]>,
    /// Subfacet -> the facet to which it belongs, of facets that are one the first;
    /// [`NONE`](super::NONE) for a side of a hull or box.
    pub subfacet_parents: Vec<u32>,
    /// Subfacet -> the simplex where the normal of the facet points to, and the one on the other
    /// side; [`NONE`](super::NONE) where the domain ends.
    pub subfacet_simplices: Vec<[u32; 2]>,
    /// Simplices with all vertices on one facet, which roundings of its vertices make, ascending.
    pub flat: Vec<u32>,
    /// Simplex -> the label of its region, 0 where no seed gave one.
    pub simplex_regions: Vec<i32>,
    /// Simplices beyond the bound that small angles between segments force, ascending.
    pub forced: Vec<u32>,
    /// Triangulation of the whole hull, before it was cropped to the domain; its first vertices and
    /// simplices are those of the domain. `None` if nothing was cropped.
    pub whole: Option<Boxed<Triangulation>>,
}

/// Returns the markers of parents, 0 for [`NONE`](super::NONE).
fn markers_of<'a>(parents: &'a [u32], markers: &'a [i32]) -> impl Iterator<Item = i32> + 'a {
    parents.iter().map(|&parent| markers.get(parent as usize).copied().unwrap_or(0))
}

impl Arrangement {
    /// Counts an input that a segment goes through, given its distance from the straight segment.
    pub(crate) fn note_offset(&mut self, offset: f64) {
        self.near_inputs += u64::from(offset > 0.0);
        self.farthest_near_input = self.farthest_near_input.max(offset);
    }

    /// Returns true if a region has a largest edge.
    pub(crate) fn has_sizes(&self) -> bool {
        self.regions.iter().any(|region| region.max_edge > 0.0)
    }
}

impl Boundary {
    /// Returns true if there are segments, facets or labels of regions.
    pub(crate) fn has_any(&self) -> bool {
        let has_parts = !self.subsegments.is_empty() || !self.subfacets.is_empty();
        has_parts || !self.simplex_regions.is_empty()
    }

    /// Returns the edges into which segments are split, with the markers of their segments; 0 for
    /// edges that belong to none.
    pub(crate) fn marked<'a>(
        &'a self,
        markers: &'a [i32],
    ) -> impl Iterator<Item = ([u32; 2], i32)> + 'a {
        self.subsegments.iter().copied().zip(markers_of(&self.parents, markers))
    }

    /// Returns the triangles into which facets are split, with the markers of their facets; 0 for
    /// triangles that belong to none.
    pub(crate) fn marked_facets<'a>(
        &'a self,
        markers: &'a [i32],
    ) -> impl Iterator<Item = ([u32; 3], i32)> + 'a {
        self.subfacets.iter().copied().zip(markers_of(&self.subfacet_parents, markers))
    }

    /// Returns for each subsegment true if it is an edge of one of the given simplices, whose
    /// vertices are below `vertices`. `tick` is told of the work, and may end it. O(simplices +
    /// subsegments), except at vertices with many subsegments.
    pub(crate) fn edges_of<'a, E: From<AllocError>>(
        &self,
        vertices: usize,
        simplices: impl Iterator<Item = &'a [u32]>,
        mut tick: impl FnMut(u32) -> std::result::Result<(), E>,
    ) -> std::result::Result<Vec<bool>, E> {
        let mut is_edge = filled(self.subsegments.len(), false)?;
        if self.subsegments.is_empty() {
            return Ok(is_edge);
        }
        let at = Lists::of_pairs(vertices, || {
            let ends = self.subsegments.as_flattened().iter().enumerate();
            ends.map(|(slot, &vertex)| (vertex, (slot / 2) as u32))
        })?;
        for simplex in simplices {
            tick(1)?;
            for (slot, &from) in simplex.iter().enumerate() {
                for &to in &simplex[slot + 1..] {
                    let [shorter, longer] = [from, to].map(|vertex| at.of(vertex as usize));
                    let own = if shorter.len() < longer.len() { shorter } else { longer };
                    for &subsegment in own {
                        let ends = self.subsegments[subsegment as usize];
                        is_edge[subsegment as usize] |= ends == [from, to] || ends == [to, from];
                    }
                }
            }
        }
        Ok(is_edge)
    }

    /// Returns the boundary of a part of `mesh`: some of its simplices, which get new numbers, and
    /// so do vertices; [`NONE`] stands for those that are not in the part.
    pub(crate) fn of_part(
        mesh: &Triangulation,
        [new_vertex, new_simplex]: [&[u32]; 2],
        simplices: &[u32],
    ) -> AllocResult<Self> {
        let all = &mesh.boundary;
        let own = simplices.iter().map(|&simplex| mesh.simplex(simplex as usize));
        let is_edge = all.edges_of(mesh.vertex_count(), own, |_| AllocResult::Ok(()))?;
        let kept = || (0..is_edge.len()).filter(|&at| is_edge[at]);
        let new_ends = |at: usize| all.subsegments[at].map(|vertex| new_vertex[vertex as usize]);
        let regions = |&simplex: &u32| all.simplex_regions.get(simplex as usize).copied();
        let new = |simplex: u32| new_simplex.get(simplex as usize).copied().unwrap_or(NONE);
        let numbered = |old: &[u32]| {
            collected(old.iter().map(|&simplex| new(simplex)).filter(|&simplex| simplex != NONE))
        };
        // Those of which the part has a side.
        let sides = || all.subfacet_simplices.iter().map(|sides| sides.map(new));
        let kept_facets = || sides().enumerate().filter(|(_, sides)| *sides != [NONE; 2]);
        let new_corners = |at: usize| all.subfacets[at].map(|vertex| new_vertex[vertex as usize]);
        Ok(Self {
            subsegments: collected(kept().map(new_ends))?,
            parents: collected(kept().map(|at| all.parents[at]))?,
            simplex_regions: collected(simplices.iter().filter_map(regions))?,
            forced: numbered(&all.forced)?,
            flat: numbered(&all.flat)?,
            subfacets: collected(kept_facets().map(|(at, _)| new_corners(at)))?,
            subfacet_parents: collected(kept_facets().map(|(at, _)| all.subfacet_parents[at]))?,
            subfacet_simplices: collected(kept_facets().map(|(_, sides)| sides))?,
            whole: None,
        })
    }
}

impl Segments {
    pub fn count(&self) -> usize {
        self.inputs.len()
    }

    /// Returns true if the segments come from a file of polygons.
    pub fn has_polygons(&self) -> bool {
        !self.sides.is_empty()
    }

    /// Returns true if a segment may enclose something: a side of a polygon does, a line of the
    /// same file does not. Without polygons all segments may.
    pub fn encloses(&self, segment: usize) -> bool {
        self.sides.get(segment).is_none_or(|is_side| *is_side)
    }

    /// Makes segments of `ends`, two inputs for each; without `markers` every segment has 0.
    pub(super) fn new(inputs: &Inputs, ends: &[u32], markers: Option<&[i32]>) -> Result<Self> {
        check_dimension(inputs, "segments", 2..=3)?;
        let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
        if ends.len() % 2 != 0 {
            return refuse(message!(
                "segments has length {}; it must be even: two inputs a segment",
                ends.len()
            ));
        }
        let count = ends.len() / 2;
        if count > MAX_SEGMENTS {
            let message = message!("{count} segments; at most {MAX_SEGMENTS} fit 32-bit ids");
            return Err(Error::new(ErrorKind::Capacity, message));
        }
        check_markers(markers, "segments", count)?;
        let mut own = with_capacity(count)?;
        for (at, ends) in ends.chunks_exact(2).enumerate() {
            let ends = [ends[0], ends[1]];
            check_segment(inputs, at, ends)?;
            own.push(ends);
        }
        let markers = markers_or_zeros(markers, count)?;
        Ok(Self { inputs: own, markers, sides: Vec::new() })
    }
}

impl Mesh {
    /// Records which segments are sides of polygons, one value for each segment. If none is,
    /// nothing is recorded.
    ///
    /// # Errors
    /// `InvalidArgument`: not as many values as there are segments; `OutOfMemory`.
    pub fn set_sides(&mut self, sides: &[bool]) -> Result<()> {
        let (given, count) = (sides.len(), self.segments.count());
        if given != count {
            let message =
                message!("sides has {given} values; it must have one for each segment, {count}");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let any = sides.contains(&true);
        self.segments.sides = if any { copied(sides)? } else { Vec::new() };
        Ok(())
    }
}

/// Returns a copy of the regions after checking them.
pub(super) fn checked_regions(inputs: &Inputs, regions: &[Region]) -> Result<Vec<Region>> {
    check_dimension(inputs, "regions", 2..=3)?;
    for (at, Region { seed, max_edge, .. }) in regions.iter().enumerate() {
        if let Some(axis) = seed.iter().position(|x| !x.is_finite()) {
            let message = message!(
                "regions[{at}].seed has a non-finite coordinate {axis}: {}; every coordinate \
                 must be finite",
                seed[axis]
            );
            return Err(Error::new(ErrorKind::NonFinite, message));
        }
        if inputs.dim() == 2 && seed[2] != 0.0 {
            let message = message!(
                "regions[{at}].seed has the third coordinate {}; in 2D it must be 0",
                seed[2]
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        if !(0.0..=f64::MAX).contains(max_edge) {
            let message =
                message!("regions[{at}].max_edge is {max_edge}; it must be a length, or 0 for any");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
    }
    Ok(copied(regions)?)
}

/// Fails if inputs of this dimension have no such things as `what`.
pub(super) fn check_dimension(
    inputs: &Inputs,
    what: &str,
    dimensions: RangeInclusive<usize>,
) -> Result<()> {
    let dim = inputs.dim();
    if dimensions.contains(&dim) {
        return Ok(());
    }
    let home = if dimensions.contains(&2) { "2D and 3D" } else { "3D" };
    Err(Error::invalid(message!("the mesh has dimension {dim}; {what} are for {home}")))
}

/// Fails if there are markers, but not one for each of `what`.
pub(super) fn check_markers(markers: Option<&[i32]>, what: &str, count: usize) -> Result<()> {
    match markers {
        Some(markers) if markers.len() != count => Err(Error::invalid(message!(
            "markers has length {}; it must be that of the {what}, {count}",
            markers.len()
        ))),
        _ => Ok(()),
    }
}

/// Returns a copy of the markers, or as many zeros.
pub(super) fn markers_or_zeros(markers: Option<&[i32]>, count: usize) -> AllocResult<Vec<i32>> {
    markers.map_or_else(|| filled(count, 0), copied)
}

fn check_segment(inputs: &Inputs, at: usize, ends: [u32; 2]) -> Result<()> {
    let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
    let ([from, to], segment) = (ends, Name::Segment(at));
    let [one, other] = ends.map(|end| Name::Input(end as usize));
    let count = inputs.count();
    if let Some(end) = ends.iter().find(|&&end| end as usize >= inputs.count()) {
        return refuse(say!(
            segment,
            " has the end {end}; ends must be less than the number of inputs, {count}"
        ));
    }
    if from == to {
        return refuse(say!(segment, " has input ", one, " as both ends; its length is 0"));
    }
    if inputs.vertices()[from as usize] == inputs.vertices()[to as usize] {
        let rule = "which are the same point; its length is 0";
        return refuse(say!(segment, " has the ends ", one, " and ", other, ", {rule}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::options::{Algorithm, Options};

    /// Returns a mesh of four inputs, of which the last is a duplicate of the first.
    fn mesh() -> Mesh {
        Mesh::new(2, 4, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, -0.0, 0.0], 0).unwrap()
    }

    fn refusal(result: Result<()>) -> (ErrorKind, String) {
        let error = result.unwrap_err();
        (error.kind(), error.message().to_owned())
    }

    #[test]
    fn segments_are_kept_until_others_replace_them() {
        let mut mesh = mesh();
        assert_eq!(mesh.segments().count(), 0);
        mesh.set_segments(&[0, 1, 3, 2], Some(&[7, -7])).unwrap();
        let kept =
            Segments { inputs: vec![[0, 1], [3, 2]], markers: vec![7, -7], sides: Vec::new() };
        assert_eq!(*mesh.segments(), kept);
        mesh.set_segments(&[1, 9], None).unwrap_err();
        assert_eq!(*mesh.segments(), kept);
        mesh.set_segments(&[1, 2], None).unwrap();
        let unmarked = Segments { inputs: vec![[1, 2]], markers: vec![0], ..Segments::default() };
        assert_eq!(*mesh.segments(), unmarked);
    }

    #[test]
    fn segments_that_cannot_be_are_refused_by_name() {
        let bad = |ends: &[u32], markers: Option<&[i32]>| {
            let (kind, message) = refusal(mesh().set_segments(ends, markers));
            assert_eq!(kind, ErrorKind::InvalidArgument);
            message
        };
        let even = "segments has length 3; it must be even: two inputs a segment";
        assert_eq!(bad(&[0, 1, 2], None), even);
        let range = "segments[1] has the end 4; ends must be less than the number of inputs, 4";
        assert_eq!(bad(&[0, 1, 1, 4], None), range);
        let zero = "segments[1] has input 2 as both ends; its length is 0";
        assert_eq!(bad(&[0, 1, 2, 2], None), zero);
        let same = "segments[0] has the ends 3 and 0, which are the same point; its length is 0";
        assert_eq!(bad(&[3, 0], None), same);
        let markers = "markers has length 1; it must be that of the segments, 2";
        assert_eq!(bad(&[0, 1, 1, 2], Some(&[5])), markers);
    }

    #[test]
    fn markers_are_those_of_the_segments_that_were_meshed() {
        let mut mesh = mesh();
        mesh.set_segments(&[0, 1], Some(&[7])).unwrap();
        mesh.run(&Default::default(), None).unwrap();
        assert_eq!(mesh.markers_of_result(), [7]);
        for marker in [8, 9] {
            mesh.set_segments(&[1, 2], Some(&[marker])).unwrap();
            assert_eq!(mesh.markers_of_result(), [7]);
        }
        mesh.run(&Default::default(), None).unwrap();
        assert_eq!(mesh.markers_of_result(), [9]);
    }

    #[test]
    fn regions_that_cannot_be_are_refused_by_name() {
        let good = Region { seed: [0.5, 0.5, 0.0], label: 3, is_hole: false, max_edge: 0.25 };
        let mut mesh = mesh();
        mesh.set_regions(&[good]).unwrap();
        let far = Region { seed: [0.0, f64::INFINITY, 0.0], ..good };
        let (kind, message) = refusal(mesh.set_regions(&[good, far]));
        assert_eq!(kind, ErrorKind::NonFinite);
        assert!(message.starts_with("regions[1].seed has a non-finite coordinate 1: inf;"));
        for max_edge in [-1.0, f64::NAN, f64::INFINITY] {
            let (kind, message) = refusal(mesh.set_regions(&[Region { max_edge, ..good }]));
            assert_eq!(kind, ErrorKind::InvalidArgument);
            assert!(message.starts_with("regions[0].max_edge is"), "{message}");
        }
        assert_eq!(mesh.regions(), [good]);
    }

    #[test]
    fn a_part_has_the_facets_of_its_simplices() {
        let points = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let mut mesh = Mesh::new(3, 5, &points, 0).unwrap();
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        mesh.run(&options, None).unwrap();
        let mut made = mesh.triangulation().unwrap().clone();
        assert_eq!(made.simplex_count(), 2);
        let outer = u32::from(made.simplex(0).contains(&0));
        let inner = 1 - outer;
        made.boundary = Boundary {
            subfacets: vec![[1, 2, 3], [0, 1, 2], [1, 2, 4]],
            subfacet_parents: vec![4, 5, NONE],
            subfacet_simplices: vec![[outer, inner], [NONE, inner], [outer, NONE]],
            flat: vec![outer],
            forced: vec![inner],
            ..Boundary::default()
        };
        let (new_vertex, mut new_simplex) = ([NONE, 0, 1, 2, 3], [NONE; 2]);
        new_simplex[outer as usize] = 0;
        let part = Boundary::of_part(&made, [&new_vertex, &new_simplex], &[outer]).unwrap();
        assert_eq!(part.subfacets, [[0, 1, 2], [0, 1, 3]]);
        assert_eq!(part.subfacet_parents, [4, NONE]);
        assert_eq!(part.subfacet_simplices, [[0, NONE]; 2]);
        assert_eq!((part.flat, part.forced), (vec![0], vec![]));
    }

    #[test]
    fn segments_and_regions_are_for_two_and_three_dimensions() {
        let mesh = |dim: usize| {
            let points: Vec<f64> = (0..2 * dim).map(|at| at as f64).collect();
            Mesh::new(dim, 2, &points, 0).unwrap()
        };
        let region = Region { seed: [0.5, 0.5, 0.25], ..Region::default() };
        let mut space = mesh(3);
        space.set_segments(&[0, 1], Some(&[7])).unwrap();
        space.set_regions(&[region]).unwrap();
        assert_eq!((&*space.segments().inputs, space.regions()), (&[[0, 1]][..], &[region][..]));
        let (kind, message) = refusal(mesh(2).set_regions(&[Region::default(), region]));
        let rule = "regions[1].seed has the third coordinate 0.25; in 2D it must be 0";
        assert_eq!((kind, &*message), (ErrorKind::InvalidArgument, rule));
        for dim in [4, 8] {
            let (kind, message) = refusal(mesh(dim).set_segments(&[0, 1], None));
            let rule = format!("the mesh has dimension {dim}; segments are for 2D and 3D");
            assert_eq!((kind, message), (ErrorKind::InvalidArgument, rule));
            let (kind, message) = refusal(mesh(dim).set_regions(&[]));
            let rule = format!("the mesh has dimension {dim}; regions are for 2D and 3D");
            assert_eq!((kind, message), (ErrorKind::InvalidArgument, rule));
        }
    }
}
