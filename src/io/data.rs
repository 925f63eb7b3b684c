//! Data of vertices and simplices that is written beside a mesh.

use crate::error::{Error, Result, message};
use crate::mesh::{Attribute, Triangulation};
use crate::quality::Measures;
use std::borrow::Cow;
use std::io;

/// Data that is written with a mesh. Attributes alone become it by `into`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Data<'a> {
    /// Values at the vertices of the mesh, for formats that hold them
    /// ([`Format::holds_attributes`](super::Format::holds_attributes)).
    pub attributes: &'a [Attribute],
    /// Measures of the mesh, which whoever has them spares the formats that need them
    /// ([`Format::needs_measures`](super::Format::needs_measures)): these make them otherwise.
    pub measures: Option<&'a Measures>,
}

impl<'a, A: AsRef<[Attribute]> + ?Sized> From<&'a A> for Data<'a> {
    fn from(attributes: &'a A) -> Self {
        Self { attributes: attributes.as_ref(), measures: None }
    }
}

impl<'a> Data<'a> {
    /// Refuses data that is not that of a mesh of so many vertices, or of another one than `mesh`.
    pub(super) fn check(&self, vertices: usize, mesh: Option<&Triangulation>) -> Result<()> {
        for Attribute { name, components, values, .. } in self.attributes {
            if vertices.checked_mul(*components) != Some(values.len()) {
                let message = message!(
                    "attribute {name} has {} values; it must have vertices x components \
                     = {vertices} x {components}",
                    values.len()
                );
                return Err(Error::invalid(message));
            }
        }
        let Some(Measures { radius_edge, aspect, .. }) = self.measures else { return Ok(()) };
        let (ratios, aspects) = (radius_edge.len(), aspect.len());
        let simplices = mesh.map_or(0, Triangulation::simplex_count);
        if (ratios, aspects) != (simplices, vertices) {
            return Err(Error::invalid(message!(
                "measures are of {aspects} vertices and {ratios} simplices; the mesh has \
                 {vertices} and {simplices}"
            )));
        }
        Ok(())
    }

    /// Returns the measures of `mesh`, those that are given if any are.
    pub(super) fn measures_of(&self, mesh: &Triangulation) -> io::Result<Cow<'a, Measures>> {
        match self.measures {
            Some(measures) => Ok(Cow::Borrowed(measures)),
            // Memory is all that measuring can lack.
            None => {
                Measures::of(mesh).map(Cow::Owned).map_err(|_| io::ErrorKind::OutOfMemory.into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, samples, write, write_with};
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn files_with_measures_that_are_given_are_those_with_their_own() {
        for (mesh, formats) in [
            (samples::nested(2), &[Format::Vtu, Format::Html, Format::Svg][..]),
            (samples::nested(3), &[Format::Vtu, Format::Html]),
        ] {
            let measures = Measures::of(mesh.triangulation().unwrap()).unwrap();
            for &format in formats {
                assert!(format.needs_measures());
                let data = Data { measures: Some(&measures), ..Data::default() };
                let (mut own, mut given) = (Vec::new(), Vec::new());
                write(&mesh, format, &mut own).unwrap();
                write_with(&mesh, data, format, &mut given).unwrap();
                assert!(own == given, "{format:?}");
            }
            // They are not made again.
            let mut other = measures.clone();
            other.radius_edge[0] = 12345.678;
            let data = Data { measures: Some(&other), ..Data::default() };
            let mut file = Vec::new();
            write_with(&mesh, data, Format::Vtu, &mut file).unwrap();
            assert!(file.windows(8).any(|bytes| bytes == 12345.678f64.to_le_bytes()));
        }
    }

    #[test]
    fn measures_of_another_mesh_are_refused() {
        let (mesh, other) = (samples::nested(3), samples::finished(3));
        let measures = Measures::of(other.triangulation().unwrap()).unwrap();
        let data = Data { measures: Some(&measures), ..Data::default() };
        let refused = write_with(&mesh, data, Format::Vtu, &mut Vec::new()).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::InvalidArgument);
        assert!(refused.message().contains("the mesh has"), "{refused}");
        let before = crate::Mesh::new(2, 3, &[0., 0., 1., 0., 0., 1.], 0).unwrap();
        assert!(write_with(&before, data, Format::Xyz, &mut Vec::new()).is_err());
        assert!(!Format::Gmsh.needs_measures());
    }
}
