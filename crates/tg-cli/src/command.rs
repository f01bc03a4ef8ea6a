//! The commands, one module each; every one returns an answer or a failure and prints nothing itself.

mod check;
mod equilibria;
mod generate;
mod import;
mod modes;
mod run;
mod show;
mod statics;
mod sweep;
mod trade;

pub(crate) use check::check;
pub(crate) use equilibria::equilibria;
pub(crate) use generate::{completions, man, schema};
pub(crate) use import::import;
pub(crate) use modes::modes;
pub(crate) use run::run;
pub(crate) use show::{export, plot, view};
pub(crate) use statics::statics;
pub(crate) use sweep::sweep;
pub(crate) use trade::trade;

/// Calls a function of `Structure<D>` for the dimension that a scene has.
macro_rules! with_structure {
    ($built:expr, $structure:ident => $call:expr) => {
        match $built {
            tg_scene::Built::Plane($structure) => $call,
            tg_scene::Built::Space($structure) => $call,
        }
    };
}
pub(crate) use with_structure;
