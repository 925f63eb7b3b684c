//! Arrays ready to use, of a selection. Each is made anew in each call; `copy_out` keeps the getters'
//! rules.

use super::enums::{decode_extent, nm_extent, nm_status, placement_byte};
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::{copy_out, read_struct};
use super::structs::nm_selection;
use crate::arrays::{Part, Selection};
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::NONE;
use std::mem::MaybeUninit;

/// Writes where each simplex lies with respect to a region: one byte per simplex, an nm_placement.
/// NM_EXTENT_ALL: all are inside.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT
/// (extent, buf not aligned), NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work,
/// poisoned).
///
/// The first call for NM_EXTENT_HULL of a result triangulates the inputs that may be on their hull.
/// Each simplex that its vertices do not place then takes time of the order of the inputs on the
/// hull: little for points in a volume, but as much as all else together and more where most inputs
/// are on the hull, as on a sphere. A byte per simplex is kept until the next nm_run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_placements(
    mesh: *const nm_mesh,
    extent: MaybeUninit<nm_extent>,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let count = result(mesh)?.simplex_count();
            let placements = prepared.placements(mesh, decode_extent("extent", extent)?)?;
            let byte =
                |at: usize| placements.get(at).map_or(0, |&placement| placement_byte(placement));
            copy_out(buf, capacity, needed, count, (0..count).map(byte))
        })
    }
}

/// Makes an array of a selection and copies it.
///
/// # Safety
/// `mesh` is NULL or a live handle, `selection` NULL or as long as its `struct_size` says, the buffer
/// as `copy_out` asks for.
unsafe fn get<T, S: Copy>(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    (buf, capacity, needed): (*mut T, u64, *mut u64),
    make: impl FnOnce(&Part<'_>) -> Result<Vec<S>>,
    encode: impl Fn(S) -> T,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            let part = prepared.part(mesh, &read_selection(selection)?)?;
            let array = make(&part)?;
            copy_out(buf, capacity, needed, array.len(), array.iter().map(|&x| encode(x)))
        })
    }
}

/// # Safety
/// `selection` is NULL or as long as its `struct_size` says.
pub(super) unsafe fn read_selection(selection: *const nm_selection) -> Result<Selection> {
    if selection.is_null() {
        return Ok(Selection::default());
    }
    let defaults = nm_selection {
        struct_size: 0,
        extent: MaybeUninit::new(nm_extent::NM_EXTENT_ALL),
        across: 0,
        domain: NONE,
    };
    // SAFETY: the caller's promise.
    let given = unsafe { read_struct("selection", selection, defaults)? };
    Ok(Selection {
        extent: decode_extent("selection.extent", given.extent)?,
        across: given.across != 0,
        domain: given.domain,
    })
}

/// Writes the ids of the simplices of a selection, ascending. Arrays with a row for each simplex of a
/// selection have them in this order.
///
/// Array getter of a selection, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh),
/// NM_INVALID_ARGUMENT (a field of the selection; the message names it; buf not aligned), NM_CAPACITY,
/// NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_selected(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(collected(part.simplices())?),
            |x| x,
        )
    }
}

/// Writes the edges: edges x 2 vertex ids, the less first, in lexicographic order.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_edges(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| part.edges(), |x| x) }
}

/// Writes the facets: facets x dim vertex ids. They are ordered by their first simplex
/// (nm_mesh_get_facet_simplices) and by the place of the vertex opposite in it, and oriented as on the
/// boundary of that simplex: outwards, as the hull is.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facets(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.facets()?.vertices), |x| x)
    }
}

/// Writes the simplices of each facet: facets x 2 simplex ids, the less first; NM_NONE in place of the
/// second on the hull of the selection.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facet_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.facets()?.simplices), |x| x)
    }
}

/// Writes the hull, the facets that only one simplex of the selection has: facets x dim vertex ids,
/// oriented outwards. They go counterclockwise round the mesh in 2D, and counterclockwise for who looks
/// at them from outside in 3D; in any dimension a point inside before them makes a positively oriented
/// simplex.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_hull(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.hull()?.vertices), |x| x)
    }
}

/// Writes the simplex of each facet of nm_mesh_get_hull.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_hull_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.hull()?.simplices), |x| x)
    }
}

/// Writes the simplices of each vertex, one vertex after the other, each time ascending; where the lists
/// begin tells nm_mesh_get_vertex_simplex_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_simplices()?.ids),
            |x| x,
        )
    }
}

