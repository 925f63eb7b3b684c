//! The arrangement that a run in space must conform to.

use super::{refused_rule, without_interior};
use crate::arrangement::Poll;
use crate::arrangement::space::{
    CurvatureSizes, TaskInSpace, arrange_in_space, check_closed_in_space, encloses_in_space,
};
use crate::error::{Choice, Error, Name, Result, say};
use crate::mesh::{Arrangement, Mesh};
use crate::options::{Extent, Interior, Options};

impl Mesh {
    /// Returns true if the mesh has facets or segments in space, or an extent with a boundary of
    /// its own there.
    pub(super) fn conforms_in_space(&self, extent: Extent) -> bool {
        let has_frame = matches!(extent, Extent::Hull | Extent::Box);
        let has_own = self.given_facets().count() + self.segments().count() > 0;
        self.inputs().dim() == 3 && (has_own || has_frame)
    }

    /// Returns true if the facets are triangles of surfaces in space.
    pub(super) fn has_surface(&self) -> bool {
        self.inputs().dim() == 3 && self.given_facets().are_triangles
    }

    /// Returns the options with the extent that [`Extent::Auto`] stands for, and the arrangement of
    /// the facets and segments in space.
    pub(super) fn arrangement_in_space(
        &self,
        options: &Options,
        poll: Poll<'_>,
    ) -> Result<(Options, Option<Arrangement>)> {
        let Options { extent, coplanar, crossings, .. } = *options;
        self.check_extent_in_space(extent, options.interior)?;
        let (inputs, facets, segments) = (self.inputs(), self.given_facets(), self.segments());
        let regions = self.regions();
        let task = TaskInSpace { inputs, facets, segments, regions, coplanar, extent, crossings };
        let arrangement = arrange_in_space(&task, poll)?;
        let mut encloses = |rule| encloses_in_space(inputs, &arrangement, rule, &mut *poll);
        let ends_there = matches!(extent, Extent::Auto | Extent::Boundary);
        // The winding number where surfaces are closed and their triangles are oriented alike, so
        // that shells in shells are hollow.
        let is_wound = options.interior == Interior::Auto
            && self.has_surface()
            && ends_there
            && encloses(Interior::Winding)?;
        let interior = match options.interior {
            Interior::Auto if is_wound => Interior::Winding,
            Interior::Auto => Interior::Seeds,
            given => given,
        };
        let options = Options { interior, ..options.clone() };
        let options = match extent {
            Extent::Auto if is_wound || encloses(interior)? => {
                Options { extent: Extent::Boundary, ..options }
            }
            Extent::Auto => without_interior(options),
            Extent::Boundary if !is_wound => {
                check_closed_in_space(inputs, &arrangement, interior, poll)?;
                options
            }
            _ => options,
        };
        Ok((options, Some(arrangement)))
    }

    /// Returns the sizes that the curvature of facets asks for; `None` if the caller does not.
    ///
    /// # Errors
    /// `InvalidArgument` if there are no facets.
    pub(super) fn sizes_of_curvature(
        &self,
        options: &Options,
        arrangement: Option<&Arrangement>,
        poll: Poll<'_>,
    ) -> Result<Option<CurvatureSizes>> {
        let (inputs, asked) = (self.inputs(), options.size_from_curvature);
        // What is no option at all is refused with all others.
        let is_asked = asked > 0.0 && inputs.dim() == 3;
        match arrangement.filter(|arrangement| !arrangement.facets.is_empty()) {
            _ if !is_asked => Ok(None),
            Some(arrangement) => Ok(Some(CurvatureSizes::new(inputs, arrangement, asked, poll)?)),
            None => Err(Error::invalid(say!(
                Name::SizeFromCurvature,
                " is {asked}; it needs facets; the mesh has none"
            ))),
        }
    }

    fn check_extent_in_space(&self, extent: Extent, interior: Interior) -> Result<()> {
        let has_rule = !matches!(interior, Interior::Auto | Interior::Seeds);
        match extent {
            Extent::Boundary if self.given_facets().count() == 0 => {
                let name = Choice::Extent(extent);
                Err(Error::invalid(say!(name, " needs facets; the mesh has none")))
            }
            Extent::Auto if has_rule && self.given_facets().count() == 0 => {
                let rule = Choice::Interior(interior);
                Err(Error::invalid(say!(rule, " needs facets; the mesh has none")))
            }
            Extent::All | Extent::Hull | Extent::Box if has_rule => {
                Err(refused_rule(interior, extent))
            }
            _ => Ok(()),
        }
    }
}
