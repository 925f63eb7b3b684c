//! Gradients at the vertices of a triangulation of the plane, estimated from the values there:
//! those for which cubic curves along the edges bend the least in all (G. M. Nielson, "A method for
//! interpolating scattered data based upon a minimum norm network", 1983; R. J. Renka, A. K. Cline,
//! "A triangle-based C1 interpolation method", 1984).
//!
//! The integral of the squared second derivative along an edge of length L, of the cubic with the
//! values f, f' and the derivatives d, d' in the direction e of the edge (which is L long), is
//! (12 (f' - f)^2 - 12 (f' - f) (d + d') + 4 (d^2 + d d' + d'^2)) / L^3. As a function of the
//! gradient g at one end, d = e.g, the sum over the edges there is least where the sum of
//! e (2 e.g - 3 (f' - f) + d') / L^3 vanishes. Vertices take their gradients from this in turn,
//! until these change no more.

use super::interpolate::Values;
use super::threads::Work;
use super::triangles::Triangles;
use super::unit::largest;
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, copied, filled};
use crate::numerics::norm;

/// Condition for the end of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Largest change of a gradient in the last sweep, relative to its largest component where that
    /// is above 1.
    pub tolerance: f64,
    /// Largest number of sweeps over all vertices, for each component of the values.
    pub max_iterations: u32,
}

/// Relative determinant below which the edges at a vertex count as parallel.
const PARALLEL: f64 = 1e-15;

/// Edges round each vertex, with the weights that they have there.
struct Edges {
    /// Vertex -> where its edges begin; one more than there are vertices.
    starts: Vec<usize>,
    ends: Vec<u32>,
    /// Vectors e / L^3, in units that the vertex has.
    weights: Vec<[f64; 2]>,
    /// Inverses of the matrices 2 sum(e e^T) / L^3 at the vertices, by their entries 00, 01, 11, in
    /// the reciprocal units.
    inverses: Vec<[f64; 3]>,
}

/// Writes a gradient for each vertex and component (`vertices x components x 2`); zero at vertices
/// without triangles. Returns the number of components for which the sweeps ended before the
/// gradients had converged.
///
/// # Errors
/// `InvalidArgument` (a length, an id out of range, a tolerance that is negative or NaN),
/// `NonFinite` (a coordinate), `Cancelled` (by what stops the work), `OutOfMemory`.
pub fn estimate_gradients<'a>(
    triangles: Triangles<'_>,
    values: Values<'_>,
    convergence: Convergence,
    work: impl Into<Work<'a>>,
    gradients: &mut [f64],
) -> Result<usize> {
    let work = work.into();
    triangles.check(values)?;
    let (vertices, components) = (triangles.vertex_count(), values.components);
    if gradients.len() != vertices * components * 2 {
        return Err(Error::invalid(message!(
            "gradients has length {}; it must be vertices x components x 2 = {vertices} x \
             {components} x 2",
            gradients.len()
        )));
    }
    let Convergence { tolerance, max_iterations } = convergence;
    if tolerance.is_nan() || tolerance < 0.0 {
        let message = message!("tolerance is {tolerance}; it must be at least 0");
        return Err(Error::invalid(message));
    }
    gradients.fill(0.0);
    let edges = Edges::new(triangles)?;
    let mut unconverged = 0;
    for component in 0..components {
        let mut is_done = vertices == 0;
        for _ in 0..max_iterations {
            if is_done || work.stop.is_set() {
                break;
            }
            let change = edges.sweep(triangles, values, component, work, gradients);
            is_done = change < tolerance;
        }
        unconverged += usize::from(!is_done);
    }
    work.check()?;
    Ok(unconverged)
}

impl Edges {
    fn new(triangles: Triangles<'_>) -> AllocResult<Self> {
        let vertices = triangles.vertex_count();
        let mut starts = filled(vertices + 1, 0usize)?;
        each_edge(triangles, |a, _| starts[a as usize + 1] += 1);
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut ends = filled(starts[vertices], 0)?;
        let mut next = copied(&starts)?;
        each_edge(triangles, |a, b| {
            ends[next[a as usize]] = b;
            next[a as usize] += 1;
        });
        let weights = filled(ends.len(), [0.0; 2])?;
        let inverses = filled(vertices, [0.0; 3])?;
        let mut edges = Self { starts, ends, weights, inverses };
        (0..vertices as u32).for_each(|vertex| edges.weigh(triangles, vertex));
        Ok(edges)
    }