/// Writes where the list of each vertex begins in nm_mesh_get_vertex_simplices, and at the end its
/// length: vertices + 1 numbers. Vertices without a simplex of the selection have empty lists.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_simplex_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_simplices()?.starts),
            |start| start as u64,
        )
    }
}

/// Writes the vertices that share an edge with each vertex, one vertex after the other, each time
/// ascending; where the lists begin tells nm_mesh_get_vertex_neighbor_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_neighbors(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_neighbors()?.ids),
            |x| x,
        )
    }
}

/// Writes where the list of each vertex begins in nm_mesh_get_vertex_neighbors, and at the end its
/// length: vertices + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_neighbor_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_neighbors()?.starts),
            |start| start as u64,
        )
    }
}

/// Writes the circumcentres: simplices x dim coordinates, exact up to 1e-12 of the circumradius and a
/// rounding. Infinite where a coordinate exceeds the doubles.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_circumcenters(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.circumcenters()?.centers),
            |x| x,
        )
    }
}

/// Writes the circumradius of each simplex, exact up to a relative error of 1e-12, or to 2^-1074 if
/// subnormal. Infinite beyond the doubles.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_circumradii(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.circumcenters()?.radii), |x| x)
    }
}

/// Writes the volume of each simplex (its area in 2D), exact up to a relative error of 1e-12, or to
/// 2^-1074 if subnormal; 0 below the doubles and infinite beyond.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_volumes(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| part.volumes(), |x| x) }
}

/// Writes the Voronoi cells: the simplices whose circumcentres are the corners of each vertex's cell, one
/// vertex after the other. In 2D counterclockwise, from one end to the other where the cell is unbounded;
/// else ascending. Where the lists begin tells nm_mesh_get_region_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_regions(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| Ok(part.regions()?.ids), |x| x) }
}

/// Writes where the list of each vertex begins in nm_mesh_get_regions, and at the end its length:
/// vertices + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.regions()?.starts),
            |start| start as u64,
        )
    }
}

/// Writes the volume of each vertex's Voronoi cell, infinite where the cell is unbounded: the vertex is
/// on the hull of the selection, or in no simplex of it. Computed in doubles from circumcentres.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_volumes(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.cells()?.volumes), |x| x)
    }
}

/// Writes what each vertex's Voronoi cell adds to the volume of the mesh: its volume if it is bounded;
/// else what the simplices at the vertex have of it, which may be negative next to obtuse simplices. The
/// shares of all vertices add up to the volume of the simplices.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_shares(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| Ok(part.cells()?.shares), |x| x) }
}

/// Writes the ridges, the facets of Voronoi cells: one for each edge, in the order of nm_mesh_get_edges,
/// between the cells of its ends. A ridge is the list of simplices whose circumcentres are its corners, in
/// 3D in their order round it, from one end to the other where it is unbounded; else ascending. Where the
/// lists begin tells nm_mesh_get_ridge_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_corners(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.ridges()?.corners.ids), |x| x)
    }
}

/// Writes where the list of each ridge begins in nm_mesh_get_ridge_corners, and at the end its length:
/// edges + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.ridges()?.corners.starts),
            |start| start as u64,
        )
    }
}

