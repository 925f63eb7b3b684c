//! Shields: balls about ends of lines that no vertex of the boundary goes into. Facets that meet
//! at a vertex alone at a small angle ask for vertices in each other ever nearer to it, since those
//! stand on no sphere about it. So once a line is split there far below its length, its end gets a
//! ball that is empty yet. All lines have a vertex on the sphere then, and facets have arcs of
//! vertices, with triangles between these and the centre: the protecting balls of D. Cohen-Steiner,
//! E. Colin de Verdiere and M. Yvinec, "Conforming Delaunay triangulations in 3D" (2002), but only
//! where nothing else has an end.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;
use crate::netmesh::questions::exempt::unit_of;
use crate::netmesh::questions::subfacets::OnSheet;
use crate::netmesh::state::State;
use crate::netmesh::state::facets::features::{Features, Part};
use crate::netmesh::state::facets::meetings::TinyAngles;
use crate::netmesh::state::facets::plane::power_below;
use crate::netmesh::state::facets::shields::Shield;
use crate::netmesh::state::segments::chain::Fraction;
use crate::numerics::{cross, distance, dot, norm, scale_of_differences};

/// Length of a subsegment at an end of its line, relative to the line, below which the end gets a
/// shield, if facets are fins there. The later it comes, the more vertices there are: three facets
/// had 2,400 with 1/8, and 4,000 with 1/256. Where needles are between facets it may not come so
/// soon: convex hulls of needles had a quarter more vertices.
const DEEP_AT_FINS: f64 = 1.0 / 16.0;

/// Such length at other ends, where a feature beside them may be as small. With 1/4096 surfaces
/// that cross themselves have an eighth more vertices.
const DEEP: f64 = 1.0 / 1_048_576.0;

/// Smallest radius of a shield, in units in the last place of its centre.
const SMALLEST: f64 = 65536.0;

/// Largest angle of an arc at first, in radians: little of the circle of its triangle is outside
/// of the ball.
const WIDEST: f64 = std::f64::consts::FRAC_PI_3;

/// Distance from the centre, in radii, that no such circle reaches.
const REACH: f64 = 1.25;

/// Distance from a vertex on the sphere, in radii, below which an arc is divided in its middle.
const BESIDE: f64 = 1e-3;

/// Sine of the angle of a subfacet at the centre below which it does not tell where its facet goes
/// from a line.
const FLAT: f64 = 1e-9;

/// Distance from the centre, in radii, of the middle between the ends of an arc from which on it
/// tells where the middle of the arc is.
const LEAST_WAY: f64 = 1e-3;

/// Distance from the centre, in radii, within which nothing is split for a simplex.
const KEPT: f64 = 2.0;

/// A place on the sphere of a shield, in a facet beside a subsegment at its centre.
pub(in crate::netmesh) struct OnArc {
    pub subsegment: u32,
    pub facet: u32,
    pub x: [f64; 3],
}

/// The part of a facet that is counterclockwise of a line, up to the next one at the same end.
struct Sector {
    facet: u32,
    angle: f64,
    /// Directions of length 1: along the line, and at a right angle to it, into the facet.
    axes: [[f64; 3]; 2],
}

