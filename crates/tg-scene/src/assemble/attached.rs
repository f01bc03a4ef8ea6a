//! Second pass: joints, supports, cables and loads.

use tg_model::{Joining, Place, Signal};

use super::{Assembler, mistake};
use crate::dimension::{Dimension, MomentOn, Space};
use crate::error::ReadError;
use crate::load::Load;
use crate::names::{Copy, Located};
use crate::parts::{JoiningName, Joint, Parts, Support};
use crate::spanned::Spanned;
use crate::values::vector;

impl<'s, const D: usize> Assembler<'s, D>
where
    Space: Dimension<D>,
{
    /// What is attached in one copy.
    pub(super) fn attach(&mut self, parts: Parts<'s>, copy: &Copy<D>) -> Result<(), ReadError> {
        for (name, joint) in parts.joints {
            self.joint(name, joint, copy).map_err(|error| error.at(&name.span))?;
        }
        for (name, support) in parts.supports {
            self.support(name, support, copy).map_err(|error| error.at(&name.span))?;
        }
        for (name, cable) in parts.cables {
            self.cable(name, cable, copy).map_err(|error| error.at(&name.span))?;
        }
        for (name, load) in parts.loads {
            self.load(name, load, copy).map_err(|error| error.at(&name.span))?;
        }
        Ok(())
    }

    fn joint(&mut self, given: &Spanned<String>, joint: &Joint, copy: &Copy<D>) -> Result<(), ReadError> {
        let name = self.name("joint", given, copy)?;
        let located = joint.places.value.iter().map(|place| self.names.place(place, copy));
        let places = located.map(|l| l.map(|l| l.place)).collect::<Result<Vec<_>, _>>()?;
        let shareable = places.iter().all(|place| matches!(place, Place::Node(..) | Place::Anchor(_)));
        let joining = match joint.joining {
            Some(JoiningName::Share) => Joining::Share,
            Some(JoiningName::Constrain) => Joining::Constrain,
            None if shareable => Joining::Share,
            None => Joining::Constrain,
        };
        self.builder.joint(&name, &places, joining).map_err(|error| mistake(&error, &given.span))
    }

    fn support(
        &mut self,
        given: &Spanned<String>,
        support: &Support,
        copy: &Copy<D>,
    ) -> Result<(), ReadError> {
        const AXES: [char; 3] = ['x', 'y', 'z'];
        let name = self.name("support", given, copy)?;
        let Located { place, .. } = self.names.place(&support.at, copy)?;
        let mut held = [support.axes.is_none(); 3];
        for axis in support.axes.iter().flat_map(|axes| axes.value.chars()) {
            let position = AXES.iter().position(|known| *known == axis).filter(|k| *k < D);
            let position = position.ok_or_else(|| {
                let span = support.axes.as_ref().map(|axes| axes.span.clone());
                let help = format!("axes of this scene: {}", AXES[..D].iter().collect::<String>());
                ReadError::new(format!("there is no axis `{axis}`")).at_opt(span).help(help)
            })?;
            held[position] = true;
        }
        let motions = [&support.motion.x, &support.motion.y, &support.motion.z];
        for (axis, motion) in motions.into_iter().enumerate() {
            if let Some(motion) = motion
                && (axis >= D || !held[axis])
            {
                let message = format!("the support moves along {}, which it does not hold", AXES[axis]);
                return Err(ReadError::new(message).at(&motion.span).help("add the letter to `axes`"));
            }
        }
        for axis in (0..D).filter(|axis| held[*axis]) {
            let motion = motions[axis].as_ref().map(|motion| self.signals.signal(motion, &copy.variables));
            let motion = motion.transpose()?.unwrap_or(Signal::Constant(0.0));
            // A support of one component has the name of the whole.
            let full = if support.axes.as_ref().is_some_and(|axes| axes.value.len() == 1) {
                name.clone()
            } else {
                format!("{name}.{}", AXES[axis])
            };
            self.origins.push(("support", full.clone(), given.span.clone()));
            self.builder.support(&full, place, axis, motion).map_err(|error| mistake(&error, &given.span))?;
        }
        Ok(())
    }

    fn load(&mut self, given: &Spanned<String>, load: &Load, copy: &Copy<D>) -> Result<(), ReadError> {
        let name = self.name("load", given, copy)?;
        let factor = load.factor.as_ref().map(|factor| self.signals.signal(factor, &copy.variables));
        let factor = factor.transpose()?.unwrap_or(Signal::Constant(1.0));
        match (&load.force, &load.moment, &load.joint_moments) {
            (Some(force), None, None) => {
                let at = load
                    .at
                    .as_ref()
                    .ok_or_else(|| ReadError::new("the force has no place").help("add at = ..."))?;
                let place = self.names.place(at, copy)?.place;
                let force = copy.pose.apply_vector(&vector::<D>(&copy.variables, force)?);
                let added = self.builder.load(&name, place, force.into(), factor);
                added.map(|_| ()).map_err(|error| mistake(&error, &given.span))
            }
            (None, Some(_), None) | (None, None, Some(_)) => {
                let on = load.on.as_ref().ok_or_else(|| {
                    ReadError::new("the moment has no member").help("add on = \"name of the member\"")
                })?;
                let member = self.names.member(on, copy)?.id;
                let (pose, variables) = (&copy.pose, &copy.variables);
                let moment = MomentOn { member, load, pose, variables, span: &given.span };
                Space::moment(&mut self.builder, &name, &moment, factor)
            }
            _ => {
                Err(ReadError::new("a load is one of force, moment and joint_moments")
                    .help("give exactly one"))
            }
        }
    }
}
