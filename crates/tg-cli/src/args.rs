//! The command line. What stands in brackets here is a unit that people read in a terminal.
#![allow(rustdoc::broken_intra_doc_links)]

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use tg_scene::Scheme;

/// Mechanics of tensegrity structures: rigid bodies, bars and cables, from a scene file to an answer and a picture.
///
/// Units are SI, angles in radians, tension is positive. Exit code: 0 success, 1 the analysis failed (no convergence,
/// infeasible), 2 bad input.
#[derive(Debug, Parser)]
#[command(
    name = "tg",
    version,
    max_term_width = 100,
    after_help = "\
A first tour:
  tg check scenes/tower.toml           read a scene, count what it holds
  tg run scenes/tower.toml             simulate it; the results folder holds a view.html
  tg modes scenes/icosahedron.toml     its frequencies
  tg plot tower-run --what tensions    a picture of the cables' tensions"
)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Print one JSON document on stdout; messages go to stderr.
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Threads of parallel work; as many as there are cores unless given.
    #[arg(long, global = true, value_name = "N", value_parser = positive_count)]
    pub(crate) threads: Option<usize>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Read a scene, build its model and count what it holds.
    ///
    /// A mistake is shown in its line with what would mend it.
    #[command(after_help = "Example:\n  tg check scenes/prism_mast.toml --set stages=8")]
    Check(Check),
    /// Equilibrium: is this shape one, which rest lengths hold it, which shape holds itself.
    ///
    /// Without options: the residual force of the shape as built, tensions, axial forces in bars and reactions; its states of
    /// self-stress, mechanisms and stability. A structure from elsewhere is seldom in equilibrium as written: --relax finds the
    /// shape that its rest lengths give, --inverse the rest lengths that its shape needs.
    #[command(after_help = "\
Examples:
  tg statics scenes/icosahedron.toml                                   is it prestressed, is it stable
  tg statics scenes/icosahedron.toml --inverse --least-tension 50      a cutting list
  tg statics scenes/antiprism_force.toml --relax -o loaded             the shape under load, to look at")]
    Statics(Statics),
    /// Natural frequencies and mode shapes about an equilibrium.
    ///
    /// The modes are those of the shape as built if it is an equilibrium, else of the equilibrium that is found from it. An
    /// unstable equilibrium has motions that grow; a mechanism without stiffness has frequency zero.
    #[command(after_help = "Example:\n  tg modes scenes/prism_mast.toml -n 10 --damped -o mast-modes")]
    Modes(Modes),
    /// Simulate the motion and write a results folder with an HTML view.
    ///
    /// Everything not given here is taken from the scene's [run] section. Ctrl-C stops at the next step and keeps what there
    /// is; --resume goes on from there, bit for bit, by the scheme and the step that the run began with. The trajectory is a
    /// folder of Parquet files: pandas.read_parquet("tower-run/trajectory").
    #[command(after_help = "\
Examples:
  tg run scenes/tower.toml                                   into tower-run
  tg run scenes/tower.toml --set amplitude=0.005 -o gentle   a weaker earthquake
  tg run scenes/tower.toml --accuracy 1e-6 --force           the step is chosen
  tg run scenes/tower.toml --scheme runge-kutta-8 --tolerance 1e-10 -o exact")]
    Run(Run),
    /// What accuracy costs: a scene's motion by every scheme, at finer and finer steps or tolerances.
    ///
    /// True errors of positions, tensions and energy, against a motion that is much finer and states its own uncertainty, and
    /// processor time; the cheapest setting for each power of ten, and the one for an accuracy.
    #[command(after_help = "\
Examples:
  tg trade scenes/double_pendulum.toml                       which scheme and step reaches which error
  tg trade scenes/icosahedron.toml --accuracy 1e-6 -o cost   for 1e-6 m; with plots")]
    Trade(Trade),
    /// All equilibria of a small structure, each proved, with their stability.
    ///
    /// Every spring counts as a two-way one; the answer says at which equilibria a cable that only pulls would be short. The
    /// work grows quickly with the structure: what would take too many paths is refused with their number.
    #[command(after_help = "Example:\n  tg equilibria scenes/mechanism.toml --set free_2=0 -o shapes")]
    Equilibria(Equilibria),
    /// Frequencies, equilibria or the motion against a parameter of the scene.
    ///
    /// Motions are simulated side by side, as many at a time as there are threads; the results do not depend on their number.
    /// A run that fails says so in its row.
    #[command(after_help = "\
