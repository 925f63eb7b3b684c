//! Pictures and pages for browsers, and a page in one: in headless Chromium its picture has the
//! colours that the legend tells, and the cutting plane changes it. Where there is no Chromium or
//! no `python3`, which counts the colours, these tests say so and pass.

use crate::workbench::Workbench;
use std::collections::HashMap;
use std::process::{Command, Stdio};

const PIXELS: &str = include_str!("pixels.py");

/// Sides of the window; the picture is what the panel of 300 pixels leaves.
const WINDOW: (u32, u32) = (900, 600);
const PICTURE: u32 = WINDOW.0 - 300;

/// Colours of the first two regions, of the first three markers, of what has none, and of nothing.
const REGIONS: [&str; 2] = ["#7fb3d5", "#f5b971"];
const MARKERS: [&str; 3] = [REGIONS[0], REGIONS[1], "#8fcf9b"];
const GREY: &str = "#aaaaaa";
const WHITE: &str = "#ffffff";

/// Two squares side by side, with a label each.
const PLANE: &str = "6 2 0 0\n1 0 0\n2 1 0\n3 2 0\n4 0 1\n5 1 1\n6 2 1\n\
                     7 0\n1 1 2\n2 2 3\n3 3 6\n4 6 5\n5 5 4\n6 4 1\n7 2 5\n\
                     0\n2\n1 0.5 0.5 3\n2 1.5 0.5 9\n";

/// The cube, with attributes at its corners that CSV would have.
const CUBE: &str = "OFF\n8 12 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n\
                    3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n\
                    3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";

/// The cube, whose sides at the ends of y have the markers 1 and 2.
const MARKED: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
                      f 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n\
                      g front\nf 1 2 6 5\ng back\nf 3 7 8 4\n";

fn bench_with(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("marked.obj", MARKED);
    bench.write("plane.poly", PLANE);
    bench.write("cube.off", CUBE);
    bench
}

/// Returns the mesh that a page has as JSON.
fn mesh_of(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("type=\"application/json\">").expect("the mesh");
    serde_json::from_str(rest.split_once("</script>").expect("its end").0).expect("JSON")
}

#[test]
fn pages_and_pictures_are_written_with_regions_and_attributes() {
    let bench = bench_with("pages");
    bench.run("plane.poly --min-angle 25 --max-edge 0.2 -q -o plane.svg").assert_success();
    let picture = bench.read("plane.svg");
    for (colour, label) in REGIONS.iter().zip([3, 9]) {
        let region = format!("<g><title>region {label}</title>\n<path fill=\"{colour}\"");
        assert_eq!(picture.matches(&region).count(), 1, "{label}");
    }
    bench.run("cube.off -q -o cube.html").assert_success();
    let mesh = mesh_of(&bench.read("cube.html"));
    assert_eq!((&mesh["dim"], &mesh["cells"]), (&3.into(), &mesh["all"]));
    bench.run("marked.obj --max-edge 0.3 -q -o marked.html").assert_success();
    let mesh = mesh_of(&bench.read("marked.html"));
    let of_facets = |labels: &&serde_json::Value| labels["of"] == "facets";
    let labels = mesh["labels"].as_array().expect("labels").iter().find(of_facets).expect("one");
    assert_eq!(labels["distinct"], serde_json::json!([0, 1, 2]));
    assert_eq!([&labels["name"], &labels["key"]], ["facet marker", "markers"]);
    // Numbers have four bytes, and three bytes four digits of base64.
    let [markers, facets] = [&labels["values"], &mesh["facets"]]
        .map(|array| array.as_str().expect("base64").trim_end_matches('=').len() * 3 / 4 / 4);
    assert!(markers > 100 && facets == 3 * markers, "{markers} markers, {facets} corners");
    bench.write("heat.csv", "x,y,z,heat\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,-4\n");
    bench.run("heat.csv --attributes heat -q -o heat.html").assert_success();
    let heat = &mesh_of(&bench.read("heat.html"))["attributes"][0];
    let [name, least, most] = ["name", "least", "most"].map(|field| heat[field].to_string());
    assert_eq!([name, least, most], ["\"heat\"", "-4", "3"]);
    bench.run("cube.off -q -o cube.svg").assert_failure(2, &["cube.svg", "not 3; use HTML"]);
    let refusal = ["plane.svg", "SVG holds no attributes", "NumPy or HTML"];
    bench.run("heat.csv --attributes heat -q -o plane.svg").assert_failure(2, &refusal);
}

