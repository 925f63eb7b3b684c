//! The page as a browser gets it: its JSON is that of the mesh, and nothing in it asks a network.

use super::super::{Format, Markers, samples, write, write_with};
use super::*;
use crate::error::ErrorKind;
use crate::mesh::Mesh;
use crate::quality;

fn page(mesh: &Mesh, attributes: &[Attribute]) -> String {
    let mut page = Vec::new();
    write_with(mesh, attributes, Format::Html, &mut page).unwrap();
    String::from_utf8(page).unwrap()
}

fn thinned(mesh: &Mesh, limit: usize) -> String {
    let mut page = Vec::new();
    let markers = Markers::of(mesh).facets;
    let mesh = mesh.triangulation().unwrap();
    let measures = Measures::of(mesh).unwrap();
    Page::new(mesh, markers, &[], &measures, limit).unwrap().write(&mut page).unwrap();
    String::from_utf8(page).unwrap()
}

/// Returns the mesh as JSON.
fn json_of(page: &str) -> &str {
    let (_, rest) = page.split_once("<script id=\"mesh\" type=\"application/json\">").unwrap();
    rest.split_once("</script>").unwrap().0
}

/// Returns the text after `field` up to the next comma, bracket or quote.
fn field<'a>(json: &'a str, field: &str) -> &'a str {
    let (_, rest) = json.split_once(&format!("\"{field}\":")).unwrap_or_else(|| panic!("{field}"));
    let rest = rest.strip_prefix('"').unwrap_or(rest);
    rest.split([',', '"', '}', ']']).next().unwrap()
}

/// Decodes base64, digit by digit.
fn bytes(text: &str) -> Vec<u8> {
    let digit = |c: char| match c {
        'A'..='Z' => c as u32 - 65,
        'a'..='z' => c as u32 - 71,
        '0'..='9' => c as u32 + 4,
        '+' => 62,
        '/' => 63,
        _ => panic!("{c} is no digit of base64"),
    };
    let digits: Vec<u32> = text.trim_end_matches('=').chars().map(digit).collect();
    let groups = digits.chunks(4).flat_map(|group| {
        let bits = group.iter().zip([18, 12, 6, 0]).map(|(digit, shift)| digit << shift);
        bits.sum::<u32>().to_be_bytes()[1..group.len()].to_vec()
    });
    groups.collect()
}

fn singles(text: &str) -> Vec<f32> {
    bytes(text).chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

fn ids(text: &str) -> Vec<u32> {
    bytes(text).chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect()
}

/// Returns the array `values` after `name`.
fn values<'a>(json: &'a str, name: &str) -> &'a str {
    let (_, rest) = json.split_once(&format!("\"name\":\"{name}\"")).unwrap();
    field(rest, "values")
}

#[test]
fn the_page_has_the_mesh() {
    for dim in [2, 3] {
        let mesh = samples::finished(dim);
        let triangulation = mesh.triangulation().unwrap();
        let page = page(&mesh, &[]);
        let json = json_of(&page);
        let count = |name: &str| field(json, name).parse::<usize>().unwrap();
        assert_eq!(count("dim"), dim);
        assert_eq!(count("vertices"), triangulation.vertex_count());
        assert_eq!(count("cells"), triangulation.simplex_count());
        assert_eq!([count("all"), count("triangles")], [triangulation.simplex_count(), 0]);
        assert_eq!(ids(field(json, "simplices")), triangulation.simplices);
        let kinds: Vec<u8> = triangulation.kinds.iter().map(|kind| *kind as u8).collect();
        assert_eq!(bytes(field(json, "kinds")), kinds);
        // The points are where they were, but for single precision.
        let half: f64 = field(json, "half").parse().unwrap();
        let (_, center) = json.split_once("\"center\":[").unwrap();
        let center: Vec<f64> =
            center.split([',', ']']).take(dim).map(|x| x.parse().unwrap()).collect();
        let points = singles(field(json, "points"));
        assert_eq!(points.len(), 3 * triangulation.vertex_count());
        for (placed, point) in points.chunks_exact(3).zip(triangulation.points.chunks_exact(dim)) {
            for axis in 0..dim {
                let back = center[axis] + half * f64::from(placed[axis]);
                assert!((back - point[axis]).abs() <= 1e-6 * half, "{back} {}", point[axis]);
            }
            assert!(placed.iter().all(|x| x.abs() <= 1.0));
        }
        assert!(page.contains(&format!("<title>{} t", grouped(triangulation.simplex_count()))));
        assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
        assert!(!page.contains("class=\"thinned\""));
    }
}

