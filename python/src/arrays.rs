//! Arrays of NumPy that share the library's memory.

use crate::errors::raised;
use netmesh::ErrorKind;
use numpy::ndarray::{ArrayView, Dimension, Ix2, ShapeBuilder};
use numpy::{Element, PyArray, PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

/// Returns a read-only array of memory that belongs to `owner`.
///
/// # Safety
/// The memory stays where it is and unchanged as long as `owner` lives.
pub unsafe fn shared<'py, T: Element, D: Dimension>(
    owner: &Bound<'py, PyAny>,
    values: &ArrayView<'_, T, D>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    // SAFETY: the caller's promise.
    let array = unsafe { PyArray::borrow_from_array(values, owner.clone()) };
    // Other threads may read the same memory as another array, which forbids to borrow it here.
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}

/// Returns rows of ids as a read-only array, with -1 for none.
///
/// # Safety
/// The ids stay as [`shared`] demands of its memory.
pub unsafe fn shared_ids<'py>(
    owner: &Bound<'py, PyAny>,
    ids: &[u32],
    columns: usize,
    count: usize,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let ids = signed(owner.py(), ids, count)?;
    // SAFETY: the caller's promise.
    unsafe { shared(owner, &rows(ids, columns)) }
}

/// Returns an array of ids in one column, which shares their memory; see [`shared_ids`].
///
/// # Safety
/// The ids stay as [`shared`] demands of its memory.
pub unsafe fn shared_ids_1<'py>(
    owner: &Bound<'py, PyAny>,
    ids: &[u32],
    count: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let ids = signed(owner.py(), ids, count)?;
    // SAFETY: the caller's promise.
    unsafe { shared(owner, &ArrayView::from(ids)) }
}

pub fn rows<T>(values: &[T], columns: usize) -> ArrayView<'_, T, Ix2> {
    let shape = (values.len() / columns, columns);
    ArrayView::from_shape(shape, values).expect("whole rows")
}

/// Returns ids below `count` as signed integers, and [`netmesh::NONE`] as -1.
fn signed<'a>(py: Python<'_>, ids: &'a [u32], count: usize) -> PyResult<&'a [i32]> {
    fits(py, count)?;
    // SAFETY: the same size and alignment; any bits are an i32.
    Ok(unsafe { std::slice::from_raw_parts(ids.as_ptr().cast(), ids.len()) })
}

/// Fails unless ids below `count` fit the arrays of Python.
pub fn fits(py: Python<'_>, count: usize) -> PyResult<()> {
    if count <= i32::MAX as usize {
        return Ok(());
    }
    let message = format!("{count} ids do not fit the arrays of Python, which are int32");
    Err(raised(py, ErrorKind::Capacity, message))
}

/// Returns ids from Python as unsigned ones: -1 becomes [`netmesh::NONE`].
pub fn given_ids(ids: &[i32]) -> &[u32] {
    // SAFETY: the same size and alignment; any bits are a u32.
    unsafe { std::slice::from_raw_parts(ids.as_ptr().cast(), ids.len()) }
}

/// Returns signed ids as unsigned ones to write to: [`netmesh::NONE`] becomes -1.
pub fn unsigned(ids: &mut [i32]) -> &mut [u32] {
    // SAFETY: as in `signed`; any bits are a u32 too.
    unsafe { std::slice::from_raw_parts_mut(ids.as_mut_ptr().cast(), ids.len()) }
}

/// Returns the doubles from the first point to the last, and the distance of points in them; `None`
/// where points do not stand one after the other in memory.
pub fn strided<'a>(points: &'a PyReadonlyArray2<'_, f64>) -> Option<(&'a [f64], usize)> {
    let array = points.as_array();
    let (count, dim) = array.dim();
    if count == 0 || dim == 0 {
        return Some((&[], dim));
    }
    let (step, axis) = (usize::try_from(array.strides()[0]).ok()?, array.strides()[1]);
    if axis != 1 || (step < dim && count > 1) {
        return None;
    }
    let step = step.max(dim);
    // SAFETY: from the first coordinate of the first point to the last one of the last point.
    Some((unsafe { std::slice::from_raw_parts(array.as_ptr(), (count - 1) * step + dim) }, step))
}

/// Returns a new array. Where there is no memory NumPy raises its error.
pub fn empty<'py, T: Element, D: Dimension>(
    py: Python<'py>,
    shape: impl ShapeBuilder<Dim = D> + IntoPyObject<'py>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    let array = py.import("numpy")?.getattr("empty")?.call1((shape, T::get_dtype(py)))?;
    Ok(array.cast_into()?)
}
