//! Pictures and plots: what stands in them, and that they come out the same each time.

use roxmltree::{Document, Node};
use tg_report::{
    Axis, Channel, Frame, MemberOutline, Outline, Picture, Placement, Plot, PlotKind, Projection,
    ReportError, Series, Table, png, strip_png, strip_svg, svg,
};

use crate::sample;

fn texts(document: &Document) -> Vec<String> {
    let nodes = document.descendants().filter(|n| n.has_tag_name("text"));
    nodes.map(|n| n.text().unwrap_or_default().to_owned()).collect()
}

fn with<'a>(document: &'a Document, attribute: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    document.descendants().filter(move |n| n.has_attribute(attribute))
}

/// Width, height and rows of a PNG file; checks every chunk.
fn decoded(png: &[u8]) -> (usize, usize, Vec<Vec<u8>>) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let (mut at, mut size, mut data) = (8, [0; 2], Vec::new());
    while at < png.len() {
        let word = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
        let length = word(at) as usize;
        let (kind, body) = (&png[at + 4..at + 8], &png[at + 8..at + 8 + length]);
        let crc = png[at + 4..at + 8 + length].iter().fold(!0_u32, |crc, &byte| {
            (0..8)
                .fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
        });
        assert_eq!(!crc, word(at + 8 + length));
        match kind {
            b"IHDR" => {
                size = [word(at + 8) as usize, word(at + 12) as usize];
                assert_eq!(body[8..], [8, 2, 0, 0, 0]);
            }
            b"IDAT" => data.extend(body),
            _ => assert_eq!((kind, at + 12), (&b"IEND"[..], png.len())),
        }
        at += 12 + length;
    }
    let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&data).unwrap();
    let mut rows: Vec<Vec<u8>> = Vec::new();
    for row in bytes.chunks_exact(1 + 3 * size[0]) {
        assert_eq!(row[0], 2);
        let above = rows.last().cloned().unwrap_or(vec![0; 3 * size[0]]);
        rows.push(row[1..].iter().zip(&above).map(|(x, up)| x.wrapping_add(*up)).collect());
    }
    assert_eq!(rows.len(), size[1]);
    (size[0], size[1], rows)
}

/// How many pixels have this colour.
fn count(rows: &[Vec<u8>], colour: [u8; 3]) -> usize {
    rows.iter().flat_map(|row| row.chunks_exact(3)).filter(|pixel| *pixel == colour).count()
}

#[test]
fn a_picture_shows_members_cables_and_their_tension() {
    let outline = sample::outline();
    let slack = |f: &Frame| f.cables.iter().filter(|c| c.slack).count();
    let frame = sample::frames(60).into_iter().find(|f| slack(f) == 1).unwrap();
    for projection in [Projection::Front, Projection::Side, Projection::Top, Projection::Isometric] {
        let picture = Picture { projection, title: "A <tower>".into(), ..Picture::default() };
        let text = svg(&outline, &frame, &picture).unwrap();
        assert_eq!(text, svg(&outline, &frame, &picture).unwrap());
        let document = Document::parse(&text).unwrap();
        let titles: Vec<_> = document.descendants().filter(|n| n.has_tag_name("title")).collect();
        // Two bars and three cables.
        assert_eq!(titles.len(), 5);
        let title = |start: &str| titles.iter().find(|t| t.text().unwrap().starts_with(start)).unwrap();
        let dashed: Vec<_> = with(&document, "stroke-dasharray").collect();
        assert_eq!(dashed.len(), 2, "the slack cable, and what dashes mean");
        let slack = frame.cables.iter().position(|c| c.slack).unwrap();
        let name = format!("{}: slack", outline.cables[slack].name);
        assert!(title(&name).parent().unwrap().has_attribute("stroke-dasharray"));
        let width = |start: &str| -> f64 {
            title(start).parent().unwrap().attribute("stroke-width").unwrap().parse().unwrap()
        };
        assert!(width("bar <2>") > 2.0 * width("cable"));
        assert_eq!(document.descendants().filter(|n| n.has_tag_name("circle")).count(), 2, "the particle");
        assert_eq!(with(&document, "fill-opacity").count(), 4, "the faces");
        let texts = texts(&document);
        for expected in ["A <tower>", "tension [N]", "slack", "0"] {
            assert!(texts.iter().any(|t| t == expected), "{expected} in {texts:?}");
        }
        assert!(texts.iter().any(|t| t.ends_with(" m")), "a length: {texts:?}");
    }
}

#[test]
fn a_strip_shows_times_in_order_and_in_one_scale() {
    let (outline, frames) = (sample::outline(), sample::frames(6));
    let picture = Picture { size: [1200.0, 400.0], ..Picture::default() };
    let text = strip_svg(&outline, &frames, &picture).unwrap();
    let document = Document::parse(&text).unwrap();
    let times: Vec<_> = texts(&document).into_iter().filter(|t| t.ends_with(" s")).collect();
    assert_eq!(times, ["0 s", "0.1 s", "0.2 s", "0.3 s", "0.4 s", "0.5 s"]);
    assert!(matches!(strip_svg(&outline, &[], &picture), Err(ReportError::Empty { .. })));
    let (width, height, rows) = decoded(&strip_png(&outline, &frames, &picture, 0.5).unwrap());
    assert_eq!((width, height), (600, 200));
    assert!(count(&rows, [255; 3]) > 80_000 && count(&rows, [108, 118, 134]) > 200);
}

