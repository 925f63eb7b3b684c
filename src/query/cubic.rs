//! Smooth interpolation in the plane: the split of each triangle at its centroid into three, with a
//! cubic on each (R. W. Clough, J. L. Tocher, "Finite element stiffness matrices for analysis of
//! plates in bending", 1965), by its Bézier ordinates (G. Farin, "Triangular Bernstein-Bézier
//! patches", 1986).
//!
//! Values and gradients at the vertices leave one ordinate an edge to choose. It is the one for
//! which the derivative across the edge is linear along it, in a direction that both triangles at
//! the edge agree on and that affine maps take along: from the one apex to the other. At the
//! boundary it is the direction from the middle of the edge to the centroid (P. Alfeld, "A
//! trivariate Clough-Tocher scheme for tetrahedral data", 1984).

use super::barycentric::coordinates_in;
use super::interpolate::Values;
use super::threads::{Work, on_threads};
use super::triangles::Triangles;
use crate::error::{Error, Result, message};
use crate::mesh::NONE;

/// Values and gradients at the vertices of a triangulation of the plane, from which there is a
/// function with a continuous gradient.
#[derive(Clone, Copy, Debug)]
pub struct Cubics<'a> {
    pub triangles: Triangles<'a>,
    pub values: Values<'a>,
    /// `vertices x components x 2`.
    pub gradients: &'a [f64],
}

impl Cubics<'_> {
    /// Writes the values of the function (`points x components`) at points that are given by a
    /// triangle and barycentric coordinates there (`points x 3`); NaN where the triangle is
    /// [`NONE`].
    ///
    /// # Errors
    /// `InvalidArgument` (a length, an id out of range), `NonFinite` (a coordinate of a vertex),
    /// `Cancelled` (by what stops the work), `OutOfMemory`.
    pub fn evaluate<'a>(
        &self,
        simplices: &[u32],
        weights: &[f64],
        work: impl Into<Work<'a>>,
        out: &mut [f64],
    ) -> Result<()> {
        let work = work.into();
        self.check(simplices, weights, out)?;
        let (threads, piece) = work.shares(simplices.len());
        let components = self.values.components;
        let places = simplices.chunks(piece).zip(weights.chunks(3 * piece));
        let pieces = places.zip(out.chunks_mut(components * piece));
        on_threads(threads, pieces, |_: &mut (), ((simplices, weights), out)| {
            let places = simplices.iter().zip(weights.chunks_exact(3));
            for ((&triangle, weights), out) in places.zip(out.chunks_mut(components)) {
                if work.stop.is_set() {
                    break;
                }
                match triangle {
                    NONE => out.fill(f64::NAN),
                    _ => self.evaluate_at(triangle, [weights[0], weights[1], weights[2]], out),
                }
            }
            Ok(())
        })?;
        work.check()
    }

    fn check(&self, simplices: &[u32], weights: &[f64], out: &[f64]) -> Result<()> {
        let (vertices, components) = (self.triangles.vertex_count(), self.values.components);
        let (count, triangles) = (simplices.len(), self.triangles.count());
        let lengths = [
            ("gradients", self.gradients.len(), vertices * components * 2),
            ("weights", weights.len(), count * 3),
            ("out", out.len(), count * components),
        ];
        if let Some((name, length, wanted)) = lengths.into_iter().find(|(_, is, must)| is != must) {
            let message = message!("{name} has length {length}; it must be {wanted}");
            return Err(Error::invalid(message));
        }
        let is_outside = |&id: &u32| id as usize >= triangles && id != NONE;
        if let Some(at) = simplices.iter().position(is_outside) {
            return Err(Error::invalid(message!(
                "simplices[{at}] is {}; there are {triangles} triangles",
                simplices[at]
            )));
        }
        self.triangles.check_around(self.values, simplices)
    }

    /// Writes the values at one point of a triangle.
    fn evaluate_at(&self, triangle: u32, weights: [f64; 3], out: &mut [f64]) {
        let vertices = self.triangles.vertices(triangle);
        let points = vertices.map(|vertex| self.triangles.point(vertex));
        let directions: [[f64; 2]; 3] = std::array::from_fn(|k| self.direction(triangle, k));
        // The third part of the triangle that holds the point lies at the edge opposite the vertex
        // that weighs least.
        let least = (0..3).fold(0, |k, i| if weights[i] < weights[k] { i } else { k });
        let [i, j] = [(least + 1) % 3, (least + 2) % 3];
        let place =
            [weights[i] - weights[least], weights[j] - weights[least], 3.0 * weights[least]];
        for (component, out) in out.iter_mut().enumerate() {
            let values = vertices.map(|vertex| self.values.of(vertex)[component]);
            let gradients = vertices.map(|vertex| self.gradient(vertex, component));
            let net = Net::new(points, values, gradients, directions);
            *out = net.value(least, place);
        }
    }

    fn gradient(&self, vertex: u32, component: usize) -> [f64; 2] {
        let at = (vertex as usize * self.values.components + component) * 2;
        [self.gradients[at], self.gradients[at + 1]]
    }

    /// Returns the direction across the edge opposite vertex `k` as weights of the vertices that
    /// follow it in turn; the centroid has weight 1, so that they sum to -1.
    fn direction(&self, triangle: u32, k: usize) -> [f64; 2] {
        const TO_CENTROID: [f64; 2] = [-0.5, -0.5];
        let neighbor = self.triangles.neighbors_of(triangle)[k];
        if neighbor == NONE {
            return TO_CENTROID;
        }
        let own = self.triangles.vertices(triangle);
        let others = self.triangles.vertices(neighbor);
        let Some(&apex) = others.iter().find(|vertex| !own.contains(vertex)) else {
            return TO_CENTROID;
        };
        let points = own.map(|vertex| self.triangles.point(vertex));
        let weights = coordinates_in(&points, 0b111, self.triangles.point(apex));
        // The apex less vertex k, which is three times the centroid less the other two.
        let of_apex = 1.0 - weights[k];
        let sum = 3.0 * of_apex;
        // A neighbour on the same side is none that a triangulation has.
        if of_apex.is_nan() || of_apex <= 1.0 {
            return TO_CENTROID;
        }
        [(k + 1) % 3, (k + 2) % 3].map(|i| -(weights[i] + of_apex) / sum)
    }
}