/// Returns the way between two points, divided by a power of two: its length is some units, so that
/// products of several ways neither overflow nor vanish.
fn scaled_way(from: &[f64; 3], to: &[f64; 3]) -> [f64; 3] {
    let scale = scale_of_differences([from, to]);
    let way: [f64; 3] = std::array::from_fn(|k| scale * to[k] - scale * from[k]);
    let power = power_below(way.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    way.map(|x| x / power)
}

impl State<3> {
    /// Returns the shield that an end of a line needs before a subsegment there is split.
    pub(in crate::netmesh) fn needed_shield(
        &mut self,
        subsegment: u32,
    ) -> AllocResult<Option<Shield>> {
        let own = *self.segments.chains.get(subsegment);
        let ends = self.segments.chains.lines[own.line as usize].ends;
        let Some(at) = (0..2).find(|&at| own.ends[at] == ends[at]) else { return Ok(None) };
        let center = ends[at];
        let deep = match self.facets.meetings.tiny_angles_at(center) {
            TinyAngles::OfFins => DEEP_AT_FINS,
            TinyAngles::InFans | TinyAngles::None => DEEP,
        };
        let length =
            |[a, b]: [VertexId; 2]| distance(self.delaunay.point(a), self.delaunay.point(b));
        match length(own.ends) > deep * length(ends) {
            true => Ok(None),
            false => self.shield_for(center),
        }
    }

    /// Returns a shield about an end of lines that no vertex is in or near, and nothing of the
    /// input but what the end is on; `None` where doubles are too coarse for it.
    pub(in crate::netmesh) fn shield_for(
        &mut self,
        center: VertexId,
    ) -> AllocResult<Option<Shield>> {
        let to_features = self.distance_to_features(center)?;
        let mut star = std::mem::take(&mut self.facets.star);
        self.delaunay.star(center, &mut star)?;
        let x = self.delaunay.point(center);
        let vertices = star.iter().flat_map(|&simplex| self.delaunay.complex().vertices(simplex));
        let others = vertices.filter(|&&vertex| vertex.is_valid() && vertex != center);
        let ways = others.map(|&vertex| distance(x, self.delaunay.point(vertex)));
        let radius = power_below(0.5 * ways.fold(to_features, f64::min));
        let has_room = radius >= SMALLEST * unit_of(x);
        self.facets.star = star;
        Ok(has_room.then_some(Shield { center, radius }))
    }

    /// Returns the distance from an end of lines to the nearest facet or line that it is not on.
    fn distance_to_features(&mut self, end: VertexId) -> AllocResult<f64> {
        if self.facets.features.is_none() {
            self.facets.features = Some(Features::new(self.parts_of_input()?)?);
        }
        let (chains, facets) = (&self.segments.chains, &self.facets);
        let is_own = |part: &Part| match part {
            Part::Triangle { facet, .. } => facets.facets_at(end).contains(facet),
            Part::Line { line, .. } => chains.lines[*line as usize].ends.contains(&end),
        };
        let x = self.delaunay.point(end);
        let features = facets.features.as_ref();
        Ok(features.map_or(f64::INFINITY, |features| features.distance_to(x, is_own)))
    }

    /// Returns the triangles of all facets, as they are now, and the lines without facets.
    fn parts_of_input(&self) -> AllocResult<Vec<Part>> {
        let mut parts = Vec::new();
        for subfacet in 0..self.facets.len() as u32 {
            let own = self.facets.get(subfacet);
            let corners = self.points_of(own.vertices).map(|x| *x);
            parts.try_push(Part::Triangle { facet: own.facet, corners })?;
        }
        for (number, line) in (0..).zip(&self.segments.chains.lines) {
            if self.facets.page_of(number).is_none() {
                let ends = line.ends.map(|end| *self.delaunay.point(end));
                parts.try_push(Part::Line { line: number, ends })?;
            }
        }
        Ok(parts)
    }

    /// Returns the centre of the shield that a subsegment is in, if there is one.
    pub(in crate::netmesh) fn shield_around(&self, subsegment: u32) -> Option<VertexId> {
        let ends = self.segments.chains.get(subsegment).ends;
        ends.into_iter().find(|&end| self.facets.shields.about(end).is_some())
    }

    /// Returns true if a point of a subfacet's facet is in a shield, or so near to it that nothing
    /// is split there for a simplex: the next one would ask for the same, nearer to the sphere.
    pub(in crate::netmesh) fn is_kept_by_shield(&self, subfacet: u32, x: &[f64; 3]) -> bool {
        self.shield_near(self.facets.get(subfacet).facet, x, KEPT).is_some()
    }

    /// Returns the shield of a facet whose centre is so many radii from `x` at most.
    fn shield_near(&self, facet: u32, x: &[f64; 3], radii: f64) -> Option<Shield> {
        let is_near = |shield: &Shield| {
            distance(self.delaunay.point(shield.center), x) <= radii * shield.radius
        };
        self.facets.shields.on_facet(facet).find(is_near)
    }

    /// Returns the place of a line at which it leaves a shield about its end.
    pub(in crate::netmesh) fn place_on_shield(&self, line: u32, shield: Shield) -> Fraction {
        let ends = self.segments.chains.lines[line as usize].ends;
        let [a, b] = ends.map(|end| self.delaunay.point(end));
        let end = u8::from(ends[0] != shield.center);
        Fraction::at(end, shield.radius / distance(a, b))
    }

    /// Returns places on the sphere of a shield, between the lines that end at its centre: no two
    /// neighbours on an arc are farther from each other than [`WIDEST`].
    pub(in crate::netmesh) fn places_on_arcs(&self, shield: Shield) -> AllocResult<Vec<OnArc>> {
        let mut places = Vec::new();
        let chains = &self.segments.chains;
        for line in chains.lines_at(shield.center) {
            let subsegment = chains.subsegment_at_end(line, shield.center);
            for page in self.facets.pages(subsegment) {
                let Some(sector) = self.sector_from(page, subsegment, shield) else { continue };
                let parts = (sector.angle / WIDEST).ceil();
                for part in 1..parts as u32 {
                    let angle = f64::from(part) * (sector.angle / parts);
                    let x = self.point_of_sector(&sector, shield, angle);
                    places.try_push(OnArc { subsegment, facet: sector.facet, x })?;
                }
            }
        }
        Ok(places)
    }

    /// Returns the sector that begins, counterclockwise, with a page of a subsegment at the centre
    /// of a shield; `None` if the page is the end of one.
    fn sector_from(&self, page: u32, subsegment: u32, shield: Shield) -> Option<Sector> {
        let o = self.delaunay.point(shield.center);
        let ways_of = |subfacet: u32| {
            let own = self.facets.get(subfacet);
            let at = own.vertices.iter().position(|&vertex| vertex == shield.center)?;
            let [next, last] = [(at + 1) % 3, (at + 2) % 3];
            let ways = [next, last].map(|at| scaled_way(o, self.delaunay.point(own.vertices[at])));
            // An edge has the number of the vertex opposite.
            Some((ways, own.subsegments[last], own.subsegments[next], own.neighbors[next]))
        };
        let ([u, v], first, ..) = ways_of(page)?;
        if first != subsegment {
            return None;
        }
        let unit = |x: [f64; 3]| x.map(|k| k / norm(&x));
        let facet = self.facets.get(page).facet;
        let product = cross(&u, &v);
        let normal = match norm(&product) > FLAT * norm(&u) * norm(&v) {
            true => product,
            false => self.facets.normal_at(facet, o),
        };
        let axes = [unit(u), unit(cross(&unit(normal), &unit(u)))];
        let (mut subfacet, mut angle) = (page, 0.0);
        loop {
            let ([u, v], _, beyond, next) = ways_of(subfacet)?;
            angle += norm(&cross(&u, &v)).atan2(dot(&u, &v));
            if beyond != NONE {
                return Some(Sector { facet, angle, axes });
            }
            subfacet = next;
        }
    }

    /// Returns the point of a sector on the sphere of a shield, at an angle from its first line.
    fn point_of_sector(&self, sector: &Sector, shield: Shield, angle: f64) -> [f64; 3] {
        let (o, (sine, cosine)) = (self.delaunay.point(shield.center), angle.sin_cos());
        let [u, v] = sector.axes;
        let x = std::array::from_fn(|k| o[k] + shield.radius * (cosine * u[k] + sine * v[k]));
        // Put on a facet that is bent, it leaves the sphere.
        let x = self.facets.point_at(sector.facet, &x);
        self.point_at_radius(sector.facet, shield, &x, shield.radius)
    }

    /// Returns the point of a facet at a distance from the centre of a shield, on the way to a
    /// point of it.
    fn point_at_radius(&self, facet: u32, shield: Shield, to: &[f64; 3], radius: f64) -> [f64; 3] {
        let o = self.delaunay.point(shield.center);
        let way: [f64; 3] = std::array::from_fn(|k| (to[k] - o[k]) / shield.radius);
        let stretch = radius / norm(&way);
        self.facets.point_at(facet, &std::array::from_fn(|k| o[k] + stretch * way[k]))
    }

    /// Returns the place for a vertex that is to go into a subfacet's facet at `x`, and a subfacet
    /// near it: `x` itself, or a place on the sphere of a shield where the vertex would be inside,
    /// or a neighbour of the centre in the sheet.
    pub(in crate::netmesh) fn off_shields(&self, subfacet: u32, x: [f64; 3]) -> (u32, [f64; 3]) {
        let facet = self.facets.get(subfacet).facet;
        let moved = self
            .shield_near(facet, &x, REACH)
            .and_then(|shield| self.place_on_sphere(subfacet, shield, &x));
        moved.unwrap_or((subfacet, x))
    }

    /// Returns the place on the sphere of a shield for a vertex at `x`, and the subfacet there;
    /// `None` if the vertex may be where it is. Beside another vertex the arc is divided in its
    /// middle.
    fn place_on_sphere(
        &self,
        subfacet: u32,
        shield: Shield,
        x: &[f64; 3],
    ) -> Option<(u32, [f64; 3])> {
        let facet = self.facets.get(subfacet).facet;
        let o = self.delaunay.point(shield.center);
        let at_radius =
            |to: &[f64; 3], radius: f64| self.point_at_radius(facet, shield, to, radius);
        if distance(o, x) == 0.0 {
            return None;
        }
        let sector = self.subfacet_at(subfacet, &at_radius(x, 0.5 * shield.radius))?;
        if distance(o, x) >= shield.radius && !self.is_in_circle(sector, x) {
            return None;
        }
        let place = at_radius(x, shield.radius);
        let vertices = self.facets.get(sector).vertices;
        let on_arc = vertices.into_iter().filter(|&vertex| vertex != shield.center);
        let on_arc = on_arc.map(|vertex| self.delaunay.point(vertex));
        let is_beside = |vertex: &[f64; 3]| distance(vertex, &place) < BESIDE * shield.radius;
        let is_divided = vertices.contains(&shield.center) && on_arc.clone().any(is_beside);
        let middle = is_divided.then(|| {
            on_arc.fold([0.0; 3], |sum: [f64; 3], vertex| {
                std::array::from_fn(|k| sum[k] + 0.5 * vertex[k])
            })
        });
        // The middle of an arc of half a circle is the centre.
        let middle = middle.filter(|middle| distance(o, middle) > LEAST_WAY * shield.radius);
        let place = middle.map_or(place, |middle| at_radius(&middle, shield.radius));
        Some((self.subfacet_at(sector, &place)?, place))
    }

    /// Returns the subfacet that a point of the sheet is in, by the way from one near it. A place
    /// for which doubles have no numbers is in none.
    pub(in crate::netmesh) fn subfacet_at(&self, near: u32, x: &[f64; 3]) -> Option<u32> {
        if x.iter().any(|x| !x.is_finite()) {
            return None;
        }
        match self.walk_in_sheet(near, x) {
            OnSheet::At { subfacet, .. } => Some(subfacet),
            OnSheet::Beyond(_) => None,
        }
    }
}
