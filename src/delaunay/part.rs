//! A part of a Delaunay complex, to be refined apart from the rest: what is inserted in it must leave
//! the simplices at its rim as they are. Those keep the points of other parts out of its D-balls, so
//! that all parts together are Delaunay when they are put back.

use super::Delaunay;
use crate::complex::{Cuts, INFINITE, Names};
use crate::memory::{Fallible, TryGrow, collected, filled, with_room};
use crate::mesh::NONE;

impl<const D: usize> Delaunay<D> {
    /// See [`crate::complex::Complex::part`].
    pub fn part(
        &self,
        cuts: &Cuts<'_>,
        run: std::ops::Range<usize>,
        ids: &mut [u32],
    ) -> Fallible<(Self, Names)> {
        let (complex, names) = self.complex.part(cuts, run, ids)?;
        let points = collected(names.vertices.iter().map(|&vertex| *self.point(vertex)))?;
        let mut balls = with_room(names.simplices.len())?;
        for (own, &simplex) in names.simplices.iter().enumerate() {
            let ball = self.balls[simplex as usize];
            let mut corners = self.complex.vertices(simplex).iter().zip(complex.vertices(own as u32));
            let anchor = corners.find(|&(&vertex, _)| vertex == ball.anchor);
            balls.push(match ball.anchor {
                NONE => ball,
                _ => ball.anchored(*anchor.expect("a D-ball's anchor is a vertex").1),
            });
        }
        Ok((Self { complex, points, balls, exact_fallbacks: 0.into() }, names))
    }

    /// Which of the first `vertices` of a part the whole may have simplices at, beyond the rim of the
    /// first `simplices`.
    pub fn vertices_at_rim(&self, simplices: u32, vertices: usize) -> Fallible<Vec<bool>> {
        let mut is_at_rim = filled(vertices, false)?;
        for simplex in (0..simplices).filter(|&simplex| self.complex.is_at_rim(simplex)) {
            for &vertex in self.complex.vertices(simplex) {
                if vertex != INFINITE {
                    is_at_rim[vertex as usize] = true;
                }
            }
        }
        Ok(is_at_rim)
    }

    /// See [`crate::complex::Complex::put_back`]; new vertices get their names here.
    pub fn put_back(&mut self, part: &Self, names: &mut Names) -> Fallible<()> {
        for point in &part.points[names.vertices.len()..] {
            let name = self.add_point(*point)?;
            names.vertices.try_push(name)?;
        }
        self.complex.put_back(&part.complex, names)?;
        self.cover_balls()?;
        for (ball, &name) in part.balls.iter().zip(&names.simplices) {
            if name != NONE {
                self.balls[name as usize] = match ball.anchor {
                    NONE => *ball,
                    anchor => ball.anchored(names.vertices[anchor as usize]),
                };
            }
        }
        *self.exact_fallbacks.get_mut() += part.exact_fallbacks();
        Ok(())
    }
}
