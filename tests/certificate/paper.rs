//! Corruptions of what the paper asks for.

use super::meshes::{BY_HAND, Case, brute_force, by_hand, pairs, random_points, run};
use super::{assert_sound, assert_violates, report};
use netmesh::options::{Algorithm, Criterion, Options, Output};
use netmesh::quality::measure;
use netmesh::validate::ViolationKind as Kind;
use netmesh::{Domain, Inputs, NONE, VertexKind};

/// A hierarchical mesh by hand, and real ones of pairs, each pair in a domain of its own.
fn cases() -> Vec<Case> {
    let options = Options::default();
    vec![
        by_hand(&BY_HAND, &[]),
        run(&pairs::<2>(6, 1e-9, 2), &options),
        run(&pairs::<3>(4, 1e-9, 2), &options),
    ]
}

fn assert_all(kind: Kind, corrupt: impl Fn(&mut Case)) {
    for mut case in cases() {
        assert!(case.mesh.domains.len() > 1);
        corrupt(&mut case);
        assert_violates(&case, kind);
    }
}

#[test]
fn the_cases_are_sound() {
    cases().iter().for_each(assert_sound);
}

#[test]
fn changed_bits_of_an_input() {
    assert_all(Kind::InputBits, |case| {
        case.mesh.points[4] = f64::from_bits(case.mesh.points[4].to_bits() ^ 1);
    });
    let mut case = brute_force(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]);
    case.mesh.points[0] = -0.0;
    assert_violates(&case, Kind::InputBits);
}

#[test]
fn zeros_of_either_sign_share_a_vertex() {
    let mut case = brute_force(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]);
    case.inputs = Inputs::new(2, 4, &[0.0, 0.0, 1.0, 0.0, 0.5, 1.0, -0.0, 0.0], 0).unwrap();
    assert_sound(&case);
}

#[test]
fn inputs_of_another_mesh() {
    let mut case = brute_force(&random_points::<2>(14, 1));
    case.inputs = Inputs::new(2, 15, random_points::<2>(15, 1).as_flattened(), 0).unwrap();
    assert_violates(&case, Kind::InputVertex);
}

#[test]
fn wrong_kinds() {
    assert_all(Kind::VertexKind, |case| case.mesh.kinds[1] = VertexKind::Steiner);
    assert_all(Kind::VertexKind, |case| {
        let steiner = case.mesh.kinds.iter().position(|&kind| kind == VertexKind::Steiner);
        case.mesh.kinds[steiner.unwrap()] = VertexKind::Input;
    });
}

#[test]
fn domains_in_a_plain_triangulation() {
    let mut case = brute_force(&random_points::<2>(14, 1));
    case.mesh.domains.push(Domain { center: 0, parent: NONE, radius: 1.0 });
    assert_violates(&case, Kind::PlainDelaunay);
    case.mesh.domains.clear();
    case.mesh.vertex_domains[3] = 0;
    assert_violates(&case, Kind::PlainDelaunay);
}

#[test]
fn a_steiner_vertex_in_a_plain_triangulation() {
    let mut case = run(&random_points::<2>(30, 1), &Options::default());
    case.mesh.parameters.algorithm = Algorithm::Delaunay;
    case.mesh.domains.clear();
    case.mesh.vertex_domains.fill(NONE);
    case.mesh.cage_of.fill(NONE);
    assert_violates(&case, Kind::PlainDelaunay);
}

#[test]
fn domains_that_are_no_tree() {
    assert_all(Kind::DomainTree, |case| case.mesh.domains[1].parent = 1);
    assert_all(Kind::DomainTree, |case| case.mesh.domains[1].parent = NONE);
    assert_all(Kind::DomainTree, |case| case.mesh.domains[0].parent = 1);
    assert_all(Kind::DomainTree, |case| case.mesh.domains.clear());
}

#[test]
fn domains_that_are_no_balls() {
    assert_all(Kind::DomainBall, |case| case.mesh.domains[1].radius = 0.0);
    assert_all(Kind::DomainBall, |case| case.mesh.domains[1].radius = f64::NAN);
    assert_all(Kind::DomainBall, |case| case.mesh.domains[0].center = NONE);
}

#[test]
fn a_centre_outside_its_domain() {
    assert_all(Kind::DomainCenter, |case| {
        let outside = case.mesh.vertex_domains.iter().position(|&label| label == 0);
        case.mesh.domains[1].center = outside.unwrap() as u32;
    });
}

#[test]
fn a_ball_beyond_its_parent() {
    assert_all(Kind::DomainOutsideParent, |case| {
        case.mesh.domains[1].radius = case.mesh.domains[0].radius;
    });
}

#[test]
fn overlapping_siblings() {
    let options = Options::default();
    for mut case in [run(&pairs::<2>(6, 1e-9, 2), &options), run(&pairs::<3>(4, 1e-9, 2), &options)]
    {
        let mesh = &mut case.mesh;
        assert!(mesh.domains[1].parent == 0 && mesh.domains[2].parent == 0);
        let [a, b] = [1, 2].map(|i| mesh.point(mesh.domains[i].center));
        let squared: f64 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
        mesh.domains[1].radius = squared.sqrt();
        assert_violates(&case, Kind::DomainsOverlap);
    }
}