#[test]
fn a_plane_structure_lies_in_the_paper() {
    let mut outline = Outline::new(2);
    outline.members = vec![MemberOutline::bar("bar", [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]], 0.0)];
    let upright = Placement::plane([0.0, 0.0], std::f64::consts::FRAC_PI_2);
    let frame = Frame { time: 0.0, poses: vec![upright], cables: Vec::new() };
    let text = svg(&outline, &frame, &Picture::default()).unwrap();
    let document = Document::parse(&text).unwrap();
    let title = document.descendants().find(|n| n.has_tag_name("title")).unwrap();
    let path = title.parent().unwrap().attribute("d").unwrap();
    let numbers: Vec<f64> = path.split(['M', 'L', ' ']).filter_map(|x| x.parse().ok()).collect();
    assert!((numbers[0] - numbers[2]).abs() < 0.02 && numbers[1] > numbers[3] + 100.0, "{path}");
    assert!(!texts(&document).iter().any(|t| t.contains("tension")), "no cable, no colours");
}

#[test]
fn nothing_finite_is_nothing_to_draw() {
    let (outline, mut frame) = (sample::outline(), sample::frame(0.0));
    frame.cables.iter_mut().for_each(|c| c.ends = [[f64::NAN; 3]; 2]);
    assert!(svg(&outline, &frame, &Picture::default()).is_ok());
    frame.poses.iter_mut().for_each(|p| p.position = [f64::NAN; 3]);
    assert!(matches!(svg(&outline, &frame, &Picture::default()), Err(ReportError::Empty { .. })));
    assert!(matches!(png(&outline, &frame, &Picture::default(), 1.0), Err(ReportError::Empty { .. })));
    // One point has no extent.
    let mut point = Outline::new(3);
    point.members = vec![MemberOutline::particle("p", 0.0)];
    let frame = Frame { time: 0.0, poses: vec![Placement::IDENTITY], cables: Vec::new() };
    assert!(svg(&point, &frame, &Picture::default()).unwrap().contains("<circle"));
}

#[test]
fn plots_name_axes_and_curves() {
    let table = sample::table(2000);
    let plots = Plot::standard(&table);
    let text = plots[1].svg([900.0, 480.0]).unwrap();
    let document = Document::parse(&text).unwrap();
    let texts = texts(&document);
    for expected in ["Tensions", "time [s]", "tension [N]", "cable 1", "cable 2"] {
        assert_eq!(texts.iter().filter(|t| *t == expected).count(), 1, "{expected} in {texts:?}");
    }
    let strips = plots[2].svg([900.0, 480.0]).unwrap();
    // A fifth of the time, in 40 intervals, on a track.
    assert_eq!(strips.matches("fill=\"#d55e00\"").count(), 40);
    assert!(strips.contains("20.0 %"), "{strips}");
    for plot in plots.iter().chain(&Plot::energy_drift(&table, "total")) {
        let png = plot.png([600.0, 360.0], 1.0).unwrap();
        assert_eq!(png, plot.png([600.0, 360.0], 1.0).unwrap());
        let (width, height, rows) = decoded(&png);
        assert_eq!((width, height), (600, 360));
        assert!(count(&rows, [255; 3]) > 100_000);
        let curve = if plot.kind == PlotKind::Strips { [213, 94, 0] } else { [0, 114, 178] };
        assert!(count(&rows, curve) > 200, "{}", plot.title);
    }
}