    /// Sets the weights of the edges at a vertex, and the inverse of its matrix.
    fn weigh(&mut self, triangles: Triangles<'_>, vertex: u32) {
        let own = self.starts[vertex as usize]..self.starts[vertex as usize + 1];
        let edge = |to: u32| difference(triangles, vertex, to);
        let lengths = self.ends[own.clone()].iter().map(|&to| norm(&edge(to)));
        let shortest = lengths.filter(|&length| length > 0.0).fold(f64::INFINITY, f64::min);
        let mut matrix = [0.0; 3];
        for at in own {
            // Lengths in units of the shortest one: neither cubes nor squares leave the doubles.
            let edge = edge(self.ends[at]).map(|x| x / shortest);
            let cube = norm(&edge).powi(3);
            if cube == 0.0 || !cube.is_finite() {
                continue;
            }
            let [x, y] = edge.map(|x| x / cube);
            self.weights[at] = [x, y];
            matrix[0] += 2.0 * x * edge[0];
            matrix[1] += 2.0 * x * edge[1];
            matrix[2] += 2.0 * y * edge[1];
        }
        self.inverses[vertex as usize] = inverse(matrix).map(|x| x / shortest);
    }

    /// Gives each vertex in turn the gradient that its neighbours' ask for. Returns the largest
    /// relative change.
    fn sweep(
        &self,
        triangles: Triangles<'_>,
        values: Values<'_>,
        component: usize,
        work: Work<'_>,
        gradients: &mut [f64],
    ) -> f64 {
        let value = |vertex: u32| values.of(vertex)[component];
        let place = |vertex: u32| (vertex as usize * values.components + component) * 2;
        let mut largest_change = 0.0f64;
        for vertex in 0..triangles.vertex_count() as u32 {
            if vertex % 1024 == 0 && work.stop.is_set() {
                break;
            }
            let mut right = [0.0; 2];
            for at in self.starts[vertex as usize]..self.starts[vertex as usize + 1] {
                let (to, weight) = (self.ends[at], self.weights[at]);
                let edge = difference(triangles, vertex, to);
                let there = &gradients[place(to)..][..2];
                let slope =
                    3.0 * (value(to) - value(vertex)) - (edge[0] * there[0] + edge[1] * there[1]);
                right[0] += weight[0] * slope;
                right[1] += weight[1] * slope;
            }
            let [a, b, c] = self.inverses[vertex as usize];
            let found = [a * right[0] + b * right[1], b * right[0] + c * right[1]];
            let own = &mut gradients[place(vertex)..][..2];
            let change = largest(&[own[0] - found[0], own[1] - found[1]]);
            largest_change = largest_change.max(change / largest(&found).max(1.0));
            own.copy_from_slice(&found);
        }
        largest_change
    }
}

/// Calls `act` with both ends of each edge, from each of them.
fn each_edge(triangles: Triangles<'_>, mut act: impl FnMut(u32, u32)) {
    for triangle in 0..triangles.count() as u32 {
        let vertices = triangles.vertices(triangle);
        for i in (0..3).filter(|&i| triangles.tells_edge(triangle, i)) {
            let (a, b) = (vertices[(i + 1) % 3], vertices[(i + 2) % 3]);
            act(a, b);
            act(b, a);
        }
    }
}

fn difference(triangles: Triangles<'_>, from: u32, to: u32) -> [f64; 2] {
    let (from, to) = (triangles.point(from), triangles.point(to));
    [to[0] - from[0], to[1] - from[1]]
}

