//! Cables, and what all cables of a group have in common.

use std::collections::HashMap;

use super::section;
use super::toml_line::{Line, text};
use crate::import::draft::{Draft, DraftCable, Rest, Stiffness};
use crate::import::names::Names;

/// What the cables of a group share.
struct Group<'d> {
    name: &'d str,
    stiffness: Option<Stiffness>,
    damping: Option<f64>,
    rest: Option<Rest>,
    linear: Option<bool>,
}

/// The sections `groups` and `cables`. A cable is attached to the first place of each of its nodes.
pub(super) fn write(out: &mut String, draft: &Draft, places: &[Vec<String>]) {
    let groups = groups(&draft.cables);
    section(out, "groups", groups.iter().map(group_line));
    let mut taken = Names::default();
    let lines = draft.cables.iter().map(|cable| {
        let group = cable.group.as_deref().and_then(|name| groups.iter().find(|group| group.name == name));
        let name = taken.take("cable", &cable.name);
        cable_line(cable, group, places).of(&name)
    });
    section(out, "cables", lines);
}

/// One value that all have, if they have one.
fn common<T: PartialEq>(mut values: impl Iterator<Item = T>) -> Option<T> {
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
}

fn groups(cables: &[DraftCable]) -> Vec<Group<'_>> {
    let mut members: Vec<(&str, Vec<&DraftCable>)> = Vec::new();
    let mut known = HashMap::new();
    for cable in cables {
        if let Some(name) = cable.group.as_deref() {
            let k = *known.entry(name).or_insert(members.len());
            if k == members.len() {
                members.push((name, Vec::new()));
            }
            members[k].1.push(cable);
        }
    }
    let group = |(name, cables): (_, Vec<&DraftCable>)| Group {
        name,
        stiffness: common(cables.iter().map(|cable| cable.stiffness)),
        damping: common(cables.iter().map(|cable| cable.damping)),
        rest: common(cables.iter().map(|cable| cable.rest)),
        linear: common(cables.iter().map(|cable| cable.linear)),
    };
    members.into_iter().map(group).collect()
}

fn group_line(group: &Group<'_>) -> String {
    let mut line = Line::default();
    group.linear.into_iter().for_each(|linear| law(&mut line, linear));
    group.stiffness.into_iter().for_each(|given| stiffness(&mut line, given));
    group.damping.into_iter().for_each(|given| damping(&mut line, given));
    group.rest.into_iter().for_each(|given| rest(&mut line, given));
    line.of(group.name)
}

fn cable_line(cable: &DraftCable, group: Option<&Group<'_>>, places: &[Vec<String>]) -> Line {
    let mut line = Line::default();
    let ends = cable.ends.map(|node| places[node].first().map_or_else(String::new, |place| text(place)));
    line.add("ends", &format!("[{}]", ends.join(", ")));
    if let Some(name) = &cable.group {
        line.add("group", &text(name));
    }
    if group.is_none_or(|group| group.linear.is_none()) {
        law(&mut line, cable.linear);
    }
    if group.is_none_or(|group| group.stiffness.is_none()) {
        stiffness(&mut line, cable.stiffness);
    }
    if group.is_none_or(|group| group.damping.is_none()) {
        damping(&mut line, cable.damping);
    }
    if group.is_none_or(|group| group.rest.is_none()) {
        rest(&mut line, cable.rest);
    }
    line
}

fn law(line: &mut Line, linear: bool) {
    if linear {
        line.add("law", "\"linear\"");
    }
}

fn stiffness(line: &mut Line, given: Stiffness) {
    match given {
        Stiffness::Spring(k) => line.add_number("stiffness", k),
        Stiffness::Axial(ea) => line.add_number("axial_stiffness", ea),
    }
}

fn damping(line: &mut Line, given: f64) {
    if given != 0.0 {
        line.add_number("damping", given);
    }
}

fn rest(line: &mut Line, given: Rest) {
    match given {
        Rest::Length(length) => line.add_number("rest", length),
        Rest::Ratio(ratio) => line.add_number("rest_ratio", ratio),
        Rest::Tension(tension) => line.add_number("tension", tension),
        Rest::ForceDensity(density) => line.add_number("force_density", density),
    }
}
