//! The cage template T (§4): points on the unit sphere, no point of the sphere farther than delta
//! from them, made by greedy farthest-point insertion [Gon85].

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocResult, Array, collected, copied, with_capacity};
use crate::netmesh::state::watch::Watch;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;
use std::f64::consts::{PI, TAU};

/// Returns a delta-net of the unit sphere, or a part of it that is more than `most` points. In 2D
/// it is the regular polygon, which is the smallest one.
///
/// # Errors
/// `Cancelled`, since the smallest delta takes minutes in 4D and more; `OutOfMemory`.
pub(in crate::netmesh) fn cage_template<const D: usize>(
    delta: f64,
    most: u64,
    watch: &mut Watch<'_, '_>,
) -> Result<Vec<[f64; D]>> {
    if D == 2 { Ok(polygon(delta)?) } else { greedy_net(delta, most, watch) }
}

/// Returns the vertices of a regular n-gon such that every point of the circle is within `delta` of
/// one; it is within 2 sin(pi / 2n).
fn polygon<const D: usize>(delta: f64) -> AllocResult<Vec<[f64; D]>> {
    let count = (PI / (2.0 * (delta / 2.0).asin())).ceil();
    let vertex = |i: u32| {
        let mut point = [0.0; D];
        // Turned a little, so that grids are not cocircular with the polygon.
        (point[1], point[0]) = (f64::from(i) * TAU / count + 0.1).sin_cos();
        point
    };
    collected((0..count as u32).map(vertex))
}

/// Returns the points c + r T.
pub(in crate::netmesh) fn cage_points<const D: usize>(
    template: &[[f64; D]],
    center: &[f64; D],
    radius: f64,
) -> AllocResult<Vec<[f64; D]>> {
    let point =
        |direction: &[f64; D]| std::array::from_fn(|axis| center[axis] + radius * direction[axis]);
    collected(template.iter().map(point))
}

/// Returns T with its axes permuted and reflected as `bits` say, which is exact: cages about one
/// centre that are turned alike have cospherical and coplanar vertices, and the mesh flat
/// simplices.
pub(in crate::netmesh) fn turned<const D: usize>(
    template: &[[f64; D]],
    bits: u64,
) -> AllocResult<Vec<[f64; D]>> {
    let mut axes: [usize; D] = std::array::from_fn(|axis| axis);
    let mut choice = bits >> 32;
    for axis in (1..D).rev() {
        axes.swap(axis, (choice % (axis as u64 + 1)) as usize);
        choice /= axis as u64 + 1;
    }
    let sign = |axis: usize| if bits >> axis & 1 == 0 { 1.0 } else { -1.0 };
    collected(template.iter().map(|t| std::array::from_fn(|axis| sign(axis) * t[axes[axis]])))
}

/// Inserts the point of the sphere farthest from the net until none is farther than delta. The
/// candidates are the normals of the hull's facets. The Delaunay complex of the net and the origin
/// has a simplex over each facet, and its circumcentre c is such a normal: |c - t| = |c| for the
/// facet's vertices t, so c t = 1/2 and the angle between them has the cosine 1 / (2 |c|).
fn greedy_net<const D: usize>(
    delta: f64,
    most: u64,
    watch: &mut Watch<'_, '_>,
) -> Result<Vec<[f64; D]>> {
    const ORIGIN: VertexId = VertexId::new(0);
    let mut points = with_capacity(D + 2)?;
    points.push([0.0; D]);
    points.extend(spanning_directions::<D>()?);
    let mut delaunay = Delaunay::new(Array::copied(&points)?)?;
    let first = collected(VertexId::below(D + 1))?;
    delaunay.begin(&first)?;
    let (mut cavity, mut created, mut star) = (Cavity::default(), Vec::new(), Array::new());
    let mut insert =
        |delaunay: &mut Delaunay<D>, vertex: VertexId, near: SimplexId| -> AllocResult<()> {
            let x = *delaunay.point(vertex);
            let start = delaunay.locate(near, &x).expect("the directions are distinct");
            delaunay.find_cavity(start, &x, &mut cavity)?;
            delaunay.insert(vertex, &cavity, &mut created)
        };
    let start = delaunay.complex().incident(ORIGIN);
    insert(&mut delaunay, VertexId::new(D + 1), start)?;
    let widest = 0.5 / (1.0 - 0.5 * delta * delta);
    loop {
        delaunay.star(ORIGIN, &mut star)?;
        watch.poll_after(star.len() as u32)?;
        let (facet, radius) = widest_facet(&delaunay, &star)?;
        if radius <= widest || delaunay.point_count() as u64 > most.saturating_add(1) {
            let net = VertexId::range(1..delaunay.point_count());
            return Ok(collected(net.map(|vertex| *delaunay.point(vertex)))?);
        }
        let corner = delaunay.corner(facet).expect("the simplices round the origin are finite");
        let vertex = delaunay.add_point(corner.map(|x| x / radius))?;
        insert(&mut delaunay, vertex, facet)?;
    }
}