Examples:
  tg sweep scenes/tower_modal.toml -p ratio --from 0.86 --to 1 -o prestress
  tg plot prestress --what sweep
  tg sweep scenes/mechanism.toml -p \"spring 1\" --from 6 --to 14 --what equilibria    with folds
  tg sweep scenes/tower.toml -p amplitude --from 0 --to 0.01 --samples 5 --what motion")]
    Sweep(Sweep),
    /// Make the HTML view of a results folder, or of a scene as built.
    ///
    /// One file that needs no network: 3D motion, modes or equilibria, and linked plots.
    #[command(after_help = "Example:\n  tg view scenes/icosahedron.toml -o icosahedron.html")]
    View(View),
    /// Draw a plot of a results folder as SVG or PNG.
    #[command(after_help = "Example:\n  tg plot tower-run --what slack -o slack.png")]
    Plot(Plot),
    /// Write results in forms that other programs read.
    #[command(after_help = "Example:\n  tg export tower-run --to vtk -o tower.pvd")]
    Export(Export),
    /// Turn files of other programs into a scene.
    ///
    /// Reads nodes/bars/cables CSV triples (a folder or its nodes.csv), YAML structures of the NASA Tensegrity Robotics
    /// Toolkit, and structures in neutral JSON. Numbers are taken as they are unless scaled.
    #[command(after_help = "\
Example:
  tg import prism.yaml --length-scale 0.1 --force-scale 0.1 -o prism.toml     decimetres to metres
  tg statics prism.toml --relax")]
    Import(Import),
    /// Print the JSON Schema of scene files, for editors, or the reference page made from it.
    #[command(after_help = "Example:\n  tg schema > scene.schema.json")]
    Schema(Schema),
    /// Print completions for a shell.
    #[command(after_help = "Example:\n  tg completions bash > ~/.local/share/bash-completion/completions/tg")]
    Completions(Completions),
    /// Print the manual page, or write the pages of all commands to a folder.
    #[command(after_help = "Example:\n  tg man -o ~/.local/share/man/man1")]
    Man(Man),
}

/// A scene and values of its parameters.
#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// The scene: a .toml or .json file.
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// Replace the value of a parameter; may be given several times.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    pub(crate) set: Vec<(String, f64)>,
}

/// Where results go.
#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Write a results folder with run.json, data and view.html.
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Replace earlier results in that folder.
    #[arg(long)]
    pub(crate) force: bool,
}

/// `tg check`
#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
}

/// `tg statics`
#[derive(Debug, Args)]
pub(crate) struct Statics {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Find the equilibrium that Newton's method reaches from the shape as built.
    #[arg(long, conflicts_with = "inverse")]
    pub(crate) solve: bool,
    /// As --solve, but a stable one, by dynamic relaxation where Newton's method fails: for shapes far from equilibrium.
    #[arg(long, conflicts_with = "inverse")]
    pub(crate) relax: bool,
    /// Inverse statics: the rest lengths that hold the shape as built, as a cutting list.
    #[arg(long)]
    pub(crate) inverse: bool,
    /// In which unknowns inverse statics chooses among its solutions.
    #[arg(long, value_enum, default_value_t = UnknownName::RestLength, requires = "inverse")]
    pub(crate) unknown: UnknownName,
    /// Which solution it chooses.
    #[arg(long, value_enum, default_value_t = GoalName::Closest, requires = "inverse")]
    pub(crate) goal: GoalName,
    /// Least tension of every cable [N].
    #[arg(long, value_name = "N", requires = "inverse", allow_negative_numbers = true)]
    pub(crate) least_tension: Option<f64>,
    /// Greatest tension of every cable [N].
    #[arg(long, value_name = "N", requires = "inverse")]
    pub(crate) greatest_tension: Option<f64>,
    /// Cables of one group have equal unknowns.
    #[arg(long, requires = "inverse")]
    pub(crate) tie_groups: bool,
    /// Part of the largest singular value below which others count as zero; coordinates rounded to four digits want 1e-3.
    #[arg(long, value_name = "X")]
    pub(crate) rank_tolerance: Option<f64>,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// Unknowns of inverse statics.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum UnknownName {
    /// Tensions [N].
    Tension,
    /// Force densities [N/m].
    ForceDensity,
    /// Rest lengths [m].
    RestLength,
}

