//! Plots of a table by the groups of its channels.

use super::{Axis, Plot, PlotKind, Series};
use crate::table::{Channel, Table};

impl Plot {
    /// The channels of a group over the first channel; "slack" as strips, all else as lines. None where the group is empty.
    /// Channels of another unit than the group's first are left out: [`Plot::standard`] draws them apart.
    pub fn of_group(table: &Table, group: &str) -> Option<Self> {
        let of_group = table.group(group);
        let first = table.channels.get(*of_group.first()?)?;
        let alike = of_group.iter().copied().filter(|&k| table.channels[k].unit == first.unit);
        Self::of_channels(table, &alike.collect::<Vec<_>>())
    }

    /// Some channels over the first channel of the table; what they have in common names the plot. None where there are no
    /// channels.
    pub fn of_channels(table: &Table, channels: &[usize]) -> Option<Self> {
        let first = table.channels.get(*channels.first()?)?;
        let abscissa = table.channels.first()?;
        let (title, quantity) = names(&first.group);
        let suffix = common_suffix(channels.iter().map(|&k| table.channels[k].name.as_str()));
        let series = channels.iter().map(|&k| {
            let name = table.channels[k].name.strip_suffix(&suffix).unwrap_or_default();
            Series::new(name, table.columns[k].clone())
        });
        Some(Self {
            title,
            kind: if first.group == "slack" { PlotKind::Strips } else { PlotKind::Lines },
            x: Axis::new(&abscissa.name, &abscissa.unit),
            y: Axis::new(quantity, &first.unit),
            time: is_time(abscissa),
            at: table.columns[0].clone(),
            series: series.collect(),
        })
    }

    /// A plot for each group and unit of the table, in the order of the channels.
    pub fn standard(table: &Table) -> Vec<Self> {
        let mut kinds: Vec<(&str, &str)> = Vec::new();
        for c in table.channels.iter().skip(1) {
            if !kinds.contains(&(&c.group, &c.unit)) && !is_time(c) {
                kinds.push((&c.group, &c.unit));
            }
        }
        let alike = |&(group, unit): &(&str, &str)| -> Vec<usize> {
            let of = |k: &usize| table.channels[*k].group == group && table.channels[*k].unit == unit;
            (1..table.channels.len()).filter(of).collect()
        };
        kinds.iter().filter_map(|kind| Self::of_channels(table, &alike(kind))).collect()
    }

    /// Relative error of an energy that should not change: `(E(t) - E(0)) / |E(0)|`, or per largest energy of the same group
    /// where E(0) = 0. None where there is no such channel or no row.
    pub fn energy_drift(table: &Table, channel: &str) -> Option<Self> {
        let k = table.position(channel)?;
        let start = *table.columns[k].first()?;
        let same = table.group(&table.channels[k].group);
        let largest = same.iter().flat_map(|&j| &table.columns[j]).fold(0.0_f64, |a, x| a.max(x.abs()));
        let scale = [start.abs(), largest, 1.0].into_iter().find(|&s| s > 0.0)?;
        let mut plot = Self::of_channels(table, &[k])?;
        plot.title = "Energy drift".into();
        plot.y = Axis::new("relative energy error", "");
        plot.series[0].name = channel.into();
        plot.series[0].values.iter_mut().for_each(|x| *x = (*x - start) / scale);
        Some(plot)
    }
}

fn is_time(channel: &Channel) -> bool {
    channel.group == "time" || (channel.group.is_empty() && channel.name == "time")
}

/// Title and quantity of a group.
fn names(group: &str) -> (String, String) {
    let (title, quantity) = match group {
        "energy" => ("Energies", "energy"),
        "tension" => ("Tensions", "tension"),
        "length" => ("Lengths", "length"),
        "rest" => ("Rest lengths", "rest length"),
        "point" => ("Points", "coordinate"),
        "velocity" => ("Velocities", "velocity"),
        "reaction" => ("Reactions", "reaction"),
        "slack" => ("Slack cables", ""),
        "frequency" => ("Frequencies", "frequency"),
        "angle" => ("Angles", "angle"),
        "" => ("Values", "value"),
        other => {
            let mut letters = other.chars();
            let title = letters.next().map(|c| c.to_uppercase().chain(letters).collect());
            return (title.unwrap_or_default(), other.into());
        }
    };
    (title.into(), quantity.into())
}

/// What all names end with from their last dot on: ".tension". Nothing for a single name.
fn common_suffix<'a>(mut names: impl Iterator<Item = &'a str>) -> String {
    let suffix = |name: &'a str| name.rfind('.').filter(|&at| at > 0).map(|at| &name[at..]);
    let first = names.next().and_then(suffix).unwrap_or_default();
    if names.all(|name| suffix(name) == Some(first)) { first.into() } else { String::new() }
}
