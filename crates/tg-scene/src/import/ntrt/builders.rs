//! Builders: what a pair becomes. Defaults are the toolkit's (`TensegrityModel.h`).

use super::part::{Pair, has_all, words};
use crate::error::ReadError;
use crate::import::sources::At;
use crate::import::tree::{get, not_negative, number, only, positive, require, table, text};
use crate::node::{Entry, Node};

/// What pairs with some tags become.
#[derive(Clone, Debug)]
pub(super) struct Builder {
    pub(super) tags: String,
    pub(super) kind: Kind,
    /// Values that the file does not give, as the toolkit has them.
    pub(super) defaults: Vec<String>,
    pub(super) at: At,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Rod {
        radius: f64,
        density: f64,
    },
    /// Width and height are halves of the edges.
    Box {
        width: f64,
        height: f64,
        density: f64,
    },
    String {
        stiffness: f64,
        damping: f64,
        pretension: f64,
    },
}

impl Builder {
    fn matches(&self, pair: &Pair, structure: &str) -> bool {
        let (inherited, mut wanted) = (words(structure), words(&self.tags));
        wanted.retain(|tag| !inherited.contains(tag));
        has_all(&pair.tags, &wanted)
    }

    fn is_rigid(&self) -> bool {
        !matches!(self.kind, Kind::String { .. })
    }
}

/// The builder of a pair in a structure of that name: rigid ones first, the last added first.
pub(super) fn of_pair<'b>(builders: &'b [Builder], pair: &Pair, structure: &str) -> Option<&'b Builder> {
    let find = |rigid: bool| {
        let mut kind = builders.iter().rev().filter(move |builder| builder.is_rigid() == rigid);
        kind.find(|builder| builder.matches(pair, structure))
    };
    find(true).or_else(|| find(false))
}

/// Whether some rod or box would be made of a pair.
pub(super) fn is_rigid(builders: &[Builder], pair: &Pair) -> bool {
    builders.iter().any(|builder| builder.is_rigid() && builder.matches(pair, ""))
}

const RODS: [&str; 1] = ["tgRodInfo"];
const BOXES: [&str; 1] = ["tgBoxInfo"];
const STRINGS: [&str; 4] = [
    "tgBasicActuatorInfo",
    "tgBasicContactCableInfo",
    "tgKinematicActuatorInfo",
    "tgKinematicContactCableInfo",
];
const ROD: [&str; 5] = ["radius", "density", "friction", "roll_friction", "restitution"];
const BOX: [&str; 6] = ["width", "height", "density", "friction", "roll_friction", "restitution"];
const BASIC: [&str; 11] = [
    "stiffness",
    "damping",
    "pretension",
    "history",
    "max_tension",
    "target_velocity",
    "min_actual_length",
    "min_rest_length",
    "rotation",
    "moveCablePointAToEdge",
    "moveCablePointBToEdge",
];
const KINEMATIC: [&str; 13] = [
    "stiffness",
    "damping",
    "pretension",
    "radius",
    "motor_friction",
    "motor_inertia",
    "back_drivable",
    "history",
    "max_tension",
    "target_velocity",
    "min_actual_length",
    "min_rest_length",
    "rotation",
];

/// The builders that every structure has.
pub(super) fn defaults() -> Vec<Builder> {
    let builder = |class: &str, tags: &str| Parameters::default().builder(class, tags, &At::default()).ok();
    let all = [("tgRodInfo", "rod"), ("tgBasicActuatorInfo", "string"), ("tgBoxInfo", "box")];
    all.into_iter().filter_map(|(class, tags)| builder(class, tags)).collect()
}

/// Reads a builder.
pub(super) fn read(entry: &Entry, source: usize) -> Result<Builder, ReadError> {
    let what = "a builder { class, parameters }";
    let fields = table(&entry.node, what)?;
    only(fields, &["class", "parameters"])?;
    let class = require(fields, "class", &entry.node).map_err(|_| {
        let error = ReadError::new(format!("the builder of `{}` has no class", entry.key)).at(&entry.span);
        error.help("add class: tgRodInfo or tgBasicActuatorInfo")
    })?;
    let name = text(class, "the name of a class")?;
    let parameters = get(fields, "parameters").map_or(Ok(&[][..]), |given| table(given, "parameters"))?;
    let known: &[&str] = match name {
        _ if RODS.contains(&name) => &ROD,
        _ if BOXES.contains(&name) => &BOX,
        "tgBasicActuatorInfo" | "tgBasicContactCableInfo" => &BASIC,
        _ => &KINEMATIC,
    };
    let at = At { source, span: entry.span.clone() };
    let builder = Parameters { given: parameters, defaults: Vec::new() }.builder(name, &entry.key, &at);
    let builder = builder.map_err(|error| error.at(&class.span))?;
    only(parameters, known)?;
    Ok(builder)
}

/// Parameters as given, and which were not.
#[derive(Default)]
struct Parameters<'n> {
    given: &'n [Entry],
    defaults: Vec<String>,
}

type Check = fn(&Node, &str) -> Result<f64, ReadError>;

impl Parameters<'_> {
    fn value(&mut self, name: &str, default: f64, check: Check) -> Result<f64, ReadError> {
        match get(self.given, name) {
            Some(node) => check(node, &format!("`{name}`")),
            None => {
                self.defaults.push(format!("{name} {default}"));
                Ok(default)
            }
        }
    }

    fn builder(mut self, class: &str, tags: &str, at: &At) -> Result<Builder, ReadError> {
        let kind = if RODS.contains(&class) {
            let radius = self.value("radius", 0.5, positive)?;
            Kind::Rod { radius, density: self.value("density", 1.0, not_negative)? }
        } else if BOXES.contains(&class) {
            let (width, height) = (self.value("width", 1.0, positive)?, self.value("height", 1.0, positive)?);
            Kind::Box { width, height, density: self.value("density", 1.0, not_negative)? }
        } else if STRINGS.contains(&class) {
            let stiffness = self.value("stiffness", 1000.0, positive)?;
            let damping = self.value("damping", 10.0, not_negative)?;
            Kind::String { stiffness, damping, pretension: self.value("pretension", 0.0, number)? }
        } else {
            let known = [&RODS[..], &BOXES, &STRINGS].concat();
            return Err(ReadError::new(format!("the class `{class}` is not known")).suggest(class, &known));
        };
        Ok(Builder { tags: tags.into(), kind, defaults: self.defaults, at: at.clone() })
    }
}
