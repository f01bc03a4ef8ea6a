//! Rows of the trajectory: what the scene asks for, and nothing else is computed.

use tg_integrate::{State, StepReport};
use tg_model::{CableState, Form, Reactions};
use tg_report::Channel;
use tg_scene::{ChannelName, RunSettings, Structure};

use crate::answer::Failure;
use crate::picture::quaternion;

/// The channels of a run.
pub(super) struct Channels<'s, const D: usize> {
    structure: &'s Structure<D>,
    kinds: Vec<ChannelName>,
    watched: Vec<(&'s str, Form<D>)>,
    reactions: Option<Reactions<'s>>,
    inputs: Vec<f64>,
    cables: Vec<CableState>,
    row: Vec<f64>,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl<'s, const D: usize> Channels<'s, D> {
    /// The channels that a run asks for.
    pub(super) fn new(structure: &'s Structure<D>, settings: &RunSettings) -> Result<Self, Failure> {
        let model = &structure.model;
        let watched = structure
            .watched
            .iter()
            .map(|(name, place)| Ok((name.as_str(), model.form(*place).map_err(Failure::analysis)?)));
        let reactions = settings.channels.contains(&ChannelName::Reactions);
        let reactions = reactions.then(|| Reactions::new(model).map_err(Failure::analysis)).transpose()?;
        Ok(Self {
            kinds: settings.channels.clone(),
            watched: watched.collect::<Result<_, Failure>>()?,
            reactions,
            inputs: vec![0.0; model.mechanics().sizes().inputs],
            cables: Vec::new(),
            row: Vec::new(),
            structure,
        })
    }

    /// Names and units, time first.
    pub(super) fn list(&self) -> Vec<Channel> {
        let model = &self.structure.model;
        let mut list = vec![Channel::time()];
        for kind in &self.kinds {
            match kind {
                ChannelName::Energies => {
                    let names = ["kinetic", "elastic", "gravity", "load", "total"];
                    list.extend(names.map(|name| Channel::new(format!("{name} energy"), "J", "energy")));
                }
                ChannelName::Tensions => self.each_cable(&mut list, "tension", "N", "tension"),
                ChannelName::Lengths => self.each_cable(&mut list, "length", "m", "length"),
                ChannelName::RestLengths => self.each_cable(&mut list, "rest length", "m", "rest"),
                ChannelName::Slack => self.each_cable(&mut list, "slack", "", "slack"),
                ChannelName::Points => {
                    for (point, _) in &self.watched {
                        list.extend(
                            AXES[..D].iter().map(|a| Channel::new(format!("{point}.{a}"), "m", "point")),
                        );
                    }
                    for (point, _) in &self.watched {
                        let velocity = |a: &&str| Channel::new(format!("{point}.v{a}"), "m/s", "velocity");
                        list.extend(AXES[..D].iter().map(velocity));
                    }
                }
                ChannelName::Poses => {
                    for name in model.members().map(|member| model.member_name(member)) {
                        list.extend(
                            AXES[..D].iter().map(|a| Channel::new(format!("{name}.pose {a}"), "m", "pose")),
                        );
                        if D == 2 {
                            list.push(Channel::new(format!("{name}.pose angle"), "rad", "angle"));
                        } else {
                            let parts = ["x", "y", "z", "w"];
                            list.extend(
                                parts.map(|a| Channel::new(format!("{name}.pose q{a}"), "", "quaternion")),
                            );
                        }
                    }
                }
                ChannelName::Reactions => {
                    for &i in self.reactions.iter().flat_map(|r| r.coordinates()) {
                        let name = format!("{}.reaction {}", model.node_name(i / D), AXES[i % D]);
                        list.push(Channel::new(name, "N", "reaction"));
                    }
                }
                ChannelName::Solver => {
                    list.push(Channel::new("iterations", "", "solver"));
                    list.push(Channel::new("residual", "", "residual"));
                }
            }
        }
        list
    }

    fn each_cable(&self, list: &mut Vec<Channel>, what: &str, unit: &str, group: &str) {
        let model = &self.structure.model;
        let name = |cable| format!("{}.{what}", model.cable_name(cable));
        list.extend(model.cables().map(|cable| Channel::new(name(cable), unit, group)));
    }

    /// The row at an accepted step.
    pub(super) fn row(&mut self, state: &State, report: &StepReport) -> Result<&[f64], Failure> {
        let model = &self.structure.model;
        let State { t, q, v, .. } = state;
        model.mechanics().inputs(*t, &mut self.inputs);
        let inputs = &self.inputs;
        self.cables.clear();
        self.cables.extend(model.cables().map(|cable| model.cable(cable, q, v, inputs)));
        self.row.clear();
        self.row.push(*t);
        for kind in &self.kinds {
            match kind {
                ChannelName::Energies => {
                    let energy = model.energy(q, v, inputs);
                    let parts = [energy.kinetic, energy.elastic, energy.gravity, energy.load, energy.total()];
                    self.row.extend(parts);
                }
                ChannelName::Tensions => self.row.extend(self.cables.iter().map(|cable| cable.tension)),
                ChannelName::Lengths => self.row.extend(self.cables.iter().map(|cable| cable.length)),
                ChannelName::RestLengths => self.row.extend(self.cables.iter().map(|cable| cable.rest)),
                ChannelName::Slack => {
                    self.row.extend(self.cables.iter().map(|cable| f64::from(u8::from(cable.slack))));
                }
                ChannelName::Points => {
                    for values in [q, v] {
                        self.row.extend(self.watched.iter().flat_map(|(_, form)| {
                            let value = form.eval(values);
                            (0..D).map(move |k| value[k])
                        }));
                    }
                }
                ChannelName::Poses => {
                    for member in model.members() {
                        let pose = model.pose(member, q).map_err(Failure::analysis)?.pose;
                        self.row.extend(pose.position.iter());
                        if D == 2 {
                            self.row.push(pose.rotation[(1, 0)].atan2(pose.rotation[(0, 0)]));
                        } else {
                            self.row.extend(quaternion(&pose));
                        }
                    }
                }
                ChannelName::Reactions => {
                    if let Some(reactions) = &mut self.reactions {
                        self.row.extend(reactions.at(*t, q, v).map_err(Failure::analysis)?);
                    }
                }
                ChannelName::Solver => {
                    self.row.extend([f64::from(report.iterations), report.residual]);
                }
            }
        }
        Ok(&self.row)
    }
}
