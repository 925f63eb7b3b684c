//! Any mesher's output, measured in one way for all.

use crate::inputs::Points;
use netmesh::Triangulation;
use std::collections::HashSet;

#[derive(Clone, Debug)]
pub struct Simplicial {
    pub dim: usize,
    pub points: Vec<f64>,
    /// `simplices x (dim + 1)`.
    pub simplices: Vec<u32>,
}

impl From<&Triangulation> for Simplicial {
    fn from(mesh: &Triangulation) -> Self {
        Self { dim: mesh.dim, points: mesh.points.clone(), simplices: mesh.simplices.clone() }
    }
}

/// Figures that are compared between meshers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    pub vertices: usize,
    /// Vertices in the inputs' bounding box.
    pub inside: usize,
    pub simplices: usize,
    /// Distinct inputs that are not vertices, bit for bit.
    pub lost: usize,
    /// Largest circumradius over shortest edge of the simplices whose vertices are all in the
    /// inputs' bounding box; 0 if none.
    pub worst_radius_edge: f64,
}

impl Simplicial {
    pub fn figures(&self, inputs: &Points) -> Figures {
        let bounds = inputs.bounding_box();
        let is_inside: Vec<bool> = self
            .points
            .chunks_exact(self.dim)
            .map(|point| point.iter().zip(&bounds).all(|(x, [low, high])| low <= x && x <= high))
            .collect();
        let worst = self
            .simplices
            .chunks_exact(self.dim + 1)
            .filter(|simplex| simplex.iter().all(|&v| is_inside[v as usize]))
            .map(|simplex| self.radius_edge(simplex))
            .fold(0.0, f64::max);
        Figures {
            vertices: is_inside.len(),
            inside: is_inside.iter().filter(|&&inside| inside).count(),
            simplices: self.simplices.len() / (self.dim + 1),
            lost: self.lost(inputs),
            worst_radius_edge: worst,
        }
    }

    fn lost(&self, inputs: &Points) -> usize {
        let key = |point: &[f64]| point.iter().map(|x| (x + 0.0).to_bits()).collect::<Vec<u64>>();
        let vertices: HashSet<Vec<u64>> = self.points.chunks_exact(self.dim).map(key).collect();
        let wanted: HashSet<Vec<u64>> = inputs.iter().map(key).collect();
        wanted.iter().filter(|point| !vertices.contains(*point)).count()
    }

    /// Circumradius over shortest edge; infinite for a flat simplex. Lengths are relative to the
    /// largest difference of coordinates, since the squares of the inputs' may leave the doubles.
    fn radius_edge(&self, simplex: &[u32]) -> f64 {
        let d = self.dim;
        let point = |i: usize| &self.points[simplex[i] as usize * d..][..d];
        let edge = |i: usize, j: usize| point(i).iter().zip(point(j)).map(|(x, y)| x - y);
        let unit = (1..=d).flat_map(|i| edge(i, 0)).fold(0.0, |most: f64, x| most.max(x.abs()));
        let edges: Vec<Vec<f64>> =
            (1..=d).map(|i| edge(i, 0).map(|x| x / unit).collect()).collect();
        let Some(center) = solve(&edges) else { return f64::INFINITY };
        let mut shortest = f64::INFINITY;
        for i in 0..=d {
            for j in 0..i {
                shortest = edge(i, j).map(|x| (x / unit).powi(2)).sum::<f64>().min(shortest);
            }
        }
        (center.iter().map(|x| x * x).sum::<f64>() / shortest).sqrt()
    }
}

/// The c with 2 e.c = e.e for each row e: a simplex's circumcentre seen from the vertex that its
/// edges start at. Gauss with pivoting; none if the edges do not span the space.
fn solve(edges: &[Vec<f64>]) -> Option<Vec<f64>> {
    let d = edges.len();
    let mut rows: Vec<Vec<f64>> = edges
        .iter()
        .map(|edge| {
            let half = 0.5 * edge.iter().map(|x| x * x).sum::<f64>();
            edge.iter().copied().chain([half]).collect()
        })
        .collect();
    for column in 0..d {
        let pivot =
            (column..d).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let pivot_row = rows[column].clone();
        if pivot_row[column] == 0.0 {
            return None;
        }
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot_row[column];
            if i != column {
                row.iter_mut().zip(&pivot_row).for_each(|(x, p)| *x -= factor * p);
            }
        }
    }
    Some((0..d).map(|i| rows[i][d] / rows[i][i]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An equilateral triangle and a right one on its base.
    fn two_triangles() -> Simplicial {
        let apex = 0.75f64.sqrt();
        Simplicial {
            dim: 2,
            points: vec![0.0, 0.0, 1.0, 0.0, 0.5, apex, 0.0, -1.0],
            simplices: vec![0, 1, 2, 0, 3, 1],
        }
    }

    #[test]
    fn ratios_are_those_of_known_triangles() {
        let mesh = two_triangles();
        assert!((mesh.radius_edge(&[0, 1, 2]) - 1.0 / 3f64.sqrt()).abs() < 1e-15);
        assert!((mesh.radius_edge(&[0, 3, 1]) - 0.5f64.sqrt()).abs() < 1e-15);
        for scale in [1e-200, 1e200] {
            let points = mesh.points.iter().map(|x| scale * x).collect();
            let scaled = Simplicial { points, ..mesh.clone() };
            assert!((scaled.radius_edge(&[0, 1, 2]) - 1.0 / 3f64.sqrt()).abs() < 1e-15);
        }
        let flat = Simplicial { points: vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0], ..mesh };
        assert_eq!(flat.radius_edge(&[0, 1, 2]), f64::INFINITY);
    }

    #[test]
    fn figures_count_what_is_inside_and_lost() {
        let inputs = Points { dim: 2, coordinates: vec![0.0, 0.0, 1.0, 0.0, 0.5, 0.9, 0.5, 0.8] };
        let figures = two_triangles().figures(&inputs);
        assert_eq!((figures.vertices, figures.inside, figures.simplices), (4, 3, 2));
        assert_eq!(figures.lost, 2);
        assert!((figures.worst_radius_edge - 1.0 / 3f64.sqrt()).abs() < 1e-15);
    }
}