#[test]
fn ticks_are_round_and_have_the_digits_they_need() {
    let ticks = |low: f64, high: f64| {
        let series = vec![Series::new("", vec![0.25; 2])];
        let (x, y) = (Axis::new("x", ""), Axis::new("y", ""));
        let (title, kind, time, at) = (String::new(), PlotKind::Lines, false, vec![low, high]);
        let text = Plot { title, kind, x, y, time, at, series }.svg([560.0, 300.0]).unwrap();
        let document = Document::parse(&text).unwrap();
        let beneath = document.descendants().filter(|n| n.attribute("text-anchor") == Some("middle"));
        beneath.filter_map(|n| n.text()).filter(|t| !["x", "y"].contains(t)).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(ticks(0.0, 10.0), "0 2 4 6 8 10");
    assert_eq!(ticks(-0.3, 0.31), "\u{2212}0.2 0 0.2");
    assert_eq!(ticks(0.0, 3e-9), "0 1e\u{2212}9 2e\u{2212}9 3e\u{2212}9");
    assert_eq!(ticks(2e5, 3e5), "2.0e5 2.2e5 2.4e5 2.6e5 2.8e5 3.0e5");
    assert_eq!(ticks(1.0, 1.001), "1.0000 1.0002 1.0004 1.0006 1.0008 1.0010");
}

#[test]
fn energy_drift_is_relative() {
    let mut table =
        Table::new(vec![Channel::time(), Channel::new("E", "J", "energy"), Channel::new("T", "J", "energy")]);
    for row in [[0.0, -2.0, 1.0], [1.0, -2.5, 4.0], [2.0, -1.0, 2.0]] {
        table.push(&row).unwrap();
    }
    let drift = Plot::energy_drift(&table, "E").unwrap();
    assert_eq!(drift.series[0].values, [0.0, -0.25, 0.5]);
    assert_eq!(drift.y.text(), "relative energy error");
    table.columns[1] = vec![0.0, 1.0, -1.0];
    assert_eq!(Plot::energy_drift(&table, "E").unwrap().series[0].values, [0.0, 0.25, -0.25]);
    assert!(Plot::energy_drift(&table, "F").is_none());
}

#[test]
fn odd_plots_are_drawn_or_refused() {
    let plot = |kind, at: &[f64], values: &[&[f64]]| Plot {
        title: "Odd & <long> title".into(),
        kind,
        x: Axis::new("x", "1"),
        y: Axis::new("y", "m/s²"),
        time: false,
        at: at.to_vec(),
        series: values
            .iter()
            .enumerate()
            .map(|(k, v)| Series::new(format!("series {k} of many, with a long name"), v.to_vec()))
            .collect(),
    };
    for kind in [PlotKind::Lines, PlotKind::Points, PlotKind::Strips] {
        for (at, values) in [
            (&[0.0][..], &[&[1.0][..]][..]),
            (&[0.0, 1.0], &[&[5.0, 5.0], &[f64::NAN, 5.0]]),
            (&[1.0, 1.0, 1.0], &[&[0.0, 0.0, 0.0]]),
            (&[0.0, f64::NAN, 2.0], &[&[1e-300, 1.0, 1e300]]),
            (&[0.0, 1.0], &[&[1.0, 0.0][..]; 60]),
            (&[0.0, 1.0], &[&[f64::INFINITY, 1.0]]),
            (&[0.0, 1.0, 1.7e308], &[&[-1.7e308, 1.7e308, 1.0], &[2.0, 3.0, 4.0]]),
        ] {
            let plot = plot(kind, at, values);
            let text = plot.svg([500.0, 300.0]).unwrap();
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
            Document::parse(&text).unwrap();
            decoded(&plot.png([500.0, 300.0], if kind == PlotKind::Lines { f64::NAN } else { 0.0 }).unwrap());
        }
        let nothing = plot(kind, &[0.0], &[&[f64::NAN]]);
        assert!(matches!(nothing.svg([500.0, 300.0]), Err(ReportError::Empty { .. })));
        let short = plot(kind, &[0.0, 1.0], &[&[0.0]]);
        assert!(matches!(short.svg([500.0, 300.0]), Err(ReportError::Count { got: 1, expected: 2, .. })));
    }
}

#[test]
fn logarithmic_axes_are_divided_by_powers_of_ten() {
    let (x, y) = (Axis::new("time", "s").logarithmic(), Axis::new("error", "m").logarithmic());
    let line = |name: &str, at: &[f64], values: &[f64]| Series::over(name, at.to_vec(), values.to_vec());
    let series = vec![
        // On a line of slope -2 in powers of ten, beside values that have no place.
        line("second order", &[1e-3, 1e-2, 1e-1, 1.0], &[1e-1, 1e-3, 1e-5, 1e-7]),
        line("gaps", &[1e-2, 1e-1, 1.0], &[0.0, -1.0, 1e-4]),
    ];
    let plot =
        Plot { title: "errors".into(), kind: PlotKind::Lines, x, y, time: false, at: Vec::new(), series };
    let text = plot.svg([900.0, 500.0]).unwrap();
    let document = Document::parse(&text).unwrap();
    let texts = texts(&document);
    for expected in ["1e\u{2212}3", "1e\u{2212}2", "1e0", "1e\u{2212}6", "time [s]", "error [m]"] {
        assert!(texts.iter().any(|t| t == expected), "{expected} in {texts:?}");
    }
    let is_curve = |path: &&str| path.matches('L').count() == 3;
    let path = document.descendants().filter_map(|n| n.attribute("d")).find(is_curve).unwrap();
    let numbers: Vec<f64> = path.split(['M', 'L', ' ']).filter_map(|x| x.parse().ok()).collect();
    let points: Vec<_> = numbers.chunks(2).collect();
    let slopes: Vec<_> = points.windows(2).map(|p| (p[1][1] - p[0][1]) / (p[1][0] - p[0][0])).collect();
    assert!(slopes.iter().all(|slope| *slope > 0.0 && (slope / slopes[0] - 1.0).abs() < 1e-2), "{path}");
    // The one point that has a place.
    assert_eq!(document.descendants().filter(|n| n.has_tag_name("circle")).count(), 1);
    let empty = Plot { series: vec![line("none", &[1.0], &[-1.0])], ..plot };
    assert!(matches!(empty.svg([900.0, 500.0]), Err(ReportError::Empty { .. })));
}
