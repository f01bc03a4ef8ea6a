//! A draft as a scene in TOML.
//!
//! A node becomes an anchor where all its components are held, a particle where it has a mass, else a point; what ends
//! in it is joined there, and cables are attached to the first that holds it.

mod cables;
mod toml_line;

use std::fmt::Write;

use super::draft::{BarMass, Draft, DraftBar, DraftBody};
use super::names::Names;
use super::sources::Sources;
use super::{ImportOptions, names};
use toml_line::{Line, key, number, numbers, text};

/// Names of the scene's parts by the draft's indices.
struct Plan {
    nodes: Vec<String>,
    bars: Vec<String>,
    bodies: Vec<String>,
    /// Names of each body's points.
    points: Vec<Vec<String>>,
    /// The places that are at each node.
    places: Vec<Vec<String>>,
}

/// The scene.
pub(super) fn toml(draft: &Draft, options: &ImportOptions, sources: &Sources) -> String {
    let plan = Plan::of(draft);
    let mut out = String::new();
    head(&mut out, draft, options, sources);
    anchors_and_particles(&mut out, draft, &plan);
    section(
        &mut out,
        "bodies",
        draft.bodies.iter().zip(0..).map(|(body, k)| body_line(draft, &plan, body, k)),
    );
    section(
        &mut out,
        "bars",
        draft.bars.iter().zip(&plan.bars).map(|(bar, name)| bar_line(&plan, bar, name)),
    );
    joints_and_supports(&mut out, draft, &plan);
    cables::write(&mut out, draft, &plan.places);
    out
}

impl Plan {
    fn of(draft: &Draft) -> Self {
        let mut taken = Names::default();
        let nodes: Vec<_> = draft.nodes.iter().map(|node| taken.take("node", &node.name)).collect();
        let bodies: Vec<_> = draft.bodies.iter().map(|body| taken.take("body", &body.name)).collect();
        let bars: Vec<_> = draft.bars.iter().map(|bar| taken.take("bar", &bar.name)).collect();
        let points: Vec<_> = draft.bodies.iter().map(|body| point_names(draft, body)).collect();
        let mut places = vec![Vec::new(); nodes.len()];
        for (k, node) in draft.nodes.iter().enumerate() {
            if draft.is_anchor(k) || node.mass.is_some() {
                places[k].push(nodes[k].clone());
            }
        }
        for ((body, name), points) in draft.bodies.iter().zip(&bodies).zip(&points) {
            for (node, point) in body.nodes.iter().zip(points) {
                places[*node].push(format!("{name}.{point}"));
            }
        }
        for (bar, name) in draft.bars.iter().zip(&bars) {
            for (node, end) in bar.ends.into_iter().zip(["from", "to"]) {
                places[node].push(format!("{name}.{end}"));
            }
        }
        Self { nodes, bars, bodies, points, places }
    }
}

fn point_names(draft: &Draft, body: &DraftBody) -> Vec<String> {
    let mut taken = Names::default();
    ["origin", "centre", "center"].into_iter().for_each(|name| taken.reserve(name));
    body.nodes.iter().map(|node| taken.take("node", &draft.nodes[*node].name)).collect()
}

fn head(out: &mut String, draft: &Draft, options: &ImportOptions, sources: &Sources) {
    let _ = writeln!(out, "# Imported from {}.", sources.names().join(", "));
    if *options == ImportOptions::default() {
        comment(out, "Numbers are those of the file, taken as metres, newtons, kilograms and seconds.");
    } else {
        let ImportOptions { length_scale: l, force_scale: f, mass_scale: m } = options;
        comment(out, &format!("Units of the file: {l} m, {f} N, {m} kg, 1 s."));
    }
    draft.notes.iter().for_each(|note| comment(out, note));
    draft.warnings.iter().for_each(|warning| comment(out, &format!("Note: {warning}")));
    out.push('\n');
    let _ = writeln!(out, "version = 1");
    if let Some(title) = &draft.title {
        let _ = writeln!(out, "title = {}", text(&names::clean(title)));
    }
    let _ = writeln!(out, "dimension = {}", draft.dimension);
    comment(out, &draft.gravity);
    if draft.drop_redundancies {
        let _ = writeln!(out, "redundancies = \"drop\"");
    }
}

/// Lines of a comment, each with its mark.
fn comment(out: &mut String, lines: &str) {
    for line in lines.lines() {
        let plain: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let _ = writeln!(out, "# {}", plain.trim_end());
    }
}

