//! Distances of points from edges and triangles in space, in doubles.

use super::norm::{distance, norm};

type Point = [f64; 3];

fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Returns the scalar product of two vectors.
pub fn dot(u: &Point, v: &Point) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// Returns the vector product of two vectors.
pub fn cross(u: &Point, v: &Point) -> Point {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        u[i] * v[j] - u[j] * v[i]
    })
}

/// Returns a vector as a direction, with its length.
fn unit(vector: Point) -> (Point, f64) {
    let length = norm(&vector);
    (if length > 0.0 { vector.map(|x| x / length) } else { vector }, length)
}

/// Returns the distance of `x` from the edge between two points, but for roundings.
pub fn distance_to_edge(x: &Point, [a, b]: [&Point; 2]) -> f64 {
    let (way, length) = unit(minus(b, a));
    let along = dot(&minus(x, a), &way).clamp(0.0, length);
    distance(x, &std::array::from_fn(|k| a[k] + along * way[k]))
}

/// Returns the distance of `x` from the line through two points, but for roundings; from the first
/// if they are one.
pub fn distance_to_line(x: &Point, [a, b]: [&Point; 2]) -> f64 {
    let (way, length) = unit(minus(b, a));
    if length > 0.0 { norm(&cross(&way, &minus(x, a))) } else { distance(x, a) }
}

/// Returns the point of the line through two points that is nearest to `x`, but for roundings; the
/// first if they are one.
pub fn foot_on_line(x: &Point, [a, b]: [&Point; 2]) -> Point {
    let way = unit(minus(b, a)).0;
    let along = dot(&minus(x, a), &way);
    std::array::from_fn(|k| a[k] + along * way[k])
}

/// Returns the distance of `x` from a triangle, but for roundings.
pub fn distance_to_triangle(x: &Point, [a, b, c]: [&Point; 3]) -> f64 {
    let normal = unit(cross(&unit(minus(b, a)).0, &unit(minus(c, a)).0)).0;
    let is_left = |from: &Point, to: &Point| {
        dot(&cross(&unit(minus(to, from)).0, &unit(minus(x, from)).0), &normal) >= 0.0
    };
    if norm(&normal) > 0.0 && is_left(a, b) && is_left(b, c) && is_left(c, a) {
        return dot(&minus(x, a), &normal).abs();
    }
    let edges = [[a, b], [b, c], [c, a]].map(|edge| distance_to_edge(x, edge));
    edges.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    #[test]
    fn triangles_are_as_near_as_the_nearest_of_many_points_of_theirs() {
        let mut random = Random(7);
        for _ in 0..200 {
            let mut point = || -> Point { std::array::from_fn(|_| random.unit()) };
            let (x, [a, b, c]) = (point(), [point(), point(), point()]);
            let own = distance_to_triangle(&x, [&a, &b, &c]);
            let steps = 60;
            let of_grid = (0..=steps).flat_map(|i| (0..=steps - i).map(move |j| (i, j)));
            let nearest = of_grid.fold(f64::INFINITY, |least, (i, j)| {
                let [i, j] = [i, j].map(|part| f64::from(part) / f64::from(steps));
                let y = std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k]));
                least.min(distance(&x, &y))
            });
            let size = distance(&a, &b).max(distance(&a, &c));
            assert!(own <= nearest + 1e-12 && nearest <= own + size / 20.0, "{own} {nearest}");
        }
    }

    #[test]
    fn feet_may_be_beyond_the_ends() {
        let [a, b] = [[1.0, 1.0, 0.0], [3.0, 1.0, 0.0]];
        assert_eq!(foot_on_line(&[7.0, 4.0, -2.0], [&a, &b]), [7.0, 1.0, 0.0]);
        assert_eq!(foot_on_line(&[-7.0, 4.0, -2.0], [&b, &a]), [-7.0, 1.0, 0.0]);
        assert_eq!(foot_on_line(&[7.0, 4.0, -2.0], [&a, &a]), a);
    }

    #[test]
    fn a_triangle_without_area_is_its_edges() {
        let points: [Point; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        assert_eq!(distance_to_triangle(&[1.5, 2.0, 0.0], points.each_ref()), 2.0);
        assert_eq!(distance_to_triangle(&[3.0, 0.0, 0.0], points.each_ref()), 1.0);
        assert_eq!(distance_to_edge(&[3.0, 4.0, 0.0], [&points[0], &points[0]]), 5.0);
        assert_eq!(distance_to_line(&[3.0, 4.0, 3.0], [&points[2], &points[1]]), 5.0);
        assert_eq!(distance_to_line(&[3.0, 4.0, 0.0], [&points[0], &points[0]]), 5.0);
    }
}