/// Writes 1 for each ridge that is bounded, 0 for those whose edge is on the hull of the selection: one
/// byte per edge.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_bounded(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.ridges()?.is_bounded),
            u8::from,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::enums::nm_format;
    use crate::capi::export::{nm_export_write, nm_export_write_selected};
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::io::Format;
    use crate::mesh::Mesh;
    use crate::numerics::testing::{Family, Random, points};
    use crate::options::Options;
    use std::ffi::c_void;
    use std::ptr::{null, null_mut};

    type Getter<T> = unsafe extern "C" fn(
        *const nm_mesh,
        *const nm_selection,
        *mut T,
        u64,
        *mut u64,
    ) -> nm_status;

    fn get_all<T: Copy + Default>(
        mesh: &nm_mesh,
        selection: *const nm_selection,
        getter: Getter<T>,
    ) -> Vec<T> {
        let mut needed = u64::MAX;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { getter(mesh, selection, null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let mut values = vec![T::default(); needed as usize];
        // SAFETY: the buffer has room for `needed`.
        let status = unsafe { getter(mesh, selection, values.as_mut_ptr(), needed, null_mut()) };
        assert_eq!(status, nm_status::NM_OK);
        values
    }

    fn select(extent: i32, across: u32, domain: u32) -> nm_selection {
        let struct_size = size_of::<nm_selection>() as u32;
        nm_selection { struct_size, extent: from_c(extent), across, domain }
    }

    fn meshed() -> Mesh {
        let mut points = points::<2>(Family::Uniform, 40, &mut Random(8));
        points.extend(
            (0..6).map(|i| [0.25 + 1e-9 * f64::from(i), 0.5 + 1e-9 * f64::from(i * i % 5)]),
        );
        let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
        mesh.run(&Options::default(), None).unwrap();
        mesh
    }

    #[test]
    fn getters_have_the_arrays_of_the_selection() {
        let mesh = meshed();
        let handle = nm_mesh::new(mesh.clone());
        let prepared = crate::prepared::Prepared::default();
        let selections = [
            (select(0, 0, NONE), Selection::default()),
            (
                select(1, 0, NONE),
                Selection { extent: crate::arrays::Extent::Hull, across: false, domain: NONE },
            ),
            (
                select(2, 1, 0),
                Selection { extent: crate::arrays::Extent::Box, across: true, domain: 0 },
            ),
            (select(0, 0, 1), Selection { domain: 1, ..Selection::default() }),
        ];
        for (given, selection) in &selections {
            let part = prepared.part(&mesh, selection).unwrap();
            let ids = |getter: Getter<u32>| get_all(&handle, given, getter);
            let doubles = |getter: Getter<f64>| get_all(&handle, given, getter);
            let starts = |getter: Getter<u64>| -> Vec<usize> {
                get_all(&handle, given, getter).iter().map(|&start| start as usize).collect()
            };
            assert_eq!(ids(nm_mesh_get_selected), part.simplices().collect::<Vec<_>>());
            assert_eq!(ids(nm_mesh_get_edges), part.edges().unwrap());
            let facets = part.facets().unwrap();
            assert_eq!(ids(nm_mesh_get_facets), facets.vertices);
            assert_eq!(ids(nm_mesh_get_facet_simplices), facets.simplices);
            let hull = part.hull().unwrap();
            assert_eq!(ids(nm_mesh_get_hull), hull.vertices);
            assert_eq!(ids(nm_mesh_get_hull_simplices), hull.simplices);
            let lists = part.vertex_simplices().unwrap();
            assert_eq!(ids(nm_mesh_get_vertex_simplices), lists.ids);
            assert_eq!(starts(nm_mesh_get_vertex_simplex_starts), lists.starts);
            let lists = part.vertex_neighbors().unwrap();
            assert_eq!(ids(nm_mesh_get_vertex_neighbors), lists.ids);
            assert_eq!(starts(nm_mesh_get_vertex_neighbor_starts), lists.starts);
            let centers = part.circumcenters().unwrap();
            assert_eq!(doubles(nm_mesh_get_circumcenters), centers.centers);
            assert_eq!(doubles(nm_mesh_get_circumradii), centers.radii);
            assert_eq!(doubles(nm_mesh_get_volumes), part.volumes().unwrap());
            let voronoi = part.voronoi().unwrap();
            assert_eq!(ids(nm_mesh_get_regions), voronoi.regions.ids);
            assert_eq!(starts(nm_mesh_get_region_starts), voronoi.regions.starts);
            assert_eq!(doubles(nm_mesh_get_region_volumes), voronoi.volumes);
            assert_eq!(doubles(nm_mesh_get_region_shares), voronoi.shares);
            assert_eq!(ids(nm_mesh_get_ridge_corners), voronoi.ridge_corners.ids);
            assert_eq!(starts(nm_mesh_get_ridge_starts), voronoi.ridge_corners.starts);
            let bounded: Vec<u8> = voronoi.is_ridge_bounded.iter().map(|&b| u8::from(b)).collect();
            assert_eq!(get_all(&handle, given, nm_mesh_get_ridge_bounded), bounded);
            assert!(bounded.contains(&0) && bounded.contains(&1));
        }
        let all = get_all(&handle, null(), nm_mesh_get_edges);
        assert_eq!(all, mesh.edges().unwrap());
        let mut bytes = vec![9; mesh.triangulation().unwrap().simplex_count()];
        let capacity = bytes.len() as u64;
        // SAFETY: a live handle; the buffer has room for `capacity`.
        let status = unsafe {
            nm_mesh_get_placements(&handle, from_c(1), bytes.as_mut_ptr(), capacity, null_mut())
        };
        assert_eq!(status, nm_status::NM_OK);
        let expected = prepared.placements(&mesh, crate::arrays::Extent::Hull).unwrap();
        assert!(bytes.iter().zip(expected).all(|(&byte, &placement)| byte == placement as u8));
        assert!((0..3).all(|byte| bytes.contains(&byte)));
    }

    unsafe extern "C" fn append(data: *const c_void, size: usize, text: *mut c_void) -> i32 {
        // SAFETY: the test passes its own vector, and `size` bytes are readable.
        unsafe {
            (*text.cast::<Vec<u8>>()).extend(std::slice::from_raw_parts(data.cast(), size));
        }
        0
    }

    /// An export, as bytes.
    fn export(mesh: &nm_mesh, selection: *const nm_selection, format: nm_format) -> Vec<u8> {
        let mut text = Vec::<u8>::new();
        let to = (&raw mut text).cast();
        // SAFETY: a live handle; the callback gets its vector.
        let status = unsafe {
            nm_export_write_selected(mesh, selection, from_c(format as i32), Some(append), to)
        };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        text
    }

    #[test]
    fn exports_have_the_selection() {
        let mesh = meshed();
        let handle = nm_mesh::new(mesh.clone());
        let all = export(&handle, null(), nm_format::NM_FORMAT_VTU);
        let mut whole = Vec::<u8>::new();
        // SAFETY: a live handle; the callback gets its vector.
        let status = unsafe {
            let to = (&raw mut whole).cast();
            nm_export_write(&handle, from_c(nm_format::NM_FORMAT_VTU as i32), Some(append), to)
        };
        assert_eq!((status, &all), (nm_status::NM_OK, &whole));
        let hull = select(1, 0, NONE);
        let part = get_all(&handle, &hull, nm_mesh_get_selected).len();
        let text = export(&handle, &hull, nm_format::NM_FORMAT_XYZ);
        let cloud = crate::io::read(&mut text.as_slice(), Format::Xyz).unwrap();
        let points = cloud.coordinates.len() / 2;
        // Some of the vertices, in their order.
        let triangulation = mesh.triangulation().unwrap();
        let mut vertices = triangulation.points.chunks_exact(2);
        let rows = cloud.coordinates.chunks_exact(2);
        assert!(points < triangulation.vertex_count() && points > mesh.inputs().distinct() / 2);
        rows.for_each(|row| assert!(vertices.any(|vertex| vertex == row)));
        let vtu = export(&handle, &hull, nm_format::NM_FORMAT_VTU);
        let count = format!("NumberOfCells=\"{part}\"");
        assert!(String::from_utf8_lossy(&vtu).contains(&count));
        // SAFETY: a live handle; the callback gets its vector.
        let status = unsafe {
            let to = (&raw mut whole).cast();
            let format = from_c(nm_format::NM_FORMAT_DOMAINS_JSON as i32);
            nm_export_write_selected(&handle, &hull, format, Some(append), to)
        };
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().contains("NM_FORMAT_DOMAINS_JSON"));
    }

    #[test]
    fn wrong_selections_are_named() {
        let handle = nm_mesh::new(meshed());
        let mut needed = 17;
        let mut refused = |selection: &nm_selection, message: &str| {
            // SAFETY: a live handle and a struct as long as it says, or refused.
            let status =
                unsafe { nm_mesh_get_edges(&handle, selection, null_mut(), 0, &mut needed) };
            assert_eq!((status, needed), (nm_status::NM_INVALID_ARGUMENT, 17));
            assert!(last_message().starts_with(message), "{}", last_message());
        };
        refused(&select(3, 0, NONE), "selection.extent is 3");
        refused(&select(0, 0, 999), "selection.domain is 999; the mesh has");
        refused(
            &nm_selection { struct_size: 6, ..select(0, 0, NONE) },
            "selection.struct_size is 6",
        );
        let short = nm_selection { struct_size: 4, ..select(2, 0, 999) };
        assert_eq!(
            get_all(&handle, &short, nm_mesh_get_volumes),
            get_all(&handle, null(), nm_mesh_get_volumes)
        );
        let before = square();
        // SAFETY: a live handle.
        let status = unsafe { nm_mesh_get_hull(&before, null(), null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_STATE);
        // SAFETY: a live handle.
        let status =
            unsafe { nm_mesh_get_placements(&before, from_c(1), null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_STATE);
    }
}