fn section(out: &mut String, name: &str, lines: impl Iterator<Item = String>) {
    let mut lines = lines.peekable();
    if lines.peek().is_some() {
        let _ = writeln!(out, "\n[{name}]");
        lines.for_each(|line| out.push_str(&(line + "\n")));
    }
}

fn anchors_and_particles(out: &mut String, draft: &Draft, plan: &Plan) {
    let mut ends = vec![false; draft.nodes.len()];
    draft.bars.iter().flat_map(|bar| bar.ends).for_each(|node| ends[node] = true);
    let place = |k: usize| numbers(&draft.nodes[k].position.as_slice()[..draft.dimension]);
    let line = |k: usize| format!("{} = {}", key(&plan.nodes[k]), place(k));
    let all = 0..draft.nodes.len();
    let is_particle = |k: &usize| !draft.is_anchor(*k) && draft.nodes[*k].mass.is_some();
    let is_point = |k: &usize| ends[*k] && !draft.is_anchor(*k) && !is_particle(k);
    section(out, "points", all.clone().filter(is_point).map(line));
    section(out, "anchors", all.clone().filter(|k| draft.is_anchor(*k)).map(line));
    let particle = |k: usize| {
        let mut fields = Line::default();
        fields.add("at", &place(k));
        fields.add_number("mass", draft.nodes[k].mass.unwrap_or_default());
        fields.of(&plan.nodes[k])
    };
    section(out, "particles", all.filter(is_particle).map(particle));
}

fn bar_line(plan: &Plan, bar: &DraftBar, name: &str) -> String {
    let mut line = Line::default();
    line.add("ends", &format!("[{}, {}]", text(&plan.nodes[bar.ends[0]]), text(&plan.nodes[bar.ends[1]])));
    match bar.mass {
        BarMass::Mass(mass) => line.add_number("mass", mass),
        BarMass::LineDensity(density) => line.add_number("line_density", density),
        BarMass::Density(density) => line.add_number("density", density),
    }
    bar.radius.into_iter().for_each(|radius| line.add_number("radius", radius));
    line.of(name)
}

/// A body with its frame in its mass centre, along the axes of space.
fn body_line(draft: &Draft, plan: &Plan, body: &DraftBody, k: usize) -> String {
    let dimension = draft.dimension;
    let mut line = Line::default();
    line.add("position", &numbers(&body.centre.as_slice()[..dimension]));
    line.add_number("mass", body.mass);
    let inertia = if dimension == 2 {
        format!("{{ polar = {} }}", number(body.inertia[(2, 2)]))
    } else {
        let rows = (0..3).map(|row| numbers(&[0, 1, 2].map(|column| body.inertia[(row, column)])));
        format!("{{ matrix = [{}] }}", rows.collect::<Vec<_>>().join(", "))
    };
    line.add("inertia", &inertia);
    let local = |node: usize| draft.nodes[node].position - body.centre;
    let points = body.nodes.iter().zip(&plan.points[k]);
    let points = points
        .map(|(&node, name)| format!("{} = {}", key(name), numbers(&local(node).as_slice()[..dimension])));
    line.add("points", &format!("{{ {} }}", points.collect::<Vec<_>>().join(", ")));
    let point =
        |node: usize| body.nodes.iter().position(|other| *other == node).map(|k2| &plan.points[k][k2]);
    let faces =
        body.edges.iter().filter_map(|[a, b]| Some(format!("[{}, {}]", text(point(*a)?), text(point(*b)?))));
    let faces = faces.collect::<Vec<_>>();
    if !faces.is_empty() {
        line.add("faces", &format!("[{}]", faces.join(", ")));
    }
    line.of(&plan.bodies[k])
}

fn joints_and_supports(out: &mut String, draft: &Draft, plan: &Plan) {
    let nodes = || plan.nodes.iter().zip(&plan.places).zip(0..);
    let joined = nodes().filter(|((_, places), _)| places.len() > 1).map(|((name, places), _)| {
        let places: Vec<_> = places.iter().map(|place| text(place)).collect();
        format!("{} = {{ places = [{}] }}", key(name), places.join(", "))
    });
    section(out, "joints", joined);
    let held = nodes().filter(|(_, k)| !draft.is_anchor(*k)).filter_map(|((name, places), k)| {
        let axes = "xyz".chars().zip(draft.nodes[k].fixed).take(draft.dimension);
        let axes: String = axes.filter(|(_, held)| *held).map(|(axis, _)| axis).collect();
        let place = places.first().filter(|_| !axes.is_empty())?;
        let mut line = Line::default();
        line.add("at", &text(place));
        line.add("axes", &text(&axes));
        Some(line.of(name))
    });
    section(out, "supports", held);
}