#[test]
fn measures_are_those_of_the_mesh() {
    let mesh = samples::finished(3);
    let triangulation = mesh.triangulation().unwrap();
    let page = page(&mesh, &[]);
    let json = json_of(&page);
    let angles = singles(values(json, "smallest dihedral angle"));
    assert_eq!(angles.len(), triangulation.simplex_count());
    let bounds = quality::histogram(triangulation, quality::Measure::SmallestAngle, true, &[30.0]);
    let bounds = bounds.unwrap();
    let least = angles.iter().copied().fold(f32::INFINITY, f32::min);
    let most = angles.iter().copied().fold(0.0, f32::max);
    assert_eq!((least, most), (bounds.least as f32, bounds.largest as f32));
    let told =
        format!("Smallest dihedral angle {} degrees", crate::io::picture::figure(bounds.least));
    assert!(page.contains(&told));
    let measures = Measures::of(triangulation).unwrap();
    let ratios: Vec<f32> = measures.radius_edge.iter().map(|ratio| *ratio as f32).collect();
    assert_eq!(singles(values(json, "radius-edge ratio")), ratios);
    let aspects = singles(values(json, "aspect of Voronoi cells"));
    let alike = |(a, b): (&f32, &f64)| *a == *b as f32 || a.is_nan() && b.is_nan();
    assert!(aspects.iter().zip(&measures.aspect).all(alike));
    assert_eq!(aspects.len(), triangulation.vertex_count());
}

