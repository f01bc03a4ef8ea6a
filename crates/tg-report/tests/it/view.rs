//! Pages hold what the viewer's contract says.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use tempfile::tempdir;
use tg_report::{
    Axis, Existing, Formats, Kind, Manifest, ModeSet, ModeShape, Plot, PlotKind, ReportError, Results,
    ResultsWriter, Series, Shape, View,
};

use crate::sample;

fn data(html: &str) -> Value {
    let (_, rest) = html.split_once("<script id=\"tg-data\" type=\"application/json\">").unwrap();
    let (json, _) = rest.split_once("</script>").unwrap();
    serde_json::from_str(json).unwrap()
}

fn floats(value: &Value) -> Vec<f32> {
    let bytes = STANDARD.decode(value.as_str().unwrap()).unwrap();
    bytes.as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
}

fn doubles(value: &Value) -> Vec<f64> {
    let bytes = STANDARD.decode(value.as_str().unwrap()).unwrap();
    bytes.as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
}

fn mode(scale: f64) -> ModeShape {
    let outline = sample::outline();
    let vertices = (0..outline.vertex_count()).map(|k| [scale * k as f64, 0.0, 0.0]).collect();
    let (frequency, damping) = (Some(1.25), None);
    ModeShape { label: "mode 1".into(), frequency, damping, vertices, ends: vec![[[0.0; 3]; 2]; 3] }
}

#[test]
fn a_page_of_a_folder() {
    let folder = tempdir().unwrap();
    let mut manifest = Manifest::new(Kind::Run, "</script><b>Tower & Co");
    manifest.program = "tg 0.1".into();
    manifest.channels = sample::channels();
    manifest.outline = Some(sample::outline());
    let mut writer =
        ResultsWriter::create(folder.path(), manifest, Formats::default(), Existing::Keep).unwrap();
    (0..10_000).for_each(|k| writer.row(&sample::row(k)).unwrap());
    sample::frames(1000).iter().for_each(|f| writer.frame(f).unwrap());
    writer.document("modes", &ModeSet { reference: sample::frame(0.0), list: vec![mode(3.0)] }).unwrap();
    let shape =
        Shape { label: "1".into(), stable: Some(true), energy: Some(-1.5), frame: sample::frame(1.0) };
    writer.document("shapes", &[shape]).unwrap();
    drop(writer);
    let view = View::of(&Results::open(folder.path()).unwrap()).unwrap();
    assert_eq!(view.subtitle, "tg 0.1, incomplete");
    let html = view.html().unwrap();
    assert!(html.contains("<title>&lt;/script&gt;&lt;b&gt;Tower &amp; Co</title>"));
    let data = data(&html);
    assert_eq!((&data["version"], &data["dimension"]), (&1.into(), &3.into()));
    assert_eq!(data["title"], "</script><b>Tower & Co");
    assert_eq!(data["members"][2]["kind"], "body");
    assert_eq!(data["members"][2]["faces"].as_array().unwrap().len(), 4);
    assert_eq!((&data["cables"][0]["group"], &data["cables"][2]["group"]), (&"guys".into(), &Value::Null));
    let time = doubles(&data["motion"]["time"]);
    assert_eq!((time.len(), time[0], time[599]), (600, 0.0, sample::frames(1000)[999].time));
    let poses = floats(&data["motion"]["poses"]);
    assert_eq!(poses.len(), 600 * 4 * 7);
    assert_eq!(poses[..3], [0.0, 0.0, 0.5]);
    assert_eq!(floats(&data["motion"]["ends"]).len(), 600 * 3 * 6);
    assert_eq!(floats(&data["motion"]["tension"]).len(), 600 * 3);
    assert_eq!(STANDARD.decode(data["motion"]["slack"].as_str().unwrap()).unwrap().len(), 600 * 3);
    let shape = floats(&data["modes"]["list"][0]["vertices"]);
    assert_eq!(shape.iter().fold(0.0_f32, |a, x| a.max(x.abs())), 1.0);
    assert_eq!(data["modes"]["list"][0]["damping"], Value::Null);
    assert_eq!(floats(&data["modes"]["reference"]["poses"]).len(), 28);
    assert_eq!(floats(&data["shapes"]["list"][0]["poses"]).len(), 28);
    let plots = data["plots"].as_array().unwrap();
    let titles: Vec<_> = plots.iter().map(|p| p["title"].as_str().unwrap()).collect();
    assert_eq!(titles, ["Energies", "Tensions", "Slack cables", "Points", "Points"]);
    assert_eq!(plots[2]["kind"], "strips");
    assert_eq!(plots[1]["series"][0]["name"], "cable 1");
    assert_eq!((&plots[1]["x"]["time"], &plots[1]["y"]["unit"]), (&true.into(), &"N".into()));
    let points = doubles(&plots[1]["series"][0]["values"]).len();
    assert!(points <= 4000 && points > 3900 && points == doubles(&plots[1]["x"]["values"]).len());
}

#[test]
fn thinning_keeps_ends_peaks_and_gaps() {
    let mut values = vec![0.0; 100_000];
    values[31_415] = 7.0;
    values[31_416] = -9.0;
    values[50_000..60_000].fill(f64::NAN);
    values[99_999] = 2.0;
    let at: Vec<f64> = (0..values.len()).map(|k| k as f64).collect();
    let series = vec![Series::new("a", values)];
    let axis = Axis::new("t", "s");
    let plot =
        Plot { title: "p".into(), kind: PlotKind::Lines, x: axis.clone(), y: axis, time: true, at, series };
    let thin = plot.thinned(1000);
    assert_eq!(thin.at.len(), 1000);
    assert!(thin.at.is_sorted());
    assert_eq!((thin.at[0], thin.at[999]), (0.0, 99_999.0));
    let values = &thin.series[0].values;
    let at = values.iter().position(|&x| x == 7.0).unwrap();
    assert_eq!(values[at + 1], -9.0);
    assert!((thin.at[at] - 31_415.0).abs() < 250.0);
    assert_eq!(values[999], 2.0);
    assert!(values[510..590].iter().all(|x| x.is_nan()));
    assert_eq!(plot.thinned(100_000).at, plot.at);
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut view = View::new("t", sample::outline());
    assert!(data(&view.html().unwrap())["motion"].is_null());
    view.motion = sample::frames(2);
    view.motion[1].poses.pop();
    assert!(matches!(view.html(), Err(ReportError::Count { got: 3, expected: 4, .. })));
    view.motion.clear();
    view.modes = Some((sample::frame(0.0), vec![mode(1.0)]));
    view.outline.members[2].faces[0][1] = 4;
    assert!(matches!(view.html(), Err(ReportError::Outline { .. })));
}