/// Returns the name of a Chromium that is here and can draw, if Python is here, too.
fn browser() -> Option<&'static str> {
    let runs = |name: &str| {
        let mut command = Command::new(name);
        let command = command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
    let found = names.into_iter().find(|name| runs(name));
    match (found, runs("python3")) {
        (None, _) => eprintln!("skipped: no Chromium on the search path (Debian: chromium)"),
        (_, false) => eprintln!("skipped: no python3 on the search path"),
        (Some(name), true) => return Some(name),
    }
    None
}

/// Opens a page of the bench, `file#fragment`, with further words for the browser, and returns what
/// it prints. No name of a host is found.
fn open(browser: &str, bench: &Workbench, page: &str, word: &str) -> String {
    let folder = bench.directory();
    let (width, height) = WINDOW;
    let output = Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run"])
        .args(["--hide-scrollbars", "--force-device-scale-factor=1", "--disable-extensions"])
        .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=8000"])
        .arg(format!("--user-data-dir={}", folder.join("browser").display()))
        .arg(format!("--window-size={width},{height}"))
        .arg(word)
        .arg(format!("file://{}/{page}", folder.display()))
        .current_dir(folder)
        .output()
        .expect("the browser starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Returns the colours of a page's picture, and the share that each has of it.
fn colours(browser: &str, bench: &Workbench, page: &str) -> HashMap<String, f64> {
    open(browser, bench, page, "--screenshot=picture.png");
    let picture = bench.directory().join("picture.png");
    let mut python = Command::new("python3");
    let counted = python.args(["-c", PIXELS]).arg(&picture).arg(PICTURE.to_string()).output();
    let counted = counted.expect("python3 starts");
    assert!(counted.status.success(), "{}", String::from_utf8_lossy(&counted.stderr));
    std::fs::remove_file(&picture).expect("the screenshot");
    let pixels = f64::from(PICTURE * WINDOW.1);
    let share = |line: &str| {
        let (count, colour) = line.split_once(' ')?;
        Some((colour.to_owned(), count.parse::<f64>().ok()? / pixels))
    };
    let text = String::from_utf8(counted.stdout).expect("text");
    text.lines().map(|line| share(line).expect("a count and a colour")).collect()
}

/// Asserts that a colour has a share of the picture between the given ones.
#[track_caller]
fn assert_share(colours: &HashMap<String, f64>, colour: &str, least: f64, most: f64) {
    let share = colours.get(colour).copied().unwrap_or(0.0);
    assert!((least..=most).contains(&share), "{colour}: {share}, {least} to {most} expected");
}

/// Asserts that a picture has some colours of the scale in the legend, and white alone besides.
#[track_caller]
fn assert_on_scale(colours: &HashMap<String, f64>) {
    const SCALE: [[f64; 3]; 5] =
        [[68., 1., 84.], [59., 82., 139.], [33., 145., 140.], [94., 201., 98.], [253., 231., 37.]];
    let place = |step: usize| {
        let (from, part) = (step / 100, (step % 100) as f64 / 100.0);
        [0, 1, 2].map(|at| SCALE[from][at] + part * (SCALE[from + 1][at] - SCALE[from][at]))
    };
    let channels = |colour: &str| {
        [1, 3, 5].map(|at| f64::from(u8::from_str_radix(&colour[at..at + 2], 16).expect("hex")))
    };
    let is_near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2.0);
    let is_on = |colour: &str| (0..400).any(|step| is_near(place(step), channels(colour)));
    // At the boundary there are mixtures.
    let share = |wanted: bool| {
        let other = colours.iter().filter(|(colour, _)| **colour != *WHITE);
        other.filter(|(colour, _)| is_on(colour) == wanted).map(|(_, share)| share).sum::<f64>()
    };
    let (on, off) = (share(true), share(false));
    let seen = colours.iter().filter(|(_, share)| **share > 1e-3).count();
    assert!(on > 0.1 && off < 0.05 * on, "{on} on the scale, {off} beside it");
    assert!(seen > 5 && colours[WHITE] < 0.9, "{seen} colours");
}

#[test]
fn a_browser_shows_regions_of_the_plane_and_cuts_them() {
    let Some(browser) = browser() else { return };
    let bench = bench_with("browser_plane");
    bench.run("plane.poly --min-angle 25 --max-edge 0.2 -q -o plane.html").assert_success();
    let page = "plane.html#by=regions&edges=0&lines=0&dots=0";
    // The squares fill the width but for a margin, and so a little less than half of the picture.
    let whole = colours(browser, &bench, page);
    REGIONS.iter().for_each(|colour| assert_share(&whole, colour, 0.2, 0.25));
    assert_share(&whole, WHITE, 0.5, 0.6);
    // Half of them is cut off, and then the other half.
    let left = colours(browser, &bench, &format!("{page}&cut=0.5&axis=x"));
    assert_share(&left, REGIONS[0], 0.2, 0.25);
    assert_share(&left, REGIONS[1], 0.0, 0.0);
    let right = colours(browser, &bench, &format!("{page}&cut=0.5&axis=x&keep=above"));
    assert_share(&right, REGIONS[0], 0.0, 0.0);
    assert_share(&right, REGIONS[1], 0.2, 0.25);
    // Edges, segments and inputs are drawn over the regions.
    let drawn = colours(browser, &bench, "plane.html#by=regions");
    assert_share(&drawn, "#000000", 0.002, 0.02);
    assert_share(&drawn, "#a3262b", 0.0002, 0.002);
    assert!(drawn.len() > 3 * whole.len(), "{}", drawn.len());
}

#[test]
fn a_click_tells_the_cell_under_it() {
    let Some(browser) = browser() else { return };
    let bench = bench_with("browser_click");
    bench.run("plane.poly --min-angle 25 --max-edge 0.2 -q -o plane.html").assert_success();
    // The mesh is as wide as the picture, but for a margin of a twentieth.
    let click = "<script>setTimeout(() => { const { clientWidth: x, clientHeight: y } = \
                 viewer.picture.canvas; viewer.pick(0.3 * x, 0.5 * y - 0.05 * x); }, 500)</script>\
                 </body>";
    bench.write("click.html", &bench.read("plane.html").replace("</body>", click));
    let page = open(browser, &bench, "click.html", "--dump-dom");
    let (_, told) = page.split_once("<p id=\"picked\">").expect("a paragraph");
    let told = told.split_once("</p>").expect("its end").0;
    assert!(told.starts_with("Cell ") && told.contains("\nregion: 3\n"), "{told}");
    let corner = |line: &str| {
        let (_, place) = line.split_once(" at (")?;
        let (x, y) = place.strip_suffix(')')?.split_once(", ")?;
        Some([x.parse::<f64>().ok()?, y.parse::<f64>().ok()?])
    };
    let corners: Vec<[f64; 2]> = told.lines().filter_map(corner).collect();
    let place = [1.0 - 0.4 * 1.05, 0.5 + 0.1 * 1.05];
    let turns = (0..3).map(|from| {
        let [a, b] = [corners[from], corners[(from + 1) % 3]];
        (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0])
    });
    assert!(corners.len() == 3 && turns.into_iter().all(|turn| turn > -1e-3), "{told}");
}