#[test]
fn wrong_labels() {
    assert_all(Kind::VertexDomain, |case| {
        let count = case.mesh.kinds.len();
        case.mesh.vertex_domains[count / 2] = case.mesh.domains.len() as u32;
    });
    // A hull vertex is in no inner ball.
    assert_all(Kind::VertexDomain, |case| {
        let hull = case.mesh.neighbors.iter().position(|&n| n == NONE).unwrap();
        let per_simplex = case.mesh.dim + 1;
        let slot = (hull + 1) % per_simplex;
        let vertex = case.mesh.simplices[hull / per_simplex * per_simplex + slot];
        case.mesh.vertex_domains[vertex as usize] = 1;
    });
    // A vertex that is no centre belongs to the innermost ball that holds it.
    assert_all(Kind::VertexDomain, |case| {
        let mesh = &mut case.mesh;
        let inside =
            |&v: &usize| mesh.vertex_domains[v] == 1 && mesh.domains[1].center as usize != v;
        let vertex = (0..mesh.kinds.len()).find(inside).unwrap();
        mesh.vertex_domains[vertex] = 0;
    });
}

#[test]
fn cage_vertices_of_no_cage() {
    let cage_vertex = |case: &Case| case.mesh.cage_of.iter().position(|&cage| cage == 1).unwrap();
    assert_all(Kind::CageOf, |case| {
        let vertex = cage_vertex(case);
        case.mesh.cage_of[vertex] = NONE;
    });
    assert_all(Kind::CageOf, |case| {
        let vertex = cage_vertex(case);
        case.mesh.kinds[vertex] = VertexKind::Steiner;
    });
    assert_all(Kind::CageOf, |case| {
        let vertex = cage_vertex(case);
        case.mesh.cage_of[vertex] = case.mesh.domains.len() as u32;
    });
    assert_all(Kind::CageOf, |case| {
        let outer = case.mesh.cage_of.iter().position(|&cage| cage == 0).unwrap();
        case.mesh.cage_of[outer] = 1;
    });
}

#[test]
fn a_shrunken_cage() {
    assert_all(Kind::CageRadius, |case| case.mesh.domains[1].radius *= 0.87);
}

#[test]
fn a_cage_with_holes() {
    assert_all(Kind::CageIncomplete, |case| {
        let mesh = &mut case.mesh;
        let caged = |&v: &usize| mesh.cage_of[v] == 1;
        let cage: Vec<usize> = (0..mesh.kinds.len()).filter(caged).collect();
        for &v in &cage[mesh.dim..] {
            mesh.cage_of[v] = NONE;
            mesh.kinds[v] = VertexKind::Steiner;
        }
    });
}

#[test]
fn a_hull_vertex_that_is_in_no_cage() {
    assert_all(Kind::HullVertex, |case| {
        let mesh = &mut case.mesh;
        // The last vertex of the root's cage is on the hull by its template.
        let vertex = mesh.cage_of.iter().rposition(|&cage| cage == 0).unwrap();
        mesh.cage_of[vertex] = NONE;
        mesh.kinds[vertex] = VertexKind::Steiner;
    });
}

#[test]
fn an_input_between_epsilon_and_one_radius() {
    let mut inputs = BY_HAND.to_vec();
    inputs.push(([-0.02, -0.055], 1));
    assert_violates(&by_hand(&inputs, &[]), Kind::InnerEncroachment);
    // The same point as a Steiner vertex encroaches nothing.
    assert_sound(&by_hand(&BY_HAND, &[([-0.02, -0.055], 1)]));
}

#[test]
fn an_input_that_encroaches_a_grandparent() {
    // A pair in a domain of its own that reaches beyond epsilon of its parent.
    let mut inputs = BY_HAND.to_vec();
    inputs.push(([-0.02, -0.055], 2));
    let mut case = by_hand(&inputs, &[]);
    case.mesh.domains.push(Domain { center: 4, parent: 1, radius: 1e-3 });
    case.mesh.precision_limited[4] = true;
    assert_violates(&case, Kind::InnerEncroachment);
    assert_eq!(report(&case).first.unwrap().domain, 1);
}

#[test]
fn a_vertex_just_outside_a_ball() {
    assert_violates(&by_hand(&BY_HAND, &[([0.12, -0.1], 0)]), Kind::OuterEncroachment);
    let mut inputs = BY_HAND.to_vec();
    inputs.push(([-0.11, 0.15], 0));
    assert_violates(&by_hand(&inputs, &[]), Kind::OuterEncroachment);
    assert_sound(&by_hand(&BY_HAND, &[([0.15, -0.15], 0)]));
}

#[test]
fn a_chain_of_domains_that_is_absurdly_long() {
    let mut case = by_hand(&BY_HAND, &[]);
    let mesh = &mut case.mesh;
    for i in 0..100_000u32 {
        let radius = 0.02 / (1.0 + 1e-4 * f64::from(i));
        mesh.domains.push(Domain { center: 0, parent: i + 1, radius });
    }
    mesh.vertex_domains[0] = mesh.domains.len() as u32 - 1;
    mesh.precision_limited[0] = true;
    assert_violates(&case, Kind::DomainSpan);
}

