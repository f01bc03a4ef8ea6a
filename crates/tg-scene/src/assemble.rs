//! A scene as a model. Two passes over all copies of all arrays: first what has a place of its own, then what is attached.

mod attached;
mod bodies;
mod cables;
mod members;

use nalgebra::SVector;
use tg_coords::{Pose, Twist};
use tg_model::{BuildError, MemberId, ModelBuilder, Redundancies};

use crate::dimension::{Dimension, Space};
use crate::error::ReadError;
use crate::expression::{Variables, check_name};
use crate::names::{Copy, Located, Names};
use crate::node::Span;
use crate::parts::{Array, Parts};
use crate::quantity::Vector;
use crate::read::Files;
use crate::scene::{RedundanciesName, Scene};
use crate::signals::Signals;
use crate::spanned::Spanned;
use crate::structure::{MemberPicture, Structure};
use crate::values::{vector, whole};

/// More copies of all arrays together are a slip of the pen; a fuzzer has less time.
const MOST_COPIES: usize = if cfg!(fuzzing) { 200 } else { 100_000 };
/// More parts that the copies of arrays make are one too.
const MOST_PARTS: usize = if cfg!(fuzzing) { 1_000 } else { 1_000_000 };

/// What a scene is built with besides itself.
pub(crate) struct Context<'s> {
    pub(crate) variables: Variables,
    pub(crate) files: &'s dyn Files,
}

/// A model being built from a scene.
struct Assembler<'s, const D: usize> {
    scene: &'s Scene,
    builder: ModelBuilder<D>,
    names: Names<D>,
    signals: Signals<'s>,
    /// Kind and name of each part, and where it is written.
    origins: Vec<(&'static str, String, Span)>,
    pictures: Vec<MemberPicture>,
    groups: Vec<Option<String>>,
    motions: Vec<(MemberId, Twist<D>)>,
    /// Copies of arrays made in this pass, and their parts.
    copies: usize,
    parts: usize,
}

type Pass<'s, const D: usize> = fn(&mut Assembler<'s, D>, Parts<'s>, &Copy<D>) -> Result<(), ReadError>;

/// Builds the structure of a scene.
pub(crate) fn assemble<'s, const D: usize>(
    scene: &'s Scene,
    context: Context<'s>,
) -> Result<Structure<D>, ReadError>
where
    Space: Dimension<D>,
{
    let Context { variables, files } = context;
    let mut assembler = Assembler {
        scene,
        builder: ModelBuilder::new(),
        names: Names::default(),
        signals: Signals::of(&scene.signals, &variables, files)?,
        origins: Vec::new(),
        pictures: Vec::new(),
        groups: Vec::new(),
        motions: Vec::new(),
        copies: 0,
        parts: 0,
    };
    let whole = Copy { variables, pose: Pose::identity() };
    assembler.settings(&whole)?;
    assembler.each_copy(scene.parts(), &whole, Assembler::place_members)?;
    (assembler.copies, assembler.parts) = (0, 0);
    assembler.each_copy(scene.parts(), &whole, Assembler::attach)?;
    let watched = assembler.watched(&whole)?;
    assembler.finish(watched)
}

