//! Level 3: regions are what walls separate, the seeds of the caller say what is a hole and
//! which labels there are, and the domain is what is neither outside nor a hole.

use super::walls::{self, Walls};
use super::{Outline, Promised, interior, labels};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::{NONE, Region};
use crate::options::Extent;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// The sets of simplices that are connected without crossing a wall.
pub(super) struct Components {
    /// Simplex -> its component.
    pub of: Vec<u32>,
    pub all: Vec<Component>,
}

pub(super) struct Component {
    /// First simplex of the region.
    pub first: usize,
    /// True if the region reaches to the hull.
    pub is_outside: bool,
    /// The extent reaches to the hull, too.
    is_of_all: bool,
    /// Winding number, or its remainder by 2, that tells whether the component is inside: where
    /// curves or surfaces are closed.
    pub winding: Option<i64>,
    /// The seed in it.
    seed: Option<usize>,
    is_hole: bool,
    /// The label that its simplices must have.
    pub label: i32,
    max_edge: f64,
}

/// Checks the regions between `walls`. `steps` is for [`interior::judge`], if closed curves or
/// surfaces tell what is inside and the outline is known.
pub(super) fn check<const D: usize>(
    outline: Option<Outline<'_>>,
    view: View<'_, D>,
    walls: &Walls,
    steps: Option<Vec<i64>>,
    promised: Promised<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    check_neighbors(view, walls, promised.count, findings);
    let mut components = Components::find(view, walls)?;
    if let Some(steps) = steps {
        interior::judge(view, walls, steps, &mut components, findings)?;
    }
    if let Some(outline) = outline {
        components.add_seeds(view, outline.regions, findings)?;
        labels::expect(view, walls, &mut components)?;
    }
    for component in &components.all {
        let is_boundary = view.mesh.parameters.extent == Extent::Boundary;
        if promised.is_cropped || component.is_of_all || is_boundary {
            check_place(component, component.first < promised.count, outline.is_some(), findings);
        }
        if outline.is_some() {
            check_label(view, component, findings);
        }
    }
    Ok(())
}

/// Returns for each simplex the largest edge that its region may have.
pub(super) fn largest_edges<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    regions: &[Region],
) -> AllocResult<Vec<f64>> {
    let mut components = Components::find(view, walls)?;
    components.add_seeds(view, regions, &mut Findings::default())?;
    collected(components.of.iter().map(|&component| components.all[component as usize].max_edge))
}

/// Checks that neighbours without a wall between them have one label, and that both or neither of
/// them are in the domain.
fn check_neighbors<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    count: usize,
    findings: &mut Findings,
) {
    let noun = walls::noun::<D>();
    let labels = &view.mesh.boundary.simplex_regions;
    for simplex in 0..view.simplex_count() {
        for (slot, &neighbor) in view.neighbors(simplex).iter().enumerate() {
            let beyond = neighbor as usize;
            if neighbor == NONE || beyond < simplex || walls.across(simplex, slot) != NONE {
                continue;
            }
            findings.check(labels[simplex] == labels[beyond], || {
                let message = message!(
                    "neighbours {simplex} and {beyond} have the labels {} and {} and no {noun} \
                     between them",
                    labels[simplex],
                    labels[beyond]
                );
                Violation::new(ViolationKind::RegionLabel, message).simplex(simplex)
            });
            findings.check((simplex < count) == (beyond < count), || {
                let message = message!(
                    "the domain ends between neighbours {simplex} and {beyond}, where no \
                     {noun} is"
                );
                Violation::new(ViolationKind::DomainEnd, message).simplex(simplex)
            });
        }
    }
}

fn check_place(component: &Component, is_inside: bool, knows_holes: bool, findings: &mut Findings) {
    let first = component.first;
    findings.check(!is_inside || component.is_enclosed(), || {
        let message = match component.winding {
            None => message!("simplex {first} of the domain can be reached from outside"),
            Some(_) => {
                message!("simplex {first} of the domain is in no curve or surface, as these count")
            }
        };
        Violation::new(ViolationKind::DomainPlace, message).simplex(first)
    });
    findings.check(!is_inside || !component.is_hole, || {
        let seed = component.seed.unwrap_or(0);
        let message = message!("simplex {first} of the domain is in the hole of regions[{seed}]");
        Violation::new(ViolationKind::DomainPlace, message).simplex(first)
    });
    let belongs = knows_holes && component.is_enclosed() && !component.is_hole;
    findings.check(is_inside || !belongs, || {
        let message =
            message!("simplex {first} is neither outside nor in a hole, and not in the domain");
        Violation::new(ViolationKind::DomainPlace, message).simplex(first)
    });
}

fn check_label<const D: usize>(view: View<'_, D>, component: &Component, findings: &mut Findings) {
    let (first, expected) = (component.first, component.label);
    let label = view.mesh.boundary.simplex_regions[first];
    findings.check(label == expected, || {
        let message = message!("simplex {first} has the label {label}, its region {expected}");
        Violation::new(ViolationKind::RegionLabel, message).simplex(first)
    });
}