#[test]
fn a_browser_shows_qualities_and_attributes_in_the_colours_of_the_legend() {
    let Some(browser) = browser() else { return };
    let bench = bench_with("browser_scale");
    for dim in [2, 3] {
        let term = |i: usize| (i as f64 * 0.754_877_666 + (i * i) as f64 * 0.569_840_291).fract();
        let row = |i: usize| (0..dim).map(move |axis| term(dim * i + axis).to_string());
        let rows = (0..40).map(|i| row(i).chain([i.to_string()]).collect::<Vec<_>>().join(" "));
        bench.write("points.xyz", &rows.collect::<Vec<_>>().join("\n"));
        let attributes = format!("--attributes heat={}", dim + 1);
        bench.run(&format!("points.xyz {attributes} -q -o a.html")).assert_success();
        for by in ["angle", "heat"] {
            let page = format!("a.html#by={by}&edges=0&dots=0&light=0");
            assert_on_scale(&colours(browser, &bench, &page));
        }
    }
}

#[test]
fn a_browser_shows_a_part_in_space_and_its_inside() {
    let Some(browser) = browser() else { return };
    let bench = bench_with("browser_space");
    bench.run("cube.off --max-edge 0.3 -q -o cube.html").assert_success();
    let page = "cube.html#by=regions&edges=0&lines=0&light=0&turn=90,0";
    let whole = colours(browser, &bench, page);
    let share = whole.get(REGIONS[0]).copied().unwrap_or(0.0);
    assert!((0.5..0.95).contains(&share), "{share}");
    // As seen along y, half of the cube is left of the plane, or below the other.
    for axis in ["x", "z"] {
        let cut = colours(browser, &bench, &format!("{page}&cut=0.5&axis={axis}"));
        assert_share(&cut, REGIONS[0], 0.4 * share, 0.65 * share);
    }
    // What is told beside the picture.
    let cells = mesh_of(&bench.read("cube.html"))["all"].as_u64().expect("a number");
    let page = open(browser, &bench, "cube.html#cut=0", "--dump-dom");
    let (_, told) = page.split_once("aria-live=\"polite\">").expect("a sentence");
    let told = told.split_once("</p>").expect("its end").0.replace("&nbsp;", "");
    let expected = format!("Shown: 0 of {cells} tetrahedra; cut at x = 0, what is below is kept");
    assert_eq!(told, expected);
    assert!(page.contains("<h1 id=\"name\">cube.html</h1>"));
    assert!(page.contains("<p id=\"fault\" hidden=\"\"></p>"));
}

