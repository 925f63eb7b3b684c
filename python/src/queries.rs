//! Questions to a mesh: measures, the certificate, locations, nearest vertices, values.

use crate::arrays::{empty, unsigned};
use crate::core::Core;
use crate::errors::{abandonable, exception, invalid, stoppable};
use crate::options::{choice, whole};
use crate::selection::{Given, selected};
use netmesh::quality::Measure;
use netmesh::query::{Among, Index, Interpolation, Method, Outside, Values, Work};
use netmesh::{Stats, quality, validate};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;
use std::sync::atomic::Ordering;

impl Core {
    fn count(&self, points: &PyReadonlyArray2<'_, f64>) -> PyResult<usize> {
        let (count, dim) = points.as_array().dim();
        if dim != self.triangulation().dim {
            let message = format!(
                "points has shape ({count}, {dim}); the mesh has dim = {}",
                self.triangulation().dim
            );
            return Err(invalid(points.py(), message));
        }
        Ok(count)
    }

    /// Returns the index, which the first who needs it makes.
    fn index(&self, py: Python<'_>) -> PyResult<&Index> {
        if !self.has_index.load(Ordering::Acquire) {
            let made = Arc::clone(&self.made);
            abandonable(py, move || {
                made.prepared.index(&made.mesh)?;
                made.has_index.store(true, Ordering::Release);
                Ok(())
            })?;
        }
        self.prepared.index(&self.mesh).map_err(|error| exception(py, &error))
    }
}