impl Component {
    fn new(first: usize, extent: Extent) -> Self {
        Self {
            first,
            is_outside: false,
            is_of_all: extent == Extent::All,
            winding: None,
            seed: None,
            is_hole: false,
            label: 0,
            max_edge: f64::INFINITY,
        }
    }

    /// Returns true if the component is a region of the domain that no seed gives a label.
    pub fn is_unlabelled(&self) -> bool {
        self.is_enclosed() && self.seed.is_none() && !(self.is_of_all && self.is_outside)
    }

    /// Returns the label that a seed gives the component.
    pub fn label_of_seed(&self) -> Option<i32> {
        self.seed.filter(|_| !self.is_hole).map(|_| self.label)
    }

    /// Returns true if the component is inside unless its seed says that it is a hole.
    fn is_enclosed(&self) -> bool {
        self.winding.map_or(!self.is_outside || self.is_of_all, |winding| winding != 0)
    }
}

impl Components {
    fn find<const D: usize>(view: View<'_, D>, walls: &Walls) -> AllocResult<Self> {
        let mut found = Self { of: filled(view.simplex_count(), NONE)?, all: Vec::new() };
        let mut waiting = Vec::new();
        for first in 0..view.simplex_count() {
            if found.of[first] != NONE {
                continue;
            }
            let number = found.all.len() as u32;
            let mut component = Component::new(first, view.mesh.parameters.extent);
            found.of[first] = number;
            waiting.try_push(first)?;
            while let Some(simplex) = waiting.pop() {
                for (slot, &neighbor) in view.neighbors(simplex).iter().enumerate() {
                    if walls.across(simplex, slot) != NONE {
                        continue;
                    }
                    if neighbor == NONE {
                        component.is_outside = true;
                    } else if found.of[neighbor as usize] == NONE {
                        found.of[neighbor as usize] = number;
                        waiting.try_push(neighbor as usize)?;
                    }
                }
            }
            found.all.try_push(component)?;
        }
        Ok(found)
    }

    /// Notes what seeds say of their components. Each seed is in a component of the domain, or
    /// makes a hole where the rule for closed curves has one, and no component has two.
    fn add_seeds<const D: usize>(
        &mut self,
        view: View<'_, D>,
        regions: &[Region],
        findings: &mut Findings,
    ) -> AllocResult<()> {
        let (mut signs, mut near) = (Signs::<Robust>::default(), 0);
        // With the extent all, what is beyond the hull is of the component that reaches to it.
        let is_at_hull = |component: &Component| component.is_outside;
        let beyond = self.all.iter().position(is_at_hull).unwrap_or(0);
        for (number, region) in regions.iter().enumerate() {
            let seed = std::array::from_fn(|axis| region.seed[axis]);
            let simplex = locate(view, near, &seed, &mut signs)?;
            near = simplex.unwrap_or(near);
            let own = simplex.map_or(beyond, |simplex| self.of[simplex] as usize);
            let component = &mut self.all[own];
            let has_place = component.is_enclosed() || region.is_hole && !component.is_outside;
            findings.check(has_place, || {
                let message = message!("regions[{number}].seed is in no region of the domain");
                Violation::new(ViolationKind::RegionLabel, message).simplex(component.first)
            });
            findings.check(component.seed.is_none(), || {
                let other = component.seed.unwrap_or(0);
                let message = message!("regions[{other}] and regions[{number}] are one region");
                Violation::new(ViolationKind::RegionLabel, message).simplex(component.first)
            });
            component.seed = Some(number);
            component.is_hole |= region.is_hole;
            if !region.is_hole {
                component.label = region.label;
            }
            if region.max_edge > 0.0 && !region.is_hole {
                component.max_edge = region.max_edge;
            }
        }
        Ok(())
    }
}

/// Returns a simplex that holds `x`, by a walk that goes wherever `x` is beyond a facet; `None`
/// outside of the hull. In a Delaunay triangulation the walk ends (H. Edelsbrunner, "An acyclicity
/// theorem for cell complexes in d dimensions", 1990); in another it is given up.
fn locate<const D: usize>(
    view: View<'_, D>,
    near: usize,
    x: &[f64; D],
    signs: &mut Signs<Robust>,
) -> AllocResult<Option<usize>> {
    let mut simplex = near;
    for _ in 0..view.simplex_count() {
        let vertices = view.simplex(simplex);
        let mut beyond = None;
        for slot in 0..View::<D>::VERTICES {
            let mut points = view.points_of(vertices);
            points[slot] = x;
            if signs.orientation(&points[..View::<D>::VERTICES])? == Ordering::Less {
                beyond = Some(view.neighbors(simplex)[slot]);
                break;
            }
        }
        match beyond {
            None => return Ok(Some(simplex)),
            Some(NONE) => return Ok(None),
            Some(neighbor) => simplex = neighbor as usize,
        }
    }
    Ok(None)
}
