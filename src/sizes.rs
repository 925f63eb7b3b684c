//! Sizes given by values, as a function: linear in a mesh, and those of its nearest vertex beyond
//! it. Values at the inputs are linear in the inputs' Delaunay triangulation, which is made for it.
//! Sizes of the caller's function and of the curvature of facets count beside these.

use crate::arrangement::space::CurvatureSizes;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::collected;
use crate::mesh::sizes::Background;
use crate::mesh::{Inputs, Mesh, in_dimension};
use crate::nearest::{Tree, nearest};
use crate::netmesh;
use crate::numerics::coordinates;
use crate::options::{Algorithm, Options, SizeFn};
use crate::query::{Index, Interpolation, Method, Outside, Values};
use std::borrow::Cow;
use std::cell::RefCell;

/// Sizes that are asked of a run beside its options.
#[derive(Default)]
pub(crate) struct Field<'a> {
    function: Option<&'a SizeFn<'a>>,
    of_curvature: Option<CurvatureSizes>,
    at_inputs: Option<Interpolated<'a>>,
    /// Sizes at the inputs if they lie in a hyperplane; replaces `at_inputs`.
    at_flat_inputs: Option<OfNearest>,
    on_background: Option<Interpolated<'a>>,
    /// Error that prevented an answer.
    failure: RefCell<Option<Error>>,
}

/// Sizes at the vertices of a mesh, linear between them.
struct Interpolated<'a> {
    background: Cow<'a, Background>,
    index: Index,
    least: f64,
    largest: f64,
}

/// Sizes at inputs in a hyperplane, which have no triangulation: that of the nearest input applies.
struct OfNearest {
    tree: Tree,
    values: Vec<f64>,
}

impl<'a> Field<'a> {
    /// Returns the sizes that `mesh` was given, those of a function and those that the curvature of
    /// facets asks for; `None` if there are none.
    ///
    /// # Errors
    /// `OutOfMemory`, and those of a run of [`Algorithm::Delaunay`].
    pub fn new(
        mesh: &'a Mesh,
        function: Option<&'a SizeFn<'a>>,
        of_curvature: Option<CurvatureSizes>,
    ) -> Result<Option<Self>> {
        let given = mesh.given_sizes();
        if given.is_empty() && function.is_none() && of_curvature.is_none() {
            return Ok(None);
        }
        let mut field = Self { function, of_curvature, ..Self::default() };
        if !given.at_inputs.is_empty() {
            field.set_inputs(mesh.inputs(), &given.at_inputs)?;
        }
        if let Some(background) = &given.background {
            field.on_background = Some(Interpolated::new(Cow::Borrowed(background))?);
        }
        Ok(Some(field))
    }

    fn set_inputs(&mut self, inputs: &Inputs, sizes: &[f64]) -> Result<()> {
        let of_vertex = |vertex: usize| sizes[inputs.first_input(vertex).unwrap_or(0) as usize];
        let values = collected((0..inputs.distinct()).map(of_vertex))?;
        let plain = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        match netmesh::run(inputs, None, &plain, None) {
            Ok(mesh) => {
                let background = Cow::Owned(Background { mesh, sizes: values });
                self.at_inputs = Some(Interpolated::new(background)?);
            }
            Err(error) if error.kind() == ErrorKind::DegenerateInput => {
                let distinct = 0..inputs.distinct();
                let points = collected(distinct.flat_map(|v| inputs.distinct_point(v)).copied())?;
                let tree = in_dimension!(
                    inputs.dim(),
                    D => Tree::of_all::<D>(&points)?,
                    _ => return Err(error)
                );
                self.at_flat_inputs = Some(OfNearest { tree, values });
            }
            Err(error) => return Err(error),
        }
        Ok(())
    }

    /// Returns the smallest of the sizes at `x`. An answer of the function that is no size is
    /// returned unchanged; NaN if an error prevented an answer.
    pub fn at(&self, x: &[f64]) -> f64 {
        let answer = self.function.map_or(f64::INFINITY, |function| function(x));
        if answer.is_nan() || answer <= 0.0 {
            return answer;
        }
        let nearest = self.at_flat_inputs.as_ref().map_or(f64::INFINITY, |values| values.at(x));
        let round = self.of_curvature.as_ref().map_or(f64::INFINITY, |sizes| sizes.at(x));
        let mut least = answer.min(nearest).min(round);
        for values in self.at_inputs.iter().chain(&self.on_background) {
            match values.at(x) {
                Ok(size) => least = least.min(size),
                Err(error) => {
                    *self.failure.borrow_mut() = Some(error);
                    return f64::NAN;
                }
            }
        }
        least
    }

    /// Returns the result of a run, or the error that prevented an answer, which is the cause.
    pub fn outcome<T>(&self, result: Result<T>) -> Result<T> {
        self.failure.take().map_or(result, Err)
    }
}

impl<'a> Interpolated<'a> {
    fn new(background: Cow<'a, Background>) -> Result<Self> {
        let index = Index::new(&background.mesh)?;
        let sizes = background.sizes.iter().copied();
        let least = sizes.clone().fold(f64::INFINITY, f64::min);
        let largest = sizes.fold(0.0, f64::max);
        Ok(Self { background, index, least, largest })
    }

    fn at(&self, x: &[f64]) -> Result<f64> {
        let method = Method { interpolation: Interpolation::Linear, outside: Outside::Nearest };
        let values = Values { components: 1, values: &self.background.sizes };
        let mut size = [0.0];
        self.index.interpolate(&self.background.mesh, method, values, x, 1, &mut size)?;
        // Weights are rounded: one below zero makes no number of an infinite size.
        match size[0].is_nan() {
            true => Ok(self.largest),
            false => Ok(size[0].clamp(self.least, self.largest)),
        }
    }
}

impl OfNearest {
    fn at(&self, x: &[f64]) -> f64 {
        let vertex = in_dimension!(
            x.len(),
            D => nearest(&self.tree, coordinates::<D>(x, 0)).0,
            _ => 0
        );
        self.values[vertex as usize]
    }
}