#[test]
fn encroachment_by_tighter_parameters() {
    assert_all(Kind::OuterEncroachment, |case| case.mesh.parameters.encroachment = 1e12);
    for mut case in [by_hand(&BY_HAND, &[]), run(&pairs::<2>(6, 1e-9, 2), &Options::default())] {
        case.mesh.parameters.epsilon = 0.1;
        case.mesh.parameters.encroachment = 0.2;
        assert_violates(&case, Kind::InnerEncroachment);
    }
}

#[test]
fn cells_of_bad_aspect() {
    // Without the Steiner points the cells round two inputs close together are long.
    let mut inputs = BY_HAND.to_vec();
    inputs.push(([0.93, 0.31], 0));
    let mut case = by_hand(&inputs, &[]);
    assert_sound(&case);
    case.mesh.parameters.quality_bound = 3.0;
    assert_violates(&case, Kind::VertexAspect);
    assert_all(Kind::VertexAspect, |case| {
        case.mesh.parameters.quality_bound = measure(&case.mesh).unwrap().worst_aspect * 0.999;
        for v in 0..case.mesh.kinds.len() {
            // Exempt the centres, and with them the cages.
            case.mesh.precision_limited[v] =
                case.mesh.domains.iter().any(|d| d.center as usize == v);
        }
        case.mesh.parameters.quality_bound = measure(&case.mesh).unwrap().worst_aspect * 0.999;
    });
}

#[test]
fn precision_limited_cells_are_exempt() {
    for mut case in cases() {
        case.mesh.parameters.quality_bound = 1.0;
        case.mesh.precision_limited.fill(true);
        assert_sound(&case);
        let quality = measure(&case.mesh).unwrap();
        assert_eq!((quality.worst_aspect, quality.worst_cage_aspect), (0.0, 0.0));
        assert_eq!(quality.precision_limited, case.mesh.kinds.len() as u64);
    }
}

#[test]
fn union_cells_of_bad_aspect() {
    let mut found = 0;
    for case in cases() {
        for domain in 1..case.mesh.domains.len() {
            let mut case = case.clone();
            let center = case.mesh.domains[domain].center as usize;
            let mesh = &mut case.mesh;
            // Only the cell of this centre and the union cell of its cage stay bounded.
            for v in 0..mesh.kinds.len() {
                mesh.precision_limited[v] = v != center && mesh.cage_of[v] != domain as u32;
            }
            let quality = measure(mesh).unwrap();
            mesh.parameters.quality_bound = quality.worst_aspect_anywhere * 1.001;
            assert_sound(&case);
            case.mesh.parameters.quality_bound = quality.worst_cage_aspect * 0.999;
            let first = report(&case).first.expect("the union cell is too long");
            found += u32::from(first.kind == Kind::CageAspect);
        }
    }
    assert!(found > 5, "else the cells of centres are too long as well: {found}");
}

/// Cells whose worst corner is beyond the corner restriction are bounded too.
#[test]
fn cells_that_look_out_between_the_vertices_of_a_cage() {
    let mut found = 0;
    for seed in 1..20 {
        let mut case = run(&pairs::<3>(4, 1e-9, seed), &Options::default());
        let quality = measure(&case.mesh).unwrap();
        let inside = quality.worst_aspect.max(quality.worst_cage_aspect);
        if quality.worst_aspect_anywhere > 1.01 * inside {
            case.mesh.parameters.quality_bound = inside * 1.001;
            assert_ne!(report(&case).violations, 0);
            found += 1;
        }
    }
    assert!(found > 3);
}

#[test]
fn simplices_of_bad_radius_edge_ratio() {
    for mut case in [
        run(&random_points::<2>(60, 1), &Options::default()),
        run(&pairs::<3>(12, 1e-9, 2), &Options::default()),
    ] {
        case.mesh.parameters.criterion = Criterion::RadiusEdge;
        assert_sound(&case);
        case.mesh.parameters.quality_bound = 0.7;
        assert_violates(&case, Kind::RadiusEdge);
    }
}

#[test]
fn a_finished_mesh_with_two_domains() {
    assert_all(Kind::NotFinished, |case| case.mesh.parameters.output = Output::WellSpaced);
}

/// A simplex below the asked angle that the run does not own up to.
#[test]
fn slivers_that_are_not_counted() {
    let options = Options {
        output: Output::WellSpaced,
        criterion: Criterion::RadiusEdge,
        min_dihedral: 15.0,
        ..Options::default()
    };
    let mut case = run(&random_points::<3>(200, 3), &options);
    assert_sound(&case);
    let most = (16..40).map(f64::from).find(|&degrees| {
        case.mesh.parameters.min_dihedral = degrees;
        measure(&case.mesh).unwrap().below_min_dihedral > 0
    });
    assert!(most.is_some_and(|degrees| degrees < 20.0));
    assert_violates(&case, Kind::DihedralAngle);
    case.mesh.below_min_dihedral = (0..case.mesh.simplex_count() as u32).collect();
    assert_sound(&case);
}