/// Bézier ordinates of the three cubics on a triangle.
struct Net {
    values: [f64; 3],
    /// At a third of the way from vertex i to the one that follows it, and to the one before.
    along: [[f64; 2]; 3],
    /// At a third of the way from each vertex to the centroid.
    inward: [f64; 3],
    /// In the middle of the part opposite each vertex.
    middle: [f64; 3],
    /// At two thirds of the way from each vertex to the centroid.
    inner: [f64; 3],
    centroid: f64,
}

impl Net {
    fn new(
        points: [&[f64; 2]; 3],
        values: [f64; 3],
        gradients: [[f64; 2]; 3],
        directions: [[f64; 2]; 3],
    ) -> Self {
        let ordinate = |from: usize, to: usize| {
            let edge = [points[to][0] - points[from][0], points[to][1] - points[from][1]];
            values[from] + (gradients[from][0] * edge[0] + gradients[from][1] * edge[1]) / 3.0
        };
        let along: [[f64; 2]; 3] =
            std::array::from_fn(|i| [ordinate(i, (i + 1) % 3), ordinate(i, (i + 2) % 3)]);
        let inward: [f64; 3] =
            std::array::from_fn(|i| (values[i] + along[i][0] + along[i][1]) / 3.0);
        // The derivative in the direction a V_i + b V_j + S has the ordinates that follow at V_i,
        // in the middle and at V_j; the one in the middle must be the mean of the others.
        let middle: [f64; 3] = std::array::from_fn(|k| {
            let ([i, j], [a, b]) = ([(k + 1) % 3, (k + 2) % 3], directions[k]);
            let (after_i, before_j) = (along[i][0], along[j][1]);
            let at_i = a * values[i] + b * after_i + inward[i];
            let at_j = a * before_j + b * values[j] + inward[j];
            (at_i + at_j) / 2.0 - a * after_i - b * before_j
        });
        let inner: [f64; 3] =
            std::array::from_fn(|i| (inward[i] + middle[(i + 1) % 3] + middle[(i + 2) % 3]) / 3.0);
        let centroid = (inner[0] + inner[1] + inner[2]) / 3.0;
        Self { values, along, inward, middle, inner, centroid }
    }