impl<'s, const D: usize> Assembler<'s, D>
where
    Space: Dimension<D>,
{
    fn settings(&mut self, whole: &Copy<D>) -> Result<(), ReadError> {
        if let Some(gravity) = &self.scene.gravity {
            let g = vector::<D>(&whole.variables, gravity)?;
            self.builder.gravity(g.into()).map_err(|error| mistake(&error, &gravity.span))?;
        }
        self.builder.redundancies(match self.scene.redundancies {
            RedundanciesName::Reject => Redundancies::Reject,
            RedundanciesName::Drop => Redundancies::Drop,
        });
        Ok(())
    }

    /// The parts themselves, then those of each array, copy by copy.
    fn each_copy(&mut self, parts: Parts<'s>, copy: &Copy<D>, pass: Pass<'s, D>) -> Result<(), ReadError> {
        pass(self, parts, copy)?;
        for (name, array) in parts.arrays {
            let count = whole(&copy.variables, &array.count, MOST_COPIES)?;
            for k in 0..count {
                self.copies += 1;
                self.parts += array.parts().count();
                let too_many = [(self.copies, MOST_COPIES, "copies"), (self.parts, MOST_PARTS, "parts")];
                if let Some((_, most, what)) = too_many.into_iter().find(|(made, most, _)| made > most) {
                    let message = format!("the arrays make more than {most} {what}");
                    return Err(ReadError::new(message).at(&name.span).help("lower a count"));
                }
                let inner = array_copy(array, k as f64, copy)?;
                self.each_copy(array.parts(), &inner, pass)?;
            }
        }
        Ok(())
    }

    /// A name with its indices filled in, remembered with its place in the file.
    fn name(
        &mut self,
        kind: &'static str,
        given: &Spanned<String>,
        copy: &Copy<D>,
    ) -> Result<String, ReadError> {
        let name = copy.variables.fill(&given.value, &given.span)?;
        if name.is_empty() {
            return Err(ReadError::new("the name is empty").at(&given.span));
        }
        self.origins.push((kind, name.clone(), given.span.clone()));
        Ok(name)
    }

    fn watched(&self, whole: &Copy<D>) -> Result<Vec<(String, Located<D>)>, ReadError> {
        let points = self.scene.run.iter().flat_map(|run| &run.points);
        let located = points.map(|name| {
            let place =
                Spanned { value: crate::place::PlaceName::Name(name.value.clone()), span: name.span.clone() };
            Ok((name.value.clone(), self.names.place(&place, whole)?))
        });
        located.collect()
    }

    fn finish(self, watched: Vec<(String, Located<D>)>) -> Result<Structure<D>, ReadError> {
        let origins = self.origins;
        let model = self.builder.build().map_err(|error| {
            let span = origin(&error, &origins).unwrap_or(self.scene.dimension.span.clone());
            mistake(&error, &span)
        })?;
        let mut velocities = model.velocities_at_rest();
        let q = model.initial_coordinates();
        for (member, twist) in &self.motions {
            let set = model.set_twist(*member, twist, &q, &mut velocities);
            set.map_err(|error| ReadError::from_below(&error).at(&self.scene.dimension.span))?;
        }
        let watched = watched.into_iter().map(|(name, located)| (name, located.place)).collect();
        Ok(Structure { model, pictures: self.pictures, groups: self.groups, watched, velocities })
    }
}

/// Copy `k` of an array.
fn array_copy<const D: usize>(array: &Array, k: f64, outer: &Copy<D>) -> Result<Copy<D>, ReadError>
where
    Space: Dimension<D>,
{
    let index = match &array.index {
        Some(name) => {
            check_name(name)?;
            name.value.as_str()
        }
        None => "i",
    };
    let variables = outer.variables.with(index, k);
    let component = |given: &Option<Vector>| {
        given.as_ref().map_or(Ok(SVector::zeros()), |given| vector::<D>(&variables, given))
    };
    let (centre, shift) = (component(&array.centre)?, component(&array.translate)?);
    let turn = Space::turn(array, k, &variables)?;
    let step = Pose { position: centre - turn.apply_vector(&centre) + shift * k, rotation: turn.rotation };
    Ok(Copy { variables, pose: outer.pose.compose(&step) })
}

/// An error of the model at a place of the file.
fn mistake(error: &BuildError, span: &Span) -> ReadError {
    let error_below = ReadError::from_below(error).at(span);
    if matches!(error, BuildError::Redundant { .. }) {
        let help =
            "remove the joint or support that repeats another, or write redundancies = \"drop\" at the top";
        return error_below.help(help);
    }
    error_below
}

/// Where the part is written that an error of the whole structure is about: the first that it names with its kind, or the
/// first that it names at all.
fn origin(error: &BuildError, origins: &[(&'static str, String, Span)]) -> Option<Span> {
    let text = error.to_string();
    let first = |written: &dyn Fn(&'static str, &str) -> String| {
        let found =
            origins.iter().filter_map(|(kind, name, span)| Some((text.find(&written(kind, name))?, span)));
        found.min_by_key(|(at, _)| *at).map(|(_, span)| span.clone())
    };
    first(&|kind, name| format!("{kind} \"{name}\"")).or_else(|| first(&|_, name| format!("\"{name}\"")))
}