/// Choices of inverse statics.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum GoalName {
    /// Closest to the unknowns of the scene: least squares of the changes.
    Closest,
    /// The least sum of squares of the unknowns.
    MinimumNorm,
    /// The least sum of tensions; needs --least-tension.
    LeastTotalTension,
}

/// `tg modes`
#[derive(Debug, Args)]
pub(crate) struct Modes {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// How many modes, the lowest first.
    #[arg(short = 'n', long, default_value_t = 20, value_parser = positive_count)]
    pub(crate) count: usize,
    /// All modes.
    #[arg(long, conflicts_with = "count")]
    pub(crate) all: bool,
    /// Damped modes as well.
    #[arg(long)]
    pub(crate) damped: bool,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// `tg run`
#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The results folder; named after the scene unless given.
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Replace earlier results in that folder.
    #[arg(long, conflicts_with = "resume")]
    pub(crate) force: bool,
    /// Go on with an interrupted run in that folder; where nothing was computed yet, begin it.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Time on the clock between checkpoints [s]: what a killed run computes again.
    #[arg(long, value_name = "S", default_value_t = 5.0, value_parser = positive)]
    pub(crate) checkpoint_every: f64,
    /// Simulated time [s].
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) duration: Option<f64>,
    /// Time step [s]; under error control the longest one, and the time between rows.
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) step: Option<f64>,
    /// Position error aimed at [m]; the step, or the tolerance of a Runge–Kutta scheme, is chosen by trial runs.
    #[arg(long, value_name = "M", value_parser = positive, conflicts_with_all = ["step", "tolerance"])]
    pub(crate) accuracy: Option<f64>,
    /// Time stepping scheme.
    #[arg(long, value_name = "NAME", value_parser = schemes())]
    pub(crate) scheme: Option<Scheme>,
    /// Error control of a Runge–Kutta scheme: error of a substep relative to coordinates and velocities.
    #[arg(long, value_name = "X", value_parser = positive)]
    pub(crate) tolerance: Option<f64>,
    /// No view.html.
    #[arg(long)]
    pub(crate) no_view: bool,
}

/// `tg trade`
#[derive(Debug, Args)]
pub(crate) struct Trade {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Position error that the recommendation is for [m]; the scene's, or a thousandth of the largest displacement, unless
    /// given.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub(crate) accuracy: Option<f64>,
    /// Simulated time [s].
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) duration: Option<f64>,
    /// Only this scheme; may be given several times.
    #[arg(long, value_name = "NAME", value_parser = schemes())]
    pub(crate) scheme: Vec<Scheme>,
    /// Processor time that a single run may take [s].
    #[arg(long, value_name = "S", default_value_t = 2.0, value_parser = positive)]
    pub(crate) budget: f64,
    /// Write trade.json, trade.csv and a plot for each quantity into this folder.
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