    /// Returns the value in the part opposite vertex `k`, at the barycentric coordinates of the
    /// vertices that follow it and of the centroid.
    fn value(&self, k: usize, [u, v, w]: [f64; 3]) -> f64 {
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        let edge = u * u * (u * self.values[i] + 3.0 * v * self.along[i][0])
            + v * v * (v * self.values[j] + 3.0 * u * self.along[j][1]);
        let first = u * u * self.inward[i] + 2.0 * u * v * self.middle[k] + v * v * self.inward[j];
        let second = u * self.inner[i] + v * self.inner[j];
        edge + w * (3.0 * first + w * (3.0 * second + w * self.centroid))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{Family, Random, points};
    use crate::query::tests::{delaunay, meshed};
    use crate::{ErrorKind, Mesh, Triangulation};

    fn mesh() -> Mesh {
        meshed(&points::<2>(Family::Uniform, 60, &mut Random(5)), &delaunay()).unwrap()
    }

    fn triangles(mesh: &Triangulation) -> Triangles<'_> {
        Triangles { points: &mesh.points, simplices: &mesh.simplices, neighbors: &mesh.neighbors }
    }

    /// Returns the value at a place in a triangle, that is, also a little beyond it.
    fn at(cubics: &Cubics<'_>, triangle: u32, weights: [f64; 3]) -> f64 {
        let mut out = [0.0];
        cubics.evaluate(&[triangle], &weights, 1, &mut out).unwrap();
        out[0]
    }