/// Returns the simplex with the largest D-ball; among equals within rounding the first.
fn widest_facet<const D: usize>(
    delaunay: &Delaunay<D>,
    star: &[SimplexId],
) -> AllocResult<(SimplexId, f64)> {
    let radius =
        |simplex: SimplexId| delaunay.circumball(simplex).map_or(0.0, |ball| ball.radius());
    let mut sorted = copied(star)?;
    sorted.sort_unstable();
    Ok(sorted.iter().fold((SimplexId::NONE, 0.0), |best, &simplex| match radius(simplex) {
        wider if wider > best.1 * (1.0 + 1e-9) => (simplex, wider),
        _ => best,
    }))
}

/// Returns D orthonormal directions, turned at random so that grids do not align with them, and the
/// one that balances them: together they hold the origin inside.
fn spanning_directions<const D: usize>() -> AllocResult<Vec<[f64; D]>> {
    let mut random = Pcg64Mcg::new(0x5eed);
    let mut directions: Vec<[f64; D]> = with_capacity(D + 1)?;
    while directions.len() < D {
        let mut candidate = [0.0; D].map(|_| uniform(&mut random));
        for direction in &directions {
            let along = dot(&candidate, direction);
            candidate = std::array::from_fn(|axis| candidate[axis] - along * direction[axis]);
        }
        let length = dot(&candidate, &candidate).sqrt();
        if length > 0.1 {
            directions.push(candidate.map(|x| x / length));
        }
    }
    let balance: [f64; D] =
        std::array::from_fn(|axis| -directions.iter().map(|d| d[axis]).sum::<f64>());
    let length = dot(&balance, &balance).sqrt();
    directions.push(balance.map(|x| x / length));
    Ok(directions)
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Returns a uniform number in [-1, 1).
fn uniform(random: &mut Pcg64Mcg) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that no random direction is farther than delta from the net, and some nearly so far.
    fn check_cover<const D: usize>(delta: f64) -> usize {
        let net = cage_template::<D>(delta, u64::MAX, &mut Watch::new(None)).unwrap();
        let mut random = Pcg64Mcg::new(7);
        let mut widest = 0.0f64;
        for _ in 0..20_000 {
            let x = [0.0; D].map(|_| (0..6).map(|_| uniform(&mut random)).sum::<f64>());
            let length = dot(&x, &x).sqrt();
            let distance = |t: &[f64; D]| 2.0 - 2.0 * dot(&x, t) / length;
            widest = widest.max(net.iter().map(distance).fold(f64::INFINITY, f64::min));
        }
        assert!(widest.sqrt() <= delta, "D = {D}: a distance of {} > {delta}", widest.sqrt());
        assert!(widest.sqrt() > 0.7 * delta, "D = {D}: {} points, too dense", net.len());
        for (i, a) in net.iter().enumerate() {
            assert!((dot(a, a) - 1.0).abs() < 1e-12);
            for b in &net[..i] {
                assert!(2.0 - 2.0 * dot(a, b) > 0.7 * delta * delta, "D = {D}: too close");
            }
        }
        net.len()
    }

    #[test]
    fn the_net_covers_the_sphere_and_is_packed() {
        assert_eq!(check_cover::<2>(0.5), 7);
        let sizes = [check_cover::<3>(0.5), check_cover::<4>(0.8), check_cover::<5>(1.0)];
        assert!(sizes[0] <= 36 && sizes[1] <= 40 && sizes[2] <= 40, "{sizes:?}");
    }
}
