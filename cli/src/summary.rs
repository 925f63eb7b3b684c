//! Summary of a run, for a person to read.

use crate::alpha_shape::Measured;
use crate::arguments::Arguments;
use crate::certificate;
use crate::histograms::Histograms;
use crate::input::{self, Further};
use crate::numbers::{counted, counted_all, duration, grouped, measure};
use crate::outside::Outside;
use crate::part;
use crate::repairs::Repairs;
use crate::scan::Found;
use crate::standard;
use netmesh::quality::Quality;
use netmesh::surface::SurfaceKind;
use netmesh::validate::Report;
use netmesh::{
    Algorithm, Attribute, Criterion, Extent, GivesWay, Inputs, LeftOut, Mesh, NetOrdering, Output,
    Triangulation, VertexKind,
};
use std::fmt::Write;

/// Seconds that each step took; 0 for a step that was not asked for.
#[derive(Debug, Default)]
pub struct Times {
    pub read: f64,
    pub mesh: f64,
    pub write: f64,
    pub validate: f64,
    pub measure: f64,
}

/// All that the summary tells.
pub struct Summary<'a> {
    pub arguments: &'a Arguments,
    pub mesh: &'a Mesh,
    pub inputs: &'a Inputs,
    pub left_out: LeftOut,
    pub outside: Outside,
    pub further: &'a [Further],
    pub repairs: &'a Repairs,
    pub attributes: &'a [Attribute],
    pub triangulation: &'a Triangulation,
    pub quality: &'a Quality,
    pub alpha_shape: Option<&'a Measured>,
    pub scan: Option<&'a Found>,
    pub histograms: Option<&'a Histograms>,
    pub report: Option<&'a Report>,
    pub times: &'a Times,
}