#[test]
fn labels_and_segments_are_those_of_the_mesh() {
    let page = page(&samples::square_with_segments(), &[]);
    let json = json_of(&page);
    assert!(json.contains(r#""name":"region","key":"regions","distinct":[-8,7]"#), "{json}");
    let regions = ids(values(json, "region"));
    assert_eq!(regions, [7, -8i32 as u32]);
    assert_eq!(ids(field(json, "ends")), [0, 2, 1, 0]);
    assert_eq!(field(json, "segments"), "2");
    let nested = samples::nested(3);
    let triangulation = nested.triangulation().unwrap();
    let page = self::page(&nested, &[]);
    let json = json_of(&page);
    let simplices = triangulation.simplices.chunks_exact(4);
    let domains: Vec<u32> = simplices.map(|cell| domain_of(triangulation, cell)).collect();
    assert_eq!(ids(values(json, "domain")), domains);
    assert!(json.contains(r#""key":"domains","distinct":[0,1"#), "{json}");
}

#[test]
fn facets_have_the_markers_of_the_mesh() {
    let mesh = samples::solid_with_facets();
    let page = page(&mesh, &[]);
    let json = json_of(&page);
    let label = r#""name":"facet marker","key":"markers","distinct":[-5,0,9],"of":"facets""#;
    assert!(json.contains(label), "{json}");
    assert_eq!(ids(values(json, "facet marker")), [-5i32 as u32, 9, 0]);
    let facets = mesh.triangulation().unwrap().boundary.subfacets.as_flattened();
    assert_eq!(ids(field(json, "facets")), facets);
    // Of one of two tetrahedra there are the facets whose vertices its outside has, too.
    let one = thinned(&mesh, 1);
    let corners = ids(field(json_of(&one), "facets"));
    assert_eq!(corners.len(), 3 * ids(values(json_of(&one), "facet marker")).len());
    let vertices = field(json_of(&one), "vertices").parse().unwrap();
    assert!(!corners.is_empty() && corners.iter().all(|&corner| corner < vertices));
    // Without markers there is nothing to choose.
    let mesh = mesh.with_facet_markers(vec![0; 3]);
    let page = self::page(&mesh, &[]);
    let json = json_of(&page);
    assert!(field(json, "facets").is_empty() && !json.contains("facet marker"), "{json}");
}

#[test]
fn attributes_are_parts_of_their_range() {
    let attribute = |name: &str, components, values| {
        let name = name.to_string();
        Attribute { name, components, values, is_extended: true }
    };
    let attributes = [
        attribute("heat", 1, vec![10.0, 30.0, 15.0, f64::NAN]),
        attribute("flow", 2, vec![-1e308, 5.0, 1e308, 5.0, 0.0, 5.0, f64::INFINITY, 5.0]),
        attribute("a\"<b", 1, vec![0.0; 4]),
    ];
    let page = page(&samples::square(), &attributes);
    let json = json_of(&page);
    assert!(json.contains(r#"{"name":"heat","least":10,"most":30,"#), "{json}");
    let heat = singles(values(json, "heat"));
    assert!(heat[..3] == [0.0, 1.0, 0.25] && heat[3].is_nan(), "{heat:?}");
    assert!(json.contains(r#"{"name":"flow_0","least":-1e308,"most":1e308,"#), "{json}");
    assert_eq!(singles(values(json, "flow_0")), [0.0, 1.0, 0.5, f32::INFINITY]);
    assert_eq!(singles(values(json, "flow_1")), [0.0; 4]);
    assert!(json.contains(r#"{"name":"a\u0022\u003cb","least":0"#), "{json}");
}

#[test]
fn cells_that_are_left_out_are_told_and_leave_their_outside() {
    let mesh = samples::finished(3);
    let triangulation = mesh.triangulation().unwrap();
    let all = triangulation.simplex_count();
    let limit = all / 2;
    let page = thinned(&mesh, limit);
    let json = json_of(&page);
    let told = |kept, all, of| {
        let how = "are in this file, evenly in their order";
        format!("<li class=\"thinned\">{kept} of {all} {of} {how}</li>")
    };
    assert!(page.contains(&told(limit, all, "tetrahedra")));
    let kept: Vec<usize> = Kept::new(all, limit).iter().collect();
    let outer: Vec<_> = outer_triangles(triangulation)
        .filter(|((cell, _), _)| !kept.contains(&(*cell as usize)))
        .collect();
    assert!(!outer.is_empty() && outer.len() <= limit);
    assert!(page.contains(&format!("All {} outer triangles of the others", outer.len())));
    assert_eq!(field(json, "triangles"), outer.len().to_string());
    // Numbers are those of the vertices in the page.
    let points = singles(field(json, "points"));
    let frame = Frame::new(triangulation);
    let place = |vertex: u32| frame.place(triangulation.point(vertex)).map(|x| x as f32);
    let placed = |id: u32| [0, 1, 2].map(|axis| points[3 * id as usize + axis]);
    let cells: Vec<[f32; 3]> = ids(field(json, "simplices")).into_iter().map(placed).collect();
    let expected = kept.iter().flat_map(|&cell| triangulation.simplex(cell));
    assert_eq!(cells, expected.map(|&vertex| place(vertex)).collect::<Vec<_>>());
    let skin: Vec<[f32; 3]> = ids(field(json, "skin")).into_iter().map(placed).collect();
    let expected = outer.iter().flat_map(|(_, triangle)| *triangle).map(place);
    assert_eq!(skin, expected.collect::<Vec<_>>());
    // Values follow the cells, and then the triangles.
    let angles = singles(values(json, "smallest dihedral angle"));
    let cells = kept.iter().copied().chain(outer.iter().map(|((cell, _), _)| *cell as usize));
    let expected = cells.map(|cell| smallest_angle(triangulation, cell).unwrap() as f32);
    assert_eq!(angles, expected.collect::<Vec<_>>());
    // There may be too many outer triangles, too; in the plane there are none.
    let page = thinned(&mesh, 3);
    assert!(page.contains(&told(3, all, "tetrahedra")));
    assert!(page.contains("3 of ") && page.contains("outer triangles of the others are in this"));
    let square = thinned(&samples::square_with_segments(), 1);
    assert!(square.contains(&told(1, 2, "triangles")));
    assert!(
        square.contains(&told(1, 2, "pieces of segments"))
            && !square.contains("triangles of the others")
    );
    // The segment that is drawn has its vertices.
    assert_eq!(ids(field(json_of(&square), "ends")), [0, 2]);
    assert_eq!(field(json_of(&square), "vertices"), "3");
}

#[test]
fn nothing_in_the_page_asks_a_network_or_is_code_made_of_text() {
    let page = page(&samples::square(), &[]);
    let before = |at: usize| page[..at].rfind(['"', '\'', ' ', '(']).unwrap() + 1;
    let addresses: Vec<&str> = page
        .match_indices("://")
        .map(|(at, _)| page[before(at)..].split(['"', '\'', ' ', ')']).next().unwrap())
        .collect();
    // The name of a kind of element, which is no address that anyone asks.
    assert_eq!(addresses, ["http://www.w3.org/1999/xhtml"]);
    let code = format!("{}{STYLE}{LIBRARY}", SCRIPTS.concat());
    for word in [
        "eval(",
        "new Function",
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "importScripts",
        "import(",
        "@import",
    ] {
        assert!(!code.contains(word), "{word}");
    }
    assert!(!PAGE.contains("src=") && PAGE.matches("href=").eq(["href="]));
    let rule = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'";
    assert!(page.contains(rule));
    // What ends a script early would be shown as text.
    assert_eq!(page.matches("</script>").count(), 3);
    assert!(
        LIBRARY.contains("The MIT License") && LIBRARY.contains("Permission is hereby granted")
    );
    assert!(LIBRARY.len() < 400_000, "{}", LIBRARY.len());
}

#[test]
fn coordinates_that_no_picture_has_are_drawn() {
    for dim in [2, 3] {
        let page = page(&samples::mesh(dim), &[]);
        let json = json_of(&page);
        let points = singles(field(json, "points"));
        assert!(points.iter().all(|x| x.abs() <= 1.0) && points.contains(&1.0), "{points:?}");
        assert!(!json.contains("inf") && !json.contains("NaN"));
    }
}

#[test]
fn other_dimensions_are_refused() {
    let error = write(&samples::mesh(4), Format::Html, &mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    let rule = "HTML holds meshes of dimension 2 and 3, not 4; use OFF (nOFF) or TetGen";
    assert_eq!(error.message(), rule);
}