#[test]
fn a_browser_shows_facets_in_the_colours_of_their_markers() {
    let Some(browser) = browser() else { return };
    let bench = bench_with("browser_markers");
    bench.run("marked.obj --max-edge 0.3 -q -o marked.html").assert_success();
    let front = "edges=0&lines=0&light=0&turn=-90,0";
    let assert_alone = |seen: &HashMap<String, f64>, colour: &str| {
        assert_share(seen, colour, 0.5, 0.95);
        let others = MARKERS.iter().chain(&[GREY]).filter(|other| **other != colour);
        others.for_each(|other| assert_share(seen, other, 0.0, 0.0));
    };
    let page = format!("marked.html#by=markers&{front}");
    assert_alone(&colours(browser, &bench, &page), MARKERS[1]);
    let back = page.replace("-90", "90");
    assert_alone(&colours(browser, &bench, &back), MARKERS[2]);
    // Where it is cut, sides of cells are in no facet.
    let cut = colours(browser, &bench, &format!("{page}&cut=0.5&axis=y&keep=above"));
    assert_share(&cut, GREY, 0.3, 0.95);
    assert_share(&cut, MARKERS[1], 0.0, 0.0);
    // Without the side in front, the one behind is seen from inside.
    let hide = "<script>setTimeout(() => viewer.toggle(1), 500)</script></body>";
    bench.write("hidden.html", &bench.read("marked.html").replace("</body>", hide));
    let hidden = colours(browser, &bench, &format!("hidden.html#by=markers&{front}"));
    assert_share(&hidden, MARKERS[1], 0.0, 0.0);
    assert_share(&hidden, MARKERS[2], 0.2, 0.9);
    // By regions all sides are alike.
    let plain = colours(browser, &bench, &format!("marked.html#by=regions&{front}"));
    assert_alone(&plain, REGIONS[0]);
}