    fn place(triangles: Triangles<'_>, triangle: u32, weights: [f64; 3]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (&vertex, weight) in triangles.vertices(triangle).iter().zip(weights) {
            (0..2).for_each(|axis| sum[axis] += weight * triangles.point(vertex)[axis]);
        }
        sum
    }

    /// Quadratic functions have derivatives across edges that are linear along them.
    #[test]
    fn quadratic_functions_are_reproduced() {
        let mesh = mesh();
        let triangles = triangles(mesh.triangulation().unwrap());
        let value = |[x, y]: [f64; 2]| [3.0 * x * x - x * y + y, 2.0 * y * y - 1.0];
        let gradient = |[x, y]: [f64; 2]| [6.0 * x - y, 1.0 - x, 0.0, 4.0 * y];
        let all = (0..triangles.vertex_count() as u32).map(|vertex| *triangles.point(vertex));
        let values: Vec<f64> = all.clone().flat_map(value).collect();
        let gradients: Vec<f64> = all.flat_map(gradient).collect();
        let values = Values { components: 2, values: &values };
        let cubics = Cubics { triangles, values, gradients: &gradients };
        let mut random = Random(9);
        let mut size = 0.0f64;
        for triangle in 0..triangles.count() as u32 {
            let parts = [0; 3].map(|_| 1.0 + random.unit());
            let sum = parts[0] + parts[1] + parts[2];
            let weights = parts.map(|part| part / sum);
            let mut out = [0.0; 2];
            cubics.evaluate(&[triangle], &weights, 1, &mut out).unwrap();
            let expected = value(place(triangles, triangle, weights));
            for (found, expected) in out.into_iter().zip(expected) {
                size = size.max(expected.abs());
                assert!((found - expected).abs() < 1e-12 * (1.0 + size), "{found} {expected}");
            }
        }
        assert!(size > 1.0);
    }

    /// Across edges and within triangles values and gradients agree, whatever the values given;
    /// and at vertices they are these.
    #[test]
    fn the_gradient_is_continuous() {
        let mesh = mesh();
        let triangles = triangles(mesh.triangulation().unwrap());
        let mut random = Random(2);
        let values: Vec<f64> = (0..triangles.vertex_count()).map(|_| random.unit()).collect();
        let gradients: Vec<f64> = (0..2 * values.len()).map(|_| random.unit()).collect();
        let given = Values { components: 1, values: &values };
        let cubics = Cubics { triangles, values: given, gradients: &gradients };
        let mut compared = 0;
        for triangle in 0..triangles.count() as u32 {
            let own = triangles.vertices(triangle);
            for k in 0..3 {
                let mut corner = [0.0; 3];
                corner[k] = 1.0;
                assert_eq!(at(&cubics, triangle, corner), values[own[k] as usize]);
                let neighbor = triangles.neighbors_of(triangle)[k];
                if neighbor == NONE {
                    continue;
                }
                let points = own.map(|vertex| triangles.point(vertex));
                let others = triangles.vertices(neighbor).map(|vertex| triangles.point(vertex));
                // On the edge, and a step to either side of it, by both triangles' cubics: these go
                // on beyond their triangles as they are.
                let mut on_edge = [0.3; 3];
                (on_edge[k], on_edge[(k + 1) % 3]) = (0.0, 0.7);
                let q = place(triangles, triangle, on_edge);
                let size = place(triangles, triangle, [1.0 / 3.0; 3]);
                let step = [1e-6 * (size[0] - q[0]), 1e-6 * (size[1] - q[1])];
                let there = |side: f64| [q[0] + side * step[0], q[1] + side * step[1]];
                let value = |triangle, points: &[&[f64; 2]; 3], side| {
                    at(&cubics, triangle, {
                        let weights = coordinates_in(points, 0b111, &there(side));
                        [weights[0], weights[1], weights[2]]
                    })
                };
                let by_own = [-1.0, 0.0, 1.0].map(|side| value(triangle, &points, side));
                let by_other = [-1.0, 0.0, 1.0].map(|side| value(neighbor, &others, side));
                assert!((by_own[1] - by_other[1]).abs() < 1e-13);
                let slopes = [by_own, by_other].map(|[before, _, after]| (after - before) / 2e-6);
                assert!((slopes[0] - slopes[1]).abs() < 1e-6, "{slopes:?}");
                compared += 1;
            }
            // Beside a line from a vertex to the centroid.
            let along = [0.6, 0.2, 0.2];
            let across = |side: f64| [along[0], along[1] + side * 1e-6, along[2] - side * 1e-6];
            let [before, on, after] =
                [-1.0, 0.0, 1.0].map(|side| at(&cubics, triangle, across(side)));
            assert!((after - 2.0 * on + before).abs() < 1e-9, "{}", after - 2.0 * on + before);
        }
        assert!(compared > 100);
    }

    #[test]
    fn what_is_outside_or_wrong() {
        let mesh = mesh();
        let triangles = triangles(mesh.triangulation().unwrap());
        let values = vec![1.0; triangles.vertex_count()];
        let gradients = vec![0.0; 2 * values.len()];
        let given = Values { components: 1, values: &values };
        let cubics = Cubics { triangles, values: given, gradients: &gradients };
        assert!(at(&cubics, NONE, [f64::NAN; 3]).is_nan());
        let refusal = |cubics: Cubics<'_>, simplex: u32, weights: &[f64], out: &mut [f64]| {
            let error = cubics.evaluate(&[simplex], weights, 1, out).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            error.message().to_owned()
        };
        let weights = [1.0, 0.0, 0.0];
        let out = &mut [0.0];
        assert!(
            refusal(cubics, 9999, &weights, out).starts_with("simplices[0] is 9999; there are")
        );
        assert_eq!(refusal(cubics, 0, &[], out), "weights has length 0; it must be 3");
        assert_eq!(refusal(cubics, 0, &weights, &mut []), "out has length 0; it must be 1");
        let short = Cubics { gradients: &gradients[1..], ..cubics };
        assert_eq!(refusal(short, 0, &weights, out), "gradients has length 119; it must be 120");
        // What is wrong with the triangle that is asked for, or with one beside it.
        let last = triangles.count() as u32 - 1;
        let beside = triangles.neighbors_of(last).iter().copied().find(|&n| n != NONE).unwrap();
        for (asked, wrong) in [(last, last), (last, beside), (NONE, last)] {
            let mut simplices = triangles.simplices.to_vec();
            simplices[3 * wrong as usize + 1] = 77;
            let of_other = Triangles { simplices: &simplices, ..triangles };
            let other = Cubics { triangles: of_other, ..cubics };
            if asked == NONE {
                assert!(at(&other, asked, weights).is_nan());
                continue;
            }
            let told = format!("simplices[{wrong}] has the vertex 77; there are 60");
            assert_eq!(refusal(other, asked, &weights, out), told);
        }
        let mut neighbors = triangles.neighbors.to_vec();
        neighbors[3 * last as usize] = 9999;
        let other =
            Cubics { triangles: Triangles { neighbors: &neighbors, ..triangles }, ..cubics };
        let told = refusal(other, last, &weights, out);
        assert!(told.starts_with(&format!("neighbors[{last}] has the triangle 9999")), "{told}");
        let mut points = triangles.points.to_vec();
        let vertex = triangles.vertices(beside)[0];
        points[2 * vertex as usize] = f64::NAN;
        let other = Cubics { triangles: Triangles { points: &points, ..triangles }, ..cubics };
        let error = other.evaluate(&[last], &weights, 1, out).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NonFinite, "{error}");
    }
}
