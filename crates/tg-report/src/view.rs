//! A self-contained page that shows motion, modes, equilibria and plots.

mod json;

use crate::error::ReportError;
use crate::folder::{Kind, Manifest, Results};
use crate::frame::{Frame, ModeShape, Shape};
use crate::outline::Outline;
use crate::plot::Plot;

/// Frames of a motion that a page shows; more are thinned evenly.
pub const VIEW_FRAMES: usize = 600;
/// Points of a plot that a page shows; more are thinned so that peaks stay.
pub const VIEW_POINTS: usize = 4000;

const PAGE: &str = include_str!("../viewer/dist/viewer.html");
const DATA: &str = "__TG_VIEW_DATA__";
const TITLE: &str = "__TG_TITLE__";

/// What a page shows.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Title.
    pub title: String,
    /// A line under it.
    pub subtitle: String,
    /// What the structure looks like.
    pub outline: Outline,
    /// The motion; empty for none.
    pub motion: Vec<Frame>,
    /// Modes about a reference.
    pub modes: Option<(Frame, Vec<ModeShape>)>,
    /// Equilibria; empty for none.
    pub shapes: Vec<Shape>,
    /// Plots.
    pub plots: Vec<Plot>,
}

impl View {
    /// A page that shows a structure and nothing else yet.
    pub fn new(title: &str, outline: Outline) -> Self {
        Self {
            title: title.into(),
            subtitle: String::new(),
            outline,
            motion: Vec::new(),
            modes: None,
            shapes: Vec::new(),
            plots: Vec::new(),
        }
    }

    /// The usual page of a results folder: its motion, modes and shapes, the plots of its document `plots`, then one for
    /// each group of channels.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn of(results: &Results) -> Result<Self, ReportError> {
        let manifest = &results.manifest;
        let outline = manifest.outline.clone().unwrap_or_else(|| Outline::new(3));
        let frames: Vec<Frame> = results.frames()?.into_iter().filter(Frame::is_finite).collect();
        let mut plots = results.plots()?;
        plots.extend(Plot::standard(&results.table()?));
        Ok(Self {
            title: manifest.title.clone(),
            subtitle: subtitle(manifest),
            outline,
            motion: evenly(&frames, VIEW_FRAMES),
            modes: results.modes()?.map(|set| (set.reference, set.list)),
            shapes: results.shapes()?,
            plots: plots.iter().map(|plot| plot.thinned(VIEW_POINTS)).collect(),
        })
    }

    /// The page.
    ///
    /// # Errors
    /// The outline cannot be drawn, or frames, modes, shapes or curves do not have its numbers of members, cables, vertices
    /// or points.
    pub fn html(&self) -> Result<String, ReportError> {
        let data = json::data(self)?.replace('<', "\\u003c");
        let (before, after) = PAGE.split_once(DATA).unwrap_or((PAGE, ""));
        let title = escaped(&self.title);
        Ok([before.replacen(TITLE, &title, 1).as_str(), &data, after].concat())
    }
}

/// At most `most` of some frames: the first, the last, and others evenly between them.
pub fn evenly<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    if all.len() <= most {
        return all.to_vec();
    }
    let last = all.len() - 1;
    (0..most).map(|k| all[(k * last + (most - 1) / 2) / (most - 1).max(1)].clone()).collect()
}

fn subtitle(manifest: &Manifest) -> String {
    let ending = match (&manifest.interrupted, manifest.complete) {
        (Some(reason), _) => Some(format!("interrupted: {reason}")),
        (None, false) => Some("incomplete".into()),
        (None, true) => None,
    };
    let kind = match manifest.kind {
        Kind::Run => None,
        kind => Some(kind.name().to_owned()),
    };
    let program = Some(manifest.program.clone()).filter(|p| !p.is_empty());
    // 2026-11-22T07:09:16Z
    let started = manifest.started.as_deref().map(|t| t.trim_end_matches('Z').replace('T', " "));
    let parts = [kind, program, started, ending];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Text of a page.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Not allowed in XML.
            '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