/// `tg equilibria`
#[derive(Debug, Args)]
pub(crate) struct Equilibria {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Refuse more paths than this.
    #[arg(long, default_value_t = 20_000)]
    pub(crate) max_paths: u64,
    /// Decides all random numbers.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// `tg sweep`
#[derive(Debug, Args)]
pub(crate) struct Sweep {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The parameter of the scene that changes; for equilibria it may also be the name of a cable, whose rest length changes.
    #[arg(short, long, value_name = "NAME")]
    pub(crate) parameter: String,
    /// First value.
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) from: f64,
    /// Last value.
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) to: f64,
    /// How many values, evenly spaced.
    #[arg(long, default_value_t = 21, value_parser = sample_count)]
    pub(crate) samples: usize,
    /// What is followed.
    #[arg(long, value_enum, default_value_t = SweepWhat::Modes)]
    pub(crate) what: SweepWhat,
    /// How many modes are followed.
    #[arg(short = 'n', long, default_value_t = 6, value_parser = positive_count)]
    pub(crate) count: usize,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// What a sweep follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SweepWhat {
    /// Natural frequencies at the equilibrium found from the shape as built.
    Modes,
    /// All equilibria, with the folds at which they appear and vanish.
    Equilibria,
    /// The motion of the scene's [run] section: extreme tensions, slackness, displacement, energy.
    Motion,
}

/// `tg view`
#[derive(Debug, Args)]
pub(crate) struct View {
    /// A results folder, or a scene, which is shown as built.
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// The HTML file; view.html in the folder, or beside the scene under its name, unless given.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// `tg plot`
#[derive(Debug, Args)]
pub(crate) struct Plot {
    /// A results folder.
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// What is drawn.
    #[arg(long, value_enum, default_value_t = PlotWhat::Tensions)]
    pub(crate) what: PlotWhat,
    /// The picture, .svg or .png; named after what it shows, in the folder, unless given.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// What a plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotWhat {
    /// Tension of each cable over time.
    Tensions,
    /// Length of each cable over time.
    Lengths,
    /// Energies over time.
    Energies,
    /// Relative error of the energy over time, of runs that should keep it.
    EnergyDrift,
    /// When each cable is slack.
    Slack,
    /// Positions of the chosen points over time.
    Points,
    /// Reactions of the supports over time.
    Reactions,
    /// Frequencies, energies of equilibria, or extreme tensions of motions, against the parameter of a sweep.
    Sweep,
    /// The structure at six times, or its equilibria, side by side.
    Snapshots,
}

/// `tg export`
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// A results folder.
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// The form.
    #[arg(long = "to", value_enum)]
    pub(crate) form: ExportForm,
    /// The file; in the results folder unless given.
    #[arg(short, long, value_name = "PATH")]
    pub(crate) output: Option<PathBuf>,
}

/// Forms of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExportForm {
    /// The trajectory as comma-separated values.
    Csv,
    /// The trajectory as a structured NumPy array.
    Npy,
    /// ParaView: a .pvd time series.
    Vtk,
    /// glTF 2.0 with animation: one .glb file.
    Gltf,
}

/// `tg import`
#[derive(Debug, Args)]
pub(crate) struct Import {
    /// What to import.
    #[arg(value_name = "PATH")]
    pub(crate) path: PathBuf,
    /// The scene; printed unless given.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Metres of one unit of length in the file.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    pub(crate) length_scale: f64,
    /// Kilograms of one unit of mass.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    pub(crate) mass_scale: f64,
    /// Newtons of one unit of force.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    pub(crate) force_scale: f64,
}

/// `tg schema`
#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// The reference page in Markdown instead of JSON.
    #[arg(long)]
    pub(crate) markdown: bool,
}

/// `tg completions`
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell.
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

/// `tg man`
#[derive(Debug, Args)]
pub(crate) struct Man {
    /// Write tg.1 and the pages of all commands to this folder.
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

fn setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE")?;
    let value: f64 = value.trim().parse().map_err(|_| format!("`{value}` is no number"))?;
    if value.is_finite() { Ok((name.trim().into(), value)) } else { Err("the value is not finite".into()) }
}

/// The schemes as scene files name them.
fn schemes() -> impl TypedValueParser<Value = Scheme> {
    PossibleValuesParser::new(Scheme::ALL.map(|scheme| scheme.to_string())).try_map(|name| name.parse())
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a positive number is expected".into()),
    }
}

fn positive_count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| *n > 0).ok_or_else(|| "a whole number from 1 on is expected".into())
}

fn sample_count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| *n > 1).ok_or_else(|| "a whole number from 2 on is expected".into())
}