impl Summary<'_> {
    pub fn text(&self) -> String {
        let mut lines = Lines::default();
        self.add_input(&mut lines);
        self.add_further(&mut lines);
        self.add_left_out(&mut lines);
        self.add_attributes(&mut lines);
        self.add_task(&mut lines);
        self.add_mesh(&mut lines);
        self.add_facets(&mut lines);
        self.add_outside(&mut lines);
        self.add_quality(&mut lines);
        self.add_alpha_shape(&mut lines);
        self.add_surface(&mut lines);
        if self.arguments.stats {
            self.add_stats(&mut lines);
            self.add_instruments(&mut lines);
        }
        self.add_times(&mut lines);
        self.add_output(&mut lines);
        self.add_certificate(&mut lines);
        lines.text + &self.histograms.map_or(String::new(), Histograms::text)
    }

    fn add_input(&self, lines: &mut Lines) {
        lines.add(
            "input",
            format!(
                "{}: {} in {}D, {}",
                input::names(self.arguments),
                counted(self.inputs.count() as u64, "point", "points"),
                self.inputs.dim(),
                counted(self.inputs.duplicates() as u64, "duplicate", "duplicates"),
            ),
        );
    }

    /// Adds the files that the input was meshed together with.
    fn add_further(&self, lines: &mut Lines) {
        for (at, further) in self.further.iter().enumerate() {
            lines.add(if at == 0 { "with" } else { "" }, further.to_string());
        }
    }

    /// Adds the elements of a mesh or a surface in the file that are not meshed.
    fn add_left_out(&self, lines: &mut Lines) {
        let LeftOut { edges, faces, cells } = self.left_out;
        let parts = counted_all([
            (edges, "edge", "edges"),
            (faces, "face", "faces"),
            (cells, "cell", "cells"),
        ]);
        if !parts.is_empty() {
            let rest = match self.arguments.points {
                true => "--points asks for the points alone",
                false if self.mesh.given_facets().count() > 0 => {
                    "the facets in the file are meshed"
                }
                false => "of the mesh or surface in the file the points are meshed",
            };
            lines.add("left out", format!("{}; {rest}", parts.join(", ")));
        }
    }

    fn add_attributes(&self, lines: &mut Lines) {
        if self.attributes.is_empty() {
            return;
        }
        let names: Vec<&str> = self.attributes.iter().map(|attribute| &*attribute.name).collect();
        let of_equal = match self.inputs.duplicates() {
            0 => "",
            _ => "; of equal points those of the first",
        };
        lines.add("attributes", names.join(", ") + of_equal);
    }

    fn add_task(&self, lines: &mut Lines) {
        lines.add("task", self.task());
        let useless = self.arguments.without_effect();
        if !useless.is_empty() {
            let verb = if useless.len() == 1 { "has" } else { "have" };
            lines.add("", format!("{} {verb} no effect on that", useless.join(", ")));
        }
    }

    fn task(&self) -> String {
        let parameters = &self.triangulation.parameters;
        if parameters.algorithm == Algorithm::Delaunay {
            return "plain Delaunay triangulation of the input".to_owned();
        }
        let output = match parameters.output {
            _ if parameters.algorithm == Algorithm::Svr => "sparse Voronoi refinement",
            Output::Auto | Output::Hierarchical => "hierarchical mesh",
            Output::WellSpaced => "well-spaced mesh",
        };
        let extent = match parameters.extent {
            Extent::Auto | Extent::All => "",
            Extent::Hull => " of the hull",
            Extent::Box => " of the box",
            Extent::Boundary if self.inputs.dim() == 2 => " of what segments enclose",
            Extent::Boundary => " of what facets enclose",
        };
        let criterion = match parameters.criterion {
            Criterion::VoronoiAspect => "Voronoi aspect",
            Criterion::RadiusEdge => "radius-edge ratio",
        };
        let ordering = match parameters.ordering {
            NetOrdering::SampledNet => format!("seed {}", parameters.seed),
            NetOrdering::DeterministicNet => "deterministic nets".to_owned(),
        };
        // As it was given, and four digits of that of an angle.
        let bound = (1e4 * parameters.quality_bound).round() / 1e4;
        let angle = match parameters.min_angle {
            0.0 => String::new(),
            degrees => format!(" (angles at least {} degrees)", measure(degrees)),
        };
        format!("{output}{extent}, {criterion} at most {bound}{angle}, {ordering}")
    }

    fn add_mesh(&self, lines: &mut Lines) {
        let vertices = self.triangulation.vertex_count() as u64;
        lines.add(
            "mesh",
            format!(
                "{} = {} input + {} Steiner + {} cage; {:.2} per distinct input",
                counted(vertices, "vertex", "vertices"),
                grouped(self.count_of(VertexKind::Input)),
                grouped(self.count_of(VertexKind::Steiner)),
                grouped(self.count_of(VertexKind::Cage)),
                vertices as f64 / self.inputs.distinct() as f64,
            ),
        );
        lines.add(
            "",
            format!(
                "{}, {}",
                counted(self.triangulation.simplex_count() as u64, "simplex", "simplices"),
                counted(self.triangulation.domains.len() as u64, "domain", "domains"),
            ),
        );
    }

    /// Adds facets and segments in space, and what they are in the mesh.
    fn add_facets(&self, lines: &mut Lines) {
        let (facets, segments) = (self.mesh.given_facets(), self.mesh.segments().count());
        let boundary = &self.triangulation.boundary;
        if self.inputs.dim() != 3 || facets.count() + segments == 0 {
            return;
        }
        let (one, many) = match facets.are_triangles {
            true => ("triangle", "triangles"),
            false => ("facet", "facets"),
        };
        let given = counted_all([
            (facets.count() as u64, one, many),
            (segments as u64, "segment", "segments"),
        ]);
        let subfacets = counted(boundary.subfacets.len() as u64, "subfacet", "subfacets");
        let subsegments = counted(boundary.subsegments.len() as u64, "subsegment", "subsegments");
        lines.add("facets", format!("{}; {subfacets}, {subsegments}", given.join(", ")));
        for (_, line) in self.repairs.lines(self.arguments) {
            lines.add("", line);
        }
        let is_auto = self.arguments.options().extent == Extent::Auto;
        let reaches_on = self.triangulation.parameters.extent == Extent::All;
        if is_auto && reaches_on && facets.count() > 0 {
            let why = "they enclose nothing, so that all around them is meshed";
            lines.add("", format!("{why}; --diagnose tells where they are open"));
        }
        if let Some(told) = part::told(self.arguments, self.mesh) {
            lines.add("", told);
        }
    }

    /// Adds what is outside of the domain.
    fn add_outside(&self, lines: &mut Lines) {
        if let Some(told) = self.outside.told() {
            lines.add("outside", told);
        }
    }

    fn count_of(&self, kind: VertexKind) -> u64 {
        self.triangulation.kinds.iter().filter(|&&other| other == kind).count() as u64
    }

    fn add_quality(&self, lines: &mut Lines) {
        let quality = self.quality;
        lines.add(
            "quality",
            format!(
                "Voronoi aspect worst {}, mean {}; anywhere, beside cages and hull too, {}",
                measure(quality.worst_aspect),
                measure(quality.mean_aspect),
                measure(quality.worst_aspect_anywhere),
            ),
        );
        let angle = if self.triangulation.dim == 2 { "angle" } else { "dihedral angle" };
        lines.add(
            "",
            format!(
                "off the hull: radius-edge worst {}, smallest {angle} {} degrees; highest degree \
                 {}",
                measure(quality.worst_radius_edge),
                measure(quality.min_angle_degrees),
                grouped(u64::from(quality.max_degree)),
            ),
        );
        let asked = self.triangulation.parameters.min_dihedral;
        if asked > 0.0 {
            let (left, gaps) =
                (quality.below_min_dihedral, quality.below_min_dihedral_between_domains);
            let mut line =
                format!("{} below {asked} degrees", counted(left, "simplex", "simplices"));
            if gaps > 0 {
                line += &format!(", and {} beside cages", grouped(gaps));
            }
            if self.triangulation.parameters.gives_way == GivesWay::Bound {
                let (one, many) = match self.triangulation.parameters.criterion {
                    Criterion::VoronoiAspect => ("cell", "cells"),
                    Criterion::RadiusEdge => ("simplex", "simplices"),
                };
                line += &format!("; {} beyond the bound", counted(quality.beyond_bound, one, many));
            }
            lines.add("", line);
        }
        if quality.below_min_angle > 0 {
            let below = counted(quality.below_min_angle, "triangle", "triangles");
            let degrees = measure(self.triangulation.parameters.min_angle);
            lines.add("", format!("{below} below {degrees} degrees that nothing forces"));
        }
        if quality.forced > 0 {
            let (one, many, between) = match self.triangulation.dim {
                2 => ("triangle", "triangles", "segments"),
                _ => ("simplex", "simplices", "facets and segments"),
            };
            let forced = counted(quality.forced, one, many);
            let least = measure(quality.least_forced_angle_degrees);
            let why = format!("that small angles between {between} force");
            lines.add("", format!("{forced} {why}, smallest {angle} {least} degrees"));
        }
        if quality.flat > 0 {
            let flat = counted(quality.flat, "simplex", "simplices");
            lines.add("", format!("{flat} with all vertices on one facet, flat but for roundings"));
        }
        let stats = &self.triangulation.stats;
        if stats.near_inputs > 0 {
            let near = counted(stats.near_inputs, "input", "inputs");
            let farthest = measure(stats.farthest_near_input);
            let how = "taken as on a segment, the farthest";
            lines.add("", format!("{near} {how} {farthest} units in the last place beside it"));
        }
        if quality.worst_cage_aspect > 0.0 {
            lines.add("", format!("cages worst {}", measure(quality.worst_cage_aspect)));
        }
        lines.add(
            "",
            counted(
                quality.precision_limited,
                "cell out of reach of the bound in double precision",
                "cells out of reach of the bound in double precision",
            ),
        );
    }

    fn add_alpha_shape(&self, lines: &mut Lines) {
        let Some(Measured { alpha, volume, topology }) = self.alpha_shape else { return };
        let (faces, kind) = (topology.face_counts.iter().sum(), self.triangulation.dim);
        let volume_name = if kind == 2 { "area" } else { "volume" };
        lines.add(
            "alpha shape",
            format!(
                "alpha {}: {}, {volume_name} {}",
                measure(*alpha),
                counted(faces, "face", "faces"),
                measure(*volume),
            ),
        );
        let mut parts = vec![counted(topology.components, "component", "components")];
        if let (3, Some(betti)) = (kind, &topology.betti) {
            parts.push(counted(betti[1], "tunnel", "tunnels"));
        }
        parts.push(match kind {
            2 => counted(topology.voids, "hole", "holes"),
            3 => counted(topology.voids, "cavity", "cavities"),
            _ => counted(topology.voids, "void", "voids"),
        });
        parts.push(format!("Euler characteristic {}", topology.euler_characteristic));
        lines.add("", parts.join(", "));
    }

    fn add_surface(&self, lines: &mut Lines) {
        let Some(Found { surface, points, volume }) = self.scan else { return };
        let is_plane = self.triangulation.dim == 2;
        let facets = surface.facets.len() / self.triangulation.dim;
        let (one, many) = if is_plane { ("edge", "edges") } else { ("triangle", "triangles") };
        let shells = surface.shells.len() as u64;
        let (part, parts) = if is_plane { ("curve", "curves") } else { ("shell", "shells") };
        let mut found = vec![counted(facets as u64, one, many), counted(shells, part, parts)];
        if !is_plane {
            let two_sided = surface.shells.iter().filter(|shell| !shell.is_one_sided);
            let handles = two_sided.map(|shell| shell.genus).sum();
            found.push(counted(handles, "handle", "handles"));
        }
        if surface.kind == SurfaceKind::Open {
            found.push(counted(surface.shells.iter().map(|shell| shell.ends).sum(), "end", "ends"));
        } else {
            let name = if is_plane { "area" } else { "volume" };
            found.push(format!("{name} {}", measure(*volume)));
        }
        lines.add("surface", found.join(", "));
        let one_sided = surface.shells.iter().filter(|shell| shell.is_one_sided).count() as u64;
        if one_sided > 0 {
            lines.add("", format!("{} with one side alone", counted(one_sided, part, parts)));
        }
        let sparse = surface.sparse() as u64;
        if sparse > 0 {
            let where_sparse = counted(sparse, "point", "points");
            lines.add("", format!("a guess at {where_sparse}, which are sparse there"));
        }
        let left_out = surface.left_out.len() as u64;
        if left_out > 0 {
            let of = grouped(*points as u64);
            lines.add("", format!("{} of {of} not on it", counted(left_out, "point", "points")));
        }
    }

    fn add_stats(&self, lines: &mut Lines) {
        let stats = &self.triangulation.stats;
        let parameters = &self.triangulation.parameters;
        lines.add(
            "run",
            format!(
                "{} in {}, the worst leaving {} of the longest conflict list; {} ({:.1} per input, \
                 at most {} for one)",
                counted(stats.rounds, "round", "rounds"),
                counted(stats.passes, "pass", "passes"),
                measure(stats.worst_halving),
                counted(stats.touches, "touch", "touches"),
                stats.touches as f64 / self.inputs.distinct() as f64,
                grouped(stats.max_touches),
            ),
        );
        lines.add(
            "",
            format!(
                "cages: {} created, {} grown, {} released; {} exactly",
                grouped(stats.cages_created),
                grouped(stats.cages_grown),
                grouped(stats.cages_released),
                counted(stats.exact_fallbacks, "test decided", "tests decided"),
            ),
        );
        lines.add(
            "",
            format!(
                "points made: {} for cages ({} of them to close cage gaps), {} corners, {} \
                 off-centres; an input instead {}",
                grouped(stats.cage_points),
                grouped(stats.closing_points),
                grouped(stats.far_corners),
                grouped(stats.off_centers),
                counted(stats.yields, "time", "times"),
            ),
        );
        lines.add(
            "",
            format!(
                "epsilon {}, delta {}, gamma {}, yield radius {}, encroachment {}, cage scale {}, \
                 root scale {}, distance ratio {}",
                parameters.epsilon,
                parameters.delta,
                parameters.gamma,
                parameters.yield_radius,
                parameters.encroachment,
                parameters.cage_scale,
                parameters.root_scale,
                parameters.distance_ratio,
            ),
        );
    }

    /// Adds the paper's constants, as measured.
    fn add_instruments(&self, lines: &mut Lines) {
        let stats = &self.triangulation.stats;
        lines.add(
            "constants",
            format!(
                "ply at most {}, mean {}, at {}; a D-ball meets at most {} others, mean {}",
                grouped(stats.max_ply),
                measure(stats.mean_ply),
                counted(stats.ply_probes, "Voronoi corner", "Voronoi corners"),
                grouped(stats.max_ball_intersections),
                measure(stats.mean_ball_intersections),
            ),
        );
        if self.triangulation.parameters.algorithm == Algorithm::Delaunay {
            return;
        }
        lines.add(
            "",
            format!(
                "feature size of the inputs over that of the mesh at most {}; at the insertion of \
                 inputs {}, Steiner points {}, cages {}",
                measure(stats.feature_size_constant),
                measure(stats.insertion_constant_input),
                measure(stats.insertion_constant_corner),
                measure(stats.insertion_constant_cage),
            ),
        );
    }

    fn add_times(&self, lines: &mut Lines) {
        let times = self.times;
        let mesh = self.triangulation.stats.seconds;
        let speed = self.triangulation.vertex_count() as f64 / mesh.max(1e-9);
        let mut text = format!(
            "mesh {} ({} vertices/s), read {}, quality {}",
            duration(mesh),
            grouped(speed as u64),
            duration(times.read),
            duration(times.measure),
        );
        if self.arguments.stats {
            let _ = write!(text, ", constants {}", duration((times.mesh - mesh).max(0.0)));
        }
        if self.arguments.output.is_some() {
            let _ = write!(text, ", write {}", duration(times.write));
        }
        if self.report.is_some() {
            let _ = write!(text, ", certificate {}", duration(times.validate));
        }
        lines.add("time", text);
    }

    fn add_output(&self, lines: &mut Lines) {
        if let Some(output) = &self.arguments.output {
            lines.add("written", standard::output_name(output));
        }
    }

    fn add_certificate(&self, lines: &mut Lines) {
        let Some(report) = self.report else { return };
        let checks = counted(report.checked, "check", "checks");
        let text = match certificate::holds(report) {
            true => format!("holds at level {}: {checks}, no violation", report.level),
            false => format!(
                "violated: {} in {checks}",
                counted(report.violations, "violation", "violations")
            ),
        };
        lines.add("certificate", text);
    }
}

/// Lines with a label in front; an empty label continues the line above.
#[derive(Default)]
struct Lines {
    text: String,
}

impl Lines {
    fn add(&mut self, label: &str, text: String) {
        let _ = writeln!(self.text, "{label:<12}{text}");
    }
}
