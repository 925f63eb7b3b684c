//! What the run made, for a program to read: the fields of `nm_counts`, `nm_options`, `nm_quality`,
//! `nm_stats` and `nm_report` under their names, and histograms, as one JSON object.

use crate::alpha_shape::Measured;
use crate::histograms::Table;
use crate::json::Object;
use crate::summary::Summary;
use netmesh::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, NetOrdering, Output, Parameters,
    Stats,
};

pub fn json(summary: &Summary<'_>) -> String {
    let mut record = Object::new();
    record.text("version", env!("CARGO_PKG_VERSION"));
    record.text("input", &summary.arguments.input.to_string_lossy());
    record.object("counts", |counts| add_counts(counts, summary));
    record.object("left_out", |left_out| {
        left_out.count("edges", summary.left_out.edges);
        left_out.count("faces", summary.left_out.faces);
        left_out.count("cells", summary.left_out.cells);
    });
    let parameters = &summary.triangulation.parameters;
    record.object("options", |options| add_options(options, parameters));
    record.object("quality", |quality| add_quality(quality, summary));
    match summary.histograms {
        None => record.null("histograms"),
        Some(histograms) => record.object("histograms", |object| {
            histograms.tables.iter().for_each(|table| add_table(object, table));
        }),
    }
    let stats = &summary.triangulation.stats;
    record.object("stats", |object| {
        add_counters(object, stats);
        add_instruments(object, stats, parameters.instruments);
    });
    match summary.alpha_shape {
        None => record.null("alpha_shape"),
        Some(shape) => record.object("alpha_shape", |object| add_alpha_shape(object, shape)),
    }
    match summary.report {
        None => record.null("report"),
        Some(report) => record.object("report", |object| {
            object.count("level", u64::from(report.level));
            object.count("violations", report.violations);
            object.count("checked", report.checked);
        }),
    }
    record.finished() + "\n"
}

fn add_alpha_shape(object: &mut Object, shape: &Measured) {
    object.number("alpha", shape.alpha);
    object.number("volume", shape.volume);
    object.number("euler_characteristic", shape.topology.euler_characteristic as f64);
    object.count("components", shape.topology.components);
    object.count("voids", shape.topology.voids);
    match &shape.topology.betti {
        Some(betti) if betti.len() == 3 => object.count("tunnels", betti[1]),
        _ => object.null("tunnels"),
    }
}

fn add_counts(counts: &mut Object, summary: &Summary<'_>) {
    counts.count("dim", summary.inputs.dim() as u64);
    counts.count("inputs", summary.inputs.count() as u64);
    counts.count("duplicates", summary.inputs.duplicates() as u64);
    counts.count("vertices", summary.triangulation.vertex_count() as u64);
    counts.count("simplices", summary.triangulation.simplex_count() as u64);
    counts.count("domains", summary.triangulation.domains.len() as u64);
}

/// As the run had them: the defaults filled in.
fn add_options(options: &mut Object, parameters: &Parameters) {
    options.text(
        "output",
        match parameters.output {
            Output::Auto => "auto",
            Output::Hierarchical => "hierarchical",
            Output::WellSpaced => "well-spaced",
        },
    );
    options.text(
        "algorithm",
        match parameters.algorithm {
            Algorithm::Netmesh => "netmesh",
            Algorithm::Svr => "svr",
            Algorithm::Delaunay => "delaunay",
        },
    );
    options.text(
        "ordering",
        match parameters.ordering {
            NetOrdering::SampledNet => "sampled",
            NetOrdering::DeterministicNet => "deterministic",
        },
    );
    options.text(
        "criterion",
        match parameters.criterion {
            Criterion::VoronoiAspect => "aspect",
            Criterion::RadiusEdge => "radius-edge",
        },
    );
    options.count("threads", u64::from(parameters.threads));
    options.number("quality_bound", parameters.quality_bound);
    options.number("epsilon", parameters.epsilon);
    options.number("delta", parameters.delta);
    options.number("gamma", parameters.gamma);
    options.number("yield_radius", parameters.yield_radius);
    options.number("encroachment", parameters.encroachment);
    options.number("cage_scale", parameters.cage_scale);
    options.number("root_scale", parameters.root_scale);
    options.number("distance_ratio", parameters.distance_ratio);
    options.count("seed", parameters.seed);
    options.count("max_vertices", parameters.max_vertices);
    options.truth("instruments", parameters.instruments);
    options.number("min_angle", parameters.min_angle);
    options.number("min_dihedral", parameters.min_dihedral);
    options.number("max_edge", parameters.max_edge);
    options.text(
        "gives_way",
        match parameters.gives_way {
            GivesWay::Angle => "angle",
            GivesWay::Bound => "bound",
        },
    );
    options.text(
        "extent",
        match parameters.extent {
            Extent::Auto => "auto",
            Extent::All => "all",
            Extent::Hull => "hull",
            Extent::Box => "box",
            Extent::Boundary => "boundary",
        },
    );
    options.text(
        "crossings",
        match parameters.crossings {
            Crossings::Refuse => "refuse",
            Crossings::Split => "split",
        },
    );
    options.text(
        "interior",
        match parameters.interior {
            Interior::Auto => "auto",
            Interior::Seeds => "seeds",
            Interior::Parity => "parity",
            Interior::Winding => "winding",
        },
    );
}