/// Returns the inverse of a symmetric matrix without negative eigenvalues; of one whose determinant
/// is lost in roundings the inverse on the line that it has, and of zero, zero.
fn inverse([a, b, c]: [f64; 3]) -> [f64; 3] {
    let (trace, determinant) = (a + c, a * c - b * b);
    if trace == 0.0 {
        return [0.0; 3];
    }
    if determinant > PARALLEL * trace * trace {
        return [c / determinant, -b / determinant, a / determinant];
    }
    [a, b, c].map(|x| x / trace / trace)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::NONE;
    use crate::numerics::testing::Random;

    const CONVERGENCE: Convergence = Convergence { tolerance: 1e-13, max_iterations: 10_000 };

    /// Returns a fan of six triangles round the origin, and a vertex that no triangle has.
    fn fan() -> ([f64; 16], Vec<u32>, Vec<u32>) {
        let points =
            [0.0, 0.0, 2.0, 0.1, 1.0, 1.5, -0.7, 1.2, -1.5, 0.0, -0.9, -1.0, 0.8, -1.1, 7.0, 7.0];
        let (mut simplices, mut neighbors) = (Vec::new(), Vec::new());
        for i in 0..6u32 {
            let next = (i + 1) % 6;
            simplices.extend([0, 1 + i, 1 + next]);
            neighbors.extend([NONE, next, (i + 5) % 6]);
        }
        (points, simplices, neighbors)
    }

    /// Returns the integral of the squared second derivatives along all edges, by Simpson's rule,
    /// which is exact for it.
    fn bending(triangles: Triangles<'_>, values: &[f64], gradients: &[f64]) -> f64 {
        let mut sum = 0.0;
        each_edge(triangles, |a, b| {
            let edge = difference(triangles, a, b);
            let slope = |v: u32| {
                edge[0] * gradients[2 * v as usize] + edge[1] * gradients[2 * v as usize + 1]
            };
            let rise = values[b as usize] - values[a as usize];
            let second = |t: f64| {
                rise * (6.0 - 12.0 * t) + slope(a) * (6.0 * t - 4.0) + slope(b) * (6.0 * t - 2.0)
            };
            let squares = [0.0, 0.5, 1.0].map(|t| second(t) * second(t));
            let length = norm(&edge);
            sum += (squares[0] + 4.0 * squares[1] + squares[2]) / 6.0 / length.powi(3);
        });
        sum
    }

    #[test]
    fn gradients_bend_the_edges_least() {
        let (points, simplices, neighbors) = fan();
        let triangles = Triangles { points: &points, simplices: &simplices, neighbors: &neighbors };
        let values = [0.3, -1.0, 2.0, 0.7, 1.1, -0.4, 0.9, 5.0];
        let mut gradients = [0.0; 16];
        let given = Values { components: 1, values: &values };
        let missed = estimate_gradients(triangles, given, CONVERGENCE, 1, &mut gradients);
        assert_eq!(missed.unwrap(), 0);
        let least = bending(triangles, &values, &gradients);
        for at in 0..14 {
            for step in [1e-3, -1e-3] {
                let mut other = gradients;
                other[at] += step;
                assert!(bending(triangles, &values, &other) > least, "{at}");
            }
        }
        assert_eq!(gradients[14..], [0.0, 0.0]);
    }

    /// Linear functions have one gradient everywhere, whatever the unit of lengths.
    #[test]
    fn gradients_of_linear_functions_are_exact() {
        for scale in [1.0, 1e-120, 1e120] {
            let (points, simplices, neighbors) = fan();
            let points = points.map(|x| x * scale);
            let triangles =
                Triangles { points: &points, simplices: &simplices, neighbors: &neighbors };
            let value = |p: &[f64]| [2.0 * p[0] / scale - 3.0 * p[1] / scale, p[1] / scale];
            let values: Vec<f64> = points.chunks(2).flat_map(value).collect();
            let given = Values { components: 2, values: &values };
            let mut gradients = [0.0; 32];
            // Changes are absolute where gradients are small.
            let convergence = Convergence { tolerance: 1e-13 / scale.max(1.0), ..CONVERGENCE };
            estimate_gradients(triangles, given, convergence, 1, &mut gradients).unwrap();
            for (at, gradient) in gradients[..28].iter().enumerate() {
                let expected = [2.0, -3.0, 0.0, 1.0][at % 4];
                assert!((gradient * scale - expected).abs() < 1e-11, "{scale} {at} {gradient}");
            }
        }
    }

    #[test]
    fn parallel_edges_have_the_gradient_along_them() {
        let inverse = inverse([4.0, 8.0, 16.0]);
        let product =
            |x: f64, y: f64| [inverse[0] * x + inverse[1] * y, inverse[1] * x + inverse[2] * y];
        // The matrix is 20 times the projection on (1, 2).
        assert_eq!(product(1.0, 2.0).map(|x| (x * 1e12).round()), [5e10, 1e11]);
        assert_eq!(product(2.0, -1.0).map(|x| (x * 1e12).round()), [0.0, 0.0]);
        assert_eq!(super::inverse([0.0; 3]), [0.0; 3]);
    }

    #[test]
    fn what_does_not_converge_is_counted_and_what_is_wrong_refused() {
        let (points, simplices, neighbors) = fan();
        let triangles = Triangles { points: &points, simplices: &simplices, neighbors: &neighbors };
        let mut random = Random(3);
        let values: Vec<f64> = (0..16).map(|_| random.integer(0, 1000) as f64).collect();
        let given = Values { components: 2, values: &values };
        let mut gradients = [0.0; 32];
        let once = Convergence { max_iterations: 1, ..CONVERGENCE };
        assert_eq!(estimate_gradients(triangles, given, once, 1, &mut gradients).unwrap(), 2);
        let refused = |triangles, values, tolerance, gradients: &mut [f64]| {
            let convergence = Convergence { tolerance, ..CONVERGENCE };
            let error = estimate_gradients(triangles, values, convergence, 1, gradients);
            error.unwrap_err().message().to_owned()
        };
        let out = &mut gradients;
        assert!(refused(triangles, given, -1.0, out).starts_with("tolerance is -1"));
        assert!(refused(triangles, given, 0.0, &mut out[1..]).starts_with("gradients has length"));
        let short = Values { values: &values[1..], ..given };
        assert!(refused(triangles, short, 0.0, out).starts_with("values has length 15"));
        let none = Values { components: 0, ..given };
        assert!(refused(triangles, none, 0.0, out).starts_with("components is 0"));
        let wrong = Triangles { simplices: &[0, 1, 8], neighbors: &[NONE; 3], ..triangles };
        assert_eq!(refused(wrong, given, 0.0, out), "simplices[0] has the vertex 8; there are 8");
        let wrong = Triangles { simplices: &[0, 1, 2], neighbors: &[NONE, 1, NONE], ..triangles };
        assert_eq!(refused(wrong, given, 0.0, out), "neighbors[0] has the triangle 1; there are 1");
        let wrong = Triangles { neighbors: &neighbors[1..], ..triangles };
        assert!(refused(wrong, given, 0.0, out).starts_with("points, simplices and neighbors"));
    }
}
