//! A guyed, prestressed prism mast: the benchmark scene that other tools were measured on.
//!
//! Level s = 0 … N has three nodes at radius R, a third of a turn apart, at height s H; a level is turned by ±45° against the
//! one below, alternately. A stage has three thin bars (turned by 165°), three vertical and three diagonal cables; each
//! level but the lowest three horizontal cables and three guys to the ground's anchors. Level 0 is hinged to the ground,
//! bars that share a node are hinged to each other. The rest lengths hold the design geometry in equilibrium under its
//! weight; then the guys are shortened by δ cos(2π (s/7 + j/3)), so that the mast, released, sways. No cable goes slack.

mod scene;

use tg_model::{BuildError, CableLaw, Joining, MemberId, Model, ModelBuilder, Place};

pub use scene::{MastCable, MastScene};

/// The mast and its nodes.
#[derive(Debug)]
pub struct Mast {
    /// The model: 9 free coordinates, 3 constraints and 12 cables a stage.
    pub model: Model<3>,
    /// The free nodes, level by level from 1, corners in order; the ground's three are left out.
    pub nodes: Vec<Place<3>>,
}

/// The mast of `stages` stages, guys disturbed, at its design geometry.
///
/// # Errors
/// A mast without stages has nothing that is free.
pub fn mast(stages: usize) -> Result<Mast, BuildError> {
    Mast::build(&MastScene::new(stages))
}

impl Mast {
    /// The model of a scene; bars that meet share their node.
    ///
    /// # Errors
    /// A mast without stages has nothing that is free.
    pub fn build(scene: &MastScene) -> Result<Self, BuildError> {
        Self::build_with(scene, |b, name, lower, upper| b.bar(name, MastScene::BAR_MASS, lower, upper))
    }

    /// The same with members of another kind for the bars: from a name and two ends \[m\], which are their first two nodes.
    ///
    /// # Errors
    /// As [`Mast::build`], and those of the members.
    pub fn build_with(
        scene: &MastScene,
        mut bar: impl FnMut(&mut ModelBuilder<3>, &str, [f64; 3], [f64; 3]) -> Result<MemberId, BuildError>,
    ) -> Result<Self, BuildError> {
        let mut b = ModelBuilder::<3>::new();
        b.gravity([0.0, 0.0, -MastScene::GRAVITY])?;
        let mut places: Vec<Option<Place<3>>> = vec![None; scene.nodes.len()];
        for (k, &[lower, upper]) in scene.bars.iter().enumerate() {
            let (s, j) = (k / 3, k % 3);
            let name = format!("bar {s}.{j}");
            let bar = bar(&mut b, &name, scene.nodes[lower], scene.nodes[upper])?;
            match places[lower] {
                Some(below) => {
                    b.joint(&format!("node {s}.{j}"), &[below, bar.node(0)], Joining::Share)?;
                }
                None => {
                    b.fix(&format!("foot {j}"), bar.node(0))?;
                    places[lower] = Some(bar.node(0));
                }
            }
            places[upper] = Some(bar.node(1));
        }
        for cable in &scene.cables {
            let mut ends = Vec::with_capacity(2);
            for &node in &cable.nodes {
                ends.push(match places[node] {
                    Some(place) => place,
                    // Only the anchors belong to no bar.
                    None => b.anchor(&format!("anchor of {}", cable.name), scene.nodes[node])?.into(),
                });
            }
            let law = CableLaw::Slacking { stiffness: cable.stiffness, damping: cable.damping };
            b.cable(&cable.name, ends[0], ends[1], law, cable.rest_length)?;
        }
        let free = 3..3 * (scene.stages + 1);
        Ok(Self { model: b.build()?, nodes: places[free].iter().flatten().copied().collect() })
    }
}