fn add_quality(object: &mut Object, summary: &Summary<'_>) {
    let quality = summary.quality;
    object.count("max_degree", u64::from(quality.max_degree));
    object.number("worst_aspect", quality.worst_aspect);
    object.number("worst_aspect_anywhere", quality.worst_aspect_anywhere);
    object.number("mean_aspect", quality.mean_aspect);
    object.number("worst_cage_aspect", quality.worst_cage_aspect);
    object.number("worst_radius_edge", quality.worst_radius_edge);
    object.number("min_angle_degrees", quality.min_angle_degrees);
    object.count("precision_limited", quality.precision_limited);
    object.count("below_min_dihedral", quality.below_min_dihedral);
    object.count("below_min_dihedral_between_domains", quality.below_min_dihedral_between_domains);
    object.count("beyond_bound", quality.beyond_bound);
    object.count("forced", quality.forced);
    object.number("least_forced_angle_degrees", quality.least_forced_angle_degrees);
    object.count("below_min_angle", quality.below_min_angle);
}

/// `counts[i]` and `counts_at_hull[i]` are of the values between `edges[i]` and `edges[i + 1]`.
fn add_table(object: &mut Object, table: &Table) {
    object.object(table.name, |object| {
        object.numbers("edges", &table.edges);
        object.counts("counts", &table.counts);
        match &table.counts_at_hull {
            None => object.null("counts_at_hull"),
            Some(counts) => object.counts("counts_at_hull", counts),
        }
        object.number("least", table.least);
        object.number("largest", table.largest);
    });
}

fn add_counters(object: &mut Object, stats: &Stats) {
    object.count("rounds", stats.rounds);
    object.count("touches", stats.touches);
    object.count("max_touches", stats.max_touches);
    object.count("input_vertices", stats.input_vertices);
    object.count("steiner_vertices", stats.steiner_vertices);
    object.count("cage_vertices", stats.cage_vertices);
    object.count("cages_created", stats.cages_created);
    object.count("cages_grown", stats.cages_grown);
    object.count("cages_released", stats.cages_released);
    object.count("exact_fallbacks", stats.exact_fallbacks);
    object.count("precision_limited", stats.precision_limited);
    object.number("seconds", stats.seconds);
    object.count("passes", stats.passes);
    object.number("worst_halving", stats.worst_halving);
    object.count("cage_points", stats.cage_points);
    object.count("far_corners", stats.far_corners);
    object.count("off_centers", stats.off_centers);
    object.count("yields", stats.yields);
    object.count("closing_points", stats.closing_points);
    object.count("near_inputs", stats.near_inputs);
    object.number("farthest_near_input", stats.farthest_near_input);
}

/// Null, every one, if they were not measured.
fn add_instruments(object: &mut Object, stats: &Stats, measured: bool) {
    let counts = [
        ("ply_probes", stats.ply_probes),
        ("max_ply", stats.max_ply),
        ("max_ball_intersections", stats.max_ball_intersections),
    ];
    let numbers = [
        ("mean_ply", stats.mean_ply),
        ("mean_ball_intersections", stats.mean_ball_intersections),
        ("feature_size_constant", stats.feature_size_constant),
        ("insertion_constant_input", stats.insertion_constant_input),
        ("insertion_constant_corner", stats.insertion_constant_corner),
        ("insertion_constant_cage", stats.insertion_constant_cage),
    ];
    for (name, value) in counts {
        if measured { object.count(name, value) } else { object.null(name) }
    }
    for (name, value) in numbers {
        if measured { object.number(name, value) } else { object.null(name) }
    }
}