#[pymethods]
impl Core {
    /// Returns the simplex of each point, -1 outside; with a selection its row among the selected.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        threads: &Bound<'py, PyAny>,
        selection: Given<'py>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let selection = selected(selection)?;
        let threads = whole("threads", threads, u32::MAX)?;
        let (count, index) = (self.count(&points)?, self.index(py)?);
        let found = empty(py, [count])?;
        let mut out = found.readwrite();
        let (points, out) = (points.as_slice()?, unsigned(out.as_slice_mut()?));
        let made = &self.made;
        stoppable(py, count, |stop| {
            let work = Work { threads, stop };
            match selection {
                None => index.locate(made.triangulation(), points, work, out),
                Some(selection) => made.locate_in_part(index, &selection, points, work, out),
            }
        })?;
        Ok(found)
    }

    /// Returns the nearest vertex of each point, or the number of the nearest input, and its
    /// distance.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        among: &Bound<'py, PyAny>,
        threads: &Bound<'py, PyAny>,
    ) -> PyResult<Nearest<'py>> {
        let names = [("vertices", Among::Vertices), ("inputs", Among::Inputs)];
        let among = choice("among", among, &names)?;
        let threads = whole("threads", threads, u32::MAX)?;
        let (count, index) = (self.count(&points)?, self.index(py)?);
        let (found, distances) = (empty(py, [count])?, empty(py, [count])?);
        let (mut ids, mut lengths) = (found.readwrite(), distances.readwrite());
        let (ids, lengths) = (unsigned(ids.as_slice_mut()?), lengths.as_slice_mut()?);
        let (points, made) = (points.as_slice()?, &self.made);
        stoppable(py, count, |stop| {
            let work = Work { threads, stop };
            match among {
                Among::Inputs => {
                    made.prepared.nearest_inputs(&made.mesh, points, work, ids, lengths)
                }
                Among::Vertices => {
                    index.nearest(made.triangulation(), among, points, work, ids, lengths)
                }
            }
        })?;
        Ok((found, distances))
    }

    /// Returns the values (`points x components`) of a function given at the vertices.
    fn interpolate<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray2<'py, f64>,
        points: PyReadonlyArray2<'py, f64>,
        interpolation: &Bound<'py, PyAny>,
        outside: &Bound<'py, PyAny>,
        threads: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let method = Method {
            interpolation: choice(
                "interpolation",
                interpolation,
                &[
                    ("linear", Interpolation::Linear),
                    ("sibson", Interpolation::Sibson),
                    ("laplace", Interpolation::Laplace),
                ],
            )?,
            outside: choice(
                "outside",
                outside,
                &[("nan", Outside::Nan), ("nearest", Outside::Nearest)],
            )?,
        };
        let threads = whole("threads", threads, u32::MAX)?;
        let (count, index) = (self.count(&points)?, self.index(py)?);
        let components = values.as_array().dim().1;
        let found = empty(py, (count, components))?;
        let mut out = found.readwrite();
        let (points, out) = (points.as_slice()?, out.as_slice_mut()?);
        let values = Values { components, values: values.as_slice()? };
        let mesh = self.triangulation();
        stoppable(py, out.len(), |stop| {
            index.interpolate(mesh, method, values, points, Work { threads, stop }, out)
        })?;
        Ok(found)
    }

    /// Returns the simplex of each point, -1 outside, and its barycentric coordinates there, NaN
    /// outside. Simplices reach beyond themselves by `tolerance` in such coordinates, for points
    /// that none holds.
    fn weigh<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        tolerance: f64,
        threads: &Bound<'py, PyAny>,
    ) -> PyResult<Weights<'py>> {
        let threads = whole("threads", threads, u32::MAX)?;
        let (count, index) = (self.count(&points)?, self.index(py)?);
        let mesh = self.triangulation();
        let (found, weights) = (empty(py, [count])?, empty(py, (count, mesh.dim + 1))?);
        let (mut ids, mut shares) = (found.readwrite(), weights.readwrite());
        let (ids, shares) = (unsigned(ids.as_slice_mut()?), shares.as_slice_mut()?);
        let (points, made) = (points.as_slice()?, &self.made);
        stoppable(py, count, |stop| {
            let work = Work { threads, stop };
            index.weigh(mesh, points, work, ids, shares)?;
            if tolerance == 0.0 || !ids.contains(&netmesh::NONE) {
                return Ok(());
            }
            let boxes = made.prepared.boxes(&made.mesh)?;
            boxes.weigh_within(mesh, tolerance, points, work, ids, shares)
        })?;
        Ok((found, weights))
    }

    /// Returns the number of bytes of the index, which is made if there is none yet.
    fn index_bytes(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.index(py)?.bytes())
    }

    /// Returns the level, the numbers of violations and checks, and of the first violation: the
    /// number and name of its kind, its simplex, vertex and domain, and its message.
    fn validate(&self, py: Python<'_>, level: u32) -> PyResult<Report> {
        let made = Arc::clone(&self.made);
        let report = abandonable(py, move || validate::validate_mesh(&made.mesh, level))?;
        let id = |id| (id != netmesh::NONE).then_some(id);
        let first = report.first.map(|first| {
            let ids = (id(first.simplex), id(first.vertex), id(first.domain));
            (first.kind as u32, format!("{:?}", first.kind), ids, first.message.into_owned())
        });
        Ok((report.level, report.violations, report.checked, first))
    }

    /// Returns the figures of the quality by name.
    fn quality<'py>(&self, py: Python<'py>, selection: Given<'py>) -> PyResult<Bound<'py, PyDict>> {
        let selection = selected(selection)?;
        let made = Arc::clone(&self.made);
        let quality::Quality {
            max_degree,
            worst_aspect,
            worst_aspect_anywhere,
            mean_aspect,
            worst_cage_aspect,
            worst_radius_edge,
            min_angle_degrees,
            precision_limited,
            below_min_dihedral,
            below_min_dihedral_between_domains,
            beyond_bound,
            forced,
            least_forced_angle_degrees,
            below_min_angle,
            flat,
        } = abandonable(py, move || made.measured(selection, quality::measure))?;
        let figures = PyDict::new(py);
        figures.set_item("max_degree", max_degree)?;
        figures.set_item("worst_aspect", worst_aspect)?;
        figures.set_item("worst_aspect_anywhere", worst_aspect_anywhere)?;
        figures.set_item("mean_aspect", mean_aspect)?;
        figures.set_item("worst_cage_aspect", worst_cage_aspect)?;
        figures.set_item("worst_radius_edge", worst_radius_edge)?;
        figures.set_item("min_angle_degrees", min_angle_degrees)?;
        figures.set_item("precision_limited", precision_limited)?;
        figures.set_item("below_min_dihedral", below_min_dihedral)?;
        figures
            .set_item("below_min_dihedral_between_domains", below_min_dihedral_between_domains)?;
        figures.set_item("beyond_bound", beyond_bound)?;
        figures.set_item("forced", forced)?;
        figures.set_item("least_forced_angle_degrees", least_forced_angle_degrees)?;
        figures.set_item("below_min_angle", below_min_angle)?;
        figures.set_item("flat", flat)?;
        Ok(figures)
    }

    /// Counts below the first edge, in the bins and above the last edge; least and largest value.
    fn quality_histogram<'py>(
        &self,
        py: Python<'py>,
        measure: &Bound<'py, PyAny>,
        hull: bool,
        edges: Vec<f64>,
        selection: Given<'py>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, f64, f64)> {
        let names = [
            ("dihedral_angle", Measure::DihedralAngle),
            ("radius_edge", Measure::RadiusEdge),
            ("aspect", Measure::Aspect),
            ("smallest_angle", Measure::SmallestAngle),
        ];
        let measure = choice("measure", measure, &names)?;
        let selection = selected(selection)?;
        let made = Arc::clone(&self.made);
        let quality::Histogram { counts, least, largest } = abandonable(py, move || {
            made.measured(selection, |mesh| quality::histogram(mesh, measure, hull, &edges))
        })?;
        let counts = counts.into_iter().map(|count| count as i64).collect();
        Ok((PyArray1::from_vec(py, counts), least, largest))
    }

    /// Returns the statistics of the run by name.
    fn stats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let figures = PyDict::new(py);
        macro_rules! set {
            ($($name:ident),* $(,)?) => {{
                let Stats { $($name),*, .. } = self.triangulation().stats.clone();
                $(figures.set_item(stringify!($name), $name)?;)*
            }};
        }
        set!(
            rounds,
            touches,
            max_touches,
            input_vertices,
            steiner_vertices,
            cage_vertices,
            cages_created,
            cages_grown,
            cages_released,
            exact_fallbacks,
            precision_limited,
            seconds,
            passes,
            worst_halving,
            cage_points,
            far_corners,
            off_centers,
            yields,
            closing_points,
            ply_probes,
            max_ply,
            mean_ply,
            max_ball_intersections,
            mean_ball_intersections,
            feature_size_constant,
            insertion_constant_input,
            insertion_constant_corner,
            insertion_constant_cage,
            simplices_created,
            near_inputs,
            farthest_near_input,
        );
        Ok(figures)
    }
}

type Weights<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray2<f64>>);
type Nearest<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<f64>>);
type Ids = (Option<u32>, Option<u32>, Option<u32>);
type Report = (u32, u64, u64, Option<(u32, String, Ids, String)>);
